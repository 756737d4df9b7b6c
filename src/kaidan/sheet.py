"""The data sheet: a frozen, validated model whose bounds, unit and meaning stand on the field.

From that one place come the validation, the texts of the errors, the JSON schema, the commented
TOML files and the tables of the documentation.
"""

import tomllib
from collections.abc import Mapping
from typing import Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, Field, ModelWrapValidatorHandler, ValidationError
from pydantic import model_validator as model_validator
from pydantic.fields import FieldInfo

from kaidan.errors import InputError

_MISTAKEN_UNITS = {
    "m": (("millimetres", 1e-3), ("inches", 0.0254), ("centimetres", 1e-2), ("feet", 0.3048)),
    "rad": (("degrees", 0.017453292519943295),),
    "kg": (("grams", 1e-3),),
}


def quantity(
    unit: str, low: float, high: float, meaning: str, *, default: Any = ..., symbol: str = ""
) -> Any:
    """Field of a physical quantity with its plausible range.

    Parameters
    ----------
    unit : str
        SI unit, "1" for a pure number.
    low, high : float
        Plausible range, both ends allowed: wide enough for every real thing, narrow enough to
        catch millimetres, feet and degrees.
    meaning : str
        What the quantity is.
    default : object, optional
        Default; required without one.
    symbol : str, optional
        Symbol of the paper.

    Returns
    -------
    pydantic field
    """
    return Field(
        default,
        ge=low,
        le=high,
        description=meaning,
        json_schema_extra={"unit": unit, **({"symbol": symbol} if symbol else {})},
    )


class Sheet(BaseModel):
    """A frozen, validated data sheet; unphysical input raises `InputError`."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, use_attribute_docstrings=True
    )
    label: ClassVar[str] = "sheet"
    """What an error calls the owner of a wrong field."""

    @model_validator(mode="wrap")
    @classmethod
    def _tell_what_is_wrong(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return handler(data)
        except ValidationError as error:
            texts = [cls._text(dict(detail)) for detail in error.errors(include_url=False)]
            raise InputError("; ".join(texts)) from None

    @classmethod
    def _text(cls, detail: Mapping[str, Any]) -> str:
        path = [str(part) for part in detail["loc"]]
        where = f"{cls.label}: {'.'.join(path)}" if path else cls.label
        field = cls.model_fields.get(path[0]) if path else None
        kind, value = detail["type"], detail["input"]
        unit, low, high = _bounds(field)
        if kind == "missing":
            return f"{where} is missing" + (f" ({field.description})" if field else "")
        if kind == "extra_forbidden":
            return f"{where} is not a known field; known: {', '.join(cls.model_fields)}"
        if unit is None:
            return f"{where} = {value!r}: {detail['msg']}"
        number = isinstance(value, int | float) and not isinstance(value, bool)
        shown = f"{value:g}" if number else repr(value)
        text = f"{where} = {shown} {unit} is not within {low:g} to {high:g} {unit}"
        for name, factor in _MISTAKEN_UNITS.get(unit, ()) if number else ():
            if low <= value * factor <= high and value > high:
                return f"{text} (in {name}? that would be {value * factor:g} {unit})"
        return text

    def refuse(self, text: str) -> InputError:
        """Error for a contradiction between fields, to be raised by the validators of a sheet."""
        return InputError(f"{self.label}: {text}")

    @classmethod
    def from_text(cls, text: str, *, origin: str) -> Self:
        """Sheet read from TOML text; `origin` is what errors call it."""
        try:
            return cls.model_validate(tomllib.loads(text))
        except tomllib.TOMLDecodeError as error:
            raise InputError(f"{origin}: not valid TOML: {error}") from None
        except InputError as error:
            raise InputError(f"{origin}: {error}") from None

    def to_toml(self) -> str:
        """TOML text that `from_text` reads back to an equal sheet."""
        lines: list[str] = []
        _write_table(self.model_dump(exclude_defaults=True), (), lines)
        return "\n".join(lines).strip() + "\n"


def _bounds(field: FieldInfo | None) -> tuple[str | None, float, float]:
    if field is None or not isinstance(field.json_schema_extra, dict):
        return None, 0.0, 0.0
    low = next((m.ge for m in field.metadata if hasattr(m, "ge")), float("-inf"))
    high = next((m.le for m in field.metadata if hasattr(m, "le")), float("inf"))
    return str(field.json_schema_extra["unit"]), float(low), float(high)


def _write_table(table: Mapping[str, Any], path: tuple[str, ...], lines: list[str]) -> None:
    if path:
        lines += ["", f"[{'.'.join(_key(part) for part in path)}]"]
    nested = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    for key, value in table.items():
        if key not in nested and value is not None:
            lines.append(f"{_key(key)} = {_value(value)}")
    for key, value in nested.items():
        _write_table(value, (*path, key), lines)


def _key(key: str) -> str:
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else _value(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        return (
            '"'
            + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped)
            + '"'
        )
    return "[" + ", ".join(_value(item) for item in value) + "]"
