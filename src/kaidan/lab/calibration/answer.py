"""What `kaidan lab calibrate` answers: a fit and its judgement, and the effects of grousers."""

from typing import Any, Literal

from kaidan.answer import Answer, Part
from kaidan.lab.calibration.evidence import Evidence

Value = float | str


class CountShown(Part):
    """What the trials of a setting at a condition came to."""

    trials: int
    """Trials that began and did not diverge."""
    falls: int
    """Trials among them that fell."""
    extras_deg: tuple[float, ...]
    """Largest extra inclination of each that did not fall [deg]."""
    slid: int
    """Trials that neither fell nor came to the end of their path."""
    unplaced: int
    """Trials, beside those that began, that fell before the track moved."""


class MarginShown(Part):
    """Margin of a setting at a spacing, in one direction, from counts on a grid of slopes."""

    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    direction: Literal["up", "down"]
    angles_deg: tuple[float, ...]
    """Slopes of the grid [deg]."""
    counts: tuple[CountShown, ...]
    """At each slope."""
    value_deg: float | None
    """Mean slope from which trials are lost [deg]; null where the grid does not span it."""
    deviation_deg: float | None
    """Standard deviation: experiments of as many trials, step of the grid [deg]."""
    none_up_to_deg: float | None
    """Steepest slope up to which no trial was lost [deg]."""
    all_from_deg: float | None
    """Gentlest slope at which every trial was lost [deg]."""


class IntervalShown(Part):
    """Parameter with its 95 % profile interval."""

    name: str
    best: Value
    """Likeliest value."""
    low: Value
    """Lower end, as a value of the grid."""
    high: Value
    """Upper end, as a value of the grid."""
    kept: tuple[Value, ...]
    """Values within it."""
    at_edge: bool
    """Whether it reaches an end of the grid and may go on beyond."""


class CandidateShown(Part):
    """One point of the grid and its likelihood."""

    values: dict[str, Value]
    """Of each parameter, in the unit at the end of its name."""
    log_zone: float | None
    """Logarithm of the likelihood of the fall zone; null: none."""
    log_theta_d: float | None
    """Logarithm of the likelihood of theta_d; null: none."""
    theta_d_deg: float | None
    """Mean extra inclination of its trials [deg]; null: every trial fell everywhere."""
    counts: tuple[CountShown, ...]
    """Below the zone, at both of its ends, and where theta_d was measured."""


class ProfileLikelihood(Part):
    """Profile likelihood over the first parameter, from all evidence or a part of it."""

    evidence: Literal["theta_d", "fall zone", "both"]
    """From what."""
    values: tuple[float, ...]
    """Of the parameter, in the unit at the end of its name."""
    log_likelihood: tuple[float | None, ...]
    """Logarithm, less the largest; null: none."""


class PredictionShown(Part):
    """What a candidate predicts of something that it was not fitted to."""

    name: str
    text: str
    """What is predicted."""
    unit: Literal["deg", "1"]
    value: float | None
    """Null: the grid of slopes does not span it."""
    deviation: float | None
    """Standard deviation over experiments of as many trials; null: not known."""
    low: float
    """Least value that the text prints."""
    high: float | None
    """Largest value that the text prints; null: no bound."""
    assumption: str
    """What is taken for the figure, where the text prints none."""
    off: float | None
    """How far outside the printed range it is: negative below, positive above."""
    reproduced: bool
    """Whether it lies in the printed range, or within two deviations of it."""


class BlindShown(Part):
    """Predictions of one candidate, and the margins they come from."""

    values: dict[str, Value]
    """Of each parameter, in the unit at the end of its name."""
    predictions: tuple[PredictionShown, ...]
    """Of what the text prints and the fit did not use."""
    margins: tuple[MarginShown, ...]
    """At every spacing and direction."""


class Statement(Part):
    """Something fitted or predicted, in words."""

    text: str
    """Figure beside what the text prints."""
    reproduced: bool
    """Whether the likeliest candidate reproduces it."""


class Calibration(Answer):
    """A fit and its judgement."""

    text_module = "kaidan.lab.calibration.text"

    robot: str
    kind: str
    """What is fitted."""
    source: str
    """Where the evidence is from."""
    evidence: Evidence
    """Figures of the text."""
    trials: int
    """Trials of each condition."""
    seed: int
    within: float
    """How far below its largest value the profile likelihood is at the ends of an interval."""
    best: dict[str, Value]
    """The likeliest candidate."""
    intervals: tuple[IntervalShown, ...]
    """From theta_d and the fall zone."""
    from_theta_d_alone: tuple[IntervalShown, ...]
    """From theta_d alone."""
    from_zone_alone: tuple[IntervalShown, ...]
    """From the fall zone alone."""
    profiles: tuple[ProfileLikelihood, ...]
    """Of the first parameter."""
    candidates: tuple[CandidateShown, ...]
    """Every point of the grid."""
    blind: tuple[BlindShown, ...]
    """Of the likeliest candidates, in their order."""
    lines: tuple[Statement, ...]
    """Everything fitted or predicted."""

    @property
    def not_reproduced(self) -> tuple[str, ...]:
        """What the likeliest candidate does not reproduce."""
        return tuple(line.text for line in self.lines if not line.reproduced)


class Effect(Part):
    """theta_M of one kind of grousers."""

    varied: Literal["none", "height", "spacing", "stiffness", "friction"]
    """What is varied; "none" for the smooth belt."""
    value: float
    """Of what is varied [m, N/m or 1]."""
    up: MarginShown
    """Ascending margin."""
    down: MarginShown
    """Descending margin."""
    loss_deg: float | None
    """How much ascending margin is lost against the smooth belt [deg]."""
    theta_M_deg: float | None
    """Descending less ascending margin [deg]; null where a grid does not span its margin."""
    deviation_deg: float | None
    """Standard deviation of theta_M: counts, and step of the grids [deg]."""


class GrouserEffects(Answer):
    """Effects of the grousers' height, spacing, stiffness and friction on margins and theta_M."""

    text_module = "kaidan.lab.calibration.effects_text"

    robot: str
    trials: int
    """Trials of each condition."""
    seed: int
    base: dict[str, float]
    """Height [m], spacing [m], stiffness [N/m] and friction [1] while another is varied."""
    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    step_deg: float
    """Between slopes [deg]."""
    theta_M_printed_deg: tuple[float, float]
    """theta_M that the paper's text prints [deg]."""
    effects: tuple[Effect, ...]
    """The smooth belt first, then each varied value."""

    def columns(self) -> dict[str, list[Any]]:
        """Columns of a table; lengths in m, stiffness in N/m, friction in 1, angles in degrees."""
        columns: dict[str, list[Any]] = {
            name: [getattr(each, name) for each in self.effects] for name in ("varied", "value")
        }
        for name in ("up", "down"):
            margins = [getattr(each, name) for each in self.effects]
            columns |= {
                f"{name}_deg": [each.value_deg for each in margins],
                f"{name}_deviation_deg": [each.deviation_deg for each in margins],
                f"{name}_none_lost_to_deg": [each.none_up_to_deg for each in margins],
                f"{name}_all_lost_from_deg": [each.all_from_deg for each in margins],
            }
        return columns | {
            "loss_deg": [each.loss_deg for each in self.effects],
            "theta_M_deg": [each.theta_M_deg for each in self.effects],
            "theta_M_deviation_deg": [each.deviation_deg for each in self.effects],
        }
