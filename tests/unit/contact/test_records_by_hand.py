"""What a path says of its tables, and what goes into the kernel, by hand."""

import math
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import heights, rating, scratch, steepest, supports, traversing
from kaidan.contact.codes import (
    PartKind,
    RotationOutcome,
    Status,
)
from kaidan.contact.contacts import contacts_of
from kaidan.contact.features import Feature, FeatureKind, FeatureTable
from kaidan.contact.layout import Grousers, Margin, Pose, RotationRow, Summary, Support
from kaidan.contact.path import Path
from kaidan.contact.records import (
    ONE_PLACE,
    Body,
    Events,
    Ground,
    Margins,
    Poses,
    Rotations,
    Summaries,
)
from kaidan.contact.rest import resting_height, settle
from kaidan.contact.tables import body_table, ground_table
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.traversal.nosing_events import nosing_events
from kernel_memory import made

KERB = [(-4, 0), (0, 0), (0, 0.1), (4, 0.1)]
ROBOT = [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]
BOTH = [*ROBOT, [0.196, -0.011, 0.06, 0.45, 0.05, 0.03]]


def table(kind, rows, **given):
    """A table of noughts but for some fields."""
    columns = {name: np.broadcast_to(values, rows) for name, values in given.items()}
    each = ({name: values[k] for name, values in columns.items()} for k in range(rows))
    return made(kind, *each)


def path_of(*, status=Status.OK, s=(0.0, 1.0), rotations=(), margins=None, parts=BOTH, bodies=None,
            kinds=(0, 1), poses=None):  # fmt: skip
    names = "angle", "outcome", "topples_with_momentum", "end.inclination"
    turns = made(RotationRow, *(dict(zip(names, row, strict=True)) for row in rotations))
    return Path(
        status, Poses(table(Pose, len(s), s=s, **(poses or {}))), Events.of([]),
        Rotations(turns), margins, Ground(ground_table(KERB)), Body(body_table(parts, kinds)),
        bodies,
    )  # fmt: skip


# records


def test_features_of_a_table_are_those_of_each_code():
    each = [
        Feature(point, part, kind)
        for point in (0, 7, 1023) for part in (0, 5, 15) for kind in FeatureKind
    ]  # fmt: skip
    found = FeatureTable.of(np.array([one.code for one in each]))
    assert list(zip(*(column.tolist() for column in found), strict=True)) == [
        tuple(e) for e in each
    ]
    assert [Feature.of(one.code) for one in each] == each


def test_pairs_of_fields_are_pairs():
    path = path_of()
    poses, body = path.poses, path.body
    for each in (poses.rear_point, poses.front_point, poses.rear_normal, poses.front_normal):
        assert each.shape == (2, 2)
    assert body.discs.tolist() == np.array(BOTH).tolist()
    margins = Margins(table(Margin, 3, outer_rear=(64, 65, 66), outer_front=128))
    assert margins.outermost.tolist() == [[64, 128], [65, 128], [66, 128]]


def test_poses_lead_on_along_one_line_and_not_at_one_place():
    poses = Poses(
        table(
            Pose, 6, s=(1.0, 1.2, 1.2 + 0.5 * ONE_PLACE, 1.2 + 2 * ONE_PLACE, 1.3, 1.4),
            leg=(0, 0, 0, 0, 1, 1),
        )
    )  # fmt: skip
    assert poses.leads_on.tolist() == [True, False, True, False, True]


def test_flags_are_those_that_are_set():
    rotations = Rotations(
        table(
            RotationRow, len(RotationOutcome), topples_with_momentum=(0, 1, 0, 1, 0),
            outcome=list(RotationOutcome),
        )
    )  # fmt: skip
    assert rotations.arrested.tolist() == [True, False, False, False, False]
    assert rotations.topples_with_momentum.tolist() == [False, True, False, True, False]
    summaries = Summaries(table(Summary, 2, topples_with_momentum=(0, 1), belly_touches=(1, 0)))
    assert summaries.topples_with_momentum.tolist() == [False, True]
    assert summaries.belly_touches.tolist() == [True, False]


# paths

ARRESTED, FALLS = RotationOutcome.ARRESTED, RotationOutcome.PAST_VERTICAL


