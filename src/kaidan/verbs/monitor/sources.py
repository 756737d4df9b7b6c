"""Where samples come from: a file, one that still grows, a recording of ROS, a serial line."""

import os
import stat
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast

from kaidan.errors import InputError, needed, short
from kaidan.files import reason
from kaidan.verbs.monitor.recordings import is_recording, samples_of_recording
from kaidan.verbs.monitor.samples import Sample, lines_of, samples_of

SERIAL = "serial:"
"""How the name of a serial line begins: ``serial:/dev/ttyUSB0``, ``serial:COM3:57600``."""
STANDARD_INPUT = "-"
"""Name of standard input."""
BAUD = 115_200
"""Rate of a serial line where none is stated."""
PAUSE = 0.05
"""How often a file that grows is looked at [s]."""


def is_live(path: str | os.PathLike[str], *, follow: bool = False) -> bool:
    """Whether samples come as they are measured: from a line, a pipe, or a file that is followed.

    Parameters
    ----------
    path, follow
        As `open_samples` has them.
    """
    origin = os.fspath(path)
    if follow or origin.startswith(SERIAL):
        return True
    try:
        mode = os.stat(sys.stdin.fileno() if origin == STANDARD_INPUT else origin).st_mode
    except (AttributeError, OSError, ValueError):  # no standard input; what opens a file says why
        return False
    return not stat.S_ISREG(mode) and not stat.S_ISDIR(mode)


@contextmanager
def open_samples(
    path: str | os.PathLike[str], *, follow: bool = False, nose_up: bool = True
) -> Iterator[Iterator[Sample]]:
    """Samples of a file or a line, as they come.

    Parameters
    ----------
    path : str or path
        CSV file (see `kaidan.verbs.monitor.samples`), ``-`` for standard input, recording of ROS
        (.bag, .mcap, .db3 or a folder), or ``serial:DEVICE`` or ``serial:DEVICE:BAUD`` with CSV
        lines.
    follow : bool
        Whether the end of a CSV file is waited at for what is written next.
    nose_up : bool
        Whether the nose points up the stairs: a recording's acceleration counts along the track.

    Raises
    ------
    InputError
        A file or line that cannot be read, or a file without a head.
    MissingExtraError
        ``kaidan[bags]`` or ``kaidan[serial]`` is needed.
    """
    origin = short(os.fspath(path))
    if origin == STANDARD_INPUT:
        origin = "standard input"
        yield samples_of(lines_of(_standard_input(), origin=origin), origin=origin)
        return
    if origin.startswith(SERIAL):
        with _serial(origin) as line:
            yield samples_of(lines_of(line, origin=origin), origin=origin)
        return
    if is_recording(path):
        yield iter(samples_of_recording(path, nose_up=nose_up))
        return
    try:
        file = open(path, encoding="utf-8", errors="replace")  # noqa: SIM115 - closed below
    except (OSError, ValueError) as error:
        raise InputError(f"{origin}: cannot be read: {reason(error)}") from None
    with file:
        lines = cast(TextIO, _Growing(file)) if follow else file
        yield samples_of(lines_of(lines, origin=origin), origin=origin)


def _standard_input() -> TextIO:
    """Standard input; a buffer of its own lets the command end while a thread waits for a line."""
    try:
        number = sys.stdin.fileno()
    except (AttributeError, OSError, ValueError):
        return sys.stdin
    return open(number, encoding="utf-8", errors="replace", closefd=False)


@contextmanager
def _serial(origin: str) -> Iterator[TextIO]:
    """Lines of a serial line."""
    module: Any = needed("serial", "a serial line", "serial")
    device, _, rate = origin.removeprefix(SERIAL).rpartition(":")
    if not rate.isdigit() or not device:
        device, rate = origin.removeprefix(SERIAL), str(BAUD)
    try:
        opened = module.Serial(device, baudrate=int(rate), timeout=None)
    except (OSError, ValueError) as error:
        raise InputError(f"{origin}: cannot be opened: {short(error)}") from None
    with opened:
        yield cast(TextIO, _Wired(opened))


class _Growing:
    """Lines of a file at whose end more are waited for; a line is whole before it is given."""

    def __init__(self, file: TextIO) -> None:
        self._file, self._begun = file, ""

    def readline(self, most: int) -> str:
        while True:
            self._begun += self._file.readline(most - len(self._begun))
            if self._begun.endswith("\n") or len(self._begun) >= most:
                line, self._begun = self._begun, ""
                return line
            time.sleep(PAUSE)


class _Wired:
    """Lines of a serial line as text."""

    def __init__(self, opened: Any) -> None:
        self._opened = opened

    def readline(self, most: int) -> str:
        line: bytes = self._opened.readline(most)
        return line.decode("utf-8", errors="replace")
