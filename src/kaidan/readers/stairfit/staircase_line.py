"""The stair polyline: regular steps fitted to the points of a side view.

A point belongs to the tread or the riser that is nearest. Treads say where the levels are, risers
where the faces are: two straight lines over the number of the step, fitted by least squares with
weights that fall to zero for what lies too far away (Beaton & Tukey 1974).
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.quantiles import quantile

_BINS = 12
"""Parts of a going in which the phase is sought."""
EDGE_LANE = 0.05
"""Width of a lane in which the end of a tread or of a riser is sought [m]."""
BEFORE, GOES_ON = 0.45, 0.1
"""Part of a step up to which the end of an element is sought beyond its regular place, and part of
that next to which, as within a gap, the element goes on instead [1]."""
FEWEST_OF_LANE = 3
"""Points that an end needs in its lane."""
SCARCE = 0.15
"""Share of one sort of points below which ends take their place [1]."""
INNER_TREAD, INNER_RISER = (0.1, 0.92), (0.1, 0.9)
"""Parts of a tread and of a riser that lie away from the edges [1]."""
_LEVEL = 0.02
"""Height of a bin in which it is sought [m]."""


@dataclass(frozen=True)
class StairLine:
    """Nosing k stands at s0 + k going + skew t, z0 + k rise, from k = first to last."""

    s0: float
    z0: float
    going: float
    rise: float
    skew: float = 0.0
    """Change of s along a nosing with t: its heading is off by so much [rad]."""
    first: int = 0
    last: int = 0

    def at(self, k: Array | Indices) -> Array:
        """(s, z) of nosings at t = 0, shape (m, 2) [m]."""
        k = np.asarray(k, dtype=np.float64)
        return np.column_stack([self.s0 + k * self.going, self.z0 + k * self.rise])

    def local(self, s: Array, t: Array, z: Array) -> tuple[Indices, Array, Array]:
        """Step of each point, and its place ahead of the nosing and above the tread [m]."""
        ahead = s - self.skew * t - self.s0
        k = np.floor(ahead / self.going)
        return k.astype(np.int64), ahead - k * self.going, z - self.z0 - k * self.rise


def phase(s: Array, z: Array, going: float, rise: float) -> tuple[StairLine, float]:
    """Line of known steps that most points lie on, and how many more than on its average shift."""
    k = np.floor(s / going)
    u, v = s - k * going, z - k * rise
    column = np.minimum((u * (_BINS / going)).astype(np.int64), _BINS - 1)
    low = float(v.min()) - rise - 2 * _LEVEL
    row = ((v - low) / _LEVEL).astype(np.int64)
    rows = int(row.max()) + 3
    view = np.bincount(column * rows + row, minlength=_BINS * rows).reshape(_BINS, rows)
    view = np.minimum(view, max(8.0, quantile(view[view > 0], 0.99))).astype(np.float64)
    down = round(rise / _LEVEL)
    wide = view + 0.5 * (np.roll(view, 1, axis=1) + np.roll(view, -1, axis=1))
    lowered = np.roll(wide, down, axis=1)
    before = np.vstack([np.zeros(rows), np.cumsum(lowered, axis=0)[:-1]])
    behind = wide.sum(axis=0) - np.vstack([np.zeros(rows), np.cumsum(wide, axis=0)[:-1]])
    faces = np.cumsum(view, axis=1)
    faces = faces - np.roll(faces, down, axis=1)
    faces = faces + 0.5 * (np.roll(faces, 1, axis=0) + np.roll(faces, -1, axis=0))
    score = before + behind + faces
    score[:, :down] = 0.0
    kernel = np.ones(down + 1) / (down + 1)
    mean = np.convolve(score.mean(axis=0), kernel, mode="same")
    best = np.unravel_index(int(np.argmax(score - mean)), score.shape)
    found = StairLine(
        s0=(best[0] + 0.5) * going / _BINS,
        z0=low + (best[1] + 0.5) * _LEVEL,
        going=going,
        rise=rise,
    )
    return found, float(score[best] - mean[best[1]])


@dataclass(frozen=True, eq=False)
class Assigned:
    """Points by the element that they lie on."""

    step: Indices
    """Tread k begins at nosing k, riser k ends at it."""
    tread: NDArray[np.bool_]
    riser: NDArray[np.bool_]
    off: Array
    """Distance above the tread or behind the riser [m]; of others the smaller one."""
    ahead: Array
    """Place ahead of the nosing [m]."""
    over: Array
    """Place above the tread [m]."""
    line: StairLine

    @cached_property
    def inner(self) -> NDArray[np.bool_]:
        """Whether it lies away from the edges.

        Near one a point of a riser may pass for one of a tread of the wrong level, and a point of a
        tread for one of a riser at the wrong place.
        """
        above, along = self.over / self.line.rise, self.ahead / self.line.going
        above = np.where(above < 0.0, above + 1.0, above)
        riser = (above > INNER_RISER[0]) & (above < INNER_RISER[1])
        tread = (along > INNER_TREAD[0]) & (along < INNER_TREAD[1])
        return np.asarray(np.where(self.riser, riser, tread))


def assigned(line: StairLine, s: Array, t: Array, z: Array, tolerance: float) -> Assigned:
    """Nearest tread or riser of each point, as far as one is within the tolerance."""
    k, u, v = line.local(s, t, z)
    g, r = line.going, line.rise
    over = v > 0
    # a point above the tread may lie on the riser ahead, one below it on its own riser
    face = np.where(over, u - g, u)
    far, high = np.abs(face), np.abs(v)
    riser = (far < tolerance) & (far < high) & (high < r)
    tread = ~riser & (high < tolerance)
    return Assigned(k + (riser & over), tread, riser, np.where(riser, face, v), u, v, line)


def grouped(rows: Indices, number: Array | Indices, count: int) -> list[Indices]:
    """Rows of the points of each step from 0 on, sorted once."""
    short = number.astype(np.int16)  # short ones are sorted by counting
    order = np.argsort(short, kind="stable")
    return np.split(rows[order], np.cumsum(np.bincount(short, minlength=count))[:-1])


def explained_share(line: StairLine, s: Array, t: Array, z: Array, tolerance: float) -> float:
    """Share of the points about a line that lie on it, less what would by chance."""
    k, u, v = line.local(s, t, z)
    over = v - line.rise * (u / line.going - 0.5)  # above the middle of the steps
    near = (np.abs(over) < line.rise) & (k >= line.first) & (k < line.last)
    if near.sum() < 20:
        return 0.0
    at = assigned(line, s[near], t[near], z[near], tolerance)
    weight = np.where(at.tread | at.riser, 1 - np.minimum(np.abs(at.off) / tolerance, 1) ** 2, 0)
    chance = (2 / 3) * tolerance * (line.going + line.rise) / (line.going * line.rise)
    return float((weight.mean() - chance) / (1 - chance))


@dataclass(frozen=True, eq=False)
class Edges:
    """Ends of treads towards the nosing, or upper ends of risers, lane by lane."""

    step: Indices
    t: Array
    at: Array
    """s of the front of a tread, z of the top of a riser [m]."""
    gap: Array
    """Distance to the next point within, by which the end is uncertain [m]."""


def fronts(
    line: StairLine, s: Array, t: Array, z: Array, tolerance: float, wide: float = EDGE_LANE
) -> Edges:
    """Front ends of treads: least s of the points at the level of a tread."""
    ahead = s - line.skew * t - line.s0
    k = np.floor(ahead / line.going + BEFORE).astype(np.int64)
    on = (np.abs(z - line.z0 - k * line.rise) < tolerance) & _within(line, k)
    found = _ends(k[on], t[on], -ahead[on], 0.3 * line.going, wide)
    found = _ending(found, found.at + found.step * line.going, BEFORE * line.going)
    return replace(found, at=-found.at + line.s0 + line.skew * found.t)


def tops(
    line: StairLine, s: Array, t: Array, z: Array, tolerance: float, wide: float = EDGE_LANE
) -> Edges:
    """Upper ends of risers: greatest z of the points at the face of a riser."""
    ahead = s - line.skew * t - line.s0
    k = np.round(ahead / line.going).astype(np.int64)
    up = z - line.z0 - k * line.rise
    on = (np.abs(ahead - k * line.going) < tolerance) & (up > -0.75 * line.rise)
    on &= (up < BEFORE * line.rise) & _within(line, k)
    found = _ends(k[on], t[on], z[on], 0.35 * line.rise, wide)
    return _ending(found, found.at - line.z0 - found.step * line.rise, BEFORE * line.rise)


def _ending(edges: Edges, beyond: Array, sought: float) -> Edges:
    """Those of the ends that are some: what goes on farther than they are sought has none."""
    good = beyond < sought - np.maximum(edges.gap, GOES_ON * sought)
    return Edges(edges.step[good], edges.t[good], edges.at[good], edges.gap[good])


def _within(line: StairLine, k: Indices) -> NDArray[np.bool_]:
    return np.asarray((k >= line.first) & (k <= line.last))


def _ends(k: Indices, t: Array, value: Array, reach: float, wide: float) -> Edges:
    """Greatest value in each lane of each step, half a gap added; lanes with few points left out.

    The gap is the mean distance d from one point near the end to the one below it, each weighted
    by itself: sum d^2 / sum d. For rows of a camera and rings of a LiDAR, which end at the same
    place in all lanes, that is their distance; for points that lie anyhow twice the mean one. In
    both cases the true end is half of it farther on average.
    """
    if len(k) < FEWEST_OF_LANE:
        return Edges(k[:0], t[:0], t[:0], t[:0])
    lane = np.floor(t / wide).astype(np.int64)
    lanes = int(np.ptp(lane)) + 1
    key = (k - k.min()) * lanes + lane - lane.min()
    top = np.full(int(key.max()) + 1, -np.inf)
    np.maximum.at(top, key, value)
    low = top - reach
    near = np.flatnonzero(value >= low[key])
    value, of = value[near], key[near]
    order = np.argsort(of + 0.5 * (value - low[of]) / reach)  # by lane, and in it by the value
    value, of = value[order], of[order]
    step = np.r_[np.inf, np.diff(value)]
    step[np.r_[True, of[1:] != of[:-1]]] = np.inf
    step = np.minimum(step, value - low[of])
    square, one = (np.bincount(of, each, len(top)) for each in (step**2, step))
    good = np.flatnonzero(np.bincount(of, minlength=len(top)) >= FEWEST_OF_LANE)
    gap = square[good] / np.maximum(one[good], 1e-9)
    middle = np.bincount(key, t)[good] / np.bincount(key)[good]
    return Edges(good // lanes + k.min(), middle, top[good] + 0.5 * gap, gap)


def fitted(
    line: StairLine, s: Array, t: Array, z: Array, *, tolerances: tuple[float, ...]
) -> StairLine:
    """Line through the points, iterated with shrinking tolerances.

    Levels come from treads, faces from risers; where few points lie on treads from the tops of
    risers, and where few lie on risers from the fronts of treads.
    """
    for tolerance in tolerances:
        at = assigned(line, s, t, z, tolerance)
        use = _within(line, at.step)
        tread, riser = np.flatnonzero(at.tread & use), np.flatnonzero(at.riser & use)
        level, face = len(tread), len(riser)
        w_z, w_s = (
            (1 - np.minimum(np.abs(at.off[rows]) / tolerance, 1.0) ** 2) ** 2
            for rows in (tread, riser)
        )
        k_z, z_z = at.step[tread], z[tread]
        k_s, t_s, s_s = at.step[riser], t[riser], s[riser]
        wide = max(tolerance, 0.025)
        if level < SCARCE * face:
            edges = tops(line, s, t, z, wide)
            k_z, z_z = np.r_[k_z, edges.step], np.r_[z_z, edges.at]
            w_z = np.r_[0.1 * w_z, np.full(len(edges.at), 3.0)]
        if face < SCARCE * level:
            edges = fronts(line, s, t, z, wide)
            k_s, t_s, s_s = np.r_[k_s, edges.step], np.r_[t_s, edges.t], np.r_[s_s, edges.at]
            w_s = np.r_[0.1 * w_s, np.full(len(edges.at), 3.0)]
        found = line
        if len(k_z) and np.ptp(k_z) >= 1:
            z0, rise = robust_plane(np.array([np.ones(len(k_z)), k_z]), z_z, w_z, tolerance)
            found = replace(found, z0=z0, rise=rise)
        if len(k_s) and np.ptp(k_s) >= 1:
            terms = np.array([np.ones(len(k_s)), k_s, t_s])
            s0, going, skew = robust_plane(terms, s_s, w_s, tolerance)
            found = replace(found, s0=s0, going=going, skew=skew)
        if not (0.05 < found.going < 0.6 and 0.05 < found.rise < 0.45 and abs(found.skew) < 0.4):
            return line
        line = found
    return line


def robust_plane(terms: Array, value: Array, weight: Array, scale: float) -> list[float]:
    """Coefficients of a weighted linear fit, what lies far from it left out step by step.

    `terms` are the values that the coefficients belong to, shape (c, n).
    """
    for _ in range(3):
        weighted = terms * weight
        ridge = 1e-9 * max(float(weight.sum()), 1e-12)
        found = _solved((weighted @ terms.T).tolist(), (weighted @ value).tolist(), ridge)
        far = (np.abs(value - found @ terms) >= 2.0 * scale) & (weight > 0.0)
        if not far.any():
            break
        weight = weight * ~far
        if weight.sum() < 3:
            break
    coefficients: list[float] = found.tolist()
    return coefficients


def _solved(normal: list[list[float]], right: list[float], ridge: float) -> Array:
    """Solution of two or three normal equations by elimination, sooner than by a general one.

    Examples
    --------
    >>> _solved([[2.0, 1.0], [1.0, 3.0]], [3.0, 5.0], 0.0).round(12).tolist()
    [0.8, 1.4]
    """
    count = len(right)
    rows = [[*normal[k], right[k]] for k in range(count)]
    for k in range(count):
        rows[k][k] += ridge
    for k in range(count):
        for below in rows[k + 1 :]:
            share = below[k] / rows[k][k]
            for column in range(k, count + 1):
                below[column] -= share * rows[k][column]
    found = [0.0] * count
    for k in reversed(range(count)):
        known = sum(rows[k][column] * found[column] for column in range(k + 1, count))
        found[k] = (rows[k][count] - known) / rows[k][k]
    return np.array(found)
