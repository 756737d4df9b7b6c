"""A whole campaign from a plan: store, workers, progress."""

from collections import Counter
from pathlib import Path
from typing import Any

from kaidan.campaign.cluster import DaskWorkers
from kaidan.campaign.conducting import Tally, conduct
from kaidan.campaign.local import LocalWorkers, Workers
from kaidan.campaign.plans import Grid, VerificationTest, as_stored, plan_from
from kaidan.campaign.progress import Progress
from kaidan.campaign.store import Store, about_store
from kaidan.campaign.trials import TRIALS


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

    Returns
    -------
    Tally

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
        Progress(len(plan), shown=progress) as told,
    ):
        opened.note_plan(as_stored(plan))
        return conduct(plan.specs(), opened, hands, told=told)


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
    about = about_store(Path(store))
    assert about is not None
    done = found = 0
    outcomes: Counter[str] = Counter()
    for stored in about["plans"]:
        tally = carry_out(
            plan_from(stored), store, workers=workers, scheduler=scheduler, progress=progress
        )
        done, found = done + tally.done, found + tally.found
        outcomes.update(tally.outcomes)
    return Tally(done, found, dict(outcomes))


def missing(plan: VerificationTest | Grid, known: Any) -> int:
    """How many trials of a plan are not among known identities."""
    identities = {TRIALS.identity(spec) for spec in plan.specs()}
    return sum(identity not in known for identity in identities)


def _workers(count: int | None, scheduler: str | None) -> Workers:
    return LocalWorkers(TRIALS, count) if scheduler is None else DaskWorkers(TRIALS, scheduler)
