"""Width and headroom of hand-entered stairs, and what a scan did not see: findings of any model."""

import math

import pytest

from kaidan import Profile, Question, Robot, Stairs
from kaidan.mechanics.clearance import spin_circle
from kaidan.models import clearance, judge
from kaidan.modes import LANDING_ROOM
from kaidan.outline import Outline, footprint_of
from kaidan.robot import FlipperPair, Posture, PostureChange
from one_posture import assess

BOX = Robot(
    name="box",
    mass=30.0,
    com_from_front=0.5,
    com_height=0.05,
    height=0.4,
    track={
        "flat_length": 1.0,
        "front_radius": 0.1,
        "rear_radius": 0.1,
        "gauge": 0.4,
        "width": 0.1,
    },
)
"""1.2 by 0.5 by 0.4 m."""
FLIGHT = Stairs(rise=0.15, going=0.3)


def asked(robot=BOX, **more):
    flight = FLIGHT.model_copy(update=more)
    return assess(robot, flight, friction=2.0, theta_d=0.0, theta_M=0.0)


def test_nothing_is_said_where_nothing_is_stated():
    assert {"narrow", "low"} & set(asked().findings) == set()


@pytest.mark.parametrize(("width", "verdict"), [(0.48, "no-go"), (0.6, "unsure"), (0.7, "go")])
def test_width(width, verdict):
    """500 mm straight; 0.5 cos 3 + 1.2 sin 3 + 0.06 = 622 mm off line."""
    answer = asked(width=width)
    needed = 0.5 * math.cos(math.radians(3)) + 1.2 * math.sin(math.radians(3)) + 0.06
    assert answer.findings["narrow"].margin == pytest.approx((width - needed) * 1e3)
    assert answer.findings["narrow"].margin_best == pytest.approx((width - 0.5) * 1e3)
    assert answer.verdict == verdict
    assert (answer.margin_deg > 0) is (verdict != "no-go")  # the sign never disagrees with it
    if verdict != "go":
        assert answer.governs == "narrow"
        assert answer.reason == (
            f"The flight is {width * 1e3:.0f} mm wide; the robot needs 500 mm going straight, "
            "622 mm off line."
        )


@pytest.mark.parametrize(("headroom", "verdict"), [(0.44, "no-go"), (0.7, "unsure"), (2, "go")])
def test_headroom(headroom, verdict):
    """0.4 / cos(26.57 deg) = 447 mm flat; (1.2 sin 15 + 0.4 cos 15) / cos = 779 mm rearing."""
    answer = asked(headroom=headroom)
    cos = 0.3 / math.hypot(0.3, 0.15)
    assert answer.findings["low"].margin_best == pytest.approx((headroom - 0.4 / cos) * 1e3)
    assert answer.verdict == verdict
    if verdict != "go":
        assert answer.reason == (
            f"The headroom is {headroom * 1e3:.0f} mm; the robot needs 447 mm lying flat, 779 mm "
            "rearing."
        )


def test_of_a_robot_of_unknown_size_it_is_not_known():
    answer = asked(robot=Robot.named("kenaf"), width=0.3, headroom=0.3)
    assert answer.findings["narrow"].holds is answer.findings["low"].holds is None


def test_the_closed_form_has_them_too():
    flight = FLIGHT.model_copy(update={"width": 0.4})
    answer = assess(BOX, flight, friction=2.0, model="closed-form")
    assert (answer.verdict, answer.governs) == ("no-go", "narrow")


@pytest.mark.parametrize(
    ("name", "flippers", "front", "rear"),
    [
        ("absolem", "stowed", 0.339, 0.339),
        ("absolem", "flat", 0.6035, 0.6035),
        ("ozbot-atr", "stowed", 0.803, 0.780),
    ],
)
def test_footprints_of_the_catalogue(name, flippers, front, rear):
    """Half the lengths over all; OzBot turns about the origin of its model, 0.485 m from front."""
    robot = Robot.named(name)
    found = footprint_of(robot, Outline.of(robot, Posture.parse(flippers, robot)))
    assert (found.front, found.rear) == pytest.approx((front, rear), abs=5e-4)


def test_the_wider_of_tracks_and_body_counts():
    assert BOX.overall_width == 0.5
    assert BOX.model_copy(update={"width": 0.6}).overall_width == 0.6
    assert BOX.model_copy(update={"width": 0.3}).overall_width == 0.5


def test_a_scan_without_the_floor_is_no_go_yet():
    answer = asked(foot_seen=False)
    assert (answer.verdict, answer.governs) == ("unsure", "foot_unseen")
    assert answer.reason == (
        "The floor before the first riser was not seen, so that riser may be higher than the "
        "others: scan it again with the floor in view."
    )


