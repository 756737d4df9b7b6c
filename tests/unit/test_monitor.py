"""Tip-over from an inertial sensor: margin, time, alarm; what is not known; what is refused."""

import io
import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kaidan.assessment import assess
from kaidan.errors import InputError
from kaidan.literature.tipover import Motion, Outlook, tip_angle_downhill, tip_angle_uphill
from kaidan.mechanics.margin import centroid_margin_downhill, theta_s_inf, theta_s_sup
from kaidan.mechanics.measures import force_angle_measure
from kaidan.mechanics.plane import lowest_contact
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.robot import Payload, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.monitor import AlarmLimits, Monitor, MonitorAnswer, Sample, SampleStatus, monitor
from kaidan.verbs.monitor.samples import LONGEST_LINE, LONGEST_SKIPPED, lines_of, samples_of

KENAF = Robot.named("kenaf")
L, C_L, C_N, P = 0.470, 0.196, 0.071, 0.150
STAIRS = Stairs.inclined(angle=math.radians(50), nosing_spacing=P)
ROUNDING = 1e-12  # angles of order one after sine, cosine and two arctangents
FOUND = 1e-8  # times are sought to 1e-9 s


def one(sample, robot=KENAF, stairs=STAIRS, **options):
    return Monitor(robot, stairs, **options).feed(sample)


def states(samples, robot=KENAF, stairs=STAIRS, **options):
    return list(map(Monitor(robot, stairs, **options).feed, samples))


def angle(state, name="margin"):
    """Angle of a state [rad]."""
    return math.radians(getattr(state, f"{name}_deg"))


def at_rest(phi, **more):
    return Sample(t=0.0, inclination=phi, inclination_rate=0.0, acceleration=0.0, **more)


# --- the angle ---------------------------------------------------------------------------------


def test_angles_by_hand():
    # hand: contacts 45 degrees either side of the centroid, the resultant leaning by atan(0.5)
    at = {"C_L": 0.2, "C_N": 0.1, "phi": 0.0, "a": 5.0, "g": 10.0}
    lean = math.atan(0.5)
    assert tip_angle_downhill(x_0=0.3, **at) == pytest.approx(math.pi / 4 - lean, abs=ROUNDING)
    assert tip_angle_uphill(x_n=0.1, **at) == pytest.approx(math.pi / 4 + lean, abs=ROUNDING)


@pytest.mark.parametrize("degrees", [5.0, 44.0, 60.0, 75.0])
def test_at_rest_the_margin_is_the_slope_left_of_the_mechanics(degrees):
    # agreement: at rest in the worst place, mechanics' limits of slope minus the slope
    phi = math.radians(degrees)
    state = one(at_rest(phi))
    sup, inf = theta_s_sup(L=L, p=P, C_L=C_L, C_N=C_N), theta_s_inf(p=P, C_L=C_L, C_N=C_N)
    assert angle(state, "margin_downhill") == pytest.approx(sup - phi, abs=ROUNDING)
    assert angle(state, "margin_uphill") == pytest.approx(phi - inf, abs=ROUNDING)
    slack = centroid_margin_downhill(L=L, p=P, C_L=C_L, C_N=C_N, theta_s=phi)
    assert 1e-3 * state.centroid_margin_mm <= slack + ROUNDING
    if degrees > 40:  # the downhill end is the nearer
        assert 1e-3 * state.centroid_margin_mm == pytest.approx(slack, abs=ROUNDING)


def test_at_rest_the_margin_is_that_of_assess():
    # agreement: the closed form without allowances
    answer = assess(
        KENAF, STAIRS, friction=3.0, theta_d=(0, 0), theta_M=(0, 0), model="closed-form"
    )
    assert math.degrees(angle(one(at_rest(STAIRS.angle)))) == pytest.approx(answer.margin_deg)


