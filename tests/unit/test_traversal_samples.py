"""Which poses between poses are looked at for extremes, on figures made by hand; no kernel."""

import math
from types import SimpleNamespace

import numpy as np

from kaidan import contact
from kaidan.traversal import samples
from kaidan.traversal.nosing_events import TOUCH
from kaidan.traversal.samples import corners, trailing_end_leaves


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


def test_a_pose_lasts_unless_it_stands_in_the_midst_of_an_exchange():
    """Of three at one place the middle one does not; the ends of a path do."""
    found = path(7, s=[0.0, 0.0, 0.1, 0.1 + 5e-9, 0.1, 0.2, 0.2])
    assert samples.lasting(found).tolist() == [True, True, True, False, True, True, True]
    apart = path(3, s=[0.1, 0.1 + 2 * contact.ONE_PLACE, 0.1])
    assert samples.lasting(apart).tolist() == [True, True, True]
    # an arclength of a metre is as far from its mirror image as it is long
    assert samples.lasting(path(3, s=[-1.0, 1.0, -1.0])).all()


def test_samples_are_named_from_what_the_kernel_finds(monkeypatch):
    """Between two phases stands a pose of both: what follows on a corner is of the second."""
    run = path(3, s=[0.0, 0.0, 0.0], friction=[0.1, 0.2, 0.3])
    seen = path(5, friction=[0.1, math.nan, -math.inf, math.inf, 0.5],
                rear_lean=[0.0, 0.0, 0.0, 0.0, 0.4], path_direction=[-0.1] * 5)  # fmt: skip
    seen.margins.traction = np.array([1.0, -2.0, 3.0, -4.0, 5.0])
    told = []

    def samples_of(of, phase, touch, *, acceleration):
        told.append((of, phase.tolist(), touch, acceleration))
        return contact.Between(seen, np.array([0, 1, 2, 0, 1]))

    monkeypatch.setattr(contact, "samples_of", samples_of)
    monkeypatch.setattr(samples, "corners", lambda of: np.array([False, True, False]))
    monkeypatch.setattr(samples, "by_how_long", lambda of, traction, row: (traction, row.copy()))
    found = samples.samples_of(run, np.array(["enter", "traverse", "land"]), 0.7)
    assert told == [(run, [0, 1, 2], TOUCH, 0.7)]
    assert found.path is seen
    assert (found.phase.tolist(), found.corner.tolist()) == ([0, 1, 2], [False, True, False])
    assert found.row.tolist() == found.traction[1].tolist() == [0, 1, 2, 0, 2]
    assert found.lasts.tolist() == [True, False, True, True, True]
    assert found.friction.tolist() == [0.1, math.inf, math.inf, math.inf, 0.5]
    assert found.traction[0].tolist() == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert found.comes_off.tolist() == [False] * 4 + [True]
