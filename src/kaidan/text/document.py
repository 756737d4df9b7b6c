"""What a document says, block by block: `kaidan.documents` puts it on paper or on a page."""

from typing import NamedTuple


class Heading(NamedTuple):
    """Heading of a part."""

    text: str
    level: int = 2


class Verdict(NamedTuple):
    """Verdict in large letters, with a mark: the colour is never alone."""

    key: str
    """go, rough, unsure, no-go or outside-model."""
    text: str
    """For whom on what."""


class Paragraph(NamedTuple):
    """Sentences."""

    text: str


class Facts(NamedTuple):
    """Names and what there is to say of each."""

    rows: tuple[tuple[str, str], ...]


class Points(NamedTuple):
    """List of sentences."""

    items: tuple[str, ...]


class Table(NamedTuple):
    """Table."""

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    widths: tuple[int, ...]
    """Shares of the width."""


class Lines(NamedTuple):
    """Lines of text as a command prints them, in English."""

    lines: tuple[str, ...]


class Picture(NamedTuple):
    """Place of a picture."""

    key: str
    """Which one; left out where there is none."""
    says: str
    """What it shows, for who cannot see it."""
    height: float = 0.0
    """Largest height on paper [mm]; 0: as it comes."""


class Code(NamedTuple):
    """A code to scan, and the same as a text."""

    text: str


class Break(NamedTuple):
    """A new page."""


Block = Heading | Verdict | Paragraph | Facts | Points | Table | Lines | Picture | Code | Break


class Sheet(NamedTuple):
    """Blocks that stay on one page of their own."""

    blocks: tuple[Block, ...]


class Document(NamedTuple):
    """A whole document."""

    title: str
    parts: tuple[Block | Sheet, ...]
    foot: str
    """At the foot of each page."""
    language: str = "en"
    """Of all but the lines of commands, and the words of sheets and sources."""
