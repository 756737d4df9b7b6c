"""Files that are there whole or not at all, and the same bytes every time."""

import csv
import io
import os
import re
import secrets
import stat
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from kaidan.answer import plain
from kaidan.errors import InputError, short, shown

_FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n")
"""How a text begins that a spreadsheet takes for a formula."""
_FIGURES = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?|-\d+(?:\.\d+)?deg(?:[,/:+][\w.-]+)*")
"""A number, or a posture such as -68deg,-20deg/land:flat."""
PASSING = ".kaidan-"
"""How the name of a file begins that is not whole yet."""


def format_of(path: Path, formats: tuple[str, ...], what: str) -> str:
    """Format that the suffix of a file asks for."""
    suffix = path.suffix.lower().removeprefix(".")
    if suffix not in formats:
        known = ", ".join(f".{name}" for name in formats)
        has = f"unknown suffix {shown(path.suffix)}" if path.suffix else "no suffix"
        raise InputError(f"{what} {short(path)!r}: {has}; known: {known}")
    return suffix


def json_text(value: Any) -> str:
    """Indented JSON in ASCII; arrays become lists, NaN and infinity become null."""
    import json

    return json.dumps(plain(value), indent=2, allow_nan=False) + "\n"


def csv_text(columns: Mapping[str, Iterable[Any]]) -> str:
    """CSV with one header line; NaN and None become empty fields, see `cell_of` for texts."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(columns)
    rows = zip(*(map(cell_of, plain(list(column))) for column in columns.values()), strict=True)
    writer.writerows(rows)
    return buffer.getvalue()


def cell_of(value: Any) -> Any:
    """Value as a cell of a table: a text that a spreadsheet takes for a formula gets a quote.

    Numbers and angles of flippers stay as they are.

    Examples
    --------
    >>> [cell_of(each) for each in ("=1+1", "-x", "-68deg,-20deg", "-0.5", -0.5, "ibc")]
    ["'=1+1", "'-x", '-68deg,-20deg', '-0.5', -0.5, 'ibc']
    """
    if isinstance(value, str) and value.startswith(_FORMULA) and not _FIGURES.fullmatch(value):
        return f"'{value}"
    return value


LARGEST_TABLE = 100_000_000
"""Largest file of points that is read [bytes]."""


def points_of(path: Path) -> list[tuple[float, float]]:
    """Points x, z [m] of a CSV file, with or without a head."""
    try:
        with path.open(encoding="utf-8-sig") as file:  # no file's size bounds what a device gives
            text = file.read(LARGEST_TABLE + 1)
        if len(text) > LARGEST_TABLE:
            raise InputError(f"{short(path)}: more than {LARGEST_TABLE // 1_000_000} MB of points")
    except UnicodeDecodeError:
        raise InputError(f"{short(path)}: cannot be read: not a text file") from None
    except (OSError, ValueError) as error:
        raise InputError(f"{short(path)}: cannot be read: {reason(error)}") from None
    columns = (0, 1)
    points: list[tuple[float, float]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        cells = [cell.strip().strip('"') for cell in line.split(",")]
        if not any(cells) or line.lstrip().startswith("#"):
            continue
        if not points and "x" in cells and "z" in cells:
            columns = (cells.index("x"), cells.index("z"))
            continue
        try:
            points.append((float(cells[columns[0]]), float(cells[columns[1]])))
        except (ValueError, IndexError):
            shown = line if len(line) <= 40 else line[:39] + "…"
            raise InputError(
                f"{path}, line {number}: {shown!r} is not two numbers x,z in metres"
            ) from None
    if not points:
        raise InputError(f"{path}: holds no points; write rows x,z in metres")
    return points


def size_of(content: bytes) -> str:
    """Size of a picture or a film: pixels, as far as its head says them, and kilobytes.

    Examples
    --------
    >>> size_of(b"GIF89a" + bytes([128, 2, 104, 1]) + bytes(9990))
    '640 x 360 pixels, 10 kB'
    """
    if content[:8] == b"\x89PNG\r\n\x1a\n":
        width, height = (int.from_bytes(content[at : at + 4], "big") for at in (16, 20))
    elif content[:3] == b"GIF":
        width, height = (int.from_bytes(content[at : at + 2], "little") for at in (6, 8))
    else:
        width = height = 0
    pixels = f"{width} x {height} pixels, " if width else ""
    return f"{pixels}{max(1, round(len(content) / 1000))} kB"


def write_all(contents: Mapping[Path, bytes | str]) -> None:
    """Write files one by one, each under a passing name in its folder until it is whole.

    contents: what each file shall hold; text is written as UTF-8.
    """
    for path, content in contents.items():
        with whole_file(path) as file:
            file.write(content.encode("utf-8") if isinstance(content, str) else content)


@contextmanager
def whole_file(path: Path, *, durable: bool = False) -> Iterator[IO[bytes]]:
    """Stream into a file that is there whole or not at all.

    Until then it has a passing name in the same folder, which nobody can foresee and under which
    nothing was there before.

    durable: whether it is on disk, and not only in the system's memory, when this ends.
    """
    try:
        target = Path(os.path.realpath(path))
        if target.exists() and not target.is_file():
            raise InputError(f"{short(path)}: cannot be written: not a file")
        passing = target.with_name(f"{PASSING}{secrets.token_hex(8)}.part")
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
        handle = os.open(passing, flags, 0o666)
        try:
            if target.exists() and hasattr(os, "fchmod"):
                os.fchmod(handle, stat.S_IMODE(target.stat().st_mode))
            with os.fdopen(handle, "wb") as file:
                yield file
                file.flush()
                if durable:
                    os.fsync(handle)
            os.replace(passing, target)
        except BaseException:
            passing.unlink(missing_ok=True)
            raise
        if durable:
            _sync_folder(target.parent)
    except (OSError, ValueError) as error:
        raise InputError(f"{short(path)}: cannot be written: {reason(error)}") from None


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


def reason(error: OSError | ValueError) -> str:
    """Why a file or folder cannot be had, in the system's words."""
    return error.strerror if isinstance(error, OSError) and error.strerror else str(error)
