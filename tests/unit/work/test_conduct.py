"""Campaigns of local processes: complete, exactly once, whatever dies."""

import os
import signal
from collections import Counter
from pathlib import Path

import pytest

pytest.importorskip("pyarrow")

from campaign_cases import FAKE, local_campaign, noted, specs, start, wait_until
from kaidan.errors import InputError
from kaidan.work import LocalWorkers, Store, conduct, read_table
from kaidan.work.local import MOST
from kaidan.work.progress import Progress


def rows(folder):
    return {row["n"]: row for row in read_table(folder).to_pylist()}


def numbers(folder):
    return sorted(read_table(folder, ["n"]).column("n").to_pylist())


def test_every_trial_once_and_again_nothing(tmp_path):
    assert local_campaign(tmp_path, specs(20)).done == 20
    assert numbers(tmp_path) == list(range(20))
    assert len({row["pid"] for row in rows(tmp_path).values()}) == 2
    again = local_campaign(tmp_path, specs(23))
    assert (again.done, again.found) == (3, 20)
    assert numbers(tmp_path) == list(range(23))


def test_a_plan_that_names_a_trial_twice(tmp_path):
    tally = local_campaign(tmp_path, [{"n": 1}, {"n": 1}, {"n": 2}, {"n": 1}], count=1)
    assert (tally.done, tally.found) == (2, 2)
    assert numbers(tmp_path) == [1, 2]


def test_bad_news_is_data(tmp_path):
    plan = [{"n": 0}, {"n": 1, "wrong": "odd"}, {"n": 2, "wrong": "raise"}, {"n": 3}]
    tally = local_campaign(tmp_path, plan, count=1)
    assert tally.outcomes == {"climbed": 2, "unstable": 1, "failed": 1}
    assert rows(tmp_path)[2]["error"] == "ZeroDivisionError: half a character ?"
    assert rows(tmp_path)[2]["n"] == 2, "its inputs are known all the same"


def test_a_trial_that_kills_its_worker_again_and_again_is_an_outcome(tmp_path):
    plan = [{"n": n, **({"wrong": "die"} if n == 3 else {})} for n in range(8)]
    tally = local_campaign(tmp_path, plan, tries=2)
    assert tally.outcomes == {"climbed": 7, "crashed": 1}
    assert rows(tmp_path)[3]["error"] == "its worker died 2 times"
    assert {n: row["deaths"] for n, row in rows(tmp_path).items() if row["deaths"]} == {3: 2}
    assert numbers(tmp_path) == list(range(8))


def test_a_trial_whose_worker_dies_once_is_done_again(tmp_path):
    notes = tmp_path / "notes"
    notes.mkdir()
    plan = [
        {"n": n, "folder": str(notes), **({"wrong": "die once"} if n == 3 else {})}
        for n in range(8)
    ]
    tally = local_campaign(tmp_path / "store", plan)
    assert tally.outcomes == {"climbed": 8}
    assert numbers(tmp_path / "store") == list(range(8))


def test_killed_workers_are_replaced(tmp_path):
    """kill -9 from outside, at a moment of its own."""
    folder = tmp_path / "store"
    killed = []

    def plan():
        for n in range(12):
            if n == 8:  # asked for when some have come back
                killed.append(next(iter(rows(folder).values()))["pid"])
                os.kill(killed[0], signal.SIGKILL)
            yield {"n": n, "seconds": 0.02}

    assert local_campaign(folder, plan()).outcomes == {"climbed": 12}
    assert numbers(folder) == list(range(12))
    assert killed[0] not in {row["pid"] for n, row in rows(folder).items() if n >= 10}


def test_a_package_missing_where_it_runs_ends_the_campaign(tmp_path):
    with pytest.raises(InputError) as caught:
        local_campaign(tmp_path, [{"n": 0}, {"n": 1, "wrong": "missing"}], count=1)
    assert str(caught.value) == (
        f"the campaign ends: the worker on {os.uname().nodename}: no module called luck"
    )
    assert numbers(tmp_path) == [0]
    assert local_campaign(tmp_path, specs(2), count=1).done == 1


