"""Tilt to the first rock, on poses whose tilts are known; nothing else of the kernel runs."""

import math
from typing import NamedTuple

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact.kernel import first_rock as module
from kaidan.contact.layout import Looked, Margin, Pose, Pull
from kernel_memory import nothing, numbers, table

PLACE = 1e-6
INF = math.inf
PULL = Pull(0.7, 9.8)


class Onto(NamedTuple):
    """Nosing that is rocked onto between two places."""

    begin: float = 1.5
    end: float = 2.25
    rocking: float = 0.02
    tilt: float = 0.3
    """At which it rotates by more."""
    alone: float = 0.1
    """At which it rotates at all."""


class Way:
    """Poses at some places: it rotates at 0.1 + 0.05 s where no nosing is rocked onto.

    Nose down by 0.1 to each metre.
    """

    def __init__(self, places, *nosings, leg=0.0):
        poses = nothing(Pose, len(places))
        poses["s"] = places
        poses["inclination"] = -0.1 * poses["s"]
        poses["leg"] = leg
        self.poses, self.margins = table(Pose, poses), table(Margin, nothing(Margin, len(poses)))
        self.looked_at, self.nosings = [], nosings
        self.hidden = ()
        """Rows at which nothing is rocked onto."""


@pytest.fixture
def kernel(monkeypatch):
    """The way at hand, and poses between two that a search finds."""
    given = {"way": None, "dips": ([], [])}

    def pose_tilt(scene, pose, margin, side, tolerance):
        assert side == -1.0
        way, s = given["way"], pose.s
        own = [k for k, each in enumerate(way.poses) if each is pose]
        assert own == [k for k, each in enumerate(way.margins) if each is margin]
        alone, rocking, tilt = 0.1 + 0.05 * s, 0.0, 0.1 + 0.05 * s
        for each in way.nosings:
            if each.begin <= s <= each.end:
                alone, rocking, tilt = each.alone, each.rocking, each.tilt
        if tolerance == 0.0:
            return alone, 0.0
        way.looked_at += own
        if rocking > tolerance:
            return alone, 0.0
        return tilt, 0.0 if set(own) & set(way.hidden) else rocking

    def poses_between(scene, poses, rows, shares, new):
        assert len(new) == 1
        begin, end = poses[rows[0]].s, poses[rows[0] + 1].s
        new[0].s = begin + shares[0] * (end - begin)
        new[0].inclination = -0.1 * new[0].s

    def pose_margins(scene, new, pull, margins):
        assert (len(new), pull) == (1, PULL)

    def find_peaks(scene, poses, figures, groups, tolerance, side, pull, found):
        assert (groups, tolerance, side, pull) == (1, 1e-5, -1.0, PULL)
        assert not any(figures.narrow)
        given.update(values=list(figures.values), group=list(figures.group))
        rows, places = given["dips"]
        for k, (row, place) in enumerate(zip(rows, places, strict=True)):
            found.rows[k] = row
            found.poses[k].s, found.poses[k].inclination = place, -0.1 * place
        return len(rows)

    for each in (pose_tilt, poses_between, pose_margins, find_peaks):
        monkeypatch.setattr(module, each.__name__, each)
    return given


METERS = range(6)
"""Places of poses."""
NOTHING = (INF, -1)
REACHED, LEFT = 0.1 + 0.05 * 1.5, 0.1 + 0.05 * 2.25 - 0.02
"""Just before 1.5, and just behind 2.25 less the rocking."""


def looked_at(rows, alone):
    """Poses of the path, and tilts at which each rotates at all."""
    return Looked(numbers(rows, int), None, None, numbers(alone), None)


@pytest.fixture
def lost(kernel):
    def found(way, rocking, rows, least=0.2, lowest=0.0, whence=-INF):
        kernel["way"] = way
        size = len(way.poses)
        group, beside = np.full(size, -1), numbers(np.full(size, True), bool)
        group[list(rows)] = 0
        back = numbers(np.full(size, whence))
        may = looked_at(rocking, np.full(len(rocking), -INF))
        of = None, way.poses, way.margins
        module.mark_ways(*of, may, -1.0, back, least, numbers(group, int), beside)
        return module.lost_between(*of, beside, -1.0, back, least, lowest, PULL)

    return found


