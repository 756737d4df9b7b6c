"""Postures near a plan's that are a GO at their angles and off them, for a plan that is not.

The scores of the search know friction and no grousers. Here single phases are judged by the verdict
policy, at the angles and off them, and the worst of these counts. The most promising are judged
first: by their scores, or by what holds them where it is not one friction of smooth belts.
"""

import heapq
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice, product
from typing import Any, NamedTuple

import numpy as np

from kaidan import contact
from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_scores import ENOUGH, FAILED, Score, Scores
from kaidan.assessment.plans import GENTLE, Plan, off, pressed
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError
from kaidan.models.belts import holds_otherwise
from kaidan.models.findings import at_risk
from kaidan.models.quasi_static import Basis, findings_of, sliding_margin
from kaidan.models.traction import gripping
from kaidan.modes import Phase, Verdict
from kaidan.robot import Posture
from kaidan.traversal.moves import angles_of

FARTHEST = 8
"""Largest move of an angle that is tried at a time, in tolerances; so off one lies on the next."""
NEAR = 2
"""Move of an angle up to which every whole degree is tried, in tolerances: what holds off its
angles may be one degree wide."""
MOST_MOVES = 2
"""Moves from a start, one after the other."""
APART = 18
"""Distance of the angles tried all over [deg]."""
CLOSE = 4
"""Distance of those tried then about the best of them [deg]."""
REFINED = 2
"""Postures about which others are tried."""
SLACK = 0.1
"""Margin by which a phase may be better than its score, of poses farther apart [deg]."""


class Worth(NamedTuple):
    """What a phase comes to; larger is better."""

    rank: int
    """Of the verdict, with its sign turned."""
    margin: float
    """Margin of slope, `ENOUGH` at most [deg]."""

    @property
    def holds(self) -> bool:
        """Whether it is a GO."""
        return self.rank == -Verdict.GO.rank


OUT = Worth(-len(Verdict), -90.0)
SHORT_OF_GO = Worth(-Verdict.ROUGH.rank, ENOUGH)
"""As much as a phase can come to that is no GO."""
HOPELESS = Worth(-Verdict.UNSURE.rank, -3.0)
"""From which on no posture close by is tried."""
ANY = Worth(-Verdict.GO.rank, ENOUGH)
"""As much as a phase can come to."""


_Place = tuple[tuple[int, bool, float], int, int, Worth]
"""Of a posture among others, the best first: its number, looks taken, what it comes to at most."""


