"""`kaidan traverse`: the page, the JSON object, own points, files and refusals."""

import json
import re

import pytest
from typer.testing import CliRunner

from kaidan.assessment import assess
from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.terrain.stairs import Stairs

SHORT = ("--rise", "178mm", "--going", "279mm", "--steps", "4")
POINTS = "x,z\n-2,0\n0,0\n0,0.178\n0.279,0.178\n0.279,0.356\n0.558,0.356\n0.558,0.534\n3,0.534\n"


def run(*arguments):
    return CliRunner().invoke(app, ["traverse", *map(str, arguments)])


def refusal(*arguments):
    result = run(*arguments)
    assert isinstance(result.exception, InputError)
    return str(result.exception)


def test_the_page_for_people():
    result = run("marmotte", *SHORT, "--fall-reserve", "3deg")
    assert result.exit_code == 5
    assert result.stdout.startswith("UNSURE  marmotte on 178mm x 279mm, up nose first\n")
    text = result.stdout
    assert "without rotation: no   arrested: yes   arrested with momentum: yes" in text
    assert "nose drops by 3.1 deg about nosing 2, arrested by nosing 3" in text
    assert "stands on the landing" in text
    for phase in ("enter", "traverse", "land"):
        assert any(line.startswith(phase) and "at step" in line for line in text.splitlines())


def test_a_long_flight_is_told_in_few_lines():
    result = run("marmotte", "--rise", "178mm", "--going", "279mm", "--steps", "16",
                 "--flippers", "stowed")  # fmt: skip
    assert "the same 13 times more, from step to step" in result.stdout
    assert len(result.stdout.splitlines()) < 35


def test_a_fall_is_a_no_go():
    result = run("kenaf", *SHORT)
    assert result.exit_code == 1
    assert "falls over its tail" in result.stdout


def test_json_agrees_with_assess():
    result = run("marmotte", *SHORT, "--friction", "1.0", "--json")
    found = json.loads(result.stdout)
    asked = Stairs(name="178mm x 279mm", rise=0.178, going=0.279, steps=4)
    answer = assess("marmotte", asked, friction=1.0)
    for name in ("verdict", "governs", "reason", "phase", "step", "margin_deg"):
        assert found["assessment"][name] == getattr(answer, name)
    assert result.exit_code == answer.exit_code
    phases = found["assessment"]["contact"]["phases"]
    assert [each["phase"] for each in phases] == ["enter", "traverse", "land"]


def test_own_points_are_the_same_stairs(tmp_path):
    file = tmp_path / "scan.csv"
    file.write_text(POINTS)
    own = json.loads(run("marmotte", "--points", file, "--friction", "1", "--json").stdout)
    flight = json.loads(
        run("marmotte", "--rise", "178mm", "--going", "279mm", "--steps", "3", "--friction", "1",
            "--json").stdout
    )  # fmt: skip
    own, flight = own["assessment"], flight["assessment"]
    assert own["question"]["terrain"]["name"] == "scan.csv"
    assert own["verdict"] == flight["verdict"]
    for one, other in zip(own["contact"]["phases"], flight["contact"]["phases"], strict=True):
        # the same corners: rounding of 0.178 + 0.178 only
        assert one["required_friction"] == pytest.approx(other["required_friction"], abs=1e-6)
        assert one["required_friction_step"] == other["required_friction_step"]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("x,z\n0,0\n1,apples\n", "line 3: '1,apples' is not two numbers x,z in metres"),
        ("", "holds no points; write rows x,z in metres"),
        ("0,0\n0,nan\n1,0\n", "bad.csv: profile: point 2 is [0.0, nan], not two finite numbers"),
        (
            "0,0\n0,0\n",
            "bad.csv: profile: needs at least two different points that lead ahead in x",
        ),
    ],
)
def test_bad_points(tmp_path, content, told):
    file = tmp_path / "bad.csv"
    file.write_text(content)
    assert refusal("kenaf", "--points", file).endswith(told)


def test_what_is_refused(tmp_path):
    assert refusal("kenaf", "ibc", "--points", tmp_path / "p.csv") == (
        "give either --points or stairs, not both"
    )
    missing = tmp_path / "none.csv"
    assert refusal("kenaf", "--points", missing) == (
        f"{missing}: cannot be read: No such file or directory"
    )
    assert refusal("kenaf", "ibc", "--poses", "3") == "--poses needs --figure"
    assert "unknown suffix '.bmp'" in refusal("kenaf", "ibc", "--figure", "a.bmp")
    assert "unknown suffix '.avi'" in refusal("kenaf", "ibc", "--animation", "a.avi")


def test_files_are_written(tmp_path):
    figure, pose_map = tmp_path / "side.svg", tmp_path / "map.png"
    result = run("kenaf", *SHORT, "--figure", figure, "--pose-map", pose_map, "--json")
    assert json.loads(result.stdout)["assessment"]["verdict"] == "no-go"
    side, poses = result.stderr.splitlines()
    assert re.fullmatch(rf"wrote {re.escape(str(figure))} \(\d+ kB\)", side)
    assert re.fullmatch(rf"wrote {re.escape(str(pose_map))} \(\d+ x \d+ pixels, \d+ kB\)", poses)
    assert figure.read_bytes().startswith(b"<?xml")
    assert pose_map.read_bytes().startswith(b"\x89PNG")
    assert sorted(tmp_path.iterdir()) == sorted([figure, pose_map])


def test_the_side_view_alone(tmp_path):
    file = tmp_path / "side.png"
    result = run("kenaf", *SHORT, "--side", file, "--json")
    assert result.stderr.startswith(f"wrote {file} (1400 x ")
    assert file.read_bytes().startswith(b"\x89PNG")
