"""Conditions of climbing ability, by name and each with its margin, after Liu J. et al. 2005.

Their list for a tracked robot on stairs (get the nose up the first riser, lie on two nosings, do
not tip, do not slip, get over the last edge) with the formulas of `kaidan.mechanics`. Margins of
different conditions have different units, so there is no smallest of them.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal, NamedTuple

import numpy as np

from kaidan.errors import InputError, shown
from kaidan.literature.entering import Ends, ends_of, first_step, start_friction
from kaidan.mechanics.drive import drive_force
from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
    slope_limit,
)
from kaidan.mechanics.margins import margins
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.mechanics.slipping import equivalent_slope
from kaidan.mechanics.transitions import crest_progress
from kaidan.robot import Payload, Posture, Robot
from kaidan.terrain.stairs import Stairs


class Name(StrEnum):
    """Condition of climbing ability, in the order in which the robot meets them."""

    NOSE_UP = "nose-up"
    """Friction lifts the nose off the floor, up the first riser or over its edge; margin: friction
    left over [1]."""
    FIRST_STEP = "first-step"
    """The centroid gets over the first edge, as `kaidan.literature.entering.first_step` asks;
    margin: height by which the riser might be higher [m]."""
    TWO_NOSINGS = "two-nosings"
    """Two nosings carry the robot even just after one has left it; margin: L - 2 p [m]."""
    NO_TIP_DOWNHILL = "no-tip-downhill"
    """It does not tip over its lowest contact; margin: slope [rad]."""
    NO_TIP_UPHILL = "no-tip-uphill"
    """It does not tip over its highest contact; margin: slope [rad]."""
    NO_SLIP = "no-slip"
    """Friction gives the traction; margin: slope [rad]."""
    DRIVE = "drive"
    """The drive gives the traction; margin: force [N]."""
    LANDING = "landing"
    """The flat still reaches back to the last nosing when the centroid passes over it; margin:
    length of flat behind it [m]."""


@dataclass(frozen=True, kw_only=True)
class Condition:
    """One condition of climbing ability."""

    name: Name
    margin: float
    """Positive when safe, zero still holds; NaN where nothing can be said."""
    unit: str
    """Unit of the margin: "m", "rad", "N" or "1"."""
    step: int
    """Riser, counted from 1 at the bottom, at whose nosing the margin is smallest."""
    why_unknown: str = ""
    """What is missing where the margin is NaN."""

    @property
    def holds(self) -> bool | None:
        """Whether the condition holds; None where nothing can be said."""
        return None if math.isnan(self.margin) else self.margin >= 0


@dataclass(frozen=True, kw_only=True)
class ClimbingAbility:
    """All conditions, in the order in which the robot meets them."""

    conditions: tuple[Condition, ...]

    @property
    def holds(self) -> bool | None:
        """True if all hold, False if one fails, None if none fails and one is not known."""
        each = [condition.holds for condition in self.conditions]
        return False if False in each else None if None in each else True

    @property
    def failing(self) -> tuple[Name, ...]:
        """Conditions that fail."""
        return tuple(each.name for each in self.conditions if each.holds is False)

    @property
    def unknown(self) -> tuple[Name, ...]:
        """Conditions of which nothing can be said."""
        return tuple(each.name for each in self.conditions if each.holds is None)

    def __getitem__(self, name: Name | str) -> Condition:
        """Return the condition of a name.

        Raises
        ------
        InputError
            An unknown name.
        """
        for condition in self.conditions:
            if condition.name == name:
                return condition
        raise InputError(f"condition {shown(str(name))} is not known; known: {', '.join(Name)}")


def climbing_conditions(
    robot: Robot,
    stairs: Stairs,
    *,
    friction: float | None = None,
    acceleration: float = 0.0,
    posture: Posture | None = None,
    payload: Iterable[Payload] = (),
    facing: Literal["nose-first", "tail-first"] = "nose-first",
) -> ClimbingAbility:
    """Conditions for a robot to climb a flight, each with its margin, after Liu J. et al. 2005.

    Ascent only, straight up, without the allowances that `kaidan.assess` subtracts. The conditions
    of tipping and slipping are those of `kaidan.mechanics.margins.margins` on the worst regular
    step; where two nosings do not carry the robot everywhere, tipping is NaN.

    Parameters
    ----------
    robot : Robot
        Robot.
    stairs : Stairs
        Flight, regular or not.
    friction : float, optional
        Static friction of the tracks on nosings and floor [1]; not judged without one.
    acceleration : float
        Acceleration up the stairs on the flight [m/s^2]; entering and start are slow.
    posture : Posture, optional
        Angles of the flippers; stowed without one.
    payload : iterable of Payload
        Masses fixed to the robot.
    facing : {"nose-first", "tail-first"}
        Which end leads.

    Returns
    -------
    ClimbingAbility
        A robot that cannot climb is an answer, not an error.

    Raises
    ------
    InputError
        A friction or acceleration that is no finite number, a friction below 0, a posture or
        payload that the robot cannot have, an unknown facing.

    References
    ----------
    After Liu, Wang, Ma & Li 2005, "Analysis of stairs-climbing ability for a tracked
    reconfigurable modular robot", IEEE SSRR, pp. 36-40; their text was not at hand.
    """
    if friction is not None and not (math.isfinite(friction) and friction >= 0):
        raise InputError(f"friction = {friction:g} is not within 0 to inf")
    if not math.isfinite(acceleration):
        raise InputError(f"acceleration = {acceleration:g} m/s^2 is not a finite number")
    payload = tuple(payload)
    stance = robot.stance(posture, payload)
    at = ends_of(robot, stance, facing)
    step = first_step(robot, stairs, posture=posture, payload=payload, facing=facing)
    mu = math.nan if friction is None else friction
    no_friction = "" if friction is not None else "friction is not given"
    found = [
        Condition(
            name=Name.NOSE_UP,
            margin=mu - start_friction(at, stairs.step_rises[0]),
            unit="1",
            step=1,
            why_unknown=no_friction,
        ),
        Condition(
            name=Name.FIRST_STEP,
            margin=step.rise_margin,
            unit="m",
            step=1,
            why_unknown="outside the formulas of the single step" if step.holds is None else "",
        ),
        *_on_the_flight(at, stairs, mu, acceleration, no_friction),
        _drive(robot, stairs, stance.mass, acceleration),
        _landing(at, stairs, acceleration),
    ]
    return ClimbingAbility(conditions=tuple(found))


class _OnStep(NamedTuple):
    """Margins on one regular step."""

    two_nosings: float
    tip_downhill: float
    tip_uphill: float
    slip: float


def _on_step(at: Ends, theta_s: float, p: float, mu: float, a: float) -> _OnStep:
    body = {"C_L": at.C_L, "C_N": at.C_N, "theta_s": theta_s, "p": p, "a": a}
    remain = bool(two_contacts_remain(L=at.L, p=p))
    spare = at.L - 2 * p
    with np.errstate(invalid="ignore"):  # no slope is the limit: `_angle` sees to it
        one = margins(L=at.L, mu_s=mu, **body)
        slides_down = slope_limit(grip=mu, a=a) - theta_s
        slides_up = theta_s - slope_limit(grip=-mu, a=a)
    felt = equivalent_slope(theta_s=theta_s, a=a)
    inside = 1.0 if remain else math.nan
    return _OnStep(
        two_nosings=max(spare, 0.0) if remain else spare,
        tip_downhill=_angle(one.tip_downhill, inside * centroid_margin_downhill(L=at.L, **body)),
        tip_uphill=_angle(one.tip_uphill, inside * centroid_margin_uphill(**body)),
        slip=min(_angle(slides_down, mu - felt), _angle(slides_up, mu + felt)),
    )


def _angle(margin: float, slack: float) -> float:
    """Margin of slope; an acceleration too hard for any limit holds on every slope or on none."""
    if math.isnan(margin) and not math.isnan(slack):
        return math.copysign(math.pi / 2, slack)
    return float(margin)


def _on_the_flight(
    at: Ends, stairs: Stairs, mu: float, a: float, no_friction: str
) -> Iterator[Condition]:
    """Conditions of the regular steps, each on its worst one."""
    steps = (_on_step(at, math.atan2(*s), math.hypot(*s), mu, a) for s in stairs.regular_steps)
    spare, downhill, uphill, slip = zip(*steps, strict=True)
    too_short = "two nosings do not carry it everywhere" if min(spare) < 0 else ""
    yield _worst(Name.TWO_NOSINGS, spare, "m", "")
    yield _worst(Name.NO_TIP_DOWNHILL, downhill, "rad", too_short)
    yield _worst(Name.NO_TIP_UPHILL, uphill, "rad", too_short)
    yield _worst(Name.NO_SLIP, slip, "rad", no_friction)


def _worst(name: Name, values: Sequence[float], unit: str, why: str) -> Condition:
    """Condition by its smallest value, or by the first that is not known."""
    unknown = [index for index, value in enumerate(values) if math.isnan(value)]
    index = unknown[0] if unknown else values.index(min(values))
    # the regular steps begin at the second riser
    return Condition(name=name, margin=values[index], unit=unit, step=index + 2, why_unknown=why)


def _drive(robot: Robot, stairs: Stairs, mass: float | None, a: float) -> Condition:
    limit = robot.drive.max_traction
    if mass is None or limit is None:
        why = "mass is not known" if mass is None else "drive.max_traction is not known"
        return Condition(name=Name.DRIVE, margin=math.nan, unit="N", step=2, why_unknown=why)
    left = [
        limit
        - float(
            drive_force(
                M=mass,
                a=a,
                theta_s=math.atan2(rise, going),
                c_rr=robot.drive.rolling_resistance,
            )
        )
        for rise, going in stairs.regular_steps
    ]
    return _worst(Name.DRIVE, left, "N", "")


def _landing(at: Ends, stairs: Stairs, a: float) -> Condition:
    """Length of flat behind the last nosing as the centroid passes over it.

    The slope is that of the line from the last but one nosing to the last.
    """
    slope = math.atan2(stairs.step_rises[-1], stairs.step_goings[-1])
    behind = crest_progress(C_L=at.C_L, C_N=at.C_N, theta_s=slope, a=a)
    return Condition(
        name=Name.LANDING,
        margin=at.L - float(behind),
        unit="m",
        step=len(stairs.step_rises),
    )
