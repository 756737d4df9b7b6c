"""Robot and stairs seen from the side: ground, outline in a pose, forces, lines of gravity."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outlined

from kaidan.figures import style as look

if TYPE_CHECKING:
    from kaidan.verbs.traverse_report import (
        ForceShown,
        PartShown,
        Placement,
        ProfileShown,
        TraverseReport,
    )

    Outline = Sequence[PartShown]

_ROUND = np.linspace(0.0, 2 * math.pi, 97)

STYLES: dict[str, dict[str, Any]] = {
    "ghost": {"facecolor": "#f4f4f4", "edgecolor": look.GREY, "linewidth": 0.7, "zorder": 3},
    "strong": {"facecolor": "#b9d6ea", "edgecolor": look.BLACK, "linewidth": 1.0, "zorder": 5},
    "after": {
        "facecolor": "none",
        "edgecolor": look.VERMILION,
        "linewidth": 0.9,
        "linestyle": (0, (4, 2)),
        "zorder": 4,
    },
}
"""How a robot is drawn: in passing, at the pose that decides, after a rotation."""


class Stand(NamedTuple):
    """Where the robot is: centroid [m] and inclination, leading end up [rad]."""

    x: float
    z: float
    phi: float


def stand_of(placement: "Placement") -> Stand:
    """Stand of a placement."""
    return Stand(placement.x_m, placement.z_m, math.radians(placement.inclination_deg))


def stand_at(found: "TraverseReport", row: int) -> Stand:
    """Stand at a pose."""
    poses = found.poses
    return Stand(poses.x_m[row], poses.z_m[row], math.radians(poses.inclination_deg[row]))


def reach(outline: "Outline") -> tuple[float, float]:
    """Distances from the centroid to the ends of the robot behind it and ahead of it [m]."""
    across = [hull(part)[:, 0] for part in outline]
    return -float(min(x.min() for x in across)), float(max(x.max() for x in across))


def hull(part: "PartShown") -> look.Array:
    """Outline of the convex hull of two discs, shape (k, 2) [m]."""
    x_1, z_1, r_1 = part.x_1_m, part.z_1_m, part.radius_1_m
    x_2, z_2, r_2 = part.x_2_m, part.z_2_m, part.radius_2_m
    c, s = np.cos(_ROUND), np.sin(_ROUND)
    first = x_1 * c + z_1 * s + r_1 >= x_2 * c + z_2 * s + r_2
    return np.column_stack(
        [
            np.where(first, x_1 + r_1 * c, x_2 + r_2 * c),
            np.where(first, z_1 + r_1 * s, z_2 + r_2 * s),
        ]
    )


def placed(points: look.Array, stand: Stand) -> look.Array:
    """Points of the body frame in the world."""
    c, s = math.cos(stand.phi), math.sin(stand.phi)
    x, z = points[:, 0], points[:, 1]
    return np.column_stack([stand.x + c * x - s * z, stand.z + s * x + c * z])


def around(outline: "Outline", stand: Stand) -> look.Array:
    """All points of the robot's outline at a pose, shape (k, 2) [m]."""
    return np.concatenate([placed(hull(part), stand) for part in outline])


def draw_ground(axes: Axes, profile: "ProfileShown") -> None:
    """Terrain down to the lower edge of axes whose limits are set, continued to both sides."""
    points, nosings = np.array(profile.points_m), np.array(profile.nosings_m)
    (left, right), bottom = axes.get_xlim(), axes.get_ylim()[0]
    x = np.concatenate([[min(left, points[0, 0])], points[:, 0], [max(right, points[-1, 0])]])
    z = np.concatenate([points[:1, 1], points[:, 1], points[-1:, 1]])
    low = min(bottom, float(z.min())) - 1.0
    axes.fill(
        np.concatenate([x, [x[-1], x[0]]]),
        np.concatenate([z, [low, low]]),
        facecolor="#efefef",
        edgecolor="#cdcdcd",
        hatch="////",
        linewidth=0.0,
        zorder=1,
    )
    axes.plot(x, z, color=look.BLACK, linewidth=0.9, zorder=2, solid_joinstyle="miter")
    if 0 < len(nosings) <= 60:
        axes.plot(
            nosings[:, 0], nosings[:, 1], ls="", marker=".", ms=3.5, color=look.BLACK, zorder=2.5
        )


def draw_robot(axes: Axes, outline: "Outline", stand: Stand, style: str) -> list[PathPatch]:
    """Outline of the robot at a pose."""
    look_of, patches = STYLES[style], []
    for part in drawn_parts(outline):
        shape = PathPatch(Outlined(placed(hull(part), stand)), **look_of)
        if part.kind == "flipper" and style == "strong":
            shape.set_facecolor("#dcebf5")
        patches.append(shape)
        axes.add_patch(shape)
    return patches


def drawn_parts(outline: "Outline") -> "list[PartShown]":
    """Parts that are drawn, in their order: flippers over the track, the belly not at all."""
    return sorted(
        (part for part in outline if part.kind != "belly"), key=lambda part: part.kind == "flipper"
    )


def draw_centroid(axes: Axes, stand: Stand, size: float = 4.0) -> None:
    """Centroid as a ring with a dot."""
    for marker, width in (("o", size), (".", size / 2.2)):
        axes.plot(
            stand.x,
            stand.z,
            ls="",
            marker=marker,
            ms=width,
            mfc="white" if marker == "o" else look.BLACK,
            mec=look.BLACK,
            mew=0.8,
            zorder=8,
        )


def draw_forces(
    axes: Axes, stand: Stand, forces: "Sequence[ForceShown]", kappa: float, scale: float
) -> None:
    """Contact points, forces that carry, weight and gravity line of a pose.

    kappa: tilt of effective gravity [1].
    scale: length of an arrow for a force of once the weight [m].
    """
    bottom, top = axes.get_ylim()
    axes.plot(
        [stand.x - kappa * (bottom - stand.z), stand.x - kappa * (top - stand.z)],
        [bottom, top],
        color=look.BLACK,
        linewidth=0.7,
        linestyle=(0, (6, 2, 1, 2)),
        zorder=6,
    )
    pull = scale * math.hypot(1.0, kappa)
    tip = (stand.x + scale * kappa, stand.z - scale)
    _arrow(axes, (stand.x, stand.z), tip, look.BLACK, pull)
    for force in forces:
        start, load, traction = (
            (force.x_m, force.z_m),
            force.load_over_weight,
            force.traction_over_weight,
        )
        axes.plot(*start, ls="", marker="o", ms=3.2, color=look.VERMILION, zorder=9)
        if not load or traction is None:
            continue
        f_x = scale * (load * force.normal_x + traction * force.normal_z)
        f_z = scale * (load * force.normal_z - traction * force.normal_x)
        end = (start[0] + f_x, start[1] + f_z)
        _arrow(axes, start, end, look.VERMILION, math.hypot(f_x, f_z))


def _arrow(
    axes: Axes, start: tuple[float, float], end: tuple[float, float], color: str, length: float
) -> None:
    if length < 1e-9:
        return
    axes.annotate(
        "",
        xy=end,
        xytext=start,
        arrowprops={
            "arrowstyle": "-|>,head_width=0.16,head_length=0.32",
            "color": color,
            "linewidth": 1.3,
            "shrinkA": 0.0,
            "shrinkB": 0.0,
        },
        zorder=9,
    )
