"""What all figures share: size, type, colours that hold in grey, labels that do not collide."""

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from kaidan.modes import Verdict

Array = NDArray[np.float64]

WIDTH = 7.0
"""Width of a figure [in]: two columns of a journal page."""
DPI = 200
SMALL = 8.0
"""Smallest type [pt]."""

BLACK, GREY, PALE = "#000000", "#6f6f6f", "#e6e6e6"
BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", "#009E73"
ORANGE, SKY, PURPLE = "#E69F00", "#56B4E9", "#CC79A7"
"""Colours of Okabe & Ito; no line or area has its colour alone."""

_FILLS: dict[str, dict[str, Any]] = {
    "tips": {"facecolor": "#fbe6d9", "hatch": "////", "edgecolor": "#d9b49c"},
    "nose": {"facecolor": "#dfedf7", "hatch": "\\\\\\\\", "edgecolor": "#a3c0d6"},
    "band": {"facecolor": "#8c8c8c", "alpha": 0.6},
    "area A": {"facecolor": "#f6d3c0", "hatch": "xxxx", "edgecolor": "#dba98d"},
    "area B": {"facecolor": "#fbe6d9", "hatch": "////", "edgecolor": "#d9b49c"},
    "area C": {"facecolor": "#dfedf7", "hatch": "\\\\\\\\", "edgecolor": "#a3c0d6"},
    "area DOWNHILL_SLIP": {"facecolor": "#efe6ef", "hatch": "....", "edgecolor": "#b9a0b6"},
    "area D": {"facecolor": "#d8f0e7"},
    "area E": {"facecolor": "#fdf8e3"},
    "outside": {"facecolor": "#ececec", "hatch": "xxx", "edgecolor": "#cfcfcf"},
}


def fill(kind: str) -> dict[str, Any]:
    """Filling of an area by its kind: a tint and a hatch, so that grey tells them apart too."""
    return {"linewidth": 0.0, **_FILLS[kind]}


VERDICT_FILLS: dict[Verdict, tuple[str, str | None]] = {
    Verdict.GO: ("#c5e8dc", None),
    Verdict.ROUGH: ("#fbf1cc", "////"),
    Verdict.UNSURE: ("#d5dcf5", "---"),
    Verdict.NO_GO: ("#f2c6af", "xxxx"),
    Verdict.OUTSIDE_MODEL: ("#ffffff", "...."),
}
"""Tint and hatch of a verdict."""

_RC: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": SMALL,
    "axes.labelsize": 9.0,
    "axes.titlesize": 9.0,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.7,
    "axes.unicode_minus": True,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "lines.linewidth": 1.4,
    "lines.solid_capstyle": "butt",
    "hatch.linewidth": 0.5,
    "svg.hashsalt": "kaidan",
    "svg.fonttype": "path",
    "pdf.fonttype": 42,
    "figure.dpi": 100.0,
    "savefig.facecolor": "white",
}


@contextmanager
def settings() -> Iterator[None]:
    """Context in which a figure is made and written, whatever the user's matplotlibrc says.

    A letter that the typeface lacks becomes a box in the picture, without a warning.
    """
    ours: dict[Any, Any] = {
        key: value for key, value in mpl.rcParamsDefault.items() if "backend" not in key
    }
    ours.update(_RC)
    with mpl.rc_context(ours), warnings.catch_warnings():
        warnings.filterwarnings(
            "ignore", message="Glyph .* missing from font", category=UserWarning
        )
        yield


def named(name: str, longest: int = 40) -> str:
    """User's name as text of a figure: no formulas, no control characters, not endless.

    Examples
    --------
    >>> print(named("x" * 50, longest=5))
    xxxx…
    """
    shown = "".join(c if c.isprintable() else "�" for c in name)
    shown = shown if len(shown) <= longest else shown[: longest - 1] + "…"
    return shown.replace("$", "\\$")


def blank(height: float, width: float = WIDTH) -> Figure:
    """Empty figure with an Agg canvas [in]."""
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def signed(value: float, digits: int = 2) -> str:
    """Number with a true minus sign, whole numbers without decimals.

    Examples
    --------
    >>> signed(-1.5), signed(0.0)
    ('−1.50', '0')
    """
    text = f"{value:g}" if value == int(value) else f"{value:.{digits}f}"
    return text.replace("-", "−")


def stretches(marks: Sequence[Any]) -> list[tuple[int, int]]:
    """Slices of a sequence between changes of its value.

    Examples
    --------
    >>> stretches([0, 0, 1, 1, 1])
    [(0, 2), (2, 5)]
    """
    changes = [at for at in range(1, len(marks)) if marks[at] != marks[at - 1]]
    return list(pairwise([0, *changes, len(marks)]))


