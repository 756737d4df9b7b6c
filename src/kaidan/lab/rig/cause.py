"""Grousers or rubber: whether theta_d comes of the phase of grousers or of a track that yields.

At a nosing spacing of a whole number of grouser spacings every nosing meets the belt alike, and
grousers lean the robot by nothing. Half a grouser spacing off, with a tip on the lowest nosing at
the start or the belt turned by half of it, they lean it by arcsin(h / p). Rubber does not mind.
"""

import math
from typing import Literal, NamedTuple

import numpy as np

from kaidan.lab.rig.fitting import FEWEST, Fitted, student
from kaidan.lab.rig.sheet import RigSheet, Trials

Cause = Literal["grousers", "rubber", "both", "undecided"]
_NEAR = 0.12
"""How far off a whole or a half number of grouser spacings a nosing spacing may be: a bar 4 mm
wide of 33 mm stands under nosings that far off."""


class Contrast(NamedTuple):
    """What the belt's phase changes."""

    rise: Fitted
    """theta_d times p half a grouser spacing off, less the same in step [m]."""
    height: float
    """Of the grousers, by tape [m]."""
    cause: Cause


def contrast_of(sheet: RigSheet) -> Contrast | None:
    """Contrast of the trials with the belt set; None: no tape, or too few of them.

    theta_d times p is a length: the height of grousers, or the rubber's indentation, which hardly
    depends on p. So what is left of the difference is the grousers'.
    """
    s, h = sheet.grouser_spacing, sheet.grouser_height
    if s is None or h is None:
        return None
    lengths: dict[str, list[float]] = {"in step": [], "half off": []}
    for each in sheet.trials:
        kind = step_of(each, s)
        if kind is not None:
            lengths[kind] += [each.nosing_spacing * math.sin(extra) for extra in each.extra]
    step, off = (np.array(each) for each in lengths.values())
    if min(len(step), len(off)) < FEWEST:
        return None
    degrees = len(step) + len(off) - 2
    squares = float(np.var(step)) * len(step) + float(np.var(off)) * len(off)
    one = student(degrees) * math.sqrt(squares / degrees)
    rise = _about(float(off.mean() - step.mean()), one * math.sqrt(1 / len(step) + 1 / len(off)))
    in_step = _about(float(step.mean()), one / math.sqrt(len(step)))
    return Contrast(rise, h, _cause(rise, in_step, h))


def _about(value: float, half: float) -> Fitted:
    return Fitted(value, value - half, value + half)


def step_of(trials: Trials, s: float) -> Literal["in step", "half off"] | None:
    """How the nosing spacing goes with grousers s apart [m]; None: neither, or the belt not set."""
    if not trials.belt_set or trials.direction != "up":
        return None
    off = (trials.nosing_spacing / s) % 1.0
    if min(off, 1.0 - off) < _NEAR:
        return "in step"
    return "half off" if abs(off - 0.5) < _NEAR else None


def _cause(rise: Fitted, in_step: Fitted, h: float) -> Cause:
    """Grousers raise it by h, rubber by nothing: the middle parts them.

    Rubber is read to do something besides if it alone, in step, makes as much as half of h.
    """
    if rise.high < h / 2:
        return "rubber"
    if rise.low <= h / 2:
        return "undecided"
    return "both" if in_step.low > h / 2 else "grousers"
