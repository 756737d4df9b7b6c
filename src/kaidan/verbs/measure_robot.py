"""Mass, length and centroid of a robot from scales, a tape and an angle, with their doubt."""

import math
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments
from kaidan.errors import InputError, shown
from kaidan.mechanics.weighing import (
    combined_uncertainty,
)
from kaidan.robot import Robot
from kaidan.sheet import bounds
from kaidan.spelling import word_of
from kaidan.verbs.weighing import (
    ALONG,
    INPUTS,
    Along,
    End,
    Height,
    Way,
    height_formula,
    mass_formula,
    stated_value,
    way_along,
    way_up,
)

SCALE = "50g"
TAPE = "1mm"
ANGLE = "0.2deg"
"""Standard uncertainty of a scale, of a tape and of a digital level, where nobody states it."""
DISAGREE = 4.0
"""Standard uncertainties by which two sums of the scales may differ."""


class Measured(Part):
    """A figure of the sheet with its doubt."""

    value: float
    """In the unit that the figure's own docstring names."""
    uncertainty: float
    """Standard uncertainty (one sigma), in the same unit."""
    shares: dict[str, float]
    """Share of each input in the square of the uncertainty, the largest first [1]."""


class RobotMeasurement(Answer):
    """Mass, L, C_L and C_N of a robot with their standard uncertainties."""

    text_module: ClassVar[str] = "kaidan.text.robot_measurement"

    name: str
    mass: Measured | None
    """Mass [kg]; null: nothing says it."""
    flat_length: Measured
    """L [m]."""
    com_from_front: Measured
    """C_L, centroid behind the front tip of the flat [m]."""
    com_height: Measured | None
    """C_N, centroid above the underside [m]; null: no slope and no tilt was stated."""
    along: Along
    """How C_L was found."""
    height: Height | None
    """How C_N was found."""
    over: End | None
    """End on which it balanced or tipped."""
    inputs: dict[str, float]
    """What was stated, SI: masses [kg], lengths [m], angles [rad]."""
    radii_m: tuple[float | None, float | None]
    """Front and rear end radius, where stated [m]."""
    notes: tuple[str, ...]
    """What the reader must know."""

    @property
    def figures(self) -> dict[str, float | str]:
        """Figures of a robot's sheet by their dotted names, with the sources of those measured."""
        found: dict[str, float | str] = {}
        said: dict[str, float | str] = {}
        each = {
            "mass": self.mass,
            "com_from_front": self.com_from_front,
            "com_height": self.com_height,
            "track.flat_length": self.flat_length,
        }
        for name, one in each.items():
            if one is not None:
                found[name] = round(one.value, 4)
                said[f"sources.{name}"] = self.said("source", name)
        for end, radius in zip(("front", "rear"), self.radii_m, strict=True):
            if radius is not None:
                found[f"track.{end}_radius"] = radius
                said[f"sources.track.{end}_radius"] = self.said("source", "radius")
        for name in ("com_from_front", "com_height", "track.flat_length"):
            one = each[name]
            if one is not None:
                found[f"uncertainty.{name.rpartition('.')[2]}"] = round(one.uncertainty, 5)
        return found | said


