"""The stairs as solid boxes, only as many as the robot can reach."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.physics.engine import engine
from kaidan.physics.spec import TrialSpec
from kaidan.physics.tracks import SprungNoses
from kaidan.terrain.profile import Profile

Array = NDArray[np.float64]

NOSE = (0.001, 0.02)
"""Width and height of a nosing that stands alone [m]: a blade, on which no tail can rest."""
_THICK = 0.05
_PLATE = 0.01
"""Thickness of what slopes [m]: little of its square ends sticks out beside it."""
_OVERLAP = 0.01
AXLE = [math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0]
"""Turns z to y: an axle, or an edge across the stairs."""
_ASIDE = 0.002
"""By which every second box is narrower on each side [m]."""
MOST_BLOCKS = 5000
"""Boxes of a terrain; with that many a second of the robot's time costs a third of a second."""
_COLOURS = ((0.78, 0.76, 0.72, 1.0), (0.70, 0.68, 0.64, 1.0))


class Block(NamedTuple):
    """A box in the plane, turned by an angle."""

    x: float
    z: float
    half_length: float
    half_height: float
    angle: float
    nosing: int
    """Number of its nosing counted as the robot drives, from 0; -1: none."""
    round: bool = False
    """Whether it is a disc, of `half_height`, and no box."""


def blocks_of(profile: Profile, *, down: bool, noses_only: bool) -> list[Block]:
    """Boxes whose faces are the profile; the nosing is a box's corner.

    noses_only: blades of `NOSE` at the nosings, and nothing else.
    """
    nosings = profile.nosings
    if noses_only:
        half, deep = NOSE[0] / 2, NOSE[1] / 2
        inward = -half if down else half
        return [
            Block(float(x) + inward, float(z) - deep, half, deep, 0.0, number)
            for number, (x, z) in enumerate(nosings)
        ]
    points = profile.points
    made = []
    for k, ((x0, z0), (x1, z1)) in enumerate(pairwise(points)):
        before = points[k, 1] - points[k - 1, 1] if k and _upright(points, k - 1) else 0.0
        last = k + 2 >= len(points)
        after = 0.0 if last or not _upright(points, k + 1) else points[k + 2, 1] - points[k + 1, 1]
        corner = points[k + 1] if down else points[k]
        number = _number(nosings, corner)
        if x1 - x0 < 1e-9:
            if _level(points, k + 1 if z1 > z0 else k - 1):
                continue  # the face of the box that lies behind it
            away = _PLATE / 2 if z1 > z0 else -_PLATE / 2
            made.append(Block(x0 + away, (z0 + z1) / 2, _PLATE / 2, abs(z1 - z0) / 2, 0.0, number))
        elif abs(z1 - z0) < 1e-12:
            left = x0 - (_OVERLAP if before < 0 else 0.0)
            right = x1 + (_OVERLAP if after > 0 else 0.0)
            deep = max(_THICK, before, -after) + _OVERLAP
            made.append(
                Block((left + right) / 2, z0 - deep / 2, (right - left) / 2, deep / 2, 0.0, number)
            )
        else:
            angle = math.atan2(z1 - z0, x1 - x0)
            half = math.hypot(x1 - x0, z1 - z0) / 2
            made.append(
                Block(
                    (x0 + x1) / 2 + _PLATE / 2 * math.sin(angle),
                    (z0 + z1) / 2 - _PLATE / 2 * math.cos(angle),
                    half,
                    _PLATE / 2,
                    angle,
                    number,
                )
            )
    return made


def with_round_nosings(blocks: list[Block], radius: float, *, down: bool) -> list[Block]:
    """Blocks of level steps with round nosings: a disc, what lies under it and what behind it."""
    made = []
    for block in blocks:
        if block.nosing < 0 or block.angle or block.half_length <= radius:
            made.append(block)
            continue
        ahead = -radius if down else radius
        x, top = block.x - math.copysign(block.half_length, ahead), block.z + block.half_height
        made += [
            block._replace(z=block.z - radius / 2, half_height=block.half_height - radius / 2),
            block._replace(x=block.x + ahead / 2, half_length=block.half_length - radius / 2),
            Block(x + ahead, top - radius, radius, radius, 0.0, block.nosing, round=True),
        ]
    return made


