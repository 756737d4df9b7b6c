"""Forces of two contacts and shares of many, by hand, by equilibrium and by trying inner forces."""

import math

import numpy as np
import pytest

from contact_cases import random_robot, steps
from kaidan.contact import body_table, ground_table
from kaidan.contact.door import zeros
from kaidan.contact.kernel import forces
from kaidan.contact.kernel.forces import cone_angle, two_contact_forces
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.settling import touching
from kaidan.contact.layout import PART, POINT, At, Press, Touching
from kernel_memory import called, scene

G = 10.0


contacts_at, shared_loads = called(forces.contacts_at), called(forces.shared_loads)


def held_by(*numbers):
    """Friction and forces of two contacts: point and normal of each, the centroid, the load."""
    return two_contact_forces(Press(*numbers[:4]), Press(*numbers[4:8]), *numbers[8:])


def test_friction_of_one_force():
    # by hand: tangential over normal; a pull has none, nothing at all needs none
    assert cone_angle(3.0, 4.0, G) == 0.75
    assert cone_angle(-3.0, 4.0, G) == 0.75
    assert cone_angle(0.0, 4.0, G) == 0.0
    assert cone_angle(1.0, 0.0, G) == math.inf
    assert cone_angle(0.0, -1.0, G) == math.inf
    assert cone_angle(0.0, 0.0, G) == 0.0
    # forces of less than 1e-7 of the weight are none
    assert cone_angle(0.5e-6, -0.5e-6, G) == 0.0
    assert cone_angle(2e-6, -2e-6, G) == math.inf
    assert cone_angle(0.5e-6, 0.0, G) == 0.0
    # a slope of less than 1e-14 of the weight is rounding
    assert cone_angle(5e-14, 4.0, G) == 0.0


def on_slope(angle, s):
    """Point so far up a slope, its normal."""
    return s * math.cos(angle), s * math.sin(angle), -math.sin(angle), math.cos(angle)


def test_one_plane_needs_its_slope_and_shares_by_the_lever():
    # by hand: 3-4-5 slope, contacts at 0 and 1 m, the resultant through 0.3 m up the slope
    angle = math.atan(0.75)
    x, z, *_ = on_slope(angle, 0.3)
    found = held_by(*on_slope(angle, 0.0), *on_slope(angle, 1.0), x, z + 0.2, 0.0, G)
    expected = (0.75, 0.7 * 8.0, 0.7 * 6.0, 0.3 * 8.0, 0.3 * 6.0)
    assert found == pytest.approx(expected, abs=1e-12)
    # the resultant beside both contacts: one of them would have to pull
    for beside in (-0.2, 1.2):
        x, z, *_ = on_slope(angle, beside)
        mu, *_ = held_by(*on_slope(angle, 0.0), *on_slope(angle, 1.0), x, z, 0.0, G)
        assert mu > 1.0 or mu == math.inf


def test_one_plane_under_a_leaning_weight():
    # hand: where the line through the centroid along the weight meets the plane shares it
    angle, start, w = math.atan(0.75), np.array([0.5, 0.7]), np.array([1.5, G])
    u, n = np.array([0.8, 0.6]), np.array([-0.6, 0.8])
    centroid = start + 0.4 * u + 0.25 * n
    meets = np.linalg.solve(np.stack([u, w], axis=1), centroid - start)[0] / 0.9
    assert 0 < meets < 1
    found = held_by(*start, *n, *(start + 0.9 * u), *n, *centroid, *w)
    normal, tangential = w @ n, w @ u
    expected = [tangential / normal]
    for share in (1 - meets, meets):
        expected += [share * normal, share * tangential]
    assert found == pytest.approx(expected, abs=1e-12)
    assert found[0] == pytest.approx(math.tan(angle + math.atan(0.15)), abs=1e-12)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_jammed_between_two_faces(sense):
    # by hand: only an ever growing inner force along the line of the contacts, 1 in 5, holds it
    walls = [(0.0, 0.0, 1.0, 0.0), (0.5, 0.1 * sense, -1.0, 0.0)]
    for first, second in (walls, walls[::-1]):
        mu, *forces = held_by(*first, *second, 0.25, 0.3, 0.0, G)
        assert mu == pytest.approx(0.2, abs=1e-12)
        assert all(map(math.isnan, forces))
    # a fin held from both sides is the same; two faces that look the same way hold nothing
    fin = [(0.0, 0.0, -1.0, 0.0), (0.5, 0.1 * sense, 1.0, 0.0)]
    assert held_by(*fin[0], *fin[1], 0.25, 0.3, 0.0, G)[0] == pytest.approx(0.2)
    same = [(0.0, 0.0, 1.0, 0.0), (0.0, 0.1 * sense, 1.0, 0.0)]
    assert held_by(*same[0], *same[1], 0.25, 0.3, 0.0, G)[0] == math.inf


