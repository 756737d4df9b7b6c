"""The whole model: stairs, robot, track, ready to be simulated or written as MJCF.

The world is as the robot drives: x ahead, z up, to +x whether uphill or downhill. In the
plane the robot has the joints x, z and phi (nose up); their values are the centroid's place [m] and
the inclination [rad].
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics.belts import add_belts, half_width, lanes_of
from kaidan.physics.chain import add_chain
from kaidan.physics.engine import engine
from kaidan.physics.grousers import Motion, add_grousers, standing_out
from kaidan.physics.initial_pose import Course, course_of
from kaidan.physics.spec import TrialSpec
from kaidan.physics.terrain import add_terrain, turned
from kaidan.physics.tracks import DrivenGrousers, ShoeChain

Array = NDArray[np.float64]

CLEARANCE = 1e-4
"""Height above the resting pose at which the robot starts [m]."""
_SOLIMP = [0.95, 0.99, 0.001, 0.5, 2.0]
_IMPRATIO = 10.0
"""Friction is this much stiffer than the normal direction: less creep under load."""
_CHASSIS = (0.90, 0.62, 0.0, 1.0)
ROBOT = "robot"


class Model(NamedTuple):
    """A compiled model and what belongs to its numbers."""

    spec: TrialSpec
    course: Course
    scene: Any
    """`mujoco.MjSpec`."""
    compiled: Any
    """`mujoco.MjModel`."""
    field: Array
    """Surface velocity of each geom for a belt speed of 1 m/s, shape (ngeom, 6)."""
    number_of: NDArray[np.int64]
    """Number of each geom's nosing as it drives, from 0; -1: other ground; -2: of the robot."""
    driven: NDArray[np.bool_]
    """Geoms whose surface drives the robot; grousers do it through their servos."""
    motion: Motion | None
    """Where the grousers have to be."""

    @property
    def mjcf(self) -> str:
        """The model as MJCF, in its start pose, the belt running."""
        return str(self.scene.to_xml())


def model_of(spec: TrialSpec) -> Model:
    """Model of a trial, in the pose in which it begins."""
    mujoco = engine()
    course = course_of(spec)
    scene = mujoco.MjSpec()
    scene.modelname = f"kaidan {spec.question.robot.name} on {spec.question.terrain_name}"
    _set_options(scene, spec)
    wide = half_width(spec) + (0.1 if spec.dimensions == 2 else 1.0)
    wide += 0.0 if spec.dimensions == 2 else course.distance * abs(math.sin(spec.question.yaw))
    numbers = add_terrain(scene, spec, course.profile, course.window, wide)
    body = _robot(scene, spec, course)
    contacts = {"contype": 2, "conaffinity": 1, "condim": 3}
    _add_chassis(body, spec, course)
    field: dict[str, Array] = {}
    driven: list[str] = []
    motion = None
    parts, kinds = course.outline.parts, course.outline.kinds
    if isinstance(spec.track, ShoeChain):
        driven = add_chain(scene, body, spec, spec.track, parts[0], lanes_of(spec)[0], contacts)
    else:
        field = add_belts(body, spec, parts, kinds, contacts)
    if isinstance(spec.track, DrivenGrousers):
        motion = add_grousers(scene, body, spec, parts[0], lanes_of(spec)[0], contacts)
    for geom in scene.geoms:
        geom.friction = [spec.static_friction, 0.0, 0.0] if geom.priority == 0 else geom.friction
        geom.solref, geom.solimp = [spec.softness, 1.0], _SOLIMP
    _add_view(scene, course)
    compiled = scene.compile()
    whole = np.zeros((compiled.ngeom, 6))
    number_of = np.full(compiled.ngeom, -2, dtype=np.int64)
    drives = np.zeros(compiled.ngeom, dtype=np.bool_)
    for name, velocity in field.items():
        whole[compiled.geom(name).id] = velocity
        drives[compiled.geom(name).id] = True
    for name in driven:
        drives[compiled.geom(name).id] = True
    for name, number in numbers.items():
        number_of[compiled.geom(name).id] = number
    return Model(spec, course, scene, compiled, whole, number_of, drives, motion)


def mjcf(spec: TrialSpec) -> str:
    """A trial's model as MJCF, which MuJoCo's own viewer opens.

    The belt runs at the trial's speed from the start; grousers and chains stand still, for what
    drives them is no part of MJCF.
    """
    return model_of(spec).mjcf


