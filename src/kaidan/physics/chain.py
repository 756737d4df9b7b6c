"""A chain of hinged shoes round the main track: slow, and built quite unlike the other models.

::

        .--shoe--o--shoe--o--shoe--.         hull of the robot: slippery where the shoes glide
       (  idler                sprocket )    sprocket: its surface runs and grips the shoes
        '--shoe--o--shoe--o--shoe--'         idler: pushed outward by a spring, the tension

Only the shoes touch the stairs, and only the hull touches the shoes.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.physics.belts import Lane
from kaidan.physics.engine import engine
from kaidan.physics.spec import TrialSpec
from kaidan.physics.tracks import ShoeChain

Array = NDArray[np.float64]

SHOE_MASS = 0.02
"""Mass of a shoe [kg]; the tracks' mass is the robot's already."""
_GRIP = 8.0
"""Friction between sprocket and shoes: wrapped half round, it is as good as teeth."""
_COLOURS = ((0.15, 0.16, 0.18, 1.0), (0.28, 0.30, 0.33, 1.0))
SPROCKET = "sprocket"
IDLER = "idler"


def add_chain(
    scene: Any,
    body: Any,
    spec: TrialSpec,
    track: ShoeChain,
    part: Array,
    lane: Lane,
    common: dict[str, Any],
) -> list[str]:
    """Add hull, sprocket, idler and shoes; names of the shoes."""
    mujoco = engine()
    rear, front, z = float(part[0]), float(part[3]), float(part[1])
    outer = float(part[2])
    inner = outer - track.thickness
    middle = outer - track.thickness / 2
    box, capsule = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CAPSULE
    across = [math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0]
    hull = {"contype": 8, "conaffinity": 4, "priority": 1}
    half = lane.half_width
    body.add_geom(
        name="hull", type=box, size=[(front - rear) / 2, half, inner],
        pos=[(front + rear) / 2, 0.0, z], condim=1,
        rgba=(0.6, 0.62, 0.65, 1.0), **hull,
    )  # fmt: skip
    body.add_geom(
        name=SPROCKET, type=capsule, size=[inner, half, 0.0], pos=[rear, 0.0, z], quat=across,
        surfacevel=[0.0, 0.0, 0.0, 0.0, 0.0, spec.speed / inner], friction=[_GRIP, 0.0, 0.0],
        condim=3, rgba=(0.0, 0.45, 0.70, 1.0), **hull,
    )  # fmt: skip
    idler = body.add_body(name=IDLER, pos=[front, 0.0, z])
    idler.mass, idler.inertia, idler.ipos = 0.2, [1e-3] * 3, [0.0, 0.0, 0.0]
    idler.explicitinertial, idler.gravcomp = True, 1.0
    soft = 2e4
    idler.add_joint(
        name="tension", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1.0, 0.0, 0.0],
        stiffness=[soft, 0.0, 0.0], springref=track.tension / soft, damping=[200.0, 0.0, 0.0],
    )  # fmt: skip
    idler.add_geom(
        name=IDLER, type=capsule, size=[inner, half, 0.0], quat=across,
        condim=1, rgba=(0.6, 0.62, 0.65, 1.0), **hull,
    )  # fmt: skip
    places, angles, link = _polygon(rear, front, z, middle, track.shoes, spec.drawn()[1])
    shoe_look = {**common, "contype": 4 | 2, "conaffinity": 8 | 1}
    owner, turned, at = body, 0.0, np.zeros(2)
    for k in range(track.shoes):
        here, angle = places[k], float(angles[k])
        away = here - at
        c, s = math.cos(turned), math.sin(turned)
        local = [c * away[0] + s * away[1], 0.0, -s * away[0] + c * away[1]]
        turn = (angle - turned) / 2
        one = owner.add_body(
            name=f"shoe{k}", pos=local, quat=[math.cos(turn), 0.0, -math.sin(turn), 0.0]
        )
        one.mass, one.ipos = SHOE_MASS, [link / 2, 0.0, 0.0]
        one.inertia, one.explicitinertial = [SHOE_MASS * link**2 / 12] * 3, True
        one.gravcomp = 1.0
        if k == 0:
            slide = mujoco.mjtJoint.mjJNT_SLIDE
            c, s = math.cos(angle), math.sin(angle)
            one.add_joint(name="chain_x", type=slide, axis=[c, 0.0, -s])
            one.add_joint(name="chain_z", type=slide, axis=[s, 0.0, c])
        one.add_joint(
            name=f"shoe{k}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0.0, -1.0, 0.0],
            damping=[2e-3, 0.0, 0.0], armature=1e-5,
        )  # fmt: skip
        one.add_geom(
            name=f"shoe{k}", type=box, size=[link / 2, half, track.thickness / 2],
            pos=[link / 2, 0.0, 0.0], rgba=_COLOURS[k % 2], **shoe_look,
        )  # fmt: skip
        owner, turned, at = one, angle, here
    closing = scene.add_equality(
        name="closed", type=mujoco.mjtEq.mjEQ_CONNECT, objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1=f"shoe{track.shoes - 1}", name2="shoe0",
        solref=[2 * spec.step, 1.0], solimp=[0.95, 0.99, 0.001, 0.5, 2.0],
    )  # fmt: skip
    closing.data[:3] = [link, 0.0, 0.0]
    return [f"shoe{k}" for k in range(track.shoes)]


def _polygon(
    rear: float, front: float, z: float, radius: float, count: int, phase: float
) -> tuple[Array, Array, float]:
    """Hinges on a stadium at equal chords, backward along the underside, and the chord.

    Shape (count, 2).
    """
    flat, arc = front - rear, math.pi * radius
    whole = 2 * flat + 2 * arc

    def point(s: Array) -> Array:
        s = np.mod(s, whole)
        turn = np.interp(s, [0, flat, flat + arc, 2 * flat + arc, whole],
                         [0.0, 0.0, math.pi, math.pi, 2 * math.pi])  # fmt: skip
        x = np.interp(s, [0, flat, flat + arc, 2 * flat + arc, whole],
                      [front, rear, rear, front, front])  # fmt: skip
        return np.column_stack([x - radius * np.sin(turn), z - radius * np.cos(turn)])

    s = (np.arange(count) + phase) * whole / count
    # equal chords: shift the places along the curve until they are
    for _ in range(200):
        p = point(s)
        chord = np.hypot(*(np.roll(p, -1, axis=0) - p).T)
        ahead = np.concatenate([[0.0], np.cumsum(chord.mean() - chord)[:-1]])
        s = s + 0.5 * (ahead - ahead.mean())
    p = point(s)
    step = np.roll(p, -1, axis=0) - p
    return p, np.arctan2(step[:, 1], step[:, 0]), float(np.hypot(*step.T).mean())
