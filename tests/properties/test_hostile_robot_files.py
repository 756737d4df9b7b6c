"""Robots' files of strangers: found, refused, or one clear line; nothing else, and soon."""

import builtins
import io
import os
import random
import time

import pytest

from kaidan.errors import InputError
from kaidan.readers import found_in
from robot_files import tank_mjcf, tank_sdf, tank_urdf, urdf, urdf_link, urdf_shape

DIALECTS = {
    "urdf": tank_urdf(body=urdf_shape('<mesh filename="../../etc/passwd"/>')),
    "sdf": tank_sdf(),
    "sdf-1.9": tank_sdf("1.9", relative=True),
    "mjcf": tank_mjcf(),
}
MUTANTS = int(os.environ.get("KAIDAN_MUTANTS", "250"))
"""Mutants of each dialect; the slow test takes 2,000."""
NASTY = [
    b"1e308", b"-1e308", b"nan", b"inf", b"-0", b"", b"9" * 400, b"\x00", b"\xff\xfe", b"&amp;",
    b"&lt;!", b"<", b">", b"/>", b"<link/>", b"<model/>", b"world", b"__model__", b"base_link",
    b"0 0 0", b"1e-320", b"<joint/>", b"%s%n", b"<body/>", b"<geom/>", b"<frame/>",
]  # fmt: skip


def outcome(path):
    """What became of a file; anything but a result or one clear line fails."""
    start = time.perf_counter()
    try:
        found = found_in(path)
        for one in found.robots:
            one.robot()
        text = ""
    except InputError as error:
        text = str(error)
        assert text.startswith(str(path)), text
        assert "\n" not in text
        assert len(text) < 300
    assert time.perf_counter() - start < 20.0  # some seconds on a busy machine, never minutes
    return text


def mutant(content, rng):
    content = bytearray(content)
    for _ in range(rng.randint(1, 4)):
        at, kind = rng.randrange(len(content)), rng.randrange(5)
        length = rng.randint(1, 60)
        if kind == 0:
            content[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            del content[at : at + length]
        elif kind == 2:
            content[at:at] = content[at : at + length]
        elif kind == 3:
            content[at : at + rng.randint(0, 12)] = rng.choice(NASTY)
        else:  # an attribute or a text gets another value: the file stays well-formed
            quotes = [k for k, byte in enumerate(content) if byte in b'"><']
            one = rng.randrange(len(quotes) - 1)
            content[quotes[one] + 1 : quotes[one + 1]] = rng.choice(NASTY)
    return bytes(content)


def try_mutants(tmp_path, dialect, count):
    rng = random.Random(dialect)
    path = tmp_path / "mutant"
    for _ in range(count):
        path.write_bytes(mutant(DIALECTS[dialect], rng))
        outcome(path)


@pytest.mark.parametrize("dialect", DIALECTS)
def test_mutants_end_in_a_result_or_one_line(tmp_path, dialect):
    try_mutants(tmp_path, dialect, MUTANTS)


@pytest.mark.slow
@pytest.mark.parametrize("dialect", DIALECTS)
def test_two_thousand_mutants(tmp_path, dialect):
    try_mutants(tmp_path, dialect, 2000)


LAUGHS = "".join(f'<!ENTITY l{k} "{f"&l{k - 1};" * 10}">' for k in range(1, 10))
BOMBS = {
    "entities": f'<!DOCTYPE robot [<!ENTITY l0 "ha">{LAUGHS}]><robot name="r">&l9;</robot>',
    "external": '<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot>&x;</robot>',
    "type alone": '<!DOCTYPE robot SYSTEM "http://example.invalid/r.dtd"><robot name="r"/>',
    "deep": "<robot>" + "<link>" * 100_000 + "</link>" * 100_000 + "</robot>",
    "unclosed": "<robot>" + "<link name='a'>" * 150,
    "many": "<robot>" + "<a/>" * 400_000 + "</robot>",
    "digits": "<robot name='r'><link name='a'><inertial><mass value='" + "9" * 1_000_000 + "'/>"
    "</inertial></link></robot>",
    "long name": "<robot name='r'><link name='" + "a" * 1_000_000 + "'/><joint name='j' "
    "type='fixed'><parent link='x'/><child link='y'/></joint></robot>",
    "include in SDF": "<sdf version='1.6'><model name='m'><include><uri>file:///etc/passwd</uri>"
    "</include></model></sdf>",
    "include in MJCF": "<mujoco><include file='../../../etc/passwd'/><worldbody/></mujoco>",
    "model in MJCF": "<mujoco><asset><model name='m' file='/etc/passwd'/></asset></mujoco>",
    "replicas": "<mujoco><worldbody><body><replicate count='1000000000'><geom size='1'/>"
    "</replicate></body></worldbody></mujoco>",
    "frames in a circle": "<sdf version='1.9'><model name='m'><link name='a'><pose "
    "relative_to='b'/></link><link name='b'><pose relative_to='a'/></link></model></sdf>",
}


@pytest.mark.parametrize("bomb", BOMBS.values(), ids=BOMBS)
def test_bombs_end_with_one_line(tmp_path, bomb):
    path = tmp_path / "bomb"
    path.write_text(bomb)
    assert outcome(path)


def test_nothing_is_opened_but_the_file_itself(tmp_path, monkeypatch):
    """Meshes, includes and entities name files outside and inside; none of them is touched."""
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "body.stl").write_text("solid")
    opened, system = [], io.open

    def watched(file, *args, **kwargs):
        opened.append(str(file))
        return system(file, *args, **kwargs)

    monkeypatch.setattr(builtins, "open", watched)
    monkeypatch.setattr(io, "open", watched)
    for name in ("../../../etc/passwd", "meshes/body.stl", "package://robot/body.stl", "/dev/zero"):
        shape = urdf_shape(f'<mesh filename="{name}"/>')
        path = tmp_path / "robot.urdf"
        path.write_bytes(urdf(urdf_link("base", shapes=shape)))
        opened.clear()
        found_in(path)
        assert set(opened) <= {str(path)}


def test_thousands_of_links_and_shapes_take_seconds_at_most(tmp_path):
    shapes = urdf_shape('<cylinder radius="0.05" length="0.1"/>', "0 0 0", "0.3 0.2 0.1") * 3
    links = "".join(urdf_link(f"l{k}_track", shapes=shapes) for k in range(1500))
    path = tmp_path / "robot.urdf"
    path.write_bytes(urdf(links))
    outcome(path)
