"""A question as a short text: for a QR code on paper, and to put the same question again.

The question's JSON without what changes no answer (sources, notes, full names), deflated, in base
32: letters and digits alone, which a QR code holds most of.
"""

import zlib
from base64 import b32decode, b32encode
from typing import Any

from kaidan import catalog
from kaidan.errors import InputError, shown
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.sheet import Sheet
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

HEAD = "KAIDAN1-"
"""How a code begins: the number is that of its form."""
LARGEST = 1_000_000
"""Largest question that a code is unpacked to [bytes]."""
_LEFT_OUT = ("sources", "notes", "title")
_FOLDERS: dict[type[Sheet], tuple[str, ...]] = {
    Robot: ("robots", "unweighed"),
    Stairs: ("stairs",),
    Surface: ("surfaces",),
}


def code_of(question: Question) -> str:
    """Code of a question.

    Returns
    -------
    str
        ``HEAD``, then capital letters and digits.

    Examples
    --------
    >>> question = Question.of("kenaf", "ibc", friction=0.8)
    >>> question_of(code_of(question)) == question
    True
    """
    plain = _without(question.model_dump(mode="json", exclude_defaults=True))
    import json

    text = json.dumps(plain, separators=(",", ":"), ensure_ascii=True)
    return HEAD + b32encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")


def question_of(code: str) -> Question:
    """Question of a code; a sheet that the catalogue has too comes with its sources.

    Parameters
    ----------
    code : str
        As `code_of` wrote it; spaces and line breaks do not count, nor do small letters.

    Raises
    ------
    InputError
        A text that is no code, or of a question that this version does not take.
    """
    text = "".join(code.split()).upper()
    if not text.startswith(HEAD):
        raise InputError(f"code {shown(code)} does not begin with {HEAD}")
    packed = text.removeprefix(HEAD)
    try:
        unpack = zlib.decompressobj()
        plain = unpack.decompress(b32decode(packed + "=" * (-len(packed) % 8)), LARGEST)
        if not unpack.eof:
            raise ValueError("not whole")
        question = Question.model_validate_json(plain)
    except InputError as error:
        raise InputError(f"code {shown(code)}: {error}") from None
    except ValueError:  # of base 32, too; zlib has an error of its own
        raise InputError(f"code {shown(code)} is damaged or not whole") from None
    except zlib.error:
        raise InputError(f"code {shown(code)} is damaged or not whole") from None
    return question.changed(
        robot=_whole(question.robot),
        terrain=tuple(map(_whole, question.terrain))
        if isinstance(question.terrain, tuple)
        else _whole(question.terrain),
        surface=_whole(question.surface),
    )


def _without(value: Any) -> Any:
    """JSON value without what changes no answer."""
    if isinstance(value, dict):
        return {key: _without(each) for key, each in value.items() if key not in _LEFT_OUT}
    return [_without(each) for each in value] if isinstance(value, list) else value


def _whole(sheet: Any) -> Any:
    """Sheet of the catalogue with the same name and the same figures, else the one given."""
    for folder in _FOLDERS.get(type(sheet), ()):
        if sheet.name in catalog.names(folder):
            known = type(sheet).named(sheet.name)
            left_out = dict.fromkeys(_LEFT_OUT, True)
            if known.model_dump(exclude=left_out) == sheet.model_dump(exclude=left_out):
                return known
    return sheet
