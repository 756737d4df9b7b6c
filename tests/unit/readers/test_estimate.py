"""Estimates of flights: what follows from nosings with a doubt, by hand and by draws."""

import dataclasses
import math

import numpy as np
import pytest

import kaidan
from kaidan.errors import InputError
from kaidan.readers.estimate import LandingEstimate, Refusal, StairsEstimate
from kaidan.readers.flight import FlightEstimate, independent
from kaidan.readers.kinds import Provenance
from kaidan.readers.regular_flight import chi2_tail
from kaidan.readers.sentences.refusals import REFUSALS
from kaidan.text.japanese import japanese
from kaidan.verbs.read_stairs import staircase_read

HERE = Provenance(path="here", digest="", form="by hand")


def flight(
    rises=(0.18,) * 6, going=0.28, heading=0.0, sigma=(0.002, 0.001), gravity=0.0, scale=0.0, **more
):
    """Flight of known steps, one metre wide, whose first nosing is at the origin of the plan."""
    m = len(rises)
    s, z = np.arange(m) * going, np.cumsum(rises)
    ahead = np.array([math.cos(heading), math.sin(heading)])
    left = np.array([-ahead[1], ahead[0]])
    at = s[:, None] * ahead
    return FlightEstimate(
        left=np.column_stack([at + 0.5 * left, z]),
        right=np.column_stack([at - 0.5 * left, z]),
        heading=heading,
        covariance=independent(np.tile(np.diag(np.square(sigma)), (m, 1, 1))),
        gravity=gravity,
        scale=scale,
        **{"floor": 0.0, **more},
    )


@pytest.mark.parametrize("heading", [0.0, 0.7, -2.5])
def test_the_line_of_nosings_lies_along_the_heading(heading):
    line = flight(heading=heading).line()
    assert line == pytest.approx(np.column_stack([np.arange(6) * 0.28, np.arange(1, 7) * 0.18]))


def test_two_tracks_see_two_lines():
    """A nosing that climbs 20 mm to the left over 1 m is 4 mm higher 0.2 m to the left."""
    one = flight()
    one.left[:, 2] += 0.01
    one.right[:, 2] -= 0.01
    assert one.line(0.2)[:, 1] - one.line()[:, 1] == pytest.approx(np.full(6, 0.004))


def test_regular_flight_by_hand():
    """Slope of a straight line: variance sigma^2 / sum (i - mean)^2, 17.5 for six nosings.

    The last level, which may be another one by 20 mm, has 1/401 of the weight of the five others,
    whose sum is 10: it leaves them 0.2 %.
    """
    found = flight().regular
    assert (found.rise, found.going, found.freedom) == (
        pytest.approx(0.18), pytest.approx(0.28), 8
    )  # fmt: skip
    assert found.rise_sigma == pytest.approx(0.001 / math.sqrt(10.0), rel=0.003)
    assert found.going_sigma == pytest.approx(0.002 / math.sqrt(17.5), rel=1e-6)
    assert found.chi2 == pytest.approx(0.0, abs=1e-9)
    angle = math.hypot(0.28 * found.rise_sigma, 0.18 * found.going_sigma) / found.spacing**2
    assert found.sigmas()[0] == pytest.approx(angle, rel=1e-9)


def test_one_odd_riser_is_no_regular_flight():
    """20 mm more in the middle with 1 mm of doubt: the list of steps, not the mean."""
    odd = flight(rises=(0.18, 0.18, 0.20, 0.18, 0.18, 0.18))
    assert odd.regular.alike < 1e-6
    assert odd.stairs().rises == pytest.approx((0.18, 0.18, 0.20, 0.18, 0.18, 0.18))
    assert flight().stairs().rise == pytest.approx(0.18)


def test_first_riser_stands_apart_and_is_assumed_where_no_floor_was_seen():
    low = flight(rises=(0.15, 0.18, 0.18, 0.18))
    assert low.stairs().first_rise == pytest.approx(0.15)
    blind = flight(rises=(0.15, 0.18, 0.18, 0.18), floor=math.nan)
    assert blind.stairs().first_rise is None
    assert blind.line()[0, 1] == pytest.approx(0.18)


@pytest.mark.parametrize("last", [0.15, 0.18, 0.185, 0.20, 0.215])
def test_a_last_riser_is_stated_as_measured_with_its_doubt(last):
    """By hand: a line through five nosings, 1 mm each, is known to sqrt(1.1) mm at the next.

    What is measured of the last one, to 6 mm, and last rises in general, 20 mm about the others,
    count by their variances.
    """
    own = np.r_[np.full(5, 0.001), 0.006]
    each = np.array([np.diag([0.002**2, one**2]) for one in own])
    found = dataclasses.replace(flight(rises=(*(0.18,) * 5, last)), covariance=independent(each))
    assert found.regular.alike > 0.01
    sheet = found.stairs()
    measured = math.hypot(0.006, 0.001 * math.sqrt(1.1))
    share = 0.02**2 / (0.02**2 + measured**2)
    assert sheet.rise == pytest.approx(0.18, abs=1e-4)
    assert sheet.last_rise == pytest.approx(0.18 + share * (last - 0.18), abs=1e-4)
    assert sheet.uncertainty.last_rise == pytest.approx(measured * math.sqrt(share), rel=1e-3)
    assert sheet.uncertainty.rise < 0.003
    assert sheet.uncertainty.first_rise == pytest.approx(0.001)


