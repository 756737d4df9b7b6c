"""No GO that falls: the contact model's GO on uneven flights, tried with tracks that yield or grip.

Robots, flights and tracks are drawn; the steps differ by 5 mm either way, and the contact model
knows them. What it gives a GO is driven from landing to landing in the physics, which shares no
line with it: once on rubber that presses in and shears, once with grousers driven in MuJoCo.
"""

import math
from collections import Counter

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from kaidan import Question, Robot, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.modes import Verdict
from kaidan.physics import DrivenGrousers, TrialSpec, YieldingBelt, run
from kaidan.robot import Track

UNEVEN = 0.005
"""A step's rise and going differ from the others' by so much at most [m]."""
GRAVITY = 9.80665


def sheet(rng, *, grousers):
    L, R = rng.uniform(0.45, 0.9), rng.uniform(0.05, 0.12)
    own = {}
    if grousers:
        own = {
            "belt": "grousers",
            "grouser_height": rng.uniform(0.005, 0.02),
            "grouser_spacing": rng.uniform(0.025, 0.06),
        }
    return Robot(
        name="any",
        mass=rng.uniform(10.0, 60.0),
        com_from_front=L * rng.uniform(0.4, 0.55),
        com_height=L * rng.uniform(0.12, 0.3),
        track=Track(flat_length=L, front_radius=R, rear_radius=R, **own),
    )


def flight(rng):
    n = int(rng.integers(4, 8))
    rise = rng.uniform(0.08, 0.19)
    going = rise / math.tan(rng.uniform(0.35, 0.95))
    rises = rise + rng.uniform(-UNEVEN, UNEVEN, n)
    goings = np.maximum(going + rng.uniform(-UNEVEN, UNEVEN, n - 1), 0.05)
    return Stairs(rises=tuple(rises.tolist()), goings=tuple(goings.tolist()))


def gos(seed, count, *, grousers):
    """Questions that are a GO, with a generator for their tracks."""
    rng = np.random.default_rng(seed)
    while count:
        # without grousers friction holds, so that tipping decides
        friction, speed = (0.8, float(rng.uniform(0.1, 0.4))) if grousers else (3.0, None)
        question = Question.in_one_posture(
            sheet(rng, grousers=grousers),
            flight(rng),
            friction=friction,
            speed=speed,
            direction=str(rng.choice(["up", "down"])),
            facing=str(rng.choice(["nose-first", "tail-first"])),
        )
        found = judge(question)
        if conclude(question, found).verdict is Verdict.GO:
            count -= 1
            yield question, rng


def yielding(question, rng):
    """Rubber that the robot's weight on one nosing presses in by 1 to 6 mm."""
    weight = question.robot.mass * GRAVITY
    return YieldingBelt(
        stiffness=weight / rng.uniform(0.001, 0.006),
        shear_ratio=math.exp(rng.uniform(math.log(0.3), math.log(3.0))),
    )


def gripping(question, rng):
    return DrivenGrousers()


def tried(seed, count, track, *, grousers):
    """Outcomes of trials of what is a GO; a fall fails."""
    ends = Counter()
    for k, (question, rng) in enumerate(gos(seed, count, grousers=grousers)):
        spec = TrialSpec(question=question, track=track(question, rng), begin="landing", seed=k)
        result = run(spec)
        ends[result.outcome.value] += 1
        assert not result.fell, spec.model_dump_json()
    return ends


def test_no_go_falls_where_tracks_yield():
    tried(1, 6, yielding, grousers=False)


@pytest.mark.slow
def test_700_gos_where_tracks_yield():
    """676 arrive; 24 hop on the spot at a riser, where friction is 3."""
    assert tried(3, 700, yielding, grousers=False)["climbed"] > 650


@pytest.mark.slow
def test_30_gos_with_grousers():
    assert tried(17, 30, gripping, grousers=True)["climbed"] >= 28


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_marmotte_has_no_allowance_to_spare(seed):
    """What `docs/theory/rocking.md` says of its 4 degrees to a fall on the IBC's flight."""
    ibc = Stairs.named("ibc")
    ends = []
    for steeper in (0.0, 2.6, 5.2):
        angle = ibc.angle + math.radians(steeper)
        steps = Stairs.inclined(angle=angle, nosing_spacing=ibc.nosing_spacing, steps=8)
        question = Question.of("marmotte", steps, friction=1.2, speed=0.1, model="physics")
        ends.append(run(TrialSpec(question=question, begin="landing", seed=seed)).fell)
    assert ends == [False, False, True]
