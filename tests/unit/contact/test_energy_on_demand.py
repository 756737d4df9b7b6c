"""The energy margin along the flow at single poses, and at all of them."""

import numpy as np
import pytest

from contact_cases import random_robot, steps
from kaidan.climb import climb
from kaidan.contact import traverse
from kaidan.outline import Outline
from kaidan.profile import Profile
from kaidan.robot import Posture, Robot, Track
from kaidan.stairs import Stairs

pytestmark = pytest.mark.usefixtures("compiled_kernel")

RNG = np.random.default_rng(7)


def run_of(seed, **how):
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng)
    terrain = steps(rng.uniform(0.05, 0.2), rng.uniform(0.15, 0.4), 5)
    return traverse(terrain, parts, -1.0, 1.2, kinds=kinds, compile_kernel=True, **how)


@pytest.mark.parametrize("seed", range(12))
def test_energy_equals_the_full_table(seed):
    """Bit by bit: the same function on the same poses, whichever are asked and in which order."""
    whole, bare = run_of(seed), run_of(seed, with_energy=False)
    assert np.isfinite(whole.margins[:, 10]).all()
    assert np.isnan(bare.margins[:, [10, 11]]).all()
    assert (bare.margins[:, 18] == 0).all()
    rest = [k for k in range(21) if k not in (10, 11, 18)]
    np.testing.assert_array_equal(whole.margins[:, rest], bare.margins[:, rest])
    some = RNG.permutation(len(bare.poses))[:20]
    np.testing.assert_array_equal(bare.energy(some), whole.margins[some, 10:12])
    np.testing.assert_array_equal(bare.margins[some, 18], whole.margins[some, 18])
    others = np.setdiff1d(np.arange(len(bare.poses)), some)
    assert np.isnan(bare.margins[others, 10]).all(), "only what was asked is worked out"
    np.testing.assert_array_equal(bare.energy(some), whole.energy(some))  # asked again
    np.testing.assert_array_equal(bare.energy(np.arange(len(bare.poses))), whole.margins[:, 10:12])
    assert bare.energy(3).shape == (1, 2)


def test_energy_is_never_less_than_the_pivots():
    """Rolling and new contacts lie farther out than a point that stays; the search relies on it."""
    for seed in range(30):
        margins = run_of(seed).margins
        back, front = np.abs(margins[:, 8]), np.abs(margins[:, 9])
        side = np.where(margins[:, 11] == 1.0, back, front)
        assert set(np.unique(margins[:, 11])) <= {-1.0, 1.0}
        bounded = margins[:, 18] == 1.0
        assert (margins[bounded, 10] >= side[bounded] - 1e-9).all()  # m, rounding


def test_energy_needs_margins():
    with pytest.raises(ValueError, match="energy needs with_margins=True"):
        run_of(0, with_margins=False).energy([0])


def random_climb(rng):
    """A robot, sometimes with flippers, on a random flight."""
    if rng.random() < 0.5:
        robot = Robot.named("absolem")
        posture = Posture(front=rng.uniform(-0.5, 1.2), rear=rng.uniform(-0.5, 1.2))
    else:
        L, posture = rng.uniform(0.4, 1.2), Posture()
        radius = rng.uniform(0.04, 0.12)
        robot = Robot(
            name="any",
            com_from_front=L * rng.uniform(0.35, 0.65),
            com_height=L * rng.uniform(0.08, 0.25),
            track=Track(flat_length=L, front_radius=radius, rear_radius=radius),
        )
    stairs = Stairs(
        rise=rng.uniform(0.08, 0.2), going=rng.uniform(0.2, 0.35), steps=int(rng.integers(3, 9))
    )
    how = {
        "descending": bool(rng.random() < 0.4),
        "facing": ("nose-first", "tail-first")[int(rng.random() < 0.4)],
        "acceleration": rng.uniform(-0.5, 0.5) if rng.random() < 0.5 else 0.0,
    }
    return Profile.of_stairs(stairs), Outline.of(robot, posture), how


@pytest.mark.parametrize("seed", range(30))
def test_phases_are_the_same_with_every_energy_worked_out(seed):
    """The least energy of a phase, found by bound, is the least of all poses."""
    profile, outline, how = random_climb(np.random.default_rng(3000 + seed))
    bare = climb(profile, outline, **how)
    whole = climb(profile, outline, with_energy=True, **how)
    assert bare.phases == whole.phases
    assert bare.status is whole.status
    assert np.isfinite(whole.run.margins[:, 10]).all()
    if len(bare.run.poses) > 200:
        assert np.isnan(bare.run.margins[:, 10]).any(), "by bound, not at every pose"
