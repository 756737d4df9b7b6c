"""What each pose of a traverse stands on: its contacts, and where grousers may stand.

Two contacts carry a pose; nosings that touch the flat of a part beside them may, too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import BELLY, FeatureKind, FeatureTable
from kaidan.terrain.polyline import STEEP
from kaidan.traversal.nosing_events import TOUCH, along_flat

Array = NDArray[np.float64]
Whole = NDArray[np.int64]

NOSING, TREAD, FACE = 0, 1, 2
"""Places of the stairs that a contact stands on; landings and floors are treads."""
TREAD_DEPTH = 0.040
"""Depth of a tread behind its nosing that grousers stand on [m]: of 20 mm at 30 degrees."""
NOWHERE = -1
"""Point of a contact where no grouser may stand."""
BLOCK = 256
"""Poses that are looked at together: what lies under them is a short piece of the ground."""


class PoseContacts(NamedTuple):
    """Contacts of each pose, shape (poses, most contacts); the first two carry it."""

    is_one: NDArray[np.bool_]
    x: Array
    """From the centroid [m]."""
    z: Array
    normal: Array
    """Tilt of the normal, towards where the robot drives [rad]."""
    place: Whole
    """NOSING, TREAD or FACE."""
    point: Whole
    """Point of the ground where a grouser may stand; or NOWHERE."""
    tread: Array
    """Tilt of the normal of the tread there [rad]."""
    curvature: Array
    """Of the belt at the contact [1/m]."""
    lift: Array
    """Of that point above the axle of the end that leans against a face [m]; NaN: no face."""


def contacts_of(path: contact.Path, descending: bool) -> PoseContacts:
    """Contacts of each pose: those that carry it first, then nosings under a flat beside them.

    Parameters
    ----------
    path : contact.Path
        Path of n poses.
    descending : bool
        Whether it leads down the stairs.

    Returns
    -------
    PoseContacts
        Fields of shape (n, most contacts of a pose).
    """
    poses, count = path.poses, len(path.poses)
    more_row, more_point, more_part = _under_flats(path)
    nth = _number_within(more_row)
    most = 2 + int(nth.max(initial=-1)) + 1
    shape = (count, most)
    at = PoseContacts(
        is_one=np.zeros(shape, dtype=np.bool_), x=np.zeros(shape), z=np.zeros(shape),
        normal=np.zeros(shape), place=np.zeros(shape, dtype=np.int64),
        point=np.full(shape, NOWHERE), tread=np.full(shape, np.nan), curvature=np.zeros(shape),
        lift=np.full(shape, np.nan),
    )  # fmt: skip
    carrying = (
        (poses.rear, poses.rear_point, poses.rear_normal),
        (poses.front, poses.front_point, poses.front_normal),
    )
    for slot, (codes, points, normals) in enumerate(carrying):
        at.is_one[:, slot] = True
        at.x[:, slot], at.z[:, slot] = points[:, 0] - path.x, points[:, 1] - path.z
        at.normal[:, slot] = np.arctan2(normals[:, 0], normals[:, 1])
        _name(at, slot, path, FeatureTable.of(codes), descending=descending)
    slots = 2 + nth
    at.is_one[more_row, slots] = True
    at.x[more_row, slots] = path.ground.x[more_point] - path.x[more_row]
    at.z[more_row, slots] = path.ground.z[more_point] - path.z[more_row]
    flat = _flat_normal(path.parts(more_row, more_part))
    at.normal[more_row, slots] = flat - path.inclination[more_row]
    at.point[more_row, slots] = more_point
    tread = _treads(path.ground, descending)
    chosen = at.point != NOWHERE
    at.tread[chosen] = tread[at.point[chosen]]
    at.point[np.isnan(at.tread)] = NOWHERE
    return at


def _name(
    at: PoseContacts, slot: int, path: contact.Path, features: FeatureTable, *, descending: bool
) -> None:
    """Place, point and curvature of the contacts in a slot."""
    ground, rows = path.ground, np.arange(len(path.poses))
    point, part, kind = features.point, features.part, features.kind
    corner = kind == FeatureKind.VERTEX
    second: Whole = (kind == FeatureKind.DISC_2).astype(np.int64)
    touched = path.parts(rows, part)
    on = np.flatnonzero(corner)
    if len(on):
        w = along_flat(path, on, point[on][:, None], part[on])[0][:, 0]
        second[on] = (w > 0.0).astype(np.int64)
        flat = (w >= 0.0) & (w <= touched.flat_length[on])
        second[on[flat]] = 2
    discs = touched.discs
    radius = np.where(second == 1, discs[:, 5], discs[:, 2])
    at.curvature[:, slot] = np.where(second == 2, 0.0, 1.0 / np.maximum(radius, 1e-3))
    step_x, step_z = np.diff(ground.x)[point], np.diff(ground.z)[point]
    steep = np.abs(np.arctan2(step_z, step_x)) > STEEP
    at.place[:, slot] = np.where(corner, NOSING, np.where(steep, FACE, TREAD))
    at.point[:, slot] = np.where(corner, point, NOWHERE)
    if not descending:  # going down, the belt brings no tips over the edge of a face behind
        face = np.flatnonzero(~corner & steep & (step_z > 0.0))
        above = point[face] + 1
        at.point[face, slot] = above
        c, s = np.cos(path.inclination[face]), np.sin(path.inclination[face])
        which = 3 * (second[face] == 1)
        b_x, b_z = discs[face, which], discs[face, which + 1]
        at.lift[face, slot] = ground.z[above] - (path.z[face] + s * b_x + c * b_z)


def _flat_normal(parts: contact.Body) -> Array:
    """Tilt of the normal of the flat of each part, from the ground into it, in the body frame."""
    (e_x, e_z), across = parts.axis.T, parts.cosine * parts.side
    return np.asarray(np.arctan2(-parts.sine * e_x - across * e_z, across * e_x - parts.sine * e_z))


def _under_flats(path: contact.Path) -> tuple[Whole, Whole, Whole]:
    """Rows, points and parts of all corners under a flat that do not carry their pose."""
    rear, front = FeatureTable.of(path.poses.rear), FeatureTable.of(path.poses.front)
    reach = path.reach
    rows: list[Whole] = []
    points: list[Whole] = []
    parts: list[Whole] = []
    for first in range(0, len(path.poses), BLOCK):
        some = np.arange(first, min(first + BLOCK, len(path.poses)))
        x = path.x[some]
        near = (path.ground.x > x.min() - reach) & (path.ground.x < x.max() + reach)
        corners = np.flatnonzero(near & path.ground.convex)
        for part in np.flatnonzero(path.body.kind != BELLY).tolist():
            w, gap = along_flat(path, some, corners, part)
            length = path.parts(some, part).flat_length[:, None]
            on = (np.abs(gap) < TOUCH) & (w >= 0.0) & (w <= length)
            which, column = np.nonzero(on)
            row, point = some[which], corners[column]
            new = np.ones(len(row), dtype=np.bool_)
            for one in (rear, front):
                new &= (one.point[row] != point) | (one.kind[row] != FeatureKind.VERTEX)
            rows.append(row[new])
            points.append(point[new])
            parts.append(np.full(int(new.sum()), part))
    of_row, of_point = np.concatenate(rows), np.concatenate(points)
    order = np.lexsort((of_point, of_row))
    once = order[_new(of_row[order]) | _new(of_point[order])]
    return of_row[once], of_point[once], np.concatenate(parts)[once]


def _number_within(rows: Whole) -> Whole:
    """Number of each among those of the same row; rows ascend."""
    numbers = np.arange(len(rows))
    return np.asarray(numbers - np.maximum.accumulate(np.where(_new(rows), numbers, 0)))


def _new(values: Whole) -> NDArray[np.bool_]:
    """Whether each differs from the one before it."""
    found = np.ones(len(values), dtype=np.bool_)
    found[1:] = values[1:] != values[:-1]
    return found


def _treads(ground: contact.Ground, descending: bool) -> Array:
    """Tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none."""
    x, z = ground.x, ground.z
    uphill = -1.0 if descending else 1.0
    there = np.interp(x + uphill * TREAD_DEPTH, x + 1e-12 * np.arange(len(x)), z)
    slope = np.arctan2(uphill * (there - z), TREAD_DEPTH)
    return np.where(np.abs(slope) < STEEP, -slope, np.nan)
