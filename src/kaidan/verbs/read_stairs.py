"""A staircase of a file as part of an answer: flights with their doubt, landings, data sheets."""

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np

from kaidan.answer import Part, plain
from kaidan.errors import InputError
from kaidan.readers.estimate import StairsEstimate
from kaidan.readers.flight import FlightEstimate
from kaidan.readers.kinds import METRES, Array, Mesh, Points, upright
from kaidan.terrain.stairs import Stairs

MOST_POINTS = 1500
"""Points of a file that a picture of a flight shows."""
_BESIDE = 0.4
"""Half of the width of the strip along a flight from which they are [m]."""
_BEYOND = 0.8
"""How far beyond the first and the last nosing they reach [m]."""


class FlightRead(Part):
    """A straight flight, from its lower floor up."""

    steps: int
    """Nosings that were found."""
    rise_m: float | None
    """Mean rise of a step [m]; null: one step alone."""
    going_m: float | None
    """Mean going of a step [m]."""
    first_rise_m: float | None
    """First riser as drawn or measured [m]; null: the lower floor was not seen."""
    last_rise_m: float | None
    """Last riser likewise [m]; null: one step alone."""
    angle_deg: float | None
    """Slope of the line through the nosings [deg]."""
    angle_sigma_deg: float | None
    """Standard uncertainty of the slope, that of gravity included [deg]."""
    spacing_m: float | None
    """Nosing spacing [m]."""
    spacing_sigma_m: float | None
    """Standard uncertainty of the spacing, that of the scale included [m]."""
    rise_sigma_m: float
    """Standard uncertainty of a single rise [m]."""
    going_sigma_m: float
    """Standard uncertainty of a single going [m]."""
    alike: float | None
    """Probability of residuals as large as these, were all steps alike [1]."""
    floor_seen: bool
    """Whether the lower floor was seen, so that the first riser is known."""
    landing_seen: bool
    """Whether the last nosing is the edge of a landing that was seen."""
    roughness_m: float
    """Root mean square distance of what was measured from the steps [m]."""
    width_m: float | None
    """Clear width [m]; null: not seen."""
    headroom_m: float | None
    """Least height above the line of the nosings [m]; null: not seen."""
    nosings: tuple[tuple[float, float], ...]
    """s and z of each nosing in its middle [m]."""
    sigmas: tuple[tuple[float, float], ...]
    """Standard uncertainty of each nosing on its own, of s and of z [m]."""
    residuals: tuple[tuple[float, float], ...]
    """Of each nosing from the uniform flight that fits best, along and up [m]; one step: empty."""
    left: tuple[tuple[float, float], ...]
    """Left ends of the nosings in the plan, x and y in the file's frame, in metres [m]."""
    right: tuple[tuple[float, float], ...]
    """Right ends likewise [m]."""
    points: tuple[tuple[float, float], ...]
    """Some of the file's points along the flight, s and z [m]; empty where it has none."""
    notes: tuple[str, ...]
    """What the user should know of it."""
    sheet: Stairs | None
    """Data sheet; null: no sheet can hold it."""
    no_sheet: str
    """Why there is no sheet; empty where there is one."""


class LandingRead(Part):
    """A level place before, between or behind flights."""

    depth_m: float | None
    """Along the flight [m]; null: not seen."""
    width_m: float | None
    """Across it [m]."""
    turn_deg: float
    """By which the flight above turns, to the left positive [deg]."""


class StaircaseRead(Part):
    """A staircase of a file."""

    name: str
    element: str
    """Part of the file by which it is named after #; empty: the file has no other."""
    flights: tuple[FlightRead, ...]
    """From bottom to top."""
    landings: tuple[LandingRead, ...]
    """One more than the flights."""
    facts: dict[str, str]
    """What else the file says of it."""
    notes: tuple[str, ...]
    """What the user should know of it."""


