"""What code, tests and pages cite is in the repository, or public."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CODE = sorted(
    path.relative_to(ROOT)
    for folder in ("src", "tests", "benchmarks", "docs")
    for path in ROOT.glob(f"{folder}/**/*.py")
    if "_build" not in path.parts and path != Path(__file__)
)
PAGES = sorted(
    path.relative_to(ROOT)
    for path in (*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"))
    if "_build" not in path.parts
)
PAGE = re.compile(r"(?<![\w/.:{*-])[\w./-]+\.md\b")
ELSEWHERE = re.compile(
    r"\btheory,? (?:page\b|sect(?:ion|\.)?\b|\d)|\bsections? \d|\.\./shared\b|\bissue \d",
    re.IGNORECASE,
)
"""A theory without a path, a section of nothing, a folder beside the repository, a tracker."""
PAPERS = ("paper", "Endo", "doi:")
"""Whose sections may be cited: the line says so."""


@pytest.mark.parametrize("path", CODE, ids=str)
def test_code_cites_pages_by_their_path_in_the_repository(path):
    text = (ROOT / path).read_text(encoding="utf-8")
    assert [page for page in PAGE.findall(text) if not (ROOT / page).is_file()] == []


@pytest.mark.parametrize("path", [*CODE, *PAGES], ids=str)
def test_nothing_is_cited_that_a_reader_of_the_repository_cannot_open(path):
    lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
    found = [
        line.strip()
        for line in lines
        if ELSEWHERE.search(line) and not any(name in line for name in PAPERS)
    ]
    assert found == []


@pytest.mark.parametrize("path", PAGES, ids=str)
def test_links_between_pages_lead_somewhere(path):
    text = (ROOT / path).read_text(encoding="utf-8")
    links = re.findall(r"\]\((?!\w+:)([^)#\s]+)", text)
    gone = [
        link
        for link in links
        if not ((ROOT / path).parent / link).exists() and not link.endswith((".rst", ".html"))
    ]  # .rst and .html are written when the site is built
    assert gone == []


def test_the_citation_file_has_the_version_and_the_paper():
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    import kaidan

    assert f"\nversion: {kaidan.__version__}\n" in text
    assert "\n    doi: 10.1186/s40648-016-0058-y\n" in text
