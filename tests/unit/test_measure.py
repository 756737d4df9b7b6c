"""Measuring a robot and stairs: figures, doubt, sheets, and what is refused."""

import json
import math
import tomllib

import pytest
from typer.testing import CliRunner

import kaidan
from kaidan.catalog.completing import completed
from kaidan.catalog.template import blank_toml
from kaidan.cli import app, run
from kaidan.errors import InputError
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.measure_robot import RobotMeasurement, measure_robot
from kaidan.verbs.measure_stairs import StairsMeasurement, measure_stairs
from one_posture import assess

ROUNDING = 1e-9
L, C_L, C_N, MASS = 0.62, 0.28, 0.15, 26.0
"""A robot; what its scales show follows by moments about the rear support."""


def shown(phi, front_inset=0.0, rear_inset=0.0):
    """Masses on the front and rear scale at an inclination, by hand: moments about the rear bar."""
    ahead = (L - rear_inset - C_L) * math.cos(phi) - C_N * math.sin(phi)
    span = (L - rear_inset - front_inset) * math.cos(phi)
    front = MASS * ahead / span
    return {"front": front, "rear": MASS - front}


@pytest.mark.parametrize("phi", [20, 35, -15])
@pytest.mark.parametrize("insets", [(0.0, 0.0), (0.05, 0.1)])
def test_two_scales_level_and_on_a_slope_give_the_robot_back(phi, insets):
    level, slope = shown(0.0, *insets), shown(math.radians(phi), *insets)
    found = measure_robot(
        flat_length=L, front_scale=level["front"], rear_scale=level["rear"], slope=f"{phi}deg",
        front_on_slope=slope["front"], rear_on_slope=slope["rear"],
        front_inset=insets[0], rear_inset=insets[1],
    )  # fmt: skip
    assert found.mass.value == pytest.approx(MASS, abs=ROUNDING)
    assert found.com_from_front.value == pytest.approx(C_L, abs=ROUNDING)
    assert found.com_height.value == pytest.approx(C_N, abs=ROUNDING)


@pytest.mark.parametrize(("over", "arm"), [("rear", L - C_L), ("front", C_L)])
@pytest.mark.parametrize(("on", "radius"), [("end", 0.09), ("ramp", 0.0)])
def test_a_balance_point_and_the_angle_at_which_it_tips(over, arm, on, radius):
    phi = math.atan2(arm, C_N - radius)
    found = measure_robot(
        flat_length="620mm", balance="28cm", mass="26kg", tips_at=phi, over=over, on=on,
        front_radius="90mm", rear_radius="90mm",
    )  # fmt: skip
    assert found.com_height.value == pytest.approx(C_N, abs=ROUNDING)
    assert found.over == over


def test_the_doubt_of_two_scales_by_hand():
    """C_L = L r / (f + r): du = L/(f+r)^2 hypot(r, f) u_m for the scales, r/(f+r) u_L for the tape,
    and each support as far off as the tape errs, by its share of the load."""
    found = measure_robot(
        flat_length=0.5, front_scale=12.0, rear_scale=8.0, u_scale=0.1, u_tape=0.001
    )
    scales = 0.5 / 20.0**2 * math.hypot(12.0, 8.0) * 0.1
    tape = math.hypot(0.4, 0.6, 0.4) * 0.001
    # the scales are no straight input: differences over one uncertainty err by (u/m)^2
    assert found.com_from_front.uncertainty == pytest.approx(math.hypot(scales, tape), rel=1e-4)
    assert sum(found.com_from_front.shares.values()) == pytest.approx(1.0)
    assert found.mass.uncertainty == pytest.approx(0.1 * math.sqrt(2.0))
    assert found.flat_length.uncertainty == pytest.approx(0.001)


def test_a_steeper_slope_halves_the_doubt_of_the_height():
    def doubt(phi):
        level, slope = shown(0.0), shown(phi)
        return measure_robot(
            flat_length=L, front_scale=level["front"], rear_scale=level["rear"], slope=phi,
            front_on_slope=slope["front"], rear_on_slope=slope["rear"], u_angle=0.0,
        ).com_height.uncertainty  # fmt: skip

    gentle, steep = math.atan(0.2), math.atan(0.4)
    # the scales and supports alone: 1/tan, but for a few per cent as the loads shift
    assert doubt(steep) == pytest.approx(doubt(gentle) / 2, rel=0.05)


