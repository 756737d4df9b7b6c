"""A building of the tests' own: verdicts as assess has them, turns and doors by hand."""

import csv
import io
import json

import jsonschema
import pytest

pytest.importorskip("ifcopenshell", reason="skipped: ifcopenshell not installed")

from typer.testing import CliRunner

import kaidan
from ifc_cases import (
    House,
    boards,
    half_turn_house,
    house_with_a_door,
    monolith,
    parsed_here,
    regular,
)
from kaidan import InputError, Stairs
from kaidan.cli import app
from kaidan.modes import Verdict
from kaidan.text.building_page import page
from kaidan.verbs.building import building
from kaidan.verbs.building.answer import BuildingAnswer
from kaidan.verbs.building.sentences import in_words, posture_for

ROBOTS = ["absolem", "ozbot-atr"]


@pytest.fixture(scope="module", autouse=True)
def parser():
    """Sound models; the process that it has of its own is tested in readers/test_ifc.py."""
    with pytest.MonkeyPatch.context() as patch:
        parsed_here(patch)
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("houses")


@pytest.fixture(scope="module")
def house(folder):
    return half_turn_house().write(folder / "house.ifc")


@pytest.fixture(scope="module")
def answer(house):
    return building(house, ROBOTS, friction=1.0)


def cell(answer, robot, name):
    (flight,) = [each for each in answer.flights if each.name == name]
    (found,) = [c for c in answer.cells if (c.robot, c.flight) == (robot, flight.identity)]
    return found


def way(answer, robot, storey):
    (found,) = [each for each in answer.ways if (each.robot, each.storey) == (robot, storey)]
    return found


def test_every_pair_has_the_verdict_of_assess(answer):
    """The same flight entered by hand: 150 by 300 mm, a landing of 1.2 m, 1.0 m wide."""
    sheet = Stairs(rise=0.15, going=0.3, steps=10, width=1.0, lower_landing=2.0, upper_landing=1.2)
    by_hand = kaidan.assess("absolem", sheet, friction=1.0)
    found = cell(answer, "absolem", "A1")
    assert (found.verdict, found.governs) == (by_hand.verdict, by_hand.governs)
    assert (found.facing, found.flippers) == (by_hand.plan.facing, by_hand.question.flippers)
    assert f"absolem on A1, A2: nose first; {in_words(found.flippers)}" in str(answer)
    assert found.margin_deg == pytest.approx(by_hand.margin_deg, abs=1e-3)
    assert [each.name for each in answer.flights] == ["A1", "A2", "B"]
    assert [each.steps for each in answer.flights] == [10, 10, 15]


def test_a_flight_narrower_than_the_robot_binds_by_its_width(folder):
    """0.70 m; OzBot's tracks are 0.538 + 0.2 = 0.738 m over all."""
    path = half_turn_house(width=0.7).write(folder / "narrow.ifc")
    found = cell(building(path, ["ozbot-atr"], friction=1.2), "ozbot-atr", "A1")
    assert (found.verdict, found.governs, found.binds) == ("no-go", "narrow", "width")
    assert found.margin_deg == -90.0
    assert found.reason.startswith("The flight is 700 mm wide; the robot needs 738 mm going")


def test_absolem_raises_its_flippers_to_turn_on_a_landing_of_1_2_m(answer):
    """Flat it sweeps 1.35 m, stowed 0.90 m: its flippers stand outside its tracks."""
    (turn,) = [each for each in answer.turns if each.robot == "absolem"]
    assert (turn.way, turn.flippers, turn.changed) == ("spin", "stowed", True)
    assert turn.circle_m == pytest.approx(0.9014, abs=0.001)
    assert turn.room_m == pytest.approx(1.2, abs=0.02)
    plan = in_words(cell(answer, "absolem", "A1").flippers)
    assert way(answer, "absolem", "First").postures == (
        f"Before A1 set the flippers to {plan}.",
        "On the landing at 1.50 m change the flippers to stowed and turn by 180 deg: it sweeps "
        "0.90 m of 1.20 m.",
        f"Before A2 set the flippers to {plan}.",
    )


