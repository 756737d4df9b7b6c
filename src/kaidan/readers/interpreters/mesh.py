"""Staircases in a mesh: a drawn one is sliced, a scanned one is a cloud."""

import math
from dataclasses import dataclass, replace

import numpy as np

from kaidan.readers.estimate import Found, Refusal
from kaidan.readers.flight import FlightEstimate
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points
from kaidan.readers.kinds import METRES, UNITS, Array, Known, Mesh, Points, upright
from kaidan.readers.solids.drawn_flight import with_surroundings
from kaidan.readers.solids.rays import Triangles
from kaidan.readers.stairfit.chain import staircases
from kaidan.readers.stairfit.drawn import Surface, flights_of, surface_of
from kaidan.readers.stairfit.gates import ANGLES

DRAWN = 0.08
"""Side of triangles, weighted by area, from which a mesh was drawn and not scanned [m]."""
LIKELY_RISES, LIKELY_GOINGS = (0.12, 0.22), (0.15, 0.40)
"""Mean rises and goings [m] with which a unit or an up axis that the file does not state is
plausible."""
UPS = ("+z", "+y", "+x")
"""Up axes that files have, the usual ones first."""
SAMPLES = 200_000
"""Points that are laid on a scanned mesh."""
EXTENTS = (0.4, 500.0)
"""Smallest and largest extent of a mesh with stairs [m]."""


@dataclass(frozen=True, eq=False)
class _Way:
    """One way to understand a mesh: a unit, an up axis, and the flights that follow."""

    unit: Known
    up: Known
    flights: tuple[FlightEstimate, ...]

    @property
    def likely(self) -> bool:
        """Whether the first flight has steps as stairs have them."""
        regular = self.flights[0].regular
        return (
            LIKELY_RISES[0] <= regular.rise <= LIKELY_RISES[1]
            and LIKELY_GOINGS[0] <= regular.going <= LIKELY_GOINGS[1]
        )

    def __str__(self) -> str:
        regular = self.flights[0].regular
        return (
            f"{self.unit.value} with {self.up.value} up (rise {1e3 * regular.rise:.0f} mm, going "
            f"{1e3 * regular.going:.0f} mm)"
        )


def found(mesh: Mesh, hints: Hints) -> Found:
    """Staircases that a mesh holds, or why it holds none.

    A refusal where two units or up axes are plausible: it names both.
    """
    provenance = mesh.provenance
    extent = float(np.linalg.norm(np.ptp(mesh.vertices[mesh.faces.ravel()], axis=0)))
    units = [provenance.unit] if provenance.unit else [
        Known(unit, "scored") for unit in UNITS
        if EXTENTS[0] <= extent * METRES[unit] <= EXTENTS[1]
    ]  # fmt: skip
    ups = [provenance.up] if provenance.up else [Known(up, "scored") for up in UPS]
    ways, scanned = [], False
    for unit in units:
        metres = METRES[unit.value]
        for up in ups:
            surface = surface_of(mesh.vertices @ upright(up.value).T * metres, mesh.faces)
            if _was_scanned(surface):
                scanned = True
                continue
            solids = Triangles.of([(surface.vertices, surface.faces)])
            flights = tuple(
                with_surroundings(each, solids) for each in flights_of(surface) if _is_stairs(each)
            )
            if flights:
                ways.append(_Way(unit, up, flights))
    stated = provenance.unit is not None and provenance.up is not None
    if not stated:
        likely = [way for way in ways if way.likely]
        ways = likely or ways
    if len(ways) > 1:
        refusal = Refusal("ambiguous", {"ways": " or ".join(map(str, ways[:3]))}, provenance)
        return Found(provenance, refusals=(refusal,), contents=mesh)
    if ways:
        known = replace(provenance, unit=ways[0].unit, up=ways[0].up)
        stairs = staircases(ways[0].flights, known)
        return Found(known, staircases=stairs, contents=mesh)
    if scanned:
        return replace(points.found(_sampled(mesh), hints), contents=mesh)
    return Found(provenance, refusals=(Refusal("none", {}, provenance),), contents=mesh)


def _was_scanned(surface: Surface) -> bool:
    """Whether half of its area is in triangles that nobody draws so small."""
    order = np.argsort(surface.area)
    total = np.cumsum(surface.area[order])
    if not len(total):
        return False
    median = surface.area[order][int(np.searchsorted(total, total[-1] / 2))]
    return math.sqrt(2 * float(median)) < DRAWN


def _is_stairs(flight: FlightEstimate) -> bool:
    regular = flight.regular
    return (
        len(flight) >= 3
        and ANGLES[0] <= regular.angle <= ANGLES[1]
        and 0.15 <= regular.spacing <= 0.5
    )


def _sampled(mesh: Mesh) -> Points:
    """Points on the triangles, as many for each area, and always the same ones."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    rng = np.random.default_rng(0)
    rows = np.searchsorted(np.cumsum(area), rng.random(SAMPLES) * area.sum())
    rows = np.minimum(rows, len(area) - 1)
    u, v = rng.random((2, SAMPLES, 1))
    fold = u + v > 1
    u, v = np.where(fold, 1 - u, u), np.where(fold, 1 - v, v)
    xyz: Array = a[rows] + u * (b - a)[rows] + v * (c - a)[rows]
    return Points(xyz, mesh.provenance)
