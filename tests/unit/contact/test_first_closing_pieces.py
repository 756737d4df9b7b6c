"""What a look for the first closing is made of, over random geometry, in complex numbers.

About a point O a body point p is O + (p - O) e^{ia}; on a disc of radius R that rolls along u its
centre moves by -R a u.
"""

import cmath
import math

import numpy as np
import pytest
from test_closing_pieces import discs, flat_of, random_direction, random_place, table

from kaidan.contact import layout as at
from kaidan.contact.kernel.closing import (
    FROM_DISC_1,
    FROM_DISC_2,
    TO_ARC_1,
    TO_ARC_2,
    TO_FLAT,
    TO_TOP,
    flat_normal,
    separation,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.first_closing import (
    curvature,
    rolling_closing,
    side_of,
    stays_under,
    swept_by,
    turn_about,
)
from kaidan.contact.layout import First, Swept
from kernel_memory import called, scene, turning

TIMES = 20
"""Random cases of each formula."""


def random_part(rng):
    """Body of a part of two discs, neither of which lies in the other; the discs."""
    first, second = rng.uniform(0.02, 0.4, 2)
    start = random_place(rng, 1.0)
    lever = (first + second + rng.uniform(0.05, 1.5)) * random_direction(rng)
    both = (start, first), (start + lever, second)
    return discs(*both), both


def pose(c, turn):
    """As the kernel has it: centroid, cosine and sine of the inclination."""
    return at.At(c.real, c.imag, turn.real, turn.imag)


def test_a_robot_turns_about_a_vertex_or_about_the_centre_of_the_end_that_rolls():
    rng = np.random.default_rng(1)
    for _ in range(TIMES):
        body, both = random_part(rng)
        rows = np.concatenate([discs((0j, 3.0), (9j, 3.0)), body])
        point, up, end = random_place(rng, 3.0), random_direction(rng), rng.uniform(0.1, 1.5)
        ground = table((9j, 1 + 0j, 1.0), (point, -1j * up, 1.0))
        c, phi = random_place(rng, 3.0), random_direction(rng)
        for kind in (at.VERTEX, at.DISC_1, at.DISC_2):
            turn = turn_about(
                scene(ground, rows), at.POINT + at.PART + kind, pose(c, phi), 1.0, end
            )
            if kind == at.VERTEX:
                assert (turn.h_x, turn.h_z, turn.radius) == (point.real, point.imag, 0.0)
                continue
            place, radius = both[kind - at.DISC_1]
            hub = c + place * phi
            # the point of the pivot is the foot of the centre on the segment's line
            foot = hub - ((hub - point) * up.conjugate()).real * up
            assert complex(turn.o_x, turn.o_z) == pytest.approx(foot)
            about = foot + radius * up
            assert (turn.h_x, turn.h_z) == pytest.approx((about.real, about.imag))
            assert turn.radius == radius


def test_what_a_disc_sweeps_is_its_chord_with_the_sagitta_of_its_arc():
    """The sagitta is R (1 - cos(a/2)), less than R a^2 / 8; |x| + |z| is no less than R."""
    rng = np.random.default_rng(2)
    for _ in range(TIMES):
        body, both = random_part(rng)
        c, about, phi = random_place(rng, 3.0), random_place(rng, 3.0), random_direction(rng)
        end, sense, rolls = rng.uniform(0.1, 1.57), rng.choice([-1.0, 1.0]), random_place(rng, 0.3)

        shares = np.linspace(0.0, 1.0, 9)
        turns = np.exp(1j * sense * end * shares)
        finish = pose(about + rolls + (c - about) * turns[-1], phi * turns[-1])
        turn = turning(0j, sense, end, 0, pose(c, phi), (finish, 0j), about)
        found = called(swept_by)(body[0], turn)
        for j, (place, radius) in enumerate(both):
            a = c + place * phi
            assert complex(*found[2 * j : 2 * j + 2]) == pytest.approx(a)
            lever = a - about
            over = (about + shares * rolls + lever * turns).real
            chord = sorted([over[0], over[-1]])
            room = end**2 / 8 * (abs(lever.real) + abs(lever.imag)) + radius
            left, right = found[4 + 2 * j : 6 + 2 * j]
            assert (left, right) == pytest.approx((chord[0] - room, chord[1] + room))
            assert left <= over.min() - radius
            assert over.max() + radius <= right


@pytest.mark.parametrize("piece", [TO_FLAT, TO_TOP])
def test_a_side_faces_down_if_it_does_so_before_or_after(piece):
    rng = np.random.default_rng(3)
    seen = set()
    for _ in range(TIMES):
        body, both = random_part(rng)
        c, phi, turn = random_place(rng, 3.0), random_direction(rng), random_direction(rng)
        point = random_place(rng, 3.0)
        a = c + both[0][0] * phi
        sense, end = math.copysign(1.0, turn.imag), abs(cmath.phase(turn))
        given = turning(point, sense, end, 0, pose(c, phi))
        swept = Swept(a.real, a.imag, *6 * (math.nan,))
        down, *normal, level, foot = called(side_of)(body[0], piece, given, swept)
        n = complex(*normal)
        assert n == pytest.approx(complex(*called(flat_normal)(body[0], piece, pose(0j, phi))))
        beyond = (point - a) * n.conjugate()
        assert level == pytest.approx(beyond.real - both[0][1])
        leads_back = bool((both[1][0] - both[0][0]).real < 0.0)
        placed = [(c + place * phi, radius) for place, radius in both]
        begin, direction = flat_of(*placed, (piece == TO_TOP) is not leads_back)
        assert foot == pytest.approx(((point - begin) * direction.conjugate()).real)
        assert down == (n.imag < 0.0 or (n * turn).imag < 0.0)
        seen.add((n.imag < 0.0, (n * turn).imag < 0.0))
    assert len(seen) == 4


def bound_of(piece, place, turn, swept=8 * (math.nan,)):
    """Bound on the curvature of a piece of the gap of a point."""
    return called(curvature)(piece, table((place, 1 + 0j, 1.0))[0], turn, swept)


def second_derivative(gap, angle):
    step = 1e-3
    return (gap(angle + step) - 2.0 * gap(angle) + gap(angle - step)) / step**2


@pytest.mark.parametrize("piece", [TO_FLAT, TO_TOP])
def test_a_flat_that_rolls_comes_no_sooner_than_a_parabola_about_a_vertex(piece):
    """Reached by a vertex over the centre; farther on, the vertex is as much farther as it rolled.

    The gap is (V - H) n less what does not change: its second derivative is -2 H' n' - (V - H) n,
    |H'| = R, |n'| = |n| = 1.
    """
    rng = np.random.default_rng(4)
    for radius in (0.05, 2.5):
        for far in (0.2, 5.0):
            u, n = random_direction(rng), np.exp(1j * np.linspace(-math.pi, math.pi, 721))
            for v in far * u * np.array([1j, 1.0, *np.exp(1j * rng.uniform(-3.0, 3.0, 3))]):
                for rolled in (0.0, 1.5 * radius):

                    def gap(angle, v=v, radius=radius, u=u, n=n):
                        return ((v + radius * angle * u) * (n * np.exp(1j * angle)).conj()).real

                    hub = random_place(rng, 3.0)
                    turn = turning(0j, 1.0, rolled / radius, about=hub, radius=radius)
                    bound = bound_of(piece, v + hub, turn)
                    bends = abs(second_derivative(gap, rolled / radius)).max()
                    assert bends <= bound + 1e-5
                    if rolled == 0.0 and v == far * u * 1j:
                        assert bends == pytest.approx(bound, abs=1e-4)


def test_a_disc_that_another_one_carries_comes_no_sooner_than_its_lever_lets_it():
    rng = np.random.default_rng(5)
    for _ in range(TIMES):
        first, second = random_place(rng, 3.0), random_place(rng, 3.0)
        hub = random_place(rng, 3.0)
        a, b = hub + first, hub + second
        swept = Swept(a.real, a.imag, b.real, b.imag, *4 * (math.nan,))
        for pieces, lever in ((TO_ARC_1, FROM_DISC_1), first), ((TO_ARC_2, FROM_DISC_2), second):
            for piece in pieces:
                bound = bound_of(piece, 9 + 9j, turning(0j, 1.0, 9.0, about=hub, radius=9.0), swept)
                assert bound == pytest.approx(abs(lever))


class Look:
    """A stadium stands on its rear end, whose point of contact is the origin, on level ground."""

    def __init__(self, length, radius, phi, sense, end):
        self.body = discs((0j, radius), (length + 0j, radius))
        hub, turn = 1j * radius, cmath.exp(1j * sense * end)
        start = pose(hub, cmath.exp(1j * phi))
        rolled = -sense * end * radius + 0j
        finish = pose(hub + rolled, cmath.exp(1j * phi) * turn)
        far = hub + length * cmath.exp(1j * phi)
        pivot = at.POINT + at.DISC_1
        self.turn = turning(0j, sense, end, pivot, start, (finish, rolled), hub, radius)
        self.swept = Swept(hub.real, hub.imag, far.real, far.imag, -1e9, 1e9, -1e9, 1e9)

    def first(self, ground, down, falls):
        """What the first row of the ground meets: piece's feature, angle."""
        first = First(self.turn.end, at.NO_FEATURE)
        best, which = rolling_closing(
            scene(ground, self.body), 0, 0, down, falls, self.turn, self.swept, first
        )
        return which, best


def test_an_end_that_rises_first_meets_what_it_comes_down_on():
    """From 60 degrees over the top: the far end is as high as it was when it falls onto 1.5 m."""
    look = Look(2.0, 0.1, math.radians(60), 1.0, math.pi / 2)
    ground = table((-9 + 1.5j, 1 + 0j, 9.0), (1.5j, 1 + 0j, 1.0))
    which, angle = look.first(ground, True, True)
    assert which == at.DISC_2
    assert angle == pytest.approx(math.pi - math.asin(0.75) - math.radians(60), abs=1e-9)


def test_sides_that_face_up_all_along_are_left_out_and_the_ends_are_not():
    """Nose down: of a vertex 1 m ahead the flat comes upon it, of one at the nose its end."""
    look = Look(2.0, 0.1, 0.6, -1.0, 0.6)
    on_the_way, at_the_nose = (
        table((place, -1j, 0.3), (place.real + 0j, 1 + 0j, 1.0))
        for place in (1 + 0.3j, 2.05 + 0.3j)
    )
    which, angle = look.first(on_the_way, True, False)
    assert which == at.VERTEX
    assert 0.0 < angle < 0.6
    assert look.first(on_the_way, False, False) == (at.NO_FEATURE, 0.6)
    which, angle = look.first(at_the_nose, False, False)
    assert which == at.VERTEX
    assert look.first(at_the_nose, True, True) == (which, angle)
    tables = scene(at_the_nose, look.body)
    there, moved = look_at(look, angle)
    value, _ = separation(
        tables, 0, tables.body[0], TO_ARC_2, there, moved.real, moved.imag, look.turn.sense
    )
    assert value == pytest.approx(0.0, abs=1e-9)


def look_at(look, angle):
    """Pose after part of a turn."""
    start, sense = look.turn.start, look.turn.sense
    turn = complex(start.c, start.s) * cmath.exp(1j * sense * angle)
    moved = -sense * angle * look.turn.radius + 0j
    return pose(complex(start.x, start.z) + moved, turn), moved


def test_a_point_stays_under_a_line_that_turns_if_it_does_so_before_and_after():
    rng = np.random.default_rng(6)
    found = []
    for _ in range(200):
        o, n, v = random_place(rng, 3.0), random_direction(rng), random_place(rng, 1.0)
        height, turn = -rng.uniform(0.0, 0.3), rng.choice([-1.0, 1.0]) * rng.uniform(0.1, 2.0)
        looks = (v * (n * np.exp(1j * turn * np.linspace(0.0, 1.0, 99))).conj()).real
        if min(abs(looks[[0, -1]] - height)) < 1e-9:
            continue
        place = o + v
        ground = table((place, 1 + 0j, 1.0))
        line = n.real, n.imag, height
        given = turning(o, math.copysign(1.0, turn), abs(turn), line=line)
        under = called(stays_under)(ground[0], given)
        assert under == (looks.max() < height)
        found.append(under)
    assert 0.1 < np.mean(found) < 0.9


@pytest.mark.parametrize("height", [0.0, 1.0, -1e-3])
@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize(("over", "under"), [(0.49, True), (0.51, False)])
def test_half_of_what_is_penetrated_is_under(over, under, sense, height):
    """Before or after; a line over the pivot is no higher than through it."""
    n, level = 0.6 + 0.8j, min(height, 0.0) + over * PENETRATED
    turn = np.exp(1j * sense * 0.7)
    for place in ((level - 1j * sense) * n, (level + 1j * sense) * n * turn):
        ground = table((place, 1 + 0j, 1.0))
        given = turning(0j, sense, 0.7, line=(n.real, n.imag, height))
        assert called(stays_under)(ground[0], given) == under


def test_an_end_that_swings_out_to_a_short_edge_and_back_meets_it():
    """Under an edge of 0.1 m, 1.9 to 2 m ahead; before and after it is 0.15 m short of that."""
    look = Look(2.0, 0.1, -0.5, 1.0, 1.0)
    ground = table((2 + 0.2j, -1 + 0j, 0.1), (0j, 1 + 0j, 1.0))
    ground["convex"] = False  # the edge itself, and not its corners
    which, angle = look.first(ground, True, True)
    assert which == at.DISC_2
    assert angle == pytest.approx(0.5, abs=1e-9)
