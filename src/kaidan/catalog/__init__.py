"""The catalogues: TOML files with a source for every number, by kind and name.

``robots``, ``stairs`` and ``surfaces`` are folders of this package; a file's stem is the name.
``gross.toml`` holds the robots of which no centroid is published. Sources begin with a status
letter: V read in the named source, C computed from a public robot model, D derived, U recalled
and unconfirmed.
"""

import tomllib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Literal, TypeVar

from kaidan.errors import InputError, UnknownNameError

Kind = Literal["robots", "stairs", "surfaces"]
T = TypeVar("T")

_HERE = Path(__file__).parent
_SINGULAR = {"robots": "robot", "stairs": "staircase", "surfaces": "surface"}
_LARGEST_FILE = 1_000_000


@cache
def names(kind: Kind) -> tuple[str, ...]:
    """Names of a catalogue, sorted."""
    return tuple(sorted(path.stem for path in (_HERE / kind).glob("*.toml")))


@cache
def gross_robots() -> dict[str, dict[str, str]]:
    """Robots of which only gross figures are published, by name: title, figures, source."""
    return tomllib.loads((_HERE / "gross.toml").read_text(encoding="utf-8"))


def load(kind: Kind, name: str, read: Callable[..., T]) -> T:
    """Sheet of a catalogue entry, or of a user's TOML file.

    Parameters
    ----------
    kind : {"robots", "stairs", "surfaces"}
        Catalogue.
    name : str
        Name in it (case does not matter), or path of a TOML file.
    read : callable
        Called as ``read(text, origin=...)``.

    Returns
    -------
    object
        What `read` makes of the text.

    Raises
    ------
    UnknownNameError
        No such name and no such file.
    InputError
        A robot of which no centroid is published, or a file that cannot be read.
    """
    stem = name.strip().lower()
    if stem in names(kind):
        return read((_HERE / kind / f"{stem}.toml").read_text(encoding="utf-8"), origin=stem)
    if kind == "robots" and stem in gross_robots():
        raise InputError(
            f"{gross_robots()[stem]['title']}: no centroid is published, so no margin can be "
            "computed; weigh and tilt the robot and fill in a sheet: kaidan new robot"
        )
    path = Path(name)
    try:
        exists = stem != "" and path.exists()
    except (OSError, ValueError):
        exists = False
    if not exists:
        raise UnknownNameError(_SINGULAR[kind], name, names(kind))
    origin = name if name.isprintable() else repr(name)
    return read(_text(path, origin), origin=origin)


def _text(path: Path, origin: str) -> str:
    """Text of a user's file, with or without a byte order mark."""
    try:
        if path.is_dir():
            raise InputError(f"{origin}: cannot be read: a folder, not a TOML file")
        if not path.is_file():
            raise InputError(f"{origin}: cannot be read: not a regular file")
        if path.stat().st_size > _LARGEST_FILE:
            raise InputError(f"{origin}: cannot be read: larger than 1 MB, so not a sheet")
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(f"{origin}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{origin}: cannot be read: not UTF-8 text") from None
