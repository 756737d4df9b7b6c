"""Trials: what they tell, and that they tell it twice."""

import math
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import jsonschema
import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from amounts import fast_and_slow
from kaidan.errors import InputError
from kaidan.modes import Phase
from kaidan.physics import (
    DrivenGrousers,
    Outcome,
    ShoeChain,
    SprungNoses,
    TrialResult,
    TrialSpec,
    YieldingBelt,
    record,
    run,
)
from kaidan.physics.belt_speed import Belt
from kaidan.physics.initial_pose import course_of
from kaidan.physics.simulation import Simulation
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from physics_cases import robot, spec

WEIGHT = 20.0 * 9.80665


def plain(result):
    return {key: value for key, value in result.to_dict().items() if key != "wall_time_s"}


def test_it_climbs_and_its_forces_balance_its_weight():
    log = record(spec(50.0))
    result = log.result
    assert result.outcome is Outcome.CLIMBED
    assert result.nosings_passed == 2
    assert (result.phase, result.step) == (None, None)
    assert not result.fell
    columns, theta = log.columns, math.radians(50.0)
    # smooth driving at constant speed: 0.5 % for the blows of a nosing that comes or goes
    assert np.median(columns["traction_N"]) == pytest.approx(WEIGHT * math.sin(theta), rel=5e-3)
    along, normal = np.median(log.forces.sum(axis=1), axis=0)
    assert along == pytest.approx(WEIGHT * math.sin(theta), rel=5e-3)
    assert normal == pytest.approx(WEIGHT * math.cos(theta), rel=5e-3)
    assert np.median(columns["power_W"]) == pytest.approx(0.1 * WEIGHT * math.sin(theta), rel=5e-3)
    assert np.median(columns["torque_Nm"]) == pytest.approx(
        0.06 * WEIGHT * math.sin(theta), rel=5e-3
    )
    assert abs(result.slip_m) < 1e-3
    assert len(log) == len(columns["time_s"]) == len(log.poses)
    assert log.table().keys() > columns.keys()


@pytest.mark.parametrize(
    "track", [SprungNoses(stiffness=3e4), DrivenGrousers(), ShoeChain()], ids=lambda each: each.kind
)
def test_other_tracks_pull_as_much(track):
    log = record(spec(40.0, track=track))
    driven = log.columns["traction_N"][log.columns["time_s"] > 0.5]
    # 2 %: springs and grousers rock about it
    assert driven.mean() == pytest.approx(WEIGHT * math.sin(math.radians(40.0)), rel=0.02)


def test_it_falls_over_its_tail_and_says_where():
    result = run(spec(68.0))
    assert result.outcome is Outcome.FELL_BACKWARD
    assert result.fell
    assert result.nosings_passed == 1
    # it begins with its tail before nosing 2, its front end 0.47/0.15 spacings ahead
    assert (result.phase, result.step) == (Phase.TRAVERSE, 4)
    assert result.largest_extra_deg > 45.0


def test_tail_first_it_falls_over_its_nose():
    result = run(spec(50.0, facing="tail-first"))
    assert result.outcome is Outcome.FELL_FORWARD


def test_going_down_nose_first_it_falls_over_its_nose():
    assert run(spec(62.0, direction="down")).outcome is Outcome.FELL_FORWARD
    assert run(spec(20.0, direction="down")).outcome is Outcome.CLIMBED


def test_too_smooth_it_slides():
    # little steeper than atan(0.8) = 38.7 deg, so that it stays in its place while it settles
    result = run(spec(38.9, friction=0.8))
    assert result.outcome is Outcome.SLID
    assert result.slip_m > 0.15


def test_what_hops_on_the_spot_has_stalled_where_friction_would_hold_it():
    belt = YieldingBelt(stiffness=4.8e4, shear_ratio=1.1, damping_ratio=0.05)
    fields = {"radius": 0.011, "track": belt, "start_offset": None}
    stalls = run(spec(60.0, friction=3.0, **fields))  # atan(3) = 71.6 deg
    assert (stalls.outcome, stalls.phase) == (Outcome.STALLED, Phase.TRAVERSE)
    assert run(spec(56.0, friction=1.4, **fields)).outcome is Outcome.SLID  # 54.5 deg


