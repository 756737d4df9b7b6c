r"""With how much to spare friction and grousers hold the robot at every pose of a traverse.

::

      slips back by a spacing s           contact      with a grouser on it     else
    <-----------------.                   nosing       stands on the tread      Coulomb
    | .  '    belt    |  .  '             riser face   over the edge, if low    Coulomb
    ' nosing j      stands                tread, floor                          Coulomb

A pose holds by friction alone; or by a grouser that comes to stand on a nosing, or over the edge of
a riser's face, before the robot has slipped back by a spacing of the grousers. One and the same
nosing must do at every pose of that slip, or friction (docs/theory/grousers.md).
"""

import math
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.grousers import (
    face_friction,
    phases_friction,
    roll_off_length,
    roll_off_sine,
    slip_height,
    standing_friction,
    standing_run,
    tip_tilt,
)
from kaidan.mechanics.grousers_at_edges import edge_tilt, reach_over_edge, tip_overlap
from kaidan.traversal.pose_contacts import FACE, NOSING, NOWHERE, TREAD, PoseContacts, contacts_of

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

MANY = 0.75
"""Share of the phases that counts where four nosings or more are under the belts [1]: fitted with
`phases_friction` (docs/theory/grousers.md)."""
ALIKE = 7
"""Digits to which contacts are compared: a tenth of a micrometre."""


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