@pytest.fixture
def rock(kernel):
    def found(way, rows=None, own=None, whence=None):
        kernel["way"] = way
        size = len(way.poses)
        rows = numbers(range(size) if rows is None else rows, int)
        back = numbers(np.full(size, -INF) if whence is None else whence)
        own = size if own is None else own
        return module.first_rock(None, way.poses, way.margins, rows, own, -1.0, back, PULL)

    return found


def test_where_the_flat_leaves_a_nosing_that_it_would_rock_onto(lost):
    """Beside it nothing is there to rock onto, and left it is steeper by what it rocked."""
    way = Way(METERS, Onto())
    tilt, row = lost(way, [2], METERS)
    assert (tilt, row) == (pytest.approx(REACHED, abs=PLACE), 1)
    assert tilt < REACHED  # beyond it, not on it
    # poses that do not count, on either side
    for rows in ([2, 3, 4], [0, 2, 3, 4]):
        tilt, row = lost(way, [2], rows)
        assert (tilt, row) == (pytest.approx(LEFT, abs=PLACE), 2)
        assert tilt > LEFT
    assert lost(way, [2], [0, 1, 2])[1] == 1
    # what lies between two lines of poses is a rotation
    assert lost(Way(METERS, Onto(), leg=[0, 0, 1, 1, 1, 1]), [2], METERS)[1] == 2
    assert lost(Way(METERS, Onto(), leg=[0, 0, 0, 1, 1, 1]), [2], METERS)[1] == 1
    assert lost(Way(METERS, Onto(), leg=[0, 0, 1, 2, 2, 2]), [2], METERS) == NOTHING
    assert lost(Way([0, 1, 1.6, 1.6, 3, 4], Onto()), [3], [2, 3]) == NOTHING
    # where nothing is rocked onto, or all the way
    assert lost(way, [], METERS) == lost(way, [0, 4], METERS) == NOTHING
    assert lost(Way([1.6, 1.7, 1.8], Onto()), [1], range(3), least=1.0) == NOTHING
    # beside the last pose of those alone
    found = lost(Way([1.6, 1.9, 3.0], Onto()), [1], range(3))
    assert found == (pytest.approx(LEFT, abs=PLACE), 1)
    # the longest way too is halved to the end
    found = lost(Way([1.49, 1.6, 5.0], Onto(rocking=0.044)), [1], range(3), least=0.25)
    assert found == (pytest.approx(LEFT + 0.02 - 0.044, abs=PLACE), 1)


def test_a_short_way_is_halved_as_often_as_the_longest(lost, kernel, monkeypatch):
    """Of 2 m and 0.2 m, to a millionth of a metre on the long one: 21 looks each, and both ends."""
    looks = []

    def between_tilt(scene, poses, row, share, *rest):
        looks.append(row)
        return between(scene, poses, row, share, *rest)

    between = module.between_tilt
    monkeypatch.setattr(module, "between_tilt", between_tilt)
    lost(Way([1.4, 1.6, 3.6], Onto()), [1], range(3), least=0.25)
    assert looks == [0] * 23 + [1] * 23
    looks.clear()
    lost(Way([1.4, 1.6], Onto()), [1], range(2), least=0.25)
    assert looks == [0] * 20


def test_left_it_is_no_steeper_than_where_it_rocked_nowhere(lost):
    way = Way(METERS, Onto())
    assert lost(way, [2], [2, 3], lowest=0.2) == (pytest.approx(0.2), 2)
    assert lost(way, [2], [2, 3], lowest=0.4)[0] == pytest.approx(LEFT + 0.02, abs=PLACE)


def test_where_it_may_be_the_least(lost):
    """Beside it the tilt is 0.25: less what it rocked, and by what a few millimetres change."""
    way, between = Way(METERS, Onto()), 0.25 - 0.02 - contact.ROCKING
    assert lost(way, [2], [2, 3], least=between - 1e-9) == NOTHING
    assert lost(way, [2], [2, 3], least=between + 1e-9)[1] == 2


def test_what_hardly_differs_is_no_jump(lost):
    """By a billionth the rocking, or the tilt, differs through rounding."""
    for off, jumps in ((0.9e-9, False), (1.1e-9, True)):
        one = Onto(end=2.0, rocking=0.02, tilt=0.3)
        for other in (one._replace(rocking=0.02 + off), one._replace(tilt=0.3 + off)):
            found = lost(Way([2, 3], one, other._replace(begin=2.5, end=3.5)), [0], range(2), 1.0)
            assert (found != NOTHING) is jumps


