"""The designed study of the yielding track: points spread over its parameters, and their figures.

A point is a setting of everything that the paper does not state. At each the same trials are made;
what they come to, a handful of figures in degrees, is what an emulator is built on.
"""

import math
from collections.abc import Sequence
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.lab.calibration.bench import Bench, Count, with_ends
from kaidan.lab.calibration.evidence import Evidence, condition
from kaidan.lab.calibration.margins import margin_of, slopes
from kaidan.lab.campaign import Condition, Setting
from kaidan.physics import YieldingBelt
from kaidan.robot import Robot

Array = NDArray[np.float64]


class Axis(NamedTuple):
    """A parameter and its range; evenly spread over its logarithm or over itself."""

    name: str
    low: float
    high: float
    logarithmic: bool
    text: str

    def value(self, share: float) -> float:
        """Value at a share of the range, 0 to 1."""
        if self.logarithmic:
            return float(self.low * (self.high / self.low) ** share)
        return self.low + (self.high - self.low) * share


AXES = (
    Axis("stiffness_N_m", 1e4, 1.6e5, True, "stiffness k of the track at a nosing"),
    Axis("shear_ratio", 0.08, 8.0, True, "kt/k, stiffness along the track to that across it"),
    Axis("end_radius_m", 0.004, 0.05, True, "radius of the ends"),
    Axis("friction", 2.2, 4.0, True, "friction, or what grousers make of it"),
    Axis("damping_ratio", 0.04, 0.3, True, "of the robot's mass on the rubber at one nosing"),
)
"""What is not known of the rig; the first three are fitted, the other two nuisances."""


FIGURES = (
    ("margin_150", "slope from which it falls at 150 mm"),
    ("theta_d", "largest extra inclination at (150 mm, 56.8 deg)"),
    ("margin_200", "slope from which it falls at 200 mm"),
    ("rotation_200", "largest extra inclination at (200 mm, 44.0 deg)"),
    ("margin_220", "slope from which it falls at 220 mm"),
    ("descent_150", "slope from which it falls coming down tail first at 150 mm"),
)
"""Figures of a point [deg], by name."""
EXTRA_OF_A_FALL = 15.0
"""Extra inclination that stands for that of a robot that falls [deg]: a bench's limit."""


class Point(NamedTuple):
    """A point of the design with its figures."""

    shares: tuple[float, ...]
    """Of the ranges of `AXES`, 0 to 1."""
    ground: str
    figures: tuple[float, ...]
    """As `FIGURES` names them [deg]; NaN where the trials do not say."""


def shares_of(count: int, seed: int) -> Array:
    """Points spread evenly over the unit cube (scrambled Sobol), shape (count, axes)."""
    qmc: Any = import_module("scipy.stats").qmc
    sampler = qmc.Sobol(len(AXES), rng=np.random.default_rng(seed))
    drawn: Array = sampler.random(2 ** math.ceil(math.log2(max(2, count))))
    return drawn[:count]


def setting_of(robot: Robot, shares: Sequence[float], ground: str) -> Setting:
    """Setting at shares of the ranges of `AXES`."""
    k, ratio, radius, friction, damping = (
        axis.value(float(share)) for axis, share in zip(AXES, shares, strict=True)
    )
    track = YieldingBelt(stiffness=k, shear_ratio=ratio, damping_ratio=damping)
    return Setting.of(with_ends(robot, radius), track=track, friction=friction, ground=ground)


def series_of(evidence: Evidence, setting: Setting) -> dict[str, list[Condition]]:
    """Conditions whose trials make the figures, by figure."""
    zone, measured, seen = evidence.zone, evidence.theta_d, evidence.rotation
    p1, p2 = evidence.agreement_at
    steepest = setting.steepest

    def up_to(low: float, high: float, p: float, direction: str = "up") -> list[Condition]:
        # a friction that ends the grid early leaves at least two slopes
        top = max(low + 2.0, min(high, steepest))
        return [condition(p, angle, direction) for angle in slopes(low, top, 2.0)]

    p0 = zone.nosing_spacing
    return {
        "margin_150": up_to(44.0, 68.0, p0),
        "theta_d": [condition(measured.nosing_spacing, measured.angle)],
        "margin_200": up_to(32.0, 62.0, p1),
        "rotation_200": [condition(seen.nosing_spacing, seen.angle)],
        "margin_220": up_to(24.0, 58.0, p2),
        "descent_150": up_to(50.0, 76.0, p0, "down"),
    }


def points_of(
    bench: Bench, evidence: Evidence, robot: Robot, places: Sequence[tuple[Sequence[float], str]]
) -> list[Point]:
    """Figures at places of the design; all trials in one go.

    evidence: of which only the conditions are used, no result.
    """
    settings = [setting_of(robot, shares, ground) for shares, ground in places]
    series = [series_of(evidence, setting) for setting in settings]
    counts = iter(
        bench.counts(
            (setting, each)
            for setting, own in zip(settings, series, strict=True)
            for conditions in own.values()
            for each in conditions
        )
    )
    found = []
    for (shares, ground), own in zip(places, series, strict=True):
        figures = tuple(
            _figure(conditions, [next(counts) for _ in conditions]) for conditions in own.values()
        )
        found.append(Point(tuple(float(share) for share in shares), ground, figures))
    return found


def _figure(conditions: Sequence[Condition], counts: Sequence[Count]) -> float:
    if len(conditions) == 1:
        (count,) = counts
        if count.lost > 0.5:
            return EXTRA_OF_A_FALL
        return sum(count.extras) / len(count.extras) if count.extras else math.nan
    angles = [math.degrees(each.angle) for each in conditions]
    value, *_ = margin_of(angles, counts)
    if math.isnan(value):
        # all hold: at least the steepest slope tried; all are lost: at most the gentlest
        lost = [count.lost for count in counts]
        return angles[0] - 1.0 if lost[0] >= 0.25 else angles[-1] + 1.0
    return value
