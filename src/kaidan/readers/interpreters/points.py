"""Staircases in a point cloud: gravity, lanes, steps, gates, flights in a chain."""

import math
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.estimate import Found, Refusal
from kaidan.readers.flight import FlightEstimate
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import METRES, Array, Indices, Known, Points, Provenance, upright
from kaidan.readers.stairfit.chain import staircases
from kaidan.readers.stairfit.corridor import NARROWEST, Lane, lanes, rotated, views
from kaidan.readers.stairfit.doubts import LOCAL
from kaidan.readers.stairfit.gates import refused, surface_refusal
from kaidan.readers.stairfit.gravity import frame, refined
from kaidan.readers.stairfit.landing_end import landing_end
from kaidan.readers.stairfit.patches import (
    SMALL,
    Patches,
    directions,
    joined,
    patches_of,
    rastered,
    scatter,
    thinned,
)
from kaidan.readers.stairfit.steps import Steps, steps_of
from kaidan.text import scans as text

RANGE_ERROR, RANGE_ERROR_SURVEYED = 0.005, 0.001
"""Doubt of distances where nobody states it, as a share of them [1]: of a depth camera or a robot's
scanner, and of a surveyor's instrument."""
STATED, LEVELLED = math.radians(1.5), math.radians(0.2)
"""Standard error of an up axis that a file states or a person, and of one that a surveyor's
instrument levelled [rad]."""
COARSE = 0.03
"""Side of the cubes of which one point is enough to find stairs [m]."""
MOST_FLIGHTS = 8
"""Flights that are looked for in one cloud."""
MOST_PATCHED = 60_000
"""Points from which patches are made."""
SAME_NOSING = 0.04
"""Distance of nosings that are one [m]."""
CONTINUES = 0.3
"""Distance from the place of the next nosing up to which another one is that, in steps [1]."""
MANY_LEFT = 400
"""Points of the thinned cloud from which another flight is looked for."""
NOISY, WIDE = 0.008, 0.18
"""Scatter from which patches are made larger, and their side then [m]."""
LOWEST_CEILING = 1.2
"""Height above the nosings from which something is a ceiling and no handrail [m]."""
FEWEST_POINTS = 20
"""Points without which nothing is looked for."""
SURVEYED = ("las", "e57")
"""Formats of instruments that level themselves."""


LIKELY_RISES = (0.10, 0.24)
"""Mean rises [m] from which a unit or an up axis that nobody stated is taken for the right one."""
EXTENTS = (0.5, 300.0)
"""Smallest and largest extent of a cloud with stairs [m]."""


_Placed = tuple[Array, Array, Array]
"""Points along a heading: s, t, z, shape (n,) each [m]."""


@dataclass(frozen=True, eq=False)
class _Try:
    """Flights found with one unit and one direction up."""

    flights: tuple[FlightEstimate, ...]
    refusals: tuple[Refusal, ...]
    score: float
    provenance: Provenance
    frame: Array


@dataclass(frozen=True, eq=False)
class _Cloud:
    """A cloud in metres, with what does not depend on which way is up."""

    provenance: Provenance
    xyz: Array
    """All points, shape (n, 3) [m]."""
    thin: Array
    """One point of each small cube, shape (m, 3) [m]."""
    of_thin: Indices
    """Patch of each of them, shape (m,); -1: none."""
    patches: Patches
    noise: float
    """Scatter of the points [m]."""
    eye: Array | None
    """Where the sensor stood, shape (3,) [m]; None: not known."""


def found(points: Points, hints: Hints) -> Found:
    """Staircases that a cloud holds, or why it holds none.

    A unit and an up axis that nobody states are those with which stairs come out; where none come
    out metres are assumed.

    Parameters
    ----------
    points : Points
        As a reader yields them.
    hints : Hints
        What the person knows.

    Returns
    -------
    Found
    """
    xyz = _those(np.ascontiguousarray(points.xyz.T).T, np.isfinite(points.xyz[:, 0]))
    best: _Try | None = None
    for unit in _units(points, xyz):
        metres = METRES[unit.value]
        tried = _with_unit(points, xyz if metres == 1.0 else xyz * metres, unit, metres, hints)
        if best is None or tried.score > best.score:
            best = tried
        if best.flights:
            break
    assert best is not None
    if best.flights:
        stairs = staircases(best.flights, best.provenance, best.frame)
        return Found(best.provenance, staircases=stairs, contents=points)
    refusals = sorted(best.refusals, key=lambda each: each.why == "none")
    refusals = refusals or [Refusal("none", {}, best.provenance)]
    return Found(best.provenance, refusals=tuple(refusals[:1]), contents=points)


