"""Robots on stairs whose outcome is public, and what kaidan answers: agreement and errors counted.

The pairs are those of the catalogue's ``outcomes.toml``: what the sources say of robot, stairs and
manner, fixed before an answer was looked at but where a note says otherwise.
"""

import math
from collections.abc import Mapping
from typing import Any, Literal

from kaidan import catalog
from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments
from kaidan.assessment import with_plan
from kaidan.assessment.verdict import conclude
from kaidan.modes import Direction, Phase, Verdict
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.units import value_of

Outcome = Literal["climbs", "rocks", "falls", "slides", "sticks"]
Evidence = Literal["test", "simulation"]
Comparison = Literal["agrees", "wrong GO", "wrong NO-GO", "CAUTION", "no answer"]

RIGHT: dict[Outcome, Verdict] = {
    "climbs": Verdict.GO,
    "rocks": Verdict.CAUTION,
    "falls": Verdict.NO_GO,
    "slides": Verdict.NO_GO,
    "sticks": Verdict.NO_GO,
}
"""Verdict that agrees with each outcome."""


class Pair(Part):
    """A robot on stairs: the public outcome and kaidan's answer."""

    robot: str
    """Its name."""
    stairs: str
    """Name of the flight, or of another obstacle."""
    angle_deg: float | None
    """Slope of the line through the nosings [deg]; null: no flight."""
    nosing_spacing_m: float | None
    """From nosing to nosing [m]; null likewise."""
    direction: Direction
    """Which way it goes."""
    friction: tuple[float, float]
    """Least and largest static friction of the question [1]."""
    outcome: Outcome
    """What happened. To rock is to rotate, be arrested and go on."""
    evidence: Evidence
    """Who saw it: a test of a real robot, or another project's simulation."""
    status: Literal["printed", "derived"]
    """Whether the source prints the outcome or it follows from what it prints."""
    note: str
    """How the source says it, or how it follows."""
    source: str
    """Key of the source."""
    verdict: Verdict
    """What kaidan answers."""
    governs: str
    """What decides kaidan's answer."""
    phase: Phase | None
    """Where it decides."""
    comparison: Comparison
    """Whether the two agree."""


class Tally(Part):
    """How many pairs of one kind of evidence agree."""

    evidence: Evidence
    """Which kind."""
    pairs: int
    """How many."""
    agree: int
    """GO and it climbed, CAUTION and it rocked, NO-GO and it failed."""
    wrong_go: int
    """GO, and the robot failed or rocked."""
    wrong_no_go: int
    """NO-GO, and the robot did not fail."""
    caution: int
    """CAUTION, and the robot neither failed nor rocked, or failed."""
    no_answer: int
    """Outside the model."""


class KnownOutcomes(Answer):
    """Public outcomes beside kaidan's answers, counted."""

    text_module = "kaidan.lab.outcomes.text"

    pairs: tuple[Pair, ...]
    """In the order of the catalogue."""
    tallies: tuple[Tally, ...]
    """One for each kind of evidence."""
    reported: int
    """Public outcomes and makers' claims whose geometry is not public: no question can be put."""


@known_arguments
def known_outcomes() -> KnownOutcomes:
    """Put the question of every public outcome to kaidan, and count agreement and errors."""
    table = catalog.outcomes()
    pairs = [_pair(entry, terrain) for entry in table["pair"] for terrain in _terrains(entry)]
    kinds: tuple[Evidence, ...] = ("test", "simulation")
    return KnownOutcomes(
        pairs=pairs,
        tallies=[_tally(kind, [pair for pair in pairs if pair.evidence == kind]) for kind in kinds],
        reported=len(table["reported"]),
    )


def compared(outcome: Outcome, verdict: Verdict) -> Comparison:
    """How an answer compares with what happened.

    Examples
    --------
    >>> compared("climbs", Verdict.GO), compared("rocks", Verdict.GO)
    ('agrees', 'wrong GO')
    """
    if verdict is RIGHT[outcome]:
        return "agrees"
    return {
        Verdict.GO: "wrong GO",
        Verdict.CAUTION: "CAUTION",
        Verdict.NO_GO: "wrong NO-GO",
        Verdict.OUTSIDE_MODEL: "no answer",
    }[verdict]  # type: ignore[return-value]


def _terrains(entry: Mapping[str, Any]) -> list[Stairs] | list[Profile]:
    """Terrain of an entry: one flight for each of its angles, its one flight, or its profile."""
    if "points" in entry:
        return [Profile.of_points(entry["points"], name=entry["name"])]
    angles = entry.get("angles", [])
    stairs = [{"angle": angle, **entry["stairs"]} for angle in angles] or [entry["stairs"]]
    return [_stairs(each) for each in stairs]


def _pair(entry: Mapping[str, Any], terrain: Stairs | Profile) -> Pair:
    question, findings, _ = with_plan(Question.ask(entry["robot"], terrain, **entry["manner"]))
    conclusion = conclude(question, findings)
    flight = question.flight
    assert question.surface is not None
    return Pair(
        robot=question.robot.name,
        stairs=question.terrain_name,
        angle_deg=flight and math.degrees(flight.angle),
        nosing_spacing_m=flight and flight.nosing_spacing,
        direction=question.direction,
        friction=(question.surface.friction_low, question.surface.friction_high),
        verdict=conclusion.verdict,
        governs=str(conclusion.governs),
        phase=conclusion.phase,
        comparison=compared(entry["outcome"], conclusion.verdict),
        **{name: entry[name] for name in ("outcome", "evidence", "status", "note", "source")},
    )


def _stairs(entry: Mapping[str, Any]) -> Stairs:
    """Flight by angle and nosing spacing, or by rise, going and number of risers."""
    if "angle" in entry:
        return Stairs.inclined(**entry)
    rise, going = (value_of(entry[name], "length", option=name) for name in ("rise", "going"))
    name = f"{1e3 * rise:g}/{1e3 * going:g} mm"
    return Stairs(name=name, rise=rise, going=going, steps=entry["steps"])


def _tally(evidence: Evidence, pairs: list[Pair]) -> Tally:
    found = [pair.comparison for pair in pairs]
    return Tally(
        evidence=evidence,
        pairs=len(pairs),
        agree=found.count("agrees"),
        wrong_go=found.count("wrong GO"),
        wrong_no_go=found.count("wrong NO-GO"),
        caution=found.count("CAUTION"),
        no_answer=found.count("no answer"),
    )
