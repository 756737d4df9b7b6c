"""A document as one page of HTML: pictures inside, printable, no script, nothing fetched."""

from base64 import b64encode
from collections.abc import Mapping
from html import escape
from itertools import chain

from kaidan.documents.marks import MARKS
from kaidan.documents.scan_code import scan_code
from kaidan.modes import Verdict as Judged
from kaidan.tables import printable
from kaidan.text import document as of

STYLE = """
:root { color-scheme: light }
body { font: 15px/1.45 system-ui, "Segoe UI", Roboto, sans-serif; color: #000; background: #fff;
  max-width: 58em; margin: 1.5em auto; padding: 0 1em }
h1 { font-size: 1.35em } h2 { font-size: 1.1em; margin: 1.1em 0 .3em }
p { margin: .4em 0 }
.verdict { border: 3px solid; border-radius: .4em; padding: .5em .8em; margin: .5em 0 }
.verdict b { font-size: 1.7em; margin-right: .6em; white-space: nowrap }
table { border-collapse: collapse; width: 100%; margin: .4em 0; table-layout: fixed }
th, td { border: 1px solid #888; padding: .25em .45em; text-align: left; vertical-align: top;
  overflow-wrap: anywhere }
thead th { background: #ececec } .facts th { width: 11em }
img { max-width: 100%; height: auto; display: block; margin: .5em auto }
.code img { width: 62mm; margin: .5em 0 } .code p, pre { font-family: ui-monospace, monospace;
  font-size: .8em; overflow-wrap: anywhere; white-space: pre-wrap }
footer { margin-top: 2em; border-top: 1px solid #888; font-size: .85em }
ul { margin: .3em 0; padding-left: 1.4em }
@media print {
  @page { size: A4; margin: 13mm }
  body { font-size: 9pt; max-width: none; margin: 0; padding: 0 }
  .sheet, .break { break-after: page }
  .sheet img { max-height: 68mm } .verdict h1 { margin: 0 }
  table { font-size: 8pt } th, td { padding: .12em .35em } pre, .code p { font-size: 6.8pt }
  h1, h2 { break-after: avoid } tr, img, .verdict, .code { break-inside: avoid }
  .verdict, thead th { print-color-adjust: exact; -webkit-print-color-adjust: exact }
}
"""
_VERDICTS = "\n".join(
    f".{key} {{ border-color: {mark.edge}; background: {mark.tint} }}"
    for key, mark in MARKS.items()
)


def page(document: of.Document, pictures: Mapping[str, bytes]) -> str:
    """Page of a document.

    pictures: SVG by key; a picture without one is left out.
    """
    body = chain.from_iterable(_part(each, pictures) for each in document.parts)
    title = _text(document.title)
    return "\n".join(
        [
            "<!DOCTYPE html>",
            f'<html lang="{document.language}"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{title}</title>",
            f"<style>{STYLE}{_VERDICTS}</style></head><body><main>",
            *body,
            f"</main><footer>{_text(document.foot)}</footer></body></html>",
            "",
        ]
    )


def _part(part: "of.Block | of.Sheet", pictures: Mapping[str, bytes]) -> list[str]:
    if isinstance(part, of.Sheet):
        inner = chain.from_iterable(_part(each, pictures) for each in part.blocks)
        return ['<section class="sheet">', *inner, "</section>"]
    match part:
        case of.Verdict():
            label = f"{MARKS[part.key].sign} {Judged(part.key).label}"
            return [
                f'<div class="verdict {part.key}"><h1><b>{label}</b> {_text(part.text)}</h1></div>'
            ]
        case of.Heading():
            return [f"<h{part.level}>{_text(part.text)}</h{part.level}>"]
        case of.Paragraph():
            return [f"<p>{_text(part.text)}</p>"]
        case of.Points():
            return ["<ul>", *(f"<li>{_text(each)}</li>" for each in part.items), "</ul>"]
        case of.Facts():
            rows = (
                f'<tr><th scope="row">{_text(name)}</th><td>{_text(value)}</td></tr>'
                for name, value in part.rows
            )
            return ['<table class="facts"><tbody>', *rows, "</tbody></table>"]
        case of.Table():
            return _table(part)
        case of.Lines():
            return [f'<pre lang="en">{_text(chr(10).join(part.lines))}</pre>']
        case of.Picture():
            given = pictures.get(part.key)
            return [] if given is None else [_picture(given, part.says)]
        case of.Code():
            drawn = scan_code(part.text, "svg")
            image = "" if drawn is None else _picture(drawn, "QR code of the text below")
            return [f'<div class="code">{image}<p>{_text(part.text)}</p></div>']
        case _:
            return ['<div class="break"></div>']


def _table(table: of.Table) -> list[str]:
    whole = sum(table.widths)
    columns = (f'<col style="width:{100 * each / whole:.4g}%">' for each in table.widths)
    heads = (f'<th scope="col">{_text(each)}</th>' for each in table.heads)
    rows = (f"<tr>{''.join(f'<td>{_text(cell)}</td>' for cell in row)}</tr>" for row in table.rows)
    return [
        f"<table><colgroup>{''.join(columns)}</colgroup>",
        f"<thead><tr>{''.join(heads)}</tr></thead><tbody>",
        *rows,
        "</tbody></table>",
    ]


def _picture(drawn: bytes, says: str) -> str:
    data = b64encode(drawn).decode()
    return f'<img alt="{_text(says)}" src="data:image/svg+xml;base64,{data}">'


def _text(text: str) -> str:
    return escape(printable(text))
