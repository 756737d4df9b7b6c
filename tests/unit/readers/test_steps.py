"""Single steps of a flight: which points belong to them, and how alike their errors are."""

import numpy as np
import pytest

from kaidan.readers.stairfit.staircase_line import StairLine, assigned
from kaidan.readers.stairfit.steps import ALIKE_WITHIN, smooth_field


def test_an_error_that_varies_smoothly_averages_out_as_draws_do():
    """Oracle: a field of cosines with that correlation, averaged over the width of each nosing."""
    rng = np.random.default_rng(0)
    away = np.array([[1.8, -1.0], [2.1, -0.8], [2.4, -0.6], [3.6, 0.1]])
    width, fields = 1.0, 4000
    ranges = np.hypot(*away.T)
    across = np.linspace(-0.5, 0.5, 21) * width
    rays = np.stack(
        [np.column_stack([np.full(21, s), across, np.full(21, z)]) / r
         for (s, z), r in zip(away, ranges, strict=True)]
    )  # fmt: skip
    # cosines whose wave vectors have this spread are correlated by exp(-(angle / a)^2)
    waves = rng.normal(0, np.sqrt(2) / ALIKE_WITHIN, (fields, 3, 8))
    shifts = rng.uniform(0, 2 * np.pi, (fields, 8))
    field = np.cos(np.einsum("mli,fij->fmlj", rays, waves) + shifts[:, None, None, :])
    mean = field.sum(axis=3).mean(axis=2) / 2  # variance 1
    errors = mean[:, :, None] * away
    drawn = np.einsum("fmi,fnj->minj", errors, errors) / fields
    # 4 % of scatter in 4,000 fields, 4 % for the normal weights
    assert smooth_field(away, width) == pytest.approx(drawn, abs=0.08 * float(np.abs(drawn).max()))


def test_points_at_the_edges_do_not_say_which_element_they_lie_on():
    """Steps of 200 and 300 mm: the middles of tread and riser are inner, 10 mm from an edge not."""
    line = StairLine(s0=0.0, z0=0.2, going=0.3, rise=0.2, first=0, last=3)
    s = np.array([0.15, 0.01, 0.3, 0.3])
    z = np.array([0.2, 0.2, 0.3, 0.395])
    at = assigned(line, s, np.zeros(4), z, 0.02)
    assert at.tread.tolist() == [True, True, False, False]
    assert at.riser.tolist() == [False, False, True, True]
    assert at.inner.tolist() == [True, False, True, False]
