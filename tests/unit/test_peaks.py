"""Peaks of a figure between poses, on figures made by hand."""

import math
from itertools import pairwise

import numpy as np
import pytest

from kaidan.contact.codes import CUT_AT_ONCE, PIECES, ROUNDS
from kaidan.contact.kernel import peak_search
from kaidan.contact.kernel.peaks import LEAST, is_open, promised, slope, told
from kaidan.contact.layout import Figures, Margin, Pose, Pull, Samples
from kernel_memory import made, nothing, numbers, table

NAN = math.nan


def search(figure, s, leg=0.0, group=None, narrow=None):
    """Largest figure found in between of group 0, the places and the rows."""
    count = len(s)
    poses = nothing(Pose, count)
    poses["s"], poses["leg"] = s, leg
    group = np.zeros(count, dtype=int) if group is None else group
    narrow = np.zeros(count, dtype=bool) if narrow is None else narrow

    def poses_between(scene, of, rows, shares, new):
        for k, pose in enumerate(new):
            assert 0.0 < shares[k] < 1.0
            begin, end = of[rows[k]].s, of[rows[k] + 1].s
            pose.s = begin + shares[k] * (end - begin)

    def pose_margins(scene, new, pull, margins):
        assert pull == Pull(0.5, 9.8)
        for pose, margin in zip(new, margins, strict=True):
            margin.traction = pose.s

    def figure_of(scene, pose, margin, side):
        assert side == -1.0
        assert margin.traction == pose.s
        return float(figure(margin.traction))

    groups = int(group.max()) + 1
    room = peak_search.most_peaks(groups)
    found = Samples(numbers(np.zeros(room), int), table(Pose, room), table(Margin, room))
    figures = Figures(
        numbers(np.zeros(count)), numbers(np.zeros(count), bool), numbers(figure(poses["s"])),
        numbers(group, int), numbers(narrow, bool),
    )  # fmt: skip
    with pytest.MonkeyPatch.context() as patch:
        for each in (poses_between, pose_margins, figure_of):
            patch.setattr(peak_search, each.__name__, each)
        how = groups, 1e-4, -1.0, Pull(0.5, 9.8)
        count = peak_search.find_peaks(None, table(Pose, poses), figures, *how, found)
    places = np.array([pose.s for pose in found.poses[0:count]])
    rows = np.array(list(found.rows)[:count])
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

    highest, _, _ = search(figure, range(5), narrow=np.ones(5, dtype=bool))
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
    line = [True, False, True, True, True, True, True]

    def figures(*values):
        return Figures(None, line, values, None, None)

    values = figures(1.0, 2.0, 3.0, math.inf, -math.inf, 4.0, 5.0)
    assert [told(values, row) for row in range(-1, 7)] == [
        False, True, False, False, False, False, True, False,
    ]  # fmt: skip
    for hidden in (math.inf, -math.inf, NAN):
        assert not told(figures(hidden, 2.0), 0)
        assert not told(figures(2.0, hidden), 0)


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
    rows = [{"required_friction": mu} for mu in (0.4, NAN, -math.inf, math.inf)]
    margins = table(Margin, made(Margin, *rows))
    found = [peak_search.figure_of(None, None, margin, 0.0) for margin in margins]
    assert found == [0.4, *[math.inf] * 3]

    def pose_tilt(scene, pose, margin, side, tolerance):
        assert margin is margins[2]
        return 0.2 + side, tolerance

    monkeypatch.setattr(peak_search, "pose_tilt", pose_tilt)
    for side in (1.0, -1.0):
        found = peak_search.figure_of(None, "pose", margins[2], side)
        assert found == pytest.approx(-0.2 - side)


def test_a_way_leads_on_along_one_line_of_poses_and_over_a_distance():
    """Poses 1e-8 m apart stand at one place; what lies between two lines is a rotation."""
    tent = lambda s: 1.0 - np.abs(s - 0.5)  # noqa: E731
    hides = np.ones(2, dtype=bool)
    assert len(search(tent, [0.0, 0.9], narrow=hides)[1])
    assert len(search(tent, [0.0, 0.9], leg=[0, 1], narrow=hides)[1]) == 0
    flat = lambda s: 1.0 + 0.0 * s  # noqa: E731
    for apart, looks in ((0.9e-8, False), (1.1e-8, True)):
        assert bool(len(search(flat, [0.0, apart], narrow=hides)[1])) is looks


def test_places_of_one_search_do_not_stay_for_the_next():
    first = search(arch, range(6))
    search(lambda s: -arch(s), range(9))
    again = search(arch, range(6))
    assert first[0] == again[0]
    assert first[1].tolist() == again[1].tolist()
