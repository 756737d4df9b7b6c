"""The answer of `kaidan assess` as a page, the verdict first."""

from typing import TYPE_CHECKING

from kaidan.assessment.sentences import measuring
from kaidan.assessment.sentences.verdicts import belt_assumed
from kaidan.models.sentences import dynamic, terrain, traction, turning
from kaidan.modes import (
    FAILURE_MODES,
    SLIDES_DOWN,
    SLIDES_UP,
    TURNING,
    Undecided,
    Verdict,
)
from kaidan.tables import decimals
from kaidan.text import limits, plan
from kaidan.text.unweighed import rows, thresholds
from kaidan.text.words import subject
from kaidan.words import place

if TYPE_CHECKING:
    from kaidan.assessment.answer import Assessment, Change, FindingShown
    from kaidan.models.closed_form_figures import ClosedFormFigures
    from kaidan.models.contact_figures import ContactFigures, RotationFigures


LINES = 8
"""Most lines of the answer on one screen."""
NO_SLOPE = -90.0
"""Margin of what no slope of the stairs would mend [deg]."""
NO_FRICTION = 0.005
"""Friction that two digits show as none [1]: of a robot that falls before it comes to a step."""


def text(answer: "Assessment") -> str:
    """Answer on one screen: the verdict, why, what to do, what decides, what is not known."""
    lines = [headline(answer), f"  {answer.reason}"]
    if answer.to_secure:
        lines.append(_row("first", answer.to_secure))
    if assumed := belt_assumed(answer.question.robot):
        lines.append(_row("assumed", assumed))
    if answer.plan is not None and plan.line(answer.plan):
        lines.append(_row("posture", plan.line(answer.plan)))
    lines += [_row("landing", line) for line in turning.lines(answer.turns)]
    if answer.centroid is not None:
        lines.append(_row("weighed", thresholds(answer.centroid)))
    if answer.what_would_help:
        first, *others = answer.what_would_help
        lines.append(_row(change_name(answer).lower(), change_line(first, answer)))
        if others and others[0].verdict == first.verdict and answer.centroid is None:
            lines.append(_row("or", change_line(others[0], answer)))
    if answer.limits and not _is_enough(answer):
        lines.append(_row("limit", limits.text(answer.limits)))
    elif not answer.what_would_help and _tried_changes(answer):
        lines.append(_row("help", "none of the changes that were tried"))
    if answer.physics is not None:
        lines.append(_row("simulated", dynamic.simulated(answer.physics)))
    if answer.verdict != "outside-model":
        lines.append(_row("margin", f"{margin_line(answer)}, on {stairs_line(answer)}"))
    lines.append(_row("friction", friction_line(answer)))
    assumed = terrain.assumed(answer.question)
    if assumed:
        lines.append(_row("assumed", assumed))
    slip = None if answer.traction is None else traction.slip(answer.question, answer.traction)
    if slip is not None:
        lines.append(_row("grousers", slip))
    if answer.question.uncertain and _to_measure(answer):
        lines.append(_row("measure", measuring.first(answer.to_measure)))
    unknown = unknown_line(answer)
    if unknown:
        lines.append(_row("not known", unknown))
    return "\n".join(lines[:LINES])


def _tried_changes(answer: "Assessment") -> bool:
    """Whether changes were tried: not where nothing fails, and not many trials for each."""
    fails = (
        answer.verdict in ("rough", "unsure", "no-go")
        and answer.governs != Undecided.MARGIN_UNKNOWN
    )
    return fails and answer.question.trials == 1


def _is_enough(answer: "Assessment") -> bool:
    """Whether a change leads to another verdict, not only to a larger margin."""
    return bool(answer.what_would_help) and answer.what_would_help[0].verdict != answer.verdict


def advice(answer: "Assessment") -> str:
    """What to do first, in one line; empty where nothing helps, or need not."""
    if not answer.what_would_help:
        return ""
    return f"{change_name(answer)}: {change_line(answer.what_would_help[0], answer)}"


def change_name(answer: "Assessment") -> str:
    """Name of the change that helps most."""
    return "Do" if _is_enough(answer) else "Not enough"


