"""What a trial comes to: its outcome, its figures and its log."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer
from kaidan.modes import Phase
from kaidan.physics.spec import TrialSpec

Array = NDArray[np.float64]


class Outcome(StrEnum):
    """How a trial ended; each is a result, none an error."""

    CLIMBED = "climbed"
    """It came to the end of its course, upward or downward."""
    FELL_BACKWARD = "fell_backward"
    """It tipped over its tail."""
    FELL_FORWARD = "fell_forward"
    """It tipped over its nose."""
    SLID = "slid"
    """The track ran on without the robot, for want of friction."""
    STALLED = "stalled"
    """The track ran on without the robot, which friction would hold on the flight: it hops on the
    spot, or stands."""
    TIMED_OUT = "timed_out"
    """It neither fell nor slid nor stalled nor arrived in twice the time it takes."""
    UNSTABLE = "unstable"
    """The simulation diverged: this says nothing about the robot."""
    START_FALL = "start_fall"
    """It fell before the track moved: it was placed where it cannot stand."""

    @property
    def exit_code(self) -> int:
        """Code with which a command ends: 0 climbed, 3 diverged, 1 anything else."""
        return {"climbed": 0, "unstable": 3}.get(self.value, 1)


class TrialResult(Answer):
    """Result of a trial, with all that it came from."""

    text_module: ClassVar[str] = "kaidan.text.trial"

    spec: TrialSpec
    """All that it depends on."""
    outcome: Outcome
    """How it ended."""
    phase: Phase | None
    """Part of the traverse in which it fell, slid, stalled or was given up; null: none."""
    step: int | None
    """Nosing that the leading end had reached then, counted from the bottom; null likewise."""
    nosings_passed: int
    """Nosings passed by the downhill end."""
    largest_extra_deg: float
    """Largest inclination beyond the line of the nosings, towards the downhill end [deg]."""
    largest_normal_N: float
    """Largest force of the ground normal to the line of the nosings, mean over 20 ms [N]."""
    largest_traction_N: float
    """Largest force that drives the robot along its track, mean over 20 ms [N]."""
    largest_torque_Nm: float | None
    """Torque at the sprockets of that traction [N m]; null without a sprocket or end's radius."""
    largest_power_W: float
    """Largest power of traction and belt, mean over 20 ms [W]."""
    slip_m: float
    """How much further the belt ran than the robot drove [m]."""
    time_s: float
    """Time simulated, from the start of the drive [s]."""
    friction: float
    """Static friction that was simulated [1]."""
    stiffness_N_m: float | None
    """Stiffness of a nosing [N/m]; null where it is rigid."""
    speed_m_s: float
    """Speed of the belt, the lowest if it changes [m/s]."""
    timestep_s: float
    """Time step [s]."""
    contact_time_s: float | None
    """Time in which a contact pushes back what has sunk in [s]; null where the track yields."""
    start_offset: float
    """Share of a spacing by which the downhill end hung over its nosing at the start [1]."""
    grouser_phase: float
    """Share of a grouser spacing at the start [1]."""
    mass_kg: float
    """Mass that was simulated [kg]."""
    mass_assumed: bool
    """Whether the sheet gives no mass."""
    inertia_estimated: bool
    """Whether the sheet gives no inertia."""
    wall_time_s: float
    """Time it took [s]; the only figure that is not the same every time."""
    versions: dict[str, str]
    """Of kaidan, and of MuJoCo where it was used."""

    @property
    def fell(self) -> bool:
        """Whether it fell while driving."""
        return self.outcome in (Outcome.FELL_BACKWARD, Outcome.FELL_FORWARD)


@dataclass(frozen=True, kw_only=True)
class TrialLog:
    """A trial over time; every column has a row each `TrialSpec.log_interval`."""

    result: TrialResult
    columns: Mapping[str, Array]
    """By name, the unit at its end: `time_s`, `belt_m`, `x_m`, `z_m`, `inclination_deg`,
    `extra_deg`, `path_m`, `slip_m`, `speed_m_s`, `normal_N`, `traction_N`, `torque_Nm`, `power_W`,
    `contacts`, and in space `yaw_deg`, `roll_deg`, `y_m`."""
    forces: Array
    """Force on the robot from each nosing [N], shape (rows, nosings, 2): along the line of the
    nosings as it drives, and normal to it."""
    grousers: Array
    """Force on each grouser [N], shape (rows, grousers, 2), likewise; no grousers: (rows, 0, 2)."""
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
