"""How the command ends: exit codes, one line on standard error, closed pipes, Ctrl-C."""

import os
import signal
import subprocess
import sys
import time

import pytest
from pydantic_core import SchemaError

from kaidan import __version__
from kaidan.cli import INTERNAL, run
from kaidan.robot import Robot

FLIGHT = ["--angle", "40deg", "--nosing-spacing", "150mm"]
QUICK = {
    "assess": ["assess", "kenaf", *FLIGHT, "--friction", "0.8"],
    "json": ["assess", "kenaf", *FLIGHT, "--friction", "0.8", "--json"],
    "campaign": ["lab", "campaign", "-h"],
    "compare": ["compare", "kenaf", "--stairs", "ibc"],
    "experiment": ["lab", "experiment", "-h"],
    "help": ["-h"],
    "margin": ["margin", "kenaf"],
    "monitor": ["monitor", "-h"],
    "new": ["new", "robot", "mine.toml"],
    "outcomes": ["lab", "outcomes"],
    "plane": ["plane", "kenaf", *FLIGHT],
    "posture": ["posture", "absolem", *FLIGHT, "--friction", "0.8"],
    "reproduce": ["lab", "reproduce"],
    "robots": ["robots"],
    "robot": ["robots", "kenaf", "--json"],
    "schema": ["schema", "answer"],
    "stairs": ["stairs"],
    "surfaces": ["surfaces"],
    "traverse": ["traverse", "kenaf", *FLIGHT, "--friction", "0.8", "--json"],
    "version": ["--version"],
}


def process(*words, **more):
    command = [sys.executable, "-m", "kaidan", *words]
    return subprocess.run(command, capture_output=True, timeout=60, check=False, **more)


