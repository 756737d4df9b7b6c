"""The field card: what the operator has in hand, read off the answers."""

from kaidan.assessment.answer import Assessment
from kaidan.assessment.plan import PlanStep
from kaidan.question import ROCKING_SPEED
from kaidan.verbs.report.answer import FieldCard, PhasePosture
from kaidan.verbs.traverse_report import TraverseReport


def field_card(assessment: Assessment, followed: TraverseReport | None) -> FieldCard:
    """Card of a mission.

    Parameters
    ----------
    followed : TraverseReport, optional
        The traverse that it stands on.
    """
    question, plan = assessment.question, assessment.plan
    least, most = _inclinations(followed)
    arrives = followed is not None and followed.arrived
    path = followed.poses.path_m[-1] if followed is not None and arrives else None
    theta_d = assessment.allowances["theta_d"].high_deg
    return FieldCard(
        postures=_postures(assessment),
        speed=question.speed,
        judged_speed=question.speed or ROCKING_SPEED,
        lowest_deg=least,
        steepest_deg=most,
        stop_above_deg=most + theta_d if most is not None and arrives else None,
        largest_rotation_deg=_rotation(followed),
        flippers_within_deg=None if plan is None else plan.holds_within_deg,
        path_m=path,
        time_s=_time(path, question.speed, () if plan is None else plan.steps),
    )


def _postures(assessment: Assessment) -> tuple[PhasePosture, ...]:
    from kaidan.assessment.plan import steps_of

    return tuple(
        PhasePosture(
            phase=each.phase,
            flippers=each.flippers,
            front_deg=each.front_deg,
            rear_deg=each.rear_deg,
            before_step=each.before_step,
        )
        for each in steps_of(assessment.question)
    )


def _inclinations(followed: TraverseReport | None) -> tuple[float | None, float | None]:
    """Least and largest inclination, uphill end up, of poses and arrested rotations [deg]."""
    if followed is None or not followed.poses.inclination_deg:
        return None, None
    sign = 1.0 if followed.question.direction == "up" else -1.0
    each = [sign * one for one in followed.poses.inclination_deg]
    each += [
        sign * place.inclination_deg
        for rotation in followed.rotations
        if rotation.arrested
        for place in rotation.placements
    ]
    return min(each), max(each)


def _rotation(followed: TraverseReport | None) -> float | None:
    """Largest rotation that is arrested [deg]."""
    if followed is None:
        return None
    return max((each.angle_deg for each in followed.rotations if each.arrested), default=0.0)


def _time(path: float | None, speed: float | None, steps: tuple[PlanStep, ...]) -> float | None:
    """Time for a path and the changes of posture on it [s]."""
    changes = [each.time_s for each in steps if each.before_step is not None]
    if path is None or not speed or None in changes:
        return None
    return path / speed + sum(each for each in changes if each is not None)
