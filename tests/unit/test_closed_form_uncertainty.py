"""Uncertain inputs: quantiles, probabilities, the accepted risk."""

from math import atan, cos, degrees, radians, sin, tan
from statistics import NormalDist

import numpy as np
import pytest

from closed_form_cases import (
    ANGLE,
    BARE,
    C_L,
    C_N,
    GRIP,
    SPREAD,
    G,
    L,
    assess,
    doubtful,
    flight,
    kenaf,
)
from kaidan import Surface
from kaidan.terrain.stairs_uncertainty import StairsUncertainty


def test_the_margin_at_the_chosen_risk():
    # hand: one uncertain figure, so the quantile of the margin is the margin of the quantile; of
    # 2048 strata a share `risk` may fail, and the next one's middle counts
    for risk in (0.01, 0.1, 0.5):
        z = -NormalDist().inv_cdf((int(risk * 2048) + 0.5) / 2048)
        answer = assess(
            doubtful(com_from_front=0.005), flight(50, 0.150), friction=GRIP, risk=risk, **BARE
        )
        expected = degrees(atan((L - 0.150 - C_L - z * 0.005) / C_N)) - 50
        assert answer.margin_deg == pytest.approx(expected, **ANGLE)
        assert answer.question.risk == risk
        # the safe band likewise, the bare one with the sheet's figures
        theta = radians(50)
        safe = G * ((L - 0.150 - C_L - z * 0.005) / C_N * cos(theta) - sin(theta))
        found = answer.closed_form
        assert found.a_max_safe == pytest.approx(safe, rel=1e-12)
        assert found.a_max == pytest.approx(G * (124 / 71 * cos(theta) - sin(theta)), rel=1e-12)
        shift = 1e3 * (L - 0.150 - C_L - z * 0.005 - C_N * tan(theta))
        assert found.margin_centroid_mm == pytest.approx(shift, rel=1e-9)
    # 95 % interval: +-1.96 sigma
    low, high = answer.margin_interval_deg
    for value, z in ((low, 1.96), (high, -1.96)):
        expected = degrees(atan((L - 0.150 - C_L - z * 0.005) / C_N)) - 50
        assert value == pytest.approx(expected, abs=0.02)  # strata of 1/2048


def test_the_verdict_takes_the_risk():
    # P(fail) at 59 deg: sigma 5 mm, 3.4 deg of 0.3 deg/mm: about 15 %
    for risk, verdict in ((0.01, "no-go"), (0.1, "no-go"), (0.3, "go")):
        answer = assess(
            doubtful(com_from_front=0.005), flight(59, 0.150), friction=GRIP, risk=risk, **BARE
        )
        assert answer.verdict == verdict
        assert (answer.margin_deg > 0) == (answer.failure_probability <= risk)


def monte_carlo(angle, p, mu, *, d_theta, d_p, d_mu, tilt_d, tilt_M, count=400_000):
    """Oracle: failure modes by plain random numbers and the limits written out again."""
    draw = np.random.default_rng(99)

    def normal(mean, sigma):
        return mean + sigma * draw.standard_normal(count)

    length, from_front = normal(L, SPREAD["flat_length"]), normal(C_L, SPREAD["com_from_front"])
    height = normal(C_N, SPREAD["com_height"])
    theta, spacing, grip = normal(radians(angle), d_theta), normal(p, d_p), normal(mu, d_mu)
    fails = {
        "tip_downhill": np.arctan2(length - spacing - from_front, height) - tilt_d - tilt_M - theta,
        "tip_uphill": theta - np.arctan2(spacing - from_front, height) - tilt_d,
        "slides_down": np.arctan(grip) - theta,
        "slides_up": theta + np.arctan(grip),
    }
    chances = {name: float(np.mean(margin <= 0)) for name, margin in fails.items()}
    chances["any"] = float(np.mean(np.minimum.reduce(list(fails.values())) <= 0))
    return chances


