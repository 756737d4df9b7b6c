"""Recordings of ROS 1 and ROS 2 (bag, db3, MCAP) by rosbags: elevation maps and point clouds.

No ROS is needed. Of a folder that is a recording its one MCAP or db3 file is opened, never what
its metadata name.
"""

from pathlib import Path
from typing import Any

import numpy as np

from kaidan.errors import listed
from kaidan.readers.formats.columns import points_of_columns, provenance_of
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Heights, Known, Points
from kaidan.readers.opening import LARGEST_STREAM, Source

GRID, CLOUD = "grid_map_msgs/msg/GridMap", "sensor_msgs/msg/PointCloud2"
"""Types of the messages that are read."""
_LAYERS = ("elevation", "elevation_inpainted", "height", "z")
_NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
_GRID_MAP = """
std_msgs/Header header
grid_map_msgs/GridMapInfo info
string[] layers
string[] basic_layers
std_msgs/Float32MultiArray[] data
uint16 outer_start_index
uint16 inner_start_index
"""
_GRID_MAP_INFO = """
float64 resolution
float64 length_x
float64 length_y
geometry_msgs/Pose pose
"""


def is_recording(source: Source) -> bool:
    """Test of a folder with one MCAP or db3 file."""
    return source.is_folder and _storage(source) is not None


def _storage(source: Source) -> Path | None:
    files = [each for each in source.path.iterdir() if each.suffix in (".mcap", ".db3")]
    return files[0] if len(files) == 1 and files[0].is_file() else None


def read(source: Source, hints: Hints) -> Points | Heights:
    """Last elevation map of a recording, else its first point cloud.

    `hints.element` names the topic where there are several.

    Raises
    ------
    InputError
        A damaged file, no topic of these types, or several and none named.
    """
    source.refuse_larger(LARGEST_STREAM)
    with source.foreign():
        reader, store = opened(source)
        reader.open()  # one that fails is closed again, and says why
        try:
            topics = {each.topic: each for each in reader.connections
                      if each.msgtype in (GRID, CLOUD)}  # fmt: skip
            topic = _topic(source, topics, [each.topic for each in reader.connections], hints)
            connection = topics[topic]
            raw = None
            for _, _, message in reader.messages(connections=[connection]):
                raw = bytes(message)
                if connection.msgtype == CLOUD:
                    break
            if raw is None:
                raise source.refuse("no message was recorded", topic)
            message = deserialised(store, raw, connection)
        finally:
            reader.close()
        made = _heights if connection.msgtype == GRID else _points
        return made(source, message, topic, hints)


def opened(source: Source) -> tuple[Any, Any]:
    """Reader of a recording, still closed, and the types of its messages."""
    from rosbags.rosbag1 import Reader as Reader1
    from rosbags.rosbag2 import Reader as Reader2
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    if source.head.startswith(b"#ROSBAG"):
        return Reader1(source.path), get_typestore(Stores.ROS1_NOETIC)
    path = _storage(source) if source.is_folder else source.path
    assert path is not None
    store = get_typestore(Stores.ROS2_HUMBLE)
    if GRID not in store.fielddefs:
        store.register(get_types_from_msg(_GRID_MAP_INFO, "grid_map_msgs/msg/GridMapInfo"))
        store.register(get_types_from_msg(_GRID_MAP, GRID))
    with path.open("rb") as file:
        suffix = ".mcap" if file.read(5) == b"\x89MCAP" else ".db3"
    return Reader2.STORAGE_PLUGINS[suffix](path), store


