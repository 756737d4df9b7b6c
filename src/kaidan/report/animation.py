"""The way as a film: the robot drives at its speed, swings and falls on the way.

The model is quasi-static and knows no time in a swing; it is shown in the time that a fall over
that angle takes, at most half a second.
"""

import math
import tempfile
from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outlined

from kaidan.contact.turning import turned
from kaidan.errors import InputError, MissingExtraError
from kaidan.report import look, side_view
from kaidan.report.journey import Journey
from kaidan.report.progress import progress
from kaidan.report.side_view import Stand

FRAMES_PER_SECOND = 25
LONGEST = 20.0
"""Most seconds of a film: a slower way is sped up."""
SLOWEST = 0.1
"""Speed where none is stated [m/s]: the paper's."""
FORMATS = (".mp4", ".gif")
_DPI = 128
_SIZE = (7.0, 4.5)
_SWING = 0.5
_FALL = math.radians(60.0)
_REST = 0.6
"""How long the last pose stands [s]."""


class Frame(NamedTuple):
    """A frame of the film."""

    stand: Stand
    row: int
    """Row of the pose it shows or last showed."""
    turning: bool


def writer_for(path: Path) -> Callable[[Journey], bytes]:
    """What makes the bytes of a film with that suffix.

    Raises
    ------
    InputError
        Another suffix than .mp4 or .gif.
    MissingExtraError
        imageio or imageio-ffmpeg is not installed (.mp4 only).
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        what = f"unknown suffix {path.suffix!r}" if path.suffix else "no suffix"
        raise InputError(f"animation {str(path)!r}: {what}; known: {', '.join(FORMATS)}")
    if suffix == ".mp4":
        if find_spec("imageio") is None or find_spec("imageio_ffmpeg") is None:
            raise MissingExtraError("a film as .mp4", "video")
        return mp4_bytes
    return gif_bytes


def speed_up(found: Journey) -> float:
    """How many times faster than the stated speed the film runs."""
    speed = found.case.speed or SLOWEST
    return max(1.0, float(found.found.run.s[-1]) / speed / LONGEST)


def frames_of(found: Journey) -> list[Frame]:
    """All frames: evenly in time along the way, with the swings between."""
    run = found.found.run
    s, leg = run.s, run.poses[:, 15]
    pace = (found.case.speed or SLOWEST) * speed_up(found) / FRAMES_PER_SECOND
    frames = []
    for number in np.unique(leg):
        rows = np.flatnonzero(leg == number)
        places = np.arange(s[rows[0]], s[rows[-1]] + 1e-12, pace)
        for place in places:
            stand = Stand(
                *(float(np.interp(place, s[rows], run.poses[rows, k])) for k in (1, 2, 3))
            )
            row = int(rows[min(np.searchsorted(s[rows], place, side="right"), len(rows)) - 1])
            frames.append(Frame(stand, row, False))
        ends = np.flatnonzero(np.abs(run.releases[:, 1] - s[rows[-1]]) < 1e-9)
        for release in run.releases[ends] if number == leg[rows[-1]] else ():
            if release[9] > 1e-3 or release[15] != 0.0:
                frames += [Frame(stand, int(rows[-1]), True) for stand in _turn(found, release)]
    last = Frame(Stand(*(float(v) for v in run.poses[-1, 1:4])), len(s) - 1, False)
    last = frames[-1] if frames and not found.found.arrived else last
    return frames + [last] * round(_REST * FRAMES_PER_SECOND)


def _turn(found: Journey, release: look.Array) -> Iterator[Stand]:
    """Poses of a release, faster and faster."""
    run, falls = found.found.run, release[15] != 0.0
    x, z, phi = (float(v) for v in release[3:6])
    angle = _FALL if falls else float(release[9])
    count = max(3, round(FRAMES_PER_SECOND * _SWING * math.sqrt(angle / _FALL)))
    for share in (np.arange(1, count + 1) / count) ** 2:
        if falls:
            part = float(share * angle * release[0])
            p_x, p_z = turned(run.ground, run.body, int(release[2]), x, z, phi, part)
            yield Stand(p_x, p_z, phi + part)
        else:
            yield Stand(*(float((1 - share) * release[3 + k] + share * release[6 + k])
                          for k in range(3)))  # fmt: skip


def gif_bytes(found: Journey) -> bytes:
    """Film as GIF, through Pillow."""
    writer = PillowWriter(fps=FRAMES_PER_SECOND)
    with tempfile.TemporaryDirectory() as folder, look.settings():
        file = Path(folder) / "film.gif"
        stage = _Stage(found)
        with writer.saving(stage.figure, str(file), _DPI * 0.75):
            for frame in progress(frames_of(found), "film"):
                stage.show(frame)
                writer.grab_frame()
        return file.read_bytes()


def mp4_bytes(found: Journey) -> bytes:
    """Film as MP4 (H.264), through imageio and its ffmpeg."""
    try:
        imageio: Any = import_module("imageio.v2")
    except ImportError:
        raise MissingExtraError("a film as .mp4", "video") from None
    with tempfile.TemporaryDirectory() as folder, look.settings():
        file = Path(folder) / "film.mp4"
        stage = _Stage(found)
        with imageio.get_writer(
            file, fps=FRAMES_PER_SECOND, codec="libx264", quality=7, macro_block_size=16
        ) as film:
            for frame in progress(frames_of(found), "film"):
                stage.show(frame)
                film.append_data(stage.pixels())
        return file.read_bytes()


class _Stage:
    """Figure in which only the robot, its contacts and one line of text change."""

    def __init__(self, found: Journey) -> None:
        from kaidan.report.traverse_figure import stand_at

        self.found = found
        outline, profile, run = found.found.outline, found.found.profile, found.found.run
        self.figure: Figure = look.blank(_SIZE[1], _SIZE[0])
        self.figure.set_dpi(_DPI)
        axes = self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 0.88))
        ends = np.concatenate(
            [side_view.around(outline, stand_at(found, row)) for row in (0, -1)]
            + [np.column_stack([run.x, run.z])]
            + [side_view.around(outline, frame.stand) for frame in frames_of(found)[-1:]]
        )
        reach = sum(outline.reach)
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
        axes.set_axis_off()
        side_view.draw_ground(axes, profile.points, profile.nosings)
        axes.plot(run.x, run.z, color=look.BLUE, linewidth=0.6, alpha=0.5, zorder=2.6)
        self.robot: list[PathPatch] = side_view.draw_robot(
            axes, outline, stand_at(found, 0), "strong"
        )
        self.order = _drawn_parts(found)
        (self.points,) = axes.plot([], [], ls="", marker="o", ms=4, color=look.VERMILION, zorder=9)
        (self.com,) = axes.plot([], [], ls="", marker="o", ms=5, mfc="white",
                                mec=look.BLACK, zorder=8)  # fmt: skip
        (self.plumb,) = axes.plot([], [], color=look.BLACK, lw=0.7, ls="-.", zorder=6)
        case = found.case
        faster = speed_up(found)
        pace = f"{case.speed or SLOWEST:g} m/s" + (
            "" if faster == 1 else f", {faster:.1f} x faster"
        )
        self.figure.text(
            0.02, 0.95,
            f"{look.named(case.robot.name)} on {look.named(case.stairs.name)}, {case.direction} "
            f"{case.facing.replace('-', ' ')}: {found.ruling.verdict.upper()} ({pace})",
            weight="bold", fontsize=9.0,
        )  # fmt: skip
        self.told = self.figure.text(0.02, 0.9, "")

    def show(self, frame: Frame) -> None:
        """Set the stage for a frame."""
        run, stand = self.found.found.run, frame.stand
        outline = self.found.found.outline
        for patch, k in zip(self.robot, self.order, strict=True):
            patch.set_path(Outlined(side_view.placed(side_view.hull(outline.parts[k]), stand)))
            patch.set_edgecolor(look.VERMILION if frame.turning else look.BLACK)
        self.com.set_data([stand.x], [stand.z])
        self.plumb.set_data([stand.x, stand.x], [stand.z, stand.z - 0.6 * sum(outline.reach)])
        pose = run.poses[frame.row]
        shown = not frame.turning
        self.points.set_data(([pose[6], pose[8]], [pose[7], pose[9]]) if shown else ([], []))
        friction = self.found.friction[frame.row]
        needs = f"needs friction {friction:.2f}" if math.isfinite(friction) else "nothing holds it"
        phase = self.found.phase_of_pose[frame.row]
        self.told.set_text(
            f"{phase}: {self.found.leading} up {look.signed(math.degrees(stand.phi), 1)}°, "
            + ("turning" if frame.turning else needs)
        )

    def pixels(self) -> Any:
        """Picture as an array of bytes, even in width and height."""
        canvas: Any = self.figure.canvas
        canvas.draw()
        image = np.asarray(canvas.buffer_rgba())[:, :, :3]
        return image[: image.shape[0] // 16 * 16, : image.shape[1] // 16 * 16]


def _drawn_parts(found: Journey) -> list[int]:
    """Parts in the order in which `side_view.draw_robot` draws them."""
    from kaidan.contact import BELLY, FLIPPER

    kinds = found.found.outline.kinds
    order = sorted(range(len(kinds)), key=lambda k: kinds[k] == FLIPPER)
    return [k for k in order if kinds[k] != BELLY]