def test_back_to_where_it_came_down_from_is_rocking(lost, rock):
    """As far as that inclination, and rocking beyond; so much steeper it is where that is left."""
    far = Onto(rocking=contact.ROCKING + 0.07)
    assert lost(Way(METERS, far), [2], METERS) == NOTHING
    assert lost(Way(METERS, far), [2], METERS, whence=-0.2 + 0.07 - 1e-9) == NOTHING
    # 0.225 behind 2.25 it has come down to 0.025 below -0.2
    found = lost(Way(METERS, far), [2], METERS, whence=-0.2 + 0.07 + 0.025 + 1e-6)
    assert found == (pytest.approx(LEFT + 0.02 - far.rocking, abs=PLACE), 2)
    way = Way([1.6, 1.9], far)
    assert rock(way) == (pytest.approx(0.1), 0)
    assert rock(way, whence=np.full(2, -0.16 + 0.07 + 1e-9)) == (pytest.approx(0.3), 0)


def test_what_a_pose_rocks_onto_reaches_as_far_as_it_came_down_there(lost):
    """At 2.0 it is nose down by 0.2, from -0.05 so 0.15 is rocking; at 0.0 none would be."""
    far = Onto(rocking=contact.ROCKING + 0.07)
    found = lost(Way(METERS, far), [2], [1, 2], whence=-0.05)
    assert found == (pytest.approx(REACHED, abs=PLACE), 1)


def test_at_one_place_nothing_is_halved_out(lost):
    """Two poses of one place, one of them on the nosing: an exchange of contacts."""
    way = Way([2.0, 2.0], Onto())
    way.hidden = (1,)
    assert lost(way, [0], [0, 1], least=1.0) == NOTHING


def test_from_one_nosing_that_it_rocks_onto_to_the_next(lost):
    """There it is steeper by the difference, and no steeper where the next asks for more."""
    one, other = Onto(rocking=0.02), Onto(2.25, 3.5, rocking=0.005, tilt=0.22)
    found = lost(Way([2, 3], one, other), [0, 1], range(2))
    assert found == (pytest.approx(0.22 - 0.015), 0)
    one, other = one._replace(rocking=0.005), other._replace(rocking=0.02)
    assert lost(Way([2, 3], one, other), [0, 1], range(2)) == (pytest.approx(0.22), 0)
    # the same rocking, another tilt
    other = other._replace(rocking=0.005, tilt=0.1)
    assert lost(Way([2, 3], one, other), [0, 1], range(2)) == (pytest.approx(0.1), 0)


@pytest.mark.parametrize(("share", "of_tilt"), [(0.249, True), (0.251, False)])
def test_the_tilt_jumps_where_the_rocking_hardly_does(share, of_tilt, lost):
    """Of three stretches the rocking jumps at the end of the first, the tilt at 2.75."""
    nosings = (
        Onto(2.0, 2.25, rocking=0.02, tilt=0.3),
        Onto(2.25, 2.75, rocking=(1.0 - share) * 0.02, tilt=0.3 - 1e-7),
        Onto(2.75, 3.0, rocking=(1.0 - share) * 0.02, tilt=0.1),
    )
    tilt, _ = lost(Way([2.0, 3.0], *nosings), [0], range(2), least=1.0)
    expected = 0.1 if of_tilt else 0.3 - 1e-7 - 0.02 * share
    assert tilt == pytest.approx(expected, abs=1e-12)


def test_at_the_ends_of_a_path(lost):
    assert lost(Way([2.0, 3.0], Onto()), [0], range(2)) == (pytest.approx(LEFT, abs=PLACE), 0)
    assert lost(Way([1.0, 2.0], Onto()), [1], range(2)) == (pytest.approx(REACHED, abs=PLACE), 0)


def test_of_places_that_are_alike_the_first(lost):
    """Left, both nosings leave it at what it rocked nowhere below."""
    nosings = [Onto(k - 0.03, k + 0.03, rocking=0.04, tilt=0.5) for k in (4.55, 4.65)]
    way = Way([4.5, 4.55, 4.6, 4.65, 4.7], *nosings)
    assert lost(way, [1, 3], range(5), least=0.3, lowest=0.32) == (0.32, 1)


