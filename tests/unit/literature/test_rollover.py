"""Stability margin, rule of avoidance, and the loop with and without it."""

import math

import numpy as np
import pytest

from kaidan.contact import Status
from kaidan.errors import InputError
from kaidan.literature.guarded_drive import drive_guarded
from kaidan.literature.rollover import Action, avoid_rollover, stability_margin
from kaidan.literature.stepping import Angles
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import energy_margin_backward, energy_margin_forward
from kaidan.mechanics.triangle import alpha, beta, theta_alpha, theta_beta
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse

ABSOLEM = Robot.named("absolem")
FLIGHT = Profile.of_stairs(Stairs(rise=0.178, going=0.279, steps=3))
LOW = Profile.of_points([(-2, 0), (0, 0), (0, 0.12), (2, 0.12)])


def test_margin_by_hand():
    """3-4-5: from 3 m up to 5 m; past the contact minus that."""
    assert stability_margin([(-4, 0), (4, 0)], (0, 3)) == pytest.approx((2.0, 2.0), abs=1e-12)
    assert stability_margin([(0, 0), (8, 0)], (-4, 3))[0] == pytest.approx(-2.0, abs=1e-12)
    assert stability_margin([(-8, 0), (0, 0)], (4, 3))[1] == pytest.approx(-2.0, abs=1e-12)
    assert stability_margin([(0, 0)], (0, 3)) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_margin_is_the_mechanics_own_on_a_slope():
    """Agreement with the paper's triangle: Kenaf's contacts at d = 20 mm, 150 mm, 40 degrees."""
    slope = math.radians(40)
    pose = {"d": 0.02, "k": 2, "p": 0.15, "C_L": 0.196, "C_N": 0.071}
    near = {name: pose[name] for name in ("d", "C_L", "C_N")}
    along = np.array([math.cos(slope), math.sin(slope)])
    up = np.array([-math.sin(slope), math.cos(slope)])
    contacts = [-(pose["d"] + k * pose["p"]) * along for k in range(3)]
    back, front = stability_margin(contacts, -pose["C_L"] * along + pose["C_N"] * up)
    assert back == pytest.approx(
        energy_margin_backward(alpha=alpha(**pose), theta_alpha=theta_alpha(**pose), theta_s=slope),
        abs=1e-12,
    )
    assert front == pytest.approx(
        energy_margin_forward(beta=beta(**near), theta_beta=theta_beta(**near), theta_s=slope),
        abs=1e-12,
    )


def test_margin_is_the_kernels_on_a_traverse():
    """Agreement with the kernel's rises, of the pair that carries a tilted robot."""
    outline = Outline.of(ABSOLEM, Posture(front="flat", rear="flat"))
    run = traverse(LOW, outline, step=0.05).path
    rows = np.flatnonzero(run.margins.contacts == 2)
    assert len(rows) > 10
    for row in rows:
        mine = stability_margin(
            (run.poses.rear_point[row], run.poses.front_point[row]), run.poses.placements[row, :2]
        )
        kernels = (run.margins.back_rise[row], run.margins.front_rise[row])
        assert mine == pytest.approx(kernels, abs=1e-9)


@pytest.mark.parametrize(
    ("contacts", "com"),
    [([], (0, 1)), ([(0, 0, 0)], (0, 1)), ([(0, 0)], (1,)), ([(0, math.nan)], (0, 1))],
)
def test_margin_without_meaning(contacts, com):
    with pytest.raises(InputError):
        stability_margin(contacts, com)


NOW = Angles(0.5, 0.5)
REACH = (0.1, 0.1)


def rule(predict, now=NOW, reach=REACH, threshold=0.01, limits=(-1.0, 2.0)):
    return avoid_rollover(now, predict, threshold=threshold, reach=reach, limits=limits)


def test_nothing_is_done_without_need():
    decision = rule(lambda _: (0.01, 0.01))
    assert decision.action is Action.GO
    assert decision.angles == NOW


def test_the_shortest_turn_that_restores_it_wins():
    """By hand: 40 mm/rad of front flippers lowered: 6 mm short take 0.15 rad, two strides."""
    decision = rule(lambda angles: (0.02, 0.004 - 0.04 * (angles.front - 0.5)))
    assert decision.action is Action.WAIT
    assert decision.angles.front == pytest.approx(0.5 - (0.1 + math.radians(10)), abs=1e-12)
    assert decision.angles.rear == 0.5
    assert decision.margin == 0.004


def test_of_equal_turns_the_larger_margin_wins():
    decision = rule(lambda angles: (1.0, 0.009 + 0.1 * (angles.rear - 0.5) + 0.02 * angles.front))
    assert decision.action is Action.GO  # 19 mm already
    decision = rule(lambda angles: (1.0, 0.1 * (angles.rear - 0.5) + 0.02 * (angles.front - 0.5)),
                    threshold=0.005)  # fmt: skip
    assert decision.action is Action.MOVE
    assert decision.angles == pytest.approx(Angles(0.6, 0.6), abs=1e-12)
    assert decision.margin_then == pytest.approx(0.012, abs=1e-12)  # 10 + 2, by hand


