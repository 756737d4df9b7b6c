"""The search for a plan: which end leads, and the posture of each phase.

Each phase is driven from a start of its own, so that a posture that is good for landing is found
although it would never have come so far. Postures are compared by a cheap score; plans put
together of the best of each phase are then driven in one go, changes included, and judged by the
verdict policy, at the angles found and a little off them. A change has to gain something.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import chain, pairwise, product
from typing import NamedTuple

import numpy as np

from kaidan import contact
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.errors import InputError
from kaidan.models import judge, planned
from kaidan.models.findings import Findings
from kaidan.models.quasi_static import Basis, findings_of, profile_of, traverse_of
from kaidan.modes import CONTACT, FALLS, Facing, Phase, Verdict
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Posture, PostureChange, Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Traverse, traverse
from kaidan.traversal.moves import angles_of
from kaidan.traversal.rotations import ROCKING
from kaidan.traversal.samples import trailing_end_leaves

LIMITS = (math.radians(-75.0), math.radians(90.0))
"""Angles tried where nobody states any [rad]: from pushed down to upright."""
TOLERANCE = math.radians(2.0)
"""How far off its angles a plan has to hold [rad]."""
GRID = math.radians(30.0)
"""Distance of the angles tried first [rad]."""
REFINED = (math.radians(15.0), math.radians(7.0))
"""Distances of those tried then about the best [rad]."""
COARSE, FINE = 0.04, 0.02
"""Arclength between poses while searching and while judging [m]; events are located anyway."""
ENOUGH = 15.0
"""Margin beyond which more is not better [deg]."""
A_CHANGE = 1.5
"""Margin that a change of posture has to gain [deg]."""
A_DROP = 0.1
"""Margin that a degree less of the largest drop outweighs [1]."""
A_TURN = 0.005
"""Margin that a degree less of the flippers' turns outweighs [1]."""
A_PHASE = 0.05
"""What the mean over the phases counts beside the weakest [1]."""
PROMISING = 8
"""Plans of each number of changes that are scored off their angles."""
FINALISTS = 3
"""Of those, the plans that are driven in one go and judged: the best one at its angles too."""
KEPT = 3
"""Postures of each phase that are put together to plans."""
UNKNOWN = 1.0
"""Friction by which postures are compared where nobody states one [1]."""
ROUNDING = 0.05
"""Difference of margins that is none [deg]."""
GENTLE = 5.0
"""Rotation that nothing has to spare the robot [deg]."""


class Score(NamedTuple):
    """What a drive of one phase lets one hope for; larger is better."""

    passes: bool
    """Whether the robot gets through, with the friction stated."""
    failing: int
    """Ways in which it fails in the worst case, with its sign turned."""
    margin: float
    """Smallest margin of slope in the worst case, `ENOUGH` at most [deg]."""
    drop: float
    """Largest rotation, with its sign turned [deg]."""

    @property
    def value(self) -> float:
        """Margin less what the drop costs [deg]."""
        return self.margin - cost_of_drop(-self.drop)

    def does(self, margin: float) -> bool:
        """Whether no other posture has to be tried for such a margin [deg]."""
        return self.passes and not self.failing and self.margin >= margin and -self.drop <= GENTLE

    @property
    def merit(self) -> tuple[bool, int, float]:
        """Order of postures in one phase; larger is better."""
        return self.passes, self.failing, round(self.value, 2)


class Plan(NamedTuple):
    """Which end leads, and the posture of each phase that has one of its own."""

    facing: Facing
    postures: tuple[tuple[Phase, Posture], ...]

    def question(self, question: Question) -> Question:
        """A question with this plan."""
        (_, first), *others = self.postures
        changes = tuple(
            PostureChange(before=phase.value, posture=posture)
            for (phase, posture), (_, last) in zip(others, self.postures, strict=False)
            if posture != last
        )
        return question.changed(facing=self.facing, posture=first, changes=changes, best_of=())


