"""Mutants: the changes of one place of a source file, and how they are recorded."""

import ast
import copy
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import CodeType

KILLED, HANGS, SURVIVES, UNTESTED = "killed", "hangs", "survives", "untested"

COMPARISONS = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip
OPERATORS = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.FloorDiv: ast.Div, ast.Mod: ast.Div, ast.Pow: ast.Mult, ast.LShift: ast.RShift,
    ast.RShift: ast.LShift, ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd,
}  # fmt: skip
NAMES = {
    "max": "min", "min": "max", "all": "any", "any": "all", "argmax": "argmin", "argmin": "argmax",
    "maximum": "minimum", "minimum": "maximum", "floor": "ceil", "ceil": "floor",
    "sin": "cos", "cos": "sin",
}  # fmt: skip


_TYPES = ("annotation", "returns")
"""Fields of nodes that are types."""


@dataclass
class Mutant:
    """One change of one function."""

    file: str
    function: str
    line: int
    before: str
    after: str
    outcome: str = ""
    by: str = ""
    """Test that notices it."""

    @property
    def key(self) -> tuple[str, str, int, str, str]:
        return (self.file, self.function, self.line, self.before, self.after)

    @property
    def lives(self) -> bool:
        """Whether no test notices it."""
        return self.outcome in (SURVIVES, UNTESTED)


def answers(path: Path) -> list[Mutant]:
    """Mutants of a file of answers; none if there is no file."""
    lines = path.read_text().splitlines() if path.exists() else []
    return [Mutant(**json.loads(line)) for line in lines]


def changes(node: ast.AST) -> Iterator[ast.AST]:
    """Nodes that may stand in the place of a node, each one change away from it."""
    if isinstance(node, ast.Compare):
        for k, operator in enumerate(node.ops):
            other = copy.deepcopy(node)
            other.ops[k] = COMPARISONS[type(operator)]()
            yield other
    elif isinstance(node, ast.BoolOp):
        other = copy.deepcopy(node)
        other.op = ast.Or() if isinstance(node.op, ast.And) else ast.And()
        yield other
    elif isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op) in OPERATORS:
        other = copy.deepcopy(node)
        other.op = OPERATORS[type(node.op)]()
        yield other
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
        yield copy.deepcopy(node.operand)
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield ast.Constant(not node.value)
    elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        yield ast.Constant(node.value + 1)
    elif isinstance(node, ast.Name | ast.Attribute):
        name = node.id if isinstance(node, ast.Name) else node.attr
        if isinstance(node.ctx, ast.Load) and name in NAMES:
            other = copy.deepcopy(node)
            setattr(other, "id" if isinstance(node, ast.Name) else "attr", NAMES[name])
            yield other
    elif isinstance(node, ast.Break):
        yield ast.Continue()
    elif isinstance(node, ast.Continue):
        yield ast.Break()


def functions(tree: ast.Module) -> Iterator[tuple[str, ast.FunctionDef]]:
    """Functions and methods of a module by qualified name; what is nested belongs to the outer."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node
        elif isinstance(node, ast.ClassDef):
            for inner in node.body:
                if isinstance(inner, ast.FunctionDef):
                    yield f"{node.name}.{inner.name}", inner


def mutants(path: Path) -> Iterator[tuple[Mutant, CodeType]]:
    """Every mutant of a file, with the code of its function."""
    tree = ast.parse(path.read_text())
    for name, function in functions(tree):
        for statement in function.body:
            for parent in _inside(statement):
                yield from _of_statement(path, tree, name, parent)
            if not isinstance(statement, ast.Expr):  # as children the loop above has them
                yield from _replaced(path, tree, name, function, "body", statement)


def _inside(node: ast.AST) -> Iterator[ast.AST]:
    """A node and what is in it, but for types."""
    yield node
    types = [getattr(node, each, None) for each in _TYPES]
    for child in ast.iter_child_nodes(node):
        if child not in types:
            yield from _inside(child)


def _of_statement(
    path: Path, tree: ast.Module, name: str, parent: ast.AST
) -> Iterator[tuple[Mutant, CodeType]]:
    if isinstance(parent, ast.AnnAssign):
        fields: tuple[str, ...] = ("value",)  # no type is changed
    else:
        fields = tuple(each for each in parent._fields if each not in _TYPES)
    for field in fields:
        value = getattr(parent, field, None)
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                yield from _replaced(path, tree, name, parent, field, child)


def _replaced(
    path: Path, tree: ast.Module, name: str, parent: ast.AST, field: str, child: ast.AST
) -> Iterator[tuple[Mutant, CodeType]]:
    """Mutants in which a child of a node is another."""
    for other in changes(child):
        ast.copy_location(other, child)
        before, after = ast.unparse(child), ast.unparse(other)
        value = getattr(parent, field)
        if isinstance(value, list):
            place = next(k for k, each in enumerate(value) if each is child)
            value[place] = other
        else:
            setattr(parent, field, other)
        ast.fix_missing_locations(tree)
        code = find(compile(tree, str(path), "exec"), name)
        if isinstance(value, list):
            value[place] = child
        else:
            setattr(parent, field, child)
        yield Mutant(path.name, name, child.lineno, before, after), code  # type: ignore[attr-defined]


def find(code: CodeType, name: str) -> CodeType:
    """Code of a function by qualified name."""
    for part in name.split("."):
        code = next(
            each for each in code.co_consts if isinstance(each, CodeType) and each.co_name == part
        )
    return code
