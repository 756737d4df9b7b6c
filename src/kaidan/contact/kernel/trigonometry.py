r"""Sines, cosines and angles from additions, products, quotients and roots alone.

Those are the same to the last bit on every machine (IEEE 754); the functions of a C library are
not. Each is off by less than one unit in the last place.

::

    x = n pi/2 + y        pi/2 in three pieces, the first two of 33 bits: n times either is exact
    sin y, cos y          polynomials, with what rounding has left of y
    angle of (x, y)       about 0, atan 1/2 or pi/4, whichever is near; then a polynomial

Cody & Waite 1980, Software Manual for the Elementary Functions; exact rests of sums and products
after Dekker 1971, doi:10.1007/BF01397083. Coefficients: Chebyshev's approximation in x^2, as
``mpmath.chebyfit`` has it at 60 digits.
"""

from __future__ import annotations

import math

from kaidan.contact.layout import At

#: Adding it and taking it off rounds to whole numbers.
ROUNDS = 6755399441055744.0
#: Beyond it no angle is reduced [rad].
LARGEST = 1e6
TO_QUARTERS = 2.0 / math.pi
QUARTER_1 = 1.5707963267341256
QUARTER_2 = 6.077100506303966e-11
QUARTER_3 = 2.0222662487959506e-21
#: Half of pi, pi and the angles about which is looked, with what their rounding leaves.
HALF_PI, HALF_PI_REST = 1.5707963267948966, 6.123233995736766e-17
PI, PI_REST = 3.141592653589793, 1.2246467991473532e-16
OF_HALF, OF_HALF_REST = 0.4636476090008061, 2.2698777452961687e-17
OF_ONE, OF_ONE_REST = 0.7853981633974483, 3.061616997868383e-17
#: (sin x - x) / x^3 up to pi/4.
S_1, S_2, S_3 = -0.16666666666666666, 0.008333333333330936, -0.00019841269836740532
S_4, S_5, S_6 = 2.7557316093198404e-06, -2.5051129896450185e-08, 1.5917988979397435e-10
#: (cos x - 1 + x^2 / 2) / x^4 up to pi/4.
C_1, C_2, C_3 = 0.041666666666666664, -0.0013888888888887389, 2.48015872987544e-05
C_4, C_5, C_6 = -2.755731726587808e-07, 2.087614504941318e-09, -1.138254464534925e-11
#: (atan x - x) / x^3 up to 7/16.
A_1, A_2, A_3 = -0.3333333333333333, 0.1999999999999941, -0.14285714285566806
A_4, A_5, A_6 = 0.11111111096645038, -0.09090908355602592, 0.07692285554889286
A_7, A_8, A_9 = -0.06666241923359964, 0.05876946456755061, -0.05216679739313656
A_10, A_11, A_12 = 0.04492259293193656, -0.033128134256069586, 0.014773184616983806


def halves(a: float) -> tuple[float, float]:
    """A number as a sum of two of 26 bits."""
    wide = 134217729.0 * a
    high = wide - (wide - a)
    return high, a - high


def rest_of_product(a: float, b: float, product: float) -> float:
    """What rounding has left of a product."""
    a_1, a_2 = halves(a)
    b_1, b_2 = halves(b)
    return a_2 * b_2 - (((product - a_1 * b_1) - a_2 * b_1) - a_1 * b_2)


def rest_of_sum(a: float, b: float, total: float) -> float:
    """What rounding has left of a sum."""
    part = total - a
    return (a - (total - part)) + (b - part)


def quotient(a: float, a_rest: float, b: float, b_rest: float) -> tuple[float, float]:
    """Quotient of two sums, and its rest."""
    q = a / b
    if q == 0.0 or not abs(q) < math.inf:
        return q, 0.0
    product = q * b
    return q, (((a - product) - rest_of_product(q, b, product)) + (a_rest - q * b_rest)) / b


def reduced(x: float) -> tuple[int, float, float]:
    """Quarter of a turn in which an angle lies, and how far from its middle, with the rest."""
    if abs(x) <= OF_ONE:
        return 0, x, 0.0
    if not abs(x) <= LARGEST:
        return 0, math.nan, math.nan
    quarters = (x * TO_QUARTERS + ROUNDS) - ROUNDS
    near = x - quarters * QUARTER_1
    less = quarters * QUARTER_2
    high = near - less
    less = quarters * QUARTER_3 - rest_of_sum(near, -less, high)
    y = high - less
    return int(quarters) & 3, y, (high - y) - less


def sine_near(y: float, rest: float) -> float:
    """Sine of an angle up to pi/4, less the angle."""
    z = y * y
    cube = z * y
    series = S_2 + z * (S_3 + z * (S_4 + z * (S_5 + z * S_6)))
    return cube * S_1 - (z * (0.5 * rest - cube * series) - rest)


def cosine_near(y: float, rest: float) -> tuple[float, float]:
    """Cosine of an angle up to pi/4, in two parts."""
    z = y * y
    series = z * (C_1 + z * (C_2 + z * (C_3 + z * (C_4 + z * (C_5 + z * C_6)))))
    half = 0.5 * z
    high = 1.0 - half
    return high, ((1.0 - high) - half) + (z * series - y * rest)