def deserialised(store: Any, raw: bytes, connection: Any) -> Any:
    """Message of its bytes."""
    from rosbags.interfaces import MessageDefinitionFormat
    from rosbags.typesys import get_types_from_msg

    if connection.msgtype not in store.fielddefs:
        definition = connection.msgdef
        if definition.format != MessageDefinitionFormat.MSG:
            raise TypeError(f"the definition of {connection.msgtype} is missing")
        types = get_types_from_msg(definition.data, connection.msgtype)
        store.register({name: each for name, each in types.items() if name not in store.fielddefs})
    if hasattr(connection.ext, "md5sum") or hasattr(connection.ext, "callerid"):
        return store.deserialize_ros1(raw, connection.msgtype)
    return store.deserialize_cdr(raw, connection.msgtype)


def _topic(source: Source, topics: dict[str, Any], everything: list[str], hints: Hints) -> str:
    if hints.element:
        if hints.element not in topics:
            known = listed(sorted(topics)) or "none"
            raise source.refuse(f"no topic {hints.element[:60]!r} can be read; known: {known}")
        return hints.element
    if not topics:
        raise source.refuse(
            "no topic is a grid_map or a point cloud; it has " + (listed(everything) or "none")
        )
    for kind in (GRID, CLOUD):
        named = [name for name, each in topics.items() if each.msgtype == kind]
        if len(named) == 1:
            return named[0]
        if named:
            raise source.refuse(f"which topic is meant? name one as its element: {listed(named)}")
    raise AssertionError


def _heights(source: Source, message: Any, topic: str, hints: Hints) -> Heights:
    layers = list(message.layers)
    layer = next((name for name in _LAYERS if name in layers), layers[0] if layers else None)
    if layer is None:
        raise source.refuse("the map has no layer", topic)
    data = message.data[layers.index(layer)]
    dims = [int(each.size) for each in data.layout.dim]
    cells = np.asarray(data.data, dtype=np.float64)
    side = float(message.info.resolution)
    if len(dims) != 2 or dims[0] * dims[1] != len(cells) or not 0 < side < 100:
        raise source.refuse(f"layer {layer!r} is no raster of {dims} cells of {side:g} m", topic)
    # the buffers run round; x and y fall along rows and columns
    grid = cells.reshape(dims[0], dims[1])
    if data.layout.dim[0].label == "column_index":
        grid = grid.T
    grid = np.roll(grid, (-message.outer_start_index, -message.inner_start_index), axis=(0, 1))
    provenance = provenance_of(
        source, "bag", hints, unit=Known("m", "format"), up=Known("+z", "format"),
        element=f"{topic} {layer}",
    )  # fmt: skip
    return Heights(grid[::-1, ::-1].T, (side, side), provenance)


def _points(source: Source, message: Any, topic: str, hints: Hints) -> Points:
    count = int(message.width) * int(message.height)
    order = ">" if message.is_bigendian else "<"
    step, size = int(message.point_step), len(message.data)
    fields = {each.name: each for each in message.fields}
    if any(axis not in fields or fields[axis].datatype not in _NUMBERS for axis in "xyz"):
        raise source.refuse("the cloud has no fields x, y, z", topic)
    kinds = {axis: np.dtype(order + _NUMBERS[fields[axis].datatype]) for axis in "xyz"}
    ends = [fields[axis].offset + kinds[axis].itemsize for axis in "xyz"]
    if step <= 0 or max(ends) > step or count * step > size or not count:
        raise source.refuse(f"{count} points of {step} bytes are not in {size} bytes", topic)
    kind = np.dtype({
        "names": list("xyz"), "formats": [kinds[axis] for axis in "xyz"],
        "offsets": [fields[axis].offset for axis in "xyz"], "itemsize": step,
    })  # fmt: skip
    table = np.frombuffer(np.asarray(message.data).tobytes(), kind, count)
    grid = (int(message.height), int(message.width)) if message.height > 1 else None
    frame = str(message.header.frame_id).lower()
    up = Known("-y", "file") if "optical" in frame else None
    return points_of_columns(
        source, "bag", [table[axis] for axis in "xyz"], hints, grid=grid,
        viewpoint=np.zeros(3), unit=Known("m", "format"), up=up, element=topic,
    )  # fmt: skip
