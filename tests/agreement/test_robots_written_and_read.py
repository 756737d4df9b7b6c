"""Robots of the catalogue, written as MJCF for trials and read back.

The writer builds its model from the sheet by other code, for another purpose; the reader knows
nothing of it. Six digits stand in the file, of lengths up to 2 m: a band of 2e-5 m. Kenaf has no
published mass, and MARV no track between its flippers, which are no joints there.
"""

import pytest

from kaidan.catalog import names
from kaidan.cli import run
from kaidan.readers import found_in
from kaidan.robot import Posture, Robot

BAND = 2e-5


@pytest.mark.parametrize("posture", ["stowed", "flat"])
@pytest.mark.parametrize(
    "name", [each for each in names("robots") if each not in ("kenaf", "marv")]
)
def test_length_and_centroid_come_back(tmp_path, monkeypatch, name, posture):
    monkeypatch.chdir(tmp_path)
    robot = Robot.named(name)
    if posture == "flat" and not robot.flippers():
        pytest.skip("no flippers to lay flat")
    words = ["lab", "physics", "export", name, "ibc", "--flippers", posture, "--friction", "1"]
    assert run([*words, "--file", "robot.xml"]) == 0
    (one,) = found_in(tmp_path / "robot.xml").robots
    stance = robot.stance(Posture.parse(posture, robot))
    found = {key: figure.value for key, figure in one.figures.items()}
    assert found["mass"] == pytest.approx(robot.mass, rel=1e-5)
    assert found["track.flat_length"] == pytest.approx(stance.flat_length, abs=BAND)
    assert found["com_from_front"] == pytest.approx(stance.com_from_front, abs=BAND)
    assert found["com_height"] == pytest.approx(stance.com_height, abs=BAND)
    if posture == "stowed":
        assert found["track.front_radius"] == pytest.approx(robot.track.front_radius, abs=BAND)
        assert found["track.rear_radius"] == pytest.approx(robot.track.rear_radius, abs=BAND)
        assert len(found.get("track.wheels", ())) == len(robot.track.wheels)
