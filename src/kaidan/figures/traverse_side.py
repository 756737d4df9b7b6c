"""Side view of a traverse: its poses, their names, and the pose that decides with its forces."""

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.text import Text

from kaidan.figures import side_view
from kaidan.figures import style as look
from kaidan.figures.side_view import Stand, stand_at, stand_of

if TYPE_CHECKING:
    from kaidan.verbs.traverse_report import LogEntryShown, PartShown, TraverseReport

_INSET = (2.3, 1.45)
"""Size of the picture of the pose that decides [in]."""
_TALLEST = 4.4
_APART, _NEAR = 0.8, 0.5
"""Distance of poses that do not hide each other, in lengths of the robot; least distance of start,
end and rotations."""
_SEEN = 0.5
"""Rotation that can be seen in a side view [deg]."""
_FALLEN = 35.0
"""How far into a fall the robot is drawn [deg]."""


class Shown(NamedTuple):
    """A pose of the figure."""

    stand: Stand
    text: str
    style: str
    outline: "tuple[PartShown, ...]"


def view_of(found: "TraverseReport", width: float) -> tuple[float, float, float, float]:
    """Limits of the side view: the whole path, and room for the inset in its empty corner.

    width: of the view [in].

    (left, right, bottom, top): [m]
    """
    points, poses = np.array(found.profile.points_m), found.poses
    back, ahead = side_view.reach(found.outline)
    x, z = np.array(poses.x_m), np.array(poses.z_m)
    ends = [_at(found, 0, "", ""), _at(found, -1, "", ""), *_rotated(found)]
    bounds = np.concatenate([side_view.around(each.outline, each.stand) for each in ends])
    inner = points[1:-1] if len(points) > 3 else points
    wide = np.concatenate([bounds[:, 0], x, inner[:, 0]])
    left, right = float(wide.min()) - 0.06, float(wide.max()) + 0.06
    if not found.arrived:  # what it never reached is no matter
        right = min(right, float(x.max()) + 2.2 * (back + ahead))
    seen = points[(points[:, 0] >= left) & (points[:, 0] <= right)]
    floor = points[0, 1] if len(seen) == 0 else float(seen[:, 1].min())
    bottom = min(floor, float(z.min()) - max(back, ahead) / 2) - 0.05 * (right - left)
    per_inch = (right - left) / width
    # the outline never rises above this line of the path
    lean = np.abs(np.sin(np.radians(poses.inclination_deg)))
    line = np.column_stack([x, z + (back + ahead) * (0.25 + 0.55 * lean)])
    tops = np.concatenate([bounds, line, seen])
    w, h = (_INSET[0] + 0.15) * per_inch, (_INSET[1] + 0.32) * per_inch
    down = found.question.direction == "down"
    near = tops[:, 0] > right - w - 0.1 if down else tops[:, 0] < left + w + 0.1
    under = float(tops[near, 1].max()) if near.any() else bottom
    top = max(float(tops[:, 1].max()) + 0.1 * per_inch, under + h)
    if top - bottom > _TALLEST * per_inch:  # a high path: let it be as wide as it must
        more = (top - bottom) / _TALLEST * width - (right - left)
        left, right = left - more / 2, right + more / 2
    return left, right, bottom, top


def _rotated(found: "TraverseReport") -> list[Shown]:
    """Pose in which the largest rotation, or the fall, ends."""
    if not found.rotations:
        return []
    ends = []
    last = found.rotations[-1]
    if not found.arrived and not last.arrested:
        share = min(1.0, _FALLEN / last.angle_deg)
        fallen = last.placements[round(share * (len(last.placements) - 1))]
        ends.append(Shown(stand_of(fallen), "falls", "after", found.outline_at(last.row)))
    seen = [each for each in found.rotations if each.arrested and each.angle_deg > _SEEN]
    if seen:
        governing = [each for each in seen if each.row == found.poses.governing_row]
        for each in (max(seen, key=lambda each: each.angle_deg), *governing):
            outline = found.outline_at(each.row)
            shown = Shown(stand_of(each.placements[-1]), "", "after", outline)
            ends += [] if shown in ends else [shown]
    return ends


def _at(found: "TraverseReport", row: int, text: str, style: str) -> Shown:
    """A pose of the path."""
    return Shown(stand_at(found, row), text, style, found.outline_at(row))


