"""Campaigns: plans of thousands of trials in MuJoCo, done, resumed and looked at."""

from typing import TYPE_CHECKING

from kaidan.lazy import when_used

if TYPE_CHECKING:
    from kaidan.lab.campaign.campaign import PlanProgress, carry_out, progress_of, resume, rows_of
    from kaidan.lab.campaign.plans import Condition, Grid, Plan, Setting, VerificationTest
    from kaidan.lab.campaign.trials import TRIALS

_HOME = {
    "PlanProgress": "campaign",
    "carry_out": "campaign",
    "progress_of": "campaign",
    "resume": "campaign",
    "rows_of": "campaign",
    "Condition": "plans",
    "Grid": "plans",
    "Plan": "plans",
    "Setting": "plans",
    "VerificationTest": "plans",
    "TRIALS": "trials",
}
"""Public names and the module of each: a process of a campaign imports what it does, no more."""

__all__ = [
    "TRIALS",
    "Condition",
    "Grid",
    "Plan",
    "PlanProgress",
    "Setting",
    "VerificationTest",
    "carry_out",
    "progress_of",
    "resume",
    "rows_of",
]

__getattr__ = when_used("kaidan.lab.campaign", _HOME)
