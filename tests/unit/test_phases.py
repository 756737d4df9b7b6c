"""Phases of poses from where their contacts stand, laid out by hand; no kernel."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import layout
from kaidan.terrain.profile import Profile
from kaidan.traversal.phases import (
    flights_span,
    landing_zones,
    phases_of,
    step_at,
    top_zones,
    uneven_span,
)
from kernel_memory import nothing

ROOM = 0.5
"""Length of the flat [m]."""
POINTS = [
    (-2, 0), (0, 0), (0, 0.1), (0.3, 0.1), (0.3, 0.2), (0.6, 0.2), (0.6, 0.3),
    (1.6, 0.3), (1.6, 0.4), (1.9, 0.4), (1.9, 0.5), (2.2, 0.5), (2.2, 0.6), (4.2, 0.6),
]  # fmt: skip
"""Three steps, a landing of 1 m, three steps."""
PROFILE = Profile.of_points(POINTS)

UP = [  # rear contact, front contact, phase, whether it is over the top of a flight
    ((-1, 0.02), (-0.5, 0.01), "enter", False),  # before the stairs, level or not
    ((-1, 0), (-0.5, 0), "enter", False),
    ((0, 0.05), (0.3, 0.1), "enter", False),  # on the face for a moment, and back again
    ((-0.5, 0), (0, 0.1), "enter", False),
    ((0, 0.1), (0.3, 0.2), "traverse", False),
    ((0, 0.1), (0.6, 0.3), "land", True),  # on the last nosing
    ((0.3, 0.2), (1.0, 0.3), "land", True),
    ((0.6, 0.3), (1.2, 0.3), "land", True),  # the edge behind belongs to the flight it leaves
    ((0.6, 0.3), (1.6, 0.35), "traverse", False),  # from edge to riser
    ((0.7, 0.3), (1.3, 0.3), "land", True),
    ((0.7, 0.3), (1.6, 0.35), "enter", False),  # at the next riser
    ((1.0, 0.3), (1.6, 0.4), "enter", False),
    ((1.6, 0.4), (1.9, 0.5), "traverse", False),
    ((1.9, 0.5), (2.2, 0.6), "land", True),
    ((2.2, 0.6), (3.0, 0.6), "land", True),
]
DOWN = [
    ((3.0, 0.6), (2.5, 0.6), "enter", True),
    ((2.5, 0.6), (2.2, 0.6), "enter", True),
    ((2.2, 0.6), (1.9, 0.5), "enter", True),
    ((1.9, 0.5), (1.6, 0.4), "traverse", False),
    ((1.9, 0.5), (1.3, 0.3), "land", False),
    ((1.6, 0.4), (1.0, 0.3), "land", False),
    ((1.3, 0.3), (0.8, 0.3), "land", True),
    ((1.0, 0.3), (0.6, 0.3), "enter", True),  # at the next edge
    ((0.7, 0.3), (0.3, 0.2), "enter", True),
    ((0.6, 0.3), (0.3, 0.2), "enter", True),
    ((0.3, 0.2), (0, 0.1), "traverse", False),
    ((0.3, 0.2), (0, 0.05), "traverse", False),  # on the last face
    ((0.3, 0.2), (-0.5, 0), "land", False),
    ((0, 0.1), (-1, 0), "land", False),
]


def over_the_top(path, profile, descending):
    """Poses whose uppermost contact stands in one of the zones."""
    upper = path.poses.rear_point if descending else path.poses.front_point
    zones = top_zones(profile, descending, ROOM)
    return [
        any(x_0 <= x <= x_1 and z_0 <= z <= z_1 for x_0, x_1, z_0, z_1 in zones) for x, z in upper
    ]


def driven(rows, descending):
    """Path with contacts alone, and the profile as driven."""
    sign = np.array([-1.0 if descending else 1.0, 1.0])
    rear, front = (np.array([row[k] for row in rows], dtype=float) * sign for k in (0, 1))
    table = nothing(layout.Pose, len(rows))
    for end, points in (("rear", rear), ("front", front)):
        table[end]["x"], table[end]["z"] = np.transpose(points)
    path = SimpleNamespace(poses=contact.Poses(table))
    return path, PROFILE.reflected() if descending else PROFILE


@pytest.mark.parametrize(("rows", "descending"), [(UP, False), (DOWN, True)])
def test_phases_over_two_flights(rows, descending):
    path, profile = driven(rows, descending)
    assert phases_of(path, profile, descending, ROOM).tolist() == [row[2] for row in rows]
    assert over_the_top(path, profile, descending) == [row[3] for row in rows]


@pytest.mark.parametrize(("rows", "descending"), [(UP, False), (DOWN, True)])
def test_a_tread_that_is_shorter_than_the_flat_is_no_landing(rows, descending):
    path, profile = driven(rows, descending)
    phases = phases_of(path, profile, descending, 1.0 + 1e-9)
    count = 3 if descending else 4
    first, last = [row[2] for row in rows[:count]], [row[2] for row in rows[-2:]]
    assert phases.tolist() == [*first, *["traverse"] * (len(rows) - count - 2), *last]
    # of a landing just long enough it is one
    assert phases_of(path, profile, descending, 1.0 - 1e-9).tolist() == [row[2] for row in rows]


def test_on_a_rough_profile_a_nosing_is_met_within_its_roughness():
    rows = [((1.9, 0.5), (2.2 - 0.002, 0.6 - 0.002), "land", True)]
    for roughness, over in ((0.003, True), (0.001, False)):
        path, _ = driven(rows, False)
        rough = replace(PROFILE, roughness=roughness)
        assert over_the_top(path, rough, False) == [over]
        assert phases_of(path, rough, False, ROOM).tolist() == ["land" if over else "traverse"]


@pytest.mark.parametrize(
    ("points", "span"),
    [
        (POINTS, (0.0, 2.2)),
        ([(0.5, 0.2), (3, 0.2)], (0.5, 0.5)),
        ([(-1, 0), (1, 0), (1.2, 0.1), (1.4, 0), (3, 0)], (1.0, 1.4)),
        ([(-1, 0), (1, 0), (1.5, 0.1), (1.5, 0.2), (1.7, 0.2), (1.7, 0.1), (3, 0.1)], (1.0, 1.7)),
        ([(-1, 0), (1, 0), (2, -0.5), (4, -0.5)], (1.0, 2.0)),
    ],
)
def test_where_the_ground_is_uneven(points, span):
    assert uneven_span(Profile.of_points(points)) == pytest.approx(span, abs=1e-12)


def test_where_the_flight_begins_and_ends():
    assert flights_span(PROFILE, False) == pytest.approx((0.0, 2.2))
    # going down it ends at the foot of the last riser
    assert flights_span(PROFILE.reflected(), True) == pytest.approx((-2.2, 0.0))
    sloped = Profile.of_points([(-2, 0), (-0.02, 0), *POINTS[2:]])  # the riser leans
    assert flights_span(sloped.reflected(), True) == pytest.approx((-2.2, 0.0))
    rough = Profile.of_points([(-2, 0), (-0.5, 0), (-0.4, 0.002), (-0.3, 0), *POINTS[1:]])
    assert rough.roughness == pytest.approx(0.002)  # a bump of that height is no riser
    assert flights_span(rough.reflected(), True) == pytest.approx((-2.2, 0.0))
    exact = replace(rough, roughness=0.0)
    assert flights_span(exact.reflected(), True) == pytest.approx((-2.2, 0.4))
    falls = Profile.of_points([(-2, -0.05), (-1, 0), *POINTS[1:]])
    falls = replace(falls, nosings=PROFILE.nosings, roughness=0.0)
    assert flights_span(falls.reflected(), True) == pytest.approx((-2.2, 1.0))
    level = Profile.of_points([(0, 0), (2, 0)])
    assert flights_span(level, False) == flights_span(level, True) == (0.0, 0.0)


def test_where_the_front_stands_of_a_robot_that_lands():
    on, up = 1e-6, math.inf
    assert landing_zones(PROFILE, False, ROOM) == (
        pytest.approx((2.2 + on, up, -up, up)), pytest.approx((2.2 - on, up, 0.6 - on, 0.6 + on)),
        pytest.approx((0.6 - on, 1.6 - on, -up, 0.4 - on)),
    )  # fmt: skip


def test_a_landing_has_no_top_at_its_end():
    """On the next riser, as high as the next nosing, or at the next edge going down: exactly."""
    (*_, (_, x, _, z)) = top_zones(PROFILE, False, ROOM)
    assert np.nextafter([x, z], 9.0).tolist() == [1.6 - 1e-6, 0.4 - 1e-6]
    down = PROFILE.reflected()
    (*_, (_, x, _, z)) = top_zones(down, True, ROOM)
    assert x == -0.6 + 1e-6
    assert np.nextafter(z, 9.0) == 0.4 - 1e-6
    assert top_zones(Profile.of_points([(0, 0), (2, 0)]), False, ROOM) == ()


def test_one_nosing_has_a_top():
    kerb = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])
    path, _ = driven([((-0.6, 0), (-0.1, 0)), ((-0.4, 0), (0, 0.1)), ((0, 0.1), (0.5, 0.1))], False)
    assert over_the_top(path, kerb, False) == [False, True, True]


def test_steps_from_the_bottom():
    places = (-1.0, 0.1, 0.7, 1.7, 3.0)
    assert [step_at(PROFILE, x, False) for x in places] == [0, 1, 3, 4, 6]
    # going down the first nosing passed is the uppermost
    down = PROFILE.reflected()
    assert [step_at(down, -x, True) for x in (3.0, 2.1, 0.5, 0.2, -1.0)] == [0, 6, 3, 2, 1]