@given(
    st.floats(-0.5, 1.2), st.floats(-8.0, 8.0), st.floats(0.0, 0.149),
    st.floats(0.05, 0.42), st.floats(0.02, 0.3),
)  # fmt: skip
def test_sign_is_that_of_the_accelerations_limits(phi, a, d, C_L, C_N):
    # oracle: a between a_rn and a_r0 (Eqs. 15, 16) or not
    s = lowest_contact(d=d, L=L, p=P)
    down = tip_angle_downhill(x_0=s, C_L=C_L, C_N=C_N, phi=phi, a=a)
    up = tip_angle_uphill(x_n=d, C_L=C_L, C_N=C_N, phi=phi, a=a)
    above = a_r0(s=s, theta_s=phi, C_L=C_L, C_N=C_N) - a
    below = a - a_rn(d=d, theta_s=phi, C_L=C_L, C_N=C_N)
    if abs(above) > 1e-9:
        assert (down > 0) == (above > 0)
    if abs(below) > 1e-9:
        assert (up > 0) == (below > 0)


def test_the_angle_is_that_of_the_force_angle_measure():
    # agreement: Papadopoulos & Rey's is angle times distance times force, nearest contact
    at = {"C_L": C_L, "C_N": C_N}
    angle = tip_angle_downhill(x_0=0.32, phi=0.9, a=0.3, **at)
    force = 10.0 * math.hypot(9.80665 * math.sin(0.9) + 0.3, 9.80665 * math.cos(0.9))
    arm = math.hypot(0.32 - C_L, C_N) * abs(math.sin(angle))
    found = force_angle_measure(x_0=0.32, x_n=0.02, theta_s=0.9, a=0.3, M=10.0, **at)
    assert found == pytest.approx(angle * arm * force, rel=1e-9)


# --- the time ----------------------------------------------------------------------------------


@given(st.floats(0.3, 1.0), st.floats(0.05, 1.0))
def test_time_by_hand(phi, rate):
    # hand: margin over rate while nothing else changes
    state = one(Sample(0.0, phi, rate, 0.0))
    expected = angle(state, "margin_downhill") / rate
    if expected > 2.0:
        assert state.time_to_tip_s is None
    else:
        assert state.time_to_tip_s == pytest.approx(expected, abs=FOUND)


def test_time_to_turn_over_the_nose():
    # hand: the nose drops at 0.5 rad/s, the margin uphill is phi - theta_s_inf
    inf = float(theta_s_inf(p=0.22, C_L=C_L, C_N=C_N))
    stairs = Stairs.inclined(angle=0.4, nosing_spacing=0.22)
    state = one(Sample(0.0, 0.4, -0.5, 0.0), stairs=stairs)
    assert state.time_to_tip_s == pytest.approx((0.4 - inf) / 0.5, abs=FOUND)


def test_no_time_is_left_beyond_the_limit():
    assert one(at_rest(math.radians(61))).time_to_tip_s == 0.0
    assert one(at_rest(math.radians(61))).alarm
    assert one(at_rest(math.radians(50))).time_to_tip_s is None


def test_a_known_place_foresees_the_loss_of_the_lowest_nosing():
    # hand: 61 degrees hold while the lowest nosing is far down (d = 0: L - 0.02 m behind), and not
    # from the loss on, L - n p = 0.02 m further up, at 0.1 m/s 0.2 s later
    phi = math.radians(61)
    monitor = Monitor(KENAF, STAIRS)
    monitor.feed(Sample(0.0, phi, 0.0, 0.0, position=-0.01))
    state = monitor.feed(Sample(0.1, phi, 0.0, 0.0, position=0.0))
    assert angle(state) > 0.2
    assert state.time_to_tip_s == pytest.approx(0.2, abs=2e-8)
    assert state.alarm
    standing = monitor.feed(Sample(0.2, phi, 0.0, 0.0, position=0.0))
    assert standing.time_to_tip_s is None


def test_without_a_speed_the_worst_position_is_foreseen():
    # hand: 61 degrees are beyond the limit of 60.2 in the worst position; at d = 0 none is lost
    state = one(at_rest(math.radians(61), position=0.0))
    assert angle(state) > 0.2
    assert state.time_to_tip_s == 0.0
    assert state.alarm


