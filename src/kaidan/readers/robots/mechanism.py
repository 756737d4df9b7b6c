"""A robot as a file describes it: links with inertials and shapes, and the joints between them."""

from collections import deque
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, did_you_mean, listed, shown
from kaidan.readers.kinds import Provenance

NOWHERE = Provenance(path="", digest="", form="")
Array = NDArray[np.float64]
ShapeKind = Literal["box", "cylinder", "capsule", "sphere", "ellipsoid", "mesh"]


@dataclass(frozen=True)
class Fault:
    """Something wrong with a file, or left out."""

    kind: str
    """Key of ``kaidan.readers.sentences.robot_file.FAULTS``."""
    who: str = ""
    """Link or joint."""
    numbers: Mapping[str, float | str] = field(default_factory=dict)
    """By the names that the sentence uses."""


@dataclass(frozen=True, eq=False)
class Shape:
    """A shape of a link."""

    kind: ShapeKind
    size: tuple[float, ...]
    """box: edges; cylinder, capsule: radius, length between the ends of the straight part; sphere:
    radius; ellipsoid: half axes; mesh: nothing [m]."""
    place: Array
    """Shape (4, 4), in the frame of the link; a cylinder lies along z."""
    name: str = ""
    collides: bool = True
    """Whether it is for contact, and not for the eye alone."""


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid body."""

    name: str
    mass: float = 0.0
    """[kg]"""
    centroid: Array = field(default_factory=lambda: np.zeros(3))
    """In the frame of the link [m]."""
    inertia: Array = field(default_factory=lambda: np.zeros((3, 3)))
    """About the centroid, along the axes of the link [kg m^2]."""
    shapes: tuple[Shape, ...] = ()


@dataclass(frozen=True, eq=False)
class Joint:
    """What holds a link to its parent."""

    name: str
    kind: Literal["fixed", "hinge", "slide"]
    parent: str
    child: str
    origin: Array
    """Frame of the child in that of the parent at zero, shape (4, 4)."""
    axis: Array = field(default_factory=lambda: np.array([1.0, 0.0, 0.0]))
    """In the frame of the child."""
    anchor: Array = field(default_factory=lambda: np.zeros(3))
    """Point of the axis of a hinge, in the frame of the child [m]."""
    limits: tuple[float, float] = (-np.inf, np.inf)
    """Of the angle or way [rad or m]."""
    zero: float = 0.0
    """Angle or way at which the file places the child [rad or m]."""
    speed: float | None = None
    """Largest speed [rad/s or m/s]."""
    follows: tuple[str, float, float] | None = None
    """Joint that it follows, the factor and the offset."""

    def moved(self, to: float) -> Array:
        """Frame of the child in that of the parent, shape (4, 4)."""
        by = to - self.zero
        if self.kind == "hinge":
            turned = rotation_about(self.axis, by)
            return self.origin @ frame(turned, self.anchor - turned @ self.anchor)
        if self.kind == "slide":
            return self.origin @ frame(np.eye(3), by * self.axis)
        return self.origin


class MassProperties(NamedTuple):
    """Mass, centroid and inertia of several links."""

    mass: float
    """[kg]"""
    centroid: Array
    """Shape (3,) [m]."""
    inertia: Array
    """Shape (3, 3), about the centroid [kg m^2]."""


@dataclass(frozen=True, eq=False)
class Mechanism:
    """Links and joints of one robot."""

    name: str
    links: dict[str, Link]
    joints: tuple[Joint, ...]
    places: dict[str, Array] = field(default_factory=dict)
    """Frames of the links that hang on no joint, where the file places them."""
    tracks: tuple[str, ...] = ()
    """Links that the file itself declares to be tracks."""
    faults: tuple[Fault, ...] = ()
    max_speed: float | None = None
    """Largest speed of the tracks as declared [m/s]."""
    provenance: Provenance = NOWHERE

    @cached_property
    def moving(self) -> dict[str, Joint]:
        """Joints that move and can be set, by name."""
        return {
            joint.name: joint
            for joint in self.joints
            if joint.kind != "fixed" and joint.follows is None
        }

    @cached_property
    def held_by(self) -> dict[str, Joint]:
        """Joint that holds a link, by link."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def _in_order(self) -> tuple[Joint, ...]:
        """Joints so that a parent stands before its children."""
        below: dict[str, list[Joint]] = {}
        for joint in self.joints:
            below.setdefault(joint.parent, []).append(joint)
        ready = deque(name for name in self.links if name not in self.held_by)
        order: list[Joint] = []
        while ready:
            for joint in below.get(ready.popleft(), ()):
                order.append(joint)
                ready.append(joint.child)
        return tuple(order)

    def subtree(self, root: str) -> tuple[str, ...]:
        """Link and all that hang on it."""
        found = {root: None}
        for joint in self._in_order:
            if joint.parent in found:
                found[joint.child] = None
        return tuple(found)

    def checked_angles(self, angles: Mapping[str, float]) -> dict[str, float]:
        """Angles of joints that there are, within their limits.

        Raises
        ------
        InputError
            An unknown joint, or an angle beyond its limits.
        """
        for name, value in angles.items():
            joint = self.moving.get(name)
            if joint is None:
                raise InputError(
                    f"joint {shown(name)} is not one that moves"
                    f"{did_you_mean(name, self.moving) or _listed(self.moving)}"
                )
            low, high = joint.limits
            if not low - 1e-9 <= value <= high + 1e-9:
                unit = "rad" if joint.kind == "hinge" else "m"
                raise InputError(
                    f"joint {name} = {value:g} {unit} is not within {low:g} to {high:g} {unit}"
                )
        return dict(angles)

    def frames(self, angles: Mapping[str, float] | None = None) -> dict[str, Array]:
        """Frame of every link at given joint angles, each of shape (4, 4).

        Parameters
        ----------
        angles : mapping of str to float, optional
            Angles by joint [rad], or ways [m]; as the file places them where none is given.
        """
        angles = angles or {}
        found = {
            name: self.places.get(name, np.eye(4))
            for name in self.links
            if name not in self.held_by
        }
        for joint in self._in_order:
            found[joint.child] = found[joint.parent] @ joint.moved(self._way(joint, angles))
        return found

    def _way(self, joint: Joint, angles: Mapping[str, float]) -> float:
        if joint.follows is None:
            return angles.get(joint.name, joint.zero)
        leader, factor, offset = joint.follows
        return factor * angles.get(leader, 0.0) + offset

    def mass_properties(
        self, angles: Mapping[str, float] | None = None, links: Collection[str] | None = None
    ) -> MassProperties:
        """Mass, centroid and inertia at given joint angles, of all links or of some.

        ::

            m = sum m_i,  c = sum m_i c_i / m,
            I = sum R_i I_i R_i^T + m_i (|d_i|^2 1 - d_i d_i^T),  d_i = c_i - c

        Links without a mass add none; without any the centroid is NaN.
        """
        frames = self.frames(angles)
        chosen = [self.links[name] for name in (self.links if links is None else links)]
        masses = np.array([link.mass for link in chosen])
        places = np.array([(frames[link.name] @ [*link.centroid, 1.0])[:3] for link in chosen])
        mass = float(masses.sum())
        if mass <= 0.0:
            return MassProperties(0.0, np.full(3, np.nan), np.zeros((3, 3)))
        centroid = masses @ places / mass
        inertia = np.zeros((3, 3))
        for link, place in zip(chosen, places, strict=True):
            turned, away = frames[link.name][:3, :3], place - centroid
            inertia += turned @ link.inertia @ turned.T
            inertia += link.mass * (away @ away * np.eye(3) - np.outer(away, away))
        return MassProperties(mass, centroid, inertia)


