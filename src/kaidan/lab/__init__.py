"""The laboratory: the paper reproduced and verified, models calibrated and held beside each other.

It serves who studies the paper or looks after kaidan. Nothing outside it imports it.
"""

from typing import TYPE_CHECKING

from kaidan.lazy import when_used

if TYPE_CHECKING:
    from kaidan.lab.cross_check import agree
    from kaidan.lab.outcomes.known_outcomes import known_outcomes
    from kaidan.lab.reproduction.reproduction import reproduce
    from kaidan.lab.verification.experiment import experiment

_HOME = {
    "agree": "cross_check.comparison",
    "experiment": "verification.experiment",
    "known_outcomes": "outcomes.known_outcomes",
    "reproduce": "reproduction.reproduction",
}

__all__ = ["agree", "experiment", "known_outcomes", "reproduce"]

__getattr__ = when_used("kaidan.lab", _HOME)
