"""Words of pictures in Japanese, where the system has a typeface for them."""

from functools import cache
from typing import TYPE_CHECKING

from kaidan.text.japanese import japanese

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TYPEFACES = (
    "Noto Sans CJK JP",
    "Noto Sans JP",
    "IPAexGothic",
    "IPAPGothic",
    "IPAGothic",
    "TakaoPGothic",
    "Hiragino Sans",
    "Yu Gothic",
    "Meiryo",
)
"""Sans-serif typefaces with kana and kanji of usual systems, the first one found is taken."""


@cache
def typeface() -> str | None:
    """Name of a typeface of the system for Japanese; None: it has none of `TYPEFACES`."""
    from matplotlib.font_manager import fontManager

    there = {font.name for font in fontManager.ttflist}
    return next((name for name in TYPEFACES if name in there), None)


def typeface_files() -> list[str]:
    """Files of those of `TYPEFACES` that the system has, in their order; upright and regular."""
    from matplotlib.font_manager import fontManager

    fonts = [font for font in fontManager.ttflist if font.name in TYPEFACES]
    usual = [font for font in fonts if font.weight in (400, "normal") and font.style == "normal"]
    return [font.fname for font in sorted(usual, key=lambda font: TYPEFACES.index(font.name))]


def put_in_japanese(figure: "Figure") -> None:
    """Put the words of a figure in Japanese; those without any, and all without a font, stay."""
    from matplotlib.text import Text
    from matplotlib.ticker import FixedLocator

    family = typeface()
    if family is None:
        return
    faces = ["DejaVu Sans", family]
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):  # they label fixed ticks anew when they are drawn
            names = [each.get_text() for each in axis.get_ticklabels()]
            if isinstance(axis.get_major_locator(), FixedLocator) and any(map(_said, names)):
                axis.set_ticklabels([_said(each) or each for each in names], fontfamily=faces)
    for each in figure.findobj(Text):
        assert isinstance(each, Text)
        said = _said(each.get_text())
        if said is not None:
            each.set_text(said)
            each.set_fontfamily(faces)
            each.set_fontweight("normal")  # few of these typefaces have another


def _said(text: str) -> str | None:
    return japanese(text, "picture") or japanese(text)
