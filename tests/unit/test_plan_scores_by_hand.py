"""Scores of postures, and the search among them, on scores made by hand; nothing is driven."""

import math
from types import SimpleNamespace

import pytest

from kaidan import Question, Robot, Stairs
from kaidan.assessment import plan_finalists, plan_judged, plan_scores
from kaidan.assessment.plan_finalists import Candidate, _candidates
from kaidan.assessment.plan_hopes import Hope, Search
from kaidan.assessment.plan_judged import Judged, judged_of, shortened
from kaidan.assessment.plan_off_angles import OffAngles
from kaidan.assessment.plan_scores import ENOUGH, ROUNDING, Score, Scores
from kaidan.assessment.plans import Plan
from kaidan.models.findings import Findings
from kaidan.models.planned import STAND_OFF
from kaidan.models.quasi_static import Basis
from kaidan.modes import Phase, Verdict
from kaidan.outline import Outline
from kaidan.robot import Posture
from kaidan.terrain.profile import Profile
from kaidan.traversal.rating import Rated
from kaidan.traversal.rotations import ROCKING

GO, ROUGH, UNSURE, NO_GO, _ = (-each.rank for each in Verdict)
ONE = Robot.model_validate(Robot.named("absolem").model_dump() | {"rear_flippers": None})
FLIGHT = Stairs(rise=0.17, going=0.29, steps=6)
RATED = Rated(
    required_friction=0.5, belly_touches=False, rotation=0.2, rocking=0.0, impact_speed=0.1,
    spare=0.01, held=0.2, held_at_best=0.3, downhill=0.3, uphill=0.25,
)  # fmt: skip


def asked(terrain=FLIGHT, robot=ONE, **given):
    usual = {"friction": (0.6, 1.0), "theta_d": (0.01, 0.02), "theta_M": (0.01, 0.05)}
    return Question.in_one_posture(robot, terrain, **(usual | given))


def scores(terrain=FLIGHT, facing="nose-first", belts=None, **given):
    return Scores(asked(terrain, **given), facing, belts)


def degrees(*angles):
    return [Posture(front=math.radians(each)) for each in angles]


# scores


def test_the_score_of_a_drive():
    """Friction 0.6 to 1.0, less 0.07 rad downhill and 0.02 uphill; the smallest margin counts."""
    of = scores()._score
    slides = math.degrees(math.atan(0.6) - math.atan(0.5))
    drop, tips = (pytest.approx(math.degrees(each)) for each in (-0.2, 0.25 - 0.02))
    assert of(RATED) == Score(GO, 0, pytest.approx(slides), drop, tips)
    for given, margin in (({"downhill": 0.1}, 0.03), ({"uphill": 0.05}, 0.03)):
        assert of(RATED._replace(**given)).margin == pytest.approx(math.degrees(margin))
        assert of(RATED._replace(**given)).tipping == pytest.approx(math.degrees(margin))
    easy = RATED._replace(required_friction=0.1, downhill=math.inf, uphill=math.inf)
    assert of(easy).margin == ENOUGH
    assert of(RATED._replace(required_friction=1.0)).rank == NO_GO
    assert of(RATED._replace(required_friction=0.99)).rank == UNSURE


def test_grousers_hold_in_place_of_friction():
    """Their margin counts."""
    of = scores(belts=())._score
    assert of(RATED).margin == pytest.approx(math.degrees(0.2))
    assert of(RATED._replace(held=-0.01)).margin == pytest.approx(math.degrees(-0.01))
    assert of(RATED._replace(held=-0.01)).failing == -1
    assert of(RATED._replace(held_at_best=-0.01)).rank == NO_GO
    assert of(RATED._replace(held=-0.01, required_friction=1.2)).rank == UNSURE


