"""Energy margins and tilts of single poses against rigid motion, worked out beside them.

A flat of 0.6 m, discs of 0.05 m at its ends and the centroid 0.1 m above its middle, on edges of
thin plates that stand on a low ground, or on a level ground::

         C
    -----------          rotated about an edge, until C stands over it or the flat comes upon
       |   |             another one; a disc rolls, to the end of its segment and over it
"""

import cmath
import math

import numpy as np
import pytest

from kaidan.contact import body_table, ground_table, mirror
from kaidan.contact import layout as at
from kaidan.contact.door import zeros
from kaidan.contact.kernel.energy_margins import flow_energy, pose_tilt
from kaidan.contact.kernel.reserves import AS_IT_COMES_OVER, barrier, carrying_tilt, lean
from kaidan.contact.layout import Release
from kernel_memory import called, posed, scene

HALF, ABOVE, RADIUS = 0.3, 0.1, 0.05
PARTS = [[-HALF, RADIUS - ABOVE, RADIUS, HALF, RADIUS - ABOVE, RADIUS]]
LOW = -2.0
C = 1j * ABOVE
"""Centroid of the robot whose flat lies on the level of the edges."""
ARM = complex(HALF, ABOVE - RADIUS)
"""From the centre of the rear disc to the centroid."""
NEAR = 1e-9
"""m, rad: closings are found to 1e-12 rad."""
KAPPAS = (0.0, 0.2, -0.1)
MIRRORED = pytest.mark.parametrize("mirrored", [False, True])


def plates(*edges):
    """Thin plates, the upper rear corner of each an edge."""
    line = [(-5, LOW)]
    for p in edges:
        line += [(p.real, LOW), (p.real, p.imag), (p.real + 1e-3, LOW)]
    return [*line, (5, LOW)]


def up(kappa):
    """Direction against effective gravity."""
    return (kappa + 1j) / math.hypot(1.0, kappa)


def height(p, kappa):
    return (p * up(kappa).conjugate()).real


def across(p, kappa):
    """Way of a vector across gravity that leans by kappa, towards the nose."""
    return -(p * up(kappa).conjugate()).imag


class Case:
    """A terrain and a robot as drawn, or in the mirror."""

    def __init__(self, line, mirrored, parts=PARTS):
        self.sign = -1.0 if mirrored else 1.0
        if mirrored:
            line, parts = mirror(line, parts)
        self.ground, self.body = ground_table(line), body_table(parts)

    def point(self, p):
        apart = np.hypot(self.ground["x"] - self.sign * p.real, self.ground["z"] - p.imag)
        return int(np.argmin(apart))

    def edge(self, p, part=0):
        """Edge p as a contact of a part."""
        return at.POINT * self.point(p) + at.PART * part

    def rear_disc(self, segment):
        """Rear disc on the segment whose ends are given."""
        kind = at.DISC_1 if self.sign > 0.0 else at.DISC_2
        return at.POINT * min(map(self.point, segment)) + kind

    def pose(self, c, phi):
        return self.sign * c.real, c.imag, self.sign * phi

    def turned_pose(self, c, phi):
        """The same with cosine and sine."""
        return self.sign * c.real, c.imag, math.cos(phi), self.sign * math.sin(phi)

    def scene(self):
        return scene(self.ground, self.body)

    def release(self, c, phi, kappa):
        return Release(*self.pose(c, phi), self.sign, self.sign * kappa)

    def barrier(self, pivot, kappa=0.0, tolerance=0.0, c=C, phi=0.0):
        """Rise as the nose goes up, and whether it is bounded."""
        return self.barrier_and_way(pivot, kappa, tolerance, c, phi)[:2]

    def barrier_and_way(self, pivot, kappa=0.0, tolerance=0.0, c=C, phi=0.0):
        """The same, and the way across effective gravity, towards the nose."""
        bounded, rise, across = barrier(self.scene(), pivot, self.release(c, phi, kappa), tolerance)
        return bounded, rise, self.sign * across

    def tilt(self, pivot, tolerance, kappa=0.0, without=-1, c=C, phi=0.0):
        return carrying_tilt(self.scene(), pivot, self.release(c, phi, kappa), tolerance, without)


