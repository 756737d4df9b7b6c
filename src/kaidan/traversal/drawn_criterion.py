"""The criterion of no rotation on many draws of a flight at once.

`static_criterion`, draw by draw: each draw has its own nosings, flat and centroid, and so its own
order of losses and its own carrying nosings. Nothing is linearised.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.oblique_support import edge_energy
from kaidan.mechanics.rocking import rocking
from kaidan.traversal.criterion import Tread
from kaidan.traversal.static_criterion import ROUNDING, Array, flights_of

Bools = NDArray[np.bool_]

BLOCK = 1 << 18
"""Draws times nosings that are judged at once."""


class DrawnTread(NamedTuple):
    """Underside on the flight, seen from the side; each of shape (draws,)."""

    L: Array
    """Length of the flat [m]."""
    C_L: Array
    """Centroid behind the uphill tip of the flat [m]."""
    C_N: Array
    """Centroid above the flat [m]."""

    def mirrored(self) -> "DrawnTread":
        """Seen from the other side."""
        return self._replace(C_L=self.L - self.C_L)


class Drawn(NamedTuple):
    """What the criterion says of each draw; infinite where it says nothing."""

    downhill: Array
    """Smallest margin at the downhill end with the uphill one on the flight [rad]."""
    uphill: Array
    """Smallest margin at the uphill end [rad]."""
    landing: Array
    """Smallest margin at the downhill end with the uphill one over the landing [rad]."""
    rocking: Array
    """Largest rocking [rad]; 0 where it says nothing."""
    rise: Array
    """Smallest rise of the centroid over the pivot that stays on the flight, at either end, less
    what rocking frees, never negative [m]."""
    landing_rise: Array
    """The same downhill, with the uphill end over the landing [m]."""
    inclination: Array
    """Steepest inclination of the flat on the flight [rad]; minus infinity where there is none."""
    landing_inclination: Array
    """The same with the uphill end over the landing [rad]."""


def drawn_criterion(
    nosings: Array,
    drawn: Array,
    tread: Tread,
    on: DrawnTread,
    *,
    acceleration: float = 0.0,
    within: tuple[float, float] = (-math.inf, math.inf),
) -> Drawn:
    """Judge every nosing that an end of the flat leaves or meets, on each draw.

    nosings, shape (n, 2): as they are taken to be: they say where landings are.
    drawn, shape (draws, n, 2): of each draw, from bottom to top: x uphill, z up [m].
    on: underside of each draw.
    acceleration: up the stairs [m/s^2].
    within: part of the flight that counts, by the place of the centroid [m].
    """
    count = len(drawn)
    rows = max(1, BLOCK // max(1, len(nosings)))
    parts = [
        _block(
            nosings,
            drawn[first : first + rows],
            tread,
            DrawnTread(*(each[first : first + rows] for each in on)),
            acceleration,
            within,
        )
        for first in range(0, count, rows)
    ]
    return Drawn(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def _block(
    nosings: Array,
    drawn: Array,
    tread: Tread,
    on: DrawnTread,
    a: float,
    within: tuple[float, float],
) -> Drawn:
    none = np.full(len(drawn), np.inf)
    found = Drawn(none, none, none, np.zeros(len(drawn)), none, none, -none, -none)
    for first, last in flights_of(nosings, tread.L):
        flight = drawn[:, first : last + 1]
        x, z = flight[..., 0].T, flight[..., 1].T
        low, high = within
        down = _Losses(x, z, on, tread, a, within, downhill=True)
        up = _Losses(
            -x[::-1], z[::-1], on.mirrored(), tread.mirrored(), -a, (-high, -low), downhill=False
        )
        found = Drawn(
            np.minimum(found.downhill, down.margin),
            np.minimum(found.uphill, up.margin),
            np.minimum(found.landing, down.landing),
            np.maximum.reduce([found.rocking, down.rocking, up.rocking, _seesaw(x, z, on, a)]),
            np.maximum(np.minimum.reduce([found.rise, down.rise, up.rise]), 0.0),
            np.maximum(np.minimum(found.landing_rise, down.landing_rise), 0.0),
            np.maximum(found.inclination, down.inclination),
            np.maximum(found.landing_inclination, down.landing_inclination),
        )
    return found


class _Losses:
    """Losses and gains judged at the tip that lies towards -x; x and z of shape (n, draws)."""

    def __init__(
        self,
        x: Array,
        z: Array,
        on: DrawnTread,
        tread: Tread,
        a: float,
        within: tuple[float, float],
        *,
        downhill: bool,
    ) -> None:
        self.x, self.z, self.on, self.a, self.within = x, z, on, a, within
        self.R, self.gyration = tread.R, tread.gyration
        count = x.shape[1]
        self.margin, self.landing = np.full(count, np.inf), np.full(count, np.inf)
        self.rise, self.landing_rise = np.full(count, np.inf), np.full(count, np.inf)
        self.rocking = np.zeros(count)
        self.inclination, self.landing_inclination = np.full((2, count), -np.inf)
        self._lose(downhill)
        self._gain()

    def _lose(self, downhill: bool) -> None:
        x, z, (L, C_L, C_N) = self.x, self.z, self.on
        going, theta_s = np.ones(x.shape[1], dtype=np.bool_), _mean_slope(x, z)
        for i in range(len(x) - 2):
            before, s = self._steepest(i, L)
            going &= s > i
            landing = x[i] + L * np.cos(before) > x[-1] + 1e-9
            r = i + 1
            left = L - self._apart(i, r)
            foot = left - C_L - C_N * np.tan(before)
            over = landing if not downhill else landing & (foot >= self._apart(r, -1))
            going &= ~over
            if not going.any():
                break
            on_flat, onto = self._steepest(r, left)
            alone = onto <= r
            after = np.where(alone, before, np.maximum(on_flat, self._under_the_end(r, left)))
            steepest = np.maximum(before, after)
            counts = going & self._counts(x[i], before)
            margin = self._margin(steepest, left - C_L)
            on_flight, on_landing = counts & ~landing, counts & landing
            self.margin = _least(self.margin, margin, on_flight)
            self.landing = _least(self.landing, margin, on_landing)
            self.inclination = _most(self.inclination, steepest, on_flight)
            self.landing_inclination = _most(self.landing_inclination, steepest, on_landing)
            x_s, z_s = (np.take_along_axis(each, s[None], axis=0)[0] for each in (x, z))
            settles = np.where(alone, before, on_flat)
            onto_r = np.arctan2(z_s - z[r], x_s - x[r])
            stands = np.where(s == r, settles, onto_r)
            turn = np.abs(stands - before)
            rocks = rocking(turn=turn, before=before, after=stands, theta_s=theta_s)
            self.rocking = _most(self.rocking, rocks, counts)
            freed = self._freed(i, before, (x_s, z_s), np.where(s == r, -turn, turn))
            rise = self._rise(steepest, after, left - C_L) - freed
            self.rise = _least(self.rise, rise, on_flight)
            self.landing_rise = _least(self.landing_rise, rise, on_landing)

    def _gain(self) -> None:
        x, on = self.x, self.on
        for m in range(3, len(x)):
            for r in range(m - 2, 0, -1):
                reached = self._apart(r, m) <= on.L + ROUNDING
                if not reached.any():
                    break
                last = reached & (self._apart(r - 1, m) > on.L + ROUNDING)
                slope = np.maximum.reduce([self._slope(r, k) for k in range(r + 1, m)])
                along = x[m] - on.C_L * np.cos(slope) - on.C_N * np.sin(slope)
                last &= (self.within[0] <= along) & (along <= self.within[1])
                margin = self._margin(slope, self._apart(r, m) - on.C_L)
                self.margin = _least(self.margin, margin, last)
                rise = self._rise(slope, slope, self._apart(r, m) - on.C_L)
                self.rise = _least(self.rise, rise, last)

    def _counts(self, x: Array, slope: Array) -> Bools:
        """Whether the centroid is in the part that counts, the near tip at a nosing."""
        along = x + (self.on.L - self.on.C_L) * np.cos(slope) - self.on.C_N * np.sin(slope)
        return np.asarray((self.within[0] <= along) & (along <= self.within[1]))

    def _beyond(self, steepest: Array, lever: Array) -> Array:
        """How far the centroid may move towards the end [m]."""
        g, C_N, a = STANDARD_GRAVITY, self.on.C_N, self.a
        return np.asarray(lever - C_N * (np.tan(steepest) + a / (g * np.cos(steepest))))

    def _rise(self, steepest: Array, settled: Array, lever: Array) -> Array:
        """Rise of the centroid on its way over the pivot [m]."""
        rise = edge_energy(x=lever, slope=0.0, C_N=self.on.C_N, theta_s=settled, psi=0.0, a=self.a)
        return np.asarray(np.where(self._beyond(steepest, lever) > 0, rise, 0.0))

    def _freed(self, i: int, before: Array, s: tuple[Array, Array], turn: Array) -> Array:
        """What rocking about a nosing frees of the centroid's height as nosing i is lost [m]."""
        L, C_L, C_N = self.on
        r, along = i + 1, L - C_L
        arm = (
            self.x[i] + along * np.cos(before) - C_N * np.sin(before) - s[0],
            self.z[i] + along * np.sin(before) + C_N * np.cos(before) - s[1],
        )
        new = (
            np.cos(turn) * arm[0] - np.sin(turn) * arm[1],
            np.sin(turn) * arm[0] + np.cos(turn) * arm[1],
        )
        drop = np.maximum(arm[1] - new[1], 0.0)
        far = (s[0] + new[0] - self.x[r], s[1] + new[1] - self.z[r])
        k2 = self.gyration**2
        shared = np.maximum(k2 + new[0] * far[0] + new[1] * far[1], 0.0)
        inertias = (k2 + new[0] ** 2 + new[1] ** 2) * (k2 + far[0] ** 2 + far[1] ** 2)
        return np.asarray(shared**2 / inertias * drop)

    def _margin(self, steepest: Array, lever: Array) -> Array:
        g, C_N, a = STANDARD_GRAVITY, self.on.C_N, self.a
        ratio = C_N * a / (g * np.hypot(lever, C_N))
        centroid = self._beyond(steepest, lever)
        limit = np.arccos(np.clip(ratio, -1.0, 1.0)) - np.arctan2(C_N, lever)
        none = np.copysign(math.pi / 2, centroid)
        return np.asarray(np.where(np.abs(ratio) > 1, none, limit - steepest))

    def _apart(self, i: int, k: int) -> Array:
        return np.asarray(np.hypot(self.x[k] - self.x[i], self.z[k] - self.z[i]))

    def _slope(self, i: int, k: int) -> Array:
        return np.asarray(np.arctan2(self.z[k] - self.z[i], self.x[k] - self.x[i]))

    def _steepest(self, i: int, reach: Array) -> tuple[Array, NDArray[np.int64]]:
        """Steepest chord to a nosing within reach ahead, and which; i itself: there is none."""
        best, which = np.full(reach.shape, -np.inf), np.full(reach.shape, i)
        for k in range(i + 1, len(self.x)):
            if (self.x[k] - self.x[i] > reach).all():
                break
            slope = self._slope(i, k)
            better = (self._apart(i, k) <= reach + ROUNDING) & (slope > best + 1e-15)
            best, which = np.where(better, slope, best), np.where(better, k, which)
        return np.where(which > i, best, 0.0), which

    def _under_the_end(self, r: int, reach: Array) -> Array:
        """Inclination with the round end beyond the flat on a nosing; minus infinity: on none."""
        steepest = np.full(reach.shape, -np.inf)
        rho, gamma = np.hypot(reach, self.R), np.arctan2(self.R, reach)
        for k in range(r + 1, len(self.x)):
            D = self._apart(r, k)
            touches = (reach + ROUNDING < D) & (rho + self.R >= D)
            if not touches.any():
                if (rho + self.R < D).all():
                    break
                continue
            cosine = (rho * rho + D * D - self.R**2) / (2 * rho * D)
            touches &= np.abs(cosine) <= 1
            slope = self._slope(r, k) - gamma + np.arccos(np.clip(cosine, -1.0, 1.0))
            steepest = np.where(touches, np.maximum(steepest, slope), steepest)
        return steepest


