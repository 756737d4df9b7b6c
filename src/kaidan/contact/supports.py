"""What the poses of a path stand on, and what friction and grousers make of it."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from kaidan.contact.columns import LOAD_COLUMNS, SUPPORT_COLUMNS, SUPPORT_POINT
from kaidan.contact.path import Path
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray

#: Supports of a pose for which there is room at first.
ROOM = 4


class Grousers(NamedTuple):
    """Grousers under load, and the nosings that they meet: one case of what is given as ranges."""

    height: float
    """Under load [m]."""
    spacing: float
    """[m]"""
    tip_width: float
    """Along the belt [m]."""
    nosing_radius: float
    """[m]"""
    rigid: bool
    """Whether they are rigid and sharp: of several nosings two carry, and one that has passed a
    nosing rolls off it. Else they share the load, and are worn round."""


class Supports:
    """Supports of every pose of a path: its two contacts, and nosings under a flat beside them.

    Parameters
    ----------
    path
        n poses.
    force
        Sum of the contact forces of each pose, along and up (n,) [N/kg].
    coulomb
        Angle of friction that smooth belts require at each (n,) [rad].
    treads
        Tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none.
    climbs
        Whether it leads up the stairs.
    steep
        Slope beyond which the ground is a face [rad].
    touch
        Gap up to which a nosing lies on a flat [m].
    """

    def __init__(
        self, path: Path, *, force: tuple[FloatArray, FloatArray], coulomb: FloatArray,
        treads: FloatArray, climbs: bool, steep: float, touch: float,
    ) -> None:  # fmt: skip
        self._climbs = climbs
        self._loads = np.empty((len(path.poses), LOAD_COLUMNS))
        self._loads[:] = np.stack([*force, coulomb], axis=1)
        bodies, parts = path.body.table, len(path.body.table)
        if path.bodies is not None:
            bodies = np.ascontiguousarray(path.bodies).reshape(-1, bodies.shape[1])
        self._slots, most = 0, ROOM
        while most > self._slots:
            self._slots = most
            self._table = np.empty((len(path.poses) * most, SUPPORT_COLUMNS))
            most = kernel().find_supports(
                path.ground.table, bodies, parts, path.bodies is not None, path.poses.table,
                treads, climbs, steep, touch, path.reach, self._table, self._slots,
            )  # fmt: skip

    @property
    def points(self) -> IntArray:
        """Points of the ground at which grousers may stand (n, supports of a pose); -1: none."""
        return self._table[:, SUPPORT_POINT].astype(np.int64).reshape(-1, self._slots)

    @cached_property
    def _like(self) -> IntArray:
        """Of each pose the first one that stands alike: a regular flight repeats itself."""
        like, unlike = np.empty((2, len(self._loads)), dtype=np.int64)
        kernel().find_alike(self._table, self._slots, self._loads, unlike, like)
        return like

    def belt_margins(self, phi: tuple[float, float, float], height: float) -> FloatArray:
        """Angle by which the cones of belts may shrink without a grouser that stands (n,) [rad].

        Parameters
        ----------
        phi
            Angles of friction of nosings, treads and riser faces [rad].
        height
            Of rigid grousers, which on an end's arc hold less at a face than a smooth belt [m].
        """
        found = np.empty(len(self._loads))
        kernel().belt_margins(
            self._table, self._slots, self._loads, self._like, *phi, height, found
        )
        return found

    def standing_margins(self, phi: tuple[float, float, float], grousers: Grousers) -> FloatArray:
        """Margin with a grouser that stands at each support (n, supports of a pose) [rad].

        Parameters
        ----------
        phi
            Angles of friction of nosings, treads and riser faces [rad].
        grousers
            On the belts.

        Returns
        -------
        ndarray
            Minus infinity where none can stand.
        """
        found = np.empty(len(self._table))
        kernel().standing_margins(
            self._table, self._slots, self._loads, self._like, *phi, *grousers,
            1.0 if self._climbs else -1.0, found,
        )  # fmt: skip
        return found.reshape(-1, self._slots)
