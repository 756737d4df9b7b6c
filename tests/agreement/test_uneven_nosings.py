"""The criterion on uneven nosings against the contact kernel, which knows nothing of it.

Robots are driven over spikes at the nosings, tilted by a little less than the margin: none may
rotate by more than its rocking says, and none may fall.
"""

import math

import numpy as np
import pytest

from kaidan import contact
from kaidan.traversal.criterion import Tread
from kaidan.traversal.static_criterion import static_criterion


def spikes(nosings):
    """Nosings with notches of 0.1 m between them, landings well below the robot."""
    (x, z), points = nosings[0], []
    points = [(x - 4.0, z - 0.25), (x - 0.02, z - 0.25)]
    for k, (x, z) in enumerate(nosings):
        points.append((x, z))
        if k < len(nosings) - 1:
            points.append((0.5 * (x + nosings[k + 1, 0]), z - 0.10))
    x, z = nosings[-1]
    return np.array([*points, (x + 0.03, z - 0.3), (x + 4.0, z - 0.3)])


def tilted(points, angle):
    c, s = math.cos(angle), math.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def drive(nosings, tread):
    """Status and largest rotation [rad] while the whole flat is on the flight."""
    L, C_L, C_N, R, R_down, gyration, _ = tread
    body = [[-(L - C_L), R_down - C_N, R_down, C_L, R - C_N, R]]
    first, last = nosings[1], nosings[-1]
    slope = math.atan2(nosings[3, 1] - first[1], nosings[3, 0] - first[0])
    c, s = math.cos(slope), math.sin(slope)
    path = contact.traverse(
        spikes(nosings),
        body,
        first[0] + (L - C_L + 0.01) * c - C_N * s,
        last[0] - (C_L + 0.02) * c - C_N * s,
        inclination=slope,
        gyration=gyration,
        step=2e-3,
        with_margins=False,
    )
    turns = np.abs(path.rotations.angle)
    return path.status, float(turns.max()) if len(turns) else 0.0


def cases(seed, count):
    rng = np.random.default_rng(seed)
    while count:
        L = rng.uniform(0.6, 1.2)
        tread = Tread(
            L, L * rng.uniform(0.35, 0.6), L * rng.uniform(0.1, 0.25), 0.02, 0.02, 0.3 * L
        )
        p, slope = rng.uniform(0.2, 0.42) * L, rng.uniform(0.35, 0.8)
        k = np.arange(14)
        nosings = np.c_[k * p * math.cos(slope), k * p * math.sin(slope)]
        uneven = rng.choice([1e-3, 3e-3, 6e-3])  # m: builders' tolerance is 5 to 9.5 mm
        nosings = nosings + rng.uniform(-uneven, uneven, nosings.shape)
        found = static_criterion(nosings, tread)
        worst = found.smallest(downhill=True)
        if worst is not None and not found.alone and worst.margin > 5e-3:
            count -= 1
            yield nosings, tread, worst.margin


def check(seed, count):
    for nosings, tread, margin in cases(seed, count):
        leant = tilted(nosings, margin - math.radians(0.1))
        status, turn = drive(leant, tread)
        assert status is contact.Status.OK
        told = static_criterion(leant, tread).turn
        # 0.15 deg: the kernel's rotation is the chord's angle and the yield of round ends of 20 mm
        assert turn <= told + math.radians(0.15)


def test_no_robot_rotates_beyond_its_rocking_short_of_the_margin():
    check(seed=1, count=15)


@pytest.mark.slow
def test_no_robot_of_400_rotates_beyond_its_rocking_short_of_the_margin():
    check(seed=2, count=400)


def test_it_does_rotate_beyond_the_margin():
    """The margin is no idle one: 2 degrees beyond it most robots fall or rotate further."""
    gone = 0
    for nosings, tread, margin in cases(3, 10):
        leant = tilted(nosings, margin + math.radians(2.0))
        status, turn = drive(leant, tread)
        told = static_criterion(leant, tread).turn
        gone += status is not contact.Status.OK or turn > told + math.radians(0.15)
    assert gone >= 8
