"""Turns on landings of hand-entered stairs: judged by plain lengths, in a posture that is named."""

import json
import math

import pytest
from test_clearance_findings import BOX

import kaidan
from kaidan import InputError, Robot, Stairs
from kaidan.assessment import Assessment
from kaidan.models.landings import turns_of
from kaidan.models.sentences.turning import IN_LINE, turned
from kaidan.question import Question
from kaidan.text.assessment import details
from kaidan.text.japanese import japanese

HALF = {"upper_turn": "half", "upper_landing": 1.2, "upper_landing_width": 2.2}
SURE = {"friction": 2.0, "theta_d": 0.0, "theta_M": 0.0}
"""A box of 1.2 by 0.5 m sweeps hypot(1.2, 0.5) = 1.3 m."""


def flight(**more):
    return Stairs(**{"rise": 0.15, "going": 0.3, "steps": 10, "width": 1.0} | more)


def turn(robot=BOX, stairs=None, **more):
    manner = {"flippers": "stowed"} | {k: more.pop(k) for k in ("flippers", "facing") if k in more}
    (found,) = turns_of(Question.of(robot, stairs or flight(**more), **manner))
    return found


def test_nothing_is_said_where_the_way_does_not_turn():
    answer = kaidan.assess(BOX, flight(upper_landing=0.9), **SURE)
    assert answer.turns == ()
    assert "turning" not in answer.findings


@pytest.mark.parametrize(
    ("depth", "way", "tight"),
    [(1.39, "spin", False), (1.32, "spin", True), (1.15, "none", False)],
)
def test_half_turn_on_the_spot(depth, way, tight):
    """1.300 m on the spot, 2 hypot(0.63, 0.28) = 1.379 m with 30 mm all round; less than its length
    is no way."""
    found = turn(**HALF | {"upper_landing": depth, "upper_landing_width": 3.0, "width": 1.5})
    assert (found.way, found.tight) == (way, tight)
    assert found.circle_m == pytest.approx(1.3)
    assert found.room_m == pytest.approx(depth, abs=0.005)
    assert found.turn_deg == 180.0


def test_the_circle_alone_does_not_get_there():
    """It fits into 1.40 m, but the box comes at 0.5 m from a wall and cannot get to 0.65 m."""
    found = turn(**HALF | {"upper_landing": 1.32, "upper_landing_width": 2.0, "width": 0.8})
    assert found.room_m == pytest.approx(1.32, abs=0.005)
    assert found.way != "spin"


def test_absolem_raises_its_flippers_on_a_landing_of_1_2_m():
    answer = kaidan.assess("absolem", flight(**HALF), flippers="flat", friction=1.0)
    (found,) = answer.turns
    assert (found.way, found.flippers, found.changed) == ("spin", "stowed", True)
    said = (
        "On the upper landing change the flippers to stowed and turn by 180 deg: it sweeps 0.90 m "
        "of 1.20 m."
    )
    assert said in answer.notes
    assert f"landing         {said}" in str(answer)
    assert answer.findings["turning"].holds
    assert f"  turning         {said}" in details(answer).splitlines()
    assert japanese(said) == (
        "上の床でフリッパを stowed にして 180° 旋回する。旋回円 0.90 m、踊り場の内接円 1.20 m。"
    )


def test_who_cannot_turn_gets_no_go():
    answer = kaidan.assess("ozbot-atr", flight(**HALF), friction=1.2)
    assert (answer.verdict, answer.governs) == ("no-go", "turning")
    assert answer.reason == (
        "It cannot turn by 180 deg on the upper landing: it sweeps 1.77 m, the landing has 1.20 m, "
        "and no manoeuvre was found."
    )
    assert japanese(answer.reason) is not None
    assert f"  turning         {answer.reason}" in details(answer).splitlines()
    assert answer.findings["turning"].holds_best is False
    again = Assessment.from_json(answer.to_json())
    assert again.turns == answer.turns
    assert json.loads(answer.to_json())["turns"][0]["way"] == "none"


