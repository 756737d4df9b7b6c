"""Margins of single poses against the definitions, written out in complex numbers.

::

        C
       /|\\          u against effective gravity, e ahead of it, across
    r o | o f       back = (C - r) e, front = (f - C) e, rises |C - r| - (C - r) u
"""

import cmath
import math
from dataclasses import astuple
from itertools import combinations

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.contact import body_table, ground_table
from kaidan.contact.codes import BELLY, TRACK
from kaidan.contact.door import table_of, zeros
from kaidan.contact.kernel.forces import two_contact_forces
from kaidan.contact.kernel.margins import (
    forces_over_one,
    lasting,
    margins_at,
    margins_without,
    pose_margins,
)
from kaidan.contact.layout import (
    DISC_2,
    NO_FEATURE,
    POINT,
    Margin,
    Outer,
    Press,
    Pull,
    Touch,
    Touching,
)
from kaidan.contact.layout import Pose as Placed
from kaidan.models.quasi_static import traverse_of
from kaidan.robot import Track
from kernel_memory import nothing, numbers, scene, table

GRAVITY = 9.7
EXACT = 1e-12
"""m, rad, N/kg: rounding alone."""


def dot(one, other):
    return (one * other.conjugate()).real


class Pose:
    """A centroid, two contacts that are followed, some that are found: feature, point, normal."""

    def __init__(self, c, rear, front, found=(), psi=0.0):
        self.c, self.rear, self.front, self.found, self.psi = c, rear, front, found, psi

    def margins(self, acceleration=0.0, kinds=()):
        pose = Placed(
            math.nan, self.c.real, self.c.imag, math.nan, touch(*self.rear), touch(*self.front),
            self.psi, 0, math.nan,
        )  # fmt: skip
        found = [
            Touching(feature, p.real, p.imag, n.real, n.imag, 0.0, kinds[k] if kinds else TRACK)
            for k, (feature, p, n) in enumerate(self.found)
        ]
        margin = table(Margin, nothing(Margin, 1))[0]
        margins_at(pose, Pull(acceleration, GRAVITY), found, margin)
        return margin


def touch(feature, p, n):
    return Touch(feature, p.real, p.imag, n.real, n.imag)


def expected(pose, acceleration):
    """Fields of the margins, by definition."""
    w = GRAVITY * 1j + acceleration * cmath.exp(1j * pose.psi)
    u = w / abs(w)
    e = -1j * u
    r, f = pose.rear, pose.front
    for each in pose.found if len(pose.found) > 2 else ():
        ahead = dot(each[1] - pose.c, e)
        if ahead > dot(f[1] - pose.c, e):
            f = each
        elif ahead < dot(r[1] - pose.c, e):
            r = each
    back, front = dot(pose.c - r[1], e), dot(f[1] - pose.c, e)
    rises = [abs(pose.c - p) - dot(pose.c - p, u) for p in (r[1], f[1])]
    angles = [
        math.atan2(d, dot(pose.c - p, u)) * abs(d) * abs(w)
        for d, p in ((back, r[1]), (front, f[1]))
    ]
    every = [pose.rear, pose.front, *(pose.found if len(pose.found) > 2 else ())]
    best = least(pose, pose.rear, pose.front, w)
    for one, other in combinations(pose.found if len(pose.found) > 2 else (), 2):
        pair = sorted((one, other), key=lambda each: dot(each[1], e))
        best = min(best, least(pose, *pair, w), key=lambda each: each[0])
    if min(back, front) < 0.0:  # it turns about the outer contact, which bears all of the load
        normal = (f if front < back else r)[2]
        load, traction = dot(w, normal), dot(w, -1j * normal)
        needed = abs(traction) / load if load > 0.0 else math.inf
        loads = [load, traction, 0.0, 0.0]
        best = (needed, *(loads[2:] + loads[:2] if front < back else loads))
    return {
        "required_friction": best[0], "rear_load": best[1], "rear_traction": best[2],
        "front_load": best[3], "front_traction": best[4],
        "traction": GRAVITY * math.sin(pose.psi) + acceleration, "back": back, "front": front,
        "back_rise": math.copysign(rises[0], back), "front_rise": math.copysign(rises[1], front),
        "force_angle": min(angles),
        "zmp": back / (back + front) if back + front > 0.0 else math.nan,
        "contacts": max(len(pose.found), 2), "belly_touches": False,
        "steepest_face": max(math.atan2(abs(n.real), n.imag) for _, _, n in every),
        "tilt": w.real / w.imag, "outer_rear": r[0], "outer_front": f[0], "bounded": False,
        "without": NO_FEATURE,
    }  # fmt: skip


