"""`kaidan lab bench`: tools on frozen cases, of which they do not see the outcome."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.lab.outcomes.bench import TOOLS, Bench, bench

SOURCES = {
    "endo-nagatani, derived": 13,
    "endo-nagatani, printed": 3,
    "endo-nagatani, every 5 deg": 20,
    "gazebo, printed": 1,
}
"""Truth and its number of flights, as `kaidan/catalog/outcomes.toml` has them."""


def adapter(tmp_path, body):
    path = tmp_path / "own_tool.py"
    path.write_text(body)
    return path


@pytest.fixture(scope="module")
def found():
    return bench()


def test_every_tool_on_every_source(found):
    assert {(s.tool, s.truth): s.cases for s in found.scores} == {
        (tool, truth): cases for tool in TOOLS for truth, cases in SOURCES.items()
    }
    for score in found.scores:
        parts = score.right + score.wrong_go + score.wrong_no_go + score.undecided
        assert parts == score.cases
        assert score.ms > 0.0
    assert Bench.from_json(found.to_json()) == found


def test_the_paper_by_hand(found):
    # printed: 55 and 57 deg are below 60.2, 44 below 46.2: GO, where it fell, fell and rocked
    paper = next(s for s in found.scores if s.tool.startswith("Eqs") and "printed" in s.truth)
    assert (paper.wrong_go, paper.wrong_no_go, paper.undecided) == (3, 0, 0)


def test_kaidan_says_no_go_that_is_wrong(found):
    assert all(s.wrong_go == 0 for s in found.scores if s.tool == "kaidan")


def test_an_adapter_sees_no_outcome(tmp_path):
    path = adapter(
        tmp_path,
        """
import json, pathlib
def answer(case):
    with open(pathlib.Path(__file__).with_name("seen"), "a") as seen:
        seen.write(json.dumps(case) + "\\n")
    return "GO"
""",
    )
    scores = {s.truth: s for s in bench(path).scores if s.tool == "own_tool"}
    # by hand: of the three printed ones none climbed, of the simulation's one it did
    assert scores["endo-nagatani, printed"].wrong_go == 3
    assert scores["gazebo, printed"].right == 1
    seen = [json.loads(line) for line in (tmp_path / "seen").read_text().splitlines()]
    assert len(seen) == sum(SOURCES.values())
    assert not {"outcome", "note", "status", "truth"} & {key for case in seen for key in case}


def test_the_adapter_of_the_documentation_runs(tmp_path):
    page = (Path(__file__).parents[3] / "docs/lab/outcomes.md").read_text()
    example = next(part for part in page.split("```") if part.startswith("python\ndef answer"))
    assert len(example.splitlines()) <= 30
    path = adapter(tmp_path, example.removeprefix("python\n"))
    assert "own_tool" in {score.tool for score in bench(path).scores}


def test_what_is_no_adapter(tmp_path):
    with pytest.raises(InputError, match="has no function answer"):
        bench(adapter(tmp_path, "x = 1"))
    with pytest.raises(InputError, match="is no Python file"):
        bench(tmp_path / "none.py")


def test_one_command(found):
    printed = CliRunner().invoke(app, ["lab", "bench"]).stdout
    for word in ("wrong GO", "wrong NO-GO", "undecided", "ms", *TOOLS):
        assert word in printed
