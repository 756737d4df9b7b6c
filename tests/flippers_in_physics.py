"""A whole traverse in MuJoCo, flippers moved on the way, belts smooth or with bars that run round.

The trials of `kaidan.physics` hold flippers at an angle. Here the robot stops where its plan says
so, its flippers turn while it stands, and it drives on; the bars are the grousers of the main track
and of the flippers, carried round by the belt. What is the robot's from the contact model: its
parts in a posture, and where it stops. What it does then is MuJoCo's.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from kaidan.contact import BELLY
from kaidan.models import planned
from kaidan.models.planned import stages_of, stop
from kaidan.outline import Outline
from kaidan.physics.belts import add_belts, lanes_of, rounded
from kaidan.physics.engine import engine, quiet
from kaidan.physics.model import ROBOT, model_of
from kaidan.physics.simulation import Simulation
from kaidan.physics.spec import TrialSpec
from kaidan.robot import Posture
from kaidan.traversal.moves import angles_of

TURNS = math.radians(20.0)
"""Speed at which flippers turn [rad/s]."""
FINE = math.radians(1.0)
"""Turn of a flipper from one drawn shape to the next; between them it is interpolated [rad]."""
PAUSE = 0.5
"""Time before and after a change of posture [s]."""
PATIENCE = 2.5
"""Times the time that it takes, after which it is stuck or slides for good."""
CONTACT_TIME = {False: 0.002, True: 0.01}
"""Of the contacts of smooth belts, and of bars [s]. What is softer is pressed in as it lands: after
a drop of 28 deg a robot turned 0.6 deg farther with 2 ms, 1.0 with 4, 1.5 with 10, 1.8 with 20."""
FALLEN = math.radians(45.0)
"""Inclination beyond that of the stairs, or beyond level, from which it has fallen [rad]."""
STANDS = math.radians(35.0)
"""Inclination up to which it stands on the landing, its flippers as they are [rad]."""
ALONG = 2e-3
"""Distance of the points of a belt's line [m]."""


class Shape(NamedTuple):
    """Robot in a posture, in the frame of the posture in which it begins."""

    pos: np.ndarray
    quat: np.ndarray
    size: np.ndarray
    """Of each geom of the belts, in the order of their names."""
    lines: list[tuple[np.ndarray, np.ndarray]]
    """Of each belt: points [m] and direction of the outward normal [rad], as the belt runs."""
    centroid: np.ndarray
    """[m]"""
    inertia: float
    """About the lateral axis through the centroid [kg m^2]."""


class Ride(NamedTuple):
    """How a traverse went."""

    outcome: str
    """arrives, falls or stays."""
    x: np.ndarray
    """Of the centroid, each 20 ms [m]."""
    inclination: np.ndarray
    """[rad]"""
    stage: np.ndarray
    """Number of the posture in which it drives; -1: while it stands and the flippers turn."""
    slip: float
    """How much further the belt ran than the robot drove [m]."""


def outline_of(question, posture):
    body = Outline.of(question.robot, posture, question.payload)
    return body if question.facing == "nose-first" else body.turned_round()


def belt_line(part):
    """Line of a belt as it runs, clockwise with x ahead and z up, and its outward normals.

    Its underside runs backward. The hull of two discs has two straight parts and two arcs.
    """
    part = rounded(part)
    c1, r1, c2, r2 = part[0:2], part[2], part[3:5], part[5]
    along = c2 - c1
    apart = float(np.hypot(*along))
    # one disc within the other: its circle alone
    k = math.acos(min(1.0, max(-1.0, (r1 - r2) / apart))) if apart else 0.0
    e = math.atan2(along[1], along[0])
    points, normals = [], []

    def straight(start, end, angle):
        out = np.array([math.cos(angle), math.sin(angle)])
        one, two = start[0] + start[1] * out, end[0] + end[1] * out
        for share in np.arange(0.0, 1.0, ALONG / max(ALONG, math.dist(one, two))):
            points.append(one + share * (two - one))
            normals.append(angle)

    def arc(centre, r, first, last):
        turn = (first - last) % (2 * math.pi)
        for share in np.arange(0.0, 1.0, ALONG / max(ALONG, r * turn)):
            angle = first - share * turn
            points.append(centre + r * np.array([math.cos(angle), math.sin(angle)]))
            normals.append(angle)

    if apart <= abs(r1 - r2) + 1e-9:
        centre, r = (c1, r1) if r1 >= r2 else (c2, r2)
        arc(centre, r, e, e - math.pi)
        arc(centre, r, e - math.pi, e)
        return np.array(points), np.unwrap(np.array(normals))
    straight((c1, r1), (c2, r2), e + k)
    arc(c2, r2, e + k, e - k)
    straight((c2, r2), (c1, r1), e - k)
    arc(c1, r1, e - k, e + k)
    return np.array(points), np.unwrap(np.array(normals))


