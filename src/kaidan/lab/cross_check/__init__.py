"""Closed form, contact model and physics on the same questions, and how far apart they are."""

from kaidan.lab.cross_check.answer import Agreement, Compared, Difference
from kaidan.lab.cross_check.bands import Band
from kaidan.lab.cross_check.common_question import Begin
from kaidan.lab.cross_check.comparison import agree

__all__ = ["Agreement", "Band", "Begin", "Compared", "Difference", "agree"]
