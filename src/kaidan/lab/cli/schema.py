"""``kaidan lab schema``: JSON schemas of the laboratory's answers."""

from typing import Annotated

import typer

from kaidan.cli.schema import echo_schema

KINDS = {
    "agree": "kaidan.lab.cross_check.answer:Agreement",
    "trial": "kaidan.physics.outcome:TrialResult",
    "experiment": "kaidan.lab.verification.verification:Verification",
    "calibration": "kaidan.lab.calibration.answer:Calibration",
    "yielding-calibration": "kaidan.lab.calibration.yielding:YieldingCalibration",
    "theta-m": "kaidan.lab.calibration.theta_m:ThetaMStudy",
    "engagement": "kaidan.lab.calibration.engagement:Engagement",
    "rig-calibration": "kaidan.lab.rig.calibration:RigCalibration",
    "grouser-effects": "kaidan.lab.calibration.answer:GrouserEffects",
    "grouser-search": "kaidan.lab.calibration.search:GrouserSearch",
    "reproduction": "kaidan.lab.reproduction.reproduction:Reproduction",
    "outcomes": "kaidan.lab.outcomes.known_outcomes:KnownOutcomes",
    "bench": "kaidan.lab.outcomes.bench:Bench",
}
"""What has a schema: name on the command line, module and class."""

Kind = Annotated[
    str,
    typer.Argument(metavar="KIND", help=f"{', '.join(list(KINDS)[:-1])} or {list(KINDS)[-1]}."),
]


def register(app: typer.Typer) -> None:
    """Add ``schema`` to the commands of the laboratory."""
    app.command("schema")(schema)


def schema(kind: Kind) -> None:
    """Print the JSON schema of an answer of the laboratory.

    Every field has its meaning and unit.
    """
    echo_schema(kind, KINDS)
