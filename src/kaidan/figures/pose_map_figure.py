"""Picture of a pose map: valleys, ridges, which way the robot rotates, the driven path."""

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from kaidan.figures import style as look
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.verbs.pose_map import PoseMap

_HEIGHT = 4.9
_LEVELS = [0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0]
_SHADES = LinearSegmentedColormap.from_list("height", ["#ffffff", "#cfe0ec", "#7da7c4", "#3c5a74"])


def pose_map_figure(found: "PoseMap") -> Figure:
    """Height above the lowest pose over place and inclination, with the flow of a rotation."""
    with look.settings():
        figure = look.blank(_HEIGHT)
        left, right, foot, top = 0.62, 1.0, 0.72, 0.5
        bottom, tall = foot / _HEIGHT, 1 - (foot + top) / _HEIGHT
        axes = figure.add_axes((left / look.WIDTH, bottom, 1 - (left + right) / look.WIDTH, tall))
        shades = axes.contourf(
            found.x_m,
            found.inclination_deg,
            np.minimum(found.height_mm, _LEVELS[-1] * 0.999),
            levels=_LEVELS,
            cmap=_SHADES,
            norm=BoundaryNorm(_LEVELS, _SHADES.N),
            zorder=1,
        )
        axes.set_xlim(found.x_m[0], found.x_m[-1])
        axes.set_ylim(found.inclination_deg[0], found.inclination_deg[-1])
        _draw_flow(axes, found)
        _draw_lines(axes, found)
        _draw_path(axes, found)
        box = (1 - (right - 0.12) / look.WIDTH, bottom, 0.14 / look.WIDTH, tall)
        bar = figure.colorbar(shades, cax=figure.add_axes(box), spacing="uniform")
        bar.set_ticks(_LEVELS, labels=[f"{level:g}" for level in _LEVELS])
        bar.set_label("centroid above the lowest pose there [mm]")
        axes.set_xlabel("centroid along the path [m]")
        leading = "nose" if found.question.facing == "nose-first" else "tail"
        axes.set_ylabel(f"inclination, {leading} up [°]")
        _draw_legend(figure, left)
        part = "" if found.whole else ", the first steps"
        look.title(
            figure,
            left,
            f"{look.named(subject(found.question), 80)}: pose map{part}",
            "rotating about its contact moves the centroid too, so the arrows lean",
        )
    return figure


def _draw_flow(axes: Axes, found: "PoseMap") -> None:
    """Arrows along which the robot rotates about its contact if nothing holds it."""
    flow = found.flow
    (x_0, x_1), (y_0, y_1) = axes.get_xlim(), axes.get_ylim()
    width, height = look.size_of(axes)
    sense = np.array(flow.sense)
    d_x = -np.array(flow.arm_m) * sense * width / (x_1 - x_0)
    d_y = math.degrees(1.0) * sense * height / (y_1 - y_0)
    size = np.hypot(d_x, d_y)
    size[size == 0] = 1.0
    axes.quiver(
        flow.x_m,
        flow.inclination_deg,
        d_x / size,
        d_y / size,
        color=look.GREY,
        angles="uv",
        units="inches",
        width=0.011,
        scale=1 / 0.17,
        scale_units="inches",
        pivot="mid",
        headwidth=3.6,
        headlength=4.0,
        headaxislength=3.6,
        zorder=3,
    )


def _draw_lines(axes: Axes, found: "PoseMap") -> None:
    """Valleys and ridges."""
    for line in found.ridges:
        axes.plot(line.x_m, line.inclination_deg, color=look.VERMILION, linestyle=(0, (4, 2)),
                  linewidth=1.1, zorder=7)  # fmt: skip
    for line in found.stable:
        axes.plot(line.x_m, line.inclination_deg, color=look.BLACK, linewidth=1.1, zorder=7)


def _draw_path(axes: Axes, found: "PoseMap") -> None:
    """Driven lines of poses, thick, and the rotations between them, dashed."""
    for line in found.driven:
        axes.plot(
            line.x_m, line.inclination_deg, color=look.BLUE, linewidth=2.4, zorder=5, alpha=0.9
        )
    for rotation in found.rotations:
        start, end = rotation.placements[0], rotation.placements[-1]
        to = (end.x_m, end.inclination_deg)
        if not rotation.arrested:
            up = 1.0 if rotation.leading_end == "up" else -1.0
            to = (start.x_m, start.inclination_deg + 15.0 * up)
        axes.annotate(
            "",
            xy=to,
            xytext=(start.x_m, start.inclination_deg),
            arrowprops={
                "arrowstyle": "-|>,head_width=0.2,head_length=0.4",
                "color": look.BLUE,
                "linewidth": 1.2,
                "linestyle": (0, (2, 1)),
                "shrinkA": 0.0,
                "shrinkB": 0.0,
            },
            annotation_clip=True,
            zorder=6,
        )


def _draw_legend(figure: Figure, left: float) -> None:
    handles = [
        Line2D([], [], color=look.BLACK, linewidth=1.1),
        Line2D([], [], color=look.VERMILION, linewidth=1.1, linestyle=(0, (4, 2))),
        Line2D([], [], color=look.BLUE, linewidth=2.4),
        Line2D([], [], color=look.GREY, marker=r"$\rightarrow$", ms=9, ls=""),
    ]
    texts = ["stable poses", "ridges: beyond them it rotates on", "driven", "rotates by itself"]
    figure.legend(
        handles,
        texts,
        loc="lower left",
        bbox_to_anchor=(left / look.WIDTH, 0.08 / _HEIGHT),
        ncols=4,
        frameon=False,
        borderpad=0.0,
        borderaxespad=0.0,
        columnspacing=1.4,
        handlelength=2.2,
    )
