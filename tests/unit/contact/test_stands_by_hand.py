"""What carries a pose, what passes under a flat and what comes down at once, by rigid geometry."""

import itertools
import math

import numpy as np
import pytest

from contact_cases import stadium
from kaidan.contact import PartKind, body_table, ground_table
from kaidan.contact.door import table_of, zeros
from kaidan.contact.kernel.impact import impact_speed
from kaidan.contact.kernel.passings import is_reported, nosings_passed
from kaidan.contact.kernel.supports import describe, find_supports, is_same, stand_alike
from kaidan.contact.kernel.toppling import AT_ONCE
from kaidan.contact.layout import (
    FACE,
    NOSING,
    NOWHERE,
    PART,
    POINT,
    TREAD,
    VERTEX,
    EventRow,
    Load,
    Passed,
    Pose,
    RotationRow,
    Stance,
    Support,
)
from kernel_memory import made, numbers, posed, scene, table

ROUNDING = 1e-12
TOUCH = 1e-7
STEEP = math.radians(60.0)


def flat(part):
    """Ends of the lower common tangent of two discs and its unit normal, as complex numbers."""
    a, b = complex(*part[:2]), complex(*part[3:5])
    e = (b - a) / abs(b - a)
    sine = (part[2] - part[5]) / abs(b - a)
    down = -1j * e if b.real >= a.real else 1j * e
    n = sine * e + math.sqrt(1.0 - sine**2) * down
    return a + part[2] * n, b + part[5] * n, n


def spikes(*places):
    """Ground of such points, and the number of each in the table."""
    points = sorted(places, key=lambda p: p.real)
    between = [complex(0.5 * (p + q).real, min(p.imag, q.imag) - 1.0)
               for p, q in itertools.pairwise(points)]  # fmt: skip
    ends = [points[0] - 2 - 2j, points[-1] + 2 - 2j]
    every = sorted([*points, *between, *ends], key=lambda p: p.real)
    ground = ground_table([(p.real, p.imag) for p in every])
    return ground, [int(np.argmin(np.abs(ground["x"] - p.real))) for p in places]


# --- supports -----------------------------------------------------------------------------------

TAPERED = [-0.3, 0.02, 0.08, 0.2, -0.01, 0.05]
BACKWARD = [0.25, -0.02, 0.03, -0.3, 0.05, 0.07]  # the second disc lies behind the first
RAISED = [-0.3, 0.5, 0.05, 0.2, 0.5, 0.05]
X, Z, PHI = 1.3, 0.7, 0.2


def at_pose(place):
    return complex(X, Z) + place * np.exp(1j * PHI)


def carried(part, *shares):
    """Ground of spikes along a part's flat, and a pose carried by the first two of them."""
    one, other, n = flat(part)
    ground, points = spikes(*(at_pose(one + share * (other - one)) for share in shares))
    return ground, points, -n * np.exp(1j * PHI)


def find(ground, points, parts, *, part, slots=5, treads=None, kinds=None, postures=(None,)):
    bodies = np.concatenate([body_table(own or parts, kinds) for own in postures])
    rear, front = (POINT * k + PART * part + VERTEX for k in points[:2])
    pose = {
        "x": X, "z": Z, "inclination": PHI, "rear.feature": rear, "front.feature": front,
        "rear.x": 1.1, "rear.z": 0.4, "front.x": 1.7, "front.z": 0.6,
        "rear.n_x": -0.6, "rear.n_z": 0.8, "front.n_x": 0.28, "front.n_z": 0.96,
    }  # fmt: skip
    poses = made(Pose, *[pose] * len(postures))
    found = zeros(Support, slots * len(poses))
    supports = table(Support, found)
    treads = 0.01 * np.arange(len(ground)) if treads is None else treads
    most = find_supports(
        scene(ground, bodies), len(parts), table(Pose, poses), numbers(treads),
        Stance(True, STEEP, TOUCH, 0.6), supports, slots,
    )  # fmt: skip
    supports.flush()
    return most, found.reshape(len(poses), slots)


