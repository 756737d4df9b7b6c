"""`kaidan.assess` by the closed form: every verdict, number and sign, against outside figures.

Tags: (paper) printed in Endo & Nagatani 2016; (hand) from a calculation beside it, with `math`
only; (limit) a limiting case; (oracle) an independent method. Angles agree to 1e-9 deg and
accelerations to 1e-9 m/s^2 unless said: a dozen operations in double precision.
"""

import json
import math
from functools import partial
from math import atan, atan2, cos, degrees, hypot, radians, sin, tan
from statistics import NormalDist

import numpy as np
import pytest

import kaidan
from kaidan import InputError, Payload, Posture, Robot, Stairs, Surface
from kaidan.assessment import case_of
from kaidan.assessment.closed_form import judge, plan_acceleration
from kaidan.robot import Drive, FlipperPair, Track, Uncertainty
from kaidan.stairs import StairsUncertainty

assess = partial(kaidan.assess, model="closed-form")
G = 9.80665
L, C_L, C_N = 0.470, 0.196, 0.071
"""Kenaf (paper), Table 1."""
GRIP = 3.0
"""Friction that never decides below 71 degrees."""
BARE = {"theta_d": 0.0, "theta_M": 0.0}
ANGLE = {"rel": 0, "abs": 1e-9}


def flight(angle, p, **more):
    return Stairs.inclined(angle=radians(angle), nosing_spacing=p, **more)


def kenaf(angle, p, **question):
    return assess("kenaf", flight(angle, p), **({"friction": GRIP} | question))


def robot(**changes):
    """A robot of round figures: 10 kg, L 0.5 m, centroid in its middle, 0.1 m high."""
    sheet = {
        "name": "round",
        "mass": 10.0,
        "com_from_front": 0.25,
        "com_height": 0.1,
        "track": {"flat_length": 0.5},
    }
    return Robot.model_validate(sheet | changes)


# The paper's numbers


@pytest.mark.parametrize(
    ("p", "sup"), [(0.150, 60.205), (0.180, 52.936), (0.200, 46.185), (0.220, 37.255)]
)
def test_steepest_slope_of_kenaf(p, sup):
    # paper prints 60.2 at 150 mm; the others hand: atan((470 - p - 196) / 71)
    answer = kenaf(30, p)
    assert answer.margin_angle_deg == pytest.approx(sup, abs=5e-4)  # three printed places
    assert answer.margin_angle_deg == pytest.approx(degrees(atan2(L - p - C_L, C_N)), **ANGLE)
    assert answer.margin_backward_deg == pytest.approx(answer.margin_angle_deg - 30, **ANGLE)
    assert answer.contacts_n == (3 if p == 0.150 else 2)  # hand: floor(470 / p)
    assert answer.angle_deg == pytest.approx(30, **ANGLE)
    assert answer.nosing_spacing_m == pytest.approx(p, abs=1e-15)
    assert (answer.flat_length_m, answer.com_from_front_m, answer.com_height_m) == (L, C_L, C_N)
    assert answer.mass_kg is None


@pytest.mark.parametrize(("p", "inf"), [(0.150, None), (0.180, None), (0.200, 3.2), (0.220, 18.7)])
def test_gentlest_slope_of_kenaf(p, inf):
    # hand: atan((p - 196) / 71), no limit where the centroid lies behind the second nosing
    lower = kenaf(30, p).lower_angle_deg
    assert lower == (None if inf is None else pytest.approx(inf, abs=0.05))  # one printed place
    if inf is not None:
        assert lower == pytest.approx(degrees(atan2(p - C_L, C_N)), **ANGLE)


def test_below_the_gentlest_slope_the_nose_drops():
    # hand: 15 deg is 3.677 deg below atan(24 / 71)
    answer = kenaf(15, 0.220, **BARE)
    assert (answer.verdict, answer.governs, answer.falls_over) == ("no-go", "tip_uphill", "nose")
    assert answer.margin_deg == pytest.approx(15 - degrees(atan(24 / 71)), **ANGLE)


def test_nose_first_descent_of_kenaf():
    # theory: 32.9 deg at 150 mm; hand: atan(46 / 71); Kenaf has room for 60.2 deg in reverse
    answer = kenaf(30, 0.150, direction="down")
    assert answer.margin_angle_deg == pytest.approx(32.9, abs=0.05)
    assert answer.margin_angle_deg == pytest.approx(degrees(atan(46 / 71)), **ANGLE)
    # no grouser locks on the way down: only theta_d is taken off
    assert answer.margin_deg == pytest.approx(degrees(atan(46 / 71)) - 30 - 2.6, **ANGLE)
    back = kenaf(30, 0.150, direction="down", facing="tail-first")
    assert back.margin_angle_deg == pytest.approx(60.205, abs=5e-4)
    assert back.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 30 - 2.6, **ANGLE)


def test_corrected_margin_of_the_paper():
    # paper, Eq. (24) with its measured figures: 55.0-56.4 deg at 150 mm
    measured = {"theta_d": radians(2.6), "theta_M": (radians(1.2), radians(2.6))}
    answer = kenaf(50, 0.150, **measured)
    assert 50 + answer.margin_deg == pytest.approx(55.0, abs=0.05)
    assert 50 + answer.margin_at_best_deg == pytest.approx(56.4, abs=0.05)


def test_swing_of_the_paper():
    # paper: at (200 mm, 44.0 deg), 0.1 m/s, no fall but the body swings
    # theory: energy margin 0.07 mm; hand: v^2 / 2g = 0.51 mm
    answer = kenaf(44, 0.200, speed=0.1)
    assert answer.measures.energy_margin_mm == pytest.approx(0.07, abs=0.005)
    assert answer.measures.speed_height_mm == pytest.approx(1e3 * 0.01 / (2 * G), rel=1e-12)
    assert any("expect it to swing" in note for note in answer.notes)
    assert not any("swing" in note for note in kenaf(30, 0.200, speed=0.1).notes)
    assert not any("swing" in note for note in kenaf(60, 0.200, speed=0.1).notes)  # it falls


def test_acceleration_acts_like_inclination():
    # hand: the robot tips when tan(theta) + a / (g cos(theta)) = (L - p - C_L) / C_N
    answer = kenaf(30, 0.150, acceleration=1.5)
    theta = radians(answer.margin_angle_deg)
    assert tan(theta) + 1.5 / (G * cos(theta)) == pytest.approx(124 / 71, rel=1e-12)
    assert answer.margin_angle_deg < 60.205
    assert kenaf(30, 0.150, acceleration=-1.5).margin_angle_deg > 60.205


# The words


@pytest.mark.parametrize(
    ("angle", "verdict"), [(55.00, "go"), (55.01, "caution"), (60.20, "caution"), (60.21, "no-go")]
)
def test_words_with_unmeasured_allowances(angle, verdict):
    # hand: 60.2054 - 2 x 2.6 = 55.0054; GO with both taken off, CAUTION if they may be kind
    assert kenaf(angle, 0.150).verdict == verdict


@pytest.mark.parametrize(("angle", "verdict"), [(60.20, "go"), (60.21, "no-go")])
def test_words_with_measured_allowances(angle, verdict):
    assert kenaf(angle, 0.150, **BARE).verdict == verdict


def test_words_where_only_the_friction_is_in_doubt():
    # hand: tan 35 deg = 0.700, atan 0.6 = 30.96 deg, atan 1 = 45 deg; Kenaf does not tip there
    def ground(low, high):
        return {"surface": Surface(friction_low=low, friction_high=high), "friction": None}

    wide = kenaf(35, 0.150, **ground(0.6, 1.0))
    assert (wide.verdict, wide.governs) == ("caution", "slip_up")
    assert wide.margin_deg == pytest.approx(degrees(atan(0.6)) - 35, **ANGLE)
    assert wide.margin_at_best_deg == pytest.approx(45 - 35, **ANGLE)
    assert wide.friction == (0.6, 1.0)
    assert kenaf(35, 0.150, **ground(0.71, 1.0)).verdict == "go"
    assert kenaf(35, 0.150, **ground(0.6, 0.69)).verdict == "no-go"


def test_unknown_friction_is_at_best_caution():
    answer = kenaf(30, 0.150, friction=None)
    assert (answer.verdict, answer.governs) == ("caution", "friction_unknown")
    # hand: the margin is the tip's: 60.205 - 5.2 - 30
    assert answer.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 35.2, **ANGLE)
    assert answer.friction is answer.surface is answer.a_slip_up is answer.a_slip_down is None
    assert answer.margins_deg["slip_up"] is answer.margins_deg["slip_down"] is None
    assert answer.paper.a_S is None
    assert answer.a_max == answer.a_tip_downhill
    assert answer.a_min == answer.a_tip_uphill
    assert kenaf(58, 0.150, friction=None).verdict == "caution"  # tips only on the worst reading
    assert kenaf(61, 0.150, friction=None).verdict == "no-go"
    # tan 30 deg, and a little more
    assert answer.required_friction == pytest.approx(tan(radians(30)), rel=1e-12)
    assert answer.what_would_help[0].change == "Make sure of a friction of 0.59 or more"
    assert answer.what_would_help[0].verdict == "go"


