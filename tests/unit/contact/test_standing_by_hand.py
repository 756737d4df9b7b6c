"""Postures in turn on a slope: the tracks stay where they are, the centroid goes with them."""

import math

import numpy as np
import pytest

from kaidan import Robot
from kaidan.contact import Status, body_table, stand_in_turn
from kaidan.contact.kernel.standing import middle_of_tracks
from kaidan.outline import Outline
from kernel_memory import called

SLOPE, START = 0.3, 0.25
RADIUS = 0.06
GROUND = [(-3, -3 * math.tan(SLOPE)), (3, 3 * math.tan(SLOPE))]
MIDDLES = [(-0.24, -0.04), (0.2, -0.03), (0.02, 0.03)]
"""Middle of the tracks from the centroid, which each posture moves [m]: first over one end."""
SETTLED = 1e-9  # m, rad: as far as poses are settled


def track(along, above):
    return [[along - 0.25, above, RADIUS, along + 0.25, above, RADIUS]]


def stood(middles, x=0.4, inclination=START):
    return stand_in_turn(GROUND, [track(*m) for m in middles], [0], x, inclination)


def test_the_middle_is_that_of_the_tracks():
    """By hand: axles 221 mm behind and 279 mm ahead of the centroid, 95 mm below it; of two tracks
    the middle of both, of flippers and a belly none.
    """
    body = Outline.of(Robot.named("absolem"))
    table = body_table(body.parts, body.kinds)
    assert called(middle_of_tracks)(table) == pytest.approx((0.029, -0.095))
    two = body_table([*track(0.1, 0.2), *track(0.5, 0.4)[0:1], *track(9.0, 9.0)], [0, 0, 2])
    assert called(middle_of_tracks)(two) == pytest.approx((0.3, 0.3))


def test_the_tracks_stay_where_they_are():
    path = stood(MIDDLES)
    along, above = MIDDLES[0]
    tracks = 0.4 + math.cos(START) * along - math.sin(START) * above
    c, s = math.cos(SLOPE), math.sin(SLOPE)
    x = [tracks - c * a + s * b for a, b in MIDDLES]
    height = tracks * math.tan(SLOPE) + RADIUS / c
    assert path.status == Status.OK
    assert path.x.tolist() == pytest.approx(x, abs=SETTLED)
    assert path.z.tolist() == pytest.approx(
        [height - s * a - c * b for a, b in MIDDLES], abs=SETTLED
    )
    assert path.s.tolist() == [0.0] * 3
    assert path.poses.leg.tolist() == [0.0] * 3
    friction = path.margins.required_friction.tolist()
    assert friction == pytest.approx([math.tan(SLOPE)] * 3, abs=SETTLED)
    assert path.inclination.tolist() == pytest.approx([SLOPE] * 3, abs=SETTLED)


def test_each_posture_has_the_margins_of_a_robot_that_stands_in_it():
    path = stood(MIDDLES)
    for k, middle in enumerate(MIDDLES):
        alone = stood([middle], path.x[k], SLOPE)
        # margins hang on the place by rounding only
        for name in path.margins.table.dtype.names:
            found, expected = path.margins.table[name][k], alone.margins.table[name][0]
            np.testing.assert_allclose(found, expected, atol=1e-7)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_it_ends_before_the_first_posture_without_a_pose(count):
    path = stood([*MIDDLES[:count], (0.5, -0.04), MIDDLES[2]])
    assert path.status == Status.NO_START
    assert len(path.x) == count
