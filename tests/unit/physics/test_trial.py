"""Trials: what they tell, and that they tell it twice."""

import json
import math
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from kaidan.physics import DrivenGrousers, Outcome, ShoeChain, SprungNoses, TrialSpec, model_of, run
from kaidan.physics.pace import Belt
from kaidan.physics.trial import Simulation
from kaidan.robot import Posture, Robot
from kaidan.stairs import Stairs
from physics_cases import robot, spec

WEIGHT = 20.0 * 9.80665


def plain(result):
    return {key: value for key, value in result.as_dict().items() if key != "wall_time"}


def test_it_climbs_and_its_forces_balance_its_weight():
    result = run(spec(50.0), log=True)
    assert result.outcome is Outcome.CLIMBED
    assert result.releases == 2
    assert result.release is None
    assert not result.fell
    columns, theta = result.log.columns, math.radians(50.0)
    # smooth driving at constant speed: 0.5 % for the blows of a nosing that comes or goes
    assert np.median(columns["traction_N"]) == pytest.approx(WEIGHT * math.sin(theta), rel=5e-3)
    along, normal = np.median(result.log.forces.sum(axis=1), axis=0)
    assert along == pytest.approx(WEIGHT * math.sin(theta), rel=5e-3)
    assert normal == pytest.approx(WEIGHT * math.cos(theta), rel=5e-3)
    assert np.median(columns["power_W"]) == pytest.approx(0.1 * WEIGHT * math.sin(theta), rel=5e-3)
    assert np.median(columns["torque_Nm"]) == pytest.approx(
        0.06 * WEIGHT * math.sin(theta), rel=5e-3
    )
    assert abs(result.slip) < 1e-3
    assert len(result.log) == len(columns["time_s"]) == len(result.log.poses)
    assert result.log.table().keys() > columns.keys()


@pytest.mark.parametrize(
    "track", [SprungNoses(stiffness=3e4), DrivenGrousers(), ShoeChain()], ids=lambda each: each.kind
)
def test_other_tracks_pull_as_much(track):
    log = run(spec(40.0, track=track), log=True).log
    driven = log.columns["traction_N"][log.columns["time_s"] > 0.5]
    # 2 %: springs and grousers swing about it
    assert driven.mean() == pytest.approx(WEIGHT * math.sin(math.radians(40.0)), rel=0.02)


def test_it_falls_over_its_tail_and_says_where():
    result = run(spec(68.0), log=True)
    assert result.outcome is Outcome.FELL_BACKWARD
    assert result.fell
    assert result.release == 1
    assert result.largest_extra_deg > 45.0


def test_tail_first_it_falls_over_its_nose():
    result = run(spec(50.0, facing="tail-first"))
    assert result.outcome is Outcome.FELL_FORWARD


def test_going_down_nose_first_it_falls_over_its_nose():
    assert run(spec(62.0, direction="down")).outcome is Outcome.FELL_FORWARD
    assert run(spec(20.0, direction="down")).outcome is Outcome.CLIMBED


def test_too_smooth_it_slides():
    result = run(spec(50.0, friction=0.8))
    assert result.outcome is Outcome.SLID
    assert result.slip > 0.15


def test_too_smooth_it_runs_away_downhill():
    result = run(spec(30.0, direction="down", facing="tail-first", friction=0.4))
    assert result.outcome is Outcome.SLID
    assert result.slip < -0.07


def test_a_swing_on_the_way_is_no_sliding():
    # it swings by 14 degrees at each nosing, and loses 0.15 m each time
    stairs = Stairs.named("ibc")
    trial = TrialSpec(
        robot=Robot.named("superdroid-hd2"), stairs=stairs, friction=1.0, speed=0.3, releases=4
    )
    assert run(trial).outcome is Outcome.CLIMBED


def test_where_it_cannot_stand_it_falls_at_the_start():
    assert run(spec(80.0, start_offset=0.95)).outcome is Outcome.START_FALL


def test_what_takes_too_long_is_timed_out(monkeypatch):
    from kaidan.physics import trial

    monkeypatch.setattr(trial, "PATIENCE", 0.1)
    monkeypatch.setattr(trial, "GRACE", 0.0)
    assert run(spec(50.0)).outcome is Outcome.TIMED_OUT


