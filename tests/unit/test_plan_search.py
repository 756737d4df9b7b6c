"""The search for a plan: what it finds, that it is so, what it is for, and how far it holds."""

import math
from itertools import product

import jsonschema
import pytest

import kaidan
from answered import each_once
from kaidan.assessment.answer import Assessment
from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_hopes import Search
from kaidan.assessment.plan_judged import shortened
from kaidan.assessment.plan_off_angles import holds_off_its_angles
from kaidan.assessment.plan_scores import Score
from kaidan.assessment.plan_search import (
    LIMITS,
    better_than,
    found_of,
    off_angles,
)
from kaidan.assessment.plan_sturdy import Sturdier
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError
from kaidan.models import judge
from kaidan.models.quasi_static import Basis, findings_of, sliding_margin, traverse_of
from kaidan.modes import SLIDES_DOWN, Verdict
from kaidan.question import Question
from kaidan.robot import FlipperPair, Posture, PostureChange, Robot, State, Track
from kaidan.surface import Surface
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

PAIR = FlipperPair(
    length=0.3, root_radius=0.09, tip_radius=0.04, pivot_height=0.09, mass=2.0, max_speed=0.5
)
FRONT_PAIR = Robot(
    name="one pair",
    mass=24.0,
    com_from_front=0.24,
    com_height=0.1,
    track=Track(flat_length=0.51, front_radius=0.09, rear_radius=0.09),
    front_flippers=PAIR,
)
"""Estimated, in the manner of a PackBot: long flippers at the nose."""
STAIRS = Stairs(name="short", rise=0.178, going=0.279, steps=8)


def best(robot="absolem", stairs=STAIRS, **manner):
    return kaidan.assess(robot, stairs, flippers="best", **({"friction": 0.9} | manner))


@pytest.fixture(scope="module")
def absolem():
    return best()


def rank(answer):
    return Verdict(answer.verdict).rank, len(answer.doubts)


def test_it_is_better_than_any_posture_that_has_a_name(absolem):
    fixed = [
        kaidan.assess("absolem", STAIRS, flippers=flippers, facing=facing, friction=0.9)
        for flippers in ("stowed", "flat", "45deg,0deg")
        for facing in ("nose-first", "tail-first")
    ]
    at_its_angles = kaidan.assess(absolem.question, flipper_tolerance=0.0)
    assert rank(at_its_angles) < min(map(rank, fixed))
    assert rank(absolem) <= min(map(rank, fixed))
    assert absolem.margin_deg > max(each.margin_deg for each in fixed)
    assert absolem.contact.grades.largest_drop_deg < 20  # flat it drops by the slope of 33 deg


def test_what_is_found_is_so_when_it_is_asked_for(absolem):
    plan = absolem.plan
    again = kaidan.assess(
        "absolem", STAIRS, facing=plan.facing, flippers=plan.flippers, friction=0.9
    )
    assert again.margin_deg == absolem.margin_deg
    shared = set(again.findings)
    assert {key: absolem.findings[key] for key in shared} == again.findings
    assert set(absolem.findings) - shared <= {"posture_tolerance"}
    assert again.plan.steps == plan.steps
    assert (again.plan.found, plan.found) == (False, True)
    assert kaidan.assess(again.question) == again


def apart_from_the_search(answer):
    """An answer without what tells that its plan was searched for."""
    plan = answer.plan
    if plan is not None:
        plan = None if plan.bare else plan.model_copy(update={"found": False, "tried": None})
    return answer.model_copy(update={"plan": plan, "notes": (), "what_would_help": ()})


IBC = Stairs.named("ibc")


@pytest.mark.parametrize(
    ("robot", "stairs", "manner"),
    [
        ("absolem", STAIRS, {"friction": 0.9}),
        ("absolem", IBC, {"friction": 1.0}),
        ("absolem", IBC, {"friction": 1.0, "flipper_tolerance": "6deg"}),
        ("absolem", STAIRS, {"friction": 0.5}),
        ("absolem", STAIRS, {"friction": 1.2, "direction": "down"}),
        pytest.param("marv", IBC, {"friction": 1.0}, marks=pytest.mark.slow),
        ("kenaf", Stairs.inclined(angle="50deg", nosing_spacing="150mm"), {"friction": 2.0}),
        ("absolem-flat", IBC, {"friction": 1.2}),
        pytest.param("packbot-510", IBC, {"friction": 1.2}, marks=pytest.mark.slow),
    ],
)
def test_a_planned_answer_is_the_answer_to_its_question(robot, stairs, manner):
    answer = kaidan.assess(robot, stairs, **manner)
    again = kaidan.assess(answer.question)
    assert apart_from_the_search(again) == apart_from_the_search(answer)
    read = type(answer).from_json(answer.to_json()).question
    assert kaidan.assess(read) == again


