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

from kaidan.mechanics import STANDARD_GRAVITY, Number

_ROUNDS = 80
OVERSHOOT = 2.0
"""How far a spring without a damper goes under a load that comes at once, of where it rests."""
REST = np.radians(8.5)
"""What a gripping tail costs beyond what is derived [rad]: trials took up to 4.1 degrees on a
flight, up to 8.5 from landing to landing (docs/theory/yielding.md)."""


def drop_of_sag(*, theta_d: Number, p: Number, theta_s: Number) -> Number:
    """Fall of the centroid as one nosing takes up all of the pull, of a track that gives theta_d.

    ``w_n sin(theta_s)^2``, ``w_n = p sin(theta_d) / cos(theta_s)``

    The robot comes back over the nosing by ``w_t sin(theta_s)`` along the stairs. Sag and
    indentation under the whole weight are taken as equal, ``w_t = w_n``.

    Parameters
    ----------
    theta_d : float or array
        Extra inclination at the limit [rad].
    theta_s : float or array
        Slope of the stairs [rad].

    Returns
    -------
    float or array
        Height [m].

    Examples
    --------
    >>> fall = drop_of_sag(theta_d=np.arcsin(0.02), p=0.5, theta_s=np.arctan(0.75))
    >>> print(round(fall, 12))
    0.0045

    References
    ----------
    Derived (docs/theory/yielding.md).
    """
    return p * np.sin(theta_d) * np.sin(theta_s) * np.tan(theta_s)


def theta_d_two_contacts(
    *, L: Number, p: Number, C_L: Number, C_N: Number, theta_s: Number, w_n: Number
) -> Number:
    """Extra inclination just after the lowest contact leaves, two nosings carrying.

    ``theta_d = (w_n cos(a) / p) (1 - 2 q)``, ``q = (L - p - C_L - (C_N - eta) tan(a)) / p``,
    ``eta = w_n cos(a) (1 - q)``, ``a = theta_s + theta_d``

    q is the share that the upper nosing carries; first order in eta / p. It is what the paper
    measures as theta_d (Fig. 15), and one measurement of it gives w_n.

    Assumption: the lowest nosing bears all of the pull along the stairs. If the two share it evenly
    w_n is a tenth less for the same theta_d.

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
    w_n : float or array
        Indentation under the whole weight on one nosing, W/k [m].
    drop : float or array
        How far it drops back as the nosing leaves, as a length under the whole weight [m]; no more
        than w_t = W/kt, twice that if it overshoots.
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


def tail_grips(*, w_n: Number, R: Number, mu: Number) -> Number:
    """Whether a round end that leaves a nosing is pulled down round it.

    ``w_n >= R (1 - mu / sqrt(1 + mu^2))``

    On the end the contact turns by phi. Beyond phi = atan(1/mu) the friction that drives the robot
    pulls its tail down by more than the nosing pushes it up. The nosing gets so far only if the
    end, which rises by R (1 - cos(phi)), still presses on it. ``w_n`` is the most by which it does
    under the flat. Close to the limit the nosing is 2 w_n cos(a) deep in the prolonged flat, so
    there the criterion is no bound; trials against it found no fall (docs/theory/yielding.md).

    Parameters
    ----------
    w_n : float or array
        Indentation under the whole weight on one nosing [m].
    R : float or array
        Radius of the downhill end [m].
    mu : float or array
        Static friction [1]; infinite: it grips whatever the radius.

    Returns
    -------
    bool or array

    Examples
    --------
    >>> [bool(tail_grips(w_n=0.003, R=0.060, mu=mu)) for mu in (1.0, 3.0)]
    [False, False]
    >>> [bool(tail_grips(w_n=0.003, R=0.020, mu=mu)) for mu in (1.0, 3.0)]
    [False, True]

    References
    ----------
    Derived (docs/theory/yielding.md).
    """
    return w_n >= R * (1.0 - np.sin(np.arctan(mu)))


def yielding_loss(
    *,
    L: Number,
    p: Number,
    C_L: Number,
    C_N: Number,
    w_n: Number,
    w_t: Number,
    R: Number,
    mu: Number,
    speed: Number,
    gyration: Number,
    g: float = STANDARD_GRAVITY,
) -> Number:
    """Margin that a yielding track costs at most, of the rigid formula's: what a verdict subtracts.

    Where the tail does not grip (`tail_grips`) it is the loss with a drop that is final,
    ``theta_r - theta_s_sup_yielding(drop=w_t)``. Where it does, the drop overshoots, the body
    turns at up to ``speed / p`` as the nosing leaves, and what is not derived is `REST`:
    ``theta_r - theta_s_sup_yielding(drop=2 w_t) + tau speed (1/p - C_N/H^2) + REST``,
    ``tau = sqrt((gyration^2 + H^2) / (g H))``, ``H^2 = (L - p - C_L)^2 + C_N^2``.

    Parameters
    ----------
    w_n, w_t : float or array
        Indentation and shear under the whole weight on one nosing [m].
    R : float or array
        Radius of the downhill end [m].
    mu : float or array
        Largest static friction [1].
    speed : float or array
        Of the belt [m/s].
    gyration : float or array
        Radius of gyration about the lateral axis through the centroid [m].

    Returns
    -------
    float or array
        Angle [rad], zero or more; NaN where not even the rigid robot stands on its lowest nosing
        (``L - p - C_L <= 0``).

    Examples
    --------
    >>> kenaf = dict(L=0.470, p=0.150, C_L=0.196, C_N=0.071, gyration=0.15, speed=0.1)
    >>> print(round(yielding_loss(w_n=0.002, w_t=0.003, R=0.060, mu=2.0, **kenaf) * 180 / np.pi, 1))
    0.6
    >>> print(round(yielding_loss(w_n=0.002, w_t=0.003, R=0.010, mu=3.0, **kenaf) * 180 / np.pi, 1))
    12.8

    References
    ----------
    Derived but for `REST` (docs/theory/yielding.md).
    """
    rigid = np.arctan2(L - p - C_L, C_N)
    H = np.hypot(L - p - C_L, C_N)
    over = np.where(tail_grips(w_n=w_n, R=R, mu=mu), OVERSHOOT, 1.0)
    sup = theta_s_sup_yielding(L=L, p=p, C_L=C_L, C_N=C_N, w_n=w_n, drop=over * w_t)
    tau = np.sqrt((gyration**2 + H**2) / (g * H))
    turning = np.maximum(tau * speed * (1.0 / p - C_N / H**2), 0.0)
    loss = rigid - sup + np.where(over > 1.0, turning + REST, 0.0)
    return np.maximum(loss, 0.0) * np.where(L - p - C_L > 0.0, 1.0, np.nan)