@known_arguments
def measure_robot(
    *,
    name: str = "robot",
    flat_length: Any,
    front_scale: Any = None,
    rear_scale: Any = None,
    balance: Any = None,
    mass: Any = None,
    slope: Any = None,
    front_on_slope: Any = None,
    rear_on_slope: Any = None,
    tips_at: Any = None,
    over: End = "rear",
    on: Way = "end",
    front_radius: Any = None,
    rear_radius: Any = None,
    front_inset: Any = 0.0,
    rear_inset: Any = 0.0,
    u_scale: Any = SCALE,
    u_tape: Any = TAPE,
    u_angle: Any = ANGLE,
) -> RobotMeasurement:
    """Mass, length and centroid of a robot, with standard uncertainties.

    Along the track from two scales (`front_scale`, `rear_scale`) or a `balance` point; the height
    from the scales again on a known `slope`, or from the inclination `tips_at` at which it tips.

    Parameters
    ----------
    name : str
        Of the robot.
    flat_length : float or str
        Flat underside, L [m]; or a text such as "620mm", as all of these.
    front_scale, rear_scale : float or str, optional
        What the scales under the front and the rear of the flat show, robot level [kg].
    balance : float or str, optional
        Balance point on an edge, robot level, behind the front tip of the flat [m].
    mass : float or str, optional
        Mass [kg], where one scale weighed the whole robot.
    slope : float or str, optional
        Inclination of the flat at the second weighing, nose up positive [rad].
    front_on_slope, rear_on_slope : float or str, optional
        What the scales show then [kg].
    tips_at : float or str, optional
        Inclination of the flat at which it balances on one end, or tips over it [rad].
    over : {"rear", "front"}
        End on which.
    on : {"end", "ramp"}
        Balanced by hand on its round end, or tipped on a ramp that grew steeper.
    front_radius, rear_radius : float or str, optional
        Radius of the ends, belt included [m].
    front_inset, rear_inset : float or str
        Supports of the scales inward of the tips of the flat [m].
    u_scale, u_tape, u_angle : float or str
        Standard uncertainty of what a scale [kg], a tape [m] and a level [rad] show.

    Raises
    ------
    InputError
        An input without physical meaning, too few of them, or some that contradict each other.

    Examples
    --------
    >>> found = measure_robot(flat_length=0.5, front_scale=12.0, rear_scale=8.0, slope="20deg",
    ...                       front_on_slope=10.544, rear_on_slope=9.456)
    >>> round(found.com_from_front.value, 4), round(found.com_height.value, 4)
    (0.2, 0.1)
    """
    stated = {
        "flat_length": flat_length,
        "front_scale": front_scale,
        "rear_scale": rear_scale,
        "balance": balance,
        "mass": mass,
        "slope": slope,
        "front_on_slope": front_on_slope,
        "rear_on_slope": rear_on_slope,
        "tips_at": tips_at,
        "front_radius": front_radius,
        "rear_radius": rear_radius,
        "front_inset": front_inset,
        "rear_inset": rear_inset,
    }
    tools = {
        "scale": stated_value("u_scale", u_scale),
        "tape": stated_value("u_tape", u_tape),
        "angle": stated_value("u_angle", u_angle),
    }
    if not isinstance(name, str):
        raise InputError(f"name = {shown(name)} is not a text")
    needed = {"flat_length", "front_inset", "rear_inset"}
    at = {
        key: stated_value(key, given)
        for key, given in stated.items()
        if given is not None or key in needed
    }
    over, on = word_of("over", over, ("front", "rear")), word_of("on", on, ("end", "ramp"))
    along = way_along(at)
    height = way_up(at, over, on)
    u = {key: tools[INPUTS[key].tool] for key in at}
    for key in ("front_inset", "rear_inset"):
        if at[key] == 0.0:  # a support that stands at the tip as well as one can see
            u[key] = tools["tape"]
    weight = mass_formula(at)
    place = ALONG[along]
    raised = None if height is None else height_formula(height, over, place)
    found = RobotMeasurement(
        name=name,
        mass=None if weight is None else _measured(weight, at, u),
        flat_length=_measured(lambda **a: a["flat_length"], at, u),
        com_from_front=_measured(place, at, u),
        com_height=None if raised is None else _measured(raised, at, u),
        along=along,
        height=height,
        over=over if height in ("balanced on its end", "tipped on a ramp") else None,
        inputs=at,
        radii_m=(at.get("front_radius"), at.get("rear_radius")),
        notes=_notes(at, tools["scale"]),
    )
    _plausible(found)
    return found


def _measured(
    formula: Callable[..., float], at: Mapping[str, float], u: Mapping[str, float]
) -> Measured:
    alone = {key: combined_uncertainty(formula, at, {key: each}) for key, each in u.items()}
    whole = math.sqrt(sum(each**2 for each in alone.values()))
    shares = {key: (each / whole) ** 2 for key, each in alone.items() if each > 0}
    largest = sorted(shares, key=lambda key: -shares[key])
    return Measured(
        value=formula(**at), uncertainty=whole, shares={key: shares[key] for key in largest}
    )


def _notes(at: Mapping[str, float], u_scale: float) -> tuple[str, ...]:
    """Sums of the scales that differ by more than the scales do."""
    from kaidan.verbs.sentences.measuring import sums_differ

    pairs = (("front_scale", "rear_scale"), ("front_on_slope", "rear_on_slope"), ("mass",))
    sums = [sum(at[key] for key in pair) for pair in pairs if all(key in at for key in pair)]
    least, most = min(sums, default=0.0), max(sums, default=0.0)
    allowed = DISAGREE * 2 * u_scale
    return (sums_differ(least, most),) if most - least > allowed else ()


def _plausible(found: RobotMeasurement) -> None:
    """Refuse what no robot is: front and rear exchanged, a slope that was none."""
    at, L = found.com_from_front.value, found.flat_length.value
    reach = max(*(radius or 0.0 for radius in found.radii_m), 0.3)
    if not -reach <= at <= L + reach:
        raise InputError(
            f"com_from_front = {1e3 * at:.0f} mm: the centroid is not above a flat of "
            f"{1e3 * L:.0f} mm; front and rear may be exchanged"
        )
    if found.com_height is None:
        return
    _, low, high = bounds(Robot.model_fields["com_height"])
    if not low <= found.com_height.value <= high:
        hint = (
            "nose up, the rear scale must show more than on the level"
            if found.height == "scales on a slope"
            else "the balance point and the angle contradict each other"
        )
        raise InputError(
            f"com_height = {1e3 * found.com_height.value:.0f} mm is not within "
            f"{1e3 * low:g} to {1e3 * high:g} mm: {hint}"
        )
