"""The store: each trial once, whatever happens to who writes it."""

import dataclasses
import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("pyarrow")

from campaign_cases import FAKE
from kaidan.campaign import Store, export, progress_of, read_table, resume, state_of, store
from kaidan.campaign.id_set import Known
from kaidan.campaign.store_files import about_store, write_about
from kaidan.campaign.trials import TRIALS
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


KILLED = """
import os, pathlib, sys
from kaidan.campaign import Store
from test_store import FAKE, row

opened = Store(sys.argv[1], FAKE)
opened.add([row(1), row(2), row(3)])
module, name = sys.argv[2].split(".")
where = {"os": os, "Path": pathlib.Path}[module]
setattr(where, name, lambda *_, **__: os._exit(9))
opened.settle()
"""


@pytest.mark.parametrize("step", ["os.open", "os.fsync", "os.replace", "Path.unlink"])
def test_death_at_any_step_of_settling_leaves_each_trial_once(tmp_path, step):
    """Before the part is written, before it is on disk, before its name, before the deleting."""
    tests = Path(__file__).parents[2]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([*sys.path, str(tests)])}
    command = [sys.executable, "-c", KILLED, str(tmp_path), step]
    environment["PYTHONPATH"] += os.pathsep + str(Path(__file__).parent)
    assert subprocess.run(command, env=environment, timeout=60).returncode == 9
    assert len(list(tmp_path.glob("journal-*"))) == 1
    assert numbers(tmp_path) == [1, 2, 3], "a reader sees each once even before the repair"
    with Store(tmp_path, FAKE) as opened:
        assert len(opened.known) == 3
        opened.add([row(3), row(4)])
    assert numbers(tmp_path) == [1, 2, 3, 4]
    assert not list(tmp_path.glob("journal-*"))
    assert not list(tmp_path.rglob(".kaidan-*"))
    parts = pytest.importorskip("pyarrow.parquet").read_table(tmp_path / "parts")
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
    assert str(caught.value) == f"store {str(tmp_path)!r}: campaign.json is not of format 2"


def test_a_store_of_other_work_or_other_columns(tmp_path):
    Store(tmp_path, FAKE).__exit__(None, None, None)
    about = about_store(tmp_path)
    write_about(tmp_path, about | {"work": "sums"})
    with pytest.raises(InputError) as caught:
        Store(tmp_path, FAKE)
    assert str(caught.value) == f"store {str(tmp_path)!r}: holds sums, not fake"
    write_about(tmp_path, about | {"columns": {"id": "text"}})
    with pytest.raises(InputError, match="another version of kaidan wrote it"):
        Store(tmp_path, FAKE)


def filled(folder, *, settled):
    """Store of five rows, in a part or still in a journal."""
    opened = Store(folder, FAKE)
    opened.add([row(n) for n in range(5)])
    if settled:
        opened.settle()
    opened._lock.release()
    return next(folder.glob("parts/*" if settled else "journal-*"))


def test_a_damaged_part_is_named(tmp_path):
    part = filled(tmp_path, settled=True)
    part.write_bytes(b"PAR1")
    for reads in (read_table, state_of, lambda folder: Store(folder, FAKE)):
        with pytest.raises(InputError) as caught:
            reads(tmp_path)
        assert str(caught.value) == f"{part}: is damaged: its checksum is not that of its name"


def test_a_damaged_line_of_a_journal_is_named(tmp_path):
    journal = filled(tmp_path, settled=False)
    journal.write_bytes(journal.read_bytes().replace(b'"n": 1', b'"n": 7'))
    for reads in (read_table, lambda folder: Store(folder, FAKE)):
        with pytest.raises(InputError) as caught:
            reads(tmp_path)
        assert str(caught.value) == (
            f"{journal}: line 2 is damaged: delete it, and its trial is done again"
        )
    lines = journal.read_bytes().split(b"\n")
    journal.write_bytes(b"\n".join([lines[0], *lines[2:]]))
    assert numbers(tmp_path) == [0, 2, 3, 4]


@pytest.mark.parametrize("file", ["part", "journal", "campaign.json"])
def test_no_flipped_bit_passes_unseen(tmp_path, file):
    """400 of each: refused, or (at the end of a journal) a trial that is to be done again."""
    path = filled(tmp_path, settled=file == "part")
    path = tmp_path / file if file == "campaign.json" else path
    good, rows = path.read_bytes(), read_table(tmp_path).to_pylist()
    draw = random.Random(8)
    refused = shorter = 0
    for _ in range(400):
        bad = bytearray(good)
        bad[draw.randrange(len(bad))] ^= 1 << draw.randrange(8)
        path.write_bytes(bad)
        try:
            found = read_table(tmp_path).to_pylist()
        except InputError:
            refused += 1
        else:
            shorter += 1
            # the last line, or the last two with the line feed between them
            assert found in (rows[:-1], rows[:-2])
    assert refused + shorter == 400
    assert shorter == 0 or file == "journal"


@pytest.mark.parametrize(
    "name", ["parts/part-000001 (copy).parquet", "parts/part-x.parquet", "journal-.jsonl"]
)
def test_foreign_files_are_named(tmp_path, name):
    filled(tmp_path, settled=True)
    (tmp_path / name).write_bytes(b"")
    for reads in (read_table, state_of, lambda folder: Store(folder, FAKE)):
        with pytest.raises(InputError) as caught:
            reads(tmp_path)
        assert str(caught.value) == (
            f"store {str(tmp_path)!r}: {name!r} is no file of a store of this version; move it away"
        )


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders")
@pytest.mark.parametrize("place", ["pipe", "device", "folder"])
@pytest.mark.parametrize("file", ["part", "journal", "campaign.json"])
def test_what_is_no_file_is_refused_and_not_waited_for(tmp_path, file, place):
    path = filled(tmp_path, settled=file == "part")
    path = tmp_path / file if file == "campaign.json" else path
    path.unlink()
    if place == "pipe":
        os.mkfifo(path)
    elif place == "device":
        path.symlink_to("/dev/zero")
    else:
        path.mkdir()
    why = "Is a directory" if place == "folder" else "it is no file"
    for reads in (read_table, lambda folder: Store(folder, FAKE)):
        with pytest.raises(InputError, match=f"{why}$"):
            reads(tmp_path)


