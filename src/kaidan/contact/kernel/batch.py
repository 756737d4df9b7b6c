"""Many traverses in one call, with what a sweep asks for."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    BACK,
    BELLY_TOUCHES,
    END_PHI,
    ENERGY,
    FRICTION,
    FRONT,
    JOB_ACCELERATION,
    JOB_END,
    JOB_GYRATION,
    JOB_PHI,
    JOB_REFERENCE,
    JOB_ROBOT,
    JOB_START,
    JOB_TERRAIN,
    POSE_PHI,
    POSE_X,
    ROTATION_ANGLE,
    SETTLED_FOUND,
    SETTLED_FRONT,
    SETTLED_PHI,
    SETTLED_REAR,
    SETTLED_Z,
    SUMMARY_ANGLE,
    SUMMARY_BELLY,
    SUMMARY_ENERGY,
    SUMMARY_EVENTS,
    SUMMARY_EXTRA,
    SUMMARY_FRICTION,
    SUMMARY_HIGHEST,
    SUMMARY_LOWEST,
    SUMMARY_POSES,
    SUMMARY_REACHED,
    SUMMARY_ROTATIONS,
    SUMMARY_STABILITY,
    SUMMARY_STATUS,
    SUMMARY_TOPPLES,
    TOPPLES,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.driver import drive
from kaidan.contact.kernel.energy_margins import flow_energy
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.settling import settle
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    EventTable,
    FloatRow,
    GroundTable,
    IntArray,
    JobTable,
    MarginTable,
    PoseTable,
    RotationTable,
    SettledTable,
    SummaryTable,
)


def extremes(
    poses: PoseTable, n_pose: int, rotations: RotationTable, n_rotation: int
) -> tuple[float, float, float, float]:
    """Largest and smallest inclination, largest rotation [rad], any that topples with momentum."""
    top = -math.inf
    low = math.inf
    for row in range(n_pose):
        top = max(top, poses[row, POSE_PHI])
        low = min(low, poses[row, POSE_PHI])
    angle = 0.0
    momentum = 0.0
    for row in range(n_rotation):
        top = max(top, rotations[row, END_PHI])
        low = min(low, rotations[row, END_PHI])
        angle = max(angle, rotations[row, ROTATION_ANGLE])
        momentum = max(momentum, rotations[row, TOPPLES])
    return top, low, angle, momentum


def worst_margins(margins: MarginTable, count: int) -> tuple[float, float, float, float]:
    """Largest required friction, smallest static stability and energy margin [m], belly (0, 1)."""
    mu = 0.0
    stable = math.inf
    energy = math.inf
    belly = 0.0
    for row in range(count):
        mu = max(mu, margins[row, FRICTION])
        stable = min(stable, margins[row, BACK], margins[row, FRONT])
        energy = min(energy, margins[row, ENERGY])
        belly = max(belly, margins[row, BELLY_TOUCHES])
    return mu, stable, energy, belly


@entry
def traverse_many(
    grounds: GroundTable,
    ground_ends: IntArray,
    bodies: BodyTable,
    body_ends: IntArray,
    jobs: JobTable,
    step: float,
    g: float,
    touch: float,
    with_margins: bool,
    poses: PoseTable,
    events: EventTable,
    rotations: RotationTable,
    margins: MarginTable,
    found: ContactTable,
    rows: IntArray,
    summaries: SummaryTable,
) -> None:
    """Drive a list of jobs, each a terrain, a robot, a start and an end.

    Parameters
    ----------
    grounds, ground_ends
        Ground tables one below the other, and the row after the end of each.
    bodies, body_ends
        Body tables likewise.
    jobs
        (n, 8): number of the terrain, of the robot, x_start, x_end, phi_start, a, radius of
        gyration, reference inclination [rad].
    step, g, touch
        Arclength between poses [m], gravity [m/s^2], gap of a contact [m].
    with_margins
        Whether to work out every margin at every pose.
    poses, events, rotations, margins, found, rows
        Scratch, see :func:`kaidan.contact.kernel.driver.drive` and
        :func:`kaidan.contact.kernel.margins.pose_margins`; ``rows`` counts the poses from 0.
    summaries
        To be filled, a row a job: status, poses, events, rotations, largest and smallest
        inclination [rad], largest inclination above the reference [rad], largest rotation [rad],
        any rotation that topples with momentum (0, 1), x reached [m], then (untouched without
        margins) largest required friction, smallest static stability margin [m], smallest energy
        margin along the flow [m], belly touches.
    """
    for job in range(jobs.shape[0]):
        terrain = int(jobs[job, JOB_TERRAIN])
        robot = int(jobs[job, JOB_ROBOT])
        first = 0
        if terrain > 0:
            first = ground_ends[terrain - 1]
        ground = grounds[first : ground_ends[terrain]]
        first = 0
        if robot > 0:
            first = body_ends[robot - 1]
        body = bodies[first : body_ends[robot]]
        a = jobs[job, JOB_ACCELERATION]
        status, n_pose, n_event, n_rotation = drive(
            ground, body, jobs[job, JOB_START], jobs[job, JOB_END], jobs[job, JOB_PHI], step, a, g,
            0.0, jobs[job, JOB_GYRATION], True, poses, events, rotations,
        )  # fmt: skip
        summaries[job, SUMMARY_STATUS] = status
        summaries[job, SUMMARY_POSES] = n_pose
        summaries[job, SUMMARY_EVENTS] = n_event
        summaries[job, SUMMARY_ROTATIONS] = n_rotation
        if n_pose == 0:
            continue
        top, low, angle, momentum = extremes(poses, n_pose, rotations, n_rotation)
        summaries[job, SUMMARY_HIGHEST] = top
        summaries[job, SUMMARY_LOWEST] = low
        summaries[job, SUMMARY_EXTRA] = top - jobs[job, JOB_REFERENCE]
        summaries[job, SUMMARY_ANGLE] = angle
        summaries[job, SUMMARY_TOPPLES] = momentum
        summaries[job, SUMMARY_REACHED] = poses[n_pose - 1, POSE_X]
        if with_margins:
            pose_margins(ground, body, poses, n_pose, a, g, touch, margins, found)
            flow_energy(ground, body, poses, margins, rows[0:n_pose])
            mu, stable, energy, belly = worst_margins(margins, n_pose)
            summaries[job, SUMMARY_FRICTION] = mu
            summaries[job, SUMMARY_STABILITY] = stable
            summaries[job, SUMMARY_ENERGY] = energy
            summaries[job, SUMMARY_BELLY] = belly


@entry
def settle_many(
    ground: GroundTable, body: BodyTable, x: FloatRow, phi: FloatRow, kappa: float,
    settled: SettledTable,
) -> None:  # fmt: skip
    """Settled poses at many x from given inclinations: a row each, found, z, phi, rear, front."""
    for row in range(x.shape[0]):
        found, z, angle, rear, front = settle(ground, body, x[row], phi[row], kappa)
        settled[row, SETTLED_FOUND] = 1.0 if found else 0.0
        settled[row, SETTLED_Z] = z
        settled[row, SETTLED_PHI] = angle
        settled[row, SETTLED_REAR] = rear
        settled[row, SETTLED_FRONT] = front