@given(st.floats(0.0, 1.0), st.floats(-0.4, 0.4), st.floats(-0.5, 0.5), st.floats(0.9, 1.3))
@settings(max_examples=40)
def test_time_against_a_fine_scan(place, speed, rate, phi):
    # oracle: a hundred thousand times
    ahead = Outlook(L=L, C_L=C_L, C_N=C_N, p=P)
    motion = Motion(phi=phi, rate=rate, a=0.0, position=place, speed=speed)
    tau = np.linspace(0.0, 2.0, 100_001)
    used_up = np.minimum(*ahead.angles(motion, tau)) <= 0
    found = ahead.time_to_tip(motion, 2.0)
    if used_up.any():
        assert found == pytest.approx(tau[np.argmax(used_up)], abs=2.1e-5)  # one cell
    else:
        assert found == math.inf or found > 0  # between two cells


def test_a_place_never_has_less_than_the_worst_place():
    # property: without a position the monitor is never kinder
    worst = one(at_rest(0.9))
    for position in np.linspace(-0.4, 0.7, 57):
        state = one(at_rest(0.9, position=float(position)))
        assert angle(state, "margin_downhill") >= angle(worst, "margin_downhill") - ROUNDING
        assert angle(state, "margin_uphill") >= angle(worst, "margin_uphill") - ROUNDING


def test_irregular_stairs_take_the_longest_spacing_and_no_position():
    odd = Stairs(rises=(0.1, 0.1, 0.11, 0.1), goings=(0.1, 0.1, 0.1))
    placed = one(at_rest(0.7, position=0.0), stairs=odd)
    sup = theta_s_sup(L=L, p=math.hypot(0.11, 0.1), C_L=C_L, C_N=C_N)
    assert angle(placed, "margin_downhill") == pytest.approx(sup - 0.7, abs=ROUNDING)


# --- symmetry ----------------------------------------------------------------------------------


@given(st.floats(0.2, 1.0), st.floats(-1.0, 1.0), st.floats(-3.0, 3.0))
def test_mirror(phi, rate, a):
    # property: nose down is the robot with its ends swapped, its inclination with the sign changed
    turned = KENAF.model_copy(update={"com_from_front": L - C_L})
    up = one(Sample(0.0, phi, rate, a, position=0.03))
    down = one(Sample(0.0, -phi, -rate, a, position=0.03), robot=turned, nose="down")
    assert angle(down, "margin_downhill") == pytest.approx(
        angle(up, "margin_downhill"), abs=ROUNDING
    )
    assert angle(down, "margin_uphill") == pytest.approx(angle(up, "margin_uphill"), abs=ROUNDING)
    assert down.time_to_tip_s == pytest.approx(up.time_to_tip_s, abs=FOUND)


@given(st.floats(0.3, 3.0), st.floats(0.2, 1.0))
def test_scaling(k, phi):
    # property: lengths times k
    big = Robot(
        name="big", com_from_front=C_L * k, com_height=C_N * k, track=Track(flat_length=L * k)
    )
    stairs = Stairs.inclined(angle=math.radians(50), nosing_spacing=P * k)
    a, b = one(at_rest(phi)), one(at_rest(phi), robot=big, stairs=stairs)
    assert angle(b) == pytest.approx(angle(a), abs=1e-9)
    assert b.centroid_margin_mm == pytest.approx(k * a.centroid_margin_mm, abs=1e-9)


def test_a_payload_behind_takes_margin_off():
    robot = Robot.named("absolem-flat")
    stairs = Stairs.named("ibc")
    load = [Payload(mass=5.0, from_front=1.0, height=0.3)]
    before = one(at_rest(0.5), robot=robot, stairs=stairs)
    after = one(at_rest(0.5), robot=robot, stairs=stairs, payload=load)
    assert angle(after, "margin_downhill") < angle(before, "margin_downhill")


# --- the alarm ---------------------------------------------------------------------------------


def rocking(times, phi):
    return [
        Sample(t, float(f), 0.0, 0.0, row=i)
        for i, (t, f) in enumerate(zip(times, phi, strict=True))
    ]


def test_the_alarm_has_hysteresis():
    # hand: the limit is 60.205 degrees; on below 5.2 of margin, off above 7.2
    degrees = [50.0, 54.9, 55.1, 54.0, 53.1, 52.9, 54.9, 55.1]
    samples = rocking(0.05 * np.arange(8), np.radians(degrees))
    alarms = [state.alarm for state in states(samples)]
    assert alarms == [False, False, True, True, True, False, False, True]


