r"""Extreme figures of each phase of a path: which poses count for each, and the least or largest.

::

    phase     ENTER ......, TRAVERSE ........, LAND ....      a pose between two phases is of both
    friction    .''.       .'''.  .'''.         .'.  o        o   a trailing end that leaves an edge
    of each  --'    '-----'     ''     '-------'   ''             as the robot lands slides
"""

from __future__ import annotations

import math

from kaidan.contact.codes import BESIDE_NOSINGS, EVERY_POSE
from kaidan.contact.columns import (
    BACK,
    BELLY_TOUCHES,
    EXTREME_BELLY,
    EXTREME_ENERGY,
    EXTREME_FRICTION,
    EXTREME_FRICTION_X,
    EXTREME_POSES,
    EXTREME_SLIDES,
    EXTREME_STATIC,
    EXTREME_STEADY,
    EXTREME_TILT_DOWNHILL,
    EXTREME_TILT_UPHILL,
    EXTREME_TRACTION,
    EXTREME_UPHILL,
    FLIGHT_BEGIN,
    FLIGHT_END,
    FRONT,
    FRONT_N_X,
    FRONT_N_Z,
    FRONT_X,
    FRONT_Z,
    POSE_X,
    POSE_Z,
    REAR_N_X,
    REAR_N_Z,
    REAR_X,
    REAR_Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.energy_margins import least_flow_energy
from kaidan.contact.kernel.first_rock import first_rock
from kaidan.contact.kernel.phases import ENTERS, LANDS, TRAVERSES, in_zone
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    ExtremeTable,
    FlightTable,
    FloatRow,
    GroundTable,
    IntArray,
    MarginTable,
    PoseTable,
    WayTable,
    ZoneTable,
)

#: Difference of figures that is none.
TIE = 1e-9
#: Lever over that about the flat, as a share of its height, below which none is less [1].
LEAST_SHARE = 1e-6


def is_of_phase(phase: IntArray, corner: IntArray, row: int, number: int) -> bool:
    """Whether a pose of the path is of a phase; one at a corner between two is of both."""
    if phase[row] == number:
        return True
    if corner[row] == 0:
        return False
    behind = phase[row - 1] if row > 0 else -1
    ahead = phase[row + 1] if row + 1 < phase.shape[0] else -1
    return bool(behind == number or ahead == number)


def is_among(places: FloatRow, x: float) -> bool:
    """Whether a place is one of some in their order, to the last digit."""
    low = 0
    high = places.shape[0]
    while low < high:
        middle = (low + high) // 2
        if places[middle] < x:
            low = middle + 1
        else:
            high = middle
    return low < places.shape[0] and bool(places[low] == x)


def is_on_flight(poses: PoseTable, row: int, flights: FlightTable) -> bool:
    """Whether both contacts of a pose stand on one flight."""
    for k in range(flights.shape[0]):
        if (
            flights[k, FLIGHT_BEGIN] <= poses[row, REAR_X]
            and poses[row, FRONT_X] <= flights[k, FLIGHT_END]
        ):
            return True
    return False


def is_over_top(poses: PoseTable, row: int, descending: bool, tops: ZoneTable) -> bool:
    """Whether the uppermost contact of a pose is a flight's last nosing or beyond."""
    if descending:
        return in_zone(tops, poses[row, REAR_X], poses[row, REAR_Z])
    return in_zone(tops, poses[row, FRONT_X], poses[row, FRONT_Z])


def height_of_stop(lever: float, gyration: float, g: float) -> float:
    """Rise that a sudden stop from 1 m/s brings about [m].

    See :func:`kaidan.mechanics.measures.sudden_stop_height`.
    """
    return 1.0 / (2.0 * g) * (lever * lever) / (gyration * gyration + lever * lever)


def as_on_flat(
    poses: PoseTable, row: int, side: float, height: float, gyration: float, g: float
) -> float:
    """Rise about the flat over that about the outermost contact, of one sudden stop.

    ``height`` is that of the centroid above the flat [m].
    """
    if side > 0.0:
        along = (poses[row, POSE_X] - poses[row, REAR_X]) * poses[row, REAR_N_X]
        up = (poses[row, POSE_Z] - poses[row, REAR_Z]) * poses[row, REAR_N_Z]
    else:
        along = (poses[row, POSE_X] - poses[row, FRONT_X]) * poses[row, FRONT_N_X]
        up = (poses[row, POSE_Z] - poses[row, FRONT_Z]) * poses[row, FRONT_N_Z]
    flat = height_of_stop(height, gyration, g)
    return flat / max(height_of_stop(along + up, gyration, g), LEAST_SHARE * flat)


def rows_of_phase(
    phase: IntArray, corner: IntArray, at: IntArray, lasts: IntArray, number: int, rows: IntArray
) -> int:
    """Find the poses of a phase that last; ``at`` is the pose of the path that each counts as."""
    many = 0
    for row in range(at.shape[0]):
        if lasts[row] == 1 and is_of_phase(phase, corner, at[row], number):
            rows[many] = row
            many += 1
    return many


