"""``kaidan sweep``: verdicts over anything in a question."""

from pathlib import Path
from typing import Annotated, Any

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question_options, shared
from kaidan.cli.varying import Vary, varied

Table = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Write all cells: .parquet, .csv, or a folder .zarr."),
]
Screen = Annotated[
    bool,
    typer.Option(
        "--go-only",
        help="Skip the contact model where the closed form alone rules out a GO: which cells are a "
        "GO stays exact, the others get no margin.",
    ),
]
StoreFolder = Annotated[
    Path | None,
    typer.Option(
        "--store",
        metavar="DIR",
        help="Folder that keeps finished cells; the same command continues from it.",
    ),
]
Scheduler = Annotated[
    str,
    typer.Option(
        metavar="WHERE",
        help="processes or threads of this machine, or a Dask scheduler, tcp://HOST:8786 (only one "
        "you trust: Dask sends pickles, which run code).",
    ),
]
Workers = Annotated[
    int | None,
    typer.Option(min=1, max=1024, help="Processes or threads [one a processor]."),
]


def register(app: typer.Typer) -> None:
    """Add ``sweep`` to the command line."""
    app.command("sweep")(sweep)


def values_of(robot: str, stairs: str | None, **values: Any) -> dict[str, Any]:
    """Values by parameter, of the options of a question."""
    shape = {name: values.pop(name) for name in ("rise", "going", "angle", "nosing_spacing")}
    steps, points = values.pop("steps"), values.pop("points", None)
    found: dict[str, Any] = {
        {"theta_m": "theta_M"}.get(name, name): value
        for name, value in values.items()
        if value is not None
    }
    found["robot"] = _one_or_many(robot)
    many = _one_or_many(stairs) if stairs is not None else None
    if stairs is not None and stairs.lower().endswith(".csv"):
        from kaidan.verbs.stock.flights import Stock

        many = Stock.of_file(Path(stairs)).stairs()
    if isinstance(many, list):
        found["stairs"] = many
    elif stairs is not None or points is not None or any(shape.values()):
        found["stairs"] = options.terrain_of(stairs, points, steps=steps, **shape)
    return found


def _one_or_many(text: str) -> Any:
    names = [name.strip() for name in text.split(",")]
    return names if len(names) > 1 and not Path(text).exists() else text


@shared((question_options,), values_of)
def sweep(
    values: dict[str, Any],
    vary: Vary = None,
    go_only: Screen = False,
    table: Table = None,
    store: StoreFolder = None,
    scheduler: Scheduler = "processes",
    workers: Workers = None,
    as_json: options.AsJson = False,
) -> None:
    """Judge every combination of the values that vary, as assess judges one.

    ROBOT and STAIRS may be several, joined by commas. Exit code: 0, 2 bad input.
    """
    from kaidan.sweeps.plan import Plan
    from kaidan.sweeps.running import carried_out
    from kaidan.sweeps.summary import summary_of
    from kaidan.sweeps.swept import table_format

    if table is not None:
        table_format(table)
    plan = Plan.of(values | varied(vary), screen=go_only)
    few = len(plan) <= FEW and scheduler == "processes" and store is None
    try:
        found = carried_out(
            plan,
            scheduler="threads" if few else scheduler,
            workers=1 if few and workers is None else workers,
            store=store,
            progress=True,
        )
    except KeyboardInterrupt:
        if store is not None:
            typer.echo(f"kaidan: broken off; the same command goes on with {store}", err=True)
        raise typer.Exit(130) from None
    if table is not None:
        found.write(table)
    output.put_out(summary_of(found), {}, as_json=as_json)
    if table is not None:
        typer.echo(f"wrote {table}: {len(found)} cells", err=as_json)


FEW = 32
"""Cells for which no process is started."""
