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
import threading
from collections.abc import Callable
from functools import lru_cache, wraps
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np

from kaidan.contact import codes, columns, switch
from kaidan.contact.compiler_cache import cache_folder, filling, log
from kaidan.contact.tables import FloatArray, FloatRow, IntArray
from kaidan.errors import MissingExtraError

_F = TypeVar("_F", bound=Callable[..., Any])

#: Kernel modules in the order in which they import one another.
KERNEL_MODULES = (
    "gaps",
    "nearest_feature",
    "settling",
    "continuation",
    "event_location",
    "advance",
    "rotation",
    "closing",
    "first_closing",
    "toppling",
    "reserves",
    "recording",
    "renaming",
    "contact_changes",
    "driver",
    "forces",
    "margins",
    "batch",
)

_PACKAGE = "kaidan.contact.kernel"


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

    def typed(hint: Any) -> Any:
        if get_origin(hint) is tuple:
            return types.Tuple([typed(part) for part in get_args(hint)])  # type: ignore[no-untyped-call]
        return simple[hint]

    hints = get_type_hints(function)
    answer = typed(hints.pop("return"))
    return answer(*(typed(hint) for hint in hints.values()))


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


def _loaded(name: str) -> ModuleType:
    """Load the source of a kernel module a second time, under another name."""
    original = plain(name)
    alias = f"{_PACKAGE}._compiled_{name}"
    spec = importlib.util.spec_from_file_location(alias, original.__file__)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot load the source of {original.__name__}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[alias] = module
    spec.loader.exec_module(module)
    return module


def _source_mark() -> str:
    """Mark of all sources together.

    Numba's cache looks at one file only: functions are named after all, so that no compiled caller
    outlives a change of what it calls.
    """
    digest = hashlib.sha256()
    for source in (columns, codes, *map(plain, KERNEL_MODULES)):
        digest.update(Path(str(source.__file__)).read_bytes())
    return digest.hexdigest()[:12]


def _compile_all(njit: Callable[..., Any], *, cache: bool) -> dict[str, ModuleType]:
    mark = _source_mark()
    said = False
    fast: dict[int, Any] = {}
    modules: dict[str, ModuleType] = {}
    for name in KERNEL_MODULES:
        module = modules[name] = _loaded(name)
        own: dict[str, Any] = {}
        for key, value in list(vars(module).items()):
            if not hasattr(value, "_kaidan_kernel"):
                continue
            if value.__module__ == module.__name__:
                own[key] = value
            else:
                setattr(module, key, fast[id(value)])
        for key in _callees_first(own):
            value = own[key]
            value.__qualname__ = f"{key}_{mark}"
            # numpy's division: no branch to an exception behind every "/"
            options: dict[str, Any] = {
                "cache": cache,
                "error_model": "numpy",
                "no_cpython_wrapper": not hasattr(value, "_kaidan_entry"),
                "no_cfunc_wrapper": True,
                "forceinline": hasattr(value, "_kaidan_leaf"),
                # what makes no array counts no references: twice as fast
                "_nrt": "np" in value.__code__.co_names,
            }
            compiled_function = njit(_signature(value), **options)(value)
            if cache and not said and not compiled_function.stats.cache_hits:
                log.warning("compiling the contact kernel, once on this machine: about 20 seconds")
                said = True
            fast[id(vars(plain(name))[key])] = compiled_function
            setattr(module, key, compiled_function)
    return modules


_compiled: dict[str, ModuleType] = {}
_compiling = threading.Lock()


def compiled(module: str) -> ModuleType:
    """Return the same kernel module with every marked function compiled (on first call, cached).

    Where no cache can be written it is compiled anew in every process.

    Raises
    ------
    MissingExtraError
        If numba is not installed.
    """
    with _compiling:
        if not _compiled:
            _compiled.update(_compiled_modules())
    return _compiled[module]


def _compiled_modules() -> dict[str, ModuleType]:
    if not switch.numba_is_installed():
        raise MissingExtraError("the compiled contact kernel", "fast")
    from numba import njit

    folder = cache_folder(njit, plain(KERNEL_MODULES[0]).gap)
    if folder is not None:
        try:
            with filling(folder):
                return _compile_all(njit, cache=True)
        except OSError as error:
            log.warning("the compiled contact kernel cannot be kept in %s: %s", folder, error)
    log.warning("compiling the contact kernel for this process alone: set NUMBA_CACHE_DIR")
    return _compile_all(njit, cache=False)


def kernel_module(module: str) -> ModuleType | SimpleNamespace:
    """Return a kernel module (one of :data:`KERNEL_MODULES`), of the kernel in use.

    Raises
    ------
    MissingExtraError
        If the compiled kernel was chosen and numba is not installed.
    """
    if switch.kernel_in_use() == "plain":
        return _plain_with_views(module)
    if switch.is_chosen():
        return compiled(module)
    try:
        return compiled(module)
    except Exception as error:  # whatever is wrong with the compiler, the plain kernel answers
        switch.compiler_is_broken()
        log.warning("the plain contact kernel answers, numba does not work here: %s", error)
        return _plain_with_views(module)
