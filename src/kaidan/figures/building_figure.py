"""Plan of a building's flights, storey by storey, with the manoeuvres that robots need."""

import math
import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from kaidan.figures import style as look
from kaidan.text.comparison import SIGNS

if TYPE_CHECKING:
    from kaidan.verbs.building.answer import BuildingAnswer, FlightShown, TurnShown


_AROUND = 1.3
"""Room about the flights of a plan [m]."""
_MOST_HIGH = 4.2
_SHOWN_POSES = 9
_COLOURS = (look.VERMILION, look.BLUE, look.GREEN, look.PURPLE)


def building_figure(found: "BuildingAnswer") -> Figure:
    """Plan of each storey that has flights.

    One plan below the other, the lowest storey last, as in a section.
    """
    storeys = list(dict.fromkeys(each.storey for each in found.flights))
    plans = [[each for each in found.flights if each.storey == name] for name in storeys]
    sizes = [_extent(each) for each in plans]
    heights = [
        min(_MOST_HIGH, (look.WIDTH - 0.4) * (y1 - y0) / (x1 - x0)) for x0, y0, x1, y1 in sizes
    ]
    total = sum(each + 0.6 for each in heights) + 0.4
    with look.settings():
        figure = look.blank(total)
        top = total
        for name, flights, height, box in reversed(
            list(zip(storeys, plans, heights, sizes, strict=True))
        ):
            top -= height + 0.6
            axes = figure.add_axes(
                (0.2 / look.WIDTH, (top + 0.3) / total, 1 - 0.4 / look.WIDTH, height / total)
            )
            _plan(axes, found, name, flights, box)
        legend = "\n".join(textwrap.wrap(_legend(found), 105))
        figure.text(0.2 / look.WIDTH, 0.08 / total, legend, va="bottom")
    return figure


def _legend(found: "BuildingAnswer") -> str:
    words = ", ".join(f"{sign} {one.value}" for one, sign in SIGNS.items())
    robots = ", ".join(look.named(each, 20) for each in found.robots)
    return f"Arrows lead up. Signs in the order {robots}: {words}. Filled by the worst."


def _extent(flights: "list[FlightShown]") -> tuple[float, float, float, float]:
    corners = np.array([corner for each in flights for corner in each.lane])
    x0, y0 = corners.min(axis=0) - _AROUND
    x1, y1 = corners.max(axis=0) + _AROUND
    return float(x0), float(y0), float(x1), float(y1)


def _plan(
    axes: Axes,
    found: "BuildingAnswer",
    name: str,
    flights: "list[FlightShown]",
    box: tuple[float, float, float, float],
) -> None:
    x0, y0, x1, y1 = box
    axes.set_xlim(x0, x1)
    axes.set_ylim(y0, y1)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_title(look.named(name, 60), loc="left")
    keys = {key for each in flights for key in (each.lower, each.upper)}
    for floor in (each for each in found.floors if each.key in keys):
        for outline in floor.outlines:
            axes.add_patch(
                Polygon(outline, facecolor=look.PALE, edgecolor=look.GREY, linewidth=0.5, zorder=1)
            )
        walls = np.array(floor.walls).reshape(-1, 2, 2)
        axes.add_collection(
            LineCollection(list(walls), colors=look.BLACK, linewidths=0.8, zorder=1.5)
        )
    for each in flights:
        _flight(axes, found, each)
    identities = {each.identity for each in flights}
    for number, robot in enumerate(found.robots):
        for turn in found.turns:
            if turn.robot == robot and turn.from_flight in identities and turn.path:
                _manoeuvre(axes, turn, _COLOURS[number % len(_COLOURS)])
    for door in (each for each in found.doors if each.floor in keys):
        axes.plot(door.x, door.y, marker="s", color=look.BLUE, markersize=4, zorder=5)
    axes.plot([x0 + 0.1, x0 + 1.1], [y0 + 0.1] * 2, color=look.BLACK, linewidth=2.0, zorder=6)
    axes.text(x0 + 1.2, y0 + 0.1, "1 m", va="center", zorder=6)


def _flight(axes: Axes, found: "BuildingAnswer", flight: "FlightShown") -> None:
    cells = [each for each in found.cells if each.flight == flight.identity]
    worst = max((each.verdict for each in cells), key=lambda one: one.rank)
    axes.add_patch(
        Polygon(
            flight.lane,
            facecolor=look.VERDICT_FILLS[worst][0],
            edgecolor=look.BLACK,
            linewidth=0.8,
            zorder=2,
        )
    )
    nosings = np.array(flight.nosings).reshape(-1, 2, 2)
    axes.add_collection(LineCollection(list(nosings), colors=look.GREY, linewidths=0.5, zorder=3))
    foot, head = nosings[0].mean(axis=0), nosings[-1].mean(axis=0)
    axes.annotate(
        "", xy=tuple(head), xytext=tuple(foot), zorder=4,
        arrowprops={"arrowstyle": "->", "color": look.BLACK, "linewidth": 0.9},
    )  # fmt: skip
    signs = " ".join(SIGNS[each.verdict] for each in cells)
    middle = (foot + head) / 2
    axes.text(
        float(middle[0]), float(middle[1]), f"{look.named(flight.name, 24)}\n{signs}",
        ha="center", va="center", zorder=6, fontsize=look.SMALL,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
    )  # fmt: skip


def _manoeuvre(axes: Axes, turn: "TurnShown", colour: str) -> None:
    path = np.array(turn.path)
    assert turn.footprint is not None
    front, rear, width = turn.footprint
    axes.plot(path[:, 0], path[:, 1], color=colour, linewidth=1.0, zorder=5)
    box = np.array(
        [(front, width / 2), (-rear, width / 2), (-rear, -width / 2), (front, -width / 2)]
    )
    for x, y, psi in path[:: max(1, math.ceil(len(path) / _SHOWN_POSES))]:
        rotated = box @ np.array([[np.cos(psi), np.sin(psi)], [-np.sin(psi), np.cos(psi)]])
        axes.add_patch(
            Polygon(
                rotated + np.array([x, y]), fill=False, edgecolor=colour, linewidth=0.5, zorder=5
            )
        )
