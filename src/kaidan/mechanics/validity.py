"""One where an equation holds and NaN where it does not."""

import numpy as np

from kaidan.mechanics import Number


def validity(*, holds: Number) -> Number:
    """Factor that leaves a result alone where its equation holds and makes it NaN elsewhere.

    ``H(1) = 1``, ``H(0) = NaN``

    Heaviside's step with NaN for its value at zero, because ``np.where`` would strip the labels
    off labelled arrays, 0/0 would warn, and a power of NaN takes ten times as long.

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
    """
    return np.heaviside(holds, np.nan)
