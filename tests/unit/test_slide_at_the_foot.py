"""How hard the trailing end meets the floor, where it slides down the last riser.

Nothing judges that (docs/theory/contact.md): with a smooth belt that holds on the flight it is
slower than what counts as tolerated. Energy of the path less the work of sliding friction, no other
loss.
"""

import math

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models.quasi_static import traverse_of
from kaidan.robot import TOLERATED_IMPACT

SLIDING = 0.8
"""Sliding over static friction (docs/theory/grousers.md)."""


def speed_at_the_foot(robot, stairs, facing, friction):
    """Speed of the trailing end as the longest slide ends [m/s]."""
    asked = Question.in_one_posture(robot, stairs, direction="down", facing=facing)
    found = traverse_of(asked)
    poses, rows = found.path.poses, np.flatnonzero(found.comes_off)
    required, s = found.path.margins.required_friction[rows], found.path.s[rows]
    k = 0.3 * robot.track.flat_length
    left = np.maximum(1.0 - friction / np.maximum(required, 1e-9), 0.0)
    gain = STANDARD_GRAVITY * np.maximum(-np.sin(poses.path_direction[rows]), 0.0) * left
    fastest = energy = 0.0
    for i in range(1, len(rows)):
        if rows[i] != rows[i - 1] + 1 or required[i] <= friction:
            energy = 0.0
            continue
        energy += 0.5 * (gain[i] + gain[i - 1]) * (s[i] - s[i - 1])
        at = slice(rows[i] - 1, rows[i] + 1)
        turn = abs(np.diff(poses.inclination[at])[0]) / max(s[i] - s[i - 1], 1e-9)
        reach = math.dist(poses.rear_point[rows[i]], poses.front_point[rows[i]])
        fastest = max(fastest, turn * reach * math.sqrt(2.0 * energy / (1.0 + (k * turn) ** 2)))
    return fastest


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("flight", ["ibc", "ada"])
@pytest.mark.parametrize("name", ["absolem-flat", "marv", "marmotte"])
def test_with_the_friction_of_the_flight_the_end_meets_the_floor_no_faster_than_tolerated(
    name, flight, facing
):
    robot, stairs = Robot.named(name), Stairs.named(flight)
    slope = math.tan(stairs.angle)
    held = speed_at_the_foot(robot, stairs, facing, SLIDING * slope)
    assert held < TOLERATED_IMPACT
    # limit: no faster than a free fall by three risers
    free = speed_at_the_foot(robot, stairs, facing, 0.0)
    assert held < free < math.sqrt(2 * STANDARD_GRAVITY * 3 * stairs.rise)
