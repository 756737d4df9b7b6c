"""Which poses between poses are looked at for extremes, on figures made by hand; no kernel."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.traversal.samples import (
    _turns_steadily,
    _upright,
    corners,
    trailing_end_leaves,
)


class Poses(SimpleNamespace):
    leads_on = property(contact.Poses.leads_on.func)

    def __len__(self):
        return len(self.s)


def path(count, **columns):
    """Path of level poses a unit apart, but for what is given."""
    usual = {
        "s": np.arange(count, dtype=float),
        "leg": np.zeros(count),
        "rear": np.zeros(count),
        "front": np.zeros(count),
        "inclination": np.zeros(count),
        "path_direction": np.zeros(count),
        "rear_lean": np.zeros(count),
    }
    friction = np.array(columns.pop("friction", np.zeros(count)), dtype=float)
    poses = Poses(**(usual | {key: np.array(each) for key, each in columns.items()}))
    return SimpleNamespace(
        poses=poses, s=poses.s, margins=SimpleNamespace(required_friction=friction)
    )


def test_the_trailing_end_leaves_an_edge():
    """By hand: its normal leans ahead by more than the flat does, and the path falls."""
    leans = [0.3, 0.3, 0.3, -0.3, 0.3, 0.0, 1e-12, 1e-6]
    found = path(
        8,
        rear_lean=leans,
        inclination=[0.0, -0.2, -0.4, 0.0, 0.5, 0.0, 0.0, 0.0],
        path_direction=[-0.1, -0.1, -0.1, -0.1, -0.1, -0.1, -0.1, -0.1],
    )
    expected = [True, True, False, False, True, False, False, True]
    assert trailing_end_leaves(found).tolist() == expected
    for direction in (0.1, 0.0):
        found.poses.path_direction = np.full(8, direction)
        assert not trailing_end_leaves(found).any()


def test_where_a_contact_takes_another_name():
    found = path(
        8,
        rear=[1, 2, 2, 2, 3, 3, 3, 3],
        front=[5, 5, 5, 6, 7, 8, 9, 9],
        leg=[0, 0, 0, 0, 0, 1, 1, 1],
        s=[0, 1, 2, 3, 4, 5, 5, 6],
    )
    assert corners(found).tolist() == [False, True, False, True, True, False, False, False]


def test_where_the_path_stands_upright():
    """Its direction passes 90 degrees up, and down."""
    half = math.pi / 2
    found = path(9, path_direction=[half - 0.3, half + 0.1, 0.0, -half - 0.1, -half + 0.3, 0.2,
                                    0.4, half - 0.1, half + 0.1],
                 leg=[0, 0, 0, 1, 1, 1, 1, 1, 2])  # fmt: skip
    rows, shares = _upright(found)
    assert rows.tolist() == [0, 1, 3]  # up, back down from beyond it, and down
    assert shares == pytest.approx([0.75, 0.1 / (half + 0.1), 0.25])
    around = path(2, path_direction=[math.pi - 0.1, -math.pi + 0.1])  # over 180 degrees
    assert _upright(around)[0].tolist() == []
    around = path(2, path_direction=[-half + 0.1, -half - 0.1])
    assert _upright(around)[1] == pytest.approx([0.5])


@pytest.mark.parametrize(
    ("one", "middle", "other", "steady"),
    [
        (1.4, 1.57, 1.8, True),
        (1.8, 1.57, 1.4, True),
        (1.4, 1.5, 1.2, False),  # there and back
        (1.5, 1.4, 1.6, False),
        (0.0, 1.6, 1.9, False),  # by more than a right angle at once
        (0.0, 0.3, 2.0, False),
        (0.0, 1.5, 3.0, True),
        (3.1, -3.1, -3.0, True),  # over 180 degrees
    ],
)
def test_whether_the_path_turns_steadily(one, middle, other, steady):
    found = path(4, path_direction=[9.0, one, other, 9.0])
    between = path(1, path_direction=[middle])
    turns, directions = _turns_steadily(found, between, np.array([1]))
    assert turns.tolist() == [steady]
    assert directions.tolist() == [middle]
