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
from kaidan.readers.sentences import scans as text
from kaidan.readers.stairfit.chain import staircases
from kaidan.readers.stairfit.corridor import NARROWEST, SURE, lanes
from kaidan.readers.stairfit.doubts import LOCAL
from kaidan.readers.stairfit.gates import refused, surface_refusal
from kaidan.readers.stairfit.gravity import Upward, frame, leant, refined
from kaidan.readers.stairfit.one_flight import estimate, measured, tilted, with_gap
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
from kaidan.readers.stairfit.quantiles import median
from kaidan.readers.stairfit.same_flight import beside, continues, wider, within
from kaidan.readers.stairfit.viewpoint import seen_from_origin
from kaidan.readers.stairfit.views import Views

RANGE_ERROR, RANGE_ERROR_SURVEYED = 0.005, 0.001
"""Doubt of distances where nobody states it, as a share of them [1]: of a depth camera or a robot's
scanner, and of a surveyor's instrument."""
STATED, LEVELLED = math.radians(1.5), math.radians(0.2)
"""Standard error of an up axis that a file states or a person, and of one that a surveyor's
instrument levelled [rad]."""
AGAIN = math.radians(0.1)
"""Angle by which the treads turn what is level, from which flights are measured again [rad]."""
COARSE = 0.03
"""Side of the cubes of which one point is enough to find stairs [m]."""
MOST_FLIGHTS = 8
"""Flights that are looked for in one cloud."""
MOST_PATCHED = 40_000
"""Points from which patches are made."""
MANY_LEFT = 400
"""Points of the thinned cloud from which another flight is looked for."""
NOISY, WIDE = 0.008, 0.18
"""Scatter from which patches are made larger, and their side then [m]."""
FEWEST_POINTS = 20
"""Points without which nothing is looked for."""
SURVEYED = ("las", "e57")
"""Formats of instruments that level themselves."""


LIKELY_RISES = (0.10, 0.24)
"""Mean rises [m] from which a unit or an up axis that nobody stated is taken for the right one."""
EXTENTS = (0.5, 300.0)
"""Smallest and largest extent of a cloud with stairs [m]."""


