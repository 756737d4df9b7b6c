"""Online tip-over prediction after Liu & Liu 2009: margin, time, alarm, and what is refused."""

import io
import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kaidan.assessment import assess
from kaidan.errors import InputError
from kaidan.mechanics.margin import centroid_margin_downhill, theta_s_inf, theta_s_sup
from kaidan.mechanics.measures import force_angle_measure
from kaidan.mechanics.plane import lowest_contact
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.neighbours.samples import Sample, samples_of
from kaidan.neighbours.tipover import Motion, Outlook, tip_angle_downhill, tip_angle_uphill
from kaidan.neighbours.tipover_monitor import AlarmLimits, Monitor, Status, readings
from kaidan.robot import Payload, Robot, Track
from kaidan.stairs import Stairs

KENAF = Robot.named("kenaf")
L, C_L, C_N, P = 0.470, 0.196, 0.071, 0.150
STAIRS = Stairs.inclined(angle=math.radians(50), nosing_spacing=P)
ROUNDING = 1e-12  # angles of order one after sine, cosine and two arctangents
FOUND = 1e-8  # times are sought to 1e-9 s


def one(sample, robot=KENAF, stairs=STAIRS, **options):
    return Monitor(robot, stairs, **options).feed(sample)


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
    reading = one(at_rest(phi))
    sup, inf = theta_s_sup(L=L, p=P, C_L=C_L, C_N=C_N), theta_s_inf(p=P, C_L=C_L, C_N=C_N)
    assert reading.margin_downhill == pytest.approx(sup - phi, abs=ROUNDING)
    assert reading.margin_uphill == pytest.approx(phi - inf, abs=ROUNDING)
    slack = centroid_margin_downhill(L=L, p=P, C_L=C_L, C_N=C_N, theta_s=phi)
    assert reading.centroid_margin <= slack + ROUNDING
    if degrees > 40:  # the downhill end is the nearer
        assert reading.centroid_margin == pytest.approx(slack, abs=ROUNDING)


def test_at_rest_the_margin_is_that_of_assess():
    # agreement: the closed form without allowances
    answer = assess(
        KENAF, STAIRS, friction=3.0, theta_d=(0, 0), theta_M=(0, 0), model="closed-form"
    )
    assert math.degrees(one(at_rest(STAIRS.angle)).margin) == pytest.approx(answer.margin_deg)


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
    reading = one(Sample(0.0, phi, rate, 0.0))
    expected = reading.margin_downhill / rate
    if expected > 2.0:
        assert reading.time_to_tip == math.inf
    else:
        assert reading.time_to_tip == pytest.approx(expected, abs=FOUND)


def test_time_to_turn_over_the_nose():
    # hand: the nose drops at 0.5 rad/s, the margin uphill is phi - theta_s_inf
    inf = float(theta_s_inf(p=0.22, C_L=C_L, C_N=C_N))
    stairs = Stairs.inclined(angle=0.4, nosing_spacing=0.22)
    reading = one(Sample(0.0, 0.4, -0.5, 0.0), stairs=stairs)
    assert reading.time_to_tip == pytest.approx((0.4 - inf) / 0.5, abs=FOUND)


def test_no_time_is_left_beyond_the_limit():
    assert one(at_rest(math.radians(61))).time_to_tip == 0.0
    assert one(at_rest(math.radians(61))).alarm
    assert one(at_rest(math.radians(50))).time_to_tip == math.inf


def test_a_known_place_foresees_the_loss_of_the_lowest_nosing():
    # hand: 61 degrees hold while the lowest nosing is far down (d = 0: L - 0.02 m behind), and not
    # from the loss on, L - n p = 0.02 m further up, at 0.1 m/s 0.2 s later
    phi = math.radians(61)
    monitor = Monitor(KENAF, STAIRS)
    monitor.feed(Sample(0.0, phi, 0.0, 0.0, position=-0.01))
    reading = monitor.feed(Sample(0.1, phi, 0.0, 0.0, position=0.0))
    assert reading.margin > 0.2
    assert reading.time_to_tip == pytest.approx(0.2, abs=2e-8)
    assert reading.alarm
    standing = one(Sample(0.0, phi, 0.0, 0.0, position=0.0))
    assert standing.time_to_tip == math.inf


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
        reading = one(at_rest(0.9, position=float(position)))
        assert reading.margin_downhill >= worst.margin_downhill - ROUNDING
        assert reading.margin_uphill >= worst.margin_uphill - ROUNDING


