"""The generated C of the contact kernel, with nothing but Python's own library at hand."""

from __future__ import annotations

import importlib
import importlib.machinery
import importlib.util
import sys
from pathlib import Path
from typing import Any

SOURCE = Path(__file__).resolve().parents[1] / "src"
#: Packages of which nothing but the kernel's own modules is loaded: the rest needs numpy.
PACKAGES = ("kaidan", "kaidan.contact")


def bare() -> None:
    """Let the kernel's modules be found without what the packages around it load."""
    for name in PACKAGES:
        if name not in sys.modules:
            spec = importlib.machinery.ModuleSpec(name, None, is_package=True)
            spec.submodule_search_locations = [str(SOURCE / name.replace(".", "/"))]
            sys.modules[name] = importlib.util.module_from_spec(spec)


def kernel_source() -> str:
    """Text of the C module."""
    bare()
    sys.path.insert(0, str(Path(__file__).parent))
    from emitter import Module

    entries: Any = importlib.import_module("kaidan.contact.entries")
    mark: Any = importlib.import_module("kaidan.contact.source_mark")
    modules = [
        importlib.import_module(f"{entries.KERNEL_PACKAGE}.{name}")
        for name in entries.KERNEL_MODULES
    ]
    module = Module(modules)
    called = [each for each in module.names if hasattr(each, "_kaidan_entry")]
    return module.text(mark.source_mark(), called)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(kernel_source(), encoding="utf-8")
