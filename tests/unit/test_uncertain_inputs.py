"""Samples of the uncertain inputs, and how far they carry the margins, by hand."""

import math
from dataclasses import replace
from statistics import NormalDist
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Profile, Question, Robot, Stairs, Surface
from kaidan.models import samples
from kaidan.models.quasi_static import traverse_of
from kaidan.models.samples import draws, nominal, sample_count, unit_draws
from kaidan.models.spread import changed_nosings, moved_profile, nosings_of, spread
from kaidan.modes import Phase
from kaidan.traversal.drawn_criterion import Drawn

L, C_L, C_N = 0.470, 0.196, 0.071
THETA, P, MU = math.radians(40), 0.150, 1.0
SIGMA = [0.004, 0.005, 0.003, 0.01, 0.002, 0.1]
"""Of L, C_L, C_N, angle, spacing, friction."""
KENAF = Robot.named("kenaf").model_dump()


def asked(sigma=SIGMA, **manner):
    robot = KENAF | {"uncertainty": dict(zip(
        ("flat_length", "com_from_front", "com_height"), sigma[:3], strict=True
    ))}  # fmt: skip
    flight = Stairs.inclined(angle=THETA, nosing_spacing=P).model_dump()
    flight |= {"uncertainty": {"angle": sigma[3], "nosing_spacing": sigma[4]}}
    return Question.in_one_posture(
        Robot.model_validate(robot),
        Stairs.model_validate(flight),
        surface=Surface.of_friction(MU, sigma[5]),
        **manner,
    )


def drawn(question):
    """Draws of a flight of one kind of step, each as a row, and the unit draws."""
    (found,) = draws(question, nominal(question, question.flight))
    return {name: getattr(found, name)[:, 0] for name in found._fields}, unit_draws(2048)


def test_unit_draws_are_a_latin_hypercube_of_normals():
    found = unit_draws(500)
    strata = [NormalDist().inv_cdf((k + 0.5) / 500) for k in range(500)]
    assert found.shape == (6, 500)
    for row in found:
        assert sorted(row) == pytest.approx(strata, abs=1e-12)
    correlation = np.corrcoef(found) - np.eye(6)
    assert np.abs(correlation).max() < 0.15  # 3 / sqrt(500)


@pytest.mark.parametrize(
    ("risk", "count"), [(0.5, 2048), (0.01, 2048), (0.001, 10_000), (0.0003, 33_334)]
)
def test_a_small_risk_takes_more_samples(risk, count):
    """Ten beyond it at least."""
    assert sample_count(asked(risk=risk)) == count


@pytest.mark.parametrize("nose_up", [True, False])
def test_draws_by_hand(nose_up):
    """The centroid is measured from the nose, the formulas take it from the uphill end."""
    question = asked(direction="up" if nose_up else "down")
    assert question.nose_up is nose_up
    found, unit = drawn(question)
    d = unit * np.array(SIGMA)[:, None]
    expected = {
        "L": L + d[0],
        "C_L": C_L + d[1] if nose_up else (L + d[0]) - (C_L + d[1]),
        "C_N": C_N + d[2],
        "theta_s": THETA + d[3],
        "p": P + d[4],
        "mu_low": MU + d[5],
        "mu_high": MU + d[5],
    }
    for name, values in expected.items():
        np.testing.assert_allclose(found[name], values, atol=1e-12, err_msg=name)


def test_no_sample_leaves_what_has_a_meaning():
    """Ranges so wide that some draws would be negative, or overhang."""
    found, _ = drawn(asked([0.004, 0.005, 0.05, 0.34, 0.1, 0.5]))
    assert found["C_N"].min() == 1e-4
    assert (found["theta_s"].min(), found["theta_s"].max()) == (0.0, 1.57)
    assert found["p"].min() == 1e-3
    assert found["mu_low"].min() == found["mu_high"].min() == 0.0


