"""Which poses the extremes of a phase are of, by hand on poses made for it; nothing is driven."""

import math

import numpy as np
import pytest

from kaidan.contact import BESIDE_NOSINGS, EVERY_POSE, NO_POSE
from kaidan.contact.door import table_of
from kaidan.contact.kernel import extremes
from kaidan.contact.layout import Extreme, Flight, Known, Leading, Margin, Pose, Pull, Zone
from kaidan.mechanics.measures import sudden_stop_height
from kernel_memory import nothing, numbers, table

G = 9.80665
INF, NAN = math.inf, math.nan
NOSINGS = np.array([0.0, 0.3, 0.6])
PHASE = np.array([0, 0, 1, 1, 1, 1, 2, 2])
CORNER = np.array([0, 0, 0, 0, 0, 1, 1, 0])
"""Of the sixth and the seventh pose the phase beside it too."""
FRONT = np.array([-0.5, -0.4, 0.1, 0.15, 0.2, 0.65, 0.6, 0.8, 0.11, 0.66])
REAR = np.array([-0.9, -0.8, 0.0, -0.1, -0.2, 0.3, 0.2, 0.4, 0.05, 0.32])
COUNT = len(FRONT)
"""Eight poses, and two between, after the fourth and the sixth."""
AT = np.array([0, 1, 2, 3, 4, 5, 6, 7, 3, 5])
FRICTION = [0.1, 0.9, 0.2, 0.3, 9.0, 0.4, 0.5, 0.8, 0.3, 0.4]


def marks(*rows, count=COUNT):
    found = np.zeros(count, dtype=np.int64)
    found[list(rows)] = 1
    return found


def poses_at(rear=REAR, front=FRONT):
    found = nothing(Pose, len(front))
    found["rear"]["x"], found["front"]["x"] = rear, front
    found["rear"]["z"] = found["front"]["z"] = 0.2
    return found


@pytest.fixture
def looked_at(monkeypatch):
    """Extremes, and rows that are looked at: of each phase for each kind of figure and side."""

    def of(*, descending=False, whole=True, counts=(EVERY_POSE,) * 3, friction=FRICTION, **more):
        asked = []
        margins = nothing(Margin, COUNT)
        margins["front"], margins["back"] = np.arange(COUNT) + 0.5, np.arange(COUNT) + 0.25
        margins["belly_touches"] = more.get("belly", marks(4, 6))

        def energy(scene, poses, of, rows, side, weights, tie):
            assert (tie, len(weights)) == (1e-9, COUNT)
            asked.append(("energy", side, list(rows)))
            assert len({weights[row] for row in rows}) == 1
            return more.get("least", 0.002 * weights[rows[0]]), more.get("row", rows[0])

        def rock(scene, poses, of, rows, own, side, whence, pull):
            assert (own, pull) == (8, Pull(0.7, G))
            asked.append(("rock", side, list(rows)))
            # towards the downhill end alone
            came = side == (-1.0 if descending else 1.0)
            assert list(whence) == (AT / 10.0).tolist() if came else np.isinf(list(whence)).all()
            return 0.1 * len(rows), more.get("row", list(rows)[-1])

        monkeypatch.setattr(extremes, "least_flow_energy", energy)
        monkeypatch.setattr(extremes, "first_rock", rock)
        monkeypatch.setattr(extremes, "as_on_flat", lambda pose, side, *given: 0.5 + 0.25 * side)
        known = Known(
            numbers(PHASE, int), numbers(CORNER, bool), numbers(AT, int),
            numbers(1 - marks(4), bool), numbers(friction), numbers(np.array(friction) + 1.0),
            numbers(marks(1, 7), bool),
            numbers(np.arange(8) / 10.0), numbers(marks(3, count=8), bool),
        )  # fmt: skip
        tops = [(0.58, 0.7, 0.1, 0.3), (0.75, 9.0, 0.0, 1.0), (0.6, 0.7, 0.3, 1.0)]
        flights = [(-0.1, 0.1, NAN), (0.04, 0.6, NAN)]
        leading = Leading(
            descending, whole, numbers(counts, int), table(Zone, table_of(Zone, tops)),
            table(Flight, table_of(Flight, flights)), numbers(NOSINGS), 0.1, 0.2,
        )  # fmt: skip
        found = nothing(Extreme, 3)
        written = table(Extreme, found)
        given = table(Pose, poses_at()), table(Margin, margins)
        extremes.find_extremes(None, *given, known, leading, Pull(0.7, G), written)
        written.flush()
        kinds = ([one[1:] for one in asked if one[0] == kind] for kind in ("energy", "rock"))
        return found, *kinds

    return of


