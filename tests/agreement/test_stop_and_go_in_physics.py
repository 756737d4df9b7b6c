"""GO with little energy margin, stopped and set going again at random: none falls.

Robots and flights are drawn, of which the energy margin is less than the whole kinetic energy of
the belts' speed, but more than what a sudden stop or start leaves to a rotation
(docs/theory/measures.md). Belts yield in the physics, stop and run all at once.
"""

import math

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from amounts import fast_and_slow
from kaidan import Question, Robot, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.modes import ENERGY, Verdict
from kaidan.physics import TrialSpec, YieldingBelt, planar, run
from kaidan.physics.belt_speed import Belt
from kaidan.robot import Track

GRAVITY = 9.80665
SHORTEST, LONGEST = 0.05, 1.0
"""Time between two changes of the belts' speed [s]."""


class StopAndGo(Belt):
    """Belt that stops and runs on, all at once."""

    seed = 0

    def __init__(self, spec, course, *, at_once):
        super().__init__(spec, course, at_once=at_once)
        lasts = np.random.default_rng(self.seed).uniform(*np.log([SHORTEST, LONGEST]), 2000)
        self.changes = np.concatenate([[0.0], np.cumsum(np.exp(lasts))])
        runs = np.where(np.arange(2000) % 2 == 0, np.diff(self.changes), 0.0)
        self.ran = np.concatenate([[0.0], np.cumsum(runs)])

    def _interval(self, time):
        return int(np.searchsorted(self.changes, time, side="right")) - 1

    def speed(self, time):
        return self.lowest if self._interval(time) % 2 == 0 else 0.0

    def steady(self, time):
        return False

    def run(self, time):
        k = self._interval(time)
        since = time - self.changes[k] if k % 2 == 0 else 0.0
        return self.lowest * (self.ran[k] + since)


def gos(seed, count):
    """GO with an energy margin below all of v^2/2g; nothing is known of how their tracks yield."""
    rng = np.random.default_rng(seed)
    while count:
        L, R = rng.uniform(0.45, 0.9), rng.uniform(0.05, 0.12)
        C_L, C_N = L * rng.uniform(0.35, 0.6), L * rng.uniform(0.1, 0.3)
        direction = str(rng.choice(["up", "down"]))
        facing = str(rng.choice(["nose-first", "tail-first"]))
        p, nose_up = L * rng.uniform(0.25, 0.47), (direction == "up") == (facing == "nose-first")
        steepest = math.atan2(L - p - (C_L if nose_up else L - C_L), C_N)
        angle = steepest - math.radians(rng.uniform(2.8, 11.2))
        if not 0.35 < angle < 1.0:
            continue
        off, n = rng.choice([0.0, 0.001, 0.003]), int(L / p) + 5
        rises = p * math.sin(angle) + rng.uniform(-off, off, n)
        goings = p * math.cos(angle) + rng.uniform(-off, off, n - 1)
        robot = Robot(
            name="any",
            mass=rng.uniform(10.0, 60.0),
            com_from_front=C_L,
            com_height=C_N,
            track=Track(flat_length=L, front_radius=R, rear_radius=R),
        )
        question = Question.in_one_posture(
            robot,
            Stairs(rises=tuple(rises.tolist()), goings=tuple(goings.tolist())),
            friction=3.0,
            speed=float(np.exp(rng.uniform(*np.log([0.05, 0.6])))),
            direction=direction,
            facing=facing,
        )
        found = judge(question)
        energy = found.of(ENERGY)
        if energy is None or conclude(question, found).verdict is not Verdict.GO:
            continue
        if energy.worst[0] + question.energy_threshold() < question.kinetic_height:
            count -= 1
            yield question, rng


@pytest.mark.parametrize(("seed", "count"), fast_and_slow((1, 3), (12, 150)))
def test_no_go_falls_that_is_stopped_and_set_going(seed, count, monkeypatch):
    monkeypatch.setattr(planar, "Belt", StopAndGo)
    for k, (question, rng) in enumerate(gos(seed, count)):
        monkeypatch.setattr(StopAndGo, "seed", k)
        track = YieldingBelt(
            stiffness=question.robot.mass * GRAVITY / rng.uniform(0.001, 0.006),
            shear_ratio=math.exp(rng.uniform(*np.log([0.3, 3.0]))),
        )
        begin = str(rng.choice(["landing", "flight"]))
        spec = TrialSpec(question=question, track=track, begin=begin, seed=k, nosings=6)
        assert not run(spec).fell, spec.model_dump_json()
