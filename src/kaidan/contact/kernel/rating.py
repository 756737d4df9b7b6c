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
from kaidan.contact.entries import entry
from kaidan.contact.kernel.driver import drive
from kaidan.contact.kernel.holding import held_on_grousers
from kaidan.contact.kernel.impact import impact_speed
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.phases import in_zone
from kaidan.contact.kernel.sampling import leaves_edge
from kaidan.contact.kernel.trigonometry import atan2, cos, sin
from kaidan.contact.layout import (
    Belts,
    Course,
    EventRow,
    Flight,
    Job,
    Journey,
    Log,
    Margin,
    Pose,
    Pull,
    Rating,
    RotationRow,
    Scene,
    Zone,
)
from kaidan.contact.memory import Row, Table, empty

#: Way of the centroid between two rotations that follow at once, over the flat's length [1].
FOLLOWS = 0.01


@entry
def row_before(poses: Table[Pose], s: float) -> int:
    """Row of the last pose of the line of poses that ends at an arclength.

    s: where a rotation begins [m]: between two rows of one arclength, before it and after it.

    row: where no pose is the last one before.
    """
    low = 0
    high = len(poses)
    while low < high:
        middle = (low + high) // 2
        if poses[middle].s < s - 1e-9:
            low = middle + 1
        else:
            high = middle
    best = -1
    row = low
    while row < len(poses) and poses[row].s <= s + 1e-9:
        if best < 0 or poses[row].leg <= poses[best].leg:
            best = row
        row += 1
    if best >= 0:
        return best
    return low - 1 if low > 0 else 0


def comes_off(pose: Pose, zones: Table[Zone]) -> bool:
    """Whether the trailing end leaves an edge on the way down, the front contact on a landing."""
    return leaves_edge(pose) and in_zone(zones, pose.front.x, pose.front.z)


def beyond_the_edge(row: RotationRow, course: Course, flat: float) -> float:
    """How far a rotation goes below the line from its pivot to the next edge [rad]."""
    line = -math.inf
    for k in range(len(course.edges)):
        x = course.edges[k].x - row.pivot_x
        z = course.edges[k].z - row.pivot_z
        if x > course.rough and math.sqrt(x * x + z * z) <= flat:
            line = max(line, atan2(z, x))
    if line == -math.inf:
        return 0.0
    return max(min(line, row.start.inclination) - row.end.inclination, 0.0)


def flight_at(poses: Table[Pose], row: int, flights: Table[Flight]) -> int:
    """Flight on which both contacts of a pose and of the next stand; -1: none."""
    rear = min(poses[row].rear.x, poses[row + 1].rear.x)
    front = max(poses[row].front.x, poses[row + 1].front.x)
    for k in range(len(flights)):
        if flights[k].begin <= rear and front <= flights[k].end:
            return k
    return -1


def rocking(turn: float, before: float, after: float, theta_s: float) -> float:
    """What of a turn counts as rocking on a flight, see :mod:`kaidan.mechanics.rocking` [rad]."""
    return min(turn, max(abs(before - theta_s), abs(after - theta_s)))


