"""Pieces of a drive by hand: what grazes, what changes, what is let down again, how it ends.

Random traverses of which every pose is looked at are in `test_paths_by_geometry.py`; these are the
branches that hardly any of them takes.
"""

import itertools
import math
from dataclasses import astuple

import numpy as np
import pytest

from contact_cases import stadium, steps
from kaidan.contact import (
    Event,
    Feature,
    FeatureKind,
    RotationOutcome,
    Status,
    body_table,
    ground_table,
    settle,
)
from kaidan.contact.codes import ROCKING, Advance
from kaidan.contact.kernel import (
    advance,
    contact_changes,
    continuation,
    driver,
    recording,
    reserves,
)
from kaidan.contact.kernel.settling import lever
from kaidan.contact.layout import (
    DISC_1,
    DISC_2,
    PART,
    POINT,
    EventRow,
    Held,
    Journey,
    Log,
    Pose,
    Pull,
    Release,
    RotationRow,
)
from kernel_memory import made, nothing, posed, scene, table, written

L, C_L, C_N, R = 0.6, 0.28, 0.1, 0.08
TRACK = stadium(L, C_L, C_N, R)
BODY = body_table(TRACK)
LEVEL = ground_table([(-4, 0), (4, 0)])
REAR, FRONT = (Feature(0, 0, kind).code for kind in (FeatureKind.DISC_1, FeatureKind.DISC_2))
FLOOR = scene(LEVEL, BODY)
ON_LEVEL = Held(0.3, C_N, 0.0, 1.0, 0.0, 0.0, REAR, FRONT)
STRAIGHT = Pull(0.0, 9.8)
ARM = 0.3  # m by which inclination counts in arclength


def vertex(point):
    return Feature(point, 0, FeatureKind.VERTEX).code


@pytest.mark.parametrize("kind", [FeatureKind.VERTEX, FeatureKind.DISC_1, FeatureKind.DISC_2])
@pytest.mark.parametrize("phi", [0.3, -0.2])
def test_rate_of_a_lever(kind, phi):
    """Central difference along a direction: a vertex stays, a disc's foot runs on its segment."""
    ground = ground_table([(-2, -0.4), (-0.5, 0.0), (0.5, 0.3), (2, 0.2)])
    body = body_table([[-0.32, -0.02, 0.08, 0.28, 0.03, 0.05]])
    feature = Feature(1, 0, kind).code
    x, z, way = 0.1, 0.4, np.array([0.6, -0.3, 0.5])

    def at_share(ds):
        there = phi + ds * way[2] / ARM
        place = x + ds * way[0], z + ds * way[1]
        return lever(scene(ground, body), feature, posed(*place, there), 0.0)

    numeric = (at_share(1e-6) - at_share(-1e-6)) / 2e-6
    held = Held(x, z, phi, *way, feature, feature)
    rate = advance.lever_rate(scene(ground, body), feature, held, posed(x, z, phi))
    assert rate == pytest.approx(numeric, abs=1e-8)  # central difference, 1e-12 / 1e-6


def grazes(sign, v0, v1, rate0, rate1, ds, kappa=0.0, kappa1=0.0, up=0.5):
    """A vertex that is ahead (behind) by v0 and v1 [m], from it by the rates of a step's ends."""
    ground = ground_table([(-3, -1), (0, 0), (3, -1)])
    x0, x1 = -sign * v0, -sign * v1
    held = Held(x0, up, 0.1, -sign * rate0, 0.0, 0.0, vertex(1), vertex(1))
    there = Held(x1, up, 0.2, -sign * rate1, 0.0, 0.0, vertex(1), vertex(1))
    return advance.may_graze(scene(ground, BODY), held, there, sign > 0.0, kappa, kappa1, ds)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_may_graze_within_a_step(sign):
    """Tangents of 1 down and 1 up again meet half of a step further, half of it lower."""
    assert grazes(sign, 0.01, 0.01, -1.0, 1.0, 0.021)
    assert not grazes(sign, 0.01, 0.01, -1.0, 1.0, 0.019)
    # down by 2, up by 0.5 and 1 mm lower there: at 0.4 (0.5 + 0.05) / 2.5 of 20 mm
    meet = (0.009 - 0.01 - 0.5 * 0.02) / -2.5
    assert grazes(sign, 0.01, 0.009, -2.0, 0.5, 0.02) == (0.01 - 2.0 * meet <= 0.0)
    assert grazes(sign, 2.0 * meet - 1e-6, 2.0 * meet - 1e-3 - 1e-6, -2.0, 0.5, 0.02)
    assert not grazes(sign, 2.0 * meet + 1e-6, 2.0 * meet - 1e-3 + 1e-6, -2.0, 0.5, 0.02)
    assert not grazes(sign, 0.01, 0.01, 1.0, 1.0, 0.03), "it moves away"
    assert not grazes(sign, 0.01, 0.01, -1.0, -1.0, 0.03), "it still comes nearer"
    assert not grazes(sign, 0.01, 0.0301, -9.0, 9.0, 0.01), "farther than three steps"
    assert grazes(sign, 0.01, 0.0299, -9.0, 9.0, 0.01)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_what_the_tilt_at_the_end_hides(sign):
    """Passed under the tilt at the start, not under that at the end, 0.5 m below the centroid."""
    rates = (1.0, -1.0)
    assert grazes(sign, 0.02, 0.01, *rates, 0.01, kappa=-sign * 0.021)
    assert not grazes(sign, 0.02, 0.01, *rates, 0.01, kappa=-sign * 0.019)
    both = {"kappa": -sign * 0.03, "kappa1": -sign * 0.03}
    assert not grazes(sign, 0.02, 0.01, *rates, 0.01, **both)


