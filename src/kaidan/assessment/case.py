"""One robot, one staircase, one way of going: everything a model needs to judge it."""

import math
from collections.abc import Iterator
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
BEYOND = 10
"""Least number of samples beyond the risk asked for: a small risk takes more samples."""
BLOCK = 1 << 18
"""Samples times steps that are judged at once."""


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
    """Terrain of its own, for the contact model; `stairs` then holds the steps found in it."""
    steps_known: bool = True
    """False for a terrain without such steps: `stairs` then lends its name only."""
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

    @property
    def rolling_resistance(self) -> float:
        """Coefficient of rolling resistance as the formulas count it: it works against motion."""
        resistance = self.robot.drive.rolling_resistance
        return resistance if self.direction == "up" else -resistance

    @property
    def spread(self) -> tuple[float, ...]:
        """Standard uncertainties of L, C_L, C_N, angle, nosing spacing and friction."""
        of_robot, of_stairs = self.robot.uncertainty, self.stairs.uncertainty
        return (
            of_robot.flat_length,
            of_robot.com_from_front,
            of_robot.com_height,
            of_stairs.angle,
            of_stairs.nosing_spacing,
            self.surface.friction_uncertainty if self.surface else 0.0,
        )

    @property
    def uncertain(self) -> bool:
        """Whether any input has an uncertainty."""
        return any(self.spread)

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


def nominal(case: Case, stance: Stance) -> Draws:
    """Inputs of the formulas, one row: the sheets' figures.

    Of the steps only those count that may be the worst in some way.
    """
    theta_s, p = _decisive(list(dict.fromkeys(case.stairs.regular_steps)))
    L, C_L = stance.flat_length, stance.com_from_front
    surface = case.surface
    return Draws(
        L=np.full((1, 1), L),
        C_L=np.full((1, 1), C_L if case.nose_up else L - C_L),
        C_N=np.full((1, 1), stance.com_height),
        theta_s=theta_s[None],
        p=p[None],
        mu_low=np.full((1, 1), surface.friction_low if surface else np.nan),
        mu_high=np.full((1, 1), surface.friction_high if surface else np.nan),
    )


def draws(case: Case, at: Draws) -> Iterator[Draws]:
    """Inputs of the formulas with their uncertainty, about the sheets' figures `at`.

    Each uncertain quantity is normal about its value, stratified (Latin hypercube) with a fixed
    seed, so that the same question always has the same answer. The same samples for all steps,
    which come in blocks that fit into memory; one block of one row if all is certain.
    """
    if not case.uncertain:
        yield at
        return
    spread = case.spread
    count = sample_count(case)
    L, C_L, C_N, d_theta, d_p, d_mu = (
        unit_draws(count)[:, :, None] * np.array(spread)[:, None, None]
    )
    together = max(1, BLOCK // count)
    for first in range(0, at.p.shape[1], together):
        steps = slice(first, first + together)
        yield Draws(
            L=at.L + L,
            C_L=at.C_L + (C_L if case.nose_up else L - C_L),
            C_N=np.maximum(at.C_N + C_N, 1e-4),
            theta_s=np.clip(at.theta_s[:, steps] + d_theta, 0.0, 1.57),
            p=np.maximum(at.p[:, steps] + d_p, 1e-3),
            mu_low=np.maximum(at.mu_low + d_mu, 0.0),
            mu_high=np.maximum(at.mu_high + d_mu, 0.0),
        )


def sample_count(case: Case) -> int:
    """Samples of the uncertain inputs that the risk asks for."""
    return max(SAMPLES, math.ceil(BEYOND / case.risk))


def _decisive(steps: list[tuple[float, float]]) -> tuple[Array, Array]:
    """Slope and nosing spacing of the steps that no other outdoes in every failure mode.

    Each mode gets worse with a longer spacing and, one way, with a steeper or a gentler slope.
    So a step counts if no other is both as long and as steep, or both as long and as gentle.
    """
    rise, going = np.array(steps).T
    theta_s, p = np.arctan2(rise, going), np.hypot(rise, going)
    if len(steps) == 1:
        return theta_s, p
    counts = np.zeros(len(steps), dtype=bool)
    for steepness in (theta_s, -theta_s):
        order = np.lexsort((-p, -steepness))
        longest = np.concatenate([[-np.inf], np.maximum.accumulate(p[order])[:-1]])
        counts[order[p[order] > longest]] = True
    return theta_s[counts], p[counts]


@cache
def unit_draws(count: int) -> Array:
    """Latin hypercube of six independent standard normals, shape (6, count)."""
    from statistics import NormalDist

    strata = (np.arange(count) + 0.5) / count
    normal = np.array([NormalDist().inv_cdf(float(q)) for q in strata])
    shuffle = np.random.default_rng(2016)
    return np.stack([shuffle.permutation(normal) for _ in range(6)])
