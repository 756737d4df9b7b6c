"""Shapes of a robot seen from its left side, as discs: x forward, z up; a corner has no radius."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from kaidan.readers.robots.mechanism import Array, Placed, Shape

_CORNERS = np.array(list(product((-0.5, 0.5), repeat=3)))
_AROUND = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
_RIM = np.column_stack([np.cos(_AROUND), np.sin(_AROUND), np.zeros_like(_AROUND)])
_ACROSS = np.cos(np.radians(2.0))
"""A cylinder whose axis lies within 2 degrees of the lateral one is seen as a disc."""


@dataclass(frozen=True, eq=False)
class Piece:
    """One shape of a link, from the side."""

    link: str
    shape: Shape
    discs: Array
    """x, z, radius, shape (n, 3) [m]."""
    left: float
    """How far to the left it reaches [m]."""
    right: float
    """Where it begins on the right, to the left positive [m]."""

    @property
    def is_wheel(self) -> bool:
        """Whether it is round about the lateral axis."""
        return self.shape.kind in ("cylinder", "sphere") and len(self.discs) == 1

    @property
    def middle(self) -> float:
        """To the left [m]."""
        return (self.left + self.right) / 2

    @property
    def length(self) -> float:
        """Along x [m]."""
        x, _, r = self.discs.T
        return float((x + r).max() - (x - r).min())

    @property
    def lowest(self) -> float:
        """[m]."""
        _, z, r = self.discs.T
        return float((z - r).min())


def pieces_of(placed: Placed, links: Iterable[str]) -> tuple[Piece, ...]:
    """Pieces of links, of those that collide; of a link without any, of those that are seen."""
    found = []
    for name in links:
        shapes = placed.mechanism.links[name].shapes
        solid = [shape for shape in shapes if shape.collides]
        for shape in solid or shapes:
            if shape.kind != "mesh":
                found.append(_piece(name, shape, placed.frames[name] @ shape.place))
    return tuple(found)


def discs_of(pieces: Sequence[Piece]) -> Array:
    """All discs of pieces, shape (n, 3)."""
    return np.concatenate([piece.discs for piece in pieces]) if pieces else np.zeros((0, 3))


def _piece(link: str, shape: Shape, place: Array) -> Piece:
    points, radius = _points(shape, place)
    y = points[:, 1]
    half = radius
    if shape.kind == "cylinder" and len(points) == 1:
        half = shape.size[1] / 2
    discs = np.column_stack([points[:, 0], points[:, 2], np.full(len(points), radius)])
    return Piece(link, shape, discs, float(y.max() + half), float(y.min() - half))


def _points(shape: Shape, place: Array) -> tuple[Array, float]:
    """Points and the radius about them that make up a shape seen from the side."""
    turned, at, size = place[:3, :3], place[:3, 3], np.array(shape.size)
    if shape.kind == "box":
        return at + (_CORNERS * size) @ turned.T, 0.0
    if shape.kind == "sphere":
        return at[None, :], float(size[0])
    if shape.kind == "ellipsoid":  # the farthest point in each direction of the plane
        ways = np.column_stack([np.cos(_AROUND), np.zeros_like(_AROUND), np.sin(_AROUND)])
        local = ways @ turned * size
        far = local / np.maximum(np.linalg.norm(local, axis=1), 1e-12)[:, None] * size
        sides = size * np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]])
        return at + np.concatenate([far, sides]) @ turned.T, 0.0
    radius, length = float(size[0]), float(size[1])
    ends = np.array([[0.0, 0.0, -length / 2], [0.0, 0.0, length / 2]])
    if shape.kind == "capsule":
        return at + ends @ turned.T, radius
    if abs(turned[1, 2]) > _ACROSS:
        return at[None, :], radius
    rims = np.concatenate([_RIM * radius + end for end in ends])
    return at + rims @ turned.T, 0.0
