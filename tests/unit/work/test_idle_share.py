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
    # begins and ends, and how long each process had waited for a processor by then
    spans = {
        1: [(0.0, 2.0, 0.0, 0.0), (2.5, 6.0, 0.0, 0.0), (6.0, 9.0, 0.0, 0.0)],
        2: [(1.0, 4.0, 0.0, 0.5), (5.0, 8.0, 1.25, 1.25)],
    }
    rows = [
        dict(zip(("began", "ended", "queued_began", "queued_ended"), each, strict=True), pid=pid)
        for pid, several in spans.items()
        for each in several
    ]
    # from 1 s, when the second has begun, to 8 s, when it has nothing more: the first is idle for
    # 0.5 s and the second for 1 s, of which it waits 0.75 s for a processor; in all 14 s less 1.25
    assert module.idle_share(rows, 2) == pytest.approx(0.75 / 12.75)
    with pytest.raises(AssertionError, match="a worker did nothing"):
        module.idle_share(rows, 3)
