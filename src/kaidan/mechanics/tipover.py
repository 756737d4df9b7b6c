r"""Angle and time left before a robot on stairs tips over, after Liu & Liu 2009.

::

              C
             /|\          angle between the resultant of weight and inertia (the plumb line at
            / | \         a = 0) and the line to the contact over which the robot would turn
    t_0 ---o  |  o--- t_n
              v
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.plane import contact_count, lowest_contact

Array = NDArray[np.float64]

_CELLS = 64
_FINE = 1e-9
"""How finely a time is found [s]."""


def tip_angle_downhill(
    *,
    x_0: Number,
    C_L: Number,
    C_N: Number,
    phi: Number,
    a: Number,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Angle from the resultant to the line from the centroid to the lowest contact.

    ``atan2(x_0 - C_L, C_N) - atan2(g sin(phi) + a, g cos(phi))``

    At a = 0 the slope that is left before the robot tips over that contact.

    Assumptions: rigid robot; the body's turning does not accelerate.

    Parameters
    ----------
    x_0 : float or array
        Lowest contact behind the uphill tip of the flat [m].
    phi : float or array
        Inclination of the body [rad], uphill end up positive.
    a : float or array
        Acceleration along the track [m/s^2], up the stairs positive.

    Returns
    -------
    float or array
        Angle [rad], positive when safe.

    Examples
    --------
    >>> angle = tip_angle_downhill(x_0=0.3, C_L=0.2, C_N=0.1, phi=0.0, a=10.0, g=10.0)
    >>> print(round(angle, 12))
    0.0

    References
    ----------
    After Liu & Liu 2009, IEEE/ASME Trans. Mechatronics 14(5), pp. 528-538, derived anew; the angle
    of `kaidan.mechanics.measures.force_angle_measure`.
    """
    return np.arctan2(x_0 - C_L, C_N) - np.arctan2(g * np.sin(phi) + a, g * np.cos(phi))


def tip_angle_uphill(
    *,
    x_n: Number,
    C_L: Number,
    C_N: Number,
    phi: Number,
    a: Number,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Angle from the resultant to the line from the centroid to the highest contact.

    ``atan2(C_L - x_n, C_N) + atan2(g sin(phi) + a, g cos(phi))``

    Assumptions: those of `tip_angle_downhill`.

    Parameters
    ----------
    x_n : float or array
        Highest contact behind the uphill tip of the flat [m].
    phi : float or array
        Inclination of the body [rad], uphill end up positive.
    a : float or array
        Acceleration along the track [m/s^2], up the stairs positive.

    Returns
    -------
    float or array
        Angle [rad], positive when safe.

    Examples
    --------
    >>> angle = tip_angle_uphill(x_n=0.1, C_L=0.2, C_N=0.1, phi=0.0, a=-10.0, g=10.0)
    >>> print(round(angle, 12))
    0.0

    References
    ----------
    After Liu & Liu 2009, see `tip_angle_downhill`.
    """
    return np.arctan2(C_L - x_n, C_N) + np.arctan2(g * np.sin(phi) + a, g * np.cos(phi))


class Motion(NamedTuple):
    """What goes on as it does until the horizon."""

    phi: float
    """Inclination, uphill end up positive [rad]."""
    rate: float
    """Its rate [rad/s]."""
    a: float
    """Acceleration up the stairs [m/s^2]."""
    position: float = math.nan
    """Way up the stairs, 0 where a nosing meets the uphill tip [m]; NaN: not known."""
    speed: float = 0.0
    """Speed up the stairs [m/s]."""


class Outlook(NamedTuple):
    """Robot on regular nosings, whose angles left now and later are to be known."""

    L: float
    """Length of the flat underside [m]."""
    C_L: float
    """Centroid behind the uphill tip [m]."""
    C_N: float
    """Centroid above the underside [m]."""
    p: float
    """Nosing spacing [m], at most L / 2."""

    def contacts(self, motion: Motion, tau: Array) -> tuple[Array, Array]:
        """Lowest and highest contact behind the uphill tip at times from now [m].

        Without a position the worst there is: the lowest nosing has just left, the next one uphill
        is just about to be met.
        """
        if math.isnan(motion.position):
            return np.full_like(tau, self.L - self.p), np.full_like(tau, self.p)
        d = np.mod(motion.position + motion.speed * tau, self.p)
        return np.asarray(lowest_contact(d=d, L=self.L, p=self.p)), d

    def angles(self, motion: Motion, tau: Array) -> tuple[Array, Array]:
        """Angles left downhill and uphill at times from now [rad], each of the shape of tau [s]."""
        lowest, highest = self.contacts(motion, tau)
        phi = motion.phi + motion.rate * tau
        felt = {"C_L": self.C_L, "C_N": self.C_N, "phi": phi, "a": motion.a}
        return (
            np.asarray(tip_angle_downhill(x_0=lowest, **felt)),
            np.asarray(tip_angle_uphill(x_n=highest, **felt)),
        )

    def time_to_tip(self, motion: Motion, horizon: float) -> float:
        """Time until an angle is used up [s]; 0 if it is, inf if not within the horizon [s]."""
        tau = self._times(motion, horizon)
        used_up = np.minimum(*self.angles(motion, tau)) <= 0
        if not used_up.any():
            return math.inf
        first = int(np.argmax(used_up))
        if first == 0:
            return 0.0
        low, high = float(tau[first - 1]), float(tau[first])
        while high - low > _FINE:
            middle = (low + high) / 2
            if np.minimum(*self.angles(motion, np.array([middle])))[0] <= 0:
                high = middle
            else:
                low = middle
        return high

    def _times(self, motion: Motion, horizon: float) -> Array:
        """Times at which to look: evenly, and where a contact comes or goes."""
        even = np.linspace(0.0, horizon, _CELLS + 1)
        if motion.speed == 0.0 or math.isnan(motion.position):
            return even
        ends = (motion.position, motion.position + motion.speed * horizon)
        low, high = min(ends), max(ends)
        if (high - low) / self.p > _CELLS:  # faster than any robot on stairs: evenly will do
            return even
        changes = []
        for place in (0.0, self.L - float(contact_count(L=self.L, p=self.p)) * self.p):
            first, last = (low - place) / self.p, (high - place) / self.p
            k = np.arange(math.ceil(first), math.floor(last) + 1)
            changes.append((k * self.p + place - motion.position) / motion.speed)
        at = np.concatenate(changes)
        times = np.concatenate([even, at, at - _FINE, at + _FINE])
        return np.unique(times[(times >= 0) & (times <= horizon)])
