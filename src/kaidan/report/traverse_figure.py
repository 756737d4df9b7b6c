"""Picture of a traverse: the side view with chosen poses, and the margins along the way below."""

import math
import textwrap
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from numpy.typing import NDArray

from kaidan.contact.turning import turned
from kaidan.report import look, side_view
from kaidan.report.journey import Journey
from kaidan.report.moves import Move
from kaidan.report.side_view import Stand

_LEFT, _RIGHT, _FOOT = 0.78, 0.12, 0.42
_STRIP, _GAP = 0.92, 0.12
_INSET = (2.3, 1.45)
"""Size of the picture of the pose that decides [in]."""
_TALLEST = 4.4
_APART, _NEAR = 0.8, 0.5
"""Distance of poses that do not hide each other, in lengths of the robot; least distance of start,
end and swings."""
_ROOM_FOR_NAME = 0.05
"""Share of the way that the name of a phase takes in the figure."""
_TINTS = {"enter": "#f3f3f3", "land": "#f3f3f3"}


class Shown(NamedTuple):
    """A pose of the figure."""

    stand: Stand
    text: str
    style: str


def traverse_figure(found: Journey, poses: int | None = None) -> Figure:
    """Side view with chosen poses, and inclination, energy margin and friction along the way.

    Parameters
    ----------
    found : Journey
        A traverse.
    poses : int, optional
        Number of poses to draw; as many as fit without it.

    Returns
    -------
    Figure
    """
    with look.settings():
        heads = _heads(found)
        top = 0.28 + 0.17 * len(heads)
        width = look.WIDTH - _LEFT - _RIGHT
        view = _view(found, width)
        tall = width * (view[3] - view[2]) / (view[1] - view[0])
        strips = 3 * (_STRIP + _GAP)
        height = top + tall + 0.1 + strips + _FOOT
        figure = look.blank(height)
        axes = figure.add_axes(
            (_LEFT / look.WIDTH, 1 - (top + tall) / height, width / look.WIDTH, tall / height)
        )
        axes.set_xlim(view[0], view[1])
        axes.set_ylim(view[2], view[3])
        _draw_side(axes, found, poses)
        _draw_inset(axes, found)
        for index, draw in enumerate((_inclination, _energy, _friction)):
            bottom = _FOOT + (2 - index) * (_STRIP + _GAP)
            strip = figure.add_axes(
                (_LEFT / look.WIDTH, bottom / height, width / look.WIDTH, _STRIP / height)
            )
            strip.set_xlim(view[0], view[1])
            _phases(strip, found, named=index == 0)
            draw(strip, found)
            strip.yaxis.set_label_coords(-0.38 / width, 0.5)
            strip.axvline(
                float(found.found.run.x[found.governing_row]),
                color=look.BLACK,
                linewidth=0.7,
                linestyle=":",
                zorder=1.5,
            )
            if index < 2:
                strip.tick_params(labelbottom=False)
            else:
                strip.set_xlabel("centroid along the way [m]")
        look.title(figure, _LEFT, heads[0])
        for index, line in enumerate(heads[1:]):
            figure.text(_LEFT / look.WIDTH, 1 - (0.37 + 0.15 * index) / height, line)
    return figure


def _heads(found: Journey) -> list[str]:
    case = found.case
    verdict = found.ruling.verdict.upper()
    speed = (
        ""
        if case.acceleration == 0
        else f", $a$ = {look.signed(case.acceleration)} m/s² up the stairs"
    )
    first = (
        f"{look.named(case.robot.name)} on {look.named(case.stairs.name)}, {case.direction} "
        f"{case.facing.replace('-', ' ')}{speed}: {verdict}"
    )
    return [first, *textwrap.wrap(look.named(found.ruling.reason, 200), 112)]


def stand_at(found: Journey, row: int) -> Stand:
    """Pose of a row."""
    return Stand(*(float(value) for value in found.found.run.poses[row, 1:4]))


