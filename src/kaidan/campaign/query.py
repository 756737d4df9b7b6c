"""What a store holds, finished or being written: rows, figures of its state, one file of it all."""

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, Any, NamedTuple

from kaidan.campaign.id_set import Known
from kaidan.campaign.lock import holder
from kaidan.campaign.store_files import (
    about_store,
    arrow,
    batches_of,
    journal_rows,
    journals_of,
    parts_of,
    refusal,
    schema_of,
)
from kaidan.errors import InputError, short, shown
from kaidan.files import cell_of, whole_file

EXPORTS = (".parquet", ".csv")


def read_batches(folder: str | Path, columns: Sequence[str] | None = None) -> Iterator[Any]:
    """Record batches of a store, journal included, each trial once.

    Parameters
    ----------
    folder : str or Path
        Store; it may be written meanwhile.
    columns : sequence of str, optional
        Columns to read; all without.

    Raises
    ------
    InputError
        No store, or a damaged one.
    """
    pa, folder = arrow(), Path(folder)
    about = about_store(folder)
    assert about is not None
    schema = schema_of(about["columns"])
    names = list(schema.names) if columns is None else list(columns)
    journals = {}
    # before the parts: a journal may become one meanwhile
    for path, number in journals_of(folder).items():
        try:
            journals[number] = journal_rows(path)
        except FileNotFoundError:
            continue
        except OSError as error:
            raise refusal(folder, error) from None
    seen = Known()
    for part, number in parts_of(folder).items():
        journals.pop(number, None)
        for batch in batches_of(part, list(dict.fromkeys(("id", *names))), schema):
            yield _first_ones(batch, seen).select(names)
    for rows in journals.values():
        if rows:
            batch = pa.RecordBatch.from_pylist(rows, schema=schema)
            yield _first_ones(batch, seen).select(names)


def _first_ones(batch: Any, seen: Known) -> Any:
    """Rows whose trial has not come before."""
    new = [seen.add(identity) for identity in batch.column("id").to_pylist()]
    return batch if all(new) else batch.filter(arrow().array(new))


def read_table(folder: str | Path, columns: Sequence[str] | None = None) -> Any:
    """Store as one table of pyarrow, each trial once.

    Raises
    ------
    InputError
        No store, or a damaged one.
    """
    pa, folder = arrow(), Path(folder)
    batches = list(read_batches(folder, columns))
    about = about_store(folder)
    assert about is not None
    schema = schema_of(about["columns"])
    if columns is not None:
        schema = pa.schema([schema.field(name) for name in columns])
    return pa.Table.from_batches(batches, schema=schema)


class State(NamedTuple):
    """State of a store."""

    work: str
    plans: tuple[dict[str, Any], ...]
    trials: int
    outcomes: dict[str, int]
    versions: dict[str, int]
    """Trials by version of what computed them."""
    writer: str | None
    """Who is writing it now."""


def state_of(folder: str | Path) -> State:
    """State of a store, finished or being written.

    Raises
    ------
    InputError
        No store, or a damaged one.
    """
    folder = Path(folder)
    about = about_store(folder)
    assert about is not None
    outcomes: Counter[str] = Counter()
    versions: Counter[str] = Counter()
    for batch in read_batches(folder, ["outcome", "version"]):
        outcomes.update(batch.column("outcome").to_pylist())
        versions.update(batch.column("version").to_pylist())
    return State(
        work=about["work"],
        plans=tuple(about["plans"]),
        trials=sum(outcomes.values()),
        outcomes=dict(sorted(outcomes.items())),
        versions=dict(sorted(versions.items())),
        writer=holder(folder),
    )


def export(folder: str | Path, file: str | Path) -> int:
    """Write a store as one file, a batch at a time; say how many trials it has.

    Raises
    ------
    InputError
        Another suffix than .parquet or .csv, no store, or a file that cannot be written.
    """
    folder, file = Path(folder), Path(file)
    suffix = file.suffix.lower()
    if suffix not in EXPORTS:
        found = f"unknown suffix {shown(file.suffix)}" if file.suffix else "no suffix"
        raise InputError(f"export {short(file)!r}: {found}; known: {', '.join(EXPORTS)}")
    about = about_store(folder)
    assert about is not None
    schema = schema_of(about["columns"])
    count = 0
    with whole_file(file) as stream, _writer(suffix, stream, schema) as writer:
        for batch in read_batches(folder):
            writer.write_batch(_as_cells(batch) if suffix == ".csv" else batch)
            count += batch.num_rows
    return count


def _as_cells(batch: Any) -> Any:
    """Batch whose texts no spreadsheet takes for formulas."""
    pa = arrow("pyarrow")
    columns = [
        pa.array(map(cell_of, column.to_pylist()), column.type)
        if pa.types.is_string(column.type)
        else column
        for column in batch.columns
    ]
    return pa.record_batch(columns, schema=batch.schema)


def _writer(suffix: str, stream: IO[bytes], schema: Any) -> Any:
    if suffix == ".csv":
        return arrow("pyarrow.csv").CSVWriter(stream, schema)
    return arrow("pyarrow.parquet").ParquetWriter(stream, schema, write_page_checksum=True)
