"""Where a contact takes another name within a step, and the poses that are written there."""

import math

import numpy as np
import pytest

from contact_cases import random_robot, stadium
from kaidan import contact
from kaidan.contact import Feature, FeatureKind, body_table, ground_table
from kaidan.contact.door import zeros
from kaidan.contact.kernel import renaming as module
from kaidan.contact.kernel.continuation import ARM, stepped, tangent
from kaidan.contact.kernel.gaps import gap, on_flat
from kaidan.contact.kernel.renaming import (
    PLACE,
    least_room,
    name_room,
    record_renamings,
    renaming,
)
from kaidan.contact.layout import At, EventRow, Held, Log, Pose, RotationRow
from kernel_memory import called, nothing, pair_of, place_of, posed, scene, table, written

L, C_L, C_N, R = 0.6, 0.28, 0.1, 0.08
BODY = body_table(stadium(L, C_L, C_N, R))
SLOPE = -0.2
CORNER = ground_table([(-4, 0), (1, 0), (4, 3 * SLOPE)])
"""A floor that falls off from x = 1 m on."""


poses_between = called(module.poses_between)


def code(point, kind):
    return Feature(point, 0, kind).code


REAR, FRONT = code(0, FeatureKind.DISC_1), code(0, FeatureKind.DISC_2)


def names(ground, body, pair, pose):
    """Both contacts, and whether each is a vertex on the flat."""
    x, z, phi = pose
    flats = (on_flat(scene(ground, body), each, posed(x, z, phi)) for each in pair)
    return (*pair, *flats)


def placed(line, robot, x, phi):
    """The robot let down: its tables, and its pose with the way ahead and its contacts."""
    found = contact.settle(line, robot, x, phi)
    if not found.found or found.rear == found.front:
        return None
    ground, body, pair = ground_table(line), body_table(robot), (found.rear, found.front)
    phi = found.inclination
    *way, size = tangent(scene(ground, body), *pair, posed(x, found.z, phi))
    return (ground, body, Held(x, found.z, phi, *way, *pair)) if size > 0.0 else None


def step(ground, body, here, ds):
    """Pose with its way and contacts a step further; None where the corrector fails."""
    good, there, _ = stepped(scene(ground, body), Held(*here), ds)
    return there if good else None


def looked_for(ground, body, here, there, ds):
    """What `renaming` finds on a step."""
    flats = names(ground, body, here[6:], here[:3])[2:]
    rooms = [
        least_room(scene(ground, body), Held(*here), *flats, posed(*pose[:3]))
        for pose in (here, there)
    ]
    return renaming(scene(ground, body), Held(*here), ds, *flats, *rooms)


def recorded(ground, body, here, there, ds, rows=20, first=1):
    """Poses that are written within a step, and the length from pose to pose."""
    poses = nothing(Pose, rows)
    log = Log(
        table(Pose, poses), table(EventRow, 0), table(RotationRow, 0), True, first, s=2.0, leg=3
    )
    length = record_renamings(scene(ground, body), log, Held(*here), Held(*there), ds)
    log.poses.flush()
    assert np.flatnonzero(written(poses)).tolist() == list(range(first, log.n_pose))
    return poses[first : log.n_pose], length


def chord(one, other):
    return math.hypot(other[0] - one[0], other[1] - one[1], ARM * (other[2] - one[2]))


ROUGH = [(-3, -0.2), (-0.5, 0.0), (-0.2, 0.15), (0.1, -0.1), (0.3, 0.2), (0.6, 0.1), (3, 0.6)]
ROUGHER = [*ROUGH[:3], (-0.15, 0.15), (-0.1, 0.14), *ROUGH[3:]]