def test_the_alarm_by_time_has_hysteresis():
    # hand: at 50 degrees 10.205 are left: at rates of 10.205/0.4, /0.7 and /1.2 that many seconds
    phi = math.radians(50)
    left = float(theta_s_sup(L=L, p=P, C_L=C_L, C_N=C_N)) - phi
    rates = [left / s for s in (1.2, 0.7, 0.4, 0.7, 1.2)]
    samples = [Sample(0.05 * k, phi, rate, 0.0) for k, rate in enumerate(rates)]
    alarms = [state.alarm for state in states(samples)]
    assert alarms == [False, False, True, True, False]


def test_own_limits():
    keen = AlarmLimits(margin_on=0.3, margin_off=0.4)
    assert one(at_rest(math.radians(50)), limits=keen).alarm
    for wrong, text in (
        ({"margin_off": 0.01}, "alarm: margin_off = 0.01 is not within 0.0907571 to inf"),
        ({"time_off": 0.1}, "alarm: time_off = 0.1 is not within 0.5 to inf"),
        ({"horizon": 0.9}, "alarm: horizon = 0.9 is not within 1 to inf"),
        (
            {"margin_on": 5.2},
            "alarm: margin_on = 5.2 rad is not within 0 to 1.5 rad (in degrees? that would be "
            "0.0907571 rad)",
        ),
    ):
        with pytest.raises(InputError) as refused:
            AlarmLimits(**wrong)
        assert str(refused.value) == text


def test_a_fall_is_announced_before_it_is_one():
    # oracle: a body pushed over turns about t_0 as an inverted pendulum, integrated here; it needs
    # 1.04 rad/s to get over the top, sqrt(2 w2 (1 - cos(10.2 degrees)))
    alpha = math.hypot(0.32 - C_L, C_N)
    stood = math.atan2(C_N, 0.32 - C_L)
    w2 = 9.80665 * alpha / (alpha**2 + 0.15**2)
    t, phi, rate, samples = 0.0, math.radians(50), 1.1, []
    while phi + stood < math.pi / 2 + 0.2:
        samples.append(Sample(t, phi, rate, 0.0))
        rate -= w2 * math.cos(phi + stood) * 1e-3
        phi += rate * 1e-3
        t += 1e-3
        assert rate > 0
    seen = states(samples)
    crossed = next(i for i, state in enumerate(seen) if angle(state) <= 0)
    raised = next(i for i, state in enumerate(seen) if state.alarm)
    assert seen[crossed].t_s - seen[raised].t_s > 0.2
    assert seen[crossed - 1].time_to_tip_s < 2e-3
    # near the top the rate changes by less than a tenth within 20 ms
    assert seen[crossed - 20].time_to_tip_s == pytest.approx(0.02, rel=0.1)


# --- replay, one by one ------------------------------------------------------------------------


def noisy(count=300):
    draw = np.random.default_rng(2009)
    phi = math.radians(52) + 0.05 * np.sin(np.arange(count) / 20) + draw.normal(0, 0.01, count)
    return [
        Sample(0.02 * i, float(f), float(draw.normal(0, 0.2)), float(draw.normal(0, 0.3)),
               position=0.002 * i, row=i + 1)
        for i, f in enumerate(phi)
    ]  # fmt: skip


def test_replay():
    first = states(noisy())
    assert first == states(iter(noisy()))
    assert any(a.alarm != b.alarm for a, b in pairwise(first))


def test_samples_are_taken_one_by_one():
    def live():
        yield at_rest(0.8)
        raise AssertionError("more than needed")

    watch = Monitor(KENAF, STAIRS)
    assert next(map(watch.feed, live())).status is SampleStatus.OK


