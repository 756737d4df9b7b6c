"""Landings on which the way turns: what a person measured of them, at the ends and between flights.

::

    half, by stairs              quarter, by a level passage
     .----------------.             | leaves |
     |                |             |        |
     |||||  leaves    |         .---+        |
     |----            |         |            | depth
     |||||  arrives   |         |||||        |
     '----------------'         |||||arrives |
      <---- depth ---->         '------------'
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Literal, NamedTuple

from kaidan.errors import InputError
from kaidan.terrain.stairs import Stairs, Turn

TURNS = {"quarter": math.pi / 2, "half": math.pi}
"""Angles of turns that sheets state [rad]."""
End = Literal["lower", "between", "upper"]


class Landing(NamedTuple):
    """A landing on which the way turns, seen on the way up."""

    place: str
    """As people say it: "lower landing"."""
    end: End
    turn: Turn
    """quarter, half or unknown."""
    depth: float
    """Clear, in line with the arrival, less the leaf of a door opposite [m]; NaN here and below: of
    an unknown turn."""
    width: float
    """Clear, across it [m]."""
    arrives: float
    """Clear width of the flight or passage by which one arrives [m]."""
    leaves: float
    """Clear width of the flight or passage by which one goes on [m]."""
    level: Literal["", "arrives", "leaves"]
    """Which of both is a level passage; empty: both are stairs."""

    @property
    def lengths(self) -> tuple[float, float]:
        """Clear lengths in line with the way by which one arrives, and by which one goes on [m]."""
        return self.depth, self.depth if self.turn == "half" else self.width


def landings_of(flights: Sequence[Stairs]) -> tuple[Landing, ...]:
    """Landings of some flights on which the way turns, from bottom to top.

    flights: from bottom to top. A landing between two is as the upper end of the lower one's sheet
        has it; where that states no turn, as the lower end of the upper one's.

    Examples
    --------
    >>> flight = Stairs(rise=0.15, going=0.3, width=1.0, upper_turn="half", upper_landing=1.2,
    ...                 upper_landing_width=2.2)
    >>> [(each.place, each.depth, each.leaves) for each in landings_of([flight])]
    [('upper landing', 1.2, 1.0)]
    """
    return tuple(_each(flights))


def _each(flights: Sequence[Stairs]) -> Iterator[Landing]:
    if not flights:
        return
    first, last = flights[0], flights[-1]
    if first.lower_turn != "none":
        yield _below(first, None)
    for below, above in pairwise(flights):
        _refuse_contradiction(below, above)
        if below.upper_turn not in ("none", "unknown"):
            yield _above(below, above)
        elif above.lower_turn not in ("none", below.upper_turn):
            yield _below(above, below)
        elif below.upper_turn == "unknown":
            yield _above(below, above)
    if last.upper_turn != "none":
        yield _above(last, None)


def _above(flight: Stairs, following: Stairs | None) -> Landing:
    """Landing at the upper end of a flight."""
    depth, width, own = flight.upper_landing, flight.upper_landing_width, flight.width
    place = f"landing above {flight.name}" if following else "upper landing"
    end: End = "between" if following else "upper"
    if flight.upper_turn == "unknown":
        return _unknown(place, end)
    assert depth is not None
    assert width is not None
    assert own is not None
    passage = flight.upper_passage
    leaves = passage or (following.width if following and following.width else own)
    leaf = max(flight.upper_leaf, following.lower_leaf if following else 0.0)
    return Landing(
        place,
        end,
        flight.upper_turn,
        depth - leaf,
        width,
        own,
        leaves,
        "leaves" if passage else "",
    )


def _below(flight: Stairs, before: Stairs | None) -> Landing:
    """Landing at the lower end of a flight; its depth lies along that flight."""
    depth, width, own = flight.lower_landing, flight.lower_landing_width, flight.width
    place = f"landing below {flight.name}" if before else "lower landing"
    end: End = "between" if before else "lower"
    if flight.lower_turn == "unknown":
        return _unknown(place, end)
    assert depth is not None
    assert width is not None
    assert own is not None
    passage = flight.lower_passage
    arrives = passage or (before.width if before and before.width else own)
    depth -= max(flight.lower_leaf, before.upper_leaf if before else 0.0)
    if flight.lower_turn == "quarter":
        depth, width = width, depth
    return Landing(
        place,
        end,
        flight.lower_turn,
        depth,
        width,
        arrives,
        own,
        "arrives" if passage else "",
    )


def _unknown(place: str, end: End) -> Landing:
    """Landing with a turn of which no more is known."""
    return Landing(place, end, "unknown", *(math.nan,) * 4, level="")


def _refuse_contradiction(below: Stairs, above: Stairs) -> None:
    """Refuse two sheets that state another turn of the same landing, or a passage on it."""
    turns = (below.upper_turn, above.lower_turn)
    if not {"none", "unknown"} & set(turns) and turns[0] != turns[1]:
        raise InputError(
            f"stairs: upper_turn of {below.name!r} is {turns[0]}, lower_turn of {above.name!r} is "
            f"{turns[1]}: both are the landing between them"
        )
    if below.upper_passage is not None or above.lower_passage is not None:
        raise InputError(
            f"stairs: between {below.name!r} and {above.name!r} there is a landing, no passage: "
            "judge flights with a passage between them one by one"
        )
