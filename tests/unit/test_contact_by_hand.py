"""Numbers of the contact model's answers against a calculation by hand beside them.

Lengths of Kenaf in millimetres as the paper prints them: L 470, C_L 196, C_N 71. Angles agree to
1e-6 deg, because poses are settled to 1e-9 m on a robot of some 0.1 m.
"""

import math
from math import atan, atan2, cos, degrees, radians, sin, tan
from statistics import NormalDist

import pytest

from kaidan import Payload, Profile, Question, Robot, Stairs, Surface
from kaidan.assessment import answer_to
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.models.quasi_static import findings_of, traverse_of
from kaidan.modes import Phase, Verdict
from kaidan.robot import Drive, Track, Uncertainty
from kaidan.terrain.stairs_uncertainty import StairsUncertainty
from one_posture import assess

G = 9.80665
KENAF = Robot.named("kenaf").model_copy(update={"theta_d": None, "theta_M": None})
BARE = {"theta_d": 0.0, "theta_M": 0.0}
SURE = {"friction": 3.0, **BARE}
DEGREE = 1e-6
WAYS = [(d, f) for d in ("up", "down") for f in ("nose-first", "tail-first")]
"""Direction and which end leads."""


def at(angle, p=0.150, steps=8):
    return Stairs.inclined(angle=radians(angle), nosing_spacing=p, steps=steps)


def round_robot(C_L=0.25, C_N=0.1, mass=20.0, drive=None, **track):
    return Robot(
        name="round",
        mass=mass,
        com_from_front=C_L,
        com_height=C_N,
        drive=drive or Drive(),
        track=Track(**{"flat_length": 0.5, "front_radius": 0.06, "rear_radius": 0.06} | track),
    )


def limits(p, direction, facing, L=470, C_L=196, C_N=71):
    """Steepest and gentlest slope [deg]; nose first up, and tail first down, the nose is uphill."""
    uphill = C_L if (direction == "up") == (facing == "nose-first") else L - C_L
    return degrees(atan2(L - p - uphill, C_N)), degrees(atan2(p - uphill, C_N))


# Tipping on the flight


@pytest.mark.parametrize(("p", "sup"), [(150, 60.205), (180, 52.936), (200, 46.185), (220, 37.255)])
def test_the_papers_limits_are_the_default_models(p, sup):
    """Paper prints 60.2 at 150 mm; the others by hand, to three places."""
    answer = assess(KENAF, at(30, p / 1e3), **SURE)
    assert answer.findings["tip_downhill"].margin + 30 == pytest.approx(sup, abs=5e-4)
    assert limits(p, "up", "nose-first")[0] == pytest.approx(sup, abs=5e-4)


@pytest.mark.parametrize(("direction", "facing"), WAYS)
@pytest.mark.parametrize("p", [120, 150, 180])
@pytest.mark.parametrize("angle", [20, 30])
def test_tip_margins_either_way(direction, facing, p, angle):
    answer = assess(KENAF, at(angle, p / 1e3), **SURE, direction=direction, facing=facing)
    steepest, gentlest = limits(p, direction, facing)
    margins = answer.margins_deg
    assert answer.contact.grades.arrested
    assert margins["tip_downhill"] == pytest.approx(steepest - angle, abs=DEGREE)
    assert margins["tip_uphill"] == pytest.approx(angle - gentlest, abs=DEGREE)
    holds = gentlest < angle < steepest
    assert answer.contact.grades.no_rotation == holds
    centroid = min(
        470 - p - _uphill(direction, facing) - 71 * tan(radians(angle)),
        _uphill(direction, facing) - p + 71 * tan(radians(angle)),
    )
    assert answer.contact.margin_centroid_mm == pytest.approx(centroid, abs=1e-4)


def _uphill(direction, facing):
    return 196 if (direction == "up") == (facing == "nose-first") else 470 - 196


