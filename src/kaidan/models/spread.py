"""How far the inputs' uncertainties carry the contact model's margins.

On a uniform flight with a doubt of the whole alone the criterion of no rotation is the closed form,
so its samples are the closed form's own (the same Latin hypercube), less its figure for the sheets;
a robot that no single flat carries is taken to feel its inputs alike. On any other terrain, and
where single steps are in doubt, the nosings and the robot are drawn and the criterion judges each
draw anew, so that the order of events and the nosings that carry are the draw's own.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from kaidan.mechanics.margin import theta_s_inf, theta_s_sup
from kaidan.models.findings import Array
from kaidan.models.samples import Draws, draws, nominal, sample_count, unit_draws
from kaidan.modes import Phase
from kaidan.question import Question
from kaidan.terrain.polyline import frozen
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Traverse

if TYPE_CHECKING:
    from kaidan.traversal.drawn_criterion import Drawn

_OF_ALL = 6
"""Rows of the unit draws that are of the robot, of the whole flight and of friction."""


class Spread(NamedTuple):
    """Differences of the margins from their nominal values, one for each sample."""

    tip_downhill: Array
    """[rad]"""
    tip_uphill: Array
    """[rad]"""
    landing: Array
    """The same downhill, with the uphill end over the landing already [rad]."""
    rocking: Array
    """Of the largest rocking on the flight [rad]."""
    rise: Array
    """Of the energy margin on the flight [m]."""
    landing_rise: Array
    """The same with the uphill end over the landing already [m]."""
    angle: Array
    """Of the slope itself [rad]: it goes off the margins of friction and drive in full."""
    inclination: Array
    """Of the steepest inclination on the flight, which does so where the flight decides [rad]."""
    landing_inclination: Array
    """The same with the uphill end over the landing already [rad]."""
    friction: Array
    """Of the static friction [1]."""
    over_landing: Phase = Phase.LAND
    """Phase in which the uphill end is over the landing already: going down ENTER."""

    def tip(self, phase: Phase, *, downhill: bool) -> Array:
        """Of the tilt to the first rock in a phase [rad]."""
        if phase is self.over_landing and downhill:
            return self.landing
        return self.tip_downhill if downhill else self.tip_uphill

    def steeper(self, phase: Phase | None) -> Array:
        """Of the inclination that goes off the margin of friction of a phase [rad]."""
        known = {Phase.TRAVERSE: self.inclination, self.over_landing: self.landing_inclination}
        return self.angle if phase is None else known.get(phase, self.angle)

    def energy(self, phase: Phase) -> Array:
        """Of the energy margin of a phase [m]."""
        known = {Phase.TRAVERSE: self.rise, self.over_landing: self.landing_rise}
        return known.get(phase, np.zeros(1))


def spread(question: Question, traverse: Traverse) -> Spread:
    """Spread of the margins of a question; one sample, all zero, where every input is exact."""
    if not question.uncertain:
        return Spread(*np.zeros((10, 1)))
    count, flight = sample_count(question), question.steepest_flight
    drawn = drawn_of_all(question)
    angle, friction, exact = _of_slope(drawn, question), drawn[5], np.zeros(count)
    down = up = exact
    if flight is not None:
        down, up = _by_closed_form(question, flight)
    regular = isinstance(question.terrain, Stairs) and question.terrain.rise is not None
    if regular and not question.steps_uncertain:
        none = np.zeros(1)
        return Spread(down, up, down, none, none, none, angle, angle, angle, friction)
    found, nominal_ = _by_draws(question, traverse, drawn)
    down = _off(found.downhill, nominal_.downhill, down)
    return Spread(
        tip_downhill=down,
        tip_uphill=_off(found.uphill, nominal_.uphill, up),
        landing=_off(found.landing, nominal_.landing, down),
        rocking=found.rocking - nominal_.rocking,
        rise=_off(found.rise, nominal_.rise, exact) if traverse.whole else exact,
        landing_rise=_off(found.landing_rise, nominal_.landing_rise, exact)
        if traverse.whole
        else exact,
        angle=angle,
        inclination=_off(found.inclination, nominal_.inclination, angle),
        landing_inclination=_off(found.landing_inclination, nominal_.landing_inclination, angle),
        friction=friction,
        over_landing=Phase.ENTER if question.direction == "down" else Phase.LAND,
    )


def _of_slope(drawn: Array, question: Question) -> Array:
    """What the samples change of the slope, shape (samples,) [rad].

    Of several flights the largest doubt: their nosings have it in their covariance, `drawn` not.
    """
    if len(question.flights) < 2:
        return np.asarray(drawn[3])
    doubt = max(each.uncertainty.angle for each in question.flights)
    return np.asarray(doubt * unit_draws(drawn.shape[1])[3])


def drawn_of_all(question: Question) -> Array:
    """What the samples change of L, C_L, C_N, angle, nosing spacing and friction, (6, samples)."""
    unit = unit_draws(sample_count(question))[:_OF_ALL]
    return np.asarray(unit * np.array(question.spread)[:, None])


def nosings_of(profile: Profile, drawn: Array) -> Array:
    """Nosings of each sample, shape (samples, m, 2) [m].

    drawn, shape (6, samples): of `drawn_of_all`.
    """
    unit = unit_draws(drawn.shape[1], _OF_ALL + 2 * len(profile.nosings))[_OF_ALL:]
    single = profile.drawn_nosings(unit) - profile.nosings
    return changed_nosings(profile.nosings, angle=drawn[3], spacing=drawn[4]) + single


def _off(drawn: Array, nominal_: Array, otherwise: Array) -> Array:
    """Differences from the nominal value, where both are known."""
    known = np.isfinite(drawn) & np.isfinite(nominal_)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(known, drawn - nominal_, otherwise))


def _by_draws(question: Question, traverse: Traverse, drawn: Array) -> "tuple[Drawn, Drawn]":
    """What the criterion says of each draw of the nosings and the robot, and of the sheets'."""
    from kaidan.traversal.drawn_criterion import DrawnTread, drawn_criterion

    profile, tread = question.profile, traverse.tread
    L, C_L, C_N, *_ = drawn
    on = DrawnTread(
        L=tread.L + L,
        C_L=tread.C_L + (C_L if question.nose_up else L - C_L),
        C_N=np.maximum(tread.C_N + C_N, 1e-4),
    )
    exact = DrawnTread(*(np.array([each]) for each in tread[:3]))
    found, nominal_ = (
        drawn_criterion(
            profile.nosings,
            nosings,
            tread,
            each,
            acceleration=question.acceleration,
            within=traverse.part,
        )
        for nosings, each in ((nosings_of(profile, drawn), on), (profile.nosings[None], exact))
    )
    return found, nominal_


