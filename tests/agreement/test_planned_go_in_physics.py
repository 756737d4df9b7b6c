"""Default answers, whole plans with flippers that move and grousers, driven in MuJoCo.

Catalogue robots under a payload on flights within the codes, each step uneven by millimetres; the
answer's plan is driven from landing to landing. A GO arrives, and its inclination leaves that of
the quasi-static poses by no more than the predicted rocking and 1 deg, with grousers by what they
lift it at one nosing besides. A NO-GO that gets up rocks, near a fall.
"""

import math
from collections import Counter

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from amounts import fast_and_slow
from flippers_in_physics import Rig
from kaidan import Question, Robot, Stairs
from kaidan.assessment import with_plan
from kaidan.assessment.verdict import conclude
from kaidan.models import judge, planned
from kaidan.modes import Verdict
from kaidan.robot import Payload

BEYOND = 1.0
"""What the robot may turn more than is predicted [deg]: the proof's."""
BESIDE = 0.03
"""Way by which physics may be ahead of the pose or behind it [m]."""
LATE = 0.5
"""Way that it drives while it rotates over an edge, and until it stands again [m]."""
JUMP = 0.3
"""Rotation from one pose to the next that is one [deg]."""
STEEPEST = math.radians(38.0)
MOMENTUM = math.radians(2.0)
"""Tilt to a fall that momentum is worth at these speeds [rad]."""
ROBOTS = ["absolem", "marv", "ozbot-atr"]
SPEED = 0.2
"""[m/s]"""


def flight(rng):
    """Within the codes' rises and goings, each step off by up to some millimetres."""
    while True:
        rise, going = rng.uniform(0.13, 0.19), rng.uniform(0.25, 0.33)
        if math.atan2(rise, going) < STEEPEST and 0.55 <= 2 * rise + going <= 0.70:
            break
    n, off = int(rng.integers(4, 8)), rng.choice([0.0, 0.001, 0.0025, 0.004])
    return Stairs(
        rises=tuple((rise + rng.uniform(-off, off, n)).tolist()),
        goings=tuple((going + rng.uniform(-off, off, n - 1)).tolist()),
    )


def robot(rng, names, *, grousers):
    sheet = Robot.named(str(rng.choice(names)))
    belt = {"belt": "smooth"}
    if grousers:
        belt = {
            "belt": "grousers",
            "grouser_height": rng.uniform(0.008, 0.02),
            "grouser_spacing": rng.uniform(0.03, 0.06),
        }
    return sheet.model_copy(update={"track": sheet.track.model_copy(update=belt)})


def payload(rng, sheet):
    """Up to an eighth of the robot's mass, somewhere on its top."""
    if sheet.mass is None or rng.random() < 0.3:
        return ()
    return (
        Payload(
            mass=sheet.mass * rng.uniform(0.02, 0.125),
            from_front=sheet.track.flat_length * rng.uniform(0.1, 0.9),
            height=rng.uniform(0.2, 0.4),
        ),
    )


def questions(seed, names, *, grousers):
    """Questions as people ask them, with the answer's own plan in them, findings and verdict."""
    rng = np.random.default_rng(seed)
    while True:
        sheet = robot(rng, names, grousers=grousers)
        manner = {"friction": float(rng.uniform(0.5, 0.9) if grousers else rng.uniform(0.85, 1.3))}
        if grousers and rng.random() < 0.5:
            manner = {"surface": "concrete-dry"}
        asked = Question.ask(
            sheet,
            flight(rng),
            payload=payload(rng, sheet),
            direction=str(rng.choice(["up", "down"])),
            **manner,
        )
        question, findings, _ = with_plan(asked)
        yield question, conclude(question, findings), rng


def gos(seed, count, names, *, grousers, of=lambda question: True):
    for question, conclusion, rng in questions(seed, names, grousers=grousers):
        if not count:
            return
        if conclusion.verdict is Verdict.GO and of(question):
            count -= 1
            yield question, rng


def turns(question):
    """Whether the plan moves the flippers on the way."""
    return bool(question.changes)


def beyond_the_poses(question, ride):
    """How far inclinations leave those that are predicted about the same place [deg].

    A rotation takes its time: until it is over, what the robot turns through counts as predicted.
    """
    most = 0.0
    # on grousers it rocks where one of them leaves an edge, at most a spacing late
    beside = BESIDE + (question.robot.track.grouser_spacing or 0.0)
    for k, part in enumerate(planned.drive(question).parts):
        found = part.traverse
        x, inclination = found.path.poses.x, np.degrees(found.path.poses.inclination)
        rocks = max((each.avoidable for each in found.chains), default=0.0)
        rocks = math.degrees(max(rocks, found.criterion.turn if found.whole else 0.0))
        jumps = np.flatnonzero(np.abs(np.diff(inclination)) > JUMP)
        driven = (ride.stage == k) & (ride.x >= x[0]) & (ride.x <= x[-1])
        if question.robot.track.has_grousers:  # their contacts are soft, and pressed in as it lands
            for j in jumps.tolist():
                driven &= (ride.x < x[j] - beside) | (ride.x > x[j] + LATE)
        for at, inclined in zip(ride.x[driven], np.degrees(ride.inclination[driven]), strict=True):
            about = inclination[np.abs(x - at) < beside].tolist()
            for j in jumps[(x[jumps] - beside < at) & (at < x[jumps] + LATE)].tolist():
                about += [inclination[j], inclination[j + 1]]
            if about:
                most = max(most, inclined - max(about) - rocks, min(about) - inclined - rocks)
    return most


