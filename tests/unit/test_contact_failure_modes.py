"""Each failure mode governs an answer of the contact model in a case made for it.

Every margin is worked out beside its case, by hand (`math` alone): the robots are of round figures,
or Kenaf of the paper (L 470, C_L 196, C_N 71, end radius 65 mm).
"""

import math
from dataclasses import replace
from math import atan, atan2, cos, degrees, hypot, radians, sin, sqrt, tan

import pytest

from kaidan import Assessment, Profile, Question, Robot, Stairs
from kaidan.assessment import judged
from kaidan.contact import Status
from kaidan.models.quasi_static import Basis, findings_of, traverse_of
from kaidan.modes import FAILURE_MODES, Phase
from kaidan.robot import Drive, Track
from one_posture import assess

G = 9.80665
KENAF = Robot.named("kenaf")
UNMEASURED = KENAF.model_copy(update={"theta_d": None, "theta_M": None})
SURE = {"friction": 2.5, "theta_d": 0.0, "theta_M": 0.0}
"""No range: friction never decides below 68 deg."""
DEGREE = 1e-6
"""A pose is settled to 1e-9 m on 0.1 m [deg]."""


def robot(*, drive=None, impact=None, inertia=None, com=(0.25, 0.1), **track):
    """20 kg, L 500 mm, centroid in its middle, 100 mm high, end radius 60 mm."""
    C_L, C_N = com
    sheet = {"flat_length": 0.5, "front_radius": 0.06, "rear_radius": 0.06} | track
    return Robot(
        name="round",
        mass=20.0,
        com_from_front=C_L,
        com_height=C_N,
        inertia=inertia,
        max_impact_speed=impact,
        drive=drive or Drive(),
        track=Track(**sheet),
    )


def at(angle, p=0.150, steps=8, **more):
    flight = Stairs.inclined(angle=radians(angle), nosing_spacing=p, steps=steps)
    return flight.model_copy(update={"upper_landing": 5.0, "lower_landing": 5.0} | more)


def kerb(height):
    return Profile.of_points([(-3, 0), (0, 0), (0, height), (3, height)])


def ramp(angle):
    x, z = 3 * cos(radians(angle)), 3 * sin(radians(angle))
    return Profile.of_points([(-3, 0), (0, 0), (x, z), (x + 3, z)])


HOLE = Profile.of_points([(-3, 0), (0, 0), (0, -2), (0.6, -2), (0.6, 0), (4, 0)])
DITCH = Profile.of_points([(-3, 0), (0, 0), (0, -0.05), (0.4, -0.05), (0.4, 0), (4, 0)])
NARROW = Robot(
    name="narrow",
    com_from_front=0.8,
    com_height=0.3,
    max_impact_speed=10.0,
    track=Track(flat_length=2.0, front_radius=0.1, rear_radius=0.1, gauge=0.3),
)


def sup(p, C_L=196, C_N=71, L=470):
    """Paper, Eq. (12): the steepest slope [deg], lengths in millimetres."""
    return degrees(atan2(L - p - C_L, C_N))


def inf(p, C_L=196, C_N=71):
    """The gentlest slope [deg]."""
    return degrees(atan2(p - C_L, C_N))


def rise(x, theta, C_N=71):
    """Rise of the centroid to stand over a contact x behind it on a slope [mm]."""
    return hypot(x, C_N) - (x * sin(radians(theta)) + C_N * cos(radians(theta)))


SUDDEN = 0.071**2 / (0.071**2 + (0.6**2 + 0.142**2) / 24)
"""What a sudden stop leaves to a rotation: centroid 71 mm above the belt, half the inertia of an
even box of 600 by 142 mm, since none is stated."""
ROCK = SUDDEN * 1e3 * 0.1**2 / (2 * G)
"""Energy threshold of the paper's 0.1 m/s [mm]."""
FRICTION = "Friction decides"

