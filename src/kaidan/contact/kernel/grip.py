r"""With how much to spare friction and grousers hold a pose on its supports.

::

      support      with a grouser on it     else          two supports carry, one on either side of
      nosing       stands on the tread      Coulomb       the line of the load; which two of several
      riser face   over the edge, if low    Coulomb       depends on where grousers stand
      tread, floor                          Coulomb
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    FACE,
    LOAD_COULOMB,
    LOAD_X,
    LOAD_Z,
    NOSING,
    NOWHERE,
    SUPPORT_BESIDE,
    SUPPORT_BEYOND,
    SUPPORT_CURVATURE,
    SUPPORT_FLAT,
    SUPPORT_IS_ONE,
    SUPPORT_LIFT,
    SUPPORT_NORMAL,
    SUPPORT_PLACE,
    SUPPORT_POINT,
    SUPPORT_TREAD,
    SUPPORT_X,
    SUPPORT_Z,
    TREAD,
)
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
from kaidan.contact.tables import FloatRow, IntArray, LoadTable, SupportTable, Tip

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


def carry(supports: SupportTable, first: int, i: int, j: int, loads: LoadTable, row: int) -> bool:
    """Whether two supports of a pose may carry it: on either side of its load, or the outer two."""
    one = first + i
    other = first + j
    if supports[one, SUPPORT_IS_ONE] == 0.0 or supports[other, SUPPORT_IS_ONE] == 0.0:
        return False
    if i == 0 and j == 1:
        return True
    slope = loads[row, LOAD_X] / loads[row, LOAD_Z]
    ahead = supports[one, SUPPORT_X] - slope * supports[one, SUPPORT_Z]
    behind = supports[other, SUPPORT_X] - slope * supports[other, SUPPORT_Z]
    return bool(ahead * behind <= 0.0)


def friction_at(
    supports: SupportTable, at: int, nosings: float, treads: float, faces: float, height: float
) -> float:
    """Angle of friction under the belt; rigid grousers push an end off a face [rad]."""
    if supports[at, SUPPORT_PLACE] == NOSING:
        return nosings
    if supports[at, SUPPORT_PLACE] == TREAD:
        return treads
    if height <= 0.0:
        return faces
    left = face_friction(math.tan(faces), height, supports[at, SUPPORT_CURVATURE])
    return math.atan2(left, 1.0)


def pushed_normal(
    supports: SupportTable, at: int, other: int, h: float, r: float, side: float
) -> float:
    """Tilt of the normal of an end's support once rigid grousers at another one push it back [rad].

    It goes no farther back than onto the flat. Going down, or of no height, nothing pushes.
    """
    normal = float(supports[at, SUPPORT_NORMAL])
    tread = float(supports[at, SUPPORT_TREAD])
    place = supports[at, SUPPORT_PLACE]
    if side < 0.0 or h <= 0.0 or place == FACE or math.isnan(tread):
        return normal
    lean = max(tread - normal, 0.0)
    pushed = pushed_lean(
        lean, tread - supports[other, SUPPORT_NORMAL], supports[at, SUPPORT_BEYOND], h, r,
        supports[at, SUPPORT_CURVATURE],
    )  # fmt: skip
    if not math.isnan(supports[at, SUPPORT_FLAT]):
        pushed = min(pushed, tread - supports[at, SUPPORT_FLAT])
    return tread - pushed if pushed > lean else normal


def is_in_doubt(supports: SupportTable, first: int, slots: int) -> bool:
    """Whether an end is at a face while another one stands on a nosing, or on the tread behind."""
    at_face = False
    behind = False
    for at in range(first, first + slots):
        if supports[at, SUPPORT_IS_ONE] == 1.0 and supports[at, SUPPORT_CURVATURE] > 0.0:
            if supports[at, SUPPORT_PLACE] == FACE:
                at_face = True
            elif supports[at, SUPPORT_POINT] != NOWHERE:
                behind = True
    return at_face and behind


def with_reserve(margin: float, friction: float) -> float:
    """Margin of an angle of friction, once what is required is `RESERVE` times as much [rad]."""
    if margin == -math.inf or margin >= friction:
        return margin
    return friction - math.atan2(RESERVE * math.tan(friction - margin), 1.0)


def margin_of(
    supports: SupportTable, one: int, alpha: float, phi: float, ahead: float, other: int,
    other_alpha: float, other_phi: float, loads: LoadTable, row: int,
) -> float:  # fmt: skip
    """Margin of two supports with their cones, the first so far ahead of its place [m]."""
    normal = supports[one, SUPPORT_NORMAL]
    return cone_margin(
        supports[one, SUPPORT_X] + ahead * math.cos(normal),
        supports[one, SUPPORT_Z] - ahead * math.sin(normal), alpha, phi,
        supports[other, SUPPORT_X], supports[other, SUPPORT_Z], other_alpha, other_phi,
        loads[row, LOAD_X], loads[row, LOAD_Z],
    )  # fmt: skip


@entry
def belt_margins(
    supports: SupportTable, slots: int, loads: LoadTable, like: IntArray, nosings: float,
    treads: float, faces: float, height: float, found: FloatRow,
) -> None:  # fmt: skip
    """Angle by which the cones of the belts may shrink without a grouser that stands, of each pose.

    Parameters
    ----------
    supports, slots, loads, like
        As :func:`kaidan.contact.kernel.supports.find_alike` takes and fills them.
    nosings, treads, faces
        Angles of friction [rad].
    height
        Of rigid grousers, which on an end's arc hold less at a face than a smooth belt [m].
    found
        To be filled [rad].
    """
    one_friction = nosings == treads and treads == faces
    for row in range(loads.shape[0]):
        if like[row] != row:
            found[row] = found[like[row]]
            continue
        first = row * slots
        at_face = False
        for at in range(first, first + slots):
            if supports[at, SUPPORT_IS_ONE] == 1.0 and supports[at, SUPPORT_PLACE] == FACE:
                at_face = True
        found[row] = math.inf
        if one_friction:
            found[row] = nosings - loads[row, LOAD_COULOMB]
            if not at_face:
                continue
        most = -math.inf
        for j in range(slots):
            for i in range(j):
                if not carry(supports, first, i, j, loads, row):
                    continue
                one = first + i
                other = first + j
                margin = margin_of(
                    supports, one, supports[one, SUPPORT_NORMAL],
                    friction_at(supports, one, nosings, treads, faces, height), 0.0,
                    other, supports[other, SUPPORT_NORMAL],
                    friction_at(supports, other, nosings, treads, faces, height), loads, row,
                )  # fmt: skip
                most = larger(most, margin)
        found[row] = smaller(found[row], most)


def tip_at(
    supports: SupportTable, at: int, normal: float, h: float, s: float, w: float, r: float,
    rigid: bool, side: float,
) -> Tip:  # fmt: skip
    """Tip of a grouser as it comes to stand at a support whose normal is so tilted [rad].

    Returns
    -------
    Whether one can; tilt of the normal under it [rad]; length along the belt over which it stands
    on the tread, and over which one that has passed the nosing rolls off it [m]; how far it stands
    ahead of the nosing, along the belt [m].
    """
    tread = supports[at, SUPPORT_TREAD]
    leans = side * (tread - normal)
    if not (supports[at, SUPPORT_IS_ONE] == 1.0 and supports[at, SUPPORT_POINT] != NOWHERE):
        return False, 0.0, 0.0, 0.0, 0.0
    if not h > 0.0 or math.isnan(leans):
        return False, 0.0, 0.0, 0.0, 0.0
    if supports[at, SUPPORT_PLACE] == TREAD and leans <= LEVEL:
        return False, 0.0, 0.0, 0.0, 0.0
    curvature = supports[at, SUPPORT_CURVATURE]
    if not math.isnan(supports[at, SUPPORT_LIFT]):
        if leans <= 0.0:
            return False, 0.0, 0.0, 0.0, 0.0
        radius = 1.0 / curvature
        # the robot stands on its grousers, so the axle is higher by one
        lift = supports[at, SUPPORT_LIFT] - h
        if lift > reach_over_edge(radius, h, s):
            return False, 0.0, 0.0, 0.0, 0.0
        over = edge_tilt(tip_overlap(radius, h, s, lift), r)
        return True, tread - side * over, 0.0, 0.0, 0.0
    theta = min(max(leans, 1e-6), 0.5 * math.pi - 1e-6)
    behind = height_behind(theta, h, s, r, w, curvature) if rigid else h
    beta = tip_tilt(theta, behind, r, curvature)
    run = standing_run(theta, behind, r)
    if rigid and curvature > 0.0:
        run = end_run(theta, behind, r, curvature)
    off = roll_off_length(theta, behind, r)
    if not (leans > 0.0 and leans < 0.5 * math.pi and beta < theta):
        return False, 0.0, 0.0, off, 0.0
    return True, tread - side * beta, run, off, run + r * math.sin(theta - beta)


def lag(supports: SupportTable, one: int, other: int, own: float, its: float) -> float:
    """Share of its speed by which the belt at a support passes more slowly than at another [1].

    Along its path a robot rotates about the point where the normals of both meet, see
    `kaidan.mechanics.grousers_in_turn.belt_lag`.
    """
    d_x = supports[one, SUPPORT_X] - supports[other, SUPPORT_X]
    d_z = supports[one, SUPPORT_Z] - supports[other, SUPPORT_Z]
    far = d_x * math.cos(own) - d_z * math.sin(own)
    if far == 0.0:
        return math.inf
    return float(1.0 - (d_x * math.cos(its) - d_z * math.sin(its)) / far)


def tilt_run_back(
    supports: SupportTable, one: int, other: int, own: float, its: float, tip: Tip, s: float,
    r: float, side: float, more: float,
) -> float:  # fmt: skip
    """Tilt of the normal under a tip that ran back while the belt ran on by a spacing [rad].

    It runs back over the tread first, then over the round of the nosing; NaN: it runs off. Of an
    end it runs faster than the belt, and others at a face push it back: by so much more [m]. A
    robot that goes down does not have to get on against its weight.
    """
    back = s * lag(supports, one, other, own, its) + more - tip[2]
    if side < 0.0 or back <= 0.0:
        return tip[1]
    left = math.sin(side * (tip[1] - own)) - back / max(r, SHARP)
    return own + side * math.asin(left) if left > 0.0 else math.nan


def margin_standing(
    supports: SupportTable, one: int, other: int, own: float, axis: float, loads: LoadTable,
    row: int, tip: Tip, rolls: Tip, nosings: float, treads: float, faces: float, h: float,
    s: float, r: float, rigid: bool, side: float,
) -> float:  # fmt: skip
    """Margin of two supports, a grouser standing at the first [rad]; minus infinity: none can.

    A rigid one stands farther uphill than its nosing, so it bears less of the load if it is the
    upper support. The other support may be a grouser's top, or roll off a nosing with its edge, no
    farther than onto the face: then the worse of two times counts, see
    `kaidan.mechanics.grousers.roll_off_sine`, of the best part in which the other is taken to roll.
    As far as the other one lags it rolls off while the own one stands. Where belts pass the one
    nosing two ways, and nothing else can hold, the tips of each keep off those of the other.
    """
    if not tip[0]:
        return -math.inf
    more = 0.0
    if rigid and side > 0.0:
        if supports[one, SUPPORT_BESIDE] < h and supports[other, SUPPORT_POINT] == NOWHERE:
            return -math.inf
        more = s * h * supports[one, SUPPORT_CURVATURE]
        if supports[other, SUPPORT_PLACE] == FACE:
            more += face_push(h, s, supports[other, SUPPORT_CURVATURE])
    tilt = tilt_run_back(supports, one, other, own, axis, tip, s, r, side, more)
    if math.isnan(tilt):
        return -math.inf
    phi = friction_at(supports, other, nosings, treads, faces, 0.0)
    if not rigid:
        return margin_of(supports, one, tilt, treads, 0.0, other, axis, phi, loads, row)
    d_x = supports[one, SUPPORT_X] - supports[other, SUPPORT_X]
    d_z = supports[one, SUPPORT_Z] - supports[other, SUPPORT_Z]
    ahead = side * tip[4] if side * d_x > 0.0 else 0.0
    gamma = 0.0
    rolled = 0.0
    if supports[other, SUPPORT_PLACE] == NOSING and supports[other, SUPPORT_POINT] != NOWHERE:
        if side > 0.0:
            rolled = min(max(s * lag(supports, other, one, axis, own), 0.0), rolls[3])
        axis -= side * (h / max(math.sqrt(d_x * d_x + d_z * d_z), APART))
        gamma = roll_off_sine(tip[2], rolls[3] - rolled, max(r, SHARP))
    if gamma <= 0.0 and rolled <= 0.0:
        return margin_of(supports, one, tilt, treads, ahead, other, axis, phi, loads, row)
    lean = side * (tilt - own)
    upright = 0.5 * math.pi - side * (supports[other, SUPPORT_TREAD] - axis)
    most = -math.inf
    for half in range(3):
        # the other has rolled off by so much at most, or the own one has climbed by the rest
        sine = min(half * gamma + rolled / max(r, SHARP), 1.0)
        turned = min(math.asin(sine), max(upright, 0.0))
        left = math.asin(max(math.sin(lean) - (2 - half) * gamma, 0.0))
        first = margin_of(
            supports, one, tilt, treads, ahead, other, axis - side * turned, phi, loads, row
        )
        if first <= most:  # the worse of the two is no better
            continue
        then = margin_of(
            supports, one, tilt - side * (lean - left), treads, ahead, other, axis, phi, loads, row
        )
        most = larger(most, smaller(first, then))
    return most


def margin_of_several(
    supports: SupportTable, at: int, several: int, required: float, tip: Tip, nosings: float,
    s: float, rigid: bool, side: float,
) -> float:  # fmt: skip
    """Margin of a pose on three supports or more, a grouser standing at one of them [rad].

    Rigid grousers hold in the mean over their phases. Others share the load, and one with no less
    than its part will stand.
    """
    if not tip[0]:
        return -math.inf
    theta = min(required, STEEPEST)
    if rigid:
        q = max(tip[2], 0.0) / s
        needed = phases_friction(theta, MANY * q if several > 3 else q)
    else:
        lean = min(max(side * (tip[1] - supports[at, SUPPORT_NORMAL]), 0.0), theta)
        needed = standing_friction(theta, theta - lean, 1.0 / several)
    return nosings - math.atan2(needed, 1.0)


@entry
def standing_margins(
    supports: SupportTable, slots: int, loads: LoadTable, like: IntArray, nosings: float,
    treads: float, faces: float, h: float, s: float, w: float, r: float, rigid: bool, side: float,
    found: FloatRow,
) -> None:  # fmt: skip
    """Margin of each pose with a grouser that stands at each of its supports.

    Which two of several supports carry depends on where grousers stand. So the least over the pairs
    counts: with that support among them, or else with the better of the two.

    Parameters
    ----------
    supports, slots, loads, like
        As :func:`kaidan.contact.kernel.supports.find_alike` takes and fills them.
    nosings, treads, faces
        Angles of friction [rad].
    h, s, w
        Height of the grousers under load, their spacing, width of their tips along the belt [m].
    r
        Radius of the nosings [m].
    rigid
        Whether they are rigid and sharp.
    side
        +1 where the robot climbs, -1 where it goes down.
    found
        To be filled, as many a pose as it has slots [rad]; minus infinity: none can stand there.
    """
    pushing = h if rigid else 0.0
    for row in range(loads.shape[0]):
        first = row * slots
        if like[row] != row:
            for slot in range(slots):
                found[first + slot] = found[like[row] * slots + slot]
            continue
        several = 0
        for slot in range(slots):
            found[first + slot] = math.inf
            if supports[first + slot, SUPPORT_IS_ONE] == 1.0:
                several += 1
        for j in range(1, several):
            for i in range(j):
                if not carry(supports, first, i, j, loads, row):
                    continue
                at_i = pushed_normal(supports, first + i, first + j, pushing, r, side)
                at_j = pushed_normal(supports, first + j, first + i, pushing, r, side)
                of_i = tip_at(supports, first + i, at_i, h, s, w, r, rigid, side)
                of_j = tip_at(supports, first + j, at_j, h, s, w, r, rigid, side)
                one = margin_standing(
                    supports, first + i, first + j, at_i, at_j, loads, row, of_i, of_j, nosings,
                    treads, faces, h, s, r, rigid, side,
                )  # fmt: skip
                other = margin_standing(
                    supports, first + j, first + i, at_j, at_i, loads, row, of_j, of_i, nosings,
                    treads, faces, h, s, r, rigid, side,
                )  # fmt: skip
                for slot in range(slots):
                    own = larger(one, other)
                    if slot == i:
                        own = one
                    if slot == j:
                        own = other
                    found[first + slot] = smaller(found[first + slot], own)
        for slot in range(slots):
            at = first + slot
            if found[at] == math.inf:
                found[at] = -math.inf
            if several > 2:
                normal = supports[at, SUPPORT_NORMAL]
                tip = tip_at(supports, at, normal, h, s, w, r, rigid, side)
                of_all = margin_of_several(
                    supports, at, several, loads[row, LOAD_COULOMB], tip, nosings, s, rigid, side
                )
                found[at] = smaller(found[at], of_all)
        if side > 0.0 and pushing > 0.0 and is_in_doubt(supports, first, slots):
            for at in range(first, first + slots):
                found[at] = with_reserve(found[at], nosings)