@pytest.mark.parametrize(("direction", "facing"), WAYS)
@pytest.mark.parametrize("acceleration", [-0.6, -0.2, 0.2, 0.6])
def test_tip_margins_under_an_acceleration(direction, facing, acceleration):
    """At the limit gravity and inertia pass through the contact that stays.

    x cos(theta) = C_N (sin(theta) + a/g), x from the centroid down to it: solved by halving.
    """
    robot = round_robot(C_N=0.05)
    answer = assess(
        robot,
        at(30, 0.120),
        **SURE,
        direction=direction,
        facing=facing,
        acceleration=acceleration,
    )
    x = 0.5 - 0.12 - 0.25
    low, high = 0.0, math.pi / 2
    for _ in range(60):
        theta = (low + high) / 2
        holds = x * cos(theta) > 0.05 * (sin(theta) + acceleration / G)
        low, high = (theta, high) if holds else (low, theta)
    on_flight = traverse_of(answer.question).criterion.smallest(downhill=True)
    assert degrees(on_flight.margin) == pytest.approx(degrees(low) - 30, abs=DEGREE)
    assert answer.question.acceleration == acceleration
    # entering and landing the path is gentler, and the same acceleration tilts gravity further
    tip = answer.findings["tip_downhill"]
    if tip.phase == "traverse":
        assert tip.margin == pytest.approx(degrees(low) - 30, abs=DEGREE)
    else:
        assert degrees(low) - 33 < tip.margin < degrees(low) - 30


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize(
    ("theta_d", "theta_M"), [(None, None), (1.0, None), (None, 1.0), (0.5, 2.0), (0.0, 0.0)]
)
def test_allowances_are_subtracted(direction, theta_d, theta_M):
    """2.6 deg each unless measured; theta_M is zero going down without a figure, and off the
    downhill end alone."""
    measured = {
        name: None if value is None else radians(value)
        for name, value in (("theta_d", theta_d), ("theta_M", theta_M))
    }
    facing = "nose-first" if direction == "up" else "tail-first"
    answer = assess(KENAF, at(30), friction=3.0, direction=direction, facing=facing, **measured)
    d = 2.6 if theta_d is None else theta_d
    M = (2.6 if direction == "up" else 0.0) if theta_M is None else theta_M
    steepest, gentlest = limits(150, direction, facing)
    down, up = answer.findings["tip_downhill"], answer.findings["tip_uphill"]
    assert down.margin == pytest.approx(steepest - 30 - d - M, abs=DEGREE)
    assert up.margin == pytest.approx(30 - gentlest - d, abs=DEGREE)
    of_d = 0.0 if theta_d is None else d
    of_M = 0.0 if theta_M is None else M
    assert down.margin_best == pytest.approx(steepest - 30 - of_d - of_M, abs=DEGREE)
    assert up.margin_best == pytest.approx(30 - gentlest - of_d, abs=DEGREE)


@pytest.mark.parametrize("friction", [0.95, 1.0, 1.2, 1.5, (0.9, 1.2)])
def test_friction_margin_on_the_flight(friction):
    """Up 50 deg tan(50) = 1.19 is required: more than the 0.91 of entering."""
    answer = assess(KENAF, at(50), friction=friction, **BARE)
    low, high = friction if isinstance(friction, tuple) else (friction, friction)
    assert answer.required_friction == pytest.approx(tan(radians(50)), abs=1e-9)
    slides = answer.findings["slides_down"]
    assert slides.margin == pytest.approx(degrees(atan(low)) - 50, abs=DEGREE)
    assert slides.margin_best == pytest.approx(degrees(atan(high)) - 50, abs=DEGREE)
    assert answer.friction == (low, high)
    tips = limits(150, "up", "nose-first")[0] - 50
    assert answer.margin_deg == pytest.approx(min(tips, slides.margin), abs=DEGREE)
    assert answer.margin_best_deg == pytest.approx(min(tips, slides.margin_best), abs=DEGREE)


# Ramps and floors: friction and traction


