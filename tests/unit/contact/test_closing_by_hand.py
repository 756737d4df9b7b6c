"""At which angle a gap closes: a sinusoid by its phase, an end that rolls by bisection.

The gap of a rotation about a point is level + size cos(angle - phase): it goes down through zero at
phase + acos(-level / size).
"""

import cmath
import math

import numpy as np
import pytest
from test_reserves_by_hand import (
    ABOVE,
    ARM,
    BEHIND,
    HALF,
    LOW,
    MIRRORED,
    PARTS,
    RADIUS,
    Case,
    near,
    plates,
)  # fmt: skip

from kaidan.contact import layout as at
from kaidan.contact.kernel import first_closing as module
from kaidan.contact.kernel.closing import BESIDE, crossing_angle
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.rotation import NEVER
from kernel_memory import called

first_closing = called(module.first_closing)


def crossing(level, size, phase, end, deep=PENETRATED):
    even, rate = size * math.cos(phase), size * math.sin(phase)
    return crossing_angle(level, even, rate, math.cos(end), math.sin(end), deep)


def test_a_sinusoid_goes_down_through_zero_by_its_phase():
    rng = np.random.default_rng(0)
    found = []
    for _ in range(3000):
        size, phase = rng.uniform(0.1, 3.0), rng.uniform(-math.pi, math.pi)
        level, end = size * rng.uniform(-1.3, 1.3), rng.uniform(0.05, math.pi / 2)
        if level + size * math.cos(phase) < 0.01 * size:
            continue
        root = math.inf
        if abs(level) < size:
            root = (phase + math.acos(-level / size)) % (2 * math.pi)
        if abs(root - end) < 1e-6:
            continue
        angle = crossing(level, size, phase, end)
        assert angle == (near(root) if root < end else NEVER)
        found.append(root < end)
    assert 0.1 < np.mean(found) < 0.9


def below(start, phase, end, deep=PENETRATED):
    """Closing of a gap of size 1 that is `start` at the start."""
    return crossing(start - math.cos(phase), 1.0, phase, end, deep)


FALLS, GROWS = -0.5, 0.5
"""Phases: behind its top at the start, before it."""


@pytest.mark.parametrize("scale", [1.0, 3.0])
def test_what_has_sunk_in_and_falls_closes_at_once_unless_it_has_passed_beside(scale):
    deep = scale * PENETRATED
    for start in (0.0, -0.4 * deep, -0.6 * deep, -0.99 * BESIDE * scale):
        assert below(start, FALLS, 0.3, deep) == pytest.approx(0.0, abs=2e-12), start
    assert below(-1.01 * BESIDE * scale, FALLS, 0.3, deep) == NEVER
    # what grows closes once it has grown and falls again
    for start in (0.0, -0.5 * BESIDE * scale, -1.5 * BESIDE * scale):
        root = GROWS + math.acos(math.cos(GROWS) - start)
        assert below(start, GROWS, 1.2, deep) == near(root)
        assert below(start, GROWS, 0.8, deep) == NEVER


def test_what_has_sunk_in_and_grows_is_still_in_at_the_end():
    for start in (-0.5 * BESIDE, -1.5 * BESIDE):
        assert below(start, GROWS, 0.01) > 0.01
    # past the lowest point of a short dip, which ends 0.118 rad later
    assert crossing(0.95, 1.0, math.pi - 0.2, 0.05) > 0.05


def test_within_what_counts_as_sunk_in():
    """The least value of a gap of size 1, or where one begins, as a share of it."""
    for share, closes in ((1.5, False), (0.5, False), (-0.5, False), (-1.5, True)):
        angle = crossing(1.0 + share * PENETRATED, 1.0, math.pi + 0.3, 0.6)
        # lowest after 0.3 rad; within sqrt(2 * 1.5 * PENETRATED) of that it is below zero
        assert angle == (pytest.approx(0.3, abs=3e-6) if closes else NEVER), share
    # slowly: 0.1 um/rad
    for share, angle in ((0.25, 5e-6), (-0.25, 0.0), (-0.75, 0.0), (-1.25, 0.0)):
        found = crossing_angle(share * PENETRATED, 0.0, -1e-7, 0.8, 0.6, PENETRATED)
        assert found == pytest.approx(angle, abs=1e-9), share
    # at rest on its top just below zero: the pivot under another name
    for rate in (0.0, 0.5e-9, -0.5e-9):
        found = crossing_angle(-1.0 - 0.75 * PENETRATED, 1.0, rate, 0.8, 0.6, PENETRATED)
        assert found == NEVER


def test_what_is_never_positive_never_closes():
    assert crossing(-1.0, 1.0, 0.0, 0.5) == NEVER
    assert crossing(-1.1, 1.0, 0.2, 0.5) == NEVER


EVERY = [*PARTS, BEHIND]
GROUND_END = complex(-0.34, 0.0)
"""Of the level ground under the first part; the second part is over what lies behind it."""


def rolled(angle):
    """Centroid while the rear disc rolls back on the level."""
    return complex(-HALF - RADIUS * angle, RADIUS) + ARM * cmath.exp(1j * angle)


def over_flat(p):
    """Gap from p to the second part's flat."""
    return lambda angle: BEHIND[1] - RADIUS - ((p - rolled(angle)) * cmath.exp(-1j * angle)).imag


def over_level(z):
    """Gap from a level to the second part's rear disc."""
    centre = complex(BEHIND[0], BEHIND[1])
    return lambda angle: (rolled(angle) + centre * cmath.exp(1j * angle)).imag - RADIUS - z


