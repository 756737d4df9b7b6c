"""A sheet's TOML text with some figures put in; what else it says, comments too, stays."""

import re
import tomllib
from collections.abc import Mapping
from typing import Any

from kaidan.errors import InputError
from kaidan.sheet import toml_value

_HEAD = re.compile(r"^(#?)\[([^\[\]]+)\]\s*(?:#.*)?$")


def completed(text: str, figures: Mapping[str, Any], *, origin: str) -> str:
    """Text of a sheet with figures in place of what stood there.

    text: TOML, as a user wrote it or as `kaidan.catalog.template.blank_toml` did: a setting that is
        left out by a "#" is taken into use.
    figures: values by dotted name: "mass", "track.flat_length", "sources.track.flat_length".
    """
    _refuse_no_toml(text, origin)
    lines = text.splitlines()
    for name, value in figures.items():
        _put(lines, *_place(name), value)
    whole = "\n".join(lines) + "\n"
    if not _holds(whole, figures):
        by_hand = ", ".join(f"{name} = {toml_value(value)}" for name, value in figures.items())
        raise InputError(f"{origin}: cannot be completed line by line; put in by hand: {by_hand}")
    return whole


def _refuse_no_toml(text: str, origin: str) -> None:
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{origin}: not valid TOML: {error}") from None
    except RecursionError:
        raise InputError(f"{origin}: not a sheet: tables or lists nested too deeply") from None


def _holds(text: str, figures: Mapping[str, Any]) -> bool:
    """Whether a text is TOML and has the figures."""
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return False
    for name, value in figures.items():
        section, key = _place(name)
        held = table.get(section, {}) if section else table
        if not isinstance(held, dict) or held.get(key) != value:
            return False
    return True


def _place(name: str) -> tuple[str, str]:
    """Table and key of a dotted name; the names of sources have dots of their own."""
    section, dot, key = name.partition(".")
    return (section, key) if dot else ("", section)


def _put(lines: list[str], section: str, key: str, value: Any) -> None:
    """Set one key of a table, on its own line, left out or not, or on a new one at its end."""
    first, last = _span(lines, section)
    shown = key if key.isidentifier() else toml_value(key)
    line = f"{shown} = {toml_value(value)}"
    known = re.compile(rf"^#?(?:{re.escape(key)}|{re.escape(toml_value(key))})\s*=")
    for at in range(first, last):
        if known.match(lines[at]):
            lines[at] = line
            return
    while last > first and (not lines[last - 1].strip() or lines[last - 1].startswith("# ")):
        last -= 1
    lines.insert(last, line)


def _span(lines: list[str], section: str) -> tuple[int, int]:
    """First line of a table, its head made active or added, and the line after its last."""
    heads = [(at, found) for at, line in enumerate(lines) if (found := _HEAD.match(line))]
    ends = [at for at, _ in heads] + [len(lines)]
    if not section:
        return 0, ends[0]
    for index, (at, found) in enumerate(heads):
        if found.group(2).strip() == section:
            lines[at] = f"[{section}]"
            return at + 1, ends[index + 1]
    lines += ["", f"[{section}]"]
    return len(lines), len(lines)
