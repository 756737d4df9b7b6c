"""One step along the line of poses: taken whole if nothing happens, else cut at the first event."""

from __future__ import annotations

import math

from kaidan.contact.codes import Advance
from kaidan.contact.kernel.continuation import ARM, stepped, tilt
from kaidan.contact.kernel.event_location import PENETRATED, closing_time, quantity
from kaidan.contact.kernel.gaps import beyond_segment, contact_point, disc_of, part_of, relabelled
from kaidan.contact.kernel.nearest_feature import nearest
from kaidan.contact.kernel.settling import lever
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import (
    KIND_MASK,
    NO_FEATURE,
    POINT_BITS,
    VERTEX,
    At,
    Held,
    Part,
    Pull,
    Scene,
)
from kaidan.contact.memory import Table

#: Features that close within this of one another [m] close together.
TOGETHER = 5e-10
#: Longest step as a share of the smallest radius of the parts that carry: with 0.9 the corrector
#: still lands beyond the arc now and then, with 0.5 never in 20,000 descents.
OF_RADIUS = 0.25
#: Longest step within which an end may pass a corner unseen [m], and how far past it a foot lies.
CORNER = 1e-4
PAST = 1e-9
#: A step within which what happens is not found is cut to this share, so often at most.
SHORTER = 0.4
TRIES = 8


def shallow(scene: Scene, feature: int, distance: float) -> bool:
    """Whether a penetration is shallow enough to tell which feature is hit.

    A disc that has gone in by less than half its radius still has its centre outside; a thin part
    that has gone in farther may be nearer to a face it never met.
    """
    part = part_of(scene, feature)
    return distance > -0.5 * min(part.one.r, part.two.r)


def lever_rate(scene: Scene, feature: int, held: Held, at: At) -> float:
    """Change of a contact's Delta with arclength (tilt of gravity held)."""
    if feature & KIND_MASK == VERTEX:
        return -held.t_x
    disc = disc_of(scene, feature)
    point = scene.ground[feature >> POINT_BITS]
    o_x = at.c * disc.x - at.s * disc.z
    o_z = at.s * disc.x + at.c * disc.z
    turn = held.t_w / ARM
    along = (held.t_x - turn * o_z) * point.u_x + (held.t_z + turn * o_x) * point.u_z
    return along * point.u_x - held.t_x


def may_graze(
    scene: Scene, held: Held, there: Held, ahead: bool, kappa: float, kappa1: float, ds: float
) -> bool:
    """Whether the centroid may pass a contact and come back within one step.

    kappa, kappa1: tilt of effective gravity there: where the course bends back, the tilt at its end
        hides what was passed. The tangents at both ends meet below the true course if that is
        convex.
    """
    sign = 1.0 if ahead else -1.0
    one = held.front if ahead else held.rear
    other = there.front if ahead else there.rear
    at1 = placed(there.x, there.z, there.phi)
    v1 = sign * lever(scene, other, at1, kappa)
    if v1 > 3.0 * ds:
        return False
    if v1 <= 0.0 and sign * lever(scene, other, at1, kappa1) > 0.0:
        return True
    at0 = placed(held.x, held.z, held.phi)
    rate1 = sign * lever_rate(scene, other, there, at1)
    rate0 = sign * lever_rate(scene, one, held, at0)
    if rate0 >= 0.0 or rate1 <= 0.0:
        return False
    v0 = sign * lever(scene, one, at0, kappa)
    meet = (v1 - v0 - rate1 * ds) / (rate0 - rate1)
    return v0 + rate0 * meet <= 0.0


def thinnest_radius(body: Table[Part]) -> float:
    """Smallest end radius of all parts [m]."""
    thinnest = math.inf
    for k in range(len(body)):
        thinnest = min(thinnest, body[k].one.r, body[k].two.r)
    return thinnest


def careful(scene: Scene, held: Held, ds: float, thinnest: float) -> float:
    """Choose a step that jumps neither round an arc nor through a spike.

    The line of poses bends with the arcs that carry: a step is at most a share of their radius.
    Other thin parts move no farther than they are clear.
    """
    one = part_of(scene, held.rear)
    two = part_of(scene, held.front)
    carrying = min(one.one.r, one.two.r, two.one.r, two.two.r)
    ds = min(ds, OF_RADIUS * carrying)
    if thinnest >= ds:
        return ds
    at = placed(held.x, held.z, held.phi)
    _, clear = nearest(scene, at, held.rear, held.front, 2.0 * ds)
    return min(ds, max(0.4 * clear, thinnest, 0.1 * ds))


def runs_past(scene: Scene, feature: int, at: At) -> bool:
    """Whether a disc's foot has run past the end of its segment, where the ground turns up.

    A vertex lies at the begin of its own.
    """
    if feature & KIND_MASK == VERTEX:
        return False
    p_x, p_z = contact_point(scene, feature, at)
    return beyond_segment(scene.ground, feature >> POINT_BITS, p_x, p_z) > PAST