def test_steps_that_differ_have_the_doubt_of_the_last_rise_as_measured():
    """By hand: 1 mm of the level before it, 6 mm of its own."""
    own = np.r_[np.full(5, 0.001), 0.006]
    each = np.array([np.diag([0.002**2, one**2]) for one in own])
    odd = flight(rises=(0.18, 0.18, 0.2, 0.18, 0.18, 0.19))
    sheet = dataclasses.replace(odd, covariance=independent(each)).stairs()
    assert sheet.rises[-1] == pytest.approx(0.19)
    assert sheet.uncertainty.last_rise == pytest.approx(math.hypot(0.001, 0.006))


def test_neighbours_that_err_alike_know_their_distance_better():
    """By hand: 3 mm each with a correlation of 0.8 leave sqrt(2 * 0.2) * 3 mm of a going."""
    alike = flight()
    m = len(alike)
    covariance = np.zeros((m, 2, m, 2))
    covariance[:, 0, :, 0] = 9e-6 * np.where(np.eye(m) > 0, 1.0, 0.8)
    covariance[:, 1, :, 1] = 1e-6 * np.eye(m)
    found = dataclasses.replace(alike, covariance=covariance)
    going, rise = found.doubt_of_a_step()
    assert going == pytest.approx(3e-3 * math.sqrt(0.4))
    assert rise == pytest.approx(1e-3 * math.sqrt(2.0))
    # what all have in common, 0.8 of the variance, leaves the slope of the line as it is
    assert found.regular.going_sigma == pytest.approx(math.sqrt(0.2 * 9e-6 / 17.5), rel=1e-6)


def test_gravity_and_scale_do_not_average_out():
    """However many nosings: 1 deg of gravity is 1 deg of slope, 1 % of scale 1 % of spacing."""
    many = flight(rises=(0.18,) * 40, gravity=math.radians(1.0), scale=0.01)
    assert many.angle_sigma == pytest.approx(math.radians(1.0), rel=1e-3)
    assert many.spacing_sigma == pytest.approx(0.01 * many.regular.spacing, rel=1e-3)
    sheet = many.stairs().uncertainty
    assert (sheet.angle, sheet.nosing_spacing) == (many.angle_sigma, many.spacing_sigma)


def test_draws_have_the_covariance_and_profiles_carry_it():
    doubtful = flight(
        gravity=0.01, scale=0.005, floor_sigma=0.002, step_spread=0.003, sigma=(0.004, 0.002)
    )
    drawn = doubtful.draws(20_000, seed=1).reshape(20_000, -1)
    covariance = doubtful.full_covariance()
    sigmas = np.sqrt(np.diag(covariance))
    # sample covariances of 20,000 draws scatter by 1 % of the variances
    assert np.abs(np.cov(drawn.T) - covariance).max() < 0.05 * sigmas.max() ** 2
    assert np.abs(drawn.mean(axis=0) - doubtful.line().ravel()).max() < 0.05 * sigmas.max()
    profile = doubtful.profile()
    assert profile.covariance == pytest.approx(covariance)
    assert profile.nosings == pytest.approx(doubtful.line())
    assert profile.points[0] == pytest.approx([-2.0, 0.0])
    assert len(doubtful.draws(3)) == len(flight(sigma=(0.0, 0.0)).draws(3)) == 3


def test_one_odd_riser_does_not_turn_what_errs_alike():
    """Goings of 280 mm, a riser 30 mm lower; s and z of neighbours err alike, as in clouds.

    By weights of the range alone it would turn the line.
    """
    odd = flight(rises=(0.15, 0.12, 0.15, 0.15))
    number = np.arange(8)
    alike = (-0.9) ** np.abs(number[:, None] - number) * 4e-6 + 1e-8 * np.eye(8)
    regular = dataclasses.replace(odd, covariance=alike.reshape(4, 2, 4, 2)).regular
    assert regular.alike < 1e-6
    assert regular.going == pytest.approx(0.28, abs=0.002)
    assert regular.rise == pytest.approx(0.14, abs=0.003)  # by hand: 0.141 by plain least squares