def put_pose_figures(
    poses: PoseTable, margins: MarginTable, friction: FloatRow, traction: FloatRow,
    leaves: IntArray, rows: IntArray, many: int, descending: bool, number: int,
    extremes: ExtremeTable,
) -> None:  # fmt: skip
    """Put friction, traction, static margin and belly of the poses of a phase.

    Where the trailing end leaves an edge as the robot lands, it slides: the friction and traction
    there do not count.
    """
    static = FRONT if descending else BACK
    highest = 0.0
    slides = math.nan
    pulls = 0.0
    margin = math.nan
    belly = 0.0
    for k in range(many):
        row = rows[k]
        if number == LANDS and leaves[row] == 1:
            slides = friction[row] if math.isnan(slides) else max(slides, friction[row])
        else:
            highest = max(highest, friction[row])
            pulls = max(pulls, traction[row])
        if math.isnan(margin) or margins[row, static] < margin:
            margin = margins[row, static]
        belly = max(belly, margins[row, BELLY_TOUCHES])
    extremes[number, EXTREME_POSES] = many
    extremes[number, EXTREME_SLIDES] = slides
    extremes[number, EXTREME_STATIC] = margin
    extremes[number, EXTREME_TRACTION] = pulls
    extremes[number, EXTREME_BELLY] = belly
    for k in range(many):
        row = rows[k]
        held = 0.0 if number == LANDS and leaves[row] == 1 else friction[row]
        if held >= highest - TIE:  # infinite less that is infinite
            extremes[number, EXTREME_FRICTION] = held
            extremes[number, EXTREME_FRICTION_X] = poses[row, FRONT_X]
            break


def find_barrier(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, rows: IntArray,
    many: int, side: float, height: float, gyration: float, g: float, weights: FloatRow,
    order: IntArray, pivots: FloatRow, extremes: ExtremeTable, number: int, column: int,
) -> None:  # fmt: skip
    """Put the smallest rise that a fall of some poses to one side needs, and its place.

    With a ``height`` of the centroid above the flat it is the rise about the flat by the same
    sudden stop; zero: the rise as it is.
    """
    extremes[number, column] = math.inf
    extremes[number, column + 1] = math.nan
    if many == 0:
        return
    for k in range(many):
        row = rows[k]
        weights[row] = 1.0
        if height > 0.0:
            weights[row] = as_on_flat(poses, row, side, height, gyration, g)
    least, row = least_flow_energy(
        ground, body, poses, margins, rows[0:many], side, weights, TIE, order, pivots
    )
    extremes[number, column] = least
    extremes[number, column + 1] = poses[row if row >= 0 else rows[0], FRONT_X]


def posed_rows(
    poses: PoseTable, rows: IntArray, many: int, counts: int, nosings: FloatRow, chosen: IntArray
) -> int:
    """Find those poses of a phase whose contacts count for its energy."""
    kept = 0
    for k in range(many):
        row = rows[k]
        if counts == EVERY_POSE or (
            counts == BESIDE_NOSINGS and not is_among(nosings, poses[row, FRONT_X])
        ):
            chosen[kept] = row
            kept += 1
    return kept


def rows_below_top(
    poses: PoseTable, rows: IntArray, many: int, descending: bool, tops: ZoneTable,
    chosen: IntArray,
) -> int:  # fmt: skip
    """Find those of some poses over which another nosing uphill is still to come."""
    kept = 0
    for k in range(many):
        row = rows[k]
        if not is_over_top(poses, row, descending, tops):
            chosen[kept] = row
            kept += 1
    return kept


def judged_rows(
    poses: PoseTable, phase: IntArray, at: IntArray, rows: IntArray, many: int, whole: bool,
    number: int, flights: FlightTable, chosen: IntArray,
) -> int:  # fmt: skip
    """Find those poses of a phase that are judged by their tilts.

    Traversing the criterion on nosings judges a flat that carries all along: what stands on one
    flight; and of a pose between two phases the other one judges.
    """
    kept = 0
    for k in range(many):
        row = rows[k]
        if (
            whole
            and number == TRAVERSES
            and (phase[at[row]] != TRAVERSES or is_on_flight(poses, row, flights))
        ):
            continue
        chosen[kept] = row
        kept += 1
    return kept


def rows_that_tip(
    at: IntArray, rows: IntArray, many: int, back: IntArray, descending: bool, number: int,
    chosen: IntArray,
) -> int:  # fmt: skip
    """Find those poses of a phase that gravity may tip over the downhill end.

    Over the edge of the landing above the robot has to rotate; tilted back it only comes back where
    its leading end came down.
    """
    kept = 0
    if descending and number == ENTERS:
        return kept
    for k in range(many):
        if back[at[rows[k]]] == 0:
            chosen[kept] = rows[k]
            kept += 1
    return kept


