"""Codes of the contact model as enumerations, and what counts as rocking.

The kernel writes them into its tables as numbers; nobody has to know which.
"""

from __future__ import annotations

import math
from enum import IntEnum

#: Rotation that counts as rocking [rad]: the paper's rig turned that far by the yield of its
#: tracks, and held.
ROCKING = math.radians(2.6)
#: Which poses of a phase count for its energy: none; those with no nosing at the front; all.
NO_POSE, BESIDE_NOSINGS, EVERY_POSE = range(3)
#: Pieces into which a way between two poses is cut, on which a figure may be the largest.
PIECES = 8
#: Such ways of a group of poses that are cut together, the most promising first, and how many times
#: more of them are cut at most.
CUT_AT_ONCE = 4
ROUNDS = 8


class Status(IntEnum):
    """How a traverse ended."""

    OK = 0
    FELL_BACKWARD = 1
    FELL_FORWARD = 2
    STUCK = 3
    NOT_CONVERGED = 4
    TOO_LONG = 5
    NO_START = 6

    @property
    def message(self) -> str:
        """One sentence for people."""
        return _STATUS[self]


_STATUS = {
    Status.OK: "the robot arrived",
    Status.FELL_BACKWARD: "the robot fell over backward",
    Status.FELL_FORWARD: "the robot fell over forward",
    Status.STUCK: "the robot is stuck: wedged against a face, or rocking on the spot",
    Status.NOT_CONVERGED: "the solver did not converge; nothing is known beyond the last pose",
    Status.TOO_LONG: "the bound on poses or events was reached; nothing is known beyond the last",
    Status.NO_START: "no stable pose at the start",
}


class Event(IntEnum):
    """What happened along a traverse."""

    MADE = 0
    """A contact closed while driving."""
    LOST = 1
    """A contact opened while driving: it was replaced on its side of the centroid."""
    NOSE_DROPS = 2
    """The centroid passed the front contact: the robot rotates nose down."""
    TIPS_BACK = 3
    """The centroid fell behind the rear contact: the robot rotates nose up."""
    ARRESTED = 4
    """The rotation was arrested by the next contact: two contacts hold the robot again."""
    TAIL_RESTS = 5
    """MADE, and it is a rear end disc that came to rest on a segment."""
    FELL_FORWARD = 6
    """The rotation went past the vertical."""
    FELL_BACKWARD = 7
    """The rotation went past the vertical."""
    ARRIVED = 8
    """The centroid reached the end."""
    STUCK = 9
    """Wedged, rocking on the spot, or no way ahead."""
    RESETTLED = 10
    """The corrector failed and the robot was let down again within 10 mm, on a pose within 5 mm
    and 0.02 rad (sharp parts on rough ground only)."""
    REACHED = 11
    """The flat has come upon a nosing in line with those that carry it (``kaidan.traversal``)."""
    LEFT = 12
    """It has left one."""


class RotationOutcome(IntEnum):
    """How a rotation about one contact after the other ended."""

    ARRESTED = 0
    """By two contacts that straddle the centroid."""
    PAST_VERTICAL = 1
    """Past the vertical, or 90 degrees of rotation."""
    WEDGED = 2
    """Between contacts on one side."""
    ROCKING = 3
    """Rocking on one rolling contact."""
    ENDLESS = 4
    """Too many contacts in turn."""


class Advance(IntEnum):
    """How a step along a line of poses ended; a feature (0 or more) has closed."""

    NOT_CONVERGED = -9
    NOTHING = -3
    OVER_FRONT = -2
    """The centroid stands over the front contact."""
    OVER_REAR = -1
    """The centroid stands over the rear contact."""


class PartKind(IntEnum):
    """Kinds of parts of the underside."""

    TRACK = 0
    FLIPPER = 1
    BELLY = 2


TRACK, FLIPPER, BELLY = PartKind.TRACK, PartKind.FLIPPER, PartKind.BELLY