@pytest.mark.parametrize(
    ("changes", "status", "message"),
    [
        ({"inclination": math.nan}, "not-finite", "inclination is nan"),
        ({"acceleration": -math.inf}, "not-finite", "acceleration is -inf"),
        ({"inclination_rate": math.nan}, "not-finite", "inclination_rate is nan"),
        (
            {"inclination": 52.0},
            "implausible",
            "inclination = 52 rad is not within -3.14159 to 3.14159 rad (in degrees?)",
        ),
        (
            {"acceleration": 981.0},
            "implausible",
            "acceleration = 981 m/s^2 is not within -500 to 500 m/s^2",
        ),
        ({"fault": "cells: 3, the head names 4"}, "unreadable", "cells: 3, the head names 4"),
    ],
)
def test_a_sample_that_cannot_be_judged_has_a_status_and_leaves_the_alarm(changes, status, message):
    good = Sample(1.0, math.radians(56), 0.0, 0.0, row=1)
    bad = Sample(2.0, math.radians(40), 0.0, 0.0, row=2)._replace(**changes)
    monitor = Monitor(KENAF, STAIRS)
    monitor.feed(good)
    state = monitor.feed(bad)
    assert (state.status, state.message, state.row) == (status, message, 2)
    assert state.alarm  # as it was
    assert (state.margin_deg, state.time_to_tip_s) == (None, None)
    after = monitor.feed(good._replace(t=3.0, row=3))
    assert after.status is SampleStatus.OK
    strict = Monitor(KENAF, STAIRS, strict=True)
    strict.feed(good)
    with pytest.raises(InputError) as refused:
        strict.feed(bad)
    assert str(refused.value) == f"samples, row 2: {message}"


# --- what is not known counts as the worst case ------------------------------------------------

HEAD = "t,inclination,inclination_rate,acceleration"
CALM, STEEP = math.radians(40), math.radians(56)  # hand: 20.2 and 4.2 degrees below the limit


@pytest.mark.parametrize(
    ("t", "message"),
    [
        (math.inf, "t is inf"),
        (math.nan, "t is nan"),
        (1.0, "t = 1 s is not later than 1 s"),
        (0.5, "t = 0.5 s is not later than 1 s"),
    ],
)
def test_a_doubtful_time_is_judged_in_the_worst_position_and_clears_no_alarm(t, message):
    watch = Monitor(KENAF, STAIRS)
    assert watch.feed(Sample(1.0, STEEP, 0.0, 0.0)).alarm
    state = watch.feed(Sample(t, CALM, 0.0, 0.0, position=0.0))
    assert (state.status, state.message) == ("time-doubtful", message)
    assert state.margin_deg == one(at_rest(CALM)).margin_deg
    assert state.alarm
    # after a second of good data at the latest: a stamp that goes back is an alarm of its own
    good = [watch.feed(Sample(1.05 + 0.05 * k, CALM, 0.01 * (k % 2), 0.0)) for k in range(30)]
    assert not good[-1].alarm
    assert watch.feed(Sample(t, STEEP, 0.0, 0.0)).alarm


def test_a_time_stamp_in_the_future_costs_one_sample():
    at = [0.0, 0.01, 1e9, 0.03, 0.04, 0.05]
    seen = states(Sample(t, CALM, 0.0, 0.0) for t in at)
    assert [state.status for state in seen] == ["ok"] * 3 + ["time-doubtful"] + ["ok"] * 2
    assert all(state.judged for state in seen)


anything = st.floats(allow_nan=True, allow_infinity=True)
near = st.floats(-2.0, 2.0)


@given(
    st.lists(
        st.tuples(anything | near, anything | near, near, near, anything | near),
        max_size=8,
    ),
    st.floats(-1e12, 1e12),
    anything,
)
def test_nothing_that_came_before_blinds_it(before, t, position):
    """Property: a sample beyond every limit raises the alarm, whatever the samples before it."""
    watch = Monitor(KENAF, STAIRS)
    for values in before:
        state = watch.feed(Sample(*values))
        assert state.judged == (state.margin_deg is not None)
        assert state.judged or state.status in ("not-finite", "implausible")
    state = watch.feed(Sample(t, math.radians(85), 0.0, 0.0, position=position))
    assert state.judged
    assert state.margin_deg < 0  # hand: atan((L - C_L) / C_N) = 75.5 degrees in the best position
    assert state.alarm
    assert watch.answer().exit_code == 1


@given(st.lists(st.text(max_size=40) | st.just("0.1,0.5,0,0"), max_size=8))
def test_any_row_is_a_sample(rows):
    """Property: whatever stands in a row, the file is read to its end."""
    found = list(samples_of([HEAD, *rows], origin="-"))
    assert all(isinstance(sample, Sample) for sample in found)
    good = sum(row == "0.1,0.5,0,0" for row in rows)
    assert sum(not sample.fault for sample in found) >= good


