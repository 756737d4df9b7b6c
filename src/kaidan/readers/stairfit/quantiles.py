"""Medians and quantiles of short rows of numbers, without the ceremony of the general ones.

A cloud takes some two hundred of them, most of a few hundred numbers, where numpy's own spend
several times longer on what shape and kind the input may have than on the numbers.
"""

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices


def median(values: Array | Indices | NDArray[np.float32]) -> float:
    """Median of finite numbers, shape (n,), at least one.

    Examples
    --------
    >>> median(np.array([3.0, 1.0, 2.0])), median(np.array([4.0, 1.0, 2.0, 3.0]))
    (2.0, 2.5)
    """
    half = len(values) // 2
    if len(values) % 2:
        return float(np.partition(values, half)[half])
    two = np.partition(values, (half - 1, half))
    return (float(two[half - 1]) + float(two[half])) / 2


def quantile(values: Array | Indices, share: float) -> float:
    """Quantile of finite numbers, shape (n,), at least one, linear between two of them.

    Examples
    --------
    >>> quantile(np.array([10.0, 0.0, 20.0]), 0.25)
    5.0
    """
    at = share * (len(values) - 1)
    low = int(at)
    high = min(low + 1, len(values) - 1)
    two = np.partition(values, (low, high))
    return float(two[low]) + (at - low) * (float(two[high]) - float(two[low]))