def with_thin_end(above):
    """A second part whose thin end, 1 mm in radius, lies so far above the floor [m]."""
    return body_table([*TRACK, [0.28, -0.02, 0.05, 0.6, above + 0.001 - C_N, 0.001]])


@pytest.mark.parametrize(
    ("above", "step"),
    [
        (0.02, 0.008),  # 0.4 of how far it is clear
        (0.001, 0.002),  # not less than a tenth of a step of R/4
        (0.3, 0.012),  # its other end is 30 mm clear
    ],
)
def test_a_thin_part_moves_no_farther_than_it_is_clear(above, step):
    place = scene(LEVEL, with_thin_end(above)), ON_LEVEL
    assert advance.thinnest_radius(place[0].body) == 0.001
    assert advance.careful(*place, 0.5, 0.001) == pytest.approx(step)
    assert advance.careful(*place, 0.5, 0.02) == pytest.approx(0.25 * R)  # no part is thin
    assert advance.careful(*place, 0.5, 0.019) == pytest.approx(max(step, 0.019))
    assert advance.careful(*place, 0.001, 0.001) == 0.001


def test_a_step_is_no_longer_than_a_share_of_what_carries():
    """A quarter of the smallest radius of both parts that carry, whichever of their ends."""
    for parts, least in (
        ([[-0.32, -0.04, 0.06, 0.28, -0.02, 0.08]], 0.06),
        ([[-0.32, -0.02, 0.08, 0.28, -0.05, 0.05]], 0.05),
    ):
        floor = scene(LEVEL, body_table(parts))
        assert advance.careful(floor, ON_LEVEL, 0.5, 0.5) == pytest.approx(0.25 * least)
        assert advance.shallow(floor, REAR, -0.49 * least)
        assert not advance.shallow(floor, REAR, -0.51 * least)
    second = Feature(0, 1, FeatureKind.DISC_1).code
    for pair in ((REAR, second), (second, FRONT)):
        held = Held(*ON_LEVEL[:6], *pair)
        found = advance.careful(scene(LEVEL, with_thin_end(0.3)), held, 0.5, 0.5)
        assert found == pytest.approx(0.25 * 0.001)


def test_the_way_ahead_whatever_the_order_of_contacts():
    level = posed(0.3, C_N, 0.0)
    for pair in ((REAR, FRONT), (FRONT, REAR)):
        t_x, t_z, t_w, size = continuation.tangent(FLOOR, *pair, level)
        assert (t_x, t_z, t_w) == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
        assert size == pytest.approx(L / ARM)  # the two normals up, their feet L apart
    assert continuation.tangent(FLOOR, REAR, REAR, level) == (1.0, 0.0, 0.0, 0.0)


def test_the_way_ahead_of_a_pose_that_turns():
    """On its rear end and a nosing under the flat: in either order of contacts the way is one."""
    ground = ground_table([(-4, 0), (0.45, 0), (0.5, 0.2), (4, 0)])
    found = settle([(-4, 0), (0.45, 0), (0.5, 0.2), (4, 0)], TRACK, 0.45, 0.2)
    assert found.found
    there, place = scene(ground, BODY), posed(0.45, found.z, found.inclination)
    one = continuation.tangent(there, found.rear, found.front, place)
    other = continuation.tangent(there, found.front, found.rear, place)
    assert one == pytest.approx(other, abs=1e-12)
    assert one[0] > 0.0
    assert min(abs(each) for each in one[1:3]) > 1e-3
    both = found.rear, found.front
    moved = [continuation.gap_rate(there, each, place, *one[:3]) for each in both]
    assert moved == pytest.approx([0.0, 0.0], abs=1e-12)


@pytest.mark.parametrize("behind", [L - C_L, -C_L])
def test_no_pose_where_one_contact_is_far(behind):
    """Nose up by 0.3 rad on one end, the other one is 0.18 m off."""
    z = R - (-behind * math.sin(0.3) + (R - C_N) * math.cos(0.3))
    assert not continuation.corrected(FLOOR, REAR, FRONT, 0.3, z, 0.3)[0]