@pytest.mark.parametrize("position", [1e308, -1e308, math.inf, 1.1e4])
def test_an_impossible_position_is_the_worst_one(position):
    watch = Monitor(KENAF, STAIRS)
    for k in range(3):
        state = watch.feed(Sample(0.1 * k, 0.9, 0.1, 0.0, position=position * (-1) ** k))
        assert state.status is SampleStatus.POSITION_DOUBTFUL
        worst = one(Sample(0.0, 0.9, 0.1, 0.0))
        assert (state.margin_deg, state.time_to_tip_s) == (worst.margin_deg, worst.time_to_tip_s)
    assert state.message == (f"position = {position:g} m is not within -10000 to 10000 m")


def test_a_position_that_jumps_is_the_worst_one():
    # hand: 2 m within 0.1 s are 20 m/s; from the next on the new place is believed
    watch = Monitor(KENAF, STAIRS)
    at = [(0.0, 0.0), (0.1, 0.02), (0.2, 2.02), (0.3, 2.04)]
    seen = [watch.feed(Sample(t, 0.9, 0.0, 0.0, position=x)) for t, x in at]
    assert [state.status for state in seen] == ["ok", "ok", "position-doubtful", "ok"]
    assert seen[2].message == "position = 2.02 m is 2 m from the last"
    assert seen[2].margin_deg == one(at_rest(0.9)).margin_deg
    assert seen[3].margin_deg > seen[2].margin_deg


@pytest.mark.parametrize(("lost", "code"), [(4, 0), (5, 2), (9, 2)])
def test_no_alarm_from_less_than_half_of_the_samples_is_no_answer(lost, code):
    # hand: 13 samples at 100 Hz take 0.12 s, of which no alarm can be made
    samples = [Sample(0.01 * k, CALM, 0.0, 0.0) for k in range(4)]
    samples += [Sample(math.nan, math.nan, 0.0, 0.0) for _ in range(lost)]
    answer = monitor(KENAF, STAIRS, samples)
    assert answer.unjudged_share == pytest.approx(lost / (4 + lost))
    assert (answer.judged, answer.exit_code) == (4, code)
    assert ("NO ANSWER  Fewer than half" in str(answer)) == (code == 2)


# --- the answer --------------------------------------------------------------------------------


def test_the_answer_of_a_list():
    answer = monitor("kenaf", STAIRS, noisy())
    assert list(answer.states) == states(noisy())
    lowest = min(answer.states, key=lambda state: state.margin_deg)
    assert (answer.lowest_margin_deg, answer.lowest_margin_t_s) == (lowest.margin_deg, lowest.t_s)
    assert answer.statuses == {"ok": 300}
    assert MonitorAnswer.from_json(answer.to_json()) == answer
    assert answer.alarms == sum(
        b.alarm and not a.alarm for a, b in pairwise((states([at_rest(CALM)])[0], *answer.states))
    )


def test_nothing_came():
    with pytest.raises(InputError) as refused:
        monitor("kenaf", STAIRS, [])
    assert str(refused.value) == "no samples came"


def test_a_terrain_without_steps_is_refused():
    with pytest.raises(InputError) as refused:
        monitor("kenaf", Profile.of_points([(0, 0), (3, 0.3)]), [at_rest(0.1)])
    assert str(refused.value).endswith(": the monitor needs the spacing of its steps")


def test_a_long_gap_gives_no_speed():
    watch = Monitor(KENAF, STAIRS)
    phi = math.radians(61)
    # hand: at 0.2 m/s the loss 0.02 m further up is 0.1 s ahead; unknown, it may be now
    watch.feed(Sample(0.0, phi, 0.0, 0.0, position=-1.0))
    assert watch.feed(Sample(5.0, phi, 0.0, 0.0, position=0.0)).time_to_tip_s == 0.0


def test_a_lost_position_is_no_bad_sample():
    state = one(at_rest(0.9, position=math.nan))
    assert state.status is SampleStatus.OK
    assert state == one(at_rest(0.9))


