"""`kaidan compare`: every cell is what assess says."""

import csv
import io
import json

import jsonschema
import pytest
from typer.testing import CliRunner

from amounts import fast_and_slow
from kaidan import catalog
from kaidan.assessment import answer_to, assess
from kaidan.cli import app
from kaidan.errors import InputError, UnknownNameError
from kaidan.figures.comparison_figure import comparison_figure
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.comparison import WORTH_A_PROCESS, Comparison, compare


def run(*arguments, **options):
    return CliRunner().invoke(app, ["compare", *arguments], **options)


def test_defaults_are_all_robots_on_all_stairs():
    found = json.loads(run("--json", "--friction", "0.8", "--flippers", "flat").stdout)
    assert tuple(found["robots"]) == catalog.names("robots")
    assert tuple(found["stairs"]) == catalog.names("stairs")
    assert len(found["cells"]) == len(found["robots"]) * len(found["stairs"])
    assert {each["name"] for each in found["without_centroid"]} == set(catalog.gross_robots())


@pytest.mark.parametrize("every", fast_and_slow(3, 1))
@pytest.mark.parametrize("model", ["contact", "closed-form"])
@pytest.mark.parametrize(
    ("arguments", "options"),
    [
        (["--friction", "0.8"], {"friction": 0.8}),
        (["--surface", "concrete-dry", "--direction", "down"],
         {"surface": "concrete-dry", "direction": "down"}),
        (["--facing", "tail-first", "--acceleration", "0.5m/s2", "--theta-d", "1deg"],
         {"facing": "tail-first", "acceleration": 0.5, "theta_d": 0.017453292519943295}),
    ],
)  # fmt: skip
def test_every_cell_is_what_assess_says(arguments, options, model, every):
    robots = catalog.names("robots")[::every]
    words = [*robots, "--json", "--model", model, "--flippers", "flat", *arguments]
    words += ["--workers", "1"]  # several: test_processes_say_what_one_says
    found = json.loads(run(*words).stdout)
    assert found["model"] == model
    assert tuple(found["robots"]) == robots
    for cell in found["cells"]:
        robot = Robot.named(cell["robot"])
        has = robot.front_flippers is not None or robot.rear_flippers is not None
        options |= {"flippers": "flat" if has else "stowed", "model": model}
        answer = answer_to(Question.of(robot, cell["stairs"], **options), advice=False)
        assert cell["verdict"] == answer.verdict
        assert cell["governs"] == answer.governs
        assert cell["flippers"] == ("flat" if has else "")
        assert cell["margin_deg"] == (
            None if answer.margin_deg is None else pytest.approx(answer.margin_deg, abs=1e-12)
        )


@pytest.mark.parametrize("manner", [{}, {"facing": "tail-first"}])
def test_without_a_posture_each_cell_is_the_best_plan_of_assess(manner):
    found = compare(["absolem", "kenaf"], ["ibc", "ada"], friction=1.2, **manner)
    assert found.planned
    assert found.facing == manner.get("facing")
    for cell in found.cells:
        answer = assess(cell.robot, cell.stairs, friction=1.2, flippers="best", **manner)
        has = bool(Robot.named(cell.robot).flippers())
        assert cell.flippers == (answer.question.flippers if has else "")
        assert (cell.facing, cell.verdict) == (answer.question.facing, answer.verdict)
        assert cell.margin_deg == pytest.approx(answer.margin_deg, abs=1e-12)
    assert "each with the best plan of its flippers" in str(found)


def test_a_model_without_plans_has_the_better_of_stowed_and_flat():
    asked = {"friction": 2.0, "model": "closed-form"}
    found = compare(["absolem"], ["ibc"], **asked)
    each = [
        compare(["absolem"], ["ibc"], **asked, flippers=flippers, facing=facing)
        for flippers in ("stowed", "flat", "flat,stowed", "stowed,flat")
        for facing in ("nose-first", "tail-first")
    ]
    assert found.planned
    assert not any(one.planned for one in each)
    # margins beyond 15 deg are worth no more, so the best may have less than the largest
    largest = max(one.cells[0].margin_deg or -90.0 for one in each)
    assert found.cells[0].margin_deg >= min(largest, 15.0) - 1e-9
    assert "each with the best of stowed and flat flippers" in str(found)


