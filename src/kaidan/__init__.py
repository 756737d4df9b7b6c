"""kaidan: can this tracked robot take these stairs?"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from kaidan.assessment import Assessment, assess
    from kaidan.errors import InputError, KaidanError
    from kaidan.robot import Payload, Posture, Robot
    from kaidan.stairs import Stairs
    from kaidan.surface import Surface
    from kaidan.sweeps import stream, sweep, verdicts

__version__ = "0.1.0"

_HOME = {
    "Assessment": "kaidan.assessment",
    "assess": "kaidan.assessment",
    "InputError": "kaidan.errors",
    "KaidanError": "kaidan.errors",
    "Payload": "kaidan.robot",
    "Posture": "kaidan.robot",
    "Robot": "kaidan.robot",
    "Stairs": "kaidan.stairs",
    "Surface": "kaidan.surface",
    "stream": "kaidan.sweeps",
    "sweep": "kaidan.sweeps",
    "verdicts": "kaidan.sweeps",
}

__all__ = [  # noqa: RUF022 - what a user meets first
    "assess",
    "sweep",
    "verdicts",
    "stream",
    "Assessment",
    "Robot",
    "Stairs",
    "Surface",
    "Payload",
    "Posture",
    "KaidanError",
    "InputError",
    "__version__",
]


def __getattr__(name: str) -> Any:
    """Public names, imported when first used, so that starting costs nothing."""
    if name not in _HOME:
        raise AttributeError(f"module 'kaidan' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