def test_no_pose_on_one_contact_or_far_from_both():
    nowhere = (1.0, 0.0, 0.0)
    for pair, z in (((REAR, REAR), C_N), ((REAR, FRONT), C_N + 0.11), ((REAR, FRONT), C_N - 0.11)):
        good, there, where = continuation.corrected(FLOOR, *pair, 0.3, z, 0.0)
        assert not good
        assert there == (0.3, z, 0.0, *nowhere, *pair)
        assert where == posed(0.3, z, 0.0)
    good, there, _ = continuation.corrected(FLOOR, REAR, FRONT, 0.3, C_N + 0.09, 0.0)
    assert good
    assert there.z == pytest.approx(C_N, abs=1e-12)


def test_a_step_keeps_its_sense():
    good, back, _ = continuation.stepped(FLOOR, ON_LEVEL._replace(t_x=-1.0), 0.01)
    assert good
    assert back == pytest.approx((0.29, C_N, 0.0, -1.0, 0.0, 0.0, REAR, FRONT), abs=1e-12)
    sharp = ON_LEVEL._replace(t_x=0.8, t_w=0.6)  # 37 degrees off the line of poses
    assert not continuation.stepped(FLOOR, sharp, 0.01)[0]


@pytest.mark.parametrize("a", [0.5, -0.5, 0.0, 1.0])
def test_effective_gravity(a):
    """g (kappa_g, 1) down and a against the way: what is behind over what is down."""
    g, kappa_g, psi = 9.8, 0.2, 0.4
    expected = (kappa_g * g + a * math.cos(psi)) / (g + a * math.sin(psi))
    way = 3.0 * math.cos(psi), 3.0 * math.sin(psi)
    pull = Pull(a, g, kappa_g)
    assert continuation.tilt(pull, *way) == pytest.approx(expected)
    assert continuation.tilt(pull, 0.0, 0.0) == kappa_g  # it turns on the spot
    size = math.hypot(a * math.cos(psi), g + a * math.sin(psi))
    assert contact_changes.effective_gravity(pull, *way) == pytest.approx(size)
    assert contact_changes.effective_gravity(pull, 0.0, 0.0) == pytest.approx(math.hypot(a, g))


def test_settled_on_two_contacts_or_not():
    good, (x, z, phi, t_x, t_z, t_w, rear, front) = contact_changes.settled(FLOOR, 0.3, 0.05, 0.0)
    assert good
    assert (x, z, phi) == pytest.approx((0.3, C_N, 0.0), abs=1e-12)
    assert (t_x, t_z, t_w) == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    assert (rear, front) == (REAR, FRONT)
    # on its tail, the centroid behind the rear foot
    good, there = contact_changes.settled(FLOOR, 0.3, 1.53, 0.0)
    assert not good
    assert there[3:6] == (0.0, 0.0, 0.0)


def test_settled_on_feet_that_are_near():
    body = body_table(stadium(0.2, 0.1, 0.1, 0.05))
    assert contact_changes.settled(scene(LEVEL, body), 0.3, 0.0, 0.0)[0]


@pytest.mark.parametrize("way", [(-0.1, 0.9), (0.9, -0.1), (0.6, 0.6)])
@pytest.mark.parametrize("slope", [0.4, 1.0])
def test_of_contacts_in_one_line_the_way_that_is_most_like_it(way, slope):
    """Along the slope, in the sense in which the way before led along it."""
    along = complex(math.cos(slope), math.sin(slope))
    ground = ground_table([(s * along.real, s * along.imag) for s in (-4.0, 4.0)])
    body = body_table([TRACK[0], *ON_ITS_LINE])
    k = int(np.flatnonzero(ground["x"] < 0.0)[-1])
    track = [POINT * k + disc for disc in (DISC_1, DISC_2)]
    made = POINT * k + PART + DISC_2
    place = (0.7 + 1j * C_N) * along
    here = Held(place.real, place.imag, slope, *way, 0.0, *track)
    on = scene(ground, body)
    good, lost, there = contact_changes.exchanged(on, made, here, -math.tan(slope))
    sense = math.copysign(1.0, way[0] * along.real + way[1] * along.imag)
    assert (good, lost) == (True, track[1])
    assert there[3:6] == pytest.approx((sense * along.real, sense * along.imag, 0.0), abs=1e-9)


