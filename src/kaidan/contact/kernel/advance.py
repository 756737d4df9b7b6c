"""One step along the line of poses: taken whole if nothing happens, else cut at the first event."""

from __future__ import annotations

import math

from kaidan.contact.codes import Advance
from kaidan.contact.columns import (
    DISC,
    DISC_1,
    DISC_X,
    DISC_Z,
    KIND_MASK,
    NO_FEATURE,
    PART_BITS,
    PART_MASK,
    POINT_BITS,
    R1,
    R2,
    U_X,
    U_Z,
    VERTEX,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.continuation import ARM, stepped, tilt
from kaidan.contact.kernel.event_location import PENETRATED, closing_time, quantity
from kaidan.contact.kernel.gaps import beyond_segment, contact_point, relabelled
from kaidan.contact.kernel.nearest_feature import nearest
from kaidan.contact.kernel.settling import lever
from kaidan.contact.tables import BodyTable, GroundTable, Held

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


def shallow(body: BodyTable, feature: int, distance: float) -> bool:
    """Whether a penetration is shallow enough to tell which feature is hit.

    A disc that has gone in by less than half its radius still has its centre outside; a thin part
    that has gone in farther may be nearer to a face it never met.
    """
    part = (feature >> PART_BITS) & PART_MASK
    return bool(distance > -0.5 * min(body[part, R1], body[part, R2]))


def lever_rate(
    ground: GroundTable,
    body: BodyTable,
    feature: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
) -> float:
    """Change of a contact's Delta with arclength (tilt of gravity held)."""
    kind = feature & KIND_MASK
    if kind == VERTEX:
        return -t_x
    part = (feature >> PART_BITS) & PART_MASK
    k = feature >> POINT_BITS
    j = DISC * (kind - DISC_1)
    o_x = math.cos(phi) * body[part, j + DISC_X] - math.sin(phi) * body[part, j + DISC_Z]
    o_z = math.sin(phi) * body[part, j + DISC_X] + math.cos(phi) * body[part, j + DISC_Z]
    turn = t_w / ARM
    along = (t_x - turn * o_z) * ground[k, U_X] + (t_z + turn * o_x) * ground[k, U_Z]
    return float(along * ground[k, U_X] - t_x)


def may_graze(
    ground: GroundTable, body: BodyTable, one: int, other: int, sign: float,
    kappa: float, kappa1: float,
    x0: float, z0: float, phi0: float, t_x: float, t_z: float, t_w: float,
    x1: float, z1: float, phi1: float, u_x: float, u_z: float, u_w: float, ds: float,
) -> bool:  # fmt: skip
    """Whether the centroid may pass a contact and come back within one step.

    ``sign`` +1 for the front contact, -1 for the rear one, ``one`` and ``other`` its names at both
    ends, ``kappa`` and ``kappa1`` the tilt of effective gravity there: where the course bends back,
    the tilt at its end hides what was passed. The tangents at both ends meet below the true course
    if that is convex.
    """
    v1 = sign * lever(ground, body, other, x1, z1, math.cos(phi1), math.sin(phi1), kappa)
    if v1 > 3.0 * ds:
        return False
    if (
        v1
        <= 0.0
        < sign * lever(ground, body, other, x1, z1, math.cos(phi1), math.sin(phi1), kappa1)
    ):
        return True
    rate1 = sign * lever_rate(ground, body, other, x1, z1, phi1, u_x, u_z, u_w)
    rate0 = sign * lever_rate(ground, body, one, x0, z0, phi0, t_x, t_z, t_w)
    if rate0 >= 0.0 or rate1 <= 0.0:
        return False
    v0 = sign * lever(ground, body, one, x0, z0, math.cos(phi0), math.sin(phi0), kappa)
    meet = (v1 - v0 - rate1 * ds) / (rate0 - rate1)
    return v0 + rate0 * meet <= 0.0


@entry
def thinnest_radius(body: BodyTable) -> float:
    """Smallest end radius of all parts [m]."""
    thinnest = math.inf
    for part in range(body.shape[0]):
        thinnest = min(thinnest, body[part, R1], body[part, R2])
    return thinnest


def careful(
    ground: GroundTable,
    body: BodyTable,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    ds: float,
    thinnest: float,
    hint: int,
) -> float:
    """Choose a step that jumps neither round an arc nor through a spike.

    The line of poses bends with the arcs that carry: a step is at most a share of their radius.
    Other thin parts move no farther than they are clear.
    """
    one = (rear >> PART_BITS) & PART_MASK
    two = (front >> PART_BITS) & PART_MASK
    carrying = min(body[one, R1], body[one, R2], body[two, R1], body[two, R2])
    ds = min(ds, OF_RADIUS * carrying)
    if thinnest >= ds:
        return ds
    _, clear, _ = nearest(
        ground, body, x, z, math.cos(phi), math.sin(phi), rear, front, 2.0 * ds, hint
    )
    return min(ds, max(0.4 * clear, thinnest, 0.1 * ds))


def runs_past(
    ground: GroundTable, body: BodyTable, feature: int, x: float, z: float, c: float, s: float
) -> bool:
    """Whether a disc's foot has run past the end of its segment, where the ground turns up.

    A vertex lies at the begin of its own.
    """
    if feature & KIND_MASK == VERTEX:
        return False
    p_x, p_z = contact_point(ground, body, feature, x, z, c, s)
    return beyond_segment(ground, feature >> POINT_BITS, p_x, p_z) > PAST


def clear_step(
    ground: GroundTable, body: BodyTable, at: Held, ds: float, a: float, g: float, kappa_g: float,
    hint: int,
) -> tuple[bool, Held, int, float, float, float, int, float]:  # fmt: skip
    """Shorten a step until the corrector finds its end and nothing may have happened on the way.

    Returns
    -------
    found
    pose
        At the end of the step.
    feature, gap
        The nearest there.
    behind, ahead
        How far the contacts lie from effective gravity's line there [m].
    hint, ds
    """
    x, z, phi, t_x, t_z, t_w, rear, front = at
    kappa0 = tilt(a, g, kappa_g, t_x, t_z)
    for _ in range(60):
        good, x1, z1, phi1, c, s, u_x, u_z, u_w, r1, f1 = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, ds
        )
        past = False
        if good and ds > CORNER:
            past = runs_past(ground, body, r1, x1, z1, c, s)
            past = past or runs_past(ground, body, f1, x1, z1, c, s)
        if good and not past:
            third, distance, hint = nearest(ground, body, x1, z1, c, s, r1, f1, 0.0, hint)
            if third < 0 or ds < 1e-8 or shallow(body, third, distance):
                kappa = tilt(a, g, kappa_g, u_x, u_z)
                behind = -lever(ground, body, r1, x1, z1, c, s, kappa)
                ahead = lever(ground, body, f1, x1, z1, c, s, kappa)
                behind0 = behind
                ahead0 = ahead
                if kappa0 != kappa:
                    behind0 = -lever(ground, body, r1, x1, z1, c, s, kappa0)
                    ahead0 = lever(ground, body, f1, x1, z1, c, s, kappa0)
                if ds < 2e-5 or not (
                    (
                        min(ahead, ahead0) <= 3.0 * ds
                        and may_graze(
                            ground, body, front, f1, 1.0, kappa0, kappa,
                            x, z, phi, t_x, t_z, t_w, x1, z1, phi1, u_x, u_z, u_w, ds,
                        )
                    )
                    or (
                        min(behind, behind0) <= 3.0 * ds
                        and may_graze(
                            ground, body, rear, r1, -1.0, kappa0, kappa,
                            x, z, phi, t_x, t_z, t_w, x1, z1, phi1, u_x, u_z, u_w, ds,
                        )
                    )
                ):  # fmt: skip
                    there = (x1, z1, phi1, u_x, u_z, u_w, r1, f1)
                    return True, there, third, distance, behind, ahead, hint, ds
        ds *= 0.4
        if ds < 1e-9:
            break
    return False, at, NO_FEATURE, 0.0, 0.0, 0.0, hint, ds


