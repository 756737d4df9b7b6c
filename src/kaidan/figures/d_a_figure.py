"""Picture of the d-a plane: areas, limits, states, and a planned acceleration with its speed."""

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from kaidan.figures import style as look
from kaidan.words import heading

if TYPE_CHECKING:
    from kaidan.verbs.d_a_plane import Plane
    from kaidan.verbs.plane_areas import Region

_NAMES = {
    "A": ("A  slipping", "A"),
    "B": ("B  tipping downhill", "B  tipping\ndownhill", "B"),
    "C": ("C  tipping uphill", "C  tipping\nuphill", "C"),
    "DOWNHILL_SLIP": ("sliding uphill (ours)", "sliding (ours)", "ours"),
    "D": ("D  stable", "D"),
    "E": ("E  semi-unstable", "E"),
}
_NAMES_NOSE_UP = {
    "B": ("B  falling backward", "B  falling\nbackward", "B"),
    "C": ("C  falling forward", "C  falling\nforward", "C"),
}
"""The paper's names, which suppose that the nose points up the stairs."""

_LEFT, _TOP, _BOTTOM, _STATES, _PLANE, _SPEED = 0.62, 0.5, 0.6, 0.36, 3.5, 1.1
_COLUMN = 0.25
"""From the plane to the names right of it [in]."""


