"""Plans driven from poses farther apart, to compare them; what was driven before is remembered."""

import math
from collections.abc import Hashable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from kaidan import contact
from kaidan.assessment.plan_scores import ENOUGH, outline_key, terrain_key
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models import judge, planned
from kaidan.models.findings import Findings
from kaidan.models.quasi_static import (
    Basis,
    drive_margin,
    driven_over,
    findings_of,
    profile_of,
)
from kaidan.models.traction import standing_margins
from kaidan.modes import CONTACT
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.traversal import Traverse
from kaidan.traversal.driving import way
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


def is_no_failure(question: Question) -> bool:
    """Whether a plan is certainly no NO-GO; False: it has to be judged.

    It arrives, in the best case with friction at every pose, and with traction to spare; so it does
    under gravity tilted by the reserve to either side. Nothing else makes a NO-GO.

    Parameters
    ----------
    question : Question
        To the contact model.
    """
    surface = question.surface
    if question.uncertain or question.robot.track.has_grousers or question.yaw:
        return False
    if surface is not None and surface.differs:
        return False
    planned_ = planned.drive(question, over=partial(_passed, reserve=question.reserve))
    return planned_.arrived and not any(
        standing_margins(question, each)[1] <= 0.0 or each.spare_torque <= 0.0
        for each in planned_.moves
    )


def _passed(
    profile: Profile,
    question: Question,
    *,
    reserve: float,
    start: contact.Placement | None = None,
    until: float | None = None,
) -> Passed:
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
    slides = math.atan(samples.friction[samples.lasts].max()) >= math.atan(question.friction[1])
    stalls = drive_margin(question, np.nanmax(samples.traction) / STANDARD_GRAVITY) <= 0.0
    if slides or stalls:
        return Passed(path, False)
    survives = (contact.arrives(**there, tilt=tilt) for tilt in (reserve, -reserve))
    return Passed(path, all(survives))


class Drives:
    """Parts of traverses as far as they were driven: friction and belts play no part in them."""

    def __init__(self) -> None:
        self._known: dict[Hashable, dict[Sought, Traverse]] = {}

    def over(
        self, profile: Profile, question: Question, *, sought: Sought = None, **how: Any
    ) -> Traverse:
        """Traverse of a part, as `driven_over` has it, from poses farther apart.

        Parameters
        ----------
        profile : Profile
        question : Question
            In one posture.
        sought, **how
            As for `kaidan.traversal.traverse`.
        """
        terrain, body = terrain_key(profile), outline_key(question.outline)
        manner = question.direction, question.facing, question.acceleration
        known = self._known.setdefault((terrain, body, manner, tuple(sorted(how.items()))), {})
        if sought not in known:
            alike = next(iter(known.values()), None)
            known[sought] = (
                driven_over(profile, question, step=FINE, sought=sought, **how)
                if alike is None
                else alike.seeking(sought)
            )
        return known[sought]

    def judge(self, question: Question) -> Findings:
        """Findings of a plan, good enough to compare it with others."""
        return self._judge(question)

    def rank(self, question: Question) -> Findings:
        """The same where only the verdict counts: how far a fall is off is not known."""
        if question.uncertain:
            return self._judge(question)
        d, M = question.allowance_d, question.allowance_M
        sought = question.reserve, d.high + M.high, d.low + M.low
        return self._judge(question, sought=sought)

    def is_no_failure(self, question: Question) -> bool:
        """Whether a plan is certainly no NO-GO; False: it has to be judged."""
        return question.model == CONTACT.name and is_no_failure(question)

    def _judge(self, question: Question, **how: Any) -> Findings:
        if question.model != CONTACT.name:
            return judge(question)
        if question.changes:
            driven = planned.drive(question, over=self.over, **how)
            return planned.findings(question, driven, most=_MOST)
        found = self.over(profile_of(question), question, **how)
        return findings_of(question, Basis(question, found), most=_MOST)
