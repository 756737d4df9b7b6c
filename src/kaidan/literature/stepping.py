"""A robot driven in small steps while its flippers turn: the contact model, started anew each turn.

Between two turns the path is one ``kaidan.contact.traverse``, so that flippers that never turn give
just that traverse. When they turn, the centroid moves within the robot, the robot stays where it
is, and it is let down again from the inclination that it had.

::

    turn the flippers      drive on          turn            drive on
    --------|----------------------|----------------|------------------->
            one traverse             the next one       and so on
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import Status
from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Posture, Robot
from kaidan.terrain.profile import Profile

Array = NDArray[np.float64]

RANGE = (math.radians(-60.0), math.radians(120.0))
"""Joint range where nobody states any [rad]: from pushed down to folded back a little."""
STEP = 0.01
"""Arclength between poses of the traverses [m]; events are located whatever it is."""
FACE = math.radians(80.0)
"""Angle of a contact's normal from the vertical beyond which an end climbs a face [rad]: there
letting down anew would drop it, so the flippers are held."""
_CLEARANCE = 0.05
_JUMP = 5e-3


class Angles(NamedTuple):
    """Angles of the flippers, raising the tip positive [rad]; None for a pair that is not there."""

    front: float | None
    rear: float | None


@dataclass(frozen=True, kw_only=True)
class Course:
    """What does not change along a path: robot, terrain, start and end; build it with `of`."""

    robot: Robot
    ground: Array
    """Terrain with its landings continued, shape (n, 2) [m]."""
    x_start: float
    x_end: float
    """Centroid at the start and at the end [m]."""
    first: Angles
    """Angles at the start [rad]."""

    @classmethod
    def of(
        cls,
        robot: Robot,
        profile: Profile,
        first: Posture | None = None,
    ) -> Self:
        """Course from landing to landing, as ``kaidan.traversal.traverse`` drives it.

        Parameters
        ----------
        robot : Robot
            Robot, nose first.
        profile : Profile
            Terrain; give ``profile.reflected()`` for the way back.
        first : Posture, optional
            Flippers at the start; stowed without one.

        Returns
        -------
        Course

        Raises
        ------
        InputError
            A posture for flippers that the robot does not have.
        """
        angles = angles_of(robot, first or Posture())
        body = outline_of(robot, angles)
        back, ahead = body.reach
        room = back + ahead + 1.0
        ends = profile.points[[0, -1]] + np.array([[-room, 0.0], [room, 0.0]])
        start, end = float(profile.points[0, 0]), float(profile.points[-1, 0])
        if len(profile.nosings):
            start, end = float(profile.nosings[0, 0]), float(profile.nosings[-1, 0])
            low = float(profile.points[-1, 1]) + 1e-9
            end = max(end, float(profile.points[profile.points[:, 1] > low, 0].max(initial=end)))
        return cls(
            robot=robot,
            ground=np.vstack([ends[0], profile.points, ends[1]]),
            x_start=start - ahead - _CLEARANCE,
            x_end=end + back + _CLEARANCE,
            first=angles,
        )


@dataclass(frozen=True, kw_only=True)
class Stand:
    """The robot at one place of its way, at rest on two contacts."""

    angles: Angles
    run: contact.Path
    """Traverse with these angles, from where they were last changed."""
    row: int
    """Pose of it; -1 without any."""
    until: float
    """Where it was driven to [m]."""
    begun: tuple[float, float]
    """Centroid and inclination from which it was let down [m, rad]."""
    rotation: float
    """Largest rotation since the stand before this one that no contact prevented [rad]."""
    status: Status = Status.OK
    """OK as long as the robot stands."""

    @property
    def x(self) -> float:
        """Centroid, along [m]."""
        return float(self.run.x[self.row])

    @property
    def z(self) -> float:
        """Centroid, up [m]."""
        return float(self.run.z[self.row])

    @property
    def inclination(self) -> float:
        """Inclination, nose up positive [rad]."""
        return float(self.run.inclination[self.row])

    @property
    def energy_margin(self) -> float:
        """Normalised energy stability margin of this pose [m]."""
        return self._least_energy(self.row)

    def _margins(self, first: int) -> contact.Margins:
        """Margins from a row of the run to this one."""
        return self.run.margins_of(slice(first, self.row + 1))

    def _least_energy(self, first: int) -> float:
        """Smallest normalised energy stability margin from a row of the run to this one [m]."""
        margins = self._margins(first)
        return float(np.minimum(margins.back_rise, margins.front_rise).min())

    @property
    def contacts(self) -> Array:
        """Points of the rear and the front contact: x, z, x, z [m]."""
        poses = self.run.poses
        return np.concatenate([poses.rear_point[self.row], poses.front_point[self.row]])

    @property
    def on_a_face(self) -> bool:
        """Whether an end of the robot climbs the face of a riser."""
        return bool(self._margins(self.row).steepest_face[-1] > FACE)

    def least_margin(self, since: "Stand | None" = None) -> float:
        """Smallest normalised energy stability margin here, or from another stand of the run [m].

        0 if the robot lost its balance in between and was arrested, minus infinity if it fell.
        """
        if self.status is not Status.OK:
            return -math.inf
        first = since.row if since is not None and since.begun == self.begun else self.row
        least = self._least_energy(first)
        return min(least, 0.0) if self.rotation > LOSES_BALANCE else least


LOSES_BALANCE = math.radians(0.5)
"""Rotation that counts as losing balance [rad]: a robot sways by less on its own belts."""


def angles_of(robot: Robot, posture: Posture) -> Angles:
    """Angles of a posture, words turned into numbers."""
    found: list[float | None] = []
    for end in ("front", "rear"):
        requested, pair = getattr(posture, end), getattr(robot, f"{end}_flippers")
        if pair is None:
            if requested is not None:
                raise InputError(f"robot {robot.name!r} has no {end} flippers")
            found.append(None)
        elif requested is None:
            found.append(pair.stowed_angle)
        else:
            found.append(pair.flat_angle if isinstance(requested, str) else float(requested))
    return Angles(*found)


def outline_of(robot: Robot, angles: Angles) -> Outline:
    """Outline of a robot with its flippers at these angles."""
    return Outline.of(robot, Posture(front=angles.front, rear=angles.rear))


def towards(
    now: float | None,
    requested: float | None,
    pair: FlipperPair | None,
    most: float,
    limits: tuple[float, float],
) -> float | None:
    """Angle after turning from one angle towards another, within speed and joint range [rad].

    An angle that lies outside the joint range stays until something inside it is requested.

    Examples
    --------
    >>> pair = FlipperPair(length=0.3, root_radius=0.08, tip_radius=0.03, pivot_height=0.08)
    >>> towards(0.0, 1.0, pair, 0.25, (-1.0, 0.5))
    0.25
    >>> towards(0.4, 1.0, pair, 0.25, (-1.0, 0.5))
    0.5
    """
    if pair is None or now is None or requested is None:
        return now
    goal = min(max(requested, limits[0]), limits[1])
    return now + min(max(goal - now, -most), most)


def begin(course: Course, step: float = STEP) -> Stand:
    """Robot at the start of its course."""
    return _settled(course, course.first, course.x_start, 0.0, course.x_start + 0.2, step)


def ahead(course: Course, stand: Stand, distance: float, step: float = STEP) -> Stand:
    """Robot a little farther along, or as far as it got.

    Parameters
    ----------
    course : Course
        The course.
    stand : Stand
        Where it stands.
    distance : float
        Arclength of the centroid's path [m].
    step : float
        Arclength between poses [m].

    Returns
    -------
    Stand
        At the end of the course its last pose; of a fall the last pose before it, and its status.
    """
    if stand.status is not Status.OK:
        return stand
    begin_s = float(stand.run.s[stand.row])
    requested = begin_s + distance
    while (
        stand.run.status is Status.OK
        and stand.until < course.x_end
        and stand.run.s[-1] < requested + 2 * step
    ):
        until = min(2 * stand.until - stand.begun[0], course.x_end)
        run = _drive(course, stand.angles, *stand.begun, until, step)
        stand = replace(stand, run=run, until=until)
    run = stand.run
    row = int(np.searchsorted(run.s, requested - 1e-9))
    status = Status.OK
    if row >= len(run.s):
        row, status = len(run.s) - 1, run.status
    row = _past(run, row)
    turns = run.rotations[(run.rotations.s > begin_s) & (run.rotations.s <= run.s[row])]
    return replace(
        stand, row=row, status=status, rotation=float(turns.angle.max(initial=0.0))
    )  # fmt: skip


def turned(course: Course, stand: Stand, angles: Angles, step: float = STEP) -> Stand:
    """Robot at the same place after its flippers have turned.

    Parameters
    ----------
    course : Course
        The course.
    stand : Stand
        Where it stands.
    angles : Angles
        New angles [rad].
    step : float
        Arclength between poses [m].

    Returns
    -------
    Stand
        The same one if nothing turns, or if an end climbs a face: there the flippers are held.
        With a status that is not OK if no pose holds the robot.
    """
    if stand.status is not Status.OK or angles == stand.angles or stand.on_a_face:
        return stand
    old, new = (outline_of(course.robot, each).stance for each in (stand.angles, angles))
    # the centroid within the robot, from the front end of the main track
    d_x = old.com_from_front - old.front_extension - new.com_from_front + new.front_extension
    d_z = new.com_height - old.com_height
    c, s = math.cos(stand.inclination), math.sin(stand.inclination)
    x, z = stand.x + c * d_x - s * d_z, stand.z + s * d_x + c * d_z
    settled = _settled(course, angles, x, stand.inclination, x + 4 * step, step)
    if settled.row < 0:
        return replace(stand, status=settled.status)
    pairs = (course.robot.front_flippers, course.robot.rear_flippers)
    turns = [
        (abs(one - two), pair.length + pair.tip_radius)
        for one, two, pair in zip(stand.angles, angles, pairs, strict=True)
        if one is not None and two is not None and pair is not None
    ]
    if float(settled.run.z[0]) > z + sum(turn * reach for turn, reach in turns) + _JUMP:
        return stand  # let down beside a riser it would stand on it: it leans against the face
    rocked = abs(float(settled.run.inclination[0]) - stand.inclination)
    if rocked > 2.0 * sum(turn for turn, _ in turns):  # a flipper moves the body by less
        return replace(settled, rotation=max(settled.rotation, rocked))
    return settled


def arrived(course: Course, stand: Stand) -> bool:
    """Whether the robot stands at the end of its course."""
    return stand.status is Status.OK and stand.x >= course.x_end - 1e-6


def _past(run: contact.Path, row: int) -> int:
    """Last pose at the same place: after what happened there."""
    while row + 1 < len(run.s) and run.s[row + 1] <= run.s[row]:
        row += 1
    return row


def _settled(
    course: Course, angles: Angles, x: float, inclination: float, until: float, step: float
) -> Stand:
    run = _drive(course, angles, x, inclination, until, step)
    if len(run.s) == 0:
        return Stand(
            angles=angles, run=run, row=-1, until=until, begun=(x, inclination), rotation=math.inf,
            status=Status.FELL_BACKWARD if inclination > 0 else Status.FELL_FORWARD,
        )  # fmt: skip
    row = _past(run, 0)
    at_once = run.rotations[run.rotations.s <= run.s[row]]
    return Stand(
        angles=angles, run=run, row=row, until=until, begun=(x, inclination),
        rotation=float(at_once.angle.max(initial=0.0)),
    )  # fmt: skip


def _drive(
    course: Course, angles: Angles, x: float, inclination: float, until: float, step: float
) -> contact.Path:
    body = outline_of(course.robot, angles)
    return contact.traverse(
        course.ground, body.parts, x, until, kinds=body.kinds, inclination=inclination,
        gyration=body.gyration, step=step, with_margins=False,
    )  # fmt: skip