def ramp(angle, length=3.0):
    x, z = length * cos(radians(angle)), length * sin(radians(angle))
    return Profile.of_points([(-3, 0), (0, 0), (x, z), (x + 3, z)])


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("angle", [3, 10, 20, 30])
def test_a_ramp_requires_its_slope(angle, direction, facing):
    """The track lies on it: tan(slope) wherever the load is, nothing from any step."""
    answer = assess(
        round_robot(), ramp(angle), friction=2.0, direction=direction, facing=facing, **BARE
    )
    assert answer.required_friction == pytest.approx(tan(radians(angle)), abs=1e-9)
    assert answer.contact.traction_N == pytest.approx(20 * G * sin(radians(angle)), rel=1e-9)
    slides = degrees(atan(2.0)) - angle
    assert answer.findings["slides_down"].margin == pytest.approx(slides, abs=DEGREE)
    if direction == "down" or angle > 5:  # up less than 5 deg the crest holds little energy
        assert (answer.verdict, answer.governs) == ("go", "slides_down")
    assert (answer.angle_deg, answer.nosing_spacing_m) == (None, None)
    # the rear tip of the flat lies 250 mm behind the centroid, 100 mm below it
    tip = answer.findings["tip_downhill"]
    assert tip.margin == pytest.approx(degrees(atan2(250, 100)) - angle, abs=DEGREE)


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("acceleration", [0.5, 1.5])
def test_a_ramp_under_an_acceleration(direction, acceleration):
    """By hand: tan(20) + a / (g cos(20)), up the ramp."""
    robot = round_robot(C_N=0.05)
    answer = assess(robot, ramp(20), **SURE, direction=direction, acceleration=acceleration)
    required = tan(radians(20)) + acceleration / (G * cos(radians(20)))
    assert answer.required_friction == pytest.approx(required, abs=1e-9)


@pytest.mark.parametrize("acceleration", [-4.0, -1.0, 0.0, 1.0, 4.0])
def test_a_gentle_ramp_and_its_landings_require_what_accelerates(acceleration):
    """By hand: of the ramp, as above, and of its landings, |a| / g, the larger."""
    answer = assess(round_robot(C_N=0.05), ramp(1), **SURE, acceleration=acceleration)
    on_ramp = tan(radians(1)) + acceleration / (G * cos(radians(1)))
    required = max(abs(on_ramp), abs(acceleration) / G)
    assert answer.required_friction == pytest.approx(required, abs=1e-9)
    key = "slides_up" if acceleration < 0 else "slides_down"
    expected = degrees(atan(3.0) - atan(required))
    assert answer.findings[key].margin == pytest.approx(expected, abs=DEGREE)
    assert answer.verdict == "go"


@pytest.mark.parametrize("speed", [0.05, 0.2])
@pytest.mark.parametrize("resistance", [0.0, 0.1])
def test_traction_and_power_on_a_ramp(speed, resistance):
    """F = m g (sin(slope) + c_rr), counted on the weight; P = F v / eta."""
    drive = Drive(rolling_resistance=resistance, efficiency=0.8, max_speed=1.0)
    answer = assess(round_robot(drive=drive), ramp(15), **SURE, speed=speed)
    force = 20 * G * (sin(radians(15)) + resistance)
    assert answer.contact.traction_N == pytest.approx(force, rel=1e-9)
    assert answer.contact.power_W == pytest.approx(force * speed / 0.8, rel=1e-9)
    down = assess(round_robot(drive=drive), ramp(15), **SURE, speed=speed, direction="down")
    assert down.contact.power_W is None


@pytest.mark.parametrize(("power", "speed"), [(50.0, 0.5), (50.0, 1.0), (100.0, 1.0)])
def test_power_limits_the_traction_going_up(power, speed):
    """By hand: P eta / v against m g sin(slope)."""
    drive = Drive(max_power=power, efficiency=0.8, max_speed=1.0)
    answer = assess(round_robot(drive=drive), ramp(20), **SURE, speed=speed)
    spare = degrees(math.asin(power * 0.8 / speed / (20 * G))) - 20
    assert answer.findings["drive"].margin == pytest.approx(spare, abs=DEGREE)
    assert (answer.verdict == "no-go") == (spare <= 0)
    down = assess(round_robot(drive=drive), ramp(20), **SURE, speed=speed, direction="down")
    assert down.findings["drive"].margin is None


