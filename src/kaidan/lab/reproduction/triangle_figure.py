"""Picture of the triangle of Eqs. (19)-(23) in state C (the paper's Fig. 10), to scale."""

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, FancyBboxPatch
from matplotlib.transforms import Affine2D

from kaidan.figures import style as look
from kaidan.figures.dimension_lines import dimension, label

if TYPE_CHECKING:
    from kaidan.lab.reproduction.reproduction import StateC

_HEIGHT = 4.9


def triangle_figure(at: "StateC") -> Figure:
    """Side view of the robot in state C with the symbols of Eqs. (19)-(23), and their values."""
    with look.settings():
        figure = look.blank(_HEIGHT)
        axes = figure.add_axes((0.02, 0.02, 0.62, 0.88))
        axes.set_aspect("equal")
        axes.axis("off")
        _draw(axes, at)
        look.title(
            figure,
            0.15,
            f"State C on the steepest slope, $p$ = {1e3 * at.p:.0f} mm",
            "the lowest contact $t_0$ has just left; $t_1$ carries",
        )
        _values(figure, at)
    return figure


class _Frame(NamedTuple):
    """The robot's frame on the slope: from its front tip along the underside, and normal to it."""

    up: look.Array
    normal: look.Array
    contacts: list[float]
    """Behind the front tip, from the lowest, which has left, to the highest [m]."""

    def place(self, s: float, z: float = 0.0) -> look.Array:
        """Point ``s`` behind the front tip and ``z`` above the underside."""
        return -s * self.up + z * self.normal


def _draw(axes: Axes, at: "StateC") -> None:
    theta = at.theta_s
    frame = _Frame(
        np.array([math.cos(theta), math.sin(theta)]),
        np.array([-math.sin(theta), math.cos(theta)]),
        [at.d_C + k * at.p for k in range(at.n, -1, -1)],
    )
    _draw_steps(axes, at, frame)
    _draw_body(axes, at, frame)
    _draw_triangle(axes, at, frame)
    _draw_angles(axes, at, frame)
    _draw_lengths(axes, at, frame)
    axes.margins(0.03)


def _draw_steps(axes: Axes, at: "StateC", frame: _Frame) -> None:
    """Steps under the robot, one more at either end."""
    contacts, corners = frame.contacts, []
    for s in [contacts[0] + at.p, *contacts, contacts[-1] - at.p]:
        nosing = frame.place(s)
        corners += [nosing - [0.0, at.p * math.sin(at.theta_s)], nosing]
    steps = np.array([*corners[1:], corners[-1] + [0.05, 0.0]])
    axes.plot(*steps.T, color=look.GREY, linewidth=1.2)
    deep = np.array([[steps[-1, 0], steps[0, 1]]])
    axes.fill(*np.vstack([steps, deep]).T, facecolor=look.PALE, linewidth=0)


def _draw_body(axes: Axes, at: "StateC", frame: _Frame) -> None:
    """Outline, flat underside and centroid."""
    body = FancyBboxPatch(
        (-at.L - at.outline, 0.0),
        at.L + 2 * at.outline,
        2 * at.outline,
        boxstyle=f"round,pad=0,rounding_size={at.outline:g}",
        facecolor="none",
        edgecolor=look.GREY,
        linewidth=0.8,
        linestyle=(0, (5, 3)),
    )
    body.set_transform(Affine2D().rotate(at.theta_s) + axes.transData)
    axes.add_patch(body)
    underside = np.array([frame.place(0.0), frame.place(at.L)])
    axes.plot(*underside.T, color=look.BLACK, linewidth=2.4)
    centroid = frame.place(at.C_L, at.C_N)
    axes.plot(
        *centroid, marker="o", markersize=8, markerfacecolor="white", markeredgecolor="black",
        zorder=5,
    )  # fmt: skip
    axes.plot(*centroid, marker="+", markersize=8, color=look.BLACK, zorder=6)
    _text(axes, centroid + np.array([-0.014, 0.012]), "$C$", fontsize=10.0, ha="right", va="bottom")


def _draw_triangle(axes: Axes, at: "StateC", frame: _Frame) -> None:
    """Contacts, and the sides from the centroid to the lowest and to the highest one."""
    contacts, centroid = frame.contacts, frame.place(at.C_L, at.C_N)
    lowest, highest = frame.place(contacts[1]), frame.place(contacts[-1])
    axes.plot(*np.array([lowest, centroid]).T, color=look.VERMILION)
    axes.plot(*np.array([highest, centroid]).T, color=look.BLUE, linestyle="--")
    plumb = np.array([centroid, lowest - [0.0, 0.10]])
    axes.plot(*plumb.T, color=look.BLACK, linewidth=0.8, linestyle=":")
    for index, s in enumerate(contacts):
        axes.plot(
            *frame.place(s), marker="o", markersize=5.5, markeredgecolor=look.BLACK,
            markerfacecolor="white" if index == 0 else look.BLACK, zorder=5,
        )  # fmt: skip
        beside = frame.place(s) + np.array([0.012, -0.014])
        _text(axes, beside, f"$t_{index}$", fontsize=9.0, ha="left", va="top")
    beside = (lowest + centroid) / 2 - 0.016 * _across(lowest, centroid)
    label(axes, beside, "$\\alpha_C$", look.VERMILION)
    beside = (highest + centroid) / 2 - 0.016 * _across(centroid, highest)
    label(axes, beside, "$\\beta_C$", look.BLUE)


