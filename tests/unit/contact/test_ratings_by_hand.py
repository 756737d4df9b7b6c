"""Ratings by hand: what counts as a landing, as one chain of rotations, as rocking, as to spare."""

import math

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import Job, PartKind, RotationOutcome, body_table, ground_table, rate_many
from kaidan.contact.door import table_of
from kaidan.contact.kernel import rating
from kaidan.contact.layout import Course, Edge, Flight, Pose, Pull, Rating, RotationRow, Zone
from kernel_memory import made, nothing, scene, table

L, C_N = 0.6, 0.1
LEVEL = ground_table([(-4, 0), (4, 0)])
BODY = body_table(stadium(L, 0.28, C_N, 0.08))
G = 10.0
FALLS = {"outcome": RotationOutcome.PAST_VERTICAL}


def poses_of(*rows):
    return table(Pose, made(Pose, *rows))


def rotations_of(*rows):
    return table(RotationRow, made(RotationRow, *rows))


def flights_of(*rows):
    return table(Flight, made(Flight, *rows))


def zones_of(*rows):
    return table(Zone, table_of(Zone, rows))


def course_of(edges=(), tilts=(0.0, 0.0), rough=0.01):
    return Course(0.02, zones_of(), table(Edge, table_of(Edge, edges)), rough, *tilts)


LANDS = {
    "path_direction": -0.4,
    "inclination": -0.3,
    "rear_lean": 0.5,
    "front.x": 1.0,
    "front.z": 0.2,
}
ZONE = (0.9, 1.1, 0.1, 0.3)


@pytest.mark.parametrize("change", [
    {}, {"front.x": 0.9}, {"front.x": 1.1}, {"front.z": 0.1}, {"front.z": 0.3},
    {"rear_lean": 0.3001}, {"inclination": 0.3, "rear_lean": 0.2}, {"path_direction": -3.0},
])  # fmt: skip
def test_the_trailing_end_leaves_an_edge_as_it_lands(change):
    elsewhere = (-9.0, -8.0, -9.0, -8.0)
    poses = poses_of({}, LANDS | change)
    assert rating.comes_off(poses[1], zones_of(elsewhere, ZONE))
    assert not rating.comes_off(poses[1], zones_of(elsewhere))
    assert not rating.comes_off(poses[0], zones_of(elsewhere, ZONE))


@pytest.mark.parametrize("change", [
    {"front.x": 0.89}, {"front.x": 1.11}, {"front.z": 0.09}, {"front.z": 0.31},
    {"rear_lean": 0.3}, {"rear_lean": 0.2}, {"path_direction": 0.0}, {"path_direction": 0.4},
    {"inclination": 0.3, "rear_lean": 0.0},
])  # fmt: skip
def test_no_trailing_end_leaves_an_edge(change):
    assert not rating.comes_off(poses_of(LANDS | change)[0], zones_of(ZONE))


def test_of_several_poses_at_an_arclength_the_first_line_ends_there():
    s, leg = "s", "leg"
    poses = poses_of(
        {s: 0.0, leg: 0}, {s: 0.1, leg: 0}, {s: 0.2, leg: 1}, {s: 0.2, leg: 0}, {s: 0.2, leg: 0},
        {s: 0.2, leg: 2}, {s: 0.3, leg: 0}, {s: 0.2, leg: 0},
    )  # fmt: skip
    assert rating.row_before(poses, 0.2) == 4
    assert rating.row_before(poses[0:3], 0.2) == 2
    assert rating.row_before(poses, 0.2 + 9e-10) == 4  # rounding
    assert rating.row_before(poses, 0.2 - 9e-10) == 4
    assert rating.row_before(poses, 0.15) == 1  # none there: the last one before
    assert rating.row_before(poses, 0.25) == 5
    assert rating.row_before(poses, 9.0) == 7
    assert rating.row_before(poses, 0.0) == 0
    assert rating.row_before(poses, -1.0) == 0
    assert rating.row_before(poses[4:6], 0.2) == 0


