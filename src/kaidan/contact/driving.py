"""The contact model as functions of plain arrays: settle, traverse, grade, search.

Everything here takes a terrain (n, 2) and parts (m, 6) as :mod:`kaidan.contact.tables` describes
them, SI and radians, and returns arrays.  ``compile_kernel`` chooses between the plain and the
compiled kernel (see :mod:`kaidan.contact.compiling`); both give the same numbers to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.compiling import kernel_module
from kaidan.contact.tables import FloatArray, body_table, ground_table

GRAVITY = 9.80665
#: Arclength between poses [m]: beyond 5 mm grazing contacts could be passed over between two poses.
STEP = 5e-3
#: Gap up to which a feature counts as a contact [m].
TOUCH = 1e-9
#: How far below the flat a nosing may lie and still count as on it for grade one [m].
SLACK = 1e-6


class Status(IntEnum):
    """How a traverse ended."""

    OK = 0
    FELL_BACKWARD = 1
    FELL_FORWARD = 2
    STUCK = 3
    NOT_CONVERGED = 4
    TOO_LONG = 5
    NO_START = 6

    @property
    def message(self) -> str:
        """One sentence for people."""
        return _STATUS[self]


_STATUS = {
    Status.OK: "the robot arrived",
    Status.FELL_BACKWARD: "the robot fell over backward",
    Status.FELL_FORWARD: "the robot fell over forward",
    Status.STUCK: "the robot is stuck: wedged against a face, or rocking on the spot",
    Status.NOT_CONVERGED: "the solver did not converge; nothing is known beyond the last pose",
    Status.TOO_LONG: "the bound on poses or events was reached; nothing is known beyond the last",
    Status.NO_START: "no stable pose at the start",
}


class Event(IntEnum):
    """What happened along a traverse."""

    MADE = 0
    LOST = 1
    NOSE_DROPS = 2
    TIPS_BACK = 3
    CAUGHT = 4
    TAIL_RESTS = 5
    FELL_FORWARD = 6
    FELL_BACKWARD = 7
    ARRIVED = 8
    STUCK = 9
    RESETTLED = 10
    REACHED = 11
    """The flat has come upon a nosing in line with those that carry it (`kaidan.climb`)."""
    LEFT = 12
    """It has left one."""


class Settled(NamedTuple):
    """A stable pose: centroid height [m], inclination [rad], features of the two contacts."""

    found: bool
    z: float
    inclination: float
    rear: int
    front: int


class Demand(NamedTuple):
    """Required friction at one pose: coefficient, row, arclength [m], centroid [m], inclination."""

    mu: float
    row: int
    s: float
    x: float
    inclination: float


class GradeOne(NamedTuple):
    """No rotation at all: the worst margins to either side.

    ``holds`` is None if no contact was lost or made with the flat wholly on the flight;
    ``outside`` says that somewhere fewer than two contacts remain, where the criterion says
    nothing (and ``holds`` is False).  Margins are positive when safe.
    """

    holds: bool | None
    outside: bool
    back_margin: float
    back_margin_angle: float
    front_margin: float
    front_margin_angle: float
    table: FloatArray


@dataclass(frozen=True)
class Traverse:
    """Poses, events and releases of one traverse; columns as the kernel's docstrings say.

    Attributes
    ----------
    status
        How it ended.
    poses
        (n, 16), see :func:`kaidan.contact.course.drive`.
    events
        (k, 8).
    releases
        (r, 18).
    margins
        (n, 21), see :func:`kaidan.contact.margins.pose_margins`, or None.
    ground, body
        The tables the traverse was driven on, to read features by.
    """

    status: Status
    poses: FloatArray
    events: FloatArray
    releases: FloatArray
    margins: FloatArray | None
    ground: FloatArray
    body: FloatArray

    @property
    def s(self) -> FloatArray:
        """Arclength of the poses [m]."""
        return self.poses[:, 0]

    @property
    def x(self) -> FloatArray:
        """Centroid, along [m]."""
        return self.poses[:, 1]

    @property
    def z(self) -> FloatArray:
        """Centroid, up [m]."""
        return self.poses[:, 2]

    @property
    def inclination(self) -> FloatArray:
        """Inclination of the body, nose up positive [rad]."""
        return self.poses[:, 3]

    @property
    def largest_release(self) -> float:
        """Grade two: the largest turn of any release that ended on two contacts [rad]."""
        caught = self.releases[self.releases[:, 15] == 0.0]
        return float(caught[:, 9].max()) if len(caught) else 0.0

    @property
    def held_with_momentum(self) -> bool:
        """Grade three: it arrived and no release topples with the momentum gained."""
        return self.status is Status.OK and not bool((self.releases[:, 14] > 0).any())

    def row_before(self, s: float) -> int:
        """Row of the last pose of a line of poses that ends at an arclength [m].

        A release lies between two rows of one arclength, before it and after it.
        """
        rows = np.flatnonzero(np.abs(self.s - s) < 1e-9)
        if len(rows) == 0:
            return max(int(np.searchsorted(self.s, s, side="right")) - 1, 0)
        legs = self.poses[rows, 15]
        return int(rows[legs == legs.min()][-1])

    def first_beyond(self, mu: float) -> int | None:
        """Row of the first pose whose required friction exceeds mu; None if there is none.

        With friction mu the traverse as computed holds up to that pose: below the friction of a
        riser start, for example, the robot does not climb.

        Examples
        --------
        >>> step = [[-4, 0], [0, 0], [0, 0.1], [4, 0.1]]
        >>> robot = [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]
        >>> run = traverse(step, robot, -1.0, 0.5)
        >>> row = run.first_beyond(0.6)
        >>> round(float(run.x[row] + 0.196 + 0.06), 6)  # the nose meets the face
        0.0
        >>> run.first_beyond(5.0) is None
        True
        """
        if self.margins is None:
            raise ValueError("traverse: friction needs with_margins=True")
        rows = np.flatnonzero(~(self.margins[:, 0] <= mu))
        return int(rows[0]) if len(rows) else None

    def friction_demand(
        self, x_low: float | None = None, x_high: float | None = None
    ) -> dict[str, Demand]:
        """Largest required friction while entering, traversing and landing, and where.

        Parameters
        ----------
        x_low, x_high
            End of the lower landing and start of the upper one [m]; the first and the last corner
            of the terrain if not given. Entering: a contact on or before the one; landing: a
            contact on or after the other, and none before the one.

        Returns
        -------
        dict
            "enter", "traverse", "land" to the largest demand there; phases without a pose are left
            out.
        """
        if self.margins is None:
            raise ValueError("traverse: friction needs with_margins=True")
        low = float(self.ground[1, 0]) if x_low is None else x_low
        high = float(self.ground[-2, 0]) if x_high is None else x_high
        edge = 1e-9  # m, rounding of a corner's coordinate
        enters = self.poses[:, 6] <= low + edge
        lands = ~enters & (self.poses[:, 8] >= high - edge)
        phases = {"enter": enters, "traverse": ~enters & ~lands, "land": lands}
        demands = {}
        for phase, rows in phases.items():
            if rows.any():
                row = int(np.where(rows, self.margins[:, 0], -1.0).argmax())
                q = self.poses[row]
                demands[phase] = Demand(
                    float(self.margins[row, 0]), row, float(q[0]), float(q[1]), float(q[3])
                )
        return demands

    def energy(self, rows: ArrayLike, *, compile_kernel: bool | None = None) -> FloatArray:
        """Energy margin along the flow at some poses.

        Parameters
        ----------
        rows
            Shape (k,): rows of the poses.
        compile_kernel
            See :func:`kaidan.contact.compiling.kernel_module`.

        Returns
        -------
        ndarray (k, 2)
            Rise of the centroid [m], the smaller of both sides; that side, +1 back, -1 front.
        """
        if self.margins is None:
            raise ValueError("traverse: energy needs with_margins=True")
        wanted = np.atleast_1d(np.asarray(rows, dtype=np.int64))
        missing = wanted[np.isnan(self.margins[wanted, 10])]
        if len(missing):
            judge = kernel_module("margins", compile_kernel=compile_kernel)
            judge.flow_energy(self.ground, self.body, self.poses, self.margins, missing)
        return self.margins[wanted, 10:12]

    def largest_inclination(self) -> float:
        """Largest inclination reached, ends of releases included [rad]."""
        return float(max(self.poses[:, 3].max(), *self.releases[:, 8], -math.inf))


def settle(
    terrain: ArrayLike,
    parts: ArrayLike,
    x: float,
    inclination: float = 0.0,
    *,
    kinds: ArrayLike | None = None,
    compile_kernel: bool | None = None,
) -> Settled:
    """Stable pose at centroid x when let go from an inclination.

    Examples
    --------
    >>> pose = settle([[0, 0], [4, 0]], [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]], 2.0, 0.1)
    >>> round(pose.z, 6), abs(round(pose.inclination, 12))
    (0.071, 0.0)
    """
    kernel = kernel_module("settling", compile_kernel=compile_kernel)
    found, z, angle, rear, front = kernel.settle(
        ground_table(terrain), body_table(parts, kinds), x, inclination, 0.0
    )
    return Settled(bool(found), float(z), float(angle), int(rear), int(front))


def traverse(
    terrain: ArrayLike,
    parts: ArrayLike,
    x_start: float,
    x_end: float,
    *,
    kinds: ArrayLike | None = None,
    inclination: float = 0.0,
    acceleration: float = 0.0,
    gyration: float = 0.2,
    gravity: float = GRAVITY,
    step: float = STEP,
    with_margins: bool = True,
    with_energy: bool = True,
    compile_kernel: bool | None = None,
) -> Traverse:
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
        Inclination from which the robot is let go at the start [rad].
    acceleration
        Along the path of the centroid, up the stairs positive [m/s^2].
    gyration
        Radius of gyration about the centroid [m], for grade three.
    gravity
        [m/s^2]
    step
        Arclength between poses [m].
    with_margins
        Work out forces and margins at every pose.
    with_energy
        The energy margin along the flow too; else :meth:`Traverse.energy` has it for single poses.
    compile_kernel
        See :func:`kaidan.contact.compiling.kernel_module`.

    Returns
    -------
    Traverse
        Always; a robot that cannot climb is a status.

    Raises
    ------
    ValueError
        If an array is malformed or ``x_end`` is not ahead of ``x_start``.
    """
    if not x_end > x_start:
        raise ValueError(f"traverse: x_end {x_end} must be ahead of x_start {x_start}")
    if not step > 0:
        raise ValueError(f"traverse: step {step} must be positive")
    ground = ground_table(terrain)
    body = body_table(parts, kinds)
    driver = kernel_module("course", compile_kernel=compile_kernel)
    size = int(min(4.0 * (x_end - x_start) / step + 64 * len(ground) + 4000, 400_000))
    poses, events, releases = driver.new_tables(size)
    status, n_pose, n_event, n_release = driver.drive(
        ground, body, x_start, x_end, inclination, step, acceleration, gravity, gyration,
        poses, events, releases,
    )  # fmt: skip
    margins = None
    if with_margins:
        judge = kernel_module("margins", compile_kernel=compile_kernel)
        margins, found = judge.new_margins(n_pose)
        judge.pose_margins(
            ground, body, poses, n_pose, acceleration, gravity, TOUCH, margins, found
        )
        if with_energy:
            judge.flow_energy(ground, body, poses, margins, np.arange(n_pose))
    return Traverse(
        Status(status),
        poses[:n_pose].copy(),
        events[:n_event].copy(),
        releases[:n_release].copy(),
        margins,
        ground,
        body,
    )