def _draw_angles(axes: Axes, at: "StateC", frame: _Frame) -> None:
    """Angle at the lowest contact, and the slope."""
    theta, lowest, reach = at.theta_s, frame.place(frame.contacts[1]), 0.075
    low, high = math.degrees(theta), math.degrees(theta + at.theta_alpha_C)
    axes.add_patch(Arc(tuple(lowest), 2 * reach, 2 * reach, theta1=low, theta2=high, linewidth=0.9))
    half = theta + at.theta_alpha_C / 2
    middle = lowest + 1.35 * reach * np.array([math.cos(half), math.sin(half)])
    label(axes, middle, "$\\theta_{\\alpha C}$")
    base = frame.place(frame.contacts[0] + at.p)
    for end, style in ((np.array([0.1, 0.0]), "-"), (0.13 * frame.up, ":")):
        side = np.array([base, base + end])
        axes.plot(*side.T, color=look.BLACK, linewidth=0.8, linestyle=style)
    axes.add_patch(Arc(tuple(base), 0.11, 0.11, theta1=0.0, theta2=low, linewidth=0.9))
    middle = base + 0.034 * np.array([math.cos(theta / 2), math.sin(theta / 2)])
    label(axes, middle, "$\\theta_s$")


def _draw_lengths(axes: Axes, at: "StateC", frame: _Frame) -> None:
    """Dimension lines."""
    place, contacts, normal = frame.place, frame.contacts, frame.normal
    clear = 2 * at.outline
    dimension(axes, place(0.0, clear + 0.03), place(at.C_L, clear + 0.03), "$C_L$", normal)
    dimension(axes, place(0.0, clear + 0.075), place(at.L, clear + 0.075), "$L$", normal)
    dimension(axes, place(0.0, 0.022), place(at.d_C, 0.022), "$d_C$", normal)
    dimension(axes, place(contacts[2], -0.075), place(contacts[1], -0.075), "$p$", -normal)
    height = np.array([place(at.C_L), place(at.C_L, at.C_N)])
    axes.plot(*height.T, color=look.BLACK, linewidth=0.8)
    label(axes, height.mean(axis=0) + 0.014 * frame.up, "$C_N$")


def _across(start: look.Array, end: look.Array) -> look.Array:
    """Unit vector to the right of the line from start to end."""
    x, y = (end - start) / np.hypot(*(end - start))
    return np.array([y, -x])


def _text(axes: Axes, at: look.Array, text: str, **how: Any) -> None:
    axes.text(float(at[0]), float(at[1]), text, **how)


def _values(figure: Figure, at: "StateC") -> None:
    """Symbols and their values, right of the picture."""
    degrees = math.degrees
    lines = [
        ("Table 1", ""),
        ("$L$", f"{1e3 * at.L:.0f} mm"),
        ("$C_L$", f"{1e3 * at.C_L:.0f} mm"),
        ("$C_N$", f"{1e3 * at.C_N:.0f} mm"),
        ("", ""),
        ("computed", ""),
        ("$n$ = floor($L/p$)", f"{at.n}"),
        ("$d_C$  (23)", f"{1e3 * at.d_C:.1f} mm"),
        ("$\\alpha_C$  (21)", f"{1e3 * at.alpha_C:.1f} mm"),
        ("$\\beta_C$  (22)", f"{1e3 * at.beta_C:.1f} mm"),
        ("$\\theta_{\\alpha C}$  (20)", f"{degrees(at.theta_alpha_C):.3f}°"),
        ("$\\theta_s^{sup} = \\pi/2 - \\theta_{\\alpha C}$  (19)", f"{degrees(at.theta_s):.3f}°"),
        ("", ""),
        ("printed in the text: 60.2°", ""),
        ("", ""),
        ("solid black: flat underside", ""),
        ("dashed grey: outline (not of the paper)", ""),
        ("dotted: plumb line of $C$", ""),
    ]
    for index, (name, value) in enumerate(lines):
        y = 0.86 - 0.043 * index
        weight = "bold" if name in ("Table 1", "computed") else "normal"
        figure.text(0.645, y, name, weight=weight)
        figure.text(0.985, y, value, ha="right")
