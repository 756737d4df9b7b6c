"""Peaks of a figure between poses, on figures made by hand."""

import math
from itertools import pairwise

import numpy as np
import pytest

from kaidan.contact import layout as at
from kaidan.contact.codes import CUT_AT_ONCE, PIECES, ROUNDS
from kaidan.contact.kernel import peak_search
from kaidan.contact.kernel.peaks import LEAST, is_open, promised, slope, told
from kaidan.contact.scratch import peak_scratch

NAN = math.nan


def search(figure, s, leg=0.0, group=None, narrow=None):
    """Largest figure found in between of group 0, the places and the rows."""
    poses = np.full((len(s), at.POSE_COLUMNS), NAN)
    poses["s"], poses["leg"] = s, leg
    group = np.zeros(len(s), dtype=int) if group is None else group
    narrow = np.zeros(len(s), dtype=int) if narrow is None else narrow

    def poses_between(ground, body, of, rows, shares, count, new):
        assert ((shares[:count] > 0) & (shares[:count] < 1)).all()
        begin = of["s"][rows[:count]]
        new["s"][:count] = begin + shares[:count] * (of["s"][rows[:count] + 1] - begin)

    def pose_margins(ground, body, new, count, a, g, touch, margins, contacts):
        assert (a, g, touch) == (0.5, 9.8, 1e-9)
        margins["traction"][:count] = new["s"][:count]

    def figure_of(ground, body, new, margins, row, side, hint):
        assert side == -1.0
        return float(figure(margins["traction"][row])), hint

    scratch = peak_scratch(len(s), int(group.max()) + 1)
    with pytest.MonkeyPatch.context() as patch:
        for each in (poses_between, pose_margins, figure_of):
            patch.setattr(peak_search, each.__name__, each)
        count = peak_search.find_peaks(
            None, None, poses, figure(poses["s"]), group, narrow, 1e-4, -1.0, 0.5, 9.8,
            1e-9, *scratch,
        )  # fmt: skip
    rows, between, margins = (each[:count].copy() for each in scratch[-3:])
    places = between["s"]
    assert (margins["traction"] == places).all()
    return max(figure(places), default=-math.inf), places, rows


def test_an_arch_between_two_poses():
    """By hand: 1 at 3.3, and poses at whole places."""
    highest, places, rows = search(lambda s: 1.0 - (s - 3.3) ** 2, range(8))
    assert highest == pytest.approx(1.0, abs=1e-4)
    assert (np.floor(places) == rows).all()
    assert 3 in rows


@pytest.mark.parametrize("place", [2.05, 2.5, 2.95])
@pytest.mark.parametrize("falls", [0.2, 1.0, 30.0])
def test_a_kink_between_two_poses(place, falls):
    """By hand: up by 1 a place, down by something else; no pose of the path is the highest."""
    highest, _, _ = search(lambda s: 5.0 + np.minimum(s - place, falls * (place - s)), range(6))
    assert highest == pytest.approx(5.0, rel=1e-4)


def test_a_peak_hides_before_a_higher_pose():
    """Up, a kink, down and up again between two poses: the middle of three is not the highest."""

    def figure(s):
        return np.interp(s, [0, 1, 2, 2.5, 3, 4], [0.0, 1.0, 1.95, 2.04, 1.96, 2.0])

    highest, _, _ = search(figure, range(5), narrow=np.ones(5, dtype=int))
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
    noise = lambda s: rng.random(np.shape(s))  # noqa: E731
    _, places, _ = search(noise, range(300))
    assert len(places) <= ROUNDS * CUT_AT_ONCE * (PIECES - 1)


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


def test_the_figures_of_which_peaks_are_looked_for(monkeypatch):
    """Friction, infinite where nothing holds; or minus the tilt at which a pose rotates at all."""
    margins = np.full((4, at.MARGIN_COLUMNS), 7.0)
    margins["required_friction"] = [0.4, NAN, -math.inf, math.inf]
    found = [peak_search.figure_of(None, None, None, margins, row, 0.0, 3) for row in range(4)]
    assert found == [(0.4, 3), *[(math.inf, 3)] * 3]

    def pose_tilt(ground, body, poses, of, row, side, tolerance, hint):
        assert of is margins
        return 0.1 * row + side, tolerance, hint + 1

    monkeypatch.setattr(peak_search, "pose_tilt", pose_tilt)
    for side in (1.0, -1.0):
        found = peak_search.figure_of(None, None, "poses", margins, 2, side, 3)
        assert found == (pytest.approx(-0.2 - side), 4)


def test_a_way_leads_on_along_one_line_of_poses_and_over_a_distance():
    """Poses 1e-8 m apart stand at one place; what lies between two lines is a rotation."""
    tent = lambda s: 1.0 - np.abs(s - 0.5)  # noqa: E731
    hides = np.ones(2, dtype=int)
    assert len(search(tent, [0.0, 0.9], narrow=hides)[1])
    assert len(search(tent, [0.0, 0.9], leg=[0, 1], narrow=hides)[1]) == 0
    flat = lambda s: 1.0 + 0.0 * s  # noqa: E731
    for apart, looks in ((0.9e-8, False), (1.1e-8, True)):
        assert bool(len(search(flat, [0.0, apart], narrow=hides)[1])) is looks


def test_places_of_one_search_do_not_stay_for_the_next():
    """Its tables are those of the thread, which has room for the longest so far."""
    one = peak_scratch(5, 2)
    assert peak_scratch(4, 1) is one
    longer = peak_scratch(len(one.s) + 1, 1)
    assert len(longer.largest) == len(one.largest)
    assert len(longer.s) == len(longer.line) == len(one.s) + 1
    wider = peak_scratch(3, len(longer.largest) + 1)
    assert (len(wider.largest), len(wider.s)) == (len(longer.largest) + 1, len(longer.s))
    places = (PIECES - 1) * CUT_AT_ONCE * len(wider.largest)
    for each in (wider.rows, wider.between, wider.margins):
        assert len(each) == ROUNDS * places
    for each in (wider.ways, wider.kept, wider.order):
        assert len(each) == len(wider.s) + ROUNDS * places
    first = search(arch, range(6))
    search(lambda s: -arch(s), range(9))
    again = search(arch, range(6))
    assert first[0] == again[0]
    assert first[1].tolist() == again[1].tolist()
