"""What an MJCF file sets for all of it: units of angles, defaults by class, source of masses."""

from dataclasses import dataclass, field
from typing import Self

import numpy as np

from kaidan.errors import shown
from kaidan.readers.robots.mechanism import Array, frame, rotation_about, rotation_quaternion
from kaidan.readers.xml_tree import Element

MAIN = "main"
_AXES = dict(zip("xyz", np.eye(3), strict=True))


@dataclass
class Settings:
    """Settings of an MJCF file."""

    angle: float = np.pi / 180.0
    """Unit of its angles [rad]."""
    sequence: str = "xyz"
    """Axes of its Euler angles, one after the other; small letters turn with the body."""
    from_geoms: str = "auto"
    """Whether masses come from geoms: auto, true or false."""
    groups: tuple[float, float] = (0.0, 5.0)
    """Groups of the geoms that have a mass."""
    total_mass: float = -1.0
    """What all masses are scaled to [kg]; not positive: not at all."""
    defaults: dict[str, dict[str, dict[str, str]]] = field(default_factory=dict)
    """Attributes by class and element."""

    @classmethod
    def of(cls, root: Element) -> Self:
        """Settings of a file's ``<mujoco>``."""
        found = cls()
        for compiler in root.all("compiler"):
            at = compiler.attributes
            if "angle" in at:
                if at["angle"] not in ("radian", "degree"):
                    compiler.refuse(f"angle = {shown(at['angle'])} is neither radian nor degree")
                found.angle = 1.0 if at["angle"] == "radian" else np.pi / 180.0
            if at.get("coordinate", "local") != "local":
                compiler.refuse("coordinate = global is not read, nor by MuJoCo since 2.3.4")
            found.sequence = at.get("eulerseq", found.sequence)
            if len(found.sequence) != 3 or not set(found.sequence.lower()) <= set("xyz"):
                compiler.refuse(f"eulerseq = {shown(found.sequence)} is not three axes")
            found.from_geoms = at.get("inertiafromgeom", found.from_geoms)
            if "inertiagrouprange" in at:
                low, high = compiler.numbers(at["inertiagrouprange"], 2, "inertiagrouprange")
                found.groups = low, high
            if "settotalmass" in at:
                found.total_mass = compiler.number(at["settotalmass"], "settotalmass")
        for element in root.all("default"):
            found._collect(element, element.attributes.get("class", MAIN), {})
        return found

    def _collect(self, of: Element, name: str, above: dict[str, dict[str, str]]) -> None:
        own = {tag: dict(attributes) for tag, attributes in above.items()}
        own |= {tag: dict(values) for tag, values in self.defaults.get(name, {}).items()}
        for each in of.children:
            if each.tag != "default":
                own.setdefault(each.tag, {}).update(each.attributes)
        self.defaults[name] = own
        for each in of.all("default"):
            self._collect(each, each.name("class"), own)

    def with_defaults(self, element: Element, childclass: str) -> dict[str, str]:
        """Attributes of an element over those of its class, of the body's, or of all."""
        name = element.attributes.get("class", childclass) or MAIN
        if name != MAIN and name not in self.defaults:
            element.refuse(f"no default class is called {shown(name)}")
        return self.defaults.get(name, {}).get(element.tag, {}) | element.attributes

    def counts(self, group: float) -> bool:
        """Whether geoms of a group have a mass."""
        return self.groups[0] <= group <= self.groups[1]

    def place(self, element: Element, attributes: dict[str, str] | None = None) -> Array:
        """Frame of an element: its ``pos`` and whichever way its orientation is written."""
        at = element.attributes if attributes is None else attributes
        return frame(
            self._orientation(element, at),
            np.array(element.numbers(at.get("pos", "0 0 0"), 3, "pos")),
        )

    def _orientation(self, element: Element, at: dict[str, str]) -> Array:
        if "quat" in at:
            return rotation_quaternion(*element.numbers(at["quat"], 4, "quat"))
        if "axisangle" in at:
            *axis, angle = element.numbers(at["axisangle"], 4, "axisangle")
            return rotation_about(_unit(element, np.array(axis)), angle * self.angle)
        if "xyaxes" in at:
            six = element.numbers(at["xyaxes"], 6, "xyaxes")
            x = _unit(element, np.array(six[:3]))
            y = np.array(six[3:])
            y = _unit(element, y - x @ y * x)
            return np.column_stack([x, y, np.cross(x, y)])
        if "zaxis" in at:
            return turn_to(_unit(element, np.array(element.numbers(at["zaxis"], 3, "zaxis"))))
        made = np.eye(3)
        if "euler" in at:
            for letter, angle in zip(
                self.sequence, element.numbers(at["euler"], 3, "euler"), strict=True
            ):
                turned = rotation_about(_AXES[letter.lower()], angle * self.angle)
                made = made @ turned if letter.islower() else turned @ made
        return made


def turn_to(direction: Array) -> Array:
    """Shortest rotation of the z axis to a unit direction, shape (3, 3)."""
    axis = np.cross([0.0, 0.0, 1.0], direction)
    size = float(np.linalg.norm(axis))
    if size < 1e-12:
        return np.eye(3) if direction[2] > 0.0 else np.diag([1.0, -1.0, -1.0])
    return rotation_about(axis / size, float(np.arctan2(size, direction[2])))


def _unit(element: Element, vector: Array) -> Array:
    length = float(np.linalg.norm(vector))
    if length < 1e-9:
        element.refuse("an axis has no direction")
    return np.asarray(vector / length)
