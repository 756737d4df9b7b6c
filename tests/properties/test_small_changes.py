"""Flights that differ by a micrometre have one answer: no verdict and no margin may jump."""

import math

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.catalog import names
from kaidan.models import contact_model
from kaidan.modes import DRIVE, FALLS, MOMENTUM, SLIDES_DOWN, SLIDES_UP, TIPS
from kaidan.robot import Drive, Track
from kaidan.traversal import traverse
from kaidan.traversal.tilting import WITHIN
from question_cases import random_robot

LIMITS = {  # degrees: the project's own target; of traction see docs/theory/contact.md
    **dict.fromkeys(TIPS, 0.01),
    **dict.fromkeys((SLIDES_DOWN, SLIDES_UP), 0.012),  # one of 300: risers change by 2 um in all
    **dict.fromkeys(FALLS, math.degrees(WITHIN) + 0.01),  # to the width of its bisection
    DRIVE: 0.03,  # 2 of 300 beyond 0.01: a nosing 2 um too high meets the front arc before the flat
    MOMENTUM: math.degrees(4e-4),  # 0.4 mm: one of 300, that comes to rest on another nosing
}
FAR = math.radians(45.0)
"""Margin beyond which nothing depends on it: of robots as long as the flight, uphill."""


def pairs(seed, count, size):
    """The same question on two flights whose rises and goings differ by up to `size` each."""
    rng = np.random.default_rng(seed)
    catalogue = [Robot.named(name) for name in names("robots")]
    while count:
        known = rng.random() < 0.6
        robot = catalogue[rng.integers(len(catalogue))] if known else random_robot(rng)
        L, n = robot.track.flat_length, int(rng.integers(6, 11))
        rise, going = rng.uniform(0.14, 0.22), rng.uniform(0.22, 0.32)
        if robot.name in ("any", "kenaf"):
            shrink = L / rng.uniform(1.8, 0.8 * n - 2.0) / math.hypot(rise, going)
            rise, going = rise * shrink, going * shrink
        uneven = rng.choice([0.0, 0.0, 0.001, 0.003])
        rises = rise + rng.uniform(-uneven, uneven, n)
        goings = going + rng.uniform(-uneven, uneven, n - 1)
        change = size * np.where(np.arange(n) % 2, 1.0, -1.0), rng.uniform(-size, size, n - 1)
        try:
            flights = [
                Stairs(rises=tuple(each[0].tolist()), goings=tuple(each[1].tolist()))
                for each in ((rises, goings), (rises + change[0], goings + change[1]))
            ]
        except ValueError:  # too small a step
            continue
        manner = {
            "direction": str(rng.choice(["up", "down"])),
            "facing": str(rng.choice(["nose-first", "tail-first"])),
            "flippers": str(rng.choice(["stowed", "flat"])) if robot.flippers() else "stowed",
            "friction": float(rng.uniform(0.6, 1.5)),
        }
        yield [Question.in_one_posture(robot, each, **manner) for each in flights]
        count -= 1


def check(seed, count, size, limits):
    for questions in pairs(seed, count, size):
        one, other = (contact_model.judge(each) for each in questions)
        verdicts = [conclude(*each).verdict for each in zip(questions, (one, other), strict=True)]
        assert verdicts[0] == verdicts[1], questions[0]
        for mine in one.each:
            theirs = other.of(mine.mode)
            assert theirs is not None
            if mine.mode in limits:
                each = float(mine.worst.min()), float(theirs.worst.min())
                if min(map(abs, each)) < FAR:
                    jump = math.degrees(abs(each[0] - each[1]))
                    assert jump <= limits[mine.mode], (mine.mode.key, each, questions[0])


def test_a_micrometre_changes_nothing():
    check(seed=1, count=12, size=1e-6, limits=LIMITS)


@pytest.mark.slow
def test_a_micrometre_changes_nothing_of_300_questions():
    check(seed=2, count=300, size=1e-6, limits=LIMITS)


def test_a_rotation_that_the_rubber_takes_up_has_no_momentum():
    """Down 1 um more and less it turns by 0.0002 deg at every other step: only the edge counts."""
    robot, even = Robot.named("absolem-flat"), Stairs.named("ibc")
    found = []
    for um in (0.0, 1e-6):
        rises = even.rise + um * np.where(np.arange(even.steps) % 2, 1.0, -1.0)
        flight = Stairs(rises=tuple(rises.tolist()), goings=(even.going,) * (even.steps - 1))
        question = Question.in_one_posture(robot, flight, friction=1.5, direction="down")
        found.append(contact_model.judge(question))
    one, other = (each.of(MOMENTUM) for each in found)
    small = [each for each in found[1].basis.traverse.chains if each.angle < math.radians(0.001)]
    assert small  # they are told, with 10 mm less to climb
    tilts = (question.allowance_d.high,) * 2
    less = min(each.spare(tilts) for each in small) - question.momentum_threshold()
    assert less < other.worst[0] - 0.01
    assert other.worst[0] == pytest.approx(one.worst[0], abs=1e-5)
    assert other.phase is one.phase


def test_what_is_braked_over_a_micrometre_requires_no_drive():
    """The front meets the landing while the rear contact is a nosing far ahead: for 3 um."""
    robot = Robot(
        name="brakes", mass=40.0, com_from_front=0.53, com_height=0.408,
        drive=Drive(max_traction=441),
        track=Track(flat_length=1.103, front_radius=0.098, rear_radius=0.107),
    )  # fmt: skip
    even = np.full(9, 0.13067), np.full(8, 0.18796)
    um = np.where(np.arange(9) % 2, 1e-6, -1e-6), 1e-6 * np.array([-1, -1, 0, 0, -1, 1, 0, 0])
    margins = []
    for k in (0.0, 1.0):
        flight = Stairs(
            rises=tuple((even[0] + k * um[0]).tolist()),
            goings=tuple((even[1] + k * um[1]).tolist()),
        )
        question = Question.in_one_posture(
            robot, flight, friction=1.0, direction="down", facing="tail-first"
        )
        found = contact_model.judge(question)
        margins.append(float(found.of(DRIVE).worst[0]))
    raw = np.abs(found.basis.traverse.path.margins.traction).max() / 9.80665
    assert raw > found.basis.traverse.phases[1].traction_over_weight + 0.1  # it does brake there
    assert margins[0] == pytest.approx(margins[1], abs=math.radians(0.1))


def test_the_first_rock_does_not_depend_on_where_poses_stand():
    """MARV rocks as a flat leaves a nosing that it only rocks onto: no event of the path."""
    marv = Robot.named("marv")
    rises = (0.18745, 0.18682, 0.18804, 0.18765, 0.18700, 0.18790, 0.18720, 0.18760)
    goings = (0.22029, 0.22005, 0.21938, 0.22010, 0.21990, 0.22040, 0.21960)
    question = Question.in_one_posture(
        marv, Stairs(rises=rises, goings=goings), friction=1.2, flippers="flat"
    )
    margins = [
        traverse(question.profile, question.outline, step=step).phases[1].tilt_downhill[0]
        for step in (4e-3, 3e-4)
    ]
    assert margins[0] == pytest.approx(margins[1], abs=math.radians(0.01))
