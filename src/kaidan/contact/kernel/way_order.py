"""Ways between two poses in order: by group and what they promise, those that are alike known."""

from __future__ import annotations

from kaidan.contact.layout import Way
from kaidan.contact.memory import Row, Table

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


def compared(one: float, other: float) -> int:
    """-1, 0 or 1 as a figure is less than another, alike or more."""
    if rounded(one) == rounded(other):
        return 0
    return -1 if rounded(one) < rounded(other) else 1


def order_of(one: Way, other: Way) -> int:
    """-1 if a way comes before another by group, promise and ends, 1 if behind, 0 if alike."""
    if one.group != other.group:
        return -1 if one.group < other.group else 1
    order = compared(one.promise, other.promise)
    if order == 0:
        order = compared(one.begin, other.begin)
    if order == 0:
        order = compared(one.end, other.end)
    return order


def is_before(ways: Table[Way], one: int, other: int, by_promise: bool) -> bool:
    """Whether a way comes before another: those that are alike as they stand."""
    if by_promise and ways[one].promise != ways[other].promise:
        return ways[one].promise > ways[other].promise
    order = order_of(ways[one], ways[other])
    return order < 0 or (order == 0 and one < other)


def sift(ways: Table[Way], order: Row[int], start: int, end: int, by_promise: bool) -> None:
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


def put_in_order(ways: Table[Way], order: Row[int], count: int, by_promise: bool) -> None:
    """Sort the rows of some ways, by `is_before`."""
    for k in range(count):
        if k < count // 2:
            sift(ways, order, count // 2 - 1 - k, count, by_promise)
    for k in range(1, count):
        swapped = order[0]
        order[0] = order[count - k]
        order[count - k] = swapped
        sift(ways, order, 0, count - k, by_promise)
