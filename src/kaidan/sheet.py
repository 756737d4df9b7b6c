"""The data sheet: a frozen, validated model whose bounds, unit and meaning stand on the field.

From that one place come the validation, the texts of the errors, the JSON schema, the commented
TOML files and the tables of the documentation.
"""

import tomllib
from collections.abc import Mapping, Sequence
from decimal import Decimal
from functools import cache
from types import NoneType
from typing import Any, ClassVar, Generic, Literal, Self, TypeVar, get_args, get_origin

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    ModelWrapValidatorHandler,
    ValidationError,
)
from pydantic import model_validator as model_validator
from pydantic.fields import FieldInfo

from kaidan.errors import LONGEST, InputError, did_you_mean, fault, listed, shown
from kaidan.units import kind_of_unit, parse

PLACEHOLDER = "FILL IN"
"""What stands for a value that the user has yet to fill in; no sheet accepts it."""

_ROOM = LONGEST - 30
"""Characters for several faults of one sheet, beside how many more there are."""
_TEXTS = (str, dict)
"""Types of fields that hold texts."""
_MISTAKEN_UNITS = {
    "m": (("millimetres", 1e-3), ("inches", 0.0254), ("centimetres", 1e-2), ("feet", 0.3048)),
    "rad": (("degrees", 0.017453292519943295),),
    "kg": (("grams", 1e-3),),
}
_ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t"}