@entry
def find_extremes(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    margins: MarginTable,
    phase: IntArray,
    corner: IntArray,
    at: IntArray,
    lasts: IntArray,
    friction: FloatRow,
    traction: FloatRow,
    leaves: IntArray,
    whence: FloatRow,
    back: IntArray,
    counts: IntArray,
    descending: bool,
    whole: bool,
    tops: ZoneTable,
    flights: FlightTable,
    nosings: FloatRow,
    height: float,
    gyration: float,
    a: float,
    g: float,
    touch: float,
    weights: FloatRow,
    came: FloatRow,
    rows: IntArray,
    posed: IntArray,
    some: IntArray,
    heap: IntArray,
    pivots: FloatRow,
    values: FloatRow,
    group: IntArray,
    narrow: IntArray,
    marks: IntArray,
    pose: IntArray,
    reach: FloatRow,
    alone: FloatRow,
    tilt: FloatRow,
    beside: IntArray,
    largest: FloatRow,
    s: FloatRow,
    line: IntArray,
    ways: WayTable,
    kept: WayTable,
    order: IntArray,
    chosen: IntArray,
    places: IntArray,
    shares: FloatRow,
    inside: FloatRow,
    new: PoseTable,
    new_margins: MarginTable,
    contacts: ContactTable,
    dips: IntArray,
    between: PoseTable,
    between_margins: MarginTable,
    extremes: ExtremeTable,
) -> None:
    """Find the extreme figures of each phase of a path.

    Parameters
    ----------
    ground, body, a, g, touch
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    poses, margins
        Poses of a path and behind them those between two of it, with their margins.
    phase, corner
        Number of the phase of each pose of the path; 1 where a contact runs over a corner.
    at
        Pose of the path that each pose counts as.
    lasts, friction, traction, leaves
        Of each pose whether the robot stands so for a while (1), what it requires [1], its
        tractive force over mass without a sign [N/kg], whether the trailing end leaves an edge (1).
    whence, back
        Of each pose of the path the inclination from which it came down by rocking, minus infinity
        from none [rad]; whether it came down otherwise (1), so that it only comes back.
    counts
        Of each phase which poses count for the energy: `NO_POSE`, `BESIDE_NOSINGS`, `EVERY_POSE`.
    descending, whole
        Whether the path leads down the stairs; whether one flat carries all along on a flight.
    tops
        Zones of the uppermost contact over a flight's last nosing (k, 4): first and last x, lowest
        and highest z [m].
    flights
        First and last place of the contacts of a robot that stands on each flight [m].
    nosings
        Places of nosings in their order [m].
    height, gyration
        Of the centroid above the flat, and its least radius of gyration [m].
    weights, came, rows, posed, some, heap, pivots
        Scratch of so many poses.
    values, group, narrow, marks, pose, reach, alone, tilt, beside
        Scratch of :func:`kaidan.contact.kernel.first_rock.first_rock`.
    largest, s, line, ways, kept, order, chosen, places, shares, inside, new, new_margins, contacts
        Scratch of :func:`kaidan.contact.kernel.peak_search.find_peaks`.
    dips, between, between_margins
        Likewise what it fills.
    extremes
        To be filled, a row a phase: number of poses, and where there is one the figures of
        `kaidan.contact.columns`.
    """
    side = -1.0 if descending else 1.0
    for number in range(extremes.shape[0]):
        many = rows_of_phase(phase, corner, at, lasts, number, rows)
        extremes[number, EXTREME_POSES] = many
        if many == 0:
            continue
        put_pose_figures(
            poses, margins, friction, traction, leaves, rows, many, descending, number, extremes
        )
        count = posed_rows(poses, rows, many, counts[number], nosings, posed)
        find_barrier(
            ground, body, poses, margins, posed, count, side, 0.0, gyration, g, weights, heap,
            pivots, extremes, number, EXTREME_ENERGY,
        )  # fmt: skip
        find_barrier(
            ground, body, poses, margins, posed, count, side, height, gyration, g, weights, heap,
            pivots, extremes, number, EXTREME_STEADY,
        )  # fmt: skip
        left = 0
        if number == TRAVERSES:
            left = rows_below_top(poses, posed, count, descending, tops, some)
        find_barrier(
            ground, body, poses, margins, some, left, -side, height, gyration, g, weights, heap,
            pivots, extremes, number, EXTREME_UPHILL,
        )  # fmt: skip
        count = judged_rows(poses, phase, at, rows, many, whole, number, flights, posed)
        for uphill in range(2):
            column = EXTREME_TILT_UPHILL if uphill == 1 else EXTREME_TILT_DOWNHILL
            left = 0
            if uphill == 0:
                left = rows_that_tip(at, posed, count, back, descending, number, some)
            elif number == TRAVERSES:
                left = rows_below_top(poses, posed, count, descending, tops, some)
            for row in range(poses.shape[0]):
                came[row] = -math.inf if uphill == 1 else whence[at[row]]
            extremes[number, column] = math.inf
            extremes[number, column + 1] = math.nan
            if left == 0:
                continue
            least, where = first_rock(
                ground, body, poses, margins, some[0:left], phase.shape[0],
                -side if uphill == 1 else side, came, a, g, touch, values, group, narrow, marks,
                pose, reach, alone, tilt, beside, largest, s, line, ways, kept, order, chosen,
                places, shares, inside, new, new_margins, contacts, dips, between, between_margins,
            )  # fmt: skip
            extremes[number, column] = least
            if where >= 0:
                extremes[number, column + 1] = poses[where, FRONT_X]
