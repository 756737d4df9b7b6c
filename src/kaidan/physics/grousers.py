"""Grousers that run round the main track, each driven to where the belt carries it.

::

    slide   along the track, to the axle it is over      servos on both: where the belt has it
    hinge   about that axle, on the round ends
    spring  radially: the grouser yields

Each is a half-round bar: a cylinder across a belt, its axis on the belt, its radius the height.
So its flanks leave the belt at a right angle and hook no nosing, as an undercut flank does. The
surface between the bars is the smooth belt. Each of the two belts has its own phase.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.physics.belts import Lane, rounded
from kaidan.physics.engine import engine
from kaidan.physics.spec import TrialSpec
from kaidan.physics.tracks import DrivenGrousers
from kaidan.robot import Track

Array = NDArray[np.float64]

HEIGHT = 0.010
"""Height of grousers where none is stated [m]."""
COUNT = 40
"""Number of grousers where no spacing is stated."""
MASS = 0.02
"""Mass of a grouser [kg]; the belt's mass is the robot's already."""
_STIFF = 2e6
"""Servo of the slide [N/m], ten times a grouser's spring; the hinge's has the same at the tip."""
_LAG = 1e-3
"""Time by which the servos lag behind, the same for all [s]."""
_ARMATURE = 0.05
_RATIO = 0.7
_COLOUR = (0.1, 0.1, 0.1, 1.0)


class Motion(NamedTuple):
    """Where each grouser has to be, as a function of how far the belt has run."""

    geoms: tuple[str, ...]
    places: Array
    """Places along their belt at the start, from the front end backward [m]."""
    rear: float
    front: float
    radius: float

    @property
    def length(self) -> float:
        """Length of the belt [m]."""
        return 2 * (self.front - self.rear) + 2 * math.pi * self.radius

    def targets(self, run: float) -> Array:
        """Slides [m] and hinges [rad] of all grousers, in turn, when the belt has run so far."""
        flat, arc = self.front - self.rear, math.pi * self.radius
        laps, s = np.divmod(self.places + run, self.length)
        slide = np.interp(
            s, [0.0, flat, flat + arc, 2 * flat + arc, self.length],
            [self.front, self.rear, self.rear, self.front, self.front],
        )  # fmt: skip
        angle = np.interp(
            s, [0.0, flat, flat + arc, 2 * flat + arc, self.length],
            [0.0, 0.0, math.pi, math.pi, 2 * math.pi],
        )  # fmt: skip
        return np.column_stack([slide, angle + 2 * math.pi * laps]).ravel()


def standing_out(spec: TrialSpec) -> float:
    """How far the track stands out of the outline [m]."""
    if isinstance(spec.track, DrivenGrousers):
        return grouser_height(spec.track, spec.question.robot.track)
    return 0.0


def grouser_height(grousers: DrivenGrousers, track: Track) -> float:
    """Height of the grousers above the belt [m]."""
    return grousers.height or track.grouser_height or HEIGHT


def add_grousers(
    scene: Any, body: Any, spec: TrialSpec, part: Array, lane: Lane, common: dict[str, Any]
) -> Motion:
    """Add the grousers of the main track to the robot's body."""
    mujoco = engine()
    track = spec.track
    assert isinstance(track, DrivenGrousers)
    height = grouser_height(track, spec.question.robot.track)
    part = rounded(part)
    rear, front, radius, z = part[0], part[3], part[2], part[1]
    arm = radius + height
    length = 2 * (front - rear) + 2 * math.pi * radius
    spacing = track.spacing or spec.question.robot.track.grouser_spacing or length / COUNT
    count = max(4, round(length / spacing))
    phases = sorted(set(spec.drawn()[1:]))  # belts in one phase are as good as a wide one
    stiffness, half = track.stiffness / len(phases), lane.half_width / len(phases)
    places = np.concatenate([np.arange(count) + each for each in phases])
    motion = Motion(
        tuple(f"grouser{k}" for k in range(len(places))),
        places * length / count,
        float(rear),
        float(front),
        float(radius),
    )
    targets = motion.targets(0.0).reshape(-1, 2)
    hinge, slide = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE
    for k, (name, (x, angle)) in enumerate(zip(motion.geoms, targets, strict=True)):
        y = (half if k < count else -half) * (len(phases) - 1)
        # the body's frame is turned with the grouser, so that the model opens with it in place
        c, s = math.cos(angle), math.sin(angle)
        one = body.add_body(
            name=name, pos=[x, 0.0, z], quat=[math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0]
        )
        one.mass, one.ipos, one.inertia = MASS, [0.0, 0.0, -radius], [1e-6] * 3
        one.explicitinertial, one.gravcomp = True, 1.0
        one.add_joint(name=f"{name}_x", type=slide, axis=[c, 0.0, s], ref=x, armature=_ARMATURE)
        one.add_joint(
            name=f"{name}_a", type=hinge, axis=[0.0, 1.0, 0.0], ref=angle,
            armature=_ARMATURE * arm**2,
        )  # fmt: skip
        one.add_joint(
            name=f"{name}_r",
            type=slide,
            axis=[0.0, 0.0, 1.0],
            stiffness=[stiffness, 0.0, 0.0],
            damping=[2 * _RATIO * math.sqrt(stiffness * MASS), 0.0, 0.0],
        )
        one.add_geom(
            name=name,
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            size=[height, half, 0.0],
            pos=[0.0, y, -radius],
            quat=[math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0],
            rgba=_COLOUR,
            **common,
        )
        for joint, stiff in (("x", _STIFF), ("a", _STIFF * arm**2)):
            actuator = scene.add_actuator(
                name=f"{name}_{joint}",
                target=f"{name}_{joint}",
                trntype=mujoco.mjtTrn.mjTRN_JOINT,
            )
            actuator.set_to_position(kp=stiff, kv=stiff * _LAG)
    return motion
