"""Plans driven from poses farther apart, to compare them; what was driven before is remembered."""

from collections.abc import Hashable
from dataclasses import replace
from typing import Any

from kaidan.models import judge, planned
from kaidan.models.findings import Findings
from kaidan.models.quasi_static import Basis, driven_over, findings_of, profile_of
from kaidan.modes import CONTACT
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.traversal import Traverse

FINE = 0.02
"""Arclength between poses while judging [m]; events are located anyway."""

Sought = tuple[float, ...] | None


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
        outline = question.outline
        terrain = profile.points.tobytes(), profile.nosings.tobytes(), profile.roughness
        body = outline.parts.tobytes(), outline.kinds.tobytes(), outline.stance, outline.gyration
        manner = question.direction, question.facing, question.acceleration
        known = self._known.setdefault((terrain, body, manner, tuple(sorted(how.items()))), {})
        if sought not in known:
            alike = next(iter(known.values()), None)
            known[sought] = (
                driven_over(profile, question, step=FINE, sought=sought, **how)
                if alike is None
                else replace(alike, sought=sought)
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

    def _judge(self, question: Question, **how: Any) -> Findings:
        if question.model != CONTACT.name:
            return judge(question)
        if question.changes:
            return planned.findings(question, planned.drive(question, over=self.over, **how))
        found = self.over(profile_of(question), question, **how)
        return findings_of(question, Basis(question, found))
