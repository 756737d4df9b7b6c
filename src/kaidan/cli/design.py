"""``kaidan design``: figures of a robot for stairs that are to be taken."""

from typing import Annotated, Any

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question_options, shared
from kaidan.cli.sweep import Scheduler, Workers, values_of
from kaidan.modes import EXIT_CODES

FreeText = Annotated[
    list[str],
    typer.Option(
        "--free",
        metavar="NAME=LOW..HIGH",
        help="Figure that may be chosen: com_from_front=200mm..400mm, com_height=, flat_length=, "
        "track.front_radius=, front_flippers.length=, track.grouser_height=, payload.from_front=, "
        "payload.height=. Give it again for more; the first two are the axes of the map.",
    ),
]
Goal = Annotated[
    str,
    typer.Option(
        help="margin: the largest margin on the worst of the stairs; go: the cheapest change that "
        "is a GO on all of them."
    ),
]
Weights = Annotated[
    list[str] | None,
    typer.Option(
        "--cost", metavar="NAME=NUMBER", help="Cost of changing it over its whole range [1]."
    ),
]
Grid = Annotated[
    int | None,
    typer.Option(help="Places of the map along each of two figures [21]; 0 for no map."),
]
Front = Annotated[
    int, typer.Option(min=0, max=100, help="Budgets for which the best design is sought.")
]
Tries = Annotated[int, typer.Option(min=10, max=1_000_000, help="Designs a search judges at most.")]
Seed = Annotated[int, typer.Option(min=0, help="Seed of the search.")]


def register(app: typer.Typer) -> None:
    """Add ``design`` to the command line."""
    app.command("design", epilog=f"Exit code: {EXIT_CODES}.")(design)


@shared((question_options,), values_of)
def design(
    values: dict[str, Any],
    free: FreeText,
    goal: Goal = "margin",
    cost: Weights = None,
    grid: Grid = None,
    front: Front = 0,
    tries: Tries = 400,
    seed: Seed = 0,
    scheduler: Scheduler = "threads",
    workers: Workers = None,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Find figures of ROBOT with which it takes STAIRS best, or with the least change.

    STAIRS may be several, joined by commas: the design is judged by the worst of them.
    """
    from kaidan.modes import Verdict
    from kaidan.verbs.design.designing import design as find

    pictures = output.checked(figure)
    robot, stairs = values.pop("robot"), values.pop("stairs", None)
    ranges = dict(_pair(each, "--free") for each in free)
    costs = dict(_pair(each, "--cost") for each in cost or ())
    found = find(
        _one(robot),
        stairs,
        free=ranges,
        goal=goal,  # type: ignore[arg-type]
        weights={name: _weight(name, text) for name, text in costs.items()},
        grid=grid,
        front=front,
        tries=tries,
        seed=seed,
        scheduler=scheduler,
        workers=workers,
        progress=True,
        **values,
    )

    def draw() -> "output.Figure":
        from kaidan.figures.design_figure import design_figure

        return design_figure(found)

    output.put_out(found, output.drawn(pictures, draw), as_json=as_json)
    code = Verdict(found.verdict).exit_code
    if code:
        raise typer.Exit(code)


def _one(robot: Any) -> Any:
    from kaidan.errors import InputError

    if isinstance(robot, list):
        raise InputError(f"a design is of one robot, not of {len(robot)}")
    return robot


def _pair(text: str, option: str) -> tuple[str, str]:
    from kaidan.errors import InputError, shown

    name, equals, value = text.partition("=")
    if not equals or not value.strip():
        raise InputError(f"{option} {shown(text)}: write NAME=VALUE")
    return name.strip(), value.strip()


def _weight(name: str, text: str) -> float:
    from kaidan.units import parse

    return parse(text, "number", option=f"--cost {name} =")
