"""Public models of robots, where their files are given: what other people read from them.

Expected: the robots' published masses (38 and 150 kg, osrf/subt) and the figures of the
catalogue, which were summed from the same files by hand before this reader was written.
"""

import os
from pathlib import Path

import pytest

from kaidan.readers import found_in
from kaidan.robot import Robot

MM = 1e-3
"""The catalogue's figures are given in whole millimetres, its notes in tenths."""


def robot(variable):
    path = os.environ.get(variable, "")
    if not path:
        pytest.skip(f"file not given: {variable}")
    (one,) = found_in(Path(path)).robots
    return one


def value(one, key):
    return one.figures[key].value


def test_absolem_with_its_flippers_up():
    one = robot("KAIDAN_ABSOLEM_SDF")
    listed = Robot.named("absolem")
    assert value(one, "mass") == pytest.approx(38.698, abs=5e-4)
    assert value(one, "track.flat_length") == pytest.approx(0.500, abs=MM)
    assert value(one, "com_from_front") == pytest.approx(0.279, abs=MM)
    assert value(one, "com_height") == pytest.approx(0.184, abs=MM)
    assert value(one, "inertia") == pytest.approx(1.036, abs=MM)
    assert value(one, "track.gauge") == pytest.approx(listed.track.gauge, abs=MM)
    pair = one.robot().front_flippers
    for name in ("length", "root_radius", "tip_radius", "mass", "com_from_pivot", "max_speed"):
        assert getattr(pair, name) == pytest.approx(getattr(listed.front_flippers, name), abs=MM)


def test_absolem_as_the_file_has_it():
    lengths = robot("KAIDAN_ABSOLEM_SDF").as_in_file
    assert lengths["flat_length"] == pytest.approx(1.141, abs=MM)
    assert lengths["com_from_front"] == pytest.approx(0.599, abs=MM)
    assert lengths["com_height"] == pytest.approx(0.180, abs=MM)
    assert lengths["front_radius"] == pytest.approx(0.029, abs=MM)


def test_ozbot_and_its_raised_idlers():
    one = robot("KAIDAN_OZBOT_SDF")
    assert value(one, "mass") == pytest.approx(146.34, abs=5e-3)
    assert value(one, "track.flat_length") == pytest.approx(1.045, abs=MM)
    assert value(one, "com_from_front") == pytest.approx(0.438, abs=MM)
    assert value(one, "com_height") == pytest.approx(0.308, abs=MM)
    assert (value(one, "track.front_radius"), value(one, "track.rear_radius")) == (0.14, 0.11)
    front = value(one, "track.wheels")[0]
    listed = Robot.named("ozbot-atr").track.wheels[0]
    assert front["from_front"] == pytest.approx(listed.from_front, abs=MM)
    assert front["height"] == pytest.approx(listed.height, abs=MM)
