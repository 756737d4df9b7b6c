"""Picture of the d-a plane: areas, limits, states, and a planned acceleration with its speed."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from kaidan.mechanics.plane import Area
from kaidan.report import look
from kaidan.report.d_a_plane import Plane

_NAMES = {
    Area.A: ("A  slipping", "A"),
    Area.B: ("B  tipping downhill", "B  tipping\ndownhill", "B"),
    Area.C: ("C  tipping uphill", "C  tipping\nuphill", "C"),
    Area.DOWNHILL_SLIP: ("downhill slip (ours)", "slip (ours)", "ours"),
    Area.D: ("D  stable", "D"),
    Area.E: ("E  semi-unstable", "E"),
}
_NAMES_NOSE_UP = {
    Area.B: ("B  falling backward", "B  falling\nbackward", "B"),
    Area.C: ("C  falling forward", "C  falling\nforward", "C"),
}
"""The paper's names, which suppose that the nose points up the stairs."""

_LEFT, _TOP, _BOTTOM, _STATES, _PLANE, _SPEED = 0.62, 0.5, 0.6, 0.36, 3.5, 1.1
_COLUMN = 0.25
"""From the plane to the names right of it [in]."""


def d_a_figure(plane: Plane, note: str = "") -> Figure:
    """Picture of a d-a plane that is inside the model.

    Parameters
    ----------
    plane : Plane
        With a plan in it, the plan and its speed are drawn too.
    note : str
        Line at the foot.

    Returns
    -------
    Figure
    """
    moving = plane.plan is not None and plane.plan.found
    below = _SPEED + 0.15 if moving else 0.0
    notes = [*([_SAFE_NOTE] if _has_safe(plane) else []), *([note] if note else [])]
    foot = _BOTTOM + 0.16 * len(notes)
    height = _TOP + _STATES + _PLANE + below + foot
    with look.settings():
        figure = look.blank(height)
        names = [look.extent(figure, text)[0] for _, text in _levels(plane)]
        width = look.WIDTH - _LEFT - _COLUMN - max([*names, 1.5 if moving else 0.0]) - 0.08

        def axes_at(bottom: float, tall: float) -> Axes:
            return figure.add_axes(
                (_LEFT / look.WIDTH, bottom / height, width / look.WIDTH, tall / height)
            )

        main = axes_at(foot + below, _PLANE)
        draw_plane(main, plane)
        _draw_states(axes_at(foot + below + _PLANE, _STATES), plane)
        lowest = main
        if moving:
            main.tick_params(labelbottom=False)
            lowest = axes_at(foot, _SPEED)
            _draw_speed(lowest, plane)
        lowest.set_xlabel("progress $d$ of the uphill end beyond a nosing [mm]")
        look.title(figure, _LEFT, *_title(plane))
        for index, text in enumerate(reversed(notes)):
            figure.text(_LEFT / look.WIDTH, (0.07 + 0.16 * index) / height, text)
    return figure


_SAFE_NOTE = "Dotted: the tip limits with $\\theta_d$ and $\\theta_M$ taken off (worst reading)."


def _has_safe(plane: Plane) -> bool:
    same = np.array_equal(plane.a_r0, plane.a_r0_safe)
    return not (same and np.array_equal(plane.a_rn, plane.a_rn_safe))


def draw_plane(axes: Axes, plane: Plane) -> None:
    """Draw areas, limits and the plan into axes of final size."""
    low, high = _view(plane)
    axes.set_xlim(0.0, 1e3 * plane.p)
    axes.set_ylim(low, high)
    axes.set_ylabel("acceleration $a$ up the stairs [m/s²]")
    d = 1e3 * plane.d
    for region in plane.regions():
        axes.fill_between(
            1e3 * region.d,
            np.clip(region.low, low, high),
            np.clip(region.high, low, high),
            **look.fill(f"area {region.area.name}"),
        )
    axes.axhline(plane.acceleration, color=look.BLACK, linewidth=0.8, linestyle=":")
    axes.plot(d, plane.a_r0, color=look.VERMILION, zorder=3)
    axes.plot(d, plane.a_rn, color=look.BLUE, linestyle="--", zorder=3)
    if _has_safe(plane):
        axes.plot(d, plane.a_r0_safe, color=look.VERMILION, linewidth=0.9, linestyle=":", zorder=3)
        axes.plot(d, plane.a_rn_safe, color=look.BLUE, linewidth=0.9, linestyle=":", zorder=3)
    for value in (plane.a_S, plane.a_slip_down):
        if low <= value <= high:
            axes.axhline(value, color=look.BLACK, linewidth=1.2, linestyle="-.", zorder=3)
    if plane.a_S_high != plane.a_S and low <= plane.a_S_high <= high:
        axes.axhline(plane.a_S_high, color=look.GREY, linewidth=0.8, linestyle="-.", zorder=3)
    for value in (plane.min_a_r0, plane.max_a_rn):
        axes.axhline(value, color=look.BLACK, linewidth=0.7, zorder=2.5)
    if plane.plan is not None and plane.plan.found:
        passes = _passes(plane)
        for index, (d_plan, a_plan, _) in enumerate(passes):
            axes.step(d_plan, a_plan, where="post", **_pass_style(index, len(passes)))
    _curve_name(axes, plane, plane.a_r0, "$a_{r0}(d)$")
    _curve_name(axes, plane, plane.a_rn, "$a_{rn}(d)$")
    _area_names(axes, plane)
    _level_names(axes, plane)


