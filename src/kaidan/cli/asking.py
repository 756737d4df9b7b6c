"""``kaidan new --ask``: a sheet filled in by questions, on a terminal or from a pipe."""

import os
import sys
from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from typing import Any

import typer

from kaidan.sheet import Sheet, bounds, table_of, words_of
from kaidan.tables import human
from kaidan.text import guide

PATIENCE = 10.0
"""How long a pipe may stay silent [s]."""
LONGEST_LINE = 10_000
"""Bytes of an answer at most."""
MOST_LEFT = 1000
"""Lines behind the last answer that are looked at: more are empty without end."""
_ASKED = {
    "robot": (
        "title",
        "mass",
        "track.flat_length",
        "track.front_radius",
        "track.rear_radius",
        "com_from_front",
        "com_height",
        "track.gauge",
        "drive.max_speed",
        "front_flippers",
        "rear_flippers",
        "track.belt",
    ),
    "stairs": (
        "title",
        "rise",
        "going",
        "steps",
        "first_rise",
        "last_rise",
        "nosing_overhang",
        "lower_turn",
        "upper_turn",
    ),
    "surface": ("title", "friction_low", "friction_high"),
}
"""Figures that are requested, in this order."""
_FLIPPERS = ("length", "root_radius", "tip_radius", "pivot_height", "mass", "max_speed")
_GROUSERS = ("track.grouser_height", "track.grouser_spacing")
_LANDING = ("landing", "landing_width")
_BEYOND = ("passage", "leaf")
_CENTROID = ("com_from_front", "com_height")


def ask(kind: type[Sheet]) -> dict[str, Any]:
    """Figures of a sheet by their dotted names, as their owner answers."""
    answers = _Answers()
    typer.echo(guide.DRAWINGS[kind.label].strip("\n"), err=True)
    typer.echo(guide.BEGIN, err=True)
    found: dict[str, Any] = {}
    for name in _ASKED[kind.label]:
        if name in _CENTROID and "com_range.from_front" in found:
            continue
        if name.endswith("_flippers"):
            found |= _flippers(answers, kind, name)
            continue
        if name.endswith("_turn"):
            found |= _turn(answers, kind, name.removesuffix("_turn"), found)
            continue
        value = _one(answers, kind, name, optional=name == "com_from_front")
        if value is not None:
            found[name] = value
            if name == "track.belt" and value == "grousers":
                each = {path: _one(answers, kind, path) for path in _GROUSERS}
                found |= {path: said for path, said in each.items() if said is not None}
        elif name == "com_from_front":
            found |= _range(answers, kind, found)
    answers.end()
    return found


def _flippers(answers: "_Answers", kind: type[Sheet], name: str) -> dict[str, Any]:
    pair = name.replace("_", " ")
    if not _yes(answers, name, guide.question("", f"{pair}, y or n", low="", high="", default="n")):
        return {}
    paths = [f"{name}.{part}" for part in _FLIPPERS]
    each = {path: _one(answers, kind, path, lead=f"{pair}, ") for path in paths}
    return {path: value for path, value in each.items() if value is not None}


def _turn(
    answers: "_Answers", kind: type[Sheet], end: str, found: dict[str, Any]
) -> dict[str, Any]:
    """Whether the way turns on a landing and, where it does, what that turn takes."""
    said = {f"{end}_turn": _one(answers, kind, f"{end}_turn", default="none")}
    if said[f"{end}_turn"] == "none":
        return {}
    if said[f"{end}_turn"] == "unknown":
        return said
    needed = [f"{end}_{each}" for each in _LANDING]
    if "width" not in found:
        needed.insert(0, "width")
    said |= {name: _one(answers, kind, name, needed=True) for name in needed}
    each = {name: _one(answers, kind, name) for name in (f"{end}_{of}" for of in _BEYOND)}
    return said | {name: value for name, value in each.items() if value is not None}


def _yes(answers: "_Answers", name: str, text: str) -> bool:
    from kaidan.errors import InputError

    while True:
        said = answers.next(text, name).strip().lower()
        if said in ("y", "yes", "n", "no", ""):
            return said.startswith("y")
        error = InputError(f"{name}: {said} is neither y nor n")
        if not answers.terminal:
            raise error
        typer.echo(str(error), err=True)


def _range(answers: "_Answers", kind: type[Sheet], found: dict[str, Any]) -> dict[str, Any]:
    """Range of a centroid that nobody measured; Enter takes that of known robots."""
    from kaidan.units import value_of

    typer.echo(guide.UNWEIGHED, err=True)
    length, *radii = (
        value_of(found[f"track.{each}"], "length", option=each)
        for each in ("flat_length", "front_radius", "rear_radius")
    )
    spans = {
        "com_from_front": ("from_front", (0.3 * length, 0.6 * length)),
        "com_height": ("height", (max(radii), 2.4 * max(radii))),
    }
    stated: dict[str, Any] = {}
    for name, (axis, span) in spans.items():
        ends = [
            _one(answers, kind, name, lead=f"{word} ", default=f"{1e3 * each:.0f}mm")
            for word, each in zip(("lowest", "highest"), span, strict=True)
        ]
        stated[f"com_range.{axis}"] = ends
        stated[name] = sum(value_of(each, "length", option=name) for each in ends) / 2
    return stated


