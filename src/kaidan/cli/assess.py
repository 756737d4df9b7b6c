"""``kaidan assess``: the main job."""

from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question
from kaidan.modes import EXIT_CODES

if TYPE_CHECKING:
    from kaidan.question import Question

Trials = Annotated[
    int | None,
    typer.Option(
        min=1,
        help="Number of trials of --model physics, inputs drawn from their uncertainty [1].",
    ),
]
Track = Annotated[
    str | None,
    typer.Option(
        help="Track of --model physics: smooth-belt, yielding-belt, driven-grousers [the sheet's]."
    ),
]
Details = Annotated[bool, typer.Option("--details", help="Print everything that was found.")]
Short = Annotated[bool, typer.Option("--short", help="Print one line.")]


def register(app: typer.Typer) -> None:
    """Add ``assess`` to the command line."""
    app.command("assess", epilog=f"Exit code: {EXIT_CODES}.")(assess)


@question()
def assess(
    requested: "Question",
    trials: Trials = None,
    track: Track = None,
    details: Details = False,
    short: Short = False,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Say whether ROBOT can take STAIRS, by how much, what governs and what would help."""
    from kaidan.assessment import answer_to
    from kaidan.question import Question

    pictures = output.checked(figure)
    own = {"trials": trials, "track": track}
    stated = {name: each for name, each in own.items() if each is not None}
    answer = answer_to(Question.ask(requested, **stated))

    def draw() -> "output.Figure":
        from kaidan.figures.findings_figure import findings_figure

        return findings_figure(answer)

    files = output.drawn(pictures, draw)
    if as_json:
        output.put_out(answer, files, as_json=True)
    elif short:
        output.put_text(answer.short(), files, verdict=answer.verdict)
    elif details:
        output.put_text(answer.details(), files, verdict=answer.verdict)
    else:
        drawable = answer.verdict == "no-go" and answer.centroid is None
        see = _see() if drawable else ""
        output.put_text(f"{answer}{see}", files, verdict=answer.verdict)
    raise typer.Exit(answer.exit_code)


def _see() -> str:
    """Command that draws the traverse of the same question."""
    import shlex
    import sys

    words = sys.argv[2:]
    if sys.argv[1:2] != ["assess"] or "--model" in words:
        return ""
    kept = [word for word in words if word != "--details"]
    return f"\n  see             kaidan traverse {shlex.join(kept)} --figure traverse.png"
