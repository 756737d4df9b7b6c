"""What grousers hold all along a path: poses and cases that count, and where a slip leads."""

import math

import numpy as np
import pytest

from kaidan.contact import columns as at
from kaidan.contact.kernel import holding


@pytest.fixture
def least(monkeypatch):
    """Least margin of three poses, of each case what it leaves of each; and what was called."""

    def of(*each, counts=(1, 1, 1), places=(0.0, 0.1, 0.2), climbs=True, best=False):
        called, left = [], [margins for is_best, margins in each if is_best is best]

        def slip(poses, points, standing, friction, slots, sense, way, over, held):
            called.append((sense, way, over, slots))
            held[:] = left.pop(0)

        monkeypatch.setattr(holding, "held_while_slipping", slip)
        monkeypatch.setattr(holding, "belt_margins", lambda *given: called.append(given[4:8]))
        monkeypatch.setattr(holding, "standing_margins", lambda *given: called.append(given[4:13]))
        poses = np.zeros((3, at.POSE_COLUMNS))
        poses[:, at.POSE_S] = places
        loads = np.zeros((3, at.LOAD_COLUMNS))
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
