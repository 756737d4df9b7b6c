"""`kaidan monitor`: lines for people, JSON lines, a stream, exit codes and refusals."""

import json
import math
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager

import pytest
from typer.testing import CliRunner

from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.monitor import MonitorAnswer, MonitorState, monitor
from kaidan.verbs.monitor.sources import is_live

SHAPE = ("--angle", "50deg", "--nosing-spacing", "150mm")
HEAD = "t,inclination,inclination_rate,acceleration\n"
CALM = HEAD + "0,0.8,0,0\n0.1,0.81,0.01,0\n"
ROCKING = HEAD + "0,0.8,0,0\n0.1,0.9,1.0,0\n0.2,,1,0\n0.3,1.0,0.5,0\n0.4,0.8,-0.5,0\n"


def run(*arguments, text=None):
    return CliRunner().invoke(app, ["monitor", *map(str, arguments)], input=text)


def refusal(*arguments, text=None):
    result = run(*arguments, text=text)
    assert isinstance(result.exception, InputError)
    return str(result.exception)


@pytest.fixture
def rocking(tmp_path):
    file = tmp_path / "rocking.csv"
    file.write_text(ROCKING)
    return file


def test_lines_for_people(rocking):
    # hand: 60.205 degrees less 45.84, 51.57, 57.30, 45.84; (60.205 - 51.566) / 57.3 s
    result = run("kenaf", *SHAPE, rocking)
    assert result.exit_code == 1
    assert result.stdout.splitlines() == [
        "     t [s]  margin [deg]  over its  tips in [s]  alarm",
        "     0.000         +14.4  downhill            -  no",
        "     0.100          +8.6  downhill         0.15  ALARM",
        "     0.200             -  -                   -  ALARM  not-finite: inclination is nan",
        "     0.300          +2.9  downhill         0.10  ALARM",
        "     0.400         +14.4  downhill            -  no",
        "",
        "5 samples, 1 not judged (20 %); lowest margin +2.9 deg at t = 0.300 s; alarm raised "
        "once, first at t = 0.100 s",
        "The first not judged: inclination is nan",
    ]


def test_no_alarm(tmp_path):
    result = run("kenaf", *SHAPE, "-", text=CALM)
    assert result.exit_code == 0
    assert result.stdout.endswith("lowest margin +13.8 deg at t = 0.100 s; alarm never raised\n")


def test_json_lines_are_the_states_and_the_answer(rocking):
    result = run("kenaf", *SHAPE, rocking, "--json")
    assert result.exit_code == 1
    *lines, total = result.stdout.splitlines()
    stairs = Stairs.inclined(angle=math.radians(50), nosing_spacing=0.15)
    answer = monitor(Robot.named("kenaf"), stairs, rocking)
    assert tuple(map(MonitorState.model_validate_json, lines)) == answer.states
    summary = MonitorAnswer.from_json(total)
    assert summary == answer.model_copy(update={"states": (), "stairs": summary.stairs})
    assert json.loads(lines[1])["row"] == 3
    assert json.loads(lines[0])["time_to_tip_s"] is None


def test_only_changes(rocking):
    result = run("kenaf", *SHAPE, rocking, "--changes", "--json")
    rows = [json.loads(line)["row"] for line in result.stdout.splitlines()[:-1]]
    assert rows == [2, 3, 4, 5, 6]
    calm = run("kenaf", *SHAPE, "-", "--changes", "--json", text=CALM)
    assert len(calm.stdout.splitlines()) == 2


def test_outside_the_model():
    result = run("kenaf", "ibc", "-", text=HEAD + "0,,0,0\n1,0.5,0,0\n2,,0,0\n")
    assert result.exit_code == 3
    assert result.stdout.splitlines()[-1] == (
        "OUTSIDE THE MODEL  p = 0.3309 m is more than L / 2 = 0.235 m"
    )
    assert run("kenaf", "ibc", "-", "--json", text=CALM).exit_code == 3


