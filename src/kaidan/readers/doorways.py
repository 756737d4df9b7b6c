"""Doors of a building: where they stand, and how they open."""

import math
from collections.abc import Iterator, Sequence

from kaidan.readers.building import Doorway
from kaidan.readers.kinds import Body

WITHOUT_LEAF = ("SLIDING", "FOLDING", "LIFTING", "ROLLINGUP", "REVOLVING")
"""Operations of doors without a leaf that opens about a hinge."""


def doorways_of(bodies: Sequence[Body], unit: float) -> Iterator[Doorway]:
    """Doors that are drawn.

    unit: length of the unit of their attributes [m].
    """
    for body in bodies:
        if body.category != "IfcDoor" or len(body.vertices) == 0:
            continue
        low, high = body.vertices.min(axis=0), body.vertices.max(axis=0)
        width, height = body.facts.get("door") or (None, None)
        width = width * unit if width else float((high - low)[:2].max())
        operation = body.facts.get("operation", "")
        x, y = body.facts.get("opens", (0.0, 0.0))
        yield Doorway(
            identity=body.identity,
            name=body.name or "door",
            x=float(low[0] + high[0]) / 2,
            y=float(low[1] + high[1]) / 2,
            level=float(low[2]),
            width=width,
            height=height * unit if height else float(high[2] - low[2]),
            leaf=_leaf(operation, width),
            opens=(float(x), float(y)),
            both="DOUBLE_SWING" in operation or "OPPOSITE" in operation,
        )


def _leaf(operation: str, width: float) -> float:
    """Width of a leaf that opens about a hinge [m]; zero: none does, NaN: not stated."""
    if not operation:
        return math.nan
    if any(word in operation for word in WITHOUT_LEAF):
        return 0.0
    return width / 2 if operation.startswith("DOUBLE_DOOR") else width
