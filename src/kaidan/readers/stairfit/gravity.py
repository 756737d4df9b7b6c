"""Which way is up, and how surely: floors and treads are level, risers and walls are plumb."""

import math
from dataclasses import dataclass

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.patches import Patches
from kaidan.readers.stairfit.planes import leans
from kaidan.readers.stairfit.quantiles import median

OUT_OF_TRUE = math.radians(0.3)
"""Standard deviation of what was built level or plumb [rad]: 16 mm over 3 m."""
NEAR = 10.0
"""Angle within which a patch counts as level or plumb at first [deg]."""
NARROWEST = math.radians(0.7)
"""Smallest such angle [rad]."""
EDGES = math.radians(0.35)
"""By how much patches over edges turn the mean, root mean square in clouds that were cast [rad]."""
BEST = math.radians(0.02)
"""Standard uncertainty of a plane's lean at best [rad]."""
FEWEST_PATCHES = 12
"""Level and plumb patches from which up is estimated."""


@dataclass(frozen=True, eq=False)
class Upward:
    """Which way is up, and how what was built stands to it."""

    up: Array
    """Unit vector, shape (3,)."""
    sigma: float
    """Its standard uncertainty [rad]."""
    built: Array
    """Up of what was built level and plumb, be that out of true or not, shape (3,)."""
    against: Array
    """Covariance of that one's angles, shape (3, 3) [rad^2]."""


def refined(
    patches: Patches, up: Array, sigma: float, *, eye: Array | None, local: float
) -> Upward:
    """Direction up, by what was built and by what is stated.

    Minimises the squares of the sines between level patches and up and of the cosines between
    plumb patches and up: the eigenvector to the least eigenvalue of the plumb ones' scatter matrix
    less the level ones'. Large planes put it right, and what the sensor states has its weight too.

    up, shape (3,): direction that is up as stated.
    sigma: standard uncertainty of it [rad].
    eye, shape (3,): the sensor [m]; None: not known.
    local: error of the range that differs from one direction to the next, as a share of it [1].
    """
    stated = up
    normal, weight = patches.normal, patches.weight
    near, off = math.radians(NEAR), np.zeros(0)
    for _ in range(6):
        along = normal @ up
        level, plumb = np.abs(along) > math.cos(near), np.abs(along) < math.sin(near)
        if level.sum() + plumb.sum() < FEWEST_PATCHES:
            return Upward(stated, sigma, stated, (sigma**2 + OUT_OF_TRUE**2) * np.eye(3))
        scatter = (normal * (weight * (plumb * 1.0 - level))[:, None]).T @ normal
        up = np.linalg.eigh(scatter)[1][:, 0]
        up = up * np.sign(up @ stated)
        along = np.abs(normal @ up)
        tilt = np.where(level, np.sqrt(np.maximum(1 - along**2, 0.0)), along)
        off = tilt[level | plumb]
        # patches over the edge of a step lean all the same way: only the core counts
        near = min(max(3.0 * median(off), NARROWEST), 0.7 * near)
    scatter_of = float(np.sqrt(np.mean(off**2)) / math.sqrt(max(len(off) / 8.0, 1.0)))
    up, against = _by_planes(patches, up, math.hypot(scatter_of, EDGES), eye, local)
    return _with_stated(up, against, stated, sigma)


def leant(
    upward: Upward, ahead: Array, angle: float, doubt: float, stated: Array, sigma: float
) -> Upward:
    """The same with what treads say: that up leans ahead by an angle, known to a doubt [rad].

    `ahead` is a level unit vector, shape (3,); `stated` and `sigma` are those of `refined`. Where
    both contradict each other by more than their doubts, the doubt grows by it (Birge 1932).
    """
    against = upward.against
    pull = against @ ahead
    variance = float(ahead @ pull) + doubt**2
    up = upward.built + pull * (angle / variance)
    grown = max(angle**2 / variance, 1.0)
    known = (against - np.outer(pull, pull) / variance) * grown
    return _with_stated(up / np.linalg.norm(up), known, stated, sigma)


def _with_stated(up: Array, against: Array, stated: Array, sigma: float) -> Upward:
    """What was built level and plumb, and what is stated, by their variances."""
    across = np.eye(3) - np.outer(up, up)
    doubt = float(np.linalg.eigvalsh(across @ against @ across)[-1])
    found = math.sqrt(doubt + OUT_OF_TRUE**2)
    if math.acos(min(1.0, float(up @ stated))) > 3 * math.hypot(sigma, found):
        return Upward(up, found, up, against)  # what was stated contradicts what was built
    share = found**2 / (found**2 + sigma**2)
    mixed = up + share * (stated - up)
    return Upward(mixed / np.linalg.norm(mixed), math.sqrt(share) * sigma, up, against)


def _by_planes(
    patches: Patches, up: Array, sigma: float, eye: Array | None, local: float
) -> tuple[Array, Array]:
    """Direction up and its covariance, with what large planes say (weighted least squares)."""
    weights, pulled = np.eye(3) / sigma**2, np.zeros(3)
    planes = leans(patches, up, math.radians(NEAR), eye=eye, local=local)
    for lean in planes:
        weight = 1.0 / (lean.sigma**2 + BEST**2)
        weights += weight * np.outer(lean.along, lean.along)
        pulled += weight * lean.angle * lean.along
    covariance = np.linalg.inv(weights)
    moved = covariance @ pulled
    # where planes and patches contradict each other, the doubt grows by it (Birge 1932)
    chi2 = float(moved @ moved) / sigma**2 + sum(
        (lean.angle - float(moved @ lean.along)) ** 2 / (lean.sigma**2 + BEST**2) for lean in planes
    )
    found = up + moved
    grown = max(chi2 / max(len(planes), 1), 1.0)
    return found / np.linalg.norm(found), np.asarray(covariance * grown)


def frame(up: Array, side: Array) -> Array:
    """Rotation, shape (3, 3), to a frame with z along `up` and x as near to `side` as can be."""
    x = side - (side @ up) * up
    x = x / np.linalg.norm(x)
    return np.array([x, np.cross(up, x), up])