def test_flippers_payload_and_facing_count():
    at = ("absolem", "ibc", "-", "--flippers", "flat", "--json")
    text = HEAD + "0,0.5,0,0\n"

    def margin(*more, text=text):
        result = run(*at, *more, text=text)
        return json.loads(result.stdout.splitlines()[0])["margin_downhill_deg"]

    # hand: 50.5 degrees as the README's example says, less 0.5 rad
    assert margin() == pytest.approx(50.5 - math.degrees(0.5), abs=0.05)
    assert margin("--payload", "5kg@500mm,300mm") < margin()
    nose_down = margin("--direction", "down", text=HEAD + "0,-0.5,0,0\n")
    assert nose_down != pytest.approx(margin())
    assert nose_down > 0


def test_own_limits():
    keen = run(
        "kenaf", *SHAPE, "-", "--alarm-margin", "15deg", "--clear-margin", "16deg", text=CALM
    )
    assert keen.exit_code == 1
    blind = run(
        "kenaf", *SHAPE, "-", "--alarm-margin", "0deg", "--alarm-time", "0s", "--clear-time",
        "100ms", "--horizon", "0.1s", text=ROCKING,
    )  # fmt: skip
    assert blind.exit_code == 0


def test_refusals(rocking, tmp_path):
    assert refusal("kenaf", *SHAPE, tmp_path / "nope.csv").endswith(
        "nope.csv: cannot be read: No such file or directory"
    )
    (tmp_path / "photo.csv").write_bytes(b"\xff\xd8\xff")
    assert refusal("kenaf", *SHAPE, tmp_path / "photo.csv").endswith(
        "photo.csv: cannot be read: not a text file"
    )
    assert refusal("kenaf", *SHAPE, "-", text=HEAD) == "no samples came"
    assert refusal("kenaf", *SHAPE, rocking, "--strict") == "samples, row 4: inclination is nan"
    assert refusal("kenaf", *SHAPE, "-", text="0,1,2,3\n").startswith(
        "standard input, line 1: columns t, inclination, inclination_rate, acceleration are missing"
    )
    assert refusal("kenaf", "ibc", rocking, rocking).startswith("too many arguments: ibc ")
    assert refusal("kenaf", *SHAPE, rocking, "--alarm-time", "1") == (
        "--alarm-time '1' has no unit; write 1s or 1ms"
    )
    assert refusal("kenaf", "ibc", *SHAPE, rocking).startswith("give either the stairs 'ibc' or ")


def test_most_samples_not_judged_is_no_answer(tmp_path):
    result = run("kenaf", *SHAPE, "-", text=CALM + "0.12,x,0,0\n0.14,,0,0\n0.16,0.8,0\n")
    assert result.exit_code == 2
    assert result.stdout.splitlines()[-3:] == [
        "5 samples, 3 not judged (60 %); lowest margin +13.8 deg at t = 0.100 s; alarm never "
        "raised",
        "The first not judged: inclination = 'x' is not a number",
        "NO ANSWER  Fewer than half of the samples could be judged: no alarm means nothing.",
    ]


def test_a_garbled_row_is_counted_and_the_next_one_taken(tmp_path):
    file = tmp_path / "garbled.csv"
    file.write_bytes((CALM + "0.2,\0\xff,1\n").encode("latin-1") + b"0.3,1.05,0,0\n")
    result = run("kenaf", *SHAPE, file, "--changes")
    assert result.exit_code == 1
    assert "The first not judged: cells: 3, the head names 4" in result.stdout
    assert refusal("kenaf", *SHAPE, file, "--strict") == (
        "samples, row 4: cells: 3, the head names 4"
    )


@contextmanager
def piped(*words):
    """The command on a pipe that stays open."""
    command = [sys.executable, "-m", "kaidan", "monitor", "kenaf", *SHAPE, "-", *words]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    kept = signal.getsignal(signal.SIGINT)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores it
    try:
        process = subprocess.Popen(command, encoding="utf-8", **pipes)
    finally:
        signal.signal(signal.SIGINT, kept)
    with process:
        yield process


