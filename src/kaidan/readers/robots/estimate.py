"""A robot as a file describes it: figures of its sheet, where each is from, what is doubtful."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import PurePath
from typing import Any

from kaidan.errors import InputError, short
from kaidan.readers.kinds import Provenance
from kaidan.readers.robots.gear import End, Gear
from kaidan.readers.robots.mechanism import Fault, MassProperties, Placed
from kaidan.readers.robots.side_view import SideView
from kaidan.robot import Robot
from kaidan.text import robot_file as said


@dataclass(frozen=True)
class Figure:
    """A figure of a robot's sheet, as a file gives it."""

    value: Any
    """SI; a list of tables for wheels."""
    how: str
    """Where it is from, a noun phrase."""


@dataclass(frozen=True, eq=False)
class RobotEstimate:
    """A robot of a file."""

    name: str
    provenance: Provenance
    figures: Mapping[str, Figure]
    """By field: com_height, track.flat_length, front_flippers.length; those of the user too."""
    placed: Placed
    """The robot with its flippers as the centroid is stated for."""
    whole: MassProperties
    gear: Gear
    side: SideView | None
    """Underside of the main tracks; None: none of it is level, or all of it is meshes."""
    as_in_file: Mapping[str, float]
    """L, C_L, C_N and both R of tracks and flippers together, joints as in the file, by field."""
    faults: tuple[Fault, ...] = ()
    angles: Mapping[End, float] = field(default_factory=dict)
    """Angle of the flippers for which the centroid is stated, by end [rad]."""

    @property
    def notes(self) -> tuple[str, ...]:
        """What is wrong or doubtful, as sentences."""
        return said.faults(self.faults)

    def robot(self) -> Robot:
        """Data sheet.

        Raises
        ------
        InputError
            Figures that no robot has.
        """
        sheet: dict[str, Any] = {"name": self.name, "track": {}, "drive": {}, "sources": {}}
        file = PurePath(self.provenance.path).name
        for path, figure in self.figures.items():
            table, _, last = path.rpartition(".")
            (sheet.setdefault(table, {}) if table else sheet)[last] = _tidy(figure.value)
            stated = figure.how == said.STATED
            sheet["sources"][path] = f"U: {said.STATED}" if stated else f"C: {file}, {figure.how}"
        for end, angle in self.angles.items():
            sheet[f"{end}_flippers"]["stowed_angle"] = angle
        sheet["title"] = self.placed.mechanism.name[:80]
        sheet["notes"] = said.sheet_notes(file, self.provenance.digest, self.notes)
        try:
            return Robot.model_validate(sheet)
        except InputError as error:
            raise InputError(f"{short(self.provenance.path)}: {error}") from None


def _tidy(value: Any) -> Any:
    """Value as it stands in a sheet, without what is beyond any measurement."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, list):
        return [{key: _tidy(each) for key, each in table.items()} for table in value]
    return value