COMES_DOWN = {"pivot_x": 1.0, "pivot_z": 2.0, "start.inclination": 0.6, "end.inclination": -0.95}


@pytest.mark.parametrize(("ahead", "up", "below"), [
    (0.4, -0.3, 0.95 - math.atan2(0.3, 0.4)), (0.2, 0.1, 0.95 + math.atan2(0.1, 0.2)),
    (0.1, 0.4, 1.55),  # above where it starts
    (0.2, -0.5, 0.0),  # not reached
    (0.36, -0.48, 0.95 - math.atan2(0.48, 0.36)), (0.37, -0.48, 0.0), (0.36, -0.49, 0.0),  # length
    (0.01, 0.0, 0.0), (0.011, 0.0, 0.95), (-0.3, 0.0, 0.0),  # not ahead
])  # fmt: skip
def test_a_rotation_beyond_the_line_to_the_next_edge(ahead, up, below):
    row = rotations_of(COMES_DOWN)[0]
    edge = (1.0 + ahead, 2.0 + up)
    length = L + 1e-12  # the edge at the very end of the flat counts
    found = rating.beyond_the_edge(row, course_of([edge], rough=0.01 + 1e-12), length)
    assert found == pytest.approx(below, abs=1e-9)
    more = course_of([(1.5, 1.75), edge, (1.3, 1.7)], rough=0.01 + 1e-12)
    lines = [math.atan2(-0.25, 0.5), math.atan2(-0.3, 0.3)]
    least = [0.95 + each for each in lines]
    found = rating.beyond_the_edge(row, more, length)
    assert found == pytest.approx(max(below, *least), abs=1e-9)
    assert rating.beyond_the_edge(row, course_of(), length) == 0.0


@pytest.mark.parametrize(("rear", "front", "flight"), [
    ((0.1, 0.2), (0.8, 0.9), 0), ((0.0, 0.2), (0.8, 1.0), 0), ((0.2, 0.0), (1.0, 0.8), 0),
    ((-0.1, 0.2), (0.8, 0.9), -1), ((0.1, -0.2), (0.8, 0.9), -1), ((0.1, 0.2), (1.1, 0.9), -1),
    ((0.1, 0.2), (0.8, 1.1), -1), ((2.1, 2.2), (2.8, 2.9), 1), ((0.5, 0.5), (2.5, 2.5), -1),
])  # fmt: skip
def test_flight_on_which_both_contacts_stand(rear, front, flight):
    """Before and after the rotation."""
    rows = [{"rear.x": r, "front.x": f} for r, f in zip(rear, front, strict=True)]
    flights = flights_of({"begin": 0.0, "end": 1.0}, {"begin": 2.0, "end": 3.0})
    far = {"rear.x": -9.0, "front.x": 9.0}
    assert rating.flight_at(poses_of(far, *rows, far), 1, flights) == flight


@pytest.mark.parametrize(("turn", "before", "after", "slope", "rocks"), [
    (0.3, 0.4, 0.7, 0.5, 0.2), (0.3, 0.4, 0.7, 0.65, 0.25), (0.3, 0.1, 0.2, 0.9, 0.3),
])  # fmt: skip
def test_rocking_is_from_the_slope_of_the_flight(turn, before, after, slope, rocks):
    assert rating.rocking(turn, before, after, slope) == pytest.approx(rocks)


def rated(rows, poses=None, *, a=0.0, tilts=(0.0, 0.0), edges=(), flights=()):
    """Angle, rocking, speed of impact, rise to spare."""
    poses = poses_of({}, {"s": 1.0}) if poses is None else poses
    found = table(Rating, nothing(Rating, 1))[0]
    rating.rate_rotations(
        scene(LEVEL, BODY), poses, rotations_of(*rows), Pull(a, G), L,
        course_of(edges, tilts), flights_of(*flights), found,
    )  # fmt: skip
    return found.largest_rotation, found.rocking, found.impact_speed, found.spare


