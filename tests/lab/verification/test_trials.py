"""Trials in MuJoCo as a campaign: what is planned, what stands in a row, the same every time."""

import json
import math

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pyarrow")

import physics_cases
from kaidan.errors import InputError
from kaidan.lab.campaign import (
    TRIALS,
    Condition,
    Grid,
    Setting,
    VerificationTest,
    carry_out,
    resume,
)
from kaidan.lab.campaign.plans import as_stored, plan_from
from kaidan.lab.campaign.trials import physics_version
from kaidan.physics import DrivenGrousers, SprungNoses, TrialSpec, run
from kaidan.robot import Posture
from kaidan.surface import Surface
from kaidan.work import read_table

OF_ITS_OWN = {"host", "wall_time_s"}
"""Columns that are not the same every time."""


def plan(**fields):
    conditions = [
        Condition(nosing_spacing=0.15, angle=math.radians(angle)) for angle in (55.0, 70.0)
    ]
    setting = Setting(robot=physics_cases.robot())
    return VerificationTest(**{"setting": setting, "conditions": conditions, "trials": 2} | fields)


def rows(folder):
    found = read_table(folder).to_pylist()
    return {row["id"]: {k: v for k, v in row.items() if k not in OF_ITS_OWN} for row in found}


def test_same_seed_same_rows_and_what_stands_in_them(tmp_path):
    one, other = tmp_path / "one", tmp_path / "other"
    assert carry_out(plan(), one, workers=2).outcomes == {"climbed": 2, "fell_backward": 2}
    carry_out(plan(), other, workers=1)
    assert rows(one) == rows(other)
    assert resume(one, workers=1).found == 4

    for spec in plan().specs():
        row, result = rows(one)[TRIALS.identity(spec)], run(spec)
        assert TrialSpec.model_validate_json(row["spec"]) == spec, "all inputs, exactly"
        assert row["outcome"] == result.outcome.value
        assert row["largest_extra_deg"] == result.largest_extra_deg
        assert row["seed"] == spec.seed
        assert row["start_offset"] == result.start_offset
        assert row["angle_deg"] == pytest.approx(
            math.degrees(spec.question.terrain.angle), abs=1e-9
        )
        assert row["nosing_spacing_m"] == pytest.approx(0.15, abs=1e-12)
        assert row["mass_kg"] == result.mass_kg
        assert (row["phase"], row["step"]) == (result.phase, result.step)
        assert row["nosings_passed"] == result.nosings_passed
        assert row["version"] == physics_version()
        assert row["mujoco"] == result.versions["mujoco"]


def test_seeds_belong_to_conditions_not_to_the_plan():
    one = plan()
    more = plan(conditions=[Condition(nosing_spacing=0.2, angle=0.7), *one.conditions])
    identities = {TRIALS.identity(spec) for spec in more.specs()}
    assert {TRIALS.identity(spec) for spec in one.specs()} < identities
    assert len(identities) == len(more) == 6
    assert len({spec.seed for spec in more.specs()}) == 6
    offsets = [spec.drawn()[0] for spec in one.specs()]
    assert offsets != [spec.drawn()[0] for spec in plan(seed=1).specs()]


def test_it_comes_down_tail_first():
    down = plan(conditions=[Condition(nosing_spacing=0.15, angle=1.0, direction="down")])
    spec = next(down.specs())
    assert (spec.question.direction, spec.question.facing) == ("down", "tail-first")


def test_identity_depends_on_every_input_and_on_the_version(monkeypatch):
    spec = next(plan().specs())
    changed = [
        spec.model_copy(update={"seed": spec.seed + 1}),
        spec.model_copy(update={"timestep": 5e-4}),
        spec.model_copy(update={"track": SprungNoses(stiffness=3e4)}),
    ]
    identities = {TRIALS.identity(each) for each in (spec, *changed)}
    assert len(identities) == 4
    newer = TRIALS.__class__(**{**TRIALS.__dict__, "version": lambda: "newer"})
    assert newer.identity(spec) not in identities


