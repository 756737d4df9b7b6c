"""How grousers engage: driven ones in MuJoCo against the rule of traction.

Height, spacing, radius of the nosings, friction and slope are varied. For each the rule gives the
friction below which rigid grousers slip for good (docs/theory/grousers.md); trials show whether the
robot gets on, how far it slips at each nosing, and what one grouser bears.
"""

import math
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer, Part
from kaidan.contact import Grousers
from kaidan.lab.campaign import rows_of
from kaidan.lab.campaign.plans import seed_of
from kaidan.lab.campaign.trials import physics_version, text
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models.quasi_static import traverse_of
from kaidan.models.traction import SLIDING
from kaidan.modes import Phase
from kaidan.physics import DrivenGrousers, TrialLog, TrialSpec, record
from kaidan.physics.mean_forces import WINDOW
from kaidan.question import Question
from kaidan.robot import Robot, Track
from kaidan.terrain.stairs import Stairs
from kaidan.work import Work

ROBOT = Robot(
    name="long and low",
    com_from_front=0.28,
    com_height=0.06,
    mass=20.0,
    inertia=0.7,
    track=Track(flat_length=0.60, front_radius=0.06, rear_radius=0.06),
)
"""Robot that tips on none of the slopes, so that what ends a climb is its grip."""
NOSING_SPACING = 0.200
"""[m]: three nosings under the flat, as on real stairs under a robot one and a half times as
long."""
BASE = {"height": 0.010, "spacing": 0.040, "nosing_radius": 0.005}
"""About which one figure at a time is changed [m]."""
VARIED = {
    "height": (0.003, 0.005, 0.020),
    "spacing": (0.020, 0.080),
    "nosing_radius": (0.0, 0.015),
}
"""Other values of each [m]."""
SLOPES = (32.5, 38.0, 44.0)
"""Of the steepest IBC, dwelling and OSHA flights, nearly [deg]."""
FRICTIONS = (0.1, 0.2, 0.4, 0.6)
"""Rubber wet and dry, and less [1]."""
NOSINGS = 2
"""Nosings that the lower end passes in a trial."""


EVERY = 0.004
"""Between samples of the grousers' forces [s]: five make a mean over 20 ms."""


class Engaged(NamedTuple):
    """What a trial tells of its grousers."""

    outcome: str
    slip: float
    """Largest slip from one nosing of the lower end to the next [m]."""
    slip_height: float
    """Kinetic-energy height of the largest speed down the stairs [m]."""
    grouser_force: float
    """Largest force on one grouser, mean of the samples of 20 ms, over the weight [1]."""


Runner = Callable[[Sequence[TrialSpec]], list[Engaged]]
"""What runs trials; `here` and `in_store` are such."""


class Cell(Part):
    """Grousers on a slope at a friction."""

    angle_deg: float
    """Slope [deg]."""
    height_m: float
    """Of the grousers above the belt [m]."""
    spacing_m: float
    """Of the grousers [m]."""
    nosing_radius_m: float
    """[m]"""
    friction: float
    """Simulated, static and sliding [1]."""
    required_friction: float | None
    """Below which rigid grousers slip for good by the rule [1]; null: none is enough."""
    outcomes: dict[str, int]
    """Trials by outcome."""
    slip_m: float | None
    """Largest slip from one nosing to the next, of the trials that climbed [m]; null: none did."""
    slip_height_m: float | None
    """Kinetic-energy height of their largest speed down the stairs [m]."""
    rule_slip_height_m: float
    """The same as the rule has it, of a slip by a whole spacing [m]."""
    energy_margin_m: float
    """Energy margin on the flight by the contact model [m]."""
    grouser_force_over_weight: float | None
    """Largest force on one grouser of theirs, mean of the samples of 20 ms [1]."""

    @property
    def climbed(self) -> bool:
        """Whether every trial climbed."""
        return set(self.outcomes) == {"climbed"}

    @property
    def rule_holds(self) -> bool:
        """Whether the rule says that the robot does not slip for good."""
        return self.required_friction is not None and self.friction >= self.required_friction


class Engagement(Answer):
    """Driven grousers in MuJoCo against the rule of traction."""

    text_module: ClassVar[str] = "kaidan.lab.calibration.engagement_text"

    robot: str
    """Robot."""
    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    trials: int
    """A cell."""
    seed: int
    """Of start offsets and of the grousers' phases."""
    cells: tuple[Cell, ...]
    """By grousers and nosings, slope, friction."""

    @property
    def wrong(self) -> list[Cell]:
        """Cells in which the rule holds and a trial slid or fell."""
        return [each for each in self.cells if each.rule_holds and not each.climbed]


def designs() -> list[dict[str, float]]:
    """The grousers and nosings that are tried [m]: the base first."""
    others = [{**BASE, name: value} for name, values in VARIED.items() for value in values]
    return [BASE, *others]


def trial_of(
    *, angle: float, height: float, spacing: float, nosing_radius: float, friction: float, seed: int
) -> TrialSpec:
    """Trial of grousers on a slope.

    angle: [rad]
    height, spacing, nosing_radius: [m]
    friction: [1]
    """
    question = Question.in_one_posture(
        ROBOT,
        Stairs.inclined(angle=angle, nosing_spacing=NOSING_SPACING),
        friction=friction,
    )
    return TrialSpec(
        question=question,
        track=DrivenGrousers(height=height, spacing=spacing),
        nosing_radius=nosing_radius,
        nosings=NOSINGS,
        seed=seed,
        log_interval=EVERY,
    )


