"""Falls over edges against rigid motion and plastic impacts, worked out beside them.

A flat of 0.6 m, its centroid 0.1 m above the middle and discs of 0.05 m at its ends, lies on an
edge A. The centroid is beyond it: it rotates about A, then perhaps about an edge B, until the disc
meets the ground::

         C
    -----A------
         |____B
              |____________ ground
"""

import cmath
import math

import numpy as np
import pytest

from kaidan.contact import RotationOutcome, body_table, ground_table, mirror
from kaidan.contact.kernel.gaps import contact_point
from kaidan.contact.kernel.toppling import fall, rates, same_place
from kaidan.contact.layout import Release
from kernel_memory import posed, scene

HALF, ABOVE, RADIUS = 0.3, 0.1, 0.05
GYRATION, GRAVITY = 0.15, 9.7
ROUNDING = 1e-9  # m, rad, rad/s: a closing is found to 1e-12 rad
PARTS = [[-HALF, RADIUS - ABOVE, RADIUS, HALF, RADIUS - ABOVE, RADIUS]]
A, B = 0.7 + 0.2j, 0.8 + 0.15j
FIRST = math.atan2(0.05, 0.1)
"""Inclination at which the flat lies on both edges."""


def terrain(edges, low):
    """One edge or both, and the ground below them."""
    corners = [A, A.real + 0.15j, B] if edges == 2 else [A]
    edge = corners[-1].real
    return [(-2, A.imag), *((p.real, p.imag) for p in corners), (edge, low), (5, low)]


def fallen(edges, low, beyond, phi, kappa, mirrored):
    """Answer of the kernel with the contacts as points, of the case as it is drawn."""
    return fallen_over(terrain(edges, low), beyond, phi, kappa, mirrored)


def fallen_over(line, beyond, phi, kappa, mirrored):
    """The same over any ground that has the edge A."""
    parts, sign = PARTS, 1.0
    if mirrored:
        line, parts = mirror(line, parts)
        sign = -1.0
    ground, body = ground_table(line), body_table(parts)
    edge = int(np.flatnonzero(np.hypot(ground["x"] - sign * A.real, ground["z"] - A.imag) == 0)[0])
    place = A + (beyond + 1j * ABOVE) * cmath.exp(1j * phi)
    release = Release(sign * place.real, place.imag, sign * phi, -sign, sign * kappa)
    found = fall(scene(ground, body), 64 * edge, release, GYRATION, GRAVITY)
    outcome, rear, front, x, z, end, before, after, turned = found
    points = []
    for feature in (rear, front)[:: int(sign)]:
        if feature >= 0:
            p_x, p_z = contact_point(scene(ground, body), feature, posed(x, z, end))
            points.append(complex(sign * p_x, p_z))
    return outcome, points, complex(sign * x, z), sign * end, before, after, turned


def near(value):
    return pytest.approx(value, abs=ROUNDING)


def speed_and_impact(energy, one, other):
    """Rates before and after a plastic impact [rad/s], and the energy that is left [J/kg]."""
    square = GYRATION**2
    before = math.sqrt(2 * energy / (square + abs(one) ** 2))
    kept = square + (one * other.conjugate()).real
    after = max(before * kept / (square + abs(other) ** 2), 0.0)
    return before, after, after**2 * (square + abs(other) ** 2) / 2


def onto_the_ground(height, reach):
    """Inclination at which the disc touches, and its contact from the edge.

    height = reach sin(angle) + RADIUS (1 - cos(angle)), with the angle of the disc's centre.
    """
    far, rise = math.hypot(reach, RADIUS), math.atan2(RADIUS, reach)
    angle = rise + math.asin((height - RADIUS) / far)
    return angle, far * math.cos(angle - rise) - 1j * height


def fallen_by(start, end, kappa):
    """Work of effective gravity [J/kg]."""
    way = start - end
    return GRAVITY * (way.imag + kappa * way.real) / math.hypot(1.0, kappa)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize(("beyond", "kappa"), [(0.05, 0.0), (0.02, 0.15), (0.05, -0.1)])
