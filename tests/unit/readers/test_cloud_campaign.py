"""Samples of the campaigns that ``benchmarks/clouds.py`` runs in full."""

import pytest

import cloud_campaign as campaign
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter


def test_known_stairs_are_found():
    """Issue: no failure at up to 10 mm of noise; what lacks is said to be unseen."""
    tally = campaign.Tally()
    for number in range(9):
        campaign.judge(number, tally)
    assert tally.failures == []
    assert tally.refusals == []
    assert max(abs(each) for each in tally.errors["spacing"]) < 0.006  # 0.5 % of bias is 1.7 mm


@pytest.mark.parametrize("number", range(13))
def test_a_lookalike_is_no_staircase(number):
    cloud, _ = campaign.lookalike(number)
    assert interpreter.found(cloud, Hints()).staircases == ()


@pytest.mark.slow
def test_doubts_are_neither_too_small_nor_too_large():
    """Of nosing spacing and angle, whose errors the scenes draw from what the reader takes for
    granted; no first riser off by more than 3 sigma, but for chance in 150. A last riser may be:
    in 1 of 35 scenes its end was hidden."""
    tally = campaign.Tally()
    for number in range(150):
        campaign.judge(number, tally)
    assert len(tally.failures) + len(tally.refusals) <= 3
    for name in ("spacing", "angle_deg"):
        _, rms, within, _, _, _ = tally.row(name)
        assert 0.6 < rms < 1.4
        assert within >= 0.85
    assert tally.row("first rise")[3] < 3.5


@pytest.mark.slow
def test_no_staircase_in_many_scenes_without_one():
    found = []
    for number in range(260):
        cloud, kind = campaign.lookalike(number)
        if interpreter.found(cloud, Hints()).staircases:
            found.append((number, kind))
    assert found == []
