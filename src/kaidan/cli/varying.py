"""Values of parameters on a command line: ``friction=0.6,0.8``, ``rise=15cm..20cm/6``."""

import math
from collections.abc import Sequence
from typing import Annotated, Any

import typer

Vary = Annotated[
    list[str] | None,
    typer.Option(
        "--vary",
        metavar="NAME=VALUES",
        help="What varies: friction=0.6,0.8,0.6..1.0; com_height=100mm..300mm/9 (nine values); "
        "flippers=flat;stowed;best; also acceleration, rise, steps, payload.height, "
        "track.front_radius and so on. May be given again.",
    ),
]
_MOST_VALUES = 1_000_000
_SEPARATED = ";"
"""Between values that may have commas in them."""
_WITH_COMMAS = ("flippers", "payload")


def varied(texts: Sequence[str] | None, *, option: str = "--vary") -> dict[str, list[Any]]:
    """Values by parameter.

    Examples
    --------
    >>> varied(["com_height=100mm..300mm/3", "friction=0.6,0.6..1.0"])
    {'com_height': [0.1, 0.2, 0.3], 'friction': [0.6, (0.6, 1.0)]}
    >>> varied(["flippers=flat;20deg,-5deg"])
    {'flippers': ['flat', '20deg,-5deg']}
    """
    from kaidan.errors import InputError, shown

    found: dict[str, list[Any]] = {}
    for text in texts or ():
        name, equals, values = text.partition("=")
        name = name.strip()
        if not equals or not values.strip():
            raise InputError(
                f"{option} {shown(text)}: write NAME=VALUES, for example rise=15cm,18cm"
            )
        if name in found:
            raise InputError(f"{option} {name} is given twice")
        found[name] = _values(name, values, f"{option} {name} =")
    return found


def _values(name: str, text: str, option: str) -> list[Any]:
    from kaidan.sweeps.parameters import parameter

    kind = parameter(name).kind
    separator = _SEPARATED if _SEPARATED in text or name in _WITH_COMMAS else ","
    words = [word.strip() for word in text.split(separator)]
    if kind is None:
        return words
    return [value for word in words for value in _numbers(word, kind, option)]


def _numbers(word: str, kind: str, option: str) -> list[Any]:
    """One value, one range, or evenly spaced values of LOW..HIGH/COUNT."""
    from kaidan.errors import InputError, shown
    from kaidan.units import parse, parse_range

    ends, slash, count = word.rpartition("/")
    if slash and ".." in ends:
        low, high = parse_range(ends, kind, option=option)
        if not count.strip().isdigit() or not 2 <= int(count) <= _MOST_VALUES:
            raise InputError(
                f"{option} {shown(word)}: write LOW..HIGH/COUNT with a count of 2 to "
                f"{_MOST_VALUES:,}"
            )
        last = int(count) - 1
        spaced = [low + (high - low) * k / last for k in range(last + 1)]
        return [round(each, 12) if math.isfinite(each) else each for each in spaced]
    if ".." in word:
        low, high = parse_range(word, kind, option=option)
        return [low if low == high else (low, high)]
    return [parse(word, kind, option=option)]
