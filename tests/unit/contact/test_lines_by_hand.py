"""Lines of poses on two contacts, and where a contact takes another name, piece by piece.

Any two features will do for a line: its way is that along which neither gap changes, ahead where
the belt runs ahead over both.
"""

import math

import numpy as np
import pytest

from contact_cases import flight, random_robot, stadium
from kaidan import contact
from kaidan.contact import Feature, FeatureKind, body_table, ground_table
from kaidan.contact import layout as at
from kaidan.contact.door import zeros
from kaidan.contact.kernel.continuation import ARM, corrected, stepped, tangent
from kaidan.contact.kernel.gaps import gap, on_flat, relabelled
from kaidan.contact.kernel.renaming import name_room, poses_between
from kaidan.contact.layout import At, Held, Pose
from kernel_memory import called, pair_of, place_of, posed, scene

ROUGH = [(-3, -0.2), (-0.5, 0.0), (-0.2, 0.15), (0.1, -0.1), (0.3, 0.2), (0.6, 0.1), (3, 0.6)]


def rough_cases(seed, count):
    """Random robots anywhere near rough ground: tables, two features, pose."""
    rng = np.random.default_rng(seed)
    ground = ground_table(ROUGH)
    for _ in range(count):
        body = body_table(*random_robot(rng, least_radius=0.03))
        kinds = rng.integers(0, 3, 2)
        points = [int(rng.integers(1, len(ground) - 1)) for _ in kinds]
        parts = rng.integers(0, len(body), 2)
        pair = [Feature(*map(int, each)).code for each in zip(points, parts, kinds, strict=True)]
        x, z, phi = rng.uniform(-0.5, 0.6), rng.uniform(-0.1, 0.8), rng.uniform(-1.2, 1.2)
        if pair[0] != pair[1]:
            yield ground, body, pair, (float(x), float(z), float(phi))


def slopes(ground, body, pair, pose):
    """Change of both gaps with x, z and ARM phi: central differences."""
    found = np.empty((2, 3))
    for k, feature in enumerate(pair):
        for column, step in enumerate((1e-6, 1e-6, 1e-6 / ARM)):
            values = []
            for sign in (1.0, -1.0):
                x, z, phi = (v + (sign * step if i == column else 0.0) for i, v in enumerate(pose))
                values.append(gap(scene(ground, body), feature, posed(x, z, phi))[0])
            found[k, column] = (values[0] - values[1]) / 2e-6
    return found


def test_the_way_of_a_line_is_that_along_which_neither_gap_changes():
    senses = []
    for ground, body, pair, pose in rough_cases(1, 120):
        x, z, phi = pose
        place = posed(x, z, phi)
        rates = slopes(ground, body, pair, pose)
        way = np.cross(*rates)
        *found, size = tangent(scene(ground, body), *pair, place)
        assert size == pytest.approx(np.linalg.norm(way), abs=1e-7)
        if size < 1e-3:
            continue
        way /= np.linalg.norm(way)
        # how fast the belt runs ahead, along the ground, over each contact
        runs = 0.0
        for feature in pair:
            _, n_x, n_z, p_x, p_z = gap(scene(ground, body), feature, place)
            moves = complex(way[0], way[1]) + way[2] / ARM * 1j * complex(p_x - x, p_z - z)
            runs += (moves * (-1j * complex(n_x, n_z)).conjugate()).real
        senses.append(runs > 0.0)
        if abs(runs) > 1e-6:
            assert found == pytest.approx((math.copysign(1.0, runs) * way).tolist(), abs=1e-6)
    assert 20 < sum(senses) < len(senses) - 20


