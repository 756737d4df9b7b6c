"""What closes first in a turn, by geometry alone: points within the parts, lines within the ends.

Robots on one point or one end of a part, wherever that leaves the rest of them above the ground.
"""

import cmath
import math

import numpy as np
import pytest

from amounts import few_of
from contact_cases import random_robot, steps
from contact_geometry import room
from kaidan.contact import body_table, ground_table
from kaidan.contact import layout as at
from kaidan.contact.kernel.first_closing import first_closing
from kernel_memory import posed, scene

OPEN = -1e-9  # m: gaps are closed to 1e-12, coordinates of some metres are rounded
TRIED = 300  # poses tried on each terrain
LOOKS = np.array([0.01, 0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 0.96, 0.99, 0.999])


def stands(rng, ground, parts):
    """Poses on one contact: feature, pivot's centre of rotation, way it rolls a radian, c, phi."""
    for _ in range(TRIED):
        which = int(rng.integers(len(parts)))
        phi = rng.uniform(-1.3, 1.3)
        end = int(rng.integers(2))
        x, z, r = parts[which][3 * end : 3 * end + 3]
        k = int(rng.integers(len(ground) - 1))
        u = complex(ground["u_x"][k], ground["u_z"][k])
        foot = complex(ground["x"][k], ground["z"][k])
        if rng.random() < 0.5:
            # of the long ones before and behind all steps what is near these
            share = rng.uniform(0.0, min(ground["length"][k], 2.0))
            foot += u * (share if k > 0 else ground["length"][k] - share)
            centre, roll = foot + 1j * r * u, -r * u
            code = at.POINT * k + at.PART * which + at.DISC_1 + end
        elif k > 0 and ground["convex"][k]:
            centre, roll = foot + r * cmath.exp(1j * rng.uniform(0.3, 2.8)), 0.0
            code = at.POINT * k + at.PART * which
        else:
            continue
        yield code, foot, roll, centre - complex(x, z) * cmath.exp(1j * phi), phi


def turned(stand, angles):
    """Centroid and inclination after turns; the disc's centre rolls, the rest turns about it."""
    _, foot, roll, c, phi = stand
    if roll == 0.0:
        return foot + (c - foot) * np.exp(1j * angles), phi + angles
    centre = foot - 1j * roll
    return centre + roll * angles + (c - centre) * np.exp(1j * angles), phi + angles


TERRAINS = [
    steps(0.17, 0.28, 4, 1.0, 1.0),
    [(-1, 0), (0, 0), (0.2, 0.1), (0.5, 0.05), (0.6, 0.3), (0.9, 0.3), (0.9, 0.1), (1.2, 0.5)],
    [(-1, 0.3), (-0.4, 0.0), (0.3, -0.2), (1.0, 0.1), (1.6, 0.6), (1.8, 0.2), (2.6, 0.5)],
]


@pytest.mark.parametrize("terrain", range(len(TERRAINS)))
@pytest.mark.parametrize("seed", few_of(40, fast=1))
def test_nothing_sinks_in_before_and_something_does_behind(seed, terrain):
    rng = np.random.default_rng(seed)
    ground = ground_table(TERRAINS[terrain])
    counts = [0, 0]
    for _ in range(4):
        parts, kinds = random_robot(rng, least_radius=0.02)
        body = body_table(parts, kinds)
        every = list(stands(rng, ground, parts))
        c, phi = (np.array([each[i] for each in every]) for i in (3, 4))
        for i in np.flatnonzero(room(ground, parts, c, phi) > OPEN):
            code, foot, roll, c_i, phi_i = every[i]
            sense, end = rng.choice([-1.0, 1.0]), rng.uniform(0.05, math.pi / 2)
            if roll != 0.0:
                k = code >> at.POINT_BITS
                behind = abs(foot - complex(ground["x"][k], ground["z"][k]))
                left = behind if sense > 0.0 else ground["length"][k] - behind
                end = min(end, left / abs(roll))
            tables = scene(ground, body, int(i) % len(ground))
            start = posed(c_i.real, c_i.imag, phi_i)
            angle, closed = first_closing(tables, code, start, sense, end)
            looks = np.append(sense * angle * LOOKS, sense * (angle + 1e-3))
            gaps = room(ground, parts, *turned(every[i], looks))
            assert gaps[:-1].min() > OPEN, (every[i], sense, angle)
            if closed < 0:
                assert angle == end
            else:
                assert gaps[-1] < OPEN, (every[i], sense, angle)
            counts[closed >= 0] += 1
    assert min(counts) > 5
