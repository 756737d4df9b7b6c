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
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar

_F = TypeVar("_F", bound=Callable[..., Any])

#: Kernel modules in the order in which they import one another.
KERNEL_MODULES = (
    "gaps",
    "scan",
    "settling",
    "branch",
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


def numba_is_installed() -> bool:
    """Whether the optional compiler is there (it is not imported to find out)."""
    return importlib.util.find_spec("numba") is not None


def plain(module: str) -> ModuleType:
    """Return a kernel module as plain Python."""
    return importlib.import_module(f"{_PACKAGE}.{module}")


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
        for key, value in list(vars(module).items()):
            if not getattr(value, "_kaidan_kernel", False):
                continue
            if value.__module__ == alias:
                value.__qualname__ = f"{key}_{mark}"
                compiled_function = njit(cache=True, error_model="numpy")(value)
                fast[id(vars(original)[key])] = compiled_function
                setattr(module, key, compiled_function)
            else:
                setattr(module, key, fast[id(value)])
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


def kernel_module(module: str, *, compile_kernel: bool | None = None) -> ModuleType:
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
        compile_kernel = "numba" in sys.modules
    return compiled(module) if compile_kernel else plain(module)
