"""Which poses the extremes of a phase are of, by hand on poses made for it; nothing is driven."""

import math

import numpy as np
import pytest

from kaidan.contact import BESIDE_NOSINGS, EVERY_POSE, NO_POSE
from kaidan.contact import layout as at
from kaidan.contact.kernel import extremes
from kaidan.contact.scratch import peak_scratch
from kaidan.mechanics.measures import sudden_stop_height

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
    found = np.full((len(front), at.POSE_COLUMNS), 7.0)
    found["rear"]["x"], found["front"]["x"] = rear, front
    found[:, [at.REAR_Z, at.FRONT_Z]] = 0.2
    return found


@pytest.fixture
def looked_at(monkeypatch):
    """Extremes, and rows that are looked at: of each phase for each kind of figure and side."""

    def of(*, descending=False, whole=True, counts=(EVERY_POSE,) * 3, friction=FRICTION, **more):
        asked = []
        margins = np.full((COUNT, at.MARGIN_COLUMNS), NAN)
        margins["front"], margins["back"] = np.arange(COUNT) + 0.5, np.arange(COUNT) + 0.25
        margins["belly_touches"] = more.get("belly", marks(4, 6))

        def energy(ground, body, poses, of, rows, side, weights, tie, order, pivots):
            assert (tie, len(weights)) == (1e-9, COUNT)
            asked.append(("energy", side, rows.tolist()))
            assert len(set(weights[rows])) == 1
            return more.get("least", 0.002 * weights[rows[0]]), more.get("row", rows[0])

        def rock(ground, body, poses, of, rows, own, side, whence, a, g, touch, *scratch):
            assert (own, a, g, touch) == (8, 0.7, G, 1e-9)
            asked.append(("rock", side, rows.tolist()))
            # towards the downhill end alone
            came = side == (-1.0 if descending else 1.0)
            assert whence.tolist() == (AT / 10.0).tolist() if came else np.isinf(whence).all()
            return 0.1 * len(rows), more.get("row", rows[-1])

        monkeypatch.setattr(extremes, "least_flow_energy", energy)
        monkeypatch.setattr(extremes, "first_rock", rock)
        monkeypatch.setattr(
            extremes, "as_on_flat", lambda poses, row, side, *given: 0.5 + 0.25 * side
        )
        size = COUNT + 5
        table = np.full((3, at.EXTREME_COLUMNS), NAN)
        extremes.find_extremes(
            None, None, poses_at(), margins, PHASE, CORNER, AT, 1 - marks(4),
            np.array(friction), np.array(friction) + 1.0, marks(1, 7), np.arange(8) / 10.0,
            marks(3, count=8), np.array(counts), descending, whole,
            np.array([(0.58, 0.7, 0.1, 0.3), (0.75, 9.0, 0.0, 1.0), (0.6, 0.7, 0.3, 1.0)]),
            np.array([(-0.1, 0.1, NAN), (0.04, 0.6, NAN)]), NOSINGS, 0.1, 0.2, 0.7, G, 1e-9,
            *np.full((2, COUNT), 9.0), *np.full((4, COUNT), 9), *np.full((2, COUNT), 9.0),
            *np.full((4, size), 9), *np.full((3, size), 9.0), np.full(size, 9),
            *peak_scratch(COUNT, 1), table,
        )  # fmt: skip
        kinds = ([one[1:] for one in asked if one[0] == kind] for kind in ("energy", "rock"))
        return table, *kinds

    return of


def test_which_poses_count_on_the_way_up(looked_at):
    """Traversing a flat judges by nosings, and poses where it is on no flight; a pose that comes
    back is none that falls, uphill none over the top.
    """
    table, energy, rock = looked_at()
    on, lands = [2, 3, 5, 6, 8, 9], [5, 6, 7, 9]
    assert energy == [
        (1.0, [0, 1]), (1.0, [0, 1]), (1.0, on), (1.0, on), (-1.0, [2, 3, 8]),
        (1.0, lands), (1.0, lands),
    ]  # fmt: skip
    # on one flight stand the third and the ninth; the seventh is judged as it lands
    assert rock == [(1.0, [0, 1]), (1.0, [5, 9]), (-1.0, [3]), (1.0, lands)]
    assert table["poses"].tolist() == [2, 6, 4]
    assert table["energy"].tolist() == [0.002] * 3
    assert table["energy_place"].tolist() == FRONT[[0, 2, 5]].tolist()
    assert table["steadiness"].tolist() == [0.0015] * 3
    assert table["steadiness_place"].tolist() == FRONT[[0, 2, 5]].tolist()
    assert table["uphill"].tolist() == [INF, 0.0005, INF]
    np.testing.assert_array_equal(table["uphill_place"], [NAN, FRONT[2], NAN])
    assert table["tilt_downhill"].tolist() == pytest.approx([0.2, 0.2, 0.4])
    assert table["tilt_downhill_place"].tolist() == FRONT[[1, 9, 9]].tolist()
    assert table["tilt_uphill"].tolist() == [INF, 0.1, INF]
    np.testing.assert_array_equal(table["tilt_uphill_place"], [NAN, FRONT[3], NAN])


