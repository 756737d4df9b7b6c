"""A text as a QR code."""

from typing import Any

from kaidan.errors import needed


def scan_code(text: str, form: str) -> bytes | None:
    """Picture of a QR code.

    form, {"svg", "png"}

    None where the text is longer than a QR code holds.
    """
    import io

    segno: Any = needed("segno", "a report", "report")
    try:
        made = segno.make(text, micro=False, error="l", boost_error=True)
    except segno.DataOverflowError:
        return None
    buffer = io.BytesIO()
    options = {"svg": {"xmldecl": False, "svgns": True, "nl": False}, "png": {}}[form]
    made.save(buffer, kind=form, scale=6, border=4, **options)
    return buffer.getvalue()
