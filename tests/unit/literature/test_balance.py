"""Static balance along a way: classes, transitions, quality; numbers by hand or of the traverse."""

import math
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.errors import InputError
from kaidan.literature import balance as module
from kaidan.literature.balance import Balance, Change, balance_along, energy_class, quality
from kaidan.literature.equilibria import stable_poses
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse

KENAF = Outline.of(Robot.named("kenaf"))
FLAT = Outline.of(Robot.named("absolem"), Posture(front="flat", rear="flat"))
STOWED = Outline.of(Robot.named("absolem"))
FLIGHT = Profile.of_stairs(Stairs(rise=0.178, going=0.279, steps=3))
KERB = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])


def along(profile=KERB, outline=KENAF, **how):
    return balance_along(profile, outline, step=0.02, **how)


RAISED = Outline.of(Robot.named("absolem"), Posture(front=0.6, rear=0.0))


@pytest.mark.parametrize("outline", [FLAT, STOWED, RAISED])
def test_losses_of_balance_are_the_traverses_rotations(outline):
    """Agreement: transitions are told of the kernel's rotations, not found a second time."""
    way = along(FLIGHT, outline)
    run = traverse(FLIGHT, outline, step=0.02).path
    assert len(way.losses) == len(run.rotations) > 0
    for loss, rotation in zip(way.losses, run.rotations, strict=True):
        start, end = rotation.start, rotation.end
        assert loss.x == (start.x, end.x)
        assert loss.inclination == (start.inclination, end.inclination)
        assert loss.rotation == rotation.sense * rotation.angle
        assert loss.fall == start.z - end.z
        assert loss.rate == rotation.rate_before
        assert loss.topples == rotation.topples_with_momentum
        assert (loss.end is None) == (not rotation.arrested)


def test_the_nose_drops_over_a_kerb():
    """By hand: on the edge the centroid stands C_N/cos above it, after the drop C_N.

    See docs/theory/transitions.md.

    The front contact lies at the front end of the flat, the centroid's distance from the edge
    is kept: x = C_N tan(phi), turned by the edge's circle.
    """
    (loss,) = along().losses
    phi, C_N, k = loss.inclination[0], 0.071, KENAF.gyration
    fall = C_N * (1 / math.cos(phi) - 1)
    assert loss.change is Change.NOSE_DROPS
    assert loss.rotation == pytest.approx(-phi, abs=1e-9)
    assert loss.fall == pytest.approx(fall, abs=1e-9)
    assert loss.energy == pytest.approx(STANDARD_GRAVITY * fall, abs=1e-8)
    # energy of the turn about the edge: (k^2 + r^2) rate^2 / 2 = g fall
    r = C_N / math.cos(phi)
    rate = math.sqrt(2 * STANDARD_GRAVITY * fall / (k**2 + r**2))
    assert loss.rate == pytest.approx(rate, abs=1e-7)
    # the front end of the flat comes down, C_L ahead of a centroid C_N tan(phi) past the edge
    arm = 0.196 + C_N * math.tan(phi)
    assert loss.impact_speed == pytest.approx(rate * arm, abs=1e-6)
    # docs/theory/contact.md, grade three: plastic impact, then the rise that toppling needs
    a = np.array([C_N * math.tan(phi), C_N])
    b = np.array([-0.196, C_N])
    plus = rate * max(k**2 + a @ b, 0) / (k**2 + b @ b)
    barrier = STANDARD_GRAVITY * (math.hypot(*b) - C_N)
    expected = (1 - fall / C_N) * (1 - 0.5 * (k**2 + b @ b) * plus**2 / barrier)
    assert loss.quality == pytest.approx(expected, abs=5e-3)  # it tips over the arc, not a point


def test_a_fall_leads_nowhere():
    """docs/theory/contact.md, figures of the prototypes: bare Absolem falls over on this flight."""
    way = along(FLIGHT, STOWED)
    assert not way.arrived
    assert way.quality == 0.0
    last = way.transitions[-1]
    assert last.change is Change.TIPS_BACK
    assert last.end is None
    assert last.topples
    assert math.isnan(last.impact_speed)
    assert way.leads_to()[last.start] == (last.start - 1,)


