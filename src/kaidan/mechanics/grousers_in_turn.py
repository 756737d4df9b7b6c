r"""Grousers that follow each other over a nosing: where the next one lands, how far it runs back.

::

            belt     . '  |/
                 . ' |    |     the upper tip lands on the tread or the round, a ahead of where the
        d    . '  |\ | a  |     belt is nearest; the lower one, s - w behind it, lies d behind, on
         . '     || '_____|     the round or the riser's face, and keeps the belt off
        /       _|(   tread
        \______| |
                | riser
"""

import numpy as np

from kaidan.mechanics import Number

STRAIGHT = 1e-6
"""Curvature below which a belt is taken as straight [1/m]."""
HALVINGS = 50
"""Halvings of the height of a grouser: to rounding."""


def reach_beside(*, b: Number, r: Number, lean: Number, curvature: Number = 0.0) -> Number:
    """Length along the belt between its contact and a tip beside it that touches the ground.

    On a straight belt ``sqrt(b (2 r - b))`` up to b = r (1 - cos(lean)), where the round ends, and
    ``r sin(lean) + (b - r (1 - cos(lean))) / tan(lean)`` beyond, on what is straight.

    On an end of the radius R = 1 / k the same as an angle times R, of a tip R + b from the axle.

    Assumptions: rigid grouser, sharp at its tip; the belt lies on the nosing.

    Parameters
    ----------
    b : float or array
        How deep the tip lies below the belt [m].
    r : float or array
        Radius of the nosing [m].
    lean : float or array
        Angle through which the round turns on that side before the tread or the face goes on
        straight [rad], 0 to pi/2: theta uphill, pi/2 - theta downhill.
    curvature : float or array
        Of the belt there [1/m]: zero on the flat, one over the radius on a round end.

    Returns
    -------
    float or array
        [m]

    Examples
    --------
    >>> print(round(float(reach_beside(b=0.012, r=0.0, lean=np.pi / 4)), 9))
    0.012

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    near = r * (1.0 - np.cos(lean))
    on_round = np.sqrt(np.maximum(b * (2.0 * r - b), 0.0))
    beyond = r * np.sin(lean) + (b - near) / np.tan(lean)
    R = 1.0 / np.maximum(curvature, STRAIGHT)
    off, tip = R + r, R + b
    straight = np.arccos(np.maximum((off * np.cos(lean) - r) / tip, -1.0))
    turn = np.arccos(np.minimum((off**2 + tip**2 - r**2) / (2.0 * off * tip), 1.0))
    is_beyond = tip * np.sin(straight) >= off * np.sin(lean)
    at_end = R * np.where(is_beyond, straight - lean, turn)
    return np.where(curvature > 0.0, at_end, np.where(b <= near, on_round, beyond))


def height_behind(
    *, theta: Number, h: Number, s: Number, r: Number, w: Number, curvature: Number = 0.0
) -> Number:
    """Height of a grouser over a nosing as it comes to stand, the one before it not yet clear.

    The largest b <= h of which ``a(b) + d(b) <= s - w``, a and d = `reach_beside` uphill and
    downhill, by halving.

    A tip comes down to the tread, or to the round, behind the nosing, while the one before it still
    lies against the round or the riser's face below and keeps the belt off. As the robot slips
    down, the one before it leaves room, and the other fills it: it lands where both touch.

    Assumptions: rigid grousers with sharp edges; an upright face, at least a spacing high. On round
    ends both are taken to lie so much nearer to the belt, which never asks for less.

    Parameters
    ----------
    theta : float or array
        Tilt of the belt's normal from the tread's [rad], 0 to pi/2.
    h : float or array
        Height of the grousers under load [m].
    s : float or array
        Spacing of the grousers along the belt [m].
    r : float or array
        Radius of the nosing [m].
    w : float or array
        Width of the tips along the belt [m].
    curvature : float or array
        Of the belt there [1/m]: zero on the flat, one over the radius on a round end.

    Returns
    -------
    float or array
        [m]: on a sharp nosing and a straight belt h, or (s - w) sin(theta) cos(theta).

    Examples
    --------
    >>> slope = np.radians(45)
    >>> print(round(float(height_behind(theta=slope, h=0.010, s=0.040, r=0.0, w=0.004)), 9))
    0.01
    >>> print(round(float(height_behind(theta=slope, h=0.010, s=0.016, r=0.0, w=0.004)), 6))
    0.006

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    steep, room = 0.5 * np.pi - theta, s - w

    def fits(b: Number) -> Number:
        up = reach_beside(b=b, r=r, lean=theta, curvature=curvature)
        return up + reach_beside(b=b, r=r, lean=steep, curvature=curvature) <= room

    least = np.where(fits(h), h, 0.0)
    most = h + 0.0 * least
    for _ in range(HALVINGS):
        middle = 0.5 * (least + most)
        enough = fits(middle)
        least, most = np.where(enough, middle, least), np.where(enough, most, middle)
    return least
