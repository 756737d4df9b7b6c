"""Tilt to the first rock, on poses whose tilts are known; no kernel runs."""

import math
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
import pytest

from kaidan import contact
from kaidan.traversal import tilting as module
from kaidan.traversal.tilting import Rock, _Tilted, first_rock

PLACE = 1e-6


class Poses(SimpleNamespace):
    def __len__(self):
        return len(self.leg)


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

    def __init__(self, at, *nosings, leg=None):
        self.s = np.asarray(at, dtype=float)
        leg = np.zeros(len(self.s)) if leg is None else np.asarray(leg)
        self.poses = Poses(leg=leg, inclination=-0.1 * self.s)
        self.looked_at, self.nosings = [], nosings

    def tilts(self, rows, side, tolerance):
        assert side == -1.0
        s = self.s[rows]
        alone, rocking = 0.1 + 0.05 * s, 0.0 * s
        tilt = alone.copy()
        for each in self.nosings:
            on = (s >= each.begin) & (s <= each.end)
            alone[on], rocking[on], tilt[on] = each.alone, each.rocking, each.tilt
        if np.ndim(tolerance) == 0:
            assert tolerance == 0.0
            return SimpleNamespace(tilt=alone, rocking=0 * s)
        self.looked_at += np.asarray(rows).tolist()
        assert np.shape(tolerance) == np.shape(s)
        within = rocking <= tolerance
        return SimpleNamespace(
            tilt=np.where(within, tilt, alone), rocking=np.where(within, rocking, 0.0)
        )

    def between(self, begin, share, *, acceleration):
        assert acceleration == 0.7
        low, high = self.s[begin], self.s[begin + 1]
        return Way(low + share * (high - low), *self.nosings)

    def tilt_jumps(self, begin, side, whence, of_tilt, half, falls, within, *, acceleration):
        """The one place at which a nosing begins or ends, each halved by itself."""
        low, high = np.zeros(len(begin)), np.ones(len(begin))
        length = (self.s[begin + 1] - self.s[begin]).max()
        assert length * 0.5**30 < within
        for _ in range(30):
            middle = 0.5 * (low + high)
            there = self.between(begin, middle, acceleration=acceleration)
            reach = np.maximum(whence - there.poses.inclination, 0.0) + contact.ROCKING
            found = there.tilts(np.arange(len(begin)), side, reach)
            first = (np.where(of_tilt, found.tilt, found.rocking) > half) == falls
            low, high = np.where(first, middle, low), np.where(first, high, middle)
        return low, high


def tilted(way, whence=-math.inf):
    return _Tilted(way, -1.0, 0.7, np.full(len(way.s), whence))


def lost(way, rocking, rows, least=0.2, lowest=0.0, whence=-math.inf):
    rocking = np.array(rocking, dtype=int)
    return tilted(way, whence).lost_between(rocking, np.array(rows), least, lowest)


METERS = range(6)
"""Places of poses."""
NOTHING = Rock(math.inf, -1)
REACHED, LEFT = 0.1 + 0.05 * 1.5, 0.1 + 0.05 * 2.25 - 0.02
"""Just before 1.5, and just behind 2.25 less the rocking."""


def test_where_the_flat_leaves_a_nosing_that_it_would_rock_onto():
    """Beside it nothing is there to rock onto, and left it is steeper by what it rocked."""
    way = Way(METERS, Onto())
    found = lost(way, [2], METERS)
    assert (found.tilt, found.row) == (pytest.approx(REACHED, abs=PLACE), 1)
    assert found.tilt < REACHED  # beyond it, not on it
    # poses that do not count, on either side
    for rows in ([2, 3, 4], [0, 2, 3, 4]):
        found = lost(way, [2], rows)
        assert (found.tilt, found.row) == (pytest.approx(LEFT, abs=PLACE), 2)
        assert found.tilt > LEFT
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
    assert lost(Way([1.6, 1.9, 3.0], Onto()), [1], range(3)) == (pytest.approx(LEFT, abs=PLACE), 1)
    # the longest way too is halved to the end
    found = lost(Way([1.49, 1.6, 5.0], Onto(rocking=0.044)), [1], range(3), least=0.25)
    assert found == (pytest.approx(LEFT + 0.02 - 0.044, abs=PLACE), 1)