def test_a_ladder_against_a_wall():
    # by hand: a rod of 1 m at 60 degrees, centroid half way up, floor and wall alike: it slips
    # where tan(60) = (1 - mu^2)/(2 mu), mu = tan(15 degrees)
    x, z = 0.5 * math.cos(math.pi / 3), 0.5 * math.sin(math.pi / 3)
    floor, wall = (0.0, 0.0, 0.0, 1.0), (2 * x, 2 * z, -1.0, 0.0)
    mu, n_1, t_1, n_2, t_2 = held_by(*floor, *wall, x, z, 0.0, G)
    assert mu == pytest.approx(math.tan(math.pi / 12), rel=1e-12)
    assert abs(t_1) / n_1 == pytest.approx(abs(t_2) / n_2, rel=1e-9)  # both are used up
    # forces: horizontal and vertical sums, moments about the foot
    assert t_1 - n_2 == pytest.approx(0.0, abs=1e-12)
    assert n_1 + t_2 == pytest.approx(G, abs=1e-12)


def test_no_friction_holds_a_ball_on_one_point():
    found = held_by(0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.1, 0.0, G)
    assert found[0] == math.inf
    assert all(map(math.isnan, found[1:]))


def test_a_wedge_without_friction():
    # by hand: a valley of 45 degrees both ways, the centroid over its bottom: normals alone carry
    s = math.sqrt(0.5)
    found = held_by(-1.0, 1.0, s, s, 1.0, 1.0, -s, s, 0.0, 1.5, 0.0, G)
    assert found == pytest.approx((0.0, G * s, 0.0, G * s, 0.0), abs=1e-9)


def held(points, normals, centroid, w, inner):
    """Normal and tangential forces of both contacts with inner forces along their line."""
    p_1, p_2 = points
    e = (p_2 - p_1) / np.linalg.norm(p_2 - p_1)
    across = np.array([-e[1], e[0]])
    arm = centroid - p_1
    on_2 = (arm[0] * w[1] - arm[1] * w[0]) / np.linalg.norm(p_2 - p_1)
    f_2 = on_2 * across + np.outer(w @ e - inner, e)
    f_1 = w - f_2
    return [(f @ n, f @ np.array([n[1], -n[0]])) for f, n in zip((f_1, f_2), normals, strict=True)]


