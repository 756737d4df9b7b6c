"""Plans driven from poses farther apart, to compare them; what was driven before is remembered."""

import math
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.assessment.plan_scores import ENOUGH, outline_key, terrain_key
from kaidan.assessment.verdict import conclude
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models import judge, planned
from kaidan.models.belts import nosing_radii
from kaidan.models.findings import ROUNDING, Findings
from kaidan.models.quasi_static import (
    Basis,
    drive_margin,
    driven_over,
    findings_of,
    profile_of,
)
from kaidan.models.traction import standing
from kaidan.modes import CONTACT, Verdict
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Posture, Robot
from kaidan.terrain.profile import Profile
from kaidan.traversal import Traverse
from kaidan.traversal.driving import way
from kaidan.traversal.moves import Move, move
from kaidan.traversal.phases import phases_of
from kaidan.traversal.samples import samples_of

FINE = 0.02
"""Arclength between poses while judging [m]; events are located anyway."""

_MOST = math.radians(ENOUGH)

Sought = tuple[float, ...] | None


class Passed(NamedTuple):
    """A part of a traverse of which no more is known than whether nothing makes it a NO-GO."""

    path: contact.Path
    arrived: bool
    """Whether it arrives and has friction, drive and tilt to the fall to spare."""


def friction_without_failure(
    question: Question, *, moved: Callable[..., Move] | None = None
) -> float:
    """Friction that a plan requires which is certainly no NO-GO [1]; NaN: it has to be judged.

    It arrives, in the best case with friction at every pose, and with traction to spare; so it does
    under gravity tilted by the reserve to either side. Nothing else makes a NO-GO.

    moved: what changes a posture, as for `planned.drive`.
    """
    surface = question.surface
    if question.uncertain or question.robot.track.has_grousers or question.yaw:
        return math.nan
    if surface is not None and surface.differs:
        return math.nan
    needed: list[float] = []
    over = partial(_passed, reserve=question.reserve, needed=needed)
    planned_ = planned.drive(question, over=over, moved=moved)
    if not planned_.arrived or any(each.spare_torque <= 0.0 for each in planned_.moves):
        return math.nan
    moves = [standing(question, each) for each in planned_.moves]
    if any(each.best <= 0.0 for each in moves):
        return math.nan
    return max([*needed, *(each.required for each in moves)])


def _passed(
    profile: Profile,
    question: Question,
    *,
    reserve: float,
    needed: list[float],
    start: contact.Placement | None = None,
    until: float | None = None,
) -> Passed:
    """A part of a plan; `needed` gets the friction that it requires [1]."""
    down = question.direction == "down"
    driven = profile.reflected() if down else profile
    body = question.outline if question.facing == "nose-first" else question.outline.turned_round()
    along = -question.acceleration if down else question.acceleration
    there: dict[str, Any] = way(driven, body, start, until)
    there |= {"acceleration": along, "step": FINE}
    path = contact.traverse(**there, with_energy=False)
    if path.status is not contact.Status.OK:
        return Passed(path, False)
    phase = phases_of(path, driven, down, body.stance.flat_length)
    samples = samples_of(path, phase, along)
    required = float(samples.friction[samples.lasts].max())
    slides = math.atan(question.friction[1]) - math.atan(required) < ROUNDING
    stalls = drive_margin(question, np.nanmax(samples.traction) / STANDARD_GRAVITY) <= 0.0
    if slides or stalls:
        return Passed(path, False)
    survives = (contact.arrives(**there, tilt=tilt) for tilt in (reserve, -reserve))
    needed.append(required)
    return Passed(path, all(survives))


def _plan_key(question: Question) -> Hashable:
    """What tells a plan from others, as far as the friction goes that it requires."""
    surface = question.surface
    return (
        terrain_key(profile_of(question)),
        nosing_radii(question),
        outline_key(question.outline),
        question.robot.track,
        tuple(question.postures.values()),
        None if surface is None else surface.of_parts(),
        *_manner(question),
    )


