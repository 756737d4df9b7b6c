"""Shares of inputs in a margin's doubt, by hand on few samples."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.allowance import Allowance
from kaidan.assessment import measuring as module
from kaidan.assessment.measuring import Drawn, draws_of, first_order, margins_of, to_measure
from kaidan.assessment.uncertain_inputs import SAMPLED, STEPS, Doubt
from kaidan.models.findings import Finding, Findings
from kaidan.models.samples import unit_draws
from kaidan.modes import ENERGY, SLIDES_DOWN, STUCK, TIP_DOWNHILL, TIP_UPHILL

ASKED = SimpleNamespace(
    allowance_d=Allowance(low=0.01, high=0.04), allowance_M=Allowance(low=0.02, high=0.03),
    robot=SimpleNamespace(com_range=None),
)  # fmt: skip
HEIGHT, LENGTH = Doubt("com_height", 0.01, None), Doubt("flat_length", 0.02, None)
FRICTION, D = Doubt("friction", 0.1, (0.5, 0.9)), Doubt("theta_d", 0.01, (0.04, 0.01))


def finding(mode, worst, best=None):
    worst = np.array(worst, dtype=float)
    return Finding(mode=mode, worst=worst, best=worst if best is None else np.array(best), model="")


@pytest.fixture
def margins(monkeypatch):
    monkeypatch.setattr(module, "sample_count", lambda question: 3)

    def of(*each, **draws):
        arrays = {name: Drawn.of(np.array(values)) for name, values in draws.items()}
        found = margins_of(ASKED, Findings(model="", each=each), arrays)
        return None if found is None else found.tolist()

    return of


THREE = {"theta_d": (0.0, 0.5, 1.0), "theta_M": (1.0, 0.0, 0.5), "friction": (1.0, 0.5, 0.0)}


def test_ranges_move_margins_from_the_worst_to_the_best_case(margins):
    """Two of them by their widths, 30 and 10 mrad."""
    tips = finding(TIP_DOWNHILL, [0.1] * 3, [0.5] * 3)
    assert margins(tips, **THREE) == pytest.approx([0.2, 0.25, 0.45])
    del (only := dict(THREE))["theta_M"]
    assert margins(tips, **only) == pytest.approx([0.1, 0.3, 0.5])
    assert margins(finding(TIP_UPHILL, [0.1] * 3, [0.5] * 3), **THREE) == pytest.approx(
        [0.1, 0.3, 0.5]
    )
    slides = finding(SLIDES_DOWN, [0.3], [0.4])
    assert margins(slides, **THREE) == pytest.approx([0.4, 0.35, 0.3])
    assert margins(tips, slides, **THREE) == pytest.approx([0.2, 0.25, 0.3])  # of both the least
    some = finding(SLIDES_DOWN, [0.05, math.inf, 0.2])
    assert margins(tips, some) == [0.05, 0.1, 0.1]
    assert margins(tips) == [0.1] * 3
    half = finding(TIP_DOWNHILL, [0.1, 0.2, 0.3], [0.5, math.inf, 0.5])
    assert margins(half, **THREE) == [0.1, 0.2, 0.3]  # not all of it is known


def test_what_never_fails_in_some_samples_is_not_moved(margins):
    tips = finding(TIP_DOWNHILL, [0.1, math.inf, 0.3], [0.5, math.inf, 0.5])
    other = finding(TIP_UPHILL, [0.2] * 3)
    assert margins(tips, other, **THREE) == [0.1, 0.2, 0.2]


def test_of_what_no_margin_is_known(margins):
    tips, certain = finding(TIP_DOWNHILL, [0.1] * 3), finding(STUCK, [0.05])
    assert margins(tips, certain) == [0.1] * 3  # nothing drawn moves it
    assert margins(tips, finding(ENERGY, [0.001] * 3)) == [0.1] * 3  # no angle
    assert margins(tips, finding(SLIDES_DOWN, [math.inf] * 3)) == [0.1] * 3
    assert margins(certain, finding(ENERGY, [0.001] * 3)) is None
    assert margins(tips, finding(SLIDES_DOWN, [0.2] * 2)) is None  # samples of its own
    assert margins(finding(SLIDES_DOWN, [0.2] * 2)) is None
    assert margins(finding(TIP_DOWNHILL, [0.1, math.inf, 0.1])) is None


def test_a_first_order_index_of_seven_draws(monkeypatch):
    """Slices of 3, 2 and 2 in the order of the draws, of means 1, 2 and 6 and variances 2/3, 1, 1.

    Their mean is 19/7; within 6/7, between (3 * 144 + 2 * 25 + 2 * 529) / 343 = 220/49, of which
    chance makes 18/49; the whole is 6/7 + 220/49 = 262/49.
    """
    monkeypatch.setattr(module, "SLICES", 3)
    drawn = Drawn.of(np.array([0.9, 0.1, 0.5, 0.2, 0.8, 0.3, 0.6]))
    values = np.array([7.0, 0.0, 1.0, 1.0, 5.0, 2.0, 3.0])
    for unit in (1.0, 0.01):
        assert first_order(drawn, unit * values) == pytest.approx((220 - 18) / 262)
    assert first_order(drawn, np.full(7, 0.3)) == 0.0
    # alternating within slices: means 1/3, 1/2 and 1/2 tell less than chance does
    assert first_order(drawn, np.array([0.0, 0, 0, 1, 1, 0, 1])) == 0.0


def test_draws_of_ranges_are_even_and_of_sheets_the_answers(monkeypatch):
    monkeypatch.setattr(module, "sample_count", lambda question: 4)
    found = draws_of(ASKED, (HEIGHT, FRICTION, D, Doubt(STEPS, math.nan, None)))
    assert list(found) == ["com_height", "friction", "theta_d"]
    of_the_answer = unit_draws(4)[SAMPLED.index("com_height")]
    np.testing.assert_array_equal(found["com_height"].draws, of_the_answer)
    for name in ("friction", "theta_d"):
        assert sorted(found[name].draws) == [0.125, 0.375, 0.625, 0.875]
    for drawn in found.values():
        assert sorted(drawn.draws) == drawn.draws[drawn.order].tolist()
    assert found["friction"].draws.tolist() != found["theta_d"].draws.tolist()


def test_numbers_scrambled_as_published():
    """The first two of SplitMix64 from seed 1234567, as its authors' program prints them."""
    seed, golden = 1234567, 0x9E3779B97F4A7C15
    counted = np.array([1, 2], dtype=np.uint64)
    begun = counted + np.uint64(seed * pow(golden, -1, 2**64) % 2**64)
    assert module._scrambled(begun).tolist() == [6457827717110365317, 3203168211198807973]


