"""Pictures of README and docs: there, small, shown, of the verdict that names them."""

import json
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from kaidan.cli import app

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))
from remake_pictures import PICTURES, STATIC  # noqa: E402

LARGEST = 200_000
"""Bytes of a file that everybody clones."""


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_there_and_small_and_shown(name):
    assert 0 < (STATIC / name).stat().st_size <= LARGEST
    pages = [ROOT / "README.md", *ROOT.glob("docs/*.md")]
    assert any(f"_static/{name})" in page.read_text(encoding="utf-8") for page in pages)


@pytest.mark.parametrize("name", [name for name in PICTURES if name.endswith("go.png")])
def test_a_traverse_is_named_after_its_verdict(name):
    words = PICTURES[name].removesuffix(" --side").split()
    done = CliRunner().invoke(app, [*words, "--json"])
    assert json.loads(done.stdout)["assessment"]["verdict"] == Path(name).stem


def test_pictures_of_the_page_are_small_and_shown():
    names = [path.name for path in STATIC.glob("page-*.png")]
    shown = (ROOT / "docs/page.md").read_text(encoding="utf-8")
    assert len(names) > 3
    for name in names:
        assert (STATIC / name).stat().st_size <= LARGEST / 2
        assert f"_static/{name})" in shown
