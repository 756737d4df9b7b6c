"""``kaidan assess``: the main job."""

from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.question import question
from kaidan.cli.tables import echo

if TYPE_CHECKING:
    from kaidan.assessment.answer import Assessment
    from kaidan.assessment.case import Case

Strict = Annotated[bool, typer.Option("--strict", help="Exit with 1 on caution too.")]
Accept = Annotated[
    str, typer.Option(help="What counts as holding: no-rotation, or caught (by the next contact).")
]


def register(app: typer.Typer) -> None:
    """Add ``assess`` to the command line."""
    app.command("assess")(assess)


@question()
def assess(
    case: "Case",
    model: options.Model = "contact",
    accept: Accept = "no-rotation",
    strict: Strict = False,
    as_json: options.AsJson = False,
) -> None:
    """Say whether ROBOT can take STAIRS, by how much, what governs and what would help.

    Exit code: 0 go or caution (--strict: caution is 1), 1 no-go, 2 bad input, 3 outside the model.
    """
    from kaidan.assessment import answer_to

    answer = answer_to(case, model=model, accept=accept)
    echo(answer.to_json() if as_json else as_text(answer))
    raise typer.Exit(1 if strict and answer.verdict == "caution" else answer.exit_code)


def as_text(answer: "Assessment") -> str:
    """Answer as a page for people, the verdict first."""
    names = " ".join(f"{answer.robot} on {answer.stairs}".split())
    lines = [
        f"{_VERDICT[answer.verdict]}  {names}, {answer.direction} "
        f"{answer.facing.replace('-', ' ')}",
        f"  {answer.reason}",
        "",
        _row(
            "stairs",
            "no flight of steps"
            if answer.angle_deg is None or answer.nosing_spacing_m is None
            else f"{answer.angle_deg:.1f} deg, {1e3 * answer.nosing_spacing_m:.0f} mm "
            "from nosing to nosing",
        ),
        _row(
            "robot",
            f"L {1e3 * answer.flat_length_m:.0f} mm, C_L "
            f"{1e3 * answer.com_from_front_m:.0f} mm, C_N {1e3 * answer.com_height_m:.0f} mm, "
            + ("mass not known" if answer.mass_kg is None else f"{answer.mass_kg:.1f} kg"),
        ),
    ]
    if answer.margin_deg is not None:
        lines += _margin_rows(answer)
    lines += _yaw_row(answer)
    lines.append(_friction_row(answer))
    lines += _force_rows(answer)
    lines += _phase_rows(answer)
    if answer.what_would_help:
        lines += ["", "  What would help"]
        lines += [f"    {_change(change)}" for change in answer.what_would_help]
    lines += ["", "  Notes", *(f"    {note}" for note in answer.notes)]
    return "\n".join(lines)


_VERDICT = {
    "go": "GO",
    "caution": "CAUTION",
    "no-go": "NO-GO",
    "outside-model": "OUTSIDE THE MODEL",
}


def _row(name: str, text: str) -> str:
    return f"  {name:<16}{text}"


def _margin_rows(answer: "Assessment") -> list[str]:
    assert answer.margin_deg is not None
    best = answer.margin_at_best_deg
    spread = (
        "" if best is None or abs(best - answer.margin_deg) < 0.05 else f" (at best {best:+.1f})"
    )
    centroid = (
        ""
        if answer.margin_centroid_mm is None
        else f", centroid {answer.margin_centroid_mm:+.0f} mm"
    )
    force = (
        "" if answer.margin_force_N is None else f", {answer.margin_force_N:+.0f} N along the slope"
    )
    shown = ", ".join(
        f"{name} {value.low_deg:.1f} to {value.high_deg:.1f} deg ({value.source})"
        for name, value in answer.allowances.items()
    )
    rows = [
        _row("governs", answer.governs.replace("_", " ")),
        _row(
            "margin",
            f"{answer.margin_deg:+.1f} deg{spread}{centroid}{force}"
            + (
                ""
                if answer.margin_angle_deg is None
                else f"; tips beyond {answer.margin_angle_deg:.1f} deg"
            )
            + (
                ""
                if answer.lower_angle_deg is None
                else f", and below {answer.lower_angle_deg:.1f} deg"
            ),
        ),
        _row("taken off", shown),
    ]
    if answer.margin_interval_deg is not None and answer.probability is not None:
        low, high = answer.margin_interval_deg
        rows.append(
            _row(
                "uncertain",
                f"95 % of margins within {low:+.1f} to {high:+.1f} deg; "
                f"fails with probability {answer.probability.any:.3f} "
                f"(accepted: {answer.risk:g})",
            )
        )
    if answer.area is None:
        rows.append(_row("acceleration", "the band that is safe is not known off a regular flight"))
    elif answer.a_min_safe is None or answer.a_max_safe is None:
        rows.append(_row("acceleration", "no constant acceleration is safe"))
    else:
        rows.append(
            _row(
                "acceleration",
                f"safe from {answer.a_min_safe:+.2f} to "
                f"{answer.a_max_safe:+.2f} m/s2 up the stairs; "
                f"hardest start {_or_none(answer.hardest_start)}, "
                f"hardest stop {_or_none(answer.hardest_stop)}",
            )
        )
    return rows