CASES = {
    # name: (what is assessed, verdict, governs, phase, step, margin of what governs, sentence)
    "slides_down on the flight": (
        (KENAF, at(50), SURE | {"friction": 1.1}),
        ("no-go", "slides_down", "traverse"),
        degrees(atan(1.1)) - 50,
        "Friction decides (traverse, step 3): 1.19 is required, 1.10 is stated.",
    ),
    "slides_down at the first riser": (
        # sole on the landing, nose on the riser: see test_a_riser_higher_than_the_nose
        (KENAF, at(30), SURE | {"friction": 0.8}),
        ("no-go", "slides_down", "enter"),
        degrees(atan(0.8) - atan(0.9076194)),
        "Friction decides (enter, step 1): 0.91 is required, 0.80 is stated.",
    ),
    "slides_down by the range of friction": (
        (KENAF, at(50), SURE | {"friction": (1.1, 1.3)}),
        ("unsure", "slides_down", "traverse"),
        degrees(atan(1.1)) - 50,
        "Friction decides (traverse, step 3): 1.19 is required, 1.10 to 1.30 is stated.",
    ),
    "slides_up, braking before a ramp": (
        # on the landing a/g = 0.306; on the ramp |tan 2 - 3 / (g cos 2)| = 0.271
        (robot(), ramp(2), SURE | {"friction": 0.3, "acceleration": -3.0}),
        ("no-go", "slides_up", "enter"),
        degrees(atan(0.3) - atan(3.0 / G)),
        "Friction decides (enter, step 0): 0.31 is required, 0.30 is stated.",
    ),
    "slides_up, braking before stairs": (
        # on the landing a/g = 0.816; on the flight |tan 20 - 8 / (g cos 20)| = 0.504
        (robot(com=(0.25, 0.05)), at(20, p=0.1), SURE | {"friction": 0.5, "acceleration": -8.0}),
        ("no-go", "slides_up", "enter"),
        degrees(atan(0.5) - atan(8.0 / G)),
        "Friction decides (enter, step 0): 0.82 is required, 0.50 is stated.",
    ),
    "drive on a ramp": (
        (robot(drive=Drive(max_traction=100.0)), ramp(40), SURE),
        ("no-go", "drive", None),
        degrees(math.asin(100 / (20 * G))) - 40,
        "The drive's traction is enough only for a slope 9.3 deg gentler.",
    ),
    "drive on a ramp, rolling resistance included": (
        (robot(drive=Drive(max_traction=100.0, rolling_resistance=0.1)), ramp(30), SURE),
        ("no-go", "drive", None),
        degrees(math.asin(100 / (20 * G) - 0.1)) - 30,
        "The drive's traction is enough only for a slope 5.8 deg gentler.",
    ),
    "drive, a nose pulled straight up a riser": (
        # the path of the centroid stands upright there: the whole weight
        (robot(drive=Drive(max_traction=100.0)), at(40), SURE),
        ("no-go", "drive", None),
        degrees(math.asin(100 / (20 * G))) - 90,
        "The drive's traction is enough only for a slope 59.3 deg gentler.",
    ),
    "fall_downhill, a fall that the criterion foresees": (
        (KENAF, at(70), SURE),
        ("no-go", "fall_downhill", "enter"),
        None,
        "It falls over its downhill end (enter, step 1).",
    ),
    "fall_downhill, a fall without a flight": (
        (KENAF, kerb(0.3), SURE),
        ("no-go", "fall_downhill", "land"),
        None,
        "It falls over its downhill end (land, step 1).",
    ),
    "fall_downhill, too little reserve": (
        # tests/agreement/test_tilted_gravity.py has the tilt by brute force
        (KENAF, at(57.5), {"friction": 2.5, "fall_reserve": radians(12.0)}),
        ("no-go", "fall_downhill", "land"),
        None,
        "It rocks, and is 5.1 deg from falling over its downhill end (land, step 8): expect a "
        "fall, because 12.0 deg of reserve must be kept.",
    ),
    "tip_downhill, arrested by the next nosing": (
        (KENAF, at(61.5), SURE | {"speed": 0.001, "fall_reserve": radians(0.5)}),
        ("rough", "tip_downhill", "traverse"),
        sup(150) - 61.5,
        "It rocks by 0.2 deg until the next contact arrests it (traverse, step 1), 1.1 deg from "
        "falling.",
    ),
    "tip_downhill, by the allowances": (
        (UNMEASURED, at(57), {"friction": 2.5, "fall_reserve": 0.0, "speed": 0.001}),
        ("rough", "tip_downhill", "traverse"),
        sup(150) - 57 - 5.2,
        "The margin against tipping over its downhill end is -2.0 to +3.2 deg, by the ranges of "
        "what is not measured (traverse, step 1), 5.6 deg from falling.",
    ),
    "tip_uphill, the nose drops between nosings": (
        (KENAF, at(15, p=0.220), SURE),
        ("rough", "tip_uphill", "traverse"),
        15 - inf(220),
        "It rocks by 0.05 deg until the next contact arrests it (traverse, step 8), more than 30 "
        "deg from falling.",
    ),
    "tip_uphill, by the allowances": (
        (UNMEASURED, at(20, p=0.220), {"friction": 2.5, "speed": 0.001}),
        ("rough", "tip_uphill", "traverse"),
        20 - inf(220) - 2.6,
        "The margin against tipping over its uphill end is -1.3 to +1.3 deg, by the ranges of what "
        "is not measured (traverse, step 8), more than 30 deg from falling.",
    ),
    "tip_sideways at a yaw": (
        # tan(limit) sin(yaw) = gauge / (2 C_N) = 0.5
        (NARROW, at(45, steps=20), SURE | {"yaw": radians(31), "speed": 0.001}),
        ("no-go", "tip_sideways", "traverse"),
        degrees(atan(0.5 / sin(radians(31)))) - 45,
        "It tips over its side, 0.8 deg beyond the limit (traverse).",
    ),
    "rotation that a longer robot would be spared": (
        # a ditch of 400 mm under a flat of 470 mm: see test_rotations for the angle
        (KENAF, DITCH, SURE | {"friction": 3.0, "uniform_across": True}),
        ("rough", "rotation", "enter"),
        None,
        "It rocks by 14.2 deg until the next contact arrests it (enter, step 0), more than 30 deg "
        "from falling.",
    ),
    "fall_uphill, into a hole": (
        (robot(), HOLE, SURE),
        ("no-go", "fall_uphill", "enter"),
        None,
        "It falls over its uphill end (enter, step 0).",
    ),
    "tip_downhill, fewer than two nosings under the track": (
        (robot(), at(15, p=0.3), SURE),
        ("rough", "tip_downhill", "traverse"),
        sup(300, C_L=250, C_N=100, L=500) - 15,
        "It rocks by 5.6 deg until the next contact arrests it (traverse, step 1), 18.4 deg from "
        "falling.",
    ),
    "momentum, off a kerb": (
        # docs: the centroid drops by 34.6 mm, 24.7 mm are left to climb
        (KENAF, kerb(0.2), SURE | {"direction": "down"}),
        ("unsure", "momentum", "enter"),
        None,
        "Only the impact that ends its rotation takes enough momentum to hold it (enter, step 1).",
    ),
    "impact on the upper landing": (
        (robot(impact=1.0), at(40, p=0.12), SURE),
        ("rough", "impact", "land"),
        None,
        "It drops and hits at 1.1 m/s (land, step 8); 1.0 m/s are tolerated.",
    ),
    "energy on the flight": (
        (KENAF, at(44, p=0.200), SURE),
        ("unsure", "energy", "traverse"),
        rise(470 - 200 - 196, 44) - ROCK,
        "The energy margin of 0.07 mm is below the 0.12 mm of a sudden stop or start: the robot "
        "may rock (traverse, step 1).",
    ),
    "high_centring on a kerb": (
        (robot(gap=0.2, belly_clearance=0.02), kerb(0.1), SURE),
        ("rough", "high_centring", "land"),
        None,
        "It rests on its belly in places (land), where the tracks may lose grip.",
    ),
    "landing_room": (
        (KENAF, at(50, upper_landing=0.3), SURE),
        ("unsure", "landing_room", None),
        300 - (470 + 2 * 65),
        "A landing is 300 mm shorter than the robot.",
    ),
}


