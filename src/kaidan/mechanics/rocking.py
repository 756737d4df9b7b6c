r"""Rocking: how much of a turn from nosing to nosing counts beside the slope of the flight.

::

           o---___            before  the flat stands steeper than the flight, by e-
    - - o- - - - -o- - - -    theta_s line through the flight's first and last nosing
              ___---o         after   it stands gentler, by e+
          o---                turn    e- + e+, though it is never farther off than one of them
"""

import numpy as np

from kaidan.mechanics import Number


def rocking(*, turn: Number, before: Number, after: Number, theta_s: Number) -> Number:
    """Rotation of a flat on a flight that counts as rocking.

    ``min(turn, max(abs(before - theta_s), abs(after - theta_s)))``

    Assumptions: before and after it the flat rests on one flight, whose mean slope is theta_s.
    Without a flight the turn alone counts.

    Parameters
    ----------
    turn : float or array
        How far it turns, of which what the terrain obliges it to may be left out [rad].
    before, after : float or array
        Inclinations at which it begins and ends; of several turns that follow at once, the
        smallest and the largest [rad].
    theta_s : float or array
        Slope of the line through the flight's first and last nosing [rad]; NaN: there is none.

    Returns
    -------
    float or array
        Rocking [rad].

    Examples
    --------
    From 1.8 degrees beyond the flight to 1.7 short of it; from 0.2 beyond to 2.2 beyond; and 3.5
    off a kerb.

    >>> each = rocking(turn=np.array([3.5, 2.0, 3.5]), before=np.array([31.8, 30.2, 3.5]),
    ...                after=np.array([28.3, 32.2, 0.0]), theta_s=np.array([30, 30, np.nan]))
    >>> print(each.round(9))
    [1.8 2.  3.5]

    References
    ----------
    Derived: docs/theory/uneven.md.
    """
    beyond = np.maximum(np.abs(before - theta_s), np.abs(after - theta_s))
    return np.fmin(turn, beyond)
