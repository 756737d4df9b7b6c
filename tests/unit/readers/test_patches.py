"""Small flat pieces of a cloud: rasters and principal variances against what makes no short cut."""

import numpy as np
import pytest

from kaidan.readers.stairfit.patches import joined, principal, rastered, scatter, thinnest


def cloud(seed=0, count=4000):
    return np.random.default_rng(seed).uniform(-1.3, 0.9, (count, 3))


def test_cubes_of_twice_the_side_are_joined_from_small_ones():
    """Oracle: the raster of the points themselves."""
    xyz = cloud()
    fast, plain = joined(rastered(xyz, 0.125)), rastered(xyz, 0.25)
    assert fast.side == plain.side
    assert (fast.place == plain.place).all()
    assert (fast.of_point == plain.of_point).all()
    for name in ("count", "first", "second"):  # 1e-12: sums of 60 numbers below 1
        assert getattr(fast, name) == pytest.approx(getattr(plain, name), abs=1e-12)


def test_principal_variances_are_those_of_lapack():
    rng = np.random.default_rng(1)
    each = rng.normal(size=(200, 3, 3)) * rng.choice([1.0, 0.1], size=(200, 1, 3))
    matrix = each @ each.swapaxes(1, 2)
    values, vectors = np.linalg.eigh(matrix)
    packed = matrix[:, [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]].T
    found = principal(packed)
    assert found == pytest.approx(values.T, abs=1e-7 * float(values.max()))  # root of the precision
    along = np.abs((thinnest(packed, found[0]) * vectors[:, :, 0]).sum(axis=1))
    apart = values[:, 1] > 1.01 * values[:, 0] + 1e-6  # else any direction is as good
    assert along[apart] == pytest.approx(np.ones(int(apart.sum())), abs=1e-6)


def test_the_scatter_of_a_plane_is_that_of_its_points():
    """5 mm about a plane that leans: of 1,600 pieces with 12 points each, ten per cent."""
    rng = np.random.default_rng(2)
    x, y = rng.uniform(0, 2, (2, 20_000))
    z = 0.2 * x - 0.1 * y + rng.normal(0, 0.005, 20_000) * np.sqrt(1 + 0.2**2 + 0.1**2)
    found = scatter(rastered(np.column_stack([x, y, z]), 0.05))
    assert found == pytest.approx(0.005, rel=0.1)
