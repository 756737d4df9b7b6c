"""The kernel's memory layout is read by `kaidan.contact` alone: everybody else reads by name."""

import ast
from pathlib import Path

import pytest

import kaidan

SOURCE = Path(kaidan.__file__).parent
FILES = sorted(
    file for file in SOURCE.rglob("*.py") if file.relative_to(SOURCE).parts[0] != "contact"
)
TABLES = {"poses", "events", "rotations", "margins", "ground", "body", "criterion", "rows"}
"""Names under which the records of a path are kept."""
FEATURES = {"feature", "pivot", "other_feature", "code"}
"""Names under which a feature is kept, one packed integer."""


def name_of(node):
    """Last part of a dotted name."""
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def has_number(node):
    return any(
        isinstance(each, ast.Constant) and isinstance(each.value, int) for each in ast.walk(node)
    )


def faults(tree):
    """Lines that know a column, or how a feature is packed."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and node.attr == "table":
            if name_of(node.value) in TABLES:
                yield node.lineno, "reads a record's table"
        elif isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Tuple):
            last = node.slice.elts[-1]
            if name_of(node.value) in TABLES and len(node.slice.elts) > 1 and has_number(last):
                yield node.lineno, "reads a column by its number"
        elif isinstance(node, ast.BinOp) and isinstance(node.op, ast.RShift | ast.BitAnd):
            if name_of(node.left) in FEATURES and has_number(node.right):
                yield node.lineno, "unpacks a feature by hand"
        elif isinstance(node, ast.ImportFrom) and node.module == "kaidan.contact":
            if any(each.name == "columns" for each in node.names):
                yield node.lineno, "imports the columns"
        elif isinstance(node, ast.ImportFrom) and node.module == "kaidan.contact.columns":
            yield node.lineno, "imports the columns"


def test_no_column_is_read_outside_the_package():
    found = [
        f"{file.relative_to(SOURCE)}:{line} {what}"
        for file in FILES
        for line, what in faults(ast.parse(file.read_text()))
    ]
    assert found == []


@pytest.mark.parametrize(
    "line",
    [
        "path.poses[:, 3]",
        "run.margins[row, 6:8]",
        "events[at, 0]",
        "path.poses.table[:, column]",
        "part = (feature >> 2) & 15",
        "from kaidan.contact.columns import POSE_X",
        "from kaidan.contact import columns",
    ],
)
def test_the_rule_finds_what_it_forbids(line):
    assert list(faults(ast.parse(line)))