def _units(points: Points, xyz: Array) -> list[Known]:
    if points.provenance.unit is not None:
        return [points.provenance.unit]
    extent = float(np.linalg.norm(np.ptp(np.percentile(xyz, [5, 95], axis=0), axis=0)))
    plausible = [unit for unit in ("m", "mm", "cm", "ft", "in")
                 if EXTENTS[0] <= extent * METRES[unit] <= EXTENTS[1]]  # fmt: skip
    return [Known(unit, "scored") for unit in plausible] or [Known("m", "assumed")]


def _with_unit(points: Points, xyz: Array, unit: Known, metres: float, hints: Hints) -> _Try:
    # stray points far away would make rasters of any size
    middle = np.median(_some(xyz)[::10], axis=0)
    near = [np.abs(each - at) < EXTENTS[1] for each, at in zip(xyz.T, middle, strict=True)]
    xyz = _those(xyz, near[0] & near[1] & near[2])
    if len(xyz) < FEWEST_POINTS:
        known = points.provenance.up or Known("+z", "assumed")
        nowhere = replace(points.provenance, unit=unit, up=known)
        return _Try((), (), 0.0, nowhere, np.eye(3))
    eye = None
    if points.viewpoint is not None and (
        points.grid is not None or hints.viewpoint is not None or points.viewpoint.any()
    ):
        eye = points.viewpoint * metres
    some = _some(xyz)
    small = rastered(some, SMALL)
    noise = scatter(small)
    patches = patches_of(rastered(some, WIDE) if noise > NOISY else joined(small), eye)
    rows = thinned(some, COARSE)
    thin, of_thin = some[rows], patches.of_point[rows]
    cloud = _Cloud(replace(points.provenance, unit=unit), xyz, thin, of_thin, patches, noise, eye)
    ups = _ups(points.provenance.up, patches, oriented=eye is not None)
    return max((_with_up(cloud, up, known, hints) for up, known in ups), key=lambda one: one.score)


def _some(xyz: Array) -> Array:
    """As many of the points as patches are made of, evenly."""
    if len(xyz) <= MOST_PATCHED:
        return xyz
    rows = np.linspace(0, len(xyz) - 1, MOST_PATCHED).astype(np.int64)
    return xyz.T.take(rows, axis=1).T


def _those(xyz: Array, which: NDArray[np.bool_]) -> Array:
    """Some of the points, each coordinate in one piece of memory: they are read one by one."""
    return xyz if which.all() else xyz.T.compress(which, axis=1).T


def _ups(stated: Known | None, patches: Patches, *, oriented: bool) -> list[tuple[Array, Known]]:
    """Directions that may be up: the one stated, else those in which many patches look."""
    if stated is not None:
        return [(upright(stated.value)[2], stated)]
    ups = []
    for axis in directions(patches, 4):
        towards = float(((patches.normal @ axis) > 0.9) @ patches.weight)
        away = float(((patches.normal @ axis) < -0.9) @ patches.weight)
        signs = [1.0 if towards >= away else -1.0] if oriented else [1.0, -1.0]
        for sign in signs:
            up = sign * axis
            most = int(np.argmax(np.abs(up)))
            name = ("+" if up[most] > 0 else "-") + "xyz"[most]
            ups.append((up, Known(name, "scored")))
    ups.sort(key=lambda each: -float(each[0][2]))
    return ups[:6] or [(np.array([0.0, 0.0, 1.0]), Known("+z", "assumed"))]


