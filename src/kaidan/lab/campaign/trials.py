"""Trials in MuJoCo as the work of a campaign: columns, identity, version."""

import hashlib
import math
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from kaidan import physics
from kaidan.errors import MissingExtraError
from kaidan.physics import DrivenGrousers, TrialSpec
from kaidan.work.job import Kind, Work

_INPUTS: dict[str, Kind] = {
    "robot": "text",
    "flat_length_m": "number",
    "com_from_front_m": "number",
    "com_height_m": "number",
    "front_radius_m": "number",
    "rear_radius_m": "number",
    "mass_kg": "number",
    "stairs": "text",
    "angle_deg": "number",
    "nosing_spacing_m": "number",
    "friction": "number",
    "speed_m_s": "number",
    "acceleration_m_s2": "number",
    "direction": "text",
    "facing": "text",
    "begin": "text",
    "ground": "text",
    "dimensions": "count",
    "yaw_deg": "number",
    "lateral_offset_m": "number",
    "track": "text",
    "stiffness_N_m": "number",
    "grouser_height_m": "number",
    "grouser_spacing_m": "number",
    "timestep_s": "number",
    "seed": "count",
    "start_offset": "number",
    "grouser_phase": "number",
    "spec": "text",
}
"""Inputs by column; `spec` holds all of them as JSON, what is assumed for a missing one too."""
_FIGURES: dict[str, Kind] = {
    "largest_extra_deg": "number",
    "phase": "text",
    "step": "count",
    "nosings_passed": "count",
    "largest_normal_N": "number",
    "largest_traction_N": "number",
    "largest_torque_Nm": "number",
    "largest_power_W": "number",
    "slip_m": "number",
    "time_s": "number",
    "mass_assumed": "flag",
    "inertia_estimated": "flag",
    "wall_time_s": "number",
    "kaidan": "text",
    "mujoco": "text",
}


def run(spec: TrialSpec) -> dict[str, Any]:
    """Outcome and figures of a trial."""
    result = physics.run(spec)
    figures = result.model_dump(mode="json", include=set(_FIGURES) | {"outcome"})
    return figures | {"mujoco": None} | result.versions


def inputs(spec: TrialSpec) -> dict[str, Any]:
    """Columns of what a trial depends on."""
    question, profile, stance = spec.question, spec.profile(), spec.question.stance
    offset, phase, _ = spec.drawn()
    track = spec.track
    grousers = track if isinstance(track, DrivenGrousers) else None
    return {
        "robot": question.robot.name,
        "flat_length_m": stance.flat_length,
        "com_from_front_m": stance.com_from_front,
        "com_height_m": stance.com_height,
        "front_radius_m": question.robot.track.front_radius,
        "rear_radius_m": question.robot.track.rear_radius,
        "mass_kg": spec.mass()[0],
        "stairs": question.terrain_name,
        "angle_deg": round(math.degrees(abs(profile.angle)), 9),
        "nosing_spacing_m": profile.nosing_spacing,
        "friction": spec.static_friction,
        "speed_m_s": spec.speed,
        "acceleration_m_s2": question.acceleration,
        "direction": question.direction,
        "facing": question.facing,
        "begin": spec.begin,
        "ground": spec.ground,
        "dimensions": spec.dimensions,
        "yaw_deg": math.degrees(question.yaw),
        "lateral_offset_m": spec.lateral_offset,
        "track": track.kind,
        "stiffness_N_m": grousers.stiffness if grousers else spec.stiffness,
        "grouser_height_m": grousers.height if grousers else None,
        "grouser_spacing_m": grousers.spacing if grousers else None,
        "timestep_s": spec.step,
        "seed": spec.seed,
        "start_offset": offset,
        "grouser_phase": phase,
        "spec": text(spec),
    }


def text(spec: TrialSpec) -> str:
    """Spec as JSON, its fields always in the same order."""
    return spec.model_dump_json()


@cache
def physics_version() -> str:
    """Version of what a trial's result depends on: kaidan, MuJoCo, and the source of the models."""
    try:
        engine = version("mujoco")
    except PackageNotFoundError:
        raise MissingExtraError("the physics model", "physics") from None
    package = Path(__file__).parents[2]
    sources = [*sorted((package / "physics").glob("*.py"))]
    sources += [package / "outline.py"]
    sources += [package / "terrain" / name for name in ("profile.py", "flights.py")]
    digest = hashlib.sha256(b"\0".join(source.read_bytes() for source in sources)).hexdigest()
    return f"kaidan {version('kaidan')}, MuJoCo {engine}, models {digest[:12]}"


TRIALS = Work(
    name="trials in MuJoCo",
    run=run,
    inputs=inputs,
    text=text,
    version=physics_version,
    columns={**_INPUTS, **_FIGURES},
)
"""Trials in MuJoCo: a spec is a `kaidan.physics.TrialSpec`."""
