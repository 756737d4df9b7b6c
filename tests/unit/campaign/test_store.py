"""The store: each trial once, whatever happens to who writes it."""

import json
import os
import subprocess
import sys

import pytest

pytest.importorskip("pyarrow")

from campaign_cases import FAKE
from kaidan.campaign import Store, export, read_table, state_of, store
from kaidan.campaign.known import Known
from kaidan.errors import InputError


def row(n):
    return {"id": f"{n:032x}", "outcome": "climbed", "version": "fake 1", "n": n, "square": 1.0}


def numbers(folder):
    return sorted(read_table(folder, ["n"]).column("n").to_pylist())


def test_rows_come_back_as_they_were(tmp_path):
    with Store(tmp_path, FAKE) as opened:
        opened.add([row(1), {**row(2), "error": "Grad °", "square": None}])
    table = read_table(tmp_path)
    assert table.column_names == ["id", "outcome", "error", "deaths", "host", "version", "n",
                                  "square", "pid"]  # fmt: skip
    assert table.to_pylist()[1] == {
        **dict.fromkeys(table.column_names), **row(2), "error": "Grad °", "square": None,
    }  # fmt: skip


def test_a_trial_is_taken_once(tmp_path):
    with Store(tmp_path, FAKE) as opened:
        opened.add([row(1), row(1)])
        opened.add([row(1), row(2)])
    with Store(tmp_path, FAKE) as opened:
        opened.add([row(2), row(3)])
    assert numbers(tmp_path) == [1, 2, 3]


def test_rows_not_settled_are_read_from_the_journal(tmp_path):
    opened = Store(tmp_path, FAKE)
    opened.add([row(1)])
    assert not list((tmp_path / "parts").iterdir())
    assert numbers(tmp_path) == [1]
    opened.settle()
    assert numbers(tmp_path) == [1]
    opened.__exit__(None, None, None)


def killed_while(tmp_path, monkeypatch, name):
    """Store whose writer stopped dead at a call, with rows 1 to 3 taken in."""

    class Dead(BaseException):
        pass

    def dies(*_args, **_kwargs):
        raise Dead

    opened = Store(tmp_path, FAKE)
    opened.add([row(1), row(2), row(3)])
    with monkeypatch.context() as patch:
        patch.setattr(store.Path, name, dies)
        with pytest.raises(Dead):
            opened.settle()
    opened._lock.release()


@pytest.mark.parametrize("step", ["open", "replace", "unlink"])
def test_death_at_any_step_of_settling_leaves_each_trial_once(tmp_path, monkeypatch, step):
    """Before the part is written, between writing and renaming, between renaming and deleting."""
    killed_while(tmp_path, monkeypatch, step)
    assert len(list(tmp_path.glob("journal-*"))) == 1
    assert numbers(tmp_path) == [1, 2, 3], "a reader sees each once even before the repair"
    with Store(tmp_path, FAKE) as opened:
        assert len(opened.known) == 3
        opened.add([row(3), row(4)])
    assert numbers(tmp_path) == [1, 2, 3, 4]
    assert not list(tmp_path.glob("journal-*"))
    assert not list(tmp_path.glob(".*passing"))
    parts = store.arrow("pyarrow.parquet").read_table(tmp_path / "parts")
    assert sorted(parts.column("n").to_pylist()) == [1, 2, 3, 4], "to any reader of Parquet too"


def test_a_half_written_line_is_a_trial_to_be_done_again(tmp_path):
    opened = Store(tmp_path, FAKE)
    opened.add([row(1), row(2)])
    opened._lock.release()
    journal = next(tmp_path.glob("journal-*"))
    journal.write_bytes(journal.read_bytes()[:-9])
    with Store(tmp_path, FAKE) as opened:
        assert row(1)["id"] in opened.known
        assert row(2)["id"] not in opened.known
        opened.add([row(2)])
    assert numbers(tmp_path) == [1, 2]


def test_parts_have_a_bounded_number_of_rows(tmp_path, monkeypatch):
    monkeypatch.setattr(store, "ROWS", 10)
    with Store(tmp_path, FAKE) as opened:
        for n in range(25):
            opened.add([row(n)])
    assert len(list((tmp_path / "parts").iterdir())) == 3
    assert numbers(tmp_path) == list(range(25))


def test_two_campaigns_cannot_write_one_store(tmp_path):
    with Store(tmp_path, FAKE):
        here = f"process {os.getpid()} on {os.uname().nodename}"
        with pytest.raises(InputError) as caught:
            Store(tmp_path, FAKE)
        assert str(caught.value) == (f"store {str(tmp_path)!r}: a campaign is writing it ({here})")
        assert state_of(tmp_path).writer == here
    assert state_of(tmp_path).writer is None
    Store(tmp_path, FAKE).__exit__(None, None, None)


