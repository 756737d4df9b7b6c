"""Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, equation by equation.

Tags: (paper) printed in the paper's text; (hand) from a calculation beside it; (limit) a limiting
case; (oracle) an independent method. The points of Figs. 13, 16, 19 and 21 exist only as pictures
and are not used.
"""

import numpy as np
import pytest

from formulas.paper import (
    friction_reserve,
    moment_about_highest,
    moment_about_lowest,
    theta_beta_arccos,
    tip_acceleration_downhill,
    tip_acceleration_uphill,
)
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.band import a_max, a_min, a_min_with_slip
from kaidan.mechanics.loads import load_shares, zero_moment_point
from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
    margin_per_centroid_length,
    semi_stable_limit,
    slope_limit,
    theta_s_inf,
    theta_s_sup,
    theta_s_sup_arccos,
    theta_s_sup_corrected,
)
from kaidan.mechanics.margins import acceleration_bounds, margins
from kaidan.mechanics.measures import energy_margin_backward, kinetic_energy_height
from kaidan.mechanics.plane import Area, area, contact_count, lowest_contact
from kaidan.mechanics.slipping import (
    equivalent_slope,
    normal_sum,
    required_friction,
    slip_acceleration_down,
    slip_acceleration_up,
    traction_sum,
)
from kaidan.mechanics.tipping import a_r0, a_rn, max_a_rn, min_a_r0
from kaidan.mechanics.triangle import alpha, beta, d_C, theta_alpha, theta_alpha_arccos, theta_beta

# Table 1 (paper): Kenaf without its sub-tracks [m]
C_L, C_N, L = 0.196, 0.071, 0.470
CENTROID = {"C_L": C_L, "C_N": C_N}
KENAF = {"L": L, **CENTROID}

# Verification test (paper): nosing spacings [m] and speed [m/s]
SPACINGS = (0.150, 0.180, 0.200, 0.220)
SPEED = 0.100

G = STANDARD_GRAVITY
EXACT = 1e-12  # rounding of a dozen operations on numbers up to 1e2

# theta_s_sup (hand): arctan(124/71), (94/71), (74/71), (54/71) to three decimals [deg]
LIMITS = dict(zip(SPACINGS, (60.205, 52.936, 46.185, 37.255), strict=True))
THREE_DECIMALS = 0.0005


def on_the_stairs(along, normal, theta_s):
    """Vector with components up the stairs and normal to them, in level coordinates."""
    up = np.array([np.cos(theta_s), np.sin(theta_s)])
    out = np.array([-np.sin(theta_s), np.cos(theta_s)])
    return along * up + normal * out


def cross(r, f):
    """Moment of a force, counterclockwise positive: nose up for a robot that climbs rightwards."""
    return r[0] * f[1] - r[1] * f[0]


def weight_and_inertia(M, a, theta_s):
    return M * np.array([0.0, -G]) - M * a * on_the_stairs(1.0, 0.0, theta_s)


# Slipping


def test_eq_1_slipping_begins_where_the_reserve_is_used_up():
    # hand: 0.6 * 100 N - 60 N; equality is not safe
    assert friction_reserve(traction=60.0, normal=100.0, mu_s=0.6) == pytest.approx(0.0, abs=EXACT)
    assert friction_reserve(traction=59.0, normal=100.0, mu_s=0.6) == pytest.approx(1.0, abs=EXACT)


@pytest.mark.parametrize("theta_s", [0.0, 0.5, 1.1])
@pytest.mark.parametrize("a", [-2.0, 0.0, 3.0])
def test_eqs_2_and_3_balance_weight_and_inertia(theta_s, a):
    # oracle: forces in level coordinates
    traction = traction_sum(M=12.0, a=a, theta_s=theta_s)
    normal = normal_sum(M=12.0, theta_s=theta_s)
    ground = on_the_stairs(traction, normal, theta_s)
    np.testing.assert_allclose(ground + weight_and_inertia(12.0, a, theta_s), 0.0, atol=1e-12)


