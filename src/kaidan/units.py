"""Quantities as people write them: ``180mm``, ``7 1/2in``, ``50deg``, ``0.6..1.0``."""

import math
import re
from numbers import Real
from typing import Any

from kaidan.errors import InputError, did_you_mean, shown

_UNITS: dict[str, dict[str, float]] = {
    "number": {},
    "length": {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048},
    "angle": {"deg": math.pi / 180, "°": math.pi / 180, "rad": 1.0},
    "mass": {"g": 1e-3, "kg": 1.0, "lb": 0.45359237},
    "acceleration": {"m/s2": 1.0, "m/s^2": 1.0, "g0": 9.80665},
    "speed": {"mm/s": 1e-3, "cm/s": 1e-2, "m/s": 1.0, "km/h": 1 / 3.6, "ft/s": 0.3048},
    "time": {"s": 1.0, "ms": 1e-3},
    "stiffness": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3},
    "angular speed": {"deg/s": math.pi / 180, "rad/s": 1.0, "rpm": math.pi / 30},
    "force": {"N": 1.0, "kN": 1e3},
    "torque": {"N m": 1.0, "Nm": 1.0},
    "power": {"W": 1.0, "kW": 1e3},
    "moment of inertia": {"kg m^2": 1.0, "kg m2": 1.0},
}
_ALIKE = {
    "length": {'"': "in", "″": "in", "”": "in", "'": "ft", "′": "ft", "’": "ft"},
    "angle": {"º": "deg"},
}
"""Signs that stand for a unit and are not listed as one."""
_EXAMPLE = {
    "length": "180mm",
    "angle": "50deg",
    "mass": "5kg",
    "acceleration": "0.3m/s2",
    "speed": "0.1m/s",
    "time": "0.5s",
    "stiffness": "30kN/m",
    "angular speed": "20deg/s",
    "force": "100N",
    "torque": "30Nm",
    "power": "200W",
    "moment of inertia": "0.5kg m^2",
}
_FRACTION = r"[1-9]\d*\s*/\s*[1-9]\d*"
_DECIMAL = r"(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
_NUMBER = rf"[+-]?(?:\d+(?:\s+|-){_FRACTION}|{_FRACTION}|{_DECIMAL})(?![\d/])"
_UNIT = r"(?:[^\W\d_][\w/^]*(?: m(?:\^?2)?)?|[^\w\s.,;:+*/^-])"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*({_UNIT})?\s*", re.ASCII)
# compiled when they are first needed: few commands state a range
_RANGE = rf"\s*({_NUMBER})\s*({_UNIT})?(?:\s*(?:\.\.|[-–—])\s*|\s+to\s+)({_NUMBER})\s*({_UNIT})?\s*"
_DECIMAL_COMMA = r"\s*[+-]?\d+,\d+\s*(?:[^\W\d].*)?"
_LONGEST = 100
"""Longest text of a quantity; more is refused unread."""


def parse(text: str, kind: str, *, option: str) -> float:
    """SI value of a number with its unit.

    text: for example "180mm", "7 1/2in", '11"', "50deg".
    kind, {"number", "length", "angle", "mass", "acceleration", "speed", "time", "stiffness", ...}:
        what it measures; a "number" has no unit.
    option: what errors call it, for example "--rise".

    Value in m, rad, kg, m/s^2, m/s, s, N/m and so on; always finite.

    Examples
    --------
    >>> parse("7 1/2in", "length", option="--rise")
    0.1905
    """
    match = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST else None
    if match is None:
        raise InputError(f"{option} {shown(text)} {_no_quantity(text, kind)}")
    number, unit = match.groups()
    return _value(text, number, unit, kind, option)