@pytest.mark.parametrize("p", [0.150, 0.200, 0.220])
@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_the_margin_never_disagrees_with_the_verdict(p, direction, facing):
    for angle in range(8, 70):
        for question in ({}, BARE, {"friction": 0.7}, {"acceleration": -1.0}):
            answer = kenaf(angle, p, direction=direction, facing=facing, **question)
            if answer.verdict == "go":
                assert answer.margin_deg > 0
            elif answer.verdict == "no-go":
                assert answer.margin_deg <= 0
            assert answer.margin_deg == min(
                margin for margin in answer.margins_deg.values() if margin is not None
            )
            assert answer.margin_at_best_deg >= answer.margin_deg


@pytest.mark.parametrize(
    ("question", "reason"),
    [
        ({}, "Stable with 15.0 deg to spare; nearest is tipping over its downhill end."),
        (
            {"direction": "down"},
            "It fails by tipping over its downhill end, 9.7 deg beyond the limit.",
        ),
        (
            {"friction": 0.5},
            "It fails by sliding down for lack of friction, 13.4 deg beyond the limit.",
        ),
        ({"friction": None}, "It does not tip, but the friction is not known: it may slip."),
        (
            {"angle": 57},
            "Between -2.0 and +3.2 deg, depending on what is only known as a range; in doubt is "
            "tipping over its downhill end.",
        ),
    ],
)
def test_the_reason_in_one_sentence(question, reason):
    # hand: 60.205 - 45.2; 32.939 - 42.6; atan 0.5 - 40; 60.205 - 62.2 and 60.205 - 57
    question = {"angle": 40} | question
    assert kenaf(question.pop("angle"), 0.150, **question).reason == reason


def test_on_the_limit_it_is_no_go():
    # hand: tan(45 deg) = 1 = (0.5 - 0.15 - 0.25) / 0.1, and a friction of 1 slips there too
    for friction in (GRIP, 1.0):
        answer = assess(robot(), flight(45, 0.15), friction=friction, **BARE)
        assert answer.verdict == "no-go"
        assert answer.margin_deg == pytest.approx(0, abs=1e-12)


# Which end, which way


@pytest.mark.parametrize(
    ("direction", "facing", "nose_up"),
    [
        ("up", "nose-first", True),
        ("up", "tail-first", False),
        ("down", "nose-first", False),
        ("down", "tail-first", True),
    ],
)
@pytest.mark.parametrize("by", ["slope", "acceleration"])
def test_the_end_it_falls_over(direction, facing, nose_up, by):
    # hand: centroid 0.2 m behind the uphill end, p = 0.24: holds from atan(0.4) to atan(0.6)
    of_kind = robot(com_from_front=0.2 if nose_up else 0.3)

    def ask(angle, a):
        return assess(
            of_kind,
            flight(angle, 0.24),
            friction=GRIP,
            direction=direction,
            facing=facing,
            acceleration=a,
            **BARE,
        )

    middle = ask(26, 0.0)
    assert (middle.verdict, middle.falls_over) == ("go", None)
    assert middle.margin_angle_deg == pytest.approx(degrees(atan(0.6)), **ANGLE)
    assert middle.lower_angle_deg == pytest.approx(degrees(atan(0.4)), **ANGLE)
    downhill, uphill = (ask(40, 0.0), ask(10, 0.0)) if by == "slope" else (ask(26, 2), ask(26, -2))
    assert (downhill.verdict, downhill.governs) == ("no-go", "tip_downhill")
    assert downhill.falls_over == ("tail" if nose_up else "nose")
    assert (uphill.verdict, uphill.governs) == ("no-go", "tip_uphill")
    assert uphill.falls_over == ("nose" if nose_up else "tail")


def test_slipping_is_no_fall():
    answer = kenaf(30, 0.150, friction=0.3)
    assert (answer.verdict, answer.governs, answer.area) == ("no-go", "slip_up", "A")
    assert answer.falls_over is None
    # hand: braking at -9 m/s^2 on 20 deg needs |tan 20 - 9 / (g cos 20)| = 0.613 downhill
    answer = kenaf(20, 0.150, friction=0.6, acceleration=-9.0, **BARE)
    assert (answer.verdict, answer.governs) == ("no-go", "slip_down")
    assert answer.area == "DOWNHILL_SLIP"
    assert answer.required_friction == pytest.approx(
        abs(tan(radians(20)) - 9 / (G * cos(radians(20)))), rel=1e-12
    )


def test_the_way_of_the_sheet_unless_the_question_says_otherwise():
    down = Stairs(rise=0.09, going=0.12, direction="down")
    assert assess("kenaf", down, friction=GRIP).direction == "down"
    assert assess("kenaf", down, friction=GRIP, direction="up").direction == "up"
    assert kenaf(30, 0.150).direction == "up"


# Allowances


def test_allowances_unless_measured():
    up, down = kenaf(30, 0.150).allowances, kenaf(30, 0.150, direction="down").allowances
    for shown in (up["theta_d"], up["theta_M"], down["theta_d"]):
        assert (shown.low_deg, shown.source) == (0.0, "default")
        assert shown.high_deg == pytest.approx(2.6, **ANGLE)
    assert (down["theta_M"].high_deg, down["theta_M"].source) == (0.0, "not applicable")


def test_measured_allowances_are_shown_and_taken_off():
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
    assert answer.margin_at_best_deg == pytest.approx(degrees(atan(124 / 71)) - 31.5, **ANGLE)
    assert kenaf(30, 0.150, direction="down", theta_M=0.02).allowances["theta_M"].source == (
        "measured"
    )


def test_centroid_margin():
    # hand: L - p - C_L - C_N tan(theta + 5.2 deg), the other side is further away
    answer = kenaf(40, 0.150)
    expected = 1e3 * (L - 0.150 - C_L - C_N * tan(radians(45.2)))
    assert answer.margin_centroid_mm == pytest.approx(expected, rel=1e-12)
    # uphill: C_L - p + C_N tan(theta - 2.6 deg)
    answer = kenaf(20, 0.220)
    expected = 1e3 * (C_L - 0.220 + C_N * tan(radians(17.4)))
    assert answer.margin_centroid_mm == pytest.approx(expected, rel=1e-12)
    for angle in range(8, 70):
        answer = kenaf(angle, 0.200)
        tips = min(answer.margins_deg[mode] for mode in ("tip_downhill", "tip_uphill"))
        assert (answer.margin_centroid_mm > 0) == (tips > 0)


def test_past_the_vertical_no_place_of_the_centroid_holds():
    # 80 deg and 0.3 + 0.3 rad of allowances lean past 90 deg, where the tangent turns positive
    answer = kenaf(80, 0.150, theta_d=0.3, theta_M=0.3)
    assert (answer.verdict, answer.margin_centroid_mm) == ("no-go", None)
    assert '"margin_centroid_mm": null' in answer.to_json()


# Bounds of the acceleration


def swept_limits(angle, p, mu, steps=20_001):
    """Oracle: smallest a_r0 and largest a_rn by trying every progress, contacts counted."""
    theta = radians(angle)
    lowest, highest = math.inf, -math.inf
    for d in np.linspace(0, p, steps)[:-1]:
        under = [d + k * p for k in range(20) if d + k * p < L]
        lowest = min(lowest, G * ((under[-1] - C_L) / C_N * cos(theta) - sin(theta)))
        highest = max(highest, G * ((under[0] - C_L) / C_N * cos(theta) - sin(theta)))
    return G * (mu * cos(theta) - sin(theta)), lowest, highest


@pytest.mark.parametrize(("angle", "p", "mu"), [(50, 0.150, 0.8), (30, 0.220, 3.0), (6, 0.2, 0.1)])
def test_the_papers_own_quantities(angle, p, mu):
    # oracle: a sweep over the progress, whose 20,000 steps of p cost g / C_N p / 20,000 < 2e-3
    a_S, min_a_r0, max_a_rn = swept_limits(angle, p, mu)
    paper = kenaf(angle, p, friction=mu).paper
    assert paper.a_S == pytest.approx(a_S, rel=1e-12)
    assert paper.min_a_r0 == pytest.approx(min_a_r0, abs=2e-3)
    assert paper.max_a_rn == pytest.approx(max_a_rn, abs=2e-3)
    assert paper.a_max == min(paper.a_S, paper.min_a_r0)  # Eq. (17)
    assert paper.a_min == paper.max_a_rn  # Eq. (18): no downhill slip in it


