"""Stairs from their totals and a few spot checks, with an honest doubt."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Literal

from kaidan.answer import Answer
from kaidan.arguments import known_arguments, several
from kaidan.errors import InputError, shown
from kaidan.mechanics.weighing import (
    combined_uncertainty,
    local_angle_deviation,
    regular_step,
    step_spread,
)
from kaidan.terrain.stairs import Stairs
from kaidan.units import value_of
from kaidan.verbs.weighing import stated_value

TAPE = "2mm"
"""Standard uncertainty of a tape over a whole flight, where nobody states it."""
UNCHECKED = 0.0095 / math.sqrt(12.0)
"""Standard deviation of single steps that nobody checked [m]: evenly within the 9.5 mm that IBC
1011.5.4 allows between the largest and the smallest of a flight."""
ENOUGH = 3
"""Spot checks from which a deviation of their own follows."""
FAR_OFF = 0.02
"""Difference of a spot check from the mean that no flight has [m]."""

Spread = Literal["spot checks", "assumed"]


class StairsMeasurement(Answer):
    """A flight of stairs from its totals, with the doubt of the whole and of single steps."""

    text_module: ClassVar[str] = "kaidan.text.stairs_measurement"

    name: str
    risers: int
    """Number of risers."""
    rise_m: float
    """Mean rise of the regular steps [m]."""
    going_m: float
    """Mean going [m]."""
    first_rise_m: float | None
    """First riser, where it was stated [m]."""
    last_rise_m: float | None
    """Last riser, where it was stated [m]."""
    angle_deg: float
    """Slope of the line through the nosings of the regular steps [deg]."""
    nosing_spacing_m: float
    """Mean distance from nosing to nosing along it [m]."""
    angle_of_totals_deg: float
    """Standard uncertainty of that slope from the totals [deg]."""
    nosing_spacing_of_totals_m: float
    """The same of the nosing spacing [m]."""
    rise_spread_m: float
    """Standard deviation of single rises [m]."""
    going_spread_m: float
    """Standard deviation of single goings [m]."""
    rise_spread_from: Spread
    """Where the deviation of the rises comes from."""
    going_spread_from: Spread
    """Where the deviation of the goings comes from."""
    landings: dict[str, float | str]
    """What was stated of width and landings, by the names of the sheet [m]."""
    angle_of_a_step_deg: float
    """Standard deviation of the slope from one nosing to the next [deg]."""
    notes: tuple[str, ...]
    """What the reader must know."""

    @property
    def figures(self) -> dict[str, float | str]:
        """Figures of a stairs sheet by their dotted names, with their sources."""
        found: dict[str, float | str] = {
            "rise": round(self.rise_m, 5),
            "going": round(self.going_m, 5),
            "steps": self.risers,
            "uncertainty.angle": round(math.radians(self.angle_of_totals_deg), 5),
            "uncertainty.nosing_spacing": round(self.nosing_spacing_of_totals_m, 5),
            "uncertainty.rise": round(self.rise_spread_m, 5),
            "uncertainty.going": round(self.going_spread_m, 5),
        }
        odd = {"first_rise": self.first_rise_m, "last_rise": self.last_rise_m}
        found |= {key: value for key, value in odd.items() if value is not None}
        found |= self.landings
        return found | {f"sources.{key}": said for key, said in self.said("sources").items()}


@known_arguments
def measure_stairs(
    *,
    name: str = "stairs",
    total_rise: Any,
    total_going: Any,
    risers: Any,
    first_rise: Any = None,
    last_rise: Any = None,
    rises: Sequence[Any] = (),
    goings: Sequence[Any] = (),
    u_tape: Any = TAPE,
    width: Any = None,
    lower_turn: Any = None,
    lower_landing: Any = None,
    lower_landing_width: Any = None,
    lower_passage: Any = None,
    lower_leaf: Any = None,
    upper_turn: Any = None,
    upper_landing: Any = None,
    upper_landing_width: Any = None,
    upper_passage: Any = None,
    upper_leaf: Any = None,
) -> StairsMeasurement:
    """Flight of stairs from total rise and going, with the doubt of its angle and its steps.

    Parameters
    ----------
    name : str
        Of the stairs.
    total_rise : float or str
        Lower to upper floor [m]; or a text such as "2.72m", as all of these.
    total_going : float or str
        First to last nosing, level [m].
    risers : int
        Number of risers, the one up to the upper floor included.
    first_rise, last_rise : float or str, optional
        First and last riser, which often differ [m].
    rises, goings : sequence of float or str
        Spot checks of single regular steps [m].
    u_tape : float or str
        Standard uncertainty of the tape [m].
    width, lower_landing, lower_landing_width, lower_passage, lower_leaf, upper_landing, \
