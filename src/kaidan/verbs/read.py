"""What a file is and what was found in it: robots, staircases, or why there are none."""

from collections.abc import Mapping
from os import PathLike, fspath
from typing import Any, ClassVar

from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments, several, table
from kaidan.errors import InputError, short, shown
from kaidan.modes import Verdict
from kaidan.override import paths_of
from kaidan.progress import working
from kaidan.readers import found_in
from kaidan.readers.estimate import Refusal
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import AXES, UNITS, Known
from kaidan.readers.opening import split_element
from kaidan.readers.recognition import FORMATS
from kaidan.sheet import Sheet
from kaidan.spelling import own_figures, quantity_of, word_of
from kaidan.verbs.read_robot import RobotRead, robot_read
from kaidan.verbs.read_stairs import StaircaseRead, staircase_read

_ANGLES = ("deg", "rad", "°")


class RefusalRead(Part):
    """Why something holds nothing that can be judged."""

    why: str
    """Reason in one word."""
    sentence: str
    """Reason in words, with its numbers."""
    element: str
    """Part of the file; empty: all of it."""
    name: str
    """What the file calls that part."""
    numbers: dict[str, float | str]
    """What was measured."""


class FileAnswer(Answer):
    """What a file is and what was found in it."""

    text_module: ClassVar[str] = "kaidan.text.read_file"

    file: str
    """Its path."""
    digest: str
    """SHA-256 of its content."""
    form: str
    """Format that its content shows."""
    title: str
    """What people call that format."""
    unit: tuple[str, str] | None
    """Unit of its lengths, and how it is known; null: not known."""
    up: tuple[str, str] | None
    """Axis that points up, and how it is known; null: not known."""
    robots: tuple[RobotRead, ...]
    """Robots in it."""
    staircases: tuple[StaircaseRead, ...]
    """Staircases in it."""
    refusals: tuple[RefusalRead, ...]
    """What was looked at and holds nothing to judge."""
    notes: tuple[str, ...]
    """What the reader had to do or to leave out."""

    @property
    def exit_code(self) -> int:
        """0 where something was found, else that of an answer outside the model."""
        found = self.robots or self.staircases
        return 0 if found else Verdict.OUTSIDE_MODEL.exit_code

    def sheets(self) -> dict[str, Sheet]:
        """Data sheets of the one robot, or of the flights of the one staircase, by name."""
        if self.robots:
            return {self.robots[0].name: self.robots[0].sheet}
        if len(self.staircases) != 1:
            parts = [short(each.element or each.name) for each in self.staircases[:8]]
            raise InputError(
                f"{short(self.file)}: holds {len(self.staircases)} staircases; write FILE#PART "
                f"with one of {', '.join(parts)}"
                if parts
                else f"{short(self.file)}: holds nothing of which a sheet can be made"
            )
        flights = self.staircases[0].flights
        for each in flights:
            if each.no_sheet:
                raise InputError(f"{short(self.file)}: {each.no_sheet}")
        return {each.sheet.name: each.sheet for each in flights if each.sheet is not None}


