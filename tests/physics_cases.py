"""Kenaf as the acceptance of the physics models takes it: R, mass and inertia are guesses."""

import math
from functools import cache

import pytest

from kaidan.physics import Outcome, TrialSpec, run
from kaidan.question import Question
from kaidan.robot import Robot, Track
from kaidan.terrain.stairs import Stairs

SPACINGS = (0.150, 0.180, 0.200, 0.220)
"""Of the paper's verification test [m]."""
ENDS_IN_EVERY_RUN = [
    pytest.param(each, marks=pytest.mark.slow if each in SPACINGS[1:3] else ()) for each in SPACINGS
]
"""Two of them in every run, all among the slow tests."""
FORMULA = dict(zip(SPACINGS, (60.205, 52.936, 46.185, 37.255), strict=True))
"""theta_s_sup = atan((L - p - C_L)/C_N) [deg]."""
QUASI_STATIC = dict(zip(SPACINGS, (62.48, 57.70, 53.85, 49.31), strict=True))
"""Contact model, grade two, R = 60 mm, converged (docs/theory/contact.md) [deg]."""


def robot(radius=0.06, **track):
    return Robot(
        name="kenaf-like",
        com_from_front=0.196,
        com_height=0.071,
        mass=20.0,
        inertia=0.45,
        track=Track(flat_length=0.470, front_radius=radius, rear_radius=radius, **track),
    )


def spec(angle, spacing=0.150, *, radius=0.06, **fields):
    """Trial at an angle [deg]; the start is the same for all. Fields of it, or of its question."""
    trial = {name: fields.pop(name) for name in TrialSpec.model_fields if name in fields}
    stairs = Stairs.inclined(angle=math.radians(angle), nosing_spacing=spacing)
    sheet, terrain = fields.pop("robot", robot(radius)), fields.pop("terrain", stairs)
    question = Question.in_one_posture(sheet, terrain, **fields)
    return TrialSpec(**{"question": question, "start_offset": 0.3, "seed": 0} | trial)


def outcome(angle, spacing=0.150, **fields):
    return run(spec(angle, spacing, **fields)).outcome


def climbs_up_to(low, high, spacing, *, fall=Outcome.FELL_BACKWARD, **fields):
    """Whether the margin lies between two angles [deg]: it climbs the one and fails the other."""
    return outcome(low, spacing, **fields) is Outcome.CLIMBED and (
        outcome(high, spacing, **fields) is fall
    )


@cache
def margin(spacing, *, low=35.0, high=80.0, within=0.05, **fields):
    """Steepest slope that it climbs [deg], by bisection; several tests ask for the same one."""
    while high - low > within:
        middle = (low + high) / 2
        if outcome(middle, spacing, **fields) is Outcome.CLIMBED:
            low = middle
        else:
            high = middle
    return (low + high) / 2