@pytest.fixture(scope="module")
def answers():
    return {name: assess(*asked[:2], **asked[2]) for name, (asked, *_) in CASES.items()}


@pytest.mark.parametrize("name", CASES)
def test_the_mode_governs(name, answers):
    _, (verdict, governs, phase), margin, sentence = CASES[name]
    answer = answers[name]
    assert (answer.verdict, answer.governs, answer.phase) == (verdict, governs, phase)
    assert answer.reason == sentence
    finding = answer.findings[governs]
    assert finding.holds is False
    assert finding.phase == answer.phase
    assert finding.step == answer.step
    assert finding.label == FAILURE_MODES[governs].label
    if margin is not None:
        # deg or mm; entering friction is given to seven places
        assert finding.margin == pytest.approx(margin, abs=1e-5)


@pytest.mark.parametrize("name", CASES)
def test_its_doubts_are_what_fails(name, answers):
    answer = answers[name]
    failing = {key for key, one in answer.findings.items() if one.holds is False}
    assert set(answer.doubts) == failing
    # of the two margins of a robot that rocks the tilt to the first rock is never the larger
    first = next(key for key in answer.doubts if key == answer.governs or "tip" not in key)
    assert first == answer.governs
    assert answer.exit_code == {"rough": 4, "unsure": 5, "no-go": 1}[answer.verdict]


