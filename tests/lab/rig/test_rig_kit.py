"""The rig kit by hand: the line through measurements, counts of falls, the plan, the files."""

import math
import tomllib

import numpy as np
import pytest
from typer.testing import CliRunner

pytest.importorskip("scipy", reason="skipped: scipy not installed")

from scipy import stats

from kaidan import InputError
from kaidan.cli import app
from kaidan.lab.rig.calibration import RigCalibration, calibrate_rig
from kaidan.lab.rig.design import design, spacings_of
from kaidan.lab.rig.fitting import margins_of, stiffness_of, theta_d_of
from kaidan.lab.rig.protocol import protocol_of
from kaidan.lab.rig.sheet import Measurement, RigSheet, Trials
from kaidan.robot import Robot

KENAF = Robot.named("kenaf").model_copy(update={"mass": 20.0})


def measurements(*pairs):
    return tuple(Measurement(force=force, travel=travel) for force, travel in pairs)


def test_a_line_by_hand():
    # 20 kN/m with the dial off by 1 mm; no scatter, so that the interval has no width
    found = stiffness_of(measurements((0, 0.001), (100, 0.006), (200, 0.011)), "press")
    assert found == (pytest.approx(2e4), pytest.approx(2e4), pytest.approx(2e4))
    assert stiffness_of(measurements((0, 0), (100, 0.005)), "press") is None


def test_a_line_against_scipy():
    force, travel = np.array([20.0, 60, 100, 140, 180]), np.array([0.9, 3.2, 4.8, 7.3, 8.9]) / 1e3
    found = stiffness_of(measurements(*zip(force, travel, strict=True)), "press")
    line = stats.linregress(force, travel)
    half = stats.t.ppf(1 - 0.0125 / 2, 3) * line.stderr
    ends = (1 / line.slope, 1 / (line.slope + half), 1 / (line.slope - half))
    assert found == pytest.approx(ends, rel=1e-9)


def test_readings_that_no_line_goes_through_are_refused():
    with pytest.raises(InputError, match="press: the forces are all 50 N; a line needs several"):
        stiffness_of(measurements((50, 0.1), (50, 0.11), (50, 0.1)), "press")
    with pytest.raises(InputError, match="shear: the travel does not grow with the force"):
        stiffness_of(measurements((50, 0.1), (60, 0.09), (70, 0.08)), "shear")


def test_theta_d_is_of_the_steepest_slope_with_three_readings():
    rows = (
        Trials(nosing_spacing=0.15, angle=0.9, results="hhh", extra=(0.01, 0.02, 0.03)),
        Trials(nosing_spacing=0.15, angle=1.0, results="hhh", extra=(0.04, 0.05, 0.06)),
        Trials(nosing_spacing=0.15, angle=1.05, results="hhf", extra=(0.2, 0.21)),
        Trials(nosing_spacing=0.15, angle=1.1, direction="down", results="hhh", extra=(0.3,) * 3),
    )
    found = theta_d_of(rows)[0.15]
    assert found.value == pytest.approx(0.05)
    # scatter of all rows going up: squares 2e-4, 2e-4 and 5e-5 over 2 + 2 + 1 degrees of freedom
    half = stats.t.ppf(1 - 0.0125 / 2, 5) * math.sqrt(4.5e-4 / 5 / 3)
    assert found.high - found.value == pytest.approx(half)


def test_a_margin_lies_between_what_held_and_what_fell():
    def rows(direction, *counts):
        return tuple(
            Trials(nosing_spacing=0.2, angle=math.radians(at), direction=direction, results=said)
            for at, said in counts
        )

    up = rows("up", (44, "hhhhh"), (46, "hhhff"), (48, "fffff"))
    only = margins_of(up)
    assert only.theta_M is None
    assert math.radians(44) < only.up[0.2].low < only.up[0.2].value < only.up[0.2].high
    assert math.degrees(only.up[0.2].value) == pytest.approx(46.2, abs=0.4)
    down = rows("down", (48, "hhhhh"), (50, "hhhff"), (52, "fffff"))
    # the same counts 4 degrees steeper
    both = margins_of(up + down)
    assert math.degrees(both.theta_M.value) == pytest.approx(4.0, abs=0.2)
    assert both.theta_M.low < math.radians(4.0) < both.theta_M.high
    # what slides tells nothing of tipping
    assert margins_of(rows("up", (44, "sss"))).up == {}


def test_the_plan_tries_where_it_may_go_either_way():
    found = design(KENAF, spacings_of(KENAF), trials=5)
    assert spacings_of(KENAF) == pytest.approx([0.150, 0.180, 0.200, 0.220])
    assert len(found.planned) == 24
    assert {each.condition.direction for each in found.planned} == {"up", "down"}
    margins = dict(zip(spacings_of(KENAF), (60.2, 52.9, 46.2, 37.3), strict=True))
    for each in found.planned:
        near = margins[each.condition.nosing_spacing]
        assert abs(math.degrees(each.condition.angle) - near) < 10.0
        assert each.gain > 0.0
    # more trials tell more, and never less than none
    more = design(KENAF, spacings_of(KENAF), trials=20).expected
    for name, (before, after) in found.expected.items():
        assert more[name][1] < after < before