def cost_of_drop(drop: float) -> float:
    """Margin that the largest drop of a plan outweighs [deg]."""
    return A_DROP * max(drop - GENTLE, 0.0)


def cost_of(robot: Robot, postures: Sequence[Posture]) -> float:
    """Margin that the changes of a plan have to gain [deg]."""
    return _cost([_turns(robot, one, two) for one, two in pairwise(postures) if one != two])


def _turns(robot: Robot, one: Posture, two: Posture) -> list[float]:
    """How far each pair of flippers turns from one posture to another [rad]."""
    was = angles_of(robot, one)
    return [abs(angle - was[end]) for end, angle in angles_of(robot, two).items()]


def _cost(turns: Sequence[Sequence[float]]) -> float:
    """Margin that changes with such turns have to gain [deg]."""
    return A_CHANGE * len(turns) + A_TURN * math.degrees(sum(chain.from_iterable(turns)))


class Hope(NamedTuple):
    """A plan and what the scores of its phases let one hope for."""

    plan: Plan
    merit: tuple[bool, int, float]
    changes: int
    """Number of changes of posture."""


class Judged(NamedTuple):
    """A plan driven in one go, at its angles or off them."""

    question: Question
    findings: Findings
    conclusion: Conclusion
    drop: float
    """Largest rotation [deg]."""

    @property
    def merit(self) -> tuple[int, int, float]:
        """Verdict, what fails, margin less what drop and changes cost; larger is better."""
        margin = math.degrees(self.conclusion.margin)
        falls = self.conclusion.governs in {mode.key for mode in FALLS}
        if math.isnan(margin) or (falls and self.conclusion.verdict is Verdict.NO_GO):
            margin = -90.0  # a fall from less far is no help
        margin = min(margin, ENOUGH)
        cost = cost_of_drop(self.drop)
        cost += cost_of(self.question.robot, list(self.question.postures.values()))
        return (
            -self.conclusion.verdict.rank,
            -len(self.conclusion.doubts),
            round(margin - cost, 6),
        )


class Found(NamedTuple):
    """What a search came upon."""

    question: Question
    """With the plan."""
    findings: Findings
    """Of that question."""
    sturdy: bool
    """Whether its verdict holds within `TOLERANCE` of its angles."""
    tried: int
    """Drives of a phase."""
    short: Question
    """On which it searched: a long uniform flight repeats itself."""

    @property
    def holds_within(self) -> float:
        """How far off its angles its verdict holds [rad]: `TOLERANCE`, or not at all."""
        return TOLERANCE if self.sturdy else 0.0


def found_of(question: Question, limits: tuple[float, float] = LIMITS) -> Found:
    """Best plan of a question whose posture is to be found.

    Parameters
    ----------
    question : Question
        With `best_of`.
    limits : (float, float)
        Angles allowed [rad]; the stowed angle and lying flat always are.

    Returns
    -------
    Found
        Of plans that are alike the one with fewer changes, nose first, flippers stowed.
    """
    stated = question.changed(best_of=(), changes=())
    facings: tuple[Facing, ...] = (stated.facing,)
    if "facing" in question.best_of:
        facings = ("nose-first", "tail-first")
    if stated.model != CONTACT.name or stated.yaw:
        return _fixed(stated, facings)
    short = shortened(stated)
    plans: list[_Off] = []
    tried = 0
    for facing in facings:
        search = _Search(short, facing, limits)
        plans.append(_sturdiest(search))
        tried += len(search.scores)
        if plans[-1].sturdy and plans[-1].judged.conclusion.verdict is Verdict.GO:
            break
    return _on_the_whole(stated, sorted(plans, key=lambda each: each.worst, reverse=True), tried)


