"""Where a step is looked at next for the place of an event, and how many looks that takes."""

import math
from math import radians

import numpy as np
import pytest

from contact_cases import flight, stadium
from kaidan import contact
from kaidan.contact import Feature, FeatureKind, body_table, ground_table
from kaidan.contact.codes import Advance
from kaidan.contact.kernel import advance, contact_changes, event_location, renaming
from kaidan.contact.kernel.continuation import stepped, tilt
from kaidan.contact.kernel.event_location import (
    PENETRATED,
    SAME_END,
    closing_time,
    moved_again,
    next_look,
    quantity,
)
from kaidan.contact.layout import Held, Pull
from kernel_memory import posed, scene


@pytest.mark.parametrize(
    ("near", "far", "moved", "look"),
    [
        (1.0, -1.0, 0, 3.0),  # half-way on the line
        (3.0, -1.0, 2, 3.5),
        (3.0, -1.0, SAME_END, 3.0),  # halved: the same end moved three times
        (3.0, -1.0, -SAME_END, 3.0),
        (1.0, 0.0, 0, 3.0),  # the line ends at the far end: halved
    ],
)
def test_the_next_look_is_on_the_line_or_half_way(near, far, moved, look):
    assert next_look(2.0, 4.0, near, far, moved) == look


def test_ends_that_move_are_counted_in_a_row():
    counts, moved = [], 0
    for near in (True, True, False, False, False, True):
        moved = moved_again(moved, near)
        counts.append(moved)
    assert counts == [1, 2, -1, -2, -3, 1]


def looks_of(monkeypatch, module, name, within):
    """Poses that a search looked at, each time that it was called."""
    searched, looked = getattr(module, name), within.stepped
    counts = []

    def search(*arguments):
        counts.append(0)
        return searched(*arguments)

    def look(*arguments):
        if counts:
            counts[-1] += 1
        return looked(*arguments)

    monkeypatch.setattr(module, name, search)
    monkeypatch.setattr(within, "stepped", look)
    return counts


