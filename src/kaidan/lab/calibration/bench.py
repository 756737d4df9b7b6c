"""The test bench: many settings of the physics, five trials at each condition, counted.

A `Bench` remembers every trial that it ran; with a store it finds them there next time.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from kaidan.lab.calibration.evidence import TRIALS as FIVE
from kaidan.lab.campaign import TRIALS, Condition, Setting, VerificationTest, rows_of
from kaidan.physics import TrialSpec
from kaidan.robot import Robot

FALL = 15.0
"""Inclination beyond the line of the nosings from which a trial counts as a fall [deg], whatever it
comes to in the end: the robot hangs on its tether."""

Figures = tuple[str, float, int]
"""Outcome, largest extra inclination [deg] and nosings passed of a trial."""
Runner = Callable[[Sequence[TrialSpec]], list[Figures]]
"""What runs trials and gives their figures, in their order."""


class Count(NamedTuple):
    """What the trials of a setting at a condition came to."""

    trials: int
    """Trials that began and did not diverge."""
    falls: int
    """Trials among them that fell."""
    extras: tuple[float, ...]
    """Largest extra inclination of each that did not fall [deg]."""
    slid: int = 0
    """Trials that neither fell nor came to the end of their path."""
    unplaced: int = 0
    """Trials, beside those that began, that fell before the track moved."""

    @property
    def lost(self) -> float:
        """Share of all that did not hold on the slope, in whatever way [1]; NaN of none.

        Below the angle of friction, and beyond it nobody looks, what slides hops back down.
        """
        whole = self.trials + self.unplaced
        return (self.falls + self.slid + self.unplaced) / whole if whole else math.nan


def with_ends(robot: Robot, radius: float) -> Robot:
    """Robot with ends of a radius [m]."""
    ends = {"front_radius": radius, "rear_radius": radius}
    track = type(robot.track).model_validate(robot.track.model_dump() | ends)
    return robot.model_copy(update={"track": track})


class Bench:
    """Runs trials, each once.

    Parameters
    ----------
    runner : Runner
        What runs them; `here` and `in_store` are such.
    seed : int
        Of start offsets and grouser phases; trials at one condition share them, whatever the
        setting, so that settings are compared on the same starts.
    trials : int
        Trials a condition.
    nosings : int
        To be passed in a trial. From more than two on, as on the rig, phases are spread evenly
        over the trials of a condition.
    """

    def __init__(
        self, runner: Runner, *, seed: int = 0, trials: int = FIVE, nosings: int = 2
    ) -> None:
        self.runner, self.seed, self.trials, self.nosings = runner, seed, trials, nosings
        self._counts: dict[str, tuple[Figures, ...]] = {}

    def counts(
        self, conditions: Iterable[tuple[Setting, Condition]], *, fall: float = FALL
    ) -> list[Count]:
        """Counts of settings at conditions, in their order; all trials in one go."""
        required = list(conditions)
        keys = [self._key(setting, condition) for setting, condition in required]
        new = {
            key: self._specs(*pair)
            for key, pair in zip(keys, required, strict=True)
            if key not in self._counts
        }
        figures = self.runner([spec for specs in new.values() for spec in specs]) if new else []
        for at, key in enumerate(new):
            self._counts[key] = tuple(figures[at * self.trials : (at + 1) * self.trials])
        return [count_of(self._counts[key], fall) for key in keys]

    def _specs(self, setting: Setting, condition: Condition) -> list[TrialSpec]:
        plan = VerificationTest(
            setting=setting,
            conditions=(condition,),
            trials=self.trials,
            seed=self.seed,
            nosings=self.nosings,
            stratified=self.nosings > 2,
        )
        return list(plan.specs())

    @staticmethod
    def _key(setting: Setting, condition: Condition) -> str:
        return setting.model_dump_json() + condition.model_dump_json()


def count_of(figures: Iterable[Figures], fall: float = FALL) -> Count:
    """Count of trials.

    Examples
    --------
    >>> count_of([("climbed", 1.5, 2), ("fell_backward", 47.0, 1), ("start_fall", 0.0, 0)])
    Count(trials=2, falls=1, extras=(1.5,), slid=0, unplaced=1)
    """
    known = [each for each in figures if each[0] not in SAYS_NOTHING]
    began = [each for each in known if each[0] != "start_fall"]
    stood = [each for each in began if not _fell(each, fall)]
    return Count(
        trials=len(began),
        falls=len(began) - len(stood),
        extras=tuple(extra for _, extra, _ in stood),
        slid=sum(outcome != "climbed" for outcome, _, _ in stood),
        unplaced=len(known) - len(began),
    )


SAYS_NOTHING = ("unstable", "failed", "crashed")
"""Outcomes that say nothing about the robot."""


def _fell(figures: Figures, fall: float) -> bool:
    outcome, extra, _ = figures
    return outcome in ("fell_backward", "fell_forward") or extra > fall


def in_store(folder: Path, *, workers: int | None = None, progress: bool = False) -> Runner:
    """Runner on all processors that keeps its trials in a campaign's store, and resumes it."""

    def run(specs: Sequence[TrialSpec]) -> list[Figures]:
        columns = ("outcome", "largest_extra_deg", "nosings_passed")
        rows = rows_of(TRIALS, specs, folder, columns, workers=workers, progress=progress)
        extras = [row["largest_extra_deg"] for row in rows]
        return [
            (row["outcome"], math.nan if extra is None else extra, row["nosings_passed"] or 0)
            for row, extra in zip(rows, extras, strict=True)
        ]

    return run
