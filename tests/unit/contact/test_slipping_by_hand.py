"""Poses that a grouser holds while the robot slips, against all poses of the slip at once."""

import numpy as np
import pytest

from kaidan.contact.door import zeros
from kaidan.contact.kernel import slipping
from kaidan.contact.layout import Pose
from kernel_memory import called

held_while_slipping = called(slipping.held_while_slipping)

SLOTS = 2


def by_all_poses(s, legs, points, standing, friction, sense, way):
    """The best contact at which a grouser stands, by the worst pose to which it slips on it."""
    found = []
    for row in range(len(s)):
        best = friction[row]
        for point, own in zip(points[row], standing[row], strict=True):
            if point < 0:
                continue
            worst = max(friction[row], own)
            there = row + sense
            while 0 <= there < len(s) and legs[there] == legs[row] and abs(s[there] - s[row]) < way:
                same = [
                    m for p, m in zip(points[there], standing[there], strict=True) if p == point
                ]
                worst = min(worst, max([friction[there], *same]))
                there += sense
            if there < 0 and min(points[0]) < 0 <= max(points[0]):
                worst = -np.inf  # beyond a beginning with one end on a floor
            best = max(best, worst)
        found.append(best)
    return found


@pytest.mark.parametrize("sense", [1, -1])
def test_the_best_contact_by_its_worst_pose(sense):
    """Small whole numbers, so that margins, ways and points are often equal."""
    rng = np.random.default_rng(8)
    for _ in range(300):
        count = int(rng.integers(1, 9))
        s = np.cumsum(rng.integers(0, 3, count)).astype(float)
        legs = np.sort(rng.integers(0, 2, count))
        points = rng.integers(-1, 3, (count, SLOTS))
        standing = rng.integers(-3, 5, (count, SLOTS)).astype(float)
        friction = rng.integers(-4, 3, count).astype(float)
        way = float(rng.integers(1, 6))
        poses = zeros(Pose, count)
        poses["s"], poses["leg"] = s, legs
        found = np.full(count, np.nan)
        held_while_slipping(
            poses, points.ravel(), standing.ravel(), friction, SLOTS, sense, way, 0.0, found
        )
        assert found.tolist() == by_all_poses(s, legs, points, standing, friction, sense, way)


@pytest.mark.parametrize(
    ("begins", "held"), [((-1, 4), False), ((4, -1), False), ((-1, -1), True), ((3, 4), True)]
)
def test_nothing_holds_beyond_a_beginning_with_one_end_on_a_floor(begins, held):
    """Of five poses on one nosing, 10 mm apart; 25 mm back from the first three are before it."""
    poses = zeros(Pose, 5)
    poses["s"] = 0.01 * np.arange(5)
    points = np.tile([-1, 4], (5, 1))
    points[0] = begins
    standing = np.where(points == 4, 0.3, -np.inf)
    friction, found = np.array([0.2, -0.1, -0.1, -0.1, -0.1]), np.empty(5)
    held_while_slipping(
        poses, points.ravel(), standing.ravel(), friction, SLOTS, -1, 0.025, 0.0, found
    )
    first = 0.3 if begins == (3, 4) else 0.2
    expected = [first, 0.3, 0.3] if begins == (3, 4) else [0.2, 0.2, 0.2]
    assert found.tolist() == (expected if held else [0.2, -0.1, -0.1]) + [0.3, 0.3]


@pytest.mark.parametrize("sense", [1, -1])
def test_towards_the_end_it_passes_over_what_nothing_holds(sense):
    """Up to poses, in the same leg and less than so far ahead, that one nosing holds all along."""
    poses = zeros(Pose, 7)
    poses["s"], poses["leg"] = 0.01 * np.arange(7), [0, 0, 0, 0, 0, 1, 1]
    friction = np.array([-0.3, -0.3, 0.2, -0.3, -0.3, -0.3, -0.3])
    standing = np.full((7, SLOTS), -np.inf)
    standing[:, 0] = [-0.1, -0.3, 0.1, 0.1, -0.2, 0.4, -0.3]
    points = np.zeros((7, SLOTS), dtype=np.int64)
    found = np.full(7, np.nan)
    # no slip beyond the pose itself
    held_while_slipping(
        poses, points.ravel(), standing.ravel(), friction, SLOTS, sense, 1e-9, 0.025, found
    )
    at_once = [-0.1, -0.3, 0.2, 0.1, -0.2, 0.4, -0.3]
    # not the third's own friction, no pose of the next leg, and none farther than two ahead
    assert found.tolist() == ([-0.1, 0.1, 0.2, 0.1, -0.2, 0.4, -0.3] if sense > 0 else at_once)
