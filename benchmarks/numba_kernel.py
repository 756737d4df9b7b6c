"""The contact kernel compiled by numba, from the same source: the native one's measure."""

import importlib
import importlib.util
import inspect
import sys
from types import SimpleNamespace
from typing import Any, get_args, get_origin, get_type_hints

from numba import boolean, float64, int64, njit, types, void

from kaidan.contact.entries import KERNEL_MODULES, KERNEL_PACKAGE
from kaidan.contact.tables import FloatArray, FloatRow, IntArray

TYPES = {
    float: float64,
    int: int64,
    bool: boolean,
    type(None): void,
    FloatArray: float64[:, ::1],
    FloatRow: float64[::1],
    IntArray: int64[::1],
}


def numba_kernel() -> SimpleNamespace:
    """Entries of the kernel, each compiled ahead of its first call; takes half a minute."""
    done: dict[str, Any] = {}
    for name in KERNEL_MODULES:
        module = _second_copy(name)
        for key in [key for key in vars(module) if key in done]:
            setattr(module, key, done[key])
        own = {
            key: value
            for key, value in vars(module).items()
            if inspect.isfunction(value) and value.__module__ == module.__name__
        }
        for key in _callees_first(own):
            function = own[key]
            done[key] = njit(
                _signature(function), error_model="numpy", no_cfunc_wrapper=True, _nrt=False,
                no_cpython_wrapper=not hasattr(function, "_kaidan_entry"),
            )(function)  # fmt: skip
            setattr(module, key, done[key])
    return SimpleNamespace(**done)


def _second_copy(name: str) -> Any:
    original = importlib.import_module(f"{KERNEL_PACKAGE}.{name}")
    spec = importlib.util.spec_from_file_location(f"numba_{name}", original.__file__)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def _signature(function: Any) -> Any:
    def typed(hint: Any) -> Any:
        if get_origin(hint) is tuple:
            return types.Tuple([typed(part) for part in get_args(hint)])
        return TYPES[hint]

    hints = get_type_hints(function)
    answer = typed(hints.pop("return"))
    return answer(*(typed(hint) for hint in hints.values()))


def _callees_first(functions: dict[str, Any]) -> list[str]:
    order: list[str] = []

    def visit(name: str) -> None:
        if name not in order:
            for callee in functions[name].__code__.co_names:
                if callee in functions and callee != name:
                    visit(callee)
            order.append(name)

    for name in functions:
        visit(name)
    return order
