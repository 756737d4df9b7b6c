"""What a batch keeps of a traverse: the largest and the smallest of tables written by hand."""

import math

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import (
    Job,
    PartKind,
    Status,
    traverse,
    traverse_many,
)
from kaidan.contact.door import zeros
from kaidan.contact.kernel import batch
from kaidan.contact.kernel.batch import sum_up
from kaidan.contact.layout import Pose, RotationRow, Summary
from kernel_memory import table


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_inclinations_of_poses_and_ends_of_rotations(sign):
    poses, rotations = zeros(Pose, 2), zeros(RotationRow, 2)
    poses["inclination"], poses["x"] = (0.2 * sign, 0.4 * sign), (0.1, 0.3)
    rotations["end"]["inclination"], rotations["angle"] = (0.5, 0.1), (0.02, 0.01)
    rotations["topples_with_momentum"] = (False, True)

    def summed(rotations):
        summary = Summary(*Summary.__dataclass_fields__)
        sum_up(table(Pose, poses), table(RotationRow, rotations), summary)
        found = summary.largest_inclination, summary.smallest_inclination
        return (*found, summary.largest_rotation, summary.topples_with_momentum, summary.x)

    alone = sorted([0.2 * sign, 0.4 * sign])
    assert summed(rotations[:0]) == (alone[1], alone[0], 0.0, False, 0.3)
    both = sorted([*alone, 0.5, 0.1])
    assert summed(rotations) == (both[-1], both[0], 0.02, True, 0.3)


def test_worst_of_some_margins(monkeypatch):
    """Largest friction, smallest margins to either side, least energy, any belly that touches."""
    rows = [(0.3, 0.2, 0.4, 0.05, False), (0.7, 0.5, 0.1, 0.03, True), (0.1, 0.3, 0.3, 0.04, False)]

    def pose_margins(scene, poses, pull, margins):
        for k, (friction, back, front, _, belly) in enumerate(rows[: len(poses)]):
            margins[k].required_friction, margins[k].belly_touches = friction, belly
            margins[k].back, margins[k].front = back, front

    def work_out_energy(scene, pose, margin):
        margin.energy = next(row[3] for row in rows if row[0] == margin.required_friction)

    monkeypatch.setattr(batch, "pose_margins", pose_margins)
    monkeypatch.setattr(batch, "work_out_energy", work_out_energy)
    for count, expected in ((3, (0.7, 0.1, 0.03, True)), (1, (0.3, 0.2, 0.05, False))):
        summary = Summary(*Summary.__dataclass_fields__)
        batch.sum_up_margins(None, table(Pose, zeros(Pose, count)), None, summary)
        found = summary.required_friction, summary.static_margin, summary.energy
        assert (*found, summary.belly_touches) == expected


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
    assert (low["status"], low["belly_touches"]) == (Status.OK, True)
    assert none["status"] == Status.NO_START
    assert np.isnan([value for value in none.item() if isinstance(value, float)]).all()
    for row, job, slope, ahead in zip(
        others, jobs[1:4], (0.2, -0.3, 0.0), (0.3, 0.2, 0.2), strict=True
    ):
        angle = math.atan(slope)
        assert row["status"] == Status.OK
        assert row["largest_inclination"] == pytest.approx(angle, abs=1e-9)
        assert row["smallest_inclination"] == pytest.approx(angle, abs=1e-9)
        assert row["extra"] == pytest.approx(angle - job.reference, abs=1e-9)
        assert row["x"] == pytest.approx(job.x_end, abs=1e-9)
        assert (row["largest_rotation"], row["topples_with_momentum"], row["rotations"]) == (
            0,
            False,
            0,
        )
        assert row["required_friction"] == pytest.approx(abs(slope), abs=1e-9)
        assert row["belly_touches"] == (ahead == 0.2)


def test_the_first_pose_counts_as_any_other():
    """Off a slope onto the level, from where it has the least energy to spare on."""
    terrain, robot = [(-9.0, -5.4), (0.0, 0.0), (9.0, 0.0)], stadium(L, 0.2, C_N, R)
    whole = traverse(terrain, robot, -1.0, 1.0)
    begin = float(whole.poses.x[np.argmin(whole.margins.energy)]) + 1e-3
    path = traverse(terrain, robot, begin, 1.0, inclination=0.3)
    assert path.margins.energy[0] < path.margins.energy[1:].min() - 1e-6
    job = Job(0, 0, begin, 1.0, 0.3)
    found = traverse_many([terrain], [robot], [job], with_margins=True).table[0]
    assert found["energy"] == path.margins.energy[0]
