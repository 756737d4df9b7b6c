r"""Traverses rated: the largest figures of each, worked out where its poses are.

::

    drive -> poses, rotations      of a traverse that arrives: friction, belly
                  |                of its rotations, those that follow at once together:
                  `-> a row        angle, rocking, speed of impact, rise to spare
    poses, belts -> what grousers hold, see `kaidan.contact.kernel.holding`
"""

from __future__ import annotations

import math

from kaidan.contact.codes import RotationOutcome, Status
from kaidan.contact.columns import (
    BARRIER,
    BARRIER_ACROSS,
    BELLY_TOUCHES,
    END_PHI,
    END_X,
    END_Z,
    FLIGHT_BEGIN,
    FLIGHT_END,
    FLIGHT_SLOPE,
    FRICTION,
    FRONT_X,
    FRONT_Z,
    JOB_ACCELERATION,
    JOB_END,
    JOB_GYRATION,
    JOB_PHI,
    JOB_ROBOT,
    JOB_START,
    OUTCOME,
    PIVOT_X,
    PIVOT_Z,
    POSE_LEG,
    POSE_PSI,
    POSE_S,
    RATED_ANGLE,
    RATED_BELLY,
    RATED_FRICTION,
    RATED_HELD,
    RATED_HELD_BEST,
    RATED_IMPACT,
    RATED_ROCKING,
    RATED_SPARE,
    RATED_STATUS,
    REAR_X,
    ROTATION_ANGLE,
    ROTATION_S,
    ROTATION_SENSE,
    START_PHI,
    START_X,
    START_Z,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.driver import drive
from kaidan.contact.kernel.holding import find_standing, least_held
from kaidan.contact.kernel.impact import impact_speed
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.phases import in_zone
from kaidan.contact.kernel.sampling import leaves_edge
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    EventTable,
    FlightTable,
    FloatRow,
    GroundTable,
    GrouserTable,
    IntArray,
    JobTable,
    LoadTable,
    MarginTable,
    PointTable,
    PoseTable,
    RatingTable,
    RotationTable,
    SupportTable,
    ZoneTable,
)

#: Way of the centroid between two rotations that follow at once, over the flat's length [1].
FOLLOWS = 0.01


def comes_off(poses: PoseTable, row: int, zones: ZoneTable) -> bool:
    """Whether the trailing end leaves an edge on the way down, the front on a landing."""
    return leaves_edge(poses, row) and in_zone(zones, poses[row, FRONT_X], poses[row, FRONT_Z])


@entry
def row_before(poses: PoseTable, count: int, s: float) -> int:
    """Row of the last pose of the line of poses that ends at an arclength.

    Parameters
    ----------
    poses, count
        Poses in the order of their arclengths, and how many.
    s
        Where a rotation begins [m]: between two rows of one arclength, before it and after it.

    Returns
    -------
    row
        Where no pose is the last one before.
    """
    low = 0
    high = count
    while low < high:
        middle = (low + high) // 2
        if poses[middle, POSE_S] < s - 1e-9:
            low = middle + 1
        else:
            high = middle
    best = -1
    row = low
    while row < count and poses[row, POSE_S] <= s + 1e-9:
        if best < 0 or poses[row, POSE_LEG] <= poses[best, POSE_LEG]:
            best = row
        row += 1
    if best >= 0:
        return best
    return low - 1 if low > 0 else 0


def beyond_the_edge(
    rotations: RotationTable, row: int, edges: PointTable, flat: float, rough: float
) -> float:
    """How far a rotation goes below the line from its pivot to the next edge [rad]."""
    line = -math.inf
    for k in range(edges.shape[0]):
        x = edges[k, X] - rotations[row, PIVOT_X]
        z = edges[k, Z] - rotations[row, PIVOT_Z]
        if x > rough and math.sqrt(x * x + z * z) <= flat:
            line = max(line, math.atan2(z, x))
    if line == -math.inf:
        return 0.0
    below: float = min(line, rotations[row, START_PHI]) - rotations[row, END_PHI]
    return max(below, 0.0)


def flight_at(poses: PoseTable, row: int, flights: FlightTable) -> int:
    """Flight on which both contacts of a pose and of the next stand; -1: none."""
    rear = min(poses[row, REAR_X], poses[row + 1, REAR_X])
    front = max(poses[row, FRONT_X], poses[row + 1, FRONT_X])
    for k in range(flights.shape[0]):
        if flights[k, FLIGHT_BEGIN] <= rear and front <= flights[k, FLIGHT_END]:
            return k
    return -1


