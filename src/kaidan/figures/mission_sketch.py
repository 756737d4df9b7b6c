"""The sketch of a mission: the robot on the flight in its posture, steps and robot with dimensions.

Where nobody drove, the robot alone on the ground.
"""

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.figures import side_view
from kaidan.figures import style as look
from kaidan.figures.dimension_lines import dimension
from kaidan.figures.dimensions_figure import dimensions_figure
from kaidan.figures.robot_sketch import Sketch
from kaidan.figures.side_view import stand_at

if TYPE_CHECKING:
    from kaidan.assessment.answer import Assessment
    from kaidan.verbs.report.answer import Mission, PhasePosture
    from kaidan.verbs.traverse_report import PartShown, TraverseReport

_HEIGHT, _EDGE = 3.1, 0.05
"""Height of the figure, edge around it [in]."""
_STEPS = 40
"""Most nosings whose steps have dimensions: more are a profile."""


def mission_sketch(mission: "Mission") -> Figure:
    """Sketch with dimensions of a mission.

    mission: one of a `Report`.
    """
    if mission.traverse is None:
        return _robot_alone(mission.assessment)
    found = mission.traverse
    row = _row(found)
    with look.settings():
        figure = look.blank(_HEIGHT)
        width = look.WIDTH - 2 * _EDGE
        axes = figure.add_axes(
            (
                _EDGE / look.WIDTH,
                _EDGE / _HEIGHT,
                width / look.WIDTH,
                (_HEIGHT - 2 * _EDGE) / _HEIGHT,
            )
        )
        axes.set_aspect("equal", adjustable="box")
        axes.set_axis_off()
        _frame(axes, found, row, width / (_HEIGHT - 2 * _EDGE))
        side_view.draw_ground(axes, found.profile)
        stand = stand_at(found, row)
        side_view.draw_robot(axes, found.outline_at(row), stand, "strong")
        side_view.draw_centroid(axes, stand, 6.0)
        _draw_steps(axes, found, row)
        _draw_length(axes, found, row)
        _draw_angles(axes, found, row, mission.card.postures)
    return figure


def _row(found: "TraverseReport") -> int:
    """Pose on the flight alone, half through it; the one that decides where there is none."""
    rows = [row for row, phase in enumerate(found.poses.phase) if phase == "traverse"]
    return rows[len(rows) // 2] if rows else found.poses.governing_row


def _frame(axes: Axes, found: "TraverseReport", row: int, shape: float) -> None:
    """Limits: the robot, and a step beyond each end of it."""
    body = side_view.around(found.outline_at(row), stand_at(found, row))
    (left, low), (right, high) = body.min(axis=0), body.max(axis=0)
    room = 0.3 * (right - left)
    left, right, low, high = left - room, right + room, low - 0.8 * room, high + 0.7 * room
    wide = max(right - left, shape * (high - low))
    tall = wide / shape
    middle = (left + right) / 2
    axes.set_xlim(middle - wide / 2, middle + wide / 2)
    axes.set_ylim((low + high - tall) / 2, (low + high + tall) / 2)


def _draw_steps(axes: Axes, found: "TraverseReport", row: int) -> None:
    """Rise, going and nosing spacing of a step in sight, and the slope."""
    nosings = np.array(found.profile.nosings_m)
    if not 2 <= len(nosings) <= _STEPS:
        return
    nosings = nosings[np.argsort(nosings[:, 1])]
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    seen = [
        each
        for each in range(len(nosings) - 1)
        if all(
            left < nosings[k, 0] < right and bottom + 0.2 * (top - bottom) < nosings[k, 1] < top
            for k in (each, each + 1)
        )
    ]
    if not seen:
        return
    lower, upper = nosings[seen[0]], nosings[seen[0] + 1]
    gap = 0.04 * (right - left)
    inward = 1.0 if upper[0] > lower[0] else -1.0
    corner = np.array([upper[0] + 0.9 * gap * inward, lower[1]])
    dimension(
        axes, corner, np.array([corner[0], upper[1]]),
        f"{1e3 * (upper[1] - lower[1]):.0f} mm", np.array([inward, 0.0]), 1.3 * gap,
    )  # fmt: skip
    below = lower[1] - 0.9 * gap
    dimension(
        axes, np.array([lower[0], below]), np.array([upper[0], below]),
        f"{1e3 * abs(upper[0] - lower[0]):.0f} mm", np.array([0.0, -1.0]), 0.6 * gap,
    )  # fmt: skip
    slope, p = found.assessment.angle_deg, found.assessment.nosing_spacing_m
    if slope is not None and p is not None:
        axes.text(
            0.99, 0.03, f"{slope:.1f}°, {1e3 * p:.0f} mm from nosing to nosing",
            transform=axes.transAxes, ha="right", va="bottom", fontsize=9.0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5}, zorder=10,
        )  # fmt: skip


