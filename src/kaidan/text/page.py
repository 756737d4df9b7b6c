"""Texts of the page in English and Japanese, from one file: page.toml beside this module."""

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def page_texts() -> dict[str, Any]:
    """Texts by topic and name, each with ``en`` and ``ja``.

    A text without ``en`` is one that the answer itself has in English; its sentences are in
    `kaidan.text.japanese`.

    Examples
    --------
    >>> page_texts()["verdict"]["go"]["en"]
    'GO'
    """
    text = files("kaidan.text").joinpath("page.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)
