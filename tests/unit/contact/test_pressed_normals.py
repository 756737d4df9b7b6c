"""Normal of a contact under a belt that gives way, by hand: flat, in between, arc."""

import math

import numpy as np
import pytest

from kaidan.contact import body_table, ground_table
from kaidan.contact.kernel.gaps import YIELD, gap, pressed_normal
from kaidan.contact.layout import PART, POINT, At
from kernel_memory import posed, scene

L, R = 0.5, 0.1
TRACK = [-0.2, 0.05, R, 0.3, 0.05, R]
FIRST = math.sqrt(2.0 * R * YIELD * L) / R  # arc up to which the belt carries as the flat [rad]


def vertex_under_arc(angle, end, parts=(TRACK,), lean=0.0):
    """Normals of a vertex so far round an end's arc, rigid and as the belt gives way [rad]."""
    b_x = 0.3 + R * math.sin(angle) if end > 0 else -0.2 - R * math.sin(angle)
    b_z = 0.05 - R * math.cos(angle)
    c, s = math.cos(lean), math.sin(lean)
    x, z = c * b_x - s * b_z, s * b_x + c * b_z
    ground = ground_table([(x - 2.0, z - 1.0), (x, z), (x + 2.0, z - 1.0)])
    body = body_table(list(parts))
    feature = POINT * 1 + PART * 0
    distance, n_x, n_z, _, _ = gap(scene(ground, body), feature, At(0.0, 0.0, c, s))
    assert abs(distance) < 1e-12
    p_x, p_z = pressed_normal(scene(ground, body), feature, At(0.0, 0.0, c, s), n_x, n_z)
    assert math.hypot(p_x, p_z) == pytest.approx(1.0, abs=1e-12)
    return math.atan2(n_x, n_z), math.atan2(p_x, p_z)


@pytest.mark.parametrize("end", [1, -1])
@pytest.mark.parametrize(
    ("share", "of_arc"),
    [
        (-0.5, 0.0),
        (0.0, 0.0),
        (0.5, 0.0),
        (1.0, 0.0),
        (2.0, 1.5),
        (2.8, 2.7),
        (3.0, 3.0),
        (5.0, 5.0),
    ],
)
def test_it_turns_from_that_of_the_flat_to_that_of_the_arc(share, of_arc, end):
    if share < 0:  # on the flat
        ground = ground_table([(-2.0, -1.05), (0.0, -0.05), (2.0, -1.05)])
        found = pressed_normal(
            scene(ground, body_table([TRACK])), POINT, At(0.0, 0.0, 1.0, 0.0), 0.0, 1.0
        )
        assert found == (0.0, 1.0)
        return
    rigid, pressed = vertex_under_arc(share * FIRST, end)
    assert rigid == pytest.approx(-end * share * FIRST, abs=1e-12)
    assert pressed == pytest.approx(-end * of_arc * FIRST, abs=1e-12)


def test_a_flipper_in_line_makes_a_flat_of_its_own():
    """Of two flats that end on one disc the nearer one counts: 90 degrees on it is another's."""
    raised = [0.3, 0.05, R, 0.3 + 0.4 * math.cos(0.5), 0.05 + 0.4 * math.sin(0.5), R]
    own = math.sqrt(2.0 * R * YIELD * 0.4) / R
    _, pressed = vertex_under_arc(0.5 + 0.5 * own, 1, (TRACK, raised))
    assert abs(pressed) == pytest.approx(0.5, abs=1e-9)


def test_a_normal_more_upright_than_the_flats_stays():
    rigid, pressed = vertex_under_arc(0.5 * FIRST, -1, lean=0.2)
    assert pressed == rigid == pytest.approx(-0.2 + 0.5 * FIRST, abs=1e-12)
    rigid, pressed = vertex_under_arc(0.5 * FIRST, 1, lean=0.2)
    assert pressed == pytest.approx(-0.2, abs=1e-12)


