"""Mutants of small valid files of every kind: each is answered or refused, and nothing is left."""

import os
import random

import numpy as np
import pytest

import reader_files as files
from ifc_cases import half_turn_house
from kaidan.web.workers import Limits
from robot_files import tank_mjcf, tank_sdf, tank_urdf
from serving import served

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]], dtype=float)
FACES = [[0, 1, 2], [0, 2, 3]]


def seeds():
    """Small valid files."""
    xyz = files.cloud()
    made = [
        files.pcd(xyz), files.pcd(xyz, "binary_compressed"), files.ply(xyz), files.npy(xyz),
        files.npz(a=xyz), files.table(xyz), files.las(xyz), files.stl(VERTICES, FACES),
        files.stl_text(VERTICES, FACES), files.obj(VERTICES, FACES), files.gltf(VERTICES, FACES),
        files.dae(VERTICES, FACES), files.geotiff(np.zeros((9, 9), "f4"), (0.1, 0.1)),
        tank_urdf(), tank_sdf(), tank_mjcf(), half_turn_house(),
    ]  # fmt: skip
    return [_bytes(each) for each in made]


def _bytes(content):
    if isinstance(content, bytes):
        return content
    return (content if isinstance(content, str) else content.file.to_string()).encode()


def mutant(rng, content):
    """A file with something cut, doubled, overwritten, or put in."""
    data = bytearray(content)
    for _ in range(rng.randint(1, 4)):
        at, size = rng.randrange(len(data) + 1), rng.choice((1, 4, 64, 1000))
        how = rng.randrange(5)
        if how == 0:
            del data[at:]
        elif how == 1:
            data[at : at + size] = rng.randbytes(min(size, len(data)))
        elif how == 2:
            data[at:at] = data[at : at + size] * rng.choice((1, 50))
        elif how == 3:
            data[at : at + 8] = rng.choice((b"\xff" * 8, b"\0" * 8, b"99999999", b"-1e308  "))
        else:
            data[at:at] = rng.choice((b"&x;", b"../../", b"[[[[", b"<a>", b"NaN", b"\n" * size))
        data = data or bytearray(b"x")
    return bytes(data)


def send(count, folder):
    rng = random.Random(2000)
    valid = seeds()
    statuses = dict.fromkeys(("answered", "refused"), 0)
    with served(state=folder, limits=Limits(file_seconds=10.0)) as client:
        for _ in range(count):
            content = mutant(rng, rng.choice(valid))
            place = rng.choice(("read", "read", "sheets", "building"))
            fields = {"robots": "kenaf"} if place == "building" else {}
            answer = client.post(
                f"/api/{place}", files={"file": ("/etc/passwd", content)}, data=fields
            )
            assert answer.status_code in (200, 422), (answer.text, place, content[:200])
            statuses["answered" if answer.status_code == 200 else "refused"] += 1
            assert "passwd" not in answer.text
            assert str(folder) not in answer.text
        left = [each for each in (folder / "passing").rglob("*") if each.is_file()]
        assert left == []
        assert client.get("/api/catalogue").status_code == 200
    assert min(statuses.values()) > 0


def test_some_hostile_uploads(tmp_path):
    send(30, tmp_path)


@pytest.mark.slow
def test_two_thousand_hostile_uploads(tmp_path):
    send(int(os.environ.get("KAIDAN_EXAMPLES", "2000")), tmp_path)
