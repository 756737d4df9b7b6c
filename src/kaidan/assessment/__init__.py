"""One robot, one staircase: verdict, margins, what governs, what to do."""

import math
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from numbers import Real
from os import PathLike
from typing import Any, Literal

from kaidan.assessment.allowance import Allowance as Allowance
from kaidan.assessment.answer import Assessment as Assessment
from kaidan.assessment.case import Case, Direction, Facing
from kaidan.assessment.terrain import Terrain, sheet_of, shown, terrain_of
from kaidan.assessment.yaw import LARGEST_YAW, along_heading, gauge_of
from kaidan.errors import InputError
from kaidan.robot import Payload, Posture, Robot
from kaidan.surface import Surface

LARGEST_ACCELERATION = 9.8
"""Beyond it no tracked robot accelerates, and the limits lose their meaning [m/s^2]."""

FRICTION = (0.0, 5.0)
"""Plausible static friction, as in `Surface` [1]."""

RISK = (1e-4, 0.5)
"""Probabilities of failure that can be asked for."""


DEFAULT_MODEL: Literal["contact"] = "contact"
MODELS = ("contact", "closed-form")
ACCEPTED = ("no-rotation", "caught")


def assess(
    robot: Robot | str | PathLike[str],
    stairs: Terrain,
    *,
    surface: Surface | str | PathLike[str] | None = None,
    friction: float | None = None,
    acceleration: float = 0.0,
    speed: float | None = None,
    direction: Direction | None = None,
    facing: Facing = "nose-first",
    flippers: Posture | Literal["flat", "stowed"] = "stowed",
    payload: Payload | Iterable[Payload] = (),
    theta_d: Any = None,
    theta_M: Any = None,
    yaw: float = 0.0,
    risk: float = 0.01,
    model: Literal["contact", "closed-form"] = DEFAULT_MODEL,
    accept: Literal["no-rotation", "caught"] = "no-rotation",
) -> Assessment:
    """Whether a tracked robot can take a flight of stairs, and by how much.

    Parameters
    ----------
    robot : Robot, str or path
        Robot, or its name in the catalogue, or a TOML file.
    stairs : Stairs, str, path, a sequence of them, or Profile
        Stairs, or their name in the catalogue, or a TOML file; several flights from bottom to top,
        the upper landing of each below the next (also as one text, joined by "+"); or any profile.
    surface : Surface, str or path, optional
        Surface under the tracks; without one (and without `friction`) no GO is given.
    friction : float, optional
        Static friction instead of a surface [1].
    acceleration : float
        Acceleration up the stairs, whichever way the robot goes [m/s^2].
    speed : float, optional
        Speed [m/s]: for power, and for the energy measure.
    direction : {"up", "down"}, optional
        Which way the robot goes; the stairs sheet's without one.
    facing : {"nose-first", "tail-first"}
        Which end leads.
    flippers : Posture or {"flat", "stowed"}
        Posture of the flippers.
    payload : Payload or iterable of Payload
        Masses fixed to the robot.
    theta_d, theta_M : float, (low, high) or None
        Measured allowances of Eq. (24) [rad]; None takes 0 to 2.6 degrees each (theta_M is zero
        when descending).
    yaw : float
        Heading off the line of steepest ascent, to the left positive [rad]; needs the contact model
        and the robot's gauge.
    risk : float
        Probability of failure that the operator accepts, (0, 0.5].
    model : {"contact", "closed-form"}
        Which model judges: the contact model the whole way on any profile, the closed form the
        paper's regular flight.
    accept : {"no-rotation", "caught"}
        What counts as holding: no rotation at all, or also a rotation that the next contact
        catches with the momentum gained.

    Returns
    -------
    Assessment
        A robot that cannot climb is an answer, not an error.

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> from math import radians
    >>> from kaidan.stairs import Stairs
    >>> answer = assess("kenaf", Stairs.inclined(angle=radians(50), nosing_spacing=0.150),
    ...                 friction=2.0)
    >>> answer.verdict, round(answer.margin_angle_deg, 3), round(answer.margin_deg, 2)
    ('go', 60.205, 5.01)

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    case = case_of(
        robot,
        stairs,
        surface=surface,
        friction=friction,
        acceleration=acceleration,
        speed=speed,
        direction=direction,
        facing=facing,
        flippers=flippers,
        payload=payload,
        theta_d=theta_d,
        theta_M=theta_M,
        yaw=yaw,
        risk=risk,
    )
    return answer_to(case, model=model, accept=accept)


def answer_to(case: Case, *, model: str = DEFAULT_MODEL, accept: str = "no-rotation") -> Assessment:
    """Answer of a model to a case; see `assess`."""
    from kaidan.assessment import advice, closed_form, wording

    for name, value, known in (("model", model, MODELS), ("accept", accept, ACCEPTED)):
        if not isinstance(value, str) or value not in known:
            raise InputError(f"{name} = {shown(value)} is not known; known: {', '.join(known)}")
    if case.yaw and model == "closed-form":
        raise InputError("the closed form knows no yaw; ask the contact model")
    along = case.changed(stairs=along_heading(case.stairs, case.yaw)) if case.yaw else case
    judged = closed_form.judge(along)
    flat = wording.put_into_words(along, judged)
    if model == "closed-form":
        return replace(flat, what_would_help=advice.by_closed_form(along, judged))
    from kaidan.assessment import contact_model

    return contact_model.answer(case, judged, flat, accept=accept)  # type: ignore[arg-type]


def case_of(
    robot: Robot | str | PathLike[str],
    stairs: Terrain,
    *,
    surface: Surface | str | PathLike[str] | None = None,
    friction: float | None = None,
    acceleration: float = 0.0,
    speed: float | None = None,
    direction: Direction | None = None,
    facing: Facing = "nose-first",
    flippers: Posture | Literal["flat", "stowed"] = "stowed",
    payload: Payload | Iterable[Payload] = (),
    theta_d: Any = None,
    theta_M: Any = None,
    yaw: float = 0.0,
    risk: float = 0.01,
) -> Case:
    """Case of the same arguments as `assess`: names resolved, everything checked."""
    robot = sheet_of(robot, Robot)
    stairs, profile, steps_known = terrain_of(stairs)
    if surface is not None and friction is not None:
        raise InputError("give either a surface or a friction, not both")
    if friction is not None:
        surface = Surface.of_friction(_within("friction", friction, *FRICTION, ""))
    elif surface is not None:
        surface = sheet_of(surface, Surface)
    direction = stairs.direction if direction is None else direction
    for name, value, allowed in (
        ("direction", direction, ("up", "down")),
        ("facing", facing, ("nose-first", "tail-first")),
    ):
        if not isinstance(value, str) or value not in allowed:
            raise InputError(f"{name} = {shown(value)} is not known; known: {', '.join(allowed)}")
    largest = LARGEST_ACCELERATION
    acceleration = _within("acceleration", acceleration, -largest, largest, "m/s^2")
    risk = _within("risk", risk, *RISK, "")
    yaw = _within("yaw", yaw, -LARGEST_YAW, LARGEST_YAW, "rad")
    if speed is not None:
        fastest, why = 30.0, "m/s"
        if robot.drive.max_speed is not None:
            fastest, why = robot.drive.max_speed, f"m/s, the most {robot.name} can do"
        speed = _within("speed", speed, 0.0, fastest, why)
    case = Case(
        robot=robot,
        stairs=stairs,
        surface=surface,
        posture=_posture(robot, flippers),
        payload=_payloads(payload),
        direction=direction,
        facing=facing,
        acceleration=acceleration,
        speed=speed,
        theta_d=Allowance.of(theta_d, name="theta_d"),
        theta_M=Allowance.of(theta_M, name="theta_M", descending=direction == "down"),
        risk=risk,
        profile=profile,
        steps_known=steps_known,
        yaw=float(yaw),
    )
    if case.yaw:
        if profile is not None:
            raise InputError("a profile lies along the heading already: leave the yaw out")
        gauge_of(case)
    _ = case.stance  # refuses a posture or payload that the robot cannot have
    return case


def _payloads(given: Any) -> tuple[Payload, ...]:
    if isinstance(given, Payload):
        return (given,)
    with suppress(TypeError):
        each = tuple(given)
        if not isinstance(given, str | bytes) and all(isinstance(one, Payload) for one in each):
            return each
    raise InputError(f"payload = {shown(given)} is not a Payload or a list of them")


def _within(name: str, value: Any, low: float, high: float, unit: str) -> float:
    """Number that is within its range; numpy's numbers are numbers, truth values are not."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"{name} = {shown(value)} is not a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not low <= number <= high:
        raise InputError(f"{name} = {number:g} is not within {low:g} to {high:g} {unit}".rstrip())
    return number


def _posture(robot: Robot, flippers: Posture | str) -> Posture:
    if isinstance(flippers, Posture):
        return flippers
    if not isinstance(flippers, str) or flippers not in ("flat", "stowed"):
        raise InputError(
            f"flippers = {shown(flippers)} is not known; known: flat, stowed, or angles"
        )
    if flippers == "stowed":
        return Posture()
    if robot.front_flippers is None and robot.rear_flippers is None:
        raise InputError(f"robot {robot.name!r} has no flippers")
    return Posture(
        front="flat" if robot.front_flippers else None,
        rear="flat" if robot.rear_flippers else None,
    )
