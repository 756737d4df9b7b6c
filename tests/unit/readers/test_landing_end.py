"""Where a landing ends: points that were placed by hand."""

import numpy as np
import pytest

from kaidan.readers.stairfit.landing_end import landing_end

WIDTH = (-0.5, 0.5)


def plate(ahead, t, over):
    """Points every 20 mm over the ranges of two coordinates, the third being fixed."""
    axes = [
        np.arange(*each, 0.02) if isinstance(each, tuple) else [each] for each in (ahead, t, over)
    ]
    return [each.ravel() for each in np.meshgrid(*axes)]


def test_a_wall_across_ends_the_landing():
    floor = plate((0.0, 1.0), WIDTH, 0.0)
    wall = plate(1.0, WIDTH, (0.0, 2.0))
    both = [np.concatenate(each) for each in zip(floor, wall, strict=True)]
    assert landing_end(*both, width=WIDTH) == pytest.approx(1.0)


@pytest.mark.parametrize(
    "points",
    [
        plate((0.0, 3.0), WIDTH, 0.0),  # a floor alone
        plate(1.0, (-0.2, 0.3), (0.0, 1.8)),  # somebody stands there
        plate((0.5, 3.0), -0.45, (0.8, 0.9)),  # a handrail
        plate(5.0, WIDTH, (0.0, 2.0)),  # too far to matter
        [np.concatenate(each) for each in zip(
            *(plate(0.3 * k, WIDTH, (0.17 * (k - 1), 0.17 * k)) for k in range(1, 6)), strict=True
        )],  # the risers of a flight
    ],
)  # fmt: skip
def test_nothing_else_does(points):
    assert np.isnan(landing_end(*points, width=WIDTH))
