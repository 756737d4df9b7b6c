"""Arguments of the public functions: names that are known, whole numbers, lists and tables."""

from collections.abc import Callable, Collection, Mapping
from functools import wraps
from operator import index
from typing import Any, ParamSpec, TypeVar

from kaidan.errors import InputError, did_you_mean, listed, shown

_Given = ParamSpec("_Given")
_Answer = TypeVar("_Answer")


def known_arguments(function: Callable[_Given, _Answer]) -> Callable[_Given, _Answer]:
    """Function that raises `InputError` for an argument that it does not know, or that is missing.

    What goes wrong within the function is not looked at.
    """

    @wraps(function)
    def asked(*args: _Given.args, **given: _Given.kwargs) -> _Answer:
        try:
            return function(*args, **given)
        except TypeError as error:
            if error.__traceback__ is None or error.__traceback__.tb_next is not None:
                raise
            code = getattr(function, "__code__")  # noqa: B009 - of functions alone
            known = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
            owner = function.__qualname__.partition(".")[0].lower()
            refuse_unknown(owner, given, [name for name in known if name != "cls"])
            raise InputError(str(error)) from None

    return asked


def refuse_unknown(owner: str, given: Mapping[str, Any], known: Collection[str]) -> None:
    """Refuse an argument that is none of those known."""
    for name in given:
        if name not in known:
            hint = did_you_mean(name, known) or f"; known: {listed(sorted(known))}"
            raise InputError(f"{owner}: {shown(name)} is not known{hint}")


def whole(name: str, given: Any, low: int, high: int) -> int:
    """Whole number within a range, both ends allowed.

    Examples
    --------
    >>> whole("points", 3, 2, 100)
    3
    """
    try:
        number = low - 1 if isinstance(given, bool) else index(given)
    except TypeError:  # neither an integer of Python nor of numpy
        number = low - 1
    if not low <= number <= high:
        raise InputError(f"{name} = {shown(given)} is not a whole number within {low} to {high}")
    return number


def flag(name: str, given: Any) -> bool:
    """True or false, and nothing that may pass for one."""
    of_numpy = str(getattr(given, "dtype", "")) == "bool" and given.shape == ()
    if not isinstance(given, bool) and not of_numpy:
        raise InputError(f"{name} = {shown(given)} is neither true nor false")
    return bool(given)


def several(name: str, given: Any) -> list[Any]:
    """Things of a list, a tuple or an array; a text is none of these."""
    if isinstance(given, str | bytes | Mapping) or not hasattr(given, "__iter__"):
        raise InputError(f"{name} = {shown(given)} is not a list")
    try:
        return list(given)
    except TypeError:  # an array without dimensions
        raise InputError(f"{name} = {shown(given)} is not a list") from None


def table(name: str, given: Any) -> Mapping[str, Any]:
    """Table whose keys are texts."""
    if not isinstance(given, Mapping) or not all(isinstance(key, str) for key in given):
        raise InputError(f"{name} = {shown(given)} is not a table of names and values")
    return given
