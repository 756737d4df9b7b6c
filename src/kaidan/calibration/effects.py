"""Effects of the grousers' height, spacing and stiffness on theta_M: the paper's open question.

"quantitative methods to estimate the effects of the grouser shape have not been established yet"
(Endo & Nagatani 2016, Conclusion). What comes out is this model's answer, not a measurement.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from kaidan.calibration.bench import Bench, Setting
from kaidan.calibration.margins import Margin, margins_of, slopes
from kaidan.physics import DrivenGrousers, SmoothBelt
from kaidan.robot import Robot

SPACING = 0.150
"""Nosing spacing at which theta_M is asked [m]: where the paper prints it."""
BASE = {"height": 0.010, "spacing": 0.033, "stiffness": 2e5}
"""Grousers about which one figure at a time is changed [m, m, N/m]; guessed."""
VARIED: Mapping[str, tuple[float, ...]] = {
    "height": (0.005, 0.010, 0.015, 0.020),
    "spacing": (0.020, 0.033, 0.050, 0.100),
    "stiffness": (2e4, 5e4, 2e5, 1e6),
}
UP, DOWN = (40.0, 66.0), (54.0, 80.0)
"""Slopes between which margins are looked for, ascending and descending [deg]."""


class Effect(NamedTuple):
    """theta_M of one kind of grousers."""

    varied: str
    """height, spacing or stiffness; "none" for the smooth belt."""
    value: float
    """Of what is varied [m or N/m]."""
    up: Margin
    down: Margin

    @property
    def theta_M(self) -> float:
        """Descending less ascending margin [deg]; NaN where a grid does not span its margin."""
        return self.down.value - self.up.value

    @property
    def deviation(self) -> float:
        """Standard deviation of `theta_M`: counts, and step of the grids [deg]."""
        return float((self.down.deviation**2 + self.up.deviation**2) ** 0.5)


def effects(
    bench: Bench,
    robot: Robot,
    *,
    base: Mapping[str, float] = BASE,
    varied: Mapping[str, Sequence[float]] = VARIED,
    friction: float = 0.8,
    step: float = 2.0,
    up: tuple[float, float] = UP,
    down: tuple[float, float] = DOWN,
    nosing_spacing: float = SPACING,
) -> tuple[Effect, ...]:
    """Vary one figure of the grousers at a time, and count falls going up and coming down.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    robot : Robot
        The robot.
    base : mapping
        height [m], spacing [m] and stiffness [N/m] of the grousers that are varied.
    varied : mapping
        Values of each.
    friction : float
        Of the grousers on the nosings [1].
    step : float
        Between slopes [deg].
    up, down : (low, high)
        Slopes of the grids [deg].
    nosing_spacing : float
        [m]

    Returns
    -------
    tuple of Effect
        The smooth belt first (no grousers, friction 3), then each varied value.
    """
    kinds: list[tuple[str, float, Setting]] = [("none", 0.0, Setting(robot, SmoothBelt()))]
    for name, values in varied.items():
        for value in values:
            track = DrivenGrousers.model_validate({**base, name: value})
            kinds.append((name, value, Setting(robot, track, friction)))
    ways = (("up", slopes(*up, step)), ("down", slopes(*down, step)))
    found = margins_of(
        bench,
        [
            (setting, nosing_spacing, direction, grid)
            for _, _, setting in kinds
            for direction, grid in ways
        ],
    )
    return tuple(
        Effect(name, value, found[2 * at], found[2 * at + 1])
        for at, (name, value, _) in enumerate(kinds)
    )


def as_columns(found: Sequence[Effect]) -> dict[str, list[float | str]]:
    """Effects as columns of a table; lengths in m, stiffness in N/m, angles in degrees.

    `loss_deg` is how much ascending margin is lost against the smooth belt.
    """
    return {
        "varied": [each.varied for each in found],
        "value": [each.value for each in found],
        "up_deg": [each.up.value for each in found],
        "up_deviation_deg": [each.up.deviation for each in found],
        "up_none_lost_to_deg": [each.up.none_up_to for each in found],
        "up_all_lost_from_deg": [each.up.all_from for each in found],
        "down_deg": [each.down.value for each in found],
        "down_deviation_deg": [each.down.deviation for each in found],
        "down_none_lost_to_deg": [each.down.none_up_to for each in found],
        "down_all_lost_from_deg": [each.down.all_from for each in found],
        "loss_deg": [found[0].up.value - each.up.value for each in found],
        "theta_M_deg": [each.theta_M for each in found],
        "theta_M_deviation_deg": [each.deviation for each in found],
    }
