r"""Robots whose track has a gap: where they may jam, although friction is enough.

::

              ______    the part ahead of the gap pulls the part behind it against the riser,
        .--. (______)   and neither gets on
       (____)|_______
    _________|

A bar, not mechanics: what driven trials did, until one speed of all belts is in the forces
(docs/decisions.md).
"""

import math
from typing import Protocol

import numpy as np

from kaidan.models.findings import Finding
from kaidan.modes import CONTACT, GAP_JAM, Phase
from kaidan.question import Question
from kaidan.traversal import Traverse
from kaidan.traversal.phases import step_at
from kaidan.traversal.samples import lasting

MOST_FRICTION = 1.0
"""Required friction beyond which a robot with a gap is no GO [1]."""
STEEPEST = math.radians(75.0)
"""Lean of the trailing contact's normal beyond which it is at a riser's face [rad]."""


class Place(Protocol):
    """Part of a traverse, and a nosing of it."""

    @property
    def phase(self) -> Phase | None:
        """Part of the traverse."""

    @property
    def step(self) -> int | None:
        """Nosing, counted from the bottom."""


def most_friction(question: Question) -> float:
    """Friction that may be required of a question's robot for a GO [1]; infinite: any."""
    return MOST_FRICTION if question.robot.track.gap > 0 else math.inf


def jams(
    question: Question,
    found: Traverse,
    required: float,
    place: Place,
    phase: Phase | None,
) -> list[Finding]:
    """Finding of a robot with a gap that may jam; none without a gap, or a friction stated.

    required: friction that it requires [1].

    At most zero where its trailing part comes against a riser's face.
    """
    if math.isinf(most_friction(question)) or question.surface is None:
        return []
    spare, poses = _spare(required), found.path.poses
    normal = poses.rear_normal
    leans = np.abs(np.arctan2(normal[:, 0], normal[:, 1])) > STEEPEST
    leans &= lasting(found.path) & (not found.descending)
    if phase is not None:
        leans &= found.phase_of_pose == phase.value
    if spare <= 0 or not leans.any():
        return [_finding(spare, place.phase, place.step)]
    first = int(np.argmax(leans))
    step = step_at(found.profile, float(poses.front_point[first, 0]), found.descending)
    return [_finding(0.0, Phase(str(found.phase_of_pose[first])), step)]


def _spare(required: float) -> float:
    """Margin of slope of a required friction [rad]; NaN: none is enough, or it is not known."""
    bar, needed = math.atan(MOST_FRICTION), math.atan(required)
    return bar - needed if math.isfinite(required) else math.nan


def _finding(margin: float, phase: Phase | None, step: int | None) -> Finding:
    return Finding.certain(GAP_JAM, margin, phase=phase, step=step, model=CONTACT.name)