def test_what_one_friction_rated_serves_another(monkeypatch):
    """Friction plays no part in a drive; what does is rated anew."""
    drives = []

    def rate(profile, parts, **how):
        drives.extend(parts)
        return real(profile, parts, **how)

    real = plan_scores.rate
    monkeypatch.setattr(plan_scores, "rate", rate)
    plan_scores.rated_on.cache_clear()
    both, posture = Robot.named("absolem"), Posture(front="flat", rear="flat")
    first = scores(robot=both).of(Phase.ENTER, posture)
    other = scores(robot=both, friction=0.9)
    assert other.of(Phase.ENTER, posture).margin > first.margin
    assert len(drives) == 1
    other.of(Phase.LAND, posture)
    scores(robot=both, facing="tail-first").of(Phase.ENTER, posture)
    scores(robot=both, direction="down").of(Phase.ENTER, posture)
    scores(Stairs(rise=0.16, going=0.29, steps=6), robot=both).of(Phase.ENTER, posture)
    assert len(drives) == 5
    monkeypatch.setattr(plan_scores, "MANY", 0)  # of too many all are forgotten
    scores(robot=both).of(Phase.TRAVERSE, posture)
    assert len(other._rated) == 1


def test_ways_in_which_a_drive_fails():
    of = scores()._score
    tolerated = ONE.tolerated_impact
    enough = scores().question.momentum_threshold()
    assert enough > 0.0
    for given in (
        {"required_friction": 0.6}, {"downhill": 0.07}, {"uphill": 0.02}, {"spare": enough},
        {"rocking": math.nextafter(ROCKING, 1)}, {"impact_speed": tolerated},
        {"belly_touches": True},
    ):  # fmt: skip
        assert of(RATED._replace(**given)).failing == -1
    for given in (
        {"required_friction": 0.599}, {"downhill": 0.071}, {"uphill": 0.021},
        {"spare": enough + 1e-9}, {"rocking": ROCKING}, {"impact_speed": 0.999 * tolerated},
    ):  # fmt: skip
        assert of(RATED._replace(**given)).failing == 0
    assert of(RATED._replace(downhill=0.0, uphill=0.0, belly_touches=True)).failing == -2


def test_no_posture_has_more_margin_on_the_flight_than_friction_leaves():
    slope = math.atan2(0.17, 0.29)
    by_hand = math.degrees(math.atan(0.6) - slope) - ROUNDING
    assert scores().bound(Phase.TRAVERSE) == pytest.approx(by_hand)
    assert scores(direction="down").bound(Phase.TRAVERSE) == pytest.approx(by_hand)
    assert scores().bound(Phase.LAND) == ENOUGH
    assert scores(Profile.of_points([(0, 0), (2, 0)])).bound(Phase.TRAVERSE) == ENOUGH


@pytest.mark.parametrize("direction", ["up", "down"])
def test_where_phases_begin_and_end(direction):
    """50 mm before the first nosing and before the last one, level and along the flight."""
    found = scores(direction=direction)
    driven = Profile.of_stairs(FLIGHT)
    driven = driven.reflected() if direction == "down" else driven
    first, last = (float(driven.nosings[k, 0]) - STAND_OFF for k in (0, -1))
    assert found.phases == tuple(Phase)
    assert found.stretch(Phase.ENTER) == (None, pytest.approx(first))
    start, until = found.stretch(Phase.TRAVERSE)
    assert (tuple(start), until) == (pytest.approx((first, 0.0, 0.0)), pytest.approx(last))
    start, until = found.stretch(Phase.LAND)
    slope = math.atan2(0.17, 0.29)
    slope = -slope if direction == "down" else slope
    assert (tuple(start), until) == (pytest.approx((last, 0.0, slope)), None)


def test_where_there_are_few_nosings():
    kerb = scores(Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)]))
    assert kerb.phases == (Phase.ENTER, Phase.LAND)
    assert kerb.stretch(Phase.LAND) == ((pytest.approx(-STAND_OFF), 0.0, 0.0), None)
    assert scores(Profile.of_points([(0, 0), (2, 0)])).phases == (Phase.ENTER,)
    for going, phases in ((STAND_OFF - 1e-6, 2), (STAND_OFF + 1e-6, 3)):
        two = [(-2, 0), (0, 0), (0, 0.1), (going, 0.1), (going, 0.2), (2, 0.2)]
        assert len(scores(Profile.of_points(two)).phases) == phases