LEVEL = {"flat_length": "0.5m", "front_scale": "12kg", "rear_scale": "8kg"}


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"flat_length": "500"}, "flat_length '500' has no unit; write 500mm or 500cm or 500m"),
        ({"flat_length": "500m"}, "flat_length = 500 m is not within 0.05 to 5 m"),
        ({"front_scale": "-1kg"}, "front_scale = -1 kg is not within 0 to 5000 kg"),
        (
            {"rear_scale": None},
            "rear_scale: missing; state what two scales show under the front and the rear of the "
            "flat, or the balance point",
        ),
        ({"balance": "20cm"}, "give either two scales or a balance point, not both"),
        ({"slope": "20deg"}, "a slope needs slope, front_on_slope and rear_on_slope together"),
        (
            {"slope": "1deg", "front_on_slope": "11kg", "rear_on_slope": "9kg"},
            "slope = 1 deg is too gentle to say how high the centroid is; take 15 deg or more",
        ),
        (
            {"slope": "20deg", "front_on_slope": "13kg", "rear_on_slope": "7kg"},
            "com_height = -69 mm is not within 5 to 3000 mm: nose up, the rear scale must show "
            "more than on the level",
        ),
        (
            {"tips_at": "70deg"},
            "rear_radius is missing: balanced on its rear end, the robot stands on that disc",
        ),
        ({"tips_at": "2deg"}, "tips_at = 2 deg is not within 5 to 130 deg"),
        ({"front_scale": "0kg", "rear_scale": "0kg"},
         "front_scale and rear_scale show nothing together"),
        ({"u_scale": "-1g"}, "u_scale = -0.001 kg is not within 0 to 20 kg"),
    ],
)  # fmt: skip
def test_what_is_refused(given, text):
    with pytest.raises(InputError) as caught:
        measure_robot(**LEVEL | given)
    assert str(caught.value) == text


def test_scales_that_disagree_about_the_mass_are_noted():
    slope = {"slope": "20deg", "front_on_slope": "10kg", "rear_on_slope": "11kg"}
    (note,) = measure_robot(**LEVEL, **slope).notes
    assert note.startswith("The scales show 20.00 kg once and 21.00 kg another time")


def test_totals_give_the_steps_and_the_doubt_of_the_slope():
    """atan2(H/n, G/(n-1)): du = cos sin hypot(1/H, 1/G) u."""
    found = measure_stairs(
        total_rise="2.73m", total_going="4.2m", risers=16, first_rise="165mm", last_rise="182mm",
    )  # fmt: skip
    assert found.rise_m == pytest.approx((2.73 - 0.165 - 0.182) / 14, abs=ROUNDING)
    assert found.going_m == pytest.approx(0.28, abs=ROUNDING)
    plain = measure_stairs(total_rise=2.72, total_going=4.2, risers=16, u_tape=0.002)
    slope = math.atan2(0.17, 0.28)
    by_hand = math.sin(slope) * math.cos(slope) * math.hypot(1 / 2.72, 1 / 4.2) * 0.002
    assert math.radians(plain.angle_of_totals_deg) == pytest.approx(by_hand, rel=1e-5)
    assert plain.rise_spread_m == pytest.approx(0.0095 / math.sqrt(12))
    assert plain.rise_spread_from == "assumed"


def test_spot_checks_say_how_single_steps_differ():
    rises = ["171mm", "168mm", "170mm", "170mm"]
    found = measure_stairs(total_rise="2.72m", total_going="4.2m", risers=16, rises=rises)
    # sum of squares 1 + 4 + 0 + 0 over k - 2 = 2
    assert found.rise_spread_m == pytest.approx(math.sqrt(5 / 2) * 1e-3, abs=ROUNDING)
    assert found.rise_spread_from == "spot checks"
    assert found.going_spread_from == "assumed"
    local = math.hypot(
        found.rise_spread_m * math.cos(math.radians(found.angle_deg)),
        found.going_spread_m * math.sin(math.radians(found.angle_deg)),
    )
    assert math.radians(found.angle_of_a_step_deg) == pytest.approx(local / found.nosing_spacing_m)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"risers": 2}, "risers = 2 is not a whole number within 3 to 10000"),
        ({"risers": "9" * 5000},
         f"risers = '{'9' * 56}... is not a whole number within 3 to 10000"),
        (
            {"rises": ["195mm"]},
            "rise check of 195 mm is 25 mm off the 170 mm of the total rise and the number of "
            "risers: count the risers again, and state first and last riser apart",
        ),
        ({"total_rise": "272cm", "risers": 4},
         "stairs: rise = 0.68 m is not within 0.02 to 0.6 m (in feet? that would be 0.207264 m)"),
    ],
)  # fmt: skip
def test_what_is_refused_of_stairs(given, text):
    with pytest.raises(InputError) as caught:
        measure_stairs(**{"total_rise": "2.72m", "total_going": "4.2m", "risers": 16} | given)
    assert str(caught.value) == text


def test_the_answers_are_read_back_equal_and_public():
    robot = kaidan.measure_robot(**LEVEL)
    stairs = kaidan.measure_stairs(total_rise=2.72, total_going=4.2, risers=16)
    assert RobotMeasurement.from_json(robot.to_json()) == robot
    assert StairsMeasurement.from_json(stairs.to_json()) == stairs
    assert "C_N         not known: weigh it again on a slope" in str(robot)


