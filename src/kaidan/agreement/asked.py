"""One question put so that every model can answer it: same robot, same flight, same start."""

import math
from typing import Literal, NamedTuple

import numpy as np

from kaidan import contact
from kaidan.assessment.case import Case
from kaidan.errors import InputError
from kaidan.physics import TrialSpec
from kaidan.physics.start import course_of
from kaidan.stairs import Stairs

SPEED = 0.1
"""Speed of the trials where none is stated [m/s]: the paper's."""
START = 0.3
"""Where on its nosing the trial starts [1], the same for all: outcomes differ by slope alone."""
PLENTY = 3.0
"""Friction that isolates tipping [1]."""
LEAST, MOST = 0.0205, 0.595
"""Rise and going that a sheet of stairs allows, with a little room [m]."""

Begin = Literal["flight", "landing"]


class Way(NamedTuple):
    """What the contact model finds on a course."""

    status: contact.Status
    extra: float
    """Largest turn beyond the line of the nosings, towards the downhill end [rad]."""
    swing: float
    """Largest turn that a further nosing or tread caught [rad]."""
    required_friction: float
    """Largest required friction of any pose [1]; NaN without one."""


def refuse_odd_cases(case: Case) -> None:
    """Refuse what not all three models can be asked.

    Raises
    ------
    InputError
        A profile of its own, or a heading off the line of steepest ascent.
    """
    if case.profile is not None:
        raise InputError("agree asks about one flight of stairs; a profile has no closed form")
    if case.yaw:
        raise InputError("agree asks about the plane; leave the yaw out")


def flight_at(case: Case, angle: float) -> Stairs:
    """Long uniform flight with the spacing of the stairs asked, at an angle [rad]."""
    p = case.stairs.nosing_spacing
    steps = max(12, 8 + int(case.stance.flat_length / p))
    return Stairs.inclined(angle=angle, nosing_spacing=p, steps=steps)


def slopes(case: Case) -> tuple[float, float]:
    """Gentlest and steepest flight of that spacing which a sheet of stairs can describe [rad]."""
    p = case.stairs.nosing_spacing
    low = max(math.radians(2.0), math.asin(min(1.0, LEAST / p)), math.acos(min(1.0, 2.4 / p)))
    high = min(math.radians(85.0), math.acos(min(1.0, LEAST / p)), math.asin(min(1.0, MOST / p)))
    return low, high


def trial_of(
    case: Case, stairs: Stairs, *, friction: float = PLENTY, begin: Begin = "flight"
) -> TrialSpec:
    """Trial of a case's robot on stairs: smooth belt, in the plane, always from the same start."""
    return TrialSpec(
        robot=case.robot,
        stairs=stairs,
        posture=case.posture,
        payload=case.payload,
        friction=friction,
        speed=case.speed or SPEED,
        acceleration=case.acceleration,
        direction=case.direction,
        facing=case.facing,
        begin=begin,
        start_offset=START,
    )


def way_of(case: Case, stairs: Stairs, *, judged: bool = True) -> Way:
    """Contact model on the course of a trial that begins on the flight, from its start to its end.

    Parameters
    ----------
    case : Case
        The question; its stairs play no part.
    stairs : Stairs
        Flight.
    judged : bool
        Whether the required friction is wanted too.
    """
    course = course_of(trial_of(case, stairs))
    run = contact.traverse(
        course.profile.points,
        course.outline.parts,
        course.x,
        course.x + course.distance * math.cos(course.slope),
        kinds=course.outline.kinds,
        inclination=course.phi,
        acceleration=along(case),
        gyration=course.outline.gyration,
        with_margins=judged,
        with_energy=False,
    )
    turned = np.concatenate([run.poses[:, 3], run.releases[:, 8]])
    if not len(turned):
        return Way(run.status, math.nan, 0.0, math.nan)
    extra = course.slope - turned.min() if course.down else turned.max() - course.slope
    needed = [each.mu for each in run.friction_demand().values()] if judged else []
    return Way(run.status, float(extra), run.largest_release, max(needed) if needed else math.nan)


def no_rotation(case: Case, stairs: Stairs) -> tuple[float, float]:
    """Criterion of no rotation as the contact model applies it to any profile.

    Returns
    -------
    margin against turning over the downhill end, and over the uphill end [rad]; NaN outside
    """
    course = course_of(trial_of(case, stairs))
    one = contact.grade_one(
        course.profile.points,
        course.outline.parts,
        kinds=course.outline.kinds,
        acceleration=along(case),
    )
    if one.outside or one.holds is None:
        return math.nan, math.nan
    back, front = one.back_margin_angle, one.front_margin_angle
    return (front, back) if case.direction == "down" else (back, front)


def steepest_caught(case: Case, tolerance: float = 1e-4) -> float:
    """Steepest flight of the spacing on which the contact model arrives, turned or not [rad].

    Grade two; `kaidan.contact.steepest_flight` with the acceleration asked. NaN if it does not
    arrive on the gentlest; bisected, so one limit if there are several.
    """

    def arrives(angle: float) -> bool:
        return way_of(case, flight_at(case, angle), judged=False).status is contact.Status.OK

    low, high = slopes(case)
    if not arrives(low):
        return math.nan
    while high - low > tolerance:
        angle = 0.5 * (low + high)
        low, high = (angle, high) if arrives(angle) else (low, angle)
    return low


def along(case: Case) -> float:
    """Acceleration along the way instead of up the stairs [m/s^2]."""
    return -case.acceleration if case.direction == "down" else case.acceleration
