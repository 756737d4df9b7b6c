"""Tables that the kernel is given of ground and robot, by hand and by geometry."""

import math
from itertools import pairwise

import numpy as np
import pytest

from kaidan.contact.tables import (
    BEYOND,
    SHARPEST,
    body_table,
    ground_table,
    mirror,
)

# ground


def points_of(table):
    return np.stack([table["x"], table["z"]], 1)


def test_the_ground_of_two_steps():
    """Its points, and one 30 m beyond each end: level over the riser with which it ends."""
    points = [(-1, -0.1), (0, 0), (0, 0.2), (0.3, 0.2), (0.3, 0.4)]
    away = BEYOND / math.hypot(1, 0.1)
    ends = (-1 - away, -0.1 - 0.1 * away), (0.3 + BEYOND, 0.4)
    table = ground_table(points)
    expected = np.array([ends[0], *points[1:], ends[1]])  # the first one lies on the way
    assert points_of(table) == pytest.approx(expected, abs=1e-12)
    step = np.diff(expected, axis=0)
    assert table["length"][:-1] == pytest.approx(np.hypot(*step.T))
    unit = step / np.hypot(*step.T)[:, None]
    assert np.stack([table["u_x"], table["u_z"]], 1) == pytest.approx(
        np.vstack([unit, unit[-1]]), abs=1e-12
    )
    assert table["convex"].tolist() == [False, False, True, False, True, False]
    begins = ground_table([(0, 0.5), (0, 0.2), (1, 0.2)])
    assert points_of(begins) == pytest.approx(
        np.array([(-BEYOND, 0.5), (0, 0.5), (0, 0.2), (1 + BEYOND, 0.2)])
    )


@pytest.mark.parametrize("seed", range(8))
def test_a_finer_profile_is_the_same_ground(seed):
    """Points on straight lines are dropped, however many, short and steep."""
    rng = np.random.default_rng(seed)
    points = np.cumsum(np.column_stack([rng.uniform(0.01, 0.4, 9), rng.uniform(-0.5, 0.5, 9)]), 0)
    fine = [points[0]]
    for one, two in pairwise(points):
        shares = np.sort(rng.uniform(0.0, 1.0, rng.integers(0, 6)))
        fine += [one + share * (two - one) for share in shares]
        fine.append(two)
    once = ground_table(points)
    assert len(once) == len(points)  # both ends are farther away, on the same lines
    # m: the points that were put between are rounded
    again = ground_table(np.array(fine))
    for field in once.dtype.names:
        assert again[field] == pytest.approx(once[field], abs=1e-9)


@pytest.mark.parametrize("slope", [-2.0, 0.0, 0.4])
def test_a_point_beside_the_line_is_kept(slope):
    """From 1e-11 m on; 10 um from the next point from a tenth of that on: it turns it as much."""
    along, up = np.array([1.0, slope]), np.array([-slope, 1.0]) / math.hypot(1, slope)
    length, near = math.hypot(1, slope), 1e-5
    ends = (0.0, 1.0 + max(-slope, 0.0)), (*along,), (1.0, slope + 1.0), (2.0, slope + 1.0)
    straight = [ends[0], (0.0, 0.0), *ends[1:]]
    for share, off, kept in (
        (0.5, 3e-11, True), (0.5, 1e-12, False), (near / length, 3e-12, True),
        (near / length, 3e-13, False), (1 - near / length, 3e-12, True),
        (1 - near / length, 3e-13, False),
    ):  # fmt: skip
        points = [*straight[:2], share * along + off * up, *straight[2:]]
        assert len(ground_table(points)) - len(ground_table(straight)) == kept


def test_faces_that_fold_have_tips_above_and_pits_below():
    above = ground_table([(-1, 0), (0, 0), (0, 0.3), (0, 0.2), (1, 0.2)])
    assert above[["z", "convex"]][1:-1].tolist() == [(0.0, False), (0.3, True), (0.2, False)]
    below = ground_table([(-1, 0.1), (0, 0.1), (0, -0.1), (0, 0.3), (1, 0.3)])
    assert below[["z", "convex"]][1:-1].tolist() == [(0.1, True), (-0.1, False), (0.3, True)]