def quantity(
    unit: str, low: float, high: float, meaning: str, *, default: Any = ..., symbol: str = ""
) -> Any:
    """Field of a physical quantity with its plausible range.

    unit: SI unit, "1" for a pure number.
    low, high: plausible range, both ends allowed: wide enough for every real thing, narrow enough
        to refuse millimetres, feet and degrees.
    default: default; required without one.
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

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)
    label: ClassVar[str] = "sheet"
    """What an error calls the owner of a wrong field."""
    requested: ClassVar[frozenset[str]] = frozenset()
    """Optional fields that a blank sheet asks for all the same."""

    @model_validator(mode="wrap")
    @classmethod
    def _tell_what_is_wrong(cls, data: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        if isinstance(data, cls):  # it was looked at when it was made
            return data
        wrong: list[str] = []
        if isinstance(data, Mapping):
            data = cls._in_si(data, wrong)
        if not wrong:
            try:
                sheet = handler(data)
            except ValidationError as error:
                wrong = [cls._text(dict(detail)) for detail in error.errors(include_url=False)]
            else:
                wrong = [
                    f"{cls.label}: {name} holds half a character (a lone surrogate)"
                    for name, value in sheet.__dict__.items()
                    if isinstance(value, _TEXTS) and not _is_unicode(value)
                ]
                if not wrong:
                    return sheet
        raise InputError(_of_several(wrong)) from None

    @classmethod
    def _in_si(cls, data: Mapping[Any, Any], wrong: list[str]) -> dict[Any, Any]:
        """Fields with quantities written as texts ("290mm") as numbers; `wrong` gets the others."""
        read, units = dict(data), _units_of(cls)
        for name, value in data.items():
            if name not in units or value is None or type(value) is float:
                continue
            if not is_list(cls.model_fields[name]):
                read[name] = cls._number((name,), value, wrong)
            elif isinstance(value, list | tuple):
                read[name] = [cls._number((name, k), item, wrong) for k, item in enumerate(value)]
        return read

    @classmethod
    def _number(cls, path: tuple[int | str, ...], value: Any, wrong: list[str]) -> Any:
        """Number for a text with a unit; pydantic would turn true, "0.5" and b"0.5" into some."""
        if not isinstance(value, bool | str | bytes | bytearray | Decimal):
            return value
        kind = kind_of_unit(_units_of(cls)[str(path[0])])
        if kind is None or not isinstance(value, str) or value == PLACEHOLDER:
            wrong.append(cls._text({"loc": path, "type": "not_a_number", "input": value}))
            return value
        try:
            return parse(value, kind, option=f"{cls.label}: {_path(path)} =")
        except InputError as error:
            wrong.append(str(error))
            return value

    @classmethod
    def _text(cls, detail: Mapping[str, Any]) -> str:
        path, kind, value = detail["loc"], detail["type"], detail["input"]
        where = f"{cls.label}: {_path(path)}" if path else cls.label
        field = cls.model_fields.get(str(path[0])) if path else None
        unit, low, high = bounds(field)
        if kind == "missing":
            return f"{where} is missing" + (f" ({field.description})" if field else "")
        if kind == "extra_forbidden":
            known, hint = listed(cls.model_fields), cls._meant(str(path[-1]))
            known = f"{hint} Known: {known}" if hint else f"; known: {known}"
            return f"{where} is not a known field{known if len(path) == 1 else ''}"
        of_unit = f" {unit}" if unit and unit != "1" else ""
        within = f"{low:g} to {high:g}{of_unit}"
        if isinstance(value, str) and value == PLACEHOLDER and field is not None:
            allowed = f", {within}" if unit else ""
            return f"{where} is still to be filled in: {field.description}{allowed}"
        if kind == "model_type":
            return f"{where} = {_shown(value)} is not a table of fields"
        if kind in ("too_short", "too_long"):
            return f"{where} {fault(detail)}"
        if unit is None:
            return f"{where} = {_shown(value)} {fault(detail)}"
        if is_list(field) and len(path) == 1:
            return f"{where} = {_shown(value)} is not a list of numbers"
        if isinstance(value, bool) or not isinstance(value, int | float):
            return f"{where} = {_shown(value)} is not a number"
        if kind.startswith("int_"):
            return f"{where} = {_shown(value)} is not a whole number"
        text = f"{where} = {_shown(value)}{of_unit} is not within {within}"
        for name, factor in _MISTAKEN_UNITS.get(unit, ()):
            if high < value <= high / factor and low <= value * factor:
                return f"{text} (in {name}? that would be {value * factor:.6g} {unit})"
        return text

    @classmethod
    def _meant(cls, key: str) -> str:
        """Hint at the field that an unknown one may stand for, in this table or one below."""
        for name, field in cls.model_fields.items():
            table = table_of(field)
            if table is not None and key in table.model_fields:
                return f"; did you mean {name}.{key}?"
        return did_you_mean(key, cls.model_fields)

    def refuse(self, text: str) -> InputError:
        """Error for a contradiction between fields, to be raised by the validators of a sheet."""
        return InputError(f"{self.label}: {text}")

    @classmethod
    def from_text(cls, text: str, *, origin: str) -> Self:
        """Sheet read from TOML text; `origin` is what errors call it."""
        try:
            table = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            raise InputError(f"{origin}: not valid TOML: {error}") from None
        except RecursionError:
            raise InputError(f"{origin}: not a sheet: tables or lists nested too deeply") from None
        except ValueError:
            raise InputError(f"{origin}: not a sheet: a number with too many digits") from None
        try:
            return cls.model_validate(table)
        except InputError as error:
            raise InputError(f"{origin}: {error}") from None

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Sheet that `to_json` wrote, equal to the one that was written."""
        try:
            return cls.model_validate_json(text)
        except ValidationError as error:  # no JSON at all; a wrong field is an InputError already
            raise InputError(f"{cls.label} {fault(error.errors(include_url=False)[0])}") from None

    def to_json(self) -> str:
        """One JSON object, indented, in ASCII."""
        import json

        return json.dumps(self.model_dump(mode="json"), indent=2, allow_nan=False)

    def to_toml(self) -> str:
        """TOML text that `from_text` reads back to an equal sheet."""
        lines: list[str] = []
        _write_table(self.model_dump(exclude_defaults=True), (), lines)
        return "\n".join(lines).strip() + "\n"


AnySheet = TypeVar("AnySheet", bound=Sheet)


class Itself(Generic[AnySheet]):
    """A sheet as a key: the same if it is the same object, because it takes long to compare two."""

    __slots__ = ("sheet",)

    def __init__(self, sheet: AnySheet) -> None:
        self.sheet = sheet

    def __hash__(self) -> int:
        return id(self.sheet)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Itself) and other.sheet is self.sheet


@cache
def _units_of(sheet: type[Sheet]) -> dict[str, str]:
    """Units of the fields that are quantities or lists of them."""
    units = {name: bounds(field)[0] for name, field in sheet.model_fields.items()}
    return {name: unit for name, unit in units.items() if unit is not None}


def table_of(field: FieldInfo) -> type[Sheet] | None:
    """Type of sheet that a field holds, if it holds one."""
    kinds: tuple[Any, ...] = get_args(field.annotation) or (field.annotation,)
    kinds = tuple(kind for kind in kinds if kind is not NoneType)
    if len(kinds) == 1 and isinstance(kinds[0], type) and issubclass(kinds[0], Sheet):
        return kinds[0]
    return None


def table_of_list(field: FieldInfo) -> type[Sheet] | None:
    """Type of sheet of which a field holds a list, if it holds one."""
    kinds: tuple[Any, ...] = get_args(field.annotation)
    if len(kinds) == 2 and kinds[1] is Ellipsis and isinstance(kinds[0], type):
        return kinds[0] if issubclass(kinds[0], Sheet) else None
    return None


