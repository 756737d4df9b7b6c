"""Speed of the contact model: public functions and the kernel under them, warm, one core.

Run ``python benchmarks/contact.py``; ``--plain`` times the uncompiled kernel instead.
"""

import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from contact_cases import flight, scanned, stadium
from kaidan.contact import STEP, body_table, ground_table, traverse_many
from kaidan.contact.compiling import kernel_module

COMPILE = "--plain" not in sys.argv
G = 9.80665
KENAF = stadium(0.470, 0.196, 0.071, 0.06)


def best(function, repeat=30 if COMPILE else 2):
    times = []
    for _ in range(repeat):
        start = time.perf_counter()
        function()
        times.append(time.perf_counter() - start)
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


def report(name, seconds, target, scale, unit):
    print(f"{name:58s} {seconds * scale:10.3f} {unit:3s}  target {target}")


def main():
    start = time.perf_counter()
    course = kernel_module("course", compile_kernel=COMPILE)
    margins_of = kernel_module("margins", compile_kernel=COMPILE)
    batch = kernel_module("batch", compile_kernel=COMPILE)
    terrain = flight(np.radians(40), 0.15)
    ground, body = ground_table(terrain), body_table(KENAF)
    tables = course.new_tables(8000)
    end = 11 * 0.15 * np.cos(np.radians(40)) + 0.8

    def motion(g=ground, x1=end):
        return course.drive(g, body, -1.0, x1, 0.0, STEP, 0.0, G, 0.2, *tables)

    count = motion()[1]
    table, found = margins_of.new_margins(count)

    def every_margin():
        margins_of.pose_margins(ground, body, tables[0], count, 0.0, G, 1e-9, table, found)
        margins_of.flow_energy(ground, body, tables[0], table, np.arange(count))

    every_margin()
    x = np.linspace(-0.5, 1.2, 2000 if COMPILE else 50)
    slope = np.full(len(x), 0.3)
    batch.settle_many(ground, body, x, slope, 0.0)
    rng = np.random.default_rng(0)
    terrains, robots, jobs = [], [], []
    for k in range(1000 if COMPILE else 10):
        L = rng.uniform(0.4, 0.9)
        angle, p = rng.uniform(0.4, 0.8), rng.uniform(0.15, 0.35)
        n = int(rng.integers(3, 8))
        terrains.append(flight(angle, p, n))
        robots.append(stadium(L, 0.45 * L, 0.2 * L, rng.uniform(0.05, 0.12)))
        jobs.append([k, k, -1.0, (n - 1) * p * np.cos(angle) + 0.8, 0.0, 0.0, 0.2, angle])
    traverse_many(terrains[:1], robots[:1], jobs[:1], compile_kernel=COMPILE)
    print(
        f"ready after {time.perf_counter() - start:.2f} s (first time: compiling; else the cache)"
    )

    each = best(lambda: batch.settle_many(ground, body, x, slope, 0.0)) / len(x)
    report("one settled pose from scratch", each, "3 us", 1e6, "us")
    baseline = best(lambda: drop_and_rotate(terrain, KENAF, 0.6), 3)
    report("  plain numpy drop-and-rotate, for comparison", baseline, "-", 1e6, "us")
    whole = best(motion)
    report(f"12-step flight with landings, motion ({count} poses)", whole, "0.3 ms", 1e3, "ms")
    report("  a pose", whole / count, "0.5 us", 1e6, "us")
    report(
        "12-step flight, every margin at every pose", best(every_margin) + whole, "1 ms", 1e3, "ms"
    )
    x_scan, z_scan = scanned(terrain, rng)
    rough = ground_table(np.stack([x_scan, z_scan], 1))
    status = motion(rough, end)
    rough_time = best(lambda: motion(rough, end))
    report(
        f"1 cm scan, 3 mm noise ({status[1]} poses, status {status[0]})",
        rough_time,
        "1 ms",
        1e3,
        "ms",
    )
    many = best(lambda: traverse_many(terrains, robots, jobs, compile_kernel=COMPILE), 3)
    report(f"{len(jobs)} random traverses from Python", many, "1 s for 1,000", 1.0, "s")


if __name__ == "__main__":
    main()
