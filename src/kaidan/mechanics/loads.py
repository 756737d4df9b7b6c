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

    Parameters
    ----------
    C_L, C_N : float or array
        Centroid behind the uphill tip and above the underside [m].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    a : float or array
        Acceleration up the stairs [m/s^2].
    g : float
        Gravity [m/s^2].

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


def normal_forces(
    *, share: Number, M: Number, theta_s: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Normal force of every contact.

    ``f_iN = share_i M g cos(theta_s)``

    Parameters
    ----------
    share : float or array
        Shares of the contacts [1], see `load_shares`.
    M : float or array
        Mass of the robot [kg].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    g : float
        Gravity [m/s^2].

    Returns
    -------
    float or array
        Normal forces [N]; broadcast shape of the inputs.

    Examples
    --------
    >>> print(round(normal_forces(share=0.25, M=8.0, theta_s=np.pi / 3, g=10.0), 12))
    10.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (3), shared out.
    """
    return share * M * g * np.cos(theta_s)


def _tilt(x: Number, x_z: Number) -> Number:
    """Return inclination per total load over stiffness [1/m]: x_z's lever over the spread."""
    x_z = np.expand_dims(x_z, -1)
    loaded, _, lever = _pressing(x, x_z)
    several = np.sum(loaded, axis=-1, keepdims=True) > 1
    return np.where(_between(x, x_z) & several, lever, np.nan)[..., 0]


def deformation_inclination(*, x: Number, x_z: Number, load: Number, stiffness: Number) -> Number:
    """Extra inclination of the body because the track yields at the contacts.

    ``theta_d = (sum N / k) (x_z - mean x) / sum_j (x_j - mean x)^2``

    over the contacts that press: the slope of the line on which they sink by N_i / k.

    Assumptions: equal linear springs; small angle (the tangent stands for the angle: 0.1 % at
    3 degrees); first order (the loads are those of the undeformed pose; the centroid that the
    inclination carries C_N theta_d further back adds a factor of about
    1 + (sum N / k) C_N / sum_j (x_j - mean x)^2).

    Parameters
    ----------
    x : array, shape (..., m)
        Contacts behind the uphill tip of the flat [m]; NaN for no contact.
    x_z : float or array, shape (...)
        Point through which the resultant passes [m].
    load : float or array, shape (...)
        Sum of the normal forces [N], see `kaidan.mechanics.slipping.normal_sum`.
    stiffness : float or array, shape (...)
        Stiffness k of the track at one contact, both tracks together [N/m].

    Returns
    -------
    float or array, shape (...)
        theta_d [rad], nose up the stairs positive; NaN where nothing can hold the robot or one
        contact alone carries it.

    Examples
    --------
    Two contacts 0.2 m apart, everything on the lower: it sinks 100 N / 1e4 N/m = 10 mm.

    >>> x = np.array([0.1, 0.3])
    >>> print(round(deformation_inclination(x=x, x_z=0.3, load=100.0, stiffness=1e4), 12))
    0.05

    References
    ----------
    Derived. Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Figs. 15 and 16, measure theta_d
    and expect that it "can be estimated by mechanical analysis".

    Errata: the paper's section on deformation first calls this growth theta_M, then theta_d.
    """
    return load / stiffness * _tilt(x, x_z)


def deformation_stiffness(*, x: Number, x_z: Number, load: Number, theta_d: Number) -> Number:
    """Stiffness of the track at one contact that reproduces a measured extra inclination.

    ``k = (sum N / theta_d) (x_z - mean x) / sum_j (x_j - mean x)^2``

    Assumptions: those of `deformation_inclination`, whose inverse it is.

    Parameters
    ----------
    x : array, shape (..., m)
        Contacts behind the uphill tip of the flat [m]; NaN for no contact.
    x_z : float or array, shape (...)
        Point through which the resultant passes [m].
    load : float or array, shape (...)
        Sum of the normal forces [N].
    theta_d : float or array, shape (...)
        Measured extra inclination [rad], nose up the stairs positive.

    Returns
    -------
    float or array, shape (...)
        Stiffness k [N/m]; NaN where no positive stiffness gives that inclination.

    Examples
    --------
    >>> x = np.array([0.1, 0.3])
    >>> print(round(deformation_stiffness(x=x, x_z=0.3, load=100.0, theta_d=0.05), 6))
    10000.0

    References
    ----------
    Derived, see `deformation_inclination`.
    """
    tilt = _tilt(x, x_z)
    return load * tilt / np.where(tilt * theta_d > 0.0, theta_d, np.nan)