@pytest.mark.parametrize("name", CASES)
def test_it_says_which_model_it_is_from_and_no_other(name, answers):
    answer = answers[name]
    assert answer.model == "contact"
    assert answer.closed_form is answer.physics is None
    of = {one.model for one in answer.findings.values()}
    assert of == ({"contact", "support-polygon"} if answer.question.yaw else {"contact"})
    for own_to_the_closed_form in ("a_max_safe", "area", "lower_angle_deg", "paper"):
        assert f'"{own_to_the_closed_form}"' not in answer.to_json()


@pytest.mark.parametrize("name", CASES)
def test_it_is_read_back_equal(name, answers):
    answer = answers[name]
    assert Assessment.from_json(answer.to_json()) == answer
    assert assess(answer.question) == answer


def test_a_robot_that_falls_neither_arrives_nor_is_so_far_from_falling(answers):
    """Its notes tell the criterion's margin alone; of a fall that no tilt prevents too."""
    answer = answers["fall_downhill, a fall that the criterion foresees"]
    limit = 70 - sup(150)
    assert (
        f"By the criterion it tips over its downhill end, {limit:.1f} deg beyond the limit "
        "(traverse, step 1)." in answer.notes
    )
    upright = assess(KENAF, "osha-ship", **SURE)
    assert upright.contact.tilt.to_fall_deg == -90.0
    for each in (*answer.notes, *upright.notes):
        assert "arrives" not in each
        assert "from falling" not in each


