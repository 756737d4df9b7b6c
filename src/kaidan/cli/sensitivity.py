"""``kaidan sensitivity``: what the margin and the verdict hang on."""

from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question
from kaidan.cli.sweep import Scheduler, Workers

if TYPE_CHECKING:
    from kaidan.question import Question

Samples = Annotated[
    int,
    typer.Option(help="Number of draws, a power of two; each uncertain input takes as many again."),
]
Seed = Annotated[int, typer.Option(min=0, help="Seed of the draws.")]


def register(app: typer.Typer) -> None:
    """Add ``sensitivity`` to the command line."""
    app.command("sensitivity")(sensitivity)


@question()
def sensitivity(
    requested: "Question",
    samples: Samples = 256,
    seed: Seed = 0,
    scheduler: Scheduler = "threads",
    workers: Workers = None,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Find what to measure first: Sobol indices of the margin and of GO over what is not known.

    What is not known are --uncertainty, ranges of friction and of the allowances, and the centroid
    of a robot that nobody weighed. Exit code: 0, 2 bad input.
    """
    from kaidan.verbs.sensitivity import sensitivity as find

    pictures = output.checked(figure)
    found = find(
        requested,
        samples=samples,
        seed=seed,
        scheduler=scheduler,
        workers=workers,
        progress=True,
    )

    def draw() -> "output.Figure":
        from kaidan.figures.sensitivity_figure import sensitivity_figure

        return sensitivity_figure(found)

    output.put_out(found, output.drawn(pictures, draw), as_json=as_json)
