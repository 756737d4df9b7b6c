"""Whole paths by geometry alone: what carries touches, nothing sinks in, what is told happened.

Random robots on random terrain; every pose, event and rotation of each is looked at.
"""

import numpy as np
import pytest

from amounts import slow
from contact_cases import LANDING, random_robot, random_terrain, scanned, stadium
from contact_geometry import outline_distance, room
from kaidan.contact import Event, Feature, FeatureKind, RotationOutcome, Status, ground_table
from kaidan.contact import traverse as driven
from kaidan.mechanics import STANDARD_GRAVITY as G

CLOSED = 1e-9  # m: gaps are closed to 2e-13, coordinates of some metres are rounded
STEP = 0.01  # m
GYRATION = 0.2  # m
ARM = 0.3  # m by which inclination counts in arclength, as docs/theory/contact.md says
FELL = {Event.FELL_FORWARD: Status.FELL_FORWARD, Event.FELL_BACKWARD: Status.FELL_BACKWARD}
WHOLE = (55, 112, 113, 139, 145, 149, 215, 243, 247)
RARE = (19, 47, 50, 116, 188)
"""Seeds of what hardly any other one takes: driven upright, stuck, ended amid a step,
let down again; with `WHOLE` to the far end of their terrain."""
ROTATES = (Event.NOSE_DROPS, Event.TIPS_BACK)


class Case:
    """A robot driven over terrain, and where it is at each pose."""

    def __init__(self, seed, rough=False, whole=False):
        rng = np.random.default_rng(seed)
        self.parts, kinds = random_robot(rng)
        terrain = random_terrain(rng)
        if rough:
            inner = np.stack(scanned(terrain, rng, 0.005, 0.0005), axis=1)
            terrain = np.vstack([terrain[:1], inner[inner[:, 0] > terrain[0, 0]], terrain[-1:]])
        self.a, self.step = (0.0, 0.4, -0.4)[seed % 3], STEP
        begin = terrain[0, 0] + LANDING - np.abs(self.parts[:, [0, 3]]).max() - 0.25
        self.end = min(begin + 2.5, terrain[-1, 0] - 2.0)
        if whole:
            self.end, self.a, self.step = (
                terrain[-1, 0] - 2.0, (0.0, 0.3, -0.5)[seed % 3], (0.005, 0.01, 0.02)[seed % 3]
            )  # fmt: skip
        self.ground = ground_table(terrain)
        self.path = driven(
            terrain,
            self.parts,
            begin,
            self.end,
            kinds=kinds,
            step=self.step,
            acceleration=self.a,
            gyration=GYRATION,
        )
        self.poses, self.rotations = self.path.poses, self.path.rotations
        self.events = [(each.kind, each) for each in self.path.events]
        self.events_at = {}
        for kind, each in self.events:
            self.events_at.setdefault(each.pose, []).append(kind)
        self.c, self.phi = self.poses.x + 1j * self.poses.z, self.poses.inclination

    def gap(self, code, row):
        """Gap of a feature at a pose, by its own definition."""
        point, which, kind = Feature.of(code)
        part, c, turn = self.parts[which], self.c[row], np.exp(1j * self.phi[row])
        if kind is FeatureKind.VERTEX:
            at = complex(self.ground["x"][point], self.ground["z"][point])
            return float(outline_distance(part, np.array([(at - c) / turn]))[0])
        x, z, r = part[:3] if kind is FeatureKind.DISC_1 else part[3:]
        begin = self.ground[point]
        start, u = complex(begin["x"], begin["z"]), complex(begin["u_x"], begin["u_z"])
        off = (c + complex(x, z) * turn - start) * u.conjugate()
        along = min(max(off.real, 0.0), begin["length"])
        return abs(off - along) - r

    def lever(self, code_point, row):
        """How far a contact lies ahead of the line of effective gravity through the centroid."""
        psi = self.poses.path_direction[row]
        lean = self.a * np.cos(psi) / (G + self.a * np.sin(psi))
        x, z = code_point[row]
        return x - self.poses.x[row] + lean * (self.poses.z[row] - z)


SMOOTH = [k if k < 10 or k in RARE else slow(k) for k in (*range(60), *RARE[3:])]


@pytest.fixture(scope="module", params=[*SMOOTH, *((seed, False, True) for seed in WHOLE)], ids=str)
def case(request):
    return Case(*request.param) if isinstance(request.param, tuple) else Case(request.param)


FINE = (10, 23, 57, 58)
"""Seeds of scans on which an end passes several points in a step: closed at what it left, or, where
two parts share that end, beside the vertex that it left."""


@pytest.fixture(scope="module", params=[k if k in FINE else slow(k) for k in range(60)])
def scan(request):
    return Case(request.param, rough=True)


def test_on_a_scan_nothing_sinks_in_either(scan):
    assert scan.path.status not in (Status.NOT_CONVERGED, Status.TOO_LONG)
    assert_on_the_ground(scan, deepest=CLOSED)
    test_effective_gravity_passes_between_the_contacts(scan)
    test_events_are_told_where_they_happen(scan)
    test_rotations_lead_from_one_line_to_the_next(scan)


