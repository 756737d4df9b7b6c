"""One word of what each model says, by the one policy of verdicts."""

import math

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from kaidan.contact import Status
from kaidan.lab.cross_check import outcomes
from kaidan.lab.cross_check.bands import Band
from kaidan.lab.cross_check.common_question import FlightTraverse, common
from kaidan.lab.cross_check.comparison import of_friction
from kaidan.models.findings import Finding, Findings
from kaidan.modes import ENERGY, FALL_UPHILL, SLIDES_UP, STUCK, TIP_SIDEWAYS, TIP_UPHILL
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from physics_cases import robot

QUESTION = common(
    Question.in_one_posture(robot(), Stairs.inclined(angle=0.7, nosing_spacing=0.15), friction=1.0)
)


def found(*each, outside=""):
    return Findings(model="contact", each=each, outside=outside)


def finding(mode, margin, **fields):
    return Finding.certain(mode, margin, model="contact", **fields)


@pytest.mark.parametrize(
    ("each", "word"),
    [
        ((), "holds"),
        ((finding(TIP_UPHILL, 0.1),), "holds"),
        ((finding(TIP_UPHILL, -0.1),), "tips"),
        ((finding(TIP_SIDEWAYS, -math.inf),), "tips"),
        ((finding(SLIDES_UP, -0.1),), "slides"),
        ((finding(STUCK, -1.5),), "gets stuck"),
        ((finding(TIP_UPHILL, -0.1), finding(SLIDES_UP, -0.2)), "slides"),
        ((finding(TIP_UPHILL, -0.1), finding(FALL_UPHILL, 0.1)), "holds"),  # ROUGH: arrested
        ((finding(TIP_UPHILL, -0.1), finding(FALL_UPHILL, -0.1)), "tips"),
        (
            (finding(TIP_UPHILL, -0.1), finding(FALL_UPHILL, 0.1), finding(SLIDES_UP, -0.2)),
            "slides",
        ),
        ((finding(ENERGY, -1.0),), "holds"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_the_word_of_findings(each, word):
    assert outcomes.outcome(QUESTION, found(*each)) == word


def test_what_says_nothing_is_outside():
    assert outcomes.outcome(QUESTION, found(outside="no answer")) == "outside"
    assert outcomes.by_static_criterion(QUESTION, 0.8) == "holds"


@pytest.mark.parametrize(
    ("status", "required", "word"),
    [
        (Status.OK, 0.9, "holds"),
        (Status.OK, 1.1, "slides"),
        (Status.FELL_BACKWARD, math.nan, "tips"),
        (Status.FELL_FORWARD, math.nan, "tips"),
        (Status.NOT_CONVERGED, math.nan, "outside"),
        (Status.STUCK, math.nan, "gets stuck"),
    ],
)
def test_the_word_of_a_traverse(status, required, word):
    traverse = FlightTraverse(status, 0.0, 0.0, required)
    assert outcomes.by_traverse(QUESTION, traverse) == word


def test_a_band_without_an_end_holds_whatever_lies_there():
    for low, high, value, holds in [
        (None, None, 1e3, True), (0.0, None, 5.0, True), (0.0, None, -1.0, False),
        (None, 1.0, -9.0, True), (-1.0, 1.0, 1.5, False),
    ]:  # fmt: skip
        assert Band(low_deg=low, high_deg=high, reason="").holds(value) is holds


def test_angle_of_friction_by_hand():
    assert of_friction(1.0) == pytest.approx(45.0)
    assert np.isclose(of_friction(math.tan(0.5)), math.degrees(0.5))
