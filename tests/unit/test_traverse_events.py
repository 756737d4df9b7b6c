"""Events with their steps and phases, on records made by hand; no kernel."""

from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.contact import Event
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal.events import traverse_events

PROFILE = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=3))
FIRST = PROFILE.nosings[0, 0]


class Poses(SimpleNamespace):
    def __len__(self):
        return len(self.front_point)


def told(*events):
    """Events of kind and pose, on a path whose front contact stands at 0, 1, 2 and 3 nosings."""
    places = FIRST + np.array([-0.1, 0.0, 0.3, 0.6])
    rotations = [
        SimpleNamespace(angle=angle, topples_with_momentum=topples)
        for angle, topples in ((0.1, False), (0.2, True))
    ]
    path = SimpleNamespace(
        poses=Poses(front_point=np.stack([places, 0 * places], 1)), rotations=rotations
    )
    records = [
        SimpleNamespace(
            kind=kind, pose=pose, s=float(pose), x=0.5, z=0.25, inclination=0.1, feature=7, other=-1
        )
        for kind, pose in events
    ]
    phase = np.array(["enter", "traverse", "traverse", "land"])
    return traverse_events(path, records, PROFILE, phase, False)


def test_an_event_has_the_step_and_the_phase_of_its_pose():
    found = told(*((Event.MADE, pose) for pose in (-1, 0, 1, 2, 3, 4)))
    assert [each.step for each in found] == [0, 0, 1, 2, 3, 3]
    assert [each.phase for each in found] == [
        "enter", "enter", "traverse", "traverse", "land", "land",
    ]  # fmt: skip
    one = found[2]
    assert (one.path, one.x, one.z, one.inclination) == (1.0, 0.5, 0.25, 0.1)
    assert (one.feature, one.other_feature, one.name) == (7, -1, "made")


@pytest.mark.parametrize("begins", [Event.NOSE_DROPS, Event.TIPS_BACK])
def test_what_is_arrested_has_the_angle_of_the_rotation_that_began_last(begins):
    found = told(
        (Event.MADE, 0), (begins, 1), (Event.MADE, 1), (Event.ARRESTED, 1), (Event.LOST, 2),
        (Event.NOSE_DROPS, 2), (Event.ARRESTED, 3),
    )  # fmt: skip
    assert [each.rotation for each in found] == [None, None, None, 0.1, None, None, 0.2]
    assert [each.topples_with_momentum for each in found] == [
        None, None, None, False, None, None, True,
    ]  # fmt: skip
