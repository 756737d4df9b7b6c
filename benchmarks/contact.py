"""Speed of the native contact kernel, warm, one core: poses, flights, a scan, many traverses."""

import argparse
import math
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))


from contact_cases import flight, scanned, stadium, steps
from kaidan import Robot
from kaidan.contact import STEP, Job, switch, traverse_many
from kaidan.contact.door import zeros
from kaidan.contact.layout import Journey, Margin, Pull
from kaidan.contact.scratch import path_scratch
from kaidan.contact.tables import body_table, ground_table
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile
from kaidan.traversal import traverse
from record import finish, options

G = 9.80665
KENAF = stadium(0.470, 0.196, 0.071, 0.06)
CALL = "call that does next to nothing, from Python [us]"
SETTLED, POSE = "settled pose from scratch, a call each [us]", "pose along a traverse [us]"
MOTION, EVERY = "flight of 12 steps, motion [ms]", "the same with every margin [ms]"
SCAN, MANY = "scan, 1 cm, 3 mm noise [ms]", "random traverse from Python [ms]"
POINTS = "growth of a traverse from 10^4 to 10^5 points [power]"
STEPS = "growth of a traverse from 300 to 3,000 steps [power]"
BASELINE = "plain numpy, dropped and turned, a pose [us]"
TARGETS = {CALL: 0.6, SETTLED: 1.2, POSE: 0.5, MOTION: 0.24, EVERY: 0.6, SCAN: 0.65, MANY: 0.3}
TARGETS |= {POINTS: 1.1, STEPS: 1.1}


def best(function, repeat):
    """Least time of several runs [s]."""
    times = []
    for _ in range(repeat):
        start = time.process_time()
        function()
        times.append(time.process_time() - start)
    return min(times)


def drop_and_rotate(terrain, parts, x):
    """The obvious baseline: sampled outline, dropped at 200 inclinations, best kept."""
    u = np.linspace(0, 1, 100)
    x1, z1, r1, x2, z2, r2 = parts[0]
    turn = np.linspace(np.pi, 2 * np.pi, 50)
    outline = np.concatenate(
        [
            np.stack([x1 + r1 * np.cos(turn), z1 + r1 * np.sin(turn)], 1),
            np.stack([x1 + u * (x2 - x1), z1 - r1 + u * (z2 - r2 - z1 + r1)], 1),
            np.stack([x2 + r2 * np.cos(turn), z2 + r2 * np.sin(turn)], 1),
        ]
    )
    lowest = (np.inf, 0.0)
    for phi in np.linspace(-1, 1, 200):
        c, s = np.cos(phi), np.sin(phi)
        px, pz = x + c * outline[:, 0] - s * outline[:, 1], s * outline[:, 0] + c * outline[:, 1]
        z = (np.interp(px, terrain[:, 0], terrain[:, 1]) - pz).max()
        lowest = min(lowest, (z, phi))
    return lowest


def dense(count, rng):
    """A flight of twelve steps with so many points, noise of 0.1 mm."""
    line = steps(0.178, 0.279, 12)
    along = np.r_[0.0, np.cumsum(np.abs(np.diff(line, axis=0)).sum(axis=1))]
    s = np.linspace(0.0, along[-1], count)
    x, z = (np.interp(s, along, each) for each in line.T)
    return np.stack([np.maximum.accumulate(x), z + 1e-4 * rng.normal(size=count)], 1)


def irregular(count, rng):
    """Low steps, each of its own."""
    x = np.cumsum(rng.uniform(0.14, 0.2, count))
    z = np.cumsum(rng.uniform(0.06, 0.09, count))
    faces = np.stack([np.repeat(x, 2), np.r_[0.0, np.repeat(z, 2)[:-1]]], 1)
    return np.vstack([[x[0] - 3.0, 0.0], faces, [x[-1] + 3.0, z[-1]]])


def growth(terrain_of, sizes, rng, outline):
    """Power of the size with which the time of a whole traverse grows."""
    times = []
    for size in sizes:
        profile = Profile.of_points(terrain_of(size, rng))
        times.append(best(lambda profile=profile: traverse(profile, outline).events, 2))
    return math.log(times[1] / times[0]) / math.log(sizes[1] / sizes[0])


def random_jobs(count, rng):
    """Terrains, robots and a job for each pair of them."""
    terrains, robots, jobs = [], [], []
    for k in range(count):
        L = rng.uniform(0.4, 0.9)
        angle, p = rng.uniform(0.4, 0.8), rng.uniform(0.15, 0.35)
        n = int(rng.integers(3, 8))
        terrains.append(flight(angle, p, n))
        robots.append(stadium(L, 0.45 * L, 0.2 * L, rng.uniform(0.05, 0.12)))
        jobs.append(Job(k, k, -1.0, (n - 1) * p * np.cos(angle) + 0.8, reference=angle))
    return terrains, robots, jobs


def kernel_figures(entries, rng, repeat=30):
    """Figures of the kernel."""
    log = path_scratch(8000)
    terrain = flight(np.radians(40), 0.15)
    scene = ground_table(terrain), body_table(KENAF)
    end = 11 * 0.15 * np.cos(np.radians(40)) + 0.8
    journey, pull = Journey(-1.0, end, 0.0, STEP, 0.2), Pull(0.0, G, 0.0)

    def motion(over=scene):
        return entries.drive(over, journey, pull, (*log, True))

    count = motion()[1]
    margins, rows = zeros(Margin, count), np.arange(count)

    def every_margin():
        motion()
        entries.pose_margins(scene, log.poses[:count], pull, margins)
        entries.flow_energy(scene, log.poses[:count], margins, rows)

    def settle_each():
        for each in x:
            entries.settle(scene, each, 0.3, 0.0)

    def call_each():
        for _ in x:
            entries.row_before(log.poses, -9.0)

    x = np.linspace(-0.5, 1.2, 2000).tolist()
    rough = ground_table(np.stack(scanned(terrain, rng), 1)), scene[1]
    whole = best(motion, repeat)
    return {
        CALL: 1e6 * best(call_each, repeat) / len(x),
        SETTLED: 1e6 * best(settle_each, repeat) / len(x),
        MOTION: 1e3 * whole,
        POSE: 1e6 * whole / count,
        EVERY: 1e3 * best(every_margin, repeat),
        SCAN: 1e3 * best(lambda: motion(rough), repeat),
    }


def main():
    chosen = options(argparse.ArgumentParser(description=__doc__)).parse_args()
    figures = kernel_figures(switch.kernel(), np.random.default_rng(0))
    rng = np.random.default_rng(1)
    terrains, robots, jobs = random_jobs(1000, rng)
    terrain = flight(np.radians(40), 0.15)
    figures[BASELINE] = 1e6 * best(lambda: drop_and_rotate(terrain, KENAF, 0.6), 3)
    figures[MANY] = 1e3 * best(lambda: traverse_many(terrains, robots, jobs), 3) / len(jobs)
    outline = Outline.of(Robot.named("kenaf"))
    figures[POINTS] = growth(dense, (10_000, 100_000), rng, outline)
    figures[STEPS] = growth(irregular, (300, 3000), rng, outline)
    finish(figures, chosen, TARGETS)


if __name__ == "__main__":
    main()
