"""What a file holds as sheets that a question takes: the page fills its panels with them."""

import tomllib
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from kaidan.errors import InputError
from kaidan.files import points_of
from kaidan.readers import NO_HINTS, found_in
from kaidan.readers.opening import Source
from kaidan.readers.recognition import known, recognised
from kaidan.robot import Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

LARGEST_SHEET = 1 << 20
"""Largest file that is read as a sheet in TOML or as a table of points [bytes]."""


def sheets_of(file: str) -> dict[str, Any]:
    """Robots and stairs in a file, each as the table that a question takes in the place of a name.

    ``robots``, ``stairs`` (of several flights a list from bottom to top), ``storeys``, the one on
    which each of the stairs begins, "" where the file has none, and ``notes``: why something that
    was found is not among them.
    """
    made: dict[str, Any] = {"robots": [], "stairs": [], "storeys": [], "notes": []}
    source = Source.of(file)
    if known(source) is None:
        kind, sheet = _written(Path(file)) or (None, None)
        if kind is None:
            recognised(source)  # says what is known
        else:
            made[kind].append(sheet)
            made["storeys"] = [""] * len(made["stairs"])
        return made
    found = found_in(file, NO_HINTS)
    made["notes"] = [str(each) for each in found.refusals]
    made["robots"] = [sheet for _, sheet in _possible(found.robots, made["notes"])]
    for staircase, sheet in _possible(found.staircases, made["notes"]):
        made["stairs"].append(sheet)
        made["storeys"].append(staircase.facts.get("storey", ""))
    return made


def _possible(found: Any, notes: list[str]) -> Iterator[tuple[Any, Any]]:
    """What was found, each with its sheet; why there is none goes into the notes."""
    for each in found:
        try:
            if hasattr(each, "robot"):
                yield each, each.robot().model_dump(mode="json")
                continue
            flights = [flight.model_dump(mode="json") for flight in each.stairs()]
        except InputError as error:
            notes.append(str(error))
        else:
            yield each, flights[0] if len(flights) == 1 else flights


def _written(path: Path) -> tuple[str, dict[str, Any]] | None:
    """Sheet in TOML, or profile of a table of points; None: neither."""
    if not path.is_file() or path.stat().st_size > LARGEST_SHEET:
        return None
    with suppress(ValueError, RecursionError):
        text = path.read_text(encoding="utf-8")
        table = tomllib.loads(text)
        kind, sheet = ("robots", Robot) if "track" in table else ("stairs", Stairs)
        of: Callable[..., Robot | Stairs] = sheet.from_text
        return kind, of(text, origin="the sheet").model_dump(mode="json")
    with suppress(InputError, ValueError):
        return "stairs", Profile.of_points(points_of(path), name="profile").to_dict()
    return None