class Sturdier:
    """Search about a plan for postures that hold off their angles.

    scores: of the search that found the plan: where each of its phases begins and ends.
    limits: angles allowed [rad].
    """

    def __init__(self, scores: Scores, limits: tuple[float, float], drives: Drives) -> None:
        self.scores, self.limits, self.drives = scores, limits, drives
        self.question = scores.question.changed(facing=scores.facing)
        self._scored: Scores | None = None
        """Scores of what is looked at here; None where they do not tell what a phase comes to."""
        plain = not self.question.uncertain
        belts = gripping(self.question)
        if plain and (belts is not None or not holds_otherwise(self.question)):
            self._scored = Scores(scores.question, scores.facing, belts)
        self._driven: dict[tuple[Phase, Posture], Basis | None] = {}
        self._sliding: dict[tuple[Phase, Posture], Worth] = {}
        """What phases come to by what holds them alone."""
        self._known: dict[tuple[Phase, Posture], Worth] = {}
        self._weakest: dict[Phase, int] = {}
        """Which way off its angles the last posture that was looked at is the worst."""

    def plan(self, plan: Plan) -> Plan | None:
        """Plan with another posture in each phase that is no GO off its angles; None: none is."""
        found = []
        for phase, posture in plan.postures:
            better = self._better(phase, posture)
            if better is None:
                return None
            found.append((phase, better))
        return plan._replace(postures=tuple(found))

    def _better(self, phase: Phase, posture: Posture) -> Posture | None:
        """Posture that is GO off its angles too: itself, or near it, or near the flat.

        With grousers from all over the angles: scores of friction lead nowhere near it.
        """
        if self._worst(phase, posture, SHORT_OF_GO).holds:
            return posture
        if self.question.robot.track.has_grousers:
            return self._anywhere(phase, posture)
        robot, tolerance = self.question.robot, self.question.tolerance
        flat = posture.model_copy(update=dict.fromkeys(robot.flippers(), "flat"))
        starts = dict.fromkeys(pressed(robot, each, tolerance) for each in (posture, flat))
        moved = (self._moved(phase, start) for start in starts)
        return next((each for each in moved if each is not None), None)

    def _anywhere(self, phase: Phase, posture: Posture) -> Posture | None:
        """Posture that is GO off its angles too, of those about the best of a coarse grid."""
        coarse = self._ranked(phase, self._grid(posture))
        hopeful = islice((each for worth, each in coarse if worth > HOPELESS), REFINED)
        fine = dict.fromkeys(chain.from_iterable(map(self._close_to, hopeful)))
        for worth, each in self._ranked(phase, fine):
            if not worth.holds:
                return None
            if self._worst(phase, each, SHORT_OF_GO).holds:
                return each
        return None

    def _grid(self, posture: Posture) -> Iterator[Posture]:
        """Postures all over the angles allowed, flat ones among them."""
        robot = self.question.robot
        flat = posture.model_copy(update=dict.fromkeys(robot.flippers(), "flat"))
        laid = pressed(robot, flat, self.question.tolerance)
        low, high = (round(math.degrees(each)) for each in self.limits)
        grid = [math.radians(each) for each in range(low, high + 1, APART)]
        for at in product(*((getattr(laid, end), *grid) for end in robot.flippers())):
            yield posture.model_copy(update=dict(zip(robot.flippers(), at, strict=True)))

    def _close_to(self, posture: Posture) -> Iterator[Posture]:
        """A posture and those close to it, between it and the next of the grid."""
        low, high = self.limits
        steps = [math.radians(each) for each in (0, -CLOSE, CLOSE, -2 * CLOSE, 2 * CLOSE)]
        at = angles_of(self.question.robot, posture)
        for by in product(steps, repeat=len(at)):
            angles = {end: at[end] + one for end, one in zip(at, by, strict=True)}
            if all(low <= each <= high for each in angles.values()):
                yield posture.model_copy(update=angles)

    def _ranked(self, phase: Phase, postures: Iterable[Posture]) -> Iterator[tuple[Worth, Posture]]:
        """Postures that lack friction at most, at their angles and off them, the best first.

        What rotates on its way comes after what does not. Each is looked at more closely only while
        it may be the next: by its scores, off its angles, by what holds it, and judged.
        """
        each = list(postures)
        scored, hope = (self.scores, _most) if self._scored is None else (self._scored, _hope)
        scored.work_out((phase, one) for one in each)
        scores = [scored.of(phase, one) for one in each]
        gentle = [-score.drop <= GENTLE for score in scores]

        def place(k: int, most: Worth, looks: int) -> _Place:
            return (-most.rank, not gentle[k], -most.margin), k, looks, most

        waiting = [place(k, hope(score), 0) for k, score in enumerate(scores) if _lacks(score)]
        heapq.heapify(waiting)
        while waiting:
            _, k, looks, most = heapq.heappop(waiting)
            if looks == 0 and _lacks(scored.off(phase, each[k])):
                heapq.heappush(waiting, place(k, most, 1))
            elif looks == 1:
                most = min(most, self._held(*self._key(phase, each[k])))
                heapq.heappush(waiting, place(k, most, 2))
            elif looks == 2:
                found = self._of(phase, each[k], SHORT_OF_GO)
                heapq.heappush(waiting, place(k, found, 3))
            elif looks == 3:
                yield most, each[k]

    def _moved(self, phase: Phase, posture: Posture) -> Posture | None:
        """Posture moved as long as its worst gets better; None where that is no GO."""
        worst = self._worst(phase, posture, OUT)
        for left in reversed(range(MOST_MOVES)):
            if worst.holds:
                break
            start = posture
            beaten = worst if left else SHORT_OF_GO  # nothing else helps in the end
            posture, worst = self._best_about(phase, posture, beaten)
            if posture is start:
                break
        return posture if worst.holds else None

    def _best_about(self, phase: Phase, posture: Posture, beaten: Worth) -> tuple[Posture, Worth]:
        """Best posture about one and its worst; itself where none beats what is beaten."""
        about = list(self._about(posture))
        most = self._most(phase, about)
        for k in sorted(range(len(about)), key=lambda k: most[k], reverse=True):
            if most[k] <= beaten:
                break
            found = self._worst(phase, about[k], beaten)
            if found > beaten:
                posture, beaten = about[k], found
        return posture, beaten

    def _most(self, phase: Phase, about: Sequence[Posture]) -> list[Worth]:
        """What each posture comes to at most: that way off its angles that was the worst."""
        ways = [self._ways(each)[self._weakest.get(phase, 0)] for each in about]
        if self._scored is not None:
            return self._hopes(phase, ways)
        return [self._held(*self._key(phase, each)) for each in ways]

    def _about(self, posture: Posture) -> Iterator[Posture]:
        """Postures with one angle off in whole degrees: by each close by, then by tolerances."""
        low, high = self.limits
        tolerance = math.degrees(self.question.tolerance)
        close = range(1, round(NEAR * tolerance) + 1)
        steps = (*close, *(many * tolerance for many in range(NEAR + 1, FARTHEST + 1)))
        for end, angle in angles_of(self.question.robot, posture).items():
            for step in steps:
                for by in (step, -step):
                    degrees = round(math.degrees(angle) + by)
                    if low <= math.radians(degrees) <= high:
                        yield posture.model_copy(update={end: math.radians(degrees)})

    def _worst(self, phase: Phase, posture: Posture, beaten: Worth) -> Worth:
        """Worst of a posture and those off its angles; any that is no better than what is beaten.

        What was the worst of the last one is looked at first.
        """
        worst, each = ANY, self._ways(posture)
        if self._scored is not None and beaten > OUT:
            most = min(self._hopes(phase, each))
            if most <= beaten:
                return most
        for k in sorted(range(len(each)), key=lambda k: k != self._weakest.get(phase)):
            found = self._of(phase, each[k], beaten)
            if found < worst:
                worst, self._weakest[phase] = found, k
            if worst <= beaten:
                break
        return worst

    def _ways(self, posture: Posture) -> tuple[Posture, ...]:
        """A posture and those off its angles."""
        return posture, *off(self.question.robot, posture, self.question.tolerance)

    def _hopes(self, phase: Phase, postures: Sequence[Posture]) -> list[Worth]:
        """What a phase comes to at most by its scores, which are worked out together."""
        assert self._scored is not None
        self._scored.work_out((phase, each) for each in postures)
        return [_hope(self._scored.of(phase, each)) for each in postures]

    def _key(self, phase: Phase, posture: Posture) -> tuple[Phase, Posture]:
        """Phase and posture, alike whatever its angles were moved from."""
        angles = {
            end: round(angle, 9)
            for end in ("front", "rear")
            if isinstance(angle := getattr(posture, end), float)
        }
        return phase, posture.model_copy(update=angles)

    def _of(self, phase: Phase, posture: Posture, beaten: Worth) -> Worth:
        """What a phase comes to, driven from a start of its own; any no better than is beaten."""
        key = self._key(phase, posture)
        if key not in self._known:
            most = self._held(*key)
            if most <= beaten:
                return most
            self._known[key] = self._judged(*key)
        return self._known[key]

    def _held(self, phase: Phase, posture: Posture) -> Worth:
        """What a phase comes to at most, by what holds it."""
        key = phase, posture
        if key not in self._sliding:
            basis = self._basis(phase, posture)
            margin = math.nan
            if basis is not None:
                sliding = np.nan_to_num(sliding_margin(basis.question, basis), nan=math.inf)
                margin = at_risk(sliding, basis.question.risk)
            verdict = Verdict.GO if margin > 0.0 else Verdict.UNSURE
            self._sliding[key] = OUT if basis is None else _worth(verdict, margin)
        return self._sliding[key]

    def _judged(self, phase: Phase, posture: Posture) -> Worth:
        """What a phase comes to; a GO on grousers pose by pose, as `Drives.rank` looks at it."""
        worth = _judged(self._basis(phase, posture))
        if worth.holds and self.question.robot.track.has_grousers:
            return _judged(self._driven_over(phase, posture, step=contact.STEP))
        return worth

    def _basis(self, phase: Phase, posture: Posture) -> Basis | None:
        """A phase driven from a start of its own; None: the centroid is outside."""
        key = phase, posture
        if key not in self._driven:
            self._driven[key] = self._driven_over(phase, posture)
        return self._driven[key]

    def _driven_over(self, phase: Phase, posture: Posture, **how: Any) -> Basis | None:
        """A phase driven; `how` as for `Drives.over`."""
        try:
            alone = self.question.changed(posture=posture)
        except InputError:
            return None
        start, until = self.scores.stretch(phase)
        found = self.drives.over(self.scores.profile, alone, start=start, until=until, **how)
        return Basis(alone, found)


def _judged(basis: Basis | None) -> Worth:
    """What a drive comes to."""
    if basis is None:
        return OUT
    found = findings_of(basis.question, basis, most=math.radians(ENOUGH))
    conclusion = conclude(basis.question, found)
    return _worth(conclusion.verdict, conclusion.margin)


def _lacks(score: Score) -> bool:
    """Whether a phase lacks friction at most."""
    return score.failing >= -1


def _most(score: Score) -> Worth:
    """What a phase of a score comes to at most, whatever holds it."""
    return _worth(Verdict.GO, math.radians(score.tipping + SLACK))


def _hope(score: Score) -> Worth:
    """What a phase of a score comes to at most."""
    if score == FAILED:  # how far a fall is off is no part of a score
        return Worth(score.rank, ENOUGH)
    return Worth(score.rank, min(score.margin + SLACK, ENOUGH))


def _worth(verdict: Verdict, margin: float) -> Worth:
    """Worth of a verdict with a margin [rad]; NaN: not known."""
    degrees = -90.0 if math.isnan(margin) else min(math.degrees(margin), ENOUGH)
    return Worth(-verdict.rank, degrees)