@pytest.mark.skipif(not hasattr(os, "O_NOFOLLOW"), reason="no such flag")
def test_a_link_in_the_place_of_the_lock_empties_no_other_file(tmp_path):
    other = tmp_path / "other"
    other.write_text("kept")
    filled(tmp_path / "store", settled=True)
    lock = tmp_path / "store" / "lock"
    lock.unlink()
    lock.symlink_to(other)
    with pytest.raises(InputError, match="cannot be used: Too many levels of symbolic links"):
        Store(tmp_path / "store", FAKE)
    assert other.read_text() == "kept"


def test_a_part_of_another_store_is_named(tmp_path):
    part = filled(tmp_path / "a", settled=True)
    other = dataclasses.replace(FAKE, columns={"n": "count"})
    with Store(tmp_path / "b", other):
        pass
    copied = tmp_path / "b" / "parts" / part.name
    copied.write_bytes(part.read_bytes())
    with pytest.raises(InputError) as caught:
        read_table(tmp_path / "b")
    assert str(caught.value) == f"{copied}: is a part of another store: its columns are others"


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "is damaged: it is no JSON"),
        (b"\xff\xfe", "is damaged: it is no JSON"),
        (b"[" * 100_000, "is damaged: it is no JSON"),
        (b"9" * 10_000, "is damaged: it is no JSON"),
        (b"[]", "is not of format 2"),
        (b'{"format": 2}', "is damaged: its checksum is not that of its content"),
        (b'{"format": 2, "plans": 5}', "is damaged: its checksum is not that of its content"),
    ],
)
def test_damaged_plans(tmp_path, content, why):
    filled(tmp_path, settled=True)
    (tmp_path / "campaign.json").write_bytes(content)
    with pytest.raises(InputError) as caught:
        state_of(tmp_path)
    assert str(caught.value) == f"store {str(tmp_path)!r}: campaign.json {why}"


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
        table = pytest.importorskip("pyarrow.parquet").read_table(file)
        assert table.column("n").to_pylist() == [1, 2, 3]
    assert not list(tmp_path.rglob(".kaidan-*"))


def test_an_export_as_csv_has_no_formulas(tmp_path):
    with Store(tmp_path, FAKE) as opened:
        opened.add([row(1) | {"host": "=cmd|' /C calc'!A0"}, row(2) | {"host": "-0.5"}])
        assert export(tmp_path, tmp_path / "all.csv") == 2
    text = (tmp_path / "all.csv").read_text()
    assert ""","'=cmd|' /C calc'!A0",""" in text
    assert ',"-0.5",' in text


def test_export_does_not_write_where_a_link_points_that_somebody_laid(tmp_path, monkeypatch):
    with Store(tmp_path / "store", FAKE) as opened:
        opened.add([row(1)])
    treasure = tmp_path / "treasure"
    treasure.write_text("mine")
    monkeypatch.setattr("kaidan.files.secrets.token_hex", lambda _: "guessed")
    (tmp_path / ".kaidan-guessed.part").symlink_to(treasure)
    (tmp_path / ".all.csv.passing").symlink_to(treasure)
    with pytest.raises(InputError, match="cannot be written: File exists"):
        export(tmp_path / "store", tmp_path / "all.csv")
    assert treasure.read_text() == "mine"


@pytest.mark.parametrize("plan", [5, {}, {"kind": "grid"}, {"kind": "walk"}, {"kind": []}])
def test_plans_that_are_none(tmp_path, plan):
    filled(tmp_path, settled=True)
    write_about(tmp_path, about_store(tmp_path) | {"work": TRIALS.name, "plans": [plan]})
    for asks in (progress_of, resume):
        with pytest.raises(InputError, match=r"^plan in the store: ") as caught:
            asks(tmp_path)
        assert str(caught.value).isprintable()


@pytest.mark.parametrize("name", ["x" * 10_000, "a\x00b", "x" * 300])
def test_names_that_no_file_can_have(tmp_path, name):
    with Store(tmp_path, FAKE):
        pass
    for asks in (
        lambda: Store(tmp_path / name, FAKE),
        lambda: state_of(tmp_path / name),
        lambda: export(tmp_path, tmp_path / f"{name}.csv"),
        lambda: export(tmp_path, tmp_path / f"all.{name}"),
    ):
        with pytest.raises(InputError) as caught:
            asks()
        assert len(str(caught.value)) < 500
        assert str(caught.value).isprintable()


def test_a_lock_that_is_no_text(tmp_path):
    with Store(tmp_path, FAKE):
        pass
    (tmp_path / "lock").write_bytes(b"\xff\xfe")
    assert state_of(tmp_path).writer is None
    (tmp_path / "lock").unlink()
    (tmp_path / "lock").mkdir()
    assert state_of(tmp_path).writer is None
    with pytest.raises(InputError, match="cannot be used: Is a directory"):
        Store(tmp_path, FAKE)


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
    monkeypatch.setattr("kaidan.campaign.id_set._RECENT", 7)
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