def chosen(found: "TraverseReport", poses: int | None) -> list[Shown]:
    """Poses to draw: the one that decides, changes of posture, start, end, each kind of event.

    None is drawn over another.
    """
    length = sum(side_view.reach(found.outline))
    count = len(found.poses.x_m)
    shown = [_at(found, found.poses.governing_row, "decides", "strong")]

    def free(stand: Stand, share: float) -> bool:
        return all(
            math.hypot(stand.x - other.stand.x, stand.z - other.stand.z) >= share * length
            for other in shown
        )

    for move in found.moves:
        after = move.poses[-1] if move.poses else None
        if after is not None and free(stand_of(after.placement), _NEAR):
            stand = stand_of(after.placement)
            shown.append(Shown(stand, "changes posture", "ghost", after.outline))
    for row, text in ((0, "start"), (count - 1, "end")):
        if free(stand_at(found, row), _NEAR):
            shown.append(_at(found, row, text, "ghost"))
    kinds: tuple[tuple[tuple[str, ...], float], ...] = (
        (("drops", "rises"), _NEAR),
        (("rests",), _APART),
        (("passes",), _APART),
    )
    for names, share in kinds:
        entries = [entry for entry in found.event_log if entry.kind in names]
        for entry in sorted(entries, key=lambda entry: -entry.rotation_deg):
            stand = stand_at(found, entry.row)
            if free(stand, share):
                shown.append(_at(found, entry.row, _word(found, entry), "ghost"))
                break
    most = len(shown) if poses is None else poses
    rows = np.linspace(0, count - 1, 4 * most + 2).round().astype(int).tolist()
    for row in rows if poses is not None else ():
        if len(shown) < most and free(stand_at(found, row), _APART):
            shown.append(_at(found, row, "", "ghost"))
    return shown[:most]


def _word(found: "TraverseReport", entry: "LogEntryShown") -> str:
    if entry.kind == "rests":
        return f"{found.trailing} rests"
    if entry.kind == "passes":
        return "contact passes"
    return f"{found.leading} {entry.kind} {entry.rotation_deg:.1f}°"


def draw_side(axes: Axes, found: "TraverseReport", poses: int | None) -> None:
    """Draw the terrain, chosen poses with their names, the path, and the inset."""
    axes.set_aspect("equal", adjustable="box")
    axes.set_axis_off()
    side_view.draw_ground(axes, found.profile)
    words: list[Text] = []
    for each in [*chosen(found, poses), *_rotated(found)]:
        side_view.draw_robot(axes, each.outline, each.stand, each.style)
        side_view.draw_centroid(axes, each.stand, 3.2)
        if each.text:
            _name(axes, found, each, words)
    x, z = np.array(found.poses.x_m), np.array(found.poses.z_m)
    for start, end in look.stretches(found.poses.leg):
        axes.plot(x[start:end], z[start:end], color=look.BLUE, linewidth=1.0, zorder=6)
    for rotation in found.rotations:
        if rotation.arrested and rotation.angle_deg > 0.05:
            first, last = rotation.placements[0], rotation.placements[-1]
            axes.plot(
                [first.x_m, last.x_m], [first.z_m, last.z_m], color=look.VERMILION, linewidth=0.9,
                linestyle=(0, (2, 1.5)), zorder=6,
            )  # fmt: skip
    _draw_inset(axes, found)


def _name(axes: Axes, found: "TraverseReport", shown: Shown, words: list[Text]) -> None:
    """Word beside a robot, on the side that the path leaves free."""
    around = side_view.around(shown.outline, shown.stand)
    down = found.question.direction == "down"
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


def _draw_inset(axes: Axes, found: "TraverseReport") -> None:
    """The pose that decides, larger, with its forces."""
    wide, tall = look.size_of(axes)
    w, h = _INSET[0] / wide, _INSET[1] / tall
    down = found.question.direction == "down"
    inset = axes.inset_axes((1 - w - 0.01 if down else 0.01, 1 - h - 0.01, w, h), zorder=12)
    row = found.poses.governing_row
    stand = stand_at(found, row)
    outline = found.outline_at(row)
    body = side_view.around(outline, stand)
    middle, span = (body.min(axis=0) + body.max(axis=0)) / 2, np.ptp(body, axis=0)
    half_w = max(span[0], span[1] * w * wide / (h * tall)) / 2 * 1.22 + 0.03
    half_h = half_w * (h * tall) / (w * wide)
    inset.set_xlim(middle[0] - half_w, middle[0] + half_w)
    inset.set_ylim(middle[1] - half_h, middle[1] + half_h)
    inset.set_xticks([])
    inset.set_yticks([])
    inset.set_facecolor("white")
    side_view.draw_ground(inset, found.profile)
    side_view.draw_robot(inset, outline, stand, "strong")
    tilt = found.poses.gravity_tilt[row] or 0.0
    side_view.draw_forces(inset, stand, found.poses.forces[row], tilt, 0.62 * half_h)
    side_view.draw_centroid(inset, stand, 5.0)
    step = found.assessment.step
    place = f", step {step}" if step else ""
    inset.set_title(
        f"decides: {found.poses.phase[row]}{place}; {_needs(found, row)}",
        fontsize=look.SMALL,
        pad=2.5,
        loc="right" if down else "left",
    )


def _needs(found: "TraverseReport", row: int) -> str:
    if found.event_log and found.event_log[-1].kind == "falls" and row == len(found.poses.x_m) - 1:
        return "here it falls"
    friction = found.poses.required_friction[row]
    return "no friction holds it" if friction is None else f"needs friction {friction:.2f}"
