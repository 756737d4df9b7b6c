"""Where a trial begins and where it ends: the pose on the flight, and the course to drive."""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.outline import Outline
from kaidan.physics.spec import TrialSpec
from kaidan.physics.terrain import with_landings
from kaidan.terrain.profile import Profile

Array = NDArray[np.float64]

AFTER = 0.9
"""Spacings to go on after the last nosing was passed going up: the next one comes at 1."""
AFTER_GAIN = 0.3
"""The same after the last nosing was reached going down."""
BEFORE = 0.05
"""Distance from the stairs at which a robot on the landing starts [m]."""
BEYOND = 0.02
"""Distance by which the whole flat is past the stairs at the end [m]."""
NEXT = math.radians(20.0)
"""Rotation as it settles beyond which it has not settled but fallen [rad]."""


class Course(NamedTuple):
    """Start and end of a trial, as driven: x ahead, z up."""

    profile: Profile
    """Terrain, with landings long enough."""
    outline: Outline
    x: float
    z: float
    phi: float
    """Start: centroid [m] and inclination [rad]."""
    slope: float
    """Slope of the line of the nosings, of the steepest flight [rad]: negative going down."""
    spacing: float
    """Nosing spacing [m]."""
    rear: float
    front: float
    """Ends of the flat, along the track from the centroid [m]."""
    goal: float
    """Place of the downhill end along that line at which the trial is done [m]; infinite: by
    `goal_x` alone."""
    goal_x: float
    """x at which the rear end of the flat is on the other landing [m]."""
    distance: float
    """About how far it has to drive [m]."""
    window: tuple[float, float]
    """x between which the robot can be [m]."""

    @property
    def along(self) -> Array:
        """Unit vector along the line of the nosings."""
        return np.array([math.cos(self.slope), math.sin(self.slope)])

    @property
    def down(self) -> bool:
        """Whether it goes down."""
        return self.slope < 0

    @property
    def nosings(self) -> Array:
        """Place of each nosing along that line [m], increasing."""
        return np.asarray(self.profile.nosings @ self.along)

    @property
    def downhill_end(self) -> float:
        """Downhill end of the flat, along the track from the centroid [m]."""
        return self.front if self.down else self.rear

    @property
    def uphill_end(self) -> float:
        """Uphill end of the flat, along the track from the centroid [m]."""
        return self.rear if self.down else self.front


def course_of(spec: TrialSpec) -> Course:
    """Start and end of a trial."""
    outline = spec.outline()
    back, ahead = outline.reach
    profile = with_landings(spec.profile(), back + ahead + 1.0)
    stance, flat = outline.stance, outline.stance.flat_length
    nose_first = spec.question.facing == "nose-first"
    front = stance.com_from_front if nose_first else flat - stance.com_from_front
    rear = front - flat
    slope, spacing = slope_of(profile, flat), profile.nosing_spacing
    goal, goal_x = math.inf, _past(profile, spec.downhill)
    if spec.begin == "landing":
        before = BEFORE + (spec.start_offset or 0.0) * spacing
        x, phi = _on_the_landing(outline, profile, before)
        end = goal_x
    else:
        phi = slope
        x, goal = _on_the_flight(spec, profile, slope, rear, front)
        end = min(goal_x, goal * math.cos(slope) - rear + spacing)
    z, phi = _at_rest(outline, profile, x, phi)
    distance = max(spacing, (end + back - x)) / max(0.3, math.cos(slope))
    if spec.begin == "flight" and math.isfinite(goal):
        tip = rear if not spec.downhill else front
        now = x * math.cos(slope) + z * math.sin(slope) + tip
        distance = min(distance, max(spacing, goal - now))
    return Course(
        profile=profile,
        outline=outline,
        x=x,
        z=z,
        phi=phi,
        slope=slope,
        spacing=spacing,
        rear=rear,
        front=front,
        goal=goal,
        goal_x=goal_x,
        distance=distance,
        window=(x - back - 2 * spacing - 0.2, end + back + ahead + 2 * spacing + 0.2),
    )


def slope_of(profile: Profile, room: float) -> float:
    """Slope of the line of the nosings, of the steepest flight if there are several [rad].

    room: distance of two nosings from which on a landing lies between them [m].
    """
    ends = np.flatnonzero(np.diff(profile.nosings[:, 0]) >= room) + 1
    flights = np.split(profile.nosings, ends)
    slopes = [
        replace(profile, nosings=flight).angle
        for flight in flights
        if 1 < len(flight) < len(profile.nosings)
    ]
    return max(slopes, key=abs, default=profile.angle)


def _on_the_landing(outline: Outline, profile: Profile, before: float) -> tuple[float, float]:
    """Centroid x [m] and inclination [rad] at rest on the landing.

    Flippers that reach below the flat lift an end of it, so the robot leans whatever its place, and
    its foremost point is that of the pose in which it leans, not that of the flat on the floor.

    before: distance of the foremost point from the first nosing [m].
    """
    floor = np.array([[-1.0, 0.0], [1.0, 0.0]]) * (2.0 * max(outline.reach) + 2.0)
    pose = contact.settle(floor, outline.parts, 0.0, 0.0, kinds=outline.kinds)
    phi = pose.inclination if pose.found else 0.0
    discs = outline.parts.reshape(-1, 3)
    foremost = discs[:, 0] * math.cos(phi) - discs[:, 1] * math.sin(phi) + discs[:, 2]
    return float(profile.nosings[0, 0] - before - foremost.max()), phi


def _at_rest(outline: Outline, profile: Profile, x: float, phi: float) -> tuple[float, float]:
    """Height of the centroid [m] and inclination [rad] of the stable pose next to an inclination.

    Where there is none within `NEXT` the robot is held at that inclination on what it touches.
    """
    pose = contact.settle(profile.points, outline.parts, x, phi, kinds=outline.kinds)
    if pose.found and abs(pose.inclination - phi) < NEXT:
        return pose.z, pose.inclination
    return contact.resting_height(profile.points, outline.parts, x, phi, kinds=outline.kinds), phi


def _on_the_flight(
    spec: TrialSpec, profile: Profile, slope: float, rear: float, front: float
) -> tuple[float, float]:
    """Centroid x at the start, and the goal of the downhill end [m]."""
    spacing = profile.nosing_spacing
    places = profile.nosings @ np.array([math.cos(slope), math.sin(slope)])
    offset, first = spec.drawn()[0] * spacing, spec.first_nosing
    goal = math.inf
    if spec.downhill:
        place, tip = places[first] + offset, front
        if not spec.runs_out:
            goal = places[first + spec.nosings] + AFTER_GAIN * spacing
    else:
        place, tip = places[first] - offset, rear
        if not spec.runs_out:
            goal = places[first + spec.nosings - 1] + AFTER * spacing
    # the flat on the line through the nosings
    nosing = profile.nosings[first]
    on = nosing + (place - places[first] - tip) * np.array([math.cos(slope), math.sin(slope)])
    centroid = on + spec.outline().stance.com_height * np.array([-math.sin(slope), math.cos(slope)])
    return float(centroid[0]), float(goal)


def _past(profile: Profile, down: bool) -> float:
    """Where in x the other landing begins [m]."""
    if not down:
        return float(profile.nosings[-1, 0]) + BEYOND
    end = profile.points[-1, 1]
    return (
        float(
            profile.points[profile.points[:, 1] > end + 1e-9, 0].max(initial=profile.nosings[-1, 0])
        )
        + BEYOND
    )
