"""A folder of results, one row a trial: Parquet parts, and a journal of what is not in them yet.

::

    STORE/campaign.json            what was asked for: the plans, the work, the format
    STORE/lock                     locked while a campaign writes
    STORE/journal-000007.jsonl     rows as they came, one JSON object a line
    STORE/parts/part-000006.parquet   ... -000005, -000004: rows that are settled

A row is written to the journal the moment it arrives, before anything else is done with it, so
that `kill -9` loses no trial that came back; the journal is forced to disk once a second, which
is what a power cut may cost. Now and then the journal becomes the part of its number: written
under a passing name, forced to disk, renamed, and only then is the journal deleted. Whenever a
store is opened for writing, a journal whose part exists is deleted and one whose part does not
exist becomes it; so every trial is there once, wherever a process was killed.
"""

import json
import os
import time
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from kaidan.campaign.known import Known
from kaidan.campaign.lock import Lock
from kaidan.campaign.work import Kind, Row, Work
from kaidan.errors import InputError, MissingExtraError

FORMAT = 1
ABOUT, PARTS = "campaign.json", "parts"
ROWS = 4096
"""Most rows of a part."""
SOON, LATE = 1.0, 60.0
"""Delay of a part [s]: a twentieth of the age of the campaign between these, so that a short one
is settled at once and a long one does not leave a myriad of parts."""
SYNC = 1.0
"""Longest time for which the journal is not forced to disk [s]."""
_ARROW = {"text": "string", "number": "float64", "count": "int64", "flag": "bool_"}
_PYTHON: dict[Kind, type] = {"text": str, "number": float, "count": int, "flag": bool}


def arrow(module: str = "pyarrow") -> Any:
    """The module, imported when it is needed.

    Raises
    ------
    MissingExtraError
        pyarrow is not installed.
    """
    try:
        return import_module(module)
    except ImportError:
        raise MissingExtraError("a store of trials", "physics") from None


def schema_of(columns: dict[str, Kind]) -> Any:
    """Arrow schema of columns."""
    pa = arrow()
    return pa.schema([(name, getattr(pa, _ARROW[kind])()) for name, kind in columns.items()])


class Store:
    """A store opened for writing; a context manager.

    Parameters
    ----------
    folder : str or Path
        Made if it does not exist.
    work : Work
        What is done; a store holds the rows of one work.

    Raises
    ------
    InputError
        Another campaign writes it, it holds something else, or it cannot be written.
    """

    def __init__(self, folder: str | Path, work: Work) -> None:
        self.folder = folder = Path(folder)
        self.work = work
        self._kinds = work.all_columns()
        self.schema = schema_of(self._kinds)
        self.known = Known()
        self.plans: list[dict[str, Any]] = []
        try:
            (folder / PARTS).mkdir(parents=True, exist_ok=True)
            self._lock = Lock(folder)
        except OSError as error:
            raise _refusal(folder, error) from None
        self._journal: int | None = None
        self._rows: list[Row] = []
        self._begun = self._part_begun = self._synced = time.monotonic()
        try:
            self.plans = self._own_plans()
            self._repair()
            for part in parts_of(folder):
                for batch in batches_of(part, ["id"]):
                    self.known.update(batch.column("id").to_pylist())
        except OSError as error:
            self._lock.release()
            raise _refusal(folder, error) from None
        except BaseException:
            self._lock.release()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            if not isinstance(error, OSError):
                self.settle()
        finally:
            self._lock.release()

    def note_plan(self, plan: dict[str, Any]) -> None:
        """Keep what is asked for, so that it can be resumed by the store's name alone."""
        if plan not in self.plans:
            self.plans.append(plan)
            self._write_about()

    def add(self, rows: Sequence[Row]) -> None:
        """Take rows in; when this returns they survive the death of the process.

        Raises
        ------
        InputError
            The disk is full, for example; the rows of before are safe.
        """
        lines = []
        for row in rows:
            if self.known.add(row["id"]):
                whole = {name: _as(kind, row.get(name)) for name, kind in self._kinds.items()}
                self._rows.append(whole)
                lines.append(json.dumps(whole) + "\n")
        try:
            if lines:
                self._append("".join(lines).encode("ascii"))
            self.tick()
        except OSError as error:
            raise _refusal(self.folder, error) from None

    def tick(self) -> None:
        """Force the journal to disk, or settle it, if it is time."""
        now = time.monotonic()
        if self._journal is None:
            return
        delay = min(LATE, max(SOON, (now - self._begun) / 20))
        if len(self._rows) >= ROWS or now - self._part_begun >= delay:
            self.settle()
        elif now - self._synced >= SYNC:
            os.fsync(self._journal)
            self._synced = now

    def settle(self) -> None:
        """Turn the journal into a part."""
        if self._journal is None:
            return
        os.close(self._journal)
        self._journal, rows, self._rows = None, self._rows, []
        try:
            write_part(self.folder, self._number, rows, self.schema)
            _journal_path(self.folder, self._number).unlink()
        except OSError as error:
            raise _refusal(self.folder, error) from None

    def _append(self, data: bytes) -> None:
        if self._journal is None:
            self._number = 1 + max(
                (number_of(path) for path in (*parts_of(self.folder), *journals_of(self.folder))),
                default=0,
            )
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND
            self._journal = os.open(_journal_path(self.folder, self._number), flags, 0o666)
            self._part_begun = self._synced = time.monotonic()
        while data:
            data = data[os.write(self._journal, data) :]

    def _own_plans(self) -> list[dict[str, Any]]:
        """Plans of the store; a new store is begun."""
        about = about_store(self.folder, missing_is_new=True)
        if about is None:
            if any(parts_of(self.folder)):
                raise InputError(f"store {str(self.folder)!r}: holds parts, but no {ABOUT}")
            self.plans = []
            self._write_about()
            return []
        if about["work"] != self.work.name:
            raise InputError(
                f"store {str(self.folder)!r}: holds {about['work']}, not {self.work.name}"
            )
        if about["columns"] != self.work.all_columns():
            raise InputError(
                f"store {str(self.folder)!r}: another version of kaidan wrote it, with other "
                "columns; export it and begin a new store"
            )
        return list(about["plans"])

    def _write_about(self) -> None:
        about = {
            "format": FORMAT,
            "work": self.work.name,
            "columns": self.work.all_columns(),
            "plans": self.plans,
        }
        passing = self.folder / f".{ABOUT}.passing"
        with passing.open("wb") as file:
            file.write((json.dumps(about, indent=1) + "\n").encode("ascii"))
            file.flush()
            os.fsync(file.fileno())
        passing.replace(self.folder / ABOUT)
        _sync_folder(self.folder)

    def _repair(self) -> None:
        """Bring the store in order after whatever happened to the last campaign."""
        for passing in self.folder.glob(".*.passing"):
            passing.unlink()
        there = {number_of(part) for part in parts_of(self.folder)}
        for journal in journals_of(self.folder):
            number = number_of(journal)
            if number not in there:
                rows = journal_rows(journal)
                if rows:
                    write_part(self.folder, number, rows, self.schema)
            journal.unlink()


