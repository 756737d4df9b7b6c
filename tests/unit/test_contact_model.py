"""The contact model's verdict: rules of the issue, uncertain inputs, yaw.

Robots and stairs are chosen so that the numbers follow from theory.md section 3 by hand.
"""

import json
import math

import pytest

from kaidan.assessment import answer_to, assess, case_of
from kaidan.assessment.contact_model import LONG_FLIGHT
from kaidan.assessment.yaw import polygon_margins, yaw_limit
from kaidan.cli.assess import as_text
from kaidan.errors import InputError
from kaidan.robot import Payload, Robot, Track, Uncertainty
from kaidan.stairs import Stairs, StairsUncertainty
from kaidan.surface import Surface

pytestmark = pytest.mark.usefixtures("compiled_kernel")

KENAF = Robot.named("kenaf")
WITH_GAUGE = KENAF.model_copy(
    update={"track": KENAF.track.model_copy(update={"gauge": 0.3, "width": 0.05})}
)
AS_PRINTED = 5e-3  # deg: theory.md gives the angles to three decimals, the allowances to one


def at(angle, p=0.150, steps=8):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=p, steps=steps)


def sure(**more):
    return {"friction": 2.5, "theta_d": 0.0, "theta_M": 0.0} | more


def test_go_with_the_papers_margin():
    """Paper: 60.205 deg at 150 mm."""
    answer = assess(KENAF, at(50), **sure())
    assert answer.verdict == "go"
    assert answer.model == "contact"
    assert answer.margin_deg == pytest.approx(10.205, abs=AS_PRINTED)
    assert (answer.governs, answer.phase) == ("tip_downhill", "traverse")
    assert answer.grades.no_rotation
    assert answer.grades.energy_threshold_mm == pytest.approx(0.51, abs=5e-3)  # theory.md: 0.5 mm
    assert [each.phase for each in answer.phases] == ["enter", "traverse", "land"]


def test_allowances_come_off():
    """By hand: 2.6 deg each unless measured."""
    answer = assess(KENAF, at(50), friction=2.5)
    assert answer.margin_deg == pytest.approx(10.205 - 5.2, abs=AS_PRINTED)
    assert answer.margin_at_best_deg == pytest.approx(10.205, abs=AS_PRINTED)


def test_unknown_friction_is_never_a_go():
    answer = assess(KENAF, at(50), theta_d=0.0, theta_M=0.0)
    assert (answer.verdict, answer.governs) == ("caution", "friction_unknown")


def test_lack_of_friction_is_a_no_go():
    """By hand: a slope of 50 deg asks for 1.19."""
    answer = assess(KENAF, at(50), **sure(friction=1.1))
    assert (answer.verdict, answer.governs) == ("no-go", "slip")
    by_hand = math.degrees(math.atan(1.1)) - 50
    assert answer.margin_deg == pytest.approx(by_hand, abs=1e-4)


def test_past_the_papers_limit_a_catch_is_at_best_a_caution():
    """Between 60.2 deg (grade one) and 62.48 deg (grade two, theory.md) a catch holds it."""
    answer = assess(KENAF, at(61.5), **sure())
    assert (answer.verdict, answer.governs) == ("caution", "catch")
    assert answer.margin_deg == pytest.approx(60.205 - 61.5, abs=AS_PRINTED)
    assert answer.grades.no_rotation is False
    assert answer.grades.caught
    assert "no experiment" in answer.reason
    accepted = assess(KENAF, at(61.5), **sure(), accept="caught")
    assert accepted.verdict in ("go", "caution")
    assert accepted.grades.accepted == "caught"


def test_a_fall_is_a_no_go():
    answer = assess(KENAF, at(70), **sure())
    assert answer.verdict == "no-go"
    assert answer.falls_over == "tail"
    assert answer.exit_code == 1


def test_fewer_than_two_nosings_are_never_a_go():
    """p > L/2: the criterion says nothing."""
    flat = Robot(
        name="flat",
        com_from_front=0.25,
        com_height=0.03,
        track=Track(flat_length=0.5, front_radius=0.1, rear_radius=0.1),
    )
    answer = assess(flat, at(15, p=0.3), **sure())
    assert answer.verdict == "caution"
    assert answer.grades.no_rotation is None
    assert any("p > L/2" in note for note in answer.notes)


