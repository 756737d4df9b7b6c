"""Which kernel answers: one choice for the whole process, never what else happens to be imported.

====== ====================================================================================
native machine code built from the kernel's own source when kaidan was installed
plain  that source as ordinary Python: about a hundred times slower, equal to rounding
auto   native where it was built from the source that is installed, else plain
====== ====================================================================================

``auto`` is the default. The environment variable ``KAIDAN_KERNEL`` or
:func:`kaidan.contact.use_kernel` choose another; the function wins. The variable is read once.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import SimpleNamespace
from typing import Any, Literal, get_args

from kaidan.contact.entries import KERNEL_MODULES, KERNEL_PACKAGE
from kaidan.contact.source_mark import source_mark
from kaidan.errors import InputError, shown

Choice = Literal["auto", "plain", "native"]

VARIABLE = "KAIDAN_KERNEL"

_chosen: Choice | None = None


def use_kernel(choice: Choice | None) -> None:
    """Choose the kernel of this process.

    Parameters
    ----------
    choice : {"auto", "plain", "native"} or None
        None: as the environment variable ``KAIDAN_KERNEL`` says.

    Raises
    ------
    InputError
        An unknown choice.
    """
    global _chosen
    _chosen = None if choice is None else _checked("kernel", choice)


@contextmanager
def using_kernel(choice: Choice) -> Iterator[None]:
    """Choose the kernel for a while, to compare the two."""
    before = _chosen
    use_kernel(choice)
    try:
        yield
    finally:
        use_kernel(before)


def kernel_in_use() -> Literal["plain", "native"]:
    """Which kernel answers.

    Raises
    ------
    InputError
        ``KAIDAN_KERNEL`` names no kernel.

    Examples
    --------
    >>> with using_kernel("plain"):
    ...     kernel_in_use()
    'plain'
    """
    choice = _choice()
    if choice == "auto":
        return "plain" if without_native() else "native"
    return choice


def kernel() -> Any:
    """Entries of the kernel in use, by their names."""
    choice = _choice()
    if choice == "plain":
        return _plain()
    reason = without_native()
    if not reason:
        return _native()[0]
    if choice == "native":
        raise InputError(f"{VARIABLE} = native: {reason}")
    _warn_once()
    return _plain()


def without_native() -> str:
    """Why the native kernel does not answer; empty if it can."""
    return _native()[1]


@cache
def _native() -> tuple[Any, str]:
    try:
        module = importlib.import_module("kaidan.contact._native")
    except ImportError as error:
        return None, f"the native kernel is not installed ({error})"
    if source_mark() != module.SOURCE:
        return None, "the native kernel was built from another source: install kaidan again"
    from kaidan.contact import layout
    from kaidan.contact.door import dtype_of

    numbers = {"float": float, "int": int, "bool": bool}
    kinds = [numbers.get(name) or getattr(layout, name) for name in module.KINDS]
    module.use_dtypes(tuple(map(dtype_of, kinds)))
    return module, ""


@cache
def _warn_once() -> None:
    import logging  # takes longer than the kernel does to load

    logging.getLogger("kaidan.contact").warning(
        "%s; the plain kernel answers the same, about a hundred times slower", without_native()
    )


@cache
def _plain() -> SimpleNamespace:
    from kaidan.contact.door import plain

    entries = {}
    for name in KERNEL_MODULES:
        for key, value in vars(importlib.import_module(f"{KERNEL_PACKAGE}.{name}")).items():
            if hasattr(value, "_kaidan_entry"):
                entries[key] = plain(value)
    return SimpleNamespace(**entries)


def _choice() -> Choice:
    return _chosen or _stated()


@cache
def _stated() -> Choice:
    """What the environment says, read once: that takes longer than many a call of the kernel."""
    return _checked(VARIABLE, os.environ.get(VARIABLE) or "auto")


def _checked(owner: str, choice: str) -> Choice:
    for known in get_args(Choice):
        if choice == known:
            return known  # type: ignore[no-any-return]
    raise InputError(
        f"{owner} = {shown(choice)} is not known; known: {', '.join(get_args(Choice))}"
    )
