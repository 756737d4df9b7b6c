"""`kaidan lab physics`: pages, JSON, files and refusals."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from kaidan.cli import app
from kaidan.errors import InputError, KaidanError

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

STEEP = ("--angle", "50deg", "--nosing-spacing", "150mm", "--start-offset", "0.3")


def run(*arguments):
    return CliRunner().invoke(app, ["lab", "physics", *map(str, arguments)])


def refusal(*arguments):
    result = run(*arguments)
    assert isinstance(result.exception, InputError), result.output
    return str(result.exception)


def test_the_page_for_people():
    result = run("trial", "kenaf", *STEEP)
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0] == "CLIMBED  kenaf on 50 deg at 150 mm, up nose first"
    assert "  mass               20 kg, assumed: the sheet gives none, inertia estimated" in lines
    assert "  nosings passed     2, begun at 0.300 of a spacing" in lines


def test_a_fall_is_exit_code_1_and_says_where():
    result = run("trial", "kenaf", "--angle", "68deg", "--nosing-spacing", "150mm",
                 "--start-offset", 0.3)  # fmt: skip
    assert result.exit_code == 1
    assert result.stdout.startswith("FELL BACKWARD (traverse, step 4)  kenaf on 68 deg at 150 mm")


def test_json_holds_all_that_it_came_from():
    result = run(
        "trial", "kenaf", *STEEP, "--track", "sprung-noses", "--stiffness", "30kN/m", "--json"
    )
    told = json.loads(result.stdout)
    assert told["outcome"] == "climbed"
    assert told["spec"]["track"]["stiffness"] == 30e3
    assert told["spec"]["question"]["robot"]["name"] == "kenaf"
    assert told["versions"]["mujoco"]
    assert told["mass_assumed"] is True


def test_files_of_a_trial(tmp_path):
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    csv, table, figure = tmp_path / "a.csv", tmp_path / "a.parquet", tmp_path / "a.svg"
    result = run("trial", "kenaf", *STEEP, "--log", csv, "--figure", figure)
    assert result.exit_code == 0
    assert run("trial", "kenaf", *STEEP, "--log", table).exit_code == 0
    head, *rows = csv.read_text().splitlines()
    assert head.startswith("time_s,belt_m,x_m,z_m,inclination_deg,extra_deg,path_m")
    read = parquet.read_table(table)
    assert read.column_names == head.split(",")
    assert read.num_rows == len(rows)
    assert np.allclose(read["belt_m"].to_numpy()[-1], float(rows[-1].split(",")[1]))
    assert json.loads(read.schema.metadata[b"kaidan.trial"])["outcome"] == "climbed"
    assert figure.read_text().startswith("<?xml")


def test_pictures_and_films_without_a_display(tmp_path):
    picture, film = tmp_path / "a.png", tmp_path / "a.gif"
    result = run("trial", "kenaf", *STEEP, "--nosings", 1, "--picture", picture, "--video", film)
    if isinstance(result.exception, KaidanError) and "OpenGL" in str(result.exception):
        assert "apt-get install libegl1" in str(result.exception)
        pytest.skip("nothing can be drawn here")
    assert result.exit_code == 0, result.output
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert film.read_bytes().startswith(b"GIF89a")


def test_where_nothing_can_be_drawn_the_text_says_what_to_install(monkeypatch, tmp_path):
    import mujoco

    def broken(*_, **__):
        raise RuntimeError("no GL")

    monkeypatch.setattr(mujoco, "Renderer", broken)
    monkeypatch.setenv("MUJOCO_GL", "egl")
    result = run("trial", "kenaf", *STEEP, "--nosings", 1, "--picture", tmp_path / "a.png")
    assert isinstance(result.exception, KaidanError)
    assert str(result.exception) == (
        "pictures need OpenGL without a display (EGL or OSMesa), which does not work here "
        "(MUJOCO_GL=egl: no GL): apt-get install libegl1 libgl1-mesa-dri, or libosmesa6; where "
        "mujoco is imported before kaidan.physics, set MUJOCO_GL=egl or osmesa"
    )
    assert list(tmp_path.iterdir()) == []


def test_export_opens_in_mujoco(tmp_path):
    import mujoco

    file = tmp_path / "a.xml"
    assert run("export", "absolem", "ibc", "--file", file, "--flippers", "flat").exit_code == 0
    assert mujoco.MjModel.from_xml_path(str(file)).nv == 3
    assert run("export", "kenaf", "--file", file, *STEEP).exit_code == 0


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (
            ("trial", "kenaf", *STEEP, "--track", "wheels"),
            "--track 'wheels' is not a model; known: smooth-belt, yielding-belt, sprung-noses, "
            "driven-grousers, shoe-chain",
        ),
        (
            ("trial", "kenaf", *STEEP, "--shoes", "50"),
            "--shoes does not go with --track smooth-belt",
        ),
        (
            ("trial", "kenaf", *STEEP, "--track", "sprung-noses"),
            "trial: sprung-noses needs a stiffness; the track of 'kenaf' states none",
        ),
        (
            ("trial", "kenaf", *STEEP, "--track", "sprung-noses", "--stiffness", "30"),
            "--stiffness '30' has no unit; write 30N/m or 30kN/m or 30N/mm",
        ),
        (
            ("trial", "kenaf", *STEEP, "--begin", "roof"),
            "trial: begin = \"roof\" is not one of flight, landing",
        ),
        (("trial", "kenaf", *STEEP, "--log", "a.txt"),
         "log 'a.txt': unknown suffix '.txt'; known: .csv, .parquet"),
        (("trial", "kenaf", *STEEP, "--video", "a"), "video 'a': no suffix; known: .mp4, .gif"),
        (("trial", "kenaf", *STEEP, "--picture", "a.jpg"),
         "picture 'a.jpg': a picture ends in .png"),
        (("export", "kenaf", *STEEP, "--file", "model"),
         "model 'model': a file of MuJoCo ends in .xml"),
    ],
    ids=lambda value: "" if isinstance(value, str) else value[-1],
)  # fmt: skip
def test_what_has_no_meaning_is_refused(words, text):
    assert refusal(*words) == text


def test_a_trial_that_never_began_has_no_figure():
    from kaidan.lab.physics.figure import trial_figure
    from kaidan.physics import record
    from physics_cases import spec

    log = record(spec(80.0, start_offset=0.95))
    with pytest.raises(InputError, match=r"^trial: it has no log to draw \(outcome: start_fall\)$"):
        trial_figure(log)
