"""The commands of the catalogues: lists, whole sheets, sheets to fill in, schemas."""

import json
import os
import re
import subprocess
import sys
import tomllib

import jsonschema
import pytest
from typer.testing import CliRunner

from kaidan import catalog
from kaidan.catalog.template import blank_toml, required_fields
from kaidan.cli import app
from kaidan.cli import run as ended_with
from kaidan.errors import InputError
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

SHEETS = {"robot": Robot, "stairs": Stairs, "surface": Surface}
LISTS = {"robot": "robots", "stairs": "stairs", "surface": "surfaces"}
FILLED = {
    "com_from_front": 0.25,
    "com_height": 0.1,
    "flat_length": 0.5,
    "front_radius": 0.09,
    "rear_radius": 0.09,
    "rise": 0.18,
    "going": 0.28,
    "friction_low": 0.5,
    "friction_high": 0.6,
}


def run(*words):
    result = CliRunner().invoke(app, list(words))
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.stdout


def run_json(*words):
    return json.loads(run(*words, "--json"))


def row(text, name):
    """Cells of the line of a table that begins with a name."""
    line = next(line for line in text.splitlines() if line.split()[:1] == [name])
    return re.split(r"\s{2,}", line.strip())


def test_robots_are_listed_with_their_key_figures():
    text = run("robots")
    assert row(text, "name") == [
        "name", "title", "L [mm]", "C_L [mm]", "C_N [mm]", "R [mm]", "mass [kg]", "flippers",
        "centroid",
    ]  # fmt: skip
    assert row(text, "kenaf") == [
        "kenaf", "Kenaf, main tracks only (four sub-tracks removed)",
        "470", "196", "71", "65", "-", "no", "V",
    ]  # fmt: skip
    assert row(text, "ozbot-atr")[2:] == ["1045", "438", "308", "140/110", "146.3", "no", "C"]
    assert row(text, "absolem")[-2] == "yes"
    for name in catalog.names("robots"):
        assert row(text, name)


def test_robots_without_a_centroid_are_listed_apart():
    judged, rest = run("robots").split("Nobody measured the centroid, a range is stated: ")
    ranged, apart = rest.split("No length published either, so nothing can be computed:")
    for name in catalog.gross_robots():
        assert name not in judged + ranged
        assert row(apart, name)
    for name in catalog.names("unweighed"):
        assert name not in judged
        assert row(ranged, name)
    assert row(ranged, "quince")[2:5] == ["436", "131 to 262", "112 to 269"]


def test_stairs_are_listed_with_their_key_figures():
    text = run("stairs")
    assert row(text, "name")[2:] == [
        "rise [mm]", "going [mm]", "angle [deg]", "spacing [mm]", "risers", "open",
    ]  # fmt: skip
    assert row(text, "osha-ship")[2:] == ["305", "111.1", "70.0", "324.6", "12", "yes"]
    assert row(text, "schependomlaan")[2:] == ["187.5", "220", "40.4", "289.1", "8", "no"]
    for name in catalog.names("stairs"):
        assert row(text, name)


def test_surfaces_are_listed_with_their_key_figures():
    text = run("surfaces")
    # atan(0.25) = 14.04 deg, atan(0.75) = 36.87 deg
    assert row(text, "concrete-wet")[2:] == ["0.25", "0.75", "14.0", "36.9", "V"]
    assert row(text, "petg-on-plywood")[-1] == "D"


def test_lists_as_json():
    robots = run_json("robots")
    assert {each["name"] for each in robots["robots"]} == set(catalog.names("robots"))
    assert {each["name"] for each in robots["no_centroid_published"]} == set(catalog.gross_robots())
    kenaf = next(each for each in robots["robots"] if each["name"] == "kenaf")
    assert kenaf == {
        "name": "kenaf",
        "title": "Kenaf, main tracks only (four sub-tracks removed)",
        "flat_length_m": 0.47,
        "com_from_front_m": 0.196,
        "com_height_m": 0.071,
        "radius_m": [0.065, 0.065],
        "mass_kg": None,
        "flippers": False,
        "centroid_status": "V",
    }
    assert len(run_json("stairs")["stairs"]) == len(catalog.names("stairs"))
    assert len(run_json("surfaces")["surfaces"]) == len(catalog.names("surfaces"))