def test_a_fall_over_an_edge_onto_the_ground(beyond, kappa, mirrored):
    angle, to_tip = onto_the_ground(0.2, beyond + HALF)
    start = A + beyond + 1j * ABOVE
    end = A + (beyond + 1j * ABOVE) * cmath.exp(-1j * angle)
    tip = A + to_tip
    before, after, _ = speed_and_impact(fallen_by(start, end, kappa), end - A, end - tip)
    outcome, points, *rest = fallen(1, 0.0, beyond, 0.0, kappa, mirrored)
    assert outcome == RotationOutcome.ARRESTED
    assert points == [near(A), near(tip)]
    assert rest == [near(end), near(-angle), near(before), near(after), near(angle)]


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("kappa", [0.0, 0.15, -0.1])
def test_a_fall_that_goes_on_about_a_second_edge(kappa, mirrored):
    """The flat rotates by 26.6 degrees onto B, with the centroid still ahead, and goes on."""
    beyond = 0.2
    start = A + beyond + 1j * ABOVE
    on_b = A + (beyond + 1j * ABOVE) * cmath.exp(-1j * FIRST)
    _, _, left = speed_and_impact(fallen_by(start, on_b, kappa), on_b - A, on_b - B)
    reach = beyond + HALF - abs(B - A)
    angle, to_tip = onto_the_ground(B.imag + 0.1, reach)
    end = B + (on_b - B) * cmath.exp(-1j * (angle - FIRST))
    tip = B + to_tip
    energy = left + fallen_by(on_b, end, kappa)
    before, after, _ = speed_and_impact(energy, end - B, end - tip)
    outcome, points, *rest = fallen(2, -0.1, beyond, 0.0, kappa, mirrored)
    assert outcome == RotationOutcome.ARRESTED
    assert points == [near(B), near(tip)]
    assert rest == [near(end), near(-angle), near(before), near(after), near(angle)]


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("later", [1e-3, 1e-9])
def test_contacts_that_close_at_once_are_one_impact(later, mirrored):
    """The disc meets the ground as the flat comes onto B: what B takes of the rate is not asked.

    It is arrested by the edge that still touches.
    """
    beyond, angle = 0.2, FIRST + later
    reach = beyond + HALF - abs(B - A)
    low = B.imag - reach * math.sin(angle) - RADIUS * (1 - math.cos(angle))
    start = A + beyond + 1j * ABOVE
    on_b = A + (beyond + 1j * ABOVE) * cmath.exp(-1j * FIRST)
    end = B + (on_b - B) * cmath.exp(-1j * later)
    tip = B + onto_the_ground(B.imag - low, reach)[1]
    before, after, _ = speed_and_impact(fallen_by(start, end, 0.0), end - A, end - tip)
    outcome, points, *rest = fallen(2, low, beyond, 0.0, 0.0, mirrored)
    assert outcome == RotationOutcome.ARRESTED
    assert points == [near(B if later > 1e-6 else A), near(tip)]
    assert rest == [near(end), near(-angle), near(before), near(after), near(angle)]


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("phi", [0.1, -0.1])
def test_a_fall_past_the_vertical(phi, mirrored):
    """It ends 90 degrees on, or upright if that comes first; nothing arrests it."""
    angle = min(math.pi / 2, math.pi / 2 + phi)
    arm = (0.1 + 1j * ABOVE) * cmath.exp(1j * phi)
    end = A + arm * cmath.exp(-1j * angle)
    before, _, _ = speed_and_impact(fallen_by(A + arm, end, 0.0), arm, arm)
    outcome, points, *rest = fallen(1, -3.0, 0.1, phi, 0.0, mirrored)
    assert outcome == RotationOutcome.PAST_VERTICAL
    assert len(points) == 1
    assert rest == [near(end), near(phi - angle), near(before), 0.0, near(angle)]


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_fall_about_two_edges_ends_90_degrees_on(mirrored):
    outcome, _, _, phi, *_, turned = fallen(2, -3.0, 0.2, 0.1, 0.0, mirrored)
    assert outcome == RotationOutcome.PAST_VERTICAL
    assert (phi, turned) == (near(0.1 - math.pi / 2), near(math.pi / 2))


