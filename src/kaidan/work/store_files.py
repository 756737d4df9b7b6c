"""The files of a store, each of which says by a checksum whether it is as it was written.

A part has its checksum in its name, a line of a journal at its beginning, `campaign.json` in a
field; so damage is reported wherever it is, and never read as a result.
"""

import errno
import hashlib
import io
import json
import re
from collections.abc import Iterator, Sequence
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from kaidan.errors import InputError, MissingExtraError, short
from kaidan.files import reason, whole_file
from kaidan.work.job import Kind, Row

FORMAT = 2
ABOUT, PARTS = "campaign.json", "parts"
_ARROW = {"text": "string", "number": "float64", "count": "int64", "flag": "bool_"}
_LISTS = {"texts": "text", "numbers": "number", "counts": "count"}
"""Kinds of columns that hold lists, and what is in the lists."""
_PART = re.compile(r"part-(\d{6,})-([0-9a-f]{16})\.parquet", re.ASCII)
_JOURNAL = re.compile(r"journal-(\d{6,})\.jsonl", re.ASCII)


def arrow(module: str = "pyarrow") -> Any:
    """The module, imported when it is needed."""
    try:
        return import_module(module)
    except ImportError:
        raise MissingExtraError("a store of trials", "physics") from None


def schema_of(columns: dict[str, Kind]) -> Any:
    """Arrow schema of columns."""
    pa = arrow()
    types = {kind: getattr(pa, name)() for kind, name in _ARROW.items()}
    types |= {kind: pa.list_(types[each]) for kind, each in _LISTS.items()}
    return pa.schema([(name, types[kind]) for name, kind in columns.items()])


def refusal(folder: Path, why: str | OSError | ValueError) -> InputError:
    """Why a store cannot be used."""
    text = why if isinstance(why, str) else f"cannot be used: {reason(why)}"
    return InputError(f"store {short(folder)!r}: {text}")


def _checksum(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=8).hexdigest()


# Parts


@cache
def load_parts() -> None:
    """Load what writes parts, up to a second's work: pyarrow imports pandas where it is there."""
    arrow("pyarrow.parquet")
    arrow().array([])


def write_part(folder: Path, number: int, rows: Sequence[Row], schema: Any) -> None:
    """Write a part so that it is there whole or not at all."""
    buffer = io.BytesIO()
    table = arrow().Table.from_pylist(list(rows), schema=schema)
    arrow("pyarrow.parquet").write_table(
        table, buffer, compression="zstd", write_page_checksum=True
    )
    data = buffer.getvalue()
    name = f"part-{number:06d}-{_checksum(data)}.parquet"
    with whole_file(folder / PARTS / name, durable=True) as file:
        file.write(data)


def parts_of(folder: Path) -> dict[Path, int]:
    """Parts of a store with their numbers, oldest first."""
    return _numbered(folder, (folder / PARTS).glob("part-*"), _PART)


def journals_of(folder: Path) -> dict[Path, int]:
    """Journals of a store with their numbers; one at most, unless somebody copied files."""
    return _numbered(folder, folder.glob("journal-*"), _JOURNAL)


def _numbered(folder: Path, paths: Iterator[Path], form: re.Pattern[str]) -> dict[Path, int]:
    found = {}
    for path in sorted(paths):
        match = form.fullmatch(path.name)
        if match is None:
            name = short(path.relative_to(folder))
            raise refusal(folder, f"{name!r} is no file of a store of this version; move it away")
        found[path] = int(match[1])
    return found


def _content(path: Path) -> bytes:
    """What a file holds; a pipe or a device in its place is not waited for."""
    if path.exists() and not path.is_file() and not path.is_dir():
        raise OSError(errno.EINVAL, "it is no file")
    return path.read_bytes()


def batches_of(part: Path, columns: Sequence[str], schema: Any) -> Iterator[Any]:
    """Record batches of a part."""
    match = _PART.fullmatch(part.name)
    try:
        data = _content(part)
        if match is None or _checksum(data) != match[2]:
            raise InputError(f"{part}: is damaged: its checksum is not that of its name")
        with arrow("pyarrow.parquet").ParquetFile(io.BytesIO(data)) as file:
            if file.schema_arrow != schema:
                raise InputError(f"{part}: is a part of another store: its columns are others")
            yield from file.iter_batches(columns=list(columns))
    except (OSError, ValueError) as error:  # all of pyarrow's are one of these
        raise InputError(f"{part}: cannot be read: {reason(error)}") from None


# Journals


def journal_path(folder: Path, number: int) -> Path:
    """Where a journal is."""
    return folder / f"journal-{number:06d}.jsonl"


def journal_line(row: Row) -> bytes:
    """Row as a line of a journal."""
    text = json.dumps(row).encode("ascii")
    return _checksum(text).encode("ascii") + b" " + text + b"\n"


def journal_rows(path: Path) -> list[Row]:
    """Rows of a journal; what a power cut left half written at its end is none."""
    rows: dict[str, Row] = {}
    bad = 0
    for number, line in enumerate(_content(path).split(b"\n"), start=1):
        check, _, text = line.partition(b" ")
        if check != _checksum(text).encode("ascii"):
            bad = bad or number
            continue
        if bad:
            raise InputError(
                f"{path}: line {bad} is damaged: delete it, and its trial is done again"
            )
        row = json.loads(text)
        rows.setdefault(row["id"], row)
    return list(rows.values())


# campaign.json


def about_store(folder: Path, *, missing_is_new: bool = False) -> dict[str, Any] | None:
    """What `campaign.json` holds."""
    try:
        about = json.loads(_content(folder / ABOUT))
    except FileNotFoundError:
        if missing_is_new:
            return None
        raise refusal(folder, f"no such store ({ABOUT} is missing)") from None
    except OSError as error:
        raise refusal(folder, error) from None
    except (ValueError, RecursionError):
        raise refusal(folder, f"{ABOUT} is damaged: it is no JSON") from None
    if not isinstance(about, dict) or about.get("format") != FORMAT:
        raise refusal(folder, f"{ABOUT} is not of format {FORMAT}")
    if about.pop("checksum", None) != _checksum(_canonical(about)):
        raise refusal(folder, f"{ABOUT} is damaged: its checksum is not that of its content")
    return about


def write_about(folder: Path, about: dict[str, Any]) -> None:
    """Write `campaign.json`."""
    about = {"format": FORMAT, **about}
    text = json.dumps({**about, "checksum": _checksum(_canonical(about))}, indent=1) + "\n"
    with whole_file(folder / ABOUT, durable=True) as file:
        file.write(text.encode("ascii"))


def _canonical(about: dict[str, Any]) -> bytes:
    return json.dumps(about, sort_keys=True).encode("ascii")