def renamed(count, back):
    """Steps of random robots over rough ground in which a contact takes another name."""
    rng = np.random.default_rng(7)
    found = 0
    while found < count:
        robot = random_robot(rng, least_radius=0.05)[0]
        line = ROUGH if rng.random() < 0.5 else ROUGHER
        case = placed(line, robot, float(rng.uniform(-0.7, 0.6)), 0.2)
        if case is None:
            continue
        ground, body, here = case
        ds = 0.012
        there = step(ground, body, here, ds)
        if there is not None and back:
            here = Held(*there[:3], *(-each for each in there[3:6]), *there[6:])
            there = step(ground, body, here, ds)
        if there is None:
            continue
        if names(ground, body, here[6:], here[:3]) != names(ground, body, there[6:], there[:3]):
            found += 1
            yield ground, body, here, there, ds


@pytest.mark.parametrize("back", [False, True])
def test_up_to_the_place_the_names_are_those_of_before(back):
    """And `PLACE` beyond it they are not."""
    for ground, body, here, there, ds in renamed(25, back):
        was = names(ground, body, here[6:], here[:3])
        cut = looked_for(ground, body, here, there, ds)
        assert 0.0 < cut <= ds
        for share, same in ((0.5 * cut, True), (cut - 1.01 * PLACE, True), (cut, False)):
            if share > 0.0:
                pose = step(ground, body, here, share)
                assert (names(ground, body, pose[6:], pose[:3]) == was) == same


@pytest.mark.parametrize("back", [False, True])
def test_poses_are_written_where_a_contact_takes_another_name(back):
    """Between one and the next no name changes; lengths are those of the chords."""
    for ground, body, here, there, ds in renamed(25, back):
        poses, length = recorded(ground, body, here, there, ds)
        left, path = here, 0.0
        for row in poses:
            now, pair = place_of(row), pair_of(row)
            assert names(ground, body, pair, now) != names(ground, body, left[6:], left[:3])
            onward = chord(left, now)
            # a hair before it the names are those of before
            before = step(ground, body, left, onward - 3.0 * PLACE)
            assert names(ground, body, before[6:], before[:3]) == names(
                ground, body, left[6:], left[:3]
            )
            for feature in pair:
                assert abs(gap(scene(ground, body), feature, posed(*now))[0]) < 1e-12
            path += onward
            assert row["s"] == pytest.approx(2.0 + path, abs=1e-12)
            assert row["leg"] == 3
            *way, _ = tangent(scene(ground, body), *pair, posed(*now))
            sense = math.copysign(1.0, np.dot(way, left[3:6]))
            left = (*now, *(sense * each for each in way), *pair)
        assert length == pytest.approx(path + chord(left, there), abs=1e-12)
        last = names(ground, body, left[6:], left[:3])
        # no name changes from there on, unless it does at the very end
        if last != names(ground, body, there[6:], there[:3]):
            before = step(ground, body, left, chord(left, there) - 4.0 * PLACE)
            assert names(ground, body, before[6:], before[:3]) == last


@pytest.mark.parametrize("end", [C_L, C_L - L])
def test_an_end_comes_over_a_corner(end):
    """Level, until the axle stands over the corner."""
    here = (1 - end - 0.004, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)
    if end < 0.0:  # its nose on a floor of the same height farther on
        ground = ground_table([(-4, 0), (1, 0), (1.2, -0.05), (1.4, 0), (4, 0)])
        here = (*here[:7], code(3, FeatureKind.DISC_2))
    else:
        ground = CORNER
    there = step(ground, BODY, here, 0.01)
    cut = looked_for(ground, BODY, here, there, 0.01)
    assert 0.004 - 1e-13 <= cut <= 0.004 + PLACE
    poses, _ = recorded(ground, BODY, here, there, 0.01)
    vertex = code(1, FeatureKind.VERTEX)
    pair = (vertex, here[7]) if end < 0.0 else (here[6], vertex)
    assert pair_of(poses[0]) == pair
    assert poses["x"][0] == pytest.approx(1 - end, abs=2 * PLACE)


