"""Gaps of single features against outlines laid out by hand: point, normal, distance."""

import itertools
import math

import numpy as np
import pytest

from kaidan.contact import body_table, ground_table
from kaidan.contact.kernel.gaps import gap, on_flat, relabelled
from kaidan.contact.kernel.nearest_feature import first_index, height_of_ground, nearest
from kaidan.contact.kernel.settling import lever, touching
from kaidan.contact.layout import PART, POINT, At
from kernel_memory import posed, scene

ROUNDING = 1e-12  # m: coordinates of some metres
PARTS = [
    [-0.3, 0.02, 0.08, 0.2, -0.01, 0.05],
    [-0.2, 0.00, 0.04, 0.3, 0.03, 0.09],
    [0.25, -0.02, 0.03, -0.3, 0.05, 0.07],  # the second disc lies behind the first
    [0.10, 0.10, 0.06, 0.12, -0.2, 0.02],  # hangs down
]


def rotated(phi):
    return np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])


def outline(part, at):
    """Point of the lower outline of a part and its outward normal, in the body frame.

    ``at`` from 0 to 1 along the lower common tangent; below 0 and above 1 an angle [rad] on from
    its ends around the discs.
    """
    x1, z1, r1, x2, z2, r2 = part
    c1, c2 = np.array([x1, z1]), np.array([x2, z2])
    e = (c2 - c1) / np.linalg.norm(c2 - c1)
    down = np.array([e[1], -e[0]]) * (1 if x2 >= x1 else -1)
    sine = (r1 - r2) / np.linalg.norm(c2 - c1)
    n = sine * e + math.sqrt(1 - sine**2) * down
    if 0 <= at <= 1:
        return (1 - at) * (c1 + r1 * n) + at * (c2 + r2 * n), n
    centre, radius, angle, away = (c1, r1, -at, -e) if at < 0 else (c2, r2, at - 1, e)
    across = away - (away @ n) * n
    n = math.cos(angle) * n + math.sin(angle) * across / np.linalg.norm(across)
    return centre + radius * n, n


def third(part):
    """Body whose third part is looked at: its features carry THIRD."""
    return body_table([PARTS[3], PARTS[1], part])


THIRD = 2 * PART


def vertex_at(place):
    """Ground with one convex vertex, a spike, at a place: its feature is vertex 2."""
    x, z = place
    return ground_table([(x - 2, z - 1), (x, z), (x + 2, z - 1)])


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("at", [-2.6, -1.2, -0.4, 0.0, 0.3, 0.9, 1.0, 1.5, 2.3, 3.5])
def test_vertex_at_a_known_distance_from_the_outline(part, at):
    body, (x, z), (point, n) = third(part), (1.3, 0.7), outline(part, at)
    for distance, phi in itertools.product([-0.004, 0.0, 0.03], [0.0, 0.5, -0.9]):
        turn = rotated(phi)
        vertex = np.array([x, z]) + turn @ (point + distance * n)
        if (turn @ n)[1] > -0.1 and distance < 0:
            continue  # the ground reaches down from a vertex: from above it is no penetration
        ground = vertex_at(vertex)
        (k,) = np.flatnonzero(ground["convex"])
        feature = POINT * k + THIRD
        found = gap(scene(ground, body), feature, posed(x, z, phi))
        assert found == pytest.approx((distance, *(-turn @ n), *vertex), abs=ROUNDING)
        delta = lever(scene(ground, body), feature, posed(x, z, phi), 0.3)
        # hand: ahead of the gravity line, which leans by 0.3 of the height
        assert delta == pytest.approx(vertex[0] - x + 0.3 * (z - vertex[1]), abs=ROUNDING)


THIN = [-0.25, 0.0, 0.002, 0.25, 0.0, 0.002]