def test_the_nearest_pose_on_which_both_touch():
    """From where they touch a micrometre off it is that square to the way, to first order."""
    counts = 0
    for ground, body, pair, pose in rough_cases(2, 900):
        good, there, _ = corrected(scene(ground, body), *pair, *pose)
        if not good:
            continue
        on = there[:3]
        rates = slopes(ground, body, pair, on)
        if np.linalg.svd(rates)[1].min() < 0.1:
            continue
        off = np.random.default_rng(counts).normal(size=3) * 1e-6
        beside = np.array([on[0] + off[0], on[1] + off[1], on[2] + off[2] / ARM])
        good, there, where = corrected(scene(ground, body), *pair, *beside.tolist())
        assert good
        again = there[:3]
        assert where == pytest.approx(posed(*again), abs=1e-15)
        way = np.cross(*rates)
        way /= np.linalg.norm(way)
        moved = (np.array(again) - on) * [1.0, 1.0, ARM]
        # square of the way off over the radius, 30 mm
        assert moved == pytest.approx(way * (way @ off), abs=1e-9)
        assert abs(np.dot((there.t_x, there.t_z, there.t_w), way)) == pytest.approx(1.0, abs=1e-6)
        counts += 1
    assert counts > 20


@pytest.mark.parametrize("z", [0.02, 0.03, 0.05, 0.07])
@pytest.mark.parametrize("x", [0.0, 0.004, 0.02])
def test_no_pose_touches_two_points_farther_apart_than_the_robot_is_long(x, z):
    """460 mm, and the points 470 mm: Newton's method finds nothing, in however many rounds."""
    body = body_table(stadium(0.3, 0.15, 0.08, 0.08))
    ground = ground_table([(-4, -3), (-0.236, -3), (-0.235, 0), (-0.234, -3),
                           (0.234, -3), (0.235, 0), (0.236, -3), (4, -3)])  # fmt: skip
    pair = [at.POINT * k for k in np.flatnonzero(ground["z"] == 0.0)]
    assert len(pair) == 2
    for phi in np.linspace(-0.3, 0.3, 13):
        good, there, _ = corrected(scene(ground, body), *pair, x, z, float(phi))
        assert not good
        assert (there.t_x, there.t_z, there.t_w) == (1.0, 0.0, 0.0)


def down_a_hill(count):
    """The tail on a hill of 0.3 m in radius and so many points, the nose on the floor."""
    robot = stadium(0.5, 0.25, 0.1, 0.08)
    angles = np.linspace(-0.58, 0.58, count)
    hill = zip(0.3 * np.sin(angles), 0.3 * (np.cos(angles) - math.cos(0.58)), strict=True)
    line = [(-9, 0), *hill, (9, 0)]
    ground, body, x = ground_table(line), body_table(robot), 0.36
    there = contact.settle(line, robot, x, -0.05)
    assert there.found
    z, phi, pair = there.z, there.inclination, (there.rear, there.front)
    *way, _ = tangent(scene(ground, body), *pair, posed(x, z, phi))
    return scene(ground, body), Held(x, z, phi, *way, *pair)


def test_a_step_in_which_a_contact_takes_too_many_names_is_too_long():
    """Points 58 um apart, two names each; the end that passes them moves by half of a step."""
    tables, here = down_a_hill(6001)
    passed = {}
    for ds in (1e-3, 4e-3):
        good, there, _ = stepped(tables, here, ds)
        passed[good] = (there.rear >> at.POINT_BITS) - (here.rear >> at.POINT_BITS)
    assert 5 < passed[True] < 20 <= passed[False] <= 21


def test_an_end_passes_many_points_in_one_step():
    """Points 0.6 mm apart."""
    tables, here = down_a_hill(601)
    good, there, where = stepped(tables, here, 0.01)
    assert good
    assert there.front == here.front
    assert (there.rear >> at.POINT_BITS) - (here.rear >> at.POINT_BITS) > 5
    assert relabelled(tables, there.rear, where) == there.rear
    for feature in (there.rear, there.front):
        assert abs(gap(tables, feature, where)[0]) < 1e-12


def test_a_contact_has_room_as_long_as_it_keeps_its_name():
    kept, lost = 0, 0
    for ground, body, pair, (x, z, phi) in rough_cases(3, 400):
        c, s = math.cos(phi), math.sin(phi)
        for feature in pair:
            distance = gap(scene(ground, body), feature, At(x, z, c, s))[0]
            if distance < -0.02:
                continue  # its normal is no more that of the side on which it came
            flat = on_flat(scene(ground, body), feature, At(x, z, c, s))
            same = relabelled(scene(ground, body), feature, At(x, z, c, s)) == feature
            assert (name_room(scene(ground, body), feature, flat, At(x, z, c, s)) >= 0.0) == same
            kept, lost = kept + same, lost + (not same)
    assert min(kept, lost) > 50


