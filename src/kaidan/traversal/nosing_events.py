"""Nosings that the flat reaches and leaves while others carry it: events that turn nothing.

The kernel follows the pair of contacts that carries the robot. On a straight line of nosings the
flat slides on to the next one, and off the last, without a change of pose: those exchanges are
found here, from the poses, where they pass an end of the flat.
"""

from typing import NamedTuple

import numpy as np

from kaidan import contact
from kaidan.contact import Event, EventRecord, Events, Feature, FeatureKind

TOUCH = 1e-7
"""Gap up to which a nosing lies on the flat [m]: ten times what poses are solved to."""


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

    Each with the row of the pose before it, and no other feature.
    """
    kept = [
        _Passing(s, bool(reached), int(point), int(part), int(row), share)
        for s, reached, point, part, row, share in contact.nosings_passed(path, TOUCH).tolist()
    ]
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
