"""Jobs as a table that survives the server: SQLite, one row a job, and a folder for its files."""

import json
import secrets
import shutil
import sqlite3
import time
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from kaidan.errors import InputError

JobState = Literal["queued", "running", "done", "failed", "cancelled"]
MOST_WAITING = 8
"""Jobs of one session that may wait or run."""
MOST_OF_ALL = 100
"""Jobs of all sessions that may wait or run."""
MOST_KEPT = 50
"""Jobs of one session that are kept; the oldest that ended goes."""
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
    """Whom a body names, for a list.

    Examples
    --------
    >>> about({"robots": ["absolem", {"name": "mine"}], "stairs": "ibc", "friction": 1.0})
    'absolem, mine / ibc'
    """
    found = (_names(body.get(key)) for key in ("robots", "robot", "stairs"))
    return " / ".join(filter(None, found))[:200]


def _names(given: Any) -> str:
    if isinstance(given, list):
        return ", ".join(filter(None, map(_names, given)))
    return str(given.get("name", "")) if isinstance(given, Mapping) else str(given or "")


class JobTable:
    """Jobs of all sessions.

    Parameters
    ----------
    folder : Path
        Folder of the table and of the files of jobs.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        # made by one thread, used by the server's alone
        self._base = sqlite3.connect(
            folder / "jobs.sqlite", isolation_level=None, check_same_thread=False
        )
        self._base.row_factory = sqlite3.Row
        self._base.execute("PRAGMA journal_mode=WAL")
        self._base.execute(_TABLE)
        # what ran when the server ended goes on
        self._base.execute("UPDATE jobs SET state = 'queued' WHERE state = 'running'")

    def close(self) -> None:
        """Close the table."""
        self._base.close()

    def add(self, owner: str, verb: str, body: Mapping[str, Any]) -> Job:
        """New job, with a folder.

        Raises
        ------
        InputError
            Too many jobs wait already.
        """
        mine = self.of_owner(owner)
        if sum(not each.over for each in mine) >= MOST_WAITING:
            raise InputError(f"{MOST_WAITING} jobs wait or run already: cancel one, or wait")
        if self._count("state IN ('queued', 'running')") >= MOST_OF_ALL:
            raise InputError(f"{MOST_OF_ALL} jobs of all sessions wait or run already: try later")
        ended = [each for each in mine if each.over]
        for each in ended[: max(0, len(mine) + 1 - MOST_KEPT)]:
            self.remove(each)
        job = Job(secrets.token_urlsafe(12), owner, verb, dict(body), created=time.time())
        self.files(job).mkdir(mode=0o700)
        self._base.execute(
            "INSERT INTO jobs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            (job.id, owner, verb, json.dumps(job.body), job.state, "", 0, 0, "", "", job.media,
             job.created, None),
        )  # fmt: skip
        return job

    def files(self, job: Job) -> Path:
        """Folder of a job."""
        return self.folder / job.id

    def keep(self, job: Job) -> None:
        """Write how a job is."""
        self._base.execute(
            "UPDATE jobs SET state = ?, what = ?, done = ?, of = ?, error = ?, kind = ?, "
            "media = ?, ended = ? WHERE id = ?",
            (job.state, job.what, job.done, job.of, job.error, job.kind, job.media, job.ended,
             job.id),
        )  # fmt: skip

    def remove(self, job: Job) -> None:
        """Forget a job and its files."""
        self._base.execute("DELETE FROM jobs WHERE id = ?", (job.id,))
        shutil.rmtree(self.files(job), ignore_errors=True)

    def of_owner(self, owner: str) -> list[Job]:
        """Jobs of a session, the oldest first."""
        return self._found("owner = ?", owner)

    def queued(self) -> list[Job]:
        """Jobs that wait, the oldest first."""
        return self._found("state = ?", "queued")

    def _count(self, where: str) -> int:
        with closing(self._base.execute(f"SELECT count(*) FROM jobs WHERE {where}")) as rows:
            return int(rows.fetchone()[0])

    def _found(self, where: str, value: str) -> list[Job]:
        query = f"SELECT * FROM jobs WHERE {where} ORDER BY created"
        with closing(self._base.execute(query, (value,))) as rows:
            return [Job(**{**row, "body": json.loads(row["body"])}) for row in map(dict, rows)]
