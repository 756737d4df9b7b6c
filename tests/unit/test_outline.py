"""Underside of a robot: numbers by hand."""

import math

import numpy as np
import pytest

from kaidan.contact import BELLY, FLIPPER, TRACK
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Payload, Posture, Robot, Track

ROUNDING = 1e-12  # m


def robot(**changes):
    sheet = {
        "name": "r",
        "mass": 20.0,
        "com_from_front": 0.2,
        "com_height": 0.1,
        "track": Track(flat_length=0.5, front_radius=0.06, rear_radius=0.05),
    }
    return Robot(**(sheet | changes))


FLIPPERS = FlipperPair(length=0.3, root_radius=0.06, tip_radius=0.03, pivot_height=0.06)


def test_a_main_track():
    """By hand: front tip 0.2 ahead of the centroid, rear tip 0.3 behind, underside 0.1 below."""
    outline = Outline.of(robot())
    np.testing.assert_allclose(
        outline.parts, [(-0.3, -0.05, 0.05, 0.2, -0.04, 0.06)], atol=ROUNDING
    )
    assert outline.kinds.tolist() == [TRACK]
    assert outline.reach == pytest.approx((0.35, 0.26), abs=ROUNDING)


def test_a_flipper_laid_flat_touches_the_ground_line():
    """By hand: pivot over the front tip; the tip's disc of 30 mm ends on the underside."""
    outline = Outline.of(robot(front_flippers=FLIPPERS), Posture(front="flat"))
    x, z, r = outline.parts[1, 3:]
    assert z - r == pytest.approx(-0.1, abs=ROUNDING)
    assert x == pytest.approx(0.2 + math.sqrt(0.3**2 - 0.03**2), abs=ROUNDING)
    assert outline.kinds.tolist() == [TRACK, FLIPPER]


def test_a_rear_flipper_points_backward_and_up():
    """By hand: raised by 30 degrees from its pivot, 20 mm inside the rear tip."""
    pair = FLIPPERS.model_copy(update={"pivot_inset": 0.02})
    outline = Outline.of(robot(rear_flippers=pair), Posture(rear=math.radians(30)))
    x, z = -0.3 + 0.02, -0.1 + 0.06
    by_hand = (x - 0.3 * math.cos(math.pi / 6), z + 0.15, 0.03, x, z, 0.06)
    np.testing.assert_allclose(outline.parts[1], by_hand, atol=ROUNDING)


def test_belly_and_gap():
    """By hand: tracks of 0.5 with 0.1 missing in the middle; belly 40 mm above the underside."""
    track = Track(
        flat_length=0.5, front_radius=0.06, rear_radius=0.05, gap=0.1, belly_clearance=0.04
    )
    outline = Outline.of(robot(track=track))
    assert outline.kinds.tolist() == [TRACK, TRACK, BELLY]
    assert outline.parts[0, 3] == pytest.approx(-0.3 + 0.2, abs=ROUNDING)
    assert outline.parts[1, 0] == pytest.approx(0.2 - 0.2, abs=ROUNDING)
    assert outline.parts[2, [1, 4]].tolist() == pytest.approx([-0.06, -0.06], abs=ROUNDING)


def test_a_payload_moves_the_centroid():
    """By hand: 5 kg on 20 kg at 0.7 m height and 0.45 m back shift it by a fifth of the way."""
    outline = Outline.of(robot(), payload=[Payload(mass=5.0, from_front=0.45, height=0.7)])
    assert outline.stance.com_from_front == pytest.approx(0.25, abs=ROUNDING)
    assert outline.stance.com_height == pytest.approx(0.22, abs=ROUNDING)
    assert outline.parts[0, 3] == pytest.approx(0.25, abs=ROUNDING)


def test_radius_of_gyration_given_and_estimated():
    """By hand: sqrt(I/M); else that of a box 0.61 long and 0.2 high."""
    given = Outline.of(robot(inertia=0.8))
    assert (given.gyration, given.gyration_estimated) == (pytest.approx(0.2), False)
    estimated = Outline.of(robot())
    assert estimated.gyration == pytest.approx(math.hypot(0.61, 0.2) / math.sqrt(12))
    assert estimated.gyration_estimated


def test_a_flipper_pushed_down_reaches_further_ahead_than_in_line_with_the_floor():
    """The tip lies 0.2 m ahead of the centroid and 0.34 m below it."""
    down = Outline.of(robot(front_flippers=FLIPPERS), Posture(front=-math.pi / 2))
    assert down.reach[1] == pytest.approx(0.26)
    assert down.lead == pytest.approx(math.hypot(0.2, 0.34) + 0.03)
    for posture in (Posture(), Posture(front="flat")):
        outline = Outline.of(robot(front_flippers=FLIPPERS), posture)
        assert outline.lead == outline.reach[1]


@pytest.mark.parametrize("angle", [-math.pi / 2, -0.9, -2.5])
def test_whatever_a_flipper_does_behind_the_nose_reaches_as_far_ahead(angle):
    """Also where no disc lies ahead of the centroid and below it."""
    level = robot(com_height=0.06, rear_flippers=FLIPPERS)
    outline = Outline.of(level, Posture(rear=angle))
    assert outline.lead == outline.reach[1]
    arrays = outline.parts.reshape(-1, 3)
    behind = arrays[arrays[:, 0] - arrays[:, 2] < 0.0]
    trail = np.hypot(behind[:, 0], behind[:, 1]) + behind[:, 2]
    assert outline.trail == trail.max()
    assert outline.turned_round().lead >= outline.reach[0]


def test_turned_round_twice_is_the_same():
    outline = Outline.of(robot(front_flippers=FLIPPERS))
    np.testing.assert_array_equal(outline.turned_round().turned_round().parts, outline.parts)
    assert outline.turned_round().reach == pytest.approx(outline.reach[::-1])
