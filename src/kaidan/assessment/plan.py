"""The plan of an answer: which end leads, the posture of each phase, and what each change takes."""

import math
from typing import TYPE_CHECKING

from kaidan.answer import Part
from kaidan.models.findings import Findings
from kaidan.modes import POSTURE_TOLERANCE, Facing, Phase, PhaseName
from kaidan.question import Question

if TYPE_CHECKING:
    from kaidan.assessment.plan_search import Found
    from kaidan.traversal.moves import Move


class PlanStep(Part):
    """A posture and the change to it."""

    phase: PhaseName
    """Phase from which on the robot is in this posture."""
    before_step: int | None
    """Nosing before which the robot stands while it changes, counted from the bottom; null at the
    start."""
    flippers: str
    """As the option is written."""
    front_deg: float | None
    """Angle of the front flippers [deg]; null without a pair."""
    rear_deg: float | None
    """Angle of the rear flippers [deg]; null without a pair."""
    state: str | None
    """State of arm or payload; null: as the sheet has it."""
    turn_deg: float | None
    """Largest angle by which a flipper turns [deg]; null at the start, or where the robot does not
    get there."""
    time_s: float | None
    """Time of the change by the flippers' largest speed [s]; null where that is not known."""
    torque_Nm: float | None
    """Largest torque of a pair during the change [N m]; null where the mass is not known."""


class PlanShown(Part):
    """What to do: the plan of a traverse."""

    facing: Facing
    """Which end leads."""
    flippers: str
    """The whole plan as the option is written, to ask with it again."""
    steps: tuple[PlanStep, ...]
    """Postures in their order; one where none changes."""
    found: bool
    """Whether the plan was found; else it was stated."""
    holds_within_deg: float | None
    """Error of the angles within which the verdict holds [deg]; null: it was not tried."""
    tried: int | None
    """Drives of a phase with which it was found; null where it was stated."""

    @property
    def bare(self) -> bool:
        """Whether there is nothing to lay out: neither flippers nor states of arm or payload."""
        first, *others = self.steps
        return not others and not {first.front_deg, first.rear_deg, first.state} - {None}


def plan_of(question: Question, found: Findings, search: "Found | None") -> PlanShown:
    """Plan of an answer, of one posture too.

    Parameters
    ----------
    question : Question
        As it was judged.
    found : Findings
        Of the question.
    search : Found, optional
        What a search came upon.
    """
    moves = getattr(getattr(found.basis, "traverse", None), "moves", ())
    laid = {each for one in question.postures.values() for each in (one.front, one.rear)}
    holds = question.tolerance if found.of(POSTURE_TOLERANCE) is None else 0.0
    return PlanShown(
        facing=question.facing,
        flippers=question.flippers,
        steps=tuple(steps_of(question, moves)),
        found=search is not None,
        holds_within_deg=_degrees(holds) if question.tolerance and laid != {None} else None,
        tried=None if search is None else search.tried,
    )


def steps_of(question: Question, moves: "tuple[Move, ...]" = ()) -> list[PlanStep]:
    """Postures of a question in their order; what each change takes, where moves tell it."""
    from kaidan.traversal.moves import angles_of

    by_phase = {each.before: each for each in moves}
    count, steps, last = len(question.profile.nosings), [], None
    for phase, posture in question.postures.items():
        if posture == last:
            continue
        last, change = posture, by_phase.get(phase)
        angles = angles_of(question.robot, posture)
        before: int | None = None
        if phase is not Phase.ENTER:
            before = 1 if (phase is Phase.TRAVERSE) == (question.direction == "up") else count
        steps.append(
            PlanStep(
                phase=phase.value,
                before_step=before,
                flippers=posture.spelled(question.robot),
                front_deg=_degrees(angles.get("front")),
                rear_deg=_degrees(angles.get("rear")),
                state=posture.state,
                turn_deg=None if change is None else math.degrees(change.turn),
                time_s=None if change is None else change.seconds,
                torque_Nm=None if change is None else change.torque,
            )
        )
    return steps


def _degrees(angle: float | None) -> float | None:
    return None if angle is None else round(math.degrees(angle), 9)
