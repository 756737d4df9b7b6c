r"""Extreme figures of each phase of a path: which poses count for each, and the least or largest.

::

    phase     ENTER ......, TRAVERSE ........, LAND ....      a pose between two phases is of both
    friction    .''.       .'''.  .'''.         .'.  o        o   a trailing end that leaves an edge
    of each  --'    '-----'     ''     '-------'   ''             as the robot lands slides
"""

from __future__ import annotations

import math

from kaidan.contact.codes import BESIDE_NOSINGS, EVERY_POSE
from kaidan.contact.entries import entry
from kaidan.contact.kernel.energy_margins import least_flow_energy
from kaidan.contact.kernel.first_rock import first_rock
from kaidan.contact.kernel.phases import ENTERS, LANDS, TRAVERSES, in_zone
from kaidan.contact.layout import (
    Extreme,
    Flight,
    Known,
    Leading,
    Margin,
    Pose,
    Pull,
    Scene,
)
from kaidan.contact.memory import Row, Table, empty

#: Difference of figures that is none.
TIE = 1e-9
#: Lever over that about the flat, as a share of its height, below which none is less [1].
LEAST_SHARE = 1e-6


def is_of_phase(known: Known, row: int, number: int) -> bool:
    """Whether a pose of the path is of a phase; one at a corner between two is of both."""
    phase = known.phase
    if phase[row] == number:
        return True
    if not known.corner[row]:
        return False
    behind = phase[row - 1] if row > 0 else -1
    ahead = phase[row + 1] if row + 1 < len(phase) else -1
    return behind == number or ahead == number


def is_among(places: Row[float], x: float) -> bool:
    """Whether a place is one of some in their order, to the last digit."""
    low = 0
    high = len(places)
    while low < high:
        middle = (low + high) // 2
        if places[middle] < x:
            low = middle + 1
        else:
            high = middle
    return low < len(places) and places[low] == x


def is_on_flight(pose: Pose, flights: Table[Flight]) -> bool:
    """Whether both contacts of a pose stand on one flight."""
    for k in range(len(flights)):
        if flights[k].begin <= pose.rear.x and pose.front.x <= flights[k].end:
            return True
    return False


def is_over_top(pose: Pose, leading: Leading) -> bool:
    """Whether the uppermost contact of a pose is a flight's last nosing or beyond."""
    if leading.descending:
        return in_zone(leading.tops, pose.rear.x, pose.rear.z)
    return in_zone(leading.tops, pose.front.x, pose.front.z)


def height_of_stop(lever: float, gyration: float, g: float) -> float:
    """Rise that a sudden stop from 1 m/s brings about [m].

    See :func:`kaidan.mechanics.measures.sudden_stop_height`.
    """
    return 1.0 / (2.0 * g) * (lever * lever) / (gyration * gyration + lever * lever)


def as_on_flat(pose: Pose, side: float, height: float, gyration: float, g: float) -> float:
    """Rise about the flat over that about the outermost contact, of one sudden stop.

    ``height`` is that of the centroid above the flat [m].
    """
    touch = pose.rear if side > 0.0 else pose.front
    along = (pose.x - touch.x) * touch.n_x
    up = (pose.z - touch.z) * touch.n_z
    flat = height_of_stop(height, gyration, g)
    return flat / max(height_of_stop(along + up, gyration, g), LEAST_SHARE * flat)


def rows_of_phase(known: Known, number: int, rows: Row[int]) -> int:
    """Find the poses of a phase that last."""
    many = 0
    for row in range(len(known.at)):
        if known.lasts[row] and is_of_phase(known, known.at[row], number):
            rows[many] = row
            many += 1
    return many


def put_pose_figures(
    poses: Table[Pose], margins: Table[Margin], known: Known, rows: Row[int], descending: bool,
    number: int, extreme: Extreme,
) -> None:  # fmt: skip
    """Put friction, traction, static margin and belly of the poses of a phase.

    Where the trailing end leaves an edge as the robot lands, it slides: the friction and traction
    there do not count.
    """
    highest = 0.0
    slides = math.nan
    pulls = 0.0
    margin = math.nan
    belly = False
    for k in range(len(rows)):
        row = rows[k]
        friction = known.friction[row]
        if number == LANDS and known.leaves[row]:
            slides = friction if math.isnan(slides) else max(slides, friction)
        else:
            highest = max(highest, friction)
            pulls = max(pulls, known.traction[row])
        least = margins[row].front if descending else margins[row].back
        if math.isnan(margin) or least < margin:
            margin = least
        belly = belly or margins[row].belly_touches
    extreme.slides_below = slides
    extreme.static_margin = margin
    extreme.traction = pulls
    extreme.belly = belly
    extreme.friction = math.nan
    extreme.friction_place = math.nan
    for k in range(len(rows)):
        row = rows[k]
        held = 0.0 if number == LANDS and known.leaves[row] else known.friction[row]
        if held >= highest - TIE:  # infinite less that is infinite
            extreme.friction = held
            extreme.friction_place = poses[row].front.x
            break