def test_grades_of_a_path():
    turns = [(0.1, ARRESTED, 0, 0.3), (0.3, ARRESTED, 0, 0.2), (0.9, FALLS, 0, 1.2)]
    assert path_of(rotations=turns).largest_rotation == 0.3
    assert path_of().largest_rotation == 0.0
    topples = [(0.1, ARRESTED, 1, 0.3), (0.1, ARRESTED, 0, 0.3)]
    assert path_of(rotations=turns).arrives_with_momentum
    assert not path_of(rotations=topples).arrives_with_momentum
    assert not path_of(status=Status.STUCK).arrives_with_momentum
    assert path_of(rotations=turns, poses={"inclination": (0.5, 0.4)}).largest_inclination() == 1.2
    assert (
        path_of(rotations=turns[:2], poses={"inclination": (0.4, 0.5)}).largest_inclination() == 0.5
    )
    assert path_of(poses={"inclination": (-0.4, -0.5)}).largest_inclination() == -0.4


def test_nothing_of_the_robot_is_farther_away_than_its_reach():
    farthest = math.hypot(0.45, 0.05) + 0.03
    assert farthest <= path_of().reach < 2 * farthest
    longer = np.stack([body_table(BOTH), body_table([*ROBOT, [0.2, 0, 0.06, 0.9, 0, 0.03]])])
    assert path_of(bodies=longer).reach >= 0.93


def test_the_row_before_an_arclength():
    """Two lines of poses meet at 0.2 m, where it rotates: before it the last one of the first."""
    path = path_of(s=(0.0, 0.1, 0.2, 0.2, 0.3), poses={"leg": (0, 0, 0, 1, 1)})
    for s, row in ((0.2, 2), (0.2 + 5e-10, 2), (0.2 - 5e-10, 2), (0.15, 1), (0.25, 3), (0.1, 1),
                   (0.3, 4), (-1.0, 0), (0.05, 0), (9.0, 4)):  # fmt: skip
        assert path.row_before(s) == row
    # two rotations at one place, and several poses of the first line there
    path = path_of(s=(0.0, 0.2, 0.2, 0.2, 0.2), poses={"leg": (0, 0, 0, 1, 2)})
    assert path.row_before(0.2) == 2


def test_the_first_pose_alone():
    path = contact.traverse(KERB, ROBOT, -0.6, 0.5, step=0.02)
    first = path.first()
    assert (len(first.poses), len(first.margins)) == (1, 1)
    assert (len(first.events), len(first.rotations)) == (0, 0)
    assert first.x[0] == path.x[0]


def test_the_parts_that_carry():
    path = path_of(poses={
        "rear.feature": Feature(1, 0, FeatureKind.VERTEX).code, "rear.x": (0.1, 0.2),
        "front.feature": Feature(2, 1, FeatureKind.DISC_1).code, "front.n_z": 1.0,
    })  # fmt: skip
    rear, front = path.carrying(1)
    assert (rear.kind, front.kind) == (PartKind.TRACK, PartKind.FLIPPER)
    assert (rear.point, front.normal, rear.gap, front.gap) == ((0.2, 0.0), (0.0, 1.0), 0.0, 0.0)


def test_a_rotation_carried_out_in_part():
    """A track that drops from the edge of a kerb: its centroid turns about the edge."""
    path = contact.traverse(KERB, ROBOT, -0.6, 0.5, step=0.02)
    record = next(iter(path.rotations))
    for angle in (0.0, 0.1, record.angle):
        place = contact.rotated(path, record, angle)
        assert place.inclination == pytest.approx(record.start.inclination + record.sense * angle)
        pivot = complex(*record.pivot_point)
        turned = (complex(*record.start[:2]) - pivot) * np.exp(1j * record.sense * angle)
        if angle < 0.2:  # as long as it turns about that edge
            assert complex(place.x, place.z) == pytest.approx(pivot + turned, abs=1e-6)


def test_nosings_come_and_go_where_they_are_left_out():
    """The poses without them stand where their events are."""
    flight = [(-3, 0), (0, 0)]
    for k in range(6):
        flight += [(0.2 * k, 0.1 * (k + 1)), (0.2 * (k + 1), 0.1 * (k + 1))]
    path = contact.traverse([*flight, (4, 0.6)], ROBOT, -0.5, 1.0, step=0.05)
    passed = nosing_events(path)
    assert len(passed) > 3
    count = len(path.poses)
    found = contact.samples_of(path, np.ones(count, dtype=np.int64), 1e-7, acceleration=0.0)
    between = slice(count, count + len(passed))
    assert found.path.s[between] == pytest.approx(passed.s)
    assert found.rows[between].tolist() == passed.pose.tolist()
    assert found.rows[:count].tolist() == list(range(count))
    np.testing.assert_array_equal(found.path.poses.table[:count], path.poses.table)
    np.testing.assert_array_equal(found.path.margins.table[:count], path.margins.table)


# robot at rest


