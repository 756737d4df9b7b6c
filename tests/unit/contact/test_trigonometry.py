"""The kernel's own sines, cosines and angles against series to fifty digits."""

import math
from decimal import Decimal, getcontext

import numpy as np
import pytest

from kaidan.contact.kernel import trigonometry as own

ULP = 1.0
"""Of the result: no more than one unit in its last place."""
DIGITS = 60
COUNT = 400


@pytest.fixture(autouse=True)
def digits():
    context = getcontext()
    before, context.prec = context.prec, DIGITS
    yield
    context.prec = before


def arctan_of_part(n):
    """Arc tangent of 1 / n by its series."""
    total, power, k = Decimal(0), 1 / Decimal(n), 1
    while abs(power) > Decimal(10) ** -DIGITS:
        total += power / k if k % 4 == 1 else -power / k
        power, k = power / (n * n), k + 2
    return total


def cosine_and_sine(x):
    """By Taylor's series of the rest to whole turns; pi by Machin's formula."""
    turn = 8 * (4 * arctan_of_part(5) - arctan_of_part(239))
    y = Decimal(x) - turn * (Decimal(x) / turn).to_integral_value()
    cosine, sine, term, k = Decimal(0), Decimal(0), Decimal(1), 0
    while k < 8 or abs(term) > Decimal(10) ** -DIGITS:
        sign = -1 if k % 4 > 1 else 1
        cosine, sine = (cosine, sine + sign * term) if k % 2 else (cosine + sign * term, sine)
        k += 1
        term = term * y / k
    return cosine, sine


def off(found, expected):
    """How far a result is off, in units of its last place."""
    return abs(Decimal(found) - expected) / Decimal(math.ulp(float(expected)))


def angles():
    rng = np.random.default_rng(1)
    near = rng.integers(-400, 400, COUNT) * (math.pi / 4) + rng.choice([0.0, 1e-9, -1e-15], COUNT)
    small = rng.choice([-1.0, 1.0], COUNT) * 10.0 ** rng.uniform(-9.0, 0.0, COUNT)
    wide = rng.uniform(-1e6, 1e6, COUNT)
    return np.concatenate([rng.uniform(-4.0, 4.0, COUNT), near, small, wide]).tolist()


def test_sines_cosines_and_tangents():
    for x in angles():
        cosine, sine = cosine_and_sine(x)
        assert off(own.cos(x), cosine) <= ULP, x
        assert off(own.sin(x), sine) <= ULP, x
        assert off(own.tan(x), sine / cosine) <= ULP, x
        place = own.placed(1.0, 2.0, x)
        assert place == (1.0, 2.0, own.cos(x), own.sin(x))


def turned_by(angle, x, y):
    """How far an angle is off that of (x, y), in units of its last place."""
    cosine, sine = cosine_and_sine(angle)
    error = (y * cosine - x * sine) / (x * x + y * y).sqrt()
    return abs(error) / Decimal(math.ulp(angle))


def test_angles_of_points():
    rng = np.random.default_rng(2)
    for _ in range(COUNT):
        for x, y in (rng.uniform(-1, 1, 2), (10.0 ** rng.uniform(-6, 6), rng.normal()),
                     (1.0, 10.0 ** rng.uniform(-9, 3))):  # fmt: skip
            angle = own.atan2(float(y), float(x))
            assert turned_by(angle, Decimal(float(x)), Decimal(float(y))) <= ULP


def test_angles_of_sines_and_cosines():
    rng = np.random.default_rng(3)
    for _ in range(COUNT):
        for x in (rng.uniform(-1, 1), 1.0 - 10.0 ** rng.uniform(-16, 0), 10.0 ** rng.uniform(-9, 0),
                  10.0 ** rng.uniform(-16, 0) - 1.0):  # fmt: skip
            exact = Decimal(float(x))
            root = (1 - exact * exact).sqrt()
            assert turned_by(own.asin(float(x)), root, exact) <= ULP
            assert turned_by(own.acos(float(x)), exact, root) <= ULP


def test_limits():
    assert (
        own.sin(0.0) == own.tan(0.0) == own.asin(0.0) == own.acos(1.0) == own.atan2(0.0, 1.0) == 0
    )
    assert own.cos(0.0) == 1.0
    assert own.asin(1.0) == own.acos(0.0) == own.atan2(1.0, 0.0) == math.pi / 2
    assert own.acos(-1.0) == own.atan2(0.0, -1.0) == math.pi
    assert own.atan2(-1.0, 0.0) == own.asin(-1.0) == -math.pi / 2
    assert own.atan2(3.0, 3.0) == math.pi / 4
    assert own.atan2(0.0, 0.0) == 0.0
    assert own.atan2(math.inf, 1.0) == math.pi / 2
    for odd in (own.sin, own.tan, own.asin):
        assert odd(-0.3) == -odd(0.3)
    for outside in (math.inf, math.nan, 1.1e6, -1.1e6):
        assert all(math.isnan(of(outside)) for of in (own.sin, own.cos, own.tan))
    for outside in (1.0000001, -1.0000001, math.nan):
        assert math.isnan(own.asin(outside))
        assert math.isnan(own.acos(outside))