def test_left_it_is_no_steeper_than_where_it_rocked_nowhere():
    way = Way(METERS, Onto())
    assert lost(way, [2], [2, 3], lowest=0.2) == (pytest.approx(0.2), 2)
    assert lost(way, [2], [2, 3], lowest=0.4)[0] == pytest.approx(LEFT + 0.02, abs=PLACE)


def test_where_it_may_be_the_least():
    """Beside it the tilt is 0.25: less what it rocked, and by what a few millimetres change."""
    way, between = Way(METERS, Onto()), 0.25 - 0.02 - contact.ROCKING
    assert lost(way, [2], [2, 3], least=between - 1e-9) == NOTHING
    assert lost(way, [2], [2, 3], least=between + 1e-9)[1] == 2


@pytest.mark.usefixtures("no_dips")
def test_back_to_where_it_came_down_from_is_rocking():
    """As far as that inclination, and rocking beyond; so much steeper it is where that is left."""
    far = Onto(rocking=contact.ROCKING + 0.07)
    assert lost(Way(METERS, far), [2], METERS) == NOTHING
    assert lost(Way(METERS, far), [2], METERS, whence=-0.2 + 0.07 - 1e-9) == NOTHING
    # 0.225 behind 2.25 it has come down to 0.025 below -0.2
    found = lost(Way(METERS, far), [2], METERS, whence=-0.2 + 0.07 + 0.025 + 1e-6)
    assert found == (pytest.approx(LEFT + 0.02 - far.rocking, abs=PLACE), 2)
    way = Way([1.6, 1.9], far)
    row = np.arange(2)
    assert first_rock(way, row, -1.0, own=2, acceleration=0.7) == (pytest.approx(0.1), 0)
    whence = np.full(2, -0.16 + 0.07 + 1e-9)
    found = first_rock(way, row, -1.0, own=2, acceleration=0.7, whence=whence)
    assert found == (pytest.approx(0.3), 0)


def test_what_a_pose_rocks_onto_reaches_as_far_as_it_came_down_there():
    """At 2.0 it is nose down by 0.2, from -0.05 so 0.15 is rocking; at 0.0 none would be."""
    far = Onto(rocking=contact.ROCKING + 0.07)
    found = lost(Way(METERS, far), [2], [1, 2], whence=-0.05)
    assert found == (pytest.approx(REACHED, abs=PLACE), 1)


def test_at_one_place_nothing_is_halved_out(monkeypatch):
    """Two poses of one place, one of them on the nosing: an exchange of contacts."""
    way, given = Way([2.0, 2.0], Onto()), Way.tilts

    def tilts(self, rows, side, tolerance):
        found = given(self, rows, side, tolerance)
        if self is way:
            found.rocking[np.asarray(rows) == 1] = 0.0
        return found

    monkeypatch.setattr(Way, "tilts", tilts)
    assert lost(way, [0], [0, 1]) == NOTHING


def test_from_one_nosing_that_it_rocks_onto_to_the_next():
    """There it is steeper by the difference, and no steeper where the next asks for more."""
    one, other = Onto(rocking=0.02), Onto(2.25, 3.5, rocking=0.005, tilt=0.22)
    found = lost(Way([2, 3], one, other), [0, 1], range(2))
    assert found == (pytest.approx(0.22 - 0.015), 0)
    one, other = one._replace(rocking=0.005), other._replace(rocking=0.02)
    assert lost(Way([2, 3], one, other), [0, 1], range(2)) == (pytest.approx(0.22), 0)
    # the same rocking, another tilt
    other = other._replace(rocking=0.005, tilt=0.1)
    assert lost(Way([2, 3], one, other), [0, 1], range(2)) == (pytest.approx(0.1), 0)


def test_at_the_ends_of_a_path():
    assert lost(Way([2.0, 3.0], Onto()), [0], range(2)) == (pytest.approx(LEFT, abs=PLACE), 0)
    assert lost(Way([1.0, 2.0], Onto()), [1], range(2)) == (pytest.approx(REACHED, abs=PLACE), 0)


def rock(way, rows=None, own=None):
    rows = np.arange(len(way.s)) if rows is None else np.array(rows)
    return first_rock(way, rows, -1.0, own=len(way.s) if own is None else own, acceleration=0.7)


@pytest.fixture
def no_dips(monkeypatch):
    monkeypatch.setattr(_Tilted, "dips", lambda *given: ([], np.empty(0, dtype=np.int64)))