def test_outside_the_model_says_so_and_never_a_number():
    state = one(at_rest(0.5), stairs=Stairs.named("ibc"))
    assert state.status is SampleStatus.OUTSIDE_MODEL
    assert state.message == "p = 0.3309 m is more than L / 2 = 0.235 m"
    assert state.margin_deg is None
    assert not state.alarm
    assert not Monitor(KENAF, Stairs.named("ibc"), strict=True).inside_model
    assert one(at_rest(0.5), stairs=Stairs.named("ibc"), strict=True) == state


def test_an_unknown_nose_is_refused():
    with pytest.raises(InputError) as refused:
        Monitor(KENAF, STAIRS, nose="left")
    assert str(refused.value) == "nose = 'left' is not known; known: up, down"


# --- the file ----------------------------------------------------------------------------------


def read(text):
    return list(samples_of(io.StringIO(text), origin="imu.csv"))


def test_a_file_in_any_order_of_columns():
    text = (
        "\ufeff# a note\nposition, acceleration,t,spare,inclination,inclination_rate\n\n"
        "0.1,0.2,1e0,x,0.5,-0.01\n,0.2,2,x,,0\n"
    )
    first, second = read(text)
    assert first == Sample(1.0, 0.5, -0.01, 0.2, position=0.1, row=4)
    assert (second.t, second.row) == (2.0, 5)
    assert math.isnan(second.inclination)
    assert math.isnan(second.position)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "t,inclination\n1,2\n",
            "imu.csv, line 1: columns inclination_rate, acceleration are missing; needed: t, "
            "inclination, inclination_rate, acceleration; optional: position",
        ),
        (
            "\nt,inclination,acceleration\n",
            "imu.csv, line 2: column inclination_rate is missing; needed: t, inclination, "
            "inclination_rate, acceleration; optional: position",
        ),
        (HEAD + ",t\n", "imu.csv, line 1: column t is named twice"),
        ("", "imu.csv: holds no samples; the first line names " + HEAD.replace(",", ", ")),
        ("\ufffd\ufffd\ufffd\n", "imu.csv: cannot be read: not a text file"),
    ],
)  # fmt: skip
def test_a_head_that_cannot_be_used_is_refused_with_its_line(text, message):
    with pytest.raises(InputError) as refused:
        read(text)
    assert str(refused.value) == message


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        ("1,2,3", "cells: 3, the head names 4"),
        ("1,2,3,4,1.1,2,3,4", "cells: 8, the head names 4"),
        ("2,up,0,0", "inclination = 'up' is not a number"),
        ("2," + 50 * "u" + ",0,0", "inclination = '" + 39 * "u" + "…' is not a number"),
        ("1," + "0" * LONGEST_LINE + ",0,0", "the line is longer than 10000 characters"),
        (HEAD, "t = 't' is not a number"),
    ],
)
def test_a_garbled_row_is_a_sample_with_a_fault_and_ends_nothing(line, fault):
    first, garbled, last = read(f"{HEAD}\n1,0.5,0,0\n{line}\n3,0.5,0,0,\n")
    assert (first.fault, last.fault) == ("", "")
    assert (garbled.fault, garbled.row) == (fault, 3)
    assert math.isnan(garbled.t)
    assert last.t == 3.0


def test_an_endless_line_is_cut_and_skipped():
    text = "a\n" + "x" * (3 * LONGEST_LINE) + ",1,2,3,4\nb\n" + "y" * LONGEST_LINE
    lines = list(lines_of(io.StringIO(text), origin="-"))
    assert [line[:1] for line in lines] == ["a", "x", "b", "y"]
    assert [len(line) for line in lines] == [2, LONGEST_LINE + 1, 2, LONGEST_LINE]

    class Endless:
        def readline(self, count):
            return "z" * count

    with pytest.raises(InputError) as refused:
        list(lines_of(Endless(), origin="/dev/zero"))
    assert str(refused.value) == (
        f"/dev/zero, line 1: does not end within {LONGEST_SKIPPED:,} characters"
    )


def test_a_stream_is_read_line_by_line():
    def live():
        yield HEAD + "\n"
        yield "0,0.5,0,0\n"
        raise AssertionError("more than needed")

    assert next(samples_of(live(), origin="-")).inclination == 0.5
