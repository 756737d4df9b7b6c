"""Calls of the kernel as bytes, which `replay.c` makes again, and a number for each.

``python native/recording.py COUNT FILE`` asks everything once and then drives so many random robots
over random terrains, on the kernel that ``KAIDAN_KERNEL`` names. It prints the number of each call
and writes the calls.
"""

import sys
from functools import cache
from pathlib import Path
from typing import Any, get_args, get_type_hints

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from kaidan.contact import switch
from kaidan.contact.door import dtype_of
from kaidan.contact.memory import CODES
from kernel_calls import ask_everything, asked_of, random_way

#: Of the number of a call, by which it grows from word to word.
FACTOR = 0x100000001B3
WORD = np.dtype(np.uint64)


def words(given: Any, kind: Any) -> np.ndarray:
    """What is told of a value: a number, a table with its rows, or a tuple of these."""
    if kind in CODES:
        return columns(np.array([given], dtype_of(kind)))[:, 0]
    if isinstance(given, np.ndarray):
        return np.concatenate([np.array([len(given)], WORD), columns(given).ravel()])
    parts = [words(each, part) for each, part in zip(given, parts_of(kind), strict=False)]
    return np.concatenate([np.empty(0, WORD), *parts])


def columns(rows: np.ndarray) -> np.ndarray:
    """Each number of some rows as a word of 8 bytes; NaN is NaN."""
    if rows.dtype.names:
        return np.concatenate([columns(rows[name]) for name in rows.dtype.names], axis=1)
    if rows.dtype.kind == "f":
        return np.where(np.isnan(rows), np.nan, rows).view(WORD)[:, None]
    return rows.astype(WORD)[:, None]


def parts_of(kind: Any) -> tuple[Any, ...]:
    """Types of what a tuple holds that is given for a type or answered."""
    return get_args(kind) or tuple(get_type_hints(kind).values())


def told(found: np.ndarray) -> int:
    """Number of a call."""
    return int((found * powers(len(found))).sum(dtype=WORD))


@cache
def powers(count: int) -> np.ndarray:
    """By what each word is multiplied in the end."""
    factors = np.full(count, FACTOR, WORD)
    factors[:1] = 1
    return factors.cumprod(dtype=WORD)[::-1]


def written(given: Any, kind: Any) -> bytes:
    """A value as `replay.c` reads it."""
    if kind in CODES:
        return columns(np.array([given], dtype_of(kind))).tobytes()
    if not isinstance(given, np.ndarray):
        return b"".join(map(written, given, parts_of(kind)))
    plain = given.view(np.uint8).reshape(len(given), given.itemsize)
    other = np.flatnonzero((plain != plain[-1:]).any(axis=1))
    follow = min(other[-1] + 2 if len(other) else 1, len(given))
    rows = given[:follow].tobytes()
    return np.array([len(given), follow], WORD).tobytes() + rows + bytes(-len(rows) % 8)


class Recorder:
    """A kernel of which each call is written and told."""

    def __init__(self, kernel: Any, file: Any) -> None:
        self.kernel, self.file = kernel, file
        self.python = {name: each.__wrapped__ for name, each in vars(switch._plain()).items()}
        self.numbers = {name: k for k, name in enumerate(self.python)}

    def __getattr__(self, name: str) -> Any:
        function, hints = getattr(self.kernel, name), get_type_hints(self.python[name])
        answered = hints.pop("return")

        def call(*given: Any) -> Any:
            number = np.array([self.numbers[name]], WORD).tobytes()
            self.file.write(number + b"".join(map(written, given, hints.values())))
            answer = function(*given)
            found = [words(each, kind) for each, kind in zip(given, hints.values(), strict=True)]
            found += [words(answer, answered)] if answer is not None else []
            sys.stdout.write(f"{told(np.concatenate(found)):016x}\n")
            return answer

        return call


def main(count: str, file: str) -> None:
    """Record."""
    with Path(file).open("wb") as calls:
        recorder = Recorder(switch.kernel(), calls)
        switch._native, switch._plain = lambda: (recorder, ""), lambda: recorder
        ask_everything()
        for seed in range(int(count)):
            asked_of(*random_way(seed), seed)


if __name__ == "__main__":
    main(*sys.argv[1:])
