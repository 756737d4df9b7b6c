"""Which poses between poses are looked at for extremes, on figures made by hand; no kernel."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.traversal import samples
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


def test_a_pose_lasts_unless_it_stands_in_the_midst_of_an_exchange():
    """Of three at one place the middle one does not; the ends of a path do."""
    found = path(7, s=[0.0, 0.0, 0.1, 0.1 + 5e-9, 0.1, 0.2, 0.2])
    assert samples.lasting(found).tolist() == [True, True, True, False, True, True, True]
    apart = path(3, s=[0.1, 0.1 + 2 * contact.ONE_PLACE, 0.1])
    assert samples.lasting(apart).tolist() == [True, True, True]
    # an arclength of a metre is as far from its mirror image as it is long
    assert samples.lasting(path(3, s=[-1.0, 1.0, -1.0])).all()


VERTEX, DISC = contact.FeatureKind.VERTEX, contact.FeatureKind.DISC_1


def test_where_a_nosing_moves_along_an_end():
    """Its normal turns on the body between two poses; of a disc on a tread it does not count."""
    level, leans = (0.0, 1.0), (math.sin(0.3), math.cos(0.3))
    codes = {kind: contact.Feature(1, 0, kind).code for kind in (VERTEX, DISC)}

    def moves(kinds, normals, inclination=(0.0, 0.0), leg=(0, 0), end="front"):
        other = "rear" if end == "front" else "front"
        found = path(2, leg=leg, inclination=inclination)
        vars(found.poses).update({
            end: np.array([codes[each] for each in kinds]), other: np.array([codes[DISC]] * 2),
            f"{end}_normal": np.array(normals), f"{other}_normal": np.array([level] * 2),
        })  # fmt: skip
        return samples._along_ends(found).tolist()

    for end in ("front", "rear"):
        assert moves((VERTEX, VERTEX), (level, leans), end=end) == [True]
        assert moves((VERTEX, DISC), (level, leans), end=end) == [True]
        assert moves((DISC, VERTEX), (level, leans), end=end) == [True]
        assert moves((DISC, DISC), (level, leans), end=end) == [False]
        assert moves((VERTEX, VERTEX), (leans, leans), end=end) == [False]
    three = path(3)
    vars(three.poses).update(
        front=np.array([codes[VERTEX], codes[DISC], codes[DISC]]), rear=np.array([codes[DISC]] * 3),
        front_normal=np.array([level, leans, leans]), rear_normal=np.array([level] * 3),
    )  # fmt: skip
    assert samples._along_ends(three).tolist() == [True, False]
    vars(three.poses).update(front=np.array([codes[VERTEX]] * 3))
    assert samples._along_ends(three).tolist() == [True, False]
    # the body turns with the normal, and under it
    assert moves((VERTEX, VERTEX), (level, leans), (0.3, 0.0)) == [False]
    assert moves((VERTEX, VERTEX), (leans, leans), (0.3, 0.0)) == [True]
    assert moves((VERTEX, VERTEX), (level, leans), leg=(0, 1)) == [False]


def test_where_a_path_passes_upright():
    """From 1.4 to 1.7 rad half of the way and more is past it; from 3 to -3 none is upright."""
    found = path(6, path_direction=[1.4, 1.7, 1.6, 3.0, -3.0, -1.5])
    rows, shares = _upright(found)
    up, down = math.pi / 2, -math.pi / 2
    assert rows.tolist() == [0, 4]
    assert shares == pytest.approx([(up - 1.4) / 0.3, (down + 3.0) / 1.5])
    # by more than a right angle it passes upright once, up and not down
    rows, shares = _upright(path(2, path_direction=[0.1, 3.0]))
    assert (rows.tolist(), shares) == ([0], pytest.approx([(up - 0.1) / 2.9]))


@pytest.mark.parametrize("a", [0.7, -0.7])
def test_the_traction_of_an_upright_path_is_that_of_all_its_weight(a, monkeypatch):
    """Up and down; where the path only comes to a stand it is that of its pose."""
    seen = SimpleNamespace(margins=SimpleNamespace(traction=np.array([1.0, -2.0, 3.0, 4.0, 5.0])))
    between = SimpleNamespace()
    run = path(2)
    run.between = lambda rows, shares, *, acceleration: between
    events = SimpleNamespace(pose=np.array([0]))
    psi = np.array([math.pi / 2, -math.pi / 2])
    rows, none = np.array([0, 0]), np.empty(0, dtype=np.int64)
    steady = np.array([True, True])
    for name, answer in (
        ("nosing_events", events), ("_upright", (rows, np.array([0.4, 0.6]))),
        ("_peaks", SimpleNamespace(path="peaks", rows=none)), ("_friction", "friction"),
        ("_turns_steadily", (steady, psi)),
        ("trailing_end_leaves", "off"), ("corners", np.zeros(2, dtype=bool)),
    ):  # fmt: skip
        monkeypatch.setattr(samples, name, lambda *given, answer=answer: answer)
    monkeypatch.setattr(samples, "by_how_long", lambda path, traction, row: traction)
    monkeypatch.setattr(contact, "without_nosings", lambda path, events, *, acceleration: "without")
    monkeypatch.setattr(contact, "joined", lambda every: seen)
    found = samples.samples_of(run, np.array(["land", "land"]), a)
    up, down = abs(9.80665 + a), abs(-9.80665 + a)
    assert found.traction == pytest.approx([1.0, 2.0, 3.0, up, down])
    assert found.row.tolist() == [0, 1, 0, 0, 0]
    steady[0] = False
    found = samples.samples_of(run, np.array(["land", "land"]), a)
    assert found.traction == pytest.approx([1.0, 2.0, 3.0, 4.0, down])