def engagement(
    runner: Runner,
    *,
    trials: int = 2,
    seed: int = 0,
    slopes: Sequence[float] = SLOPES,
    frictions: Sequence[float] = FRICTIONS,
) -> Engagement:
    """Try grousers on slopes at frictions, and compare with the rule.

    Parameters
    ----------
    runner : Runner
        What runs the trials.
    trials : int
        A cell, each from its own start offset and phase of the grousers.
    slopes : sequence of float
        [deg]
    frictions : sequence of float
        [1]
    """
    keys = [(design, slope, mu) for design in designs() for slope in slopes for mu in frictions]
    specs = [
        trial_of(**design, angle=math.radians(slope), friction=mu, seed=seed_of(seed, k))
        for design, slope, mu in keys
        for k in range(trials)
    ]
    found = runner(specs)
    cells = [
        _cell(design, slope, mu, found[trials * at : trials * (at + 1)])
        for at, (design, slope, mu) in enumerate(keys)
    ]
    return Engagement(
        robot=ROBOT.name,
        nosing_spacing_m=NOSING_SPACING,
        trials=trials,
        seed=seed,
        cells=tuple(cells),
    )


def _cell(design: dict[str, float], slope: float, mu: float, found: list[Engaged]) -> Cell:
    required, height, margin = rule(**design, angle=math.radians(slope), friction=mu)
    climbed = [each for each in found if each.outcome == "climbed"]

    def largest(name: str) -> float | None:
        return max((getattr(each, name) for each in climbed), default=None)

    return Cell(
        angle_deg=slope,
        height_m=design["height"],
        spacing_m=design["spacing"],
        nosing_radius_m=design["nosing_radius"],
        friction=mu,
        required_friction=required,
        outcomes=dict(sorted(Counter(each.outcome for each in found).items())),
        slip_m=largest("slip"),
        slip_height_m=largest("slip_height"),
        rule_slip_height_m=height,
        energy_margin_m=margin,
        grouser_force_over_weight=largest("grouser_force"),
    )


def rule(
    *, angle: float, height: float, spacing: float, nosing_radius: float, friction: float
) -> tuple[float, float, float]:
    """What the rule of traction says of rigid grousers on the flight.

    The simulated tips are round with half their height. A round tip on a round nosing touches as a
    sharp one does on a nosing whose radius is the sum.

    friction required [1], kinetic-energy height of a slip by a spacing [m], energy margin [m].
    """
    question = Question.in_one_posture(
        ROBOT, Stairs.inclined(angle=angle, nosing_spacing=NOSING_SPACING), friction=friction
    )
    found = traverse_of(question, with_energy=True)
    grousers = Grousers(height, spacing, 0.0, nosing_radius + height / 2, rigid=True)
    nothing = (0.0, 0.0, 0.0)
    margin = found.grip.with_grousers(nothing, grousers, found.grip.by_friction(nothing))
    rows = found.phase_of_pose == Phase.TRAVERSE.value
    missing = -float(margin[rows].min())
    required = math.tan(max(missing, 0.0)) if missing < math.pi / 2 else math.inf
    heights = found.grip.slip_heights(spacing, mu_k=SLIDING * friction)
    energy = next(each.energy_margin for each in found.phases if each.phase is Phase.TRAVERSE)
    return required, float(heights[rows].max()), energy


def engaged(log: TrialLog) -> Engaged:
    """What a trial's log tells of its grousers."""
    result, columns = log.result, log.columns
    spacing = result.spec.profile().nosing_spacing
    passed = (result.start_offset + np.arange(result.nosings_passed)) * spacing
    at = np.searchsorted(np.maximum.accumulate(columns["path_m"]), passed)
    slips = np.diff(columns["slip_m"][np.minimum(at, len(log) - 1)])
    back = max(0.0, -float(columns["speed_m_s"].min(initial=0.0)))
    weight = result.mass_kg * STANDARD_GRAVITY
    return Engaged(
        outcome=result.outcome.value,
        slip=float(slips.max(initial=0.0)),
        slip_height=back**2 / (2.0 * STANDARD_GRAVITY),
        grouser_force=_largest_mean(log.grousers, round(WINDOW / result.spec.log_interval))
        / weight,
    )


def _largest_mean(forces: NDArray[np.float64], rows: int) -> float:
    """Largest size of the mean over so many rows of one grouser's force [N]."""
    if len(forces) < rows or not forces.shape[1]:
        return 0.0
    whole = np.cumsum(np.concatenate([np.zeros_like(forces[:1]), forces]), axis=0)
    means = (whole[rows:] - whole[:-rows]) / rows
    return float(np.hypot(means[..., 0], means[..., 1]).max())


def _run(spec: TrialSpec) -> dict[str, Any]:
    return engaged(record(spec))._asdict()


def _inputs(spec: TrialSpec) -> dict[str, Any]:
    return {"spec": text(spec)}


ENGAGEMENT = Work(
    name="engagement of grousers in MuJoCo",
    run=_run,
    inputs=_inputs,
    text=text,
    version=physics_version,
    columns={"spec": "text", "slip": "number", "slip_height": "number", "grouser_force": "number"},
)
"""Trials of which `engaged` is kept: a spec is a `kaidan.physics.TrialSpec`."""


def in_store(folder: Path, *, workers: int | None = None, progress: bool = False) -> Runner:
    """Runner on all processors that keeps its trials in a campaign's store, and resumes it."""

    def run(specs: Sequence[TrialSpec]) -> list[Engaged]:
        rows = rows_of(
            ENGAGEMENT, specs, folder, Engaged._fields, workers=workers, progress=progress
        )
        return [Engaged(**row) for row in rows]

    return run
