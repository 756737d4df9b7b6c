"""Grousers: the rule against rigid teeth at rest on rounded steps, and against MuJoCo's."""

import math

import numpy as np
import pytest
from rigid_teeth import Steps, Teeth, slip

from kaidan.contact import Grousers
from kaidan.models.quasi_static import traverse_of
from kaidan.physics import Outcome, TrialSpec, run
from kaidan.physics.tracks import DrivenGrousers
from kaidan.question import Question
from kaidan.robot import Robot, Track
from kaidan.terrain.stairs import Stairs

WITHIN = 1.07
"""Spacings in which the teeth hold: a thirtieth for the grid, and what the other nosing's teeth
incline the belt."""
MORE = 0.01
"""Friction beyond the required one: arcs of twelve edges turn a normal by 4 degrees at most, and
pairs stand on one edge or the next."""


def drawn(seed):
    """Robot that tips nowhere, its grousers, and steps."""
    rng = np.random.default_rng(seed)
    while True:
        angle, p = math.radians(rng.uniform(25, 48)), rng.uniform(0.25, 0.36)
        L, h, s = rng.uniform(2.1, 4) * p, rng.uniform(0.003, 0.02), rng.uniform(0.015, 0.08)
        r, w = rng.uniform(0.001, 0.025), rng.uniform(0.1, 0.4) * s
        C_N, C_L = rng.uniform(0.08, 0.25), rng.uniform(0.35, 0.65) * L
        tips = (L - p - C_L) / C_N <= math.tan(angle) + 0.05 or C_L + C_N * math.tan(angle) <= p
        if h <= 0.6 * s and not tips:
            return rng, Teeth(L, C_L, C_N, h, s, w), Steps(angle, p, r, count=24)


def required(teeth, steps):
    """Places of the centroid on the flight and the friction that the rule requires there."""
    robot = Robot(
        name="teeth", com_from_front=teeth.C_L, com_height=teeth.C_N, mass=20.0,
        track=Track(flat_length=teeth.L, front_radius=0.05, rear_radius=0.05),
    )  # fmt: skip
    flight = Stairs.inclined(
        angle=steps.angle, nosing_spacing=steps.spacing,
        steps=max(8, int(2 * teeth.L / steps.spacing) + 5),
    )  # fmt: skip
    found = traverse_of(Question.in_one_posture(robot, flight))
    grousers = Grousers(teeth.height, teeth.spacing, teeth.width, steps.radius, rigid=True)
    nothing = (0.0, 0.0, 0.0)
    margin = found.grip.with_grousers(nothing, grousers, found.grip.by_friction(nothing))
    rows = np.flatnonzero(found.phase_of_pose == "traverse")
    return found.path.x[rows], np.tan(np.maximum(-margin[rows], 0.0))


def slips(seeds, places, phases):
    """Slips of random cases [spacings], where grousers make a difference."""
    found = []
    for seed in seeds:
        rng, teeth, steps = drawn(seed)
        x, friction = required(teeth, steps)
        for k in rng.choice(len(x), min(places, len(x)), replace=False):
            if friction[k] >= 0.98 * math.tan(steps.angle):
                continue
            at = x[k] % (steps.spacing * math.cos(steps.angle))
            for phase in rng.uniform(0, 1, phases):
                down = slip(
                    teeth, steps, phase, at, friction[k] + MORE, most=1.4, grid=teeth.spacing / 30
                )
                found.append((down / teeth.spacing, seed))
    return found


def test_rigid_teeth_hold_within_a_spacing_where_the_rule_says_so():
    # oracle
    found = slips(range(1010, 1020), 2, 2)
    assert len(found) >= 25
    assert max(found)[0] < WITHIN


@pytest.mark.slow
def test_rigid_teeth_hold_within_a_spacing_in_many_cases():
    # oracle
    found = slips(range(2000, 2300), 3, 5)
    assert len(found) >= 3000
    beyond = [each for each in found if each[0] > WITHIN]
    assert not [each for each in beyond if math.isinf(each[0])]
    assert len(beyond) <= 0.002 * len(found)


@pytest.mark.parametrize("friction", [0.2, 0.4, 0.6])
def test_a_smooth_belt_slides_for_good_below_the_slope(friction):
    # limit
    belt, steps = Teeth(1.141, 0.599, 0.18, 0.0, 0.040, 0.006), Steps(0.7, 0.331, 0.005)
    assert slip(belt, steps, 0.0, 0.1, friction, most=1.0, grid=0.01) == math.inf
    assert slip(belt, steps, 0.0, 0.1, math.tan(0.7) + 0.02) == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("angle", [32.5, 38.0, 44.0])
@pytest.mark.parametrize(("h", "s"), [(0.010, 0.040), (0.005, 0.040), (0.003, 0.020)])
@pytest.mark.parametrize("friction", [0.3, 0.6])
def test_driven_grousers_in_mujoco_do_not_slide_where_the_rule_says_so(angle, h, s, friction):
    # their tips are round with half their height: as sharp ones on nosings of that radius
    robot = Robot(
        name="long", com_from_front=0.54, com_height=0.12, mass=38.7, inertia=3.0,
        track=Track(
            flat_length=1.141, front_radius=0.08, rear_radius=0.08, grouser_height=h,
            grouser_spacing=s,
        ),
    )  # fmt: skip
    flight = Stairs.inclined(angle=math.radians(angle), nosing_spacing=0.32)
    question = Question.in_one_posture(robot, flight, friction=friction)
    found = traverse_of(question)
    phi = (math.atan(friction),) * 3
    grousers = Grousers(h, s, h / 2, h / 2, rigid=True)
    held = found.grip.with_grousers(phi, grousers, found.grip.by_friction(phi))
    if held[found.phase_of_pose == "traverse"].min() > 0:
        trial = TrialSpec(question=question, track=DrivenGrousers(), start_offset=0.3, seed=0)
        assert run(trial).outcome is Outcome.CLIMBED
