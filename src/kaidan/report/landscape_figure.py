"""Picture of the energy landscape: valleys, ridges, the flow of a release, the driven path."""

import math
from itertools import pairwise

import numpy as np
from matplotlib.colors import BoundaryNorm, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from kaidan.report import look
from kaidan.report.landscape import Landscape

_HEIGHT = 4.9
_LEVELS = [0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0]
_SHADES = LinearSegmentedColormap.from_list("height", ["#ffffff", "#cfe0ec", "#7da7c4", "#3c5a74"])


def landscape_figure(found: Landscape) -> Figure:
    """Height above the lowest pose over place and inclination, with the flow of a release.

    Parameters
    ----------
    found : Landscape
        Heights on a grid.

    Returns
    -------
    Figure
    """
    journey = found.found
    case, run = journey.case, journey.found.run
    with look.settings():
        figure = look.blank(_HEIGHT)
        left, right, foot, top = 0.62, 1.0, 0.72, 0.5
        axes = figure.add_axes(
            (
                left / look.WIDTH,
                foot / _HEIGHT,
                1 - (left + right) / look.WIDTH,
                1 - (foot + top) / _HEIGHT,
            )
        )
        x, phi = found.x, np.degrees(found.phi)
        shades = axes.contourf(
            x,
            phi,
            np.minimum(1e3 * found.above, _LEVELS[-1] * 0.999),
            levels=_LEVELS,
            cmap=_SHADES,
            norm=BoundaryNorm(_LEVELS, _SHADES.N),
            zorder=1,
        )
        axes.set_xlim(float(x[0]), float(x[-1]))
        axes.set_ylim(float(phi[0]), float(phi[-1]))
        _flow(figure, found)
        for cells, color, style in (
            (found.ridges, look.VERMILION, (0, (4, 2))),
            (found.stable, look.BLACK, "-"),
        ):
            for line in _lines(found, cells):
                axes.plot(*line, color=color, linestyle=style, linewidth=1.1, zorder=7)
        _path(figure, found)
        box = (1 - (right - 0.12) / look.WIDTH, foot / _HEIGHT, 0.14 / look.WIDTH,
               1 - (foot + top) / _HEIGHT)  # fmt: skip
        bar = figure.colorbar(shades, cax=figure.add_axes(box), spacing="uniform")
        bar.set_ticks(_LEVELS, labels=[f"{level:g}" for level in _LEVELS])
        bar.set_label("centroid above the lowest pose there [mm]")
        axes.set_xlabel("centroid along the way [m]")
        axes.set_ylabel(f"inclination, {journey.leading} up [°]")
        handles = [
            Line2D([], [], color=look.BLACK, linewidth=1.1),
            Line2D([], [], color=look.VERMILION, linewidth=1.1, linestyle=(0, (4, 2))),
            Line2D([], [], color=look.BLUE, linewidth=2.4),
            Line2D([], [], color=look.GREY, marker=r"$\rightarrow$", ms=9, ls=""),
        ]
        texts = ["stable poses", "ridges: beyond them it turns on", "driven", "turns if let go"]
        figure.legend(
            handles,
            texts,
            loc="lower left",
            bbox_to_anchor=(left / look.WIDTH, 0.08 / _HEIGHT),
            ncols=4,
            frameon=False,
            borderpad=0.0,
            borderaxespad=0.0,
            columnspacing=1.4,
            handlelength=2.2,
        )
        part = "" if x[-1] >= run.x.max() else ", the first steps"
        look.title(
            figure,
            left,
            f"{look.named(case.robot.name)} on {look.named(case.stairs.name)}, {case.direction} "
            f"{case.facing.replace('-', ' ')}: energy landscape{part}",
            "turning about its contact moves the centroid too, so the arrows lean",
        )
    return figure


def _flow(figure: Figure, found: Landscape) -> None:
    """Arrows along which the robot turns about its contact when it is let go."""
    axes = figure.axes[0]
    (x_0, x_1), (y_0, y_1) = axes.get_xlim(), axes.get_ylim()
    width, height = look.size_of(axes)
    columns = np.linspace(0, len(found.x) - 1, 26).round().astype(int)[1:-1]
    rows = np.linspace(0, len(found.phi) - 1, 17).round().astype(int)[1:-1]
    grid = np.ix_(rows, columns)
    sense = np.sign(found.delta[grid])
    d_x = -found.arm[grid] * sense * width / (x_1 - x_0)
    d_y = math.degrees(1.0) * sense * height / (y_1 - y_0)
    size = np.hypot(d_x, d_y)
    size[size == 0] = 1.0
    axes.quiver(
        found.x[columns],
        np.degrees(found.phi[rows]),
        d_x / size,
        d_y / size,
        color=look.GREY,
        angles="uv",
        units="inches",
        width=0.011,
        scale=1 / 0.17,
        scale_units="inches",
        pivot="mid",
        headwidth=3.6,
        headlength=4.0,
        headaxislength=3.6,
        zorder=3,
    )


def _lines(found: Landscape, cells: NDArray[np.bool_]) -> list[tuple[look.Array, look.Array]]:
    """Cells of a branch joined from column to column."""
    step = math.degrees(float(found.phi[1] - found.phi[0]))
    most = 4.0 * step
    open_ends: list[list[tuple[float, float]]] = []
    done: list[list[tuple[float, float]]] = []
    middle = np.degrees(found.phi[:-1] + found.phi[1:]) / 2
    for column in range(len(found.x)):
        going = []
        for row in np.flatnonzero(cells[:, column]):
            point = (float(found.x[column]), float(middle[row]))
            near = [line for line in open_ends if abs(line[-1][1] - point[1]) <= most]
            if near:
                line = min(near, key=lambda line: abs(line[-1][1] - point[1]))
                open_ends.remove(line)
            else:
                line = []
            line.append(point)
            going.append(line)
        done += open_ends
        open_ends = going
    lines = [np.array(line) for line in (*done, *open_ends) if len(line) > 4]
    return [(line[:, 0], line[:, 1]) for line in lines]


def _path(figure: Figure, found: Landscape) -> None:
    """Driven lines of poses, thick, and the releases between them, dotted."""
    axes, run = figure.axes[0], found.found.found.run
    cuts = [0, *(np.flatnonzero(np.diff(run.poses[:, 15]) != 0) + 1).tolist(), len(run.poses)]
    x, phi = run.x, np.degrees(run.inclination)
    for start, end in pairwise(cuts):
        axes.plot(x[start:end], phi[start:end], color=look.BLUE, linewidth=2.4, zorder=5, alpha=0.9)
    for release in run.releases:
        to = (release[6], math.degrees(release[8]))
        if release[15] != 0.0:
            to = (release[3], math.degrees(release[5]) + 15 * release[0])
        axes.annotate(
            "",
            xy=to,
            xytext=(release[3], math.degrees(release[5])),
            arrowprops={
                "arrowstyle": "-|>,head_width=0.2,head_length=0.4",
                "color": look.BLUE,
                "linewidth": 1.2,
                "linestyle": (0, (2, 1)),
                "shrinkA": 0.0,
                "shrinkB": 0.0,
            },
            annotation_clip=True,
            zorder=6,
        )