@pytest.fixture
def measured(monkeypatch):
    """What to measure, of inputs with some indices and samples of a margin [rad]."""

    def of(indices, margin, doubts=None, outside="", com_range=None):
        names = {"com_height": HEIGHT, "flat_length": LENGTH, "friction": FRICTION,
                 "com_from_front": Doubt("com_from_front", 0.01, None)}  # fmt: skip
        each = tuple(names[name] for name in indices) if doubts is None else doubts
        values = None if margin is None else np.array(margin)
        draws = {name: Drawn(np.array([index]), None) for name, index in indices.items()}
        monkeypatch.setattr(module, "doubts_of", lambda question: each)
        monkeypatch.setattr(module, "draws_of", lambda question, doubts: draws)
        monkeypatch.setattr(module, "margins_of", lambda question, found, draws: values)
        monkeypatch.setattr(module, "first_order", lambda drawn, margin: float(drawn.draws[0]))
        question = SimpleNamespace(robot=SimpleNamespace(com_range=com_range))
        found = to_measure(question, Findings(model="", outside=outside))
        return [(one.what, one.inputs, one.share, one.deviation_deg) for one in found]

    return of


TWO = (0.1, 0.3)
"""Of a standard deviation of 0.1 rad."""


def degrees(share):
    return pytest.approx(math.degrees(0.1 * math.sqrt(share)))


def test_what_the_margin_feels_most_is_measured_first(measured):
    indices = {"com_height": 0.1, "flat_length": 0.05, "friction": 0.5, "com_from_front": 0.2}
    assert measured(indices, TWO) == [
        ("friction", ("friction",), pytest.approx(0.5), degrees(0.5)),
        ("centroid", ("com_height", "com_from_front"), pytest.approx(0.3), degrees(0.3)),
        ("length", ("flat_length",), pytest.approx(0.05), degrees(0.05)),
    ]
    # of more than all as much as there is
    assert measured({"friction": 1.5, "flat_length": 0.5}, TWO) == [
        ("friction", ("friction",), pytest.approx(0.75), degrees(0.75)),
        ("length", ("flat_length",), pytest.approx(0.25), degrees(0.25)),
    ]


def test_single_steps_bring_what_the_others_leave(measured):
    steps = Doubt(STEPS, math.nan, None)
    left, rest = measured({"friction": 0.4}, TWO, (FRICTION, steps))
    assert (left[0], left[1], left[2]) == ("stairs", (STEPS,), pytest.approx(0.6))
    assert rest[2] == pytest.approx(0.4)
    assert measured({}, TWO, (steps,))[0][2] == 1.0
    over = measured({"friction": 1.25}, TWO, (FRICTION, steps))
    assert [each[2] for each in over] == [pytest.approx(1.0), 0.0]


def test_where_there_is_nothing_to_measure(measured):
    assert measured({}, TWO) == []
    assert measured({"friction": 0.5}, TWO, outside="too long") == []
    assert measured({"friction": 0.5}, TWO, com_range="somewhere") == []
    assert measured({"friction": 0.5}, None) == []
    assert measured({"friction": 0.5}, (0.1, 0.1)) == []
    assert len(measured({"friction": 0.5}, TWO)) == 1
