"""Does any track with grousers on rubber meet all that the paper's text says of the rig's falls?

Tracks are drawn: R, h, s and k, and what else is not known. Closed forms leave out those that they
refute; of what is left the dynamics try a few conditions, then all. A run is like the rig's: ten
nosings, each at its own phase, two belts out of step.
"""

import math
from collections.abc import Sequence
from importlib import import_module
from typing import Any, ClassVar, NamedTuple

import numpy as np

from kaidan.answer import Answer, Part
from kaidan.lab.calibration.bench import Bench, Count, with_ends
from kaidan.lab.calibration.design import Axis
from kaidan.lab.calibration.evidence import PAPER, condition
from kaidan.lab.calibration.margins import Margin, margins_of, slopes
from kaidan.lab.campaign import Setting
from kaidan.lab.grouser_phase import lead_of_driving, limit_of_round_end, winding_angle
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.margin import theta_s_sup
from kaidan.physics import YieldingBelt
from kaidan.physics.spec import SPEED, UNPUBLISHED_MASS
from kaidan.robot import Robot

AXES = (
    Axis("end_radius_m", 0.002, 0.065, True, "radius of the ends"),
    Axis("height_m", 0.002, 0.012, False, "height of the grousers"),
    Axis("spacing_m", 0.015, 0.060, False, "spacing of the grousers"),
    Axis("stiffness_N_m", 1e4, 1e6, True, "stiffness k of both belts at a contact"),
    Axis("shear_ratio", 0.1, 3.0, True, "kt/k"),
    Axis("friction", 0.8, 3.0, True, "friction"),
    Axis("damping_ratio", 0.04, 0.4, True, "of the robot's mass on the rubber at one contact"),
    Axis("treads", 0.0, 1.0, False, "steps from a half on, bars below"),
)
"""What is drawn; the first four are the question."""
SPACINGS = (0.150, 0.180, 0.200, 0.220)
"""Of the paper's nosings [m]."""
MOST_GYRATION = 0.18
"""Largest radius of gyration of the closed forms, as in `kaidan.lab.reproduction.phase` [m]."""
SCREEN = (
    (0.150, 54.0, False),
    (0.220, 40.0, True),
    (0.150, 60.0, True),
    (0.200, 43.0, False),
    (0.200, 50.0, True),
)
"""Tried first: nosing spacing [m], slope [deg], and whether most trials have to be lost there."""
GRIDS = {
    (0.150, "up"): (50.0, 62.0),
    (0.200, "up"): (38.0, 52.0),
    (0.220, "up"): (30.0, 44.0),
    (0.150, "down"): (50.0, 68.0),
}
"""Slopes at which what the text says is looked for [deg]."""
STEP = 2.0
TABLE = {0.150: (50.0, 68.0), 0.180: (42.0, 64.0), 0.200: (38.0, 58.0), 0.220: (30.0, 54.0)}
"""Slopes of the table of the nearest track, up and down [deg]."""


class Demand(NamedTuple):
    """Something that the text says, as a range."""

    name: str
    low: float
    """[deg]"""
    high: float
    """[deg]"""

    def miss(self, value: float) -> float:
        """How far below (negative) or above the range a value is [deg]; 0 within."""
        return max(0.0, value - self.high) - max(0.0, self.low - value)


class Met(Part):
    """A figure of a track beside what the text says."""

    name: str
    """What."""
    value_deg: float
    """[deg]"""
    deviation_deg: float
    """Standard deviation: counts and step of the grid [deg]."""
    miss_deg: float
    """How far below (negative) or above the text it is [deg]; 0 within."""


class Candidate(Part):
    """A track whose figures were all tried."""

    values: dict[str, float]
    """By the names of `AXES`."""
    figures: tuple[Met, ...]
    """In the order of the demands."""

    @property
    def worst(self) -> Met:
        """What it misses most."""
        return max(self.figures, key=lambda each: abs(each.miss_deg))


class Row(Part):
    """Margins of the nearest track at a nosing spacing."""

    nosing_spacing_m: float
    """[m]"""
    formula_deg: float
    """Eqs. (19)-(23) [deg]."""
    up_deg: float | None
    """Mean slope from which trials are lost; null: the grid does not span it [deg]."""
    up_deviation_deg: float | None
    """Its standard deviation [deg]."""
    up_first_deg: float | None
    """Steepest slope up to which none was lost [deg]."""
    down_deg: float | None
    """Coming down tail first [deg]."""
    down_deviation_deg: float | None
    """[deg]"""
    down_first_deg: float | None
    """[deg]"""
    theta_d_deg: float | None
    """Mean largest extra inclination at the steepest slope at which none was lost [deg]."""


