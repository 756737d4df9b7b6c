"""The yielding track fitted to theta_d and the fall zone, shown as a region, judged blind."""

import math

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Answer, Part
from kaidan.lab.calibration.bench import Bench
from kaidan.lab.calibration.design import AXES, FIGURES, points_of, shares_of
from kaidan.lab.calibration.emulator import emulator_of
from kaidan.lab.calibration.evidence import PAPER, Evidence
from kaidan.lab.calibration.posterior import STEPS, Draws, posterior
from kaidan.mechanics.margin import theta_s_sup
from kaidan.robot import Robot

Array = NDArray[np.float64]

SHOWN = 400
"""Draws that an answer holds."""
IDENTIFIED = 0.5
"""Share of its range that the 95 % interval of a parameter is narrower than if it is fixed."""


class Interval(Part):
    """Median and interval of posterior draws."""

    low: float
    """2.5 %."""
    median: float
    """50 %."""
    high: float
    """97.5 %."""


class ParameterShown(Part):
    """What the evidence leaves of a parameter."""

    name: str
    """With its unit at the end."""
    text: str
    """What it is."""
    tried: tuple[float, float]
    """Range of the design."""
    interval: Interval
    """95 %."""
    share_of_range: float
    """Width of the interval as a share of the range, on its own scale [1]."""
    identified: bool
    """Whether that is less than a half."""


class Predicted(Part):
    """A figure of the paper's text beside the posterior's."""

    name: str
    text: str
    """What is predicted."""
    fitted: bool
    """Whether the fit used it; if not, it is predicted blind."""
    printed: tuple[float | None, float | None]
    """What the text prints, from and to; null: no bound."""
    interval: Interval
    """95 %, scatter of the emulator included [deg]."""
    probability: float
    """Share of the draws that agree with the text [1]."""


class EmulatorShown(Part):
    """How well a figure is emulated."""

    name: str
    ground: str
    coverage: float
    """Share of the design's points within the 95 % interval predicted from all others [1]."""
    deviation: float
    """Root mean square of those predictions' errors; [deg], of extra inclinations in log."""


class YieldingCalibration(Answer):
    """Parameters of a yielding track that go with theta_d and the fall zone, and what follows."""

    text_module = "kaidan.lab.calibration.yielding_text"

    robot: str
    points: int
    """Of the design."""
    trials: int
    """Of each condition."""
    seed: int
    evidence: Evidence
    """Figures of the text."""
    parameters: tuple[ParameterShown, ...]
    """What is left of each; the first three are the track's, the others nuisances."""
    correlation_k_ratio: float
    """Of the logarithms of k and kt/k over the draws [1]."""
    treads: float
    """Share of the draws with treads; the rest have nosings alone [1]."""
    predictions: tuple[Predicted, ...]
    """Fitted figures first."""
    all_blind: float
    """Share of the draws that agree with every blind figure at once [1]."""
    emulators: tuple[EmulatorShown, ...]
    """Of each figure on each ground."""
    autocorrelation_steps: float
    """Longest autocorrelation time of the sampler."""
    acceptance: float
    """Share of the sampler's proposals that were taken [1]."""
    draws: dict[str, tuple[float, ...]]
    """Some draws of each parameter, to be drawn."""