@pytest.mark.parametrize(
    ("flippers", "facing", "said"),
    [
        ("flat", "", "Before A1 set the flippers to flat."),
        ("", "tail-first", "Before A1 turn to go tail first."),
        (
            "flat/traverse:9deg,flat/land:stowed",
            "nose-first",
            "Before A1 turn to go nose first and set the flippers to flat; to traverse 9deg,flat; "
            "to land stowed.",
        ),
    ],
)
def test_what_to_do_before_a_flight(flippers, facing, said):
    assert posture_for("A1", flippers, facing) == said


def test_flights_of_a_staircase_are_judged_with_the_landing_between(house):
    """As one staircase: the rectangle of 1.2 by 2.2 m, 2 mm of it for the wall behind it."""
    found = kaidan.assess("absolem", f"{house}#Stair A", flippers="flat", friction=1.0)
    (turn,) = found.turns
    assert (turn.way, turn.flippers, turn.landing) == ("spin", "stowed", "landing above Stair A-1")
    lower = found.question.flights[0]
    sizes = (lower.upper_landing, lower.upper_landing_width)
    assert (lower.upper_turn, sizes) == ("half", pytest.approx((1.2, 2.2), abs=0.0021))


def test_ozbot_does_not_turn_there_and_that_binds(answer):
    """1.77 m of circle, 1.58 m of length: not in 1.2 m."""
    (turn,) = [each for each in answer.turns if each.robot == "ozbot-atr"]
    assert turn.way == "none"
    found = way(answer, "ozbot-atr", "First")
    assert (found.verdict, found.binds, found.where) == ("no-go", "turning", "landing at 1.50 m")
    assert found.reason == (
        "It cannot turn by 180 deg: it sweeps 1.77 m, the landing has 1.20 m, and no manoeuvre was "
        "found."
    )


@pytest.mark.parametrize(
    ("landing", "width", "way_", "changed"),
    [(1.5, 1.5, "spin", False), (0.97, 1.0, "spin", True), (0.6, 1.0, "none", True)],
)
def test_the_landing_decides_how_absolem_turns(folder, landing, width, way_, changed):
    """Flat it sweeps 1.41 m with 30 mm all round, so that it needs half of that from each wall."""
    path = half_turn_house(landing, width=width).write(folder / f"landing{landing}.ifc")
    found = building(path, ["absolem"], flippers="flat", friction=1.0)
    (turn,) = found.turns
    assert (turn.way, turn.changed) == (way_, changed)


@pytest.mark.parametrize(("degrees", "way_"), [(90.0, "none"), (-90.0, "spin")])
def test_a_door_that_opens_onto_a_landing_is_in_the_way_of_a_turn(folder, degrees, way_):
    """Of 1.2 m a leaf of 0.9 m leaves 0.3 m before the flight."""
    h = half_turn_house(1.2)
    leaf = h.slab([(-0.45, -0.025), (0.45, -0.025), (0.45, 0.025), (-0.45, 0.025)], 2.1, 2.1)
    h.add("IfcDoor", "L", [leaf], at=(3.9, 0, 1.5), degrees=degrees, OverallWidth=900.0,
          OverallHeight=2100.0, OperationType="SINGLE_SWING_LEFT")  # fmt: skip
    (turn,) = building(
        h.write(folder / f"door{degrees}.ifc"), ["absolem"], flippers="flat", friction=1.0
    ).turns
    assert turn.way == way_


def test_a_door_that_is_too_narrow_binds(folder):
    """0.55 m less 0.1 m for frame and leaf: 0.45 m, Absolem has 0.594 m."""
    path = half_turn_house(door=0.55).write(folder / "door.ifc")
    found = building(path, ["absolem"], flippers="flat", friction=1.0)
    assert way(found, "absolem", "First").binds == "doors"
    assert way(found, "absolem", "First").verdict == "no-go"
    assert "The widest door there leaves 450 by 2100 mm" in way(found, "absolem", "First").reason