def test_grid():
    grid = Grid(
        base=physics_cases.spec(55.0, track=SprungNoses(stiffness=3e4)),
        axes=(
            ("track.stiffness", (1e4, 2e4)),
            ("question.surface", [Surface.of_friction(mu) for mu in (1.0, 2.0, 3.0)]),
        ),
        trials=4,
    )
    specs = list(grid.specs())
    assert len(specs) == len(grid) == 24
    assert [spec.track.stiffness for spec in specs[::12]] == [1e4, 2e4]
    assert [spec.static_friction for spec in specs[:12:4]] == [1.0, 2.0, 3.0]
    assert len({TRIALS.identity(spec) for spec in specs}) == 24
    assert plan_from(json.loads(json.dumps(as_stored(grid)))) == grid, "a store can keep it"


def test_grid_refusals():
    base = physics_cases.spec(55.0)
    with pytest.raises(InputError) as caught:
        Grid(base=base, axes=(("track.shoes", (30,)),))
    assert str(caught.value) == "grid: 'track.shoes' is no field of a trial; known there: kind"
    with pytest.raises(InputError) as caught:
        Grid(base=base, axes=(("seed", ()),))
    assert str(caught.value) == "grid: seed has no value"


def test_missing_mujoco_is_refused_before_anything_is_begun(tmp_path, monkeypatch):
    from importlib.metadata import PackageNotFoundError

    def nowhere(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr("kaidan.lab.campaign.trials.version", nowhere)
    physics_version.cache_clear()
    try:
        with pytest.raises(ImportError) as caught:
            carry_out(plan(), tmp_path / "store")
    finally:
        physics_version.cache_clear()
    assert str(caught.value) == (
        "the physics model needs an optional package: pip install 'kaidan[physics]'"
    )
    assert not (tmp_path / "store").exists()


def test_a_setting_of_texts_is_that_of_numbers():
    texts = Setting.of("absolem", flippers="20deg,-5deg", friction="0.8", speed="0.2m/s")
    flippers = Posture(front=math.radians(20.0), rear=math.radians(-5.0))
    assert texts == Setting.of("absolem", flippers=flippers, friction=0.8, speed=0.2)


def test_without_a_friction_a_setting_has_that_of_its_track():
    (condition,) = plan(conditions=[Condition(nosing_spacing=0.15, angle=0.7)]).conditions
    kinds = (Setting.of("kenaf"), Setting.of("kenaf", track=DrivenGrousers()))
    assert [setting.trial(condition, 0).static_friction for setting in kinds] == [3.0, 0.8]
    assert Setting.of("kenaf", friction="0.5..1").trial(condition, 0).static_friction == 0.5


def test_a_store_of_other_columns_is_refused_in_one_line(tmp_path):
    from kaidan.work.store_files import write_about

    store = tmp_path / "store"
    carry_out(plan(trials=1), store, workers=1)
    columns = {**TRIALS.all_columns(), "release": "count"}
    write_about(store, {"work": TRIALS.name, "columns": columns, "plans": []})
    with pytest.raises(InputError) as refused:
        carry_out(plan(trials=1), store, workers=1)
    assert str(refused.value) == (
        f"store {str(store)!r}: another version of kaidan wrote it, with other columns; export it "
        "and begin a new store"
    )


def test_phases_are_spread_evenly_and_shared_by_all_slopes():
    conditions = [Condition(nosing_spacing=0.15, angle=angle) for angle in (0.9, 1.0)]
    made = plan(conditions=conditions, trials=5, stratified=True, nosings=10)
    specs = list(made.specs())
    phases = [spec.grouser_phase for spec in specs[:5]]
    # by hand: one in each fifth, all at one place within theirs
    assert [int(5 * phase) for phase in phases] == [0, 1, 2, 3, 4]
    assert [5 * phase % 1.0 for phase in phases] == pytest.approx([5 * phases[0] % 1.0] * 5)
    offsets = [(spec.start_offset - 0.1) / 0.4 for spec in specs[:5]]
    assert sorted(int(5 * offset) for offset in offsets) == [0, 1, 2, 3, 4]
    for first, second in zip(specs[:5], specs[5:], strict=True):
        assert first.drawn() == second.drawn()
        assert first.seed != second.seed
    assert specs[3] == made.spec(made.conditions[0], 3)


def test_a_trial_of_ten_nosings_stays_on_the_flight():
    for direction in ("up", "down"):
        condition = Condition(nosing_spacing=0.15, angle=0.9, direction=direction)
        (spec,) = plan(conditions=[condition], trials=1, nosings=10).specs()
        assert spec.nosings == 10
        assert not spec.runs_out