def test_the_graph_goes_both_ways_but_for_the_losses():
    way = along(FLIGHT, FLAT)
    graph = way.leads_to()
    assert len(graph) == len(way.stretches) == len(way.transitions) + 1
    for each in way.transitions:
        assert each.end in graph[each.start]
        assert (each.start in graph[each.end]) == each.reversible == (each.rotation == 0.0)
    rows = [each.rows for each in way.stretches]
    assert rows[0][0] == 0
    assert rows[-1][1] == len(way.traverse.path.poses)
    assert all(one[1] == two[0] for one, two in pairwise(rows))


def test_a_climb_without_a_loss_is_as_good_as_can_be():
    """Limit: on level ground nothing happens."""
    way = along(Profile.of_points([(0, 0), (2, 0)]))
    assert way.transitions == ()
    assert way.quality == 1.0
    assert set(way.balance) == {"stable"}
    # by hand: C_L = 0.196 and L - C_L = 0.274 from the contacts, hypot - C_N
    assert way.stretches[0].static_margin == pytest.approx(0.196, abs=1e-9)
    assert way.stretches[0].energy_margin == pytest.approx(math.hypot(0.196, 0.071) - 0.071)


def test_every_loss_begins_at_the_edge_of_balance():
    way = along(FLIGHT, FLAT)
    for loss in way.losses:
        last = way.stretches[loss.start].rows[1] - 1
        assert way.balance[last] != Balance.STABLE
        assert way.stretches[loss.start].balance is not Balance.STABLE


def test_a_stretch_has_the_worst_of_its_poses():
    way = along(FLIGHT, FLAT)
    poses = way.traverse.path.margins
    order = ["unstable", "edge", "stable"]
    for each in way.stretches:
        rows = range(*each.rows)
        assert each.static_margin == min(min(poses.back[k], poses.front[k]) for k in rows)
        assert each.energy_margin == min(min(poses.back_rise[k], poses.front_rise[k]) for k in rows)
        assert each.balance == min((way.balance[k] for k in rows), key=order.index)
        x, phi = way.traverse.path.x, way.traverse.path.inclination
        assert each.x == (x[rows[0]], x[rows[-1]])
        assert each.inclination == (phi[rows[0]], phi[rows[-1]])
    assert len({each.energy_margin for each in way.stretches}) > 3


@pytest.mark.parametrize("outline", [FLAT, STOWED, RAISED, KENAF])
def test_a_continuous_transition_is_as_good_as_the_poses_beside_it(outline):
    # hand: energy margin over v^2 / 2g, at most 1
    speed = 2.0
    way = along(FLIGHT, outline, speed=speed)
    path = way.traverse.path
    rises = np.minimum(path.margins.back_rise, path.margins.front_rise)
    found = [each for each in way.transitions if each.reversible]
    for each in found:
        row = way.stretches[each.end].rows[0]
        assert each.start == each.end - 1
        assert each.x == (path.x[row - 1], path.x[row])
        assert each.inclination == (path.inclination[row - 1], path.inclination[row])
        assert (each.rotation, each.fall, each.energy, each.rate) == (0.0, 0.0, 0.0, 0.0)
        assert (each.impact_speed, each.topples) == (0.0, False)
        share = min(rises[row - 1], rises[row]) / (speed**2 / 2 / STANDARD_GRAVITY)
        assert each.quality == pytest.approx(min(max(share, 0.0), 1.0), rel=1e-12)
    assert found
    qualities = [each.quality for each in way.transitions]
    assert way.quality == (min(qualities) if way.arrived else 0.0)
    assert outline is not FLAT or 0 < min(qualities) < max(qualities) == 1.0


def test_a_loss_begins_on_the_stretch_that_holds_its_pose():
    way = along(FLIGHT, RAISED)
    rows = [each.pose for each in way.traverse.path.events if each.kind.name in LOSSES]
    assert len(rows) == len(way.losses) > 1
    for row, loss in zip(rows, way.losses, strict=True):
        first, end = way.stretches[loss.start].rows
        assert first <= row < end
        assert loss.end == loss.start + 1


LOSSES = ("NOSE_DROPS", "TIPS_BACK")


