"""One robot, one staircase, one way of going: everything a model needs to judge it."""

from functools import cache
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment.allowance import Allowance
from kaidan.profile import Profile
from kaidan.robot import Drive, Payload, Posture, Robot, Stance
from kaidan.stairs import Stairs
from kaidan.surface import Surface

Direction = Literal["up", "down"]
Facing = Literal["nose-first", "tail-first"]
Array = NDArray[np.float64]

SAMPLES = 2048
"""Latin hypercube samples of the uncertain inputs: 20 lie beyond a risk of 1 %."""


class Case(NamedTuple):
    """Question to a model; build one with `kaidan.assess`."""

    robot: Robot
    stairs: Stairs
    surface: Surface | None
    posture: Posture
    payload: tuple[Payload, ...]
    direction: Direction
    facing: Facing
    acceleration: float
    speed: float | None
    theta_d: Allowance
    theta_M: Allowance
    risk: float
    profile: Profile | None = None
    """Terrain of its own, for the contact model; then `stairs` lends its name only."""
    yaw: float = 0.0
    """Heading off the line of steepest ascent [rad], to the left positive."""

    @property
    def nose_up(self) -> bool:
        """Whether the nose points up the stairs."""
        return (self.direction == "up") == (self.facing == "nose-first")

    @property
    def stance(self) -> Stance:
        """Robot in its posture under its payload."""
        return self.robot.stance(self.posture, self.payload)

    @property
    def drive(self) -> Drive:
        """Limits of the drive."""
        return self.robot.drive

    def changed(self, **changes: object) -> "Case":
        """Same question with something changed."""
        return self._replace(**changes)  # type: ignore[arg-type]


class Draws(NamedTuple):
    """Inputs of the formulas; axes: sample, step of the flight."""

    L: Array
    C_L: Array
    """Centroid behind the UPHILL end of the flat [m]."""
    C_N: Array
    theta_s: Array
    p: Array
    mu_low: Array
    """NaN where friction is unknown."""
    mu_high: Array


def draws(case: Case, stance: Stance, *, certain: bool = False) -> Draws:
    """Inputs of the formulas for a case: one row if all is `certain`, else `SAMPLES` rows.

    Each uncertain quantity is normal about its value, stratified (Latin hypercube) with a fixed
    seed, so that the same question always has the same answer.
    """
    steps = np.array(list(dict.fromkeys(case.stairs.regular_steps)))
    theta_s, p = np.arctan2(steps[:, 0], steps[:, 1]), np.hypot(steps[:, 0], steps[:, 1])
    surface, spread = case.surface, standard_uncertainties(case)
    if spread.any() and not certain:
        L, C_L, C_N, d_theta, d_p, d_mu = unit_draws()[:, :, None] * spread[:, None, None]
    else:
        L = C_L = C_N = d_theta = d_p = d_mu = np.zeros((1, 1))
    L = stance.flat_length + L
    C_L = stance.com_from_front + C_L
    return Draws(
        L=L,
        C_L=C_L if case.nose_up else L - C_L,
        C_N=np.maximum(stance.com_height + C_N, 1e-4),
        theta_s=np.clip(theta_s + d_theta, 0.0, 1.57),
        p=np.maximum(p + d_p, 1e-3),
        mu_low=np.maximum(surface.friction_low + d_mu, 0.0) if surface else d_mu + np.nan,
        mu_high=np.maximum(surface.friction_high + d_mu, 0.0) if surface else d_mu + np.nan,
    )


def standard_uncertainties(case: Case) -> Array:
    """Of L, C_L, C_N, the angle, the nosing spacing and the friction, in the order of the draws."""
    of_robot, of_stairs = case.robot.uncertainty, case.stairs.uncertainty
    return np.array(
        [
            of_robot.flat_length,
            of_robot.com_from_front,
            of_robot.com_height,
            of_stairs.angle,
            of_stairs.nosing_spacing,
            case.surface.friction_uncertainty if case.surface else 0.0,
        ]
    )


@cache
def unit_draws() -> Array:
    """Latin hypercube of six independent standard normals, shape (6, SAMPLES)."""
    from statistics import NormalDist

    strata = (np.arange(SAMPLES) + 0.5) / SAMPLES
    normal = np.array([NormalDist().inv_cdf(float(q)) for q in strata])
    shuffle = np.random.default_rng(2016)
    return np.stack([shuffle.permutation(normal) for _ in range(6)])