@pytest.mark.parametrize("seed", range(150))
def test_least_friction_of_two_contacts(seed):
    """Oracle: inner forces tried on a fine grid; and the forces are in equilibrium."""
    rng = np.random.default_rng(seed)
    points = np.array([[-0.3, rng.uniform(-0.2, 0.2)], [0.3, rng.uniform(-0.2, 0.2)]])
    leans = rng.uniform(-1.4, 1.4, 2)
    normals = np.stack([np.sin(leans), np.cos(leans)], axis=1)
    centroid = np.array([rng.uniform(-0.25, 0.25), rng.uniform(0.1, 0.4)])
    w = np.array([rng.uniform(-2, 2), G])
    mu, *forces = held_by(*points[0], *normals[0], *points[1], *normals[1], *centroid, *w)
    grid = np.concatenate([-np.geomspace(1e4, 1e-4, 4000), [0.0], np.geomspace(1e-4, 1e4, 4000)])
    (n_1, t_1), (n_2, t_2) = held(points, normals, centroid, w, grid)
    holds = (n_1 > 0) & (n_2 > 0)
    if not holds.any():
        assert mu == math.inf or mu > 100
        return
    tried = np.maximum(np.abs(t_1) / n_1, np.abs(t_2) / n_2)[holds].min()
    assert mu <= tried + 1e-9
    assert mu == pytest.approx(tried, rel=2e-2, abs=2e-3)  # of the grid
    if not math.isnan(forces[0]):
        n_1, t_1, n_2, t_2 = forces
        assert mu == pytest.approx(max(abs(t_1) / n_1, abs(t_2) / n_2), rel=1e-9)
        tangents = np.stack([normals[:, 1], -normals[:, 0]], axis=1)
        each = [
            n * normal + t * tangent
            for (n, t), normal, tangent in zip(
                ((n_1, t_1), (n_2, t_2)), normals, tangents, strict=True
            )
        ]
        np.testing.assert_allclose(each[0] + each[1], w, atol=1e-9)
        arms = points - centroid
        moment = sum(a[0] * f[1] - a[1] * f[0] for a, f in zip(arms, each, strict=True))
        assert moment == pytest.approx(0.0, abs=1e-9)


def test_a_pull_of_less_than_a_share_of_the_weight_is_none():
    """The centroid beside the outer of two contacts on the level, by so much of their distance."""
    for beside, expected in ((0.5e-7, 0.0), (2e-7, math.inf)):
        mu, *_ = held_by(0, 0, 0, 1, 1, 0, 0, 1, -beside, 0.3, 0, G)
        assert mu == expected


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_face_and_the_floor_at_one_level(side, swapped):
    """By hand: a fifth of the weight hangs on the face, which the floor's friction presses."""
    face, floor = (0.0, 0.0, side, 0.0), (side, 0.0, 0.0, 1.0)
    both = (floor, face) if swapped else (face, floor)
    mu, *forces = held_by(*both[0], *both[1], 0.8 * side, 0.5, 0.0, G)
    assert mu == pytest.approx(0.5, rel=1e-12)
    expected = [(0.4 * G, -side * 0.2 * G), (0.8 * G, -side * 0.4 * G)]
    assert forces == pytest.approx(sum(expected[:: -1 if swapped else 1], ()), rel=1e-12)


def test_one_contact_above_the_other_needs_no_friction():
    """Whatever the share of either."""
    mu, n_1, t_1, n_2, t_2 = held_by(0, 0, 0, 1, 0, 1, 0, 1, 0, 0.5, 0, G)
    assert (mu, t_1, t_2, n_1 + n_2) == (0.0, 0.0, 0.0, G)


def test_the_friction_is_that_of_any_weight():
    rng = np.random.default_rng(3)
    for _ in range(50):
        points, leans = rng.uniform(-0.5, 0.5, (2, 2)), rng.uniform(-1.4, 1.4, 2)
        normals = np.stack([np.sin(leans), np.cos(leans)], axis=1)
        given = *points[0], *normals[0], *points[1], *normals[1], *rng.uniform(-0.3, 0.3, 2)
        light, heavy = (held_by(*given, 0.0, w)[0] for w in (1e-3, 10.0))
        assert light == pytest.approx(heavy, rel=1e-9)


def test_least_friction_where_directions_are_alike():
    """Normals and places of a few kinds, against inner forces on a grid: many roots coincide."""
    rng = np.random.default_rng(7)
    grid = np.concatenate([-np.geomspace(1e3, 1e-3, 300), [0.0], np.geomspace(1e-3, 1e3, 300)])
    holds = 0
    for _ in range(200):
        points = rng.integers(-2, 3, (2, 2)) / 4
        if (points[0] == points[1]).all():
            continue
        leans = rng.integers(-2, 3, 2) * math.pi / 4
        normals = np.round(np.stack([np.sin(leans), np.cos(leans)], axis=1), 15)
        centroid = rng.integers(-3, 4, 2) / 4
        mu, *_ = held_by(*points[0], *normals[0], *points[1], *normals[1], *centroid, 0.0, G)
        (n_1, t_1), (n_2, t_2) = held(points, normals, centroid, np.array([0.0, G]), grid)
        tried = [
            max(abs(t_1[i]) / n_1[i], abs(t_2[i]) / n_2[i])
            for i in np.flatnonzero((n_1 > 1e-9) & (n_2 > 1e-9))
        ]
        if tried:
            assert mu <= min(tried) + 1e-9
            holds += 1
    assert holds > 50