def test_bounds_by_hand():
    # hand: Kenaf, 150 mm, 50 deg, mu 0.8
    answer, theta = kenaf(50, 0.150, friction=0.8), radians(50)
    assert answer.a_slip_up == pytest.approx(G * (0.8 * cos(theta) - sin(theta)), rel=1e-12)
    assert answer.a_slip_down == pytest.approx(-G * (0.8 * cos(theta) + sin(theta)), rel=1e-12)
    assert answer.a_tip_downhill == pytest.approx(G * (124 / 71 * cos(theta) - sin(theta)), 1e-12)
    assert answer.a_tip_uphill == pytest.approx(-G * (46 / 71 * cos(theta) + sin(theta)), 1e-12)
    assert answer.a_max == answer.a_slip_up
    # -12.55 by slip, -11.60 by tipping: the larger bounds
    assert answer.a_min == answer.a_tip_uphill > answer.a_slip_down
    assert answer.paper.a_min == answer.a_tip_uphill


def test_allowances_narrow_the_safe_band():
    answer, theta = kenaf(40, 0.150), radians(40)
    tilted, sunk = theta + radians(5.2), theta - radians(2.6)
    assert answer.a_max_safe == pytest.approx(G * (124 / 71 * cos(tilted) - sin(tilted)), 1e-12)
    assert answer.a_min_safe == pytest.approx(-G * (46 / 71 * cos(sunk) + sin(sunk)), 1e-12)
    assert answer.a_min < answer.a_min_safe < answer.a_max_safe < answer.a_max
    assert kenaf(40, 0.150, **BARE).a_max_safe == pytest.approx(answer.a_max, rel=1e-15)


def test_band_ends_at_the_verdict():
    # just inside the safe band GO, just outside NO-GO, either way
    answer = kenaf(40, 0.150, theta_d=0.01, theta_M=0.02)
    for edge, sign in ((answer.a_max_safe, 1), (answer.a_min_safe, -1)):
        if abs(edge) < 9.8:
            for step, verdict in ((-1e-9, "go"), (1e-9, "no-go")):
                asked = edge + sign * step
                found = kenaf(40, 0.150, theta_d=0.01, theta_M=0.02, acceleration=asked)
                assert found.verdict == verdict


def test_an_empty_band_is_null():
    # hand: Kenaf at 220 mm and 10 deg with mu 0.2: the nose drops below +1.56, it slips above 0.23
    answer = kenaf(10, 0.220, friction=0.2)
    theta = radians(10)
    assert answer.a_tip_uphill == pytest.approx(G * (24 / 71 * cos(theta) - sin(theta)), rel=1e-12)
    assert answer.a_slip_up == pytest.approx(G * (0.2 * cos(theta) - sin(theta)), rel=1e-12)
    assert answer.a_tip_uphill > answer.a_slip_up
    assert answer.a_max is answer.a_min is answer.a_max_safe is answer.a_min_safe is None
    assert answer.hardest_start is answer.hardest_stop is None
    assert answer.verdict == "no-go"


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_hardest_start_and_stop(facing):
    # hand: a symmetric robot that only slips: up to g (0.8 cos 30 - sin 30) uphill,
    # g (0.8 cos 30 + sin 30) downhill; starting upward and braking downward push uphill
    flat = robot(com_height=0.02, com_from_front=0.25)
    uphill = G * (0.8 * cos(radians(30)) - sin(radians(30)))
    downhill = G * (0.8 * cos(radians(30)) + sin(radians(30)))
    question = {"friction": 0.8, "facing": facing, **BARE}
    up = assess(flat, flight(30, 0.1), direction="up", **question)
    down = assess(flat, flight(30, 0.1), direction="down", **question)
    assert up.hardest_start == pytest.approx(uphill, rel=1e-12)
    assert up.hardest_stop == pytest.approx(downhill, rel=1e-12)
    assert down.hardest_start == pytest.approx(downhill, rel=1e-12)
    assert down.hardest_stop == pytest.approx(uphill, rel=1e-12)


def test_no_safe_start_where_the_band_lies_below_zero():
    # at 57 deg with 5.2 deg off the band's upper end is negative: it may only slow down
    answer = kenaf(57, 0.150)
    assert answer.a_max_safe < 0
    assert answer.hardest_start is None
    assert answer.hardest_stop > 0


def test_required_friction():
    # hand: |tan(theta) + a / (g cos(theta))|
    for a in (0.0, 0.7, -0.7, -6.0):
        expected = abs(tan(radians(30)) + a / (G * cos(radians(30))))
        assert kenaf(30, 0.150, acceleration=a).required_friction == pytest.approx(expected, 1e-12)


@pytest.mark.parametrize(
    ("angle", "question", "area"),
    [
        (30, {}, "D"),
        (30, {"friction": 0.5}, "A"),  # tan 30 deg = 0.577
        (61, {}, "B"),
        (15, {"p": 0.220}, "C"),
        (20, {"friction": 0.6, "acceleration": -9.0}, "DOWNHILL_SLIP"),
        (30, {"friction": None}, "D"),
    ],
)
def test_area(angle, question, area):
    question = {"p": 0.150} | question
    assert kenaf(angle, question.pop("p"), **BARE, **question).area == area


# Contacts, forces, measures


def test_contacts_carry_the_weight_and_the_traction():
    # hand: just after the loss the contacts lie L - p and every p above it behind the uphill end
    tracks = robot()
    answer = assess(tracks, flight(20, 0.12), friction=GRIP, acceleration=0.4)
    theta = radians(20)
    places = [contact.behind_uphill_tip_m for contact in answer.contacts]
    assert places == pytest.approx([0.02, 0.14, 0.26, 0.38], abs=1e-12)
    assert answer.contacts_n == 4
    assert sum(contact.load_share for contact in answer.contacts) == pytest.approx(1, abs=1e-12)
    normal = sum(contact.normal_N for contact in answer.contacts)
    assert normal == pytest.approx(10 * G * cos(theta), rel=1e-12)
    traction = sum(contact.traction_N for contact in answer.contacts)
    assert traction == pytest.approx(10 * (G * sin(theta) + 0.4), rel=1e-12)
    assert answer.traction_N == pytest.approx(traction, rel=1e-12)
    # moments about the uphill end: the resultant passes through x_z
    x_z = 0.25 + 0.1 * (tan(theta) + 0.4 / (G * cos(theta)))
    moment = sum(c.load_share * c.behind_uphill_tip_m for c in answer.contacts)
    assert moment == pytest.approx(x_z, rel=1e-12)
    for contact in answer.contacts:
        assert contact.required_friction == pytest.approx(answer.required_friction, rel=1e-12)


def test_forces_take_a_mass():
    answer = kenaf(30, 0.150, speed=0.1)
    assert answer.traction_N is answer.power_W is None
    assert all(c.normal_N is c.traction_N is None for c in answer.contacts)
    assert answer.measures.force_angle_Nm_rad is None
    assert any("not known and not judged" in note for note in answer.notes)


def test_traction_and_power():
    # hand: 10 kg at 30 deg with c_rr 0.1 and efficiency 0.5, at 0.2 m/s
    drive = Drive(rolling_resistance=0.1, efficiency=0.5, max_speed=1.0)
    tracks = robot(drive=drive.model_dump())
    theta = radians(30)
    up = assess(tracks, flight(30, 0.12), friction=GRIP, speed=0.2)
    assert up.traction_N == pytest.approx(10 * G * (sin(theta) + 0.1 * cos(theta)), rel=1e-12)
    assert up.power_W == pytest.approx(up.traction_N * 0.2 / 0.5, rel=1e-12)
    # going down the rolling resistance helps to hold, and the losses take their part
    down = assess(tracks, flight(30, 0.12), friction=GRIP, speed=0.2, direction="down")
    assert down.traction_N == pytest.approx(10 * G * (sin(theta) - 0.1 * cos(theta)), rel=1e-12)
    assert down.power_W == pytest.approx(-down.traction_N * 0.2 * 0.5, rel=1e-12)
    assert assess(tracks, flight(30, 0.12), friction=GRIP).power_W is None