@pytest.mark.usefixtures("no_dips")
def test_the_first_rock_by_hand():
    assert rock(Way(METERS), []) == (math.inf, -1)
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


@pytest.mark.usefixtures("no_dips")
def test_a_nosing_onto_which_only_a_tilt_beyond_the_least_would_rock():
    """Its loss is less than any pose, for the robot rocked elsewhere already."""
    rocks = Onto(0.2, 0.4, rocking=0.045, tilt=0.6, alone=0.05)
    left = Onto(1.5, 2.25, rocking=0.045, tilt=0.6, alone=0.19)
    at = [0.3, 1.45, 2.0, 3.0]
    assert rock(Way([0.3, 1.45], rocks, leg=[0, 1])) == (pytest.approx(0.1725), 1)
    found = rock(Way(at, rocks, left, leg=[0, 1, 2, 2]))
    assert found == (pytest.approx(0.1 + 0.05 * 2.25 - 0.045, abs=PLACE), 2)


@pytest.mark.usefixtures("no_dips")
def test_poses_are_looked_at_as_long_as_they_may_be_the_least():
    """Eight at a time, those first that rotate first."""
    way = Way(np.linspace(30.0, 3.0, 28))
    assert rock(way) == (pytest.approx(0.25), 27)
    assert sorted(way.looked_at[:8]) == list(range(20, 28))
    assert set(way.looked_at) == set(range(20, 28))
    rocks = Onto(alone=0.05, tilt=0.36)
    way = Way(np.r_[np.linspace(1.6, 2.2, 12), np.linspace(5.0, 30.0, 20)], rocks)
    rock(way)
    assert set(way.looked_at) == set(range(16))


def test_dips_between_poses(monkeypatch):
    """Of the poses that count: minus the tilt has a peak where the tilt has a dip."""
    asked = {}

    def peaks(path, values, group, within, measured, *, acceleration):
        asked.update(values=values.tolist(), group=group.tolist(), measured=measured)
        assert (within, acceleration) == (1e-5, 0.7)
        return "dips", "rows"

    monkeypatch.setattr(module, "peaks_between", peaks)
    alone = np.array([0.3, 0.1])
    assert tilted(Way(METERS)).dips(np.array([1, 3]), alone) == ("dips", "rows")
    inf = math.inf
    assert asked["values"] == [-inf, -0.3, -inf, -0.1, -inf, -inf]
    assert asked["group"] == [-1, 0, -1, 0, -1, -1]
    assert asked["measured"](Way([2.0, 4.0], Onto())).tolist() == pytest.approx([-0.1, -0.3])


@pytest.mark.parametrize(("off", "row"), [(-1e-6, 3), (0.0, 2), (1e-6, 2)])
def test_what_is_lost_counts_where_it_is_less(off, row, monkeypatch):
    """The least of any pose is 0.25, of the third."""
    asked = []

    def dips(self, rows, alone):
        asked.append(rows.tolist())
        return [], np.empty(0, dtype=np.int64)

    monkeypatch.setattr(_Tilted, "dips", dips)
    monkeypatch.setattr(_Tilted, "lost_between", lambda *given: Rock(0.25 + off, 3))
    found = rock(Way([5, 4, 3, 4]), own=2)
    assert found == (pytest.approx(0.25 + min(off, 0.0), abs=1e-12), row)
    assert asked == [[0, 1]]  # dips lie between poses that follow one another


def test_a_dip_counts_as_the_pose_before_it(monkeypatch):
    monkeypatch.setattr(_Tilted, "dips", lambda *given: (["some"], np.array([1])))
    monkeypatch.setattr(contact, "joined", lambda dips: Way([2.8]))
    assert rock(Way([3.0, 3.5, 5.0])) == (pytest.approx(0.24), 1)
    # and comes down from where that came down from
    far = Onto(rocking=contact.ROCKING + 0.07)
    monkeypatch.setattr(contact, "joined", lambda dips: Way([2.0], far))
    way, rows = Way([3.0, 3.5, 5.0]), np.arange(3)
    for whence, tilt in ((-0.2 + 0.07 + 1e-9, 0.25), (-0.2 + 0.07 - 1e-9, 0.1)):
        whence = np.array([-np.inf, whence, -np.inf])
        found = first_rock(way, rows, -1.0, own=3, acceleration=0.7, whence=whence)
        assert found.tilt == pytest.approx(tilt)