@pytest.mark.parametrize("slope", [0.0, 0.3, -0.4])
def test_contacts_of_a_robot_at_rest_on_a_slope(slope):
    rise = math.tan(slope)
    found = settle([(-4, -4 * rise), (4, 4 * rise)], ROBOT, 0.5, 0.0)
    assert found.inclination == pytest.approx(slope)
    for x, z in found.points:
        assert z == pytest.approx(x * rise, abs=1e-9)
    ends = [math.dist(*found.points), 0.47]
    assert ends[0] == pytest.approx(ends[1])


def lowest(ground, parts, x, phi):
    """Lowest height by the undersides of discs and the hull between them, every 10 um or so."""
    c, s = math.cos(phi), math.sin(phi)
    points = []
    turn = np.linspace(-math.pi, 0.0, 8_001)
    for x1, z1, r1, x2, z2, r2 in parts:
        share = np.linspace(0.0, 1.0, 201)[:, None]
        for a, b, r in ((x1, z1, r1), (x2, z2, r2)):
            points.append(np.stack([a + r * np.cos(turn), b + r * np.sin(turn)]))
        # the hull is that of discs between both
        middle = np.stack([x1 + share * (x2 - x1), z1 + share * (z2 - z1)])
        r = r1 + share * (r2 - r1)
        some = turn[::20]
        points.append(
            np.stack([middle[0] + r * np.cos(some), middle[1] + r * np.sin(some)]).reshape(2, -1)
        )
    u, v = np.hstack(points)
    along, up = x + c * u - s * v, s * u + c * v
    g_x, g_z = np.array(ground, dtype=float).T
    rises = np.flatnonzero(np.diff(g_x) == 0)
    level = np.interp(along, g_x + 1e-12 * np.arange(len(g_x)), g_z)
    best = float((level - up).max())
    # corners against the underside at each
    order = np.argsort(along)
    for k in {*rises.tolist(), *(rises + 1).tolist()}:
        under = up[np.abs(along - g_x[k]) < 2e-5]
        if len(under):
            best = max(best, float(g_z[k] - under.min()))
    assert len(order)
    return best


@pytest.mark.parametrize("phi", [-1.2, -0.5, 0.0, 0.3, 0.9])
def test_touching_heights_over_a_map_are_those_of_each_place(phi):
    """As the kernel finds them one by one, and as the outline says, to 0.1 mm."""
    ground = [
        (-3, -0.3),
        (-1, 0.1),
        (0, 0.1),
        (0, 0.3),
        (0.25, 0.3),
        (0.25, 0.5),
        (1, 0.3),
        (3, 0.5),
    ]
    for parts in (BOTH, [[-0.2, 0.02, 0.1, 0.3, -0.1, 0.03], [0.3, -0.1, 0.05, 0.1, 0.2, 0.02]]):
        path = path_of(parts=parts)
        x = np.linspace(-0.9, 1.2, 15)
        table = Ground(ground_table(ground))
        found = heights.touching_heights(table, path.body, x, np.array([phi, phi / 2]))
        for row, angle in enumerate((phi, phi / 2)):
            each = [resting_height(ground, parts, one, angle, kinds=(0, 1)) for one in x]
            assert found.z[row] == pytest.approx(each, abs=1e-9)
            for k in range(len(x)):  # of one place alone less of the ground is looked at
                alone = heights.touching_heights(table, path.body, x[k : k + 1], np.array([angle]))
                assert alone.z[0, 0] == found.z[row, k]
            assert found.z[row, 4] == pytest.approx(lowest(ground, parts, x[4], angle), abs=1e-4)
            for k, one in enumerate(x):
                place = contact.Placement(one, found.z[row, k], angle)
                both = table.table, path.body.table
                points = [c.point for c in contacts_of(both, *place, 1e-9)]
                at_ = found.contact_x[row, k], found.contact_z[row, k]
                assert min(math.dist(at_, point) for point in points) < 1e-6


