"""Speed at which an end of the robot comes down at the end of a rotation."""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.forces import contacts_at
from kaidan.contact.kernel.margins import MOST_CONTACTS
from kaidan.contact.kernel.toppling import AT_ONCE
from kaidan.contact.layout import RotationRow, Scene, Touching
from kaidan.contact.memory import Table, empty

#: Gap up to which a feature holds a rotation that ends [m].
ENDS = 1e-7


@entry
def impact_speed(scene: Scene, rotations: Table[RotationRow], row: int) -> float:
    """Speed at which an end comes down at the end of a rotation: rate times distance [m/s].

    Of several contacts that meet the ground at once the farthest hits fastest; what it turned on
    is the outermost on the other side, because those beyond it have opened. A turn of `AT_ONCE`
    tells as little which meets it first as it does to :func:`kaidan.contact.kernel.toppling.fall`:
    what would touch within one counts in full, and with less and less up to two.
    """
    end = rotations[row].end
    found = empty(Touching, MOST_CONTACTS)
    many = contacts_at(scene, end.x, end.z, end.inclination, ENDS, found)
    if many == 0:
        return 0.0
    first = 0
    last = 0
    for k in range(many):
        if found[k].x < found[first].x:
            first = k
        if found[k].x > found[last].x:
            last = k
    rear_x = found[first].x
    rear_z = found[first].z
    front_x = found[last].x
    front_z = found[last].z
    apart = far(front_x, front_z, rear_x, rear_z)
    body = scene.body
    reach = 0.0
    for k in range(len(body)):
        one = body[k].one
        two = body[k].two
        reach = max(reach, math.sqrt(one.x * one.x + one.z * one.z) + one.r)
        reach = max(reach, math.sqrt(two.x * two.x + two.z * two.z) + two.r)
    # part by part: two that all but touch one point keep a gap each
    many = 0
    touch = 4.0 * AT_ONCE * reach
    for k in range(len(body)):
        scene.body = body[k : k + 1]
        many += contacts_at(scene, end.x, end.z, end.inclination, touch, found[many:])
    span = apart
    for k in range(many):
        share = counts(found[k], rear_x, rear_z, front_x, front_z)
        if share <= 0.0:
            continue
        for other in range(k):
            beyond = far(found[k].x, found[k].z, found[other].x, found[other].z) - apart
            if beyond > span - apart:
                both = min(share, counts(found[other], rear_x, rear_z, front_x, front_z))
                span = max(span, apart + both * beyond)
    scene.body = body
    return rotations[row].rate_before * span


def far(x: float, z: float, o_x: float, o_z: float) -> float:
    """Distance between two places [m]."""
    d_x = x - o_x
    d_z = z - o_z
    return math.sqrt(d_x * d_x + d_z * d_z)


def counts(
    contact: Touching, rear_x: float, rear_z: float, front_x: float, front_z: float
) -> float:
    """Share with which what all but touches counts, by the turn about the farther contact."""
    if contact.gap <= ENDS:
        return 1.0
    arm = max(
        far(contact.x, contact.z, rear_x, rear_z), far(contact.x, contact.z, front_x, front_z)
    )
    if contact.gap >= 2.0 * AT_ONCE * arm:
        return 0.0
    return min(2.0 - contact.gap / (AT_ONCE * arm), 1.0)
