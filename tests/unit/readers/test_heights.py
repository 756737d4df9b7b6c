"""Stairs in elevation maps of known steps."""

import numpy as np
import pytest

import reader_files as made
from kaidan.readers import found_in
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import heights as interpreter
from kaidan.readers.kinds import Heights, Known, Provenance

KNOWN = Provenance("here", "", "npy", unit=Known("m", "format"), up=Known("+z", "format"))


def steps(cell, turn=0.3, rise=0.17, going=0.29, count=6):
    """Map of a flight that climbs at an angle to the rows."""
    y, x = np.mgrid[-1.5:2.5:cell, -1.5:3.5:cell]
    s, t = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    z = rise * np.clip(np.floor(s / going) + 1, 0, count)
    return np.where(np.abs(t) < 0.6, z, 0.0)


@pytest.mark.parametrize("cell", [0.01, 0.02])
def test_steps_of_a_map(cell):
    noise = np.random.default_rng(0).normal(0, 0.003, steps(cell).shape)
    found = interpreter.found(Heights(steps(cell) + noise, (cell, cell), KNOWN), Hints())
    (flight,) = found.staircases[0].flights
    assert len(flight) == 6
    assert flight.regular.spacing == pytest.approx(np.hypot(0.17, 0.29), abs=0.003)
    assert flight.heading == pytest.approx(0.3, abs=np.radians(1.5))


def test_coarse_cells_are_refused():
    found = interpreter.found(Heights(steps(0.1), (0.1, 0.1), KNOWN), Hints())
    assert str(found.refusals[0]).startswith("Its cells of 100 mm are too coarse")


def test_a_grid_map_in_a_recording(tmp_path):
    pytest.importorskip("rosbags")
    falling = steps(0.02)[::-1, ::-1].T
    path = made.grid_map_bag(falling, 0.02, tmp_path / "map")
    (flight,) = found_in(path).staircases[0].flights
    assert len(flight) == 6


def test_a_flat_map_holds_no_stairs():
    flat = Heights(np.zeros((100, 100)), (0.02, 0.02), KNOWN)
    assert interpreter.found(flat, Hints()).refusals[0].why == "flat"
