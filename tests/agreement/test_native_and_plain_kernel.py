"""The native kernel against its own source as plain Python, on random terrains and robots."""

import numpy as np
import pytest

from amounts import fast_and_slow
from contact_cases import LANDING, random_robot, random_terrain
from kaidan.contact import (
    Job,
    Manner,
    Sampled,
    Status,
    arrives,
    belt_slides,
    extremes_of,
    samples_of,
    stand_in_turn,
    traverse,
    traverse_many,
    using_kernel,
    without_native,
)

pytestmark = pytest.mark.skipif(bool(without_native()), reason="built pure")


STEPS = (0.005, 0.01, 0.02, 0.04)
"""Arclength between poses [m]: larger ones cost less, and meet other brackets of the same roots."""


def same(plain, native):
    """Bit for bit: the same statements and roots, nothing fused, and no function of a libm."""
    assert plain.status == native.status
    assert [each.kind for each in plain.events] == [each.kind for each in native.events]
    for name in ("poses", "rotations", "margins"):
        assert told(getattr(plain, name).table) == told(getattr(native, name).table)


def told(table):
    """All numbers to their last digit, with their signs; NaN is NaN."""
    return repr(table.tolist())


def same_between(path, seed, acceleration):
    """Likewise what is looked for between poses: samples of phases, and the phases' extremes."""
    rng = np.random.default_rng(seed)
    count = len(path.poses)
    phase = np.sort(rng.integers(0, 3, count))
    whence = np.where(rng.random(count) < 0.3, path.inclination + 0.1, -np.inf)
    back, corner = rng.random((2, count)) < 0.2
    middle = float(np.median(path.poses.front_point[:, 0]))
    manner = Manner(
        descending=seed % 2 == 1, whole=seed % 3 == 0, counts=tuple(rng.permutation(3)),
        tops=[(middle + 0.1, np.inf, -np.inf, np.inf)], flights=[(middle - 0.5, middle)],
        nosings=np.array([middle]), height=0.1, gyration=0.2, acceleration=acceleration,
    )  # fmt: skip
    found = []
    for kernel in ("plain", "native"):
        with using_kernel(kernel):
            seen = samples_of(path, phase, 1e-7, acceleration=acceleration)
            margins, lasts = seen.path.margins, np.arange(len(seen.rows)) % 5 > 0
            samples = Sampled(
                seen.path, phase, corner, seen.rows, lasts, np.abs(margins.required_friction),
                np.abs(margins.traction), np.arange(len(seen.rows)) % 7 == 0,
            )  # fmt: skip
            extremes = extremes_of(samples, whence, back, manner)
            found.append([*map(told, (seen.rows, seen.path.poses.table, margins.table)), *extremes])
    for one, other in zip(*found, strict=True):
        assert repr(one) == repr(other)


def same_end(terrain, parts, start, end, kinds, how):
    """Whether it arrives under tilted gravity, of which no pose is kept."""
    for tilt in (0.0, 0.05, -0.1):
        way = terrain, parts, start, end
        whole = traverse(*way, kinds=kinds, tilt=tilt, with_margins=False, **how)
        for kernel in ("plain", "native"):
            with using_kernel(kernel):
                found = arrives(*way, kinds=kinds, tilt=tilt, **how)
            assert found is (whole.status is Status.OK)


def scan(terrain, begin, end, rng):
    """A part of the terrain as points 2 cm apart with 3 mm of noise."""
    x = np.arange(begin, end, 0.02)
    z = np.interp(x, terrain[:, 0] + 1e-9 * np.arange(len(terrain)), terrain[:, 1])
    return np.stack([x, z + rng.normal(0, 0.003, len(x))], 1)


def compare(seeds):
    """Random robots from just before the first riser on: the landing is alike for all of them.

    In plain Python a pose among a thousand points of a scan takes a hundred times as long as one on
    a landing, so that a scan is of what the robot can come near.
    """
    for seed in seeds:
        rng = np.random.default_rng(seed)
        parts, kinds = random_robot(rng)
        terrain = random_terrain(rng)
        start = terrain[0, 0] + LANDING - np.abs(parts[:, [0, 3]]).max() - 0.25
        end = min(start + rng.uniform(0.3, 1.0), terrain[-1, 0] - 2)
        if seed % 5 == 0:
            terrain = scan(terrain, start - 1.5, end + 1.5, rng)
        how = {"acceleration": (0.0, 0.3, -0.5)[seed % 3], "step": STEPS[seed % 4]}
        runs = []
        for kernel in ("plain", "native"):
            with using_kernel(kernel):
                runs.append(traverse(terrain, parts, start, end, kinds=kinds, **how))
        same(*runs)
        same_between(runs[1], seed, how["acceleration"])
        same_end(terrain, parts, start, end, kinds, how)


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