class Rig:
    """A question's robot on its stairs in MuJoCo."""

    def __init__(self, question, *, speed, bars=False, seed=0, radius=0.0):
        self.question, self.bars = question, bars
        self.stages = [posture for _, posture in stages_of(question)]
        first = question.changed(
            posture=self.stages[0], changes=(), speed=speed, flipper_tolerance=0.0
        )
        self.spec = TrialSpec(
            question=first,
            begin="landing",
            seed=seed,
            contact_time=CONTACT_TIME[bars],
            nosing_radius=radius,
        )
        with quiet():
            model = model_of(self.spec)
            self.origin = outline_of(question, self.stages[0]).parts[0, :2]
            driven = np.flatnonzero(model.field.any(axis=1)).tolist()
            names = [model.compiled.geom(k).name for k in driven]
            body = model.scene.body(ROBOT)
            if bars:
                self._add_bars(body, self.shape(self.stages[0]))
            # parts move within their body, and what is sorted by its place would not find them
            never = engine().mjtDisableBit.mjDSBL_MIDPHASE
            model.scene.option.disableflags |= int(never)
            compiled = model.scene.compile()
            # nor is what lies like its body now to stay so
            compiled.geom_sameframe[:], compiled.body_sameframe[:] = 0, 0
        field = np.zeros((compiled.ngeom, 6))
        for name in names:
            field[compiled.geom(name).id] = model.field[model.compiled.geom(name).id]
        self.ids = np.array([compiled.geom(name).id for name in names])
        self.sim = Simulation(
            model._replace(compiled=compiled, field=field, number_of=np.full(compiled.ngeom, -2))
        )
        poses = planned.drive(question).parts[0].traverse.path.poses
        lift = self.height if bars else 0.0  # nothing of it is in the floor at the start
        start = poses.x[0], poses.z[0] + lift, poses.inclination[0]
        self.sim.data.qpos[self.sim.joints[0]] = start
        if bars:
            self.bar_ids = np.array([compiled.geom(name).id for name in self.bar_names])
        self.run = 0.0
        self.take(self.shape(self.stages[0]))

    def _add_bars(self, body, shape):
        track = self.question.robot.track
        self.height, spacing = track.grouser_height, track.grouser_spacing
        self.bar_names, self.bar_places = [], []
        half = lanes_of(self.spec)[0].half_width
        phase = self.spec.drawn()[1]
        for k, (points, _) in enumerate(shape.lines):
            length = len(points) * ALONG
            count = max(4, round(length / spacing))
            self.bar_places.append((np.arange(count) + phase) * length / count)
            for n in range(count):
                name = f"bar{k}_{n}"
                self.bar_names.append(name)
                body.add_geom(
                    name=name,
                    type=engine().mjtGeom.mjGEOM_CAPSULE,
                    size=[self.height, half, 0.0],
                    pos=[1e-3 * (n + 1), 0.0, 0.0],
                    quat=[math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0],
                    contype=2,
                    conaffinity=1,
                    condim=3,
                    friction=[self.spec.static_friction, 0.0, 0.0],
                    solref=[self.spec.softness, 1.0],
                    surfacevel=[1e-9, 0.0, 0.0, 0.0, 0.0, 0.0],
                )

    def shape(self, posture):
        """Robot in a posture."""
        outline = outline_of(self.question, posture)
        scene = engine().MjSpec()
        body = scene.worldbody.add_body(name="b")
        names = list(add_belts(body, self.spec, outline.parts, outline.kinds, {}))
        compiled = scene.compile()
        ids = [compiled.geom(name).id for name in names]
        move = self.origin - outline.parts[0, :2]
        pos = compiled.geom_pos[ids] + [move[0], 0.0, move[1]]
        lines = []
        for part, kind in zip(outline.parts, outline.kinds, strict=True):
            if kind != BELLY:
                points, normals = belt_line(part)
                lines.append((points + move, normals))
        mass = self.spec.mass()[0]
        return Shape(
            pos,
            compiled.geom_quat[ids].copy(),
            compiled.geom_size[ids].copy(),
            lines,
            move,
            mass * outline.gyration**2,
        )

    def take(self, shape):
        """Put the robot into a shape."""
        compiled = self.sim.compiled
        compiled.geom_pos[self.ids] = shape.pos
        compiled.geom_quat[self.ids] = shape.quat
        compiled.geom_size[self.ids] = shape.size
        compiled.body_ipos[self.sim.body] = [shape.centroid[0], 0.0, shape.centroid[1]]
        compiled.body_inertia[self.sim.body][1] = shape.inertia
        self.now = shape
        self.place_bars(0.0)

    def place_bars(self, speed):
        """Bars where the belt has them, and their speed."""
        if not self.bars:
            return
        compiled, at = self.sim.compiled, 0
        for (points, normals), places in zip(self.now.lines, self.bar_places, strict=True):
            count, ids = len(points), self.bar_ids[at : at + len(places)]
            at += len(places)
            s = ((places + self.run) / ALONG) % count
            k, share = s.astype(int), (s % 1.0)[:, None]
            on = points[k] * (1 - share) + points[(k + 1) % count] * share
            angle = normals[k]
            out = np.column_stack([np.cos(angle), np.sin(angle)])
            # half-round: the axis on the belt, as high as their radius; no flank is undercut
            compiled.geom_pos[ids, 0], compiled.geom_pos[ids, 2] = on[:, 0], on[:, 1]
            # the capsule's frame: its y is the body's -z, as it was added
            compiled.geom_surfacevel[ids, 0] = speed * out[:, 1]
            compiled.geom_surfacevel[ids, 1] = speed * out[:, 0]

    def centroid(self):
        """x [m], and inclination [rad]."""
        x, _ = self.sim.point(*self.now.centroid)
        return x, self.sim.pose()[2]

    def step(self, speed, count):
        """Advance, the belts at a speed."""
        sim, dt = self.sim, self.spec.step
        field = sim.model.field
        sim.compiled.geom_surfacevel[self.ids] = field[self.ids] * speed
        if not self.bars:
            sim.mujoco.mj_step(sim.compiled, sim.data, count)
            self.run += speed * dt * count
            return
        for _ in range(count):
            self.place_bars(speed)
            sim.mujoco.mj_step(sim.compiled, sim.data)
            self.run += speed * dt

    def ride(self):
        """Drive from landing to landing."""
        question, course = self.question, self.sim.course
        phases = [phase for phase, _ in stages_of(question)]
        stops = [stop(question, question.profile, each) for each in phases[1:]]
        speed, rows, driven = self.spec.speed, [], 0.0
        self.most = (min(0.0, course.slope) - FALLEN, max(0.0, course.slope) + FALLEN)
        count = round(0.02 / self.spec.step)
        rear_tip = self.origin[0]  # rear axle of the main track
        for _ in range(round(0.6 / 0.02)):
            self.step(0.0, count)
        for k in range(len(self.stages)):
            x0 = self.centroid()[0]
            until = stops[k] if k < len(stops) else None
            end = course.goal_x - rear_tip if until is None else until
            limit = PATIENCE * max(0.2, (end - x0) / math.cos(course.slope)) / speed + 2.0
            time, v = 0.0, 0.0
            while True:
                v = min(speed, v + speed * 0.1)
                self.step(v, count)
                time += 0.02
                driven += self.sim.velocity() * 0.02
                x, phi = self.centroid()
                rows.append((x, phi, k))
                if not self.most[0] <= phi <= self.most[1] or self.sim.diverged():
                    return self.told("falls", rows, driven)
                gone = self.sim.point(rear_tip, 0.0)[0] >= course.goal_x if until is None else False
                if gone and abs(phi) < STANDS:
                    break
                if until is not None and x >= until:
                    break
                if time > limit:
                    return self.told("stays", rows, driven)
            if k + 1 < len(self.stages) and not self.change(k, rows, count):
                return self.told("falls", rows, driven)
        return self.told("arrives", rows, driven)

    def change(self, k, rows, count):
        """Turn the flippers while it stands; whether it still does."""
        robot = self.question.robot
        was, new = (angles_of(robot, each) for each in self.stages[k : k + 2])
        turn = max(abs(new[end] - was[end]) for end in was)
        number = max(1, math.ceil(turn / FINE))
        shapes = [
            self.shape(Posture(**{e: was[e] + (new[e] - was[e]) * j / number for e in was}))
            for j in range(number + 1)
        ]
        self.hold(PAUSE, rows, count)
        each = max(1, round(turn / number / TURNS / self.spec.step / 5))
        for one, two in pairwise(shapes):
            for j in range(1, 6):
                self.take(between(one, two, j / 5))
                self.step(0.0, each)
            rows.append((*self.centroid(), -1))
            if not self.most[0] <= rows[-1][1] <= self.most[1]:
                return False
        return self.hold(PAUSE, rows, count)

    def hold(self, time, rows, count):
        for _ in range(round(time / 0.02)):
            self.step(0.0, count)
            rows.append((*self.centroid(), -1))
        return self.most[0] <= rows[-1][1] <= self.most[1]

    def told(self, outcome, rows, driven):
        x, phi, stage = np.array(rows).T
        return Ride(outcome, x, phi, stage.astype(int), self.run - driven)


def between(one, two, share):
    """Shape between two that differ little."""

    def mixed(a, b):
        return a + share * (b - a)

    sign = np.sign((one.quat * two.quat).sum(axis=1, keepdims=True))
    quat = mixed(one.quat, sign * two.quat)
    lines = [
        (mixed(p[: len(q)], q[: len(p)]), mixed(a[: len(b)], b[: len(a)]))
        for (p, a), (q, b) in zip(one.lines, two.lines, strict=True)
    ]
    return Shape(
        mixed(one.pos, two.pos),
        quat / np.linalg.norm(quat, axis=1, keepdims=True),
        mixed(one.size, two.size),
        lines,
        mixed(one.centroid, two.centroid),
        mixed(one.inertia, two.inertia),
    )