def d_a_figure(plane: "Plane", note: str = "") -> Figure:
    """Picture of a d-a plane that is inside the model.

    Parameters
    ----------
    plane : Plane
        With a plan in it, the plan and its speed are drawn too.
    note : str
        Line at the foot.
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


_SAFE_NOTE = "Dotted: the tip limits less the allowances $\\theta_d$ and $\\theta_M$."


def _has_safe(plane: "Plane") -> bool:
    at = plane.curves
    return at is not None and (at.a_r0, at.a_rn) != (at.a_r0_safe, at.a_rn_safe)


def draw_plane(axes: Axes, plane: "Plane") -> None:
    """Draw areas, limits and the plan into axes of final size."""
    low, high = _view(plane)
    axes.set_xlim(0.0, 1e3 * plane.nosing_spacing_m)
    axes.set_ylim(low, high)
    axes.set_ylabel("acceleration $a$ up the stairs [m/s²]")
    for region in plane.regions:
        below, above = _band(region)
        axes.fill_between(
            1e3 * np.array(region.d_m),
            np.clip(below, low, high),
            np.clip(above, low, high),
            **look.fill(f"area {region.area}"),
        )
    axes.axhline(plane.acceleration, color=look.BLACK, linewidth=0.8, linestyle=":")
    _draw_limits(axes, plane)
    if plane.plan is not None and plane.plan.found:
        passes = _passes(plane)
        for index, (d_plan, a_plan, _) in enumerate(passes):
            axes.step(d_plan, a_plan, where="post", **_pass_style(index, len(passes)))
    _curve_name(axes, plane, "a_r0", "$a_{r0}(d)$")
    _curve_name(axes, plane, "a_rn", "$a_{rn}(d)$")
    _area_names(axes, plane)
    _level_names(axes, plane)


def _draw_limits(axes: Axes, plane: "Plane") -> None:
    """Limits as lines: over the progress, and throughout."""
    low, high = axes.get_ylim()
    d = 1e3 * _curve(plane, "d_m")
    styles: dict[str, dict[str, Any]] = {
        "a_r0": {"color": look.VERMILION},
        "a_rn": {"color": look.BLUE, "linestyle": "--"},
    }
    for name, style in styles.items():
        axes.plot(d, _curve(plane, name), **style, zorder=3)
        if _has_safe(plane):
            thin = {"color": style["color"], "linewidth": 0.9, "linestyle": ":"}
            axes.plot(d, _curve(plane, f"{name}_safe"), **thin, zorder=3)
    for value in (plane.a_S, plane.a_slides_up):
        if value is not None and low <= value <= high:
            axes.axhline(value, color=look.BLACK, linewidth=1.2, linestyle="-.", zorder=3)
    upper = plane.a_S_high
    if upper is not None and upper != plane.a_S and low <= upper <= high:
        axes.axhline(upper, color=look.GREY, linewidth=0.8, linestyle="-.", zorder=3)
    for value in (plane.min_a_r0, plane.max_a_rn):
        if value is not None:
            axes.axhline(value, color=look.BLACK, linewidth=0.7, zorder=2.5)


def _curve(plane: "Plane", name: str) -> look.Array:
    """Curve over the progress."""
    return np.array(getattr(plane.curves, name), dtype=np.float64)


def _band(region: "Region") -> tuple[look.Array, look.Array]:
    """Lower and upper curve of a region, infinite where nothing bounds it."""
    low, high = (np.array(curve, dtype=np.float64) for curve in (region.low, region.high))
    return np.nan_to_num(low, nan=-np.inf), np.nan_to_num(high, nan=np.inf)


def _view(plane: "Plane") -> tuple[float, float]:
    """Range of acceleration shown: both kinds of limit either way, and the requested one."""
    limits = (plane.a_S, plane.a_slides_up, plane.min_a_r0, plane.max_a_rn)
    shown = [plane.acceleration, 0.0, *(value for value in limits if value is not None)]
    if plane.a_S is None:
        shown += [float(_curve(plane, "a_r0").max()), float(_curve(plane, "a_rn").min())]
    if plane.plan is not None and plane.plan.found:
        shown += [min(plane.plan.a_along_path), max(plane.plan.a_along_path)]
    low, high = min(shown), max(shown)
    pad = max(0.2 * (high - low), 0.5)
    return low - pad, high + pad


def _passes(plane: "Plane") -> list[tuple[look.Array, look.Array, look.Array]]:
    """Progress [mm] at the edges, acceleration up the stairs per cell and speed, span by span.

    Accelerations are repeated at the end, to be drawn as steps.
    """
    plan = plane.plan
    assert plan is not None
    path, accelerations, speeds = map(np.array, (plan.path_m, plan.a_along_path, plan.speed))
    cells = len(accelerations) // plan.nosing_spacings
    found = []
    for span in range(plan.nosing_spacings):
        first = span * cells
        along = 1e3 * (path[first : first + cells + 1] - path[first])
        a, v = accelerations[first : first + cells], speeds[first : first + cells + 1]
        if plane.direction == "down":
            along, a, v = 1e3 * plane.nosing_spacing_m - along[::-1], -a[::-1], v[::-1]
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


def _draw_speed(axes: Axes, plane: "Plane") -> None:
    passes = _passes(plane)
    for index, (d, _, v) in enumerate(passes):
        axes.plot(d, v, **_pass_style(index, len(passes)))
    axes.set_xlim(0.0, 1e3 * plane.nosing_spacing_m)
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


def _draw_states(axes: Axes, plane: "Plane") -> None:
    """Strip above the plane with the states of Fig. 3."""
    p = 1e3 * plane.nosing_spacing_m
    axes.set_xlim(0.0, p)
    axes.set_ylim(0.0, 1.0)
    axes.axis("off")
    width = look.size_of(axes)[0]
    at: dict[str, Any] = {"fontsize": look.SMALL, "va": "center"}
    for each in plane.states:
        start, end = 1e3 * each.from_m, 1e3 * each.to_m
        if start == end:
            near = each.state == "C" and start / p * width < 0.25
            name = "A = C" if each.state == "C" and start == 0 else each.state
            _tick(axes, start, name, "left" if near else "center")
            continue
        for shown in (f"{each.state}: {each.contacts} contacts", each.state):
            size = look.extent(look.figure_of(axes), shown)[0]
            if size + 0.1 < (end - start) / p * width:
                axes.text((start + end) / 2, 0.25, shown, ha="center", **at)
                break
    axes.text(-0.01, 0.25, "state", ha="right", transform=axes.transAxes, **at)
    _tick(axes, p, "A", "center")


def _tick(axes: Axes, x: float, name: str, sideways: Literal["left", "center"]) -> None:
    axes.plot([x, x], [0.0, 0.4], color=look.BLACK, linewidth=0.7, clip_on=False)
    axes.text(x, 0.7, name, ha=sideways, va="center", fontsize=look.SMALL)


def _curve_name(axes: Axes, plane: "Plane", name: str, text: str) -> None:
    """Write a curve's name on its longest visible part."""
    d, curve = _curve(plane, "d_m"), _curve(plane, name)
    low, high = axes.get_ylim()
    pad = 0.06 * (high - low)
    edge = 0.06 * plane.nosing_spacing_m
    shown = (curve > low + pad) & (curve < high - pad)
    shown &= (d > edge) & (d < plane.nosing_spacing_m - edge)
    shown[:-1] &= np.diff(d) > 0
    runs = np.split(np.flatnonzero(shown), np.flatnonzero(np.diff(np.flatnonzero(shown)) > 1) + 1)
    longest = max(runs, key=len, default=np.empty(0, dtype=int))
    if len(longest) < 8:
        return
    index = int(longest[len(longest) // 2])
    axes.text(
        1e3 * d[index],
        curve[index],
        text,
        ha="center",
        va="center",
        fontsize=9.0,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0, "alpha": 0.9},
        zorder=4.5,
    )


def _area_names(axes: Axes, plane: "Plane") -> None:
    """Names of the areas, each where there is most room between the lines."""
    low, high = axes.get_ylim()
    columns = np.linspace(0.0, plane.nosing_spacing_m, 241)
    rows = np.linspace(low, high, 241)[:, None]
    free = _free_of_lines(axes, plane, columns, rows)
    parts: dict[str, list[NDArray[np.bool_]]] = {}
    for region in plane.regions:
        below, above = (
            np.interp(columns, region.d_m, np.clip(curve, low, high)) for curve in _band(region)
        )
        parts.setdefault(region.area, []).append((rows > below) & (rows < above) & free)
    names = _NAMES | _NAMES_NOSE_UP if plane.downhill_end == "tail" else _NAMES
    for area, places in parts.items():
        for place in places:
            any(look.name_area(axes, place, text) for text in names[area])


def _free_of_lines(
    axes: Axes, plane: "Plane", columns: look.Array, rows: look.Array
) -> NDArray[np.bool_]:
    """Points of a grid that no curve, level or text is near."""
    low, high = axes.get_ylim()
    clear = 0.07 / look.size_of(axes)[1] * (high - low)
    free = np.ones((len(rows), len(columns)), dtype=bool)
    lines = [
        (_curve(plane, "d_m"), _curve(plane, name))
        for name in ("a_r0", "a_rn", "a_r0_safe", "a_rn_safe")
    ]
    if plane.plan is not None and plane.plan.found:
        lines += [(d / 1e3, a) for d, a, _ in _passes(plane)]
    wide = 0.07 / look.size_of(axes)[0] * plane.nosing_spacing_m
    for d, curve in lines:
        free &= np.abs(rows - np.interp(columns, d, curve)) > clear
        for at in np.flatnonzero(np.diff(d) == 0):  # where the lowest contact leaves
            foot, head = sorted(curve[at : at + 2])
            free &= ~((np.abs(columns - d[at]) < wide) & (rows > foot) & (rows < head))
    for level in (plane.acceleration, plane.a_S_high):
        if level is not None:
            free &= ~(np.abs(rows - level) < clear)
    x, y = columns / plane.nosing_spacing_m, (rows - low) / (high - low)
    for text in axes.texts:
        box = text.get_window_extent().transformed(axes.transAxes.inverted())
        free &= ~((x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1))
    return free


def _levels(plane: "Plane") -> list[tuple[float, str]]:
    """Horizontal limits within the view, with their names."""
    levels = [(plane.acceleration, f"$a$ = {look.signed(plane.acceleration)} (requested)")]
    for value, text, name, end in (
        (plane.a_S, "$a_S$", "$a_{max}$", plane.a_max),
        (plane.min_a_r0, "min $a_{r0}$", "$a_{max}$", plane.a_max),
        (plane.max_a_rn, "max $a_{rn}$", "$a_{min}$", plane.a_min),
        (plane.a_slides_up, "slides up", "$a_{min}$", plane.a_min),
    ):
        if value is not None:
            role = f" = {name}" if value == end else ""
            levels.append((value, f"{text}{role} = {look.signed(value)}"))
    if plane.a_S_high is not None and plane.a_S_high != plane.a_S and plane.friction:
        levels.append((plane.a_S_high, f"$a_S$ for $\\mu_s$ = {plane.friction[1]:g}"))
    low, high = _view(plane)
    return [(value, text) for value, text in levels if low <= value <= high]


def _level_names(axes: Axes, plane: "Plane") -> None:
    """Names of the horizontal limits, right of the plane."""
    look.label_right(
        axes,
        [(1e3 * plane.nosing_spacing_m, value, text) for value, text in _levels(plane)],
        start=1.0 + _COLUMN / look.size_of(axes)[0],
        gap=0.15,
    )


def _title(plane: "Plane") -> tuple[str, str]:
    friction = "friction not stated: no slipping shown"
    if plane.friction is not None:
        low, high = plane.friction
        friction = f"$\\mu_s$ = {low:g}" if low == high else f"$\\mu_s$ = {low:g}–{high:g}"
    end = "" if plane.downhill_end == "tail" else " (from its tail)"
    return (
        f"{look.named(plane.robot)} on {look.named(plane.stairs)}, {heading(plane)}",
        f"$\\theta_s$ = {plane.angle_deg:.1f}°, $p$ = {1e3 * plane.nosing_spacing_m:.0f}, "
        f"$L$ = {1e3 * plane.flat_length_m:.0f}, "
        f"$C_L$ = {1e3 * plane.com_from_uphill_end_m:.0f}{end}, "
        f"$C_N$ = {1e3 * plane.com_height_m:.0f} mm, {friction}",
    )
