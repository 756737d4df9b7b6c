"""An independent judge of the planar mechanics: a linear programme over contact forces.

It shares nothing with `kaidan.mechanics`: no triangle, no lowest or highest contact, no count n,
no case distinction between slipping and tipping. Nosings lie on a line; those under the flat
touch it; each can push anywhere within its friction cone; Newton's equations hold without
rotation; the acceleration is a variable of the programme, made as large and as small as it goes.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog
from scipy.sparse import csr_array

SLACK_COST = 1e6
"""Cost of one newton metre (at unit weight) of moment out of nowhere. An exact penalty as long as
it beats the multiplier of the moment equation, |da/dm| <= 1/C_N, here at most 1e3."""


@dataclass(frozen=True)
class Pose:
    """A robot on a flight, in the words of the world instead of the paper's."""

    nosings: NDArray[np.float64]
    """Positions of all nosings along their line, uphill positive [m]."""
    tips: tuple[float, float]
    """Downhill and uphill end of the flat underside along that line [m]."""
    com: tuple[float, float]
    """Centroid along that line and normal to it [m]."""
    slope: float
    """Slope of the line [rad]."""
    friction: float
    """Friction at every nosing [1]."""

    def touching(self) -> NDArray[np.float64]:
        """Nosings under the flat: met at the uphill tip, already left at the downhill tip."""
        downhill, uphill = self.tips
        return self.nosings[(downhill < self.nosings) & (self.nosings <= uphill)]


def extreme_accelerations(poses: list[Pose], sense: float) -> NDArray[np.float64]:
    """Largest (sense = 1) or smallest (-1) acceleration up the stairs of every pose, in g.

    One block a pose: a force at contact k is ``l_k (mu, 1) + r_k (-mu, 1)``, l_k, r_k >= 0, the
    rays of its cone in (uphill, normal) coordinates. Weight 1, gravity 1. Rows: forces along,
    forces normal, moments about the centroid (where weight and inertia have none). NaN where no
    acceleration at all is in reach without a moment out of nowhere.
    """
    rows, columns, values, cost, target, at = [], [], [], [], [], []
    column = 0
    for block, pose in enumerate(poses):
        along, normal, moment = 3 * block, 3 * block + 1, 3 * block + 2
        for side in (pose.friction, -pose.friction):
            for nosing in pose.touching():
                arm_along, arm_normal = nosing - pose.com[0], -pose.com[1]
                rows += [along, normal, moment]
                columns += [column] * 3
                values += [side, 1.0, arm_along * 1.0 - arm_normal * side]
                cost.append(0.0)
                column += 1
        for sign in (1.0, -1.0):
            rows.append(moment)
            columns.append(column)
            values.append(sign)
            cost.append(SLACK_COST)
            column += 1
        rows.append(along)  # sum of forces along = sin(slope) + a
        columns.append(column)
        values.append(-1.0)
        cost.append(-sense)
        at.append(column)
        column += 1
        target += [np.sin(pose.slope), np.cos(pose.slope), 0.0]
    bounds = np.zeros((column, 2))
    bounds[:, 1] = np.inf
    bounds[at, 0] = -np.inf
    result = linprog(
        cost,
        A_eq=csr_array((values, (rows, columns)), shape=(3 * len(poses), column)),
        b_eq=target,
        bounds=bounds,
        method="highs-ds",
    )
    assert result.success, result.message
    slack = np.array([result.x[j - 2] + result.x[j - 1] for j in at])
    return np.where(slack > 1e-9, np.nan, result.x[at])
