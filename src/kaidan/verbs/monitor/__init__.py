"""Tip-over from an inertial measurement unit, sample by sample: margin, time, alarm.

Each sample gives the angle left between the resultant of weight and inertia and the contact over
which the robot would tip, and the time until none is left if the body goes on rotating, and the
robot driving, as it does (`kaidan.literature.tipover`, after Liu & Liu 2009). An alarm with
hysteresis follows. What is not known counts as the worst case: a position that is missing or
impossible, a speed, samples that nobody can read. Nothing but the samples goes in, so the same
samples give the same answer.
"""

import os
from collections.abc import Iterable
from contextlib import ExitStack
from typing import Any

from kaidan.arguments import known_arguments
from kaidan.errors import InputError, shown
from kaidan.question import Question
from kaidan.verbs.monitor.alarm import AlarmLimits as AlarmLimits
from kaidan.verbs.monitor.alarm import Cause as Cause
from kaidan.verbs.monitor.answer import MonitorAnswer as MonitorAnswer
from kaidan.verbs.monitor.answer import MonitorState as MonitorState
from kaidan.verbs.monitor.answer import SampleStatus as SampleStatus
from kaidan.verbs.monitor.online import Monitor as Monitor
from kaidan.verbs.monitor.samples import Sample as Sample
from kaidan.verbs.monitor.sources import open_samples as open_samples


@known_arguments
def monitor(
    robot: Any,
    stairs: Any,
    samples: Iterable[Sample] | str | os.PathLike[str],
    *,
    limits: AlarmLimits | None = None,
    strict: bool = False,
    **manner: Any,
) -> MonitorAnswer:
    """How far a robot was from tipping over, and how soon, by its inertial sensor.

    Parameters
    ----------
    robot : Robot, str or path
        Robot, or its name in the catalogue, or a TOML file.
    stairs : Stairs, str or path
        Stairs, or their name in the catalogue, or a TOML file.
    samples : iterable of Sample, str or path
        Samples in order, or a CSV file or a recording of them (see
        `kaidan.verbs.monitor.sources.open_samples`).
    limits : AlarmLimits, optional
        When the alarm is raised and cleared.
    strict : bool
        Refuse a sample that cannot be judged as it stands instead of giving it a status.
    **manner
        direction, facing, flippers, payload, override, as `kaidan.assess` has them.

    Returns
    -------
    MonitorAnswer
        With the state after each sample. Of a stream that does not end, feed a
        `kaidan.verbs.monitor.online.Monitor`.

    Raises
    ------
    InputError
        An input without physical meaning, a file that cannot be read, no sample at all.

    Examples
    --------
    >>> from math import radians
    >>> from kaidan.terrain.stairs import Stairs
    >>> stairs = Stairs.inclined(angle=radians(46), nosing_spacing=0.150)
    >>> samples = [Sample(0.0, 0.80, 0.0, 0.0), Sample(0.1, 0.95, 0.6, 0.0)]
    >>> answer = monitor("kenaf", stairs, samples)
    >>> answer.alarms, round(answer.lowest_margin_deg, 1)
    (1, 5.8)
    """
    question = Question.in_one_posture(robot, stairs, **manner)
    watch = Monitor.of(question, limits=limits, strict=strict)
    with ExitStack() as files:
        if isinstance(samples, str | os.PathLike):
            samples = files.enter_context(open_samples(samples, nose_up=question.nose_up))
        try:
            each = iter(samples)
        except TypeError:
            raise InputError(
                f"samples = {shown(samples)} is not a file or an iterable of Sample"
            ) from None
        states = [watch.feed(_sample(sample)) for sample in each]
    return watch.answer(states)


def _sample(given: Any) -> Sample:
    if not isinstance(given, Sample):
        raise InputError(f"samples: {shown(given)} is not a Sample")
    return given
