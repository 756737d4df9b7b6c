"""Letting a robot down at a fixed place: the first pose that holds, in the way it rotates."""

import math
from itertools import pairwise

import numpy as np
import pytest

from contact_cases import flight, random_robot, random_terrain, stadium, steps
from kaidan.contact import (
    Feature,
    FeatureKind,
    body_table,
    ground_table,
    mirror,
    using_kernel,
    without_native,
)
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.settling import lever, settle, touching
from kaidan.contact.layout import At
from kaidan.contact.switch import kernel as entries
from kernel_memory import posed, scene


def delta_at(ground, body, x, phi, kappa):
    """Lever of what touches at an inclination [m]."""
    c, s = math.cos(phi), math.sin(phi)
    z, feature = touching(scene(ground, body), x, c, s)
    return lever(scene(ground, body), feature, At(x, z, c, s), kappa)


@pytest.mark.parametrize("kappa", [0.0, 0.15, -0.1])
@pytest.mark.parametrize("seed", range(15))
def test_two_contacts_hold_it_and_none_does_before(seed, kappa):
    """Oracle: the lever on a fine grid of inclinations keeps its sign up to the pose."""
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng, least_radius=0.01)
    ground, body = ground_table(random_terrain(rng)), body_table(parts, kinds)
    x, start = rng.uniform(0.0, 1.0), rng.uniform(-0.4, 0.4)
    found, z, phi, rear, front = settle(scene(ground, body), x, start, kappa)
    up = delta_at(ground, body, x, start, kappa) > 0
    cell = 5e-3
    grid = np.arange(start, 0.5 * math.pi if up else -0.5 * math.pi, cell if up else -cell)
    signs = np.array([delta_at(ground, body, x, each, kappa) > 0 for each in grid])
    changes = np.flatnonzero(signs != up)
    if not found:
        assert len(changes) == 0 or abs(grid[changes[0]]) > 0.5 * math.pi - 0.06
        return
    if len(changes):
        assert (phi - grid[changes[0]]) * (1 if up else -1) <= 1e-9
    assert (signs[np.abs(grid - start) < abs(phi - start) - cell] == up).all()
    c, s = math.cos(phi), math.sin(phi)
    assert touching(scene(ground, body), x, c, s)[0] == pytest.approx(z, abs=1e-9)
    assert gap(scene(ground, body), rear, At(x, z, c, s))[0] == pytest.approx(0.0, abs=1e-9)
    assert gap(scene(ground, body), front, At(x, z, c, s))[0] == pytest.approx(0.0, abs=1e-9)
    at_rear, at_front = (
        lever(scene(ground, body), each, At(x, z, c, s), kappa) for each in (rear, front)
    )
    assert at_rear <= 1e-9 <= 1e-8 + at_front


def test_it_rotates_from_where_it_is_let_go():
    """By hand: on its tail at 80 degrees a tall robot falls on, at 60 it comes down on its flat."""
    ground = ground_table([(0, 0), (4, 0)])
    body = body_table(stadium(0.5, 0.25, 0.25, 0.05))
    # the centroid stands over the rear foot at tan = (L - C_L)/(C_N - R) = 0.25/0.2
    edge = math.atan2(0.25, 0.2)
    found, z, phi, _, _ = settle(scene(ground, body), 2.0, edge - 0.01, 0.0)
    assert found
    assert (z, phi) == pytest.approx((0.25, 0.0), abs=1e-12)
    found, *_, front = settle(scene(ground, body), 2.0, edge + 0.01, 0.0)
    assert (found, front) == (False, -1)
    # and forward; gravity that leans back by kappa moves the edge by its angle
    found, _, phi, _, _ = settle(scene(ground, body), 2.0, -edge + 0.01, 0.0)
    assert found
    assert phi == pytest.approx(0.0, abs=1e-12)
    assert not settle(scene(ground, body), 2.0, -edge - 0.01, 0.0)[0]
    kappa = 0.1
    lean = math.atan(kappa)
    assert settle(scene(ground, body), 2.0, _edge_leaning(kappa) - 0.01, kappa)[0]
    assert not settle(scene(ground, body), 2.0, _edge_leaning(kappa) + 0.01, kappa)[0]
    assert _edge_leaning(kappa) < edge - 0.5 * lean