SCALES = ["--length", "500mm", "--front-scale", "12kg", "--rear-scale", "8kg"]
SLOPE = ["--slope", "20deg", "--front-on-slope", "10.544kg", "--rear-on-slope", "9.456kg"]


def words(*args):
    result = CliRunner().invoke(app, ["measure", *map(str, args)])
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.stdout


def test_a_robot_sheet_is_written_and_completed(tmp_path):
    file = tmp_path / "own.toml"
    text = words("robot", file, *SCALES, *SLOPE)
    assert "to do: " in text
    assert "front_radius is still to be filled in" in text
    with pytest.raises(InputError, match="front_radius is still to be filled in"):
        Robot.named(str(file))
    file.write_text(file.read_text() + "# mine\n")
    text = words("robot", file, *SCALES, *SLOPE, "--front-radius", "90mm", "--rear-radius", "8cm")
    assert f"next: kaidan assess {file} STAIRS" in text
    assert "# mine" in file.read_text()
    robot = Robot.named(str(file))
    assert (robot.name, robot.mass, robot.track.flat_length) == ("own", 20.0, 0.5)
    assert (robot.com_from_front, robot.com_height) == (0.2, 0.1)
    assert (robot.track.front_radius, robot.track.rear_radius) == (0.09, 0.08)
    assert robot.uncertainty.com_height > robot.uncertainty.com_from_front > 0
    assert set(robot.sources) == {
        "mass", "com_from_front", "com_height", "track.flat_length", "track.front_radius",
        "track.rear_radius",
    }  # fmt: skip


def test_a_stairs_sheet_is_written(tmp_path):
    file = tmp_path / "own.toml"
    words("stairs", file, "--total-rise", "2.72m", "--total-going", "4.2m", "--risers", "16")
    flight = Stairs.named(str(file))
    assert (flight.rise, flight.going, flight.steps) == (0.17, 0.28, 16)
    assert math.degrees(flight.uncertainty.angle) == pytest.approx(0.0223, abs=3e-4)
    assert flight.uncertainty.rise == pytest.approx(9.5e-3 / math.sqrt(12), abs=1e-5)
    assert flight.uncertainty.going == flight.uncertainty.rise
    assert flight.uncertainty.nosing_spacing == pytest.approx(1.4e-4, abs=2e-5)


def test_landings_go_into_the_sheet_of_stairs(tmp_path):
    file = tmp_path / "own.toml"
    totals = ("--total-rise", "2.72m", "--total-going", "4.2m", "--risers", "16")
    text = words("stairs", file, *totals, "--width", "1m", "--upper-turn", "half",
                 "--upper-landing", "1.2m", "--upper-landing-width", "2.1m", "--upper-leaf", "0.7m",
                 "--lower-landing", "2m")  # fmt: skip
    assert "landings    width 1000 mm, lower_landing 2000 mm, upper_turn half" in text
    flight = Stairs.named(str(file))
    assert (flight.upper_turn, flight.upper_landing, flight.upper_landing_width) == (
        "half", 1.2, 2.1,
    )  # fmt: skip
    assert (flight.width, flight.upper_leaf, flight.lower_landing) == (1.0, 0.7, 2.0)
    assert flight.sources["upper_landing"] == "V: measured by tape (kaidan measure stairs)"


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"upper_turn": "180"},
         'stairs: upper_turn = "180" is not one of none, quarter, half, unknown'),
        ({"u_tape": "1m"}, "u_tape = 1 m is not within 0 to 0.1 m"),
        ({"upper_turn": "half"},
         "stairs: upper_turn = half needs width and upper_landing and upper_landing_width too"),
        ({"upper_landing": "1200"},
         "upper_landing '1200' has no unit; write 1200mm or 1200cm or 1200m"),
        ({"lower_leaf": -0.1}, "stairs: lower_leaf = -0.1 m is not within 0 to 5 m"),
        ({"upper_turn": "half", "width": 1, "upper_landing": 1.2, "upper_landing_width": 1.2},
         "stairs: upper_landing_width = 1.2 m, but the flight and what lies beside it are 2 m "
         "wide"),
    ],
)  # fmt: skip
def test_landings_that_are_refused(given, text):
    with pytest.raises(InputError) as error:
        measure_stairs(total_rise="2.72m", total_going="4.2m", risers=16, **given)
    assert str(error.value) == text


def test_a_measurement_as_json_and_without_a_file():
    found = json.loads(words("robot", *SCALES, "--json"))
    assert found["com_from_front"]["value"] == pytest.approx(0.2)
    assert found["com_height"] is None


