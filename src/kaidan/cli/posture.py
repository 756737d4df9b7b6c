"""``kaidan posture``: the flipper angles that make the most of a robot on stairs."""

from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options
from kaidan.cli.question import question

if TYPE_CHECKING:
    from kaidan.assessment.case import Case
    from kaidan.posture import PhasePosture, PostureAnswer, Tried

Limits = Annotated[
    str, typer.Option(help="Angles allowed for both pairs; stowed and flat always are.")
]
Accept = Annotated[
    str, typer.Option(help="What counts as holding: no-rotation, or caught (by the next contact).")
]


def register(app: typer.Typer) -> None:
    """Add ``posture`` to the command line."""
    app.command("posture")(posture)


@question()
def posture(
    case: "Case",
    limits: Limits = "-60deg..120deg",
    accept: Accept = "no-rotation",
    as_json: options.AsJson = False,
) -> None:
    """Find the flipper angles with which ROBOT takes STAIRS best, for all the way and by phase.

    Exit code, by the best posture for all the way: 0 go or caution, 1 no-go, 2 bad input, 3
    outside the model.
    """
    from kaidan.assessment import ACCEPTED
    from kaidan.errors import InputError
    from kaidan.posture import best_posture
    from kaidan.units import parse

    if accept not in ACCEPTED:
        raise InputError(f"--accept {accept!r} is not known; known: {', '.join(ACCEPTED)}")
    low, dots, high = limits.partition("..")
    if not dots:
        raise InputError(f"--limits {limits!r}: write LOW..HIGH, for example -60deg..120deg")
    answer = best_posture(
        case,
        limits=(parse(low, "angle", option="--limits"), parse(high, "angle", option="--limits")),
        accept=accept,  # type: ignore[arg-type]
    )
    typer.echo(answer.to_json() if as_json else as_text(answer))
    raise typer.Exit(answer.exit_code)


def as_text(answer: "PostureAnswer") -> str:
    """Answer as a page for people, the posture first."""
    head = (
        f"{_angles(answer.after)} is best for all the way"
        if answer.helps
        else "No fixed posture is better than the one asked about"
    )
    lines = [
        f"{head}  {answer.robot} on {answer.stairs}, {answer.tried} postures tried",
        "",
        f"  before    {_angles(answer.before)}: {_outcome(answer.before)}",
        f"            {answer.before.reason}",
    ]
    if answer.helps:
        lines += [
            f"  after     {_angles(answer.after)}: {_outcome(answer.after)}",
            f"            {answer.after.reason}",
            f"            asked again with --flippers={_option(answer.after)}",
        ]
    if answer.phases:
        better = "better than one for all" if answer.phases_help else "no better than one for all"
        lines += ["", f"  By phase ({better})"]
        lines += [
            f"    {each.phase:<10}{_angles(each)}: {_outcome(each)}, "
            f"{_friction(each)}, largest swing {each.largest_swing_deg:.1f} deg"
            for each in answer.phases
        ]
    for change in answer.changes:
        needs = "time not known" if change.needs_s is None else f"{change.needs_s:.1f} s"
        slow = ", TOO SLOW" if change.too_slow else ""
        lines.append(
            f"    change before {change.before}: {change.turn_deg:.0f} deg, {needs} of "
            f"{change.has_s:.1f} s at {answer.speed:g} m/s{slow}"
        )
    if answer.notes:
        lines += ["", "  Notes", *(f"    {note}" for note in answer.notes)]
    return "\n".join(lines)


def _angles(each: "Tried | PhasePosture") -> str:
    ends = (("front", each.front_deg), ("rear", each.rear_deg))
    return ", ".join(f"{end} {angle:+.0f} deg" for end, angle in ends if angle is not None)


def _option(each: "Tried") -> str:
    """Text of the option, exact enough to give the same answer."""
    ends = (each.front_deg, each.rear_deg)
    return ",".join("stowed" if angle is None else f"{angle:.10g}deg" for angle in ends)


def _outcome(each: "Tried | PhasePosture") -> str:
    margin = "" if each.margin_deg is None else f" ({each.margin_deg:+.1f} deg)"
    return f"{each.verdict.upper()}{margin}"


def _friction(each: "PhasePosture") -> str:
    if each.required_friction is None:
        return "no friction is enough"
    return f"friction {each.required_friction:.2f}"