def rocking(turn: float, before: float, after: float, theta_s: float) -> float:
    """What of a turn counts as rocking on a flight, see :mod:`kaidan.mechanics.rocking` [rad]."""
    return min(turn, max(abs(before - theta_s), abs(after - theta_s)))


def rate_rotations(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    n_pose: int,
    rotations: RotationTable,
    count: int,
    a: float,
    g: float,
    flat: float,
    rough: float,
    tilt_rear: float,
    tilt_front: float,
    edges: PointTable,
    flights: FlightTable,
    found: ContactTable,
    ratings: RatingTable,
    job: int,
) -> None:
    """Write the extremes over the chains of rotations that follow one another at once."""
    most = 0.0
    rocks = 0.0
    speed = 0.0
    spare = math.inf
    angle = 0.0
    avoids = 0.0
    fallen = 0.0
    moved = 0.0
    lowest = math.inf
    highest = -math.inf
    flight = -1
    begins = True
    for row in range(count):
        if row > 0:
            w_x = rotations[row, START_X] - rotations[row - 1, END_X]
            w_z = rotations[row, START_Z] - rotations[row - 1, END_Z]
            if math.sqrt(w_x * w_x + w_z * w_z) > FOLLOWS * flat:
                angle = 0.0
                avoids = 0.0
                fallen = 0.0
                moved = 0.0
                lowest = math.inf
                highest = -math.inf
                begins = True
        at = row_before(poses, n_pose, rotations[row, ROTATION_S])
        psi = poses[at, POSE_PSI]
        ahead = a * math.cos(psi)
        up = g + a * math.sin(psi)
        size = math.sqrt(ahead * ahead + up * up)
        d_x = rotations[row, START_X] - rotations[row, END_X]
        d_z = rotations[row, START_Z] - rotations[row, END_Z]
        fallen += (up * d_z + ahead * d_x) / size
        moved -= (up * d_x - ahead * d_z) / size
        angle += rotations[row, ROTATION_ANGLE]
        if rotations[row, ROTATION_SENSE] < 0.0:
            avoids += beyond_the_edge(rotations, row, edges, flat, rough)
        else:
            avoids += rotations[row, ROTATION_ANGLE]
        lowest = min(lowest, rotations[row, START_PHI], rotations[row, END_PHI])
        highest = max(highest, rotations[row, START_PHI], rotations[row, END_PHI])
        stands = -1
        arrested = int(rotations[row, OUTCOME]) == RotationOutcome.ARRESTED
        if arrested:
            stands = flight_at(poses, at, flights)
        if begins:
            flight = stands
        elif stands != flight:
            flight = -1
        begins = False
        if arrested:
            speed = max(speed, impact_speed(ground, body, rotations, row, found))
        rise = rotations[row, BARRIER] / size - fallen
        way = moved + rotations[row, BARRIER_ACROSS]
        if rotations[row, ROTATION_SENSE] < 0.0:
            rise = math.cos(tilt_front) * rise - math.sin(tilt_front) * way
        else:
            rise = math.cos(tilt_rear) * rise + math.sin(tilt_rear) * way
        spare = min(spare, rise)
        most = max(most, angle)
        if flight < 0:
            rocks = max(rocks, avoids)
        else:
            rocks = max(rocks, rocking(avoids, lowest, highest, flights[flight, FLIGHT_SLOPE]))
    ratings[job, RATED_ANGLE] = most
    ratings[job, RATED_ROCKING] = rocks
    ratings[job, RATED_IMPACT] = speed
    ratings[job, RATED_SPARE] = spare


