"""`kaidan margin`: the numbers behind the curve, the files, the refusals."""

import csv
import io
import json
import math

import jsonschema
import numpy as np
import pytest
from typer.testing import CliRunner

import kaidan
from kaidan.assessment import assess
from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.figures.margin_figure import margin_figure
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.margin_curve import (
    MarginCurve,
    catalogue_stairs,
    margin_curve,
    question_of,
)


def run(*arguments):
    return CliRunner().invoke(app, ["margin", *arguments])


def test_the_curve_of_kenaf():
    # paper: 60.2 at 150 mm; hand: atan((L - p - C_L)/C_N), atan((p - C_L)/C_N)
    p = np.array([0.15, 0.18, 0.20, 0.22, 0.235, 0.24])
    curve = margin_curve(question_of("kenaf"), p)
    upper = [math.degrees(math.atan((0.470 - x - 0.196) / 0.071)) for x in p[:5]]
    lower = [math.degrees(math.atan((x - 0.196) / 0.071)) for x in p[:5]]
    assert curve.margin_angle_deg[:5] == pytest.approx(upper, abs=1e-9)  # rounding
    assert curve.lower_angle_deg[2:5] == pytest.approx(lower[2:], abs=1e-9)
    assert curve.lower_angle_deg[:2] == (None, None)  # no slope is too gentle
    assert round(curve.margin_angle_deg[0], 1) == 60.2
    assert curve.contacts_n == (3, 2, 2, 2, 2, 1)
    assert curve.margin_angle_deg[5] is None
    assert curve.lower_angle_deg[5] is None


def test_the_corrected_margin_is_equation_24():
    # paper: theta_d 2.6, theta_M 1.2-2.6 at 150 mm give 55.0-56.4
    allowances = {"theta_d": math.radians(2.6), "theta_M": (math.radians(1.2), math.radians(2.6))}
    curve = margin_curve(question_of("kenaf", **allowances), np.array([0.150, 0.220]))
    low, high = curve.margin_angle_corrected_low_deg[0], curve.margin_angle_corrected_high_deg[0]
    assert (round(low, 1), round(high, 1)) == (55.0, 56.4)
    for raised in (curve.lower_angle_corrected_low_deg, curve.lower_angle_corrected_high_deg):
        assert raised[1] - curve.lower_angle_deg[1] == pytest.approx(2.6, abs=1e-9)  # theta_d only


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("acceleration", [0.0, 0.7, -1.3])
def test_the_curve_agrees_with_assess(direction, facing, acceleration):
    asked = {
        "direction": direction,
        "facing": facing,
        "acceleration": acceleration,
        "flippers": "flat",
    }
    stairs = Stairs.named("ibc")
    curve = margin_curve(
        question_of("absolem", **asked), np.array([stairs.nosing_spacing])
    ).columns()
    answer = assess("absolem", stairs, model="closed-form", **asked).closed_form
    assert curve["margin_angle_deg"][0] == pytest.approx(answer.margin_angle_deg, abs=1e-9)
    if answer.lower_angle_deg is None:
        assert curve["lower_angle_deg"][0] is None
    else:
        assert curve["lower_angle_deg"][0] == pytest.approx(answer.lower_angle_deg, abs=1e-9)


def test_nose_first_down_is_the_mirrored_robot():
    # hand: atan(46 / 71) = 32.9 deg
    result = run("kenaf", "--direction", "down", "--from", "150mm", "--to", "200mm", "--points",
                 "2", "--json")  # fmt: skip
    found = json.loads(result.stdout)
    assert round(found["margin_angle_deg"][0], 1) == 32.9
    assert found["com_from_uphill_end_m"] == pytest.approx(0.274, abs=1e-12)
    assert found["allowances"]["theta_M"] == {
        "low_deg": 0.0,
        "high_deg": 0.0,
        "source": "not applicable",
    }


def test_json_and_csv_hold_the_same_columns(tmp_path):
    table = tmp_path / "m.csv"
    result = run("kenaf", "--json", "--csv", str(table), "--codes")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert result.stderr == f"wrote {table}\n"
    rows = list(csv.DictReader(io.StringIO(table.read_text())))
    for name in rows[0]:
        values = [None if row[name] == "" else float(row[name]) for row in rows]
        assert values == found[name]
    spacings = found["nosing_spacing_m"]
    assert spacings[0] == 0.05
    assert spacings[-1] >= 0.34  # past the largest code's spacing
    assert np.diff(spacings) == pytest.approx(0.005, abs=1e-9)
    outside = [
        p for p, angle in zip(spacings, found["margin_angle_deg"], strict=True) if angle is None
    ]
    assert min(outside) == 0.24
    assert found["model"] == "closed-form"
    names = {each["name"] for each in found["stairs"]}
    assert {"ibc", "ada", "osha", "japan-dwelling"} <= names
    assert not any(each["inside_model"] for each in found["stairs"])  # bare Kenaf on real stairs


