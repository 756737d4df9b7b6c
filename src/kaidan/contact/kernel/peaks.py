r"""Ways between two poses of a path on which a figure may be the largest.

::

             x          <- between two poses it is no higher than where the lines through their
           .' '.           outer poses meet
         o       o
       .'         '.
      o             o      o  a pose of the path
"""

from __future__ import annotations

import math

from kaidan.contact.codes import PIECES
from kaidan.contact.kernel.way_order import order_of, put_in_order
from kaidan.contact.layout import Figures, Way
from kaidan.contact.memory import Row, Table, empty, put

#: Share of a figure by which it may be higher where no line tells [1].
NEAR = 0.05
#: Difference of any figure that is none.
LEAST = 1e-6


def slope(s: float, then: float, height: float, higher: float) -> float:
    """Slope of the line through two poses; NaN where either tells nothing."""
    if math.isnan(height) or math.isnan(higher):
        return math.nan
    if then == s:
        return math.nan if higher == height else math.copysign(math.inf, higher - height)
    return (higher - height) / (then - s)


def promised(length: float, begin: float, end: float, before: float, after: float) -> float:
    """How high a figure may be on a way: where lines through its outer poses meet, or its ends.

    length: from its one end to the other [m].
    before, after: its slopes before and after the way. NaN where nothing is known: without one of
        them the other line counts, without both `NEAR` above the higher end.
    """
    higher = larger(begin, end)
    if math.isnan(before) and math.isnan(after):
        return larger(higher, higher + NEAR * abs(higher))
    if math.isnan(before):
        return larger(higher, end - after * length)
    if math.isnan(after):
        return larger(higher, begin + before * length)
    bends = before - after if before - after > 0.0 else math.inf
    meets = (end - begin - after * length) / bends
    if meets < 0.0:
        meets = 0.0
    if meets > length:
        meets = length
    return larger(higher, begin + before * meets)


def larger(one: float, other: float) -> float:
    """The larger of two numbers; NaN if either is."""
    if math.isnan(one):
        return one
    return one if one > other else other


def is_open(may: float, largest: float, tolerance: float) -> bool:
    """Whether a way promises more than is found."""
    return may > largest + LEAST + tolerance * abs(largest)


def told(figures: Figures, row: int) -> bool:
    """Whether the path leads on from a pose to the next, and the figure is known at both."""
    values = figures.values
    if row < 0 or row >= len(values) - 1 or not figures.line[row]:
        return False
    return abs(values[row]) < math.inf and abs(values[row + 1]) < math.inf


def open_ways(figures: Figures, tolerance: float, largest: Row[float], ways: Table[Way]) -> int:
    """Ways from each pose of a group to the next that promise enough.

    tolerance: share of a figure above which is not looked for [1].
    largest: figure of each group, to be filled.
    """
    s = figures.s
    values = figures.values
    group = figures.group
    for k in range(len(largest)):
        largest[k] = -1.7976931348623157e308
    for row in range(len(values)):
        if group[row] >= 0:
            largest[group[row]] = larger(largest[group[row]], values[row])
    count = 0
    for row in range(len(values) - 1):
        if group[row] < 0 or not told(figures, row):
            continue
        behind = math.nan
        s_behind = s[row]
        if row > 0:
            s_behind = s[row - 1]
            if told(figures, row - 1):
                behind = values[row - 1]
        ahead = math.nan
        s_ahead = s[row + 1]
        if row + 2 < len(values):
            s_ahead = s[row + 2]
            if told(figures, row + 1):
                ahead = values[row + 2]
        begin = values[row]
        end = values[row + 1]
        if figures.narrow[row]:
            higher = larger(begin, end)
            may = higher + NEAR * abs(higher)
        else:
            may = promised(
                s[row + 1] - s[row], begin, end, slope(s_behind, s[row], behind, begin),
                slope(s[row + 1], s_ahead, end, ahead),
            )  # fmt: skip
        if is_open(may, largest[group[row]], tolerance):
            way = ways[count]
            way.row = row
            way.group = group[row]
            way.s_behind = s_behind
            way.s_begin = s[row]
            way.s_end = s[row + 1]
            way.s_ahead = s_ahead
            way.behind = behind
            way.begin = begin
            way.end = end
            way.ahead = ahead
            way.promise = may
            count += 1
    return count


