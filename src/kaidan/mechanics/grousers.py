r"""Tracks with grousers on stairs: a tip that stands on a tread holds with little friction.

::

            belt, inclined by theta ->   . '
                                   . '  |/
                     grouser   . '|  \  |     tip of height h: stands on the tread,
                           . ' \  |   \ v       normal tilted by beta = 0
                   . '          \_|____________
               . '   nosing, r  (    tread
           . '                  |
                                | riser: a face that nothing can stand on

Closed risers offer treads, whose normal is vertical, and faces, whose normal points downhill.
Nothing faces uphill, so a grouser cannot hook behind a nosing. But its tip stands on the tread just
above the edge, where the normal is tilted by beta and not by theta as under the belt.
"""

import numpy as np

from kaidan.mechanics import Number


def standing_run(*, theta: Number, h: Number, r: Number) -> Number:
    """Length along the belt over which a grouser stands on the tread behind a nosing.

    ``l = [h - r (1 - cos(theta))]+ / tan(theta)``

    A tip comes to the tread, and then climbs the round. Of rigid grousers so close that the one
    before is not yet clear, h is `height_behind`.

    Assumptions: rigid grousers with sharp edges; straight belt.

    Parameters
    ----------
    theta : float or array
        Slope of the belt above the tread [rad].
    h : float or array
        Height of the grousers under load [m].
    r : float or array
        Radius of the nosing [m].

    Returns
    -------
    float or array
        l [m].

    Examples
    --------
    >>> print(round(standing_run(theta=np.pi / 4, h=0.012, r=0.0), 9))
    0.012

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    return np.maximum(h - r * (1.0 - np.cos(theta)), 0.0) / np.tan(theta)


def slip_height(*, psi: Number, s: Number, mu_k: Number, mu_required: Number) -> Number:
    """Kinetic-energy height of a robot that has slipped back by a spacing of its grousers.

    ``v^2 / 2g = s sin(psi) (1 - mu_k / mu_required)``

    Weight does the work ``s sin(psi)``. All contacts slide, and with the friction required they
    would do as much; sliding friction does its share of that. On a flight psi = theta and
    mu_required = tan(theta): ``s (sin(theta) - mu_k cos(theta))``.

    Assumptions: it starts at rest, the belt stands still, and no grouser brakes it before.

    Parameters
    ----------
    psi : float or array
        Direction of the centroid's path above the horizontal [rad].
    s : float or array
        How far it slips [m].
    mu_k : float or array
        Sliding friction [1].
    mu_required : float or array
        Static friction with which nothing would slip [1].

    Returns
    -------
    float or array
        Height [m]; zero where friction holds.

    Examples
    --------
    >>> theta = np.radians(37.8)
    >>> height = slip_height(psi=theta, s=0.020, mu_k=0.3, mu_required=np.tan(theta))
    >>> print(round(1e3 * height, 1))
    7.5

    References
    ----------
    Derived: the work of weight and friction over the slip.
    """
    return np.maximum(s * np.sin(psi) * (1.0 - mu_k / mu_required), 0.0)