def happened(third: int, distance: float, deep: float, behind: float, ahead: float) -> int:
    """Return what has happened at a pose: a feature that lies ``deep`` inside, or an `Advance`."""
    if third >= 0 and distance < -deep:
        return third
    if behind <= 0.0:
        return Advance.OVER_REAR
    if ahead <= 0.0:
        return Advance.OVER_FRONT
    return Advance.NOTHING


def named(ground: GroundTable, body: BodyTable, what: int, at: Held) -> int:
    """Return what has happened; a feature by the name that holds at a pose."""
    if what < 0:
        return what
    return relabelled(ground, body, what, at[0], at[1], math.cos(at[2]), math.sin(at[2]))


def cut_at_event(
    ground: GroundTable, body: BodyTable, at: Held, ds: float, a: float, g: float, kappa_g: float,
    hint: int,
) -> tuple[int, Held, int, float]:  # fmt: skip
    """A step, cut short at the first event: as `advance`, which says what is returned."""
    x, z, phi, t_x, t_z, t_w, rear, front = at
    good, there, third, distance, behind, ahead, hint, ds = clear_step(
        ground, body, at, ds, a, g, kappa_g, hint
    )  # fmt: skip
    if not good:
        return Advance.NOT_CONVERGED, at, hint, ds
    what: int = Advance.NOTHING
    deep = PENETRATED
    for _ in range(24):
        x1, z1, phi1, u_x, u_z, u_w, r1, f1 = there
        new = happened(third, distance, deep, behind, ahead)
        if new == Advance.NOTHING or new == what:
            return named(ground, body, what, there), there, hint, ds
        what = new
        deep = TOGETHER
        value0 = quantity(ground, body, what, rear, front, x, z, phi, tilt(a, g, kappa_g, t_x, t_z))
        value1 = quantity(ground, body, what, r1, f1, x1, z1, phi1, tilt(a, g, kappa_g, u_x, u_z))
        if value0 <= 0.0:
            return named(ground, body, what, at), at, hint, 0.0
        found, ds = closing_time(
            ground, body, what, rear, front, x, z, phi, t_x, t_z, t_w, ds, value0, value1,
            a, g, kappa_g,
        )  # fmt: skip
        if found == 2:
            what = Advance.NOTHING
            deep = PENETRATED
        if found == 0 or ds <= 0.0:
            break
        good, x1, z1, phi1, c, s, u_x, u_z, u_w, r1, f1 = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, ds
        )
        if not good:
            break
        there = (x1, z1, phi1, u_x, u_z, u_w, r1, f1)
        kappa = tilt(a, g, kappa_g, u_x, u_z)
        behind = -lever(ground, body, r1, x1, z1, c, s, kappa)
        ahead = lever(ground, body, f1, x1, z1, c, s, kappa)
        third, distance, hint = nearest(ground, body, x1, z1, c, s, r1, f1, 0.0, hint)
    return Advance.NOT_CONVERGED, at, hint, ds


def advance(
    ground: GroundTable,
    body: BodyTable,
    at: Held,
    ds: float,
    thinnest: float,
    a: float,
    g: float,
    kappa_g: float,
    hint: int,
) -> tuple[int, Held, int, float]:
    """One step along the line of poses, cut short at the first event.

    Returns
    -------
    outcome
        An `Advance`, or the feature that has closed.
    pose
        Reached, with its tangent and contacts.
    hint, ds
        For the scan; the step actually taken [m].
    """
    x, z, phi, _, _, _, rear, front = at
    if OF_RADIUS * thinnest < ds:
        ds = careful(ground, body, rear, front, x, z, phi, ds, thinnest, hint)
    for _ in range(TRIES):
        what, there, hint, taken = cut_at_event(ground, body, at, ds, a, g, kappa_g, hint)
        if what != Advance.NOT_CONVERGED:
            return what, there, hint, taken
        ds *= SHORTER
    return Advance.NOT_CONVERGED, at, hint, ds