def _view(found: Journey, width: float) -> tuple[float, float, float, float]:
    """Limits of the side view: the whole way, and room for the inset in its empty corner."""
    outline, run = found.found.outline, found.found.run
    ends = [side_view.around(outline, stand_at(found, row)) for row in (0, -1)]
    ends += [side_view.around(outline, shown.stand) for shown in _swing_ends(found)]
    points = found.found.profile.points
    inner = points[1:-1] if len(points) > 3 else points
    x = np.concatenate([each[:, 0] for each in ends] + [run.x, inner[:, 0]])
    left, right = float(x.min()) - 0.06, float(x.max()) + 0.06
    if not found.found.arrived:  # what it never reached is no matter
        reach = sum(outline.reach)
        right = min(right, float(run.x.max()) + 2.2 * reach)
    back, ahead = outline.reach
    reach = max(back, ahead)
    seen = points[(points[:, 0] >= left) & (points[:, 0] <= right)]
    heights = [points[0, 1]] if len(seen) == 0 else seen[:, 1]
    bottom = min(float(np.min(heights)), float(run.z.min()) - reach / 2) - 0.05 * (right - left)
    per_inch = (right - left) / width
    # the outline never rises above this line of the way
    bounds = np.concatenate(ends)
    line = np.column_stack([run.x, run.z + 0.55 * (back + ahead) * np.abs(np.sin(run.inclination))])
    line[:, 1] += 0.25 * (back + ahead)
    tops = np.concatenate([bounds, line, seen])
    top = float(tops[:, 1].max()) + 0.1 * per_inch
    w, h = (_INSET[0] + 0.15) * per_inch, (_INSET[1] + 0.32) * per_inch
    near = tops[:, 0] > right - w - 0.1 if found.found.descending else tops[:, 0] < left + w + 0.1
    under = float(tops[near, 1].max()) if near.any() else bottom
    top = max(top, under + h)
    most = _TALLEST * per_inch
    if top - bottom > most:  # a high way: let it be as wide as it must
        more = (top - bottom) / _TALLEST * width - (right - left)
        left, right = left - more / 2, right + more / 2
    return left, right, bottom, top


def _swing_ends(found: Journey) -> list[Shown]:
    """Pose in which the largest swing, or the fall, ends."""
    releases = found.found.run.releases
    if len(releases) == 0:
        return []
    ends = []
    last = releases[-1]
    if not found.found.arrived and last[15] != 0.0:
        ends.append(Shown(_fallen(found, last), "falls", "after"))
    caught = releases[(releases[:, 15] == 0.0) & (releases[:, 9] > math.radians(0.5))]
    if len(caught):
        here = np.abs(caught[:, 1] - found.found.run.s[found.governing_row]) < 1e-9
        for row in {int(np.argmax(caught[:, 9])), *np.flatnonzero(here).tolist()}:
            ends.append(Shown(Stand(*(float(v) for v in caught[row, 6:9])), "", "after"))
    return ends


def _fallen(found: Journey, release: look.Array) -> Stand:
    """Pose a little way into a fall."""
    run = found.found.run
    pivot, (x, z, phi) = int(release[2]), (float(v) for v in release[3:6])
    turn = math.radians(35.0) * float(release[0])
    x, z = turned(run.ground, run.body, pivot, x, z, phi, turn)
    return Stand(x, z, phi + turn)


def chosen(found: Journey, poses: int | None) -> list[Shown]:
    """Poses to draw: the one that decides, start, end, each kind of event, none over another."""
    run, outline = found.found.run, found.found.outline
    length = sum(outline.reach)
    shown = [Shown(stand_at(found, found.governing_row), "decides", "strong")]

    def free(stand: Stand, share: float) -> bool:
        return all(
            math.hypot(stand.x - other.stand.x, stand.z - other.stand.z) >= share * length
            for other in shown
        )

    told: set[str] = set()
    for row, text in ((0, "start"), (len(run.poses) - 1, "end")):
        if free(stand_at(found, row), _NEAR):
            shown.append(Shown(stand_at(found, row), text, "ghost"))
    for kind, share in (("swings", _NEAR), ("rests", _APART), ("passes", _APART)):
        for move in sorted(found.moves, key=lambda move: -move.swing):
            stand = stand_at(found, found.found.run.row_before(move.way))
            if move.kind == kind and kind not in told and free(stand, share):
                shown.append(Shown(stand, _word(found, move), "ghost"))
                told.add(kind)
    most = len(shown) if poses is None else poses
    rows = np.linspace(0, len(run.poses) - 1, 4 * most + 2).round().astype(int)
    for row in rows if poses is not None else ():
        if len(shown) < most and free(stand_at(found, int(row)), _APART):
            shown.append(Shown(stand_at(found, int(row)), "", "ghost"))
    return shown[:most]


def _word(found: Journey, move: Move) -> str:
    if move.kind == "rests":
        return f"{found.trailing} rests"
    if move.kind == "passes":
        return "contact passes"
    verb = "drops" if f"{found.leading} drops" in move.text else "rises"
    return f"{found.leading} {verb} {move.swing:.1f}°"


