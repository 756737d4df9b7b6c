"""Rubber grousers under load: how much of their height is left."""

import numpy as np

from kaidan.mechanics import Number


def rubber_modulus(*, S: Number) -> Number:
    """Modulus of elasticity of rubber from its hardness.

    ``E = 0.0981 (56 + 7.62336 S) / (0.137505 (254 - 2.54 S)) MPa``

    Parameters
    ----------
    S : float or array
        Shore A hardness [1], 10 to 95.

    Returns
    -------
    float or array
        E [Pa].

    Examples
    --------
    >>> print(round(rubber_modulus(S=60.0) / 1e6, 1))
    3.6

    References
    ----------
    Gent 1958, On the relation between indentation hardness and Young's modulus, Rubber Chemistry
    and Technology 31(4), doi:10.5254/1.3542351.
    """
    return 0.0981e6 * (56.0 + 7.62336 * S) / (0.137505 * (254.0 - 2.54 * S))


def height_lost(*, N: Number, T: Number, h: Number, w: Number, b: Number, E: Number) -> Number:
    """Height that a rubber grouser loses under its load.

    ``u = N h / (E b w) + (3/5) d^2 / h``, d = T h^3 / (3 E I) + 1.2 T h / (E b w / 3),
    I = b w^3 / 12

    It is pressed, and its tip, bent and sheared aside by d, comes down.

    Assumptions: prismatic, clamped at the belt; incompressible rubber (shear modulus E / 3); small
    strain, and the shortening of a bent cantilever for its curved line.

    Parameters
    ----------
    N, T : float or array
        Force on the grouser across and along the belt [N].
    h, w, b : float or array
        Its height, its width along the belt, and its length across the belt [m].
    E : float or array
        Modulus of elasticity [Pa].

    Returns
    -------
    float or array
        u [m], at most h.

    Examples
    --------
    >>> u = height_lost(N=190.0, T=100.0, h=0.012, w=0.008, b=0.1, E=3.6e6)
    >>> print(round(1e3 * u, 1))
    2.2

    References
    ----------
    Derived from beam theory: docs/theory/grousers.md.
    """
    area = b * w
    aside = 4.0 * T * h**3 / (E * b * w**3) + 3.6 * T * h / (E * area)
    return np.minimum(N * h / (E * area) + 0.6 * aside**2 / np.maximum(h, 1e-9), h)
