"""The description of a robot in a file: its elements, and how its axes are known."""

from kaidan.errors import short
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Known, Provenance
from kaidan.readers.opening import Source
from kaidan.readers.xml_tree import Element, parse_xml

LARGEST_ROBOT = 50_000_000
"""Largest description of a robot [bytes]."""


def robot_xml(source: Source) -> Element:
    """Tree of a robot's file; what stands below its declaration is read and nothing else."""
    return parse_xml(source.content(LARGEST_ROBOT), origin=short(source.path))


def provenance_of(source: Source, form: str, hints: Hints) -> Provenance:
    """Where a robot was read, and how its axes are known."""
    up = Known("+z", "format") if hints.up is None else Known(hints.up, "person")
    return Provenance(
        path=str(source.path),
        digest=source.digest,
        form=form,
        element=hints.element,
        unit=Known("m", "format"),
        up=up,
    )
