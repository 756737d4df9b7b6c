"""Every name of a field and every word of an answer is explained in the documentation."""

import re
import sys
from pathlib import Path

import pytest

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


@pytest.mark.parametrize("model", [*PARTS, *SHEETS], ids=lambda model: model.__name__)
def test_every_field_says_what_it_means(model):
    """Itself, or in the glossary if it is the same everywhere."""
    silent = [
        name
        for name, meaning in meanings(model).items()
        if not meaning and f"`{name}`" not in GLOSSARY
    ]
    assert silent == []


@pytest.mark.parametrize("model", [*PARTS, *SHEETS], ids=lambda model: model.__name__)
def test_no_field_is_called_by_a_retired_word(model):
    assert {name: retired(name) for name in model.model_fields if retired(name)} == {}


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda sheet: sheet.__name__)
def test_every_sheet_has_a_table_in_the_docs(sheet):
    """Those of answers are written from the schemas by ``{answers}``."""
    assert re.search(rf"{{sheet}} kaidan[\w.]*\.{sheet.__name__}\n", PAGES), sheet


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda sheet: sheet.__name__)
def test_symbols_of_fields_are_in_the_glossary(sheet):
    for name, field in sheet.model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        if "symbol" in extra:
            assert f"`{extra['symbol']}`" in GLOSSARY, name


@pytest.mark.parametrize(
    "word",
    [
        *modes.FAILURE_MODES,
        *modes.Undecided,
        *modes.Phase,
        *modes.Acceptance,
        *modes.MODELS,
        *(verdict.label for verdict in modes.Verdict),
    ],
)
def test_words_of_answers_are_in_the_glossary(word):
    assert f"`{word}`" in GLOSSARY or f"**{word}**" in GLOSSARY
