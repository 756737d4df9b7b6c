"""Ways that are open, chosen and cut, against the same rules written out in Python.

A way leads from a pose to the next. On it a figure may be as high as where the lines through its
outer poses meet.
"""

import math

import numpy as np
import pytest

from kaidan.contact import layout as at
from kaidan.contact.codes import PIECES
from kaidan.contact.kernel import peak_search
from kaidan.contact.kernel.peaks import (
    LEAST,
    NEAR,
    chosen_ways,
    cut_ways,
    open_ways,
    places_on_ways,
)

TOLERANCE = 0.01
ROWS, GROUPS = 80, 12
COLUMNS = [at.WAY_ROW, at.WAY_GROUP, at.WAY_S_BEHIND, at.WAY_S_BEGIN, at.WAY_S_END, at.WAY_S_AHEAD,
           at.WAY_BEHIND, at.WAY_BEGIN, at.WAY_END, at.WAY_AHEAD, at.WAY_PROMISE]  # fmt: skip


def highest(s, heights):
    """What the lines through the outer two of four poses leave room for between the inner two."""
    before, begin, end, after = heights
    length, higher = s[2] - s[1], max(begin, end)
    lines = []
    if math.isfinite(before):
        lines.append((begin, (begin - before) / (s[1] - s[0])))
    if math.isfinite(after):
        falls = (after - end) / (s[3] - s[2])
        lines.append((end - falls * length, falls))
    if not lines:
        return higher + NEAR * abs(higher)
    places = [0.0, length]
    if len(lines) == 2 and lines[0][1] != lines[1][1]:
        crossing = (lines[1][0] - lines[0][0]) / (lines[0][1] - lines[1][1])
        places.append(min(max(crossing, 0.0), length))
    return max(higher, *(min(z + u * place for z, u in lines) for place in places))


