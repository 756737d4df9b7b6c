"""The catalogues: TOML files with a source for every number, by kind and name.

``robots``, ``stairs`` and ``surfaces`` are folders of this package; a file's stem is the name.
``gross.toml`` holds the robots of which no centroid is published.
"""

import tomllib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Literal, TypeVar

from kaidan.errors import InputError, UnknownNameError

Kind = Literal["robots", "stairs", "surfaces"]
T = TypeVar("T")

_HERE = Path(__file__).parent
_SINGULAR = {"robots": "robot", "stairs": "staircase", "surfaces": "surface"}


@cache
def names(kind: Kind) -> tuple[str, ...]:
    """Names of a catalogue, sorted."""
    return tuple(sorted(path.stem for path in (_HERE / kind).glob("*.toml")))


@cache
def gross_robots() -> dict[str, dict[str, Any]]:
    """Robots of which only gross figures are published, by name."""
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
        A robot of which no centroid is published.
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
        is_file = path.is_file()
    except (OSError, ValueError):
        is_file = False
    if not is_file:
        raise UnknownNameError(_SINGULAR[kind], name, names(kind))
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise InputError(f"{name}: cannot be read: {reason}") from None
    return read(text, origin=name)
