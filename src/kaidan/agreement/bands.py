"""How far apart two models may be, and why: bands as data."""

import math
from typing import NamedTuple

import numpy as np

SAME_FORMULA = math.degrees(1e-6)
"""The criterion of no rotation on poses against its closed form [deg]: rounding and the solver's
tolerance."""
SLIP = 0.3
"""Slope at which a belt begins to slide against the angle of friction [deg]: the acceptance of the
physics models has 0.2, and the search another 0.1."""
NOT_TURNED = 0.05
"""Turn below which a robot has not turned [deg]: a tenth of what a trial's contacts give."""

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
figures and ends of 60 mm, smooth belt (docs/physics.md)."""
OTHERS = 1.3
"""Times that for any robot: at 100 mm/s Absolem has 1.2 deg, OzBot 0.7, Marmotte 0.3."""


class Band(NamedTuple):
    """Range within which a difference is expected."""

    low: float
    high: float
    unit: str
    reason: str

    def holds(self, value: float) -> bool:
        """Whether a difference lies within it."""
        return self.low <= value <= self.high


def falling(speed: float) -> float | None:
    """Largest expected excess of a trial over the contact model [deg]; None beyond the data.

    Parameters
    ----------
    speed : float
        [m/s]

    Examples
    --------
    >>> round(falling(0.1), 2), falling(0.4)
    (1.43, None)
    """
    speeds, excess = np.array(FALLING).T
    if speed > speeds[-1]:
        return None
    return OTHERS * float(np.interp(speed, speeds, excess))


def grade_one() -> Band:
    """Criterion of no rotation on poses less closed form."""
    return Band(
        -SAME_FORMULA,
        SAME_FORMULA,
        "deg",
        "one criterion, once as a formula and once on poses: 1e-6 rad",
    )


def caught(radius: float) -> Band:
    """Steepest flight on which a turned robot is caught, less that on which it does not turn."""
    return Band(
        -0.01,
        math.inf,
        "deg",
        "other questions: where turning begins, and where nothing catches it any more; the end of "
        f"{1e3 * radius:.0f} mm keeps resting on the nosing it leaves, and the tail may land on "
        "the step below",
    )


def steepest(speed: float, resolution: float) -> Band | None:
    """Steepest flight of the trial less that of the contact model; None beyond the data."""
    excess = falling(speed)
    if excess is None:
        return None
    room = 0.1 + resolution
    return Band(
        -room,
        excess + room,
        "deg",
        f"falling takes time while the robot drives on: up to {excess:.1f} deg at {speed:g} m/s, "
        f"and {room:.1f} deg for both searches",
    )


def turn(contact: float) -> Band:
    """Largest extra inclination of the trial less that of the contact model [deg]."""
    return Band(
        -contact - 0.1,
        0.5 * contact + 0.5,
        "deg",
        "a trial may drive on before the turn is complete, or overshoot it by half",
    )


def friction(turned: float) -> Band:
    """Angle of the friction that a trial needs, less the slope [deg]."""
    return Band(
        -SLIP,
        turned + SLIP,
        "deg",
        f"{SLIP:g} deg for the trial's search, and the angle by which the robot turns",
    )


def friction_of_poses(turned: float) -> Band:
    """Angle of the friction that the contact model needs, less the slope [deg]."""
    if turned < NOT_TURNED:
        return Band(-1e-4, 1e-4, "deg", "all nosings press on one plane")
    return Band(
        -math.inf,
        math.inf,
        "deg",
        "while it is turned, contacts on the round end press on other planes: no bound",
    )
