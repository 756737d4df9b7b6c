"""What the kernel works out along a whole path: nosings that pass an end of the flat, slips."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from contact_cases import flight, stadium
from kaidan import contact
from kaidan.contact import Event, EventRecord, Feature, FeatureKind, nosings, using_kernel
from kaidan.contact.kernel.passings import along_flat
from kaidan.contact.records import Events
from kernel_memory import posed, scene

ROBOT = stadium(0.470, 0.196, 0.071, 0.06)
TOUCH = 1e-7


@pytest.fixture(scope="module")
def path():
    return contact.traverse(flight(math.radians(30), 0.15, 8), ROBOT, -0.6, 1.4)


def straight(path):
    same = path.poses.leg[1:] == path.poses.leg[:-1]
    turned = np.abs(np.diff(path.inclination))
    return np.flatnonzero(same & (turned < 1e-9) & (np.diff(path.s) > 0))


def by_hand(path, rows):
    """Pose by pose and point by point, from the place along the flat before and after."""
    points = np.flatnonzero(path.ground.convex)
    length = float(path.body.flat[0])
    found = []
    for row in rows:
        for point in points:
            tables = scene(*path.scene)
            (w_0, gap_0), (w_1, gap_1) = (
                along_flat(tables.body[0], tables.ground[int(point)], posed(*place))
                for place in path.poses.placements[row : row + 2].tolist()
            )
            lay, lies = (
                abs(gap) < TOUCH and 0 <= w <= length for w, gap in ((w_0, gap_0), (w_1, gap_1))
            )
            if lay != lies:
                end = 0.0 if min(w_0, w_1) < 0 else length
                share = (end - w_0) / (w_1 - w_0)
                s = path.s[row] + share * (path.s[row + 1] - path.s[row])
                found.append((s, float(lies), point, 0, row, share))
    return np.array(sorted(found))


@pytest.mark.parametrize("kernel", ["auto", "plain"])
def test_nosings_that_pass_an_end_of_the_flat(path, kernel):
    with using_kernel(kernel):
        beside_changes = contact.nosings_passed(path, TOUCH)
        found = contact.nosings_passed(replace(path, margins=None), TOUCH)
    expected = by_hand(path, straight(path))
    assert len(beside_changes) > 8
    assert {*beside_changes.tolist()} <= {*found.tolist()}
    assert len(found) > 8
    rows = np.array(found.tolist(), dtype=float)
    np.testing.assert_allclose(rows, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("kernel", ["auto", "plain"])
@pytest.mark.parametrize("named", ["feature", "other"])
def test_what_an_event_tells_of_is_left_out(path, kernel, named):
    found = contact.nosings_passed(path, TOUCH)
    s, _, point, part, row, _ = found[3].tolist()
    code = Feature(int(point), int(part), FeatureKind.VERTEX).code
    codes = {"feature": -1, "other": -1, named: code}
    records = [
        EventRecord(Event.LEFT, at, 0.0, 0.0, 0.0, **codes, pose=int(row)) for at in (s, s + 0.5)
    ]
    told = replace(path, events=Events.of(records))
    with using_kernel(kernel):
        np.testing.assert_array_equal(
            contact.nosings_passed(told, TOUCH), np.delete(found, 3, axis=0)
        )


def test_nothing_passes_on_no_way(path):
    one = replace(path, poses=path.poses[:1], margins=None)
    assert contact.nosings_passed(one, TOUCH).shape == (0,)


def test_there_is_room_for_more_nosings_than_poses(monkeypatch):
    """Of as many as there are poses, and 8 more, at first."""
    sizes = []
    passed = [(0.5, True, 2, 3, 4, 0.25), (0.6, False, 2, 3, 5, 0.5), (0.7, True, 3, 3, 6, 0.75)]

    def find_passings(*given):
        sizes.append(len(given[-1]))
        if len(given[-1]) < 20:
            return 20
        given[-1][:3] = passed
        return 3

    monkeypatch.setattr(nosings, "kernel", lambda: SimpleNamespace(find_passings=find_passings))
    few = contact.traverse([(-4, 0), (4, 0)], ROBOT, 0.0, 0.08, step=0.02)
    assert contact.nosings_passed(few, TOUCH).tolist() == passed
    assert sizes == [len(few.poses) + 8, 20]


def slip(path, points, standing, friction, way, sense):
    """Each nosing by itself: the least on the whole way, of the better of it and friction."""
    s, leg = path.s, path.poses.leg
    found = np.array(friction)
    for row in range(len(s)):
        for slot, point in enumerate(points[row]):
            if point < 0:
                continue
            least, there = max(friction[row], standing[row, slot]), row + sense
            while 0 <= there < len(s) and leg[there] == leg[row] and abs(s[there] - s[row]) < way:
                held = standing[there][points[there] == point]
                least = min(least, max([friction[there], *held]))
                there += sense
            found[row] = max(found[row], least)
    return found


@pytest.mark.parametrize("kernel", ["auto", "plain"])
@pytest.mark.parametrize("ahead", [True, False])
def test_one_nosing_has_to_do_at_every_pose_of_a_slip(path, kernel, ahead):
    rng = np.random.default_rng(3)
    count = len(path.poses)
    points = np.sort(rng.integers(-1, 4, (count, 3)) + np.arange(count)[:, None] // 40, axis=1)
    standing, friction = rng.normal(size=(count, 3)) + 0.5, rng.normal(size=count)
    standing[rng.random((count, 3)) < 0.1] = -np.inf
    with using_kernel(kernel):
        found = contact.held_while_slipping(
            path.poses, points, standing, friction, way=0.06, over=0.0, ahead=ahead
        )
    expected = slip(path, points, standing, friction, 0.06, 1 if ahead else -1)
    np.testing.assert_array_equal(found, expected)
    assert (found > friction).any()
