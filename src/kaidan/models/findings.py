"""What a model finds: a margin for every failure mode it knows, with its samples and its place."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from typing import Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Part
from kaidan.modes import SLIDES_DOWN, SLIDES_UP, FailureMode, IfFails, Phase

Array = NDArray[np.float64]
T = TypeVar("T")


class Later(Sequence[T], Generic[T]):
    """What is worked out when it is first read: a verdict needs neither figures nor notes."""

    def __init__(self, made: Callable[[], Sequence[T]]) -> None:
        self._made = made

    @cached_property
    def _each(self) -> Sequence[T]:
        return self._made()

    @overload
    def __getitem__(self, at: int) -> T: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[T]: ...
    def __getitem__(self, at: int | slice) -> T | Sequence[T]:
        """Some of it."""
        return self._each[at]

    def __len__(self) -> int:
        return len(self._each)


@dataclass(frozen=True, kw_only=True)
class Finding:
    """Margin of one failure mode, in its unit, positive when safe."""

    mode: FailureMode
    worst: Array
    """Margin of each sample with every range at its unfavourable end, shape (samples,); one sample
    where every input is exact. NaN: not known. Infinite: it only holds or does not."""
    best: Array
    """The same with every range at its favourable end."""
    instead: IfFails | None = None
    """Verdicts where it fails, of a model that knows more or less than `FailureMode.if_fails`."""
    phase: Phase | None = None
    """Part of the traverse in which the margin is smallest."""
    step: int | None = None
    """Nosing at which, counted from the bottom."""
    model: str
    """Model that found it."""

    @classmethod
    def certain(cls, mode: FailureMode, margin: float, *, model: str, **others: Any) -> "Finding":
        """Finding whose margin depends on nothing uncertain."""
        both = np.array([margin])
        return cls(mode=mode, worst=both, best=both, model=model, **others)

    @property
    def if_fails(self) -> IfFails:
        """Verdict where it fails."""
        return self.instead or self.mode.if_fails

    def verdicts(self) -> NDArray[np.int64]:
        """Verdict of each sample on its own, by its rank, shape (samples,)."""
        row = self.if_fails
        unknown = np.isnan(self.worst) & np.isnan(self.best)
        known = np.where(self.best <= 0, row.best.rank, (self.worst <= 0) * row.worst.rank)
        return np.asarray(np.where(unknown, row.unknown.rank, known))

    def margin(self, risk: float, *, best: bool = False) -> float:
        """Margin at an accepted risk, in the worst or in the best case; NaN: not known."""
        return at_risk(self.best if best else self.worst, risk)

    def fails(self, *, best: bool = False) -> NDArray[np.bool_]:
        """Samples that fail; what is not known does not."""
        return np.asarray((self.best if best else self.worst) <= 0)


@dataclass(frozen=True, kw_only=True)
class Findings:
    """What a model finds of a question."""

    model: str
    each: tuple[Finding, ...] = ()
    outside: str = ""
    """Why the model does not apply; empty if it does."""
    required_friction: float = math.nan
    """Static friction below which the robot slips somewhere [1]; infinite: none is enough."""
    figures: Sequence[Part] = ()
    """The models' own figures."""
    notes: Sequence[str] = ()
    """What the reader must know of this answer."""
    basis: Any = None
    """What it was found on, for a changed question that shares it."""

    def of(self, mode: FailureMode) -> Finding | None:
        """Finding of a mode; None where the model has none."""
        return next((each for each in self.each if each.mode is mode), None)


ROUNDING = 1e-9
"""Margin of slope that is rounding [rad]: the same friction as is required is not enough."""


def without_rounding(margin: Array) -> Array:
    """Margins of slope, those that are rounding as zero [rad]."""
    return np.where(np.abs(margin) < ROUNDING, 0.0, margin)


_ALIKE = 1e-3
"""Share of a required friction to which it is found [1]."""


def hardest(frictions: Iterable[float]) -> int:
    """Which of several required frictions is the highest, of those alike the first.

    A phase may begin with the pose that ends another. What is not known (NaN) counts last.
    """
    values = np.fromiter(frictions, dtype=float)
    return int(np.argmax(values >= (1.0 - _ALIKE) * np.fmax.reduce(values)))


def sliding_where(most: Sequence[Finding], one: Finding) -> Finding:
    """Finding of sliding, put where most friction is required; of anything else as it is.

    most: of the part or the place that requires most.
    """
    slides = (SLIDES_DOWN, SLIDES_UP)
    at = next((each for each in most if each.mode in slides), None)
    if at is None or one.mode not in slides:
        return one
    return replace(one, phase=at.phase, step=at.step)


def at_risk(values: Array, risk: float) -> float:
    """Value that all but a share `risk` of the samples exceed; NaN: none is known.

    It is positive just where the share of samples that are zero or negative is at most `risk`.
    """
    if len(values) == 1:
        return float(values[0])
    return float(each_at_risk(values, risk))


def each_at_risk(values: Array, risk: float) -> Array:
    """`at_risk` of several quantities: samples along the last axis."""
    if values.shape[-1] == 1:
        return values[..., 0]
    known = ~np.isnan(values)
    ordered = np.sort(np.where(known, values, -np.inf), axis=-1)
    found = ordered[..., int(risk * values.shape[-1])]
    return np.where(known.any(axis=-1), found, math.nan)


def smallest(samples: Iterable[Array]) -> Array:
    """Smallest value that is known, of each sample; NaN where none is."""
    return np.asarray(reduce(np.fmin, samples))