def test_angles_are_whole_degrees_within_the_limits(absolem):
    for step in absolem.plan.steps:
        for word in step.flippers.split(","):
            if word.endswith("deg"):
                assert float(word[:-3]).is_integer()
                assert LIMITS[0] - 1e-9 <= math.radians(float(word[:-3])) <= LIMITS[1] + 1e-9


def test_each_change_says_what_it_takes(absolem):
    assert absolem.plan.steps[0].before_step is None
    for step in absolem.plan.steps[1:]:
        assert step.before_step == {"traverse": 1, "land": 8}[step.phase]
        assert step.time_s == pytest.approx(math.radians(step.turn_deg) / 0.7854)
        assert step.torque_Nm > 0
    assert all(step.flippers in absolem.details() for step in absolem.plan.steps)


def test_where_no_friction_is_stated_the_plan_is_the_best_at_one():
    """Margins against tipping are larger with flat flippers, which need 0.98 off their angles."""
    unstated = kaidan.assess("absolem", "ibc")
    assert unstated.governs == "friction_unknown"
    plan = {"facing": unstated.plan.facing, "flippers": unstated.plan.flippers}
    for friction, verdict in ((1.0, "go"), (0.97, "unsure")):
        stated = kaidan.assess(
            "absolem", "ibc", friction=friction, flipper_tolerance="2deg", **plan
        )
        assert stated.verdict == verdict


@pytest.mark.parametrize("friction", [0.9, 1.2])
def test_it_holds_two_degrees_off_its_angles_or_says_so(friction):
    asked = Question.of("absolem", STAIRS, flippers="best", friction=friction)
    found = found_of(asked)
    ranks = [kaidan.assess(each).verdict for each in off_angles(found.question)]
    here = kaidan.assess(found.question, flipper_tolerance=0.0).verdict
    worst = max(Verdict(each).rank for each in ranks)
    answer = kaidan.assess(asked)
    assert answer.plan.holds_within_deg == (2.0 if worst <= Verdict(here).rank else 0.0)
    if worst > Verdict(here).rank:
        assert answer.verdict != "go"
        assert "posture_tolerance" in answer.doubts


def test_off_angles_are_every_way_off():
    asked = Question.of("absolem", STAIRS, flippers="30deg,stowed/land:flat", friction=1.0,
                        flipper_tolerance="2deg")  # fmt: skip
    off = list(off_angles(asked))
    flat = kaidan.Robot.named("absolem").front_flippers.flat_angle
    first = {round(math.degrees(each.posture.front), 6) for each in off}
    assert first == {28.0, 32.0}
    assert all(each.posture.rear is None for each in off)  # at its stop
    off_by = math.radians(2.0)
    landing = {(each.changes[0].posture.front, each.changes[0].posture.rear) for each in off}
    assert landing == set(product((flat + off_by, flat - off_by), repeat=2))


def test_long_flippers_at_the_nose_go_up_tail_first():
    """Behind, they carry a centroid that would fall over the short tail."""
    nose, tail, free = (best(FRONT_PAIR, facing=f, friction=1.0)
                        for f in ("nose-first", "tail-first", None))  # fmt: skip
    assert rank(tail) < rank(nose)
    assert free.plan.facing == "tail-first"
    assert free.plan.flippers == tail.plan.flippers
    assert tail.contact.grades.arrested
    assert not nose.contact.grades.arrested


def test_a_robot_without_flippers_is_turned_round():
    """Its centroid far back: nose first it falls, tail first it climbs."""
    bare = FRONT_PAIR.model_copy(update={"front_flippers": None, "com_from_front": 0.36})
    stairs = Stairs(rise=0.1, going=0.15, steps=6)
    found = best(bare, stairs, friction=1.5)
    assert found.plan.facing == "tail-first"
    assert found.plan.flippers == "stowed"
    assert [step.flippers for step in found.plan.steps] == ["stowed"]
    assert (found.verdict, best(bare, stairs, facing="nose-first").verdict) == ("go", "no-go")