def test_the_ground_of_two_points_and_of_a_hollow():
    floor = ground_table([(-1, 0.2), (1, 0.2)])
    assert floor[["x", "z", "convex"]].tolist() == [
        (-1 - BEYOND, 0.2, False),
        (1 + BEYOND, 0.2, False),
    ]
    hollow = ground_table([(0, 1.0), (1, 0.2), (2, 0.0), (3, 0.3), (4, 0.3)])
    assert hollow["convex"].tolist() == [False, False, False, True, False]
    # it is continued along its last piece, whatever came before
    ends = ground_table([(0, 0), (1, 0), (1, 0.5), (2, 0.5), (2.5, 1.0)])
    assert points_of(ends)[-1] == pytest.approx(np.array([2.5, 1.0]) + BEYOND / math.sqrt(2))


def test_of_a_face_that_folds_only_its_ends_and_what_lies_beyond_them_count():
    def heights(*face):
        points = [(-1, face[0]), *((0, z) for z in face), (1, face[-1])]
        return ground_table(points)["z"][1:-1].tolist()

    assert heights(0.0, 0.1, 0.3) == [0.0, 0.3]
    assert heights(0.0, 0.2, 0.1, 0.15, 0.12, 0.3) == [0.0, 0.3]
    assert heights(0.3, 0.1, 0.2, 0.0) == [0.3, 0.0]
    assert heights(0.0, 0.2, 0.5, 0.1, 0.4, 0.3) == [0.0, 0.5, 0.3]
    assert heights(0.0, 0.2, -0.1, 0.3) == [0.0, -0.1, 0.3]
    assert heights(0.1, 0.4, 0.0, 0.3) == [0.1, 0.4, 0.0, 0.3]
    # as high as an end is not beyond it
    assert heights(0.0, 0.3, 0.1, 0.3) == [0.0, 0.3]
    assert heights(0.0, 0.2, 0.0, 0.3) == [0.0, 0.3]


def test_every_face_that_folds_is_unfolded():
    """Of three the first and the last do; the one between them goes up straight."""
    points = [(-1, 0), (0, 0), (0, 0.2), (0, 0.1), (0, 0.3)]
    points += [(1, 0.3), (1, 0.4), (1, 0.45), (1, 0.6)]
    points += [(2, 0.6), (2, 0.8), (2, 0.7), (2, 0.75), (2, 1.0), (3, 1.0)]
    found = points_of(ground_table(points))[1:-1].tolist()
    assert found == [[0, 0], [0, 0.3], [1, 0.3], [1, 0.6], [2, 0.6], [2, 1.0]]
    # the lower end of a face counts as the upper one does
    down = ground_table([(-1, 0.3), (0, 0.3), (0, 0.1), (0, 0.2), (0, 0.0), (1, 0.0)])
    assert down["z"][1:-1].tolist() == [0.3, 0.0]
    pit = ground_table([(-1, 0.3), (0, 0.3), (0, -0.1), (0, 0.2), (0, 0.0), (1, 0.0)])
    assert pit["z"][1:-1].tolist() == [0.3, -0.1, 0.0]


@pytest.mark.parametrize(
    ("points", "text"),
    [
        ([(0, 0), (0, 1), (2, 1), (1.5, 1), (1.0, 1)], "x runs backwards after point 2"),
        ([(0, 0), (0, 0)], "at least two different points"),
        ([(0, 0), (math.nan, 0)], "must be finite"),
        ([(0, 0, 0), (1, 0, 0)], r"shape \(n, 2\)"),
        ([0, 1], r"shape \(n, 2\)"),
    ],
)
def test_what_is_no_ground(points, text):
    with pytest.raises(ValueError, match=text):
        ground_table(points)


# robot


def discs(row):
    """Middles and radii of both discs of a part."""
    return [(np.array([disc["x"], disc["z"]]), disc["r"]) for disc in (row["one"], row["two"])]


def down(one, two):
    """Unit vector from the middles of two discs to the line that touches both from below."""
    (a, r_a), (b, r_b) = one, two
    z = complex(*(b - a))
    lean = math.acos((r_a - r_b) / abs(z))
    both = [z / abs(z) * np.exp(1j * sign * lean) for sign in (-1, 1)]
    lower = min(both, key=lambda each: each.imag)
    return np.array([lower.real, lower.imag])


