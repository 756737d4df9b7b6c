"""Which plan is chosen, and which angles are tried, on verdicts and scores made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, contact
from kaidan.assessment import plan_finalists, plan_off_angles, plan_search, plan_sturdy
from kaidan.assessment.plan import PlanShown, PlanStep
from kaidan.assessment.plan import plan_of as plan_of_answer
from kaidan.assessment.plan_finalists import (
    Candidate,
    _best_off,
    _better,
    _may_be_better,
    _rank,
)
from kaidan.assessment.plan_hopes import Hope, Search, _along, _order
from kaidan.assessment.plan_judged import Judged
from kaidan.assessment.plan_off_angles import OffAngles, judged_off
from kaidan.assessment.plan_scores import ENOUGH, FAILED, Score
from kaidan.assessment.plan_search import _on_the_whole
from kaidan.assessment.plan_sturdy import ANY, OUT, SHORT_OF_GO, Sturdier, Worth
from kaidan.assessment.plans import (
    GENTLE,
    Plan,
    cost_of,
    cost_of_drop,
    off,
    off_angles,
    pressed,
    words,
)
from kaidan.models.findings import Finding, Findings
from kaidan.modes import FALL_DOWNHILL, POSTURE_TOLERANCE, Phase, Verdict
from kaidan.robot import Posture, Robot
from kaidan.surface import Surface

GO, ROUGH, UNSURE, NO_GO, _ = (-each.rank for each in Verdict)
ABSOLEM = Robot.named("absolem")
ONE = Robot.model_validate(ABSOLEM.model_dump() | {"rear_flippers": None})
TWO = math.radians(2.0)
LOW, HIGH = Posture(front=-0.1), Posture(front=0.3)


def asked(robot=ONE, posture=LOW, changes=(), tolerance=TWO):
    return Question.of(robot, "ibc", friction=0.9).changed(
        best_of=(), posture=posture, changes=changes, flipper_tolerance=tolerance
    )


def degrees(*angles):
    return [Posture(front=math.radians(each)) for each in angles]


# plans


def test_a_plan_changes_where_its_posture_does():
    plan = Plan("tail-first", ((Phase.ENTER, LOW), (Phase.TRAVERSE, LOW), (Phase.LAND, HIGH)))
    question = plan.question(asked(posture=HIGH))
    assert (question.facing, question.posture, question.best_of) == ("tail-first", LOW, ())
    assert [(each.before, each.posture) for each in question.changes] == [("land", HIGH)]


def test_what_changes_and_drops_have_to_gain():
    """1.5 deg a change and 5 mdeg for a degree that a flipper turns; 0.1 deg beyond 5 deg."""
    assert cost_of_drop(np.array([0.0, 5.0, 15.0])) == pytest.approx([0.0, 0.0, 1.0])
    turned = 1.5 + 0.005 * math.degrees(0.4)
    assert cost_of(ONE, [LOW, HIGH, HIGH, LOW]) == pytest.approx(2 * turned)
    both = Posture(front=-0.1, rear=0.2), Posture(front=0.3, rear=-0.1)
    assert cost_of(ABSOLEM, both) == pytest.approx(1.5 + 0.005 * math.degrees(0.7))
    assert cost_of(ONE, [LOW]) == 0


def test_postures_that_have_a_name():
    armed = Robot.model_validate(
        ONE.model_dump() | {"states": {"out": {"mass": 5.0, "forward": 0.3, "up": 0.1}}}
    )
    each = [(one.front, one.state) for one in words(armed)]
    assert each == [(None, None), ("flat", None), (None, "out"), ("flat", "out")]
    assert len(list(words(ABSOLEM))) == 4


def test_flat_flippers_are_pressed_below_the_flat_in_whole_degrees():
    flat = math.degrees(ABSOLEM.flippers()["front"].flat_angle)  # -10.48
    found = pressed(ABSOLEM, Posture(front="flat", rear=0.3), TWO)
    assert found.front == pytest.approx(math.radians(math.floor(flat - 2.0)))
    assert found.rear == 0.3
    assert pressed(ABSOLEM, Posture(front=None), TWO) == Posture(front=None)


def test_off_the_angles_every_way():
    both = Posture(front=0.1, rear=-0.2)
    found = [(round(one.front, 9), round(one.rear, 9)) for one in off(ABSOLEM, both, 0.05)]
    assert found == [(0.15, -0.15), (0.15, -0.25), (0.05, -0.15), (0.05, -0.25)]
    stowed = off(ABSOLEM, Posture(front=0.1), 0.05)  # those at their stop stay there
    assert {one.rear for one in stowed} == {None}
    land = {"before": "land", "posture": HIGH}
    ways = list(off_angles(asked(changes=(land,), tolerance=0.05)))
    assert [(one.posture.front, one.changes[0].posture.front) for one in ways] == [
        (pytest.approx(-0.05), pytest.approx(0.35)), (pytest.approx(-0.15), pytest.approx(0.25)),
    ]  # fmt: skip
    assert {one.tolerance for one in ways} == {asked(tolerance=None).tolerance}
    assert list(off_angles(asked(posture=Posture()))) == []


def shown(**given):
    usual = {"phase": "enter", "before_step": None, "flippers": "stowed", "front_deg": None,
             "rear_deg": None, "state": None, "turn_deg": None, "time_s": None,
             "torque_Nm": None}  # fmt: skip
    return PlanStep(**(usual | given))


def test_a_plan_with_nothing_to_lay_out():
    def bare(*steps):
        return PlanShown(
            facing="nose-first", flippers="", steps=steps, found=True, holds_within_deg=None,
            tried=None,
        ).bare  # fmt: skip

    assert bare(shown())
    for laid in ({"front_deg": 0.0}, {"rear_deg": 1.0}, {"state": "out"}):
        assert not bare(shown(**laid))
    assert not bare(shown(), shown())


def test_the_plan_of_an_answer():
    """Its steps, and how far off its angles it holds; of one stated posture there is none."""
    nothing, fails = (
        Findings(model="", each=each)
        for each in ((), (Finding.certain(POSTURE_TOLERANCE, -1.0, model=""),))
    )
    land = {"before": "land", "posture": HIGH}
    plan = plan_of_answer(asked(), nothing, None)
    assert (plan.found, plan.tried, plan.holds_within_deg) == (False, None, pytest.approx(2.0))
    assert plan_of_answer(asked(), fails, None).holds_within_deg == 0.0
    assert plan_of_answer(asked(posture=Posture()), nothing, None).holds_within_deg is None
    found = plan_of_answer(asked(changes=(land,)), nothing, SimpleNamespace(tried=7))
    assert (found.found, found.tried) == (True, 7)
    assert [(one.phase, one.before_step) for one in found.steps] == [
        ("enter", None), ("land", len(asked().profile.nosings)),
    ]  # fmt: skip
    assert [one.front_deg for one in found.steps] == pytest.approx(
        [math.degrees(-0.1), math.degrees(0.3)]
    )
    traverse = {"before": "traverse", "posture": HIGH}
    assert plan_of_answer(asked(changes=(traverse,)), nothing, None).steps[1].before_step == 1


# postures about a plan's


@pytest.fixture
def sturdier(monkeypatch):
    """A search about a plan, GO at front angles of some degrees; and what it judges.

    Scores promise `promised` more than there is; None: they are not looked at.
    """
    judged = []

    def of(holds, limits=(-90.0, 90.0), tolerance=2.0, promised=None):
        def worth(angle):
            at = math.degrees(angle) if isinstance(angle, float) else -50.0
            return Worth(GO if holds[0] <= at <= holds[1] else UNSURE, -abs(at - sum(holds) / 2))

        def judge(self, phase, posture):
            angle = posture.front
            judged.append(round(math.degrees(angle)) if isinstance(angle, float) else angle)
            return worth(angle)

        def hopes(self, phase, postures):
            each = (worth(one.front) for one in postures)
            return [one._replace(margin=one.margin + promised) for one in each]

        monkeypatch.setattr(Sturdier, "_judged", judge)
        monkeypatch.setattr(Sturdier, "_held", lambda self, phase, posture: ANY)
        monkeypatch.setattr(Sturdier, "_hopes", hopes)
        question = asked(tolerance=math.radians(tolerance))
        scores = SimpleNamespace(question=question, facing="nose-first")
        low, high = map(math.radians, limits)
        search = Sturdier(scores, (low, high), None)
        if promised is None:
            search._scored = None
        return search, judged

    return of


def plan_of(*angles):
    each = degrees(*angles)
    return Plan("nose-first", tuple(zip((Phase.ENTER, Phase.LAND), each, strict=False)))


def front_of(plan):
    return [round(math.degrees(posture.front), 6) for _, posture in plan.postures]


def test_a_plan_that_holds_off_its_angles_stays(sturdier):
    search, judged = sturdier((10.0, 30.0))
    assert front_of(search.plan(plan_of(20.0, 25.0))) == [20.0, 25.0]
    assert judged == [20, 22, 18, 25, 27, 23]


def test_another_angle_within_sixteen_degrees_holds(sturdier):
    """Off by two degrees: 12 to 28 deg hold. By two moves of up to eight tolerances it gets there;
    the middle is the best.
    """
    for start in (0.0, 11.0, 45.0, 51.0):
        (found,) = front_of(sturdier((10.0, 30.0))[0].plan(plan_of(start)))
        assert 12.0 <= found <= 28.0
    # from the flat it gets no farther than 6 deg at a time
    assert sturdier((60.0, 80.0))[0].plan(plan_of(20.0, 95.0)) is None
    (found,) = front_of(sturdier((10.0, 30.0), limits=(-90.0, 13.0))[0].plan(plan_of(0.0)))
    assert 12.0 <= found <= 13.0
    assert sturdier((10.0, 30.0), limits=(-90.0, 11.0))[0].plan(plan_of(0.0)) is None


def test_a_phase_that_holds_nowhere_has_no_plan(sturdier):
    search, judged = sturdier((200.0, 210.0))
    assert search.plan(plan_of(20.0, 25.0)) is None
    assert len(judged) == len(set(judged))  # none is judged twice


@pytest.fixture
def gripping(sturdier):
    """The same with grousers; scores say in how many ways each angle fails by friction alone."""

    def of(holds, limits=(-90.0, 90.0), tolerance=2.0, fails=lambda angle: 1):
        search, judged = sturdier(holds, limits)
        judged.clear()
        track = ONE.track.model_copy(update={"belt": "grousers"})
        robot = ONE.model_copy(update={"track": track})
        search.question = asked(robot, tolerance=math.radians(tolerance))

        def score(phase, posture):
            return Score(rank=NO_GO, failing=-fails(math.degrees(posture.front)), margin=0, drop=0)

        search.scores = SimpleNamespace(
            work_out=list, of=score, off=score, about=lambda posture: [posture]
        )
        return search, judged

    return of


def test_with_grousers_angles_that_hold_are_found_wherever_they_lie(gripping):
    """Of every 18 deg from -90, 18 is GO; of every 4 about it 18 and 22 are the best."""
    for start in (-80.0, 0.0, 11.0, 51.0):
        (found,) = front_of(gripping((10.0, 30.0))[0].plan(plan_of(start)))
        assert found in (18.0, 22.0)
    search, judged = gripping((10.0, 30.0), limits=(-6.0, 18.0))
    assert front_of(search.plan(plan_of(0.0))) == [16.0]  # about 12; 20 is not allowed
    assert max(judged) == 18
    search, judged = gripping((200.0, 210.0))
    assert search.plan(plan_of(0.0)) is None
    flat = math.floor(math.degrees(ONE.flippers()["front"].flat_angle) - 2.0)
    assert {flat, *range(-90, 91, 18)} <= set(judged)
    assert len(judged) == len(set(judged))  # none is judged twice


def test_with_grousers_angles_are_tried_about_those_that_lack_little(gripping):
    """0 deg is no GO by a margin of 2.9 deg, so 4 is tried about it; by one of 3.1 it is left."""
    assert front_of(gripping((0.5, 5.3), tolerance=1.0)[0].plan(plan_of(50.0))) == [4.0]
    assert gripping((0.9, 5.3), tolerance=1.0)[0].plan(plan_of(50.0)) is None


def test_only_what_grousers_may_mend_is_judged(gripping):
    search, judged = gripping((10.0, 30.0), fails=lambda angle: 1 if angle < 19.0 else 2)
    assert front_of(search.plan(plan_of(0.0))) == [18.0]
    assert max(judged) == 20  # off 18; neither 22 nor 30
    search, judged = gripping((10.0, 30.0), fails=lambda angle: 2)
    assert search.plan(plan_of(0.0)) is None
    assert judged == [0]


@pytest.mark.parametrize("holds", [(9.5, 30.5), (23.5, 29.5), (60.5, 80.5)])
def test_what_promises_too_little_is_not_judged_and_changes_nothing(sturdier, holds):
    for start in (-10.0, 0.0, 11.0, 45.0):
        plain, judged = sturdier(holds)
        expected, count = plain.plan(plan_of(start)), len(judged)
        judged.clear()
        scored, judged = sturdier(holds, promised=0.5)
        assert scored.plan(plan_of(start)) == expected
        assert len(judged) < count / 2
        judged.clear()


def test_the_worst_is_looked_at_until_it_is_beaten(sturdier):
    search, judged = sturdier((10.0, 30.0))
    (posture,) = degrees(40.0)
    assert search._worst(Phase.ENTER, posture, OUT) == Worth(UNSURE, pytest.approx(-22.0))
    assert judged == [40, 42, 38]
    judged.clear()
    (posture,) = degrees(50.0)  # upwards was the worst: it is enough
    assert search._worst(Phase.ENTER, posture, Worth(UNSURE, -30.0)).margin == pytest.approx(-32.0)
    assert judged == [52]
    judged.clear()
    assert search._worst(Phase.LAND, posture, Worth(UNSURE, -30.0)).margin == pytest.approx(-30.0)
    assert judged == [50]
    assert search._worst(Phase.LAND, degrees(20.0)[0], OUT) == Worth(GO, pytest.approx(-2.0))
    assert Worth(GO, 0.0).holds
    assert not Worth(UNSURE, 9.0).holds


def test_a_grid_from_the_lowest_angle_to_the_highest(sturdier):
    """Each 18 deg, and the flat; no farther than is allowed."""

    def grid(*limits):
        search, _ = sturdier((0.0, 1.0), limits=limits)
        each = [round(math.degrees(one.front), 6) for one in search._grid(Posture())]
        laid = math.degrees(pressed(ONE, Posture(front="flat"), TWO).front)
        assert each[0] == pytest.approx(laid)
        return each[1:]

    assert grid(-6.0, 30.0) == [-6.0, 12.0, 30.0]
    assert grid(-6.0, 29.0) == [-6.0, 12.0]
    assert grid(-6.0, 11.0) == [-6.0]  # a degree short of the next


def test_postures_close_by_are_within_the_limits(sturdier):
    search, _ = sturdier((0.0, 1.0))
    four = math.radians(4.0)
    at = Posture(front=0.5, rear=-0.3)
    search.limits = -0.3 - four, 0.5 + four
    alone = [each.front for each in search._close_to(Posture(front=0.5))]
    assert alone == pytest.approx([0.5, 0.5 - four, 0.5 + four, 0.5 - 2 * four])
    search.question = asked(ABSOLEM, posture=at)
    both = [(each.front, each.rear) for each in search._close_to(at)]
    fronts = [0.0, -four, four, -2 * four]
    rears = [0.0, -four, four, 2 * four]
    assert both == [
        (pytest.approx(0.5 + one), pytest.approx(-0.3 + two)) for one in fronts for two in rears
    ]


def test_which_postures_are_looked_at_more_closely(sturdier, monkeypatch):
    """Those that rotate on their way come last; what holds one too little is not judged."""
    a, b, c, d, e, f = each = degrees(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    tipping = dict(zip(each, (5.0, 9.0, 7.0, 8.0, 10.0, 11.0), strict=True))
    drops = {b: -GENTLE - 1.0, c: -GENTLE}
    failing = {e: -1, f: -2}
    search, _ = sturdier((0.0, 1.0))

    def score(phase, posture):
        return Score(False, failing.get(posture, 0), -90.0, drops.get(posture, 0.0),
                     tipping[posture])  # fmt: skip

    def off(phase, posture):
        return score(phase, posture)._replace(failing=-2 if posture is e else 0)

    judged, held = [], []

    def of(self, phase, posture, beaten):
        assert beaten == SHORT_OF_GO
        judged.append(posture)
        return Worth(GO, tipping[posture])

    def holds(self, phase, posture):
        held.append(each[round(math.degrees(posture.front)) - 1])
        return Worth(GO, 1.0) if held[-1] is d else ANY

    monkeypatch.setattr(Sturdier, "_of", of)
    monkeypatch.setattr(Sturdier, "_held", holds)
    search.scores = SimpleNamespace(work_out=list, of=score, off=off)
    ranked = search._ranked(Phase.ENTER, each)
    assert next(ranked) == (Worth(GO, 7.0), c)
    assert (held, judged) == ([d, c], [c])
    assert next(ranked) == (Worth(GO, 5.0), a)
    assert next(ranked) == (Worth(GO, 8.0), d)
    assert next(ranked) == (Worth(GO, 9.0), b)
    assert list(ranked) == []


def test_a_posture_stays_where_another_is_no_better(sturdier, monkeypatch):
    search, _ = sturdier((0.0, 1.0))
    (posture,) = degrees(3.0)
    worth = Worth(UNSURE, 2.0)
    monkeypatch.setattr(Sturdier, "_most", lambda self, phase, about: [ANY] * len(about))
    monkeypatch.setattr(Sturdier, "_worst", lambda self, phase, posture, beaten: worth)
    assert search._best_about(Phase.ENTER, posture, worth) == (posture, worth)
    other, found = search._best_about(Phase.ENTER, posture, Worth(UNSURE, 1.0))
    assert (other == posture, found) == (False, worth)


def test_what_a_phase_may_come_to_by_its_scores():
    """A tenth of a degree better than those of coarse drives; of a failure nothing is known."""
    score = Score(GO, 0, 3.0, 0.0, 5.0)
    assert plan_sturdy._most(score) == Worth(GO, pytest.approx(5.0 + plan_sturdy.SLACK))
    assert plan_sturdy._hope(score) == Worth(GO, pytest.approx(3.0 + plan_sturdy.SLACK))
    assert plan_sturdy._hope(score._replace(rank=ROUGH)).rank == ROUGH
    assert plan_sturdy._hope(score._replace(rank=NO_GO)).rank == NO_GO
    assert plan_sturdy._hope(FAILED) == Worth(NO_GO, ENOUGH)


def test_scores_tell_where_nothing_but_the_flat_and_one_friction_count():
    """Not where rotations are accepted, a figure is uncertain or frictions differ."""

    def scored(question):
        scores = SimpleNamespace(question=question, facing="nose-first")
        return Sturdier(scores, (-1.0, 1.0), None)._scored is not None

    question = asked()
    uncertain = ONE.model_copy(
        update={"uncertainty": ONE.uncertainty.model_copy(update={"com_height": 0.01})}
    )
    parts = Surface(
        friction_low=0.6, friction_high=0.9,
        treads={"low": 0.4, "high": 0.9},
    )  # fmt: skip
    assert scored(question)
    assert not scored(question.changed(robot=uncertain))
    assert not scored(question.changed(surface=parts))


def test_angles_about_a_posture(sturdier):
    search, _ = sturdier((0.0, 1.0), limits=(-8.0, 10.0), tolerance=3.0)
    found = [round(math.degrees(each.front), 6) for each in search._about(degrees(1.4)[0])]
    assert found == [2.0, 0.0, 3.0, -1.0, 4.0, -2.0, 5.0, -3.0, 6.0, -4.0, 7.0, -5.0, 10.0, -8.0]
    wide, _ = sturdier((0.0, 1.0), tolerance=2.0)
    found = [math.degrees(each.front) for each in wide._about(degrees(0.0)[0])]
    far = [-16, -14, -12, -10, -8, -6, *range(-4, 0)]
    assert sorted(found) == pytest.approx([*far, *(-each for each in reversed(far))])


@pytest.fixture
def judging(monkeypatch):
    """A search about a plan of a phase with a margin of sliding and one of all; what it drives."""
    asked_for = []

    def of(sliding, margin, verdict=Verdict.UNSURE):
        def over(*given, **how):
            asked_for.append((given, how))

        def findings(question, basis, *, most):
            asked_for.append(most)

        conclusion = SimpleNamespace(verdict=verdict, margin=margin)
        slides = np.array([sliding])
        monkeypatch.setattr(plan_sturdy, "sliding_margin", lambda question, basis: slides)
        monkeypatch.setattr(plan_sturdy, "findings_of", findings)
        monkeypatch.setattr(plan_sturdy, "conclude", lambda question, found: conclusion)
        scores = SimpleNamespace(
            question=asked(), facing="tail-first", profile="ground",
            stretch=lambda phase: (phase, 2.0),
        )  # fmt: skip
        return Sturdier(scores, (-1.0, 1.0), SimpleNamespace(over=over)), asked_for

    return of


@pytest.mark.parametrize(
    ("margin", "worth"),
    [(math.radians(3.0), 3.0), (math.radians(40.0), ENOUGH), (math.nan, -90.0)],
)
def test_what_a_phase_comes_to(margin, worth, judging):
    """Driven over its part of the terrain, judged by the policy."""
    search, asked_for = judging(math.inf, margin)
    found = search._of(Phase.LAND, HIGH, OUT)
    assert found == Worth(UNSURE, pytest.approx(worth))
    (given, how), most = asked_for
    assert (given[0], given[1].posture, given[1].facing) == ("ground", HIGH, "tail-first")
    assert how == {"start": Phase.LAND, "until": 2.0}
    assert most == pytest.approx(math.radians(ENOUGH))  # more is no better
    assert search._of(Phase.LAND, HIGH, OUT) is found


@pytest.mark.parametrize(
    ("verdict", "grousers", "drives"),
    [
        (Verdict.GO, True, [{}, {"step": contact.STEP}]),
        (Verdict.GO, False, [{}]),
        (Verdict.UNSURE, True, [{}]),
    ],
)
def test_a_go_on_grousers_is_driven_once_more_pose_by_pose(verdict, grousers, drives, judging):
    search, asked_for = judging(math.inf, 0.1, verdict)
    track = search.question.robot.track.model_copy(
        update={"belt": "grousers" if grousers else "smooth"}
    )
    robot = search.question.robot.model_copy(update={"track": track})
    search.question = search.question.changed(robot=robot)
    assert search._of(Phase.LAND, HIGH, OUT).rank == -verdict.rank
    how = [one[1] for one in asked_for if isinstance(one, tuple)]
    assert how == [{"start": Phase.LAND, "until": 2.0} | each for each in drives]


@pytest.mark.parametrize(("sliding", "verdict"), [(0.05, GO), (0.0, UNSURE), (-0.1, UNSURE)])
def test_what_slides_too_early_is_judged_no_further(sliding, verdict, judging):
    """It has no more margin than that of sliding, and where that is gone no GO."""
    search, asked_for = judging(sliding, math.radians(-90.0))
    most = Worth(verdict, pytest.approx(math.degrees(sliding)))
    assert search._of(Phase.LAND, HIGH, Worth(GO, 9.0)) == most
    assert len(asked_for) == 1
    below = Worth(verdict, math.degrees(sliding) - 0.1)
    assert search._of(Phase.LAND, HIGH, below) == Worth(UNSURE, pytest.approx(-90.0))
    unknown, _ = judging(math.nan, 0.2, Verdict.GO)
    assert unknown._of(Phase.LAND, HIGH, Worth(GO, 9.0)).margin == pytest.approx(math.degrees(0.2))


# plans put together of phases


def score(margin, drop=0.0, *, rank=GO, failing=0):
    return Score(rank, failing, margin, drop)


def test_scores_of_a_phase():
    """Of the drop what is beyond 5 deg counts, a tenth of it."""
    assert score(8.0, -15.0).value == pytest.approx(7.0)
    assert score(8.0, -4.0).merit == (GO, 0, 8.0)
    assert score(8.004, -15.0, rank=ROUGH, failing=-1).merit == (ROUGH, -1, 7.0)
    # what may arrive comes before what is not known to, however much fails
    assert score(1.0, rank=ROUGH, failing=-2).merit > score(9.0, rank=UNSURE, failing=-1).merit
    assert score(3.0, -5.0).does(3.0)
    for other in (score(2.9), score(3.0, -5.1), score(3.0, rank=ROUGH), score(3.0, rank=NO_GO)):
        assert not other.does(3.0)


def test_the_weakest_phase_counts_and_a_little_the_others():
    """Two phases, three plans: margins and drops of the weakest, a twentieth of the mean value."""
    first = np.array(
        [[GO, ROUGH, GO], [0, -1, 0], [9.0, 9.0, 9.0], [0.0, 0, -25.0], [9.0, 9.0, 7.0]]
    )
    second = np.array(
        [[GO, UNSURE, NO_GO], [0, -2, 0], [3.0, 10.0, 3.0], [-15.0, 0, 0], [2.0, 10.0, 3.0]]
    )
    ranks, failing, value = _order([first, second], np.array([0.0, 1.5, 0.0]))
    assert ranks.tolist() == [GO, UNSURE, NO_GO]
    assert failing.tolist() == [0, -3, 0]
    assert value == pytest.approx([3 - 1 + 0.05 * 5.5, 9 - 1.5 + 0.05 * 9.5, 3 - 2 + 0.05 * 5.0])
    assert _along(1, 3) == (1, -1, 1)


def test_changes_of_plans_by_hand():
    search = Search(asked(), "nose-first", (-1.0, 1.0))
    costs, changes = search._changes([[LOW, HIGH], [LOW], [LOW, HIGH]])
    one = cost_of(ONE, [LOW, HIGH])
    np.testing.assert_array_equal(changes, [[[0, 1]], [[1, 2]]])
    np.testing.assert_allclose(costs, [[[0, one]], [[one, 2 * one]]])


@pytest.mark.parametrize(
    ("limits", "angles"),
    [
        ((-75.0, 90.0), [-75, -47.5, -20, 7.5, 35, 62.5, 90]),
        ((0.0, 10.0), [0, 10]),
        ((5.0, 5.0), [5, 5]),
        ((0.0, 60.0), [0, 30, 60]),
    ],
)
def test_angles_tried_first_are_whole_degrees_from_end_to_end(limits, angles):
    low, high = map(math.radians, limits)
    found = [math.degrees(each) for each in Search(asked(), "nose-first", (low, high))._grid()]
    assert found == pytest.approx(angles, abs=0.51)
    assert found == pytest.approx([round(each) for each in found])


# plans judged


def conclusion(rank=GO, margin=0.1, governs="tip_downhill", doubts=()):
    verdict = next(each for each in Verdict if each.rank == -rank)
    return SimpleNamespace(verdict=verdict, margin=margin, governs=governs, doubts=doubts)


def judged(rank=GO, margin=0.1, drop=0.0, *, question=None, arrives=True, **more):
    question = question or asked()
    return Judged(question, None, conclusion(rank, margin, **more), drop, arrives)


def test_the_merit_of_a_plan():
    assert judged(GO, 0.1).merit == (GO, True, 0, pytest.approx(math.degrees(0.1), abs=1e-6))
    assert judged(GO, 0.5, 15.0).merit[3] == pytest.approx(ENOUGH - 1.0)
    land = {"before": "land", "posture": HIGH}
    change = cost_of(ONE, [LOW, HIGH])
    changed = judged(GO, 0.5, question=asked(changes=(land,)))
    assert changed.merit[3] == pytest.approx(ENOUGH - change)
    assert judged(UNSURE, math.nan, doubts=(1, 2), arrives=False).merit == (
        UNSURE,
        False,
        -2,
        -90,
    )
    assert judged(NO_GO, -0.1, governs=FALL_DOWNHILL.key).merit[3] == -90.0
    assert judged(UNSURE, -0.1, governs=FALL_DOWNHILL.key).merit[3] > -90.0
    assert judged(NO_GO, -0.1).merit[3] > -90.0


@pytest.fixture
def ways(monkeypatch):
    """A plan judged off its angles: ranks of the ways off, in their order; and how many were."""

    def of(ranks, plan, beaten=None, passes=()):
        looked_at = []
        drives = SimpleNamespace(
            is_no_failure=lambda k: k in passes,
            rank=lambda k: (looked_at.append(k), ranks[k])[1],
        )
        monkeypatch.setattr(plan_off_angles, "off_angles", lambda question: range(len(ranks)))
        return judged_off(plan, beaten, drives), len(looked_at)

    return of


def test_off_its_angles_the_worst_verdict_counts(ways):
    plan = judged(GO)
    assert ways([], plan) == (OffAngles(plan, plan.merit, True), 0)
    assert ways([GO] * 3, plan) == (OffAngles(plan, plan.merit, True), 3)
    worst = (UNSURE, *plan.merit[1:])
    found, count = ways([GO, UNSURE, GO], plan)
    assert (found.worst, found.tested, found.robust, count) == (worst, True, False, 3)
    found, count = ways([UNSURE, NO_GO, GO], plan)
    assert (found.worst[0], found.tested, count) == (NO_GO, True, 2)  # there is nothing worse
    bad = judged(NO_GO)
    # a NO-GO is no worse off its angles
    assert ways([NO_GO, NO_GO], bad) == (OffAngles(bad, bad.merit, True), 0)
    assert OffAngles(bad, bad.merit, True).robust
    # where the worst is a UNSURE what is no NO-GO for certain is not judged
    found, count = ways([GO, UNSURE, GO, NO_GO], plan, passes=(0, 2))
    assert (found.worst[0], found.tested, count) == (NO_GO, True, 3)
    # what is no better than what is beaten is judged no farther
    assert ways([UNSURE, GO, GO], plan, worst) == (OffAngles(plan, worst, False), 1)
    assert ways([GO, GO], plan, plan.merit) == (OffAngles(plan, plan.merit, False), 0)
    less = (GO, True, 0, plan.merit[3] - 0.1)
    assert ways([GO, GO], plan, less)[0].tested


def searching(*, grousers=False, off=None, questions=()):
    robot = SimpleNamespace(track=SimpleNamespace(has_grousers=grousers))
    return SimpleNamespace(
        question=SimpleNamespace(robot=robot), off=off,
        weakest_first=lambda ways: list(questions),
    )  # fmt: skip


PLAN = SimpleNamespace(question=lambda question: "plan")


def candidate(hope=10.0, *, rank=GO, failing=0, off=None):
    merit = (rank, failing, hope)
    return Candidate(PLAN, merit, off or (GO, 0, 0.0))


def test_which_verdict_scores_promise():
    each = [(rank, 0, 1.0) for rank in (GO, ROUGH, UNSURE, NO_GO)]
    assert [-_rank(searching(), one) for one in each] == [GO, ROUGH, UNSURE, NO_GO]
    assert [-_rank(searching(grousers=True), one) for one in each] == [GO] * 4


def test_which_plans_may_be_better(monkeypatch):
    """Than a UNSURE; than a GO of 9 deg by its scores or by those of the best."""
    monkeypatch.setattr(plan_finalists, "off_angles", lambda question: question)

    def may(each, bar, of_best=None, drives=None, **more):
        return _may_be_better(searching(**more), each, bar, of_best, drives)

    unsure, go = (UNSURE, True, -1, 9.0), (GO, True, 0, 9.0)
    assert may(candidate(), unsure)
    assert not may(candidate(rank=ROUGH, failing=-1), go)
    assert may(candidate(rank=ROUGH, failing=-1), unsure)
    assert not may(candidate(rank=NO_GO), unsure)
    assert may(candidate(8.6), go)
    for hope in (8.5, 8.4):  # by half a degree it may be better than its scores
        assert not may(candidate(hope), go)
        assert may(candidate(hope), go, grousers=True)
        assert may(candidate(hope), (GO, True, -2, 9.0))
        assert not may(candidate(hope), (GO, True, -1, 9.0))
    for hope, better in ((10.05, False), (10.2, True)):  # nearly alike
        assert may(candidate(hope), go, candidate(10.0)) is better
    # where it fails off its angles the weakest way tells
    fails = candidate(off=(ROUGH, -1, 0.0))
    for rank, better in ((GO, True), (ROUGH, False), (UNSURE, False)):
        drives = SimpleNamespace(rank=lambda one, rank=rank: rank)
        assert may(fails, go, questions=["way"], drives=drives) is better
    assert may(fails, go)
    worse = candidate(rank=UNSURE, failing=-1, off=(UNSURE, -2, 0.0))
    assert may(worse, (UNSURE, True, -1, 0.0))


def test_the_larger_of_two_merits_is_to_be_beaten():
    plan = judged(UNSURE)
    best = OffAngles(plan, plan.merit, True)
    go = judged(GO).merit
    assert _better(None, None) is None
    assert _better(go, None) == go
    assert _better(None, best) == plan.merit
    assert _better(go, best) == go
    assert _better(judged(NO_GO).merit, best) == plan.merit


def test_the_best_plans_off_their_angles():
    """At its angles no plan promises less: beyond that none is scored off them."""
    hopes = [
        Hope(name, (True, 0, value))
        for name, value in zip("abcd", (5.0, 9.0, 7.0, 1.0), strict=True)
    ]
    scored = []

    def off(plan):
        scored.append(plan)
        return True, 0, {"a": 4.0, "b": 2.0, "c": 6.0, "d": 1.0}[plan]

    assert _best_off(searching(off=off), hopes, 2) == ["c", "a"]
    assert scored == ["b", "c", "a"]


def test_the_whole_terrain_decides_among_plans(monkeypatch):
    """The first whose verdict it does not lower; else the one of the best verdict."""
    monkeypatch.setattr(plan_search, "judge", lambda question: question.posture.front)

    def chosen(*ranks, tested=True):
        """Of plans by rank on the short terrain and on the whole."""
        plans = []
        for k, (short, _) in enumerate(ranks):
            plan = judged(short, question=asked(posture=Posture(front=0.1 * k)))
            plans.append(OffAngles(plan, plan.merit, tested))
        whole = {0.1 * k: judged(rank) for k, (_, rank) in enumerate(ranks)}
        looked_at = []

        def of_whole(question, found):
            looked_at.append(question)
            return whole[found]._replace(question=question)

        monkeypatch.setattr(plan_search, "judged_of", of_whole)
        monkeypatch.setattr(
            plan_search, "judged_off",
            lambda plan, beaten, drives: OffAngles(plan, (NO_GO, *plan.merit[1:]), True),
        )  # fmt: skip
        found = _on_the_whole(asked(), plans, "drives")
        return round(10 * found.question.posture.front), len(looked_at), found.robust

    assert chosen((GO, GO), (GO, GO)) == (0, 1, True)
    assert chosen((GO, UNSURE), (UNSURE, UNSURE)) == (0, 2, True)
    assert chosen((GO, NO_GO), (UNSURE, UNSURE)) == (1, 2, True)
    assert chosen((GO, NO_GO)) == (0, 1, True)
    assert chosen((GO, GO), tested=False) == (0, 1, False)