def test_a_no_go_names_the_posture_of_the_circle_that_decides():
    """Stowed, where flat sweeps more: 0.901 m, which 0.8 m has no room for."""
    small = HALF | {"upper_landing": 0.8, "width": 0.9}
    answer = kaidan.assess("absolem", flight(**small), flippers="flat", friction=1.0)
    (found,) = answer.turns
    assert (found.way, found.flippers, found.changed) == ("none", "stowed", True)
    assert found.circle_m == pytest.approx(0.901, abs=0.001)
    assert answer.governs == "turning"
    assert answer.reason == (
        "It cannot turn by 180 deg on the upper landing: with flippers stowed it sweeps 0.90 m, "
        "the landing has 0.80 m, and no manoeuvre was found."
    )
    assert japanese(answer.reason) == (
        "上の床で 180° 旋回できません。フリッパ stowed で旋回円 0.90 m、踊り場の内接円 0.80 m、"
        "切り返しの手順も見つかりません。"
    )


WIDE = {"upper_landing": 1.5, "width": 1.45}


@pytest.mark.parametrize(
    ("fields", "moves"),
    [
        (WIDE | {"upper_turn": "quarter", "upper_landing_width": 1.5}, 3),
        (WIDE | {"upper_turn": "half", "upper_landing_width": 3.0}, 5),
    ],
)
def test_on_the_spot_it_drives_turns_and_drives(fields, moves):
    """Of a half turn it drives across and turns again."""
    found = turn(**fields)
    assert (found.way, found.moves, found.reversals) == ("spin", moves, 0)


@pytest.mark.parametrize(
    ("fields", "how"),
    [
        (HALF | {"upper_landing": 1.45}, "bit by bit"),
        (
            {"upper_turn": "quarter", "upper_landing": 1.25, "upper_landing_width": 2.0,
             "width": 0.8},
            "back and forth",
        ),
    ],
)  # fmt: skip
def test_only_what_drives_back_is_said_to_go_back_and_forth(fields, how):
    found = turn(**fields)
    assert (found.way, found.reversals > 0) == ("manoeuvre", how == "back and forth")
    said = turned(found, found.landing)
    assert said.endswith(f": {how} in {found.moves} drives and turns on the spot.")
    assert japanese(said) is not None


@pytest.mark.parametrize("most", [None, 1000])
def test_a_manoeuvre_of_many_moves_is_no_go_yet(most):
    """9 where the sheet states none: sqrt(9) stops of 10 mm are the 30 mm all round."""
    robot = BOX if most is None else BOX.model_copy(update={"turning_moves": most})
    answer = kaidan.assess(robot, flight(**HALF | {"upper_landing": 1.45}), **SURE)
    (found,) = answer.turns
    assert (found.way, found.tight, found.most_moves) == ("manoeuvre", False, most or 9)
    assert found.moves > 9
    assert answer.findings["turning"].holds == (most == 1000)
    assert answer.findings["turning"].holds_best
    said = (
        f"It can turn by 180 deg on the upper landing only bit by bit in {found.moves} drives and "
        "turns on the spot, more than 9 (turning_moves of its sheet): try it, or turn elsewhere."
    )
    assert (said in (answer.reason, *answer.notes)) == (most is None)
    assert (answer.verdict == "unsure") == (most is None)
    assert japanese(said) is not None


def test_a_turn_that_nobody_measured_is_no_go_yet():
    answer = kaidan.assess(BOX, flight(upper_turn="unknown"), **SURE)
    assert (answer.turns[0].way, answer.turns[0].turn_deg) == ("unknown", None)
    assert (answer.verdict, answer.governs) == ("unsure", "turning")
    with pytest.raises(InputError, match="upper_passage goes with upper_turn"):
        flight(upper_turn="unknown", upper_passage=1.0)


def test_of_a_landing_that_one_sheet_knows_that_one_counts():
    one = flight(name="one", upper_turn="unknown")
    two = flight(name="two", lower_turn="half", lower_landing=3.0, lower_landing_width=3.0)
    found = turns_of(Question.of(BOX, [one, two], flippers="stowed"))
    assert [each.landing for each in found] == ["landing below two"]