def grade_one(
    terrain: ArrayLike,
    parts: ArrayLike,
    *,
    kinds: ArrayLike | None = None,
    acceleration: float = 0.0,
    gravity: float = GRAVITY,
    slack: float = SLACK,
    x_start: float = -math.inf,
    x_end: float = math.inf,
    compile_kernel: bool | None = None,
) -> GradeOne:
    """Apply the paper's criterion to any profile; see :mod:`kaidan.contact.no_rotation`.

    Parameters
    ----------
    slack
        How far below the flat a nosing may lie and still count as on it [m]: rounding only by
        default, some millimetres for measured stairs.
    """
    kernel = kernel_module("no_rotation", compile_kernel=compile_kernel)
    ground = ground_table(terrain)
    table = np.zeros((2 * len(ground), kernel.CRITERION_COLUMNS))
    rows = kernel.no_rotation(
        ground, body_table(parts, kinds), x_start, x_end, acceleration, gravity, slack, table
    )
    table = table[:rows]
    if rows == 0:
        return GradeOne(None, False, math.nan, math.nan, math.nan, math.nan, table)
    outside = bool((table[:, 7] < 2).any())
    worst = []
    for side in (1.0, -1.0):
        rows_of_side = table[(table[:, 0] == side) & (table[:, 7] >= 2)]
        worst += [
            float(rows_of_side[:, 5].min()) if len(rows_of_side) else math.nan,
            float(rows_of_side[:, 6].min()) if len(rows_of_side) else math.nan,
        ]
    holds = not outside and not bool((table[:, 5] < 0).any())
    return GradeOne(holds, outside, worst[0], worst[1], worst[2], worst[3], table)


