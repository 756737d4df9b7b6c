"""One question put so that every model can answer it: same robot, same flight, same start."""

import math
from typing import Literal, NamedTuple

import numpy as np

from kaidan import contact
from kaidan.allowance import Allowance
from kaidan.errors import InputError
from kaidan.physics import TrialSpec
from kaidan.physics.initial_pose import course_of
from kaidan.physics.spec import SPEED
from kaidan.question import Question
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import criterion_of

START = 0.3
"""Where on its nosing the trial starts [1], the same for all: outcomes differ by slope alone."""
PLENTY = 3.0
"""Friction that isolates tipping [1]."""
NONE = Allowance(low=0.0, high=0.0)
LEAST, MOST = 0.0205, 0.595
"""Rise and going that a sheet of stairs allows, with a little room [m]."""

Begin = Literal["flight", "landing"]


class FlightTraverse(NamedTuple):
    """What the contact model finds on the course of a trial that begins on the flight."""

    status: contact.Status
    extra: float
    """Largest inclination beyond the line of the nosings, towards the downhill end [rad]."""
    rotation: float
    """Largest rotation that a further nosing or tread arrested [rad]."""
    required_friction: float
    """Largest required friction of any pose [1]; NaN without one."""


def common(question: Question) -> Question:
    """Question as all models answer it: figures exact, no allowances, one friction.

    Models are compared and nobody is judged. Without a surface friction is `PLENTY`, of a range
    the low end counts.
    """
    if not isinstance(question.terrain, Stairs):
        raise InputError(
            "agree compares on one flight of stairs; several, or a profile, have no closed form"
        )
    if question.yaw:
        raise InputError("agree compares in the plane; leave the yaw out")
    robot, stairs = question.robot, question.terrain
    return question.changed(
        robot=robot.model_copy(update={"uncertainty": type(robot.uncertainty)()}),
        terrain=stairs.model_copy(update={"uncertainty": type(stairs.uncertainty)()}),
        surface=Surface.of_friction(PLENTY if question.surface is None else question.friction[0]),
        speed=SPEED if question.speed is None else question.speed,
        theta_d=NONE,
        theta_M=NONE,
    )


def stairs_of(question: Question) -> Stairs:
    """The one flight that `common` makes sure of."""
    assert isinstance(question.terrain, Stairs)
    return question.terrain


def speed_of(question: Question) -> float:
    """Speed that `common` makes sure of [m/s]."""
    assert question.speed is not None
    return question.speed


def at_angle(question: Question, angle: float) -> Question:
    """Question on a long uniform flight with the spacing of the stairs, at an angle [rad]."""
    p = stairs_of(question).nosing_spacing
    steps = max(12, 8 + int(question.stance.flat_length / p))
    return question.changed(terrain=Stairs.inclined(angle=angle, nosing_spacing=p, steps=steps))


def with_friction(question: Question, friction: float) -> Question:
    """Question with another friction [1]."""
    return question.changed(surface=Surface.of_friction(friction))


def slopes(question: Question) -> tuple[float, float]:
    """Gentlest and steepest flight of that spacing which a sheet of stairs can describe [rad]."""
    p = stairs_of(question).nosing_spacing
    low = max(math.radians(2.0), math.asin(min(1.0, LEAST / p)), math.acos(min(1.0, 2.4 / p)))
    high = min(math.radians(85.0), math.acos(min(1.0, LEAST / p)), math.asin(min(1.0, MOST / p)))
    return low, high


def trial_of(question: Question, begin: Begin = "flight") -> TrialSpec:
    """Trial of a question: smooth belt, in the plane, always from the same start."""
    return TrialSpec(question=question, begin=begin, start_offset=START)


def flight_traverse(question: Question, *, with_friction: bool = True) -> FlightTraverse:
    """Contact model on the course of a trial that begins on the flight, all along it."""
    course = course_of(trial_of(question))
    path = contact.traverse(
        course.profile.points,
        course.outline.parts,
        course.x,
        course.x + course.distance * math.cos(course.slope),
        kinds=course.outline.kinds,
        inclination=course.phi,
        acceleration=along(question),
        gyration=course.outline.gyration,
        with_margins=with_friction,
        with_energy=False,
    )
    inclinations = np.concatenate([path.inclination, path.rotations.end_inclination])
    if not len(inclinations):
        return FlightTraverse(path.status, math.nan, 0.0, math.nan)
    extra = course.slope - inclinations.min() if course.down else inclinations.max() - course.slope
    required = math.nan if path.margins is None else float(path.margins.required_friction.max())
    return FlightTraverse(path.status, float(extra), path.largest_rotation, required)


def static_criterion(question: Question) -> tuple[float, float]:
    """Criterion of no rotation as the contact model applies it to any profile.

    margin against tipping over the downhill end, and over the uphill end [rad]; NaN outside.
    """
    course = course_of(trial_of(question))
    criterion = criterion_of(course.profile, course.outline, along(question))[1]
    if criterion.alone or criterion.holds is None:
        return math.nan, math.nan
    worst = (criterion.smallest(downhill=side) for side in (True, False))
    downhill, uphill = (math.nan if each is None else each.margin for each in worst)
    return downhill, uphill


def steepest_arrested(question: Question, tolerance: float = 1e-4) -> float:
    """Steepest flight of the spacing on which the contact model arrives, rotating or not [rad].

    Grade two; `kaidan.contact.steepest_flight` with the question's acceleration. NaN if it does not
    arrive on the gentlest; bisected, so one limit if there are several.
    """

    def arrives(angle: float) -> bool:
        found = flight_traverse(at_angle(question, angle), with_friction=False)
        return found.status is contact.Status.OK

    low, high = slopes(question)
    if not arrives(low):
        return math.nan
    while high - low > tolerance:
        angle = 0.5 * (low + high)
        low, high = (angle, high) if arrives(angle) else (low, angle)
    return low


def along(question: Question) -> float:
    """Acceleration along the path instead of up the stairs [m/s^2]."""
    return -question.acceleration if question.direction == "down" else question.acceleration
