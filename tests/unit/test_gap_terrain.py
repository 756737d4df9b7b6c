"""Gaps of a flight's sheet: the terrain that they make, and what it comes to, by hand."""

import numpy as np
import pytest

from kaidan import InputError, Profile, Question, Robot, Stairs, assess
from kaidan.models import judge
from kaidan.modes import GAP, LANDING_ROOM
from kaidan.terrain import sentences as text
from kaidan.terrain.gap import Gap, carved
from kaidan.terrain.stairs_uncertainty import StairsUncertainty
from kaidan.text.japanese import japanese

STEPS = {"rise": 0.2, "going": 0.3, "steps": 3, "lower_landing": 2.0, "upper_landing": 2.0}
"""Nosings at 0, 0.3 and 0.6 m."""


def flight(*gaps, **more):
    return Stairs(**STEPS | more, gaps=gaps)


def profile(*gaps, **more):
    return Profile.of_stairs(flight(*gaps, **more))


def test_a_gap_before_a_riser_has_the_nosing_for_its_far_edge():
    """From the middle of the second tread to the third riser, 1 m below the tread at 0.4 m."""
    found = profile(Gap(start=0.45, end=0.6, depth=1.0))
    assert found.points[4:10].tolist() == pytest.approx(
        np.array([(0.3, 0.4), (0.45, 0.4), (0.45, -0.6), (0.6, -0.6), (0.6, 0.6), (2.6, 0.6)])
    )
    assert found.nosings[:, 0] == pytest.approx([0.0, 0.3, 0.6])
    assert found.edges[:, 0] == pytest.approx([0.0, 0.3, 0.45, 0.6])


def test_a_level_gap_makes_no_nosing():
    """The robot goes on over it as it went; its edges are edges."""
    found = profile(Gap(start=0.8, end=1.1, depth=1.0))
    assert found.nosings[:, 0] == pytest.approx([0.0, 0.3, 0.6])
    assert found.edges[:, 0] == pytest.approx([0.0, 0.3, 0.6, 0.8, 1.1])


def test_a_gap_takes_the_nosings_in_it():
    """From the second riser over its nosing to the third one: a tread that is missing."""
    found = profile(Gap(start=0.3, end=0.6, depth=0.5))
    assert found.nosings.tolist() == pytest.approx(np.array([(0.0, 0.2), (0.6, 0.6)]))


def test_a_far_edge_errs_as_the_nosing_that_it_stands_for():
    """From the first tread over the second nosing into the second tread, 0.1 m behind it."""
    doubt = StairsUncertainty(rise=0.01, going=0.02)
    found = profile(Gap(start=0.2, end=0.4, depth=0.5), uncertainty=doubt)
    whole = profile(uncertainty=doubt)
    assert found.nosings[:, 0] == pytest.approx([0.0, 0.4, 0.6])
    assert found.covariance.shape == whole.covariance.shape
    assert found.covariance[2:4, 2:4] == pytest.approx(whole.covariance[2:4, 2:4])


def test_a_gap_before_the_foot_of_several_flights():
    """Places count from the first nosing of each flight: the second one's stands at 2.6 m."""
    gap = Gap(start=-0.3, end=0.0, depth=1.0)
    found = Profile.of_flights([flight(), flight(gap)])
    deepest = found.points[found.points[:, 1] < 0.0]
    assert deepest.tolist() == pytest.approx(np.array([(2.3, -0.4), (2.6, -0.4)]))


def test_what_has_no_end_leaves_the_terrain_as_it_is():
    assert profile(Gap(start=0.9)) == profile()
    assert profile(Gap(end=-0.1)) == profile()


def test_a_gap_beyond_the_landing_lengthens_it():
    line = np.array([(-1.0, 0.0), (1.0, 0.0)])
    points, edges = carved(line, [Gap(start=1.5, end=2.0, depth=1.0)])
    assert edges[:, 0].tolist() == [1.5, 2.0]
    assert points[-1] == pytest.approx((2.0, 0.0), abs=2e-3)  # a millimetre of floor behind it


@pytest.mark.parametrize(
    ("gap", "says"),
    [
        ({}, "stairs: gaps: give start or end, or both"),
        ({"start": 1.0, "end": 0.5, "depth": 1.0}, "end = 0.5 m is not beyond start = 1 m"),
        ({"start": 0.0, "end": 0.5}, "stairs: gaps: depth is missing"),
    ],
)
def test_gaps_that_are_none(gap, says):
    with pytest.raises(InputError, match=says):
        Gap(**gap)


def test_a_sheet_with_gaps_is_written_and_read():
    sheet = flight(Gap(start=0.45, end=0.6, depth=1.0, beside=0.7), Gap(start=0.9))
    assert Stairs.from_text(sheet.to_toml(), origin="x") == sheet


ABSOLEM = {"friction": 1.0, "flippers": "flat"}
LONG = {"rise": 0.17, "going": 0.29, "steps": 10}
"""Last nosing at 2.61 m."""


def finding(gap, robot="absolem", **how):
    return judge(Question.of(robot, Stairs(**LONG, gaps=[gap]), **ABSOLEM | how)).of(GAP)


