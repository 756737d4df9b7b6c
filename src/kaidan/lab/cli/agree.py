"""``kaidan lab agree``: closed form, contact model and physics compared on one question."""

import math
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question

if TYPE_CHECKING:
    from kaidan.question import Question

Begin = Annotated[
    str,
    typer.Option(help="Where the trial on the stairs begins: flight, or landing."),
]
Resolution = Annotated[
    str, typer.Option(help="Resolution of the bisection by trials, for example 0.1deg.")
]


def register(app: typer.Typer) -> None:
    """Add ``agree`` to the command line."""
    app.command("agree")(agree)


@question(
    without=(
        "points",
        "uniform_across",
        "theta_d",
        "theta_m",
        "uncertainty",
        "yaw",
        "risk",
        "model",
    ),
    flippers="stowed",
)
def agree(
    requested: "Question",
    begin: Begin = "flight",
    resolution: Resolution = "0.1deg",
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Compare closed form, contact model and MuJoCo on ROBOT and STAIRS.

    Each difference has a band within which it is expected, with the reason; beyond it the likely
    cause is named. Without a speed trials run at 0.1 m/s, without a surface with a friction of 3.

    Exit code: 0 all within their bands, 1 not, 2 bad input.
    """
    from kaidan.errors import InputError, shown
    from kaidan.lab import cross_check
    from kaidan.units import parse

    pictures = output.checked(figure)
    if begin not in ("flight", "landing"):
        raise InputError(f"--begin {shown(begin)} is not known; known: flight, landing")
    width = math.degrees(parse(resolution, "angle", option="--resolution"))
    if not 0.01 <= width <= 5.0:
        raise InputError(f"--resolution {shown(resolution)} is not within 0.01 to 5 deg")
    found = cross_check.agree(requested, begin=begin, resolution=width)  # type: ignore[arg-type]

    def draw() -> "output.Figure":
        from kaidan.lab.cross_check.figure import agreement_figure

        return agreement_figure(found)

    output.put_out(found, output.drawn(pictures, draw), as_json=as_json)
    raise typer.Exit(found.exit_code)
