"""The answer of `kaidan.assess`: verdict, findings by failure mode, what would help."""

import math
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from kaidan.allowance import AllowanceShown
from kaidan.answer import Answer, Part
from kaidan.assessment.measuring import Measurement
from kaidan.assessment.verdict import Conclusion
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models.findings import Finding, Findings, at_risk
from kaidan.modes import (
    FAILURE_MODES,
    FALL_DOWNHILL,
    FALL_UPHILL,
    TIP_DOWNHILL,
    TIP_UPHILL,
    PhaseName,
    Verdict,
)
from kaidan.question import Question

if TYPE_CHECKING:
    from kaidan.assessment.limits import Limit
    from kaidan.assessment.plan import PlanShown
    from kaidan.assessment.unweighed import CentroidShown
    from kaidan.models.closed_form_figures import ClosedFormFigures
    from kaidan.models.contact_figures import ContactFigures
    from kaidan.models.dynamic_figures import PhysicsFigures
    from kaidan.models.landing_figures import LandingTurn
    from kaidan.models.support_polygon import SupportPolygonFigures
    from kaidan.models.traction_figures import TractionFigures

VerdictName = Literal["go", "rough", "unsure", "no-go", "outside-model"]


class FindingShown(Part):
    """Margin of one failure mode, positive when safe."""

    label: str
    """What happens if it fails."""
    unit: Literal["deg", "mm", "m/s", "N m", ""]
    """Unit of the margin; empty where it only holds or does not."""
    margin: float | None
    """In the worst case, allowances subtracted, at the chosen risk; null: not known, or without
    end."""
    margin_best: float | None
    """The same in the best case."""
    holds: bool | None
    """Whether it holds in the worst case at that risk; null: not known."""
    holds_best: bool | None
    """The same in the best case: what fails in it too is certain to fail."""
    probability: float | None
    """Share of samples that fail in the worst case; null if every input is exact."""
    phase: PhaseName | None
    """Part of the traverse in which the margin is smallest."""
    step: int | None
    """Nosing at which, counted from the bottom."""
    model: str
    """Model that found it."""

    @classmethod
    def of(cls, one: Finding, risk: float) -> "FindingShown":
        """As people read it."""
        mode = one.mode
        worst, best = one.margin(risk), one.margin(risk, best=True)
        exact = len(one.worst) == 1
        return cls(
            label=mode.label,
            unit=mode.shown_unit,
            margin=mode.shown(worst),
            margin_best=mode.shown(best),
            holds=None if math.isnan(worst) else worst > 0,
            holds_best=None if math.isnan(best) else best > 0,
            probability=None if exact or math.isnan(worst) else float(np.mean(one.fails())),
            phase=None if one.phase is None else one.phase.value,
            step=one.step,
            model=one.model,
        )


class Change(Part):
    """Something that would help, and what the verdict would then be."""

    change: str
    """What to do."""
    verdict: VerdictName
    """Verdict with it."""
    margin_deg: float | None
    """`margin_deg` with it; null where it is not known."""