def test_measures_by_hand():
    # hand: contacts at 0.14 and 0.38 m, centroid at 0.25 m, 0.1 m high, 20 deg, 10 kg, a = 0
    theta = radians(20)
    found = assess(robot(), flight(20, 0.24), friction=GRIP, speed=0.4).measures
    low, high = 0.26, 0.02
    static = min(
        (low - 0.25) * cos(theta) - 0.1 * sin(theta), (0.25 - high) * cos(theta) + 0.1 * sin(theta)
    )
    assert found.static_margin_mm == pytest.approx(1e3 * static, rel=1e-9)
    x_z = 0.25 + 0.1 * tan(theta)
    assert found.zmp_margin_mm == pytest.approx(1e3 * min(low - x_z, x_z - high), rel=1e-9)
    # energy: the centroid turns about a contact until it stands above it
    arms = [(low - 0.25, 0.1), (0.25 - high, 0.1)]
    heights = [
        hypot(*arm) - (arm[1] * cos(theta) + sign * arm[0] * sin(theta))
        for arm, sign in zip(arms, (1, -1), strict=True)
    ]
    energy = math.copysign(heights[0], static)  # already past its lower contact
    assert found.energy_margin_mm == pytest.approx(1e3 * energy, rel=1e-9)
    assert found.speed_height_mm == pytest.approx(1e3 * 0.16 / (2 * G), rel=1e-12)


# Payload and flippers


def test_payload_moves_the_centroid():
    # hand: (10 x 0.25 + 5 x 0.4) / 15 = 0.3; (10 x 0.1 + 5 x 0.4) / 15 = 0.2
    load = Payload(mass=5, from_front=0.4, height=0.4)
    for payload in (load, [load], (load,), iter([load])):
        answer = assess(robot(), flight(10, 0.12), friction=GRIP, payload=payload)
        assert answer.com_from_front_m == pytest.approx(0.3, abs=1e-15)
        assert answer.com_height_m == pytest.approx(0.2, abs=1e-15)
        assert answer.mass_kg == 15
        # hand: atan((0.5 - 0.12 - 0.3) / 0.2)
        assert answer.margin_angle_deg == pytest.approx(degrees(atan(0.4)), **ANGLE)
    two = [Payload(mass=2.5, from_front=0.4, height=0.4)] * 2
    assert assess(robot(), flight(10, 0.12), payload=two).com_height_m == pytest.approx(0.2)


FLIPPERS = FlipperPair(
    length=0.3,
    root_radius=0.06,
    tip_radius=0.04,
    pivot_height=0.06,
    pivot_inset=0.01,
    mass=2.0,
    com_from_pivot=0.15,
)


def test_flippers_in_line_lengthen_the_track():
    # hand: the tip lies 20 mm below the pivot: reach sqrt(0.3^2 - 0.02^2) - 0.01
    reach = math.sqrt(0.3**2 - 0.02**2)
    tracks = robot(front_flippers=FLIPPERS, rear_flippers=FLIPPERS)
    answer = assess(tracks, flight(10, 0.12), friction=GRIP, flippers="flat")
    assert answer.flat_length_m == pytest.approx(0.5 + 2 * (reach - 0.01), abs=1e-12)
    # both move alike: the centroid stays in the middle and sinks by 2 x 2 kg x 0.15 m x (1 + 1/15)
    assert answer.com_from_front_m == pytest.approx(answer.flat_length_m / 2, abs=1e-12)
    assert answer.com_height_m == pytest.approx(0.1 - 2 * 0.3 / 10 * (1 + 0.02 / 0.3), abs=1e-12)
    front = assess(tracks, flight(10, 0.12), friction=GRIP, flippers=Posture(front="flat"))
    assert front.flat_length_m == pytest.approx(0.5 + reach - 0.01, abs=1e-12)
    # from upright to in line the front pair moves its 2 kg by 0.15 reach / 0.3 forward
    shift = 2.0 * 0.15 * reach / 0.3 / 10
    assert front.com_from_front_m == pytest.approx(0.25 - shift + reach - 0.01, abs=1e-12)
    assert assess(tracks, flight(10, 0.12)).flat_length_m == 0.5


def test_a_flipper_below_the_track_is_outside():
    tracks = robot(front_flippers=FLIPPERS)
    lowered = assess(tracks, flight(10, 0.12), friction=GRIP, flippers=Posture(front=-0.3))
    assert (lowered.verdict, lowered.governs) == ("outside-model", "validity")
    assert "a flipper reaches below" in lowered.reason
    raised = assess(tracks, flight(10, 0.12), friction=GRIP, flippers=Posture(front=0.3))
    assert raised.verdict == "go"


CODES = ("ibc", "ada", "osha", "din-general", "din-dwelling", "uk-general", "uk-private")
CODES += ("uk-utility", "iso-14122-3", "japan-dwelling", "ibc-dwelling")


@pytest.mark.parametrize("code", CODES)
def test_flippers_bring_absolem_inside_the_model(code):
    for question in ({"robot": "absolem", "flippers": "flat"}, {"robot": "absolem-flat"}):
        answer = assess(stairs=code, friction=1.5, **question)
        assert answer.verdict in ("go", "caution", "no-go")
        assert answer.model == "closed-form"
        assert answer.margin_deg is not None
        p, found = answer.nosing_spacing_m, answer
        # hand: data.md's figures through atan((L - p - C_L) / C_N)
        expected = atan2(found.flat_length_m - p - found.com_from_front_m, found.com_height_m)
        assert answer.margin_angle_deg == pytest.approx(degrees(expected), **ANGLE)
        assert answer.flat_length_m == pytest.approx(1.145, abs=0.005)  # 1.141 and 1.149


@pytest.mark.parametrize("code", CODES)
def test_bare_kenaf_is_outside_the_model_on_the_codes(code):
    answer = assess("kenaf", code, friction=GRIP)
    assert (answer.verdict, answer.governs) == ("outside-model", "validity")
    assert answer.exit_code == 3
    assert "p > L/2" in answer.reason
    assert f"{1e3 * Stairs.named(code).nosing_spacing:.0f} mm" in answer.reason
    assert "470 mm" in answer.reason


def test_outside_the_model_there_is_no_number_that_looks_valid():
    outside = [
        assess("kenaf", "ibc", friction=GRIP),
        assess(robot(front_flippers=FLIPPERS), flight(10, 0.12), flippers=Posture(front=-0.3)),
        assess("kenaf", flight(40, 0.1, steps=2), friction=GRIP),
    ]
    for answer in outside:
        assert answer.verdict == "outside-model"
        numbers = json.loads(answer.to_json())
        nulls = """margin_angle_deg lower_angle_deg margin_backward_deg margin_deg
            margin_at_best_deg margin_interval_deg margin_centroid_mm a_slip_up a_slip_down
            a_tip_downhill a_tip_uphill falls_over a_max a_min a_max_safe a_min_safe hardest_start
            hardest_stop paper measures probability area"""
        assert {name: numbers[name] for name in nulls.split()} == dict.fromkeys(nulls.split())
        assert set(numbers["margins_deg"].values()) == {None}
        assert numbers["contacts"] == []


def test_half_the_track_is_inside():
    # limit: p = L / 2 leaves two contacts; the least more does not. Both tips meet at C_L = L / 2
    half = assess(robot(com_from_front=0.2), flight(26, 0.25), friction=GRIP, **BARE)
    assert half.verdict == "no-go"
    assert half.margin_angle_deg == pytest.approx(half.lower_angle_deg, **ANGLE)
    assert assess(robot(), flight(10, 0.2501), friction=GRIP).verdict == "outside-model"


# Measured flights


def test_an_irregular_flight_is_judged_by_its_worst_step():
    # hand: 100 x 120 mm but one step of 108 mm: steeper and longer, worse in every way
    rises = (0.1, 0.1, 0.108, 0.1, 0.1, 0.1)
    answer = assess("kenaf", Stairs(rises=rises, goings=(0.12,) * 5), friction=GRIP)
    worst = assess("kenaf", Stairs(rise=0.108, going=0.12), friction=GRIP)
    for field in ("margin_deg", "angle_deg", "nosing_spacing_m", "a_max_safe", "required_friction"):
        assert getattr(answer, field) == pytest.approx(getattr(worst, field), rel=1e-12), field
    assert any("8.0 mm" in note for note in answer.notes)
    # the first riser belongs to entering, the last to landing
    ends = (0.3, 0.1, 0.1, 0.1, 0.1, 0.3)
    answer = assess("kenaf", Stairs(rises=ends, goings=(0.12,) * 5), friction=GRIP)
    assert answer.angle_deg == pytest.approx(degrees(atan(0.1 / 0.12)), **ANGLE)


