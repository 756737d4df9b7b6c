"""What was found in a file: a robot from the side with its lengths, or flights over the data."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from kaidan.figures import style as look
from kaidan.figures.dimension_lines import dimension, label

if TYPE_CHECKING:
    from kaidan.verbs.read import FileAnswer
    from kaidan.verbs.read_robot import RobotRead
    from kaidan.verbs.read_stairs import FlightRead, StaircaseRead

MOST_FLIGHTS = 6
"""Flights that one picture shows."""


def read_figure(found: "FileAnswer") -> Figure:
    """Robot of a file with L, C_L, C_N and both R; or its flights over the data, with residuals."""
    with look.settings():
        if found.robots and found.robots[0].view is not None:
            return _robot(found.robots[0])
        return _stairs(found)


def drawable(found: "FileAnswer") -> bool:
    """Whether there is anything to draw."""
    return bool(found.staircases) or any(each.view is not None for each in found.robots)


def _robot(robot: "RobotRead") -> Figure:
    view, at = robot.view, {each.field: each.value or 0.0 for each in robot.figures}
    assert view is not None
    L, C_L, C_N = at["track.flat_length"], at["com_from_front"], at["com_height"]
    figure = look.blank(4.2)
    axes = figure.add_axes((0.02, 0.02, 0.96, 0.84))
    axes.set_aspect("equal")
    axes.axis("off")
    for shapes, face, edge, order in (
        (view.body, "#efefef", look.GREY, 2),
        (view.tracks, "#dcebf5", look.BLACK, 3),
        (view.flippers, "#f6e3cf", look.BLACK, 4),
    ):
        for shape in shapes:
            axes.add_patch(
                Polygon(np.array(shape), facecolor=face, edgecolor=edge, lw=0.6, zorder=order)
            )
    axes.axhline(0.0, color=look.GREY, linewidth=0.8, zorder=1)
    axes.plot([0.0, -L], [0.0, 0.0], color=look.BLUE, linewidth=2.6, zorder=6)
    axes.plot([0.0, -L], [0.0, 0.0], ls="", marker="o", ms=4, mfc="white", mec=look.BLUE, zorder=7)
    for end, name in ((0.0, "track.front_radius"), (-L, "track.rear_radius")):
        if at[name] > 0.0:
            reach = np.array([[end, at[name]], [end, 0.0]])
            axes.plot(*reach.T, color=look.BLACK, linewidth=0.8, zorder=7)
            axes.plot(end, at[name], ls="", marker="+", ms=5, color=look.BLACK, zorder=7)
    every = np.concatenate([*view.tracks, *view.flippers, *view.body])
    low, high = every.min(axis=0), every.max(axis=0)
    unit = float(high[0] - low[0]) / 14
    axes.plot([-C_L, -C_L], [-0.7 * unit, C_N], color=look.BLACK, lw=0.8, ls="-.", zorder=8)
    axes.plot(-C_L, C_N, ls="", marker="o", ms=7, mfc="white", mec=look.BLACK, zorder=9)
    axes.plot(-C_L, C_N, ls="", marker=".", ms=4, color=look.BLACK, zorder=9)
    down = np.array([0.0, -1.0])
    dimension(
        axes, np.array([-L, -1.9 * unit]), np.array([0.0, -1.9 * unit]),
        f"$L$  {1e3 * L:.0f} mm", down, 0.45 * unit,
    )  # fmt: skip
    dimension(
        axes, np.array([-C_L, -0.7 * unit]), np.array([0.0, -0.7 * unit]),
        f"$C_L$  {1e3 * C_L:.0f} mm", down, 0.45 * unit,
    )  # fmt: skip
    beside = low[0] - 0.8 * unit  # clear of the robot, whatever stands about the centroid
    axes.plot([beside, -C_L], [C_N, C_N], color=look.BLACK, lw=0.5, ls=":", zorder=8)
    dimension(axes, np.array([beside, 0.0]), np.array([beside, C_N]), "", down)
    label(axes, np.array([beside - 0.25 * unit, C_N / 2]), f"$C_N$  {1e3 * C_N:.0f} mm",
          align="right")  # fmt: skip
    axes.set_xlim(beside - 2.9 * unit, high[0] + 0.6 * unit)
    axes.set_ylim(-3.0 * unit, max(high[1], C_N) + 0.8 * unit)
    mass = f"{at['mass']:.1f} kg, " if "mass" in at else ""
    R = [f"{1e3 * at[f'track.{end}_radius']:.0f}" for end in ("front", "rear")]
    look.title(
        figure, 0.1, look.named(robot.title or robot.name, 70),
        f"{mass}R front {R[0]}, rear {R[1]} mm; front on the right; tracks blue"
        + (", flippers brown" if view.flippers else ""),
    )  # fmt: skip
    return figure


def _stairs(found: "FileAnswer") -> Figure:
    several = len(found.staircases) > 1
    every = [
        (each, row, f"staircase {number}, flight {row + 1}: " if several else "")
        for number, each in enumerate(found.staircases, start=1)
        for row in range(len(each.flights))
    ]
    drawn = every[:MOST_FLIGHTS]
    height = 2.9 * len(drawn) + 0.9
    figure = look.blank(height)
    grid = figure.add_gridspec(
        2 * len(drawn), 2, width_ratios=(2.4, 1.0), left=0.08, right=0.985, hspace=0.75,
        top=1 - 0.75 / height, bottom=0.45 / height, wspace=0.28,
    )  # fmt: skip
    for k, (staircase, row, whose) in enumerate(drawn):
        _profile(figure.add_subplot(grid[2 * k : 2 * k + 2, 0]), staircase.flights[row], whose)
        _plan(figure.add_subplot(grid[2 * k, 1]), staircase, row)
        _residuals(figure.add_subplot(grid[2 * k + 1, 1]), staircase.flights[row])
    more = len(every) - len(drawn)
    name = f"{len(found.staircases)} staircases" if several else found.staircases[0].name
    look.title(
        figure, 0.1, look.named(f"{name}: {found.title}", 70)
        + (f", {more} more flight{'' if more == 1 else 's'} not drawn" if more else ""),
        "steps over the data, bars of one standard uncertainty; plan; residuals from uniform steps",
    )  # fmt: skip
    return figure


def _profile(axes: Axes, flight: "FlightRead", whose: str) -> None:
    """Steps over the file's points; each nosing with bars of one standard uncertainty."""
    nosings, sigmas = np.array(flight.nosings), np.array(flight.sigmas)
    if flight.points:
        axes.plot(*np.array(flight.points).T, ls="", marker=".", ms=1.2, color=look.GREY, zorder=1)
    floor = 0.0 if flight.floor_seen else nosings[0, 1] - (flight.rise_m or 0.0)
    line = [(nosings[0, 0] - 0.4, floor), (nosings[0, 0], floor)]
    for (s, z), after in zip(nosings, [*nosings[1:, 0], nosings[-1, 0] + 0.4], strict=True):
        line += [(s, z), (after, z)]
    axes.plot(*np.array(line).T, color=look.BLUE, linewidth=1.2, zorder=3)
    axes.errorbar(
        nosings[:, 0], nosings[:, 1], xerr=sigmas[:, 0], yerr=sigmas[:, 1], fmt="o", ms=2.5,
        color=look.VERMILION, elinewidth=0.9, zorder=4,
    )  # fmt: skip
    axes.set_aspect("equal")
    axes.set_xlabel("along the flight [m]")
    axes.set_ylabel("height [m]")
    if flight.rise_m is not None and flight.going_m is not None:
        axes.set_title(
            f"{whose}{flight.steps} steps, {1e3 * flight.rise_m:.1f} / "
            f"{1e3 * flight.going_m:.1f} mm, {flight.angle_deg:.1f}°", loc="left",
        )  # fmt: skip


