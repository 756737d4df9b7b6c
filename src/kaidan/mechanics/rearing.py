r"""Rearing: whether a robot whose tail stands in the corner of a tread gets over the next nosing.

::

                     C          the flat leans on a nosing h above the tread on which the tail's
                  . '|          axle rolls, R above it; the robot drives on and rears up. It is over
              . '    |          as soon as its centroid passes the nosing. Where that happens at no
          o ' ------ o nosing   inclination, it is driven upright on its tail, and over.
        ( R )  phi   | h
    -----'-'---------'
"""

import numpy as np

from kaidan.mechanics import Number

STEEPEST = np.radians(85.0)
"""Inclination up to which the centroid may pass the nosing [rad]."""
_HALVINGS = 50


def rearing_length(*, phi: Number, h: Number, R: Number, C_N: Number) -> Number:
    """Centroid ahead of the tail's axle at which it stands over the nosing.

    ``h / sin(phi) - R tan(phi / 2) + C_N tan(phi)``

    Assumptions: the flat is tangent to the tail's end, which stands on a level tread; a sharp
    nosing on the flat.

    Parameters
    ----------
    phi : float or array
        Inclination, in (0, pi/2) [rad].
    h : float or array
        Nosing above the tread on which the tail stands [m].
    R : float or array
        Radius of the tail's end [m].
    C_N : float or array
        Centroid above the flat [m].

    Returns
    -------
    float or array
        Length along the flat [m].

    Examples
    --------
    At 45 degrees, a point for a tail: the nosing lies sqrt(2) h along the flat, the centroid's
    plumb line meets the flat C_N behind it.

    >>> print(round(float(rearing_length(phi=np.pi / 4, h=0.2, R=0.0, C_N=0.1)), 6))
    0.382843

    References
    ----------
    Derived: docs/theory/rocking.md.
    """
    return h / np.sin(phi) - R * np.tan(phi / 2) + C_N * np.tan(phi)


def rear_length_margin(*, b: Number, h: Number, R: Number, C_N: Number) -> Number:
    """How much further the centroid may lie towards the tail before the robot is driven upright.

    ``b - min over phi of rearing_length``, phi up to 85 degrees

    Assumptions: those of `rearing_length`; quasi-static, friction enough. Momentum adds
    something.

    Parameters
    ----------
    b : float or array
        Centroid ahead of the tail's axle [m].
    h, R, C_N : float or array
        As for `rearing_length`.

    Returns
    -------
    float or array
        Margin [m]; negative: it is driven upright on its tail.

    Examples
    --------
    A centroid on the flat and a point for a tail: the steeper the better, h / sin(85 deg).

    >>> print(round(float(rear_length_margin(b=0.5, h=0.2, R=0.0, C_N=0.0)), 6))
    0.299236

    References
    ----------
    Derived: docs/theory/rocking.md.
    """
    low, high = np.full(np.broadcast(b, h, R, C_N).shape, 1e-3), STEEPEST
    for _ in range(_HALVINGS):  # the length falls, then rises: where its slope changes sign
        phi = 0.5 * (low + high)
        slope = (
            C_N / np.cos(phi) ** 2
            - h * np.cos(phi) / np.sin(phi) ** 2
            - 0.5 * R / np.cos(phi / 2) ** 2
        )
        low, high = np.where(slope < 0, phi, low), np.where(slope < 0, high, phi)
    return b - rearing_length(phi=0.5 * (low + high), h=h, R=R, C_N=C_N)