def _on_the_whole(stated: Question, plans: Sequence["_Off"], tried: int) -> Found:
    """First of some plans whose verdict the whole terrain, pose by pose, does not lower."""
    each = []
    for plan in plans:
        question = plan.judged.question.changed(terrain=stated.terrain)
        each.append((judged_of(question, judge(question)), plan))
        if each[-1][0].merit[0] >= plan.judged.merit[0]:
            break
    whole, plan = max(each, key=lambda one: one[0].merit[0])
    return Found(whole.question, whole.findings, plan.sturdy, tried, plan.judged.question)


class _Off(NamedTuple):
    """A plan judged at its angles and off them."""

    judged: Judged
    worst: tuple[int, int, float]
    """Merit with the worst verdict off its angles."""

    @property
    def sturdy(self) -> bool:
        return self.worst == self.judged.merit


def _sturdiest(search: "_Search") -> _Off:
    """Best plan of a search: the most promising off their angles, judged in one go."""
    hopes = _different(search.plans())
    first = max(hopes, key=lambda hope: hope.merit)
    chosen = dict.fromkeys([*_best_off(search, hopes, FINALISTS - 1), first.plan])
    finalists = [_judged(plan.question(search.question)) for plan in chosen]
    finalists.sort(key=lambda each: each.merit, reverse=True)
    best: _Off | None = None
    for each in finalists:
        worst = _worst_off(each, None if best is None else best.worst)
        if best is None or worst > best.worst:
            best = _Off(each, worst)
        if best.sturdy:
            break
    assert best is not None
    return best


def _best_off(search: "_Search", hopes: Sequence["Hope"], count: int) -> list[Plan]:
    """Plans of the largest merit off their angles, which is never larger than at them."""
    best: list[tuple[tuple[bool, int, float], tuple[bool, int, float], Plan]] = []
    for hope in sorted(hopes, key=lambda hope: hope.merit, reverse=True):
        if len(best) == count and hope.merit < best[-1][0]:
            break
        best.append((search.off(hope.plan), hope.merit, hope.plan))
        best = sorted(best, key=lambda each: each[:2], reverse=True)[:count]
    return [plan for *_, plan in best]


def _worst_off(plan: Judged, beaten: tuple[int, int, float] | None) -> tuple[int, int, float]:
    """Merit with the worst verdict off its angles; no more than what is beaten is looked for."""
    worst = plan.merit
    for off in off_angles(plan.question):
        if beaten is not None and worst <= beaten:
            break
        worst = (min(worst[0], _judged(off).merit[0]), *plan.merit[1:])
    return worst


def _different(hopes: Iterable["Hope"]) -> list["Hope"]:
    """Most promising plans without a change, with one, and with two."""
    ranked = sorted(hopes, key=lambda hope: hope.merit, reverse=True)
    return [
        hope
        for count in range(len(Phase))
        for hope in [each for each in ranked if each.changes == count][:PROMISING]
    ]


def _fixed(question: Question, facings: Sequence[Facing]) -> Found:
    """Best of the words for postures, for a model that judges one posture throughout."""
    words = list(_words(question.robot))
    each = [
        _judged(Plan(facing, ((Phase.ENTER, posture),)).question(question))
        for facing in facings
        for posture in words
    ]
    best = max(each, key=lambda one: one.merit)
    return Found(best.question, judge(best.question), True, len(each), question)


def _judged(question: Question) -> Judged:
    found = judge_coarsely(question) if question.model == CONTACT.name else judge(question)
    return judged_of(question, found)


def judged_of(question: Question, found: Findings) -> Judged:
    """What findings of a plan come to, beside those of others."""
    traverses: list[Traverse] = []
    if isinstance(found.basis, Basis):
        driven = found.basis.traverse
        traverses = [driven] if isinstance(driven, Traverse) else [p.traverse for p in driven.parts]
    drop = max((_drop(each) for each in traverses), default=0.0)
    return Judged(question, found, conclude(question, found), drop)


def judge_coarsely(question: Question) -> Findings:
    """Findings of the contact model from poses farther apart."""
    if question.changes:
        return planned.findings(question, planned.drive(question, step=FINE))
    return findings_of(question, Basis(question, traverse_of(question, step=FINE)))