def test_nothing_turns():
    assert rated([]) == (0.0, 0.0, 0.0, math.inf)


def turn(angle, begin, end, sense=1.0, **more):
    """A rotation from one place (x, z, inclination) to another."""
    names = {
        "barrier": "barrier", "across": "barrier_across", "s": "s",
        "rate": "rate_before", "outcome": "outcome", "pivot_x": "pivot_x",
        "pivot_z": "pivot_z",
    }  # fmt: skip
    row = {"angle": angle, "sense": sense}
    row |= dict(zip(("start.x", "start.z", "start.inclination"), begin, strict=True))
    row |= dict(zip(("end.x", "end.z", "end.inclination"), end, strict=True))
    return FALLS | row | {names[name]: value for name, value in more.items()}


@pytest.mark.parametrize(("x", "z", "together"), [
    (0.003, 0.004, True), (-0.003, -0.004, True), (0.0037, 0.0049, False), (0.0, 0.0061, False),
    (-0.0061, 0.0, False), (0.0, 0.0059, True),
])  # fmt: skip
def test_rotations_less_than_a_hundredth_of_the_flat_apart_are_one(x, z, together):
    """Angles, drops and what may be avoided add up; the barrier of each is its own."""
    first = turn(0.2, (0.0, 1.0, 0.3), (0.1, 0.98, 0.1), barrier=0.5)
    second = turn(0.15, (0.1 + x, 0.98 + z, 0.1), (0.2, 0.97 + z, 0.2), barrier=0.3)
    third = turn(0.05, (2.0, 0.5, 0.0), (2.0, 0.49, 0.0), barrier=0.9)
    found = rated([first, second, third])
    if together:
        assert found == pytest.approx((0.35, 0.35, 0.0, 0.03 - 0.03))
    else:
        assert found == pytest.approx((0.2, 0.2, 0.0, 0.03 - 0.01))
    assert rated([third]) == pytest.approx((0.05, 0.05, 0.0, 0.09 - 0.01))


def test_rise_to_spare_is_along_gravity_and_acceleration():
    a = 3.0
    slopes = (0.3, 0.5)
    poses = poses_of(
        {"s": 0.1, "path_direction": slopes[0]}, {"s": 0.4, "path_direction": slopes[1]}, {"s": 1.0}
    )
    first = turn(0.2, (0.5, 1.0, 0.0), (0.4, 0.93, 0.0), s=0.1, barrier=0.7)
    second = turn(0.2, (0.4, 0.93, 0.0), (0.37, 0.95, 0.0), s=0.4, barrier=0.8)
    fallen = 0.0
    spares = []
    for slope, (d_x, d_z), barrier in zip(
        slopes, [(0.1, 0.07), (0.03, -0.02)], (0.7, 0.8), strict=True
    ):
        load = -1j * G - a * np.exp(1j * slope)  # gravity and inertia, as complex numbers
        moved = -d_x - 1j * d_z
        fallen += (moved * np.conj(load)).real / abs(load)
        spares.append(barrier / abs(load) - fallen)
    assert rated([first], poses, a=a)[3] == pytest.approx(spares[0])
    assert rated([first, second], poses, a=a)[3] == pytest.approx(min(spares))
    first["barrier"] = 9.0
    assert rated([first, second], poses, a=a)[3] == pytest.approx(spares[1])


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("a", [0.0, 3.0])
def test_tilted_gravity_takes_from_the_rise_what_lies_on_the_way(sense, a):
    """By turning gravity itself: of the drops, and up to where it would topple."""
    tilt = 0.04
    tilts = (tilt, 0.5) if sense > 0 else (0.5, tilt)
    ahead = -sense  # x towards the end that comes down
    first = turn(0.2, (0.0, 1.0, 0.3), (ahead * 0.1, 0.98, 0.1), sense,
                 barrier=0.5, across=ahead * 0.05)  # fmt: skip
    second = turn(0.15, (ahead * 0.101, 0.98, 0.1), (ahead * 0.15, 0.97, 0.2), sense,
                  barrier=0.4, across=ahead * 0.02)  # fmt: skip
    load = complex(a, G)
    up = load / abs(load)
    tilted = up * np.exp(1j * ahead * tilt)

    def of(vector, along):
        return (vector * np.conj(along)).real

    spares, moved = [], 0j
    for row, step in (
        (first, complex(ahead * 0.1, -0.02)),
        (second, complex(ahead * 0.049, -0.01)),
    ):
        moved += step
        rise = row["barrier"] / abs(load) * up + row["barrier_across"] * (up / 1j)
        spares.append(of(moved + rise, tilted))
    assert rated([first, second], a=a, tilts=tilts)[3] == pytest.approx(min(spares))
    # of one that does not follow at once its own way alone counts
    apart = turn(0.1, (5.0, 1.0, 0.3), (5.0 + ahead * 0.1, 0.98, 0.1), sense,
                 barrier=0.1, across=ahead * 0.05)  # fmt: skip
    alone = rated([apart], a=a, tilts=tilts)[3]
    assert alone < rated([first], a=a, tilts=tilts)[3]
    assert rated([first, apart], a=a, tilts=tilts)[3] == pytest.approx(alone)