@pytest.mark.parametrize("part", [TAPERED, BACKWARD])
def test_a_pose_stands_on_what_carries_it_and_on_nosings_between(part):
    ground, points, normal = carried(part, 0.2, 0.9, 0.5, 0.7)
    most, (found,) = find(ground, points, [RAISED, part], part=1)
    assert most == 4
    assert found["is_one"].tolist() == [True] * 4 + [False]
    between = sorted(points[2:])
    assert found["point"].tolist() == [*points[:2], *between, NOWHERE]
    assert found["place"][:4].tolist() == [NOSING] * 4
    assert found["curvature"][:4].tolist() == [0.0] * 4
    assert found["tread"][:4] == pytest.approx(0.01 * found["point"][:4])
    assert np.isnan(found["lift"][:4]).all()
    places = [
        (1.1 - X, 0.4 - Z),
        (1.7 - X, 0.6 - Z),
        *((ground["x"][k] - X, ground["z"][k] - Z) for k in between),
    ]
    stands = np.transpose([found["x"][:4], found["z"][:4]])
    np.testing.assert_allclose(stands, places, atol=ROUNDING)
    tilts = [math.atan2(-0.6, 0.8), math.atan2(0.28, 0.96), *[np.pi / 2 - np.angle(normal)] * 2]
    np.testing.assert_allclose(found["normal"][:4], tilts, atol=ROUNDING)


def test_supports_beyond_the_room_are_counted_and_left_out():
    ground, points, _ = carried(TAPERED, 0.2, 0.9, 0.5, 0.7)
    for slots in (2, 3):
        most, (found,) = find(ground, points, [TAPERED], part=0, slots=slots)
        assert most == 4
        inner = sorted(points[2:])
        assert found["point"].tolist() == [*points[:2], *inner][:slots]


def test_a_nosing_without_a_tread_is_nowhere():
    ground, points, _ = carried(TAPERED, 0.2, 0.9, 0.5)
    treads = 0.01 * np.arange(len(ground))
    treads[points[1:]] = math.nan
    _, (found,) = find(ground, points, [TAPERED], part=0, treads=treads)
    assert found["point"][:3].tolist() == [points[0], NOWHERE, NOWHERE]


def test_a_belly_carries_no_grouser_and_each_pose_has_its_own_posture():
    ground, points, _ = carried(TAPERED, 0.2, 0.9, 0.5)
    most, _ = find(ground, points, [TAPERED], part=0, kinds=[PartKind.BELLY])
    assert most == 2
    two = [[RAISED, RAISED], [RAISED, TAPERED]]
    most, found = find(ground, points, two[0], part=1, postures=two)
    assert most == 3
    assert found["is_one"][:, 2].tolist() == [False, True]


@pytest.mark.parametrize("gap", [0.003, -0.004])
@pytest.mark.parametrize("disc", [0, 3])
def test_a_belt_beside_passes_a_nosing_another_way(disc, gap):
    """A flipper whose end is off a nosing on the track's flat; its gap, and the track's from it."""
    one, other, n = flat(TAPERED)
    place = one + 0.2 * (other - one)
    end, far = place - (0.06 + gap) * n, place - 0.4 * n  # it leads away from the ground
    flipper = [0.0] * 6
    flipper[disc : disc + 3] = end.real, end.imag, 0.06
    flipper[3 - disc : 6 - disc] = far.real, far.imag, 0.06
    ground, points, _ = carried(TAPERED, 0.2, 0.9)
    how = {"part": 0, "kinds": [PartKind.TRACK, PartKind.FLIPPER]}
    _, (found,) = find(ground, points, [TAPERED, flipper], **how)
    assert found["beside"][0] == pytest.approx(abs(gap), abs=1e-9)
    assert found["beside"][1] > 0.1
    _, (found,) = find(ground, points, [TAPERED, flipper], **how | {"part": 1})
    assert found["beside"][0] == pytest.approx(0.0, abs=1e-9)
    for kinds in ([PartKind.TRACK] * 2, [PartKind.TRACK, PartKind.BELLY]):  # one belt, or none
        _, (found,) = find(ground, points, [TAPERED, flipper], part=0, kinds=kinds)
        assert found["beside"][0] == math.inf
    # another flat passes it the same way
    _, (found,) = find(ground, points, [TAPERED, TAPERED], **how)
    assert found["beside"][:2].tolist() == [math.inf] * 2


