"""Floors, landings and walls among the patches: how far each says that up leans, and how surely.

A patch of 0.1 m has a normal that noise turns by degrees, and those over the edges of steps lean
all to the same side. The middles of many patches over a metre say it to hundredths of a degree.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.doubts import ALIKE_WITHIN
from kaidan.readers.stairfit.patches import Patches, directions
from kaidan.readers.stairfit.quantiles import median

LAYER, THINNEST = 0.06, 0.008
"""Thickness of the layer in which a plane is sought, and the distance up to which a patch is always
on it [m]."""
FEWEST, AVERAGED = 12, 20
"""Patches of a plane, and those over which their scatter averages out: more of them say no more."""
LEAST = 0.15
"""Least spread of a plane's patches, root mean square, where it may tilt [m]:
those of a tread and a riser are shorter."""
AWAY = 1.2
"""Distance of a plane from a sensor of which nobody says where it stood [m]."""
ALIKE = math.radians(1.5)
"""Angle between a plane and its patches from which it is a chance [rad]."""
SHARE = 0.15
"""Least share of the level patches, or of the plumb ones, that lie on a plane [1]: what few of them
have in common is chance."""
MOST = 3
"""Planes of each sort."""


@dataclass(frozen=True, eq=False)
class Lean:
    """Up leans by an angle along a level direction, as a plane has it."""

    along: Array
    """Unit vector, shape (3,)."""
    angle: float
    """[rad]"""
    sigma: float
    """Its standard uncertainty [rad]."""


def leans(
    patches: Patches, up: Array, near: float, *, eye: Array | None, local: float
) -> list[Lean]:
    """What large planes say of a direction up.

    up, shape (3,): unit vector, true within a few degrees.
    near: angle within which a patch counts as level or plumb [rad].
    eye, shape (3,): the sensor [m]; None: not known.
    local: error of the range that differs from one direction to the next, as a share of it [1].
    """
    centre = patches.middle.mean(axis=0)
    middle = patches.middle - centre
    sensor = None if eye is None else eye - centre
    along_up = patches.normal @ up
    side = np.eye(3)[int(np.argmin(np.abs(up)))]
    first = np.cross(up, side) / np.linalg.norm(np.cross(up, side))
    across = np.array([first, np.cross(up, first)])
    found: list[Lean] = []
    left = np.flatnonzero(np.abs(along_up) > math.cos(near))
    least = SHARE * float(patches.weight[left].sum())
    for _ in range(MOST):
        if len(left) < FEWEST or patches.weight[left].sum() <= least:
            break
        plane = _plane(patches, left, middle, up, across)
        left = left[~plane.taken]
        if plane.sound and plane.weight > least:
            spread, ways = np.linalg.eigh(plane.spread)
            for variance, way in zip(spread, ways.T, strict=True):
                if variance > LEAST**2:
                    sigma = plane.doubt(float(variance), way @ across, up, sensor, local)
                    found.append(Lean(way @ across, -float(way @ plane.slopes), sigma))
    left = np.flatnonzero(np.abs(along_up) < math.sin(near))
    least = SHARE * float(patches.weight[left].sum())
    for _ in range(MOST):
        if len(left) < FEWEST or patches.weight[left].sum() <= least:
            break
        here = Patches(
            patches.middle[left], patches.normal[left] - np.outer(along_up[left], up),
            patches.weight[left], patches.thickness[left], left,
        )  # fmt: skip
        (ahead, *_) = [*directions(here, 1), first]
        ahead = ahead - (ahead @ up) * up
        length = float(np.linalg.norm(ahead))
        if length < 0.5:  # patches that look every way have no direction
            break
        ahead = ahead / length
        looks = left[np.abs(patches.normal[left] @ ahead) > math.cos(math.radians(7.0))]
        if len(looks) < FEWEST:
            break
        plane = _plane(patches, looks, middle, ahead, np.array([np.cross(up, ahead), up]))
        left = np.setdiff1d(left, looks[plane.taken])
        spread = np.linalg.det(plane.spread) / max(plane.spread[0, 0], 1e-9)
        if plane.sound and plane.weight > least and spread > LEAST**2:
            sigma = plane.doubt(float(spread), up, ahead, sensor, local)
            found.append(Lean(ahead, float(plane.slopes[1]), sigma))
    return found


@dataclass(frozen=True, eq=False)
class _Plane:
    taken: NDArray[np.bool_]
    """Patches that lie on it or where it was sought."""
    slopes: Array
    """Rise of it along each of both directions, shape (2,)."""
    spread: Array
    """Covariance of the places of its patches, shape (2, 2) [m^2]."""
    middle: Array
    """Of its patches, shape (3,) [m]."""
    scatter: float
    """Of its patches [m]."""
    count: int
    """How many lie on it."""
    weight: float
    """Of the patches that lie on it."""
    sound: bool
    """Whether it is one: patches enough, which look where it looks."""

    def doubt(
        self, variance: float, way: Array, normal: Array, eye: Array | None, local: float
    ) -> float:
        """Standard uncertainty of its slope along a direction, in which it has a variance [rad].

        What the patches scatter averages out. The range errs by a smooth function of the direction,
        which has the length L on the plane. With normal weights of the variance e^2 a slope fitted
        to it has the variance (k - k^3) / (2 e^2), where k = 1 / sqrt(1 + 4 e^2 / L^2).
        """
        ray = AWAY * normal if eye is None else self.middle - eye
        distance = max(float(np.linalg.norm(ray)), 1e-6)
        sideways = math.sqrt(max(1.0 - float(ray @ way / distance) ** 2, 1e-6))
        length = ALIKE_WITHIN * distance / sideways
        k = 1.0 / math.sqrt(1.0 + 4.0 * variance / length**2)
        smooth = (local * float(ray @ normal)) ** 2 * (k - k**3) / 2.0
        return math.sqrt((self.scatter**2 / min(self.count, AVERAGED) + smooth) / variance)


def _plane(patches: Patches, rows: Indices, middle: Array, normal: Array, across: Array) -> _Plane:
    """Plane through the layer with the most patches, and through all that lie on it."""
    weight, height = patches.weight[rows], middle[rows] @ normal
    columns = np.column_stack([np.ones(len(rows)), middle[rows] @ across.T])
    layer = np.floor((height - height.min()) / LAYER).astype(np.int64)
    count = np.bincount(layer, weights=weight)
    best = int(np.argmax(count + np.r_[count[1:], 0.0]))
    core = on = (layer == best) | (layer == best + 1)
    fit, scatter = np.zeros(3), LAYER
    for turn in range(8):
        if on.sum() < FEWEST:
            break
        weighted = columns.T * (weight * on)
        fit = np.linalg.solve(weighted @ columns + 1e-9 * np.eye(3), weighted @ height)
        off = np.abs(height - columns @ fit)
        scatter = 1.5 * median(off[on])
        before, on = on, off < (max(2.7 * scatter, THINNEST) if turn > 2 else LAYER)
        if turn > 2 and (on == before).all():
            break
    places = columns[on, 1:]
    if len(places) < FEWEST:
        nowhere = np.zeros((2, 2)), np.zeros(3)
        return _Plane(core | on, fit[1:], *nowhere, scatter, len(places), 0.0, False)
    spread = np.cov(places, rowvar=False, bias=True)
    own = normal - fit[1:] @ across
    looks = patches.normal[rows[on]]
    looks = (looks * (np.sign(looks @ normal) * weight[on])[:, None]).sum(axis=0)
    alike = float(own @ looks / (np.linalg.norm(own) * np.linalg.norm(looks)))
    sound = alike > math.cos(ALIKE)
    own_weight = float(weight[on].sum())
    centre = middle[rows[on]].mean(axis=0)
    return _Plane(core | on, fit[1:], spread, centre, scatter, len(places), own_weight, sound)
