"""Small files of every format, written from points and triangles by hand or by their libraries."""

import io
import json
import struct

import numpy as np


def cloud(count=60, seed=0):
    """Points that are no multiples of anything, none at the origin."""
    return np.random.default_rng(seed).uniform(0.1, 2.0, (count, 3)).astype("<f4")


def pcd(xyz, encoding="binary", height=1, viewpoint="1 2 3 1 0 0 0"):
    table = np.zeros(len(xyz), [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("c", "<u4")])
    table["x"], table["y"], table["z"] = np.asarray(xyz).T
    head = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
        f"WIDTH {len(xyz) // height}\nHEIGHT {height}\nVIEWPOINT {viewpoint}\n"
        f"POINTS {len(xyz)}\nDATA {encoding}\n"
    ).encode()
    if encoding == "binary":
        return head + table.tobytes()
    if encoding == "ascii":
        return (
            head
            + "".join(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in np.float64(xyz).tolist()).encode()
        )
    plain = b"".join(table[name].tobytes() for name in table.dtype.names)
    packed = lzf(plain)
    return head + struct.pack("<II", len(packed), len(plain)) + packed


def lzf(plain):
    """LZF with runs of zeros referred to, everything else as it is."""
    out, at = bytearray(), 0
    while at < len(plain):
        zeros = len(plain[at : at + 264]) - len(plain[at : at + 264].lstrip(b"\0"))
        if zeros >= 4 and at and plain[at - 1] == 0:
            length = zeros - 2
            out += bytes([length << 5, 0]) if length < 7 else bytes([7 << 5, length - 7, 0])
            at += zeros
        else:
            out += bytes([0, plain[at]])
            at += 1
    return bytes(out)


def ply(xyz, encoding="binary_little_endian", faces=()):
    order = ">" if "big" in encoding else "<"
    head = f"ply\nformat {encoding} 1.0\ncomment by hand\nelement vertex {len(xyz)}\n"
    head += "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    if len(faces):
        head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    head += "end_header\n"
    if encoding == "ascii":
        rows = [f"{x!r} {y!r} {z!r} 7" for x, y, z in np.float64(xyz).tolist()]
        rows += [f"3 {a} {b} {c}" for a, b, c in faces]
        return (head + "\n".join(rows) + "\n").encode()
    table = np.zeros(
        len(xyz), [("x", order + "f4"), ("y", order + "f4"), ("z", order + "f4"), ("r", "u1")]
    )
    table["x"], table["y"], table["z"] = np.asarray(xyz).T
    rows = b"".join(struct.pack(order + "Biii", 3, *face) for face in faces)
    return head.encode() + table.tobytes() + rows


def npy(array):
    buffer = io.BytesIO()
    np.save(buffer, array)
    return buffer.getvalue()


def npz(**arrays):
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    return buffer.getvalue()


def table(xyz, separator=" ", head=""):
    return (
        head + "".join(separator.join(map(repr, row)) + "\n" for row in np.float64(xyz).tolist())
    ).encode()


def las(xyz, packed=False):
    import laspy

    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales = [1e-5] * 3
    made = laspy.LasData(header)
    made.x, made.y, made.z = np.float64(xyz).T
    buffer = io.BytesIO()
    made.write(buffer, do_compress=packed)
    return buffer.getvalue()


def e57(xyz, path):
    import pye57

    file = pye57.E57(str(path), mode="w")
    x, y, z = np.float64(xyz).T
    file.write_scan_raw({"cartesianX": x, "cartesianY": y, "cartesianZ": z})
    file.close()
    return path.read_bytes()


def stl(vertices, faces):
    rows = b"".join(
        np.zeros(3, "<f4").tobytes()
        + np.asarray(vertices)[list(face)].astype("<f4").tobytes()
        + b"\0\0"
        for face in faces
    )
    return b"\0" * 80 + struct.pack("<I", len(faces)) + rows


def stl_text(vertices, faces):
    rows = ["solid made"]
    for face in faces:
        rows += ["facet normal 0 0 0", "outer loop"]
        rows += [
            f"vertex {x!r} {y!r} {z!r}" for x, y, z in np.float64(vertices)[list(face)].tolist()
        ]
        rows += ["endloop", "endfacet"]
    return "\n".join([*rows, "endsolid made\n"]).encode()


def obj(vertices, faces, head="mtllib ../../etc/passwd\n"):
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in np.float64(vertices).tolist()]
    rows += ["usemtl x"] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return (head + "\n".join(rows) + "\n").encode()


def gltf(vertices, faces, binary=True, uri=None):
    import base64

    points = np.asarray(vertices, "<f4")
    data = points.tobytes() + np.asarray(faces, "<u4").tobytes()
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
             "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()},
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": points.nbytes},
            {"buffer": 0, "byteOffset": points.nbytes, "byteLength": len(data) - points.nbytes},
        ],
        "buffers": [{"byteLength": len(data)}],
    }  # fmt: skip
    if not binary:
        embedded = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        tree["buffers"][0]["uri"] = uri or embedded
        return json.dumps(tree).encode()
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    total = 12 + 8 + len(text) + 8 + len(data)
    return b"".join(
        [b"glTF", struct.pack("<II", 2, total), struct.pack("<I", len(text)), b"JSON", text,
         struct.pack("<I", len(data)), b"BIN\0", data]
    )  # fmt: skip