def parse_range(text: str, kind: str, *, option: str) -> tuple[float, float]:
    """Both ends of a range in SI; one quantity is both.

    text: "0.6..1.0", "0.6-1.0" or "0.6 to 1.0"; with units "1deg..2.6deg" or "1..2.6deg".
    kind, option: as `parse` has them.

    Examples
    --------
    >>> parse_range("0.6 to 1.0", "number", option="--friction")
    (0.6, 1.0)
    >>> parse_range("7-1/2in", "length", option="--rise")
    (0.1905, 0.1905)
    """
    single = len(text) > _LONGEST or _QUANTITY.fullmatch(text)
    match = None if single else re.fullmatch(_RANGE, text, re.ASCII)
    if match is None:
        low, dots, high = text.partition("..")
        if dots and not (low.strip() and high.strip()):
            raise InputError(f"{option} {shown(text)}: a range has two ends, LOW..HIGH")
        value = parse(low, kind, option=option)
        return value, parse(high, kind, option=option) if dots else value
    first, unit_of_first, last, unit = match.groups()
    low_end = _value(text, first, unit_of_first or unit, kind, option)
    high_end = _value(text, last, unit, kind, option)
    if low_end > high_end:
        raise InputError(f"{option} {shown(text)}: the low end of a range comes first")
    return low_end, high_end


def value_of(value: Any, kind: str, *, option: str) -> float:
    """SI value of a number, or of a text with a unit.

    value: in SI where it is no text.
    kind, option: as `parse` has them.

    Examples
    --------
    >>> value_of("290mm", "length", option="rise"), value_of(0.29, "length", option="rise")
    (0.29, 0.29)
    """
    if isinstance(value, str):
        return parse(value, kind, option=option)
    return _finite(value, option)


def range_of(value: Any, kind: str, *, option: str) -> tuple[float, float]:
    """Both ends of a range that is a number, a pair of numbers (low, high) or a text.

    value: in SI where it is no text.
    kind, option: as `parse` has them.

    Examples
    --------
    >>> range_of(0.8, "number", option="friction")
    (0.8, 0.8)
    >>> range_of("1..2.6deg", "angle", option="theta_d") == (math.radians(1), math.radians(2.6))
    True
    """
    if isinstance(value, str):
        return parse_range(value, kind, option=option)
    ends = tuple(value) if isinstance(value, tuple | list) else (value, value)
    if len(ends) != 2:
        raise InputError(f"{option} = {shown(value)} is not a number or a pair (low, high)")
    low, high = (_finite(end, option) for end in ends)
    if low > high:
        raise InputError(f"{option} = {shown(value)}: the low end of a range comes first")
    return low, high


def _finite(value: Any, option: str) -> float:
    """Number of Python or numpy as a float; truth values are none."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"{option} = {shown(value)} is not a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise InputError(f"{option} = {number} is not a finite number")
    return number


def kind_of_unit(unit: str) -> str | None:
    """Kind of quantity that an SI unit measures; None for one that no text can have."""
    known = (kind for kind, units in _UNITS.items() if units.get(unit) == 1.0)
    return next(known, None)


def _value(text: str, number: str, unit: str | None, kind: str, option: str) -> float:
    units = _UNITS[kind]
    said = f"{option} {shown(text)}"
    if kind == "number":
        if unit is not None:
            raise InputError(f"{said} {_no_quantity(text, kind)}")
        factor = 1.0
    elif unit is None:
        choices = " or ".join(f"{number}{name}" for name in list(units)[:3])
        raise InputError(f"{said} has no unit; write {choices}")
    else:
        known = _ALIKE.get(kind, {}).get(unit, unit)
        if known not in units:
            of_another_kind = any(unit in each for each in _UNITS.values())
            hint = "" if of_another_kind else did_you_mean(unit, units)
            raise InputError(
                f"{said}: {shown(unit)} is no unit of {kind}; known: {', '.join(units)}{hint}"
            )
        factor = units[known]
    value = _number(number) * factor
    if not math.isfinite(value):
        raise InputError(f"{said} is too large")
    return value


def _number(text: str) -> float:
    """Value of a decimal number, of a fraction, or of a whole number with a fraction."""
    if "/" not in text:
        return float(text)
    sign = -1.0 if text.startswith("-") else 1.0
    parts = re.split(r"[\s/-]+", text.lstrip("+-"))
    whole, over, under = map(float, parts if len(parts) == 3 else ("0", *parts))
    return sign * (whole + over / under)


def _no_quantity(text: str, kind: str) -> str:
    """What is wrong with a text that is no quantity, and what to write."""
    if len(text) <= _LONGEST and re.fullmatch(_DECIMAL_COMMA, text, re.ASCII):
        return f"has a decimal comma; write {text.strip().replace(',', '.')}"
    if kind == "number":
        return "is not a plain number such as 0.8"
    return f"is no {kind}; write for example {_EXAMPLE[kind]}"
