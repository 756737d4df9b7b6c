"""The pose map: height of the touching centroid over its place and the inclination.

A stable pose is a valley along the inclination, the pose that a rotation must climb over a ridge.
Exact on the grid: every corner under every part, and both end discs on every segment.
"""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer, Part
from kaidan.contact import touching_heights
from kaidan.errors import InputError
from kaidan.models.planned import Planned
from kaidan.question import Question
from kaidan.traversal import Traverse
from kaidan.verbs.one_posture_report import rotations_shown
from kaidan.verbs.traverse_report import RotationShown

Array = NDArray[np.float64]

COLUMNS, ROWS = 420, 181
"""Size of the grid: places of the centroid, inclinations."""
STEPS_SHOWN = 4
"""Regular steps that are shown of a long flight."""
ARROWS = (26, 17)
"""Places and inclinations, both ends included, between which the flow is given."""
_SHORTEST = 5
"""Least number of columns that make a line."""
_NEAR = 4.0
"""Inclinations from one column to the next that still make one line, in rows of the grid."""


class Line(Part):
    """Poses in a row."""

    x_m: tuple[float, ...]
    """Centroid, along the path [m]."""
    inclination_deg: tuple[float, ...]
    """Leading end up [deg]."""


class Flow(Part):
    """Which way the robot rotates by itself, on a coarse grid, row by row."""

    x_m: tuple[float, ...]
    """Columns: centroid, along the path [m]."""
    inclination_deg: tuple[float, ...]
    """Rows: leading end up [deg]."""
    sense: tuple[tuple[int, ...], ...]
    """1 where the leading end goes up, -1 down, 0 where it rests."""
    arm_m: tuple[tuple[float, ...], ...]
    """Height of the centroid above its contact [m]: turning up by dphi moves it by -arm dphi."""


class PoseMap(Answer):
    """Heights of the centroid over all poses that touch the ground, and what was driven."""

    text_module = "kaidan.text.pose_map"

    question: Question
    """The question that was driven."""
    whole: bool
    """Whether it covers the whole path; of a long flight it covers the first steps."""
    x_m: tuple[float, ...]
    """Columns: centroid, along the path [m]."""
    inclination_deg: tuple[float, ...]
    """Rows: leading end up [deg]."""
    height_mm: tuple[tuple[float, ...], ...]
    """Height of the centroid above the lowest pose at the same place [mm], row by row."""
    stable: tuple[Line, ...]
    """Valleys: poses in which the robot rests."""
    ridges: tuple[Line, ...]
    """Ridges: beyond them it rotates on."""
    flow: Flow
    """Which way it rotates by itself, beside the poses that hold."""
    driven: tuple[Line, ...]
    """Poses of the traverse, a line between two rotations each."""
    rotations: tuple[RotationShown, ...]
    """Rotations between those lines."""


def pose_map(
    question: Question, passage: "Traverse | Planned", *, columns: int = COLUMNS, rows: int = ROWS
) -> PoseMap:
    """Pose map along a traverse, of a long flight along its first steps.

    Acceleration tilts gravity by the direction of the path; here it is taken along the slope.

    passage: in one posture; as `kaidan.verbs.traverse.driven` gives it.
    """
    if not isinstance(passage, Traverse):
        raise InputError("pose map: it is of one posture; state angles, flat or stowed")
    path = passage.path
    x, phi = _grid(passage, columns, rows)
    z, contact_x, level = touching_heights(path.ground, path.body, x, phi)
    kappa = 0.0
    if path.margins is not None and len(path.margins):
        kappa = float(np.median(path.margins.tilt))
    arm = z - level
    lever = contact_x - x + kappa * arm
    middle = np.degrees(phi[:-1] + phi[1:]) / 2
    valleys, ridges = (lever[:-1] > 0) & (lever[1:] <= 0), (lever[:-1] <= 0) & (lever[1:] > 0)
    return PoseMap(
        question=question,
        whole=bool(x[-1] >= path.x.max()),
        x_m=x,
        inclination_deg=np.degrees(phi),
        height_mm=1e3 * (z - z.min(axis=0)),
        stable=joined(x, middle, valleys),
        ridges=joined(x, middle, ridges),
        flow=_flow(x, phi, lever, arm),
        driven=_driven(passage),
        rotations=rotations_shown(passage, np.arange(len(path.poses))),
    )


def _grid(passage: Traverse, columns: int, rows: int) -> tuple[Array, Array]:
    """Places of the centroid [m] and inclinations [rad]."""
    path, nosings = passage.path, passage.profile.nosings
    left, right = float(path.x.min()), float(path.x.max())
    if len(nosings) > STEPS_SHOWN + 2:
        going = float(np.median(np.diff(nosings[:, 0])))
        reach = sum(passage.outline.reach)
        right = min(right, left + 2 * reach + (STEPS_SHOWN + 1) * going)
    room = 0.03 * (right - left) + 0.02
    low, high = float(path.inclination.min()), float(path.inclination.max())
    low, high = max(low - math.radians(20), -1.55), min(high + math.radians(30), 1.55)
    return np.linspace(left - room, right + room, columns), np.linspace(low, high, rows)


def _flow(x: Array, phi: Array, lever: Array, arm: Array) -> Flow:
    columns, rows = (
        np.linspace(0, len(axis) - 1, count).round().astype(int)[1:-1]
        for axis, count in zip((x, phi), ARROWS, strict=True)
    )
    grid = np.ix_(rows, columns)
    return Flow(
        x_m=x[columns],
        inclination_deg=np.degrees(phi[rows]),
        sense=np.sign(lever[grid]).astype(int),
        arm_m=arm[grid],
    )


def _driven(passage: Traverse) -> list[Line]:
    path = passage.path
    cuts = [0, *(np.flatnonzero(np.diff(path.poses.leg)) + 1).tolist(), len(path.poses)]
    inclination = np.degrees(path.inclination)
    return [
        Line(x_m=path.x[start:end], inclination_deg=inclination[start:end])
        for start, end in pairwise(cuts)
    ]


def joined(x: Array, inclination: Array, cells: NDArray[np.bool_]) -> list[Line]:
    """Cells of a grid joined to lines from column to column; short ones are left out."""
    most = _NEAR * float(inclination[1] - inclination[0])
    open_ends: list[list[tuple[float, float]]] = []
    done: list[list[tuple[float, float]]] = []
    for column, place in enumerate(x.tolist()):
        going = []
        for row in np.flatnonzero(cells[:, column]):
            point = (place, float(inclination[row]))
            near = [line for line in open_ends if abs(line[-1][1] - point[1]) <= most]
            line: list[tuple[float, float]] = []
            if near:
                line = min(near, key=lambda line: abs(line[-1][1] - point[1]))
                open_ends.remove(line)
            line.append(point)
            going.append(line)
        done += open_ends
        open_ends = going
    return [
        Line(x_m=[point[0] for point in line], inclination_deg=[point[1] for point in line])
        for line in (*done, *open_ends)
        if len(line) >= _SHORTEST
    ]
