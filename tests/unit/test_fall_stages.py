"""Stages of a fall by hand, on poses made for it."""

from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.contact import FLIPPER, TRACK, Feature, FeatureKind
from kaidan.traversal import fall_stages as module
from kaidan.traversal.fall_stages import fall_stages

ON_FLAT = Feature(3, 0, FeatureKind.VERTEX).code
OF_FLIPPER = Feature(3, 1, FeatureKind.VERTEX).code
ROUND = Feature(3, 0, FeatureKind.DISC_1).code
PHASES = np.array(["enter"] + ["traverse"] * 6 + ["land"])
INCLINATION = np.array([0.0, 0.5, 0.5, 0.52, 0.56, 0.60, 0.58, 0.9])


class Rows(SimpleNamespace):
    def __len__(self):
        return len(self.rear)


def turn(at, angle, sense=1, arrested=True):
    return SimpleNamespace(s=10.0 + at, angle=angle, sense=sense, arrested=arrested, pivot=at)


@pytest.fixture
def stages(monkeypatch):
    """Stages as name, row, place and further figures of each."""
    monkeypatch.setattr(module, "place_of", lambda traverse, code, leading: (code, leading))

    def of(*rotations, contacts=(ON_FLAT,) * 3 + (ROUND,) * 5, flat=8, descending=False, **given):
        contacts = np.array(contacts)
        load = np.array([9.0, 1.0, 2.0, 3.0, 5.0, 4.0, 9.0, 9.0])
        rear, front = (10.0 - load, load) if descending else (load, 10.0 - load)
        path = SimpleNamespace(
            poses=Rows(rear=contacts, front=contacts),
            margins=SimpleNamespace(rear_load=rear, front_load=front),
            inclination=-INCLINATION if descending else INCLINATION,
            s=10.0 + np.arange(8.0),
            rotations=rotations,
            row_before=lambda s: int(s) - 10,
            is_on_flat=lambda code, row: row < flat,
        )
        path.__dict__.update(given)
        traverse = SimpleNamespace(
            path=path, phase_of_pose=given.get("phases", PHASES), descending=descending,
            outline=SimpleNamespace(kinds=[TRACK, FLIPPER]),
        )  # fmt: skip
        found = fall_stages(traverse, "nose")
        for each in found:
            assert each.inclination == path.inclination[int(each.path) - 10]
        return [(e.name, int(e.path) - 10, e.place[0], e.rotation, e.share) for e in found]

    return of


@pytest.mark.parametrize("descending", [False, True])
def test_it_turns_on_its_round_end_and_back(descending, stages):
    """On the flat up to the third pose, steepest at the sixth, the largest load at the fifth."""
    assert stages(descending=descending) == [
        ("parallel motion", 2, ON_FLAT, None, None),
        ("round end", 3, ROUND, pytest.approx(0.1), None),
        ("largest load", 4, ROUND, None, 0.5),
        ("rotates back", 5, ROUND, None, None),
    ]


@pytest.mark.parametrize("code", [ROUND, OF_FLIPPER])
def test_what_never_lies_on_the_flat_begins_with_the_flight(code, stages):
    found = stages(contacts=(ON_FLAT, *(code,) * 7))
    assert [each[1] for each in found] == [1, 2, 4, 5]
    assert [each[1] for each in stages(contacts=(ON_FLAT,) * 8, flat=2)] == [1, 2, 4, 5]


def test_where_there_is_nothing_to_tell(stages):
    assert stages(margins=None) == []
    assert stages(phases=np.array(["enter"] * 8)) == []
    assert stages(contacts=(ON_FLAT,) * 8) == []  # flat to the end


def test_a_fall_at_once_has_neither_round_end_nor_load(stages):
    assert stages(turn(2, 0.3, arrested=False)) == [
        ("parallel motion", 2, ON_FLAT, None, None),
        ("onset of rotation", 2, 2, None, None),
    ]


def test_of_one_traverse_phase_alone_one_pose(stages):
    phases = np.array(["enter", "traverse"] + ["land"] * 6)
    found = stages(turn(1, 0.2), phases=phases)
    assert [each[:2] for each in found] == [("parallel motion", 1), ("onset of rotation", 1)]


@pytest.mark.parametrize(
    ("rotations", "chosen", "angle"),
    [
        ([turn(3, 0.1), turn(4, 0.3), turn(5, 0.2)], 4, 0.3),
        ([turn(3, 0.3), turn(4, 0.3)], 3, 0.3),  # of two alike the first
        ([turn(3, 0.3), turn(4, 0.1, arrested=False), turn(5, 0.2, arrested=False)], 4, None),
        ([turn(4, 0.3, sense=-1), turn(0, 0.9), turn(3, 0.1), turn(7, 0.9)], 3, 0.1),
    ],
)
def test_the_rotation_is_the_largest_over_the_downhill_end_or_the_fall(
    rotations, chosen, angle, stages
):
    *_, onset = stages(*rotations)
    assert onset == ("onset of rotation", chosen, chosen, angle, None)
