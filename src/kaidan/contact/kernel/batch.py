"""Many traverses in one call, with what a sweep asks for."""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.driver import drive
from kaidan.contact.kernel.energy_margins import work_out_energy
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.layout import (
    EventRow,
    Job,
    Journey,
    Log,
    Margin,
    Pose,
    Pull,
    RotationRow,
    Scene,
    Summary,
)
from kaidan.contact.memory import Row, Table, empty


def sum_up(poses: Table[Pose], rotations: Table[RotationRow], summary: Summary) -> None:
    """Write the extremes of inclinations and rotations."""
    top = -math.inf
    low = math.inf
    for k in range(len(poses)):
        top = max(top, poses[k].inclination)
        low = min(low, poses[k].inclination)
    angle = 0.0
    topples = False
    for k in range(len(rotations)):
        top = max(top, rotations[k].end.inclination)
        low = min(low, rotations[k].end.inclination)
        angle = max(angle, rotations[k].angle)
        topples = topples or rotations[k].topples_with_momentum
    summary.largest_inclination = top
    summary.smallest_inclination = low
    summary.largest_rotation = angle
    summary.topples_with_momentum = topples
    summary.x = poses[len(poses) - 1].x


def sum_up_margins(scene: Scene, poses: Table[Pose], pull: Pull, summary: Summary) -> None:
    """Write the largest friction, the smallest margins, and whether the belly touches."""
    margins = empty(Margin, len(poses))
    pose_margins(scene, poses, pull, margins)
    mu = 0.0
    stable = math.inf
    energy = math.inf
    belly = False
    for k in range(len(poses)):
        work_out_energy(scene, poses[k], margins[k])
        mu = max(mu, margins[k].required_friction)
        stable = min(stable, margins[k].back, margins[k].front)
        energy = min(energy, margins[k].energy)
        belly = belly or margins[k].belly_touches
    summary.required_friction = mu
    summary.static_margin = stable
    summary.energy = energy
    summary.belly_touches = belly


@entry
def traverse_many(
    scene: Scene, ground_ends: Row[int], body_ends: Row[int], jobs: Table[Job], step: float,
    g: float, size: int, with_margins: bool, summaries: Table[Summary],
) -> None:  # fmt: skip
    """Drive a list of jobs, each a terrain, a robot, a start and an end.

    Parameters
    ----------
    scene, ground_ends, body_ends
        Terrains and robots one below the other, and the row after the end of each.
    step, g, size
        Arclength between poses [m], gravity [m/s^2], poses at most.
    with_margins
        Whether to work out every margin at every pose.
    summaries
        To be filled, a row a job; without margins the last four stay as they are.
    """
    poses = empty(Pose, size)
    events = empty(EventRow, size)
    rotations = empty(RotationRow, size // 8 + 16)
    grounds = scene.ground
    bodies = scene.body
    for k in range(len(jobs)):
        job = jobs[k]
        summary = summaries[k]
        first = ground_ends[job.terrain - 1] if job.terrain > 0 else 0
        scene.ground = grounds[first : ground_ends[job.terrain]]
        first = body_ends[job.robot - 1] if job.robot > 0 else 0
        scene.body = bodies[first : body_ends[job.robot]]
        pull = Pull(job.acceleration, g)
        journey = Journey(job.x_start, job.x_end, job.inclination, step, job.gyration)
        log = Log(poses, events, rotations, True)
        status, n_pose, n_event, n_rotation = drive(scene, journey, pull, log)
        summary.status = status
        summary.poses = n_pose
        summary.events = n_event
        summary.rotations = n_rotation
        if n_pose > 0:
            sum_up(poses[0:n_pose], rotations[0:n_rotation], summary)
            summary.extra = summary.largest_inclination - job.reference
            if with_margins:
                sum_up_margins(scene, poses[0:n_pose], pull, summary)