@pytest.mark.parametrize(
    ("place", "distance"),
    [  # by hand: up to 10 mm inside a part thinner than that, a vertex has gone through it ...
        ((0.1, 0.004), -0.006),
        ((0.1, 0.0079), -0.0099),
        ((0.1, 0.0081), 0.0061),  # ... farther it is above
        ((0.251, 0.004), math.hypot(0.001, 0.004) - 0.002),  # over the round of the disc
        ((0.253, 0.004), 0.003),  # ahead of the nose, or behind the tail: above. 3-4-5
        ((-0.253, 0.004), 0.003),
        ((0.252, 0.0), 0.0),
        ((0.1, -0.004), 0.002),
    ],
)
@pytest.mark.parametrize("flipped", [False, True])
def test_vertex_above_a_thin_part(place, distance, flipped):
    part = [-THIN[0], *THIN[1:3], -THIN[3], *THIN[4:]] if flipped else THIN
    ground, body = vertex_at(place), third(part)
    (k,) = np.flatnonzero(ground["convex"])
    found, n_x, n_z, *_ = gap(scene(ground, body), POINT * k + THIRD, At(0.0, 0.0, 1.0, 0.0))
    assert found == pytest.approx(distance, abs=ROUNDING)
    # the normal points from the ground into the robot: away from it the vertex is farther off
    away = vertex_at((place[0] - 1e-4 * n_x, place[1] - 1e-4 * n_z))
    farther, *_ = gap(scene(away, body), POINT * k + THIRD, At(0.0, 0.0, 1.0, 0.0))
    assert farther == pytest.approx(found + 1e-4, abs=ROUNDING)


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("lean", [0.0, 0.4])
@pytest.mark.parametrize(("x", "beside"), [(0.1229, True), (0.1221, False)])
def test_vertex_beside_a_thin_part_that_hangs_down(x, beside, lean, mirrored, swapped):
    """By hand: it reaches as far as 0.1225 m; a vertex up to there has gone through it."""
    sign, z, (at_x, at_z) = -1.0 if mirrored else 1.0, -0.15, (1.3, 0.7)
    phi = -sign * lean  # of the body, in which the part looks down on its other side
    c_1, c_2, r_1, r_2 = np.array([0.1, 0.1]), np.array([0.12, -0.2]), 0.002, 0.0025
    vertex = np.array([x, z])
    e = (c_2 - c_1) / np.linalg.norm(c_2 - c_1)
    along, off = (vertex - c_1) @ e, np.array([-e[1], e[0]]) @ (vertex - c_1)
    sine = (r_1 - r_2) / np.linalg.norm(c_2 - c_1)
    expected = along * sine - r_1 + (off if beside else -off) * math.sqrt(1 - sine**2)
    flip = np.array([sign, 1.0])
    discs = [[*(rotated(-phi) @ (flip * c_1)), r_1], [*(rotated(-phi) @ (flip * c_2)), r_2]]
    body_frame = [*discs[1], *discs[0]] if swapped else [*discs[0], *discs[1]]
    ground = vertex_at((at_x, at_z) + flip * vertex)
    (k,) = np.flatnonzero(ground["convex"])
    found, *_ = gap(scene(ground, third(body_frame)), POINT * k + THIRD, posed(at_x, at_z, phi))
    assert found == pytest.approx(expected, abs=ROUNDING)


def test_a_part_counts_as_thin_by_its_smaller_radius():
    # by hand: 4 mm above the axis of a part of 2 and 30 mm, where it is 3 mm thick: gone through it
    ground = vertex_at((-0.24, 0.004))
    (k,) = np.flatnonzero(ground["convex"])
    body = third([-0.25, 0.0, 0.002, 0.25, 0.0, 0.03])
    assert gap(scene(ground, body), POINT * k + THIRD, At(0.0, 0.0, 1.0, 0.0))[0] < 0.0


def test_parts_whose_second_disc_lies_behind_look_down_on_the_other_side():
    assert body_table(PARTS)["side"].tolist() == [1.0, 1.0, -1.0, 1.0]


@pytest.mark.parametrize("disc", [0, 1])
@pytest.mark.parametrize("slope", [0.0, 0.6, -0.4])
def test_disc_above_a_segment(disc, slope):
    # hand: a centre 0.3 along the segment and radius + 0.02 above it
    part, phi = [-0.3, 0.02, 0.08, 0.2, -0.01, 0.05], 0.4
    body = third(part)
    ground = ground_table([(-2, -1), (0, 1), (1, 1 + slope), (3, 9)])
    u = np.array([1.0, slope]) / math.hypot(1.0, slope)
    m = np.array([-u[1], u[0]])
    radius, own = part[3 * disc + 2], np.array(part[3 * disc : 3 * disc + 2])
    foot = np.array([0.0, 1.0]) + 0.3 * u
    x, z = foot + (radius + 0.02) * m - rotated(phi) @ own
    k = int(np.flatnonzero(ground["x"] == 0.0)[0])
    feature = POINT * k + THIRD + disc + 1
    found = gap(scene(ground, body), feature, posed(x, z, phi))
    assert found == pytest.approx((0.02, *m, *foot), abs=ROUNDING)