def test_a_robot_is_shown_whole():
    text = run("robots", "absolem")
    assert text.startswith("absolem: Absolem (NIFTi/TRADR, BlueBotics)\n")
    assert row(text, "com_from_front")[:3] == ["com_from_front", "C_L", "279 mm"]
    assert row(text, "com_from_front")[3].startswith("C: osrf/subt ")
    assert row(text, "mass")[1:3] == ["M", "38.7 kg"]
    assert row(text, "front_flippers.max_speed")[1] == "45 deg/s"
    assert row(text, "drive.efficiency")[1:] == ["1", "default"]
    assert "weigh and tilt the real robot" in text
    follows = text.split("What follows:")[1]
    # 2 x sqrt(330^2 - 60^2) + 500 = 1149.0 mm; half of it
    assert "flat length, flippers flat" in follows
    assert "1149 mm" in follows
    assert "574.5 mm" in follows


def test_stairs_are_shown_whole():
    text = run("stairs", "nist-arena")
    assert row(text, "first_rise")[1] == "230 mm"
    assert row(text, "angle")[1:] == ["theta_s", "40.703 deg"]
    assert ["nosing spacing", "p", "306.69 mm"] in [
        re.split(r"\s{2,}", line) for line in text.splitlines()
    ]
    # 230 + 4 x 200 mm, 4 x 232.5 mm
    assert "1030 mm" in text
    assert "930 mm" in text


def test_a_sheet_as_json_is_the_sheet_and_what_follows():
    shown = run_json("robots", "absolem")
    assert shown["kind"] == "robot"
    assert Robot.model_validate(shown["sheet"]) == Robot.named("absolem")
    assert shown["derived"]["longest_nosing_spacing_m"] == 0.25
    shown = run_json("stairs", "osha")
    assert Stairs.model_validate(shown["sheet"]) == Stairs.named("osha")
    assert shown["derived"]["angle_deg"] == pytest.approx(45.0, rel=1e-15)
    assert shown["derived"]["required_friction"] == pytest.approx(1.0, rel=1e-15)
    shown = run_json("surfaces", "concrete-dry")
    assert Surface.model_validate(shown["sheet"]) == Surface.named("concrete-dry")
    assert shown["derived"]["slope_high_deg"] == 45.0