def test_figures_of_the_poses_of_a_phase(looked_at):
    """Only landing the trailing end slides down what it comes off."""
    table, *_ = looked_at()
    assert table["friction"].tolist() == [0.9, 0.5, 0.5]
    assert table["friction_place"].tolist() == FRONT[[1, 6, 6]].tolist()
    np.testing.assert_array_equal(table["slides_below"], [NAN, NAN, 0.8])
    assert table["traction"].tolist() == [1.9, 1.5, 1.5]
    assert table["static_margin"].tolist() == [0.25, 2.25, 5.25]
    assert table["belly"].tolist() == [0, 1, 1]
    table, *_ = looked_at(belly=marks(4))
    assert table["belly"].tolist() == [0, 0, 0]


def test_of_figures_alike_the_first_pose_is_told(looked_at):
    friction = [0.1, 0.1, 0.5 - 0.9e-9, 0.3, 9.0, 0.4, 0.5, 0.8, 0.3, 0.4]
    table, *_ = looked_at(friction=friction)
    assert table["friction_place"][1] == FRONT[2]
    friction[2] = 0.5 - 1.1e-9
    assert looked_at(friction=friction)[0][1, at.EXTREME_FRICTION_X] == FRONT[6]
    friction[3] = friction[8] = INF
    table, *_ = looked_at(friction=friction)
    assert table["friction"][1] == INF
    assert table["friction_place"][1] == FRONT[3]


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
    table, energy, rock = looked_at(descending=True)
    on = [2, 3, 5, 6, 8, 9]
    assert energy[:5] == [(-1.0, [0, 1])] * 2 + [(-1.0, on)] * 2 + [(1.0, on)]
    assert rock == [(-1.0, [5, 9]), (1.0, [3, 5, 9]), (-1.0, [5, 6, 7, 9])]
    assert table["tilt_downhill"][0] == table["tilt_uphill"][0] == INF
    assert table["static_margin"].tolist() == [0.5, 2.5, 5.5]


def test_where_no_pose_is_the_least(looked_at):
    """Of energies that are all infinite the first pose is told, of tilts none."""
    table, *_ = looked_at(least=INF, row=-1)
    assert table["energy"].tolist() == [INF] * 3
    assert table["energy_place"].tolist() == FRONT[[0, 2, 5]].tolist()
    assert np.isnan(table["tilt_downhill_place"]).all()


def of_phases(phase, corner):
    given = np.array(phase), np.array(corner)
    return [
        [row for row in range(len(phase)) if extremes.is_of_phase(*given, row, number)]
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
    assert [extremes.is_among(NOSINGS, x) for x in (0.0, 0.3, 0.6)] == [True] * 3
    others = (-1.0, 0.1, np.nextafter(0.3, 1.0), np.nextafter(0.3, 0.0), 0.7)
    assert not any(extremes.is_among(NOSINGS, x) for x in others)
    assert not extremes.is_among(NOSINGS[:0], 0.3)


def test_poses_on_one_flight():
    """Two flights; with a contact on each, or beyond an end, the robot stands on none."""
    flights = np.array([(0.0, 0.3, NAN), (0.9, 1.2, NAN)])
    ends = [(0.0, 0.3), (-1e-5, 0.2), (0.0, 0.31), (0.1, 0.2), (0.35, 0.8), (0.9, 1.2), (0.2, 1.0)]
    poses = poses_at(*np.transpose(ends))
    found = [extremes.is_on_flight(poses, row, flights) for row in range(len(ends))]
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
    poses = np.full((3, at.POSE_COLUMNS), NAN)
    poses[:, [at.POSE_X, at.POSE_Z]] = 0.0, 0.3
    poses[:, [at.REAR_X, at.REAR_Z]] = [(-0.2, 0.2), (-0.2, 0.1), (-0.3, 0.0)]
    poses[:, [at.REAR_N_X, at.REAR_N_Z]] = [(0.0, 1.0), (0.0, 1.0), (-half, half)]
    poses[:, [at.FRONT_X, at.FRONT_Z]] = [(0.3, 0.2), (0.1, 0.3), (0.2, 0.3 - 0.2 * half)]
    poses[:, [at.FRONT_N_X, at.FRONT_N_Z]] = [(0.0, 1.0), (-1.0, 0.0), (0.0, 1.0)]

    def ratios(side):
        return [extremes.as_on_flat(poses, row, side, 0.1, 0.2, G) for row in range(3)]

    assert ratios(1.0)[:2] == pytest.approx([1.0, 0.4])
    assert ratios(1.0)[2] == pytest.approx(1e6)  # bounded
    # uphill: a face 0.1 m ahead, against which the belt pulls upward; and 0.1414 m: 1/3
    assert ratios(-1.0) == pytest.approx([1.0, 1.0, 0.6])