@pytest.mark.parametrize(("x", "z"), [(0.05, 0.1), (-0.02, 0.06), (-0.001, 0.13), (-0.1, 0.105)])
def test_room_by_hand(x, z):
    """A disc of 50 mm at (x, z) by a ridge with slopes of 45 degrees, on one of them or its top."""
    ground = ground_table([(-3, -3), (0, 0), (3, -3)])
    body = body_table([[0.0, 0.0, 0.05, 0.3, 1.0, 0.05]])
    ahead, behind = (x - z) / math.sqrt(2.0), (x + z) / math.sqrt(2.0)  # feet, from the top on
    pose = (x, z, 1.0, 0.0)
    rear = [Feature(k, 0, FeatureKind.DISC_1).code for k in (0, 1)]
    length = ground["length"][:2]
    assert name_room(scene(ground, body), rear[1], False, At(*pose)) == pytest.approx(ahead)
    assert name_room(scene(ground, body), rear[0], False, At(*pose)) == pytest.approx(-behind)
    assert not ground["convex"][0]
    assert not ground["convex"][2]
    assert length[0] > 3.0
    # on the top: until the normal leans as that of either slope
    size = math.hypot(x, z)
    top = Feature(1, 0, FeatureKind.VERTEX).code
    along = (complex(-x, -z) * complex(0.3, 1.0).conjugate()).real / abs(complex(0.3, 1.0))
    room = min(behind / size, -ahead / size, -along)
    assert name_room(scene(ground, body), top, False, At(*pose)) == pytest.approx(room)
    # under the flat: as far as it is from its rear end
    assert name_room(scene(ground, body), top, True, At(*pose)) == pytest.approx(along)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.8, 1.0])
@pytest.mark.parametrize(
    ("every", "back", "off"),
    # a chord is shorter than its arc by ds^3 / 24 r^2: of 10 mm by 10 um, of 50 mm by 1.4 mm
    [(1, False, 4e-5), (1, True, 2e-4), (5, False, 1e-2)],
)
def test_poses_between_two_of_a_path(share, every, back, off):
    """As many small steps along the line lead there, on or back, over a bend too."""
    robot = stadium(0.47, 0.196, 0.071, 0.06)
    path = contact.traverse(flight(0.6, 0.2, 3), robot, -0.6, 0.5, step=0.01)
    ground, body, poses = path.ground.table, path.body.table, path.poses.table[::every].copy()
    if back:
        poses = poses[::-1].copy()
        poses["s"] = poses["s"][0] - poses["s"]
    s, leg = poses["s"], poses["leg"]
    same = (np.diff(leg) == 0) & (np.diff(s) > 1e-3)
    rows = np.flatnonzero(same)[::3].copy()
    between = zeros(Pose, len(rows))
    called(poses_between)((ground, body), poses, rows, np.full(len(rows), share), between)
    counts, tables = 0, scene(ground, body)
    for row, found in zip(rows, between, strict=True):
        here, then = (np.array(place_of(poses[k])) for k in (row, row + 1))
        pair = pair_of(poses[row])
        *t, _ = tangent(tables, *pair, posed(*here.tolist()))
        t = np.array(t) * math.copysign(1.0, np.dot(t, (then - here) * [1.0, 1.0, ARM]))
        ds = share * (s[row + 1] - s[row])
        held = Held(*here.tolist(), *t.tolist(), *pair)
        for _ in range(50):
            good, held, _ = stepped(tables, held, ds / 50)
            if not good:
                break
        if not good or held[6:] != pair_of(found):
            continue
        counts += 1
        placed = place_of(found)
        assert placed == pytest.approx(held[:3], abs=off)
        assert found["s"] == pytest.approx(s[row] + ds, abs=off)
        assert found["leg"] == leg[row]
        for feature in pair_of(found):
            assert abs(gap(tables, feature, posed(*placed))[0]) < 1e-12
    assert counts > 20 / every
