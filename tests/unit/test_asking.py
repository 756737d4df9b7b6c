"""``kaidan new --ask``: questions, answers from a pipe and from a terminal, and no waiting."""

import os
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from kaidan.cli import app, asking
from kaidan.errors import InputError
from kaidan.robot import Robot
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

WEIGHED = ["Scout", "26.1kg", "620mm", "90mm", "8cm", "283mm", "118mm", "", "0.5m/s", "n", "n", ""]


def new(what, file, *answers):
    result = CliRunner().invoke(
        app, ["new", what, str(file), "--ask"], input="".join(f"{line}\n" for line in answers)
    )
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result


def test_a_robot_is_asked_for_and_its_sheet_works(tmp_path):
    file = tmp_path / "scout.toml"
    done = new("robot", file, *WEIGHED)
    assert "L: length of the flat underside of the track (50 mm to 5000 mm)?" in done.stderr
    assert "C  centroid" in done.stderr
    assert f"next: kaidan assess {file} STAIRS" in done.stdout
    robot = Robot.named(str(file))
    assert (robot.title, robot.mass, robot.drive.max_speed) == ("Scout", 26.1, 0.5)
    assert (robot.track.flat_length, robot.track.rear_radius) == (0.62, 0.08)
    assert (robot.com_from_front, robot.com_height, robot.com_range) == (
        pytest.approx(0.283),
        pytest.approx(0.118),
        None,
    )
    assert 'flat_length = "620mm"' in file.read_text()


def test_who_has_not_weighed_it_states_a_range_or_takes_that_of_known_robots(tmp_path):
    file = tmp_path / "scout.toml"
    done = new("robot", file, *WEIGHED[:5], "", "200mm", "", "", "150mm", "", "", "n", "n", "")
    assert "[186mm]" in done.stderr  # 0.3 x 620 mm
    assert "[216mm]" in done.stderr  # 2.4 x 90 mm
    span = Robot.named(str(file)).com_range
    assert span.from_front == (0.2, 0.372)
    assert span.height == (0.09, 0.15)


def test_flippers_are_asked_for(tmp_path):
    file = tmp_path / "scout.toml"
    pair = ["y", "300mm", "90mm", "40mm", "90mm", "1.5kg", ""]
    done = new("robot", file, *WEIGHED[:9], *pair, "n", "grousers", "12mm", "")
    assert "front flippers, distance from the pivot to the axle of the tip" in done.stderr
    robot = Robot.named(str(file))
    assert (robot.track.belt, robot.track.grouser_height) == ("grousers", 0.012)
    assert robot.track.grouser_spacing is None
    assert (robot.front_flippers.length, robot.front_flippers.mass) == (0.3, 1.5)
    assert (robot.front_flippers.max_speed, robot.rear_flippers) == (None, None)


def test_stairs_and_surfaces_are_asked_for(tmp_path):
    stairs, surface = tmp_path / "s.toml", tmp_path / "m.toml"
    new("stairs", stairs, "Cellar", "18cm", "11in", "14", "165mm", "", "", "", "")
    flight = Stairs.named(str(stairs))
    assert (flight.rise, flight.going, flight.steps) == (0.18, pytest.approx(0.2794), 14)
    assert flight.first_rise == 0.165
    done = new("surface", surface, "", "0.5", "0.7")
    assert f"next: kaidan assess ROBOT STAIRS --surface {surface}" in done.stdout
    assert Surface.named(str(surface)).friction_high == 0.7


def test_a_turn_asks_for_what_it_takes(tmp_path):
    file = tmp_path / "s.toml"
    flight = ("Cellar", "18cm", "28cm", "9", "", "", "")
    new("stairs", file, *flight, "quarter", "1m", "1.2m", "1.1m", "", "", "half", "1.2m", "2.1m",
        "", "0.7m")  # fmt: skip
    stairs = Stairs.named(str(file))
    assert (stairs.lower_turn, stairs.upper_turn, stairs.width) == ("quarter", "half", 1.0)
    assert (stairs.lower_landing, stairs.lower_landing_width) == (1.2, 1.1)
    assert (stairs.upper_landing, stairs.upper_landing_width) == (1.2, 2.1)
    assert (stairs.upper_passage, stairs.upper_leaf) == (None, 0.7)