def test_let_down_again_on_a_line_that_turns():
    """Ahead is what leads on as before, by all of the way: place, height and inclination."""
    stairs = scene(ground_table(steps(0.17, 0.28, 4)), body_table(stadium(0.3, 0.12, 0.06, 0.05)))
    turns = 0
    for x in np.linspace(-0.3, 0.4, 71):
        good, (x, z, phi, *u, rear, front) = contact_changes.settled(stairs, x, 0.3, 0.0)
        if not good or abs(u[2]) < 0.72:
            continue
        turns += 1
        small = math.copysign(0.01, u[0])
        for way, leads in ((u, True), ((small, -u[1], -u[2]), False)):
            here = Held(x, z, phi, *way, rear, front)
            assert contact_changes.settled_again(stairs, here, 0.0)[0] == leads
    assert turns > 2


@pytest.mark.parametrize("t_x", [1.0, -1.0])
def test_let_down_again_a_little_farther_on(t_x):
    """On level ground the first nudge does, unless the pose there is another one."""

    def again(**off):
        place = {"x": 0.3, "z": C_N, "phi": 0.0} | off
        here = Held(*place.values(), t_x, 0.0, 0.0, REAR, FRONT)
        return contact_changes.settled_again(FLOOR, here, 0.0)

    good, nudge, there = again()
    assert good == (t_x > 0.0)  # there the way leads ahead, not back
    if not good:
        assert (nudge, there[0]) == (0.0, 0.3)
        return
    assert nudge == pytest.approx(1e-5)
    assert there[:2] == pytest.approx((0.3 + 1e-5, C_N), abs=1e-12)
    assert again(z=C_N + 4.9e-3)[0]
    assert not again(z=C_N + 5.1e-3)[0]
    assert not again(z=C_N - 5.1e-3)[0]
    assert again(phi=0.019)[0]
    assert not again(phi=0.021)[0]
    assert not again(phi=-0.021)[0]


@pytest.mark.parametrize(
    ("higher", "nudge"), [(4.9e-3, 1e-5), (5.05e-3, 1e-4), (5.5e-3, 1e-3), (1.2e-2, 1e-2)]
)
def test_nudges_grow_tenfold(higher, nudge):
    """Up a slope of 45 degrees it rises by each nudge: the first within 5 mm of where it was."""
    slope = scene(ground_table([(-4, -4), (4, 4)]), BODY)
    z = 0.3 + C_N * math.sqrt(2.0)

    def again(higher):
        here = Held(0.3, z + higher, math.pi / 4, 0.7, 0.7, 0.0, REAR, FRONT)
        return contact_changes.settled_again(slope, here, 0.0)

    good, found, there = again(higher)
    assert good
    assert found == pytest.approx(nudge)
    assert there[:3] == pytest.approx((0.3 + nudge, z + nudge, math.pi / 4), abs=1e-11)
    assert not again(1.6e-2)[0]
    assert not again(0.1)[0]


@pytest.mark.parametrize("opens", [True, False])
def test_the_way_on_is_that_on_which_the_lost_contact_opens(opens):
    """The rear disc on the floor, the flat on nosings in line: ahead it sinks onto the nearer one.

    Lost is the nearer one: the way leads back. Lost is the farther one: it leads ahead.
    """
    phi = math.atan(0.3)
    foot = complex(math.sin(phi), 1.0 - math.cos(phi)) * R  # where the flat begins, above the floor
    points = [foot + along * complex(math.cos(phi), math.sin(phi)) for along in (0.36, 0.55)]
    floor = [(-3.0, 0.0), (0.15, 0.0)]
    near, far = ((each.real, each.imag) for each in points)
    ground = ground_table([*floor, near, ((near[0] + far[0]) / 2, 0.05), far, (3.0, 0.0)])
    centre = complex(-(L - C_L), R - C_N) * complex(math.cos(phi), math.sin(phi))
    com = complex(0.0, R) - centre
    held, made = (vertex(2), vertex(4)) if not opens else (vertex(4), vertex(2))
    here = Held(com.real, com.imag, phi, 1.0, 0.0, 0.0, REAR, held)
    on = scene(ground, BODY)
    good, lost, there = contact_changes.exchanged(on, made, here, 0.0)
    assert good
    assert lost == held
    assert there[6:] == (REAR, made)
    assert (there[3] > 0.0) == opens
    # where the corrector would move it by more than rounding, the way is that of the pose it has
    beside = here._replace(z=here.z + 1e-5)
    for place in (here, beside):
        _, _, there = contact_changes.exchanged(on, made, place, 0.0)
        at = posed(there.x, there.z, phi)
        rates = [continuation.gap_rate(on, each, at, *there[3:6]) for each in (REAR, made)]
        assert rates == pytest.approx([0.0, 0.0], abs=1e-8)
        assert there[1] == pytest.approx(place[1], abs=1e-11)


def test_an_exchange_for_itself_has_no_line():
    good, lost, there = contact_changes.exchanged(FLOOR, REAR, ON_LEVEL, 5.0)
    assert (good, lost) == (False, FRONT)  # so far leans gravity that the rear foot is ahead
    assert there == ON_LEVEL


