"""The documentation site builds without warnings and asks the network for nothing."""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
FETCHED = re.compile(
    r"<(?:script|img|iframe|source|video|audio)[^>]*\ssrc=\"(?:https?:)?//[^\"]*\""
    r"|<link(?=[^>]*rel=\"(?:stylesheet|preload|icon|preconnect|shortcut icon)\")[^>]*"
    r"href=\"(?:https?:)?//[^\"]*\""
    r"|@import\s+(?:url\()?[\"']?(?:https?:)?//|url\([\"']?(?:https?:)?//",
)
"""What a browser would fetch; a link that a reader may follow is not."""


@pytest.mark.parametrize("kind", ["robots", "unweighed", "stairs", "surfaces"])
def test_every_sheet_of_the_catalogues_is_written(kind, monkeypatch):
    pytest.importorskip("sphinx", reason="pip install '.[docs]'")
    monkeypatch.syspath_prepend(str(DOCS / "_ext"))
    from kaidan_docs import CATALOG, SHEETS, _figures

    for file in sorted((CATALOG / kind).glob("*.toml")):
        content = tomllib.loads(file.read_text(encoding="utf-8"))
        figures = [shown for _, _, shown in _figures(SHEETS[kind], content)]
        assert figures
        assert all(figures)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    pytest.importorskip("sphinx", reason="pip install '.[docs]'")
    folder = tmp_path_factory.mktemp("site")
    source = folder / "docs"
    shutil.copytree(DOCS, source, ignore=shutil.ignore_patterns("_build", "gallery"))
    for page in ("CONTRIBUTING.md", "CHANGELOG.md"):
        shutil.copy(DOCS.parent / page, folder)
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "-n", "-b", "html", source, folder / "html"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    )
    assert done.returncode == 0, done.stdout
    return folder / "html"


@pytest.mark.slow
def test_the_site_builds_without_warnings(site):
    assert (site / "index.html").is_file()


@pytest.mark.slow
def test_the_site_fetches_nothing_from_elsewhere(site):
    for path in [*site.rglob("*.html"), *site.rglob("*.css")]:
        found = FETCHED.search(path.read_text(encoding="utf-8"))
        assert found is None, f"{path.relative_to(site)}: {found.group() if found else ''}"


@pytest.mark.slow
def test_formulas_are_mathml(site):
    page = (site / "theory" / "margin.html").read_text(encoding="utf-8")
    assert page.count("<math ") > 20
    assert '<span class="eqno">(19)</span>' in page
    assert "MathJax" not in page


@pytest.mark.slow
def test_no_path_of_the_builder_is_in_the_site(site):
    for path in site.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert str(DOCS) not in text, path.name
        assert str(site) not in text, path.name
