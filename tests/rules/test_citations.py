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


def text_of(path: Path) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def pages_that_are_not_there(path: Path) -> list[str]:
    return [page for page in PAGE.findall(text_of(path)) if not (ROOT / page).is_file()]


def cited_from_elsewhere(path: Path) -> list[str]:
    text = text_of(path)
    if not ELSEWHERE.search(text):
        return []
    return [
        line.strip()
        for line in text.splitlines()
        if ELSEWHERE.search(line) and not any(name in line for name in PAPERS)
    ]


def links_to_nowhere(path: Path) -> list[str]:
    """But for .rst and .html, written when the site is built."""
    links = re.findall(r"\]\((?!\w+:)([^)#\s]+)", text_of(path))
    return [
        link
        for link in links
        if not ((ROOT / path).parent / link).exists() and not link.endswith((".rst", ".html"))
    ]


@pytest.mark.parametrize(
    ("faults", "files"),
    [
        (pages_that_are_not_there, CODE),
        (cited_from_elsewhere, [*CODE, *PAGES]),
        (links_to_nowhere, PAGES),
    ],
    ids=["pages by their path in the repository", "what a reader can open", "links lead somewhere"],
)
def test_what_is_cited_is_there(faults, files):
    assert len(files) >= 80
    assert {str(path): found for path in files if (found := faults(path))} == {}


@pytest.mark.parametrize("line", ["see theory, section 3", "../shared/kernel.md", "Issue 7"])
def test_the_rule_finds_what_it_forbids(line):
    assert ELSEWHERE.search(line)


def test_the_citation_file_has_the_version_and_the_paper():
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    import kaidan

    assert f"\nversion: {kaidan.__version__}\n" in text
    assert "\n    doi: 10.1186/s40648-016-0058-y\n" in text
