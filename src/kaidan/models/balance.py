"""Balance over a whole traverse: tipping, falls, rotations and energy, as findings.

Two margins in one unit. A robot rocks where gravity, tilted by the allowances, passes the contact
that stays: the paper's criterion of no rotation. Where it rocks, the traverse under tilted gravity
says how far it is from a fall, and its momentum whether it is arrested; of one that does not, the
energy margin says whether its speed may rock it. The paper's rig fell at 55-57 degrees where a
smooth rigid tail would have arrested it up to 62, hence the reserve. At a yaw the support polygon
judges tipping and energy on the flight.
"""

import math
from dataclasses import replace

import numpy as np

from kaidan.contact import Status
from kaidan.models import support_polygon
from kaidan.models.drawn_falls import drawn_falls
from kaidan.models.findings import Array, Finding
from kaidan.models.spread import Spread
from kaidan.models.traction import Supplies
from kaidan.modes import (
    CONTACT,
    ENERGY,
    FALL_DOWNHILL,
    FALL_UPHILL,
    IMPACT,
    MOMENTUM,
    ROTATION,
    TIP_DOWNHILL,
    TIP_UPHILL,
    FailureMode,
    Phase,
)
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Chain, FirstRock, PhaseExtremes, Traverse
from kaidan.traversal.rotations import ROCKING, TAKEN_UP

FALL = math.pi / 2
"""Margin against a fall that no tilt within reason prevents [rad]."""
_ROUNDING = 1e-8
"""Rotation that is rounding [rad]."""
_PLACE = 1e-6
"""Rise that is rounding [m]: a contact is lost or made to within this of its place."""
_FELL = (Status.FELL_BACKWARD, Status.FELL_FORWARD)
_NAME = CONTACT.name


def balance(
    question: Question,
    driven: Question,
    found: Traverse,
    over: Spread,
    phase: Phase | None,
    held: Supplies | None,
) -> list[Finding]:
    """Findings of tipping, falls, rotations and energy."""
    phases = tuple(each for each in found.phases if phase in (None, each.phase))
    chains = [each for each in found.chains if each.arrested and phase in (None, each.phase)]
    tips = _tips(question, driven, found, over, phase)
    rotation = _rocking(found, over, phase)
    flight = question.terrain
    if question.yaw and isinstance(flight, Stairs):
        on_flight = phase in (None, Phase.TRAVERSE)
        energy = _energy(driven, found, over, phases, held, flight=not on_flight)
        if on_flight:
            rise = float(support_polygon.energy_of(question, flight, np.array([question.yaw]))[0])
            energy = _least(energy, support_polygon.energy_finding(question, rise))
    else:
        energy = _energy(driven, found, over, phases, held)
    if math.isfinite(found.enough) and any(one.fails().any() for one in tips):
        # nothing is left beyond the reserve
        found = found.seeking(found.sought, enough=min(found.enough, driven.reserve + _ROUNDING))
    # a fall lies in its phase, wherever the robot rocks before
    rocks = tips, rotation
    if phase is not None:
        rocks = _tips(question, driven, found, over, None), _rocking(found, over, None)
    falls = _falls(driven, found, over, *rocks, phase)
    return [
        *tips,
        *falls,
        rotation,
        *_hits(driven, found, chains, phase),
        *([] if any(one.fails(best=True).all() for one in tips) else [energy]),
    ]


def _tips(
    question: Question, driven: Question, found: Traverse, over: Spread, phase: Phase | None
) -> list[Finding]:
    """Tilt to the first rock, less the allowances, of all or of one phase."""
    flight = question.terrain
    if question.yaw and isinstance(flight, Stairs):
        if phase not in (None, Phase.TRAVERSE):
            return []
        return list(support_polygon.tips(question, flight))
    phases = None if phase is None else tuple(one for one in found.phases if one.phase is phase)
    d, M = driven.allowance_d, driven.allowance_M
    each = []
    for mode, off in (
        (TIP_DOWNHILL, (d.high + M.high, d.low + M.low)),
        (TIP_UPHILL, (d.high, d.low)),
    ):
        downhill = mode is TIP_DOWNHILL
        rock = found.first_rock(downhill=downhill, phases=phases)
        if rock is None:
            continue
        margin = _drawn(found, over, rock, downhill, phases)
        each.append(
            Finding(
                mode=mode,
                worst=margin - off[0],
                best=margin - off[1],
                phase=rock.phase,
                step=rock.step,
                model=_NAME,
            )
        )
    return each


