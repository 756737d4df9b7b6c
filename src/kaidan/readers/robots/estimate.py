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

DOUBTFUL = frozenset(("no-mass", "zero-mass", "mesh-mass", "apart", "off-middle", "outside"))
"""Faults that make the masses of a file doubtful."""
_ALONG, _LEAST_ALONG, _UP = 0.03, 0.015, 0.1
"""Half of the range of a doubtful centroid: share of L, metres at least, share of C_N. Two public
models of one robot, the HD2, differ by 14 mm in C_L and by a tenth in C_N (data of the catalogue:
superdroid-hd2 and marmotte)."""


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
    def doubt(self) -> tuple[float, float] | None:
        """Half of the range of a centroid that is doubtful, of C_L and C_N [m]; None: it is not."""
        along, up = (self.figures[key] for key in ("com_from_front", "com_height"))
        if along.how == up.how == said.STATED or not any(
            fault.kind in DOUBTFUL for fault in self.faults
        ):
            return None
        length = self.figures["track.flat_length"].value
        return max(_ALONG * length, _LEAST_ALONG), _UP * up.value

    @property
    def notes(self) -> tuple[str, ...]:
        """What is wrong or doubtful, as sentences."""
        return said.faults((*self.faults, *self._range()))

    def _range(self) -> tuple[Fault, ...]:
        if self.doubt is None:
            return ()
        along, up = self.doubt
        return (Fault("range", numbers={"along_mm": 1e3 * along, "height_mm": 1e3 * up}),)

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
        if self.doubt is not None:
            sheet["com_range"] = {
                key: (sheet[f"com_{key}"] - half, sheet[f"com_{key}"] + half)
                for key, half in zip(("from_front", "height"), self.doubt, strict=True)
            }
        sheet["title"] = self.placed.mechanism.name[:80]
        left = [fault for fault in self.faults if fault.kind not in said.KEPT]
        notes = said.faults((*left, *self._range()))
        sheet["notes"] = said.sheet_notes(file, self.provenance.digest, notes)
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
