"""What a batch keeps of a traverse: the largest and the smallest of tables written by hand."""

import math

import numpy as np
import pytest

from kaidan.contact import columns as at
from kaidan.contact.kernel.batch import extremes, worst_margins


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
