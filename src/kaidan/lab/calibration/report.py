"""What was fitted, with intervals; what was predicted blind; what is not reproduced."""

import math
from collections.abc import Callable, Sequence
from typing import Any, Literal

from kaidan.lab.calibration import text as said
from kaidan.lab.calibration.answer import (
    BlindShown,
    Calibration,
    CandidateShown,
    CountShown,
    IntervalShown,
    MarginShown,
    PredictionShown,
    ProfileLikelihood,
    Statement,
    Value,
)
from kaidan.lab.calibration.bench import Bench, Count
from kaidan.lab.calibration.blind import Blind, Prediction, predict
from kaidan.lab.calibration.evidence import PAPER, SOURCE, Evidence
from kaidan.lab.calibration.fitting import WITHIN, Candidate, Fit, fit, intervals
from kaidan.lab.calibration.likelihood import log_best_zone
from kaidan.lab.calibration.margins import Margin
from kaidan.lab.campaign import Setting

JUDGED = 3
"""Candidates, the likeliest first, whose blind predictions are worked out."""

Judge = Callable[[Candidate], float]


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
        Candidates; see `kaidan.lab.calibration.fitting.compliance_grid`.
    evidence : Evidence
        Figures of the text.
    judged : int
        Number of candidates, the likeliest first and none beyond the intervals, that predict.
    step : float
        Between the slopes at which margins are looked for [deg].
    """
    found = fit(bench, evidence, kind, grid)
    blind = predict(bench, evidence, found.kept[:judged], step=step)
    first = next(iter(found.best.values))
    return Calibration(
        robot=robot,
        kind=kind,
        source=SOURCE,
        evidence=evidence,
        trials=bench.trials,
        seed=bench.seed,
        within=WITHIN,
        best=dict(found.best.values),
        intervals=_intervals(found, _both),
        from_theta_d_alone=_intervals(found, _theta_d),
        from_zone_alone=_intervals(found, _zone),
        profiles=[
            _profile(found, first, "theta_d", _theta_d),
            _profile(found, first, "fall zone", _zone),
            _profile(found, first, "both", _both),
        ],
        candidates=[_candidate(each) for each in found.candidates],
        blind=[_blind(each) for each in blind],
        lines=_lines(found.best, evidence, bench.trials, blind),
    )


def _both(each: Candidate) -> float:
    return each.log_likelihood


def _theta_d(each: Candidate) -> float:
    return each.log_extra


def _zone(each: Candidate) -> float:
    return each.log_zone


def _intervals(found: Fit, judge: Judge) -> list[IntervalShown]:
    return [IntervalShown(**each._asdict()) for each in intervals(found.candidates, judge)]


def _profile(
    found: Fit, name: str, evidence: Literal["theta_d", "fall zone", "both"], judge: Judge
) -> ProfileLikelihood:
    """Largest likelihood over all other parameters, for each value of one."""
    profile: dict[float, float] = {}
    for each in found.candidates:
        value = float(each.values[name])
        profile[value] = max(profile.get(value, -math.inf), judge(each))
    top, places = max(profile.values()), sorted(profile)
    return ProfileLikelihood(
        evidence=evidence,
        values=places,
        log_likelihood=[profile[x] - top if math.isfinite(top) else None for x in places],
    )


def _candidate(each: Candidate) -> CandidateShown:
    return CandidateShown(
        values=dict(each.values),
        log_zone=each.log_zone,
        log_theta_d=each.log_extra,
        theta_d_deg=sum(each.extras) / len(each.extras) if each.extras else None,
        counts=[count_shown(count) for count in each.counts],
    )


def count_shown(count: Count) -> CountShown:
    """Count as it is shown."""
    return CountShown(
        trials=count.trials,
        falls=count.falls,
        extras_deg=count.extras,
        slid=count.slid,
        unplaced=count.unplaced,
    )


def margin_shown(margin: Margin) -> MarginShown:
    """Margin as it is shown."""
    fields: dict[str, Any] = {
        "nosing_spacing_m": margin.nosing_spacing,
        "direction": margin.direction,
        "angles_deg": margin.angles,
        "counts": [count_shown(count) for count in margin.counts],
        "value_deg": margin.value,
        "deviation_deg": margin.deviation,
        "none_up_to_deg": margin.none_up_to,
        "all_from_deg": margin.all_from,
    }
    return MarginShown(**fields)


def prediction_shown(one: Prediction) -> PredictionShown:
    """Prediction as it is shown."""
    return PredictionShown(**one._asdict(), off=one.off, reproduced=one.reproduced)


def _blind(each: Blind) -> BlindShown:
    return BlindShown(
        values=dict(each.candidate.values),
        predictions=[prediction_shown(one) for one in each.predictions],
        margins=[margin_shown(margin) for margin in each.margins],
    )


def _lines(
    best: Candidate, evidence: Evidence, trials: int, blind: Sequence[Blind]
) -> list[Statement]:
    """Everything fitted or predicted, and whether the likeliest reproduces it."""
    zone, measured = evidence.zone, evidence.theta_d
    counts = [(count.falls, count.trials) for count in best.counts]
    zone_text = said.zone(
        1e3 * zone.nosing_spacing,
        list(zip((zone.below, zone.low, zone.high), counts, strict=False)),
        math.exp(best.log_zone),
        math.exp(log_best_zone(trials)),
    )
    theta_d_text = said.theta_d(best.extras, measured.extra, measured.uncertainty)
    lines = [
        Statement(text=f"fitted: {zone_text}", reproduced=zone_reproduced(best)),
        Statement(text=f"fitted: {theta_d_text}", reproduced=theta_d_reproduced(evidence, best)),
    ]
    for each in blind[0].predictions if blind else ():
        text = f"blind: {said.prediction(prediction_shown(each))}"
        lines.append(Statement(text=text, reproduced=each.reproduced))
    return lines


def zone_reproduced(candidate: Candidate) -> bool:
    """Whether the simulated trials themselves fell as the text says: none, some, all."""
    below, low, high = candidate.counts[:3]
    return below.falls == 0 and low.falls > 0 and high.falls == high.trials > 0


def theta_d_reproduced(evidence: Evidence, candidate: Candidate) -> bool:
    """Whether the mean extra inclination is within two standard uncertainties of the measured."""
    measured, extras = evidence.theta_d, candidate.extras
    if not extras:
        return False
    return abs(sum(extras) / len(extras) - measured.extra) <= 2.0 * measured.uncertainty
