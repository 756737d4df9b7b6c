r"""Phases of a path's poses, from where their contacts stand.

::

    rear contact in a zone        front contact in a zone       what the rear contact leaves for a
    where the robot enters        where it lands                while in between counts as not left
    ENTER ..................  TRAVERSE ..............  LAND .......
"""

from __future__ import annotations

from kaidan.contact.columns import FRONT_X, FRONT_Z, REAR_X, REAR_Z
from kaidan.contact.entries import entry
from kaidan.contact.tables import IntArray, PoseTable, ZoneTable

#: Numbers of the phases.
ENTERS, TRAVERSES, LANDS = range(3)


def in_zone(zones: ZoneTable, x: float, z: float) -> bool:
    """Whether a place lies in one of some zones."""
    for k in range(zones.shape[0]):
        if zones[k, 0] <= x and x <= zones[k, 1] and zones[k, 2] <= z and z <= zones[k, 3]:
            return True
    return False


def put_entering(poses: PoseTable, zones: ZoneTable, phase: IntArray) -> None:
    """Let the robot enter from the first to the last pose whose rear contact stands in a zone."""
    first = -1
    last = -1
    for row in range(poses.shape[0]):
        if in_zone(zones, poses[row, REAR_X], poses[row, REAR_Z]):
            last = row
            if first < 0:
                first = row
    if first >= 0:
        for row in range(first, last + 1):
            phase[row] = ENTERS


@entry
def name_phases(
    poses: PoseTable, enters: ZoneTable, ends: IntArray, lands: ZoneTable, phase: IntArray
) -> None:
    """Name the phase of each pose.

    Parameters
    ----------
    poses
        Of a path.
    enters, ends
        Zones in which the rear contact stands of a robot that enters (k, 4), those of each flight
        together: first and last x, lowest and highest z [m]; and the row after the last of each
        flight.
    lands
        Zones in which the front contact stands of one that lands (k, 4), which it does whatever
        the rear contact says.
    phase
        To be filled: `ENTERS`, `TRAVERSES`, `LANDS`.
    """
    for row in range(poses.shape[0]):
        phase[row] = TRAVERSES
    begin = 0
    for k in range(ends.shape[0]):
        put_entering(poses, enters[begin : ends[k]], phase)
        begin = ends[k]
    for row in range(poses.shape[0]):
        if in_zone(lands, poses[row, FRONT_X], poses[row, FRONT_Z]):
            phase[row] = LANDS
