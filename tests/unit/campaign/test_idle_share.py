"""The benchmark's busy share of two workers, from begins and ends put in by hand."""

import importlib.util
from pathlib import Path

import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

FOLDER = Path(__file__).parents[3] / "benchmarks"


def test_idle_is_what_lies_between_trials_apart_from_start_and_end(monkeypatch):
    monkeypatch.syspath_prepend(FOLDER)
    spec = importlib.util.spec_from_file_location("experiment_benchmark", FOLDER / "experiment.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    spans = {1: [(0.0, 2.0), (2.5, 6.0), (6.0, 9.0)], 2: [(1.0, 4.0), (4.0, 8.0)]}
    rows = [
        {"pid": pid, "began": began, "ended": ended}
        for pid, each in spans.items()
        for began, ended in each
    ]
    # from 1 s, when the second has begun, to 8 s, when it has nothing more: 0.5 of 14 s
    assert module.idle_share(rows, 2) == pytest.approx(0.5 / 14.0)
    with pytest.raises(AssertionError, match="a worker did nothing"):
        module.idle_share(rows, 3)
