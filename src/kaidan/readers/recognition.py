"""What a file is, by its content; one line for each format, the first that fits is it.

A format has a reader, ``kaidan.readers.formats.<reader>.read(source, hints)``, which returns the
kind that the line names; or a refusal: files that are recognised and answered in one sentence,
which stands in `kaidan.text.refusals` under that word.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from kaidan.readers.opening import Source

Kind = Literal["points", "mesh", "heights", "building", "robot", ""]
"""What a reader yields: Points, Mesh, Heights; Bodies of a building or of a robot."""

INTERPRETERS: Mapping[str, str] = MappingProxyType(
    {
        "points": "kaidan.readers.interpreters.points",
        "mesh": "kaidan.readers.interpreters.mesh",
        "heights": "kaidan.readers.interpreters.heights",
    }
)
"""Module of each kind with ``found(contents, hints) -> Found``."""


@dataclass(frozen=True)
class Format:
    """A format of files."""

    name: str
    title: str
    """What people call it, in the middle of a sentence."""
    kind: Kind
    fits: Callable[[Source], bool]
    reader: str = ""
    """Module of `kaidan.readers.formats`."""
    extra: str = ""
    """Extra of kaidan that its reader needs."""
    refusal: str = ""
    """Why it is not read."""


def begins(*words: bytes) -> Callable[[Source], bool]:
    """Test of a file that begins with one of these."""
    return lambda source: source.head.startswith(words)


def holds(*suffixes: str) -> Callable[[Source], bool]:
    """Test of a zip archive with a file of such a name."""
    return lambda source: any(each.filename.lower().endswith(suffixes) for each in source.members)


def xml(*roots: str, having: bytes = b"") -> Callable[[Source], bool]:
    """Test of XML with one of these root elements, prefixes left out, and with some bytes."""
    pattern = re.compile(
        rb"^(?:\xef\xbb\xbf)?\s*(?:<\?.*?\?>\s*|<!--.*?-->\s*|<!DOCTYPE[^\[>]*(?:\[.*?\])?\s*>\s*)*"
        rb"<(?:[\w.-]+:)?(?:" + "|".join(roots).encode() + rb")[\s/>]",
        re.DOTALL,
    )
    return lambda source: bool(pattern.match(source.head)) and having in source.head


def json_with(*keys: str) -> Callable[[Source], bool]:
    """Test of a JSON object that has these keys near its beginning."""
    return lambda source: (
        source.head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{")
        and all(f'"{key}"'.encode() in source.head for key in keys)
    )


def is_splats(source: Source) -> bool:
    """Test of a PLY file whose points have the parameters of Gaussian splats."""
    return source.head.startswith(b"ply") and all(
        word in source.head for word in (b"property float scale_0", b"rot_0", b"opacity")
    )


ARCHIVES = (b"PK\x03\x04", b"7z\xbc\xaf", b"Rar!", b"\x1f\x8b")
"""First bytes of zip, 7-Zip, RAR and gzip."""

FORMATS: tuple[Format, ...] = (
    Format("splats", "Gaussian splats", "", is_splats, refusal="splats"),
    Format("usdz", "USDZ", "", holds(".usdc", ".usda", ".usd"), refusal="usdz"),
    Format("revit", "a Revit project", "", begins(b"\xd0\xcf\x11\xe0"), refusal="revit"),
    Format("citygml", "CityGML", "", xml("CityModel"), refusal="citygml"),
    Format("xacro", "xacro", "", xml("robot", having=b"xmlns:xacro"), refusal="xacro"),
    Format("ifc5", "IFC5", "", json_with("header", "data", "imports"), refusal="ifc5"),
    Format("archive", "an archive", "", begins(*ARCHIVES), refusal="archive"),
)  # fmt: skip
"""All formats; the first that fits is it, so archives of one known file stand before archives."""


def recognised(source: Source) -> Format:
    """Format of a file.

    Raises
    ------
    InputError
        None that is known; the text says which are.
    """
    for form in FORMATS:
        if form.fits(source):
            return form
    readable = ", ".join(dict.fromkeys(form.title for form in FORMATS if not form.refusal))
    what = "a folder" if source.is_folder else "its content"
    raise source.refuse(f"{what} is of no known format; known: {readable}")