def _drawn(
    found: Traverse,
    over: Spread,
    rock: FirstRock,
    downhill: bool,
    phases: tuple[PhaseExtremes, ...] | None,
) -> Array:
    """Tilt to the first rock of each sample, in whichever phase that is [rad]."""
    if not downhill or np.array_equal(over.landing, over.tip_downhill):
        # of every sample in the same phase
        return rock.margin + over.tip(rock.phase, downhill=downhill)
    each = [rock]
    for phase in found.phases if phases is None else phases:
        other = found.first_rock(downhill=downhill, phases=(phase,))
        if other is not None and other.phase is not rock.phase:
            each.append(other)
    return np.asarray(
        np.minimum.reduce([one.margin + over.tip(one.phase, downhill=downhill) for one in each])
    )


def _falls(
    question: Question,
    found: Traverse,
    over: Spread,
    tips: list[Finding],
    rotation: Finding,
    phase: Phase | None,
) -> list[Finding]:
    """Tilt to the fall, less the reserve, of a robot that rocks or falls.

    One that does not rock does not fall: of its margins the larger counts.
    """
    if found.status is Status.STUCK:
        return []
    each = []
    rotates = rotation.fails()
    for mode, tip, samples in (
        (FALL_DOWNHILL, TIP_DOWNHILL, over.tip_downhill),
        (FALL_UPHILL, TIP_UPHILL, over.tip_uphill),
    ):
        downhill = mode is FALL_DOWNHILL
        rocks = next((one for one in tips if one.mode is tip), None)
        falls = not found.arrived and _over_its_downhill_end(found) is downhill
        if not (found.arrived or falls):
            continue  # it falls over its other end
        turns = np.full(1, True) if falls else rotates & downhill
        if not turns.any() and (rocks is None or not rocks.fails().any()):
            continue
        fall = found.falls_downhill if downhill else found.falls_uphill
        if phase not in (None, fall.phase):
            continue
        counts = turns if rocks is None else turns | rocks.fails()
        drawn = drawn_falls(question, found, samples, counts, downhill=downhill)
        spare = np.maximum(drawn, -FALL)
        still = (math.inf, math.inf) if rocks is None else (rocks.worst, rocks.best)
        worst, best = (np.where(turns, spare, np.maximum(spare, margin)) for margin in still)
        each.append(
            Finding(
                mode=mode, worst=worst, best=best, phase=fall.phase, step=fall.step, model=_NAME
            )
        )
    return each


def _over_its_downhill_end(found: Traverse) -> bool:
    """Over which end a robot falls that does."""
    return (found.status is Status.FELL_BACKWARD) is not found.descending


def _hits(
    question: Question, found: Traverse, chains: list[Chain], phase: Phase | None = None
) -> list[Finding]:
    """Rotations that are arrested: how hard they end, and whether momentum topples.

    Those that the rubber takes up have none; the energy margin judges their poses. Gravity is
    tilted by the allowances; a sudden stop adds to the drop, and sag going down.
    """
    tolerated = question.robot.tolerated_impact
    spare = [tolerated - one.impact_speed for one in chains]
    each = [_of_smallest(IMPACT, spare, chains, _falls_in(found, phase))]
    chains = [each for each in chains if each.angle > TAKEN_UP]
    if chains:
        d, M = question.allowance_d, question.allowance_M
        high, low = (d.high + M.high, d.high), (d.low + M.low, d.low)
        if found.descending:  # the leading end is the downhill one
            high, low = high[::-1], low[::-1]
        spares = [one.spare(high) for one in chains]
        worst = next(
            one for one, spare in zip(chains, spares, strict=True) if spare < min(spares) + _PLACE
        )
        each.append(
            Finding(
                mode=MOMENTUM,
                worst=np.array([worst.spare(high) - question.momentum_threshold()]),
                best=np.array([min(one.spare_after_impact(low) for one in chains)]),
                phase=worst.phase,
                step=worst.step,
                model=_NAME,
            )
        )
    return each


