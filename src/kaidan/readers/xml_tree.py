"""XML as a tree of elements with their lines; nothing but the text itself is ever read.

A file from somebody else may name other files, define entities that grow without end or nest
without end. The parser is the one of Python's own library; a document type, and with it every
entity, is refused, and so is what no description of a robot or a mesh needs.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NoReturn
from xml.parsers import expat

from kaidan.errors import InputError, short, shown

DEEPEST = 200
"""Elements within elements."""
MOST_ELEMENTS = 300_000
LARGEST_NUMBER = 1e9
"""Largest number that is taken for one."""


@dataclass
class Element:
    """An element: its tag, attributes, text and what is in it."""

    tag: str
    attributes: dict[str, str]
    line: int
    origin: str
    """What errors call the file."""
    text: str = ""
    children: list["Element"] = field(default_factory=list)

    def find(self, tag: str) -> "Element | None":
        """First child of a tag."""
        return next(self.all(tag), None)

    def all(self, *tags: str) -> Iterator["Element"]:
        """Children of these tags, in order."""
        return (child for child in self.children if child.tag in tags)

    def descendants(self) -> Iterator["Element"]:
        """Element itself and all that is in it, in order."""
        yield self
        for child in self.children:
            yield from child.descendants()

    def required(self, tag: str) -> "Element":
        """First child of a tag that has to be there."""
        found = self.find(tag)
        if found is None:
            self.refuse(f"<{tag}> is missing")
        return found

    def name(self, attribute: str = "name") -> str:
        """Attribute that has to be there."""
        value = self.attributes.get(attribute, "").strip()
        if not value:
            self.refuse(f"{attribute} is missing")
        return value

    def word(self, tag: str) -> str:
        """Text of the first child of a tag; empty without one."""
        found = self.find(tag)
        return "" if found is None else found.text.strip()

    def numbers(self, text: str | None, count: int, what: str) -> tuple[float, ...]:
        """Numbers of a text that has to hold so many."""
        try:
            values = tuple(float(word) for word in (text or "").split())
        except ValueError:
            values = ()
        if len(values) != count:
            kind = "a number" if count == 1 else f"{count} numbers"
            self.refuse(f"{what} = {shown(text or '')} is not {kind}")
        for value in values:
            if not math.isfinite(value) or abs(value) > LARGEST_NUMBER:
                self.refuse(f"{what} = {shown(text)} is beyond any robot")
        return values

    def number(self, text: str | None, what: str) -> float:
        """Number of a text."""
        return self.numbers(text, 1, what)[0]

    def refuse(self, why: str) -> NoReturn:
        """Raise an error that names the file, the line and the element."""
        named = self.attributes.get("name")
        what = f"{self.tag} {shown(named)}" if named else f"<{short(self.tag)}>"
        raise InputError(f"{self.origin}, line {self.line}: {what}: {why}")


def parse_xml(content: bytes, *, origin: str) -> Element:
    """Tree of an XML text."""
    parser = expat.ParserCreate()
    parser.buffer_text = True
    outer = Element("", {}, 0, origin)
    path, texts, count = [outer], [[""]], 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        line = parser.CurrentLineNumber
        if len(path) > DEEPEST:
            raise InputError(f"{origin}, line {line}: more than {DEEPEST} elements in one another")
        if count > MOST_ELEMENTS:
            raise InputError(f"{origin}, line {line}: more than {MOST_ELEMENTS:,} elements")
        element = Element(tag, attributes, line, origin)
        path[-1].children.append(element)
        path.append(element)
        texts.append([])

    def end(tag: str) -> None:
        path.pop().text = "".join(texts.pop())

    def text(data: str) -> None:
        texts[-1].append(data)

    def refuse_type(*_: Any) -> None:
        raise InputError(
            f"{origin}, line {parser.CurrentLineNumber}: has a document type (DOCTYPE), which "
            "could name other files or grow without end; remove it"
        )

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text
    parser.StartDoctypeDeclHandler = refuse_type
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        why = expat.errors.messages.get(error.code, "not well-formed")
        raise InputError(f"{origin}, line {error.lineno}: not valid XML: {why}") from None
    except (ValueError, LookupError) as error:  # an encoding that is none
        raise InputError(f"{origin}: not valid XML: {error}") from None
    return outer.children[0]
