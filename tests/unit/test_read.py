"""``kaidan read`` and files where a question expects a name."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import kaidan
from kaidan.cli import run
from kaidan.errors import InputError, RefusedError
from kaidan.modes import Verdict
from kaidan.readers.estimate import Found, LandingEstimate, Refusal, StairsEstimate
from kaidan.readers.flight import FlightEstimate, independent
from kaidan.readers.kinds import Known, Points, Provenance
from kaidan.verbs.read import FileAnswer, joint_angles
from robot_files import TANK, tank_mjcf, tank_sdf, tank_urdf, urdf_shape


@pytest.fixture
def tank(tmp_path):
    path = tmp_path / "tank.urdf"
    path.write_bytes(tank_urdf())
    return str(path)


# robots


def test_a_robot_of_a_file_is_judged_as_its_sheet_is(tank, tmp_path):
    answer = kaidan.assess(tank, "ibc", flippers="flat", friction=1.0)
    sheet = kaidan.read(tank).robots[0].sheet
    same = kaidan.assess(sheet, "ibc", flippers="flat", friction=1.0)
    assert answer.to_dict() == same.to_dict()


def test_the_answer_comes_back_from_json_and_has_a_schema(tank):
    found = kaidan.read(tank)
    assert FileAnswer.from_json(found.to_json()) == found
    assert set(FileAnswer.json_schema()["properties"]) == set(found.to_dict())
    assert (found.form, found.title, found.exit_code) == ("urdf", "URDF", 0)
    assert found.unit == ("m", "format")


def test_the_text_lists_figures_to_confirm(tank):
    text = str(kaidan.read(tank))
    lines = {line.split()[0]: " ".join(line.split()) for line in text.splitlines() if line.strip()}
    assert text.splitlines()[0] == f"{tank}: URDF, 1 robot"
    assert lines["track.flat_length"] == (
        "track.flat_length L 500 mm longest lower edge of the hull of links called tracks"
    )
    assert lines["front_flippers.length"].endswith("300 mm farthest wheel of front_left_flipper_j")
    assert "As the file has it, flippers included: L 500, C_L 238, C_N 155 mm." in text


def test_own_figures_replace_those_of_the_file(tank):
    found = kaidan.read(tank, override="com_height=200mm,track.front_radius=80mm,flat_length=0.6m")
    sheet = found.robots[0].sheet
    assert (sheet.com_height, sheet.track.front_radius, sheet.track.flat_length) == (0.2, 0.08, 0.6)
    question = kaidan.Question.of(tank, "ibc", override="com_height=200mm")
    assert question.robot.com_height == 0.2
    listed = kaidan.Question.of("absolem", "ibc", override="front_flippers.tip_radius=30mm")
    assert listed.robot.front_flippers.tip_radius == 0.03


def test_tracks_of_meshes_need_own_figures(tmp_path):
    path = tmp_path / "meshes.urdf"
    mesh = urdf_shape('<mesh filename="track.stl"/>')
    path.write_bytes(tank_urdf(flipper="", shapes=mesh))
    with pytest.raises(RefusedError) as raised:
        kaidan.assess(path, "ibc")
    assert str(raised.value) == (
        f"{path}: holds no robot: Its tracks are meshes, which are not opened (left_track, "
        "right_track): state flat_length, com_from_front and com_height, or measure them. Its "
        "masses add up to 30.0 kg."
    )
    own = "flat_length=500mm,com_from_front=240mm,com_height=170mm,track.front_radius=90mm"
    robot = kaidan.Question.of(path, "ibc", override=own).robot
    assert (robot.track.flat_length, robot.track.front_radius, robot.mass) == (0.5, 0.09, 30.0)


def test_joints_as_texts_and_mappings(tmp_path):
    path = tmp_path / "tank.sdf"
    path.write_bytes(tank_sdf())
    both = [f"front_{side}_flipper_j=-30deg" for side in ("left", "right")]
    one, other = (
        kaidan.read(path, joints=given).robots[0].sheet
        for given in (both, {each.partition("=")[0]: -math.radians(30) for each in both})
    )
    assert one == other
    assert one.front_flippers.stowed_angle == pytest.approx(math.radians(30), rel=1e-5)
    assert joint_angles("mast=200mm") == {"mast": 0.2}
    with pytest.raises(
        InputError, match=r"^joint 'mast': write NAME=ANGLE, for example arm=30deg$"
    ):
        joint_angles("mast")


def test_a_part_of_a_file_is_named_behind_a_hash(tmp_path):
    path = tmp_path / "two.sdf"
    one, other = (tank_sdf().decode().partition("<model")[2] for _ in range(2))
    text = "<sdf version='1.6'><model" + one.replace("</sdf>", "")
    text += "<model" + other.replace('name="tank"', 'name="second"', 1)
    path.write_text(text)
    with pytest.raises(InputError, match=r"write FILE#MODEL with one of tank, second$"):
        kaidan.read(path)
    assert kaidan.read(f"{path}#second").robots[0].title == "second"
    assert kaidan.Question.of(f"{path}#second", "ibc").robot.mass == TANK["mass"]


@pytest.mark.parametrize(
    ("hint", "text"),
    [
        ({"up": "z"}, r"^up = 'z' is not known; known: \+x, -x, \+y, -y, \+z, -z$"),
        ({"unit": "km"}, r"^unit = 'km' is not known; known: m, cm, mm, in, ft$"),
        ({"crop": "1,2"}, r"^crop = '1,2' is not 6 numbers with commas between them$"),
        ({"gravity": "1"}, r"^gravity '1' has no unit; write"),
        (
            {"override": "track.colour=3mm"},
            r"^'track.colour' is no figure of a robot's sheet; known",
        ),
        ({"override": "colour=3mm"}, r"^override 'colour' is not known; write NAME=VALUE"),
    ],
)
def test_hints_without_meaning_are_refused(tank, hint, text):
    with pytest.raises(InputError, match=text):
        kaidan.read(tank, **hint)


# stairs: an estimate made by hand, 5 steps of 180 and 290 mm, heading along y

HERE = Provenance("hall.ply", "0" * 64, "urdf", unit=Known("mm", "scored"), up=Known("+z", "file"))


def flight(steps=5, sigma=0.002):
    number = np.arange(steps, dtype=float)
    middle = np.column_stack([np.zeros(steps), 1.0 + 0.29 * number, 0.18 * (number + 1)])
    across = np.array([-0.5, 0.0, 0.0])
    return FlightEstimate(
        left=middle + across, right=middle - across, heading=math.pi / 2,
        covariance=independent(np.tile(np.diag([sigma**2, sigma**2]), (steps, 1, 1))),
        gravity=math.radians(0.3), scale=0.002, floor=0.0, width=1.0, roughness=0.004,
    )  # fmt: skip


def staircase(flights=1, name="hall"):
    landings = (LandingEstimate(depth=1.2),) * (flights + 1)
    return StairsEstimate((flight(),) * flights, landings, HERE, name)


def reads(monkeypatch, *staircases, refusals=(), contents=None):
    found = Found(HERE, staircases=staircases, refusals=refusals, contents=contents)
    monkeypatch.setattr("kaidan.verbs.read.found_in", lambda path, hints: found)
    monkeypatch.setattr("kaidan.readers.sheets.found_in", lambda path, hints: found)
    monkeypatch.setattr("kaidan.readers.sheets.known", lambda source: "a format")


@pytest.fixture
def hall(tmp_path):
    path = tmp_path / "hall.ply"
    path.write_bytes(b"anything")
    return path


def test_a_staircase_with_its_doubt(monkeypatch, hall):
    reads(monkeypatch, staircase())
    found = kaidan.read(hall)
    (one,) = found.staircases[0].flights
    assert (one.steps, one.rise_m, one.going_m) == pytest.approx((5, 0.18, 0.29))
    assert one.angle_deg == pytest.approx(math.degrees(math.atan2(0.18, 0.29)))
    assert one.angle_sigma_deg > 0.3
    assert np.abs(one.residuals).max() < 1e-9
    assert FileAnswer.from_json(found.to_json()) == found
    text = str(found)
    assert "5 steps, rise 180.0 mm, going 290.0 mm, single steps +- 2.8 mm and 2.8 mm" in text
    assert "unit mm (the one that makes stairs of it), up +z (as the file says)" in text
    assert "clear width 1000.0 mm, scatter 4.0 mm" in text


def test_a_flight_that_was_drawn_has_no_doubt_to_tell(monkeypatch, hall):
    drawn = replace(flight(sigma=0.0), gravity=0.0, scale=0.0, roughness=0.0)
    reads(monkeypatch, replace(staircase(), flights=(drawn,)))
    text = str(kaidan.read(hall))
    assert "5 steps, rise 180.0 mm, going 290.0 mm, as drawn\n" in text
    assert "31.83 deg, nosing to nosing 341.3 mm\n" in text
    assert "+-" not in text


def test_points_along_the_flight_are_in_metres(monkeypatch, hall):
    """By hand: a point 290 mm behind the first nosing along y, 100 mm up; others lie aside."""
    xyz = np.array([[0.0, 1290.0, 100.0], [0.0, 9000.0, 0.0], [900.0, 1000.0, 0.0], [np.nan] * 3])
    reads(monkeypatch, staircase(), contents=Points(xyz, HERE))
    assert kaidan.read(hall).staircases[0].flights[0].points == ((0.29, 0.1),)


def test_a_question_takes_the_flights_of_a_file(monkeypatch, hall):
    reads(monkeypatch, staircase(2))
    terrain = kaidan.Question.of("absolem", hall).terrain
    assert [each.name for each in terrain] == ["hall-1", "hall-2"]
    assert terrain[0].uncertainty.angle > 0.005
    with pytest.raises(InputError, match="a staircase of 2 flights where one flight is needed"):
        kaidan.margin("absolem", stairs=[hall])


def test_several_staircases_are_listed(monkeypatch, hall):
    reads(monkeypatch, staircase(name="north"), staircase(name="south"))
    with pytest.raises(InputError) as raised:
        kaidan.assess("absolem", hall)
    assert str(raised.value) == (
        f"{hall}: holds 2 staircases; write FILE#PART with one of north, south"
    )


def test_a_robot_where_stairs_are_expected_is_said(tank, monkeypatch, hall):
    with pytest.raises(InputError, match=r"tank.urdf: holds a robot, not stairs$"):
        kaidan.assess("absolem", tank)
    reads(monkeypatch, staircase())
    with pytest.raises(InputError, match=r"hall.ply: holds stairs, not a robot$"):
        kaidan.assess(hall, "ibc")


# the command


def test_the_command_writes_sheet_and_picture(tank, tmp_path, capsys):
    sheet, picture = tmp_path / "own.toml", tmp_path / "own.png"
    assert run(["read", tank, "-o", str(sheet), "--figure", str(picture)]) == 0
    assert "wrote" in capsys.readouterr().out
    assert kaidan.Robot.named(str(sheet)) == kaidan.read(tank).robots[0].sheet
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert run(["read", tank, "-o", str(sheet)]) == 2
    assert "is there already; --force replaces it" in capsys.readouterr().err
    assert run(["read", tank, "-o", str(sheet), "--force", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["robots"][0]["name"] == "tank"


def test_the_command_writes_a_sheet_for_each_flight(monkeypatch, hall, tmp_path, capsys):
    reads(monkeypatch, staircase(2))
    picture = tmp_path / "hall.svg"
    words = ["read", str(hall), "-o", str(tmp_path / "own.toml"), "--figure", str(picture)]
    assert run(words) == 0
    assert [kaidan.Stairs.named(str(tmp_path / f"own-{k}.toml")).steps for k in (1, 2)] == [5, 5]
    assert not (tmp_path / "own.toml").exists()
    assert b"<svg" in picture.read_bytes()
    assert run(words) == 2


def test_flights_of_all_staircases_are_drawn_up_to_a_number(monkeypatch, hall):
    pytest.importorskip("matplotlib")
    from kaidan.figures.read_figure import MOST_FLIGHTS, read_figure

    reads(monkeypatch, staircase(2), staircase(MOST_FLIGHTS))
    figure = read_figure(kaidan.read(hall))
    heads = [axes.get_title(loc="left").partition(":")[0] for axes in figure.axes[::3]]
    assert heads[:3] == [f"staircase {k}" for k in ("1, flight 1", "1, flight 2", "2, flight 1")]
    assert len(heads) == MOST_FLIGHTS
    said = [text.get_text() for text in figure.texts]
    assert any(each.endswith(", 2 more flights not drawn") for each in said)


def test_a_refusal_is_a_result_with_a_code_of_its_own(monkeypatch, hall, tmp_path, capsys):
    ramp = Refusal("ramp", {"angle_deg": 30.0, "residual_mm": 4.0}, HERE)
    reads(monkeypatch, refusals=(ramp,))
    out = tmp_path / "own.toml"
    assert run(["read", str(hall), "-o", str(out), "--figure", str(tmp_path / "no.png")]) == 3
    said = capsys.readouterr()
    assert said.out.splitlines()[1:] == [
        "  unit mm (the one that makes stairs of it), up +z (as the file says)",
        "  It is a ramp of 30 deg: no risers stand out of its 4 mm of scatter.",
    ]
    assert not out.exists()
    assert run(["assess", "absolem", str(hall)]) == 3
    assert capsys.readouterr().err == (
        f"kaidan: {hall}: holds no stairs: It is a ramp of 30 deg: no risers stand out of its 4 mm "
        "of scatter.\n"
    )


def test_what_cannot_be_read_ends_with_one_line(tmp_path, capsys):
    path = tmp_path / "nonsense"
    path.write_text("nonsense")
    assert run(["read", str(path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert run(["assess", str(path), "ibc"]) == 2
    assert "not valid TOML" in capsys.readouterr().err
    bomb = tmp_path / "bomb.urdf"
    bomb.write_text('<!DOCTYPE robot [<!ENTITY a "b">]><robot name="r"/>')
    assert run(["assess", str(bomb), "ibc"]) == 2
    assert capsys.readouterr().err == (
        f"kaidan: {bomb}, line 1: has a document type (DOCTYPE), which could name other files or "
        "grow without end; remove it\n"
    )


def test_the_command_judges_files(tank, capsys):
    code = run(["assess", tank, "ibc", "--flippers", "flat", "--friction", "1", "--short"])
    assert code in {each.exit_code for each in Verdict}
    assert capsys.readouterr().out.split("  ")[1].startswith("tank on ibc")


def test_mjcf_is_judged_too(tmp_path):
    path = tmp_path / "tank.xml"
    path.write_bytes(tank_mjcf())
    assert kaidan.Question.of(path, "ibc").robot.mass == TANK["mass"]