@pytest.mark.parametrize(
    ("drawn", "said"),
    [
        ({"first_rise_drawn": 0.33},
         "Drawn 2.31 m, stated 2.16 m: floor finish missing? Measure it: first riser 330 mm drawn, "
         "180 mm stated."),
        ({"first_rise_drawn": 0.23, "last_rise_drawn": 0.13},
         "Floor finish missing? Measure it: first riser 230 mm drawn, 180 mm stated, last riser "
         "130 mm drawn, 180 mm stated."),
    ],
)  # fmt: skip
def test_an_end_riser_drawn_and_stated_otherwise_is_no_go_yet(drawn, said):
    """Twelve risers of 180 mm: 2.16 m."""
    answer = asked(rise=0.18, going=0.29, steps=12, **drawn)
    assert (answer.verdict, answer.governs, answer.reason) == ("unsure", "floor_finish", said)


def test_a_scan_without_the_landing_says_what_nobody_knows():
    """From the foot nobody sees the landing's surface: that alone takes no GO."""
    answer = asked(head_seen=False)
    assert answer.verdict == asked().verdict == "go"
    assert "whether more steps follow the last one: no landing was seen" in str(answer)


@pytest.mark.parametrize(
    ("flippers", "ends", "spins"), [("stowed", 0.678, True), ("flat", 1.207, False)]
)
def test_absolem_cannot_spin_flat_on_a_landing_of_1_2_m(flippers, ends, spins):
    """Outer faces of the flippers, 2 (0.272 + 0.02491) m apart at any angle; Pythagoras."""
    absolem = Robot.named("absolem")
    found = footprint_of(absolem, Outline.of(absolem, Posture.parse(flippers, absolem)))
    circle = spin_circle(front=found.front, rear=found.rear, w=found.width)
    assert found.width == pytest.approx(2 * (0.272 + 0.04981 / 2), abs=5e-4)
    assert circle == pytest.approx(math.hypot(ends, 0.5938), abs=1e-3)
    assert bool(circle <= 1.2) is spins


def test_a_flight_that_its_tracks_alone_would_pass_is_too_narrow_for_absolem():
    """0.55 m: wider than its tracks (0.494 m), narrower than its flippers (0.594 m)."""
    flight = FLIGHT.model_copy(update={"width": 0.55})
    answer = assess("absolem", flight, flippers="flat", friction=2.0)
    assert (answer.verdict, answer.governs) == ("no-go", "narrow")
    assert answer.findings["narrow"].margin_best == pytest.approx(550 - 594)


def test_of_a_plan_the_largest_of_its_postures_counts():
    """Its reach, its width and its height are of one each; off stairs the floor is level.

    By hand: flippers 0.4 m long with an end radius of 0.05 m on pivots 0.1 m high at both tips of a
    box of 1.2 by 0.5 by 0.4 m. Level they make it 1.9 m long; upright their tips are 0.55 m high.
    """
    kerb = Profile.of_points([(-3, 0), (0, 0), (0, 0.1), (3, 0.1)])
    plan = (Posture(front=0.0, rear=0.0), PostureChange(before="land", posture=Posture()))
    needs = Question.of(FOLDING, kerb, friction=2.0, flippers=plan).needs
    off_line = 0.5 * math.cos(math.radians(3)) + 1.9 * math.sin(math.radians(3)) + 0.06
    rearing = 1.9 * math.sin(math.radians(15)) + 0.55 * math.cos(math.radians(15))
    assert needs == pytest.approx((0.5, off_line, 0.55, rearing), abs=1e-9)


ARMS = {
    "length": 0.4,
    "root_radius": 0.1,
    "tip_radius": 0.05,
    "pivot_height": 0.1,
    "stowed_angle": math.pi / 2,
}
FOLDING = BOX.model_copy(
    update={"front_flippers": FlipperPair(**ARMS), "rear_flippers": FlipperPair(**ARMS)}
)
"""1.2 m long with its flippers stowed, 0.35 m more at either end with them level."""


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_room_on_the_landing_where_it_stows_its_flippers(facing, direction):
    """By hand: it sets out with one pair level, 1.55 m long, and ends stowed, 1.2 m long.

    Before it stows them its tip is 0.95 m and 0.1 m beyond the last nosing.
    """
    posture = Posture(front=0.0, rear=0.0)
    flight = FLIGHT.model_copy(update={"upper_landing": 1.5, "lower_landing": 3.0})
    question = Question.of(
        FOLDING, flight, friction=2.0, flippers=posture, direction=direction, facing=facing
    )
    by_hand = 1.5 - (1.55 if direction == "down" else 1.2)
    assert clearance.room_when_stowed(question) == pytest.approx(by_hand)


def test_a_plan_needs_room_in_the_posture_in_which_it_stands_there():
    """By hand: stowed it is 1.2 m long, level 1.9 m."""
    level = Posture(front=0.0, rear=0.0)
    plan = (Posture(), PostureChange(before="traverse", posture=level))
    for ends, room in (({"lower_landing": 1.25}, 0.05), ({"upper_landing": 1.25}, -0.65)):
        flight = FLIGHT.model_copy(update={"lower_landing": 3.0, "upper_landing": 3.0} | ends)
        found = judge(Question.of(FOLDING, flight, friction=2.0, flippers=plan))
        assert found.of(LANDING_ROOM).worst == pytest.approx([room])
