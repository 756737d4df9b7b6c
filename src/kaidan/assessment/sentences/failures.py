"""What happens, one sentence for each failure mode that has one of its own."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from kaidan.models.sentences import dynamic, terrain, traction, turning, unweighed
from kaidan.modes import FAILURE_MODES, SUPPLIES, Verdict
from kaidan.terrain import sentences as gaps
from kaidan.words import place

if TYPE_CHECKING:
    from kaidan.assessment.verdict import Conclusion
    from kaidan.models.contact_figures import RotationFigures
    from kaidan.models.findings import Finding, Findings
    from kaidan.question import Question

Saying = Callable[["Question", "Findings", "Conclusion", "Finding"], str]


def at(conclusion: "Conclusion") -> str:
    """Where on the way it happens: phase and step."""
    return place(conclusion.phase, conclusion.step)


def of_friction(
    question: "Question", found: "Findings", conclusion: "Conclusion", known: str
) -> str:
    """Friction that is required beside what is known of it."""
    needed = found.required_friction
    required = f"{needed:.2f} is required, " if math.isfinite(needed) else "none is enough, "
    if math.isnan(needed):
        required = ""
    held = figures_with(found, "usual_required_friction")
    if held is not None and math.isfinite(needed):
        required = f"{traction.required(held, f'{needed:.2f} is required')}, "
    decides = FAILURE_MODES.get(conclusion.governs) in (None, *SUPPLIES)
    does = "decides" if decides else "is in doubt too"
    return f"Friction {does}{at(conclusion)}: {required}{known}."


def _slides(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    trials = figure_of(found, "trials")
    if trials is not None:
        return dynamic.sliding(trials, at(conclusion))
    low, high = question.friction
    stated = f"{low:.2f}" if low == high else f"{low:.2f} to {high:.2f}"
    return of_friction(question, found, conclusion, f"{stated} is stated")


def _tips(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    label = finding.mode.label.removeprefix("tipping ")
    margin, best = (
        math.degrees(finding.margin(question.risk, best=which)) for which in (False, True)
    )
    if best > 0:
        return (
            f"The margin against tipping {label} is {margin:+.1f} to {best:+.1f} deg, by the "
            f"ranges of what is not measured{at(conclusion)}{_to_fall(found)}."
        )
    if math.isnan(best):
        return f"It may fall {label}{at(conclusion)}, by its friction."
    if finding.if_fails.best is Verdict.NO_GO:
        if margin <= -90:
            return f"It falls {label}{at(conclusion)}."
        grades = figure_of(found, "grades")
        does = "falls" if grades is not None and grades.largest_rotation_deg >= 90 else "tips"
        return f"It {does} {label}, {-margin:.1f} deg beyond the limit{at(conclusion)}."
    if figure_of(found, "area") == "E":
        return (
            f"It holds only while the acceleration follows the position (area E); at a constant "
            f"one it tips {label}, {-margin:.1f} deg beyond the limit."
        )
    largest = max(_rotations(found, finding), key=_angle, default=None)
    if largest is not None:
        return _arrested(_angle(largest), "", found, conclusion)
    grades = figure_of(found, "grades")
    arrives = grades is None or grades.arrested
    return (
        f"{'It arrives, but by' if arrives else 'By'} the criterion it tips {label}, {-margin:.1f} "
        f"deg beyond the limit{at(conclusion)}{_to_fall(found)}."
    )


def figures_with(found: "Findings", name: str) -> Any:
    """First of the models' own figures with a figure of a name; None: none has."""
    return next((each for each in found.figures if hasattr(each, name)), None)


def figure_of(found: "Findings", name: str) -> Any:
    """Figure of a name, of the first part that has it; None: no part has."""
    return getattr(figures_with(found, name), name, None)


def _rotations(found: "Findings", finding: "Finding") -> "list[RotationFigures]":
    """Rotations in the phase of a finding that are arrested."""
    rotations = figure_of(found, "rotations") or ()
    return [each for each in rotations if each.arrested and each.phase == finding.phase]


def _angle(each: "RotationFigures") -> float:
    return abs(each.angle_deg)


def _arrested(rotation: float, beyond: str, found: "Findings", conclusion: "Conclusion") -> str:
    digits = 1 if rotation >= 0.1 else 2
    return (
        f"It rocks by {rotation:.{digits}f} deg{beyond} until the next contact arrests it"
        f"{at(conclusion)}{_to_fall(found)}."
    )


