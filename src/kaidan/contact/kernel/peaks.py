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
from kaidan.contact.columns import (
    WAY_AHEAD,
    WAY_BEGIN,
    WAY_BEHIND,
    WAY_COLUMNS,
    WAY_END,
    WAY_GROUP,
    WAY_PROMISE,
    WAY_ROW,
    WAY_S_AHEAD,
    WAY_S_BEGIN,
    WAY_S_BEHIND,
    WAY_S_END,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.way_order import order_of, put_in_order
from kaidan.contact.tables import FloatRow, IntArray, WayTable

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

    Parameters
    ----------
    length
        From its one end to the other [m].
    begin, end
        The figure at its ends.
    before, after
        Its slopes before and after the way. NaN where nothing is known: without one of them the
        other line counts, without both `NEAR` above the higher end.
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


def told(line: IntArray, values: FloatRow, row: int) -> bool:
    """Whether the path leads on from a pose to the next, and the figure is known at both."""
    if row < 0 or row >= values.shape[0] - 1 or line[row] == 0:
        return False
    here: float = values[row]
    then: float = values[row + 1]
    return -math.inf < here < math.inf and -math.inf < then < math.inf


@entry
def open_ways(
    s: FloatRow,
    line: IntArray,
    values: FloatRow,
    group: IntArray,
    narrow: IntArray,
    largest: FloatRow,
    tolerance: float,
    ways: WayTable,
) -> int:
    """Ways from each pose of a group to the next that promise enough.

    Parameters
    ----------
    s
        Arclength of each pose [m].
    line
        1 where the path leads on from a pose to the next.
    values
        The figure at each pose.
    group
        Number of the group of each pose; negative: of none.
    narrow
        1 where the way from a pose to the next may hide a peak that no line tells of.
    largest
        Figure of each group, to be filled.
    tolerance
        Share of it above which is not looked for [1].
    ways
        To be filled.

    Returns
    -------
    number of ways
    """
    for k in range(largest.shape[0]):
        largest[k] = -1.7976931348623157e308
    for row in range(values.shape[0]):
        if group[row] >= 0:
            largest[group[row]] = larger(largest[group[row]], values[row])
    count = 0
    for row in range(values.shape[0] - 1):
        if group[row] < 0 or not told(line, values, row):
            continue
        behind = math.nan
        s_behind = s[row]
        if row > 0:
            s_behind = s[row - 1]
            if told(line, values, row - 1):
                behind = values[row - 1]
        ahead = math.nan
        s_ahead = s[row + 1]
        if row + 2 < values.shape[0]:
            s_ahead = s[row + 2]
            if told(line, values, row + 1):
                ahead = values[row + 2]
        begin = values[row]
        end = values[row + 1]
        if narrow[row] == 1:
            higher = larger(begin, end)
            may = higher + NEAR * abs(higher)
        else:
            may = promised(
                s[row + 1] - s[row], begin, end, slope(s_behind, s[row], behind, begin),
                slope(s[row + 1], s_ahead, end, ahead),
            )  # fmt: skip
        if is_open(may, largest[group[row]], tolerance):
            noted(
                ways, count, row, group[row], s_behind, s[row], s[row + 1], s_ahead,
                behind, begin, end, ahead, may,
            )  # fmt: skip
            count += 1
    return count


def noted(
    ways: WayTable, at: int, row: int, group: int, s_behind: float, s_begin: float, s_end: float,
    s_ahead: float, behind: float, begin: float, end: float, ahead: float, may: float,
) -> None:  # fmt: skip
    """Write a way into its row."""
    ways[at, WAY_ROW] = row
    ways[at, WAY_GROUP] = group
    ways[at, WAY_S_BEHIND] = s_behind
    ways[at, WAY_S_BEGIN] = s_begin
    ways[at, WAY_S_END] = s_end
    ways[at, WAY_S_AHEAD] = s_ahead
    ways[at, WAY_BEHIND] = behind
    ways[at, WAY_BEGIN] = begin
    ways[at, WAY_END] = end
    ways[at, WAY_AHEAD] = ahead
    ways[at, WAY_PROMISE] = may


@entry
def chosen_ways(
    ways: WayTable,
    count: int,
    largest: FloatRow,
    tolerance: float,
    at_once: int,
    order: IntArray,
    kept: WayTable,
    chosen: IntArray,
) -> tuple[int, int]:
    """Ways that still promise enough, those that repeat themselves once, and which to cut first.

    Parameters
    ----------
    ways, count
        Table and number of its rows in use; those that promise too little are written over.
    largest, tolerance
        As for `open_ways`.
    at_once
        Ways of a group to be cut together.
    order
        Scratch, as long as the ways.
    kept
        To be filled: ways in their order, the most promising first.
    chosen
        To be filled: rows of ``kept``, group by group.

    Returns
    -------
    number of ways kept, number chosen
    """
    many = 0
    for k in range(count):
        if is_open(ways[k, WAY_PROMISE], largest[int(ways[k, WAY_GROUP])], tolerance):
            for column in range(WAY_COLUMNS):
                ways[many, column] = ways[k, column]
            order[many] = many
            many += 1
    put_in_order(ways, order, many, False)
    unlike = 0
    for k in range(many):
        if k == 0 or order_of(ways, order[unlike - 1], order[k]) != 0:
            order[unlike] = order[k]
            unlike += 1
    put_in_order(ways, order, unlike, True)
    for k in range(unlike):
        for column in range(WAY_COLUMNS):
            kept[k, column] = ways[order[k], column]
    found = 0
    for group in range(largest.shape[0]):
        taken = 0
        for k in range(unlike):
            if taken < at_once and int(kept[k, WAY_GROUP]) == group:
                chosen[found] = k
                found += 1
                taken += 1
    return unlike, found


@entry
def places_on_ways(
    s: FloatRow, kept: WayTable, chosen: IntArray, count: int, rows: IntArray, shares: FloatRow
) -> None:
    """Poses that cut some ways into `PIECES`: the row before each and the share of its way.

    Of each way the first, then of each the second, and so on.
    """
    for cut in range(1, PIECES):
        for k in range(count):
            way = chosen[k]
            row = int(kept[way, WAY_ROW])
            begin = kept[way, WAY_S_BEGIN]
            at = begin + float(cut) / PIECES * (kept[way, WAY_S_END] - begin)
            rows[(cut - 1) * count + k] = row
            shares[(cut - 1) * count + k] = (at - s[row]) / (s[row + 1] - s[row])


def end_of_piece(
    kept: WayTable, way: int, cut: int, inside: FloatRow, count: int, k: int
) -> tuple[float, float]:
    """Place and figure where a way is cut: -1 and `PIECES` + 1 are the poses behind and ahead."""
    begin = kept[way, WAY_S_BEGIN]
    s = begin + float(cut) / PIECES * (kept[way, WAY_S_END] - begin)
    if cut < 0:
        return kept[way, WAY_S_BEHIND], kept[way, WAY_BEHIND]
    if cut > PIECES:
        return kept[way, WAY_S_AHEAD], kept[way, WAY_AHEAD]
    if cut == 0:
        return s, kept[way, WAY_BEGIN]
    if cut == PIECES:
        return s, kept[way, WAY_END]
    return s, inside[(cut - 1) * count + k]


@entry
def cut_ways(
    kept: WayTable, many: int, chosen: IntArray, count: int, inside: FloatRow, largest: FloatRow,
    ways: WayTable,
) -> int:  # fmt: skip
    """Ways that were not chosen, and the pieces of those that were.

    Parameters
    ----------
    kept, many, chosen, count
        As `chosen_ways` filled them.
    inside
        The figure at the poses of `places_on_ways`.
    largest
        Figure of each group, raised to what is found.
    ways
        To be filled.

    Returns
    -------
    number of ways
    """
    left = 0
    for k in range(many):
        stays = True
        for j in range(count):
            if chosen[j] == k:
                stays = False
        if stays:
            for column in range(WAY_COLUMNS):
                ways[left, column] = kept[k, column]
            left += 1
    for k in range(count):
        group = int(kept[chosen[k], WAY_GROUP])
        for cut in range(PIECES - 1):
            largest[group] = larger(largest[group], inside[cut * count + k])
    for cut in range(PIECES):
        for k in range(count):
            way = chosen[k]
            s_behind, behind = end_of_piece(kept, way, cut - 1, inside, count, k)
            s_begin, begin = end_of_piece(kept, way, cut, inside, count, k)
            s_end, end = end_of_piece(kept, way, cut + 1, inside, count, k)
            s_ahead, ahead = end_of_piece(kept, way, cut + 2, inside, count, k)
            may = promised(
                s_end - s_begin, begin, end, slope(s_behind, s_begin, behind, begin),
                slope(s_end, s_ahead, end, ahead),
            )  # fmt: skip
            noted(
                ways, left, int(kept[way, WAY_ROW]), int(kept[way, WAY_GROUP]), s_behind, s_begin,
                s_end, s_ahead, behind, begin, end, ahead, may,
            )  # fmt: skip
            left += 1
    return left