@pytest.mark.parametrize("direction", ["up", "down"])
def test_what_leaves_its_place_while_it_settles_has_slid_and_not_climbed(direction):
    result = run(spec(50.0, friction=0.8, direction=direction, facing="tail-first"))
    assert result.outcome is Outcome.SLID
    assert (result.nosings_passed, result.time_s) == (0, 0.0)


def test_too_smooth_it_runs_away_downhill():
    result = run(spec(22.5, direction="down", facing="tail-first", friction=0.4))
    assert result.outcome is Outcome.SLID
    assert result.slip_m < -0.07


def test_a_rotation_on_the_path_is_no_sliding():
    # it rotates by 14 degrees at each nosing, and loses 0.15 m each time
    question = Question.in_one_posture("superdroid-hd2", "ibc", friction=1.0, speed=0.3)
    trial = TrialSpec(question=question, nosings=4)
    assert run(trial).outcome is Outcome.CLIMBED


def test_where_it_cannot_stand_it_falls_at_the_start():
    assert run(spec(80.0, start_offset=0.95)).outcome is Outcome.START_FALL


def test_what_takes_too_long_is_timed_out(monkeypatch):
    from kaidan.physics import trial

    monkeypatch.setattr(trial, "PATIENCE", 0.1)
    monkeypatch.setattr(trial, "GRACE", 0.0)
    assert run(spec(50.0)).outcome is Outcome.TIMED_OUT


def test_a_simulation_that_diverges_is_an_outcome(monkeypatch):
    before = Simulation.drive

    def burst(self, time, steps, on):
        before(self, time, steps, on)
        if on:
            self.data.qvel[0] = math.nan

    monkeypatch.setattr(Simulation, "drive", burst)
    result = run(spec(50.0))
    assert result.outcome is Outcome.UNSTABLE
    assert TrialResult.from_json(result.to_json()) == result


@pytest.mark.parametrize(
    "track",
    [None, SprungNoses(stiffness=3e4), *fast_and_slow(DrivenGrousers(), ShoeChain())],
    ids=str,
)
def test_the_same_seed_gives_the_same_result(track):
    fields = {"start_offset": None, "nosings": 1} | ({"track": track} if track else {})
    one, two = (run(spec(50.0, seed=5, **fields)) for _ in range(2))
    assert plain(one) == plain(two)
    five, six = (spec(50.0, seed=seed, **fields).drawn()[0] for seed in (5, 6))
    assert one.start_offset == five != six


def test_another_process_comes_to_the_same_result():
    trial = spec(55.0, nosings=1, track=SprungNoses(stiffness=3e4), seed=9)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        there = pool.submit(run, trial).result()
    assert plain(there) == plain(run(trial))


def test_a_result_can_be_pickled_and_written_as_json():
    log = record(spec(50.0, nosings=1))
    again = pickle.loads(pickle.dumps(log))
    assert again.result == log.result
    assert np.array_equal(again.poses, log.poses)
    result = log.result
    assert TrialResult.from_json(result.to_json()) == result
    jsonschema.validate(result.to_dict(), TrialResult.json_schema())
    assert set(result.versions) == {"kaidan", "mujoco"}
    used = (result.friction, result.stiffness_N_m, result.timestep_s, result.contact_time_s)
    assert used == (3.0, None, 1e-3, 2e-3)


