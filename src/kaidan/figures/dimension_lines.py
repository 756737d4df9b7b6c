"""Dimension lines and labels of drawings that explain."""

from typing import Literal

from matplotlib.axes import Axes

from kaidan.figures import style as look


def label(
    axes: Axes,
    at: look.Array,
    text: str,
    color: str = look.BLACK,
    align: Literal["left", "center", "right"] = "center",
) -> None:
    """Text about a point, or on one side of it."""
    axes.text(
        float(at[0]), float(at[1]), text,
        fontsize=9.0, color=color, ha=align, va="center", zorder=7,
    )  # fmt: skip


def dimension(
    axes: Axes,
    start: look.Array,
    end: look.Array,
    text: str,
    outward: look.Array,
    gap: float = 0.017,
) -> None:
    """Dimension line with its name on the outer side, `gap` off it."""
    axes.annotate(
        "",
        tuple(start),
        tuple(end),
        arrowprops={
            "arrowstyle": "|-|,widthA=0.25,widthB=0.25",
            "linewidth": 0.8,
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )
    label(axes, (start + end) / 2 + gap * outward, text)
