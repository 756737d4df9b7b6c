"""What grousers hold all along a path: poses and cases that count, and where a slip leads."""

import math

import numpy as np
import pytest

from kaidan.contact import body_table
from kaidan.contact import layout as at
from kaidan.contact.kernel import holding


@pytest.fixture
def least(monkeypatch):
    """Least margin of three poses, of each case what it leaves of each; and what was called."""

    def of(*each, counts=(1, 1, 1), places=(0.0, 0.1, 0.2), climbs=True, best=False):
        called, left = [], [margins for is_best, margins in each if is_best is best]

        def slip(poses, points, standing, friction, slots, sense, way, over, held):
            assert len(poses) == 3
            called.append((sense, way, over, slots))
            held[:] = left.pop(0)

        monkeypatch.setattr(holding, "held_while_slipping", slip)

        def belt(supports, slots, loads, like, *given):
            assert len(loads) == 3
            called.append(given[:4])

        monkeypatch.setattr(holding, "belt_margins", belt)
        monkeypatch.setattr(holding, "standing_margins", lambda *given: called.append(given[4:13]))
        poses = zeros(Pose, 3)
        poses["s"] = places
        loads = zeros(Load, 3)
        grousers = np.array([
            (0.01, 0.05, 0.008, 0.003, rigid, 0.5, 0.6, 0.7, is_best)
            for rigid, (is_best, _) in zip((1.0, 0.0, 1.0), each, strict=False)
        ])  # fmt: skip
        found = holding.least_held(
            poses, 3, climbs, 0.004, grousers, best, np.array(counts), 4, None, loads, None, None,
            None, None, np.zeros(3),
        )  # fmt: skip
        return found, called

    return of


def test_the_least_of_poses_that_count_and_last(least):
    margins = [0.3, 0.1, 0.2]
    assert least((False, margins))[0] == 0.1
    assert least((False, margins), counts=(1, 0, 1))[0] == 0.2
    assert least((False, margins), places=(0.1, 0.1, 0.1))[0] == 0.2  # it does not stand so
    assert least((False, margins), places=(0.1, 0.1, 0.2))[0] == 0.1
    assert least((False, margins), counts=(0, 0, 0))[0] == math.inf


def test_all_cases_of_the_worst_have_to_hold_or_of_the_best(least):
    each = (False, [0.3] * 3), (False, [0.2] * 3), (True, [0.4] * 3)
    assert least(*each)[0] == 0.2
    assert least(*each, best=True)[0] == 0.4


def test_a_slip_leads_down_by_a_spacing_and_a_step(least):
    """Friction beside grousers; rigid ones push an end off a face."""
    friction = (0.5, 0.6, 0.7)
    figures = (0.01, 0.05, 0.008, 0.003)
    _, called = least((False, [0.0] * 3), (False, [0.0] * 3))
    assert called[:2] == [(*friction, 0.01), (*friction, *figures, True, 1.0)]
    assert called[3:5] == [(*friction, 0.0), (*friction, *figures, False, 1.0)]
    assert called[2] == called[5] == (-1, pytest.approx(0.054), 0.05, 4)
    _, called = least((False, [0.0] * 3), climbs=False)
    assert called[1][-1] == -1.0
    assert called[2] == (1, pytest.approx(0.054), 0.05, 4)


def test_a_pose_on_its_way_is_no_exchange_on_either_side(least):
    margins = [0.3, 0.1, 0.2]
    assert least((False, margins), places=(0.0, 0.1, 0.1))[0] == 0.1


def test_the_load_of_a_pose():
    """By hand: 3 m/s2 up a path of 30 degrees under 8 N/kg, leaning by 3 in 4; friction of 1."""
    poses, margins = zeros(Pose, 2), zeros(Margin, 2)
    poses["path_direction"][0] = math.pi / 6
    margins[0, [at.TILT, at.FRICTION]] = 0.75, 1.0
    loads = np.full((2, at.LOAD_COLUMNS), np.nan)
    holding.loads_of(poses, 2, margins, 3.0, 8.0, loads)
    size = math.sqrt(64.0 + 9.0 + 24.0)
    assert loads[0] == pytest.approx([0.6 * size, 0.8 * size, math.pi / 4])
    assert loads[1] == pytest.approx([0.0, math.sqrt(73.0), 0.0])


def test_how_far_a_robot_reaches():
    parts = [[-0.3, 0.1, 0.05, 0.2, -0.1, 0.06], [0.1, 0.0, 0.01, 0.4, 0.3, 0.02]]
    assert holding.reach_of(body_table(parts)) == pytest.approx(0.72)
    assert holding.reach_of(body_table(parts[:1])) == pytest.approx(0.45)
    assert holding.reach_of(body_table([[-0.1, 0.0, 0.1, 0.3, 0.2, 0.1]])) == pytest.approx(0.6)


@pytest.mark.parametrize(("most", "slots"), [(4, 4), (5, 5), (8, 8), (9, 0)])
def test_what_poses_stand_on_has_as_much_room_as_it_needs(most, slots, monkeypatch):
    asked, alike = [], []

    def find(ground, body, parts, own, poses, *more):
        asked.append((parts, own, len(poses), *more[:4], more[-1]))
        supports = more[-2]
        supports["point"] = np.arange(len(supports)) + 100
        return most

    monkeypatch.setattr(holding, "find_supports", find)
    monkeypatch.setattr(
        holding, "find_alike", lambda *given: alike.append((given[1], len(given[2])))
    )
    poses, margins = zeros(Pose, 3), zeros(Margin, 3)
    supports, loads = zeros(Support, 16), zeros(Load, 3)
    points = np.full(16, -1)
    body = body_table([[-0.3, 0.1, 0.05, 0.2, -0.1, 0.06]])
    found = holding.find_standing(
        None, body, poses, 2, margins, 0.0, 9.8, "treads", True, 0.7, 1e-7, supports, loads, None,
        None, points,
    )  # fmt: skip
    assert found == slots
    given = 1, False, 2, "treads", True, 0.7, 1e-7
    assert asked == [(*given, room) for room in dict.fromkeys((4, slots or 4))]
    assert alike == ([(slots, 2)] if slots else [])
    assert points.tolist() == [100 + k if k < 2 * slots else -1 for k in range(16)]
    assert (loads["z"][:2] == 9.8).all()
