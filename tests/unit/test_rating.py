"""Postures rated in one call: the same figures as those of a traverse of each alone."""

import math

import numpy as np
import pytest

from kaidan.contact import Placement
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Phase, traverse
from kaidan.traversal.rating import Part, rate
from kaidan.traversal.samples import trailing_end_leaves

ABSOLEM = Robot.named("absolem")
STAIRS = Profile.of_stairs(Stairs(rise=0.178, going=0.279, steps=5))
ANGLES = [(None, None), ("flat", "flat"), (0.6, -0.2), (-0.8, 0.3), (1.2, -1.0)]


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("acceleration", [0.0, 0.3])
def test_a_rating_is_that_of_the_traverse(descending, acceleration):
    # oracle: the traverse with its poses, figure by figure
    x = 0.279 * 4 - 0.05
    places = [(None, None), (Placement(x, 0.0, 0.0 if descending else 0.5), None), (None, x)]
    if descending:
        places = [(None, None)]
    outlines = [Outline.of(ABSOLEM, Posture(front=f, rear=r)) for f, r in ANGLES]
    parts = [Part(outline, *place) for outline in outlines for place in places]
    manner = {"descending": descending, "acceleration": acceleration, "step": 0.02}
    rated = rate(STAIRS, parts, **manner)
    arrived = 0
    for each, part in zip(rated, parts, strict=True):
        found = traverse(STAIRS, part.outline, start=part.start, until=part.until, **manner)
        assert (each is not None) == found.arrived
        if each is None:
            continue
        arrived += 1
        landing = found.phase_of_pose == Phase.LAND.value
        held = ~(trailing_end_leaves(found.path) & landing)
        margins = found.path.margins
        assert each.required_friction == np.nan_to_num(
            margins.required_friction[held], nan=math.inf
        ).max(initial=0.0)
        assert each.belly_touches == margins.belly_touches.any()
        chains = found.chains
        assert each.rotation == pytest.approx(max((c.angle for c in chains), default=0.0))
        assert each.avoidable == pytest.approx(max((c.avoidable for c in chains), default=0.0))
        assert each.impact_speed == pytest.approx(
            max((c.impact_speed for c in chains), default=0.0)
        )
        assert each.spare == pytest.approx(min((c.spare for c in chains), default=math.inf))
        for margin, side in ((each.downhill, True), (each.uphill, False)):
            worst = found.criterion.smallest(downhill=side) if found.whole else None
            assert margin == (math.inf if worst is None else worst.margin)
    assert arrived >= 3
