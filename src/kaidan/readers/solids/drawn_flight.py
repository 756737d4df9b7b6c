"""Flight of a drawn mesh with what is drawn around it: its floors, gaps, and what is free."""

import math
from dataclasses import replace

import numpy as np

from kaidan.readers.flight import FlightEstimate, independent
from kaidan.readers.kinds import Array
from kaidan.readers.solids.ground import LOOKED, floor_before, floor_behind
from kaidan.readers.solids.path import Path
from kaidan.readers.solids.rays import Triangles
from kaidan.readers.solids.section import INSET, Frame
from kaidan.readers.solids.surroundings import surroundings_of
from kaidan.terrain.sentences import FLOOR_UNSEEN


def with_surroundings(flight: FlightEstimate, solids: Triangles) -> FlightEstimate:
    """Flight up to the floor that is drawn at its head, with its gaps and what is free along it."""
    path = _path_of(flight)
    if not flight.begins:
        floor = floor_before(path, solids)
        if math.isfinite(floor):
            path = path.over(floor)
            seen = tuple(each for each in flight.notes if each != FLOOR_UNSEEN)
            flight = replace(flight, floor=floor, notes=seen)
    if not flight.ends:
        head = floor_behind(path, solids)
        if head is not None:
            level, edge = head
            flight = replace(flight, ends=True)
            if level != path.levels[-1]:
                path = path.longer(level, *edge)
                flight = _longer(flight, path)
    around = surroundings_of(path, solids, solids)
    before, behind = (each if 0.0 < each < LOOKED else math.nan for each in around.level)
    return replace(
        flight,
        width=around.strip.width,
        headroom=around.headroom,
        clear=around.clear,
        gaps=around.gaps,
        room_before=float(np.fmin(flight.room_before, before)),
        room_behind=float(np.fmin(flight.room_behind, behind)),
        notes=(*flight.notes, *around.notes),
    )


def _path_of(flight: FlightEstimate) -> Path:
    frame = Frame(flight.middle[0, :2], flight.heading)
    left, right = frame.of(flight.left[:, :2]), frame.of(flight.right[:, :2])
    low, high = float(right[:, 1].mean()), float(left[:, 1].mean())
    share = INSET / (high - low)
    across = (right[:, 0] - left[:, 0]) * share
    return Path(
        frame=frame,
        lane=(low, high),
        left=left[:, 0] + across,
        right=right[:, 0] - across,
        levels=flight.middle[:, 2],
        base=flight.base,
    )


def _longer(flight: FlightEstimate, path: Path) -> FlightEstimate:
    """Flight with the last nosing of a path, known as the others are."""
    ends = [
        np.array([*path.frame.back(float(s), t), path.levels[-1]])
        for s, t in ((path.left[-1], path.lane[1]), (path.right[-1], path.lane[0]))
    ]
    one: Array = flight.covariance[-1, :, -1, :]
    return replace(
        flight,
        left=np.vstack([flight.left, ends[0]]),
        right=np.vstack([flight.right, ends[1]]),
        covariance=independent(np.tile(one, (len(flight) + 1, 1, 1))),
        room_behind=math.nan,
        run_out=math.nan,
    )