def _drop(found: Traverse) -> float:
    """Largest rotation of a traverse [deg]."""
    return max((math.degrees(abs(each.angle)) for each in found.chains), default=0.0)


def off_angles(question: Question) -> Iterator[Question]:
    """The same with every angle a tolerance off, pairs both ways."""
    robot = question.robot
    postures = [question.posture, *(each.posture for each in question.changes)]
    for off in dict.fromkeys(zip(*(_off(robot, each) for each in postures), strict=True)):
        if off == tuple(postures):
            continue
        changes = tuple(
            each.model_copy(update={"posture": posture})
            for each, posture in zip(question.changes, off[1:], strict=True)
        )
        yield question.changed(posture=off[0], changes=changes)


def _off(robot: Robot, posture: Posture) -> list[Posture]:
    """Postures with every angle a tolerance off, both ways; stowed flippers lie at their stop."""
    angles = angles_of(robot, posture)
    return [
        posture.model_copy(
            update={
                end: angles[end] + sign * TOLERANCE
                for end, sign in zip(angles, signs, strict=True)
                if getattr(posture, end) is not None
            }
        )
        for signs in product((1.0, -1.0), repeat=len(angles))
    ]


def shortened(question: Question) -> Question:
    """Same question on a flight just long enough for what repeats; others stay as they are.

    A uniform flight repeats itself once the robot has left the lower landing: as many nosings as
    the robot spans, and three more, hold every pose of the whole flight.
    """
    stairs = question.terrain
    if not isinstance(stairs, Stairs) or stairs.rise is None:
        return question
    reach = sum(question.outline.reach)
    reach += sum(pair.length for pair in question.robot.flippers().values())
    enough = max(5, math.ceil(reach / stairs.nosing_spacing) + 3)
    short = stairs.model_copy(update={"steps": min(stairs.steps, enough)})
    return question.changed(terrain=short)


def _words(robot: Robot) -> Iterator[Posture]:
    """Postures that have a name: stowed and flat, in every state."""
    pairs = list(robot.flippers())
    for state in (None, *robot.states):
        for laid in product((None, "flat"), repeat=len(pairs)):
            yield Posture(**dict(zip(pairs, laid, strict=True)), state=state)


def _pressed(robot: Robot, posture: Posture) -> Posture:
    """Flat flippers in whole degrees so far below the flat that off their angle they still are.

    Above it they hang in the air until the robot rotates onto them.
    """
    angles = {
        end: math.radians(math.floor(math.degrees(pair.flat_angle - TOLERANCE)))
        for end, pair in robot.flippers().items()
        if getattr(posture, end) == "flat"
    }
    return posture.model_copy(update=angles)


