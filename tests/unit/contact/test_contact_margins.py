"""Margins, loads and friction of poses against formulas written out here by hand."""

import math

import numpy as np
import pytest

from amounts import few_of
from contact_cases import flight, random_robot, random_terrain, stadium, steps
from kaidan.contact import (
    BELLY,
    Feature,
    FeatureKind,
    Status,
    mirror,
    settle,
    spring_loads,
    traverse,
)
from kaidan.contact.kernel.first_closing import first_closing
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.nearest_feature import nearest
from kaidan.contact.kernel.reserves import barrier
from kaidan.contact.kernel.rotation import foot_limit, next_pivot, turned
from kaidan.contact.kernel.settling import lever
from kaidan.contact.layout import At, Release
from kernel_memory import posed, scene

G = 9.80665
ANGLE, SPACING = np.radians(35), 0.15
L, C_L, C_N, R = 0.47, 0.196, 0.071, 0.06


def on_the_flight():
    run = traverse(flight(ANGLE, SPACING), stadium(L, C_L, C_N, R), -1.0, 1.9)
    on = (np.abs(run.inclination - ANGLE) < 1e-9) & (run.margins.contacts >= 2)
    assert on.sum() > 100
    return run, on


def test_regular_flight_by_hand():
    """Static stability, Hirose's energy, force-angle and ZMP along the nosing line."""
    run, on = on_the_flight()
    counts = set()
    m = run.margins
    for row in np.flatnonzero(on):
        # the nosings under the flat: s from the foot of the centroid, along the flat
        foot = run.poses.placements[row, :2] - C_N * np.array([-np.sin(ANGLE), np.cos(ANGLE)])
        u = np.array([np.cos(ANGLE), np.sin(ANGLE)])
        nosings = np.array(
            [[k * SPACING * u[0], k * SPACING * u[1] + SPACING * u[1]] for k in range(12)]
        )
        along = (nosings - foot) @ u
        edge = np.abs(along - C_L) < 1e-6
        edge |= np.abs(along + L - C_L) < 1e-6
        under = along[(along < C_L) & (along > C_L - L)]
        if edge.any() or m.contacts[row] != len(under):
            continue  # also where the tail's round still touches the landing
        counts.add(len(under))
        s_z = -C_N * np.tan(ANGLE)  # the gravity line meets the flat behind the foot
        back, front = s_z - under.min(), under.max() - s_z
        assert m.back[row] == pytest.approx(back * np.cos(ANGLE), abs=1e-9)  # m, rounding
        assert m.front[row] == pytest.approx(front * np.cos(ANGLE), abs=1e-9)
        rises = []
        for s in (under.min(), under.max()):
            arm = np.hypot(s, C_N)
            height = C_N * np.cos(ANGLE) - s * np.sin(ANGLE)
            rises.append(arm - height)
        assert [m.back_rise[row], m.front_rise[row]] == pytest.approx(rises, abs=1e-9)
        angles = [
            math.atan2(d * np.cos(ANGLE), C_N * np.cos(ANGLE) - s * np.sin(ANGLE))
            for d, s in ((back, under.min()), (front, under.max()))
        ]
        levers = np.array([back, front]) * np.cos(ANGLE)
        assert m.force_angle[row] == pytest.approx(min(np.array(angles) * levers * G), abs=1e-8)
        assert m.zmp[row] == pytest.approx(back / (back + front), abs=1e-9)
        # one plane: the friction is its slope
        assert m.required_friction[row] == pytest.approx(np.tan(ANGLE), abs=1e-9)
    assert counts >= {3, 4}  # hand: floor(470 / 150) and one more; fewer at the ends of the flight


