"""What theta_M depends on: a designed study of what the paper does not state.

theta_M is the margin coming down tail first less that going up. Eleven things that are not known
are each set low or high in 24 runs, so that every effect is separate from every other and, since
each run has its mirror, from what any two do together.

References
----------
Plackett & Burman 1946, doi:10.1093/biomet/33.4.305, the design of 12 runs, folded over.
"""

import math
from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer, Part
from kaidan.lab.calibration.bench import Bench, with_ends
from kaidan.lab.calibration.evidence import PAPER, condition
from kaidan.lab.calibration.margins import margin_of, slopes
from kaidan.lab.campaign import Condition, Setting
from kaidan.physics import YieldingBelt
from kaidan.robot import Robot, Track

_FIRST = (1, 1, -1, 1, 1, 1, -1, -1, -1, 1, -1)
"""First row of the design; each further row is shifted by one, the last is all low."""
FACTORS: dict[str, tuple[float, float]] = {
    "treads": (0.0, 1.0),
    "end_radius_mm": (4.0, 20.0),
    "indentation_mm": (1.0, 5.0),
    "shear_ratio": (0.5, 2.0),
    "damping_ratio": (0.05, 0.3),
    "friction": (2.5, 4.0),
    "speed_mm_s": (50.0, 100.0),
    "slack_mm": (0.0, 120.0),
    "centroid_back_mm": (-5.0, 5.0),
    "inertia_kg_m2": (0.3, 0.6),
    "idle": (0.0, 1.0),
}
"""Low and high of each; `idle` changes nothing, so that its effect is the scatter of all others.
Slack is a stretch in the middle of the flat that sags off the nosings and carries nothing."""
MASS = 20.0
SPACING = 0.150


UP, DOWN, STEP = (44.0, 68.0), (46.0, 76.0), 2.0


class Effect(Part):
    """What a factor does when it goes from low to high."""

    factor: str
    """Name, its unit at the end."""
    low: float
    """[in that unit]"""
    high: float
    """[in that unit]"""
    theta_M_deg: float | None
    """On theta_M [deg]; null: no run at its low or high end has one."""
    up_deg: float | None
    """On the margin going up [deg]; null likewise."""


class Run(Part):
    """One run of the design."""

    levels: dict[str, float]
    """Value of each factor."""
    up_deg: float | None
    """Margin going up [deg]; null: the grid does not span it."""
    down_deg: float | None
    """Margin coming down tail first [deg]; null likewise."""
    theta_M_deg: float | None
    """Their difference [deg]."""


class ThetaMStudy(Answer):
    """Effects on theta_M of what the paper does not state."""

    text_module: ClassVar[str] = "kaidan.lab.calibration.theta_m_text"

    robot: str
    """Robot."""
    trials: int
    """A condition."""
    criterion_deg: float
    """Inclination beyond the stairs from which a trial counts as a fall [deg]."""
    printed_deg: tuple[float, float]
    """theta_M of the paper's text [deg]."""
    mean_deg: float | None
    """theta_M over all runs that have one [deg]; null: none has."""
    scatter_deg: float | None
    """Effect of the factor that changes nothing [deg]."""
    effects: tuple[Effect, ...]
    """The largest on theta_M first."""
    runs: tuple[Run, ...]
    """All runs."""


def design() -> NDArray[np.int64]:
    """Levels of the runs, -1 or 1, shape (24, 11)."""
    rows = [np.roll(_FIRST, shift) for shift in range(11)] + [np.full(11, -1)]
    half = np.array(rows)
    return np.vstack([half, -half])


def setting_of(robot: Robot, levels: dict[str, float]) -> Setting:
    """Setting of a run: the robot with what the factors change of it, its track and its ground."""
    sheet = with_ends(robot, levels["end_radius_mm"] / 1e3)
    track = Track.model_validate(sheet.track.model_dump() | {"gap": levels["slack_mm"] / 1e3})
    sheet = sheet.with_centroid(
        sheet.com_from_front + levels["centroid_back_mm"] / 1e3, sheet.com_height
    ).model_copy(update={"mass": MASS, "inertia": levels["inertia_kg_m2"], "track": track})
    belt = YieldingBelt(
        stiffness=MASS * 9.80665 / (levels["indentation_mm"] / 1e3),
        shear_ratio=levels["shear_ratio"],
        damping_ratio=levels["damping_ratio"],
    )
    return Setting.of(
        sheet,
        track=belt,
        friction=levels["friction"],
        speed=levels["speed_mm_s"] / 1e3,
        ground="steps" if levels["treads"] else "noses",
    )


def theta_m_study(
    bench: Bench, robot: Robot, *, criterion: float = 15.0, step: float = STEP
) -> ThetaMStudy:
    """Run the design and find the effects.

    Parameters
    ----------
    bench : Bench
        What runs the trials, by its criterion of a fall.
    robot : Robot
        The robot whose track, ends and ground are varied.
    criterion : float
        Inclination beyond the stairs from which a trial counts as a fall [deg].
    step : float
        Between slopes [deg].
    """
    coded = design()
    names = list(FACTORS)
    levels = [
        {name: FACTORS[name][int(sign > 0)] for name, sign in zip(names, row, strict=True)}
        for row in coded
    ]
    grids = {"up": slopes(*UP, step), "down": slopes(*DOWN, step)}
    jobs: list[tuple[Setting, Condition]] = [
        (setting_of(robot, each), condition(SPACING, angle, direction))
        for each in levels
        for direction, grid in grids.items()
        for angle in grid
    ]
    counts = bench.counts(jobs, fall=criterion)
    runs, at = [], 0
    for each in levels:
        found = {}
        for direction, grid in grids.items():
            found[direction] = margin_of(grid, counts[at : at + len(grid)])[0]
            at += len(grid)
        runs.append(
            Run(
                levels=each,
                up_deg=found["up"],
                down_deg=found["down"],
                theta_M_deg=found["down"] - found["up"],
            )
        )
    theta_M = np.array([_known(run.theta_M_deg) for run in runs])
    up = np.array([_known(run.up_deg) for run in runs])
    effects = [
        Effect(
            factor=name,
            low=FACTORS[name][0],
            high=FACTORS[name][1],
            theta_M_deg=_effect(coded[:, k], theta_M),
            up_deg=_effect(coded[:, k], up),
        )
        for k, name in enumerate(names)
    ]
    return ThetaMStudy(
        robot=robot.name,
        trials=bench.trials,
        criterion_deg=criterion,
        printed_deg=PAPER.theta_M,
        mean_deg=float(theta_M[np.isfinite(theta_M)].mean())
        if np.isfinite(theta_M).any()
        else None,
        scatter_deg=abs(_known(effects[-1].theta_M_deg)),
        effects=tuple(sorted(effects, key=lambda each: -abs(each.theta_M_deg or 0.0))),
        runs=tuple(runs),
    )


def _known(value: float | None) -> float:
    return math.nan if value is None else value


def _effect(signs: Sequence[int] | NDArray[np.int64], values: NDArray[np.float64]) -> float:
    """Mean where a factor is high less that where it is low; of a fit, as runs may be missing."""
    known = np.isfinite(values)
    high, low = (known & (np.asarray(signs) == sign) for sign in (1, -1))
    if not (high.any() and low.any()):
        return math.nan
    return float(values[high].mean() - values[low].mean())
