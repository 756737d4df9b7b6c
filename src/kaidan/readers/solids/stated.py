"""What attributes and property sets say of a flight, beside what its solids are.

Programs write them in the model's unit, in feet whatever that is, or of another flight. So a number
counts as confirmed if any plausible unit makes it the measured one, and else both are shown.
"""

from collections.abc import Mapping
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
    """What it means: rise, going, risers, treads."""
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
    stated: Mapping[str, float], measured: Mapping[str, float], unit: float
) -> tuple[Stated, ...]:
    """Stated figures beside the measured ones.

    Parameters
    ----------
    stated : mapping of str to float
        Numbers of attributes and property sets, by their place.
    measured : mapping of str to float
        "rise", "going" [m], "risers", "treads"; NaN where there is none.
    unit : float
        Length of the model's unit [m].

    Returns
    -------
    tuple of Stated

    Examples
    --------
    Feet in a model of millimetres:

    >>> check, = cross_checked({"RiserHeight": 0.574147}, {"rise": 0.175}, 0.001)
    >>> check.unit, check.agrees
    ('ft', True)
    """
    found = []
    for name, value in stated.items():
        last = name.rpartition(".")[2]
        quantity = _LENGTHS.get(last) or _COUNTS.get(last)
        real = measured.get(quantity or "", float("nan"))
        if quantity is None or real != real or value <= 0:
            continue
        if quantity in _COUNTS.values():
            same = round(value) == round(real)
            found.append(Stated(name, quantity, value, real, "model" if same else "", value))
            continue
        scales: dict[str, float] = {"model": unit} | dict(METRES.items())
        fits = [label for label, scale in scales.items() if abs(value * scale - real) <= SAME]
        found.append(Stated(name, quantity, value, real, (fits or [""])[0], value * unit))
    return tuple(found)