@dataclass(frozen=True, eq=False)
class Placed:
    """A mechanism at joint angles, seen in the frame of a robot: x forward, y left, z up."""

    mechanism: Mechanism
    turned: Array
    """Rotation from the file's frame to the robot's, shape (3, 3)."""
    angles: Mapping[str, float] = field(default_factory=dict)
    """By joint [rad or m]; as the file has them where none is given."""

    @cached_property
    def frames(self) -> dict[str, Array]:
        """Frame of each link, shape (4, 4)."""
        turn = frame(self.turned, np.zeros(3))
        return {name: turn @ at for name, at in self.mechanism.frames(self.angles).items()}

    def mass_properties(self, links: Collection[str] | None = None) -> MassProperties:
        """Mass, centroid and inertia of all links or of some."""
        found = self.mechanism.mass_properties(self.angles, links)
        inertia = self.turned @ found.inertia @ self.turned.T
        return MassProperties(found.mass, self.turned @ found.centroid, inertia)

    def pivot(self, joint: Joint) -> Array:
        """Point of the axis of a joint, shape (3,) [m]."""
        return np.asarray((self.frames[joint.child] @ [*joint.anchor, 1.0])[:3])

    def lateral(self, joint: Joint) -> float:
        """Part of a joint's axis that points to the left [1]."""
        return float(self.frames[joint.child][1, :3] @ joint.axis)