def _to_fall(found: "Findings") -> str:
    """How far a robot that rocks is from a fall; nothing of one that falls."""
    tilt = figure_of(found, "tilt")
    if tilt is None or tilt.to_fall_deg is None or tilt.to_fall_deg <= 0:
        return ""
    if tilt.to_fall_deg > 29.95:
        return ", more than 30 deg from falling"
    return f", {tilt.to_fall_deg:.1f} deg from falling"


def _falls(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    label = finding.mode.label.removeprefix("falling ")
    figure = figure_of(found, "tilt")
    tilt = None if figure is None else figure.to_fall_deg
    if tilt is None:  # of several traverses the worst
        tilt = math.degrees(finding.margin(question.risk) + question.reserve)
    reserve = math.degrees(question.reserve)
    if finding.margin(question.risk, best=True) > 0:  # in the worst case only
        if tilt <= 0:
            return f"It may fall {label}{at(conclusion)}, by the ranges of what is not measured."
        return (
            f"It may rock to {tilt:.1f} deg from falling {label}{at(conclusion)}; {reserve:.1f} "
            "deg of reserve must be kept."
        )
    if tilt <= 0:
        return f"It falls {label}{at(conclusion)}."
    return (
        f"It rocks, and is {tilt:.1f} deg from falling {label}{at(conclusion)}: expect a fall, "
        f"because {reserve:.1f} deg of reserve must be kept."
    )


def _rotates(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    free = [each for each in _rotations(found, finding) if not each.obliged]
    if free:
        worst = max(free, key=lambda each: (round(each.rocking_deg, 9), _angle(each)))
        off = worst.beyond_slope_deg
        beyond = "" if off is None else f", to {off:.1f} deg beyond the slope of the flight,"
        return _arrested(_angle(worst), beyond, found, conclusion)
    more = -finding.mode.shown(finding.margin(question.risk))
    return (
        f"Uneven nosings may rock it by {more:.1f} deg more than tracks yield{at(conclusion)}"
        f"{_to_fall(found)}."
    )


def _momentum(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    if finding.margin(question.risk, best=True) <= 0:
        return f"The momentum of its rotation may topple it{at(conclusion)}."
    return (
        f"Only the impact that ends its rotation takes enough momentum to hold it{at(conclusion)}."
    )


def _impact(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    tolerated = question.robot.tolerated_impact
    speed = tolerated - finding.margin(question.risk)
    digits = next(n for n in (1, 2, 3) if n == 3 or f"{speed:.{n}f}" != f"{tolerated:.{n}f}")
    return (
        f"It drops and hits at {speed:.{digits}f} m/s{at(conclusion)}; "
        f"{tolerated:.{digits}f} m/s are tolerated."
    )


def _energy(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    slips = figure_of(found, "slip_heights_mm") or {}
    slip = 0.0 if finding.phase is None else slips.get(finding.phase.value, 0.0)
    height, steady = (1e3 * question.energy_threshold(1e-3 * each) for each in (slip, 0.0))
    margin = 1e3 * finding.margin(question.risk) + height
    of_slip = f", {height - steady:.2f} mm of it of a slip onto its grousers" if slip else ""
    return (
        f"The energy margin of {margin:.2f} mm is below the {height:.2f} mm of a sudden stop or "
        f"start{of_slip}: the robot may rock{at(conclusion)}."
    )


def _belly(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return f"It rests on its belly in places{at(conclusion)}, where the tracks may lose grip."


def _room(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    short = -1e3 * finding.margin(question.risk)
    if any(question.leaves):
        return f"A landing, less the leaf of its door, is {short:.0f} mm shorter than the robot."
    return f"A landing is {short:.0f} mm shorter than the robot."


def _jams(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    spare = finding.margin(question.risk)
    if spare == 0.0:
        return (
            "Its track has a gap, and the part behind it comes against a riser"
            f"{at(conclusion)}. There such robots jammed in simulations."
        )
    needed = found.required_friction
    most = math.tan(math.atan(needed) + spare)
    return (
        f"Its track has a gap, and it needs a friction of {needed:.2f}{at(conclusion)}. Beyond "
        f"{most:.2f} such robots jammed in simulations."
    )


def _across(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return terrain.UNKNOWN


def _unseen(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return (
        "The floor before the first riser was not seen, so that riser may be higher than the "
        "others: scan it again with the floor in view."
    )


def _finish(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    """Heights of the flight, and the end riser that makes the difference."""
    flight = next(one for one in question.flights if one.first_rise_drawn or one.last_rise_drawn)
    stated, drawn = list(flight.step_rises), list(flight.step_rises)
    said = []
    ends = (("first", 0, flight.first_rise_drawn), ("last", -1, flight.last_rise_drawn))
    for name, end, rise in ends:
        if rise is not None:
            drawn[end] = rise
            said.append(
                f"{name} riser {1e3 * rise:.0f} mm drawn, {1e3 * stated[end]:.0f} mm stated"
            )
    heights = [f"{sum(each):.2f} m" for each in (drawn, stated)]
    differs = f"Drawn {heights[0]}, stated {heights[1]}: f" if heights[0] != heights[1] else "F"
    return f"{differs}loor finish missing? Measure it: {', '.join(said)}."


def _too_fast(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    assert question.speed is not None
    limit = question.speed + finding.worst.min()
    return (
        f"It drives at {question.speed:.2f} m/s on grousers; from {limit:.2f} m/s on some hooked "
        "a nosing or spun at a riser in simulations."
    )


def _turns(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    turns = figure_of(found, "turns")
    return f"It may fail by {finding.mode.label}." if turns is None else turning.reason(turns)


def _drive(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    margin = math.degrees(finding.margin(question.risk))
    return f"The drive's traction is enough only for a slope {-margin:.1f} deg gentler."


def _stuck(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return f"It gets stuck, wedged against a face or rocking on the spot{at(conclusion)}."


def _changes(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    if finding.if_fails.best is Verdict.NO_GO:
        return f"It does not stand while its flippers move{at(conclusion)}."
    return f"It rocks from one pose to another while its flippers move{at(conclusion)}."


def _torque(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    missing = -finding.margin(question.risk)
    return f"Its flippers lack {missing:.1f} N m to move under their load{at(conclusion)}."


def _tolerance(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    off = f"{math.degrees(question.tolerance):.3g} deg"
    return f"It holds at just these angles of the flippers: {off} off them the verdict is worse."


def _unweighed(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    assert question.robot.com_range is not None
    return unweighed.reason(question.robot.com_range)


def _narrow(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    needs = question.needs.straight, question.needs.off_line
    return _needs("The flight", "wide", finding, needs, "going straight", "off line")


def _low(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    needs = question.needs.flat, question.needs.rearing
    return _needs("The headroom", "", finding, needs, "lying flat", "rearing")


def _needs(
    what: str,
    way: str,
    finding: "Finding",
    needs: tuple[float, float],
    best: str,
    worst: str,
) -> str:
    """What there is in the case that fails beside what the best and the worst need, in mm."""
    case = int(float(finding.best.min()) > 0.0)
    has = (needs[case] + float((finding.best, finding.worst)[case].min())) * 1e3
    least, most = (each * 1e3 for each in needs)
    way = f" {way}" if way else ""
    return (
        f"{what} is {has:.0f} mm{way}; the robot needs {least:.0f} mm {best}, {most:.0f} mm "
        f"{worst}."
    )


def _gap(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    assert question.widest_gap is not None
    flight, gap = question.widest_gap
    return gaps.reason(gap, flight.nosing_places, question.narrowest_end)


SAYINGS: dict[str, Saying] = {
    "tip_downhill": _tips,
    "tip_uphill": _tips,
    "tip_sideways": _tips,
    "fall_downhill": _falls,
    "fall_uphill": _falls,
    "slides_down": _slides,
    "slides_up": _slides,
    "drive": _drive,
    "stuck": _stuck,
    "rotation": _rotates,
    "momentum": _momentum,
    "impact": _impact,
    "energy": _energy,
    "high_centring": _belly,
    "grouser_speed": _too_fast,
    "landing_room": _room,
    "turning": _turns,
    "foot_unseen": _unseen,
    "gap_jam": _jams,
    "across": _across,
    "floor_finish": _finish,
    "posture_change": _changes,
    "flipper_torque": _torque,
    "posture_tolerance": _tolerance,
    "unweighed": _unweighed,
    "narrow": _narrow,
    "low": _low,
    "gap": _gap,
}
"""Sentences of the modes that have one of their own; others have the general one."""