def test_bounds_hold_on_every_step():
    # a steep step and a gentle, longer one: each is the worst in its own way
    steep, gentle = (0.094, 0.19), (0.085, 0.1985)
    flights = Stairs(rises=(0.09, steep[0], gentle[0], 0.09), goings=(steep[1], gentle[1], 0.19))
    answer = assess("kenaf", flights, friction=0.9)
    alone = [assess("kenaf", Stairs(rise=r, going=g), friction=0.9) for r, g in (steep, gentle)]
    tightest = {"a_tip_downhill": min, "a_tip_uphill": max, "a_slip_up": min, "a_slip_down": max}
    for name, choose in tightest.items():
        values = [getattr(each, name) for each in alone]
        assert values[0] != pytest.approx(values[1], abs=0.01)
        assert getattr(answer, name) == pytest.approx(choose(values), rel=1e-12)
    assert answer.a_max_safe == pytest.approx(min(each.a_max_safe for each in alone), rel=1e-12)
    assert answer.a_min_safe == pytest.approx(max(each.a_min_safe for each in alone), rel=1e-12)
    assert answer.margin_deg == pytest.approx(min(each.margin_deg for each in alone), rel=1e-12)


def test_the_worst_step_may_be_neither_the_longest_nor_the_steepest():
    # the gentle step is shorter too, but its slope lets the nose drop
    steep, gentle = (0.100, 0.195), (0.092, 0.1985)
    assert hypot(*steep) > hypot(*gentle)
    flights = Stairs(rises=(0.1, steep[0], gentle[0], 0.1), goings=(steep[1], gentle[1], 0.19))
    answer = assess("kenaf", flights, friction=GRIP)
    alone = [assess("kenaf", Stairs(rise=r, going=g), friction=GRIP) for r, g in (steep, gentle)]
    uphill = [each.margins_deg["tip_uphill"] for each in alone]
    assert uphill[1] < uphill[0] - 1
    assert answer.margins_deg["tip_uphill"] == pytest.approx(uphill[1], **ANGLE)
    assert answer.a_tip_uphill == pytest.approx(alone[1].a_tip_uphill, rel=1e-12)


def test_too_irregular_is_outside():
    # IBC 1011.5.4 allows 9.5 mm
    def spread(by):
        return assess(
            "kenaf", Stairs(rises=(0.1, 0.1, 0.1 + by, 0.1), goings=(0.12,) * 3), friction=GRIP
        )

    assert spread(0.0095).verdict == "go"
    wide = spread(0.0096)
    assert wide.verdict == "outside-model"
    assert "9.6 mm" in wide.reason


@pytest.mark.parametrize(("steps", "verdict"), [(3, "outside-model"), (4, "go")])
def test_too_short_a_flight_is_outside(steps, verdict):
    # hand: floor(470 / 150) + 1 = 4 nosings touch at once
    answer = assess("kenaf", flight(40, 0.150, steps=steps), friction=GRIP)
    assert answer.verdict == verdict
    if verdict != "go":
        assert answer.reason == (
            "Outside the closed form: the flight's 3 nosings are fewer than the track holds at "
            "once."
        )


def test_worst_step_among_hundreds():
    # hundreds of different steps, each worth its own verdict; the worst one is the answer's
    draw = np.random.default_rng(7)
    rises = np.round(0.1 + draw.uniform(0, 0.009, 400), 7).tolist()
    goings = np.round(0.12 + draw.uniform(0, 0.009, 399), 7).tolist()
    answer = assess("kenaf", Stairs(rises=rises, goings=goings), friction=GRIP, **BARE)
    margins = [
        min(
            atan((L - C_L - hypot(r, g)) / C_N) - atan(r / g),
            atan(r / g) - atan((hypot(r, g) - C_L) / C_N),
        )
        for r, g in list(zip(rises[1:], goings, strict=True))[:-1]
    ]
    assert answer.margin_deg == pytest.approx(degrees(min(margins)), **ANGLE)


def test_blocks_of_steps_are_judged_like_one(monkeypatch):
    # longer is gentler, so that no step outdoes another and all are judged
    more = np.linspace(0, 0.009, 60)
    rises = (0.1 - more).tolist()
    goings = (0.12 + 0.9 * more).tolist()[:-1]
    doubt = doubtful(**SPREAD)
    question = {"surface": Surface.of_friction(0.9, 0.02)}
    stairs = Stairs(rises=rises, goings=goings)
    at_once = assess(doubt, stairs, **question)
    steps = list(zip(rises[1:], goings, strict=True))[:-1]
    for block in (2048 * 7, 1):
        monkeypatch.setattr("kaidan.assessment.case.BLOCK", block)
        assert assess(doubt, stairs, **question).to_json() == at_once.to_json()
    alone = [assess(doubt, Stairs(rise=r, going=g), **question) for r, g in steps]
    # the same samples for all steps, but the worst step is not the same in all of them
    assert at_once.margin_deg <= min(answer.margin_deg for answer in alone)
    assert at_once.margin_deg == pytest.approx(min(answer.margin_deg for answer in alone), abs=0.3)
    assert at_once.probability.any >= max(answer.probability.any for answer in alone)
    assert at_once.a_max_safe <= min(answer.a_max_safe for answer in alone)
    assert at_once.a_min_safe >= max(answer.a_min_safe for answer in alone)


# The drive


def driven(angle, direction="up", speed=None, a=0.0, **drive):
    tracks = robot(drive=Drive(**drive).model_dump(), com_height=0.02)
    return assess(
        tracks,
        flight(angle, 0.12),
        friction=5.0,
        direction=direction,
        speed=speed,
        acceleration=a,
        **BARE,
    )


def test_traction_limits_the_slope():
    # hand: 49.03325 N is half the weight: 30 deg
    for angle, verdict in ((29.9, "go"), (30.1, "no-go")):
        answer = driven(angle, max_traction=10 * G / 2)
        assert answer.verdict == verdict
        assert answer.governs == "drive"
        assert answer.margins_deg["drive"] == pytest.approx(30 - angle, abs=1e-9)
    assert driven(29, max_traction=10 * G / 2, a=0.2).verdict == "no-go"
    assert driven(20).margins_deg["drive"] is None


def test_rolling_resistance_takes_traction_and_gives_it_back_downhill():
    # hand: sin 30 + 0.2 cos 30 = 0.673; going down sin 30 - 0.2 cos 30 = 0.327
    for direction, sign in (("up", 1), ("down", -1)):
        needed = 10 * G * (0.5 + sign * 0.2 * cos(radians(30)))
        for force, verdict in ((1.001 * needed, "go"), (0.999 * needed, "no-go")):
            answer = driven(30, direction, max_traction=force, rolling_resistance=0.2)
            assert answer.verdict == verdict, direction
        assert driven(30, direction, max_traction=needed, rolling_resistance=0.2).margins_deg[
            "drive"
        ] == pytest.approx(0, abs=1e-9)


def test_traction_of_the_weight_is_not_enough_where_the_tracks_resist():
    # hand: 1.05 of the weight; at 55 deg with c_rr 0.5 it takes 0.819 + 0.287 = 1.106
    assert sin(radians(55)) + 0.5 * cos(radians(55)) > 1.05
    answer = driven(55, max_traction=1.05 * 10 * G, rolling_resistance=0.5)
    assert (answer.verdict, answer.governs) == ("no-go", "drive")
    # limit: past sqrt(1 + c_rr^2) of the weight any slope will do
    answer = driven(55, max_traction=1.12 * 10 * G, rolling_resistance=0.5)
    assert answer.verdict == "go"
    assert answer.margins_deg["drive"] == pytest.approx(90 - 55, abs=1e-9)
    # limit: no slope at all where the force does not even bring the acceleration
    answer = driven(10, max_traction=5.0, a=3.0)
    assert answer.margins_deg["drive"] == pytest.approx(
        degrees(math.asin(0.5 / G - 3 / G)) - 10, abs=1e-9
    )
    assert driven(10, max_traction=1.0, rolling_resistance=0.5, a=9.8).verdict == "no-go"


def test_power_limits_the_traction_at_a_speed():
    # hand: 100 W x 0.5 / 0.5 m/s = 100 N > 10 g sin 30 = 49 N > 100 x 0.5 / 1.1
    known = {"max_power": 100.0, "efficiency": 0.5, "max_speed": 2.0}
    assert driven(30, speed=0.5, **known).verdict == "go"
    answer = driven(30, speed=1.1, **known)
    assert (answer.verdict, answer.governs) == ("no-go", "drive")
    unjudged = driven(30, **known)
    assert unjudged.margins_deg["drive"] is None
    assert any("takes the speed" in note for note in unjudged.notes)
    # what the drive can brake on the way down is another figure, which no sheet gives
    down = driven(30, "down", speed=1.1, **known)
    assert (down.verdict, down.margins_deg["drive"]) == ("go", None)
    # the smaller of both counts
    assert driven(30, speed=0.5, **known, max_traction=40.0).verdict == "no-go"