def sin(x: float) -> float:
    """Sine; NaN beyond `LARGEST`."""
    quarter, y, rest = reduced(x)
    if quarter & 1 == 0:
        near = y + sine_near(y, rest)
    else:
        high, low = cosine_near(y, rest)
        near = high + low
    return near if quarter < 2 else -near


def cos(x: float) -> float:
    """Cosine; NaN beyond `LARGEST`."""
    quarter, y, rest = reduced(x)
    if quarter & 1 == 1:
        near = y + sine_near(y, rest)
    else:
        high, low = cosine_near(y, rest)
        near = high + low
    return -near if quarter == 1 or quarter == 2 else near


def tan(x: float) -> float:
    """Tangent; NaN beyond `LARGEST`."""
    quarter, y, rest = reduced(x)
    more = sine_near(y, rest)
    sine = y + more
    less = (y - sine) + more
    high, low = cosine_near(y, rest)
    cosine = high + low
    low = (high - cosine) + low
    if quarter & 1 == 0:
        q, left = quotient(sine, less, cosine, low)
        return q + left
    q, left = quotient(cosine, low, sine, less)
    return -(q + left)


def cosine_sine(x: float) -> tuple[float, float]:
    """Cosine and sine together, which takes little more than either."""
    quarter, y, rest = reduced(x)
    high, low = cosine_near(y, rest)
    c = high + low
    s = y + sine_near(y, rest)
    if quarter & 1 == 1:
        c, s = -s, c
    if quarter > 1:
        c, s = -c, -s
    return c, s


def placed(x: float, z: float, phi: float) -> At:
    """Where the body is, from its centroid [m] and its inclination [rad]."""
    c, s = cosine_sine(phi)
    return At(x, z, c, s)


def acute(y: float, y_rest: float, x: float, x_rest: float) -> tuple[float, float]:
    """Angle of (x, y) above the x axis, both not negative, y no more than x; in two parts."""
    about = 0.0
    rest = 0.0
    if 16.0 * y > 11.0 * x:
        about, rest = OF_ONE, OF_ONE_REST
        total = x + y
        q, left = quotient(
            y - x, y_rest - x_rest, total, rest_of_sum(x, y, total) + (x_rest + y_rest)
        )
    elif 16.0 * y > 7.0 * x:
        about, rest = OF_HALF, OF_HALF_REST
        total = 2.0 * x + y
        q, left = quotient(
            2.0 * y - x, 2.0 * y_rest - x_rest, total,
            rest_of_sum(2.0 * x, y, total) + (2.0 * x_rest + y_rest),
        )  # fmt: skip
    else:
        q, left = quotient(y, y_rest, x, x_rest)
    z = q * q
    series = A_6 + z * (A_7 + z * (A_8 + z * (A_9 + z * (A_10 + z * (A_11 + z * A_12)))))
    series = A_1 + z * (A_2 + z * (A_3 + z * (A_4 + z * (A_5 + z * series))))
    high = about + q
    return high, ((about - high) + q) + (rest + left * (1.0 - z) + q * z * series)


def angle_of(y: float, y_rest: float, x: float, x_rest: float) -> float:
    """Angle of (x, y), of which y is not negative, from 0 to pi."""
    if x == 0.0 and y == 0.0:
        return 0.0
    wide = abs(x)
    x_rest = x_rest if x >= 0.0 else -x_rest
    if y > wide:
        high, low = acute(wide, x_rest, y, y_rest)
        near = HALF_PI - high
        low = ((HALF_PI - near) - high) + (HALF_PI_REST - low)
        high = near
    else:
        high, low = acute(y, y_rest, wide, x_rest)
    if x < 0.0:
        near = PI - high
        return near + (((PI - near) - high) + (PI_REST - low))
    return high + low


def atan2(y: float, x: float) -> float:
    """Angle of (x, y); nought at the origin."""
    return math.copysign(angle_of(abs(y), 0.0, x, 0.0), y)


def cathetus(x: float) -> tuple[float, float]:
    """Root of 1 - x^2, up to 1, and its rest."""
    square = x * x
    left = 1.0 - square
    rest = ((1.0 - left) - square) - rest_of_product(x, x, square)
    root = math.sqrt(left)
    if root == 0.0:
        return 0.0, 0.0
    again = root * root
    return root, (((left - again) - rest_of_product(root, root, again)) + rest) / (2.0 * root)


def asin(x: float) -> float:
    """Angle of a sine; NaN beyond 1."""
    if not abs(x) <= 1.0:
        return math.nan
    root, rest = cathetus(x)
    return math.copysign(angle_of(abs(x), 0.0, root, rest), x)


def acos(x: float) -> float:
    """Angle of a cosine; NaN beyond 1."""
    if not abs(x) <= 1.0:
        return math.nan
    root, rest = cathetus(x)
    return angle_of(root, rest, x, 0.0)
