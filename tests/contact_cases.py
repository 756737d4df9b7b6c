"""Terrains and robots for the tests of the contact model: plain numbers, no kernel code."""

from __future__ import annotations

import numpy as np

LANDING = 4.0
"""Length of the landings of random terrains [m]."""


def steps(rise, going, n, low=3.0, high=3.0):
    """n steps with treads, first riser at x = 0, between landings."""
    points = [(-low, 0.0)]
    for k in range(n):
        points += [(k * going, k * rise), (k * going, (k + 1) * rise)]
    points.append(((n - 1) * going + high, n * rise))
    return np.array(points)


def flight(angle, spacing, n=12, low=3.0, high=3.0):
    """Steps by angle of the nosing line and nosing spacing."""
    return steps(spacing * np.sin(angle), spacing * np.cos(angle), n, low, high)


def thin_noses(rise, going, n, low=3.0, high=3.0, depth=0.6):
    """The same nosings as points only: spikes with deep notches between them."""
    points = [(-low, 0.0), (-1e-3, 0.0)]
    for k in range(n):
        x, z = k * going, (k + 1) * rise
        points.append((x, z))
        if k < n - 1:
            points.append((x + 0.5 * going, z - depth * rise))
    points.append(((n - 1) * going + high, n * rise))
    return np.array(points)


def stadium(L, C_L, C_N, r_rear, r_front=None):
    """Main track: flat of length L, centroid C_L behind its front tip and C_N above it."""
    r_front = r_rear if r_front is None else r_front
    return np.array([[-(L - C_L), r_rear - C_N, r_rear, C_L, r_front - C_N, r_front]])


def random_robot(rng, flippers=True, least_radius=0.01):
    """A track, sometimes with flippers and a belly; parts, kinds."""
    L = rng.uniform(0.3, 1.2)
    C_L = L * rng.uniform(0.25, 0.75)
    C_N = L * rng.uniform(0.08, 0.4)
    r_rear, r_front = rng.uniform(least_radius, 0.2, 2)
    parts = [stadium(L, C_L, C_N, r_rear, r_front)[0]]
    kinds = [0]
    if flippers and rng.random() < 0.4:
        reach, angle = rng.uniform(0.15, 0.4), rng.uniform(-0.5, 1.0)
        z = r_front - C_N
        parts.append(
            [C_L, z, r_front, C_L + reach * np.cos(angle), z + reach * np.sin(angle), r_front / 2]
        )
        kinds.append(1)
    if flippers and rng.random() < 0.3:
        reach, angle = rng.uniform(0.15, 0.4), np.pi - rng.uniform(-0.5, 1.0)
        z, x = r_rear - C_N, C_L - L
        parts.append(
            [x, z, r_rear, x + reach * np.cos(angle), z + reach * np.sin(angle), r_rear / 2]
        )
        kinds.append(1)
    if flippers and rng.random() < 0.2:
        parts.append([-0.8 * (L - C_L), 0.03 - C_N, 0.0, 0.8 * C_L, 0.03 - C_N, 0.0])
        kinds.append(2)
    return np.array(parts), np.array(kinds)


def random_terrain(rng):
    """Steps, random polylines or scanned steps, with `LANDING` at both ends."""
    kind = rng.integers(3)
    if kind == 0:
        return steps(
            rng.uniform(0.05, 0.3),
            rng.uniform(0.1, 0.4),
            int(rng.integers(1, 10)),
            LANDING,
            LANDING,
        )
    if kind == 1:
        x = np.cumsum(rng.uniform(0, 0.2, 60))
        z = np.cumsum(rng.normal(0, 0.05, 60))
    else:
        s = steps(rng.uniform(0.05, 0.25), rng.uniform(0.15, 0.4), int(rng.integers(1, 8)))
        x, z = scanned(s, rng)
    return np.concatenate(
        [[[x[0] - LANDING, z[0]]], np.stack([x, z], 1), [[x[-1] + LANDING, z[-1]]]]
    )


def scanned(terrain, rng, spacing=0.01, noise=0.003):
    """A profile seen by a scanner: points every centimetre, 3 mm noise; x, z."""
    x = np.arange(-1.0, terrain[-1, 0] - 2.0, spacing)
    z = np.interp(x, terrain[:, 0] + 1e-9 * np.arange(len(terrain)), terrain[:, 1])
    return x, z + rng.normal(0, noise, len(x))


def vector(force):
    """Force of a contact over the mass, ahead and up [N/kg]."""
    (n_x, n_z), load, traction = force.normal, force.load, force.traction
    return load * n_x + traction * n_z, load * n_z - traction * n_x
