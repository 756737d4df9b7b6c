"""One campaign at a time in a store: a lock that dies with its process."""

import os
import socket
import time
from pathlib import Path
from typing import IO

from kaidan.errors import InputError

FILE = "lock"


class Lock:
    """Lock on a folder, held until `release` or until the process ends, however it ends."""

    def __init__(self, folder: Path) -> None:
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_NOFOLLOW", 0)
        opened = os.open(folder / FILE, flags, 0o666)  # a link would have another file emptied
        self.file: IO[str] = os.fdopen(opened, "a+", encoding="utf-8", errors="replace")
        for _ in range(4):
            if _try_to_lock(self.file):
                break
            time.sleep(0.05)  # somebody may only be looking, see `holder`
        else:
            self.file.seek(0)
            holder = self.file.read(200).strip() or "another process"
            self.file.close()
            raise InputError(f"store {str(folder)!r}: a campaign is writing it ({holder})")
        self.file.truncate(0)
        self.file.write(f"process {os.getpid()} on {socket.gethostname()}\n")
        self.file.flush()

    def release(self) -> None:
        """Give it up."""
        self.file.close()


def holder(folder: Path) -> str | None:
    """Who holds the lock on a folder; None if nobody does."""
    try:
        with (folder / FILE).open(encoding="utf-8", errors="replace") as file:
            return None if _try_to_lock(file) else file.read(200).strip() or "another process"
    except OSError:  # none, or none that may be looked at
        return None


def _try_to_lock(file: IO[str]) -> bool:
    """Whether the file could be locked; the system unlocks it when the file is closed."""
    try:
        import fcntl
    except ImportError:  # Windows
        return _try_to_lock_on_windows(file)
    try:
        fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _try_to_lock_on_windows(file: IO[str]) -> bool:
    from importlib import import_module

    msvcrt = import_module("msvcrt")
    place = file.tell()
    try:
        file.seek(1_000_000)  # a byte past the text, which others may then still read
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
    except OSError:
        return False
    finally:
        file.seek(place)
    return True
