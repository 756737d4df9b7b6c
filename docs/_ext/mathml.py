"""Formulas as MathML, written at build time: no script, no font and no network in the reader.

``\\tag{4}`` at the end of a displayed formula puts (4) beside it: the equation number of the source,
not one of ours.
"""

import re
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

_TAG = re.compile(r"\\tag\{([^{}]*)\}")
_OPERATOR = re.compile(r"\\operatorname\{([^{}]*)\}")
_NAME = (
    r"(?:<m[io]>(?:arcsin|arccos|arctan|sinh|cosh|tanh|sin|cos|tan|max|min)</m[io]>"
    r"|<mtext>(?:atan2|arsinh|hypot|atan)</mtext>)"
)
_BEFORE_ARGUMENT = re.compile(rf"({_NAME})(?!(?:<mrow>)?<mo stretchy|</)")
_AFTER_FACTOR = re.compile(rf"(</(?:mi|mn|msub|msup|msubsup|mfrac|mrow)>)(?={_NAME})")
"""Where latex2mathml leaves no space about a function's name."""
_THIN_SPACE = r'\1<mspace width="0.17em" />'
_LEFT_OVER = re.compile(r"\\[a-zA-Z]+|&(?!#|amp;|lt;|gt;)")

logger = logging.getLogger(__name__)


def to_mathml(latex: str, *, display: bool) -> str:
    """MathML of a formula.

    Raises
    ------
    ValueError
        A command that the converter does not know.
    """
    known = _OPERATOR.sub(r"\\text{\1}", latex.strip())
    mathml = convert(known, display="block" if display else "inline")
    mathml = _BEFORE_ARGUMENT.sub(_THIN_SPACE, _AFTER_FACTOR.sub(_THIN_SPACE, mathml))
    left_over = _LEFT_OVER.search(mathml)
    if left_over:
        raise ValueError(f"{left_over.group()!r} is not understood in {latex!r}")
    return mathml


def _written(node: nodes.Element, latex: str, *, display: bool) -> str:
    try:
        return to_mathml(latex, display=display)
    except Exception as error:
        logger.warning("formula: %s", error, location=node)
        return ""


def visit_inline(self: HTML5Translator, node: nodes.math) -> None:
    """Write a formula within a line."""
    self.body.append(_written(node, node.astext(), display=False))
    raise nodes.SkipNode


def visit_display(self: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula of its own, with its number."""
    latex = node.astext()
    tag = _TAG.search(latex)
    number = f'<span class="eqno">({tag.group(1)})</span>' if tag else ""
    formula = _written(node, _TAG.sub("", latex), display=True)
    self.body.append(f'<div class="formula">{formula}{number}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer."""
    app.add_html_math_renderer(
        "mathml", inline_renderers=(visit_inline, None), block_renderers=(visit_display, None)
    )
    return {"parallel_read_safe": True, "parallel_write_safe": True}
