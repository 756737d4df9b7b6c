import gc
import os
import sys
from functools import cache
from pathlib import Path

import pytest
import typer.testing
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))
os.environ.pop("COLUMNS", None)  # tables as wide as they like, whatever screen runs the tests

# what both workers and a hundred processes import is compiled once
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# no matrix here is worth threads that wait for each other, less so where each core has a worker
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# the whole command line is built once, not in each of a thousand calls of a CliRunner
typer.testing._get_command = cache(typer.main.get_command)

gc.disable()  # ten thousand tests are being collected, and none of them is garbage

# the same examples in every run, so that a check of main says something of main;
# HYPOTHESIS_PROFILE=whole takes all of them (tests/properties/test_all_examples.py), random others
settings.register_profile("same", derandomize=True, deadline=None)
settings.register_profile("whole", derandomize=True, deadline=None)
settings.register_profile("random", deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))


TOGETHER = (
    "tests/web/",  # a browser and a server
    "tests/agreement/test_assess_and_sweep.py", "tests/unit/test_sweeps.py",  # what numba compiles
    "tests/docs/", "tests/unit/test_one_screen.py", "tests/unit/test_plan_search.py",  # answers
)  # fmt: skip
"""Tests that share something: they come first, one after the other, and so in one worker."""


def pytest_collection_modifyitems(items):
    def place(item):
        path = item.path.as_posix()
        return next((k for k, each in enumerate(TOGETHER) if each in path), len(TOGETHER))

    items.sort(key=place)


def pytest_collection_finish():
    gc.freeze()
    gc.enable()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Let whoever is done take over half of what another still has to do."""
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log)