def test_every_mode_of_the_model_is_among_the_cases():
    governs = {governs for _, (_, governs, _), _, _ in CASES.values()}
    elsewhere = {"stuck", "posture_change", "flipper_torque", "posture_tolerance", "unweighed"}
    elsewhere |= {"narrow", "low"}  # of every model: test_clearance_findings.py
    elsewhere |= {"gap"}  # likewise, of sheets with gaps: test_gap_terrain.py
    elsewhere |= {"foot_unseen"}  # likewise, of scans: test_clearance_findings.py
    elsewhere |= {"gap_jam"}  # of driven trials: agreement/test_gap_in_physics.py
    elsewhere |= {"across"}  # of profiles: test_terrain.py
    elsewhere |= {"floor_finish"}  # likewise, of building models: test_clearance_findings.py
    elsewhere |= {"grouser_speed"}  # of driven grousers: test_traction.py
    elsewhere |= {"turning"}  # likewise: test_landing_turns.py
    elsewhere |= {"twist"}  # likewise: test_twisted_flights.py
    assert governs | elsewhere == set(FAILURE_MODES)


# Stuck: no terrain of these shapes wedges a robot without an acceleration, so its end is made


def stuck(acceleration):
    question = Question.in_one_posture(KENAF, at(40), **SURE, acceleration=acceleration)
    traverse = replace(traverse_of(question), status=Status.STUCK)
    return judged(question, findings_of(question, Basis(question, traverse)))


def test_a_robot_that_gets_stuck_is_a_no_go():
    answer = stuck(0.0)
    assert (answer.verdict, answer.governs, answer.margin_deg) == ("no-go", "stuck", -90.0)
    assert answer.findings["stuck"].phase == answer.phase == "land"
    assert answer.falls_over is None
    assert answer.reason == (
        f"It gets stuck, wedged against a face or rocking on the spot (land, step {answer.step})."
    )
    # the flight's criterion holds, and is no fall
    assert answer.findings["tip_downhill"].margin == pytest.approx(sup(150) - 40, abs=DEGREE)


def test_rocking_under_an_acceleration_tells_of_the_model():
    answer = stuck(0.3)
    assert (answer.verdict, answer.governs) == ("outside-model", "outside_model")
    assert (answer.margin_deg, answer.findings, answer.contact) == (None, {}, None)


# Which end, either way


@pytest.mark.parametrize(
    ("direction", "facing", "end"),
    [
        ("up", "nose-first", "tail"),
        ("up", "tail-first", "nose"),
        ("down", "nose-first", "nose"),
        ("down", "tail-first", "tail"),
    ],
)
def test_the_end_that_it_falls_over(direction, facing, end):
    """By hand: sup = atan(100/100) = 45 deg whichever end leads; 60 deg is far past any arrest."""
    answer = assess(robot(), at(60), **SURE, direction=direction, facing=facing)
    assert (answer.verdict, answer.governs, answer.falls_over) == ("no-go", "fall_downhill", end)
    tip = answer.findings["tip_downhill"]
    assert tip.margin == pytest.approx(45 - 60, abs=DEGREE)


@pytest.mark.parametrize("direction", ["up", "down"])
def test_the_nose_falls_into_a_hole(direction):
    """600 mm wide and 2 m deep: the centroid passes its edge before the nose is across."""
    answer = assess(robot(), HOLE, **SURE, direction=direction)
    assert (answer.verdict, answer.falls_over) == ("no-go", "nose")
    assert answer.governs == ("fall_uphill" if direction == "up" else "fall_downhill")


# Entering: the nose on the face of a riser higher than its radius


def first_riser(L, C_L, R):
    """Friction by hand [1].

    Sole on the ground, carried at its rear end; nose against the face at the height R. Forces
    along: mu N1 = N2; up: N1 + mu N2 = W; moments about the rear contact:
    W (L - C_L) = N2 R + mu N2 (L + R). So (C_L + R) mu^2 + R mu - (L - C_L) = 0.
    """
    x, b = L - C_L, C_L + R
    return (-R + sqrt(R * R + 4 * b * x)) / (2 * b)


@pytest.mark.parametrize(
    ("name", "L", "C_L", "R"),
    [("kenaf", 0.470, 0.196, 0.065), ("absolem-flat", 1.141, 0.599, 0.029)],
)
@pytest.mark.parametrize("height", [0.12, 0.15])
def test_a_riser_higher_than_the_nose(name, L, C_L, R, height):
    answer = assess(name, Stairs(rise=height, going=0.28, steps=6), friction=3.0)
    enter = answer.contact.phases[0]
    assert enter.phase == "enter"
    assert enter.required_friction == pytest.approx(first_riser(L, C_L, R), abs=1e-9)
    assert enter.required_friction_step == 1


