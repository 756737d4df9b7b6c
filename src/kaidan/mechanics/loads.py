"""How the contacts share the weight, and how far the track yields under it.

::

      uphill tip                                       downhill tip
          |--- x_1 ---o                                     |
          |-------------- x_2 ----o                         |
          |------ C_L ------+- C_N tan(theta_eff) -+ x_z    |

Positions ``x`` lie along the underside, from the uphill tip of the flat downhill. With three or
more contacts statics alone does not fix the loads; equal springs do.

The functions with contact positions take them along the last axis and sum over it, so they are
for floats and numpy arrays; a labelled array goes through ``xarray.apply_ufunc`` with the contact
dimension as a core dimension.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.slipping import equivalent_slope

ROUNDING = 1e-12
"""A share down to minus this counts as zero: the contact just touches and stays. Shares
are sums of numbers of order one, good to about 1e-15."""


def zero_moment_point(
    *, C_L: Number, C_N: Number, theta_s: Number, a: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Point of the underside through which the resultant of weight and inertia passes.

    ``x_z = C_L + C_N (tan(theta_s) + a / (g cos(theta_s)))``

    Assumptions: rigid robot in translation along the stairs.

    Returns
    -------
    float or array
        x_z [m], behind the uphill tip of the flat.

    Examples
    --------
    >>> print(round(zero_moment_point(C_L=0.2, C_N=0.1, theta_s=np.pi / 4, a=0.0), 12))
    0.3
    >>> print(round(zero_moment_point(C_L=0.2, C_N=0.1, theta_s=0.0, a=-5.0, g=10.0), 12))
    0.15

    References
    ----------
    Derived: Eqs. (5) and (11) of Endo & Nagatani 2016 (doi:10.1186/s40648-016-0058-y), moments
    about the point of the underside where they vanish. For the name: Vukobratovic & Borovac 2004,
    doi:10.1142/S0219843604000083.
    """
    return C_L + C_N * equivalent_slope(theta_s=theta_s, a=a, g=g)


def _springs(x: Number, x_z: Number, loaded: Number) -> tuple[Number, Number]:
    """Return the shares by the springs that are loaded, and x_z's lever over their spread [1/m]."""
    m = np.maximum(np.sum(loaded, axis=-1, keepdims=True), 1)
    mean = np.sum(np.where(loaded, x, 0.0), axis=-1, keepdims=True) / m
    spread = np.sum(np.where(loaded, x - mean, 0.0) ** 2, axis=-1, keepdims=True)
    lever = (x_z - mean) / np.where(spread > 0.0, spread, np.inf)
    return 1.0 / m + lever * (x - mean), lever


def _pressing(x: Number, x_z: Number) -> tuple[Number, Number, Number]:
    """Return which contacts stay loaded when those that would pull are dropped, again and again.

    And their shares and the lever, as `_springs` has them.
    """
    loaded = np.isfinite(x) & np.isfinite(x_z)
    while True:
        share, lever = _springs(x, x_z, loaded)
        kept = loaded & (share >= -ROUNDING)
        if np.array_equal(kept, loaded):
            return loaded, share, lever
        loaded = kept


def _between(x: Number, x_z: Number) -> Number:
    """Return whether the point lies between the outermost contacts, ends included."""
    present = np.isfinite(x)
    nearest = np.min(np.where(present, x, np.inf), axis=-1, keepdims=True)
    furthest = np.max(np.where(present, x, -np.inf), axis=-1, keepdims=True)
    return (nearest <= x_z) & (x_z <= furthest)


def load_shares(*, x: Number, x_z: Number) -> Number:
    """Share of every contact in the normal load, contacts as equal springs.

    ``N_i / sum N = 1/m + (x_z - mean x)(x_i - mean x) / sum_j (x_j - mean x)^2``

    over the m contacts that press; a contact that would have to pull is dropped and the rest
    solved again. A contact once dropped never presses again later, so what remains is the one
    solution with no contact pulling and no free contact pressed into.

    Assumptions: rigid underside on springs along its normal, all of the same stiffness and with
    nosings on one line; tractive forces act in the underside and turn nothing.

    Parameters
    ----------
    x : array, shape (..., m)
        Contacts behind the uphill tip of the flat [m], in any order; NaN for no contact.
    x_z : float or array, shape (...)
        Point through which the resultant passes [m], see `zero_moment_point`.

    Returns
    -------
    array, shape (..., m)
        Shares [1], sum 1; 0 for a contact that is dropped or absent; NaN for all of them where
        x_z lies beyond the outermost contacts and nothing can hold the robot.

    Examples
    --------
    The mean lies at 0.25 m, the squares sum to 0.125 m^2; at 0.4375 m the first would pull.

    >>> print((12 * load_shares(x=np.array([0.0, 0.25, 0.5]), x_z=0.375)).round(9))
    [1. 4. 7.]
    >>> print(load_shares(x=np.array([0.0, 0.25, 0.5]), x_z=0.4375).round(9))
    [0.   0.25 0.75]

    References
    ----------
    Derived. Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, speak of the "load-sharing
    ratio" (Fig. 15) and give no equation for it.
    """
    x_z = np.expand_dims(x_z, -1)
    loaded, share, _ = _pressing(x, x_z)
    return np.where(_between(x, x_z), np.where(loaded, np.maximum(share, 0.0), 0.0), np.nan)
