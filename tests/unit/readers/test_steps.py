"""Single steps of a flight: which points belong to them, and how alike their errors are."""

import numpy as np
import pytest

from kaidan.readers.stairfit.doubts import ALIKE_WITHIN, LOCAL, common, correlation
from kaidan.readers.stairfit.flight_ends import last_riser
from kaidan.readers.stairfit.staircase_line import StairLine, assigned


def test_an_error_that_varies_smoothly_averages_out_as_draws_do():
    """Oracle: a field of cosines with that correlation, averaged over three treads and a floor."""
    rng = np.random.default_rng(0)
    low = np.array([[1.8, -0.5, -1.0], [2.1, -0.5, -0.8], [3.6, -0.5, 0.1], [0.8, -0.5, -1.2]])
    high = np.array([[2.1, 0.5, -1.0], [2.4, 0.5, -0.8], [3.9, 0.5, 0.1], [1.8, 0.5, -1.2]])
    points = low[:, None] + (high - low)[:, None] * rng.random((4, 200, 3))
    rays = points / np.linalg.norm(points, axis=2)[:, :, None]
    # cosines whose wave vectors have this spread are correlated by exp(-(angle / a)^2)
    fields = 3000
    waves = rng.normal(0, np.sqrt(2) / ALIKE_WITHIN, (fields, 3))
    shifts = rng.uniform(0, 2 * np.pi, fields)
    mean = np.sqrt(2) * np.cos(np.einsum("mli,fi->fml", rays, waves) + shifts[:, None, None])
    mean = mean.mean(axis=2)
    drawn = mean.T @ mean / fields
    found = correlation(points.mean(axis=1), points.std(axis=1))
    # 2 % of scatter in 3,000 fields, 5 % for the normal weights and the near end of the floor
    assert found == pytest.approx(drawn, abs=0.07)
    assert 0.1 < drawn[3, 3] < drawn[0, 0] < 0.9  # what averages out most is the floor


def two_nosings(floor):
    """Steps of 200 by 300 mm: faces and levels seen in their middles, the floor at a place."""
    nosings = np.array([[0.0, 0.2], [0.3, 0.4]])
    middles = [[0.0, 0.0, 0.1], [0.15, 0.0, 0.2], [0.3, 0.0, 0.3], [0.45, 0.0, 0.4], floor]
    places = np.zeros((5, 2, 3))
    places[:, 0] = middles
    return nosings, places


def first_riser(covariance):
    return float(np.sqrt(covariance[1, 1] + covariance[-1, -1] - 2 * covariance[1, -1]))


def test_a_first_riser_leans_by_how_far_the_floor_was_seen_from_the_tread():
    """By hand: 10 mrad over 0.15 m behind the nosing and 0.5 m before it; a face 0.1 m below it."""
    eye = np.array([-2.0, 0.0, 1.0])
    nosings, places = two_nosings([-0.5, 0.0, 0.0])
    found = common(nosings, places, eye=eye, range_error=0.0, level=0.01)
    assert first_riser(found) == pytest.approx(0.01 * 0.65)
    assert found[0, 0] == pytest.approx((0.01 * 0.1) ** 2)
    # from tread to tread it is as far as from nosing to nosing: nothing is left
    assert found[1, 1] + found[3, 3] - 2 * found[1, 3] == pytest.approx(0.0, abs=1e-15)


def test_what_is_seen_in_one_direction_errs_alike():
    """By hand: a floor straight below the tread, 1.2 and 1.0 m below the eye: 0.2 m remain."""
    nosings, places = two_nosings([0.15, 0.0, 0.0])
    over = np.array([0.15, 0.0, 1.2])
    found = common(nosings, places, eye=over, range_error=0.01, level=0.0)
    assert first_riser(found) == pytest.approx(LOCAL * 0.01 * 0.2)
    _, far = two_nosings([-3.0, 0.0, 0.0])  # in another direction both errors count
    found = common(nosings, far, eye=over, range_error=0.01, level=0.0)
    assert first_riser(found) == pytest.approx(LOCAL * 0.01 * np.hypot(1.0, 1.2), rel=1e-3)


def test_points_at_the_edges_do_not_say_which_element_they_lie_on():
    """Steps of 200 and 300 mm: the middles of tread and riser are inner, 10 mm from an edge not."""
    line = StairLine(s0=0.0, z0=0.2, going=0.3, rise=0.2, first=0, last=3)
    s = np.array([0.15, 0.01, 0.3, 0.3])
    z = np.array([0.2, 0.2, 0.3, 0.395])
    at = assigned(line, s, np.zeros(4), z, 0.02)
    assert at.tread.tolist() == [True, True, False, False]
    assert at.riser.tolist() == [False, False, True, True]
    assert at.inner.tolist() == [True, False, True, False]


