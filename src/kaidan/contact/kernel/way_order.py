"""Ways between two poses in order: by group and what they promise, those that are alike known."""

from __future__ import annotations

from kaidan.contact.columns import WAY_BEGIN, WAY_END, WAY_GROUP, WAY_PROMISE
from kaidan.contact.tables import IntArray, WayTable

#: What is one after the point to which two ways are alike, that is one that repeats itself.
ALIKE = 1e9
#: Adding it and taking it off rounds to whole numbers; beyond `EXACT` numbers are whole enough.
WHOLE = 6755399441055744.0
EXACT = 1e15


def rounded(figure: float) -> float:
    """A figure as it counts where two ways are compared, in parts of `ALIKE`."""
    scaled = figure * ALIKE
    if abs(scaled) < EXACT:
        return scaled + WHOLE - WHOLE
    return scaled


def order_of(ways: WayTable, one: int, other: int) -> int:
    """-1 if a way comes before another by group, promise and ends, 1 if behind, 0 if alike."""
    a = ways[one, WAY_GROUP]
    b = ways[other, WAY_GROUP]
    if a == b:
        a = rounded(ways[one, WAY_PROMISE])
        b = rounded(ways[other, WAY_PROMISE])
    if a == b:
        a = rounded(ways[one, WAY_BEGIN])
        b = rounded(ways[other, WAY_BEGIN])
    if a == b:
        a = rounded(ways[one, WAY_END])
        b = rounded(ways[other, WAY_END])
    if a == b:
        return 0
    return -1 if a < b else 1


def is_before(ways: WayTable, one: int, other: int, by_promise: bool) -> bool:
    """Whether a way comes before another: those that are alike as they stand."""
    promise: float = ways[one, WAY_PROMISE]
    others: float = ways[other, WAY_PROMISE]
    if by_promise and promise != others:
        return promise > others
    order = order_of(ways, one, other)
    return order < 0 or (order == 0 and one < other)


def sift(ways: WayTable, order: IntArray, start: int, end: int, by_promise: bool) -> None:
    """Let one of a heap, the last on top, sink to its place."""
    root = start
    while 2 * root + 1 < end:
        child = 2 * root + 1
        if child + 1 < end and is_before(ways, order[child], order[child + 1], by_promise):
            child += 1
        if not is_before(ways, order[root], order[child], by_promise):
            break
        swapped = order[root]
        order[root] = order[child]
        order[child] = swapped
        root = child


def put_in_order(ways: WayTable, order: IntArray, count: int, by_promise: bool) -> None:
    """Sort the rows of some ways, by `is_before`."""
    for k in range(count):
        if k < count // 2:
            sift(ways, order, count // 2 - 1 - k, count, by_promise)
    for k in range(1, count):
        swapped = order[0]
        order[0] = order[count - k]
        order[count - k] = swapped
        sift(ways, order, 0, count - k, by_promise)
