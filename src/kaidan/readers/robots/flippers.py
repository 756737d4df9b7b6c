"""Flippers of a robot: pivot, length, radii, mass, and the joint angle for any angle of theirs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from kaidan.readers.robots.gear import End, FlipperJoint, Gear
from kaidan.readers.robots.hull import hull_of_discs
from kaidan.readers.robots.mechanism import Array, Placed
from kaidan.readers.robots.silhouette import Piece, discs_of, pieces_of

_AT_THE_PIVOT = 0.3
"""A wheel is the root where its axle is within this share of its radius of the pivot."""


@dataclass(frozen=True, eq=False)
class Flipper:
    """One flipper in its own plane."""

    joints: FlipperJoint
    end: End
    length: float
    """From the pivot to the axle of the tip [m]."""
    root_radius: float
    """[m]"""
    tip_radius: float
    """[m]"""
    mass: float
    """[kg]"""
    com_from_pivot: float
    """Of its centroid, towards the tip [m]."""
    angle: float
    """At which the file has it, away from the robot and raising positive [rad]."""
    round_ends: bool
    """Whether both ends are wheels, and not read off boxes."""

    def joint_angle(self, angle: float) -> float:
        """Angle of its joint at which the flipper is at an angle [rad]."""
        turn = math.remainder(angle - self.angle, 2 * math.pi)
        outward = 1.0 if self.end == "front" else -1.0
        return self.joints.joint.zero + outward * self.joints.sense * turn


def flippers_of(placed: Placed, gear: Gear) -> dict[End, tuple[Flipper, ...]]:
    """Flippers of each end of a robot as the file has it, the left one first."""
    return {
        end: tuple(
            _flipper(placed, each, end) for each in sorted(pair, key=lambda one: -one.pivot[1])
        )
        for end, pair in gear.flippers.items()
    }


def _flipper(placed: Placed, joints: FlipperJoint, end: End) -> Flipper:
    discs = discs_of(pieces_of(placed, joints.links))
    pivot = joints.pivot[[0, 2]]
    away = discs[:, :2] - pivot
    distance = np.hypot(away[:, 0], away[:, 1])
    wheels = np.flatnonzero(discs[:, 2] > 0.0)
    roots = [k for k in wheels if distance[k] <= _AT_THE_PIVOT * discs[k, 2]]
    tips = [k for k in wheels if distance[k] > discs[k, 2]]
    root = max((float(discs[k, 2]) for k in roots), default=0.0)
    if tips:
        tip = max(tips, key=lambda k: distance[k] + discs[k, 2])
        way, length, radius = away[tip] / distance[tip], float(distance[tip]), float(discs[tip, 2])
    else:
        way, length, radius = _of_boxes(away)
    if not root:
        root = _half_width(discs - [*pivot, 0.0], way, 0.0)
    of_all = placed.mass_properties(joints.links)
    com = np.zeros(2) if of_all.mass == 0.0 else of_all.centroid[[0, 2]] - pivot
    outward = 1.0 if end == "front" else -1.0
    return Flipper(
        joints=joints,
        end=end,
        length=length,
        root_radius=root,
        tip_radius=radius,
        mass=of_all.mass,
        com_from_pivot=float(com @ way),
        angle=math.atan2(float(way[1]), outward * float(way[0])),
        round_ends=bool(tips) and bool(roots),
    )


def _of_boxes(away: Array) -> tuple[Array, float, float]:
    """Direction, length and tip radius of a flipper without wheels."""
    farthest = away[int(np.argmax(np.hypot(away[:, 0], away[:, 1])))]
    way = away.mean(axis=0)
    size = float(np.hypot(*way))
    way = (farthest if size < 1e-6 else way) / max(float(np.hypot(*farthest)), size, 1e-9)
    way = way / max(float(np.hypot(*way)), 1e-9)
    reach = float((away @ way).max())
    radius = _half_width(np.column_stack([away, np.zeros(len(away))]), way, reach)
    return way, reach - radius, radius


def _half_width(discs: Array, way: Array, at: float) -> float:
    """Half of the hull's width square to a direction, near a distance along it [m]."""
    across = np.array([-way[1], way[0]])
    points = [point for edge in hull_of_discs(discs) for point in (edge.begin, edge.end)]
    if not points:
        return 0.0
    along = np.array(points) @ way
    near = np.abs(along - at) <= 0.25 * max(float(np.ptp(along)), 1e-9)
    return float(np.abs(np.array(points)[near] @ across).max(initial=0.0))


def root_pieces(placed: Placed, flippers: Mapping[End, tuple[Flipper, ...]]) -> tuple[Piece, ...]:
    """Wheels about the pivots of flippers: what a robot without main tracks stands on."""
    return tuple(
        piece
        for pair in flippers.values()
        for each in pair
        for piece in pieces_of(placed, each.joints.links)
        if piece.is_wheel and piece.discs[0, 2] == each.root_radius
    )


def posed(flippers: Sequence[Flipper], angle: float) -> dict[str, float]:
    """Joint angles that put flippers at an angle, where their limits allow it."""
    found = {}
    for each in flippers:
        low, high = each.joints.joint.limits
        wanted = each.joint_angle(angle)
        within = [wanted + k * 2 * math.pi for k in (0, -1, 1)]
        allowed = [value for value in within if low - 1e-9 <= value <= high + 1e-9]
        if allowed:
            found[each.joints.joint.name] = allowed[0]
    return found