@pytest.mark.parametrize(("count", "step"), [(301, 0.02), (1201, 0.005)])
def test_over_a_hill_of_many_points_nothing_sinks_in(count, step):
    """300 mm in radius: in a step an end passes up to 17 points, on both sides of it."""
    robot, angles = stadium(0.5, 0.25, 0.1, 0.08), np.linspace(-0.58, 0.58, count)
    hill = 0.3 * np.sin(angles), 0.3 * (np.cos(angles) - np.cos(0.58))
    terrain = [(-9, 0), *np.transpose(hill), (9, 0)]
    path = driven(terrain, robot, -0.9, 0.9, step=step, with_margins=False)
    assert path.status is Status.OK
    c = path.poses.x + 1j * path.poses.z
    assert room(ground_table(terrain), robot, c, path.poses.inclination).min() > -CLOSED


def assert_on_the_ground(case, deepest):
    """What carries touches and nothing sinks in, at every pose."""
    assert room(case.ground, case.parts, case.c, case.phi).min() > -deepest
    for codes, points in (
        (case.poses.rear, case.poses.rear_point),
        (case.poses.front, case.poses.front_point),
    ):
        for row, (code, (x, z)) in enumerate(zip(codes.tolist(), points.tolist(), strict=True)):
            assert abs(case.gap(code, row)) < deepest
            point, which, kind = Feature.of(code)
            segment = case.ground[point]
            start = complex(segment["x"], segment["z"])
            u = complex(segment["u_x"], segment["u_z"])
            along = (complex(x, z) - start) * u.conjugate()
            if kind is FeatureKind.VERTEX:
                assert abs(complex(x, z) - start) < CLOSED
            else:
                assert abs(along.imag) < CLOSED
                assert -CLOSED < along.real < segment["length"] + CLOSED
            place = (complex(x, z) - case.c[row]) * np.exp(-1j * case.phi[row])
            assert abs(outline_distance(case.parts[which], np.array([place]))[0]) < CLOSED


def test_what_carries_touches_and_nothing_sinks_in(case):
    assert_on_the_ground(case, CLOSED)


def test_effective_gravity_passes_between_the_contacts(case):
    begins = {each.pose for kind, each in case.events if kind in ROTATES}
    # where a belt gives way the direction of the path is its own, not that of the outline
    near = CLOSED if case.a == 0.0 else 2e-3
    # an end in a notch turns the path back, and an acceleration along it with the path: no pose
    # need hold then
    turns_back = case.a != 0.0 and np.cos(case.poses.path_direction).min() < 0.0
    for row in range(len(case.poses)):
        rear, front = (
            case.lever(points, row) for points in (case.poses.rear_point, case.poses.front_point)
        )
        if row not in begins and not turns_back:
            assert rear < near
            assert front > -near
    for kind, each in case.events:
        # at most what an exchange of contacts has left behind
        if kind in ROTATES and case.a == 0.0 and case.events_at[each.pose] == [kind]:
            points = case.poses.rear_point if kind is Event.TIPS_BACK else case.poses.front_point
            assert abs(case.lever(points, each.pose)) < 1e-7


def test_arclength_is_that_of_the_poses(case):
    s, leg = case.poses.s, case.poses.leg
    assert s[0] == 0.0
    assert leg[0] == 0
    same = np.diff(leg) == 0
    assert (np.diff(leg)[~same] == 1).all()
    assert (np.diff(s)[~same] == 0.0).all()
    chord = np.hypot(np.abs(np.diff(case.c)), ARM * np.diff(case.phi))
    ds = np.diff(s)
    assert (ds[same] > -CLOSED).all()
    # steps are joined to one of no more than that, and each is cut where something happens
    assert ds.max() < 1.7 * case.step
    assert (chord - ds)[
        same
    ].max() < 1e-3 * case.step  # corrections across a step are of second order
    share = chord[same][ds[same] > 1e-6] / ds[same][ds[same] > 1e-6]
    assert share.min() > 0.8  # of a step round a small end
    assert np.median(share) > 0.999


def test_the_belt_runs_ahead_over_what_carries(case):
    same = np.flatnonzero((np.diff(case.poses.leg) == 0) & (np.diff(case.poses.s) > 1e-6))
    moved, turned = np.diff(case.c)[same], np.diff(case.phi)[same]
    ahead = np.zeros(len(same))
    for points, normals in (
        (case.poses.rear_point, case.poses.rear_normal),
        (case.poses.front_point, case.poses.front_normal),
    ):
        arm = points[same, 0] + 1j * points[same, 1] - case.c[same]
        along = (normals[same, 0] + 1j * normals[same, 1]) * -1j
        ahead += ((moved + 1j * turned * arm) * along.conj()).real
    assert (ahead > 0.0).all()