def test_an_arm_that_moves_the_centroid_ahead_is_used():
    bare = FRONT_PAIR.model_copy(
        update={
            "front_flippers": None,
            "com_from_front": 0.3,
            "states": {"arm-out": State(mass=6.0, forward=0.45)},
        }
    )
    stairs = Stairs(rise=0.1, going=0.2, steps=6)
    without = kaidan.assess(bare, stairs, friction=1.5, flippers="stowed")
    found = best(bare, stairs, friction=1.5, facing="nose-first")
    assert "arm-out" in found.plan.flippers
    assert found.margin_deg > without.margin_deg


def test_nothing_is_changed_for_its_own_sake():
    """Where one posture does, it stays, and the nose leads."""
    low = FRONT_PAIR.model_copy(update={"com_height": 0.05})
    found = best(low, Stairs(rise=0.03, going=0.15, steps=6), friction=1.2)
    assert found.verdict == "go"
    assert (found.plan.facing, len(found.plan.steps)) == ("nose-first", 1)


def test_down_the_stairs():
    found = best(direction="down", friction=1.0)
    assert found.plan is not None
    again = kaidan.assess(found.question)
    assert again.margin_deg == found.margin_deg


@pytest.mark.parametrize(
    ("manner", "model"),
    [
        ({"model": "closed-form"}, "closed-form"),
        ({"yaw": 0.1}, "contact"),
        ({"model": "support-polygon"}, "support-polygon"),
    ],
)
def test_where_one_posture_is_judged_it_is_one_with_a_name(manner, model):
    found = best(stairs=Stairs(rise=0.15, going=0.3, steps=8), **manner)
    assert found.model == model
    assert found.plan.flippers in ("stowed", "flat", "flat,stowed", "stowed,flat")


def test_a_ramp_has_no_nosing_to_change_before():
    ramp = Profile.of_points([(-3, 0), (0, 0), (2, 0.8), (5, 0.8)])
    found = best(stairs=ramp)
    assert len(found.plan.steps) == 1


def test_a_kerb_has_one_place_to_change():
    kerb = Profile.of_points([(-3, 0), (0, 0), (0, 0.15), (3, 0.15)])
    found = best(stairs=kerb, friction=1.5)
    assert {step.phase for step in found.plan.steps[1:]} <= {"land"}


def test_physics_takes_a_stated_posture():
    with pytest.raises(InputError) as refused:
        best(model="physics")
    assert str(refused.value) == "a trial keeps one posture: state angles, flat or stowed"


def test_the_answer_is_json_both_ways(absolem):
    assert Assessment.from_json(absolem.to_json()) == absolem
    jsonschema.validate(absolem.to_dict(), Assessment.json_schema())


def test_compare_finds_a_plan_for_each_pair(absolem):
    found = kaidan.compare(["absolem"], [STAIRS], flippers="best", friction=0.9)
    (cell,) = found.cells
    assert found.facing is None
    assert (str(cell.verdict), cell.governs) == (absolem.verdict, absolem.governs)
    assert cell.facing == absolem.plan.facing
    assert cell.flippers == absolem.plan.flippers
    assert "with the better end first" in str(found)


@pytest.mark.parametrize(("friction", "verdict"), [("0.6..1.0", "no-go"), ("0.6..1.001", "unsure")])
def test_friction_that_is_just_required_is_not_enough_whatever_is_rounded(friction, verdict):
    """Of 45 degrees it is 1.00, on the few steps of the search and on all of them."""
    for robot, flippers in (("absolem-flat", "stowed"), ("absolem", "flat")):
        stated = kaidan.assess(robot, "osha", friction=friction, flippers=flippers)
        assert stated.verdict == best(robot, "osha", friction=friction).verdict == verdict


def test_a_plan_that_promises_a_go_is_judged_at_its_angles_on_the_whole_flight_alone(monkeypatch):
    at_angles = []
    known = Drives.judge
    monkeypatch.setattr(
        Drives, "judge", lambda self, question: at_angles.append(question) or known(self, question)
    )
    found = found_of(Question.of("absolem", "uk-general", friction=1.2))
    assert (conclude(found.question, found.findings).verdict, at_angles) == (Verdict.GO, [])
    assert conclude(found.question, judge(found.question)).margin == pytest.approx(
        conclude(found.question, found.findings).margin, abs=1e-12
    )  # the same judgement: rounding
    assert found.question.terrain.steps == 12


