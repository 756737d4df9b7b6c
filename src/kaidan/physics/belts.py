"""Smooth belts: convex hulls of two discs whose surface runs round them, without moving parts.

::

          .----plate----.          capsules across the robot for the discs (a cylinder against the
         ( c1         c2 )         edge of a box may give a wrong normal), plates for the common
          '----plate----'          tangents; the surface velocity of each is that of a belt

A belt that drives forward moves backward along the underside.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import BELLY, TRACK
from kaidan.physics.engine import engine
from kaidan.physics.spec import TrialSpec
from kaidan.physics.terrain import AXLE, turned

Array = NDArray[np.float64]

SHARPEST = 1e-3
"""Sharpest end [m], as in the contact model."""
_BELLY_HEIGHT = 0.01
HIDDEN = 3
"""Group of geoms that MuJoCo's viewers do not show by default."""
NARROW = 0.4
"""Overall width of a robot in the plane of which none is known [m]."""
_COLOURS = {TRACK: (0.20, 0.22, 0.25, 1.0), BELLY: (0.9, 0.62, 0.0, 1.0)}
_FLIPPER_COLOUR = (0.30, 0.36, 0.42, 1.0)


class Lane(NamedTuple):
    """Where a belt runs, across the robot."""

    name: str
    y: float
    half_width: float


def lanes_of(spec: TrialSpec) -> tuple[Lane, ...]:
    """One belt as wide as the robot in the plane, two tracks in space; y from the centroid."""
    track = spec.question.robot.track
    if spec.dimensions == 3:
        assert track.gauge is not None
        assert track.width is not None
        side, half = track.gauge / 2, track.width / 2
        # left of the robot as it drives
        flip = 1.0 if spec.question.facing == "nose-first" else -1.0
        middle = -flip * spec.lateral_offset
        return (Lane("left_", middle + side, half), Lane("right_", middle - side, half))
    width = NARROW if track.gauge is None else track.gauge + (track.width or 0.0)
    return (Lane("", 0.0, width / 2),)


def half_width(spec: TrialSpec) -> float:
    """Half the robot's width [m]."""
    return max(abs(lane.y) + lane.half_width for lane in lanes_of(spec))


def tangent(part: Array, side: float) -> tuple[Array, Array, Array]:
    """Common tangent of a part's discs, on the lower (side -1) or upper (+1) side.

    Shape (2,).
    """
    c1, r1, c2, r2 = part[0:2], part[2], part[3:5], part[5]
    along = c2 - c1
    apart = float(np.hypot(*along))
    e = along / apart
    m = side * np.array([-e[1], e[0]])
    if e[0] < 0:
        m = -m
    k = (r1 - r2) / apart
    normal = k * e + math.sqrt(max(0.0, 1.0 - k * k)) * m
    return c1 + r1 * normal, c2 + r2 * normal, normal


def rounded(part: Array) -> Array:
    """Part with ends no sharper than `SHARPEST`, its underside where it was."""
    part = part.copy()
    for r in (2, 5):
        grown = max(0.0, SHARPEST - part[r])
        part[r] += grown
        part[r - 1] += grown
    return part


def add_belts(
    body: Any, spec: TrialSpec, parts: Array, kinds: NDArray[np.int64], common: dict[str, Any]
) -> dict[str, Array]:
    """Add the robot's parts to its body, relative to the centroid.

    Surface velocity of each driven geom for a belt speed of 1 m/s, shape (6,).
    """
    field: dict[str, Array] = {}
    of_kind = dict.fromkeys(kinds.tolist(), 0)
    for part, kind in zip(parts, kinds.tolist(), strict=True):
        of_kind[kind] += 1
        label = {TRACK: "track", BELLY: "belly"}.get(kind, "flipper")
        label += "" if of_kind[kind] == 1 else str(of_kind[kind])
        if kind == BELLY:
            _plate(body, f"{label}_plate", part, -1.0, 0.0, half_width(spec), _BELLY_HEIGHT,
                   {**common, "rgba": _COLOURS[BELLY]})  # fmt: skip
            continue
        look = {**common, "rgba": _COLOURS.get(kind, _FLIPPER_COLOUR)}
        for lane in lanes_of(spec):
            name = lane.name + label
            field |= _belt(body, name, rounded(part), lane, spec.speed, look)
    return field


def _belt(
    body: Any, name: str, part: Array, lane: Lane, speed: float, look: dict[str, Any]
) -> dict[str, Array]:
    mujoco = engine()
    field = {}
    apart = math.dist(part[0:2], part[3:5])
    nested = apart <= abs(part[2] - part[5]) + 1e-9
    discs = ((part[0:3], "rear"), (part[3:6], "front"))
    if nested:
        discs = (max(discs, key=lambda each: float(each[0][2])),)  # type: ignore[assignment]
    for (x, z, r), end in discs:
        field[f"{name}_{end}"] = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0 / r])
        body.add_geom(
            name=f"{name}_{end}",
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            size=[r, lane.half_width, 0.0],
            pos=[x, lane.y, z],
            quat=AXLE,
            surfacevel=field[f"{name}_{end}"] * speed,
            **{**look, "group": HIDDEN},
        )
        add_wheel(body, (x, lane.y, z), r, lane.half_width, look["rgba"])
    if not nested:
        thick = min(part[2], part[5])
        for side, which in ((-1.0, "under"), (1.0, "over")):
            sign = _plate(body, f"{name}_{which}", part, side, lane.y, lane.half_width, thick,
                          look, speed)  # fmt: skip
            field[f"{name}_{which}"] = np.array([sign, 0.0, 0.0, 0.0, 0.0, 0.0])
    return field


def add_wheel(
    body: Any, at: tuple[float, float, float], radius: float, half: float, colour: Any
) -> None:
    """Add a cylinder that is seen and touches nothing, for a capsule that touches unseen."""
    body.add_geom(
        type=engine().mjtGeom.mjGEOM_CYLINDER, size=[radius, half + 0.002, 0.0], pos=at,
        quat=AXLE, contype=0, conaffinity=0, rgba=colour,
    )  # fmt: skip


def _plate(
    body: Any,
    name: str,
    part: Array,
    side: float,
    y: float,
    half: float,
    thick: float,
    look: dict[str, Any],
    speed: float = 0.0,
) -> float:
    """Add the box under a tangent; in which direction along it the belt moves."""
    start, end, normal = tangent(part, side)
    along = end - start
    length = float(np.hypot(*along))
    middle = (start + end) / 2 - normal * thick / 2
    forward = np.array([normal[1], -normal[0]])  # of the surface, where normal is outward
    sign = 1.0 if float(forward @ along) > 0 else -1.0
    velocity = {"surfacevel": [sign * speed, 0.0, 0.0, 0.0, 0.0, 0.0]} if speed else {}
    body.add_geom(
        name=name,
        type=engine().mjtGeom.mjGEOM_BOX,
        size=[length / 2, half, thick / 2],
        pos=[middle[0], y, middle[1]],
        quat=turned(math.atan2(along[1], along[0])),
        **velocity,
        **look,
    )
    return sign
