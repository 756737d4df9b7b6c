"""Properties of which every run looks at a part of the examples, with all of them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
FILES = sorted(
    path.name for path in FOLDER.glob("test_*.py") if "max_examples=examples(" in path.read_text()
)


def test_there_are_some():
    assert "test_bad_input.py" in FILES


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_all_examples(name):
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", name],
        cwd=FOLDER,
        env=os.environ | {"HYPOTHESIS_PROFILE": "whole"},
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stdout[-10_000:]