def described(ground, parts, feature, climbs):
    """Support at a contact of the pose; what is not written of it is -9."""
    pose = table(Pose, made(Pose, {
        "x": X, "z": Z, "inclination": PHI, "rear.feature": feature, "rear.x": X - 9.0,
    }))[0]  # fmt: skip
    names = ("x", "z", "tread", "curvature", "lift", "beyond", "flat", "beside", "point", "place")
    found = table(Support, made(Support, dict.fromkeys(names, -9)))[0]
    place = posed(X, Z, PHI)
    describe(
        scene(ground, body_table(parts)),
        pose,
        pose.rear,
        place,
        Stance(climbs, STEEP, TOUCH, 0.6),
        found,
    )
    return found


@pytest.mark.parametrize("beyond", [0.02, -0.02])
@pytest.mark.parametrize("part", [TAPERED, BACKWARD])
def test_a_nosing_under_an_arc_has_the_curvature_of_its_disc(part, beyond):
    one, other, _ = flat(part)
    along = (other - one) / abs(other - one)
    place = other + beyond * along if beyond > 0 else one + beyond * along
    ground, (k,) = spikes(at_pose(place))
    found = described(ground, [RAISED, part], POINT * k + PART, True)
    radius = part[5] if beyond > 0 else part[2]
    assert found.curvature == pytest.approx(1.0 / radius, abs=ROUNDING)
    assert found.place == NOSING
    assert found.point == k


ZIGZAG = ground_table([(-3, 0.0), (0, 0.0), (0.1, 0.4), (1.0, 0.5), (1.1, 0.1), (4, 0.1)])
"""A floor, a face of 76 degrees, a slope, a face that falls, a floor; each is one segment."""


@pytest.mark.parametrize("climbs", [True, False])
@pytest.mark.parametrize("disc", [1, 2])
@pytest.mark.parametrize("x", [-1.0, 0.05, 0.5, 1.05])
def test_an_end_stands_on_a_tread_or_a_face_below_its_edge(x, disc, climbs):
    k = int(np.flatnonzero(ZIGZAG["x"] <= x)[-1])
    found = described(ZIGZAG, [RAISED, TAPERED], POINT * k + PART + disc, climbs)
    own = TAPERED[3 * disc - 3 : 3 * disc]
    assert found.curvature == pytest.approx(1.0 / own[2], abs=ROUNDING)
    level = found.flat
    if disc == 1:  # farther back it comes onto the flat
        normal = -flat(TAPERED)[2] * np.exp(1j * PHI)
        assert level == pytest.approx(math.atan2(normal.real, normal.imag), abs=ROUNDING)
    else:
        assert math.isnan(level)
    face = x in (0.05, 1.05)
    assert found.place == (FACE if face else TREAD)
    if climbs and x == 0.05:
        axle = at_pose(complex(*own[:2])).imag
        assert found.point == k + 1
        assert found.lift == pytest.approx(0.4 - axle, abs=ROUNDING)
        return
    behind = climbs and x == 0.5  # a tread behind its nosing
    assert found.point == (k if behind else -9)  # else as it was
    assert math.isnan(found.lift)
    if behind:
        beyond = X - 9.0 - ZIGZAG["x"][k]
        assert found.beyond == pytest.approx(beyond, abs=ROUNDING)


def test_what_is_the_same_to_a_tenth_of_a_micrometre():
    nan, huge = math.nan, 1e10
    assert is_same(nan, nan)
    assert not is_same(nan, 0.0)
    assert not is_same(0.0, nan)
    assert is_same(0.1, 0.1 + 1e-9)
    assert not is_same(0.1, 0.1 + 2e-7)
    assert is_same(huge, huge)
    assert not is_same(huge, huge + 1.0)
    assert not is_same(math.inf, 0.1)
    assert is_same(-math.inf, -math.inf)


@pytest.mark.parametrize("name", Support.__slots__)
@pytest.mark.parametrize("slot", [0, 2])
def test_poses_stand_alike_if_all_but_the_point_is_alike(name, slot):
    """Three slots of which the second is empty, so what stands there counts for nothing."""
    one = dict(zip(Support.__slots__, range(2, 14), strict=True))
    loads = [Load(1.0, 1.0, 1.0)] * 2

    def rows():
        return [Support(**one | {"is_one": k % 3 != 1}) for k in range(6)]

    supports = rows()
    supports[4].x = 9.0
    assert stand_alike(supports, 3, loads, 0, 1)
    changed = supports[3 + slot]
    setattr(changed, name, False if name == "is_one" else getattr(changed, name) + 1)
    assert stand_alike(supports, 3, loads, 0, 1) == (name == "point")
    supports = rows()
    supports[3 + slot].point = NOWHERE
    assert not stand_alike(supports, 3, loads, 0, 1)


