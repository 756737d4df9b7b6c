"""Sheets to fill in: TOML with a comment for every field, written from the field itself."""

import json
import math
from collections.abc import Iterator
from textwrap import wrap
from typing import Any, get_origin

from pydantic.fields import FieldInfo

from kaidan.sheet import (
    PLACEHOLDER,
    Sheet,
    bounds,
    is_list,
    table_of,
    table_of_each,
    table_of_list,
    toml_value,
    words_of,
)

_HEAD = """\
{title}

Lengths in m, masses in kg, angles in rad, as the comment of each value says; or a text with its
unit, such as "290mm" or "35deg". Replace every "{placeholder}". A line that begins with "#" and no
space is a setting left out: take the "#" away to use it. What is left out keeps its default, or
counts as not known."""
_LETTERS = "# V: read in the named source, C: computed from a model, D: derived, U: unconfirmed"


def blank_toml(sheet: type[Sheet], *, name: str, title: str) -> str:
    """TOML text of a sheet to fill in.

    Text that `sheet.from_text` refuses, naming the field, until every required value is in.
    """
    head = _HEAD.format(title=title, placeholder=PLACEHOLDER)
    lines = [f"# {line}".rstrip() for line in head.splitlines()]
    lines += _fields(sheet, {"name": name})
    lines += _tables(sheet)
    return "\n".join(lines) + "\n"


def _fields(sheet: type[Sheet], given: dict[str, str], mark: str = "") -> Iterator[str]:
    """Lines of the fields that are no tables; `mark` leaves all of them out."""
    for name, field in sheet.model_fields.items():
        tables = table_of(field) or table_of_list(field)
        if tables is not None or get_origin(field.annotation) is dict:
            continue
        yield ""
        yield from _comment(field)
        if name in given:
            yield f"{mark}{name} = {toml_value(given[name])}"
        elif field.is_required() or name in sheet.requested:
            yield f"{mark}{name} = {_blank(field)}"
        else:
            default = field.get_default()
            value = _blank(field) if default is None else _default(field, default)
            yield f"#{name} = {value}"


def _default(field: FieldInfo, default: Any) -> str:
    """Default as people write it: angles in degrees."""
    degrees = bounds(field)[0] == "rad" and isinstance(default, float)
    return toml_value(f"{math.degrees(default):g}deg" if degrees else default)


def _tables(sheet: type[Sheet]) -> Iterator[str]:
    for name, field in sheet.model_fields.items():
        table = table_of(field)
        if table is not None:
            # a table without required fields may stand empty; another one is there whole or not
            left_out = not field.is_required() and any(
                inner.is_required() for inner in table.model_fields.values()
            )
            mark = "#" if left_out else ""
            yield from ("", "", *_comment(field), f"{mark}[{name}]")
            yield from _fields(table, {}, mark)
            for inner_name, inner in table.model_fields.items():
                if (of_list := table_of_list(inner)) is not None:
                    yield from ("", *_comment(inner), f"#[[{name}.{inner_name}]]")
                    yield from _fields(of_list, {}, "#")
        elif (of_list := table_of_list(field)) is not None:
            yield from ("", "", *_comment(field), f"#[[{name}]]")
            yield from _fields(of_list, {}, "#")
        elif (each := table_of_each(field)) is not None:
            yield from ("", "", *_comment(field), f"#[{name}.example]")
            yield from _fields(each, {}, "#")
        elif field.annotation == dict[str, str]:
            yield from ("", "", *_comment(field))
            yield from (_LETTERS, f"#[{name}]")
            for path in required_fields(sheet):
                yield f'#{toml_value(path)} = "V: measured, by whom, how and when"'


def required_fields(sheet: type[Sheet], path: str = "") -> Iterator[str]:
    """Dotted names of the fields that a blank sheet asks for."""
    for name, field in sheet.model_fields.items():
        table = table_of(field)
        if table is not None and field.is_required():
            yield from required_fields(table, f"{path}{name}.")
        elif table is None and (field.is_required() or name in sheet.requested) and name != "name":
            yield f"{path}{name}"


def _comment(field: FieldInfo) -> list[str]:
    unit, low, high = bounds(field)
    text = field.description or ""
    extra = field.json_schema_extra
    if isinstance(extra, dict) and "symbol" in extra:
        text += f" ({extra['symbol']})"
    if unit is not None:
        text += f"; {'' if unit == '1' else f'{unit}, '}{low:g} to {high:g}"
    elif field.annotation is bool:
        text += "; true or false"
    elif words := words_of(field.annotation):
        text += f"; {' or '.join(json.dumps(word) for word in words)}"
    return [f"# {line}" for line in wrap(text, 96, break_on_hyphens=False)]


def _blank(field: FieldInfo) -> str:
    blank = toml_value(PLACEHOLDER)
    return f"[{blank}]" if is_list(field) else blank
