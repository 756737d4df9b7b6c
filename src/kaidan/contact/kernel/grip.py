r"""With how much to spare friction and grousers hold a pose on its supports.

::

      support      with a grouser on it     else          two supports carry, one on either side of
      nosing       stands on the tread      Coulomb       the line of the load; which two of several
      riser face   over the edge, if low    Coulomb       depends on where grousers stand
      tread, floor                          Coulomb
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.cones import cone_margin
from kaidan.contact.kernel.grousers import (
    edge_tilt,
    end_run,
    face_friction,
    face_push,
    height_behind,
    phases_friction,
    pushed_lean,
    reach_over_edge,
    roll_off_length,
    roll_off_sine,
    standing_friction,
    standing_run,
    tip_overlap,
    tip_tilt,
)
from kaidan.contact.kernel.peaks import larger
from kaidan.contact.kernel.trigonometry import asin, atan2, cos, sin, tan
from kaidan.contact.layout import (
    FACE,
    NOSING,
    NOWHERE,
    TREAD,
    Cone,
    Friction,
    Grousers,
    Load,
    Support,
    Tip,
)
from kaidan.contact.memory import Row, Table

#: Share of the phases that counts where four nosings or more are under the belts [1]: fitted with
#: `kaidan.mechanics.grousers.phases_friction` (docs/theory/grousers.md).
MANY = 0.75
#: Times the friction required of a tip that stands while one end is at a face and the other one
#: behind a nosing: fitted (docs/theory/grousers.md).
RESERVE = 1.3
#: Tilt up to which an end on a tread is off the round of its nosing [rad].
LEVEL = 1e-3
#: Radius of a nosing that is sharp [m].
SHARP = 1e-6
#: Distance of two supports below which they count as that far apart [m].
APART = 1e-3
#: Largest slope for which grousers on several nosings are looked at [rad].
STEEPEST = 1.5


def smaller(one: float, other: float) -> float:
    """The smaller of two numbers; NaN if either is."""
    return -larger(-one, -other)


def carry(one: Support, other: Support, outer: bool, load: Load) -> bool:
    """Whether two supports of a pose may carry it: on either side of its load, or the outer two."""
    if not one.is_one or not other.is_one:
        return False
    slope = load.x / load.z
    ahead = one.x - slope * one.z
    behind = other.x - slope * other.z
    return outer or ahead * behind <= 0.0


def friction_at(support: Support, friction: Friction, height: float) -> float:
    """Angle of friction under the belt; rigid grousers push an end off a face [rad]."""
    if support.place == NOSING:
        return friction.nosings
    if support.place == TREAD:
        return friction.treads
    if height <= 0.0:
        return friction.faces
    return atan2(face_friction(tan(friction.faces), height, support.curvature), 1.0)


def pushed_normal(support: Support, other: Support, h: float, r: float, side: float) -> float:
    """Tilt of the normal of an end's support once rigid grousers at another one push it back [rad].

    It goes no farther back than onto the flat. Going down, or of no height, nothing pushes.
    """
    normal = support.normal
    tread = support.tread
    if side < 0.0 or h <= 0.0 or support.place == FACE or math.isnan(tread):
        return normal
    lean = max(tread - normal, 0.0)
    pushed = pushed_lean(lean, tread - other.normal, support.beyond, h, r, support.curvature)
    if not math.isnan(support.flat):
        pushed = min(pushed, tread - support.flat)
    return tread - pushed if pushed > lean else normal


def is_in_doubt(supports: Table[Support]) -> bool:
    """Whether an end is at a face while another one stands on a nosing, or on the tread behind."""
    at_face = False
    behind = False
    for slot in range(len(supports)):
        support = supports[slot]
        if support.is_one and support.curvature > 0.0:
            if support.place == FACE:
                at_face = True
            elif support.point != NOWHERE:
                behind = True
    return at_face and behind


def with_reserve(margin: float, friction: float) -> float:
    """Margin of an angle of friction, once what is required is `RESERVE` times as much [rad]."""
    if margin == -math.inf or margin >= friction:
        return margin
    return friction - atan2(RESERVE * tan(friction - margin), 1.0)


def margin_of(
    one: Support, alpha: float, phi: float, ahead: float, other: Support, other_alpha: float,
    other_phi: float, load: Load,
) -> float:  # fmt: skip
    """Margin of two supports with their cones, the first so far ahead of its place [m]."""
    x = one.x + ahead * cos(one.normal)
    z = one.z - ahead * sin(one.normal)
    return cone_margin(
        Cone(x, z, alpha, phi), Cone(other.x, other.z, other_alpha, other_phi), load.x, load.z
    )


@entry
def belt_margins(
    supports: Table[Support], slots: int, loads: Table[Load], like: Row[int], friction: Friction,
    height: float, found: Row[float],
) -> None:  # fmt: skip
    """Angle by which the cones of the belts may shrink without a grouser that stands, of each pose.

    supports, slots, loads, like: as :func:`kaidan.contact.kernel.supports.find_alike` takes and
        fills them.
    height: of rigid grousers, which on an end's arc hold less at a face than a smooth belt [m].
    found: to be filled [rad].
    """
    nosings = friction.nosings
    one_friction = nosings == friction.treads and friction.treads == friction.faces
    for row in range(len(loads)):
        if like[row] != row:
            found[row] = found[like[row]]
            continue
        own = supports[row * slots : (row + 1) * slots]
        at_face = False
        for slot in range(slots):
            if own[slot].is_one and own[slot].place == FACE:
                at_face = True
        found[row] = math.inf
        if one_friction:
            found[row] = nosings - loads[row].coulomb
            if not at_face:
                continue
        most = -math.inf
        for j in range(slots):
            for i in range(j):
                one = own[i]
                other = own[j]
                if not carry(one, other, i == 0 and j == 1, loads[row]):
                    continue
                margin = margin_of(
                    one, one.normal, friction_at(one, friction, height), 0.0, other, other.normal,
                    friction_at(other, friction, height), loads[row],
                )  # fmt: skip
                most = larger(most, margin)
        found[row] = smaller(found[row], most)


def tip_at(support: Support, normal: float, grousers: Grousers, side: float) -> Tip:
    """Tip of a grouser as it comes to stand at a support whose normal is so tilted [rad]."""
    h, s, w, r, rigid = grousers
    none = Tip(False, 0.0, 0.0, 0.0, 0.0)
    leans = side * (support.tread - normal)
    if not (support.is_one and support.point != NOWHERE and h > 0.0) or math.isnan(leans):
        return none
    if support.place == TREAD and leans <= LEVEL:
        return none
    curvature = support.curvature
    if not math.isnan(support.lift):
        if leans <= 0.0:
            return none
        radius = 1.0 / curvature
        # the robot stands on its grousers, so the axle is higher by one
        lift = support.lift - h
        if lift > reach_over_edge(radius, h, s):
            return none
        over = edge_tilt(tip_overlap(radius, h, s, lift), r)
        return Tip(True, support.tread - side * over, 0.0, 0.0, 0.0)
    theta = min(max(leans, 1e-6), 0.5 * math.pi - 1e-6)
    behind = height_behind(theta, h, s, r, w, curvature) if rigid else h
    beta = tip_tilt(theta, behind, r, curvature)
    run = standing_run(theta, behind, r)
    if rigid and curvature > 0.0:
        run = end_run(theta, behind, r, curvature)
    off = roll_off_length(theta, behind, r)
    if not (leans > 0.0 and leans < 0.5 * math.pi and beta < theta):
        return Tip(False, 0.0, 0.0, off, 0.0)
    return Tip(True, support.tread - side * beta, run, off, run + r * sin(theta - beta))


def lag(one: Support, other: Support, own: float, its: float) -> float:
    """Share of its speed by which the belt at a support passes more slowly than at another [1].

    Along its path a robot rotates about the point where the normals of both meet, see
    `kaidan.mechanics.grousers_in_turn.belt_lag`.
    """
    d_x = one.x - other.x
    d_z = one.z - other.z
    far = d_x * cos(own) - d_z * sin(own)
    if far == 0.0:
        return math.inf
    return 1.0 - (d_x * cos(its) - d_z * sin(its)) / far


def tilt_run_back(back: float, own: float, tip: Tip, r: float, side: float) -> float:
    """Tilt of the normal under a tip that ran back while the belt ran on by a spacing [rad].

    back: how far it runs back [m], over the tread first, then over the round of the nosing. A robot
        that goes down does not have to get on against its weight.
    """
    beyond = back - tip.run
    if side < 0.0 or beyond <= 0.0:
        return tip.tilt
    left = sin(side * (tip.tilt - own)) - beyond / max(r, SHARP)
    return own + side * asin(left) if left > 0.0 else math.nan


def margin_standing(
    one: Support, other: Support, own: float, axis: float, load: Load, tip: Tip, rolls: Tip,
    friction: Friction, grousers: Grousers, side: float,
) -> float:  # fmt: skip
    """Margin of two supports, a grouser standing at the first [rad]; minus infinity: none can.

    A rigid one stands farther uphill than its nosing, so it bears less of the load if it is the
    upper support. The other support may be a grouser's top, or roll off a nosing with its edge, no
    farther than onto the face: then the worse of two times counts, see
    `kaidan.mechanics.grousers.roll_off_sine`, of the best part in which the other is taken to roll.
    As far as the other one lags it rolls off while the own one stands. Where belts pass the one
    nosing two ways, and nothing else can hold, the tips of each keep off those of the other. Of an
    end a tip runs back faster than the belt, and others at a face push it back.
    """
    h, s, _, r, rigid = grousers
    treads = friction.treads
    if not tip.stands:
        return -math.inf
    more = 0.0
    if rigid and side > 0.0:
        if one.beside < h and other.point == NOWHERE:
            return -math.inf
        more = s * h * one.curvature
        if other.place == FACE:
            more += face_push(h, s, other.curvature)
    tilt = tilt_run_back(s * lag(one, other, own, axis) + more, own, tip, r, side)
    if math.isnan(tilt):
        return -math.inf
    phi = friction_at(other, friction, 0.0)
    if not rigid:
        return margin_of(one, tilt, treads, 0.0, other, axis, phi, load)
    d_x = one.x - other.x
    d_z = one.z - other.z
    ahead = side * tip.ahead if side * d_x > 0.0 else 0.0
    gamma = 0.0
    rolled = 0.0
    if other.place == NOSING and other.point != NOWHERE:
        if side > 0.0:
            rolled = min(max(s * lag(other, one, axis, own), 0.0), rolls.off)
        axis -= side * (h / max(math.sqrt(d_x * d_x + d_z * d_z), APART))
        gamma = roll_off_sine(tip.run, rolls.off - rolled, max(r, SHARP))
    if gamma <= 0.0 and rolled <= 0.0:
        return margin_of(one, tilt, treads, ahead, other, axis, phi, load)
    lean = side * (tilt - own)
    upright = 0.5 * math.pi - side * (other.tread - axis)
    most = -math.inf
    for half in range(3):
        # the other has rolled off by so much at most, or the own one has climbed by the rest
        sine = min(half * gamma + rolled / max(r, SHARP), 1.0)
        turned = min(asin(sine), max(upright, 0.0))
        left = asin(max(sin(lean) - (2 - half) * gamma, 0.0))
        first = margin_of(one, tilt, treads, ahead, other, axis - side * turned, phi, load)
        if first <= most:  # the worse of the two is no better
            continue
        then = margin_of(one, tilt - side * (lean - left), treads, ahead, other, axis, phi, load)
        most = larger(most, smaller(first, then))
    return most


def margin_of_several(
    support: Support, several: int, required: float, tip: Tip, nosings: float, grousers: Grousers,
    side: float,
) -> float:  # fmt: skip
    """Margin of a pose on three supports or more, a grouser standing at one of them [rad].

    Rigid grousers hold in the mean over their phases. Others share the load, and one with no less
    than its part will stand.
    """
    if not tip.stands:
        return -math.inf
    theta = min(required, STEEPEST)
    if grousers.rigid:
        q = max(tip.run, 0.0) / grousers.spacing
        needed = phases_friction(theta, MANY * q if several > 3 else q)
    else:
        lean = min(max(side * (tip.tilt - support.normal), 0.0), theta)
        needed = standing_friction(theta, theta - lean, 1.0 / several)
    return nosings - atan2(needed, 1.0)


@entry
def standing_margins(
    supports: Table[Support], slots: int, loads: Table[Load], like: Row[int], friction: Friction,
    grousers: Grousers, side: float, found: Row[float],
) -> None:  # fmt: skip
    """Margin of each pose with a grouser that stands at each of its supports.

    Which two of several supports carry depends on where grousers stand. So the least over the pairs
    counts: with that support among them, or else with the better of the two.

    supports, slots, loads, like: as :func:`kaidan.contact.kernel.supports.find_alike` takes and
        fills them.
    side: +1 where the robot climbs, -1 where it goes down.
    found: to be filled, as many a pose as it has slots [rad]; minus infinity: none can stand there.
    """
    r = grousers.nosing_radius
    pushing = grousers.height if grousers.rigid else 0.0
    for row in range(len(loads)):
        load = loads[row]
        own = supports[row * slots : (row + 1) * slots]
        margins = found[row * slots : (row + 1) * slots]
        if like[row] != row:
            for slot in range(slots):
                margins[slot] = found[like[row] * slots + slot]
            continue
        several = 0
        for slot in range(slots):
            margins[slot] = math.inf
            if own[slot].is_one:
                several += 1
        for j in range(1, several):
            for i in range(j):
                one = own[i]
                other = own[j]
                if not carry(one, other, i == 0 and j == 1, load):
                    continue
                at_i = pushed_normal(one, other, pushing, r, side)
                at_j = pushed_normal(other, one, pushing, r, side)
                of_i = tip_at(one, at_i, grousers, side)
                of_j = tip_at(other, at_j, grousers, side)
                with_i = margin_standing(
                    one, other, at_i, at_j, load, of_i, of_j, friction, grousers, side
                )
                with_j = margin_standing(
                    other, one, at_j, at_i, load, of_j, of_i, friction, grousers, side
                )
                for slot in range(slots):
                    better = larger(with_i, with_j)
                    if slot == i:
                        better = with_i
                    if slot == j:
                        better = with_j
                    margins[slot] = smaller(margins[slot], better)
        for slot in range(slots):
            if margins[slot] == math.inf:
                margins[slot] = -math.inf
            if several > 2:
                tip = tip_at(own[slot], own[slot].normal, grousers, side)
                of_all = margin_of_several(
                    own[slot], several, load.coulomb, tip, friction.nosings, grousers, side
                )
                margins[slot] = smaller(margins[slot], of_all)
        if side > 0.0 and pushing > 0.0 and is_in_doubt(own):
            for slot in range(slots):
                margins[slot] = with_reserve(margins[slot], friction.nosings)
