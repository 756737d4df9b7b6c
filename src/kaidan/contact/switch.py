"""Which kernel answers: one choice for the whole process, never what else happens to be imported.

======== ==================================================================================
plain    ordinary Python: no start-up time, about a hundred times slower
compiled by numba: one second to load, half a minute the first time on a machine
auto     plain, unless the work at hand is announced to take longer than 5 s and numba
         is installed
======== ==================================================================================

``auto`` is the default. The environment variable ``KAIDAN_KERNEL`` or
:func:`kaidan.contact.use_kernel` choose another; the function wins. Both kernels give the same
numbers to rounding.
"""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Literal, get_args

from kaidan.errors import InputError, shown

Choice = Literal["auto", "plain", "compiled"]

VARIABLE = "KAIDAN_KERNEL"
PATIENCE = 5.0
"""Work of the plain kernel above which the compiled one pays [s]: it may have to compile."""

_chosen: Choice | None = None
_work: ContextVar[float] = ContextVar("work", default=0.0)
_broken = False


def use_kernel(choice: Choice | None) -> None:
    """Choose the kernel of this process.

    Parameters
    ----------
    choice : {"auto", "plain", "compiled"} or None
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


@contextmanager
def expected_work(seconds: float) -> Iterator[None]:
    """Announce how long the plain kernel would take for what follows [s]."""
    token = _work.set(max(seconds, _work.get()))
    try:
        yield
    finally:
        _work.reset(token)


def kernel_in_use(seconds: float = 0.0) -> Literal["plain", "compiled"]:
    """Which kernel answers, for work that takes the plain one so long [s].

    Raises
    ------
    InputError
        ``KAIDAN_KERNEL`` names no kernel.

    Examples
    --------
    >>> with using_kernel("auto"):
    ...     kernel_in_use()
    'plain'
    """
    choice = _choice()
    if choice != "auto":
        return choice
    long = max(seconds, _work.get()) > PATIENCE
    return "compiled" if long and not _broken and numba_is_installed() else "plain"


def is_chosen() -> bool:
    """Whether a kernel was chosen by name, so that it is that one or an error."""
    return _choice() != "auto"


def numba_is_installed() -> bool:
    """Whether the optional compiler is there (it is not imported to find out)."""
    return importlib.util.find_spec("numba") is not None


def compiler_is_broken() -> None:
    """Let ``auto`` never try the compiler again in this process."""
    global _broken
    _broken = True


def _choice() -> Choice:
    return _chosen or _checked(VARIABLE, os.environ.get(VARIABLE) or "auto")


def _checked(owner: str, choice: str) -> Choice:
    for known in get_args(Choice):
        if choice == known:
            return known  # type: ignore[no-any-return]
    raise InputError(
        f"{owner} = {shown(choice)} is not known; known: {', '.join(get_args(Choice))}"
    )