@pytest.mark.parametrize(
    ("kappa", "sense"), [(0.0, 0.0), (3.3, 1.0), (3.1, 0.0), (-2.9, -1.0), (-2.7, 0.0)]
)
def test_onset_of_a_rotation(kappa, sense):
    """0.1 m up the feet lie L - C_L = 0.32 m behind and C_L = 0.28 m ahead."""
    assert contact_changes.onset(FLOOR, ON_LEVEL, kappa) == sense


@pytest.mark.parametrize(
    ("outcome", "sense", "status", "event"),
    [
        (RotationOutcome.PAST_VERTICAL, 1.0, Status.FELL_BACKWARD, Event.FELL_BACKWARD),
        (RotationOutcome.PAST_VERTICAL, -1.0, Status.FELL_FORWARD, Event.FELL_FORWARD),
        (RotationOutcome.ROCKING, 1.0, Status.FELL_BACKWARD, Event.FELL_BACKWARD),
        (RotationOutcome.ROCKING, -1.0, Status.FELL_FORWARD, Event.FELL_FORWARD),
        (RotationOutcome.PAST_VERTICAL, 0.5, Status.FELL_BACKWARD, Event.FELL_BACKWARD),
        (RotationOutcome.WEDGED, 1.0, Status.STUCK, Event.STUCK),
        (RotationOutcome.ENDLESS, 1.0, Status.NOT_CONVERGED, Event.STUCK),
    ],
)
def test_how_a_rotation_ends_that_nothing_arrests(outcome, sense, status, event):
    assert driver.end_of_fall(outcome, sense) == (status, event)


def step_on(x_end, step=0.01):
    return driver.step_on(FLOOR, ON_LEVEL, x_end, step, R, STRAIGHT)


@pytest.mark.parametrize(
    ("x_end", "ds", "ends"),
    [(0.304, 0.004, True), (0.31, 0.01, True), (0.3101, 0.01, False), (0.3, 0.01, False)],
)
def test_a_step_is_cut_where_the_robot_arrives(x_end, ds, ends):
    what, there, moved, over = step_on(x_end)
    assert what == Advance.NOTHING
    assert (moved, there[0]) == pytest.approx((ds, 0.3 + ds), abs=1e-12)
    assert over == ends


def log_of(poses=200, events=50, rotations=20, *, keeps=True, **so_far):
    """Log to be filled by a drive, and its tables."""
    sizes = {Pose: poses, EventRow: events, RotationRow: rotations}
    tables = [nothing(kind, size) for kind, size in sizes.items()]
    return Log(*map(table, sizes, tables), keeps, **so_far), tables


def of_log(log, tables):
    """Which rows of its tables have been written."""
    for each in (log.poses, log.events, log.rotations):
        each.flush()
    return [written(rows).tolist() for rows in tables]


def over_a_step(x_start=-1.5, phi=0.0, a=0.0, ground=None, body=BODY, **sizes):
    ground = ground_table(steps(0.15, 0.3, 1)) if ground is None else ground
    way = Journey(x_start, 1.2, phi, 0.01, 0.2)
    return driver.drive(scene(ground, body), way, Pull(a, 9.8), log_of(**sizes)[0])


@pytest.mark.parametrize("count", [1, 3])
def test_a_drive_of_which_no_pose_is_kept_ends_as_the_others_do(count):
    """With as many events and rotations; no pose is written, and the room for them no bound."""
    stairs = scene(ground_table(steps(0.15, 0.3, count)), BODY)
    for tilt in (0.0, 0.1, 0.4):
        way = stairs, Journey(-1.5, 1.2, 0.0, 0.01, 0.2), Pull(0.0, 9.8, tilt)
        kept = driver.drive(*way, log_of(poses=900)[0])
        log, tables = log_of(poses=100, keeps=False)
        bare = driver.drive(*way, log)
        assert (bare[0], *bare[2:]) == (kept[0], *kept[2:])
        assert bare[1] == 0
        poses, _, rotations = of_log(log, tables)
        assert not any(poses)
        assert all(rotations[: kept[3]])


def test_full_tables_end_a_drive():
    whole = over_a_step(poses=600)
    assert whole[0] == Status.OK
    assert over_a_step(poses=12) == (Status.TOO_LONG, 10, 0, 0)
    status, poses, events, rotations = over_a_step(poses=600, events=6)
    assert (status, events) == (Status.TOO_LONG, 2)
    assert poses < whole[1]
    assert over_a_step(poses=600, rotations=whole[3]) == whole
    status, *_, rotations = over_a_step(poses=600, rotations=whole[3] - 1)
    assert (status, rotations) == (Status.TOO_LONG, whole[3] - 1)