@pytest.mark.parametrize(
    ("operation", "degrees", "schema", "landing", "leaf"),
    [
        ("SINGLE_SWING_LEFT", -90.0, "IFC4", 1.2, 0.9),
        ("SINGLE_SWING_RIGHT", -90.0, "IFC2X3", 1.2, 0.9),
        ("DOUBLE_DOOR_SINGLE_SWING", -90.0, "IFC4", 1.2, 0.45),
        ("SINGLE_SWING_LEFT", 90.0, "IFC4", 3.0, 0.0),  # away from the flight
        ("DOUBLE_SWING_LEFT", 90.0, "IFC4X3", 1.2, 0.9),  # both ways
        ("SINGLE_SWING_LEFT", 0.0, "IFC4", 3.0, 0.0),  # sideways
        ("SLIDING_TO_LEFT", -90.0, "IFC4", 3.0, 0.0),
        ("NOTDEFINED", -90.0, "IFC4", 3.0, 0.0),
    ],
)
def test_a_door_that_opens_to_the_flight_takes_its_leaf(
    folder, operation, degrees, schema, landing, leaf
):
    """It stands 1.2 m before the foot, and its leaf takes its width of that; else 3 m are free."""
    path = house_with_a_door(operation, degrees, schema).write(folder / "leaf.ifc")
    found = building(path, ["absolem"], flippers="flat", friction=1.0)
    sheet = found.flights[0].sheet
    assert (sheet.lower_landing, sheet.lower_leaf) == pytest.approx((landing, leaf), abs=1e-6)
    assert sheet.upper_leaf == 0.0
    if operation == "SINGLE_SWING_RIGHT":  # 0.3 m are left for a robot of more than a metre
        by_hand = kaidan.assess("absolem", sheet, flippers="flat", friction=1.0)
        assert "landing_room" in by_hand.doubts
    stated = {"SLIDING_TO_LEFT": 0.0, "NOTDEFINED": None, "DOUBLE_DOOR_SINGLE_SWING": 0.45}
    assert found.doors[0].leaf_m == stated.get(operation, 0.9)


def test_a_ceiling_that_is_too_low_binds(folder):
    path = half_turn_house(ceiling=0.6).write(folder / "ceiling.ifc")
    found = building(path, ["absolem"], flippers="flat", friction=1.0)
    assert cell(found, "absolem", "A1").binds == "headroom"
    assert cell(found, "absolem", "A1").verdict == "no-go"


def test_friction_that_nobody_stated_binds(house):
    found = cell(building(house, ["absolem"], flippers="35deg,-13deg"), "absolem", "A1")
    assert (found.verdict, found.governs) == ("unsure", "friction_unknown")
    assert found.binds == "friction"


def test_ways_may_begin_on_any_storey_and_lead_down(house):
    found = building(house, ["absolem"], flippers="flat", friction=1.0, start="first")
    assert [each.storey for each in found.ways] == ["Ground", "Attic"]
    assert len(way(found, "absolem", "Ground").flights) == 2
    with pytest.raises(InputError, match=r"no storey is called 'cellar'; known: Ground, First"):
        building(house, ["absolem"], start="cellar")


def test_json_both_ways_and_its_schema(answer):
    document = json.loads(answer.to_json())
    jsonschema.validate(document, BuildingAnswer.json_schema())
    assert BuildingAnswer.from_json(answer.to_json()) == answer


def test_a_table_with_a_line_for_each_pair(answer):
    rows = list(csv.DictReader(io.StringIO(kaidan_csv(answer))))
    assert len(rows) == len(answer.flights) * len(ROBOTS)
    assert rows[0]["name"] == "A1"
    assert float(rows[0]["rise_m"]) == pytest.approx(0.15)


def kaidan_csv(answer):
    from kaidan.files import csv_text

    return csv_text(answer.columns())


def test_a_page_that_fetches_nothing(answer):
    from kaidan.figures.building_figure import building_figure
    from kaidan.figures.saving import figure_bytes

    text = page(answer, figure_bytes(building_figure(answer), "svg").decode())
    assert text.count("<svg") == 1
    assert "<script" not in text
    assert 'src="' not in text
    assert f"Before A1 set the flippers to {in_words(answer.cells[0].flippers)}." in text
    evil = answer.model_copy(update={"notes": ("<img src=x>",)})
    assert "<img" not in page(evil, "")