def landing(points, alone=True):
    """Nosings of five steps of 150 by 300 mm, 0.9 m wide, with what lies above the last one."""
    number = np.arange(5)
    found = np.column_stack([0.3 * number, 0.15 * (number + 1.0)])
    line = StairLine(s0=0.0, z0=0.15, going=0.3, rise=0.15, first=0, last=4)
    tread = np.random.default_rng(1).uniform([0.9, 0.0, 0.599], [1.2, 0.9, 0.601], (900, 3))
    s, t, z = (np.r_[one, other] for one, other in zip(points, tread.T, strict=True))
    sigma, measured = np.full((5, 2), 1e-3), np.ones((5, 2), dtype=bool)
    measured[-1, 1] = alone
    places = np.full((5, 2, 2, 3), np.nan)
    nosings, *_, length = last_riser(found, sigma, measured, places, line, s, t, z, 0.003, 0.01)
    return len(nosings), length


def strewn(low, high, count=300):
    """Points one riser above the last nosing, from one t to another."""
    rng = np.random.default_rng(0)
    s, t = rng.uniform(1.5, 2.4, count), rng.uniform(low, high, count)
    return s, t, rng.normal(0.90, 0.002, count)


def test_a_landing_is_as_wide_as_the_flight():
    nosings, length = landing(strewn(0.0, 0.9))
    assert nosings == 6
    assert length == pytest.approx(0.9, abs=0.1)


def test_what_stands_at_the_sides_is_no_landing():
    """A box on 0.25 m of the width; walls at both sides; a dozen stray points between."""
    box = strewn(0.0, 0.25)
    walls = [
        np.r_[one, other] for one, other in zip(strewn(0, 0.05), strewn(0.85, 0.9), strict=True)
    ]
    stray = [np.r_[one, other] for one, other in zip(box, strewn(0.25, 0.9, 9), strict=True)]
    for points in (box, walls, stray):
        nosings, length = landing(points)
        assert nosings == 5
        assert np.isnan(length)


def test_walls_at_both_sides_say_nothing_of_a_last_level_that_was_not_seen():
    """25 mm above the regular level of the last nosing, 0.75 m: within an odd riser of it."""

    def moved(points):
        return points[0] - 0.27, points[1], points[2] - 0.125

    one, other = strewn(0.0, 0.05), strewn(0.85, 0.9)
    sides = [np.r_[each] for each in zip(one, other, strict=True)]
    nosings, length = landing(moved(strewn(0.0, 0.9)), alone=False)
    assert nosings == 5
    assert length == pytest.approx(0.93, abs=0.05)  # to s = 2.13, from 1.2
    nosings, length = landing(moved(sides), alone=False)
    assert nosings == 5
    assert np.isnan(length)


@pytest.mark.parametrize("odd", [-0.03, 0.02])
@pytest.mark.parametrize("end", [False, True])
def test_a_last_level_is_not_drawn_to_the_regular_one(odd, end):
    """9 mm of noise, and points within 27 mm of the regular level, of which its mean was taken; or
    the end of its face, seen 6 mm too high, though its landing is seen."""
    rng = np.random.default_rng(3)
    number = np.arange(5)
    found = np.column_stack([0.3 * number, 0.15 * (number + 1.0)])
    line = StairLine(s0=0.0, z0=0.15, going=0.3, rise=0.15, first=0, last=4)
    s, t = rng.uniform(1.2, 2.2, 2000), rng.uniform(0.0, 0.9, 2000)
    z = rng.normal(0.75 + odd, 0.009, 2000)
    near = np.abs(z - 0.75) < 0.027
    found[-1, 1] = 0.75 + odd + 0.006 if end else z[near].mean()
    assert end or abs(found[-1, 1] - 0.75 - odd) > 0.003
    sigma, measured = np.full((5, 2), 4e-3), np.ones((5, 2), dtype=bool)
    places = np.full((5, 2, 2, 3), np.nan)
    nosings, sigma, *_ = last_riser(found, sigma, measured, places, line, s, t, z, 0.009, 0.027)
    assert nosings[-1, 1] == pytest.approx(0.75 + odd, abs=4 * 0.009 / np.sqrt(2000))
    assert sigma[-1, 1] < 5e-4