def test_a_drive_does_not_bring_a_robot_into_the_model():
    # outside in 7 of 2048 samples (sigma 3 mm, 8.1 mm short of L / 2): less than the risk, but
    # those samples count as failed although the drive would hold
    tracks = robot(drive={"max_traction": 1e4}, uncertainty={"flat_length": 0.006}, com_height=0.02)
    answer = assess(tracks, flight(10, 0.2419), friction=GRIP, **BARE)
    assert 0 < answer.probability.outside_model < 0.01
    assert answer.probability.any >= answer.probability.outside_model
    assert answer.probability.drive == answer.probability.outside_model


# Uncertainty and risk


def doubtful(**sigma):
    return Robot.named("kenaf").model_copy(update={"uncertainty": Uncertainty(**sigma)})


def test_the_margin_at_the_chosen_risk():
    # hand: one uncertain figure, so the quantile of the margin is the margin of the quantile; of
    # 2048 strata a share `risk` may fail, and the next one's middle counts
    for risk in (0.01, 0.1, 0.5):
        z = -NormalDist().inv_cdf((int(risk * 2048) + 0.5) / 2048)
        answer = assess(
            doubtful(com_from_front=0.005), flight(50, 0.150), friction=GRIP, risk=risk, **BARE
        )
        expected = degrees(atan((L - 0.150 - C_L - z * 0.005) / C_N)) - 50
        assert answer.margin_deg == pytest.approx(expected, **ANGLE)
        assert answer.risk == risk
        # the safe band likewise, the bare one with the sheet's figures
        theta = radians(50)
        safe = G * ((L - 0.150 - C_L - z * 0.005) / C_N * cos(theta) - sin(theta))
        assert answer.a_max_safe == pytest.approx(safe, rel=1e-12)
        assert answer.a_max == pytest.approx(G * (124 / 71 * cos(theta) - sin(theta)), rel=1e-12)
        shift = 1e3 * (L - 0.150 - C_L - z * 0.005 - C_N * tan(theta))
        assert answer.margin_centroid_mm == pytest.approx(shift, rel=1e-9)
    # 95 % interval: +-1.96 sigma
    low, high = answer.margin_interval_deg
    for value, z in ((low, 1.96), (high, -1.96)):
        expected = degrees(atan((L - 0.150 - C_L - z * 0.005) / C_N)) - 50
        assert value == pytest.approx(expected, abs=0.02)  # strata of 1/2048


def test_the_verdict_takes_the_risk():
    # P(fail) at 59 deg: sigma 5 mm, 3.4 deg of 0.3 deg/mm: about 15 %
    for risk, verdict in ((0.01, "no-go"), (0.1, "no-go"), (0.3, "go")):
        answer = assess(
            doubtful(com_from_front=0.005), flight(59, 0.150), friction=GRIP, risk=risk, **BARE
        )
        assert answer.verdict == verdict
        assert (answer.margin_deg > 0) == (answer.probability.any <= risk)


SPREAD = {"com_from_front": 0.004, "com_height": 0.003, "flat_length": 0.002}


def monte_carlo(angle, p, mu, *, d_theta, d_p, d_mu, tilt_d, tilt_M, count=400_000):
    """Oracle: failure modes by plain random numbers and the limits written out again."""
    draw = np.random.default_rng(99)

    def normal(mean, sigma):
        return mean + sigma * draw.standard_normal(count)

    length, from_front = normal(L, SPREAD["flat_length"]), normal(C_L, SPREAD["com_from_front"])
    height = normal(C_N, SPREAD["com_height"])
    theta, spacing, grip = normal(radians(angle), d_theta), normal(p, d_p), normal(mu, d_mu)
    fails = {
        "tip_downhill": np.arctan2(length - spacing - from_front, height) - tilt_d - tilt_M - theta,
        "tip_uphill": theta - np.arctan2(spacing - from_front, height) - tilt_d,
        "slip_up": np.arctan(grip) - theta,
        "slip_down": theta + np.arctan(grip),
    }
    chances = {name: float(np.mean(margin <= 0)) for name, margin in fails.items()}
    chances["any"] = float(np.mean(np.minimum.reduce(list(fails.values())) <= 0))
    return chances


@pytest.mark.parametrize(
    ("angle", "p", "mu"), [(55, 0.150, 1.5), (40, 0.180, 0.88), (20, 0.220, 1.0), (25, 0.2, 1.0)]
)
def test_probabilities_against_monte_carlo(angle, p, mu):
    # oracle; stratified samples of 2048 err by less than 1/sqrt(2048) = 0.022 a tail, mostly by
    # far less: 0.015 holds for all four
    expected = monte_carlo(
        angle, p, mu, d_theta=0.01, d_p=0.001, d_mu=0.03, tilt_d=radians(2.6), tilt_M=radians(2.6)
    )
    stairs = flight(angle, p).model_copy(
        update={"uncertainty": StairsUncertainty(angle=0.01, nosing_spacing=0.001)}
    )
    found = assess(doubtful(**SPREAD), stairs, surface=Surface.of_friction(mu, 0.03)).probability
    for name, chance in expected.items():
        assert getattr(found, name) == pytest.approx(chance, abs=0.015), name
    assert found.outside_model == 0
    assert found.drive is None


def test_a_small_risk_takes_more_samples():
    # hand: one uncertain figure: P(fail) = Phi(-z), z = 3.45 -> 2.8e-4: too much for 1e-4
    z = 3.45
    angle = degrees(atan((L - 0.150 - C_L - z * 0.005) / C_N))
    doubt = doubtful(com_from_front=0.005)
    question = {"friction": GRIP, **BARE}
    assert assess(doubt, flight(angle, 0.150), risk=1e-4, **question).verdict == "no-go"
    assert assess(doubt, flight(angle, 0.150), risk=1e-3, **question).verdict == "go"
    found = assess(doubt, flight(angle, 0.150), risk=1e-4, **question)
    assert found.probability.any == pytest.approx(2.8e-4, abs=2e-5)


def test_the_same_question_has_the_same_answer():
    asked = {"surface": Surface.of_friction(1.0, 0.1), "risk": 0.02}
    first = assess(doubtful(**SPREAD), flight(40, 0.150), **asked)
    assert first.to_json() == assess(doubtful(**SPREAD), flight(40, 0.150), **asked).to_json()


def test_no_probability_where_all_is_certain():
    answer = kenaf(40, 0.150)
    assert answer.probability is answer.margin_interval_deg is None


def test_probably_outside_the_model():
    # hand: 233 of 470 / 2 = 235 mm, sigma 3 mm of spacing: 25 % are beyond
    stairs = flight(30, 0.233).model_copy(
        update={"uncertainty": StairsUncertainty(nosing_spacing=0.003)}
    )
    answer = assess("kenaf", stairs, friction=GRIP)
    assert answer.verdict == "outside-model"
    assert answer.reason == (
        "Outside the closed form: the nosing spacing of 233 mm is more than half the flat length "
        "of 470 mm (p > L/2) with a probability of 0.25, more than the accepted 0.01."
    )
    assert answer.probability.outside_model == pytest.approx(0.2525, abs=0.001)
    surely = assess(doubtful(com_from_front=0.005), "ibc").probability
    assert surely.tip_downhill == surely.tip_uphill == surely.any == surely.outside_model == 1.0
    assert surely.slip_up is surely.drive is None


# Area E


def controlled(**limits):
    drive = {"max_speed": 0.5, "max_acceleration": 3.0, "max_deceleration": 3.0} | limits
    sheet = Robot.named("kenaf").model_dump()
    return Robot.model_validate(sheet | {"drive": {"acceleration_control": True} | drive})


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("angle", [47, 52, 57])
def test_area_e_is_caution_with_a_plan_that_holds(angle, direction):
    question = {"friction": GRIP, "direction": direction, **BARE}
    question |= {"facing": "nose-first" if direction == "up" else "tail-first"}
    stairs = flight(angle, 0.200)
    assert assess("kenaf", stairs, **question).verdict == "no-go"
    answer = assess(controlled(), stairs, **question)
    assert (answer.verdict, answer.area) == ("caution", "E")
    assert answer.margin_deg <= 0
    assert answer.falls_over == "tail"  # if it does not follow the plan
    assert "controlling the acceleration" in answer.reason
    # the plan, followed step by step with limits written out again
    case = case_of(controlled(), stairs, **question)
    found = judge(case)
    plan = plan_acceleration(case, found.stance, found.nominal, found.step, v_min=0.025)
    theta, p, spans = radians(angle), 0.200, 10
    position, energy = 0.0, plan.v[0] ** 2 / 2
    cells = len(plan.a) // spans
    width = np.tile(np.diff(_edges(p, direction)), spans)
    assert len(width) == len(plan.a) == cells * spans
    for a, w, v in zip(plan.a, width, plan.v[1:], strict=True):
        for inside in (1e-6, 0.5, 1 - 1e-6):
            travelled = (position + inside * w) % p
            d = travelled if direction == "up" else p - travelled
            under = [d + k * p for k in range(4) if d + k * p < L - 1e-12]
            upward = a if direction == "up" else -a
            upper = G * ((under[-1] - C_L) / C_N * cos(theta) - sin(theta))
            lower = G * ((under[0] - C_L) / C_N * cos(theta) - sin(theta))
            assert lower - 1e-6 <= upward <= min(upper, G * (3 * cos(theta) - sin(theta))) + 1e-6
        assert -3.0 - 1e-12 <= a <= 3.0 + 1e-12
        position, energy = position + w, energy + a * w
        assert energy == pytest.approx(v**2 / 2, abs=1e-12)
        assert 0.025 - 1e-9 <= v <= 0.5 + 1e-9
    assert position == pytest.approx(spans * p, abs=1e-12)


