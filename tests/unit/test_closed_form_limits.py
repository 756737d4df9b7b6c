"""Limits and margins of slope by the closed form, against the paper and hand calculations; see
`closed_form_cases` for the tags."""

from math import atan, atan2, cos, degrees, radians, tan

import pytest

from closed_form_cases import ANGLE, BARE, C_L, C_N, GRIP, G, L, assess, flight, kenaf, robot

# The paper's numbers


@pytest.mark.parametrize(
    ("p", "sup"), [(0.150, 60.205), (0.180, 52.936), (0.200, 46.185), (0.220, 37.255)]
)
def test_steepest_slope_of_kenaf(p, sup):
    # paper prints 60.2 at 150 mm; the others hand: atan((470 - p - 196) / 71)
    answer = kenaf(30, p)
    found = answer.closed_form
    assert found.margin_angle_deg == pytest.approx(sup, abs=5e-4)  # three printed places
    assert found.margin_angle_deg == pytest.approx(degrees(atan2(L - p - C_L, C_N)), **ANGLE)
    assert found.margin_backward_deg == pytest.approx(found.margin_angle_deg - 30, **ANGLE)
    assert found.contacts_n == (3 if p == 0.150 else 2)  # hand: floor(470 / p)
    assert answer.angle_deg == pytest.approx(30, **ANGLE)
    assert answer.nosing_spacing_m == pytest.approx(p, abs=1e-15)
    assert (answer.flat_length_m, answer.com_from_front_m, answer.com_height_m) == (L, C_L, C_N)
    assert answer.mass_kg is None


@pytest.mark.parametrize(("p", "inf"), [(0.150, None), (0.180, None), (0.200, 3.2), (0.220, 18.7)])
def test_gentlest_slope_of_kenaf(p, inf):
    # hand: atan((p - 196) / 71), no limit where the centroid lies behind the second nosing
    lower = kenaf(30, p).closed_form.lower_angle_deg
    assert lower == (None if inf is None else pytest.approx(inf, abs=0.05))  # one printed place
    if inf is not None:
        assert lower == pytest.approx(degrees(atan2(p - C_L, C_N)), **ANGLE)


def test_below_the_gentlest_slope_the_nose_drops():
    # hand: 15 deg is 3.677 deg below atan(24 / 71)
    answer = kenaf(15, 0.220, **BARE)
    assert (answer.verdict, answer.governs, answer.falls_over) == ("no-go", "tip_uphill", "nose")
    assert answer.margin_deg == pytest.approx(15 - degrees(atan(24 / 71)), **ANGLE)


def test_nose_first_descent_of_kenaf():
    # hand: atan(46 / 71) = 32.9 deg; Kenaf has room for 60.2 deg in reverse
    answer = kenaf(30, 0.150, direction="down")
    found = answer.closed_form
    assert found.margin_angle_deg == pytest.approx(32.9, abs=0.05)
    assert found.margin_angle_deg == pytest.approx(degrees(atan(46 / 71)), **ANGLE)
    # no grouser locks on the way down: only theta_d is subtracted
    assert answer.margin_deg == pytest.approx(degrees(atan(46 / 71)) - 30 - 2.6, **ANGLE)
    back = kenaf(30, 0.150, direction="down", facing="tail-first")
    assert back.closed_form.margin_angle_deg == pytest.approx(60.205, abs=5e-4)
    assert back.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 30 - 2.6, **ANGLE)


def test_corrected_margin_of_the_paper():
    # paper, Eq. (24) with its measured figures: 55.0-56.4 deg at 150 mm
    measured = {"theta_d": radians(2.6), "theta_M": (radians(1.2), radians(2.6))}
    answer = kenaf(50, 0.150, **measured)
    assert 50 + answer.margin_deg == pytest.approx(55.0, abs=0.05)
    assert 50 + answer.margin_best_deg == pytest.approx(56.4, abs=0.05)


def test_rocking_of_the_paper():
    # paper: at (200 mm, 44.0 deg), 0.1 m/s, no fall but the body rocks
    # docs/theory/measures.md: energy margin 0.07 mm; hand: v^2 / 2g = 0.51 mm
    answer = kenaf(44, 0.200, speed=0.1)
    found = answer.closed_form
    assert found.measures.energy_margin_mm == pytest.approx(0.07, abs=0.005)
    assert found.measures.speed_height_mm == pytest.approx(1e3 * 0.01 / (2 * G), rel=1e-12)
    assert any("the robot may rock" in note for note in answer.notes)
    assert not any("rock" in note for note in kenaf(30, 0.200, speed=0.1).notes)
    assert not any("rock" in note for note in kenaf(60, 0.200, speed=0.1).notes)  # it falls


