"""How a robot is weighed and tilted for its centroid, drawn in three pictures."""

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Rectangle

from kaidan.figures import style as look
from kaidan.figures.dimension_lines import dimension, label
from kaidan.figures.robot_sketch import EXAMPLE, Placed, Sketch, draw_sketch

if TYPE_CHECKING:
    from kaidan.verbs.measure_robot import RobotMeasurement

_HEIGHT = 3.1
_SLOPE = math.radians(20.0)


def weighing_figure(found: "RobotMeasurement | None" = None) -> Figure:
    """Procedure of `kaidan measure robot`: level, on a slope, and tipped; with what was stated.

    found: whose figures are drawn; without one the procedure of any robot.
    """
    sketch = EXAMPLE if found is None else _sketch(found)
    at = {} if found is None else found.inputs
    name = "How to find L, C_L and C_N" if found is None else f"{look.named(found.name)}: measured"
    with look.settings():
        figure = look.blank(_HEIGHT)
        look.title(figure, 0.12, name, "Flippers stowed. One of the two bars rolls freely.")
        draws = (_level, _slope, _tipped)
        for index, draw in enumerate(draws):
            axes = figure.add_axes((0.01 + index * 0.33, 0.02, 0.32, 0.82))
            axes.set_aspect("equal")
            axes.axis("off")
            draw(axes, sketch, at)
    return figure


def _sketch(found: "RobotMeasurement") -> Sketch:
    L = found.flat_length.value
    height = EXAMPLE.com_height * L / EXAMPLE.flat_length
    front, rear = (L * 0.15 if each is None else each for each in found.radii_m)
    return Sketch(
        L, found.com_from_front.value,
        height if found.com_height is None else found.com_height.value, front, rear,
    )  # fmt: skip


def _unit(sketch: Sketch) -> float:
    return (sketch.flat_length + sketch.front_radius + sketch.rear_radius) / 10


def _view(axes: Axes, sketch: Sketch, head: str, foot: str) -> None:
    unit, tall = _unit(sketch), 2 * max(sketch.front_radius, sketch.rear_radius, sketch.com_height)
    middle = sketch.flat_length / 2
    axes.set_xlim(middle - 7.2 * unit, middle + 7.2 * unit)
    axes.set_ylim(-4.6 * unit, max(tall, 6.0 * unit) + 4.2 * unit)
    axes.set_title(head, fontsize=9.0, weight="bold", y=0.96)
    axes.text(middle, -4.4 * unit, foot, ha="center", va="bottom", fontsize=look.SMALL)


def _scale(axes: Axes, sketch: Sketch, top: look.Array, text: str, floor: float) -> None:
    """Bar on a scale below a point of the flat, on blocks down to the floor."""
    unit = _unit(sketch)
    bar, thick = 0.22 * unit, 0.45 * unit
    x, z = float(top[0]), float(top[1])
    axes.add_patch(Circle((x, z - bar), bar, facecolor=look.PALE, edgecolor=look.BLACK, zorder=2))
    low = z - 2 * bar - thick
    axes.add_patch(
        Rectangle((x - 1.1 * unit, low), 2.2 * unit, thick, facecolor="#f6e6b8",
                  edgecolor=look.BLACK, linewidth=0.8, zorder=2)
    )  # fmt: skip
    if low - floor > 0.05 * unit:
        axes.add_patch(
            Rectangle((x - 0.8 * unit, floor), 1.6 * unit, low - floor, facecolor=look.PALE,
                      edgecolor=look.GREY, linewidth=0.6, hatch="///", zorder=1)
        )  # fmt: skip
    label(axes, np.array([x, floor - 0.55 * unit]), text)


def _mass(at: dict[str, float], key: str, name: str) -> str:
    return f"{name}\n{at[key]:.2f} kg" if key in at else name


def _floor(axes: Axes, sketch: Sketch, at: float) -> None:
    middle, unit = sketch.flat_length / 2, _unit(sketch)
    axes.plot([middle - 6.8 * unit, middle + 6.8 * unit], [at, at], color=look.GREY, linewidth=1.0)


def _plumb(axes: Axes, placed: Placed) -> None:
    """Plumb line of the centroid, from it down past the flat."""
    com = placed.at(placed.sketch.com_from_front, placed.sketch.com_height)
    unit = _unit(placed.sketch)
    axes.plot(
        [com[0], com[0]], [com[1], placed.z - 1.3 * unit],
        color=look.VERMILION, linewidth=0.9, linestyle="-.", zorder=6,
    )  # fmt: skip


