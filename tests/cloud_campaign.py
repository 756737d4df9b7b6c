"""Clouds of many scenes against their truth: what is found, how far off, and how surely."""

from collections import defaultdict
from dataclasses import dataclass, field

import numpy as np

import kaidan
import lookalikes
import scenes
from kaidan import Stairs
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter
from kaidan.readers.kinds import Known, Points, Provenance

SENSORS = ("camera", "lidar", "phone")
BIAS, RIPPLE, LEAN = 0.005, 0.0015, np.radians(0.3)
"""Standard deviations of what the reader takes for granted where nobody states it: the scale of
the range, what of it differs from nosing to nosing, and how far buildings are out of true [rad]."""


def cloud(seen, up="+z"):
    known = Provenance("made", "", "pcd", unit=Known("m", "file"), up=up and Known(up, "file"))
    return Points(seen.xyz, known, seen.grid, seen.viewpoint)


@dataclass
class Case:
    """A flight, how it was seen, and what of it."""

    truth: scenes.Flight
    lean: float
    noise: float
    sensor: str
    seen: scenes.Seen
    top: bool
    bias: float

    @property
    def nosings(self):
        """True (s, z), the building out of true included."""
        c, s = np.cos(self.lean), np.sin(self.lean)
        return self.truth.nosings @ np.array([[c, s], [-s, c]])


def case(number, most_noise=0.01, image=(240, 180)):
    """Scene with stairs: 4 to 20 steps, odd first and last risers, and what stands about."""
    rng = np.random.default_rng(number)
    sensor = SENSORS[number % 3]
    top = sensor != "lidar" and rng.random() < 0.2
    rise, going = rng.uniform(0.14, 0.20), rng.uniform(0.24, 0.32)
    odd = [rise + rng.choice([0.0, 0.0, -0.03, 0.02]) for _ in range(2)]
    steps = int(rng.integers(4, 21 if rng.random() < 0.3 else 13))
    truth = scenes.regular(steps, rise, going, *odd, width=rng.uniform(0.8, 1.5))
    scene = scenes.with_stairs(truth)
    if rng.random() < 0.5:
        scenes.walls(scene, truth, side=rng.choice(["both", "left", "right"]))
    for chance, add in (
        (0.3, lambda: scenes.handrail(scene, truth)),
        (0.3, lambda: scenes.person(scene)),
        (0.3, lambda: scenes.clutter(scene, rng)),
    ):
        if rng.random() < chance:
            add()
    noise = rng.uniform(0.002, most_noise)
    pose = {"height": rng.choice([0.5, 1.2]), "away": rng.uniform(1.2, 2.2)}
    end = truth.nosings[-1]
    if top:
        place = (end[0] + rng.uniform(0.1, 0.5), end[1] + rng.uniform(0.5, 1.2))
        pose |= {"from_top": place, "look": -0.35}
    bias = rng.normal(0, BIAS)
    seen = scenes.seen(
        scene, rng, sensor=sensor, noise=noise, bias=bias, ripple=RIPPLE,
        tilt=np.radians(rng.uniform(0, 3)), image=image, **pose,
    )  # fmt: skip
    return Case(truth, rng.normal(0, LEAN), noise, sensor, seen, top, bias)


@dataclass
class Tally:
    """Errors and errors over their standard uncertainty, by quantity; and what went wrong."""

    errors: dict = field(default_factory=lambda: defaultdict(list))
    ratios: dict = field(default_factory=lambda: defaultdict(list))
    widths: dict = field(default_factory=lambda: defaultdict(list))
    failures: list = field(default_factory=list)
    refusals: list = field(default_factory=list)
    partial: int = 0
    count: int = 0

    def add(self, name, error, sigma):
        self.errors[name].append(error)
        self.ratios[name].append(error / sigma)
        self.widths[name].append(2 * 1.96 * sigma)

    def row(self, name):
        """Count, rms of z, share within 1.96 sigma, largest z, RMSE, median width over RMSE."""
        z, e = np.array(self.ratios[name]), np.array(self.errors[name])
        rmse = float(np.sqrt(np.mean(e**2)))
        return (
            len(z), float(np.sqrt(np.mean(z**2))), float(np.mean(np.abs(z) < 1.96)),
            float(np.abs(z).max()), rmse, float(np.median(self.widths[name])) / rmse,
        )  # fmt: skip


