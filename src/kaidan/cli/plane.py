"""``kaidan plane``: the paper's d-a plane, and a plan of the acceleration through area E."""

from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question

if TYPE_CHECKING:
    from kaidan.question import Question

Accelerate = Annotated[
    bool,
    typer.Option(
        "--accelerate",
        help="Plan an acceleration over the position through area E, within the drive's limits; "
        "exit code 1 if one is needed and there is none.",
    ),
]


def register(app: typer.Typer) -> None:
    """Add ``plane`` to the command line."""
    app.command("plane")(plane)


@question(
    without=("points", "uniform_across", "uncertainty", "yaw", "risk", "model"),
    flippers="stowed",
)
def plane(
    requested: "Question",
    accelerate: Accelerate = False,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Show the paper's d-a plane, its figure 7: limits of acceleration over the progress.

    Exit code: 0, 1 no plan where one is needed (--accelerate), 2 bad input, 3 outside the model.
    """
    from kaidan.verbs.d_a_plane import d_a_plane

    pictures = output.checked(figure)
    found = d_a_plane(requested, accelerate=accelerate)

    def draw() -> "output.Figure":
        from kaidan.figures.d_a_figure import d_a_figure

        return d_a_figure(found)

    contents = {} if found.outside else output.drawn(pictures, draw)
    output.put_out(found, contents, as_json=as_json)
    raise typer.Exit(found.exit_code)