def table_of_each(field: FieldInfo) -> type[Sheet] | None:
    """Type of sheet that a field holds under names of the user's own, if it holds some."""
    kinds: tuple[Any, ...] = get_args(field.annotation)
    if len(kinds) == 2 and isinstance(kinds[1], type) and issubclass(kinds[1], Sheet):
        return kinds[1]
    return None


def words_of(annotation: Any) -> tuple[str, ...]:
    """Words that a field takes, if it takes nothing else, or nothing at all."""
    for kind in (annotation, *get_args(annotation)):
        if get_origin(kind) is Literal:
            return get_args(kind)
    return ()


def _is_unicode(value: str | dict[str, Any]) -> bool:
    """Whether a text, or all texts of a mapping, can be written as UTF-8."""
    texts = (value,) if isinstance(value, str) else (*value.keys(), *value.values())
    try:
        for text in texts:
            if isinstance(text, str):
                text.encode()
    except UnicodeEncodeError:
        return False
    return True


def bounds(field: FieldInfo | None) -> tuple[str | None, float, float]:
    """Unit and plausible range of a field or of each item of its list; unit None without one."""
    if field is None or not isinstance(field.json_schema_extra, dict):
        return None, 0.0, 0.0
    limits = [*field.metadata, *_item_limits(field.annotation)]
    low = next((m.ge for m in limits if hasattr(m, "ge")), float("-inf"))
    high = next((m.le for m in limits if hasattr(m, "le")), float("inf"))
    return str(field.json_schema_extra["unit"]), float(low), float(high)


def _item_limits(annotation: Any) -> list[Any]:
    """Limits inside an annotation such as ``tuple[Annotated[float, Field(ge=0)], ...] | None``."""
    found = list(getattr(annotation, "__metadata__", ()))
    for part in get_args(annotation):
        found += _item_limits(part)
    return [m for item in found for m in (item.metadata if isinstance(item, FieldInfo) else [item])]


def is_list(field: FieldInfo | None) -> bool:
    """Whether a field takes a list of numbers."""
    return field is not None and bool(_item_limits(field.annotation))


def _of_several(wrong: Sequence[str]) -> str:
    """Several faults in one line, as many as an error has room for."""
    if len(whole := "; ".join(wrong)) <= LONGEST:
        return whole
    kept = next(
        (k for k in range(1, len(wrong)) if len("; ".join(wrong[: k + 1])) > _ROOM), len(wrong)
    )
    more = f"; and {len(wrong) - kept} more" if len(wrong) > kept else ""
    return "; ".join(wrong[:kept]) + more


def _path(path: Sequence[int | str]) -> str:
    text = ""
    for part in path:
        key = part if isinstance(part, str) and part.isidentifier() else _shown(part)
        text += f"[{part}]" if isinstance(part, int) else f".{key}" if text else key
    return text


def _shown(value: Any) -> str:
    """Text of a value in one short line, whatever it is."""
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, bool | str):
        text = toml_value(value)
        return text if len(text) <= 60 else f"{text[:57]}...{text[-1:]}"
    if isinstance(value, int | float):
        try:
            return f"{value:.12g}"
        except OverflowError:
            return "a number of more than 300 digits"
    return shown(value)


def _write_table(table: Mapping[str, Any], path: tuple[str, ...], lines: list[str]) -> None:
    if path:
        lines += ["", f"[{'.'.join(_key(part) for part in path)}]"]
    nested = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    for key, value in table.items():
        if key not in nested and value is not None:
            lines.append(f"{_key(key)} = {toml_value(value)}")
    for key, value in nested.items():
        _write_table(value, (*path, key), lines)


def _key(key: str) -> str:
    bare = key.isascii() and key.replace("_", "").replace("-", "").isalnum()
    return key if bare else toml_value(key)


def toml_value(value: Any) -> str:
    """TOML text of a string, number, truth value, list, or of a table within a list."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, str):
        return f'"{"".join(_escaped(character) for character in value)}"'
    if isinstance(value, Mapping):
        pairs = (f"{_key(key)} = {toml_value(item)}" for key, item in value.items())
        return f"{{ {', '.join(pairs)} }}"
    return "[" + ", ".join(toml_value(item) for item in value) + "]"


def _escaped(character: str) -> str:
    if character in _ESCAPES:
        return _ESCAPES[character]
    if character.isprintable():
        return character
    code = ord(character)
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
