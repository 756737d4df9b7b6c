"""A folder of results, one row a trial: Parquet parts, and a journal of what is not in them yet.

::

    STORE/campaign.json            what was requested: the plans, the work, the format
    STORE/lock                     locked while a campaign writes
    STORE/journal-000007.jsonl     rows as they came, one JSON object a line
    STORE/parts/part-000006-3c1f9a60d2e4b785.parquet   ... -000005-..., rows that are settled

A row is written to the journal the moment it arrives, before anything else is done with it, so
that `kill -9` loses no trial that came back; the journal is forced to disk once a second, which
is what a power cut may cost. Now and then the journal becomes the part of its number: written
under a passing name, forced to disk, renamed, and only then is the journal deleted. Whenever a
store is opened for writing, a journal whose part exists is deleted and one whose part does not
exist becomes it; so every trial is there once, wherever a process was killed.
"""

import os
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

from kaidan.files import PASSING
from kaidan.work.id_set import Known
from kaidan.work.job import Kind, Row, Work
from kaidan.work.lock import Lock
from kaidan.work.store_files import (
    ABOUT,
    PARTS,
    about_store,
    batches_of,
    journal_line,
    journal_path,
    journal_rows,
    journals_of,
    load_parts,
    parts_of,
    refusal,
    schema_of,
    write_about,
    write_part,
)

ROWS = 4096
"""Most rows of a part."""
SOON, LATE = 1.0, 60.0
"""Delay of a part [s]: a twentieth of the age of the campaign between these, so that a short one
is settled at once and a long one does not leave a myriad of parts."""
SYNC = 1.0
"""Longest time for which the journal is not forced to disk [s]."""
_PYTHON: dict[Kind, type] = {
    "text": str,
    "number": float,
    "count": int,
    "flag": bool,
    "texts": str,
    "numbers": float,
    "counts": int,
}
"""What a column holds, or each item of its lists."""


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
        except (OSError, ValueError) as error:
            raise refusal(folder, error) from None
        self._journal: int | None = None
        self._rows: list[Row] = []
        self._begun = self._part_begun = self._synced = time.monotonic()
        try:
            self.plans = self._own_plans()
            self._repair()
            for part in parts_of(folder):
                for batch in batches_of(part, ["id"], self.schema):
                    self.known.update(batch.column("id").to_pylist())
        except OSError as error:
            self._lock.release()
            raise refusal(folder, error) from None
        except BaseException:
            self._lock.release()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        try:
            if not isinstance(error, OSError):
                self.settle()
        finally:
            self._lock.release()

    def note_plan(self, plan: dict[str, Any]) -> None:
        """Keep what is requested, so that it can be resumed by the store's name alone."""
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
                lines.append(journal_line(whole))
        try:
            if lines:
                self._append(b"".join(lines))
            self.tick()
        except OSError as error:
            raise refusal(self.folder, error) from None

    def tick(self) -> None:
        """Force the journal to disk, or settle it, if it is time."""
        now = time.monotonic()
        if self._journal is None:
            load_parts()  # while workers begin
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
        write_part(self.folder, self._number, rows, self.schema)
        try:
            journal_path(self.folder, self._number).unlink()
        except OSError as error:
            raise refusal(self.folder, error) from None

    def _append(self, data: bytes) -> None:
        if self._journal is None:
            numbers = (*parts_of(self.folder).values(), *journals_of(self.folder).values())
            self._number = 1 + max(numbers, default=0)
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND | getattr(os, "O_BINARY", 0)
            self._journal = os.open(journal_path(self.folder, self._number), flags, 0o666)
            self._part_begun = self._synced = time.monotonic()
        while data:
            data = data[os.write(self._journal, data) :]

    def _own_plans(self) -> list[dict[str, Any]]:
        """Plans of the store; a new store is begun."""
        about = about_store(self.folder, missing_is_new=True)
        if about is None:
            if any(parts_of(self.folder)):
                raise refusal(self.folder, f"holds parts, but no {ABOUT}")
            self.plans = []
            self._write_about()
            return []
        if about["work"] != self.work.name:
            raise refusal(self.folder, f"holds {about['work']}, not {self.work.name}")
        if about["columns"] != self.work.all_columns():
            raise refusal(
                self.folder,
                "another version of kaidan wrote it, with other columns; export it and begin a "
                "new store",
            )
        return list(about["plans"])

    def _write_about(self) -> None:
        columns = self.work.all_columns()
        about = {"work": self.work.name, "columns": columns, "plans": self.plans}
        write_about(self.folder, about)

    def _repair(self) -> None:
        """Bring the store in order after whatever happened to the last campaign."""
        for passing in self.folder.rglob(f"{PASSING}*.part"):
            passing.unlink()
        there = set(parts_of(self.folder).values())
        for journal, number in journals_of(self.folder).items():
            if number not in there:
                rows = journal_rows(journal)
                if rows:
                    write_part(self.folder, number, rows, self.schema)
            journal.unlink()


def _as(kind: Kind, value: Any) -> Any:
    if value is None:
        return None
    of = _PYTHON[kind]
    return [of(each) for each in value] if kind.endswith("s") else of(value)
