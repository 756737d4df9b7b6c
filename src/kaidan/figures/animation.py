"""A traverse as a film: the robot drives at its speed, rotates and falls on its path.

The model is quasi-static and knows no time in a rotation; it is shown in the time that a fall over
that angle takes, at most half a second.
"""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.path import Path as Outlined

from kaidan.figures import side_view
from kaidan.figures import style as look
from kaidan.figures.side_view import Stand, stand_at, stand_of
from kaidan.films import FRAMES_PER_SECOND, film_bytes
from kaidan.modes import Verdict
from kaidan.progress import progress
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.verbs.traverse_report import MoveShown, PartShown, RotationShown, TraverseReport

LONGEST = 20.0
"""Most seconds of a film: a slower traverse is sped up."""
SLOWEST = 0.1
"""Speed where none is stated [m/s]: the paper's."""
_DPI = 128
_SIZE = (7.0, 4.5)
_ROTATION = 0.5
"""How long a rotation over `_FALL` takes [s]."""
_FALL = 60.0
"""[deg]"""
_SEEN = 0.06
"""Rotation that can be seen in a film [deg]."""
_REST = 0.6
"""How long the last pose stands [s]."""


class Frame(NamedTuple):
    """A frame of the film."""

    stand: Stand
    row: int
    """Row of the pose it shows or last showed."""
    rotating: bool
    outline: "tuple[PartShown, ...]"
    """Underside of the robot."""


def film_of(found: "TraverseReport", suffix: str) -> bytes:
    """Film of a traverse; `suffix` as `kaidan.films.film_format` gives it."""
    with look.settings():
        return film_bytes(_pictures(found), suffix, what="animation")


def _pictures(found: "TraverseReport") -> Iterator[Any]:
    frames = frames_of(found)
    stage = _Stage(found, frames[-1])
    for frame in progress(frames, "film"):
        stage.show(frame)
        yield stage.pixels()


def speed_up(found: "TraverseReport") -> float:
    """How many times faster than the stated speed the film runs."""
    speed = found.question.speed or SLOWEST
    return max(1.0, found.poses.path_m[-1] / speed / LONGEST)


def frames_of(found: "TraverseReport") -> list[Frame]:
    """All frames: evenly in time along the path, with the rotations between."""
    poses = found.poses
    s = np.array(poses.path_m)
    placements = np.array([poses.x_m, poses.z_m, np.radians(poses.inclination_deg)])
    pace = (found.question.speed or SLOWEST) * speed_up(found) / FRAMES_PER_SECOND
    frames = []
    for first, end in look.stretches(poses.leg):
        leg = slice(first, end)
        for place in np.arange(s[first], s[end - 1] + 1e-12, pace):
            stand = Stand(*(float(np.interp(place, s[leg], each[leg])) for each in placements))
            row = first + min(int(np.searchsorted(s[leg], place, side="right")), end - first) - 1
            frames.append(Frame(stand, row, False, found.outline_at(row)))
        for rotation in found.rotations:
            if rotation.row == end - 1 and not (rotation.arrested and rotation.angle_deg < _SEEN):
                outline = found.outline_at(end - 1)
                frames += [Frame(stand, end - 1, True, outline) for stand in _rotated(rotation)]
        for move in found.moves:
            if move.row == end - 1:
                frames += _changed(move, speed_up(found))
    last = Frame(stand_at(found, -1), len(s) - 1, False, found.outline_at(-1))
    last = frames[-1] if frames and not found.arrived else last
    return frames + [last] * round(_REST * FRAMES_PER_SECOND)


def _changed(move: "MoveShown", faster: float) -> Iterator[Frame]:
    """Frames of a change of posture, at the flippers' speed."""
    seconds = _REST if move.time_s is None else move.time_s / faster
    count = max(1, round(seconds * FRAMES_PER_SECOND / max(len(move.poses), 1)))
    for pose in move.poses:
        yield from [Frame(stand_of(pose.placement), move.row, False, pose.outline)] * count


def _rotated(rotation: "RotationShown") -> Iterator[Stand]:
    """Stands of a rotation, faster and faster."""
    stands = np.array([stand_of(each) for each in rotation.placements])
    known = np.linspace(0.0, 1.0, len(stands))
    count = max(3, round(FRAMES_PER_SECOND * _ROTATION * math.sqrt(rotation.angle_deg / _FALL)))
    for share in (np.arange(1, count + 1) / count) ** 2:
        yield Stand(*(float(np.interp(share, known, column)) for column in stands.T))


