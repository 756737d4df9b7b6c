"""``kaidan lab campaign``: what a store of trials holds, going on with it, one file of it all."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import options
from kaidan.cli.tables import echo
from kaidan.lab.cli.experiment import Scheduler, Workers

group = typer.Typer(
    name="campaign", help="Show, resume or export a store of trials.", no_args_is_help=True
)

Folder = Annotated[Path, typer.Argument(metavar="STORE", help="Folder of a store.")]


def register(app: typer.Typer) -> None:
    """Add ``campaign`` to the command line."""
    app.add_typer(group)


@group.command("status")
def status(store: Folder, as_json: options.AsJson = False) -> None:
    """Tell what a store holds and what is missing of its plans."""
    from kaidan import files
    from kaidan.lab.campaign import progress_of
    from kaidan.work import state_of

    state = state_of(store)
    plans = progress_of(store)
    if as_json:
        whole = {
            "work": state.work,
            "trials": state.trials,
            "outcomes": state.outcomes,
            "versions": state.versions,
            "writer": state.writer,
            "plans": [{**each._asdict(), "missing": each.missing} for each in plans],
        }
        typer.echo(files.json_text(whole), nl=False)
        return
    echo(f"{store}: {state.trials} trials ({state.work})")
    for each in plans:
        echo(f"  {each.kind:<18} {each.done} of {each.trials} done, {each.missing} missing")
    for outcome, count in state.outcomes.items():
        echo(f"  {outcome:<18} {count}")
    for version, count in state.versions.items():
        echo(f"  {count} with {version}")
    if state.writer is not None:
        echo(f"  being written by {state.writer}")


@group.command("resume")
def resume(store: Folder, workers: Workers = None, scheduler: Scheduler = None) -> None:
    """Do what is missing of the plans of a store."""
    from kaidan.errors import InputError
    from kaidan.lab import campaign

    if workers is not None and scheduler is not None:
        raise InputError("give either --workers or --scheduler, not both")
    try:
        tally = campaign.resume(store, workers=workers, scheduler=scheduler, progress=True)
    except KeyboardInterrupt:
        typer.echo(f"kaidan: broken off; the same command goes on with {store}", err=True)
        raise typer.Exit(130) from None
    echo(f"{store}: {tally.done} trials done, {tally.found} in the store before")
    for outcome, count in sorted(tally.outcomes.items()):
        echo(f"  {outcome:<18} {count}")


@group.command("export")
def export(
    store: Folder,
    file: Annotated[Path, typer.Argument(metavar="FILE", help="To be written: .parquet or .csv.")],
) -> None:
    """Write all trials of a store as one file."""
    from kaidan import work

    count = work.export(store, file)
    echo(f"wrote {file}: {count} trials")