class Grip:
    """Contacts of every pose of a path, and what friction and grousers make of them.

    Parameters
    ----------
    path : contact.Path
        With margins.
    descending : bool
        Whether it leads down the stairs.
    acceleration : float
        Along the path [m/s^2].
    """

    def __init__(self, path: contact.Path, *, descending: bool, acceleration: float) -> None:
        assert path.margins is not None
        self.path, self.descending = path, descending
        self._side = -1.0 if descending else 1.0
        self.contacts = contacts_of(path, descending)
        self.coulomb = np.arctan(path.margins.required_friction)
        """Angle of friction that smooth belts require, the same friction everywhere [rad]."""
        a, g, psi = acceleration, STANDARD_GRAVITY, path.poses.path_direction
        size = np.sqrt(g * g + a * a + 2.0 * g * a * np.sin(psi))
        down = np.hypot(1.0, path.margins.tilt)
        force = (size * path.margins.tilt / down, size / down)
        first, self._like = _alike(self.contacts, force, self.coulomb)
        self._unlike = PoseContacts._make(each[first] for each in self.contacts)
        self._force = (force[0][first], force[1][first])
        self._required = self.coulomb[first]
        self._known: dict[Grousers, Array] = {}

    def by_friction(self, phi: tuple[float, float, float], height: float = 0.0) -> Array:
        """Angle by which the cones of belts may shrink without a grouser that stands [rad].

        Parameters
        ----------
        phi : tuple of float
            Angles of friction of nosings, treads and riser faces [rad].
        height : float
            Of rigid grousers, which on an end's arc hold less at a face than a smooth belt [m].
        """
        at, alike = self._unlike, phi[0] == phi[1] == phi[2]
        if alike and height <= 0.0:
            return np.asarray(phi[0] - self.coulomb)
        found, judged = np.full(len(self._required), np.inf), np.ones(len(self._required), np.bool_)
        if alike:
            found = phi[0] - self._required
            judged = ((at.place == FACE) & at.is_one).any(axis=1)
        rows, i, j = (each[judged[self._pairs[0]]] for each in self._pairs)
        of_pairs = np.where(judged, -np.inf, np.inf)
        one, other = (self._belt(rows, k, phi, height) for k in (i, j))
        np.maximum.at(of_pairs, rows, self._margin(rows, i, j, one, other))
        return np.asarray(np.minimum(found, of_pairs)[self._like])

    def with_grousers(
        self, phi: tuple[float, float, float], grousers: Grousers, by_friction: Array
    ) -> Array:
        """Angle by which the cones may shrink before the robot slips for good [rad].

        Parameters
        ----------
        phi : tuple of float
            Angles of friction of nosings, treads and riser faces [rad].
        grousers : Grousers
            On the belts.
        by_friction : ndarray
            What `by_friction` found.
        """
        return contact.held_while_slipping(
            self.path.poses,
            self.contacts.point,
            self._standing(phi, grousers),
            by_friction,
            way=grousers.spacing + contact.STEP,
            ahead=self.descending,
        )

    def at_once(
        self, phi: tuple[float, float, float], grousers: Grousers, by_friction: Array
    ) -> Array:
        """Angle by which the cones may shrink with grousers that stand already [rad].

        Parameters
        ----------
        phi, grousers, by_friction
            As for `with_grousers`.
        """
        standing = np.where(self.contacts.point == NOWHERE, -np.inf, self._standing(phi, grousers))
        return np.asarray(np.maximum(by_friction, standing.max(axis=1)))

    def slip_heights(self, slip: float, *, mu_k: float) -> Array:
        """Kinetic-energy height that the robot gains as it slips back from each pose [m].

        Parameters
        ----------
        slip : float
            How far at most, along the path [m].
        mu_k : float
            Sliding friction [1].
        """
        path, s = self.path, self.path.s
        required = np.tan(np.maximum(self.coulomb, 1e-9))
        psi = np.abs(path.poses.path_direction)
        gain = slip_height(psi=psi, s=1.0, mu_k=mu_k, mu_required=required)
        gained = np.zeros(len(s))
        np.cumsum(0.5 * (gain[1:] + gain[:-1]) * np.diff(s), out=gained[1:])
        way = slip if self.descending else -slip
        return np.abs(gained - np.interp(s + way, s, gained))

    @cached_property
    def _pairs(self) -> tuple[Whole, Whole, Whole]:
        """Rows and two contacts each that may carry them: on either side of the centroid."""
        at = self._unlike
        w_x, w_z = self._force
        ahead = at.x - (w_x / w_z)[:, None] * at.z
        i, j = np.array(list(combinations(range(at.x.shape[1]), 2))).T
        both = at.is_one[:, i] & at.is_one[:, j]
        carries = (ahead[:, i] * ahead[:, j] <= 0.0) | ((i == 0) & (j == 1))
        rows, pair = np.nonzero(both & carries)
        return rows, i[pair], j[pair]

    def _belt(
        self, rows: Whole, k: Whole, phi: tuple[float, float, float], height: float = 0.0
    ) -> tuple[Array, Array]:
        """Axis and half angle of the cone under the belt."""
        at = self._unlike
        place, half = at.place[rows, k], np.array(phi)[at.place[rows, k]]
        at_face = face_friction(mu=np.tan(half), h=height, curvature=at.curvature[rows, k])
        return at.normal[rows, k], np.where(place == FACE, np.arctan(at_face), half)

    def _margin(
        self, rows: Whole, i: Whole, j: Whole, one: tuple[Array, Array],
        other: tuple[Array, Array], ahead: Array | float = 0.0,
    ) -> Array:  # fmt: skip
        """Margin of two contacts with their cones, the first so far ahead of its place [m]."""
        at, (w_x, w_z) = self._unlike, self._force
        alpha = at.normal[rows, i]
        first = at.x[rows, i] + ahead * np.cos(alpha), at.z[rows, i] - ahead * np.sin(alpha)
        second = at.x[rows, j], at.z[rows, j]
        return contact.cone_margins([*first, *one, *second, *other, w_x[rows], w_z[rows]])

    def _standing(self, phi: tuple[float, float, float], grousers: Grousers) -> Array:
        """Margin of each pose with a grouser that stands at each of its contacts [rad].

        Of one friction everywhere it is that friction's angle less what is required without any,
        which is worked out once.
        """
        if not phi[0] == phi[1] == phi[2]:
            return self._of_unlike(phi, grousers)[self._like]
        if grousers not in self._known:
            self._known[grousers] = self._of_unlike((0.0, 0.0, 0.0), grousers)[self._like]
        return np.asarray(phi[0] + self._known[grousers])

    def _of_unlike(self, phi: tuple[float, float, float], grousers: Grousers) -> Array:
        """The same of the poses that are unlike each other.

        Which two of several contacts carry depends on where grousers stand. So the least over the
        pairs counts: with that contact among them, or else with the better of the two.
        """
        at = self._unlike
        tips = self._tips(grousers)
        rows, i, j = self._pairs
        each = [self._stands(rows, k, o, phi, grousers, tips) for k, o in ((i, j), (j, i))]
        # of every contact of the pose: the one, the other or neither of the two
        k = np.arange(at.x.shape[1])
        own = np.where(k == j[:, None], each[1][:, None], np.maximum(*each)[:, None])
        own = np.where(k == i[:, None], each[0][:, None], own)
        found = np.full(at.x.shape, np.inf)
        np.minimum.at(found, rows, own)
        found = np.where(np.isinf(found) & (found > 0), -np.inf, found)
        several = at.is_one.sum(axis=1)[:, None]
        if (several > 2).any():
            theta = np.minimum(self._required, 1.5)[:, None]
            if grousers.rigid:
                q = np.maximum(tips.run, 0.0) / grousers.spacing
                needed = phases_friction(theta=theta, q=np.where(several > 3, MANY * q, q))
            else:  # all nosings share the load, and one with no less than its part will stand
                lean = np.clip(self._side * (tips.tilt - at.normal), 0.0, theta)
                needed = standing_friction(theta=theta, beta=theta - lean, share=1.0 / several)
            of_all = np.where(tips.may, phi[NOSING] - np.arctan(needed), -np.inf)
            found = np.where(several > 2, np.minimum(found, of_all), found)
        return found

    def _stands(
        self, rows: Whole, k: Whole, other: Whole, phi: tuple[float, float, float],
        grousers: Grousers, tips: "_Tips",
    ) -> Array:  # fmt: skip
        """Margin of two contacts, a grouser standing at the first; minus infinity: none can."""
        found = np.full(len(rows), -np.inf)
        may = tips.may[rows, k]
        rows, k, other = rows[may], k[may], other[may]
        found[may] = self._standing_there(rows, k, other, phi, grousers, tips)
        return found

    def _standing_there(
        self, rows: Whole, k: Whole, other: Whole, phi: tuple[float, float, float],
        grousers: Grousers, tips: "_Tips",
    ) -> Array:  # fmt: skip
        """The same where one can."""
        at, side = self._unlike, self._side
        tip, half = tips.tilt[rows, k], np.full(len(rows), phi[TREAD])
        axis, own = self._belt(rows, other, phi)
        if not grousers.rigid:
            return self._margin(rows, k, other, (tip, half), (axis, own))
        # on the tread the tip stands farther uphill: less of the load, if it is the upper contact
        upper = side * (at.x[rows, k] - at.x[rows, other]) > 0.0
        ahead = side * np.where(upper, tips.ahead[rows, k], 0.0)
        # the other may stand on the top of a grouser, or roll off a nosing with its edge
        on_nosing = (at.place[rows, other] == NOSING) & (at.point[rows, other] != NOWHERE)
        apart = np.hypot(at.x[rows, k] - at.x[rows, other], at.z[rows, k] - at.z[rows, other])
        axis = axis - side * np.where(on_nosing, grousers.height / np.maximum(apart, 1e-3), 0.0)
        gamma = np.where(on_nosing, tips.gamma[rows, k], 0.0)
        rolled = axis - side * np.arcsin(np.minimum(gamma, 1.0))
        margin = self._margin(rows, k, other, (tip, half), (rolled, own), ahead)
        rolls = gamma > 0.0
        tip, gamma, normal = tip[rolls], gamma[rolls], at.normal[rows, k][rolls]
        lean = side * (tip - normal)
        later = tip - side * (lean - np.arcsin(np.maximum(np.sin(lean) - gamma, 0.0)))
        then = self._margin(
            rows[rolls], k[rolls], other[rolls], (later, half[rolls]), (axis[rolls], own[rolls]),
            ahead[rolls],
        )  # fmt: skip
        margin[rolls] = np.minimum(margin[rolls], then)
        return margin

    def _tips(self, grousers: Grousers) -> "_Tips":
        """Tips of grousers as they come to stand at each contact."""
        at, (h, s, w, r, _), side = self._unlike, grousers, self._side
        leans = side * (at.tread - at.normal)
        with np.errstate(invalid="ignore", divide="ignore"):
            theta = np.clip(leans, 1e-6, math.pi / 2 - 1e-6)
            beta = tip_tilt(theta=theta, h=h, r=r, curvature=at.curvature)
            run = standing_run(theta=theta, h=h, s=s, r=r, w=w)
            off = roll_off_length(theta=theta, h=h, r=r)
            climb = np.sin(theta - beta)
            missed = np.minimum(run, 0.0) / max(r, 1e-6) if grousers.rigid else 0.0
            beta = theta - np.arcsin(np.maximum(climb + missed, 0.0))
            gamma = roll_off_sine(run=run, off=off, r=max(r, 1e-6))
            radius = 1.0 / at.curvature
            # the robot stands on its grousers, so the axle is higher by one
            lift = at.lift - h
            over = edge_tilt(overlap=tip_overlap(R=radius, h=h, s=s, lift=lift), r=r)
            low = lift <= reach_over_edge(R=radius, h=h, s=s)
        leant = ~np.isnan(at.lift)
        may = (at.point != NOWHERE) & (h > 0.0) & (leans > 0.0)
        may &= np.where(leant, low, (leans < math.pi / 2) & (beta < theta))
        tilt = np.asarray(np.where(leant, over, beta))
        return _Tips(
            may=may,
            tilt=at.tread - side * tilt,
            run=np.where(may & ~leant, run, 0.0),
            gamma=np.where(may & ~leant, gamma, 0.0),
            ahead=np.where(may & ~leant, np.maximum(run, 0.0) + r * climb, 0.0),
        )


