"""Campaigns: thousands of trials on many processes or machines, into a store that survives.

`carry_out` does a plan of trials in MuJoCo. Its parts serve any other `Work`: `conduct` brings a
`Store` and `Workers` together.
"""

from typing import TYPE_CHECKING

from kaidan.lazy import when_used

if TYPE_CHECKING:
    from kaidan.campaign.campaign import PlanProgress, carry_out, progress_of, resume, rows_of
    from kaidan.campaign.cluster import DaskWorkers
    from kaidan.campaign.job import CRASHED, FAILED, Work
    from kaidan.campaign.local import LocalWorkers, Workers
    from kaidan.campaign.plans import Condition, Grid, Plan, Setting, VerificationTest
    from kaidan.campaign.query import State, export, read_batches, read_table, state_of
    from kaidan.campaign.runner import Kept, Tally, conduct
    from kaidan.campaign.store import Store
    from kaidan.campaign.threads import ThreadWorkers
    from kaidan.campaign.trials import TRIALS

_HOME = {
    "PlanProgress": "campaign",
    "carry_out": "campaign",
    "progress_of": "campaign",
    "resume": "campaign",
    "rows_of": "campaign",
    "DaskWorkers": "cluster",
    "CRASHED": "job",
    "FAILED": "job",
    "Work": "job",
    "LocalWorkers": "local",
    "Workers": "local",
    "Condition": "plans",
    "Grid": "plans",
    "Plan": "plans",
    "Setting": "plans",
    "VerificationTest": "plans",
    "State": "query",
    "export": "query",
    "read_batches": "query",
    "read_table": "query",
    "state_of": "query",
    "Kept": "runner",
    "Tally": "runner",
    "conduct": "runner",
    "Store": "store",
    "ThreadWorkers": "threads",
    "TRIALS": "trials",
}
"""Public names and the module of each: a process of a campaign imports what it does, no more."""

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
    "rows_of",
    "state_of",
]

__getattr__ = when_used("kaidan.campaign", _HOME)
