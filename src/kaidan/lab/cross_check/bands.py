"""How far apart two models may be, and why: bands as data."""

import math

import numpy as np

from kaidan.answer import Part
from kaidan.lab.cross_check import sentences as said

SAME_FORMULA = math.degrees(1e-6)
"""The static criterion on poses against its closed form [deg]: rounding and the solver's
tolerance."""
SLIP = 0.3
"""Slope at which a belt begins to slide against the angle of friction [deg]: the acceptance of the
physics models has 0.2, and the search another 0.1."""
UPRIGHT = 0.05
"""Extra inclination below which a robot does not rotate [deg]: a tenth of what a trial's contacts
give."""

FALLING: tuple[tuple[float, float], ...] = (
    (0.005, 0.05),
    (0.010, 0.05),
    (0.020, 0.25),
    (0.050, 0.6),
    (0.100, 1.1),
    (0.200, 3.1),
)
"""By how much [deg] a trial climbs steeper flights than the contact model at a speed [m/s], because
falling takes time while the robot drives on: the most over 150, 180, 200 and 220 mm with Kenaf's
figures and ends of 60 mm, smooth belt (docs/lab/physics.md)."""
OTHERS = 1.3
"""Times that for any robot: at 100 mm/s Absolem has 1.2 deg, OzBot 0.7, Marmotte 0.3."""


class Band(Part):
    """Range within which a difference is expected."""

    low_deg: float | None
    """Least [deg]; null: no bound."""
    high_deg: float | None
    """Most [deg]; null: no bound."""
    reason: str
    """Why it is so wide."""

    def holds(self, value: float) -> bool:
        """Whether a difference lies within it."""
        above = self.low_deg is None or self.low_deg <= value
        return above and (self.high_deg is None or value <= self.high_deg)


def falling(speed: float) -> float | None:
    """Largest expected excess of a trial over the contact model [deg]; None beyond the data.

    speed: [m/s]

    Examples
    --------
    >>> round(falling(0.1), 2), falling(0.4)
    (1.43, None)
    """
    speeds, excess = np.array(FALLING).T
    if speed > speeds[-1]:
        return None
    return OTHERS * float(np.interp(speed, speeds, excess))


def static_criterion() -> Band:
    """Static criterion on poses less closed form."""
    return Band(low_deg=-SAME_FORMULA, high_deg=SAME_FORMULA, reason=said.one_criterion())


def arrested(radius: float) -> Band:
    """Steepest flight on which a rotation is arrested, less that on which there is none.

    radius: of the end of the track [m].
    """
    return Band(low_deg=-0.01, high_deg=None, reason=said.other_limits(radius))


def steepest(speed: float, resolution: float) -> Band | None:
    """Steepest flight of the trial less that of the contact model; None beyond the data."""
    excess = falling(speed)
    if excess is None:
        return None
    room = 0.1 + resolution
    reason = said.falling_takes_time(excess, speed, room)
    return Band(low_deg=-room, high_deg=excess + room, reason=reason)


def extra(contact: float) -> Band:
    """Largest extra inclination of the trial less that of the contact model [deg]."""
    return Band(low_deg=-contact - 0.1, high_deg=0.5 * contact + 0.5, reason=said.rotates_late())


def friction(inclined: float) -> Band:
    """Angle of the friction that a trial requires, less the slope [deg]."""
    return Band(low_deg=-SLIP, high_deg=inclined + SLIP, reason=said.search_and_rotation(SLIP))


def friction_of_poses(inclined: float) -> Band:
    """Angle of the friction that the contact model requires, less the slope [deg]."""
    if inclined < UPRIGHT:
        return Band(low_deg=-1e-4, high_deg=1e-4, reason=said.one_plane())
    return Band(low_deg=None, high_deg=None, reason=said.other_planes())
