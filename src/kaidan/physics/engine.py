"""MuJoCo, imported when a model is built and not before."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes.util import find_library
from functools import cache
from importlib import import_module
from typing import Any

from kaidan.errors import MissingExtraError

OLDEST = (3, 13)
"""Oldest MuJoCo with what the models need: geom/surfacevel (3.11), integrator "discrete" (3.13)."""


@cache
def engine() -> Any:
    """The module `mujoco`."""
    if "mujoco" not in sys.modules and "MUJOCO_GL" not in os.environ and not _has_a_display():
        # MuJoCo settles how it draws when it is imported; nothing needs a display here
        for name, library in (("egl", "EGL"), ("osmesa", "OSMesa")):
            if find_library(library):
                os.environ["MUJOCO_GL"] = name
                break
    try:
        mujoco = import_module("mujoco")
    except ImportError:
        raise MissingExtraError("the physics model", "physics") from None
    found = tuple(int(part) for part in mujoco.__version__.split(".")[:2])
    if found < OLDEST:
        raise MissingExtraError(
            f"the physics model with MuJoCo {mujoco.__version__} (older than "
            f"{'.'.join(map(str, OLDEST))})",
            "physics",
        )
    return mujoco


def _has_a_display() -> bool:
    return sys.platform != "linux" or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )


@contextmanager
def quiet() -> Iterator[None]:
    """Context in which MuJoCo's warnings are counted by its data and written nowhere.

    Otherwise it prints them and leaves a MUJOCO_LOG.TXT in whatever folder it runs in.
    """
    mujoco = engine()
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(_unheard)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def _unheard(_: object) -> None:
    """Take a warning and say nothing."""


def engine_version() -> str:
    """Version of MuJoCo."""
    return str(engine().__version__)