@pytest.mark.parametrize("C_L", [0.1, 0.15, 0.2, 0.25, 0.3])
def test_a_centroid_far_ahead_enters_with_less_friction(C_L):
    """The load is ahead: less of it has to be lifted by friction on the face."""
    answer = assess(robot(com=(C_L, 0.1)), kerb(0.1), **SURE)
    assert answer.contact.phases[0].required_friction == pytest.approx(
        first_riser(0.5, C_L, 0.06), abs=1e-9
    )


# What a mode depends on


@pytest.mark.parametrize(("tolerated", "verdict"), [(1.1, "rough"), (1.2, "go")])
def test_the_tolerated_impact_is_the_robots(tolerated, verdict):
    answer = assess(robot(impact=tolerated), at(40, p=0.12), **SURE)
    assert answer.verdict == verdict
    hits = max(each.impact_speed for each in answer.contact.rotations)
    assert answer.findings["impact"].margin == pytest.approx(tolerated - hits, abs=1e-12)
    assert answer.findings["impact"].unit == "m/s"


@pytest.mark.parametrize(("over_weight", "verdict"), [(0.99, "no-go"), (1.2, "go")])
def test_a_drive_that_lifts_the_robot_climbs_any_face(over_weight, verdict):
    """The path of the centroid stands upright at the first riser: that takes the weight."""
    drive = Drive(max_traction=over_weight * 20 * G)
    answer = assess(robot(drive=drive), at(40, p=0.12), **SURE)
    assert answer.verdict == verdict
    assert answer.findings["drive"].holds is (verdict == "go")
    # beyond the upright one radian a weight: 0.2 rad
    margin = math.asin(0.99) - math.pi / 2 if over_weight < 1 else 0.2
    assert answer.findings["drive"].margin == pytest.approx(degrees(margin), abs=1e-6)


def test_an_impact_by_hand():
    """Nose first off an edge of 120 mm, a radius of gyration of 150 mm.

    The robot turns about the edge when its centroid is over it, by phi: the axle of the nose
    250 mm ahead and 60 mm up goes down until 0.25 sin(phi) + 0.06 (1 - cos(phi)) = 0.12. The
    centroid drops by 0.1 (1 - cos(phi)); w^2 = 2 g drop / (0.15^2 + 0.1^2); the nose meets the
    ground 0.25 cos(phi) + 0.06 sin(phi) ahead of the edge.
    """
    low, high = 0.0, 1.0
    for _ in range(60):
        phi = (low + high) / 2
        below = 0.25 * sin(phi) + 0.06 * (1 - cos(phi)) < 0.12
        low, high = (phi, high) if below else (low, phi)
    drop = 0.1 * (1 - cos(phi))
    speed = sqrt(2 * G * drop / (0.15**2 + 0.1**2)) * hypot(0.25 * cos(phi) + 0.06 * sin(phi), 0.12)
    of_kind = robot(inertia=20 * 0.15**2, impact=1.0)
    answer = assess(of_kind, kerb(0.12), **SURE, direction="down")
    (one,) = answer.contact.rotations
    assert one.angle_deg == pytest.approx(degrees(phi), abs=1e-6)
    assert one.drop_mm == pytest.approx(1e3 * drop, abs=1e-6)
    assert one.impact_speed == pytest.approx(speed, rel=1e-6)
    assert answer.findings["impact"].margin == pytest.approx(1.0 - speed, abs=1e-6)
    assert one.obliged


