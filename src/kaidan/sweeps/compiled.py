"""The formulas of `kaidan.mechanics`, compiled from their own source: one copy of each.

numba compiles a function together with those it calls, once the names it calls stand for compiled
functions. So a formula is rebuilt from its own code with every formula it names compiled first,
numpy's functions of arrays replaced by those of one number, and everything inlined: what is left
is one loop without a branch, which the compiler turns into vector instructions.
"""

from collections import namedtuple
from collections.abc import Callable
from enum import EnumType
from functools import cache
from importlib.util import find_spec
from types import FunctionType, ModuleType
from typing import Any

import numpy as np

from kaidan.errors import MissingExtraError
from kaidan.mechanics.validity import validity
from kaidan.sweeps import elementary

_OURS = ("kaidan.mechanics", elementary.__name__)


def available() -> bool:
    """Whether numba is installed."""
    return find_spec("numba") is not None


@cache
def compiled(formula: Callable[..., Any]) -> Any:
    """Formula compiled by numba for plain numbers, called with positional arguments.

    formula: a function of `kaidan.mechanics`.

    Its compiled twin; keyword-only arguments have become positional in the same order.
    """
    assert isinstance(formula, FunctionType)
    code = formula.__code__
    names = {
        name: _stand_in(value, formula)
        for name, value in formula.__globals__.items()
        if name in code.co_names
    }
    positional = code.replace(
        co_argcount=code.co_argcount + code.co_kwonlyargcount, co_kwonlyargcount=0
    )
    twin = FunctionType(positional, names, formula.__name__)
    twin.__defaults__ = tuple((formula.__kwdefaults__ or {}).values()) or None
    twin.__module__ = formula.__module__
    return numba().njit(error_model="numpy", forceinline=True)(twin)


def numba() -> Any:
    """The module numba, or an error that says how to install it."""
    try:
        import numba
    except ImportError:
        raise MissingExtraError("the compiled sweep", "fast") from None
    return numba


def _stand_in(value: Any, formula: FunctionType) -> Any:
    """What a name of a formula stands for in its compiled twin."""
    if value is elementary.where:
        return _select()
    if value is validity:
        return compiled(elementary.validity)
    if isinstance(value, FunctionType) and value.__module__.startswith(_OURS):
        return compiled(value)
    if value is np and formula.__module__ != elementary.__name__:
        return _numpy_for_numbers()
    if isinstance(value, EnumType):  # numbers, not members
        members: dict[str, int] = {member.name: int(member) for member in value}  # type: ignore
        return namedtuple(value.__name__, members)(**members)
    return value


@cache
def _numpy_for_numbers() -> ModuleType:
    """Functions of numpy as one number needs them, those of `elementary` in its place."""
    module = ModuleType("numpy_for_numbers")
    for name in ("sqrt", "abs", "floor", "rint", "pi", "nan"):
        setattr(module, name, getattr(np, name))
    for name in ("minimum", "fmin", "fmax", "tan", "arctan2"):
        setattr(module, name, compiled(getattr(elementary, name)))
    module.where = _select()  # type: ignore[attr-defined]
    return module


@cache
def _select() -> Any:
    """`elementary.where` as the processor's select: no branch that would stop vectorising."""
    from numba.core import types
    from numba.extending import intrinsic

    @intrinsic
    def select(context: Any, condition: Any, x: Any, y: Any) -> Any:
        result = types.float64 if types.float64 in (x, y) else x

        def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            chosen, first, second = arguments
            return builder.select(chosen, first, second)

        return result(types.boolean, result, result), build

    return select
