"""What a trial comes to: its outcome, its figures and its log."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.physics.spec import TrialSpec

Array = NDArray[np.float64]


class Outcome(StrEnum):
    """How a trial ended; each is a result, none an error."""

    CLIMBED = "climbed"
    """It came to the end of its course, upward or downward."""
    FELL_BACKWARD = "fell_backward"
    """It turned over its tail."""
    FELL_FORWARD = "fell_forward"
    """It turned over its nose."""
    SLID = "slid"
    """The track ran on without the robot."""
    TIMED_OUT = "timed_out"
    """It neither fell nor slid nor arrived in twice the time it takes."""
    UNSTABLE = "unstable"
    """The simulation diverged: this says nothing about the robot."""
    START_FALL = "start_fall"
    """It fell before the track moved: it was placed where it cannot stand."""


@dataclass(frozen=True, kw_only=True)
class TrialLog:
    """A trial over time; every column has a row each `TrialSpec.log_interval`."""

    columns: Mapping[str, Array]
    """By name, the unit at its end: `time_s`, `belt_m`, `x_m`, `z_m`, `inclination_deg`,
    `extra_deg`, `way_m`, `slip_m`, `speed_m_s`, `normal_N`, `traction_N`, `torque_Nm`, `power_W`,
    `contacts`, and in space `yaw_deg`, `roll_deg`, `y_m`."""
    forces: Array
    """Force on the robot from each nosing [N], shape (rows, nosings, 2): up along the line of
    the nosings' way, and normal to it."""
    poses: Array
    """State of the model at each row, shape (rows, nq): for pictures."""

    def __len__(self) -> int:
        return len(self.columns["time_s"])

    def table(self) -> dict[str, Array]:
        """All columns and the forces from each nosing that was touched, for a file."""
        whole = dict(self.columns)
        for k in range(self.forces.shape[1]):
            if self.forces[:, k].any():
                whole[f"nosing{k + 1}_along_N"] = self.forces[:, k, 0]
                whole[f"nosing{k + 1}_normal_N"] = self.forces[:, k, 1]
        return whole


@dataclass(frozen=True, kw_only=True)
class TrialResult:
    """Result of a trial, with all that it came from."""

    spec: TrialSpec
    outcome: Outcome
    largest_extra_deg: float
    """Largest turn beyond the line of the nosings, towards the downhill end [deg]."""
    release: int | None
    """Nosing passed last by the downhill end when it fell or slid, 1 the first of the course;
    0 before the first; None if it did neither."""
    releases: int
    """Nosings passed by the downhill end."""
    largest_normal: float
    """Largest force from one nosing, normal to the line of the nosings [N]."""
    largest_traction: float
    """Largest sum of the tractive forces [N]."""
    largest_torque: float | None
    """Largest torque at the sprockets [N m]; None without a sprocket or an end's radius."""
    largest_power: float
    """Largest power at the track [W]."""
    slip: float
    """How much further the belt ran than the robot drove [m]."""
    time: float
    """Time simulated, from the start of the drive [s]."""
    start_offset: float
    grouser_phase: float
    """What was drawn from the seed [1]."""
    mass: float
    """Mass that was simulated [kg]."""
    mass_assumed: bool
    inertia_estimated: bool
    wall_time: float
    """Time it took [s]; the only figure that is not the same every time."""
    versions: Mapping[str, str]
    """Of kaidan and MuJoCo."""
    log: TrialLog | None = None

    @property
    def fell(self) -> bool:
        """Whether it fell while driving."""
        return self.outcome in (Outcome.FELL_BACKWARD, Outcome.FELL_FORWARD)

    def as_dict(self) -> dict[str, Any]:
        """Everything but the log, ready for JSON; what the specification leaves open, as used."""
        plain = {
            name: getattr(self, name)
            for name in self.__dataclass_fields__
            if name not in ("spec", "log", "versions", "outcome")
        }
        return {
            "outcome": self.outcome.value,
            **plain,
            "friction": self.spec.static_friction,
            "stiffness": self.spec.stiffness,
            "timestep": self.spec.step,
            "contact_time": self.spec.softness,
            "versions": dict(self.versions),
            "spec": self.spec.model_dump(mode="json"),
        }

    def __reduce__(self) -> Any:
        fields = {name: getattr(self, name) for name in self.__dataclass_fields__}
        fields["versions"] = dict(self.versions)
        return _again, (fields,)

    def __post_init__(self) -> None:
        object.__setattr__(self, "versions", MappingProxyType(dict(self.versions)))


def _again(fields: dict[str, Any]) -> TrialResult:
    return TrialResult(**fields)