def test_the_slope_on_which_it_begins_to_land_is_that_of_two_nosings():
    two = [(-2, 0), (0, 0), (0, 0.1), (0.3, 0.1), (0.3, 0.3), (2, 0.3)]
    start, _ = scores(Profile.of_points(two)).stretch(Phase.LAND)
    assert start.inclination == pytest.approx(math.atan2(0.2, 0.3))


def test_what_is_known_or_fails_holds_up_no_other_score(monkeypatch):
    """The first is known, the second's centroid lies outside; two are rated."""
    found = scores()
    known, outside, *rest = degrees(0.0, 10.0, 20.0, 30.0)
    found.known[Phase.ENTER, known] = "known"
    found._outlines[outside] = None
    monkeypatch.setattr(plan_scores, "rate", lambda profile, parts, **how: [RATED] * len(parts))
    plan_scores.rated_on.cache_clear()
    found.work_out((Phase.ENTER, each) for each in (known, outside, *rest))
    assert found.known[Phase.ENTER, known] == "known"
    assert found.known[Phase.ENTER, outside] == plan_scores.FAILED
    assert all(found.known[Phase.ENTER, each] == found._score(RATED) for each in rest)
    plan_scores.rated_on.cache_clear()


def test_off_its_angles_a_posture_is_as_good_as_the_worst():
    found = scores(flipper_tolerance=math.radians(2.0))
    posture, up, down = found.about(degrees(10.0)[0])
    assert math.degrees(up.front) == pytest.approx(12.0)
    assert math.degrees(down.front) == pytest.approx(8.0)
    for each, margin in ((posture, 5.0), (up, 3.0), (down, 4.0)):
        found.known[Phase.LAND, each] = Score(GO, 0, margin, 0.0)
    assert found.off(Phase.LAND, posture).margin == 3.0
    assert found.of(Phase.LAND, posture).margin == 5.0


def test_postures_up_and_down_by_both_pairs_and_turned_round():
    both = Robot.named("absolem")
    posture = Posture(front=0.3, rear=-0.2)
    found = scores(robot=both, flipper_tolerance=0.05)
    _, up, down = found.about(posture)
    assert (up.front, up.rear) == pytest.approx((0.35, -0.15))
    assert (down.front, down.rear) == pytest.approx((0.25, -0.25))
    outline = Outline.of(both, posture)
    back = scores(facing="tail-first", robot=both)._outline(posture)
    assert found._outline(posture).parts.tolist() == outline.parts.tolist()
    assert back.parts.tolist() == outline.turned_round().parts.tolist()


# the search among postures


def searching(value, limits=(-60.0, 60.0), **given):
    """A search of one phase in which a front angle [deg] has a value; stowed has -70."""
    low, high = map(math.radians, limits)
    search = Search(asked(**given), "nose-first", (low, high))
    asked_for = []

    def known(phase, posture):
        angle = posture.front
        at = math.degrees(angle) if isinstance(angle, float) else None
        asked_for.append(at)
        return Score(GO, 0, -70.0 if at is None else value(at), 0.0)

    search.scores = SimpleNamespace(
        of=known, off=known, work_out=list, about=lambda posture: [posture],
        bound=lambda phase: ENOUGH, facing="nose-first", phases=(Phase.ENTER,),
    )  # fmt: skip
    search._allowed = {Phase.ENTER: {Posture(): None}}
    return search, asked_for


def test_angles_are_refined_about_the_best():
    """A grid of 30 deg, then 15 and 7 deg about the best: 20 deg is met to within 4."""
    search, _ = searching(lambda at: -abs(at - 20.0))
    search._scan(Phase.ENTER, [Posture()], ENOUGH)
    tried = [round(math.degrees(each.front), 6) for each in search._allowed[Phase.ENTER]
             if each.front is not None]  # fmt: skip
    assert tried == [-60.0, -30.0, 0.0, 30.0, 60.0, 15.0, 45.0, 8.0, 22.0]
    best, *_, worst = search._ranked(Phase.ENTER)
    assert round(math.degrees(best.front), 6) == 22.0
    assert round(math.degrees(worst.front), 6) == -60.0  # -80, and stowed -70


