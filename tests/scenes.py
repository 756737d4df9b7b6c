"""Scenes with and without stairs, and sensors that see them: the truth is known to the micrometre.

A scene is a list of boxes that lie as they like; a sensor casts rays at them. Nothing here knows
how a cloud is interpreted.
"""

from dataclasses import dataclass, field

import numpy as np


def turned(z=0.0, y=0.0, x=0.0):
    """Rotation about z after y after x [rad]."""
    c, s = np.cos([z, y, x]), np.sin([z, y, x])
    about_z = np.array([[c[0], -s[0], 0], [s[0], c[0], 0], [0, 0, 1]])
    about_y = np.array([[c[1], 0, s[1]], [0, 1, 0], [-s[1], 0, c[1]]])
    about_x = np.array([[1, 0, 0], [0, c[2], -s[2]], [0, s[2], c[2]]])
    return about_z @ about_y @ about_x


@dataclass
class Scene:
    """Boxes, each with its middle, its axes and its half sides."""

    boxes: list = field(default_factory=list)

    def box(self, low, high, *, axes=None, kind="thing"):
        """Add a box from one corner to the other, then turned about its middle."""
        low, high = np.array(low, float), np.array(high, float)
        axes = np.eye(3) if axes is None else axes
        self.boxes.append(((low + high) / 2, axes, (high - low) / 2, kind))
        return self

    def cast(self, origin, directions):
        """Distance along each direction to the first box, infinite where there is none."""
        best = np.full(len(directions), np.inf)
        which = np.full(len(directions), -1)
        with np.errstate(divide="ignore", invalid="ignore"):
            for number, (middle, axes, half, _) in enumerate(self.boxes):
                start = axes.T @ (origin - middle)
                along = directions @ axes
                one, other = (-half - start) / along, (half - start) / along
                near = np.minimum(one, other).max(axis=1)
                far = np.maximum(one, other).min(axis=1)
                hit = (near > 1e-6) & (near <= far) & (near < best)
                best[hit], which[hit] = near[hit], number
        return best, which


@dataclass
class Flight:
    """Truth: nosings along x from the first one at the origin, the floor at z = 0."""

    rises: tuple
    goings: tuple
    width: float = 1.0

    @property
    def nosings(self):
        return np.column_stack([np.cumsum([0.0, *self.goings]), np.cumsum(self.rises)])

    @property
    def spacing(self):
        return float(np.hypot(*(self.nosings[-1] - self.nosings[0])) / (len(self.rises) - 1))

    @property
    def angle(self):
        across, up = self.nosings[-1] - self.nosings[0]
        return float(np.arctan2(up, across))


def regular(steps=8, rise=0.17, going=0.28, first=None, last=None, width=1.0):
    rises = [rise] * steps
    rises[0] = rise if first is None else first
    rises[-1] = rise if last is None else last
    return Flight(tuple(rises), (going,) * (steps - 1), width)


def with_stairs(flight, landing=1.5, axes=None, at=(0.0, 0.0, 0.0), scene=None, floor=True):
    """Solid stairs that climb along x, their landing, and the floor before them."""
    scene = Scene() if scene is None else scene
    axes, at = np.eye(3) if axes is None else axes, np.array(at)
    half, nosings = flight.width / 2, flight.nosings
    ends = [*nosings[1:, 0], nosings[-1, 0] + landing]

    def placed(low, high, kind):
        low, high = np.array(low, float), np.array(high, float)
        middle = at + axes @ ((low + high) / 2)
        scene.boxes.append((middle, axes, (high - low) / 2, kind))

    for (s, z), end in zip(nosings, ends, strict=True):
        placed((s, -half, -0.2), (end, half, z), "stairs")
    if floor:
        scene.box((-8, -8, -0.3), (8, 8, 0.0), kind="floor")
    return scene