def near(value):
    return pytest.approx(value, abs=NEAR)


A, B = -0.15 + 0j, 0.2 + 0j
D = A - (0.05 + 0.004j)
"""Below the flat behind A: reached by the rotation about A by..."""
ONTO_D = math.atan2(0.004, 0.05)
ON_D = A + (C - A) * cmath.exp(1j * ONTO_D)
"""...the centroid then."""


@MIRRORED
@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("phi", [0.0, 0.3])
def test_rise_over_an_edge(kappa, phi, mirrored):
    """The centroid runs on a circle: its rise is the radius less its height above the edge."""
    case = Case(plates(A), mirrored)
    c = A + (C - A) * cmath.exp(1j * phi)
    rise = abs(c - A) - height(c - A, kappa)
    for tolerance in (0.0, 0.1):
        assert case.barrier(case.edge(A), kappa, tolerance, c, phi) == (True, near(rise))
    over = abs(c - A) * up(kappa)  # the centroid, from A
    way = across(over - (c - A), kappa)
    assert case.barrier_and_way(case.edge(A), kappa, 0.0, c, phi)[2] == near(way)


@MIRRORED
@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("upon", [0.08, 0.7])
def test_rise_over_the_edge_that_the_flat_comes_upon(upon, kappa, mirrored):
    edge = A - 0.05 * cmath.exp(1j * upon)
    there = A + (C - A) * cmath.exp(1j * upon)
    case = Case(plates(edge, A), mirrored)
    rise = abs(there - edge) + height(edge, kappa) - height(C, kappa)
    assert case.barrier(case.edge(A), kappa) == (True, near(rise))


@MIRRORED
@pytest.mark.parametrize("kappa", [-1.0, -2.0])
def test_no_rise_is_found_beyond_90_degrees(kappa, mirrored):
    """Gravity that draws forward: the centroid would have to come over the edge upside down."""
    alone, both = Case(plates(A), mirrored), Case(plates(D, A), mirrored)
    turned = A + (C - A) * 1j - C
    rise, way = height(turned, kappa), across(turned, kappa)
    assert alone.barrier_and_way(alone.edge(A), kappa) == (False, near(rise), near(way))
    rest = cmath.exp(1j * (math.pi / 2 - ONTO_D))
    rise = height(D + (ON_D - D) * rest - C, kappa)
    assert both.barrier(both.edge(A), kappa) == (False, near(rise))


@MIRRORED
def test_a_rest_within_the_tolerance_is_the_same_pose(mirrored):
    """Over A after 0.100 rad, upon D after 0.120 rad, where it stands on both."""
    edge = -0.01 + 0j
    upon = 0.12
    other = edge - 0.2 * cmath.exp(1j * upon)
    case = Case(plates(other, edge), mirrored)
    over_edge = abs(C - edge) - ABOVE
    there = edge + (C - edge) * cmath.exp(1j * upon)
    over_other = abs(there - other) + other.imag - ABOVE
    for tolerance, rise in ((0.0, over_edge), (0.115, over_edge), (0.125, over_other)):
        assert case.barrier(case.edge(edge), 0.0, tolerance) == (True, near(rise))


