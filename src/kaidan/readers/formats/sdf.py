"""SDF: the XML of a robot in Gazebo, as far as masses, shapes and joints go; versions 1.3 to 1.12.

Poses stand in the frames that the version gives them: before 1.7 a link in the model and a joint in
its child; from 1.7 on in whatever frame ``relative_to`` names.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np

from kaidan.errors import InputError, listed, shown
from kaidan.readers.formats.sdf_frames import Frames, pose_of
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
    symmetric,
)
from kaidan.readers.robots.plugins import declared_tracks
from kaidan.readers.xml_tree import Element

_HINGES = ("revolute", "continuous")
_ENDLESS = 1e15
"""Limits beyond this stand for none."""


def read(source: Source, hints: Hints) -> Mechanism:
    """Links and joints of a file; none of the files that it names is opened."""
    root = robot_xml(source)
    made = mechanism(root, model=hints.element)
    return replace(made, provenance=provenance_of(source, "sdf", hints))


def mechanism(root: Element, *, model: str = "") -> Mechanism:
    """Links and joints of one model of an SDF file.

    root: its ``<sdf>``.
    model: name of the model, where the file has several.
    """
    chosen = _chosen(root, model)
    version = _version(root)
    for element in chosen.descendants():
        if element.tag == "include":
            element.refuse(
                f"<include> of {shown(element.word('uri'))} is another file, and no other is "
                "opened: expand it first, for example with gz sdf -p"
            )
    faults: list[Fault] = []
    frames = Frames.of(chosen, version)
    links = {}
    for name, element in frames.links.items():
        links[name] = _link(name, element, faults)
    if not links:
        chosen.refuse("has no <link>")
    joints = tuple(
        _joint(name, element, frames, version, faults) for name, element in frames.joints.items()
    )
    joints = tuple(joint for joint in joints if joint.child)
    tracks, speed = declared_tracks(root)
    made = Mechanism(
        name=chosen.attributes.get("name", ""),
        links=links,
        joints=_tree(joints, faults),
        places={name: frames.in_model(name) for name in links},
        tracks=tracks,
        faults=tuple(faults),
        max_speed=speed,
    )
    return checked_tree(made, origin=root.origin)


def _version(root: Element) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,2})\.(\d{1,2})", root.attributes.get("version", "").strip())
    if found is None:
        root.refuse(f"version = {shown(root.attributes.get('version', ''))} is none")
    return int(found[1]), int(found[2])


def _chosen(root: Element, name: str) -> Element:
    """The one model of a file that is a robot."""
    places = [root, *root.all("world")]
    models = [model for place in places for model in place.all("model")]
    if name:
        models = [model for model in models if model.attributes.get("name") == name]
        if not models:
            raise InputError(f"{root.origin}: has no model {shown(name)}")
    elif len(models) > 1:
        moved = [model for model in models if model.word("static").lower() not in ("true", "1")]
        models = [model for model in moved if model.find("joint") is not None] or moved
    if len(models) > 1:
        known = listed(model.attributes.get("name", "?") for model in models)
        raise InputError(f"{root.origin}: has several models; write FILE#MODEL with one of {known}")
    if not models:
        root.refuse("has no <model> that moves")
    return models[0]


def _link(name: str, element: Element, faults: list[Fault]) -> Link:
    shapes = tuple(_shapes(element))
    inertial = element.find("inertial")
    if inertial is None or inertial.find("mass") is None:
        if any(shape.collides for shape in shapes):
            faults.append(Fault("no-mass", name))
        return Link(name, shapes=shapes)
    mass = inertial.required("mass")
    kilograms = mass.number(mass.text, "mass")
    if kilograms < 0.0:
        mass.refuse(f"{kilograms:g} kg is negative")
    place = pose_of(inertial)
    moments = np.zeros((3, 3))
    given = inertial.find("inertia")
    if given is None:
        faults.append(Fault("no-inertia", name))
    else:
        six = [
            given.number(given.word(f"i{axes}") or "0", f"i{axes}")
            for axes in ("xx", "yy", "zz", "xy", "xz", "yz")
        ]
        moments = symmetric(*six)
    turned = place[:3, :3]
    return Link(name, kilograms, place[:3, 3], turned @ moments @ turned.T, shapes)


def _shapes(link: Element) -> Iterator[Shape]:
    for element in link.all("collision", "visual"):
        for geometry in element.all("geometry"):
            for each in geometry.children:
                made = _shape(each, element)
                if made is not None:
                    yield made


def _shape(each: Element, of: Element) -> Shape | None:
    collides, name, place = of.tag == "collision", of.attributes.get("name", ""), pose_of(of)
    if each.tag == "box":
        size = each.numbers(each.word("size"), 3, "size")
        return Shape("box", size, place, name, collides)
    if each.tag == "sphere":
        size = (each.number(each.word("radius"), "radius"),)
        return Shape("sphere", size, place, name, collides)
    if each.tag == "ellipsoid":
        size = each.numbers(each.word("radii"), 3, "radii")
        return Shape("ellipsoid", size, place, name, collides)
    if each.tag in ("cylinder", "capsule"):
        size = tuple(each.number(each.word(key), key) for key in ("radius", "length"))
        kind: Literal["cylinder", "capsule"] = "cylinder" if each.tag == "cylinder" else "capsule"
        return Shape(kind, size, place, name, collides)
    known = ("mesh", "polyline", "cone")  # their outline is not read
    return Shape("mesh", (), place, name, collides) if each.tag in known else None


def _joint(
    name: str, element: Element, frames: Frames, version: tuple[int, int], faults: list[Fault]
) -> Joint:
    kind = element.attributes.get("type", "")
    parent = frames.link_of(element, "parent", name)
    child = frames.link_of(element, "child", name)
    if not parent:  # joined to the world: nothing moves against the rest
        return Joint(name, "fixed", "", "", np.eye(4))
    if kind not in (*_HINGES, "prismatic", "fixed"):
        faults.append(Fault("kept-joint", name))
    inside = np.linalg.inv(frames.in_model(child)) @ frames.in_model(name)
    axis, limits, speed = np.array([0.0, 0.0, 1.0]), (-math.inf, math.inf), None
    stated = element.find("axis")
    moves = kind in (*_HINGES, "prismatic")
    if moves and stated is None:
        element.refuse("<axis> is missing")
    if moves and stated is not None:
        axis = _axis(stated, inside, frames, child, version)
        limit = stated.find("limit")
        if limit is not None:
            low, high, fast = (limit.word(key) for key in ("lower", "upper", "velocity"))
            limits = (_limit(limit, low, -math.inf), _limit(limit, high, math.inf))
            fastest = _limit(limit, fast, -1.0)
            speed = fastest if fastest > 0.0 else None
    return Joint(
        name=name,
        kind="hinge" if kind in _HINGES else "slide" if kind == "prismatic" else "fixed",
        parent=parent,
        child=child,
        origin=np.linalg.inv(frames.in_model(parent)) @ frames.in_model(child),
        axis=axis,
        anchor=inside[:3, 3],
        limits=limits,
        speed=speed,
    )


def _axis(
    stated: Element, inside: Array, frames: Frames, child: str, version: tuple[int, int]
) -> Array:
    """Axis of a joint in the frame of its child, of length one."""
    xyz = stated.required("xyz")
    axis = np.array(xyz.numbers(xyz.text, 3, "xyz"))
    length = float(np.linalg.norm(axis))
    if length < 1e-6:
        xyz.refuse("has no direction")
    axis = axis / length
    expressed = xyz.attributes.get("expressed_in", "")
    in_model = version <= (1, 4) or stated.word("use_parent_model_frame").lower() in ("1", "true")
    if expressed:
        turned = frames.in_model(expressed, xyz)[:3, :3]
    elif in_model:
        turned = np.eye(3)
    else:
        return np.asarray(inside[:3, :3] @ axis)
    return np.asarray(frames.in_model(child)[:3, :3].T @ turned @ axis)


def _limit(limit: Element, text: str, otherwise: float) -> float:
    """Limit of a joint; large numbers stand for none."""
    try:
        value = float(text)
    except ValueError:
        if text:
            limit.refuse(f"{shown(text)} is not a number")
        return otherwise
    if math.isnan(value):
        limit.refuse("a limit is not a number")
    return otherwise if abs(value) >= _ENDLESS else value


def _tree(joints: tuple[Joint, ...], faults: list[Fault]) -> tuple[Joint, ...]:
    """Joints without those that close a chain: the frames of SDF do not need them."""
    held: set[str] = set()
    kept = []
    for joint in joints:
        if joint.child in held:
            faults.append(Fault("closed-chain", joint.name))
            continue
        held.add(joint.child)
        kept.append(joint)
    return tuple(kept)