def test_no_start_where_it_falls_at_once():
    assert over_a_step(phi=1.53) == (Status.NO_START, 0, 0, 0)
    # the rear foot 20 mm behind the centroid, 0.5 m up: a of 0.4 m/s^2 leans gravity by 20.4 mm
    tall = body_table([[-0.02, 0.08 - 0.5, 0.08, 0.58, 0.08 - 0.5, 0.08]])
    assert over_a_step(a=0.40, body=tall)[0] == Status.NO_START
    assert over_a_step(a=0.38, body=tall)[1] > 0


def test_momentum_is_written_as_it_is():
    row = table(RotationRow, 1)[0]
    for topples in (True, False):
        recording.write_momentum(row, 0.3, 0.2, 0.1, topples)
        assert momentum_of(row) == (0.3, 0.2, 0.1, topples)


def momentum_of(row):
    return row.kinetic, row.barrier, row.barrier_across, row.topples_with_momentum


def test_a_rotation_repeats_one_of_the_twelve_before():
    each = [{"start.x": k, "start.inclination": 0.3, "sense": 1.0} for k in range(16)]

    def repeats(row, last, **off):
        rows = table(RotationRow, made(RotationRow, *each))
        rows[last].sense = rows[row].sense + off.get("sense", 0.0)
        rows[last].start.x = rows[row].start.x + off.get("x", 0.0)
        rows[last].start.inclination += off.get("inclination", 0.0)
        return recording.repeats(rows, last + 1)

    assert not repeats(13, 13)
    assert repeats(2, 13)  # eleven rows between them
    assert not repeats(1, 13)
    assert repeats(0, 3)
    assert repeats(12, 13)
    for off in ({"x": 2e-8}, {"x": -2e-8}, {"inclination": 2e-8}, {"inclination": -2e-8},
                {"sense": -2.0}):  # fmt: skip
        assert not repeats(12, 13, **off)
    assert repeats(12, 13, x=9e-9, inclination=-9e-9)


# --- on a slope, in any place -------------------------------------------------------------------

INCLINED = 0.4
SLOPE = ground_table([(s * math.cos(INCLINED), s * math.sin(INCLINED)) for s in (-4.0, 4.0)])
ON_ITS_LINE = [[0.2, R - C_N, R, 0.6, R - C_N, R], [-0.3, R - C_N, R, -0.7, R - C_N, R]]
"""Parts whose far ends lie ahead of the track and behind it, on the line of its flat."""


def on_slope(along, up=0.0):
    c, s = math.cos(INCLINED), math.sin(INCLINED)
    return along * c - (C_N + up) * s, along * s + (C_N + up) * c


def test_settled_on_a_slope():
    x, z = on_slope(0.7)
    good, there = contact_changes.settled(scene(SLOPE, BODY), x, INCLINED - 0.05, 0.1)
    assert good
    way = (math.cos(INCLINED), math.sin(INCLINED), 0.0)
    assert there[:6] == pytest.approx((x, z, INCLINED, *way), abs=1e-9)


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("ahead", [True, False])
def test_of_contacts_in_one_line_the_way_goes_on_as_before(ahead, sense):
    """The lost contact neither opens nor sinks in: the pose slides along the slope as it did."""
    body = body_table([TRACK[0], *ON_ITS_LINE])
    k = int(np.flatnonzero(SLOPE["x"] < 0.0)[-1])
    track = [POINT * k + disc for disc in (DISC_1, DISC_2)]
    made = POINT * k + PART * (1 if ahead else 2) + DISC_2
    way = (sense * math.cos(INCLINED), sense * math.sin(INCLINED), 0.0)
    x, z = on_slope(0.7)
    pair = (track[0], made) if ahead else (made, track[1])

    def exchanged(x, z, phi):
        here = Held(x, z, phi, *way, *track)
        # hand: gravity square to the slope meets it under the centroid, between all feet
        return contact_changes.exchanged(scene(SLOPE, body), made, here, math.tan(INCLINED))

    good, lost, there = exchanged(*on_slope(0.7, 1e-9), INCLINED)
    assert (good, lost) == (True, track[1 if ahead else 0])
    assert there == pytest.approx((x, z, INCLINED, *way, *pair), abs=1e-11)
    # nothing is moved farther than rounding tells
    for off in ((0.0, 1e-5, 0.0), (0.0, 0.0, 1e-5)):
        moved = (x + off[0], z + off[1], INCLINED + off[2])
        good, _, there = exchanged(*moved)
        assert good
        assert there[:3] == moved