def clear_step(
    scene: Scene, held: Held, ds: float, pull: Pull
) -> tuple[bool, Held, int, float, float, float, float]:
    """Shorten a step until the corrector finds its end and nothing may have happened on the way.

    behind, ahead: how far the contacts lie from effective gravity's line there [m].
    """
    kappa0 = tilt(pull, held.t_x, held.t_z)
    for _ in range(60):
        good, there, at = stepped(scene, held, ds)
        if good and ds > CORNER:
            good = not (runs_past(scene, there.rear, at) or runs_past(scene, there.front, at))
        if good:
            third, distance = nearest(scene, at, there.rear, there.front, 0.0)
            if third < 0 or ds < 1e-8 or shallow(scene, third, distance):
                kappa = tilt(pull, there.t_x, there.t_z)
                behind = -lever(scene, there.rear, at, kappa)
                ahead = lever(scene, there.front, at, kappa)
                behind0 = behind
                ahead0 = ahead
                if kappa0 != kappa:
                    behind0 = -lever(scene, there.rear, at, kappa0)
                    ahead0 = lever(scene, there.front, at, kappa0)
                reach = 3.0 * ds
                if ds < 2e-5 or not (
                    (
                        min(ahead, ahead0) <= reach
                        and may_graze(scene, held, there, True, kappa0, kappa, ds)
                    )
                    or (
                        min(behind, behind0) <= reach
                        and may_graze(scene, held, there, False, kappa0, kappa, ds)
                    )
                ):
                    return True, there, third, distance, behind, ahead, ds
        ds *= 0.4
        if ds < 1e-9:
            break
    return False, held, NO_FEATURE, 0.0, 0.0, 0.0, ds


def happened(third: int, distance: float, deep: float, behind: float, ahead: float) -> int:
    """Return what has happened at a pose: a feature that lies ``deep`` inside, or an `Advance`."""
    if third >= 0 and distance < -deep:
        return third
    if behind <= 0.0:
        return Advance.OVER_REAR
    if ahead <= 0.0:
        return Advance.OVER_FRONT
    return Advance.NOTHING


def named(scene: Scene, what: int, held: Held) -> int:
    """Return what has happened; a feature by the name that holds at a pose."""
    return what if what < 0 else relabelled(scene, what, placed(held.x, held.z, held.phi))


def cut_at_event(scene: Scene, held: Held, ds: float, pull: Pull) -> tuple[int, Held, float]:
    """A step, cut short at the first event: as `advance`, which says what is returned."""
    good, there, third, distance, behind, ahead, ds = clear_step(scene, held, ds, pull)
    if not good:
        return Advance.NOT_CONVERGED, held, ds
    at0 = placed(held.x, held.z, held.phi)
    at = placed(there.x, there.z, there.phi)
    what: int = Advance.NOTHING
    deep = PENETRATED
    for _ in range(24):
        new = happened(third, distance, deep, behind, ahead)
        if new == Advance.NOTHING or new == what:
            return named(scene, what, there), there, ds
        what = new
        deep = TOGETHER
        value0 = quantity(scene, what, held, at0, tilt(pull, held.t_x, held.t_z))
        value1 = quantity(scene, what, there, at, tilt(pull, there.t_x, there.t_z))
        if value0 <= 0.0:
            return named(scene, what, held), held, 0.0
        found, ds = closing_time(scene, what, held, ds, value0, value1, pull)
        if found == 2:
            what = Advance.NOTHING
            deep = PENETRATED
        if found == 0 or ds <= 0.0:
            break
        good, there, at = stepped(scene, held, ds)
        if not good:
            break
        kappa = tilt(pull, there.t_x, there.t_z)
        behind = -lever(scene, there.rear, at, kappa)
        ahead = lever(scene, there.front, at, kappa)
        third, distance = nearest(scene, at, there.rear, there.front, 0.0)
    return Advance.NOT_CONVERGED, held, ds


def advance(
    scene: Scene, held: Held, ds: float, thinnest: float, pull: Pull
) -> tuple[int, Held, float]:
    """One step along the line of poses, cut short at the first event.

    outcome: an `Advance`, or the feature that has closed.
    pose: reached, with its tangent and contacts.
    ds: the step actually taken [m].
    """
    if OF_RADIUS * thinnest < ds:
        ds = careful(scene, held, ds, thinnest)
    for _ in range(TRIES):
        what, there, taken = cut_at_event(scene, held, ds, pull)
        if what != Advance.NOT_CONVERGED:
            return what, there, taken
        ds *= SHORTER
    return Advance.NOT_CONVERGED, held, ds
