"""The answer on one screen, whatever the verdict: eight lines or fewer, and a picture offered."""

import math
import re
from functools import cache
from itertools import pairwise

import pytest
from typer.testing import CliRunner

import kaidan
from answered import each_once
from kaidan.cli import app
from kaidan.modes import FAILURE_MODES
from kaidan.text import assessment as text
from kaidan.text.assessment import LINES

CASES = {
    "GO": ["kenaf", "--angle", "50deg", "--nosing-spacing", "150mm", "--friction", "2"],
    "GO of uncertain figures": [
        "kenaf", "--angle", "45deg", "--nosing-spacing", "150mm", "--friction", "2",
        "--uncertainty", "com_from_front=5mm,angle=0.5deg",
    ],
    "ROUGH": ["absolem", "ibc", "--friction", "1", "--flippers", "24deg,-7.5deg"],
    "UNSURE by friction": ["absolem", "ibc", "--flippers", "flat", "--surface", "concrete-dry"],
    "UNSURE, no friction stated": ["absolem", "ada", "--flippers", "flat"],
    "UNSURE until weighed": ["taurob-tracker", "ibc", "--friction", "1.2"],
    "UNSURE by friction, planned": ["absolem", "ibc", "--surface", "concrete-dry"],
    "NO-GO": ["absolem", "ibc", "--flippers", "stowed"],
    "NO-GO of a robot that nobody weighed": [
        "quince", "--angle", "70deg", "--nosing-spacing", "200mm", "--friction", "1",
    ],
    "OUTSIDE THE MODEL": ["kenaf", "ibc", "--model", "closed-form"],
}  # fmt: skip


@cache
def shown(*words):
    """Lines of an answer; several tests look at the same ones."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", ["kaidan", "assess", *words])
        each_once(patch)
        result = CliRunner().invoke(app, ["assess", *words])
    assert result.exit_code in (0, 1, 3, 4, 5), result.output
    return result.stdout.splitlines()


@pytest.mark.parametrize("case", CASES)
def test_it_fits_one_screen_and_the_verdict_comes_first(case):
    lines = shown(*CASES[case])
    label = case.partition(" by")[0].partition(",")[0].partition(" until")[0].partition(" of")[0]
    assert lines[0].startswith(f"{label}  ")
    assert len(lines) <= LINES
    assert len(shown(*CASES[case], "--short")) == 1
    assert len(shown(*CASES[case], "--details")) > LINES


def test_a_rough_answer_says_what_to_secure_before_anything_else():
    lines = shown(*CASES["ROUGH"])
    assert lines[2].split() == [
        "first", "Secure", "payload,", "arm", "and", "antennas:", "it", "rocks.",
        "Keep", "people", "off", "the", "flight", "below.",
    ]  # fmt: skip


def test_of_what_is_no_go_even_so_nothing_is_to_be_measured_or_done():
    slope = ("--nosing-spacing", "150mm", "--friction", "2", "--uncertainty", "com_height=5mm")
    go, no_go = (
        shown("kenaf", "--angle", angle, *slope, "--details") for angle in ("45deg", "60deg")
    )
    assert [any(line.startswith("  measure  ") for line in lines) for lines in (go, no_go)] == [
        1,
        0,
    ]
    planned = shown("quince", "osha-ship", "--friction", "1", "--details")
    assert planned[0].startswith("NO-GO")
    assert "  The best plan, NO-GO even so" in planned
    assert "  What to do" not in planned


def test_the_margin_of_a_robot_that_is_too_wide_is_no_margin_of_tipping():
    stairs = kaidan.Stairs(name="narrow", rise=0.17, going=0.29, steps=4, width=0.5)
    answer = kaidan.assess("ozbot-atr", stairs, friction=1.2)
    assert (answer.verdict, answer.governs) == ("no-go", "narrow")
    assert "  margin          -90.0 deg (narrow: no slope would do), on 30.4 deg" in str(answer)


def test_a_picture_is_offered_after_a_no_go_and_the_command_draws_it(monkeypatch, tmp_path):
    words = CASES["NO-GO"]
    monkeypatch.chdir(tmp_path)
    offered = next(line for line in shown(*words) if line.startswith("  see"))
    command = offered.split()[2:]
    assert command[0] == "traverse"
    assert CliRunner().invoke(app, command).exit_code == 1
    assert (tmp_path / "traverse.png").stat().st_size > 10_000
    assert not any(line.startswith("  see") for line in shown(*CASES["GO"]))


@pytest.mark.parametrize("case", CASES)
def test_the_margin_is_that_of_the_mode_it_names(case):
    line = next((line for line in shown(*CASES[case]) if line.startswith("  margin ")), "")
    found = re.match(r"  margin +([+-][\d.]+) deg \((\w+)\)", line)
    if found is None:
        assert not line or "not known" in line
        return
    key = found.group(2)
    assert FAILURE_MODES[key].unit == "rad"
    rows = [each for each in shown(*CASES[case], "--details") if each.startswith(f"  {key} ")]
    if "uncertain" not in case:  # of several uncertain modes together it is less than of each
        assert rows[0].split()[1] == found.group(1)


@pytest.mark.parametrize("robot", ["absolem", "ozbot-atr", "superdroid-hd2"])
def test_the_margin_ranks_stairs(robot):
    """Of one nosing spacing, the steeper ones have the smaller margin, whatever the verdict."""
    flights = [
        kaidan.Stairs.inclined(angle=math.radians(angle), nosing_spacing=0.3, steps=8)
        for angle in range(18, 60, 6)
    ]
    cells = kaidan.compare([robot], flights, friction=1.2, flippers="flat").cells
    margins = [cell.margin_deg for cell in cells]
    assert all(then <= first + 1e-6 for first, then in pairwise(margins))  # 1e-6: the root search
    assert margins[-1] < margins[0] - 5


def test_of_a_robot_that_falls_before_a_step_no_friction_of_zero_is_shown():
    lines = shown("ozbot-atr", "osha-ship", "--friction", "0.5", "--direction", "down")
    assert "It falls over its downhill end (enter, step 12)." in lines[1]
    (line,) = (each for each in lines if each.lstrip().startswith("friction"))
    assert line.split(None, 1)[1] == (
        "none required as far as it gets (enter, step 12), 0.50 stated"
    )


def test_no_line_names_a_step_that_nobody_knows():
    # what a belly lies on has a phase and no step
    answer = kaidan.assess("marv", "ibc", friction=0.8)
    belly = answer.findings["high_centring"]
    assert (belly.holds, belly.step) == (False, None)
    assert "None" not in text.short(answer) + text.text(answer) + text.details(answer)
