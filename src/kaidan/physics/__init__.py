"""A trial on stairs in MuJoCo: the paper's verification test for any robot and any stairs.

`run` takes a `TrialSpec` and gives a `TrialResult`. Nothing of MuJoCo is imported before a model
is built.
"""

from kaidan.physics.model import Model, mjcf, model_of
from kaidan.physics.outcome import Outcome, TrialLog, TrialResult
from kaidan.physics.spec import TrialSpec
from kaidan.physics.tracks import (
    KINDS,
    DrivenGrousers,
    ShoeChain,
    SmoothBelt,
    SprungNoses,
    TrackModel,
    YieldingBelt,
)
from kaidan.physics.trial import record, run

__all__ = [
    "KINDS",
    "DrivenGrousers",
    "Model",
    "Outcome",
    "ShoeChain",
    "SmoothBelt",
    "SprungNoses",
    "TrackModel",
    "TrialLog",
    "TrialResult",
    "TrialSpec",
    "YieldingBelt",
    "mjcf",
    "model_of",
    "record",
    "run",
]