def _rocking(found: Traverse, over: Spread, phase: Phase | None) -> Finding:
    """Largest rocking, seen or foretold, of all or of one phase."""
    chains = [each for each in found.chains if each.arrested and phase in (None, each.phase)]
    spare = [ROCKING - one.rocking for one in chains]
    seen = _of_smallest(ROTATION, spare, chains, _falls_in(found, phase))
    if phase not in (None, Phase.TRAVERSE) or not found.whole:
        return seen
    rocking = found.criterion.rocking + over.rocking
    if rocking.max() < _ROUNDING:
        return seen
    foretold = ROCKING - rocking
    if seen.worst.min() <= foretold.min():
        return seen
    margin = np.fmin(seen.worst, foretold)
    return replace(seen, worst=margin, best=margin, phase=Phase.TRAVERSE, step=None)


def _falls_in(found: Traverse, phase: Phase | None) -> bool:
    """Whether it falls, of all or in one phase."""
    return found.status in _FELL and phase in (None, found.end[0])


def _of_smallest(mode: FailureMode, margins: list[float], of: list[Chain], falls: bool) -> Finding:
    """Finding of the smallest of some margins; without any infinite, or not known if it falls."""
    if not margins and falls:
        return Finding.certain(mode, math.nan, model=_NAME)
    if not margins:
        return Finding.certain(mode, math.inf, model=_NAME)
    # of those that are alike the first: a traverse repeats itself
    k = int(np.flatnonzero(np.array(margins) < min(margins) + _ROUNDING)[0])
    return Finding.certain(
        mode,
        margins[k],
        phase=of[k].phase,
        step=of[k].step,
        model=_NAME,
    )


def _energy(
    question: Question,
    found: Traverse,
    over: Spread,
    phases: tuple[PhaseExtremes, ...],
    held: Supplies | None,
    *,
    flight: bool = True,
) -> Finding:
    """Smallest energy margin of any pose that nothing obliges to rotate, less the threshold.

    Towards the downhill end the speed of a slip back onto grousers adds to that of the threshold in
    its phase. The robot over the edge of the upper landing, and on the first nosing, where the nose
    comes down onto the flight, is obliged to rotate: figures of a phase leave that out. With
    `flight` False only what is not the flight counts. A robot that falls has none.
    """
    slips = ({}, {}) if held is None else (held.worst.heights, held.best.heights)
    threshold = question.energy_threshold()
    least, phase, step = math.inf, None, None
    worst, best = np.full(1, math.inf), np.full(1, math.inf)
    for each in phases:
        (down, step_down), (up, step_up) = each.steadiness, each.uphill_steadiness
        of_slip = [
            question.energy_threshold(heights[each.phase]) - threshold
            if each.phase in heights
            else 0.0
            for heights in slips
        ]
        values = []
        if not flight:
            if each.phase is (Phase.LAND if found.descending else Phase.ENTER):
                values.append((down - of_slip[0], down - of_slip[1], step_down))
        else:
            values.append((down - of_slip[0], down - of_slip[1], step_down))
            if each.phase is Phase.TRAVERSE:
                values.append((up, up, step_up))
        for low, high, at in values:
            if low < least - _PLACE:
                least, phase, step = low, each.phase, at
            worst = np.minimum(worst, max(low, least) + over.energy(each.phase))
            best = np.minimum(best, high + over.energy(each.phase))
    ends = found.end[0]
    if found.status in _FELL and any(each.phase is ends for each in phases):
        worst, best = np.zeros(1), np.zeros(1)
        phase, step = found.end
    return Finding(
        mode=ENERGY,
        worst=worst - threshold,
        best=best - threshold,
        phase=phase,
        step=step,
        model=_NAME,
    )


def _least(one: Finding, other: Finding) -> Finding:
    """The finding with the smaller margin."""
    return one if one.worst.min() <= other.worst.min() else other