@entry
def rate_many(
    ground: GroundTable,
    bodies: BodyTable,
    ends: IntArray,
    flats: FloatRow,
    flight_ends: IntArray,
    flights: FlightTable,
    jobs: JobTable,
    step: float,
    g: float,
    touch: float,
    rough: float,
    tilt_rear: float,
    tilt_front: float,
    zones: ZoneTable,
    edges: PointTable,
    treads: FloatRow,
    climbs: bool,
    steep: float,
    on_flat: float,
    slip: float,
    grousers: GrouserTable,
    poses: PoseTable,
    events: EventTable,
    rotations: RotationTable,
    margins: MarginTable,
    found: ContactTable,
    supports: SupportTable,
    loads: LoadTable,
    unlike: IntArray,
    like: IntArray,
    counts: IntArray,
    points: IntArray,
    standing: FloatRow,
    friction: FloatRow,
    held: FloatRow,
    ratings: RatingTable,
) -> None:
    """Drive a list of jobs over one terrain and rate each.

    Parameters
    ----------
    ground
        Terrain.
    bodies, ends, flats
        Body tables one below the other, the row after the end of each, length of its flat [m].
    flight_ends, flights
        Flights as each robot sees them one below the other, the row after those of each: first and
        last x [m], mean slope [rad].
    jobs
        As in :func:`kaidan.contact.kernel.batch.traverse_many`; the terrain and the reference
        inclination play no part.
    step, g, touch, rough
        Arclength between poses [m], gravity [m/s^2], gap of a contact, distance within which an
        edge is not ahead of another [m].
    tilt_rear, tilt_front
        Tilt of gravity towards an end that comes down, for the rise to spare [rad].
    zones
        Landings (k, 4): places of the front contact at which the robot lands, first and last x,
        lowest and highest z [m].
    edges
        Edges of the terrain that may hold an end as it comes down (k, 2) [m].
    treads, climbs, steep, on_flat
        As :func:`kaidan.contact.kernel.supports.find_supports` takes them, the last as its touch.
    slip
        How far beyond the spacing of grousers a slip is followed [m].
    grousers
        Cases of grousers on the belts, the worst and the best; none: nobody asks how they hold.
    poses, events, rotations, margins, found
        Scratch, see :func:`kaidan.contact.kernel.driver.drive`.
    supports, loads, unlike, like, counts, points, standing, friction, held
        Scratch of what grousers hold, see :mod:`kaidan.contact.kernel.holding`.
    ratings
        To be filled, a row a job: status; of one that arrives the largest required friction but
        where the trailing end leaves an edge as it lands, whether the belly touches (0, 1), and of
        rotations that follow at once the largest angle, the largest rocking [rad], the largest
        speed of an impact [m/s], the least rise to spare [m]; and the least margin of belts with
        grousers in the worst and in the best case [rad], infinite where nobody asks for it or more
        nosings than there is room for touch a flat.
    """
    for job in range(jobs.shape[0]):
        robot = int(jobs[job, JOB_ROBOT])
        first = 0
        if robot > 0:
            first = ends[robot - 1]
        body = bodies[first : ends[robot]]
        begin = 0
        if robot > 0:
            begin = flight_ends[robot - 1]
        a = jobs[job, JOB_ACCELERATION]
        status, n_pose, _, n_rotation = drive(
            ground, body, jobs[job, JOB_START], jobs[job, JOB_END], jobs[job, JOB_PHI], step, a, g,
            0.0, jobs[job, JOB_GYRATION], True, poses, events, rotations,
        )  # fmt: skip
        ratings[job, RATED_STATUS] = status
        if status != Status.OK:
            continue
        pose_margins(ground, body, poses, n_pose, a, g, touch, margins, found)
        mu = 0.0
        belly = 0.0
        for row in range(n_pose):
            belly = max(belly, margins[row, BELLY_TOUCHES])
            if margins[row, FRICTION] > mu or math.isnan(margins[row, FRICTION]):
                if comes_off(poses, row, zones):
                    continue
                mu = math.inf if math.isnan(margins[row, FRICTION]) else margins[row, FRICTION]
        ratings[job, RATED_FRICTION] = mu
        ratings[job, RATED_BELLY] = belly
        ratings[job, RATED_HELD] = math.inf
        ratings[job, RATED_HELD_BEST] = math.inf
        slots = 0
        if grousers.shape[0] > 0:
            slots = find_standing(
                ground, body, poses, n_pose, margins, a, g, treads, climbs, steep, on_flat,
                supports, loads, unlike, like, points,
            )  # fmt: skip
        if slots > 0:
            for row in range(n_pose):
                counts[row] = 0 if comes_off(poses, row, zones) else 1
            ratings[job, RATED_HELD] = least_held(
                poses, n_pose, climbs, slip, grousers, False, counts, slots, supports, loads, like,
                points, standing, friction, held,
            )  # fmt: skip
            ratings[job, RATED_HELD_BEST] = least_held(
                poses, n_pose, climbs, slip, grousers, True, counts, slots, supports, loads, like,
                points, standing, friction, held,
            )  # fmt: skip
        rate_rotations(
            ground, body, poses, n_pose, rotations, n_rotation, a, g, flats[robot], rough,
            tilt_rear, tilt_front, edges, flights[begin : flight_ends[robot]], found, ratings, job,
        )  # fmt: skip
