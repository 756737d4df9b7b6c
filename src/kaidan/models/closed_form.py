"""The closed form: the paper's criterion on a regular flight, both cases, every sample."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics.margins import margins
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.mechanics.slipping import required_friction
from kaidan.models import acceleration
from kaidan.models.closed_form_figures import Basis, figures_of
from kaidan.models.drive_limits import steepest_for_drive
from kaidan.models.findings import Array, Finding, Findings, Later, at_risk
from kaidan.models.regular_flight import no_regular_flight
from kaidan.models.samples import Draws, draws, nominal
from kaidan.models.sentences import closed_form as text
from kaidan.modes import CLOSED_FORM, DRIVE, FAILS, FORMULAS, OPEN, TIPS
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs

MODES = (*FORMULAS, DRIVE)
"""Failure modes that it knows, in the order of its arrays."""
_OF_TIPS = {False: FAILS, True: OPEN}
"""Verdicts where it tips, by whether a controlled acceleration may avoid it: nothing tells whether
the next contact would arrest it."""


def judge(question: Question, *, known: Findings | None = None) -> Findings:
    """Findings of the paper's criterion on the regular flight of a question.

    Parameters
    ----------
    question : Question
        Its terrain needs steps; entering and landing are not judged.
    known : Findings, optional
        Of a similar question; not used, because nothing here takes time.
    """
    _ = question.robot.weighed
    flight = question.flight
    if len(question.flights) > 1:
        return Findings(model=CLOSED_FORM.name, outside="the terrain is no single flight of stairs")
    if flight is None:
        return Findings(model=CLOSED_FORM.name, outside="the terrain is no flight of stairs")
    at = nominal(question, flight)
    over = [_over_steps(question, block) for block in draws(question, at)]
    least = over[0]
    for block in over[1:]:
        least = _Least(*(np.minimum(a, b) for a, b in zip(least, block, strict=True)))
    outside = _outside(question, flight, float(np.mean(~least.remain)))
    if not outside and at_risk(np.fmin.reduce(least.modes[:, 1]), question.risk) == -np.inf:
        outside = "the nosing spacing may well be more than half the flat length of the track"
    needed = float(required_friction(theta_s=at.theta_s, a=question.acceleration).max())
    if outside:
        basis = Basis(at, 0, False)
        return Findings(
            model=CLOSED_FORM.name, outside=outside, required_friction=needed, basis=basis
        )
    step = _governing_step(question, at, least)
    basis = Basis(at, step, _semi_stable(question, at, step, least))
    found = tuple(
        Finding(
            mode=mode,
            worst=least.modes[i, 0],
            best=least.modes[i, 1],
            instead=_OF_TIPS[basis.semi_stable] if mode in TIPS else None,
            model=CLOSED_FORM.name,
        )
        for i, mode in enumerate(MODES)
    )
    figures = Later(lambda: (figures_of(question, flight, basis),))
    return Findings(
        model=CLOSED_FORM.name,
        each=found,
        required_friction=needed,
        figures=figures,
        notes=Later(lambda: text.notes(question, flight, figures[0])),
        basis=basis,
    )


class _Least(NamedTuple):
    """Smallest margins over the steps of a flight."""

    modes: Array
    """Of `MODES` in the worst and the best case, (5, 2, samples) [rad]; NaN: not known."""
    remain: NDArray[np.bool_]
    """Whether two contacts always remain, (samples,)."""


def _over_steps(question: Question, at: Draws) -> _Least:
    modes = _margins(question, at).min(axis=-1)
    remain = np.all(two_contacts_remain(L=at.L, p=at.p), axis=-1)
    tips = modes[:2]
    if not np.isnan(tips).all():  # a sample outside the model has no margin at all
        tips[:, np.isnan(tips).any(axis=0)] = -np.inf
    return _Least(modes, np.broadcast_to(remain, modes.shape[-1:]))


def _margins(question: Question, at: Draws) -> Array:
    """Margins of `MODES` in both cases, (5, 2, samples, steps) [rad]."""
    theta_d, theta_M = question.allowance_d, question.allowance_M
    tilt_d = np.array([[[theta_d.high]], [[theta_d.low]]])
    tilt_M = np.array([[[theta_M.high]], [[theta_M.low]]])
    a = question.acceleration
    bare = margins(
        L=at.L,
        C_L=at.C_L,
        C_N=at.C_N,
        p=at.p,
        theta_s=at.theta_s,
        a=a,
        mu_s=np.array((at.mu_low, at.mu_high)),
        theta_d=tilt_d,
        theta_M=tilt_M,
    )
    modes = np.empty((len(MODES), *np.shape(bare.worst)))
    modes[:-1] = bare.tip_downhill, bare.tip_uphill, bare.slides_down, bare.slides_up
    modes[-1] = bare.inside * (steepest_for_drive(question, a) - at.theta_s)
    return modes


def _governing_step(question: Question, at: Draws, least: _Least) -> int:
    """Index of the governing step among the flight's different regular steps."""
    if at.p.size == 1:
        return 0
    per_mode = [at_risk(mode, question.risk) for mode in least.modes[:, 0]]
    known = [math.inf if math.isnan(margin) else margin for margin in per_mode]
    return int(np.argmin(_margins(question, at)[int(np.argmin(known)), 0, 0]))


def _outside(question: Question, flight: Stairs, share_outside: float) -> str:
    stance = question.stance
    if share_outside > question.risk:
        p = max(math.hypot(rise, going) for rise, going in flight.regular_steps)
        spacing, half = f"the nosing spacing of {p * 1e3:.0f} mm", "more than half the flat length"
        if not two_contacts_remain(L=stance.flat_length, p=p):
            return (
                f"{spacing} is {half} of {stance.flat_length * 1e3:.0f} mm (p > L/2), so one "
                "nosing alone carries the robot at times"
            )
        return (
            f"{spacing} is {half} of {stance.flat_length * 1e3:.0f} mm (p > L/2) with a "
            f"probability of {share_outside:.2g}, more than the accepted {question.risk:g}"
        )
    return no_regular_flight(question, flight)


def _semi_stable(question: Question, at: Draws, step: int, least: _Least) -> bool:
    """Whether only tipping fails, and an acceleration that follows the position avoids it."""
    best = at_risk(np.fmin.reduce(least.modes[:, 1]), question.risk)
    others = [at_risk(mode, question.risk) for mode in least.modes[2:, 0]]
    if best > 0 or any(margin <= 0 for margin in others):
        return False
    return acceleration.semi_stable(question, at, step)
