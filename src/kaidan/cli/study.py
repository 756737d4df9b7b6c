"""``kaidan study``: many robots on many stairs, counted."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question_options, shared
from kaidan.cli.sweep import Scheduler, Screen, StoreFolder, Table, Workers

if TYPE_CHECKING:
    from kaidan.studies.stock.flights import Stock

group = typer.Typer(
    name="study", help="Study a fleet of robots on a stock of stairs.", no_args_is_help=True
)
_NOT_OPTIONS = (
    "robot",
    "stairs",
    "points",
    "rise",
    "going",
    "angle",
    "nosing_spacing",
    "steps",
    "uniform_across",
)

Robots = Annotated[
    str,
    typer.Option(
        metavar="NAMES",
        help="Names or TOML files joined by commas, a folder of TOML files, or all.",
    ),
]
StairsOfStock = Annotated[
    str | None,
    typer.Option(
        "--stairs",
        metavar="FILE|NAMES",
        help="CSV file with columns rise,going and any of steps, lower_landing, upper_landing, "
        "width, flights (how many a row stands for); or names of the catalogue joined by commas.",
    ),
]
Draw = Annotated[
    list[str] | None,
    typer.Option(
        "--draw",
        metavar="NAME=VALUES",
        help="Draw flights instead: rise=140mm..200mm (evenly), going=260mm+-20mm (normal, one "
        "sigma), steps=3..18. May be given again.",
    ),
]
Count = Annotated[int, typer.Option("--flights", min=1, help="Flights to draw.")]
Rule = Annotated[
    str | None,
    typer.Option(help="Stepping rule of drawn flights, 2 rise + going: 590mm..650mm."),
]
To = Annotated[str, typer.Option("--round", help="Drawn lengths are rounded to this.")]
Seed = Annotated[int, typer.Option(min=0, help="Seed of the draws.")]


def register(app: typer.Typer) -> None:
    """Add ``study`` to the command line."""
    app.add_typer(group)


def manner_of(**values: Any) -> dict[str, Any]:
    """Values of a question by parameter."""
    found = {name: value for name, value in values.items() if value is not None}
    return {{"theta_m": "theta_M"}.get(name, name): value for name, value in found.items()}


@group.command("stock")
@shared((question_options,), manner_of, without=_NOT_OPTIONS)
def stock(
    manner: dict[str, Any],
    robots: Robots,
    stairs: StairsOfStock = None,
    draw: Draw = None,
    flights: Count = 1000,
    rule: Rule = None,
    rounded: To = "1mm",
    seed: Seed = 0,
    go_only: Screen = False,
    store: StoreFolder = None,
    scheduler: Scheduler = "processes",
    workers: Workers = None,
    figure: output.FigureFiles = None,
    csv: output.CsvFile = None,
    table: Table = None,
    as_json: options.AsJson = False,
) -> None:
    """Count which share of a stock of stairs each robot takes, and what stops it.

    Exit code: 0, 2 bad input.
    """
    from kaidan import files
    from kaidan.errors import InputError
    from kaidan.studies.stock.study import stock_study
    from kaidan.sweeps.swept import table_format

    pictures = output.checked(figure, csv)
    if table is not None:
        table_format(table)
    if (stairs is None) == (not draw):
        raise InputError("give either --stairs or --draw")
    flights_of = _stock_of(stairs, draw or [], flights, rule, rounded, seed)
    try:
        found, swept = stock_study(
            _fleet(robots),
            flights_of,
            go_only=go_only,
            scheduler=scheduler,
            workers=workers,
            store=store,
            progress=True,
            **manner,
        )
    except KeyboardInterrupt:
        if store is not None:
            typer.echo(f"kaidan: broken off; the same command goes on with {store}", err=True)
        raise typer.Exit(130) from None
    if table is not None:
        swept.write(table)

    def picture() -> "output.Figure":
        from kaidan.figures.stock_figure import stock_figure

        return stock_figure(found)

    contents: output.Contents = {} if csv is None else {csv: files.csv_text(found.columns())}
    output.put_out(found, contents | output.drawn(pictures, picture), as_json=as_json)
    if table is not None:
        typer.echo(f"wrote {table}: {len(swept)} pairs", err=as_json)


def _stock_of(
    stairs: str | None, draw: list[str], count: int, rule: str | None, to: str, seed: int
) -> "Stock":
    from kaidan.errors import InputError, shown
    from kaidan.studies.stock.flights import Stock
    from kaidan.terrain.stairs import Stairs
    from kaidan.units import parse, parse_range

    if stairs is not None:
        if stairs.lower().endswith(".csv") or Path(stairs).suffix.lower() == ".csv":
            return Stock.of_file(Path(stairs))
        return Stock.of_stairs([Stairs.named(name.strip()) for name in stairs.split(",")])
    figures: dict[str, str] = {}
    for text in draw:
        name, equals, value = text.partition("=")
        if not equals or name.strip() in figures:
            raise InputError(f"--draw {shown(text)}: write each NAME=VALUES once")
        figures[name.strip()] = value.strip()
    return Stock.drawn(
        figures,
        count,
        rule=None if rule is None else parse_range(rule, "length", option="--rule"),
        to=parse(to, "length", option="--round"),
        seed=seed,
    )


def _fleet(text: str) -> list[Any]:
    from kaidan import catalog
    from kaidan.errors import InputError

    if text.strip() == "all":
        return list(catalog.names("robots"))
    if Path(text).is_dir():
        files = sorted(Path(text).glob("*.toml"))
        if not files:
            raise InputError(f"folder {text!r} has no TOML file")
        return [str(each) for each in files]
    return [name.strip() for name in text.split(",")]
