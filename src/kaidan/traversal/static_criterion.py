"""The paper's criterion of no rotation on nosings of any shape, and how far a robot rocks on them.

::

                                   s  o--          flat of length L on nosings i and s; as its
                          r  o----'                downhill tip leaves i the robot rotates about s
          downhill   i  o--'                       until r carries too: that is the rocking. It
             tip   ----'                           tips beyond that about r, the last pivot left.

Every nosing under the flat counts, with no tolerance. Each loss of a nosing is judged with both
inclinations, before and after it: on uneven nosings the flat may still stand on a high one as its
tip leaves, steeper than where it would settle. The uphill end is the mirror image. On nosings all
alike it is the closed form: docs/theory/uneven.md derives it, and how much of a turn is rocking.
"""

import math
from functools import lru_cache
from itertools import pairwise, takewhile

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.oblique_support import edge_energy
from kaidan.mechanics.rocking import rocking
from kaidan.traversal.criterion import NO_SEESAW, Criterion, Loss, Seesaw, Tread

Array = NDArray[np.float64]

ROUNDING = 1e-12
"""Length that is rounding [m]."""


def static_criterion(nosings: Array, tread: Tread, *, acceleration: float = 0.0) -> Criterion:
    """Judge every nosing that an end of the flat leaves or meets wholly on a flight.

    nosings, shape (n, 2): from bottom to top: x uphill, z up [m].
    acceleration: up the stairs [m/s^2].
    """
    return _of_nosings(np.ascontiguousarray(nosings).tobytes(), tread, acceleration)


@lru_cache(maxsize=64)
def _of_nosings(table: bytes, tread: Tread, acceleration: float) -> Criterion:
    """The same, remembered: most postures leave the flat as it is."""
    nosings = np.frombuffer(table).reshape(-1, 2)
    losses: list[Loss] = []
    tops: list[float] = []
    seesaws = [NO_SEESAW]
    for first, last in flights_of(nosings, tread.L):
        flight = nosings[first : last + 1]
        tops.append(float(flight[-1, 0]))
        losses += _losses(flight, tread, acceleration, first, downhill=True)
        mirrored = flight[::-1] * np.array([-1.0, 1.0])
        losses += _losses(mirrored, tread.mirrored(), -acceleration, last, downhill=False)
        seesaws += _seesaws(flight, tread, acceleration)
    turns, rocks = zip(*seesaws, strict=True)
    return Criterion(tuple(losses), Seesaw(max(turns), max(rocks)), tuple(tops))


def flights_of(nosings: Array, L: float) -> list[tuple[int, int]]:
    """First and last nosing of each run without a landing in between."""
    if len(nosings) < 2:
        return []
    along, up = (nosings[1:] - nosings[:-1]).T
    cuts = [-1, *np.flatnonzero(np.hypot(along, up) >= L).tolist(), len(nosings) - 1]
    return [(a + 1, b) for a, b in pairwise(cuts) if b > a + 1]


def mean_slope(nosings: Array) -> float:
    """Slope of the line through the first and the last nosing of a flight [rad]."""
    along, up = nosings[-1] - nosings[0]
    return math.atan2(up, along)


def _losses(P: Array, tread: Tread, a: float, number: int, *, downhill: bool) -> list[Loss]:
    """Losses and gains judged at the tip that lies towards -x, of nosings in order of x."""
    x, z = P.T.tolist()
    losses = []
    end, theta_s = x[-1], mean_slope(P)
    for i in range(len(x) - 2):
        before = _steepest(x, z, i, tread.L)
        assert before is not None  # the next nosing of a flight is within reach
        landing = x[i] + tread.L * math.cos(before[0]) > end + 1e-9
        r = i + 1
        left = tread.L - math.dist((x[i], z[i]), (x[r], z[r]))
        foot = left - tread.C_L - tread.C_N * math.tan(before[0])
        if landing and (not downhill or foot >= math.dist((x[r], z[r]), (x[-1], z[-1]))):
            break  # the centroid has passed the last nosing: the end comes down on the landing
        after = _settled(x, z, r, left, tread.R)
        slope, contacts = (before[0], 1) if after is None else after
        turn, stands, freed = _turning(x, z, i, before[1], tread)
        losses.append(
            _loss(
                max(slope, before[0]),
                left - tread.C_L,
                slope,
                turn,
                float(rocking(turn=turn, before=before[0], after=stands, theta_s=theta_s)),
                freed,
                contacts,
                tread,
                a,
                number + i if downhill else number - i,
                downhill,
                landing,
                _com(x, z, i, before[0], tread)[0],
            )
        )
    losses += _gains(x, z, tread, a, number, downhill)
    return losses


def _gains(
    x: list[float], z: list[float], tread: Tread, a: float, number: int, downhill: bool
) -> list[Loss]:
    """The same just before the far tip meets a nosing, the last one still short of it."""
    losses = []
    for m in range(2, len(x)):
        r = m - 1
        while r > 0 and math.dist((x[r - 1], z[r - 1]), (x[m], z[m])) <= tread.L + ROUNDING:
            r -= 1
        if r == 0 or r == m - 1:
            continue  # its other end is not on the flight, or nothing carries between
        left = math.dist((x[r], z[r]), (x[m], z[m]))
        slope = max(_slope(x, z, r, k) for k in range(r + 1, m))
        losses.append(
            _loss(
                slope,
                left - tread.C_L,
                slope,
                0.0,
                0.0,
                0.0,
                m - r,
                tread,
                a,
                number + m if downhill else number - m,
                downhill,
                False,
                x[m] - tread.C_L * math.cos(slope) - tread.C_N * math.sin(slope),
            )
        )
    return losses


