"""The liveness contract: what blinds a monitor is named within half a second, and nothing else is.

A stream is made here sample by sample, each with the time at which the sensor took it. A fault
begins at the first sample that is bad or missing; its alarm has to come no more than 0.5 s later.
"""

import math
from itertools import pairwise

import numpy as np
import pytest

import kaidan
from kaidan.errors import InputError
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.monitor import AlarmLimits, Monitor, Sample
from kaidan.verbs.monitor.liveness import Liveness

IN_TIME = 0.5
ROUNDING = 1e-9  # of times as sums of periods
DEGREE = math.pi / 180
KENAF = Robot.named("kenaf")
STAIRS = Stairs.inclined(angle=math.radians(50), nosing_spacing=0.150)
COARSE = AlarmLimits(resolution=0.1 * DEGREE)


def stream(
    draw, rate, seconds, *, jitter=0.1, begin=0.0, noise=(2e-3, 2e-2, 5e-2), steps=(0, 0, 0)
):
    """Samples of a robot that rocks by 2 degrees, noisy, perhaps rounded to steps; inclination,
    rate and acceleration each."""
    count = round(rate * seconds)
    t = begin + (np.arange(count) + draw.uniform(-jitter / 2, jitter / 2, count)) / rate
    true = (0.6 + 0.035 * np.sin(2 * math.pi * 0.3 * t) * (noise[0] > 1e-3), 0.0, 0.0)
    values = [
        mean + draw.normal(0.0, scale, count) for mean, scale in zip(true, noise, strict=True)
    ]
    values = [
        np.round(x / step) * step if step else x for x, step in zip(values, steps, strict=True)
    ]
    return [Sample(*map(float, row)) for row in zip(t, *values, strict=True)]


# --- faults: rows of arrival and sample, of which those from one on are bad ----------------------


def drop(draw, rows, k):
    """Samples that are lost for a while."""
    begin, gone = rows[k][0], draw.uniform(0.7, 1.5)
    return [row for row in rows if not begin <= row[0] < begin + gone]


def freeze(draw, rows, k):
    """Values that stay while time runs."""
    last = rows[k - 1][1]
    return rows[:k] + [(at, last._replace(t=sample.t)) for at, sample in rows[k:]]


def nan_share(draw, rows, k):
    """At most every second sample is one."""
    good = int(draw.integers(2, 11))
    name = str(draw.choice(["inclination", "inclination_rate", "acceleration"]))
    return rows[:k] + [
        (at, sample if n % good == good - 1 else sample._replace(**{name: math.nan}))
        for n, (at, sample) in enumerate(rows[k:])
    ]


def gap(draw, rows, k):
    """Stamps that jump ahead."""
    by = draw.uniform(0.6, 60)
    return rows[:k] + [(at, sample._replace(t=sample.t + by)) for at, sample in rows[k:]]


def clock_jump(draw, rows, k):
    """Stamps that jump back, or come from two clocks in turn."""
    by, two = -draw.uniform(0.55, 60), draw.integers(2)
    return rows[:k] + [
        (at, sample if two and n % 2 else sample._replace(t=sample.t + by))
        for n, (at, sample) in enumerate(rows[k:])
    ]


def clock_stands(draw, rows, k):
    """Stamps that stay."""
    return rows[:k] + [(at, sample._replace(t=rows[k - 1][1].t)) for at, sample in rows[k:]]


def stall(draw, rows, k):
    """A last message that comes again and again."""
    return rows[:k] + [(at, rows[k - 1][1]) for at, _ in rows[k:]]


def stop(draw, rows, k):
    """Nothing comes any more."""
    return rows[:k]


NAMES = {
    drop: {"silent"},
    freeze: {"frozen"},
    nan_share: {"half blind", "no data"},
    gap: {"clock", "silent"},
    clock_jump: {"clock"},
    clock_stands: {"clock"},
    stall: {"clock"},
    stop: {"silent"},
}


