"""Single steps of a flight whose line is known: levels, faces, floor and landing, with their doubt.

Where a tread is seen its level is the mean of its points; where a riser is seen its face is. Where
only one of them is seen the nosing is the end of that one. A step of which neither is seen is the
regular one, with the spread that such steps may have.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.flight import LAST_SPREAD, UNCHECKED
from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.doubts import SMALLEST, across, common, place_of
from kaidan.readers.stairfit.evidence import (
    by_step,
    depth,
    evenness,
    level_share,
    slant,
    upright,
)
from kaidan.readers.stairfit.flight_ends import (
    EDGE_OFF,
    FEWEST_LANES,
    FEWEST_POINTS,
    ODD_UNSEEN,
    floor_before,
    from_the_first,
    last_riser,
    trimmed,
    with_odd_last,
)
from kaidan.readers.stairfit.gravity import OUT_OF_TRUE
from kaidan.readers.stairfit.quantiles import median, quantile
from kaidan.readers.stairfit.staircase_line import (
    StairLine,
    assigned,
    explained_share,
    fitted,
    fronts,
    robust_plane,
    tops,
)
from kaidan.readers.stairfit.tread_lean import tread_lean
from kaidan.readers.stairfit.turning_steps import nosing_angles, turn_of

LANES = (0.05, 0.2)
"""Widths of the lanes in which ends are sought, the second where the first holds too few [m]."""
LAST_UNSEEN = 2 * LAST_SPREAD
"""Standard uncertainty of the last level where nothing of it was seen [m]: what last rises are like
says more."""
MOST_FITTED, MOST_MEASURED = 8_000, 25_000
"""Points of a lane to which the line is fitted, and of which single steps are the means: 600 of a
tread with 10 mm of noise say its level to 0.4 mm, and the range errs by more. Ends are sought in
all of them."""


@dataclass(frozen=True, eq=False)
class Steps:
    """Nosings of a flight in the frame of its heading."""

    line: StairLine
    at: Array
    """(s, z) of the nosings, shape (m, 2) [m]."""
    covariance: Array
    """Of s and z of all, shape (m, 2, m, 2) [m^2]."""
    measured: NDArray[np.bool_]
    """Whether s and z of each were measured alone, shape (m, 2)."""
    floor: float
    """Level of the floor, NaN: not seen [m]."""
    floor_sigma: float
    with_floor: Array
    """Covariance of s and z of the nosings with that level, shape (m, 2) [m^2]."""
    ends: bool
    """Whether the landing above was seen."""
    landing: float
    """Length of it that was seen, NaN: none [m]."""
    run_up: float
    """Length of the floor before the first nosing that was seen, NaN: none [m]."""
    roughness: float
    residual: float
    """Median distance of the points from the steps [m]."""
    explained: float
    """Share of the points about the steps that lie on them, chance subtracted [1]."""
    depth: float
    """Scatter about the line of the nosings over that of steps about it: 1 for stairs, near 0 for
    a ramp."""
    level: float
    """Share of the treads, by their points, that are level across and along [1]; NaN: too few."""
    slant: float
    """Slope of treads, or lean of risers, over that of the line of the nosings: 0 for stairs, 1 for
    a ramp; NaN: too few."""
    evenness: float
    """Points of every second step over those of the others [1]."""
    upright: float
    """Positive where steps hide what those do that stand, negative where they are upside down."""
    lean: tuple[float, float]
    """Angle by which up leans ahead as the treads have it, and its doubt, NaN: not known [rad]."""
    width: tuple[float, float]
    """Least and greatest t at which steps were seen [m]."""
    angles: Array
    """Of the nosings off square to the heading, NaN: not seen, shape (at most m,) [rad]."""


def steps_of(
    line: StairLine,
    s: Array,
    t: Array,
    z: Array,
    *,
    noise: float,
    eye: Array,
    range_error: float,
    level: float,
) -> Steps | None:
    """Single steps along a line, or None where fewer than three are left.

    s, t, z, shape (n,): points of the lane in the frame of the heading [m].
    noise: scatter of the points [m].
    eye, shape (3,): (s, t, z) of the sensor [m].
    range_error: doubt of measured distances as a share of them [1].
    level: standard uncertainty of up against what was built [rad].
    """
    tight = min(max(3.0 * noise, 0.008), 0.35 * line.rise)
    every = s, t, z
    s, t, z = evenly(MOST_FITTED, s, t, z)
    line = fitted(line, s, t, z, tolerances=(1.5 * tight, tight, tight))
    whole = trimmed(line, s, t, z, tight)
    line = from_the_first(whole, s, t, z, tight)
    if line.last - line.first == 1:
        line = with_odd_last(line, s, t, z, tight)
    if line.last - line.first < 2:
        return None
    if line.first > whole.first:  # the floor may lie elsewhere than a tread would
        line = fitted(line, s, t, z, tolerances=(1.5 * tight, tight))
    line = _without_odd(line, s, t, z, tight)
    found, sigma, places = _alone(line, *every, noise, tight)
    seen = np.flatnonzero(np.isfinite(sigma).any(axis=1))
    if len(seen) < 3:
        return None
    if np.ptp(seen) + 1 < len(found):  # of a step at an end nothing was measured
        line = replace(line, first=line.first + int(seen[0]), last=line.first + int(seen[-1]))
        line = _without_odd(line, s, t, z, tight)
        found, sigma, places = _alone(line, *every, noise, tight)
    at = assigned(line, s, t, z, tight)
    within = (at.step >= line.first) & (at.step <= line.last)
    off = at.off[(at.tread | at.riser) & within]
    if len(off) < 30:
        return None
    number = np.arange(line.first, line.last + 1)
    measured = np.isfinite(sigma)
    if measured.sum(axis=0).min() < 2 or measured.any(axis=1).sum() < 3:
        return None
    for axis in (0, 1):
        _fill(number, found[:, axis], sigma[:, axis], measured[:, axis])
    floor, floor_sigma, run_up, before = floor_before(line, found[0], s, t, z, tight)
    found, sigma, measured, places, landing = last_riser(
        found, sigma, measured, places, line, s, t, z, noise, tight
    )
    if not measured[-1, 1]:
        sigma[-1, 1] = math.hypot(sigma[-1, 1], LAST_UNSEEN)
    rms = float(np.sqrt(np.mean(np.minimum(np.abs(off), tight) ** 2)))
    on = at.tread | at.riser
    width = _width(at.step[on], t[on], line)
    unseen = ~np.isfinite(places[:, :, 0, 0])
    regular = np.column_stack([found[:, 0], np.full(len(found), sum(width) / 2), found[:, 1]])
    places[:, :, 0][unseen] = np.repeat(regular, 2, axis=0).reshape(-1, 2, 3)[unseen]
    places[:, :, 1][unseen] = [0.0, across(width[1] - width[0]), 0.0]
    covariance = common(
        found, np.vstack([places.reshape(-1, 2, 3), before[None]]),
        eye=eye, range_error=range_error, level=level,
    ) + np.diag(np.r_[sigma.ravel(), floor_sigma] ** 2 + SMALLEST**2)  # fmt: skip
    angles = nosing_angles(line, s, t, z, width, floor)
    if turn_of(angles)[0] in (
        "curved",
        "unclear",
    ):  # its first nosings lie elsewhere than those of a line
        angles = nosing_angles(whole, s, t, z, width, floor)
    m = len(found)
    return Steps(
        line=line, at=found, covariance=covariance[:-1, :-1].reshape(m, 2, m, 2),
        measured=measured, floor=floor, floor_sigma=math.sqrt(covariance[-1, -1]),
        with_floor=covariance[:-1, -1].reshape(m, 2),
        ends=math.isfinite(landing), landing=landing, run_up=run_up,
        roughness=rms, residual=median(np.abs(off)),
        explained=explained_share(line, s, t, z, tight), depth=depth(line, s, t, z),
        level=level_share(line, at, s, t, z), slant=slant(line, s, t, z),
        evenness=evenness(line, at), upright=upright(line, at),
        lean=tread_lean(
            line, found[:, 1], *evenly(MOST_MEASURED, *every),
            eye=eye, width=2 * tight, range_error=range_error, out_of_true=OUT_OF_TRUE,
        ),
        width=width, angles=angles,
    )  # fmt: skip


def evenly(most: int, s: Array, t: Array, z: Array) -> tuple[Array, Array, Array]:
    """Every so many-th of the points, so that about as many are left."""
    thin = max(1, len(s) // most)
    return s[::thin], t[::thin], z[::thin]


def _alone(
    line: StairLine, s: Array, t: Array, z: Array, noise: float, tight: float
) -> tuple[Array, Array, Array]:
    """(s, z) of the nosings, each measured alone, their doubt, and where its points lie.

    NaN: neither face nor end; the places are those of `place_of`, shape (m, 2, 2, 3), NaN of ends.
    """
    every = s, t, z
    s, t, z = evenly(MOST_MEASURED, s, t, z)
    at = assigned(line, s, t, z, tight)
    number = np.arange(line.first, line.last + 1)
    regular = line.at(number)
    found, sigma = regular.copy(), np.full(regular.shape, np.nan)
    places = np.full((len(number), 2, 2, 3), np.nan)
    inner = at.inner
    treads = by_step(line, at.step, at.tread & inner)
    risers = by_step(line, at.step, at.riser & inner)
    for row, (tread, riser) in enumerate(zip(treads, risers, strict=True)):
        face = s[riser] - line.skew * t[riser]
        found[row, 0], sigma[row, 0] = _mean(face, len(tread))
        found[row, 1], sigma[row, 1] = _mean(z[tread], len(riser))
        for axis, rows in enumerate((riser, tread)):
            if np.isfinite(sigma[row, axis]):
                places[row, axis] = place_of(s, t, z, rows)
    for axis, ends in ((0, fronts), (1, tops)):
        for wide in LANES:
            lacking = np.flatnonzero(np.isnan(sigma[:, axis]))
            if not len(lacking):
                break
            part = replace(line, first=int(number[lacking[0]]), last=int(number[lacking[-1]]))
            edges = ends(part, *every, tight, wide)
            at_0 = edges.at - line.skew * edges.t if axis == 0 else edges.at
            for row in lacking.tolist():
                here = edges.step == number[row]
                last = axis == 1 and row == len(number) - 1
                gap = edges.gap[here]
                far = _farthest(line.rise, gap) if last else EDGE_OFF
                end = _end(at_0[here], gap, noise, float(regular[row, axis]), far)
                found[row, axis], sigma[row, axis] = end
    return found, sigma, places


def _mean(values: Array, others: int) -> tuple[float, float]:
    """Mean of the points of an element, and its standard uncertainty; NaN: too few."""
    if len(values) < FEWEST_POINTS or len(values) <= 0.04 * others:
        return math.nan, math.nan
    middle = median(values)
    spread = max(1.4826 * median(np.abs(values - middle)), 1e-4)
    core = values[np.abs(values - middle) < 3 * spread]
    return float(core.mean()), spread / math.sqrt(len(core))


def _farthest(rise: float, gap: Array) -> float:
    """Distance from its regular place up to which an end is that of the last riser [m].

    That may be another one, and rows of points end up to half their distance beyond or before it.
    """
    half = 0.5 * median(gap) if len(gap) else 0.0
    return max(EDGE_OFF, ODD_UNSEEN * rise) + half


def _end(ends: Array, gap: Array, noise: float, regular: float, far: float) -> tuple[float, float]:
    """Where an element ends in its lanes, and its standard uncertainty.

    NaN: too few of them, or they end as far from the regular place as something else does.
    """
    if len(ends) < FEWEST_LANES or abs(median(ends) - regular) >= far:
        return math.nan, math.nan
    end = median(ends)
    spread = 1.4826 * median(np.abs(ends - end))
    doubt = math.hypot(0.3 * median(gap), 0.5 * noise)
    return end, math.hypot(1.25 * spread / math.sqrt(len(ends)), doubt)


def _fill(number: Indices, value: Array, sigma: Array, good: NDArray[np.bool_]) -> None:
    """Regular steps where none was measured alone, from a line through the others."""
    columns = np.column_stack([np.ones(len(number)), number])
    weight = 1.0 / (np.where(good, sigma, 1.0) ** 2 + UNCHECKED**2) * good
    fit = np.array(robust_plane(columns[good].T, value[good], weight[good], 0.02))
    variance = np.linalg.inv(columns.T @ (columns * weight[:, None]))
    own = np.einsum("ij,jk,ik->i", columns, variance, columns)
    value[~good] = (columns @ fit)[~good]
    sigma[~good] = np.sqrt(own + UNCHECKED**2)[~good]


def _without_odd(line: StairLine, s: Array, t: Array, z: Array, tight: float) -> StairLine:
    """Line fitted to its steps alone, and not to the last riser, which may be another one."""
    if line.last - line.first < 2:
        return line
    inner = replace(line, last=line.last - 1)
    return replace(fitted(inner, s, t, z, tolerances=(2 * tight, tight)), last=line.last)


def _width(step: Indices, t: Array, line: StairLine) -> tuple[float, float]:
    """Median over the steps of where they begin and end across."""
    low, high = [], []
    for k in range(line.first, line.last + 1):
        here = t[step == k]
        if len(here) >= 10:
            low.append(quantile(here, 0.005))
            high.append(quantile(here, 0.995))
    if not low:
        return float(t.min()), float(t.max())
    return median(np.array(low)), median(np.array(high))