upper_landing_width, upper_passage, upper_leaf : float or str, optional
        As in `Stairs` [m].
    lower_turn, upper_turn : str, optional
        "none", "quarter" or "half", as in `Stairs`.

    Raises
    ------
    InputError
        An input without physical meaning, or a spot check that contradicts the totals.

    Examples
    --------
    >>> found = measure_stairs(total_rise="2.72m", total_going="4.2m", risers=16)
    >>> round(found.rise_m, 4), round(found.going_m, 4), round(found.angle_of_totals_deg, 3)
    (0.17, 0.28, 0.022)
    """
    count = _count(risers)
    landings = _landings(
        {
            "width": width,
            "lower_turn": lower_turn,
            "lower_landing": lower_landing,
            "lower_landing_width": lower_landing_width,
            "lower_passage": lower_passage,
            "lower_leaf": lower_leaf,
            "upper_turn": upper_turn,
            "upper_landing": upper_landing,
            "upper_landing_width": upper_landing_width,
            "upper_passage": upper_passage,
            "upper_leaf": upper_leaf,
        }
    )
    stated = {
        "total_rise": total_rise, "total_going": total_going,
        "first_rise": first_rise, "last_rise": last_rise,
    }  # fmt: skip
    at = {
        key: value_of(given, "length", option=key)
        for key, given in stated.items()
        if given is not None or not key.endswith("st_rise")
    }
    tape = stated_value("u_tape", u_tape)
    odd = [key for key in ("first_rise", "last_rise") if key in at]
    regular = count - len(odd)
    if regular < 1:
        raise InputError(f"risers = {count}: no regular riser is left beside the first and last")

    def rise(**a: float) -> float:
        total = sum(a[key] for key in odd)
        return float(regular_step(total=a["total_rise"], odd=total, count=regular))

    def going(**a: float) -> float:
        return float(regular_step(total=a["total_going"], odd=0.0, count=count - 1))

    checks = {
        "rises": [value_of(each, "length", option="rises") for each in several("rises", rises)],
        "goings": [value_of(each, "length", option="goings") for each in several("goings", goings)],
    }
    mean_rise, mean_going = rise(**at), going(**at)
    _agree(checks["rises"], mean_rise, "rise", "the total rise and the number of risers")
    _agree(checks["goings"], mean_going, "going", "the total going and the number of risers")
    flight = Stairs(
        name=name, rise=mean_rise, going=mean_going, steps=count,
        first_rise=at.get("first_rise"), last_rise=at.get("last_rise"), **landings,
    )  # fmt: skip
    s_r, r_from = _spread(checks["rises"], mean_rise)
    s_g, g_from = _spread(checks["goings"], mean_going)
    u = dict.fromkeys(at, tape)
    angle = combined_uncertainty(lambda **a: math.atan2(rise(**a), going(**a)), at, u)
    spacing = combined_uncertainty(lambda **a: math.hypot(rise(**a), going(**a)), at, u)
    slope, p = flight.angle, flight.nosing_spacing
    local = float(local_angle_deviation(theta_s=slope, p=p, s_r=s_r, s_g=s_g))
    return StairsMeasurement(
        name=name,
        risers=count,
        rise_m=mean_rise,
        going_m=mean_going,
        first_rise_m=at.get("first_rise"),
        last_rise_m=at.get("last_rise"),
        angle_deg=math.degrees(slope),
        nosing_spacing_m=p,
        angle_of_totals_deg=math.degrees(angle),
        nosing_spacing_of_totals_m=spacing,
        rise_spread_m=s_r,
        going_spread_m=s_g,
        rise_spread_from=r_from,
        going_spread_from=g_from,
        angle_of_a_step_deg=math.degrees(local),
        landings=landings,
        notes=_notes(odd, r_from, g_from),
    )


def _landings(stated: Mapping[str, Any]) -> dict[str, Any]:
    """What is stated of landings, lengths in metres; the sheet judges turns and ranges."""
    return {
        key: given if key.endswith("_turn") else value_of(given, "length", option=key)
        for key, given in stated.items()
        if given is not None
    }


def _count(risers: Any) -> int:
    if isinstance(risers, bool) or not isinstance(risers, int) or not 3 <= risers <= 10_000:
        raise InputError(f"risers = {shown(risers)} is not a whole number within 3 to 10000")
    return risers


def _agree(checks: Sequence[float], mean: float, what: str, totals: str) -> None:
    """Refuse a spot check that no step of such a flight has: a miscount is seen here."""
    for check in checks:
        if abs(check - mean) > FAR_OFF:
            raise InputError(
                f"{what} check of {1e3 * check:.0f} mm is {1e3 * abs(check - mean):.0f} mm off the "
                f"{1e3 * mean:.0f} mm of {totals}: count the risers again, and state first and "
                "last riser apart"
            )


def _spread(checks: Sequence[float], mean: float) -> tuple[float, Spread]:
    """Deviation of single steps: of enough spot checks, or what nobody checked may have."""
    off = [check - mean for check in checks]
    if len(off) >= ENOUGH:
        return step_spread(differences=off), "spot checks"
    seen = math.sqrt(sum(each**2 for each in off) / len(off)) if off else 0.0
    return max(seen, UNCHECKED), "assumed"


def _notes(odd: Sequence[str], r_from: Spread, g_from: Spread) -> tuple[str, ...]:
    from kaidan.verbs.sentences import measuring as text

    notes = []
    missing = [end for end in ("first", "last") if f"{end}_rise" not in odd]
    if len(missing) == 1:
        notes.append(text.ONE_OF_BOTH.format(end=missing[0]))
    elif missing:
        notes.append(text.FIRST_AND_LAST)
    if "assumed" in (r_from, g_from):
        notes.append(text.UNCHECKED)
    return tuple(notes)
