"""What a batch keeps of a traverse: the largest and the smallest of tables written by hand."""

import math

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import (
    Job,
    PartKind,
    Status,
    body_table,
    ground_table,
    traverse,
    traverse_many,
)
from kaidan.contact import layout as at
from kaidan.contact.kernel.batch import extremes, settle_many, worst_margins


def table(columns, width, *rows):
    """Rows with some columns filled; beyond those that count a row that would be the most."""
    made = np.zeros((len(rows), width))
    for k, row in enumerate(rows):
        made[k, columns] = row
    return made


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_inclinations_of_poses_and_ends_of_rotations(sign):
    poses = table([at.POSE_PHI], at.POSE_COLUMNS, 0.2 * sign, 0.4 * sign, 0.3 * sign, 9.0)
    columns = [at.END_PHI, at.ROTATION_ANGLE, at.TOPPLES]
    ends = table(columns, at.ROTATION_COLUMNS, (0.5, 0.02, 0.0), (0.1, 0.01, 1.0), (9.0, 9.0, 9.0))
    alone = sorted([0.2 * sign, 0.4 * sign])
    assert extremes(poses, 3, ends, 0) == (alone[1], alone[0], 0.0, 0.0)
    both = sorted([*alone, 0.5, 0.1])
    assert extremes(poses, 3, ends, 2) == (both[-1], both[0], 0.02, 1.0)
    assert extremes(poses, 0, ends, 0) == (-math.inf, math.inf, 0.0, 0.0)


def test_worst_of_some_margins():
    columns = [at.FRICTION, at.BACK, at.FRONT, at.ENERGY, at.BELLY_TOUCHES]
    margins = table(
        columns, at.MARGIN_COLUMNS,
        (0.3, 0.2, 0.4, 0.05, 0.0), (0.7, 0.5, 0.1, 0.03, 1.0), (0.1, 0.3, 0.3, 0.04, 0.0),
        (9.0, -9.0, -9.0, -9.0, 9.0),
    )  # fmt: skip
    assert worst_margins(margins, 3) == (0.7, 0.1, 0.03, 1.0)
    assert worst_margins(margins, 1) == (0.3, 0.2, 0.05, 0.0)
    assert worst_margins(margins, 0) == (0.0, math.inf, math.inf, 0.0)


L, C_N, R = 0.5, 0.15, 0.1
FLOORS = [[(-9.0, 0.0), (9.0, 18.0 * slope)] for slope in (0.0, 0.2, -0.3)]
BELLY = [-0.1, -0.1, 0.05, 0.1, -0.1, 0.05]  # on the floor as well
LOW = [-0.1, -0.2, 0.05, 0.1, -0.2, 0.05]  # of another robot, lower than all
NARROW = [-2.0, 0.5, 0.01, -1.9, 0.5, 0.01]  # its centroid lies ahead of all that could carry it


def test_jobs_on_planes_of_some_slopes():
    """By hand: on a plane a robot keeps the plane's inclination and its levers, and arrives."""
    robots = [[LOW], stadium(L, 0.3, C_N, R), [*stadium(L, 0.2, C_N, R), BELLY], [NARROW]]
    kinds = [[PartKind.BELLY], [0], [0, PartKind.BELLY], [0]]
    jobs = [
        Job(0, 3, 0.0, 0.1), Job(1, 1, 0.5, 0.8, math.atan(0.2), reference=0.05),
        Job(2, 2, -0.5, -0.4, math.atan(-0.3), reference=-0.4), Job(0, 2, 1.0, 1.2),
        Job(0, 0, 0.0, 0.1),
    ]  # fmt: skip
    found = traverse_many(FLOORS, robots, jobs, kinds=kinds, with_margins=True).table
    none, *others, low = found
    assert (low[at.SUMMARY_STATUS], low[at.SUMMARY_BELLY]) == (Status.OK, 1.0)
    assert none[at.SUMMARY_STATUS] == Status.NO_START
    assert np.isnan(none[at.SUMMARY_HIGHEST :]).all()
    for row, job, slope, ahead in zip(
        others, jobs[1:4], (0.2, -0.3, 0.0), (0.3, 0.2, 0.2), strict=True
    ):
        angle = math.atan(slope)
        assert row[at.SUMMARY_STATUS] == Status.OK
        assert row[at.SUMMARY_HIGHEST] == pytest.approx(angle, abs=1e-9)
        assert row[at.SUMMARY_LOWEST] == pytest.approx(angle, abs=1e-9)
        assert row[at.SUMMARY_EXTRA] == pytest.approx(angle - job.reference, abs=1e-9)
        assert row[at.SUMMARY_REACHED] == pytest.approx(job.x_end, abs=1e-9)
        assert row[[at.SUMMARY_ANGLE, at.SUMMARY_TOPPLES, at.SUMMARY_ROTATIONS]].tolist() == [0] * 3
        assert row[at.SUMMARY_FRICTION] == pytest.approx(abs(slope), abs=1e-9)
        assert row[at.SUMMARY_BELLY] == (ahead == 0.2)


def test_poses_settled_on_a_floor():
    ground, body = ground_table(FLOORS[0]), body_table(stadium(L, 0.3, C_N, R))
    settled = np.full((3, at.SETTLED_COLUMNS), -9.0)
    settle_many(ground, body, np.array([0.0, 0.5, -1.0]), np.array([0.3, -0.2, 0.0]), 0.0, settled)
    assert settled[:, at.SETTLED_FOUND].tolist() == [1.0] * 3
    np.testing.assert_allclose(settled[:, at.SETTLED_Z], C_N, atol=1e-9)
    np.testing.assert_allclose(settled[:, at.SETTLED_PHI], 0.0, atol=1e-9)
    assert (settled[:, at.SETTLED_FRONT] - settled[:, at.SETTLED_REAR]).tolist() == [1.0] * 3
    # no tilt of gravity is borne that leads beyond both ends
    settle_many(ground, body, np.array([0.0]), np.array([0.0]), 9.0, settled)
    assert settled[:, at.SETTLED_FOUND].tolist() == [0.0, 1.0, 1.0]


def test_the_first_pose_counts_as_any_other():
    """Off a slope onto the level, from where it has the least energy to spare on."""
    terrain, robot = [(-9.0, -5.4), (0.0, 0.0), (9.0, 0.0)], stadium(L, 0.2, C_N, R)
    whole = traverse(terrain, robot, -1.0, 1.0)
    begin = float(whole.poses.x[np.argmin(whole.margins.energy)]) + 1e-3
    path = traverse(terrain, robot, begin, 1.0, inclination=0.3)
    assert path.margins.energy[0] < path.margins.energy[1:].min() - 1e-6
    job = Job(0, 0, begin, 1.0, 0.3)
    found = traverse_many([terrain], [robot], [job], with_margins=True).table[0]
    assert found[at.SUMMARY_ENERGY] == path.margins.energy[0]