def _one(
    answers: "_Answers",
    kind: type[Sheet],
    name: str,
    *,
    lead: str = "",
    default: str | None = None,
    optional: bool = False,
    needed: bool = False,
) -> Any:
    """Answer to one question, put again on a terminal until it has a meaning; None: left out."""
    from kaidan.errors import InputError

    sheet, key = _owner(kind, name)
    field = sheet.model_fields[key]
    unit, low, high = bounds(field)
    extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
    words = words_of(field.annotation)
    needed = needed or ((field.is_required() or key in sheet.requested) and not optional)
    left_out = default if needed or default else "unknown" if unit or words else "none"
    shown = [human(end, unit=unit) if unit else "" for end in (low, high)]
    choice = f" ({' or '.join(words)})" if words else ""
    text = guide.question(
        str(extra.get("symbol", "")),
        f"{lead}{field.description}{choice}",
        low=shown[0],
        high=shown[1],
        default=left_out,
    )
    while True:
        said = answers.next(text, name).strip()
        if not said and (default or not needed):
            return default
        try:
            return _meant(sheet, key, said)
        except InputError as error:
            if not answers.terminal:
                raise
            typer.echo(str(error), err=True)


def _owner(kind: type[Sheet], name: str) -> tuple[type[Sheet], str]:
    """Sheet that has the field of a dotted name, and the field."""
    table, dot, key = name.partition(".")
    if not dot:
        return kind, name
    inner = table_of(kind.model_fields[table])
    assert inner is not None
    return inner, key


def _meant(sheet: type[Sheet], key: str, said: str) -> Any:
    """Answer as it goes into the sheet, once the field takes it."""
    from kaidan.errors import InputError
    from kaidan.units import kind_of_unit, parse

    unit, low, high = bounds(sheet.model_fields[key])
    if unit is None:
        words = words_of(sheet.model_fields[key].annotation)
        if words and said not in words:
            raise InputError(f"{sheet.label}: {key} = {said} is not one of {', '.join(words)}")
        return said
    name = f"{sheet.label}: {key}"
    kind = kind_of_unit(unit)
    value = parse(said, kind or "number", option=name)
    if not low <= value <= high:
        raise InputError(
            f"{name} = {said} is not within {human(low, unit=unit)} to {human(high, unit=unit)}"
        )
    if sheet.model_fields[key].annotation is int:
        return int(value)
    return value if kind is None else said


class _Answers:
    """Lines of standard input, taken one at a time: from a terminal, a pipe or a file."""

    def __init__(self) -> None:
        self.terminal = sys.stdin is not None and sys.stdin.isatty()
        self._lines = iter(sys.stdin.readline, "") if self.terminal else _piped()

    def next(self, prompt: str, name: str) -> str:
        """Answer to a question."""
        from kaidan.errors import InputError

        typer.echo(prompt, nl=not self.terminal, err=True)
        line = next(self._lines, None)
        if line is None:
            raise InputError(guide.ended(name))
        return line

    def end(self) -> None:
        """Refuse what a pipe says beyond the last question: answers that are one off are wrong.

        A pipe that stays open and says nothing has ended; one that never ends has said too much.
        """
        from kaidan.errors import InputError

        lines = () if self.terminal else islice(_until_silent(self._lines), MOST_LEFT)
        more = next((line for line in lines if line.strip()), None)
        if more is not None:
            raise InputError(guide.too_many(more.strip()))


def _until_silent(lines: Iterator[str]) -> Iterator[str]:
    from kaidan.errors import InputError

    with suppress(InputError):
        yield from lines


def _piped() -> Iterator[str]:
    """Lines of a pipe or a file; refused when it stays silent, or says a line without end."""
    import select

    from kaidan.errors import InputError

    if sys.stdin is None:
        return
    try:
        handle = sys.stdin.fileno()
    except (OSError, ValueError):  # replaced by a program that runs this one
        yield from sys.stdin
        return
    if os.name == "nt":  # where a pipe cannot be waited for
        yield from sys.stdin
        return
    said, ended = b"", False
    while said or not ended:
        line, newline, rest = said.partition(b"\n")
        if newline or ended:
            said = rest
            yield line.decode("utf-8", errors="replace")
            continue
        if len(said) > LONGEST_LINE:
            raise InputError(guide.too_many(said[:60].decode("utf-8", errors="replace")))
        ready, _, _ = select.select([handle], [], [], PATIENCE)
        if not ready:
            raise InputError(guide.silent(PATIENCE))
        piece = os.read(handle, 4096)
        said, ended = said + piece, not piece
