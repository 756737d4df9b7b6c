"""What is installed, and which contact kernel answers: for reports of faults, and for speed."""

import platform
import re
from importlib.metadata import PackageNotFoundError, requires, version
from typing import Literal

from kaidan import contact
from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments


class Extra(Part):
    """An optional part of kaidan."""

    name: str
    """As in `pip install 'kaidan[NAME]'`."""
    missing: tuple[str, ...]
    """Packages that it needs and that are not installed."""


class Diagnosis(Answer):
    """What `doctor` answers."""

    text_module = "kaidan.text.doctor"

    kaidan: str
    """Version of kaidan."""
    python: str
    """Version of Python."""
    machine: str
    """Operating system and processor."""
    kernel: Literal["native", "plain"]
    """Contact kernel that answers in this process."""
    without_native: str
    """Why the native kernel does not answer; empty if it can."""
    extras: tuple[Extra, ...]
    """Optional parts."""


@known_arguments
def doctor() -> Diagnosis:
    """Say what is installed and which contact kernel answers.

    Raises
    ------
    InputError
        ``KAIDAN_KERNEL`` names no kernel.

    Examples
    --------
    >>> doctor().kernel in ("native", "plain")
    True
    """
    from kaidan import __version__

    return Diagnosis(
        kaidan=__version__,
        python=platform.python_version(),
        machine=f"{platform.system()} {platform.machine()}",
        kernel=contact.kernel_in_use(),
        without_native=contact.without_native(),
        extras=_extras(),
    )


FOR_DEVELOPERS = ("dev", "docs", "test")
_REQUIREMENT = re.compile(r"([A-Za-z0-9._-]+)[^;]*;.*extra == ['\"]([a-z0-9-]+)['\"]")


def _extras() -> tuple[Extra, ...]:
    try:
        lines = requires("kaidan") or []
    except PackageNotFoundError:  # run from its source, never installed
        lines = []
    found: dict[str, list[str]] = {}
    for line in lines:
        match = _REQUIREMENT.match(line)
        if match and match[2] not in FOR_DEVELOPERS:
            missing = found.setdefault(match[2], [])
            if not _installed(match[1]):
                missing.append(match[1])
    return tuple(Extra(name=name, missing=tuple(found[name])) for name in sorted(found))


def _installed(package: str) -> bool:
    try:
        version(package)
    except PackageNotFoundError:
        return False
    return True
