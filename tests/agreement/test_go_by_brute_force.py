"""Every GO on irregular flights, gaps and kerbs against the brute force of small drives and turns.

The same flow as in `test_tilted_gravity`, which knows neither criterion nor rocking: a robot that
is a GO arrives, and turns nowhere farther than the answer says, nose up or nose down.
"""

import math

import numpy as np
import pytest
from test_tilted_gravity import brute

from amounts import fast_and_slow
from kaidan import Question, Robot, Stairs, assess
from kaidan.assessment.plan_search import off_angles
from kaidan.assessment.verdict import conclude
from kaidan.models import contact_model, planned
from kaidan.modes import Verdict
from kaidan.robot import Track
from kaidan.terrain.profile import Profile
from kaidan.traversal.rotations import ROCKING

OVER = math.radians(0.15)
"""What small turns and round ends add [rad]."""


def robots(rng):
    L, R = rng.uniform(0.5, 0.9), rng.uniform(0.1, 0.14)
    gap = L * rng.uniform(0.1, 0.4) if rng.random() < 0.3 else 0.0
    return Robot(
        name="any",
        com_from_front=L * rng.uniform(0.35, 0.6),
        com_height=rng.uniform(0.12, 0.3) * L,
        track=Track(flat_length=L, front_radius=R, rear_radius=R, gap=gap),
    )


def terrains(rng, L):
    """No face is higher than an end's radius: from above the robot jumps no wall."""
    kind = rng.random()
    if kind < 0.6:
        n, uneven = int(rng.integers(5, 10)), rng.choice([0.001, 0.003, 0.006])
        rise = rng.uniform(0.06, 0.09)
        going = rise / math.tan(rng.uniform(0.35, 0.8))
        rises = rise + rng.uniform(-uneven, uneven, n)
        goings = np.maximum(going + rng.uniform(-uneven, uneven, n - 1), 0.03)
        return Stairs(rises=tuple(rises.tolist()), goings=tuple(goings.tolist()))
    h, x = rng.uniform(0.02, 0.095), rng.uniform(0.1, 1.2) * L
    if kind < 0.75:  # a kerb, or two
        second = h + rng.uniform(-0.5, 1.0) * h
        return Profile.of_points([(-3, 0), (0, 0), (0, h), (x, h), (x, second), (x + 3, second)])
    if kind < 0.9:  # a gap in the floor
        x = rng.uniform(0.05, 0.6) * L
        return Profile.of_points([(-3, 0), (0, 0), (0, -h), (x, -h), (x, 0), (x + 3, 0)])
    bumps = [(0.3 * k + rng.uniform(0, 0.2), rng.uniform(0.0, 0.06)) for k in range(5)]
    return Profile.of_points([(-3, 0), (-0.2, 0), *bumps, (1.8, 0), (4.8, 0)])


def turns_farther(found):
    """Whether a robot that is a GO turns by more than the rig did, by inclination alone none."""
    turn = found.criterion.turn if found.whole else 0.0
    return max((turn, *(chain.avoidable for chain in found.chains))) > ROCKING


def gos(seed, count, of=lambda found: True):
    rng = np.random.default_rng(seed)
    while count:
        robot = robots(rng)
        question = Question.in_one_posture(
            robot, terrains(rng, robot.track.flat_length), friction=3.0
        )
        found = contact_model.judge(question)
        if conclude(question, found).verdict is Verdict.GO and of(found.basis.traverse):
            count -= 1
            yield question, found.basis.traverse


FINER = (2.0, 8.0, 32.0)
"""Refinements, one after the other: what turns as it drives turns less in each smaller drive."""


def on_grousers(name):
    sheet = Robot.named(name)
    belts = {"belt": "grousers", "grouser_height": 0.010, "grouser_spacing": 0.040}
    return sheet.model_copy(update={"track": sheet.track.model_copy(update=belts)})


def planned_gos(asked):
    """Parts of the plans that are a GO, at their angles and off them, once they are on the flight.

    Before, the first riser is higher than an end's radius, and the brute force jumps it.
    """
    for robot, stairs, manner in asked:
        answer = assess(robot, stairs, **manner)
        assert answer.verdict == Verdict.GO.value
        for question in (answer.question, *off_angles(answer.question)):
            for part in planned.drive(question).parts[1:]:
                yield part.question, part.traverse


def check(some):
    for question, found in some:
        turn = found.criterion.turn if found.whole else 0.0
        told = {True: turn, False: turn}
        for chain in found.chains:
            for each in chain.rotations:
                side = each.leading_end_down
                told[side] = max(told[side], chain.angle)
        for finer in FINER:
            outcome, up, down = brute(found, 0.0, finer)
            if outcome == 0.0 and up <= told[False] + OVER and down <= told[True] + OVER:
                break
        else:
            turns = [math.degrees(each) for each in (up, told[False], down, told[True])]
            pytest.fail(f"outcome {outcome}, turns and what was told {turns}: {question.to_json()}")


def test_go_by_brute_force():
    check(gos(seed=1, count=10))


def test_planned_go_by_brute_force():
    check(planned_gos([(on_grousers("absolem"), "ibc", {"surface": "concrete-dry"})]))


@pytest.mark.slow
def test_many_planned_gos_by_brute_force():
    slopes = {"ibc": 0.8, "uk-general": 0.8, "din-general": 0.9, "uk-utility": 0.9}
    ways = [{"friction": friction, "direction": way} for friction in (1.0, 1.2)
            for way in ("up", "down")]  # fmt: skip
    check(planned_gos([(on_grousers("marv"), "ibc", {"surface": "concrete-dry"})]))
    check(planned_gos([("absolem", stairs, {"friction": mu}) for stairs, mu in slopes.items()]))
    check(planned_gos([("absolem", "ibc-dwelling", way) for way in ways]))


SOON = (3, 7, 27)
"""Seeds of which one of the first four questions is such a GO, as one of a hundred is."""


@pytest.mark.parametrize(("seeds", "count"), fast_and_slow((SOON, 1), ((4,), 300)))
def test_go_that_turns_farther_than_the_rig_by_brute_force(seeds, count):
    """From one side of the mean slope to the other: docs/theory/uneven.md."""
    for seed in seeds:
        check(gos(seed, count, turns_farther))


@pytest.mark.slow
def test_2000_go_by_brute_force():
    check(gos(seed=2, count=2000))