def chosen_ways(
    ways: Table[Way], largest: Row[float], tolerance: float, at_once: int, kept: Table[Way],
    chosen: Row[int],
) -> tuple[int, int]:  # fmt: skip
    """Ways that still promise enough, those that repeat themselves once, and which to cut first.

    largest, tolerance: as for `open_ways`.
    kept: to be filled: ways in their order, the most promising first.
    chosen: to be filled: rows of ``kept``, group by group.
    """
    order = empty(int, len(ways))
    many = 0
    for k in range(len(ways)):
        if is_open(ways[k].promise, largest[ways[k].group], tolerance):
            put(ways[many], ways[k])
            order[many] = many
            many += 1
    put_in_order(ways, order, many, False)
    unlike = 0
    for k in range(many):
        if k == 0 or order_of(ways[order[unlike - 1]], ways[order[k]]) != 0:
            order[unlike] = order[k]
            unlike += 1
    put_in_order(ways, order, unlike, True)
    for k in range(unlike):
        put(kept[k], ways[order[k]])
    found = 0
    for group in range(len(largest)):
        taken = 0
        for k in range(unlike):
            if taken < at_once and kept[k].group == group:
                chosen[found] = k
                found += 1
                taken += 1
    return unlike, found


def places_on_ways(
    s: Row[float], kept: Table[Way], chosen: Row[int], rows: Row[int], shares: Row[float]
) -> None:
    """Poses that cut some ways into `PIECES`: the row before each and the share of its way.

    Of each way the first, then of each the second, and so on.
    """
    count = len(chosen)
    for cut in range(1, PIECES):
        for k in range(count):
            way = kept[chosen[k]]
            at = way.s_begin + cut / PIECES * (way.s_end - way.s_begin)
            rows[(cut - 1) * count + k] = way.row
            shares[(cut - 1) * count + k] = (at - s[way.row]) / (s[way.row + 1] - s[way.row])


def end_of_piece(way: Way, cut: int, inside: Row[float], count: int, k: int) -> tuple[float, float]:
    """Place and figure where a way is cut: -1 and `PIECES` + 1 are the poses behind and ahead."""
    s = way.s_begin + cut / PIECES * (way.s_end - way.s_begin)
    if cut < 0:
        return way.s_behind, way.behind
    if cut > PIECES:
        return way.s_ahead, way.ahead
    if cut == 0:
        return s, way.begin
    if cut == PIECES:
        return s, way.end
    return s, inside[(cut - 1) * count + k]


def cut_ways(
    kept: Table[Way], chosen: Row[int], inside: Row[float], largest: Row[float], ways: Table[Way]
) -> int:
    """Ways that were not chosen, and the pieces of those that were.

    kept, chosen: as `chosen_ways` filled them.
    inside: the figure at the poses of `places_on_ways`.
    largest: figure of each group, raised to what is found.
    """
    count = len(chosen)
    left = 0
    for k in range(len(kept)):
        stays = True
        for j in range(count):
            if chosen[j] == k:
                stays = False
        if stays:
            put(ways[left], kept[k])
            left += 1
    for k in range(count):
        group = kept[chosen[k]].group
        for cut in range(PIECES - 1):
            largest[group] = larger(largest[group], inside[cut * count + k])
    for cut in range(PIECES):
        for k in range(count):
            way = kept[chosen[k]]
            piece = ways[left]
            piece.row = way.row
            piece.group = way.group
            piece.s_behind, piece.behind = end_of_piece(way, cut - 1, inside, count, k)
            piece.s_begin, piece.begin = end_of_piece(way, cut, inside, count, k)
            piece.s_end, piece.end = end_of_piece(way, cut + 1, inside, count, k)
            piece.s_ahead, piece.ahead = end_of_piece(way, cut + 2, inside, count, k)
            piece.promise = promised(
                piece.s_end - piece.s_begin, piece.begin, piece.end,
                slope(piece.s_behind, piece.s_begin, piece.behind, piece.begin),
                slope(piece.s_end, piece.s_ahead, piece.end, piece.ahead),
            )  # fmt: skip
            left += 1
    return left