def under_end(angle):
    """Point that the second part's rear disc meets beyond its flat."""
    way = complex(BEHIND[0], BEHIND[1]) + RADIUS * cmath.exp(-0.75j * math.pi)
    return rolled(angle) + way * cmath.exp(1j * angle)


def closing(gap):
    """First angle at which a gap closes, by bisection."""
    low, high = 0.0, FARTHEST
    assert gap(low) > 0.0 > gap(high)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) > 0.0 else (low, middle)
    return low


FARTHEST = 0.36
"""Before the second part's front disc meets the end of the ground [rad]."""
FLAT, FLAT_LOW = -0.55 + 0j, -0.5 - 0.03j
PLATES = {
    "flat": (FLAT, closing(over_flat(FLAT))),
    "flat, low": (FLAT_LOW, closing(over_flat(FLAT_LOW))),
    "end": (under_end(0.15), 0.15),
    "end, low": (under_end(0.3), 0.3),
}
LEVELS = {"level": -0.01, "level, low": -0.1}


@MIRRORED
@pytest.mark.parametrize("what", [*PLATES, *LEVELS])
def test_what_closes_while_an_end_rolls(what, mirrored):
    if what in PLATES:
        p, expected = PLATES[what]
        behind = plates(p)[:-1]
    else:
        z = LEVELS[what]
        behind, expected = [(-5, z), (-0.45, z)], closing(over_level(z))
    line = [*behind, (GROUND_END.real, LOW), (GROUND_END.real, 0), (5, 0)]
    case = Case(line, mirrored, EVERY)
    # the line ends 30 m beyond the last point
    pivot = case.rear_disc((GROUND_END, complex(35, 0)))
    start = (case.ground, case.body), pivot, case.turned_pose(1j * ABOVE, 0.0), case.sign
    angle, closed = first_closing(*start, FARTHEST)
    assert angle == near(expected)
    if what in PLATES:
        assert closed == case.edge(p, 1)
    else:
        kind = at.DISC_1 if case.sign > 0.0 else at.DISC_2
        assert closed & at.KIND_MASK == kind
        assert (closed >> at.PART_BITS) & at.PART_MASK == 1
    assert first_closing(*start, 0.99 * expected) == (0.99 * expected, at.NO_FEATURE)


EDGE = 1.7 + 0.3j


@MIRRORED
@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("part", [0, 1])
@pytest.mark.parametrize(("phi", "upon"), [(0.0, 0.1), (0.4, 0.3), (-0.5, 0.5)])
@pytest.mark.parametrize("less", [None, 0.2, 0.6])
def test_what_an_end_meets_about_an_edge(less, phi, upon, part, swapped, mirrored):
    """A point, or a plane less steep than the flat, where the disc is once it has rotated so far.

    The first part alone, or the second one behind it; their discs named in either order.
    """
    parts = [[*each[3:], *each[:3]] if swapped else each for each in EVERY[: part + 1]]
    c = EDGE + (0.05 + 1j * ABOVE) * cmath.exp(1j * (phi + upon))
    x, z, radius = EVERY[part][:3]
    centre = c + complex(x, z) * cmath.exp(1j * (phi + upon))
    if less is None:  # beyond the flat
        met = centre + radius * cmath.exp(1j * (phi + upon - 0.75 * math.pi))
        line = plates(met)[:-1]
    else:
        slope = phi + upon - less
        along = 0.03 * cmath.exp(1j * slope)
        met = centre - 1j * radius * cmath.exp(1j * slope)
        ends = met - along, met + along
        line = [(-5, LOW), (ends[0].real, LOW), *((p.real, p.imag) for p in ends)]
        line += [(ends[1].real, LOW)]
    case = Case([*line, *plates(EDGE)[1:]], mirrored, parts)
    start = EDGE + (0.05 + 1j * ABOVE) * cmath.exp(1j * phi)
    given = (case.ground, case.body), case.edge(EDGE), case.turned_pose(start, phi), case.sign
    angle, closed = first_closing(*given, 1.1 * upon)
    assert angle == near(upon)
    if less is None:
        assert closed == case.edge(met, part)
    else:
        kind = at.DISC_1 if (case.sign > 0.0) is not swapped else at.DISC_2
        segment = min(map(case.point, ends))
        assert closed == at.POINT * segment + at.PART * part + kind
    assert first_closing(*given, 0.9 * upon) == (0.9 * upon, at.NO_FEATURE)


@MIRRORED
@pytest.mark.parametrize("upon", [0.1, 0.5])
def test_another_part_meets_what_stays_under_the_line_of_the_pivots_part(upon, mirrored):
    """A part that hangs 0.5 m under the flat, behind the edge about which the nose goes up."""
    hanging = [-1.4, ABOVE - 0.5, 0.05, -1.0, ABOVE - 0.5, 0.05]
    turn = cmath.exp(1j * upon)
    c = 0.05 + 1j * ABOVE
    met = EDGE + (c + complex(*hanging[:2]) + 0.05 * cmath.exp(-0.75j * math.pi)) * turn
    case = Case(plates(met, EDGE), mirrored, [*PARTS, hanging])
    given = (case.ground, case.body), case.edge(EDGE), case.turned_pose(EDGE + c, 0.0), case.sign
    angle, closed = first_closing(*given, 1.1 * upon)
    assert angle == near(upon)
    assert closed == case.edge(met, 1)
