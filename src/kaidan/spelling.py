"""What people write, as sheets: names, files, texts with units, pairs, mappings."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from os import PathLike, fspath
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from kaidan import catalog
from kaidan.allowance import Allowance
from kaidan.errors import InputError, did_you_mean, short, shown
from kaidan.override import OVERRIDES, kind_of_figure, overridden, paths_of, words_of_figure
from kaidan.robot import Payload, Posture, PostureChange, Robot
from kaidan.surface import Surface
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.units import parse, range_of

JOINT = "+"
"""Between the names of several flights in one text."""

BEST = "best"
"""Asks for the posture, its changes and the end that leads with which the answer is best."""
PREPARED = ("traverse", "land")
"""Phases that a change of posture may prepare."""

LARGEST = 10**300
"""Largest whole number that is taken for a figure: no decimal number is larger."""
Terrain = Stairs | tuple[Stairs, ...] | Profile
_Sheet = TypeVar("_Sheet", Robot, Stairs, Surface)
_NONE: Mapping[str, float] = {}

UNCERTAINTIES = {
    "com_from_front": "length",
    "com_height": "length",
    "flat_length": "length",
    "angle": "angle",
    "nosing_spacing": "length",
    "rise": "length",
    "going": "length",
    "friction": "number",
}
"""Figures whose standard uncertainty a question may state, and what they measure."""


def sheet_of(given: Any, kind: type[_Sheet]) -> _Sheet:
    """Sheet as given, by its name, or of a file: TOML, or one of which a sheet can be made."""
    if isinstance(given, kind):
        return given
    if isinstance(given, PathLike):
        given = fspath(given)
    if isinstance(given, str):
        return _of_file(given, kind) or kind.named(given)
    raise InputError(
        f"{kind.label} = {shown(given)} is not a {kind.__name__}, a name of the catalogue or a "
        "TOML file"
    )


def robot_of(given: Any, override: Any = ()) -> Robot:
    """Robot as given, by its name or of a file, with the user's own figures in place of its own."""
    own = own_figures(override)
    if own and isinstance(given, str | PathLike):
        read = _of_file(fspath(given), Robot, own)
        if read is not None:
            return read
    return overridden(sheet_of(given, Robot), own)


def flights_of(name: str) -> tuple[Stairs, ...] | None:
    """Flights of the one staircase in a file, from bottom to top; None: it is no such file."""
    if not _may_be_a_file(name, "stairs"):
        return None
    from kaidan.readers.sheets import staircase_sheets

    return staircase_sheets(name)


def _of_file(
    name: str, kind: type[_Sheet], own: Mapping[str, float | str] = _NONE
) -> _Sheet | None:
    """Sheet made of a file that holds a robot or stairs; None: the name is of no such file."""
    if kind is Robot and _may_be_a_file(name, "robots", "unweighed"):
        from kaidan.readers.hints import Hints
        from kaidan.readers.sheets import robot_sheet

        made: Any = robot_sheet(name, Hints(figures=paths_of(own)))
        return made  # type: ignore[no-any-return]
    if kind is Stairs and (flights := flights_of(name)) is not None:
        if len(flights) > 1:
            raise InputError(
                f"{short(name)}: a staircase of {len(flights)} flights where one flight is needed; "
                "write each into a sheet with kaidan read -o"
            )
        flight: Any = flights[0]
        return flight  # type: ignore[no-any-return]
    return None


def _may_be_a_file(name: str, *folders: catalog.Folder) -> bool:
    """Whether a name is in none of these catalogues and there is something of that path."""
    stem = name.strip().lower()
    if any(stem in catalog.names(folder) for folder in folders):
        return False
    try:
        paths = (Path(name), Path(name.rpartition("#")[0] or name))
        return any(path.is_file() or path.is_dir() for path in paths)
    except (OSError, ValueError):
        return False


def terrain_of(given: Any) -> Terrain:
    """One flight, several, or a profile, of what people write."""
    if isinstance(given, Profile):
        return given
    if isinstance(given, str) and JOINT in given and not Path(given).exists():
        given = given.split(JOINT)
    if isinstance(given, str | PathLike):
        given = flights_of(fspath(given)) or given
    if not isinstance(given, list | tuple):
        return sheet_of(given, Stairs)
    flights = tuple(sheet_of(each, Stairs) for each in given)
    if not flights:
        raise InputError("stairs: no flight was given")
    return flights[0] if len(flights) == 1 else flights