class Assessment(Answer):
    """Can this robot take these stairs? One object with everything that was found.

    Angles in degrees, lengths in millimetres or metres and accelerations in m/s^2, up the stairs
    positive, as the names say. Null means: no such number, or not known to the model.
    """

    text_module: ClassVar[str] = "kaidan.text.assessment"

    verdict: VerdictName
    """At the chosen risk. go: nothing fails in the worst case, friction known. rough: it arrives in
    every case known of, but rocks, lands hard or rests on its belly. unsure: a case of something
    that is not known fails, or friction is not known. no-go: it fails in the best case too.
    outside-model: the model says nothing."""
    governs: str
    """What decides: a failure mode, a key of `findings`; else friction_unknown, margin_unknown or
    outside_model."""
    reason: str
    """The verdict in one sentence."""
    model: str
    """Model that answered; a finding says which model it is from."""
    phase: PhaseName | None
    """Part of the traverse in which the governing failure shows."""
    step: int | None
    """Nosing at which, counted from the bottom."""
    margin_deg: float | None
    """Smallest margin of slope of all failure modes in the worst case, allowances subtracted, at
    the chosen risk [deg]: positive for go, negative or zero for no-go."""
    margin_best_deg: float | None
    """The same in the best case [deg]."""
    margin_interval_deg: tuple[float, float] | None
    """95 % interval of the smallest margin in the worst case [deg]; null if all is exact."""
    margin_force_N: float | None
    """Force along the slope through the centroid that uses up `margin_deg` [N]; null without a
    mass."""
    failure_probability: float | None
    """Share of samples that fail by any slope in the worst case; null if all is exact."""
    findings: dict[str, FindingShown]
    """Margin of each failure mode that the model knows."""
    doubts: tuple[str, ...]
    """Failure modes that keep it from being a go, the most important first."""
    required_friction: float | None
    """Static friction below which the robot slips somewhere [1]; null if no friction is enough, or
    nothing is known."""
    friction: tuple[float, float] | None
    """Static friction of the surface, in the worst and in the best case [1]."""
    allowances: dict[str, AllowanceShown]
    """theta_d and theta_M."""
    angle_deg: float | None
    """Slope of the line through the nosings [deg], of several flights that of the steepest; null
    for a terrain that is no flight."""
    nosing_spacing_m: float | None
    """Mean distance from nosing to nosing of the same flight [m]; null likewise."""
    flat_length_m: float
    """L, flippers in line included [m]."""
    com_from_front_m: float
    """C_L, payload and flippers included [m]."""
    com_height_m: float
    """C_N, payload and flippers included [m]."""
    mass_kg: float | None
    """Mass with payload [kg]."""
    centroid: "CentroidShown | None"
    """What each place of a centroid that nobody measured would come to; null if it was measured."""
    contact: "ContactFigures | None"
    """What the contact model knows beside the margins; null if another model answers."""
    traction: "TractionFigures | None"
    """What the contact model knows of friction and grousers; null if another model answers."""
    closed_form: "ClosedFormFigures | None"
    """What the closed form knows; null if another model answers, or it does not apply."""
    support_polygon: "SupportPolygonFigures | None"
    """What the support polygon of both tracks knows; null without the tracks' distance."""
    physics: "PhysicsFigures | None"
    """What the trial in MuJoCo knows; null if another model answers."""
    turns: "tuple[LandingTurn, ...]"
    """How it turns on each landing where the way turns, from bottom to top; empty: on none."""
    plan: "PlanShown | None"
    """What to do with flippers, arm or payload, and which end leads; null where one posture was
    stated."""
    what_would_help: tuple[Change, ...]
    """Changes that raise the verdict or the margin, the best first."""
    to_measure: tuple[Measurement, ...]
    """What to measure next: which doubt the margin feels most, that first; empty where every input
    is exact, or nobody looked for advice."""
    limits: "tuple[Limit, ...]"
    """What limits the robot here, where the verdict is no go: figures of the stairs that are more
    than it takes, and what it would need."""
    notes: tuple[str, ...]
    """What the reader must know about this answer."""
    question: Question
    """The question that it answers, so that it can be put again."""

    def details(self) -> str:
        """Everything that was found, as a page for people."""
        return str(self.said("details"))

    def short(self) -> str:
        """The answer in one line."""
        return str(self.said("short"))

    @classmethod
    def model_rebuild(cls, **manner: Any) -> bool | None:
        """Complete the class for what validates, writes or describes it.

        An answer that is made and printed needs none of the figures of other models.
        """
        parts = {name: getattr(import_module(of), name) for name, of in _PARTS.items()}
        return super().model_rebuild(**manner | {"_types_namespace": parts})

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> Any:
        """Schema for what holds an answer, which needs the class to be complete."""
        if not cls.__pydantic_fields_complete__:
            cls.model_rebuild()
        return handler(source)

    @property
    def exit_code(self) -> int:
        """By `kaidan.modes.EXIT_CODES`."""
        return Verdict(self.verdict).exit_code

    @property
    def to_secure(self) -> str:
        """What to secure before a rough drive, the first of the notes; empty for other verdicts."""
        return self.notes[0] if self.verdict == "rough" and self.notes else ""

    @property
    def margins_deg(self) -> dict[str, float | None]:
        """Margin of every failure mode that has one in degrees."""
        return {key: one.margin for key, one in self.findings.items() if one.unit == "deg"}

    @property
    def falls_over(self) -> Literal["nose", "tail"] | None:
        """End over which the robot falls, where tipping makes it a no-go."""
        downhill = _OVER_DOWNHILL.get(self.governs)
        if self.verdict != "no-go" or downhill is None:
            return None
        return "tail" if downhill == self.question.nose_up else "nose"