@pytest.mark.parametrize("lean", [0.9, 1.2])
def test_the_centroid_over_one_contact(lean):
    """By hand: the other's force runs along their line, here 0.4 from its normal.

    Loaded enough it needs tan(0.4), and the first less, which alone would need tan(lean).
    """
    line, off = 0.2, 0.4
    one, first = (0.0, 0.0), (math.sin(lean), math.cos(lean))
    other = (0.5 * math.cos(line), 0.5 * math.sin(line))
    second = (-math.cos(line + off), -math.sin(line + off))
    for pair in ((*one, *first, *other, *second), (*other, *second, *one, *first)):
        mu, *_ = held_by(*pair, 0.0, 0.3, 0.0, G)
        assert mu == pytest.approx(math.tan(off), abs=1e-12)


def table(*places):
    found = zeros(Touching, len(places))
    for row, (x, z) in enumerate(places):
        found["x"][row], found["z"][row] = x, z
    return found


def test_shares_of_equal_springs():
    # by hand: at -0.4, 0 and 0.2 m of the centroid: mean -1/15, 1/3 + mean (mean - x) / sum
    loads = np.zeros(8)
    places = np.array([-0.4, 0.0, 0.2])
    assert shared_loads(table(*((1.0 + x, 0.0) for x in places)), 1.0, 0.5, 0.0, G, loads) == 3
    mean = places.mean()
    expected = G * (1 / 3 - mean * (places - mean) / ((places - mean) ** 2).sum())
    np.testing.assert_allclose(loads[:3], expected, rtol=1e-12)
    assert loads[:3] @ places == pytest.approx(0.0, abs=1e-12)


def test_a_spring_that_would_pull_is_dropped():
    # by hand: the third is far from the centroid and would pull; the others share by the lever
    loads = np.zeros(8)
    count = shared_loads(table((0.0, 0), (0.1, 0), (1.0, 0)), 0.03, 0.5, 0.0, G, loads)
    assert count == 2
    np.testing.assert_allclose(loads[:3], [0.7 * G, 0.3 * G, 0.0], atol=1e-12)
    # gravity that leans: by kappa = 0.2 a height of 0.5 m counts as 0.1 m ahead
    count = shared_loads(table((0.0, 0), (0.2, 0)), 0.2, 0.5, 0.2, G, loads)
    np.testing.assert_allclose(loads[:2], [G / 2, G / 2], atol=1e-12)
    assert count == 2


def test_shares_of_one_place():
    # by hand: two contacts at one place of the gravity line carry half each
    loads = np.zeros(8)
    assert shared_loads(table((0.3, 0), (0.3, 0)), 0.3, 0.5, 0.0, G, loads) == 2
    np.testing.assert_allclose(loads[:2], [G / 2, G / 2], rtol=1e-12)
    assert shared_loads(table(), 0.0, 0.5, 0.0, G, loads) == 0
    assert shared_loads(table((0.3, 0)), 0.1, 0.5, 0.0, G, loads) == 1
    assert loads[0] == G


@pytest.mark.parametrize("seed", range(40))
def test_shares_against_springs_that_are_dropped_one_by_one(seed):
    """Oracle: the formula for those that are left, the one that pulls most dropped first."""
    rng = np.random.default_rng(seed)
    count, kappa = int(rng.integers(3, 8)), rng.uniform(-0.3, 0.3)
    places = rng.uniform(-0.5, 0.5, (count, 2))
    x, z = rng.uniform(-0.3, 0.3), 0.6
    arms = places[:, 0] - x + kappa * (z - places[:, 1])
    left = np.ones(count, bool)
    while True:
        mean = arms[left].mean()
        square = ((arms[left] - mean) ** 2).sum()
        shares = np.where(left, 1 / left.sum() - mean * (arms - mean) / square, 0.0)
        if left.sum() <= 2 or shares.min() >= 0:
            break
        left[shares.argmin()] = False
    loads = np.zeros(8)
    assert shared_loads(table(*places), x, z, kappa, G, loads) == left.sum()
    np.testing.assert_allclose(loads[:count], G * shares, atol=1e-12)


