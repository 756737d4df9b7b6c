"""Campaigns on a Dask scheduler: the same store, whatever dies."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

pytest.importorskip("pyarrow")
pytest.importorskip("distributed")

import campaign_cases
from campaign_cases import FAKE, specs
from kaidan.errors import InputError
from kaidan.work import DaskWorkers, Store, conduct, read_table

ENVIRONMENT = os.environ | {
    "PYTHONPATH": os.pathsep.join([str(Path(campaign_cases.__file__).parent), *sys.path]),
    "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "0",
    "DASK_DISTRIBUTED__ADMIN__LOW_LEVEL_LOG_LENGTH": "10",
}


def start(module, *words):
    return subprocess.Popen(
        [sys.executable, "-m", f"distributed.cli.{module}", *words],
        env=ENVIRONMENT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


@contextmanager
def scheduler(folder, workers=2, nanny=False):
    """Address of a scheduler of its own, with processes of workers."""
    file = folder / "scheduler.json"
    quiet = ["--scheduler-file", str(file), "--no-dashboard"]
    processes = [start("dask_scheduler", "--port", "0", "--host", "127.0.0.1", *quiet)]
    how = ["--nthreads", "1", "--nanny" if nanny else "--no-nanny"]
    for _ in range(workers):
        processes.append(start("dask_worker", *quiet, *how, "--local-directory", str(folder)))
    try:
        end = time.monotonic() + 120
        while not file.exists() or not file.read_text():  # being written
            assert time.monotonic() < end
            time.sleep(0.05)
        yield json.loads(file.read_text())["address"], processes
    finally:
        for process in processes:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                continue
        for process in processes:
            process.wait()


def rows(folder):
    return read_table(folder).to_pylist()


def test_one_of_two_workers_is_killed_in_mid_campaign(tmp_path):
    store = tmp_path / "store"
    killed = []

    def plan():
        for n in range(60):
            if n == 30:
                killed.append(rows(store)[-1]["pid"])
                os.kill(killed[0], signal.SIGKILL)
            yield {"n": n, "seconds": 0.02}

    with scheduler(tmp_path) as (address, _):
        with Store(store, FAKE) as opened, DaskWorkers(FAKE, address) as workers:
            tally = conduct(plan(), opened, workers)
        assert tally.outcomes == {"climbed": 60}
        found = rows(store)
        assert sorted(row["n"] for row in found) == list(range(60))
        assert killed[0] not in {row["pid"] for row in found if row["n"] >= 40}

        with Store(store, FAKE) as opened, DaskWorkers(FAKE, address) as workers:
            again = conduct(specs(62), opened, workers)
        assert (again.done, again.found) == (2, 60), "what a store has is not done again"


@pytest.mark.slow
def test_bad_news_is_data_on_a_scheduler_too(tmp_path):
    """A trial that kills its workers, started anew by their nannies, and one that raises."""
    plan = [
        {"n": n, **({"wrong": {3: "die", 5: "raise"}[n]} if n in (3, 5) else {})} for n in range(9)
    ]
    with (
        scheduler(tmp_path, workers=1, nanny=True) as (address, _),
        Store(tmp_path / "store", FAKE) as opened,
        DaskWorkers(FAKE, address, tries=2) as workers,
    ):
        tally = conduct(plan, opened, workers)
    assert tally.outcomes == {"climbed": 7, "crashed": 1, "failed": 1}
    found = {row["n"]: row for row in rows(tmp_path / "store")}
    assert found[3]["outcome"] == "crashed"
    assert found[3]["deaths"] == 2
    assert found[5]["error"] == "ZeroDivisionError: half a character ?"


@pytest.mark.slow
def test_kill_9_of_the_campaign_on_a_scheduler(tmp_path):
    store, notes = tmp_path / "store", tmp_path / "notes"
    notes.mkdir()
    with scheduler(tmp_path) as (address, _):
        campaign = campaign_cases.start(store, notes, 60, 0.03, address)
        campaign_cases.wait_until(lambda: len(campaign_cases.noted(notes)) >= 20)
        campaign.kill()
        campaign.communicate()
        kept = {row["n"] for row in rows(store)}
        assert len(kept) >= 20 - 2 * 3, "in flight: three for each of two threads"
        again = campaign_cases.start(store, notes, 60, 0.0, address)
        assert again.communicate()[0].decode().strip() == str(60 - len(kept))
    assert sorted(row["n"] for row in rows(store)) == list(range(60))
    twice = {n for n, pids in campaign_cases.noted(notes).items() if len(pids) > 1}
    assert not twice & kept, "what the store had was not done again"


def test_a_scheduler_that_goes_away_ends_the_campaign_and_keeps_what_is_done(tmp_path):
    with scheduler(tmp_path, workers=1) as (address, processes):

        def plan():
            for n in range(100):
                if n == 20:
                    processes[0].kill()
                yield {"n": n, "seconds": 0.01}

        with (
            Store(tmp_path / "store", FAKE) as opened,
            DaskWorkers(FAKE, address, patience=3.0) as workers,
            pytest.raises(InputError) as caught,
        ):
            conduct(plan(), opened, workers)
    assert str(caught.value) == (
        f"the Dask scheduler at {address!r} is gone; what is done is in the store"
    )
    assert len(rows(tmp_path / "store")) >= 10


def test_a_scheduler_without_workers(tmp_path):
    with (
        scheduler(tmp_path, workers=0) as (address, _),
        Store(tmp_path / "store", FAKE) as opened,
        DaskWorkers(FAKE, address, patience=0.5) as workers,
        pytest.raises(InputError) as caught,
    ):
        conduct(specs(3), opened, workers)
    assert str(caught.value) == (
        f"the Dask scheduler at {address!r} had no worker for 0.5 s; what is done is in the store"
    )


def test_no_scheduler_there(monkeypatch):
    address = "tcp://127.0.0.1:1"
    monkeypatch.setattr("kaidan.work.cluster.CONNECT", 1.0)
    with pytest.raises(InputError, match=f"^no Dask scheduler answers at {address!r}: "):
        DaskWorkers(FAKE, address)


@pytest.mark.parametrize("address", ["nonsense", "", "tcp://", "foo://x:1", "x" * 10_000])
def test_an_address_that_is_none_is_refused_at_once(address):
    with pytest.raises(InputError) as caught:
        DaskWorkers(FAKE, address)
    assert str(caught.value).endswith(
        " is no address of a Dask scheduler; write for example tcp://10.0.0.1:8786"
    )
    assert len(str(caught.value)) < 200


def test_a_sweep_on_a_scheduler_finds_the_same(tmp_path):
    from kaidan.sweeps.plan import Plan
    from kaidan.sweeps.running import carried_out

    plan = Plan.of({"robot": "absolem", "stairs": "ibc", "model": "closed-form", "flippers": "flat",
                    "com_height": [0.1, 0.2, 0.3], "friction": [0.6, 0.9]})  # fmt: skip
    with scheduler(tmp_path) as (address, _):
        found = carried_out(plan, scheduler=address)
        with pytest.raises(InputError, match="a Dask scheduler has workers of its own"):
            carried_out(plan, scheduler=address, workers=2)
    here = carried_out(plan)
    assert found.variables["margin_deg"].tolist() == here.variables["margin_deg"].tolist()
