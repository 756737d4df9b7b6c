"""How a robot falls on the flight, in the stages of the paper's Fig. 20.

::

    1 parallel motion    the lowest contact lies under the flat, the body along the nosings
    2 round end          the lowest contact goes on to the arc of the end: the body turns
    3 largest load       as it turns, the load moves to the lowest contact
    4 onset of rotation  the centroid stands over a contact, or what is left behind it gives way

The grousers' moment on the arc (LCM), which the paper counts among the stages, is not in a smooth
track: the allowance theta_M stands for it.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import TRACK, Feature, FeatureKind
from kaidan.traversal import Phase, Traverse
from kaidan.traversal.event_log import End, Place, place_of

StageName = Literal[
    "parallel motion", "round end", "largest load", "onset of rotation", "rotates back"
]

LEAST_ROTATION = math.radians(0.05)
"""Rotation on the flight below which there is nothing to explain [rad]: half of what is printed."""


@dataclass(frozen=True)
class Stage:
    """One stage of a fall."""

    name: StageName
    path: float
    """Arclength of the centroid's path [m]."""
    inclination: float
    """Of the body, leading end up [rad]."""
    place: Place
    """What carries, or what the robot rotates about."""
    rotation: float | None = None
    """Of the round end: how far the body rotates from here; of the onset: until the next contact
    arrests it [rad]; None where nothing arrests it."""
    share: float | None = None
    """Of the largest load: the share that the lowest contact carries [1]."""


def fall_stages(traverse: Traverse, leading: End) -> tuple[Stage, ...]:
    """Stages of the largest rotation over the downhill end while traversing.

    None where it does not turn by more than `LEAST_ROTATION`.
    """
    path = traverse.path
    rows = np.flatnonzero(traverse.phase_of_pose == Phase.TRAVERSE.value)
    if path.margins is None or len(rows) == 0:
        return ()
    sign = -1.0 if traverse.descending else 1.0
    margins = path.margins
    contacts, load = (
        (path.poses.front, margins.front_load)
        if traverse.descending
        else (path.poses.rear, margins.rear_load)
    )
    share = _share(load, margins.rear_load + margins.front_load)
    tilt = sign * path.inclination
    last = int(rows[np.argmax(tilt[rows])])
    falls = _fall_to(traverse, sign)
    if falls is not None:
        last = path.row_before(path.rotations[falls].s)
    flat = _under_flat(traverse, contacts)
    first = last
    while first > rows[0] and not flat[first]:
        first -= 1
    if tilt[last] - tilt[first] < LEAST_ROTATION and falls is None:
        return ()
    loaded = first + int(np.argmax(share[first : last + 1]))

    def stage(name: StageName, row: int, place: Place | None = None, **more: float) -> Stage:
        where = place or place_of(traverse, int(contacts[row]), leading)
        return Stage(name, float(path.s[row]), float(path.inclination[row]), where, **more)

    stages = [stage("parallel motion", first)]
    if last > first:
        turned = float(tilt[last] - tilt[first])
        stages += [
            stage("round end", first + 1, rotation=turned),
            stage("largest load", loaded, share=float(share[loaded])),
        ]
    if falls is None:
        return (*stages, stage("rotates back", last))
    rotation = path.rotations[falls]
    arrested = {"rotation": rotation.angle} if rotation.arrested else {}
    pivot = place_of(traverse, rotation.pivot, leading)
    return (*stages, stage("onset of rotation", last, pivot, **arrested))


def _share(load: NDArray[np.float64], both: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the normal forces that one of the two contacts carries [1]."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.nan_to_num(load / both))


def _under_flat(traverse: Traverse, contacts: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Poses whose contact lies under the flat of the main track."""
    path, kinds = traverse.path, traverse.outline.kinds
    under = np.zeros(len(path.poses), dtype=np.bool_)
    for row, code in enumerate(contacts.tolist()):
        feature = Feature.of(code)
        if feature.kind is FeatureKind.VERTEX and kinds[feature.part] == TRACK:
            under[row] = path.is_on_flat(code, row)
    return under


def _fall_to(traverse: Traverse, sign: float) -> int | None:
    """Row of the rotation over the downhill end, while traversing, that turned the farthest."""
    path, phases = traverse.path, traverse.phase_of_pose
    best = None
    for row, rotation in enumerate(path.rotations):
        at = path.row_before(rotation.s)
        if rotation.sense != sign or phases[at] != Phase.TRAVERSE.value:
            continue
        farther = best is None or rotation.angle > path.rotations[best].angle
        if farther or not rotation.arrested:
            best = row
            if not rotation.arrested:
                break
    return best
