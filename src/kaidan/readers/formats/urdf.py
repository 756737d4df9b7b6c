"""URDF: the XML of a robot in ROS, as far as masses, shapes and joints go."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np

from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source
from kaidan.readers.robots.description import provenance_of, robot_xml
from kaidan.readers.robots.mechanism import (
    Array,
    Fault,
    Joint,
    Link,
    Mechanism,
    Shape,
    checked_tree,
    frame,
    rotation_rpy,
    symmetric,
)
from kaidan.readers.robots.plugins import declared_tracks
from kaidan.readers.xml_tree import Element

_KINDS: dict[str, Literal["fixed", "hinge", "slide"]] = {
    "revolute": "hinge",
    "continuous": "hinge",
    "prismatic": "slide",
    "fixed": "fixed",
}


def read(source: Source, hints: Hints) -> Mechanism:
    """Links and joints of a file; none of the files that it names is opened."""
    root = robot_xml(source)
    made = mechanism(root)
    return replace(made, provenance=provenance_of(source, "urdf", hints))


def mechanism(root: Element) -> Mechanism:
    """Links and joints of the ``<robot>`` element of a URDF file."""
    faults: list[Fault] = []
    links: dict[str, Link] = {}
    for element in root.all("link"):
        link = _link(element, faults)
        if link.name in links:
            element.refuse("there are two of that name")
        links[link.name] = link
    if not links:
        root.refuse("has no <link>")
    joints = tuple(_joint(element, faults) for element in root.all("joint"))
    tracks, speed = declared_tracks(root)
    made = Mechanism(
        name=root.attributes.get("name", ""),
        links=links,
        joints=joints,
        tracks=tracks,
        faults=tuple(faults),
        max_speed=speed,
    )
    return checked_tree(made, origin=root.origin)


def _link(element: Element, faults: list[Fault]) -> Link:
    name = element.name()
    shapes = tuple(_shapes(element))
    inertial = element.find("inertial")
    if inertial is None:
        if any(shape.collides for shape in shapes):
            faults.append(Fault("no-mass", name))
        return Link(name, shapes=shapes)
    mass = inertial.required("mass")
    kilograms = mass.number(mass.attributes.get("value"), "value")
    if kilograms < 0.0:
        mass.refuse(f"value = {kilograms:g} kg is negative")
    place = _origin(inertial)
    moments = np.zeros((3, 3))
    given = inertial.find("inertia")
    if given is None:
        faults.append(Fault("no-inertia", name))
    else:
        six = [
            given.number(given.attributes.get(f"i{axes}", "0"), f"i{axes}")
            for axes in ("xx", "yy", "zz", "xy", "xz", "yz")
        ]
        moments = symmetric(*six)
    turned = place[:3, :3]
    return Link(name, kilograms, place[:3, 3], turned @ moments @ turned.T, shapes)


def _shapes(link: Element) -> Iterator[Shape]:
    for element in link.all("collision", "visual"):
        for geometry in element.all("geometry"):
            for each in geometry.children:
                made = _shape(each, _origin(element), element)
                if made is not None:
                    yield made


def _shape(each: Element, place: Array, of: Element) -> Shape | None:
    at, collides = each.attributes, of.tag == "collision"
    name = of.attributes.get("name", "")
    if each.tag == "box":
        return Shape("box", each.numbers(at.get("size"), 3, "size"), place, name, collides)
    if each.tag == "sphere":
        return Shape("sphere", (each.number(at.get("radius"), "radius"),), place, name, collides)
    if each.tag in ("cylinder", "capsule"):
        size = tuple(each.number(at.get(key), key) for key in ("radius", "length"))
        kind: Literal["cylinder", "capsule"] = "cylinder" if each.tag == "cylinder" else "capsule"
        return Shape(kind, size, place, name, collides)
    return Shape("mesh", (), place, name, collides) if each.tag == "mesh" else None


def _joint(element: Element, faults: list[Fault]) -> Joint:
    name, kind = element.name(), element.name("type")
    if kind not in _KINDS:
        faults.append(Fault("kept-joint", name))
    axis, limits = np.array([1.0, 0.0, 0.0]), (-math.inf, math.inf)
    stated = element.find("axis")
    if stated is not None and _KINDS.get(kind, "fixed") != "fixed":
        axis = np.array(stated.numbers(stated.attributes.get("xyz", "1 0 0"), 3, "xyz"))
        length = float(np.linalg.norm(axis))
        if length < 1e-6:
            stated.refuse("xyz has no direction")
        axis = axis / length
    limit, speed = element.find("limit"), None
    if limit is not None:
        at = limit.attributes
        if kind in ("revolute", "prismatic"):
            low, high = (limit.number(at.get(key, "0"), key) for key in ("lower", "upper"))
            limits = (low, high)
        if "velocity" in at:
            speed = limit.number(at["velocity"], "velocity")
    mimic, follows = element.find("mimic"), None
    if mimic is not None:
        at = mimic.attributes
        follows = (
            mimic.name("joint"),
            mimic.number(at.get("multiplier", "1"), "multiplier"),
            mimic.number(at.get("offset", "0"), "offset"),
        )
    return Joint(
        name=name,
        kind=_KINDS.get(kind, "fixed"),
        parent=element.required("parent").name("link"),
        child=element.required("child").name("link"),
        origin=_origin(element),
        axis=axis,
        limits=limits,
        speed=speed,
        follows=follows,
    )


def _origin(element: Element) -> Array:
    """Frame of an element's ``<origin>``; the identity without one."""
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    at = origin.attributes
    xyz = origin.numbers(at.get("xyz", "0 0 0"), 3, "xyz")
    if "rpy" not in at and "quat_xyzw" in at:  # URDF 1.2
        origin.refuse("quat_xyzw is not read; write rpy")
    return frame(rotation_rpy(*origin.numbers(at.get("rpy", "0 0 0"), 3, "rpy")), np.array(xyz))
