"""The native kernel against its own source as plain Python, on random terrains and robots."""

import numpy as np
import pytest

from amounts import fast_and_slow
from contact_cases import random_robot, random_terrain
from kaidan.contact import (
    Job,
    Status,
    belt_slides,
    stand_in_turn,
    traverse,
    traverse_many,
    using_kernel,
    without_native,
)
from kernel_calls import TILTS, asked_of, random_way

pytestmark = pytest.mark.skipif(bool(without_native()), reason="built pure")


def told(found):
    """All numbers to their last digit, with their signs; NaN is NaN."""
    return repr(found.tolist())


def compare(seeds):
    """Bit for bit: the same statements and roots, nothing fused, and no function of a libm."""
    for seed in seeds:
        way, how = random_way(seed)
        answers = []
        for kernel in ("plain", "native"):
            with using_kernel(kernel):
                answers.append(asked_of(way, how, seed))
        for plain, native in zip(*answers, strict=True):
            assert repr(plain) == repr(native)
        drives = [traverse(*way, tilt=tilt, with_margins=False, **how) for tilt in TILTS]
        assert answers[1][-1] == [each.status is Status.OK for each in drives]


@pytest.mark.parametrize("count", fast_and_slow(6, 15))
def test_random_traverses(count):
    compare(range(count))


@pytest.mark.slow
@pytest.mark.parametrize("block", range(100))
def test_ten_thousand_random_traverses(block):
    compare(range(1000 + 100 * block, 1100 + 100 * block))


def test_a_batch():
    rng = np.random.default_rng(7)
    terrains = [random_terrain(rng) for _ in range(4)]
    robots = [random_robot(rng) for _ in range(4)]
    jobs = [Job(k, k, terrains[k][0, 0] + 2, terrains[k][0, 0] + 2.1) for k in range(4)]
    tables = []
    for kernel in ("plain", "native"):
        with using_kernel(kernel):
            tables.append(
                traverse_many(
                    terrains, [parts for parts, _ in robots], jobs,
                    kinds=[kinds for _, kinds in robots], with_margins=True,
                ).table
            )  # fmt: skip
    assert told(tables[0]) == told(tables[1])


def test_a_robot_that_stands_in_one_posture_after_the_other():
    flat = np.array([[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06], [0.196, 0, 0.06, 0.4, 0.1, 0.03]])
    up, down = flat.copy(), flat.copy()
    up[1, 4], down[1, 4] = 0.2, -0.15
    stairs = [[-2, 0], [0, 0], [0, 0.17], [0.28, 0.17], [0.28, 0.34], [3, 0.34]]
    tables = []
    for kernel in ("plain", "native"):
        with using_kernel(kernel):
            path = stand_in_turn(stairs, [flat, up, down], [0, 1], -0.05, 0.1)
            tables.append((path.poses.table, path.margins.table, belt_slides(path)))
    assert [len(each) for each in tables[0]] == [3, 3, 2]
    assert tables[0][2].any()
    for plain, native in zip(*tables, strict=True):
        assert told(plain) == told(native)
