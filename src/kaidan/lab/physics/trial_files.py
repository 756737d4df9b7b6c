"""A trial as files: its log as CSV or Parquet, its film and its picture."""

import io
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from kaidan import files
from kaidan.errors import InputError, MissingExtraError, needed, short, shown
from kaidan.films import film_bytes
from kaidan.physics.outcome import TrialLog

LOGS = (".csv", ".parquet")


def log_writer(path: Path) -> Callable[[TrialLog], bytes]:
    """What makes the bytes of a log with that suffix."""
    suffix = path.suffix.lower()
    if suffix not in LOGS:
        found = f"unknown suffix {shown(path.suffix)}" if path.suffix else "no suffix"
        raise InputError(f"log {short(path)!r}: {found}; known: {', '.join(LOGS)}")
    if suffix == ".csv":
        return lambda log: files.csv_text(log.table()).encode("ascii")
    if find_spec("pyarrow") is None:
        raise MissingExtraError("a log as .parquet", "physics")
    return _parquet


def trial_film(log: TrialLog, suffix: str) -> bytes:
    """Film of a trial, drawn by MuJoCo; `suffix` as `kaidan.films.film_format` gives it."""
    from kaidan.lab.physics.render import frames

    return film_bytes(frames(log), suffix, what=f"film of a trial ({log.result.outcome.value})")


def picture_bytes(log: TrialLog) -> bytes:
    """Picture of the trial as PNG, drawn by MuJoCo."""
    imsave = needed("matplotlib.image", "a picture of a trial", "figures").imsave
    from kaidan.lab.physics.render import picture

    buffer = io.BytesIO()
    imsave(buffer, picture(log), format="png", metadata={"Software": "kaidan"})
    return buffer.getvalue()


def _parquet(log: TrialLog) -> bytes:
    arrow: Any = import_module("pyarrow")
    parquet: Any = import_module("pyarrow.parquet")
    about = {b"kaidan.trial": log.result.to_json().encode("ascii")}
    buffer = io.BytesIO()
    parquet.write_table(arrow.table(log.table()).replace_schema_metadata(about), buffer)
    return buffer.getvalue()
