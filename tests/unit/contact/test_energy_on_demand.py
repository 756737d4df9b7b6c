"""The energy margin along the flow at single poses, and at all of them."""

import numpy as np
import pytest

from contact_cases import random_robot, steps
from kaidan import contact
from kaidan.contact import ROCKING
from kaidan.contact.kernel.energy_margins import least_flow_energy
from kaidan.contact.kernel.reserves import barrier
from kaidan.contact.layout import Release
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse
from kernel_memory import called, scene

RNG = np.random.default_rng(7)


def run_of(seed, **how):
    rng = np.random.default_rng(seed)
    parts, kinds = random_robot(rng)
    terrain = steps(rng.uniform(0.05, 0.2), rng.uniform(0.15, 0.4), 5)
    return contact.traverse(terrain, parts, -1.0, 1.2, kinds=kinds, **how)


def energy_of(margins):
    return margins.energy, margins.energy_side


@pytest.mark.parametrize("seed", range(12))
def test_energy_equals_the_full_table(seed):
    """Bit by bit: the same function on the same poses, whichever are asked and in which order."""
    whole, bare = run_of(seed), run_of(seed, with_energy=False)
    assert np.isfinite(whole.margins.energy).all()
    assert np.isnan([bare.margins.energy, bare.margins.energy_side]).all()
    assert not bare.margins.bounded.any()
    for name in set(whole.margins.table.dtype.names) - {"energy", "energy_side", "bounded"}:
        np.testing.assert_array_equal(whole.margins.table[name], bare.margins.table[name])
    some = RNG.permutation(len(bare.poses))[:20]
    np.testing.assert_array_equal(bare.energy(some), energy_of(whole.margins[some]))
    np.testing.assert_array_equal(bare.margins.bounded[some], whole.margins.bounded[some])
    others = np.setdiff1d(np.arange(len(bare.poses)), some)
    assert np.isnan(bare.margins.energy[others]).all(), "only what was asked is worked out"
    np.testing.assert_array_equal(bare.energy(some), whole.energy(some))  # asked again
    np.testing.assert_array_equal(bare.energy(np.arange(len(bare.poses))), energy_of(whole.margins))
    assert [each.shape for each in bare.energy(3)] == [(1,), (1,)]


def test_energy_is_never_less_than_the_pivots():
    """Rolling and new contacts lie farther out than a point that stays; the search relies on it."""
    for seed in range(30):
        margins = run_of(seed).margins
        back, front = np.abs(margins.back_rise), np.abs(margins.front_rise)
        side = np.where(margins.energy_side == 1.0, back, front)
        assert set(np.unique(margins.energy_side)) <= {-1.0, 1.0}
        bounded = margins.bounded
        assert (margins.energy[bounded] >= side[bounded] - 1e-9).all()  # m, rounding


def test_energy_is_the_smaller_of_both_sides():
    """Each side's about its own outer contact."""
    second = 0
    for seed in range(30):
        run = run_of(seed)
        margins, tables = run.margins, scene(run.ground.table, run.body.table)
        for row in range(0, len(run.poses), 7):
            place = run.poses.placement(row)
            rises = []
            for pivot, side in zip(margins.outermost[row].tolist(), (1.0, -1.0), strict=True):
                release = Release(*place, side, float(margins.tilt[row]))
                _, rise, _ = barrier(tables, pivot, release, ROCKING)
                rises.append(rise)
            assert margins.energy[row] == pytest.approx(min(rises), abs=1e-12)
            back, front = abs(margins.back_rise[row]), abs(margins.front_rise[row])
            second += back <= front < rises[0] and rises[1] < rises[0]
    assert second > 3, "the front is looked at second, and falls first"


def test_energy_needs_margins():
    with pytest.raises(ValueError, match="energy needs with_margins=True"):
        run_of(0, with_margins=False).energy([0])


def random_traverse(rng):
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
    profile, outline, how = random_traverse(np.random.default_rng(3000 + seed))
    bare = traverse(profile, outline, **how)
    whole = traverse(profile, outline, with_energy=True, **how)
    assert bare.phases == whole.phases
    assert bare.status is whole.status
    assert np.isfinite(whole.path.margins.energy).all()
    if len(bare.path.poses) > 200:
        assert np.isnan(bare.path.margins.energy).any(), "by bound, not at every pose"


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("low", [0.1, 1.0])
@pytest.mark.parametrize("seed", range(6))
def test_the_least_energy_is_worked_out_only_where_it_may_be(seed, low, side):
    """The least over all poses; unknown stays what needs more about its pivot alone."""
    whole, bare = run_of(seed), run_of(seed, with_energy=False)
    rows = np.arange(3, len(whole.poses), 2)
    weights = np.random.default_rng(seed).uniform(low, 1.0, len(whole.poses))
    pivot = (weights * (whole.margins.back_rise if side > 0 else whole.margins.front_rise))[rows]
    needed = np.maximum((weights * whole.margins.energy)[rows], pivot)
    least, row = called(least_flow_energy)(
        bare.scene, bare.poses.table, bare.margins.table, rows, side, weights, 1e-9
    )
    assert least == needed.min()
    assert row == rows[np.flatnonzero(needed <= least + 1e-9)[0]]
    known = ~np.isnan(bare.margins.energy)
    assert not known[np.setdiff1d(range(len(known)), rows)].any()
    # in the order of the pivots' rises, each below the least of those before it
    order = np.argsort(pivot, kind="stable")
    before = np.minimum.accumulate(np.r_[np.inf, needed[order]])[:-1]
    assert known[rows[order]].tolist() == (pivot[order] < before + 1e-9).tolist()
    assert known.sum() < len(rows)
