"""Answers as recordings of Rerun: a traverse, a trial, what was found in a file.

World: x along the path, y to the left, z up [m]. Timelines: ``pose`` counts poses, ``path`` is the
centroid's path in millimetres, ``time`` that of a trial.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, needed, short
from kaidan.figures import side_view
from kaidan.figures.style import Array
from kaidan.files import reason

if TYPE_CHECKING:
    from kaidan.physics import TrialLog
    from kaidan.verbs.read import FileAnswer
    from kaidan.verbs.read_stairs import FlightRead
    from kaidan.verbs.traverse_report import (
        ForceShown,
        LogEntryShown,
        PartShown,
        TraverseReport,
    )

Numbers = NDArray[Any]

SUFFIX = ".rrd"
_HALF = 0.3
"""Half of the width in which a terrain that is known from the side is drawn [m]."""
_STONE, _ROBOT, _FORCE, _CURVE = (
    (150, 150, 150), (0, 114, 178), (213, 94, 0), (0, 158, 115)
)  # fmt: skip
_CURVES = (
    "inclination_deg", "required_friction", "traction_over_weight", "energy_margin_mm",
    "static_margin_back_m", "static_margin_front_m", "zmp_rear_to_front",
)  # fmt: skip
"""Columns of the poses that are drawn over the path."""


def recording_file(path: Path) -> Path:
    """Path of a recording, once it is sure that one can be written there.

    Raises
    ------
    InputError
        Another suffix than .rrd.
    MissingExtraError
        ``kaidan[rerun]`` is not installed.
    """
    if path.suffix.lower() != SUFFIX:
        raise InputError(f"{short(path)!r}: a recording of Rerun ends in {SUFFIX}")
    needed("rerun", "a recording of Rerun", "rerun")
    return path


def answer_recording(path: Path) -> bytes:
    """Recording of a traverse or of what was found in a file, each as its JSON has it.

    Parameters
    ----------
    path : Path
        What ``kaidan traverse --json`` or ``kaidan read --json`` printed.

    Raises
    ------
    InputError
        The file cannot be read, or is no such answer.
    """
    from kaidan.verbs.read import FileAnswer
    from kaidan.verbs.traverse_report import TraverseReport

    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        raise InputError(f"{short(path)}: cannot be read: {reason(error)}") from None
    if '"staircases"' in text:
        return file_recording(FileAnswer.from_json(text))
    return traverse_recording(TraverseReport.from_json(text))


def traverse_recording(found: "TraverseReport") -> bytes:
    """Recording of a traverse: terrain, robot at each pose, contacts, forces, margins, events."""
    made = _Recording(found.assessment.question.robot.name)
    poses = found.poses
    made.document("answer", str(found))
    made.terrain(np.array(found.profile.points_m), np.array(found.profile.nosings_m))
    x, z = np.array(poses.x_m), np.array(poses.z_m)
    indexes = {"pose": np.arange(len(x)), "path": np.round(1e3 * np.array(poses.path_m))}
    made.path(x, z)
    made.robot(indexes, x, z, np.radians(np.array(poses.inclination_deg)))
    starts = {0, *(each.row + 1 for each in found.moves if each.row + 1 < len(x))}
    for row in sorted(starts):
        made.outline(found.outline_at(row), {name: each[row] for name, each in indexes.items()})
    for name in _CURVES:
        made.curve(f"margins/{name}", indexes, getattr(poses, name))
    made.forces(indexes, poses.forces)
    log = found.event_log
    made.notes(
        {"pose": np.array([each.row for each in log]), "path": _millimetres(log)},
        [f"{each.phase}: {each.text}" for each in log],
    )
    return made.content()


def trial_recording(log: "TrialLog") -> bytes:
    """Recording of a trial in MuJoCo: terrain, centroid and inclination, every column over time.

    Raises
    ------
    InputError
        A trial that ended before the track moved.
    """
    if len(log) == 0:
        raise InputError(f"trial: it has no log (outcome: {log.result.outcome.value})")
    question = log.result.spec.question
    made = _Recording(question.robot.name)
    made.document("answer", str(log.result))
    made.terrain(np.asarray(question.profile.points), np.asarray(question.profile.nosings))
    x, z = log.columns["x_m"], log.columns["z_m"]
    indexes = {"time": log.columns["time_s"]}
    made.path(x, z)
    made.robot(indexes, x, z, np.radians(log.columns["inclination_deg"]))
    for name, column in log.table().items():
        if name not in ("time_s", "x_m", "z_m"):
            made.curve(f"trial/{name}", indexes, column)
    return made.content()


def file_recording(found: "FileAnswer") -> bytes:
    """Recording of a file: nosings with their doubt over the points, or the robot from the side."""
    made = _Recording(found.title)
    made.document("answer", str(found))
    for staircase in found.staircases:
        for number, flight in enumerate(staircase.flights, start=1):
            made.flight(f"staircases/{staircase.name}/flight {number}", flight)
    for robot in found.robots:
        if robot.view is not None:
            for name in ("tracks", "flippers", "body"):
                made.shapes(f"robots/{robot.name}/{name}", getattr(robot.view, name))
    return made.content()


class _Recording:
    """A recording that is being made."""

    def __init__(self, name: str) -> None:
        self._rr: Any = needed("rerun", "a recording of Rerun", "rerun")
        self._stream = self._rr.RecordingStream("kaidan", send_properties=False)
        self._bytes = self._stream.binary_stream()
        self._stream.send_recording_name(name)
        self._static("", self._rr.ViewCoordinates.RIGHT_HAND_Z_UP)

    def content(self) -> bytes:
        """The file."""
        content: bytes = self._bytes.read(flush=True)
        return content

    def document(self, entity: str, text: str) -> None:
        self._static(entity, self._rr.TextDocument(text))

    def terrain(self, points: Array, nosings: Array) -> None:
        sides = [_lifted(points, y) for y in (-_HALF, _HALF)]
        across = [_lifted(np.array([each, each]), 0.0) for each in points]
        for line in across:
            line[:, 1] = (-_HALF, _HALF)
        self._static("terrain/profile", self._rr.LineStrips3D([*sides, *across], colors=[_STONE]))
        if len(nosings):
            self._static(
                "terrain/nosings", self._rr.Points3D(_lifted(nosings), radii=0.008, colors=[_STONE])
            )

    def path(self, x: Array, z: Array) -> None:
        line = _lifted(np.column_stack([x, z]))
        self._static("path", self._rr.LineStrips3D([line], colors=[_CURVE]))

    def robot(self, indexes: Mapping[str, Numbers], x: Array, z: Array, phi: Array) -> None:
        """Where the robot is: its leading end up is a negative rotation about y."""
        turn = np.column_stack([0 * phi, -np.sin(phi / 2), 0 * phi, np.cos(phi / 2)])
        columns = self._rr.Transform3D.columns(
            translation=_lifted(np.column_stack([x, z])), quaternion=turn
        )
        self._stream.send_columns("robot", indexes=self._times(indexes), columns=columns)
        centroid = self._rr.Points3D([[0.0, 0.0, 0.0]], radii=0.012, colors=[_ROBOT])
        self._static("robot/centroid", centroid)

    def outline(self, outline: "tuple[PartShown, ...]", at: Mapping[str, float]) -> None:
        """Outline of the robot from a pose on."""
        parts = side_view.drawn_parts(outline)
        strips = np.array([_lifted(side_view.hull(each)) for each in parts])
        columns = self._rr.LineStrips3D.columns(
            strips=list(strips), colors=[_ROBOT] * len(strips)
        ).partition([len(strips)])
        self._stream.send_columns("robot/outline", indexes=self._at(at), columns=columns)

    def curve(self, entity: str, indexes: Mapping[str, Numbers], values: Iterable[Any]) -> None:
        """Numbers over the path; what is not known is left out."""
        numbers = np.array([np.nan if each is None else each for each in values], dtype=float)
        known = np.isfinite(numbers)
        if known.any():
            times = self._times({name: each[known] for name, each in indexes.items()})
            columns = self._rr.Scalars.columns(scalars=numbers[known])
            self._stream.send_columns(entity, indexes=times, columns=columns)

    def forces(
        self, indexes: Mapping[str, Numbers], poses: "Sequence[Sequence[ForceShown]]"
    ) -> None:
        """Forces of each pose over the weight, a fifth of a metre long where they are once it."""
        every = [each for forces in poses for each in forces]
        points = np.array([(each.x_m, each.z_m) for each in every]).reshape(-1, 2)
        columns = self._rr.Arrows3D.columns(
            origins=_lifted(points),
            vectors=0.2 * _lifted(np.array([_force(each) for each in every]).reshape(-1, 2)),
            colors=[_FORCE] * len(every),
        ).partition([len(forces) for forces in poses])
        self._stream.send_columns("contacts", indexes=self._times(indexes), columns=columns)

    def notes(self, indexes: Mapping[str, Numbers], texts: Sequence[str]) -> None:
        if texts:
            columns = self._rr.TextLog.columns(text=texts)
            self._stream.send_columns("events", indexes=self._times(indexes), columns=columns)

    def flight(self, entity: str, flight: "FlightRead") -> None:
        """Nosings of a flight where they lie in plan, and the file's points in its middle."""
        left, right = np.array(flight.left), np.array(flight.right)
        nosings, sigmas = np.array(flight.nosings), np.array(flight.sigmas)
        lines = [
            np.array([[*a, z], [*b, z]]) for a, b, z in zip(left, right, nosings[:, 1], strict=True)
        ]
        self._static(f"{entity}/nosings", self._rr.LineStrips3D(lines, colors=[_ROBOT]))
        middle = (left + right) / 2
        along = _direction(left, right, middle)
        start = middle[0] - nosings[0, 0] * along
        self._static(
            f"{entity}/doubt",
            self._rr.Ellipsoids3D(
                centers=np.column_stack([middle, nosings[:, 1]]),
                half_sizes=np.column_stack([sigmas[:, 0], sigmas[:, 0], sigmas[:, 1]]),
                colors=[_FORCE],
            ),
        )
        if flight.points:
            points = np.array(flight.points)
            world = np.column_stack([start + points[:, :1] * along, points[:, 1]])
            self._static(f"{entity}/points", self._rr.Points3D(world, radii=0.003, colors=[_STONE]))

    def shapes(self, entity: str, shapes: Sequence[Any]) -> None:
        if shapes:
            strips = [_lifted(np.array(each)) for each in shapes]
            self._static(entity, self._rr.LineStrips3D(strips, colors=[_ROBOT]))

    def _static(self, entity: str, what: Any) -> None:
        self._stream.log(entity, what, static=True)

    def _at(self, at: Mapping[str, float]) -> list[Any]:
        return self._times({name: np.array([each]) for name, each in at.items()})

    def _times(self, indexes: Mapping[str, Numbers]) -> list[Any]:
        return [
            self._rr.TimeColumn(name, duration=each)
            if name == "time"
            else self._rr.TimeColumn(name, sequence=np.asarray(each).astype(int))
            for name, each in indexes.items()
        ]


def _force(each: "ForceShown") -> tuple[float, float]:
    """Force of a contact over the weight, along x and up."""
    load, traction = each.load_over_weight or 0.0, each.traction_over_weight or 0.0
    return (
        load * each.normal_x + traction * each.normal_z,
        load * each.normal_z - traction * each.normal_x,
    )


def _millimetres(log: "Sequence[LogEntryShown]") -> Numbers:
    return np.array([round(1e3 * each.path_m) for each in log])


def _lifted(points: Array, y: float = 0.0) -> Array:
    """Points x, z in the world, beside its middle by y."""
    return np.column_stack([points[:, 0], np.full(len(points), y), points[:, 1]])


def _direction(left: Array, right: Array, middle: Array) -> Array:
    """Unit vector in plan along a flight, up it."""
    if len(middle) > 1:
        run = middle[-1] - middle[0]
    else:  # a single nosing: what is left of it is left of who goes up
        across = left[0] - right[0]
        run = np.array([across[1], -across[0]])
    length = math.hypot(*run)
    return run / length if length else np.array([1.0, 0.0])
