r"""Sub-tracks that follow the terrain scanned ahead (after Okada et al. 2010, 2011).

The operator only drives; the robot scans the terrain and sets its sub-tracks: the front pair down
onto what comes, the rear pair down onto what is left behind, so that contacts reach as far out as
they can. Where the main tracks alone would not stand safely ahead, the flippers are set to carry
the body at the slope of the terrain in sight below it.

::

                   .--o   front pair: turned down from above
        _______.--´  __|     until it touches a scanned point
       (______o)____|
     o-´   main track at the pose expected ahead

Source:
Okada, Nagatani, Yoshida, Yoshida & Koyanagi 2010, "Shared autonomy system for tracked vehicles to
traverse rough terrain based on continuous three-dimensional terrain scanning", IROS, 357-362; and
Okada, Nagatani, Yoshida, Tadokoro, Yoshida & Koyanagi 2011, "Shared autonomy system for tracked
vehicles on rough terrain based on continuous three-dimensional terrain scanning", Journal of
Field Robotics. Re-derived: the touching angle, the expected pose and the rule are ours.
"""

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kaidan import contact
from kaidan.contact import Status
from kaidan.errors import InputError
from kaidan.literature import stepping
from kaidan.literature.guarded_drive import SPEED
from kaidan.literature.rollover import stability_margin
from kaidan.literature.stepping import RANGE, Angles, Course, Stand
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.robot import FlipperPair, Posture, Robot
from kaidan.terrain.profile import Profile

Array = NDArray[np.float64]


_FOLLOWED = 5.0
"""Turn of the main tracks, as a multiple of the step over their length, up to which the flippers go
along: a nose on an edge turns the body by about once that, and much more is a drop."""


class Scan(NamedTuple):
    """How the terrain is seen."""

    horizon: float = 1.0
    """How far the scanner sees behind and ahead of the centroid [m]."""
    spacing: float = 0.01
    """Distance of the points along the ground [m]."""
    noise: float = 0.0
    """Standard deviation of their heights [m]."""
    seed: int = 0
    """Of the noise."""


def touching_angle(points: ArrayLike, pair: FlipperPair) -> float:
    r"""Angle at which a flipper, turned down from above, first touches one of a set of points.

    With a point at distance d and elevation b from the pivot, r0 and r1 the radii at root and tip,
    l the length, sin(e) = (r0 - r1)/l::

        its straight underside:  theta = b - e + asin(r0/d)   if 0 <= sqrt(d^2 - r0^2) <= l cos(e)
        its tip:                 theta = b + acos((d^2 + l^2 - r1^2)/(2 d l))     beyond

    The largest angle over all points touches first.

    Parameters
    ----------
    points : array, shape (n, 2)
        Points from the pivot, outward along the track and normal to it [m].
    pair : FlipperPair
        Flippers.

    Returns
    -------
    float
        Angle [rad], raising the tip positive; NaN if no point is within reach.

    Raises
    ------
    InputError
        Points of another shape, or not finite.

    Examples
    --------
    By hand: a thin flipper touches what lies at 45 degrees at 45 degrees.

    >>> pair = FlipperPair(length=2.0, root_radius=0.005, tip_radius=0.005, pivot_height=0.005)
    >>> round(math.degrees(touching_angle([(1, 1)], pair)), 1)  # 0.2 deg more: its radius
    45.2
    """
    at = np.asarray(points, dtype=float)
    if at.ndim != 2 or at.shape[1] != 2 or not np.isfinite(at).all():
        raise InputError(f"points of shape {at.shape}: write (n, 2) finite numbers")
    l, r0, r1 = pair.length, pair.root_radius, pair.tip_radius  # noqa: E741
    d, b = np.hypot(at[:, 0], at[:, 1]), np.arctan2(at[:, 1], at[:, 0])
    # nearer than the root's radius it is the root that touches, at any angle
    seen = (d > r0) & (d < l + r1) & (np.abs(b) < 0.75 * math.pi)
    d, b = d[seen], b[seen]
    if len(d) == 0 or l <= abs(r0 - r1):
        return math.nan
    e = math.asin((r0 - r1) / l)
    under = np.sqrt(d**2 - r0**2) <= l * math.cos(e)
    straight = b - e + np.arcsin(np.minimum(r0 / d, 1.0))
    tip = b + np.arccos(np.clip((d**2 + l**2 - r1**2) / (2.0 * d * l), -1.0, 1.0))
    return float(np.where(under, straight, tip).max())