def test_a_circle_that_fits_elsewhere_is_not_said_to_be_too_large():
    """1.30 m of 1.35 m, but a lane of 0.62 m leads 0.31 m from a wall, where 0.65 m are needed."""
    sizes = {"upper_landing": 1.35, "upper_landing_width": 1.36, "width": 0.62}
    answer = kaidan.assess(BOX, flight(**HALF | sizes), **SURE)
    assert answer.reason == (
        "It cannot turn by 180 deg on the upper landing: it sweeps 1.30 m, the landing has 1.35 m, "
        "but not on the line by which it arrives or goes on, and no manoeuvre was found."
    )
    assert japanese(answer.reason) is not None


def test_what_no_slope_mends_has_no_margin_in_the_best_case_either():
    """Friction is short in the worst case and enough in the best: turning is neither."""
    answer = kaidan.assess("ozbot-atr", flight(**HALF), friction="0.5..1.2")
    assert (answer.verdict, answer.governs) == ("no-go", "turning")
    slides = answer.findings["slides_down"]
    assert slides.margin < 0 < slides.margin_best
    assert (answer.margin_deg, answer.margin_best_deg) == (-90.0, -90.0)


@pytest.mark.parametrize("flippers", ["flat", "best"])
def test_with_a_plan_that_is_found_it_is_said_too(flippers):
    answer = kaidan.assess(
        "absolem", flight(**HALF), flippers=flippers, model="contact", friction=1
    )
    assert [each.way for each in answer.turns] == ["spin"]
    assert answer.findings["turning"].holds


def test_without_room_to_be_off_it_is_no_go_yet():
    sizes = {"upper_landing": 1.32, "upper_landing_width": 3.0, "width": 1.5}
    answer = kaidan.assess(BOX, flight(**HALF | sizes), **SURE)
    assert answer.verdict == "unsure"
    assert "turning" in answer.doubts
    said = "It can turn by 180 deg on the upper landing only where it is less than 30 mm off: "
    assert any(each.startswith(said) for each in (answer.reason, *answer.notes))


def test_a_robot_of_unknown_width_is_no_go_yet():
    answer = kaidan.assess(Robot.named("kenaf"), flight(**HALF), flippers="stowed", **SURE)
    assert answer.turns[0].way == "unknown"
    assert "turning" in answer.doubts


@pytest.mark.parametrize(("leaf", "way"), [(0.0, "spin"), (0.8, "none")])
def test_a_door_that_opens_onto_the_landing_takes_its_leaf(leaf, way):
    """1.9 m less 0.8 m is 1.1 m, less than the box is long."""
    sizes = {"upper_landing": 1.9, "upper_landing_width": 3.0, "width": 1.5, "upper_leaf": leaf}
    assert turn(**HALF | sizes).way == way


@pytest.mark.parametrize(("end", "passage"), [("lower", 1.0), ("upper", 1.0)])
def test_round_the_corner_of_a_passage_in_one_go(end, passage):
    """A box of 1.2 by 0.5 m round a corner of 1 m: sqrt(2) - 0.6 - 0.5 = 0.314 m to spare.

    It does not turn on the spot in 1.25 m. Before a flight it cannot turn there at all: at
    atan(1.2 / 0.5) it is 1.3 m across. On the last nosing its tail hangs over the flight.
    """
    sizes = {"turn": "quarter", "landing": 1.25, "landing_width": 1.0, "passage": passage}
    found = turn(**{f"{end}_{name}": value for name, value in sizes.items()})
    assert found.way == ("corner" if end == "upper" else "none")
    deeper = sizes | {"landing": 1.4}
    found = turn(**{f"{end}_{name}": value for name, value in deeper.items()})
    assert found.way == "corner"


def test_turned_round_it_is_the_other_end_that_sweeps():
    """OzBot turns about a point 23 mm off its middle, so its ends differ; its circle does not."""
    both = [turn("ozbot-atr", facing=each, **HALF) for each in ("nose-first", "tail-first")]
    assert both[0].circle_m == both[1].circle_m