def test_the_page_for_people():
    result = run("kenaf", "--from", "150mm", "--to", "250mm", "--points", "3")
    assert result.exit_code == 0
    lines = [line.split() for line in result.stdout.splitlines()]
    assert ["150", "3", "60.2", "54.9", "-", "-"] in lines
    assert ["200", "2", "46.2", "40.9", "3.2", "5.9"] in lines
    assert ["250", "1", "-", "-", "-", "-"] in lines
    assert "The closed form ends at p = L/2 = 235 mm" in result.stdout
    assert result.stdout.rstrip("\n") == str(
        kaidan.margin("kenaf", start=0.15, to="250mm", points=3)
    )


def test_an_answer_read_back_is_equal_and_fits_its_schema():
    curve = kaidan.margin("absolem", flippers="flat", stairs=["ibc"], theta_d=0.02)
    assert MarginCurve.from_json(curve.to_json()) == curve
    jsonschema.validate(curve.to_dict(), MarginCurve.json_schema())
    assert "<td>flat_length_m</td>" in curve._repr_html_()


@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_figures_are_written(tmp_path, suffix):
    path = tmp_path / f"m.{suffix}"
    result = run("absolem", "--flippers", "flat", "--codes", "--figure", str(path))
    assert result.exit_code == 0
    assert path.stat().st_size > 5000
    assert f"wrote {path}" in result.stdout


def test_every_figure_asked_for_is_written(tmp_path):
    files = [tmp_path / f"m.{suffix}" for suffix in ("png", "svg", "pdf")]
    result = run("kenaf", *(word for file in files for word in ("--figure", str(file))))
    assert result.exit_code == 0
    assert all(file.stat().st_size > 5000 for file in files)
    told = [line for line in result.stdout.splitlines() if line.startswith("wrote ")]
    assert [line.partition(" (")[0] for line in told] == [f"wrote {file}" for file in files]
    assert all(line.endswith(" kB)") for line in told)


@pytest.mark.parametrize("robot", ["kenaf", "marv", "ozbot-atr", "csiro-dtr"])
@pytest.mark.parametrize("acceleration", [-9.8, -3.0, 0.0, 9.8])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_any_question_can_be_drawn(robot, acceleration, direction):
    p = np.linspace(0.03, 0.8, 50)
    question = question_of(robot, acceleration=acceleration, direction=direction)
    assert margin_figure(margin_curve(question, p)).axes


def test_a_range_wholly_outside_the_model_can_be_drawn(tmp_path):
    result = run("kenaf", "--from", "300mm", "--to", "400mm", "--figure", str(tmp_path / "m.png"))
    assert result.exit_code == 0


def test_no_name_leaves_the_picture():
    p = np.linspace(0.05, 0.36, 200)
    figure = margin_figure(margin_curve(question_of("kenaf"), p, catalogue_stairs()))
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in figure.axes[0].texts if text.get_text()]
    for box in boxes:
        assert box.x0 >= 0
        assert box.x1 <= figure.bbox.width
    for index, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:index])


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["kenaf", "--figure", "m.bmp"],
         "figure 'm.bmp': unknown suffix '.bmp'; known: .png, .svg, .pdf"),
        (["kenaf", "--from", "200mm", "--to", "100mm"],
         "--from 200 mm is not less than --to 100 mm"),
        (["kenaf", "--from", "200"], "--from '200' has no unit; write 200mm or 200cm or 200m"),
        (["kenaf", "--from", "0mm"], "--from '0mm' is not within 10mm to 5m"),
        (["kenaf", "--csv", "/proc/no/m.csv"],
         "/proc/no/m.csv: cannot be written: No such file or directory"),
        (["kenaf", "--csv", "m.png", "--figure", "m.png"],
         "m.png is to be written twice, with different contents"),
        (["kenaf", "--facing", "sideways"],
         "facing = 'sideways' is not known; known: nose-first, tail-first"),
    ],
)  # fmt: skip
def test_bad_input(arguments, text):
    with pytest.raises(InputError) as caught:
        CliRunner().invoke(app, ["margin", *arguments], catch_exceptions=False)
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["absolem", "--flippers=-30deg,-30deg"], "a flipper reaches below the underside"),
        (["marv"], "512 mm in the middle of the underside have no track"),
    ],
)
def test_what_the_closed_form_cannot_judge_is_outside_the_model(arguments, text, tmp_path):
    path, table = tmp_path / "m.png", tmp_path / "m.csv"
    result = run(*arguments, "--figure", str(path), "--csv", str(table), "--json")
    assert result.exit_code == 3
    assert text in json.loads(result.stdout)["outside"]
    assert not path.exists()
    rows = list(csv.DictReader(io.StringIO(table.read_text())))
    assert {row["margin_angle_deg"] for row in rows} == {""}  # never a number
    assert f"OUTSIDE THE MODEL: {text}" in run(*arguments).stdout
