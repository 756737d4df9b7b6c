"""Every format yields what was written into it; what contradicts itself is one clear line."""

import numpy as np
import pytest

import reader_files as made
from kaidan.errors import InputError
from kaidan.readers import contents_of, found_in
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Heights, Mesh, Points
from kaidan.readers.opening import Source
from kaidan.readers.recognition import recognised

CLOUD = made.cloud()
VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0.5]])
FACES = ((0, 1, 2), (0, 2, 3))


def contents(tmp_path, content, hints=None, name="file.dat"):
    path = tmp_path / name
    path.write_bytes(content)
    source = Source.of(path)
    return contents_of(source, recognised(source), hints or Hints())


@pytest.mark.parametrize("encoding", ["binary", "ascii", "binary_compressed"])
def test_pcd(tmp_path, encoding):
    found = contents(tmp_path, made.pcd(CLOUD, encoding, height=6))
    assert isinstance(found, Points)
    assert found.xyz == pytest.approx(CLOUD)
    assert found.grid == (6, 10)
    assert found.viewpoint == pytest.approx([1, 2, 3])


def test_what_a_sensor_did_not_see_is_nan_in_an_organised_cloud(tmp_path):
    holes = CLOUD.copy()
    holes[3], holes[4] = 0.0, np.nan
    found = contents(tmp_path, made.pcd(holes, height=6))
    assert np.flatnonzero(np.isnan(found.xyz).any(axis=1)).tolist() == [3, 4]
    assert len(contents(tmp_path, made.pcd(holes)).xyz) == len(CLOUD) - 2


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply(tmp_path, encoding):
    assert contents(tmp_path, made.ply(CLOUD, encoding)).xyz == pytest.approx(CLOUD)


def test_npy_and_npz(tmp_path):
    assert contents(tmp_path, made.npy(CLOUD)).xyz == pytest.approx(CLOUD)
    organised = contents(tmp_path, made.npy(CLOUD.reshape(6, 10, 3)))
    assert organised.grid == (6, 10)
    assert contents(tmp_path, made.npz(points=CLOUD, other=CLOUD[:5])).xyz == pytest.approx(CLOUD)
    with pytest.raises(InputError, match="which array is meant\\? name one as its element: a, b"):
        contents(tmp_path, made.npz(a=CLOUD, b=CLOUD))
    named = contents(tmp_path, made.npz(a=CLOUD, b=CLOUD[:7]), Hints(element="b"))
    assert len(named.xyz) == 7


def test_heights_need_the_side_of_their_cells(tmp_path):
    heights = np.arange(120.0).reshape(10, 12)
    with pytest.raises(InputError, match="state the resolution"):
        contents(tmp_path, made.npy(heights))
    found = contents(tmp_path, made.npy(heights), Hints(resolution="2cm"))
    assert isinstance(found, Heights)
    assert found.cell == (0.02, 0.02)


@pytest.mark.parametrize(
    ("separator", "head"),
    [
        (" ", ""),
        (",", "x,y,z\n"),
        (";", ""),
        ("\t", "# made\n"),
        (" ", "60\n"),
        (", ", "//X,Y,Z\n"),
    ],
)
def test_tables(tmp_path, separator, head):
    assert contents(tmp_path, made.table(CLOUD, separator, head)).xyz == pytest.approx(CLOUD)


def test_columns_of_a_table_are_found_by_their_names(tmp_path):
    mixed = np.column_stack([CLOUD[:, 2], CLOUD[:, 0], np.ones(len(CLOUD)), CLOUD[:, 1]])
    found = contents(tmp_path, made.table(mixed, ",", "z,x,red,y\n"))
    assert found.xyz == pytest.approx(CLOUD)


def test_a_bad_row_is_named_by_its_line(tmp_path):
    content = made.table(CLOUD, ",", "x,y,z\n") + b"1,2,three\n"
    with pytest.raises(InputError, match="line 62: no row of numbers"):
        contents(tmp_path, content)


