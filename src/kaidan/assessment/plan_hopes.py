"""Plans put together of the best postures of each phase, and what their scores let one hope for."""

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment.plan_scores import ENOUGH, Score, Scores
from kaidan.assessment.plans import Plan, cost_of, cost_of_drop, costs_of_changes, pressed, words
from kaidan.models.traction import gripping
from kaidan.modes import Facing, Phase, Verdict
from kaidan.question import Question
from kaidan.robot import Posture
from kaidan.traversal.moves import angles_of

Array = NDArray[np.float64]
Merit = tuple[int, int, float]

LIMITS = (math.radians(-75.0), math.radians(90.0))
"""Angles tried where nobody states any [rad]: from pushed down to upright."""
GRID = math.radians(30.0)
"""Distance of the angles tried first [rad]."""
REFINED = (math.radians(15.0), math.radians(7.0))
"""Distances of those tried then about the best [rad]."""
A_PHASE = 0.05
"""What the mean over the phases counts beside the weakest [1]."""
PROMISING = 8
"""Plans of each number of changes that are scored off their angles."""
KEPT = 3
"""Postures of each phase that are put together to plans."""


class Hope(NamedTuple):
    """A plan and what the scores of its phases let one hope for."""

    plan: Plan
    merit: Merit


class Search:
    """Search among the postures of each phase, one end leading.

    facing, {"nose-first", "tail-first"}: which end leads.
    limits: angles allowed [rad].
    """

    def __init__(self, question: Question, facing: Facing, limits: tuple[float, float]) -> None:
        self.question, self.limits = question, limits
        self.scores = Scores(question, facing)
        self._allowed: dict[Phase, dict[Posture, None]] = {}
        """Postures of each phase at angles that a plan may have."""
        belts = None if question.uncertain else gripping(question)
        self._on_belts = None if belts is None else Scores(question, facing, belts)

    def hopes(self) -> list[Hope]:
        """Most promising plans without a change, with one, and with two."""
        robot, scores = self.question.robot, self.scores
        named = list(words(robot))
        low = (pressed(robot, each, self.question.tolerance) for each in named)
        known = list(dict.fromkeys([*named, *low]))
        self._allowed = {phase: dict.fromkeys(known) for phase in scores.phases}
        scores.work_out((phase, each) for phase in scores.phases for each in known)
        first = {
            phase: max(scores.of(phase, each).merit for each in known) for phase in scores.phases
        }
        # the weakest phase first: what the others gain beyond it counts little
        enough = math.inf
        for phase in sorted(first, key=lambda phase: first[phase]):
            self._scan(phase, known, enough)
            enough = min(enough, scores.of(phase, self._ranked(phase)[0]).margin)
        best = {phase: self._ranked(phase) for phase in scores.phases}
        alone = [each[0] for each in best.values()]
        return self._together(
            [list(dict.fromkeys([*known, *best[phase][:KEPT], *alone])) for phase in scores.phases]
        )

    def off(self, plan: Plan) -> Merit:
        """What a plan lets one hope for where its angles are a tolerance off."""
        return self._off(plan, self.scores)

    def may_hold(self, plan: Plan) -> bool:
        """Whether a plan may be a GO off its angles, by its grousers where they are known."""
        if self._on_belts is None:
            return True
        return self._off(plan, self._on_belts)[0] == -Verdict.GO.rank

    def _off(self, plan: Plan, scores: Scores) -> Merit:
        scores.work_out(
            (phase, each) for phase, posture in plan.postures for each in scores.about(posture)
        )
        worst = [scores.off(phase, posture) for phase, posture in plan.postures]
        return self._merit(worst, [posture for _, posture in plan.postures])

    def weakest_first(self, questions: Iterable[Question]) -> list[Question]:
        """Questions with a plan each, in the order of what its scores let one hope for.

        Those that are not scored in every phase come last.
        """
        return sorted(questions, key=self._known_merit)

    def _known_merit(self, question: Question) -> tuple[bool, Merit]:
        at = question.postures
        scores = [self.scores.known.get((phase, at[phase])) for phase in self.scores.phases]
        known = [each for each in scores if each is not None]
        if len(known) < len(scores):
            return True, (-Verdict.GO.rank, 0, 0.0)
        return False, self._merit(known, list(at.values()))

    def _merit(self, scores: Iterable[Score], postures: Sequence[Posture]) -> Merit:
        """What the scores of a plan's phases come to."""
        cost = cost_of(self.question.robot, postures)
        rank, failing, value = _order([_figures([each])[:, 0] for each in scores], cost)
        return int(rank), int(failing), float(value)

    def _together(self, choices: Sequence[Sequence[Posture]]) -> list[Hope]:
        """The most promising of all plans of some choices for each phase."""
        phases, count = self.scores.phases, len(choices)
        costs, changes = self._changes(choices)
        figures = [
            _figures(self.scores.of(phase, each) for each in some).reshape(5, *_along(k, count))
            for k, (phase, some) in enumerate(zip(phases, choices, strict=True))
        ]
        merits = [np.broadcast_to(one, changes.shape).ravel() for one in _order(figures, costs)]
        order = np.lexsort([-one for one in reversed(merits)])
        chosen = chain.from_iterable(
            order[changes.ravel()[order] == number][:PROMISING].tolist() for number in range(count)
        )
        found = []
        for at in chosen:
            numbers = np.unravel_index(at, changes.shape)
            postures = (some[k] for some, k in zip(choices, numbers, strict=True))
            plan = Plan(self.scores.facing, tuple(zip(phases, postures, strict=True)))
            merit = int(merits[0][at]), int(merits[1][at]), float(merits[2][at])
            found.append(Hope(plan, merit))
        return found

    def _changes(self, choices: Sequence[Sequence[Posture]]) -> tuple[Array, NDArray[np.int64]]:
        """What the changes of each plan have to gain [deg], and their number."""
        robot, count = self.question.robot, len(choices)
        shape = tuple(len(each) for each in choices)
        costs, changes = np.zeros(shape), np.zeros(shape, dtype=np.int64)
        for k in range(count - 1):
            one = costs_of_changes(robot, choices[k], choices[k + 1])
            wide = [1] * count
            wide[k], wide[k + 1] = one.shape
            costs += one.reshape(wide)
            changes += (one > 0.0).reshape(wide)
        return costs, changes

    def _ranked(self, phase: Phase) -> list[Posture]:
        """Postures of a phase, the best first, of those alike the one that was tried first."""
        of = self._allowed[phase]
        return sorted(of, key=lambda each: self.scores.of(phase, each).merit, reverse=True)

    def _scan(self, phase: Phase, known: Iterable[Posture], enough: float) -> None:
        """Try angles of one pair after the other, then about the best; the leading pair first."""
        pairs = list(self.question.robot.flippers())
        if self.scores.facing == "tail-first":
            pairs.reverse()
        best = max(known, key=lambda each: self.scores.of(phase, each).merit)
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
        scores = self.scores
        enough = min(enough, ENOUGH, scores.bound(phase))
        if scores.of(phase, best).does(enough) and scores.off(phase, best).does(0.0):
            return best
        low, high = self.limits
        whole = {math.radians(round(math.degrees(each))) for each in angles}
        tried = [
            best.model_copy(update={end: each}) for each in sorted(whole) if low <= each <= high
        ]
        scores.work_out((phase, each) for each in tried)
        self._allowed[phase].update(dict.fromkeys(tried))
        return max([best, *tried], key=lambda each: scores.of(phase, each).merit)


def _along(axis: int, count: int) -> tuple[int, ...]:
    """Shape of an array along one of some axes."""
    return tuple(-1 if k == axis else 1 for k in range(count))


def _figures(scores: Iterable[Score]) -> Array:
    """Rank, what fails, margin, drop and value of each (5, n)."""
    each = [(one.rank, one.failing, one.margin, one.drop, one.value) for one in scores]
    return np.array(each, dtype=np.float64).T


def _order(figures: Sequence[Array], cost: Array | float) -> tuple[Array, Array, Array]:
    """Order of plans: the weakest phase counts, and a little the others.

    figures: of each phase, see `_figures`.
    cost: what the changes have to gain [deg].
    """
    rank, _, margin, drop, _ = reduce(np.minimum, figures)
    failing, value = (sum(each[k] for each in figures) for k in (1, 4))
    worth = margin - cost_of_drop(-drop) + A_PHASE * value / len(figures) - cost
    return rank, np.asarray(failing), np.round(worth, 6)