def _edges(p, direction):
    """Edges of the cells: 200 over a spacing, one of them where the lowest contact leaves."""
    d_C = L - 2 * p
    before = round(200 * d_C / p)
    edges = np.concatenate(
        [np.linspace(0, d_C, before + 1)[:before], np.linspace(d_C, p, 201 - before)]
    )
    return edges if direction == "up" else p - edges[::-1]


def test_area_e_at_the_other_end():
    # at 220 mm and 18 deg the nose drops between two nosings unless it speeds up there
    assert kenaf(18, 0.220, **BARE).verdict == "no-go"
    answer = assess(controlled(), flight(18, 0.220), friction=GRIP, **BARE)
    assert (answer.verdict, answer.governs, answer.area) == ("caution", "tip_uphill", "E")
    assert answer.falls_over == "nose"


def test_no_area_e_without_control_speed_or_strength():
    question = {"friction": GRIP, **BARE}
    stairs = flight(52, 0.200)
    for robot_without in (
        controlled(acceleration_control=False),
        controlled(max_speed=None),
        controlled(max_speed=0.05),
        controlled(max_deceleration=0.05),
    ):
        answer = assess(robot_without, stairs, **question)
        assert (answer.verdict, answer.area) == ("no-go", "B")
    # theory: beyond atan((L - p/2 - C_L) / C_N) = 67.8 deg no flight can be taken
    for angle in (68, 75, 80):
        assert assess(controlled(max_speed=9.0), flight(angle, 0.2), **question).verdict == "no-go"


def test_no_area_e_by_a_running_start():
    # hand: at 62 deg it must slow down by up to 0.62 m/s^2 over the first 9.5 mm of every 150 mm,
    # 2.9 mm^2/s^2 in energy, and may gain 0.001 m/s^2 x 140 mm = 0.14: a run of 0.3 m/s would
    # last for ten spacings, but not for ever
    slow_to_gain = controlled(max_speed=3.0, max_acceleration=0.001)
    answer = assess(slow_to_gain, flight(62, 0.150), friction=GRIP, **BARE)
    assert answer.a_max == pytest.approx(-0.62, abs=0.005)
    assert answer.verdict == "no-go"
    assert assess(controlled(), flight(62, 0.150), friction=GRIP, **BARE).verdict == "caution"


def test_no_area_e_by_running_faster_and_faster():
    # likewise at 220 mm and 10 deg, where it must speed up at the end of every spacing
    slow_to_lose = controlled(max_speed=3.0, max_deceleration=0.001)
    answer = assess(slow_to_lose, flight(10, 0.220), friction=GRIP, **BARE)
    assert answer.a_min == pytest.approx(1.56, abs=0.005)
    assert answer.verdict == "no-go"
    assert assess(controlled(), flight(10, 0.220), friction=GRIP, **BARE).verdict == "caution"


def test_no_area_e_at_a_creep():
    # a plan keeps to 5 % of the largest speed: at rest nothing follows a position
    asked = {"friction": GRIP, **BARE}
    for speed, verdict in ((0.02, "no-go"), (0.05, "caution"), (0.3, "caution")):
        assert assess(controlled(), flight(48, 0.200), speed=speed, **asked).verdict == verdict


def test_no_area_e_for_uncertain_inputs():
    # a plan holds for one set of figures
    sheet = controlled().model_dump() | {"uncertainty": {"com_from_front": 1e-4}}
    doubt = Robot.model_validate(sheet)
    question = {"friction": GRIP, **BARE}
    assert assess(doubt, flight(52, 0.200), **question).verdict == "no-go"


def test_no_area_e_where_it_slips():
    # a running start could coast up a short flight: the paper's area A all the same, so NO-GO
    answer = assess(controlled(max_speed=5.0), flight(30, 0.15), friction=0.57, **BARE)
    assert (answer.verdict, answer.governs, answer.area) == ("no-go", "slip_up", "A")


def test_area_e_takes_a_drive_that_can_follow_the_plan():
    # hand: 20 kg at 52 deg take 154.6 N to hold; what is left of 155.5 N gives 0.05 m/s^2, over
    # 183 mm 0.0086 m^2/s^2 a spacing; the braking from 1.43 m/s^2 to none over 17 mm costs 0.0121
    def pulling(force):
        sheet = controlled(max_traction=force).model_dump() | {"mass": 20.0}
        robot = Robot.model_validate(sheet)
        return assess(robot, flight(52, 0.2), friction=GRIP, **BARE).verdict

    assert 20 * G * sin(radians(52)) == pytest.approx(154.6, abs=0.05)
    assert [pulling(force) for force in (400.0, 157.0, 155.5)] == ["caution", "caution", "no-go"]


def test_no_area_e_past_the_drives_traction():
    tracks = {"mass": 20.0, "drive": {"max_traction": 100.0, "max_speed": 2.0}}
    tracks["drive"]["acceleration_control"] = True
    weak = Robot.model_validate(Robot.named("kenaf").model_dump() | tracks)
    answer = assess(weak, flight(52, 0.2), friction=GRIP, **BARE)
    assert answer.verdict == "no-go"


# What would help


def test_go_down_in_reverse():
    # hand: nose first 32.9 deg, tail first 60.2 deg
    answer = kenaf(45, 0.150, direction="down")
    assert answer.verdict == "no-go"
    best = answer.what_would_help[0]
    assert (best.change, best.verdict) == ("Go down tail first", "go")
    assert best.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 47.6, **ANGLE)


@pytest.mark.parametrize(
    ("asked", "again"),
    [
        (
            {"friction": 1.5, "acceleration": 1.5, "direction": "down"},
            {
                "Go down tail first": {"facing": "tail-first"},
                "Keep the speed constant": {"acceleration": 0.0},
            },
        ),
        # hand: tan 42 deg + 1.5 / (g cos 42 deg) = 1.106
        (
            {"friction": 0.8, "acceleration": 1.5},
            {
                "Keep the speed constant": {"acceleration": 0.0},
                "A surface with a friction of 1.12 or more": {"friction": 1.12},
            },
        ),
    ],
)
def test_advice_is_the_same_question_asked_again(asked, again):
    changes = {each.change: each for each in kenaf(42, 0.150, **asked).what_would_help}
    assert set(again) <= set(changes)
    for text, changed in again.items():
        found = kenaf(42, 0.150, **(asked | changed))
        assert found.verdict == changes[text].verdict
        assert found.margin_deg == pytest.approx(changes[text].margin_deg, **ANGLE)


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("load", [0.0, 5.0])
def test_moving_the_centroid_as_told_helps(facing, load):
    payload = Payload(mass=load, from_front=0.25, height=0.1)
    question = {"friction": GRIP, "facing": facing}
    answer = assess(robot(), flight(42, 0.15), payload=payload, **question)
    assert answer.verdict != "go"
    told = next(c for c in answer.what_would_help if c.change.startswith("Move the centroid"))
    mm = float(told.change.split()[3])
    end = "front" if facing == "nose-first" else "rear"
    assert f"towards the {end}" in told.change
    shift = (mm if end == "rear" else -mm) / 1e3
    # the robot without its payload moves by more, the payload by more still
    moved = robot(com_from_front=0.25 + shift * (10 + load) / 10)
    after = assess(moved, flight(42, 0.15), payload=payload, **question)
    assert after.verdict == told.verdict == "go"
    assert after.margin_deg == pytest.approx(told.margin_deg, **ANGLE)
    if load:
        travel = float(told.change.split("payload by ")[1].split()[0])
        assert travel == pytest.approx(mm * 15 / 5, abs=0.5)  # to a whole millimetre
        by_load = Payload(mass=load, from_front=0.25 + shift * 15 / 5, height=0.1)
        after = assess(robot(), flight(42, 0.15), payload=by_load, **question)
        assert after.verdict == "go"


