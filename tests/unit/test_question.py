"""The question: every spelling, JSON both ways, what is refused, and what it knows by itself."""

import json
import math

import jsonschema
import numpy as np
import pytest
from pydantic import ValidationError

import kaidan
from kaidan import InputError, Payload, Posture, Profile, Question, Robot, Stairs, Surface
from kaidan.allowance import UNMEASURED, Allowance
from kaidan.mechanics.yielding import yielding_loss
from kaidan.modes import MODELS
from kaidan.robot import Track

GAUGED = Robot.model_validate(
    {
        "name": "gauged",
        "mass": 20.0,
        "com_from_front": 0.25,
        "com_height": 0.1,
        "track": {"flat_length": 0.5, "gauge": 0.3},
    }
)
FLIGHT = Stairs(name="flight", rise=0.1, going=0.15, steps=8)
LINE = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.17), (1.3, 0.17), (1.3, 0.34), (3.0, 0.34)]
PROFILE = Profile.of_points(LINE, name="two steps")
TWO = [Stairs(name="low", rise=0.17, going=0.28, steps=6), FLIGHT]

QUESTIONS = {
    "flight": Question.of(GAUGED, FLIGHT),
    "flights": Question.of(GAUGED, TWO, friction=0.8),
    "profile": Question.of(GAUGED, PROFILE, friction="0.6..1.0"),
    "all of it": Question.of(
        "absolem",
        "ibc",
        friction="0.6..1.0",
        acceleration="0.3m/s2",
        speed="0.2m/s",
        direction="down",
        facing="tail-first",
        flippers="20deg,-5deg",
        payload="5kg@200mm,300mm",
        theta_d="1deg..2.6deg",
        theta_M=0.01,
        yaw="10deg",
        risk=0.05,
        model="support-polygon",
        override="com_height=210mm,mass=40kg",
        uncertainty="angle=0.5deg,com_height=5mm,friction=0.05",
    ),
}


# JSON


@pytest.mark.parametrize("name", QUESTIONS)
def test_read_back_from_its_json_it_is_equal(name):
    question = QUESTIONS[name]
    text = question.to_json()
    assert text.isascii()
    assert Question.from_json(text) == question
    assert Question.model_validate(json.loads(text)) == question
    assert Question.from_json(text).to_json() == text


@pytest.mark.parametrize("name", QUESTIONS)
@pytest.mark.parametrize("mode", ["validation", "serialization"])
def test_its_json_keeps_to_its_schema(name, mode):
    schema = Question.model_json_schema(mode=mode)
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(json.loads(QUESTIONS[name].to_json()), schema)
    assert schema["additionalProperties"] is False
    assert list(schema["properties"]) == list(Question.model_fields)
    assert all("description" in each for each in schema["properties"].values())


def test_the_schema_refuses_what_is_no_question():
    validator = jsonschema.Draft202012Validator(Question.model_json_schema())
    good = json.loads(QUESTIONS["profile"].to_json())
    assert validator.is_valid(good)
    for spoilt in (
        good | {"direction": "sideways"},
        good | {"risk": 0.9},
        good | {"more": 1},
        good | {"terrain": {"points": [[0.0, 0.0, 0.0]]}},
        {key: value for key, value in good.items() if key != "robot"},
    ):
        assert not validator.is_valid(spoilt)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"zz": 1}, "question: zz is not a known field; known: robot, terrain, "),
        ({"yaw": 9.0}, "question: yaw = 9 rad is not within -1.39626 to 1.39626 rad"),
        ({"terrain": 7}, "stairs = 7 is not a table of fields"),
        ({"terrain": []}, "question: terrain: no flight was given"),
        ({"terrain": {"points": []}}, "profile: points have shape (0,), not (n, 2)"),
        (
            {"terrain": {"points": LINE, "colour": "red"}},
            "question: terrain.profile.colour is not a known field",
        ),
        ({"robot": "kenaf"}, 'robot = "kenaf" is not a table of fields'),
        ({"model": "wishful"}, "model = 'wishful' is not known; known: contact, closed-form, "),
    ],
)
def test_json_that_is_no_question_is_refused_in_one_line(change, said):
    table = json.loads(QUESTIONS["flight"].to_json()) | change
    with pytest.raises(InputError) as refused:
        Question.from_json(json.dumps(table))
    assert str(refused.value).startswith(said)
    assert "\n" not in str(refused.value)