def _edge_leaning(kappa):
    """Inclination at which the lever of the rear foot is zero, with gravity leaning by kappa.

    The foot lies R below the rear disc's centre: by hand
    ``-(0.25 cos p - 0.2 sin p) + kappa (0.05 + 0.25 sin p + 0.2 cos p) = 0``, by bisection.
    """
    low, high = 0.0, 1.5
    for _ in range(60):
        p = (low + high) / 2
        held = -(0.25 * math.cos(p) - 0.2 * math.sin(p))
        if held + kappa * (0.05 + 0.25 * math.sin(p) + 0.2 * math.cos(p)) < 0:
            low = p
        else:
            high = p
    return low


def test_touching_by_hand():
    ground = ground_table(steps(0.2, 0.3, 2))
    body = body_table(stadium(0.5, 0.2, 0.1, 0.06))
    # level over the first tread: the flat lies on the second edge, at (0.3, 0.4)
    z, feature = touching(scene(ground, body), 0.25, 1.0, 0.0)
    assert z == pytest.approx(0.4 + 0.1, abs=1e-12)
    assert ground[["x", "z"]][feature >> 6].tolist() == (0.3, 0.4)
    # level, the front disc's arc over the first edge: its centre sqrt(0.06^2 - 0.03^2) above it
    down = math.sqrt(0.06**2 - 0.03**2)
    z, feature = touching(scene(ground, body), -0.2 - 0.03, 1.0, 0.0)
    assert z == pytest.approx(0.2 + down + (0.1 - 0.06), abs=1e-12)
    assert ground[["x", "z"]][feature >> 6].tolist() == (0.0, 0.2)
    # nose up: the tail's disc on the floor, its centre 0.3 back and 0.04 below the centroid
    c, s = math.cos(0.9), math.sin(0.9)
    z, feature = touching(scene(ground, body), -1.0, c, s)
    assert z == pytest.approx(0.06 + 0.3 * s + 0.04 * c, abs=1e-12)
    assert feature & 3 == 1
    # nose down: the front disc on the floor
    z, feature = touching(scene(ground, body), -1.0, c, -s)
    assert z == pytest.approx(0.06 + 0.2 * s + 0.04 * c, abs=1e-12)
    assert feature & 3 == 2


def underside(part, along):
    """Height of the underside over places along the body, infinite beyond it; no kernel code.

    A part is all discs between its two, so its underside is the lowest of theirs.
    """
    share = np.linspace(0.0, 1.0, 201)[:, None]
    x, z, r = ((1 - share) * part[k] + share * part[k + 3] for k in range(3))
    square = r**2 - (along - x) ** 2
    lowest = np.where(square >= 0, z - np.sqrt(np.maximum(square, 0.0)), np.inf)
    return lowest.min(axis=0)