def test_a_small_end_is_an_edge():
    """Of 5 mm no more than 0.75 rad of arc is touched by the belt's yield."""
    small = [-0.2, 0.005, 0.005, 0.3, 0.005, 0.005]
    angle = 0.76
    x, z = 0.3 + 0.005 * math.sin(angle), 0.005 - 0.005 * math.cos(angle)
    ground = ground_table([(x - 2.0, z - 1.0), (x, z), (x + 2.0, z - 1.0)])
    normal = (-math.sin(angle), math.cos(angle))
    assert (
        pressed_normal(scene(ground, body_table([small])), POINT, At(0, 0, 1, 0), *normal) == normal
    )


def test_what_stands_on_a_tread_has_its_normal():
    ground = ground_table([(-2.0, 0.0), (2.0, 0.0)])
    disc = POINT * 0 + PART * 0 + 2
    found = pressed_normal(
        scene(ground, body_table([TRACK])), disc, At(0.0, 0.05, 1.0, 0.0), 0.0, 1.0
    )
    assert found == (0.0, 1.0)


TAPERED = [-0.3, 0.02, 0.08, 0.2, -0.11, 0.05]
BACKWARD = [0.25, -0.02, 0.06, -0.3, 0.05, 0.07]  # the second disc lies behind the first
ELSEWHERE = [
    [-0.3, 0.02, 0.03, 0.2, 0.3, 0.03], [0.2, -0.11, 0.02, -0.3, 0.3, 0.02],
    [-0.3, 0.4, 0.08, 0.25, 0.4, 0.06], [0.2, 0.5, 0.05, -0.3, 0.5, 0.07],
    [-0.6, 0.02, 0.08, 0.6, -0.11, 0.05], [0.9, -0.02, 0.06, -0.9, 0.05, 0.07],
]  # fmt: skip
"""Each disc has a twin here of another radius, one at another height and one at another place."""


SHORT = [0.05, 0.3, 0.1, 0.12, 0.22, 0.06]
FAR_OFF = [-0.9, -0.8, 0.03, -0.88, -0.83, 0.05]  # far from the centroid, the discs all but one


@pytest.mark.parametrize("phi", [0.0, 0.5, -0.4, 1.1, -1.2])
@pytest.mark.parametrize("end", [0, 1])
@pytest.mark.parametrize("part", [TAPERED, BACKWARD, SHORT, FAR_OFF])
def test_under_any_end_of_any_part_in_any_pose(part, end, phi):
    """As above, the flat's normal and its length worked out in complex numbers."""
    a, b = complex(*part[:2]), complex(*part[3:5])
    e = (b - a) / abs(b - a)
    sine = (part[2] - part[5]) / abs(b - a)
    ahead = 1.0 if b.real > a.real else -1.0
    n = sine * e - 1j * ahead * e * math.sqrt(1.0 - sine**2)  # of the flat, downward
    sense = ahead if end else -ahead  # in which the normal turns round this end
    radius, centre = (part[5], b) if end else (part[2], a)
    length = abs(b - a) * math.sqrt(1.0 - sine**2)
    first = min(math.sqrt(2.0 * radius * YIELD * length) / radius, 0.25)
    at, turn = complex(1.3, 0.7), np.exp(1j * phi)
    for share, of_arc in ((0.6, 0.0), (1.5, 0.75), (2.8, 2.7), (3.5, 3.5)):
        outward = n * np.exp(1j * sense * share * first)
        p = at + (centre + radius * outward) * turn
        ground = ground_table(
            [(p.real - 2, p.imag - 9), (p.real, p.imag), (p.real + 2, p.imag - 9)]
        )
        (k,) = np.flatnonzero(np.abs(ground["x"] - p.real) < 1e-9)
        rigid = -outward * turn
        up = (-n * turn).imag
        pressed = rigid if rigid.imag >= up else -n * np.exp(1j * sense * of_arc * first) * turn
        for parts, row in (([part], 0), ([*ELSEWHERE, part], 6), ([part, *ELSEWHERE], 0)):
            there, where = scene(ground, body_table(parts)), posed(at.real, at.imag, phi)
            feature = POINT * k + PART * row
            found = pressed_normal(there, feature, where, rigid.real, rigid.imag)
            assert found == pytest.approx((pressed.real, pressed.imag), abs=1e-9)
