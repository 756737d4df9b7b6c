"""Equilibrium of every accepted pose, asked of a linear programme with friction cones.

The programme is written here from the definition: unilateral forces inside Coulomb cones, sum of
forces and moments equal to the effective weight. It shares nothing with the kernel but the points
and normals, and those are recomputed from the geometry in another test.
"""

import numpy as np
import pytest
from scipy.optimize import linprog

from amounts import fast_and_slow
from contact_cases import random_robot, random_terrain, stadium, steps
from kaidan.contact import traverse

G = 9.80665


def feasible(points, normals, com, weight, mu):
    """Whether cones of coefficient mu at the points can hold the weight (a vector, upward)."""
    columns = []
    for p, n in zip(points, normals, strict=True):
        t = np.array([n[1], -n[0]])
        for edge in (n + mu * t, n - mu * t):
            edge = edge / np.linalg.norm(edge)
            r = p - com
            columns.append([edge[0], edge[1], (r[0] * edge[1] - r[1] * edge[0]) / 0.3])
    result = linprog(
        np.zeros(len(columns)), A_eq=np.array(columns).T, b_eq=[weight[0], weight[1], 0.0],
        bounds=(0, None), method="highs",
    )  # fmt: skip
    return result.status == 0


def poses(seed, a):
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng)
    terrain = random_terrain(rng)
    run = traverse(
        terrain, parts, terrain[0, 0] + 2, terrain[-1, 0] - 2, kinds=kinds, acceleration=a,
    )  # fmt: skip
    return run, rng


@pytest.mark.parametrize("count", fast_and_slow(800, 5000))
def test_every_accepted_pose_is_in_equilibrium(count):
    """Poses on random profiles, walls included; required friction is the programme's."""
    checked = walls = 0
    seed = 0
    while checked < count:
        a = 0.0 if seed % 2 else float(np.random.default_rng(seed).uniform(-1, 1))
        run, rng = poses(seed, a)
        seed += 1
        if len(run.poses) == 0:
            continue
        for row in rng.choice(len(run.poses), min(60, len(run.poses)), replace=False):
            q, m = run.poses, run.margins
            if m.contacts[row] != 2:  # only then two contacts claim to need the least friction
                continue
            # m: over a contact, an event that is located to 1e-9 m
            if min(m.back[row], m.front[row]) < 1e-6:
                continue
            com = q.placements[row, :2]
            points = [q.rear_point[row], q.front_point[row]]
            normals = [q.rear_normal[row], q.front_normal[row]]
            kappa, psi = m.tilt[row], q.path_direction[row]
            weight = np.array([a * np.cos(psi), G + a * np.sin(psi)])
            assert kappa == pytest.approx(weight[0] / weight[1], abs=1e-12)
            mu = m.required_friction[row]
            walls += any(abs(np.arctan2(*normal)) > 1.4 for normal in normals)
            checked += 1
            # the programme's own tolerance is 1e-7 of the forces: 1e-4 either side is resolved
            assert feasible(points, normals, com, weight, mu * (1 + 1e-4) + 1e-4), (seed, row)
            if mu > 2e-3:
                assert not feasible(points, normals, com, weight, mu * (1 - 1e-3) - 1e-4), (
                    seed, row, mu,
                )  # fmt: skip
    assert walls > count / 100


def test_forces_balance():
    """The forces named with the friction do balance the weight, wherever they are finite."""
    run = traverse(steps(0.17, 0.28, 5), stadium(0.7, 0.3, 0.12, 0.09), -1.5, 1.8)
    q, m = run.poses, run.margins
    n1, n2 = q.rear_normal, q.front_normal
    t1 = np.stack([n1[:, 1], -n1[:, 0]], 1)
    t2 = np.stack([n2[:, 1], -n2[:, 0]], 1)
    two = (m.contacts == 2) & np.isfinite(m.rear_load)
    force1 = m.rear_load[:, None] * n1 + m.rear_traction[:, None] * t1
    force2 = m.front_load[:, None] * n2 + m.front_traction[:, None] * t2
    total = force1 + force2
    com = q.placements[:, :2]
    r1, r2 = q.rear_point - com, q.front_point - com
    moment = (
        r1[:, 0] * force1[:, 1] - r1[:, 1] * force1[:, 0]
        + r2[:, 0] * force2[:, 1] - r2[:, 1] * force2[:, 0]
    )  # fmt: skip
    assert two.sum() > 100
    # N/kg and N m/kg; rounding of sums of order 10, divided by contact distances of order 0.1
    np.testing.assert_allclose(total[two], [[0, G]] * two.sum(), atol=1e-9)
    np.testing.assert_allclose(moment[two], 0, atol=1e-9)


@pytest.mark.parametrize("count", fast_and_slow(60, 300))
def test_three_contacts_and_more_need_no_less(count):
    """The least friction of all contacts together, not only of the pair that is followed.

    At the least coefficient the load lies on the surface of the cone of all contact forces, so two
    contacts carry it; but for a coefficient of zero, where three normals may carry it between them.
    There the kernel, which tries pairs, asks for too much.
    """
    checked = seed = wedged = 0
    while checked < count and seed < 10 * count:
        run, rng = poses(seed, 0.0)
        seed += 1
        if len(run.poses) == 0:
            continue
        friction = run.margins.required_friction
        many = np.flatnonzero((run.margins.contacts > 2) & np.isfinite(friction))
        leaving = np.append(False, np.diff(run.s) == 0)
        many = many[~leaving[many]]
        for row in rng.choice(many, min(6, len(many)), replace=False) if len(many) else []:
            place, mu = run.poses.placement(row), friction[row]
            contacts = run.contacts_at(place, 1e-9)
            points = np.array([each.point for each in contacts])
            normals = np.array([each.normal for each in contacts])
            com = np.array(place[:2])
            weight = np.array([0.0, G])
            checked += 1
            assert feasible(points, normals, com, weight, mu * (1 + 1e-4) + 1e-4), (seed, row)
            if feasible(points, normals, com, weight, 0.0):
                wedged += 1
            elif mu > 2e-3:
                assert not feasible(points, normals, com, weight, mu * (1 - 1e-3) - 1e-4), (
                    seed, row, mu,
                )  # fmt: skip
    assert checked >= count
    assert checked - wedged >= count / 3
