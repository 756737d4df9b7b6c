"""Which poses the extremes of a phase are of, by hand on records made for it; no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.contact import Feature, FeatureKind, Placement
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Phase, extremes
from kaidan.traversal.brief import by_how_long
from kaidan.traversal.extremes import (
    Rise,
    _as_on_the_flat,
    _came_down,
    _CameDown,
    _least_rise,
    _on_a_flight,
    _rock,
    _rotated,
    phase_extremes,
)
from kaidan.traversal.rotations import ROCKING

G = 9.80665
STEPS = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=3))
NOSINGS = STEPS.nosings


class Rows(SimpleNamespace):
    def __len__(self):
        return len(self.front_point)


class Margins(SimpleNamespace):
    def __getitem__(self, rows):
        return Margins(**{name: values[rows] for name, values in vars(self).items()})


PHASE = np.array(["enter"] * 2 + ["traverse"] * 4 + ["land"] * 2)
CLOSED = {Phase.ENTER: [0, 1], Phase.TRAVERSE: [2, 3, 4, 5, 6], Phase.LAND: [5, 6, 7]}
PLACES = NOSINGS[0, 0] + np.array([-0.5, -0.4, 0.1, 0.15, 0.2, 0.65, 0.6, 0.8, 0.11, 0.66])
COUNT = len(PLACES)
"""Eight poses, and two between, after the fourth and the sixth."""


@pytest.fixture
def looked_at(monkeypatch):
    """Extremes, and rows that are looked at: of each phase for each kind of figure and side."""

    def mark(*rows):
        marked = np.zeros(COUNT, dtype=np.bool_)
        marked[list(rows)] = True
        return marked

    seen = SimpleNamespace(
        poses=Rows(front_point=np.c_[PLACES, np.full(COUNT, -7.0)]),
        margins=Margins(
            front=np.arange(COUNT) + 0.5, back=np.arange(COUNT) + 0.25, belly_touches=mark()
        ),
    )
    samples = SimpleNamespace(
        row=np.array([0, 1, 2, 3, 4, 5, 6, 7, 3, 5]),
        lasts=~mark(4),
        path=seen,
        comes_off=mark(1, 7),
        friction=np.array([0.1, 0.9, 0.2, 0.3, 9.0, 0.4, 0.5, 0.8, 0.3, 0.4]),
        traction=np.array([0.1, 0.2, 0.2, 0.3, 9.0, 0.4, 0.5, 0.8, 0.3, 0.4]),
    )
    rows = {name: np.isin(np.arange(8), some) for name, some in CLOSED.items()}

    def of(*, descending=False, whole=True, rises=(), profile=STEPS):
        asked = []

        def energy(path, rows, side, weights):
            asked.append(("energy", side, rows.tolist()))
            return (0.002 * weights[0], PLACES[rows[0]]) if len(rows) else (math.inf, math.nan)

        def rock(path, rows, side, *given):
            asked.append(("rock", side, rows.tolist()))
            whence = given[4] if len(given) > 4 else None
            # towards the downhill end alone, on the way up
            assert (whence is not None) == (side > 0 and not descending)
            assert whence is None or whence.tolist() == [0, 1, 2, 3, 4, 5, 6, 7, 3, 5]
            return math.inf, 0

        def rotated(path, phase, name, side, *given):
            asked.append(("rotated", side))
            return 0.1 * side, 5

        for name, found in {
            "samples_of": lambda *given: samples,
            "_chain_angles": lambda *given: [(0, 0.3), (2, 0.1), (3, 0.2)],
            "over_the_top": lambda *given: mark(6, 7, 9),
            "_closed": lambda *given: rows,
            "_came_down": lambda *given: _CameDown(np.arange(8.0), mark(3)[:8]),
            "_on_a_flight": lambda *given: mark(2, 8),
            "_least_energy": energy,
            "_as_on_the_flat": lambda path, body, side: np.full(COUNT, 0.5 + 0.25 * side),
            "_rock": rock,
            "_rotated": rotated,
        }.items():
            monkeypatch.setattr(extremes, name, found)
        path = SimpleNamespace(poses=Rows(front_point=np.zeros((8, 2))))
        body = SimpleNamespace(stance=SimpleNamespace(flat_length=0.5))
        found = phase_extremes(path, profile, PHASE, descending, 0.0, rises, body, whole)
        energies, *others = (
            [each[1:] for each in asked if each[0] == kind]
            for kind in ("energy", "rock", "rotated")
        )
        assert energies[::3] == energies[1::3]  # as it is, and as if it were about the flat
        return found, [[each for k, each in enumerate(energies) if k % 3], *others]

    return of


def test_which_poses_count_on_the_way_up(looked_at):
    """Traversing a flat judges by nosings, and poses where it is on no flight; a pose that comes
    back is none that falls, uphill none over the top.
    """
    found, (energy, rock, rotated) = looked_at()
    assert [each.phase for each in found] == list(Phase)
    on, lands = [2, 3, 5, 6, 8, 9], [5, 6, 7, 9]
    assert energy == [
        (1.0, [0, 1]), (-1.0, []), (1.0, on), (-1.0, [2, 3, 5, 8]), (1.0, lands), (-1.0, []),
    ]  # fmt: skip
    assert rock == [
        (1.0, [0, 1]),
        (-1.0, []),
        (1.0, [5, 9]),
        (-1.0, [3, 5]),
        (1.0, lands),
        (-1.0, []),
    ]
    assert rotated == [(1.0,), (-1.0,)] * 3
    enter, traverse, land = found
    assert (traverse.energy_margin, traverse.energy_margin_step) == (0.002, 1)
    assert land.energy_margin_step == 3
    assert (traverse.steadiness, traverse.uphill_steadiness) == ((0.0015, 1), (0.0005, 1))
    assert land.uphill_steadiness == (math.inf, 0)
    assert (enter.tilt_downhill, enter.tilt_uphill) == ((0.1, 5), (-0.1, 5))
    assert [each.static_margin for each in found] == [0.25, 2.25, 5.25]
    # only landing the trailing end slides down what it comes off
    assert (enter.required_friction, enter.slides_below) == (0.9, None)
    assert (traverse.required_friction, traverse.required_friction_step) == (0.5, 3)
    assert (land.required_friction, land.slides_below) == (0.5, 0.8)
    assert [each.traction_over_weight * G for each in found] == pytest.approx([0.2, 0.5, 0.5])
    assert [each.largest_rotation for each in found] == [0.3, 0.2, 0.0]


def test_where_no_flat_carries_every_pose_is_judged(looked_at):
    rock = looked_at(whole=False)[1][1]
    assert rock[2:4] == [(1.0, [2, 5, 6, 9]), (-1.0, [2, 3, 5, 8])]


def test_where_nosings_carry_their_rises_count(looked_at):
    """Traversing those alone, landing poses too, but for one with its contact at a nosing."""
    rises = (
        Rise(True, 0.001, 2, Phase.TRAVERSE), Rise(False, 0.004, 3, Phase.TRAVERSE),
        Rise(True, 0.005, 3, Phase.LAND),
    )  # fmt: skip
    found, (energy, *_) = looked_at(rises=rises)
    assert PLACES[6] == NOSINGS[2, 0]
    assert energy[2:] == [(1.0, []), (-1.0, []), (1.0, [5, 7, 9]), (-1.0, [])]
    _, traverse, land = found
    assert (traverse.energy_margin, traverse.energy_margin_step) == (0.001, 2)
    assert (land.energy_margin, land.energy_margin_step) == (0.002, 3)
    assert (traverse.steadiness, traverse.uphill_steadiness) == ((0.001, 2), (0.004, 3))
    assert land.steadiness == (0.0015, 3)


def test_a_rise_as_one_about_the_flat():
    """By hand: radius of gyration 0.2 m, centroid 0.1 m above the flat, so a sudden stop leaves
    1/5 of its energy to a rotation about the flat. 0.2 m above the line of a belt: 1/2; behind it,
    where the belt pulls through the centroid: none.
    """
    body = SimpleNamespace(least_gyration=0.2, stance=SimpleNamespace(com_height=0.1))
    half = math.sqrt(0.5)
    path = SimpleNamespace(
        x=np.zeros(3),
        z=np.full(3, 0.3),
        poses=SimpleNamespace(
            rear_point=np.array([(-0.2, 0.2), (-0.2, 0.1), (-0.3, 0.0)]),
            rear_normal=np.array([(0.0, 1.0), (0.0, 1.0), (-half, half)]),
            front_point=np.array([(0.3, 0.2), (0.1, 0.3), (0.2, 0.3 - 0.2 * math.sqrt(0.5))]),
            front_normal=np.array([(0.0, 1.0), (-1.0, 0.0), (0.0, 1.0)]),
        ),
    )
    found = _as_on_the_flat(path, body, 1.0)
    assert found[:2] == pytest.approx([1.0, 0.4])
    assert found[2] > 1e5
    # uphill: a face 0.1 m ahead, against which the belt pulls upward; and 0.1414 m: 1/3
    assert _as_on_the_flat(path, body, -1.0) == pytest.approx([1.0, 1.0, 0.6])


def test_which_poses_count_on_the_way_down(looked_at):
    """Over the edge of the landing above it has to rotate: no pose there counts."""
    found, (energy, rock, rotated) = looked_at(descending=True)
    assert energy[:3] == [(-1.0, []), (1.0, []), (-1.0, [2, 3, 5, 6, 8, 9])]
    assert rock[:4] == [(-1.0, []), (1.0, []), (-1.0, [3, 5, 9]), (1.0, [3, 5])]
    assert rotated == [(-1.0,), (1.0,)] * 3
    assert [each.static_margin for each in found] == [0.5, 2.5, 5.5]
    level = Profile.of_points([(-3, 0), (3, 0)])
    assert looked_at(descending=True, profile=level)[1][0][:2] == [(-1.0, [0, 1]), (1.0, [])]


def test_poses_on_a_flight_by_hand():
    """Nosings 0.3, 0.6 and 0.3 m apart under a flat of 0.5 m: two flights of two."""
    nosings = np.array([(0.0, 0.0), (0.3, 0.0), (0.9, 0.0), (1.2, 0.0)])
    rear = np.array([0.0, -1e-5, 0.1, 0.1, 0.35, 0.9 - 1e-7, 1.0])
    front = np.array([0.3 + 1e-7, 0.2, 0.3 + 1e-5, 0.2, 0.8, 1.2, 1.3])
    path = SimpleNamespace(
        poses=SimpleNamespace(
            rear_point=np.c_[rear, np.full(7, 0.2)], front_point=np.c_[front, np.full(7, 0.2)]
        )
    )
    found = _on_a_flight(path, SimpleNamespace(nosings=nosings), 0.5)
    assert found.tolist() == [True, False, False, True, False, True, False]


def code(point, kind=FeatureKind.VERTEX):
    return Feature(point, 0, kind).code


class Records(list):
    @property
    def angle(self):
        return np.array([each.angle for each in self])

    def __getitem__(self, rows):
        return Records(super().__getitem__(rows))


def came_down(*records, rear, angle, at_once=False, on_flat=(), whole=False):
    """Rotations by an angle from 0.1 k, each a chain of its own or all at once."""
    rotations = Records(
        SimpleNamespace(
            sense=sense, arrested=arrested, pivot=pivot, s=float(row), angle=angle,
            start=Placement(0.0 if at_once else 9.0 * k, 0.0, 0.1 * k),
            end=Placement(0.0 if at_once else 9.0 * k, 0.0, 0.0),
        )
        for k, (row, sense, arrested, pivot) in enumerate(records)
    )  # fmt: skip
    path = SimpleNamespace(
        margins=SimpleNamespace(outermost=np.c_[rear, 0 * rear]),
        poses=Rows(front_point=np.zeros((8, 2)), rear=70 + np.arange(8)), rotations=rotations,
        row_before=int, is_on_flat=lambda code, row: code == 70 + row and row in on_flat,
    )  # fmt: skip
    whence, back = _came_down(path, 0.5, whole)
    at = np.flatnonzero(np.isfinite(whence))
    assert not np.isin(np.flatnonzero(back), at).any()
    return np.flatnonzero(back).tolist(), dict(zip(at.tolist(), whence[at].tolist(), strict=True))


REAR = np.array([code(each) for each in (4, 4, 5, 5, 5, 6, 5, 5)])


def test_poses_from_which_it_rotates_back():
    """From the rotation on, as long as the edge that it rotated about is the rear contact."""

    def back(*records, rear=REAR):
        found, whence = came_down(*records, rear=rear, angle=ROCKING + 1e-9, on_flat=range(8))
        assert not whence
        return found

    assert back((1, -1, True, code(5))) == [2, 3, 4]
    assert back((2, -1, True, code(5))) == [3, 4]
    assert back((5, -1, True, code(5)), (1, -1, True, code(5))) == [2, 3, 4, 6, 7]
    assert back((1, -1, True, code(7))) == []
    for other in ((1, 1, True, code(5)), (1, -1, False, code(5))):
        assert back(other) == []  # the trailing end comes down; it falls
        assert back(other, (1, -1, True, code(5))) == [2, 3, 4]
    disc = REAR.copy()
    disc[2] = code(5, FeatureKind.DISC_1)
    assert back((1, -1, True, code(5, FeatureKind.DISC_1)), rear=disc) == []
    assert back((1, -1, True, code(5)), rear=disc) == []  # another contact of that point


def test_poses_from_which_it_rocks_back():
    """By rocking at most, in all, and from a nosing under a flat."""
    two = (5, -1, True, code(5)), (1, -1, True, code(5))
    rocks = {2: 0.1, 3: 0.1, 4: 0.1, 6: 0.0, 7: 0.0}
    assert came_down(*two, rear=REAR, angle=ROCKING, on_flat=(1, 5)) == ([], rocks)
    found = came_down(*two, rear=REAR, angle=ROCKING, on_flat=(1, 5), whole=True)
    assert found == ([2, 3, 4, 6, 7], {})  # the criterion judges
    one = came_down(*two, rear=REAR, angle=ROCKING, on_flat=(1,))
    assert one == ([6, 7], {2: 0.1, 3: 0.1, 4: 0.1})
    assert came_down(*two, rear=REAR, angle=ROCKING) == ([2, 3, 4, 6, 7], {})
    half = 0.5 * ROCKING + 1e-9
    assert came_down(*two, rear=REAR, angle=half, on_flat=(1, 5)) == ([], rocks)
    up = (1, 1, True, code(5)), (1, -1, True, code(5))
    found = came_down(*up, rear=REAR, angle=half, on_flat=(1,), at_once=True)
    assert found == ([2, 3, 4], {})
    at_once = came_down(*two, rear=REAR, angle=half, on_flat=(1, 5), at_once=True)
    assert at_once == ([2, 3, 4, 6, 7], {})


def test_rotations_that_no_nosing_under_a_flat_arrests():
    """As a tilt the largest of its sense counts, with the step at which it begins."""
    places = np.r_[NOSINGS[:, 0] + 0.01, 2.0, 3.0]
    rear, front = 100 + np.arange(5), 200 + np.arange(5)
    phase = np.array(["enter"] + ["traverse"] * 4)

    def rotated(records, side, *, whole=False, name=Phase.TRAVERSE, on_flat=()):
        rotations = [
            SimpleNamespace(s=float(row), sense=sense, angle=angle) for row, sense, angle in records
        ]
        path = SimpleNamespace(
            rotations=rotations, row_before=int,
            poses=Rows(front_point=np.c_[places, 0 * places], rear=rear, front=front),
            is_on_flat=lambda code, row: (code, row) in on_flat,
        )  # fmt: skip
        return _rotated(path, phase, name, side, STEPS, False, whole)

    two = [(3, 1, 0.1), (1, 1, 0.3), (2, -1, 0.4)]
    assert rotated(two, 1.0) == (-0.3, 2)
    assert rotated(two, -1.0) == (-0.4, 3)
    assert rotated(two[:1], -1.0) == rotated([], 1.0) == (math.inf, 0)
    # what arrests it carries at the pose after it: the rear contact, or where the nose comes down
    assert rotated(two, 1.0, on_flat=[(102, 2)]) == (-0.1, 3)
    assert rotated(two, -1.0, on_flat=[(203, 3)]) == (math.inf, 0)
    assert rotated(two, 1.0, whole=True) == (math.inf, 0)
    assert rotated(two, 1.0, name=Phase.LAND) == (math.inf, 0)
    # in another phase; at the last pose: it fell
    assert rotated([(0, 1, 0.8), (4, 1, 0.9), (3, 1, 0.2)], 1.0) == (-0.2, 3)


def test_the_step_of_the_least_rise_and_of_the_first_rock(monkeypatch):
    rises = [Rise(True, 0.2, 4, Phase.LAND), Rise(True, 0.2 + 5e-10, 2, Phase.LAND)]
    assert _least_rise(rises, downhill=True) == (0.2, 2)
    assert _least_rise(rises, downhill=False) == (math.inf, 0)
    path = SimpleNamespace(poses=Rows(front_point=np.c_[NOSINGS[:, 0] + 0.01, [9.0] * 3]))
    for row, step in ((0, 1), (2, 3), (-1, 0)):
        monkeypatch.setattr(extremes.contact, "first_rock", lambda *given, r=row, **more: (0.1, r))
        assert _rock(path, np.arange(3), 1.0, STEPS, False, 0.0, 3) == (0.1, step)


def braked(*runs, more=(), up=False, climbing=(), legs=False):
    """Tractive forces of runs of poses between exchanges, and of some poses between."""
    s = np.concatenate([np.linspace(begin, end, len(each)) for begin, end, each in runs])
    number = np.repeat(np.arange(len(runs)), [len(each) for _, _, each in runs])
    direction = np.full(len(s), 0.5 if up else -0.5)
    direction[list(climbing)] = 0.5
    path = SimpleNamespace(
        poses=Rows(front_point=s, s=s, leg=number * legs, path_direction=direction)
    )
    traction = np.concatenate([[*each] for _, _, each in runs] + [[each for _, each in more]])
    row = np.r_[np.arange(len(s)), [row for row, _ in more]].astype(int)
    found = by_how_long(path, traction, row).tolist()
    return found[: len(s)], found[len(s) :]


def test_brief_braking_counts_by_how_long_it_lasts():
    """5 mm between two long runs are a quarter of 20 mm, above the larger of 2 and 3 N/kg."""
    before, after = (0.0, 0.10, (1.0, 1.0, 2.0)), (0.105, 0.2, (3.0, 1.0, 1.0))
    brief = (0.10, 0.105, (8.0, 2.5))
    found, more = braked(before, brief, after, more=[(3, 6.0), (1, 7.0)])
    assert found == pytest.approx([1, 1, 2, 4.25, 2.5, 3, 1, 1])
    assert more == pytest.approx([3.75, 7.0])
    assert braked(before, brief, after, up=True)[0][3] == 8.0  # it does not brake
    long = (0.10, 0.12, (8.0, 8.0))
    assert braked(before, long, (0.12, 0.2, (3.0, 1.0)))[0][3:5] == pytest.approx([8.0, 8.0])
    # at an end there is one run beside it; with none at all it is as it is
    assert braked(brief, after)[0][0] == pytest.approx(4.25)
    assert braked(before, brief)[0][3] == pytest.approx(2 + 0.25 * 6)
    assert braked(brief, (0.105, 0.2, (0.5, 1.0)))[0][0] == pytest.approx(0.5 + 0.25 * 7.5)
    assert braked((0.0, 0.1, (1.0, 0.5)), brief)[0][2] == pytest.approx(0.5 + 0.25 * 7.5)
    assert braked(brief)[0] == [8.0, 2.5]


def test_of_a_brief_run_what_climbs_does_not_brake():
    before, after = (0.0, 0.10, (1.0, 1.0, 2.0)), (0.105, 0.2, (3.0, 1.0, 1.0))
    found, _ = braked(before, (0.10, 0.105, (8.0, 6.0)), after, climbing=[3])
    assert found == pytest.approx([1, 1, 2, 8, 3.75, 3, 1, 1])


def test_runs_end_where_another_line_of_poses_begins_and_may_be_one_pose():
    before, after = (0.0, 0.10, (1.0, 1.0, 2.0)), (0.111, 0.2, (3.0, 1.0, 1.0))
    found, _ = braked(before, (0.101, 0.106, (8.0, 2.5)), after, legs=True)
    assert found == pytest.approx([1, 1, 2, 4.25, 2.5, 3, 1, 1])
    found, _ = braked(before, (0.10, 0.105, (8.0, 2.5)), (0.105, 0.105, (3.0,)))
    assert found == pytest.approx([1, 1, 2, 3.5, 2.125, 2.25])


def test_brief_runs_side_by_side_last_as_long_as_they_brake_no_less():
    """Of 5 mm at 8 N/kg and 10 mm at 9: braking of 8 lasts 15 mm, that of 9 lasts 10 mm."""
    before, after = (0.0, 0.10, (1.0, 3.0)), (0.115, 0.2, (2.0, 1.0))
    low, high = (0.10, 0.105, (8.0, 8.0)), (0.105, 0.115, (9.0, 9.0))
    expected = [3 + 0.75 * 5] * 2 + [3 + 0.5 * 6] * 2
    assert braked(before, low, high, after)[0][2:6] == pytest.approx(expected)
    low, high = (0.11, 0.115, (8.0, 8.0)), (0.10, 0.11, (9.0, 9.0))
    assert braked(before, high, low, after)[0][2:6] == pytest.approx(expected[::-1])
    first = [2 + 0.5 * 7] * 2 + [2 + 0.75 * 6] * 2
    assert braked(high, low, after)[0][:4] == pytest.approx(first)
    # never more than it is
    two = [(0.1, 0.115, (8.0, 8.0)), (0.115, 0.13, (8.0, 8.0))]
    assert braked(before, *two, (0.13, 0.2, (2.0, 1.0)))[0][2:6] == [8.0] * 4
