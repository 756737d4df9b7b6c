"""A bench for tools that say whether a robot can take stairs: frozen cases, truth kept apart.

A tool sees cases alone: what the sources print of robot, flight and grip. What happened is held
apart, by where it comes from, and is compared with its answers afterwards.
"""

import importlib.util
import math
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from kaidan.answer import Answer, Part
from kaidan.assessment import with_plan
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError, short
from kaidan.lab.grouser_phase import limit_down, limit_up
from kaidan.lab.outcomes.known_outcomes import Outcome, compared, entries, terrains
from kaidan.mechanics.margin import theta_s_sup
from kaidan.modes import Verdict
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs

Case = Mapping[str, Any]
Tool = Callable[[Case], str]
_VERDICTS = {each.label: each for each in (Verdict.GO, Verdict.ROUGH, Verdict.NO_GO)}
_STEEPEST, _HIGHEST = 1.0, 0.12
"""Critical values of slope [rad] and step [m] of a navigation layer: those that
`traversability_estimation` of ETH Zurich ships (`config/robot_filter_parameter.yaml`)."""
_GROUSER = 0.007
"""Height of grousers of which nothing is known but that they are there [m]."""


class Score(Part):
    """How one tool fares on the cases of one source of truth."""

    tool: str
    """Which tool."""
    truth: str
    """Where what happened comes from: source, and whether it prints the outcome."""
    cases: int
    """How many."""
    right: int
    """GO and it climbed, ROUGH and it climbed or rocked, NO-GO and it failed."""
    wrong_go: int
    """GO, and the robot failed or rocked."""
    wrong_rough: int
    """ROUGH, and the robot failed."""
    wrong_no_go: int
    """NO-GO, and it did not fail."""
    undecided: int
    """None of these words."""
    ms: float
    """Time of an answer, the median of all cases [ms]."""


class Bench(Answer):
    """Tools beside each other."""

    text_module = "kaidan.lab.outcomes.bench_text"

    scores: tuple[Score, ...]
    """By source of truth, then by tool."""


class Answered(NamedTuple):
    """What a tool said, and how long it took."""

    verdict: Verdict
    seconds: float


def bench(adapter: Path | None = None) -> Bench:
    """Run the tools over the frozen cases.

    adapter: Python file with ``answer(case)``, which says "GO", "ROUGH", "NO-GO" or anything else.

    Raises
    ------
    InputError
        The file has no such function.
    """
    asked, truth = {}, {}
    for case, source, outcome in _frozen():
        asked[case["id"]], truth[case["id"]] = case, (source, outcome)
    tools = dict(TOOLS)
    if adapter is not None:
        tools[adapter.stem] = tool_of(adapter)
    answers = {
        name: {key: _timed(tool, case) for key, case in asked.items()}
        for name, tool in tools.items()
    }
    sources = dict.fromkeys(source for source, _ in truth.values())
    return Bench(
        scores=tuple(
            _score(name, source, truth, found)
            for source in sources
            for name, found in answers.items()
        )
    )


