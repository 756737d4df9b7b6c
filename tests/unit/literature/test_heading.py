"""Heading after Martens & Newman 1994: from gravity, by the law, in the closed loop."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amounts import examples
from kaidan.errors import InputError
from kaidan.literature.heading import (
    difference_limit,
    heading_error,
    heading_noise,
    losing_yaw,
    slope_felt,
    specific_force,
    speed_difference,
)
from kaidan.literature.heading_loop import HeadingLoop, Outcome, heading_run, losing_start
from kaidan.mechanics.oblique import body_inclination, roll
from kaidan.mechanics.oblique_support import sideways_limit
from kaidan.robot import Drive, Robot, Track
from kaidan.terrain.stairs import Stairs

SLOPES = st.floats(0.05, 1.2)
YAWS = st.floats(-1.5, 1.5)
STAIRS = Stairs(rise=0.15, going=0.20)  # tan 0.75
ROUNDING = 1e-12  # angles of order one through sines and an arctangent


def toy(**changes):
    sheet = {
        "name": "toy",
        "com_from_front": 0.3,
        "com_height": 0.1,
        "track": Track(flat_length=0.6, gauge=0.4),
        "drive": Drive(max_speed=0.5),
    }
    return Robot(**(sheet | changes))


def loop(**changes):
    return HeadingLoop(**({"speed": 0.3} | changes))


# --- from gravity ------------------------------------------------------------------------------


def rotation(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return {
        "y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


@given(SLOPES, YAWS)
def test_specific_force_by_rotations(theta_s, psi):
    # oracle: turn a level body by psi within the plane, then tilt the plane nose up by theta_s
    axes = rotation("y", -theta_s) @ rotation("z", psi)  # columns: the body's axes in the world
    expected = axes.T @ np.array([0.0, 0.0, 9.80665])
    assert specific_force(theta_s=theta_s, psi=psi) == pytest.approx(expected, abs=ROUNDING)


@given(SLOPES, YAWS, st.floats(-3.0, 3.0))
def test_heading_and_slope_come_back(theta_s, psi, a):
    # property: the inverse, at any acceleration that is known
    f_x, f_y, f_z = specific_force(theta_s=theta_s, psi=psi, a=a)
    assert heading_error(f_x=f_x, f_y=f_y, a=a) == pytest.approx(psi, abs=1e-9)
    assert slope_felt(f_x=f_x, f_y=f_y, f_z=f_z, a=a) == pytest.approx(theta_s, abs=1e-9)


@given(SLOPES, YAWS)
def test_facing_down_the_signs_change(theta_s, psi):
    # property: at pi + psi, -f_x and -f_y give the yaw off the steepest descent
    f_x, f_y, _ = specific_force(theta_s=-theta_s, psi=psi)
    assert heading_error(f_x=-f_x, f_y=-f_y) == pytest.approx(psi, abs=1e-9)


def test_inclination_and_roll_are_those_of_the_oblique_approach():
    # agreement
    f_x, f_y, f_z = specific_force(theta_s=0.6, psi=0.4, g=1.0)
    assert math.asin(f_x) == pytest.approx(body_inclination(theta_s=0.6, psi=0.4))
    assert math.atan2(f_y, f_z) == pytest.approx(roll(theta_s=0.6, psi=0.4))


@given(st.floats(0.3, 1.0), st.floats(-1.0, 1.0), st.floats(-0.1, 0.3))
def test_a_body_inclined_further_keeps_the_sign(theta_s, psi, delta):
    # oracle: a third rotation, about the body's own lateral axis
    axes = rotation("y", -theta_s) @ rotation("z", psi) @ rotation("y", -delta)
    f_x, f_y, _ = axes.T @ np.array([0.0, 0.0, 9.80665])
    shown = math.tan(heading_error(f_x=f_x, f_y=f_y))
    factor = math.cos(delta) + math.sin(delta) / (math.tan(theta_s) * math.cos(psi))
    assert shown == pytest.approx(math.tan(psi) / factor, rel=1e-9, abs=1e-12)
    assert factor > 0
    assert shown * psi >= 0


def test_level_ground_says_nothing():
    assert math.isnan(heading_error(f_x=0.0, f_y=0.0))
    assert math.isnan(heading_error(f_x=0.5, f_y=0.0, a=0.5))
    assert slope_felt(f_x=0.0, f_y=0.0, f_z=9.8) == 0.0


def test_noise_of_the_heading():
    # oracle: a hundred thousand draws; the deviation of a deviation is 1 in sqrt(2 n)
    draw = np.random.default_rng(1994)
    f_x, f_y, _ = specific_force(theta_s=0.6, psi=0.5)
    found = heading_error(
        f_x=f_x + draw.normal(0, 0.1, 100_000), f_y=f_y + draw.normal(0, 0.1, 100_000)
    )
    assert np.std(found) == pytest.approx(heading_noise(sigma=0.1, theta_s=0.6), rel=0.01)


# --- the law -----------------------------------------------------------------------------------


def test_law_by_hand():
    # hand: -2 * 0.4 * 0.1; beyond the limit the limit
    assert speed_difference(psi=0.1, k=2.0, gauge=0.4, limit=1.0) == pytest.approx(-0.08)
    assert speed_difference(psi=1.0, k=2.0, gauge=0.4, limit=0.3) == -0.3
    assert speed_difference(psi=-1.0, k=2.0, gauge=0.4, limit=0.3) == 0.3
    assert difference_limit(v=-0.3, v_max=0.5) == pytest.approx(0.4)
    assert math.isnan(difference_limit(v=0.6, v_max=0.5))


def test_losing_yaw_by_hand():
    # hand: 0.4 / 0.4 = 1 rad/s against 2 sin(psi)
    at = {"grip": 1.0, "limit": 0.4, "gauge": 0.4}
    assert losing_yaw(divergence=2.0, **at) == pytest.approx(math.pi / 6, abs=1e-15)
    assert math.isnan(losing_yaw(divergence=0.9, **at))
    assert math.isnan(losing_yaw(divergence=0.0, **at))


# --- the closed loop ---------------------------------------------------------------------------


def test_it_dies_away_as_a_power():
    # hand: without saturation psi is multiplied by 1 - k period every period
    run = heading_run(toy(), STAIRS, loop(gain=2.0), start=0.3, duration=5.0)
    expected = 0.3 * (1 - 2.0 * 0.02) ** np.arange(len(run.t))
    assert run.heading == pytest.approx(expected, abs=1e-12)
    assert not run.saturated.any()
    assert run.outcome is Outcome.SETTLED
    # hand: 0.3 * 0.96^n < 2 degrees from n = 53 on
    assert run.settled_at == pytest.approx(53 * 0.02)


def test_the_way_across_by_hand():
    # hand: v times the integral of psi is v psi0 / k for small headings
    run = heading_run(toy(), STAIRS, loop(gain=1.0, period=1e-3), start=0.01, duration=15.0)
    assert run.across[-1] == pytest.approx(0.3 * 0.01 / 1.0, rel=1e-3)


def test_saturated_it_turns_at_the_drives_rate():
    # hand: 2 (0.5 - 0.3) / 0.4 = 1 rad/s, half of it with a grip of a half
    run = heading_run(toy(), STAIRS, loop(gain=50.0, grip=0.5), start=1.0, duration=1.0)
    assert run.saturated[:40].all()
    assert run.heading[:40] == pytest.approx(1.0 - 0.5 * run.t[:40], abs=1e-12)


def test_a_drift_leaves_an_offset():
    # hand: k psi = drift
    run = heading_run(
        toy(), STAIRS, loop(gain=2.0, drift=0.1), start=0.0, duration=15.0, tolerance=0.06
    )
    assert run.heading[-1] == pytest.approx(0.05, abs=1e-9)
    assert run.outcome is Outcome.SETTLED


@pytest.mark.parametrize(
    ("gain", "divergence", "filter_time", "stable"),
    [
        (2.0, 1.0, 0.0, True),
        (0.9, 1.0, 0.0, False),
        (2.0, 1.0, 0.7, True),
        (2.0, 1.0, 1.4, False),
        (8.0, 2.0, 0.3, True),
        (8.0, 2.0, 0.7, False),
    ],
)
def test_stability_is_that_of_the_characteristic_polynomial(gain, divergence, filter_time, stable):
    # oracle: T s^2 + (1 - divergence T) s + (k - divergence), Hurwitz
    assert stable == (gain > divergence and divergence * filter_time < 1)
    at = loop(gain=gain, divergence=divergence, filter_time=filter_time, period=0.005)
    run = heading_run(toy(), STAIRS, at, start=0.001, duration=15.0)
    assert (np.abs(run.heading[-200:]).max() < 0.001) == stable


def test_noise_leaves_what_theory_says():
    # oracle: the law's walk, x' = (1 - h (k - q)) x - h k n, has the variance
    # (h k s)^2 / (1 - (1 - h (k - q))^2), q the divergence
    k, q, h, sigma = 2.0, 0.5, 0.02, 0.3
    at = loop(gain=k, divergence=q, period=h, noise=sigma)
    run = heading_run(toy(), STAIRS, at, start=0.0, duration=600.0, seed=3)
    s = heading_noise(sigma=sigma, theta_s=STAIRS.angle)
    expected = h * k * s / math.sqrt(1 - (1 - h * (k - q)) ** 2)
    # 900 independent stretches of 1 / (k - q): 2.4 % of a deviation
    assert np.std(run.heading) == pytest.approx(expected, rel=0.08)
    # the part along the heading, of second order, biases little
    assert abs(run.heading.mean()) < 5 * expected / math.sqrt(450)


def test_it_converges_through_noise_and_replays():
    at = loop(gain=1.5, divergence=0.5, noise=0.5, filter_time=0.1)
    run = heading_run(toy(), STAIRS, at, start=0.5, seed=7, tolerance=0.1)
    again = heading_run(toy(), STAIRS, at, start=0.5, seed=7, tolerance=0.1)
    other = heading_run(toy(), STAIRS, at, start=0.5, seed=8, tolerance=0.1)
    assert run.outcome is other.outcome is Outcome.SETTLED
    assert np.array_equal(run.heading, again.heading)
    assert not np.array_equal(run.heading, other.heading)


@settings(max_examples=examples(100))
@given(st.floats(0.01, 1.2), st.floats(0.0, 3.0))
def test_mirror(start, divergence):
    # property: to the right as to the left
    at = loop(gain=2.0, divergence=divergence)
    one = heading_run(toy(), STAIRS, at, start=start, duration=2.0)
    other = heading_run(toy(), STAIRS, at, start=-start, duration=2.0)
    assert other.heading == pytest.approx(-one.heading, abs=ROUNDING)
    assert other.across == pytest.approx(-one.across, abs=ROUNDING)
    assert one.outcome is other.outcome


def test_scaling():
    # property: lengths and speeds times 3
    big = toy(
        com_from_front=0.9,
        com_height=0.3,
        track=Track(flat_length=1.8, gauge=1.2),
        drive=Drive(max_speed=1.5),
    )
    stairs = Stairs(rise=0.45, going=0.60)
    one = heading_run(toy(), STAIRS, loop(gain=3.0), start=0.8, duration=3.0)
    two = heading_run(big, stairs, loop(speed=0.9, gain=3.0), start=0.8, duration=3.0)
    assert two.heading == pytest.approx(one.heading, abs=ROUNDING)
    assert two.across == pytest.approx(3 * one.across, abs=ROUNDING)


# --- from where it loses -----------------------------------------------------------------------


@pytest.mark.parametrize("divergence", [1.2, 2.0, 4.0])
@pytest.mark.parametrize("grip", [0.6, 1.0])
def test_it_loses_from_where_the_closed_form_says(divergence, grip):
    # agreement: simulation and closed form; gain enough to hold it straight
    at = loop(gain=20.0, divergence=divergence, grip=grip)
    expected = losing_yaw(grip=grip, limit=0.4, gauge=0.4, divergence=divergence)
    left, right = losing_start(toy(), STAIRS, at)
    assert left == pytest.approx(expected, abs=2e-4)  # sought to 1e-4
    assert right == pytest.approx(expected, abs=2e-4)
    over, under = (heading_run(toy(), STAIRS, at, start=left + d) for d in (0.01, -0.01))
    assert over.lost
    assert over.outcome is Outcome.TURNED_ACROSS
    assert over.saturated.all()
    assert under.outcome is Outcome.SETTLED


def test_it_loses_sooner_by_tipping_sideways():
    # hand: sin(psi) = gauge / (2 C_N tan(theta_s)) = 0.4 / (2 * 0.5 * 0.75)
    tall = toy(com_height=0.5)
    tips = math.asin(0.4 / 0.75)
    assert sideways_limit(gauge=0.4, C_N=0.5, psi=tips) == pytest.approx(STAIRS.angle)
    left, right = losing_start(tall, STAIRS, loop(gain=20.0))
    assert left == right == pytest.approx(tips, abs=2e-4)
    run = heading_run(tall, STAIRS, loop(gain=20.0), start=0.6)
    assert run.outcome is Outcome.TIPPED_SIDEWAYS
    assert len(run.t) == 1


def test_it_never_loses_or_always():
    assert losing_start(toy(), STAIRS, loop(gain=2.0)) == (math.pi / 2, math.pi / 2)
    assert losing_start(toy(), STAIRS, loop(gain=1.0, divergence=1.5)) == (0.0, 0.0)


def test_a_drift_makes_one_side_worse():
    # hand: to the left 0.4 / 0.4 - 0.3 = 0.7 rad/s against 2 sin(psi), to the right 1.3
    left, right = losing_start(toy(), STAIRS, loop(gain=20.0, divergence=2.0, drift=0.3))
    assert left == pytest.approx(math.asin(0.35), abs=2e-4)
    assert right == pytest.approx(math.asin(0.65), abs=2e-4)


@pytest.mark.parametrize(("duration", "settles"), [(1.16, False), (1.2, True)])
def test_settled_for_a_tenth_of_the_run(duration, settles):
    # hand: within two degrees from 1.06 s on, see above; 0.9 * 1.16 < 1.06 < 0.9 * 1.2
    run = heading_run(toy(), STAIRS, loop(gain=2.0), start=0.3, duration=duration)
    assert (run.outcome is Outcome.SETTLED) == settles


def test_unsettled_is_neither():
    run = heading_run(toy(), STAIRS, loop(gain=0.01), start=0.5, duration=1.0)
    assert run.outcome is Outcome.UNSETTLED
    assert math.isnan(run.settled_at)
    assert not run.lost


@pytest.mark.parametrize(
    ("robot", "at", "more", "text"),
    [
        (
            toy(track=Track(flat_length=0.6)), loop(), {},
            "robot 'toy': track.gauge is not known, and turning needs it",
        ),
        (
            toy(drive=Drive()), loop(), {},
            "robot 'toy': drive.max_speed is not known, and turning needs it",
        ),
        (
            toy(), loop(speed=0.6), {},
            "heading loop: speed = 0.6 m/s is more than the 0.5 m/s of robot 'toy'",
        ),
        (toy(), loop(), {"start": 2.0}, "start = 2 rad is not within -1.5708 to 1.5708 rad"),
        (toy(), loop(), {"start": math.nan}, "start = nan rad is not within -1.5708 to 1.5708 rad"),
        (toy(), loop(), {"duration": 0.01}, "duration = 0.01 s is not within 0.02 to 20000 s"),
    ],
)  # fmt: skip
def test_refusals(robot, at, more, text):
    with pytest.raises(InputError) as refused:
        heading_run(robot, STAIRS, at, **({"start": 0.1} | more))
    assert str(refused.value) == text