def test_processes_that_cannot_even_begin_are_no_outcome(tmp_path, monkeypatch):
    monkeypatch.setattr("kaidan.work.local.become_worker", os._exit)  # wants an argument
    with pytest.raises(InputError, match="die as soon as they begin"):
        local_campaign(tmp_path, specs(3), count=1)
    assert numbers(tmp_path) == []


def test_another_version_at_the_worker_ends_the_campaign(tmp_path):
    with Store(tmp_path, FAKE) as store, LocalWorkers(FAKE, 1) as workers:
        workers.version = "fake 2"
        with pytest.raises(InputError, match=r"has fake 1, the campaign fake 2$"):
            conduct(specs(2), store, workers)


def test_a_worker_that_is_held_up_hands_its_tasks_over(tmp_path):
    """The one that is held up keeps what it has begun and, at most, what lies in its pipe."""
    plan = [{"n": n, "seconds": 2.0 if n == 40 else 0.01} for n in range(100)]
    local_campaign(tmp_path, plan)
    table = read_table(tmp_path, ["n", "pid"]).to_pylist()
    held_up = next(row["pid"] for row in table if row["n"] == 40)
    assert sorted(row["n"] for row in table) == list(range(100))
    assert sum(row["pid"] == held_up and row["n"] > 40 for row in table) <= 2


def test_planning_is_lazy(tmp_path):
    """A plan of any length: never more asked for than is done and in flight."""
    asked = []

    class EnoughError(Exception):
        pass

    def endless():
        n = 0
        while True:
            asked.append(n)
            yield {"n": n}
            n += 1

    class Stop:
        done = 0

        def advance(self, done, skipped):
            self.done += done
            assert len(asked) <= self.done + 2 * MOST
            if self.done >= 20:
                raise EnoughError

    with (
        Store(tmp_path, FAKE) as store,
        LocalWorkers(FAKE, 2) as workers,
        pytest.raises(EnoughError),
    ):
        conduct(endless(), store, workers, listener=Stop())
    assert len(numbers(tmp_path)) >= 20, "what is done is kept when a campaign is broken off"


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    state = Path(f"/proc/{pid}/stat")
    return not state.exists() or state.read_text().rpartition(")")[2].split()[0] != "Z"


def test_kill_9_of_the_campaign_and_the_same_command_again(tmp_path):
    store, notes = tmp_path / "store", tmp_path / "notes"
    notes.mkdir()
    campaign = start(store, notes, 60, 0.03)
    wait_until(lambda: len(noted(notes)) >= 20)
    campaign.kill()
    campaign.communicate()
    workers = {pid for pids in noted(notes).values() for pid in pids}
    wait_until(lambda: not any(alive(pid) for pid in workers))
    begun = noted(notes)
    kept = numbers(store)
    assert len(set(kept)) == len(kept)
    assert len(begun) - len(kept) <= 4, "in flight: two workers with two trials each"

    again = start(store, notes, 60, 0.0)
    assert again.communicate()[0].decode().strip() == str(60 - len(kept))
    assert again.returncode == 0
    assert numbers(store) == list(range(60))
    twice = Counter(n for n, pids in noted(notes).items() if len(pids) > 1)
    assert set(twice) <= set(begun) - set(kept), "what the store had was not done again"


def test_progress_is_shown_on_a_terminal_and_nowhere_else(capsys, monkeypatch):
    for variable in ("FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(variable, raising=False)
    with Progress(5, shown=True) as bar:
        bar.advance(2, 0)
    assert capsys.readouterr() == ("", "")
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    with Progress(5, shown=True) as bar:
        bar.advance(0, 2)
        bar.advance(3, 0)
    out, err = capsys.readouterr()
    assert out == ""
    assert "3/3" in err, "what was found done is no work"
    assert "left" in err
