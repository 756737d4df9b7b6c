"""Properties of which every run looks at a part of the examples, with all of them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
FILES = sorted(
    str(path.relative_to(TESTS))
    for path in TESTS.rglob("test_*.py")
    if path != Path(__file__) and "max_examples=examples(" in path.read_text(encoding="utf-8")
)


def test_there_are_some():
    assert "properties/test_bad_input.py" in FILES
    assert Path(__file__).name not in {Path(name).name for name in FILES}  # it would run itself


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_all_examples(name):
    done = subprocess.run(
        [
            sys.executable,
            *["-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "-m"],
            "not slow",
            name,
        ],
        cwd=TESTS,
        env=os.environ | {"HYPOTHESIS_PROFILE": "whole"},
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stdout[-10_000:]