def dae(vertices, faces, unit="1", up="Z_UP"):
    numbers = " ".join(map(repr, np.float64(vertices).ravel().tolist()))
    rows = " ".join(str(each) for face in faces for each in face)
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified>
<unit name="made" meter="{unit}"/><up_axis>{up}</up_axis></asset>
<library_images><image id="i" name="i"><init_from>../../etc/passwd</init_from></image>
</library_images>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="a" count="{3 * len(vertices)}">{numbers}</float_array>
<technique_common><accessor source="#a" count="{len(vertices)}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(faces)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{rows}</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
""".encode()


def geotiff(heights, cell, missing=None):
    import tifffile

    buffer = io.BytesIO()
    tags = [(33550, "d", 3, (*cell, 0.0), True)]
    if missing is not None:
        tags.append((42113, "s", 0, str(missing), True))
    tifffile.imwrite(buffer, np.asarray(heights, np.float32), extratags=tags)
    return buffer.getvalue()


def _cloud_message(store, xyz, frame="map"):
    types = store.types
    field = types["sensor_msgs/msg/PointField"]
    stamp = types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    header = types["std_msgs/msg/Header"]
    seq = {"seq": 0} if "seq" in header.__dataclass_fields__ else {}
    data = np.asarray(xyz, "<f4")
    return types["sensor_msgs/msg/PointCloud2"](
        header=header(stamp=stamp, frame_id=frame, **seq),
        height=1,
        width=len(data),
        fields=[field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("xyz")],
        is_bigendian=False,
        point_step=12,
        row_step=12 * len(data),
        data=data.view("u1").ravel(),
        is_dense=True,
    )


def ros1_bag(xyz, path):
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC)
    with Writer(path) as writer:
        kind = "sensor_msgs/msg/PointCloud2"
        connection = writer.add_connection("/points", kind, typestore=store)
        writer.write(connection, 0, store.serialize_ros1(_cloud_message(store, xyz), kind))
    return path.read_bytes()


def ros2_bag(xyz, folder, mcap=True):
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    plugin = StoragePlugin.MCAP if mcap else StoragePlugin.SQLITE3
    with Writer(folder, version=9, storage_plugin=plugin) as writer:
        kind = "sensor_msgs/msg/PointCloud2"
        connection = writer.add_connection("/points", kind, typestore=store)
        writer.write(connection, 0, store.serialize_cdr(_cloud_message(store, xyz), kind))
    (file,) = [each for each in folder.iterdir() if each.suffix in (".mcap", ".db3")]
    return file.read_bytes()


GRID_MAP_TYPES = """
std_msgs/Header header
grid_map_msgs/GridMapInfo info
string[] layers
string[] basic_layers
std_msgs/Float32MultiArray[] data
uint16 outer_start_index
uint16 inner_start_index
================================================================================
MSG: grid_map_msgs/GridMapInfo
float64 resolution
float64 length_x
float64 length_y
geometry_msgs/Pose pose
"""


def grid_map_bag(columns, side, folder, start=(0, 0)):
    """ROS 2 recording of a grid map, as grid_map writes it: column-major, x and y falling.

    `columns` has one row for each step in x, falling, and one column for each in y, falling.
    """
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    store.register(
        {
            name: each
            for name, each in get_types_from_msg(
                GRID_MAP_TYPES, "grid_map_msgs/msg/GridMap"
            ).items()
            if name not in store.fielddefs
        }
    )
    types = store.types
    stored = np.roll(np.asarray(columns, np.float32), start, axis=(0, 1))
    rows, cols = stored.shape
    dimension = types["std_msgs/msg/MultiArrayDimension"]
    layout = types["std_msgs/msg/MultiArrayLayout"](
        dim=[
            dimension(label="column_index", size=cols, stride=rows * cols),
            dimension(label="row_index", size=rows, stride=rows),
        ],
        data_offset=0,
    )
    array = types["std_msgs/msg/Float32MultiArray"](layout=layout, data=stored.T.ravel())
    pose = types["geometry_msgs/msg/Pose"](
        position=types["geometry_msgs/msg/Point"](x=0.0, y=0.0, z=0.0),
        orientation=types["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0),
    )
    stamp = types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    message = types["grid_map_msgs/msg/GridMap"](
        header=types["std_msgs/msg/Header"](stamp=stamp, frame_id="map"),
        info=types["grid_map_msgs/msg/GridMapInfo"](
            resolution=side, length_x=rows * side, length_y=cols * side, pose=pose
        ),
        layers=["elevation"],
        basic_layers=[],
        data=[array],
        outer_start_index=start[0],
        inner_start_index=start[1],
    )
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        kind = "grid_map_msgs/msg/GridMap"
        connection = writer.add_connection("/map", kind, typestore=store)
        writer.write(connection, 0, store.serialize_cdr(message, kind))
    return folder