@dataclass
class _Search:
    """Scores of postures in each phase, one end leading."""

    question: Question
    facing: Facing
    limits: tuple[float, float]
    scores: dict[tuple[Phase, Posture], Score] = field(default_factory=dict)
    tried: set[tuple[Phase, Posture]] = field(default_factory=set)
    """Of those the ones at angles that a plan may have."""

    def plans(self) -> Iterator[Hope]:
        """Plans of the best postures of each phase."""
        robot = self.question.robot
        named = list(_words(robot))
        words = list(dict.fromkeys([*named, *(_pressed(robot, each) for each in named)]))
        self.tried.update(product(self.phases, words))
        first = {
            phase: max((self.score(phase, each) for each in words), key=_merit)
            for phase in self.phases
        }
        # the weakest phase first: what the others gain beyond it counts little
        enough = math.inf
        for phase in sorted(first, key=lambda phase: first[phase].merit):
            self._scan(phase, words, enough)
            enough = min(enough, max(self._of(phase).values(), key=_merit).margin)
        best = {phase: self._ranked(phase) for phase in self.phases}
        alone = [each[0] for each in best.values()]
        # by their numbers, as there are a thousand plans: postures are slow to compare
        number: dict[Posture, int] = {}
        choices = [
            [
                (number.setdefault(each, len(number)), each, self.score(phase, each))
                for each in dict.fromkeys([*words, *best[phase][:KEPT], *alone])
            ]
            for phase in self.phases
        ]
        known = list(number)
        turns = cache(lambda one, two: _turns(robot, known[one], known[two]))
        for chosen in product(*choices):
            numbers, postures, scores = zip(*chosen, strict=True)
            changes = [turns(one, two) for one, two in pairwise(numbers) if one != two]
            plan = Plan(self.facing, tuple(zip(self.phases, postures, strict=True)))
            yield Hope(plan, self._together(scores, _cost(changes)), len(changes))

    def _together(self, scores: Sequence[Score], cost: float) -> tuple[bool, int, float]:
        """Order of plans: the weakest phase counts, and a little the others."""
        value = min(each.margin for each in scores)
        value -= cost_of_drop(max(-each.drop for each in scores))
        value += A_PHASE * sum(each.value for each in scores) / len(scores)
        value -= cost
        passes, failing = all(s.passes for s in scores), sum(s.failing for s in scores)
        return passes, failing, round(value, 6)

    def off(self, plan: Plan) -> tuple[bool, int, float]:
        """What a plan lets one hope for where its angles are a tolerance off."""
        worst = [self._off(phase, posture) for phase, posture in plan.postures]
        postures = [posture for _, posture in plan.postures]
        return self._together(worst, cost_of(self.question.robot, postures))

    def _off(self, phase: Phase, posture: Posture) -> Score:
        """Worst score of a posture and those a tolerance off its angles."""
        both = _off(self.question.robot, posture)
        off = (posture, both[0], both[-1])  # all angles up, all down; judged are the others too
        return min((self.score(phase, each) for each in off), key=_merit)

    def _of(self, phase: Phase) -> dict[Posture, Score]:
        return {
            posture: score
            for (of, posture), score in self.scores.items()
            if of is phase and (of, posture) in self.tried
        }

    def _ranked(self, phase: Phase) -> list[Posture]:
        """Postures of a phase, the best first, of those alike the one that was tried first."""
        of = self._of(phase)
        return sorted(of, key=lambda posture: of[posture].merit, reverse=True)

    def _scan(self, phase: Phase, words: Iterable[Posture], enough: float) -> None:
        """Try angles of one pair after the other, then about the best; the leading pair first."""
        pairs = list(self.question.robot.flippers())
        if self.facing == "tail-first":
            pairs.reverse()
        best = max(words, key=lambda each: self.score(phase, each).merit)
        for end in pairs:
            best = self._better(phase, best, end, self._grid(), enough)
        for step in REFINED:
            for end in pairs:
                at = angles_of(self.question.robot, best)[end]
                best = self._better(phase, best, end, (at - step, at + step), enough)

    def _grid(self) -> Iterator[float]:
        low, high = self.limits
        count = max(1, round((high - low) / GRID))
        for k in range(count + 1):
            yield math.radians(round(math.degrees(low + (high - low) * k / count)))

    def _better(
        self, phase: Phase, best: Posture, end: str, angles: Iterable[float], enough: float
    ) -> Posture:
        """Best posture of one pair's angles; as it is where it is good enough already."""
        enough = min(enough, ENOUGH, self._bound(phase))
        if self.score(phase, best).does(enough) and self._off(phase, best).does(0.0):
            return best
        low, high = self.limits
        whole = {math.radians(round(math.degrees(each))) for each in angles}
        tried = [
            best.model_copy(update={end: each}) for each in sorted(whole) if low <= each <= high
        ]
        self.tried.update((phase, each) for each in tried)
        return max([best, *tried], key=lambda each: self.score(phase, each).merit)

    def _bound(self, phase: Phase) -> float:
        """Margin that no posture exceeds by friction alone, as long as the flat carries [deg]."""
        slope = self._driven.angle
        if phase is not Phase.TRAVERSE or math.isnan(slope):
            return ENOUGH
        low = UNKNOWN if self.question.surface is None else self.question.friction[0]
        return math.degrees(math.atan(low) - abs(slope)) - ROUNDING

    @cached_property
    def _profile(self) -> Profile:
        return profile_of(self.question)

    @cached_property
    def _driven(self) -> Profile:
        down = self.question.direction == "down"
        return self._profile.reflected() if down else self._profile

    @cached_property
    def _stops(self) -> dict[Phase, float]:
        """Where the posture may change before a phase [m]: nowhere without nosings."""
        if len(self._driven.nosings) == 0:
            return {}
        each = {
            phase: planned.stop(self.question, self._profile, phase)
            for phase in (Phase.TRAVERSE, Phase.LAND)
        }
        if each[Phase.LAND] - each[Phase.TRAVERSE] < planned.STAND_OFF:
            del each[Phase.TRAVERSE]
        return each

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """Phases that may have a posture of their own."""
        return (Phase.ENTER, *self._stops)

    def _start(self, phase: Phase) -> contact.Placement | None:
        """Where a phase begins, roughly: the robot settles there in the posture at hand."""
        if phase is Phase.ENTER:
            return None
        nosings = self._driven.nosings
        slope = 0.0
        if phase is Phase.LAND and len(nosings) > 1:
            slope = math.atan2(*(nosings[-1] - nosings[-2])[::-1].tolist())
        return contact.Placement(self._stops[phase], 0.0, slope)

    def score(self, phase: Phase, posture: Posture) -> Score:
        """Score of a posture in a phase that is driven from its own start."""
        key = phase, posture
        if key not in self.scores:
            try:
                self.scores[key] = self._score(phase, posture)
            except InputError:  # a centroid outside the robot
                self.scores[key] = FAILED
        return self.scores[key]

    def _score(self, phase: Phase, posture: Posture) -> Score:
        question = self.question
        then = dict(zip(self.phases, self.phases[1:], strict=False)).get(phase)
        found = traverse(
            self._profile,
            Outline.of(question.robot, posture, question.payload),
            descending=question.direction == "down",
            facing=self.facing,
            acceleration=question.acceleration,
            with_margins=False,
            step=COARSE,
            start=self._start(phase),
            until=None if then is None else self._stops[then],
        )
        if not found.arrived:
            return FAILED
        return _scored(question, found)


