"""Sheets to fill in: TOML with a comment for every field, written from the field itself."""

import json
from collections.abc import Iterator
from textwrap import wrap
from types import NoneType
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

from kaidan.sheet import PLACEHOLDER, Sheet, bounds, is_list, toml_value

_HEAD = """\
{title}

Lengths in m, masses in kg, angles in rad, as the comment of each value says. Replace every
"{placeholder}". A line that begins with "#" and no space is a setting left out: take the "#" away
to use it. What is left out keeps its default, or counts as not known."""
_LETTERS = "# V: read in the named source, C: computed from a model, D: derived, U: unconfirmed"


def blank_toml(sheet: type[Sheet], *, name: str, title: str) -> str:
    """TOML text of a sheet to fill in.

    Parameters
    ----------
    sheet : type of Sheet
        What to fill in.
    name : str
        Name it gets.
    title : str
        First line of the text.

    Returns
    -------
    str
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
        if _table(field) is not None or field.annotation == dict[str, str]:
            continue
        yield ""
        yield from _comment(field)
        if name in given:
            yield f"{mark}{name} = {toml_value(given[name])}"
        elif field.is_required() or name in sheet.asked_for:
            yield f"{mark}{name} = {_blank(field)}"
        else:
            default = field.get_default()
            value = _blank(field) if default is None else toml_value(default)
            yield f"#{name} = {value}"


def _tables(sheet: type[Sheet]) -> Iterator[str]:
    for name, field in sheet.model_fields.items():
        table = _table(field)
        if table is not None:
            # a table without required fields may stand empty; another one is there whole or not
            left_out = not field.is_required() and any(
                inner.is_required() for inner in table.model_fields.values()
            )
            mark = "#" if left_out else ""
            yield from ("", "", *_comment(field), f"{mark}[{name}]")
            yield from _fields(table, {}, mark)
        elif field.annotation == dict[str, str]:
            yield from ("", "", *_comment(field))
            yield from (_LETTERS, f"#[{name}]")
            for path in required_fields(sheet):
                yield f'#{toml_value(path)} = "V: measured, by whom, how and when"'


def required_fields(sheet: type[Sheet], path: str = "") -> Iterator[str]:
    """Dotted names of the fields that a blank sheet asks for."""
    for name, field in sheet.model_fields.items():
        table = _table(field)
        if table is not None and field.is_required():
            yield from required_fields(table, f"{path}{name}.")
        elif table is None and (field.is_required() or name in sheet.asked_for) and name != "name":
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
    elif get_origin(field.annotation) is Literal:
        text += f"; {' or '.join(json.dumps(word) for word in get_args(field.annotation))}"
    return [f"# {line}" for line in wrap(text, 96, break_on_hyphens=False)]


def _blank(field: FieldInfo) -> str:
    blank = toml_value(PLACEHOLDER)
    return f"[{blank}]" if is_list(field) else blank


def _table(field: FieldInfo) -> type[Sheet] | None:
    """Type of sheet that a field holds, if it holds one."""
    kinds: tuple[Any, ...] = get_args(field.annotation) or (field.annotation,)
    kinds = tuple(kind for kind in kinds if kind is not NoneType)
    if len(kinds) == 1 and isinstance(kinds[0], type) and issubclass(kinds[0], Sheet):
        return kinds[0]
    return None