@MIRRORED
def test_of_several_rests_those_within_the_tolerance_are_the_same_pose(mirrored):
    """Over the first edge after 0.10 rad, upon the second after 0.12, upon the third after 0.37."""
    first = -0.01 + 0j
    second = first - 0.02 * cmath.exp(0.12j)
    on_second = first + (C - first) * cmath.exp(0.12j)
    third = second - 0.1 * cmath.exp(0.37j)
    on_third = second + (on_second - second) * cmath.exp(0.25j)
    over_second = abs(on_second - second) + second.imag - ABOVE
    over_third = abs(on_third - third) + third.imag - ABOVE
    case = Case(plates(third, second, first), mirrored)
    for tolerance, rise in ((0.13, over_second), (0.3, over_second), (0.4, over_third)):
        assert case.barrier(case.edge(first), 0.0, tolerance) == (True, near(rise))


@MIRRORED
@pytest.mark.parametrize("later", [0.5, 2.0])
def test_a_contact_that_closes_as_the_centroid_comes_over_closes_first(later, mirrored):
    edge = -0.01 + 0j
    upon = math.atan2(0.01, ABOVE) + later * AS_IT_COMES_OVER
    other = edge - 0.2 * cmath.exp(1j * upon)
    there = edge + (C - edge) * cmath.exp(1j * upon)
    rise = abs(C - edge) - ABOVE if later > 1.0 else abs(there - other) + other.imag - ABOVE
    case = Case(plates(other, edge), mirrored)
    assert case.barrier(case.edge(edge)) == (True, near(rise))


@MIRRORED
def test_a_centroid_beyond_the_edge_rises_no_more(mirrored):
    """It is over it already; a rest within the tolerance is another pivot's."""
    edge, other = 0.02 + 0j, 0.02 - 0.2 * cmath.exp(0.1j)
    case = Case(plates(other, edge), mirrored)
    assert case.barrier_and_way(case.edge(edge)) == (True, 0.0, 0.0)
    assert case.barrier(case.edge(edge), 0.0, 0.05) == (True, 0.0)
    there = edge + (C - edge) * cmath.exp(0.1j)
    rise = abs(there - other) + other.imag - ABOVE
    assert case.barrier(case.edge(edge), 0.0, 0.15) == (True, near(rise))


@MIRRORED
@pytest.mark.parametrize("kappa", KAPPAS)
def test_rise_while_the_end_rolls_on_level_ground(kappa, mirrored):
    """Its centre goes back by its radius times the angle; largest where the slope of that is 0."""
    line = [(-3, 0), (3, 0)]
    case = Case(line, mirrored)
    far, first = cmath.polar(ARM)
    last = math.acos(kappa * RADIUS / (far * math.hypot(1.0, kappa))) - math.atan(kappa)
    end = complex(-HALF - RADIUS * (last - first), RADIUS) + cmath.rect(far, last)
    # the continuation of the line by 30 m lies on it
    ends = (case.ground["x"][0] * case.sign + 0j, case.ground["x"][-1] * case.sign + 0j)
    rise = height(end - C, kappa)
    assert case.barrier(case.rear_disc(ends), kappa) == (True, near(rise))


@MIRRORED
@pytest.mark.parametrize("kappa", KAPPAS)
def test_rise_over_the_end_of_the_segment_on_which_it_rolls(kappa, mirrored):
    """The foot comes to the edge 0.02 m behind it after 0.4 rad; then it rotates about the edge."""
    edge = complex(-HALF - 0.02, 0.0)
    case = Case([(-5, LOW), (edge.real, LOW), (edge.real, 0.0), (5, 0)], mirrored)
    arm = complex(0.0, RADIUS) + ARM * cmath.exp(0.4j)
    rise = abs(arm) + height(edge - C, kappa)
    # the line ends 30 m beyond the last point
    pivot = case.rear_disc((edge, complex(35, 0)))
    assert case.barrier(pivot, kappa) == (True, near(rise))
    assert case.barrier(pivot, kappa, 0.3) == (True, near(rise))


@MIRRORED
@pytest.mark.parametrize("kappa", KAPPAS)
def test_lean_is_the_angle_from_gravity_to_the_edge(kappa, mirrored):
    case = Case(plates(A), mirrored)
    found = lean(
        case.scene(), case.edge(A), posed(*case.pose(C, 0.0)), case.sign, case.sign * kappa
    )
    assert found == near(leaning(A, C, kappa))


