"""An independent judge of grousers: rigid teeth at rest on rounded steps, and their contact forces.

It shares nothing with `kaidan.mechanics` or `kaidan.traversal`: no standing tip, no share of the
load, no pairs. A straight belt with rectangular teeth is a polygon, a flight of steps with round
nosings another. For a place of the belt along the flight the robot is let down until corners meet
edges on either side of its centroid: its contacts. Their normals are those of the edges, and a
linear programme (of feasibility: least squares without negative forces) asks whether forces within
the friction cones balance the weight. Where none do, it slides on down, a millimetre at a time.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import nnls

ARC = 12
"""Edges of a round nosing."""
TOUCH = 3e-5
"""Gap up to which a corner touches [m]: what is left of the inclination's search is 1e-5."""


@dataclass(frozen=True)
class Teeth:
    """A belt with rectangular teeth."""

    L: float
    C_L: float
    C_N: float
    height: float
    spacing: float
    width: float

    def corners(self, phase: float) -> np.ndarray:
        """Corners of the underside from the rear to the front end [m], about the belt's point
        under the centroid."""
        front, rear = self.C_L, self.C_L - self.L
        points = [(rear, 0.0)]
        if self.height > 0.0:
            first = rear + phase * self.spacing
            for x in np.arange(first, front - self.width, self.spacing):
                points += [(x, 0.0), (x, -self.height), (x + self.width, -self.height)]
                points += [(x + self.width, 0.0)]
        points.append((front, 0.0))
        return np.array(points)


@dataclass(frozen=True)
class Steps:
    """A long flight of steps; the nosings' line passes the origin."""

    angle: float
    spacing: float
    radius: float
    count: int = 16

    @cached_property
    def corners(self) -> np.ndarray:
        """Corners from bottom to top [m]."""
        rise, going = self.spacing * np.sin(self.angle), self.spacing * np.cos(self.angle)
        turns = np.linspace(0.0, np.pi / 2, ARC + 1) if self.radius > 0 else np.array([0.0])
        points = []
        for k in range(-self.count // 2, self.count // 2):
            x, z = k * going, k * rise
            points.append((x, z - rise))
            r = self.radius
            points += [(x + r - r * np.cos(t), z - r + r * np.sin(t)) for t in turns]
        return np.array(points)


def gaps(teeth: np.ndarray, ground: np.ndarray, phi: float, x: float):
    """Vertical gaps of a robot whose belt is at (x, 0): corners over steps, steps under edges.

    The belt's point under the centroid keeps its place along the flight, whatever the inclination:
    as a grouser leaves its nosing the robot turns about its other contact, at the belt.

    Returns
    -------
    corners of the underside from that point (m, 2), gaps (m,), numbers of the steps' corners
    below it, their gaps to each edge (m - 1, k), infinite where they do not lie below it
    """
    turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    body = teeth @ turn.T
    a_x, a_z = body[:, 0] + x, body[:, 1]
    ordered = ground[:, 0] + 1e-12 * np.arange(len(ground))
    over = a_z - np.interp(a_x, ordered, ground[:, 1])
    below = np.flatnonzero((ground[:, 0] > a_x.min()) & (ground[:, 0] < a_x.max()))
    b, e = a_x[:-1, None], a_x[1:, None]
    at = ground[below, 0]
    inside = (at >= np.minimum(b, e)) & (at <= np.maximum(b, e)) & (b != e)
    share = (at - b) / np.where(b == e, 1.0, e - b)
    z = a_z[:-1, None] + share * (a_z[1:] - a_z[:-1])[:, None]
    return body, over, below, np.where(inside, z - ground[below, 1], np.inf)


def rest(teeth: np.ndarray, height: float, steps: Steps, x: float):
    """Inclination at which contacts lie on either side of a centroid so high above the belt."""
    ground = steps.corners
    low, high = steps.angle - 0.08, steps.angle + 0.08
    for _ in range(22):
        middle = 0.5 * (low + high)
        body, over, below, under = gaps(teeth, ground, middle, x)
        k = int(np.argmin(over))
        arm = body[k, 0]
        if len(below) and under.min() < over[k]:
            arm = ground[below[int(np.argmin(under.min(axis=0)))], 0] - x
        low, high = (middle, high) if arm > -height * np.sin(middle) else (low, middle)
    return 0.5 * (low + high)


def contacts(teeth: np.ndarray, above: float, steps: Steps, x: float):
    """Points from the centroid, so far above the belt, and unit normals into the robot, at rest."""
    ground, phi = steps.corners, rest(teeth, above, steps, x)
    centroid = above * np.array([-np.sin(phi), np.cos(phi)])
    body, over, below, under = gaps(teeth, ground, phi, x)
    height = -min(over.min(), under.min())
    ahead = np.array([np.cos(phi), np.sin(phi)])
    found = []
    for k in np.flatnonzero(over + height < TOUCH):
        point = body[k]  # from the belt's point
        edge = int(np.searchsorted(ground[:, 0], x + point[0], side="right"))
        along = ground[edge] - ground[edge - 1]
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)
        found.append((point - centroid, normal))
    corner = ground[below]
    for edge, k in np.argwhere(under + height < TOUCH):
        along = body[edge + 1] - body[edge]
        if abs(along @ ahead) < 1e-9:
            continue  # the flank of a tooth, upright on the belt: its foot is met as a corner
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)
        found.append((corner[k] - [x, height] - centroid, normal))
    return found


def holds(found, friction: float) -> bool:
    """Whether forces within the cones balance the weight."""
    columns = []
    for (p_x, p_z), (n_x, n_z) in found:
        for side in (friction, -friction):
            f_x, f_z = n_x + side * n_z, n_z - side * n_x
            columns.append((f_x, f_z, p_x * f_z - p_z * f_x))
    _, rest_force = nnls(np.array(columns).T, np.array([0.0, 1.0, 0.0]))
    return bool(rest_force < 1e-3)


def slip(
    robot: Teeth, steps: Steps, phase: float, x: float, friction: float, *, most: float = 3.0,
    grid: float = 1e-3,
) -> float:  # fmt: skip
    """How far the robot slides down from a place until it holds [m]; infinite: for good.

    Parameters
    ----------
    phase
        Of the belt, in spacings.
    x
        Centroid along [m].
    most
        Spacings after which it is given up.
    """
    teeth = robot.corners(phase)
    reach = most * robot.spacing
    start = x + robot.C_N * np.sin(steps.angle)
    for down in np.arange(0.0, reach, grid):
        at = start - down * np.cos(steps.angle)
        if holds(contacts(teeth, robot.C_N, steps, at), friction):
            return float(down)
    return float("inf")