def test_the_way_of_a_pose_follows_the_normals_of_the_belt():
    """About the point in which they meet; in the sense of the rigid outline's way."""
    parts = [-0.3, 0.0, 0.1, 0.3, 0.0, 0.1]
    # a nosing under the flat, and one some way round an end, whose normal is the flat's, pressed
    for end, angle in itertools.product((1.0, -1.0), (0.1, 0.3, 0.6)):
        off = 0.1 * np.array([end * math.sin(angle), -math.cos(angle)])
        places = [(0.05, -0.1), (end * 0.3 + off[0], off[1])]
        points = sorted([*places, *((p[0] + 0.1, -2.0) for p in places), (-3, -3), (3, -3)])
        ground = ground_table(points)
        one, other = (POINT * int(np.argmin(np.abs(ground["x"] - p[0]))) for p in places)
        rear, front = (one, other) if end > 0 else (other, one)
        ways = [(1.0, 0.2), (-1.0, 0.2), (0.05, 1.0), (0.0, 0.0), (0.0, 1.0), (0.0, -1.0)]
        ways += [(-1.0, 0.0), (-1e-13, 0.0), (0.02, 1.0), (0.02, -1.0)]  # square to it, or nearly
        for t_x, t_z in ways:
            pose = table(Pose, 1)[0]
            held = Held(0.0, 0.0, 0.0, t_x, t_z, 0.0, rear, front)
            recording.record_pose(scene(ground, body_table([parts])), pose, 2.5, held, 3)
            touch = pose.front if end > 0 else pose.rear
            n = np.array([touch.n_x, touch.n_z])
            rigid = np.array([-end * math.sin(angle), math.cos(angle)])
            pressed = abs(n - rigid).max() > 1e-9
            if not pressed:
                assert angle == 0.6  # the arc is beyond what yields
                expected = math.atan2(t_z, t_x) if math.hypot(t_x, t_z) > 1e-12 else 0.0
            else:
                # where the normals meet: that of the nosing under the flat runs up at 0.05
                reach = (0.05 - places[1][0]) / n[0] if abs(n[0]) > 1e-12 else math.inf
                if math.isinf(reach):
                    u = np.array([1.0, 0.0])  # both normals upright: level
                else:
                    meet = np.array([0.05, places[1][1] + reach * n[1]])
                    u = np.array([meet[1], -meet[0]]) / np.hypot(*meet)
                if math.hypot(t_x, t_z) > 0.0 and abs(u @ (t_x, t_z)) < 1e-12:
                    continue  # square to it
                ahead = math.copysign(1.0, u @ (t_x, t_z))
                expected = math.atan2(ahead * u[1], ahead * u[0])
            assert math.cos(pose.path_direction - expected) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("x", [-0.1, 0.1, 0.3, 0.45])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_small_step_leads_along_the_way_forth_and_back(x, sense):
    """On stairs the way is that on which the next pose lies, its sense that of the step."""
    stairs, ds = scene(ground_table(steps(0.17, 0.28, 4)), BODY), 1e-5
    good, (x, z, phi, *way, rear, front) = contact_changes.settled(stairs, x, 0.4, 0.0)
    assert good
    t = sense * np.array(way)
    good, there, _ = continuation.stepped(stairs, Held(x, z, phi, *t, rear, front), ds)
    assert good
    x1, z1, phi1, *u, _, _ = there
    moved = np.array([x1 - x, z1 - z, ARM * (phi1 - phi)]) / ds
    assert moved == pytest.approx(t, abs=1e-3)  # ds over the smallest radius
    assert u == pytest.approx(t, abs=1e-3)


def test_effective_gravity_does_not_hang_on_the_size_of_the_way():
    assert contact_changes.effective_gravity(Pull(3.0, 4.0), 0.0, 1e-6) == pytest.approx(7.0)
    assert contact_changes.effective_gravity(Pull(3.0, 4.0), 0.0, -1e-6) == pytest.approx(1.0)
    assert contact_changes.effective_gravity(Pull(4.0, 4.0), 0.0, -1.0) == 0.0