def own_figures(given: Any) -> dict[str, float | str]:
    """Figures and words of a robot's sheet by their short or dotted names, see `figures`.

    Examples
    --------
    >>> own_figures("com_height=200mm,front_flippers.length=0.3m,track.belt=grousers")
    {'com_height': 0.2, 'front_flippers.length': 0.3, 'track.belt': 'grousers'}
    """
    numbers: list[tuple[str, Any]] = []
    own: dict[str, float | str] = {}
    for key, value in _named_values(given, "override", OVERRIDES):
        words = words_of_figure(key) if isinstance(key, str) else ()
        if not words:
            numbers.append((key, value))
        elif key in own:
            raise InputError(f"override {key} is given twice")
        else:
            own[key] = word_of(f"override {key}", value, words)
    dotted = {key: kind_of_figure(key) for key, _ in numbers if isinstance(key, str) and "." in key}
    return _figures(numbers, OVERRIDES | dotted, "override") | own


def figures(given: Any, kinds: Mapping[str, str], name: str) -> dict[str, float]:
    """Figures by their names, of a mapping or of texts such as "com_height=200mm".

    Parameters
    ----------
    given : mapping, str or a sequence of str
        What the user wrote.
    kinds : mapping of str to str
        Names that are known, and what each measures.
    name : str
        What errors call it.

    Returns
    -------
    dict of str to float
        SI values.

    Raises
    ------
    InputError
        An unknown name, one given twice, or a value that is none.
    """
    return _figures(_named_values(given, name, kinds), kinds, name)


def _figures(
    pairs: Iterable[tuple[str, Any]], kinds: Mapping[str, str], name: str
) -> dict[str, float]:
    values: dict[str, float] = {}
    for key, value in pairs:
        if key not in kinds:
            meant = did_you_mean(key, kinds)
            raise InputError(
                f"{name} {shown(key)} is not known{meant}{' W' if meant else '; w'}rite "
                f"NAME=VALUE with a name of {', '.join(kinds)}"
            )
        if key in values:
            raise InputError(f"{name} {key} is given twice")
        values[key] = quantity_of(f"{name} {key}", value, kinds[key])
    return values


def _named_values(given: Any, name: str, kinds: Mapping[str, str]) -> Iterator[tuple[str, Any]]:
    if isinstance(given, Mapping):
        yield from given.items()
        return
    texts = (given,) if isinstance(given, str) else () if given is None else given
    if not isinstance(texts, list | tuple) or not all(isinstance(text, str) for text in texts):
        raise InputError(
            f"{name} = {shown(given)} is not a table or texts NAME=VALUE with a name of "
            f"{', '.join(kinds)}"
        )
    for text in ",".join(texts).split(",") if texts else ():
        key, equals, value = text.partition("=")
        if not equals:
            raise InputError(
                f"{name} {shown(text)}: write NAME=VALUE with a name of {', '.join(kinds)}"
            )
        yield key.strip(), value


def doubted(sheet: Any, doubts: dict[str, float], *names: str) -> Any:
    """Sheet with the standard uncertainties that are stated for it."""
    own = {name: doubts[name] for name in names if name in doubts}
    if not own:
        return sheet
    table = sheet.uncertainty.model_dump() | own
    uncertainty = type(sheet.uncertainty).model_validate(table)
    return type(sheet)(**dict(sheet) | {"uncertainty": uncertainty})


def doubted_terrain(terrain: Terrain, doubts: dict[str, float]) -> Terrain:
    """Terrain with the standard uncertainties that are stated for it."""
    common = doubts.keys() & {"angle", "nosing_spacing"}
    if not common and not doubts.keys() & {"rise", "going"}:
        return terrain
    if isinstance(terrain, Stairs):
        return _doubted_stairs(terrain, doubts)
    if isinstance(terrain, tuple):
        if common:
            raise InputError(
                "uncertainty of angle or nosing_spacing: give it in the sheet of each flight"
            )
        return tuple(_doubted_stairs(flight, doubts) for flight in terrain)
    if common:
        raise InputError(
            "uncertainty of angle or nosing_spacing: a profile takes them in its covariance"
        )
    return terrain.with_doubt(rise=doubts.get("rise", 0.0), going=doubts.get("going", 0.0))