def staircase_read(found: StairsEstimate, contents: Any) -> StaircaseRead:
    """Staircase that was found, as part of an answer."""
    sheets: list[Stairs | None] = [None] * len(found.flights)
    refused = [""] * len(found.flights)
    try:
        sheets = list(found.stairs())
    except InputError as error:
        refused = [str(error)] * len(found.flights)
    cloud = _cloud(found, contents)
    return StaircaseRead(
        name=found.name,
        element=found.provenance.element,
        flights=tuple(
            _flight(flight, sheet, why, cloud)
            for flight, sheet, why in zip(found.flights, sheets, refused, strict=True)
        ),
        landings=tuple(
            LandingRead(depth_m=each.depth, width_m=each.width, turn_deg=math.degrees(each.turn))
            for each in found.landings
        ),
        facts={
            str(key): value if isinstance(value, str) else json.dumps(plain(value))
            for key, value in found.facts.items()
            if value not in (None, "", (), {})
        },
        notes=found.notes,
    )


def _flight(
    flight: FlightEstimate, sheet: Stairs | None, why: str, cloud: Array | None
) -> FlightRead:
    regular = flight.regular
    if sheet is not None:  # a list of steps has the mean of those that are regular
        rise_m, going_m = sheet.mean_step
        regular = replace(regular, rise=rise_m, going=going_m)
    rises = flight.drawn_rises
    going, rise = flight.doubt_of_a_step()
    return FlightRead(
        steps=len(flight),
        rise_m=regular.rise,
        going_m=regular.going,
        first_rise_m=float(rises[0]) if flight.begins else None,
        last_rise_m=float(rises[-1]) if len(rises) > 1 else None,
        angle_deg=math.degrees(regular.angle),
        angle_sigma_deg=math.degrees(flight.angle_sigma),
        spacing_m=regular.spacing,
        spacing_sigma_m=flight.spacing_sigma,
        rise_sigma_m=rise,
        going_sigma_m=going,
        alike=regular.alike,
        floor_seen=flight.begins,
        landing_seen=flight.ends,
        roughness_m=flight.roughness,
        width_m=flight.width,
        headroom_m=flight.headroom,
        nosings=tuple(map(tuple, flight.line().tolist())),
        sigmas=tuple(map(tuple, flight.sigmas.tolist())),
        residuals=_residuals(flight),
        left=tuple(map(tuple, flight.left[:, :2].tolist())),
        right=tuple(map(tuple, flight.right[:, :2].tolist())),
        points=() if cloud is None else _along(flight, cloud),
        notes=flight.notes if sheet is None or not sheet.notes else (*flight.notes, sheet.notes),
        sheet=sheet,
        no_sheet=why,
    )


def _residuals(flight: FlightEstimate) -> tuple[tuple[float, float], ...]:
    """Distances of nosings from the regular flight through their middle [m]."""
    if len(flight) < 2:
        return ()
    step = np.array([flight.regular.going, flight.regular.rise])
    off = flight.line() - np.arange(len(flight))[:, None] * step
    return tuple((float(s), float(z)) for s, z in off - off.mean(axis=0))


def _cloud(found: StairsEstimate, contents: Any) -> Array | None:
    """Points of a cloud or a mesh in metres, z up; None where the file has none."""
    if isinstance(contents, Points):
        xyz = contents.xyz
    elif isinstance(contents, Mesh):
        xyz = contents.vertices
    else:
        return None
    unit, up = found.provenance.unit, found.provenance.up
    by = 1.0 if unit is None else METRES[unit.value]
    turned = np.eye(3) if up is None else upright(up.value)
    turned = turned if found.frame is None else found.frame
    return np.asarray(xyz[np.isfinite(xyz).all(axis=1)] @ turned.T * by)


def _along(flight: FlightEstimate, cloud: Array) -> tuple[tuple[float, float], ...]:
    """Points in a strip along a flight, thinned evenly: s from the first nosing, z as its line."""
    ahead = np.array([math.cos(flight.heading), math.sin(flight.heading)])
    first = flight.middle[0]
    away = cloud[:, :2] - first[:2]
    s, aside = away @ ahead, away @ np.array([-ahead[1], ahead[0]])
    z = cloud[:, 2] - (flight.floor if flight.begins else first[2])
    line = flight.line()
    near = (np.abs(aside) < _BESIDE) & (s > -_BEYOND) & (s < line[-1, 0] + _BEYOND)
    near &= (z > line[:, 1].min() - _BEYOND) & (z < line[:, 1].max() + _BEYOND)
    rows = np.flatnonzero(near)
    rows = rows[:: max(1, -(-len(rows) // MOST_POINTS))]
    return tuple(zip(s[rows].round(4).tolist(), z[rows].round(4).tolist(), strict=True))