def _or_none(value: float | None) -> str:
    return "none" if value is None else f"{value:.2f} m/s2"


def _yaw_row(answer: "Assessment") -> list[str]:
    if answer.yaw_limit_deg is None and answer.yaw_deg == 0:
        return []
    asked = f"{answer.yaw_deg:+.1f} deg; " if answer.yaw_deg else ""
    if answer.yaw_limit_deg is None:
        return [_row("yaw", f"{asked}none up to 80 deg at which the verdict changes")]
    return [_row("yaw", f"{asked}verdict changes from {answer.yaw_limit_deg:.1f} deg on (it tips)")]


def _friction_row(answer: "Assessment") -> str:
    needed = answer.required_friction
    text = "no friction is enough" if needed is None else f"{needed:.2f} required"
    if answer.friction is None:
        return _row("friction", f"{text}, not stated")
    low, high = answer.friction
    stated = f"{low:g}" if low == high else f"{low:g} to {high:g}"
    return _row("friction", f"{text}, {stated} stated ({' '.join(str(answer.surface).split())})")


def _force_rows(answer: "Assessment") -> list[str]:
    if not answer.contacts:
        return []
    shares = " / ".join(f"{100 * contact.load_share:.0f} %" for contact in answer.contacts)
    rows = [_row("load", f"{shares} on the nosings, highest to lowest, as the lowest one leaves")]
    if answer.traction_N is not None:
        each = " / ".join(f"{contact.traction_N:.0f}" for contact in answer.contacts)
        power = "" if answer.power_W is None else f"; {answer.power_W:.0f} W"
        rows.append(_row("traction", f"{answer.traction_N:.0f} N in all, {each} N each{power}"))
    return rows


def _phase_rows(answer: "Assessment") -> list[str]:
    """What the contact model adds: a line for the grades and one for each phase."""
    if answer.grades is None:
        return []
    grades = answer.grades
    one = {None: "says nothing", True: "yes", False: "no"}[grades.no_rotation]
    caught, momentum = (
        "yes" if held else "no" for held in (grades.caught, grades.caught_with_momentum)
    )
    rows = [
        _row(
            "holds",
            f"without rotation: {one}; caught: {caught}; caught with momentum: {momentum}; "
            f"swings by {grades.largest_swing_deg:.1f} deg",
        ),
        _row(
            "energy wanted",
            f"more than {grades.energy_threshold_mm:.2f} mm at every pose, v^2/2g of "
            + ("the speed asked" if grades.speed_stated else "0.1 m/s, the paper's"),
        ),
    ]
    for each in answer.phases:
        energy = (
            ""
            if each.energy_margin_mm is None
            else f", energy margin {each.energy_margin_mm:.1f} mm (step {each.energy_margin_step})"
        )
        friction = (
            "no friction is enough"
            if each.required_friction is None
            else f"friction {each.required_friction:.2f}"
        )
        rows.append(
            _row(
                each.phase,
                f"{friction} (step {each.required_friction_step}){energy}"
                + (", the belly touches" if each.belly_touches else ""),
            )
        )
    return rows


def _change(change: "object") -> str:
    from kaidan.assessment.answer import Change

    assert isinstance(change, Change)
    margin = "" if change.margin_deg is None else f" ({change.margin_deg:+.1f} deg)"
    return f"{change.change}: {_VERDICT[change.verdict]}{margin}"
