"""What kaidan raises: only for input without meaning, never for a robot that cannot climb."""

from collections.abc import Iterable
from difflib import get_close_matches


class KaidanError(Exception):
    """Root of everything kaidan raises on purpose."""


class InputError(KaidanError):
    """An input without physical meaning, or one that cannot be read.

    The text names the owner, the field, the value with its unit and what is allowed.
    """


class UnknownNameError(InputError):
    """A name that no catalogue holds; the text lists those it does."""

    def __init__(self, kind: str, name: str, known: Iterable[str]) -> None:
        known = sorted(known)
        close = get_close_matches(name.lower(), known, n=1)
        hint = f" Did you mean {close[0]!r}?" if close else ""
        super().__init__(
            f"no {kind} is called {name!r} and no such file exists.{hint} "
            f"Known: {', '.join(known)}."
        )


class MissingExtraError(KaidanError, ImportError):
    """An optional package is needed; the text is the line that installs it."""

    def __init__(self, purpose: str, extra: str) -> None:
        super().__init__(f"{purpose} needs an optional package: pip install 'kaidan[{extra}]'")
