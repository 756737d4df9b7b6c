"""Films from pictures: GIF and MP4."""

import io
import tempfile
from collections.abc import Iterable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, MissingExtraError, short, shown

FORMATS = (".mp4", ".gif")
FRAMES_PER_SECOND = 25
_GIF_WIDTH = 672
"""Widest GIF [pixels]: its format packs badly."""


def film_format(path: Path, what: str) -> str:
    """Suffix of a film's file, once it is sure that such a film can be made."""
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        found = f"unknown suffix {shown(path.suffix)}" if path.suffix else "no suffix"
        raise InputError(f"{what} {short(path)!r}: {found}; known: {', '.join(FORMATS)}")
    if suffix == ".mp4" and not (find_spec("imageio") and find_spec("imageio_ffmpeg")):
        raise MissingExtraError("a film as .mp4", "video")
    return suffix


def film_bytes(pictures: Iterable[NDArray[np.uint8]], suffix: str, *, what: str) -> bytes:
    """Film of pictures, shape (height, width, 3) each, `FRAMES_PER_SECOND`.

    pictures: sizes that are multiples of 16.
    suffix, {".mp4", ".gif"}: as `film_format` gives it.
    """
    return _mp4(pictures) if suffix == ".mp4" else _gif(pictures, what)


def _gif(pictures: Iterable[NDArray[np.uint8]], what: str) -> bytes:
    from PIL import Image

    frames = []
    for picture in pictures:
        image = Image.fromarray(picture)
        shrink = min(1.0, _GIF_WIDTH / image.width)
        size = round(image.width * shrink), round(image.height * shrink)
        frames.append(image.resize(size).convert("P", palette=Image.Palette.ADAPTIVE, colors=64))
    if not frames:
        raise InputError(f"{what}: there is no picture to show")
    buffer = io.BytesIO()
    frames[0].save(
        buffer, format="GIF", save_all=True, append_images=frames[1:],
        duration=1000 // FRAMES_PER_SECOND, loop=0,
    )  # fmt: skip
    return buffer.getvalue()


def _mp4(pictures: Iterable[NDArray[np.uint8]]) -> bytes:
    imageio: Any = import_module("imageio.v2")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "film.mp4"
        with imageio.get_writer(
            file, fps=FRAMES_PER_SECOND, codec="libx264", quality=7, macro_block_size=16
        ) as film:
            for picture in pictures:
                film.append_data(picture)
        return file.read_bytes()
