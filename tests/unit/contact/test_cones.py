"""The kernel's cones of two contacts: those of the formula, draw by draw, and by hand."""

import math

import numpy as np
import pytest

from formulas.cones import cone_margin
from kaidan.contact.kernel import cones as cones_module
from kaidan.contact.kernel.cones import BELOW, NARROWEST, root_below
from kaidan.contact.layout import Cone
from kaidan.mechanics import STANDARD_GRAVITY
from kernel_memory import called

NAMES = ("x_1", "z_1", "alpha_1", "phi_1", "x_2", "z_2", "alpha_2", "phi_2", "W_x", "W_z")


held_below, narrowed = called(cones_module.held_below), called(cones_module.narrowed)


def cone_margins(cones):
    """The kernel's margin of each draw."""
    draws = np.stack(np.broadcast_arrays(*cones), axis=-1)
    return np.array(
        [
            cones_module.cone_margin(Cone(*each[:4]), Cone(*each[4:8]), *each[8:])
            for each in draws.tolist()
        ]
    )


def drawn(count: int) -> list[np.ndarray]:
    rng = np.random.default_rng(0)
    each = []
    for side in (-1.0, 1.0):
        each += [side * rng.uniform(-0.05, 0.5, count), rng.uniform(-0.4, 0.1, count)]
        each += [rng.uniform(-1.5, 1.5, count), rng.uniform(0.1, 1.2, count)]
    return [*each, rng.normal(size=count), STANDARD_GRAVITY + rng.normal(size=count)]


def test_the_margins_are_those_of_the_formula():
    cones = drawn(5_000)
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
    # on the level no cone is too narrow, but for the narrowest that is looked at
    assert found[0] == pytest.approx(0.7 - NARROWEST, abs=1e-9)


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
    """l >= 1 and l <= 1, and two bounds that hold; none is left of l >= 1 + t / 2, t = 0.1."""
    bounds = [(-1.0, 0.0, 1.0, 0.0), (1.0, 0.0, -1.0, 0.0), *2 * [(1.0, 0.0, 0.0, 0.0)]]
    assert held_below(*(bounds[k] for k in order), 0.1) == 0.1
    bounds[0] = (-1.0, 0.5, 1.0, 0.0)
    below = held_below(*(bounds[k] for k in order), 0.1)
    assert below == pytest.approx(0.0, abs=2 * BELOW)
    assert held_below(*(bounds[k] for k in order), below) == below < 0.0


def test_a_level_bound_that_fails_does_so_there_alone():
    """(t - 0.2) l >= 0.1: at t = 0.2 there is none, below it l is negative."""
    level, others = (-0.1, 0.0, -0.2, -1.0), 3 * [(1.0, 0.0, 0.0, 0.0)]
    assert held_below(level, *others, 0.2) == pytest.approx(0.2 - BELOW * 1.04, abs=1e-15)
    assert held_below(*others, level, 0.2) < 0.2
    assert held_below(level, *others, 0.1) == 0.1


def test_a_bound_that_turns_round_is_looked_at_there():
    """l >= 5 and 0.1 + (t - 0.2) l <= 0: the two meet at 0.18, but from 0.2 down both are lower."""
    low, high = (-5.0, 0.0, 1.0, 0.0), (-0.1, 0.0, 0.2, 1.0)
    found = held_below(low, high, *2 * [(1.0, 0.0, 0.0, 0.0)], 0.5)
    assert found == pytest.approx(0.2, abs=2 * BELOW)


@pytest.mark.parametrize(
    ("square", "line", "constant", "below", "root"),
    [(1.0, -3.0, 2.0, 5.0, 2.0), (1.0, -3.0, 2.0, 2.0, 1.0), (1.0, -3.0, 2.0, 1.0, -math.inf),
     (-1.0, 3.0, -2.0, 5.0, 2.0), (0.0, 2.0, -1.0, 5.0, 0.5), (0.0, 0.0, 1.0, 5.0, -math.inf),
     (1.0, 0.0, 1.0, 5.0, -math.inf), (1.0, 3.0, 0.0, 5.0, 0.0), (1.0, 3.0, 0.0, 0.0, -3.0),
     (0.0, -1.0, 0.5, 5.0, 0.5)],
)  # fmt: skip
def test_the_largest_root_below_a_number(square, line, constant, below, root):
    assert root_below(square, line, constant, below) == pytest.approx(root)


def test_a_cone_that_is_a_ray_does_not_pull():
    """The narrower cone's axis is level with the line of the contacts, its force would pull."""
    one = [-0.3943674343550716, -0.2962683287614987, 0.8001491339634064, 1.1128559724051361]
    other = [0.44247560146005244, 0.05563385325678011, 1.5903982987795184, 0.15354626268181581]
    assert cone_margins([*one, *other, [0.29897012596605993], 11.663551185556775]) == -math.inf
