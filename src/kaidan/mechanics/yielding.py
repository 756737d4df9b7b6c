r"""Tracks that yield: theta_d and the margin by mechanics, the paper's open question.

::

              C
              |\                W   weight            a = theta_s + theta_d, inclination
        C_N-eta | \              x   centroid ahead of t_0, along the flat
      ________|__\______ flat     eta indentation at t_0: w_n cos(a)
        t_0 *--x--'             sag: how far the robot is carried back over t_0: w_t sin(a)

At the limit t_0 alone carries, so gravity's line through C passes t_0. The compliances are lengths:
w_n = W/k and w_t = W/kt, what the whole weight on one nosing would press in and shear.
"""

import numpy as np

from kaidan.mechanics import Number

_ROUNDS = 80


def theta_d_at_limit(*, eta: Number, p: Number) -> Number:
    """Extra inclination at the limit, where the nosing above t_0 just touches.

    ``theta_d = arcsin(eta / p)``

    Parameters
    ----------
    eta : float or array
        Indentation at t_0 [m].
    p : float or array
        Nosing spacing [m].

    Returns
    -------
    float or array
        Angle [rad]; NaN for eta > p.

    Examples
    --------
    >>> print(round(theta_d_at_limit(eta=0.001, p=0.150) * 180 / np.pi, 3))
    0.382

    References
    ----------
    Derived (docs/theory/yielding.md): the two nosings lie p apart, one eta below the underside and
    one on it.
    """
    return np.arcsin(eta / p)


def theta_d_two_contacts(
    *, L: Number, p: Number, C_L: Number, C_N: Number, theta_s: Number, w_n: Number
) -> Number:
    """Extra inclination just after the lowest contact leaves, two nosings carrying.

    ``theta_d = (w_n cos(a) / p) (1 - 2 q)``, ``q = (L - p - C_L - (C_N - eta) tan(a)) / p``,
    ``eta = w_n cos(a) (1 - q)``, ``a = theta_s + theta_d``

    q is the share that the upper nosing carries; first order in eta / p. It is what the paper
    measures as theta_d (Fig. 15), and one measurement of it gives w_n.

    Parameters
    ----------
    L, p, C_L, C_N : float or array
        Flat length, nosing spacing, centroid behind the front tip and above the underside [m].
    theta_s : float or array
        Slope of the stairs [rad].
    w_n : float or array
        Indentation under the whole weight on one nosing [m].

    Returns
    -------
    float or array
        Angle [rad]; NaN where one of the two would have to pull.

    Examples
    --------
    >>> found = theta_d_two_contacts(
    ...     L=0.470, p=0.150, C_L=0.196, C_N=0.071, theta_s=np.radians(56.8), w_n=0.0173
    ... )
    >>> print(round(found * 180 / np.pi, 1))
    2.6

    References
    ----------
    Derived (docs/theory/yielding.md).
    """
    theta_d = eta = 0.0 * (theta_s + w_n + p)
    for _ in range(_ROUNDS):
        a = theta_s + theta_d
        q = (L - p - C_L - (C_N - eta) * np.tan(a)) / p
        eta = w_n * np.cos(a) * (1.0 - q)
        theta_d = w_n * np.cos(a) / p * (1.0 - 2.0 * q)
    return theta_d * np.where((q >= 0.0) & (q <= 1.0), 1.0, np.nan)


def theta_s_sup_yielding(
    *,
    L: Number,
    p: Number,
    C_L: Number,
    C_N: Number,
    w_n: Number,
    drop: Number = 0.0,
    R: Number = 0.0,
) -> Number:
    """Steepest slope on which a robot with a yielding track does not tip over its downhill end.

    ``theta = atan2(L + s - p cos(theta_d) - C_L - drop sin(a), C_N - eta) - theta_d``

    ``eta = w_n cos(a)``, ``theta_d = arcsin(eta / p)``, ``a = theta + theta_d``,
    ``s = sqrt(4 R eta - 4 eta^2)``: how far a round end goes on carrying past the tip.

    Without a drop this is the limit of slow driving: when the robot sags it comes back over the
    nosing that it is about to leave, which carries again, so that sag costs no margin. With the
    drop it is the limit in which it does not come back: a lower bound.

    Parameters
    ----------
    L, p, C_L, C_N : float or array
        Flat length, nosing spacing, centroid behind the uphill tip and above the underside [m].
    w_n : float or array
        Indentation under the whole weight on one nosing, W/k [m].
    drop : float or array
        Share of w_t = W/kt by which it drops back as the nosing leaves [m]; `drop_at_most`.
    R : float or array
        Radius of the downhill end [m].

    Returns
    -------
    float or array
        Slope [rad]; NaN where the indentation is half of R or more (and R is not 0), or more than
        the spacing. For p <= L / 2, which is not checked.

    Examples
    --------
    >>> kenaf = {"L": 0.470, "C_L": 0.196, "C_N": 0.071}
    >>> rigid = theta_s_sup_yielding(p=0.150, w_n=0.0, **kenaf)
    >>> soft = theta_s_sup_yielding(p=0.150, w_n=0.0131, **kenaf)
    >>> sagging = theta_s_sup_yielding(p=0.150, w_n=0.0131, drop=0.0131, **kenaf)
    >>> print(*(round(x * 180 / np.pi, 1) for x in (rigid, soft, sagging)))
    60.2 60.1 57.7

    References
    ----------
    Derived (docs/theory/yielding.md). Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, expect
    that "the effect of theta_d can be estimated by mechanical analysis".
    """
    a = np.arctan2(L - p - C_L, C_N + 0.0 * (w_n + drop + R))
    for _ in range(_ROUNDS):
        eta = w_n * np.cos(a)
        theta_d = np.arcsin(eta / p)
        s = np.sqrt(np.maximum(4.0 * R * eta - 4.0 * eta * eta, 0.0))
        x = L + s - p * np.cos(theta_d) - C_L - drop * np.sin(a)
        a = 0.5 * (a + np.arctan2(x, C_N - eta))
    within = (R <= 0.0) | (2.0 * eta < R)
    return (a - theta_d) * np.where(within, 1.0, np.nan)


def drop_at_most(*, w_t: Number, contacts: Number) -> Number:
    """Largest drop, as a length under the whole weight, as a nosing leaves.

    ``drop = w_t (1 - 1/m)``

    Of m contacts that share the pull along the stairs t_0 is the oldest but one, so it bears 1/m of
    it or more; the rest comes to it.

    Parameters
    ----------
    w_t : float or array
        Shear under the whole weight on one nosing, W/kt [m].
    contacts : int or array
        Nosings under the flat before the loss, m [1].

    Returns
    -------
    float or array
        Length [m].

    Examples
    --------
    >>> print(drop_at_most(w_t=0.012, contacts=4))
    0.009

    References
    ----------
    Derived (docs/theory/yielding.md).
    """
    return w_t * (1.0 - 1.0 / contacts)