def _draw_side(axes: Axes, found: Journey, poses: int | None) -> None:
    profile, outline, run = found.found.profile, found.found.outline, found.found.run
    axes.set_aspect("equal", adjustable="box")
    axes.set_axis_off()
    side_view.draw_ground(axes, profile.points, profile.nosings)
    shown = chosen(found, poses)
    words: list[Text] = []
    for each in [*shown, *_swing_ends(found)]:
        side_view.draw_robot(axes, outline, each.stand, each.style)
        side_view.draw_centroid(axes, each.stand, 3.2)
        if each.text:
            _name(axes, found, each, words)
    for start, end in _legs(run.poses[:, 15]):
        axes.plot(run.x[start:end], run.z[start:end], color=look.BLUE, linewidth=1.0, zorder=6)
    for release in run.releases:
        if release[9] > 1e-3 and release[15] == 0.0:
            axes.plot(
                [release[3], release[6]],
                [release[4], release[7]],
                color=look.VERMILION,
                linewidth=0.9,
                linestyle=(0, (2, 1.5)),
                zorder=6,
            )


def _name(axes: Axes, found: Journey, shown: Shown, words: list[Text]) -> None:
    """Word beside a robot, on the side that the way leaves free."""
    around = side_view.around(found.found.outline, shown.stand)
    down = found.found.descending
    level = abs(math.sin(shown.stand.phi)) < 0.2
    lean = np.array([0.55, 0.83]) if down else np.array([-0.55, 0.83])
    at = around[int(np.argmax(around @ lean))]
    label = axes.annotate(
        shown.text,
        xy=(shown.stand.x, float(around[:, 1].max())) if level else (float(at[0]), float(at[1])),
        xytext=(0.0 if level else 3.0 if down else -3.0, 3.0),
        textcoords="offset points",
        ha="center" if level else "left" if down else "right",
        va="bottom",
        fontsize=look.SMALL,
        weight="bold" if shown.style == "strong" else "normal",
        color=look.VERMILION if shown.style == "after" else look.BLACK,
        zorder=10,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
    )
    for lift in range(1, 5):  # above the words that stand there already
        mine = label.get_window_extent()
        if not any(mine.overlaps(other.get_window_extent()) for other in words):
            break
        label.set_position((label.get_position()[0], 3.0 + 11.0 * lift))
    words.append(label)


def _draw_inset(axes: Axes, found: Journey) -> None:
    """The pose that decides, larger, with its forces."""
    wide, tall = look.size_of(axes)
    w, h = _INSET[0] / wide, _INSET[1] / tall
    left = 1 - w - 0.01 if found.found.descending else 0.01
    inset = axes.inset_axes((left, 1 - h - 0.01, w, h), zorder=12)
    row = found.governing_row
    stand, run = stand_at(found, row), found.found.run
    body = side_view.around(found.found.outline, stand)
    middle, span = (body.min(axis=0) + body.max(axis=0)) / 2, np.ptp(body, axis=0)
    half_w = max(span[0], span[1] * w * wide / (h * tall)) / 2 * 1.22 + 0.03
    half_h = half_w * (h * tall) / (w * wide)
    inset.set_xlim(middle[0] - half_w, middle[0] + half_w)
    inset.set_ylim(middle[1] - half_h, middle[1] + half_h)
    inset.set_xticks([])
    inset.set_yticks([])
    inset.set_facecolor("white")
    profile, margins = found.found.profile, run.margins
    side_view.draw_ground(inset, profile.points, profile.nosings)
    side_view.draw_robot(inset, found.found.outline, stand, "strong")
    assert margins is not None
    kappa = float(margins[row, 17])
    side_view.draw_forces(inset, stand, found.forces_at(row), kappa, 0.62 * half_h)
    side_view.draw_centroid(inset, stand, 5.0)
    friction = float(margins[row, 0])
    needs = f"needs friction {friction:.2f}" if math.isfinite(friction) else "no friction holds it"
    if found.moves and found.moves[-1].kind == "falls" and row == len(run.poses) - 1:
        needs = "here it falls"
    place = f", step {found.ruling.step}" if found.ruling.step else ""
    inset.set_title(
        f"decides: {found.phase_of_pose[row]}{place}; {needs}",
        fontsize=look.SMALL,
        pad=2.5,
        loc="right" if found.found.descending else "left",
    )


def _legs(leg: look.Array | NDArray[np.str_]) -> list[tuple[int, int]]:
    """Slices of rows between changes: releases, phases."""
    cuts = [0, *(np.flatnonzero(leg[1:] != leg[:-1]) + 1).tolist(), len(leg)]
    return list(pairwise(cuts))


