"""What a file can hold before anybody interprets it: points, a mesh, heights, or bodies.

Coordinates are the file's own. `metres` and `upright` make metres with z up of them once unit and
up axis are known.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

Unit = Literal["m", "cm", "mm", "in", "ft"]
Axis = Literal["+x", "-x", "+y", "-y", "+z", "-z"]
How = Literal["file", "format", "person", "scored", "assumed"]
"""How something is known: stated in the file, fixed by the format, stated by the person, the one
value that makes stairs of it, or taken for granted."""

METRES: Mapping[str, float] = MappingProxyType(
    {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
)
"""Length of each unit [m]."""
UNITS: tuple[Unit, ...] = get_args(Unit)
AXES: tuple[Axis, ...] = get_args(Axis)


@dataclass(frozen=True)
class Known:
    """A fact about a file, and how it is known."""

    value: str
    how: How


@dataclass(frozen=True)
class Provenance:
    """Where something was read: enough to read it again and to see whether it has changed."""

    path: str
    digest: str
    """SHA-256 of the file."""
    form: str
    """Name of the format, see `recognition`."""
    element: str = ""
    """Part of the file: a GlobalId, a topic, a scan, a link."""
    unit: Known | None = None
    """None: the file does not say."""
    up: Known | None = None
    """Axis of the file that points up; None: the file does not say."""
    notes: tuple[str, ...] = ()
    """What the reader had to do or to leave out, as sentences."""


@dataclass(frozen=True, eq=False)
class Points:
    """A point cloud."""

    xyz: Array
    """Shape (n, 3), in the file's frame and unit; NaN in the rows of invalid points."""
    provenance: Provenance
    grid: tuple[int, int] | None = None
    """Rows and columns of an organised cloud, of which `xyz` is the rows one after another."""
    viewpoint: Array | None = None
    """Where the sensor stood, shape (3,), in the file's frame; None: the file does not say."""
    total: int = 0
    """Points in the file, where the reader thinned them; 0: as many as here."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """A surface of triangles."""

    vertices: Array
    """Shape (n, 3), in the file's frame and unit."""
    faces: Indices
    """Rows of `vertices`, shape (m, 3)."""
    provenance: Provenance


@dataclass(frozen=True, eq=False)
class Heights:
    """An elevation map: one height for each cell."""

    z: Array
    """Shape (rows, columns), up is positive; NaN where nothing is known."""
    cell: tuple[float, float]
    """Distance of the middles of neighbouring rows, and of columns, in the file's unit."""
    provenance: Provenance
    sigma: Array | None = None
    """Standard uncertainty of each height, like `z`; None: the file does not say."""


@dataclass(frozen=True, eq=False)
class Body:
    """One thing of a building or a robot: an element, a link."""

    identity: str
    """What it is called without doubt: a GlobalId, the name of a link."""
    name: str
    category: str
    """What the file calls this sort of thing: IfcStairFlight, link."""
    parent: str = ""
    """Identity of the body that it belongs to or hangs from."""
    placement: Array = field(default_factory=lambda: np.eye(4))
    """Own frame to that of the file, shape (4, 4)."""
    vertices: Array = field(default_factory=lambda: np.zeros((0, 3)))
    """In its own frame, shape (n, 3)."""
    faces: Indices = field(default_factory=lambda: np.zeros((0, 3), dtype=np.int64))
    facts: Mapping[str, Any] = field(default_factory=dict)
    """What else the file says of it: property sets, inertia, joints, primitive shapes."""


@dataclass(frozen=True, eq=False)
class Bodies:
    """The elements of a building model, or the links of a robot."""

    bodies: tuple[Body, ...]
    provenance: Provenance
    facts: Mapping[str, Any] = field(default_factory=dict)
    """What the file says of the whole: storeys, schema, the robot's name."""

    def __getitem__(self, identity: str) -> Body:
        for body in self.bodies:
            if body.identity == identity:
                return body
        raise KeyError(identity)


def upright(up: str) -> Array:
    """Rotation, shape (3, 3), that maps an axis of the file to z up; right-handed stays so.

    Examples
    --------
    >>> upright("+x") @ [1.0, 0.0, 0.0]
    array([0., 0., 1.])
    """
    axis = "xyz".index(up[1])
    turn = np.roll(np.eye(3), axis + 1, axis=1)  # a cyclic change of axes is a rotation
    return turn if up[0] == "+" else np.diag([1.0, -1.0, -1.0]) @ turn
