"""One flight of a cloud, from the lane in which it was found to its estimate."""

import math
from dataclasses import replace

import numpy as np

from kaidan.readers.flight import LOWEST_CEILING, MICROMETRE, FlightEstimate
from kaidan.readers.kinds import Array
from kaidan.readers.sentences import scans as text
from kaidan.readers.stairfit.behind import gap_behind
from kaidan.readers.stairfit.corridor import Lane
from kaidan.readers.stairfit.landing_end import landing_end
from kaidan.readers.stairfit.quantiles import quantile
from kaidan.readers.stairfit.steps import MOST_MEASURED, Steps, evenly, steps_of
from kaidan.readers.stairfit.views import rotated
from kaidan.terrain.gap import Gap
from kaidan.terrain.sentences import FLOOR_UNSEEN, in_words

BESIDE = 0.1
"""Distance from the sides of a flight from which points lie on it and not beside it [m]."""
ABOVE = 0.5
"""Height over a level from which a sensor sees whether it goes on [m]: lower ones graze it."""
LEVEL = 0.02
"""Least distance within which a point lies on a level [m]."""

Placed = tuple[Array, Array, Array]
"""Points along a heading: s, t, z, shape (n,) each [m]."""


def measured(
    lane: Lane, cloud: Array, turn: Array, view: Array, noise: float, error: float, against: Array
) -> tuple[Steps | None, Lane, Placed]:
    """Single steps of a lane in all points, after its heading was corrected by its skew.

    `turn` lifts the cloud. With the lane along that heading, and all points between its sides along
    it.
    """
    line = lane.line
    heading = lane.heading - math.atan(line.skew)
    off = heading - lane.heading
    # a point at (s, t) of the lane's frame has s' = s cos + t sin, t' = t cos - s sin
    cosine, sine = math.cos(off), math.sin(off)
    line = replace(line, s0=line.s0 * cosine, going=line.going * cosine, skew=0.0)
    along = line.s0 + line.going * (line.first + line.last) / 2
    shift = -along / cosine * sine
    low, high = lane.low + shift, lane.high + shift
    low, high = low - 0.5 * abs(sine), high + 0.5 * abs(sine)
    ends = line.at(np.array([line.first, line.last]))
    axes = np.array(rotated(np.eye(3), heading)) @ turn
    t = axes[1] @ cloud.T
    beside = np.flatnonzero((t > low) & (t < high))
    placed = s, t, z = tuple(axes @ cloud.T.take(beside, axis=1))
    near = (s > ends[0, 0] - 1.6) & (s < ends[1, 0] + 1.8)
    near &= (z > ends[0, 1] - 0.9) & (z < ends[1, 1] + 2.4)
    aligned = replace(lane, heading=heading, line=line, low=low, high=high)
    inside = s[near], t[near], z[near]
    ahead = np.array([math.cos(heading), math.sin(heading), 0.0])
    level = math.sqrt(float(ahead @ against @ ahead))
    steps = steps_of(line, *inside, noise=noise, eye=axes @ view, range_error=error, level=level)
    return steps, aligned, placed


def estimate(
    steps: Steps, lane: Lane, gravity: float, error: float, cloud: Placed
) -> FlightEstimate:
    """Estimate in the levelled frame of the cloud, whose points are given along the lane."""
    c, s = math.cos(lane.heading), math.sin(lane.heading)

    def placed(t: float) -> Array:
        along = steps.at[:, 0] + steps.line.skew * t
        return np.column_stack([along * c - t * s, along * s + t * c, steps.at[:, 1]])

    low, high = steps.width
    cloud = evenly(MOST_MEASURED, *cloud)
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
        notes.append(FLOOR_UNSEEN)
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
    inside = (t > low + BESIDE) & (t < high - BESIDE) & (s > first[0]) & (s < last[0])
    slope = (last[1] - first[1]) / (last[0] - first[0])
    over = z[inside] - first[1] - slope * (s[inside] - first[0])
    over = over[over > LOWEST_CEILING]
    return quantile(over, 0.01) if len(over) > 30 else math.nan


def _room(steps: Steps, s: Array, t: Array, z: Array) -> tuple[float, float]:
    """How far from the first and the last nosing something stands across the way [m]; NaN: free."""
    first, last = steps.at[0], steps.at[-1]
    base = steps.floor if math.isfinite(steps.floor) else first[1] - steps.line.rise
    return (
        landing_end(first[0] - s, t, z - base, width=steps.width),
        landing_end(s - last[0], t, z - last[1], width=steps.width),
    )


def with_gap(
    flight: FlightEstimate, steps: Steps, cloud: Placed, eye: Array | None
) -> FlightEstimate:
    """Flight with where the level behind its last nosing was seen to end.

    eye, shape (3,): where the sensor stood, in the levelled frame of the cloud; one that stood
        behind the last nosing, or hardly saw its level, says nothing. None: not known [m].
    """
    last, line = steps.at[-1], steps.line
    if eye is not None:
        ahead, _, up = (float(each[0]) for each in rotated(eye[None], flight.heading))
        if ahead > last[0] or up - last[1] < ABOVE:
            return flight
    low, high = steps.width
    s, t, z = evenly(MOST_MEASURED, *cloud)
    inside = (t > low + BESIDE) & (t < high - BESIDE)
    start = gap_behind(
        s[inside] - line.skew * t[inside] - last[0],
        z[inside] - last[1],
        going=line.going,
        tight=min(max(3.0 * steps.roughness, LEVEL), 0.35 * line.rise),
    )
    if math.isnan(start):
        return flight
    places = steps.at[:, 0] - steps.at[0, 0]
    gap = Gap(start=round(float(places[-1]) + start, MICROMETRE))
    return replace(flight, gaps=(gap,), notes=(*flight.notes, in_words(gap, places.tolist())))


def tilted(flight: FlightEstimate, turn: Array) -> FlightEstimate:
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