@pytest.mark.parametrize("height", [0.10, 0.15, 0.19, 0.20, 0.21])
def test_off_a_kerb_the_momentum_decides(height):
    """By hand: Kenaf turns by phi about the edge until its nose is down.

    Its centroid, 71 mm over the edge, drops by 71 (1 - cos(phi)). To topple over the nose, which
    rolls, it has to rise to hypot(196, 71 - 65) above the axle. A sudden stop at 0.1 m/s adds to
    the drop.
    """
    phi = next(
        k * 1e-6
        for k in range(1, 1_570_000)
        if 0.196 * sin(k * 1e-6) + 0.065 * (1 - cos(k * 1e-6)) >= height
    )
    drop = 71 * (1 - cos(phi))
    left = 65 + hypot(196, 71 - 65) - (71 * cos(phi) + 1e3 * height)
    answer = assess(KENAF, kerb(height), **SURE, direction="down")
    drop += SUDDEN * 1e3 * 0.1**2 / (2 * G)
    assert answer.findings["momentum"].margin == pytest.approx(left - drop, abs=1e-3)  # mm
    if left > drop:
        assert answer.verdict == "go"
    else:
        assert (answer.verdict, answer.governs) == ("unsure", "momentum")


@pytest.mark.parametrize(("p", "angle"), [(0.150, 50), (0.180, 45), (0.200, 44), (0.220, 30)])
def test_energy_margin_on_the_flight(p, angle):
    """By hand: to stand over the lowest contact that stays, L - p - C_L behind the centroid."""
    answer = assess(KENAF, at(angle, p=p), **SURE)
    (traverse,) = (each for each in answer.contact.phases if each.phase == "traverse")
    expected = rise(470 - 1e3 * p - 196, angle)
    # mm: poses are settled to 1e-9 m
    assert traverse.energy_margin_mm == pytest.approx(expected, abs=1e-6)
    uphill = rise(196 - 1e3 * p, -angle)  # over the highest contact before the next is met
    least = min(expected, uphill) - ROCK
    assert answer.findings["energy"].margin <= least + 1e-6


@pytest.mark.parametrize("speed", [0.01, 0.04, 0.07, 0.08, 0.1, 0.3])
def test_energy_is_judged_at_the_speed(speed):
    """By hand: 0.0746 mm of energy margin are the sudden stop of 0.0779 m/s."""
    answer = assess(KENAF, at(44, p=0.200), **SURE, speed=speed)
    height = SUDDEN * 1e3 * speed**2 / (2 * G)
    assert answer.contact.energy_threshold_mm == pytest.approx(height, rel=1e-12)
    assert answer.contact.speed_stated
    assert answer.findings["energy"].margin == pytest.approx(rise(74, 44) - height, abs=1e-6)
    assert answer.verdict == ("go" if speed < 0.0779 else "unsure")


@pytest.mark.parametrize("yaw", [5, 10, 20, 29])
def test_sideways_margin_at_a_yaw(yaw):
    """By hand: tan(limit) sin(yaw) = gauge / (2 C_N) = 0.5."""
    answer = assess(NARROW, at(20, p=0.3, steps=20), **SURE, yaw=radians(yaw))
    expected = degrees(atan(0.5 / sin(radians(yaw)))) - 20
    assert answer.findings["tip_sideways"].margin == pytest.approx(expected, abs=DEGREE)
    mirrored = assess(NARROW, at(20, p=0.3, steps=20), **SURE, yaw=radians(-yaw))
    assert mirrored.findings["tip_sideways"].margin == pytest.approx(expected, abs=DEGREE)


@pytest.mark.parametrize("yaw", [5, 20, 30])
def test_friction_at_a_yaw_holds_across_too(yaw):
    """On the flight: up the heading and across it together ask for tan(theta), by hand."""
    answer = assess(NARROW, at(40, p=0.3, steps=20), **SURE, yaw=radians(yaw))
    assert answer.required_friction >= tan(radians(40)) - 1e-9


