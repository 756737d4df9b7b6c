"""Where the compiled kernel is kept between processes, and one process filling it at a time."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

LONGEST_WAIT = 120.0
"""Time for which another process is waited for that compiles [s]; then this one compiles too."""

log = logging.getLogger("kaidan.contact")


def cache_folder(njit: Callable[..., Any], function: Callable[..., Any]) -> Path | None:
    """Folder in which numba keeps a function's machine code; None if none can be written."""
    try:
        return Path(njit(cache=True)(function).stats.cache_path)
    except (RuntimeError, OSError):  # numba found no folder that it may write to
        return None


@contextmanager
def filling(folder: Path) -> Iterator[None]:
    """Hold back other processes that would compile the same: they wait and read the cache.

    Without file locks (Windows, some network drives) all compile; numba replaces its files whole,
    so that is slow and not wrong.
    """
    try:
        import fcntl

        lock = (folder / "kaidan-contact.lock").open("a")
    except (ImportError, OSError):
        yield
        return
    with lock:
        waits_until = time.monotonic() + LONGEST_WAIT
        with suppress(OSError):
            while not _locked(fcntl, lock.fileno()) and time.monotonic() < waits_until:
                time.sleep(0.1)
        yield


def _locked(fcntl: Any, number: int) -> bool:
    try:
        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
