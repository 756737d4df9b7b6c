"""A whole campaign from a plan: store, workers, progress."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from kaidan.lab.campaign.plans import Grid, VerificationTest, as_stored, plan_from
from kaidan.lab.campaign.trials import TRIALS
from kaidan.work.cluster import DaskWorkers
from kaidan.work.id_set import Known
from kaidan.work.job import Work
from kaidan.work.local import LocalWorkers, Workers
from kaidan.work.progress import Progress
from kaidan.work.query import read_batches, read_table
from kaidan.work.runner import Tally, conduct
from kaidan.work.store import Store
from kaidan.work.store_files import about_store, refusal


def carry_out(
    plan: VerificationTest | Grid,
    store: str | Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: bool = False,
) -> Tally:
    """Do what a store does not have yet of a plan.

    Parameters
    ----------
    plan : VerificationTest or Grid
        What trials.
    store : str or Path
        Folder of the results; made if it does not exist, resumed if it does.
    workers : int, optional
        Processes on this machine; without one each processor gets one.
    scheduler : str, optional
        Address of a running Dask scheduler, whose workers do it instead.
    progress : bool
        Whether to show on standard error how it goes, if that is a terminal.

    Raises
    ------
    InputError
        The store is being written or is none, no scheduler answers, or no worker can do a trial.
    MissingExtraError
        MuJoCo, pyarrow or distributed is not installed.
    """
    TRIALS.version()
    with (
        Store(Path(store), TRIALS) as opened,
        _workers(workers, scheduler) as hands,
        Progress(len(plan), shown=progress) as bar,
    ):
        opened.note_plan(as_stored(plan))
        return conduct(plan.specs(), opened, hands, listener=bar)


def rows_of(
    work: Work,
    specs: Sequence[Any],
    store: str | Path,
    columns: Sequence[str],
    *,
    workers: int | None = None,
    progress: bool = False,
) -> list[dict[str, Any]]:
    """Rows of some specs, on all processors of this machine; those in the store are not done again.

    work: what is done with each.
    store: folder of the results; made if it does not exist, resumed if it does.
    workers: processes; without one each processor gets one.
    progress: whether to show on standard error how it goes, if that is a terminal.
    """
    with (
        Store(Path(store), work) as opened,
        LocalWorkers(work, workers) as hands,
        Progress(len(specs), shown=progress) as bar,
    ):
        conduct(specs, opened, hands, listener=bar)
    table = read_table(store, ["id", *columns]).to_pylist()
    found = {row.pop("id"): row for row in table}
    return [found[work.identity(spec)] for spec in specs]


def resume(
    store: str | Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: bool = False,
) -> Tally:
    """Do what a store does not have yet of the plans that were begun in it.

    Parameters are those of `carry_out`.

    Raises
    ------
    InputError, MissingExtraError
        As `carry_out`.
    """
    about = _about_trials(Path(store))
    done = found = 0
    outcomes: Counter[str] = Counter()
    for stored in about["plans"]:
        tally = carry_out(
            plan_from(stored), store, workers=workers, scheduler=scheduler, progress=progress
        )
        done, found = done + tally.done, found + tally.found
        outcomes.update(tally.outcomes)
    return Tally(done, found, dict(outcomes))


class PlanProgress(NamedTuple):
    """How far a plan of a store is."""

    kind: str
    trials: int
    """Different trials of the plan."""
    done: int

    @property
    def missing(self) -> int:
        """Trials that are not in the store."""
        return self.trials - self.done


def progress_of(store: str | Path) -> list[PlanProgress]:
    """How far each plan of a store is, with the physics of now.

    Raises
    ------
    InputError, MissingExtraError
        No store, a plan of another version, or no MuJoCo, whose version belongs to a trial.
    """
    folder = Path(store)
    about = _about_trials(folder)
    known = Known()
    for batch in read_batches(folder, ["id"]):
        known.update(batch.column("id").to_pylist())
    found = []
    for stored in about["plans"]:
        different, done = Known(), 0
        for spec in plan_from(stored).specs():
            identity = TRIALS.identity(spec)
            done += different.add(identity) and identity in known
        found.append(PlanProgress(stored["kind"], len(different), done))
    return found


def _about_trials(folder: Path) -> dict[str, Any]:
    """What a store of trials holds."""
    about = about_store(folder)
    assert about is not None
    if about["work"] != TRIALS.name:
        raise refusal(folder, f"holds {about['work']}: the command that began it goes on with it")
    return about


def _workers(count: int | None, scheduler: str | None) -> Workers:
    return LocalWorkers(TRIALS, count) if scheduler is None else DaskWorkers(TRIALS, scheduler)
