"""The fall in the stages of the paper's Fig. 20."""

import math

import pytest

from kaidan.terrain.stairs import Stairs
from kaidan.verbs.traverse import traverse


def fall(angle_deg, **asked):
    stairs = Stairs.inclined(angle=math.radians(angle_deg), nosing_spacing=0.150)
    return traverse("kenaf", stairs, friction=3.0, flippers="stowed", **asked)


def test_a_fall_has_the_stages_of_figure_20_in_order():
    report = fall(63.0)  # grade two ends at 62.48 deg (docs/theory)
    stages = {stage.name: stage for stage in report.fall_stages}
    assert list(stages) == ["parallel motion", "round end", "largest load", "onset of rotation"]
    assert stages["parallel motion"].inclination_deg == pytest.approx(63.0, abs=1e-6)
    assert stages["largest load"].inclination_deg > 80
    assert "100 % of the load on the lowest contact" in stages["largest load"].text
    assert stages["onset of rotation"].text.endswith("nothing arrests it")
    paths = [stage.path_m for stage in report.fall_stages]
    assert paths == sorted(paths)


def test_what_the_end_still_holds_is_told():
    stages = fall(62.0).fall_stages  # between the paper's 60.2 and 62.48 deg
    assert stages[-1].name == "rotates back"
    turned = stages[-1].inclination_deg - stages[0].inclination_deg
    assert 0.05 < turned < 45


def test_parallel_motion_all_the_way_needs_no_explanation():
    assert fall(55.0).fall_stages == ()


def test_going_down_the_lowest_contact_is_the_leading_one():
    stages = fall(67.0, direction="down", facing="tail-first").fall_stages
    assert stages[-1].name == "onset of rotation"
    assert "arrested after 6.0 deg" in stages[-1].text
