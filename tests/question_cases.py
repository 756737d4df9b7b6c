"""Questions of every kind: catalogue pairs, and random robots, terrains and manners."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from kaidan.catalog import names
from kaidan.question import Question
from kaidan.robot import Drive, FlipperPair, Robot, Track, Uncertainty
from kaidan.surface import Surface
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

FRICTIONS = (0.6, 0.9, 1.2)
SHARES = {"contact": 0.7, "closed-form": 0.2, "support-polygon": 0.1}
"""How often each model is asked."""


def of_catalogue(**manner: Any) -> Iterator[Question]:
    """Every robot on every flight of the catalogue at three frictions, flippers up and flat."""
    for name in names("robots"):
        robot = Robot.named(name)
        for stairs in names("stairs"):
            for friction in FRICTIONS:
                for flippers in ("stowed", "flat") if robot.flippers() else ("stowed",):
                    yield Question.of(robot, stairs, friction=friction, flippers=flippers, **manner)


def random_questions(
    count: int, seed: int, *, shares: dict[str, float] | None = None
) -> Iterator[Question]:
    """Questions that have an answer of some kind; models in the shares given."""
    rng = np.random.default_rng(seed)
    models, weights = zip(*(shares or SHARES).items(), strict=True)
    for _ in range(count):
        yield random_question(rng, str(rng.choice(models, p=weights)))


def random_question(rng: np.random.Generator, model: str) -> Question:
    """One question to a model."""
    robot = random_robot(rng, gauge=model == "support-polygon")
    terrain = random_terrain(rng, robot, flight=model != "contact")
    mu = float(rng.uniform(0.2, 2.5))
    surfaces = [
        None,
        Surface.of_friction(mu),
        Surface.of_friction(mu),
        Surface(name="range", friction_low=mu, friction_high=1.3 * mu),
        Surface.of_friction(mu, uncertainty=0.05),
    ]
    manner: dict[str, Any] = {
        "surface": surfaces[rng.integers(len(surfaces))],
        "direction": str(rng.choice(["up", "down"])),
        "facing": str(rng.choice(["nose-first", "tail-first"])),
        "flippers": str(rng.choice(["stowed", "flat"])) if robot.flippers() else "stowed",
        "acceleration": float(rng.choice([0.0, 0.0, rng.uniform(-2.0, 2.0)])),
        "speed": None if rng.random() < 0.5 else float(rng.uniform(0.01, 0.5)),
        "theta_d": None if rng.random() < 0.5 else float(rng.uniform(0.0, 0.06)),
        "theta_M": None if rng.random() < 0.5 else float(rng.uniform(0.0, 0.06)),
        "risk": float(rng.choice([0.01, 0.1])),
    }
    if robot.mass is not None and rng.random() < 0.2:
        manner["payload"] = f"{0.1 * robot.mass:.3f}kg@{1e3 * robot.com_from_front:.0f}mm,300mm"
    if isinstance(terrain, Stairs) and robot.track.gauge and model != "closed-form":
        manner["yaw"] = float(rng.choice([0.0, 0.0, rng.uniform(-0.8, 0.8)]))
    return Question.of(robot, terrain, model=model, **manner)


def random_robot(rng: np.random.Generator, *, gauge: bool = False) -> Robot:
    """A robot, with and without mass, flippers, belly, drive and doubts."""

    def some(share: float) -> bool:
        return bool(rng.random() < share)

    L = float(rng.uniform(0.3, 1.2))
    front, rear = (float(r) for r in rng.uniform(0.01, 0.15, 2))
    sigma = float(rng.uniform(0.0005, 0.01)) if some(0.2) else 0.0
    mass = float(rng.uniform(5, 60)) if some(0.8) else None
    pairs = {}
    for end, radius in (("front", front), ("rear", rear)):
        if mass is not None and some(0.25):
            pairs[f"{end}_flippers"] = FlipperPair(
                length=L * float(rng.uniform(0.3, 0.6)),
                root_radius=max(radius, 0.006),
                tip_radius=max(radius / 2, 0.004),
                pivot_height=radius,
                mass=0.05 * mass,
            )
    return Robot(
        name="any",
        mass=mass,
        com_from_front=L * float(rng.uniform(0.2, 0.8)),
        com_height=L * float(rng.uniform(0.05, 0.4)),
        track=Track(
            flat_length=L,
            front_radius=front,
            rear_radius=rear,
            gauge=L * float(rng.uniform(0.4, 0.9)) if gauge or some(0.5) else None,
            width=0.05,
            belly_clearance=float(rng.uniform(0.01, 0.1)) if some(0.3) else None,
        ),
        drive=Drive(
            max_traction=float(rng.uniform(50, 600)) if some(0.3) else None,
            max_power=float(rng.uniform(20, 500)) if some(0.2) else None,
            rolling_resistance=float(rng.uniform(0, 0.2)),
        ),
        uncertainty=Uncertainty(com_from_front=sigma, com_height=sigma / 2, flat_length=sigma / 2),
        **pairs,
    )


def random_terrain(rng: np.random.Generator, robot: Robot, *, flight: bool = False) -> Any:
    """A flight; else also several flights, or a profile with few steps or none."""
    kind = rng.random() * (0.6 if flight else 1.0)
    L = robot.track.flat_length
    if kind < 0.45:
        return _flight(rng, L, int(rng.integers(2, 12)))
    if kind < 0.6:
        n = int(rng.integers(3, 10))
        mean = _flight(rng, L, n)
        rises = np.clip(mean.rise + rng.uniform(-0.01, 0.01, n), 0.02, 0.6)
        goings = np.clip(mean.going + rng.uniform(-0.01, 0.01, n - 1), 0.03, 2.0)
        return Stairs(rises=tuple(rises.tolist()), goings=tuple(goings.tolist()))
    if kind < 0.7:
        return tuple(_flight(rng, L, int(rng.integers(2, 6))) for _ in range(2))
    return Profile.of_points(PROFILES[rng.integers(len(PROFILES))](rng))


def _flight(rng: np.random.Generator, L: float, n: int) -> Stairs:
    p, angle = L / rng.uniform(1.6, 6.0), rng.uniform(0.2, 1.1)
    return Stairs(
        rise=float(np.clip(p * math.sin(angle), 0.02, 0.5)),
        going=float(np.clip(p * math.cos(angle), 0.03, 2.0)),
        steps=n,
        upper_landing=float(rng.uniform(0.3, 4.0)),
    )


def _kerb(rng: np.random.Generator) -> Any:
    h = rng.uniform(0.02, 0.4)
    return [(-3, 0), (0, 0), (0, h), (3, h)]


def _ramp(rng: np.random.Generator) -> Any:
    slope, length = rng.uniform(0.05, 0.7), rng.uniform(0.5, 3.0)
    x, z = length * math.cos(slope), length * math.sin(slope)
    return [(-3, 0), (0, 0), (x, z), (x + 3, z)]


def _floor(rng: np.random.Generator) -> Any:
    return [(-3, 0), (rng.uniform(0, 3), 0.0)]


def _hole(rng: np.random.Generator) -> Any:
    width, depth = rng.uniform(0.05, 1.0), rng.uniform(0.05, 0.5)
    return [(-3, 0), (0, 0), (0, -depth), (width, -depth), (width, 0), (width + 3, 0)]


def _bump(rng: np.random.Generator) -> Any:
    h, width = rng.uniform(0.02, 0.2), rng.uniform(0.1, 0.8)
    return [(-3, 0), (0, 0), (0.05, h), (width, h), (width + 0.05, 0), (width + 3, 0)]


def _rubble(rng: np.random.Generator) -> Any:
    x = np.cumsum(rng.uniform(0.02, 0.2, 30))
    z = np.cumsum(rng.normal(0.02, 0.05, 30))
    z = np.maximum(z - z[0], 0.0)
    z[-1] = max(z[-1], 0.0)
    return [(-3.0, 0.0), *zip(x.tolist(), z.tolist(), strict=True), (x[-1] + 3, z[-1])]


PROFILES = (_kerb, _ramp, _floor, _hole, _bump, _rubble)