def fault(draw, kind, *, rate=None):
    """Rows of a stream that turns bad at a time."""
    rate = rate or float(np.exp(draw.uniform(math.log(5), math.log(200))))
    samples = stream(draw, rate, 4.0, jitter=draw.choice([0.0, 0.1, 0.2]))
    rows = [(sample.t, sample) for sample in samples]
    k = int(draw.integers(round(1.2 * rate), round(2.0 * rate)))
    return kind(draw, rows, k), rows[k][0]


def looks(rows, watch, *, live):
    """Times [s] at which a stream is looked at, and the alarms that are on then."""
    for (at, sample), (then, _) in pairwise([*rows, (math.inf, None)]):
        judged = all(map(math.isfinite, sample[1:4]))
        watch.take(sample, judged=judged, arrived=at if live else None)
        yield at, set(watch.raised)
        if live and then - at >= watch.limit and watch.overdue(at + watch.limit):
            yield at + watch.limit, set(watch.raised)


@pytest.mark.parametrize("live", [False, True], ids=["recorded", "live"])
def test_a_thousand_faults_are_named_within_half_a_second(live):
    kinds = [kind for kind in NAMES if live or kind is not stop]
    wrong = []
    for n in range(500):
        kind = kinds[n % len(kinds)]
        draw = np.random.default_rng([28, live, n])
        rows, begin = fault(draw, kind)
        seen = list(looks(rows, Liveness(AlarmLimits()), live=live))
        before = [on for at, on in seen if at < begin - ROUNDING and on]
        after = [(at, on) for at, on in seen if at >= begin - ROUNDING]
        # of lost samples a recording tells no sooner than by the next one
        last = max(begin + IN_TIME, after[0][0]) if after else -math.inf
        if before or not any(on & NAMES[kind] for at, on in after if at <= last + ROUNDING):
            wrong.append((n, kind.__name__, before, after[:1]))
    assert wrong == []


@pytest.mark.parametrize("rate", [5.0, 7.0, 12.0, 30.0, 100.0, 200.0])
@pytest.mark.parametrize("kind", [kind for kind in NAMES if kind is not stop])
def test_the_monitor_names_them_too_and_clears_by_good_data_alone(kind, rate):
    draw = np.random.default_rng([11, round(rate)])
    rows, begin = fault(draw, kind, rate=rate)
    watch = Monitor(KENAF, STAIRS)
    states = [watch.feed(sample) for _, sample in rows]
    on = {
        cause for (at, _), state in zip(rows, states, strict=True) for cause in state.causes
        if begin - ROUNDING <= at
    }  # fmt: skip
    assert on & NAMES[kind]
    assert not any(state.alarm for (at, _), state in zip(rows, states, strict=True) if at < begin)
    if kind in (freeze, nan_share, clock_stands, stall):  # the others are good again later on
        assert states[-1].alarm
    last = max((sample.t for _, sample in rows if math.isfinite(sample.t)), default=0.0)
    good = stream(draw, rate, 2.5, begin=last + 1 / rate)
    after = [watch.feed(sample) for sample in good]
    assert not after[-1].alarm
    raised = watch.answer().raised
    assert raised.keys() & NAMES[kind]


def test_samples_that_are_lost_on_the_way_are_half_blind():
    # every fifth of 100 a second comes: hand: 9 of the 45 that are due in 0.45 s
    samples = twenty_seconds()
    kept = samples[:1000] + samples[1000::5]
    states = [Monitor.feed(watch, each) for watch in [Monitor(KENAF, STAIRS)] for each in kept]
    assert not any(state.alarm for state in states[:1000])
    first = next(state for state in states if state.alarm)
    assert first.causes == ("half blind",)
    assert first.t_s - kept[999].t <= IN_TIME


def test_no_data_comes_after_its_limit():
    # hand: 0.2 s at 100 Hz, to the nearest sample, before half of 0.45 s are lost
    samples = stream(np.random.default_rng(2), 100.0, 1.0, jitter=0.0)
    watch = Monitor(KENAF, STAIRS)
    lost = [watch.feed(each if k < 60 else blank(each)) for k, each in enumerate(samples)]
    first = next(state for state in lost if state.alarm)
    assert (first.causes, round(first.t_s - samples[59].t, 6)) == (("no data",), 0.2)