def test_what_is_good_enough_is_not_refined():
    """At its angles as much as is wanted, off them no failure."""
    posture = degrees(10.0)[0]

    def tries(margin, off, enough=5.0, bound=ENOUGH):
        search, _ = searching(lambda at: margin)
        search.scores.off = lambda phase, each: Score(GO, 0, off, 0.0)
        search.scores.bound = lambda phase: bound
        search._better(Phase.ENTER, posture, "front", [0.5], enough)
        return len(search._allowed[Phase.ENTER]) > 1

    assert not tries(5.0, 0.0)
    assert tries(4.9, 0.0)
    assert tries(5.0, -0.1)
    assert not tries(4.9, 0.0, bound=4.0)
    assert tries(14.9, 0.0, enough=math.inf)
    assert not tries(ENOUGH, 0.0, enough=math.inf)


def test_angles_within_the_limits_and_in_whole_degrees():
    search, _ = searching(lambda at: at, limits=(-10.0, 20.0))
    angles = [math.radians(each) for each in (-10.0, -10.6, 19.6, 20.6, 3.4)]
    best = search._better(Phase.ENTER, degrees(0.0)[0], "front", angles, ENOUGH)
    tried = [round(math.degrees(each.front), 6) for each in list(search._allowed[Phase.ENTER])[1:]]
    assert tried == [-10.0, 3.0, 20.0]
    assert round(math.degrees(best.front), 6) == 20.0


def test_plans_put_together_of_two_phases():
    """Of those with as many changes the best comes first; of those alike the first."""
    search, _ = searching(lambda at: at)
    search.scores.phases = (Phase.ENTER, Phase.LAND)
    low, high = degrees(4.0, 6.0)
    found = search._together([[low, high], [low, high]])
    fronts = [[round(math.degrees(one.front)) for _, one in each.plan.postures] for each in found]
    assert fronts == [[6, 6], [4, 4], [4, 6], [6, 4]]
    assert found[0].merit == (GO, 0, pytest.approx(6 + 0.05 * 6))
    cost = 1.5 + 0.005 * 2
    assert found[2].merit == (GO, 0, pytest.approx(4 + 0.05 * 5 - cost))
    assert [phase for phase, _ in found[0].plan.postures] == [Phase.ENTER, Phase.LAND]
    assert search.off(found[0].plan) == found[0].merit


def test_which_plans_may_hold_on_their_grousers():
    """All that nothing is known of; else those whose phases fail nowhere off their angles."""
    plan = Plan("nose-first", tuple(zip((Phase.ENTER, Phase.LAND), degrees(4.0, 6.0), strict=True)))
    belts = {"track": ONE.track.model_copy(update={"belt": "grousers"})}
    on_grousers = ONE.model_copy(update=belts)
    assert Search(asked(), "nose-first", (-1.0, 1.0)).may_hold(plan)
    nobody = asked(robot=on_grousers, friction=None)
    assert Search(nobody, "nose-first", (-1.0, 1.0)).may_hold(plan)
    search = Search(asked(robot=on_grousers), "nose-first", (-1.0, 1.0))
    assert search.scores.belts is None
    assert len(search._on_belts.belts) == 4

    def may(**off):
        def score(phase, posture):
            return Score(**({"rank": GO, "failing": 0, "margin": 1.0, "drop": 0.0} | off))

        search._on_belts = SimpleNamespace(work_out=list, about=lambda one: [one], off=score)
        return search.may_hold(plan)

    assert may()
    assert not may(rank=ROUGH, failing=-1)
    assert not may(rank=NO_GO)


# plans judged


def conclusion(rank):
    verdict = next(each for each in Verdict if each.rank == -rank)
    return SimpleNamespace(verdict=verdict, margin=0.1, governs="", doubts=())


def judged(rank, name="plan"):
    question = SimpleNamespace(robot=None, postures=dict.fromkeys(Phase, Posture()), name=name)
    return Judged(question, None, conclusion(rank), 0.0, True)


class Named(SimpleNamespace):
    """Stands for a plan, and tells it from others."""

    __hash__ = object.__hash__