_PARTS = {
    "CentroidShown": "kaidan.assessment.unweighed",
    "ClosedFormFigures": "kaidan.models.closed_form_figures",
    "ContactFigures": "kaidan.models.contact_figures",
    "LandingTurn": "kaidan.models.landing_figures",
    "Limit": "kaidan.assessment.limits",
    "PhysicsFigures": "kaidan.models.dynamic_figures",
    "PlanShown": "kaidan.assessment.plan",
    "SupportPolygonFigures": "kaidan.models.support_polygon",
    "TractionFigures": "kaidan.models.traction_figures",
}
"""Modules of the parts that not every answer has."""
_OVER_DOWNHILL = {
    TIP_DOWNHILL.key: True,
    TIP_UPHILL.key: False,
    FALL_DOWNHILL.key: True,
    FALL_UPHILL.key: False,
}
"""Whether a failure mode is over the downhill end; those of neither end have none."""


def fill_in(
    question: Question,
    found: Findings,
    conclusion: Conclusion,
    *,
    plan: "PlanShown | None",
    reason: str,
    notes: tuple[str, ...],
    what_would_help: tuple[Change, ...],
    to_measure: tuple[Measurement, ...] = (),
    centroid: "CentroidShown | None" = None,
) -> Assessment:
    """Answer of a question from what a model found and what it comes to."""
    stance, flight, risk = question.stance, question.steepest_flight, question.risk
    angle = None if flight is None else flight.angle
    figures: dict[str, Any] = {each.shown_as: each for each in found.figures}
    return Assessment.made(
        question=question,
        verdict=conclusion.verdict.value,
        governs=str(conclusion.governs),
        reason=reason,
        model=found.model,
        phase=None if conclusion.phase is None else conclusion.phase.value,
        step=conclusion.step,
        margin_deg=math.degrees(conclusion.margin),
        margin_best_deg=math.degrees(conclusion.margin_best),
        margin_interval_deg=_interval(conclusion),
        margin_force_N=_force(stance.mass, angle or 0.0, conclusion.margin),
        failure_probability=_probability(conclusion),
        findings={
            key: FindingShown.of(one, risk)
            for key, mode in FAILURE_MODES.items()
            if (one := found.of(mode)) is not None
        },
        doubts=tuple(one.mode.key for one in conclusion.doubts),
        required_friction=found.required_friction,
        friction=None if question.surface is None else question.friction,
        allowances={
            "theta_d": AllowanceShown.of(question.allowance_d),
            "theta_M": AllowanceShown.of(question.allowance_M),
        },
        angle_deg=None if angle is None else math.degrees(angle),
        nosing_spacing_m=None if flight is None else flight.nosing_spacing,
        flat_length_m=stance.flat_length,
        com_from_front_m=stance.com_from_front,
        com_height_m=stance.com_height,
        mass_kg=stance.mass,
        centroid=centroid,
        contact=figures.get("contact"),
        traction=figures.get("traction"),
        closed_form=figures.get("closed_form"),
        support_polygon=figures.get("support_polygon"),
        physics=figures.get("physics"),
        turns=figures["turns"].turns if "turns" in figures else (),
        plan=plan,
        what_would_help=what_would_help,
        to_measure=to_measure,
        limits=() if conclusion.verdict is Verdict.GO else _limits(question),
        notes=notes,
    )


def _limits(question: Question) -> "tuple[Limit, ...]":
    from kaidan.assessment.limits import limits

    return limits(question)


def _interval(conclusion: Conclusion) -> tuple[float, float] | None:
    samples = conclusion.samples
    if len(samples) == 1 or np.isnan(samples).any():
        return None
    low, high = (math.degrees(at_risk(samples, share)) for share in (0.025, 0.975))
    return (low, high) if math.isfinite(low) else None


def _probability(conclusion: Conclusion) -> float | None:
    samples = conclusion.samples
    return None if len(samples) == 1 else float(np.mean(~(samples > 0)))


def _force(mass: float | None, angle: float, margin: float) -> float | None:
    """Force along the slope through the centroid that uses the margin up [N]."""
    if mass is None or not math.isfinite(margin):
        return None
    limit = min(max(angle + margin, -1.5), 1.5)
    return mass * STANDARD_GRAVITY * math.cos(angle) * (math.tan(limit) - math.tan(angle))