def tool_of(path: Path) -> Tool:
    """The function ``answer`` of a Python file."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if not path.is_file() or spec is None or spec.loader is None:
        raise InputError(f"{short(path)}: is no Python file")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    if not callable(found := getattr(module, "answer", None)):
        raise InputError(f"{short(path)}: has no function answer(case)")
    return found  # type: ignore[no-any-return]


def _frozen() -> Iterator[tuple[Case, str, Outcome]]:
    """Each case, and apart from it the source of its truth and what happened."""
    number = 0
    for entry in entries():
        for terrain in terrains(entry):
            if isinstance(terrain, Stairs):
                number += 1
                kind = "every 5 deg" if "angles" in entry else entry["status"]
                case = _case(f"{number:03d}", entry, terrain)
                yield case, f"{entry['source']}, {kind}", entry["outcome"]


def _case(key: str, entry: Mapping[str, Any], flight: Stairs) -> Case:
    """What a tool sees: lengths in m, angles in deg, mass in kg."""
    question = Question.ask(entry["robot"], flight, **entry["manner"])
    robot, surface = question.robot.weighed, question.surface
    assert surface is not None
    return {
        "id": key,
        "robot": robot.name,
        "flat_length": robot.track.flat_length,
        "com_from_front": robot.com_from_front,
        "com_height": robot.com_height,
        "rear_radius": robot.track.rear_radius,
        "nose_first_up": (question.direction == "up") == (question.facing == "nose-first"),
        "direction": question.direction,
        "rise": flight.rise,
        "going": flight.going,
        "steps": flight.steps,
        "angle_deg": math.degrees(flight.angle),
        "nosing_spacing": flight.nosing_spacing,
        "friction": surface.friction_low,
        "question": {"robot": entry["robot"], "manner": dict(entry["manner"])},
    }


def _timed(tool: Tool, case: Case) -> Answered:
    start = time.perf_counter()
    said = tool(case)
    return Answered(_VERDICTS.get(str(said), Verdict.UNSURE), time.perf_counter() - start)


def _score(
    name: str,
    source: str,
    truth: Mapping[str, tuple[str, Outcome]],
    found: Mapping[str, Answered],
) -> Score:
    keys = [key for key, (of, _) in truth.items() if of == source]
    marks = [compared(truth[key][1], found[key].verdict) for key in keys]
    times = sorted(found[key].seconds for key in keys)
    return Score(
        tool=name,
        truth=source,
        cases=len(keys),
        right=marks.count("agrees"),
        wrong_go=marks.count("wrong GO"),
        wrong_rough=marks.count("wrong ROUGH"),
        wrong_no_go=marks.count("wrong NO-GO"),
        undecided=marks.count("undecided"),
        ms=1e3 * times[len(times) // 2],
    )


def _kaidan(case: Case) -> str:
    """Kaidan's own answer to the whole question."""
    flight = Stairs(name="case", rise=case["rise"], going=case["going"], steps=case["steps"])
    asked = case["question"]
    question, findings, _ = with_plan(Question.ask(asked["robot"], flight, **asked["manner"]))
    return conclude(question, findings).verdict.label


def _paper(case: Case) -> str:
    """Eqs. (19)-(23), and friction."""
    return _by_limit(case, float(theta_s_sup(**_symbols(case))))


def _phase(case: Case) -> str:
    """Closed form of grouser phase, at rest, with grousers of 7 mm."""
    limit = limit_up if case["direction"] == "up" else limit_down
    return _by_limit(case, float(limit(h=_GROUSER, **_symbols(case))))


def _symbols(case: Case) -> dict[str, float]:
    L, C_L = case["flat_length"], case["com_from_front"]
    C_L = C_L if case["nose_first_up"] else L - C_L
    return {"L": L, "C_L": C_L, "C_N": case["com_height"], "p": case["nosing_spacing"]}


def _by_limit(case: Case, limit: float) -> str:
    if case["nosing_spacing"] > case["flat_length"] / 2:
        return "outside the model"
    angle = math.radians(case["angle_deg"])
    return "GO" if angle < limit and math.tan(angle) <= case["friction"] else "NO-GO"


def _slope(case: Case) -> str:
    """Slope threshold of a navigation layer."""
    return "GO" if math.radians(case["angle_deg"]) < _STEEPEST else "NO-GO"


def _slope_and_step(case: Case) -> str:
    """Slope and step thresholds of a navigation layer."""
    return "GO" if _slope(case) == "GO" and case["rise"] < _HIGHEST else "NO-GO"


TOOLS: Mapping[str, Tool] = {
    "kaidan": _kaidan,
    "Eqs. (19)-(23)": _paper,
    "grouser phase, 7 mm": _phase,
    "slope threshold": _slope,
    "slope and step thresholds": _slope_and_step,
}
"""Tools that the bench knows, by name."""