@pytest.fixture
def sturdiest(monkeypatch):
    """The best of candidates: of each its rank, the worst off its angles, whether it is tried."""

    def of(*each, grousers=False, doubtful=(), sturdier=None, beaten=None):
        search = SimpleNamespace(
            may_hold=lambda plan: plan.question(None) not in doubtful,
            question=SimpleNamespace(
                robot=SimpleNamespace(track=SimpleNamespace(has_grousers=grousers))
            ),
            scores=SimpleNamespace(facing="tail-first", phases=tuple(Phase)), limits=None,
        )  # fmt: skip
        bars, promised = [], []
        ranks = {str(k): one[:2] for k, one in enumerate(each)}
        if sturdier is not None:
            ranks["sturdier"] = sturdier

        def plan(name):
            return Named(
                question=lambda question: name, facing="tail-first",
                postures=[(phase, Posture()) for phase in Phase],
            )  # fmt: skip

        candidates = [
            Candidate(plan(str(k)), (GO, 0, 0.0), (one[0], 0 if one[0] == GO else -1, 0.0))
            for k, one in enumerate(each)
        ]

        def may(search, one, bar, of_best, drives):
            bars.append(bar)
            promised.append(None if of_best is None else of_best.plan.question(None))
            return each[int(one.plan.question(None))][2]

        def judged_off(one, bar, drives, search=None):
            worst = (ranks[one.question.name][1], *one.merit[1:])
            return OffAngles(one, worst, True)

        class Found:
            def __init__(self, *given):
                pass

            def plan(self, plan):
                assert plan.facing == "tail-first"
                assert [phase for phase, _ in plan.postures] == list(Phase)
                return None if sturdier is None else SimpleNamespace(question=lambda _: "sturdier")

        monkeypatch.setattr(plan_finalists, "_candidates", lambda search: candidates)
        monkeypatch.setattr(plan_finalists, "_may_be_better", may)
        monkeypatch.setattr(
            plan_finalists, "_judged", lambda name, drives: judged(ranks[name][0], name)
        )
        monkeypatch.setattr(plan_finalists, "judged_off", judged_off)
        monkeypatch.setattr(plan_finalists, "Sturdier", Found)
        found = plan_finalists.sturdiest(search, beaten, "drives")
        return (None if found is None else found.judged.question.name), bars, promised

    return of


def test_the_sturdiest_of_candidates(sturdiest):
    """The best off its angles, the first of those alike; what cannot be better is not judged."""
    assert sturdiest((GO, GO, True), (GO, GO, True))[0] == "0"
    assert sturdiest((GO, UNSURE, True), (GO, GO, True))[0] == "1"
    assert sturdiest((GO, UNSURE, True), (GO, GO, False), (GO, GO, True))[0] == "2"
    low = judged(UNSURE).merit
    assert sturdiest((GO, GO, False), beaten=low)[:2] == (None, [low])
    # what there is to beat, and of the best one what it promised, where it came to that
    _, bars, promised = sturdiest((UNSURE, UNSURE, True), (GO, UNSURE, True), (GO, GO, True))
    assert [bar[0] for bar in bars] == [UNSURE, UNSURE]
    assert promised[-1] == "0"
    assert sturdiest((GO, UNSURE, True), (GO, GO, True))[2] == [None]


