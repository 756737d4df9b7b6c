"""Ways that are open, chosen and cut, against the same rules written out in Python.

A way leads from a pose to the next. On it a figure may be as high as where the lines through its
outer poses meet.
"""

import math
from dataclasses import astuple, replace

import numpy as np
import pytest

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
from kaidan.contact.layout import Figures, Margin, Way
from kernel_memory import made, table

TOLERANCE = 0.01
ROWS, GROUPS = 80, 12


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
        self.line = rng.random(ROWS - 1) < 0.9
        self.values = rng.uniform(-1.0, 1.0, ROWS)
        self.group = rng.integers(-1, GROUPS - 2, ROWS)  # none of the last but one
        self.group[-1] = GROUPS - 1
        hidden = rng.random(ROWS) < 0.1
        self.values[hidden] = -math.inf
        self.values[hidden & (self.group < 0)] = rng.choice([math.nan, math.inf])
        self.narrow = rng.random(ROWS - 1) < 0.2
        self.rng = rng

    def open(self):
        self.largest = np.empty(GROUPS)
        ways = table(Way, ROWS)
        figures = Figures(self.s, self.line, self.values, self.group, self.narrow)
        count = open_ways(figures, TOLERANCE, self.largest, ways)
        return list(ways[0:count])

    def known(self, row):
        """Whether the path leads on from a pose, and the figure is known there and at the next."""
        return (
            0 <= row < ROWS - 1 and self.line[row]
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
    np.testing.assert_allclose(list(map(astuple, found)), expected, rtol=0, atol=1e-12)


def test_the_last_way_of_a_path_is_one():
    """By hand: it rises by 1 a metre to the last but one and is level then."""
    s, values = np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 1.0])
    ways = table(Way, 3)
    figures = Figures(s, [True] * 3, values, [0] * 3, [False] * 3)
    assert open_ways(figures, TOLERANCE, np.empty(1), ways) == 1
    assert (ways[0].row, ways[0].promise) == (1, 2.0)


def chosen(ways, largest, at_once, room):
    kept, picked = table(Way, len(ways)), np.full(room, -7)
    given = [replace(way) for way in ways]
    many, found = chosen_ways(given, largest, TOLERANCE, at_once, kept, picked)
    return list(kept[0:many]), picked[:found]


@pytest.mark.parametrize("at_once", [1, 2, 3])
@pytest.mark.parametrize("seed", range(4))
def test_the_most_promising_ways_are_cut_first(seed, at_once):
    """Of ways alike in group, promise and ends the first one as they stand."""
    path = Path(seed)
    ways = path.open()
    rng = path.rng
    # repeated: at another place, and by less than a billionth something else
    half = len(ways)
    ways += [replace(way, row=way.row + 1000, promise=way.promise + 1e-11) for way in ways]
    ways = [ways[k] for k in rng.permutation(len(ways))]
    largest = path.largest + 0.3  # some promise enough no more
    kept, picked = chosen(ways, largest, at_once, GROUPS * at_once)
    seen, unlike = set(), []
    for way in ways:
        key = (way.group, *(round(each, 9) for each in (way.promise, way.begin, way.end)))
        if opened(way.promise, largest[way.group]) and key not in seen:
            seen.add(key)
            unlike.append(way)
    assert 3 < len(unlike) < half
    unlike.sort(key=lambda way: -way.promise)
    assert list(map(repr, kept)) == list(map(repr, unlike))
    expected = []
    for group in range(GROUPS):
        expected += [k for k, way in enumerate(unlike) if way.group == group][:at_once]
    assert picked.tolist() == expected


def test_of_ways_that_promise_the_same_the_lower_group_comes_first():
    each = (1, 2.0, 0.0), (0, 2.0, 1.0), (1, 3.0, 0.0), (0, 2.0, 0.5)
    rows = [dict(zip(("group", "promise", "begin"), one, strict=True)) for one in each]
    kept, picked = chosen(table(Way, made(Way, *rows)), np.zeros(2), 2, 4)
    assert [(way.group, way.promise, way.begin) for way in kept] == [
        (1, 3, 0), (0, 2, 0.5), (0, 2, 1), (1, 2, 0)
    ]  # fmt: skip
    assert picked.tolist() == [1, 2, 0, 3]


@pytest.mark.parametrize("seed", range(4))
def test_a_way_is_cut_into_pieces(seed):
    path = Path(seed)
    kept, picked = chosen(path.open(), path.largest, 1, GROUPS)
    count = len(picked)
    rows, shares = np.full((PIECES - 1) * count, -7), np.full((PIECES - 1) * count, math.nan)
    places_on_ways(path.s, kept, picked, rows, shares)
    inside = path.rng.uniform(-1.0, 2.0, len(rows))
    largest = path.largest.copy()
    ways = table(Way, len(kept) - count + PIECES * count)
    assert cut_ways(kept, picked, inside, largest, ways) == len(ways)
    expected = [way for k, way in enumerate(kept) if k not in picked.tolist()]
    cut_first = [kept[k] for k in picked]
    assert min(len(expected), count) > 1
    assert list(map(repr, ways[0 : len(expected)])) == list(map(repr, expected))
    raised = path.largest.copy()
    for way, row in zip(cut_first, rows[:count], strict=True):
        assert row == way.row
    pieces = np.reshape([astuple(way) for way in ways[len(expected) :]], (PIECES, count, -1))
    for k, way in enumerate(cut_first):
        s = np.linspace(way.s_begin, way.s_end, PIECES + 1)
        of_it = np.s_[k::count]
        assert (rows[of_it] == way.row).all()
        np.testing.assert_allclose(shares[of_it], np.arange(1, PIECES) / PIECES, atol=1e-12)
        group = way.group
        raised[group] = max(raised[group], *inside[of_it])
        s = [way.s_behind, *s, way.s_ahead]
        heights = [way.behind, way.begin, *inside[of_it], way.end, way.ahead]
        for cut in range(PIECES):
            four = np.s_[cut : cut + 4]
            may = highest(s[four], heights[four])
            piece = [way.row, group, *s[four], *heights[four], may]
            np.testing.assert_allclose(pieces[cut, k], piece, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(largest, raised)


def test_the_figure_of_a_pose(monkeypatch):
    """The friction that it requires, infinite where nothing holds; or how little it may tilt."""
    rows = [{"required_friction": mu} for mu in (0.4, math.nan, math.inf, -math.inf)]
    margins = table(Margin, made(Margin, *rows))
    found = [peak_search.figure_of(None, None, margin, 0.0) for margin in margins]
    assert found == [0.4, math.inf, math.inf, math.inf]

    def pose_tilt(scene, pose, margin, side, tolerance):
        assert (pose, margin, tolerance) == ("pose", margins[2], 0.0)
        return 0.3 * side, 9.0

    monkeypatch.setattr(peak_search, "pose_tilt", pose_tilt)
    for side in (1.0, -1.0):
        assert peak_search.figure_of(None, "pose", margins[2], side) == -0.3 * side