def test_a_floor_that_errs_as_the_first_nosing_leaves_its_riser_known():
    """By hand: 2 mm each, 3e-6 m^2 in common: 4e-6 + 4e-6 - 2 * 3e-6 for the first riser."""
    apart = flight(sigma=(0.001, 0.002), floor_sigma=0.002)
    m = len(apart)
    with_floor = np.zeros((m, 2))
    with_floor[0] = [1e-6, 3e-6]
    alike = dataclasses.replace(apart, with_floor=with_floor)
    for each, first in ((apart, 8e-6), (alike, 2e-6)):
        covariance = each.full_covariance()
        assert covariance[1, 1] == pytest.approx(first)
        assert covariance[3, 3] == pytest.approx(8e-6)
    assert alike.full_covariance()[0, 1] == pytest.approx(-1e-6)
    assert alike.full_covariance()[1, 3] == pytest.approx(4e-6 - 3e-6)


def test_a_staircase_has_one_landing_more_than_flights():
    two = (flight(), flight())
    landings = (LandingEstimate(), LandingEstimate(depth=1.2, turn=math.pi), LandingEstimate())
    stairs = StairsEstimate(two, landings, HERE, name="west").stairs()
    assert [each.name for each in stairs] == ["west-1", "west-2"]
    assert stairs[0].upper_landing == stairs[1].lower_landing == 1.2
    with pytest.raises(InputError, match="2 flights need 3 landings, not 1"):
        StairsEstimate(two, landings[:1], HERE)


@pytest.mark.parametrize(
    ("degrees", "turn"),
    [
        (10, "none"), (20, "unknown"), (-45, "unknown"), (84, "unknown"), (-87, "quarter"),
        (94, "quarter"), (135, "unknown"), (-174, "unknown"), (177, "half"),
    ],
)  # fmt: skip
def test_a_turn_by_another_angle_is_no_quarter_and_no_half(degrees, turn):
    """Nobody knows whether the robot turns there: no GO."""
    landing = LandingEstimate(depth=4.0, width=4.0, turn=math.radians(degrees))
    two = (flight(width=2.0, rises=(0.1,) * 6), flight(width=2.0, rises=(0.1,) * 6))
    sheets = StairsEstimate(two, (LandingEstimate(), landing, LandingEstimate()), HERE).stairs()
    assert sheets[0].upper_turn == turn
    answer = kaidan.assess("ozbot-atr", sheets, friction=2.0, theta_d=0.0, theta_M=0.0)
    if turn != "unknown":
        assert "turning" not in answer.doubts
        return
    assert (answer.verdict, answer.governs) == ("unsure", "turning")
    assert answer.turns[0].turn_deg is None
    assert answer.reason == (
        "Whether it can turn on the landing above stairs-1 is not known: its angle or sizes are "
        "not stated."
    )
    assert japanese(answer.reason) is not None
    said = f"the way turns by {abs(degrees)} deg, which is not judged: sheets know turns of 90 and"
    assert said in sheets[0].notes
    assert japanese(sheets[0].notes) is not None


@pytest.mark.parametrize(
    ("seen", "why"),
    [
        ({"depth": 1.2}, "upper_turn = half needs upper_landing_width too"),
        ({"width": 2.4}, "upper_turn = half needs upper_landing too"),
        (
            {"depth": 1.2, "width": 1.5},
            "upper_landing_width = 1.5 m, but the flight and what lies beside it are 2 m wide",
        ),
    ],
)
def test_a_turn_that_contradicts_the_flights_is_said_where_it_is_not_judged(seen, why):
    landings = (LandingEstimate(), LandingEstimate(**seen, turn=-math.pi), LandingEstimate())
    two = (flight(width=1.0), flight(width=1.0))
    lower, upper = StairsEstimate(two, landings, HERE, name="west").stairs()
    said = (
        f"On the landing above west-1 the way turns by 180 deg, which is not judged: {why}. "
        "Measure that landing."
    )
    assert (lower.upper_turn, lower.notes, upper.notes) == ("unknown", said, "")
    assert japanese(said) is not None
    assert said in kaidan.assess("absolem", [lower, upper], friction=1.0).notes
    read = staircase_read(StairsEstimate(two, landings, HERE, name="west"), None)
    assert read.flights[0].notes == (said,)


def test_chi2_of_the_tables():
    """Abramowitz & Stegun, Table 26.8: 18.307 at 10 degrees of freedom and 5 %."""
    assert chi2_tail(18.307, 10) == pytest.approx(0.05, abs=1e-5)
    assert math.isnan(chi2_tail(1.0, 0))
    assert chi2_tail(1e6, 10) == 0.0


def test_every_refusal_is_one_sentence():
    numbers = dict.fromkeys(
        ("angle_deg", "residual_mm", "turn_deg", "height_mm", "steps", "needed", "spread_mm",
         "range_m", "cell_mm", "ways", "links", "names", "mass_kg", "height_m", "rise_mm",
             "reason", "count", "low_m", "high_m", "radius_mm", "gap_mm"), 1
    )  # fmt: skip
    for why in REFUSALS:
        said = str(Refusal(why, numbers, HERE))
        assert said.endswith(".")
        assert "{" not in said