def test_a_place_is_found_in_a_few_looks(monkeypatch):
    """Halving takes 27 of them from 10 mm to 0.1 nm; what rests there already is halved."""
    events = looks_of(monkeypatch, advance, "closing_time", event_location)
    names = looks_of(monkeypatch, renaming, "renaming", renaming)
    with contact.using_kernel("plain"):
        contact.traverse(
            flight(radians(40), 0.15, 6), stadium(0.47, 0.196, 0.071, 0.06), -1.0, 1.6, step=0.02,
            with_margins=False,
        )  # fmt: skip
    for each in (events, names):
        assert len(each) >= 5
        assert sorted(each)[len(each) // 2] <= 7
    assert max(events + names) <= 15


L, C_L, C_N, R = 0.6, 0.28, 0.1, 0.08
BODY = body_table(stadium(L, C_L, C_N, R))
HALF_DEEP = 0.5 * PENETRATED
G = 9.8


def code(point, kind):
    return Feature(point, 0, kind).code


def placed(ground, x, phi=0.0):
    """The robot let down at x: its pose with the way on, rear and front."""
    good, at = contact_changes.settled(scene(ground, BODY), x, phi, 0.0)
    assert good
    return at


def searched(ground, what, at, ds, a=0.0, kappa_g=0.0):
    """What `closing_time` finds on a step that is good, from the figures at its ends."""
    tables, pull = scene(ground, BODY), Pull(a, G, kappa_g)
    good, there, _ = stepped(tables, at, ds)
    assert good
    ends = [
        quantity(tables, what, each, posed(*each[:3]), tilt(pull, each.t_x, each.t_z))
        for each in (at, there)
    ]
    assert ends[0] > 0.0 >= ends[1]
    return closing_time(tables, what, at, ds, *ends, pull)


def test_what_stays_positive_as_long_as_nothing_happens():
    """On a floor 0.1 m below the centroid, the feet 0.32 m behind and 0.28 m ahead of it."""
    ground = ground_table([(-4, 0), (1, 0), (1, 0.1), (4, 0.1)])
    held = placed(ground, 0.3)
    rear, front = held.rear, held.front
    for kappa in (0.0, 0.3, -0.3):
        asked = held, posed(*held[:3]), kappa
        lean = 0.1 * kappa
        expected = {
            Advance.OVER_REAR: L - C_L - lean, Advance.OVER_FRONT: C_L + lean,
            rear: HALF_DEEP, front: HALF_DEEP,
            # the nosing from the front disc's centre
            code(2, FeatureKind.VERTEX): math.hypot(1 - 0.3 - C_L, 0.02) - R + HALF_DEEP,
            # the tread's line is met beyond its end: the rear disc is as far from its nosing
            code(2, FeatureKind.DISC_1): math.hypot(1 - 0.3 + L - C_L, 0.02) - R + HALF_DEEP,
        }  # fmt: skip
        for what, value in expected.items():
            assert quantity(scene(ground, BODY), what, *asked) == pytest.approx(value, abs=1e-15)


@pytest.mark.parametrize("ds", [0.02, 0.03])
def test_where_an_end_meets_a_nosing(ds):
    """Up to the nosing it is level: by the circle about it the disc's centre is 77.5 mm off."""
    ground = ground_table([(-4, 0), (1, 0), (1, 0.1), (4, 0.1)])
    meets = 1 - C_L - math.sqrt(R**2 - 0.02**2)
    found, at = searched(ground, code(2, FeatureKind.VERTEX), placed(ground, meets - 0.012), ds)
    assert found == 1
    assert at + 1e-12 >= 0.012
    assert at == pytest.approx(0.012, abs=2e-10)


@pytest.mark.parametrize(("a", "kappa_g"), [(0.0, 0.0), (0.6, 0.0), (-0.5, 0.1)])
@pytest.mark.parametrize("up", [1.0, -1.0])
def test_where_the_centroid_comes_over_an_edge(a, kappa_g, up):
    """On two edges under the flat, on a slope: by the tilt of gravity against the flat."""
    phi = 0.1 * up
    turn = complex(math.cos(phi), math.sin(phi))
    edges = [along * turn for along in (-0.2, 0.0, 0.2)]
    line = [(-4, -2)]
    for p in edges:
        line += [(p.real - 1e-3, -2), (p.real, p.imag), (p.real + 1e-3, -2)]
    ground = ground_table([*line, (4, -2)])
    rear, front = (int(np.argmin(abs(ground["x"] + 1j * ground["z"] - p))) for p in edges[:2])
    # gravity from the centroid meets the flat so far ahead of the foot of its height above it
    over = C_N * math.tan(phi + math.atan(tilt(Pull(a, G, kappa_g), turn.real, turn.imag)))
    start = (over - 0.006 + 1j * C_N) * turn
    at = Held(
        start.real, start.imag, phi, turn.real, turn.imag, 0.0,
        code(rear, FeatureKind.VERTEX), code(front, FeatureKind.VERTEX),
    )  # fmt: skip
    found, place = searched(ground, Advance.OVER_FRONT, at, 0.01, a, kappa_g)
    assert found == 1
    assert place >= 0.006 - 1e-12
    assert place == pytest.approx(0.006, abs=2e-10)


def test_a_name_that_a_contact_takes_on_the_way_is_no_event():
    """The rear end runs on along one slope, over a point that lies amid it."""
    ground = ground_table([(-4, 0), (0, 0), (0.1, -1e-3), (4, -0.04)])
    at = placed(ground, 0.3)
    what = code(1, FeatureKind.DISC_1)
    found, _ = closing_time(scene(ground, BODY), what, at, 0.05, 1e-3, -1e-3, Pull(0.0, G))
    assert found == 2


def test_no_place_where_the_corrector_fails():
    """37 degrees off the line of poses it does."""
    ground = ground_table([(-4, 0), (4, 0)])
    held = placed(ground, 0.3)._replace(t_x=0.8, t_z=0.0, t_w=0.6)
    given = scene(ground, BODY), Advance.OVER_REAR, held, 0.01, 1e-3, -1e-3, Pull(0.0, G)
    assert closing_time(*given) == (0, 0.0)


def test_no_place_where_a_gap_jumps():
    """A plate that is 30 mm deep in the flat all the way has not closed within a step."""
    ground = ground_table([(-4, 0), (0.3, 0), (0.3, 0.05), (0.301, 0), (4, 0)])
    what = code(int(np.argmax(ground["z"])), FeatureKind.VERTEX)
    k = int(np.flatnonzero(ground["x"] < 0.3)[-1])
    rear, front = code(k, FeatureKind.DISC_1), code(len(ground) - 2, FeatureKind.DISC_2)
    held = Held(0.3, C_N, 0.0, 1.0, 0.0, 0.0, rear, front)
    found = closing_time(scene(ground, BODY), what, held, 0.01, 1e-3, -0.03, Pull(0.0, G))
    assert found == (0, 0.0)