class Path:
    """Random figures along a line of poses with gaps in it."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.s = np.cumsum(rng.uniform(0.2, 2.0, ROWS))
        self.line = (rng.random(ROWS - 1) < 0.9).astype(np.int64)
        self.values = rng.uniform(-1.0, 1.0, ROWS)
        self.group = rng.integers(-1, GROUPS - 2, ROWS)  # none of the last but one
        self.group[-1] = GROUPS - 1
        hidden = rng.random(ROWS) < 0.1
        self.values[hidden] = -math.inf
        self.values[hidden & (self.group < 0)] = rng.choice([math.nan, math.inf])
        self.narrow = (rng.random(ROWS - 1) < 0.2).astype(np.int64)
        self.rng = rng

    def open(self):
        self.largest = np.empty(GROUPS)
        ways = np.full((ROWS, at.WAY_COLUMNS), -7.0)
        count = open_ways(
            self.s, self.line, self.values, self.group, self.narrow, self.largest, TOLERANCE, ways
        )
        return ways[:count]

    def known(self, row):
        """Whether the path leads on from a pose, and the figure is known there and at the next."""
        return (
            0 <= row < ROWS - 1 and self.line[row] == 1
            and bool(np.isfinite(self.values[row : row + 2]).all())
        )  # fmt: skip

    def expected(self):
        """All ways of a group, with what they promise."""
        nan = math.nan
        for row in range(ROWS - 1):
            if self.group[row] < 0 or not self.known(row):
                continue
            places = [max(row - 1, 0), row, row + 1, min(row + 2, ROWS - 1)]
            heights = self.values[places].tolist()
            if not self.known(row - 1):
                heights[0] = nan
            if not self.known(row + 1):
                heights[3] = nan
            s = self.s[places]
            may = highest(s, [nan, *heights[1:3], nan] if self.narrow[row] else heights)
            yield [row, self.group[row], *s, *heights, may]


def opened(may, largest):
    return may > largest + LEAST + TOLERANCE * abs(largest)


@pytest.mark.parametrize("seed", range(8))
def test_ways_that_promise_more_than_what_is_found(seed):
    path = Path(seed)
    found = path.open()
    for group in range(GROUPS):
        of_it = path.values[path.group == group]
        assert path.largest[group] == max([*of_it, -np.finfo(float).max])
    expected = [each for each in path.expected() if opened(each[-1], path.largest[each[1]])]
    assert len(expected) > 3
    np.testing.assert_allclose(found[:, COLUMNS], expected, rtol=0, atol=1e-12)


def test_the_last_way_of_a_path_is_one():
    """By hand: it rises by 1 a metre to the last but one and is level then."""
    s, values = np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 1.0])
    ways, largest = zeros(Way, 3), np.empty(1)
    none = np.zeros(3, dtype=np.int64)
    assert open_ways(s, none + 1, values, none, none, largest, TOLERANCE, ways) == 1
    assert ways[0, [at.WAY_ROW, at.WAY_PROMISE]].tolist() == [1.0, 2.0]


def chosen(ways, largest, at_once, room):
    order, kept = np.empty(len(ways), dtype=np.int64), np.full(ways.shape, -7.0)
    picked = np.full(room, -7)
    many, found = chosen_ways(
        ways.copy(), len(ways), largest, TOLERANCE, at_once, order, kept, picked
    )
    return kept[:many], picked[:found]


@pytest.mark.parametrize("at_once", [1, 2, 3])
@pytest.mark.parametrize("seed", range(4))
def test_the_most_promising_ways_are_cut_first(seed, at_once):
    """Of ways alike in group, promise and ends the first one as they stand."""
    path = Path(seed)
    ways = path.open()
    rng = path.rng
    ways = np.vstack([ways, ways[rng.permutation(len(ways))]])
    # repeated: at another place, and by less than a billionth something else
    half = len(ways) // 2
    ways["row"][half:] += 1000.0
    ways["promise"][half:] += 1e-11
    ways = ways[rng.permutation(len(ways))]
    largest = path.largest + 0.3  # some promise enough no more
    kept, picked = chosen(ways, largest, at_once, GROUPS * at_once)
    seen, unlike = set(), []
    for way in ways:
        key = (way[at.WAY_GROUP], *(round(way[k], 9) for k in COLUMNS[-1:] + COLUMNS[7:9]))
        if opened(way[at.WAY_PROMISE], largest[int(way[at.WAY_GROUP])]) and key not in seen:
            seen.add(key)
            unlike.append(way)
    assert 3 < len(unlike) < half
    unlike.sort(key=lambda way: -way[at.WAY_PROMISE])
    np.testing.assert_array_equal(kept, unlike)
    expected = []
    for group in range(GROUPS):
        expected += [k for k, way in enumerate(unlike) if way[at.WAY_GROUP] == group][:at_once]
    assert picked.tolist() == expected


def test_of_ways_that_promise_the_same_the_lower_group_comes_first():
    ways = zeros(Way, 4)
    ways["group"] = [1, 0, 1, 0]
    ways["promise"] = [2.0, 2.0, 3.0, 2.0]
    ways["begin"] = [0.0, 1.0, 0.0, 0.5]
    kept, picked = chosen(ways, np.zeros(2), 2, 4)
    assert kept[:, [at.WAY_GROUP, at.WAY_PROMISE, at.WAY_BEGIN]].tolist() == [
        [1, 3, 0], [0, 2, 0.5], [0, 2, 1], [1, 2, 0]
    ]  # fmt: skip
    assert picked.tolist() == [1, 2, 0, 3]


@pytest.mark.parametrize("seed", range(4))
def test_a_way_is_cut_into_pieces(seed):
    path = Path(seed)
    kept, picked = chosen(path.open(), path.largest, 1, GROUPS)
    count = len(picked)
    rows, shares = np.full((PIECES - 1) * count, -7), np.full((PIECES - 1) * count, math.nan)
    places_on_ways(path.s, kept, picked, count, rows, shares)
    inside = path.rng.uniform(-1.0, 2.0, len(rows))
    largest = path.largest.copy()
    ways = np.full((len(kept) - count + PIECES * count, at.WAY_COLUMNS), -7.0)
    assert cut_ways(kept, len(kept), picked, count, inside, largest, ways) == len(ways)
    expected = kept[[k for k in range(len(kept)) if k not in picked.tolist()]]
    assert min(len(expected), count) > 1
    np.testing.assert_array_equal(ways[: len(expected)], expected)
    raised = path.largest.copy()
    for way, row in zip(kept[picked], rows[:count], strict=True):
        assert row == way[at.WAY_ROW]
    pieces = ways[len(expected) :].reshape(PIECES, count, -1)
    for k, way in enumerate(kept[picked]):
        begin, end = way[[at.WAY_S_BEGIN, at.WAY_S_END]]
        s = np.linspace(begin, end, PIECES + 1)
        of_it = np.s_[k::count]
        assert (rows[of_it] == way[at.WAY_ROW]).all()
        np.testing.assert_allclose(shares[of_it], np.arange(1, PIECES) / PIECES, atol=1e-12)
        group = int(way[at.WAY_GROUP])
        raised[group] = max(raised[group], *inside[of_it])
        s = [way[at.WAY_S_BEHIND], *s, way[at.WAY_S_AHEAD]]
        heights = [way[at.WAY_BEHIND], way[at.WAY_BEGIN], *inside[of_it], way[at.WAY_END],
                   way[at.WAY_AHEAD]]  # fmt: skip
        for cut in range(PIECES):
            four = np.s_[cut : cut + 4]
            may = highest(s[four], heights[four])
            piece = [way[at.WAY_ROW], group, *s[four], *heights[four], may]
            np.testing.assert_allclose(pieces[cut, k, COLUMNS], piece, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(largest, raised)


def test_the_figure_of_a_pose(monkeypatch):
    """The friction that it requires, infinite where nothing holds; or how little it may tilt."""
    margins = zeros(Margin, 4)
    margins[:, peak_search.FRICTION] = 0.4, math.nan, math.inf, -math.inf
    found = [peak_search.figure_of(None, None, None, margins, row, 0.0, 5) for row in range(4)]
    assert found == [(0.4, 5), (math.inf, 5), (math.inf, 5), (math.inf, 5)]

    def pose_tilt(ground, body, poses, margins, row, side, tolerance, hint):
        assert (row, tolerance, hint) == (2, 0.0, 5)
        return 0.3 * side, 9.0, 8

    monkeypatch.setattr(peak_search, "pose_tilt", pose_tilt)
    for side in (1.0, -1.0):
        found = peak_search.figure_of(None, None, None, margins, 2, side, 5)
        assert found == (-0.3 * side, 8)
