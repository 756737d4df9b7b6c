"""Effects of the grousers' height, spacing, stiffness and friction on theta_M: an open question.

"quantitative methods to estimate the effects of the grouser shape have not been established yet"
(Endo & Nagatani 2016, Conclusion). What comes out is this model's answer, not a measurement.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from kaidan.lab.calibration.answer import Effect, GrouserEffects
from kaidan.lab.calibration.bench import Bench
from kaidan.lab.calibration.evidence import PAPER
from kaidan.lab.calibration.margins import Margin, margins_of, slopes
from kaidan.lab.calibration.report import margin_shown
from kaidan.lab.campaign import Setting
from kaidan.physics import YieldingBelt
from kaidan.robot import Robot

SPACING = 0.150
"""Nosing spacing at which theta_M is found [m]: where the paper prints it."""
BASE = {"height": 0.007, "spacing": 0.033, "stiffness": 1e5, "friction": 2.0}
"""Grousers on rubber about which one figure at a time is changed [m, m, N/m, 1]; guessed."""
VARIED: Mapping[str, tuple[float, ...]] = {
    "height": (0.003, 0.005, 0.007, 0.010),
    "spacing": (0.020, 0.028, 0.033, 0.050),
    "stiffness": (2e4, 5e4, 1e5, 4e5),
    "friction": (0.8, 1.2, 2.0, 3.0),
}
UP, DOWN = (40.0, 67.0), (42.0, 75.0)
"""Slopes between which margins are looked for, ascending and descending [deg]."""


def effects(
    bench: Bench,
    robot: Robot,
    *,
    base: Mapping[str, float] = BASE,
    varied: Mapping[str, Sequence[float]] = VARIED,
    step: float = 2.0,
    up: tuple[float, float] = UP,
    down: tuple[float, float] = DOWN,
    nosing_spacing: float = SPACING,
) -> GrouserEffects:
    """Vary one figure of the grousers at a time, and count falls going up and coming down.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    robot : Robot
        The robot.
    base : mapping
        height [m], spacing [m], stiffness [N/m] and friction [1] of the grousers.
    varied : mapping
        Values of each.
    step : float
        Between slopes [deg].
    up, down : (low, high)
        Slopes of the grids [deg].
    nosing_spacing : float
        [m]

    Returns
    -------
    GrouserEffects
        The smooth belt first (no grousers, friction 3), then each varied value.
    """
    kinds: list[tuple[str, float, Setting]] = [("none", 0.0, Setting.of(robot))]
    for name, values in varied.items():
        for value in values:
            own = {**base, name: value}
            friction = own.pop("friction")
            track = YieldingBelt.model_validate(own)
            kinds.append((name, value, Setting.of(robot, track=track, friction=friction)))
    directions = (("up", slopes(*up, step)), ("down", slopes(*down, step)))
    found = margins_of(
        bench,
        [
            (setting, nosing_spacing, direction, grid)
            for _, _, setting in kinds
            for direction, grid in directions
        ],
    )
    smooth = found[0]
    return GrouserEffects(
        robot=robot.name,
        trials=bench.trials,
        seed=bench.seed,
        base=dict(base),
        nosing_spacing_m=nosing_spacing,
        step_deg=step,
        theta_M_printed_deg=PAPER.theta_M,
        effects=[
            _effect(name, value, found[2 * at], found[2 * at + 1], smooth)
            for at, (name, value, _) in enumerate(kinds)
        ],
    )


def _effect(name: Any, value: float, up: Margin, down: Margin, smooth: Margin) -> Effect:
    return Effect(
        varied=name,
        value=value,
        up=margin_shown(up),
        down=margin_shown(down),
        loss_deg=smooth.value - up.value,
        theta_M_deg=down.value - up.value,
        deviation_deg=math.hypot(down.deviation, up.deviation),
    )