def traverse_many(
    terrains: Sequence[ArrayLike],
    robots: Sequence[ArrayLike],
    jobs: ArrayLike,
    *,
    kinds: Sequence[ArrayLike] | None = None,
    gravity: float = GRAVITY,
    step: float = STEP,
    with_margins: bool = False,
    size: int = 20_000,
    compile_kernel: bool | None = None,
) -> FloatArray:
    """Many traverses in one call: columns in :func:`kaidan.contact.batch.traverse_many`.

    ``jobs`` is (n, 8): terrain number, robot number, x_start, x_end, inclination at the start,
    acceleration, radius of gyration, reference inclination.
    """
    kernel = kernel_module("batch", compile_kernel=compile_kernel)
    grounds = [ground_table(t) for t in terrains]
    bodies = [body_table(r, None if kinds is None else kinds[k]) for k, r in enumerate(robots)]
    result: FloatArray = kernel.traverse_many(
        np.concatenate(grounds),
        np.cumsum([len(g) for g in grounds]),
        np.concatenate(bodies),
        np.cumsum([len(b) for b in bodies]),
        np.ascontiguousarray(jobs, dtype=np.float64),
        step, gravity, TOUCH, with_margins, size,
    )  # fmt: skip
    return result


def steepest_flight(
    flight: Callable[[float], tuple[ArrayLike, float, float]],
    parts: ArrayLike,
    *,
    largest_extra: float = math.radians(45.0),
    low: float = 0.0,
    high: float = math.radians(85.0),
    tolerance: float = 1e-5,
    step: float = 1e-3,
    compile_kernel: bool | None = None,
) -> float:
    """Grade two: steepest flight that is climbed with a bounded extra inclination [rad].

    Parameters
    ----------
    flight
        Angle [rad] to (terrain, x_start, x_end).
    parts
        Robot.
    largest_extra
        Bound on inclination minus angle of the flight [rad].
    low, high
        Angles known to hold and not to hold; bisected, which finds one limit if there are several.

    Returns
    -------
    float
        NaN if even ``low`` is not climbed.
    """

    def holds(angle: float) -> bool:
        terrain, x_start, x_end = flight(angle)
        run = traverse(
            terrain, parts, x_start, x_end,
            step=step, with_margins=False, compile_kernel=compile_kernel,
        )  # fmt: skip
        return run.status is Status.OK and run.largest_inclination() - angle <= largest_extra

    if not holds(low):
        return math.nan
    while high - low > tolerance:
        mid = 0.5 * (low + high)
        if holds(mid):
            low = mid
        else:
            high = mid
    return low