def short(answer: "Assessment") -> str:
    """Answer in one line: the verdict, for whom, its margin and what decides."""
    margin = "" if answer.margin_deg is None else f"  {answer.margin_deg:+.1f} deg"
    assumed = "" if answer.question.robot.track.assumed_over is None else "  belt assumed"
    decides = f"{answer.governs}{place(answer.phase, answer.step)}"
    return f"{headline(answer)}{margin}  {decides}{assumed}"


def headline(answer: "Assessment") -> str:
    """Verdict, and for whom on what."""
    return f"{Verdict(answer.verdict).label}  {subject(answer.question)}"


def _hardest(answer: "Assessment") -> str:
    """Where most friction is required: where the finding has it, which the reason tells of."""
    found = (answer.findings.get(mode.key) for mode in (SLIDES_DOWN, SLIDES_UP))
    return next((place(one.phase, one.step) for one in found if one is not None), "")


def unknown_line(answer: "Assessment") -> str:
    """What was assumed because nobody stated it."""
    names = [name for name, each in answer.allowances.items() if each.source == "default"]
    if answer.friction is None:
        names.append("friction")
    if _is_unknown(answer, "drive"):
        names.append("the drive's traction")
    if any(_is_unknown(answer, mode) for mode in ("narrow", "low")):
        names.append("the robot's size")
    each = [f"{', '.join(names)}: measure {'it' if len(names) == 1 else 'them'}"] if names else []
    flights = answer.question.flights
    if flights and not flights[-1].head_seen:
        each.append("whether more steps follow the last one: no landing was seen")
    return "; ".join(each)


def _is_unknown(answer: "Assessment", mode: str) -> bool:
    """Whether a failure mode was to be judged and could not."""
    finding = answer.findings.get(mode)
    return finding is not None and finding.holds is None


def _to_measure(answer: "Assessment") -> bool:
    """Whether to say what to measure first: nothing measured turns what fails in the best case."""
    return answer.verdict != "no-go" and measuring.matters(answer.to_measure)


def details(answer: "Assessment") -> str:
    """Answer as a page for people: everything that was found."""
    question = answer.question
    lines = [headline(answer), f"  {answer.reason}"]
    if answer.plan is not None:
        lines += plan.section(answer.plan, answer.verdict)
    if answer.what_would_help:
        lines += ["", "  What would help"]
        lines += [f"    {change_line(change, answer)}" for change in answer.what_would_help]
    lines += [
        "",
        _row("stairs", stairs_line(answer)),
        _row("robot", robot_line(answer)),
        _row("margin", margin_line(answer)),
    ]
    if answer.margin_interval_deg is not None:
        low, high = answer.margin_interval_deg
        lines.append(
            _row(
                "uncertain",
                f"95 % of margins within {low:+.1f} to {high:+.1f} deg; fails with probability "
                f"{answer.failure_probability:.3f} (accepted: {question.risk:g})",
            )
        )
    if _to_measure(answer):
        lines.append(_row("measure", measuring.first(answer.to_measure)))
    lines.append(_row("allowances", _allowances(answer)))
    lines.append(_row("friction", friction_line(answer)))
    slip = None if answer.traction is None else traction.slip(answer.question, answer.traction)
    if slip is not None:
        lines.append(_row("grousers", slip))
    for key, one in answer.findings.items():
        if key != TURNING.key and (one.unit != "" or one.holds is False):
            lines.append(_row(key, _finding(one)))
    lines += [_row(TURNING.key, line) for line in turning.every(answer.turns)]
    if answer.contact is not None:
        lines += _contact(answer.contact)
    if answer.closed_form is not None:
        lines += _closed_form(answer.closed_form)
    if answer.support_polygon is not None and answer.support_polygon.yaw_limit_deg is not None:
        limit = answer.support_polygon.yaw_limit_deg
        lines.append(_row("yaw", f"tips on the flight from {limit:.1f} deg off straight on"))
    if answer.physics is not None:
        lines += [_row("trial", each) for each in dynamic.trials(answer.physics)]
    if answer.centroid is not None:
        lines += [_row("centroid", each) for each in rows(answer.centroid)]
    if answer.limits:
        lines.append(_row("limit", limits.text(answer.limits)))
    if answer.notes:
        lines += ["", "  Notes", *(f"    {note}" for note in answer.notes)]
    return "\n".join(lines)


