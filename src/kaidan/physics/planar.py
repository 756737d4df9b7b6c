"""A trial of a yielding track: the planar inner loop, seen as the trial sees a simulation.

Contacts of MuJoCo have no spring along the surface, and a spring in a light part between robot and
stairs chatters (docs/lab/physics.md); so the body on rubber is advanced here, without MuJoCo.
"""

import importlib.util
import math
import sys
from collections.abc import Callable
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import BELLY
from kaidan.errors import MissingExtraError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics import rubber
from kaidan.physics.belt_speed import Belt
from kaidan.physics.belts import rounded, tangent
from kaidan.physics.initial_pose import course_of
from kaidan.physics.moving_body import WILD, MovingBody
from kaidan.physics.spec import TrialSpec
from kaidan.physics.tracks import YieldingBelt

Array = NDArray[np.float64]

FINEST = 2.5e-4
"""Inner step for a time step of 1 ms [s], and never more than `RESOLVED` of the stiffest motion."""
RESOLVED = 0.1
"""Inner step times the fastest angular frequency [1]."""
SIGNATURES = {
    "depth_below": "Tuple((f8, f8, f8))(f8[::1], f8, f8, f8)",
    "corner_met": "Tuple((f8, f8, f8, f8))(f8[:, ::1], i8, f8, f8[:, ::1], f8, f8, f8, f8)",
    "end_met": "Tuple((f8, f8, f8, f8))(f8[:, ::1], i8, f8[:, :], i8, f8, f8, f8, f8)",
    "shear_when_met": "f8(f8[:, ::1], f8[:, ::1], f8, i8, i8, i8, i8, i8)",
    "carry_round": "void(f8[:, ::1], f8[::1], f8, f8, f8, f8, f8, f8)",
    "tip_met": "Tuple((f8, f8, f8))(f8[:, ::1], i8, f8, f8[:, ::1], i8, f8, f8, f8, f8)",
    "rubber_force": "Tuple((f8, f8, f8))(f8, f8, f8, f8, f8, f8[::1])",
    "first_near": "i8(f8[:, ::1], i8, i8, f8)",
    "add_contact": "void(f8[::1], f8[:, ::1], i8, f8[::1], f8[:, ::1], i8, i8, f8, f8, f8, f8, f8, "
    "f8, f8, f8, f8, f8[::1])",
    "meet_grousers": "void(f8[::1], f8[:, ::1], f8[:, ::1], f8[::1], f8[:, ::1], f8[::1], "
    "f8[:, ::1], f8[:, ::1], f8[:, ::1], f8, i8, i8, f8, f8[::1])",
    "advance": "i8(f8[::1], f8[:, ::1], f8[:, ::1], f8[::1], f8[:, ::1], f8[:, ::1], f8[:, ::1], "
    "f8[:, ::1], f8[:, ::1], f8[::1], i8, i8, i8, i8, f8, f8, f8, f8, f8[::1], f8[:, ::1])",
}
"""What is compiled, each for those that follow, in the types of numba."""


@cache
def kernel() -> ModuleType:
    """The inner loop, compiled by numba; kept on disk where numba finds a folder for it."""
    if importlib.util.find_spec("numba") is None:
        raise MissingExtraError("a yielding track", "physics")
    alias = f"{rubber.__name__}_compiled"
    spec = importlib.util.spec_from_file_location(alias, rubber.__file__)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[alias] = module
    spec.loader.exec_module(module)
    for name, signature in SIGNATURES.items():
        setattr(module, name, compiled(getattr(module, name), signature))
    return module


def compiled(function: Callable[..., Any], signature: str) -> Callable[..., Any]:
    """A function compiled for these types; in memory alone where its file on disk is of no use."""
    from numba import njit

    try:
        return njit(signature, cache=True, error_model="numpy")(function)
    except Exception:  # no folder, no room, a damaged file; what is wrong with it comes again
        return njit(signature, error_model="numpy")(function)