@pytest.mark.parametrize(("place", "way"), [(-0.3, 1), (0.26, -1)])
def test_a_point_leaves_the_flat(place, way):
    """Level on two points; one of them comes to an end of the flat."""
    other = 0.1
    ground = ground_table([(-4, -2), *((x + d, h) for x in sorted((place, other))
                           for d, h in ((-1e-3, -2), (0, 0), (1e-3, -2))), (4, -2)])  # fmt: skip
    one, two = (code(int(k), FeatureKind.VERTEX) for k in np.flatnonzero(ground["z"] == 0.0))
    left = place + L - C_L if way > 0 else C_L - place  # from the end of the flat
    here = (0.0, C_N, 0.0, float(way), 0.0, 0.0, one, two)
    there = step(ground, BODY, here, left + 0.005)
    cut = looked_for(ground, BODY, here, there, left + 0.005)
    assert left - 1e-12 <= cut <= left + PLACE + 1e-12
    poses, length = recorded(ground, BODY, here, there, left + 0.005)
    assert poses["x"] == pytest.approx([way * left], abs=2 * PLACE)
    now = place_of(poses[0])
    assert length == pytest.approx(chord(here, now) + chord(now, there), abs=1e-12)


def test_both_ends_come_over_corners_within_a_step():
    """The rear one after 3 mm, the nose, on a floor of its own, 4 mm later."""
    tail, nose = -(L - C_L), C_L
    line = [(-4, 0), (tail + 0.003, 0), (0, -0.05), (0.1, 0), (nose + 0.007, 0), (4, -0.5)]
    ground = ground_table(line)
    here = (0.0, C_N, 0.0, 1.0, 0.0, 0.0, REAR, code(3, FeatureKind.DISC_2))
    there = step(ground, BODY, here, 0.01)
    poses, length = recorded(ground, BODY, here, there, 0.01)
    # beyond the corner the tail sinks by the square of 4 mm over twice its radius
    assert poses["x"] == pytest.approx([0.003, 0.007], abs=1e-5)
    one, two = code(1, FeatureKind.VERTEX), code(4, FeatureKind.VERTEX)
    assert poses["rear"]["feature"].tolist() == [one, one]
    assert poses["front"]["feature"].tolist() == [here[7], two]
    assert poses["s"] == pytest.approx([2.003, 2.007], abs=1e-5)
    assert length == pytest.approx(0.01, abs=1e-5)


def test_of_many_names_within_a_step_four_are_written():
    """The tail comes down a hill of 0.3 m in radius, points 0.6 mm apart."""
    angles = np.linspace(-0.58, 0.58, 601)
    hill = zip(0.3 * np.sin(angles), 0.3 * (np.cos(angles) - math.cos(0.58)), strict=True)
    case = placed([(-9, 0), *hill, (9, 0)], stadium(0.5, 0.25, 0.1, 0.08), 0.36, -0.05)
    assert case is not None
    ground, body, here = case
    there = step(ground, body, here, 0.01)
    poses, length = recorded(ground, body, here, there, 0.01)
    assert len(poses) == 4
    assert (np.diff(poses["rear"]["feature"]) > 0).all()
    assert length == pytest.approx(chord(here, there), abs=1e-5)


def test_nothing_is_written_where_no_name_changes_or_there_is_no_room():
    here = (0.3, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)
    poses, length = recorded(CORNER, BODY, here, step(CORNER, BODY, here, 0.01), 0.01)
    assert len(poses) == 0
    assert length == pytest.approx(0.01)
    here = (1 - C_L - 0.004, *here[1:])
    there = step(CORNER, BODY, here, 0.01)
    # two rows are kept for what ends the drive
    assert len(recorded(CORNER, BODY, here, there, 0.01, rows=4)[0]) == 1
    poses, length = recorded(CORNER, BODY, here, there, 0.01, rows=3)
    assert len(poses) == 0
    assert length == pytest.approx(chord(here, there), abs=1e-15)


@pytest.mark.parametrize(("beyond", "count"), [(0.5 * PLACE, 0), (3.5 * PLACE, 1)])
def test_a_name_that_changes_at_the_end_is_written_with_it(beyond, count):
    here = (1 - C_L - 0.004, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)
    ds = 0.004 + beyond
    assert len(recorded(CORNER, BODY, here, step(CORNER, BODY, here, ds), ds)[0]) == count