def _manner(question: Question) -> tuple[Hashable, ...]:
    return question.direction, question.facing, question.acceleration


class Drives:
    """Parts and changes of plans as far as they were driven; friction and belts play no part."""

    def __init__(self) -> None:
        self._known: dict[Hashable, dict[Sought, Traverse]] = {}
        self._moves: dict[Hashable, Move] = {}
        self._required: dict[Hashable, float] = {}
        """Friction that plans require which were judged [1]."""

    def over(
        self, profile: Profile, question: Question, *, sought: Sought = None, **how: Any
    ) -> Traverse:
        """Traverse of a part, as `driven_over` has it, from poses `FINE` apart if not stated.

        sought, **how: as for `kaidan.traversal.traverse`.
        """
        how = {"step": FINE} | how
        terrain, body = terrain_key(profile), outline_key(question.outline)
        manner = *_manner(question), *sorted(how.items())
        known = self._known.setdefault((terrain, body, manner), {})
        if sought not in known:
            alike = next(iter(known.values()), None)
            known[sought] = (
                driven_over(profile, question, sought=sought, **how)
                if alike is None
                else alike.seeking(sought)
            )
        return known[sought]

    def moved(self, robot: Robot, one: Posture, two: Posture, **where: Any) -> Move:
        """Change of posture, as `kaidan.traversal.moves.move` has it."""
        ground: NDArray[np.float64] = where["ground"]
        body = outline_key(Outline.of(robot, one, where["payload"]))
        place = where["start"], where["before"], where["facing"]
        key = ground.tobytes(), body, one, two, *place
        if key not in self._moves:
            self._moves[key] = move(robot, one, two, **where)
        return self._moves[key]

    def judge(self, question: Question) -> Findings:
        """Findings of a plan, good enough to compare it with others."""
        return self._judge(question)

    def rank(self, question: Question) -> int:
        """Rank of a plan's verdict with its sign turned; how far a fall is off is not looked for.

        Larger is better. A GO on grousers is looked at pose by pose.
        """
        found = self._found(question)
        closely = question.robot.track.has_grousers
        if closely and conclude(question, found).verdict is Verdict.GO:
            found = self._found(question, step=contact.STEP)
        if not closely:
            self._required[_plan_key(question)] = found.required_friction
        return -conclude(question, found).verdict.rank

    def required_friction(self, question: Question) -> float:
        """Friction that a plan requires [1]; infinite: none is enough; NaN: not known.

        With grousers pose by pose: those that stand differ by more than smooth belts do.
        """
        key = _plan_key(question)
        if key not in self._required:
            how = {"step": contact.STEP} if question.robot.track.has_grousers else {}
            self._required[key] = self._found(question, **how).required_friction
        return self._required[key]

    def is_no_failure(self, question: Question) -> bool:
        """Whether a plan is certainly no NO-GO; False: it has to be judged."""
        if question.model != CONTACT.name:
            return False
        required = friction_without_failure(question, moved=self.moved)
        if math.isnan(required):
            return False
        self._required[_plan_key(question)] = required
        return True

    def _found(self, question: Question, **how: Any) -> Findings:
        """Findings of a plan where only the verdict counts, not how far a fall is off."""
        if question.uncertain:
            return self._judge(question, **how)
        d, M = question.allowance_d, question.allowance_M
        sought = question.reserve, d.high + M.high, d.low + M.low
        return self._judge(question, sought=sought, **how)

    def _judge(self, question: Question, **how: Any) -> Findings:
        if question.model != CONTACT.name:
            return judge(question)
        if question.changes:
            driven = planned.drive(question, over=self.over, moved=self.moved, **how)
            return planned.findings(question, driven, most=_MOST)
        found = self.over(profile_of(question), question, **how)
        return findings_of(question, Basis(question, found), most=_MOST)
