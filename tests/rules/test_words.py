"""Retired words stay out of what people read: texts and docstrings of the code, README, docs.

One word for one thing, and the one that the field uses; docs/glossary.md says which.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

RETIRED = {
    r"sw(?:ing|ings|inging|ung)": "rotation, rocking",
    r"catch(?:es|ing)?|caught": "arrested by the next contact",
    r"held (?:only )?by": "arrested by, carried by",
    r"let(?:s|ting)? go": "onset of rotation, detach",
    r"turn(?:s|ed|ing)? over": "tips over",
    r"kindest|unkind|kind(?:er)? (?:reading|end|case)": "best case, worst case",
    r"readings?": "case (best, worst), state, file",
    r"(?:taken?|takes|taking|comes?|came) off": "subtracted, allowance",
    r"energy wanted|wanted": "required, requested",
    r"(?:is|are|was) worth": "kinetic-energy height, amounts to",
    r"told": "reported, stated",
    r"asked": "requested, given",
    r"hardest": "maximum",
    r"only known as": "given as a range",
    r"the whole way|all the way|of the way|along (?:a|the|its) way": "the path, the traverse",
    r"slip_up|slip_down": "slides_down, slides_up",
    r"journeys?|happenings?|landscapes?|neighbours": "traverse, events, pose map",
}
"""Words by what to write instead; `_` counts as a space, so that names of fields count too."""

PATTERN = re.compile(
    "|".join(rf"\b(?:{word})\b" for word in RETIRED).replace(" ", r"[\s_]+"), re.IGNORECASE
)


def code() -> list[Path]:
    return sorted(path.relative_to(ROOT) for path in ROOT.glob("src/**/*.py"))


def pages() -> list[Path]:
    found = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("docs/examples/*.py")]
    return sorted(path.relative_to(ROOT) for path in found if "_build" not in path.parts)


def texts(path: Path) -> list[str]:
    """Strings of a module, or the lines of a page."""
    source = (ROOT / path).read_text(encoding="utf-8")
    if path.suffix != ".py":
        return source.splitlines()
    return [
        node.value
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    ]


def retired(text: str) -> list[str]:
    """Retired words of a text, sorted."""
    spaced = re.sub(r"(?<=[a-z])_(?=[a-z])", " ", text)
    return sorted({match.group() for where in (text, spaced) for match in PATTERN.finditer(where)})


def test_the_pattern_finds_what_it_is_for():
    assert retired("its Worst reading, Caught") == ["Caught", "reading"]
    assert retired("largest_swing_deg") == ["swing"]
    assert retired("what its speed\n is  worth") == ["is  worth"]
    assert retired("slip_down") == ["slip_down"]
    assert retired("returned, turned, catchment") == []


def said_in_retired_words(path: Path) -> list[str]:
    found = {word: text for text in texts(path) for word in retired(text)}
    return [f"{word!r} in {' '.join(text.split())[:80]!r}" for word, text in found.items()]


@pytest.mark.parametrize("files", [code, pages])
def test_no_retired_word(files):
    assert len(files()) >= 80
    assert {str(path): said for path in files() if (said := said_in_retired_words(path))} == {}


def helps(path: Path) -> list[str]:
    """What a module of the command line says of its options and commands."""
    return [
        ast.literal_eval(node.value)
        for node in ast.walk(ast.parse((ROOT / path).read_text(encoding="utf-8")))
        if isinstance(node, ast.keyword)
        and node.arg == "help"
        and isinstance(node.value, ast.Constant)
    ]


def test_the_help_of_an_option_names_what_it_is():
    """Not "Of the draws.": a line of help is read without the name of its option."""
    modules = [path for path in code() if "cli" in path.parts]
    said = {
        str(path): [text for text in helps(path) if re.match(r"(?:Of|On) ", text)]
        for path in modules
    }
    assert sum(len(helps(path)) for path in modules) > 100
    assert {path: texts for path, texts in said.items() if texts} == {}