def _view(plane: Plane) -> tuple[float, float]:
    """Range of acceleration shown: both kinds of limit either way, and what was asked."""
    known = [value for value in (plane.a_S, plane.a_slip_down) if not math.isnan(value)]
    shown = [*known, plane.min_a_r0, plane.max_a_rn, plane.acceleration, 0.0]
    if not known:
        shown += [float(plane.a_r0.max()), float(plane.a_rn.min())]
    if plane.plan is not None and plane.plan.found:
        shown += [float(plane.plan.a.min()), float(plane.plan.a.max())]
    low, high = min(shown), max(shown)
    pad = max(0.2 * (high - low), 0.5)
    return low - pad, high + pad


def _passes(plane: Plane) -> list[tuple[look.Array, look.Array, look.Array]]:
    """Progress [mm] at the edges, acceleration up the stairs per cell and speed, span by span.

    Accelerations are repeated at the end, to be drawn as steps.
    """
    plan = plane.plan
    assert plan is not None
    cells = len(plan.a) // plan.spans
    found = []
    for span in range(plan.spans):
        first = span * cells
        along = 1e3 * (plan.path[first : first + cells + 1] - plan.path[first])
        a, v = plan.a[first : first + cells], plan.v[first : first + cells + 1]
        if plane.direction == "down":
            along, a, v = 1e3 * plane.p - along[::-1], -a[::-1], v[::-1]
        found.append((along, np.append(a, a[-1]), v))
    return found


_PASS_STYLES: dict[str, dict[str, Any]] = {
    "first": {"color": look.BLACK, "linewidth": 1.3, "linestyle": (0, (3, 1.5))},
    "between": {"color": look.GREY, "linewidth": 0.5, "linestyle": "-"},
    "last": {"color": look.BLACK, "linewidth": 1.9, "linestyle": "-"},
}


def _pass_style(index: int, count: int) -> dict[str, Any]:
    kind = "last" if index == count - 1 else "first" if index == 0 else "between"
    return {**_PASS_STYLES[kind], "zorder": 3.8 if kind == "between" else 3.9}


def _draw_speed(axes: Axes, plane: Plane) -> None:
    passes = _passes(plane)
    for index, (d, _, v) in enumerate(passes):
        axes.plot(d, v, **_pass_style(index, len(passes)))
    axes.set_xlim(0.0, 1e3 * plane.p)
    top = 1.15 * max(float(v.max()) for _, _, v in passes)
    axes.set_ylim(0.0, top or 1.0)
    axes.set_ylabel("speed [m/s]")
    axes.legend(
        handles=[
            Line2D([], [], label=text, **_PASS_STYLES[kind])
            for kind, text in (
                ("first", "plan, first nosing"),
                ("between", "nosings between"),
                ("last", "plan, last nosing"),
            )
        ],
        loc="upper left",
        bbox_to_anchor=(1.02, 1.03),
        frameon=False,
        borderaxespad=0.0,
        handlelength=2.4,
    )


def _draw_states(axes: Axes, plane: Plane) -> None:
    """Strip above the plane with the states of Fig. 3."""
    axes.set_xlim(0.0, 1e3 * plane.p)
    axes.set_ylim(0.0, 1.0)
    axes.axis("off")
    width = look.size_of(axes)[0]
    near = plane.d_C / plane.p * width < 0.25
    at: dict[str, Any] = {"fontsize": look.SMALL, "va": "center"}
    for name, start, end, contacts in plane.states():
        if start == end:
            sideways = "left" if name == "C" and near else "center"
            axes.plot([1e3 * start] * 2, [0.0, 0.4], color=look.BLACK, linewidth=0.7, clip_on=False)
            name = "A = C" if plane.d_C == 0 else name
            axes.text(1e3 * start, 0.7, name, ha=sideways, **at)
            continue
        text = f"{name}: {contacts} contacts"
        for shown in (text, name):
            size = look.extent(look.figure_of(axes), shown)[0]
            if size + 0.1 < (end - start) / plane.p * width:
                axes.text(5e2 * (start + end), 0.25, shown, ha="center", **at)
                break
    axes.text(-0.01, 0.25, "state", ha="right", transform=axes.transAxes, **at)
    axes.plot([1e3 * plane.p] * 2, [0.0, 0.4], color=look.BLACK, linewidth=0.7, clip_on=False)
    axes.text(1e3 * plane.p, 0.7, "A", ha="center", **at)