def test_landings_between_flights_are_judged_each():
    """The lower sheet has the landing between them; in line with both it must hold the robot."""
    lower = flight(name="one", **HALF | {"upper_landing_width": 3.0, "width": 1.5})
    middle = flight(name="two", upper_turn="quarter", upper_landing=1.6, upper_landing_width=1.6)
    upper = flight(name="three", width=1.5)
    answer = kaidan.assess(BOX, [lower, middle, upper], **SURE)
    assert [(each.landing, each.turn_deg) for each in answer.turns] == [
        ("landing above one", 180.0),
        ("landing above two", 90.0),
    ]
    assert answer.findings["landing_room"].margin == pytest.approx(0.0, abs=1e-6)
    below = flight(name="two", lower_turn="half", lower_landing=1.3, lower_landing_width=2.2)
    found = kaidan.assess(BOX, [flight(name="one"), below], **SURE)
    assert [each.landing for each in found.turns] == ["landing below two"]
    assert found.question.profile.points[-1, 0] == pytest.approx(2 * 9 * 0.3 + 1.3 + 2.0)


@pytest.mark.parametrize(
    ("robot", "manner"),
    [
        ("absolem", {"flippers": "stowed", "direction": "up"}),
        ("absolem", {"flippers": "flat", "direction": "down"}),
        ("ozbot-atr", {"direction": "down"}),
    ],
)
def test_each_flight_is_judged_from_its_own_start(robot, manner):
    """With a turn between them, as if each were alone: margins equal to the bisection's 1e-3."""
    lower = flight(name="one", **HALF | {"upper_landing": 1.4})
    upper = flight(name="two", rise=0.17, going=0.28, lower_landing=1.4)
    alone = [
        kaidan.assess(robot, each, friction=1.0, **manner)
        for each in (lower.model_copy(update={"upper_turn": "none"}), upper)
    ]
    both = kaidan.assess(robot, [lower, upper], friction=1.0, **manner)
    for key, one in both.findings.items():
        margins = [each.findings[key].margin for each in alone if key in each.findings]
        if one.margin is not None:
            assert one.margin == pytest.approx(min(margins), abs=1e-3), key
    assert IN_LINE in both.notes
    assert IN_LINE not in alone[1].notes


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        (
            {"upper_turn": "half"},
            "stairs: upper_turn = half needs upper_landing and upper_landing_width too",
        ),
        (
            HALF | {"upper_landing_width": 1.5},
            "stairs: upper_landing_width = 1.5 m, but the flight and what lies beside it are 2 m "
            "wide",
        ),
        (
            {"lower_turn": "quarter", "lower_landing": 1.0, "lower_landing_width": 0.8},
            "stairs: lower_landing_width = 0.8 m, but the flight is 1 m wide",
        ),
        (
            {
                "lower_turn": "quarter",
                "lower_landing": 1.0,
                "lower_landing_width": 1.0,
                "lower_passage": 1.4,
            },
            "stairs: lower_landing = 1 m, but lower_passage is 1.4 m wide",
        ),
        (
            {"lower_passage": 1.4},
            "stairs: lower_passage goes with lower_turn = quarter or half",
        ),
    ],
)
def test_what_no_landing_has_is_refused(fields, text):
    with pytest.raises(InputError) as error:
        flight(**fields)
    assert str(error.value) == text


def test_sheets_that_contradict_each_other_are_refused():
    one = flight(name="one", **HALF)
    two = flight(name="two", lower_turn="quarter", lower_landing=1.2, lower_landing_width=1.2)
    with pytest.raises(InputError, match="upper_turn of 'one' is half, lower_turn of 'two' is"):
        Question.of(BOX, [one, two])
    with pytest.raises(InputError, match="there is a landing, no passage"):
        Question.of(BOX, [flight(name="one", **HALF | {"upper_passage": 1.0}), flight(name="two")])


def test_a_sheet_with_a_turn_is_read_back():
    sheet = flight(**HALF)
    assert Stairs.from_text(sheet.to_toml(), origin="here") == sheet
    assert math.isclose(Stairs.from_json(sheet.to_json()).upper_landing_width, 2.2)
