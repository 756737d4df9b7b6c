"""Public names of a package whose modules are imported when a name is first used."""

TYPE_CHECKING = False  # as typing has it, which takes longer to import than all of this
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any


def when_used(package: str, home: "Mapping[str, str]") -> "Callable[[str], Any]":
    """`__getattr__` of a package."""

    def found(name: str) -> "Any":
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        from importlib import import_module

        return getattr(import_module(f"{package}.{home[name]}"), name)

    return found