def _with_up(seen: _Cloud, up: Array, known: Known, hints: Hints) -> _Try:
    provenance, patches, noise = replace(seen.provenance, up=known), seen.patches, seen.noise
    sigma = LEVELLED if provenance.form in SURVEYED else STATED
    sigma = hints.gravity if hints.gravity is not None else sigma
    side = upright(known.value)[0]
    sigma = sigma if known.how != "scored" else math.radians(20.0)
    error = RANGE_ERROR_SURVEYED if provenance.form in SURVEYED else RANGE_ERROR
    error = error if hints.range_error is None else hints.range_error
    upward = refined(patches, up, sigma, eye=seen.eye, local=LOCAL * error)
    turn, upright_turn = frame(upward.built, side), frame(upward.up, side)
    against = turn @ upward.against @ turn.T
    level = replace(patches, middle=patches.middle @ turn.T, normal=patches.normal @ turn.T)
    thin, cloud = seen.thin @ turn.T, (turn @ seen.xyz.T).T
    along = views(thin, level, seen.of_thin)
    eye = np.zeros(3) if seen.eye is None else turn @ seen.eye
    tolerance = min(max(3 * noise, 0.012), 0.04)
    flights: list[FlightEstimate] = []
    refusals: list[Refusal] = []
    score, left = 0.0, np.ones(len(thin), dtype=bool)
    for _ in range(MOST_FLIGHTS):
        flight = None
        rest = [each.of(left) for each in along]
        for lane in islice(lanes(rest, tolerance, another=bool(flights)), 2):
            steps, aligned, placed = _steps(lane, cloud, eye, noise, error, against)
            refusal = refused(steps, lane, noise, provenance)
            if refusal is not None:
                refusals.append(refusal)
                continue
            assert steps is not None
            flight = _flight(steps, aligned, upward.sigma, error, placed)
            break
        if flight is None:
            break
        rise, going = flight.regular.rise, flight.regular.going
        likely = 1.0 if LIKELY_RISES[0] <= rise <= LIKELY_RISES[1] else 0.3
        score += lane.score * likely * (1.0 if rise <= going else 0.5)
        before = left.sum()
        left &= ~_within(flight, thin)
        beside = [k for k, other in enumerate(flights) if _beside(flight, other)]
        if beside:
            flights[beside[0]] = _wider(flights[beside[0]], flight)
        elif flight.width >= NARROWEST and not any(_continues(flight, one) for one in flights):
            flights.append(flight)
        if left.sum() > before - 20 or left.sum() < MANY_LEFT:
            break
    if not flights:
        score = 0.0
        refusals = surface_refusal(level, provenance) + refusals
    tilted = upright_turn @ turn.T
    flights = [_tilted(flight, tilted) for flight in flights]
    return _Try(tuple(flights), tuple(refusals), score, provenance, upright_turn)


def _tilted(flight: FlightEstimate, turn: Array) -> FlightEstimate:
    """Flight that was measured along what was built, in the frame of gravity."""
    foot = np.array([*flight.middle[0, :2], flight.floor])
    ahead = turn @ [math.cos(flight.heading), math.sin(flight.heading), 0.0]
    return replace(
        flight,
        left=flight.left @ turn.T,
        right=flight.right @ turn.T,
        heading=math.atan2(ahead[1], ahead[0]),
        floor=float((turn @ foot)[2]),
    )


def _steps(
    lane: Lane, cloud: Array, view: Array, noise: float, error: float, against: Array
) -> tuple[Steps | None, Lane, _Placed]:
    """Single steps of a lane in all points, after its heading was corrected by its skew.

    With the lane along that heading, and all points along it.
    """
    line = lane.line
    heading = lane.heading - math.atan(line.skew)
    placed = s, t, z = rotated(cloud, heading)
    turn = math.cos(heading - lane.heading)
    # a point at (s, t) of the lane's frame has s' = s cos + t sin, t' = t cos - s sin
    sine = math.sin(heading - lane.heading)
    line = replace(line, s0=line.s0 * turn, going=line.going * turn, skew=0.0)
    along = line.s0 + line.going * (line.first + line.last) / 2
    shift = -along / turn * sine
    low, high = lane.low + shift, lane.high + shift
    low, high = low - 0.5 * abs(sine), high + 0.5 * abs(sine)
    ends = line.at(np.array([line.first, line.last]))
    near = (t > low) & (t < high) & (s > ends[0, 0] - 1.6) & (s < ends[1, 0] + 1.8)
    near &= (z > ends[0, 1] - 0.9) & (z < ends[1, 1] + 2.4)
    aligned = replace(lane, heading=heading, line=line, low=low, high=high)
    eye = np.concatenate(rotated(view[None], heading))
    inside = s[near], t[near], z[near]
    ahead = np.array([math.cos(heading), math.sin(heading), 0.0])
    level = math.sqrt(float(ahead @ against @ ahead))
    steps = steps_of(line, *inside, noise=noise, eye=eye, range_error=error, level=level)
    return steps, aligned, placed


def _flight(
    steps: Steps, lane: Lane, gravity: float, error: float, cloud: _Placed
) -> FlightEstimate:
    """Estimate in the levelled frame of the cloud, whose points are given along the lane."""
    c, s = math.cos(lane.heading), math.sin(lane.heading)

    def placed(t: float) -> Array:
        along = steps.at[:, 0] + steps.line.skew * t
        return np.column_stack([along * c - t * s, along * s + t * c, steps.at[:, 1]])

    low, high = steps.width
    before, behind = _room(steps, *cloud)
    return FlightEstimate(
        left=placed(high),
        right=placed(low),
        heading=lane.heading - math.atan(steps.line.skew),
        covariance=steps.covariance,
        gravity=gravity,
        scale=error,
        floor=steps.floor,
        floor_sigma=steps.floor_sigma,
        with_floor=steps.with_floor,
        ends=steps.ends,
        roughness=steps.roughness,
        width=high - low,
        headroom=_headroom(steps, *cloud),
        run_up=steps.run_up,
        run_out=steps.landing,
        room_before=before,
        room_behind=behind,
        notes=tuple(_notes(steps)),
    )


