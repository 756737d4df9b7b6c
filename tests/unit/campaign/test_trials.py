"""Trials in MuJoCo as a campaign: what is planned, what stands in a row, the same every time."""

import json
import math

import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pyarrow")

import physics_cases
from kaidan.campaign import (
    TRIALS,
    Condition,
    Grid,
    VerificationTest,
    carry_out,
    read_table,
    resume,
)
from kaidan.campaign.plans import as_stored, plan_from
from kaidan.campaign.trials import physics_version
from kaidan.errors import InputError
from kaidan.physics import SprungNoses, TrialSpec, run

OF_ITS_OWN = {"host", "wall_time_s"}
"""Columns that are not the same every time."""


def plan(**fields):
    conditions = [
        Condition(nosing_spacing=0.15, angle=math.radians(angle)) for angle in (55.0, 70.0)
    ]
    return VerificationTest(
        **{"robot": physics_cases.robot(), "conditions": conditions, "trials": 2} | fields
    )


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
        assert row["angle_deg"] == pytest.approx(math.degrees(spec.stairs.angle), abs=1e-9)
        assert row["nosing_spacing_m"] == pytest.approx(0.15, abs=1e-12)
        assert row["mass_kg"] == result.mass
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
    assert (spec.direction, spec.facing) == ("down", "tail-first")


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
        axes=(("track.stiffness", (1e4, 2e4)), ("friction", (1.0, 2.0, 3.0))),
        trials=4,
    )
    specs = list(grid.specs())
    assert len(specs) == len(grid) == 24
    assert [spec.track.stiffness for spec in specs[::12]] == [1e4, 2e4]
    assert len({TRIALS.identity(spec) for spec in specs}) == 24
    assert plan_from(json.loads(json.dumps(as_stored(grid)))) == grid, "a store can keep it"


def test_grid_refusals():
    base = physics_cases.spec(55.0)
    with pytest.raises(InputError) as caught:
        Grid(base=base, axes=(("track.shoes", (30,)),))
    assert str(caught.value) == "grid: 'track.shoes' is no field of a trial; known there: kind"
    with pytest.raises(InputError) as caught:
        Grid(base=base, axes=(("friction", ()),))
    assert str(caught.value) == "grid: friction has no value"


def test_missing_mujoco_is_told_before_anything_is_begun(tmp_path, monkeypatch):
    from importlib.metadata import PackageNotFoundError

    def nowhere(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr("kaidan.campaign.trials.version", nowhere)
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