def least(pose, one, other, w):
    """Friction and forces of two contacts; test_forces has their definition."""
    pair = (Press(p.real, p.imag, n.real, n.imag) for _, p, n in (one, other))
    return two_contact_forces(*pair, pose.c.real, pose.c.imag, w.real, w.imag)


PLANES = ("none", "all", "of the two that are followed", "of all but the front one")
"""Of which contacts the normals are parallel."""


def random_pose(rng, many, plane):
    """Contacts below a centroid, in no order; in one plane the load lies between the followed."""
    tilt = rng.uniform(-0.6, 0.6)

    def contact(feature, low, high, *, like):
        p, lean = complex(rng.uniform(low, high), rng.uniform(1.4, 1.6)), rng.uniform(-0.9, 0.9)
        if like:
            p, lean = complex(p.real, 1.5 + (p.real - 2.5) * math.tan(tilt)), tilt
        return feature, p, 1j * cmath.exp(1j * lean)

    rear = contact(64, 2.0, 2.2, like=plane != PLANES[0])
    front = contact(128, 2.8, 3.0, like=plane in PLANES[1:3])
    like = plane in (PLANES[1], PLANES[3])
    others = [contact(192 + 64 * k, 1.7, 3.3, like=like) for k in range(many - 2)]
    found = [rear, *others, front] if many else []
    rng.shuffle(found)
    c = complex(2.5 + rng.uniform(-0.7, 0.7), 1.9) if plane == PLANES[0] else complex(2.5, 1.6)
    return Pose(c, rear, front, found, rng.uniform(-0.6, 0.6))


@pytest.mark.parametrize("acceleration", [0.0, 1.0, -1.5])
@pytest.mark.parametrize("many", [0, 2, 3, 4, 6])
@pytest.mark.parametrize("plane", PLANES)
def test_margins_by_definition(plane, many, acceleration):
    rng = np.random.default_rng(many)
    for _ in range(12):
        pose = random_pose(rng, many, plane)
        found = pose.margins(acceleration)
        for name, value in expected(pose, acceleration).items():
            told = getattr(found, name)
            assert told == pytest.approx(value, abs=1e-9, nan_ok=True), name  # rounding
        assert np.isnan([found.energy, found.energy_side]).all()


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 2, 0)])
def test_on_level_ground_and_against_a_face_two_contacts_need_no_friction(order):
    """By hand: the rear one and the middle one carry it, by their levers; a face needs not push."""
    rear, middle, front = (64, 0j, 1j), (128, 1 + 0j, 1j), (192, 1.5 + 0.1j, -1 + 0j)
    contacts = [rear, middle, front]
    found = Pose(0.25 + 0.3j, rear, front, [contacts[k] for k in order]).margins()
    forces = [found.required_friction, found.rear_load, found.rear_traction, found.front_load,
              found.front_traction]  # fmt: skip
    assert forces == pytest.approx([0.0, 0.75 * GRAVITY, 0.0, 0.25 * GRAVITY, 0.0], abs=EXACT)


def test_the_outermost_contact_is_known_by_its_place():
    """Others that lie above it, or beside it, are no outer contacts."""
    rear, front = (64, 0j, 1j), (128, 1 + 0j, 1j)
    others = [(192 + 64 * k, p, 1j) for k, p in enumerate((0.1j, 1 + 0.1j, 0.5 + 0j))]
    found = Pose(0.4 + 0.3j, rear, front, [rear, front, *others]).margins()
    assert (found.outer_rear, found.outer_front) == (64, 128)


def test_two_that_are_found_beside_two_that_are_followed_count_for_nothing():
    rear, front = (64, 0j, 1j), (128, 1 + 0j, 1j)
    others = [(192, -1 + 0j, cmath.exp(2j)), (256, 2 + 0j, cmath.exp(1j))]
    c = 0.5 + 0.3j
    alone = Pose(c, rear, front).margins()
    found = Pose(c, rear, front, others).margins()
    np.testing.assert_array_equal(astuple(found), astuple(alone))


@pytest.mark.parametrize("belly", [0, 1, 2])
def test_a_belly_that_touches_is_flagged(belly):
    contacts = [(64, 0j, 1j), (128, 0.5 + 0j, 1j), (192, 1 + 0j, 1j)]
    kinds = [BELLY if k == belly else TRACK for k in range(3)]
    pose = Pose(0.6 + 0.3j, contacts[0], contacts[2], contacts)
    assert pose.margins(kinds=kinds).belly_touches
    assert not pose.margins().belly_touches