def test_which_poses_count_on_the_way_up(looked_at):
    """Traversing a flat judges by nosings, and poses where it is on no flight; a pose that comes
    back is none that falls, uphill none over the top.
    """
    found, energy, rock = looked_at()
    on, lands = [2, 3, 5, 6, 8, 9], [5, 6, 7, 9]
    assert energy == [
        (1.0, [0, 1]), (1.0, [0, 1]), (1.0, on), (1.0, on), (-1.0, [2, 3, 8]),
        (1.0, lands), (1.0, lands),
    ]  # fmt: skip
    # on one flight stand the third and the ninth; the seventh is judged as it lands
    assert rock == [(1.0, [0, 1]), (1.0, [5, 9]), (-1.0, [3]), (1.0, lands)]
    assert found["poses"].tolist() == [2, 6, 4]
    assert found["energy"].tolist() == [0.002] * 3
    assert found["energy_place"].tolist() == FRONT[[0, 2, 5]].tolist()
    assert found["steadiness"].tolist() == [0.0015] * 3
    assert found["steadiness_place"].tolist() == FRONT[[0, 2, 5]].tolist()
    assert found["uphill"].tolist() == [INF, 0.0005, INF]
    np.testing.assert_array_equal(found["uphill_place"], [NAN, FRONT[2], NAN])
    assert found["tilt_downhill"].tolist() == pytest.approx([0.2, 0.2, 0.4])
    assert found["tilt_downhill_place"].tolist() == FRONT[[1, 9, 9]].tolist()
    assert found["tilt_uphill"].tolist() == [INF, 0.1, INF]
    np.testing.assert_array_equal(found["tilt_uphill_place"], [NAN, FRONT[3], NAN])


def test_figures_of_the_poses_of_a_phase(looked_at):
    """Only landing the trailing end slides down what it comes off."""
    found, *_ = looked_at()
    assert found["friction"].tolist() == [0.9, 0.5, 0.5]
    assert found["friction_place"].tolist() == FRONT[[1, 6, 6]].tolist()
    np.testing.assert_array_equal(found["slides_below"], [NAN, NAN, 0.8])
    assert found["traction"].tolist() == [1.9, 1.5, 1.5]
    assert found["static_margin"].tolist() == [0.25, 2.25, 5.25]
    assert found["belly"].tolist() == [0, 1, 1]
    found, *_ = looked_at(belly=marks(4))
    assert found["belly"].tolist() == [0, 0, 0]


def test_of_figures_alike_the_first_pose_is_told(looked_at):
    friction = [0.1, 0.1, 0.5 - 0.9e-9, 0.3, 9.0, 0.4, 0.5, 0.8, 0.3, 0.4]
    found, *_ = looked_at(friction=friction)
    assert found["friction_place"][1] == FRONT[2]
    friction[2] = 0.5 - 1.1e-9
    assert looked_at(friction=friction)[0]["friction_place"][1] == FRONT[6]
    friction[3] = friction[8] = INF
    found, *_ = looked_at(friction=friction)
    assert found["friction"][1] == INF
    assert found["friction_place"][1] == FRONT[3]


def test_where_no_flat_carries_every_pose_is_judged(looked_at):
    rock = looked_at(whole=False)[2]
    assert rock[1:3] == [(1.0, [2, 5, 6, 9]), (-1.0, [2, 3, 8])]


def test_where_nosings_carry_a_pose_at_one_does_not_count(looked_at):
    assert FRONT[6] == NOSINGS[2]
    _, energy, _ = looked_at(counts=(NO_POSE, NO_POSE, BESIDE_NOSINGS))
    assert energy == [(1.0, [5, 7, 9])] * 2


def test_which_poses_count_on_the_way_down(looked_at):
    """Over the edge of the landing above it has to rotate; whether the uppermost contact is over
    the top the rear one tells; nothing came down that gravity would return.
    """
    found, energy, rock = looked_at(descending=True)
    on = [2, 3, 5, 6, 8, 9]
    assert energy[:5] == [(-1.0, [0, 1])] * 2 + [(-1.0, on)] * 2 + [(1.0, on)]
    assert rock == [(-1.0, [5, 9]), (1.0, [3, 5, 9]), (-1.0, [5, 6, 7, 9])]
    assert found["tilt_downhill"][0] == found["tilt_uphill"][0] == INF
    assert found["static_margin"].tolist() == [0.5, 2.5, 5.5]


