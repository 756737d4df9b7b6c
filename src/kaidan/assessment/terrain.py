"""What the robot is to climb: a sheet, its name, several flights, or a profile of any shape."""

from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from kaidan.errors import InputError
from kaidan.profile import Profile
from kaidan.robot import Robot
from kaidan.stairs import Stairs
from kaidan.surface import Surface

Flight = Stairs | str | PathLike[str]
Terrain = Flight | Sequence[Flight] | Profile

JOINT = "+"
"""Between the names of several flights in one text."""
_NO_STEPS = {"rise": 0.18, "going": 0.28}
"""Stands where a terrain has no steps of its own; nothing of it is shown."""

T = TypeVar("T", Robot, Stairs, Surface)


def sheet_of(given: Any, kind: type[T]) -> T:
    """Sheet as given, or by its name or path."""
    if isinstance(given, kind):
        return given
    if isinstance(given, PathLike):
        given = fspath(given)
    if isinstance(given, str):
        return kind.named(given)
    raise InputError(
        f"{kind.label} = {shown(given)} is not a {kind.__name__}, a name of the catalogue or a "
        "TOML file"
    )


def terrain_of(given: Any) -> tuple[Stairs, Profile | None, bool]:
    """Stairs, a profile where they alone do not describe the terrain, and whether they fit it.

    Raises
    ------
    InputError
        Neither stairs nor a profile.
    """
    if isinstance(given, Profile):
        return _with_steps(given, "profile")
    if isinstance(given, str) and JOINT in given and not Path(given).exists():
        given = given.split(JOINT)
    if not isinstance(given, list | tuple):
        return sheet_of(given, Stairs), None, True
    flights = [sheet_of(each, Stairs) for each in given]
    if len(flights) == 1:
        return flights[0], None, True
    name = f" {JOINT} ".join(flight.name for flight in flights)
    return _with_steps(Profile.of_flights(flights), name)


def _with_steps(profile: Profile, name: str) -> tuple[Stairs, Profile, bool]:
    """Steps of a profile as a measured flight, where it has such."""
    x, z = profile.nosings.T
    try:
        steps = Stairs(
            name=name,
            rises=tuple(np.diff(z, prepend=profile.points[0, 1]).tolist()),
            goings=tuple(np.diff(x).tolist()),
            open_risers=profile.open_risers,
        )
    except InputError:
        return Stairs(name=name, **_NO_STEPS), profile, False
    return steps, profile, True


def shown(value: Any) -> str:
    """Text of any value in one short line."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