# --- what touches -------------------------------------------------------------------------------

ANGLE, SPACING = math.atan(0.75), 0.25  # 3-4-5: risers of 150 mm, goings of 200 mm
ROBOT = [[-0.4, -0.02, 0.08, 0.3, -0.02, 0.08], [-0.2, -0.1, 0.0, 0.1, -0.1, 0.0]]
"""A track with its flat from -0.4 to 0.3, 0.1 below the centroid, and a belly in its plane."""


def on_the_flight(back, lift=0.0):
    """Centroid that far behind the fifth nosing, the underside so far above the nosings."""
    u, n = np.array([0.8, 0.6]), np.array([-0.6, 0.8])
    return (0.0, 0.15) + 4 * SPACING * u - back * u + (0.1 + lift) * n


@pytest.mark.parametrize(
    ("back", "nosings"),
    [(0.0, [-0.25, 0.0, 0.25]), (0.12, [-0.38, -0.13, 0.12]), (-0.1, [-0.35, -0.1, 0.15])],
)
def test_contacts_of_a_robot_on_a_flight(back, nosings):
    ground = ground_table(steps(0.15, 0.2, 9))
    body = body_table(ROBOT, [0, 2])
    x, z = on_the_flight(back)
    found = zeros(Touching, 32)
    for _ in range(1):
        count = contacts_at((ground, body), x, z, ANGLE, 1e-9, found)
        u = np.array([0.8, 0.6])
        along = (found["x"][:count] - x) * u[0] + (found["z"][:count] - z) * u[1]
        assert sorted(along) == pytest.approx(nosings, abs=1e-12)
        np.testing.assert_allclose(found["n_x"][:count], -0.6, atol=1e-12)
        np.testing.assert_allclose(found["n_z"][:count], 0.8, atol=1e-12)
        np.testing.assert_allclose(found["gap"][:count], 0.0, atol=1e-12)
        assert (found["kind"][:count] == 0).all()  # the track's, not the belly's again
    # 1 mm above the nosings nothing touches within less, all within more
    x, z = on_the_flight(back, lift=1e-3)
    assert contacts_at((ground, body), x, z, ANGLE, 0.9e-3, found) == 0
    assert contacts_at((ground, body), x, z, ANGLE, 1.1e-3, found) == len(nosings)
    np.testing.assert_allclose(found["gap"][: len(nosings)], 1e-3, atol=1e-12)
    # and 1 mm below them
    x, z = on_the_flight(back, lift=-1e-3)
    assert contacts_at((ground, body), x, z, ANGLE, 0.9e-3, found) == 0
    assert contacts_at((ground, body), x, z, ANGLE, 1.1e-3, found) == len(nosings)
    # a table that is full takes no more
    x, z = on_the_flight(back)
    assert contacts_at((ground, body), x, z, ANGLE, 1e-9, found[:2]) == 2


def test_contacts_of_a_robot_at_a_riser():
    """By hand: level on the floor, its front disc against the face of a riser."""
    ground = ground_table([(-2, 0), (0, 0), (0, 0.5), (2, 0.5)])
    body = body_table([[-0.4, -0.02, 0.08, 0.3, -0.02, 0.08], [-0.3, 0.1, 0.01, 0.2, 0.1, 0.01]])
    found = zeros(Touching, 32)
    count = contacts_at((ground, body), -0.38, 0.1, 0.0, 1e-9, found)
    rows = sorted(found[["x", "z", "n_x", "n_z"]][:count].tolist())
    assert rows == [
        pytest.approx((-0.78, 0.0, 0.0, 1.0), abs=1e-12),  # under the rear disc
        pytest.approx((-0.08, 0.0, 0.0, 1.0), abs=1e-12),  # under the front disc
        pytest.approx((0.0, 0.08, -1.0, 0.0), abs=1e-12),  # at the face
    ]


