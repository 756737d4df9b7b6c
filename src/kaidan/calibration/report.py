"""What was fitted, with intervals; what was predicted blind; what is not reproduced."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from kaidan.calibration.bench import Bench, Setting
from kaidan.calibration.blind import Blind, Prediction, predict
from kaidan.calibration.evidence import PAPER, SOURCE, Evidence
from kaidan.calibration.fitting import Candidate, Fit, Interval, Value, fit, intervals
from kaidan.calibration.likelihood import log_best_zone

JUDGED = 3
"""Candidates, the likeliest first, whose blind predictions are worked out."""


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """A fit and its judgement."""

    robot: str
    evidence: Evidence
    fit: Fit
    blind: tuple[Blind, ...]
    """Of the likeliest candidates, in their order."""
    trials: int
    """A condition."""
    seed: int

    @property
    def from_turn(self) -> tuple[Interval, ...]:
        """Intervals from theta_d alone."""
        return intervals(self.fit.candidates, lambda each: each.log_turn)

    @property
    def from_zone(self) -> tuple[Interval, ...]:
        """Intervals from the fall zone alone."""
        return intervals(self.fit.candidates, lambda each: each.log_zone)

    @property
    def lines(self) -> list[tuple[str, bool]]:
        """Everything fitted or predicted, in words, and whether the likeliest reproduces it."""
        best, evidence = self.fit.best, self.evidence
        told = [
            (f"fitted: {self._zone_told(best)}", zone_reproduced(best)),
            (f"fitted: {self._turn_told(best)}", turn_reproduced(evidence, best)),
        ]
        for each in self.blind[0].predictions if self.blind else ():
            told.append((f"blind: {prediction_told(each)}", each.reproduced))
        return told

    @property
    def not_reproduced(self) -> tuple[str, ...]:
        """What the likeliest candidate does not reproduce."""
        return tuple(text for text, good in self.lines if not good)

    def _zone_told(self, best: Candidate) -> str:
        zone = self.evidence.zone
        found = ", ".join(
            f"{count.falls} of {count.trials} at {angle:.1f}"
            for angle, count in zip((zone.below, zone.low, zone.high), best.counts, strict=False)
        )
        return (
            f"falls at {1e3 * zone.nosing_spacing:.0f} mm {found} deg (text, as read: none, some, "
            f"all); probability {math.exp(best.log_zone):.2g}, at best "
            f"{math.exp(log_best_zone(self.trials)):.2g}"
        )

    def _turn_told(self, best: Candidate) -> str:
        turn, swings = self.evidence.theta_d, best.swings
        found = f"{sum(swings) / len(swings):.1f}" if swings else "none"
        return f"theta_d {found} deg (text: {turn.extra:.1f}, taken as +-{turn.uncertainty:g})"

    def as_dict(self) -> dict[str, Any]:
        """Everything, ready for JSON."""
        return {
            "robot": self.robot,
            "kind": self.fit.kind,
            "source": SOURCE,
            "evidence": {
                name: value._asdict() if hasattr(value, "_asdict") else value
                for name, value in self.evidence._asdict().items()
            },
            "trials": self.trials,
            "seed": self.seed,
            "intervals": [each._asdict() for each in self.fit.intervals],
            "from_theta_d_alone": [each._asdict() for each in self.from_turn],
            "from_zone_alone": [each._asdict() for each in self.from_zone],
            "candidates": [candidate_dict(each) for each in self.fit.candidates],
            "blind": [
                {
                    "values": dict(each.candidate.values),
                    "predictions": [
                        {**one._asdict(), "off": one.off, "reproduced": one.reproduced}
                        for one in each.predictions
                    ],
                    "margins": [
                        {
                            **margin._asdict(),
                            "counts": [count._asdict() for count in margin.counts],
                        }
                        for margin in each.margins
                    ],
                }
                for each in self.blind
            ],
            "not_reproduced": list(self.not_reproduced),
        }


def calibrate(
    bench: Bench,
    robot: str,
    kind: str,
    grid: Sequence[tuple[dict[str, Value], Setting]],
    *,
    evidence: Evidence = PAPER,
    judged: int = JUDGED,
    step: float = 2.0,
) -> Calibration:
    """Fit to theta_d and the fall zone, then predict the rest blind.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    robot : str
        Its name, for the report.
    kind : str
        What is fitted.
    grid : sequence of (values, setting)
        Candidates; see `kaidan.calibration.fitting.compliance_grid` and `grouser_grid`.
    evidence : Evidence
        Figures of the text.
    judged : int
        Number of candidates, the likeliest first and none beyond the intervals, that predict.
    step : float
        Between the slopes at which margins are looked for [deg].

    Returns
    -------
    Calibration
    """
    found = fit(bench, evidence, kind, grid)
    blind = predict(bench, evidence, found.kept[:judged], step=step)
    return Calibration(
        robot=robot,
        evidence=evidence,
        fit=found,
        blind=blind,
        trials=bench.trials,
        seed=bench.seed,
    )


def zone_reproduced(candidate: Candidate) -> bool:
    """Whether the simulated trials themselves fell as the text says: none, some, all."""
    below, low, high = candidate.counts[:3]
    return below.falls == 0 and low.falls > 0 and high.falls == high.trials > 0


def turn_reproduced(evidence: Evidence, candidate: Candidate) -> bool:
    """Whether the mean turn lies within two standard uncertainties of the measured one."""
    turn, swings = evidence.theta_d, candidate.swings
    if not swings:
        return False
    return abs(sum(swings) / len(swings) - turn.extra) <= 2.0 * turn.uncertainty


def prediction_told(each: Prediction) -> str:
    """Prediction in words.

    Examples
    --------
    >>> prediction_told(
    ...     Prediction("theta_M", "theta_M at 150 mm", "deg", 6.0, 0.5, 1.2, 2.6, "")
    ... )
    'theta_M at 150 mm 6.0 deg (text: 1.2 to 2.6), 3.4 too large'
    """
    unit = " deg" if each.unit == "deg" else ""
    form = ".1f" if each.unit == "deg" else ".0f"
    if math.isinf(each.high):
        asked = f"{each.low:{form}} or more"
    elif each.low == each.high:
        asked = f"{each.low:{form}}"
    else:
        asked = f"{each.low:{form}} to {each.high:{form}}"
    read = f"taken as {each.reading}" if each.reading else f"text: {asked}"
    if math.isnan(each.value):
        return f"{each.text} not found on the grid of slopes ({read})"
    off = each.off
    away = "" if off == 0 else f", {abs(off):{form}} too {'large' if off > 0 else 'small'}"
    return f"{each.text} {each.value:{form}}{unit} ({read}){away}"


def candidate_dict(each: Candidate) -> dict[str, Any]:
    """Candidate for JSON, its trials counted."""
    return {
        "values": dict(each.values),
        "log_zone": each.log_zone,
        "log_theta_d": each.log_turn,
        "counts": [count._asdict() for count in each.counts],
    }
