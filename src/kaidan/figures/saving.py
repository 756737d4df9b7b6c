"""Figures as bytes of a file: the same bytes every time."""

import io
from pathlib import Path
from typing import TYPE_CHECKING

from kaidan.files import format_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("png", "svg", "pdf")
"""Formats of figures, by the suffix of the file."""

_METADATA: dict[str, dict[str, str | None]] = {
    "png": {"Software": "kaidan"},
    "svg": {"Creator": "kaidan", "Date": None},
    "pdf": {"Creator": "kaidan", "CreationDate": None},
}
"""Without dates, so that the same question gives the same file."""


def figure_format(path: Path) -> str:
    """Format that the suffix of a figure's file asks for."""
    return format_of(path, FORMATS, "figure")


def figure_bytes(figure: "Figure", form: str) -> bytes:
    """Bytes of a figure in one of `FORMATS`."""
    from kaidan.figures import style as look

    buffer = io.BytesIO()
    with look.settings():
        figure.savefig(buffer, format=form, dpi=look.DPI, metadata=_METADATA[form])
    return buffer.getvalue()
