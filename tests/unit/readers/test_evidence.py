"""What tells stairs from ramps, and ends of elements from what goes on."""

import math
from dataclasses import replace

import numpy as np
import pytest

from kaidan.readers.stairfit.evidence import depth, evenness, slant, upright
from kaidan.readers.stairfit.staircase_line import StairLine, assigned, fronts, tops

LINE = StairLine(s0=0.0, z0=0.2, going=0.3, rise=0.2, first=0, last=4)
SLOPE = 0.2 / 0.3


def strewn(count=3000):
    """Places along five steps of 200 by 300 mm, and across."""
    rng = np.random.default_rng(0)
    return rng.uniform(0.0, 1.5, count), rng.uniform(0.0, 0.9, count)


def treads(s):
    return 0.2 * (np.floor(s / 0.3) + 1)


def risers():
    rng = np.random.default_rng(1)
    z = rng.uniform(0.0, 1.0, 3000)
    return 0.3 * np.floor(z / 0.2), rng.uniform(0.0, 0.9, 3000), z


def battened(s):
    """A ramp, and on it battens of 40 mm, 60 mm high, at the nosings."""
    return 0.1 + SLOPE * s + 0.06 * ((s + 0.04) % 0.3 < 0.04)


def test_treads_and_risers_have_no_slant_a_ramp_has_that_of_the_line():
    """By hand: the slope of a tread is 0, that of a plane along the flight 1 of it."""
    s, t = strewn()
    assert slant(LINE, s, t, treads(s)) == pytest.approx(0.0, abs=1e-9)
    assert slant(LINE, *risers()) == pytest.approx(0.0, abs=1e-9)
    assert slant(LINE, s, t, 0.1 + SLOPE * s) == pytest.approx(1.0)
    assert slant(LINE, s, t, 0.1 + 0.5 * SLOPE * s) == pytest.approx(0.5, rel=0.05)
    assert np.isnan(slant(LINE, s[:20], t[:20], treads(s[:20])))


def test_a_ramp_is_one_between_its_battens():
    """They lie on the nosings and above the ramp, as nosings do; what is between them slopes."""
    s, t = strewn()
    assert slant(LINE, s, t, battened(s)) == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("seen", [(0.0, 1.0), (0.0, 0.3), (0.4, 1.0)])
def test_it_does_not_matter_which_part_of_the_treads_is_seen(seen):
    """By hand: points on treads are as far from the line through mid-steps as steps have them."""
    s, t = strewn()
    part = s / 0.3 % 1.0
    s, t = (each[(part > seen[0]) & (part < seen[1])] for each in (s, t))
    assert depth(LINE, s, t, treads(s)) == pytest.approx(1.0, abs=1e-9)


def test_a_ramp_has_no_depth():
    s, t = strewn()
    assert depth(LINE, s, t, 0.1 + SLOPE * s) < 1e-9


def test_seats_of_twice_the_size_leave_every_second_step_empty():
    """By hand: of 3,000 points on five treads 600 each; on seats of two goings none on odd ones.

    A third of the points from step to step, as far away ones have, is no such thing.
    """
    s, t = strewn()
    even = evenness(LINE, assigned(LINE, s, t, treads(s), 0.02))
    assert even == pytest.approx(1.0, abs=0.1)
    seats = assigned(LINE, s, t, 0.4 * np.floor(s / 0.6) + 0.2, 0.02)
    assert evenness(LINE, seats) < 0.01
    far = np.repeat(0.15 + 0.3 * np.arange(5), 3 ** np.arange(6, 1, -1))
    assert evenness(LINE, assigned(LINE, far, 0 * far, treads(far), 0.02)) == pytest.approx(
        1.0, abs=0.1
    )
    # of the last of three treads the front alone: the second one has no more than the first
    part = np.repeat(0.15 + 0.3 * np.arange(3), [600, 600, 20])
    three = replace(LINE, last=LINE.first + 2)
    assert evenness(three, assigned(three, part, 0 * part, treads(part), 0.02)) == 1.0


def upside_down(s, t, z):
    """Points and the line upside down: its nosings are the inner corners."""
    line = StairLine(s0=-1.2, z0=-0.8, going=0.3, rise=0.2, first=0, last=4)
    return upright(line, assigned(line, -s, t, -z, 0.02))


def test_steps_hide_their_inner_corners_and_high_treads():
    """By hand: fronts of treads alone; all risers, and of treads the lower two."""
    front = np.concatenate([0.3 * k + np.linspace(0.03, 0.12, 50) for k in range(4)])
    seen = upright(LINE, assigned(LINE, front, 0 * front, treads(front), 0.02))
    beside = 4 * 36  # from 35 mm on, as far as treads are inner, to a third of a going
    assert seen == pytest.approx(math.log((beside + 5) / 5), abs=0.2)
    s = np.concatenate([0.3 * k + np.linspace(0.03, 0.27, 50) for k in range(2)])
    z = np.concatenate([0.2 * k + np.linspace(0.22, 0.38, 50) for k in range(4)])
    face = 0.3 * np.repeat(np.arange(1, 5), 50)
    s, z = np.r_[s, face], np.r_[treads(s), z]
    # risers up to four nosings lie one step and a half above the treads before them, two of them
    found = upright(LINE, assigned(LINE, s, 0 * s, z, 0.02))
    assert found == pytest.approx(1.5 - 0.5, abs=0.05)
    # upside down the treads are 2 and 3, and the risers 1 to 3: the lowest one is of no tread
    assert upside_down(s, 0 * s, z) == pytest.approx(1.0 - 2.5, abs=0.05)


def test_what_goes_on_has_no_end():
    """A floor that leads on before the first nosing; a wall above the last riser."""
    rng = np.random.default_rng(2)
    count = 20_000
    t, level = rng.uniform(0.0, 0.9, count), np.full(count, 0.2)
    s = rng.uniform(-2.0, 0.3, count)
    assert len(fronts(LINE, s, t, level, 0.01).at) == 0
    ends = fronts(LINE, np.abs(s), t, level, 0.01)
    assert np.median(ends.at[ends.step == 0]) == pytest.approx(0.0, abs=0.002)
    face, z = np.full(count, 1.2), rng.uniform(0.85, 2.0, count)
    assert len(tops(LINE, face, t, z, 0.01).at) == 0
    ends = tops(LINE, face, t, np.where(z > 1.0, z - 1.0, z), 0.01)
    assert np.median(ends.at) == pytest.approx(1.0, abs=0.005)