def sent(process, text):
    process.stdin.write(text)
    process.stdin.flush()


def rows(count, begin=0.0):
    """Rows of a sensor of 100 Hz that is alive."""
    return "".join(f"{begin + 0.01 * k:.2f},0.8,{1e-3 * (k % 2)},0\n" for k in range(count))


def test_a_stream_is_answered_line_by_line():
    """A live sensor: the first answer comes before the second sample is sent."""
    with piped("--json") as process:
        sent(process, HEAD + "0,0.8,0,0\n")
        assert json.loads(process.stdout.readline())["alarm"] is False
        sent(process, "0.1,1.05,0,0\n")
        assert json.loads(process.stdout.readline())["alarm"] is True
        process.stdin.close()
        assert process.wait(timeout=60) == 1


def test_a_pipe_that_stops_is_an_alarm_while_it_is_open():
    with piped("--json") as process:
        sent(process, HEAD + rows(30))
        for _ in range(30):
            last = json.loads(process.stdout.readline())
        begin = time.monotonic()
        missing = json.loads(process.stdout.readline())
        assert time.monotonic() - begin < 5.0  # 0.2 s, on a machine that has other things to do
        assert (last["alarm"], last["due_s"]) == (False, 0.2)
        assert (missing["status"], missing["causes"], missing["row"]) == ("missing", ["silent"], 31)
        sent(process, rows(130, begin=9.0))
        back = [json.loads(process.stdout.readline()) for _ in range(130)]
        assert "silent" in back[0]["causes"]
        process.stdin.close()
        total = json.loads(process.stdout.readline())
        assert total["raised"]["silent"] >= 1
        assert process.wait(timeout=60) == 1


@pytest.mark.skipif(sys.platform == "win32", reason="skipped: no such signals")
def test_a_pipe_that_stopped_is_left_with_the_summary():
    with piped("--changes") as process:
        sent(process, HEAD + rows(30))
        while "silent" not in process.stdout.readline():
            pass
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=60) == 1
        said = process.stdout.read()
        assert "alarm raised once, first in row 31\nSILENT  No sample came in time." in said
        assert process.stderr.read() == ""


def test_a_recording_in_a_pipe_or_a_file_is_not_measured_by_the_clock(tmp_path):
    with piped("--recorded") as process:
        sent(process, HEAD + rows(30))
        time.sleep(0.8)
        sent(process, rows(30, begin=0.3))
        process.stdin.close()
        assert process.wait(timeout=60) == 0
    file = tmp_path / "calm.csv"
    file.write_text(HEAD + rows(60))
    assert not is_live(file)
    assert is_live(file, follow=True)
    assert is_live("serial:/dev/ttyUSB0")
    assert is_live(os.devnull) == (os.name == "posix")


def test_own_limits_of_the_sensor():
    slow = HEAD + "".join(f"{k},0.8,{1e-3 * (k % 2)},0\n" for k in range(9))
    assert run("kenaf", *SHAPE, "-", text=slow).exit_code == 1
    assert run("kenaf", *SHAPE, "-", "--no-data", "3s", text=slow).exit_code == 0
    still = HEAD + "".join(f"{0.01 * k},0.8,0,0\n" for k in range(99))
    frozen = run("kenaf", *SHAPE, "-", text=still)
    assert frozen.exit_code == 1
    assert "FROZEN  All values stayed the same. State --resolution" in frozen.stdout
    assert "ALARM  frozen" in frozen.stdout
    assert run("kenaf", *SHAPE, "-", "--resolution", "0.1deg", text=still).exit_code == 0
    refused = run("kenaf", *SHAPE, "-", "--unjudged", "10.5", text=still)
    assert refused.exit_code == 2
