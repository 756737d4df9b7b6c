"""A progress bar for what takes seconds: on a terminal's standard error, and to who follows it."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

T = TypeVar("T")
Follower = Callable[[str, int, int], None]
"""Called with what is counted, how many are done, and how many there are."""
_followers: list[Follower] = []


@contextmanager
def followed(by: Follower) -> Iterator[None]:
    """Let somebody follow how everything goes that this process does."""
    _followers.append(by)
    try:
        yield
    finally:
        _followers.remove(by)


def tell(what: str, done: int, of: int) -> None:
    """Say to those who follow how far something is."""
    for each in _followers:
        each(what, done, of)


def progress(items: Sequence[T], what: str) -> Iterator[T]:
    """Items one by one, with a bar while they last."""
    from rich.console import Console
    from rich.progress import track

    console = Console(stderr=True)
    for done, item in enumerate(
        track(
            items,
            description=what,
            console=console,
            transient=True,
            disable=not console.is_terminal,
        )
    ):
        tell(what, done, len(items))
        yield item


@contextmanager
def working(what: str) -> Iterator[None]:
    """What is being done, for as long as it takes."""
    tell(what, 0, 0)
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(what):
        yield