def _doubted_stairs(stairs: Stairs, doubts: dict[str, float]) -> Stairs:
    own = {name: doubts[name] for name in type(stairs.uncertainty).model_fields if name in doubts}
    uncertainty = type(stairs.uncertainty).model_validate(stairs.uncertainty.model_dump() | own)
    stated = {name: getattr(stairs, name) for name in stairs.model_fields_set}
    return Stairs(**stated | {"uncertainty": uncertainty})


def surface_of(surface: Any, friction: Any, doubts: dict[str, float]) -> Surface | None:
    """Surface by its name, or of a friction; None where neither is given."""
    if surface is not None and friction is not None:
        raise InputError("give either a surface or a friction, not both")
    ground = None if surface is None else sheet_of(surface, Surface)
    if friction is not None:
        ground = Surface.of_friction(friction)
    if "friction" not in doubts:
        return ground
    if ground is None:
        raise InputError("uncertainty of friction needs a friction or a surface")
    return Surface(**dict(ground) | {"friction_uncertainty": doubts["friction"]})


def allowance_of(name: str, stated: Any) -> Allowance | None:
    """Allowance of an angle, a pair or a text; None where it was not measured."""
    if stated is None or isinstance(stated, Allowance):
        return stated
    return Allowance.of(range_of(stated, "angle", option=name), name=name)


def posture_of(given: Any, robot: Robot) -> Posture:
    """Posture as given, or of a text."""
    if isinstance(given, Posture):
        return given
    if not isinstance(given, str):
        raise InputError(f"flippers = {shown(given)} is not known; known: flat, stowed, or angles")
    return Posture.parse(given, robot)


def postures_of(given: Any, robot: Robot) -> tuple[Posture, tuple[PostureChange, ...]]:
    """Posture at the start and its changes, as given or of a text.

    Phases are written one after the other, "flat/land:-60deg,-20deg": what has no name is the
    posture at the start.
    """
    if isinstance(given, list | tuple) and given and isinstance(given[0], Posture):
        return given[0], tuple(given[1:])
    if not isinstance(given, str):
        return posture_of(given, robot), ()
    first, *others = given.split("/")
    changes = []
    for text in others:
        phase, colon, posture = text.partition(":")
        if not colon or phase.strip() not in PREPARED:
            raise InputError(
                f"flippers {shown(text)}: write a change as traverse:POSTURE or land:POSTURE, for "
                "example flat/land:-60deg,-20deg"
            )
        changes.append(PostureChange(before=phase.strip(), posture=Posture.parse(posture, robot)))
    return posture_of(first, robot), tuple(changes)


def payloads_of(given: Any) -> Iterator[Payload]:
    """Payloads of one, several, texts or nothing."""
    many: Iterable[Any] = (given,) if isinstance(given, Payload | str) else given
    if given is None:
        return
    with suppress(TypeError):
        each = tuple(many)
        if all(isinstance(one, Payload | str) for one in each):
            yield from (Payload.parse(one) if isinstance(one, str) else one for one in each)
            return
    raise InputError(f"payload = {shown(given)} is not a Payload or a list of them")


def quantity_of(name: str, given: Any, kind: str) -> Any:
    """SI value of a text with its unit; anything else as it is, for the sheet to judge."""
    if isinstance(given, str):
        return parse(given, kind, option=name)
    if isinstance(given, int) and abs(given) > LARGEST:
        raise InputError(f"{name} = {shown(given)} is beyond any figure")
    return given.item() if isinstance(given, np.generic) else given


def word_of(name: str, given: Any, known: Sequence[str]) -> Any:
    """Word that is one of those known."""
    if not isinstance(given, str) or given not in known:
        raise InputError(f"{name} = {shown(given)} is not known; known: {', '.join(known)}")
    return given