def test_text_that_is_no_json_is_refused():
    with pytest.raises(InputError) as refused:
        Question.from_json("{")
    assert str(refused.value).startswith("question is not JSON: EOF while parsing")


# Spelling


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ({"friction": 0.75}, {"friction": "0.75"}),
        ({"friction": 0.75}, {"friction": (0.75, 0.75)}),
        ({"friction": (0.6, 1.0)}, {"friction": "0.6..1.0"}),
        ({"friction": [0.6, 1.0]}, {"friction": "0.6 to 1.0"}),
        ({"friction": 0.75}, {"friction": np.float32(0.75)}),
        ({"friction": 1}, {"friction": np.int64(1)}),
        ({"acceleration": 0.5}, {"acceleration": "0.5m/s2"}),
        ({"acceleration": 0.5}, {"acceleration": np.float16(0.5)}),
        ({"speed": 0.25}, {"speed": "0.25m/s"}),
        ({"speed": 0.25}, {"speed": np.float64(0.25)}),
        ({"yaw": math.radians(10)}, {"yaw": "10deg"}),
        ({"risk": 0.25}, {"risk": "0.25"}),
        ({"risk": 0.25}, {"risk": np.float32(0.25)}),
        ({"theta_d": 0.02}, {"theta_d": (0.02, 0.02)}),
        ({"theta_d": 0.02}, {"theta_d": Allowance(low=0.02, high=0.02)}),
        ({"theta_d": math.radians(2)}, {"theta_d": "2deg"}),
        ({"theta_M": (math.radians(1), math.radians(2.5))}, {"theta_M": "1deg..2.5deg"}),
        ({"theta_M": (0.01, 0.02)}, {"theta_M": [np.float64(0.01), np.float64(0.02)]}),
        ({"flippers": "flat"}, {"flippers": Posture(front="flat", rear="flat")}),
        ({"flippers": "stowed"}, {"flippers": Posture()}),
        ({"flippers": "0.1rad,stowed"}, {"flippers": Posture(front=0.1)}),
        ({"payload": "5kg@200mm,300mm"}, {"payload": Payload(mass=5, from_front=0.2, height=0.3)}),
        ({"payload": ["5kg@200mm,300mm"]}, {"payload": "5kg@200mm,300mm"}),
        ({"payload": ()}, {"payload": None}),
        (
            {"override": {"com_height": 0.21, "mass": 40}},
            {"override": "com_height=210mm,mass=40kg"},
        ),
        (
            {"override": ["com_height=210mm", "mass=40kg"]},
            {"override": "com_height=210mm,mass=40kg"},
        ),
        ({"override": {"mass": np.float32(40)}}, {"override": {"mass": "40kg"}}),
        ({"uncertainty": {"angle": math.radians(0.5)}}, {"uncertainty": "angle=0.5deg"}),
        ({"surface": "concrete-wet"}, {"surface": Surface.named("concrete-wet")}),
        ({"direction": "up"}, {"direction": None}),
    ],
    ids=repr,
)
def test_every_spelling_is_the_same_question(one, other):
    assert Question.of("absolem", "ibc", **one) == Question.of("absolem", "ibc", **other)


