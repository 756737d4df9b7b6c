"""Robot and stairs seen from the side: ground, outline in a pose, forces, lines of gravity."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outlined

from kaidan.contact import BELLY, FLIPPER
from kaidan.outline import Outline
from kaidan.report import look
from kaidan.report.journey import Force

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
"""How a robot is drawn: in passing, at the pose that decides, after a swing."""


class Stand(NamedTuple):
    """Where the robot is: centroid [m] and inclination, leading end up [rad]."""

    x: float
    z: float
    phi: float


def hull(part: look.Array) -> look.Array:
    """Outline of the convex hull of two discs, shape (k, 2) [m]."""
    x_1, z_1, r_1, x_2, z_2, r_2 = part.tolist()
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


def around(outline: Outline, stand: Stand) -> look.Array:
    """All points of the robot's outline at a pose, shape (k, 2) [m]."""
    return np.concatenate([placed(hull(part), stand) for part in outline.parts])


def draw_ground(axes: Axes, points: look.Array, nosings: look.Array) -> None:
    """Terrain down to the lower edge of axes whose limits are set, continued to both sides."""
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


def draw_robot(axes: Axes, outline: Outline, stand: Stand, style: str) -> list[PathPatch]:
    """Outline of the robot at a pose."""
    look_of, patches = STYLES[style], []
    order = sorted(range(len(outline.parts)), key=lambda k: outline.kinds[k] == FLIPPER)
    for k in order:
        if outline.kinds[k] == BELLY:
            continue
        shape = PathPatch(Outlined(placed(hull(outline.parts[k]), stand)), **look_of)
        if outline.kinds[k] == FLIPPER and style == "strong":
            shape.set_facecolor("#dcebf5")
        patches.append(shape)
        axes.add_patch(shape)
    return patches


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
    axes: Axes, stand: Stand, forces: Sequence[Force], kappa: float, scale: float
) -> None:
    """Contact points, forces that carry, weight and gravity line of a pose.

    Parameters
    ----------
    axes : Axes
        Of final limits.
    stand : Stand
        Pose.
    forces : sequence of Force
        Contacts.
    kappa : float
        Tilt of effective gravity [1].
    scale : float
        Length of an arrow for a force of once the weight [m].
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
        axes.plot(*force.point, ls="", marker="o", ms=3.2, color=look.VERMILION, zorder=9)
        if not math.isfinite(force.load) or force.load == 0.0:
            continue
        f_x, f_z = (scale * component / 9.80665 for component in force.vector)
        end = (force.point[0] + f_x, force.point[1] + f_z)
        _arrow(axes, force.point, end, look.VERMILION, math.hypot(f_x, f_z))


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