def test_steps_that_count():
    """Rise and going; out is what another outdoes in length and steepness, and one in gentleness.

    (0.15, 0.25) is shorter and gentler than (0.2, 0.3), shorter and steeper than (0.1, 0.3);
    (0.1, 0.16) likewise.
    """
    kept = [(0.2, 0.3), (0.1, 0.3), (0.15, 0.3)]
    theta, p = samples._decisive([*kept, (0.15, 0.25), (0.1, 0.16)])
    assert sorted(zip(theta, p, strict=True)) == sorted(
        (math.atan2(*each), math.hypot(*each)) for each in kept
    )
    # as steep as one another: the longest
    assert samples._decisive([(3, 4), (6, 8)])[1].tolist() == [10.0]
    # as long as one another: the steepest and the gentlest
    theta, _ = samples._decisive([(33, 56), (16, 63), (39, 52)])
    assert sorted(theta) == [math.atan2(16, 63), math.atan2(39, 52)]
    theta, p = samples._decisive([(0.3, 0.4)])
    assert (theta.tolist(), p.tolist()) == ([math.atan2(0.3, 0.4)], [0.5])


def margins(d, nose_up):
    """Margins downhill and uphill of the closed form, the figures changed by so much."""
    length, com = L + d[0], C_L + d[1]
    uphill = com if nose_up else length - com
    theta, p = THETA + d[3], P + d[4]
    down = np.arctan2(length - p - uphill, C_N + d[2]) - theta
    return down, theta - np.arctan2(p - uphill, C_N + d[2])


@pytest.mark.parametrize("nose_up", [True, False])
def test_spread_of_a_flight_is_the_closed_forms(nose_up):
    question = asked(direction="up" if nose_up else "down")
    found = spread(question, traverse_of(question))
    d = unit_draws(2048) * np.array(SIGMA)[:, None]
    for values, sample, sheet in zip(
        (found.tip_downhill, found.tip_uphill),
        margins(d, nose_up),
        margins(np.zeros(5), nose_up),
        strict=True,
    ):
        np.testing.assert_allclose(values, sample - sheet, atol=1e-12)
    np.testing.assert_allclose(found.angle, d[3], atol=1e-15)
    np.testing.assert_allclose(found.friction, d[5], atol=1e-15)
    assert [each.tolist() for each in (found.rocking, found.rise, found.landing_rise)] == [
        [0.0]
    ] * 3


def test_spread_of_steps_of_many_kinds_takes_the_worst_step(monkeypatch):
    """Two flights in one question, judged at once or step by step."""
    steep, long = (
        Stairs.inclined(angle=math.radians(angle), nosing_spacing=p)
        for angle, p in ((45, 0.13), (35, 0.17))
    )
    robot = Robot.model_validate(KENAF | {"uncertainty": {"com_from_front": 0.005}})
    question = Question.in_one_posture(robot, steep, friction=1.0)
    traverse = traverse_of(question)
    both = samples.Draws(
        **{name: np.full((1, 1), v) for name, v in (
            ("L", L), ("C_L", C_L), ("C_N", C_N), ("mu_low", 1.0), ("mu_high", 1.0)
        )},
        theta_s=np.array([[steep.angle, long.angle]]),
        p=np.array([[0.13, 0.17]]),
    )  # fmt: skip
    monkeypatch.setattr("kaidan.models.spread.nominal", lambda *_: both)
    at_once = spread(question, traverse)
    monkeypatch.setattr(samples, "BLOCK", 2048)
    one_by_one = spread(question, traverse)
    com = C_L + unit_draws(2048)[1] * 0.005
    sides = []
    for c in (com, C_L):
        down = [np.arctan2(L - p - c, C_N) - math.radians(t) for t, p in ((45, 0.13), (35, 0.17))]
        up = [math.radians(t) - np.arctan2(p - c, C_N) for t, p in ((45, 0.13), (35, 0.17))]
        sides.append((np.minimum(*down), np.minimum(*up)))
    for found in (at_once, one_by_one):
        np.testing.assert_allclose(found.tip_downhill, sides[0][0] - sides[1][0], atol=1e-12)
        np.testing.assert_allclose(found.tip_uphill, sides[0][1] - sides[1][1], atol=1e-12)


