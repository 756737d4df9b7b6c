"""The answer of a verb: frozen, the same after JSON and back, a text for people, a table.

Numbers that do not exist are None: NaN and infinity become None when an answer is made, so that
what it holds, what its JSON says and what is read back are equal.
"""

import math
import re
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from itertools import pairwise
from typing import Any, ClassVar, Self, cast

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from kaidan.errors import InputError, fault

MOST_ITEMS = 8
"""Items of a list that a table shows."""
_UNIT = re.compile(r"\[([^\]]+)\]")
_PLAIN = {str, int, bool, type(None)}
_HOLDERS = (tuple, dict)
_SUFFIXES = {"deg": "deg", "m": "m", "mm": "mm", "kg": "kg", "N": "N", "W": "W", "s": "s"}


class Part(BaseModel):
    """A part of an answer: frozen fields, each with its meaning and unit in its docstring."""

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)
    shown_as: ClassVar[str] = ""
    """Field of an assessment that it is, where a model found it."""

    @model_validator(mode="before")
    @classmethod
    def _plain_values(cls, data: Any) -> Any:
        return plain(data)

    @classmethod
    def made(cls, **fields: Any) -> Self:
        """Part of all its fields, each of its type already: none is validated.

        Numbers are made plain; tuples, tables and parts are taken as they are.
        """
        assert fields.keys() == cls.model_fields.keys()
        values: dict[str, Any] = {
            name: value if isinstance(value, _HOLDERS) else plain(value)
            for name, value in fields.items()
        }
        return cast(Self, cls.model_construct(None, **values))

    @classmethod
    def __get_pydantic_json_schema__(cls, core: Any, handler: Any) -> Any:
        """Schema in which every field has its meaning."""
        schema = handler(core)
        properties = handler.resolve_ref_schema(schema)["properties"]
        for name, meaning in meanings(cls).items():
            properties[name] |= {"description": meaning} if meaning else {}
        return schema


@cache
def meanings(model: type[BaseModel]) -> dict[str, str]:
    """Meaning of each field of a part or a sheet.

    The docstrings of a part are read when somebody asks for them: pydantic would read them when the
    class is made, which takes a tenth of the time in which a command starts.
    """
    found = {name: field.description or "" for name, field in model.model_fields.items()}
    for part in reversed(model.__mro__):
        if issubclass(part, Part):
            found |= _docstrings(part)
    return found


def _docstrings(part: type[Part]) -> dict[str, str]:
    """Docstrings below the fields of a part, without those that it inherits."""
    import ast
    from inspect import cleandoc, getsource
    from textwrap import dedent

    try:
        (made,) = ast.parse(dedent(getsource(part))).body
    except (OSError, TypeError):  # made where no file is
        return {}
    assert isinstance(made, ast.ClassDef)
    found = {}
    for one, below in pairwise(made.body):
        named = isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)
        text = getattr(getattr(below, "value", None), "value", None)
        if named and isinstance(below, ast.Expr) and isinstance(text, str):
            found[one.target.id] = cleandoc(text)  # type: ignore[attr-defined]
    return {name: text for name, text in found.items() if name in part.model_fields}


class Answer(Part):
    """What a verb answers.

    `str` of it is the text of the command, a notebook shows it as a table.
    """

    text_module: ClassVar[str]
    """Module whose function ``text`` says it in words, imported when somebody reads them."""

    def to_dict(self) -> dict[str, Any]:
        """Everything as dictionaries, lists, texts and numbers."""
        return self.model_dump(mode="json")

    def to_json(self) -> str:
        """One JSON object, indented, in ASCII."""
        import json

        return json.dumps(self.to_dict(), indent=2, allow_nan=False)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Answer that `to_json` wrote, equal to the one that was written.

        Raises
        ------
        InputError
            A text that is no such answer.
        """
        try:
            return cls.model_validate_json(text)
        except ValidationError as error:
            first = error.errors(include_url=False)[0]
            where = ".".join(map(str, first["loc"])) or "it"
            raise InputError(f"no {cls.__name__}: {where} {fault(first)}") from None

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """JSON schema of that object; exact: it names every property and forbids others."""
        return cls.model_json_schema(mode="serialization")

    def __str__(self) -> str:
        return str(self.said("text"))

    def said(self, what: str, *more: Any) -> Any:
        """What a function of the module of its text says of it."""
        return getattr(import_module(self.text_module), what)(self, *more)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {str(self).splitlines()[0]}>"

    def _repr_html_(self) -> str:
        from html import escape

        rows = "".join(
            f"<tr><td>{escape(name)}</td><td>{escape(value)}</td><td>{escape(unit)}</td></tr>"
            for name, value, unit in _rows(self, "")
        )
        return f"<table><tr><th>field</th><th>value</th><th>unit</th></tr>{rows}</table>"


def plain(value: Any) -> Any:
    """Value with arrays as lists and None for what is no finite number."""
    kind = type(value)
    if kind is float:
        return value if math.isfinite(value) else None
    if kind in _PLAIN or issubclass(kind, BaseModel):
        return value
    if kind is dict or isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def _rows(model: BaseModel, before: str) -> Iterator[tuple[str, str, str]]:
    """Name, value and unit of every field, those of parts behind the name of the part."""
    for name, meaning in meanings(type(model)).items():
        value, path = getattr(model, name), before + name
        if isinstance(value, dict):
            named = [(f"{path}.{key}", item) for key, item in value.items()]
        elif isinstance(value, tuple) and any(isinstance(item, BaseModel) for item in value):
            named = [(f"{path}[{index}]", item) for index, item in enumerate(value[:MOST_ITEMS])]
            if len(value) > MOST_ITEMS:
                named.append((f"{path}[...]", f"{len(value)} in all"))
        else:
            named = [(path, value)]
        for place, item in named:
            named_sheet = not isinstance(item, Part) and hasattr(item, "name")
            if isinstance(item, BaseModel) and not named_sheet:
                yield from _rows(item, f"{place}.")
            else:
                yield place, _shown(item), _unit(name, meaning)


def _unit(name: str, meaning: str) -> str:
    """Unit of a field: what stands in brackets in its meaning, else the end of its name."""
    stated = _UNIT.search(meaning)
    return stated.group(1) if stated else _SUFFIXES.get(name.rpartition("_")[2], "")


def _shown(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.5g}"
    if isinstance(value, tuple):
        head = ", ".join(_item(item) for item in value[:MOST_ITEMS])
        return head if len(value) <= MOST_ITEMS else f"{head}, … ({len(value)} in all)"
    if isinstance(value, BaseModel):
        return str(getattr(value, "name", value))
    return str(value)


def _item(value: Any) -> str:
    """Item of a list; of a list in a list its length, unless it is a point."""
    if not isinstance(value, tuple):
        return _shown(value)
    point = len(value) == 2 and not any(isinstance(each, BaseModel) for each in value)
    return f"({_shown(value)})" if point else f"({len(value)})"