def test_the_first_rock_by_hand(rock):
    assert rock(Way([5, 4, 3, 4])) == (pytest.approx(0.25), 2)
    # by more than rocking
    near = Way([1.6, 2.0, 2.2], Onto(alone=0.05, tilt=0.12))
    assert rock(near) == (pytest.approx(0.12), 0)
    # between the second and the third pose it leaves the nosing, and the first pose is less
    rocks = Onto(alone=0.05, tilt=0.6)
    assert rock(Way([1.0, 2.0, 4.0, 5.0], rocks)) == (pytest.approx(0.15), 0)
    found = rock(Way([1.4, 1.6, 5.0], rocks), rows=[1, 2])
    assert found == (pytest.approx(LEFT, abs=PLACE), 1)
    found = rock(Way([4.0, 2.0, 2.5, 5.0], rocks), rows=[1, 2, 3])
    assert found == (pytest.approx(LEFT, abs=PLACE), 1)
    # below 0.2 it rocks nowhere
    found = rock(Way([1.6, 5.0], rocks._replace(alone=0.2)))
    assert found == (pytest.approx(0.2), 0)
    # poses between two say nothing of what lies beside them
    found = rock(Way([4.0, 2.0, 2.5, 5.0], rocks), own=2)
    assert found == (pytest.approx(0.1 + 0.05 * 2.5), 2)


def test_a_nosing_onto_which_only_a_tilt_beyond_the_least_would_rock(rock):
    """Its loss is less than any pose, for the robot rocked elsewhere already."""
    rocks = Onto(0.2, 0.4, rocking=0.045, tilt=0.6, alone=0.05)
    left = Onto(1.5, 2.25, rocking=0.045, tilt=0.6, alone=0.19)
    places = [0.3, 1.45, 2.0, 3.0]
    assert rock(Way([0.3, 1.45], rocks, leg=[0, 1])) == (pytest.approx(0.1725), 1)
    found = rock(Way(places, rocks, left, leg=[0, 1, 2, 2]))
    assert found == (pytest.approx(0.1 + 0.05 * 2.25 - 0.045, abs=PLACE), 2)


def test_poses_are_looked_at_as_long_as_they_may_be_the_least(rock):
    """Eight at a time, those first that rotate first, and each of them for a nosing beside it."""
    way = Way(np.linspace(30.0, 3.0, 28), leg=range(28))
    assert rock(way) == (pytest.approx(0.25), 27)
    assert way.looked_at[:8] == list(range(27, 19, -1))
    assert set(way.looked_at) == set(range(20, 28))
    rocks = Onto(alone=0.05, tilt=0.36)
    way = Way(np.r_[np.linspace(1.6, 2.2, 12), np.linspace(5.0, 30.0, 20)], rocks, leg=range(32))
    rock(way)
    assert set(way.looked_at) == set(range(16))
    # those that are alike after eight of them are not
    way = Way([3.0] * 16, leg=range(16))
    rock(way)
    assert way.looked_at[:9] == [*range(8), 0]
    # fewer than eight are left
    way = Way([3.0, 4.0, 5.0], leg=range(3))
    rock(way)
    assert way.looked_at[:3] == [0, 1, 2]


def test_dips_are_looked_for_between_poses_that_follow_one_another(rock, kernel):
    """Of the poses that count: minus the tilt has a peak where the tilt has a dip."""
    rock(Way([4.0, 3.0, 2.0, 0.0, 1.0]), rows=[1, 2, 4], own=4)
    assert kernel["values"] == [-INF, pytest.approx(-0.25), pytest.approx(-0.2), -INF, -INF]
    assert kernel["group"] == [-1, 0, 0, -1, -1]


@pytest.mark.parametrize(("off", "row"), [(-1e-6, 3), (-1e-10, 2), (0.0, 2), (1e-6, 2)])
def test_what_is_lost_counts_where_it_is_less(off, row, rock, monkeypatch):
    """The least of any pose is 0.25, of the third."""
    monkeypatch.setattr(module, "lost_between", lambda *given: (0.25 + off, 3))
    tilt, at_row = rock(Way([5, 4, 3, 4]), own=2)
    assert at_row == row
    assert tilt == pytest.approx(0.25 + (off if row == 3 else 0.0), abs=1e-12)