@pytest.mark.parametrize("beyond", [-0.1, 1.1])
def test_beyond_a_contact_the_rise_is_negative(beyond):
    """The centroid behind the rear contact, or ahead of the front one: hand, in level gravity."""
    pose = Pose(complex(beyond, 0.3), (64, 0j, 1j), (128, 1 + 0j, 1j))
    found = pose.margins()
    back, front = beyond, 1.0 - beyond
    assert (found.back, found.front) == pytest.approx((back, front), abs=EXACT)
    rises = [math.copysign(math.hypot(d, 0.3) - 0.3, d) for d in (back, front)]
    assert [found.back_rise, found.front_rise] == pytest.approx(rises, abs=EXACT)
    assert found.zmp == pytest.approx(back, abs=EXACT)


def test_contacts_in_the_wrong_order_have_no_point_of_zero_moment():
    assert math.isnan(Pose(0.5 + 0.3j, (64, 1 + 0j, 1j), (128, 0j, 1j)).margins().zmp)


HALF, ABOVE, RADIUS, SLOPE = 0.3, 0.1, 0.05, 0.4
PARTS = [[-HALF, RADIUS - ABOVE, RADIUS, HALF, RADIUS - ABOVE, RADIUS]]
ALONG = cmath.exp(1j * SLOPE)
EDGES = [(s - 1j * ABOVE) * ALONG for s in (-0.2, 0.05, 0.15)]
"""Of plates under the flat, from the centroid at 0."""
AHEAD = ((HALF + 1j * (RADIUS - ABOVE)) * ALONG).real + RADIUS
BEHIND = ((-HALF + 1j * (RADIUS - ABOVE)) * ALONG).real - RADIUS
"""Faces that the discs touch."""


def stand(*, ahead, edges=(0, 2)):
    """Ground and body of a robot that lies on plates and touches a face, features of the edges."""
    line = [(-3, -2)] if ahead else [(-3, 2), (BEHIND, 2), (BEHIND, -2)]
    for k in edges:
        x, z = EDGES[k].real, EDGES[k].imag
        line += [(x, -2), (x, z), (x + 1e-3, -2)]
    line += [(AHEAD, -2), (AHEAD, 2), (3, 2)] if ahead else [(3, -2)]
    ground = ground_table(line)
    found = []
    for k in edges:
        apart = np.hypot(ground["x"] - EDGES[k].real, ground["z"] - EDGES[k].imag)
        found.append(POINT * int(np.argmin(apart)))
    return ground, body_table(PARTS), found


def called(function, ground, body, poses, *without):
    """Margins of poses that are worked out so."""
    margins = zeros(Margin, len(poses))
    filled = table(Margin, margins)
    of = scene(ground, body), table(Placed, poses), *without, Pull(0.0, GRAVITY)
    function(*of, filled)
    filled.flush()
    return margins


def rows_of(stood, places):
    """Poses that all stand there, at some arclengths."""
    _, _, edges = stood
    poses = zeros(Placed, len(places))
    n = 1j * ALONG
    poses["s"], poses["inclination"] = places, SLOPE
    for end, feature, p in (("rear", edges[0], EDGES[0]), ("front", edges[-1], EDGES[2])):
        poses[end] = (feature, p.real, p.imag, n.real, n.imag)
    return poses


ALL, FEW = 3, 2
"""With the contact at the face, and without it."""


@pytest.mark.parametrize("ahead", [True, False])
@pytest.mark.parametrize(
    ("places", "counts"),
    [
        ([0, 1, 2], [ALL, ALL, ALL]),
        ([0, 1, 1 + 5e-9, 2], [ALL, FEW, ALL, ALL]),
        ([1, 1 + 5e-9, 2, 2 + 5e-9], [FEW, ALL, FEW, ALL]),
        ([0, 1, 1 + 2e-8, 2], [ALL, ALL, ALL, ALL]),
        ([1, 1, 1], [FEW, ALL, ALL]),
        ([0, 1, 1], [ALL, FEW, ALL]),
    ],
)
def test_where_a_contact_is_exchanged_those_before_and_after_count(places, counts, ahead):
    """A face ahead is run into: before it the robot did not touch it. Of one behind in reverse."""
    stood = stand(ahead=ahead)
    if not ahead:
        places, counts = [-s for s in reversed(places)], counts[::-1]
    poses = rows_of(stood, places)
    margins = called(pose_margins, *stood[:2], poses)
    assert margins["contacts"].tolist() == counts
    # one more face makes the outermost contact another
    outer, own = ("front", EDGES[2].real) if ahead else ("back", -EDGES[0].real)
    face = AHEAD if ahead else -BEHIND
    far = [face if count == ALL else own for count in counts]
    assert margins[outer].tolist() == pytest.approx(far, abs=1e-9)  # m: within the touch


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (0, 2, 1)])
def test_contacts_that_stay_are_moved_to_the_head_as_they_are(order):
    ground, body, edges = stand(ahead=True)
    face = POINT * int(np.flatnonzero(np.isclose(ground["x"], AHEAD))[0]) + DISC_2
    features = [edges[0], edges[1], face]
    given = [(features[order[k]], *(6.0 * k + j for j in range(5)), 7 + k) for k in range(3)]
    pose = table(Placed, rows_of((ground, body, edges), [0.0]))[0]
    there = scene(ground, body)
    back = table(Touching, table_of(Touching, given))
    assert lasting(there, pose, -1.0, back) == 2
    kept = [(*given[k][:5], given[k][6]) for k in range(3) if order[k] != 2]
    assert [(*astuple(each)[:5], each.kind) for each in back[0:2]] == kept
    assert lasting(there, pose, 1.0, table(Touching, table_of(Touching, given))) == 3