@pytest.mark.parametrize("name", Load.__slots__)
def test_poses_under_other_loads_do_not_stand_alike(name):
    loads = [Load(1.0, 1.0, 1.0), Load(1.0, 1.0, 1.0)]
    supports = table(Support, 2)
    assert stand_alike(supports, 1, loads, 0, 1)
    setattr(loads[1], name, 1.5)
    assert not stand_alike(supports, 1, loads, 0, 1)


# --- nosings that pass --------------------------------------------------------------------------

NO_PASSING = (-9.0, False, -9, -9, -9, -9.0)
FLAT = [-0.25, 0.1, 0.1, 0.25, 0.1, 0.1]  # the centroid on the flat's line


def passed(places, events=(), *, parts=(FLAT,), kinds=None, rows=20):
    ground, points = spikes(*(complex(x, 0.0) for x in places))
    poses = table(Pose, made(Pose, {"s": 5.0}, {"s": 7.0, "x": 1.0}))
    found = table_of(Passed, [NO_PASSING] * rows)
    passing = table(Passed, found)
    count = nosings_passed(
        scene(ground, body_table(list(parts), kinds)), poses,
        table(EventRow, made(EventRow, *events)), numbers([0], int), TOUCH, 0.35, passing,
    )  # fmt: skip
    passing.flush()
    return points, count, found


def test_nosings_reached_and_left_in_a_drive_of_a_metre():
    """Along the flat they lie 0.25 m ahead of where they lie from the centroid."""
    points, count, found = passed([-0.2, 0.2, 0.5, 0.9, 1.2])
    assert count == 4  # that at half a metre lies under neither pose
    share = [0.05, 0.45, 0.65, 0.95]
    np.testing.assert_allclose(found["share"][:4], share, atol=ROUNDING)
    np.testing.assert_allclose(found["s"][:4], [5.1, 5.9, 6.3, 6.9], atol=ROUNDING)
    assert found["reached"][:4].tolist() == [False, False, True, True]
    assert found["point"][:4].tolist() == [points[k] for k in (0, 1, 3, 4)]
    assert set(found[4:].tolist()) == {NO_PASSING}


def test_passings_beyond_the_room_are_counted_and_left_out():
    _, count, found = passed([-0.2, 0.2, 0.9, 1.2], rows=3)
    assert count == 4
    assert NO_PASSING not in found.tolist()


def test_a_belly_and_a_part_elsewhere_do_not_keep_the_next_part_from_passing():
    high = [-0.25, 0.4, 0.1, 0.25, 0.4, 0.1]
    kinds = [PartKind.BELLY, PartKind.TRACK, PartKind.TRACK]
    _, count, found = passed([0.9], parts=(FLAT, high, FLAT), kinds=kinds)
    assert count == 1
    assert found["part"][0] == 2


@pytest.mark.parametrize("name", ["feature", "other"])
@pytest.mark.parametrize("s", [4.0, 5.0, 6.0, 7.0, 8.0])
def test_an_event_of_the_nosing_between_the_poses_tells_of_it(s, name):
    points, _, _ = passed([0.2, 0.9])
    both = {"feature": -1, "other": -1, "s": s}
    before = both | {"s": 3.0}
    tells = both | {name: POINT * points[1] + PART * 3}
    for told in ([before, tells], [before, before, tells]):
        _, count, _ = passed([0.2, 0.9], told)
        assert count == (1 if 5.0 <= s <= 7.0 else 2)


def told(name, feature):
    """Events of one row."""
    return table(EventRow, made(EventRow, {"feature": -1, "other": -1, name: feature}))


@pytest.mark.parametrize("name", ["feature", "other"])
def test_an_event_of_something_else_tells_nothing(name):
    for feature in (POINT * 3 + 1, POINT * 3 + 2, POINT * 2, POINT * 4, 0, -1):
        assert not is_reported(told(name, feature), 0, 1.0, 3)
    assert is_reported(told(name, POINT * 3), 0, 1.0, 3)
    assert is_reported(told(name, 0), 0, 1.0, 0)  # the first point under the first part


# --- what comes down at once --------------------------------------------------------------------

L, R, C_N, RATE = 0.5, 0.08, 0.15, 1.25


