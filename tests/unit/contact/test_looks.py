"""Where a step is looked at next for the place of an event, and how many looks that takes."""

from math import radians

import pytest

from contact_cases import flight, stadium
from kaidan import contact
from kaidan.contact.kernel import advance, event_location, renaming
from kaidan.contact.kernel.event_location import SAME_END, moved_again, next_look


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
