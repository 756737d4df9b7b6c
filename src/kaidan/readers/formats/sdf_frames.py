"""Named frames of an SDF model: where links, joints and frames stand, whatever they refer to."""

import math
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from kaidan.errors import InputError, short, shown
from kaidan.readers.robots.mechanism import Array, frame, rotation_quaternion, rotation_rpy
from kaidan.readers.xml_tree import Element

MODEL = "__model__"
WORLD = "world"


@dataclass
class Frames:
    """Frames of a model and of the models in it, by name; those within are called model::name."""

    origin: str
    links: dict[str, Element] = field(default_factory=dict)
    joints: dict[str, Element] = field(default_factory=dict)
    poses: dict[str, tuple[str, Array]] = field(default_factory=dict)
    """Frame by name: what it is relative to, and where in it."""
    attached: dict[str, str] = field(default_factory=dict)
    """What a frame that is no link is fixed to."""
    _known: dict[str, Array] = field(default_factory=dict)

    @classmethod
    def of(cls, model: Element, version: tuple[int, int]) -> Self:
        """Frames of a model."""
        found = cls(model.origin)
        found.poses[MODEL] = ("", np.eye(4))
        found._collect(model, "", MODEL, version)
        return found

    def _collect(self, model: Element, before: str, of: str, version: tuple[int, int]) -> None:
        if model.attributes.get("placement_frame"):
            model.refuse("placement_frame is not read")
        for element in model.all("link", "joint", "frame", "model"):
            name = before + element.name()
            if name in self.poses:
                element.refuse("there are two of that name")
            place, pose = pose_of(element), element.find("pose")
            relative = "" if pose is None else pose.attributes.get("relative_to", "")
            if element.tag == "joint":
                self.joints[name] = element
                child = element.word("child")
                base = before + (relative or child)
                self.attached[name] = before + child
            elif element.tag == "frame":
                fixed_to = element.attributes.get("attached_to", "")
                self.attached[name] = before + fixed_to if fixed_to else of
                base = before + relative if relative else self.attached[name]
            else:
                base = before + relative if relative else of
            self.poses[name] = (of if base == before + MODEL else base, place)
            if element.tag == "link":
                self.links[name] = element
            elif element.tag == "model":
                self._collect(element, f"{name}::", name, version)

    def in_model(self, name: str, asked_by: Element | None = None) -> Array:
        """Frame of a name in that of the model, shape (4, 4)."""
        path: list[str] = []
        at = name
        while at and at not in self._known:
            if at in path:
                raise InputError(
                    f"{self.origin}: the frames {', '.join(map(short, path[:4]))} refer to each "
                    "other in a circle"
                )
            if at not in self.poses:
                line = f", line {asked_by.line}" if asked_by is not None else ""
                raise InputError(f"{self.origin}{line}: no frame is called {shown(at)}")
            path.append(at)
            at = self.poses[at][0]
        for each in reversed(path):
            base, place = self.poses[each]
            self._known[each] = self._known[base] @ place if base else place
        return self._known[name]

    def link_of(self, joint: Element, end: str, name: str) -> str:
        """Link that is the parent or the child of a joint; empty: the world."""
        stated = joint.required(end).text.strip()
        if stated == WORLD:
            return ""
        before = name.rpartition("::")[0]
        at, seen = f"{before}::{stated}" if before else stated, set()
        while at not in self.links:
            if at in seen or at not in self.attached:
                joint.refuse(f"<{end}> {shown(stated)} is no link")
            seen.add(at)
            at = self.attached[at]
        return at


def pose_of(element: Element) -> Array:
    """Frame of an element's ``<pose>``, without what it is relative to."""
    pose = element.find("pose")
    if pose is None or not pose.text.strip():
        return np.eye(4)
    if pose.attributes.get("rotation_format") == "quat_xyzw":
        *xyz, x, y, z, w = pose.numbers(pose.text, 7, "pose")
        return frame(rotation_quaternion(w, x, y, z), np.array(xyz))
    *xyz, roll, about_y, yaw = pose.numbers(pose.text, 6, "pose")
    if pose.attributes.get("degrees", "").lower() in ("1", "true"):
        roll, about_y, yaw = math.radians(roll), math.radians(about_y), math.radians(yaw)
    return frame(rotation_rpy(roll, about_y, yaw), np.array(xyz))
