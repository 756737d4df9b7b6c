"""Files of strangers: opened without running, following or unpacking more than they may.

Every size that a file states is checked against the bytes that are there before memory is taken
for it. Nothing that a file names is opened.
"""

import hashlib
import os
import stat
import warnings
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, KaidanError, short
from kaidan.files import reason

HEAD = 65_536
"""Bytes from the beginning that recognition looks at."""
LARGEST = 2_000_000_000
"""Largest file that is read as a whole [bytes]."""
LARGEST_STREAM = 200_000_000_000
"""Largest file that is read piece by piece [bytes]."""
LARGEST_TEXT = 200_000_000
"""Largest text that is parsed as a whole [bytes]."""
MOST_MEMBERS = 10_000
"""Most files in an archive."""
LARGEST_RATIO = 1100
"""Largest compression that is believed: deflate cannot exceed 1032."""


@dataclass(frozen=True)
class Source:
    """A file, or a folder that is one recording, known to be there."""

    path: Path
    size: int
    """Bytes; of a folder, of all files in it."""
    head: bytes
    """Its first bytes, `HEAD` at most; of a folder none."""
    is_folder: bool = False

    @classmethod
    def of(cls, path: str | Path) -> "Source":
        """Source at a path."""
        path = Path(path)
        try:
            status = path.stat()
            if stat.S_ISDIR(status.st_mode):
                sizes = [each.stat().st_size for each in path.iterdir() if each.is_file()]
                return cls(path, sum(sizes), b"", is_folder=True)
            if not stat.S_ISREG(status.st_mode):
                raise InputError(f"{short(path)}: cannot be read: neither a file nor a folder")
            with path.open("rb") as file:
                head = file.read(HEAD)
        except (OSError, ValueError) as error:
            raise InputError(f"{short(path)}: cannot be read: {reason(error)}") from None
        source = cls(path, status.st_size, head)
        if not head:
            raise source.refuse("it is empty")
        if status.st_size > LARGEST_STREAM:
            raise source.refuse(f"more than {LARGEST_STREAM / 1e9:g} GB")
        return source

    def refuse(self, text: str, where: str = "") -> InputError:
        """Error about this file, in one line; `where` is a byte, a line or an element of it."""
        return InputError(f"{short(self.path)}: {short(where) + ': ' if where else ''}{text}")

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the file, of a folder's files in the order of their names."""
        files = sorted(self.path.iterdir()) if self.is_folder else [self.path]
        found = hashlib.sha256()
        for each in files:
            if each.is_file():
                with each.open("rb") as file:
                    while piece := file.read(1 << 22):
                        found.update(piece)
        return found.hexdigest()

    @cached_property
    def members(self) -> tuple[zipfile.ZipInfo, ...]:
        """Files in it, where it is a zip archive; none otherwise, or where it is damaged."""
        if not self.head.startswith(b"PK\x03\x04"):
            return ()
        try:
            with zipfile.ZipFile(self.path) as archive:
                every = archive.infolist()
        except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
            return ()
        if not all(each.filename for each in every):
            raise self.refuse("an entry of the archive has no name")
        return tuple(each for each in every if not each.is_dir())

    @contextmanager
    def opened(self) -> Iterator[IO[bytes]]:
        """The file, open for bytes; what goes wrong while it is read is an `InputError`."""
        try:
            with self.path.open("rb") as file:
                yield file
        except (OSError, EOFError) as error:
            raise self.refuse(f"cannot be read: {error}") from None

    @contextmanager
    def foreign(self, where: str = "") -> Iterator[None]:
        """Whatever a library raises over a damaged file becomes one line about the file.

        What it warns of or logs is not said. A panic of a library written in Rust is no
        `Exception`, and is one all the same here.
        """
        import logging

        before = logging.root.manager.disable
        logging.disable(logging.CRITICAL)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                yield
        except (KaidanError, ModuleNotFoundError, KeyboardInterrupt, SystemExit, GeneratorExit):
            raise
        except MemoryError:
            raise self.refuse("it states a size beyond the memory", where) from None
        except BaseException as error:
            lines = str(error).split("\n")
            text = short(lines[0]) or type(error).__name__
            raise self.refuse(f"cannot be read: {text}", where) from None
        finally:
            logging.disable(before)

    def content(self, largest: int = LARGEST) -> bytes:
        """All of its bytes."""
        self.refuse_larger(largest)
        with self.opened() as file:
            return file.read(largest + 1)

    def text(self, largest: int = LARGEST_TEXT) -> str:
        """All of it as text, UTF-8 with or without a mark."""
        try:
            return self.content(largest).decode("utf-8-sig")
        except UnicodeDecodeError as error:
            raise self.refuse("no UTF-8 text", f"byte {error.start}") from None

    def refuse_larger(self, largest: int) -> None:
        """Refuse a file that is too large to be read as a whole."""
        if self.size > largest:
            raise self.refuse(
                f"{self.size / 1e6:.0f} MB are more than the {largest / 1e6:.0f} MB that are read "
                "of this format as a whole"
            )

    def array(self, dtype: Any, count: int, offset: int) -> NDArray[Any]:
        """So many items from a byte on, after checking that they are there."""
        kind = np.dtype(dtype)
        self.refuse_larger(LARGEST)
        self.refuse_missing(count, kind.itemsize, offset)
        with self.opened() as file:
            file.seek(offset)
            found = np.frombuffer(file.read(count * kind.itemsize), dtype=kind)
        if len(found) != count:
            raise self.refuse(f"ends after {len(found)} of {count} items", f"byte {offset}")
        return found

    def refuse_missing(self, count: int, itemsize: int, offset: int) -> None:
        """Refuse a header that states more items than the file has bytes for."""
        room = self.size - offset
        if count < 0 or count * itemsize > room:
            raise self.refuse(
                f"the header states {count} items of {itemsize} bytes; only {max(room, 0)} bytes "
                "follow it",
                f"byte {offset}",
            )

    def member(self, info: zipfile.ZipInfo, largest: int = LARGEST_TEXT) -> bytes:
        """Bytes of a file in the archive, never more than it states and than is allowed."""
        named = info.filename
        if len(self.members) > MOST_MEMBERS:
            raise self.refuse(f"more than {MOST_MEMBERS} files in the archive")
        if info.file_size > largest:
            raise self.refuse(f"{info.file_size / 1e6:.0f} MB unpacked are too many", named)
        if info.file_size > LARGEST_RATIO * max(info.compress_size, 1):
            raise self.refuse("its compression is no honest one", named)
        try:
            with zipfile.ZipFile(self.path) as archive, archive.open(info) as file:
                found = file.read(info.file_size + 1)
        except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError) as bad:
            raise self.refuse(f"cannot be unpacked: {short(bad)}", named) from None
        except Exception as bad:  # zlib.error, lzma.LZMAError: the decompressors' own
            raise self.refuse(f"cannot be unpacked: {short(bad)}", named) from None
        if len(found) != info.file_size:
            raise self.refuse("its size is not the one stated", named)
        return found


def split_element(name: str) -> tuple[str, str]:
    """Path and element of ``model.ifc#GlobalId``; a file of that very name has none.

    Examples
    --------
    >>> split_element("model.ifc#2O2Fr$t4X7Zf8NOew3FNr2")
    ('model.ifc', '2O2Fr$t4X7Zf8NOew3FNr2')
    """
    path, mark, element = name.rpartition("#")
    return (name, "") if not mark or os.path.exists(name) else (path, element)