def test_where_nothing_helps_it_stops():
    decision = rule(lambda _: (0.02, 0.0))
    assert decision.action is Action.STOP
    assert decision.angles == NOW


def test_without_speed_or_flippers_it_can_only_stop():
    def predict(angles):
        return (0.02, 0.0 if angles == now else 1.0)

    for now, reach in ((NOW, (0.0, 0.0)), (Angles(None, None), REACH)):
        assert rule(predict, now=now, reach=reach).action is Action.STOP


def test_it_does_not_turn_through_a_worse_pose():
    """Lowering the front would help at last, but on the way the robot stands nearer the edge."""

    def predict(angles):
        if angles.front < 0.2:
            return (0.05, 0.05)
        return (0.008 if angles.front == 0.5 else 0.001, 0.001)

    assert rule(predict).action is Action.STOP


def test_from_below_the_threshold_it_may_turn_through_poses_no_worse():
    """By hand: from 8 mm through 9 mm to 12 mm, with 10 mm to be kept."""

    def predict(angles):
        if angles.rear != 0.5 or angles.front > 0.5:
            return (0.0, 0.0)
        here = {0: 0.008, 1: 0.009}.get(round((0.5 - angles.front) / 0.1), 0.012)
        return (here, here)

    decision = rule(predict)
    assert decision.action is Action.WAIT
    assert decision.margin_then == 0.012
    assert decision.angles.rear == 0.5


def test_joint_limits_are_kept():
    seen = []

    def predict(angles):
        seen.append(angles)
        return (0.02, 0.0)

    rule(predict, limits=(0.3, 0.55))
    assert len(seen) > 4
    assert all(0.3 <= angle <= 0.55 for each in seen for angle in each)


@pytest.mark.parametrize(
    "how",
    [{"threshold": math.nan}, {"reach": (-0.1, 0.1)}, {"limits": (1.0, 0.0)}],
)
def test_a_rule_without_meaning(how):
    with pytest.raises(InputError):
        rule(lambda _: (1.0, 1.0), **how)


def test_without_avoidance_it_drives_as_the_traverse_does():
    """Agreement: bare Absolem falls over on this flight, at the traverse's last pose."""
    drive = drive_guarded(ABSOLEM, FLIGHT, avoidance=False)
    run = traverse(FLIGHT, Outline.of(ABSOLEM), step=0.01).path
    assert drive.fell
    assert drive.status is run.status
    assert drive.x[-1] == run.x[-1]
    assert drive.inclination[-1] == run.inclination[-1]
    assert drive.margin[-1] == -math.inf
    assert set(drive.actions) == {Action.GO}


def test_with_avoidance_it_does_not_fall():
    """It gets over the flight on which it falls otherwise, and keeps the margin all the way.

    Threshold by hand: 0.4 m/s (its sheet) is worth 0.16/(2 g) = 8.158 mm.
    """
    drive = drive_guarded(ABSOLEM, FLIGHT)
    assert drive.threshold == pytest.approx(0.4**2 / (2 * STANDARD_GRAVITY), abs=1e-12)
    assert drive.arrived
    assert not drive.fell
    assert drive.margin.min() >= drive.threshold
    assert {Action.MOVE, Action.WAIT} & set(drive.actions)
    # flippers that wait take their time: pi/4 rad/s (its sheet)
    assert drive.time > len(drive.actions) * 0.02 / 0.4


def test_where_nothing_restores_it_it_is_stopped():
    drive = drive_guarded(ABSOLEM, LOW)
    assert drive.stopped
    assert not drive.fell
    assert not drive.arrived
    assert drive.status is Status.OK  # it stands
    assert drive.actions[-1] is Action.STOP
    assert drive.margin.min() >= drive.threshold


def test_without_flippers_it_stops_before_the_fall():
    """Kenaf has none: 70 degrees are beyond its 62.48 of docs/theory/contact.md."""
    steep = Profile.of_stairs(
        Stairs.inclined(angle=math.radians(70), nosing_spacing=0.150, steps=6)
    )
    kenaf = Robot.named("kenaf")
    assert drive_guarded(kenaf, steep, avoidance=False).fell
    drive = drive_guarded(kenaf, steep, steepest=math.radians(89))
    assert drive.stopped
    assert not drive.fell


@pytest.mark.parametrize(
    "how", [{"speed": 0.0}, {"step": -1.0}, {"threshold": math.inf}, {"limits": (1.0, 0.0)}]
)
def test_a_drive_without_meaning(how):
    with pytest.raises(InputError):
        drive_guarded(ABSOLEM, LOW, **how)