def test_files_and_page(tmp_path):
    table, figure = tmp_path / "c.csv", tmp_path / "c.pdf"
    result = run("kenaf", "absolem", "teodor", "--stairs", "ibc", "--stairs", "osha-ship",
                 "--friction", "0.8", "--model", "closed-form", "--csv", str(table),
                 "--figure", str(figure))  # fmt: skip
    assert result.exit_code == 0
    rows = list(csv.DictReader(io.StringIO(table.read_text())))
    assert [(row["stairs"], row["robot"], row["verdict"]) for row in rows] == [
        ("ibc", "kenaf", "outside-model"),
        ("ibc", "absolem", "go"),
        ("osha-ship", "kenaf", "outside-model"),
        ("osha-ship", "absolem", "no-go"),
    ]
    assert rows[0]["margin_deg"] == ""
    assert figure.read_bytes().startswith(b"%PDF")
    assert "? OUTSIDE" in result.stdout
    assert "closed form, the regular flight alone" in result.stdout
    assert "+ GO +6.1" in result.stdout  # hand: atan(0.8) - atan(178/279) = 6.12 deg
    assert "x NO-GO -31.3" in result.stdout  # hand: atan(0.8) - atan(305/111.1) = -31.3 deg
    assert "teodor: tEODor" in result.stdout
    assert "each with the best of stowed and flat flippers" in result.stdout


def test_the_same_from_python_and_read_back():
    found = compare(["kenaf", "teodor"], ["ibc", "osha-ship"], friction=0.8)
    words = (
        "kenaf",
        "teodor",
        "--stairs",
        "ibc",
        "--stairs",
        "osha-ship",
        "--friction",
        "0.8",
    )
    assert run(*words).stdout.rstrip("\n") == str(found)
    assert Comparison.from_json(run(*words, "--json").stdout) == found
    jsonschema.validate(found.to_dict(), Comparison.json_schema())


def test_where_friction_decides_belts_that_no_sheet_describes_are_named():
    asked = {"robots": ["absolem", "kenaf"], "stairs": ["ada"], "flippers": "flat"}
    low = compare(**asked, friction=0.2, model="closed-form")
    assert low.belts_open == ("absolem", "kenaf")
    decides = {cell.robot: cell.governs for cell in low.cells}
    named = [name for name, governs in decides.items() if governs == "slides_down"]
    assert named == ["absolem"]
    assert "friction decides for absolem: if they have grousers, --override track.belt" in str(low)
    stated = compare(**asked, friction=0.2, model="closed-form", override="track.belt=grousers")
    assert stated.belts_open == ()
    enough = compare(**asked, friction=0.8, model="closed-form")
    nearest = enough.cells[0]
    assert (nearest.verdict, nearest.governs) == ("go", "slides_down")
    for found in (stated, enough):
        assert "grousers" not in str(found)


def test_flippers_may_stay_stowed():
    found = json.loads(run("absolem", "--stairs", "ibc", "--flippers", "stowed", "--json").stdout)
    assert found["model"] == "contact"  # as assess
    assert found["cells"][0]["verdict"] == "no-go"
    assert found["cells"][0]["flippers"] == "stowed"


def test_bad_input(tmp_path):
    with pytest.raises(InputError, match="no centroid is published of teodor: nothing to"):
        run("teodor", catch_exceptions=False)
    with pytest.raises(UnknownNameError):
        run("kenaff", catch_exceptions=False)
    with pytest.raises(InputError, match="unknown suffix"):
        run("kenaf", "--figure", str(tmp_path / "c.gif"), catch_exceptions=False)
    with pytest.raises(InputError, match="model = 'luck' is not known; known: contact, closed-"):
        run("kenaf", "--model", "luck", catch_exceptions=False)
    assert not list(tmp_path.iterdir())


def test_any_size_can_be_drawn_and_its_words_stay_apart():
    stairs = [Stairs.named(name) for name in catalog.names("stairs")]
    names = catalog.names("robots")
    odd = Robot.named("kenaf").model_copy(update={"name": "a$very_long-name " * 4})
    for robots, flights in (
        ([Robot.named("kenaf")], stairs[:1]),
        ([Robot.named(name) for name in names] * 2, stairs[:3]),
        ([odd, Robot.named("ozbot-atr")], stairs),
    ):
        found = compare([*robots, *catalog.gross_robots()], flights, friction=0.8, flippers="flat")
        figure = comparison_figure(found)
        figure.draw_without_rendering()
        boxes = [text.get_window_extent() for text in figure.axes[0].texts if text.get_text()]
        for index, box in enumerate(boxes):
            assert box.x0 >= 0
            assert box.x1 <= figure.bbox.width
            assert not any(box.overlaps(other) for other in boxes[:index])


def test_processes_say_what_one_says():
    robots, stairs = (
        ["kenaf", "marmotte", "csiro-dtr", "absolem-flat"],
        ["ibc", "ada", "osha", "din-general"],
    )
    alone, shared = (compare(robots, stairs, friction=0.8, workers=each) for each in (1, 2))
    assert len(alone.cells) == 2 * WORTH_A_PROCESS
    assert shared == alone


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"stairs": []}, "compare: no stairs are given"),
        ({"robots": []}, "compare: no robots are given"),
    ],
)
def test_a_comparison_of_nothing_is_refused(given, text):
    with pytest.raises(InputError) as refused:
        compare(**given, friction=1.0)
    assert str(refused.value) == text
