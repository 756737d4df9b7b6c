"""``kaidan schema``: JSON schemas of sheets, of a question, and of every answer."""

from importlib import import_module
from typing import Annotated, Any

import typer

from kaidan.cli.tables import echo_json

DIALECT = "https://json-schema.org/draft/2020-12/schema"
KINDS = {
    "robot": "kaidan.robot:Robot",
    "stairs": "kaidan.terrain.stairs:Stairs",
    "surface": "kaidan.surface:Surface",
    "question": "kaidan.question:Question",
    "answer": "kaidan.assessment.answer:Assessment",
    "traverse": "kaidan.verbs.traverse_report:TraverseReport",
    "pose-map": "kaidan.verbs.pose_map:PoseMap",
    "posture": "kaidan.verbs.posture:PostureAnswer",
    "margin": "kaidan.verbs.margin_curve:MarginCurve",
    "plane": "kaidan.verbs.d_a_plane:Plane",
    "robot-measurement": "kaidan.verbs.measure_robot:RobotMeasurement",
    "stairs-measurement": "kaidan.verbs.measure_stairs:StairsMeasurement",
    "file": "kaidan.verbs.read:FileAnswer",
    "compare": "kaidan.verbs.comparison:Comparison",
    "building": "kaidan.verbs.building.answer:BuildingAnswer",
    "monitor": "kaidan.verbs.monitor.answer:MonitorAnswer",
    "agree": "kaidan.studies.cross_check.answer:Agreement",
    "trial": "kaidan.physics.outcome:TrialResult",
    "experiment": "kaidan.studies.verification:Verification",
    "calibration": "kaidan.studies.calibration.answer:Calibration",
    "yielding-calibration": "kaidan.studies.calibration.yielding:YieldingCalibration",
    "theta-m": "kaidan.studies.calibration.theta_m:ThetaMStudy",
    "engagement": "kaidan.studies.calibration.engagement:Engagement",
    "rig-calibration": "kaidan.studies.rig.calibration:RigCalibration",
    "grouser-effects": "kaidan.studies.calibration.answer:GrouserEffects",
    "reproduction": "kaidan.studies.reproduction:Reproduction",
    "design": "kaidan.verbs.design.answer:Design",
    "sensitivity": "kaidan.studies.sensitivity:Sensitivity",
    "stock": "kaidan.studies.stock.answer:StockStudy",
    "sweep": "kaidan.sweeps.summary:SweepSummary",
    "doctor": "kaidan.verbs.doctor:Diagnosis",
    "report": "kaidan.verbs.report.answer:Report",
    "outcomes": "kaidan.studies.known_outcomes:KnownOutcomes",
}
"""What has a schema: name on the command line, module and class."""

Kind = Annotated[
    str,
    typer.Argument(metavar="KIND", help=f"{', '.join(list(KINDS)[:-1])} or {list(KINDS)[-1]}."),
]


def register(app: typer.Typer) -> None:
    """Add ``schema`` to the command line."""
    app.command("schema")(schema)


def schema(kind: Kind) -> None:
    """Print the JSON schema of a sheet, of a question, or of the answer of a command.

    Every quantity of a sheet has its unit, its symbol where the paper has one, and its range;
    every field of an answer its meaning and unit. "answer" is that of kaidan assess --json.
    """
    from kaidan.errors import InputError, did_you_mean, shown

    if kind not in KINDS:
        hint = did_you_mean(kind, KINDS) or "."
        raise InputError(f"no schema is called {shown(kind)}{hint} Known: {', '.join(KINDS)}.")
    echo_json({"$schema": DIALECT} | schema_of(kind))


def schema_of(kind: str) -> dict[str, Any]:
    """JSON schema of a kind."""
    module, _, name = KINDS[kind].partition(":")
    described: Any = getattr(import_module(module), name)
    made: dict[str, Any] = described.model_json_schema(mode="serialization")
    return made