def half_turn(flight, well=0.1, depth=1.2):
    """Two flights side by side, the second one back from the landing of the first."""
    scene = with_stairs(flight, landing=depth)
    top_s, top_z = flight.nosings[-1]
    aside = flight.width + well
    scene.box(
        (top_s, -flight.width / 2, top_z - 0.2), (top_s + depth, aside + flight.width / 2, top_z)
    )
    back = turned(np.pi)
    return with_stairs(
        flight, landing=1.0, axes=back, at=(top_s, aside, top_z), scene=scene, floor=False
    )


def directions(columns, rows, wide, high, pitch, heading=0.0):
    """Rays of a camera that looks along x, turned up by `pitch`, shape (rows * columns, 3)."""
    u = np.linspace(-1, 1, columns) * np.tan(wide / 2)
    v = np.linspace(1, -1, rows) * np.tan(high / 2)
    u, v = np.meshgrid(u, v)
    rays = np.stack([np.ones_like(u), -u, v], axis=-1).reshape(-1, 3)
    rays /= np.linalg.norm(rays, axis=1)[:, None]
    return rays @ turned(heading, -pitch).T


def beams(count=64, columns=1024, low=-0.436, high=0.262):
    """Rays of a spinning LiDAR."""
    up, around = np.meshgrid(np.linspace(low, high, count), np.linspace(-np.pi, np.pi, columns))
    up, around = up.ravel(), around.ravel()
    return np.column_stack([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])


@dataclass
class Seen:
    """A cloud as a sensor gives it, and what is true of it."""

    xyz: np.ndarray
    grid: tuple | None
    viewpoint: np.ndarray
    tilt: float
    """Angle by which gravity is off [rad]."""
    turn: np.ndarray = field(default_factory=lambda: np.eye(3))
    """Rotation of the scene into the frame of the cloud: its first column is the heading of the
    first flight, its last one is up."""


def seen(
    scene,
    rng,
    *,
    sensor="camera",
    height=1.2,
    away=1.8,
    noise=0.003,
    bias=0.0,
    tilt=0.0,
    ripple=0.0,
    smooth=np.inf,
    double=0.0,
    aside=0.0,
    look=0.0,
    from_top=None,
    reach=6.0,
    image=(240, 180),
):
    """Cloud of a scene.

    `height` above the floor and `away` before the first nosing say where the sensor stands;
    `from_top` = (s, z) instead, looking down the stairs. `bias` is the error of the range as a
    share of it, `ripple` that which differs from one direction to another, `smooth` the range from
    which steps become a plane, `double` the offset of a second surface, as a drifting map has it.
    """
    poses = [(-away, aside, height, 0.0)]
    if from_top is not None:
        poses = [(from_top[0], aside, from_top[1], np.pi)]
    if sensor == "phone":
        x, y, z, heading = poses[0]
        ahead = 1.0 if from_top is None else -1.0
        poses = [
            (x + ahead * 0.35 * k, y + 0.15 * (-1) ** k, z + 0.12 * k, heading) for k in range(5)
        ]
    clouds = []
    for number, (x, y, z, heading) in enumerate(poses):
        origin = np.array([x, y, z])
        pitch = look - (0.35 if from_top is not None else 0.12 * (z > 0.8))
        if sensor == "camera":
            grid, rays = image[::-1], directions(*image, 1.2, 0.95, pitch, heading)
        elif sensor == "lidar":
            grid, rays = None, beams()
        else:
            grid, rays = None, directions(96, 128, 0.9, 1.15, pitch, heading)
        ranges, which = scene.cast(origin, rays)
        good = ranges < (reach if sensor != "lidar" else 20.0)
        true = origin + rays * np.where(good, ranges, 0.0)[:, None]
        if np.isfinite(smooth):
            true = _smoothed(scene, true, which, ranges > smooth)
            ranges = np.where(good, np.linalg.norm(true - origin, axis=1), np.inf)
            with np.errstate(invalid="ignore"):
                rays = np.where(good[:, None], (true - origin) / ranges[:, None], rays)
        off = rng.normal(0, noise, len(rays))
        wave = rng.normal(0, 9, (3, 3)), rng.uniform(0, 2 * np.pi, 3)
        waves = np.cos(rays @ wave[0] + wave[1]).sum(axis=1) * np.sqrt(2 / 3)
        measured = np.where(good, ranges * (1 + bias + ripple * waves) + off, 0.0)
        cloud = origin + rays * measured[:, None]
        if double and number % 2 == 0:
            shifted = rng.random(len(cloud)) < 0.5
            cloud = cloud + np.where(shifted[:, None], double, 0.0) * np.array([0.6, 0.0, 0.8])
        cloud[~good] = np.nan
        clouds.append(cloud)
    xyz = np.vstack(clouds)
    viewpoint = np.array(poses[0][:3])
    turn = turned(rng.uniform(-np.pi, np.pi))
    about = rng.uniform(-np.pi, np.pi)
    axis = np.array([np.cos(about), np.sin(about), 0.0])
    cross = np.array([[0, 0, axis[1]], [0, 0, -axis[0]], [-axis[1], axis[0], 0]])
    tilted = np.eye(3) + np.sin(tilt) * cross + (1 - np.cos(tilt)) * cross @ cross
    turn = tilted @ turn
    xyz = (xyz - viewpoint) @ turn.T
    if grid is None:
        xyz = xyz[np.isfinite(xyz).all(axis=1)]
    return Seen(xyz, grid, np.zeros(3), tilt, turn)