def leaning(edge, c, kappa):
    return cmath.phase(up(kappa) / (c - edge))


TAPERED = [-HALF, -ABOVE + RADIUS, RADIUS, HALF, -ABOVE + 0.02, 0.02]
"""Another part with the same flat; its discs may be named in either order."""
BODIES = {
    "even": (PARTS, 0),
    "tapered": ([TAPERED], 0),
    "reversed": ([[*TAPERED[3:], *TAPERED[:3]]], 0),
    "second part": ([[-0.1, 0.2, 0.05, 0.1, 0.2, 0.05], TAPERED], 1),
    "thin": ([[-HALF, -ABOVE + 1e-3, 1e-3, HALF, -ABOVE + 1e-3, 1e-3]], 0),
}
RAISED = 0.4
"""Inclination of the flat in a body's own frame [rad]."""


def raised(parts):
    """Parts turned by `RAISED` about the centroid."""
    found = []
    for x1, z1, r1, x2, z2, r2 in parts:
        one, two = (complex(*each) * cmath.exp(1j * RAISED) for each in ((x1, z1), (x2, z2)))
        found.append([one.real, one.imag, r1, two.real, two.imag, r2])
    return found


@MIRRORED
@pytest.mark.parametrize("frame", [0.0, RAISED])
@pytest.mark.parametrize(("x", "phi", "kappa"), [(0.0, 0.0, 0.2), (4.0, 0.7, 0.0), (-3, -0.9, 0.3)])
@pytest.mark.parametrize("body", BODIES)
def test_what_the_robot_rocks_onto_carries(body, x, phi, kappa, frame, mirrored):
    """The flat comes upon an edge 1 mm from its end; 2 mm farther it would be an end's."""
    parts, part = BODIES[body]
    parts = raised(parts) if frame else parts
    edge, upon = complex(x, 0.3), 0.25
    c = edge + (0.05 + 1j * ABOVE) * cmath.exp(1j * phi)
    there = edge + (c - edge) * cmath.exp(1j * upon)
    first = leaning(edge, c, kappa)
    for reach, carries in ((0.249, True), (0.251, False)):
        other = edge - reach * cmath.exp(1j * (phi + upon))
        case = Case(plates(other, edge), mirrored, parts)
        pivot = case.edge(edge, part)
        then = leaning(other, there, kappa)
        assert then > first
        found = case.tilt(pivot, 1.1 * upon, kappa, -1, c, phi - frame)
        assert found == ((near(then), near(upon)) if carries else (near(first), 0.0))
        for tolerance, without in ((0.9 * upon, -1), (1.1 * upon, case.point(other)), (0.0, -1)):
            found = case.tilt(pivot, tolerance, kappa, without, c, phi - frame)
            assert found == (near(first), 0.0)


@MIRRORED
def test_what_it_rocks_onto_after_63_degrees_carries(mirrored):
    """Of a robot whose centroid is beyond the first edge."""
    edge, upon = 0.05 + 0j, 1.1
    other = edge - 0.23 * cmath.exp(1j * upon)
    there = edge + (C - edge) * cmath.exp(1j * upon)
    case = Case(plates(other, edge), mirrored)
    carried = near(leaning(other, there, 0.0)), near(upon)
    assert carried[0] != near(leaning(edge, C, 0.0))
    assert case.tilt(case.edge(edge), 1.2) == carried


@MIRRORED
def test_it_rocks_from_edge_to_edge_as_far_as_is_tolerated(mirrored):
    """Of two edges behind A, each below the flat as it lies on the one before it."""
    back = D - 0.08 * cmath.exp(1j * (ONTO_D + 0.04))
    there = D + (ON_D - D) * cmath.exp(0.04j)
    case = Case(plates(back, D, A), mirrored)
    for tolerance, edge, c, rocking in (
        (ONTO_D + 0.03, D, ON_D, ONTO_D),
        (ONTO_D + 0.05, back, there, ONTO_D + 0.04),
    ):
        carried = near(leaning(edge, c, 0.0)), near(rocking)
        assert case.tilt(case.edge(A), tolerance) == carried


