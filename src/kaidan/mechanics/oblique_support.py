"""Tipping with a yaw: over the edges of the support that two tracks have on oblique nosings."""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.oblique import oblique_spacing, track_lag
from kaidan.mechanics.validity import validity


def other_offset(*, p: Number, psi: Number, gauge: Number) -> Number:
    """Distance of the left track's lowest contact from the rear tip as the right one loses its own.

    ``q - ((-gauge tan(psi)) mod q)``, ``q = p / cos(psi)``, within (0, q]

    Just then the right track's lowest contact is q from its rear tip. With -psi: the same of the
    right track as the left one loses its own; and, from the front tip backward, of the right track
    as the left one is about to gain a contact.

    Parameters
    ----------
    gauge : float or array
        Distance between the middles of the two tracks [m].

    Returns
    -------
    float or array
        Distance [m]; NaN for |psi| >= pi/2. At psi = 0 both tracks lose at once, and it is q.

    Examples
    --------
    >>> print(round(other_offset(p=0.1, psi=np.arctan(0.25), gauge=0.1), 12))
    0.025

    References
    ----------
    Derived: on the left track the nosings stand `kaidan.mechanics.oblique.track_lag` farther ahead.
    """
    q = oblique_spacing(p=p, psi=psi)
    return q - np.mod(-track_lag(gauge=gauge, psi=psi), q)


def edge_slack(
    *,
    x: Number,
    kappa: Number,
    C_N: Number,
    theta_s: Number,
    a: Number,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Distance along the track from the zero moment point to an edge of the support, downhill.

    ``x - C_N (kappa tan(theta_s) + a / (g cos(theta_s)))``

    The edge joins the lowest contacts of both tracks, r and l from the rear tips. Then
    ``x = L - C_L - (l + r)/2`` and ``kappa = cos(psi) + (l - r) sin(psi) / gauge``: the point
    leans across by C_N tan(theta_s) sin(psi), where the edge stands elsewhere. For the edge uphill,
    which joins the highest contacts, r and l behind the front tips, it is minus the slack with
    ``x = (l + r)/2 - C_L`` and ``kappa = cos(psi) - (l - r) sin(psi) / gauge``.

    Assumptions: centroid midway between the tracks, each touching under its middle.

    Parameters
    ----------
    x : float or array
        Middle of the edge downhill of the centroid [m].
    kappa : float or array
        Share of the slope's load that counts [1].
    C_N : float or array
        Height of the centroid above the underside [m].
    a : float or array
        Acceleration along the heading [m/s^2].

    Returns
    -------
    float or array
        Slack [m], positive when safe (downhill; uphill with the sign reversed).

    Examples
    --------
    >>> print(round(edge_slack(x=0.124, kappa=1.0, C_N=0.071, theta_s=np.pi / 4, a=0.0), 12))
    0.053

    References
    ----------
    Derived; for psi = 0 `kaidan.mechanics.margin.centroid_margin_downhill`.
    """
    return x - C_N * (kappa * np.tan(theta_s) + a / (g * np.cos(theta_s)))


def edge_limit(
    *, x: Number, kappa: Number, C_N: Number, a: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Slope at which the zero moment point reaches an edge of the support.

    ``kappa tan(theta) + a / (g cos(theta)) = x / C_N`` solved for theta:
    ``theta = arccos(C_N a / (g hypot(x, kappa C_N))) - atan2(kappa C_N, x)``

    Parameters
    ----------
    x, kappa
        As of `edge_slack`.
    C_N : float or array
        Height of the centroid above the underside [m].
    a : float or array
        Acceleration along the heading [m/s^2].

    Returns
    -------
    float or array
        Slope [rad]; NaN where no slope is the limit or a steeper one is safer (kappa <= 0).

    Examples
    --------
    >>> limit = edge_limit(x=0.124, kappa=1.0, C_N=0.071, a=0.0)
    >>> print(round(limit * 180 / np.pi, 3))
    60.205

    References
    ----------
    Derived; for kappa = 1 `kaidan.mechanics.margin.theta_s_sup`.
    """
    ratio = C_N * a / (g * np.hypot(x, kappa * C_N))
    holds = (np.abs(ratio) <= 1.0) & (kappa > 0.0)
    inside = np.where(np.abs(ratio) <= 1.0, ratio, 0.0)
    return validity(holds=holds) * (np.arccos(inside) - np.arctan2(kappa * C_N, x))


def sideways_limit(*, gauge: Number, C_N: Number, psi: Number) -> Number:
    """Slope at which the robot tips over the track that is lower.

    ``tan(theta) |sin(psi)| = gauge / (2 C_N)``

    Parameters
    ----------
    gauge : float or array
        Distance between the middles of the two tracks [m].
    C_N : float or array
        Height of the centroid above the underside [m].

    Returns
    -------
    float or array
        Slope [rad]; pi/2 at psi = 0.

    Examples
    --------
    >>> print(round(sideways_limit(gauge=0.2, C_N=0.1, psi=-np.pi / 2) * 180 / np.pi, 9))
    45.0

    References
    ----------
    Derived from `equivalent_slope_across`.
    """
    return np.arctan2(gauge, 2.0 * C_N * np.abs(np.sin(psi)))


def edge_energy(
    *,
    x: Number,
    slope: Number,
    C_N: Number,
    theta_s: Number,
    psi: Number,
    a: Number,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Rise of the centroid on its way over an edge of the support, energy over weight.

    ``|r| |u| - r . u`` with r from the edge to the centroid and u the direction that counts as up,
    both without their parts along the edge; ``u = (sin(theta_s) cos(psi) + a/g,
    -sin(theta_s) sin(psi), cos(theta_s))`` along the track, to its left and normal to it.

    Parameters
    ----------
    x : float or array
        Middle of the edge downhill of the centroid [m]; negative for the edge uphill.
    slope : float or array
        How much farther ahead the edge is on the left, over the gauge [1].
    C_N : float or array
        Height of the centroid above the underside [m].
    a : float or array
        Acceleration along the heading [m/s^2].

    Returns
    -------
    float or array
        Rise [m], never negative: whether the centroid is over the edge already, `edge_slack` says.

    Examples
    --------
    >>> print(round(edge_energy(x=0.3, slope=0.0, C_N=0.4, theta_s=0.0, psi=0.0, a=0.0), 12))
    0.1

    References
    ----------
    After Hirose's normalised energy stability margin, derived anew; for psi = 0
    `kaidan.mechanics.measures.energy_margin_backward`.
    """
    along = np.sin(theta_s) * np.cos(psi) + a / g
    left = -np.sin(theta_s) * np.sin(psi)
    norm = np.hypot(1.0, slope)
    # across the edge, in the underside: (1, -slope) / norm
    r_e, u_e = x / norm, (along - slope * left) / norm
    u_n = np.cos(theta_s)
    return np.hypot(r_e, C_N) * np.hypot(u_e, u_n) - (r_e * u_e + C_N * u_n)
