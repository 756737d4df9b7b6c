"""A document as PDF, on A4: ReportLab sets it, in the typeface that matplotlib brings along.

No date and no random name is in the file, so the same document gives the same bytes.
"""

import io
import re
import textwrap
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from kaidan.documents.japanese_pictures import typeface_files
from kaidan.documents.marks import MARKS
from kaidan.documents.scan_code import scan_code
from kaidan.errors import needed
from kaidan.modes import Verdict as Judged
from kaidan.tables import printable
from kaidan.text import document as of

_FACES = {"Sans": "DejaVuSans", "Sans-Bold": "DejaVuSans-Bold", "Mono": "DejaVuSansMono"}
_NOT_INSIDE = "HeiseiKakuGo-W5"
"""Japanese typeface that readers of PDF have, or replace; it is not in the file."""
_KANA_AND_KANJI = re.compile("[\u3000-\u9fff\uff00-\uffef]+")
_MARGIN = 13.0
"""Around a page [mm]."""
_COLUMNS = 108
"""Letters of a line of type of one width."""
_INDENT = 18 * " "
_CODE = 55.0
"""Width of a QR code [mm]."""


def pages(document: of.Document, pictures: Mapping[str, bytes]) -> bytes:
    """PDF of a document.

    pictures: PNG by key; a picture without one is left out.
    """
    platypus: Any = needed("reportlab.platypus", "a report as PDF", "report")
    from reportlab.lib.pagesizes import A4
    from reportlab.lib.units import mm

    _Setter.register()
    buffer = io.BytesIO()
    made = platypus.SimpleDocTemplate(
        buffer,
        pagesize=A4,
        leftMargin=_MARGIN * mm,
        rightMargin=_MARGIN * mm,
        topMargin=_MARGIN * mm,
        bottomMargin=(_MARGIN + 5) * mm,
        title=printable(document.title),
        author="kaidan",
        creator="kaidan",
        lang=document.language,
        invariant=1,
    )

    def foot(canvas: Any, template: Any) -> None:
        canvas.setFont("Sans" if document.language == "en" else _japanese(), 7.5)
        canvas.drawString(_MARGIN * mm, 10 * mm, printable(document.foot))
        canvas.drawRightString(A4[0] - _MARGIN * mm, 10 * mm, str(template.page))

    setter = _Setter(made.width, made.height, pictures, document.language)
    flow = [flowable for part in document.parts for flowable in setter.part(part)]
    made.build(flow, onFirstPage=foot, onLaterPages=foot)
    return buffer.getvalue()


