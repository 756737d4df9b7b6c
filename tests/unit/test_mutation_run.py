"""The mutation tool on a small module: what it counts as noticed, and what it does not."""

import json
import os
import subprocess
import sys
from pathlib import Path

TOOL = Path(__file__).parents[2] / "benchmarks" / "mutation.py"
CODE = """\
def rises(a, b):
    return a <= b


def falls(a, b):
    return a >= b
"""
TESTS = """\
import os

from thing import falls, rises

LEFT = []


def test_alone():
    assert rises(1, 2)
    assert os.getsid(0) != os.getpid(), "in the fork of a mutant, whatever it changes"


def test_first():
    LEFT.append(rises(1, 1))


def test_after_another():
    assert sum(rises(k, k + 1) for k in range(10_000)) == 10_000
    assert all(LEFT)


def test_falls():
    assert falls(1, 1)
"""


def test_only_what_fails_alone_for_the_change_counts(tmp_path):
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "thing.py").write_text(CODE)
    (tmp_path / "test_thing.py").write_text(TESTS)
    done = subprocess.run(
        [sys.executable, TOOL, "--of", "src/thing.py", "--out", "out.jsonl", "--", "test_thing.py"],
        cwd=tmp_path, env=os.environ | {"PYTHONPATH": "src"}, capture_output=True, text=True,
        check=True, timeout=100,
    )  # fmt: skip
    alone = "left out, as it fails alone on unchanged code: test_thing.py::test_alone"
    assert [line for line in done.stdout.splitlines() if "left out" in line] == [alone]
    found = [json.loads(line) for line in (tmp_path / "out.jsonl").read_text().splitlines()]
    outcomes = {(each["function"], each["after"]): each["outcome"] for each in found}
    assert outcomes == {("rises", "a < b"): "survives", ("falls", "a > b"): "killed"}
