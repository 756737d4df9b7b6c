"""Damaged files: one clear line, or what they still hold; nothing executed, written or hung.

Half of the mutants have other bytes, half another meaning (`meanings`). What they still hold is
read to the end: interpreted, put into words, JSON and sheets.
"""

import os

import numpy as np
import pytest

import meanings
import reader_files as made
from kaidan.errors import InputError
from kaidan.readers import found_in
from sound_files import NAMES, read_all, sound_files

MUTANTS = int(os.environ.get("KAIDAN_MUTANTS", "12"))
"""Of each format; the slow test has 500."""
CLOUD = made.cloud()


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


def try_mutants(tmp_path, name, count, seed):
    content, package = next(
        (content, package) for each, package, content in sound_files(tmp_path) if each == name
    )
    if package:
        pytest.importorskip(package)
    content = content()
    folder = tmp_path / "damaged"
    folder.mkdir()
    path = folder / "file"
    by_bytes = mutants(content, count // 2, seed)
    by_meaning = (meanings.mutant(content, np.random.default_rng([seed, k])) for k in range(count))
    for number, mutant in enumerate([*by_bytes, *by_meaning][:count]):
        path.write_bytes(mutant)
        text = read_all(path)
        assert text.isprintable(), (number, text)
        assert len(text) < 300, (number, text)
        path.unlink()
        assert list(folder.iterdir()) == []  # nothing was written beside it


@pytest.mark.parametrize("name", [name for name in NAMES if name != "ifc"])
def test_a_damaged_file_is_one_clear_line(tmp_path, name):
    try_mutants(tmp_path, name, MUTANTS, seed=1)


def test_a_damaged_building_is_one_clear_line(tmp_path):
    """Each is a process of its own."""
    try_mutants(tmp_path, "ifc", min(MUTANTS, 6), seed=1)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_five_hundred_damaged_files(tmp_path, name):
    try_mutants(tmp_path, name, 100 if name == "ifc" else 500, seed=2)


CASES = {
    "an OBJ with two coordinates": (b"v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n", "trimesh",
                                    "its vertices have 2 coordinates"),
    "an entry without a name": (lambda: nameless(), "", "an entry of the archive has no name"),
    "an image without width": (lambda: without_width(), "tifffile",
                               "its 0 cells are not the (5, 0) that it states"),
}  # fmt: skip


def nameless():
    """An archive whose directory names its one entry with nothing."""
    whole = made.npz(a=made.cloud(9))
    at = whole.index(b"PK\x01\x02")
    cut = whole[: at + 28] + b"\0\0" + whole[at + 30 : at + 46] + whole[at + 46 + 5 :]
    end = cut.index(b"PK\x05\x06")
    size = int.from_bytes(cut[end + 12 : end + 16], "little") - 5
    return cut[: end + 12] + size.to_bytes(4, "little") + cut[end + 16 :]


def without_width():
    """A GeoTIFF of five rows whose first entry, the width, is 0."""
    whole = made.geotiff(np.ones((5, 5)), (0.02, 0.02))
    at = int.from_bytes(whole[4:8], "little") + 2
    assert int.from_bytes(whole[at : at + 2], "little") == 256
    return whole[: at + 8] + b"\0\0\0\0" + whole[at + 12 :]


@pytest.mark.parametrize("case", CASES)
def test_plain_damage_is_an_input_error(tmp_path, case, capfd):
    content, package, said = CASES[case]
    if package:
        pytest.importorskip(package)
    path = tmp_path / "file"
    path.write_bytes(content() if callable(content) else content)
    with pytest.raises(InputError) as raised:
        found_in(path)
    assert str(raised.value) == f"{path}: {said}"
    assert capfd.readouterr().err == ""  # what a library logs is not said


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
