"""How large kaidan is: ``python tests/rules/size.py``, of the product and of the laboratory.

Lines of code are those that hold more than a comment or a text that stands alone: docstrings,
meanings of fields, blanks and comments are none.
"""

import ast
import io
import re
import tokenize
from pathlib import Path
from typing import NamedTuple

import typer

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src" / "kaidan"
LAB = SOURCE / "lab"
PAGES = ("README.md", "CONTRIBUTING.md", "docs")
_SILENT = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT,
           tokenize.ENCODING, tokenize.ENDMARKER}  # fmt: skip


class Longest(NamedTuple):
    """The largest of its kind, and which one it is."""

    count: int
    name: str


def sizes():
    """Each measure by its name: a number, or the largest with its name."""
    files = [File(path) for path in sorted(SOURCE.rglob("*.py"))]
    functions = [each for file in files for each in file.functions()]
    return {
        "modules": len(files),
        "modules of the laboratory": sum(LAB in file.path.parents for file in files),
        "lines": sum(file.lines for file in files),
        "lines of the laboratory": sum(file.lines for file in files if LAB in file.path.parents),
        "lines of code": sum(len(file.code) for file in files),
        "lines of docstrings": sum(len(file.told) for file in files),
        "longest function": max(Longest(code, name) for name, code, _ in functions),
        "most parameters": max(Longest(count, name) for name, _, count in functions),
        "answer classes": _answer_classes(files),
        "options": _options(),
        "words of docs": _words(),
    }


class File:
    """One module: its lines of code and of texts that stand alone."""

    def __init__(self, path):
        self.path, text = path, path.read_text()
        self.lines, self.tree = len(text.splitlines()), ast.parse(text)
        self.told = {
            line
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
            if isinstance(node.value.value, str)
            for line in range(node.lineno, node.end_lineno + 1)
        }
        tokens = tokenize.generate_tokens(io.StringIO(text).readline)
        self.code = {
            line
            for token in tokens
            if token.type not in _SILENT
            for line in range(token.start[0], token.end[0] + 1)
        } - self.told

    def functions(self):
        """Name, lines of code and number of parameters of each function."""
        for node in ast.walk(self.tree):
            if isinstance(node, ast.FunctionDef):
                own = set(range(node.lineno, node.end_lineno + 1)) & self.code
                given = node.args
                count = len([*given.posonlyargs, *given.args, *given.kwonlyargs])
                yield f"{self.path.relative_to(SOURCE)}:{node.name}", len(own), count


def _answer_classes(files):
    bases = {
        node.name: {ast.unparse(base).rpartition(".")[2] for base in node.bases}
        for file in files
        for node in ast.walk(file.tree)
        if isinstance(node, ast.ClassDef)
    }
    found = {"Part"}
    while more := {name for name, of in bases.items() if of & found} - found:
        found |= more
    return len(found)


def _options():
    from kaidan.cli import app

    def counted(command):
        own = sum(each.param_type_name == "option" for each in command.params)
        return own + sum(counted(each) for each in getattr(command, "commands", {}).values())

    return counted(typer.main.get_command(app))


def _words():
    pages = [ROOT / each for each in PAGES]
    files = [file for page in pages for file in ([page] if page.is_file() else page.rglob("*.md"))]
    return sum(
        len(re.findall(r"\S+", file.read_text())) for file in files if "_build" not in file.parts
    )


def main():
    """Print each measure."""
    for name, size in sizes().items():
        count, which = size if isinstance(size, Longest) else (size, "")
        print(f"{name:<27}{count:>8,}  {which}".rstrip())


if __name__ == "__main__":
    main()
