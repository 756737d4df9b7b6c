"""One where an equation holds and NaN where it does not."""

import numpy as np

from kaidan.mechanics import Number


def validity(*, holds: Number) -> Number:
    """Factor that leaves a result alone where its equation holds and makes it NaN elsewhere.

    ``NaN^0 = 1``, ``NaN^1 = NaN``

    A power, because ``np.where`` would strip the labels off labelled arrays, and 0/0 or the
    square root of a negative number would warn.

    Parameters
    ----------
    holds : bool or array of bool
        Where the equation holds.

    Returns
    -------
    float or array
        1 where it holds, NaN elsewhere.

    Examples
    --------
    >>> print(5.0 * validity(holds=True), 5.0 * validity(holds=False))
    5.0 nan

    References
    ----------
    IEEE 754-2019, doi:10.1109/IEEESTD.2019.8766229, section 9.2.1: pow(x, 0) is 1 for any x,
    even a quiet NaN.
    """
    return np.nan ** np.logical_not(holds)
