"""tan and atan2 for compiled loops, without branches, so that the compiler can vectorise them.

numba calls the C library for each number, which costs more than everything else in a sweep. The
rational approximations are those of the Cephes library (S. L. Moshier, Methods and Programs for
Mathematical Functions, 1989; netlib cephes, tan.c and atan.c); they agree with numpy's to a few
units of rounding, which a test holds.
"""

import math

import numpy as np

_PI_2_HIGH, _PI_2_LOW = 1.5707963267948966, 6.123233995736766e-17


def where(condition: bool, x: float, y: float) -> float:
    """``x if condition else y``."""
    return x if condition else y


def validity(*, holds: bool) -> float:
    """`kaidan.mechanics.validity.validity` without a power."""
    return where(holds, 1.0, math.nan)


def minimum(x: float, y: float) -> float:
    """Smaller of two numbers; NaN if either is."""
    return where((x < y) | (x != x), x, y)


def fmin(x: float, y: float) -> float:
    """Smaller of two numbers, leaving out a NaN."""
    return where((x < y) | (y != y), x, y)


def fmax(x: float, y: float) -> float:
    """Larger of two numbers, leaving out a NaN."""
    return where((x > y) | (y != y), x, y)


def tan(x: float) -> float:
    """Tangent of an angle [rad].

    To a few units of rounding for |x| < 3.9, which holds every angle of a robot; further out as if
    x were known to its own unit of rounding only, up to about 1e5.
    """
    j = np.rint(x * (2.0 / math.pi))
    r = (x - j * _PI_2_HIGH) - j * _PI_2_LOW
    z = r * r
    p = (-1.30936939181383777646e4 * z + 1.15351664838587416140e6) * z - 1.79565251976484877988e7
    q = (
        ((z + 1.36812963470692954678e4) * z - 1.32089234440210967447e6) * z
        + 2.50083801823357915839e7
    ) * z - 5.38695755929454629881e7
    t = r + r * (z * p / q)
    odd = j - 2.0 * np.floor(0.5 * j)
    return where(odd == 0.0, t, -1.0 / t)


def arctan2(y: float, x: float) -> float:
    """Angle of the vector (x, y) [rad], finite x and y not both zero."""
    rise, run = abs(y), abs(x)
    steep = rise > run
    small = where(steep, run, rise)
    large = where(steep, rise, run)
    middle = small > 0.66 * large
    top = where(middle, small - large, small)
    bottom = where(middle, small + large, large)
    r = top / bottom
    z = r * r
    p = (
        (
            (-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z
            - 7.500855792314704667340e1
        )
        * z
        - 1.228866684490136173410e2
    ) * z - 6.485021904942025371773e1
    q = (
        (
            ((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z
            + 4.328810604912902668951e2
        )
        * z
        + 4.853903996359136964868e2
    ) * z + 1.945506571482613964425e2
    angle = r + r * (z * p / q)
    angle = where(middle, angle + 0.25 * math.pi, angle)
    angle = where(steep, 0.5 * math.pi - angle, angle)
    angle = where(x < 0.0, math.pi - angle, angle)
    return math.copysign(angle, y)