class _Tips(NamedTuple):
    """Tips of grousers as they come to stand at each contact, shape (poses, most contacts)."""

    may: NDArray[np.bool_]
    """Whether one can stand there."""
    tilt: Array
    """Tilt of the normal under it, towards where the robot drives [rad]."""
    run: Array
    """Length along the belt over which it stands on the tread [m]."""
    gamma: Array
    """Sine of the tilt that it loses while another rolls off its nosing [1]."""
    ahead: Array
    """Of the nosing, along the belt [m]."""


def _alike(at: PoseContacts, force: tuple[Array, Array], required: Array) -> tuple[Whole, Whole]:
    """First rows of poses whose contacts are alike, and for each pose the number of its first.

    A regular flight repeats itself; which point of the ground a contact has does not matter.
    """
    columns = [
        np.where(at.is_one, each, 0.0)
        for each in (at.x, at.z, at.normal, at.place, at.point == NOWHERE, at.tread, at.curvature)
    ]
    columns += [at.is_one, at.lift, *(each[:, None] for each in (*force, required))]
    table = np.round(np.nan_to_num(np.hstack(columns), nan=9.0, posinf=9e3), ALIKE)
    numbers: dict[bytes, int] = {}
    like = np.array([numbers.setdefault(row.tobytes(), len(numbers)) for row in table + 0.0])
    first = np.full(len(numbers), len(like))
    np.minimum.at(first, like, np.arange(len(like)))
    return first, like
