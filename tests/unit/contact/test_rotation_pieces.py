"""Rotation about one contact: rigid motion, rolling, and when a gap closes, laid out by hand."""

import cmath
import math

import numpy as np
import pytest

from kaidan.contact import body_table, ground_table
from kaidan.contact.kernel.closing import (
    FROM_DISC_1,
    FROM_DISC_2,
    TO_ARC_1,
    TO_ARC_2,
    TO_FLAT,
    TO_TOP,
    closing_angle,
    crossing_angle,
    on_piece,
    separation,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.passings import along_flat
from kaidan.contact.kernel.rotation import (
    NEVER,
    angle_until_over,
    foot_limit,
    next_pivot,
    turned,
)
from kaidan.contact.kernel.settling import lever
from kaidan.contact.layout import PART, POINT, At
from kernel_memory import posed, scene, turning

ROUNDING = 1e-12  # m, rad: coordinates of some metres
BODY = body_table(
    [[-0.25, 0.05, 0.09, 0.2, -0.01, 0.05], [-0.3, 0.02, 0.08, 0.2, -0.03, 0.05]]
)  # the second is looked at, tapered and off the centroid's axis
GROUND = ground_table([(-2, 0.8), (0.3, 0.4), (1.8, 1.3), (2.0, 1.35), (3.3, 0.6), (4.3, 1.3)])
"""A valley, a slope up, a flatter one, an edge, a slope down, a valley."""
SLOPE = int(np.flatnonzero(GROUND["x"] == 0.3)[0])
"""From (0.3, 0.4) to (1.8, 1.3)."""
LEVEL = 1.0, 0.0
"""Cosine and sine of no inclination."""
EDGE = int(np.flatnonzero(GROUND["x"] == 2.0)[0])


def disc(k, x, z, phi, part=1):
    """Centre of disc 1 or 2 as a complex number."""
    own_x, own_z, _ = BODY["one" if k == 1 else "two"][part].item()
    own = complex(own_x, own_z)
    return x + 1j * z + own * cmath.exp(1j * phi)


RADIUS = {1: 0.08, 2: 0.05}


def on_slope(k, along, phi, segment=SLOPE):
    """Centroid with disc k touching a segment so far along it."""
    u = complex(*GROUND[["u_x", "u_z"]][segment].item())
    centre = complex(*GROUND[["x", "z"]][segment].item()) + along * u + RADIUS[k] * 1j * u
    place = centre - disc(k, 0.0, 0.0, phi)
    return place.real, place.imag


@pytest.mark.parametrize("angle", [0.3, -0.8, 0.0])
def test_about_a_vertex_the_body_rotates_rigidly(angle):
    x, z = 1.9, 1.6
    found = complex(*turned(scene(GROUND, BODY), POINT * EDGE + PART, x, z, 0.4, angle))
    edge = complex(*GROUND[["x", "z"]][EDGE].item())
    assert found == pytest.approx(edge + (x + 1j * z - edge) * cmath.exp(1j * angle), abs=ROUNDING)


@pytest.mark.parametrize("k", [1, 2])
@pytest.mark.parametrize("phi", [0.4, -0.7])
@pytest.mark.parametrize("angle", [0.3, -0.8])
def test_on_a_segment_the_disc_rolls(k, phi, angle):
    # hand: the centre moves back along the segment by radius times angle, nose up positive
    x, z = on_slope(k, 0.6, phi)
    pivot = POINT * SLOPE + PART + k
    after = turned(scene(GROUND, BODY), pivot, x, z, phi, angle)
    u = complex(*GROUND[["u_x", "u_z"]][SLOPE].item())
    moved = disc(k, *after, phi + angle) - disc(k, x, z, phi)
    assert moved == pytest.approx(-RADIUS[k] * angle * u, abs=ROUNDING)
    found, *_ = gap(scene(GROUND, BODY), pivot, posed(*after, phi + angle))
    assert found == pytest.approx(0.0, abs=ROUNDING)


@pytest.mark.parametrize("k", [1, 2])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_disc_rolls_to_the_end_of_its_segment(k, sense):
    # hand: nose up it rolls back over 0.6 m, nose down ahead over the rest
    x, z = on_slope(k, 0.6, 0.4)
    room = 0.6 if sense > 0 else GROUND["length"][SLOPE] - 0.6
    pivot, turn = POINT * SLOPE + PART + k, (math.cos(0.4), math.sin(0.4))
    found = foot_limit(scene(GROUND, BODY), pivot, At(x, z, *turn), sense)
    assert found == pytest.approx(room / RADIUS[k], abs=ROUNDING / 0.05)
    beyond = on_slope(k, -0.1 if sense > 0 else GROUND["length"][SLOPE] + 0.1, 0.4)
    assert foot_limit(scene(GROUND, BODY), pivot, At(*beyond, *turn), sense) == 0.0
    assert foot_limit(scene(GROUND, BODY), POINT * EDGE + PART, At(x, z, *turn), sense) == NEVER


def test_what_a_disc_rolls_on_next():
    def after(segment, sense, k=2):
        # of the third part of three, told as of the second
        pivot = POINT * segment + 2 * PART + k
        return next_pivot(scene(GROUND, BODY), pivot, sense) - PART

    last = len(GROUND) - 2
    convex = GROUND["convex"]
    assert convex[EDGE]
    assert not convex[SLOPE]
    assert after(EDGE, 1.0) == POINT * EDGE + PART  # back over its start, a convex point
    assert after(EDGE - 1, -1.0) == POINT * EDGE + PART  # ahead over its end
    assert after(SLOPE, 1.0) == POINT * (SLOPE - 1) + PART + 2  # back into the valley
    assert after(SLOPE - 1, -1.0) == POINT * SLOPE + PART + 2  # ahead into it
    assert after(0, 1.0) == PART  # over the end of the terrain
    assert not convex[1]
    assert after(1, 1.0) == PART + 2  # not its end yet: back into a valley
    assert after(last - 1, -1.0) == POINT * last + PART + 2
    assert after(last, -1.0) == POINT * (last + 1) + PART
    assert after(last, -1.0, k=1) == POINT * (last + 1) + PART
    assert after(SLOPE, 1.0, k=1) == POINT * (SLOPE - 1) + PART + 1
    assert after(SLOPE - 1, -1.0, k=1) == POINT * SLOPE + PART + 1


@pytest.mark.parametrize("kappa", [0.0, 0.2, -0.3])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_angle_until_the_centroid_stands_over_a_vertex(kappa, sense):
    pivot, phi, turn = POINT * EDGE + PART, 0.3, (math.cos(0.3), math.sin(0.3))
    for x, z in ((1.9, 1.6), (2.1, 1.6), (2.05, 1.7)):
        angle = angle_until_over(scene(GROUND, BODY), pivot, At(x, z, *turn), sense, kappa, False)
        assert 0.0 <= angle < 2 * math.pi
        after = turned(scene(GROUND, BODY), pivot, x, z, phi, sense * angle)
        assert after[1] > GROUND["z"][EDGE]  # over it, not under it
        at = phi + sense * angle
        delta = lever(scene(GROUND, BODY), pivot, posed(*after, at), kappa)
        assert delta == pytest.approx(0.0, abs=ROUNDING)
        assert (
            angle_until_over(scene(GROUND, BODY), pivot, At(x, z, *turn), sense, kappa, True)
            == NEVER
        )


@pytest.mark.parametrize("kappa", [0.0, 0.2, -0.3])
@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("k", [1, 2])
@pytest.mark.parametrize("below", [False, True])
def test_angle_until_the_centroid_stands_over_a_rolling_disc(k, sense, kappa, below):
    # oracle: the first sign change of the lever on a fine grid; over the contact it grows with the
    # angle that lifts the nose (unstable), below it falls (it comes to rest, rocking)
    pivot, phi = POINT * SLOPE + PART + k, 0.4
    x, z = on_slope(k, 0.6, phi)

    def delta(angle):
        at = phi + sense * angle
        after = turned(scene(GROUND, BODY), pivot, x, z, phi, sense * angle)
        return lever(scene(GROUND, BODY), pivot, posed(*after, at), kappa)

    grid = np.linspace(0.0, 2 * math.pi, 4001)
    values = np.array([delta(angle) for angle in grid])
    falls = values[:-1] * values[1:] < 0
    rate = sense * np.diff(values)
    (roots,) = np.nonzero(falls & ((rate < 0) if below else (rate > 0)))
    turn = math.cos(phi), math.sin(phi)
    found = angle_until_over(scene(GROUND, BODY), pivot, At(x, z, *turn), sense, kappa, below)
    assert grid[roots[0]] - 1e-9 <= found <= grid[roots[0] + 1] + 1e-9
    assert delta(found) == pytest.approx(0.0, abs=ROUNDING)


def test_a_disc_wider_than_the_lever_of_its_centroid_never_stands_under_it():
    # hand: on a slope of 45 degrees a wheel of 0.1 whose centroid lies 0.02 off its middle
    ground = ground_table([(0, 0), (2, 2)])
    body = body_table([[-0.02, 0.0, 0.1, -0.02, 0.0, 0.1]])
    assert angle_until_over(scene(ground, body), 1, At(1.0, 1.2, *LEVEL), 1.0, 0.0, False) == NEVER
    # just wide enough: 0.1 sin 45 = 0.0707
    wide = body_table([[-0.0708, 0.0, 0.1, -0.0708, 0.0, 0.1]])
    assert angle_until_over(scene(ground, wide), 1, At(1.0, 1.2, *LEVEL), 1.0, 0.0, False) < 7.0


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("piece", [TO_FLAT, TO_TOP, TO_ARC_1, TO_ARC_2, FROM_DISC_1, FROM_DISC_2])
def test_a_piece_of_a_gap_and_its_rate(piece, sense):
    x, z, phi, step = 1.8, 1.7, 0.3, 1e-6
    about = complex(1.5, 1.2)
    k = SLOPE if piece >= FROM_DISC_1 else EDGE
    point, u = complex(*GROUND[["x", "z"]][k].item()), complex(*GROUND[["u_x", "u_z"]][k].item())

    def at(angle):
        place = about + (x + 1j * z - about) * cmath.exp(1j * sense * angle)
        turn = phi + sense * angle
        tables = scene(GROUND, BODY)
        there = posed(place.real, place.imag, turn)
        value, rate = separation(
            tables, k, tables.body[1], piece, there, about.real, about.imag, sense
        )
        return value, rate, place, turn

    value, rate, place, turn = at(0.0)
    # hand: the distance from the line or the centre
    if piece in (TO_ARC_1, TO_ARC_2):
        k_disc = 1 + piece - TO_ARC_1
        expected = abs(point - disc(k_disc, place.real, place.imag, turn)) - RADIUS[k_disc]
    elif piece in (TO_FLAT, TO_TOP):
        a, b = (disc(each, place.real, place.imag, turn) for each in (1, 2))
        axis = b - a
        lean = math.asin((RADIUS[1] - RADIUS[2]) / abs(axis))
        side = -1 if piece == TO_FLAT else 1  # the other side: its mirror image at the axis
        normal = side * 1j * axis / abs(axis) * cmath.exp(-side * 1j * lean)
        expected = ((point - a) * normal.conjugate()).real - RADIUS[1]
    else:
        k_disc = 1 + piece - FROM_DISC_1
        centre = disc(k_disc, place.real, place.imag, turn)
        expected = ((centre - point) * (1j * u).conjugate()).real - RADIUS[k_disc]
    assert value == pytest.approx(expected, abs=ROUNDING)
    numeric = (at(step)[0] - at(-step)[0]) / (2 * step)
    assert rate == pytest.approx(numeric, abs=1e-8)  # central difference, 1e-12 / 1e-6


@pytest.mark.parametrize("seed", range(300))
def test_where_a_sinusoid_goes_down_through_zero(seed):
    # oracle: a fine grid of the turn
    rng = np.random.default_rng(seed)
    level, cosine, sine = rng.uniform(-1.2, 1.2), *rng.uniform(-1, 1, 2)
    if level + cosine < 0.01:
        level = 0.05 - cosine  # open at the start
    end = rng.uniform(0.2, 1.5)
    grid = np.linspace(0.0, end, 20_001)
    values = level + cosine * np.cos(grid) + sine * np.sin(grid)
    found = crossing_angle(level, cosine, sine, math.cos(end), math.sin(end), PENETRATED)
    below = np.flatnonzero(values < 0)
    if len(below) == 0:
        # none within the turn: never, or later than its end
        assert found > end - 1e-9 or values.min() < 1e-6
    else:
        assert grid[below[0] - 1] - 1e-9 <= found <= grid[below[0]] + 1e-9


def test_a_sinusoid_that_is_closed_at_the_start():
    # hand: at rest, in contact and falling: now; a hair deeper: now; far behind the line: passed
    c, s = math.cos(0.3), math.sin(0.3)
    assert crossing_angle(-1.0, 1.0, -0.5, c, s, PENETRATED) == 0.0
    assert crossing_angle(-1.0, 1.0 - PENETRATED, -0.5, c, s, PENETRATED) == 0.0
    assert crossing_angle(-1.0, 1.0 - 0.02, -0.5, c, s, PENETRATED) == NEVER
    # it opens, and stays open
    assert crossing_angle(-1.0, 1.0, 0.5, c, s, PENETRATED) == NEVER
    # never positive at all
    assert crossing_angle(-1.0, 0.3, 0.4, c, s, PENETRATED) == NEVER
    # hand: 0.5 = cos(60 degrees); seen within a turn of 90 degrees
    found = crossing_angle(-0.5, 1.0, 0.0, 0.0, 1.0, PENETRATED)
    assert found == pytest.approx(math.pi / 3, abs=1e-12)
    # falls at the start and grows at the end, but its least value is above zero
    assert crossing_angle(1.1, 0.0, -1.0, -1.0, 0.0, PENETRATED) == NEVER
    # hand: 0.5 - sin: at 30 degrees, though positive again at 180
    found = crossing_angle(0.5, 0.0, -1.0, -1.0, 0.0, PENETRATED)
    assert found == pytest.approx(math.pi / 6, abs=1e-12)


@pytest.mark.parametrize("seed", range(200))
def test_where_a_piece_of_a_gap_closes_while_a_disc_rolls(seed):
    # oracle: a fine grid of the turn
    rng = np.random.default_rng(seed)
    k, sense = int(rng.integers(1, 3)), float(rng.choice([-1.0, 1.0]))
    phi, end = rng.uniform(-0.5, 0.8), rng.uniform(0.05, 1.5)
    x, z = on_slope(k, rng.uniform(0.2, 1.4), phi)
    pivot = POINT * SLOPE + PART + k
    piece = int(rng.integers(0, 6))
    at = EDGE if piece < FROM_DISC_1 else int(rng.integers(0, len(GROUND) - 1))
    if POINT * at + PART + piece - FROM_DISC_1 + 1 == pivot:
        return
    _, _, _, o_x, o_z = gap(scene(GROUND, BODY), pivot, posed(x, z, phi))
    u = np.array(GROUND[["u_x", "u_z"]][SLOPE].item())
    tables = scene(GROUND, BODY)

    def piece_at(angle):
        there, foot = pose(angle)
        return separation(tables, at, tables.body[1], piece, there, *foot, sense)

    def pose(angle):
        foot = (o_x, o_z) - sense * RADIUS[k] * angle * u
        after = turned(tables, pivot, x, z, phi, sense * angle)
        return posed(*after, phi + sense * angle), foot

    near, far = piece_at(0.0), piece_at(end)
    if near[0] <= 1e-6:
        return
    # hand: no centre and no point is farther than this from the disc that rolls
    bend = 4.0 + 2.0 * RADIUS[k]
    start, finish = pose(0.0), pose(end)
    turn = turning(
        complex(*start[1]), sense, end, pivot, start[0], (finish[0], complex(*finish[1]))
    )
    found = closing_angle(tables, at, 1, piece, turn, end, *near, *far, bend)
    grid = np.linspace(0.0, end, 2001)
    values = np.array([piece_at(angle)[0] for angle in grid])
    closes = np.flatnonzero((values[1:] < -PENETRATED) & (values[:-1] >= -PENETRATED)) + 1
    # of those the first with its foot on the piece
    closes = [
        i for i in closes
        if on_piece(tables, at, 1, piece, pose(grid[i])[0])
        or on_piece(tables, at, 1, piece, pose(grid[i - 1])[0])
    ]  # fmt: skip
    if not closes:
        assert found == NEVER or values.min() < 1e-6  # between two of the grid
    else:
        assert grid[closes[0] - 1] <= found <= grid[closes[0]] + 1e-9
        assert piece_at(found)[0] == pytest.approx(-0.5 * PENETRATED, abs=0.51 * PENETRATED)


def test_a_gap_that_grows_falls_and_grows_again_closes_in_between():
    # hand: a disc of 0.1 rolls back by 0.1 m a radian, a point 0.125 below its centre swings ahead
    # towards a wall; from 0.75 rad before the lowest point (tau = 0) to as much beyond the gap is
    # W + 0.1 (tau + 0.75) - 0.125 sin tau: it grows up to cos tau = 0.8, falls until tau = 0.6435
    # by then to W + 0.06435, and grows to W + 0.0648. Open at both ends, closed between them
    lowest, radius = -0.06455, 0.001
    wall = -1.2 + radius + lowest
    ground = ground_table([(-3, -2), (wall, -2), (wall, 2), (wall + 0.01, 0.5), (3, 0.5)])
    body = body_table([[0.0, 0.0, 0.1, 0.0, -0.125, radius]])
    floor, face = 3, 1

    def pose(angle):
        return posed(-1.2 - 0.1 * angle, 0.6, angle - 0.75), -1.2 - 0.1 * angle, 0.5

    tables = scene(ground, body)
    where = (tables, face, tables.body[0], FROM_DISC_2)
    near, far = (separation(*where, *pose(angle), 1.0) for angle in (0.0, 1.5))
    assert near[0] > 0.0
    assert near[1] > 0.0
    assert far[0] > 0.0
    assert far[1] > 0.0
    start, finish = pose(0.0), pose(1.5)
    turn = turning(
        complex(*start[1:]), 1.0, 1.5, POINT * floor + 1, start[0],
        (finish[0], complex(*finish[1:])),
    )  # fmt: skip
    found = closing_angle(tables, face, 0, FROM_DISC_2, turn, 1.5, *near, *far, 0.125)
    tau = found - 0.75
    assert lowest + 0.1 * found - 0.125 * math.sin(tau) == pytest.approx(0.0, abs=2 * PENETRATED)
    assert tau < 0.6435


@pytest.mark.parametrize("place", [-0.1, 0.2, 0.7])
@pytest.mark.parametrize("off", [-0.02, 0.0, 0.3])
def test_place_of_a_point_along_a_tapered_flat(off, place):
    phi = 0.4
    a, b = (disc(each, 0.0, 0.0, phi) for each in (1, 2))
    lean = math.asin((RADIUS[1] - RADIUS[2]) / abs(b - a))
    normal = -1j * (b - a) / abs(b - a) * cmath.exp(1j * lean)  # out of the underside
    begin = a + RADIUS[1] * normal
    c = complex(*GROUND[["x", "z"]][EDGE].item()) - (begin + place * 1j * normal + off * normal)
    tables = scene(GROUND, BODY)
    found = along_flat(tables.body[1], tables.ground[EDGE], posed(c.real, c.imag, phi))
    assert found == (pytest.approx(place, abs=ROUNDING), pytest.approx(off, abs=ROUNDING))


def test_a_foot_beyond_the_flat_or_the_segment_is_none():
    def here(piece, along, k=1):
        x, z = on_slope(k, along, 0.4)
        return on_piece(scene(GROUND, BODY), SLOPE, 1, piece, posed(x, z, 0.4))

    length = GROUND["length"][SLOPE]
    for k, piece in ((1, FROM_DISC_1), (2, FROM_DISC_2)):
        assert [here(piece, along, k) for along in (-1e-6, 1e-6, length - 1e-6, length + 1e-6)] == [
            False, True, True, False,
        ]  # fmt: skip
    assert here(TO_ARC_1, -5.0)
    assert here(TO_ARC_2, -5.0)
    assert not here(TO_FLAT, -5.0)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_over_the_pivot_it_is_there_already(sense):
    """On an edge, and on a disc whose centre lies straight below the centroid: no turn of 360."""
    ground = ground_table([(-3, -1), (0, 0), (3, -1)])
    body = body_table([[0.0, -0.1, 0.05, 0.4, -0.1, 0.05]])
    assert angle_until_over(scene(ground, body), 64, At(0.0, 0.2, *LEVEL), sense, 0.0, False) == 0.0
    level = ground_table([(-3, 0), (3, 0)])
    assert angle_until_over(scene(level, body), 1, At(0.3, 0.15, *LEVEL), sense, 0.0, False) == 0.0
