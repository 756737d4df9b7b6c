"""What a sweep found: arrays with labels, as columns, a Dataset, and files."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, needed, short, shown
from kaidan.files import csv_text, whole_file
from kaidan.sweeps.cells import FIGURES, MODES, TEXTS, VERDICTS
from kaidan.sweeps.parameters import parameter
from kaidan.sweeps.plan import Plan

if TYPE_CHECKING:
    import xarray

TABLES = (".parquet", ".csv", ".zarr")
"""Suffixes of tables that can be written."""
_ALWAYS = ("verdict", "governs", "margin_deg", "margin_best_deg", "required_friction")
_MEANINGS = {
    "margin_deg": ("deg", "smallest margin of slope in the worst case, at the accepted risk"),
    "margin_best_deg": ("deg", "the same in the best case"),
    "failure_probability": ("1", "share of samples that fail by any slope; NaN: all is exact"),
    "required_friction": ("1", "static friction below which it slips somewhere"),
    "step": ("1", "nosing at which what governs shows; -1: none"),
}


@dataclass(frozen=True)
class Swept:
    """Verdicts and margins of all cells of a plan."""

    plan: Plan
    variables: Mapping[str, NDArray[Any]]
    """Arrays over the plan's dimensions; `verdict` holds codes, texts are objects."""

    def __len__(self) -> int:
        return len(self.plan)

    @cached_property
    def governs(self) -> tuple[str, ...]:
        """What governs somewhere, sorted."""
        return tuple(sorted(set(self.variables["governs"].ravel().tolist())))

    def count(self, verdict: str) -> int:
        """Cells with a verdict, a word of ``kaidan.sweeps.cells.VERDICTS``."""
        return int(np.count_nonzero(self.variables["verdict"] == VERDICTS.index(verdict)))

    def columns(self) -> dict[str, Any]:
        """Columns of a table with one line a cell: what varies, then what was found."""
        found: dict[str, Any] = {}
        grid = np.indices(self.plan.shape)
        for at, (dim, labels) in zip(grid, self.plan.labels.items(), strict=True):
            found[dim] = np.array(labels, dtype=object)[at.ravel()].tolist()
        for name, given in self.plan.parameters.items():
            if name not in found:
                found[name] = [_text(value) for value in self._each(name, given.dims)]
        words = np.array(VERDICTS, dtype=object)
        for name, array in self._known():
            flat = array.ravel()
            found[name] = (words[flat] if name == "verdict" else flat).tolist()
        return found

    def dataset(self) -> "xarray.Dataset":
        """The same as a Dataset of xarray: codes with their meanings, units in the attributes.

        Where flippers or facing vary, those of the answer are `flippers_found`, `facing_found`.

        Raises
        ------
        MissingExtraError
            xarray is not installed.
        """
        xr = needed("xarray", "a labelled Dataset", "sweeps")
        dims = tuple(self.plan.labels)
        variables: dict[str, Any] = {}
        for name, array in self._known():
            if name == "verdict":
                variables[name] = (dims, array, _flags(VERDICTS))
            elif name == "governs":
                codes = np.searchsorted(np.array(self.governs, dtype=str), array.astype(str))
                variables[name] = (dims, codes.astype(np.int16), _flags(self.governs))
            elif array.dtype == object:  # beside what was asked, where that varies
                own = f"{name}_found" if name in self.plan.parameters else name
                variables[own] = (dims, array.astype(str))
            else:
                unit, meaning = _MEANINGS.get(name, ("", f"margin of {name}"))
                unit = unit or name.rpartition("_")[2]
                variables[name] = (dims, array, {"units": unit, "long_name": meaning})
        coords: dict[str, Any] = {}
        for dim, labels in self.plan.labels.items():
            unit = parameter(dim).unit if dim in self.plan.parameters else ""
            coords[dim] = (dim, _labels(labels), {"units": unit} if unit else {})
        for name, given in self.plan.parameters.items():
            if name not in coords:
                coords[name] = (dims, np.array(
                    [_text(value) for value in self._each(name, given.dims)]
                ).reshape(self.plan.shape))  # fmt: skip
        fixed = {name: _text(value) for name, value in self.plan.base.items() if value is not None}
        made: xarray.Dataset = xr.Dataset(variables, coords=coords, attrs=fixed)
        return made

    def write(self, path: Path) -> None:
        """Write a table: .parquet or .csv with one line a cell, .zarr as the Dataset.

        Raises
        ------
        InputError
            Another suffix, or a file that cannot be written.
        MissingExtraError
            What writes it is not installed.
        """
        suffix = table_format(path)
        if suffix == ".zarr":
            needed("zarr", "a table in Zarr", "sweeps")
            try:
                self.dataset().to_zarr(path, mode="w", zarr_format=2)  # its texts are stable
            except OSError as error:
                raise InputError(f"{short(path)}: cannot be written: {error.strerror}") from None
            return
        with whole_file(path) as file:
            if suffix == ".csv":
                file.write(csv_text(self.columns()).encode())
                return
            table = needed("pyarrow", "a table in Parquet", "sweeps").table(self.columns())
            needed("pyarrow.parquet", "a table in Parquet", "sweeps").write_table(
                table, file, compression="zstd"
            )

    def _known(self) -> Iterator[tuple[str, NDArray[Any]]]:
        """Variables that say something anywhere."""
        for name in ("verdict", *TEXTS, "step", *FIGURES, *MODES.values()):
            array = self.variables[name]
            empty = array == "" if name in TEXTS else (
                np.isnan(array) if array.dtype.kind == "f" else array < 0)  # fmt: skip
            if name in _ALWAYS or not empty.all():
                yield name, array

    def _each(self, name: str, dims: tuple[str, ...]) -> Iterator[Any]:
        """Values of a parameter, cell by cell."""
        at = np.indices(self.plan.shape)
        own = [at[list(self.plan.labels).index(dim)] for dim in dims]
        lengths = [len(self.plan.labels[dim]) for dim in dims]
        values = self.plan.parameters[name].values
        for place in np.ravel_multi_index(own, lengths).ravel():
            yield values[place]


def table_format(path: Path) -> str:
    """Suffix of a table, refused if none can be written of it."""
    suffix = path.suffix.lower()
    if suffix not in TABLES:
        found = f"unknown suffix {shown(path.suffix)}" if path.suffix else "no suffix"
        raise InputError(f"table {short(path)!r}: {found}; known: {', '.join(TABLES)}")
    return suffix


def _flags(words: tuple[str, ...]) -> dict[str, Any]:
    return {"flag_values": list(range(len(words))), "flag_meanings": " ".join(words)}


def _labels(labels: tuple[Any, ...]) -> NDArray[Any]:
    return np.array(labels if all(isinstance(each, float | int) for each in labels)
                    else [str(each) for each in labels])  # fmt: skip


def _text(value: Any) -> Any:
    """Value of a parameter as it stands in a table."""
    if isinstance(value, float | int | str):
        return value
    if isinstance(value, list | tuple):
        return "+".join(str(_text(each)) for each in value)
    return str(getattr(value, "name", value))