def test_an_alarm_of_the_clock_ends_a_second_after_it_goes_right_with_a_good_sample():
    samples = stream(np.random.default_rng(2), 100.0, 4.0, jitter=0.0)
    set_back = [each if k < 200 else each._replace(t=each.t - 60) for k, each in enumerate(samples)]
    set_back[300] = blank(set_back[300])
    watch = Monitor(KENAF, STAIRS)
    on = [bool(watch.feed(each).causes) for each in set_back]
    assert (on.index(True), on[200:].index(False)) == (200, 101)
    assert not any(on[301:])


def test_a_wait_within_a_stated_limit_does_not_change_the_rate():
    samples = twenty_seconds()
    waited = [each if k < 1000 else each._replace(t=each.t + 10) for k, each in enumerate(samples)]
    watch = Liveness(AlarmLimits(no_data_on=60.0))
    for each in waited:
        watch.take(each, judged=True)
    assert watch.rate == pytest.approx(100, rel=0.01)


# --- the streams of a hundred samples a second ----------------------------------------------------


def twenty_seconds():
    return stream(np.random.default_rng(20), 100.0, 20.0)


def blank(sample):
    return sample._replace(inclination=math.nan)


def changed(change):
    return [change(k, sample) for k, sample in enumerate(twenty_seconds())]