def test_where_no_pose_is_the_least(looked_at):
    """Of energies that are all infinite the first pose is told, of tilts none."""
    found, *_ = looked_at(least=INF, row=-1)
    assert found["energy"].tolist() == [INF] * 3
    assert found["energy_place"].tolist() == FRONT[[0, 2, 5]].tolist()
    assert np.isnan(found["tilt_downhill_place"]).all()


def of_phases(phase, corner):
    known = Known(numbers(phase, int), numbers(corner, bool), *7 * [None])
    return [
        [k for k in range(len(phase)) if extremes.is_of_phase(known, k, number)]
        for number in range(3)
    ]


def test_between_two_phases_a_pose_is_of_both():
    """Where a contact runs over a corner one pose ends the one and begins the other."""
    # of two corners only the first borders on another phase
    assert of_phases([0, 0, 1, 1, 2, 2], [0, 0, 1, 0, 0, 1]) == [[0, 1, 2], [2, 3], [4, 5]]
    # before it and behind it
    assert of_phases([0, 1, 2, 1, 2, 2], [0, 0, 1, 0, 0, 1]) == [[0], [1, 2, 3], [2, 4, 5]]
    assert of_phases([0, 0, 1, 1], [1, 1, 0, 1]) == [[0, 1], [1, 2, 3], []]


def test_a_place_among_others_to_the_last_digit():
    places = numbers(NOSINGS)
    assert [extremes.is_among(places, x) for x in (0.0, 0.3, 0.6)] == [True] * 3
    others = (-1.0, 0.1, np.nextafter(0.3, 1.0), np.nextafter(0.3, 0.0), 0.7)
    assert not any(extremes.is_among(places, x) for x in others)
    assert not extremes.is_among(places[0:0], 0.3)


def test_poses_on_one_flight():
    """Two flights; with a contact on each, or beyond an end, the robot stands on none."""
    flights = table(Flight, table_of(Flight, [(0.0, 0.3, NAN), (0.9, 1.2, NAN)]))
    ends = [(0.0, 0.3), (-1e-5, 0.2), (0.0, 0.31), (0.1, 0.2), (0.35, 0.8), (0.9, 1.2), (0.2, 1.0)]
    poses = table(Pose, poses_at(*np.transpose(ends)))
    found = [extremes.is_on_flight(pose, flights) for pose in poses]
    assert found == [True, False, False, True, False, True, False]


def test_the_rise_of_a_sudden_stop():
    """By hand: 1 m/s is a height of 1 / 2 g; with the lever as long as the radius half of it."""
    assert extremes.height_of_stop(0.2, 0.2, 10.0) == pytest.approx(0.025)
    assert extremes.height_of_stop(0.1, 0.2, 10.0) == pytest.approx(0.01)
    told = sudden_stop_height(v=1.0, lever=0.137, gyration=0.21, g=G)
    assert extremes.height_of_stop(0.137, 0.21, G) == told


def test_a_rise_as_one_about_the_flat():
    """By hand: radius of gyration 0.2 m, centroid 0.1 m above the flat, so a sudden stop leaves
    1/5 of its energy to a rotation about the flat. 0.2 m above the line of a belt: 1/2; behind it,
    where the belt pulls through the centroid: none.
    """
    half = math.sqrt(0.5)
    rows = nothing(Pose, 3)
    rows["x"], rows["z"] = 0.0, 0.3
    touches = {
        "rear": [(-0.2, 0.2, 0.0, 1.0), (-0.2, 0.1, 0.0, 1.0), (-0.3, 0.0, -half, half)],
        "front": [(0.3, 0.2, 0.0, 1.0), (0.1, 0.3, -1.0, 0.0), (0.2, 0.3 - 0.2 * half, 0.0, 1.0)],
    }
    for end, of in touches.items():
        for name, values in zip(("x", "z", "n_x", "n_z"), np.transpose(of), strict=True):
            rows[end][name] = values
    poses = table(Pose, rows)

    def ratios(side):
        return [extremes.as_on_flat(pose, side, 0.1, 0.2, G) for pose in poses]

    assert ratios(1.0)[:2] == pytest.approx([1.0, 0.4])
    assert ratios(1.0)[2] == pytest.approx(1e6)  # bounded
    # uphill: a face 0.1 m ahead, against which the belt pulls upward; and 0.1414 m: 1/3
    assert ratios(-1.0) == pytest.approx([1.0, 1.0, 0.6])