def calibrate_yielding(
    bench: Bench,
    robot: Robot,
    *,
    evidence: Evidence = PAPER,
    points: int = 256,
    steps: int = STEPS,
) -> YieldingCalibration:
    """Fit the yielding track to theta_d and the fall zone only.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    robot : Robot
        Whose ends are replaced.
    evidence : Evidence
        Of which the zone and theta_d are fitted to; the rest is only compared with.
    points : int
        Of the design, every other one with treads.
    steps : int
        Of the sampler.

    Raises
    ------
    InputError
        Too few points.
    MissingExtraError
        An optional package is not installed.
    """
    places = [
        (shares, "steps" if at % 2 == 0 else "noses")
        for at, shares in enumerate(shares_of(points, bench.seed))
    ]
    found = points_of(bench, evidence, robot, places)
    emulators = {
        ground: emulator_of([point for point in found if point.ground == ground])
        for ground in ("steps", "noses")
    }
    draws = posterior(emulators, evidence, seed=bench.seed, steps=steps)
    predictions, agree = _predictions(draws, evidence, robot)
    blind = [ok for each, ok in zip(predictions, agree, strict=True) if not each.fitted]
    return YieldingCalibration(
        robot=robot.name,
        points=points,
        trials=bench.trials,
        seed=bench.seed,
        evidence=evidence,
        parameters=_parameters(draws),
        correlation_k_ratio=float(np.corrcoef(draws.shares[:, 0], draws.shares[:, 1])[0, 1]),
        treads=float(np.mean(draws.steps)),
        predictions=predictions,
        all_blind=float(np.mean(np.all(blind, axis=0))),
        emulators=[
            EmulatorShown(name=name, ground=ground, coverage=coverage, deviation=deviation)
            for ground, each in emulators.items()
            for (name, _), coverage, deviation in zip(
                FIGURES, each.coverage, each.deviation, strict=True
            )
        ],
        autocorrelation_steps=draws.autocorrelation,
        acceptance=draws.acceptance,
        draws={
            axis.name: tuple(axis.value(share) for share in draws.shares[:SHOWN, at].tolist())
            for at, axis in enumerate(AXES)
        },
    )


def _parameters(draws: Draws) -> list[ParameterShown]:
    found = []
    for at, axis in enumerate(AXES):
        low, median, high = np.quantile(draws.shares[:, at], [0.025, 0.5, 0.975]).tolist()
        found.append(
            ParameterShown(
                name=axis.name,
                text=axis.text,
                tried=(axis.low, axis.high),
                interval=Interval(
                    low=axis.value(low), median=axis.value(median), high=axis.value(high)
                ),
                share_of_range=high - low,
                identified=high - low < IDENTIFIED,
            )
        )
    return found


def _predictions(
    draws: Draws, evidence: Evidence, robot: Robot
) -> tuple[list[Predicted], list[NDArray[np.bool_]]]:
    zone, theta_d, seen = evidence.zone, evidence.theta_d, evidence.rotation
    good = evidence.agreement
    stance = robot.stance()
    formula = {
        p: math.degrees(
            theta_s_sup(
                L=stance.flat_length, p=p, C_L=stance.com_from_front, C_N=stance.com_height, a=0.0
            )
        )
        for p in evidence.agreement_at
    }
    figures = draws.figures
    p1, p2 = evidence.agreement_at
    rows: list[tuple[str, str, bool, Array, float | None, float | None]] = [
        ("margin_150", "slope from which it falls at 150 mm", True, figures["margin_150"],
         zone.below, zone.high),
        ("theta_d", "theta_d at (150 mm, 56.8 deg)", True, figures["theta_d"],
         theta_d.extra - 2 * theta_d.uncertainty, theta_d.extra + 2 * theta_d.uncertainty),
        ("no_fall_200", "slope from which it falls at 200 mm: no fall at 44.0 deg", False,
         figures["margin_200"], seen.angle, None),
        ("rotation_200", "rotation at (200 mm, 44.0 deg): it is seen", False,
         figures["rotation_200"], seen.extra, None),
        ("theta_M", "theta_M at 150 mm", False,
         figures["descent_150"] - figures["margin_150"], *evidence.theta_M),
        ("agreement_200", "margin less formula at 200 mm: good agreement", False,
         figures["margin_200"] - formula[p1], -good, good),
        ("agreement_220", "margin less formula at 220 mm: good agreement", False,
         figures["margin_220"] - formula[p2], -good, good),
    ]  # fmt: skip
    found, agree = [], []
    for name, text, fitted, values, low, high in rows:
        quantiles = np.quantile(values, [0.025, 0.5, 0.975]).tolist()
        ok = np.ones(len(values), dtype=np.bool_)
        ok &= True if low is None else values >= low
        ok &= True if high is None else values <= high
        agree.append(ok)
        found.append(
            Predicted(
                name=name,
                text=text,
                fitted=fitted,
                printed=(low, high),
                interval=Interval(low=quantiles[0], median=quantiles[1], high=quantiles[2]),
                probability=float(np.mean(ok)),
            )
        )
    return found, agree