def _curve_name(axes: Axes, plane: Plane, curve: look.Array, text: str) -> None:
    """Write a curve's name on its longest visible part."""
    low, high = axes.get_ylim()
    pad = 0.06 * (high - low)
    edge = 0.06 * plane.p
    shown = (curve > low + pad) & (curve < high - pad)
    shown &= (plane.d > edge) & (plane.d < plane.p - edge)
    shown[:-1] &= np.diff(plane.d) > 0
    runs = np.split(np.flatnonzero(shown), np.flatnonzero(np.diff(np.flatnonzero(shown)) > 1) + 1)
    longest = max(runs, key=len, default=np.empty(0, dtype=int))
    if len(longest) < 8:
        return
    index = int(longest[len(longest) // 2])
    axes.text(
        1e3 * plane.d[index],
        curve[index],
        text,
        ha="center",
        va="center",
        fontsize=9.0,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.9},
        zorder=4.5,
    )


def _area_names(axes: Axes, plane: Plane) -> None:
    low, high = axes.get_ylim()
    columns = np.linspace(0.0, plane.p, 241)
    rows = np.linspace(low, high, 241)[:, None]
    clear = 0.07 / look.size_of(axes)[1] * (high - low)
    free = np.ones((241, 241), dtype=bool)
    told = (plane.a_r0, plane.a_rn, plane.a_r0_safe, plane.a_rn_safe)
    curves = [(plane.d, curve) for curve in told]
    if plane.plan is not None and plane.plan.found:
        curves += [(d / 1e3, a) for d, a, _ in _passes(plane)]
    for d, curve in curves:
        free &= np.abs(rows - np.interp(columns, d, curve)) > clear
    for level in (plane.acceleration, plane.a_S_high):
        free &= ~(np.abs(rows - level) < clear)
    for text_box in axes.texts:
        box = text_box.get_window_extent().transformed(axes.transAxes.inverted())
        x, y = columns / plane.p, (rows - low) / (high - low)
        free &= ~((x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1))
    union: dict[Area, list[NDArray[np.bool_]]] = {}
    for region in plane.regions():
        below = np.interp(columns, region.d, np.clip(region.low, low, high))
        above = np.interp(columns, region.d, np.clip(region.high, low, high))
        union.setdefault(region.area, []).append((rows > below) & (rows < above) & free)
    names = _NAMES | _NAMES_NOSE_UP if plane.nose_up else _NAMES
    for area, parts in union.items():
        for part in parts:
            any(look.name_area(axes, part, text) for text in names[area])


def _levels(plane: Plane) -> list[tuple[float, str]]:
    """Horizontal limits within the view, with their names."""
    levels = [(plane.acceleration, f"$a$ = {look.signed(plane.acceleration)} (asked)")]
    band = plane.a_min < plane.a_max
    for value, text, name, end in (
        (plane.a_S, "$a_S$", "$a_{max}$", plane.a_max),
        (plane.min_a_r0, "min $a_{r0}$", "$a_{max}$", plane.a_max),
        (plane.max_a_rn, "max $a_{rn}$", "$a_{min}$", plane.a_min),
        (plane.a_slip_down, "downhill slip", "$a_{min}$", plane.a_min),
    ):
        if not math.isnan(value):
            role = f" = {name}" if band and value == end else ""
            levels.append((value, f"{text}{role} = {look.signed(value)}"))
    if plane.a_S_high != plane.a_S and not math.isnan(plane.a_S):
        levels.append((plane.a_S_high, f"$a_S$ for $\\mu_s$ = {plane.mu_s[1]:g}"))
    low, high = _view(plane)
    return [(value, text) for value, text in levels if low <= value <= high]


def _level_names(axes: Axes, plane: Plane) -> None:
    """Names of the horizontal limits, right of the plane."""
    look.label_right(
        axes,
        [(1e3 * plane.p, value, text) for value, text in _levels(plane)],
        start=1.0 + _COLUMN / look.size_of(axes)[0],
        gap=0.15,
    )


def _title(plane: Plane) -> tuple[str, str]:
    pose = plane.pose
    low, high = plane.mu_s
    friction = f"$\\mu_s$ = {low:g}" if low == high else f"$\\mu_s$ = {low:g}–{high:g}"
    if math.isnan(low):
        friction = "friction not stated: no slipping shown"
    end = "" if plane.nose_up else " (from its tail)"
    return (
        f"{look.named(plane.robot)} {plane.direction} {look.named(plane.stairs)}, "
        f"{plane.facing.replace('-', ' ')}",
        f"$\\theta_s$ = {math.degrees(pose.theta_s):.1f}°, $p$ = {1e3 * pose.p:.0f}, "
        f"$L$ = {1e3 * pose.L:.0f}, $C_L$ = {1e3 * pose.C_L:.0f}{end}, "
        f"$C_N$ = {1e3 * pose.C_N:.0f} mm, {friction}",
    )