def test_a_second_name_that_changes_at_the_end_is_written_with_it_too():
    """Tail and nose come over corners; the step ends half a nanometre after the second."""
    line = [(-4, 0), (-0.317, 0), (0, -0.05), (0.1, 0), (0.287, 0), (4, -0.5)]
    ground = ground_table(line)
    here = (0.0, C_N, 0.0, 1.0, 0.0, 0.0, REAR, code(3, FeatureKind.DISC_2))
    low, high = 0.005, 0.01
    while high - low > 1e-12:
        mid = 0.5 * (low + high)
        kept = step(ground, BODY, here, mid)[7] == here[7]
        low, high = (mid, high) if kept else (low, mid)
    for beyond, count in ((0.5 * PLACE, 1), (4.0 * PLACE, 2)):
        ds = high + beyond
        assert len(recorded(ground, BODY, here, step(ground, BODY, here, ds), ds)[0]) == count


def test_no_name_is_looked_for_where_the_corrector_fails():
    """37 degrees off the line of poses it does: the step ends where it ends."""
    here = (0.3, C_N, 0.0, 0.8, 0.0, 0.6, REAR, FRONT)
    tables = scene(CORNER, BODY)
    assert renaming(tables, Held(*here), 0.01, False, False, 1.0, -1.0) == 0.01
    there = (0.31, C_N, 0.0, 0.8, 0.0, 0.6, REAR, code(1, FeatureKind.VERTEX))
    poses, length = recorded(CORNER, BODY, here, there, 0.01)
    assert len(poses) == 0
    assert length == pytest.approx(0.01)


def of(rear, front):
    """A pose on two contacts, wherever it is."""
    return Held(*6 * (math.nan,), rear, front)


def test_the_room_of_two_contacts_is_the_smaller():
    tables, pose = scene(CORNER, BODY), At(0.5, C_N, 1.0, 0.0)
    for pair in ((REAR, FRONT), (FRONT, REAR)):
        rooms = [name_room(tables, each, False, pose) for each in pair]
        assert sorted(rooms) == pytest.approx([1 - 0.5 - C_L, 1 - 0.5 + L - C_L])
        assert least_room(tables, of(*pair), False, False, pose) == min(rooms)
    # a vertex under the flat, and one that is not
    point = code(1, FeatureKind.VERTEX)
    pose = At(1.0, C_N, 1.0, 0.0)
    on = least_room(tables, of(point, REAR), True, False, pose)
    assert on == pytest.approx(C_L)
    assert least_room(tables, of(REAR, point), False, True, pose) == on


# --- poses between two of a line ----------------------------------------------------------------

NOSING = 0.17


def over_a_nosing(centre):
    """The rear disc on the floor, its flat on a nosing at (0, 170 mm): pose by geometry."""
    to = complex(0.0, NOSING) - complex(centre, R)
    phi = math.atan2(to.imag, to.real) + math.asin(R / abs(to))
    com = complex(centre, R) + complex(L - C_L, C_N - R) * complex(math.cos(phi), math.sin(phi))
    return com.real, com.imag, phi


def table_of(*poses):
    """Rows of poses, with their arclength last."""
    rows = zeros(Pose, len(poses))
    for row, (x, z, phi, rear, front, s) in zip(rows, poses, strict=True):
        row["x"], row["z"], row["inclination"], row["s"] = x, z, phi, s
        row["rear"]["feature"], row["front"]["feature"] = rear, front
    return rows


def line_over_a_nosing(first, last):
    """Poses along the way of the rear end, and the arclength up to each."""
    line = np.array([over_a_nosing(each) for each in np.linspace(first, last, 4001)])
    moved = np.linalg.norm(np.diff(line, axis=0) * [1.0, 1.0, ARM], axis=1)
    return line, np.concatenate([[0.0], np.cumsum(moved)])