def test_a_simulation_that_diverges_is_an_outcome(monkeypatch):
    from kaidan.physics import trial

    before = Simulation.drive

    def burst(self, time, steps, on):
        before(self, time, steps, on)
        if on:
            self.data.qvel[0] = math.nan

    monkeypatch.setattr(trial.Simulation, "drive", burst)
    result = run(spec(50.0))
    assert result.outcome is Outcome.UNSTABLE
    assert json.dumps(result.as_dict(), allow_nan=False)


@pytest.mark.parametrize(
    "track", [None, SprungNoses(stiffness=3e4), DrivenGrousers(), ShoeChain()], ids=str
)
def test_the_same_seed_gives_the_same_result(track):
    fields = {"start_offset": None, "releases": 1} | ({"track": track} if track else {})
    one, two = (run(spec(50.0, seed=5, **fields)) for _ in range(2))
    assert plain(one) == plain(two)
    other = run(spec(50.0, seed=6, **fields))
    assert other.start_offset != one.start_offset


def test_another_process_comes_to_the_same_result():
    trial = spec(55.0, releases=1, track=SprungNoses(stiffness=3e4), seed=9)
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        there = pool.submit(run, trial).result()
    assert plain(there) == plain(run(trial))


def test_a_result_can_be_pickled_and_written_as_json():
    result = run(spec(50.0, releases=1), log=True)
    again = pickle.loads(pickle.dumps(result))
    assert again.as_dict() == result.as_dict()
    assert np.array_equal(again.log.poses, result.log.poses)
    told = json.loads(json.dumps(result.as_dict(), allow_nan=False))
    assert TrialSpec.model_validate(told["spec"]) == result.spec
    assert set(told["versions"]) == {"kaidan", "mujoco"}
    used = {key: told[key] for key in ("friction", "stiffness", "timestep", "contact_time")}
    assert used == {"friction": 3.0, "stiffness": None, "timestep": 1e-3, "contact_time": 2e-3}


def test_a_trial_leaves_no_file_behind(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run(spec(50.0, releases=1, track=ShoeChain(), timestep=5e-3))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("acceleration", [-0.4, 0.0, 0.4])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_the_belt_keeps_to_the_acceleration_asked_for(acceleration, direction):
    belt = Belt(model_of(spec(40.0, acceleration=acceleration, direction=direction)))
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
    fields = {"acceleration": 0.5, "releases": 1}
    theta = math.radians(40.0)
    result = run(spec(40.0, **fields), log=True)
    # 1 %: nosings come and go
    assert np.median(result.log.columns["traction_N"]) == pytest.approx(
        20.0 * (9.80665 * math.sin(theta) + 0.5), rel=1e-2
    )


def test_the_whole_way_from_landing_to_landing():
    stairs = Stairs(rise=0.1, going=0.2, steps=4)
    for direction in ("up", "down"):
        result = run(
            TrialSpec(
                robot=robot(), stairs=stairs, begin="landing", direction=direction, friction=1.0
            )
        )
        assert result.outcome is Outcome.CLIMBED, direction


def test_flippers_decide():
    stairs = Stairs(rise=0.178, going=0.279)
    flat = Posture(front="flat", rear="flat")
    fields = {"robot": Robot.named("absolem"), "stairs": stairs, "friction": 1.0, "speed": 0.4}
    assert run(TrialSpec(**fields, posture=flat)).outcome is Outcome.CLIMBED
    assert run(TrialSpec(**fields)).outcome is not Outcome.CLIMBED


def test_in_space_straight_ahead_it_is_as_in_the_plane():
    sheet = robot(gauge=0.3, width=0.08)
    space = [run(spec(angle, robot=sheet, dimensions=3)).outcome for angle in (62.4, 64.5)]
    assert space == [Outcome.CLIMBED, Outcome.FELL_BACKWARD]


def test_in_space_a_centroid_to_the_left_loads_the_left_track():
    sheet = robot(gauge=0.3, width=0.08)
    result = run(spec(30.0, robot=sheet, dimensions=3, lateral_offset=0.1), log=True)
    assert result.outcome is Outcome.CLIMBED
    assert abs(result.log.columns["roll_deg"]).max() < 0.5
    assert {"y_m", "yaw_deg", "roll_deg"} <= result.log.columns.keys()


def test_in_space_it_climbs_obliquely():
    sheet = robot(gauge=0.3, width=0.08)
    result = run(spec(30.0, robot=sheet, dimensions=3, yaw=0.15), log=True)
    assert result.outcome is Outcome.CLIMBED
    assert result.log.columns["y_m"][-1] > 0.02, "to the left"
