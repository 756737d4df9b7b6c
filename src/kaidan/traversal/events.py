"""Events of a traverse with the step and the phase at which they happen."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.terrain.profile import Profile
from kaidan.traversal.phases import Phase, step_at


@dataclass(frozen=True, kw_only=True)
class TraverseEvent:
    """An event along the path."""

    kind: contact.Event
    phase: Phase
    step: int
    """Nosing number from the bottom, 1 the first; 0 before it."""
    path: float
    """Arclength of the centroid's path [m]."""
    x: float
    """Of the centroid [m]."""
    z: float
    """Of the centroid [m]."""
    inclination: float
    """Of the body, leading end up [rad]."""
    feature: int
    """What it concerns: a corner or a segment of the ground and a part of the robot."""
    other_feature: int
    """The second contact, if there is one; else -1."""
    rotation: float | None
    """How far it turned, where the next contact arrests it [rad]."""
    topples_with_momentum: bool | None
    """Whether the momentum gained would carry it over, where the next contact arrests it."""

    @property
    def name(self) -> str:
        """made, lost, nose-drops, tips-back, arrested, tail-rests, fell-forward, ..."""
        return self.kind.name.lower().replace("_", "-")


def traverse_events(
    path: contact.Path,
    records: contact.Events,
    profile: Profile,
    phase: NDArray[np.str_],
    descending: bool,
) -> tuple[TraverseEvent, ...]:
    """Records of events with their steps and phases, in their order."""
    events = []
    begun = -1
    places = path.poses.front_point[:, 0]
    for record in records:
        at = min(max(record.pose, 0), len(path.poses) - 1)
        if record.kind in (contact.Event.NOSE_DROPS, contact.Event.TIPS_BACK):
            begun += 1
        arrested = None
        if record.kind is contact.Event.ARRESTED and 0 <= begun < len(path.rotations):
            arrested = path.rotations[begun]
        events.append(
            TraverseEvent(
                kind=record.kind,
                phase=Phase(str(phase[at])),
                step=step_at(profile, float(places[at]), descending),
                path=record.s,
                x=record.x,
                z=record.z,
                inclination=record.inclination,
                feature=record.feature,
                other_feature=record.other,
                rotation=None if arrested is None else arrested.angle,
                topples_with_momentum=(
                    None if arrested is None else arrested.topples_with_momentum
                ),
            )
        )
    return tuple(events)
