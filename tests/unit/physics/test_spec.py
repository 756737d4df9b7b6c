import pickle

import pytest

from kaidan.errors import InputError
from kaidan.physics import DrivenGrousers, ShoeChain, SmoothBelt, SprungNoses, TrialSpec
from kaidan.robot import Robot
from kaidan.terrain.profile import Profile
from physics_cases import robot, spec

FLOOR = Profile.of_points([(0.0, 0.0), (1.0, 0.0)])


def test_a_trial_is_the_same_after_json_and_pickle():
    trial = spec(50.0, track=SprungNoses(stiffness=3e4), seed=7)
    assert TrialSpec.model_validate_json(trial.model_dump_json()) == trial
    scanned = spec(50.0, terrain=Profile.of_points(trial.question.profile.points))
    assert TrialSpec.model_validate_json(scanned.model_dump_json()) == scanned
    assert pickle.loads(pickle.dumps(trial)) == trial


def test_a_spec_needs_no_mujoco():
    import subprocess
    import sys

    code = (
        "import sys; from kaidan.physics import TrialSpec; import kaidan; "
        "kaidan.assess('kenaf', 'ibc'); print('mujoco' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_without_mujoco_the_text_says_how_to_install_it(monkeypatch):
    import sys

    from kaidan.physics import engine

    monkeypatch.setitem(sys.modules, "mujoco", None)
    engine.engine.cache_clear()
    with pytest.raises(ImportError) as caught:
        engine.engine()
    engine.engine.cache_clear()
    assert str(caught.value) == (
        "the physics model needs an optional package: pip install 'kaidan[physics]'"
    )


def test_an_old_mujoco_is_told_apart(monkeypatch):
    import sys
    from types import SimpleNamespace

    from kaidan.physics import engine

    monkeypatch.setitem(sys.modules, "mujoco", SimpleNamespace(__version__="3.2.0"))
    engine.engine.cache_clear()
    with pytest.raises(ImportError, match=r"MuJoCo 3\.2\.0 \(older than 3\.13\)"):
        engine.engine()
    engine.engine.cache_clear()


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        (
            {"track": SprungNoses()},
            "trial: sprung-noses needs a stiffness; the track of 'kenaf-like' states none",
        ),
        (
            {"dimensions": 3, "track": DrivenGrousers()},
            "trial: driven-grousers is modelled in the plane; give dimensions = 2",
        ),
        (
            {"dimensions": 3},
            "trial: dimensions = 3 needs gauge and width of the tracks; 'kenaf-like' does not "
            "state both",
        ),
        (
            {"robot": robot(gauge=0.3), "yaw": 0.1},
            "trial: yaw and lateral_offset need dimensions = 3",
        ),
        (
            {"robot": robot(gauge=0.3, width=0.08), "yaw": 1.0, "dimensions": 3},
            "trial: yaw = 1 rad is not within -0.8 to 0.8 rad",
        ),
        (
            {"ground": "noses", "begin": "landing"},
            "trial: a rig of nosings alone has no landing to begin on",
        ),
        ({"terrain": FLOOR}, "trial: the terrain has fewer than two nosings"),
        (
            {"terrain": ("ibc", "ibc")},
            "trial: several flights are driven from the landing; give begin = landing",
        ),
        ({"speed": 20.0}, "trial: speed = 20 m/s is not within 0.001 to 5 m/s"),
        ({"speed": 0.0}, "trial: speed = 0 m/s is not within 0.001 to 5 m/s"),
        (
            {"robot": Robot.named("ozbot-atr"), "track": ShoeChain()},
            "trial: shoe-chain needs ends of one radius; 'ozbot-atr' has 0.14 and 0.11 m",
        ),
        (
            {"robot": robot(0.005), "track": ShoeChain()},
            "trial: shoe-chain needs ends of at least 10 mm; 'kenaf-like' has 0.005 and 0.005 m",
        ),
        (
            {"robot": Robot.named("absolem"), "track": ShoeChain()},
            "trial: shoe-chain is modelled without flippers and belly",
        ),
    ],
    ids=lambda value: "" if isinstance(value, str) else ",".join(value),
)
def test_what_has_no_meaning_is_refused(fields, text):
    with pytest.raises(InputError) as caught:
        spec(50.0, **fields)
    assert str(caught.value) == text


def test_the_start_is_drawn_from_the_seed_or_as_stated():
    free = spec(50.0, start_offset=None, seed=3)
    assert free.drawn() == spec(40.0, start_offset=None, seed=3).drawn()
    assert free.drawn() != spec(50.0, start_offset=None, seed=4).drawn()
    assert 0.1 <= free.drawn()[0] <= 0.5
    assert spec(50.0, start_offset=0.25, grouser_phase=0.5).drawn() == (0.25, 0.5, 0.5)


def test_stiffness_is_the_tracks_unless_the_trial_states_one():
    sheet = robot(stiffness=2e4)
    assert spec(50.0, robot=sheet, track=SprungNoses()).stiffness == 2e4
    assert spec(50.0, robot=sheet, track=SprungNoses(stiffness=1e4)).stiffness == 1e4
    assert spec(50.0, robot=sheet, track=SmoothBelt()).stiffness is None


def test_mass_that_nobody_published_is_assumed_and_said_so():
    assert spec(50.0, robot=Robot.named("kenaf")).mass() == (20.0, True)
    assert spec(50.0).mass() == (20.0, False)
    assert spec(50.0, robot=Robot.named("absolem")).mass() == (38.7, False)


def test_friction_isolates_tipping_unless_stated_or_held_by_grousers():
    assert spec(50.0).static_friction == 3.0
    assert spec(50.0, track=DrivenGrousers()).static_friction == 0.8
    assert spec(50.0, track=DrivenGrousers(), friction=1.2).static_friction == 1.2


def test_of_a_range_of_friction_the_low_end_counts():
    assert spec(50.0, friction=(0.6, 1.0)).static_friction == 0.6


def test_what_plays_no_part_in_a_trial_makes_no_other_trial():
    asked = spec(50.0, theta_d=0.02, theta_M=(0.0, 0.01), risk=0.05)
    assert asked == spec(50.0)
    assert asked.model_dump_json() == spec(50.0, model="closed-form").model_dump_json()


def test_a_falling_profile_is_driven_down():
    falling = Profile.of_points([(-1, 0.4), (0, 0.4), (0, 0.2), (0.3, 0.2), (0.3, 0), (1.3, 0)])
    with pytest.raises(InputError, match="drive it down"):
        spec(40.0, terrain=falling)


def test_trials_can_be_compared_whatever_they_have_worked_out():
    one, other = spec(50.0), spec(50.0)
    assert one.outline().reach == other.outline().reach
    assert one == other
    assert one != spec(50.0, seed=1)
