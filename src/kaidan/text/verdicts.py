"""The verdict in one sentence, and the notes beneath it."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from kaidan.modes import FAILURE_MODES, MODELS, SUPPLIES, Undecided, Verdict
from kaidan.text import dynamic, traction, turning, unweighed
from kaidan.text.words import place

if TYPE_CHECKING:
    from kaidan.assessment.verdict import Conclusion
    from kaidan.models.contact_figures import RotationFigures
    from kaidan.models.findings import Finding, Findings
    from kaidan.question import Question
    from kaidan.robot import Stance


def reason(question: "Question", found: "Findings", conclusion: "Conclusion") -> str:
    """The verdict in one sentence: what decides, with its number, and where."""
    if conclusion.verdict is Verdict.OUTSIDE_MODEL:
        return f"The {MODELS[found.model].label} has no answer: {found.outside}."
    many = _part(found, "failure_interval")
    if many is not None and many.draws > 1 and conclusion.governs != Undecided.FRICTION_UNKNOWN:
        mode = FAILURE_MODES.get(conclusion.governs)
        happens = None if mode is None else f"{mode.label}{_place(conclusion)}"
        return dynamic.of_many(many, happens)
    if conclusion.governs == Undecided.FRICTION_UNKNOWN:
        return _friction(question, found, conclusion, "none is stated")
    if conclusion.governs == Undecided.MARGIN_UNKNOWN:
        return f"Nothing fails, but the {MODELS[found.model].label} knows no margin."
    mode = FAILURE_MODES[conclusion.governs]
    if conclusion.verdict is Verdict.GO:
        return (
            f"It holds with {math.degrees(conclusion.margin):.1f} deg to spare; nearest is "
            f"{mode.label}{_place(conclusion)}."
        )
    finding = found.of(mode)
    if finding is not None and finding.margin(question.risk) > 0:
        return (
            f"With a probability of {(conclusion.samples <= 0).mean():.2g}, more than the accepted "
            f"{question.risk:g}, it fails in one way or another; nearest is "
            f"{mode.label}{_place(conclusion)}."
        )
    say = _SAYINGS.get(mode.key)
    said = None if say is None or finding is None else say(question, found, conclusion, finding)
    if said is not None:
        return said
    fails = "fails" if conclusion.verdict is Verdict.NO_GO else "may fail"
    return f"It {fails} by {mode.label}{_place(conclusion)}."


def _place(conclusion: "Conclusion") -> str:
    return place(conclusion.phase, conclusion.step)


def _friction(question: "Question", found: "Findings", conclusion: "Conclusion", known: str) -> str:
    needed = found.required_friction
    required = f"{needed:.2f} is required, " if math.isfinite(needed) else "none is enough, "
    if math.isnan(needed):
        required = ""
    held = _part(found, "usual_required_friction")
    if held is not None and math.isfinite(needed):
        required = f"{traction.required(held, f'{needed:.2f} is required')}, "
    decides = FAILURE_MODES.get(conclusion.governs) in (None, *SUPPLIES)
    does = "decides" if decides else "is in doubt too"
    return f"Friction {does}{_place(conclusion)}: {required}{known}."


def _slides(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    trials = _figure(found, "trials")
    if trials is not None:
        return dynamic.sliding(trials, _place(conclusion))
    low, high = question.friction
    stated = f"{low:.2f}" if low == high else f"{low:.2f} to {high:.2f}"
    return _friction(question, found, conclusion, f"{stated} is stated")


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
            f"ranges of what is not measured{_place(conclusion)}."
        )
    if math.isnan(best):
        return f"It may fall {label}{_place(conclusion)}, by its friction."
    if finding.failing is Verdict.NO_GO:
        if margin <= -90:
            return f"It falls {label}{_place(conclusion)}."
        grades = _figure(found, "grades")
        does = "falls" if grades is not None and grades.largest_rotation_deg >= 90 else "tips"
        return f"It {does} {label}, {-margin:.1f} deg beyond the limit{_place(conclusion)}."
    if _figure(found, "area") == "E":
        return (
            f"It holds only while the acceleration follows the position (area E); at a constant "
            f"one it tips {label}, {-margin:.1f} deg beyond the limit."
        )
    largest = max(_rotations(found, finding), key=_angle, default=None)
    if largest is not None:
        return _arrested(_angle(largest), "", found, conclusion)
    grades = _figure(found, "grades")
    arrives = grades is None or grades.arrested
    return (
        f"{'It arrives, but by' if arrives else 'By'} the criterion it tips {label}, {-margin:.1f} "
        f"deg beyond the limit{_place(conclusion)}{_to_fall(found)}."
    )


def _part(found: "Findings", name: str) -> Any:
    """First of the models' own figures with a figure of a name; None: none has."""
    return next((each for each in found.figures if hasattr(each, name)), None)