@pytest.mark.parametrize("nose_up", [True, False])
def test_draws_of_steps_all_alike_are_the_closed_forms(nose_up):
    """The same flight as a list of its steps: the criterion is asked of each draw."""
    question = asked(direction="up" if nose_up else "down")
    steps = question.terrain.model_dump() | {"rise": None, "going": None}
    steps |= {"rises": question.terrain.step_rises, "goings": question.terrain.step_goings}
    listed = question.changed(terrain=Stairs.model_validate(steps))
    found, closed = (spread(each, traverse_of(each)) for each in (listed, question))
    assert found.over_landing is (Phase.LAND if nose_up else Phase.ENTER)
    assert len(found.rocking) == 2048
    for values, expected in zip(found[:2], closed[:2], strict=True):
        # rad: nosings summed up from steps, and functions of libm
        np.testing.assert_allclose(values, expected, atol=1e-9)
    np.testing.assert_allclose(found.inclination, closed.angle, atol=1e-9)
    np.testing.assert_allclose(found.rocking, 0.0, atol=1e-9)


def test_where_the_criterion_says_nothing_there_is_no_spread_of_it():
    """A kerb: no nosing is lost with the whole flat on a flight."""
    kerb = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])
    robot = Robot.model_validate(KENAF | {"uncertainty": {"com_from_front": 0.005}})
    question = Question.in_one_posture(robot, kerb, friction=1.0)
    found = spread(question, traverse_of(question))
    assert len(found.tip_downhill) == 2048
    assert not any(np.any(each) for each in found[:-1])


def test_spread_is_less_what_the_sheets_say_where_both_say_something(monkeypatch):
    drawn = Drawn(*([0.5, math.inf, 0.5, 0.25, 0.5, 0.5, 0.5, -math.inf] * np.ones((2048, 1))).T)
    nominal_ = Drawn(*np.array([[0.2], [0.1], [math.inf], [0.125], [0.2], [0.3], [0.3], [0.1]]))
    monkeypatch.setattr("kaidan.models.spread._by_draws", lambda *_: (drawn, nominal_))
    kerb = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])
    robot = Robot.model_validate(KENAF | {"uncertainty": {"com_from_front": 0.005}})
    question = Question.in_one_posture(robot, kerb, friction=1.0)
    for whole in (True, False):
        found = spread(question, SimpleNamespace(whole=whole))
        means = [np.mean(each) for each in found[:-1]]
        rises = [0.3, 0.2] if whole else [0.0, 0.0]
        # tips downhill, uphill, landing as downhill; rocking; rises; slope, inclinations, friction
        assert means == pytest.approx([0.3, 0.0, 0.3, 0.125, *rises, 0.0, 0.2, 0.0, 0.0])


def test_nosings_are_drawn_about_those_of_the_draw_of_the_whole():
    kerbs = [(-2, 0), (0, 0), (0, 0.1), (0.3, 0.1), (0.3, 0.2), (2, 0.2)]
    profile = Profile.of_points(kerbs)
    profile = replace(profile, covariance=np.diag([1e-4, 4e-4, 9e-4, 0.0]))
    single = profile.drawn_nosings(unit_draws(50, 10)[6:])
    np.testing.assert_array_equal(nosings_of(profile, np.zeros((6, 50))), single)


def test_one_nosing_takes_its_riser_along():
    kerb = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])
    moved = moved_profile(kerb, np.add(kerb.nosings, [[0.01, 0.02]]))
    expected = [(-1.99, 0), (0.01, 0), (0.01, 0.12), (2.01, 0.12)]
    np.testing.assert_allclose(moved.points, expected, atol=1e-12)