class _Setter:
    """What sets each block, for pages of a width and height [pt]."""

    def __init__(
        self, width: float, height: float, pictures: Mapping[str, bytes], language: str
    ) -> None:
        from reportlab.lib.styles import ParagraphStyle

        self.width, self.height, self.pictures = width, height, pictures

        def style(name: str, size: float, **more: Any) -> Any:
            return ParagraphStyle(
                name, fontName=more.pop("face", "Sans"), fontSize=size, leading=1.28 * size,
                wordWrap="CJK" if language == "ja" else None, **more,
            )  # fmt: skip

        self.body = style("body", 8.8, spaceAfter=3)
        self.cell = style("cell", 7.6, splitLongWords=1)
        self.head = style("head", 7.6, face="Sans-Bold")
        self.large = style("large", 12.5, face="Sans-Bold")
        self.verdict = style("verdict", 17, face="Sans-Bold")
        self.lines = style("lines", 6.6, face="Mono")
        self.headings = {
            level: style(f"h{level}", size, face="Sans-Bold", spaceBefore=7, spaceAfter=3,
                         keepWithNext=1)
            for level, size in ((1, 14), (2, 10.5), (3, 9.5))
        }  # fmt: skip

    @staticmethod
    def register() -> None:
        """Make the typefaces known."""
        import matplotlib as mpl
        from reportlab.pdfbase.pdfmetrics import registerFont
        from reportlab.pdfbase.ttfonts import TTFont

        folder = Path(mpl.get_data_path()) / "fonts" / "ttf"
        for name, file in _FACES.items():
            registerFont(TTFont(name, str(folder / f"{file}.ttf")))

    def part(self, part: "of.Block | of.Sheet") -> list[Any]:
        """Flowables of a part."""
        from reportlab import platypus as p

        if isinstance(part, of.Sheet):
            inner = [flowable for each in part.blocks for flowable in self.part(each)]
            frame = p.KeepInFrame(self.width, self.height - 12, inner, mode="shrink")
            return [frame, p.PageBreak()]
        match part:
            case of.Verdict():
                return [self._verdict(part)]
            case of.Heading():
                return [p.Paragraph(_text(part.text), self.headings[part.level])]
            case of.Paragraph():
                return [p.Paragraph(_text(part.text), self.body)]
            case of.Points():
                return [
                    p.Paragraph(f"•  {_text(each)}", self.body, bulletText=None)
                    for each in part.items
                ]
            case of.Facts():
                rows = [
                    [_row_head(name, self.head), self._cell(value)] for name, value in part.rows
                ]
                return [self._table(rows, (20, 80), heads=0)]
            case of.Table():
                heads = [p.Paragraph(_text(each), self.head) for each in part.heads]
                cells = [[self._cell(each) for each in row] for row in part.rows]
                return [self._table([heads, *cells], part.widths, heads=1)]
            case of.Lines():
                return [p.Preformatted("\n".join(_wrapped(part.lines)), self.lines)]
            case of.Picture():
                given = self.pictures.get(part.key)
                return [] if given is None else [self._picture(given, part.height)]
            case of.Code():
                return self._code(part)
            case _:
                return [p.PageBreak()]

    def _cell(self, text: str) -> Any:
        from reportlab.platypus import Paragraph

        return Paragraph(_text(text), self.cell)

    def _table(self, rows: list[list[Any]], widths: tuple[int, ...], *, heads: int) -> Any:
        from reportlab.lib import colors
        from reportlab.platypus import Table, TableStyle

        whole = sum(widths)
        made = Table(
            rows,
            colWidths=[self.width * each / whole for each in widths],
            repeatRows=heads,
            spaceBefore=3,
            spaceAfter=4,
        )
        grey = colors.HexColor("#888888")
        style: list[Any] = [
            ("GRID", (0, 0), (-1, -1), 0.5, grey),
            ("VALIGN", (0, 0), (-1, -1), "TOP"),
            ("LEFTPADDING", (0, 0), (-1, -1), 3),
            ("RIGHTPADDING", (0, 0), (-1, -1), 3),
            ("TOPPADDING", (0, 0), (-1, -1), 1.5),
            ("BOTTOMPADDING", (0, 0), (-1, -1), 2),
        ]
        if heads:
            style.append(("BACKGROUND", (0, 0), (-1, 0), colors.HexColor("#ececec")))
        made.setStyle(TableStyle(style))
        return made

    def _verdict(self, block: of.Verdict) -> Any:
        from reportlab.lib import colors
        from reportlab.platypus import Paragraph, Table, TableStyle

        label = f"{MARKS[block.key].sign} {Judged(block.key).label}"
        share = 0.52 if block.key == "outside-model" else 0.3
        made = Table(
            [[Paragraph(label, self.verdict), Paragraph(_text(block.text), self.large)]],
            colWidths=[share * self.width, (1 - share) * self.width],
            spaceAfter=5,
        )
        made.setStyle(
            TableStyle(
                [
                    ("BOX", (0, 0), (-1, -1), 2, colors.HexColor(MARKS[block.key].edge)),
                    ("BACKGROUND", (0, 0), (-1, -1), colors.HexColor(MARKS[block.key].tint)),
                    ("VALIGN", (0, 0), (-1, -1), "MIDDLE"),
                    ("TOPPADDING", (0, 0), (-1, -1), 5),
                    ("BOTTOMPADDING", (0, 0), (-1, -1), 8),
                ]
            )
        )
        return made

    def _picture(self, given: bytes, tallest: float) -> Any:
        from reportlab.lib.units import mm
        from reportlab.lib.utils import ImageReader
        from reportlab.platypus import Image

        wide, tall = ImageReader(io.BytesIO(given)).getSize()
        most = min(tallest * mm if tallest else self.height, 0.9 * self.height)
        scale = min(self.width / wide, most / tall)
        return Image(io.BytesIO(given), width=scale * wide, height=scale * tall)

    def _code(self, block: of.Code) -> list[Any]:
        from reportlab.lib.units import mm
        from reportlab.platypus import Image, KeepTogether, Preformatted

        drawn = scan_code(block.text, "png")
        text = Preformatted("\n".join(textwrap.wrap(block.text, _COLUMNS)), self.lines)
        if drawn is None:
            return [text]
        picture = Image(io.BytesIO(drawn), width=_CODE * mm, height=_CODE * mm, hAlign="LEFT")
        return [KeepTogether([picture, text])]


def _row_head(name: str, style: Any) -> Any:
    from reportlab.platypus import Paragraph

    return Paragraph(_text(name), style)


def _wrapped(lines: tuple[str, ...]) -> list[str]:
    return [
        escape(piece, quote=False)
        for line in lines
        for piece in textwrap.wrap(printable(line), _COLUMNS, subsequent_indent=_INDENT) or [""]
    ]


@cache
def _japanese() -> str:
    """Typeface of kana and kanji: one of the system that can be in the file, else one that cannot.

    Who prints at the foot of the stairs may have a reader without any.
    """
    from reportlab.pdfbase.cidfonts import UnicodeCIDFont
    from reportlab.pdfbase.pdfmetrics import registerFont
    from reportlab.pdfbase.ttfonts import TTFError, TTFont

    for file in typeface_files():
        with suppress(TTFError, OSError):  # one with curves of PostScript
            registerFont(TTFont("Japanese", file))
            return "Japanese"
    registerFont(UnicodeCIDFont(_NOT_INSIDE))
    return _NOT_INSIDE


def _text(text: str) -> str:
    plain = escape(printable(text), quote=False)
    return _KANA_AND_KANJI.sub(lambda run: f'<font name="{_japanese()}">{run[0]}</font>', plain)
