"""What a sweep asks: values of any parameters, the dimensions they span, and its chunks.

Cells are counted with the dimensions that drive the robot first, so that cells that share a
traverse lie together. Rows of a dimension that say the same are judged once.
"""

import hashlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from kaidan.arguments import flag
from kaidan.errors import InputError, shown
from kaidan.modes import CONTACT
from kaidan.spelling import BEST
from kaidan.sweeps.parameters import UNDRIVEN, parameter, settled
from kaidan.terrain.profile import Profile

MOST_CELLS = 10_000_000
"""Largest sweep of cells that are judged one by one."""
CHUNKS = 64
"""Chunks of a sweep at least, so that its workers share it evenly and a bar moves."""
STATED, SEARCHED = 10_000, 100
"""Cells of a chunk at most, postures stated or searched: about a minute of the compiled kernel."""
_RANGED = ("friction", "theta_d", "theta_M")
"""Parameters whose tuple of two numbers is a range."""

Counts = NDArray[np.int64]


class Along(NamedTuple):
    """Values along a dimension that several parameters may share, as columns of a table do."""

    dim: str
    values: Sequence[Any]


class Given(NamedTuple):
    """Values of a parameter."""

    dims: tuple[str, ...]
    values: tuple[Any, ...]
    """In C order over `dims`."""


@dataclass(frozen=True)
class Chunk:
    """Cells that are judged in one go; complete in itself, so that it can be sent away."""

    digest: str
    """Of the plan."""
    first: int
    """Number of its first cell."""
    screen: bool
    base: Mapping[str, Any]
    """Values that all cells share."""
    distinct: Mapping[str, tuple[Any, ...]]
    """Different values of each parameter that varies."""
    codes: Mapping[str, Counts]
    """Which of them each cell has."""
    cells: int
    of: int
    """Cells of the whole plan: so much work is expected."""

    def values(self) -> Iterator[dict[str, Any]]:
        """Values of each cell by the names of parameters."""
        for cell in range(self.cells):
            own = {name: self.distinct[name][code[cell]] for name, code in self.codes.items()}
            yield {**self.base, **own}


@dataclass(frozen=True)
class Plan:
    """What a sweep asks, cell by cell."""

    base: Mapping[str, Any]
    """Values that do not vary."""
    parameters: Mapping[str, Given]
    """Values that do."""
    labels: Mapping[str, tuple[Any, ...]]
    """Labels along each dimension, in the order of the result."""
    screen: bool = False
    """Whether cells that the closed form alone excludes from a GO are not judged further."""

    @classmethod
    def of(cls, values: Mapping[str, Any], *, screen: bool = False) -> "Plan":
        """Plan of values by the names of parameters.

        Parameters
        ----------
        values : mapping of str to object
            A list, an array, or a labelled array varies; anything else holds for all cells.
        screen : bool
            See the field.

        Raises
        ------
        InputError
            An unknown parameter, a dimension with two lengths, or too many cells.
        """
        flag("screen", screen)
        base: dict[str, Any] = {}
        varied: dict[str, Given] = {}
        labels: dict[str, tuple[Any, ...]] = {}
        for name, value in values.items():
            parameter(name)
            found = _axes(name, value)
            if found is None:
                base[name] = settled(name, _plain(value))
                continue
            given, own = found
            varied[name] = given._replace(values=tuple(settled(name, v) for v in given.values))
            for dim, each in own.items():
                before = labels.get(dim, each)
                if before != each and (len(before) != len(each) or not _plain_rows(before, each)):
                    raise InputError(f"{name}: {dim} has other labels or another length before")
                labels[dim] = each if dim == name or dim not in labels else before
        plan = cls(base, varied, labels, screen)
        if not len(plan):
            raise InputError("a parameter has no value: nothing to sweep")
        if len(plan) > MOST_CELLS:
            raise InputError(f"{len(plan):,} cells are more than {MOST_CELLS:,}: sweep in parts")
        return plan

    def __len__(self) -> int:
        return math.prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the dimensions, in the order of `labels`."""
        return tuple(len(each) for each in self.labels.values())

    @cached_property
    def order(self) -> tuple[str, ...]:
        """Dimensions in the order in which cells are counted: what drives the robot first."""
        driving = {dim for name, given in self.parameters.items() for dim in given.dims
                   if name not in UNDRIVEN}  # fmt: skip
        return tuple(sorted(self.labels, key=lambda dim: dim not in driving))

    @cached_property
    def rows(self) -> Mapping[str, tuple[Counts, Counts]]:
        """Of each dimension the rows that differ, and to which of them each row belongs."""
        found = {}
        for dim, labels in self.labels.items():
            on = [given for given in self.parameters.values() if dim in given.dims]
            count = len(labels)
            if any(given.dims != (dim,) for given in on):
                found[dim] = np.arange(count), np.arange(count)
                continue
            texts = [[_canonical(value) for value in given.values] for given in on]
            seen: dict[tuple[str, ...], int] = {}
            of_row = np.array([seen.setdefault(row, len(seen)) for row in zip(*texts, strict=True)])
            found[dim] = np.unique(of_row, return_index=True)[1], of_row
        return found

    @property
    def different(self) -> int:
        """Cells that differ: so many are judged."""
        return math.prod(len(first) for first, _ in self.rows.values())

    @cached_property
    def digest(self) -> str:
        """What tells the plan from others."""
        whole = {
            "base": {name: _canonical(value) for name, value in sorted(self.base.items())},
            "varied": {
                name: [given.dims, [_canonical(value) for value in given.values]]
                for name, given in sorted(self.parameters.items())
            },
            "dims": [[dim, len(self.labels[dim])] for dim in self.order],
            "screen": self.screen,
        }
        return hashlib.sha256(json.dumps(whole).encode()).hexdigest()[:32]

    @property
    def chunk_size(self) -> int:
        """Cells of a chunk: the same for the same plan, so that it can be resumed."""
        flippers = self._all("flippers")
        searched = not flippers or any(
            each is None or (isinstance(each, str) and each.strip() == BEST) for each in flippers
        )
        plans = searched and CONTACT.name in (self._all("model") or (CONTACT.name,))
        most = SEARCHED if plans else STATED
        size = min(most, max(1, math.ceil(self.different / CHUNKS)))
        alike = math.prod(
            len(self.rows[dim][0])
            for dim in self.order
            if all(name in UNDRIVEN for name, given in self.parameters.items() if dim in given.dims)
        )
        whole = math.ceil(size / alike) * alike
        return whole if whole <= most else size

    def _all(self, name: str) -> tuple[Any, ...]:
        """Values that a parameter has; none where nobody gives any."""
        if name in self.base:
            return (self.base[name],)
        return self.parameters[name].values if name in self.parameters else ()

    @property
    def chunks(self) -> range:
        """Numbers of the first cells of the chunks."""
        return range(0, self.different, self.chunk_size)

    def specs(self) -> Iterator[Chunk]:
        """Chunks, one after the other."""
        for first in self.chunks:
            yield self.chunk(first, min(first + self.chunk_size, self.different))

    def chunk(self, first: int, stop: int) -> Chunk:
        """Different cells from a number to another."""
        shape = [len(self.rows[dim][0]) for dim in self.order]
        at = np.unravel_index(np.arange(first, stop), shape) if shape else ()
        row = {dim: self.rows[dim][0][each] for dim, each in zip(self.order, at, strict=True)}
        distinct, codes = {}, {}
        for name, given in self.parameters.items():
            lengths = [len(self.labels[dim]) for dim in given.dims]
            place = np.ravel_multi_index([row[dim] for dim in given.dims], lengths)
            which, code = np.unique(place, return_inverse=True)
            distinct[name] = tuple(given.values[k] for k in which)
            codes[name] = code
        return Chunk(
            self.digest,
            first,
            self.screen,
            self.base,
            distinct,
            codes,
            stop - first,
            self.different,
        )

    def spread(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values of the different cells as an array over `labels`."""
        if not self.labels:
            return values.reshape(())
        array = values.reshape([len(self.rows[dim][0]) for dim in self.order])
        for axis, dim in enumerate(self.order):
            array = array.take(self.rows[dim][1], axis=axis)
        return np.ascontiguousarray(array.transpose([self.order.index(dim) for dim in self.labels]))


