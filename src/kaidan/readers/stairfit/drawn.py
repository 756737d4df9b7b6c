"""Flights in a mesh that was drawn and not scanned: exact slices, corners that are nosings."""

import math
from dataclasses import dataclass

import numpy as np

from kaidan.readers.flight import FlightEstimate, independent
from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.slices import STEP, driven_line, slice_of
from kaidan.readers.stairfit.views import rotated
from kaidan.terrain.polyline import convex_corners
from kaidan.terrain.sentences import FLOOR_UNSEEN

AS_DRAWN = 5e-4
"""Standard uncertainty of a nosing of a model [m]: what is built from it differs more."""
SLICES = (0.12, 0.3, 0.5, 0.7, 0.88)
"""Places of the slices, as shares of the width."""
LANDING = 1.6
"""Going from which it is a landing, as a multiple of the median going."""
SHORT = 1.25
"""Length of a level as a multiple of the going up to which it is a tread and no floor."""
MOST_OVERHANG = 0.1
"""Distance of a riser behind its nosing from which there is none [m]."""
LARGEST_TURN = math.radians(1.0)
"""Angle between nosings from which they are winders [rad]."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles in metres, z up."""

    vertices: Array
    faces: Indices
    normal: Array
    """Unit normals, shape (m, 3)."""
    area: Array
    """Shape (m,) [m^2]."""
    middle: Array
    """Shape (m, 3)."""