def test_a_measured_flight_is_shown_with_its_own_count(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("rises = [0.15, 0.18, 0.181]\ngoings = [0.28, 0.279]\n")
    text = run("stairs", str(path))
    assert row(text, "rises")[1] == "150 mm, 180 mm, 181 mm"
    assert row(text, "risers")[1] == "3"
    assert not any(line.startswith("steps") for line in text.splitlines())
    assert "steps" not in run_json("stairs", str(path))["sheet"]


def test_a_gross_robot_is_shown_with_what_is_missing():
    text = run("robots", "Athena")
    assert "step 0.41 m" in text
    assert "No length is published" in text
    assert run_json("robots", "athena")["kind"] == "gross"


def test_what_a_file_says_does_not_steer_the_terminal(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        'title = "\\u001b[31m[red]x[/red]\\u0007"\nfriction_low = 0.5\nfriction_high = 0.6\n'
        'notes = "\\u001b]0;x\\u0007"\nsources.friction_low = "U: [bold]\\u001b[1m"\n'
    )
    text = run("surfaces", str(path))
    assert "\x1b" not in text
    assert "\x07" not in text
    assert "[red]x[/red]" in text
    assert "U: [bold]" in text


@pytest.mark.parametrize("what", SHEETS)
def test_a_new_sheet_is_refused_until_filled_in_and_then_works(what, tmp_path):
    path = tmp_path / "my own.toml"
    assert run("new", what, str(path)).startswith(f"wrote {path}: ")
    assert [each.name for each in tmp_path.iterdir()] == ["my own.toml"]
    text = path.read_text(encoding="utf-8")
    names = [name.rpartition(".")[2] for name in required_fields(SHEETS[what])]
    for name in names:
        with pytest.raises(InputError, match=r"is still to be filled in: .+, [-\d.]+ to [\d.]+"):
            run(LISTS[what], str(path))
        text, count = re.subn(
            rf'^{name} = "FILL IN"$', f"{name} = {FILLED[name]}", text, flags=re.M
        )
        assert count == 1
        path.write_text(text, encoding="utf-8")
    assert SHEETS[what].named(str(path)).name == "my own"
    assert run(LISTS[what], str(path)).startswith("my own\n")


@pytest.mark.parametrize("what", SHEETS)
def test_a_new_sheet_explains_every_field(what):
    """Each line of a setting has a comment with meaning, unit and range above it."""
    text = blank_toml(SHEETS[what], name="x", title="y")
    schema = SHEETS[what].model_json_schema()
    for model in (schema, *schema.get("$defs", {}).values()):
        for name, field in model["properties"].items():
            meaning = " ".join(field["description"].split())
            comments = " ".join(text.replace("\n# ", " ").split())
            assert meaning.split(";")[0] in comments, name
            assert re.search(rf"^#?\[*([\w.]*\.)?\"?{name}\b", text, flags=re.M), name
            if "unit" in field and field["unit"] != "1":
                assert f"{meaning}" in comments
                assert re.search(rf"; {re.escape(field['unit'])}, \S+ to \S+", comments), name


def test_a_robot_with_everything_taken_into_use_loads():
    """Each remaining value is the low end of the range in the comment above it."""
    chosen = FILLED | {
        "belt": '"grousers"', "mass": 30, "length": 0.33, "root_radius": 0.09, "tip_radius": 0.03,
        "pivot_height": 0.09,
    }  # fmt: skip
    text = re.sub(r"^#(?! |$)", "", blank_toml(Robot, name="whole", title="y"), flags=re.M)
    text = re.sub(r"^(indentation|sag) = .*\n", "", text, flags=re.M)  # stiffnesses stand instead
    text = text.replace('from_front = ["FILL IN"]', "from_front = [0.2, 0.3]")
    text = text.replace('height = ["FILL IN"]', "height = [0.1, 0.2]")
    lines = text.splitlines()
    for index, line in enumerate(lines):
        if line.endswith('= "FILL IN"'):
            name = line.split()[0]
            low = re.search(r"(\S+) (?:to|or) \S+$", lines[index - 1]).group(1)
            lines[index] = f"{name} = {chosen.get(name, low)}"
    robot = Robot.from_text("\n".join(lines), origin="whole")
    assert robot.front_flippers is not None
    assert robot.rear_flippers is not None
    assert robot.track.stiffness == 100
    assert robot.sources["track.flat_length"].startswith("V: ")


def test_a_measured_flight_from_a_new_sheet_loads():
    text = blank_toml(Stairs, name="measured", title="mine")
    text = re.sub(r"^(rise|going) = .*\n", "", text, flags=re.M)
    text = text.replace('#rises = ["FILL IN"]', "rises = [0.15, 0.18, 0.18]")
    text = text.replace('#goings = ["FILL IN"]', "goings = [0.28, 0.28]")
    assert Stairs.from_text(text, origin="measured").step_rises == (0.15, 0.18, 0.18)


def test_new_overwrites_only_when_told(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("precious")
    with pytest.raises(InputError) as caught:
        run("new", "robot", str(path))
    assert str(caught.value) == f"{path} is there already; --force replaces it"
    assert path.read_text() == "precious"
    run("new", "robot", str(path), "--force")
    assert 'name = "mine"' in path.read_text()


def test_new_does_not_follow_a_dangling_link(tmp_path):
    link = tmp_path / "link.toml"
    try:
        link.symlink_to(tmp_path / "nowhere.toml")
    except OSError:
        pytest.skip("this system makes no links")
    with pytest.raises(InputError, match="is there already"):
        run("new", "robot", str(link))
    assert not (tmp_path / "nowhere.toml").exists()


@pytest.mark.parametrize("name", ["mine", "mine.txt", ".toml"])
def test_new_wants_a_toml_file(tmp_path, name):
    with pytest.raises(InputError, match=r"a sheet is a TOML file; write .+\.toml$"):
        run("new", "stairs", str(tmp_path / name))
    assert list(tmp_path.iterdir()) == []


def test_new_says_when_the_folder_is_missing(tmp_path):
    with pytest.raises(InputError, match="cannot be written: No such file or directory"):
        run("new", "stairs", str(tmp_path / "no" / "mine.toml"))


def test_new_leaves_nothing_half_written(tmp_path, monkeypatch):
    path = tmp_path / "mine.toml"
    path.write_text("precious")

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(InputError, match="No space left on device"):
        run("new", "robot", str(path), "--force")
    assert path.read_text() == "precious"
    assert [each.name for each in tmp_path.iterdir()] == ["mine.toml"]


@pytest.mark.parametrize(
    "name",
    ['quo"te.toml', "back\\slash.toml", "階段.toml", "new\nline.toml", "\x01.toml", "# x.toml"],
)
def test_new_sheets_of_odd_names_are_toml(tmp_path, name):
    path = tmp_path / name
    try:
        run("new", "surface", str(path))
    except InputError as error:
        pytest.skip(f"this file system knows no such name: {error}")
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    assert table == {
        "name": name.removesuffix(".toml"),
        "friction_low": "FILL IN",
        "friction_high": "FILL IN",
    }


@pytest.mark.parametrize("what", SHEETS)
def test_the_schema_accepts_the_catalogue_and_names_units_and_symbols(what):
    schema = json.loads(run("schema", what))
    validator = jsonschema.validators.validator_for(schema)
    validator.check_schema(schema)
    for name in catalog.names(LISTS[what]):
        text = SHEETS[what].named(name).to_toml()
        validator(schema).validate(tomllib.loads(text))
    assert not validator(schema).is_valid({"rise": 180, "going": 280, "friction_low": 60})

    text = json.dumps(schema)
    assert '"unit": ' in text
    for symbol in {"robot": ("L", "C_L", "C_N", "R"), "surface": ("mu_s",)}.get(what, ()):
        assert f'"symbol": "{symbol}"' in text


def test_the_schema_of_a_question_accepts_what_assess_echoes():
    schema = json.loads(run("schema", "question"))
    assert schema.pop("$schema") == "https://json-schema.org/draft/2020-12/schema"
    assert schema == Question.model_json_schema()
    answer = json.loads(run("assess", "kenaf", "ibc", "--model", "closed-form", "--json"))
    jsonschema.Draft202012Validator(schema).validate(answer["question"])


def test_main_refuses_in_one_line_with_exit_code_2(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["kaidan", "robots", "kenav"])
    ended = ended_with(sys.argv[1:])
    assert ended == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("kaidan: no robot is called 'kenav' and no such file exists. ")
    assert captured.err.count("\n") == 1


@pytest.mark.parametrize("words", [("new", "stair", "x.toml"), ("schema",), ("new", "robot")])
def test_wrong_words_end_with_exit_code_2(words):
    assert CliRunner().invoke(app, list(words)).exit_code == 2


def test_the_whole_process_in_a_terminal_that_knows_few_characters(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('title = "階段"\nrise = 0.18\ngoing = 0.28\n', encoding="utf-8")
    environment = {**os.environ, "PYTHONIOENCODING": "latin-1", "PYTHONUTF8": "0"}
    for words, seen in ((["stairs", str(path)], "stairs: ??"), (["robots"], "kenaf")):
        done = subprocess.run(
            [sys.executable, "-m", "kaidan", *words],
            capture_output=True,
            env=environment,
            timeout=60,
        )
        assert (done.returncode, done.stderr) == (0, b"")
        assert seen in done.stdout.decode("latin-1")


@pytest.mark.parametrize("what", LISTS)
def test_the_catalogues_fit_a_screen_of_80_columns(what, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    lines = run(LISTS[what]).splitlines()
    assert max(map(len, lines)) <= 80
    for name in catalog.names(LISTS[what]):
        at = next(k for k, line in enumerate(lines) if line.split()[:1] == [name])
        assert lines[at + 1] == f"    {SHEETS[what].named(name).title}"