def test_a_plan_that_is_go_at_its_angles_alone_is_made_sturdier(sturdiest):
    assert sturdiest((GO, UNSURE, True), sturdier=(GO, GO))[0] == "sturdier"
    assert sturdiest((GO, UNSURE, True), sturdier=(GO, NO_GO))[0] == "0"
    assert sturdiest((GO, UNSURE, True))[0] == "0"
    assert sturdiest((GO, GO, True), sturdier=(GO, GO))[0] == "0"  # it holds already
    # one that is no GO is worth it on grousers only
    assert sturdiest((UNSURE, UNSURE, True), sturdier=(GO, GO))[0] == "0"
    assert sturdiest((UNSURE, UNSURE, True), sturdier=(GO, GO), grousers=True)[0] == "sturdier"
    assert sturdiest((NO_GO, NO_GO, True), sturdier=(GO, GO), grousers=True)[0] == "0"
    # of those that do not hold off them one that does is sought first; they are judged without it
    grips = {"grousers": True, "doubtful": ("0", "1")}
    name, bars, _ = sturdiest((UNSURE, UNSURE, True), sturdier=(GO, GO), **grips)
    assert (name, bars) == ("sturdier", [])
    name, bars, _ = sturdiest((UNSURE, UNSURE, True), sturdier=(GO, NO_GO), **grips)
    assert (name, bars[0][0]) == ("0", NO_GO)
    assert sturdiest((NO_GO, NO_GO, True), sturdier=(GO, GO), **grips)[0] == "0"
    assert sturdiest((UNSURE, UNSURE, True), **grips)[0] == "0"
    each = (UNSURE, UNSURE, True), (GO, UNSURE, True), (GO, GO, True)
    name, bars, _ = sturdiest(*each, sturdier=(GO, GO), **grips)
    assert (name, bars) == ("2", [])
    name, bars, _ = sturdiest(*each[:2], sturdier=(UNSURE, UNSURE), **grips)
    assert [bar[0] for bar in bars] == [UNSURE, UNSURE]
    low = judged(UNSURE).merit
    name, bars, _ = sturdiest((GO, NO_GO, False), sturdier=(GO, GO), beaten=low, **grips)
    assert (name, bars) == ("sturdier", [])
    # the best of all at its angles is what counts
    assert sturdiest(
        (UNSURE, UNSURE, True), (GO, NO_GO, True), sturdier=(GO, GO)
    )[0] == "sturdier"  # fmt: skip


def test_which_plans_are_judged_and_in_which_order():
    """The two best off their angles and the best at them; by the verdict that they promise."""
    merits = {
        name: (GO, 0, value) for name, value in zip("abcd", (9.0, 8.0, 7.0, 6.0), strict=True)
    }
    off = {
        "a": (NO_GO, 0, 0.0), "b": (ROUGH, -1, 0.0), "c": (GO, 0, 1.0), "d": (UNSURE, -2, 0.0),
    }  # fmt: skip
    search = SimpleNamespace(
        hopes=lambda: [Hope(name, merit) for name, merit in merits.items()], off=off.get,
        question=SimpleNamespace(
            robot=SimpleNamespace(track=SimpleNamespace(has_grousers=False))
        ),
    )  # fmt: skip
    found = _candidates(search)
    assert [one.plan for one in found] == ["c", "b", "a"]
    assert [(one.hope, one.off) for one in found] == [
        (merits[name], off[name]) for name in ("c", "b", "a")
    ]


def test_what_a_plan_comes_to(monkeypatch):
    """The largest rotation of all its parts; it arrives if all of them do."""
    monkeypatch.setattr(plan_judged, "conclude", lambda question, found: "conclusion")

    def part(arrived, *angles):
        chains = [SimpleNamespace(angle=math.radians(each)) for each in angles]
        return SimpleNamespace(traverse=SimpleNamespace(arrived=arrived, chains=chains))

    def of(*parts):
        basis = Basis(None, SimpleNamespace(parts=parts))
        found = judged_of("question", Findings(model="", basis=basis))
        return found.drop, found.arrives

    assert of(part(True, 3.0, -8.0, 5.0), part(True)) == (pytest.approx(8.0), True)
    assert of(part(True), part(False, 0.5)) == (pytest.approx(0.5), False)
    assert of(part(True)) == (0.0, True)
    assert judged_of("question", Findings(model="")).drop == 0.0


def test_a_long_flight_is_shortened_to_what_says_all():
    """As many nosings as the robot spans, its flippers stretched, and two more; five at least."""
    reach = sum(Outline.of(ONE, Posture(front=0.0)).reach)
    for going in (0.29, 0.2):
        enough = math.ceil(reach / math.hypot(0.17, going)) + 2
        for steps, left in ((60, enough), (enough + 1, enough), (enough, enough)):
            flight = Stairs(rise=0.17, going=going, steps=steps)
            assert shortened(asked(flight)).terrain.steps == left
    wide = Stairs(rise=0.3, going=2.0, steps=20)
    assert shortened(asked(wide)).terrain.steps == 5