def test_shortened_flights_keep_what_is_odd():
    odd = Stairs(rise=0.12, going=0.2, steps=40, first_rise=0.1, last_rise=0.13)
    short = shortened(Question.in_one_posture(FRONT_PAIR, odd)).terrain
    assert 5 <= short.steps < 12
    assert (short.step_rises[0], short.step_rises[-1]) == (0.1, 0.13)


def test_a_plan_of_the_search_is_judged_by_the_policy_alone():
    """Whatever the scores said, the verdict is that of a traverse driven in one go."""
    found = found_of(Question.of("absolem", STAIRS, flippers="best", friction=0.9))
    plan = found.question
    assert plan.best_of == ()
    assert all(isinstance(each, PostureChange) for each in plan.changes)
    assert isinstance(plan.posture, Posture)
    assert judge(plan).basis.question == plan


def test_without_a_posture_the_best_is_found():
    found = kaidan.assess("absolem", STAIRS, friction=0.9)
    assert found == best()
    assert kaidan.traverse("absolem", STAIRS, friction=0.9).question == found.question


def test_a_plan_of_a_better_verdict_or_none(monkeypatch):
    slippery = Question.of("absolem", STAIRS, friction=(0.6, 1.0))
    grippy = Question.of("absolem", STAIRS, friction=1.2)
    assert found_of(slippery).findings is not None
    assert better_than(Verdict.NO_GO, slippery).question == found_of(slippery).question
    assert better_than(Verdict.UNSURE, grippy).question == found_of(grippy).question
    judged = []
    monkeypatch.setattr(Drives, "judge", lambda self, question: judged.append(question))
    assert better_than(Verdict.UNSURE, slippery) is None
    assert better_than(Verdict.GO, grippy) is None
    assert not judged  # their scores tell


def test_of_two_ways_that_fail_the_one_that_arrives_comes_first():
    """Tail first Marmotte falls at the first riser; nose first it rocks, too near a fall."""
    found = kaidan.assess("marmotte", "ibc", friction=1.0)
    assert (found.verdict, found.question.facing) == ("no-go", "nose-first")
    assert found.contact.grades.arrested
    assert "Tail first was tried too and is no better." in found.notes
    assert "posture" not in str(found)


def test_a_robot_without_flippers_has_nothing_to_lay_out():
    found = kaidan.assess("kenaf", "ibc", friction=1.0, model="closed-form", direction="down")
    assert (found.plan.bare, found.plan.holds_within_deg) == (True, None)
    assert "flippers" not in found.details().split("Notes")[0]


def test_one_posture_throughout_is_the_better_of_stowed_and_flat():
    at_a_yaw = kaidan.assess("absolem", STAIRS, friction=1.2, yaw=0.1)
    closed = kaidan.assess("absolem", STAIRS, friction=1.2, model="closed-form")
    for found in (at_a_yaw, closed):
        assert found.question.flippers in ("flat", "stowed", "stowed,flat", "flat,stowed")
        assert found.plan.holds_within_deg is None
        assert any(note.startswith("Flippers stowed and flat were tried;") for note in found.notes)
    trial = Question.of("absolem", STAIRS, friction=1.2, model="physics")
    assert (trial.best_of, trial.flippers) == ((), "stowed")


def on_grousers(sheet, **figures):
    figures = figures or {"grouser_height": 0.010, "grouser_spacing": 0.040}
    belts = {"belt": "grousers"} | figures
    return sheet.model_copy(update={"track": sheet.track.model_copy(update=belts)})


def test_advice_about_a_plan_that_was_found_holds_off_its_angles(monkeypatch):
    """With grousers its plan is GO at its angles and not 2 degrees off: another one is promised."""
    each_once(monkeypatch)
    answer = kaidan.assess("absolem", "ibc", surface="concrete-dry")
    help_, _ = answer.what_would_help
    stated = "If its belts have grousers, state it (track.belt=grousers), with another plan"
    assert (help_.change, help_.verdict) == (stated, "go")
    robot = on_grousers(answer.question.robot, grouser_height=None)  # as its sheet would say it
    planned = answer.question.changed(robot=robot)
    assert kaidan.assess(planned, flipper_tolerance=0.0).verdict == "go"
    assert kaidan.assess(planned).verdict == "unsure"
    assert not holds_off_its_angles(planned)
    own = kaidan.assess(robot, "ibc", surface="concrete-dry")
    assert (own.verdict, own.margin_deg) == (help_.verdict, help_.margin_deg)


