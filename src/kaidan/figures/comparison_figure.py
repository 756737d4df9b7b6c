"""Picture of a comparison of verdicts, legible without colour."""

import textwrap
from typing import TYPE_CHECKING, Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from kaidan.figures import style as look
from kaidan.modes import Verdict
from kaidan.text.comparison import beside_the_slope, conditions, short

if TYPE_CHECKING:
    from kaidan.verbs.comparison import Cell, Comparison

_ROW, _COLUMN, _HEAD, _TOP = 0.36, 0.6, 0.5, 0.32
"""Height of a row, least width of a column, height of the head and of the title [in]."""
_STRIP = 0.11
"""Share of a cell's width that carries the hatch."""

_SIGNS: dict[Verdict, dict[str, Any]] = {
    Verdict.GO: {"marker": "o", "markerfacecolor": look.BLACK},
    Verdict.ROUGH: {"marker": "^", "markerfacecolor": "white"},
    Verdict.UNSURE: {"marker": "D", "markerfacecolor": "white", "markersize": 4.0},
    Verdict.NO_GO: {"marker": "X", "markerfacecolor": look.BLACK},
    Verdict.OUTSIDE_MODEL: {"marker": "s", "markerfacecolor": "white"},
}


def comparison_figure(found: "Comparison") -> Figure:
    """Table of verdicts: a sign, a word and the margin in every cell.

    Parameters
    ----------
    found : Comparison
        Verdicts.

    Returns
    -------
    Figure
        As wide as a page, or wider where there are many robots.
    """
    rows, columns = len(found.stairs), len(found.robots)
    with look.settings():
        probe = look.blank(1.0)
        sides = [_side(row[0]) for row in found.rows]
        left = max(look.extent(probe, text)[0] for text in sides) + 0.2
        width = max(look.WIDTH, left + columns * _COLUMN + 0.1)
        column = min(1.1, (width - left - 0.1) / columns)
        notes = _notes(found, int((width - 0.2) * 14))
        foot = 0.36 + 0.155 * len(notes)
        height = _TOP + _HEAD + rows * _ROW + foot
        figure = look.blank(height, width)
        axes = figure.add_axes(
            (left / width, foot / height, columns * column / width, rows * _ROW / height)
        )
        axes.set_xlim(0.0, columns)
        axes.set_ylim(rows, 0.0)
        axes.axis("off")
        for r, row in enumerate(found.rows):
            axes.text(-0.1 / column, r + 0.5, sides[r], ha="right", va="center")
            for c, cell in enumerate(row):
                _draw_cell(axes, r, c, cell)
        for c, cell in enumerate(found.rows[0]):
            lie = found.posture(c)
            name = "\n".join(textwrap.wrap(look.named(cell.robot, 22), 11))
            posture = f"\n({lie})" if lie in ("flat", "stowed") else ""
            axes.text(c + 0.5, -0.12, name + posture, ha="center", va="bottom", linespacing=1.1)
        said = look.named(conditions(found), 160)
        first, *rest = textwrap.wrap(said, int((width - 0.2) * 13))
        look.title(figure, 0.1, first, " ".join(rest))
        _draw_key(figure, (foot - 0.2) / height)
        for index, text in enumerate(reversed(notes)):
            figure.text(0.1 / width, (0.06 + 0.155 * index) / height, text)
    return figure


def _draw_cell(axes: Axes, row: int, column: int, cell: "Cell") -> None:
    _draw_swatch(axes, row, column, 1.0, cell.verdict)
    middle = column + (1 + _STRIP) / 2
    axes.text(middle, row + 0.3, short(cell.verdict), ha="center", va="center")
    margin = "" if cell.margin_deg is None else f"{cell.margin_deg:+.1f}"
    sign = middle if not margin else column + _STRIP + 0.13
    axes.plot(
        sign,
        row + 0.72,
        **_sign(cell.verdict),
    )
    axes.text(column + 0.94, row + 0.72, margin.replace("-", "−"), ha="right", va="center")


def _sign(verdict: Verdict) -> dict[str, Any]:
    edge = {"markersize": 4.5, "markeredgecolor": look.BLACK, "markeredgewidth": 0.8}
    return edge | _SIGNS[verdict]


def _draw_swatch(axes: Axes, row: float, column: float, width: float, verdict: Verdict) -> None:
    colour, hatch = look.VERDICT_FILLS[verdict]
    axes.add_patch(Rectangle((column, row), width, 1.0, facecolor=colour, linewidth=0.0))
    axes.add_patch(
        Rectangle(
            (column, row),
            _STRIP,
            1.0,
            facecolor="none",
            edgecolor="#555555",
            hatch=None if hatch is None else 2 * hatch,
            linewidth=0.0,
        )
    )
    axes.add_patch(
        Rectangle((column, row), width, 1.0, facecolor="none", edgecolor="white", linewidth=2.0)
    )


def _draw_key(figure: Figure, bottom: float) -> None:
    """Key of the signs below the found."""
    width = figure.get_size_inches()[0]
    axes = figure.add_axes(
        (0.1 / width, bottom, 1 - 0.2 / width, 0.15 / figure.get_size_inches()[1])
    )
    axes.set_xlim(0.0, width - 0.2)
    axes.set_ylim(1.0, 0.0)
    axes.axis("off")
    place = 0.08
    for verdict in Verdict:
        axes.plot(
            place,
            0.5,
            clip_on=False,
            **_sign(verdict),
        )
        axes.text(place + 0.1, 0.5, verdict.label, va="center")
        place += 0.35 + look.extent(figure, verdict.label)[0]
    axes.text(place, 0.5, "number: smallest margin [°], worst case", va="center")


def _side(cell: "Cell") -> str:
    shape = f"{cell.angle_deg:.1f}°, {1e3 * cell.nosing_spacing_m:.0f} mm"
    return f"{look.named(cell.stairs, 24)}  {shape}"


def _notes(found: "Comparison", width: int) -> list[str]:
    texts = beside_the_slope(found)
    if found.without_centroid:
        names = ", ".join(robot.name for robot in found.without_centroid)
        texts.append(f"No centroid is published, so no margin: {names}.")
    return [line for text in texts for line in textwrap.wrap(text, width, break_on_hyphens=False)]