def test_little_energy_is_a_caution():
    """Theory section 4: at (200 mm, 44 deg) 0.07 mm of energy margin are left, and it swung."""
    answer = assess(KENAF, at(44, p=0.200), **sure())
    assert (answer.verdict, answer.governs) == ("caution", "energy")
    assert answer.phases[1].energy_margin_mm == pytest.approx(0.07, abs=5e-3)
    slowly = assess(KENAF, at(44, p=0.200), **sure(speed=0.01))  # v^2/2g = 0.005 mm
    assert slowly.verdict == "go"


def test_a_landing_shorter_than_the_robot_is_a_caution():
    short = at(50).model_copy(update={"upper_landing": 0.3})
    answer = assess(KENAF, short, **sure())
    assert answer.verdict == "caution"
    assert "landing is shorter" in answer.reason


def test_an_acceleration_no_slope_bears_is_not_taken_for_safe():
    """By hand: |C_N a| > g hypot(x, C_N): no slope is a limit, and it tips on all of them."""
    tall = Robot(
        name="tall",
        com_from_front=0.25,
        com_height=0.6,
        track=Track(flat_length=0.5, front_radius=0.06, rear_radius=0.06),
    )
    answer = assess(tall, at(30, p=0.12), **sure(acceleration=-9.8))
    assert answer.verdict != "go"
    assert answer.margins_deg["tip_uphill"] < 0


def doubtful(com=0.001, height=0.0007, length=0.0007):
    doubts = Uncertainty(com_from_front=com, com_height=height, flat_length=length)
    return KENAF.model_copy(update={"uncertainty": doubts})


def test_certain_inputs_have_no_probability():
    answer = assess(KENAF, at(50), **sure())
    assert answer.probability is None
    assert answer.margin_interval_deg is None


def test_the_centroids_doubt_is_the_formulas():
    """Theory section 3: d theta_sup/dC_L = -C_N/(x^2 + C_N^2); 1 % is 2.326 sigma off."""
    answer = assess(doubtful(com=0.001, height=0.0, length=0.0), at(50), **sure())
    sigma = 0.001 * 0.071 / (0.124**2 + 0.071**2)
    margin = math.degrees(math.radians(10.2050) - 2.3263 * sigma)
    # deg: one sample of 2048 lies 0.03 sigma from the next one there, sigma is 0.2 deg; and the
    # second order, (2.3 sigma)^2 times a bend of 1 per rad
    assert answer.margin_deg == pytest.approx(margin, abs=0.02)
    low, high = answer.margin_interval_deg
    assert high - low == pytest.approx(math.degrees(2 * 1.96 * sigma), abs=0.05)
    assert answer.probability.tip_downhill == 0.0


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_uncertain_margins_are_the_closed_forms(direction, facing):
    """On a flight of known steps the criterion is the closed form, sample by sample."""
    stairs = at(30).model_copy(
        update={"uncertainty": StairsUncertainty(angle=0.003, nosing_spacing=0.0003)}
    )
    surface = Surface.of_friction(1.2, uncertainty=0.02)
    case = case_of(
        doubtful(), stairs, surface=surface, direction=direction, facing=facing, theta_d=0.0,
        theta_M=0.0,
    )  # fmt: skip
    contact, closed = (answer_to(case, model=model) for model in ("contact", "closed-form"))
    for mode in ("tip_downhill", "tip_uphill"):
        assert contact.margins_deg[mode] == pytest.approx(closed.margins_deg[mode], abs=1e-9)
    assert contact.probability.tip_downhill == closed.probability.tip_downhill
    assert contact.probability.any == pytest.approx(closed.probability.any, abs=0.005)


def test_doubt_about_two_nosings_keeps_from_a_go():
    """2 p = 440 mm of 470 mm, known to 10 mm: in a tenth of a per cent p > L/2 (3 sigma)."""
    robot = doubtful(com=0.0, height=0.0, length=0.010)
    answer = assess(robot, at(30, p=0.220), **sure(risk=0.001))
    assert answer.probability.outside_model == pytest.approx(0.0013, abs=5e-4)
    assert answer.verdict == "caution"