def _draw_length(axes: Axes, found: "TraverseReport", row: int) -> None:
    """Length of the robot in this posture, along it, and its centroid over the underside."""
    stand, outline = stand_at(found, row), found.outline_at(row)
    points = np.concatenate([side_view.hull(each) for each in outline])
    (back, _), (ahead, top) = points.min(axis=0), points.max(axis=0)
    gap = 0.05 * (ahead - back)
    line = np.array([[back, top + gap], [ahead, top + gap]])
    start, end = side_view.placed(line, stand)
    normal = np.array([-math.sin(stand.phi), math.cos(stand.phi)])
    dimension(axes, start, end, f"{1e3 * (ahead - back):.0f} mm", normal, 1.6 * gap)
    axes.annotate(
        f"centroid {1e3 * found.assessment.com_height_m:.0f} mm up",
        (stand.x, stand.z), (7.0, -9.0), textcoords="offset points", va="top", fontsize=9.0,
        zorder=11, bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.85},
    )  # fmt: skip


def _draw_angles(
    axes: Axes, found: "TraverseReport", row: int, postures: "tuple[PhasePosture, ...]"
) -> None:
    """Angle of each flipper at its tip."""
    phase = found.poses.phase[row]
    order = ("enter", "traverse", "land")
    held = [each for each in postures if order.index(each.phase) <= order.index(phase)]
    if not held:
        return
    stand = stand_at(found, row)
    flippers = [each for each in found.outline_at(row) if each.kind == "flipper"]
    nose_ahead = 1.0 if found.leading == "nose" else -1.0
    for name, angle, side in (
        ("front", held[-1].front_deg, nose_ahead),
        ("rear", held[-1].rear_deg, -nose_ahead),
    ):
        own = [each for each in flippers if side * (each.x_1_m + each.x_2_m) > 0]
        if angle is None or not own:
            continue
        tip = _tip(own, side)
        ((x, z),) = side_view.placed(np.array([tip]), stand)
        axes.annotate(
            f"{name} {look.signed(angle, 0)}°", (x, z), (side * 10.0, -2.0),
            textcoords="offset points", ha="left" if side > 0 else "right", va="center",
            fontsize=9.0, weight="bold", zorder=11,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.85},
        )  # fmt: skip


def _tip(flippers: "list[PartShown]", side: float) -> tuple[float, float]:
    """Point of a flipper farthest from the robot's middle, in the body frame [m]."""
    ends = [
        (x, z, radius)
        for each in flippers
        for x, z, radius in (
            (each.x_1_m, each.z_1_m, each.radius_1_m),
            (each.x_2_m, each.z_2_m, each.radius_2_m),
        )
    ]
    x, z, radius = max(ends, key=lambda end: side * end[0])
    return x + side * radius, z


def _robot_alone(answer: "Assessment") -> Figure:
    track = answer.question.robot.track
    return dimensions_figure(
        answer.question.robot.name,
        Sketch(
            answer.flat_length_m,
            answer.com_from_front_m,
            answer.com_height_m,
            track.front_radius,
            track.rear_radius,
        ),
    )