def _smoothed(scene, points, which, far):
    """Points of stairs beyond the reach of a phone, put onto the plane through mid-steps."""
    kinds = np.array([box[3] for box in scene.boxes] + ["none"])
    on = far & (kinds[which] == "stairs")
    if not on.any():
        return points
    tops = [(box[0][0] - box[2][0], box[0][2] + box[2][2]) for box in scene.boxes
            if box[3] == "stairs"]  # fmt: skip
    (s0, z0), (s1, z1) = tops[0], tops[-1]
    slope = (z1 - z0) / (s1 - s0)
    points = points.copy()
    points[on, 2] = z0 + slope * (points[on, 0] - s0) - slope * 0.14
    return points


def walls(scene, flight, side="both", long=6.0, tall=3.0):
    half = flight.width / 2
    for sign, name in ((1, "left"), (-1, "right")):
        if side in ("both", name):
            low, high = sorted((sign * (half + 0.01), sign * (half + 0.2)))
            scene.box((-2.5, low, -0.1), (long, high, tall + 2), kind="wall")
    return scene


def handrail(scene, flight):
    start, end = flight.nosings[0], flight.nosings[-1]
    length, angle = float(np.hypot(*(end - start))), flight.angle
    middle = (start + end) / 2
    y = flight.width / 2 - 0.05
    scene.boxes.append(
        (
            np.array([middle[0], y, middle[1] + 0.9]),
            turned(0, -angle),
            np.array([length / 2, 0.02, 0.02]),
            "rail",
        )
    )
    for s, z in flight.nosings[::3]:
        scene.box((s + 0.1, y - 0.015, z), (s + 0.13, y + 0.015, z + 0.9), kind="rail")
    return scene


def person(scene, at=(-0.4, 0.3, 0.0)):
    x, y, z = at
    for dy in (-0.1, 0.1):
        scene.box((x - 0.07, y + dy - 0.06, z), (x + 0.07, y + dy + 0.06, z + 0.85), kind="person")
    scene.box((x - 0.12, y - 0.22, z + 0.85), (x + 0.12, y + 0.22, z + 1.5), kind="person")
    return scene


def clutter(scene, rng, count=5):
    for _ in range(count):
        size = rng.uniform(0.05, 0.3, 3)
        x, y = rng.uniform(-1.6, -0.5), rng.uniform(-1.2, 1.2)
        axes = turned(rng.uniform(-np.pi, np.pi))
        scene.box((x, y, 0), (x + size[0], y + size[1], size[2]), axes=axes, kind="clutter")
    return scene