@known_arguments
def read(
    file: str | PathLike[str],
    *,
    unit: str | None = None,
    up: str | None = None,
    forward: str | None = None,
    crop: Any = None,
    range_error: Any = None,
    gravity: Any = None,
    viewpoint: Any = None,
    resolution: Any = None,
    joints: Any = (),
    override: Any = (),
) -> FileAnswer:
    """What a file is, by its content, what was found in it, and with what doubt.

    Parameters
    ----------
    file : str or path
        File, or ``path#part``: a GlobalId, a topic, a model's name.
    unit : {"m", "cm", "mm", "in", "ft"}, optional
        Unit of its lengths, where it does not say it or says it wrongly.
    up, forward : {"+x", "-x", "+y", "-y", "+z", "-z"}, optional
        Axis of the file that points up; that to a robot's front.
    crop : (6 numbers) or str, optional
        Only what is within: smallest x, y, z, then largest, in the file's frame and unit.
    range_error : float or str, optional
        Standard error of measured distances, as a share of them: 0.005 or "0.005".
    gravity : float or str, optional
        Standard error of the up axis against gravity [rad]; or "1deg".
    viewpoint : (3 numbers) or str, optional
        Where the sensor stood, in the file's frame and unit.
    resolution : float or str, optional
        Side of a cell of an elevation map that does not say it [m]; or "20mm".
    joints : mapping or str
        Joint angles of a robot: {"arm": 0.5} [rad, or m where it slides] or "arm=30deg".
    override : mapping or str
        The user's own figures for a robot: "com_height=200mm,track.front_radius=90mm".

    Raises
    ------
    InputError
        A file that cannot be read or contradicts itself, or a hint without meaning.
    MissingExtraError
        Its reader needs an optional package.
    """
    if not isinstance(file, str | PathLike):
        raise InputError(f"file = {shown(file)} is not a path")
    path, element = split_element(fspath(file))
    given = {
        "unit": None if unit is None else word_of("unit", unit, UNITS),
        "up": None if up is None else word_of("up", up, AXES),
        "forward": None if forward is None else word_of("forward", forward, AXES),
        "crop": _numbers("crop", crop, 6),
        "range_error": None if range_error is None else quantity_of("range_error", range_error,
                                                                    "number"),
        "gravity": None if gravity is None else quantity_of("gravity", gravity, "angle"),
        "viewpoint": _numbers("viewpoint", viewpoint, 3),
        "resolution": None if resolution is None else quantity_of("resolution", resolution,
                                                                  "length"),
        "joints": joint_angles(joints),
        "figures": paths_of(own_figures(override)),
        "element": element,
    }  # fmt: skip
    hints = Hints(**{name: value for name, value in given.items() if value is not None})
    with working(f"looking at {short(path)}"):
        found = found_in(path, hints)
        form = next(each for each in FORMATS if each.name == found.provenance.form)
        return FileAnswer(
            file=path,
            digest=found.provenance.digest,
            form=form.name,
            title=form.title,
            unit=_known(found.provenance.unit),
            up=_known(found.provenance.up),
            robots=tuple(robot_read(each) for each in found.robots),
            staircases=tuple(staircase_read(each, found.contents) for each in found.staircases),
            refusals=tuple(_refusal(each) for each in found.refusals),
            notes=found.provenance.notes,
        )


def joint_angles(given: Any) -> dict[str, float]:
    """Joint angles of a mapping, or of texts such as "arm=30deg,mast=200mm" [rad or m].

    Examples
    --------
    >>> joint_angles("mast=200mm,lift=0.5m")
    {'mast': 0.2, 'lift': 0.5}
    """
    if isinstance(given, Mapping):
        return {
            name: quantity_of(f"joint {short(name)}", value, "angle")
            for name, value in table("joints", given).items()
        }
    texts = [given] if isinstance(given, str) else several("joints", () if given is None else given)
    if not all(isinstance(text, str) for text in texts):
        raise InputError(f"joints = {shown(given)}: write NAME=ANGLE, for example arm=30deg")
    found: dict[str, float] = {}
    for text in ",".join(texts).split(",") if texts else ():
        name, equals, value = text.partition("=")
        if not equals or not name.strip():
            raise InputError(f"joint {short(text)!r}: write NAME=ANGLE, for example arm=30deg")
        kind = "angle" if value.rstrip().endswith(_ANGLES) else "length"
        found[name.strip()] = quantity_of(f"joint {name.strip()}", value, kind)
    return found


def _numbers(name: str, given: Any, count: int) -> tuple[float, ...] | None:
    """Numbers of a sequence or of a text with commas."""
    if given is None:
        return None
    try:
        items = given.split(",") if isinstance(given, str) else list(given)
        values = tuple(float(each) for each in items)
    except (TypeError, ValueError, OverflowError):
        values = ()
    if len(values) != count:
        raise InputError(f"{name} = {shown(given)} is not {count} numbers with commas between them")
    return values


def _known(fact: Known | None) -> tuple[str, str] | None:
    return None if fact is None else (fact.value, fact.how)


def _refusal(found: Refusal) -> RefusalRead:
    return RefusalRead(
        why=found.why,
        sentence=str(found),
        element=found.provenance.element,
        name=found.name,
        numbers=dict(found.numbers),
    )
