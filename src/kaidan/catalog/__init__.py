"""The catalogues: TOML files with a source for every number, by kind and name.

``robots``, ``stairs`` and ``surfaces`` are folders of this package; a file's stem is the name.
``unweighed`` holds robots of which no centroid is published, with a stated range of it, and
``gross.toml`` those of which not even the length is. Sources begin with a status
letter: V read in the named source, C computed from a public robot model, D derived, U recalled
and unconfirmed. ``outcomes.toml`` holds robots on stairs whose outcome is public.
"""

import os
import tomllib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Literal, TypeVar

from kaidan.errors import InputError, UnknownNameError, short

Kind = Literal["robots", "stairs", "surfaces"]
Folder = Kind | Literal["unweighed"]
T = TypeVar("T")

_HERE = Path(__file__).parent
_SINGULAR: dict[Kind, str] = {"robots": "robot", "stairs": "staircase", "surfaces": "surface"}
_MARKS: dict[Kind, set[str]] = {
    "robots": {"track", "com_from_front", "com_height", "front_flippers", "rear_flippers", "drive"},
    "stairs": {"rise", "going", "rises", "goings", "steps", "nosing_overhang"},
    "surfaces": {"friction_low", "friction_high", "friction_uncertainty"},
}
"""Fields by which a sheet is known."""
_LARGEST_FILE = 1_000_000


@cache
def names(kind: Folder) -> tuple[str, ...]:
    """Names of a catalogue, sorted; "unweighed" are robots whose centroid is a range."""
    return tuple(sorted(path.stem for path in (_HERE / kind).glob("*.toml")))


@cache
def gross_robots() -> dict[str, dict[str, str]]:
    """Robots of which only gross figures are published, by name: title, figures, source."""
    return tomllib.loads((_HERE / "gross.toml").read_text(encoding="utf-8"))


@cache
def outcomes() -> dict[str, Any]:
    """Robots on stairs whose outcome is public: pairs, sources, and reports without a geometry."""
    return tomllib.loads((_HERE / "outcomes.toml").read_text(encoding="utf-8"))


@cache
def _entry(folder: Folder, stem: str, read: Callable[..., Any]) -> Any:
    """Sheet of the catalogue; sheets are frozen, so that one serves all."""
    return read((_HERE / folder / f"{stem}.toml").read_text(encoding="utf-8"), origin=stem)


def _is_there(path: Path) -> bool:
    """Whether a file exists, of what may be no path at all."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def load(kind: Kind, name: str, read: Callable[..., T]) -> T:
    """Sheet of a catalogue entry, or of a user's TOML file.

    kind, {"robots", "stairs", "surfaces"}: catalogue.
    name: name in it (case does not matter), or path of a TOML file.
    read: called as ``read(text, origin=...)``.

    What `read` makes of the text.
    """
    stem = name.strip().lower()
    folders: tuple[Folder, ...] = ("robots", "unweighed") if kind == "robots" else (kind,)
    for folder in folders:
        if stem in names(folder):
            found: T = _entry(folder, stem, read)
            return found
    if kind == "robots" and stem in gross_robots():
        raise InputError(
            f"{gross_robots()[stem]['title']}: neither length nor centroid is published, so no "
            "margin can be computed; measure the robot: kaidan measure robot --help"
        )
    path = Path(name)
    if stem == "" or not _is_there(path):
        if path.suffix.lower() == ".toml" or not {"/", os.sep}.isdisjoint(name):
            raise InputError(f"{short(name)}: no such file")
        if stem and _is_there(Path(f"{name}.toml")):
            raise InputError(f"{short(name)}: no such file. Did you mean {short(name)}.toml?")
        elsewhere = [f", but a {_SINGULAR[each]} is" for each in _SINGULAR if stem in names(each)]
        known = [each for folder in folders for each in names(folder)]
        raise UnknownNameError(_SINGULAR[kind], name, known, "".join(elsewhere))
    origin = short(name)
    text = text_of(path)
    try:
        return read(text, origin=origin)
    except InputError:
        for other in _SINGULAR:
            if other != kind and _is_sheet_of(other, text) and not _is_sheet_of(kind, text):
                raise InputError(
                    f"{origin}: is the sheet of a {_SINGULAR[other]}, not of a {_SINGULAR[kind]}"
                ) from None
        raise


def _is_sheet_of(kind: Kind, text: str) -> bool:
    """Whether a TOML text has a field that only sheets of a kind have."""
    try:
        return not _MARKS[kind].isdisjoint(tomllib.loads(text))
    except (ValueError, RecursionError):
        return False


def text_of(path: Path) -> str:
    """Text of a user's file, with or without a byte order mark."""
    origin = short(path)
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
