"""Campaigns: thousands of trials on many processes or machines, into a store that survives.

`carry_out` does a plan of trials in MuJoCo. Its parts serve any other `Work`: `conduct` brings a
`Store` and `Workers` together.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kaidan.campaign.campaign import PlanProgress, carry_out, progress_of, resume
    from kaidan.campaign.cluster import DaskWorkers
    from kaidan.campaign.job import CRASHED, FAILED, Work
    from kaidan.campaign.local import LocalWorkers, Workers
    from kaidan.campaign.plans import Condition, Grid, Plan, Setting, VerificationTest
    from kaidan.campaign.query import State, export, read_batches, read_table, state_of
    from kaidan.campaign.runner import Kept, Tally, conduct
    from kaidan.campaign.store import Store
    from kaidan.campaign.threads import ThreadWorkers
    from kaidan.campaign.trials import TRIALS

_MODULES = {
    "campaign": ("PlanProgress", "carry_out", "progress_of", "resume"),
    "cluster": ("DaskWorkers",),
    "job": ("CRASHED", "FAILED", "Work"),
    "local": ("LocalWorkers", "Workers"),
    "plans": ("Condition", "Grid", "Plan", "Setting", "VerificationTest"),
    "query": ("State", "export", "read_batches", "read_table", "state_of"),
    "runner": ("Kept", "Tally", "conduct"),
    "store": ("Store",),
    "threads": ("ThreadWorkers",),
    "trials": ("TRIALS",),
}

__all__ = [
    "CRASHED",
    "FAILED",
    "TRIALS",
    "Condition",
    "DaskWorkers",
    "Grid",
    "Kept",
    "LocalWorkers",
    "Plan",
    "PlanProgress",
    "Setting",
    "State",
    "Store",
    "Tally",
    "ThreadWorkers",
    "VerificationTest",
    "Work",
    "Workers",
    "carry_out",
    "conduct",
    "export",
    "progress_of",
    "read_batches",
    "read_table",
    "resume",
    "state_of",
]


def __getattr__(name: str) -> Any:
    """Names when they are first used: each process of a campaign imports what it does, no more."""
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
