"""The contact model: one posture, or a plan of several, driven over the whole traverse."""

from kaidan.models import planned
from kaidan.models.findings import Findings
from kaidan.models.quasi_static import Basis, drives_alike, findings_of, traverse_of
from kaidan.models.support_polygon import along_heading
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs


def judge(question: Question, *, known: Findings | None = None) -> Findings:
    """Findings of the contact model on the whole traverse of a question.

    Parameters
    ----------
    question : Question
        On any terrain.
    known : Findings, optional
        Of a similar question: its traverse is taken over where the change plays no part in it.
    """
    if question.changes:
        return _of_a_plan(question, known)
    driven = question
    if question.yaw and isinstance(question.terrain, Stairs):
        driven = question.changed(terrain=along_heading(question.terrain, question.yaw), yaw=0.0)
    basis: Basis | None = None if known is None else known.basis
    if basis is None or not drives_alike(basis.question, driven):
        basis = Basis(driven, traverse_of(driven))
    return findings_of(question, basis._replace(question=driven))


def _of_a_plan(question: Question, known: Findings | None) -> Findings:
    basis: Basis | None = None if known is None else known.basis
    if basis is not None and drives_alike(basis.question, question):
        return planned.findings(question, basis.traverse)
    return planned.findings(question, planned.drive(question))
