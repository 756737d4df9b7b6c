"""Peaks of a figure between poses, on figures made by hand."""

import math
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import PIECES
from kaidan.contact.kernel.peaks import LEAST, is_open, promised, slope, told
from kaidan.traversal.peaks import AT_ONCE, ROUNDS, peaks_between

NAN = math.nan


class Poses(SimpleNamespace):
    leads_on = property(contact.Poses.leads_on.func)

    def __len__(self):
        return len(self.s)


class Line:
    """Poses along a line, on each of which a figure is known."""

    def __init__(self, s, leg=None):
        self.s = np.array(s, dtype=float)
        leg = np.zeros(len(self.s)) if leg is None else np.array(leg)
        self.poses = Poses(s=self.s, leg=leg)

    def between(self, rows, shares, *, acceleration):
        assert acceleration == 0.5
        assert (shares > 0).all()
        assert (shares < 1).all()
        return Line(self.s[rows] + shares * (self.s[rows + 1] - self.s[rows]))


def search(figure, s, leg=None, group=None, narrow=None):
    """Largest figure found in between of group 0, the places and the rows."""
    line = Line(s, leg)
    found, rows = peaks_between(
        line, figure(line.s), np.zeros(len(line.s), dtype=int) if group is None else group, 1e-4,
        lambda some: figure(some.s), narrow=narrow, acceleration=0.5,
    )  # fmt: skip
    places = np.concatenate([each.s for each in found]) if found else np.empty(0)
    return max(figure(places), default=-math.inf), places, rows


def test_an_arch_between_two_poses():
    """By hand: 1 at 3.3, and poses at whole places."""
    highest, places, rows = search(lambda s: 1.0 - (s - 3.3) ** 2, range(8))
    assert highest == pytest.approx(1.0, abs=1e-4)
    assert (np.floor(places) == rows).all()
    assert 3 in rows


@pytest.mark.parametrize("at", [2.05, 2.5, 2.95])
@pytest.mark.parametrize("falls", [0.2, 1.0, 30.0])
def test_a_kink_between_two_poses(at, falls):
    """By hand: up by 1 a place, down by something else; no pose of the path is the highest."""
    highest, _, _ = search(lambda s: 5.0 + np.minimum(s - at, falls * (at - s)), range(6))
    assert highest == pytest.approx(5.0, rel=1e-4)


def test_a_peak_hides_before_a_higher_pose():
    """Up, a kink, down and up again between two poses: the middle of three is not the highest."""

    def figure(s):
        return np.interp(s, [0, 1, 2, 2.5, 3, 4], [0.0, 1.0, 1.95, 2.04, 1.96, 2.0])

    highest, _, _ = search(figure, range(5), narrow=np.ones(4, dtype=bool))
    assert highest == pytest.approx(2.04, rel=1e-4)
    assert len(search(figure, range(5))[1]) == 0  # no line tells of it


def test_nothing_is_looked_at_where_nothing_is_promised():
    for figure in (lambda s: 3.0 + 0.0 * s, lambda s: 2.0 * s, lambda s: (s - 3.0) ** 2):
        assert len(search(figure, range(8))[1]) == 0
    # a kink at a pose is no more than the pose
    assert len(search(lambda s: -np.abs(s - 3.0), range(8))[1]) == 0


def test_slope_between_two_poses_at_one_place():
    assert math.isnan(slope(1.0, 1.0, 2.0, 2.0))
    assert math.isnan(slope(1.0, 1.0, NAN, 2.0))
    assert math.isnan(slope(1.0, 1.0, 2.0, NAN))
    assert slope(1.0, 1.0, 2.0, 3.0) == math.inf
    assert slope(1.0, 1.0, 2.0, 1.0) == -math.inf
    assert slope(1.0, 1.0, 2.0, -1.0) == -math.inf


def test_slope_is_not_known_where_either_pose_tells_nothing():
    assert math.isnan(slope(0.0, 1.0, NAN, 2.0))
    assert math.isnan(slope(0.0, 1.0, 2.0, NAN))