@pytest.mark.parametrize("k", [0, 1, 2])
def test_margins_as_if_an_edge_were_not_there(k):
    """The edge between counts for nothing anyway; the others leave the margins to it."""
    ground, body, edges = stood = stand(ahead=True, edges=(0, 1, 2))
    ground = ground[ground["x"] < AHEAD - 1e-6]
    poses = rows_of(stood, [0.0, 1.0])
    points = [edges[k] // POINT, 0]
    margins = called(margins_without, ground, body, poses, numbers(points, int))
    assert margins["contacts"].tolist() == [2, 3]
    assert margins["without"].tolist() == points


def test_of_edges_on_one_level_one_alone_is_not_there():
    line = [(-3, -2)]
    for x in (-0.2, 0.0, 0.1, 0.2):
        line += [(x, -2), (x, -ABOVE), (x + 1e-3, -2)]
    ground, body = ground_table([*line, (3, -2)]), body_table(PARTS)
    edges = np.flatnonzero(ground["z"] == -ABOVE)
    poses = rows_of((ground, body, edges[[0, 3]] * POINT), [0.0])
    poses["inclination"] = 0.0
    for end, x in (("rear", -0.2), ("front", 0.2)):
        poses[end]["x"], poses[end]["z"] = x, -ABOVE
    (margin,) = called(margins_without, ground, body, poses, numbers(edges[[1]], int))
    assert margin["contacts"] == 3
    assert margin[["back", "front"]].item() == pytest.approx((0.2, 0.2), abs=EXACT)


def test_braking_down_over_nosings_that_differ_takes_the_friction_of_the_plane():
    """(g sin + a) / (g cos): the last pose before it rocks asks for no more than those before.

    The line of gravity there has passed the contact ahead by 0.1 mm, and no pair of contacts
    holds that but with a friction of 750.
    """
    robot = Robot(
        name="rocks", com_from_front=0.377, com_height=0.094,
        track=Track(flat_length=0.611, front_radius=0.118, rear_radius=0.123),
    )  # fmt: skip
    flight = Stairs(rises=(0.163, 0.162, 0.161, 0.161, 0.163), goings=(0.266, 0.265, 0.266, 0.265))
    asked = Question.in_one_posture(robot, flight, direction="down", acceleration=0.76)
    found = traverse_of(asked)
    (flown,) = (each for each in found.phases if each.phase == "traverse")
    theta = math.atan2(0.647, 1.062)
    plane = (9.80665 * math.sin(theta) + 0.76) / (9.80665 * math.cos(theta))
    assert plane == pytest.approx(0.70, abs=0.005)
    # a chord that differs by 1 mm in 310 mm, and the arc of the trailing end
    assert plane - 0.01 < flown.required_friction < plane + 0.03


@pytest.mark.parametrize("ahead", [True, False])
def test_forces_over_one_contact_are_those_along_its_own_normal(ahead):
    """Others at its height or under it do not count; half a newton a kilogram is a force."""
    rows = (0.1, 0.2, 0.6, 0.8), (0.1, 0.5, 0.0, 1.0), (0.7, 0.2, 0.0, 1.0)
    found = [Touching(0, *row, 0.0, TRACK) for row in rows]
    pose = table(Placed, 1)[0]
    # the one that counts is the outer contact at the side that is passed
    outer = Outer(*((0.1, -0.1) if ahead else (-0.1, 0.1)), 0.1, 0.2, 0.1, 0.2)
    mu, *forces = forces_over_one(pose, found, outer, 0.0, 0.5)
    normal, tangential = 0.4, -0.3
    assert mu == pytest.approx(0.75)
    on_one = (0.0, 0.0, normal, tangential) if ahead else (normal, tangential, 0.0, 0.0)
    assert forces == pytest.approx(on_one)