@pytest.mark.parametrize("seed", range(6))
def test_a_part_by_its_lower_tangent(seed):
    rng = np.random.default_rng(seed)
    for _ in range(20):
        x1, z1, x2, z2 = rng.uniform(-1, 1, 4)
        r1, r2 = rng.uniform(0.01, 0.1, 2)
        if math.hypot(x2 - x1, z2 - z1) < 0.15:
            continue
        (row,) = body_table([[x1, z1, r1, x2, z2, r2]])
        one, two = discs(row)
        assert [*row["one"].item(), *row["two"].item()] == [x1, z1, r1, x2, z2, r2]
        e = (two[0] - one[0]) / math.dist(two[0], one[0])
        assert (row["e_x"], row["e_z"]) == pytest.approx(tuple(e))
        n = down(one, two)
        assert row["sine"] == pytest.approx(n @ e)
        assert row["cosine"] == pytest.approx(math.sqrt(1 - (n @ e) ** 2))
        ends = [middle + r * n for middle, r in (one, two)]
        assert row["flat"] == pytest.approx(math.dist(*ends))


@pytest.mark.parametrize("turn", [0.3, 2.5, -0.4, -2.2])
@pytest.mark.parametrize("radii", [(0.0, 0.0), (0.0, 0.05), (0.05, 0.0), (0.2 * SHARPEST, 0.03)])
def test_a_sharp_end_grows_upward(turn, radii):
    """The line that touches the part from below touches it where it did."""
    a = np.array([0.1, -0.1])
    b = a + np.array([math.cos(turn), math.sin(turn)])
    (row,) = body_table([[*a, radii[0], *b, radii[1]]])
    n = down((a, radii[0]), (b, radii[1]))
    for (middle, r), (old, was) in zip(discs(row), ((a, radii[0]), (b, radii[1])), strict=True):
        assert r == pytest.approx(max(was, SHARPEST))
        assert middle + r * n == pytest.approx(old + was * n, abs=1e-12)


@pytest.mark.parametrize(
    ("part", "disc"),
    [
        ((0.1, 0.2, 0.05, 0.1, 0.2, 0.05), (0.1, 0.2, 0.05)),
        ((0.1, 0.2, 0.05, 0.12, 0.2, 0.01), (0.1, 0.2, 0.05)),
        ((0.12, 0.2, 0.01, 0.1, 0.2, 0.05), (0.1, 0.2, 0.05)),
        ((0.0, 0.0, 0.1, 0.05, 0.0, 0.05), (0.0, 0.0, 0.1)),  # touches it from within
        ((0.3, 0.0, 0.0, 0.3, 0.0, 0.0), (0.3, 0.0, SHARPEST)),
    ],
)
def test_of_a_disc_within_another_the_larger_is_the_part(part, disc):
    (row,) = body_table([part], [1])
    assert row.item() == (tuple(disc), tuple(disc), 1, 0, 0, 0, 1, 0, 1, 1)


def test_parts_that_are_none():
    part = [0.0, 0.0, 0.1, 0.5, 0.0, 0.1]
    assert len(body_table([part] * 16)) == 16
    for parts in ([part] * 17, [], part, [part[:5]], [[part]]):
        with pytest.raises(ValueError, match="1 <= m <= 16"):
            body_table(parts)
    with pytest.raises(ValueError, match="must not be negative"):
        body_table([[*part[:5], -0.1]])
    for kinds in ([0, 1], [3], [0.5], [[0]]):
        with pytest.raises(ValueError, match="one of 0"):
            body_table([part], kinds)
    # discs that overlap are no disc within another
    (row,) = body_table([[0.0, 0.0, 0.04, 0.05, 0.0, 0.03]])
    assert row["flat"] == pytest.approx(math.sqrt(0.05**2 - 0.01**2))
    with pytest.raises(ValueError, match="every number must be finite"):
        body_table([[*part[:5], math.nan]])


def test_the_mirror_image_swaps_the_ends():
    points, parts = mirror([(0, 0), (1, 0.2)], [[0.1, -0.2, 0.05, 0.4, -0.3, 0.06]])
    assert points.tolist() == [[-1.0, 0.2], [0.0, 0.0]]
    assert parts.tolist() == [[-0.4, -0.3, 0.06, -0.1, -0.2, 0.05]]
    assert not np.signbit(points[1, 0])  # zero has no sign
    assert not np.signbit(mirror([(0, 0), (1, 0)], [[0.0, 0.0, 0.1, 0.5, 0.0, 0.1]])[1][0, 3])
    again = mirror(points, parts)
    assert again[0].tolist() == [[0.0, 0.0], [1.0, 0.2]]
    assert again[1].tolist() == [[0.1, -0.2, 0.05, 0.4, -0.3, 0.06]]