def _row(name: str, value: str) -> str:
    return f"  {name:<16}{value}"


def change_line(change: "Change", answer: "Assessment") -> str:
    """A change that would help, and what the verdict would then be."""
    margin = "" if change.margin_deg is None else f" ({change.margin_deg:+.1f} deg)"
    still = "still " if change.verdict == answer.verdict else ""
    return f"{change.change}: {still}{Verdict(change.verdict).label}{margin}"


def stairs_line(answer: "Assessment") -> str:
    """Slope and nosing spacing of the terrain."""
    if answer.angle_deg is None or answer.nosing_spacing_m is None:
        return "no flight of steps"
    return (
        f"{answer.angle_deg:.1f} deg, {1e3 * answer.nosing_spacing_m:.0f} mm from nosing to nosing"
    )


def robot_line(answer: "Assessment") -> str:
    """Lengths and mass of the robot."""
    mass = "mass not known" if answer.mass_kg is None else f"{answer.mass_kg:g} kg"
    return (
        f"L {1e3 * answer.flat_length_m:.0f} mm, C_L {1e3 * answer.com_from_front_m:.0f} mm, "
        f"C_N {1e3 * answer.com_height_m:.0f} mm, {mass}"
    )


def margin_line(answer: "Assessment", *, labels: bool = False) -> str:
    """Margin in the worst and in the best case; failure modes by their keys, or by what they are.

    Keys are what stands beside the rows of ``--details`` and in JSON.
    """
    if answer.margin_deg is None:
        return "not known"
    best = answer.margin_best_deg
    worst = f"{answer.margin_deg:+.1f} deg{_against(answer, answer.margin_deg, labels)}"
    if best is None or abs(best - answer.margin_deg) < 0.05:
        return worst
    return f"{worst} in the worst case, {best:+.1f} deg in the best"


def _against(answer: "Assessment", margin: float, labels: bool) -> str:
    """Failure mode whose margin of slope it is, in brackets; several are uncertain together."""
    decides = FAILURE_MODES.get(answer.governs)
    if margin == NO_SLOPE and decides is not None and decides.unit != "rad":
        return f" ({decides.label if labels else answer.governs}: no slope would do)"
    each = {
        key: abs(one.margin - margin)
        for key, one in answer.findings.items()
        if one.margin is not None and FAILURE_MODES[key].unit == "rad"
    }
    if not each:
        return ""
    least = min(each, key=lambda key: each[key])
    return f" ({FAILURE_MODES[least].label if labels else least})"


def _allowances(answer: "Assessment") -> str:
    return ", ".join(
        f"{name} {each.low_deg:.1f} to {each.high_deg:.1f} deg ({each.source})"
        if each.low_deg != each.high_deg
        else f"{name} {each.high_deg:.1f} deg ({each.source})"
        for name, each in answer.allowances.items()
    )


def friction_line(answer: "Assessment") -> str:
    """Friction that is required, and what is stated."""
    needed = answer.required_friction
    required = "not known" if needed is None else f"{needed:.2f} required"
    if needed is not None and needed < NO_FRICTION:
        ends = answer.verdict == "no-go"
        required = "none required"
        required += f" as far as it gets{place(answer.phase, answer.step)}" if ends else ""
    elif needed is not None:
        if answer.traction is not None:
            required = traction.required(answer.traction, required)
        required += _hardest(answer)
    if answer.friction is None:
        return f"{required}, none stated"
    low, high = answer.friction
    surface = answer.question.surface
    name = "" if surface is None or surface.name.startswith("friction ") else f" ({surface.name})"
    stated = f"{low:.2f}" if low == high else f"{low:.2f} to {high:.2f}"
    return f"{required}, {stated} stated{name}"