@pytest.mark.parametrize("room", [0.55, 0.59, 0.65])
@pytest.mark.parametrize("which", ["lower_landing", "upper_landing"])
def test_landing_room(room, which):
    """By hand: Kenaf is 470 + 2 x 65 mm long."""
    answer = assess(KENAF, at(50, **{which: room}), **SURE)
    assert answer.findings["landing_room"].margin == pytest.approx(1e3 * room - 600, abs=1e-6)
    assert ("landing_room" in answer.doubts) == (room < 0.6)


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize(("end", "other"), [("lower", "upper"), ("upper", "lower")])
def test_a_door_that_opens_onto_the_landing_takes_its_leaf(end, other, direction):
    """By hand: 1.40 m less 0.90 m is 0.50 m, Kenaf is 600 mm long; opposite there is room."""
    sizes = {f"{end}_landing": 1.4, f"{end}_leaf": 0.9, f"{other}_landing": 2.5}
    answer = assess(KENAF, at(20, p=0.2, **sizes), **SURE, direction=direction)
    assert answer.findings["landing_room"].margin == pytest.approx(-100, abs=1e-6)
    assert answer.verdict == "unsure"
    assert "landing_room" in answer.doubts
    if direction == "up":  # down it rocks too
        said = "A landing, less the leaf of its door, is 100 mm shorter than the robot."
        assert answer.reason == said


@pytest.mark.parametrize("p", [0.2, 0.24, 0.249999, 0.250001, 0.26, 0.3])
def test_fewer_than_two_nosings_rock(p):
    """By hand: past p = L/2 one of atan((L - p - C_L)/C_N) and atan((p - C_L)/C_N) is passed."""
    answer = assess(robot(com=(0.25, 0.03)), at(15, p=p), **SURE)
    down, up = (answer.findings[key].margin for key in ("tip_downhill", "tip_uphill"))
    assert down == pytest.approx(degrees(atan2(0.25 - p, 0.03)) - 15, abs=DEGREE)
    assert up == pytest.approx(15 - degrees(atan2(p - 0.25, 0.03)), abs=DEGREE)
    assert (answer.contact.grades.no_rotation is False) == (min(down, up) <= 0)
    assert any("p > L/2" in note for note in answer.notes) == (p > 0.25)


def test_no_belly_is_no_finding():
    """A robot whose belly nobody measured is not judged by it."""
    assert "high_centring" not in assess(robot(), kerb(0.1), **SURE).findings
    low = assess(robot(belly_clearance=0.02), kerb(0.1), **SURE)
    assert low.findings["high_centring"].holds  # a track without a gap is below it everywhere
    assert low.findings["high_centring"].margin is None


def test_a_robot_with_a_gap_drives_up_a_ramp():
    answer = assess(robot(gap=0.2, belly_clearance=0.02), ramp(2), **SURE)
    assert answer.verdict == "go"
    # by hand: on a plane tan(2 deg) is required, of the 1.0 = tan(45 deg) that may be
    assert answer.findings["gap_jam"].margin == pytest.approx(45 - 2, abs=DEGREE)


def test_a_robot_with_a_gap_on_stairs():
    """By hand: each half, 150 mm long, always has a nosing under it, 100 mm apart.

    So the lowest that stays is one spacing from the rear tip, as under a whole track.
    """
    question = Question.in_one_posture(robot(gap=0.2, belly_clearance=0.1), at(30, p=0.1), **SURE)
    found = traverse_of(question)
    expected = degrees(atan2(0.5 - 0.1 - 0.25, 0.1)) - 30
    flight = [each for each in found.phases if each.phase is Phase.TRAVERSE]
    # deg: an arc stays in touch with a nosing that it leaves for some micrometres
    assert degrees(flight[0].tilt_downhill[0]) == pytest.approx(expected, abs=0.01)
    answer = assess(question)
    assert (answer.verdict, answer.doubts) == ("unsure", ("gap_jam",))
    assert answer.contact.grades.no_rotation
