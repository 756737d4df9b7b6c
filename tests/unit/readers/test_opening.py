"""Files of strangers: sizes checked before memory is taken, nothing followed, one clear line."""

import gzip
import io
import os
import zipfile

import pytest

from kaidan.errors import InputError
from kaidan.readers import found_in
from kaidan.readers.kinds import AXES, upright
from kaidan.readers.opening import Source, split_element
from kaidan.readers.recognition import FORMATS, recognised
from kaidan.readers.xml_tree import parse_xml


def written(tmp_path, content, name="file"):
    path = tmp_path / name
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("axis", AXES)
def test_upright_is_a_rotation_that_lifts_the_axis(axis):
    turn = upright(axis)
    along = [0.0, 0.0, 0.0]
    along["xyz".index(axis[1])] = 1.0 if axis[0] == "+" else -1.0
    assert (turn @ along).tolist() == [0.0, 0.0, 1.0]
    assert (turn @ turn.T).tolist() == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    import numpy as np

    assert np.linalg.det(turn) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"ply\nproperty float scale_0\nproperty float rot_0\nproperty float opacity\n", "splats"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "revit"),
        (b"<?xml version='1.0'?><!-- a --><core:CityModel xmlns:core='x'/>", "citygml"),
        (b"<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:include/>", "xacro"),
        (b"<robot name='r'><link name='${side}_track'/></robot>", "xacro"),
        (b'{"header": {"version": "ifcx_alpha"}, "imports": [], "data": []}', "ifc5"),
        (b'{"header": {"ifcxVersion": "ifcx_alpha"}, "data": []}', "ifc5"),
        (b'{"type": "CityJSON", "version": "2.0"}', "citygml"),
        (b"PXR-USDC\0\0", "usdz"),
        (b"#usda 1.0", "usdz"),
        (gzip.compress(b"NGSP\2\0\0\0", mtime=0), "splats"),
        (b"\x1f\x8b\x08", "archive"),
        (gzip.compress(b"ply", mtime=0), "archive"),
        (b"BZh91AY", "archive"),
        (b"\xfd7zXZ\0", "archive"),
        (b"\0" * 257 + b"ustar\0", "archive"),
    ],
)
def test_what_is_not_read_is_answered_in_one_sentence(tmp_path, content, why):
    found = found_in(written(tmp_path, content, "model.ply"))
    (refusal,) = found.refusals
    assert refusal.why == why
    assert str(refusal).count("\n") == 0
    assert found.provenance.digest == Source.of(tmp_path / "model.ply").digest


COMMENTS = (
    b'<!-- old: <limit lower="${-pi/2}" upper="$(arg upper)"/> -->',
    b"<!-- <xacro:macro name='m'/>\n\n-->",
    b"<!-- never ends ${x}",
)


@pytest.mark.parametrize("comment", COMMENTS)
def test_a_comment_is_no_xacro(tmp_path, comment):
    source = Source.of(
        written(tmp_path, b"<robot name='r'>" + comment + b"<link name='a'/></robot>")
    )
    assert recognised(source).name == "urdf"


def test_archives_are_known_by_what_they_hold(tmp_path):
    for name, why in (("scene.usdc", "usdz"), ("notes.txt", "archive")):
        buffer = io.BytesIO()
        with zipfile.ZipFile(buffer, "w") as archive:
            archive.writestr(name, "x")
        found = found_in(written(tmp_path, buffer.getvalue()))
        assert found.refusals[0].why == why


def test_nonsense_is_refused_in_one_line(tmp_path):
    for path, text in (
        (tmp_path / "nowhere", "cannot be read: No such file"),
        (written(tmp_path, b"", "empty"), "it is empty"),
        (written(tmp_path, b"nonsense", "nonsense"), "its content is of no known format; known:"),
        (tmp_path, "a folder is of no known format"),
        ("/dev/zero", "neither a file nor a folder"),
        ("a\0b", "cannot be read"),
    ):
        with pytest.raises(InputError, match=text) as refused:
            found_in(path)
        assert "\n" not in str(refused.value)


def test_a_header_is_believed_only_as_far_as_the_file_goes(tmp_path):
    source = Source.of(written(tmp_path, b"x" * 100))
    assert len(source.array("<f4", 5, 80)) == 5
    with pytest.raises(InputError, match=r"byte 80: the header states 1000000000 items of 4 bytes"):
        source.array("<f4", 1_000_000_000, 80)
    with pytest.raises(InputError, match="the header states -1 items"):
        source.array("<f4", -1, 80)


def test_xml_bombs_and_documents_from_outside_are_refused():
    bomb = b'<!DOCTYPE a [<!ENTITY b "ha"><!ENTITY c "&b;&b;">]><a>&c;</a>'
    outside = b'<!DOCTYPE a SYSTEM "file:///etc/passwd"><a/>'
    for content in (bomb, outside, bomb.decode().encode("utf-16")):
        with pytest.raises(InputError, match=r"a\.dae, line 1: has a document type \(DOCTYPE\)"):
            parse_xml(content, origin="a.dae")
    with pytest.raises(InputError, match="line 1: more than 200 elements in one another"):
        parse_xml(b"<a>" * 1000, origin="a.dae")
    with pytest.raises(InputError, match="not valid XML"):
        parse_xml(b"<a><b></a>", origin="a.dae")
    assert parse_xml(b"<a> x <b/> y</a>", origin="a.dae").text == " x  y"


def test_zip_bombs_and_damaged_archives_are_refused(tmp_path):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a", b"\0" * 10_000_000)
        archive.writestr("b", b"hello")
    whole = buffer.getvalue()
    source = Source.of(written(tmp_path, whole))
    with pytest.raises(InputError, match="a: 10 MB unpacked are too many"):
        source.member(source.members[0], largest=1000)
    assert source.member(source.members[1]) == b"hello"
    bad = Source.of(written(tmp_path, whole.replace(b"b\xcbH", b"b\xcbX", 1), "bad"))
    with pytest.raises(InputError, match=r"b: (cannot be unpacked|its size)"):
        bad.member(bad.members[1])


def test_elements_are_named_behind_a_mark(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert split_element("model.ifc") == ("model.ifc", "")
    assert split_element("model.ifc#3$A") == ("model.ifc", "3$A")
    written(tmp_path, b"x", "odd#name")
    assert split_element("odd#name") == ("odd#name", "")


def test_every_format_has_a_reader_or_a_refusal():
    for form in FORMATS:
        assert bool(form.reader) != bool(form.refusal)


def test_a_fifo_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="neither a file nor a folder"):
        Source.of(tmp_path / "pipe")
