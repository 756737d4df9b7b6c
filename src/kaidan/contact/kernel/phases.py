r"""Phases of a path's poses, from where their contacts stand.

::

    rear contact in a zone        front contact in a zone       what the rear contact leaves for a
    where the robot enters        where it lands                while in between counts as not left
    ENTER ..................  TRAVERSE ..............  LAND .......
"""

from __future__ import annotations

from kaidan.contact.entries import entry
from kaidan.contact.layout import Pose, Zone
from kaidan.contact.memory import Row, Table

#: Numbers of the phases.
ENTERS, TRAVERSES, LANDS = range(3)


def in_zone(zones: Table[Zone], x: float, z: float) -> bool:
    """Whether a place lies in one of some zones."""
    for k in range(len(zones)):
        zone = zones[k]
        if zone.x_min <= x and x <= zone.x_max and zone.z_min <= z and z <= zone.z_max:
            return True
    return False


def put_entering(poses: Table[Pose], zones: Table[Zone], phase: Row[int]) -> None:
    """Let the robot enter from the first to the last pose whose rear contact stands in a zone."""
    first = -1
    last = -1
    for row in range(len(poses)):
        if in_zone(zones, poses[row].rear.x, poses[row].rear.z):
            last = row
            if first < 0:
                first = row
    if first >= 0:
        for row in range(first, last + 1):
            phase[row] = ENTERS


@entry
def name_phases(
    poses: Table[Pose], enters: Table[Zone], ends: Row[int], lands: Table[Zone], phase: Row[int]
) -> None:
    """Name the phase of each pose.

    enters, ends: zones in which the rear contact stands of a robot that enters, those of each
        flight together; and the row after the last of each flight.
    phase: to be filled: `ENTERS`, `TRAVERSES`, `LANDS`.
    """
    for row in range(len(poses)):
        phase[row] = TRAVERSES
    begin = 0
    for k in range(len(ends)):
        put_entering(poses, enters[begin : ends[k]], phase)
        begin = ends[k]
    for row in range(len(poses)):
        if in_zone(lands, poses[row].front.x, poses[row].front.z):
            phase[row] = LANDS