BAD = {
    "identical": ("frozen", lambda k, s: Sample(s.t, 0.6, 0.0, 0.0)),
    "nine of ten nan": ("half blind", lambda k, s: s if k % 10 == 9 else blank(s)),
    "every second nan": ("half blind", lambda k, s: s if k % 2 else blank(s)),
    "gap of 60 s": ("silent", lambda k, s: s if k < 1000 else s._replace(t=s.t + 60)),
    "t constant": ("clock", lambda k, s: s._replace(t=0.0)),
    "two clocks": ("clock", lambda k, s: s._replace(t=s.t + 0.25 * (k % 2))),
    "no t": ("clock", lambda k, s: s._replace(t=math.nan)),
    "t in milliseconds": ("clock", lambda k, s: s._replace(t=1e3 * s.t)),
    "t in hours": ("clock", lambda k, s: s._replace(t=s.t / 3600)),
    "all nan": ("no data", lambda k, s: blank(s)),
    "unreadable": ("no data", lambda k, s: Sample(*4 * [math.nan], fault="cells: 3")),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_bad_stream_has_an_alarm_with_its_name(name):
    cause, change = BAD[name]
    answer = kaidan.monitor(KENAF, STAIRS, changed(change))
    assert cause in answer.raised
    assert answer.exit_code == 1
    assert answer.states[-1].alarm or name == "gap of 60 s"


def test_the_healthy_stream_beside_it_has_none():
    answer = kaidan.monitor(KENAF, STAIRS, twenty_seconds())
    assert (answer.alarms, answer.raised, answer.exit_code) == (0, {}, 0)
    assert answer.rate_hz == pytest.approx(100, rel=0.01)  # jitter of 10 % over 500 samples


# --- no false alarm -------------------------------------------------------------------------------

AT_REST = {
    "noise": (0.02 * DEGREE, 0.03 * DEGREE, 0.01),
    "steps": (0.1 * DEGREE, 0.1 * DEGREE, 0.05),
}
CLEAN = {  # rate [Hz], limits, what the stream is like; an hour each
    "5 Hz": (5, AlarmLimits(), {}),
    "7 Hz, jitter": (7, AlarmLimits(), {"jitter": 0.3}),
    "12 Hz": (12, AlarmLimits(), {}),
    "20 Hz, fine steps": (20, AlarmLimits(), {"steps": (0.01 * DEGREE, 0.01 * DEGREE, 0.01)}),
    "30 Hz, coarse steps": (30, AlarmLimits(), {"steps": (0.1 * DEGREE, 0.1 * DEGREE, 0.02)}),
    "100 Hz": (100, AlarmLimits(), {}),
    "at rest, 5 Hz": (5, COARSE, AT_REST),
    "at rest, 20 Hz": (20, COARSE, AT_REST),
    "at rest, 50 Hz": (50, COARSE, AT_REST),
    "at rest, nothing moves": (25, COARSE, {"noise": (0.0, 0.0, 0.0)}),
}


@pytest.mark.parametrize("name", CLEAN)
def test_ten_clean_hours_have_no_alarm(name):
    rate, limits, like = CLEAN[name]
    watch, draw, false = Liveness(limits), np.random.default_rng([10, rate]), []
    for begin in range(0, 3600, 60):
        for sample in stream(draw, rate, 60.0, begin=begin, **like):
            watch.take(sample, judged=True)
            if watch.raised:
                false.append((sample.t, watch.raised))
    assert false == []


@pytest.mark.parametrize("name", CLEAN)
def test_clean_streams_that_come_over_a_network_have_no_alarm(name):
    rate, limits, like = CLEAN[name]
    watch, draw = Liveness(limits), np.random.default_rng([11, rate])
    for sample in stream(draw, rate, 300.0, **like):
        # up to 20 ms later, never two out of order
        arrived = sample.t + draw.uniform(0.0, min(0.02, 0.5 / rate))
        assert not watch.overdue(arrived)
        watch.take(sample, judged=True, arrived=arrived)
        assert watch.raised == ()


def test_stamps_as_coarse_as_two_samples_are_clean():
    for decimals, rate in ((3, 200.0), (2, 200.0), (1, 20.0)):
        watch = Liveness(AlarmLimits())
        for sample in stream(np.random.default_rng(1), rate, 20.0):
            watch.take(sample._replace(t=round(sample.t, decimals)), judged=True)
            assert watch.raised == ()
        assert watch.rate == pytest.approx(rate, rel=0.02)  # one of 100 samples at an end


def test_samples_that_arrive_in_bundles_are_clean():
    """As over a network that begins to send many at once."""
    watch = Liveness(AlarmLimits())
    for k, sample in enumerate(stream(np.random.default_rng(1), 100.0, 20.0)):
        arrived = sample.t if k < 1000 else 0.15 * math.ceil(k / 15) + 1e-4 * (k % 15)
        watch.take(sample, judged=True, arrived=arrived)
        assert watch.raised == ()


def test_one_bad_sample_is_no_alarm():
    for rate in (5.0, 20.0, 200.0):
        samples = stream(np.random.default_rng(3), rate, 5.0)
        samples[round(3 * rate)] = samples[round(3 * rate)]._replace(inclination=math.nan)
        watch = Monitor(KENAF, STAIRS)
        assert not any(watch.feed(sample).alarm for sample in samples)


# --- standing still with a coarse sensor ----------------------------------------------------------


def still(rate_of_inclination):
    return [Sample(0.01 * k, 0.6, rate_of_inclination, 0.0) for k in range(300)]


def test_values_that_stay_the_same_are_explained_by_a_stated_resolution_at_rest_alone():
    # hand: within 0.5 s a rate of 0.2 deg/s makes 0.1 deg
    for rate, limits, raised in (
        (0.0, AlarmLimits(), {"frozen": 1}),
        (0.0, COARSE, {}),
        (0.19 * DEGREE, COARSE, {}),
        (0.21 * DEGREE, COARSE, {"frozen": 1}),
        (-0.21 * DEGREE, COARSE, {"frozen": 1}),
    ):
        assert kaidan.monitor(KENAF, STAIRS, still(rate), limits=limits).raised == raised


# --- slow sources, limits -------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [0.5, 1.0, 2.0, 3.0])
def test_a_source_below_five_samples_a_second_is_an_alarm_unless_the_limit_is_stated(rate):
    samples = stream(np.random.default_rng(1), rate, 60.0)
    assert "silent" in kaidan.monitor(KENAF, STAIRS, samples).raised
    stated = AlarmLimits(no_data_on=3.0 / rate)
    answer = kaidan.monitor(KENAF, STAIRS, samples, limits=stated)
    assert answer.raised == {}
    assert "Hz: below 5 Hz an alarm may come late." in str(answer)
    lost = [*samples[:8], *samples[11:]]  # 4 periods
    assert "silent" in kaidan.monitor(KENAF, STAIRS, lost, limits=stated).raised


def test_the_limit_goes_with_the_period():
    for rate, expected in ((100.0, 0.2), (20.0, 0.2), (10.0, 0.3), (5.0, 0.6)):
        watch = Monitor(KENAF, STAIRS)
        for sample in stream(np.random.default_rng(1), rate, 10.0, jitter=0.0):
            state = watch.feed(sample, sample.t)
        assert state.due_s == pytest.approx(expected, rel=1e-6)
        assert watch.overdue(sample.t + expected - 0.01) is None
        missing = watch.overdue(sample.t + expected)
        assert (missing.status, missing.causes) == ("missing", ("silent",))
        assert (missing.margin_deg, missing.t_s) == (None, None)
    assert watch.feed(sample._replace(t=99.0)).due_s is None  # a recording is never overdue
    assert watch.overdue(1e9) is None


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"unjudged_on": 10.5}, "alarm: unjudged_on is not a known field"),
        ({"no_data_on": -1}, "alarm: no_data_on = -1 s is not within 0.05 to 60 s"),
        ({"no_data_on": math.nan}, "alarm: no_data_on"),
        ({"no_data_on": True}, "alarm: no_data_on"),
        ({"no_data_on": "10"}, "alarm: no_data_on = '10' has no unit; write 10s or 10ms"),
        ({"resolution": 1.0}, "(in degrees? that would be 0.0174533 rad)"),
    ],
)
def test_limits_are_durations_checked_at_the_door(given, said):
    with pytest.raises(InputError) as refused:
        AlarmLimits(**given)
    assert said in str(refused.value)


