"""Picture of the triangle of Eqs. (19)-(23) in state C (the paper's Fig. 10), to scale."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, FancyBboxPatch
from matplotlib.transforms import Affine2D

from kaidan.report import look
from kaidan.report.reproduction import StateC

_HEIGHT = 4.9


def triangle_figure(at: StateC) -> Figure:
    """Side view of the robot in state C with the symbols of Eqs. (19)-(23), and their values.

    Parameters
    ----------
    at : StateC
        What is to be drawn.

    Returns
    -------
    Figure
    """
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


def _draw(axes: Axes, at: StateC) -> None:
    theta = at.theta_s
    up = np.array([math.cos(theta), math.sin(theta)])
    normal = np.array([-math.sin(theta), math.cos(theta)])

    def place(s: float, z: float = 0.0) -> look.Array:
        """Point ``s`` behind the front tip and ``z`` above the underside."""
        return -s * up + z * normal

    contacts = [at.d_C + k * at.p for k in range(at.n, -1, -1)]
    corners = []
    for s in [contacts[0] + at.p, *contacts, contacts[-1] - at.p]:
        nosing = place(s)
        corners += [nosing - [0.0, at.p * math.sin(theta)], nosing]
    steps = np.array([*corners[1:], corners[-1] + [0.05, 0.0]])
    axes.plot(*steps.T, color=look.GREY, linewidth=1.2)
    deep = np.array([[steps[-1, 0], steps[0, 1]]])
    axes.fill(*np.vstack([steps, deep]).T, facecolor=look.PALE, linewidth=0)

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
    body.set_transform(Affine2D().rotate(theta) + axes.transData)
    axes.add_patch(body)
    axes.plot(*np.array([place(0.0), place(at.L)]).T, color=look.BLACK, linewidth=2.4)

    centroid, lowest, highest = place(at.C_L, at.C_N), place(contacts[1]), place(contacts[-1])
    axes.plot(*np.array([lowest, centroid]).T, color=look.VERMILION)
    axes.plot(*np.array([highest, centroid]).T, color=look.BLUE, linestyle="--")
    axes.plot(
        *np.array([centroid, lowest - [0.0, 0.10]]).T,
        color=look.BLACK,
        linewidth=0.8,
        linestyle=":",
    )
    for index, s in enumerate(contacts):
        name = f"$t_{index}$"
        axes.plot(
            *place(s),
            marker="o",
            markersize=5.5,
            markeredgecolor=look.BLACK,
            markerfacecolor="white" if index == 0 else look.BLACK,
            zorder=5,
        )
        _text(axes, place(s) + np.array([0.012, -0.014]), name, fontsize=9.0, ha="left", va="top")
    axes.plot(
        *centroid,
        marker="o",
        markersize=8,
        markerfacecolor="white",
        markeredgecolor="black",
        zorder=5,
    )
    axes.plot(*centroid, marker="+", markersize=8, color=look.BLACK, zorder=6)
    _text(axes, centroid + np.array([-0.014, 0.012]), "$C$", fontsize=10.0, ha="right", va="bottom")

    _label(
        axes,
        (lowest + centroid) / 2 - 0.016 * _across(lowest, centroid),
        "$\\alpha_C$",
        look.VERMILION,
    )
    _label(
        axes, (highest + centroid) / 2 - 0.016 * _across(centroid, highest), "$\\beta_C$", look.BLUE
    )
    reach = 0.075
    axes.add_patch(
        Arc(
            tuple(lowest),
            2 * reach,
            2 * reach,
            theta1=math.degrees(theta),
            theta2=math.degrees(theta + at.theta_alpha_C),
            linewidth=0.9,
        )
    )
    half = theta + at.theta_alpha_C / 2
    _label(
        axes,
        lowest + 1.35 * reach * np.array([math.cos(half), math.sin(half)]),
        "$\\theta_{\\alpha C}$",
    )

    clear = 2 * at.outline
    _dimension(axes, place(0.0, clear + 0.03), place(at.C_L, clear + 0.03), "$C_L$", normal)
    _dimension(axes, place(0.0, clear + 0.075), place(at.L, clear + 0.075), "$L$", normal)
    _dimension(axes, place(0.0, 0.022), place(at.d_C, 0.022), "$d_C$", normal)
    _dimension(axes, place(contacts[2], -0.075), place(contacts[1], -0.075), "$p$", -normal)
    foot = place(at.C_L)
    axes.plot(*np.array([foot, centroid]).T, color=look.BLACK, linewidth=0.8)
    _label(axes, (foot + centroid) / 2 + 0.014 * up, "$C_N$")
    base = place(contacts[0] + at.p)
    axes.plot(*np.array([base, base + np.array([0.1, 0.0])]).T, color=look.BLACK, linewidth=0.8)
    axes.plot(*np.array([base, base + 0.13 * up]).T, color=look.BLACK, linewidth=0.8, linestyle=":")
    axes.add_patch(
        Arc(tuple(base), 0.11, 0.11, theta1=0.0, theta2=math.degrees(theta), linewidth=0.9)
    )
    _label(axes, base + 0.034 * np.array([math.cos(theta / 2), math.sin(theta / 2)]), "$\\theta_s$")
    axes.margins(0.03)


def _across(start: look.Array, end: look.Array) -> look.Array:
    """Unit vector to the right of the way from start to end."""
    x, y = (end - start) / np.hypot(*(end - start))
    return np.array([y, -x])


def _label(axes: Axes, at: look.Array, text: str, color: str = look.BLACK) -> None:
    _text(axes, at, text, fontsize=9.0, color=color, ha="center", va="center", zorder=7)


def _text(axes: Axes, at: look.Array, text: str, **how: Any) -> None:
    axes.text(float(at[0]), float(at[1]), text, **how)


def _dimension(
    axes: Axes, start: look.Array, end: look.Array, text: str, outward: look.Array
) -> None:
    """Dimension line with its name on the outer side."""
    axes.annotate(
        "",
        tuple(start),
        tuple(end),
        arrowprops={
            "arrowstyle": "|-|,widthA=0.25,widthB=0.25",
            "linewidth": 0.8,
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )
    _label(axes, (start + end) / 2 + 0.017 * outward, text)


def _values(figure: Figure, at: StateC) -> None:
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
