"""Which trials say most: Bayesian D-optimal design, chosen one condition after the other.

A trial holds with probability ``1 / (1 + exp((theta_s - m) / s))``: m is the margin at its spacing,
higher by theta_M on the way down, s the scatter of trials. One that holds shows theta_d besides,
which the closed form gives of w_n. What is expected of a plan is the logarithm of the determinant
of the information on (w_n, theta_M, s, m of each spacing), the mean over what is possible before
anything was tried.

References
----------
Chaloner & Verdinelli 1995, doi:10.1214/ss/1177009939.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError
from kaidan.lab.campaign import Condition
from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.yielding import theta_d_two_contacts
from kaidan.robot import Robot

Array = NDArray[np.float64]

SHARES = (0.32, 0.38, 0.43, 0.47)
"""Nosing spacings as shares of L: the paper's 150 to 220 mm of Kenaf's 470 mm."""
CONDITIONS = 24
"""Conditions of a plan; of five trials each it is a day at the rig."""
AROUND = math.radians(9.0)
"""Slopes beside the formula's margin that may be tried [rad]."""
STEP = math.radians(1.0)
"""Between the slopes that may be tried [rad]."""
STEEPEST = math.radians(65.0)
"""Steepest slope that a rig need reach [rad]."""
BELOW = math.radians(3.0)
"""How far below the margin theta_d is measured where its cause is looked for [rad]."""
DRAWS = 64
"""Of what is possible before anything was tried."""
TILT_READ = math.radians(0.5)
"""Scatter of one measurement of theta_d [rad]: of the sensor, and of where the robot begins."""

# Before anything was tried: medians or means, and standard deviations
W_N = (0.006, 0.7)
"""Indentation under the whole weight [m] and its spread, as a logarithm: 1.5 to 24 mm."""
THETA_M = (math.radians(2.0), math.radians(2.0))
SCATTER = (math.radians(0.7), 0.5)
MARGIN = math.radians(3.0)
"""Of the margin beside the formula's [rad]."""


class Planned(NamedTuple):
    """A condition with what it adds."""

    condition: Condition
    gain: float
    """Expected information of its trials, those before it known [bit]."""


class Design(NamedTuple):
    """Conditions and what they are expected to tell."""

    planned: tuple[Planned, ...]
    """In the order of spacing, direction and slope."""
    trials: int
    """A condition."""
    expected: dict[str, tuple[float, float]]
    """Standard deviation before and after, the mean over what is possible: "w_n" as a logarithm,
    "theta_M" [rad]."""


def spacings_of(robot: Robot) -> list[float]:
    """Nosing spacings for a robot: the paper's shares of L, to 5 mm [m]."""
    L = robot.track.flat_length
    return [round(share * L / 0.005) * 0.005 for share in SHARES]


def design(robot: Robot, spacings: list[float], trials: int = 5, count: int = CONDITIONS) -> Design:
    """Conditions of which the trials are expected to tell most.

    Parameters
    ----------
    robot : Robot
        Of known centroid.
    spacings : list of float
        Nosing spacings that the rig has [m].
    trials : int
        A condition.
    count : int
        Of conditions.

    Raises
    ------
    InputError
        No spacing has a margin between 10 and 65 degrees.
    """
    candidates = _candidates(robot, spacings)
    if not candidates:
        raise InputError(
            f"protocol: no nosing spacing has a margin of {robot.name} between 10 and "
            f"{math.degrees(STEEPEST):.0f} deg to be tried"
        )
    used = sorted({each.nosing_spacing for each in candidates})
    informs = np.stack([_information(robot, each, used, trials) for each in candidates])
    prior = np.diag([W_N[1] ** -2, THETA_M[1] ** -2, SCATTER[1] ** -2, *[MARGIN**-2] * len(used)])
    now = np.broadcast_to(prior, informs.shape[1:]).copy()
    left = list(range(len(candidates)))
    planned = []
    for _ in range(min(count, len(candidates))):
        was = np.linalg.slogdet(now)[1]
        gains = np.mean(np.linalg.slogdet(now + informs[left])[1] - was, axis=1)
        best = left.pop(int(np.argmax(gains)))
        now = now + informs[best]
        planned.append(Planned(candidates[best], float(gains.max()) / (2 * math.log(2))))
    after = np.sqrt(np.mean(np.linalg.inv(now)[:, [0, 1], [0, 1]], axis=0)).tolist()
    return Design(
        planned=tuple(sorted(planned, key=lambda each: _order(each.condition))),
        trials=trials,
        expected={"w_n": (W_N[1], after[0]), "theta_M": (THETA_M[1], after[1])},
    )


def _order(condition: Condition) -> tuple[float, bool, float]:
    return condition.nosing_spacing, condition.direction == "down", condition.angle


def margin_of(robot: Robot, p: float) -> float:
    """Margin of the rigid smooth track [rad]."""
    stance = robot.stance()
    return float(
        theta_s_sup(
            L=stance.flat_length, p=p, C_L=stance.com_from_front, C_N=stance.com_height, a=0.0
        )
    )


def _candidates(robot: Robot, spacings: list[float]) -> list[Condition]:
    found = []
    for p in spacings:
        margin = margin_of(robot, p)
        if not math.radians(10.0) < margin:  # NaN too
            continue
        for k in range(-9, 10):
            angle = round(math.degrees(margin + k * STEP))
            slope = math.radians(angle)
            if abs(slope - margin) <= AROUND and math.radians(5.0) <= slope <= STEEPEST:
                found += [
                    Condition.model_validate({"nosing_spacing": p, "angle": slope, "direction": to})
                    for to in ("up", "down")
                ]
    return found


def _information(robot: Robot, at: Condition, used: list[float], trials: int) -> Array:
    """Fisher information of a condition's trials for each draw, shape (draws, n, n)."""
    unit = np.random.default_rng(2016).standard_normal((DRAWS, 3 + len(used)))
    w_n = W_N[0] * np.exp(W_N[1] * unit[:, 0])
    theta_M = THETA_M[0] + THETA_M[1] * unit[:, 1]
    scatter = SCATTER[0] * np.exp(SCATTER[1] * unit[:, 2])
    own = 3 + used.index(at.nosing_spacing)
    down = at.direction == "down"
    off = margin_of(robot, at.nosing_spacing) + MARGIN * unit[:, own] + theta_M * down - at.angle
    holds = 1.0 / (1.0 + np.exp(-np.clip(off / scatter, -50.0, 50.0)))
    slope = np.zeros((DRAWS, 3 + len(used)))
    slope[:, own] = 1.0 / scatter
    slope[:, 1] = down / scatter
    slope[:, 2] = -off / scatter
    known = trials * (holds * (1.0 - holds))[:, None, None] * slope[:, :, None] * slope[:, None]
    if not down:
        stance = robot.stance()
        place = {
            "L": stance.flat_length,
            "p": at.nosing_spacing,
            "C_L": stance.com_from_front,
            "C_N": stance.com_height,
            "theta_s": at.angle,
        }
        with np.errstate(all="ignore"):
            more, less = (
                theta_d_two_contacts(**place, w_n=w_n * math.exp(each)) for each in (0.05, -0.05)
            )
        by_w_n = np.nan_to_num((np.asarray(more) - np.asarray(less)) / 0.1)
        known[:, 0, 0] += trials * holds * (by_w_n / TILT_READ) ** 2
    return known
