"""What a fit predicts of everything else the text prints, and how far off it is."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.lab.calibration.bench import Bench, Count
from kaidan.lab.calibration.evidence import Evidence, condition
from kaidan.lab.calibration.fitting import Candidate
from kaidan.lab.calibration.margins import Margin, margins_of, slopes
from kaidan.mechanics.margin import theta_s_sup

UP = {0.150: (44.0, 72.0), 0.200: (34.0, 66.0), 0.220: (28.0, 66.0)}
"""Slopes between which ascending margins are looked for, by nosing spacing [m: deg, deg]."""
DOWN = (54.0, 80.0)
"""The same descending, at the spacing of the fall zone [deg]."""


class Prediction(NamedTuple):
    """What one candidate predicts of something that it was not fitted to."""

    name: str
    text: str
    unit: str
    value: float
    """NaN: the grid of slopes does not span it."""
    deviation: float
    """Standard deviation over experiments of as many trials; NaN: not known."""
    low: float
    high: float
    """What the text prints."""
    assumption: str
    """What is taken for the figure, where the text prints none."""

    @property
    def off(self) -> float:
        """How far outside the printed range it is: negative below, positive above, 0 inside."""
        if math.isnan(self.value):
            return math.nan
        return max(0.0, self.value - self.high) - max(0.0, self.low - self.value)

    @property
    def reproduced(self) -> bool:
        """Whether the value lies in the printed range, or within two deviations of it."""
        room = 2.0 * self.deviation if math.isfinite(self.deviation) else 0.0
        return math.isfinite(self.value) and abs(self.off) <= room


class Blind(NamedTuple):
    """Predictions of one candidate, and the margins they come from."""

    candidate: Candidate
    predictions: tuple[Prediction, ...]
    margins: tuple[Margin, ...]


def predict(
    bench: Bench,
    evidence: Evidence,
    candidates: Sequence[Candidate],
    *,
    step: float = 2.0,
) -> tuple[Blind, ...]:
    """Predict what was not fitted to.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    evidence : Evidence
        Of which only the fields that the fit did not use are looked at, to compare with.
    candidates : sequence of Candidate
        What a fit kept.
    step : float
        Between the slopes at which margins are looked for [deg].

    Returns
    -------
    tuple of Blind
        In the order of the candidates.
    """
    p0, rotation = evidence.zone.nosing_spacing, evidence.rotation
    series = [
        *((p, "up", slopes(*UP[p], step)) for p in (p0, *evidence.agreement_at)),
        (p0, "down", slopes(*DOWN, step)),
    ]
    extras = bench.counts(
        (each.setting, condition(rotation.nosing_spacing, rotation.angle)) for each in candidates
    )
    found = margins_of(bench, [(each.setting, *one) for each in candidates for one in series])
    size = len(series)
    return tuple(
        _blind(evidence, each, extras[at], found[at * size : (at + 1) * size])
        for at, each in enumerate(candidates)
    )


def _blind(
    evidence: Evidence, candidate: Candidate, at_rotation: Count, margins: Sequence[Margin]
) -> Blind:
    up, *others, down = margins
    rotation = evidence.rotation
    where = f"at ({1e3 * rotation.nosing_spacing:.0f} mm, {rotation.angle:.1f} deg)"
    seen = float(np.mean(at_rotation.extras)) if at_rotation.extras else math.nan
    stance = candidate.setting.robot.stance()
    predictions = [
        Prediction(
            "falls", f"falls of {at_rotation.trials} {where}", "1", float(at_rotation.falls),
            math.nan, 0.0, 0.0, "",
        ),
        Prediction(
            "rotation", f"rotation {where}", "deg", seen, math.nan, rotation.extra, math.inf,
            f"{rotation.extra:g} deg can be seen",
        ),
        Prediction(
            "theta_M", f"theta_M at {1e3 * up.nosing_spacing:.0f} mm", "deg",
            down.value - up.value, math.hypot(down.deviation, up.deviation), *evidence.theta_M, "",
        ),
    ]  # fmt: skip
    for margin in others:
        formula = math.degrees(
            float(
                theta_s_sup(
                    L=stance.flat_length,
                    p=margin.nosing_spacing,
                    C_L=stance.com_from_front,
                    C_N=stance.com_height,
                    a=0.0,
                )
            )
        )
        predictions.append(
            Prediction(
                f"agreement_{1e3 * margin.nosing_spacing:.0f}",
                f"margin less formula at {1e3 * margin.nosing_spacing:.0f} mm", "deg",
                margin.value - formula, margin.deviation,
                -evidence.agreement, evidence.agreement,
                f"good agreement is {evidence.agreement:g} deg",
            )
        )  # fmt: skip
    return Blind(candidate, tuple(predictions), tuple(margins))