def test_irregular_stairs_take_the_longest_spacing_and_no_position():
    odd = Stairs(rises=(0.1, 0.1, 0.11, 0.1), goings=(0.1, 0.1, 0.1))
    placed = one(at_rest(0.7, position=0.0), stairs=odd)
    sup = theta_s_sup(L=L, p=math.hypot(0.11, 0.1), C_L=C_L, C_N=C_N)
    assert placed.margin_downhill == pytest.approx(sup - 0.7, abs=ROUNDING)


# --- symmetry ----------------------------------------------------------------------------------


@given(st.floats(0.2, 1.0), st.floats(-1.0, 1.0), st.floats(-3.0, 3.0))
def test_mirror(phi, rate, a):
    # property: nose down is the robot with its ends swapped, its inclination with the sign changed
    turned = KENAF.model_copy(update={"com_from_front": L - C_L})
    up = one(Sample(0.0, phi, rate, a, position=0.03))
    down = one(Sample(0.0, -phi, -rate, a, position=0.03), robot=turned, nose="down")
    assert down.margin_downhill == pytest.approx(up.margin_downhill, abs=ROUNDING)
    assert down.margin_uphill == pytest.approx(up.margin_uphill, abs=ROUNDING)
    assert down.time_to_tip == pytest.approx(up.time_to_tip, abs=FOUND)


@given(st.floats(0.3, 3.0), st.floats(0.2, 1.0))
def test_scaling(k, phi):
    # property: lengths times k
    big = Robot(
        name="big", com_from_front=C_L * k, com_height=C_N * k, track=Track(flat_length=L * k)
    )
    stairs = Stairs.inclined(angle=math.radians(50), nosing_spacing=P * k)
    a, b = one(at_rest(phi)), one(at_rest(phi), robot=big, stairs=stairs)
    assert b.margin == pytest.approx(a.margin, abs=1e-9)
    assert b.centroid_margin == pytest.approx(k * a.centroid_margin, abs=1e-9)


def test_a_payload_behind_takes_margin_off():
    robot = Robot.named("absolem-flat")
    stairs = Stairs.named("ibc")
    load = [Payload(mass=5.0, from_front=1.0, height=0.3)]
    before = one(at_rest(0.5), robot=robot, stairs=stairs)
    after = one(at_rest(0.5), robot=robot, stairs=stairs, payload=load)
    assert after.margin_downhill < before.margin_downhill


# --- the alarm ---------------------------------------------------------------------------------


def swing(times, phi):
    return [
        Sample(t, float(f), 0.0, 0.0, row=i)
        for i, (t, f) in enumerate(zip(times, phi, strict=True))
    ]


def test_the_alarm_has_hysteresis():
    # hand: the limit is 60.205 degrees; on below 5.2 of margin, off above 7.2
    degrees = [50.0, 54.9, 55.1, 54.0, 53.1, 52.9, 54.9, 55.1]
    samples = swing(range(8), np.radians(degrees))
    alarms = [reading.alarm for reading in readings(samples, KENAF, STAIRS)]
    assert alarms == [False, False, True, True, True, False, False, True]


def test_the_alarm_by_time_has_hysteresis():
    # hand: at 50 degrees 10.205 are left: at rates of 10.205/0.4, /0.7 and /1.2 that many seconds
    phi = math.radians(50)
    left = float(theta_s_sup(L=L, p=P, C_L=C_L, C_N=C_N)) - phi
    rates = [left / s for s in (1.2, 0.7, 0.4, 0.7, 1.2)]
    samples = [Sample(float(t), phi, rate, 0.0) for t, rate in enumerate(rates)]
    alarms = [reading.alarm for reading in readings(samples, KENAF, STAIRS)]
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
    told = list(readings(samples, KENAF, STAIRS))
    crossed = next(i for i, reading in enumerate(told) if reading.margin <= 0)
    raised = next(i for i, reading in enumerate(told) if reading.alarm)
    assert told[crossed].t - told[raised].t > 0.2
    assert told[crossed - 1].time_to_tip < 2e-3
    # near the top the rate changes by less than a tenth within 20 ms
    assert told[crossed - 20].time_to_tip == pytest.approx(0.02, rel=0.1)


# --- replay and bad samples --------------------------------------------------------------------


