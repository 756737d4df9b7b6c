"""What counts as help and what is tried, on conclusions made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Payload, Question, Robot, Stairs
from kaidan.assessment import advice, plan_off_angles, plan_search, plans, traction_advice
from kaidan.assessment.advice import (
    CLOSER,
    WORTH_TELLING,
    _centroid_moved,
    _is_better,
    _known_better,
    _measured,
    _rank,
    _settles,
    _slower,
    _tips_over,
    _weighed,
)
from kaidan.assessment.measuring import Measurement
from kaidan.assessment.sentences import advice as text
from kaidan.assessment.traction_advice import (
    LARGEST_FRICTION,
    Candidate,
    enough_at_the_risk,
    more_friction,
    nosings,
    with_less_friction,
    with_other_plans,
)
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.errors import InputError
from kaidan.models import clearance
from kaidan.models.findings import Finding, Findings
from kaidan.models.unweighed import Placed
from kaidan.modes import (
    ENERGY,
    GROUSER_SPEED,
    LANDING_ROOM,
    POSTURE_TOLERANCE,
    SLIDES_DOWN,
    SLIDES_UP,
    TIP_DOWNHILL,
    TIP_SIDEWAYS,
    TIP_UPHILL,
    Phase,
    Verdict,
)
from kaidan.robot import Posture

G = 9.80665
KENAF = Question.in_one_posture("kenaf", Stairs(rise=0.1, going=0.15), friction=1.0)


def concluded(verdict, margin=0.1):
    return Conclusion(verdict, "", None, None, margin, margin, np.array([margin]), ())


@pytest.mark.parametrize(
    ("then", "now", "better"),
    [
        (Verdict.GO, Verdict.UNSURE, True),
        (Verdict.UNSURE, Verdict.NO_GO, True),
        (Verdict.NO_GO, Verdict.UNSURE, False),
        (Verdict.OUTSIDE_MODEL, Verdict.NO_GO, False),
        (Verdict.NO_GO, Verdict.OUTSIDE_MODEL, False),  # a refusal known is no help
        (Verdict.UNSURE, Verdict.OUTSIDE_MODEL, True),
    ],
)
def test_a_better_verdict_is_help(then, now, better):
    assert _is_better(concluded(then), concluded(now)) is better


def test_a_larger_margin_is_no_help_where_something_else_decides():
    """Momentum, in metres, is not mended by degrees; if then something else decides, it is."""
    now = concluded(Verdict.UNSURE, 0.1)._replace(governs="momentum")
    then = concluded(Verdict.UNSURE, 0.2)._replace(governs="momentum")
    assert not _is_better(then, now)
    assert _is_better(then._replace(governs="tip_downhill"), now)
    assert _is_better(then._replace(verdict=Verdict.GO), now)


def test_of_one_verdict_a_margin_worth_telling_is_help():
    now = concluded(Verdict.UNSURE, 0.1)
    for gain, better in ((2 * WORTH_TELLING, True), (0.5 * WORTH_TELLING, False), (0.0, False)):
        assert _is_better(concluded(Verdict.UNSURE, 0.1 + gain), now) is better
    assert not _is_better(concluded(Verdict.UNSURE, math.nan), now)


@pytest.mark.parametrize(
    ("energy", "speed"),
    [
        (5e-4, 0.09),  # 0.0990 m/s lift by 0.5 mm: 0.09 is below it
        (0.03**2 / (2 * G) * 1.01, 0.03),
        (0.015**2 / (2 * G), 0.01),
        (0.009**2 / (2 * G), None),  # slower than anybody is advised
        (0.0, None),
        (-1e-3, None),
    ],
)
def test_a_slower_speed_has_less_kinetic_energy_than_is_left(energy, speed):
    # of which a sudden stop leaves to a rotation what a moment of inertia and a height say
    left = KENAF.energy_threshold() / KENAF.kinetic_height
    found = [each.question.speed for each in _slower(KENAF, energy * left)]
    assert found == ([] if speed is None else [pytest.approx(speed)])


@pytest.mark.parametrize(
    ("required", "enough"),
    [
        (0.5, 0.51),
        (0.505, 0.52),
        (LARGEST_FRICTION - 0.01, LARGEST_FRICTION),
        (LARGEST_FRICTION - 0.005, None),
        (math.inf, None),
        (math.nan, None),
    ],
)
def test_more_friction_is_a_hundredth_more_than_required(required, enough):
    needs = Findings(model="by hand", required_friction=required)
    found = [each.question.friction for each in more_friction(KENAF, needs)]
    assert found == ([] if enough is None else [pytest.approx((enough, enough))])


@pytest.mark.parametrize(
    ("off", "enough"), [(0.6, 0.61), (0.5, 0.51), (0.4, 0.51), (LARGEST_FRICTION, None)]
)
@pytest.mark.parametrize("search", [None, SimpleNamespace(drives="drives")])
def test_off_the_angles_of_the_flippers_more_may_be_required(off, enough, search, monkeypatch):
    """0.5 at them; drives that are known already are not made again."""
    asked = []

    def friction_off_its_angles(question, drives):
        asked.append(drives)
        return off

    monkeypatch.setattr(plan_off_angles, "friction_off_its_angles", friction_off_its_angles)
    loose = Question.of(Robot.named("absolem"), KENAF.terrain, friction=1.0).changed(
        best_of=(), posture={"front": 0.1, "rear": 0.1}, flipper_tolerance=0.05
    )
    needs = Findings(model="by hand", required_friction=0.5)
    each = list(more_friction(loose, needs, search))
    assert [one.question.friction[0] for one in each] == [enough] * (enough is not None)
    assert all(one.holds and not one.certain for one in each)
    assert asked == [search and "drives"]


PLANNED = Question.of(Robot.named("absolem"), KENAF.terrain, friction=0.8).changed(
    best_of=(), posture={"front": 0.1, "rear": 0.1}, flipper_tolerance=0.0
)


def came_upon(*others, needed=()):
    """What a search came upon: other plans by their front angles, and what each needs."""
    plans = tuple(PLANNED.changed(posture={"front": each, "rear": 0.2}) for each in others)
    needs = dict(zip(others, needed, strict=True))
    drives = SimpleNamespace(required_friction=lambda plan: needs[plan.posture.front])
    return plan_search.Found(PLANNED, "its", True, "short", drives, others=plans)


def test_other_plans_are_named_with_the_friction_that_they_need(monkeypatch):
    """A hundredth more; with the plan; none beyond what any surface has."""
    search = came_upon(0.3, 0.4, 0.5, 0.6, needed=(0.9, math.inf, math.nan, LARGEST_FRICTION))
    (one,) = with_other_plans(PLANNED, search)
    assert (one.change, one.another, one.holds) == (text.friction(0.91, known=True), True, True)
    assert one.friction == pytest.approx(0.91)
    assert one.question.friction == (one.friction, one.friction)
    assert one.question.posture.front == 0.3
    ranged = SimpleNamespace(robot=SimpleNamespace(com_range="range"))
    assert list(with_other_plans(ranged, search)) == []
    as_much = came_upon(0.3, needed=(LARGEST_FRICTION - 0.01,))
    assert [one.friction for one in with_other_plans(PLANNED, as_much)] == [LARGEST_FRICTION]
    # off its angles it may need more
    monkeypatch.setattr(plan_off_angles, "friction_off_its_angles", lambda question, drives: 1.1)
    (loose,) = list(with_other_plans(PLANNED.changed(flipper_tolerance=0.05), search))[:1]
    assert loose.friction == pytest.approx(1.11)


@pytest.mark.parametrize(
    ("least", "asked", "told"),
    [
        # half-way between 0.5 at the plan's angles and 1.0, in hundredths; then to what is enough
        (0.7, [0.75, 0.62], [0.75]),
        (0.8, [0.75, 0.88], [0.88]),
        (0.6, [0.75, 0.62], [0.75, 0.62]),
        (0.9, [0.75, 0.88], []),
    ],
)
@pytest.mark.parametrize("robust", [True, False])
def test_less_friction_is_looked_for_with_other_plans(least, asked, told, robust, monkeypatch):
    """Until less than 0.15 is left, at the frictions that are told."""
    looked = []

    def better_than(verdict, question, *, drives, other_frictions):
        assert (verdict, drives, other_frictions) == (Verdict.ROUGH, search.drives, False)
        assert question.best_of == search.best_of
        looked.append(question.friction[0])
        if looked[-1] < least:
            return None if robust else plan_search.Found(question, None, False, None, drives)
        return plan_search.Found(question, None, True, None, drives)

    monkeypatch.setattr(plan_search, "better_than", better_than)
    search = came_upon()
    needs = Findings(model="by hand", required_friction=0.5)
    each = list(with_less_friction(PLANNED, needs, search, 1.0))
    assert looked == asked
    assert [one.friction for one in each] == told
    assert all(one.another and one.holds for one in each)
    assert [one.change for one in each] == [text.friction(mu, known=True) for mu in told]
    assert list(with_less_friction(PLANNED, needs, search, 0.64)) == []
    ranged = SimpleNamespace(robot=SimpleNamespace(com_range="range"))
    assert list(with_less_friction(ranged, needs, search, 1.0)) == []


@pytest.mark.parametrize(
    ("least", "smooth", "enough"), [(0.59, 0.64, 0.59), (0.56, 0.64, 0.56), (0.7, 0.64, 0.56)]
)
def test_friction_is_enough_for_the_energy_of_a_slip_too(least, smooth, enough, monkeypatch):
    """0.55 is required; the slip has little enough energy from some friction on, or nowhere."""

    def then(question, findings):
        slips = question.friction[0] < least - 1e-9
        return SimpleNamespace(governs="energy" if slips else "slides_down")

    monkeypatch.setattr(traction_advice, "judge", lambda question: None)
    monkeypatch.setattr(traction_advice, "conclude", then)
    track = KENAF.robot.track.model_copy(update={"belt": "grousers"})
    gripping = KENAF.changed(robot=KENAF.robot.model_copy(update={"track": track}))
    figures = SimpleNamespace(shown_as="traction", smooth_required_friction=smooth)
    needs = Findings(model="by hand", required_friction=0.55, figures=(figures,))
    (one,) = more_friction(gripping, needs)
    assert one.friction == pytest.approx(enough)
    (one,) = more_friction(KENAF, needs)
    assert one.friction == pytest.approx(0.56)


def test_in_doubt_friction_may_be_more_than_any_surface_has(monkeypatch):
    """At the nominal friction it is the largest that is known: with the doubt it is beyond it."""
    monkeypatch.setattr(traction_advice, "enough_at_the_risk", lambda *given: 2 * LARGEST_FRICTION)
    needs = Findings(model="by hand", required_friction=LARGEST_FRICTION - 0.01)
    sheet = KENAF.robot.model_dump() | {"uncertainty": {"com_height": 0.01}}
    for robot, count in ((KENAF.robot, 1), (Robot.model_validate(sheet), 0)):
        assert len(list(more_friction(KENAF.changed(robot=robot), needs))) == count


def test_grousers_where_there_are_none_and_where_nobody_says():
    """Of belts that are smooth with the usual figures, of others with none."""
    usual = traction_advice.USUAL_GROUSERS

    def of(surface=KENAF.surface, **track):
        belts = KENAF.robot.track.model_copy(update=track)
        asked = KENAF.changed(
            robot=KENAF.robot.model_copy(update={"track": belts}), surface=surface
        )
        return list(traction_advice.grousers(asked))

    for belt, change, height, spacing in (
        ("smooth", text.grousers(), usual["grouser_height"], usual["grouser_spacing"]),
        (None, text.state_grousers(), None, None),
    ):
        for surface in (KENAF.surface, None):
            (one,) = of(surface, belt=belt)
            track = one.question.robot.track
            assert (one.change, one.holds) == (change, surface is not None)
            assert (track.belt, track.grouser_height, track.grouser_spacing) == (
                "grousers", height, spacing
            )  # fmt: skip
    assert of(belt="grousers") == []


def finding(mode, margin):
    return Finding.certain(mode, margin, model="by hand")


@pytest.mark.parametrize(
    ("margins", "end"),
    [
        ({TIP_DOWNHILL: 0.1, TIP_UPHILL: 0.2}, TIP_DOWNHILL),
        ({TIP_DOWNHILL: 0.2, TIP_UPHILL: 0.1}, TIP_UPHILL),
        ({TIP_DOWNHILL: -0.1, TIP_UPHILL: -0.2}, TIP_UPHILL),
        ({TIP_DOWNHILL: -0.1, TIP_UPHILL: 0.1, TIP_SIDEWAYS: -0.2}, TIP_DOWNHILL),
        ({TIP_DOWNHILL: 0.3, TIP_SIDEWAYS: -0.2}, TIP_DOWNHILL),  # a shift along it is no help
        ({TIP_DOWNHILL: math.nan, TIP_UPHILL: 0.1}, TIP_UPHILL),
        ({TIP_DOWNHILL: 0.1, SLIDES_DOWN: -0.1}, TIP_DOWNHILL),
        ({SLIDES_DOWN: -0.1}, None),
        ({TIP_DOWNHILL: math.nan}, None),
    ],
)
def test_the_end_over_which_it_tips(margins, end):
    found = Findings(
        model="by hand", each=tuple(finding(mode, margin) for mode, margin in margins.items())
    )
    assert _tips_over(KENAF, found, conclude(KENAF, found)) is end


@pytest.mark.parametrize(("load", "share"), [(None, 1.0), (0.5, 20.5 / 20), (2.0, 22 / 20)])
def test_a_centroid_that_is_moved_moves_that_of_robot_and_payload(load, share):
    """By hand: a shift of all is a longer one of the robot, whose payload stays."""
    flight = Stairs.inclined(angle=math.radians(62), nosing_spacing=0.150)
    robot = Robot.model_validate(Robot.named("kenaf").model_dump() | {"mass": 20.0})
    stance = robot.com_from_front, robot.com_height
    payload = [] if load is None else [Payload(mass=load, from_front=stance[0], height=stance[1])]
    question = Question.in_one_posture(robot, flight, friction=3.0, payload=payload)
    found = Findings(model="by hand", each=(finding(TIP_DOWNHILL, -0.1),))
    (one,) = _centroid_moved(question, found, conclude(question, found))
    moved = robot.com_from_front - one.question.robot.com_from_front
    shift = question.stance.com_from_front - one.question.stance.com_from_front
    assert moved == pytest.approx(shift * share)
    assert round(1e3 * shift, 6) == round(1e3 * shift)  # whole millimetres
    assert f"{1e3 * shift:.0f} mm towards the front" in one.change
    if load is not None:
        assert f"{1e3 * shift * (20 + load) / load:.0f} mm" in one.change


# what is tried


@pytest.fixture
def tried(monkeypatch):
    """Names of what is tried."""
    for name in ("_flippers_flat", "_flippers_raised", "more_friction", "grousers", "_measured",
                 "_centroid_moved", "_stowed_on_landings"):  # fmt: skip
        tries = [Candidate(name.lstrip("_"), KENAF)]
        monkeypatch.setattr(advice, name, lambda *given, tries=tries: tries)
    monkeypatch.setattr(advice, "with_other_plans", lambda question, search: [])
    monkeypatch.setattr(advice, "with_less_friction", lambda *given: [])
    monkeypatch.setattr(advice, "_slower", lambda question, energy: [("slower", energy)])

    def of(governs, question=KENAF, *, searched=False, phase=None, best=-0.1, energy=None,
           fast=None):  # fmt: skip
        concluded = Conclusion(Verdict.NO_GO, governs, phase, None, -0.2, best, np.zeros(1), ())
        known = {ENERGY: energy, GROUSER_SPEED: fast}
        each = tuple(finding(mode, one) for mode, one in known.items() if one is not None)
        found = Findings(model="", each=each)
        each = advice._candidates(question, found, concluded, object() if searched else None)
        return [one.change if isinstance(one, Candidate) else one for one in each]

    return of


@pytest.mark.parametrize(("tolerance", "tries"), [(2 * CLOSER, True), (CLOSER, False)])
def test_closer_angles_are_tried_where_they_are_not_asked_for(monkeypatch, tolerance, tries):
    """In a plan that holds off its angles, whatever it is."""
    monkeypatch.setattr(advice, "more_friction", lambda question, found, search: [])
    monkeypatch.setattr(advice, "with_other_plans", lambda question, search: [])
    monkeypatch.setattr(advice, "with_less_friction", lambda *given: [])
    question = Question.of("absolem", KENAF.terrain, friction=1.0).changed(
        best_of=(), posture={"front": 0.1, "rear": 0.1}, flipper_tolerance=tolerance
    )
    now = concluded(Verdict.UNSURE)._replace(governs=POSTURE_TOLERANCE.key)
    each = list(advice._candidates(question, Findings(model="by hand"), now, object()))
    told = [(one.change, one.question.tolerance, one.holds, one.certain) for one in each]
    assert told == [(text.set_closer(CLOSER), CLOSER, True, False)] * tries


@pytest.mark.parametrize("governs", ["slides_down", "posture_tolerance", "high_centring"])
def test_of_frictions_the_least_is_tried_first(governs, monkeypatch):
    """Of the plan at hand only where friction decides, or off its angles; of others anyway."""
    own, other, less = (
        Candidate(name, PLANNED, friction=mu) for name, mu in (("own", 1.2), ("b", 0.9), ("c", 0.8))
    )
    enough = []
    monkeypatch.setattr(advice, "more_friction", lambda *given: [own])
    monkeypatch.setattr(advice, "with_other_plans", lambda *given: [other])
    monkeypatch.setattr(
        advice, "with_less_friction", lambda *given: enough.append(given[3]) or [less]
    )
    now = concluded(Verdict.UNSURE)._replace(governs=governs)
    each = list(advice._candidates(PLANNED, Findings(model="by hand"), now, object()))
    frictions = [one for one in each if one.friction is not None]
    assert frictions == ([less, other] if governs == "high_centring" else [less, other, own])
    assert enough == [0.9]
    each = list(advice._candidates(PLANNED, Findings(model="by hand"), now, None))
    assert other not in each


def test_what_is_tried_where_it_slips(tried):
    """More friction and grousers; at an end it may enter or land another way."""
    for governs in ("slides_down", "slides_up", "friction_unknown"):
        assert tried(governs) == ["more_friction", "grousers"]
    for phase, more in ((Phase.ENTER, True), (Phase.LAND, True), (Phase.TRAVERSE, False)):
        turned, *others = tried("slides_down", phase=phase)
        assert ("tail first" in turned) is more
        assert others[-2:] == (["more_friction", "grousers"] if more else ["grousers"])
        assert tried("slides_down", phase=phase, searched=True) == ["more_friction", "grousers"]
    back = KENAF.changed(facing="tail-first")
    assert "nose first" in tried("slides_down", back, phase=Phase.LAND)[0]


def test_what_is_tried_where_it_tips(tried):
    flat, turned, *others = tried("tip_downhill")
    assert (flat, others) == ("flippers_flat", ["flippers_raised", "centroid_moved"])
    assert "tail first" in turned
    assert tried("tip_downhill", best=0.1)[-2:] == ["measured", "centroid_moved"]
    assert tried("tip_downhill", best=0.0)[-1:] == ["centroid_moved"]
    assert "measured" not in tried("tip_downhill", best=0.0)
    assert "measured" in tried("tip_downhill", best=0.5)
    assert tried("tip_downhill", searched=True) == ["centroid_moved"]
    assert tried("drive", searched=True) == []
    asked = KENAF.changed(acceleration=0.3)
    assert tried("drive", asked, searched=True) == [text.STEADY]
    assert tried("friction_unknown", asked) == ["more_friction", "grousers"]


def test_what_is_tried_for_its_energy(tried):
    """The margin, and the threshold that was taken off it."""
    asked = KENAF.changed(speed=0.3)
    slower = ("slower", pytest.approx(-0.002 + asked.energy_threshold()))
    assert tried("energy", asked, searched=True, energy=-0.002) == [slower]
    assert tried("energy", asked, searched=True) == []
    assert tried("drive", asked, searched=True, energy=-0.002) == []


def test_what_is_tried_on_landings_that_are_too_short(tried):
    assert tried("landing_room", searched=True) == ["stowed_on_landings"]


def test_on_grousers_a_speed_below_the_limit_is_tried(tried):
    """0.05 m/s beyond the limit, and a hundredth below it."""
    asked = KENAF.changed(speed=0.25)
    assert tried("grouser_speed", asked, searched=True, fast=-0.05) == [text.slower(0.19)]
    assert tried("grouser_speed", asked, searched=True) == []
    assert tried("grouser_speed", KENAF, searched=True, fast=-0.05) == []
    assert tried("drive", asked, searched=True, fast=-0.05) == []


FLIPPERS = Question.of(Robot.named("absolem"), KENAF.terrain, friction=1.0).changed(
    best_of=(), posture=Posture(front=0.1, rear=0.1)
)


@pytest.mark.parametrize(
    ("at_them", "off", "verdict"),
    [
        (0.2, (0.2, 0.1), Verdict.GO),
        (0.2, (0.2, -0.1), Verdict.UNSURE),  # off its angles it is none
        (0.2, (-0.1, 0.1), Verdict.UNSURE),
        (-0.1, (0.2, 0.1), Verdict.UNSURE),
    ],
)
def test_flippers_stowed_on_a_short_landing(at_them, off, verdict, monkeypatch):
    """The room with them stowed, in place of the room without; all else as it was found."""
    judged = []

    def findings(margin):
        return Findings(
            model="by hand",
            each=(Finding.certain(TIP_DOWNHILL, margin, model=""),
                  Finding.certain(LANDING_ROOM, -0.3, model="")),
        )  # fmt: skip

    def judge(question):
        judged.append(question)
        return findings(question)

    def conclude_by_hand(question, found):
        rooms = [one.worst.tolist() for one in found.each if one.mode is LANDING_ROOM]
        assert rooms == [[0.25]]
        tips = [one.worst[0] for one in found.each if one.mode is TIP_DOWNHILL]
        return concluded(Verdict.GO if tips[0] > 0 else Verdict.UNSURE, tips[0])

    monkeypatch.setattr(clearance, "room_when_stowed", lambda question: 0.25)
    monkeypatch.setattr(plans, "off_angles", lambda question: off)
    monkeypatch.setattr(advice, "judge", judge)
    monkeypatch.setattr(advice, "conclude", conclude_by_hand)
    (one,) = advice._stowed_on_landings(FLIPPERS, findings(at_them))
    assert (one.change, one.question, one.certain) == (text.STOWED, FLIPPERS, True)
    assert one.then.verdict is verdict
    assert bool(judged) is (at_them > 0)


def test_where_stowed_flippers_are_no_help_on_a_landing(monkeypatch):
    """No flippers, a landing in between, and no room with them stowed either."""
    monkeypatch.setattr(advice, "conclude", lambda question, found: concluded(Verdict.UNSURE))

    def helps(question, room):
        monkeypatch.setattr(clearance, "room_when_stowed", lambda question: room)
        return bool(list(advice._stowed_on_landings(question, Findings(model=""))))

    assert helps(FLIPPERS, 0.25)
    assert helps(FLIPPERS, 1e-6)
    assert not helps(FLIPPERS, 0.0)
    assert not helps(FLIPPERS, -0.1)
    assert not helps(KENAF, 0.25)
    for ends, help_ in ((("bottom", "top"), True), (("bottom", "between", "top"), False)):
        landings = [SimpleNamespace(end=end) for end in ends]
        assert helps(SimpleNamespace(robot=FLIPPERS.robot, landings=landings), 0.25) is help_


def test_leading_flippers_are_raised_going_up():
    def raised(question):
        return [one.question.posture for one in advice._flippers_raised(question)]

    up = advice.RAISED
    assert raised(FLIPPERS) == [Posture(front=up, rear=0.1)]
    tail = FLIPPERS.changed(facing="tail-first")
    assert raised(tail) == [Posture(front=0.1, rear=up)]
    assert raised(FLIPPERS.changed(direction="down")) == []
    assert raised(FLIPPERS.changed(posture=Posture(front=up, rear=0.1))) == []
    assert raised(KENAF) == []


def test_straight_on_and_at_a_steady_speed():
    robot = KENAF.robot
    gauged = robot.model_copy(update={"track": robot.track.model_copy(update={"gauge": 0.4})})
    asked = KENAF.changed(robot=gauged, yaw=0.2, acceleration=0.3)
    concluded_ = concluded(Verdict.UNSURE)._replace(governs="drive")
    search = came_upon()
    straight, steady = list(advice._candidates(asked, Findings(model=""), concluded_, search))
    assert (straight.change, straight.question) == (text.STRAIGHT, asked.changed(yaw=0.0))
    assert (steady.change, steady.question) == (text.STEADY, asked.changed(acceleration=0.0))


@pytest.mark.parametrize(("shift", "told"), [(0.0123, 0.014), (0.0128, 0.014), (0.0131, 0.015),
                                             (None, None)])  # fmt: skip
def test_a_shift_is_told_in_millimetres_and_one_more(shift, told, monkeypatch):
    """Of a robot of unknown mass it is that of all."""
    monkeypatch.setattr(advice, "shift_of_centroid", lambda question, *, downhill: shift)
    found = Findings(model="by hand", each=(finding(TIP_DOWNHILL, -0.1),))
    assert KENAF.robot.mass is None
    each = list(_centroid_moved(KENAF, found, conclude(KENAF, found)))
    moved = [KENAF.robot.com_from_front - one.question.robot.com_from_front for one in each]
    assert moved == ([] if told is None else [pytest.approx(told)])


def test_flat_flippers_are_tried_unless_they_are_flat_or_there_are_none():
    (one,) = advice._flippers_flat(FLIPPERS)
    flat = Posture(front="flat", rear="flat")
    assert (one.change, one.question.posture) == (text.FLAT, flat)
    assert list(advice._flippers_flat(FLIPPERS.changed(posture=flat))) == []
    assert list(advice._flippers_flat(KENAF)) == []


def test_of_what_is_measured_a_verdict_or_a_margin_that_holds_must_come():
    go, unsure = (concluded(each, 0.1) for each in (Verdict.GO, Verdict.UNSURE))
    assert _settles(go, unsure)
    assert not _settles(unsure, unsure)
    for now, then, settles in ((-0.1, 0.1, True), (0.0, 0.1, True), (0.0, 0.0, False),
                               (-0.1, 0.0, False), (-0.2, -0.1, False), (0.1, 0.2, False),
                               (0.5, 0.6, False)):  # fmt: skip
        pair = concluded(Verdict.UNSURE, then), concluded(Verdict.UNSURE, now)
        assert _settles(*pair) is settles


@pytest.mark.parametrize(
    ("margins", "enough"),
    [
        ((-0.1,), math.ceil(100 * math.tan(math.atan(0.5) + 0.1) + 1) / 100),
        ((0.0,), 0.5),
        ((0.1,), 0.5),
        ((-1.2,), 0.5),  # no friction is enough
        ((-math.inf,), 0.5),
        ((), 0.5),
        ((-0.1, -0.2), math.ceil(100 * math.tan(math.atan(0.5) + 0.2) + 1) / 100),
        ((-1.1,), math.ceil(100 * math.tan(math.atan(0.5) + 1.1) + 1) / 100),
        ((math.atan(0.5) - math.pi / 2,), 0.5),  # a right angle
    ],
)
def test_friction_enough_for_all_but_the_accepted_share(margins, enough, monkeypatch):
    """What margins lack there is added to the angle of friction: 0.464 rad at 0.5."""
    asked = []

    def judge(question, *, known):
        asked.append((question.friction, known))
        slides = [
            finding(mode, each)
            for mode, each in zip((SLIDES_DOWN, SLIDES_UP), margins, strict=False)
        ]
        return Findings(model="", each=(*slides, finding(TIP_DOWNHILL, -0.4)))

    monkeypatch.setattr(traction_advice, "judge", judge)
    found = Findings(model="")
    assert enough_at_the_risk(KENAF, found, 0.5) == pytest.approx(enough)
    assert asked == [((0.5, 0.5), found)]


@pytest.mark.parametrize(
    ("low", "high", "up_to", "told"),
    [
        (None, None, 16, 16),  # 2 to 25 mm by default
        (None, None, 2, 2),
        (None, None, 24, 24),
        (None, None, 1, None),  # not with the smallest either
        (None, 0.0175, 16, 16),
        (0.0055, 0.0085, 7, 7),  # between 5.5 and 8.5 mm
        (0.0055, 0.0085, 5, None),
        (0.004, 0.004, 3, None),  # no range
    ],
)
def test_the_largest_radius_of_the_nosings_by_hand(low, high, up_to, told):
    gripping = KENAF.robot.track.model_copy(update={"belt": "grousers"})
    asked = KENAF.changed(
        robot=KENAF.robot.model_copy(update={"track": gripping}),
        terrain=Stairs(rise=0.1, going=0.15, nosing_radius_low=low, nosing_radius_high=high),
    )
    slips = concluded(Verdict.UNSURE)._replace(governs="slides_down")

    def judged(question):
        smallest, largest = question.terrain.nosing_radii
        assert smallest <= largest
        return concluded(Verdict.GO if 1e3 * largest < up_to + 0.5 else Verdict.UNSURE)

    each = list(nosings(asked, slips, judged))
    radii = [round(1e3 * one.question.terrain.nosing_radius_high) for one in each]
    for one in each:
        smallest = min(asked.terrain.nosing_radii[0], one.question.terrain.nosing_radius_high)
        assert one.question.terrain.nosing_radius_low == pytest.approx(smallest)
    assert radii == [told] * (told is not None)
    assert [one.change for one in each] == [text.nosings(each) for each in radii]
    assert all(one.then.verdict is Verdict.GO for one in each)
    # smooth belts, another reason, friction too little at best: nothing of nosings helps
    for question, now in (
        (asked.changed(robot=KENAF.robot), slips), (asked, slips._replace(governs="tip_downhill")),
        (asked, slips._replace(margin_best=-0.1)), (asked, slips._replace(margin_best=0.0)),
    ):  # fmt: skip
        assert list(nosings(question, now, judged)) == []


@pytest.mark.parametrize(("high", "told"), [(0.005, 4), (0.0045, 4), (0.004, None), (0.0035, None)])
def test_nosings_as_round_as_they_may_be_have_failed_already(high, told):
    """From 3.5 mm on: in whole millimetres below the largest, not that one again."""
    gripping = KENAF.robot.track.model_copy(update={"belt": "grousers"})
    asked = KENAF.changed(
        robot=KENAF.robot.model_copy(update={"track": gripping}),
        terrain=Stairs(rise=0.1, going=0.15, nosing_radius_low=0.0035, nosing_radius_high=high),
    )
    slips = concluded(Verdict.UNSURE)._replace(governs="slides_down")
    each = list(nosings(asked, slips, lambda question: concluded(Verdict.GO)))
    radii = [1e3 * one.question.terrain.nosing_radius_high for one in each]
    assert radii == [pytest.approx(told)] * (told is not None)


def test_friction_that_is_stated_and_that_is_not():
    needs = Findings(model="", required_friction=0.5)
    told = [
        next(iter(more_friction(question, needs))).change
        for question in (KENAF, Question.in_one_posture("kenaf", KENAF.terrain))
    ]
    assert told == [text.friction(0.51, known=True), text.friction(0.51, known=False)]


def test_an_allowance_by_default_is_measured():
    usual = KENAF.changed(theta_d=None, theta_M=None)
    kenaf = usual.robot.model_copy(update={"theta_d": None, "theta_M": None})
    usual = usual.changed(robot=kenaf)
    (one,) = _measured(usual)
    assert one.change == text.measured(["theta_d", "theta_M"])
    assert (one.question.allowance_d.high, one.question.allowance_M.high) == (0.0, 0.0)
    assert list(_measured(one.question)) == []


def test_a_robot_is_weighed_at_its_best_place(monkeypatch):
    """By the verdict, then the margin; what is not known counts as none."""
    conclusions = {
        0.1: concluded(Verdict.UNSURE, 0.9), 0.2: concluded(Verdict.GO, 0.1),
        0.3: concluded(Verdict.GO, 0.3), 0.4: concluded(Verdict.GO, math.nan),
        0.5: concluded(Verdict.GO, 0.8),
    }  # fmt: skip
    monkeypatch.setattr(advice, "conclude", lambda question, found: conclusions[question])
    basis = [
        Placed(at, 0.1, at, Findings(model="", outside="no" if at == 0.5 else ""))
        for at in conclusions
    ]
    assert _weighed(Findings(model="", basis=basis)).question == 0.3
    assert _weighed(Findings(model="", basis=basis[:1] + basis[3:])).question == 0.4
    assert _rank(concluded(Verdict.GO, math.nan)) == (Verdict.GO.rank, 0.0)


def measurement(what, *inputs):
    return Measurement(what=what, inputs=inputs, share=0.5, deviation_deg=1.0)


def test_the_doubt_of_the_sheets_that_the_margin_feels_most_is_measured_away(monkeypatch):
    """Ranges are tried elsewhere; where it is of no sheet nothing is."""
    monkeypatch.setattr(
        advice, "without", lambda question, group: None if group == "stairs" else group
    )
    friction = measurement("friction", "friction")
    length, stairs = measurement("length", "flat_length"), measurement("stairs", "angle")
    (one,) = _known_better(KENAF, [friction, length, stairs])
    assert (one.question, one.certain) == ("length", True)
    assert list(_known_better(KENAF, [friction, stairs, length])) == []
    assert list(_known_better(KENAF, [friction])) == []


# what helps


@pytest.fixture
def helps(monkeypatch):
    """Changes that help, of candidates by name: what they come to, and off their angles."""

    def of(candidates, now=None, *, off=None, trials=1, com_range=None, tolerance=0.0):
        now = now or concluded(Verdict.UNSURE, 0.1)
        known, loose = [], []

        def judge(question, *, known):
            asked_known.append(known)
            if candidates[question.name] is None:
                raise InputError("no such posture")
            return question.name

        def planned(question, then, search, *, anew):
            assert anew is ("!" in question.name and com_range is None)
            if then.verdict is Verdict.GO and question.tolerance:
                loose.append(question.name)
                return off, False
            return then, anew

        asked_known = known
        each = [
            Candidate(
                name.rstrip("?!"),
                SimpleNamespace(name=name, tolerance=tolerance),
                "?" in name,
                "!" in name,
            )
            for name in candidates
        ]
        question = SimpleNamespace(trials=trials, robot=SimpleNamespace(com_range=com_range))
        monkeypatch.setattr(advice, "_candidates", lambda *given: each[:-1])
        monkeypatch.setattr(advice, "_known_better", lambda *given: each[-1:])
        monkeypatch.setattr(advice, "nosings", lambda *given: [])
        monkeypatch.setattr(advice, "judge", judge)
        monkeypatch.setattr(advice, "conclude", lambda question, found: candidates[found])
        monkeypatch.setattr(advice, "_planned", planned)
        changes = advice.what_would_help(question, "found", now)
        return [one.change for one in changes], set(known), loose

    return of


def test_changes_that_help_the_best_first(helps):
    go, better, same = (
        concluded(*each)
        for each in ((Verdict.GO, 0.2), (Verdict.UNSURE, 0.3), (Verdict.UNSURE, 0.1))
    )
    each = {
        "refused": None,
        "same": same,
        "better": better,
        "go": go,
        "go more": go._replace(margin=0.5),
    }
    assert helps(each) == (["go more", "go", "better"], {"found"}, [])
    assert helps(each, com_range="range")[1] == {None}
    assert helps(each, now=go)[0] == []
    assert helps(each, trials=2)[0] == []
    # what only makes a doubt certain has to settle something
    assert helps({"better": better, "measured?": better})[0] == ["better"]
    assert helps({"better": better, "measured?": go})[0] == ["measured", "better"]
    # where it changes what holds the robot, of another plan
    assert helps({"grip!": go, "better": better})[0] == ["grip, with another plan", "better"]
    # a GO counts as what it is off its angles, if these are in doubt
    found = helps(each, off=same._replace(margin=0.9), tolerance=0.05)
    assert found == (["go", "go more", "better"], {"found"}, ["go", "go more"])


def test_of_frictions_that_make_it_a_go_the_least_is_advised(monkeypatch):
    """Whatever its margin; one that helps and makes it none leaves a greater one to be told."""
    go, better, same = (
        concluded(*each)
        for each in ((Verdict.GO, 0.2), (Verdict.UNSURE, 0.3), (Verdict.UNSURE, 0.1))
    )

    def helps(*each, another=False):
        judged = []

        def judge(question, *, known):
            judged.append(question)
            return question

        found = {str(k): then for k, then in enumerate(each)}
        monkeypatch.setattr(advice, "judge", judge)
        monkeypatch.setattr(advice, "conclude", lambda question, name: found[name])
        monkeypatch.setattr(advice, "_planned", lambda name, then, search, *, anew: (then, False))
        monkeypatch.setattr(advice, "_candidates", lambda *given: [
            Candidate(name, name, friction=0.5 + 0.1 * k, another=another)
            for k, name in enumerate(found)
        ])  # fmt: skip
        monkeypatch.setattr(advice, "nosings", lambda *given: [])
        monkeypatch.setattr(advice, "_known_better", lambda *given: [])
        changes = advice.what_would_help(KENAF, "found", same)
        return [one.change for one in changes], judged

    assert helps(go, go._replace(margin=0.5)) == (["0"], ["0"])
    assert helps(better, go, go) == (["1", "0"], ["0", "1"])
    assert helps(same, better) == (["1"], ["0", "1"])
    assert helps(go, another=True)[0] == [text.with_another_plan("0")]


def test_sharper_nosings_are_judged_of_the_plan_at_hand(monkeypatch):
    anew_ones = []

    def planned(changed, then, search, *, anew):
        anew_ones.append(anew)
        return then, anew

    monkeypatch.setattr(advice, "_planned", planned)
    monkeypatch.setattr(advice, "judge", lambda question, *, known: "found")
    monkeypatch.setattr(advice, "conclude", lambda question, found: concluded(Verdict.GO))
    monkeypatch.setattr(advice, "_candidates", lambda *given: [])
    monkeypatch.setattr(advice, "_known_better", lambda *given: [])
    monkeypatch.setattr(
        advice, "nosings",
        lambda question, now, judged: [Candidate("sharper", question, then=judged(question))],
    )  # fmt: skip
    (change,) = advice.what_would_help(KENAF, "found", concluded(Verdict.UNSURE))
    assert (change.change, change.verdict) == ("sharper", "go")  # and not "with another plan"
    assert anew_ones == [False]


def test_a_plan_off_its_angles_and_another_one(monkeypatch):
    then = concluded(Verdict.GO, 0.2)
    best = concluded(Verdict.GO, 0.1)
    unsure = then._replace(verdict=Verdict.UNSURE)

    def of(ends=2, *, now=then, holds=False, robust=True, own=best, com_range=None, anew=False):
        asked = []

        def better_than(verdict, question, *, drives, other_frictions):
            assert other_frictions is anew
            asked.append((verdict, question, drives))
            return own and SimpleNamespace(question="own", findings="its", robust=robust)

        def holds_off(question, drives):
            assert drives == (None if search is None else "drives")
            return holds

        facings = ("nose-first", "tail-first")[:ends]
        search = ends and plan_search.Found("own", "its", True, "short", "drives", ends=facings)
        question = SimpleNamespace(
            robot=SimpleNamespace(com_range=com_range),
            changed=lambda best_of: best_of,
            tolerance=0.05,
        )
        monkeypatch.setattr(plan_search, "better_than", better_than)
        monkeypatch.setattr(plan_off_angles, "holds_off_its_angles", holds_off)
        monkeypatch.setattr(advice, "conclude", lambda question, found: own)
        return advice._planned(question, now, search, anew=anew), asked

    assert of(None, holds=True) == of(holds=True) == ((then, False), [])
    assert of(None) == of(com_range="range") == ((unsure, False), [])
    assert of() == ((best, True), [(Verdict.UNSURE, ("flippers", "facing"), "drives")])
    assert of(1) == ((best, True), [(Verdict.UNSURE, ("flippers",), "drives")])
    assert of(own=None)[0] == (unsure, False)  # no plan has a better verdict
    assert of(robust=False)[0] == (unsure, False)
    assert of(own=concluded(Verdict.UNSURE, 0.1))[0] == (unsure, False)
    # no GO at its angles: only where another plan may be the best
    assert of(now=unsure) == ((unsure, False), [])
    assert of(now=unsure, anew=True)[0] == (best, True)