def test_shared_loads_are_the_equal_springs():
    run, on = on_the_flight()
    row = np.flatnonzero(on & (run.margins.contacts == 4))[3]
    place = run.poses.placement(row)
    contacts = run.contacts_at(place, 1e-9)
    assert len(contacts) == 4
    loads = spring_loads(contacts, place[:2], 0.0, G)
    x = np.array([each.point[0] for each in contacts]) - place.x
    spread = ((x - x.mean()) ** 2).sum()
    expected = G * (1 / 4 - x.mean() * (x - x.mean()) / spread)
    if (expected > 0).all():
        np.testing.assert_allclose(loads, expected, rtol=1e-12)
    assert loads.sum() == pytest.approx(G, rel=1e-12)
    assert loads @ x == pytest.approx(0, abs=1e-12)


def test_belly_is_flagged():
    """A thin belly just above the ground strands on a step's edge; the track alone is not belly."""
    parts = [[-0.25, 0, 0.10, 0.25, 0, 0.10], [-0.2, -0.099, 0.0, 0.2, -0.099, 0.0]]
    hung = traverse(steps(0.15, 0.3, 1), parts, -1.0, 0.8, kinds=[0, BELLY])
    assert not hung.margins.belly_touches.any()  # the track's flat lies lower
    parts = [
        [-0.3, 0, 0.10, -0.28, 0, 0.10],
        [0.28, 0, 0.10, 0.3, 0, 0.10],
        [-0.25, 0.0, 0.0, 0.25, 0.0, 0.0],
    ]  # two short tracks, ends only, and a belly between them; hand: the rear disc at the face, the
    # belly's line would pass (0.1/0.56) 0.15 + 0.1 = 0.13 m above the ground, below the nosing
    hung = traverse(steps(0.15, 0.3, 1), parts, -1.0, 0.8, kinds=[0, 0, BELLY])
    assert hung.margins.belly_touches.any()


def fine_rise(ground, body, pivot, x, z, phi, sense, kappa):
    """Rise before the centroid stands over the contact it turns about, by small turns."""
    down = math.sqrt(1 + kappa**2)
    start = (z + kappa * x) / down
    best, total, step = 0.0, 0.0, 5e-4
    while total < math.pi / 2:
        if lever(scene(ground, body), pivot, posed(x, z, phi), kappa) * sense >= 0:
            return True, best
        x1, z1 = turned(scene(ground, body), pivot, x, z, phi, sense * step)
        c, s = math.cos(phi + sense * step), math.sin(phi + sense * step)
        which, distance = nearest(scene(ground, body), At(x1, z1, c, s), pivot, -1, 0.0)
        if which >= 0 and distance < -1e-7:
            pivot = which  # the old contact is left by at most one small turn
        x, z, phi, total = x1, z1, phi + sense * step, total + step
        pivot = rolled_off(ground, body, pivot, x, z, phi)
        best = max(best, (z + kappa * x) / down - start)
    return False, best


def rolled_off(ground, body, pivot, x, z, phi):
    """Edge of the tread as the contact, once a disc that rolls on the tread has come to it."""
    k, part, kind = Feature.of(pivot)
    if kind is FeatureKind.VERTEX:
        return pivot
    b_x, b_z, _ = body["one" if kind is FeatureKind.DISC_1 else "two"][part].item()
    centre = [x + math.cos(phi) * b_x - math.sin(phi) * b_z]
    centre.append(z + math.sin(phi) * b_x + math.cos(phi) * b_z)
    g_x, g_z, u_x, u_z, length, _ = ground[k].item()
    foot = (centre[0] - g_x) * u_x + (centre[1] - g_z) * u_z
    end = k if foot < 0 else k + 1 if foot > length else None
    if end is None or not ground["convex"][end]:
        return pivot
    return Feature(end, part, FeatureKind.VERTEX).code