BEGIN = -0.55
LINE, ALONG = line_over_a_nosing(BEGIN, -0.35)


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("ends", [(1000, 1100), (200, 2200)])
def test_poses_between_two_lie_on_the_line(ends, back):
    """By the arclength of the true course, of which chords are short by the square of a step."""
    ground = ground_table([(-4, 0), (0, 0), (0, NOSING), (4, NOSING)])
    pair = code(0, FeatureKind.DISC_1), code(2, FeatureKind.VERTEX)
    first, then = ends[::-1] if back else ends
    rows = [(*LINE[k], *pair, 5.0 + abs(ALONG[k] - ALONG[first])) for k in (first, then)]
    poses = table_of(rows[0], *rows, rows[0])
    poses["leg"][1] = 2
    shares = np.array([0.0, 0.25, 0.6, 1.0])
    between = zeros(Pose, 4)
    poses_between((ground, BODY), poses, np.ones(4, dtype=np.int64), shares, between)
    length = abs(ALONG[then] - ALONG[first])
    for share, row in zip(shares, between, strict=True):
        s = ALONG[first] + (ALONG[then] - ALONG[first]) * share
        expected = [np.interp(s, ALONG, LINE[:, k]) for k in range(3)]
        off = 1e-9 + 0.3 * length**3
        assert place_of(row) == pytest.approx(tuple(expected), abs=off)
        assert row["s"] == pytest.approx(5.0 + share * length, abs=off)
        assert pair_of(row) == pair
        assert row["leg"] == 2


def test_a_pose_between_is_by_the_names_that_hold_there():
    """Half of the step lies beyond the corner."""
    here = (1 - C_L - 0.004, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)
    there = step(CORNER, BODY, here, 0.01)
    poses = table_of((*here[:3], *here[6:], 0.0), (*there[:3], *there[6:], chord(here, there)))
    between = zeros(Pose, 2)
    rows, shares = np.zeros(2, dtype=np.int64), np.array([0.3, 0.7])
    poses_between((CORNER, BODY), poses, rows, shares, between)
    assert between["front"]["feature"].tolist() == [FRONT, code(1, FeatureKind.VERTEX)]
    assert between["rear"]["feature"].tolist() == [REAR, REAR]


@pytest.mark.parametrize("back", [False, True])
def test_a_pose_between_two_on_a_steep_slope(back):
    """70 degrees: the way is up, hardly ahead."""
    slope = math.radians(70)
    u = complex(math.cos(slope), math.sin(slope))
    ground = ground_table([(s * u.real, s * u.imag) for s in (-4.0, 4.0)])
    k = int(np.flatnonzero(ground["x"] < 0.0)[-1])
    pair = code(k, FeatureKind.DISC_1), code(k, FeatureKind.DISC_2)
    one, other = ((s + 1j * C_N) * u for s in ((0.2, 0.1) if back else (0.1, 0.2)))
    poses = table_of(
        (one.real, one.imag, slope, *pair, 1.0), (other.real, other.imag, slope, *pair, 1.1)
    )
    between = zeros(Pose, 1)
    poses_between((ground, BODY), poses, np.zeros(1, dtype=np.int64), np.array([0.5]), between)
    half = (0.15 + 1j * C_N) * u
    found = [*place_of(between[0]), float(between["s"][0])]
    assert found == pytest.approx([half.real, half.imag, slope, 1.05], abs=1e-9)


def test_a_pose_so_far_that_twenty_steps_do_not_lead_there_is_told_where_it_is():
    """The robot is said to go on by 5 m, and bends by more than the corrector finds at once."""
    ground = ground_table([(-4, 0), (0, 0), (0, NOSING), (4, NOSING)])
    pair = code(0, FeatureKind.DISC_1), code(2, FeatureKind.VERTEX)
    poses = table_of((*LINE[0], *pair, 1.0), (*LINE[100], *pair, 6.0))
    between = zeros(Pose, 1)
    poses_between((ground, BODY), poses, np.zeros(1, dtype=np.int64), np.array([1.0]), between)
    end = float(between["rear"]["x"][0])
    assert BEGIN + 0.2 < end < -0.05
    line, along = line_over_a_nosing(BEGIN, end)
    found = [*place_of(between[0]), float(between["s"][0])]
    assert found[:3] == pytest.approx(line[-1], abs=1e-9)
    assert found[3] == pytest.approx(1.0 + along[-1], rel=0.02)  # steps are chords