def test_past_the_vertical_already_it_turns_no_farther():
    outcome, _, _, phi, *_, turned = fallen(1, -3.0, 0.1, -1.7, 0.0, False)
    assert (outcome, phi, turned) == (RotationOutcome.PAST_VERTICAL, -1.7, 0.0)


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_fall_wedges_between_an_edge_and_a_wall(mirrored):
    """As the nose falls the tail, which hangs below the edge, goes back until it meets the wall."""
    end, beyond = 0.5, 0.15
    tail = complex(beyond - HALF, RADIUS)
    wall = A.real + (tail * cmath.exp(1j * end)).real - RADIUS
    spike = [(A.real - 0.02, -0.5), (A.real, A.imag), (A.real + 0.02, -0.5)]
    line = [(-2, 0.9), (wall, 0.9), (wall, -0.5), *spike, (5, -0.5)]
    outcome, points, place, phi, _, _, turned = fallen_over(line, beyond, 0.7, 0.0, mirrored)
    assert outcome == RotationOutcome.WEDGED
    assert points == [near(A)]
    assert place == near(A + (beyond + 1j * ABOVE) * cmath.exp(1j * end))
    assert (phi, turned) == (near(end), near(0.2))


@pytest.mark.parametrize("off", [(3e-6, -1e-6), (1e-6, -3e-6)])
def test_contacts_are_one_where_their_points_are(off):
    """An edge, the end that stands on it, and another edge 3 um farther or lower."""
    ground = ground_table([(-2, 0.5), (1, 0.5), (1 + off[0], 0.5 + off[1]), (5, -1)])
    body = body_table(PARTS)
    pose = posed(1 + HALF, 0.5 + ABOVE, 0.0)  # its rear end on the edge
    assert same_place(scene(ground, body), 64, 1, pose)
    assert not same_place(scene(ground, body), 64, 128, pose)


def test_rates_of_an_impact():
    """Energy over half the square of inertia; of no energy none; none after no contact."""
    ground = ground_table([(-2, 0.0), (0.0, 0.0), (0.3, -0.4), (5, -1)])
    body, point = body_table(PARTS), 64
    x, z = 0.05, 0.1
    square = GYRATION**2 + abs(complex(x, z)) ** 2
    for energy in (0.5, 1e-3, 0.0, -0.1):
        before = math.sqrt(2.0 * max(energy, 0.0) / square)
        found = rates(scene(ground, body), point, -1, posed(x, z, 0.0), GYRATION**2, energy)
        assert found == (near(before), 0.0, 0.0)
        found = rates(scene(ground, body), point, 128, posed(x, z, 0.0), GYRATION**2, energy)
        _, after, left = speed_and_impact(
            max(energy, 0.0), complex(x, z), complex(x - 0.3, z + 0.4)
        )
        assert found == (near(before), near(after), near(left))


@pytest.mark.parametrize("spacing", [9.0, 0.05, 0.01])
@pytest.mark.parametrize("phi", [1.2, 0.6, -0.4])
def test_it_rolls_on_one_end_until_the_centroid_hangs_below(phi, spacing):
    """A disc of 0.5 m, the centroid 0.2 m below its centre: it rocks, over any points."""
    # points of a hill that is level to 4 um, so that they are not all in one line
    inner = np.arange(-0.7, 0.7, spacing) + 1e-3 if spacing < 1.0 else []
    ground = ground_table([(-4, 0), *((x, 1e-5 * (0.5 - x * x)) for x in inner), (4, 0)])
    assert len(ground) > len(inner)
    body = body_table([[0.0, 0.2, 0.5, 0.1, 0.6, 0.1]])
    centre = 0.5j  # at x = 0
    start = centre + 5e-6j * (spacing < 1.0) - 0.2j * cmath.exp(1j * phi)
    k = int(np.flatnonzero(ground["x"] <= 0.0)[-1])
    sense = -math.copysign(1.0, phi)
    outcome, _, _, x, z, end, before, after, turned = fall(
        scene(ground, body),
        64 * k + 1,
        Release(start.real, start.imag, phi, sense, 0.0),
        GYRATION,
        GRAVITY,
    )
    assert outcome == RotationOutcome.ROCKING
    about = [pytest.approx(each, abs=1e-4) for each in (0.5 * phi, 0.3, 0.0, abs(phi))]
    assert [x, z, end, turned] == about
    drop = 0.2 * (1.0 - math.cos(phi))
    expected = math.sqrt(2.0 * GRAVITY * drop / (GYRATION**2 + 0.3**2))
    assert before == pytest.approx(expected, abs=1e-3)
    assert (after == 0.0) == (spacing > 1.0)  # each point is an impact, that takes next to nothing