def _loss(
    steepest: float,
    lever: float,
    settled: float,
    turn: float,
    rocks: float,
    freed: float,
    contacts: int,
    tread: Tread,
    a: float,
    nosing: int,
    downhill: bool,
    landing: bool,
    place: float,
) -> Loss:
    g, C_N = STANDARD_GRAVITY, tread.C_N
    ratio = C_N * a / (g * math.hypot(lever, C_N))
    limit = math.nan if abs(ratio) > 1 else math.acos(ratio) - math.atan2(C_N, lever)
    centroid = lever - C_N * (math.tan(steepest) + a / (g * math.cos(steepest)))
    if math.isnan(limit):
        limit = math.copysign(math.pi / 2, centroid) + steepest
    rise = 0.0
    if centroid > 0:
        rise = float(edge_energy(x=lever, slope=0.0, C_N=C_N, theta_s=settled, psi=0.0, a=a))
    return Loss(
        downhill,
        nosing,
        steepest,
        lever,
        limit - steepest,
        centroid,
        turn,
        rocks,
        rise,
        freed,
        contacts,
        landing,
        place if downhill else -place,
    )


def _slope(x: list[float], z: list[float], i: int, k: int) -> float:
    return math.atan2(z[k] - z[i], x[k] - x[i])


def _steepest(x: list[float], z: list[float], i: int, reach: float) -> tuple[float, int] | None:
    """Steepest chord from a nosing to one within reach ahead, and which; None: there is none."""
    best: tuple[float, int] | None = None
    for k in range(i + 1, len(x)):
        if x[k] - x[i] > reach:
            break
        if math.dist((x[i], z[i]), (x[k], z[k])) > reach + ROUNDING:
            continue
        slope = _slope(x, z, i, k)
        if best is None or slope > best[0] + 1e-15:
            best = slope, k
    return best


def _settled(
    x: list[float], z: list[float], r: int, reach: float, R: float
) -> tuple[float, int] | None:
    """Inclination of the flat on a nosing, and how many nosings lie under it.

    A nosing under the round end beyond the flat raises it too, but never carries it alone.
    """
    on_flat = _steepest(x, z, r, reach)
    if on_flat is None:
        return None
    slope = on_flat[0]
    count = 1
    rho, gamma = math.hypot(reach, R), math.atan2(R, reach)
    for k in range(r + 1, len(x)):
        D = math.dist((x[r], z[r]), (x[k], z[k]))
        if reach + ROUNDING >= D:
            count += 1
        elif rho + R >= D:
            cosine = (rho * rho + D * D - R * R) / (2 * rho * D)
            if abs(cosine) <= 1:
                slope = max(slope, _slope(x, z, r, k) - gamma + math.acos(cosine))
        else:
            break
    return slope, count


def _turning(
    x: list[float], z: list[float], i: int, s: int, tread: Tread
) -> tuple[float, float, float]:
    """How far it turns as nosing i is lost, inclination then, and height freed [rad, rad, m]."""
    before = _slope(x, z, i, s)
    r = i + 1
    if r == s:
        next_one = _steepest(x, z, r, tread.L - math.dist((x[i], z[i]), (x[r], z[r])))
        after = before if next_one is None else next_one[0]
    else:
        after = _slope(x, z, r, s)
    turn = abs(after - before)
    if turn == 0.0:
        return 0.0, after, 0.0
    # the centroid on its circle about s, then the impact on r
    com = _com(x, z, i, before, tread)
    arm = (com[0] - x[s], com[1] - z[s])
    new = _turned(arm, turn if r != s else -turn)
    drop = max(arm[1] - new[1], 0.0)
    far = (x[s] + new[0] - x[r], z[s] + new[1] - z[r])
    k2 = tread.gyration**2
    shared = k2 + new[0] * far[0] + new[1] * far[1]
    kappa = 0.0
    if shared > 0:
        kappa = shared**2 / ((k2 + new[0] ** 2 + new[1] ** 2) * (k2 + far[0] ** 2 + far[1] ** 2))
    return turn, after, kappa * drop


def _com(x: list[float], z: list[float], i: int, slope: float, tread: Tread) -> tuple[float, float]:
    """Centroid with the near tip at nosing i and the flat on a slope."""
    along, up = tread.L - tread.C_L, tread.C_N
    c, s = math.cos(slope), math.sin(slope)
    return x[i] + along * c - up * s, z[i] + along * s + up * c


def _turned(arm: tuple[float, float], angle: float) -> tuple[float, float]:
    c, s = math.cos(angle), math.sin(angle)
    return c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]


def _seesaws(P: Array, tread: Tread, a: float) -> list[Seesaw]:
    """See-saws about the nosings that the gravity line passes."""
    x, z = P.T.tolist()
    theta_s = mean_slope(P)
    found = []
    for k in range(1, len(x) - 1):
        theta = _slope(x, z, k - 1, k + 1)
        foot = tread.C_L + tread.C_N * (math.tan(theta) + a / (STANDARD_GRAVITY * math.cos(theta)))
        ahead = [_slope(x, z, k, j) for j in _within(x, z, k, foot, 1)]
        behind = [_slope(x, z, j, k) for j in _within(x, z, k, tread.L - foot, -1)]
        if ahead and behind:
            before, after = min(behind), max(ahead)
            turn = max(before - after, 0.0)
            rocks = rocking(turn=turn, before=before, after=after, theta_s=theta_s)
            found.append(Seesaw(turn, float(rocks)))
    return found


def _within(x: list[float], z: list[float], k: int, reach: float, step: int) -> list[int]:
    """Nosings on one side of nosing k that are no farther from it than this [m]."""
    side = range(k + step, len(x) if step > 0 else -1, step)
    near = takewhile(lambda j: abs(x[j] - x[k]) <= reach, side)
    return [j for j in near if math.dist((x[k], z[k]), (x[j], z[j])) <= reach]
