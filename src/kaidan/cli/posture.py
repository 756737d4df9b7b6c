"""``kaidan posture``: the plan that makes the most of a robot on stairs."""

from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question
from kaidan.modes import EXIT_CODES

if TYPE_CHECKING:
    from kaidan.question import Question

Limits = Annotated[
    str, typer.Option(help="Angles allowed for both pairs; stowed and flat always are.")
]


def register(app: typer.Typer) -> None:
    """Add ``posture`` to the command line."""
    app.command("posture", epilog=f"Exit code, by the best plan: {EXIT_CODES}.")(posture)


@question(without=("yaw", "model", "facing"), flippers="stowed")
def posture(
    requested: "Question",
    limits: Limits = "-75deg..90deg",
    facing: options.Facing = None,
    as_json: options.AsJson = False,
) -> None:
    """Find the leading end and the posture in each phase with which ROBOT takes STAIRS best."""
    from kaidan.units import parse_range
    from kaidan.verbs.posture import posture as find

    allowed = parse_range(limits, "angle", option="--limits")
    answer = find(requested, limits=allowed, facing=facing)
    output.put_out(answer, {}, as_json=as_json)
    raise typer.Exit(answer.exit_code)