# --- one contact, two names ---------------------------------------------------------------------

WHEEL = [-0.25, 0.0625, 0.125, 0.25, 0.0625, 0.125]
"""In binary fractions: places are met exactly."""
PLATEAU = [(-1.5, -0.5), (0.5, 0.5), (1.5, 0.5), (3.5, -0.5)]
"""Two convex vertices: up, level, down."""


def unit(ground, k):
    """Unit vector along a segment."""
    return np.array([ground["u_x"][k], ground["u_z"][k]])


def label(feature, foot, z=0.5625, turn=0.0):
    """Label of the third part's feature; as of a first part. The plateau is 1 m long from 0 on."""
    ground = ground_table(np.array(PLATEAU) @ rotated(turn).T)
    x, z = rotated(turn) @ (0.5 + foot, z)
    where = (x, z, math.cos(turn), math.sin(turn))
    return relabelled(scene(ground, third(WHEEL)), feature + THIRD, At(*where)) - THIRD


@pytest.mark.parametrize("disc", [1, 2])
def test_label_of_a_disc_that_leaves_its_segment(disc):
    ground = ground_table(PLATEAU)
    left, right = np.flatnonzero(ground["convex"])
    offset = 0.25 if disc == 1 else -0.25  # centroid less disc
    on_plateau = POINT * left + disc
    # on the segment, both ends included; beyond them the vertex
    for foot in (0.0, 0.5, 1.0):
        assert label(on_plateau, foot + offset) == on_plateau
    assert label(on_plateau, -0.01 + offset) == POINT * left
    assert label(on_plateau, 1.01 + offset) == POINT * right
    # and back: over a segment, over neither (the vertex is then the nearest of its ground)
    behind = disc == 1  # the arc of the first disc meets what lies behind its centre
    over = {
        (left, 0.01): on_plateau if behind else None,
        (right, 0.99): None if behind else on_plateau,
        (left, -0.3): None if behind else POINT * (left - 1) + disc,
        (right, 1.3): POINT * right + disc if behind else None,
        (left, 0.0): None,
        (right, 1.0): None,
        (right, 1.05): None,
        (left, -0.05): None,
    }
    for (vertex, foot), expected in over.items():
        stays = POINT * vertex
        assert label(stays, foot + offset) == (stays if expected is None else expected)


@pytest.mark.parametrize("disc", [1, 2])
@pytest.mark.parametrize("turn", [0.4, -0.3])
def test_labels_do_not_depend_on_the_slope_of_it_all(disc, turn):
    """Robot and ground turned together: as on the level."""
    left, right = np.flatnonzero(ground_table(PLATEAU)["convex"])
    features = (POINT * left + disc, POINT * left, POINT * right, POINT * (left - 1) + disc)
    offset = 0.25 if disc == 1 else -0.25  # centroid less disc
    for feature in features:
        for foot in (-0.35, -0.05, -0.002, 0.002, 0.47, 0.998, 1.002, 1.05, 1.35):
            assert label(feature, foot + offset, turn=turn) == label(feature, foot + offset)


@pytest.mark.parametrize("disc", [1, 2])
@pytest.mark.parametrize("phi", [0.5, -0.7])
def test_label_of_an_inclined_disc(disc, phi):
    ground, part = ground_table(PLATEAU), [-0.25, 0.03, 0.1, 0.2, -0.04, 0.08]
    left, right = np.flatnonzero(ground["convex"])
    x, z = -(rotated(phi) @ part[3 * disc - 3 : 3 * disc - 1])  # puts the disc over the origin

    def after(feature, foot):
        where = (0.5 + foot + x, 0.6 + z, math.cos(phi), math.sin(phi))
        return relabelled(scene(ground, third(part)), feature, At(*where))

    on_plateau = POINT * left + THIRD + disc
    assert [after(on_plateau, foot) for foot in (-0.001, 0.001, 0.999, 1.001)] == [
        POINT * left + THIRD, on_plateau, on_plateau, POINT * right + THIRD,
    ]  # fmt: skip


