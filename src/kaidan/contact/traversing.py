"""Driving from one place to another: one traverse, or many in one call."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.codes import Status
from kaidan.contact.door import stacked, table_of, unknown, zeros
from kaidan.contact.kernel.trigonometry import cos, tan
from kaidan.contact.layout import Job, Journey, Margin, Pull, Summary
from kaidan.contact.path import Path
from kaidan.contact.records import Body, Events, Ground, Margins, Poses, Rotations, Summaries
from kaidan.contact.remembered import body_of, ground_of
from kaidan.contact.scratch import most_poses, path_scratch
from kaidan.contact.switch import kernel
from kaidan.contact.tables import body_table, ground_table
from kaidan.mechanics import STANDARD_GRAVITY

#: Arclength between poses [m]: beyond 5 mm grazing contacts could be passed over between two poses.
STEP = 5e-3
#: Time of the plain kernel for a pose, and for each point of the ground under the robot [s].
A_POSE, A_POINT = 8e-5, 3.5e-5


def plain_seconds(
    terrain: ArrayLike, parts: ArrayLike, x_start: float, x_end: float, step: float = STEP
) -> float:
    """How long the plain kernel takes for a traverse, about [s].

    Examples
    --------
    >>> round(plain_seconds([[0, 0], [100, 0]], [[-0.3, 0, 0.1, 0.3, 0, 0.1]], 10.0, 20.0), 3)
    0.16
    """
    points, discs = np.asarray(terrain, dtype=np.float64), np.asarray(parts, dtype=np.float64)
    x = points[:, 0]
    driven = (x[1:] >= x_start) & (x[:-1] <= x_end)
    heights = float(np.abs(np.diff(points[:, 1]))[driven].sum())
    corners = np.count_nonzero((x >= x_start) & (x <= x_end))
    middle, r = discs[:, [0, 3]], discs[:, [2, 5]]
    under = float((middle + r).max() - (middle - r).min()) / (x_end - x_start)
    poses = (x_end - x_start + heights) / step
    return float(poses * (A_POSE + A_POINT * corners * min(1.0, under)))


def traverse(
    terrain: ArrayLike,
    parts: ArrayLike,
    x_start: float,
    x_end: float,
    *,
    kinds: ArrayLike | None = None,
    inclination: float = 0.0,
    acceleration: float = 0.0,
    tilt: float = 0.0,
    gyration: float = 0.2,
    gravity: float = STANDARD_GRAVITY,
    step: float = STEP,
    with_margins: bool = True,
    with_energy: bool = True,
) -> Path:
    """Drive the robot from one place to another, uphill end first in +x.

    Parameters
    ----------
    terrain
        Points (n, 2) [m].
    parts, kinds
        Robot underside (m, 6) [m] in the body frame at the centroid; 0 track, 1 flipper, 2 belly.
    x_start, x_end
        Centroid at start and end [m].
    inclination
        Inclination from which the robot settles at the start [rad].
    acceleration
        Along the path of the centroid, up the stairs positive [m/s^2].
    tilt
        Angle by which gravity is tilted backward [rad], without margins.
    gyration
        Radius of gyration about the centroid [m], for grade three.
    gravity
        [m/s^2]
    step
        Arclength between poses [m].
    with_margins
        Work out forces and margins at every pose.
    with_energy
        The energy margin along the flow too; else :meth:`Path.energy` has it for single poses.

    Returns
    -------
    Path
        Always; a robot that cannot climb is a status.

    Raises
    ------
    ValueError
        If an array is malformed or ``x_end`` is not ahead of ``x_start``.
    """
    if not x_end > x_start:
        raise ValueError(f"traverse: x_end {x_end} must be ahead of x_start {x_start}")
    if tilt and with_margins:
        raise ValueError("traverse: margins are those of upright gravity")
    if not step > 0:
        raise ValueError(f"traverse: step {step} must be positive")
    ground, body = scene = ground_of(terrain), body_of(parts, kinds)
    entries = kernel()
    scratch = path_scratch(most_poses(x_end - x_start, step, len(ground)))
    pull = Pull(acceleration, gravity * cos(tilt), tan(tilt))
    status, *counts = entries.drive(
        scene, Journey(x_start, x_end, inclination, step, gyration), pull, (*scratch, True)
    )
    poses, events, rotations = (
        stacked([table[:count]]) for table, count in zip(scratch, counts, strict=True)
    )
    margins = None
    if with_margins:
        margins = zeros(Margin, len(poses))
        entries.pose_margins(scene, poses, pull, margins)
        if with_energy:
            entries.flow_energy(scene, poses, margins, np.arange(len(poses)))
    return Path(
        Status(status),
        Poses(poses),
        Events(events),
        Rotations(rotations),
        None if margins is None else Margins(margins),
        Ground(ground),
        Body(body),
    )


def arrives(
    terrain: ArrayLike,
    parts: ArrayLike,
    x_start: float,
    x_end: float,
    *,
    kinds: ArrayLike | None = None,
    inclination: float = 0.0,
    acceleration: float = 0.0,
    tilt: float = 0.0,
    gyration: float = 0.2,
    step: float = STEP,
) -> bool:
    """Whether the robot gets from one place to another; parameters as for :func:`traverse`.

    Examples
    --------
    >>> floor, robot = [[-4, 0], [4, 0]], [[-0.3, 0, 0.06, 0.2, 0, 0.06]]
    >>> [arrives(floor, robot, 0.0, 0.5, tilt=tilt) for tilt in (0.0, 1.4)]
    [True, False]
    """
    ground, body = ground_of(terrain), body_of(parts, kinds)
    scratch = path_scratch(most_poses(x_end - x_start, step, len(ground)))
    pull = Pull(acceleration, STANDARD_GRAVITY * cos(tilt), tan(tilt))
    status, *_ = kernel().drive(
        (ground, body), Journey(x_start, x_end, inclination, step, gyration), pull,
        (*scratch, False),
    )  # fmt: skip
    return bool(status == Status.OK)


def traverse_many(
    terrains: Sequence[ArrayLike],
    robots: Sequence[ArrayLike],
    jobs: Sequence[Job],
    *,
    kinds: Sequence[ArrayLike] | None = None,
    gravity: float = STANDARD_GRAVITY,
    step: float = STEP,
    with_margins: bool = False,
    size: int = 20_000,
) -> Summaries:
    """Many traverses in one call: a row of the summary for each job."""
    grounds = [ground_table(t) for t in terrains]
    bodies = [body_table(r, None if kinds is None else kinds[k]) for k, r in enumerate(robots)]
    summaries = unknown(Summary, len(jobs))
    kernel().traverse_many(
        (stacked(grounds), stacked(bodies)),
        np.cumsum([len(each) for each in grounds]),
        np.cumsum([len(each) for each in bodies]),
        table_of(Job, jobs), step, gravity, size, with_margins, summaries,
    )  # fmt: skip
    return Summaries(summaries)
