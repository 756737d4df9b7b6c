"""Between which poses extremes are looked for, on poses made by hand."""

import math

import numpy as np
import pytest

from kaidan.contact import Feature, FeatureKind
from kaidan.contact.door import table_of, zeros
from kaidan.contact.kernel import sampling
from kaidan.contact.kernel.peak_search import leads_on
from kaidan.contact.layout import POINT_BITS, Margin, Passed, Pose, Pull, Samples
from kernel_memory import nothing, numbers, table

HALF = math.pi / 2
LEVEL, LEANS = (0.0, 1.0), (math.sin(0.3), math.cos(0.3))
VERTEX, DISC = FeatureKind.VERTEX, FeatureKind.DISC_1


def path(count, **columns):
    """Level poses a metre apart on discs, but for what is given."""
    found = nothing(Pose, count)
    given = {"s": np.arange(count), "leg": 0, "phi": 0, "psi": 0, "lean": 0} | columns
    names = {"phi": "inclination", "psi": "path_direction", "lean": "rear_lean"}
    for name in ("s", "leg", "phi", "psi", "lean"):
        found[names.get(name, name)] = given[name]
    for end in ("rear", "front"):
        found[end]["feature"] = given.get(end, Feature(1, 0, DISC).code)
        found[end]["n_x"], found[end]["n_z"] = np.transpose(given.get(f"{end}_n", [LEVEL] * count))
    return found


def poses_of(count, **columns):
    return table(Pose, path(count, **columns))


def test_the_path_leads_on_over_a_distance_along_one_line_of_poses():
    found = poses_of(5, s=[0.0, 1.0, 1.0 + 0.9e-8, 1.0 + 2.1e-8, 2.0], leg=[0, 0, 0, 0, 1])
    assert [leads_on(found, row) for row in range(4)] == [True, False, True, False]
    assert not leads_on(poses_of(2, s=[1.0, 0.0]), 0)
    assert leads_on(poses_of(2, s=[-1.0, 1.0]), 0)


def test_the_trailing_end_leaves_an_edge():
    """Its normal leans ahead by more than the flat does, and the path falls."""
    leans = [0.3, 0.3, 0.3, -0.3, 0.3, 0.0, 0.9e-9, 1.1e-9]
    phi = [0.0, -0.2, -0.4, 0.0, 0.5, 0.0, 0.0, 0.0]
    expected = [True, True, False, False, True, False, False, True]
    found = poses_of(8, lean=leans, phi=phi, psi=-0.1)
    assert [sampling.leaves_edge(pose) for pose in found] == expected
    for direction in (0.1, 0.0, math.pi - 0.1):
        found = poses_of(8, lean=leans, phi=phi, psi=direction)
        assert not any(sampling.leaves_edge(pose) for pose in found)


@pytest.mark.parametrize("end", ["rear", "front"])
def test_where_a_nosing_moves_along_an_end(end):
    """Its normal turns on the body between two poses; of a disc on a tread it does not count."""
    codes = {kind: Feature(1, 3, kind).code for kind in (VERTEX, DISC)}

    def moves(kinds, normals, phi=(0.0, 0.0), leg=(0, 0)):
        given = {end: [codes[each] for each in kinds], f"{end}_n": normals}
        return sampling.moves_along_end(poses_of(2, phi=phi, leg=leg, **given), 0)

    assert moves((VERTEX, VERTEX), (LEVEL, LEANS))
    # of three poses the second and the third count
    later = [codes[VERTEX]] * 2 + [codes[DISC]]
    for normals, does in (((LEVEL, LEVEL, LEANS), True), ((LEANS, LEVEL, LEVEL), False)):
        found = poses_of(3, **{end: later, f"{end}_n": normals})
        assert sampling.moves_along_end(found, 1) == does
    discs = [codes[VERTEX], codes[DISC], codes[DISC]]
    found = poses_of(3, **{end: discs, f"{end}_n": (LEVEL, LEVEL, LEANS)})
    assert not sampling.moves_along_end(found, 1)
    found = poses_of(3, phi=[0.3, 0.0, 0.0], **{end: later, f"{end}_n": [LEVEL] * 3})
    assert not sampling.moves_along_end(found, 1)
    assert not moves((VERTEX, VERTEX), (LEVEL, LEANS), (0.0, -0.3))  # the body turns with it
    assert moves((VERTEX, DISC), (LEVEL, LEANS))
    assert moves((DISC, VERTEX), (LEANS, LEVEL))
    assert not moves((DISC, DISC), (LEVEL, LEANS))
    assert not moves((VERTEX, VERTEX), (LEANS, LEANS))
    # the body turns with the normal, and under it
    assert not moves((VERTEX, VERTEX), (LEVEL, LEANS), (0.3, 0.0))
    assert moves((VERTEX, VERTEX), (LEANS, LEANS), (0.3, 0.0))
    assert moves((VERTEX, VERTEX), (LEANS, LEANS), (0.0, 1.1e-9))
    assert not moves((VERTEX, VERTEX), (LEANS, LEANS), (0.0, 0.9e-9))
    assert not moves((VERTEX, VERTEX), (LEVEL, LEANS), leg=(0, 1))
    # from the second of three poses to the third
    for kinds, normals, phi, expected in (
        ((DISC, DISC, VERTEX), (LEVEL, LEVEL, LEANS), 0.0, True),
        ((VERTEX, DISC, DISC), (LEVEL, LEVEL, LEANS), 0.0, False),
        ((VERTEX, VERTEX, VERTEX), (LEANS, LEVEL, LEVEL), 0.0, False),
        ((VERTEX, VERTEX, VERTEX), (LEVEL, LEVEL, LEVEL), (0.3, 0.0, 0.0), False),
    ):
        given = {end: [codes[each] for each in kinds], f"{end}_n": normals}
        assert sampling.moves_along_end(poses_of(3, phi=phi, **given), 1) is expected