def surface_of(vertices: Array, faces: Indices) -> Surface:
    """Surface without triangles that have no area."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    double = np.linalg.norm(cross, axis=1)
    good = double > 1e-12
    normal = cross[good] / double[good, None]
    return Surface(vertices, faces[good], normal, double[good] / 2, ((a + b + c) / 3)[good])


def headings(surface: Surface) -> list[float]:
    """Directions of ascent that risers, or treads one behind the other, suggest [rad]."""
    plumb = np.abs(surface.normal[:, 2]) < 0.02
    corners = surface.vertices[surface.faces]
    wide = np.linalg.norm(np.ptp(corners[:, :, :2], axis=1), axis=1) > 0.25
    risers = plumb & wide
    found: list[float] = []
    if risers.any():
        angle = np.arctan2(surface.normal[risers, 1], surface.normal[risers, 0])
        weight = surface.area[risers]
        while weight.sum() > 0.02 * surface.area[risers].sum() and len(found) < 12:
            best = angle[int(np.argmax(weight))]
            # an axis: normals of open faces may look either way
            near = np.abs(np.sin(angle - best)) < 0.02
            found += [float(best), float(best) + math.pi]
            weight = np.where(near, 0.0, weight)
    level = np.abs(surface.normal[:, 2]) > 0.999
    if level.sum() >= 3 and not found:
        xyz, weight = surface.middle[level], surface.area[level]
        off = xyz - weight @ xyz / weight.sum()
        towards = (off[:, :2] * (off[:, 2] * weight)[:, None]).sum(axis=0)
        found.append(math.atan2(towards[1], towards[0]))
    return found


def flights_of(surface: Surface) -> list[FlightEstimate]:
    """Straight flights of a surface, over all headings, those with most nosings first."""
    found: list[FlightEstimate] = []
    for heading in headings(surface):
        for flight in _along(surface, heading):
            if not any(_same(flight, other) for other in found):
                found.append(flight)
    return sorted(found, key=lambda flight: -len(flight))


def _same(one: FlightEstimate, other: FlightEstimate) -> bool:
    away = np.linalg.norm(one.middle[:, None] - other.middle[None], axis=2).min(axis=1)
    return bool((away < 0.05).mean() > 0.5)


def _along(surface: Surface, heading: float) -> list[FlightEstimate]:
    s, t, z = rotated(surface.vertices, heading)
    level = surface.normal[:, 2] > 0.999
    level |= surface.normal[:, 2] < -0.999  # faces of open meshes may look down
    corners_t, corners_s = t[surface.faces], s[surface.faces]
    tread = level & (np.ptp(corners_s, axis=1) < 0.65) & (np.ptp(corners_t, axis=1) > 0.3)
    if tread.sum() < 2:
        return []
    spans = np.column_stack([corners_t[tread].min(axis=1), corners_t[tread].max(axis=1)])
    places = np.column_stack([corners_s[tread].mean(axis=1), surface.middle[tread, 2]])
    flights: list[FlightEstimate] = []
    for low, high in _lanes(np.round(spans, 2)):
        here = (spans[:, 0] < low + 0.15) & (spans[:, 1] > high - 0.15)
        at = np.array([low + share * (high - low) for share in SLICES])
        slices = [slice_of(s, t, z, surface.faces, each) for each in at]
        for place in _starts(places[here]):
            flights += _flights(slices, at, low, high, heading, place)
    return flights


def _starts(treads: Array) -> list[Array]:
    """Lowest tread of each chain of treads that lead up step by step."""
    order = treads[np.lexsort((treads[:, 0], np.round(treads[:, 1], 3)))]
    starts: list[Array] = []
    ends: list[Array] = []
    for tread in order:
        for number, end in enumerate(ends):
            up, ahead = tread[1] - end[1], tread[0] - end[0]
            if -1e-3 < up < STEP and -0.3 < ahead < 2.5:
                ends[number] = tread if up > 1e-3 else end
                break
        else:
            starts.append(tread)
            ends.append(tread)
    return starts[:20]


def _lanes(ends: Array) -> list[tuple[float, float]]:
    """Spans across that treads have, those of most treads first, without those that overlap."""
    spans, counts = np.unique(ends, axis=0, return_counts=True)
    found: list[tuple[float, float]] = []
    for row in np.argsort(-counts)[:30]:
        low, high = spans[row].tolist()
        if all(high <= a + 0.1 or low >= b - 0.1 for a, b in found):
            found.append((low, high))
    return found[:6]


def _flights(
    slices: list[Array], at: Array, low: float, high: float, heading: float, start: Array
) -> list[FlightEstimate]:
    """Flights of which all slices have the same nosings."""
    lines = [driven_line(each, float(start[0]), float(start[1])) for each in slices]
    corners = [_nosings(line) for line in lines]
    usual = len(corners[len(corners) // 2])
    good = [k for k, each in enumerate(corners) if len(each) == usual]
    if usual < 2 or len(good) < 3:
        return []
    nosings = np.array([corners[k] for k in good])  # (slices, m, 2)
    line = lines[len(lines) // 2]
    middle = nosings.mean(axis=0)
    goings = np.diff(middle[:, 0])
    cuts = np.flatnonzero(goings > LANDING * float(np.median(goings)))
    flights = []
    for first, last in zip(np.r_[0, cuts + 1], np.r_[cuts, usual - 1], strict=True):
        if last - first < 1:
            continue
        rows = slice(int(first), int(last) + 1)
        middle = slices[len(slices) // 2]
        flight = _flight(nosings[:, rows], at[good], (low, high), heading, line, middle)
        if flight is not None:
            flights.append(flight)
    return flights


def _nosings(line: Array) -> Array:
    if len(line) < 4:
        return np.zeros((0, 2))
    keep = np.r_[True, (np.abs(np.diff(line, axis=0)) > 1e-9).any(axis=1)]
    line = line[keep]
    rising, _, _ = convex_corners(line)
    return np.asarray(line[rising])


def _with_first_tread(nosings: Array, line: Array) -> tuple[Array, bool]:
    """Nosings with that of a first tread that has no floor before it, and whether there is one.

    It is one where the line begins less than a going and a quarter before the first riser.
    """
    first = nosings[:, 0].mean(axis=0)
    going = float(np.diff(nosings.mean(axis=0)[:, 0]).mean())
    before = line[(line[:, 0] < first[0] - 1e-6) & (line[:, 1] < first[1])]
    if not len(before) or first[0] - before[0, 0] > SHORT * going:
        return nosings, False
    if np.ptp(before[:, 1]) > 2e-3 or first[0] - before[0, 0] < 0.5 * going:
        return nosings, False
    added = np.tile(before[0], (len(nosings), 1))[:, None]
    return np.concatenate([added, nosings], axis=1), True


def _faces(segments: Array, nosings: Array) -> tuple[float, bool]:
    """Overhang of the nosings over their risers [m], and whether the risers are open."""
    rises = np.diff(nosings[:, 1])
    behind = []
    for (s, z), rise in zip(nosings[1:], rises, strict=True):
        at = z - 0.6 * rise
        low, high = segments[:, :, 1].min(axis=1), segments[:, :, 1].max(axis=1)
        hit = segments[(low < at) & (high > at)]
        share = (at - hit[:, 0, 1]) / (hit[:, 1, 1] - hit[:, 0, 1])
        places = hit[:, 0, 0] + share * (hit[:, 1, 0] - hit[:, 0, 0]) - s
        near = places[(places > -0.005) & (places < MOST_OVERHANG)]
        if len(near):
            behind.append(float(near.min()))
    if len(behind) < 0.5 * len(rises):
        return 0.0, True
    overhang = float(np.median(behind))
    return (overhang if overhang > 1e-3 else 0.0), False


def _flight(
    nosings: Array,
    at: Array,
    sides: tuple[float, float],
    heading: float,
    line: Array,
    segments: Array,
) -> FlightEstimate | None:
    nosings, alone = _with_first_tread(nosings, line)
    c, s = math.cos(heading), math.sin(heading)
    columns = np.column_stack([np.ones(len(at)), at])
    fit, *_ = np.linalg.lstsq(columns, nosings.reshape(len(at), -1), rcond=None)
    value, slope = fit.reshape(2, -1, 2)
    if np.abs(slope).max() > math.tan(LARGEST_TURN):
        return None
    first, last = value[0] + slope[0] * at.mean(), value[-1] + slope[-1] * at.mean()
    before = line[(line[:, 0] < first[0] - 1e-6) & (line[:, 1] < first[1])]
    behind = line[line[:, 0] > last[0] + 1e-6]
    landing = behind[np.abs(behind[:, 1] - last[1]) < 2e-3]
    foot = before[np.abs(before[:, 1] - before[-1, 1]) < 2e-3] if len(before) else before

    def placed(t: float) -> Array:
        place = value + slope * t
        return np.column_stack([place[:, 0] * c - t * s, place[:, 0] * s + t * c, place[:, 1]])

    m = nosings.shape[1]
    going = float((last[0] - first[0]) / (m - 1))
    run_up = float(first[0] - foot[0, 0]) if len(foot) and not alone else math.nan
    run_out = float(landing[-1, 0] - last[0]) if len(landing) else math.nan
    overhang, open_risers = _faces(segments, value + slope * at.mean())
    return FlightEstimate(
        left=placed(sides[1]), right=placed(sides[0]), heading=heading,
        covariance=independent(np.tile(np.eye(2) * AS_DRAWN**2, (m, 1, 1))), gravity=0.0, scale=0.0,
        floor=math.nan if alone or not len(before) else float(before[-1, 1]),
        floor_sigma=AS_DRAWN, ends=run_out > SHORT * going,
        run_up=run_up, run_out=run_out, room_before=run_up, room_behind=run_out,
        width=sides[1] - sides[0], overhang=overhang, open_risers=open_risers,
        notes=(FLOOR_UNSEEN,) if alone or not len(before) else (),
    )  # fmt: skip
