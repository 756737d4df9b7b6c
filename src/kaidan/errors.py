"""What kaidan raises: only for input without meaning, never for a robot that cannot climb."""

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from importlib import import_module
from typing import Any


class KaidanError(Exception):
    """Root of everything kaidan raises on purpose."""


LONGEST = 290
"""Characters of an error's text at most: one line on a screen, with the name of the command."""


class InputError(KaidanError):
    """An input without physical meaning, or one that cannot be read.

    The text names the owner, the field, the value with its unit and what is allowed; of one that is
    too long the middle is left out.
    """

    def __init__(self, text: str = "") -> None:
        super().__init__(within(text))


class RefusedError(InputError):
    """A file that was read and holds nothing that can be judged; the text has reason and numbers.

    A command ends with the exit code of an answer outside the model.
    """


def shown(value: Any) -> str:
    """Text of any value in one short line, for the text of an error.

    Examples
    --------
    >>> shown(10**5000), shown("x" * 100)[-6:]
    ('a number of more than 300 digits', 'xxx...')
    """
    try:
        text = repr(value)
    except (ValueError, OverflowError):  # an integer of more digits than Python writes
        text = "a number of more than 300 digits" if isinstance(value, int) else _unshown(value)
    except Exception:  # nested without end, or a class with a fault of its own
        text = _unshown(value)
    text = short(" ".join(text.split()))
    return text if len(text) <= 60 else f"{text[:57]}..."


def _unshown(value: Any) -> str:
    return f"a {type(value).__name__} that cannot be written"


def short(name: object) -> str:
    """Name of a file or a thing as it stands in an error: printable and not endless."""
    text = "".join(c if c.isprintable() else "�" for c in str(name))
    return text if len(text) <= 150 else f"{text[:87]}...{text[-60:]}"


def within(text: str, most: int = LONGEST) -> str:
    """Text as long as an error may be: its beginning and its end, which say most.

    Examples
    --------
    >>> within("a" * 50 + "b" * 50, 20)
    'aaaaaaaaaaaa...bbbbb'
    """
    end = most // 4
    return text if len(text) <= most else f"{text[: most - end - 3]}...{text[-end:]}"


def listed(names: Iterable[object], most: int = 120) -> str:
    """Names with commas between them, as many as a line of an error has room for.

    Examples
    --------
    >>> listed(["mass", "title", "track"], 12)
    'mass, title and 1 more'
    """
    every = [short(name) for name in names]
    kept = next((k for k in range(len(every)) if len(", ".join(every[: k + 1])) > most), len(every))
    kept = max(kept, 1)
    more = f" and {len(every) - kept} more" if len(every) > kept else ""
    return ", ".join(every[:kept]) + more


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """What may have been meant, as the end of a sentence; empty if nothing is close."""
    by_lower = {each.lower(): each for each in known}
    close = get_close_matches(str(word).strip().lower(), by_lower, n=1)
    return f"; did you mean {by_lower[close[0]]}?" if close else ""


def fault(detail: Mapping[str, Any]) -> str:
    """What is wrong with an input that pydantic refuses, as the end of a sentence that names it.

    Parameters
    ----------
    detail : mapping
        One of the errors of a ``ValidationError``.

    Examples
    --------
    >>> fault({"type": "literal_error", "ctx": {"expected": "'up' or 'down'"}})
    'is not one of up, down'
    """
    kind, limits = detail["type"], detail.get("ctx", {})
    if kind in ("literal_error", "enum"):
        words = str(limits["expected"]).replace(" or ", ", ").replace("'", "")
        return f"is not one of {words}"
    if kind in _BEYOND:
        least, said = _BEYOND[kind]
        return f"is {said} {limits[least]:.12g}"
    if kind in ("too_short", "too_long"):
        allowed = limits["min_length" if kind == "too_short" else "max_length"]
        than = "fewer" if kind == "too_short" else "more"
        return f"has {than} than {allowed} items"
    if kind == "json_invalid":
        return f"is not JSON: {limits['error']}"
    ends = (said for begins, said in _FAULTS.items() if kind.startswith(begins))
    return next(ends, f"is refused: {detail.get('msg', kind)}")


_BEYOND = {
    "greater_than_equal": ("ge", "less than"),
    "greater_than": ("gt", "not more than"),
    "less_than_equal": ("le", "more than"),
    "less_than": ("lt", "not less than"),
}
"""Limits of numbers as pydantic calls them."""
_FAULTS = {
    "int_": "is not a whole number",
    "float_": "is not a number",
    "finite_": "is not a finite number",
    "string_": "is not a text",
    "bool_": "is neither true nor false",
    "list_": "is not a list",
    "tuple_": "is not a list",
    "dict_": "is not a table",
    "model_": "is not a table of fields",
    "missing": "is missing",
    "extra_forbidden": "is not a known field",
}
"""Beginnings of the kinds of pydantic's errors."""


class UnknownNameError(InputError):
    """A name that no catalogue holds; the text lists those it does."""

    def __init__(self, kind: str, name: str, known: Iterable[str], elsewhere: str = "") -> None:
        known = sorted(known)
        meant = _meant(name, known)
        hint = f" Did you mean {' or '.join(map(repr, meant))}?" if meant else ""
        super().__init__(
            f"no {kind} is called {shown(name)} and no such file exists{elsewhere}.{hint} "
            f"Known: {listed(known, 190)}."
        )


def _meant(name: str, known: list[str]) -> list[str]:
    """A name mistyped by a letter or two; else those that share a word; else the closest."""
    name = name.strip().lower().replace("_", "-").replace(" ", "-")
    words = set(name.split("-"))
    shared = {each: len(words & set(each.split("-"))) for each in known}
    most = max(1, *shared.values())
    return (
        get_close_matches(name, known, n=1, cutoff=0.85)
        or [each for each, count in shared.items() if count == most]
        or get_close_matches(name, known, n=1)
    )


def needed(module: str, purpose: str, extra: str) -> Any:
    """Module of an optional package.

    Raises
    ------
    MissingExtraError
        It is not installed.
    """
    try:
        return import_module(module)
    except ImportError:
        raise MissingExtraError(purpose, extra) from None


class MissingExtraError(KaidanError, ImportError):
    """An optional package is needed; the text is the line that installs it."""

    def __init__(self, purpose: str, extra: str) -> None:
        super().__init__(f"{purpose} needs an optional package: pip install 'kaidan[{extra}]'")