@pytest.mark.parametrize("which", [0, 1, 2])
@pytest.mark.parametrize("seed", range(8))
def test_it_touches_where_the_ground_is_highest_under_its_outline(seed, which):
    """Oracle: the ground in pieces of half a millimetre against discs along the body."""
    rng = np.random.default_rng(100 + seed)
    if which == 0:  # slopes up to 70 degrees either way
        x = np.cumsum(rng.uniform(0.02, 0.2, 12)) - 0.6
        line = np.stack([x, np.cumsum(rng.uniform(-0.25, 0.25, 12))], 1)
    elif which == 1:
        line = steps(0.17, 0.28, 3, 2.0, 2.0)[:, :2]
    else:  # a peak
        line = np.array([(-2.0, 0.0), (0.0, 0.0), (0.05, 0.2), (0.1, 0.0), (3.0, 0.0)])
    line = np.vstack([[-4.0, line[0, 1]], line, [4.0, line[-1, 1]]])
    reach, height, phi = rng.uniform(0.15, 0.4), rng.uniform(-0.05, 0.05), rng.uniform(-0.7, 0.7)
    part = [-reach, -0.05, rng.uniform(0.03, 0.1), reach, height, rng.uniform(0.03, 0.1)]
    if seed % 2:  # its second disc lies behind the first
        part = part[3:] + part[:3]
    x, (c, s) = rng.uniform(-0.3, 0.4), (math.cos(phi), math.sin(phi))
    body = body_table([part])
    z, feature = touching(scene(ground_table(line), body), x, c, s)
    turned = [
        c * part[0] - s * part[1], s * part[0] + c * part[1], part[2],
        c * part[3] - s * part[4], s * part[3] + c * part[4], part[5],
    ]  # fmt: skip
    pieces = [
        one + np.linspace(0.0, 1.0, max(int(math.dist(one, two) * 2e3), 2))[:, None] * (two - one)
        for one, two in pairwise(line)
    ]
    places = np.concatenate(pieces)
    places = places[np.abs(places[:, 0] - x) < 0.6]
    expected = (places[:, 1] - underside(turned, places[:, 0] - x)).max()
    # m: an arc of 30 mm seen every half a millimetre, from discs every 4 mm at most
    assert z == pytest.approx(expected, abs=2e-4)
    assert gap(scene(ground_table(line), body), feature, At(x, z, c, s))[0] == pytest.approx(
        0.0, abs=1e-9
    )


@pytest.mark.parametrize("off", [-0.03, -0.01, 0.02, 0.1])
@pytest.mark.parametrize("angle", [0.2, 0.5])
@pytest.mark.parametrize("x", [0.5, 0.55, 0.63])
def test_of_nosings_in_line_the_outermost_two_hold_it(x, angle, off):
    """By hand: a flat of 1 m over nosings 200 mm apart."""
    terrain = flight(angle, 0.2)
    body = body_table(stadium(1.0, 0.45, 0.15, 0.05))
    found, z, phi, rear, front = settle(scene(ground_table(terrain), body), x, angle + off, 0.0)
    assert found
    assert phi == pytest.approx(angle, abs=1e-12)
    # the flat's line goes through (0, rise): the centroid is 0.15 above it
    foot = x + 0.15 * math.sin(angle)
    rise = 0.2 * math.sin(angle)
    assert z == pytest.approx(rise + foot * math.tan(angle) + 0.15 * math.cos(angle), abs=1e-12)
    nosings = terrain[2:-1:2]
    along = (nosings[:, 0] - foot) / math.cos(angle)
    under = nosings[(along >= -0.55) & (along <= 0.45)]
    seen = [list(ground_table(terrain)[["x", "z"]][each >> 6].tolist()) for each in (rear, front)]
    assert seen == [pytest.approx(under[0]), pytest.approx(under[-1])]


@pytest.mark.parametrize("slope", [0.0, 0.2, -0.3])
@pytest.mark.parametrize("start", [0.5, -0.6])
def test_a_wheel_with_a_low_centroid_rocks_to_rest_on_one_contact(slope, start):
    """By hand: the centroid, 0.05 from the axle, hangs under it where it is over the contact.

    The contact lies R sin(slope) beside the axle, R = 0.1, towards the lower side.
    """
    ground = ground_table([(-4, -4 * math.tan(slope)), (4, 4 * math.tan(slope))])
    body = body_table([[0.0, 0.05, 0.1, 0.0, 0.05, 0.1]])
    x = 0.3
    found, z, phi, rear, front = settle(scene(ground, body), x, start, 0.0)
    assert (found, rear) == (True, front)
    # rad: within 2e-6 its height is the least to 1e-13 m, which is what it is solved to
    assert phi == pytest.approx(math.asin(0.1 * math.sin(slope) / 0.05), abs=2e-6)
    axle = x - 0.05 * math.sin(phi)
    assert z == pytest.approx(
        axle * math.tan(slope) + 0.1 / math.cos(slope) - 0.05 * math.cos(phi), abs=1e-12
    )