def _phases(axes: Axes, found: Journey, *, named: bool) -> None:
    x, phase = found.found.run.x, found.phase_of_pose
    for start, end in _legs(phase):
        name, low, high = str(phase[start]), float(x[start:end].min()), float(x[start:end].max())
        if name in _TINTS:
            axes.axvspan(low, high, facecolor=_TINTS[name], edgecolor="none", zorder=0)
        if named and high - low > _ROOM_FOR_NAME * float(np.ptp(x)):
            axes.text(
                (low + high) / 2,
                1.015,
                name,
                transform=axes.get_xaxis_transform(),
                ha="center",
                va="bottom",
                fontsize=look.SMALL,
                color=look.GREY,
            )


def _along(axes: Axes, found: Journey, values: look.Array, color: str, style: str = "-") -> None:
    x = found.found.run.x
    legs = _legs(found.found.run.poses[:, 15])
    for start, end in legs:
        axes.plot(x[start:end], values[start:end], color=color, linestyle=style, zorder=3)
    for (_, end), (start, _) in pairwise(legs):
        axes.plot(
            [x[end - 1], x[start]],
            [values[end - 1], values[start]],
            color=color,
            linewidth=0.7,
            linestyle=":",
            zorder=2,
        )


def _level(axes: Axes, value: float, text: str, color: str = look.VERMILION) -> None:
    axes.axhline(value, color=color, linewidth=0.9, linestyle="--", zorder=2)
    axes.annotate(
        text,
        xy=(0.995, value),
        xycoords=("axes fraction", "data"),
        xytext=(0, 1.5),
        textcoords="offset points",
        ha="right",
        va="bottom",
        fontsize=look.SMALL,
        color=color,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.75},
        zorder=4,
    )


def _inclination(axes: Axes, found: Journey) -> None:
    values = np.degrees(found.found.run.inclination)
    low, high = float(values.min()), float(values.max())
    axes.set_ylim(low - 0.08 * (high - low) - 1, high + 0.22 * (high - low) + 1)
    _along(axes, found, values, look.BLUE)
    axes.set_ylabel(f"{found.leading} up [°]")
    apart = np.diff(found.found.profile.nosings, axis=0)
    if len(apart):  # the middle one of all steps: a landing between flights does not count
        angle = math.degrees(float(np.median(np.arctan2(apart[:, 1], apart[:, 0]))))
        _level(axes, angle, f"stairs {look.signed(angle, 1)}°", look.GREY)


def _energy(axes: Axes, found: Journey) -> None:
    margins = found.found.run.margins
    assert margins is not None
    threshold = found.ruling.grades.energy_threshold_mm
    downhill = -1.0 if found.found.descending else 1.0
    values = np.maximum(found.energy, 0.0)
    axes.set_yscale("symlog", linthresh=1.0, linscale=0.5)
    axes.set_ylim(0.0, max(200.0, 1.4 * float(np.nanmax(values, initial=0.0))))
    axes.set_yticks([0, 1, 10, 100], ["0", "1", "10", "100"])
    axes.minorticks_off()
    _along(axes, found, values, look.GREY, ":")
    _along(axes, found, np.where(margins[:, 11] == downhill, values, np.nan), look.BLUE)
    axes.set_ylabel("energy\nmargin [mm]")
    if (margins[:, 11] != downhill).any():
        axes.text(
            0.006,
            0.3,
            "dotted: over the uphill end",
            transform=axes.transAxes,
            color=look.GREY,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
            zorder=4,
        )
    _level(axes, threshold, f"$v^2/2g$ = {threshold:.2f} mm")


def _friction(axes: Axes, found: Journey) -> None:
    values = found.friction
    finite = values[np.isfinite(values)]
    surface = found.case.surface
    highest = float(finite.max()) if len(finite) else 1.0
    stated = 0.0 if surface is None else surface.friction_high
    top = min(max(1.25 * highest, 1.3 * min(stated, 2.0), 0.5), 3.0)
    axes.set_ylim(0.0, top)
    _along(axes, found, np.minimum(values, 2 * top), look.BLUE)
    axes.set_ylabel("required\nfriction")
    if surface is None:
        axes.text(
            0.995,
            0.95,
            "friction not stated",
            transform=axes.transAxes,
            ha="right",
            va="top",
            color=look.GREY,
        )
    elif surface.friction_low > 0.9 * top:
        axes.text(
            0.995,
            0.95,
            f"stated: more than this, {surface.friction_low:g}",
            transform=axes.transAxes,
            ha="right",
            va="top",
            fontsize=look.SMALL,
            color=look.VERMILION,
        )
    elif surface.friction_low == surface.friction_high:
        _level(axes, surface.friction_low, f"stated {surface.friction_low:g}")
    else:
        axes.axhspan(
            surface.friction_low, surface.friction_high, **look.fill("band") | {"alpha": 0.25}
        )
        span = f"stated {surface.friction_low:g}–{surface.friction_high:g}"
        _level(axes, surface.friction_low, span)
