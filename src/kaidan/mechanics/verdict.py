"""The verdict of one pair of robot and stairs, and of ten million, by the same operators."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.margins import margins


class Verdict(IntEnum):
    """What the numbers say, from best to worst; the words of `kaidan.assess` in code."""

    GO = 0
    CAUTION = 1
    NO_GO = 2
    OUTSIDE_MODEL = 3


class Judged(NamedTuple):
    """Verdict and every margin; angles in rad, lengths in m, accelerations in m/s^2."""

    verdict: Number
    """`Verdict`."""
    governs: Number
    """`kaidan.mechanics.margins.Mode` of the smallest margin."""
    margin: Number
    """Smallest margin of slope of all modes, allowances off; unknown friction left out."""
    theta_s_sup: Number
    """Steepest slope for this acceleration, without allowances."""
    tip_downhill: Number
    tip_uphill: Number
    slip_up: Number
    slip_down: Number
    a_max: Number
    """Upper end of the band of acceleration, without allowances."""
    a_min: Number
    """Lower end."""
    centroid: Number
    """How far the centroid may move along the track, allowances off."""
    required_friction: Number


def judged(
    *,
    L: Number,
    C_L: Number,
    C_N: Number,
    theta_s: Number,
    p: Number,
    mu_s: Number,
    a: Number = 0.0,
    theta_d: Number = 0.0,
    theta_M: Number = 0.0,
    spare_d: Number = 0.0,
    spare_M: Number = 0.0,
    g: Number = STANDARD_GRAVITY,
) -> Judged:
    """Verdict and every margin of a pair of robot and stairs.

    GO where the smallest margin is positive and friction known; CAUTION where it is positive but
    friction unknown, or where it would be positive with the spare given back; NO-GO else; outside
    the model where p > L / 2. Area E, which needs a controlled acceleration, counts as NO-GO.

    Parameters
    ----------
    L : float or array
        Length of the flat underside [m].
    C_L, C_N : float or array
        Centroid behind the uphill tip and above the underside [m].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    p : float or array
        Nosing spacing [m].
    mu_s : float or array
        Static friction [1]; NaN for unknown.
    a : float or array
        Acceleration up the stairs [m/s^2].
    theta_d, theta_M : float or array
        Allowances of Eq. (24), their worst reading [rad].
    spare_d, spare_M : float or array
        What the kindest reading of theta_d and theta_M gives back [rad]: all of it where nobody
        measured them and they may be zero, nothing where they are known.
    g : float
        Gravity [m/s^2].

    Returns
    -------
    Judged
        NaN margins outside the model.

    Examples
    --------
    >>> kenaf = dict(L=0.470, C_L=0.196, C_N=0.071, p=0.150, mu_s=2.0)
    >>> slopes = np.radians([50.0, 58.0, 62.0])
    >>> allowance = np.radians(2.6)
    >>> unmeasured = dict(theta_d=allowance, spare_d=allowance)
    >>> judged(theta_s=slopes, theta_M=allowance, spare_M=allowance, **unmeasured, **kenaf).verdict
    array([0, 1, 2])

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y; the words GO, CAUTION, NO-GO are ours.
    """
    m = margins(
        L=L,
        C_L=C_L,
        C_N=C_N,
        theta_s=theta_s,
        p=p,
        mu_s=mu_s,
        a=a,
        theta_d=theta_d,
        theta_M=theta_M,
        g=g,
    )
    tip_at_best = np.minimum(m.tip_downhill + (spare_d + spare_M), m.tip_uphill + spare_d)
    at_best = np.fmin(tip_at_best, np.minimum(m.slip_up, m.slip_down))
    holds, holds_at_best = m.worst > 0, at_best > 0
    unknown, outside = m.slip_up != m.slip_up, m.worst != m.worst
    verdict = holds * unknown * Verdict.CAUTION + (1 - holds) * (
        holds_at_best * Verdict.CAUTION + (1 - holds_at_best) * (Verdict.NO_GO + outside)
    )
    # sin and cos from the tangent: over arrays the trigonometry is what costs
    x, y = L - p - C_L, p - C_L
    t = np.tan(theta_s)
    A = a / g
    stretch = np.sqrt(1.0 + t * t)
    weight = m.inside * g / stretch
    downhill = _tangent_of_sum(t, np.tan(theta_d + theta_M))
    uphill = _tangent_of_sum(t, -np.tan(theta_d))
    centroid = m.inside * np.minimum(
        x - C_N * (downhill + A * np.sqrt(1.0 + downhill * downhill)),
        C_N * (uphill + A * np.sqrt(1.0 + uphill * uphill)) - y,
    )
    return Judged(
        verdict,
        m.governs,
        m.worst,
        m.theta_s_sup,
        m.tip_downhill,
        m.tip_uphill,
        m.slip_up,
        m.slip_down,
        weight * (np.fmin(mu_s, x / C_N) - t),
        weight * (np.fmax(-mu_s, y / C_N) - t),
        centroid,
        np.abs(t + A * stretch),
    )


def _tangent_of_sum(t: Number, u: Number) -> Number:
    """Tangent of the sum of two angles given by their tangents."""
    return (t + u) / (1.0 - t * u)