def test_the_lock_of_a_killed_process_is_no_lock(tmp_path):
    code = (
        "import os, pathlib, sys\n"
        "from kaidan.campaign.lock import Lock\n"
        "lock = Lock(pathlib.Path(sys.argv[1]))\n"
        "os.kill(os.getpid(), 9)\n"
    )
    assert subprocess.run([sys.executable, "-c", code, str(tmp_path)]).returncode == -9
    Store(tmp_path, FAKE).__exit__(None, None, None)


def test_folders_that_are_no_store(tmp_path):
    with pytest.raises(InputError) as caught:
        read_table(tmp_path / "nowhere")
    assert str(caught.value) == (
        f"store {str(tmp_path / 'nowhere')!r}: no such store (campaign.json is missing)"
    )
    (tmp_path / "file").touch()
    with pytest.raises(InputError) as caught:
        Store(tmp_path / "file", FAKE)
    assert str(caught.value) == f"store {str(tmp_path / 'file')!r}: cannot be used: Not a directory"
    (tmp_path / "campaign.json").write_text('{"format": 99}')
    with pytest.raises(InputError) as caught:
        Store(tmp_path, FAKE)
    assert str(caught.value) == f"store {str(tmp_path)!r}: campaign.json is not of format 1"


def test_a_store_of_other_work_or_other_columns(tmp_path):
    Store(tmp_path, FAKE).__exit__(None, None, None)
    about = json.loads((tmp_path / "campaign.json").read_text())
    (tmp_path / "campaign.json").write_text(json.dumps(about | {"work": "sums"}))
    with pytest.raises(InputError) as caught:
        Store(tmp_path, FAKE)
    assert str(caught.value) == f"store {str(tmp_path)!r}: holds sums, not fake"
    (tmp_path / "campaign.json").write_text(json.dumps(about | {"columns": {"id": "text"}}))
    with pytest.raises(InputError, match="another version of kaidan wrote it"):
        Store(tmp_path, FAKE)


def test_a_damaged_part_is_named(tmp_path):
    with Store(tmp_path, FAKE) as opened:
        opened.add([row(1)])
    part = tmp_path / "parts" / "part-000001.parquet"
    part.write_bytes(b"PAR1")
    with pytest.raises(InputError) as caught:
        read_table(tmp_path)
    assert str(caught.value).startswith(f"{part}: cannot be read: ")


@pytest.mark.parametrize("suffix", [".parquet", ".csv"])
def test_export_is_one_file_of_all(tmp_path, suffix):
    opened = Store(tmp_path, FAKE)
    opened.add([row(1), row(2)])
    opened.settle()
    opened.add([row(3)])
    file = tmp_path / f"all{suffix}"
    assert export(tmp_path, file) == 3
    opened.__exit__(None, None, None)
    if suffix == ".csv":
        lines = file.read_text().splitlines()
        assert lines[0] == '"id","outcome","error","deaths","host","version","n","square","pid"'
        assert len(lines) == 4
    else:
        table = store.arrow("pyarrow.parquet").read_table(file)
        assert table.column("n").to_pylist() == [1, 2, 3]
    assert not list(tmp_path.glob(".all*"))


def test_export_refusals(tmp_path):
    with Store(tmp_path, FAKE):
        pass
    with pytest.raises(InputError) as caught:
        export(tmp_path, tmp_path / "all.xls")
    assert str(caught.value) == (
        f"export {str(tmp_path / 'all.xls')!r}: unknown suffix '.xls'; known: .parquet, .csv"
    )
    with pytest.raises(InputError, match="cannot be written: No such file or directory"):
        export(tmp_path, tmp_path / "nowhere" / "all.csv")


def test_state(tmp_path):
    with Store(tmp_path, FAKE) as opened:
        opened.add([row(1), {**row(2), "outcome": "unstable", "version": "fake 2"}])
    state = state_of(tmp_path)
    assert state.trials == 2
    assert state.outcomes == {"climbed": 1, "unstable": 1}
    assert state.versions == {"fake 1": 1, "fake 2": 1}


def test_known_identities_past_its_buffer(monkeypatch):
    monkeypatch.setattr("kaidan.campaign.known._RECENT", 7)
    known = Known()
    some = [f"{(n * 0x9E3779B97F4A7C15F39CC0605CEDC835) % 2**128:032x}" for n in range(100)]
    same_start = [f"{1:016x}{n:016x}" for n in range(20)]
    for identity in (*some, *same_start):
        assert identity not in known
        assert known.add(identity)
        assert not known.add(identity)
    assert len(known) == 120
    assert all(identity in known for identity in (*some, *same_start))
    assert f"{2:016x}{3:016x}" not in known
