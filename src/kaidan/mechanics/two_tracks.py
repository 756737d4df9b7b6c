r"""Both tracks on nosings that differ from left to right: roll, twisted treads, yaw.

::

        left track   o------o------o-----o     Each track touches points under its middle. The rigid
                     :\    /:\    /:    /      underside rests on a facet of the upper hull of all
                     : \  / : \  / :   /       of them; it tips where effective gravity through the
                     :  \/  :  \/  :  /        centroid leaves the polygon of the contacts: over its
        right track  o------o------o---o       edge downhill, uphill, or over either side.

All is written in the plane that fits the nosings: u up the slope, y to the left, w square to it;
r lies along the heading, which is off u by the yaw psi.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY, Number

Array = NDArray[np.float64]

_JUST = 1e-6
"""Distance by which a position lies beside the one at which a contact is made or lost [m]."""


class TwoTrackMargins(NamedTuple):
    """Smallest margins over all positions on a flight, and the roll [rad]; NaN: no position."""

    downhill: float
    uphill: float
    sideways: float
    roll: float
    """Largest roll of the body, either way."""


def track_points(
    *, u: Array, w: Array, u_across: Array, w_across: Array, psi: float, y: float
) -> Array:
    """Places at which a track crosses nosings.

    ``r = (u + y (u' cos(psi) + sin(psi))) / cos(psi)``, ``w + y w' cos(psi)``

    Assumptions: the middle of the robot passes over the middle of every nosing.

    Parameters
    ----------
    u, w : array, shape (m,)
        Middles of the nosings up the slope and square to it [m].
    u_across, w_across : array, shape (m,)
        Their change along the nosing, over the distance to the left [1].
    psi : float
        Yaw off the line of the flight, to the left positive [rad], within (-pi/2, pi/2).
    y : float
        Track to the left of the robot's middle [m].

    Returns
    -------
    array, shape (m, 2)
        r and w [m].

    Examples
    --------
    >>> zero = np.array([0.0])
    >>> track_points(u=zero, w=zero, u_across=zero, w_across=zero, psi=np.pi / 4, y=0.2).round(6)
    array([[0.2, 0. ]])

    References
    ----------
    Derived; of straight nosings the two tracks stand `kaidan.mechanics.oblique.track_lag` apart.
    """
    r = (u + y * (u_across * np.cos(psi) + np.sin(psi))) / np.cos(psi)
    return np.column_stack([r, w + y * w_across * np.cos(psi)])


def edge_tilt(*, inward: Number, height: Number, lean: Number) -> Number:
    """Angle by which gravity may lean further until the robot tips over an edge.

    ``atan2(inward, height) - lean``

    Parameters
    ----------
    inward : float or array
        Centroid from the edge towards the middle of the support, in its plane [m].
    height : float or array
        Centroid above that plane [m].
    lean : float or array
        Effective gravity against the plane's normal, towards the edge positive [rad].

    Returns
    -------
    float or array
        Margin [rad], positive when safe.

    Examples
    --------
    >>> print(round(edge_tilt(inward=0.1, height=0.1, lean=np.pi / 6) * 180 / np.pi, 9))
    15.0

    References
    ----------
    Derived; over the lowest nosing of a regular flight the closed form's theta_s_sup - theta_s.
    """
    return np.arctan2(inward, height) - lean


def two_track_margins(
    *,
    left: Array,
    right: Array,
    gauge: float,
    L: float,
    C_L: float,
    C_N: float,
    theta_s: float,
    psi: float = 0.0,
    a: float = 0.0,
    g: float = STANDARD_GRAVITY,
) -> TwoTrackMargins:
    """Margins of a robot on the points under both tracks, worst over all positions on the flight.

    Assumptions: rigid tracks that touch under their middles; centroid midway between them; slow;
    the whole underside on the flight; positions with fewer than two points under a track are left
    out.

    Parameters
    ----------
    left, right : array, shape (m, 2)
        Points under each track from bottom to top: r and w [m], see `track_points`.
    gauge : float
        Distance between the middles of the tracks [m].
    L, C_L, C_N : float
        Flat length; centroid behind its uphill end and above it [m].
    theta_s : float
        Slope of the plane in which the points are written [rad].
    a : float
        Acceleration along the heading [m/s^2].

    Returns
    -------
    TwoTrackMargins

    Examples
    --------
    Kenaf of the paper on 45 degrees at 150 mm: its 60.2 degrees, less 45.

    >>> line = np.column_stack([0.15 * np.arange(12), np.zeros(12)])
    >>> found = two_track_margins(
    ...     left=line, right=line, gauge=0.33, L=0.47, C_L=0.196, C_N=0.071, theta_s=np.pi / 4
    ... )
    >>> print(round(found.downhill * 180 / np.pi, 2))
    15.21

    References
    ----------
    Derived: the underside settles where its centroid is lowest, on the facet of the upper hull over
    which effective gravity passes. For straight nosings `kaidan.mechanics.oblique`.
    """
    slope = np.sin(theta_s)
    up = np.array([slope * np.cos(psi) + a / g, -slope * np.sin(psi), np.cos(theta_s)])
    foot = C_N * up[:2] / up[2]
    share = np.clip(0.5 - foot[1] / gauge, 0.0, 1.0)  # of the left track
    margins = []
    for front, each in _positions(left, right, L):
        ends = [_Plane.on(alpha, each, gauge) for alpha in _at_the_ends(*each)]
        rest = _Plane.on(_settled(each, share, front - C_L - foot[0]), each, gauge)
        (down, uphill), (port, starboard) = ends, each
        margins.append(
            (
                down.tilt(
                    _at(port[0], gauge / 2), _at(starboard[0], -gauge / 2), front, C_L, C_N, up
                ),
                uphill.tilt(
                    _at(starboard[-1], -gauge / 2), _at(port[-1], gauge / 2), front, C_L, C_N, up
                ),
                rest.over_its_sides(gauge, C_N, up),
                rest.roll(up),
            )
        )
    if not margins:
        return TwoTrackMargins(*(np.nan,) * 4)
    down_, up_, side, roll = np.array(margins).T
    return TwoTrackMargins(
        float(down_.min()), float(up_.min()), float(side.min()), float(np.abs(roll).max())
    )


def _positions(left: Array, right: Array, L: float) -> Iterator[tuple[float, tuple[Array, Array]]]:
    """Front ends of the underside and points below it, beside every gain and loss of a contact."""
    sides = (left, right)
    first = max(side[0, 0] for side in sides) + L
    last = min(side[-1, 0] for side in sides)
    r = np.concatenate([left[:, 0], right[:, 0]])
    events = np.unique(np.concatenate([r - _JUST, r + L + _JUST]))
    for front in events[(events >= first) & (events <= last)]:
        port, starboard = (
            side[(side[:, 0] >= front - L) & (side[:, 0] <= front)] for side in sides
        )
        if min(len(port), len(starboard)) >= 2:
            yield float(front), (port, starboard)


def _at_the_ends(left: Array, right: Array) -> tuple[float, float]:
    """Inclinations of the facets at the edge downhill and at the edge uphill, over the plane."""
    rises = [(side[1:] - side[0]).T for side in (left, right)]
    falls = [(side[-1] - side[:-1]).T for side in (left, right)]
    return (
        max(float((w / r).max()) for r, w in rises),
        min(float((w / r).min()) for r, w in falls),
    )


def _settled(each: tuple[Array, Array], share: float, foot: float) -> float:
    """Inclination at which the foot of the centroid is lowest, with these points below."""
    slopes = []
    for side in each:
        one, two = np.triu_indices(len(side), 1)
        away = side[two] - side[one]
        slopes.append(away[:, 1] / away[:, 0])
    alpha = np.concatenate(slopes)
    port, starboard = ((side[:, 1] - alpha[:, None] * side[:, 0]).max(axis=1) for side in each)
    return float(alpha[np.argmin(share * port + (1 - share) * starboard + alpha * foot)])


class _Plane(NamedTuple):
    """Underside on points: inclined along the heading, and higher on one side."""

    alpha: float
    beta: float
    height: float
    """In the middle at r = 0 [m]."""

    @classmethod
    def on(cls, alpha: float, each: tuple[Array, Array], gauge: float) -> "_Plane":
        port, starboard = (float((side[:, 1] - alpha * side[:, 0]).max()) for side in each)
        return cls(alpha, (port - starboard) / gauge, (port + starboard) / 2)

    @property
    def axes(self) -> tuple[Array, Array, Array]:
        """Ahead, left and normal."""
        normal = np.array([-self.alpha, -self.beta, 1.0])
        normal /= np.sqrt(normal @ normal)
        ahead = np.array([1.0, 0.0, self.alpha]) / np.hypot(1.0, self.alpha)
        return ahead, np.cross(normal, ahead), normal

    def roll(self, up: Array) -> float:
        """Roll against the horizontal, left side up positive."""
        _, left, normal = self.axes
        return float(np.arctan2(up @ left, up @ normal))

    def tilt(
        self, begin: Array, end: Array, front: float, C_L: float, C_N: float, up: Array
    ) -> float:
        """Margin over an edge, the support on its left seen from above."""
        ahead, _, normal = self.axes
        centroid = np.array([front, 0.0, self.height + self.alpha * front])
        centroid = centroid - C_L * ahead + C_N * normal
        way = (end - begin) / np.sqrt((end - begin) @ (end - begin))
        inward = np.cross(normal, way)
        away = centroid - begin
        lean = np.arctan2(up @ inward, up @ normal)
        return float(edge_tilt(inward=away @ inward, height=away @ normal, lean=lean))

    def over_its_sides(self, gauge: float, C_N: float, up: Array) -> float:
        """Margin over the lower of its two sides."""
        lean = abs(self.roll(up))
        return float(edge_tilt(inward=gauge / 2, height=C_N, lean=lean))


def _at(point: Array, y: float) -> Array:
    return np.array([point[0], y, point[1]])
