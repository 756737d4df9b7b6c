"""What attributes and property sets say of a flight, beside what its solids are.

Programs write them in the model's unit, in feet whatever that is, or of another flight. So a number
counts as confirmed if any plausible unit makes it the measured one, and else both are shown.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from kaidan.readers.kinds import METRES

SAME = 0.0015
"""Difference up to which two lengths are the same [m]: what a number rounded to 1 mm may be off."""
_LENGTHS = {"RiserHeight": "rise", "TreadLength": "going"}
_COUNTS = {
    "NumberOfRiser": "risers",
    "NumberOfRisers": "risers",
    "NumberOfTreads": "treads",
}


@dataclass(frozen=True)
class Stated:
    """A figure that the model states, and the one that its solids have."""

    name: str
    """Attribute, or property set and property."""
    quantity: str
    """What it means: rise, going, risers, treads, height; finish: a height that is another one
    because of an end riser."""
    value: float
    """As the model has it."""
    measured: float
    """Of the solids, [m] or a count."""
    unit: str
    """Unit in which it is the measured one; "model" for the model's own; empty: in none."""
    in_model_unit: float
    """Its value in the model's unit [m], or the count."""

    @property
    def agrees(self) -> bool:
        """Whether some plausible unit makes it the measured one."""
        return bool(self.unit)


def cross_checked(
    stated: Mapping[str, float],
    measured: Mapping[str, Sequence[float]],
    unit: float,
    ends: float = 0.0,
) -> Iterator[Stated]:
    """Stated figures beside the measured ones.

    Parameters
    ----------
    stated : mapping of str to float
        Numbers of attributes and property sets, by their place.
    measured : mapping of str to sequence of float
        "rise", "going" of each flight [m], all of which a stated one must be; "risers", "treads",
        counts of which it must be one; "height" [m]. What is missing is not compared.
    unit : float
        Length of the model's unit [m].
    ends : float
        By how much end risers that are another than stated make the height another one [m].

    Yields
    ------
    Stated

    Examples
    --------
    Feet in a model of millimetres:

    >>> check, = cross_checked({"RiserHeight": 0.574147}, {"rise": [0.175]}, 0.001)
    >>> check.unit, check.agrees
    ('ft', True)
    """
    for name, value in stated.items():
        last = name.rpartition(".")[2]
        quantity = _LENGTHS.get(last) or _COUNTS.get(last) or ""
        real = measured.get(quantity, ())
        if not real or value <= 0:
            continue
        if quantity in _COUNTS.values():
            same = round(value) in real
            yield Stated(name, quantity, value, real[0], "model" if same else "", value)
            continue
        other = max(real, key=lambda one: abs(one - value * unit))
        fits = _units(value, real, unit)
        yield Stated(name, quantity, value, other, (fits or [""])[0], value * unit)
    rise, count = stated_rise(stated, measured.get("rise", ()), unit), _count(stated)
    for height in measured.get("height", ()):
        off = height - count * rise
        if abs(off) > count * SAME:
            quantity = "finish" if ends and abs(off - ends) <= count * SAME else "height"
            name = f"{count:.0f} risers of {1e3 * rise:.0f} mm"
            yield Stated(name, quantity, count * rise, height, "", count * rise)


def stated_rise(stated: Mapping[str, float], real: Sequence[float], unit: float) -> float:
    """Rise that the model states and that all flights have [m]; NaN: none is stated, or another.

    Parameters
    ----------
    stated : mapping of str to float
        Numbers of attributes and property sets, by their place.
    real : sequence of float
        Rise of each flight between its end risers [m].
    unit : float
        Length of the model's unit [m].
    """
    for name, value in stated.items():
        if _LENGTHS.get(name.rpartition(".")[2]) == "rise" and real:
            for label in _units(value, real, unit):
                return value * _scales(unit)[label]
    return math.nan


def _count(stated: Mapping[str, float]) -> float:
    """Number of risers that is stated; NaN: none."""
    counts = (v for name, v in stated.items() if _COUNTS.get(name.rpartition(".")[2]) == "risers")
    return next((float(each) for each in counts if each > 0), math.nan)


def _scales(unit: float) -> dict[str, float]:
    return {"model": unit, **METRES}


def _units(value: float, real: Sequence[float], unit: float) -> list[str]:
    """Units in which a value is every measured one, the model's own first."""
    return [
        label
        for label, scale in _scales(unit).items()
        if all(abs(value * scale - each) <= SAME for each in real)
    ]