def _upright(points: Array, k: int) -> bool:
    return bool(points[k + 1, 0] - points[k, 0] < 1e-9)


def _level(points: Array, k: int) -> bool:
    return 0 <= k < len(points) - 1 and abs(points[k + 1, 1] - points[k, 1]) < 1e-12


def _number(nosings: Array, corner: Array) -> int:
    near = np.flatnonzero(np.abs(nosings - corner).max(axis=1) < 1e-9)
    return int(near[0]) if len(near) else -1


def with_landings(profile: Profile, room: float) -> Profile:
    """Profile with its landings lengthened by that much [m]: they are taken as long enough."""
    points = profile.points
    ends = points[[0, -1]] + np.array([[-room, 0.0], [room, 0.0]])
    joined = np.vstack([ends[0], points, ends[1]])
    for end in (0, -1):  # a level landing becomes one longer box
        inner = joined[1 if end == 0 else -2]
        beyond = joined[2 if end == 0 else -3]
        if abs(inner[1] - beyond[1]) < 1e-12:
            joined = np.delete(joined, 1 if end == 0 else len(joined) - 2, axis=0)
    return replace(profile, points=joined)


def add_terrain(
    scene: Any, spec: TrialSpec, profile: Profile, window: tuple[float, float], half_width: float
) -> dict[str, int]:
    """Add the boxes within a window of x [m] to a scene; numbers of the nosings by geom name."""
    mujoco = engine()
    blocks = blocks_of(profile, down=spec.downhill, noses_only=spec.ground == "noses")
    if spec.nosing_radius:
        blocks = with_round_nosings(blocks, spec.nosing_radius, down=spec.downhill)
    reached = [
        (k, block)
        for k, block in enumerate(blocks)
        if block.x + block.half_length >= window[0] and block.x - block.half_length <= window[1]
    ]
    if len(reached) > MOST_BLOCKS:
        raise spec.refuse(
            f"the terrain is {len(reached)} boxes, more than {MOST_BLOCKS}: cut or thin it"
        )
    numbers = {}
    for k, block in reached:
        name = f"step{block.nosing + 1}" if block.nosing >= 0 else f"ground{k}"
        if name in numbers:
            name = f"{name}.{k}"
        owner, at = scene.worldbody, [block.x, 0.0, block.z]
        track = spec.track
        if isinstance(track, SprungNoses) and block.nosing >= 0 and spec.stiffness is not None:
            owner, at = _sprung(scene, track, block, name, spec.stiffness), [0.0, 0.0, 0.0]
        # of two that overlap one is narrower: their sides do not coincide in pictures
        across = half_width - _ASIDE * (k % 2)
        capsule, box = mujoco.mjtGeom.mjGEOM_CAPSULE, mujoco.mjtGeom.mjGEOM_BOX
        owner.add_geom(
            name=name,
            type=capsule if block.round else box,
            size=[block.half_height, across - block.half_height, 0.0]
            if block.round
            else [block.half_length, across, block.half_height],
            pos=at,
            quat=AXLE if block.round else turned(block.angle),
            rgba=_COLOURS[k % 2],
            contype=1,
            conaffinity=2,
            condim=3,
        )
        numbers[name] = block.nosing
    return numbers


def _sprung(scene: Any, track: SprungNoses, block: Block, name: str, stiffness: float) -> Any:
    """Body of a step on two springs, its weight carried."""
    mujoco = engine()
    mass, ratio = track.nose_mass, track.damping_ratio
    body = scene.worldbody.add_body(name=name, pos=[block.x, 0.0, block.z], gravcomp=1.0)
    body.mass, body.inertia, body.ipos = mass, [mass] * 3, [0.0, 0.0, 0.0]
    body.explicitinertial = True
    for axis, direction in (("x", [1.0, 0.0, 0.0]), ("z", [0.0, 0.0, 1.0])):
        body.add_joint(
            name=f"{name}_{axis}",
            type=mujoco.mjtJoint.mjJNT_SLIDE,
            axis=direction,
            stiffness=[stiffness, 0.0, 0.0],
            damping=[2.0 * ratio * math.sqrt(stiffness * mass), 0.0, 0.0],
        )
    return body


def turned(angle: float) -> list[float]:
    """Quaternion of a turn in the plane, x towards z."""
    return [math.cos(angle / 2), 0.0, -math.sin(angle / 2), 0.0]