def checked_tree(whole: Mechanism, *, origin: str) -> Mechanism:
    """Same mechanism, once it is sure that each link hangs on one joint at most, none on itself."""
    held: dict[str, str] = {}
    for joint in whole.joints:
        for name in (joint.parent, joint.child):
            if name not in whole.links:
                raise InputError(f"{origin}: joint {shown(joint.name)}: no link {shown(name)}")
        if joint.child in held:
            raise InputError(
                f"{origin}: link {shown(joint.child)} hangs on two joints, "
                f"{shown(held[joint.child])} and {shown(joint.name)}: a closed chain is not read"
            )
        held[joint.child] = joint.name
    if len(whole._in_order) < len(whole.joints):
        reached = {joint.name for joint in whole._in_order}
        lost = next(joint.name for joint in whole.joints if joint.name not in reached)
        raise InputError(f"{origin}: joint {shown(lost)} is part of a circle of joints")
    return whole


def frame(rotation: Array, origin: Array) -> Array:
    """Frame of a rotation and a place, shape (4, 4)."""
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = rotation, origin
    return made


def rotation_about(axis: Array, angle: float) -> Array:
    """Rotation about a unit axis (Rodrigues), shape (3, 3).

    Examples
    --------
    >>> rotation_about(np.array([0.0, 0.0, 1.0]), np.pi / 2).round(6) @ [1.0, 0.0, 0.0]
    array([0., 1., 0.])
    """
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    made: Array = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return made


def rotation_rpy(roll: float, pitch_angle: float, yaw: float) -> Array:
    """Rotation about the fixed x, then y, then z axis, as URDF and SDF write it, shape (3, 3)."""
    x, y, z = np.eye(3)
    return rotation_about(z, yaw) @ rotation_about(y, pitch_angle) @ rotation_about(x, roll)


def rotation_quaternion(w: float, x: float, y: float, z: float) -> Array:
    """Rotation of a quaternion of any length, shape (3, 3); the zero quaternion turns nothing."""
    length = float(np.sqrt(w * w + x * x + y * y + z * z))
    if length == 0.0:
        return np.eye(3)
    axis = np.array([x, y, z]) / length
    size = float(np.linalg.norm(axis))
    if size == 0.0:
        return np.eye(3)
    return rotation_about(axis / size, 2.0 * float(np.arctan2(size, w / length)))


def symmetric(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> Array:
    """Inertia of its six numbers, shape (3, 3)."""
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _listed(names: Collection[str]) -> str:
    return f"; it has {listed(sorted(names))}" if names else "; it has none that move"