def _by_closed_form(question: Question, flight: Stairs) -> tuple[Array, Array]:
    """Tip margins of the samples, less those of the sheets' figures [rad]."""
    at = nominal(question, flight)
    a = question.acceleration
    nominal_down, nominal_up = _tips(at, a)
    each = [_tips(block, a) for block in draws(question, at)]
    down, up = (np.minimum.reduce([block[side] for block in each]) for side in (0, 1))
    return down - nominal_down, up - nominal_up


def _tips(at: Draws, a: float) -> tuple[Array, Array]:
    """Margins downhill and uphill of each sample, over the steps [rad].

    Past p = L/2 too, where one of the two is never positive: that fewer than two nosings then stay
    is another finding.
    """
    place = {"p": at.p, "C_L": at.C_L, "C_N": at.C_N, "a": a}
    down = theta_s_sup(L=at.L, **place) - at.theta_s
    up = at.theta_s - theta_s_inf(**place)
    return np.asarray(down.min(axis=-1)), np.asarray(up.min(axis=-1))


def changed_nosings(nosings: Array, *, angle: Array, spacing: Array) -> Array:
    """Nosings of which every step to the next is steeper and longer by so much, of each draw."""
    steps = np.diff(nosings, axis=0)
    slope = np.arctan2(steps[:, 1], steps[:, 0]) + angle[:, None]
    length = np.hypot(steps[:, 0], steps[:, 1]) + spacing[:, None]
    moved = np.stack([length * np.cos(slope), length * np.sin(slope)], axis=-1)
    still = np.zeros((len(angle), min(len(nosings), 1), 2))
    moved = np.concatenate([still, np.cumsum(moved, axis=1)], axis=1)
    return np.asarray(nosings[:1] + moved)


def moved_profile(profile: Profile, nosings: Array) -> Profile:
    """Profile with its nosings elsewhere: risers go with them, treads lie as high as theirs.

    nosings, shape (m, 2): new places, in their order [m].
    """
    if len(nosings) == 0:
        return replace(profile, covariance=None)
    off = nosings - profile.nosings

    def at(points: Array) -> Array:
        along = np.interp(points[:, 0], profile.nosings[:, 0], off[:, 0])
        # a point belongs to the last nosing that it does not lie below or before
        same = np.abs(points[:, None] - profile.nosings[None]).max(axis=2) < 1e-9
        behind = points[:, None, 0] > profile.nosings[None, :, 0] + 1e-9
        last = (same | behind).cumsum(axis=1).argmax(axis=1)
        up = np.where((same | behind).any(axis=1), off[last, 1], 0.0)
        return np.asarray(points + np.column_stack([along, up]))

    return replace(
        profile,
        points=frozen(at(profile.points)),
        nosings=frozen(nosings),
        edges=frozen(at(profile.edges)),
        covariance=None,
    )
