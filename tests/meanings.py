"""Files whose meaning is changed: a number dropped, a name emptied, a count 0; the rest is sound.

Bytes at random mostly end at a reader's first look. These changes pass it: archives, headers and
trees stay what they are, and one of the things that they say is another one.
"""

import io
import json
import re
import struct
import zipfile
from contextlib import suppress
from warnings import catch_warnings, simplefilter

NUMBER = re.compile(rb"(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")
QUOTED = re.compile(rb"\"[^\"\n]*\"|'[^'\n]*'")
ELEMENT = re.compile(rb"<(\w+)[^<>]*/>|<(\w+)[^<>]*>[^<>]*</\2>")
ARGUMENT = re.compile(rb"(?<=[(,])[^(),']*(?=[),])")
NUMBERS = (b"", b"0", b"-1", b"1", b"0.0", b"1e308", b"-1e-308", b"nan", b"inf", b"9" * 30, b"2.5",
           b"x", b"100000", b"3", b"-0.5")  # fmt: skip
NAMES = (b"", b"\0", b"a" * 300, b"x", b"..", b"#", b"-", b"0")
SWAPPED = (0, 1, 2, 3, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF)
VALUES = (None, 0, 1, -1, 2, 1e308, 10**400, "", "x", [], {}, True, [0], 2**31, 0.5)


def mutant(content, rng):
    """One to three things that a file says, said differently."""
    for _ in range(int(rng.integers(1, 4))):
        content = _changed(content, rng)
    return content


def _changed(content, rng):
    if content.startswith(b"PK\x03\x04"):
        with suppress(zipfile.BadZipFile), catch_warnings():
            simplefilter("ignore")  # of names that stand twice
            return _archive(content, rng)
        return content
    if content.startswith(b"glTF"):
        return _glb(content, rng)
    if content.startswith((b"II*\0", b"MM\0*")):
        return _tiff(content, rng)
    if content.startswith(b"ASTM-E57"):
        return _e57(content, rng)
    if content.startswith(b"LASF"):
        return _fields(content, rng, 375)
    if content.startswith(b"\x93NUMPY"):
        return _headed(content, rng, 10, 10 + int.from_bytes(content[8:10], "little"), True)
    for end in (b"end_header\n", b"DATA binary\n", b"DATA binary_compressed\n"):
        if end in content[:3000]:
            return _headed(content, rng, 0, content.index(end) + len(end), False)
    if content.lstrip()[:1] == b"{":
        return json.dumps(_tree(json.loads(content), rng)).encode()
    if b"\0" in content[:3000]:
        return _fields(content, rng, len(content))
    return _text(content, rng)


def _text(content, rng):
    """Text with a number, a name, an element, an argument or a line changed."""
    kind = int(rng.integers(0, 7))
    if kind in (0, 1):
        return _replaced(content, rng, NUMBER, NUMBERS)
    if kind == 2:
        quote = (b'"', b"'")[int(rng.integers(0, 2))]
        return _replaced(content, rng, QUOTED, [quote + name + quote for name in NAMES])
    if kind == 3:
        return _replaced(content, rng, ELEMENT, (b"",))
    if kind == 4:
        others = [each.group() for each in ARGUMENT.finditer(content)][:2000]
        return _replaced(content, rng, ARGUMENT, [b"$", b"*", b"''", b"0.", b"()", *others])
    lines = content.split(b"\n")
    at, other = rng.integers(0, len(lines), 2).tolist()
    if kind == 5:
        del lines[at]
    else:
        lines[at] = lines[other]
    return b"\n".join(lines)


def _replaced(content, rng, pattern, by):
    found = list(pattern.finditer(content))
    if not found:
        return content
    one = found[int(rng.integers(0, len(found)))]
    return content[: one.start()] + by[int(rng.integers(0, len(by)))] + content[one.end() :]


def _headed(content, rng, begin, end, padded):
    """A header of text before what is not text; one of NPY keeps its length."""
    head = _text(content[begin:end], rng)
    if padded:
        head = head.strip()[: end - begin - 1].ljust(end - begin - 1) + b"\n"
    return content[:begin] + head + content[end:]