def test_a_mass_that_nobody_published_gives_no_force():
    answer = assess(KENAF, at(40), **SURE)
    assert (answer.contact.traction_N, answer.contact.power_W) == (None, None)
    assert answer.margin_force_N is None
    assert answer.findings["drive"].holds is None


# Payload


@pytest.mark.parametrize(
    ("mass", "from_front", "height"),
    [(5.0, 0.10, 0.20), (5.0, 0.40, 0.20), (10.0, 0.25, 0.05), (2.0, 0.25, 0.10), (20.0, 0.2, 0.1)],
)
def test_a_payload_moves_the_limits(mass, from_front, height):
    load = Payload(mass=mass, from_front=from_front, height=height)
    answer = assess(round_robot(), at(25, 0.120), **SURE, payload=load)
    C_L = (20 * 0.25 + mass * from_front) / (20 + mass)
    C_N = (20 * 0.10 + mass * height) / (20 + mass)
    assert answer.com_from_front_m == pytest.approx(C_L, rel=1e-12)
    assert answer.com_height_m == pytest.approx(C_N, rel=1e-12)
    assert answer.mass_kg == 20 + mass
    expected = degrees(atan2(0.5 - 0.12 - C_L, C_N)) - 25
    assert answer.findings["tip_downhill"].margin == pytest.approx(expected, abs=DEGREE)


# Uncertain inputs: a margin at a risk is its quantile


def quantile(risk):
    return NormalDist().inv_cdf(1 - risk)


@pytest.mark.parametrize("risk", [0.01, 0.1, 0.3])
def test_uncertain_friction(risk):
    """By hand: mu is 1.5 by 0.05; 2048 samples err by some hundredths of sigma at 1 %."""
    surface = Surface.of_friction(1.5, uncertainty=0.05)
    answer = assess(KENAF, at(50), surface=surface, **BARE, risk=risk)
    slides = answer.findings["slides_down"]
    expected = degrees(atan(1.5 - quantile(risk) * 0.05)) - 50
    assert slides.margin == pytest.approx(expected, abs=0.03)
    assert slides.probability == pytest.approx(
        NormalDist(1.5, 0.05).cdf(tan(radians(50))), abs=1 / 2048
    )
    assert answer.findings["tip_downhill"].probability == 0.0


@pytest.mark.parametrize("sigma", [0.5, 1.0, 3.0])
@pytest.mark.parametrize("angle", [50, 57, 59])
def test_an_uncertain_slope_goes_off_every_margin_of_slope(angle, sigma):
    stairs = at(angle).model_copy(update={"uncertainty": StairsUncertainty(angle=radians(sigma))})
    answer = assess(KENAF, stairs, friction=4.0, **BARE)
    off = quantile(0.01) * sigma
    tips, slides = answer.findings["tip_downhill"], answer.findings["slides_down"]
    # deg: neighbouring samples at 1 % lie 0.03 sigma apart
    assert tips.margin == pytest.approx(60.2054 - angle - off, abs=0.05 * sigma + 1e-3)
    required = degrees(atan(answer.required_friction))
    assert slides.margin == pytest.approx(degrees(atan(4.0)) - required - off, abs=0.05 * sigma)
    chance = 1 - NormalDist(angle, sigma).cdf(60.2054)
    assert tips.probability == pytest.approx(chance, abs=1 / 1024)
    assert answer.failure_probability == pytest.approx(chance, abs=1 / 1024)
    low, high = answer.margin_interval_deg
    assert high - low == pytest.approx(2 * 1.96 * sigma, rel=0.02)


@pytest.mark.parametrize(("risk", "verdict"), [(0.5, "go"), (0.05, "go"), (0.001, "rough")])
def test_the_accepted_risk_decides(risk, verdict):
    """By hand: 60.205 deg at 57 deg, known to 1.5 deg: 1.6 % tip, and are arrested."""
    stairs = at(57).model_copy(update={"uncertainty": StairsUncertainty(angle=radians(1.5))})
    answer = assess(KENAF, stairs, friction=4.0, **BARE, risk=risk, speed=0.01, fall_reserve=0.0)
    assert answer.findings["tip_downhill"].probability == pytest.approx(0.0163, abs=1e-3)
    assert answer.verdict == verdict
    assert (answer.margin_deg > 0) == (answer.failure_probability <= risk)