def _plan(axes: Axes, staircase: "StaircaseRead", row: int) -> None:
    """Nosings from above, those of this flight strong."""
    for number, flight in enumerate(staircase.flights):
        strong = number == row
        for left, right in zip(flight.left, flight.right, strict=True):
            axes.plot(
                [left[0], right[0]], [left[1], right[1]], linewidth=1.2 if strong else 0.6,
                color=look.BLUE if strong else look.GREY,
            )  # fmt: skip
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


def _residuals(axes: Axes, flight: "FlightRead") -> None:
    """Residuals of the nosings from uniform steps, along the flight and up."""
    residuals = 1e3 * np.array(flight.residuals).reshape(-1, 2)
    sigmas = 1e3 * np.array(flight.sigmas)[: len(residuals)].reshape(-1, 2)
    number = np.arange(1, len(residuals) + 1)
    axes.axhline(0.0, color=look.GREY, linewidth=0.7)
    for column, (marker, colour, name) in enumerate(
        (("s", look.BLUE, "along"), ("o", look.VERMILION, "up"))
    ):
        axes.errorbar(
            number + (0.12 if column else -0.12), residuals[:, column], yerr=sigmas[:, column],
            fmt=marker, ms=2.5, color=colour, elinewidth=0.9, label=name,
        )  # fmt: skip
    least = 0.5  # whatever is smaller than half a millimetre is nothing
    reach = max(least, float(np.abs(residuals).max(initial=0.0) + sigmas.max(initial=0.0)))
    axes.set_ylim(-1.15 * reach, 1.15 * reach)
    axes.set_xlabel("nosing")
    axes.set_ylabel("residual [mm]")
    axes.legend(loc="lower right", bbox_to_anchor=(1.02, 0.96), ncols=2, frameon=False,
                handletextpad=0.1, columnspacing=0.6)  # fmt: skip
