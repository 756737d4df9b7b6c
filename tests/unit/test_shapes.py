"""What a profile is along the path: what is built across the whole way, and what is not."""

import random

import numpy as np
import pytest

from kaidan import Profile, Stairs, catalog
from kaidan.terrain.shape import shape_of

SCANNED = 0.01
"""Distance of the points of a scan [m]."""
NOISE = 0.003
"""Of a scan, what `kaidan.terrain.polyline.ROUGHNESS` is made for [m]."""


def shape(line):
    """Of a line that rises or falls."""
    return Profile.of_points(line).upward(descending=True).shape


def mirrored(line):
    return np.asarray(line)[::-1] * (-1.0, 1.0)


def scan(line, rng):
    line = np.asarray(line)
    x = np.arange(line[0, 0], line[-1, 0], SCANNED)
    z = np.interp(x, line[:, 0] + 1e-9 * np.arange(len(line)), line[:, 1])
    return np.column_stack([x, z + rng.normal(0.0, NOISE, len(x))])


def flights(rng):
    """One to three flights, as they are measured: risers differ by up to 20 mm either way."""
    each = []
    for _ in range(int(rng.integers(1, 4))):
        n, rise = int(rng.integers(2, 10)), rng.uniform(0.13, 0.19)
        each.append(
            Stairs(
                rises=tuple((rise + rng.uniform(-0.02, 0.02, n)).tolist()),
                goings=tuple((0.28 + rng.uniform(-0.02, 0.02, n - 1)).tolist()),
                upper_landing=float(rng.uniform(0.8, 3.0)),
            )
        )
    return Profile.of_flights(each).points


def blocks(heights, widths):
    """Blocks side by side on a floor [m]."""
    line, x = [(-3.0, 0.0), (0.0, 0.0)], 0.0
    for height, width in zip(heights, widths, strict=True):
        line += [(x, height), (x + width, height)]
        x += width
    return [*line, (x, 0.0), (x + 3.0, 0.0)]


def rubble(seed, count, highest):
    own = random.Random(seed)
    each = [(own.uniform(0.1, 0.3), own.uniform(0.0, highest)) for _ in range(count)]
    return blocks([height for _, height in each], [width for width, _ in each])


@pytest.mark.parametrize(
    ("line", "word"),
    [
        ([(-3, 0), (3, 0)], "level"),
        ([(-3, 0), (0, 0), (0, 0.014), (3, 0.014)], "level"),
        ([(-3, 0), (0, 0), (2, 0.4), (5, 0.4)], "ramp"),
        ([(-3, 0), (0, 0), (0, 0.15), (3, 0.15)], "step"),
        ([(-3, 0), (0, 0), (2, 0.4), (2, 0.5), (5, 0.5)], "step"),  # a ramp that ends in one
        (blocks([0.05], [0.1]), "threshold"),
        (blocks([0.15], [2.0]), "threshold"),  # an island between kerbs
        ([(-3, 0), (0, 0), (1, 0.1), (2, 0), (5, 0)], "threshold"),  # a hump
        ([(-3, 0), (0, 0), (0, 0.1), (1, 0.1), (2, 0), (5, 0)], "threshold"),
        (blocks([0.05, 0.1], [0.3, 0.3]), "irregular"),
        (blocks([0.05, 0.0, 0.05], [0.1, 0.5, 0.1]), "irregular"),
        (blocks([0.144, 0.122, 0.144, 0.122, 0.144], [0.1] * 5), "irregular"),  # a pallet's boards
        ([(-3, 0), (0, 0), (0, -0.1), (0.2, -0.1), (0.2, 0), (3, 0)], "irregular"),  # a ditch
        ([(-3, 0), (0, 0), (0.5, 0.2), (1, 0), (1.5, 0.2), (2, 0), (5, 0)], "irregular"),
    ],
)
def test_words_by_hand(line, word):
    assert shape(line) == word
    assert shape(mirrored(line)) == word


def test_a_heap_of_blocks_that_only_rises_is_no_flight():
    """Its risers are 40, 90, 10 and 60 mm; the first and the last do not count: 10 is not 90."""
    line = [(-3, 0), (0, 0), (0, 0.04), (0.2, 0.04), (0.2, 0.13), (0.5, 0.13), (0.5, 0.15)]
    line += [(0.7, 0.15), (0.7, 0.21), (4, 0.21)]
    assert shape(line) == "irregular"


@pytest.mark.parametrize("name", catalog.names("stairs"))
def test_flights_of_the_catalogue_are_flights(name):
    assert Profile.of_stairs(Stairs.named(name)).shape == "flight"


@pytest.mark.parametrize("seed", range(20))
def test_measured_flights_are_flights_up_and_down_exact_and_scanned(seed):
    rng = np.random.default_rng(seed)
    line = flights(rng)
    for each in (line, mirrored(line), scan(line, rng), mirrored(scan(line, rng))):
        assert shape(each) == "flight"


def test_landings_that_drain_are_level():
    """1 in 50 towards the flight below it, away from it above, as outdoors."""
    line = Profile.of_stairs(Stairs(rise=0.15, going=0.3, steps=5)).points.copy()
    line[0, 1] += 0.02 * (line[1, 0] - line[0, 0])
    line[-1, 1] -= 0.02 * (line[-1, 0] - line[-2, 0])
    for each in (line, scan(line, np.random.default_rng(0))):
        assert shape(each) == shape(mirrored(each)) == "flight"


def test_stairs_over_a_bridge_are_flights():
    up = Profile.of_stairs(Stairs(rise=0.17, going=0.28, steps=5)).points
    down = mirrored(up) + np.array([2 * up[-1, 0], 0.0])
    over = np.vstack([up, down[1:]])
    assert shape(over) == "flight"
    assert shape(scan(over, np.random.default_rng(0))) == "flight"


@pytest.mark.parametrize("seed", range(20))
def test_a_scanned_floor_is_level_and_a_scanned_ramp_a_ramp(seed):
    rng = np.random.default_rng(seed)
    assert shape(scan([(-3, 0), (3, 0)], rng)) == "level"
    slope = rng.uniform(0.05, 0.6)
    assert shape(scan([(-3, 0), (-1, 0), (1, 2 * slope), (3, 2 * slope)], rng)) == "ramp"


@pytest.mark.parametrize("count", [6, 12, 20])
@pytest.mark.parametrize("highest", [0.1, 0.15, 0.3])
def test_rubble_is_irregular(count, highest):
    words = [shape(rubble(seed, count, highest)) for seed in range(100)]
    # six blocks of up to 100 mm may lie as if they were one: of 400 one did
    assert words.count("irregular") >= 99


def test_the_place_and_a_finer_line_change_nothing():
    line = np.array(rubble(3, 12, 0.15))
    at = np.array([7.0, 2.0])
    profile = Profile.of_points(line + at)
    assert profile.shape == "irregular"
    between = 0.5 * (line[1:] + line[:-1])
    finer = np.empty((2 * len(line) - 1, 2))
    finer[::2], finer[1::2] = line, between
    assert shape_of(finer, profile.nosings - at, profile.edges - at) == "irregular"
