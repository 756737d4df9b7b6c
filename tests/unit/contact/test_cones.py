"""The kernel's cones of two contacts: those of the formula, draw by draw, and by hand."""

import math

import numpy as np
import pytest

from kaidan.contact import using_kernel
from kaidan.contact.kernel.cones import cones_hold, narrowed
from kaidan.contact.switch import kernel
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.cones import cone_margin

NAMES = ("x_1", "z_1", "alpha_1", "phi_1", "x_2", "z_2", "alpha_2", "phi_2", "W_x", "W_z")


def cone_margins(cones):
    """The kernel's margin of each draw."""
    draws = np.stack(np.broadcast_arrays(*cones), axis=-1)
    return np.array([kernel().cone_margin(*each) for each in draws.tolist()])


def drawn(count: int) -> list[np.ndarray]:
    rng = np.random.default_rng(0)
    each = []
    for side in (-1.0, 1.0):
        each += [side * rng.uniform(-0.05, 0.5, count), rng.uniform(-0.4, 0.1, count)]
        each += [rng.uniform(-1.5, 1.5, count), rng.uniform(0.1, 1.2, count)]
    return [*each, rng.normal(size=count), STANDARD_GRAVITY + rng.normal(size=count)]


@pytest.mark.parametrize(("choice", "count"), [("auto", 20_000), ("plain", 300)])
def test_the_margins_are_those_of_the_formula(choice, count):
    cones = drawn(count)
    with using_kernel(choice):
        found = cone_margins(cones)
    expected = cone_margin(**dict(zip(NAMES, cones, strict=True)))
    assert 0.05 < np.isinf(expected).mean() < 0.95
    # a halving that is decided by rounding is worth 1e-5 rad
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-5)


def test_on_one_plane_the_margin_is_the_friction_less_the_slope():
    slope = np.radians([0.0, 10.0, 30.0])
    c, s = np.cos(slope), np.sin(slope)
    one = [-c - 0.1 * s, -s - 0.1 * c, -slope, 0.7]
    other = [c - 0.1 * s, s - 0.1 * c, -slope, 0.7]
    found = cone_margins([*one, *other, 0.0, STANDARD_GRAVITY])
    np.testing.assert_allclose(found, 0.7 - slope, atol=1e-5)


def test_contacts_at_one_place_are_not_known():
    assert np.isnan(cone_margins([0.1, -0.1, 0.0, 0.7, 0.1, -0.1, 0.0, 0.7, [0.0], 9.8])).all()


@pytest.mark.parametrize("t", [0.0, 0.2])
def test_a_bound_of_the_inner_force(t):
    """a - b t + (c - d t) l >= 0; whether a level bound holds does not depend on l."""
    for constant, left in ((0.5, (-1.0, 2.0)), (0.0, (-1.0, 2.0)), (-0.5, (math.inf, -math.inf))):
        assert narrowed((constant + 0.3 * t, 0.3, 0.7 * t, 0.7), t, -1.0, 2.0) == left
    rising, falling = (-0.5 + t, 1.0, 2.0 + t, 1.0), (0.5 + t, 1.0, -2.0 + t, 1.0)
    assert narrowed(rising, t, -1.0, 2.0) == pytest.approx((0.25, 2.0))
    assert narrowed(falling, t, -1.0, 2.0) == pytest.approx((-1.0, 0.25))


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (2, 0, 1, 3), (2, 3, 0, 1)])
def test_one_inner_force_is_enough(order):
    """l >= 1 and l <= 1, and two bounds that hold; none is left of l >= 1.1."""
    bounds = [(-1.0, 0.0, 1.0, 0.0), (1.0, 0.0, -1.0, 0.0), *2 * [(1.0, 0.0, 0.0, 0.0)]]
    assert cones_hold(*(bounds[k] for k in order), 0.1)
    bounds[0] = (-1.1, 0.0, 1.0, 0.0)
    assert not cones_hold(*(bounds[k] for k in order), 0.1)