class GrouserSearch(Answer):
    """What was drawn, what was left at each stage, and how near the nearest come."""

    text_module: ClassVar[str] = "kaidan.lab.calibration.search_text"

    robot: str
    """Robot."""
    seed: int
    """Of the draws and of the trials."""
    trials: int
    """A condition."""
    drawn: int
    """Tracks drawn."""
    by_closed_form: int
    """Of these, tracks that the closed forms do not refute."""
    tried: int
    """Of these, the tracks that were tried in dynamics."""
    screened: int
    """Of these, tracks that hold or fall as the text has it at each condition of `SCREEN`."""
    demands: tuple[tuple[str, float, float | None], ...]
    """What the text says: name, least and largest [deg]; null: no bound."""
    failing: tuple[int, ...]
    """How many of the screened tracks miss each demand by more than 1.96 deviations."""
    meeting: int
    """How many miss none."""
    nearest: tuple[Candidate, ...]
    """Tracks by what they miss most, the nearest first."""
    table: tuple[Row, ...]
    """Margins of the nearest at the paper's spacings."""


def demands(robot: Robot) -> tuple[Demand, ...]:
    """What the text says of falls, theta_d and theta_M, as ranges."""
    zone, lean, seen = PAPER.zone, PAPER.theta_d, PAPER.rotation
    at_200, at_220 = (_formula(robot, p) for p in PAPER.agreement_at)
    near, wide = PAPER.agreement, 2 * lean.uncertainty
    return (
        Demand("falls from, 150 mm", zone.low, zone.high),
        Demand("falls from, 200 mm", seen.angle, at_200 + near),
        Demand("falls from, 220 mm", at_220 - near, at_220 + near),
        Demand("theta_M, 150 mm", *PAPER.theta_M),
        Demand("theta_d, 150 mm", lean.extra - wide, lean.extra + wide),
        Demand("rotation, 200 mm 44 deg", seen.extra, math.inf),
    )  # fmt: skip


def drawn(count: int, seed: int) -> list[dict[str, float]]:
    """Tracks, evenly spread (scrambled Sobol)."""
    qmc: Any = import_module("scipy.stats").qmc
    shares = qmc.Sobol(len(AXES), rng=np.random.default_rng(seed)).random(
        2 ** math.ceil(math.log2(max(2, count)))
    )[:count]
    return [
        {axis.name: axis.value(float(share)) for axis, share in zip(AXES, row, strict=True)}
        for row in shares
    ]


def setting_of(robot: Robot, values: dict[str, float]) -> Setting:
    """Setting of a track that was drawn."""
    belt = YieldingBelt(
        stiffness=values["stiffness_N_m"],
        shear_ratio=values["shear_ratio"],
        damping_ratio=values["damping_ratio"],
        height=values["height_m"],
        spacing=values["spacing_m"],
    )
    return Setting.of(
        with_ends(robot, values["end_radius_m"]),
        track=belt,
        friction=values["friction"],
        ground="steps" if values["treads"] >= 0.5 else "noses",
    )


def bounds(robot: Robot, values: dict[str, float], p: float) -> tuple[float, float]:
    """Slopes between which it falls going up, by closed forms [deg].

    The least is that at rest, with all of the height, the round end wound over bars where there are
    no treads. The most has no grouser, the whole round end, the belt's lead at speed, and what the
    rubber lowers the centroid by.
    """
    stance = robot.stance()
    place = {
        "L": stance.flat_length,
        "p": p,
        "C_L": stance.com_from_front,
        "C_N": stance.com_height,
    }
    R, h, s = (values[name] for name in ("end_radius_m", "height_m", "spacing_m"))
    phi: Any = math.pi / 2
    if values["treads"] < 0.5:
        below = np.arange(1, 1 + max(1, int(stance.flat_length / p)))
        phi = winding_angle(R=R, delta=float(((-below * p) % s).min()))
    low = limit_of_round_end(R=R, c=h, phi=phi, **place)
    sag = (robot.mass or UNPUBLISHED_MASS) * STANDARD_GRAVITY / values["stiffness_N_m"]
    high = limit_of_round_end(R=R, c=-min(sag, 0.5 * stance.com_height), **place)
    x = math.tan(float(high)) * stance.com_height
    lead = lead_of_driving(x=x, C_N=stance.com_height, v=SPEED, rho=MOST_GYRATION)
    return math.degrees(float(low)), math.degrees(float(high + lead))


def refuted(robot: Robot, values: dict[str, float], required: Sequence[Demand]) -> bool:
    """Whether closed forms alone say that it falls outside the text's ranges.

    Or cannot lean by theta_d: a grouser leans it by h / p at most, rubber by its whole indentation.
    """
    for p, demand in zip((0.150, 0.200, 0.220), required, strict=False):
        low, high = bounds(robot, values, p)
        if low > demand.high or high < demand.low:
            return True
    weight = (robot.mass or UNPUBLISHED_MASS) * STANDARD_GRAVITY
    lean = (values["height_m"] + weight / values["stiffness_N_m"]) / SPACINGS[0]
    return math.degrees(lean) < required[4].low