def test_the_path_turns_about_where_the_normals_meet(case):
    """The centroid goes across the line from where the normals of both contacts meet."""
    poses = case.poses
    rear, front = (
        points[:, 0] + 1j * points[:, 1] for points in (poses.rear_point, poses.front_point)
    )
    m, n = (each[:, 0] + 1j * each[:, 1] for each in (poses.rear_normal, poses.front_normal))
    way = np.exp(1j * poses.path_direction)
    sine = (m.conj() * n).imag
    meet = np.abs(sine) > 1e-6
    along = ((front - rear).conj() * n).imag / np.where(meet, sine, 1.0)
    arm = case.c - (rear + along * m)
    off = np.where(meet, (arm.conj() * way).real / np.abs(arm), (m.conj() * way).real)
    counts = ~meet | (np.abs(arm) > 1e-3)
    assert counts.sum() > len(poses) / 2
    assert np.abs(off[counts]).max() < 1e-5  # 1e-9 m over 1e-3 m, sines of 1e-6


def test_events_are_told_where_they_happen(case):
    poses, last = case.poses, len(case.poses) - 1
    told = np.array([each.s for _, each in case.events])
    assert (np.diff(told) >= -CLOSED).all()
    for k, (kind, each) in enumerate(case.events):
        row = each.pose
        assert each.s == pytest.approx(poses.s[row], abs=CLOSED)
        if kind not in (*FELL, Event.STUCK):
            assert poses.placement(row) == (each.x, each.z, each.inclination)
        if kind in (Event.MADE, Event.TAIL_RESTS):
            lost = case.events[k + 1][1]
            assert (lost.kind, lost.feature, lost.other) == (Event.LOST, each.other, each.feature)
            assert lost.pose == row
            assert each.feature in (poses.rear[row], poses.front[row])
            assert each.other in (poses.rear[row - 1], poses.front[row - 1])
            assert abs(case.gap(each.feature, row)) < 1e-8
            assert abs(case.gap(each.other, row)) < 1e-8
            rests = each.feature == poses.rear[row]
            rests &= Feature.of(each.feature).kind is FeatureKind.DISC_1
            assert (kind is Event.TAIL_RESTS) == rests
        elif kind in ROTATES:
            up = kind is Event.TIPS_BACK
            pivot = poses.rear[row] if up else poses.front[row]
            assert each.feature == pivot
            assert row == last or poses.leg[row + 1] == poses.leg[row] + 1
        elif kind is Event.ARRESTED:
            assert poses.leg[row] == poses.leg[row - 1] + 1
    kind, each = case.events[-1]
    ends = {Status.OK: Event.ARRIVED, Status.STUCK: Event.STUCK}
    ends |= {status: event for event, status in FELL.items()}
    assert kind is ends[case.path.status]
    assert each.pose == last
    if case.path.status is Status.OK:
        assert poses.x[-1] >= case.end - 1e-7
        assert (poses.x[:-1][poses.leg[:-1] == poses.leg[-1]] < case.end).all()


def test_rotations_lead_from_one_line_to_the_next(case):
    poses = case.poses
    begins = [each for kind, each in case.events if kind in ROTATES]
    assert len(begins) == len(case.rotations)
    for each, begin in zip(case.rotations, begins, strict=True):
        row = begin.pose
        assert each.sense == (1.0 if begin.kind is Event.TIPS_BACK else -1.0)
        assert each.s == pytest.approx(poses.s[row], abs=CLOSED)
        assert each.start == poses.placement(row)
        assert each.pivot == begin.feature
        carried = poses.rear_point if each.sense > 0.0 else poses.front_point
        assert each.pivot_point == pytest.approx(carried[row].tolist(), abs=CLOSED)
        if case.a == 0.0:  # the centroid is over the pivot, or beyond it where another was lost
            assert each.sense * (carried[row, 0] - poses.x[row]) > -CLOSED
        arrested = each.outcome is RotationOutcome.ARRESTED
        assert arrested == each.arrested
        if arrested:
            assert Event.ARRESTED in case.events_at[row + 1]
            assert each.end == poses.placement(row + 1)
            assert each.sense * (each.end.inclination - each.start.inclination) == pytest.approx(
                each.angle, abs=1e-9
            )
            # what is left after the impact turns it about the contact at the end it comes down on
            points = poses.rear_point if each.sense > 0.0 else poses.front_point
            square = abs(complex(*points[row + 1]) - case.c[row + 1]) ** 2 + GYRATION**2
            assert each.kinetic == pytest.approx(0.5 * square * each.rate_after**2, abs=1e-12)
            assert each.barrier >= 0.0
            assert each.kinetic > each.barrier or not each.topples_with_momentum
            vertex = Feature.of(each.pivot).kind is FeatureKind.VERTEX
            arm = complex(*each.end[:2]) - complex(*each.pivot_point)
            start = complex(*each.start[:2]) - complex(*each.pivot_point)
            if case.a == 0.0 and vertex and abs(abs(arm) - abs(start)) < CLOSED:
                drop = each.start.z - each.end.z  # about one point, from rest
                before = 2.0 * G * max(drop, 0.0) / (abs(arm) ** 2 + GYRATION**2)
                assert each.rate_before**2 == pytest.approx(before, abs=1e-6)
        else:
            assert row == len(poses) - 1
            assert each.topples_with_momentum
            assert (each.kinetic, each.barrier) == (0.0, 0.0)