# --- tipping over ---------------------------------------------------------------------------------


def test_past_zero_it_has_tipped_over_until_good_data_say_otherwise():
    # hand: in the worst position the limit is 60.205 degrees; 70 is past it, 50 far from it
    watch = Monitor(KENAF, STAIRS)
    at = [(0.00, 50.0), (0.05, 70.0), (0.10, math.nan), (0.05, 50.0), (0.15, 58.0), (0.20, 50.0)]
    seen = [watch.feed(Sample(t, math.radians(d), 0.01 * k, 0.0)) for k, (t, d) in enumerate(at)]
    assert [state.causes for state in seen] == [
        (), ("tipped over",), ("tipped over",), ("tipped over",), ("tip-over",), (),
    ]  # fmt: skip
    assert seen[1].time_to_tip_s == 0.0


def test_a_push_that_leaves_it_standing_is_an_alarm_and_no_fall():
    # hand: of 10.2 degrees at rest 5 m/s^2 up the stairs take 13.3, for atan2(12.51, 6.30) is 63.3
    state = Monitor(KENAF, STAIRS).feed(Sample(0.0, math.radians(50), 0.0, 5.0))
    assert state.margin_deg < 0
    assert state.causes == ("tip-over",)


def test_no_alarm_of_tipping_over_is_cleared_while_the_sensor_cannot_be_trusted():
    watch = Monitor(KENAF, STAIRS)
    steep, calm = math.radians(56), math.radians(40)
    for k in range(100):
        watch.feed(Sample(0.01 * k, steep, 0.001 * (k % 2), 0.0))
    behind = [watch.feed(Sample(9.0 + 0.01 * k, calm, 0.001 * (k % 2), 0.0)) for k in range(130)]
    assert behind[50].causes == ("tip-over", "silent", "clock")
    assert behind[-1].causes == ()