def scanned(profile: Profile, x: float, scan: Scan, noise: np.random.Generator) -> Array:
    """Terrain as it is seen from a place: points along the ground, with noise in their heights.

    Parameters
    ----------
    profile : Profile
        Terrain; beyond its ends it goes on level.
    x : float
        Where the scanner stands [m].
    scan : Scan
        How it sees.
    noise : numpy.random.Generator
        Where the noise comes from.

    Returns
    -------
    array, shape (n, 2)
        x, never decreasing, and z [m].

    Examples
    --------
    >>> step = Profile.of_points([(0, 0), (1, 0), (1, 0.1), (2, 0.1)])
    >>> seen = scanned(step, 1.0, Scan(horizon=0.5, spacing=0.25), np.random.default_rng(0))
    >>> seen[:, 0].tolist()
    [0.5, 0.75, 1.0, 1.0, 1.25, 1.5]
    """
    near, far = x - scan.horizon, x + scan.horizon
    line = profile.points
    even = np.arange(math.ceil(near / scan.spacing - 1e-9), math.floor(far / scan.spacing) + 1)
    inside = line[(line[:, 0] >= near) & (line[:, 0] <= far)]
    places = np.setdiff1d(np.append(even * scan.spacing, [near, far]), inside[:, 0])
    between = np.column_stack([places, np.interp(places, line[:, 0], line[:, 1])])
    seen = np.vstack([between, inside])
    seen = seen[np.argsort(seen[:, 0], kind="stable")]
    if scan.noise > 0.0:
        seen[:, 1] += noise.normal(0.0, scan.noise, len(seen))
    return np.asarray(seen)


@dataclass(frozen=True)
class Followed:
    """A traverse with sub-tracks on the terrain; see `follow_terrain`. Arrays: one entry a step."""

    status: Status
    arrived: bool
    """Whether it went through."""
    x: Array
    """Centroid, along [m]."""
    z: Array
    """Centroid, up [m]."""
    inclination: Array
    """Nose up positive [rad]."""
    front: Array
    """Angle of the front flippers [rad]; NaN without them."""
    rear: Array
    requested: Array
    """Angles that the rule requested, front and rear, shape (n, 2) [rad]."""
    contacts: Array
    """Rear and front contact, shape (n, 4): x, z, x, z [m]."""
    margin: Array
    """Smallest normalised energy stability margin since the entry before [m]; 0 if it lost its
    balance and was arrested, minus infinity if it fell."""
    rotation: Array
    """Largest rotation since the entry before that nothing prevented [rad]."""
    main_track_stands: NDArray[np.bool_]
    """Whether the main tracks alone were expected to stand safely ahead."""

    @property
    def largest_rotation(self) -> float:
        """Largest rotation that nothing prevented [rad]."""
        return float(self.rotation.max(initial=0.0))


def follow_terrain(
    robot: Robot,
    profile: Profile,
    *,
    posture: Posture | None = None,
    scan: Scan | None = None,
    speed: float | None = None,
    flipper_speed: float | None = None,
    limits: tuple[float, float] = RANGE,
    step: float = 0.02,
) -> Followed:
    """Drive a robot over a profile, nose first, its flippers on the terrain that it scans.

    Parameters
    ----------
    robot : Robot
        Robot with flippers.
    profile : Profile
        Terrain, driven from its first to its last landing.
    posture : Posture, optional
        Flippers at the start; stowed without one.
    scan : Scan, optional
        How the terrain is seen.
    speed : float, optional
        Speed of the drive [m/s]; without one the sheet's largest, or 0.1 m/s.
    flipper_speed : float, optional
        Largest turning speed [rad/s]; without one the sheet's. 0 keeps the posture.
    limits : (float, float)
        Joint range of the flippers [rad].
    step : float
        Way between two scans [m].

    Returns
    -------
    Followed
        A robot that falls is an answer.

    Raises
    ------
    InputError
        A robot without flippers, speeds or lengths without meaning.
    """
    scan = scan or Scan()
    pairs = (robot.front_flippers, robot.rear_flippers)
    if pairs == (None, None):
        raise InputError(f"robot {robot.name!r} has no flippers that could follow the terrain")
    v = speed if speed is not None else robot.drive.max_speed or SPEED
    rates = [_rate(pair, flipper_speed) for pair in pairs]
    _check(v, step, scan, rates, limits)
    course = Course.of(robot, profile, posture)
    safe = float(kinetic_energy_height(v=v))
    noise = np.random.default_rng(scan.seed)
    at = stepping.begin(course)
    stands, margins, stood = [at], [at.least_margin()], [True]
    desired, rotations = [at.angles], [at.rotation]
    most = 3 * int((course.x_end - course.x_start + float(np.ptp(profile.points[:, 1]))) / step)
    for _ in range(most + 50):
        if at.status is not Status.OK or stepping.arrived(course, at):
            break
        seen = scanned(profile, at.x, scan, noise)
        requested, stands_ahead = desired_angles(course, at, seen, step, safe)
        turned = Angles(
            *(
                stepping.towards(now, goal, pair, rate * step / v, limits)
                for now, goal, pair, rate in zip(at.angles, requested, pairs, rates, strict=True)
            )
        )
        before = stepping.turned(course, at, turned)
        rocked = before.rotation if before is not at else 0.0
        at = stepping.ahead(course, before, step)
        stands.append(at)
        margins.append(at.least_margin(before))
        rotations.append(max(rocked, at.rotation))
        desired.append(requested)
        stood.append(stands_ahead)
    arrived = stepping.arrived(course, at)
    angles = np.array([each.angles for each in stands], dtype=float)
    return Followed(
        status=at.status if at.status is not Status.OK or arrived else Status.TOO_LONG,
        arrived=arrived,
        x=np.array([each.x for each in stands]),
        z=np.array([each.z for each in stands]),
        inclination=np.array([each.inclination for each in stands]),
        front=angles[:, 0],
        rear=angles[:, 1],
        requested=np.array(desired, dtype=float),
        contacts=np.array([each.contacts for each in stands]),
        margin=np.array(margins),
        rotation=np.array(rotations),
        main_track_stands=np.array(stood),
    )