def test_of_several_flights_the_largest_doubt_is_that_of_the_slope(monkeypatch):
    none = Drawn(*np.zeros((8, 1)))
    monkeypatch.setattr("kaidan.models.spread._by_draws", lambda *_: (none, none))
    flights = [
        Stairs(rise=0.15, going=0.3, steps=5, uncertainty={"angle": each})
        for each in (0.01, 0.02, 0.015)
    ]
    for some, doubt in ((flights, 0.02), (flights[:2], 0.02), (flights[0], 0.01)):
        question = Question.in_one_posture(Robot.named("kenaf"), some, friction=1.0)
        found = spread(question, SimpleNamespace(whole=True))
        np.testing.assert_allclose(found.angle, doubt * unit_draws(2048)[3], atol=1e-15)


def test_nosings_take_what_lies_between_along_by_its_place():
    profile = Profile.of_points([(-1, 0), (0, 0), (0, 0.3), (0.4, 0.3), (0.4, 0.5), (1, 0.5)])
    moved = moved_profile(profile, np.add(profile.nosings, [[0.01, 0.0], [0.03, 0.0]]))
    assert moved.points[:, 0] == pytest.approx([-0.99, 0.01, 0.01, 0.43, 0.43, 1.03])


def test_an_exact_question_has_one_sample():
    question = asked([0.0] * 6)
    found = spread(question, traverse_of(question))
    assert [each.tolist() for each in found[:-1]] == [[0.0]] * 10
    assert found.over_landing is Phase.LAND
    at = nominal(question, question.flight)
    assert all(each.shape == (1, 1) for each in at)
    assert list(draws(question, at)) == [at]


def test_changed_nosings_by_hand():
    """A step of 3 and 4: as it is, turned by a right angle, and of twice the length."""
    nosings = np.array([(1.0, 2.0), (4.0, 6.0), (7.0, 10.0)])
    angle, spacing = np.array([0.0, math.pi / 2, 0.0]), np.array([0.0, 0.0, 5.0])
    same, turned, longer = changed_nosings(nosings, angle=angle, spacing=spacing)
    np.testing.assert_allclose(same, nosings, atol=1e-12)
    np.testing.assert_allclose(turned, [(1, 2), (-3, 5), (-7, 8)], atol=1e-12)
    np.testing.assert_allclose(longer, [(1, 2), (7, 10), (13, 18)], atol=1e-12)


def test_rows_of_unit_draws_do_not_depend_on_their_number():
    np.testing.assert_array_equal(unit_draws(100, 9)[:6], unit_draws(100))


@pytest.mark.parametrize(("s_r", "s_g"), [(0.003, 0.0), (0.0, 0.004), (0.003, 0.004)])
def test_the_doubt_of_a_step_is_one_of_slope_and_spacing(s_r, s_g):
    """By hand, 3-4-5: along the slope s_r sin and s_g cos, beside what is stated of the whole."""
    stairs = Stairs(rise=0.15, going=0.2, steps=6)
    of_all = {"angle": 0.01, "nosing_spacing": 0.002, "rise": s_r, "going": s_g}
    doubtful = stairs.model_copy(
        update={"uncertainty": stairs.uncertainty.model_copy(update=of_all)}
    )
    question = Question.in_one_posture("kenaf", doubtful, friction=1.0)
    angle, spacing = samples._of_the_whole(question)[3:5]
    of_a_step = samples.local_angle_deviation(
        theta_s=math.atan2(0.15, 0.2), p=0.25, s_r=s_r, s_g=s_g
    )
    assert angle == pytest.approx(math.hypot(0.01, float(of_a_step)))
    assert spacing == pytest.approx(math.hypot(0.002, s_r * 0.6, s_g * 0.8))
    none = question.changed(terrain=stairs)
    assert samples._of_the_whole(none) == none.spread
