"""Quantities as people write them: ``180mm``, ``50deg``, ``0.3m/s2``. Only the edges use this."""

import math
import re

from kaidan.errors import InputError

_UNITS: dict[str, dict[str, float]] = {
    "length": {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048},
    "angle": {"deg": math.pi / 180, "°": math.pi / 180, "rad": 1.0},
    "mass": {"g": 1e-3, "kg": 1.0, "lb": 0.45359237},
    "acceleration": {"m/s2": 1.0, "m/s^2": 1.0, "g0": 9.80665},
    "speed": {"mm/s": 1e-3, "cm/s": 1e-2, "m/s": 1.0, "km/h": 1 / 3.6, "ft/s": 0.3048},
    "time": {"s": 1.0, "ms": 1e-3},
    "stiffness": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3},
}
_EXAMPLE = {
    "length": "180mm",
    "angle": "50deg",
    "mass": "5kg",
    "acceleration": "0.3m/s2",
    "speed": "0.1m/s",
    "time": "0.5s",
    "stiffness": "30kN/m",
}
_QUANTITY = re.compile(
    r"\s*([+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\d\s]\S*)?\s*", re.ASCII
)


def parse(text: str, kind: str, *, option: str) -> float:
    """SI value of a number with its unit.

    Parameters
    ----------
    text : str
        For example "180mm", "7 in", "50deg".
    kind : {"length", "angle", "mass", "acceleration", "speed", "time", "stiffness"}
        What it measures.
    option : str
        What errors call it, for example "--rise".

    Returns
    -------
    float
        Value in m, rad, kg, m/s^2, m/s, s or N/m; always finite.

    Raises
    ------
    InputError
        No number, no unit (with the fix), or a unit of something else.
    """
    units = _UNITS[kind]
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise InputError(f"{option} {text!r} is no {kind}; write for example {_EXAMPLE[kind]}")
    number, unit = match.groups()
    if unit is None:
        choices = " or ".join(f"{number}{name}" for name in list(units)[:3])
        raise InputError(f"{option} {text!r} has no unit; write {choices}")
    if unit not in units:
        raise InputError(
            f"{option} {text!r}: {unit!r} is no unit of {kind}; known: {', '.join(units)}"
        )
    value = float(number) * units[unit]
    if not math.isfinite(value):
        raise InputError(f"{option} {text!r} is too large")
    return value