def _fields(content, rng, reach):
    """A whole number of two, four or eight bytes set to another one."""
    size = int(rng.choice([2, 4, 8]))
    at = int(rng.integers(0, max(1, min(reach, len(content)) - size)))
    value = SWAPPED[int(rng.integers(0, len(SWAPPED)))] & (256**size - 1)
    return content[:at] + value.to_bytes(size, "little") + content[at + size :]


def _archive(content, rng):
    """An archive with a member renamed, emptied, doubled, left out, or changed itself."""
    made = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(made, "w") as new:
        kind, infos = int(rng.integers(0, 5)), old.infolist()
        chosen = int(rng.integers(0, max(1, len(infos))))
        for number, info in enumerate(infos):
            name, inner = info.filename, old.read(info)
            if number == chosen:
                if kind == 0:
                    name = ("x.npy", "a/", ".npy", "a/b.npy", "é.npy")[int(rng.integers(0, 5))]
                elif kind == 1:
                    inner = b""
                elif kind == 2:
                    new.writestr("again.npy", inner)
                elif kind == 3 and len(infos) > 1:
                    continue
                else:
                    inner = _changed(inner, rng) if inner else inner
            new.writestr(zipfile.ZipInfo(name), inner)
    found = made.getvalue()
    if rng.random() < 0.2:  # the name of an entry, emptied where it stands
        name = zipfile.ZipFile(io.BytesIO(found)).namelist()
        found = found.replace(name[0].encode(), b"\0" * len(name[0].encode())) if name else found
    return found


def _tree(tree, rng):
    """JSON with one of its values another one, or left out."""
    places = []

    def walk(at):
        for key in at if isinstance(at, dict) else range(len(at)):
            places.append((at, key))
            if isinstance(at[key], dict | list):
                walk(at[key])

    walk(tree)
    if places:
        at, key = places[int(rng.integers(0, len(places)))]
        if rng.random() < 0.3:
            del at[key]
        else:
            at[key] = VALUES[int(rng.integers(0, len(VALUES)))]
    return tree


def _glb(content, rng):
    length = int.from_bytes(content[12:16], "little")
    text = json.dumps(_tree(json.loads(content[20 : 20 + length]), rng)).encode()
    text += b" " * (-len(text) % 4)
    rest = content[20 + length :]
    head = struct.pack("<II", 2, 20 + len(text) + len(rest))
    return b"glTF" + head + struct.pack("<I", len(text)) + b"JSON" + text + rest


def _tiff(content, rng):
    """One entry of the first directory with another tag, type, count or value."""
    order = "little" if content[:2] == b"II" else "big"
    at = int.from_bytes(content[4:8], order)
    count = int.from_bytes(content[at : at + 2], order)
    entry = at + 2 + 12 * int(rng.integers(0, max(1, min(count, 60))))
    part, size = ((0, 2), (2, 2), (4, 4), (8, 4))[int(rng.integers(0, 4))]
    value = SWAPPED[int(rng.integers(0, len(SWAPPED)))] & (256**size - 1)
    place = entry + part
    return content[:place] + value.to_bytes(size, order) + content[place + size :]


def _e57(content, rng):
    """The XML of an E57 file changed, its pages with sums that fit."""
    page, body = 1024, 1020
    pages = [content[at : at + body] for at in range(0, len(content), page)]
    whole = b"".join(pages)
    _, begin, length = struct.unpack_from("<QQQ", content, 16)
    at = begin // page * body + begin % page
    text = _text(whole[at : at + length], rng)[:length].ljust(length)
    whole = whole[:at] + text + whole[at + length :]
    return b"".join(
        part + struct.pack(">I", crc32c(part))
        for part in (whole[k : k + body] for k in range(0, len(whole), body))
    )


def crc32c(data):
    """Castagnoli's sum of bytes, which E57 has for its pages."""
    value = 0xFFFFFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = (value >> 1) ^ (0x82F63B78 if value & 1 else 0)
    return value ^ 0xFFFFFFFF