@pytest.mark.parametrize("name", QUICK)
def test_a_closed_pipe_is_silence_and_0(name, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as closed:
        monkeypatch.setattr(sys, "stdout", closed)
        assert run(QUICK[name]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("words", [["robots"], QUICK["traverse"], ["nonsense"]])
def test_the_whole_process_into_a_closed_pipe(words):
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "kaidan", *words]
    with os.fdopen(writing, "w") as closed:
        done = subprocess.run(command, stdout=closed, stderr=subprocess.PIPE, timeout=60)
        both = subprocess.run(command, stdout=closed, stderr=closed, timeout=60)
    assert done.returncode == both.returncode == (2 if words == ["nonsense"] else 0)
    assert done.stderr.count(b"\n") == (words == ["nonsense"])


def test_without_standard_streams():
    said = b"kaidan: the answer cannot be written: standard output is closed\n"
    for closed, code, err in (
        ("<&-", 0, b""), ("2>&-", 0, b""), (">&-", 2, said), ("<&- >&- 2>&-", 2, b""),
    ):  # fmt: skip
        line = f"{sys.executable} -m kaidan robots {closed}"
        done = subprocess.run(line, shell=True, capture_output=True, timeout=60)
        assert (done.returncode, done.stderr) == (code, err)


def test_a_fault_of_kaidan_is_one_line_and_70(monkeypatch, capsys):
    def breaks(_name):
        raise ZeroDivisionError("a line\nand another")

    monkeypatch.setattr(Robot, "named", breaks)
    monkeypatch.delenv("KAIDAN_DEBUG", raising=False)
    assert run(["robots", "kenaf"]) == INTERNAL == 70
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("kaidan: a fault of kaidan itself, ZeroDivisionError in ")
    assert err.endswith(
        ": a line and another; please report it with the command and what it prints with "
        "KAIDAN_DEBUG=1\n"
    )
    assert err.count("\n") == 1
    monkeypatch.setenv("KAIDAN_DEBUG", "1")
    assert run(["robots", "kenaf"]) == INTERNAL
    err = capsys.readouterr().err
    assert err.startswith("Traceback (most recent call last):\n")
    assert err.count("kaidan: a fault of kaidan itself") == 1


@pytest.mark.parametrize(
    "error",
    [KeyboardInterrupt(), SchemaError("Error building a validator:\n  KeyboardInterrupt: ")],
)
def test_ctrl_c_while_it_works(error, monkeypatch, capsys):
    """Or while pydantic builds a class, which tells of it by an error of its own."""

    def interrupted(_name):
        raise error

    monkeypatch.setattr(Robot, "named", interrupted)
    assert run(["robots", "kenaf"]) == 130
    assert capsys.readouterr() == ("", "kaidan: interrupted\n")


@pytest.mark.parametrize("delay", [0.03, 0.08, 0.13, 0.18, 0.23])
def test_ctrl_c_while_it_starts(delay):
    """Whatever is being imported just then: no traceback, once kaidan's own code runs."""
    command = [sys.executable, "-m", "kaidan", "assess", "kenaf", "ibc"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as begun:
        time.sleep(delay)
        begun.send_signal(signal.SIGINT)
        err = begun.communicate(timeout=60)[1]
    # before Python listens to signals it dies of them, which a shell calls 130 too; so it does
    # after an interrupt in an exec() of some import; and on a quick machine the answer is there
    assert begun.returncode in (130, -signal.SIGINT, 1)
    assert err in (b"", b"kaidan: interrupted\n") or b"in main" not in err


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (
            ["assess", "kenaf", "ibc", "--fricton", "0.8"],
            "no such option: --fricton; did you mean --friction? (see kaidan assess -h)",
        ),
        (["assess", "kenaf", "ibc", "--zz"], "no such option: --zz (see kaidan assess -h)"),
        (["asses"], "no such command 'asses'. Did you mean 'assess'? (see kaidan -h)"),
        (["assess"], "missing argument 'ROBOT' (see kaidan assess -h)"),
        (
            ["new", "robto", "x.toml"],
            "invalid value for 'what': 'robto' is not one of 'robot', 'stairs', 'surface' "
            "(see kaidan new -h)",
        ),
        (
            ["assess", "kenaf", "ibc", "--steps", "many"],
            "invalid value for '--steps': 'many' is not a whole number (see kaidan assess -h)",
        ),
        (
            ["assess", "kenaf", "ibc", "--risk", "low"],
            "invalid value for '--risk': 'low' is not a number (see kaidan assess -h)",
        ),
        (
            ["assess", "kenaf", "ibc", "--trials", "0"],
            "invalid value for '--trials': '0' is less than 1 (see kaidan assess -h)",
        ),
        (
            ["lab", "experiment", "absolem", "--spacings", "0mm"],
            "condition: nosing_spacing = 0 m is not within 0.02 to 2.5 m",
        ),
    ],
)
def test_a_wrong_word_of_the_command_line_is_one_line(words, line, capsys):
    assert run(words) == 2
    assert capsys.readouterr() == ("", f"kaidan: {line}\n")


def test_nothing_asked_shows_the_help(capsys):
    assert run([]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("Usage: kaidan [OPTIONS] COMMAND [ARGS]...\n")


@pytest.mark.parametrize("word", ["--version", "-V"])
def test_version(word, capsys):
    assert run([word]) == 0
    assert capsys.readouterr() == (f"{__version__}\n", "")


def test_the_module_is_the_command():
    assert process("assess", "kenaf", "ibc").returncode == 1
    done = process("robots", "x" * 10_000)
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"kaidan: no robot is called 'xxx")
    assert len(done.stderr) < 400


END = """
import atexit, sys, threading
from kaidan.__main__ import end
atexit.register(print, "done")
if sys.argv[1:]:
    threading.Timer(0.2, print, ["later"]).start()
print("said")
end(3)
"""


@pytest.mark.parametrize("words", [[], ["with a thread"]])
def test_nothing_is_lost_at_the_end_of_the_process(words):
    done = subprocess.run([sys.executable, "-c", END, *words], capture_output=True, timeout=60)
    said = [b"said", *([b"later"] if words else []), b"done"]
    assert (done.returncode, done.stdout.split()) == (3, said)


@pytest.mark.parametrize(
    "name", ["agree", "calibrate", "campaign", "experiment", "outcomes", "physics", "reproduce"]
)
def test_a_command_that_moved_says_where_to(name, capsys):
    assert run([name, "kenaf"]) == 2
    said = f"kaidan: kaidan {name} is now kaidan lab {name} (see kaidan lab -h)\n"
    assert capsys.readouterr() == ("", said)
