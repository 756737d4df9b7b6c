"""Limits and areas of the d-a plane on one step: what lies between which curves."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Part
from kaidan.mechanics.margins import AccelerationBounds, acceleration_bounds
from kaidan.mechanics.plane import Area, area
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.models.closed_form_figures import Pose

Array = NDArray[np.float64]
Column = tuple[float | None, ...]
CELLS = 200
"""Cells of the progress in which the curves are given."""


class State(Part):
    """A state of the paper's Fig. 3."""

    state: Literal["A", "B", "C", "D"]
    from_m: float
    """Its start in the progress [m]."""
    to_m: float
    """Its end [m]."""
    contacts: int
    """Nosings that carry."""


class Stay(Part):
    """Stretch of the progress in which the requested acceleration lies in one area."""

    area: str
    """A to E, or DOWNHILL_SLIP."""
    from_m: float
    """Its start in the progress [m]."""
    to_m: float
    """Its end [m]."""


class Region(Part):
    """Part of an area of the plane: everything between two curves over the progress."""

    area: str
    """A to E, or DOWNHILL_SLIP."""
    d_m: tuple[float, ...]
    """Progress [m]."""
    low: Column
    """Lower curve [m/s^2]; null where nothing bounds it."""
    high: Column
    """Upper curve [m/s^2]; null where nothing bounds it."""


@dataclass(frozen=True)
class Limits:
    """Limits of acceleration on the governing step; progress [m], accelerations [m/s^2]."""

    pose: Pose
    d_C: float
    """Progress of state C."""
    d: Array
    a_r0: Array
    a_rn: Array
    a_S: float
    """Infinite where friction is not known; so is `a_slides_up`."""
    a_slides_up: float
    min_a_r0: float
    max_a_rn: float

    def area_at(self, d: float, a: float) -> Area:
        """Area in which a point of the plane lies."""
        pose = self.pose
        k = pose.n if d < self.d_C else pose.n - 1
        at: dict[str, Any] = {"theta_s": pose.theta_s, "C_L": pose.C_L, "C_N": pose.C_N}
        upper, lower = a_r0(s=d + k * pose.p, **at), a_rn(d=d, **at)
        throughout = {
            "a_S": self.a_S,
            "a_slides_up": self.a_slides_up,
            "min_a_r0": self.min_a_r0,
            "max_a_rn": self.max_a_rn,
        }
        return Area(int(area(a=a, a_r0=upper, a_rn=lower, **throughout)))

    def stays(self, a: float) -> tuple[Stay, ...]:
        """Areas through which one acceleration goes over the progress."""
        cuts = {0.0, self.d_C, self.pose.p}
        for curve in (self.a_r0, self.a_rn):
            cuts.update(d for _, d in self._crossings(curve, a))
        edges = sorted(cut for cut in cuts if 0 <= cut <= self.pose.p)
        found: list[Stay] = []
        for start, end in pairwise(edges):
            here = self.area_at((start + end) / 2, a).name
            if found and found[-1].area == here:
                start = found.pop().from_m
            found.append(Stay(area=here, from_m=start, to_m=end))
        return tuple(found)

    def regions(self) -> tuple[Region, ...]:
        """Areas of the plane as bands between curves, in the order A, B, C, sliding up, D, E."""
        levels = (self.a_S, self.a_slides_up)
        corners = [
            corner
            for curve in (self.a_r0, self.a_rn)
            for level in levels
            for corner in self._crossings(curve, level)
        ]
        after, places = [index + 1 for index, _ in corners], [d for _, d in corners]
        order = np.argsort(places)
        d, r0, rn = (
            np.insert(curve, np.array(after, dtype=int)[order], np.array(values)[order])
            for curve, values in (
                (self.d, places),
                (self.a_r0, [self._between(self.a_r0, *corner) for corner in corners]),
                (self.a_rn, [self._between(self.a_rn, *corner) for corner in corners]),
            )
        )
        slides_down, slides_up = (np.full_like(d, level) for level in levels)
        upper, lower = np.minimum(slides_down, r0), np.maximum(slides_up, rn)
        low, high = max(self.a_slides_up, self.max_a_rn), min(self.a_S, self.min_a_r0)
        below = np.minimum(rn, upper)
        parts = [(Area.B, upper, slides_down), (Area.C, np.full_like(d, -np.inf), below)]
        if math.isfinite(self.a_S):
            parts.insert(0, (Area.A, slides_down, np.full_like(d, np.inf)))
            parts.append((Area.DOWNHILL_SLIP, below, np.minimum(slides_up, upper)))
        if low < high:
            parts += [
                (Area.D, np.full_like(d, low), np.full_like(d, high)),
                (Area.E, lower, np.full_like(d, low)),
                (Area.E, np.full_like(d, high), upper),
            ]
        else:
            parts.append((Area.E, lower, upper))
        return tuple(
            Region(area=name.name, d_m=d.tolist(), low=foot, high=np.maximum(head, foot))
            for name, foot, head in parts
        )

    def states(self) -> tuple[State, ...]:
        """States A to D with the contacts that carry."""
        n, d_C, p = self.pose.n, self.d_C, self.pose.p
        first: list[Any] = [] if d_C == 0 else [("A", 0.0, 0.0, n + 1), ("B", 0.0, d_C, n + 1)]
        return tuple(
            State(state=name, from_m=start, to_m=end, contacts=contacts)
            for name, start, end, contacts in (*first, ("C", d_C, d_C, n), ("D", d_C, p, n))
        )

    def _crossings(self, curve: Array, level: float) -> list[tuple[int, float]]:
        """Where a curve crosses a level: index of the point before, and progress."""
        found = []
        for index in range(len(self.d) - 1):
            (x, y), (left, right) = self.d[index : index + 2], curve[index : index + 2]
            if x < y and (left - level) * (right - level) < 0:
                found.append((index, float(x + (y - x) * (level - left) / (right - left))))
        return found

    def _between(self, curve: Array, index: int, d: float) -> float:
        """Value of a curve between two points of the grid, where it is straight."""
        (x, y), (left, right) = self.d[index : index + 2], curve[index : index + 2]
        return float(left + (right - left) * (d - x) / (y - x))