def test_the_command(house, tmp_path):
    words = ["building", str(house), "--robots", "absolem", "--friction", "1.0"]
    done = CliRunner().invoke(app, [*words, "--html", str(tmp_path / "h.html"),
                                    "--csv", str(tmp_path / "h.csv")])  # fmt: skip
    assert done.exit_code in {each.exit_code for each in Verdict}
    assert "A1" in done.stdout
    assert "Ways from Ground" in done.stdout
    assert (tmp_path / "h.html").read_text().startswith("<!DOCTYPE html>")
    assert (tmp_path / "h.csv").exists()


@pytest.mark.parametrize(
    ("first", "second", "code"),
    [
        ((Verdict.GO, Verdict.NO_GO), (Verdict.GO,), 0),  # one robot is enough for each storey
        ((Verdict.GO,), (Verdict.ROUGH, Verdict.UNSURE), 4),
        ((Verdict.ROUGH,), (Verdict.UNSURE, Verdict.NO_GO), 5),
        ((Verdict.UNSURE,), (Verdict.NO_GO,), 1),
    ],
)
def test_the_storey_that_is_reached_worst_decides_the_exit_code(answer, first, second, code):
    way = next(each for each in answer.ways if each.verdict is not None)
    ways = [
        way.model_copy(update={"storey": storey, "verdict": verdict})
        for storey, some in (("1", first), ("2", second))
        for verdict in some
    ]
    assert answer.model_copy(update={"ways": tuple(ways)}).exit_code == code


def test_a_building_without_stairs(folder):
    h = House()
    h.add("IfcWall", "wall", [h.slab([(0, 0), (1, 0), (1, 1), (0, 1)], 1)])
    found = building(h.write(folder / "bare.ifc"), ["absolem"])
    assert (found.flights, found.exit_code) == ((), 3)
    assert "0 straight flights" in str(found)


def test_what_is_no_building_is_refused(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text("<robot name='x'/>")
    with pytest.raises(InputError, match="URDF is no building model"):
        building(path, ["absolem"])
    with pytest.raises(InputError, match="name at least one robot"):
        building(path, [])


def test_a_quarter_turn_with_the_tail_over_the_flight(folder):
    """1.25 m for a circle of 1.30 m; the turning centre keeps 0.1 m from the flight below."""
    house = House()
    stair = house.add("IfcStair", "Q")
    steps = {"rises": [0.15] * 10, "goings": [0.3] * 9, "last": False}
    house.add("IfcStairFlight", "Q1", [monolith(house, **steps, width=1.5)], parent=stair)
    outline = [(0, -0.75), (1.25, -0.75), (1.25, 0.75), (0, 0.75)]
    house.add("IfcSlab", "landing", [house.slab(outline, 0)], at=(2.7, 0, 1.5), parent=stair)
    house.add("IfcStairFlight", "Q2", [monolith(house, **steps, width=1.25)],
              at=(3.325, 0.75, 1.5), degrees=90, parent=stair)  # fmt: skip
    found = building(house.write(folder / "quarter.ifc"), ["absolem-flat"], friction=1.2)
    (turn,) = found.turns
    assert (turn.way, round(turn.turn_deg)) == ("manoeuvre", 90)
    assert turn.room_m == pytest.approx(1.25, abs=0.01)
    assert min(x for x, _, _ in turn.path) >= 2.7 + 0.1
    assert way(found, "absolem-flat", "First").postures == (
        f"On the landing at 1.50 m turn by 90 deg: bit by bit in {turn.moves} drives and turns on "
        "the spot.",
    )


def test_an_end_that_may_hook_under_open_risers_is_named(folder):
    """Absolem's flipper tips have 29 mm of radius, risers of 190 mm."""
    house = House()
    house.add("IfcStair", "boards", boards(house, *regular(8, 0.19, 0.25)))
    (flight,) = building(house.write(folder / "boards.ifc"), ["absolem"]).flights
    assert flight.notes[-1] == (
        "its risers are open, up to 190 mm high: absolem, with an end of 29 mm radius, may hook "
        "under a nosing"
    )
