"""Answers and sheets of kaidan, found in its sources."""

import ast
from importlib import import_module
from pathlib import Path
from typing import Any

import kaidan

SOURCE = Path(kaidan.__file__).parent


def models(*bases: str) -> list[Any]:
    """Classes of all modules that name one of these as a base, by their names."""
    found = []
    for path in SOURCE.rglob("*.py"):
        module = ".".join(["kaidan", *path.relative_to(SOURCE).with_suffix("").parts])
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef) and any(
                isinstance(base, ast.Name) and base.id in bases for base in node.bases
            ):
                found.append(getattr(import_module(module.removesuffix(".__init__")), node.name))
    return sorted(found, key=lambda model: str(model.__name__))
