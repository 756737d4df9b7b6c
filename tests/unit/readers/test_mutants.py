"""Damaged files: one clear line, or what they still hold; nothing executed, written or hung."""

import os

import numpy as np
import pytest

import reader_files as made
from kaidan.errors import InputError
from kaidan.readers import contents_of, found_in
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source
from kaidan.readers.recognition import recognised

MUTANTS = int(os.environ.get("KAIDAN_MUTANTS", "25"))
CLOUD = made.cloud()
VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0.5]])
FACES = ((0, 1, 2), (0, 2, 3))


def mutants(content, count, seed=0):
    """Bytes flipped, cut off, doubled, set to extremes, most of them near the beginning."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        data = bytearray(content)
        for _ in range(int(rng.integers(1, 6))):
            near = len(data) if rng.random() < 0.3 else min(len(data), 400)
            at = int(rng.integers(0, max(near, 1)))
            match int(rng.integers(0, 5)):
                case 0:
                    data[at : at + 1] = bytes([int(rng.integers(0, 256))])
                case 1:
                    data[at : at + 4] = rng.choice([b"\xff" * 4, b"\0" * 4, b"\x7f\xff\xff\xff"])
                case 2:
                    del data[at : at + int(rng.integers(1, 60))]
                case 3:
                    data[at:at] = data[at : at + int(rng.integers(1, 60))]
                case 4:
                    data[at : at + 1] = rng.choice([b"9", b"-", b"\n", b"(", b"999999999"])
            if not data:
                break
        yield bytes(data)


def small_files(tmp_path):
    yield "pcd", made.pcd(CLOUD), None
    yield "pcd-ascii", made.pcd(CLOUD, "ascii"), None
    yield "pcd-packed", made.pcd(CLOUD, "binary_compressed"), None
    yield "ply", made.ply(CLOUD), None
    yield "ply-ascii", made.ply(CLOUD, "ascii"), None
    yield "npy", made.npy(CLOUD), None
    yield "npz", made.npz(points=CLOUD), None
    yield "table", made.table(CLOUD), None
    yield "las", lambda: made.las(CLOUD), "laspy"
    yield "laz", lambda: made.las(CLOUD, packed=True), "laspy"
    yield "e57", lambda: made.e57(CLOUD, tmp_path / "whole.e57"), "pye57"
    yield "stl", made.stl(VERTICES, FACES), "trimesh"
    yield "stl-text", made.stl_text(VERTICES, FACES), "trimesh"
    yield "obj", made.obj(VERTICES, FACES), "trimesh"
    yield "ply-mesh", made.ply(VERTICES, faces=FACES), "trimesh"
    yield "glb", made.gltf(VERTICES, FACES), "trimesh"
    yield "gltf", made.gltf(VERTICES, FACES, binary=False), "trimesh"
    yield "dae", made.dae(VERTICES, FACES), "collada"
    yield "geotiff", lambda: made.geotiff(np.ones((9, 9)), (0.02, 0.02)), "tifffile"
    yield "bag", lambda: made.ros1_bag(CLOUD, tmp_path / "whole.bag"), "rosbags"
    yield "mcap", lambda: made.ros2_bag(CLOUD, tmp_path / "mcap"), "rosbags"
    yield "db3", lambda: made.ros2_bag(CLOUD, tmp_path / "db3", mcap=False), "rosbags"


NAMES = [name for name, _, _ in small_files(None)]


@pytest.mark.parametrize("name", NAMES)
def test_a_damaged_file_is_one_clear_line(tmp_path, name):
    (content, package) = next(
        (content, package) for each, content, package in small_files(tmp_path) if each == name
    )
    if package:
        pytest.importorskip(package)
    content = content() if callable(content) else content
    folder = tmp_path / "damaged"
    folder.mkdir()
    said = []
    for number, mutant in enumerate(mutants(content, MUTANTS)):
        path = folder / f"{number}"
        path.write_bytes(mutant)
        try:
            source = Source.of(path)
            form = recognised(source)
            if form.reader and form.kind not in ("building", "robot"):
                contents_of(source, form, Hints())
        except InputError as error:
            said.append(str(error))
        path.unlink()
    assert [text for text in said if "\n" in text or len(text) > 700] == []
    assert list(folder.iterdir()) == []  # nothing was written beside them


@pytest.mark.parametrize("name", ["bag", "mcap"])
def test_a_damaged_recording_says_what_is_wrong_with_it(tmp_path, name):
    """Not that closing it failed as well, once it could not be opened."""
    pytest.importorskip("rosbags")
    if name == "bag":
        content, at, size = made.ros1_bag(CLOUD, tmp_path / "whole.bag"), 13, b"\xff" * 4
        said = "cannot be read: .*header"
    else:  # the size of the first record
        content, at, size = made.ros2_bag(CLOUD, tmp_path / "mcap"), 9, b"\xff" * 7 + b"\x3f"
        said = "it states a size beyond the memory"
    path = tmp_path / "damaged"
    path.write_bytes(content[:at] + size + content[at + len(size) :])
    with pytest.raises(InputError, match=f"(?i){said}"):
        found_in(path)