def spread(wanted: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """Places as near as possible to given ones, in the same order, at least `gap` apart.

    Least squares: pools adjacent ones that violate (isotonic regression of ``y_i - i gap``).

    Examples
    --------
    >>> spread([1.0, 1.0, 5.0], gap=1.0, low=0.0, high=10.0)
    [0.5, 1.5, 5.0]
    """
    order = sorted(range(len(wanted)), key=lambda index: wanted[index])
    pools: list[list[float]] = []
    for rank, index in enumerate(order):
        pools.append([wanted[index] - rank * gap, 1.0])
        while len(pools) > 1 and pools[-2][0] > pools[-1][0]:
            (mean, count), (upper, more) = pools[-2], pools[-1]
            pools[-2:] = [[(mean * count + upper * more) / (count + more), count + more]]
    level = [mean for mean, count in pools for _ in range(int(count))]
    top = max(low, high - (len(order) - 1) * gap)
    places = [0.0] * len(order)
    for rank, index in enumerate(order):
        places[index] = min(max(level[rank], low), top) + rank * gap
    return places


def label_right(
    axes: Axes,
    items: Sequence[tuple[float, float, str]],
    *,
    start: float = 1.03,
    gap: float = 0.125,
    color: str = BLACK,
) -> None:
    """Labels in a column right of the axes, with a thin leader from each point to its label.

    axes: where the points are; its limits must be set.
    start: left end of the labels, as a share of the width of the axes.
    gap: least distance of neighbouring labels [in].
    """
    width, height = size_of(axes)
    to_axes = axes.transData + axes.transAxes.inverted()
    points = [to_axes.transform((x, y)) for x, y, _ in items]
    places = spread([float(y) for _, y in points], gap / height, 0.0, 1.0)
    for (x, y), place, (_, _, text) in zip(points, places, items, strict=True):
        axes.plot(
            [x, start - 0.03 / width],
            [y, place],
            transform=axes.transAxes,
            color=color,
            linewidth=0.5,
            clip_on=False,
            zorder=1.5,
        )
        axes.text(
            start, place, text, transform=axes.transAxes, va="center", ha="left", fontsize=SMALL
        )


def roomiest(inside: NDArray[np.bool_], width: float, height: float) -> tuple[float, float] | None:
    """Centre of the place where a rectangle fits best into an area of a grid.

    inside, shape (rows, columns): area, cell by cell.

    (x, y) or None: shares of the grid's width and height; None where it does not fit at all.

    Examples
    --------
    >>> grid = np.zeros((10, 10), dtype=bool)
    >>> grid[0:4, :] = True
    >>> roomiest(grid, 0.3, 0.2)
    (0.5, 0.2)
    """
    rows, columns = inside.shape
    total = np.pad(np.cumsum(np.cumsum(inside, axis=0), axis=1), ((1, 0), (1, 0)))
    best: tuple[float, float] | None = None
    for scale in np.geomspace(1.0, 12.0, 60):
        w, h = int(np.ceil(width * scale * columns)), int(np.ceil(height * scale * rows))
        if w > columns or h > rows:
            break
        covered = total[h:, w:] - total[:-h, w:] - total[h:, :-w] + total[:-h, :-w]
        fits = np.argwhere(covered == w * h)
        if not len(fits):
            break
        middle = fits.mean(axis=0)
        row, column = fits[np.argmin(((fits - middle) ** 2).sum(axis=1))]
        best = float((column + w / 2) / columns), float((row + h / 2) / rows)
    return best


def size_of(axes: Axes) -> tuple[float, float]:
    """Width and height of axes [in]."""
    box = axes.get_window_extent()
    dpi = figure_of(axes).dpi
    return float(box.width / dpi), float(box.height / dpi)


def figure_of(axes: Axes) -> Figure:
    """Figure that axes stand in."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    return figure


def name_area(axes: Axes, inside: NDArray[np.bool_], text: str, *, size: float = SMALL) -> bool:
    """Write a name into an area where there is most room; say whether there was room.

    inside, shape (rows, columns): the area over the whole of the axes, first row at the bottom.
    size: type [pt].
    """
    wide, tall = size_of(axes)
    width, height = extent(figure_of(axes), text, size)
    for turned in (False, True) if len(text) > 12 else (False,):
        size_now = (height, width) if turned else (width, height)
        place = roomiest(
            inside,
            (size_now[0] + 0.12) / wide,
            (size_now[1] + 0.12) / tall,
        )
        if place is not None:
            axes.text(
                *place,
                text,
                transform=axes.transAxes,
                rotation=90.0 if turned else 0.0,
                ha="center",
                va="center",
                fontsize=size,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.9},
                zorder=4,
            )
            return True
    return False


def title(figure: Figure, left: float, first: str, second: str = "") -> None:
    """Two lines at the top of a figure, from `left` [in] on."""
    width, height = figure.get_size_inches()
    figure.text(left / width, 1 - 0.2 / height, first, fontsize=9.0, weight="bold")
    figure.text(left / width, 1 - 0.37 / height, second, fontsize=SMALL)


def extent(figure: Figure, text: str, size: float = SMALL) -> tuple[float, float]:
    """Width and height of a text [in]."""
    label = figure.text(0.0, 0.0, text, fontsize=size)
    box = label.get_window_extent()
    label.remove()
    return box.width / figure.dpi, box.height / figure.dpi
