"""Japanese for sentences of this folder: each is found by what it says, so none is made twice.

What decides which sentence is said stays where it is; `japanese.toml` has them as patterns.
"""

import re
import tomllib
from collections.abc import Mapping, Sequence
from functools import cache, partial
from importlib.resources import files
from typing import NamedTuple

from kaidan.modes import FAILURE_MODES
from kaidan.text import document as of
from kaidan.text.page import page_texts

_FIELD = re.compile(r"\{([a-z]+)\d*\}")
_FILLED = re.compile(r"\{(\d)\}")
_WORDS = {"n": r"[-+\u2212]?(?:\d+(?:\.\d+)?(?:e[-+]?\d+)?|inf)", "x": r".+?"}
"""Expressions of the fields that are no tables."""


class Pattern(NamedTuple):
    """One sentence, or a part of one."""

    english: str
    """Regular expression, of Python and of JavaScript alike; a group for each field."""
    japanese: str
    """Text with {1}, {2} and so on for the groups."""
    tables: tuple[str, ...]
    """Table of each group; empty for one that stands as it is."""


@cache
def patterns() -> dict[str, tuple[Pattern, ...]]:
    """Patterns by their table; whole sentences are "sentence"."""
    text = files("kaidan.text").joinpath("japanese.toml").read_text(encoding="utf-8")
    tables: dict[str, list[list[str]]] = tomllib.loads(text)
    page = page_texts()
    tables["phase"] = [[name, each["ja"]] for name, each in page["phase"].items()]
    tables["mode"] = [
        [FAILURE_MODES[name].label if name in FAILURE_MODES else each["en"], each["ja"]]
        for name, each in page["mode"].items()
    ]
    return {
        name: tuple(_pattern(english, japanese, tables) for english, japanese in pairs)
        for name, pairs in tables.items()
    }


def _pattern(english: str, japanese: str, tables: Mapping[str, Sequence[Sequence[str]]]) -> Pattern:
    fields = [field[0] for field in _FIELD.finditer(english)]
    kinds = [field[1] for field in _FIELD.finditer(english)]
    numbers = {field: f"{{{k}}}" for k, field in enumerate(fields, start=1)}
    return Pattern(
        f"^{_expression(english, tables, '(')}$",
        _FIELD.sub(lambda field: numbers[field[0]], japanese),
        tuple("" if kind in _WORDS else kind for kind in kinds),
    )


def _expression(english: str, tables: Mapping[str, Sequence[Sequence[str]]], group: str) -> str:
    """Regular expression of an English text; fields in groups of a kind."""
    made, at = "", 0
    for field in _FIELD.finditer(english):
        made += _literal(english[at : field.start()])
        inner = _WORDS.get(field[1]) or "|".join(
            _expression(entry, tables, "(?:") for entry, _ in tables[field[1]]
        )
        made += f"{group}{inner})"
        at = field.end()
    return made + _literal(english[at:])


def _literal(text: str) -> str:
    return re.sub(r"[\\^$.|?*+()\[\]{}/]", lambda found: f"\\{found[0]}", text)


def japanese(text: str, table: str = "sentence") -> str | None:
    """A sentence in Japanese; None where it is only known in English.

    text: what a function of `kaidan.text` said.

    Examples
    --------
    >>> japanese("It gets stuck, wedged against a face or rocking on the spot (enter, step 2).")
    '壁面につかえるか、その場で揺れて進めなくなります(進入、2 段目)。'
    """
    for pattern in patterns()[table]:
        found = re.match(pattern.english, text)
        if found is not None:
            parts = [
                japanese(part, of) or part if of else part
                for part, of in zip(found.groups(), pattern.tables, strict=True)
            ]
            return _FILLED.sub(partial(_part, parts), pattern.japanese)
    return None


def _part(parts: Sequence[str], field: re.Match[str]) -> str:
    return parts[int(field[1]) - 1]


def in_japanese(whole: of.Document) -> of.Document:
    """Document in Japanese.

    Lines of commands, names of figures, words of sheets and their sources stay as they are, and so
    does what has no Japanese.
    """
    parts = tuple(
        of.Sheet(tuple(map(_block, part.blocks))) if isinstance(part, of.Sheet) else _block(part)
        for part in whole.parts
    )
    return of.Document(_said(whole.title), parts, _said(whole.foot), language="ja")


def _block(block: of.Block) -> of.Block:
    match block:
        case of.Paragraph() | of.Heading() | of.Verdict():
            return block._replace(text=_said(block.text))
        case of.Picture():
            return block._replace(says=_said(block.says))
        case of.Points():
            return of.Points(tuple(map(_said, block.items)))
        case of.Facts():
            return of.Facts(tuple((_said(name), _said(value)) for name, value in block.rows))
        case of.Table():
            rows = tuple(tuple(map(_said, row)) for row in block.rows)
            return block._replace(heads=tuple(map(_said, block.heads)), rows=rows)
        case _:
            return block


def _said(text: str) -> str:
    found = japanese(text)
    return text if found is None else found
