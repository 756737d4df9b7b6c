r"""With how much to spare friction and grousers hold the robot at every pose of a traverse.

::

      slips back by a spacing s           contact      with a grouser on it     else
    <-----------------.                   nosing       stands on the tread      Coulomb
    | .  '    belt    |  .  '             riser face   over the edge, if low    Coulomb
    ' nosing j      stands                tread, floor                          Coulomb

A pose holds by friction alone; or by a grouser that comes to stand on a nosing, or over the edge of
a riser's face, before the robot has slipped back by a spacing of the grousers. One and the same
nosing must do at every pose of that slip, or friction. Going down the slip leads on, and may pass
over as much again that nothing holds (docs/theory/grousers.md).
"""

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import Grousers
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.grousers import slip_height
from kaidan.terrain.polyline import STEEP
from kaidan.traversal.nosing_events import TOUCH

Array = NDArray[np.float64]

TREAD_DEPTH = 0.040
"""Depth of a tread behind its nosing that grousers stand on [m]: of 20 mm at 30 degrees."""


class Grip:
    """Supports of every pose of a path, and what friction and grousers make of them.

    acceleration: along the path [m/s^2].
    """

    def __init__(self, path: contact.Path, *, descending: bool, acceleration: float) -> None:
        assert path.margins is not None
        self.path, self.descending = path, descending
        self.coulomb = np.arctan(path.margins.required_friction)
        """Angle of friction that smooth belts require, the same friction everywhere [rad]."""
        a, g, psi = acceleration, STANDARD_GRAVITY, path.poses.path_direction
        size = np.sqrt(g * g + a * a + 2.0 * g * a * np.sin(psi))
        down = np.hypot(1.0, path.margins.tilt)
        self._supports = contact.Supports(
            path,
            force=(size * path.margins.tilt / down, size / down),
            coulomb=self.coulomb,
            treads=treads_of(path.ground, descending),
            climbs=not descending,
            steep=STEEP,
            touch=TOUCH,
        )
        self._points = self._supports.points
        self._known: dict[Grousers, Array] = {}

    def by_friction(self, phi: tuple[float, float, float], height: float = 0.0) -> Array:
        """Angle by which the cones of belts may shrink without a grouser that stands [rad].

        phi: angles of friction of nosings, treads and riser faces [rad].
        height: of rigid grousers, which on an end's arc hold less at a face than a smooth belt [m].
        """
        if phi[0] == phi[1] == phi[2] and height <= 0.0:
            return np.asarray(phi[0] - self.coulomb)
        return self._supports.belt_margins(phi, height)

    def with_grousers(
        self,
        phi: tuple[float, float, float],
        grousers: Grousers,
        by_friction: Array,
        *,
        passing: bool = True,
    ) -> Array:
        """Angle by which the cones may shrink before the robot slips for good [rad].

        phi: angles of friction of nosings, treads and riser faces [rad].
        by_friction: what `by_friction` found.
        passing: whether a slip down the stairs, going down, may pass over what nothing holds: it is
            two spacings long at most then, else one.
        """
        return contact.held_while_slipping(
            self.path.poses,
            self._points,
            self._standing(phi, grousers),
            by_friction,
            way=grousers.spacing + contact.STEP,
            over=grousers.spacing if passing else 0.0,
            ahead=self.descending,
        )

    def at_once(
        self, phi: tuple[float, float, float], grousers: Grousers, by_friction: Array
    ) -> Array:
        """Angle by which the cones may shrink with grousers that stand already [rad].

        phi, grousers, by_friction: as for `with_grousers`.
        """
        standing = np.where(self._points == -1, -np.inf, self._standing(phi, grousers))
        return np.asarray(np.maximum(by_friction, standing.max(axis=1)))

    def slip_heights(self, slip: float, *, mu_k: float) -> Array:
        """Kinetic-energy height that the robot gains as it slips back from each pose [m].

        slip: how far at most, along the path [m].
        mu_k: sliding friction [1].
        """
        path, s = self.path, self.path.s
        required = np.tan(np.maximum(self.coulomb, 1e-9))
        psi = np.abs(path.poses.path_direction)
        gain = slip_height(psi=psi, s=1.0, mu_k=mu_k, mu_required=required)
        gained = np.zeros(len(s))
        np.cumsum(0.5 * (gain[1:] + gain[:-1]) * np.diff(s), out=gained[1:])
        way = slip if self.descending else -slip
        return np.abs(gained - np.interp(s + way, s, gained))

    def _standing(self, phi: tuple[float, float, float], grousers: Grousers) -> Array:
        """Margin of each pose with a grouser that stands at each of its contacts [rad].

        Of one friction everywhere it is that friction's angle less what is required without any,
        which is worked out once.
        """
        if not phi[0] == phi[1] == phi[2]:
            return self._supports.standing_margins(phi, grousers)
        if grousers not in self._known:
            smooth = (0.0, 0.0, 0.0)
            self._known[grousers] = self._supports.standing_margins(smooth, grousers)
        return np.asarray(phi[0] + self._known[grousers])


def treads_of(ground: contact.Ground, descending: bool) -> Array:
    """Tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none."""
    x, z = ground.x, ground.z
    uphill = -1.0 if descending else 1.0
    there = np.interp(x + uphill * TREAD_DEPTH, x + 1e-12 * np.arange(len(x)), z)
    slope = np.arctan2(uphill * (there - z), TREAD_DEPTH)
    return np.where(np.abs(slope) < STEEP, -slope, np.nan)
