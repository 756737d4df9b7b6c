"""What the poses of a path stand on, and what friction and grousers make of it."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from kaidan.contact.door import zeros
from kaidan.contact.layout import Friction, Grousers, Load, Stance, Support
from kaidan.contact.path import Path
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray

#: Supports of a pose for which there is room at first.
ROOM = 4


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
        self._loads = zeros(Load, len(path.poses))
        self._loads["x"], self._loads["z"] = force
        self._loads["coulomb"] = coulomb
        bodies = path.body.table if path.bodies is None else path.bodies.ravel()
        stance, parts = Stance(climbs, steep, touch, path.reach), len(path.body)
        self._slots, most = 0, ROOM
        while most > self._slots:
            self._slots = most
            self._table = zeros(Support, len(path.poses) * most)
            most = kernel().find_supports(
                (path.ground.table, bodies), parts, path.poses.table, treads, stance, self._table,
                self._slots,
            )  # fmt: skip

    @property
    def points(self) -> IntArray:
        """Points of the ground at which grousers may stand (n, supports of a pose); -1: none."""
        return self._table["point"].reshape(-1, self._slots)

    @cached_property
    def _like(self) -> IntArray:
        """Of each pose the first one that stands alike: a regular flight repeats itself."""
        like = np.empty(len(self._loads), dtype=np.int64)
        kernel().find_alike(self._table, self._slots, self._loads, like)
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
            self._table, self._slots, self._loads, self._like, Friction(*phi), height, found
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
            self._table, self._slots, self._loads, self._like, Friction(*phi), grousers,
            1.0 if self._climbs else -1.0, found,
        )  # fmt: skip
        return found.reshape(-1, self._slots)