def _notes(steps: Steps) -> list[str]:
    notes = []
    if not math.isfinite(steps.floor):
        notes.append(text.FLOOR_UNSEEN)
    elif steps.run_up < 1.2 * steps.line.going:
        notes.append(text.FLOOR_SHORT.format(seen_mm=1e3 * steps.run_up))
    if not steps.ends:
        notes.append(text.LANDING_UNSEEN)
    if not steps.measured.all():
        alone = int(steps.measured.all(axis=1).sum())
        notes.append(text.REGULAR.format(alone=alone, steps=len(steps.at)))
    return notes


def _headroom(steps: Steps, s: Array, t: Array, z: Array) -> float:
    """Least height above the line of the nosings of what hangs over it."""
    low, high = steps.width
    first, last = steps.at[0], steps.at[-1]
    inside = (t > low + 0.1) & (t < high - 0.1) & (s > first[0]) & (s < last[0])
    slope = (last[1] - first[1]) / (last[0] - first[0])
    over = z[inside] - first[1] - slope * (s[inside] - first[0])
    over = over[over > LOWEST_CEILING]
    return float(np.percentile(over, 1)) if len(over) > 30 else math.nan


def _room(steps: Steps, s: Array, t: Array, z: Array) -> tuple[float, float]:
    """How far from the first and the last nosing something stands across the way [m]; NaN: free."""
    first, last = steps.at[0], steps.at[-1]
    base = steps.floor if math.isfinite(steps.floor) else first[1] - steps.line.rise
    return (
        landing_end(first[0] - s, t, z - base, width=steps.width),
        landing_end(s - last[0], t, z - last[1], width=steps.width),
    )


def _beside(one: FlightEstimate, other: FlightEstimate) -> bool:
    """Whether two flights are parts of one, which somebody stood on, side by side."""
    if abs(math.sin((one.heading - other.heading) / 2)) > 0.03:
        return False
    s, _, z = rotated(one.middle, other.heading)
    line_s, _, line_z = rotated(other.middle, other.heading)
    k = np.abs(s[:, None] - line_s).argmin(axis=1)
    return bool(np.median(np.hypot(s - line_s[k], z - line_z[k])) < SAME_NOSING)


def _continues(one: FlightEstimate, other: FlightEstimate) -> bool:
    """Whether a flight leads on from another one without a landing, as its far end does.

    It is the same flight, of which too little was seen between; the other one says that its end was
    not seen.
    """
    if abs(math.sin((one.heading - other.heading) / 2)) > 0.03:
        return False
    lower, upper = sorted((one, other), key=lambda each: float(each.middle[0, 2]))
    s, t, z = rotated(np.vstack([lower.middle[-1], upper.middle[0]]), other.heading)
    step = np.array([other.regular.going, other.regular.rise])
    off = np.array([s[1] - s[0], z[1] - z[0]]) - np.arange(1, 4)[:, None] * step
    beside = abs(t[1] - t[0]) > max(one.width, other.width) / 2
    return bool((np.abs(off) < CONTINUES * step).all(axis=1).any()) and not beside


def _wider(flight: FlightEstimate, beside: FlightEstimate) -> FlightEstimate:
    """Flight with what lies beside it, its own nosings drawn out over the width of both."""
    left = np.array([-math.sin(flight.heading), math.cos(flight.heading)])
    sides = np.vstack([flight.left, flight.right, beside.left, beside.right])[:, :2] @ left
    across = (flight.left - flight.right) / flight.width
    middle = flight.middle[:, :2] @ left
    high, low = float(sides.max()), float(sides.min())
    return replace(
        flight,
        left=flight.middle + across * (high - middle)[:, None],
        right=flight.middle + across * (low - middle)[:, None],
        width=high - low,
    )


def _within(flight: FlightEstimate, thin: Array) -> NDArray[np.bool_]:
    """Points that belong to a flight: about its steps and between its sides."""
    s, t, z = rotated(thin, flight.heading)
    places = rotated(flight.middle, flight.heading)
    sides = rotated(np.vstack([flight.left, flight.right]), flight.heading)[1]
    along, up = places[0], places[2]
    slope = (up[-1] - up[0]) / (along[-1] - along[0])
    over = z - up[0] - slope * (s - along[0])
    return np.asarray(
        (s > along[0] - 0.25) & (s < along[-1] + 0.25) & (np.abs(over) < 0.35)
        & (t > sides.min() - 0.1) & (t < sides.max() + 0.1)
    )  # fmt: skip
