"""`kaidan lab calibrate`: pages, JSON, figures, refusals; the physics is known by rule."""

import json

import pytest
from typer.testing import CliRunner

from calibration_cases import falls_from
from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.lab.calibration import bench

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")


@pytest.fixture(autouse=True)
def known_physics(monkeypatch):
    """Falls from 55.5 deg up and 62 deg down; turns 2.6 deg at 32 kN/m."""
    runner = falls_from(
        lambda spec: 62.0 if spec.question.direction == "down" else 55.5,
        lambda spec: 2.6 * 32e3 / getattr(spec.track, "stiffness", 1e9),
    )
    monkeypatch.setattr(bench, "in_store", lambda folder, **how: runner)


def run(*arguments):
    return CliRunner().invoke(app, ["lab", "calibrate", *map(str, arguments)])


def refusal(*arguments):
    result = run(*arguments)
    assert isinstance(result.exception, InputError), result.output
    return str(result.exception)


def test_compliance(tmp_path):
    figure = tmp_path / "fit.svg"
    page = run("compliance", "--figure", figure)
    assert page.exit_code == 0, page.output
    lines = page.stdout.splitlines()
    assert lines[0] == "kenaf, sprung-noses: 108 candidates, 5 trials a condition, seed 0"
    assert any(line.split()[:3] == ["stiffness", "32", "kN/m"] for line in lines)
    assert any(line.startswith("  NO   blind: theta_M at 150 mm 6.0 deg") for line in lines)
    assert any(line.startswith("  Not reproduced: fitted: falls at 150 mm") for line in lines)
    assert figure.read_text().startswith("<?xml")
    told = json.loads(run("compliance", "--stiffness", "32,90kN/m", "--json").stdout)
    assert told["intervals"][0]["best"] == 32e3
    assert told["evidence"]["theta_d"]["extra"] == 2.6
    assert not all(line["reproduced"] for line in told["lines"])


def test_grousers():
    page = run("grousers", "--drawn", 64, "--tried", 4)
    assert page.exit_code == 0, page.output
    assert "64 tracks drawn; closed forms leave 35; 4 tried in dynamics" in page.stdout


@pytest.mark.parametrize("spacing", ["150mm", "600mm"])
def test_effects(tmp_path, spacing):
    figure, csv = tmp_path / "effects.png", tmp_path / "effects.csv"
    page = run("effects", "--nosing-spacing", spacing, "--figure", figure, "--csv", csv)
    assert page.exit_code == 0, page.output
    assert page.stdout.startswith(f"kenaf: theta_M at {spacing[:3]} mm over the grousers; 3 trials")
    assert figure.read_bytes().startswith(b"\x89PNG")
    rows = csv.read_text().splitlines()
    assert rows[0].startswith("varied,value,up_deg")
    assert len(rows) == 1 + 1 + 4 + 4 + 4 + 4


def test_effects_as_json():
    told = json.loads(run("effects", "--json").stdout)
    assert told["effects"][1]["theta_M_deg"] == pytest.approx(6.0, abs=2.0)  # the grid's step


def test_refusals_to_the_letter():
    assert refusal("compliance", "--ground", "lava") == (
        "--ground 'lava' is not known; known: steps, noses"
    )
    assert refusal("compliance", "--stiffness", "30") == (
        "--stiffness '30' has no unit; write 30N/m or 30kN/m or 30N/mm"
    )
    assert refusal("effects", "--step", "9deg") == "--step '9deg' is not within 0.1 to 5 deg"
    assert refusal("effects", "--about", "10mm") == (
        "--about '10mm': write HEIGHT,SPACING,STIFFNESS,FRICTION"
    )
