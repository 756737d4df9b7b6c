"""Marks of the verdicts: who sees no colour sees a shape, and there is a word besides."""

from typing import NamedTuple


class Mark(NamedTuple):
    """How a verdict looks."""

    sign: str
    """One letter, of DejaVu Sans."""
    edge: str
    tint: str
    """Colours of its frame and of what it frames."""


MARKS = {
    "go": Mark("●", "#00664b", "#e3f4ee"),
    "rough": Mark("▲", "#7a5900", "#fdf3d7"),
    "unsure": Mark("◆", "#0a5c91", "#deeefa"),
    "no-go": Mark("■", "#a33b00", "#fbe6d9"),
    "outside-model": Mark("○", "#444444", "#ececec"),
}
"""By verdict."""