def lift(question):
    """What a grouser under one nosing and none under the next inclines the robot by [deg]."""
    height = question.robot.track.grouser_height or 0.0
    return math.degrees(math.atan2(height, question.profile.nosing_spacing))


def check(some, *, bars):
    """None falls, and none that arrives turns farther than is predicted; how they end."""
    ends = Counter()
    most = BEYOND
    for k, (question, _) in enumerate(some):
        ride = Rig(question, speed=SPEED, bars=bars, seed=k).ride()
        ends[ride.outcome] += 1
        assert ride.outcome != "falls", question.to_json()
        if ride.outcome == "arrives":
            most = BEYOND + (lift(question) if bars else 0.0)
            assert beyond_the_poses(question, ride) <= most, question.to_json()
    return ends


@pytest.mark.parametrize(("seed", "count"), fast_and_slow((1, 2), (12, 60)))
def test_go_with_flippers_that_move(seed, count):
    ends = check(gos(seed, count, ["absolem", "marv"], grousers=False, of=turns), bars=False)
    assert ends == {"arrives": count}


@pytest.mark.slow
def test_go_on_grousers():
    ends = check(gos(14, 30, ROBOTS, grousers=True), bars=True)
    assert ends == {"arrives": 30}


def at_a_small_tip(height, spacing, friction):
    """Absolem with grousers whose flippers press their tips against a riser."""
    sheet = Robot.named("absolem")
    belt = {"belt": "grousers", "grouser_height": height, "grouser_spacing": spacing}
    return Question.ask(
        sheet.model_copy(update={"track": sheet.track.model_copy(update=belt)}),
        Stairs(rise=0.1495, going=0.311, steps=7),
        friction=friction,
        flippers="35deg,-56deg/traverse:-75deg,-13deg",
    )


@pytest.mark.parametrize(
    ("height", "spacing", "stays", "arrives"),
    [(0.003, 0.020, 0.55, 0.61), (0.005, 0.030, 0.60, 0.65), (0.010, 0.040, 0.65, 0.70)],
)
def test_grousers_on_a_small_tip_at_a_face_ask_for_the_friction_of_the_trials(
    height, spacing, stays, arrives
):
    """docs/lab/physics.md, plans: no GO with what it stays with, and a GO with the next."""
    verdicts = []
    for friction in (stays, arrives):
        question = at_a_small_tip(height, spacing, friction)
        verdicts.append(conclude(question, judge(question)).verdict)
    assert verdicts[0] is not Verdict.GO
    assert verdicts[1] is Verdict.GO


@pytest.mark.slow
@pytest.mark.parametrize(("friction", "outcome"), [(0.6, "stays"), (0.75, "arrives")])
def test_grousers_on_a_small_tip_at_a_face_in_physics(friction, outcome):
    question = at_a_small_tip(0.010, 0.040, friction)
    assert Rig(question, speed=SPEED, bars=True).ride().outcome == outcome


def pushed_back(friction):
    """A MARV whose leading end is at a riser's face, 19 mm of grousers off it; hardly any yield."""
    sheet = Robot.named("marv")
    belt = {
        "belt": "grousers",
        "grouser_height": 0.019,
        "grouser_spacing": 0.039,
        "grouser_tip_width": 0.009,
        "grouser_hardness": 95.0,
    }
    return Question.ask(
        sheet.model_copy(update={"track": sheet.track.model_copy(update=belt)}),
        Stairs(rise=0.1875, going=0.22, steps=7, nosing_radius_low=0.017, nosing_radius_high=0.017),
        friction=friction,
        facing="tail-first",
        flippers="stowed,35deg/traverse:-25deg,-39deg/land:-28deg,-75deg",
    )


@pytest.mark.parametrize(("friction", "go"), [(0.65, False), (0.88, True)])
def test_where_grousers_push_an_end_back_it_asks_for_more_friction(friction, go):
    """docs/theory/grousers.md: rigid teeth are stuck with 0.65, and get up with 0.80."""
    question = pushed_back(friction)
    assert (conclude(question, judge(question)).verdict is Verdict.GO) == go


@pytest.mark.parametrize(("seed", "count"), fast_and_slow((21, 2), (21, 60)))
def test_no_go_fails_or_rocks_near_a_fall(seed, count):
    """What climbs at each of three speeds rocks, and keeps less than the reserve to a fall.

    The answer says that they arrive, how far they are from falling, and to expect a fall.
    """
    names = [*ROBOTS, "kenaf", "superdroid-hd2", "marmotte", "csiro-dtr", "absolem-flat"]
    for question, conclusion, _ in questions(seed, names, grousers=False):
        if conclusion.verdict is not Verdict.NO_GO:
            continue
        rides = [Rig(question, speed=speed).ride().outcome for speed in (0.1, 0.2, 0.3)]
        if rides == 3 * ["arrives"]:
            for part in planned.drive(question).parts:
                assert part.traverse.falls_downhill.tilt > -MOMENTUM, question.to_json()
        count -= 1
        if not count:
            return
