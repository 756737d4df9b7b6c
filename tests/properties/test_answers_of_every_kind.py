"""What every answer keeps to, whatever robot, terrain, manner and model: no contradiction in it.

Asked are all pairs of the catalogue and random questions: a few in every run, and by name
(``-m slow``) all of them and five thousand.
"""

from __future__ import annotations

import itertools
import math

import pytest

from amounts import fast_and_slow
from kaidan import Assessment
from kaidan.assessment import answer_to
from kaidan.catalog import names
from kaidan.modes import FAILURE_MODES, FORMULAS, MODELS, ROUGHLY, TIPS, Undecided
from kaidan.question import Question
from kaidan.robot import Robot
from question_cases import FRICTIONS, SHARES, of_catalogue, random_questions

ON_THE_LIMIT = 1e-9
"""Margin at which rounding decides [deg]."""
SLIP_OR_TIP = {mode.key for mode in (*FORMULAS, *TIPS)}
ROUGH = {key for key, mode in FAILURE_MODES.items() if mode.if_fails is ROUGHLY}
UNDECIDED = {str(each) for each in Undecided}


def contradictions(answer: Assessment) -> list[str]:
    """What an answer says against itself; empty: nothing."""
    found = []
    question = answer.question
    closed, contact = answer.closed_form, answer.contact
    # no NO-GO by slip or tip inside the safe band of accelerations
    if (
        answer.verdict == "no-go"
        and answer.governs in SLIP_OR_TIP
        and closed is not None
        and closed.a_min_safe is not None
        and closed.a_max_safe is not None
        and closed.a_min_safe < question.acceleration < closed.a_max_safe
        and abs(answer.margin_deg) > ON_THE_LIMIT
    ):
        found.append(f"{answer.governs} within the safe band")
    # what governs is a finding, or declared to be none
    if answer.governs in UNDECIDED:
        if answer.verdict in ("go", "no-go"):
            found.append(f"{answer.verdict} by {answer.governs}")
    elif answer.governs not in answer.findings:
        found.append(f"{answer.governs} is no finding")
    elif answer.verdict == "no-go" and answer.findings[answer.governs].holds is not False:
        alone = answer.failure_probability is None
        found += ["governs a no-go and holds"] if alone else []
    # no number of a terrain that does not exist, none of another model
    if question.flight is None:
        each = (closed, answer.support_polygon)
        found += ["a number of steps that do not exist"] if each != (None, None) else []
    steepest, steps = question.steepest_flight, (answer.angle_deg, answer.nosing_spacing_m)
    real = (None, None)
    if steepest is not None:
        real = math.degrees(steepest.angle), steepest.nosing_spacing
    if steps != real or (
        steepest is not None and steepest not in (question.flight, *question.flights)
    ):
        found.append("a slope of steps that do not exist")
    figures = {
        "contact": contact,
        "closed-form": closed,
        "physics": answer.physics,
    }
    for name, figure in figures.items():
        if name != answer.model and figure is not None:
            found.append(f"figures of {name} in an answer by {answer.model}")
    of_polygon = answer.model == "support-polygon" or bool(question.yaw)
    allowed = {answer.model, "support-polygon"} if of_polygon else {answer.model}
    found += [
        f"{key} of {one.model}" for key, one in answer.findings.items() if one.model not in allowed
    ]
    # margin and verdict agree in sign; the best case is no worse than the worst
    margin, best = answer.margin_deg, answer.margin_best_deg
    if answer.verdict == "go" and not (margin is not None and margin > 0):
        found.append(f"go with a margin of {margin}")
    no_margin = margin is None and answer.model == "physics"  # a trial falls, by no known margin
    if answer.verdict == "no-go" and not (no_margin or (margin is not None and margin <= 0)):
        found.append(f"no-go with a margin of {margin}")
    if margin is not None and best is not None and best < margin - ON_THE_LIMIT:
        found.append(f"margin {margin} better than {best} in the best case")
    # a go: nothing fails, friction stated; rough and unsure say why
    failing = [key for key, one in answer.findings.items() if one.holds is False]
    if answer.verdict == "go" and (failing or answer.friction is None):
        found.append(f"go although {failing} fails")
    if answer.verdict in ("rough", "unsure") and not answer.doubts:
        certain = answer.failure_probability is None and answer.governs not in UNDECIDED
        found += [f"{answer.verdict} without a doubt"] if certain else []
    if answer.verdict == "rough":
        found += [f"rough although {key} fails" for key in failing if key not in ROUGH]
        if answer.friction is None:
            found.append("rough without friction")
    if answer.verdict == "outside-model" and (answer.findings or margin is not None):
        found.append("numbers outside the model")
    if not answer.reason.endswith("."):
        found.append(f"reason is no sentence: {answer.reason}")
    # written and read back it is the same, and so is its question
    if Assessment.from_json(answer.to_json()) != answer:
        found.append("not the same after JSON")
    if Question.from_json(question.to_json()) != question:
        found.append("question not the same after JSON")
    return found


def assert_consistent(questions):
    """Answers of questions, without one contradiction; those seen by model and verdict."""
    seen: dict[tuple[str, str], int] = {}
    wrong = []
    for question in questions:
        answer = answer_to(question, advice=False)
        key = (answer.model, answer.verdict)
        seen[key] = seen.get(key, 0) + 1
        wrong += [(text, question.to_json()) for text in contradictions(answer)]
    assert [text for text, _ in wrong] == [], wrong[0]
    return seen


def test_pairs_of_the_catalogue():
    assert_consistent(itertools.islice(of_catalogue(), 0, None, 17))


def test_pairs_of_the_catalogue_by_the_closed_form():
    assert_consistent(itertools.islice(of_catalogue(model="closed-form"), 0, None, 7))


@pytest.mark.parametrize("count", fast_and_slow(80, 200))
def test_random_questions(count):
    seen = assert_consistent(random_questions(count, seed=1))
    assert {model for model, _ in seen} == set(SHARES)
    assert {verdict for model, verdict in seen if model == "contact"} >= {
        "go",
        "rough",
        "unsure",
        "no-go",
    }


@pytest.mark.slow
@pytest.mark.parametrize("model", ["contact", "closed-form"])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_all_pairs_of_the_catalogue(model, direction):
    seen = assert_consistent(of_catalogue(model=model, direction=direction))
    postures = sum(2 if Robot.named(name).flippers() else 1 for name in names("robots"))
    assert sum(seen.values()) == postures * len(names("stairs")) * len(FRICTIONS)


@pytest.mark.slow
def test_five_thousand_random_questions():
    seen = assert_consistent(random_questions(5000, seed=8))
    assert sum(seen.values()) == 5000
    for model in SHARES:
        assert min(seen.get((model, verdict), 0) for verdict in ("go", "unsure", "no-go")) > 10


@pytest.mark.slow
def test_random_questions_to_physics():
    pytest.importorskip("mujoco", reason="skipped: mujoco not installed")
    assert_consistent(random_questions(20, seed=3, shares={"physics": 1.0}))


def test_every_model_and_mode_is_known_here():
    """A new model or failure mode takes part in these tests once it is listed."""
    assert set(SHARES) | {"physics"} == set(MODELS)
    assert set(FAILURE_MODES) > SLIP_OR_TIP
    assert math.isclose(sum(SHARES.values()), 1.0)
