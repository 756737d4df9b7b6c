r"""Rollover avoidance with a stability margin (after Ohno et al. 2009).

A tracked vehicle with sub-tracks watches its normalised energy stability margin and, before it
falls below a threshold, turns a sub-track so that another contact carries it; where none does, it
stops.

::

            C                     C
           /                     /
      ----o---. nose up     ----o---.____      rear flippers down: the rearmost contact
       rear    `.                rear     o    moves back, and the margin about it grows

Source: Ohno, Takeuchi, Chun, Tadokoro, Yuzawa, Yoshida & Koyanagi 2009, "Rollover avoidance using a
stability margin for a tracked vehicle with sub-tracks", IEEE SSRR, 1-6. Re-derived: the rule is
ours; the margin is Hirose's, see `kaidan.mechanics.measures`.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kaidan.errors import InputError
from kaidan.literature.stepping import RANGE, Angles
from kaidan.mechanics.measures import (
    energy_margin_backward,
    energy_margin_forward,
)

Array = NDArray[np.float64]

STRIDE = math.radians(10.0)
"""Turn by which motions longer than a step of the path are looked for [rad]: the kernel settles the
robot at each, and a flipper of 0.3 m moves by 5 cm, less than any stair."""
_DIRECTIONS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1))


class Predictor(Protocol):
    """What foresees the margin."""

    def __call__(self, angles: Angles, /) -> tuple[float, float]:
        """Margins with flippers at these angles, here and one step of the path ahead [m]."""
        ...


class Action(StrEnum):
    """What the rule decides before each step of the path."""

    GO = "go"
    """Drive on: the margin stays above the threshold."""
    MOVE = "move"
    """Drive on while the flippers turn: that keeps it."""
    WAIT = "wait"
    """Stand, turn the flippers, then drive on."""
    STOP = "stop"
    """No motion of the flippers restores it."""


@dataclass(frozen=True, kw_only=True)
class Decision:
    """What to do and why."""

    action: Action
    angles: Angles
    """Flippers to be had before driving on [rad]; the present ones for go and stop."""
    margin: float
    """Margin predicted without a motion [m]."""
    margin_then: float
    """Margin predicted with it [m]."""
    turn: float
    """Largest turn of a pair [rad]."""


def stability_margin(contacts: ArrayLike, com: ArrayLike) -> tuple[float, float]:
    """Normalised energy stability margins about the outermost of a set of contacts.

    ``S = l (1 - sin(angle of the centroid above the horizontal at the contact))``

    Parameters
    ----------
    contacts : array, shape (n, 2)
        Points that carry the robot, x ahead and z up [m].
    com : array, shape (2,)
        Centroid [m].

    Returns
    -------
    back, front : float
        Rise of the centroid before it stands over the rearmost contact, and over the foremost
        [m]; negative once it has passed it.

    Raises
    ------
    InputError
        No contact, or arrays of another shape or with numbers that are not finite.

    Examples
    --------
    A centroid at (0, 3) on contacts at -4 and 4: from 3 up to 5, by hand.

    >>> stability_margin([(-4, 0), (4, 0), (1, 0)], (0, 3))
    (2.0, 2.0)

    References
    ----------
    Hirose, Tsukagoshi & Yoneda 1998, see `kaidan.mechanics.measures.energy_margin_backward`.
    """
    points, centre = np.asarray(contacts, dtype=float), np.asarray(com, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) == 0 or centre.shape != (2,):
        raise InputError(
            f"contacts of shape {points.shape} and centroid of shape {centre.shape}: "
            "write (n, 2) and (2,)"
        )
    if not (np.isfinite(points).all() and np.isfinite(centre).all()):
        raise InputError("contacts and centroid must be finite")
    rear, front = points[points[:, 0].argmin()], points[points[:, 0].argmax()]
    b_x, b_z = (float(each) for each in centre - rear)
    f_x, f_z = (float(each) for each in centre - front)
    back = energy_margin_backward(
        alpha=math.hypot(b_x, b_z), theta_alpha=math.atan2(b_z, b_x), theta_s=0.0
    )
    ahead = energy_margin_forward(
        beta=math.hypot(f_x, f_z), theta_beta=math.atan2(f_z, -f_x), theta_s=0.0
    )
    return float(back), float(ahead)


def avoid_rollover(
    now: Angles,
    predict: Predictor,
    *,
    threshold: float,
    reach: tuple[float, float],
    limits: tuple[float, float] = RANGE,
) -> Decision:
    """Rule of avoidance: go, turn flippers while driving, stand and turn them, or stop.

    Looked for in this order: no motion; front or rear pair, up or down, then both, by what they
    turn within one step of the path; the same by longer turns, while the robot stands. The shortest
    turn that keeps the threshold wins, and of equally long ones that with the larger margin. While
    the flippers turn, the robot must not come nearer to the edge than the threshold, or than it
    is.

    Parameters
    ----------
    now : Angles
        Present angles [rad].
    predict : callable
        Margins here and one step ahead with given angles [m].
    threshold : float
        Margin to be kept [m].
    reach : (float, float)
        Turn of the front and of the rear pair within one step of the path [rad]; 0 for a pair that
        does not move.
    limits : (float, float)
        Joint range [rad].

    Returns
    -------
    Decision

    Raises
    ------
    InputError
        A threshold that is not finite, a negative reach, or limits in the wrong order.

    Examples
    --------
    A margin that grows as the rear flippers go down, 1 mm for 0.1 rad:

    >>> def predict(angles):
    ...     return (0.01, 0.004 - 0.01 * angles.rear)
    >>> decision = avoid_rollover(Angles(0.0, 0.0), predict, threshold=0.005, reach=(0.2, 0.2))
    >>> decision.action.value, decision.angles
    ('move', Angles(front=0.0, rear=-0.2))
    """
    check(threshold, reach, limits)
    here, ahead = predict(now)
    margin = min(here, ahead)
    if margin >= threshold:
        return Decision(
            action=Action.GO, angles=now, margin=margin, margin_then=margin, turn=0.0
        )  # fmt: skip
    floor = min(threshold, here)
    blocked: set[tuple[int, int]] = set()
    for turn, is_first in _turns(reach, limits):
        best: tuple[float, Angles] | None = None
        for direction in _DIRECTIONS:
            requested = (
                None if direction in blocked else _turned(now, direction, turn, reach, limits)
            )
            if requested is None:
                continue
            stays, moves = predict(requested)
            if stays < floor:
                blocked.add(direction)  # the way there leads over the edge
                continue
            then = min(stays, moves)
            if then >= threshold and (best is None or then > best[0]):
                best = (then, requested)
        if best is not None:
            return Decision(
                action=Action.MOVE if is_first else Action.WAIT,
                angles=best[1], margin=margin, margin_then=best[0], turn=turn,
            )  # fmt: skip
    return Decision(action=Action.STOP, angles=now, margin=margin, margin_then=margin, turn=0.0)


def check(threshold: float, reach: tuple[float, float], limits: tuple[float, float]) -> None:
    """Refuse what has no meaning."""
    if not math.isfinite(threshold):
        raise InputError(f"threshold = {threshold:g} m is not a finite margin")
    if not all(0.0 <= each < math.inf for each in reach):
        raise InputError(f"reach = {reach[0]:g}, {reach[1]:g} rad: write turns from 0 on")
    if not -math.pi <= limits[0] < limits[1] <= math.pi:
        raise InputError(
            f"limits = {limits[0]:g} to {limits[1]:g} rad: write a smaller and a larger angle "
            "within -3.14159 to 3.14159 rad"
        )


def _turns(reach: tuple[float, float], limits: tuple[float, float]) -> Iterator[tuple[float, bool]]:
    """Turns to try, the shortest first, and whether it is done within a step of the path."""
    first = max(reach)
    if first == 0.0:
        return
    yield first, True
    turn = first
    while turn < limits[1] - limits[0]:
        turn += max(first, STRIDE)
        yield turn, False


def _turned(
    now: Angles,
    direction: tuple[int, int],
    turn: float,
    reach: tuple[float, float],
    limits: tuple[float, float],
) -> Angles | None:
    """Angles after a turn, the slower pair by its share; None if nothing turns so."""
    new: list[float | None] = []
    moved = False
    for angle, way, share in zip(now, direction, reach, strict=True):
        if angle is None or way == 0 or share == 0.0:
            if way != 0:
                return None
            new.append(angle)
            continue
        goal = angle + way * turn * share / max(reach)
        # from outside the joint range back into it is a turn too
        goal = min(max(goal, min(limits[0], angle)), max(limits[1], angle))
        moved |= abs(goal - angle) > 1e-12
        new.append(goal)
    return Angles(*new) if moved else None
