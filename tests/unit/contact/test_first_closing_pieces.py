"""What a look for the first closing is made of, over random geometry, in complex numbers.

About a point O a body point p is O + (p - O) e^{ia}; on a disc of radius R that rolls along u its
centre moves by -R a u.
"""

import cmath
import math

import numpy as np
import pytest
from test_closing_pieces import discs, flat_of, random_direction, random_place, table

from kaidan.contact import columns as at
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
    swept,
    turning_about,
)

TIMES = 20
"""Random cases of each formula."""


def random_part(rng):
    """Body of a part of two discs, neither of which lies in the other; the discs."""
    first, second = rng.uniform(0.02, 0.4, 2)
    start = random_place(rng, 1.0)
    lever = (first + second + rng.uniform(0.05, 1.5)) * random_direction(rng)
    both = (start, first), (start + lever, second)
    return discs(*both), both


def pose(c, turn, point=0j):
    """As the kernel has it: centroid, cosine and sine of the inclination, point of the pivot."""
    return c.real, c.imag, turn.real, turn.imag, point.real, point.imag


def test_a_robot_turns_about_a_vertex_or_about_the_centre_of_the_end_that_rolls():
    rng = np.random.default_rng(1)
    for _ in range(TIMES):
        body, both = random_part(rng)
        rows = np.vstack([discs((0j, 3.0), (9j, 3.0)), body])
        point, up, end = random_place(rng, 3.0), random_direction(rng), rng.uniform(0.1, 1.5)
        ground = table((9j, 1 + 0j, 1.0), (point, -1j * up, 1.0))
        radii = [radius for _, radius in both]
        for kind, radius in zip((at.VERTEX, at.DISC_1, at.DISC_2), (0.0, *radii), strict=True):
            centre = point + radius * up
            about = turning_about(
                ground, rows, at.POINT + at.PART + kind, point.real, point.imag, end
            )
            assert about == pytest.approx((centre.real, centre.imag, radius, radius * end))


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
        centres, ranges = swept(body, 0, pose(c, phi), finish, about.real, about.imag, end)
        for j, (place, radius) in enumerate(both):
            a = c + place * phi
            assert complex(*centres[2 * j : 2 * j + 2]) == pytest.approx(a)
            lever = a - about
            over = (about + shares * rolls + lever * turns).real
            chord = sorted([over[0], over[-1]])
            room = end**2 / 8 * (abs(lever.real) + abs(lever.imag)) + radius
            left, right = ranges[2 * j : 2 * j + 2]
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
        down, *normal, level, foot = side_of(
            body, 0, piece, pose(c, phi, point), a.real, a.imag, turn.real, turn.imag
        )
        n = complex(*normal)
        assert n == pytest.approx(complex(*flat_normal(body, 0, piece, phi.real, phi.imag)))
        beyond = (point - a) * n.conjugate()
        assert level == pytest.approx(beyond.real - both[0][1])
        leads_back = bool((both[1][0] - both[0][0]).real < 0.0)
        placed = [(c + place * phi, radius) for place, radius in both]
        begin, direction = flat_of(*placed, (piece == TO_TOP) is not leads_back)
        assert foot == pytest.approx(((point - begin) * direction.conjugate()).real)
        assert down == (n.imag < 0.0 or (n * turn).imag < 0.0)
        seen.add((n.imag < 0.0, (n * turn).imag < 0.0))
    assert len(seen) == 4


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
        levers = 0.0, 0.0, 0.0, 0.0
        for far in (0.2, 5.0):
            u, n = random_direction(rng), np.exp(1j * np.linspace(-math.pi, math.pi, 721))
            for v in far * u * np.array([1j, 1.0, *np.exp(1j * rng.uniform(-3.0, 3.0, 3))]):
                for rolled in (0.0, 1.5 * radius):

                    def gap(angle, v=v, radius=radius, u=u, n=n):
                        return ((v + radius * angle * u) * (n * np.exp(1j * angle)).conj()).real

                    hub = random_place(rng, 3.0)
                    about = hub.real, hub.imag, radius, rolled
                    g = v + hub
                    bound = curvature(piece, g.real, g.imag, levers, about)
                    bends = abs(second_derivative(gap, rolled / radius)).max()
                    assert bends <= bound + 1e-5
                    if rolled == 0.0 and v == far * u * 1j:
                        assert bends == pytest.approx(bound, abs=1e-4)


def test_a_disc_that_another_one_carries_comes_no_sooner_than_its_lever_lets_it():
    rng = np.random.default_rng(5)
    for _ in range(TIMES):
        first, second = random_place(rng, 3.0), random_place(rng, 3.0)
        levers = first.real, first.imag, second.real, second.imag
        for pieces, lever in ((TO_ARC_1, FROM_DISC_1), first), ((TO_ARC_2, FROM_DISC_2), second):
            for piece in pieces:
                bound = curvature(piece, 9.0, 9.0, levers, (9.0, 9.0, 9.0, 9.0))
                assert bound == pytest.approx(abs(lever))


class Look:
    """A stadium stands on its rear end, whose point of contact is the origin, on level ground."""

    def __init__(self, length, radius, phi, sense, end):
        self.body = discs((0j, radius), (length + 0j, radius))
        self.given = sense, end
        hub, turn = 1j * radius, cmath.exp(1j * sense * end)
        self.start = pose(hub, cmath.exp(1j * phi))
        rolled = -sense * end * radius
        self.finish = pose(hub + rolled, cmath.exp(1j * phi) * turn, rolled + 0j)
        lever = length * cmath.exp(1j * phi)
        self.levers = 0.0, 0.0, lever.real, lever.imag
        self.about = 0.0, radius, radius, radius * end

    def first(self, ground, down, falls):
        """What the first row of the ground meets: piece's feature, angle."""
        everywhere = -1e9, 1e9, -1e9, 1e9
        best, which = rolling_closing(
            ground, self.body, 0, 0, at.POINT + at.DISC_1, down, falls, self.start, self.finish,
            *self.given, self.about, self.levers, everywhere, self.given[1], at.NO_FEATURE,
        )  # fmt: skip
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
    value, _ = separation(
        at_the_nose, look.body, 0, 0, TO_ARC_2, *look_at(look, angle), look.given[0]
    )
    assert value == pytest.approx(0.0, abs=1e-9)


def look_at(look, angle):
    """Pose after part of a turn."""
    sense, _ = look.given
    turn = complex(*look.start[2:4]) * cmath.exp(1j * sense * angle)
    moved = -sense * angle * look.about[2]
    return pose(complex(*look.start[:2]) + moved, turn, moved + 0j)


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
        ground = table((9j, 1 + 0j, 1.0), (place, 1 + 0j, 1.0))
        under = stays_under(
            ground, 1, o.real, o.imag, math.cos(turn), math.sin(turn), (n.real, n.imag, height)
        )
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
        given = turn.real, turn.imag, (n.real, n.imag, height)
        assert stays_under(ground, 0, 0.0, 0.0, *given) == under


def test_an_end_that_swings_out_to_a_short_edge_and_back_meets_it():
    """Under an edge of 0.1 m, 1.9 to 2 m ahead; before and after it is 0.15 m short of that."""
    look = Look(2.0, 0.1, -0.5, 1.0, 1.0)
    ground = table((2 + 0.2j, -1 + 0j, 0.1), (0j, 1 + 0j, 1.0))
    ground[:, at.CONVEX] = 0.0  # the edge itself, and not its corners
    which, angle = look.first(ground, True, True)
    assert which == at.DISC_2
    assert angle == pytest.approx(0.5, abs=1e-9)