def _level(axes: Axes, sketch: Sketch, at: dict[str, float]) -> None:
    unit, placed = _unit(sketch), Placed(sketch)
    floor = -0.89 * unit
    _floor(axes, sketch, floor)
    draw_sketch(axes, placed)
    _plumb(axes, placed)
    L = sketch.flat_length
    if "balance" in at:
        foot = f"balance point {1e3 * at['balance']:.0f} mm\nbehind the front tip"
        axes.plot(*placed.at(at["balance"], -0.1 * unit), ls="", marker="^", ms=8, color=look.BLACK)
    else:
        front, rear = at.get("front_inset", 0.0), at.get("rear_inset", 0.0)
        _scale(axes, sketch, placed.at(front), _mass(at, "front_scale", "front"), floor)
        _scale(axes, sketch, placed.at(L - rear), _mass(at, "rear_scale", "rear"), floor)
        foot = "$C_L$ = $L$ x rear / (front + rear)\nor push it over an edge: it balances at $C_L$"
    up = np.array([0.0, 1.0])
    top = 2 * max(sketch.front_radius, sketch.rear_radius) + 0.7 * unit
    dimension(
        axes, placed.at(sketch.com_from_front, top), placed.at(0.0, top), "$C_L$", up, 0.5 * unit
    )
    dimension(
        axes,
        placed.at(L, top + 1.2 * unit),
        placed.at(0.0, top + 1.2 * unit),
        "$L$",
        up,
        0.5 * unit,
    )
    _view(axes, sketch, "1  level", foot)


def _slope(axes: Axes, sketch: Sketch, at: dict[str, float]) -> None:
    unit, phi = _unit(sketch), at.get("slope", _SLOPE)
    rise = min(0.0, sketch.flat_length * math.sin(phi))
    placed = Placed(sketch, z=-rise, phi=phi)
    floor = -0.89 * unit
    _floor(axes, sketch, floor)
    draw_sketch(axes, placed)
    _plumb(axes, placed)
    front, rear = at.get("front_inset", 0.0), at.get("rear_inset", 0.0)
    L = sketch.flat_length
    _scale(axes, sketch, placed.at(front), _mass(at, "front_on_slope", "front"), floor)
    _scale(axes, sketch, placed.at(L - rear), _mass(at, "rear_on_slope", "rear"), floor)
    _angle(axes, placed.at(L), unit, phi)
    foot = "nose up: the plumb line meets the flat\n$C_N$ tan $\\varphi$ further back than level"
    _view(axes, sketch, "2  on a slope, scales level", foot)


def _angle(axes: Axes, corner: look.Array, unit: float, phi: float) -> None:
    low, high = sorted((0.0, math.degrees(phi)))
    axes.add_patch(
        Arc(tuple(corner), 9.4 * unit, 9.4 * unit, theta1=low, theta2=high, linewidth=0.9, zorder=6)
    )
    level = np.array([corner, corner + np.array([5.4 * unit, 0.0])])
    axes.plot(*level.T, color=look.GREY, linewidth=0.7, linestyle=":", zorder=2)
    label(
        axes, corner + np.array([3.0 * unit, -0.5 * unit]), f"$\\varphi$ = {math.degrees(phi):.0f}°"
    )


def _tipped(axes: Axes, sketch: Sketch, at: dict[str, float]) -> None:
    unit, L, rear = _unit(sketch), sketch.flat_length, sketch.rear_radius
    arm, height = L - sketch.com_from_front, sketch.com_height - rear
    phi = math.atan2(arm, height)
    # the centre of the rear disc stands above its contact with the floor
    floor = -0.89 * unit
    centre = np.array([L / 2, floor + rear])
    tip = centre - rear * np.array([-math.sin(phi), math.cos(phi)])
    placed = Placed(sketch, x=float(tip[0]), z=float(tip[1]), phi=phi)
    _floor(axes, sketch, floor)
    draw_sketch(axes, placed)
    com = placed.at(sketch.com_from_front, sketch.com_height)
    axes.plot(
        [com[0], com[0]], [com[1], floor], color=look.VERMILION, linewidth=0.9, linestyle="-.",
        zorder=6,
    )  # fmt: skip
    stated = f", {math.degrees(at['tips_at']):.0f}°" if "tips_at" in at else ""
    foot = (
        f"balanced on its rear end{stated}:\n"
        "$C_N = R + (L - C_L)\\,/\\,\\tan\\varphi$"
    )  # fmt: skip
    _view(axes, sketch, "or: up on one end", foot)
