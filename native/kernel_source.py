"""The generated C of the contact kernel, with nothing but Python's own library at hand."""

from __future__ import annotations

import importlib
import importlib.machinery
import importlib.util
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
#: Where a source distribution has it.
CARRIED = "native/kernel.c"
#: Packages of which nothing but the kernel's own modules is loaded: the rest needs numpy.
PACKAGES = ("kaidan", "kaidan.contact")


def bare() -> None:
    """Let the kernel's modules be found without what the packages around it load."""
    for name in PACKAGES:
        if name not in sys.modules:
            spec = importlib.machinery.ModuleSpec(name, None, is_package=True)
            spec.submodule_search_locations = [str(ROOT / "src" / name.replace(".", "/"))]
            sys.modules[name] = importlib.util.module_from_spec(spec)


def source_mark() -> str:
    """Mark of the Python source from which the C is generated."""
    bare()
    mark: str = importlib.import_module("kaidan.contact.source_mark").source_mark()
    return mark


def kernel_source() -> str:
    """Text of the C module."""
    mark = source_mark()
    sys.path.insert(0, str(Path(__file__).parent))
    from emitter import Module

    entries: Any = importlib.import_module("kaidan.contact.entries")
    modules = [
        importlib.import_module(f"{entries.KERNEL_PACKAGE}.{name}")
        for name in entries.KERNEL_MODULES
    ]
    module = Module(modules)
    called = [each for each in module.names if hasattr(each, "_kaidan_entry")]
    return module.text(mark, called)


def carried_source() -> str:
    """Text that a source distribution carries, if it was generated from what lies beside it."""
    file = ROOT / CARRIED
    text = file.read_text(encoding="utf-8") if file.exists() else ""
    return text if f'#define SOURCE "{source_mark()}"' in text else ""


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(kernel_source(), encoding="utf-8")