def test_of_what_comes_down_only_what_is_beyond_the_next_edge_may_be_avoided():
    down = turn(0.5, (0.0, 1.0, 0.3), (0.0, 1.0, -0.2), sense=-1.0, pivot_x=1.0, pivot_z=2.0)
    up = turn(0.1, (0.0, 1.0, -0.2), (0.0, 1.0, -0.1))
    edges = [(1.5, 1.95)]
    beyond = 0.2 - math.atan2(0.05, 0.5)
    assert rated([down], edges=edges)[:2] == pytest.approx((0.5, beyond))
    assert rated([down, up], edges=edges)[:2] == pytest.approx((0.6, beyond + 0.1))
    level = down | {"sense": 0.0}
    assert rated([level], edges=edges)[:2] == pytest.approx((0.5, 0.5))


FLIGHTS = [
    {"begin": -9.0, "end": -3.0, "slope": 0.5},
    {"begin": 0.0, "end": 2.0, "slope": 0.5},
    {"begin": 4.0, "end": 6.0, "slope": 0.4},
]
STANDS = poses_of(
    {"s": 0.1, "rear.x": 0.5, "front.x": 1.0},
    {"s": 0.2, "rear.x": 0.5, "front.x": 1.0},
    {"s": 0.3, "rear.x": 4.5, "front.x": 5.0},
    {"s": 0.4, "rear.x": 4.5, "front.x": 5.0},
)


def held(angle, before, after, s, x=0.3, **more):
    there = (x, C_N)
    more = {"outcome": RotationOutcome.ARRESTED, **more}
    return turn(angle, (*there, before), (*there, after), s=s, **more)


def test_on_a_flight_it_rocks_about_the_mean_slope():
    one = held(0.5, 0.2, 0.6, 0.1)
    assert rated([one], STANDS, flights=FLIGHTS)[1] == pytest.approx(0.3)
    assert rated([held(0.5, 0.6, 0.2, 0.1)], STANDS, flights=FLIGHTS)[1] == pytest.approx(0.3)
    assert rated([one])[1] == pytest.approx(0.5)  # no flight
    on = [one, held(0.4, 0.6, 0.9, 0.1)]
    assert rated(on, STANDS, flights=FLIGHTS)[:2] == pytest.approx((0.9, 0.4))
    # the first of two that go on to another flight is on its own, both are on none
    other = [one, held(0.1, 0.6, 0.5, 0.3)]
    assert rated(other, STANDS, flights=FLIGHTS)[:2] == pytest.approx((0.6, 0.6))
    # what is not arrested stands on no flight
    free = held(0.5, 0.2, 0.6, 0.1, outcome=RotationOutcome.PAST_VERTICAL)
    assert rated([free], STANDS, flights=FLIGHTS)[1] == pytest.approx(0.5)
    # two that do not follow one another are each on a flight
    apart = [one, held(0.35, 0.1, 0.4, 0.3, x=0.4)]
    assert rated(apart, STANDS, flights=FLIGHTS)[:2] == pytest.approx((0.5, 0.3))