def judge(number, tally, most_noise=0.01):
    """Interpret one scene and tally it."""
    made = case(number, most_noise)
    found = interpreter.found(cloud(made.seen), Hints())
    tally.count += 1
    if not found.staircases:
        tally.refusals.append((number, found.refusals[0].why, made.noise))
        return
    flight = found.staircases[0].flights[0]
    true, line = made.nosings, flight.line()
    n, m = len(true), len(line)
    several = len(found.staircases) + len(found.staircases[0].flights) > 2
    # what the flight lacks must be what its answer says was not seen
    says = not flight.begins or flight.run_up < 1.2 * flight.regular.going or not flight.ends
    if several or m > n or (m < n and not says):
        tally.failures.append((number, "several" if several else f"{m} of {n} nosings"))
        return
    spacing = np.hypot(made.truth.rises[1], made.truth.goings[0])
    if m < n:
        tally.partial += 1
        tally.add("spacing", flight.regular.spacing - spacing, flight.spacing_sigma)
        return
    covariance = flight.full_covariance().reshape(n, 2, n, 2)
    off = line - true
    for k in range(n - 1):
        step = (
            covariance[k + 1, :, k + 1] + covariance[k, :, k]
            - covariance[k + 1, :, k] - covariance[k, :, k + 1]
        )  # fmt: skip
        error = off[k + 1] - off[k]
        tally.add("going", error[0], np.sqrt(step[0, 0]))
        last = k == n - 2
        if not last or flight.ends:
            tally.add("last rise" if last else "rise", error[1], np.sqrt(step[1, 1]))
    if flight.begins:
        tally.add("first rise", off[0, 1], np.sqrt(covariance[0, 1, 0, 1]))
    chord = true[n - 2] - true[0]
    length = np.hypot(*chord)
    along = chord / length
    across = np.array([-along[1], along[0]])
    spread = (
        covariance[n - 2, :, n - 2] + covariance[0, :, 0]
        - covariance[n - 2, :, 0] - covariance[0, :, n - 2]
    )  # fmt: skip
    error = off[n - 2] - off[0]
    tally.add("spacing", error @ along / (n - 2), np.sqrt(along @ spread @ along) / (n - 2))
    angle = np.degrees(np.sqrt(across @ spread @ across) / length)
    tally.add("angle_deg", np.degrees(error @ across / length), angle)


ROBOTS = (("ozbot-atr", "stowed"), ("absolem", "flat"), ("superdroid-hd2", "stowed"))
FRICTIONS = (0.5, 0.65, 0.8, 1.0, 1.2)


def verdicts(number, most_noise=0.01):
    """Of each robot: verdict of the truth, that of the cloud, and P(fail) of the cloud.

    Robots, allowances and friction are exact, so that only the cloud is in doubt. Nothing where
    the cloud does not show all of the nosings.
    """
    made = case(number, most_noise)
    found = interpreter.found(cloud(made.seen), Hints())
    true = made.nosings
    if not found.staircases or len(found.staircases[0].flights[0]) != len(true):
        return []
    steps = np.diff(true, axis=0, prepend=0.0)
    truth = Stairs(name="truth", rises=tuple(steps[:, 1]), goings=tuple(steps[1:, 0]))
    (read,) = found.staircases[0].stairs()
    rng = np.random.default_rng(number)
    each = []
    for name, flippers in ROBOTS:
        how = {"flippers": flippers, "friction": float(rng.choice(FRICTIONS))}
        how |= {"theta_d": "1.3deg", "theta_M": "1.3deg"}
        answers = [kaidan.assess(name, stairs, **how) for stairs in (truth, read)]
        each.append((*(answer.verdict for answer in answers), answers[1].failure_probability))
    return each


def lookalike(number):
    """Cloud of a scene without stairs, and what it shows."""
    rng = np.random.default_rng(100_000 + number)
    kind = lookalikes.KINDS[number % len(lookalikes.KINDS)]
    sensor = SENSORS[(number // len(lookalikes.KINDS)) % 3]
    seen = scenes.seen(
        kind(rng), rng, sensor=sensor, height=rng.choice([0.5, 1.2]), away=rng.uniform(0.8, 2),
        noise=rng.uniform(0.002, 0.01), bias=rng.normal(0, BIAS),
        tilt=np.radians(rng.uniform(0, 3)),
    )  # fmt: skip
    return cloud(seen), kind.__name__
