"""Underside on a flight, whether one flat carries, and what is driven, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import Placement
from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.robot import Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import driving
from kaidan.traversal.criterion import Tread
from kaidan.traversal.driving import (
    CLEARANCE,
    LONGEST,
    criterion_of,
    ground_for,
    refuse_too_long,
    span,
    tread_of,
    way,
    whole_of,
)

L, C_L, C_N, REAR, FRONT = 0.5, 0.2, 0.1, 0.06, 0.08
TRACK = (C_L - L, REAR - C_N, REAR, C_L, FRONT - C_N, FRONT)
STEPS = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=4))


class Body(SimpleNamespace):
    """What a drive knows of an outline, itself alone equal to itself."""

    __eq__, __hash__ = object.__eq__, object.__hash__


def robot(*others, kinds=(), main=TRACK, tips_below=False):
    return Body(
        parts=np.array([main, *others]),
        discs=[tuple(part[k : k + 3]) for part in (main, *others) for k in (0, 3)],
        kinds=np.array([contact.TRACK, *kinds]),
        stance=SimpleNamespace(
            flat_length=L, com_height=C_N, com_from_front=C_L, tips_below=tips_below
        ),
        gyration=0.15, reach=(0.4, 0.3), lead=0.3, trail=0.35,
    )  # fmt: skip


def disc(x, above, radius=0.03):
    """Disc whose lower edge lies so far above the flat."""
    return x, radius - C_N + above, radius


def flipper(above, x=C_L + 0.3):
    return robot((*disc(C_L, 0.05), *disc(x, above)), kinds=[contact.FLIPPER])


def test_the_underside_by_hand():
    assert tread_of(robot()) == Tread(L, C_L, C_N, FRONT, REAR, 0.15, whole=True)
    # one flipper in line lengthens it ahead, one behind
    for above, found in ((2.9e-7, (C_L + 0.3, 0.03)), (3.1e-7, (C_L, FRONT))):
        tread = tread_of(flipper(above))
        assert (tread.C_L, tread.R, tread.R_downhill) == pytest.approx((*found, REAR))
    behind = tread_of(flipper(0.0, C_L - L - 0.2))
    assert (behind.C_L, behind.R, behind.R_downhill) == (C_L, FRONT, 0.03)
    assert behind.whole


def test_one_flat_carries_where_one_track_lies_all_along():
    rear = (*disc(C_L - L, 0.0), *disc(C_L - 0.3, 0.0))
    front = (*disc(C_L - 0.2, 0.0), *disc(C_L, 0.0))
    assert not tread_of(robot(front, kinds=[contact.TRACK], main=rear)).whole  # a gap
    for kind in (contact.FLIPPER, contact.BELLY):
        assert tread_of(robot(front, kinds=[kind])).whole
    raised = (*disc(C_L - 0.2, 0.01), *disc(C_L, 0.01))
    assert tread_of(robot(raised, kinds=[contact.TRACK])).whole
    for rear, front in ((0.0, 0.01), (0.01, 0.0)):  # a tapered track
        main = (*disc(C_L - L, rear), *disc(C_L, front))
        flipper = (*disc(0, 0.0), *disc(0.1, 0.2))
        assert not tread_of(robot(flipper, kinds=[contact.FLIPPER], main=main)).whole


def whole(body, holds=True):
    return whole_of(tread_of(body), SimpleNamespace(holds=holds), body)


@pytest.mark.parametrize("x", [C_L + 0.3, C_L - L - 0.3])
def test_no_flat_carries_where_it_may_rock_onto_a_flipper(x):
    """About the tip of the flat by rocking: 0.3 sin - (r + h) cos + r is zero."""
    r, angle = 0.03, contact.ROCKING
    reached = (r + 0.3 * math.sin(angle)) / math.cos(angle) - r
    for above, alone in ((reached + 1e-6, True), (reached - 1e-6, False), (1e-4, False),
                         (9e-7, False), (2e-7, True), (0.3, True)):  # fmt: skip
        assert whole(flipper(above, x)) is alone
        turned = flipper(above, x)  # the stance stays as it is nose first
        turned.parts = turned.parts[:, [3, 4, 5, 0, 1, 2]] * [-1, 1, 1, -1, 1, 1]
        assert whole(turned) is alone
    assert whole(flipper(1e-4, 0.0))  # over the flat itself nothing rocks onto it
    assert whole(robot((*disc(0.0, 0.05), *disc(x, 1e-4)), kinds=[contact.BELLY]))


def test_where_the_criterion_has_no_say():
    assert whole(robot())
    assert whole(robot(), holds=False)
    assert not whole(robot(), holds=None)
    assert not whole(robot(tips_below=True))
    rear = (*disc(C_L - L, 0.0), *disc(C_L - 0.3, 0.0))
    front = (*disc(C_L - 0.2, 0.0), *disc(C_L, 0.0))
    assert not whole(robot(front, kinds=[contact.TRACK], main=rear))


def test_the_way_of_the_centroid():
    """From before the first riser until all of the robot is on the landing."""
    first, last = STEPS.points[[1, -2], 0]
    body = robot()
    begin, end = first - 0.3 - CLEARANCE, last + 0.35 + CLEARANCE
    assert span(STEPS, body, None, None) == pytest.approx((begin, end))
    start = Placement(0.2, 0.3, 0.4)
    assert span(STEPS, body, start, None) == pytest.approx((0.2, end))
    assert span(STEPS, body, None, 0.7) == pytest.approx((begin, 0.7))
    given = way(STEPS, body, start, 0.7)
    assert (given["x_start"], given["x_end"], given["inclination"]) == (0.2, 0.7, 0.4)
    assert given["gyration"] == 0.15
    assert way(STEPS, body, None, None)["inclination"] == 0.0


def test_landings_as_long_as_the_longest_of_some_robots():
    """Reaches of 0.7 m and a metre: two metres; of 1.2 m three."""
    longer = Body(reach=(0.4, 0.8))
    for bodies, clear in (([robot()], 2), ([robot(), longer], 3), ([longer, robot()], 3)):
        ground = ground_for(STEPS, bodies)
        np.testing.assert_array_equal(ground[1:-1], STEPS.points)
        np.testing.assert_allclose(ground[0], STEPS.points[0] - (clear, 0))
        np.testing.assert_allclose(ground[-1], STEPS.points[-1] + (clear, 0))


@pytest.mark.parametrize("a", [0.0, 0.7])
def test_the_criterion_sees_a_flight_rise_whichever_way_it_is_driven(a):
    body = Outline.of(Robot.named("kenaf"))
    up_tread, up = criterion_of(STEPS, body, a)
    tread, down = criterion_of(STEPS.reflected(), body.turned_round(), -a)
    assert tread == pytest.approx(up_tread)
    for one, other in zip(up.losses, down.losses, strict=True):
        assert one == pytest.approx(other)


def test_what_no_kernel_is_waited_for(monkeypatch):
    """Points, and poses along and up, at a step."""
    profile = Profile.of_points([(0.0, 0.0), (1.0, 0.5), (2.0, 0.0), (3.0, 0.0)])
    poses = LONGEST - 4
    for more, refused in ((0, False), (2, True)):
        step = (3.0 + 1.0) / (poses + more)
        if refused:
            with pytest.raises(InputError, match="4 points over 3 m are more than one traverse"):
                refuse_too_long(profile, robot(), (-1.0, 2.0), step)
        else:
            refuse_too_long(profile, robot(), (-1.0, 2.0), step * (1 + 1e-9))
    monkeypatch.setattr(contact, "kernel_in_use", lambda: "plain")
    for seconds, refused in ((59.0, False), (60.0, False), (61.0, True)):
        monkeypatch.setattr(contact, "plain_seconds", lambda *given, s=seconds: s)
        if refused:
            with pytest.raises(InputError, match="too many without the native"):
                refuse_too_long(profile, robot(), (-1.0, 2.0), 0.1)
        else:
            refuse_too_long(profile, robot(), (-1.0, 2.0), 0.1)
    assert driving.LONG == 60.0