@pytest.mark.parametrize("seed", few_of(40, fast=6))
def test_rise_along_the_flow(seed):
    """The closed form against small turns: the same rise to within the small turns' own error."""
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng, flippers=False, least_radius=0.04)
    terrain = steps(rng.uniform(0.05, 0.2), rng.uniform(0.15, 0.4), 5)
    run = traverse(terrain, parts, -1.0, 1.2, kinds=kinds)
    for row in rng.choice(len(run.poses), min(4, len(run.poses)), replace=False):
        for sense, pivot in ((1.0, int(run.poses.rear[row])), (-1.0, int(run.poses.front[row]))):
            place = run.poses.placement(row)
            start = (run.ground.table, run.body.table, pivot, *place, sense, 0.0)
            bounded, rise, _ = barrier(scene(*start[:2]), pivot, Release(*place, sense, 0.0), 0.0)
            fine_bounded, fine = fine_rise(*start)
            if bounded and fine_bounded:
                # m: each change of contact sinks in by up to one turn's path, 0.5 mrad x 0.5 m
                assert rise == pytest.approx(fine, abs=1e-3), (seed, row, sense)


@pytest.mark.parametrize("seed", range(30))
def test_nothing_is_hit_before_the_first_closing(seed):
    """At no angle before it is any gap negative; just behind it, that one is."""
    rng = np.random.default_rng(1000 + seed)
    parts, kinds = random_robot(rng)
    terrain = random_terrain(rng)
    run = traverse(terrain, parts, terrain[0, 0] + 2, terrain[-1, 0] - 2, kinds=kinds)
    for row in rng.choice(len(run.poses), min(6, len(run.poses)), replace=False):
        ground, body = run.ground.table, run.body.table
        for sense, pivot in ((1.0, int(run.poses.rear[row])), (-1.0, int(run.poses.front[row]))):
            x, z, phi = run.poses.placement(row)
            angle, closed = first_closing(scene(ground, body), pivot, posed(x, z, phi), sense, 0.5)
            for part in (0.02, 0.3, 0.6, 0.9, 0.99):
                x1, z1 = turned(scene(ground, body), pivot, x, z, phi, sense * part * angle)
                angle1 = phi + sense * part * angle
                which, distance = nearest(
                    scene(ground, body), posed(x1, z1, angle1), pivot, -1, 0.0
                )
                rolls_on = (
                    which >= 0 and abs(Feature.of(which).point - Feature.of(pivot).point) <= 1
                )
                assert which < 0 or distance > -1e-9 or rolls_on, (seed, row, sense, part, distance)
            assert closed == -1 or angle <= 0.5


def test_energy_not_bounded_is_flagged():
    """A robot whose tail meets a wall cannot turn over it: the rise is only a lower bound."""
    terrain = flight(ANGLE, SPACING)
    for robot in (stadium(L, C_L, C_N, R), stadium(0.47, 0.2, 0.01, 0.2)):
        run = traverse(terrain, robot, -1.0, 1.9)
        assert run.margins.bounded.any()
        assert np.isfinite(run.margins.energy).all()


@pytest.mark.parametrize("seed", range(8))
def test_every_pose_is_stable_in_the_mirror(seed):
    """Reflect the profile, swap the ends: let go from each pose's image, it stays there."""
    rng = np.random.default_rng(seed)
    parts, _ = random_robot(rng, flippers=False, least_radius=0.03)
    terrain = steps(rng.uniform(0.05, 0.2), rng.uniform(0.15, 0.4), 4)
    run = traverse(terrain, parts, -1.5, 1.0)
    reflected, swapped = mirror(terrain, parts)
    done = 0
    for row in rng.choice(len(run.poses), 40):
        x, z, phi = run.poses.placement(row)
        points = (run.poses.rear_point[row], run.poses.front_point[row])
        normals = (run.poses.rear_normal[row], run.poses.front_normal[row])
        if len(run.contacts_at(run.poses.placement(row))) > 2:
            continue  # the condition below is one of two contacts
        if min(x - points[0][0], points[1][0] - x) < 1e-3:
            continue  # about to rotate
        # let down at a fixed x nothing but the contacts' normals counts, friction does not: the
        # pose is lowest only where they pass the centroid on either side
        rear, front = (
            point[0] - x - (point[1] - z) * normal[0] / max(normal[1], 1e-9)
            for point, normal in zip(points, normals, strict=True)
        )
        if not rear < -1e-3 < 1e-3 < front:
            continue
        done += 1
        image = settle(reflected, swapped, -x, -phi)
        assert image.found
        assert image.inclination == pytest.approx(-phi, abs=1e-7)
        assert image.z == pytest.approx(z, abs=1e-8)
    assert done >= 15