FAILED = Score(passes=False, failing=-9, margin=-90.0, drop=-90.0)


def _merit(score: Score) -> tuple[bool, int, float]:
    return score.merit


def _scored(question: Question, found: Traverse) -> Score:
    """Score of a part of a traverse that was driven to its end."""
    margins = found.path.margins_of(slice(None), acceleration=found.acceleration)
    landing = found.phase_of_pose == Phase.LAND.value
    held = ~(trailing_end_leaves(found.path) & landing)
    friction = np.nan_to_num(margins.required_friction[held], nan=np.inf).max(initial=0.0)
    low, high = question.friction
    if question.surface is None:
        low, high = UNKNOWN, math.inf
    slides = math.atan(low) - math.atan(friction)
    d, M = question.allowance_d.high, question.allowance_M.high
    tips = [
        worst.margin - off
        for downhill, off in ((True, d + M), (False, d))
        if found.whole and (worst := found.criterion.smallest(downhill=downhill)) is not None
    ]
    chains = found.chains
    failing = (
        slides <= 0,
        any(each <= 0 for each in tips),
        any(each.avoidable > ROCKING for each in chains),
        any(each.impact_speed >= question.robot.tolerated_impact for each in chains),
        any(each.spare <= 0 for each in chains),
        bool(margins.belly_touches.any()),
    )
    return Score(
        passes=bool(friction < high),
        failing=-sum(failing),
        margin=min(math.degrees(min([slides, *tips])), ENOUGH),
        drop=-_drop(found),
    )