@pytest.mark.parametrize(
    ("answers", "text"),
    [
        (
            WEIGHED[:2],
            "the answers end before track.flat_length; give one a line, an empty line where it is "
            "left out",
        ),
        (
            [*WEIGHED[:2], "620"],
            "robot: track: flat_length '620' has no unit; write 620mm or 620cm or 620m",
        ),
        (
            [*WEIGHED[:2], "62m"],
            "robot: track: flat_length = 62m is not within 50 mm to 5000 mm",
        ),
        ([*WEIGHED[:-1], "rough"], "robot: track: belt = rough is not one of smooth, grousers"),
        ([*WEIGHED[:9], "300mm"], "front_flippers: 300mm is neither y nor n"),
        (
            [*WEIGHED, "", "12mm"],
            "'12mm' answers no question: a line for each, an empty one where it is left out",
        ),
        ([*WEIGHED[:2], ""], "robot: track: flat_length '' is no length; write for example 180mm"),
    ],
)
def test_answers_without_meaning_are_refused_and_nothing_is_written(answers, text, tmp_path):
    with pytest.raises(InputError) as caught:
        new("robot", tmp_path / "x.toml", *answers)
    assert str(caught.value) == text
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="a pipe cannot be waited for there")
def test_a_silent_pipe_is_not_waited_for(tmp_path):
    code = (
        "from kaidan.cli import asking, run\n"
        "asking.PATIENCE = 0.2\n"
        f"raise SystemExit(run(['new', 'robot', {str(tmp_path / 'x.toml')!r}, '--ask']))"
    )
    read, write = os.pipe()
    try:
        done = subprocess.run(
            [sys.executable, "-c", code], stdin=read, capture_output=True, text=True, timeout=60
        )
    finally:
        os.close(read)
        os.close(write)
    assert done.returncode == 2
    assert "no answer came within 0.2 s" in done.stderr


def test_on_a_terminal_a_question_is_put_again(monkeypatch, tmp_path, capsys):
    class Terminal:
        def __init__(self, *lines):
            self.lines = list(lines)

        def isatty(self):
            return True

        def readline(self):
            return f"{self.lines.pop(0)}\n" if self.lines else ""

    monkeypatch.setattr(sys, "stdin", Terminal("", "0.9", "much", "0.5", "0.7"))
    assert asking.ask(Surface) == {"friction_low": 0.9, "friction_high": 0.5}
    assert "is not a plain number" in capsys.readouterr().err
    monkeypatch.setattr(sys, "stdin", Terminal(""))
    with pytest.raises(InputError, match="the answers end before friction_low"):
        asking.ask(Surface)


ASKING = (
    "import sys; from kaidan.cli import asking; from kaidan.__main__ import main; "
    "asking.PATIENCE = 0.5; main()"
)


def asked_through(tmp_path, source):
    """The command with what a shell command writes to it; its exit code and what it says."""
    words = f"'{sys.executable}' -c '{ASKING}' new surface x.toml --ask"
    done = subprocess.run(
        ["sh", "-c", f"{source} | {words}"], cwd=tmp_path, capture_output=True, text=True,
        timeout=60, check=False,
    )  # fmt: skip
    return done.returncode, done.stderr.splitlines()[-1]


@pytest.mark.parametrize("answers", ["yes y", "yes ''", "cat /dev/zero", "printf 'Mat\\n0.5\\n'"])
def test_it_ends_whatever_a_pipe_says(tmp_path, answers):
    code, said = asked_through(tmp_path, answers)
    assert code == 2
    assert said.startswith("kaidan: ")
    assert len(said) < 300


def test_a_pipe_that_stays_open_need_not_end(tmp_path):
    """Who answers by program and keeps the pipe waits for the sheet, not the sheet for the end."""
    code, _ = asked_through(tmp_path, "(printf 'Mat\\n0.5\\n0.7\\n'; sleep 3)")
    assert code == 0
    assert Surface.named(str(tmp_path / "x.toml")).friction_low == 0.5
