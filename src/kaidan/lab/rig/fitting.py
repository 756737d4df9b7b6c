"""A rig's measurements fitted: k and kt by lines, theta_d by means, theta_M by counts of falls.

Each interval is so wide that all four hold at once with 95 %: each by itself has 98.75 %.
"""

import math
from importlib import import_module, util
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, MissingExtraError
from kaidan.lab.rig.sheet import Measurement, RigSheet, Trials

Array = NDArray[np.float64]

TOGETHER = 0.95
"""Probability that all four intervals hold."""
ALONE = 1.0 - (1.0 - TOGETHER) / 4
FEWEST = 3
"""Measurements from which on there is an interval."""
_M = np.radians(np.linspace(-10.0, 20.0, 151))
"""theta_M that may be [rad]."""
_S = np.radians(np.geomspace(0.15, 6.0, 25))
"""Scatter of trials that may be [rad], uniform as a logarithm."""
_BESIDE = math.radians(8.0)
"""How far beyond the slopes that were tried a margin may lie [rad]."""
_ACROSS = 121
"""Margins of a grid."""


class Fitted(NamedTuple):
    """A figure with its interval."""

    value: float
    low: float
    high: float
    """Infinite where the measurements do not bound it."""


def student(degrees: int, among: int = 1) -> float:
    """Quantile of Student's t for an interval of `ALONE`, or for so many that hold together."""
    if util.find_spec("scipy") is None:
        raise MissingExtraError("calibrating a rig", "calibration")
    stats: Any = import_module("scipy.stats")
    return float(stats.t.ppf(1.0 - (1.0 - ALONE) / (2 * among), degrees))


def stiffness_of(measurements: tuple[Measurement, ...], name: str) -> Fitted | None:
    """Stiffness of a line through measurements, least squares in the travel [N/m]; None: too few.

    The zero of the gauge is free: play of the rig drops out.
    """
    if len(measurements) < FEWEST:
        return None
    force = np.array([each.force for each in measurements])
    travel = np.array([each.travel for each in measurements])
    about = force - force.mean()
    spread = float(about @ about)
    if spread <= 0.0:
        raise InputError(f"rig: {name}: the forces are all {force[0]:g} N; a line needs several")
    slope = float(about @ travel) / spread
    off = travel - travel.mean() - slope * about
    sigma = math.sqrt(float(off @ off) / (len(measurements) - 2) / spread)
    half = student(len(measurements) - 2) * sigma
    if slope <= 0.0:
        raise InputError(f"rig: {name}: the travel does not grow with the force")
    return Fitted(
        1.0 / slope, 1.0 / (slope + half), 1.0 / (slope - half) if slope > half else math.inf
    )


def theta_d_of(trials: tuple[Trials, ...]) -> dict[float, Fitted]:
    """theta_d of each spacing: mean of what was measured at the steepest slope with enough [rad].

    Measurements scatter alike everywhere, so that the rows tell of their scatter together.
    """
    rows = [each for each in trials if each.direction == "up" and len(each.extra) > 1]
    steepest = {
        each.nosing_spacing: each
        for each in sorted(rows, key=lambda each: each.angle)
        if len(each.extra) >= FEWEST
    }
    if not steepest:
        return {}
    degrees = sum(len(each.extra) - 1 for each in rows)
    squares = sum(float(np.var(each.extra)) * len(each.extra) for each in rows)
    half = student(degrees, len(steepest)) * math.sqrt(squares / degrees)
    found = {}
    for p, each in sorted(steepest.items()):
        mean, width = float(np.mean(each.extra)), half / math.sqrt(len(each.extra))
        found[p] = Fitted(mean, mean - width, mean + width)
    return found


class Margins(NamedTuple):
    """What counts of falls say."""

    up: dict[float, Fitted]
    """Margin going up at each spacing [rad]."""
    theta_M: Fitted | None
    """Margin going down less that going up [rad]; None: no spacing was tried both ways."""


def margins_of(trials: tuple[Trials, ...]) -> Margins:
    """Margins of counts of falls, by the posterior over margins, theta_M and the scatter of trials.

    A trial holds with probability ``1 / (1 + exp((theta_s - m) / s))``, m higher by theta_M on the
    way down. Before the trials every margin within 8 degrees of the slopes that were tried, every
    theta_M of -10 to 20 degrees and every order of magnitude of s is alike. The posterior is summed
    over a grid, so that there is no sampler to be judged.
    """
    counted = [each for each in trials if each.held + each.fell]
    spacings = sorted({each.nosing_spacing for each in counted})
    log_of = {}
    axes = {}
    for p in spacings:
        here = [each for each in counted if each.nosing_spacing == p]
        slopes = [each.angle for each in here]
        axis = np.linspace(min(slopes) - _BESIDE, max(slopes) + _BESIDE, _ACROSS)
        axes[p] = axis
        log_of[p] = sum((_log(each, axis) for each in here), np.zeros((len(_S), len(_M), _ACROSS)))
    joint = np.zeros((len(_S), len(_M)))
    for each in log_of.values():
        top = each.max(axis=2, keepdims=True)
        joint += top[..., 0] + np.log(np.exp(each - top).sum(axis=2))
    both = any(
        {each.direction for each in counted if each.nosing_spacing == p} == {"up", "down"}
        for p in spacings
    )
    up = {}
    for p in spacings:
        own = log_of[p]
        top = own.max(axis=2, keepdims=True)
        rest = joint - top[..., 0] - np.log(np.exp(own - top).sum(axis=2))
        whole = own + rest[..., None]
        up[p] = _interval(axes[p], np.exp(whole - whole.max()).sum(axis=(0, 1)))
    of_M = np.exp(joint - joint.max()).sum(axis=0) if len(spacings) else np.ones(len(_M))
    return Margins(up, _interval(_M, of_M) if both else None)


def _log(each: Trials, margins: Array) -> Array:
    """Logarithm of the likelihood of a count, shape (scatter, theta_M, margin)."""
    higher = _M if each.direction == "down" else np.zeros_like(_M)
    off = (margins[None, None] + higher[None, :, None] - each.angle) / _S[:, None, None]
    return np.asarray(-each.held * np.logaddexp(0.0, -off) - each.fell * np.logaddexp(0.0, off))


def _interval(axis: Array, weights: Array) -> Fitted:
    share = np.cumsum(weights) / weights.sum()
    ends = np.interp([0.5 - ALONE / 2, 0.5, 0.5 + ALONE / 2], share, axis).tolist()
    return Fitted(ends[1], ends[0], ends[2])


def fit(sheet: RigSheet) -> tuple[Fitted | None, Fitted | None, dict[float, Fitted], Margins]:
    """k, kt, theta_d by spacing, and margins with theta_M, as far as the sheet has them."""
    trials = tuple(each for each in sheet.trials if not each.belt_set)  # those are for the cause
    return (
        stiffness_of(sheet.press, "press"),
        stiffness_of(sheet.shear, "shear"),
        theta_d_of(trials),
        margins_of(trials),
    )