def test_names_and_sheets_and_paths_are_one_question(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(Robot.named("kenaf").to_toml(), encoding="utf-8")
    wet = tmp_path / "wet.toml"
    wet.write_text(Surface.named("concrete-wet").to_toml(), encoding="utf-8")
    asked = [
        Question.of("kenaf", "japan-dwelling", surface="concrete-wet"),
        Question.of(Robot.named("kenaf"), Stairs.named("japan-dwelling"), surface=wet),
        Question.of(str(path), "japan-dwelling", surface=Surface.named("concrete-wet")),
        Question.of(path, "JAPAN-DWELLING", surface=str(wet)),
    ]
    assert all(each == asked[0] for each in asked)


def test_several_flights_as_names_sheets_or_one_text():
    ibc, ada = Stairs.named("ibc"), Stairs.named("ada")
    for given in ("ibc+ada", ["ibc", "ada"], ("ibc", ada), [ibc, ada]):
        assert Question.of("kenaf", given).terrain == (ibc, ada)
    for given in ("ibc", ["ibc"], (ibc,), ibc):
        assert Question.of("kenaf", given).terrain == ibc


def test_a_verb_takes_a_question_or_what_makes_one():
    question = QUESTIONS["flight"]
    assert Question.ask(question) is question
    assert Question.ask(question, risk=0.1).risk == 0.1
    assert Question.ask(GAUGED, FLIGHT) == question
    whole = QUESTIONS["all of it"]
    assert Question.ask(whole, risk=0.1) == whole.changed(risk=0.1)
    assert Question.ask(whole, friction="0.5..0.7").friction == (0.5, 0.7)
    assert Question.ask(whole, flippers="flat").posture == Posture(front="flat", rear="flat")
    assert Question.ask(whole, theta_d="2deg").allowance_d.high == math.radians(2)
    assert Question.ask(whole, override="com_height=190mm").robot.com_height == 0.19
    assert Question.ask(whole, override="track.belt=grousers").robot.track.has_grousers
    assert Question.ask(whole, surface="concrete-wet", uncertainty="friction=0.1").spread[-1] == 0.1
    with pytest.raises(InputError, match="give either a surface or a friction, not both"):
        Question.ask(whole, surface="concrete-wet", friction=0.5)
    with pytest.raises(InputError) as refused:
        Question.ask(question, "ibc")
    assert str(refused.value) == ("a question has its stairs already; change them with changed()")


def test_the_direction_is_the_sheets_unless_stated():
    down = Stairs(rise=0.1, going=0.15, direction="down")
    assert Question.of("kenaf", down).direction == "down"
    assert Question.of("kenaf", down, direction="up").direction == "up"
    assert Question.of("kenaf", [down, FLIGHT]).direction == "up"


# Changing


def test_a_changed_question_is_validated_again():
    question = QUESTIONS["all of it"]
    assert question.changed(risk=0.1).risk == 0.1
    assert question.changed() == question
    for change, said in (
        ({"risk": 2.0}, "question: risk = 2 is not within 0.0001 to 0.5"),
        ({"direction": "sideways"}, "question: direction"),
        ({"terrain": PROFILE}, "a profile lies along the heading already: leave the yaw out"),
        ({"robot": Robot.named("kenaf")}, "robot 'kenaf' has no"),
        ({"speed": 3.0}, "speed = 3 is not within 0 to 0.4 m/s, the most absolem can do"),
        ({"posture": Posture(front=9.0 / 3)}, None),
        ({"frction": 0.5}, "question: frction is not a known field"),
        ({"acceleration": math.nan}, "question: acceleration = nan m/s^2 is not within"),
        ({"model": "closed-form"}, "the closed form knows no yaw; ask the contact model"),
    ):
        if said is None:
            question.changed(**change)
            continue
        with pytest.raises(InputError) as refused:
            question.changed(**change)
        assert str(refused.value).startswith(said)


def test_nothing_can_be_written_into_it():
    with pytest.raises(ValidationError):
        QUESTIONS["flight"].risk = 0.5


def test_theta_M_follows_the_direction_unless_measured():
    up = Question.of("absolem", FLIGHT)
    down = up.changed(direction="down")
    assert (up.allowance_M.high, up.allowance_M.source) == (UNMEASURED, "default")
    assert (down.allowance_M.high, down.allowance_M.source) == (0.0, "not applicable")
    assert down.changed(direction="up").allowance_M == up.allowance_M
    assert (down.allowance_d.high, down.allowance_d.source) == (UNMEASURED, "default")
    measured = Question.of("kenaf", FLIGHT, theta_M=(0.01, 0.02))
    for each in (measured, measured.changed(direction="down")):
        assert (each.allowance_M.low, each.allowance_M.high) == (0.01, 0.02)
        assert each.allowance_M.source == "measured"


def test_measured_allowances_stand_in_the_robots_sheet():
    """The paper's rig: 2.6 deg, and 1.2 to 2.6 deg going up; the question's own come first."""
    up = Question.of("kenaf", FLIGHT)
    of_d, of_M = (
        [math.degrees(end) for end in (one.low, one.high)]
        for one in (up.allowance_d, up.allowance_M)
    )
    assert of_d == pytest.approx([2.55, 2.65], abs=1e-4)
    assert of_M == pytest.approx([1.15, 2.65], abs=1e-4)
    assert up.allowance_d.source == up.allowance_M.source == "measured"
    down = up.changed(direction="down")
    assert (down.allowance_M.high, down.allowance_M.source) == (0.0, "not applicable")
    assert down.allowance_d == up.allowance_d
    own = Question.of("kenaf", FLIGHT, theta_d=0.0, theta_M=(0.0, 0.01))
    assert (own.allowance_d.high, own.allowance_M.high) == (0.0, 0.01)


def yields(radius=0.06, **track):
    return Robot(
        name="soft", mass=20.0, com_from_front=0.33, com_height=0.12,
        track=Track(flat_length=0.75, front_radius=radius, rear_radius=radius, **track),
    )  # fmt: skip


def theta_d(robot, **manner):
    allowance = Question.in_one_posture(robot, FLIGHT, **{"friction": 1.0} | manner).allowance_d
    return math.degrees(allowance.low), math.degrees(allowance.high), allowance.source


BY_MECHANICS = "indentation and sag as measured"


def test_indentation_and_sag_take_the_place_of_the_default():
    # FLIGHT's nosings lie p apart; the rigid limit is atan((0.42 - p)/0.12); nothing grips
    p, w_n, w_t = FLIGHT.nosing_spacing, 0.002, 0.003
    expected = yielding_loss(
        L=0.75, p=p, C_L=0.33, C_N=0.12, w_n=w_n, w_t=w_t, R=0.06, mu=1.0, speed=0.1, gyration=0.2
    )
    low, high, source = theta_d(yields(indentation=w_n, sag=w_t))
    assert (low, source) == (0.0, BY_MECHANICS)
    assert high == pytest.approx(math.degrees(expected))
    assert 0.0 < high < 2.6
    # the same as stiffnesses of 20 kg
    stiff = {"stiffness": 20.0 * 9.80665 / w_n, "shear_stiffness": 20.0 * 9.80665 / w_t}
    assert theta_d(yields(**stiff))[1] == pytest.approx(high)
    # what grips costs more, and so may what nobody knows: friction, or the ends' shorter radius
    assert theta_d(yields(indentation=w_n, sag=w_t), friction=None)[1] > high + 4.0
    assert theta_d(yields(0.005, indentation=w_n, sag=w_t), friction=2.0)[1] > high + 4.0
    # the robot's other end, and a load that presses as much farther
    load = Payload(mass=20.0, from_front=0.33, height=0.12)
    assert theta_d(yields(indentation=w_n, sag=w_t), payload=[load])[1] > 1.5 * high


def test_one_of_indentation_and_sag_or_grousers_raise_the_default_and_lower_nothing():
    default = (0.0, pytest.approx(2.6), "default")
    assert theta_d(yields()) == default
    assert theta_d(yields(indentation=0.002)) == default
    assert theta_d(yields(indentation=0.002, sag=0.003, belt="grousers")) == default
    soft = theta_d(yields(sag=0.03))
    assert soft[1] > 2.6
    assert soft[2] == BY_MECHANICS


def test_a_stated_theta_d_counts_as_it_is_and_a_sheets_at_least():
    soft = {"indentation": 0.006, "sag": 0.02}
    assert theta_d(yields(**soft), theta_d=0.0) == (0.0, 0.0, "measured")
    measured = Robot(**dict(yields(**soft)) | {"theta_d": Allowance(low=0.01, high=0.02)})
    low, high, source = theta_d(measured)
    assert (low, source) == (pytest.approx(math.degrees(0.01)), BY_MECHANICS)
    assert high > math.degrees(0.02)
    little = {"indentation": 0.0002, "sag": 0.0002}
    measured = Robot(**dict(yields(**little)) | {"theta_d": Allowance(low=0.01, high=0.02)})
    assert theta_d(measured)[1:] == (pytest.approx(math.degrees(0.02)), "measured")


def test_where_not_even_the_rigid_robot_stands_the_default_remains():
    long = Stairs.inclined(angle=0.4, nosing_spacing=0.45)
    question = Question.in_one_posture(yields(indentation=0.002, sag=0.003), long, friction=1.0)
    assert question.allowance_d.source == "default"


def test_theta_d_at_other_lengths():
    robot = yields(indentation=0.002, sag=0.003)
    question = Question.in_one_posture(robot, FLIGHT, friction=1.0)
    p = np.array([FLIGHT.nosing_spacing, 0.2, 0.45])
    found = question.theta_d_at(L=0.75, p=p, C_L=0.33, C_N=0.12)
    assert found[0] == pytest.approx(question.allowance_d.high)
    assert 0.0 < found[1] != found[0]
    assert found[2] == UNMEASURED
    plain = Question.in_one_posture(yields(), FLIGHT)
    assert plain.theta_d_at(L=0.75, p=p, C_L=0.33, C_N=0.12) == UNMEASURED


def test_the_reserve_is_the_questions_then_the_sheets_then_the_default():
    robot = Robot.named("kenaf")
    assert Question.of(robot, FLIGHT).reserve == pytest.approx(math.radians(8.0))
    careful = robot.model_copy(update={"fall_reserve": 0.2})
    assert Question.of(careful, FLIGHT).reserve == 0.2
    assert Question.of(careful, FLIGHT, fall_reserve="5deg").reserve == pytest.approx(
        math.radians(5.0)
    )


# What it knows by itself


@pytest.mark.parametrize(
    ("direction", "facing", "nose_up"),
    [
        ("up", "nose-first", True),
        ("up", "tail-first", False),
        ("down", "nose-first", False),
        ("down", "tail-first", True),
    ],
)
def test_the_nose_points_up(direction, facing, nose_up):
    assert Question.of("kenaf", FLIGHT, direction=direction, facing=facing).nose_up is nose_up


def test_rolling_resistance_works_against_the_motion():
    sheet = GAUGED.model_dump() | {"drive": {"rolling_resistance": 0.1}}
    up = Question.of(Robot.model_validate(sheet), FLIGHT)
    assert up.rolling_resistance == 0.1
    assert up.changed(direction="down").rolling_resistance == -0.1


def test_friction_is_a_range_or_unknown():
    assert all(map(math.isnan, Question.of("kenaf", FLIGHT).friction))
    assert Question.of("kenaf", FLIGHT, friction="0.6..1.0").friction == (0.6, 1.0)


def test_the_energy_threshold_is_that_of_a_sudden_stop():
    # hand: v^2 / 2g, 0.1 m/s (the paper's) where none is stated, and the share that the impact on
    # the contact leaves to the rotation; no inertia is stated, so half of an even box's counts:
    # 470 mm and an end of 65 mm at either end, twice 71 mm high
    share = 0.071**2 / ((0.6**2 + 0.142**2) / 24 + 0.071**2)
    slow, fast = Question.of("kenaf", FLIGHT), Question.of("kenaf", FLIGHT, speed=0.3)
    assert slow.kinetic_height == pytest.approx(0.01 / 19.6133)
    assert slow.energy_threshold() == pytest.approx(share * 0.01 / 19.6133)
    assert fast.energy_threshold() == pytest.approx(share * 0.09 / 19.6133)
    # slipping back at 0.2 m/s until a grouser holds and the belts run at 0.3 m/s: 0.5 m/s in all
    assert fast.energy_threshold(0.04 / 19.6133) == pytest.approx(share * 0.25 / 19.6133)
    # 10 kg with 0.4 kg m2 have a radius of gyration of 0.2 m
    heavy = Question.of(slow.robot.model_copy(update={"mass": 10.0, "inertia": 0.4}), FLIGHT)
    share = 0.071**2 / (0.04 + 0.071**2)
    assert heavy.energy_threshold() == pytest.approx(share * 0.01 / 19.6133)


def test_steps_of_a_terrain():
    assert QUESTIONS["flight"].flight == FLIGHT
    found = QUESTIONS["profile"].flight
    assert found.step_rises == pytest.approx((0.17, 0.17))
    assert found.step_goings == pytest.approx((0.3,))
    assert found.name == QUESTIONS["profile"].terrain_name == "two steps"
    both = QUESTIONS["flights"]
    assert both.terrain_name == "low + flight"
    assert len(both.flight.step_rises) == 14


FLOOR = Profile.of_points([(0.0, 0.0), (4.0, 0.0)], name="floor")
RAMP = Profile.of_points([(0.0, 0.0), (2.0, 0.0), (4.0, 0.5), (6.0, 0.5)], name="ramp")


@pytest.mark.parametrize("terrain", [FLOOR, RAMP], ids=["floor", "ramp"])
def test_what_has_no_steps_gets_none(terrain):
    question = Question.of(GAUGED, terrain, friction=1.0)
    assert question.flight is None
    assert question.spread == (0.0,) * 6
    for model in ("closed-form", "support-polygon"):
        answer = kaidan.assess(question, model=model)
        assert (answer.verdict, answer.governs) == ("outside-model", "outside_model")
        assert answer.angle_deg is answer.nosing_spacing_m is answer.required_friction is None
        assert answer.findings == {}


# Refusals, to the letter

KNOWN = "contact, closed-form, support-polygon, physics"
REFUSED = {
    "surface and friction": (
        {"surface": "concrete-dry", "friction": 1.0},
        "give either a surface or a friction, not both",
    ),
    "friction": ({"friction": -0.1}, "friction = -0.1 is not within 0 to 5"),
    "friction upside down": (
        {"friction": (1.0, 0.6)},
        "friction = (1.0, 0.6): the low end of a range comes first",
    ),
    "friction nan": ({"friction": math.nan}, "friction = nan is not a finite number"),
    "friction text": ({"friction": "high"}, "friction 'high' is not a plain number such as 0.8"),
    "friction true": ({"friction": True}, "friction = True is not a number"),
    "friction huge": ({"friction": 10**400}, "friction = inf is not a finite number"),
    "acceleration": (
        {"acceleration": 10.0},
        "question: acceleration = 10 m/s^2 is not within -9.8 to 9.8 m/s^2",
    ),
    "acceleration none": (
        {"acceleration": None},
        "question: acceleration = None is not a number",
    ),
    "acceleration without a unit": (
        {"acceleration": "0.3"},
        "acceleration '0.3' has no unit; write 0.3m/s2 or 0.3m/s^2 or 0.3g0",
    ),
    "speed": ({"speed": -1.0}, "question: speed = -1 m/s is not within 0 to 30 m/s"),
    "risk": ({"risk": 0.0}, "question: risk = 0 is not within 0.0001 to 0.5"),
    "risk high": ({"risk": 0.6}, "question: risk = 0.6 is not within 0.0001 to 0.5"),
    "yaw": (
        {"yaw": 2.0},
        "question: yaw = 2 rad is not within -1.39626 to 1.39626 rad (in degrees? that would be "
        "0.0349066 rad)",
    ),
    "direction": (
        {"direction": "sideways"},
        "direction = 'sideways' is not known; known: up, down",
    ),
    "direction empty": ({"direction": ""}, "direction = '' is not known; known: up, down"),
    "facing": (
        {"facing": "nose"},
        "facing = 'nose' is not known; known: nose-first, tail-first",
    ),
    "flippers": ({"flippers": 5}, "flippers = 5 is not known; known: flat, stowed, or angles"),
    "no flippers": ({"flippers": "flat"}, "robot 'kenaf' has no flippers"),
    "payload": ({"payload": 5}, "payload = 5 is not a Payload or a list of them"),
    "payload text": (
        {"payload": ""},
        "payload '': write MASS@BEHIND_FRONT,HEIGHT, for example 5kg@200mm,300mm",
    ),
    "payload array": (
        {"payload": np.array([0.5, 0.6])},
        "payload = array([0.5, 0.6]) is not a Payload or a list of them",
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
        "theta_M = (0.02, 0.01): the low end of a range comes first",
    ),
    "theta_d three": (
        {"theta_d": (0.01, 0.02, 0.03)},
        "theta_d = (0.01, 0.02, 0.03) is not a number or a pair (low, high)",
    ),
    "model": ({"model": "wishful"}, f"model = 'wishful' is not known; known: {KNOWN}"),
    "model array": (
        {"model": np.array([0.5, 0.6])},
        f"model = array([0.5, 0.6]) is not known; known: {KNOWN}",
    ),
    "override": (
        {"override": {"colour": 1.0}},
        "override 'colour' is not known; write NAME=VALUE with a name of com_from_front, "
        "com_height, flat_length, gauge, mass",
    ),
    "override number": (
        {"override": 5},
        "override = 5 is not a table or texts NAME=VALUE with a name of com_from_front, "
        "com_height, flat_length, gauge, mass",
    ),
    "override twice": (
        {"override": "mass=1kg,mass=2kg"},
        "override mass is given twice",
    ),
    "override word": (
        {"override": "track.belt=rubber"},
        "override track.belt = 'rubber' is not known; known: smooth, grousers",
    ),
    "override word twice": (
        {"override": "track.belt=smooth,track.belt=grousers"},
        "override track.belt is given twice",
    ),
    "uncertainty of no friction": (
        {"uncertainty": "friction=0.1"},
        "uncertainty of friction needs a friction or a surface",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name):
    manner, text = REFUSED[name]
    with pytest.raises(InputError) as refused:
        Question.of("kenaf", FLIGHT, **manner)
    assert str(refused.value) == text


def test_every_model_is_known_in_the_order_of_the_texts():
    assert ", ".join(MODELS) == KNOWN


@pytest.mark.parametrize(
    ("manner", "terrain", "text"),
    [
        ({}, PROFILE, "a profile lies along the heading already: leave the yaw out"),
        ({}, TWO, "several flights are driven straight on: leave the yaw out"),
        (
            {"model": "closed-form"},
            FLIGHT,
            "the closed form knows no yaw; ask the contact model",
        ),
        (
            {"robot": "kenaf"},
            FLIGHT,
            "robot 'kenaf': track.gauge is not known, and a yaw needs the distance between the "
            "middles of the tracks",
        ),
    ],
)
def test_where_no_yaw_can_be_judged_it_is_refused(manner, terrain, text):
    manner = {"robot": GAUGED} | manner
    with pytest.raises(InputError) as refused:
        Question.of(manner.pop("robot"), terrain, yaw=0.1, **manner)
    assert str(refused.value) == text


def test_a_speed_that_the_robot_does_not_reach_is_refused():
    with pytest.raises(InputError) as refused:
        Question.of("absolem", FLIGHT, speed=3.0)
    assert str(refused.value) == "speed = 3 is not within 0 to 0.4 m/s, the most absolem can do"


@pytest.mark.parametrize(
    ("terrain", "text"),
    [
        (TWO, "uncertainty of angle or nosing_spacing: give it in the sheet of each flight"),
        (PROFILE, "uncertainty of angle or nosing_spacing: a profile takes them in its covariance"),
    ],
)
def test_an_uncertain_angle_belongs_to_one_flight(terrain, text):
    with pytest.raises(InputError) as refused:
        Question.of(GAUGED, terrain, uncertainty="angle=0.5deg")
    assert str(refused.value) == text


@pytest.mark.parametrize("wrong", [5, None, b"kenaf", ["kenaf"]])
def test_what_is_no_sheet_is_refused(wrong):
    with pytest.raises(InputError, match="is not a Robot, a name of the catalogue or a TOML file"):
        Question.of(wrong, "ibc")
    wrong = [5] if isinstance(wrong, list) else wrong  # a list of names is several flights
    with pytest.raises(InputError, match="is not a Stairs"):
        Question.of("kenaf", wrong)
    if wrong is not None:
        with pytest.raises(InputError, match="is not a Surface"):
            Question.of("kenaf", "ibc", surface=wrong)
    with pytest.raises(InputError, match="no flight was given"):
        Question.of("kenaf", [])


def test_an_array_is_no_end_that_leads():
    with pytest.raises(
        InputError, match=r"^facing = array\(\[0.5, 0.6\]\) is not known; known: nose-"
    ):
        Question.of("kenaf", "ibc", facing=np.array([0.5, 0.6]))


def test_momentum_threshold_by_hand():
    """Going down a sudden stop and the sag of a track that gives theta_d; going up the stop."""
    stairs = Stairs(rise=0.15, going=0.2, steps=6)  # 250 mm apart, sin 0.6, cos 0.8
    asks = {"friction": 1.0, "theta_d": (0.0, math.asin(0.04)), "theta_M": 0.0}
    up = Question.in_one_posture("kenaf", stairs, **asks)
    down = Question.in_one_posture("kenaf", stairs, direction="down", **asks)
    assert up.momentum_threshold() == up.energy_threshold() == down.energy_threshold()
    sag = 0.25 * 0.04 / 0.8 * 0.6**2
    assert down.momentum_threshold() - down.energy_threshold() == pytest.approx(sag)
