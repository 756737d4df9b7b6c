"""Geoms of MJCF: shapes, and the mass and inertia that a body without an inertial has from them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast, get_args

import numpy as np

from kaidan.errors import shown
from kaidan.readers.formats.mjcf_settings import Settings, turn_to
from kaidan.readers.robots.mechanism import Array, Shape, ShapeKind, frame
from kaidan.readers.xml_tree import Element

_DENSITY = 1000.0
_NO_SHAPES = ("plane", "hfield", "sdf")


@dataclass(frozen=True, eq=False)
class Geom:
    """A geom: its shape in the frame of the body, and its mass."""

    kind: str
    size: tuple[float, ...]
    """As in `mechanism.Shape`."""
    place: Array
    name: str
    group: float
    collides: bool
    mass: float
    """[kg]"""
    mass_unknown: bool
    """Whether it is a mesh whose volume would be needed."""
    shell: bool


def geom(element: Element, at: dict[str, str], settings: Settings, frame_at: Array) -> Geom:
    """Geom of an element, its attributes with defaults, and where the frame around it is."""
    kind = at.get("type", "sphere")
    if "mesh" in at:
        kind = "mesh"
    if kind not in (*get_args(ShapeKind), *_NO_SHAPES):
        element.refuse(f"type = {shown(kind)} is none")
    half, place = _size(element, at, kind), settings.place(element, at)
    if "fromto" in at:
        six = np.array(element.numbers(at["fromto"], 6, "fromto"))
        way = six[:3] - six[3:]
        length = float(np.linalg.norm(way))
        if length < 1e-9:
            element.refuse("fromto: both ends are at one place")
        place = frame(turn_to(way / length), (six[:3] + six[3:]) / 2)
        half = (half[0], length / 2) if kind in ("capsule", "cylinder") else _long(half, length / 2)
    size = _full(kind, half)
    for value in size:
        if value <= 0.0:
            element.refuse(f"size = {shown(at.get('size', ''))} is not positive")
    density = element.number(at.get("density", str(_DENSITY)), "density")
    known = kind != "mesh" and kind not in _NO_SHAPES
    mass = element.number(at["mass"], "mass") if "mass" in at else None
    if mass is None:
        mass = density * _volume(kind, size) if known else 0.0
    if mass < 0.0:
        element.refuse(f"mass = {mass:g} kg is negative")
    seen_only = at.get("contype", "1") == "0" and at.get("conaffinity", "1") == "0"
    return Geom(
        kind=kind,
        size=size,
        place=frame_at @ place,
        name=at.get("name", ""),
        group=element.number(at.get("group", "0"), "group"),
        collides=not seen_only,
        mass=mass,
        mass_unknown=kind == "mesh" and ("mass" in at or density > 0.0) and at.get("mass") != "0",
        shell=at.get("shellinertia", "false") == "true",
    )


def shape(made: Geom) -> Shape | None:
    """Shape of a geom; None where it has none."""
    if made.kind in _NO_SHAPES:
        return None
    return Shape(cast(ShapeKind, made.kind), made.size, made.place, made.name, made.collides)


def inertia_of(parts: Sequence[Geom]) -> tuple[float, Array, Array]:
    """Mass, centroid and inertia about it of geoms, in the frame of their body."""
    mass = math.fsum(part.mass for part in parts)
    if mass <= 0.0:
        return 0.0, np.zeros(3), np.zeros((3, 3))
    centroid = sum((part.mass * part.place[:3, 3] for part in parts), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for part in parts:
        turned, away = part.place[:3, :3], part.place[:3, 3] - centroid
        own = part.mass * np.diag(_moments(part.kind, part.size))
        inertia += turned @ own @ turned.T
        inertia += part.mass * (away @ away * np.eye(3) - np.outer(away, away))
    return mass, centroid, inertia


def _size(element: Element, at: dict[str, str], kind: str) -> tuple[float, ...]:
    """Numbers of ``size``, those that a kind has need of."""
    if kind == "mesh" or kind in _NO_SHAPES:
        return ()
    words = at.get("size", "").split()
    need = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}[kind]
    if "fromto" in at:
        need = 1
    return element.numbers(" ".join(words[:need]), need, "size")


def _long(half: tuple[float, ...], length: float) -> tuple[float, ...]:
    """Half axes of a box or an ellipsoid between two points."""
    return half[0], half[0], length


def _full(kind: str, half: tuple[float, ...]) -> tuple[float, ...]:
    """Size as in `mechanism.Shape`."""
    if kind == "box":
        return tuple(2.0 * each for each in half)
    if kind in ("capsule", "cylinder"):
        return half[0], 2.0 * half[1]
    return half


def _volume(kind: str, size: tuple[float, ...]) -> float:
    """[m^3]."""
    if kind == "box":
        return math.prod(size)
    if kind == "sphere":
        return 4.0 / 3.0 * math.pi * size[0] ** 3
    if kind == "ellipsoid":
        return 4.0 / 3.0 * math.pi * math.prod(size)
    straight = math.pi * size[0] ** 2 * size[1]
    return straight + (4.0 / 3.0 * math.pi * size[0] ** 3 if kind == "capsule" else 0.0)


def _moments(kind: str, size: tuple[float, ...]) -> tuple[float, float, float]:
    """Moments of inertia of a solid over its mass, about its own axes [m^2]."""
    if kind == "box":
        x, y, z = (each**2 / 12.0 for each in size)
        return y + z, x + z, x + y
    if kind == "sphere":
        return (0.4 * size[0] ** 2,) * 3
    if kind == "ellipsoid":
        x, y, z = (each**2 / 5.0 for each in size)
        return y + z, x + z, x + y
    if kind == "cylinder":
        r, h = size
        across = r**2 / 4.0 + h**2 / 12.0
        return across, across, r**2 / 2.0
    if kind == "capsule":  # a cylinder and two halves of a ball
        r, h = size
        ball = 4.0 / 3.0 * r / (4.0 / 3.0 * r + h)  # share of the mass
        along = (1.0 - ball) * r**2 / 2.0 + ball * 0.4 * r**2
        across = (1.0 - ball) * (r**2 / 4.0 + h**2 / 12.0)
        across += ball * (0.4 * r**2 + h**2 / 4.0 + 3.0 / 8.0 * r * h)
        return across, across, along
    return (0.0, 0.0, 0.0)