def _figure(found: "Findings", name: str) -> Any:
    """Figure of a name, of the first part that has it; None: no part has."""
    return getattr(_part(found, name), name, None)


def _rotations(found: "Findings", finding: "Finding") -> "list[RotationFigures]":
    """Rotations in the phase of a finding that are arrested."""
    rotations = _figure(found, "rotations") or ()
    return [each for each in rotations if each.arrested and each.phase == finding.phase]


def _angle(each: "RotationFigures") -> float:
    return abs(each.angle_deg)


def _arrested(rotation: float, beyond: str, found: "Findings", conclusion: "Conclusion") -> str:
    digits = 1 if rotation >= 0.1 else 2
    return (
        f"It rocks by {rotation:.{digits}f} deg{beyond} until the next contact arrests it"
        f"{_place(conclusion)}{_to_fall(found)}."
    )


def _to_fall(found: "Findings") -> str:
    """How far a robot that rocks is from a fall; nothing of one that falls."""
    tilt = _figure(found, "tilt")
    if tilt is None or tilt.to_fall_deg is None or tilt.to_fall_deg <= 0:
        return ""
    if tilt.to_fall_deg > 29.95:
        return ", more than 30 deg from falling"
    return f", {tilt.to_fall_deg:.1f} deg from falling"


def _falls(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    label = finding.mode.label.removeprefix("falling ")
    figure = _figure(found, "tilt")
    tilt = None if figure is None else figure.to_fall_deg
    if tilt is None:  # of several traverses the worst
        tilt = math.degrees(finding.margin(question.risk) + question.reserve)
    if tilt <= 0:
        return f"It falls {label}{_place(conclusion)}."
    return (
        f"It rocks, and is {tilt:.1f} deg from falling {label}{_place(conclusion)}: expect a fall, "
        f"because {math.degrees(question.reserve):.1f} deg of reserve must be kept."
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
        f"Uneven nosings may rock it by {more:.1f} deg more than tracks yield{_place(conclusion)}"
        f"{_to_fall(found)}."
    )


def _momentum(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    if finding.margin(question.risk, best=True) <= 0:
        return f"The momentum of its rotation topples it{_place(conclusion)}."
    return (
        f"Only the impact that ends its rotation takes enough momentum to hold it"
        f"{_place(conclusion)}."
    )


def _impact(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    tolerated = question.robot.tolerated_impact
    speed = tolerated - finding.margin(question.risk)
    digits = next(n for n in (1, 2, 3) if n == 3 or f"{speed:.{n}f}" != f"{tolerated:.{n}f}")
    return (
        f"It drops and hits at {speed:.{digits}f} m/s{_place(conclusion)}; "
        f"{tolerated:.{digits}f} m/s are tolerated."
    )


def _energy(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    slips = _figure(found, "slip_heights_mm") or {}
    slip = 0.0 if finding.phase is None else slips.get(finding.phase.value, 0.0)
    height, steady = (1e3 * question.energy_threshold(1e-3 * each) for each in (slip, 0.0))
    margin = 1e3 * finding.margin(question.risk) + height
    of_slip = f", {height - steady:.2f} mm of it of a slip onto its grousers" if slip else ""
    return (
        f"The energy margin of {margin:.2f} mm is below the {height:.2f} mm of a sudden stop or "
        f"start{of_slip}: the robot may rock{_place(conclusion)}."
    )


def _belly(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return f"It rests on its belly in places{_place(conclusion)}, where the tracks may lose grip."


def _room(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    short = -1e3 * finding.margin(question.risk)
    if any(question.leaves):
        return f"A landing, less the leaf of its door, is {short:.0f} mm shorter than the robot."
    return f"A landing is {short:.0f} mm shorter than the robot."


def _unseen(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return (
        "The floor before the first riser was not seen, so that riser may be higher than the "
        "others: scan it again with the floor in view."
    )


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
    turns = _figure(found, "turns")
    return f"It may fail by {finding.mode.label}." if turns is None else turning.reason(turns)


def _drive(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    margin = math.degrees(finding.margin(question.risk))
    return f"The drive's traction is enough only for a slope {-margin:.1f} deg gentler."


def _stuck(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    return f"It gets stuck, wedged against a face or rocking on the spot{_place(conclusion)}."


def _changes(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    if finding.failing is Verdict.NO_GO:
        return f"It does not stand while its flippers move{_place(conclusion)}."
    return f"It rocks from one pose to another while its flippers move{_place(conclusion)}."


def _torque(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    missing = -finding.margin(question.risk)
    return f"Its flippers lack {missing:.1f} N m to move under their load{_place(conclusion)}."


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


_Saying = Callable[["Question", "Findings", "Conclusion", "Finding"], str]


def _narrow(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    assert question.room is not None
    return _needs("The flight", "wide", question.room[0], finding, "going straight", "off line")


def _low(
    question: "Question", found: "Findings", conclusion: "Conclusion", finding: "Finding"
) -> str:
    assert question.room is not None
    return _needs("The headroom", "", question.room[1], finding, "lying flat", "rearing")


def _needs(
    what: str, way: str, given: float | None, finding: "Finding", best: str, worst: str
) -> str:
    """What there is beside what the best and the worst case need, in mm."""
    has = (given or 0.0) * 1e3
    least, most = (has - float(each.min()) * 1e3 for each in (finding.best, finding.worst))
    way = f" {way}" if way else ""
    return (
        f"{what} is {has:.0f} mm{way}; the robot needs {least:.0f} mm {best}, {most:.0f} mm "
        f"{worst}."
    )


_SAYINGS: dict[str, _Saying] = {
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
    "posture_change": _changes,
    "flipper_torque": _torque,
    "posture_tolerance": _tolerance,
    "unweighed": _unweighed,
    "narrow": _narrow,
    "low": _low,
}
"""Sentences of the modes that have one of their own; others have the general one."""


def notes(question: "Question", found: "Findings", conclusion: "Conclusion") -> tuple[str, ...]:
    """Other doubts than the governing one, what was assumed or not stated, what the sheet says."""
    each = []
    for finding in conclusion.doubts:
        say = _SAYINGS.get(finding.mode.key)
        fails = not finding.margin(question.risk) > 0  # by itself
        if fails and finding.mode.key != conclusion.governs and say is not None:
            own = conclusion._replace(phase=finding.phase, step=finding.step)
            each.append(say(question, found, own, finding))
    turns = _figure(found, "turns") or ()
    each += [*turning.lines(turns), turning.IN_LINE] if turns else []
    each += found.notes
    for name, value in (("theta_d", question.allowance_d), ("theta_M", question.allowance_M)):
        if value.source == "default":
            each.append(
                f"{name} is not measured: 0 to {math.degrees(value.high):.1f} deg assumed. Measure "
                "it to settle the doubt."
            )
    if question.surface is None:
        each.append("No friction was stated, so no GO can be given.")
    each += _of_drive(question, question.stance)
    sheets = (question.robot.notes, *(flight.notes for flight in question.flights))
    each += (" ".join(said.split()) for said in sheets if said)
    return tuple(each)


def _of_drive(question: "Question", stance: "Stance") -> list[str]:
    drive = question.robot.drive
    limits = drive.max_traction is not None or (
        drive.max_power is not None and question.speed and question.direction == "up"
    )
    if limits and stance.mass is not None:
        return []
    if drive.max_traction is None and drive.max_power is None:
        return ["The drive's traction is not known and not judged."]
    missing = "mass" if stance.mass is None else "speed"
    return [f"The drive is not judged: that takes the {missing}, which is not stated."]
