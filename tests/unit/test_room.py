"""Free space of a flight as a function of the height, and what robots make of it, by hand."""

import math

import pytest

from kaidan import InputError, Robot, Stairs, assess
from kaidan.terrain.room import Opening, Room

RAILS = Room(((0.68, 1.0), (2.1, 0.86)))
"""1.0 m up to handrails 0.68 m above the nosings, between them 0.86 m up to a ceiling of 2.1 m."""


@pytest.mark.parametrize(
    ("height", "width"), [(0.1, 1.0), (0.68, 1.0), (0.7, 0.86), (2.1, 0.86), (3.0, 0.86)]
)
def test_how_wide_it_is_up_to_a_height(height, width):
    """Beyond the ceiling: up to it."""
    assert RAILS.width_up_to(height) == width


@pytest.mark.parametrize(("width", "height"), [(0.5, 2.1), (0.86, 2.1), (0.9, 0.68), (1.1, 0.0)])
def test_how_high_it_is_over_a_width(width, height):
    assert RAILS.height_over(width) == height


def test_of_an_unknown_height_all_counts():
    assert RAILS.width_up_to(math.nan) == 0.86


def test_several_flights_are_as_narrow_as_the_narrowest_at_each_height():
    other = Room(((0.5, 0.95), (1.8, 0.9)))
    assert Room.of_all([RAILS, other]).openings == ((0.5, 0.95), (0.68, 0.9), (1.8, 0.86))


@pytest.mark.parametrize(
    ("stated", "openings"),
    [
        ({"width": 0.9, "headroom": 2.0}, ((2.0, 0.9),)),
        ({"width": 0.9}, ((math.inf, 0.9),)),
        ({"headroom": 2.0}, ((2.0, math.inf),)),
    ],
)
def test_a_width_and_a_headroom_are_one_opening(stated, openings):
    found = Room.of(stated.get("width"), stated.get("headroom"))
    assert found.openings == openings


def test_nothing_stated_is_no_room():
    assert Room.of(None, None) is None


def test_clear_widths_fall_with_the_height():
    with pytest.raises(InputError, match="heights that ascend and widths that descend"):
        Stairs(
            rise=0.17, going=0.29, clear=[Opening(height=1, width=1), Opening(height=2, width=1)]
        )


FLAT = {"friction": 1.0, "flippers": "flat"}
"""Absolem: 594 mm wide, 716 mm off line; 0.69 m high, on 21.8 degrees 743 mm, rearing 1054 mm."""


def asked(robot, *clear, **how):
    pairs = [{"height": height, "width": width} for height, width in clear]
    return assess(robot, Stairs(rise=0.12, going=0.3, clear=pairs), **FLAT | how)


@pytest.mark.parametrize(
    ("above", "verdict", "reason"),
    [
        (0.86, "", ""),
        (0.65, "unsure", "The flight is 650 mm wide;"),
        (0.5, "no-go", "The flight is 500 mm wide;"),
    ],
)
def test_a_robot_that_is_higher_than_handrails_needs_its_width_between_them(above, verdict, reason):
    answer = asked("absolem", (0.68, 1.0), (100.0, above))
    assert answer.findings["narrow"].margin == pytest.approx((above - 0.716) * 1e3, abs=1.0)
    assert answer.findings["narrow"].margin_best == pytest.approx((above - 0.594) * 1e3, abs=1.0)
    if verdict:
        assert answer.verdict == verdict
        assert answer.reason.startswith(reason)
    else:
        assert answer.governs not in ("narrow", "low")


def test_a_lower_one_passes_under_them():
    """Lying flat it needs 743 mm; where it rears it needs 1054 mm, and its width between them."""
    answer = asked("absolem", (0.9, 1.0), (100.0, 0.5))
    narrow = answer.findings["narrow"]
    assert narrow.margin_best == pytest.approx((1.0 - 0.594) * 1e3, abs=1.0)
    assert narrow.margin == pytest.approx((0.5 - 0.716) * 1e3, abs=1.0)
    assert (answer.verdict, answer.governs) == ("unsure", "narrow")


def test_what_hangs_over_all_is_told_as_headroom():
    answer = asked("absolem", (0.3, 1.0), (0.7, 0.9))
    assert answer.findings["narrow"].margin > 0
    assert (answer.verdict, answer.governs) == ("no-go", "low")
    assert answer.reason.startswith("The headroom is 700 mm;")


def test_what_is_narrow_from_the_ground_up_is_told_as_width():
    answer = asked("absolem", (2.1, 0.5))
    assert answer.findings["low"].margin > 0
    assert (answer.verdict, answer.governs) == ("no-go", "narrow")


def test_of_a_robot_of_unknown_width_it_is_said():
    kenaf = Robot.named("kenaf").model_copy(update={"height": 0.3})
    answer = asked(kenaf, (0.68, 1.0), (2.1, 0.5), friction=2.0, flippers="stowed")
    assert answer.findings["narrow"].holds is None
    assert answer.findings["low"].holds is True
    (line,) = (each for each in str(answer).splitlines() if "not known" in each)
    assert line.endswith("the drive's traction, the robot's size: measure them")
