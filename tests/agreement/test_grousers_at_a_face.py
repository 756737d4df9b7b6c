"""Ends that climb a riser's face by friction, with grousers driven round them in MuJoCo.

The rule for friction at a face under rigid grousers was fitted to trials with flipper tips of 29 mm
(docs/theory/grousers.md); here are smaller and larger ends, one riser, and other grousers: bodies
driven by servos, each on a radial spring, where those trials placed bars anew at every step.
"""

import math

import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from kaidan import Question, Robot
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.modes import Verdict
from kaidan.physics import DrivenGrousers, Outcome, TrialSpec, run
from kaidan.robot import Track
from kaidan.terrain.profile import Profile

CASES = [
    (0.015, 0.010, 0.040, 0.060),
    (0.020, 0.010, 0.040, 0.065),
    (0.040, 0.010, 0.040, 0.104),
    (0.060, 0.020, 0.060, 0.156),
]
"""Radius of the ends, height and spacing of the grousers, riser [m]; tips do not reach over it."""
STIFF = 0.004
"""Time of the contacts [s]: a fifth of the usual from a landing, with softer ones all get up."""


def question(R, h, s, riser, friction, speed=0.1):
    own = {"belt": "smooth"}
    if h:
        own = {"belt": "grousers", "grouser_height": h, "grouser_spacing": s}
    sheet = Robot(
        name="own",
        mass=20.0,
        com_from_front=0.30,
        com_height=0.07,
        track=Track(flat_length=0.70, front_radius=R, rear_radius=R, **own),
    )
    # a trial ends behind a second nosing
    ground = [[0, 0], [2, 0], [2, riser], [3, riser], [3, riser + 0.016], [5, riser + 0.016]]
    return Question.in_one_posture(sheet, Profile.of_points(ground), friction=friction, speed=speed)


def go_from(*case):
    """Least friction of a GO, to 0.005."""
    low, high = 0.3, 4.0
    while high - low > 0.005:
        middle = (low + high) / 2
        asked = question(*case, middle)
        if conclude(asked, judge(asked)).verdict is Verdict.GO:
            high = middle
        else:
            low = middle
    return high


@pytest.mark.parametrize("height", [0.0, 1.0])
@pytest.mark.parametrize("case", CASES)
def test_friction_of_a_go_by_hand(case, height):
    """Level on the floor, the end against the face: all of the floor's friction presses it there.

    mu N_r = N_f, N_r + mu' N_f = W, and torque about the rear contact.
    """
    R, h, s, riser = case
    h *= height
    share = 1 / (1 + h / R) ** 2  # mu' / mu
    behind, ahead = 0.70 - 0.30, 0.30 + R
    by_hand = (-R + math.sqrt(R * R + 4 * share * ahead * behind)) / (2 * share * ahead)
    assert go_from(R, h, s, riser) == pytest.approx(by_hand, abs=0.006)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_a_go_gets_up_at_a_tenth_of_a_metre_a_second(case):
    asked = question(*case, 1.05 * go_from(*case))
    trial = TrialSpec(
        question=asked, track=DrivenGrousers(), begin="landing", seed=0, contact_time=STIFF
    )
    assert run(trial).outcome is Outcome.CLIMBED