@pytest.mark.parametrize("theta_s", [0.0, 0.5, 1.1])
@pytest.mark.parametrize("mu_s", [0.3, 0.9, 2.0])
def test_eqs_4_and_14_use_the_reserve_up_exactly(theta_s, mu_s):
    # hand: Eqs. (2) and (3) in Eq. (1), whatever the mass
    a_S = slip_acceleration_up(mu_s=mu_s, theta_s=theta_s)
    traction = traction_sum(M=9.0, a=a_S, theta_s=theta_s)
    reserve = friction_reserve(
        traction=traction, normal=normal_sum(M=9.0, theta_s=theta_s), mu_s=mu_s
    )
    assert reserve == pytest.approx(0.0, abs=1e-11)  # difference of numbers of order 1e2
    # and the side that the paper leaves out: traction down the stairs
    a_down = slip_acceleration_down(mu_s=mu_s, theta_s=theta_s)
    downwards = -traction_sum(M=9.0, a=a_down, theta_s=theta_s)
    assert downwards == pytest.approx(mu_s * normal_sum(M=9.0, theta_s=theta_s), abs=1e-11)
    # the friction needed at either limit is the friction there is
    for limit in (a_S, a_down):
        assert required_friction(theta_s=theta_s, a=limit) == pytest.approx(mu_s, abs=EXACT)


# Falling backward and forward

PROGRESS = np.array([0.0, 0.005, 0.015, 0.03, 0.1, 0.149])


@pytest.mark.parametrize("theta_s", [0.2, 0.9])
@pytest.mark.parametrize("a", [-1.5, 0.0, 1.0])
def test_eq_5_is_the_balance_of_moments_about_t_0(theta_s, a):
    # oracle: normal forces of three contacts from statics and equal springs, moments by vectors
    M, p, n, d = 12.0, 0.15, 3, 0.01
    contacts = d + p * np.arange(n, -1, -1)  # t_0 first, behind the front tip
    x_z = zero_moment_point(**CENTROID, theta_s=theta_s, a=a)
    f_kN = M * G * np.cos(theta_s) * load_shares(x=contacts, x_z=x_z)
    turning = moment_about_lowest(
        M=M,
        a=a,
        alpha=alpha(d=d, k=n, p=p, **CENTROID),
        theta_alpha=theta_alpha(d=d, k=n, p=p, **CENTROID),
        theta_s=theta_s,
    )
    arm = on_the_stairs(contacts[0] - C_L, C_N, theta_s)
    assert turning == pytest.approx(cross(arm, weight_and_inertia(M, a, theta_s)), abs=1e-12)
    assert np.sum(np.arange(n + 1) * p * f_kN) + turning == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("theta_s", [0.2, 0.9])
@pytest.mark.parametrize("a", [-1.5, 0.0, 1.0])
def test_eq_11_is_the_balance_of_moments_about_t_n(theta_s, a):
    # oracle
    M, p, n, d = 12.0, 0.15, 3, 0.01
    contacts = d + p * np.arange(n, -1, -1)
    x_z = zero_moment_point(**CENTROID, theta_s=theta_s, a=a)
    f_kN = M * G * np.cos(theta_s) * load_shares(x=contacts, x_z=x_z)
    turning = moment_about_highest(
        M=M,
        a=a,
        beta=beta(d=d, **CENTROID),
        theta_beta=theta_beta(d=d, **CENTROID),
        theta_s=theta_s,
    )
    arm = on_the_stairs(contacts[-1] - C_L, C_N, theta_s)
    assert turning == pytest.approx(-cross(arm, weight_and_inertia(M, a, theta_s)), abs=1e-12)
    assert np.sum((n - np.arange(n + 1)) * p * f_kN) + turning == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("d", PROGRESS)
def test_eqs_6_and_7_turn_the_moment_round(d):
    # limit: the moment of Eq. (5) without the other contacts vanishes at a_r0, grows beyond
    p, theta_s = 0.15, 0.8
    k = 3 if d < 0.02 else 2
    arm = alpha(d=d, k=k, p=p, **CENTROID)
    angle = theta_alpha(d=d, k=k, p=p, **CENTROID)
    limit = tip_acceleration_downhill(theta_alpha=angle, theta_s=theta_s)
    pose = {"M": 10.0, "alpha": arm, "theta_alpha": angle, "theta_s": theta_s}
    assert moment_about_lowest(**pose, a=limit) == pytest.approx(0.0, abs=1e-12)
    assert (
        moment_about_lowest(**pose, a=limit + 0.1)
        > 0.0
        > moment_about_lowest(**pose, a=limit - 0.1)
    )


