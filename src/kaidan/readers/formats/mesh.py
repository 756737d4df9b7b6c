"""Meshes by trimesh: STL, OBJ, PLY, glTF, GLB and DAE; nothing that they name is opened."""

import io
import json
from typing import Any

import numpy as np

from kaidan.errors import short
from kaidan.readers.formats.columns import provenance_of
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Known, Mesh
from kaidan.readers.opening import Source
from kaidan.readers.xml_tree import parse_xml

LARGEST_MESH = 500_000_000
"""Largest file of a mesh [bytes]."""
MOST_FACES = 20_000_000
"""Most triangles."""
_UPS = {"X_UP": "+x", "Y_UP": "+y", "Z_UP": "+z"}


def is_stl(source: Source) -> bool:
    """Test of STL: binary with a size that its count of triangles explains, or text."""
    if len(source.head) >= 84:
        count = int.from_bytes(source.head[80:84], "little")
        if count and source.size == 84 + 50 * count:
            return True
    return source.head.lstrip()[:5] == b"solid" and b"facet" in source.head


def is_obj(source: Source) -> bool:
    """Test of OBJ: lines of vertices and of faces or groups."""
    if b"\0" in source.head:
        return False
    words = [line.split(None, 1)[:1] for line in source.head.splitlines()]
    first = [word[0] for word in words if word]
    known = {b"v", b"vn", b"vt", b"vp", b"f", b"o", b"g", b"s", b"l", b"p", b"usemtl", b"mtllib"}
    lines = [word for word in first if not word.startswith(b"#")]
    return b"v" in lines and all(word in known for word in lines[:-1])


def read_stl(source: Source, hints: Hints) -> Mesh:
    """Mesh of an STL file, which says neither its unit nor its up axis."""
    return _loaded(source, hints, "stl", "stl", source.content(LARGEST_MESH))


def read_obj(source: Source, hints: Hints) -> Mesh:
    """Mesh of an OBJ file; its materials are not opened."""
    kept = (b"v ", b"v\t", b"f ", b"f\t", b"o ", b"g ")
    lines = source.content(LARGEST_MESH).replace(b"\\\n", b" ").splitlines()
    content = b"\n".join(line for line in lines if line.lstrip().startswith(kept))
    return _loaded(source, hints, "obj", "obj", content)


def read_ply(source: Source, hints: Hints) -> Mesh:
    """Mesh of a PLY file with faces."""
    from kaidan.readers.formats.ply import header_of

    elements, _, at = header_of(source)
    for count, properties in elements.values():
        source.refuse_missing(count, max(len(properties), 1), at)
    return _loaded(source, hints, "ply-mesh", "ply", source.content(LARGEST_MESH))


def read_glb(source: Source, hints: Hints) -> Mesh:
    """Mesh of a GLB file."""
    content = source.content(LARGEST_MESH)
    length = int.from_bytes(content[12:16], "little")
    if content[16:20] != b"JSON" or 20 + length > len(content):
        raise source.refuse("its first chunk is no JSON, or cut off", "byte 12")
    _inside(source, content[20 : 20 + length])
    return _loaded(source, hints, "glb", "glb", content, **_gltf_frame())


def read_gltf(source: Source, hints: Hints) -> Mesh:
    """Mesh of a glTF file whose buffers are in the file itself."""
    content = source.content(LARGEST_MESH)
    _inside(source, content)
    return _loaded(source, hints, "gltf", "gltf", content, **_gltf_frame())


def _gltf_frame() -> dict[str, Any]:
    return {"unit": Known("m", "format"), "up": Known("+y", "format")}


def _inside(source: Source, content: bytes) -> None:
    """Refuse geometry that stands in another file, and counts without bytes."""
    try:
        tree = json.loads(content)
        buffers = tree.get("buffers", [])
        outside = [b["uri"] for b in buffers if not b.get("uri", "data:").startswith("data:")]
        counts = [int(each.get("count", 0)) for each in tree.get("accessors", [])]
    except (ValueError, RecursionError, AttributeError, TypeError, KeyError) as error:
        raise source.refuse(f"its JSON is no glTF: {error}") from None
    if outside:
        raise source.refuse(
            f"its geometry stands in another file, {outside[0][:60]!r}, which is not opened: save "
            "it as GLB"
        )
    if any(count < 0 or count > 4 * source.size for count in counts):
        raise source.refuse(f"an accessor states {max(counts)} items, more than the file can hold")


def read_dae(source: Source, hints: Hints) -> Mesh:
    """Mesh of a COLLADA file; its images are not opened."""
    content = source.content(LARGEST_MESH)
    asset = parse_xml(content, origin=short(source.path)).find("asset")
    unit = None if asset is None else asset.find("unit")
    up = "" if asset is None else asset.word("up_axis")
    try:
        metres = 1.0 if unit is None else float(unit.attributes.get("meter", "1"))
    except ValueError:
        raise source.refuse("its unit is no number", "asset") from None
    if not 1e-6 <= metres <= 1e6:
        raise source.refuse(f"its unit of {metres:g} m is none", "asset")
    known: dict[str, Any] = {"unit": Known("m", "file" if unit is not None else "format")}
    if (up or "Y_UP") in _UPS:
        known["up"] = Known(_UPS[up or "Y_UP"], "file")
    return _loaded(source, hints, "dae", "dae", content, factor=metres, **known)


def _loaded(
    source: Source,
    hints: Hints,
    form: str,
    file_type: str,
    content: bytes,
    *,
    factor: float = 1.0,
    **known: Any,
) -> Mesh:
    import trimesh

    options: dict[str, Any] = {"process": False} if file_type in ("stl", "obj", "ply") else {}
    if file_type == "obj":
        options["skip_materials"] = True
    with source.foreign():
        scene = trimesh.load_scene(
            io.BytesIO(content), file_type=file_type, resolver={}, allow_remote=False, **options
        )
        parts = [each for each in scene.dump() if isinstance(each, trimesh.Trimesh)]
        if not parts or not sum(len(part.faces) for part in parts):
            raise source.refuse("it holds no triangles")
        for part in parts:
            if part.vertices.shape[1:] != (3,):
                raise source.refuse(f"its vertices have {part.vertices.shape[-1]} coordinates")
        starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
        vertices = np.vstack([part.vertices for part in parts]).astype(np.float64) * factor
        faces = np.vstack(
            [np.asarray(part.faces) + start for part, start in zip(parts, starts, strict=False)]
        ).astype(np.int64)
    if len(faces) > MOST_FACES:
        raise source.refuse(f"{len(faces)} triangles are more than {MOST_FACES}")
    if faces.min() < 0 or faces.max() >= len(vertices):
        raise source.refuse(f"a triangle names a vertex that is none of its {len(vertices)}")
    used = vertices[faces.ravel()]
    if not np.isfinite(used).all() or np.abs(used).max() > 1e9:
        raise source.refuse("a vertex is no finite number")
    if hints.crop is not None:
        low, high = np.array(hints.crop[:3]), np.array(hints.crop[3:])
        inside = np.all((vertices >= low) & (vertices <= high), axis=1)
        faces = faces[inside[faces].all(axis=1)]
        if not len(faces):
            raise source.refuse("no triangle is within the crop")
    return Mesh(vertices, faces, provenance_of(source, form, hints, **known))
