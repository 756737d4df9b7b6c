"""``kaidan schema``: JSON schemas of sheets, of a question, and of every answer."""

from collections.abc import Mapping
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
    "design": "kaidan.verbs.design.answer:Design",
    "sensitivity": "kaidan.verbs.sensitivity:Sensitivity",
    "stock": "kaidan.verbs.stock.answer:StockStudy",
    "sweep": "kaidan.sweeps.summary:SweepSummary",
    "doctor": "kaidan.verbs.doctor:Diagnosis",
    "report": "kaidan.verbs.report.answer:Report",
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
    every field of an answer its meaning and unit. "answer" is that of kaidan assess --json; answers
    of the laboratory have theirs in kaidan lab schema.
    """
    echo_schema(kind, KINDS)


def echo_schema(kind: str, known: Mapping[str, str]) -> None:
    """Print the JSON schema of one of those known, each "module:Class"."""
    from kaidan.errors import InputError, did_you_mean, shown

    if kind not in known:
        hint = did_you_mean(kind, known) or "."
        raise InputError(f"no schema is called {shown(kind)}{hint} Known: {', '.join(known)}.")
    echo_json({"$schema": DIALECT} | schema_of(known[kind]))


def schema_of(place: str) -> dict[str, Any]:
    """JSON schema of a class, "module:Class"."""
    module, _, name = place.partition(":")
    described: Any = getattr(import_module(module), name)
    made: dict[str, Any] = described.model_json_schema(mode="serialization")
    return made
