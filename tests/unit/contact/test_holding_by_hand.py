"""What grousers hold all along a path: poses and cases that count, and where a slip leads."""

import math
from dataclasses import astuple

import pytest

from kaidan.contact import body_table
from kaidan.contact.door import table_of, zeros
from kaidan.contact.kernel import holding
from kaidan.contact.layout import (
    Belts,
    GrouserCase,
    Load,
    Margin,
    Part,
    Point,
    Pose,
    Pull,
)
from kernel_memory import numbers, scene, table

PULL = Pull(0.0, 9.8)
BODY = body_table([[-0.3, 0.1, 0.05, 0.2, -0.1, 0.06]])


@pytest.fixture
def least(monkeypatch):
    """Least margins of three poses, of each case what it leaves of each; and what was called."""

    def of(*each, counts=(True, True, True), places=(0.0, 0.1, 0.2), climbs=True):
        called, left = [], [margins for _, margins in each]

        def slip(poses, points, standing, friction, slots, sense, way, over, held):
            assert (len(poses), len(standing)) == (3, 12)
            called.append((sense, way, over, slots))
            for row, margin in enumerate(left.pop(0)):
                held[row] = margin

        def belt(supports, slots, loads, like, friction, height, found):
            assert len(loads) == len(found) == 3
            called.append((*friction, height))

        monkeypatch.setattr(holding, "held_while_slipping", slip)
        monkeypatch.setattr(holding, "belt_margins", belt)
        monkeypatch.setattr(holding, "standing_margins", lambda *given: called.append(given[4:7]))
        monkeypatch.setattr(holding, "find_supports", lambda *given: 1)
        monkeypatch.setattr(holding, "find_alike", lambda *given: None)
        poses = zeros(Pose, 3)
        poses["s"] = places
        grousers = table_of(GrouserCase, [
            (0.01, 0.05, 0.008, 0.003, rigid, 0.5, 0.6, 0.7, is_best)
            for rigid, (is_best, _) in zip((True, False, True), each, strict=False)
        ])  # fmt: skip
        belts = Belts(table(GrouserCase, grousers), numbers([]), climbs, 0.7, 1e-7, 0.004)
        found = holding.held_on_grousers(
            scene(zeros(Point, 0), BODY), table(Pose, poses), table(Margin, 3), PULL, belts,
            numbers(counts, bool),
        )  # fmt: skip
        return found, called

    return of


def test_the_least_of_poses_that_count_and_last(least):
    margins = [0.3, 0.1, 0.2]
    assert least((False, margins))[0][0] == 0.1
    assert least((False, margins), counts=(True, False, True))[0][0] == 0.2
    assert least((False, margins), places=(0.1, 0.1, 0.1))[0][0] == 0.2  # it does not stand so
    assert least((False, margins), places=(0.1, 0.1, 0.2))[0][0] == 0.1
    assert least((False, margins), counts=(False, False, False))[0][0] == math.inf


def test_all_cases_of_the_worst_have_to_hold_or_of_the_best(least):
    each = (False, [0.3] * 3), (False, [0.2] * 3), (True, [0.4] * 3)
    assert least(*each)[0] == (0.2, 0.4)


def test_a_slip_leads_down_by_a_spacing_and_a_step(least):
    """Friction beside grousers; rigid ones push an end off a face."""
    friction = (0.5, 0.6, 0.7)
    figures = (0.01, 0.05, 0.008, 0.003)
    _, called = least((False, [0.0] * 3), (False, [0.0] * 3))
    assert called[:2] == [(*friction, 0.01), (friction, (*figures, True), 1.0)]
    assert called[3:5] == [(*friction, 0.0), (friction, (*figures, False), 1.0)]
    assert called[2] == called[5] == (-1, pytest.approx(0.054), 0.05, 4)
    _, called = least((False, [0.0] * 3), climbs=False)
    assert called[1][-1] == -1.0
    assert called[2] == (1, pytest.approx(0.054), 0.05, 4)


def test_a_pose_on_its_way_is_no_exchange_on_either_side(least):
    margins = [0.3, 0.1, 0.2]
    assert least((False, margins), places=(0.0, 0.1, 0.1))[0][0] == 0.1


def test_the_load_of_a_pose():
    """By hand: 3 m/s2 up a path of 30 degrees under 8 N/kg, leaning by 3 in 4; friction of 1."""
    poses, margins = zeros(Pose, 2), zeros(Margin, 2)
    poses["path_direction"][0] = math.pi / 6
    margins["tilt"][0], margins["required_friction"][0] = 0.75, 1.0
    loads = table(Load, 2)
    holding.loads_of(table(Pose, poses), table(Margin, margins), Pull(3.0, 8.0), loads)
    size = math.sqrt(64.0 + 9.0 + 24.0)
    assert astuple(loads[0]) == pytest.approx([0.6 * size, 0.8 * size, math.pi / 4])
    assert astuple(loads[1]) == pytest.approx([0.0, math.sqrt(73.0), 0.0])


def test_how_far_a_robot_reaches():
    parts = [[-0.3, 0.1, 0.05, 0.2, -0.1, 0.06], [0.1, 0.0, 0.01, 0.4, 0.3, 0.02]]

    def reach(parts):
        return holding.reach_of(table(Part, body_table(parts)))

    assert reach(parts) == pytest.approx(0.72)
    assert reach(parts[:1]) == pytest.approx(0.45)
    assert reach([[-0.1, 0.0, 0.1, 0.3, 0.2, 0.1]]) == pytest.approx(0.6)


@pytest.mark.parametrize(("most", "slots"), [(4, 4), (5, 5), (8, 8), (9, 0)])
def test_what_poses_stand_on_has_as_much_room_as_it_needs(most, slots, monkeypatch):
    asked, alike, held = [], [], []

    def find(scene, parts, poses, treads, stance, supports, slots):
        asked.append((parts, len(poses), list(treads), tuple(stance), slots))
        for k, support in enumerate(supports):
            support.point = 100 + k
        return most

    def least_held(poses, climbs, slip, grousers, friction, counts, slots, supports, *more):
        loads, _, points = more
        held.append((slots, list(points), [load.z for load in loads]))
        return 0.3

    monkeypatch.setattr(holding, "find_supports", find)
    monkeypatch.setattr(
        holding, "find_alike", lambda *given: alike.append((given[1], len(given[2])))
    )
    monkeypatch.setattr(holding, "least_held", least_held)
    belts = Belts(table(GrouserCase, 1), numbers([0.1]), True, 0.7, 1e-7, 0.004)
    found = holding.held_on_grousers(
        scene(zeros(Point, 0), BODY), table(Pose, zeros(Pose, 2)), table(Margin, zeros(Margin, 2)),
        PULL, belts, numbers([True, True], bool),
    )  # fmt: skip
    # where that is too much nothing is known
    assert found == ((0.3, math.inf) if slots else (math.inf, math.inf))
    given = 1, 2, [0.1], (True, 0.7, 1e-7, pytest.approx(0.45))
    assert asked == [(*given, room) for room in dict.fromkeys((4, slots or 4))]
    assert alike == ([(slots, 2)] if slots else [])
    points = [100 + k for k in range(2 * slots)]
    assert held == ([(slots, points, [9.8, 9.8])] if slots else [])
