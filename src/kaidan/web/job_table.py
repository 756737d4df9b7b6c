"""Jobs as a table that survives the server: SQLite, one row a job, and a folder for its files."""

import json
import shutil
import sqlite3
import time
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from kaidan.errors import InputError, short
from kaidan.web.long_work import RESULT, TEXT
from kaidan.web.sessions import KEPT

JobState = Literal["queued", "running", "done", "failed", "cancelled"]
MOST_KEPT = 50
"""Jobs of one session that are kept; the oldest that ended goes."""
MOST_KEPT_OF_ALL = 1_000
"""Jobs that ended and are kept, of all sessions; the oldest goes."""
_ENDED = ("done", "failed", "cancelled")
_TABLE = """
CREATE TABLE IF NOT EXISTS jobs (
    id TEXT PRIMARY KEY, owner TEXT NOT NULL, verb TEXT NOT NULL, body TEXT NOT NULL,
    state TEXT NOT NULL, what TEXT NOT NULL, done INTEGER NOT NULL, of INTEGER NOT NULL,
    error TEXT NOT NULL, kind TEXT NOT NULL, media TEXT NOT NULL,
    created REAL NOT NULL, ended REAL)
"""


@dataclass
class Job:
    """One job."""

    id: str
    owner: str
    verb: str
    body: dict[str, Any]
    state: JobState = "queued"
    what: str = ""
    """What is counted."""
    done: int = 0
    of: int = 0
    """How many there are; 0: nobody knows."""
    error: str = ""
    kind: str = ""
    media: str = "application/json"
    """Type of the result."""
    created: float = 0.0
    """Seconds since 1970."""
    ended: float | None = None
    line: str = ""
    """Who takes turns with others: its session, or the address of who came without one."""
    client: str = ""
    """Address from which it was begun; of one that an earlier server began nobody knows it."""

    def fail(self, kind: str, error: str) -> None:
        """End without a result."""
        self.state, self.kind, self.error = "failed", kind, error

    @property
    def over(self) -> bool:
        """Whether it came to an end."""
        return self.state in _ENDED

    def shown(self) -> dict[str, Any]:
        """What its owner sees."""
        found = {
            "id": self.id,
            "verb": self.verb,
            "about": about(self.body),
            "state": self.state,
            "progress": {"what": self.what, "done": self.done, "of": self.of},
            "created": self.created,
            "ended": self.ended,
            "error": {"error": self.error, "kind": self.kind} if self.error else None,
            "result": f"/api/jobs/{self.id}/result" if self.state == "done" else None,
        }
        return found


def about(body: Mapping[str, Any]) -> str:
    """Whom a body names, for a list; of a job that ended its body has nothing else.

    Examples
    --------
    >>> about({"robots": ["absolem", {"name": "mine"}], "stairs": "ibc", "friction": 1.0})
    'absolem, mine / ibc'
    """
    found = (_names(body.get(key)) for key in ("about", "robots", "robot", "stairs"))
    return " / ".join(filter(None, found))[:200]


def _names(given: Any) -> str:
    if isinstance(given, list):
        return ", ".join(filter(None, map(_names, given)))
    return str(given.get("name", "")) if isinstance(given, Mapping) else str(given or "")


class JobTable:
    """Jobs of all sessions."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        try:
            # made by one thread, used by the server's alone
            self._base = sqlite3.connect(
                folder / "jobs.sqlite", isolation_level=None, check_same_thread=False
            )
            self._base.row_factory = sqlite3.Row
            self._base.execute("PRAGMA journal_mode=WAL")
            self._base.execute(_TABLE)
            known = {each.id for each in self._found("TRUE")}
        except sqlite3.Error as error:
            raise InputError(f"{short(folder)}: cannot keep jobs: {error}") from None
        for each in folder.iterdir():  # of a server that was killed as it added a job
            if each.is_dir() and each.name not in known:
                shutil.rmtree(each, ignore_errors=True)

    def close(self) -> None:
        """Close the table."""
        self._base.close()

    def add(self, job: Job, file: Path | None = None) -> None:
        """Add a job, with a folder and perhaps a file in it; nothing is left where it fails."""
        self._make_room(job.owner)
        folder = self.files(job)
        folder.mkdir(mode=0o700)
        try:
            if file is not None:
                file.replace(folder / file.name)
            self._base.execute(
                "INSERT INTO jobs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (job.id, job.owner, job.verb, json.dumps(job.body), job.state, "", 0, 0, "", "",
                 job.media, job.created, None),
            )  # fmt: skip
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise

    def _make_room(self, owner: str) -> None:
        """Forget the oldest jobs that ended, and those that nobody can see any more."""
        over = "ended IS NOT NULL ORDER BY ended DESC LIMIT -1 OFFSET ?"
        gone = self._found("ended < ?", time.time() - KEPT)
        gone += self._found(f"owner = ? AND {over}", owner, MOST_KEPT - 1)
        gone += self._found(over, MOST_KEPT_OF_ALL - 1)
        for each in {each.id: each for each in gone}.values():
            self.remove(each)

    def files(self, job: Job) -> Path:
        """Folder of a job."""
        return self.folder / job.id

    def end(self, job: Job) -> None:
        """Write how a job ended, and keep no more of it than its result."""
        job.body = {"about": about(job.body)}
        for each in self.files(job).iterdir():
            if each.is_dir():
                shutil.rmtree(each, ignore_errors=True)
            elif job.state != "done" or each.name not in (RESULT, TEXT):
                each.unlink(missing_ok=True)
        self._base.execute(
            "UPDATE jobs SET body = ?, state = ?, what = ?, done = ?, of = ?, error = ?, kind = ?, "
            "media = ?, ended = ? WHERE id = ?",
            (json.dumps(job.body), job.state, job.what, job.done, job.of, job.error, job.kind,
             job.media, job.ended, job.id),
        )  # fmt: skip

    def remove(self, job: Job) -> None:
        """Forget a job and its files, which leave the room that forgetting takes on a full disk."""
        shutil.rmtree(self.files(job), ignore_errors=True)
        self._base.execute("DELETE FROM jobs WHERE id = ?", (job.id,))

    def ended(self, owner: str) -> list[Job]:
        """Jobs of a session that ended."""
        return self._found("owner = ? AND ended IS NOT NULL", owner)

    def queued(self) -> list[Job]:
        """Jobs that have not ended; what ran when a server ended waits again."""
        found = self._found("ended IS NULL")
        for each in found:
            each.state, each.line = "queued", each.owner
        return found

    def _found(self, where: str, *values: str | float) -> list[Job]:
        query = f"SELECT * FROM jobs WHERE {where}"
        with closing(self._base.execute(query, values)) as rows:
            return [Job(**{**row, "body": json.loads(row["body"])}) for row in map(dict, rows)]
