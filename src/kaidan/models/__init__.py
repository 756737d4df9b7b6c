"""Models side by side: each answers a question with its own findings, or says why it does not.

A model is a module with a function ``judge(question, *, known=None) -> Findings``, listed in
`kaidan.modes.MODELS`.
"""

import math
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING

from kaidan.models.sentences import terrain as text
from kaidan.modes import ACROSS, FLOOR_FINISH, FOOT_UNSEEN, MODELS, FailureMode

if TYPE_CHECKING:
    from kaidan.models.findings import Findings
    from kaidan.question import Question


def judge(question: "Question", *, known: "Findings | None" = None) -> "Findings":
    """Findings of the model that a question asks for.

    Parameters
    ----------
    known : Findings, optional
        Of a similar question to the same model, which saves work that both share.
    """
    if question.robot.com_range is not None:
        from kaidan.models.unweighed import judge_range

        return judge_range(question, judge)
    found: Findings = import_module(MODELS[question.model].module).judge(question, known=known)
    return beside(question, found)


def beside(question: "Question", found: "Findings") -> "Findings":
    """Findings of a model with those that are found beside it, whichever model it is."""
    if found.outside:
        return found
    if question.profile.is_level:
        return type(found)(model=found.model, outside=text.NO_STAIRS)
    if (room := question.room) is not None:
        from kaidan.models.clearance import findings_of

        found = replace(found, each=(*found.each, *findings_of(question, room, found.model)))
    if (met := question.widest_gap) is not None:
        from kaidan.models.clearance import with_gap

        found = with_gap(question, found, *met)
    if question.landings:
        from kaidan.models import landings

        found = landings.beside(question, found)
    if doubted := _in_doubt(question):
        from kaidan.models.findings import Finding

        more = (Finding.certain(mode, -math.inf, model=found.model) for mode in doubted)
        found = replace(found, each=(*found.each, *more))
    if question.uneven_across:
        from kaidan.models import two_tracks

        found = two_tracks.beside(question, found)
    return found


def _in_doubt(question: "Question") -> list[FailureMode]:
    """What nobody saw or stated of the terrain, or what a file states unlike its drawing."""
    found = []
    if not all(flight.foot_seen for flight in question.flights):
        found.append(FOOT_UNSEEN)
    if any(flight.first_rise_drawn or flight.last_rise_drawn for flight in question.flights):
        found.append(FLOOR_FINISH)
    if not question.meets_the_same:
        found.append(ACROSS)
    return found
