"""`kaidan lab agree`: page, JSON, figure, refusals."""

import json

import jsonschema
import pytest
from typer.testing import CliRunner

from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.lab.cross_check import Agreement

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

STEEP = ("kenaf", "--angle", "58deg", "--nosing-spacing", "150mm", "--resolution", "1deg")


def run(*arguments):
    return CliRunner().invoke(app, ["lab", "agree", *map(str, arguments)])


def refusal(*arguments):
    result = run(*arguments)
    assert isinstance(result.exception, InputError), result.output
    return str(result.exception)


def test_the_page_for_people():
    result = run(*STEEP)
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0] == "AGREE  kenaf on 58 deg at 150 mm, up nose first"
    assert any(line.split()[:5] == ["on", "58.0", "deg", "holds", "holds"] for line in lines)
    assert "  1: one criterion, once as a formula and once on poses: 1e-6 rad." in lines


def test_json_and_figure(tmp_path):
    figure = tmp_path / "agree.svg"
    result = run("ozbot-atr", "--rise", "241mm", "--going", "241mm", "--speed", "0.4m/s",
                 "--resolution", "1deg", "--json", "--figure", figure)  # fmt: skip
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    again = Agreement.from_json(result.stdout)
    assert again.to_dict() == told
    jsonschema.validate(told, Agreement.json_schema())
    assert told["agrees"] is False
    assert told["comparisons"][1]["answers"]["physics"] == "holds"
    out = [each for each in told["differences"] if each["within"] is False]
    assert out
    assert all(each["cause"] for each in out)
    assert figure.read_text().startswith("<?xml")
    assert f"wrote {figure}" in result.stderr


def test_refusals_to_the_letter():
    assert refusal("kenaf", "ibc+ibc") == (
        "agree compares on one flight of stairs; several, or a profile, have no closed form"
    )
    assert refusal(*STEEP, "--begin", "roof") == (
        "--begin 'roof' is not known; known: flight, landing"
    )
    assert refusal("kenaf", "ibc", "--resolution", "20deg") == (
        "--resolution '20deg' is not within 0.01 to 5 deg"
    )
    assert refusal("kenaf", "ibc", "--figure", "a.txt") == (
        "figure 'a.txt': unknown suffix '.txt'; known: .png, .svg, .pdf"
    )
    assert refusal("kenaf") == (
        "no stairs: give a catalogue name (kaidan stairs), a TOML file, --rise with --going, or "
        "--angle with --nosing-spacing"
    )
    assert refusal("kenaf", "ibc", "--flippers", "flat") == "robot 'kenaf' has no flippers"
