"""Which poses the extremes of a phase are of, by hand on records made for it; no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import Feature, FeatureKind, Placement
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Phase, extremes
from kaidan.traversal.brief import by_how_long
from kaidan.traversal.extremes import (
    Rise,
    _came_down,
    _CameDown,
    _flights,
    _least_rise,
    _rotated,
    _Way,
    phase_extremes,
)
from kaidan.traversal.phases import top_zones
from kaidan.traversal.rotations import ROCKING, together

G = 9.80665
STEPS = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=3))
NOSINGS = STEPS.nosings


class Rows(SimpleNamespace):
    def __len__(self):
        return len(self.front_point)


PHASE = np.array(["enter"] * 2 + ["traverse"] * 4 + ["land"] * 2)
BODY = SimpleNamespace(stance=SimpleNamespace(flat_length=0.5, com_height=0.1), least_gyration=0.2)


def found(**more):
    """Figures of a phase, each place of the energies at a nosing of its own."""
    usual = dict.fromkeys(contact.Extreme.__annotations__, math.nan) | {
        "poses": 4.0, "friction": 0.5, "friction_place": NOSINGS[2, 0], "static_margin": 0.2,
        "traction": 4.0, "belly": 0.0, "energy": 0.002, "energy_place": NOSINGS[1, 0],
        "steadiness": 0.0015, "steadiness_place": NOSINGS[0, 0], "uphill": math.inf,
        "tilt_downhill": 0.2, "tilt_downhill_place": NOSINGS[2, 0], "tilt_uphill": math.inf,
    }  # fmt: skip
    return contact.Extreme(**(usual | more))


@pytest.fixture
def told(monkeypatch):
    """Extremes of a path by what the kernel finds, and what it is asked."""

    def of(*each, descending=False, whole=True, rises=(), profile=STEPS):
        asked = {}

        def extremes_of(samples, whence, back, manner):
            asked.update(manner._asdict(), whence=whence, back=back)
            assert samples == ("samples", 0.7)
            return each

        for name, stands in {
            "samples_of": lambda path, phase, acceleration: ("samples", acceleration),
            "together": lambda rotations, length: ["chains", length],
            "_chain_angles": lambda *given: [(0, 0.3), (2, 0.1), (3, 0.2)],
            "_came_down": lambda path, chains, whole: _CameDown(np.arange(8.0), np.arange(8) == 3),
            "_rotated": lambda way, name, side: (0.1 * side, 5),
        }.items():
            monkeypatch.setattr(extremes, name, stands)
        monkeypatch.setattr(contact, "extremes_of", extremes_of)
        path = SimpleNamespace(poses=Rows(front_point=np.zeros((8, 2))), rotations=[])
        given = path, profile, PHASE, descending, 0.7, rises, BODY, whole
        return phase_extremes(*given), asked

    return of


def test_what_the_kernel_is_asked(told):
    _, asked = told(None, None, None)
    assert (asked["descending"], asked["whole"], asked["acceleration"]) == (False, True, 0.7)
    assert (asked["height"], asked["gyration"]) == (0.1, 0.2)
    assert asked["nosings"].tolist() == NOSINGS[:, 0].tolist()
    assert asked["tops"] == top_zones(STEPS, False, 0.5)
    (flight,) = asked["flights"]
    assert flight == pytest.approx((NOSINGS[0, 0] - 1e-6, NOSINGS[2, 0] + 1e-6), abs=1e-12)
    assert asked["whence"].tolist() == list(range(8))
    assert np.flatnonzero(asked["back"]).tolist() == [3]
    # on the way down gravity towards the downhill end returns nothing
    _, asked = told(None, None, None, descending=True)
    assert np.isinf(asked["whence"]).all()
    assert not asked["back"].any()


def test_which_poses_count_for_the_energy(told):
    """Where nosings carry, none traversing, and landing those beside them; none over the edge of
    the landing above.
    """
    none, beside, every = contact.NO_POSE, contact.BESIDE_NOSINGS, contact.EVERY_POSE
    rises = Rise(True, 0.001, 2, Phase.TRAVERSE), Rise(True, 0.005, 3, Phase.LAND)
    level = Profile.of_points([(-3, 0), (3, 0)])
    for how, counts in (
        ({}, (every, every, every)),
        ({"rises": rises}, (every, none, beside)),
        ({"rises": rises[1:]}, (every, every, beside)),
        ({"descending": True}, (none, every, every)),
        ({"descending": True, "profile": level}, (every, every, every)),
    ):
        assert told(None, None, None, **how)[1]["counts"] == counts


def test_figures_of_each_phase(told):
    """By name, with the step at each place; of a phase without a pose none."""
    (enter, land), _ = told(found(), None, found(slides_below=0.8, belly=1.0))
    assert (enter.phase, land.phase) == (Phase.ENTER, Phase.LAND)
    assert (enter.required_friction, enter.required_friction_step) == (0.5, 3)
    assert (enter.slides_below, land.slides_below) == (None, 0.8)
    assert (enter.energy_margin, enter.energy_margin_step) == (0.002, 2)
    assert enter.steadiness == (0.0015, 1)
    assert enter.uphill_steadiness == (math.inf, 0)
    assert (enter.static_margin, enter.traction_over_weight) == (0.2, 4.0 / G)
    assert (enter.largest_rotation, land.largest_rotation) == (0.3, 0.0)
    assert (enter.belly_touches, land.belly_touches) == (False, True)
    # a rotation that nothing arrests is the lesser tilt
    assert (enter.tilt_downhill, enter.tilt_uphill) == ((0.1, 5), (-0.1, 5))
    less = told(found(tilt_downhill=0.05), None, None)[0][0]
    assert less.tilt_downhill == (0.05, 3)
    down = told(found(), None, None, descending=True)[0][0]
    assert (down.required_friction_step, down.energy_margin_step) == (1, 2)
    assert (down.tilt_downhill, down.tilt_uphill) == ((-0.1, 5), (0.1, 5))


def test_the_largest_rotation_of_a_phase(told):
    (flight,), _ = told(None, found(), None)
    assert flight.largest_rotation == 0.2


def test_where_nosings_carry_their_rises_count(told):
    """Of a rise and the least of poses the smaller one."""
    rises = (
        Rise(True, 0.001, 2, Phase.TRAVERSE), Rise(False, 0.004, 3, Phase.TRAVERSE),
        Rise(True, 0.0018, 3, Phase.LAND),
    )  # fmt: skip
    on = found(uphill=0.0005, uphill_place=NOSINGS[0, 0])
    (enter, flight, land), _ = told(found(), on, found(), rises=rises)
    assert (enter.energy_margin, enter.energy_margin_step) == (0.002, 2)
    assert (flight.energy_margin, flight.energy_margin_step) == (0.001, 2)
    assert (flight.steadiness, flight.uphill_steadiness) == ((0.001, 2), (0.0005, 1))
    assert (land.energy_margin, land.energy_margin_step) == (0.0018, 3)
    assert land.steadiness == (0.0015, 1)


def test_flights_by_hand():
    """Nosings 0.3, 0.6 and 0.3 m apart under a flat of 0.5 m: two flights of two."""
    rows = [(0.0, 0.1), (0.3, 0.2), (0.9, 0.3), (1.2, 0.4)]
    points = [(-2.0, 0.0)]
    for x, z in rows:
        points += [(x, points[-1][1]), (x, z)]
    profile = Profile.of_points([*points, (3.0, 0.4)])
    assert profile.nosings.tolist() == [list(each) for each in rows]
    one, two = _flights(profile, 0.5)
    assert one == pytest.approx((-1e-6, 0.3 + 1e-6), abs=1e-12)
    assert two == pytest.approx((0.9 - 1e-6, 1.2 + 1e-6), abs=1e-12)


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
    whence, back = _came_down(path, together(rotations, 0.5), whole)
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
        return _rotated(_Way(path, STEPS, phase, False, whole), name, side)

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


def test_the_step_of_the_least_rise():
    rises = [Rise(True, 0.2, 4, Phase.LAND), Rise(True, 0.2 + 5e-10, 2, Phase.LAND)]
    assert _least_rise(rises, downhill=True) == (0.2, 2)
    assert _least_rise(rises, downhill=False) == (math.inf, 0)


def test_the_step_of_a_place():
    way = _Way(None, STEPS, PHASE, False, True)
    assert [way.step(x) for x in (NOSINGS[0, 0] + 0.01, math.nan, 9.0)] == [1, 0, 3]


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
