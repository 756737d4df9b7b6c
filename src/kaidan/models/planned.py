"""The contact model of a plan: part after part of the traverse, each in its posture.

A part begins in the pose in which the change of posture ended, so the parts and the changes are
the whole traverse. Each part is judged as any traverse is; the plan has the smallest margin of all.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from kaidan.answer import Part as Figures
from kaidan.models import traction
from kaidan.models.contact_figures import ContactFigures, Grades, PhaseFigures, TiltFigures
from kaidan.models.findings import Finding, Findings, Later, hardest, sliding_where, smallest
from kaidan.models.quasi_static import Basis, driven_over, findings_of, profile_of
from kaidan.models.traction_figures import TractionFigures
from kaidan.modes import (
    CONTACT,
    ENERGY,
    FAILS,
    FLIPPER_TORQUE,
    OPEN,
    POSTURE_CHANGE,
    SLIDES_DOWN,
    TIP_DOWNHILL,
    FailureMode,
    Phase,
)
from kaidan.question import Question
from kaidan.robot import Posture
from kaidan.terrain.profile import Profile
from kaidan.traversal import Traverse
from kaidan.traversal.moves import Move, move
from kaidan.traversal.rotations import ROCKING

STAND_OFF = 0.05
"""How far before a nosing the centroid stands while the flippers move [m]: an operator stops within
some centimetres."""


class Part(NamedTuple):
    """A part of a traverse in one posture."""

    question: Question
    """In that posture throughout."""
    traverse: Traverse


class Planned(NamedTuple):
    """Traverse of a plan."""

    question: Question
    """As it was driven."""
    parts: tuple[Part, ...]
    """Those that were driven: the last one ends the traverse."""
    moves: tuple[Move, ...]
    """Changes of posture between them."""

    @property
    def arrived(self) -> bool:
        """Whether the robot arrives."""
        return self.parts[-1].traverse.arrived and all(each.stands for each in self.moves)


def drive(
    question: Question,
    *,
    over: Callable[..., Any] = driven_over,
    moved: Callable[..., Move] | None = None,
    **how: Any,
) -> Planned:
    """Drive a plan of postures, from landing to landing.

    over: what drives a part, as `driven_over` does: its path, and whether it arrives, is needed.
    moved: what changes a posture; `move` without it.
    **how: as for `kaidan.traversal.traverse`.
    """
    moved, profile = moved or move, profile_of(question)
    stages = list(stages_of(question))
    ends = [stop(question, profile, phase) for phase, _ in stages[1:]]
    parts: list[Part] = []
    moves: list[Move] = []
    start = None
    for k, (phase, posture) in enumerate(stages):
        alone = question.changed(posture=posture, changes=())
        if k:
            before = parts[-1]
            moves.append(
                moved(
                    question.robot,
                    before.question.posture,
                    posture,
                    before=phase,
                    start=before.traverse.path.poses.placement(-1),
                    ground=before.traverse.path.ground.points,
                    payload=question.payload,
                    facing=question.facing,
                )
            )
            if not moves[-1].stands:
                break
            start = moves[-1].end
        until = ends[k] if k < len(ends) else None
        found = over(profile, alone, start=start, until=until, **how)
        parts.append(Part(alone, found))
        if not found.arrived:
            break
    return Planned(question, tuple(parts), tuple(moves))


def stages_of(question: Question) -> Iterator[tuple[Phase, Posture]]:
    """Postures one after the other, each with the phase from which on it is taken up."""
    last = None
    for phase, posture in question.postures.items():
        if posture != last:
            yield phase, posture
        last = posture


def stop(question: Question, profile: Profile, phase: Phase) -> float:
    """Where the centroid stands while the robot changes its posture for a phase, as driven [m]."""
    driven = profile.reflected() if question.direction == "down" else profile
    nosing = driven.nosings[0 if phase is Phase.TRAVERSE else -1]
    return float(nosing[0]) - STAND_OFF


def findings(question: Question, planned: Planned, *, most: float = math.inf) -> Findings:
    """Findings of the traverse of a plan: the smallest margins of its parts and changes.

    question: as it was put; what plays no part in the traverse may differ from what was driven.
    most: as for `kaidan.models.quasi_static.findings_of`.
    """
    of_parts = []
    for part in planned.parts:
        alone = part.question
        if question is not planned.question:
            alone = question.changed(posture=alone.posture, changes=())
        of_parts.append(findings_of(alone, Basis(alone, part.traverse), most=most))
    basis = Basis(question, planned)
    outside = next((each.outside for each in of_parts if each.outside), "")
    if outside:
        return Findings(model=CONTACT.name, outside=outside, basis=basis)
    needed = [found.required_friction for found in of_parts]
    of_each = [found.each for found in of_parts]
    for change in planned.moves:
        standing = traction.standing(question, change) if len(change.path.poses) else None
        needed.append(math.nan if standing is None else standing.required)
        of_each.append(_of_move(question, change, standing))
    of_modes: dict[FailureMode, list[Finding]] = {}
    for some in of_each:
        for one in some:
            of_modes.setdefault(one.mode, []).append(one)
    steepest = of_each[hardest(needed)]
    return Findings(
        model=CONTACT.name,
        each=tuple(sliding_where(steepest, _smallest(some)) for some in of_modes.values()),
        required_friction=float(np.fmax.reduce(needed)),
        figures=Later(
            lambda: tuple(_together([each for found in of_parts for each in found.figures]))
        ),
        notes=Later(
            lambda: tuple(dict.fromkeys(note for found in of_parts for note in found.notes))
        ),
        basis=basis,
    )


def _smallest(some: Sequence[Finding]) -> Finding:
    """Finding of one mode with the smallest margin of all parts, the earliest of those alike."""
    if len(some) == 1:
        return some[0]
    margins = [one.worst.item() if one.worst.size == 1 else float(np.fmin.reduce(one.worst))
               for one in some]  # fmt: skip
    known = [k for k, margin in enumerate(margins) if not math.isnan(margin)] or range(len(some))
    first = some[min(known, key=lambda k: round(margins[k], 6))]
    return replace(
        first,
        worst=smallest(some[k].worst for k in known),
        best=smallest(some[k].best for k in known),
        instead=max((some[k].if_fails for k in known), key=lambda row: row.best.rank),
    )


def _of_move(
    question: Question, each: Move, standing: traction.Standing | None
) -> tuple[Finding, ...]:
    """Findings of a change of posture: whether it stands, with what friction, energy, torque."""
    margin = -math.inf if not each.stands or each.rocks > ROCKING else math.inf
    certain = partial(Finding.certain, phase=each.before, model=CONTACT.name)
    found = [certain(POSTURE_CHANGE, margin, instead=None if each.stands else FAILS)]
    if standing is not None:
        worst, best = np.array([standing.worst]), np.array([standing.best])
        slides = certain(SLIDES_DOWN, 0.0)
        energy = certain(ENERGY, each.energy - question.kinetic_height)
        found += [replace(slides, worst=worst, best=best), energy]
    found += _tips_on_the_way(question, each)
    if not math.isnan(each.spare_torque):
        found.append(certain(FLIPPER_TORQUE, each.spare_torque))
    return tuple(found)


def _tips_on_the_way(question: Question, each: Move) -> list[Finding]:
    """Tipping over its downhill end where that is nearer on the way than before and after."""
    down = question.direction == "down"
    if down and each.before is Phase.TRAVERSE:  # the edge of the landing obliges it to rotate
        return []
    tilt = each.tilt(-1.0 if down else 1.0)
    if math.isinf(tilt):
        return []
    d, M = question.allowance_d, question.allowance_M
    worst = tilt - d.high - M.high
    return [
        Finding(
            mode=TIP_DOWNHILL,
            worst=np.array([worst]),
            best=np.array([tilt - d.low - M.low]),
            instead=OPEN if worst <= 0 else None,  # nothing tells how far from a fall
            phase=each.before,
            model=CONTACT.name,
        )
    ]


def _together(figures: Sequence[Figures]) -> Iterator[Figures]:
    """Figures of all parts as one; of what is no figure of a part, those of the last."""
    of_contact = [each for each in figures if isinstance(each, ContactFigures)]
    others = {type(each): each for each in figures if not isinstance(each, ContactFigures)}
    gripping = [each for each in figures if isinstance(each, TractionFigures)]
    if gripping:
        others[TractionFigures] = traction.together(gripping)
    yield from others.values()
    if not of_contact:
        return
    grades = [each.grades for each in of_contact]
    says = [each.no_rotation for each in grades if each.no_rotation is not None]
    names = dict.fromkeys(phase.phase for each in of_contact for phase in each.phases)
    to_rock = [each.tilt.to_rock_deg for each in of_contact]
    to_fall = [each.tilt.to_fall_deg for each in of_contact]
    centroid = [each.margin_centroid_mm for each in of_contact]
    yield of_contact[0].model_copy(
        update={
            "grades": Grades(
                no_rotation=all(says) if says else None,
                arrested=all(each.arrested for each in grades),
                arrested_with_momentum=all(each.arrested_with_momentum for each in grades),
                largest_rotation_deg=max(each.largest_rotation_deg for each in grades),
                largest_drop_deg=max(each.largest_drop_deg for each in grades),
            ),
            "phases": tuple(
                _phase([one for each in of_contact for one in each.phases if one.phase == name])
                for name in names
            ),
            "tilt": TiltFigures(
                to_rock_deg=min((each for each in to_rock if each is not None), default=None),
                to_fall_deg=min((each for each in to_fall if each is not None), default=None),
                reserve_deg=of_contact[0].tilt.reserve_deg,
            ),
            "rotations": tuple(one for each in of_contact for one in each.rotations),
            "margin_centroid_mm": min(
                (each for each in centroid if each is not None), default=None
            ),
            "traction_N": max(each.traction_N or 0.0 for each in of_contact) or None,
            "power_W": max(each.power_W or 0.0 for each in of_contact) or None,
        }
    )


def _phase(some: Sequence[PhaseFigures]) -> PhaseFigures:
    """Extreme figures of a phase that two postures share."""
    first = some[hardest(
        math.inf if one.required_friction is None else one.required_friction for one in some
    )]  # fmt: skip
    weakest = min(some, key=lambda one: math.inf if one.energy_margin_mm is None
                  else one.energy_margin_mm)  # fmt: skip
    slides = [one.slides_below for one in some if one.slides_below is not None]
    return first.model_copy(
        update={
            "slides_below": max(slides, default=None),
            "energy_margin_mm": weakest.energy_margin_mm,
            "energy_margin_step": weakest.energy_margin_step,
            "static_margin_mm": min(one.static_margin_mm for one in some),
            "traction_over_weight": max(one.traction_over_weight for one in some),
            "largest_rotation_deg": max(one.largest_rotation_deg for one in some),
            "belly_touches": any(one.belly_touches for one in some),
        }
    )