def test_riser_start_needs_its_friction():
    """The first pose beyond mu is the nose on the face, for any mu below the riser start's."""
    h, robot = 0.1, stadium(L, C_L, C_N, R)
    l_c = L - C_L
    needed = (-R + math.sqrt(R**2 + 4 * l_c * (C_L + R))) / (2 * (C_L + R))
    run = traverse(steps(h, 1.0, 1, 4.0, 4.0), robot, -1.0, 0.5)
    row = np.flatnonzero(run.margins.required_friction > 0.99 * needed)[0]
    assert run.x[row] + C_L + R == pytest.approx(0.0, abs=1e-6)
    assert run.margins.required_friction[row] == pytest.approx(needed, rel=1e-6)


def test_momentum_over_several_rotations():
    """Grade three, each rotation again by small steps of energy and a plastic impact by hand."""
    k, done = 0.2, 0
    for rise, going in ((0.15, 0.3), (0.12, 0.22), (0.17, 0.28)):
        run = traverse(steps(rise, going, 4), stadium(0.6, 0.28, 0.1, 0.08), -1.5, 1.5, gyration=k)
        ground, body = run.ground.table, run.body.table
        for rotation in run.rotations:
            if not rotation.arrested:
                continue
            sense, pivot, (x, z, phi) = rotation.sense, rotation.pivot, rotation.start
            phi_end = rotation.end.inclination
            omega, after = 0.0, 0.0
            while phi * sense < phi_end * sense - 1e-9:
                c, s = math.cos(phi), math.sin(phi)
                limit = foot_limit(scene(ground, body), pivot, At(x, z, c, s), sense)
                end = min(abs(phi_end - phi) + 1e-9, limit)
                angle, closed = first_closing(
                    scene(ground, body), pivot, At(x, z, c, s), sense, end
                )
                # (k^2 + r^2) omega' = g Delta - rolling terms: integrated as energy, trapezoid free
                x1, z1 = turned(scene(ground, body), pivot, x, z, phi, sense * angle)
                a = contact_arm(run, pivot, x1, z1, phi + sense * angle)
                a0 = contact_arm(run, pivot, x, z, phi)
                energy = 0.5 * omega**2 * (k**2 + a0 @ a0) + G * (z - z1)
                omega = math.sqrt(max(2 * energy / (k**2 + a @ a), 0))
                x, z, phi = x1, z1, phi + sense * angle
                if closed < 0:
                    if phi * sense >= phi_end * sense - 1e-8:
                        break
                    pivot = next_pivot(scene(ground, body), pivot, sense)
                    continue
                before = omega
                b = contact_arm(run, closed, x, z, phi)
                # angular momentum about the new contact is kept by the impact
                after = max(omega * (k**2 + a @ b) / (k**2 + b @ b), 0.0)
                omega, pivot = after, closed
                done += 1
            assert rotation.rate_before == pytest.approx(before, rel=1e-6)
            assert rotation.rate_after == pytest.approx(after, rel=1e-6, abs=1e-9)
        assert run.status is Status.OK
    assert done >= 3


def contact_arm(run, feature, x, z, phi):
    ground, body = run.ground.table, run.body.table
    _, _, _, p_x, p_z = gap(scene(ground, body), feature, posed(x, z, phi))
    return np.array([x - p_x, z - p_z])