def test_a_loss_that_topples_with_momentum_has_no_quality():
    """Kenaf nose first down 197/254 mm: the next contact would arrest it but for the momentum."""
    steep = Profile.of_stairs(Stairs(rise=0.197, going=0.254, steps=3))
    losses = along(steep, descending=True).losses
    topples = [each for each in losses if each.topples and each.end is not None]
    assert topples
    assert [each.quality for each in topples] == [0.0] * len(topples)
    assert all(each.quality > 0.0 for each in losses if not each.topples)


def test_classes_by_energy():
    """By hand: 1 m/s lifts by 1/(2 g) = 50.986 mm."""
    assert energy_class(0.0510, speed=1.0) is Balance.STABLE
    assert energy_class(0.0509, speed=1.0) is Balance.EDGE
    assert energy_class(0.0, speed=0.0) is Balance.STABLE
    assert energy_class(-1e-9, speed=0.0) is Balance.UNSTABLE


@pytest.mark.parametrize("speed", [-0.1, math.nan, math.inf])
def test_a_speed_without_meaning(speed):
    with pytest.raises(InputError, match="write a speed from 0 on"):
        along(speed=speed)


@pytest.mark.parametrize(
    ("how", "expected"),
    [  # by hand
        ({"fall": 0.0, "com_height": 0.2, "kinetic": 0.0, "barrier": 1.0}, 1.0),
        ({"fall": 0.3, "com_height": 0.2, "kinetic": 0.0, "barrier": 1.0}, 0.0),
        ({"fall": 0.1, "com_height": 0.2, "kinetic": 0.5, "barrier": 1.0}, 0.25),
        ({"fall": 0.0, "com_height": 0.2, "kinetic": 2.0, "barrier": 1.0}, 0.0),
        ({"fall": 0.0, "com_height": 0.2, "kinetic": 0.0, "barrier": 0.0}, 1.0),
        ({"fall": 0.0, "com_height": 0.2, "kinetic": 0.1, "barrier": 0.0}, 0.0),
        ({"fall": 0.0, "com_height": 0.2, "kinetic": 1.0, "barrier": 0.5}, 0.0),
        ({"fall": -0.1, "com_height": 0.2, "kinetic": 0.5, "barrier": 1.0}, 0.5),
    ],
)
def test_quality(how, expected):
    assert quality(**how) == pytest.approx(expected, abs=1e-12)


def test_all_poses_on_level_ground():
    """By hand: on its tail the centroid stands over the disc's foot at tan = (L - C_L)/(C_N - R).

    On its nose likewise with C_L.
    """
    tall = Robot(
        name="tall",
        com_from_front=0.2,
        com_height=0.25,
        track=Track(flat_length=0.5, front_radius=0.05, rear_radius=0.05),
    )
    level = Profile.of_points([(-2, 0), (2, 0)])
    down, flat, up = stable_poses(level, Outline.of(tall), 0.3)
    assert [each.balance for each in (down, flat, up)] == [
        Balance.UNSTABLE, Balance.STABLE, Balance.UNSTABLE,
    ]  # fmt: skip
    assert flat.inclination == pytest.approx(0.0, abs=1e-9)
    assert flat.z == pytest.approx(0.25, abs=1e-9)
    assert up.inclination == pytest.approx(math.atan2(0.3, 0.2), abs=1e-8)
    assert down.inclination == pytest.approx(-math.atan2(0.2, 0.2), abs=1e-8)
    assert up.z == pytest.approx(0.05 + math.hypot(0.3, 0.2), abs=1e-8)


def test_a_pose_of_the_way_is_among_all_poses():
    """Agreement: what the traverse passes is a stable pose there, unless it leans on a face."""
    run = along(FLIGHT, FLAT).traverse.path
    apart = np.diff(run.s, prepend=-1.0, append=np.inf) > 1e-3  # m: not where contacts change
    upright = run.margins.steepest_face < math.radians(80)
    rows = np.flatnonzero(upright & apart[:-1] & apart[1:])[::5]
    assert len(rows) > 16
    choices = set()
    for row in rows:
        here = stable_poses(FLIGHT, FLAT, float(run.x[row]))
        stable = [each.inclination for each in here if each.balance is Balance.STABLE]
        assert min(abs(phi - run.inclination[row]) for phi in stable) < 1e-9  # the same kernel
        assert [each.balance for each in here[::2]] == [here[0].balance] * len(here[::2])
        choices.add(len(stable))
    assert choices == {1, 2}  # somewhere there is a choice: nose on this step or on the next