@MIRRORED
def test_an_edge_close_behind_carries_less_than_the_one_before(mirrored):
    edge = A - 0.02 * cmath.exp(0.3j)
    there = A + (C - A) * cmath.exp(0.3j)
    assert leaning(edge, there, 0.0) < leaning(A, C, 0.0)
    case = Case(plates(edge, A), mirrored)
    assert case.tilt(case.edge(A), 0.4) == (near(leaning(A, C, 0.0)), 0.0)


@MIRRORED
def test_an_end_that_touches_carries_nothing_and_hides_nothing(mirrored):
    """A plate under the rear disc, which comes upon it before the flat comes upon another one."""
    under_end, under_flat = complex(-HALF - 0.02, -0.003), complex(A.real - 0.08, -0.006)
    upon = math.atan2(0.006, 0.08)
    there = A + (C - A) * cmath.exp(1j * upon)
    case = Case(plates(under_end, under_flat, A), mirrored)
    carried = near(leaning(under_flat, there, 0.0)), near(upon)
    assert case.tilt(case.edge(A), 0.5) == carried
    alone = Case(plates(under_end, A), mirrored)
    assert alone.tilt(alone.edge(A), 0.5) == (near(leaning(A, C, 0.0)), 0.0)


BEHIND = [-0.7, RADIUS - ABOVE + 0.01, RADIUS, -0.35, RADIUS - ABOVE + 0.01, RADIUS]
"""A second part behind the first one, 10 mm higher."""


@MIRRORED
@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("behind", [5e-4, 0.1])
def test_it_rolls_onto_a_part_behind(behind, kappa, mirrored):
    """The second part comes upon a plate; before, the first one may roll over the ground's end."""
    plate, end = -0.55 + 0j, complex(-HALF - behind, 0.0)
    line = [*plates(plate)[:-1], (end.real, LOW), (end.real, 0), (5, 0)]
    case = Case(line, mirrored, [*PARTS, BEHIND])
    # the line ends 30 m beyond the last point
    pivot = case.rear_disc((end, complex(35, 0)))

    def centroid(angle):
        rolled = min(angle, behind / RADIUS)
        c = complex(-HALF - RADIUS * rolled, RADIUS) + ARM * cmath.exp(1j * rolled)
        return c if rolled == angle else end + (c - end) * cmath.exp(1j * (angle - rolled))

    def below(angle):
        """How far the plate is below the second part's flat."""
        place = (plate - centroid(angle)) * cmath.exp(-1j * angle)
        return BEHIND[1] - RADIUS - place.imag

    low, high = 0.0, 0.2
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if below(middle) > 0.0 else (low, middle)
    assert low > 0.02
    first = leaning(-HALF + 0j, C, kappa)
    assert case.tilt(pivot, 0.9 * low, kappa) == (near(first), 0.0)
    carried = near(leaning(plate, centroid(low), kappa)), near(low)
    assert case.tilt(pivot, 1.2 * low, kappa) == carried


@MIRRORED
def test_what_remains_of_the_tolerance_is_less_by_the_rotation_onto_another_end(mirrored):
    """The second part's end comes to touch after 25 mrad and rolls on; then a third has a plate."""
    third = [-1.3, RADIUS - ABOVE + 0.022, RADIUS, -0.75, RADIUS - ABOVE + 0.022, RADIUS]
    plate, end = -1.0 + 0j, -0.9 + 0j
    line = [*plates(plate)[:-1], (end.real, LOW), (end.real, 0), (5, 0)]
    case = Case(line, mirrored, [*PARTS, BEHIND, third])
    pivot = case.rear_disc((end, complex(35, 0)))
    first = leaning(-HALF + 0j, C, 0.0)
    tilt, rocking = case.tilt(pivot, 0.06)
    assert tilt > first
    assert 0.03 < rocking < 0.05
    assert case.tilt(pivot, rocking + 1e-4) == (near(tilt), near(rocking))
    assert case.tilt(pivot, rocking - 1e-4) == (near(first), 0.0)


