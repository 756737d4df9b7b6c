"""The region of the yielding track: emulator, likelihood, posterior, on figures made up by hand."""

import math

import jsonschema
import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("sklearn")
pytest.importorskip("emcee")

from amounts import fast_and_slow
from kaidan.errors import InputError
from kaidan.lab.calibration import design, emulator, posterior, yielding
from kaidan.lab.calibration.bench import Bench, Count
from kaidan.lab.calibration.evidence import PAPER
from kaidan.lab.calibration.region_figure import region_figure
from kaidan.robot import Robot

KENAF = Robot.named("kenaf")


def made_up(shares, ground):
    """Figures of a track whose margin falls with the first parameter, theta_d too."""
    x = shares[0]
    extra = 6.0 * (1.0 - x)
    return design.Point(
        tuple(shares), ground, (50.0 + 14.0 * x, extra, 46.0, 1.0 + x, 37.0, 53.0 + 14.0 * x)
    )


def points(count, ground="steps"):
    return [made_up(shares.tolist(), ground) for shares in design.shares_of(count, 1)]


def test_design_spans_its_ranges_evenly():
    shares = design.shares_of(64, 0)
    assert shares.shape == (64, len(design.AXES))
    # one of 64 in each 64th: what Sobol's points are for
    assert sorted((64 * shares[:, 0]).astype(int)) == list(range(64))
    k, ratio, *_ = design.AXES
    assert (k.value(0.0), k.value(1.0)) == pytest.approx((k.low, k.high))
    assert ratio.value(0.5) == pytest.approx(math.sqrt(ratio.low * ratio.high))


def test_no_slope_is_tried_at_which_a_belt_slides():
    setting = design.setting_of(KENAF, [0.5, 0.5, 0.5, 0.0, 0.5], "steps")
    limit = math.degrees(math.atan(setting.friction))
    for conditions in design.series_of(PAPER, setting).values():
        assert all(math.degrees(each.angle) < limit for each in conditions)


def test_figures_of_a_point():
    falls_from = {"up": 56.5, "down": 60.5}

    def runner(specs):
        found = []
        for spec in specs:
            slope = abs(math.degrees(spec.question.terrain.angle))
            fell = slope > falls_from[spec.question.direction]
            found.append(("fell_backward" if fell else "climbed", 60.0 if fell else 1.5, 2))
        return found

    (point,) = design.points_of(
        Bench(runner, trials=2), PAPER, KENAF, [([0.5, 0.5, 0.5, 1.0, 0.5], "steps")]
    )
    # slopes of 2 deg: 56 holds, 58 is lost; theta_d at 56.8 is that of a fall
    assert point.figures == pytest.approx((57.0, 15.0, 57.0, 1.5, 57.0, 61.0))


def test_emulator_follows_and_says_how_well():
    found = emulator.emulator_of(points(40))
    shares = design.shares_of(8, 5)
    mean, deviation = found.predict(shares, "margin_150")
    # 0.2 deg: a plane through forty points without scatter
    assert mean == pytest.approx(50.0 + 14.0 * shares[:, 0], abs=0.2)
    assert (deviation < 0.5).all()
    assert all(0.8 <= each <= 1.0 for each in found.coverage)
    with pytest.raises(InputError) as caught:
        emulator.emulator_of(points(20))
    assert str(caught.value) == (
        "--points: 20 of one ground are too few for an emulator; at least 30"
    )


def test_likelihood_by_hand():
    none = np.array([1e-9])
    value = emulator.to_scale("theta_d", np.array([2.6]))

    def likelihood(margin, extra=value):
        return posterior.log_likelihood(PAPER, np.array([margin]), none, extra, none)[0]

    # a margin in the zone is likelier than one at 60 deg, by far
    assert likelihood(55.8) > likelihood(57.5) > likelihood(60.0)
    assert likelihood(55.8) > likelihood(53.0)
    # at 55.5 deg, scatter 0.5: none of five at 54, all at 57: both at three deviations
    stands, low = 0.99865**5 * 0.99865**5, 1 - 0.84134**5
    rest = -0.5 * math.log((0.3 / 2.9) ** 2)
    assert likelihood(55.5) == pytest.approx(math.log(stands * low) + rest, abs=1e-3)
    assert likelihood(55.5, value + 0.5) < likelihood(55.5)


@pytest.mark.parametrize(("points", "steps"), fast_and_slow((60, 150), (80, 300)))
def test_known_parameters_are_found_and_the_rest_is_left_open(points, steps, monkeypatch):
    # the zone goes with a share of 0.29 to 0.50, theta_d with 0.47 to 0.67; nothing else does
    monkeypatch.setattr(yielding, "points_of", lambda *a: [made_up(list(s), g) for s, g in a[3]])
    bench = Bench(lambda specs: pytest.fail("no trial"), seed=0, trials=2)
    found = yielding.calibrate_yielding(bench, KENAF, points=points, steps=steps)
    first, *others = found.parameters
    low, high = (first.interval.low, first.interval.high)
    axis = design.AXES[0]
    assert axis.value(0.29) < low < high < axis.value(0.67)
    assert first.identified
    assert not any(each.identified for each in others)
    by_name = {each.name: each for each in found.predictions}
    # by hand: descent less ascent is 3 deg everywhere
    assert by_name["theta_M"].interval.median == pytest.approx(3.0, abs=0.2)
    assert by_name["theta_M"].probability < 0.05
    again = type(found).from_json(found.to_json())
    assert again == found
    jsonschema.validate(found.to_dict(), type(found).json_schema())
    assert "no: " in str(found)
    region_figure(found).canvas.draw()


def test_lost_is_who_hops_back_too():
    assert Count(trials=2, falls=0, extras=(1.0, 2.0), slid=2).lost == 1.0
