"""A sweep with a model judges each cell as `kaidan.assess` does, wherever it is judged.

The numbers of one are those of the other: the same code on the same question, so to the last bit
where the traverse is the same.
"""

import itertools
import math

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs, assess, sweep
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.modes import FAILURE_MODES, Verdict
from kaidan.robot import Drive, Track
from kaidan.sweeps.cells import MODES, VERDICTS
from kaidan.sweeps.parameters import question_of
from kaidan.sweeps.screen import applies, excluded

UNEVEN = Stairs(rises=(0.1, 0.1, 0.1), goings=(0.3, 0.3))


def close(one, other):
    """Equal to rounding: where a traverse is taken over only sums are made in another order."""
    if other is None:
        return math.isnan(one) or math.isinf(one)
    return one == pytest.approx(other, rel=1e-12, abs=1e-12)


def assert_cell_is_the_answer(cell, answer):
    assert VERDICTS[int(cell.verdict)] == answer.verdict
    words = cell.governs.attrs["flag_meanings"].split()
    assert words[int(cell.governs)] == answer.governs
    assert close(float(cell.margin_deg), answer.margin_deg)
    assert close(float(cell.margin_best_deg), answer.margin_best_deg)
    assert close(float(cell.required_friction), answer.required_friction)
    for key, column in MODES.items():
        shown = answer.findings.get(key)
        if column in cell and shown is not None and shown.margin is not None:
            assert close(float(cell[column]), shown.margin), key
    if "flippers" in cell:
        assert str(cell.flippers.values) == answer.question.flippers


VARIED = {
    "robot": ["absolem", "kenaf"],
    "stairs": ["ibc", Stairs(name="low", rise=0.09, going=0.17)],
    "friction": [0.6, (0.7, 1.1), 1.2],
    "direction": ["up", "down"],
    "com_height": [0.07, 0.12],
    "theta_d": [(0.0, 0.03), 0.02],
}


@pytest.mark.parametrize("model", ["contact", "closed-form"])
def test_random_cells_are_the_answers_of_assess(model):
    table = sweep(**VARIED, model=model, workers=1, flippers="stowed")
    assert set(table.verdict.dims) == set(VARIED)
    draw = np.random.default_rng(7)
    cells = list(itertools.product(*(range(len(each)) for each in VARIED.values())))
    for k in draw.choice(len(cells), 8, replace=False):
        at = dict(zip(VARIED, cells[k], strict=True))
        manner = {name: VARIED[name][i] for name, i in at.items()}
        height = manner.pop("com_height")
        answer = assess(
            manner.pop("robot"),
            manner.pop("stairs"),
            model=model,
            override={"com_height": height},
            flippers="stowed",
            **manner,
        )
        assert_cell_is_the_answer(table.isel(at), answer)


@pytest.mark.parametrize("model", ["contact", "closed-form"])
def test_without_a_posture_each_cell_has_its_own_best_plan(model):
    low = VARIED["stairs"][1]
    table = sweep(["absolem", "kenaf"], low, direction=["up", "down"], friction=1.0, model=model)
    for name in ("absolem", "kenaf"):
        for direction in ("up", "down"):
            answer = assess(name, low, direction=direction, friction=1.0, model=model)
            cell = table.sel(robot=name, direction=direction)
            assert_cell_is_the_answer(cell, answer)
            assert str(cell.facing.values) == answer.question.facing


def test_a_cell_with_the_best_posture_has_the_plan_of_assess():
    table = sweep("absolem", ["osha"], model="contact", flippers="best", friction=[1.0])
    answer = assess("absolem", "osha", flippers="best", friction=1.0)
    assert_cell_is_the_answer(table.isel(stairs=0, friction=0), answer)


