"""On which pieces of a path nosings pass a flat's end, and which of them count; by hand."""

import itertools

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import body_table, ground_table
from kaidan.contact import layout as at
from kaidan.contact.kernel import passings
from kaidan.contact.kernel.passings import (
    along_flat,
    contacts_change,
    find_passings,
    leads_straight,
    put_passings_in_order,
    without_twins,
)


def poses():
    """Ten poses: a turn after the third, two lines of poses, two poses at one place."""
    found = np.full((10, at.POSE_COLUMNS), np.nan)
    found["leg"] = [0] * 8 + [1] * 2
    found["inclination"] = np.where(np.arange(10) < 3, 0.0, 1.1e-9)
    found["s"] = [0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 5.5, 6.0, 7.0]
    return found


def margins():
    """Contacts change after the third pose, the front one after the seventh, the rear before."""
    found = np.full((10, at.MARGIN_COLUMNS), np.nan)
    found["contacts"] = [2] * 3 + [3] * 7
    found["outer_rear"] = 1
    found["outer_front"] = [4] * 7 + [5] * 3
    return found


def test_pieces_that_lead_straight_on():
    found = poses()
    assert [row for row in range(9) if leads_straight(found, row)] == [0, 1, 3, 5, 6, 8]
    found["inclination"] *= 0.9 / 1.1
    assert leads_straight(found, 2)
    found["inclination"] *= -1.2
    assert not leads_straight(found, 2)


def test_where_contacts_change():
    found = margins()
    assert [row for row in range(-1, 10) if contacts_change(found, row)] == [2, 6]
    found["outer_rear"][4] = 7
    assert [row for row in range(-1, 10) if contacts_change(found, row)] == [2, 3, 4, 6]
    found["contacts"][[0, 9]] = 1
    assert [row for row in range(-1, 10) if contacts_change(found, row)] == [0, 2, 3, 4, 6, 8]


@pytest.mark.parametrize("radii", [(0.08, 0.08), (0.05, 0.1), (0.12, 0.06)])
@pytest.mark.parametrize("phi", [0.0, 0.4, -0.7])
def test_place_along_the_flat(radii, phi):
    """The flat of a track lies C_N below the centroid, however large its ends are."""
    body = body_table(stadium(0.6, 0.28, 0.1, *radii))
    ground = ground_table([(-4, -3), (0.3, 0.2), (4, -3)])
    point = int(np.argmax(ground["z"]))
    for along, gap in ((0.1, 0.0), (0.5, 0.02), (-0.1, -0.01)):
        com = (0.3 + 0.2j) - complex(along - 0.32, -0.1 - gap) * np.exp(1j * phi)
        poses = zeros(Pose, 2)
        poses[1, [at.POSE_X, at.POSE_Z, at.POSE_PHI]] = com.real, com.imag, phi
        found = along_flat(ground, body, poses, 1, 0, point)
        assert found == pytest.approx((along, gap), abs=1e-12)


@pytest.mark.parametrize(("known", "expected"), [(False, [0, 1, 3, 5, 6, 8]), (True, [1, 3, 5, 6])])
def test_pieces_are_straight_and_beside_a_change_of_contacts(known, expected, monkeypatch):
    looked = []

    def nosings_passed(ground, body, poses, events, rows, touch, reach, passed):
        looked.extend(rows.tolist())
        assert (ground, body, events, touch, reach) == ("ground", "body", "events", 1e-7, 0.4)
        passed["s"][:2] = 3.0, 2.0
        return count

    monkeypatch.setattr(passings, "nosings_passed", nosings_passed)

    def found(room):
        passed = np.full((room, at.PASSED_COLUMNS), 7.0)
        given = poses(), margins(), known, "events", 1e-7, 0.4, np.zeros(10, dtype=np.int64)
        return find_passings("ground", "body", *given, passed), passed["s"].tolist()

    count = 2
    assert found(3) == (2, [2.0, 3.0, 7.0])
    assert looked == expected
    assert found(2) == (2, [2.0, 3.0])
    count = 4  # more than there is room for
    assert found(3) == (4, [3.0, 2.0, 7.0])


@pytest.mark.parametrize("seed", range(6))
def test_passings_in_their_order(seed):
    """By their columns one after the other, against Python's own sorting."""
    rng = np.random.default_rng(seed)
    made = rng.integers(0, 2, (20, at.PASSED_COLUMNS)).astype(float)
    expected = sorted(made[:17].tolist()) + made[17:].tolist()
    put_passings_in_order(made, 17)
    assert made.tolist() == expected
    for columns in itertools.pairwise(range(at.PASSED_COLUMNS)):
        two = zeros(Passed, 2)
        two[0, columns[0]], two[1, columns[1]] = 1.0, 1.0
        swapped = two[::-1].copy()
        put_passings_in_order(two, 2)
        assert two.tolist() == swapped.tolist()


def kept(*some):
    passed = np.full((len(some), at.PASSED_COLUMNS), 7.0)
    passed[:, [at.PASSED_S, at.PASSED_REACHED, at.PASSED_POINT]] = some
    passed["row"] = range(len(some))
    count = without_twins(passed, len(some))
    return [(row[at.PASSED_S], int(row[at.PASSED_POINT])) for row in passed[:count]]


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
