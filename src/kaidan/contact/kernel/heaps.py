"""Numbers in their order, as far as they are taken: a heap, the smallest on top."""

from __future__ import annotations

from kaidan.contact.memory import Row


def is_less(figures: Row[float], one: int, other: int) -> bool:
    """Whether a figure comes before another: of those alike the first."""
    return figures[one] < figures[other] or (figures[one] == figures[other] and one < other)


def sink(order: Row[int], figures: Row[float], root: int, end: int) -> None:
    """Let one of a heap sink to its place."""
    while 2 * root + 1 < end:
        child = 2 * root + 1
        if child + 1 < end and is_less(figures, order[child + 1], order[child]):
            child += 1
        if not is_less(figures, order[child], order[root]):
            break
        swapped = order[root]
        order[root] = order[child]
        order[child] = swapped
        root = child


def heap_of(order: Row[int], figures: Row[float], count: int) -> None:
    """Make a heap of the rows of some figures."""
    for k in range(count // 2):
        sink(order, figures, count // 2 - 1 - k, count)


def taken(order: Row[int], figures: Row[float], left: int) -> int:
    """Row of the smallest figure of a heap, which is put behind those that stay."""
    first = order[0]
    order[0] = order[left - 1]
    order[left - 1] = first
    sink(order, figures, 0, left - 1)
    return first
