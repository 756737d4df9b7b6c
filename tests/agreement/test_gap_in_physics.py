"""Robots whose track has a gap: what is a GO climbs in MuJoCo, and what jams there is none.

Robots and flights are drawn, rises 80 to 190 mm within 54 deg; a GO is driven from landing to
landing with 25 % more friction than it requires. Without `kaidan.models.gap` half of those going
up jam, mostly as they land; without a gap none of 160 does.
"""

import math

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from amounts import fast_and_slow
from kaidan import Question, Robot, Stairs, assess
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.modes import GAP_JAM, Verdict
from kaidan.physics import Outcome, TrialSpec, run
from kaidan.robot import Track
from kaidan.surface import Surface

SPARE = 1.25
"""Friction over what is required [1]."""
SPEED = 0.1
"""[m/s]"""


def robot(rng):
    L = rng.uniform(0.5, 1.0)
    gap = rng.uniform(0.2, 0.7) * L
    front, rear = np.minimum(rng.uniform(0.03, 0.16, 2), (L - gap) / 2).tolist()
    return Robot(
        name="gapped",
        mass=rng.uniform(10.0, 60.0),
        com_from_front=L * rng.uniform(0.3, 0.65),
        com_height=L * rng.uniform(0.1, 0.3),
        track=Track(flat_length=L, gap=gap, front_radius=front, rear_radius=rear),
    )


def flight(rng):
    n, rise, off = int(rng.integers(4, 9)), rng.uniform(0.08, 0.19), rng.choice([0.0, 0.002, 0.005])
    going = rise / math.tan(rng.uniform(0.35, 0.95))
    goings = np.maximum(going + rng.uniform(-off, off, n - 1), 0.05)
    return Stairs(
        rises=tuple((rise + rng.uniform(-off, off, n)).tolist()), goings=tuple(goings.tolist())
    )


def with_friction_to_spare(seed):
    """Questions of robots with a gap, two of three going up, and what is found of each."""
    rng = np.random.default_rng(seed)
    while True:
        question = Question.in_one_posture(
            robot(rng),
            flight(rng),
            friction=4.0,
            speed=SPEED,
            direction=str(rng.choice(["up", "up", "down"])),
            facing=str(rng.choice(["nose-first", "tail-first"])),
        )
        needed = judge(question).required_friction
        if SPARE * needed < 4.0:
            question = question.changed(surface=Surface.of_friction(SPARE * needed))
            yield question, judge(question)


def outcome(question, seed=0):
    return run(TrialSpec(question=question, begin="landing", seed=seed)).outcome


@pytest.mark.parametrize(("seed", "count"), fast_and_slow((1, 3), (2, 25)))
def test_a_go_with_a_gap_climbs(seed, count):
    for question, found in with_friction_to_spare(seed):
        if conclude(question, found).verdict is not Verdict.GO:
            continue
        assert outcome(question, seed=count) is Outcome.CLIMBED, question.to_json()
        count -= 1
        if not count:
            return


def sheet(L, gap, front, rear, along, up):
    """Robot of 20 kg; lengths in mm."""
    L, gap, front, rear, along, up = (1e-3 * each for each in (L, gap, front, rear, along, up))
    track = Track(flat_length=L, gap=gap, front_radius=front, rear_radius=rear)
    return Robot(name="gapped", mass=20.0, com_from_front=along, com_height=up, track=track)


JAMS = {
    "friction": (
        sheet(746, 289, 30, 40, 278, 143),
        Stairs(rise=0.160, going=0.200, steps=8),
        1.6,
        "Its track has a gap, and it needs a friction of 1.30 (traverse, step 4). Beyond 1.00 such "
        "robots jammed in simulations.",
    ),
    "face": (
        sheet(610, 162, 91, 30, 267, 76),
        Stairs(rise=0.081, going=0.117, steps=4),
        1.0,
        "Its track has a gap, and the part behind it comes against a riser (land, step 4). "
        "There such robots jammed in simulations.",
    ),
}


@pytest.mark.parametrize("case", JAMS)
def test_what_jams_because_of_its_gap_is_no_go(case):
    """Both stand still on the last step, however much friction there is; without a gap they climb.

    The first is the one with which a gap was found to jam; both were a GO.
    """
    robot, stairs, friction, reason = JAMS[case]
    whole = robot.model_copy(update={"track": robot.track.model_copy(update={"gap": 0.0})})
    answers = [assess(each, stairs, friction=friction, speed=SPEED) for each in (robot, whole)]
    assert [each.verdict for each in answers] == ["unsure", "go"]
    assert (answers[0].governs, answers[0].reason) == (GAP_JAM.key, reason)
    assert assess(robot, stairs, friction=2 * friction).verdict == "unsure"
    ends = [outcome(each.question) for each in answers]
    assert ends[0] in (Outcome.SLID, Outcome.TIMED_OUT)
    assert ends[1] is Outcome.CLIMBED


def test_a_plan_of_a_robot_with_a_gap_is_a_go_with_any_friction_from_its_own_on():
    """MARV on `ibc`: friction beyond 1.0 finds no plan that requires more of it."""
    answers = [assess("marv", "ibc", friction=each) for each in (1.0, 1.5, 3.0)]
    assert [each.verdict for each in answers] == ["go"] * 3
    assert max(each.required_friction for each in answers) < 1.0
    assert {each.findings[GAP_JAM.key].holds for each in answers} == {True}