def rotated(ground, place, pivot, sense, gravity=9.7, gyration=0.2, kept=True):
    """What `rotate` returns, and the row that it writes; None: it writes none."""
    log, tables = log_of(1, 1, 1, keeps=kept, s=2.5)
    release = Release(*place, sense, 0.0)
    found = contact_changes.rotate(scene(ground, BODY), pivot, release, gyration, gravity, log)
    (is_written,) = of_log(log, tables)[2]
    assert log.n_rotation == is_written
    return found, log.rotations[0] if is_written else None


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_momentum_about_the_end_that_comes_down(sense):
    """On a slope one end is down, the other one falls from 0.3 rad above the slope."""
    k = int(np.flatnonzero(SLOPE["x"] < 0.0)[-1])
    ends = {1.0: (DISC_2, C_L), -1.0: (DISC_1, C_L - L)}
    kind, along = ends[sense]
    slope, turn = (complex(math.cos(phi), math.sin(phi)) for phi in (INCLINED, -sense * 0.3))
    com = (0.7 + 1j * R - complex(along, R - C_N) * turn) * slope
    place = com.real, com.imag, INCLINED - sense * 0.3
    gyration = 0.4  # so large that it turns on about the end that comes down
    found, row = rotated(SLOPE, place, POINT * k + kind, sense, gyration=gyration)
    assert found[0] == RotationOutcome.ARRESTED
    foot = 0.7 * slope
    assert (row.pivot_x, row.pivot_z) == pytest.approx((foot.real, foot.imag), abs=1e-12)
    rolled = 0.7 - sense * R * 0.3  # the end that is down rolls by the angle
    com = (rolled - along + 1j * C_N) * slope
    assert found[3:6] == pytest.approx((com.real, com.imag, INCLINED), abs=1e-9)
    arm = complex(ends[-sense][1], -C_N)
    rate = row.rate_after
    assert rate > 0.1
    kinetic = 0.5 * (abs(arm) ** 2 + gyration**2) * rate**2
    assert row.kinetic == pytest.approx(kinetic)
    # the top over that end is farther off
    assert row.barrier > kinetic
    assert not row.topples_with_momentum
    # where only its end counts, what momentum can do is not worked out
    bare, other = rotated(SLOPE, place, POINT * k + kind, sense, gyration=gyration, kept=False)
    assert bare == found
    assert other.barrier == 0.0
    assert astuple(other)[:8] == astuple(row)[:8]


def test_what_is_arrested_at_once_is_no_rotation():
    found, row = rotated(LEVEL, (0.3, C_N, 0.0), FRONT, -1.0)  # its rear foot would go up
    assert found[0] == RotationOutcome.PAST_VERTICAL
    found, row = rotated(LEVEL, (0.3, C_N, 0.0), REAR, -1.0)
    assert found[0] == RotationOutcome.ARRESTED
    assert found.angle < 1e-9
    assert row is None


def test_a_fall_from_upright_is_written_with_no_momentum():
    """It is past the vertical where it begins."""
    found, row = rotated(LEVEL, (0.3, L - C_L, 0.5 * math.pi), REAR, 1.0)
    assert found[0] == RotationOutcome.PAST_VERTICAL
    assert found.angle == 0.0
    assert momentum_of(row) == (0.0, 0.0, 0.0, True)


def test_energy_needed_is_weight_times_rise():
    """The nose drops over an edge onto a floor 0.1 m lower; on about the nose it would rise."""
    ground = ground_table([(-3, 0), (0, 0), (0, -0.1), (3, -0.1)])
    found, row = rotated(ground, (0.01, C_N, 0.0), vertex(1), -1.0)
    assert found[0] == RotationOutcome.ARRESTED
    release = Release(found.x, found.z, found.phi, -1.0, 0.0)
    _, rise, across = reserves.barrier(scene(ground, BODY), found.front, release, ROCKING)
    assert rise > 0.05
    assert row.barrier == pytest.approx(9.7 * rise)
    assert row.barrier_across == across


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_one_contact_by_another_name_turns_on_as_before(sense):
    """Two parts alike: what opens is what closes, and the way is the one before."""
    parts = stadium(0.3, 0.12, 0.06, 0.05)
    stairs = scene(ground_table(steps(0.17, 0.28, 4)), body_table([parts[0], parts[0]]))
    turns = 0
    for x in np.linspace(-0.3, 0.4, 71):
        good, (x, z, phi, *u, rear, front) = contact_changes.settled(stairs, x, 0.3, 0.0)
        if not good or abs(u[2]) < 0.72 or Feature.of(front).part != 0:
            continue
        turns += 1
        way = tuple(sense * each for each in u)
        here = Held(x, z, phi, *way, rear, front)
        good, lost, there = contact_changes.exchanged(stairs, front + PART, here, 0.0)
        assert (good, lost, there[6:]) == (True, front, (rear, front + PART))
        assert there[3:6] == pytest.approx(way, abs=1e-9)
    assert turns > 2


def test_one_contact_by_another_name_is_no_event():
    """The pose that is written last has the other name from then on."""
    both = scene(LEVEL, body_table([TRACK[0], TRACK[0]]))
    made = FRONT + PART
    for keeps in (False, True):
        so_far = {"s": 2.5, "leg": 3, "n_pose": 2, "n_event": 1}
        log, tables = log_of(4, 3, 1, keeps=keeps, **so_far)
        good, there = driver.exchange(both, made, ON_LEVEL, 0.0, log)
        assert good
        assert there == pytest.approx((*ON_LEVEL[:6], REAR, made), abs=1e-12)
        assert {name: getattr(log, name) for name in so_far} == so_far
        assert of_log(log, tables)[:2] == [[False, keeps, False, False], [False] * 3]
    pose = log.poses[1]
    assert (pose.s, pose.leg, pose.rear.feature, pose.front.feature) == (2.5, 3, REAR, made)
