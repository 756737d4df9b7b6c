"""Samples of the campaigns that ``benchmarks/clouds.py`` runs in full."""

import numpy as np
import pytest

import cloud_campaign as campaign
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter

ONCE_WRONG = (
    116,  # an odd landing from above, and a step of which nothing was seen
    173,  # treads from above beside a wall
    263,  # an odd last riser of which the landing was seen
    3128,  # walls at both sides behind the last step
    6120,  # a flight in two parts
    7058,  # a floor that lies lower than a regular riser leads up from: it passed for a face
    30275,  # the same, higher
    40084,  # the same, of a LiDAR
    300168,  # four steps from their landing: the end of the floor that they hide bent their line
    300103,  # one beam on the lowest riser that is seen
    300152,  # a floor that leads on beyond where its end was sought
    700053,  # treads from above, their back parts hidden
    800318,  # a first riser 30 mm lower, and no line fitted again without the floor
    800819,  # an odd last riser of three nosings
    300090,  # the same, of which the landing lies off the line
    970109,  # the same, 30 mm lower, beside a wall: its line did not leave it
    970008,  # three treads from above, of the third the front alone: the second one seemed full
)


def test_known_stairs_are_found():
    """No failure at up to 10 mm of noise; what lacks is said to be unseen."""
    tally = campaign.Tally()
    for number in (*range(9), *ONCE_WRONG):
        campaign.judge(number, tally)
    assert tally.failures == []
    assert tally.refusals == []
    assert max(abs(each) for each in tally.errors["spacing"]) < 0.006  # 0.5 % of bias is 1.7 mm


def test_a_refusal_for_too_few_steps_names_fewer_than_are_needed():
    """Four steps are on the line and two of them measured: it said 4 where 3 are needed."""
    found = interpreter.found(campaign.cloud(campaign.case(910_114).seen), Hints())
    (refusal,) = found.refusals
    assert refusal.why == "too-few"
    assert refusal.numbers["steps"] < refusal.numbers["needed"]


@pytest.mark.parametrize(("number", "odd"), [(1014, 0.02), (1065, -0.03)])
def test_a_last_riser_of_which_the_end_alone_is_seen(number, odd):
    """Its landing is hidden: 20 mm higher, which OzBot does not take, and 30 mm lower."""
    made = campaign.case(number)
    (stairs,) = interpreter.found(campaign.cloud(made.seen), Hints()).staircases
    (sheet,) = stairs.stairs()
    *usual, last = sheet.step_rises[1:]
    assert not sheet.head_seen
    # twice the standard uncertainty of such an end, 5 to 7 mm
    assert last - np.mean(usual) == pytest.approx(odd, abs=0.014)
    assert "go" not in [
        of_cloud for truth, of_cloud, _ in campaign.verdicts(number) if truth != "go"
    ]


@pytest.mark.parametrize("number", [40206, 910_260])
def test_what_lies_on_the_floor_is_no_floor(number):
    """A box of 93 mm before the first riser, which then seemed 64 mm high; things over a floor of
    which a person hides the middle: it seemed 60 mm high."""
    made = campaign.case(number)
    (stairs,) = interpreter.found(campaign.cloud(made.seen), Hints()).staircases
    (flight,) = stairs.flights
    assert len(flight) == len(made.nosings)
    assert not flight.begins or flight.line()[0, 1] == pytest.approx(made.nosings[0, 1], abs=0.01)


@pytest.mark.parametrize(
    "number", [*range(13), 20_030, 20_143, 600_190, 720_460, 780_251, 900_205, 961_016]
)
# ends of ramps passed for three steps, a whole one with battens for nine, boards of shelves and
# seats of a grandstand for four and five, a stack of pallets for three
def test_a_lookalike_is_no_staircase(number):
    cloud, _ = campaign.lookalike(number)
    assert interpreter.found(cloud, Hints()).staircases == ()


@pytest.mark.slow
def test_doubts_are_neither_too_small_nor_too_large():
    """Of nosing spacing and angle, whose errors the scenes draw from what the reader takes for
    granted; no first riser off by more than 3 sigma, but for chance in 150. Last risers are few:
    from the foot landings are hidden."""
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
def test_verdicts_of_clouds_agree_with_the_truth():
    """P(GO) of a cloud agrees with the truth's verdict at the stated risk."""
    each = [row for number in range(40) for row in campaign.verdicts(number)]
    assert len(each) > 50
    assert not [row for row in each if row[:2] == ("no-go", "go")]
    sure = [row[0] != "no-go" for row in each if row[2] is not None and row[2] <= 0.01]
    assert np.mean(sure) >= 0.97
    doomed = [row[0] == "no-go" for row in each if row[2] is not None and row[2] >= 0.99]
    assert np.mean(doomed) >= 0.97


@pytest.mark.slow
def test_no_staircase_in_many_scenes_without_one():
    found = []
    for number in range(260):
        cloud, kind = campaign.lookalike(number)
        if interpreter.found(cloud, Hints()).staircases:
            found.append((number, kind))
    assert found == []