def test_no_advice_for_a_go_and_only_better_advice_else():
    assert kenaf(40, 0.150).what_would_help == ()
    rank = ("go", "caution", "no-go", "outside-model")
    for angle in (35, 48, 56, 58, 62, 70, 80):
        for friction in (0.4, GRIP, None):
            answer = kenaf(angle, 0.200, friction=friction, direction="down")
            for change in answer.what_would_help:
                worse = rank.index(change.verdict) - rank.index(answer.verdict)
                assert worse < 0 or (worse == 0 and change.margin_deg > answer.margin_deg)


def test_laying_the_flippers_flat_helps():
    answer = assess("absolem", "ibc", friction=1.5)
    assert answer.verdict == "outside-model"
    told = answer.what_would_help[0]
    assert (told.change, told.verdict) == ("Lay the flippers flat, in line with the track", "go")
    flat = assess("absolem", "ibc", friction=1.5, flippers="flat")
    assert told.margin_deg == pytest.approx(flat.margin_deg, **ANGLE)
    steep = assess("absolem", flight(60, 0.3), friction=5.0, flippers="flat")
    assert not any("flippers" in change.change for change in steep.what_would_help)


def test_measuring_the_allowances_helps():
    answer = kenaf(58, 0.150)
    told = next(c for c in answer.what_would_help if c.change.startswith("Measure"))
    assert told.change == "Measure theta_d and theta_M: at best, if they are zero"
    assert told.verdict == "go"
    assert told.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 58, **ANGLE)


def test_no_staircase_is_too_steep_to_be_judged():
    # friction of tan 80 deg = 5.7 is beyond every sheet: no advice, but no exception either
    for friction in (0.5, GRIP, None):
        assert kenaf(80, 0.150, friction=friction).verdict == "no-go"
    # advice that would put the centroid out of the robot is no advice
    odd = robot(com_from_front=0.45, com_height=0.25)
    answer = assess(odd, flight(20, 0.2), friction=0.3, acceleration=0.4, facing="tail-first")
    assert answer.verdict == "no-go"


# Notes and the rest


def test_notes_say_what_was_assumed():
    notes = " ".join(kenaf(30, 0.150, friction=None).notes)
    assert "not entering or landing" in notes
    assert "theta_d is not measured" in notes
    assert "theta_M is not measured" in notes
    assert "No friction was stated, so no GO can be given." in notes
    measured = " ".join(kenaf(30, 0.150, **BARE).notes)
    assert "not measured" not in measured


def test_names_and_sheets_and_paths_are_one_question(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(Robot.named("kenaf").to_toml(), encoding="utf-8")
    wet = tmp_path / "wet.toml"
    wet.write_text(Surface.named("concrete-wet").to_toml(), encoding="utf-8")
    asked = [
        assess("kenaf", "japan-dwelling", surface="concrete-wet"),
        assess(Robot.named("kenaf"), Stairs.named("japan-dwelling"), surface=wet),
        assess(str(path), "japan-dwelling", surface=Surface.named("concrete-wet")),
        assess(path, "JAPAN-DWELLING", surface=str(wet)),
    ]
    assert len({answer.to_json() for answer in asked}) == 1


def test_exit_codes():
    assert kenaf(30, 0.150).exit_code == 0
    assert kenaf(58, 0.150).exit_code == 0
    assert kenaf(62, 0.150).exit_code == 1
    assert assess("kenaf", "ibc").exit_code == 3


def test_numpy_numbers_are_numbers():
    expected = kenaf(30, 0.150, friction=0.75, acceleration=0.5, risk=0.25).to_json()
    for kind in (np.float64, np.float32, np.float16):  # all hold these figures exactly
        asked = kenaf(30, 0.150, friction=kind(0.75), acceleration=kind(0.5), risk=kind(0.25))
        assert asked.to_json() == expected
    assert (
        kenaf(30, 0.150, friction=np.int64(1)).to_json() == kenaf(30, 0.150, friction=1).to_json()
    )


# Refusals, to the letter

REFUSED = {
    "surface and friction": (
        {"surface": "concrete-dry"},
        "give either a surface or a friction, not both",
    ),
    "friction": ({"friction": -0.1}, "friction = -0.1 is not within 0 to 5"),
    "friction nan": ({"friction": math.nan}, "friction = nan is not within 0 to 5"),
    "friction text": ({"friction": "0.8"}, "friction = '0.8' is not a number"),
    "friction true": ({"friction": True}, "friction = True is not a number"),
    "friction huge": ({"friction": 10**400}, "friction = inf is not within 0 to 5"),
    "acceleration": (
        {"acceleration": 10.0},
        "acceleration = 10 is not within -9.8 to 9.8 m/s^2",
    ),
    "acceleration none": ({"acceleration": None}, "acceleration = None is not a number"),
    "speed": ({"speed": -1.0}, "speed = -1 is not within 0 to 30 m/s"),
    "risk": ({"risk": 0.0}, "risk = 0 is not within 0.0001 to 0.5"),
    "risk high": ({"risk": 0.6}, "risk = 0.6 is not within 0.0001 to 0.5"),
    "direction": (
        {"direction": "sideways"},
        "direction = 'sideways' is not known; known: up, down",
    ),
    "direction empty": ({"direction": ""}, "direction = '' is not known; known: up, down"),
    "facing": (
        {"facing": "nose"},
        "facing = 'nose' is not known; known: nose-first, tail-first",
    ),
    "flippers": (
        {"flippers": "up"},
        "flippers = 'up' is not known; known: flat, stowed, or angles",
    ),
    "no flippers": ({"flippers": "flat"}, "robot 'kenaf' has no flippers"),
    "payload": ({"payload": 5}, "payload = 5 is not a Payload or a list of them"),
    "payload text": ({"payload": ""}, "payload = '' is not a Payload or a list of them"),
    "payload array": (
        {"payload": np.array(0.5)},
        "payload = array(0.5) is not a Payload or a list of them",
    ),
    "model array": (
        {"model": np.array([0.5, 0.6])},
        "model = array([0.5, 0.6]) is not known; known: contact, closed-form",
    ),
    "payload mass": (
        {"payload": Payload(mass=1, from_front=0, height=0)},
        "robot 'kenaf': mass is not published, so a payload cannot be placed; give the robot's "
        "mass",
    ),
    "theta_d": (
        {"theta_d": 2.6},
        "theta_d: allowance: high = 2.6 rad is not within 0 to 0.6 rad (in degrees? that would be "
        "0.0453786 rad)",
    ),
    "theta_M": (
        {"theta_M": (0.02, 0.01)},
        "theta_M: allowance: low = 0.02 rad is more than high = 0.01 rad",
    ),
    "theta_d three": (
        {"theta_d": (0.01, 0.02, 0.03)},
        "theta_d is not an angle or a pair (low, high) [rad]",
    ),
    "model": ({"model": "wishful"}, "model = 'wishful' is not known; known: contact, closed-form"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name):
    question, text = REFUSED[name]
    with pytest.raises(InputError) as refused:
        kenaf(30, 0.150, **question)
    assert str(refused.value) == text


def test_a_speed_that_the_robot_does_not_reach_is_refused():
    with pytest.raises(InputError) as refused:
        assess("absolem", flight(30, 0.150), speed=3.0)
    assert str(refused.value) == "speed = 3 is not within 0 to 0.4 m/s, the most absolem can do"


@pytest.mark.parametrize("wrong", [5, None, b"kenaf", ["kenaf"]])
def test_what_is_no_sheet_is_refused(wrong):
    with pytest.raises(InputError, match="is not a Robot, a name of the catalogue or a TOML file"):
        assess(wrong, "ibc")
    wrong = [5] if isinstance(wrong, list) else wrong  # a list of names is several flights
    with pytest.raises(InputError, match="is not a Stairs"):
        assess("kenaf", wrong)
    if wrong is not None:
        with pytest.raises(InputError, match="is not a Surface"):
            assess("kenaf", "ibc", surface=wrong)


def test_the_track_is_kept_apart_from_its_gap():
    # two tracks in line with nothing between them: the closed form knows no such underside
    gapped = robot(track=Track(flat_length=0.5, gap=0.1).model_dump())
    answer = assess(gapped, flight(10, 0.12), friction=GRIP)
    assert answer.verdict == "outside-model"
    assert "100 mm in the middle of the underside have no track" in answer.reason
