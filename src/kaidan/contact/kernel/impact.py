"""Speed at which an end of the robot comes down at the end of a rotation."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONTACT_GAP,
    CONTACT_X,
    CONTACT_Z,
    DISC,
    DISC_R,
    DISC_X,
    DISC_Z,
    END_PHI,
    END_X,
    END_Z,
    RATE_BEFORE,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.forces import contacts_at
from kaidan.contact.kernel.toppling import AT_ONCE
from kaidan.contact.tables import BodyTable, ContactTable, GroundTable, RotationTable

#: Gap up to which a feature holds a rotation that ends [m].
ENDS = 1e-7


@entry
def impact_speed(
    ground: GroundTable, body: BodyTable, rotations: RotationTable, row: int, found: ContactTable
) -> float:
    """Speed at which an end comes down at the end of a rotation: rate times distance [m/s].

    Of several contacts that meet the ground at once the farthest hits fastest; what it turned on
    is the outermost on the other side, because those beyond it have opened. A turn of `AT_ONCE`
    tells as little which meets it first as it does to :func:`kaidan.contact.kernel.toppling.fall`:
    what would touch within one counts in full, and with less and less up to two.

    Parameters
    ----------
    rotations, row
        Table of rotations, which of them.
    found
        Scratch for the contacts of a pose.
    """
    x = rotations[row, END_X]
    z = rotations[row, END_Z]
    phi = rotations[row, END_PHI]
    many, _ = contacts_at(ground, body, x, z, phi, ENDS, found, 0)
    if many == 0:
        return 0.0
    first = 0
    last = 0
    for k in range(many):
        if found[k, CONTACT_X] < found[first, CONTACT_X]:
            first = k
        if found[k, CONTACT_X] > found[last, CONTACT_X]:
            last = k
    rear_x = found[first, CONTACT_X]
    rear_z = found[first, CONTACT_Z]
    front_x = found[last, CONTACT_X]
    front_z = found[last, CONTACT_Z]
    apart = math.sqrt((front_x - rear_x) ** 2 + (front_z - rear_z) ** 2)
    reach = 0.0
    for part in range(body.shape[0]):
        for disc in range(2):
            j = DISC * disc
            c_x = body[part, j + DISC_X]
            c_z = body[part, j + DISC_Z]
            reach = max(reach, math.sqrt(c_x * c_x + c_z * c_z) + body[part, j + DISC_R])
    # part by part: two that all but touch one point keep a gap each
    many = 0
    for part in range(body.shape[0]):
        more, _ = contacts_at(
            ground,
            body[part : part + 1],
            x,
            z,
            phi,
            4.0 * AT_ONCE * reach,
            found[many : found.shape[0]],
            0,
        )
        many += more
    span = apart
    for k in range(many):
        share = counts(found, k, rear_x, rear_z, front_x, front_z)
        if share <= 0.0:
            continue
        for other in range(k):
            d_x = found[k, CONTACT_X] - found[other, CONTACT_X]
            d_z = found[k, CONTACT_Z] - found[other, CONTACT_Z]
            beyond = math.sqrt(d_x * d_x + d_z * d_z) - apart
            if beyond > span - apart:
                both = min(share, counts(found, other, rear_x, rear_z, front_x, front_z))
                span = max(span, apart + both * beyond)
    rate: float = rotations[row, RATE_BEFORE]
    return rate * span


def counts(
    found: ContactTable, k: int, rear_x: float, rear_z: float, front_x: float, front_z: float
) -> float:
    """Share with which what all but touches counts, by the turn about the farther contact."""
    x = found[k, CONTACT_X]
    z = found[k, CONTACT_Z]
    arm = math.sqrt(
        max((x - rear_x) ** 2 + (z - rear_z) ** 2, (x - front_x) ** 2 + (z - front_z) ** 2)
    )
    gap = found[k, CONTACT_GAP]
    if gap <= ENDS:
        return 1.0
    if gap >= 2.0 * AT_ONCE * arm:
        return 0.0
    share: float = min(2.0 - gap / (AT_ONCE * arm), 1.0)
    return share