@pytest.mark.parametrize(("one", "other", "turn"), [
    (0.1, 0.4, 0.3), (0.4, 0.1, -0.3), (3.0, -3.0, 2 * math.pi - 6.0), (-3.0, 3.0, 6 - 2 * math.pi),
])  # fmt: skip
def test_from_one_direction_to_another(one, other, turn):
    assert sampling.turn_to(one, other) == pytest.approx(turn)


def upright(*psi, **more):
    """Rows and shares, up and down."""
    found = poses_of(len(psi), psi=psi, **more)
    both = [
        [sampling.upright_at(found, row, way) for row in range(len(psi) - 1)]
        for way in (HALF, -HALF)
    ]
    return [{row: share for row, share in enumerate(each) if share != -1.0} for each in both]


def test_where_the_path_stands_upright():
    """Its direction passes 90 degrees up, and down."""
    up, down = upright(
        HALF - 0.3, HALF + 0.1, 0.0, -HALF - 0.1, -HALF + 0.3, 0.2, 0.4, HALF - 0.1, HALF + 0.1,
        leg=[0, 0, 0, 1, 1, 1, 1, 1, 2],
    )  # fmt: skip
    # up, back down from beyond it, and down
    assert up == pytest.approx({0: 0.75, 1: 0.1 / (HALF + 0.1)})
    assert down == pytest.approx({3: 0.25})
    assert upright(math.pi - 0.1, -math.pi + 0.1) == [{}, {}]  # over 180 degrees
    assert upright(-HALF + 0.1, -HALF - 0.1)[1] == pytest.approx({0: 0.5})
    up, down = upright(1.4, 1.7, 1.6, 3.0, -3.0, -1.5)
    assert up == pytest.approx({0: (HALF - 1.4) / 0.3})
    assert down == pytest.approx({4: (-HALF + 3.0) / 1.5})
    # by more than a right angle it passes upright once, up and not down
    assert upright(0.1, 3.0) == [pytest.approx({0: (HALF - 0.1) / 2.9}), {}]
    # on one side of it, and on it, it passes nothing
    assert upright(0.1, 1.5) == upright(1.6, 3.0) == [{}, {}]
    assert upright(HALF, HALF) == [{}, {}]


@pytest.mark.parametrize(("one", "middle", "other", "steady"), [
    (1.4, 1.57, 1.8, True),
    (1.8, 1.57, 1.4, True),
    (1.4, 1.5, 1.2, False),  # there and back
    (1.5, 1.4, 1.6, False),
    (1.5, 1.5, 1.6, False),
    (0.0, 1.6, 1.9, False),  # by more than a right angle at once
    (0.0, 0.3, 2.0, False),
    (0.0, 1.5, 3.0, True),
    (3.1, -3.1, -3.0, True),  # over 180 degrees
])  # fmt: skip
def test_whether_the_path_turns_steadily(one, middle, other, steady):
    assert sampling.turns_steadily(*poses_of(2, psi=[one, other]), middle) is steady


