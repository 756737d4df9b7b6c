"""The d-a plane (the paper's Fig. 7): limits, areas, states, a plan through area E."""

import math
from typing import Any, Literal

from kaidan.answer import Answer, Part
from kaidan.arguments import flag, known_arguments
from kaidan.errors import InputError
from kaidan.mechanics.slipping import slip_acceleration_up
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.models.closed_form import judge
from kaidan.models.closed_form_figures import Basis, Pose
from kaidan.modes import Direction, Facing
from kaidan.question import Question
from kaidan.verbs.acceleration_plan import AccelerationPlan, acceleration_plan
from kaidan.verbs.plane_areas import (
    Column,
    Limits,
    Region,
    State,
    Stay,
    bounds_of,
    limits_of,
    progress_of,
)


class Curves(Part):
    """Tip limits over the progress."""

    d_m: tuple[float, ...]
    """Progress [m]; state C stands twice, before and after the lowest contact has left."""
    a_r0: Column
    """Above it the robot tips downhill, Eq. (15) [m/s^2]."""
    a_rn: Column
    """Below it the robot tips uphill, Eq. (16) [m/s^2]."""
    a_r0_safe: Column
    """With theta_d and theta_M subtracted at their high end [m/s^2]."""
    a_rn_safe: Column
    """With theta_d subtracted at its high end [m/s^2]."""


class PaperBand(Part):
    """The paper's own ends of the stable band, Eqs. (17) and (18): no slip at its lower end."""

    a_max: float | None
    """[m/s^2]"""
    a_min: float | None
    """[m/s^2]"""


class Plane(Answer):
    """The d-a plane: accelerations up the stairs, progress from the uphill end; null outside."""

    text_module = "kaidan.text.plane"

    model: Literal["closed-form"] = "closed-form"
    robot: str
    stairs: str
    surface: str | None
    direction: Direction
    facing: Facing
    downhill_end: Literal["tail", "nose"]
    """End of the robot that points down the stairs."""
    outside: str | None
    """Why the closed form does not apply; null if it does."""
    angle_deg: float
    """Slope of the governing step [deg]."""
    nosing_spacing_m: float
    """Nosing to nosing on the governing step [m]."""
    contacts_n: int
    """n = floor(L / p)."""
    flat_length_m: float
    """L, flippers in line included [m]."""
    com_from_uphill_end_m: float
    """C_L, from the UPHILL end of the flat [m]."""
    com_height_m: float
    """C_N [m]."""
    friction: tuple[float, float] | None
    """Smallest and largest static friction [1]; null where it is not known."""
    acceleration: float
    """Acceleration requested [m/s^2]."""
    a_S: float | None = None
    """Above it the tracks slip and the robot slides down, Eq. (14), smallest friction [m/s^2]."""
    a_S_high: float | None = None
    """The same with the largest friction [m/s^2]."""
    a_slides_up: float | None = None
    """Below it the tracks slip and the robot slides up, smallest friction [m/s^2]."""
    min_a_r0: float | None = None
    """Smallest a_r0 over the progress [m/s^2]."""
    max_a_rn: float | None = None
    """Largest a_rn over the progress [m/s^2]."""
    a_max: float | None = None
    """Upper end of the stable band [m/s^2]; null if no constant acceleration is stable."""
    a_min: float | None = None
    """Lower end of the stable band, sliding up included [m/s^2]; null likewise."""
    paper: PaperBand | None = None
    """The paper's own ends of the band."""
    states: tuple[State, ...] = ()
    """States A to D of the paper's Fig. 3."""
    areas: tuple[Stay, ...] = ()
    """Areas through which the requested acceleration goes, in order."""
    curves: Curves | None = None
    """Tip limits over the progress."""
    regions: tuple[Region, ...] = ()
    """Areas of the plane as bands between curves."""
    plan: AccelerationPlan | None
    """Plan of the acceleration, if one was requested."""

    @property
    def exit_code(self) -> int:
        """3 outside the model, 1 if a plan is needed and there is none, else 0."""
        if self.outside:
            return 3
        return 0 if self.plan is None or self.plan.found or self.plan.needless else 1


@known_arguments
def plane(robot: Any, stairs: Any = None, *, accelerate: bool = False, **manner: Any) -> Plane:
    """The paper's d-a plane: limits of acceleration over the progress.

    Parameters
    ----------
    robot, stairs : object
        As in `kaidan.assess`; the stairs are a regular flight.
    accelerate : bool
        Whether to plan an acceleration over the position through areas D and E.
    **manner
        As in `kaidan.assess`.

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> from math import radians
    >>> from kaidan import Stairs
    >>> found = plane("kenaf", Stairs.inclined(angle=radians(44), nosing_spacing=0.2), friction=2.0)
    >>> round(found.a_max, 2), [each.area for each in found.areas]
    (0.54, ['D'])

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Figs. 3 and 7, Eqs. (14)-(18).
    """
    flag("accelerate", accelerate)
    return d_a_plane(Question.in_one_posture(robot, stairs, **manner), accelerate=accelerate)


def d_a_plane(question: Question, *, accelerate: bool = False) -> Plane:
    """The d-a plane of a question on its governing step; see `plane`."""
    found = judge(question)
    basis: Basis | None = found.basis
    if basis is None:
        raise InputError(f"the d-a plane: {found.outside}")
    pose, mu = Pose.of(basis), question.friction
    answer: dict[str, Any] = {
        "robot": question.robot.name,
        "stairs": question.terrain_name,
        "surface": question.surface.name if question.surface else None,
        "direction": question.direction,
        "facing": question.facing,
        "downhill_end": "tail" if question.nose_up else "nose",
        "outside": found.outside or None,
        "angle_deg": math.degrees(pose.theta_s),
        "nosing_spacing_m": pose.p,
        "contacts_n": pose.n,
        "flat_length_m": pose.L,
        "com_from_uphill_end_m": pose.C_L,
        "com_height_m": pose.C_N,
        "friction": None if math.isnan(mu[0]) else mu,
        "acceleration": question.acceleration,
        "plan": acceleration_plan(question, basis, found.outside) if accelerate else None,
    }
    if found.outside:
        return Plane(**answer)
    limits, bounds = limits_of(pose, mu[0]), bounds_of(pose, mu[0])
    a_max, a_min = float(bounds.a_max), float(bounds.a_min)
    return Plane(
        **answer,
        a_S=limits.a_S,
        a_S_high=float(slip_acceleration_up(mu_s=mu[1], theta_s=pose.theta_s)),
        a_slides_up=limits.a_slides_up,
        min_a_r0=limits.min_a_r0,
        max_a_rn=limits.max_a_rn,
        a_max=a_max if a_min < a_max else None,
        a_min=a_min if a_min < a_max else None,
        paper=PaperBand(a_max=a_max, a_min=limits.max_a_rn),
        states=limits.states(),
        areas=limits.stays(question.acceleration),
        curves=_curves(limits, question),
        regions=limits.regions(),
    )


def _curves(limits: Limits, question: Question) -> Curves:
    """Tip limits over the progress, also on slopes that the allowances make worse."""
    pose, tilt = limits.pose, question.allowance_d.high
    d, s, _ = progress_of(pose)
    com = {"C_L": pose.C_L, "C_N": pose.C_N}
    return Curves(
        d_m=d.tolist(),
        a_r0=limits.a_r0,
        a_rn=limits.a_rn,
        a_r0_safe=a_r0(s=s, theta_s=pose.theta_s + tilt + question.allowance_M.high, **com),
        a_rn_safe=a_rn(d=d, theta_s=pose.theta_s - tilt, **com),
    )