def bounds_of(pose: Pose, mu_s: float) -> AccelerationBounds:
    """Bounds of the acceleration at a pose with this friction."""
    return acceleration_bounds(
        mu_s=mu_s, theta_s=pose.theta_s, L=pose.L, C_L=pose.C_L, C_N=pose.C_N, p=pose.p
    )


def limits_of(pose: Pose, mu_s: float) -> Limits:
    """Limits of acceleration at a pose; without a friction (NaN) no slipping bounds them."""
    bounds = bounds_of(pose, mu_s)
    d, s, d_C = progress_of(pose)
    at: dict[str, Any] = {"theta_s": pose.theta_s, "C_L": pose.C_L, "C_N": pose.C_N}
    known = not math.isnan(mu_s)
    return Limits(
        pose=pose,
        d_C=d_C,
        d=d,
        a_r0=a_r0(s=s, **at),
        a_rn=a_rn(d=d, **at),
        a_S=float(bounds.slides_down) if known else math.inf,
        a_slides_up=float(bounds.slides_up) if known else -math.inf,
        min_a_r0=float(bounds.tip_downhill),
        max_a_rn=float(bounds.tip_uphill),
    )


def progress_of(pose: Pose) -> tuple[Array, Array, float]:
    """Grid of the progress, the lowest contact behind the uphill end there, and d of state C."""
    d_C = min(max(pose.L - pose.n * pose.p, 0.0), pose.p)
    if d_C < 1e-9 * pose.p:
        d = np.linspace(0.0, pose.p, CELLS + 1)
        return d, d + (pose.n - 1) * pose.p, 0.0
    before = np.linspace(0.0, d_C, max(2, round(CELLS * d_C / pose.p)))
    after = np.linspace(d_C, pose.p, max(2, CELLS - len(before)))
    s = np.concatenate([before + pose.n * pose.p, after + (pose.n - 1) * pose.p])
    return np.concatenate([before, after]), s, d_C