def _least(so_far: Array, one: Array, counts: Bools) -> Array:
    return np.asarray(np.where(counts, np.minimum(so_far, one), so_far))


def _most(so_far: Array, one: Array, counts: Bools) -> Array:
    return np.asarray(np.where(counts, np.maximum(so_far, one), so_far))


def _mean_slope(x: Array, z: Array) -> Array:
    """Slope of the line through the first and the last nosing of each draw [rad]."""
    return np.asarray(np.arctan2(z[-1] - z[0], x[-1] - x[0]))


def _seesaw(x: Array, z: Array, on: DrawnTread, a: float) -> Array:
    """Largest rocking about a nosing that the gravity line passes, of each draw."""
    most, theta_s = np.zeros(x.shape[1]), _mean_slope(x, z)
    for k in range(1, len(x) - 1):
        theta = np.arctan2(z[k + 1] - z[k - 1], x[k + 1] - x[k - 1])
        foot = on.C_L + on.C_N * (np.tan(theta) + a / (STANDARD_GRAVITY * np.cos(theta)))
        ahead = _extreme(x, z, k, foot, 1)
        behind = -_extreme(x, z, k, on.L - foot, -1)
        known = np.isfinite(ahead) & np.isfinite(behind)
        rocks = rocking(turn=behind - ahead, before=behind, after=ahead, theta_s=theta_s)
        most = np.where(known, np.maximum(most, rocks), most)
    return most


def _extreme(x: Array, z: Array, k: int, reach: Array, step: int) -> Array:
    """Largest slope of a chord from nosing k ahead; minus the least of one from behind."""
    found = np.full(reach.shape, -np.inf)
    near = np.ones(reach.shape, dtype=np.bool_)
    for j in range(k + step, len(x) if step > 0 else -1, step):
        near &= np.abs(x[j] - x[k]) <= reach
        if not near.any():
            break
        slope = np.arctan2(step * (z[j] - z[k]), step * (x[j] - x[k]))
        within = near & (np.hypot(x[j] - x[k], z[j] - z[k]) <= reach)
        found = np.where(within, np.maximum(found, step * slope), found)
    return found
