"""The fall in the stages of the paper's Fig. 20."""

import math

import pytest

from kaidan.assessment import case_of
from kaidan.report.journey import journey
from kaidan.stairs import Stairs


def fall(angle_deg, **asked):
    stairs = Stairs.inclined(angle=math.radians(angle_deg), nosing_spacing=0.150)
    return journey(case_of("kenaf", stairs, friction=3.0, **asked))


def test_a_fall_has_the_stages_of_figure_20_in_order():
    way = fall(63.0)  # grade two ends at 62.48 deg (theory, section 5)
    stages = {stage.name: stage for stage in way.fall}
    assert list(stages) == ["parallel motion", "round end", "largest load", "release"]
    assert stages["parallel motion"].inclination_deg == pytest.approx(63.0, abs=1e-6)
    assert stages["largest load"].inclination_deg > 80
    assert "100 % of the load on the lowest contact" in stages["largest load"].text
    assert stages["release"].text.endswith("nothing catches it")
    ways = [stage.way_m for stage in way.fall]
    assert ways == sorted(ways)
    assert way.as_dict()["fall"][0]["name"] == "parallel motion"


def test_what_the_end_still_holds_is_told():
    stages = fall(62.0).fall  # between the paper's 60.2 and 62.48 deg
    assert stages[-1].name == "held"
    turned = stages[-1].inclination_deg - stages[0].inclination_deg
    assert 0.05 < turned < 45


def test_parallel_motion_all_the_way_needs_no_explanation():
    assert fall(55.0).fall == ()


def test_going_down_the_lowest_contact_is_the_leading_one():
    stages = fall(67.0, direction="down", facing="tail-first").fall
    assert stages[-1].name == "release"
    assert "caught after 6.0 deg" in stages[-1].text