def test_of_poses_that_are_alike_the_first_is_named(rock):
    way = Way([3.0 + 1e-8, 3.0 + 3e-8, 3.0])
    assert rock(way) == (pytest.approx(0.25), 0)
    assert rock(Way([3.0 + 3e-8, 3.0]))[1] == 1


def test_what_is_lost_is_told_the_least_of_all(rock, kernel, monkeypatch):
    """Of poses and dips: of a tilt by more than rocking, and at which any rotates at all."""
    told = []

    def lost_between(*given):
        told.append(given[6:8])
        return NOTHING

    monkeypatch.setattr(module, "lost_between", lost_between)
    kernel["dips"] = [1], [1.6]
    rock(Way([3.0, 3.5, 5.0], Onto(alone=0.05, tilt=0.2)))
    assert told == [(pytest.approx(0.2), pytest.approx(0.05))]


def test_a_dip_counts_as_the_pose_before_it(rock, kernel):
    kernel["dips"] = [1], [2.8]
    assert rock(Way([3.0, 3.5, 5.0])) == (pytest.approx(0.24), 1)
    kernel["dips"] = [0, 1], [3.2, 2.8]
    assert rock(Way([3.0, 3.5, 5.0])) == (pytest.approx(0.24), 1)
    # ways between poses are looked at however many dips there are
    kernel["dips"] = [0, 1], [2.1, 2.95]
    assert rock(Way([2.0, 2.2, 3.0], Onto())) == (pytest.approx(LEFT, abs=PLACE), 1)
    far = Onto(rocking=contact.ROCKING + 0.07)  # what each rocks onto is its own
    kernel["dips"] = [0, 1], [3.2, 2.0]
    assert rock(Way([3.0, 3.5, 5.0], far)) == (pytest.approx(0.1), 1)
    kernel["dips"] = [0, 1], [2.9, 2.8]
    assert rock(Way([3.0, 3.5, 5.0])) == (pytest.approx(0.24), 1)
    # and comes down from where that came down from
    kernel["dips"] = [1], [2.0]
    way = Way([3.0, 3.5, 5.0], Onto(rocking=contact.ROCKING + 0.07))
    for whence, tilt in ((-0.2 + 0.07 + 1e-9, 0.25), (-0.2 + 0.07 - 1e-9, 0.1)):
        found = rock(way, whence=[-INF, whence, -INF])
        assert found[0] == pytest.approx(tilt)


def test_every_pose_that_may_be_the_least_is_looked_at(monkeypatch):
    """Random tilts; of those above the least of all some are looked at too, eight at once."""
    rng = np.random.default_rng(8)
    for count in (*range(1, 30), *range(1, 30)):
        own = rng.uniform(0.0, 1.0, count)
        more = own + rng.choice([0.0, 0.05, 2.0], count)
        looked = []

        def pose_tilt(scene, row, margin, side, tolerance, more=more, own=own):
            if tolerance == 0.0:
                return own[row], 0.0
            looked.append(row)  # noqa: B023
            return more[row], 0.0

        monkeypatch.setattr(module, "pose_tilt", pose_tilt)
        alone, tilt = np.full((2, count), 7.0)
        of = (
            numbers([], int),
            numbers(range(count), int),
            numbers(np.full(count, 0.1)),
            numbers(alone),
            numbers(tilt),
        )
        module.least_tilts(None, range(count), range(count), -1.0, Looked(*of))
        assert alone.tolist() == own.tolist()
        assert tilt.min() == more.min()
        assert set(np.flatnonzero(own < more.min() - 2e-9)) <= set(looked)
        assert np.isinf(np.delete(tilt, looked)).all()
        assert len(looked) <= 8 * math.ceil((own < more.min()).sum() / 8 + 1)


def test_ways_beside_all_poses_that_rock_are_marked(kernel):
    """In whatever order the poses come, and whether the first of them rocks too late."""
    kernel["way"] = way = Way(METERS, Onto(begin=0.5, end=4.5))
    for rows, late in (([1, 3], 1), ([3, 1], 3)):
        looked = looked_at(rows, [9.0 if each == late else 0.1 for each in rows])
        beside, back = numbers(np.full(6, True), bool), numbers(np.full(6, -INF))
        of = None, way.poses, way.margins
        module.mark_ways(*of, looked, -1.0, back, 0.2, numbers(np.zeros(6), int), beside)
        assert np.flatnonzero(beside).tolist() == {1: [2, 3], 3: [0, 1]}[late]
