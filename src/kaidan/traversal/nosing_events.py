"""Nosings that the flat reaches and leaves while others carry it: events that turn nothing.

The kernel follows the pair of contacts that carries the robot. On a straight line of nosings the
flat slides on to the next one, and off the last, without a change of pose: those exchanges are
found here, from the poses, where they pass an end of the flat.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import Event, EventRecord, Events, Feature, FeatureKind

TOUCH = 1e-7
"""Gap up to which a nosing lies on the flat [m]: ten times what poses are solved to."""
STRAIGHT = 1e-9
"""Rotation between two poses above which the kernel has the event [rad]."""


class _Passing(NamedTuple):
    """A nosing that passes an end of the flat of a part."""

    s: float
    reached: bool
    point: int
    part: int
    row: int
    share: float
    """Of the path from the pose of the row to the next."""


def nosing_events(path: contact.Path) -> Events:
    """Events REACHED and LEFT of a traverse, in its order.

    Parameters
    ----------
    path : contact.Path
        With its poses.

    Returns
    -------
    contact.Events
        Each with the row of the pose before it, and no other feature.
    """
    found = [
        _Passing(s, bool(reached), int(point), int(part), int(row), share)
        for s, reached, point, part, row, share in contact.nosings_passed(
            path, _straight_pieces(path), TOUCH
        ).tolist()
    ]
    kept = _once(found)
    rows, shares = [each.row for each in kept], np.array([each.share for each in kept])
    places = path.poses.placements
    here = places[rows]
    there = here + shares[:, None] * (places[[row + 1 for row in rows]] - here)
    return Events.of(
        EventRecord(
            kind=Event.REACHED if each.reached else Event.LEFT,
            s=each.s,
            x=x,
            z=z,
            inclination=inclination,
            feature=Feature(each.point, each.part, FeatureKind.VERTEX).code,
            other=-1,
            pose=each.row,
        )
        for each, (x, z, inclination) in zip(kept, there.tolist(), strict=True)
    )


def _straight_pieces(path: contact.Path) -> NDArray[np.int64]:
    """Rows from which the path leads straight to the next, and where contacts change if known."""
    poses, margins = path.poses, path.margins
    s, leg, inclination = poses.s, poses.leg, poses.inclination
    pieces = (
        (leg[1:] == leg[:-1])
        & (np.abs(inclination[1:] - inclination[:-1]) < STRAIGHT)
        & (s[1:] > s[:-1])
    )
    if margins is not None:
        contacts, outermost = margins.contacts, margins.outermost
        changes = (outermost[1:] != outermost[:-1]).any(axis=1)
        changes |= contacts[1:] != contacts[:-1]
        # a nosing counts as a contact a little before it comes under the flat: maybe one pose early
        near = changes.copy()
        near[1:] |= changes[:-1]
        near[:-1] |= changes[1:]
        pieces &= near
    return np.flatnonzero(pieces)


def _once(passings: list[_Passing]) -> list[_Passing]:
    """Without those of a nosing that passes from one part to the next in line with it."""
    kept: list[_Passing] = []
    for each in passings:
        twin = next(
            (
                k
                for k in range(len(kept) - 1, max(len(kept) - 8, 0) - 1, -1)
                if kept[k].point == each.point
                and kept[k].reached != each.reached
                and abs(kept[k].s - each.s) < 1e-6
            ),
            None,
        )
        if twin is None:
            kept.append(each)
        else:
            del kept[twin]
    return kept