def _finding(one: "FindingShown") -> str:
    if one.holds is None:
        return f"not known ({one.label})"
    where = "" if one.phase is None else f", {one.phase}"
    where += "" if one.step is None else f" step {one.step}"
    if one.margin is None:
        return f"{'holds' if one.holds else 'fails'} ({one.label}{where})"
    digits = decimals(one.margin, 1 if one.unit in ("deg", "m/s") else 2)
    value = f"{one.margin:+.{digits}f} {one.unit}"
    if one.margin_best is not None and abs(one.margin_best - one.margin) > 0.5 * 10**-digits:
        value += f", at best {one.margin_best:+.{digits}f}"
    chance = "" if one.probability is None else f", fails with probability {one.probability:.3f}"
    return f"{value} ({one.label}{where}{chance})"


def _contact(figures: "ContactFigures") -> list[str]:
    grades = figures.grades
    one = {None: "says nothing", True: "yes", False: "no"}[grades.no_rotation]
    arrested, momentum = (
        "yes" if each else "no" for each in (grades.arrested, grades.arrested_with_momentum)
    )
    lines = [
        _row(
            "grades",
            f"no rotation: {one}; arrested: {arrested}; arrested with momentum: {momentum}",
        )
    ]
    for each in figures.phases:
        friction = (
            "no friction is enough"
            if each.required_friction is None
            else f"friction {each.required_friction:.2f}"
        )
        energy = (
            ""
            if each.energy_margin_mm is None
            else f", energy margin {each.energy_margin_mm:.1f} mm (step {each.energy_margin_step})"
        )
        lines.append(_row(each.phase, f"{friction} (step {each.required_friction_step}){energy}"))
    for name, obliged in (("rotates", False), ("drops", True)):
        some = [
            each
            for each in figures.rotations
            if each.arrested and each.obliged is obliged and abs(each.angle_deg) >= 0.05
        ]
        if some:
            lines.append(_row(name, _rotations(some)))
    falls = [each for each in figures.rotations if not each.arrested]
    lines += [_row("falls", f"over{place(each.phase, each.step)}") for each in falls]
    return lines


def _rotations(some: "list[RotationFigures]") -> str:
    """The largest of some rotations, where it begins and how it ends."""
    largest = max(some, key=lambda each: abs(each.angle_deg))
    often = "" if len(some) == 1 else f"{len(some)} times, at most "
    return (
        f"{often}by {abs(largest.angle_deg):.1f} deg{place(largest.phase, largest.step)}, the "
        f"centroid drops {largest.drop_mm:.0f} mm, the end hits at "
        f"{largest.impact_speed or 0.0:.1f} m/s"
    )


def _closed_form(figures: "ClosedFormFigures") -> list[str]:
    lines = [
        _row(
            "limit",
            f"tips beyond {figures.margin_angle_deg:.1f} deg"
            + (
                ""
                if figures.lower_angle_deg is None
                else f", nose drops below {figures.lower_angle_deg:.1f} deg"
            ),
        )
    ]
    if figures.a_min_safe is not None and figures.a_max_safe is not None:
        lines.append(
            _row(
                "acceleration",
                f"safe from {figures.a_min_safe:+.2f} to {figures.a_max_safe:+.2f} m/s2 up the "
                f"stairs, area {figures.area}",
            )
        )
    else:
        lines.append(_row("acceleration", f"none is safe throughout, area {figures.area}"))
    limits = [
        f"{name} {value:.2f} m/s2"
        for name, value in (
            ("max. start acceleration", figures.max_start),
            ("max. braking", figures.max_braking),
        )
        if value is not None
    ]
    if limits:
        lines.append(_row("", "; ".join(limits)))
    if figures.margin_centroid_mm is not None:
        lines.append(_row("centroid", f"{figures.margin_centroid_mm:+.0f} mm along the track"))
    if figures.contacts:
        shares = " / ".join(f"{100 * each.load_share:.0f} %" for each in figures.contacts)
        lines.append(
            _row("load", f"{shares} on the nosings, highest to lowest, as the lowest one leaves")
        )
    if figures.traction_N is not None:
        power = "" if figures.power_W is None else f", {figures.power_W:.0f} W"
        lines.append(_row("traction", f"{figures.traction_N:.0f} N{power}"))
    return lines
