"""No GO that falls, close to the limit: tracks that yield as their sheet says.

Robots, flights and tracks are drawn within two degrees of what the allowance leaves of the rigid
margin (docs/theory/yielding.md), and driven from landing to landing in the physics.
"""

import math

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from kaidan import Question, Robot, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.modes import Verdict
from kaidan.physics import TrialSpec, YieldingBelt, run
from kaidan.robot import Track

CLOSE = math.radians(2.0)
"""How far a flight stays below the limit at most [rad]."""


def soft_gos(seed, count):
    """GOs within two degrees of what a track that yields as its sheet says leaves of the margin."""
    rng = np.random.default_rng(seed)
    while count:
        L = rng.uniform(0.45, 0.9)
        R, C_N = L * 10 ** rng.uniform(-1.7, -0.7), L * rng.uniform(0.12, 0.3)
        w_n = L * 10 ** rng.uniform(-2.7, -1.9)
        track = Track(
            flat_length=L, front_radius=R, rear_radius=R,
            indentation=w_n, sag=min(w_n / 10 ** rng.uniform(-0.8, 0.4), 0.06 * L),
        )  # fmt: skip
        robot = Robot(
            name="soft", mass=20.0, com_from_front=L * rng.uniform(0.4, 0.55), com_height=C_N,
            track=track,
        )  # fmt: skip
        manner = {
            "direction": str(rng.choice(["up", "up", "down"])),
            "facing": str(rng.choice(["nose-first", "tail-first"])),
            "speed": 10 ** rng.uniform(-1.7, -0.8),
            "theta_M": 0.0,
        }
        p, nose_up = (
            L * rng.uniform(0.27, 0.5),
            (manner["direction"] == "up") == (manner["facing"] == "nose-first"),
        )
        behind = robot.com_from_front if nose_up else L - robot.com_from_front
        steepest = math.atan2(L - p - behind, C_N)
        mu = min(math.tan(min(steepest, 1.2)) * rng.uniform(1.2, 3.0), 4.0)
        if steepest < 0.3:
            continue
        level = Stairs.inclined(angle=0.3, nosing_spacing=p, steps=6)
        loss = Question.in_one_posture(robot, level, friction=mu, **manner).allowance_d.high
        angle = steepest - loss - CLOSE * rng.random()
        if not 0.2 < angle < 1.05:
            continue
        flight = Stairs.inclined(angle=angle, nosing_spacing=p, steps=6)
        question = Question.in_one_posture(robot, flight, friction=mu, **manner)
        if conclude(question, judge(question)).verdict is Verdict.GO:
            count -= 1
            yield question, rng


def as_the_sheet_says(question, rng):
    return YieldingBelt(damping_ratio=10 ** rng.uniform(-1.4, -0.5))


def tried(seed, count):
    """Try GOs in the physics; a fall fails."""
    for k, (question, rng) in enumerate(soft_gos(seed, count)):
        track = as_the_sheet_says(question, rng)
        spec = TrialSpec(question=question, track=track, begin="landing", seed=k)
        assert not run(spec).fell, spec.model_dump_json()


def test_no_go_falls_close_to_the_limit_of_a_yielding_track():
    tried(1, 4)


@pytest.mark.slow
def test_200_gos_close_to_the_limit():
    tried(31, 50)
    tried(32, 50)
    tried(33, 50)
    tried(34, 50)