def noisy(count=300):
    draw = np.random.default_rng(2009)
    phi = math.radians(52) + 0.05 * np.sin(np.arange(count) / 20) + draw.normal(0, 0.01, count)
    return [
        Sample(0.02 * i, float(f), float(draw.normal(0, 0.2)), float(draw.normal(0, 0.3)),
               position=0.002 * i, row=i + 1)
        for i, f in enumerate(phi)
    ]  # fmt: skip


def test_replay():
    first = list(readings(noisy(), KENAF, STAIRS))
    assert first == list(readings(iter(noisy()), KENAF, STAIRS))
    assert any(a.alarm != b.alarm for a, b in pairwise(first))


def test_readings_come_one_by_one():
    def live():
        yield at_rest(0.8)
        raise AssertionError("asked for more than was needed")

    assert next(readings(live(), KENAF, STAIRS)).status is Status.OK


@pytest.mark.parametrize(
    ("changes", "status", "message"),
    [
        ({"inclination": math.nan}, "not-finite", "inclination is nan"),
        ({"t": math.inf}, "not-finite", "t is inf"),
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
        ({"t": 1.0}, "time-not-later", "t = 1 s is not later than 1 s"),
        ({"t": 0.5}, "time-not-later", "t = 0.5 s is not later than 1 s"),
    ],
)
def test_a_bad_sample_has_a_status_and_changes_nothing(changes, status, message):
    good = Sample(1.0, math.radians(56), 0.0, 0.0, row=1)
    bad = Sample(2.0, math.radians(40), 0.0, 0.0, row=2)._replace(**changes)
    monitor = Monitor(KENAF, STAIRS)
    monitor.feed(good)
    reading = monitor.feed(bad)
    assert (reading.status, reading.message, reading.row) == (status, message, 2)
    assert reading.alarm  # as it was
    assert math.isnan(reading.margin)
    assert math.isnan(reading.time_to_tip)
    after = monitor.feed(good._replace(t=3.0, row=3))
    assert after.status is Status.OK
    strict = Monitor(KENAF, STAIRS, strict=True)
    strict.feed(good)
    with pytest.raises(InputError) as refused:
        strict.feed(bad)
    assert str(refused.value) == f"samples, row 2: {message}"


def test_a_long_gap_gives_no_speed():
    monitor = Monitor(KENAF, STAIRS)
    phi = math.radians(61)
    # hand: 0.2 m/s would meet the loss 0.02 m further up after 0.1 s
    monitor.feed(Sample(0.0, phi, 0.0, 0.0, position=-1.0))
    assert monitor.feed(Sample(5.0, phi, 0.0, 0.0, position=0.0)).time_to_tip == math.inf


def test_a_lost_position_is_no_bad_sample():
    for position in (math.nan, math.inf):
        reading = one(at_rest(0.9, position=position))
        assert reading.status is Status.OK
        assert reading.margin == one(at_rest(0.9)).margin


def test_outside_the_model_says_so_and_never_a_number():
    reading = one(at_rest(0.5), stairs=Stairs.named("ibc"))
    assert reading.status is Status.OUTSIDE_MODEL
    assert reading.message == "p = 0.3309 m is more than L / 2 = 0.235 m"
    assert math.isnan(reading.margin)
    assert not reading.alarm
    assert not Monitor(KENAF, Stairs.named("ibc"), strict=True).inside_model
    assert one(at_rest(0.5), stairs=Stairs.named("ibc"), strict=True) == reading


def test_an_unknown_nose_is_refused():
    with pytest.raises(InputError) as refused:
        Monitor(KENAF, STAIRS, nose="left")
    assert str(refused.value) == "nose = 'left' is not known; known: up, down"


# --- the file ----------------------------------------------------------------------------------

HEAD = "t,inclination,inclination_rate,acceleration"


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
        (HEAD + "\n1,2,3\n", "imu.csv, line 2: 3 cells, at least 4 are needed"),
        (HEAD + "\n1,2,3,4\n2,up,0,0\n", "imu.csv, line 3: inclination = 'up' is not a number"),
        ("", "imu.csv: holds no samples; the first line names " + HEAD.replace(",", ", ")),
    ],
)  # fmt: skip
def test_a_bad_file_is_refused_with_its_line(text, message):
    with pytest.raises(InputError) as refused:
        read(text)
    assert str(refused.value) == message


def test_a_stream_is_read_line_by_line():
    def live():
        yield HEAD + "\n"
        yield "0,0.5,0,0\n"
        raise AssertionError("asked for more than was needed")

    assert next(samples_of(live(), origin="-")).inclination == 0.5
