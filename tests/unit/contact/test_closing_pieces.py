"""Pieces of gaps one by one, over random geometry of millimetres to metres, in complex numbers.

About a point O a body point p is O + (p - O) e^{ia}; on a disc of radius R that rolls along u its
centre moves by -R a u. A piece closes where its gap goes down through zero.
"""

import cmath
import math

import numpy as np
import pytest
from test_reserves_by_hand import MIRRORED, Case, near, plates

from kaidan.contact import body_table
from kaidan.contact import layout as at
from kaidan.contact.door import table_of
from kaidan.contact.kernel import first_closing as module
from kaidan.contact.kernel.closing import (
    BESIDE,
    FROM_DISC_1,
    FROM_DISC_2,
    TO_FLAT,
    TO_TOP,
    closing_angle,
    crossing_angle,
    crossing_angle_on,
    foot_on,
    on_piece,
    separation,
    stays_beside,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.rotation import NEVER
from kaidan.contact.kernel.turning_closing import arcs_closing, flat_closing, segment_closing
from kaidan.contact.layout import First, Side, Swept
from kernel_memory import called, posed, scene, turning

first_closing = called(module.first_closing)
EVERYWHERE = (-1e9, 1e9, -1e9, 1e9)


def random_direction(rng):
    return cmath.exp(1j * rng.uniform(-math.pi, math.pi))


def random_place(rng, largest):
    return largest * rng.uniform(0.05, 1.0) * random_direction(rng)


def along(a, b):
    """Parts of b along a unit vector and to its left."""
    turned_back = b * a.conjugate()
    return turned_back.real, turned_back.imag


def table(*rows):
    """Ground of segments: start, unit vector, length."""
    return table_of(
        at.Point, [(p.real, p.imag, u.real, u.imag, length, True) for p, u, length in rows]
    )


def discs(*each):
    """Body of a part of two discs, each of them (centre, radius)."""
    return body_table([[number for c, r in each for number in (c.real, c.imag, r)]])


APART = 100.0
"""To a disc that only its radius is read of [m]; one within the other would be none."""


def first_fall(gap, on, end):
    """First angle at which a gap that was open closes on its piece, by a grid and bisection.

    Returns
    -------
    angle, ``NEVER`` if none; whether the grid tells: nothing comes near zero without crossing it
    """
    grid = np.linspace(0.0, end, 601)
    values = gap(grid)
    lowest = (values[1:-1] < values[:-2]) & (values[1:-1] < values[2:])
    highest = (values[1:-1] > values[:-2]) & (values[1:-1] > values[2:])
    sure = (abs(values[1:-1][lowest | highest]) > 1e-4).all() and abs(values[-1]) > 1e-6
    if -BESIDE < values[0] <= 0.0:
        if values[1] > values[0]:
            return NEVER, False  # sinks in, and grows
        if on(0.0):
            return 0.0, sure
    for i in np.flatnonzero((values[1:] < 0.0) & (values[:-1] >= 0.0)):
        low, high = grid[i], grid[i + 1]
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if gap(middle) > 0.0 else (low, middle)
        if on(low):
            return low, sure
    return NEVER, sure


class Rolling:
    """A disc that rolls over 0 along u, and over a line the one that it carries along."""

    def __init__(self, rolling, u, lever, radius, line, sense, end):
        self.rolling, self.u, self.lever, self.radius = rolling, u, lever, radius
        self.begin, self.along, self.length = line
        self.sense, self.end = sense, end
        ground = table((0j, u, 1e3), line)
        body = [discs((0j, rolling), (APART, rolling)), discs((APART, radius), (lever, radius))]
        self.scene = scene(ground, np.concatenate(body))
        self.where = self.scene, 1, self.scene.body[1], FROM_DISC_2

    def contact(self, angle):
        return -self.rolling * self.sense * angle * self.u

    def offset(self, angle):
        """The disc that is carried, from where the line begins, along it and to its left."""
        hub = self.contact(angle) + self.rolling * 1j * self.u
        centre = hub + self.lever * np.exp(1j * self.sense * angle)
        return (centre - self.begin) * self.along.conjugate()

    def gap(self, angle):
        return self.offset(angle).imag - self.radius

    def on(self, angle):
        return 0.0 <= self.offset(angle).real <= self.length

    def pose(self, angle):
        contact = self.contact(angle)
        hub = contact + self.rolling * 1j * self.u
        c, s = math.cos(angle), self.sense * math.sin(angle)
        return at.At(hub.real, hub.imag, c, s), contact.real, contact.imag

    def ends(self):
        """Gap and rate at both ends of the turn."""
        return [
            number for angle in (0.0, self.end)
            for number in separation(*self.where, *self.pose(angle), self.sense)
        ]  # fmt: skip

    def closing(self, before, bend):
        start, finish = self.pose(0.0), self.pose(self.end)
        turn = turning(
            complex(*start[1:]), self.sense, self.end, at.DISC_1, start[0],
            (finish[0], complex(*finish[1:])),
        )  # fmt: skip
        return closing_angle(self.scene, 1, 1, FROM_DISC_2, turn, before, *self.ends(), bend)


@pytest.mark.parametrize("seed", range(2))
def test_an_end_that_another_one_carries_along_as_it_rolls_meets_a_line(seed):
    """Falls, grows and falls again; beyond the line's end it passes, and may come back."""
    rng = np.random.default_rng(seed)
    outcomes = []
    for _ in range(160):
        size = rng.choice([0.2, 3.0])
        rolling, radius = size * rng.uniform(0.05, 0.5, 2)
        lever, u, line = random_place(rng, size), random_direction(rng), random_direction(rng)
        sense, end = rng.choice([-1.0, 1.0]), rng.uniform(0.3, 3.0)
        length = size * rng.choice([0.3, 30.0])
        foot, start = size * rng.uniform(-0.2, 0.2), size * 10.0 ** rng.uniform(-2.5, -0.5)
        start = rng.choice([-1.5 * BESIDE, -0.5 * BESIDE, start, start])
        begin = rolling * 1j * u + lever - (foot + 1j * (start + radius)) * line
        case = Rolling(rolling, u, lever, radius, (begin, line, length), sense, end)
        root, sure = first_fall(case.gap, case.on, end)
        if not sure:
            continue
        assert case.ends()[::2] == [near(start), near(case.gap(end))]
        bend = abs(lever) * rng.choice([1.0, 1.5])
        angle = case.closing(end, bend)
        if root == 0.0:
            assert angle == 0.0
        elif root == NEVER:
            assert angle == NEVER
        else:
            assert angle == near(root)
            # closed, and by less than what counts as sunk in
            closed, _ = separation(*case.where, *case.pose(angle), sense)
            rounding = 1e-15 * (1.0 + size)
            assert -0.75 * PENETRATED - rounding < closed <= -0.5 * PENETRATED + rounding
            assert case.closing(1.001 * angle, bend) == angle
            assert case.closing(0.999 * angle, bend) == NEVER
        outcomes.append(0 if root == 0.0 else 1 if root < NEVER else 2)
    assert min(map(outcomes.count, range(3))) >= 3


@pytest.mark.parametrize(("start", "up"), [
    (-0.015, 1.0), (-0.015, 0.9), (0.002, math.pi / 2), (0.01, math.pi / 2), (0.01, 1.5)
])  # fmt: skip
def test_an_end_that_rises_and_falls_again_closes_as_it_falls(start, up):
    """On a level on which the other one rolls: gap start + 0.2 (sin(up + a) - sin up)."""
    size, radius = 0.2, 0.05
    line = -9.0 + 1j * (size * math.sin(up) - start), 1 + 0j, 99.0
    case = Rolling(radius, 1 + 0j, size * cmath.exp(1j * up), radius, line, 1.0, 1.3)
    root = math.pi - math.asin(math.sin(up) - start / size) - up
    assert case.closing(1.3, size) == near(root)


def first_turn(value, target, sense, end):
    """Angle from one direction to another in a sense, infinite beyond an end."""
    angle = (sense * (target - value)) % (2.0 * math.pi)
    return angle if angle < end else math.inf


def meets_circle(v, c, radius, sense, end):
    """Angle by which c has to turn about 0 until a circle about it comes upon v from outside."""
    a, b = abs(v), abs(c)
    cosine = (a * a + b * b - radius * radius) / (2.0 * a * b)
    if abs(cosine) >= 1.0:
        return math.inf
    apart = math.acos(cosine)
    # the centre comes from behind: its direction is short of v's by that angle
    return first_turn(cmath.phase(c), cmath.phase(v) - sense * apart, sense, end)


def test_a_point_that_the_end_discs_come_upon_about_another_one():
    rng = np.random.default_rng(0)
    found = []
    for _ in range(500):
        size = rng.choice([0.05, 1.0, 6.0])
        o, v = size * 1j * rng.uniform(-1, 1), random_place(rng, size)
        centres = [abs(v) * rng.uniform(0.8, 1.2) * random_direction(rng) for _ in range(2)]
        radii = size * rng.uniform(0.05, 0.4, 2)
        sense, end = rng.choice([-1.0, 1.0]), rng.uniform(0.1, math.pi / 2)
        if any(abs(v - c) < 1.01 * r for c, r in zip(centres, radii, strict=True)):
            continue
        turns = [
            meets_circle(v, c, r, sense, end) for c, r in zip(centres, radii, strict=True)
        ]  # fmt: skip
        expected = min(*turns, end)
        if any(abs(turn - end) < 1e-6 for turn in turns):
            continue
        ground = table((o + v, 1 + 0j, 1.0), (o + v + 1, 1 + 0j, 1.0))
        body = discs((0j, radii[0]), (APART, radii[1]))
        a, b = o + centres[0], o + centres[1]
        swept = Swept(a.real, a.imag, b.real, b.imag, *EVERYWHERE)
        turn = turning(o, sense, end)
        first = First(end, at.NO_FEATURE)
        angle, which = arcs_closing(scene(ground, body), 0, 0, turn, swept, first)
        assert angle == near(expected)
        assert (which == 0) == (expected < end)
        found.append(expected < end)
    assert 0.1 < np.mean(found) < 0.9


def test_a_segment_that_the_end_discs_come_upon_about_a_point():
    rng = np.random.default_rng(1)
    found = []
    for _ in range(500):
        size = rng.choice([0.05, 1.0, 6.0])
        o, u = size * 1j * rng.uniform(-1, 1), random_direction(rng)
        begin, length = random_place(rng, size), size * rng.uniform(0.5, 2.0)
        centres = [random_place(rng, size) for _ in range(2)]
        radii = size * rng.uniform(0.05, 0.4, 2)
        sense, end = rng.choice([-1.0, 1.0]), rng.uniform(0.1, math.pi / 2)
        gaps = [along(u, c - begin)[1] - r for c, r in zip(centres, radii, strict=True)]
        if min(gaps) < 0.01 * size:
            continue
        best, which = math.inf, None
        sure = True
        for disc, (c, r) in enumerate(zip(centres, radii, strict=True)):
            # height of the centre over the line through 0: that of the segment and the radius
            share = (along(u, begin)[1] + r) / abs(c)
            sure &= abs(abs(share) - 1.0) > 1e-6
            if abs(share) >= 1.0:
                continue
            # on its way down: nose up on the left of its top, nose down on the right
            left = math.pi - math.asin(share) if sense > 0.0 else math.asin(share)
            turn = first_turn(cmath.phase(c), left + cmath.phase(u), sense, 2.0 * math.pi)
            foot = along(u, c * cmath.exp(1j * sense * turn) - begin)[0]
            sure &= abs(turn - end) > 1e-6
            sure &= min(abs(foot), abs(foot - length)) > 1e-6
            if turn < min(end, best) and 0.0 < foot < length:
                best, which = turn, disc
        if not sure:
            continue
        ground = table((o + 99, u, 1.0), (o + 98, u, 1.0), (o + begin, u, length))
        ground = np.concatenate([ground, ground[-1:]])
        body = np.concatenate([discs((0j, radii[0]), (APART, radii[1]))] * 2)
        a, b = o + centres[0], o + centres[1]
        swept = Swept(a.real, a.imag, b.real, b.imag, *EVERYWHERE)
        turn = turning(o, sense, end)
        first = First(end, at.NO_FEATURE)
        angle, feature = segment_closing(scene(ground, body), 2, 1, turn, swept, first)
        assert angle == near(min(best, end))
        code = at.NO_FEATURE if which is None else at.POINT * 2 + at.PART + at.DISC_1 + which
        assert feature == code
        found.append(which is not None)
    assert 0.05 < np.mean(found) < 0.9


@pytest.mark.parametrize("scale", [1.0, 10.0])
@pytest.mark.parametrize(("beside", "expected"), [(0.8, 0.0), (1.2, None)])
def test_what_an_arc_has_sunk_into_by_a_centimetre_has_passed_beside(beside, expected, scale):
    """The tolerance is a length, whatever the radius."""
    radius = 0.3 * scale
    depth = beside * BESIDE
    ground = table((0j, 1 + 0j, 1.0), (1 + 0j, 1 + 0j, 1.0))
    body = discs((0j, radius), (APART, radius))
    centre = 0.1 * scale + 1j * math.sqrt((radius - depth) ** 2 - (0.1 * scale) ** 2)
    o = centre - 2.0 * scale
    far = centre + 50.0
    for sense in (-1.0, 1.0):
        swept = Swept(centre.real, centre.imag, far.real, far.imag, *EVERYWHERE)
        turn = turning(o, sense, 0.1)
        first = First(0.1, at.NO_FEATURE)
        angle, which = arcs_closing(scene(ground, body), 0, 0, turn, swept, first)
        falls = sense < 0.0 and expected is not None
        assert (angle, which) == ((expected, 0) if falls else (0.1, at.NO_FEATURE))


@MIRRORED
@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("onto", [-0.3, 0.0, 0.5, 1.2])
def test_a_disc_on_an_edge_rolls_on_along_the_segment_behind(onto, swapped, mirrored):
    """As soon as its centre stands over the edge, square to the segment; past that, never."""
    edge, radius, ahead = 0.4 + 0.3j, 0.07, 0.5
    behind = edge - cmath.exp(1j * onto)
    line = [
        (-9, behind.imag - 0.5),
        (behind.real, behind.imag),
        (edge.real, edge.imag),
        (1.4, -0.6),
    ]
    upright = math.pi / 2 + onto

    for left in (0.4, 1e-3, 5e-10, 0.0, -5e-10, -1e-8, -0.3):
        centre = edge + radius * cmath.exp(1j * (upright - left))
        phi = onto + 0.2  # the flat lies ahead of what it stands on
        far = centre + ahead * cmath.exp(1j * phi)
        part = [centre, far]
        row = [number for c in part for number in (c.real, c.imag, radius)]
        if swapped:
            row = [*row[3:], *row[:3]]
        case = Case(line, mirrored, [row])
        start = (case.ground, case.body), case.edge(edge), case.turned_pose(0j, 0.0), case.sign
        angle, closed = first_closing(*start, 0.6)
        if left < -1e-9:
            assert (closed, angle) == (at.NO_FEATURE, 0.6)
            continue
        kind = at.DISC_1 if (case.sign > 0.0) is not swapped else at.DISC_2
        assert closed == at.POINT * min(case.point(behind), case.point(edge)) + kind
        assert angle == pytest.approx(max(left, 0.0), abs=1e-12)
        assert angle >= 0.0


@MIRRORED
@pytest.mark.parametrize("apart", [0.0, 2e-12, -2e-12, 1e-6, -1e-6])
@pytest.mark.parametrize("phi", [0.0, 0.4])
def test_of_points_in_line_the_flat_comes_upon_the_outermost(phi, apart, mirrored):
    edge, upon = 0.5 + 0.2j, 0.2
    inner = edge - 0.05 * cmath.exp(1j * (phi + upon))
    outer = edge - 0.12 * cmath.exp(1j * (phi + upon + apart))
    case = Case(plates(outer, inner, edge), mirrored)
    c = edge + (0.02 + 0.1j) * cmath.exp(1j * phi)
    given = (case.ground, case.body), case.edge(edge), case.turned_pose(c, phi), case.sign
    angle, closed = first_closing(*given, 0.5)
    assert closed == case.edge(inner if apart > 1e-9 else outer)
    assert angle == near(upon + min(apart, 0.0))


@pytest.mark.parametrize("size", [0.05, 1.0, 6.0])
def test_a_point_that_a_flat_comes_upon_about_another_one(size):
    """Only between the ends of the flat, 0.3 and 1.1 of a size ahead of the centre of rotation."""
    rng = np.random.default_rng(2)
    o, radius, height = size * (0.3 - 0.2j), 0.1 * size, 0.25 * size
    first = 0.3 * size + 1j * (height + radius)
    body = discs((first, radius), (first + 0.8 * size, radius))
    found = []
    for _ in range(200):
        v = size * rng.uniform(0.3, 1.3) * cmath.exp(1j * rng.uniform(-1.2, 1.2))
        end = rng.uniform(0.2, 1.4)
        # turned back, the point is on the line of the flat
        turn = -1.0 if abs(v) <= height else math.asin(height / abs(v)) - cmath.phase(v)
        foot = v * cmath.exp(1j * turn)
        if turn < 0.01 or min(abs(foot.real / size - each) for each in (0.3, 1.1)) < 1e-6:
            continue
        ground = table((o + v, 1 + 0j, 1.0), (o, 1 + 0j, 1.0))
        meets = turn < end and 0.3 * size < foot.real < 1.1 * size
        about = turning(o, -1.0, end, at.POINT, at.At(o.real, o.imag, 1.0, 0.0))
        side = Side(True, 0.0, -1.0, height, -0.3 * size)
        first = First(end, at.NO_FEATURE)
        angle, which = flat_closing(scene(ground, body), 0, 0, TO_FLAT, about, side, first)
        assert (angle, which) == ((near(turn), 0) if meets else (end, at.NO_FEATURE))
        found.append(meets)
    assert 0.1 < np.mean(found) < 0.9


@pytest.mark.parametrize("radius", [0.004, 0.05])
def test_a_point_on_the_upper_side_is_met_by_parts_that_are_not_thin(radius):
    """Of a part of 8 mm that slants over a point, what lies above the axis has gone through it."""
    body = discs((-0.3 + 0j, radius), (0.3 + 0j, radius))
    for phi in (0.9, 1.6):
        pose = posed(0.0, 0.0, phi)
        for share, on in ((-0.31, False), (-0.2, True), (0.2, True), (0.31, False)):
            for side, piece in ((1j, TO_TOP), (-1j, TO_FLAT)):
                place = (share + side * radius) * cmath.exp(1j * phi)
                ground = table((place, 1 + 0j, 1.0), (1 + place, 1 + 0j, 1.0))
                met = on and (piece == TO_FLAT or radius > 0.01)
                assert on_piece(scene(ground, body), 0, 0, piece, pose) is met


def flat_of(first, second, upper):
    """Where the common tangent of two discs on one side leaves the first, and its direction."""
    (a, r), (b, q) = first, second
    axis = (b - a) / abs(b - a)
    lean = math.acos((r - q) / abs(b - a))
    normal = axis * cmath.exp(1j * (lean if upper else -lean))
    return a + r * normal, normal * (-1j if upper else 1j)


@pytest.mark.parametrize("piece", [TO_FLAT, TO_TOP, FROM_DISC_1, FROM_DISC_2])
def test_a_foot_lies_along_the_tangent_of_both_discs_or_along_the_segment(piece):
    rng = np.random.default_rng(8)
    for swapped in (False, True):
        for _ in range(20):
            first = -1.0 + 0.2j * rng.uniform(-1, 1), rng.uniform(0.05, 0.4)
            second = 1.0 + 0.2j * rng.uniform(-1, 1), rng.uniform(0.05, 0.4)
            both = (second, first) if swapped else (first, second)
            c, phi, v = random_place(rng, 3.0), random_direction(rng), random_place(rng, 3.0)
            u = random_direction(rng)
            ground = table((9j, 1 + 0j, 1.0), (v, u, 1.0))
            body = np.concatenate([discs((0j, 1.0), (9j, 2.0)), discs(*both)])
            placed = [(c + centre * phi, radius) for centre, radius in both]
            if piece in (TO_FLAT, TO_TOP):
                # from the first disc to the second the lower side may be on the left
                begin, direction = flat_of(*placed, (piece == TO_TOP) is not swapped)
                foot = along(direction, v - begin)[0]
            else:
                foot = along(u, placed[piece - FROM_DISC_1][0] - v)[0]
            pose = at.At(c.real, c.imag, phi.real, phi.imag)
            tables = scene(ground, body)
            assert foot_on(tables, 1, tables.body[1], piece, pose) == near(foot)


@pytest.mark.parametrize(("foot", "later", "sagitta", "beside"), [
    (1.2, 1.5, 0.1, True), (1.5, 1.2, 0.1, True), (1.2, 1.5, 0.25, False), (1.5, 1.2, 0.25, False),
    (-0.2, -0.5, 0.1, True), (-0.5, -0.2, 0.1, True), (-0.2, -0.5, 0.25, False),
    (-0.5, -0.2, 0.25, False), (1.5, 0.5, 0.0, False), (0.5, -1.0, 0.0, False),
    (-1.0, 2.0, 0.0, False), (2.0, -1.0, 0.0, False), (1.0, 1.0, 0.0, False), (0.0, 0.0, 0.0, False)
])  # fmt: skip
def test_a_foot_stays_beside_what_is_farther_off_than_its_arc_bulges(foot, later, sagitta, beside):
    """Of a metre, from 0 to 1."""
    assert stays_beside(foot, later, sagitta, 1.0) is beside


@pytest.mark.parametrize("ahead", [-1.0, 1.0])
@pytest.mark.parametrize("swings", [True, False])
@pytest.mark.parametrize("radius", [0.5, 2.0])
def test_a_foot_that_swings_out_to_a_piece_and_back_crosses_there(radius, swings, ahead):
    """Half a turn: its foot runs along half a circle, out and back to where it began."""
    beyond = 1e-3 if swings else -1e-3
    # a radius over the piece at first, level with it after a quarter turn
    length, offset = 5.0, beyond - radius if ahead < 0.0 else 5.0 + radius - beyond
    given = 0.0, radius, 0.0, -1.0, 0.0
    expected = crossing_angle(*given, PENETRATED)
    assert expected == near(math.pi / 2)
    found = crossing_angle_on(*given, length, offset, ahead)
    assert found == (expected if swings else NEVER)


def test_what_crosses_on_a_piece_is_not_left_out():
    rng = np.random.default_rng(9)
    left_out = 0
    for _ in range(4000):
        level, even, rate, offset = rng.normal(scale=(1.0, 1.0, 1.0, 2.0))
        end, ahead, length = rng.uniform(0.1, math.pi), rng.choice([-1.0, 1.0]), rng.uniform(0, 1)
        given = level, even, rate, math.cos(end), math.sin(end)
        expected = crossing_angle(*given, PENETRATED)
        found = crossing_angle_on(*given, length, offset, ahead)
        foot = offset + ahead * (rate * math.cos(expected) - even * math.sin(expected))
        if 0.0 <= foot <= length and expected <= end:
            assert found == expected
        assert found in (expected, NEVER)
        left_out += found != expected
    assert left_out > 200