def test_a_place_without_meaning():
    with pytest.raises(InputError, match="not a finite place"):
        stable_poses(FLIGHT, FLAT, math.nan)


def test_status_of_the_climb_is_kept():
    assert along(FLIGHT, STOWED).traverse.status is contact.Status.FELL_BACKWARD


# transitions of records made by hand


def test_contacts_that_are_made_later_begin_a_stretch_and_losses_begin_in_theirs(monkeypatch):
    """Stretches of the rows 0 to 3, 4 to 6 and 7 to 9; what is made at row 0 is the first."""
    Event = contact.Event
    events = [
        (Event.MADE, 0), (Event.NOSE_DROPS, 3), (Event.MADE, 4), (Event.TIPS_BACK, 4),
        (Event.ARRESTED, 7), (Event.TAIL_RESTS, 7), (Event.TIPS_BACK, 9),
    ]  # fmt: skip
    run = SimpleNamespace(
        events=[SimpleNamespace(kind=kind, pose=row) for kind, row in events],
        rotations=["first", "second", "third"],
    )
    stretches = [
        SimpleNamespace(number=k, rows=rows) for k, rows in enumerate(((0, 4), (4, 7), (7, 10)))
    ]
    monkeypatch.setattr(contact, "impact_speeds", lambda run: np.array([0.1, 0.2, 0.3]))
    monkeypatch.setattr(module, "_continuous", lambda run, end, row, speed: (end, row))
    monkeypatch.setattr(module, "_loss", lambda found, *given: given)
    found = module._transitions(SimpleNamespace(path=run), stretches, 0.1)
    assert found == [
        ("first", 0.1, Change.NOSE_DROPS, 0), (1, 4), ("second", 0.2, Change.TIPS_BACK, 1),
        (2, 7), ("third", 0.3, Change.TIPS_BACK, 2),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("rises", "speed", "by_hand"),
    [
        ((0.5, 0.2, 0.3, 0.1), 2.0, 0.98),  # of rows 1 and 2 the smaller: 0.2 m of 0.204
        ((0.1, 0.3, 0.2, 0.1), 2.0, 0.98),
        ((0.1, 0.3, 0.25, 0.1), 2.0, 1.0),
        ((0.1, -0.3, 0.25, 0.1), 2.0, 0.0),
        ((0.1, 0.0, 0.25, 0.1), 0.0, 1.0),  # what needs nothing has all of it
    ],
)
def test_the_quality_of_a_change_of_contacts_is_that_before_and_after(
    rises, speed, by_hand, monkeypatch
):
    monkeypatch.setattr(module, "_energy", lambda run: np.array(rises))
    run = SimpleNamespace(x=np.arange(4.0), inclination=0.1 * np.arange(4.0))
    found = module._continuous(run, 1, 2, speed)
    # half of 4 m^2/s^2 over g are 0.2039 m
    assert found.quality == pytest.approx(by_hand, abs=1e-3)
    assert (found.start, found.end, found.x, found.inclination) == (0, 1, (1.0, 2.0), (0.1, 0.2))


@pytest.mark.parametrize("arrested", [True, False])
@pytest.mark.parametrize("topples", [True, False])
def test_a_loss_that_topples_or_is_not_arrested_is_worth_nothing(arrested, topples, monkeypatch):
    monkeypatch.setattr(module, "quality", lambda **given: 0.7)
    start, end = (SimpleNamespace(x=x, z=0.5 - x, inclination=-x) for x in (0.1, 0.2))
    rotation = SimpleNamespace(
        start=start, end=end, topples_with_momentum=topples, arrested=arrested, sense=-1,
        angle=0.1, rate_before=2.0, kinetic=0.0, barrier=1.0,
    )  # fmt: skip
    found = SimpleNamespace(outline=KENAF)
    loss = module._loss(found, rotation, 0.3, Change.NOSE_DROPS, 4)
    assert loss.quality == (0.7 if arrested and not topples else 0.0)
    assert loss.end == (5 if arrested else None)
    assert (loss.rotation, loss.fall) == (-0.1, pytest.approx(0.1))
