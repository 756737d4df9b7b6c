"""Postures near a plan's that are a GO at their angles and off them, for a plan that is not.

The scores of the search know friction and no grousers. Here single phases are judged by the verdict
policy, at the angles and off them, and the worst of these counts.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_scores import ENOUGH, Scores
from kaidan.assessment.plans import Plan, off, pressed
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError
from kaidan.models.findings import at_risk
from kaidan.models.quasi_static import Basis, findings_of, sliding_margin
from kaidan.modes import Phase, Verdict
from kaidan.robot import Posture
from kaidan.traversal.moves import angles_of

FARTHEST = 8
"""Largest move of an angle that is tried at a time, in tolerances; so off one lies on the next."""
MOST_MOVES = 2
"""Moves from a start, one after the other."""


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


class Sturdier:
    """Search about a plan for postures that hold off their angles.

    Parameters
    ----------
    scores : Scores
        Of the search that found the plan: where each of its phases begins and ends.
    limits : (float, float)
        Angles allowed [rad].
    drives : Drives
        What was driven already.
    """

    def __init__(self, scores: Scores, limits: tuple[float, float], drives: Drives) -> None:
        self.scores, self.limits, self.drives = scores, limits, drives
        self.question = scores.question.changed(facing=scores.facing)
        self._known: dict[tuple[Phase, Posture], Worth] = {}
        self._weakest: dict[Phase, int] = {}
        """Which way off its angles the last posture that was looked at is the worst."""

    def plan(self, plan: Plan) -> Plan | None:
        """The plan with another posture in each phase that is no GO off its angles; None: none is.

        Parameters
        ----------
        plan : Plan
            What the search came upon.
        """
        found = []
        for phase, posture in plan.postures:
            better = self._better(phase, posture)
            if better is None:
                return None
            found.append((phase, better))
        return plan._replace(postures=tuple(found))

    def _better(self, phase: Phase, posture: Posture) -> Posture | None:
        """Posture that is GO off its angles too: itself, or near it, or near the flat."""
        if self._worst(phase, posture, OUT).holds:
            return posture
        robot, tolerance = self.question.robot, self.question.tolerance
        flat = posture.model_copy(update=dict.fromkeys(robot.flippers(), "flat"))
        starts = dict.fromkeys(pressed(robot, each, tolerance) for each in (posture, flat))
        moved = (self._moved(phase, start) for start in starts)
        return next((each for each in moved if each is not None), None)

    def _moved(self, phase: Phase, posture: Posture) -> Posture | None:
        """Posture moved as long as its worst gets better; None where that is no GO."""
        worst = self._worst(phase, posture, OUT)
        for _ in range(MOST_MOVES):
            if worst.holds:
                return posture
            for each in list(self._about(posture)):
                found = self._worst(phase, each, worst)
                if found > worst:
                    posture, worst = each, found
        return posture if worst.holds else None

    def _about(self, posture: Posture) -> Iterator[Posture]:
        """Postures with one angle some tolerances off, in whole degrees."""
        low, high = self.limits
        for end, angle in angles_of(self.question.robot, posture).items():
            for step in range(1, FARTHEST + 1):
                for by in (step, -step):
                    degrees = round(math.degrees(angle + by * self.question.tolerance))
                    if low <= math.radians(degrees) <= high:
                        yield posture.model_copy(update={end: math.radians(degrees)})

    def _worst(self, phase: Phase, posture: Posture, beaten: Worth) -> Worth:
        """Worst of a posture and those off its angles; any that is no better than what is beaten.

        What was the worst of the last one is looked at first.
        """
        worst = Worth(0, ENOUGH)
        each = (posture, *off(self.question.robot, posture, self.question.tolerance))
        for k in sorted(range(len(each)), key=lambda k: k != self._weakest.get(phase)):
            found = self._of(phase, each[k], beaten)
            if found < worst:
                worst, self._weakest[phase] = found, k
            if worst <= beaten:
                break
        return worst

    def _of(self, phase: Phase, posture: Posture, beaten: Worth) -> Worth:
        """What a phase comes to, driven from a start of its own; any no better than is beaten."""
        angles = {
            end: round(angle, 9)
            for end in ("front", "rear")
            if isinstance(angle := getattr(posture, end), float)
        }
        key = phase, posture.model_copy(update=angles)
        if key not in self._known:
            found, whole = self._judged(*key, beaten)
            if not whole:
                return found
            self._known[key] = found
        return self._known[key]

    def _judged(self, phase: Phase, posture: Posture, beaten: Worth) -> tuple[Worth, bool]:
        """The same, and whether all of it was judged: its friction is first, and may be enough."""
        try:
            alone = self.question.changed(posture=posture)
        except InputError:  # its centroid is outside
            return OUT, True
        start, until = self.scores.stretch(phase)
        found = self.drives.over(self.scores.profile, alone, start=start, until=until)
        sliding = np.nan_to_num(sliding_margin(alone, Basis(alone, found)), nan=math.inf)
        margin = at_risk(sliding, alone.risk)
        most = _worth(Verdict.GO if margin > 0.0 else Verdict.CAUTION, margin)
        if most <= beaten:
            return most, False
        conclusion = conclude(
            alone, findings_of(alone, Basis(alone, found), most=math.radians(ENOUGH))
        )
        return _worth(conclusion.verdict, conclusion.margin), True


def _worth(verdict: Verdict, margin: float) -> Worth:
    """Worth of a verdict with a margin [rad]; NaN: not known."""
    degrees = -90.0 if math.isnan(margin) else min(math.degrees(margin), ENOUGH)
    return Worth(-verdict.rank, degrees)