def _set_options(scene: Any, spec: TrialSpec) -> None:
    mujoco = engine()
    option = scene.option
    option.timestep = spec.step
    option.gravity = [0.0, 0.0, -STANDARD_GRAVITY]
    option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE  # 4.0.0 is wrong with sparse ones
    cones = mujoco.mjtCone
    chain = spec.track.kind == "shoe-chain"  # with elliptic cones its line search fails at times
    option.cone = cones.mjCONE_PYRAMIDAL if chain else cones.mjCONE_ELLIPTIC
    option.impratio = _IMPRATIO
    option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    scene.compiler.degree = False


def _robot(scene: Any, spec: TrialSpec, course: Course) -> Any:
    """Body of the robot at its start, with its joints and its inertia."""
    mujoco = engine()
    lift = CLEARANCE + standing_out(spec)
    x = course.x - lift * math.sin(course.phi)
    z = course.z + lift * math.cos(course.phi)
    body = scene.worldbody.add_body(name=ROBOT, pos=[x, 0.0, z], quat=turned(course.phi))
    mass = spec.mass()[0]
    about_y = mass * course.outline.gyration**2
    # of an even box as wide as the robot and twice as high as the centroid
    wide, high = 2 * half_width(spec), 2 * course.outline.stance.com_height
    about_x = mass * (wide**2 + high**2) / 12
    about_z = max(mass * (wide**2 - high**2) / 12 + about_y, about_x * 0.1)
    about_x, about_z = _possible(about_x, about_y, about_z)
    body.mass, body.ipos = mass, [0.0, 0.0, 0.0]
    body.inertia, body.explicitinertial = [about_x, about_y, about_z], True
    if spec.dimensions == 3:
        half = spec.question.yaw / 2
        yaw, rise = np.array([math.cos(half), 0.0, 0.0, math.sin(half)]), turned(course.phi)
        whole = np.zeros(4)
        mujoco.mju_mulQuat(whole, np.array(rise), yaw)  # turned in the plane it stands on
        body.quat = whole
        body.add_freejoint(name="free")
        return body
    c, s = math.cos(course.phi), math.sin(course.phi)
    hinge, slide = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE
    body.add_joint(name="x", type=slide, axis=[c, 0.0, -s], ref=x)
    body.add_joint(name="z", type=slide, axis=[s, 0.0, c], ref=z)
    body.add_joint(name="phi", type=hinge, axis=[0.0, -1.0, 0.0], ref=course.phi)
    return body


def _add_chassis(body: Any, spec: TrialSpec, course: Course) -> None:
    """Add the robot's body to what is seen: a box that stands a little above the tracks.

    Nothing touches it: where the robot's underside is, belts and belly say.
    """
    stance = course.outline.stance
    bottom = 0.25 * stance.com_height
    highest = max(part[1] + part[2] for part in course.outline.parts[:1]) + stance.com_height
    top = max(2.0 * stance.com_height, highest + 0.04)
    body.add_geom(
        type=engine().mjtGeom.mjGEOM_BOX,
        size=[0.38 * stance.flat_length, 0.7 * half_width(spec), (top - bottom) / 2],
        pos=[(course.front + course.rear) / 2, 0.0, (top + bottom) / 2 - stance.com_height],
        contype=0, conaffinity=0, rgba=_CHASSIS,
    )  # fmt: skip


def _possible(about_x: float, about_y: float, about_z: float) -> tuple[float, float]:
    """Moments about x and z that go with the one about y: none more than the others' sum."""
    if about_x + about_z < about_y:
        about_z = about_y - about_x + 1e-9
    about_z = min(about_z, about_x + about_y)
    about_x = min(about_x, about_y + about_z)
    return about_x, about_z


def _add_view(scene: Any, course: Course) -> None:
    """Light, a camera beside the stairs, and picture sizes."""
    mujoco = engine()
    back, ahead = course.outline.reach
    reach = back + ahead
    scene.worldbody.add_light(
        pos=[course.x, -2.0, course.z + 4.0],
        dir=[0.2, 0.5, -1.0],
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
    )
    scene.worldbody.add_camera(
        name="side",
        pos=[course.x, -2.2 * reach - 0.6, course.z + 0.15 * reach],
        xyaxes=[1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        mode=mujoco.mjtCamLight.mjCAMLIGHT_FIXED,
    )
    scene.add_texture(
        name="sky", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT, rgb1=[0.93, 0.95, 0.97],
        rgb2=[0.75, 0.80, 0.86], width=64, height=384,
    )  # fmt: skip
    scene.visual.headlight.ambient = [0.35, 0.35, 0.35]
    scene.visual.global_.offwidth, scene.visual.global_.offheight = 1920, 1080
    scene.stat.center = [course.x, 0.0, course.z]
    scene.stat.extent = 2.0 * reach