class RubberBody(MovingBody):
    """One run of a yielding track.

    spec: with a `YieldingBelt`.
    """

    def __init__(self, spec: TrialSpec) -> None:
        track = spec.track
        assert isinstance(track, YieldingBelt)
        assert spec.stiffness is not None
        assert spec.shear_stiffness is not None
        self.spec, self.course = spec, course_of(spec)
        self.belt = Belt(spec, self.course, at_once=True)
        self.advance = kernel().advance
        course = self.course
        lift = track.height or 0.0  # no grouser is in a nosing at the start
        self.state = np.array([course.x, course.z + lift, course.phi, 0.0, 0.0, 0.0])
        self._terrain()
        self._robot()
        self._grousers(track)
        mass = spec.mass()[0]
        inertia = mass * course.outline.gyration**2
        k, kt = spec.stiffness, spec.shear_stiffness
        self.constants = np.array(
            [
                mass,
                inertia,
                k,
                kt,
                2.0 * track.damping_ratio * math.sqrt(k * mass),
                2.0 * track.damping_ratio * math.sqrt(kt * mass),
                spec.static_friction,
                STANDARD_GRAVITY,
                self.window,
            ]
        )
        back, ahead = course.outline.reach
        self.reach = max(back, ahead) + course.outline.stance.com_height + 0.05
        # the stiffest motion: two contacts at the far end
        fastest = math.sqrt(2.0 * max(k, kt) * (1.0 / mass + max(back, ahead) ** 2 / inertia))
        fine = min(FINEST * spec.step / 1e-3, RESOLVED / fastest)
        self.inner = max(1, math.ceil(spec.step / fine))
        self.shear = np.zeros((1 + len(self.discs) + 2 * len(self.bars), len(self.points)))
        self.touched, self.done = np.full_like(self.shear, -1.0), 0
        self.push = np.zeros(3)
        self.impulses = np.zeros((len(course.profile.nosings) + 1, 2))
        self.contacts, self.lasted = 0, 1.0

    def _terrain(self) -> None:
        """Points, which of them stand out, and the nosing that each belongs to."""
        profile, nosings = self.course.profile, self.course.profile.nosings
        alone = self.spec.ground == "noses"
        points = np.array(nosings if alone else profile.points, dtype=np.float64)
        corners = np.full(len(points), 2.0)
        if not alone:
            before, after = points[1:-1] - points[:-2], points[2:] - points[1:-1]
            turns = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
            corners[:] = 0.0
            corners[1:-1] = turns < 0.0
        near = np.abs(points[:, None] - nosings[None]).max(axis=2) < 1e-9
        number = np.where(near.any(axis=1), near.argmax(axis=1), len(nosings))
        following = np.append(number[1:], len(nosings))
        pieces = np.where(number < len(nosings), number, following)
        self.points, self.corners = np.ascontiguousarray(points), corners
        self.owners = np.column_stack([number, pieces]).astype(np.float64)

    def _robot(self) -> None:
        """Parts with their lower tangents, and ends."""
        outline = self.course.outline
        rows, discs = [], {}
        for part, kind in zip(outline.parts, outline.kinds.tolist(), strict=True):
            runs = float(kind != BELLY)
            part = rounded(part) if runs else np.array(part)
            if part[0] > part[3]:
                part = part[[3, 4, 5, 0, 1, 2]]
            apart = math.dist(part[0:2], part[3:5])
            if apart <= abs(part[2] - part[5]) + 1e-9:  # one disc inside the other
                larger = part[0:3] if part[2] >= part[5] else part[3:6]
                part = np.tile(larger, 2)
                lower = (part[0], part[1] - part[2], 1.0, 0.0, -1.0)
            else:
                start, end, _ = tangent(part, -1.0)
                length = math.dist(start, end)
                lower = (*start, *((end - start) / length), length)
            rows.append((*part, *lower, runs))
            for disc in (part[0:3], part[3:6]):
                discs[tuple(disc.tolist())] = runs
        self.parts = np.array(rows)
        self.discs = np.array([(*disc, runs) for disc, runs in discs.items()])

    def _grousers(self, track: YieldingBelt) -> None:
        """Grousers of both belts, over the underside and the ends of the main track."""
        self.window, self.bars = 1.0, np.zeros((0, 8))
        if not track.height:
            return
        part = self.parts[0]
        count = math.ceil((part[10] + math.pi * (part[2] + part[5])) / track.spacing) + 1
        self.window = count * track.spacing
        places = [np.arange(count) + each for each in self.spec.drawn()[1:]]
        self.bars = np.zeros((2 * count, 8))
        self.bars[:, 0] = np.concatenate(places) * track.spacing
        self.bars[:, 3] = track.height

    def pose(self) -> tuple[float, float, float]:
        """Centroid x, z [m] and inclination [rad]."""
        x, z, phi = self.state[:3].tolist()
        return x, z, phi

    def rates(self) -> tuple[float, float]:
        """Velocity of the centroid in x and z [m/s]."""
        return float(self.state[3]), float(self.state[4])

    def drive(self, time: float, steps: int, on: bool) -> None:
        """Advance by some steps, the belt at its speed (or at rest)."""
        lasts = steps * self.spec.step
        speed = self.belt.speed(time) if on else 0.0
        change = (self.belt.speed(time + lasts) - speed) / lasts if on else 0.0
        x, around = self.state[0], self.reach + 0.05
        first = max(0, int(np.searchsorted(self.points[:, 0], x - around)) - 1)
        last = int(np.searchsorted(self.points[:, 0], x + around))
        self.impulses[:] = 0.0
        self.lasted = lasts
        self.contacts = self.advance(
            self.state, self.points, self.owners, self.corners, self.parts, self.discs, self.bars,
            self.shear, self.touched, self.constants, first, last, self.done, steps * self.inner,
            self.spec.step / self.inner, self.belt.run(time) if on else 0.0, speed, change,
            self.push, self.impulses,
        )  # fmt: skip
        self.done += steps * self.inner

    def pull(self, force: float) -> None:
        """Pull up the line of the nosings [N]: at the centroid, with grousers at the underside.

        They hold there, on ends of any radius; at the centroid it would tip a robot with sharp
        ends over its nose.
        """
        self.push[:2] = force * self.course.along
        self.push[2] = force * self.course.outline.stance.com_height if len(self.bars) else 0.0

    @property
    def tether(self) -> tuple[tuple[float, float], ...]:
        """Less by and by, so that the robot is at rest when it stands free."""
        return (1.0, 0.3), (0.75, 0.1), (0.5, 0.1), (0.25, 0.1), (0.0, 0.5)

    def set_going(self) -> None:
        """Give the robot the belt's speed."""
        way = self.sets_out
        self.state[3:5] += self.belt.speed(0.0) * np.array([math.cos(way), math.sin(way)])

    def diverged(self) -> bool:
        """Whether the simulation has left the realm of robots."""
        return not (np.isfinite(self.state).all() and bool((np.abs(self.state[3:5]) < WILD).all()))

    def contact_forces(self) -> tuple[Array, Array, int]:
        """Mean forces of the nosings since the last look, and the number of contacts now."""
        along = self.course.along
        frame = np.array([along, [-along[1], along[0]]]).T
        return self.impulses[:-1] @ frame / self.lasted, np.zeros((0, 2)), self.contacts

    def configuration(self) -> Array:
        """Centroid and inclination, as the model of a smooth belt has them."""
        return self.state[:3].copy()
