"""A trial as files: its log as CSV or Parquet, its film and its picture."""

import io
import tempfile
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from kaidan.errors import InputError, MissingExtraError
from kaidan.physics import TrialResult
from kaidan.report import files

LOGS = (".csv", ".parquet")
FILMS = (".mp4", ".gif")


def log_writer(path: Path) -> Callable[[TrialResult], bytes]:
    """What makes the bytes of a log with that suffix.

    Raises
    ------
    InputError
        Another suffix than .csv or .parquet.
    MissingExtraError
        pyarrow is not installed (.parquet only).
    """
    suffix = _suffix(path, "log", LOGS)
    if suffix == ".csv":
        return lambda result: files.csv_text(_table(result)).encode("ascii")
    if find_spec("pyarrow") is None:
        raise MissingExtraError("a log as .parquet", "physics")
    return _parquet


def film_writer(path: Path) -> Callable[[TrialResult], bytes]:
    """What makes the bytes of a film with that suffix, drawn by MuJoCo.

    Raises
    ------
    InputError
        Another suffix than .mp4 or .gif.
    MissingExtraError
        imageio or imageio-ffmpeg is not installed (.mp4 only).
    """
    suffix = _suffix(path, "video", FILMS)
    if suffix == ".gif":
        return _gif
    if find_spec("imageio") is None or find_spec("imageio_ffmpeg") is None:
        raise MissingExtraError("a film as .mp4", "video")
    return _mp4


def picture_bytes(result: TrialResult) -> bytes:
    """Picture of the trial as PNG, drawn by MuJoCo."""
    from matplotlib.image import imsave

    from kaidan.physics.picture import picture

    buffer = io.BytesIO()
    imsave(buffer, picture(result), format="png", metadata={"Software": "kaidan"})
    return buffer.getvalue()


def _suffix(path: Path, what: str, known: tuple[str, ...]) -> str:
    suffix = path.suffix.lower()
    if suffix not in known:
        found = f"unknown suffix {path.suffix!r}" if path.suffix else "no suffix"
        raise InputError(f"{what} {str(path)!r}: {found}; known: {', '.join(known)}")
    return suffix


def _table(result: TrialResult) -> dict[str, Any]:
    return {} if result.log is None else dict(result.log.table())


def _parquet(result: TrialResult) -> bytes:
    arrow: Any = import_module("pyarrow")
    parquet: Any = import_module("pyarrow.parquet")
    about = {b"kaidan.trial": files.json_text(result.as_dict()).encode("ascii")}
    buffer = io.BytesIO()
    parquet.write_table(arrow.table(_table(result)).replace_schema_metadata(about), buffer)
    return buffer.getvalue()


def _mp4(result: TrialResult) -> bytes:
    from kaidan.physics.picture import FRAMES_PER_SECOND, frames

    imageio: Any = import_module("imageio.v2")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "film.mp4"
        with imageio.get_writer(
            file, fps=FRAMES_PER_SECOND, codec="libx264", quality=7, macro_block_size=16
        ) as film:
            for image in frames(result):
                film.append_data(image)
        return file.read_bytes()


def _gif(result: TrialResult) -> bytes:
    from PIL import Image

    from kaidan.physics.picture import FRAMES_PER_SECOND, frames

    images = [Image.fromarray(image).resize((480, 272)) for image in frames(result)]
    if not images:
        raise InputError(f"video: the trial has no frame (outcome: {result.outcome.value})")
    buffer = io.BytesIO()
    images[0].save(
        buffer, format="GIF", save_all=True, append_images=images[1:],
        duration=1000 // FRAMES_PER_SECOND, loop=0,
    )  # fmt: skip
    return buffer.getvalue()