@pytest.mark.slow
def test_advice_of_what_holds_the_robot_seeks_another_plan(monkeypatch):
    """MARV's plan on smooth belts is no GO with grousers either, its best plan with them is."""
    each_once(monkeypatch)
    answer = kaidan.assess("marv", "ibc", surface="concrete-dry")
    help_, *_ = answer.what_would_help
    assert help_.change.endswith(", with another plan")
    robot = on_grousers(answer.question.robot, grouser_height=None)
    assert kaidan.assess(answer.question.changed(robot=robot)).verdict == "unsure"
    own = kaidan.assess(robot, "ibc", surface="concrete-dry")
    assert (
        (own.verdict, own.margin_deg) == (help_.verdict, help_.margin_deg) == ("go", own.margin_deg)
    )


@pytest.mark.parametrize(
    ("name", "stairs", "manner"),
    [
        ("absolem", "ibc", {}),
        ("absolem", "ada", {}),
        pytest.param("marv", "ibc", {}, marks=pytest.mark.slow),
        pytest.param("marv", "ada", {}, marks=pytest.mark.slow),
        ("ozbot-atr", "ibc", {"speed": 0.05}),
    ],
)
def test_long_robots_climb_on_their_grousers(name, stairs, manner, monkeypatch):
    """Absolem's rear flippers lie a little below the flat, where they hold 2 degrees off; OzBot,
    which a slip back onto its grousers may rock at 0.1 m/s, goes slowly.
    """
    each_once(monkeypatch)
    sheet = Robot.named(name)
    answer = kaidan.assess(on_grousers(sheet), stairs, surface="concrete-dry", **manner)
    assert answer.verdict == "go"
    for each in off_angles(answer.question):
        assert kaidan.assess(each).verdict == "go"
    assert kaidan.assess(sheet, stairs, surface="concrete-dry", **manner).verdict == "unsure"
    slippery = answer.question.changed(surface=Surface.named("petg-on-plywood"))
    assert kaidan.assess(slippery).verdict == "no-go"


def test_what_was_driven_already_is_not_driven_again():
    """Friction and belts play no part in a traverse, tilts that alone count neither."""
    drives = Drives()
    plan = Question.of("absolem", STAIRS, friction=0.9, flippers="flat/land:-60deg,-20deg")
    profile = plan.profile
    first, like = (
        drives.over(profile, each.changed(changes=()), until=1.0)
        for each in (plan, plan.changed(surface=Surface.of_friction(0.3)))
    )
    assert like is first
    rough = drives.over(profile, plan.changed(changes=()), until=1.0, sought=(0.1,))
    assert (rough.path is first.path, rough.sought) == (True, (0.1,))
    assert drives.over(profile, plan.changed(changes=()), until=1.1) is not first


@pytest.mark.parametrize("friction", [0.4, 0.7, 1.0, 1.5])
@pytest.mark.parametrize("flippers", ["stowed", "flat", "-40deg,-13deg/traverse:flat"])
def test_where_only_the_verdict_counts_it_is_the_same(friction, flippers):
    drives = Drives()
    for stairs in (STAIRS, Stairs(name="steep", rise=0.2, going=0.21, steps=6)):
        plan = Question.of("absolem", stairs, friction=friction, flippers=flippers)
        whole = Drives().judge(plan)
        assert drives.rank(plan) == -conclude(plan, whole).verdict.rank
        assert drives.required_friction(plan) == whole.required_friction


def test_the_way_off_that_promises_least_is_looked_at_first():
    question = Question.of("absolem", STAIRS, friction=0.9).changed(best_of=())
    search = Search(question, "nose-first", LIMITS)
    plan = question.changed(
        posture=Posture(front=0.2, rear=0.3), flipper_tolerance=math.radians(2.0)
    )
    ways = list(off_angles(plan))
    scores = {Posture(front=0.2, rear=0.3): 1.0, ways[2].posture: -5.0, ways[1].posture: 3.0}
    for phase, (posture, margin) in product(search.scores.phases, scores.items()):
        search.scores.known[phase, posture] = Score(True, 0, margin, 0.0)
    order = search.weakest_first(ways)
    assert order[:2] == [ways[2], ways[1]]
    assert {each.posture for each in order} == {each.posture for each in ways}


