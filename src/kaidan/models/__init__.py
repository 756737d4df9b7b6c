"""Models side by side: each answers a question with its own findings, or says why it does not.

A model is a module with a function ``judge(question, *, known=None) -> Findings``, listed in
`kaidan.modes.MODELS`.
"""

import math
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING

from kaidan.modes import FOOT_UNSEEN, MODELS, Verdict

if TYPE_CHECKING:
    from kaidan.models.findings import Findings
    from kaidan.question import Question


def judge(question: "Question", *, known: "Findings | None" = None) -> "Findings":
    """Findings of the model that a question asks for.

    Parameters
    ----------
    question : Question
    known : Findings, optional
        Of a similar question to the same model, which saves work that both share.

    Returns
    -------
    Findings
    """
    if question.robot.com_range is not None:
        from kaidan.models.unweighed import judge_range

        return judge_range(question, judge)
    found: Findings = import_module(MODELS[question.model].module).judge(question, known=known)
    if found.outside:
        return found
    if (room := question.room) is not None:
        from kaidan.models.clearance import findings_of

        found = replace(found, each=(*found.each, *findings_of(question, room, found.model)))
    if (met := question.widest_gap) is not None:
        from kaidan.models.clearance import with_gap

        found = with_gap(question, found, *met)
    if question.landings:
        from kaidan.models import landings

        found = landings.beside(question, found)
    if not all(flight.foot_seen for flight in question.flights):
        from kaidan.models.findings import Finding

        unseen = Finding.certain(FOOT_UNSEEN, -math.inf, failing=Verdict.CAUTION, model=found.model)
        found = replace(found, each=(*found.each, unseen))
    if question.uneven_across:
        from kaidan.models.two_tracks import beside

        found = beside(question, found)
    return found
