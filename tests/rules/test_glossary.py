"""Every name of a field and every word of an answer is explained in the documentation."""

import re
import sys
from pathlib import Path

from kaidan import modes
from kaidan.answer import meanings

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "docs" / "_ext"), str(Path(__file__).parent)]
from models import models  # noqa: E402
from test_words import retired  # noqa: E402

GLOSSARY = (ROOT / "docs/glossary.md").read_text(encoding="utf-8")
PAGES = "\n".join(
    path.read_text(encoding="utf-8")
    for path in ROOT.glob("docs/**/*.md")
    if "_build" not in path.parts
)
PARTS = models("Answer", "Part")
SHEETS = [each for each in models("Sheet", "QuestionFields") if not each.__subclasses__()]


WORDS = [
    *modes.FAILURE_MODES,
    *modes.Undecided,
    *modes.Phase,
    *modes.MODELS,
    *(verdict.label for verdict in modes.Verdict),
]


def test_there_is_something_to_explain():
    assert len(PARTS) > 100
    assert len(SHEETS) > 20
    assert len(WORDS) > 30


def test_every_field_says_what_it_means():
    """Itself, or in the glossary if it is the same everywhere."""
    silent = [
        f"{model.__name__}.{name}"
        for model in (*PARTS, *SHEETS)
        for name, meaning in meanings(model).items()
        if not meaning and f"`{name}`" not in GLOSSARY
    ]
    assert silent == []


def test_no_field_is_called_by_a_retired_word():
    names = {f"{each.__name__}.{name}": name for each in (*PARTS, *SHEETS)
             for name in each.model_fields}  # fmt: skip
    assert {where: retired(name) for where, name in names.items() if retired(name)} == {}


def test_every_sheet_has_a_table_in_the_docs():
    """Those of answers are written from the schemas by ``{answers}``."""
    shown = set(re.findall(r"{sheet} kaidan[\w.]*\.(\w+)\n", PAGES))
    assert {sheet.__name__ for sheet in SHEETS} - shown == set()


def test_symbols_of_fields_are_in_the_glossary():
    extras = {
        f"{sheet.__name__}.{name}": field.json_schema_extra
        for sheet in SHEETS
        for name, field in sheet.model_fields.items()
    }
    symbols = {
        where: extra["symbol"]
        for where, extra in extras.items()
        if isinstance(extra, dict) and "symbol" in extra
    }
    assert symbols
    assert {name: it for name, it in symbols.items() if f"`{it}`" not in GLOSSARY} == {}


def test_words_of_answers_are_in_the_glossary():
    unexplained = [
        word for word in WORDS if f"`{word}`" not in GLOSSARY and f"**{word}**" not in GLOSSARY
    ]
    assert unexplained == []
