"""The trials of a question: one with the sheets' figures, or many with inputs drawn of their doubt.

The same Latin hypercube as that of the other models, of as many samples as there are trials; and
each trial begins another share of a nosing spacing from the stairs.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from kaidan.models.samples import unit_draws
from kaidan.models.spread import changed_nosings, moved_profile
from kaidan.override import overridden
from kaidan.physics import DrivenGrousers, SmoothBelt, TrackModel, TrialSpec, YieldingBelt
from kaidan.question import Question
from kaidan.robot import Robot, Uncertainty
from kaidan.surface import Surface
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.terrain.stairs_uncertainty import StairsUncertainty

Array = np.typing.NDArray[np.float64]

_OF_ALL = 6
"""Rows of the unit draws that are of the robot, of the whole flight and of friction."""
_SHAPE = ("rise", "going", "steps", "first_rise", "last_rise", "rises", "goings", "uncertainty")
_LEAST_FRICTION = 0.05


def track_of(question: Question) -> TrackModel:
    """Model of the track that a question asks for.

    As the question names it; else the yielding belt where the sheet says how it yields and the
    robot is driven straight on, else the smooth belt.
    """
    track = question.robot.track
    yields = track.stiffness is not None or track.indentation is not None
    usual = "yielding-belt" if yields and not question.yaw else "smooth-belt"
    kinds: dict[str, TrackModel] = {
        "smooth-belt": SmoothBelt(),
        "yielding-belt": YieldingBelt(),
        "driven-grousers": DrivenGrousers(),
    }
    return kinds[question.track or usual]


def drawn_specs(question: Question) -> Iterator[tuple[TrialSpec, ...]]:
    """Trials of each draw: with the smallest friction, then with the largest if it differs."""
    track = track_of(question)
    count = question.trials
    start: list[float | None] = [None] * count
    if count > 1:
        start = np.random.default_rng(count).permutation((np.arange(count) + 0.5) / count).tolist()
    for k, each in enumerate(drawn(question)):
        yield tuple(
            TrialSpec(
                question=each.changed(surface=surface),
                track=track,
                begin="landing",
                dimensions=3 if each.yaw else 2,
                start_offset=start[k],
                seed=k,
            )
            for surface in _surfaces(each)
        )


def _surfaces(question: Question) -> list[Surface | None]:
    if question.surface is None:
        return [None]
    return [Surface.of_friction(mu) for mu in sorted(set(question.friction))]


def drawn(question: Question) -> Iterator[Question]:
    """As many questions as there are trials, their inputs drawn of their doubt."""
    count = question.trials
    if count == 1 or not question.uncertain:
        for _ in range(count):
            yield question
        return
    profile = question.profile
    unit = unit_draws(count, _OF_ALL + 2 * len(profile.nosings))
    L, C_L, C_N, angle, spacing, friction = (
        unit[:_OF_ALL] * np.array(question.spread)[:, None]
    ).tolist()
    single = profile.drawn_nosings(unit[_OF_ALL:]) - profile.nosings
    whole = changed_nosings(profile.nosings, angle=np.array(angle), spacing=np.array(spacing))
    places = whole + single
    robot, mu = Robot(**dict(question.robot) | {"uncertainty": Uncertainty()}), question.friction
    for k in range(count):
        own = {
            "flat_length": robot.track.flat_length + L[k],
            "com_from_front": robot.com_from_front + C_L[k],
            "com_height": max(robot.com_height + C_N[k], 0.005),
        }
        changes: dict[str, Any] = {
            "robot": overridden(robot, own),
            "terrain": _moved(question, places[k]),
        }
        if question.surface is not None:
            ends = tuple(max(each + friction[k], _LEAST_FRICTION) for each in mu)
            changes["surface"] = Surface.of_friction(ends)
        yield question.changed(**changes)


def _moved(question: Question, nosings: Array) -> Stairs | Profile:
    """Terrain whose nosings lie elsewhere, without doubt."""
    terrain, profile = question.terrain, question.profile
    if isinstance(terrain, Stairs):
        kept = {name: getattr(terrain, name) for name in terrain.model_fields_set - {*_SHAPE}}
        rises = np.diff(nosings[:, 1], prepend=0.0)
        return Stairs(
            **kept,
            rises=tuple(np.maximum(rises, 0.005).tolist()),
            goings=tuple(np.maximum(np.diff(nosings[:, 0]), 0.02).tolist()),
            uncertainty=StairsUncertainty(),
        )
    return moved_profile(profile, nosings)
