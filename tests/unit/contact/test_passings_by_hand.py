"""On which pieces of a path nosings pass a flat's end, and which of them count; by hand."""

import itertools
from dataclasses import astuple

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import body_table, ground_table
from kaidan.contact.door import table_of
from kaidan.contact.kernel import passings
from kaidan.contact.kernel.passings import (
    along_flat,
    contacts_change,
    find_passings,
    leads_straight,
    put_passings_in_order,
    without_twins,
)
from kaidan.contact.layout import Margin, Passed, Pose
from kernel_memory import nothing, posed, scene, table


def poses():
    """Ten poses: a turn after the third, two lines of poses, two poses at one place."""
    found = nothing(Pose, 10)
    found["leg"] = [0] * 8 + [1] * 2
    found["inclination"] = np.where(np.arange(10) < 3, 0.0, 1.1e-9)
    found["s"] = [0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 5.5, 6.0, 7.0]
    return found


def margins():
    """Contacts change after the third pose, the front one after the seventh, the rear before."""
    found = nothing(Margin, 10)
    found["contacts"] = [2] * 3 + [3] * 7
    found["outer_rear"] = 1
    found["outer_front"] = [4] * 7 + [5] * 3
    return found


def test_pieces_that_lead_straight_on():
    found = poses()

    def straight():
        rows = table(Pose, found)
        return [row for row in range(9) if leads_straight(rows[row], rows[row + 1])]

    assert straight() == [0, 1, 3, 5, 6, 8]
    found["inclination"] *= 0.9 / 1.1
    assert 2 in straight()
    found["inclination"] *= -1.2
    assert 2 not in straight()


def test_where_contacts_change():
    found = margins()

    def changes():
        rows = table(Margin, found)
        return [row for row in range(-1, 10) if contacts_change(rows, row)]

    assert changes() == [2, 6]
    found["outer_rear"][4] = 7
    assert changes() == [2, 3, 4, 6]
    found["contacts"][[0, 9]] = 1
    assert changes() == [0, 2, 3, 4, 6, 8]


@pytest.mark.parametrize("radii", [(0.08, 0.08), (0.05, 0.1), (0.12, 0.06)])
@pytest.mark.parametrize("phi", [0.0, 0.4, -0.7])
def test_place_along_the_flat(radii, phi):
    """The flat of a track lies C_N below the centroid, however large its ends are."""
    body = body_table(stadium(0.6, 0.28, 0.1, *radii))
    ground = ground_table([(-4, -3), (0.3, 0.2), (4, -3)])
    point, there = int(np.argmax(ground["z"])), scene(ground, body)
    for along, gap in ((0.1, 0.0), (0.5, 0.02), (-0.1, -0.01)):
        com = (0.3 + 0.2j) - complex(along - 0.32, -0.1 - gap) * np.exp(1j * phi)
        found = along_flat(there.body[0], there.ground[point], posed(com.real, com.imag, phi))
        assert found == pytest.approx((along, gap), abs=1e-12)


@pytest.mark.parametrize(("known", "expected"), [(False, [0, 1, 3, 5, 6, 8]), (True, [1, 3, 5, 6])])
def test_pieces_are_straight_and_beside_a_change_of_contacts(known, expected, monkeypatch):
    looked = []

    def nosings_passed(scene, poses, events, rows, touch, reach, passed):
        looked.extend(rows)
        assert (scene, events, touch, reach) == ("scene", "events", 1e-7, 0.4)
        passed[0].s, passed[1].s = 3.0, 2.0
        return count

    monkeypatch.setattr(passings, "nosings_passed", nosings_passed)

    def found(room):
        passed = [Passed(7.0, True, 7, 7, 7, 7.0) for _ in range(room)]
        given = table(Pose, poses()), table(Margin, margins() if known else 0), "events", 1e-7, 0.4
        return find_passings("scene", *given, passed), [each.s for each in passed]

    count = 2
    assert found(3) == (2, [2.0, 3.0, 7.0])
    assert looked == expected
    assert found(2) == (2, [2.0, 3.0])
    count = 4  # more than there is room for
    assert found(3) == (4, [3.0, 2.0, 7.0])


@pytest.mark.parametrize("seed", range(6))
def test_passings_in_their_order(seed):
    """By their fields one after the other, against Python's own sorting."""
    rng = np.random.default_rng(seed)
    names = Passed.__slots__

    def ordered(rows):
        made = [Passed(**dict(zip(names, row, strict=True))) for row in rows]
        put_passings_in_order(made)
        return [astuple(each) for each in made]

    rows = [tuple(row) for row in rng.integers(0, 2, (17, len(names))).tolist()]
    assert ordered(rows) == sorted(rows)
    for one, other in itertools.pairwise(range(len(names))):
        two = [tuple(int(k == field) for k in range(len(names))) for field in (one, other)]
        assert ordered(two) == two[::-1]


def kept(*some):
    rows = [(s, reached, point, 7, k, 7.0) for k, (s, reached, point) in enumerate(some)]
    passed = table(Passed, table_of(Passed, rows))
    count = without_twins(passed)
    return [(each.s, each.point) for each in passed[0:count]]


def test_from_one_part_to_the_next_in_line_a_nosing_neither_comes_nor_goes():
    assert kept((1.0, 0, 5), (1.0 + 9e-7, 1, 5)) == []
    assert kept((1.0, 1, 5), (1.0, 0, 5), (1.0, 1, 5)) == [(1.0, 5)]
    for other in ((1.0, 1, 6), (1.0, 0, 5), (1.0 + 1.1e-6, 1, 5)):  # another nosing, way, place
        assert kept((1.0, 0, 5), other) == [(1.0, 5), (other[0], other[2])]
    between = [(1.0, 0, 10 + k) for k in range(8)]
    points = [point for _, point in kept((1.0, 0, 5), *between[:7], (1.0, 1, 5))]
    assert points == list(range(10, 17))
    assert len(kept((1.0, 0, 5), *between, (1.0, 1, 5))) == 10  # only eight are looked back on


def test_of_two_that_may_be_left_out_the_last():
    some = (1.0, 0, 5), (1.0, 0, 6), (1.0 + 5e-7, 0, 5), (1.0 + 6e-7, 1, 5)
    assert kept(*some) == [(1.0, 5), (1.0, 6)]