@pytest.mark.parametrize("packed", [False, True])
def test_las(tmp_path, packed):
    pytest.importorskip("laspy")
    found = contents(tmp_path, made.las(CLOUD, packed))
    assert found.xyz == pytest.approx(CLOUD, abs=1e-5)  # the raster of the file
    assert found.provenance.up.value == "+z"


def test_large_las_is_thinned_while_it_is_streamed(tmp_path, monkeypatch):
    """Two points in every cube of 10 mm: one of them is kept."""
    pytest.importorskip("laspy")
    from kaidan.readers.formats import las

    monkeypatch.setattr(las, "WHOLE", 10)
    monkeypatch.setattr(las, "CHUNK", 7)
    grid = np.stack(np.meshgrid(*[np.arange(4) * 0.01 + 0.0012] * 3), axis=-1).reshape(-1, 3)
    found = contents(tmp_path, made.las(np.vstack([grid, grid + 0.002])))
    assert (len(found.xyz), found.total) == (64, 128)


def test_e57(tmp_path):
    pytest.importorskip("pye57")
    found = contents(tmp_path, made.e57(CLOUD, tmp_path / "made.e57"))
    assert found.xyz == pytest.approx(CLOUD)
    with pytest.raises(InputError, match="no scan '7'; it has 1"):
        contents(tmp_path, (tmp_path / "made.e57").read_bytes(), Hints(element="7"))