def rate_rotations(
    scene: Scene, poses: Table[Pose], rotations: Table[RotationRow], pull: Pull, flat: float,
    course: Course, flights: Table[Flight], rating: Rating,
) -> None:  # fmt: skip
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
    for k in range(len(rotations)):
        row = rotations[k]
        if k > 0:
            w_x = row.start.x - rotations[k - 1].end.x
            w_z = row.start.z - rotations[k - 1].end.z
            if math.sqrt(w_x * w_x + w_z * w_z) > FOLLOWS * flat:
                angle = 0.0
                avoids = 0.0
                fallen = 0.0
                moved = 0.0
                lowest = math.inf
                highest = -math.inf
                begins = True
        at = row_before(poses, row.s)
        psi = poses[at].path_direction
        ahead = pull.a * cos(psi)
        up = pull.g + pull.a * sin(psi)
        size = math.sqrt(ahead * ahead + up * up)
        d_x = row.start.x - row.end.x
        d_z = row.start.z - row.end.z
        fallen += (up * d_z + ahead * d_x) / size
        moved -= (up * d_x - ahead * d_z) / size
        angle += row.angle
        avoids += beyond_the_edge(row, course, flat) if row.sense < 0.0 else row.angle
        lowest = min(lowest, row.start.inclination, row.end.inclination)
        highest = max(highest, row.start.inclination, row.end.inclination)
        stands = -1
        if row.outcome == RotationOutcome.ARRESTED:
            stands = flight_at(poses, at, flights)
            speed = max(speed, impact_speed(scene, rotations, k))
        if begins:
            flight = stands
        elif stands != flight:
            flight = -1
        begins = False
        rise = row.barrier / size - fallen
        way = moved + row.barrier_across
        if row.sense < 0.0:
            rise = cos(course.tilt_front) * rise - sin(course.tilt_front) * way
        else:
            rise = cos(course.tilt_rear) * rise + sin(course.tilt_rear) * way
        spare = min(spare, rise)
        most = max(most, angle)
        if flight < 0:
            rocks = max(rocks, avoids)
        else:
            rocks = max(rocks, rocking(avoids, lowest, highest, flights[flight].slope))
    rating.largest_rotation = most
    rating.rocking = rocks
    rating.impact_speed = speed
    rating.spare = spare


def rate_poses(
    scene: Scene, poses: Table[Pose], pull: Pull, course: Course, belts: Belts, rating: Rating
) -> None:
    """Write the largest friction, whether the belly touches, and how grousers hold."""
    margins = empty(Margin, len(poses))
    counts = empty(bool, len(poses))
    pose_margins(scene, poses, pull, margins)
    mu = 0.0
    belly = False
    for row in range(len(poses)):
        pose = poses[row]
        counts[row] = not comes_off(pose, course.zones)
        belly = belly or margins[row].belly_touches
        friction = margins[row].required_friction
        if counts[row] and (friction > mu or math.isnan(friction)):
            mu = math.inf if math.isnan(friction) else friction
    rating.required_friction = mu
    rating.belly_touches = belly
    rating.held = math.inf
    rating.held_at_best = math.inf
    if len(belts.grousers) > 0:
        rating.held, rating.held_at_best = held_on_grousers(
            scene, poses, margins, pull, belts, counts
        )


@entry
def rate_many(
    scene: Scene, ends: Row[int], flats: Row[float], flight_ends: Row[int], flights: Table[Flight],
    jobs: Table[Job], size: int, g: float, course: Course, belts: Belts, ratings: Table[Rating],
) -> None:  # fmt: skip
    """Drive a list of jobs over one terrain and rate each.

    Parameters
    ----------
    scene, ends, flats
        Terrain, robots one below the other, the row after the end of each, length of its flat [m].
    flight_ends, flights
        Flights as each robot sees them one below the other, the row after those of each.
    jobs
        The terrain and the reference inclination play no part.
    size
        Poses at most.
    ratings
        To be filled, a row a job; of one that does not arrive its status.
    """
    poses = empty(Pose, size)
    events = empty(EventRow, size)
    rotations = empty(RotationRow, size // 8 + 16)
    bodies = scene.body
    for k in range(len(jobs)):
        job = jobs[k]
        rating = ratings[k]
        before = job.robot - 1
        scene.body = bodies[ends[before] if before >= 0 else 0 : ends[job.robot]]
        begin = flight_ends[before] if before >= 0 else 0
        pull = Pull(job.acceleration, g)
        journey = Journey(job.x_start, job.x_end, job.inclination, course.step, job.gyration)
        log = Log(poses, events, rotations, True)
        status, n_pose, _, n_rotation = drive(scene, journey, pull, log)
        rating.status = status
        if status != Status.OK:
            continue
        rate_poses(scene, poses[0:n_pose], pull, course, belts, rating)
        rate_rotations(
            scene, poses[0:n_pose], rotations[0:n_rotation], pull, flats[job.robot], course,
            flights[begin : flight_ends[job.robot]], rating,
        )  # fmt: skip
