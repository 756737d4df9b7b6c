"""Files that are there whole or not at all, and the same bytes every time."""

import csv
import io
import json
import math
import os
import secrets
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kaidan.errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("png", "svg", "pdf")
"""Formats of figures, by the suffix of the file."""

_METADATA: dict[str, dict[str, str | None]] = {
    "png": {"Software": "kaidan"},
    "svg": {"Creator": "kaidan", "Date": None},
    "pdf": {"Creator": "kaidan", "CreationDate": None},
}
"""Without dates, so that the same question gives the same file."""


def figure_format(path: Path) -> str:
    """Format that the suffix of a figure's file asks for.

    Raises
    ------
    InputError
        Another suffix, or none.
    """
    suffix = path.suffix.lower().removeprefix(".")
    if suffix not in FORMATS:
        known = ", ".join(f".{name}" for name in FORMATS)
        what = f"unknown suffix {path.suffix!r}" if path.suffix else "no suffix"
        raise InputError(f"figure {str(path)!r}: {what}; known: {known}")
    return suffix


def figure_bytes(figure: "Figure", form: str) -> bytes:
    """Bytes of a figure in one of `FORMATS`."""
    from kaidan.report import look

    buffer = io.BytesIO()
    with look.settings():
        figure.savefig(buffer, format=form, dpi=look.DPI, metadata=_METADATA[form])
    return buffer.getvalue()


def json_text(value: Any) -> str:
    """Indented JSON in ASCII; arrays become lists, NaN and infinity become null."""
    return json.dumps(_plain(value), indent=2, allow_nan=False) + "\n"


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def csv_text(columns: Mapping[str, Iterable[Any]]) -> str:
    """CSV with one header line; NaN and None become empty fields."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(columns)
    plain = [_plain(list(column)) for column in columns.values()]
    writer.writerows(zip(*plain, strict=True))
    return buffer.getvalue()


LARGEST_TABLE = 100_000_000
"""Largest file of points that is read [bytes]."""


def points_of(path: Path) -> list[tuple[float, float]]:
    """Points x, z [m] of a CSV file, with or without a head.

    Raises
    ------
    InputError
        A file that cannot be read, or a row that is not two numbers.
    """
    try:
        with path.open(encoding="utf-8-sig") as file:  # no file's size bounds what a device gives
            text = file.read(LARGEST_TABLE + 1)
        if len(text) > LARGEST_TABLE:
            raise InputError(f"{path}: more than {LARGEST_TABLE // 1_000_000} MB of points")
    except UnicodeDecodeError:
        raise InputError(f"{path}: cannot be read: not a text file") from None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InputError(f"{path}: cannot be read: {reason}") from None
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


def write_all(contents: Mapping[Path, bytes | str]) -> None:
    """Write files one by one, each under a passing name in its folder until it is whole.

    Parameters
    ----------
    contents : mapping of Path to bytes or str
        What each file shall hold; text is written as UTF-8.

    Raises
    ------
    InputError
        A file or folder that cannot be written; the file then is as it was before.
    """
    for path, content in contents.items():
        _write(path, content.encode("utf-8") if isinstance(content, str) else content)


def _write(path: Path, content: bytes) -> None:
    try:
        target = Path(os.path.realpath(path))  # a link stays a link
        if target.exists() and not target.is_file():
            raise InputError(f"{path}: cannot be written: not a file")
        passing = target.with_name(f".kaidan-{secrets.token_hex(8)}.part")
        handle = os.open(passing, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(content)
            os.replace(passing, target)
        except BaseException:
            passing.unlink(missing_ok=True)
            raise
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be written: {reason(error)}") from None


def reason(error: OSError | ValueError) -> str:
    """Why a file or folder cannot be had, in the system's words."""
    return error.strerror if isinstance(error, OSError) and error.strerror else str(error)