def test_doubts_of_the_robot_move_a_profile_too():
    """The same flight as points: slopes of the criterion, to first order."""
    doubts = Uncertainty(com_from_front=0.002, com_height=0.001, flat_length=0.001)
    robot = KENAF.model_copy(update={"uncertainty": doubts})
    flight = assess(robot, at(50), friction=4.0, **BARE)
    profile = assess(robot, Profile.of_stairs(at(50)), friction=4.0, **BARE)
    for key in ("tip_downhill", "tip_uphill"):
        mine, theirs = profile.findings[key], flight.findings[key]
        # deg: the second order of 2.3 sigma = 2.6 deg, (0.046 rad)^2
        assert mine.margin == pytest.approx(theirs.margin, abs=0.12)


# Several flights


LOW = Stairs(name="low", rise=0.07, going=0.20, steps=9, upper_landing=3.0)
STEEP = Stairs(name="steep", rise=0.13, going=0.15, steps=8, upper_landing=3.0)
"""40.9 deg."""


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("friction", [0.7, 0.95, 1.5])
@pytest.mark.parametrize("order", [(LOW, STEEP), (STEEP, LOW), (LOW, LOW), (STEEP, STEEP)])
def test_several_flights_are_as_bad_as_the_worst(direction, friction, order):
    asked = {"friction": friction, "direction": direction, **BARE}
    whole = assess(KENAF, list(order), **asked)
    each = [assess(KENAF, flight, **asked) for flight in order]
    assert Verdict(whole.verdict).rank == max(Verdict(one.verdict).rank for one in each)
    assert whole.margin_deg == pytest.approx(min(one.margin_deg for one in each), abs=DEGREE)
    assert whole.required_friction == pytest.approx(
        max(one.required_friction for one in each), abs=1e-6
    )
    for key in ("tip_downhill", "tip_uphill", "slides_down"):
        smallest = min(one.findings[key].margin for one in each)
        assert whole.findings[key].margin == pytest.approx(smallest, abs=DEGREE)


# Phases alone


def of_phase(question, phase=None):
    found = judge(question)
    return conclude(question, findings_of(question, found.basis, phase=phase))


PHASED = {
    "dry steps, flippers flat": Question.in_one_posture(
        "absolem", "ibc", flippers="flat", friction=0.8
    ),
    "steep": Question.in_one_posture(KENAF, at(50), **SURE),
    "rotates": Question.in_one_posture(KENAF, at(61.5), **SURE),
    "little energy": Question.in_one_posture(KENAF, at(44, p=0.200), **SURE),
    "falls entering": Question.in_one_posture(KENAF, at(70), **SURE),
    "falls landing": Question.in_one_posture(
        KENAF, Profile.of_points([(-3, 0), (0, 0), (0, 0.3), (3, 0.3)]), **SURE
    ),
    "down": Question.in_one_posture(KENAF, at(30), **SURE, direction="down"),
    "slips on the flight": Question.in_one_posture(KENAF, at(50), friction=1.1, **BARE),
}


@pytest.mark.parametrize(
    ("name", "enter", "traverse", "land"),
    [
        ("dry steps, flippers flat", ("no-go", "slides_down"), ("go", "slides_down"),
         ("rough", "impact")),
        ("steep", ("go", "slides_down"), ("go", "tip_downhill"), ("go", "tip_downhill")),
        ("rotates", ("go", "tip_downhill"), ("no-go", "fall_downhill"),
         ("unsure", "tip_downhill")),
        ("little energy", ("go", "slides_down"), ("unsure", "energy"), ("unsure", "energy")),
        ("falls entering", ("no-go", "fall_downhill"), None, None),
        ("falls landing", ("go", "slides_down"), None, ("no-go", "fall_downhill")),
        ("slips on the flight", ("go", "slides_down"), ("no-go", "slides_down"),
         ("no-go", "slides_down")),
    ],
)  # fmt: skip
def test_a_phase_has_its_own_verdict(name, enter, traverse, land):
    question = PHASED[name]
    driven = {each.phase for each in judge(question).basis.traverse.phases}
    for phase, expected in zip(Phase, (enter, traverse, land), strict=True):
        assert (phase in driven) == (expected is not None)
        if expected is not None:
            found = of_phase(question, phase)
            assert (found.verdict, found.governs) == expected
            assert found.phase in (None, phase)


