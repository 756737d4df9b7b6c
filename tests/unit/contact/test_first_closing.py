"""What closes first while a robot rotates: nothing sooner, and there it does."""

import math

import numpy as np
import pytest

from amounts import few_of
from contact_cases import random_robot, random_terrain, steps
from kaidan.contact import body_table, ground_table
from kaidan.contact.kernel.first_closing import first_closing
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.nearest_feature import nearest
from kaidan.contact.kernel.rotation import foot_limit, next_pivot, turned
from kaidan.contact.kernel.settling import settle
from kaidan.contact.layout import At
from kernel_memory import posed, scene

FARTHEST = 0.5 * math.pi  # rad: as far as any look goes
OPEN = -1e-9  # m: gaps are closed to 1e-12, coordinates of some metres are rounded
TERRAINS = [
    steps(0.15, 0.25, 4),
    [(-3, 0), (0, 0), (0.2, 0.1), (0.5, 0.05), (0.6, 0.3), (0.9, 0.3), (0.9, 0.1), (1.2, 0.5)],
    [(-3, 0), (0, 0), (0, 0.12), (0.02, 0.12), (0.02, 0.0), (0.5, 0.0), (0.5, 0.2), (4, 0.4)],
]


def at_angle(ground, body, pivot, x, z, phi, turn):
    """Pose after a rotation: x, z, cosine, sine."""
    x_1, z_1 = turned(scene(ground, body), pivot, x, z, phi, turn)
    return x_1, z_1, math.cos(phi + turn), math.sin(phi + turn)


def checked_closing(ground, body, pivot, x, z, phi, sense, end):
    """What `first_closing` finds, once it is sure: nothing sooner, and there it does."""
    for hint in (0, 5):
        angle, closed = first_closing(
            scene(ground, body, hint), pivot, posed(x, z, phi), sense, end
        )
    assert 0.0 <= angle <= end
    for share in (0.02, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97, 0.999):
        pose = at_angle(ground, body, pivot, x, z, phi, sense * share * angle)
        which, smallest = nearest(scene(ground, body), At(*pose), pivot, -1, 0.0)
        # the segment beside the one that a disc rolls on begins where it ends
        beside = which >= 0 and abs((which >> 6) - (pivot >> 6)) <= 1
        assert which < 0 or smallest > OPEN or beside, (share, which, smallest)
    if closed >= 0:
        pose = at_angle(ground, body, pivot, x, z, phi, sense * angle)
        assert abs(gap(scene(ground, body), closed, At(*pose))[0]) < 1e-8
        pose = at_angle(ground, body, pivot, x, z, phi, sense * (angle + 1e-3))
        assert gap(scene(ground, body), closed, At(*pose))[0] < OPEN
    else:
        assert angle == end
    return closed, angle


@pytest.mark.parametrize("terrain", range(len(TERRAINS)))
@pytest.mark.parametrize("seed", range(40))
def test_nothing_closes_sooner_and_there_it_does(seed, terrain):
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng, least_radius=0.02)
    ground, body = ground_table(TERRAINS[terrain]), body_table(parts, kinds)
    x = rng.uniform(-0.4, 1.2)
    found, z, phi, rear, front = settle(scene(ground, body), x, rng.uniform(-0.3, 0.3), 0.0)
    if not found:
        return
    for sense, pivot in ((1.0, rear), (-1.0, front)):
        limit = foot_limit(scene(ground, body), pivot, posed(x, z, phi), sense)
        end = min(0.6, limit)
        checked_closing(ground, body, pivot, x, z, phi, sense, end)


@pytest.mark.parametrize("rolls", [True, False])
def test_a_part_that_falls_past_upright_meets_the_ground_with_its_upper_side(rolls):
    # hand: a bar of 0.4 on its end's disc of 0.05, ten degrees behind upright, before a step of
    # 0.2; it falls over ahead, rolling on the floor or about an edge, until its side lies on the
    # nosing: 0.05 from the line through both centres
    line = [(-3, 0), (0.2, 0), (0.2, 0.2), (3, 0.2)]
    if not rolls:
        line = [(-3, -1), (0, 0), (0.02, -1), (0.2, -1), (0.2, 0.2), (3, 0.2)]
    ground, body = ground_table(line), body_table([[-0.4, 0.0, 0.05, 0.0, 0.0, 0.05]])
    nosing = int(np.flatnonzero(ground["z"] == 0.2)[0])
    pivot = 2 if rolls else 64
    phi = math.radians(-80.0)

    def beside(turn):
        hub = (0.05 * turn, 0.05) if rolls else (0.05 * math.sin(turn), 0.05 * math.cos(turn))
        normal = -math.sin(phi - turn), math.cos(phi - turn)
        return (0.2 - hub[0]) * normal[0] + (0.2 - hub[1]) * normal[1] - 0.05

    lo, hi = 0.0, 1.2
    for _ in range(60):
        middle = 0.5 * (lo + hi)
        lo, hi = (middle, hi) if beside(middle) > 0.0 else (lo, middle)
    turn = math.cos(phi), math.sin(phi)
    angle, closed = first_closing(scene(ground, body), pivot, At(0.0, 0.05, *turn), -1.0, 1.5)
    assert closed == 64 * nosing
    assert angle == pytest.approx(lo, abs=1e-9)


@pytest.mark.parametrize("seed", few_of(400, fast=60))
def test_turning_on_about_what_closed_nothing_closes_sooner_either(seed):
    """Over rough ground and steps: discs roll on to the next segment, end upon the next point."""
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng)
    terrain = random_terrain(rng)
    ground, body = ground_table(terrain), body_table(parts, kinds)
    x = rng.uniform(terrain[0, 0] + 3.0, terrain[-1, 0] - 3.0)
    found, z, phi, rear, front = settle(scene(ground, body), x, rng.uniform(-0.3, 0.3), 0.0)
    if not found:
        return
    for sense, pivot in ((1.0, rear), (-1.0, front)):
        at, turn = pivot, (x, z, phi)
        for _ in range(6):
            limit = foot_limit(scene(ground, body), at, posed(*turn), sense)
            closed, angle = checked_closing(ground, body, at, *turn, sense, min(FARTHEST, limit))
            turn = (*turned(scene(ground, body), at, *turn, sense * angle), turn[2] + sense * angle)
            if closed >= 0:
                at = closed
            elif angle == limit:
                at = next_pivot(scene(ground, body), at, sense)
            if abs(turn[2]) > 1.3:
                break