def speed(slope, *more, parts=None, lift=0.0, turned=0.0):
    """Speed at which a track of 0.5 m comes down flat on a slope, about its rear end."""
    turn = np.exp(1j * slope)
    ends = [3.0 * turn * k for k in (-1, 1)]
    ground = ground_table([(p.real, p.imag) for p in ends])
    parts = parts or [stadium(L, 0.3, C_N, R)[0], *more]
    rear = complex(*parts[0][:2])  # about which it is turned
    centre = (0.7 + 1j * (parts[0][2] + lift) - rear * np.exp(1j * turned)) * turn
    end = {"end.x": centre.real, "end.z": centre.imag, "end.inclination": slope + turned}
    rows = table(RotationRow, made(RotationRow, {}, end | {"rate_before": RATE}))
    return impact_speed(scene(ground, body_table(parts)), rows, 1)


def tip(reach, gap, radius=0.05):
    """A part beyond the front tip, or the rear one, whose far end is so far off the ground."""
    start = 0.3 if reach > 0 else -0.2
    return [start, R - C_N, R, start + reach, radius - C_N + gap, radius]


@pytest.mark.parametrize("slope", [0.0, 0.35, -0.2])
def test_the_flat_comes_down_with_its_whole_length(slope):
    assert speed(slope) == pytest.approx(RATE * L, abs=1e-9)
    assert speed(slope, lift=1e-5) == 0.0  # nothing touches


@pytest.mark.parametrize("slope", [0.0, 0.35, -0.2])
@pytest.mark.parametrize("reach", [0.3, -0.25])
@pytest.mark.parametrize(("turns", "share"), [(0.5, 1.0), (1.25, 0.75), (1.75, 0.25), (2.1, 0.0)])
def test_what_would_touch_within_a_turn_counts_by_its_share(slope, reach, turns, share):
    """By the turn about the end of the track that is farther from it: gap over distance."""
    arm = L + abs(reach)
    flipper = tip(reach, turns * AT_ONCE * arm)
    expected = RATE * (L + share * abs(reach))
    assert speed(slope, flipper) == pytest.approx(expected, abs=1e-9)
    tail = [-0.2, R - C_N, R, -0.2, R - C_N + 0.3, R]
    parts = [tail, flipper, stadium(L, 0.3, C_N, R)[0]]
    assert speed(slope, parts=parts) == pytest.approx(expected, abs=1e-9)


def test_of_two_that_all_but_touch_the_smaller_share_counts():
    front = tip(0.3, 1.25 * AT_ONCE * (L + 0.3))  # counts by three quarters
    rear = tip(-0.25, 1.5 * AT_ONCE * (L + 0.25))  # by a half
    # both by a half: more than the front one by three quarters
    assert speed(0.1, front, rear) == pytest.approx(RATE * (L + 0.5 * 0.55), abs=1e-9)
    rear = tip(-0.25, 1.75 * AT_ONCE * (L + 0.25))  # by a quarter: less
    assert speed(0.1, front, rear) == pytest.approx(RATE * (L + 0.75 * 0.3), abs=1e-9)


def test_what_counts_for_nothing_does_not_hide_what_follows():
    none, full = tip(0.3, 2.1 * AT_ONCE * (L + 0.3)), tip(-0.25, 0.5 * AT_ONCE * (L + 0.25))
    assert speed(0.0, none, full) == pytest.approx(RATE * (L + 0.25), abs=1e-9)


def test_two_that_count_in_full_count_once():
    front, rear = tip(0.3, 0.5 * AT_ONCE * (L + 0.3)), tip(-0.25, 0.5 * AT_ONCE * (L + 0.25))
    assert speed(0.0, front, rear) == pytest.approx(RATE * (L + 0.55), abs=1e-9)


@pytest.mark.parametrize("height", [0.02, 0.4])
def test_one_end_touches_and_the_other_counts_as_far_as_the_turn_tells(height):
    """The centroid halfway: no other point of the robot is farther from the end that touches."""
    part = [-0.4, -height, 0.05, 0.4, -height, 0.05]
    whole = 0.8 * RATE
    for turned, share in ((0.5, 1.0), (1.25, 0.75), (1.9, 0.1), (2.1, 0.0)):
        # the foot lies 0.8 cos(turned) ahead: two parts in a million less
        found = speed(0.2, parts=[part], turned=turned * AT_ONCE)
        assert found == pytest.approx(whole * share, abs=1e-5)
