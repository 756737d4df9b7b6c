"""Force-angle measure of Papadopoulos & Rey (1996, doi:10.1109/ROBOT.1996.509185; 2000).

Their text was not at hand: the expected values are by hand from the definition, the properties
are those that the abstract of the 2000 paper claims.
"""

import numpy as np
import pytest

from kaidan.mechanics.measures import force_angle_measure

CART = {"x_0": 2.0, "x_n": 0.0, "C_L": 1.0, "C_N": 1.0, "M": 10.0, "g": 10.0}
ROUNDING = 1e-11  # moments of order 1e2 N m


def test_symmetric_cart_on_the_level():
    # hand: 45 degrees to either contact, 1 m from the line of force, 100 N
    assert force_angle_measure(**CART, theta_s=0.0, a=0.0) == pytest.approx(
        25.0 * np.pi, abs=ROUNDING
    )


def test_side_force_turns_the_resultant():
    # hand: a = g/sqrt(3) turns f by 30 degrees: 15 degrees are left, d = sqrt2 sin 15,
    # |f| = 200/sqrt3
    expected = np.pi / 12 * np.sqrt(2.0) * np.sin(np.pi / 12) * 200.0 / np.sqrt(3.0)
    for a in (10.0 / np.sqrt(3.0), -10.0 / np.sqrt(3.0)):
        assert force_angle_measure(**CART, theta_s=0.0, a=a) == pytest.approx(
            expected, abs=ROUNDING
        )


def test_zero_on_the_verge_and_negative_beyond():
    # hand: a = g on the level or 45 degrees at rest point f at the contact
    assert force_angle_measure(**CART, theta_s=0.0, a=10.0) == pytest.approx(0.0, abs=ROUNDING)
    assert force_angle_measure(**CART, theta_s=np.pi / 4, a=0.0) == pytest.approx(0, abs=ROUNDING)
    # hand: 15 degrees beyond at 60
    expected = -np.pi / 12 * np.sqrt(2.0) * np.sin(np.pi / 12) * 100.0
    assert force_angle_measure(**CART, theta_s=np.pi / 3, a=0.0) == pytest.approx(
        expected, abs=ROUNDING
    )


def test_sensitive_to_the_height_of_the_centroid():
    # paper (abstract of 2000): sensitive to changes in centre of mass height
    heights = np.linspace(0.2, 3.0, 20)
    cart = {k: v for k, v in CART.items() if k != "C_N"}
    measure = force_angle_measure(**cart, C_N=heights, theta_s=0.0, a=0.0)
    assert np.all(np.diff(measure) < 0.0)


def test_sensitive_to_heaviness():
    # paper (abstract of 2000): "the importance of considering ... system heaviness"; hand: linear
    light = force_angle_measure(**CART, theta_s=0.3, a=0.0)
    heavy = force_angle_measure(**{**CART, "M": 30.0}, theta_s=0.3, a=0.0)
    assert heavy == pytest.approx(3.0 * light, rel=1e-14)


def test_nearer_contact_governs():
    # hand: centroid 0.5 m from the lower contact: tan = 0.5, d = 0.5 m
    cart = {**CART, "C_L": 1.5}
    assert force_angle_measure(**cart, theta_s=0.0, a=0.0) == pytest.approx(
        np.arctan(0.5) * 0.5 * 100.0, abs=ROUNDING
    )
