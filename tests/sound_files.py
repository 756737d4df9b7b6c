"""Sound files of every format that is read, most with stairs or a robot; and how to read one."""

import numpy as np

import kaidan
import reader_files as made
from robot_files import tank_mjcf, tank_sdf, tank_urdf


def stairs(steps=5, rise=0.17, going=0.28, wide=0.9, count=220, seed=3):
    """Points on straight stairs and the floor before them, shape (n, 3) [m]."""
    rng, parts = np.random.default_rng(seed), []
    for k in range(steps):
        s, t = going * (k + rng.random(count)), wide * rng.random(count)
        parts.append(np.column_stack([s, t, np.full(count, (k + 1) * rise)]))
        t, z = wide * rng.random(count // 2), rise * (k + rng.random(count // 2))
        parts.append(np.column_stack([np.full(count // 2, k * going), t, z]))
    parts.append(np.column_stack([-0.9 * rng.random(count), wide * rng.random(count),
                                  np.zeros(count)]))  # fmt: skip
    return (np.vstack(parts) + 0.01).astype("<f4")


def mesh(steps=5, rise=0.17, going=0.28, wide=0.9):
    """Treads and faces of straight stairs, and the floor before them, as a drawn mesh."""
    corners, faces = [], []

    def sheet(a, b, c, d):
        at = len(corners)
        corners.extend([a, b, c, d])
        faces.extend([(at, at + 1, at + 2), (at, at + 2, at + 3)])

    sheet((-1, 0, 0), (0, 0, 0), (0, wide, 0), (-1, wide, 0))
    for k in range(steps):
        s, z = k * going, k * rise
        sheet((s, 0, z), (s, 0, z + rise), (s, wide, z + rise), (s, wide, z))
        end = s + (1.2 if k == steps - 1 else going)
        sheet((s, 0, z + rise), (end, 0, z + rise), (end, wide, z + rise), (s, wide, z + rise))
    return np.array(corners, float), tuple(faces)


def map_of_heights(cell=0.02):
    """Heights of straight stairs, shape (50, 100) [m]."""
    s = np.arange(100) * cell - 0.5
    z = np.clip(np.floor(s / 0.28) + 1, 0, 5) * 0.17
    return np.repeat(z[None, :], 50, axis=0) + np.random.default_rng(0).normal(0, 1e-3, (50, 100))


def house():
    from ifc_cases import House, monolith, regular

    made = House("IFC4", "m", storeys=((0.0, "a"), (0.85, "b")))
    flight = made.add("IfcStairFlight", "one", [monolith(made, *regular(5, 0.17, 0.28))])
    made.properties(flight, "Pset_StairFlightCommon", NumberOfRiser=5, RiserHeight=0.17)
    return made


def sound_files(folder):
    """Name, package that writes or reads it, and a function that gives the content."""
    points, (vertices, faces) = stairs(), mesh()
    yield "urdf", "", tank_urdf
    yield "sdf", "", tank_sdf
    yield "sdf-1.9", "", lambda: tank_sdf("1.9", relative=True)
    yield "mjcf", "", tank_mjcf
    yield "pcd", "", lambda: made.pcd(points)
    yield "pcd-ascii", "", lambda: made.pcd(points, "ascii")
    yield "pcd-packed", "", lambda: made.pcd(points, "binary_compressed")
    yield "ply", "", lambda: made.ply(points)
    yield "ply-ascii", "", lambda: made.ply(points, "ascii")
    yield "npy", "", lambda: made.npy(points)
    yield "npz", "", lambda: made.npz(points=points)
    yield "npz-pair", "", lambda: made.npz(one=made_small(), two=made_small())
    yield "table", "", lambda: made.table(points, head="x y z\n")
    yield "csv", "", lambda: made.table(points, separator=",", head="x,y,z\n")
    yield "las", "laspy", lambda: made.las(points)
    yield "laz", "laspy", lambda: made.las(points, packed=True)
    yield "e57", "pye57", lambda: made.e57(points, folder / "whole.e57")
    yield "stl", "trimesh", lambda: made.stl(vertices, faces)
    yield "stl-text", "trimesh", lambda: made.stl_text(vertices, faces)
    yield "obj", "trimesh", lambda: made.obj(vertices, faces)
    yield "ply-mesh", "trimesh", lambda: made.ply(vertices, faces=faces)
    yield "ply-mesh-text", "trimesh", lambda: made.ply(vertices, "ascii", faces=faces)
    yield "glb", "trimesh", lambda: made.gltf(vertices[:, [1, 2, 0]], faces)
    yield "gltf", "trimesh", lambda: made.gltf(vertices[:, [1, 2, 0]], faces, binary=False)
    yield "dae", "collada", lambda: made.dae(vertices, faces)
    yield "geotiff", "tifffile", lambda: made.geotiff(map_of_heights(), (0.02, 0.02), missing=-9999)
    yield "bag", "rosbags", lambda: made.ros1_bag(points, folder / "whole.bag")
    yield "mcap", "rosbags", lambda: made.ros2_bag(points, folder / "mcap")
    yield "db3", "rosbags", lambda: made.ros2_bag(points, folder / "db3", mcap=False)
    yield "ifc", "ifcopenshell", lambda: house().write(folder / "sound.ifc").read_bytes()


def made_small():
    return made.cloud(30)


NAMES = [name for name, _, _ in sound_files(None)]


def read_all(path):
    """What the command `read` makes of a file: answer, text, JSON, sheets; the error's text."""
    try:
        found = kaidan.read(path)
        str(found)
        found.to_json()
        if found.exit_code == 0 and (found.robots or len(found.staircases) == 1):
            [sheet.to_toml() for sheet in found.sheets().values()]
    except kaidan.KaidanError as error:
        return str(error)
    return ""