@pytest.mark.parametrize("order", [slice(None), slice(None, None, -1)])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_an_edge_under_the_outer_half_of_an_end(side, order):
    """By hand: an edge 30 mm beyond the axle of a disc of 60 mm, the ground on the axle's side low.

    Either disc may come first.
    """
    x = side * 0.3
    line = [(-4, 0), (x, 0), (x + 1e-3, -1), (5, -1)]
    if side > 0:
        line = [(-5, -1), (x - 1e-3, -1), (x, 0), (4, 0)]
    one, other = [[-0.27, 0.0, 0.06], [0.27, 0.0, 0.06]][order]
    above = [-0.1, 0.5, 0.02, 0.1, 0.5, 0.02]
    ground, body = ground_table(line), body_table([above, one + other])
    z, feature = touching(scene(ground, body), 0.0, 1.0, 0.0)
    assert z == pytest.approx(math.sqrt(0.06**2 - 0.03**2), abs=1e-12)
    assert feature & 3 == 0
    assert gap(scene(ground, body), feature, At(0.0, z, 1.0, 0.0))[0] == pytest.approx(
        0.0, abs=1e-12
    )


@pytest.mark.parametrize("start", [0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1])
def test_no_pose_that_holds_is_stepped_over(start):
    """By hand: it holds from its tail at atan(0.4/0.2) down to its nose at atan(0.02/0.2)."""
    ground, body = ground_table([(0, 0), (4, 0)]), body_table(stadium(0.42, 0.02, 0.25, 0.05))
    found, z, phi, _, _ = settle(scene(ground, body), 2.0, start, 0.0)
    assert found
    assert (z, phi) == pytest.approx((0.25, 0.0), abs=1e-12)


@pytest.mark.parametrize("seed", [449, 607])
def test_both_contacts_touch_where_the_look_for_both_leaves_its_bracket(seed):
    """Of 7,222 brackets of random robots over random ground those two."""
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng, least_radius=0.02)
    terrain = random_terrain(rng)
    ground, body = ground_table(terrain), body_table(parts, kinds)
    for x in rng.uniform(terrain[0, 0] + 3.0, terrain[-1, 0] - 3.0, 2):
        found, z, phi, *contacts = settle(scene(ground, body), x, rng.uniform(-0.3, 0.3), 0.0)
        assert found
        for each in contacts:
            distance = gap(scene(ground, body), each, posed(x, z, phi))[0]
            assert distance == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("ahead", [True, False])
@pytest.mark.parametrize("off", [0.0, 1e-12, -1e-9, 3e-7])
def test_an_end_comes_down_against_a_face(ahead, off):
    """By hand: from 1 rad the nose comes down until its disc of 50 mm stands against a riser, at
    0.6 rad; its axle is 60 mm below the nosing. The tail stands on the floor.
    """
    terrain, parts = [(-5, 0), (0, 0), (0, 0.5), (5, 0.5)], [(-0.3, 0.0, 0.1, 0.3, 0.0, 0.05)]
    side = 1.0 if ahead else -1.0
    if not ahead:
        terrain, parts = mirror(terrain, parts)
    ground, body = ground_table(terrain), body_table(parts)
    x = -(0.3 * math.cos(0.6) + 0.05) + off
    for kernel in ("plain", *([] if without_native() else ["native"])):
        with using_kernel(kernel):
            found = entries().settle((ground, body), side * x, side * 1.0, 0.0)
        good, z, phi, *features = found
        phi_off = off / (0.3 * math.sin(0.6))  # nearer to the face it stands steeper
        assert good
        assert phi == pytest.approx(side * (0.6 + phi_off), abs=1e-9)
        assert z == pytest.approx(0.1 + 0.3 * math.sin(abs(phi)), abs=1e-12)
        rear, front = (Feature.of(each) for each in features[:: 1 if ahead else -1])
        points = ground[["x", "z"]].tolist()
        floor, face = points[rear.point : rear.point + 2], points[front.point : front.point + 2]
        assert {each[1] for each in floor} == {0.0}
        assert {each[0] for each in face} == {0.0}
        discs = FeatureKind.DISC_1, FeatureKind.DISC_2
        assert (rear.kind, front.kind) == (discs if ahead else discs[::-1])
