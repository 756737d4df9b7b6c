"""A robot of a file as part of an answer: its figures, where each is from, and its side view."""

from typing import Any

import numpy as np

from kaidan.answer import Part
from kaidan.readers.robots.estimate import RobotEstimate
from kaidan.readers.robots.hull import outline_of
from kaidan.readers.robots.side_view import SideView
from kaidan.readers.robots.silhouette import Piece, pieces_of
from kaidan.robot import Robot
from kaidan.sheet import bounds, table_of

Outline = tuple[tuple[float, float], ...]


class FigureRead(Part):
    """A figure of the sheet, to be confirmed or replaced."""

    field: str
    """Its place in the sheet, which --override takes: com_height, track.front_radius."""
    value: float | None
    """In its unit; null where it is no single number."""
    unit: str
    """SI unit; "1" of a pure number; empty where it is none."""
    shown: str
    """Value as people write it."""
    how: str
    """Where it is from."""


class RobotView(Part):
    """The robot from the side for a picture: x forward from the front end of the flat run, z up."""

    tracks: tuple[Outline, ...]
    """Points around each shape of the tracks [m]."""
    flippers: tuple[Outline, ...]
    """Around those of the flippers, at the angle that the centroid is stated for [m]."""
    body: tuple[Outline, ...]
    """Around those of the body [m]."""


class RobotRead(Part):
    """A robot of a file."""

    name: str
    title: str
    """Name in the file."""
    figures: tuple[FigureRead, ...]
    """Figures of the sheet."""
    as_in_file: dict[str, float]
    """L, C_L, C_N, both R of tracks and flippers together, joints as in the file [m]; empty without
    flippers."""
    joints: dict[str, tuple[float | None, float | None]]
    """Joints that can be stated, with their limits [rad or m]; null: none."""
    notes: tuple[str, ...]
    """What is wrong or doubtful."""
    sheet: Robot
    """Data sheet."""
    view: RobotView | None
    """Picture; null: no flat run was found."""


def robot_read(found: RobotEstimate) -> RobotRead:
    """Robot that was found, as part of an answer."""
    from kaidan.tables import human

    figures = []
    for field, figure in found.figures.items():
        unit = _unit(field)
        single = isinstance(figure.value, float | int)
        figures.append(
            FigureRead(
                field=field,
                value=float(figure.value) if single else None,
                unit=unit,
                shown=human(figure.value, unit=unit) if single else _shown(figure.value),
                how=figure.how,
            )
        )
    return RobotRead(
        name=found.name,
        title=found.placed.mechanism.name,
        figures=tuple(figures),
        as_in_file=dict(found.as_in_file),
        joints={name: joint.limits for name, joint in found.placed.mechanism.moving.items()},
        notes=found.notes,
        sheet=found.robot(),
        view=None if found.side is None else _view(found.side, found),
    )


def _unit(field: str) -> str:
    """Unit of a field of the sheet; empty where it is no quantity."""
    *path, last = field.split(".")
    place: Any = Robot
    for part in path:
        place = table_of(place.model_fields[part])
    return bounds(place.model_fields[last])[0] or ""


def _shown(value: Any) -> str:
    """Wheels, and whatever else is no number, as people write it."""
    if not isinstance(value, list):
        return str(value)
    return "; ".join(
        f"{1e3 * each['from_front']:.0f} behind, {1e3 * each['height']:.0f} up, "
        f"R {1e3 * each['radius']:.0f} mm"
        for each in value
    )


def _view(side: SideView, found: RobotEstimate) -> RobotView:
    """Shapes by the distance before the front end of the flat run, and the height above it."""
    gear, placed = found.gear, found.placed
    moved = [name for pair in gear.flippers.values() for one in pair for name in one.links]

    def outlines(pieces: tuple[Piece, ...]) -> tuple[Outline, ...]:
        made = []
        for piece in pieces:
            behind, height, radius = side.above(piece.discs).T
            points = outline_of(np.column_stack([-behind, height, radius]))
            made.append(tuple((float(x), float(z)) for x, z in points.round(4)))
        return tuple(made)

    return RobotView(
        tracks=outlines((*gear.main, *gear.grousers)),
        flippers=outlines(pieces_of(placed, moved)),
        body=outlines(gear.rest),
    )
