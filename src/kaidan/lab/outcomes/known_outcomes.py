"""Robots on stairs whose outcome is public, and what kaidan answers: agreement and errors counted.

The pairs are those of the catalogue's ``outcomes.toml``: what the sources say of robot, stairs and
manner, fixed before an answer was looked at but where a note says otherwise. Each question
is put three times, since no operator knows what a laboratory measured.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal

from kaidan import catalog
from kaidan.allowance import UNMEASURED
from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments
from kaidan.assessment import with_plan
from kaidan.assessment.verdict import conclude
from kaidan.lab.outcomes.form import OutcomesForm
from kaidan.modes import Direction, Phase, Verdict
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.units import value_of

Outcome = Literal["climbs", "rocks", "falls", "slides", "sticks"]
Evidence = Literal["test", "simulation"]
Comparison = Literal["agrees", "wrong GO", "wrong ROUGH", "wrong NO-GO", "undecided", "no answer"]
Knowledge = Literal["source", "operator", "grip tried"]

RIGHT: dict[Outcome, tuple[Verdict, ...]] = {
    "climbs": (Verdict.GO, Verdict.ROUGH),
    "rocks": (Verdict.ROUGH,),
    "falls": (Verdict.NO_GO,),
    "slides": (Verdict.NO_GO,),
    "sticks": (Verdict.NO_GO,),
}
"""Verdicts that agree with each outcome."""
QUANTILE = 1.959964
"""Of the normal distribution, for intervals of 95 %."""
_ESTIMATED = {"com_from_front": "5mm", "com_height": "5mm"}
"""Standard uncertainty of a centroid that nobody measured better: an operator's tape and tilt."""
_HEADING = "3deg"
"""How far off the line of steepest ascent an operator may drive."""
_GAUGE = "320mm"
"""Of the robot without flippers, whose sheet has none: ours, of its width of 0.4 m."""


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
    friction: tuple[float, float] | None
    """Least and largest static friction of the question [1]; null: not stated."""
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
    fill_in: bool
    """Whether it was added at every 5 deg from 30 to 60 deg, where the outcome is easy to tell."""
    knowledge: Knowledge
    """How the question was put: as the source has it; by an operator, who knows the belts' kind
    but neither grip, allowances nor the centroid to better than 5 mm; or by one who has tried the
    grip and drives 3 deg off."""
    verdict: Verdict
    """What kaidan answers."""
    governs: str
    """What decides kaidan's answer."""
    phase: Phase | None
    """Where it decides."""
    comparison: Comparison
    """Whether the two agree."""


class Tally(Part):
    """How many pairs of one kind of evidence agree, with as much known."""

    evidence: Evidence
    """Which kind."""
    fill_in: bool
    """Whether these are the pairs at every 5 deg."""
    knowledge: Knowledge
    """How the question was put."""
    pairs: int
    """How many."""
    agree: int
    """GO and it climbed, ROUGH and it climbed or rocked, NO-GO and it failed."""
    agree_share: tuple[float, float]
    """Between which shares that lies, were the pairs independent (95 %, Wilson)."""
    wrong_go: int
    """GO, and the robot failed or rocked."""
    wrong_go_share: tuple[float, float]
    """Between which shares that lies, likewise."""
    wrong_rough: int
    """ROUGH, and the robot failed."""
    wrong_no_go: int
    """NO-GO, and the robot did not fail."""
    undecided: int
    """UNSURE."""
    no_answer: int
    """Outside the model."""


class KnownOutcomes(Answer):
    """Public outcomes beside kaidan's answers, counted."""

    text_module = "kaidan.lab.outcomes.text"

    pairs: tuple[Pair, ...]
    """In the order of the catalogue, and of the files given, each with all that may be known."""
    tallies: tuple[Tally, ...]
    """One for each kind of evidence and what is known."""
    reported: int
    """Public outcomes and makers' claims whose geometry is not public: no question can be put."""


@known_arguments
def known_outcomes(*forms: OutcomesForm) -> KnownOutcomes:
    """Put the question of every public outcome to kaidan, and count agreement and errors.

    forms: a laboratory's own pairs besides.
    """
    pairs = [
        _pair(entry, terrain, knowledge)
        for entry in entries(forms)
        for terrain in terrains(entry)
        for knowledge in _ways(entry)
    ]
    return KnownOutcomes(
        pairs=pairs, tallies=tuple(_tallies(pairs)), reported=len(catalog.outcomes()["reported"])
    )