def test_long_flights_are_driven_on_what_repeats():
    few, many = (assess(KENAF, at(50, steps=n), **sure()) for n in (LONG_FLIGHT, 10_000))
    assert few.verdict == many.verdict == "go"
    assert few.margin_deg == many.margin_deg
    assert any("10000 risers are alike" in note for note in many.notes)


def test_where_no_friction_is_enough_the_answer_says_null():
    """JSON has no infinity; seen with a tail-heavy Absolem against a riser of 256 mm."""
    load = Payload(mass=5.0, from_front=0.2, height=0.3)
    stairs = at(math.degrees(0.75), p=0.375)
    answer = assess(
        "absolem", stairs, friction=1.0, acceleration=1.0, flippers="flat", payload=load
    )
    assert None in [each.required_friction for each in answer.phases]
    assert answer.required_friction is None
    assert "Infinity" not in answer.to_json()
    assert "no friction is enough" in as_text(answer)


def test_json_holds_no_nan():
    answer = assess(WITH_GAUGE, at(61.5), **sure(), yaw=0.1)
    assert json.loads(answer.to_json())["yaw_deg"] == pytest.approx(math.degrees(0.1))


def test_a_yaw_needs_the_gauge_and_the_contact_model():
    with pytest.raises(InputError, match=r"'kenaf': track\.gauge is not known"):
        assess(KENAF, at(50), **sure(), yaw=0.1)
    with pytest.raises(InputError, match="closed form knows no yaw"):
        assess(WITH_GAUGE, at(50), **sure(), yaw=0.1, model="closed-form")
    with pytest.raises(InputError, match="yaw = 2 is not within"):
        assess(WITH_GAUGE, at(50), **sure(), yaw=2.0)
    assert any("track.gauge" in note for note in assess(KENAF, at(50), **sure()).notes)


def test_yaw_limit_is_where_the_margin_ends():
    case = case_of(WITH_GAUGE, at(50), **sure(speed=1e-6))
    limit = yaw_limit(case)
    assert (polygon_margins(case, yaw=limit - 0.01) > 0).all()
    assert not (polygon_margins(case, yaw=limit + 0.01) > 0).all()
    assert assess(WITH_GAUGE, at(50), **sure(), yaw=limit - 0.02).grades.no_rotation
    after = assess(WITH_GAUGE, at(50), **sure(speed=1e-6), yaw=limit + 0.02)
    assert after.verdict != "go"
    assert after.yaw_limit_deg == pytest.approx(math.degrees(limit), abs=1e-6)


def test_a_tall_narrow_robot_tips_sideways():
    """By hand: tan(theta) sin(psi) = gauge/(2 C_N): 30 deg of yaw on 45 deg with gauge = C_N."""
    narrow = Robot(
        name="narrow",
        com_from_front=0.8,
        com_height=0.3,
        track=Track(flat_length=2.0, front_radius=0.1, rear_radius=0.1, gauge=0.3),
    )
    case = case_of(narrow, at(45, p=0.15, steps=20), friction=2.0, theta_d=0.0, theta_M=0.0)
    _, _, sideways = polygon_margins(case, yaw=math.radians(30))
    assert sideways[0] == pytest.approx(0.0, abs=1e-12)
    assert math.degrees(yaw_limit(case)) < 30.0


def test_a_small_risk_takes_more_samples_at_a_yaw_too():
    doubts = Uncertainty(com_height=0.004)
    robot = Robot.named("absolem").model_copy(update={"uncertainty": doubts})
    answer = assess(robot, "ibc", flippers="flat", friction=1.5, yaw=0.1, risk=1e-3)
    assert answer.margin_interval_deg[0] < answer.margin_interval_deg[1]


def test_at_best_is_never_less_than_the_margin_where_a_catch_is_accepted():
    asked = {"friction": 3.0, "flippers": "flat", "accept": "caught"}
    answer = assess("absolem", "ibc", **asked)
    assert answer.margin_at_best_deg == pytest.approx(answer.margin_deg, abs=1e-9)  # friction's
