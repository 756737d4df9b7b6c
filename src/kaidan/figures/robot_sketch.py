"""A robot from the side as its sheet knows it: a flat between two round ends, and its centroid."""

import math
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from kaidan.figures import style as look

_END = np.linspace(0.0, math.pi, 60)


class Sketch(NamedTuple):
    """Lengths of the drawing [m]."""

    flat_length: float
    com_from_front: float
    com_height: float
    front_radius: float
    rear_radius: float


EXAMPLE = Sketch(0.60, 0.28, 0.15, 0.09, 0.09)
"""Proportions of a robot where nobody states any."""


class Placed(NamedTuple):
    """A sketch somewhere: its rear tip, and its inclination, nose up positive."""

    sketch: Sketch
    x: float = 0.0
    z: float = 0.0
    phi: float = 0.0

    def at(self, behind_front: float, above: float = 0.0) -> look.Array:
        """Point of the robot by its distance behind the front tip and above the underside."""
        forward = self.sketch.flat_length - behind_front
        c, s = math.cos(self.phi), math.sin(self.phi)
        return np.array([self.x + c * forward - s * above, self.z + s * forward + c * above])

    @property
    def normal(self) -> look.Array:
        """Direction away from the underside."""
        return np.array([-math.sin(self.phi), math.cos(self.phi)])

    def outline(self) -> look.Array:
        """Points around the robot."""
        L, _, _, front, rear = self.sketch
        low = [self.at(front * -math.sin(a), front * (1 - math.cos(a))) for a in _END]
        back = [self.at(L + rear * math.sin(a), rear * (1 + math.cos(a))) for a in _END]
        return np.array([*low, *back])


def draw_sketch(axes: Axes, placed: Placed, *, strong: bool = True) -> None:
    """Robot with its flat, the tips of it, and its centroid."""
    axes.add_patch(
        Polygon(
            placed.outline(),
            facecolor="#dcebf5" if strong else "none",
            edgecolor=look.BLACK,
            linewidth=1.0,
            zorder=3,
        )
    )
    sketch = placed.sketch
    tips = np.array([placed.at(0.0), placed.at(sketch.flat_length)])
    axes.plot(*tips.T, color=look.BLUE, linewidth=2.6, zorder=4)
    axes.plot(*tips.T, ls="", marker="o", ms=4, mfc="white", mec=look.BLUE, zorder=5)
    draw_centroid(axes, placed)


def draw_centroid(axes: Axes, placed: Placed) -> None:
    """Centroid as a ring with a dot."""
    com = placed.at(placed.sketch.com_from_front, placed.sketch.com_height)
    axes.plot(*com, ls="", marker="o", ms=7, mfc="white", mec=look.BLACK, zorder=8)
    axes.plot(*com, ls="", marker=".", ms=4, color=look.BLACK, zorder=8)