@pytest.mark.parametrize("friction", [0.3, 0.6, 0.8, 1.2])
def test_what_is_certainly_no_failure_is_judged_to_be_none(friction):
    drives, told = Drives(), set()
    for flippers, rise in product(("stowed", "flat", "35deg,-13deg/traverse:flat"), (0.15, 0.21)):
        stairs = Stairs(name="some", rise=rise, going=0.26, steps=5)
        plan = Question.of("absolem", stairs, friction=friction, flippers=flippers)
        sound = drives.is_no_failure(plan)
        failure = conclude(plan, drives.judge(plan)).verdict is Verdict.NO_GO
        assert not (sound and failure)
        told.add(sound)
    assert told == ({False} if friction < 0.5 else told)


@pytest.mark.parametrize("flippers", ["flat", "35deg,-13deg/traverse:flat/land:-60deg,-20deg"])
def test_what_is_no_failure_tells_the_friction_that_judging_it_finds(flippers):
    plan = Question.of("absolem", STAIRS, friction=1.2, flippers=flippers)
    judged, looked_at = Drives(), Drives()
    judged.rank(plan)
    assert looked_at.is_no_failure(plan)
    assert looked_at.required_friction(plan) == pytest.approx(
        judged.required_friction(plan), rel=1e-12
    )  # rounding


@pytest.mark.parametrize("friction", [0.8, 1.4])
def test_no_phase_comes_to_more_than_its_score_lets_one_hope_for(friction):
    question = Question.of("absolem", STAIRS, friction=friction).changed(best_of=())
    search = Search(question, "nose-first", LIMITS)
    sturdier = Sturdier(search.scores, LIMITS, Drives())
    angles = [math.radians(each) for each in (-60.0, -20.0, 10.0, 35.0)]
    postures = [Posture(front=one, rear=two) for one, two in product(angles, repeat=2)]
    for phase in search.scores.phases:
        hopes = sturdier._hopes(phase, postures)
        for posture, hope in zip(postures, hopes, strict=True):
            assert sturdier._judged(phase, posture) <= hope


def test_some_plans_are_certainly_no_failure_and_unsure_ones_never():
    drives = Drives()
    flat = Question.of("absolem", STAIRS, friction=1.2, flippers="flat/land:-60deg,-20deg")
    assert drives.is_no_failure(flat)
    assert not drives.is_no_failure(flat.changed(surface=Surface.of_friction(0.3)))
    assert not drives.is_no_failure(flat.changed(fall_reserve=math.radians(29.9)))
    grousers = flat.robot.track.model_copy(update={"belt": "grousers"})
    unsure = flat.robot.model_copy(update={"track": grousers})
    assert not drives.is_no_failure(flat.changed(robot=unsure))
    kenaf = Question.of("kenaf", "ibc", friction=2.0)
    assert not drives.is_no_failure(kenaf.changed(best_of=()))  # it falls


@pytest.mark.parametrize("most", [2.0, 15.0])
@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("flippers", ["flat", "stowed", "20deg,-5deg", "45deg,0deg"])
def test_of_margins_beyond_what_is_enough_only_that_is_known(flippers, direction, most):
    question = Question.ask(
        "absolem", STAIRS, flippers=flippers, direction=direction, surface="concrete-dry"
    )
    basis = Basis(question, traverse_of(question))
    whole = conclude(question, findings_of(question, basis))
    seen = conclude(question, findings_of(question, basis, most=math.radians(most)))
    assert (seen.verdict, seen.phase) == (whole.verdict, whole.phase)
    assert min(seen.margin, math.radians(most)) == min(whole.margin, math.radians(most))


def test_grousers_slide_no_later_than_is_known_first():
    track = FRONT_PAIR.track.model_copy(update={"grouser_height": 0.01, "grouser_spacing": 0.04})
    robot = FRONT_PAIR.model_copy(update={"track": track})
    question = Question.ask(robot, STAIRS, flippers="flat", surface="concrete-dry")
    basis = Basis(question, traverse_of(question))
    (slides,) = (one for one in findings_of(question, basis).each if one.mode is SLIDES_DOWN)
    assert sliding_margin(question, basis) == slides.worst
    smooth = Question.ask(FRONT_PAIR, STAIRS, flippers="flat", friction=0.8)
    assert sliding_margin(smooth, Basis(smooth, traverse_of(smooth))) == math.inf