def test_a_nosing_under_the_middle_of_a_raised_flipper():
    """The flat leans by 3-4-5; a fin touches it 0.3 m from the centre of its lower end."""
    body = body_table([[0.0, 0.0, 0.05, 0.4, 0.3, 0.05]])
    x, z = 0.3 * 0.8 + 0.05 * 0.6, 0.3 * 0.6 - 0.05 * 0.8
    fin = ground_table([(-9, -1), (x, -1), (x, z), (x + 1e-3, -1), (9, -1)])
    found = zeros(Touching, 32)
    count = contacts_at((fin, body), 0.0, 0.0, 0.0, 1e-9, found)
    assert count == 1
    assert found[["n_x", "n_z"]][0].item() == pytest.approx((-0.6, 0.8))


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_two_ends_at_one_face_are_two_contacts(side, swapped):
    low, high = (0.0, 0.5) if side < 0 else (0.5, 0.0)
    ground = ground_table([(-2, low), (0, low), (0, high), (2, high)])
    ends = [[0.02 * side, each, 0.02, 0.4 * side, each, 0.02] for each in (0.1, 0.3)]
    if swapped:
        ends = [each[3:] + each[:3] for each in ends]
    found = zeros(Touching, 32)
    count = contacts_at((ground, body_table(ends)), 0.0, 0.0, 0.0, 1e-9, found)
    assert sorted(found["z"][:count]) == pytest.approx([0.1, 0.3])


def test_what_lies_behind_a_wall_is_not_touched():
    """A disc that stands beyond a thin fin by its radius touches the side it is on alone."""
    fin = ground_table([(-1, 0), (0, 0), (0, 0.5), (0.001, 0.5), (0.001, 0), (1, 0)])
    body = body_table([[0.0, 0.0, 0.1, 0.0, 0.0, 0.1]])
    found = zeros(Touching, 32)
    count = contacts_at((fin, body), -0.1, 0.3, 0.0, 1e-9, found)
    assert count == 1
    assert found["n_x"][0] == pytest.approx(-1.0)
    count = contacts_at((fin, body), 0.101, 0.3, 0.0, 1e-9, found)
    assert count == 1
    assert found["n_x"][0] == pytest.approx(1.0)


def closed(ground, body, x, z, phi, touch):
    """Points of all features of which the gap is at most so much, each once."""
    points = []
    c, s = math.cos(phi), math.sin(phi)
    for part in range(len(body)):
        for k in range(len(ground) - 1):
            for kind in range(3):
                feature = POINT * k + PART * part + kind
                found, _, _, *point = gap(scene(ground, body), feature, At(x, z, c, s))
                g_x, g_z, u_x, u_z, length, _ = ground[k].item()
                foot = (point[0] - g_x) * u_x + (point[1] - g_z) * u_z
                exists = 0 <= foot <= length if kind else ground["convex"][k]
                if exists and abs(found) <= touch:
                    points += [point] if all(math.dist(point, p) > 3e-6 for p in points) else []
    return sorted(points)


@pytest.mark.parametrize("seed", range(20))
def test_contacts_are_all_features_that_are_closed(seed):
    """Oracle: the gap of every feature, at rest and 2 mm above it, and about any part."""
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng, least_radius=0.03)
    x = np.cumsum(rng.uniform(0.02, 0.15, 30)) - 1.0
    line = np.stack([x, 0.7 + np.cumsum(rng.normal(0, 0.03, 30))], 1)  # nowhere level
    ground, body = ground_table(line), body_table(parts, kinds)
    place, phi = rng.uniform(-0.2, 0.6), rng.uniform(-0.4, 0.4)
    z, _ = touching(scene(ground, body), place, math.cos(phi), math.sin(phi))
    found = zeros(Touching, 32)
    for lift, touch in ((0.0, 1e-9), (0.002, 0.02), (0.0, 0.01)):
        count = contacts_at((ground, body), place, z + lift, phi, touch, found)
        seen = sorted(found[["x", "z"]][:count].tolist())
        assert seen == [
            pytest.approx(tuple(each)) for each in closed(ground, body, place, z + lift, phi, touch)
        ]
        assert count > 0