def _as(kind: Kind, value: Any) -> Any:
    return None if value is None else _PYTHON[kind](value)


def write_part(folder: Path, number: int, rows: list[Row], schema: Any) -> None:
    """Write a part so that it is there whole or not at all."""
    parquet, pa = arrow("pyarrow.parquet"), arrow()
    passing = folder / f".part-{number:06d}.passing"
    with passing.open("wb") as file:
        parquet.write_table(pa.Table.from_pylist(rows, schema=schema), file, compression="zstd")
        file.flush()
        os.fsync(file.fileno())
    passing.replace(folder / PARTS / f"part-{number:06d}.parquet")
    _sync_folder(folder / PARTS)


def parts_of(folder: Path) -> list[Path]:
    """Parts of a store, oldest first."""
    return sorted((folder / PARTS).glob("part-*.parquet"))


def journals_of(folder: Path) -> list[Path]:
    """Journals of a store, oldest first; one at most, unless somebody copied files."""
    return sorted(folder.glob("journal-*.jsonl"))


def _journal_path(folder: Path, number: int) -> Path:
    return folder / f"journal-{number:06d}.jsonl"


def number_of(path: Path) -> int:
    """Number in the name of a part or a journal."""
    return int(path.stem.rpartition("-")[2])


def journal_rows(path: Path) -> list[Row]:
    """Rows of a journal; a line that a power cut left half written is not one."""
    rows: dict[str, Row] = {}
    for line in path.read_bytes().splitlines():
        try:
            row = json.loads(line)
            rows.setdefault(row["id"], row)
        except (ValueError, KeyError, TypeError):
            continue
    return list(rows.values())


def batches_of(part: Path, columns: Sequence[str] | None = None) -> Iterator[Any]:
    """Record batches of a part.

    Raises
    ------
    InputError
        It is no Parquet file.
    """
    pa = arrow()
    try:
        with arrow("pyarrow.parquet").ParquetFile(part) as file:
            yield from file.iter_batches(columns=None if columns is None else list(columns))
    except pa.ArrowInvalid as error:
        raise InputError(f"{part}: cannot be read: {error}") from None


def about_store(folder: Path, *, missing_is_new: bool = False) -> dict[str, Any] | None:
    """What `campaign.json` holds.

    Raises
    ------
    InputError
        The folder is no store, or of another format.
    """
    try:
        about = json.loads((folder / ABOUT).read_text(encoding="utf-8"))
    except FileNotFoundError:
        if missing_is_new:
            return None
        raise InputError(f"store {str(folder)!r}: no such store ({ABOUT} is missing)") from None
    except (OSError, ValueError) as error:
        raise _refusal(folder, error) from None
    if not isinstance(about, dict) or about.get("format") != FORMAT:
        raise InputError(f"store {str(folder)!r}: {ABOUT} is not of format {FORMAT}")
    return about


def _refusal(folder: Path, error: OSError | ValueError) -> InputError:
    why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return InputError(f"store {str(folder)!r}: cannot be used: {why}")


def _sync_folder(folder: Path) -> None:
    """Force the names in a folder to disk, where the system can."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows
        return
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
