"""One source, two speeds: the kernel as plain Python, or the same functions compiled by numba.

The kernel modules hold ordinary functions of floats and arrays, marked with :func:`kernel`.
Imported as usual they run as they stand, with no start-up cost.  :func:`compiled` loads the same
source files a second time under other module names and hands every marked function to
``numba.njit(cache=True)``.  There is no second formulation that could drift away from the first.
"""

from __future__ import annotations

import hashlib
import importlib
import importlib.util
import sys
from collections.abc import Callable
from functools import lru_cache, wraps
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np

from kaidan.contact.tables import FloatArray, FloatRow, IntArray

_F = TypeVar("_F", bound=Callable[..., Any])

#: Kernel modules in the order in which they import one another.
KERNEL_MODULES = (
    "gaps",
    "scan",
    "settling",
    "branch",
    "turning",
    "release",
    "course",
    "forces",
    "margins",
    "no_rotation",
    "batch",
)

_PACKAGE = "kaidan.contact"


def kernel(function: _F) -> _F:
    """Mark a function as part of the compilable kernel; it is returned unchanged."""
    function.__dict__["_kaidan_kernel"] = True
    return function


def leaf(function: _F) -> _F:
    """Mark a small kernel function to be pasted into its callers.

    A call hands over fourteen words for the two tables; that costs as much as a gap.
    """
    function.__dict__["_kaidan_leaf"] = True
    return kernel(function)


def entry(function: _F) -> _F:
    """Mark a kernel function that is also called from Python (the rest is for the kernel only)."""
    function.__dict__["_kaidan_entry"] = True
    return kernel(function)


def _signature(function: Callable[..., Any]) -> Any:
    """Numba's signature from the annotations.

    Without it every literal 0 or -1 in an argument compiles the callee once more, and all that it
    calls; 90 versions of 45 functions.
    """
    from numba import boolean, float64, int64, types, void

    simple = {
        float: float64,
        int: int64,
        bool: boolean,
        type(None): void,
        FloatArray: float64[:, ::1],
        FloatRow: float64[::1],
        IntArray: int64[::1],
    }
    hints = get_type_hints(function)
    answer = hints.pop("return")
    if get_origin(answer) is tuple:
        result = types.Tuple([simple[part] for part in get_args(answer)])  # type: ignore[no-untyped-call]
    else:
        result = simple[answer]  # type: ignore[assignment]
    return result(*(simple[hint] for hint in hints.values()))


def _callees_first(functions: dict[str, Any]) -> list[str]:
    """Names of functions of one module, each after those that it calls."""
    order: list[str] = []

    def visit(name: str) -> None:
        if name in order:
            return
        for callee in functions[name].__code__.co_names:
            if callee in functions and callee != name:
                visit(callee)
        order.append(name)

    for name in functions:
        visit(name)
    return order


def numba_is_installed() -> bool:
    """Whether the optional compiler is there (it is not imported to find out)."""
    return importlib.util.find_spec("numba") is not None


def numba_is_loaded() -> bool:
    """Whether this process has loaded the compiler already."""
    return "numba" in sys.modules


def plain(module: str) -> ModuleType:
    """Return a kernel module as plain Python."""
    return importlib.import_module(f"{_PACKAGE}.{module}")


@lru_cache
def _plain_with_views(module: str) -> SimpleNamespace:
    """Plain module whose entries read their tables through views.

    An element of a view is a float, one of an array is an object of numpy's, on which arithmetic
    takes four times as long: the plain kernel runs nearly twice as fast. Views cannot be cut up, as
    the batch does with its tables.
    """
    names = dict(vars(plain(module)))
    if module != "batch":
        for name, value in names.items():
            if hasattr(value, "_kaidan_entry"):
                names[name] = _through_views(value)
    return SimpleNamespace(**names)


def _through_views(function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def call(*arguments: Any) -> Any:
        tables = (isinstance(each, np.ndarray) and each.ndim == 2 for each in arguments)
        return function(
            *(
                memoryview(each) if is_table else each
                for each, is_table in zip(arguments, tables, strict=True)
            )
        )

    return call


def _tell() -> None:
    """Say why it takes a while; silenced as any other logger."""
    import logging

    logging.getLogger(_PACKAGE).warning(
        "kaidan: compiling the contact kernel, once on this machine: about 20 seconds"
    )


@lru_cache(maxsize=1)
def _compiled_modules() -> dict[str, ModuleType]:
    try:
        from numba import njit
    except ImportError as error:
        raise ImportError(
            "the compiled contact kernel needs numba: pip install 'kaidan[fast]'"
        ) from error
    # numba's cache looks at one file only: name the functions after all sources, so that no
    # compiled caller outlives a change of what it calls
    digest = hashlib.sha256()
    for name in KERNEL_MODULES:
        digest.update(Path(str(plain(name).__file__)).read_bytes())
    mark = digest.hexdigest()[:12]
    told = False
    fast: dict[int, Any] = {}
    modules: dict[str, ModuleType] = {}
    for name in KERNEL_MODULES:
        original = plain(name)
        alias = f"{_PACKAGE}._compiled_{name}"
        spec = importlib.util.spec_from_file_location(alias, original.__file__)
        if spec is None or spec.loader is None:
            raise ImportError(f"cannot load the source of {original.__name__}")
        module = importlib.util.module_from_spec(spec)
        sys.modules[alias] = module
        spec.loader.exec_module(module)
        own: dict[str, Any] = {}
        for key, value in list(vars(module).items()):
            if not hasattr(value, "_kaidan_kernel"):
                continue
            if value.__module__ == alias:
                own[key] = value
            else:
                setattr(module, key, fast[id(value)])
        for key in _callees_first(own):
            value = own[key]
            value.__qualname__ = f"{key}_{mark}"
            # numpy's division: no branch to an exception behind every "/"
            options: dict[str, Any] = {
                "cache": True,
                "error_model": "numpy",
                "no_cpython_wrapper": not hasattr(value, "_kaidan_entry"),
                "no_cfunc_wrapper": True,
                "forceinline": hasattr(value, "_kaidan_leaf"),
            }
            compiled_function = njit(_signature(value), **options)(value)
            if not told and not compiled_function.stats.cache_hits:
                _tell()
                told = True
            fast[id(vars(original)[key])] = compiled_function
            setattr(module, key, compiled_function)
        modules[name] = module
    return modules


def compiled(module: str) -> ModuleType:
    """Return the same kernel module with every marked function compiled (on first call, cached).

    Raises
    ------
    ImportError
        If numba is not installed; the text names the install line.
    """
    return _compiled_modules()[module]


def kernel_module(
    module: str, *, compile_kernel: bool | None = None
) -> ModuleType | SimpleNamespace:
    """Return a kernel module, compiled or plain.

    Parameters
    ----------
    module
        One of :data:`KERNEL_MODULES`.
    compile_kernel
        True: compiled; False: plain Python; None: compiled if numba is already imported in this
        process, else plain, so that a single question never waits for a compiler.
    """
    if compile_kernel is None:
        compile_kernel = numba_is_loaded()
    return compiled(module) if compile_kernel else _plain_with_views(module)
