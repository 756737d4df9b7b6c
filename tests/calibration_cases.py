"""A physics that is known: falls and inclines by rule, so that what a fit finds can be checked."""

import math

from kaidan.lab.calibration.engagement import engaged
from kaidan.physics import record, run


def falls_from(angle_of, extra_of):
    """Runner whose trials fall from a slope [deg] on and incline by so much more [deg] below it.

    Both are functions of the spec.
    """

    def run(specs):
        asked.extend(specs)
        return [
            ("fell_backward", 46.0, 1)
            if math.degrees(spec.question.terrain.angle) >= angle_of(spec) - 1e-9
            else ("climbed", extra_of(spec), 2)
            for spec in specs
        ]

    asked = []
    run.asked = asked
    return run


def here(specs):
    """Runner of trials one after the other in this process."""
    return [
        (result.outcome.value, result.largest_extra_deg, result.nosings_passed)
        for result in map(run, specs)
    ]


def engaged_here(specs):
    """The same for grousers that engage."""
    return [engaged(record(spec)) for spec in specs]
