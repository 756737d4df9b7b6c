"""Entering the stairs: the centroid against the first step, after Guo et al. 2010.

The formulas of the single step are those of `kaidan.mechanics.transitions`. Here the question is
turned round: how far forward must the centroid lie for the first riser that is there?
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from kaidan.errors import InputError, shown
from kaidan.mechanics import Number
from kaidan.mechanics.transitions import (
    best_inclination,
    largest_step_height,
    riser_start_friction,
)
from kaidan.mechanics.validity import validity
from kaidan.robot import Payload, Posture, Robot, Stance
from kaidan.terrain.stairs import Stairs


def balance_inclination(*, h: Number, C_N: Number, R: Number) -> Number:
    """Inclination at which a given edge asks for the shortest lever.

    ``u^3 - P u - q = 0``, u = 1 / cos(theta), P = (R + C_N) / C_N, q = (h - R) / C_N:
    ``u = 2 sqrt(P/3) cos(arccos(w) / 3)``, ``w = (3 q / (2 P)) sqrt(3/P)``, and cosh, arcosh
    where w > 1

    ``d l_c / d theta = 0`` of `least_lever`. At u = 1 the left side is -h / C_N: the largest root
    is the only one beyond.

    Assumptions: those of `kaidan.mechanics.transitions.step_height`.

    Parameters
    ----------
    h : float or array
        Height of the edge [m].
    C_N : float or array
        Centroid above the underside [m].
    R : float or array
        Radius of the track's rear end [m].

    Returns
    -------
    float or array
        Inclination [rad]; NaN where h <= 0, or where R > C_N and the edge may bear on the rear end
        instead of the flat.

    Examples
    --------
    R = 0: u^3 - u - h/C_N = 0, and u = 2 for h = 6 C_N.

    >>> print(round(balance_inclination(h=0.6, C_N=0.1, R=0.0) * 180 / np.pi, 9))
    60.0

    References
    ----------
    Derived, after Guo, Song, Bao, Zhang & Tang 2010, doi:10.5772/10493; Cardano's formula.
    """
    P = (R + C_N) / C_N
    w = 1.5 * (h - R) / C_N / P * np.sqrt(3.0 / P)
    # one of the two factors is 1
    circular = np.cos(np.arccos(np.maximum(np.minimum(w, 1.0), -1.0)) / 3.0)
    hyperbolic = np.cosh(np.arccosh(np.maximum(w, 1.0)) / 3.0)
    u = 2.0 * np.sqrt(P / 3.0) * circular * hyperbolic
    return validity(holds=(h > 0.0) & (R <= C_N)) * np.arccos(1.0 / np.maximum(u, 1.0))


def least_lever(*, h: Number, C_N: Number, R: Number) -> Number:
    """Shortest distance from the rear tip to the centroid that carries it over an edge.

    ``l_c = min over theta of [h - R (1 - cos(theta))] / sin(theta) + C_N tan(theta)``

    `kaidan.mechanics.transitions.step_height` solved for l_c; its inverse is
    `kaidan.mechanics.transitions.largest_step_height`.

    Assumptions: those of `kaidan.mechanics.transitions.step_height`; enough friction.

    Parameters
    ----------
    h : float or array
        Height of the edge [m].
    C_N : float or array
        Centroid above the underside [m].
    R : float or array
        Radius of the track's rear end [m].

    Returns
    -------
    float or array
        Distance along the track [m]; NaN where `balance_inclination` is.

    Examples
    --------
    At 60 degrees, see `balance_inclination`: 0.6 / sin + 0.1 tan = 0.5 sqrt(3).

    >>> print(round(least_lever(h=0.6, C_N=0.1, R=0.0) / np.sqrt(3.0), 12))
    0.5

    References
    ----------
    Derived, after Guo et al. 2010, doi:10.5772/10493, who ask for the place of the centroid.
    """
    theta = balance_inclination(h=h, C_N=C_N, R=R)
    return (h - R * (1.0 - np.cos(theta))) / np.sin(theta) + C_N * np.tan(theta)


def tail_gap(*, theta: Number, l_c: Number, C_N: Number, R: Number) -> Number:
    """Horizontal distance from the riser back to the tail, balanced over the edge.

    ``(l_c - C_N tan(theta)) cos(theta) + R sin(theta) - R``

    Parameters
    ----------
    theta : float or array
        Inclination at which the centroid stands over the edge [rad].
    l_c : float or array
        Rear tip of the flat to the centroid, along the track [m].
    C_N : float or array
        Centroid above the underside [m].
    R : float or array
        Radius of the track's rear end [m].

    Returns
    -------
    float or array
        Gap [m]; negative: the tail meets the riser before, and the single step's formulas, which
        know its edge alone, do not hold.

    Examples
    --------
    sin = 0.6, cos = 0.8: (0.3 - 0.075) 0.8 + 0.06 - 0.1.

    >>> print(round(tail_gap(theta=np.arctan(0.75), l_c=0.3, C_N=0.1, R=0.1), 12))
    0.14

    References
    ----------
    Derived.
    """
    return (l_c - C_N * np.tan(theta)) * np.cos(theta) + R * np.sin(theta) - R


def edge_start_friction(*, h: Number, l_c: Number, C_L: Number, R: Number) -> Number:
    """Static friction needed to lift the nose off the floor over an edge not higher than its end.

    ``A mu^2 + B mu - l_c s = 0``, s = sin(delta), c = cos(delta), cos(delta) = 1 - h/R,
    ``A = (L + R s - l_c) s - R (1 - c) c``, ``B = (L + R s) c + R (1 - c) s``, L = l_c + C_L

    The edge touches the nose delta from its lowest point. At the start all floor load is on the
    rear tip of the flat; both contacts slip. The reactions then lean arctan(mu) and
    delta - arctan(mu) from the vertical, towards each other, and meet on the plumb line of the
    centroid; less friction would have them meet elsewhere.

    Assumptions: no flippers; the robot is still level. At h = R it is
    `kaidan.mechanics.transitions.riser_start_friction`.

    Parameters
    ----------
    h : float or array
        Height of the edge [m].
    l_c, C_L : float or array
        Centroid from the rear and from the front tip of the flat, along the track [m].
    R : float or array
        Radius of the track's front end [m].

    Returns
    -------
    float or array
        Friction [1], the same at floor and edge; NaN where h > R, a riser.

    Examples
    --------
    l_c = 0.3, C_L = 0.2, h = R = 0.1: 0.3 mu^2 + 0.1 mu - 0.3 = 0.

    >>> mu = edge_start_friction(h=0.1, l_c=0.3, C_L=0.2, R=0.1)
    >>> print(round(0.3 * mu**2 + 0.1 * mu, 12))
    0.3

    References
    ----------
    Derived.
    """
    c = 1.0 - h / R
    s = np.sqrt(np.maximum(1.0 - c * c, 0.0))
    reach = l_c + C_L + R * s
    A = (reach - l_c) * s - R * (1.0 - c) * c
    B = reach * c + R * (1.0 - c) * s
    # the root without cancellation: A vanishes with h
    mu = 2.0 * l_c * s / (B + np.sqrt(B * B + 4.0 * A * l_c * s))
    return validity(holds=h <= R) * mu


class Ends(NamedTuple):
    """What entering sees of a robot: the end that leads is called the front."""

    L: float
    """Length of the flat underside [m]."""
    C_L: float
    """Centroid behind the leading tip of the flat [m]."""
    C_N: float
    """Centroid above the underside [m]."""
    R_front: float
    """Radius of the leading end [m]."""
    R_rear: float
    """Radius of the end that follows [m]."""


def ends_of(robot: Robot, stance: Stance, facing: str = "nose-first") -> Ends:
    """Ends of a robot that goes up nose first or tail first.

    Parameters
    ----------
    robot : Robot
        Robot.
    stance : Stance
        Its stance; where flippers lengthen the flat, its ends are theirs.
    facing : {"nose-first", "tail-first"}
        Which end leads.

    Returns
    -------
    Ends

    Raises
    ------
    InputError
        Another facing.
    """
    if facing not in ("nose-first", "tail-first"):
        raise InputError(f"facing = {shown(facing)} is not known; known: nose-first, tail-first")
    L, C_L = stance.flat_length, stance.com_from_front
    longer = {
        "front": stance.front_extension > 0,
        "rear": L - robot.track.flat_length - stance.front_extension > 1e-9,
    }
    front, rear = (
        pair.tip_radius if longer[end] and pair is not None else radius
        for end, pair, radius in (
            ("front", robot.front_flippers, robot.track.front_radius),
            ("rear", robot.rear_flippers, robot.track.rear_radius),
        )
    )
    if facing == "tail-first":
        return Ends(L, L - C_L, stance.com_height, rear, front)
    return Ends(L, C_L, stance.com_height, front, rear)


@dataclass(frozen=True, kw_only=True)
class Entering:
    """Whether the centroid gets over the first step, and by how much."""

    rise: float
    """First riser [m]."""
    ends: Ends
    largest_rise: float
    """Highest single step over which the robot can pivot [m]; NaN outside the formula."""
    at_inclination: float
    """Inclination at which it would balance over that one [rad]; NaN outside."""
    com_limit: float
    """Farthest that the centroid may lie behind the leading tip for this riser [m]; NaN outside."""
    start_friction: float
    """Static friction needed to lift the leading end off the floor, up the riser or over its
    edge [1]."""

    @property
    def rise_margin(self) -> float:
        """How much higher the riser might be [m]; negative where it is too high."""
        return self.largest_rise - self.rise

    @property
    def centroid_margin(self) -> float:
        """How far the centroid might move back [m]; negative where it lies too far back."""
        return self.com_limit - self.ends.C_L

    @property
    def holds(self) -> bool | None:
        """Whether the centroid gets over the step; None outside the formula."""
        unknown = math.isnan(self.centroid_margin) or math.isnan(self.rise_margin)
        return None if unknown else self.centroid_margin >= 0


def first_step(
    robot: Robot,
    stairs: Stairs,
    *,
    posture: Posture | None = None,
    payload: Iterable[Payload] = (),
    facing: Literal["nose-first", "tail-first"] = "nose-first",
) -> Entering:
    """Centroid against the first step, after Guo et al. 2010.

    A single step: the tail stands on the lower floor, the flat bears on the edge, nothing else
    carries. On a flight the second nosing may carry a robot whose centroid does not get over the
    first one; ``kaidan traverse`` follows that.

    Parameters
    ----------
    robot : Robot
        Robot.
    stairs : Stairs
        Flight, of which only the first riser counts.
    posture : Posture, optional
        Angles of the flippers; stowed without one. Flippers that are neither stowed nor in line
        with the track move the centroid and nothing more.
    payload : iterable of Payload
        Masses fixed to the robot.
    facing : {"nose-first", "tail-first"}
        Which end leads up the stairs.

    Returns
    -------
    Entering
        NaN, and `holds` None, outside the formulas: where the rear end's radius exceeds the
        centroid's height, where the centroid is not over the flat, or where the tail would meet
        the riser first.

    Raises
    ------
    InputError
        A posture or payload that the robot cannot have, an unknown facing.

    References
    ----------
    After Guo, Song, Bao, Zhang & Tang 2010, doi:10.5772/10493, derived anew.
    """
    at = ends_of(robot, robot.stance(posture, payload), facing)
    rise = stairs.step_rises[0]
    l_c, body = at.L - at.C_L, {"C_N": at.C_N, "R": at.R_rear}
    theta = best_inclination(l_c=l_c, **body)
    inside = _inside(at, theta, l_c)
    lever, balance = least_lever(h=rise, **body), balance_inclination(h=rise, **body)
    return Entering(
        rise=rise,
        ends=at,
        largest_rise=inside * float(largest_step_height(l_c=l_c, **body)),
        at_inclination=inside * float(theta),
        com_limit=_inside(at, balance, lever) * float(at.L - lever),
        start_friction=start_friction(at, rise),
    )


def _inside(at: Ends, theta: float, l_c: float) -> float:
    """One where both directions of the question hold, NaN elsewhere."""
    gap = tail_gap(theta=theta, l_c=l_c, C_N=at.C_N, R=at.R_rear)
    return float(validity(holds=(at.R_rear <= at.C_N) & (0 <= at.C_L < at.L) & (gap >= 0)))


def start_friction(at: Ends, rise: float) -> float:
    """Static friction to lift the leading end up a riser, or over its edge if that is low [1]."""
    com = {"l_c": at.L - at.C_L, "C_L": at.C_L, "R": at.R_front}
    if rise <= at.R_front:
        return float(edge_start_friction(h=rise, **com))
    return float(riser_start_friction(**com))
