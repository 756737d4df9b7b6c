"""Answers and sheets of kaidan, found in its sources."""

import re
from importlib import import_module
from pathlib import Path
from typing import Any

import kaidan

SOURCE = Path(kaidan.__file__).parent
CLASS = re.compile(r"^class (\w+)\(([^)]*)\):", re.MULTILINE)


def models(*bases: str) -> list[Any]:
    """Classes of all modules that name one of these as a base, by their names."""
    found = []
    for path in SOURCE.rglob("*.py"):
        module = ".".join(["kaidan", *path.relative_to(SOURCE).with_suffix("").parts])
        for name, named in CLASS.findall(path.read_text(encoding="utf-8")):
            if {base.strip() for base in named.split(",")} & set(bases):
                found.append(getattr(import_module(module.removesuffix(".__init__")), name))
    return sorted(found, key=lambda model: str(model.__name__))