@pytest.mark.parametrize(
    "content",
    [
        made.stl(VERTICES, FACES),
        made.stl_text(VERTICES, FACES),
        made.obj(VERTICES, FACES),
        made.ply(VERTICES, faces=FACES),
        made.ply(VERTICES, "ascii", faces=FACES),
        made.gltf(VERTICES, FACES),
        made.gltf(VERTICES, FACES, binary=False),
        made.dae(VERTICES, FACES),
    ],
    ids=["stl", "stl-text", "obj", "ply", "ply-ascii", "glb", "gltf", "dae"],
)
def test_meshes(tmp_path, content):
    """A slope of 1 m by 1 m that rises 0.5 m: its area is sqrt(1.25)."""
    pytest.importorskip("trimesh")
    pytest.importorskip("collada")
    found = contents(tmp_path, content)
    assert isinstance(found, Mesh)
    a, b, c = np.moveaxis(found.vertices[found.faces], 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    assert areas.sum() == pytest.approx(1.25**0.5, rel=1e-6)


def test_meshes_say_their_unit_and_up_axis_where_their_format_does(tmp_path):
    pytest.importorskip("trimesh")
    pytest.importorskip("collada")
    inches = contents(tmp_path, made.dae(VERTICES, FACES, unit="0.0254", up="Y_UP")).provenance
    assert (inches.up.value, inches.unit.value, inches.up.how) == ("+y", "m", "file")
    glb = contents(tmp_path, made.gltf(VERTICES, FACES)).provenance
    assert (glb.up.value, glb.unit.value, glb.up.how) == ("+y", "m", "format")
    stl = contents(tmp_path, made.stl(VERTICES, FACES), Hints(unit="mm")).provenance
    assert (stl.up, stl.unit.value, stl.unit.how) == (None, "mm", "person")


def test_geometry_in_another_file_is_not_opened(tmp_path):
    pytest.importorskip("trimesh")
    (tmp_path / "data.bin").write_bytes(b"\0" * 1000)
    with pytest.raises(InputError, match=r"stands in another file, 'data.bin', .* save it as GLB"):
        contents(tmp_path, made.gltf(VERTICES, FACES, binary=False, uri="data.bin"))


def test_geotiff(tmp_path):
    pytest.importorskip("tifffile")
    heights = np.arange(12.0).reshape(3, 4)
    found = contents(tmp_path, made.geotiff(heights, (0.02, 0.03), missing=5))
    assert found.cell == (0.03, 0.02)
    assert np.isnan(found.z[1, 1])  # north is the first row of the file and the last one here
    assert found.z[0].tolist() == [8, 9, 10, 11]


def test_clouds_in_bags(tmp_path):
    pytest.importorskip("rosbags")
    for content in (
        made.ros1_bag(CLOUD, tmp_path / "made.bag"),
        made.ros2_bag(CLOUD, tmp_path / "mcap"),
        made.ros2_bag(CLOUD, tmp_path / "db3", mcap=False),
    ):
        found = contents(tmp_path, content)
        assert found.xyz == pytest.approx(CLOUD)
        assert found.provenance.element == "/points"
    folder = Source.of(tmp_path / "mcap")
    assert contents_of(folder, recognised(folder)).xyz == pytest.approx(CLOUD)
    with pytest.raises(InputError, match="no topic '/odd' can be read; known: /points"):
        contents(tmp_path, content, Hints(element="/odd"))


@pytest.mark.parametrize("start", [(0, 0), (2, 1)])
def test_grid_maps_in_bags(tmp_path, start):
    """Row of the map: y from small to large; column: x; the message counts both downwards."""
    pytest.importorskip("rosbags")
    falling = np.array([[5.0, 4.0, 3.0], [2.0, 1.0, 0.0], [9.0, 8.0, 7.0], [6.0, 6.5, 6.7]])
    source = Source.of(made.grid_map_bag(falling, 0.03, tmp_path / "map", start))
    found = contents_of(source, recognised(source))
    assert isinstance(found, Heights)
    assert found.cell == (0.03, 0.03)
    assert found.z == pytest.approx(falling[::-1, ::-1].T)


@pytest.mark.parametrize(
    ("content", "text"),
    [
        (made.pcd(CLOUD).replace(b"WIDTH 60", b"WIDTH 1000000000"), "is not POINTS"),
        (
            made.pcd(CLOUD).replace(b"60\n", b"1000000000\n"),
            "the header states 1000000000 items of 16 bytes; only 960",
        ),
        (made.pcd(CLOUD).replace(b"DATA binary", b"DATA odd"), "DATA is none of ascii, binary"),
        (made.pcd(CLOUD).replace(b"FIELDS x", b"FIELDS q"), "no field x"),
        (made.pcd(CLOUD, "ascii").rsplit(b"\n", 2)[0], "59 points, not the 60"),
        (made.pcd(CLOUD, "binary_compressed")[:-20], "the header states"),
        (made.ply(CLOUD).replace(b"vertex 60", b"vertex 999999999"), "999999999 items of 13 bytes"),
        (made.npy(np.array([object()])), "only pickle reads"),
        (made.npy(np.zeros((2, 2))), "neither \\(n, 3\\) points nor rows of heights"),
        (made.npy(np.array(["a", "b"])), "holds no lengths"),
    ],
)
def test_contradictions(tmp_path, content, text):
    with pytest.raises(InputError, match=text) as refused:
        contents(tmp_path, content)
    assert "\n" not in str(refused.value)


def test_blank_lines_among_the_points_are_passed_over(tmp_path):
    """What numpy says of them would stand beside the answer."""
    for name, content in (("a.pcd", made.pcd(CLOUD, "ascii")), ("a.ply", made.ply(CLOUD, "ascii"))):
        lines = content.split(b"\n")
        path = tmp_path / name
        path.write_bytes(b"\n".join([*lines[:-3], b"", b"  ", *lines[-3:]]))
        source = Source.of(path)
        assert len(contents_of(source, recognised(source), Hints()).xyz) == len(CLOUD)


def test_a_sensor_farther_off_than_any_is_refused(tmp_path):
    """A number of the header that was mistyped: no sensor is 10,000 sizes of its cloud away."""
    path = tmp_path / "far.pcd"
    path.write_bytes(made.pcd(made.cloud(), viewpoint="1 2 1e300 1 0 0 0"))
    with pytest.raises(InputError, match=r"the sensor stands 1e\+300 away from all of its points$"):
        found_in(path)


def test_zeros_for_a_viewpoint_of_a_cloud_far_from_its_origin_say_nothing(tmp_path):
    path = tmp_path / "utm.pcd"
    path.write_bytes(made.pcd(made.cloud() + 4e6, viewpoint="0 0 0 1 0 0 0"))
    assert contents_of(Source.of(path), recognised(Source.of(path))).viewpoint is None
