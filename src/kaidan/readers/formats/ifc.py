"""Building models: IFC2x3, IFC4 and IFC4x3 as text, alone or zipped, as `Bodies` in metres.

What the parser rejects or skips though its meaning is plain is repaired in the text: the name of an
old schema, and ``*`` where nothing is derived. The parser itself runs in a process of its own, see
`kaidan.readers.formats.ifc_child`.
"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from kaidan.errors import MissingExtraError, short
from kaidan.readers.formats import ifc_child
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import METRES, Bodies, Body, Known, Provenance
from kaidan.readers.opening import LARGEST, Source

MOST_SECONDS, SECONDS_A_MB = 60.0, 6.0
"""Time that the parser may take, in all and more for each megabyte [s]."""
MEMORY, MEMORY_A_BYTE = 4 << 30, 60
"""Memory that it may take, in all and more for each byte of the model."""

FARTHEST = 1e7
"""Distance from the origin of the model beyond which nothing is drawn [m]: the coordinates of
all maps are smaller."""
END = b"END-ISO-10303-21"
"""How every model ends."""
_TAIL = 4096
_SCHEMA = re.compile(rb"FILE_SCHEMA\s*\(\s*\(\s*'([^']*)'[^)]*\)\s*\)", re.IGNORECASE)
_KNOWN = {b"IFC2X3", b"IFC4", b"IFC4X3_ADD2"}
_DERIVING = {
    b"IFCSIUNIT",
    b"IFCGEOMETRICREPRESENTATIONSUBCONTEXT",
    b"IFCORIENTEDEDGE",
    b"IFCMIRROREDPROFILEDEF",
}
"""Entities of which an attribute is derived, so that they have ``*`` by right."""
_STAR = re.compile(rb"[(,]\s*\*")
_INSTANCE = re.compile(rb"#\d+\s*=\s*(IFC\w+)", re.IGNORECASE)
_LONGEST = 4096
"""Bytes before an asterisk in which its instance begins."""


def read(source: Source, hints: Hints) -> Bodies:
    """Stairs and slabs of a building model, tessellated, and what limits the way over them.

    Returns
    -------
    Bodies
        Vertices in metres in the model's world frame, z up.

    Raises
    ------
    InputError
        No readable model, or one that takes more time or memory than a sound one.
    MissingExtraError
        Without ifcopenshell.
    """
    notes: list[str] = []
    with _plain_file(source, notes) as path:
        line, rest = _parsed(source, path)
    try:
        found = json.loads(line)
        bodies = tuple(_bodies(source, found, rest))
    except (ValueError, KeyError, IndexError, TypeError):
        raise source.refuse("no readable building model: the parser's answer is broken") from None
    unit = found.get("unit", 1.0)
    names = (name for name, length in METRES.items() if math.isclose(length, unit, rel_tol=1e-9))
    provenance = Provenance(
        path=str(source.path),
        digest=source.digest,
        form="ifc",
        element=hints.element,
        unit=Known(next(names, f"{unit:g} m"), "file"),
        up=Known("+z", "format"),
        notes=tuple(notes),
    )
    facts = {"schema": found["schema"], "unit": unit, "storeys": found["storeys"]}
    return Bodies(bodies, provenance, facts)


def _bodies(source: Source, found: dict[str, Any], rest: bytes) -> Iterator[Body]:
    at, lengths = 0, iter(found["lengths"])
    for each in found["bodies"]:
        vertices, faces = np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
        if each["shape"]:
            n, m = next(lengths), next(lengths)
            vertices = np.frombuffer(rest, np.float64, n, at).reshape(-1, 3)
            faces = np.frombuffer(rest, np.int32, m, at + 8 * n).reshape(-1, 3).astype(np.int64)
            at += 8 * n + 4 * m
            if not np.abs(vertices).max() < FARTHEST:  # NaN too
                raise source.refuse(f"drawn farther off than {FARTHEST:g} m", each["id"])
        yield Body(
            identity=each["id"],
            name=each["name"],
            category=each["category"],
            parent=each["parent"],
            vertices=vertices,
            faces=faces,
            facts={**each["facts"], "type": each["type"], "storey": each["storey"]},
        )


@contextmanager
def _plain_file(source: Source, notes: list[str]) -> Iterator[Path]:
    """File with the text of a model that the parser takes."""
    models = [each for each in source.members if each.filename.lower().endswith(".ifc")]
    if len(models) > 1:
        raise source.refuse(f"{len(models)} models are in it: unpack it and name the one to read")
    if not models and b"FILE_SCHEMA" not in source.head.upper():
        raise source.refuse("no FILE_SCHEMA in its header: no building model in STEP text")
    content = None
    if models:
        content = source.member(models[0], largest=LARGEST)
    repaired = _repaired(source, content, notes)
    if repaired is None and content is None:
        yield source.path
        return
    with tempfile.TemporaryDirectory(prefix="kaidan-") as folder:
        path = Path(folder) / "model.ifc"
        path.write_bytes(repaired if repaired is not None else content or b"")
        yield path


def _repaired(source: Source, content: bytes | None, notes: list[str]) -> bytes | None:
    """Text of a model with what the parser rejects put right; None: nothing to repair."""
    head = source.head if content is None else content[: 1 << 16]
    match = _SCHEMA.search(head)
    if match is None:
        raise source.refuse("no schema is named in its header")
    named = match.group(1).upper()
    meant = _meant(named)
    if meant is None:
        raise source.refuse(
            f"schema {short(named.decode('ascii', 'replace'))!r} is not read; known: IFC2X3, IFC4, "
            "IFC4X3"
        )
    if END not in _tail(source, content):
        raise source.refuse(f"it ends in the middle: {END.decode()} is missing")
    sound = named in _KNOWN and match.group(0).count(b"'") == 2
    if content is None:
        content = source.content()
    starred = list(_starred(content))
    if sound and not starred:
        return None
    repaired = bytearray(content)
    for place in starred:
        repaired[place : place + 1] = b"$"
    if not sound:
        notes.append(f"its schema {named.decode()} is read as {meant.decode()}")
        repaired[match.start() : match.end()] = b"FILE_SCHEMA(('" + meant + b"'))"
    if starred:
        notes.append("asterisks in it where nothing is derived are read as not given")
    return bytes(repaired)


def _starred(content: bytes) -> Iterator[int]:
    """Places of asterisks where nothing is derived: an attribute that is not given."""
    for star in _STAR.finditer(content):
        before = content[max(0, star.start() - _LONGEST) : star.end()]
        instances = list(_INSTANCE.finditer(before))
        if not instances or instances[-1].group(1).upper() in _DERIVING:
            continue
        if before.count(b"'", instances[-1].end()) % 2 == 0:  # in no text
            yield star.end() - 1


def _tail(source: Source, content: bytes | None) -> bytes:
    """Last bytes of a model."""
    if content is not None:
        return content[-_TAIL:]
    with source.opened() as file:
        file.seek(max(0, source.size - _TAIL))
        return file.read(_TAIL)


def _meant(schema: bytes) -> bytes | None:
    """Schema by which one of that name is read; None: none."""
    if schema.startswith(b"IFC2X"):
        return b"IFC2X3"
    if schema.startswith(b"IFC4X"):
        return b"IFC4X3_ADD2"
    return b"IFC4" if schema.startswith(b"IFC4") else None


def _parsed(source: Source, path: Path) -> tuple[bytes, bytes]:
    """First line of the child's output, and the rest."""
    size = path.stat().st_size
    seconds = MOST_SECONDS + SECONDS_A_MB * size / 1e6
    child = [sys.executable, ifc_child.__file__, str(path.absolute())]
    env = {**os.environ, ifc_child.MEMORY: str(MEMORY + MEMORY_A_BYTE * size)}
    try:
        done = subprocess.run(child, capture_output=True, timeout=seconds, env=env, check=False)
    except subprocess.TimeoutExpired:
        raise source.refuse(
            f"the parser of building models takes more than {math.ceil(seconds)} s for it"
        ) from None
    if done.returncode == 4:
        raise MissingExtraError("a building model (IFC) as input", "ifc")
    if done.returncode:
        said = done.stderr.decode("utf-8", "replace").rpartition("KAIDAN ")[2].strip()
        if done.returncode < 0 or not said:
            said = "the parser of building models crashes on it; it is damaged or malicious"
        raise source.refuse(f"no readable building model: {short(said)}")
    line, _, rest = done.stdout.partition(b"\n")
    return line, rest