def test_a_length_is_asked_for_and_the_procedure_is_drawn(tmp_path, capsys):
    assert run(["measure", "robot"]) == 2
    assert "--length is missing" in capsys.readouterr().err
    for name in ("a.svg", "b.svg"):
        words("robot", "--figure", tmp_path / name)
    first = (tmp_path / "a.svg").read_bytes()
    assert first == (tmp_path / "b.svg").read_bytes()
    words("robot", *SCALES, *SLOPE, "--figure", tmp_path / "c.svg")
    words("robot", "--length", "500mm", "--balance", "200mm", "--tips-at", "70deg", "--on", "ramp",
          "--figure", tmp_path / "d.svg")  # fmt: skip
    assert len({(tmp_path / name).read_bytes() for name in ("a.svg", "c.svg", "d.svg")}) == 3


@pytest.mark.parametrize("sheet", [Robot, Stairs])
def test_completing_a_sheet_changes_nothing_else(sheet):
    blank = blank_toml(sheet, name="x", title="t")
    assert completed(blank, {}, origin="x") == blank
    text = completed(blank, {"title": 'a "b"', "uncertainty.angle": 0.1}, origin="x")
    table = tomllib.loads(text)
    assert (table["title"], table["uncertainty"]["angle"]) == ('a "b"', 0.1)
    assert completed(text, {"title": 'a "b"', "uncertainty.angle": 0.1}, origin="x") == text
    before, after = blank.splitlines(), text.splitlines()
    assert [line for line in before if line not in after] == (
        ['#title = ""'] if sheet is Robot else ['#title = ""', '#angle = "0deg"']
    )


def test_a_sheet_nested_without_end_is_refused_in_a_line():
    with pytest.raises(InputError, match="x: not a sheet: tables or lists nested too deeply"):
        completed("a = " + 20_000 * "[", {"mass": 1.0}, origin="x")


def test_a_table_is_added_where_there_is_none():
    text = completed('name = "x"', {"sources.track.flat_length": "V: tape"}, origin="x")
    assert tomllib.loads(text) == {"name": "x", "sources": {"track.flat_length": "V: tape"}}


def test_a_sheet_that_cannot_be_completed_is_left_to_its_owner():
    with pytest.raises(InputError, match="x: not valid TOML: "):
        completed("name = 'x\n", {"mass": 1.0}, origin="x")
    with pytest.raises(
        InputError, match=r"line by line; put in by hand: track\.flat_length = 0\.5"
    ):
        completed("track = { flat_length = 0.4 }", {"track.flat_length": 0.5}, origin="x")


def test_the_labelled_drawing_of_a_robot(tmp_path, capsys):
    files = [tmp_path / name for name in ("a.svg", "b.svg")]
    for file in files:
        assert run(["robots", "kenaf", "--figure", str(file)]) == 0
    assert "wrote " in capsys.readouterr().out
    assert files[0].read_bytes() == files[1].read_bytes()
    assert run(["robots", "--figure", str(files[0])]) == 2
    assert "--figure needs the NAME of a robot" in capsys.readouterr().err


def test_the_friction_that_is_advised_is_enough_with_what_the_tape_leaves_open():
    """A robot and stairs with doubt: with the friction of the advice it is a GO, not a NO-GO."""
    checks = {"rises": ["176mm", "178mm", "177mm"], "goings": ["281mm", "279mm", "280mm"]}
    stairs = measure_stairs(total_rise="2.48m", total_going="3.64m", risers=14, **checks)
    flight = Stairs.from_text(
        completed(blank_toml(Stairs, name="x", title="t"), stairs.figures, origin="x"), origin="x"
    )
    robot = measure_robot(
        flat_length="780mm", front_scale="23.6kg", rear_scale="17.4kg", slope="18deg",
        front_on_slope="21.5kg", rear_on_slope="19.5kg", front_radius="105mm",
        rear_radius="105mm",
    )  # fmt: skip
    sheet = Robot.from_text(
        completed(blank_toml(Robot, name="x", title="t"), robot.figures, origin="x"), origin="x"
    )
    for friction in (None, "0.7..1.0"):
        change = assess(sheet, flight, friction=friction).what_would_help[0]
        enough = float(change.change.split("friction of ")[1].split()[0])
        assert change.verdict == "go"
        assert assess(sheet, flight, friction=enough).verdict == "go"


@pytest.mark.parametrize(
    ("stated", "note"),
    [
        ({"first_rise": "165mm"}, "The last riser often differs"),
        ({"last_rise": "182mm"}, "The first riser often differs"),
        ({}, "First and last riser often differ"),
    ],
)
def test_only_the_end_riser_that_nobody_measured_is_called_for(stated, note):
    found = measure_stairs(total_rise="2.73m", total_going="4.2m", risers=16, **stated)
    assert found.notes[0].startswith(note)
