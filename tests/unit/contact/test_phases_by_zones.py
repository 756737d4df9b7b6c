"""Phases of poses by the zones in which their contacts stand, on poses made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.contact import Poses, phases_by_zones, using_kernel, without_native
from kaidan.contact.door import table_of, zeros
from kaidan.contact.kernel import phases
from kaidan.contact.layout import Pose, Zone
from kernel_memory import called

UP = math.inf
in_zone = called(phases.in_zone)
KERNELS = ["plain"] if without_native() else ["plain", "native"]


def named(rear, front, enters, lands, kernel="plain"):
    table = zeros(Pose, len(rear))
    for name, places in (("rear", rear), ("front", front)):
        table[name]["x"], table[name]["z"] = np.array(places).T
    with using_kernel(kernel):
        return phases_by_zones(SimpleNamespace(poses=Poses(table)), enters, lands).tolist()


@pytest.mark.parametrize("kernel", KERNELS)
def test_phases_by_zones(kernel):
    """What the rear contact leaves for a while counts as not left; landing counts before it."""
    rear = [(-0.2, 0.0), (0.0, 0.0), (0.1, 0.5), (0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (1.1, 1.0)]
    front = [(0.0, 0.0), (0.1, 0.5), (0.2, 0.5), (0.3, 0.5), (0.8, 1.0), (1.4, 1.0), (1.5, 1.0)]
    enters = [[(-UP, -0.1, -UP, UP), (-UP, 0.0, -0.1, 0.1)]]
    found = named(rear, front, enters, [(1.2, UP, -UP, UP)], kernel)
    assert found == [0, 0, 0, 0, 1, 2, 2]
    # of two flights each by itself
    enters.append([(1.0, 1.05, 0.9, 1.1)])
    assert named(rear, front, enters, [(1.45, UP, -UP, UP)], kernel) == [0, 0, 0, 0, 1, 0, 2]
    assert named(rear, front, enters, [(-UP, 0.05, -UP, UP)], kernel) == [2, 0, 0, 0, 1, 0, 1]
    assert named(rear, front, [[(5.0, 6.0, -UP, UP)]], [], kernel) == [1] * 7


def test_places_in_zones():
    zones = table_of(Zone, [(0.0, 1.0, 2.0, 3.0), (4.0, 5.0, 6.0, 7.0)])
    places = [(0.0, 2.0), (1.0, 3.0), (4.5, 6.5)]
    assert all(in_zone(zones, *each) for each in places)
    others = [(-0.1, 2.5), (1.1, 2.5), (0.5, 1.9), (0.5, 3.1), (0.5, 6.5), (4.5, 2.5)]
    assert not any(in_zone(zones, *each) for each in others)
    assert not in_zone(zones[:0], 0.5, 2.5)