class _Stage:
    """Figure in which only the robot, its contacts and one line of text change."""

    def __init__(self, found: "TraverseReport", last: Frame) -> None:
        self.report = found
        self.figure = look.blank(_SIZE[1], _SIZE[0])
        self.figure.set_dpi(_DPI)
        axes = self.figure.add_axes((0.0, 0.0, 1.0, 0.88))
        self.reach = sum(side_view.reach(found.outline))
        _set_view(axes, found, last, self.reach)
        axes.set_axis_off()
        side_view.draw_ground(axes, found.profile)
        poses = found.poses
        axes.plot(poses.x_m, poses.z_m, color=look.BLUE, linewidth=0.6, alpha=0.5, zorder=2.6)
        self.robot = side_view.draw_robot(axes, found.outline, stand_at(found, 0), "strong")
        (self.points,) = axes.plot([], [], ls="", marker="o", ms=4, color=look.VERMILION, zorder=9)
        (self.com,) = axes.plot([], [], ls="", marker="o", ms=5, mfc="white",
                                mec=look.BLACK, zorder=8)  # fmt: skip
        (self.plumb,) = axes.plot([], [], color=look.BLACK, lw=0.7, ls="-.", zorder=6)
        faster = speed_up(found)
        speed = f"{found.question.speed or SLOWEST:g} m/s"
        speed += "" if faster == 1 else f", {faster:.1f} x faster"
        self.figure.text(
            0.02, 0.95,
            f"{look.named(subject(found.question), 70)}: "
            f"{Verdict(found.assessment.verdict).label} ({speed})",
            weight="bold", fontsize=9.0,
        )  # fmt: skip
        self.caption = self.figure.text(0.02, 0.9, "")

    def show(self, frame: Frame) -> None:
        """Set the stage for a frame."""
        poses, stand, row = self.report.poses, frame.stand, frame.row
        for patch, part in zip(self.robot, side_view.drawn_parts(frame.outline), strict=True):
            patch.set_path(Outlined(side_view.placed(side_view.hull(part), stand)))
            patch.set_edgecolor(look.VERMILION if frame.rotating else look.BLACK)
        self.com.set_data([stand.x], [stand.z])
        self.plumb.set_data([stand.x, stand.x], [stand.z, stand.z - 0.6 * self.reach])
        x = (poses.rear_contact_x_m[row], poses.front_contact_x_m[row])
        z = (poses.rear_contact_z_m[row], poses.front_contact_z_m[row])
        self.points.set_data(((), ()) if frame.rotating else (x, z))
        friction = poses.required_friction[row]
        needs = "nothing holds it" if friction is None else f"needs friction {friction:.2f}"
        self.caption.set_text(
            f"{poses.phase[row]}: {self.report.leading} up "
            f"{look.signed(math.degrees(stand.phi), 1)}°, "
            + ("rotating" if frame.rotating else needs)
        )

    def pixels(self) -> Any:
        """Picture as an array of bytes, width and height multiples of 16."""
        canvas: Any = self.figure.canvas
        canvas.draw()
        image = np.asarray(canvas.buffer_rgba())[:, :, :3]
        return image[: image.shape[0] // 16 * 16, : image.shape[1] // 16 * 16].copy()


def _set_view(axes: Axes, found: "TraverseReport", last: Frame, reach: float) -> None:
    """Limits that hold the path, the robot at its ends, and the shape of the axes."""
    ends = np.concatenate(
        [side_view.around(found.outline_at(row), stand_at(found, row)) for row in (0, -1)]
        + [side_view.around(last.outline, last.stand)]
        + [np.column_stack([found.poses.x_m, found.poses.z_m])]
    )
    (left, low), (right, high) = ends.min(axis=0), ends.max(axis=0)
    left, right, low, high = left - 0.1, right + 0.1, low - 0.3 * reach, high + 0.45 * reach
    ratio = _SIZE[0] / (0.88 * _SIZE[1])
    if (right - left) / (high - low) < ratio:
        more = ((high - low) * ratio - (right - left)) / 2
        left, right = left - more, right + more
    else:
        more = ((right - left) / ratio - (high - low)) / 2
        low, high = low - more, high + more
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
