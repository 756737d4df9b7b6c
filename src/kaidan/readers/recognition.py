"""What a file is, by its content; one line for each format, the first that fits is it.

A format has a reader, ``kaidan.readers.formats.<reader>.read(source, hints)``, which returns the
kind that the line names; or a refusal: files that are recognised and answered in one sentence,
which stands in `kaidan.readers.sentences.refusals` under that word.
"""

import re
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from kaidan.readers.formats.bags import is_recording
from kaidan.readers.formats.mesh import is_obj, is_stl
from kaidan.readers.formats.ply import has_faces
from kaidan.readers.formats.table import is_table
from kaidan.readers.opening import Source

Kind = Literal["points", "mesh", "heights", "building", "robot", ""]
"""What a reader yields: Points, Mesh, Heights; Bodies of a building or of a robot; empty: its
content decides between the first three."""

INTERPRETERS: Mapping[str, str] = MappingProxyType(
    {
        "points": "kaidan.readers.interpreters.points",
        "mesh": "kaidan.readers.interpreters.mesh",
        "heights": "kaidan.readers.interpreters.heights",
        "robot": "kaidan.readers.interpreters.robot",
        "building": "kaidan.readers.interpreters.building",
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
    """Module of `kaidan.readers.formats`, and its function after a colon if not ``read``."""
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


def is_xacro(source: Source) -> bool:
    """Test of a robot's XML with macros, comments aside; once expanded it has none."""
    said = re.sub(rb"<!--.*?(?:-->|\Z)", b"", source.head, flags=re.DOTALL)
    return xml("robot", "xacro")(source) and bool(
        re.search(rb"<xacro:|\$\{|\$\((?:arg|find|eval|env)", said)
    )


def is_packed_splats(source: Source) -> bool:
    """Test of Gaussian splats in gzip (SPZ), by the first bytes within."""
    if not source.head.startswith(b"\x1f\x8b"):
        return False
    try:
        return zlib.decompressobj(31).decompress(source.head, 4) == b"NGSP"
    except zlib.error:
        return False


def is_tar(source: Source) -> bool:
    """Test of a tar archive."""
    return source.head[257:262] == b"ustar"


def is_model(source: Source) -> bool:
    """Test of a building model as STEP text."""
    head = source.head.lstrip(b"\xef\xbb\xbf \t\r\n").upper()
    return head.startswith(b"ISO-10303-21") and b"'IFC" in head


ARCHIVES = (
    b"PK\x03\x04", b"PK\x05\x06", b"7z\xbc\xaf", b"Rar!", b"\x1f\x8b", b"BZh", b"\xfd7zXZ",
    b"\x28\xb5\x2f\xfd",
)  # fmt: skip
"""First bytes of zip, an empty zip, 7-Zip, RAR, gzip, bzip2, xz and Zstandard."""


def is_heights(source: Source) -> bool:
    """Test of an NPY file with more columns than points have."""
    shape = re.search(rb"'shape': \((\d+), (\d+)\)", source.head[:200])
    return source.head.startswith(b"\x93NUMPY") and shape is not None and int(shape[2]) > 8


TIFF = (b"II*\0", b"MM\0*", b"II+\0")
"""First bytes of TIFF, both byte orders, and of BigTIFF."""
BAGS = (b"#ROSBAG V2", b"\x89MCAP", b"SQLite format 3\0")
"""First bytes of recordings of ROS 1, MCAP and ROS 2."""

FORMATS: tuple[Format, ...] = (
    Format("pcd", "PCD", "points", begins(b"# .PCD", b"VERSION", b"#.PCD", b"FIELDS"), "pcd"),
    Format("splats", "Gaussian splats", "", is_splats, refusal="splats"),
    Format("spz", "Gaussian splats", "", is_packed_splats, refusal="splats"),
    Format("ply-mesh", "PLY", "mesh", has_faces, "mesh:read_ply", "mesh"),
    Format("ply", "PLY", "points", begins(b"ply\n", b"ply\r\n"), "ply"),
    Format("npy-heights", "NPY", "heights", is_heights, "npy"),
    Format("npy", "NPY", "points", begins(b"\x93NUMPY"), "npy"),
    Format("npz", "NPZ", "", holds(".npy"), "npy"),
    Format("las", "LAS", "points", begins(b"LASF"), "las", "las"),
    Format("e57", "E57", "points", begins(b"ASTM-E57"), "e57", "e57"),
    Format("glb", "GLB", "mesh", begins(b"glTF"), "mesh:read_glb", "mesh"),
    Format("gltf", "glTF", "mesh", json_with("asset", "accessors"), "mesh:read_gltf", "mesh"),
    Format("dae", "DAE", "mesh", xml("COLLADA"), "mesh:read_dae", "mesh"),
    Format("geotiff", "GeoTIFF", "heights", begins(*TIFF), "geotiff", "maps"),
    Format("bag", "ROS bags", "", begins(*BAGS), "bags", "bags"),
    Format("bag", "ROS bags", "", is_recording, "bags", "bags"),
    Format("usdz", "USDZ", "", holds(".usdc", ".usda", ".usd"), refusal="usdz"),
    Format("usd", "USD", "", begins(b"PXR-USDC", b"#usda"), refusal="usdz"),
    Format("revit", "a Revit project", "", begins(b"\xd0\xcf\x11\xe0"), refusal="revit"),
    Format("citygml", "CityGML", "", xml("CityModel"), refusal="citygml"),
    Format("cityjson", "CityJSON", "", json_with("type", "CityJSON"), refusal="citygml"),
    Format("xacro", "xacro", "", is_xacro, refusal="xacro"),
    Format("urdf", "URDF", "robot", xml("robot"), reader="urdf"),
    Format("sdf", "SDF", "robot", xml("sdf"), reader="sdf"),
    Format("mjcf", "MJCF", "robot", xml("mujoco"), reader="mjcf"),
    Format("ifc5", "IFC5", "", json_with("header", "ifcxVersion"), refusal="ifc5"),
    Format("ifc5-alpha", "IFC5", "", json_with("header", "data", "imports"), refusal="ifc5"),
    Format("ifc", "IFC", "building", is_model, reader="ifc", extra="ifc"),
    Format("ifczip", "zipped IFC", "building", holds(".ifc"), reader="ifc", extra="ifc"),
    Format("archive", "an archive", "", begins(*ARCHIVES), refusal="archive"),
    Format("tar", "an archive", "", is_tar, refusal="archive"),
    Format("stl", "STL", "mesh", is_stl, "mesh:read_stl", "mesh"),
    Format("obj", "OBJ", "mesh", is_obj, "mesh:read_obj", "mesh"),
    Format("table", "XYZ and CSV", "points", is_table, "table"),
)  # fmt: skip
"""All formats; the first that fits is it, so archives of one known file stand before archives."""


def known(source: Source) -> Format | None:
    """Format of a file; None: none that is known."""
    return next((form for form in FORMATS if form.fits(source)), None)


def recognised(source: Source) -> Format:
    """Format of a file."""
    form = known(source)
    if form is not None:
        return form
    readable = ", ".join(dict.fromkeys(form.title for form in FORMATS if not form.refusal))
    what = "a folder" if source.is_folder else "its content"
    raise source.refuse(
        f"{what} is of no known format; known: {readable}; a sheet in TOML is used as it is"
    )
