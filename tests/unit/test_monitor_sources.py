"""Where samples come from: recordings of ROS, serial lines, files that grow; live states."""

import math
import os
import sys
import threading
import time
from itertools import pairwise
from types import SimpleNamespace

import pytest

import kaidan
from climbs import SLOPE, climb, csv_of, imu_of, recording
from kaidan import InputError, Question, Stairs
from kaidan.cli import run
from kaidan.errors import MissingExtraError
from kaidan.verbs.monitor import Monitor, Sample, open_samples
from kaidan.verbs.monitor.arrivals import MOST_WAITING, Arrivals
from kaidan.verbs.monitor.live import LiveMonitor
from kaidan.verbs.monitor.recordings import sample_of_imu

FLIGHT = Stairs.inclined(angle=SLOPE, nosing_spacing=0.150)


def message(**parts):
    return SimpleNamespace(
        **{key: SimpleNamespace(**each) if isinstance(each, dict) else each
           for key, each in parts.items()}
    )  # fmt: skip


@pytest.mark.parametrize("yaw", [0.0, 2.0, -3.0])
@pytest.mark.parametrize("roll", [0.0, 0.3])
def test_an_imu_message_is_the_sample_that_it_was_made_of(yaw, roll):
    for row in climb(seconds=4.0, rate=3.0):
        found = sample_of_imu(imu_of(message, row, yaw=yaw, roll=roll), row.t)
        # rounding of sines and of the square root in the angle
        assert found.inclination == pytest.approx(row.inclination, abs=1e-7)
        assert found.inclination_rate == pytest.approx(row.inclination_rate, abs=1e-12)
        assert found.acceleration == pytest.approx(0.0, abs=1e-6)  # at rest nothing but gravity


def test_acceleration_counts_up_the_stairs_and_an_unknown_orientation_is_a_fault():
    given = imu_of(message, climb()[0])
    given.linear_acceleration.x += 0.5
    assert sample_of_imu(given, 0.0).acceleration == pytest.approx(0.5)
    assert sample_of_imu(given, 0.0, nose_up=False).acceleration == pytest.approx(-0.5)
    given.orientation_covariance[0] = -1.0
    assert sample_of_imu(given, 0.0).fault == "the message has no orientation"


@pytest.mark.parametrize("mcap", [True, False], ids=["mcap", "db3"])
def test_a_recording_is_monitored_like_the_file_of_the_same_climb(tmp_path, mcap):
    pytest.importorskip("rosbags", reason="skipped: rosbags not installed")
    rows = climb()
    (tmp_path / "climb.csv").write_text(csv_of(rows))
    file = recording(rows, tmp_path / "climb", mcap=mcap)
    plain = kaidan.monitor("kenaf", FLIGHT, tmp_path / "climb.csv")
    for path in (file, tmp_path / "climb"):
        found = kaidan.monitor("kenaf", FLIGHT, path)
        assert found.alarms == plain.alarms == 1
        assert found.first_alarm_t_s == plain.first_alarm_t_s
        assert found.lowest_margin_deg == pytest.approx(plain.lowest_margin_deg, abs=1e-4)


def test_a_recording_needs_one_topic(tmp_path):
    pytest.importorskip("rosbags", reason="skipped: rosbags not installed")
    two = recording(climb(seconds=3), tmp_path / "two", topics=("/a", "/b"))
    with pytest.raises(InputError, match=r"topics of sensor_msgs/msg/Imu: /a, /b; give a file"):
        kaidan.monitor("kenaf", FLIGHT, two)
    (tmp_path / "damaged.mcap").write_bytes(b"\x89MCAP0\r\n" + b"x" * 100)
    with pytest.raises(InputError, match=r"damaged\.mcap"):
        kaidan.monitor("kenaf", FLIGHT, tmp_path / "damaged.mcap")


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="skipped: no pseudo-terminals")
def test_a_serial_line_is_followed():
    pytest.importorskip("serial", reason="skipped: pyserial not installed")
    master, slave = os.openpty()
    try:
        with open_samples(f"serial:{os.ttyname(slave)}") as samples:
            os.write(master, csv_of(climb(seconds=3)[:2]).encode())
            found = [next(samples), next(samples)]
    finally:
        os.close(master)
        os.close(slave)
    assert [each.t for each in found] == [0.0, 0.05]


def test_a_serial_line_that_is_none_or_without_the_package(monkeypatch, capsys):
    pytest.importorskip("serial", reason="skipped: pyserial not installed")
    assert run(["monitor", "kenaf", "ibc", "serial:/dev/nowhere:9600"]) == 2
    assert "serial:/dev/nowhere:9600: cannot be opened" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "serial", None)
    with (
        pytest.raises(MissingExtraError, match=r"kaidan\[serial\]"),
        open_samples("serial:/dev/nowhere"),
    ):
        pass


def test_a_file_that_grows_is_followed_line_by_line(tmp_path):
    file = tmp_path / "growing.csv"
    head, first, second = csv_of(climb()[:2]).splitlines()
    file.write_text(f"{head}\n{first}\n{second[:5]}")

    def go_on():
        time.sleep(0.2)
        with file.open("a") as opened:
            opened.write(f"{second[5:]}\n")

    writer = threading.Thread(target=go_on)
    with open_samples(file, follow=True) as samples:
        assert next(samples).t == 0.0
        writer.start()
        assert next(samples).t == 0.05
    writer.join()


def test_a_live_source_is_read_in_the_background():
    go_on = threading.Event()

    def source():
        yield from (Sample(0.01 * k, 0.5, 0.0, 0.0) for k in range(MOST_WAITING + 5))
        go_on.wait(60)
        raise InputError("it broke")

    arrivals, taken = Arrivals(source()), []
    while len(taken) < MOST_WAITING + 5:
        came = arrivals.take()
        assert 0 < len(came) <= MOST_WAITING  # as many as a server takes at once
        taken += came
    assert [each.sample.t for each in taken] == [0.01 * k for k in range(MOST_WAITING + 5)]
    assert all(a.at <= b.at for a, b in pairwise(taken))
    assert arrivals.take(0.05) == []
    go_on.set()
    for _ in range(2):
        with pytest.raises(InputError, match="it broke"):
            arrivals.take(60)
    ended = Arrivals(iter([Sample(0.0, 0.5, 0.0, 0.0)]))
    assert len(ended.take(60)) == 1
    assert ended.take(60) is None


def test_live_states_are_those_of_the_monitor_with_tilt_and_phase(tmp_path):
    (tmp_path / "climb.csv").write_text(csv_of(climb()))
    watch, plain = (
        LiveMonitor(Question.of("kenaf", FLIGHT)),
        Monitor.of(Question.of("kenaf", FLIGHT)),
    )
    phases = []
    with open_samples(tmp_path / "climb.csv") as samples:
        for sample in samples:
            state, expected = watch.feed(sample), plain.feed(sample)
            assert state.model_dump(exclude={"tilt_deg", "phase"}) == expected.model_dump()
            assert state.tilt_deg == pytest.approx(math.degrees(sample.inclination))
            phases.append(state.phase.value)
    assert list(dict.fromkeys(phases)) == ["enter", "traverse"]
    assert watch.answer() == plain.answer()


def test_going_down_the_uphill_end_is_up_all_the_same():
    down = Question.of("kenaf", FLIGHT, direction="down", facing="nose-first")
    assert not down.nose_up
    watch = LiveMonitor(down)
    state = watch.feed(Sample(0.0, -SLOPE, 0.0, 0.0))
    assert (state.tilt_deg, state.phase.value) == (pytest.approx(math.degrees(SLOPE)), "traverse")