@pytest.mark.parametrize("slope", [0.0, 0.5, -0.4])
def test_a_nosing_under_the_flat_and_one_under_an_end(slope):
    """At rest on two edges, one of them under the straight underside."""
    c, s = math.cos(slope), math.sin(slope)
    edges = [(0.0, 0.0), (0.25 * c, 0.25 * s), (0.5 * c, 0.5 * s)]
    ground = [(-4, -1)]
    for x, z in edges:
        ground += [(x, z), (x + 0.02, z)] if slope < 0 else [(x - 0.02, z), (x, z)]
        ground.append((ground[-1][0] + 0.01, z - 0.05))
    path = path_of(parts=ROBOT, kinds=[0], poses={"inclination": slope})
    path = Path(path.status, path.poses, path.events, path.rotations, None,
                Ground(ground_table(sorted(ground))), path.body)  # fmt: skip
    table = path.ground.table
    point = int(np.argmin(np.hypot(table["x"] - edges[1][0], table["z"] - edges[1][1])))
    for along, on in ((-0.2, True), (0.2, True), (-0.3, False), (0.26, False)):
        # the centroid so far from the middle edge along the flat, 0.071 m above it
        x = edges[1][0] - along * c - 0.071 * s
        z = edges[1][1] - along * s + 0.071 * c
        path.poses.table["x"][0], path.poses.table["z"][0] = x, z
        on_flat = path.is_on_flat(Feature(point, 0, FeatureKind.VERTEX).code, 0)
        assert on_flat is (on and -0.274 <= along <= 0.196)


# into the kernel


@pytest.fixture
def driven(monkeypatch):
    """What the kernel is given of a drive; it ends at once."""
    given = []

    def drive(*arguments):
        given.append(arguments)
        return [(Status.STUCK if arguments[2].tilt else Status.OK), 0, 0, 0]

    monkeypatch.setattr(traversing, "kernel", lambda: SimpleNamespace(drive=drive))
    monkeypatch.setattr(
        traversing, "most_poses", lambda way, step, points: given.append(way) or 100
    )
    return given


@pytest.mark.parametrize("tilt", [0.0, 0.4, -0.4])
def test_tilted_gravity_and_the_room_for_a_way(tilt, driven):
    ways = (
        (3.0, partial(contact.traverse, gravity=3.0, with_margins=False)),
        (STANDARD_GRAVITY, contact.arrives),
    )
    for gravity, drive in ways:
        driven.clear()
        found = drive(KERB, ROBOT, -0.6, 0.5, tilt=tilt)
        way, arguments = driven
        assert way == pytest.approx(1.1)
        _, _, pull, (*_, keeps) = arguments
        assert pull.g == pytest.approx(gravity * math.cos(tilt))
        assert pull.tilt == pytest.approx(math.tan(tilt))
        assert keeps is (drive is not contact.arrives)
        if gravity > 3.0:
            assert found is (tilt == 0.0)


@pytest.mark.parametrize(
    ("x_end", "step", "text"),
    [(-0.6, 0.02, "must be ahead"), (-0.7, 0.02, "must be ahead"), (0.5, 0.0, "must be positive"),
     (0.5, -0.1, "must be positive"), (0.5, math.nan, "must be positive")],
)  # fmt: skip
def test_what_is_no_way(x_end, step, text):
    with pytest.raises(ValueError, match=text):
        contact.traverse(KERB, ROBOT, -0.6, x_end, step=step)


@pytest.mark.parametrize("climbs", [True, False])
def test_grousers_stand_uphill_of_a_nosing(climbs, monkeypatch):
    signs = []

    def standing_margins(*arguments):
        signs.append(arguments[-2])
        arguments[-1][:] = np.arange(6.0)

    monkeypatch.setattr(
        supports, "kernel", lambda: SimpleNamespace(standing_margins=standing_margins)
    )
    found = object.__new__(supports.Supports)
    table = made(Support, *6 * [{}])
    vars(found).update(_table=table, _slots=2, _loads=None, _like=None, _climbs=climbs)
    grousers = Grousers(0.01, 0.04, 0.005, 0.002, True)
    assert found.standing_margins((0.1, 0.2, 0.3), grousers).tolist() == [[0, 1], [2, 3], [4, 5]]
    assert signs == [1.0 if climbs else -1.0]


def test_ratings_have_room_for_the_longest_way(monkeypatch):
    ways = []

    def most_poses(way, step, points):
        ways.append(way)
        return scratch.most_poses(way, step, points)

    monkeypatch.setattr(rating, "most_poses", most_poses)
    jobs = [contact.Job(0, 0, -1.0, 0.5), contact.Job(0, 0, -0.6, -0.5)]
    found = contact.rate_many(KERB, [ROBOT], [0], [0.5], [[]], jobs, step=0.02, zones=[],
                              edges=[[0, 0.1]], rough=0.01)  # fmt: skip
    assert ways == [pytest.approx(1.5)]
    assert len(found.status) == 2


def test_who_stands_in_turn_has_no_events():
    flat = [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]
    found = contact.stand_in_turn([[0, 0], [4, 0]], [flat, flat], [0], 2.0, 0.0)
    assert (len(found.poses), len(found.events), len(found.rotations)) == (2, 0, 0)