def test_the_largest_impact_of_what_is_arrested():
    """Rate times the length of the flat on which it comes to rest."""
    rows = [held(0.1, 0.1, 0.0, 0.0, rate=rate) for rate in (0.5, 0.8, 0.2)]
    assert rated(rows)[2] == pytest.approx(0.8 * L)
    assert rated([row | FALLS for row in rows])[2] == 0.0
    assert rated([rows[0], rows[1] | FALLS, rows[2]])[2] == pytest.approx(0.5 * L)


KINDS = (PartKind.TRACK, PartKind.BELLY)
TRACK = (-0.32, -0.02, 0.08, 0.28, -0.02, 0.08)
LOW, HIGH = ([TRACK, (-0.1, z, 0.005, 0.1, z, 0.005)] for z in (-0.1, 0.0))  # part of the belly


def of_jobs(terrain, robots, flights, zones=(), ends=(1.5,) * 3):
    jobs = [Job(0, k, -1.0, ends[k]) for k in range(len(robots))]
    return rate_many(terrain, robots, KINDS, [L] * len(robots), flights, jobs, step=0.02,
                     zones=zones, edges=[(0.3, 0.25)], rough=0.01)  # fmt: skip


def test_each_job_is_of_its_own_robot_and_flights():
    """Whether a belly touches, rocking on a flight: as of that robot alone."""
    terrain = [(-4, 0), (0, 0), (0, 0.1), (4, 0.1)]
    robots, flights = [HIGH, LOW, HIGH], [[(-5.0, 5.0, 0.1)], [], []]
    found = of_jobs(terrain, robots, flights)
    assert found.status.tolist() == [0, 0, 0]
    assert found.belly_touches.tolist() == [False, True, False]
    for k in range(3):
        alone = of_jobs(terrain, robots[k : k + 1], flights[k : k + 1])
        np.testing.assert_array_equal(found.table[k], alone.table[0])
    assert of_jobs(terrain, [HIGH, HIGH], [[], flights[0]]).rocking[0] == found.rocking[2]
    assert found.rocking[0] < found.rocking[2]
    below = of_jobs(terrain, [HIGH, HIGH], [flights[0], []]).rocking
    assert below.tolist() == [found.rocking[0], found.rocking[2]]


def test_after_an_end_that_leaves_an_edge_friction_counts_again():
    """A low edge and a high one on the way down; on a landing that end is let off."""
    terrain = [(-4, 0.35), (0, 0.35), (0, 0.25), (2, 0.25), (2, 0), (6, 0)]
    below_one, below_both = (-9, 1.9, 0.2, 0.3), (-9, 9, -1, 0.3)
    one, first, both = (
        of_jobs(terrain, [HIGH], [[]], zones, [4.0]).required_friction[0]
        for zones in ([], [below_one], [below_both])
    )
    assert one == first > both + 0.05


NUMBERS = ("required_friction", "largest_rotation", "rocking", "impact_speed", "spare")


def test_a_job_that_does_not_arrive_is_left_out():
    terrain = [(-4, 0), (0, 0), (0, 0.1), (2, 0.1), (2, 1.5), (4, 1.5)]
    ends = (3.0, 1.0)
    found = of_jobs(terrain, [HIGH, HIGH], [[], []], ends=ends)
    assert found.status[0] != 0
    not_arrived, arrived = ([row[name] for name in NUMBERS] for row in found.table)
    assert np.isnan(not_arrived).all()
    assert np.isfinite(arrived).all()
    assert found.held[1] == found.held_at_best[1] == np.inf  # nobody asks
