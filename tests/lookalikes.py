"""Scenes without stairs, look-alikes most of all."""

import numpy as np

from scenes import Scene, clutter, person, turned


def _ground(rng):
    scene = Scene().box((-8, -8, -0.3), (8, 8, 0.0), kind="floor")
    if rng.random() < 0.6:
        scene.box((3.5, -4, -0.1), (3.7, 4, 3.0), kind="wall")
    if rng.random() < 0.4:
        scene.box((-2, 1.8, -0.1), (6, 2.0, 3.0), kind="wall")
    return scene


def shelves(rng):
    """Boards over each other, a back, sides; books or none."""
    scene = _ground(rng)
    deep, wide, step = rng.uniform(0.25, 0.5), rng.uniform(0.8, 2.0), rng.uniform(0.2, 0.4)
    for k in range(int(rng.integers(4, 8))):
        scene.box((0.5, -wide / 2, k * step), (0.5 + deep, wide / 2, k * step + 0.02))
        if rng.random() < 0.5:
            scene.box((0.55, -wide / 3, k * step), (0.5 + deep, 0.0, k * step + 0.6 * step))
    return scene.box((0.5 + deep, -wide / 2, 0), (0.52 + deep, wide / 2, 2.2))


def radiator(rng):
    scene = _ground(rng)
    pitch = rng.uniform(0.05, 0.2)
    for k in range(int(rng.integers(6, 20))):
        scene.box((0.6, -1 + k * pitch, 0.1), (0.75, -1 + k * pitch + 0.6 * pitch, 0.9))
    return scene


def louvres(rng):
    """Slats over each other, inclined."""
    scene = _ground(rng)
    pitch, tilt = rng.uniform(0.12, 0.3), rng.uniform(0.3, 0.9)
    for k in range(int(rng.integers(5, 12))):
        z = 0.2 + k * pitch
        scene.box(
            (0.6, -0.8, z), (0.6 + rng.uniform(0.1, 0.25), 0.8, z + 0.01), axes=turned(0, tilt)
        )
    return scene


def ladder(rng):
    """Rungs that lean at 65 to 80 degrees."""
    scene = _ground(rng)
    lean, pitch = np.radians(rng.uniform(65, 80)), rng.uniform(0.25, 0.32)
    for k in range(1, int(rng.integers(6, 11))):
        s, z = 0.6 + k * pitch * np.cos(lean), k * pitch * np.sin(lean)
        scene.box((s, -0.25, z - 0.02), (s + 0.04, 0.25, z + 0.02))
    return scene


def bleachers(rng):
    """Rows to sit on: steps of 0.35 to 0.45 m every 0.7 to 0.9 m."""
    scene = _ground(rng)
    rise, going = rng.uniform(0.35, 0.45), rng.uniform(0.7, 0.9)
    for k in range(int(rng.integers(3, 6))):
        scene.box((0.6 + k * going, -2, 0), (0.6 + (k + 1) * going, 2, (k + 1) * rise))
    return scene


def kerbs(rng):
    scene = _ground(rng)
    for k in range(int(rng.integers(1, 3))):
        scene.box((0.5 + k * rng.uniform(0.5, 1.5), -4, 0), (8, 4, 0.12 * (k + 1)))
    return scene


def battened_ramp(rng):
    scene = _ground(rng)
    slope, pitch = rng.uniform(0.15, 0.45), rng.uniform(0.25, 0.4)
    axes = turned(0, -slope)
    scene.boxes.append((np.array([1.5, 0, 0.0]), axes, np.array([2.0, 0.5, 0.02]), "ramp"))
    for k in range(9):
        at = np.array([1.5, 0, 0.0]) + axes @ np.array([-1.6 + k * pitch, 0, 0.03])
        scene.boxes.append((at, axes, np.array([0.02, 0.5, 0.015]), "batten"))
    return scene


def pallets(rng):
    scene = _ground(rng)
    for k in range(int(rng.integers(3, 9))):
        turn = turned(rng.normal(0, 0.05))
        x, y = rng.normal(0, 0.03, 2)
        scene.box(
            (0.6 + x, -0.6 + y, k * 0.144 + 0.1), (1.4 + x, 0.6 + y, k * 0.144 + 0.144), axes=turn
        )
        scene.box((0.7 + x, -0.5 + y, k * 0.144), (1.3 + x, 0.5 + y, k * 0.144 + 0.1), axes=turn)
    return scene


def hedge(rng):
    scene = _ground(rng)
    for _ in range(60):
        x, y, z = rng.uniform((0.5, -1.5, 0), (1.3, 1.5, 1.3))
        size = rng.uniform(0.03, 0.2, 3)
        axes = turned(*rng.uniform(-np.pi, np.pi, 3))
        scene.box((x, y, z), np.add((x, y, z), size), axes=axes)
    return scene


def rubble(rng):
    scene = _ground(rng)
    for _ in range(40):
        x, y = rng.uniform((-0.3, -1.5), (3, 1.5))
        size = rng.uniform(0.1, 0.5, 3)
        z = max(0.0, 0.4 * x - 0.2)
        axes = turned(*rng.uniform(-np.pi, np.pi, 3))
        scene.box((x, y, z - 0.2), np.add((x, y, z - 0.2), size), axes=axes)
    return scene


def ramp(rng):
    scene = _ground(rng)
    slope = rng.uniform(0.1, 0.6)
    scene.boxes.append(
        (np.array([1.5, 0, 0.3]), turned(0, -slope), np.array([2.0, 0.6, 0.1]), "ramp")
    )
    return scene


def room(rng):
    scene = clutter(_ground(rng), rng, int(rng.integers(0, 8)))
    if rng.random() < 0.5:
        person(scene, (rng.uniform(0, 1.5), rng.uniform(-1, 1), 0.0))
    for _ in range(int(rng.integers(0, 4))):
        x, y = rng.uniform((0, -2), (3, 2))
        size = rng.uniform(0.3, 1.5, 3)
        scene.box((x, y, 0), (x + size[0], y + size[1], size[2]), axes=turned(rng.uniform(0, 3)))
    return scene


def chairs(rng):
    """Rows of seats one behind the other on a level floor."""
    scene = _ground(rng)
    pitch = rng.uniform(0.7, 1.0)
    for k in range(4):
        s = 0.3 + k * pitch
        scene.box((s, -1.5, 0.40), (s + 0.42, 1.5, 0.45)).box(
            (s + 0.4, -1.5, 0.45), (s + 0.45, 1.5, 0.9)
        )
    return scene


KINDS = (
    shelves, radiator, louvres, ladder, bleachers, kerbs, battened_ramp, pallets, hedge, rubble,
    ramp, room, chairs,
)  # fmt: skip
