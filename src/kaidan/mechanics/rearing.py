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
_PIECES, _CUTS = 128, 5
"""So often the range of inclinations is cut into so many: the length is flat where it is least."""
_SHARES = np.arange(1, _PIECES) / _PIECES


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
    low = np.full((*np.broadcast(b, h, R, C_N).shape, 1), 1e-3)
    width = STEEPEST - low
    of = np.expand_dims(h, -1), np.expand_dims(R, -1), np.expand_dims(C_N, -1)
    for _ in range(_CUTS):  # the length falls, then rises: where its slope changes sign
        falls = _rate(low + width * _SHARES, *of) < 0
        width = width / _PIECES
        low = low + width * falls.sum(axis=-1, keepdims=True)
    return b - rearing_length(phi=(low + 0.5 * width)[..., 0], h=h, R=R, C_N=C_N)


def _rate(phi: Number, h: Number, R: Number, C_N: Number) -> Number:
    """Slope of `rearing_length` over the inclination."""
    cosine = np.cos(phi)
    return C_N / cosine**2 - h * cosine / np.sin(phi) ** 2 - R / (1.0 + cosine)