def random_questions(count, seed):
    """Plain robots on uniform flights of which the closed form and the contact model may speak."""
    draw = np.random.default_rng(seed)
    for _ in range(count):
        L = draw.uniform(0.35, 0.9)
        robot = Robot(
            name="random",
            mass=20.0,
            com_from_front=L * draw.uniform(0.25, 0.7),
            com_height=draw.uniform(0.04, 0.3),
            track=Track(
                flat_length=L,
                front_radius=draw.uniform(0.03, 0.12),
                rear_radius=draw.uniform(0.03, 0.12),
            ),
            drive=Drive(max_traction=draw.uniform(60, 400)),
        )
        stairs = Stairs(
            rise=draw.uniform(0.06, 0.2), going=draw.uniform(0.15, 0.35), steps=draw.integers(5, 14)
        )
        low = draw.uniform(0.4, 1.4)
        yield Question.in_one_posture(
            robot,
            stairs,
            friction=(low, low * draw.uniform(1, 1.5)),
            direction=str(draw.choice(["up", "down"])),
            facing=str(draw.choice(["nose-first", "tail-first"])),
            acceleration=float(draw.choice([0, 0, 0.3, -0.3])),
        )


def screened(count, seed):
    questions = list(random_questions(count, seed))
    keys = excluded(questions)
    assert sum(map(applies, questions)) > 0.9 * count
    for question, key in zip(questions, keys, strict=True):
        if key is None:
            continue
        found = conclude(question, judge(question))
        assert found.verdict is not Verdict.GO, (key, question.to_json())
    return sum(key is not None for key in keys)


def test_what_the_closed_form_excludes_is_no_go_of_the_contact_model():
    assert screened(40, seed=1) > 10


@pytest.mark.slow
def test_the_same_of_many():
    assert screened(3000, seed=2) > 1000


def test_a_screened_sweep_has_every_go_of_the_whole_one():
    varied = {"com_height": [0.08, 0.3], "friction": [0.9, 1.4], "stairs": ["ada", "osha-ship"]}
    whole = sweep("absolem", flippers="flat", model="contact", **varied)
    part = sweep("absolem", flippers="flat", model="contact", screen=True, **varied)
    np.testing.assert_array_equal(whole.verdict == 0, part.verdict == 0)
    spared = part.verdict == VERDICTS.index("not-go")
    assert 0 < int(spared.sum()) < spared.size
    assert np.isnan(part.margin_deg.where(spared, drop=True)).all()
    same = ~spared
    np.testing.assert_array_equal(whole.margin_deg.where(same), part.margin_deg.where(same))


@pytest.mark.parametrize(
    "changes",
    [{"yaw": 0.1}, {"model": "closed-form"}, {"flippers": "best"},
     {"uncertainty": "com_height=5mm"}, {"stairs": UNEVEN}, {"steps": 2}],
    ids=lambda changes: "".join(changes),
)  # fmt: skip
def test_the_closed_form_excludes_nothing_else(changes):
    flat = {"robot": "absolem", "rise": 0.178, "going": 0.279, "friction": 0.1, "flippers": "flat"}
    assert excluded([question_of(flat)]) == ["slides_down"]
    values = flat | changes
    if "stairs" in changes:
        del values["rise"], values["going"]
    if "yaw" in changes:
        values["gauge"] = 0.4
    question = question_of(values)
    assert not applies(question)
    assert excluded([question]) == [None]


def test_either_end_first_is_excluded_only_together():
    """The centroid is ahead: up nose first it holds, down nose first it tips, tail first not."""
    steep = {"robot": "kenaf", "angle": 0.7, "nosing_spacing": 0.15, "friction": 2.0}
    up, down = (question_of(steep | {"direction": direction}) for direction in ("up", "down"))
    assert up.best_of == ("facing",)
    nose = [each.changed(best_of=()) for each in (up, down)]
    assert excluded([up, down, *nose]) == [None, None, None, "tip_downhill"]
    slippery = question_of(
        {"robot": "kenaf", "angle": 0.7, "nosing_spacing": 0.15, "friction": 0.1}
    )
    assert excluded([slippery]) == ["slides_down"]


def test_every_mode_has_a_column():
    assert MODES.keys() == FAILURE_MODES.keys()
    assert len(set(MODES.values())) == len(MODES)