@dataclass(frozen=True, eq=False)
class _Try:
    """Flights found with one unit and one direction up."""

    flights: tuple[FlightEstimate, ...]
    refusals: tuple[Refusal, ...]
    score: float
    provenance: Provenance
    frame: Array
    sure: bool = False
    """Whether one of them leaves no need to look in another direction."""
    turned: bool = False
    """Whether its steps hide what such hide that are upside down."""
    leans: tuple[tuple[Array, float, float], ...] = ()
    """Of each flight its heading, shape (3,), the angle by which up leans along it as its treads
    have it, and its doubt [rad]."""


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
    """
    xyz = _those(points.xyz, np.isfinite(points.xyz[:, 0]))
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
    some = _some(xyz)
    middle = [median(each) for each in some[::10].T]
    if any(np.ptp(each) > EXTENTS[1] for each in xyz.T):
        near = [np.abs(each - at) < EXTENTS[1] for each, at in zip(xyz.T, middle, strict=True)]
        xyz = _those(xyz, near[0] & near[1] & near[2])
        some = _some(xyz)
    if len(xyz) < FEWEST_POINTS:
        known = points.provenance.up or Known("+z", "assumed")
        nowhere = replace(points.provenance, unit=unit, up=known)
        return _Try((), (), 0.0, nowhere, np.eye(3))
    eye = None
    if points.viewpoint is not None and (
        points.grid is not None or hints.viewpoint is not None or points.viewpoint.any()
    ):
        eye = points.viewpoint * metres
    small = rastered(some, SMALL)
    noise = scatter(small)
    sensor = eye
    if eye is None and points.provenance.up is None and seen_from_origin(some):
        sensor = np.zeros(3)
    patches = patches_of(rastered(some, WIDE) if noise > NOISY else joined(small), sensor)
    rows = thinned(some, COARSE)
    thin, of_thin = some.T.take(rows, axis=1).T, patches.of_point[rows]
    cloud = _Cloud(replace(points.provenance, unit=unit), xyz, thin, of_thin, patches, noise, eye)
    ups = _ups(points.provenance.up, patches, oriented=sensor is not None)
    best = _first_up(cloud, ups, hints, placed=eye is not None)
    up = best.provenance.up
    if sensor is not None or not best.flights or up is None or up.how != "scored":
        return best
    note = text.UPSIDE_DOWN.format(up=up.value)
    return replace(best, provenance=replace(best.provenance, notes=(*cloud.provenance.notes, note)))


def _first_up(cloud: _Cloud, ups: list[tuple[Array, Known]], hints: Hints, *, placed: bool) -> _Try:
    """Best of the directions up, none tried after a sure one, nor the one against a good one.

    That one is taken where it has stairs too, nothing states from where they were seen (`placed`),
    and what their steps hide says that the other ones are upside down.
    """
    best, good = None, list[Array]()
    for up, known in ups:
        if any(float(other @ up) < -0.9 for other in good):
            continue
        tried = _with_up(cloud, up, known, hints)
        if tried.turned and not placed and known.how == "scored":
            against = replace(known, value="-+"[known.value[0] == "-"] + known.value[1])
            over = _with_up(cloud, -up, against, hints)
            tried = over if over.flights and not over.turned else tried
        if best is None or tried.score > best.score:
            best = tried
        if tried.sure:
            break
        good += [up] if tried.flights else []
    assert best is not None
    return best


def _some(xyz: Array) -> Array:
    """As many of the points as patches are made of, evenly."""
    if len(xyz) <= MOST_PATCHED:
        return xyz
    rows = np.linspace(0, len(xyz) - 1, MOST_PATCHED).astype(np.int64)
    return xyz.T.take(rows, axis=1).T


def _those(xyz: Array, which: NDArray[np.bool_]) -> Array:
    """Some of the points, each coordinate in one piece of memory: they are read one by one."""
    if which.all():
        return np.ascontiguousarray(xyz.T).T
    return np.array([each[which] for each in xyz.T]).T


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
    # upside down stairs are stairs: where nothing says which it is, files have a positive axis up
    ups.sort(key=lambda each: (not oriented and each[1].value[0] == "-", -float(each[0][2])))
    return ups[:8] or [(np.array([0.0, 0.0, 1.0]), Known("+z", "assumed"))]


def _with_up(seen: _Cloud, up: Array, known: Known, hints: Hints) -> _Try:
    provenance, patches = replace(seen.provenance, up=known), seen.patches
    sigma = LEVELLED if provenance.form in SURVEYED else STATED
    sigma = hints.gravity if hints.gravity is not None else sigma
    side = upright(known.value)[0]
    sigma = sigma if known.how != "scored" else math.radians(20.0)
    error = RANGE_ERROR_SURVEYED if provenance.form in SURVEYED else RANGE_ERROR
    error = error if hints.range_error is None else hints.range_error
    upward = refined(patches, up, sigma, eye=seen.eye, local=LOCAL * error)
    tried = _along(seen, upward, side, provenance, error)
    if seen.eye is None:
        return tried
    better = upward
    for ahead, angle, doubt in tried.leans:
        better = leant(better, ahead, angle, doubt, up, sigma)
    if float(better.built @ upward.built) > math.cos(AGAIN):
        return tried
    return _along(seen, better, side, provenance, error)


def _along(seen: _Cloud, upward: Upward, side: Array, provenance: Provenance, error: float) -> _Try:
    """Flights along what is taken for level and plumb."""
    patches, noise = seen.patches, seen.noise
    turn, upright_turn = frame(upward.built, side), frame(upward.up, side)
    against = turn @ upward.against @ turn.T
    level = replace(patches, middle=patches.middle @ turn.T, normal=patches.normal @ turn.T)
    thin = (turn @ seen.thin.T).T  # each coordinate in one piece of memory
    along = Views(thin, level, seen.of_thin)
    eye = np.zeros(3) if seen.eye is None else seen.eye
    tolerance = min(max(3 * noise, 0.012), 0.04)
    flights: list[FlightEstimate] = []
    refusals: list[Refusal] = []
    leans: list[tuple[Array, float, float]] = []
    sure, score, hides, left = False, 0.0, 0.0, np.ones(len(thin), dtype=bool)
    for _ in range(MOST_FLIGHTS):
        flight = None
        for lane in islice(lanes(along, left, tolerance, another=bool(flights)), 2):
            steps, aligned, placed = measured(lane, seen.xyz, turn, eye, noise, error, against)
            refusal = refused(steps, lane, noise, provenance)
            if refusal is not None:
                refusals.append(refusal)
                continue
            assert steps is not None
            hides += steps.upright
            flight = estimate(steps, aligned, upward.sigma, error, placed)
            stood = None if seen.eye is None else turn @ seen.eye
            flight = with_gap(flight, steps, placed, stood)
            if math.isfinite(steps.lean[0]):
                ahead = np.array([math.cos(aligned.heading), math.sin(aligned.heading), 0.0])
                leans.append((ahead @ turn, *steps.lean))
            break
        if flight is None:
            break
        rise, going = flight.regular.rise, flight.regular.going
        likely = 1.0 if LIKELY_RISES[0] <= rise <= LIKELY_RISES[1] else 0.3
        score += lane.score * likely * (1.0 if rise <= going else 0.5)
        sure |= lane.explained > SURE and likely == 1.0 and rise <= going
        before = left.sum()
        left &= ~within(flight, thin)
        parts = [k for k, other in enumerate(flights) if beside(flight, other)]
        if parts:
            flights[parts[0]] = wider(flights[parts[0]], flight)
        elif flight.width >= NARROWEST and not any(continues(flight, one) for one in flights):
            flights.append(flight)
        if left.sum() > before - 20 or left.sum() < MANY_LEFT:
            break
    if not flights:
        score = 0.0
        refusals = surface_refusal(level, provenance) + refusals
    leant = upright_turn @ turn.T
    flights = [tilted(flight, leant) for flight in flights]
    return _Try(
        tuple(flights), tuple(refusals), score, provenance, upright_turn, sure, hides < 0.0,
        tuple(leans),
    )  # fmt: skip