def desired_angles(
    course: Course, at: Stand, seen: ArrayLike, step: float, safe: float
) -> tuple[Angles, bool]:
    """Angles that lay the flippers on the terrain at the pose expected one step ahead.

    Parameters
    ----------
    course : Course
        Robot and terrain.
    at : Stand
        Where it stands.
    seen : array, shape (n, 2)
        Scanned points in the order of x [m].
    step : float
        Way ahead [m].
    safe : float
        Margin that the main tracks alone must have to be trusted with the body [m].

    Returns
    -------
    requested : Angles
        [rad]; a pair that has nothing within reach is laid in line with the track.
    stands_ahead : bool
        Whether the main tracks alone stand safely there. If not, the flippers are set to carry
        the body at the slope of the terrain below it.
    """
    points = np.asarray(seen, dtype=float)
    body = stepping.outline_of(course.robot, at.angles)
    x, phi = at.x + step * math.cos(at.inclination), at.inclination
    main, length = body.kinds != contact.FLIPPER, course.robot.track.flat_length
    pose = contact.settle(points, body.parts[main], x, phi, kinds=body.kinds[main])
    stands = pose.found and _margin(x, pose) >= safe
    if stands and abs(pose.inclination - phi) <= _FOLLOWED * step / length:
        z, phi = pose.z, pose.inclination
    else:
        stands = False
        phi = _slope(points, x, body.reach)
        z = _resting_height(body.parts[main], body.kinds[main], points, x, phi)
    requested: list[float | None] = []
    outward: dict[Literal["front", "rear"], float] = {"front": 1.0, "rear": -1.0}
    c, s = math.cos(phi), math.sin(phi)
    stance = body.stance
    front_tip = stance.com_from_front - stance.front_extension
    for end, way in outward.items():
        pair: FlipperPair | None = getattr(course.robot, f"{end}_flippers")
        if pair is None:
            requested.append(None)
            continue
        tip = front_tip if end == "front" else front_tip - length
        p_x, p_z = tip - way * pair.pivot_inset, pair.pivot_height - stance.com_height
        u, w = points[:, 0] - x, points[:, 1] - z
        local = np.column_stack([way * (c * u + s * w - p_x), c * w - s * u - p_z])
        angle = touching_angle(local[local[:, 0] > 0.0], pair)
        requested.append(pair.flat_angle if math.isnan(angle) else angle)
    return Angles(*requested), stands


def _slope(points: Array, x: float, reach: tuple[float, float]) -> float:
    """Slope of the line fitted to the terrain below the robot [rad]."""
    below = points[(points[:, 0] >= x - reach[0]) & (points[:, 0] <= x + reach[1])]
    u, w = (below - below.mean(axis=0)).T
    return math.atan2(float(u @ w), float(u @ u))


def _resting_height(
    parts: Array, kinds: NDArray[np.int64], points: Array, x: float, phi: float
) -> float:
    """Lowest height of the centroid at an inclination [m]."""
    return contact.resting_height(points, parts, x, phi, kinds=kinds)


def _margin(x: float, pose: contact.Settled) -> float:
    """Normalised energy stability margin of a settled pose, about its two contacts [m]."""
    return min(stability_margin(pose.points, (x, pose.z)))


def _rate(pair: FlipperPair | None, given: float | None) -> float:
    if pair is None:
        return 0.0
    return given if given is not None else pair.max_speed or 0.0


def _check(
    v: float, step: float, scan: Scan, rates: list[float], limits: tuple[float, float]
) -> None:
    for what, value in (("speed", v), ("step", step), ("scan.horizon", scan.horizon),
                        ("scan.spacing", scan.spacing)):  # fmt: skip
        if not 0.0 < value < math.inf:
            raise InputError(f"{what} = {value:g}: write a positive number")
    if not 0.0 <= scan.noise < math.inf or not all(0.0 <= rate < math.inf for rate in rates):
        raise InputError("noise and flipper speed are numbers from 0 on")
    if not -math.pi <= limits[0] < limits[1] <= math.pi:
        raise InputError(
            f"limits = {limits[0]:g} to {limits[1]:g} rad: write a smaller and a larger angle "
            "within -3.14159 to 3.14159 rad"
        )