@pytest.mark.parametrize("d", PROGRESS)
def test_eq_12_turns_the_other_moment_round(d):
    # limit
    theta_s = 0.8
    angle = theta_beta(d=d, **CENTROID)
    limit = tip_acceleration_uphill(theta_beta=angle, theta_s=theta_s)
    pose = {
        "M": 10.0,
        "beta": beta(d=d, **CENTROID),
        "theta_beta": angle,
        "theta_s": theta_s,
    }
    assert moment_about_highest(**pose, a=limit) == pytest.approx(0.0, abs=1e-12)
    assert (
        moment_about_highest(**pose, a=limit - 0.1)
        > 0.0
        > moment_about_highest(**pose, a=limit + 0.1)
    )


@pytest.mark.parametrize("p", SPACINGS)
def test_eqs_8_and_13_agree_with_the_closed_forms(p):
    # hand: arccos of the law of cosines = arctangent of the same triangle, to rounding
    n = int(L // p)
    for k, d in ((n, np.linspace(0.0, L - n * p, 7)), (n - 1, np.linspace(L - n * p, p, 7))):
        sides = {"alpha": alpha(d=d, k=k, p=p, **CENTROID), "beta": beta(d=d, **CENTROID)}
        # angles of 0.2 rad and more: arccos loses a factor of 1/sin(angle), at most 5
        np.testing.assert_allclose(
            theta_alpha_arccos(**sides, k=k, p=p),
            theta_alpha(d=d, k=k, p=p, **CENTROID),
            rtol=0,
            atol=1e-14,
        )
        np.testing.assert_allclose(
            theta_beta_arccos(**sides, k=k, p=p), theta_beta(d=d, **CENTROID), rtol=0, atol=1e-14
        )


def test_eqs_8_and_13_lose_digits_where_the_robot_is_flat():
    # limit: C_N = 2 um: angle = C_N / lever to 1e-10 of itself; arccos sees 1 - angle^2 / 2 only
    d, k, p, low = 0.0, 2, 0.2, 2e-6
    sides = {
        "alpha": alpha(d=d, k=k, p=p, C_L=0.2, C_N=low),
        "beta": beta(d=d, C_L=0.2, C_N=low),
    }
    angle = low / 0.2
    closed_0 = theta_alpha(d=d, k=k, p=p, C_L=0.2, C_N=low)
    closed_n = theta_beta(d=d, C_L=0.2, C_N=low)
    assert closed_0 == pytest.approx(angle, rel=1e-9)
    assert closed_n == pytest.approx(angle, rel=1e-9)
    for literal in (theta_alpha_arccos(**sides, k=k, p=p), theta_beta_arccos(**sides, k=k, p=p)):
        assert literal == pytest.approx(angle, rel=1e-4)
        assert abs(literal / angle - 1.0) > 1e-8


def test_eqs_8_and_13_hold_for_a_centroid_behind_t_0():
    # hand: obtuse angle, 180 - 45 degrees
    assert theta_alpha(d=0.0, k=1, p=0.1, C_L=0.2, C_N=0.1) == pytest.approx(3 * np.pi / 4)
    assert theta_beta(d=0.3, C_L=0.2, C_N=0.1) == pytest.approx(3 * np.pi / 4)


def test_eqs_9_and_10_are_distances():
    # hand: 3-4-5 triangles
    assert alpha(d=0.1, k=3, p=0.1, C_L=0.0, C_N=0.3) == pytest.approx(0.5, abs=EXACT)
    assert alpha(d=0.1, k=3, p=0.1, C_L=0.8, C_N=0.3) == pytest.approx(0.5, abs=EXACT)
    assert beta(d=0.1, C_L=0.5, C_N=0.3) == pytest.approx(0.5, abs=EXACT)


@pytest.mark.parametrize("p", SPACINGS)
def test_eqs_15_and_16_are_the_lines_of_fig_7(p):
    # hand: both rise with d at the rate g cos(theta_s) / C_N
    theta_s = 0.6
    d = np.linspace(0.0, p, 50, endpoint=False)
    s = lowest_contact(d=d, L=L, p=p)
    k = np.round((s - d) / p)
    slope = {"theta_s": theta_s}
    lower_end = tip_acceleration_downhill(
        theta_alpha=theta_alpha(d=d, k=k, p=p, **CENTROID), **slope
    )
    upper_end = tip_acceleration_uphill(theta_beta=theta_beta(d=d, **CENTROID), **slope)
    np.testing.assert_allclose(a_r0(s=s, **CENTROID, **slope), lower_end, rtol=0, atol=1e-12)
    np.testing.assert_allclose(a_rn(d=d, **CENTROID, **slope), upper_end, rtol=0, atol=1e-12)
    rate = G * np.cos(theta_s) / C_N
    np.testing.assert_allclose(np.diff(upper_end) / np.diff(d), rate, rtol=1e-9)


@pytest.mark.parametrize("p", SPACINGS)
def test_eqs_17_and_18_are_extremes_over_the_progress(p):
    # oracle: a scan of one nosing spacing in 0.1 um around the events
    theta_s, step = 0.6, 1e-7
    n = int(L // p)
    event = L - n * p
    d = np.sort(
        np.concatenate([np.linspace(0, p - step, 999), [event, event - step, event + step]])
    )
    scan_0 = a_r0(s=lowest_contact(d=d, L=L, p=p), theta_s=theta_s, **CENTROID)
    scan_n = a_rn(d=d, theta_s=theta_s, **CENTROID)
    least = min_a_r0(L=L, p=p, theta_s=theta_s, **CENTROID)
    most = max_a_rn(p=p, theta_s=theta_s, **CENTROID)
    assert np.min(scan_0) == pytest.approx(least, abs=1e-12)  # attained: state C counts as lost
    assert d[np.argmin(scan_0)] == pytest.approx(event, abs=1e-15)
    assert np.max(scan_n) < most  # a supremum
    assert np.max(scan_n) == pytest.approx(most, abs=2e-5)  # step * g / C_N
    a_S = slip_acceleration_up(mu_s=0.8, theta_s=theta_s)
    assert a_max(a_S=a_S, min_a_r0=least) == min(a_S, least)
    assert a_min(max_a_rn=most) == most
    a_down = slip_acceleration_down(mu_s=0.8, theta_s=theta_s)
    assert a_min_with_slip(a_slides_up=a_down, max_a_rn=most) == max(a_down, most)
    bounds = acceleration_bounds(**KENAF, theta_s=theta_s, p=p, mu_s=0.8)
    assert bounds == (a_S, a_down, least, most, min(a_S, least), max(a_down, most))


# The d-a plane


def test_fig_3_state_C():
    # hand: n = 3 at 150 mm; the fourth contact leaves at d = 470 - 450 = 20 mm
    assert d_C(L=L, n=3, p=0.15) == pytest.approx(0.02, abs=EXACT)
    # 2 * 235 mm = 470 mm: A and C coincide, the lower value counts
    assert lowest_contact(d=0.0, L=L, p=0.235) == pytest.approx(0.235, abs=EXACT)


def test_fig_3_contacts():
    # paper: n p <= L < (n + 1) p; hand: 470 mm holds 3, 2, 2, 2 spacings
    np.testing.assert_array_equal(contact_count(L=L, p=np.array(SPACINGS)), [3, 2, 2, 2])
    np.testing.assert_allclose(
        lowest_contact(d=np.array([0.0, 0.0199, 0.0201, 0.149]), L=L, p=0.15),
        [0.45, 0.4699, 0.3201, 0.449],
        rtol=0,
        atol=EXACT,
    )


def test_fig_7_areas():
    # hand: 200 mm, 30 degrees, mu = 2, g = 10, at d = 0 where the lowest contact is 0.4 m back:
    # a_S = 12.3, a_r0 = 19.9, a_rn = -28.9, a_down = -22.3, min a_r0 = 4.0, max a_rn = -4.5
    pose = {"theta_s": np.radians(30.0), "g": 10.0}
    limits = {
        "a_S": slip_acceleration_up(mu_s=2.0, **pose),
        "a_slides_up": slip_acceleration_down(mu_s=2.0, **pose),
        "a_r0": a_r0(s=0.4, **CENTROID, **pose),
        "a_rn": a_rn(d=0.0, **CENTROID, **pose),
        "min_a_r0": min_a_r0(L=L, p=0.2, **CENTROID, **pose),
        "max_a_rn": max_a_rn(p=0.2, **CENTROID, **pose),
    }
    by_hand = (12.321, -22.321, 19.883, -28.907, 4.026, -4.512)
    np.testing.assert_allclose(list(limits.values()), by_hand, rtol=0, atol=THREE_DECIMALS)
    a = np.array([13.0, 5.0, 0.0, -5.0, -25.0, -30.0])
    found = [Area(int(i)).name for i in area(a=a, **limits)]
    assert found == ["A", "E", "D", "E", "DOWNHILL_SLIP", "C"]
    rough = limits | {"a_S": 30.0}
    assert Area(int(area(a=25.0, **rough))) == Area.B
    # paper: "the robot slips prior to rotation if a does not satisfy Eqs. (4) and (7)"
    assert Area(int(area(a=35.0, **rough))) == Area.A
    # equality: with a_S it slips (Eq. 4 is strict), with a_r0 and a_rn it does not turn
    for a, expected in (
        (limits["a_S"], Area.A),
        (limits["min_a_r0"], Area.E),
        (limits["max_a_rn"], Area.E),
        (limits["a_slides_up"], Area.DOWNHILL_SLIP),
        (limits["a_rn"], Area.DOWNHILL_SLIP),
    ):
        assert Area(int(area(a=a, **limits))) == expected
    assert Area(int(area(a=limits["a_r0"], **rough))) == Area.E


# The margin


@pytest.mark.parametrize("p", SPACINGS)
def test_eqs_19_to_23_and_fig_11(p):
    # hand: see LIMITS; the paper's own formula, the closed form and the table agree
    literal = theta_s_sup_arccos(**KENAF, p=p, n=int(L // p))
    closed = theta_s_sup(**KENAF, p=p)
    assert np.degrees(literal) == pytest.approx(LIMITS[p], abs=THREE_DECIMALS)
    assert np.degrees(closed) == pytest.approx(LIMITS[p], abs=THREE_DECIMALS)
    assert literal == pytest.approx(closed, abs=1e-14)  # angles of order one, as in Eq. (8)
    # Eq. (7) at a = 0 is its origin
    assert min_a_r0(**KENAF, p=p, theta_s=closed) == pytest.approx(0.0, abs=EXACT)


def test_eqs_19_to_23_do_not_depend_on_n():
    # hand: d_C + (n - 1) p = L - p; tried where n jumps, at p = L/3 and p = L/4
    for whole in (3, 4, 5):
        p = L / whole
        for n in (whole, whole - 1):
            # p just below and just above L / whole
            assert theta_s_sup_arccos(**KENAF, p=p, n=n) == pytest.approx(
                theta_s_sup(**KENAF, p=p), abs=1e-13
            )


def test_eqs_21_and_22_at_state_C():
    # hand: 150 mm: d_C = 20 mm; alpha_C over 124 and 71, beta_C over 176 and 71 mm
    d = d_C(L=L, n=3, p=0.15)
    assert d == pytest.approx(0.02, abs=EXACT)
    assert alpha(d=d, k=2, p=0.15, **CENTROID) == pytest.approx(np.hypot(0.124, 0.071), abs=EXACT)
    assert beta(d=d, **CENTROID) == pytest.approx(np.hypot(0.176, 0.071), abs=EXACT)


def test_predicted_margin_at_150_mm():
    # paper: 60.2 degrees
    assert np.degrees(theta_s_sup(**KENAF, p=0.150)) == pytest.approx(60.2, abs=0.05)


def test_fig_11_falls_with_the_spacing():
    # paper: falling in the area on the right of the solid line, not on its left
    margin = theta_s_sup(**KENAF, p=np.linspace(0.1, 0.235, 100))
    assert np.all(np.diff(margin) < 0.0)


def test_eq_24_at_150_mm():
    # paper: theta_d = 2.6, theta_M 1.2 to 2.6 degrees; hand: 60.2 - 3.8 and 60.2 - 5.2
    sup = np.degrees(theta_s_sup(**KENAF, p=0.150))
    corrected = theta_s_sup_corrected(theta_s_sup=sup, theta_d=2.6, theta_M=np.array([1.2, 2.6]))
    np.testing.assert_allclose(corrected, [56.4, 55.0], rtol=0, atol=0.05)
    # paper: "the robot fell down at 55.0-57.0 degrees in the experiment"
    assert np.all((corrected > 55.0 - 0.05) & (corrected < 57.0))


def test_case_study_assumes_no_fall_forward():
    # paper: "falling forward did not occur at constant speed"; hand: max a_rn < 0 at the margins
    for p in SPACINGS:
        assert max_a_rn(p=p, theta_s=theta_s_sup(**KENAF, p=p), **CENTROID) < 0.0


def test_case_study_acceleration_is_equivalent_to_inclination():
    # paper: "the increase and decrease in acceleration are equivalent to that of the inclination";
    # hand: exactly so in the tangent of the equivalent slope
    theta_s, a = 0.5, 1.3
    steeper = np.arctan(equivalent_slope(theta_s=theta_s, a=a))
    assert centroid_margin_downhill(**KENAF, p=0.18, theta_s=theta_s, a=a) == pytest.approx(
        centroid_margin_downhill(**KENAF, p=0.18, theta_s=steeper), abs=EXACT
    )
    assert centroid_margin_uphill(**CENTROID, p=0.18, theta_s=theta_s, a=a) == pytest.approx(
        centroid_margin_uphill(**CENTROID, p=0.18, theta_s=steeper), abs=EXACT
    )
    # hence theta_s_sup(a), by the arccos form of docs/theory/margin.md
    x = L - 0.18 - C_L
    literal = np.arccos(C_N * a / (G * np.hypot(x, C_N))) - np.arctan2(C_N, x)
    sup = theta_s_sup(**KENAF, p=0.18, a=a)
    assert sup == pytest.approx(literal, abs=1e-14)
    assert equivalent_slope(theta_s=sup, a=a) == pytest.approx(x / C_N, abs=EXACT)


def test_no_slope_at_all_for_a_violent_acceleration():
    # hand: |C_N a| > g hypot(x, C_N)
    x = L - 0.22 - C_L
    verge = G * np.hypot(x, C_N) / C_N
    # limit: the root of a difference of 1e-9 leaves 3e-5
    assert theta_s_sup(**KENAF, p=0.22, a=verge * (1 - 1e-9)) == pytest.approx(
        -np.arctan2(C_N, x), abs=1e-4
    )
    with np.errstate(invalid="ignore"):
        assert np.isnan(theta_s_sup(**KENAF, p=0.22, a=verge * 1.001))


# Fig. 14 to Fig. 20: what happened between the margins


def test_fig_14_satisfies_eq_7():
    # paper: at (200 mm, 44.0 degrees) "the robot satisfies Eq. (7) at this instant"
    margin = centroid_margin_downhill(**KENAF, p=0.2, theta_s=np.radians(44.0))
    assert 0.0 < margin < C_N  # hand: 74 - 71 tan(44) = 5.4 mm
    assert margin == pytest.approx(0.0054, abs=0.00005)


def test_fig_14_has_less_energy_left_than_its_motion():
    # hand: alpha = hypot(74, 71) mm, 43.815 + 44 degrees: 102.55 (1 - sin 87.815) = 0.07 mm,
    # and 0.1 m/s is worth 0.5 mm: consistent with the swing that the paper reports
    left = energy_margin_backward(
        alpha=np.hypot(0.074, 0.071),
        theta_alpha=np.arctan2(0.071, 0.074),
        theta_s=np.radians(44.0),
    )
    assert left == pytest.approx(0.07e-3, abs=0.005e-3)
    assert kinetic_energy_height(v=SPEED) == pytest.approx(0.51e-3, abs=0.005e-3)


def test_fig_15_deformation_explains_part_of_the_fall():
    # paper: at (150 mm, 56.8 degrees), 2.6 degrees more inclination, margin 60.2; with the
    # deformation alone the robot would still hold, with the least theta_M it falls
    slope, theta_d, theta_M = np.radians([56.8, 2.6, 1.2])
    m = margins(**KENAF, theta_s=slope, p=0.15, mu_s=np.nan, theta_d=theta_d)
    assert m.tip_downhill > 0.0
    m = margins(**KENAF, theta_s=slope, p=0.15, mu_s=np.nan, theta_d=theta_d, theta_M=theta_M)
    assert m.tip_downhill < 0.0
    assert m.worst == m.tip_downhill < m.tip_uphill
    assert m.worst == pytest.approx(theta_s_sup(**KENAF, p=0.15) - slope - theta_d - theta_M)


# What follows from the paper (docs/theory/margin.md), checked by hand


def test_nose_first_descent_mirrors_the_robot():
    # hand: arctan(46 / 71) = 32.9 degrees at 150 mm
    sup = theta_s_sup(L=L, p=0.15, C_L=L - C_L, C_N=C_N)
    assert np.degrees(sup) == pytest.approx(32.9, abs=0.05)


def test_lower_slope_limit():
    # hand: arctan(4/71) = 3.2, arctan(24/71) = 18.7 degrees; none where p < C_L
    inf = np.degrees(theta_s_inf(p=np.array(SPACINGS), **CENTROID))
    np.testing.assert_allclose(inf[2:], [3.2, 18.7], rtol=0, atol=0.05)
    assert np.all(inf[:2] < 0.0)
    # its origin: max a_rn = 0 there
    assert max_a_rn(p=0.22, theta_s=np.radians(inf[3]), **CENTROID) == pytest.approx(0, abs=EXACT)


def test_semi_stable_limit_is_where_the_mean_of_a_r0_vanishes():
    # oracle: mean over one spacing by midpoints, which is exact for a linear saw-tooth
    p = 0.2
    limit = semi_stable_limit(**KENAF, p=p)
    cells = 10_000
    d = (np.arange(cells) + 0.5) * p / cells
    mean = np.mean(a_r0(s=lowest_contact(d=d, L=L, p=p), theta_s=limit, **CENTROID))
    # the jump may fall inside a cell: half a cell of one tooth
    assert mean == pytest.approx(0.0, abs=G * p / C_N / cells)


@pytest.mark.parametrize("p", SPACINGS)
def test_sensitivity_by_differences(p):
    # oracle: central differences of 1 um, error 1e-9 of the third derivative
    h = 1e-6

    def sup(dx=0.0, dp=0.0):
        return theta_s_sup(L=L, p=p + dp, C_L=C_L + dx, C_N=C_N)

    along = margin_per_centroid_length(**KENAF, p=p)
    assert (sup(dx=h) - sup(dx=-h)) / (2 * h) == pytest.approx(along, rel=1e-6)
    assert (sup(dp=h) - sup(dp=-h)) / (2 * h) == pytest.approx(along, rel=1e-6)
    # hand: 0.2 to 0.5 degrees for every millimetre of C_L
    assert 0.19 < -np.degrees(along) / 1e3 < 0.52


def test_slope_limit_is_every_limit():
    # oracle: put the slope back into the equation it solves
    grip = np.array([-0.8, 0.0, 0.5, 1.7])[:, None]
    a = np.array([-4.0, 0.0, 2.0])
    theta = slope_limit(grip=grip, a=a)
    np.testing.assert_allclose(
        equivalent_slope(theta_s=theta, a=a), np.broadcast_to(grip, theta.shape), atol=1e-12
    )


def test_outside_the_model_is_nan():
    # hand: two contacts must remain: p <= L / 2 = 235 mm
    inside = margins(**KENAF, theta_s=0.3, p=0.235, mu_s=1.0)
    outside = margins(**KENAF, theta_s=0.3, p=0.2351, mu_s=1.0)
    assert not np.isnan(inside[:7]).any()
    assert np.isnan(outside[:7]).all()
    bounds = acceleration_bounds(**KENAF, theta_s=0.3, p=0.2351, mu_s=1.0)
    assert np.isnan(bounds).all()
