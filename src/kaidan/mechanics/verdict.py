"""The verdict of one pair of robot and stairs, and of ten million, by the same operators."""

from typing import NamedTuple

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.margins import margins
from kaidan.modes import FORMULAS, SLIDES_DOWN, Verdict

UNSURE, NO_GO = Verdict.UNSURE.rank, Verdict.NO_GO.rank
_SLIDES_DOWN = FORMULAS.index(SLIDES_DOWN)
"""Code of sliding down; sliding up has the next, tipping the first two."""


class Judged(NamedTuple):
    """Verdict and every margin; angles in rad, lengths in m, accelerations in m/s^2."""

    verdict: Number
    """``kaidan.modes.Verdict`` by its rank."""
    governs: Number
    """Mode of the smallest margin, of a NO-GO with the spare given back; by its place in
    ``kaidan.modes.FORMULAS``, ties go to the first."""
    margin: Number
    """Smallest margin of slope of all modes, allowances off; unknown friction left out."""
    theta_s_sup: Number
    """Steepest slope for this acceleration, without allowances."""
    tip_downhill: Number
    tip_uphill: Number
    slides_down: Number
    slides_up: Number
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

    GO where the smallest margin is positive and friction known; UNSURE where it is positive but
    friction unknown, or where it would be positive with the spare given back; NO-GO else; outside
    the model where p > L / 2. Area E, which needs a controlled acceleration, counts as NO-GO, and
    nothing as ROUGH: the formulas do not tell whether the next contact arrests a rotation.

    Parameters
    ----------
    theta_d, theta_M : float or array
        Allowances of Eq. (24) in the worst case [rad].
    spare_d, spare_M : float or array
        What the best case of theta_d and theta_M gives back [rad]: all of it where nobody measured
        them and they may be zero, nothing where they are known.

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
    array([0, 2, 3])

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y; the words GO, UNSURE, NO-GO are ours.
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
    downhill_at_best, uphill_at_best = m.tip_downhill + (spare_d + spare_M), m.tip_uphill + spare_d
    slip = np.minimum(m.slides_down, m.slides_up)
    at_best = np.fmin(np.minimum(downhill_at_best, uphill_at_best), slip)
    holds, holds_at_best = m.worst > 0, at_best > 0
    unknown, outside = m.slides_down != m.slides_down, m.worst != m.worst
    verdict = holds * unknown * UNSURE + (1 - holds) * (
        holds_at_best * UNSURE + (1 - holds_at_best) * (NO_GO + outside)
    )
    # a NO-GO is decided by what is smallest in the best case
    fails = at_best <= 0
    over_downhill = m.tip_downhill + fails * (spare_d + spare_M)
    over_uphill = m.tip_uphill + fails * spare_d
    slips = slip < np.minimum(over_downhill, over_uphill)
    governs = slips * (_SLIDES_DOWN + (m.slides_up < m.slides_down)) + (1 - slips) * (
        over_uphill < over_downhill
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
        governs,
        m.worst,
        m.theta_s_sup,
        m.tip_downhill,
        m.tip_uphill,
        m.slides_down,
        m.slides_up,
        weight * (np.fmin(mu_s, x / C_N) - t),
        weight * (np.fmax(-mu_s, y / C_N) - t),
        centroid,
        np.abs(t + A * stretch),
    )


def _tangent_of_sum(t: Number, u: Number) -> Number:
    """Tangent of the sum of two angles given by their tangents."""
    return (t + u) / (1.0 - t * u)
