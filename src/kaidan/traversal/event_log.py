"""Event log of a traverse: events that belong together as one entry."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import BELLY, FLIPPER, Event, Feature, FeatureKind
from kaidan.terrain.polyline import STEEP
from kaidan.traversal import Traverse, TraverseEvent

Array = NDArray[np.float64]

Kind = Literal[
    "passes",
    "rests",
    "reached",
    "left",
    "drops",
    "rises",
    "falls",
    "stuck",
    "arrives",
    "resettled",
]
End = Literal["nose", "tail"]
_ENDS_OF_ROTATION = (Event.ARRESTED, Event.FELL_FORWARD, Event.FELL_BACKWARD, Event.STUCK)


@dataclass(frozen=True)
class Place:
    """Something the robot touches."""

    what: str
    """nosing, corner, tread, riser, lower landing, upper landing, ground."""
    number: int | None
    """Of the step, from the bottom."""
    part: str
    """Part of the robot: track, front flipper, rear flipper, belly."""


@dataclass(frozen=True)
class LogEntry:
    """One or more events that belong together."""

    kind: Kind
    """What happens: "drops" and "rises" are rotations that the next contact arrests."""
    phase: str
    path: float
    """Arclength of the centroid's path [m]."""
    inclination: float
    """Of the body at its start, leading end up [rad]."""
    places: tuple[Place, ...]
    """What it leads to, then what it comes from."""
    end: End | None = None
    """End of the robot that drops, rises, comes to rest, or over which it falls."""
    rotation: float = 0.0
    """Angle of the rotation [rad]."""
    topples_with_momentum: bool = False
    """Whether the momentum of the rotation carries it over."""

    @property
    def step(self) -> int | None:
        """Number of the step it leads to."""
        return next((each.number for each in self.places if each.number is not None), None)


def event_log(traverse: Traverse, leading: End) -> tuple[LogEntry, ...]:
    """Entries of a traverse, in order."""
    events = traverse.events
    entries, at = [], 0
    while at < len(events):
        code = events[at].kind
        after = events[at + 1].kind if at + 1 < len(events) else None
        contact = code in (Event.MADE, Event.TAIL_RESTS) and after is Event.LOST
        rotation = code in (Event.NOSE_DROPS, Event.TIPS_BACK) and after in _ENDS_OF_ROTATION
        group = 2 if contact or rotation else 1
        entries.append(_entry(traverse, leading, events[at], events[at + group - 1]))
        at += group
    return tuple(entries)


def _entry(traverse: Traverse, leading: End, first: TraverseEvent, last: TraverseEvent) -> LogEntry:
    kind, end, places = _kind(traverse, leading, first, last)
    return LogEntry(
        kind=kind,
        phase=first.phase.value,
        path=first.path,
        inclination=first.inclination,
        places=places,
        end=end,
        rotation=last.rotation or 0.0,
        topples_with_momentum=bool(last.topples_with_momentum),
    )


def _kind(
    traverse: Traverse, leading: End, event: TraverseEvent, last: TraverseEvent
) -> tuple[Kind, End | None, tuple[Place, ...]]:
    """What happens, with which end of the robot, and at which places."""
    first = place_of(traverse, event.feature, leading)
    trailing: End = "tail" if leading == "nose" else "nose"
    if event.kind in (Event.REACHED, Event.LEFT):
        return "reached" if event.kind is Event.REACHED else "left", None, (first,)
    if event.kind in (Event.MADE, Event.TAIL_RESTS, Event.LOST):
        other = place_of(traverse, event.other_feature, leading)
        rests = event.kind is Event.TAIL_RESTS
        return "rests" if rests else "passes", trailing if rests else None, (first, other)
    if last.kind is Event.ARRESTED:
        down = event.kind is Event.NOSE_DROPS
        by = place_of(traverse, last.other_feature if down else last.feature, leading)
        return "drops" if down else "rises", leading, (by, first)
    if last.kind in (Event.FELL_FORWARD, Event.FELL_BACKWARD):
        return "falls", leading if last.kind is Event.FELL_FORWARD else trailing, (first,)
    if last.kind is Event.STUCK:
        return "stuck", None, (first,)
    if last.kind is Event.ARRIVED:
        return "arrives", None, ()
    return "resettled", None, (first,)


def place_of(traverse: Traverse, feature: int, leading: str) -> Place:
    """What a feature of the kernel is on these stairs and this robot."""
    k, part, kind = Feature.of(feature)
    outline = traverse.outline
    name = "track"
    if outline.kinds[part] == BELLY:
        name = "belly"
    elif outline.kinds[part] == FLIPPER:
        ahead = outline.parts[part, 0] + outline.parts[part, 3] > 0
        name = "front flipper" if ahead == (leading == "nose") else "rear flipper"
    corners = traverse.path.ground.points
    mirror = -1.0 if traverse.descending else 1.0
    nosings = traverse.profile.nosings * np.array([mirror, 1.0])
    nosings = nosings[np.argsort(nosings[:, 0], kind="stable")]
    if kind is FeatureKind.VERTEX:
        return _corner(nosings, mirror * corners[k, 0], float(corners[k, 1]), name)
    ends = corners[[k, k + 1]] * np.array([mirror, 1.0])
    ends = ends[np.argsort(ends[:, 1], kind="stable")]
    going, rise = np.abs(ends[1] - ends[0])
    if math.atan2(rise, going) > STEEP:
        top = _corner(nosings, float(ends[1, 0]), float(ends[1, 1]), name)
        return Place("riser", top.number, name)
    return _tread(nosings, float(ends[:, 0].mean()), name, outline.stance.flat_length)


def _corner(nosings: Array, x: float, z: float, part: str) -> Place:
    away = np.hypot(nosings[:, 0] - x, nosings[:, 1] - z)
    if len(away) and away.min() < 1e-6:
        return Place("nosing", int(np.argmin(away)) + 1, part)
    return Place("corner of step", _passed(nosings, x), part)


def _tread(nosings: Array, x: float, part: str, room: float) -> Place:
    number = _passed(nosings, x)
    if len(nosings) == 0:
        return Place("ground", None, part)
    if number == 0:
        return Place("the lower landing", None, part)
    if number == len(nosings):
        return Place("the upper landing", None, part)
    if nosings[number, 0] - nosings[number - 1, 0] >= room:
        return Place("the landing behind step", number, part)
    return Place("tread", number, part)


def _passed(nosings: Array, x: float) -> int:
    return int(np.searchsorted(nosings[:, 0], x + 1e-9, side="right"))
