"""theta_d of a question: as stated, or what yielding tracks cost as they were measured."""

import math
from typing import Any

import numpy as np

from kaidan.allowance import LARGEST_ALLOWANCE, Allowance
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.yielding import yielding_loss
from kaidan.question.fields import QuestionFields
from kaidan.robot import Stance

ROCKING_SPEED = 0.1
"""Speed whose energy the robot is taken to have where none is stated [m/s]: the paper's test
speed, at which the rig rocked visibly with 0.07 mm of energy margin against 0.51 mm of v^2/2g."""
FASTEST_YIELDING = 0.15
"""Fastest speed for which the loss on a yielding track was tried [m/s]; beyond it a robot passes a
nosing faster than it falls."""


def allowance_d(question: QuestionFields) -> Allowance:
    """theta_d as stated, else as the robot's sheet has it, else the default range.

    Where the sheet has indentation and sag, what they cost by mechanics takes the place of the
    default range, and raises a measured one that is smaller: the most over the spacings.
    """
    stated = _stated(question)
    if question.theta_d is not None or not any(_lengths(question)):
        return stated
    stance, nosings = _bare(question), question.profile.nosings
    L, C_L = stance.flat_length, stance.com_from_front
    losses = _losses(
        question,
        L=L,
        p=np.hypot(*np.diff(nosings, axis=0).T),
        C_L=C_L if question.nose_up else L - C_L,
        C_N=stance.com_height,
    )
    high = float(np.nanmax(losses, initial=0.0))
    if np.isnan(losses).all():
        return stated
    if high <= stated.high and not (_as_measured(question) and stated.source == "default"):
        return stated
    return Allowance(low=stated.low, high=high, source="indentation and sag as measured")


def theta_d_at(question: QuestionFields, *, L: Any, p: Any, C_L: Any, C_N: Any) -> Any:
    """High end of `allowance_d` of the same robot with other lengths [rad].

    L, p, C_L, C_N: flat length, nosing spacing, centroid behind the uphill tip and above the
        underside [m].
    """
    high = _stated(question)
    losses = _losses(question, L=L, p=p, C_L=C_L, C_N=C_N)
    if losses is None:
        return high.high
    alone = _as_measured(question) and high.source == "default"
    least = np.where(np.isnan(losses) | (not alone), high.high, 0.0)
    return np.fmax(losses, least)


def _stated(question: QuestionFields) -> Allowance:
    return Allowance.of(question.theta_d or question.robot.theta_d, name="theta_d")


def _losses(question: QuestionFields, *, L: Any, p: Any, C_L: Any, C_N: Any) -> Any:
    """Margin that a yielding track costs [rad]; None: stated otherwise, or nothing is known.

    With one of indentation and sag the other counts as equal.
    """
    lengths, speed = _lengths(question), question.speed
    known = [each for each in lengths if each is not None]
    if question.theta_d is not None or not known:
        return None
    mu = question.friction[1]
    losses = yielding_loss(
        L=L,
        p=p,
        C_L=C_L,
        C_N=C_N,
        w_n=lengths[0] or known[0],
        w_t=lengths[1] or known[0],
        R=_radius_downhill(question),
        mu=math.inf if math.isnan(mu) else mu,
        speed=ROCKING_SPEED if speed is None else min(speed, FASTEST_YIELDING),
        gyration=L / math.sqrt(12.0),
    )
    return np.minimum(losses, LARGEST_ALLOWANCE)


def _as_measured(question: QuestionFields) -> bool:
    """Whether indentation and sag are both known, of a belt that the mechanics knows."""
    return None not in _lengths(question) and not question.robot.track.has_grousers


def _lengths(question: QuestionFields) -> tuple[float | None, float | None]:
    """How far the whole weight on one nosing presses in and drags the tracks [m]."""
    track, own, mass = question.robot.track, question.robot.mass, _bare(question).mass
    if own is None or mass is None:
        return track.indentation, track.sag

    def of(length: float | None, stiffness: float | None) -> float | None:
        if stiffness is not None:
            return mass * STANDARD_GRAVITY / stiffness
        return None if length is None else length * mass / own

    return of(track.indentation, track.stiffness), of(track.sag, track.shear_stiffness)


def _bare(question: QuestionFields) -> Stance:
    """Stance on the flight; with the flippers stowed as long as they are to be found."""
    if "flippers" in question.best_of:
        return question.robot.stance(None, question.payload)
    return question.stance


def _radius_downhill(question: QuestionFields) -> float:
    """Radius of the downhill end of the flat underside [m]."""
    robot, stance = question.robot, _bare(question)
    front = stance.front_extension
    rear = stance.flat_length - robot.track.flat_length - front
    pair, extension, radius = (
        (robot.rear_flippers, rear, robot.track.rear_radius)
        if question.nose_up
        else (robot.front_flippers, front, robot.track.front_radius)
    )
    return pair.tip_radius if pair is not None and extension > 1e-9 else radius
