"""Which way is up, and how surely: floors and treads are level, risers and walls are plumb."""

import math

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.patches import Patches
from kaidan.readers.stairfit.planes import leans

OUT_OF_TRUE = math.radians(0.3)
"""Standard deviation of what was built level or plumb [rad]: 16 mm over 3 m."""
NEAR = 10.0
"""Angle within which a patch counts as level or plumb at first [deg]."""
NARROWEST = math.radians(0.7)
"""Smallest such angle [rad]."""
EDGES = math.radians(0.35)
"""By how much patches over edges turn the mean, root mean square in clouds that were cast [rad]."""
BEST = math.radians(0.1)
"""Standard uncertainty of a plane's lean at best [rad]."""
FEWEST_PATCHES = 12
"""Level and plumb patches from which up is estimated."""


def refined(patches: Patches, up: Array, sigma: float) -> tuple[Array, float]:
    """Direction up, and its standard uncertainty.

    Minimises the squares of the sines between level patches and up and of the cosines between
    plumb patches and up: the eigenvector to the least eigenvalue of the plumb ones' scatter matrix
    less the level ones'. Large planes put it right, and what the sensor states has its weight too.

    Parameters
    ----------
    patches : Patches
        Of the cloud.
    up : array, shape (3,)
        Direction that is up as stated.
    sigma : float
        Standard uncertainty of it [rad].

    Returns
    -------
    up, sigma
        Unit vector, and its standard uncertainty [rad].
    """
    stated = up
    normal, weight = patches.normal, patches.weight
    near, off = math.radians(NEAR), np.zeros(0)
    for _ in range(6):
        along = normal @ up
        level, plumb = np.abs(along) > math.cos(near), np.abs(along) < math.sin(near)
        if level.sum() + plumb.sum() < FEWEST_PATCHES:
            return stated, sigma
        scatter = (normal * (weight * (plumb * 1.0 - level))[:, None]).T @ normal
        up = np.linalg.eigh(scatter)[1][:, 0]
        up = up * np.sign(up @ stated)
        along = np.abs(normal @ up)
        tilt = np.where(level, np.sqrt(np.maximum(1 - along**2, 0.0)), along)
        off = tilt[level | plumb]
        # patches over the edge of a step lean all the same way: only the core counts
        near = min(max(3.0 * float(np.median(off)), NARROWEST), 0.7 * near)
    scatter_of = float(np.sqrt(np.mean(off**2)) / math.sqrt(max(len(off) / 8.0, 1.0)))
    up, found = _by_planes(patches, up, math.hypot(scatter_of, EDGES))
    found = math.hypot(found, OUT_OF_TRUE)
    if math.acos(min(1.0, float(up @ stated))) > 3 * math.hypot(sigma, found):
        return up, found  # what was stated contradicts what was built
    share = found**2 / (found**2 + sigma**2)
    mixed = up + share * (stated - up)
    return mixed / np.linalg.norm(mixed), math.sqrt(share) * sigma


def _by_planes(patches: Patches, up: Array, sigma: float) -> tuple[Array, float]:
    """Direction up and its doubt, with what large planes say of it (weighted least squares)."""
    weights, pulled = np.eye(3) / sigma**2, np.zeros(3)
    planes = leans(patches, up, math.radians(NEAR))
    for lean in planes:
        weight = 1.0 / (lean.sigma**2 + BEST**2)
        weights += weight * np.outer(lean.along, lean.along)
        pulled += weight * lean.angle * lean.along
    covariance = np.linalg.inv(weights)
    level = np.eye(3) - np.outer(up, up)
    moved = covariance @ pulled
    doubt = float(np.linalg.eigvalsh(level @ covariance @ level)[-1])
    # where planes and patches contradict each other, the doubt grows by it (Birge 1932)
    chi2 = float(moved @ moved) / sigma**2 + sum(
        (lean.angle - float(moved @ lean.along)) ** 2 / (lean.sigma**2 + BEST**2) for lean in planes
    )
    found = up + moved
    grown = math.sqrt(max(chi2 / max(len(planes), 1), 1.0))
    return found / np.linalg.norm(found), math.sqrt(doubt) * grown


def frame(up: Array, side: Array) -> Array:
    """Rotation, shape (3, 3), to a frame with z along `up` and x as near to `side` as can be."""
    x = side - (side @ up) * up
    x = x / np.linalg.norm(x)
    return np.array([x, np.cross(up, x), up])