@pytest.mark.parametrize("length", [0.05, 0.058, 0.3])
def test_an_end_rolls_over_a_gap_that_is_shorter_than_it_is_wide(length):
    """Absolem's flippers end in discs of 29 mm radius."""
    gap = Gap(start=2.9, end=2.9 + length, depth=1.0)
    assert finding(gap).worst == pytest.approx([0.058 - length])


def test_without_an_end_no_robot_rolls_over_it():
    assert finding(Gap(start=2.9)).worst == [-np.inf]
    assert finding(Gap(end=0.0)).worst == [-np.inf]


def test_the_longest_gap_counts():
    question = Question.of(
        "absolem", flight(Gap(start=0.5, end=0.6, depth=1.0), Gap(start=-0.3, end=0, depth=1.0))
    )
    assert question.widest_gap[1].start == -0.3


@pytest.mark.parametrize(("beside", "met"), [(0.71, True), (0.72, False)])
def test_a_robot_passes_beside_a_gap(beside, met):
    """Absolem flat is 1.207 m long and 0.594 m wide: it needs 716 mm off line."""
    gap = Gap(start=2.9, end=3.2, depth=1.0, beside=beside)
    assert (finding(gap) is not None) is met
    terrain = Question.of("absolem", Stairs(**LONG, gaps=[gap]), **ABSOLEM).profile
    assert (terrain.points[:, 1].min() < 0.0 or len(terrain.edges) > 10) is met


def test_of_unknown_width_no_robot_passes_beside():
    kenaf = Robot.named("kenaf")
    gap = Gap(start=2.9, end=3.2, depth=1.0, beside=3.0)
    assert finding(gap, kenaf, flippers="stowed") is not None


def test_before_a_gap_behind_a_landing_the_robot_may_stand():
    """At 0.6 m a landing ends there; at 0.5 m, less than a landing is deep, it must be crossed."""
    far, near = (
        judge(Question.of("absolem", Stairs(**LONG, gaps=[gap]), **ABSOLEM))
        for gap in (Gap(start=2.61 + at, end=4.0, depth=1.0) for at in (0.6, 0.5))
    )
    assert far.of(GAP) is None
    assert far.of(LANDING_ROOM).worst == pytest.approx([0.6 - 1.207], abs=1e-3)
    assert near.of(GAP) is not None


def test_a_gap_longer_than_the_robot_is_a_fall():
    """1.3 m, and Absolem is 1.2 m long: it falls over its uphill end as its centroid leaves it."""
    gap = Gap(start=2.9, end=4.2, depth=2.0)
    answer = assess("absolem", Stairs(**LONG, gaps=[gap]), **ABSOLEM)
    assert (answer.verdict, answer.governs) == ("no-go", "fall_uphill")


def test_the_closed_form_knows_gaps_too():
    gap = Gap(start=2.9, end=3.2, depth=1.0)
    answer = assess("absolem", Stairs(**LONG, gaps=[gap]), model="closed-form", friction=1.0)
    assert (answer.verdict, answer.governs) == ("unsure", "gap")


def test_a_plan_is_searched_with_the_gap_where_it_lies():
    """A uniform flight is searched on fewer steps, which put the gap elsewhere: the plan that came
    out was a NO-GO, and flat flippers are none."""
    gap = Gap(start=2.9, end=3.2, depth=1.5)
    found, flat = (
        assess("absolem", Stairs(**LONG, gaps=[gap]), friction=1.0, **how)
        for how in ({}, {"flippers": "flat"})
    )
    assert found.verdict == flat.verdict == "unsure"
    assert found.margin_deg >= flat.margin_deg


PLACES = [0.0, 0.3, 0.6]


@pytest.mark.parametrize(
    ("gap", "where"),
    [
        ({"start": -0.3, "end": 0.0, "depth": 1.0}, "before the first riser"),
        ({"end": 0.0}, "before the first riser"),
        ({"end": -0.4}, "from 0.40 m before the first riser on"),
        ({"start": 0.1, "end": 0.3, "depth": 1.0}, "before step 2"),
        ({"start": 0.5, "end": 0.6, "depth": 1.0}, "before step 3"),
        ({"start": 0.7, "end": 0.9, "depth": 1.0}, "behind the last nosing"),
        ({"start": 0.6}, "behind the last nosing"),
        ({"start": 0.9}, "from 0.30 m behind the last nosing on"),
    ],
)
def test_where_a_gap_lies(gap, where):
    gap = Gap(**gap)
    assert text.place(gap, PLACES) == where
    for sentence in (text.stated(gap, PLACES), text.reason(gap, PLACES, 0.058)):
        assert where in sentence
        assert japanese(sentence) is not None


def test_the_gap_is_among_the_notes_of_an_answer():
    gap = Gap(start=2.9, end=2.95, depth=1.0)
    answer = assess("absolem", Stairs(**LONG, gaps=[gap]), **ABSOLEM)
    assert "A gap of 50 mm, 1.00 m deep, lies behind the last nosing." in answer.notes