def search(
    bench: Bench, robot: Robot, *, count: int = 4096, tried: int = 256, nearest: int = 5
) -> GrouserSearch:
    """Draw tracks, leave out what closed forms refute, and try the rest.

    Parameters
    ----------
    bench : Bench
        What runs the trials, of as many nosings as it says.
    robot : Robot
        The robot, whose ends are drawn.
    count : int
        Tracks drawn.
    tried : int
        Tracks tried in dynamics at most: the first that closed forms leave.
    nearest : int
        How many of the nearest are shown.
    """
    required = demands(robot)
    possible = [each for each in drawn(count, bench.seed) if not refuted(robot, each, required)]
    some = possible[:tried]
    left = _screened(bench, robot, some)
    found = [
        _judged(each, required, own)
        for each, own in zip(left, _all(bench, robot, left), strict=True)
    ]
    found.sort(key=lambda each: abs(each.worst.miss_deg))
    certain = [
        [abs(one.miss_deg) > 1.96 * one.deviation_deg for one in each.figures] for each in found
    ]
    return GrouserSearch(
        robot=robot.name,
        seed=bench.seed,
        trials=bench.trials,
        drawn=count,
        by_closed_form=len(possible),
        tried=len(some),
        screened=len(left),
        demands=tuple(
            (each.name, each.low, each.high if math.isfinite(each.high) else None)
            for each in required
        ),
        failing=tuple(sum(row[k] for row in certain) for k in range(len(required))),
        meeting=sum(not any(row) for row in certain),
        nearest=tuple(found[:nearest]),
        table=_table(bench, robot, found[0].values) if found else (),
    )  # fmt: skip


def _screened(
    bench: Bench, robot: Robot, some: Sequence[dict[str, float]]
) -> list[dict[str, float]]:
    """Tracks of which more than half are lost where they have to be, and not where they must not.

    One condition after the other, so that a track that fails the first is not tried on.
    """
    left = list(some)
    for p, angle, lost in SCREEN:
        counts = bench.counts((setting_of(robot, each), condition(p, angle)) for each in left)
        left = [
            each
            for each, count in zip(left, counts, strict=True)
            if (count.lost >= 0.5 if lost else count.lost <= 0.5)
        ]
    return left


def _all(
    bench: Bench, robot: Robot, left: Sequence[dict[str, float]]
) -> list[tuple[list[Margin], Count]]:
    """Margins at `GRIDS`, and the count where the text saw a rotation, of each track."""
    settings = [setting_of(robot, each) for each in left]
    found = margins_of(
        bench,
        [
            (setting, p, direction, slopes(*ends, STEP))
            for setting in settings
            for (p, direction), ends in GRIDS.items()
        ],
    )
    seen = PAPER.rotation
    turned = bench.counts((each, condition(seen.nosing_spacing, seen.angle)) for each in settings)
    size = len(GRIDS)
    return [(found[size * at : size * (at + 1)], turned[at]) for at in range(len(left))]


def _judged(
    values: dict[str, float], required: Sequence[Demand], own: tuple[list[Margin], Count]
) -> Candidate:
    (at_150, at_200, at_220, down), turned = own
    up, fall = _value(at_150), _value(down)
    lean = _lean(at_150)
    figures = (
        up,
        _value(at_200),
        _value(at_220),
        (fall[0] - up[0], math.hypot(fall[1], up[1])),
        lean,
        _mean(turned.extras),
    )
    return Candidate(
        values=values,
        figures=tuple(
            Met(name=each.name, value_deg=value, deviation_deg=spread, miss_deg=each.miss(value))
            for each, (value, spread) in zip(required, figures, strict=True)
        ),
    )


def _value(margin: Margin) -> tuple[float, float]:
    """Margin and its deviation; an end of the grid where it does not span it."""
    if math.isfinite(margin.value):
        return margin.value, margin.deviation
    early = margin.counts[0].lost >= 0.25
    return (margin.angles[0] if early else margin.angles[-1]), STEP


def _lean(margin: Margin) -> tuple[float, float]:
    """theta_d: mean extra inclination at the steepest slope at which no trial was lost."""
    if not math.isfinite(margin.none_up_to):
        return 0.0, STEP
    return _mean(margin.counts[margin.angles.index(margin.none_up_to)].extras)


def _mean(extras: Sequence[float]) -> tuple[float, float]:
    if not extras:
        return 0.0, STEP
    return float(np.mean(extras)), float(np.std(extras, ddof=1 if len(extras) > 1 else 0))


def _table(bench: Bench, robot: Robot, values: dict[str, float]) -> tuple[Row, ...]:
    setting = setting_of(robot, values)
    grid = {p: slopes(*ends, STEP) for p, ends in TABLE.items()}
    jobs = [(setting, p, way, grid[p]) for p in SPACINGS for way in ("up", "down")]
    found = margins_of(bench, jobs)
    return tuple(
        Row(
            nosing_spacing_m=p,
            formula_deg=_formula(robot, p),
            up_deg=up.value,
            up_deviation_deg=up.deviation,
            up_first_deg=up.none_up_to,
            down_deg=down.value,
            down_deviation_deg=down.deviation,
            down_first_deg=down.none_up_to,
            theta_d_deg=_lean(up)[0],
        )
        for p, up, down in zip(SPACINGS, found[::2], found[1::2], strict=True)
    )


def _formula(robot: Robot, p: float) -> float:
    stance = robot.stance()
    return math.degrees(
        float(
            theta_s_sup(
                L=stance.flat_length, p=p, C_L=stance.com_from_front, C_N=stance.com_height, a=0.0
            )
        )
    )