def table_of(case, rear, front, kappa):
    """Tables of a pose that stands on two edges."""
    poses, margins = zeros(at.Pose, 3), zeros(at.Margin, 3)
    for name in ("energy", "energy_side", "back_rise", "front_rise"):
        margins[name] = np.nan
    if case.sign < 0.0:
        rear, front = front, rear
    poses["x"][1], poses["z"][1], poses["inclination"][1] = case.pose(C, 0.0)
    margins["tilt"][1], margins["without"][1] = case.sign * kappa, at.NO_FEATURE
    for edge, side in ((rear, "back"), (front, "front")):
        margins[f"{side}_rise"][1] = abs(C - edge) - height(C - edge, kappa)
    margins["outer_rear"][1], margins["outer_front"][1] = case.edge(rear), case.edge(front)
    return poses, margins


@MIRRORED
@pytest.mark.parametrize("kappa", [0.0, 0.05, -0.3])
@pytest.mark.parametrize("behind", [False, True])
def test_the_lesser_rise_of_both_sides(kappa, behind, mirrored):
    """With an edge behind the rear one the front is the lesser, whose circle alone rises more."""
    other = A - 0.13 * cmath.exp(0.08j)
    case = Case(plates(*([other] if behind else []), A, B), mirrored)
    poses, margins = table_of(case, A, B, kappa)
    rear = abs(C - A) - height(C - A, kappa)
    if behind:
        there = A + (C - A) * cmath.exp(0.08j)
        rear = abs(there - other) + height(other - C, kappa)
    front = abs(C - B) - height(C - B, kappa)
    # back, +1, is nose up
    side = case.sign if rear < front else -case.sign
    called(flow_energy)((case.ground, case.body), poses, margins, np.array([1]))
    found = margins[["energy", "energy_side", "bounded"]][1].tolist()
    assert found == (near(min(rear, front)), side, True)
    assert np.isnan(margins["energy"][[0, 2]]).all()


@MIRRORED
def test_a_side_whose_circle_rises_more_is_not_looked_at(mirrored):
    """Nor is it said to be bounded then: within 90 degrees there is no rest to the rear."""
    case = Case(plates(A, B), mirrored)
    poses, margins = table_of(case, A, B, -2.0)
    back, front = (0.0, 10.0)[:: int(case.sign)]
    margins["back_rise"][1], margins["front_rise"][1] = back, front
    called(flow_energy)((case.ground, case.body), poses, margins, np.array([1]))
    rise = height(A + (C - A) * 1j - C, -2.0)
    found = margins[["energy", "energy_side", "bounded"]][1].tolist()
    assert found == (near(rise), case.sign, False)


@MIRRORED
def test_tilts_of_some_poses_each_with_its_tolerance(mirrored):
    case = Case(plates(D, A, B), mirrored)
    poses, margins = table_of(case, A, B, 0.0)

    def found(side):
        return [
            called(pose_tilt)((case.ground, case.body), poses[1], margins[1], side, tolerance)
            for tolerance in (1.1 * ONTO_D, 0.0)
        ]

    rear, front = (near(leaning(A, C, 0.0)), 0.0), (near(-leaning(B, C, 0.0)), 0.0)
    assert found(case.sign) == [(near(leaning(D, ON_D, 0.0)), near(ONTO_D)), rear]
    assert found(-case.sign) == [front, front]
    margins["without"][1] = case.point(D)
    assert found(case.sign) == [rear, rear]