@pytest.mark.parametrize(("given", "expected"), [
    # begin, end, slopes before and after a way of 0.5 m
    ((-2.0, -4.0, NAN, NAN), -1.9),  # a twentieth above the higher end
    ((1.0, 2.0, NAN, -3.0), 3.5),  # back along the line after it
    ((1.0, 2.0, 4.0, NAN), 3.0),  # on along the line before it
    ((1.0, 2.0, NAN, 5.0), 2.0),  # the line behind it lies lower: no more than its end
    ((2.0, 1.0, -5.0, NAN), 2.0),
    ((1.0, 1.0, 3.0, -1.0), 1.375),  # the lines meet after an eighth of a metre
    ((1.0, 1.0, 3.0, -3.0), 1.75),  # halfway
    ((1.0, 2.0, 2.0, 2.0), 2.0),  # a line
    ((1.0, 1.0, -1.0, 1.0), 1.0),  # a hollow
    ((1.0, 3.0, 1.0, -1.0), 3.0),  # the lines meet beyond its end
    ((3.0, 1.0, 1.0, -1.0), 3.0),  # and before its begin
])  # fmt: skip
def test_what_lines_through_the_outer_poses_promise(given, expected):
    assert promised(0.5, *given) == pytest.approx(expected, abs=1e-12)


def test_a_way_is_open_that_promises_more_than_the_tolerance():
    for largest in (4.0, -4.0):
        most = largest + LEAST + 0.1 * 4.0
        assert is_open(most + 1e-9, largest, 0.1)
        assert not is_open(most - 1e-9, largest, 0.1)


def test_told_where_a_line_leads_on_between_known_figures():
    line = np.array([1, 0, 1, 1, 1, 1, 1])
    values = np.array([1.0, 2.0, 3.0, math.inf, -math.inf, 4.0, 5.0])
    assert [told(line, values, row) for row in range(-1, 7)] == [
        False, True, False, False, False, False, True, False,
    ]  # fmt: skip
    for hidden in (math.inf, -math.inf, NAN):
        assert not told(line, np.array([hidden, 2.0]), 0)
        assert not told(line, np.array([2.0, hidden]), 0)


def arch(s):
    return 1.0 - (s - 2.5) ** 2


def test_no_way_leads_over_an_exchange_or_from_what_is_not_known():
    """The arch is highest between the poses at 2 and 3."""
    cases = [
        search(arch, range(6), leg=[0, 0, 0, 1, 1, 1]),
        search(lambda s: np.where(s == 2.0, math.inf, arch(s)), range(6)),
        search(arch, range(6), group=np.array([0, 0, -1, 0, 0, 0])),
    ]
    for case in cases:
        assert not ((case[1] > 2.0) & (case[1] < 3.0)).any()


def test_each_group_has_its_own_largest():
    """The lower of two arches counts if it is of another group."""
    figure = lambda s: np.maximum(9.0 - (s - 2.5) ** 2, 3.0 - (s - 12.5) ** 2)  # noqa: E731
    one = search(figure, range(16))
    assert (one[1] < 8).all()
    two = search(figure, range(16), group=np.repeat([0, 1], 8))
    beyond = two[1][two[1] > 8]
    assert figure(beyond).max() == pytest.approx(3.0, rel=1e-4)


def test_what_repeats_itself_is_looked_at_once():
    highest, places, _ = search(lambda s: 2.0 + np.sin(2.0 * math.pi * (s - 0.3) / 6.0), range(37))
    assert highest == pytest.approx(3.0, rel=1e-4)
    assert len(places) <= 2 * ROUNDS * PIECES
    assert len(np.unique(np.floor(places / 6.0))) <= 2


def test_the_search_ends():
    rng = np.random.default_rng(1)
    noise = lambda s: rng.random(len(s))  # noqa: E731
    _, places, _ = search(noise, range(300))
    assert len(places) <= ROUNDS * AT_ONCE * (PIECES - 1)


def test_lines_through_the_neighbours_bound_a_figure():
    """By hand."""
    cases = [
        ([0.0, 1.0, 1.0, 0.0], 1.5),  # up 1, down 1: they meet halfway
        ([0.0, 1.0, 0.5, 0.0], 1.0),  # down from the pose on
        ([0.0, 1.0, 3.0, 2.0], 3.0),  # steeper in between than before
        ([0.0, 2.0, 2.0, 1.0], 2.0 + 2.0 / 3.0),  # 2 + 2 x = 2 + (1 - x)
        ([NAN, 1.0, 1.0, 0.0], 2.0),  # nothing is known behind: back along the other line
        ([0.0, 1.0, 1.0, NAN], 2.0),
        ([NAN, 1.0, 1.0, NAN], 1.05),
        ([NAN, 1.0, 2.0, 3.0], 2.0),
    ]
    for height, expected in cases:
        before, _, after = (slope(0.0, 1.0, one, other) for one, other in pairwise(height))
        assert promised(1.0, *height[1:3], before, after) == pytest.approx(expected, abs=1e-12), (
            height
        )
