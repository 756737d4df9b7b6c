"""Closed form, contact model and physics asked the same questions, and how far apart they are."""

from kaidan.agreement.answer import Agreement, Difference, Question
from kaidan.agreement.asked import Begin
from kaidan.agreement.bands import Band
from kaidan.agreement.comparing import agree

__all__ = ["Agreement", "Band", "Begin", "Difference", "Question", "agree"]