def test_acceleration_acts_like_inclination():
    # hand: the robot tips when tan(theta) + a / (g cos(theta)) = (L - p - C_L) / C_N
    answer = kenaf(30, 0.150, acceleration=1.5).closed_form
    theta = radians(answer.margin_angle_deg)
    assert tan(theta) + 1.5 / (G * cos(theta)) == pytest.approx(124 / 71, rel=1e-12)
    assert answer.margin_angle_deg < 60.205
    assert kenaf(30, 0.150, acceleration=-1.5).closed_form.margin_angle_deg > 60.205


# Allowances


def test_allowances_unless_measured():
    up, down = kenaf(30, 0.150).allowances, kenaf(30, 0.150, direction="down").allowances
    for shown in (up["theta_d"], up["theta_M"], down["theta_d"]):
        assert (shown.low_deg, shown.source) == (0.0, "default")
        assert shown.high_deg == pytest.approx(2.6, **ANGLE)
    assert (down["theta_M"].high_deg, down["theta_M"].source) == (0.0, "not applicable")


def test_measured_allowances_are_shown_and_subtracted():
    answer = kenaf(30, 0.150, theta_d=radians(1.0), theta_M=(radians(0.5), radians(2.0)))
    assert answer.allowances["theta_d"].source == "measured"
    assert answer.allowances["theta_d"].low_deg == pytest.approx(1.0, **ANGLE)
    assert answer.allowances["theta_M"].high_deg == pytest.approx(2.0, **ANGLE)
    assert answer.margins_deg["tip_downhill"] == pytest.approx(
        degrees(atan(124 / 71)) - 30 - 3.0, **ANGLE
    )
    # theta_M acts at the lowest contact: not on tipping uphill; hand: atan(-46 / 71) = -32.94
    assert answer.margins_deg["tip_uphill"] == pytest.approx(
        30 + degrees(atan(46 / 71)) - 1.0, **ANGLE
    )
    assert answer.margin_best_deg == pytest.approx(degrees(atan(124 / 71)) - 31.5, **ANGLE)
    assert kenaf(30, 0.150, direction="down", theta_M=0.02).allowances["theta_M"].source == (
        "measured"
    )


def test_centroid_margin():
    # hand: L - p - C_L - C_N tan(theta + 5.2 deg), the other side is further away
    answer = kenaf(40, 0.150)
    expected = 1e3 * (L - 0.150 - C_L - C_N * tan(radians(45.2)))
    assert answer.closed_form.margin_centroid_mm == pytest.approx(expected, rel=1e-12)
    # uphill: C_L - p + C_N tan(theta - 2.6 deg)
    answer = kenaf(20, 0.220)
    expected = 1e3 * (C_L - 0.220 + C_N * tan(radians(17.4)))
    assert answer.closed_form.margin_centroid_mm == pytest.approx(expected, rel=1e-12)
    for angle in range(8, 70):
        answer = kenaf(angle, 0.200)
        tips = min(answer.margins_deg[mode] for mode in ("tip_downhill", "tip_uphill"))
        assert (answer.closed_form.margin_centroid_mm > 0) == (tips > 0)


def test_past_the_vertical_no_place_of_the_centroid_holds():
    # 80 deg and 0.3 + 0.3 rad of allowances lean past 90 deg, where the tangent turns positive
    answer = kenaf(80, 0.150, theta_d=0.3, theta_M=0.3)
    assert (answer.verdict, answer.closed_form.margin_centroid_mm) == ("no-go", None)
    assert '"margin_centroid_mm": null' in answer.to_json()


def test_half_the_track_is_inside():
    # limit: p = L / 2 leaves two contacts; the least more does not. Both tips meet at C_L = L / 2
    half = assess(robot(com_from_front=0.2), flight(26, 0.25), friction=GRIP, **BARE)
    assert half.verdict == "no-go"
    assert half.closed_form.margin_angle_deg == pytest.approx(
        half.closed_form.lower_angle_deg, **ANGLE
    )
    assert assess(robot(), flight(10, 0.2501), friction=GRIP).verdict == "outside-model"