def find_barrier(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], rows: Row[int], side: float,
    height: float, gyration: float, g: float,
) -> tuple[float, float]:  # fmt: skip
    """Smallest rise that a fall of some poses to one side needs, and its place.

    With a ``height`` of the centroid above the flat it is the rise about the flat by the same
    sudden stop; zero: the rise as it is.
    """
    if len(rows) == 0:
        return math.inf, math.nan
    weights = empty(float, len(poses))
    for k in range(len(rows)):
        weights[rows[k]] = 1.0
        if height > 0.0:
            weights[rows[k]] = as_on_flat(poses[rows[k]], side, height, gyration, g)
    least, row = least_flow_energy(scene, poses, margins, rows, side, weights, TIE)
    return least, poses[row if row >= 0 else rows[0]].front.x


def posed_rows(
    poses: Table[Pose], rows: Row[int], counts: int, nosings: Row[float], chosen: Row[int]
) -> int:
    """Find those poses of a phase whose contacts count for its energy."""
    kept = 0
    for k in range(len(rows)):
        row = rows[k]
        if counts == EVERY_POSE or (
            counts == BESIDE_NOSINGS and not is_among(nosings, poses[row].front.x)
        ):
            chosen[kept] = row
            kept += 1
    return kept


def rows_below_top(poses: Table[Pose], rows: Row[int], leading: Leading, chosen: Row[int]) -> int:
    """Find those of some poses over which another nosing uphill is still to come."""
    kept = 0
    for k in range(len(rows)):
        if not is_over_top(poses[rows[k]], leading):
            chosen[kept] = rows[k]
            kept += 1
    return kept


def judged_rows(
    poses: Table[Pose], known: Known, rows: Row[int], number: int, leading: Leading,
    chosen: Row[int],
) -> int:  # fmt: skip
    """Find those poses of a phase that are judged by their tilts.

    Traversing the criterion on nosings judges a flat that carries all along: what stands on one
    flight; and of a pose between two phases the other one judges.
    """
    kept = 0
    for k in range(len(rows)):
        row = rows[k]
        if (
            leading.whole
            and number == TRAVERSES
            and (
                known.phase[known.at[row]] != TRAVERSES or is_on_flight(poses[row], leading.flights)
            )
        ):
            continue
        chosen[kept] = row
        kept += 1
    return kept


def rows_that_tip(
    known: Known, rows: Row[int], descending: bool, number: int, chosen: Row[int]
) -> int:
    """Find those poses of a phase that gravity may tip over the downhill end.

    Over the edge of the landing above the robot has to rotate; tilted back it only comes back where
    its leading end came down.
    """
    kept = 0
    if descending and number == ENTERS:
        return kept
    for k in range(len(rows)):
        if not known.back[known.at[rows[k]]]:
            chosen[kept] = rows[k]
            kept += 1
    return kept


def find_tilt(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], known: Known, rows: Row[int],
    side: float, uphill: bool, pull: Pull,
) -> tuple[float, float]:  # fmt: skip
    """Least tilt of gravity at which some poses rotate to a side, and its place."""
    if len(rows) == 0:
        return math.inf, math.nan
    came = empty(float, len(poses))
    for row in range(len(poses)):
        came[row] = -math.inf if uphill else known.whence[known.at[row]]
    least, where = first_rock(scene, poses, margins, rows, len(known.phase), side, came, pull)
    return least, poses[where].front.x if where >= 0 else math.nan


@entry
def find_extremes(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], known: Known, leading: Leading,
    pull: Pull, extremes: Table[Extreme],
) -> None:  # fmt: skip
    """Find the extreme figures of each phase of a path.

    extremes: to be filled, a row a phase: the number of poses, and where there is one the figures.
    """
    side = -1.0 if leading.descending else 1.0
    height = leading.height
    gyration = leading.gyration
    rows = empty(int, len(poses))
    posed = empty(int, len(poses))
    some = empty(int, len(poses))
    for number in range(len(extremes)):
        extreme = extremes[number]
        many = rows_of_phase(known, number, rows)
        extreme.poses = many
        if many == 0:
            continue
        of_phase = rows[0:many]
        put_pose_figures(poses, margins, known, of_phase, leading.descending, number, extreme)
        count = posed_rows(poses, of_phase, leading.counts[number], leading.nosings, posed)
        extreme.energy, extreme.energy_place = find_barrier(
            scene, poses, margins, posed[0:count], side, 0.0, gyration, pull.g
        )
        extreme.steadiness, extreme.steadiness_place = find_barrier(
            scene, poses, margins, posed[0:count], side, height, gyration, pull.g
        )
        left = 0
        if number == TRAVERSES:
            left = rows_below_top(poses, posed[0:count], leading, some)
        extreme.uphill, extreme.uphill_place = find_barrier(
            scene, poses, margins, some[0:left], -side, height, gyration, pull.g
        )
        count = judged_rows(poses, known, of_phase, number, leading, posed)
        left = rows_that_tip(known, posed[0:count], leading.descending, number, some)
        extreme.tilt_downhill, extreme.tilt_downhill_place = find_tilt(
            scene, poses, margins, known, some[0:left], side, False, pull
        )
        left = 0
        if number == TRAVERSES:
            left = rows_below_top(poses, posed[0:count], leading, some)
        extreme.tilt_uphill, extreme.tilt_uphill_place = find_tilt(
            scene, poses, margins, known, some[0:left], -side, True, pull
        )
