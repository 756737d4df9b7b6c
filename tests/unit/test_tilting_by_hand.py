"""Tilt to the first rock, on poses whose tilts are known; no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.traversal import tilting as module
from kaidan.traversal.tilting import Rock, _dips, _lost_between, first_rock

PLACE = 1e-6


class Poses(SimpleNamespace):
    def __len__(self):
        return len(self.leg)


class Way:
    """Poses at some places: between 1.5 and 2.25 a nosing is rocked onto, by `rocking`.

    There it rotates at `alone`, and by more than rocking at `tilt`; elsewhere at 0.1 + 0.05 s.
    """

    alone, tilt, rocking = 0.1, 0.3, 0.02

    def __init__(self, at, leg=None, **figures):
        self.s = np.asarray(at, dtype=float)
        leg = np.zeros(len(self.s)) if leg is None else np.asarray(leg)
        self.poses = Poses(leg=leg)
        self.looked_at, self.figures = [], figures
        vars(self).update(figures)

    def tilts(self, rows, side, tolerance=None):
        assert side == -1.0
        s = self.s[rows]
        own = 0.1 + 0.05 * s
        rocks = (s >= 1.5) & (s <= 2.25)
        if tolerance == 0.0:
            return SimpleNamespace(tilt=np.where(rocks, self.alone, own), rocking=0 * s)
        assert tolerance is None
        self.looked_at += np.asarray(rows).tolist()
        return SimpleNamespace(
            tilt=np.where(rocks, self.tilt, own), rocking=np.where(rocks, self.rocking, 0.0)
        )

    def between(self, begin, share, *, acceleration):
        assert acceleration == 0.7
        low, high = self.s[begin], self.s[begin + 1]
        return Way(low + share * (high - low), **self.figures)


def lost(way, rocking, rows):
    return _lost_between(way, np.array(rocking, dtype=int), np.array(rows), -1.0, 0.7)


WAY = range(6)
"""Poses a metre apart."""


def test_where_the_flat_leaves_a_nosing_that_it_would_rock_onto():
    """Just before 1.5 and just behind 2.25 nothing is there to rock onto."""
    first, then = 0.1 + 0.05 * 1.5, 0.1 + 0.05 * 2.25
    found = lost(Way(WAY), [2], WAY)
    assert (found.tilt, found.row) == (pytest.approx(first, abs=PLACE), 1)
    assert found.tilt < first  # beyond it, not on it
    # poses that do not count, on either side
    for rows in ([2, 3, 4], [0, 2, 3, 4]):
        found = lost(Way(WAY), [2], rows)
        assert (found.tilt, found.row) == (pytest.approx(then, abs=PLACE), 2)
        assert found.tilt > then
    assert lost(Way(WAY), [2], [0, 1, 2])[1] == 1
    # what lies between two lines of poses is a rotation
    assert lost(Way(WAY, [0, 0, 1, 1, 1, 1]), [2], WAY)[1] == 2
    assert lost(Way(WAY, [0, 0, 0, 1, 1, 1]), [2], WAY)[1] == 1
    nothing = Rock(math.inf, -1)
    assert lost(Way(WAY, [0, 0, 1, 2, 2, 2]), [2], WAY) == nothing
    assert lost(Way([0, 1, 1.6, 1.6, 3, 4]), [3], [2, 3]) == nothing
    # where nothing is rocked onto, or all the way
    assert lost(Way(WAY), [], WAY) == lost(Way(WAY), [0, 4], WAY) == nothing
    assert lost(Way([1.6, 1.7, 1.8]), [1], range(3)) == nothing


def test_at_the_ends_of_a_path():
    first, then = 0.1 + 0.05 * 1.5, 0.1 + 0.05 * 2.25
    assert lost(Way([2.0, 3.0]), [0], range(2)) == (pytest.approx(then, abs=PLACE), 0)
    assert lost(Way([1.0, 2.0]), [1], range(2)) == (pytest.approx(first, abs=PLACE), 0)


def rock(way, rows=None, own=None):
    rows = np.arange(len(way.s)) if rows is None else np.array(rows)
    return first_rock(way, rows, -1.0, own=len(way.s) if own is None else own, acceleration=0.7)


@pytest.fixture
def no_dips(monkeypatch):
    monkeypatch.setattr(module, "_dips", lambda *given: ([], np.empty(0, dtype=np.int64)))


@pytest.mark.usefixtures("no_dips")
def test_the_first_rock_by_hand():
    assert rock(Way(WAY), []) == (math.inf, -1)
    assert rock(Way([5, 4, 3, 4])) == (pytest.approx(0.25), 2)
    # the least is 0.1, but by more than rocking 0.12 alone, and less what it rocks before
    near = Way([1.6, 2.0, 2.2], alone=0.05, tilt=0.12)
    assert rock(near) == (pytest.approx(0.12 - 0.02), 0)
    # that is no less than where it begins to rotate
    assert rock(Way([1.6, 2.0, 2.2], alone=0.11, tilt=0.12)) == (pytest.approx(0.11), 0)
    # between the first and the second pose it leaves the nosing: 0.175, and it rocked at 0.05
    found = rock(Way([1.0, 2.0, 4.0, 5.0], alone=0.05))
    assert found == (pytest.approx(0.15 - 0.02), 0)  # the first pose is less, rocking or not
    found = rock(Way([1.4, 1.6, 5.0], alone=0.05, tilt=0.6), rows=[1, 2])
    assert found == (pytest.approx(0.1 + 0.05 * 2.25 - 0.02, abs=PLACE), 1)
    found = rock(Way([4.0, 2.0, 2.5, 5.0], alone=0.05, tilt=0.6, rocking=0.01), rows=[1, 2, 3])
    assert found == (pytest.approx(0.1 + 0.05 * 2.25 - 0.01, abs=PLACE), 1)
    # poses between two say nothing of what lies beside them
    found = rock(Way([4.0, 2.0, 2.5, 5.0], alone=0.05, tilt=0.6, rocking=0.01), own=2)
    assert found == (pytest.approx(0.1 + 0.05 * 2.5 - 0.01), 2)


@pytest.mark.usefixtures("no_dips")
def test_poses_are_looked_at_as_long_as_they_may_be_the_least():
    """Eight at a time, those first that rotate first."""
    way = Way(np.linspace(30.0, 3.0, 28))
    assert rock(way) == (pytest.approx(0.25), 27)
    assert sorted(way.looked_at[:8]) == list(range(20, 28))
    assert set(way.looked_at) == set(range(20, 28))
    way = Way(np.r_[np.linspace(1.6, 2.2, 12), np.linspace(5.0, 30.0, 20)], alone=0.05, tilt=0.36)
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
    assert _dips(Way(WAY), np.array([1, 3]), alone, -1.0, 0.7) == ("dips", "rows")
    inf = math.inf
    assert asked["values"] == [-inf, -0.3, -inf, -0.1, -inf, -inf]
    assert asked["group"] == [-1, 0, -1, 0, -1, -1]
    assert asked["measured"](Way([2.0, 4.0])).tolist() == pytest.approx([-0.1, -0.3])


def test_a_dip_counts_as_the_pose_before_it(monkeypatch):
    monkeypatch.setattr(module, "_dips", lambda *given: (["some"], np.array([1])))
    monkeypatch.setattr(contact, "joined", lambda dips: Way([2.8]))
    assert rock(Way([3.0, 3.5, 5.0])) == (pytest.approx(0.24), 1)