@pytest.mark.parametrize(
    ("angle", "p", "mu"), [(55, 0.150, 1.5), (40, 0.180, 0.88), (20, 0.220, 1.0), (25, 0.2, 1.0)]
)
def test_probabilities_against_monte_carlo(angle, p, mu):
    # oracle; stratified samples of 2048 err by less than 1/sqrt(2048) = 0.022 a tail, mostly by
    # far less: 0.015 holds for all four
    expected = monte_carlo(
        angle, p, mu, d_theta=0.01, d_p=0.001, d_mu=0.03, tilt_d=radians(2.6), tilt_M=radians(2.6)
    )
    stairs = flight(angle, p).model_copy(
        update={"uncertainty": StairsUncertainty(angle=0.01, nosing_spacing=0.001)}
    )
    answer = assess(doubtful(**SPREAD), stairs, surface=Surface.of_friction(mu, 0.03))
    assert answer.failure_probability == pytest.approx(expected.pop("any"), abs=0.015)
    for name, chance in expected.items():
        assert answer.findings[name].probability == pytest.approx(chance, abs=0.015), name
    assert answer.findings["drive"].probability is None


def test_what_fails_only_together_is_said_so():
    # hand: z = 2.41, so it tips with 0.8 % and slips with 0.8 %, of other samples: 1.6 % together
    tangent = (L - 0.150 - C_L - 2.41 * 0.005) / C_N
    ground = Surface.of_friction(tangent + 2.41 * 0.05, 0.05)
    stairs = flight(degrees(atan(tangent)), 0.150)
    answer = assess(doubtful(com_from_front=0.005), stairs, surface=ground, **BARE)
    assert answer.verdict == "no-go"
    assert [each.holds for each in answer.findings.values()] == [True, True, True, True, None]
    assert set(answer.doubts) == {"tip_downhill", "slides_down"}
    assert answer.reason.startswith(
        "With a probability of 0.016, more than the accepted 0.01, it fails in one way or "
        "another; nearest is "
    )
    assert not any("Friction decides" in note for note in answer.notes)


def test_a_small_risk_takes_more_samples():
    # hand: one uncertain figure: P(fail) = Phi(-z), z = 3.45 -> 2.8e-4: too much for 1e-4
    z = 3.45
    angle = degrees(atan((L - 0.150 - C_L - z * 0.005) / C_N))
    doubt = doubtful(com_from_front=0.005)
    question = {"friction": GRIP, **BARE}
    assert assess(doubt, flight(angle, 0.150), risk=1e-4, **question).verdict == "no-go"
    assert assess(doubt, flight(angle, 0.150), risk=1e-3, **question).verdict == "go"
    found = assess(doubt, flight(angle, 0.150), risk=1e-4, **question)
    assert found.failure_probability == pytest.approx(2.8e-4, abs=2e-5)


def test_the_same_question_has_the_same_answer():
    asked = {"surface": Surface.of_friction(1.0, 0.1), "risk": 0.02}
    first = assess(doubtful(**SPREAD), flight(40, 0.150), **asked)
    assert first.to_json() == assess(doubtful(**SPREAD), flight(40, 0.150), **asked).to_json()


def test_no_probability_where_all_is_certain():
    answer = kenaf(40, 0.150)
    assert answer.failure_probability is answer.margin_interval_deg is None
    assert {each.probability for each in answer.findings.values()} == {None}


def test_probably_outside_the_model():
    # hand: 233 of 470 / 2 = 235 mm, sigma 3 mm of spacing: 25 % are beyond
    stairs = flight(30, 0.233).model_copy(
        update={"uncertainty": StairsUncertainty(nosing_spacing=0.003)}
    )
    answer = assess("kenaf", stairs, friction=GRIP)
    assert answer.verdict == "outside-model"
    assert answer.reason == (
        "The closed form has no answer: the nosing spacing of 233 mm is more than half the flat "
        "length of 470 mm (p > L/2) with a probability of 0.25, more than the accepted 0.01."
    )
    surely = assess(doubtful(com_from_front=0.005), "ibc")
    assert "probability" not in surely.reason
    assert surely.failure_probability is surely.margin_interval_deg is None
