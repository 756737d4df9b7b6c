"""The rear length against the contact model: at a riser a robot falls just where it is short."""

import numpy as np
import pytest

from kaidan import Profile, Question, Robot
from kaidan.mechanics.rearing import rear_length_margin
from kaidan.models.quasi_static import traverse_of
from kaidan.robot import Track


def check(seed, count):
    rng = np.random.default_rng(seed)
    fell = 0
    for _ in range(count):
        margin = 0.0
        while not 1e-3 < abs(margin) < 0.1:  # m: near enough to tell, beyond the poses' own step
            L, R = rng.uniform(0.35, 0.9), rng.uniform(0.04, 0.15)
            h, C_N, C_L = rng.uniform(0.1, 0.3), rng.uniform(0.05, 0.3), L * rng.uniform(0.3, 0.75)
            margin = float(rear_length_margin(b=L - C_L, h=h, R=R, C_N=C_N))
        robot = Robot(
            name="any",
            com_from_front=C_L,
            com_height=C_N,
            track=Track(flat_length=L, front_radius=R, rear_radius=R),
        )
        riser = Profile.of_points([(-3, 0), (0, 0), (0, h), (3, h)])
        found = traverse_of(Question.in_one_posture(robot, riser, friction=3.0))
        assert found.arrived == (margin > 0)
        assert found.rear_length == pytest.approx((margin, h))
        fell += not found.arrived
    assert 0 < fell < count


def test_a_robot_falls_where_its_rear_length_is_short():
    check(seed=0, count=40)


@pytest.mark.slow
def test_400_robots_fall_where_their_rear_length_is_short():
    check(seed=1, count=400)