def test_a_trial_leaves_no_file_behind(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run(spec(50.0, nosings=1, track=ShoeChain(), timestep=5e-3))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("acceleration", [-0.4, 0.0, 0.4])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_the_belt_keeps_to_the_acceleration_asked_for(acceleration, direction):
    trial = spec(40.0, acceleration=acceleration, direction=direction)
    belt = Belt(trial, course_of(trial), at_once=True)
    along = acceleration if direction == "up" else -acceleration
    times = np.linspace(0.0, 0.5, 21)
    speeds = np.array([belt.speed(time) for time in times])
    assert np.diff(speeds) / np.diff(times) == pytest.approx(np.full(20, along), abs=1e-9)
    assert speeds.min() >= 0.1 - 1e-12, "the speed stated is the lowest"
    run_so_far = np.array([belt.run(time) for time in times])
    middle = (speeds[1:] + speeds[:-1]) / 2
    assert np.diff(run_so_far) == pytest.approx(middle * np.diff(times), rel=1e-9)
    assert belt.run(belt.duration(0.3)) == pytest.approx(0.3)


def test_acceleration_needs_its_own_traction():
    fields = {"acceleration": 0.5, "nosings": 1}
    theta = math.radians(40.0)
    log = record(spec(40.0, **fields))
    # 1 %: nosings come and go
    assert np.median(log.columns["traction_N"]) == pytest.approx(
        20.0 * (9.80665 * math.sin(theta) + 0.5), rel=1e-2
    )


def test_from_landing_to_landing():
    stairs = Stairs(rise=0.1, going=0.2, steps=4)
    for direction in ("up", "down"):
        question = Question.in_one_posture(robot(), stairs, direction=direction, friction=1.0)
        result = run(TrialSpec(question=question, begin="landing"))
        assert result.outcome is Outcome.CLIMBED, direction


def test_several_flights_from_landing_to_landing():
    stairs = Stairs(rise=0.1, going=0.2, steps=3, upper_landing=1.2)
    question = Question.in_one_posture(robot(), (stairs, stairs), friction=1.0)
    assert run(TrialSpec(question=question, begin="landing")).outcome is Outcome.CLIMBED


def test_where_it_fails_is_told_by_phase_and_step():
    question = Question.in_one_posture("absolem", "ibc", friction=1.0)
    result = run(TrialSpec(question=question, begin="landing"))
    assert result.outcome is Outcome.FELL_BACKWARD
    assert (result.phase, result.step) == (Phase.ENTER, 1)


def test_flippers_decide():
    stairs = Stairs(rise=0.178, going=0.279)
    flat, stowed = (
        Question.in_one_posture("absolem", stairs, friction=1.0, speed=0.4, flippers=flippers)
        for flippers in ("flat", "stowed")
    )
    assert run(TrialSpec(question=flat)).outcome is Outcome.CLIMBED
    assert run(TrialSpec(question=stowed)).outcome is not Outcome.CLIMBED


def test_what_takes_too_long_to_simulate_is_refused():
    long = Question.in_one_posture(robot(), Stairs(rise=0.1, going=0.2, steps=400), speed=0.01)
    with pytest.raises(InputError) as refused:
        run(TrialSpec(question=long, begin="landing"))
    assert str(refused.value) == "trial: it takes 2.5 h at 0.01 m/s; at most 1 h is simulated"


def test_a_terrain_of_too_many_boxes_is_refused():
    x = np.linspace(0.0, 6.0, 6001)
    rough = np.floor(x / 0.3) * 0.15 + 1e-3 * np.sin(7000 * x)
    question = Question.in_one_posture(robot(), Profile.of_points(np.column_stack([x, rough])))
    with pytest.raises(InputError, match="boxes, more than 5000: cut or thin it"):
        run(TrialSpec(question=question, begin="landing"))


def test_in_space_straight_ahead_it_is_as_in_the_plane():
    sheet = robot(gauge=0.3, width=0.08)
    space = [run(spec(angle, robot=sheet, dimensions=3)).outcome for angle in (62.4, 64.5)]
    assert space == [Outcome.CLIMBED, Outcome.FELL_BACKWARD]


def test_in_space_a_centroid_to_the_left_loads_the_left_track():
    sheet = robot(gauge=0.3, width=0.08)
    log = record(spec(30.0, robot=sheet, dimensions=3, lateral_offset=0.1))
    assert log.result.outcome is Outcome.CLIMBED
    assert abs(log.columns["roll_deg"]).max() < 0.5
    assert {"y_m", "yaw_deg", "roll_deg"} <= log.columns.keys()


def test_in_space_it_climbs_obliquely():
    sheet = robot(gauge=0.3, width=0.08)
    log = record(spec(30.0, robot=sheet, dimensions=3, yaw=0.15))
    assert log.result.outcome is Outcome.CLIMBED
    assert log.columns["y_m"][-1] > 0.02, "to the left"
