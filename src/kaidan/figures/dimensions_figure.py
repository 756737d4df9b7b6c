"""The labelled drawing: L, C_L, C_N and R of a robot."""

import numpy as np
from matplotlib.figure import Figure

from kaidan.figures import style as look
from kaidan.figures.dimension_lines import dimension, label
from kaidan.figures.robot_sketch import Placed, Sketch, draw_sketch

_WIDTH, _HEIGHT = 6.0, 2.6


def dimensions_figure(name: str, sketch: Sketch) -> Figure:
    """Robot from the side with L, C_L, C_N and both R, to scale."""
    L, C_L, C_N, front, rear = sketch
    unit = (L + front + rear) / 10  # a tenth of the robot, as a length for gaps
    placed = Placed(sketch)
    ahead, down = np.array([1.0, 0.0]), np.array([0.0, -1.0])
    with look.settings():
        figure = look.blank(_HEIGHT, _WIDTH)
        axes = figure.add_axes((0.02, 0.02, 0.96, 0.86))
        axes.set_aspect("equal")
        axes.axis("off")
        axes.axhline(0.0, color=look.GREY, linewidth=0.8, zorder=1)
        draw_sketch(axes, placed)
        dimension(
            axes, placed.at(L, -unit * 1.5), placed.at(0.0, -unit * 1.5),
            f"$L$  flat underside, {1e3 * L:.0f} mm", down, 0.42 * unit,
        )  # fmt: skip
        dimension(
            axes, placed.at(C_L, -unit * 0.5), placed.at(0.0, -unit * 0.5),
            f"$C_L$  {1e3 * C_L:.0f} mm", down, 0.42 * unit,
        )  # fmt: skip
        com = np.array([placed.at(C_L), placed.at(C_L, C_N)])
        axes.plot(*com.T, color=look.BLACK, linewidth=0.8, linestyle="-.", zorder=6)
        beside = com.mean(axis=0) - 0.2 * unit * ahead
        label(axes, beside, f"$C_N$  {1e3 * C_N:.0f} mm", align="right")
        label(axes, placed.at(C_L, C_N) - 0.45 * unit * down, "$C$  centroid")
        for end, at, radius, side in (("front", 0.0, front, 1.0), ("rear", L, rear, -1.0)):
            if radius > 0:
                centre = placed.at(at, radius)
                reach = np.array([centre, centre + radius * np.array([0.77 * side, -0.64])])
                axes.plot(*reach.T, color=look.BLACK, linewidth=0.8, zorder=6)
                axes.plot(*centre, ls="", marker="+", ms=5, color=look.BLACK, zorder=6)
                text = f"$R$ {end}, {1e3 * radius:.0f} mm"
                top = placed.at(at, 2 * radius) - 0.45 * unit * down
                label(axes, top, text, align="left" if end == "front" else "right")
        tallest = max(2 * front, 2 * rear, C_N + 0.5 * unit)
        axes.set_xlim(-rear - 1.4 * unit, L + front + 1.4 * unit)
        axes.set_ylim(-2.5 * unit, tallest + 1.1 * unit)
        look.title(
            figure, 0.12, look.named(name, 60), "front on the right; lengths as in its sheet"
        )
    return figure