def test_what_is_planned_beats_as_many_conditions_evenly_spread():
    best = design(KENAF, [0.2], trials=5, count=6)
    spread = design(KENAF, [0.2], trials=5, count=100)
    assert len(spread.planned) == 36  # all there are: 38 to 55 degrees, both ways
    # six of 36 conditions tell more than half of what all tell
    gained = sum(each.gain for each in best.planned) / sum(each.gain for each in spread.planned)
    assert gained > 0.5


def test_a_robot_that_no_rig_can_tip_is_refused():
    with pytest.raises(InputError, match="no nosing spacing has a margin of kenaf between 10 and"):
        design(KENAF, [0.4])


def test_the_files_go_round(tmp_path):
    sheet, robot = tmp_path / "plan.toml", tmp_path / "mine.toml"
    page = sheet.with_suffix(".md")
    robot.write_text(KENAF.to_toml(), encoding="utf-8")
    run = CliRunner().invoke
    done = run(app, ["lab", "experiment", str(robot), "--protocol", str(page), "--trials", "4"])
    assert done.exit_code == 0, done.output
    said = page.read_text(encoding="utf-8")
    assert "IMU" in said
    assert "Camera" in said
    assert "| 150 | 60 | up | 4 |" in said
    blank = run(app, ["lab", "calibrate", str(sheet)])
    assert isinstance(blank.exception, InputError)
    assert "travel is still to be filled in" in str(blank.exception)
    table = tomllib.loads(sheet.read_text(encoding="utf-8"))
    lines = [f'robot = "{robot.name}"', "mass = 20.0"]
    for name, k in (("press", 2e4), ("shear", 1e4)):
        for at, row in enumerate(table[name]):
            force = float(row["force"].removesuffix("N"))
            lines += [f"[[{name}]]", f"force = {force}", f"travel = {force / k + 1e-5 * (at % 2)}"]
    for row in table["trials"]:
        steep = float(row["angle"].removesuffix("deg"))
        edge = {"150mm": 57.5, "180mm": 50.5, "200mm": 44.5, "220mm": 35.5}[row["nosing_spacing"]]
        holds = steep < edge + (2.0 if row["direction"] == "down" else 0.0)
        tilts = ["2.0deg", "2.2deg", "2.1deg"] if holds and row["direction"] == "up" else []
        lines += ["[[trials]]", *(f'{key} = "{row[key]}"' for key in
                  ("nosing_spacing", "angle", "direction")),
                  f'results = "{"hhhh" if holds else "ffff"}"', f"extra = {tilts}"]  # fmt: skip
    sheet.write_text("\n".join(lines), encoding="utf-8")
    done = run(app, ["lab", "calibrate", str(sheet)])
    assert done.exit_code == 0, done.output
    found = calibrate_rig(RigSheet.of_file(sheet).model_copy(update={"robot": str(robot)}))
    assert RigCalibration.from_json(found.to_json()) == found
    written = Robot.named(str(robot))
    assert written.track.stiffness == pytest.approx(2e4, rel=0.01)
    assert written.track.shear_stiffness == pytest.approx(1e4, rel=0.01)
    assert math.degrees(written.theta_d.high) == pytest.approx(found.theta_d_deg.high, abs=0.01)
    assert written.theta_M.high >= written.theta_M.low
    assert written.sources["track.stiffness"].startswith("M: kaidan lab calibrate ")
    # again, into the same sheet: the same
    assert run(app, ["lab", "calibrate", str(sheet)]).exit_code == 0
    assert Robot.named(str(robot)) == written


def test_nonsense_is_refused(tmp_path):
    with pytest.raises(InputError, match="results = 'hhx': 'x' is none of h"):
        Trials(nosing_spacing=0.15, angle=1.0, results="hhx")
    with pytest.raises(InputError, match="extra has 2 measurements of 1 trials that held"):
        Trials(nosing_spacing=0.15, angle=1.0, results="hff", extra=(0.01, 0.02))
    with pytest.raises(InputError, match="nothing is filled in"):
        calibrate_rig(RigSheet(robot="kenaf", mass=20.0))
    with pytest.raises(InputError, match="cannot be read"):
        RigSheet.of_file(tmp_path / "none.toml")
    run = CliRunner().invoke
    wrong = run(app, ["lab", "experiment", "kenaf", "--protocol", str(tmp_path / "a.txt")])
    assert str(wrong.exception).startswith(str(tmp_path / "a.txt"))
    assert run(app, ["lab", "calibrate", "compliances"]).exit_code == 2


def test_a_robot_of_unknown_mass_leaves_the_forces_open():
    made = protocol_of("kenaf", Robot.named("kenaf"))
    assert "20 to 100 % of the weight" in made.page
    assert 'force = "FILL IN"' in made.sheet