def _plain_rows(one: tuple[Any, ...], other: tuple[Any, ...]) -> bool:
    """Whether one of two dimensions as long as each other has no labels but numbers of rows."""
    return tuple(range(len(one))) in (one, other)


def _axes(name: str, value: Any) -> tuple[Given, dict[str, tuple[Any, ...]]] | None:
    """Values of a parameter that varies, and the labels of its dimensions; None: it does not."""
    if isinstance(value, Along):
        values = tuple(map(_plain, value.values))
        rows = _labels(name, values) if name == value.dim else tuple(range(len(values)))
        return Given((value.dim,), values), {value.dim: rows}
    if hasattr(value, "dims") and hasattr(value, "coords"):  # a labelled array of xarray
        if not value.dims:
            return None
        own = {
            str(dim): tuple(np.asarray(value.coords[dim]).tolist())
            if dim in value.coords
            else tuple(range(size))
            for dim, size in value.sizes.items()
        }
        dims = tuple(map(str, value.dims))
        return Given(dims, tuple(np.asarray(value).ravel().tolist())), own
    if isinstance(value, np.ndarray):
        if value.ndim > 1:
            raise InputError(f"{name} has {value.ndim} dimensions; name them in a DataArray")
        value = value.tolist() if value.ndim else value
    if not isinstance(value, list | range):
        return None
    values = tuple(map(_plain, value))
    return Given((name,), values), {name: _labels(name, values)}


def _labels(name: str, values: Sequence[Any]) -> tuple[Any, ...]:
    """What a dimension's rows are called; numbers where none is doubtful."""
    each = tuple(_label(name, value) for value in values)
    return each if len(set(each)) == len(each) else tuple(range(len(each)))


def _label(name: str, value: Any) -> Any:
    if isinstance(value, float | int):
        return value
    if name in _RANGED and isinstance(value, tuple):
        return "..".join(f"{end:g}" for end in value)
    if isinstance(value, tuple):
        return "+".join(str(_label(name, each)) for each in value)
    called = getattr(value, "name", value)
    return called if isinstance(called, str) else shown(called)


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) or (
        isinstance(value, np.ndarray) and value.ndim == 0) else value  # fmt: skip


def _canonical(value: Any) -> str:
    """Text that is the same for what says the same."""
    if isinstance(value, BaseModel):
        return value.model_dump_json()
    if isinstance(value, Profile):
        return json.dumps(value.to_dict())
    try:
        if isinstance(value, list | tuple):
            return "[" + ", ".join(map(_canonical, value)) + "]"
        return repr(value)
    except (RecursionError, ValueError, RuntimeError):  # nested or written without end
        raise InputError(f"{shown(value)} is no value of a parameter") from None