def entries(forms: Iterable[OutcomesForm] = ()) -> Iterator[Mapping[str, Any]]:
    """What sources say of robot, stairs, manner and outcome, one after the other."""
    yield from catalog.outcomes()["pair"]
    for form in forms:
        yield from form.entries()


def share(count: int, of: int) -> tuple[float, float]:
    """Interval of a share, 95 %, by Wilson's formula.

    Examples
    --------
    >>> print(*(round(end, 3) for end in share(0, 16)))
    0.0 0.194
    """
    if not of:
        return 0.0, 1.0
    z2 = QUANTILE**2
    middle = (count + z2 / 2) / (of + z2)
    half = QUANTILE / (of + z2) * math.sqrt(count * (of - count) / of + z2 / 4)
    return max(middle - half, 0.0), min(middle + half, 1.0)


def compared(outcome: Outcome, verdict: Verdict) -> Comparison:
    """How an answer compares with what happened.

    Examples
    --------
    >>> compared("climbs", Verdict.GO), compared("rocks", Verdict.GO)
    ('agrees', 'wrong GO')
    """
    if verdict in RIGHT[outcome]:
        return "agrees"
    return {
        Verdict.GO: "wrong GO",
        Verdict.ROUGH: "wrong ROUGH",
        Verdict.UNSURE: "undecided",
        Verdict.NO_GO: "wrong NO-GO",
        Verdict.OUTSIDE_MODEL: "no answer",
    }[verdict]  # type: ignore[return-value]


def terrains(entry: Mapping[str, Any]) -> list[Stairs] | list[Profile]:
    """Terrain of an entry: one flight for each of its angles, its one flight, or its profile."""
    if "points" in entry:
        return [Profile.of_points(entry["points"], name=entry["name"])]
    angles = entry.get("angles", [])
    stairs = [{"angle": angle, **entry["stairs"]} for angle in angles] or [entry["stairs"]]
    return [_stairs(each) for each in stairs]


def _ways(entry: Mapping[str, Any]) -> Iterator[Knowledge]:
    """What may be known of a pair: operators stand before real flights."""
    yield "source"
    if entry["evidence"] == "test":
        yield from ("operator", "grip tried")


def _manner(entry: Mapping[str, Any], knowledge: Knowledge) -> dict[str, Any]:
    manner = dict(entry["manner"])
    if knowledge == "source":
        return manner
    override = {"track.belt": "grousers", **manner.pop("override", {})}
    if knowledge == "operator":
        del manner["friction"]
    else:
        override.setdefault("gauge", _GAUGE)
        manner["yaw"] = _HEADING
    most = 0.0 if manner.get("direction") == "down" else UNMEASURED
    unmeasured = {"theta_d": (0.0, UNMEASURED), "theta_M": (0.0, most)}
    return {**manner, **unmeasured, "override": override, "uncertainty": _ESTIMATED}


def _pair(entry: Mapping[str, Any], terrain: Stairs | Profile, knowledge: Knowledge) -> Pair:
    question, findings, _ = with_plan(
        Question.ask(entry["robot"], terrain, **_manner(entry, knowledge))
    )
    conclusion = conclude(question, findings)
    flight = question.flight
    surface = question.surface
    return Pair(
        robot=question.robot.name,
        stairs=question.terrain_name,
        angle_deg=flight and math.degrees(flight.angle),
        nosing_spacing_m=flight and flight.nosing_spacing,
        direction=question.direction,
        friction=surface and (surface.friction_low, surface.friction_high),
        fill_in="angles" in entry,
        knowledge=knowledge,
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


def _tallies(pairs: list[Pair]) -> Iterator[Tally]:
    kinds = {(pair.evidence, pair.fill_in, pair.knowledge): None for pair in pairs}
    for evidence, fill_in, knowledge in kinds:
        found = [
            pair.comparison
            for pair in pairs
            if (pair.evidence, pair.fill_in, pair.knowledge) == (evidence, fill_in, knowledge)
        ]
        agree, wrong_go = found.count("agrees"), found.count("wrong GO")
        yield Tally(
            evidence=evidence,
            fill_in=fill_in,
            knowledge=knowledge,
            pairs=len(found),
            agree=agree,
            agree_share=share(agree, len(found)),
            wrong_go=wrong_go,
            wrong_go_share=share(wrong_go, len(found)),
            wrong_rough=found.count("wrong ROUGH"),
            wrong_no_go=found.count("wrong NO-GO"),
            undecided=found.count("undecided"),
            no_answer=found.count("no answer"),
        )
