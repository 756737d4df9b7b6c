"""MJCF: the XML of a robot in MuJoCo, as far as masses, shapes and joints go.

The subset of one file: bodies, geoms, inertials, joints, frames and defaults. What another file
holds (``<include>``, ``<attach>``, meshes) is not opened, and what a compiler makes up
(``<replicate>``, ``<composite>``, ``<flexcomp>``) is not made.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np

from kaidan.errors import InputError, listed, shown
from kaidan.readers.formats.mjcf_settings import Settings
from kaidan.readers.formats.mjcf_shapes import geom, inertia_of, shape
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source
from kaidan.readers.robots.description import provenance_of, robot_xml
from kaidan.readers.robots.mechanism import Array, Fault, Joint, Link, Mechanism, checked_tree
from kaidan.readers.robots.plugins import declared_tracks
from kaidan.readers.xml_tree import Element

_OTHER_FILES = ("include", "attach", "model")
_MADE_UP = ("replicate", "composite", "flexcomp")


def read(source: Source, hints: Hints) -> Mechanism:
    """Links and joints of a file; none of the files that it names is opened."""
    root = robot_xml(source)
    made = mechanism(root, body=hints.element)
    return replace(made, provenance=provenance_of(source, "mjcf", hints))


def mechanism(root: Element, *, body: str = "") -> Mechanism:
    """Links and joints of one body tree of an MJCF file.

    root: its ``<mujoco>``.
    body: name of the outermost body, where the file has several.
    """
    for element in root.descendants():
        if element.tag in _OTHER_FILES and "file" in element.attributes:
            element.refuse(
                f"file {shown(element.attributes['file'])} is another file, and no other is "
                "opened: save the whole model with MuJoCo first (mj_saveLastXML)"
            )
        if element.tag in _MADE_UP:
            element.refuse("is not read: save the whole model with MuJoCo first (mj_saveLastXML)")
    settings = Settings.of(root)
    reader = _Reader(settings)
    for place, element in _chosen(root, settings, body):
        reader.read(element, "", place, "")
    tracks, speed = declared_tracks(root)
    made = Mechanism(
        name=root.attributes.get("model", ""),
        links=_scaled(reader.links, settings.total_mass),
        joints=tuple(reader.joints),
        places=reader.places,
        tracks=tracks,
        faults=tuple(reader.faults),
        max_speed=speed,
    )
    return checked_tree(made, origin=root.origin)


def _chosen(root: Element, settings: Settings, name: str) -> list[tuple[Array, Element]]:
    """Outermost bodies that are the robot, with their places."""
    worlds = list(root.all("worldbody"))
    found = [(place, each) for world in worlds for place, each in _bodies(world, settings)]
    if name:
        found = [one for one in found if one[1].attributes.get("name") == name]
        if not found:
            raise InputError(f"{root.origin}: has no outermost body {shown(name)}")
    elif len(found) > 1:  # what stands in the world is no robot; what has joints within may be
        found = [one for one in found if _jointed(one[1])] or found
    if len(found) > 1:
        known = listed(each.attributes.get("name", "?") for _, each in found)
        raise InputError(f"{root.origin}: has several bodies; write FILE#BODY with one of {known}")
    if not found:
        root.refuse("has no <body>")
    return found


def _jointed(body: Element) -> bool:
    within = [each for each in body.descendants() if each is not body and each.tag == "body"]
    return any(each.find("joint") is not None for each in within)


def _bodies(of: Element, settings: Settings) -> Iterator[tuple[Array, Element]]:
    """Bodies directly in an element, through frames, with their places in it."""
    for each in of.all("body", "frame"):
        place = settings.place(each)
        if each.tag == "body":
            yield place, each
        else:
            for inner, body in _bodies(each, settings):
                yield place @ inner, body


class _Reader:
    """Links and joints as they are come upon."""

    def __init__(self, settings: Settings) -> None:
        self.settings = settings
        self.links: dict[str, Link] = {}
        self.joints: list[Joint] = []
        self.places: dict[str, Array] = {}
        self.faults: list[Fault] = []

    def read(self, body: Element, parent: str, place: Array, inherited: str) -> None:
        """Read a body and those within."""
        name = body.attributes.get("name", "") or f"body at line {body.line}"
        if name in self.links:
            body.refuse("there are two of that name")
        childclass = body.attributes.get("childclass", inherited)
        self.links[name] = self._link(name, body, childclass)
        joints = [
            each
            for at, element, of in self._within(body, ("joint",), childclass)
            if (each := self._joint(at, element, of, name)) is not None
        ]
        if not parent:
            self.places[name] = place
            if joints:
                self.faults.append(Fault("held-in-world", joints[0].name))
        else:
            self._hang(name, parent, place, joints)
        for at, element, of in self._within(body, ("body",), childclass):
            self.read(element, name, at @ self.settings.place(element), of)

    def _hang(self, name: str, parent: str, place: Array, joints: list[Joint]) -> None:
        """Hang a link on its parent by its joints, one after the other."""
        if not joints:
            joints = [Joint(f"{name} fixed", "fixed", "", "", np.eye(4))]
        for number, joint in enumerate(joints, start=1):
            last = number == len(joints)
            child = name if last else f"{name}#{number}"
            if not last:
                self.links[child] = Link(child)
            self.joints.append(replace(joint, parent=parent, child=child, origin=place))
            parent, place = child, np.eye(4)

    def _within(
        self, of: Element, tags: tuple[str, ...], childclass: str
    ) -> Iterator[tuple[Array, Element, str]]:
        """Elements of a body through frames: where the frame is, the element, its class."""
        for each in of.all(*tags, "frame"):
            if each.tag != "frame":
                yield np.eye(4), each, childclass
                continue
            place = self.settings.place(each)
            within = each.attributes.get("childclass", childclass)
            for inner, element, named in self._within(each, tags, within):
                yield place @ inner, element, named

    def _link(self, name: str, body: Element, childclass: str) -> Link:
        settings, shapes, parts = self.settings, [], []
        for at, element, of in self._within(body, ("geom",), childclass):
            attributes = settings.with_defaults(element, of)
            made = geom(element, attributes, settings, at)
            found = shape(made)
            if found is not None:
                shapes.append(found)
            if settings.counts(made.group):
                parts.append(made)
        inertial = body.find("inertial")
        if settings.from_geoms == "true" or (inertial is None and settings.from_geoms == "auto"):
            mass, centroid, moments = inertia_of(parts)
            if any(part.mass_unknown for part in parts):
                self.faults.append(Fault("mesh-mass", name))
            if any(part.shell for part in parts):
                self.faults.append(Fault("shell", name))
            return Link(name, mass, centroid, moments, tuple(shapes))
        if inertial is None:
            return Link(name, shapes=tuple(shapes))
        return Link(name, *self._inertial(inertial), tuple(shapes))

    def _inertial(self, element: Element) -> tuple[float, Array, Array]:
        at = element.attributes
        mass = element.number(at.get("mass"), "mass")
        if mass < 0.0:
            element.refuse(f"mass = {mass:g} kg is negative")
        place = self.settings.place(element)
        if "fullinertia" in at:
            xx, yy, zz, xy, xz, yz = element.numbers(at["fullinertia"], 6, "fullinertia")
            moments = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        else:
            moments = np.diag(element.numbers(at.get("diaginertia", "0 0 0"), 3, "diaginertia"))
        turned = place[:3, :3]
        return mass, place[:3, 3], turned @ moments @ turned.T

    def _joint(self, at: Array, element: Element, childclass: str, body: str) -> Joint | None:
        attributes = self.settings.with_defaults(element, childclass)
        kind = attributes.get("type", "hinge")
        name = attributes.get("name", "") or f"{body} joint at line {element.line}"
        if kind == "free":
            return None
        if kind not in ("hinge", "slide"):
            if kind != "ball":
                element.refuse(f"type = {shown(kind)} is none")
            self.faults.append(Fault("kept-joint", name))
            return None
        axis = at[:3, :3] @ element.numbers(attributes.get("axis", "0 0 1"), 3, "axis")
        length = float(np.linalg.norm(axis))
        if length < 1e-6:
            element.refuse("axis has no direction")
        anchor = element.numbers(attributes.get("pos", "0 0 0"), 3, "pos")
        unit = self.settings.angle if kind == "hinge" else 1.0
        limits = (-math.inf, math.inf)
        if "range" in attributes and attributes.get("limited", "auto") != "false":
            low, high = element.numbers(attributes["range"], 2, "range")
            limits = (low * unit, high * unit)
        of: Literal["hinge", "slide"] = "hinge" if kind == "hinge" else "slide"
        return Joint(
            name=name,
            kind=of,
            parent="",
            child="",
            origin=np.eye(4),
            axis=axis / length,
            anchor=(at @ [*anchor, 1.0])[:3],
            limits=limits,
            zero=element.number(attributes.get("ref", "0"), "ref") * unit,
        )


def _scaled(links: dict[str, Link], total: float) -> dict[str, Link]:
    """Links of which all masses together are a stated total."""
    mass = math.fsum(link.mass for link in links.values())
    if total <= 0.0 or mass <= 0.0:
        return links
    by = total / mass
    return {
        name: replace(link, mass=by * link.mass, inertia=by * link.inertia)
        for name, link in links.items()
    }
