"""Forces between the robot and the stairs, read from the engine after a step."""

import numpy as np
from numpy.typing import NDArray

from kaidan.physics.model import Model

Array = NDArray[np.float64]


class Forces:
    """Reader of a model's contact forces."""

    def __init__(self, model: Model) -> None:
        self.model = model
        along = model.course.along
        self.along = np.array([along[0], 0.0, along[1]])
        self.normal = np.array([-along[1], 0.0, along[0]])
        self.elliptic = bool(model.compiled.opt.cone)
        self.count = len(model.course.profile.nosings)
        names = () if model.motion is None else model.motion.geoms
        self.grousers = np.full(model.compiled.ngeom, -1)
        """Number of each geom's grouser; -1: none."""
        self.grousers[[model.compiled.geom(name).id for name in names]] = np.arange(len(names))

    def read(self, data: object) -> tuple[Array, Array, int]:
        """Forces at this moment.

        Returns
        -------
        force on the robot from each nosing along their line and normal to it [N], (nosings, 2)
        force on each grouser likewise [N], (grousers, 2)
        """
        by_nosing = np.zeros((self.count, 2))
        by_grouser = np.zeros((int(self.grousers.max()) + 1, 2))
        contact = data.contact  # type: ignore[attr-defined]
        row = contact.efc_address
        geoms = contact.geom
        number = self.model.number_of[geoms]
        # stairs against robot, and nothing within the robot
        real = (row >= 0) & ((number == -2).sum(axis=1) == 1)
        if not real.any():
            return by_nosing, by_grouser, 0
        row, number, frame = row[real], number[real], contact.frame[real].reshape(-1, 3, 3)
        grouser = self.grousers[geoms[real]].max(axis=1)
        first_is_stairs = number[:, 0] != -2
        number = np.where(first_is_stairs, number[:, 0], number[:, 1])
        in_frame = self._in_frame(data, row, contact.friction[real, 0])
        # the contact's x axis points from its first geom to its second
        sign = np.where(first_is_stairs, 1.0, -1.0)[:, None]
        force = sign * np.einsum("ik,ikj->ij", in_frame, frame)
        both = force @ np.column_stack([self.along, self.normal])
        for table, of in ((by_nosing, number), (by_grouser, grouser)):
            np.add.at(table, of[of >= 0], both[of >= 0])
        return by_nosing, by_grouser, len(row)

    def _in_frame(self, data: object, row: NDArray[np.int32], friction: Array) -> Array:
        """Normal and two tangential forces of contacts [N], shape (contacts, 3)."""
        force: Array = data.efc_force  # type: ignore[attr-defined]
        if self.elliptic:
            return np.asarray(force[row[:, None] + np.arange(3)])
        edges = force[row[:, None] + np.arange(4)]
        return np.column_stack(
            [
                edges.sum(axis=1),
                friction * (edges[:, 0] - edges[:, 1]),
                friction * (edges[:, 2] - edges[:, 3]),
            ]
        )