def test_the_plain_kernel_whatever_its_entries_are_given():
    """Several traverses at once cut tables up, a single one does not: both answer alike."""
    floor, short = [[-4, 0], [4, 0]], {"step": 0.05, "with_margins": False}
    with contact.using_kernel("plain"):
        one = contact.traverse(floor, ROBOT, 0.0, 0.1, **short)
        many = contact.traverse_many([floor], [ROBOT], [contact.Job(0, 0, 0.0, 0.1)], size=100,
                                     step=0.05)  # fmt: skip
    assert many.x[0] == pytest.approx(one.x[-1])


def test_the_time_of_the_plain_kernel_by_hand():
    """Poses each 5 mm of the way and of the risers; on each those corners that lie under it."""
    points = [(-3, 0), (0, 0), (0, 0.2), (1, 0.2), (1, 0.1), (4, 0.1)]
    parts = [[-0.3, 0, 0.1, 0.3, 0, 0.1], [0.3, 0, 0.1, 0.5, 0.2, 0.05]]
    a, b = traversing.A_POSE, traversing.A_POINT
    poses, under = (2.0 + 0.2) / 0.005, 0.4 + 0.55
    found = traversing.plain_seconds(points, parts, -1.5, 0.5, step=0.005)
    assert found == pytest.approx(poses * (a + b * 2 * under / 2.0))
    short = traversing.plain_seconds(points, parts, -0.1, 0.5, step=0.005)
    assert short == pytest.approx((0.6 + 0.2) / 0.005 * (a + b * 2))
    both = traversing.plain_seconds(points, parts, -0.1, 1.0, step=0.005)  # up to the edge itself
    assert both == pytest.approx((1.1 + 0.3) / 0.005 * (a + b * 4 * under / 1.1))


def test_a_path_has_room_for_its_poses():
    for way, step, points in ((1.0, 0.005, 10), (1.0, 1e-5, 10), (3.0, 0.01, 2000)):
        size = scratch.most_poses(way, step, points)
        assert way / step + 10 * points < size <= scratch.MOST
    assert scratch.most_poses(1.0, 0.005, 10) < 10_000
    assert scratch.most_poses(1e4, 1e-3, 10) == scratch.MOST
    for size in (300, 40, 5000):
        tables = scratch.path_scratch(size)
        assert [len(each) for each in tables[:2]] == [size, size]
        assert len(tables[2]) >= size / 8


def test_the_steepest_flight_is_halved_out(monkeypatch):
    """Held up to 0.7 rad, with 0.05 rad beyond the flight's angle."""
    asked = []

    def traverse(terrain, parts, x_start, x_end, *, step, with_margins):
        asked.append((terrain, with_margins))
        extra = 0.05 if terrain <= limit else 0.06
        return SimpleNamespace(status=status(terrain), largest_inclination=lambda: terrain + extra)

    def flight(angle):
        return angle, 0.0, 1.0

    monkeypatch.setattr(steepest, "traverse", traverse)
    limit, status = 0.7, lambda angle: Status.OK
    how = {"largest_extra": 0.05 + 1e-12, "low": 0.2, "high": 1.4}
    found = steepest.steepest_flight(flight, ROBOT, **how)
    assert 0.7 - 1e-5 <= found <= 0.7
    assert not any(with_margins for _, with_margins in asked)
    limit, status = 9.0, lambda angle: Status.OK if angle <= 0.5 else Status.STUCK
    assert 0.5 - 1e-5 <= steepest.steepest_flight(flight, ROBOT, **how) <= 0.5
    limit = 0.1
    assert math.isnan(steepest.steepest_flight(flight, ROBOT, **how))


@pytest.mark.parametrize("phi", [0.0, 0.3, -0.4])
def test_touching_height_over_an_edge_under_the_middle_of_a_short_part(phi):
    """The flat of 0.3 m lies on the edge, 0.1 m from the centre of its rear disc."""
    disc, turn = -0.15 - 0.05j, np.exp(1j * phi)
    body = Body(body_table([[disc.real, disc.imag, 0.02, 0.15, -0.05, 0.02]]))
    fin = [(-9, -9), (0.5, -9), (0.5, 0.2), (0.5 + 1e-3, -9), (9, -9)]
    ground = Ground(ground_table(fin))
    place = 0.5 + 0.2j - (disc + 0.1 - 0.02j) * turn
    found = heights.touching_heights(ground, body, np.array([place.real]), np.array([phi]))
    assert found.z[0, 0] == pytest.approx(place.imag, abs=1e-12)
    assert (found.contact_x[0, 0], found.contact_z[0, 0]) == (0.5, 0.2)