def test_label_of_a_vertex_under_the_flat_stays():
    (left, _) = np.flatnonzero(ground_table(PLATEAU)["convex"])
    for foot in (-0.2, 0.0, 0.2):
        assert label(POINT * left, -foot) == POINT * left


def test_label_of_a_disc_in_a_corner_stays():
    ground = ground_table([(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)])  # a valley: no convex vertex
    assert not ground["convex"].any()
    body = third(WHEEL)
    for feature in (POINT * 0 + THIRD + 1, POINT * 1 + THIRD + 2):
        assert relabelled(scene(ground, body), feature, At(0.0, 0.5, 1.0, 0.0)) == feature


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("phi", [0.0, 0.5, -0.4])
def test_label_of_a_vertex_around_a_tapered_part(part, phi):
    """On the flat it stays, below and above; on an arc it is the segment's if the disc is over it.

    The spike falls on both sides: a centre behind the vertex is over the segment that begins in
    it or before it, by the side on which it lies.
    """
    body, turn = third(part), rotated(phi)
    axis = np.array([part[3] - part[0], part[4] - part[1]]) / math.dist(part[:2], part[3:5])
    for at in (-0.5, -0.02, 0.002, 0.5, 0.998, 1.02, 1.5):
        point, n = outline(part, at)
        above = np.array(part[:2]) + point - part[:2]
        above = 2 * ((above - part[:2]) @ axis) * axis + 2 * np.array(part[:2]) - above
        for place in (point + 0.01 * n, above):
            vertex = turn @ place
            ground = vertex_at(vertex + np.array([1.3, 0.7]))
            (k,) = np.flatnonzero(ground["convex"])
            stays = POINT * k + THIRD
            found = relabelled(scene(ground, body), stays, posed(1.3, 0.7, phi))
            if 0 < at < 1:
                assert found == stays
                continue
            disc = 1 if at < 0 else 2
            to = turn @ np.array(part[3 * disc - 3 : 3 * disc - 1]) - vertex
            if to @ unit(ground, k) > 0:
                assert found == stays + disc
            elif to @ unit(ground, k - 1) < 0:
                assert found == stays - POINT + disc
            else:
                assert found == stays


@pytest.mark.parametrize(
    ("x", "under"), [(-0.25, True), (0.0, True), (0.25, True), (-0.26, False), (0.26, False)]
)
def test_under_the_flat_both_ends_included(x, under):
    ground, body = vertex_at((1.5, 0.5)), third(WHEEL)
    (k,) = np.flatnonzero(ground["convex"])
    assert body["flat"][2] == 0.5
    assert on_flat(scene(ground, body), POINT * k + THIRD, At(1.5 + x, 0.5625, 1.0, 0.0)) is under
    assert not on_flat(scene(ground, body), POINT * k + THIRD + 1, At(1.5, 0.5625, 1.0, 0.0))


@pytest.mark.parametrize("part", PARTS)
@pytest.mark.parametrize("phi", [0.0, 0.7, -0.5])
def test_under_a_tapered_flat(part, phi):
    body, turn = third(part), rotated(phi)
    for at in (-0.3, -0.02, 0.002, 0.5, 0.998, 1.02, 1.3):
        point, n = outline(part, at)
        ground = vertex_at(turn @ (point + 0.01 * n) + (1.3, 0.7))
        (k,) = np.flatnonzero(ground["convex"])
        found = on_flat(scene(ground, body), POINT * k + THIRD, posed(1.3, 0.7, phi))
        assert found is (0 < at < 1)


# --- the nearest of all -------------------------------------------------------------------------

STEPS = [(-3, 0), (0, 0), (0, 0.15), (0.3, 0.15), (0.3, 0.3), (0.7, 0.2), (1.0, 0.4), (4, 0.4)]