@pytest.mark.parametrize("name", PHASED)
def test_the_whole_is_as_bad_as_its_worst_phase(name):
    question = PHASED[name]
    driven = [each.phase for each in judge(question).basis.traverse.phases]
    whole = of_phase(question)
    each = [of_phase(question, phase) for phase in driven]
    assert whole.verdict.rank == max(one.verdict.rank for one in each)
    known = [one.margin for one in each if not math.isnan(one.margin)]
    assert whole.margin == pytest.approx(min(known), abs=1e-12)


# A rotation that is arrested


@pytest.mark.parametrize("angle", [56, 58, 59])
def test_an_arrested_rotation_is_rough_as_long_as_the_reserve_to_a_fall_is_kept(angle):
    """60.2 less 5.2 deg: past 55 deg the criterion holds by its best case alone.

    Less than 8 deg are left to the fall.
    """
    asked = {"friction": 3.0, "speed": 0.01}
    answer = assess(KENAF, at(angle), **asked, fall_reserve=0.0)
    assert (answer.verdict, answer.governs) == ("rough", "tip_downhill")
    assert answer.findings["fall_downhill"].margin > 0
    assert answer.findings["tip_downhill"].holds is False
    assert answer.notes[0].startswith("Secure payload, arm and antennas: it rocks.")
    kept = assess(KENAF, at(angle), **asked)
    assert (kept.verdict, kept.governs) == ("unsure", "fall_downhill")


@pytest.mark.parametrize("angle", [65, 70])
def test_a_fall_is_no_rotation_that_is_arrested(angle):
    answer = assess(KENAF, at(angle), **SURE)
    assert (answer.verdict, answer.governs) == ("no-go", "fall_downhill")


def test_what_only_an_impact_holds_is_not_rough():
    """Off an edge of 200 mm Kenaf holds only because the impact takes momentum."""
    edge = Profile.of_points([(-3, 0), (0, 0), (0, 0.2), (3, 0.2)])
    answer = assess(KENAF, edge, **SURE, direction="down")
    assert (answer.verdict, answer.governs) == ("unsure", "momentum")
    assert answer.findings["momentum"].holds_best


def test_an_arrested_rotation_still_needs_friction():
    answer = assess(KENAF, at(58), friction=1.0, **BARE)
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")
    unknown = assess(KENAF, at(58), speed=0.01, fall_reserve=0.0)
    assert (unknown.verdict, unknown.governs) == ("unsure", "friction_unknown")


# The two grades of the paper's rig, by the default model


@pytest.mark.parametrize(
    ("p", "grade_two"), [(150, 62.48), (180, 57.70), (200, 53.85), (220, 49.31)]
)
def test_the_rotation_is_arrested_up_to_grade_two(p, grade_two):
    """docs/theory/contact.md, to 0.01 deg: the robot on the flight alone, extra turn 45 deg."""
    sup = limits(p, "up", "nose-first")[0]
    answer = assess(KENAF, at(grade_two - 0.02, p / 1e3), **SURE, fall_reserve=0.0)
    assert answer.verdict == "rough"
    grades = answer.contact.grades
    assert (grades.no_rotation, grades.arrested) == (False, True)
    assert answer.findings["tip_downhill"].margin == pytest.approx(
        sup - grade_two + 0.02, abs=DEGREE
    )


# The default answers and says so


def test_the_default_is_the_contact_model():
    assert assess(KENAF, at(40), friction=2.0) == assess(
        KENAF, at(40), friction=2.0, model="contact"
    )
    question = Question.in_one_posture(KENAF, at(40), friction=2.0)
    assert answer_to(question, advice=False).model == "contact"
