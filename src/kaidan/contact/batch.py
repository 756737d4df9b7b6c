"""Many traverses in one call, with what a sweep asks for."""

from __future__ import annotations

import math

import numpy as np

from kaidan.contact.compiling import entry
from kaidan.contact.course import drive, new_tables
from kaidan.contact.margins import flow_energy, new_margins, pose_margins
from kaidan.contact.settling import settle
from kaidan.contact.tables import FloatArray, FloatRow, IntArray

SUMMARY_COLUMNS = 14


@entry
def extremes(
    poses: FloatArray, n_pose: int, releases: FloatArray, n_release: int
) -> tuple[float, float, float, float]:
    """Largest and smallest inclination, largest turn of a release [rad], any with momentum."""
    top = -math.inf
    low = math.inf
    for row in range(n_pose):
        top = max(top, poses[row, 3])
        low = min(low, poses[row, 3])
    turn = 0.0
    momentum = 0.0
    for row in range(n_release):
        top = max(top, releases[row, 8])
        low = min(low, releases[row, 8])
        turn = max(turn, releases[row, 9])
        momentum = max(momentum, releases[row, 14])
    return top, low, turn, momentum


@entry
def worst_margins(margins: FloatArray, count: int) -> tuple[float, float, float, float]:
    """Largest required friction, smallest static stability and energy margin [m], belly (0, 1)."""
    mu = 0.0
    stable = math.inf
    energy = math.inf
    belly = 0.0
    for row in range(count):
        mu = max(mu, margins[row, 0])
        stable = min(stable, margins[row, 6], margins[row, 7])
        energy = min(energy, margins[row, 10])
        belly = max(belly, margins[row, 15])
    return mu, stable, energy, belly


def traverse_many(
    grounds: FloatArray,
    ground_ends: IntArray,
    bodies: FloatArray,
    body_ends: IntArray,
    jobs: FloatArray,
    step: float,
    g: float,
    touch: float,
    with_margins: bool,
    size: int,
) -> FloatArray:
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
    size
        Poses held at most.

    Returns
    -------
    ndarray (n, 14)
        status, poses, events, releases, largest and smallest inclination [rad], largest
        inclination above the reference [rad], largest turn of a release [rad], any release that
        topples with momentum (0, 1), x reached [m], then (NaN without margins) largest required
        friction, smallest static stability margin [m], smallest energy margin along the flow [m],
        belly touches.
    """
    poses, events, releases = new_tables(size)
    margins, found = new_margins(size)
    out = np.full((jobs.shape[0], SUMMARY_COLUMNS), math.nan)
    for job in range(jobs.shape[0]):
        terrain = int(jobs[job, 0])
        robot = int(jobs[job, 1])
        first = 0
        if terrain > 0:
            first = ground_ends[terrain - 1]
        ground = grounds[first : ground_ends[terrain]]
        first = 0
        if robot > 0:
            first = body_ends[robot - 1]
        body = bodies[first : body_ends[robot]]
        a = jobs[job, 5]
        status, n_pose, n_event, n_release = drive(
            ground, body, jobs[job, 2], jobs[job, 3], jobs[job, 4], step, a, g, jobs[job, 6],
            poses, events, releases,
        )  # fmt: skip
        out[job, 0] = status
        out[job, 1] = n_pose
        out[job, 2] = n_event
        out[job, 3] = n_release
        if n_pose == 0:
            continue
        top, low, turn, momentum = extremes(poses, n_pose, releases, n_release)
        out[job, 4] = top
        out[job, 5] = low
        out[job, 6] = top - jobs[job, 7]
        out[job, 7] = turn
        out[job, 8] = momentum
        out[job, 9] = poses[n_pose - 1, 1]
        if with_margins:
            pose_margins(ground, body, poses, n_pose, a, g, touch, margins, found)
            flow_energy(ground, body, poses, margins, np.arange(n_pose))
            out[job, 10:14] = worst_margins(margins, n_pose)
    return out


@entry
def settle_many(
    ground: FloatArray, body: FloatArray, x: FloatRow, phi: FloatRow, kappa: float
) -> FloatArray:
    """Settled poses at many x from given inclinations: (n, 5) found, z, phi, rear, front."""
    out = np.empty((x.shape[0], 5))
    for row in range(x.shape[0]):
        found, z, angle, rear, front = settle(ground, body, x[row], phi[row], kappa)
        out[row, 0] = 1.0 if found else 0.0
        out[row, 1] = z
        out[row, 2] = angle
        out[row, 3] = rear
        out[row, 4] = front
    return out