def test_height_of_the_ground():
    ground = ground_table(STEPS)
    # hand: on treads and slopes; at a riser the upper end; beyond the ends level
    at = {-5.0: 0.0, -1.0: 0.0, 0.0: 0.15, 0.1: 0.15, 0.3: 0.3, 0.5: 0.25, 0.85: 0.3, 9.0: 0.4}
    for x, z in at.items():
        assert height_of_ground(scene(ground, body_table(PARTS)).ground, x) == pytest.approx(
            z, abs=ROUNDING
        )


def test_index_of_the_last_point_left_of_a_place_from_any_hint():
    ground = ground_table(STEPS)
    for x in (-40.0, -1.0, 0.0, 0.1, 0.3, 0.5, 1.0, 9.0, 99.0):
        left = np.flatnonzero(ground["x"] < x)
        expected = min(max([0, *left]), len(ground) - 2)
        for hint in (-3, 0, 4, len(ground) + 5):
            assert first_index(scene(ground, body_table(PARTS), hint), x) == expected


def test_index_among_many_points_some_above_one_another():
    rng = np.random.default_rng(0)
    x = np.round(np.sort(rng.uniform(0, 3, 400)), 2)
    ground = ground_table(np.stack([x, rng.uniform(0, 1, 400)], 1))
    for place in rng.choice(np.arange(-0.1, 3.1, 0.005), 200):
        left = np.flatnonzero(ground["x"] < place)
        expected = min(max([0, *left]), len(ground) - 2)
        for hint in rng.integers(-2, len(ground) + 3, 8):
            assert (
                first_index(scene(ground, body_table(PARTS), int(hint)), float(place)) == expected
            )


def every_gap(ground, body, x, z, c, s):
    """Gaps of all features that exist: convex vertices, and discs over their segments.

    Deeper than 20 mm lies the far side of the ground, which is met by nothing.
    """
    for part in range(len(body)):
        for k in range(len(ground) - 1):
            vertex = POINT * k + PART * part
            if ground["convex"][k]:
                yield vertex, gap(scene(ground, body), vertex, At(x, z, c, s))[0]
            for disc in (1, 2):
                found, _, _, p_x, p_z = gap(scene(ground, body), vertex + disc, At(x, z, c, s))
                u, start = unit(ground, k), np.array([ground["x"][k], ground["z"][k]])
                if 0 <= ((p_x, p_z) - start) @ u <= ground["length"][k] and found > -0.02:
                    yield vertex + disc, found


@pytest.mark.parametrize("parts", [PARTS[:3], [THIN, *PARTS[1:3]], [PARTS[3], THIN]])
@pytest.mark.parametrize("seed", range(15))
def test_the_nearest_is_the_smallest_of_all_gaps(seed, parts):
    rng = np.random.default_rng(seed)
    ground, body = ground_table(STEPS), body_table(parts)
    x, phi = rng.uniform(-0.8, 1.2), rng.uniform(-0.6, 0.6)
    c, s = math.cos(phi), math.sin(phi)
    z, touched = touching(scene(ground, body), x, c, s)
    for lift, reach in ((0.0, 0.5), (rng.uniform(0, 0.2), 0.5), (-0.004, 0.5), (0.002, 0.01)):
        gaps = dict(every_gap(ground, body, x, z + lift, c, s))
        first, second = sorted(gaps, key=gaps.get)[:2]
        for skip in ((-1, -1), (first, -1), (-1, first), (first, second)):
            left = {key: value for key, value in gaps.items() if key not in skip}
            which, found = nearest(scene(ground, body, 3), At(x, z + lift, c, s), *skip, reach)
            if min(left.values()) > reach:
                assert (which, found) == (-1, 1e9)
                continue
            assert found == pytest.approx(min(left.values()), abs=ROUNDING)
            assert left[which] == pytest.approx(found, abs=ROUNDING)
            which, found = nearest(scene(ground, body), At(x, z + lift, c, s), *skip, found - 1e-9)
            assert (which, found) == (-1, 1e9)
    # let down at a fixed inclination, it rests on one feature and sinks into none
    assert gap(scene(ground, body), touched, At(x, z, c, s))[0] == pytest.approx(0.0, abs=ROUNDING)
    assert min(dict(every_gap(ground, body, x, z, c, s)).values()) > -ROUNDING