@pytest.fixture
def sampled(monkeypatch):
    """Samples of a path; of the kernel nothing runs that works out poses or margins."""
    asked = {}

    def poses_between(scene, of, rows, parts, new):
        assert len(rows) == len(new)
        asked.setdefault("parts", []).append([parts[k] for k in range(len(new))])
        for k, pose in enumerate(new):
            pose.s = of[rows[k]].s + parts[k]
            pose.path_direction = asked["directions"][k]

    def margins_without(scene, poses, points, pull, margins):
        assert pull == Pull(asked["a"], 9.8)
        assert len(poses) == len(margins)
        asked["points"] = list(points)
        for margin in margins:
            margin.traction = 100.0

    def pose_margins(scene, poses, pull, margins):
        assert pull == Pull(asked["a"], 9.8)
        assert len(poses) == len(margins)
        for margin in margins:
            margin.traction = 300.0

    def find_peaks(scene, poses, figures, groups, tolerance, side, pull, found):
        assert (groups, tolerance, side, pull) == (4, 1e-4, 0.0, Pull(asked["a"], 9.8))
        rows, between, margins = found
        values, group, narrow = map(list, (figures.values, figures.group, figures.narrow))
        asked.update(values=values, group=group, narrow=narrow, room=len(rows))
        assert len(rows) == len(between) == len(margins)
        rows[0], between[0].s, margins[0].traction = 1, 1.5, 200.0
        return 1

    for each in (poses_between, margins_without, pose_margins, find_peaks):
        monkeypatch.setattr(sampling, each.__name__, each)

    def of(poses, phase, passed=(), friction=0.5, directions=(), a=0.0):
        asked.update(directions=np.array(directions), a=a)
        count = len(poses)
        margins = zeros(Margin, count)
        margins["required_friction"] = friction
        rows = [(s, True, point, 0, row, math.nan) for row, s, point in passed]
        room = 5 * count
        found = np.full(room, 9), nothing(Pose, room), nothing(Margin, room)
        samples = Samples(numbers(found[0], int), table(Pose, found[1]), table(Margin, found[2]))
        total = sampling.find_samples(
            None, table(Pose, poses), table(Margin, margins), numbers(phase, int),
            table(Passed, table_of(Passed, rows)), Pull(a, 9.8), samples,
        )  # fmt: skip
        samples.poses.flush()
        samples.margins.flush()
        assert repr(found[1][:count].tolist()) == repr(poses.tolist())
        assert repr(found[2][:count].tolist()) == repr(margins.tolist())
        return [each[:total] for each in found], asked

    return of


def test_samples_are_poses_nosings_peaks_and_places_upright(sampled):
    """In this order, each with the row before it."""
    poses = path(4, psi=[0.0, HALF - 0.1, HALF + 0.3, 3.0])
    passed = [(0, 0.25, 8), (2, 2.5, 6)]
    (rows, found, margins), asked = sampled(poses, [0] * 4, passed, directions=[HALF, 0.0])
    assert rows.tolist() == [0, 1, 2, 3, 0, 2, 1, 1]
    assert found["s"].tolist() == pytest.approx([0, 1, 2, 3, 0.25, 2.5, 1.5, 1.25])
    assert asked["parts"] == [pytest.approx([0.25, 0.5]), pytest.approx([0.25])]
    assert asked["points"] == [8, 6]
    assert margins["traction"][4:].tolist() == [100.0, 100.0, 200.0, 9.8]
    assert asked["room"] == 16 + 4 - 6
    wide = path(4, s=[0.0, 2.0, 4.0, 6.0], psi=poses["path_direction"])
    _, asked = sampled(wide, [0] * 4, [(0, 0.5, 8), (2, 5.0, 6)], directions=[HALF, 0.0])
    assert asked["parts"][2] == pytest.approx([0.25, 0.5])


def test_groups_of_friction(sampled):
    """Phases, and what leaves an edge as it lands; infinite where nothing holds."""
    lean = [0.3, 0.3, 0.3, 0.0]
    found = path(4, lean=lean, psi=-0.1)
    friction = [0.4, math.nan, math.inf, 0.6]
    _, asked = sampled(found, [0, 1, 2, 2], friction=friction)
    assert asked["values"] == [0.4, math.inf, math.inf, 0.6]
    assert asked["group"] == [0, 1, 3, 2]
    assert asked["narrow"] == [False] * 4
    corner = path(3, rear=[1 << POINT_BITS] * 3, rear_n=[LEVEL, LEANS, LEANS])
    assert sampled(corner, [0] * 3)[1]["narrow"] == [True, False, False]
    corner = path(3, rear=[1 << POINT_BITS] * 3, rear_n=[LEVEL, LEVEL, LEANS])
    assert sampled(corner, [0] * 3)[1]["narrow"] == [False, True, False]


def test_the_share_at_which_a_nosing_passes(sampled):
    """Of two metres from a pose to the next half a metre is a quarter."""
    _, asked = sampled(path(3, s=[1.0, 3.0, 5.0]), [0] * 3, [(1, 3.5, 8)], directions=[0.0])
    assert asked["parts"][0] == [0.25]


@pytest.mark.parametrize("a", [0.7, -0.7])
def test_the_traction_of_an_upright_path_is_that_of_all_its_weight(a, sampled):
    """Up and down; where the path only comes to a stand it is that of its pose."""
    poses = path(3, psi=[HALF - 0.1, HALF + 0.2, HALF - 0.1])
    (rows, _, margins), _ = sampled(poses, [0] * 3, directions=[HALF, 1.0], a=a)
    assert rows.tolist() == [0, 1, 2, 1, 0, 1]
    assert margins["traction"][-2:].tolist() == pytest.approx([9.8 + a, 300.0])
    poses = path(2, psi=[-HALF - 0.1, -HALF + 0.2])
    (_, _, margins), _ = sampled(poses, [0] * 2, directions=[-HALF], a=a)
    assert margins["traction"][-1] == pytest.approx(-9.8 + a)
    # up before down
    poses = path(4, psi=[-HALF - 0.1, -HALF + 0.2, HALF - 0.1, HALF + 0.1])
    (rows, _, _), _ = sampled(poses, [0] * 4, directions=[HALF, -HALF], a=a)
    assert rows[-2:].tolist() == [2, 0]
