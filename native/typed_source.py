"""The contact kernel as one typed module for Cython, written from its plain Python source.

Cython compiles the same statements. What the plain source does not say in Cython's words is added
here, from the annotations and nothing else::

    plain                                   typed
    ground: GroundTable                     Table ground            (pointer and number of rows)
    ground[k, X], ground.shape[0]           ground.at[k * 6 + 0], ground.rows
    VERTEX, Status.OK, math.inf             0, 0, INFINITY          (constants folded)
    def f(x: float) -> tuple[float, int]    cdef (double, long long) c_f(double x) noexcept nogil

Local variables are declared from what is assigned to them (Cython's own inference takes truth
values and what loops count for objects); what is forgotten is a compile error, because nothing here
may touch a Python object. Every entry gets a wrapper that checks the tables, releases the
interpreter's lock and calls the compiled function.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import math
from collections.abc import Callable
from types import ModuleType
from typing import Any, Protocol, get_args, get_origin, get_type_hints

from kaidan.contact.entries import KERNEL_MODULES, KERNEL_PACKAGE
from kaidan.contact.source_mark import source_mark
from kaidan.contact.tables import FloatRow, IntArray

SCALARS = {float: "double", int: "long long", bool: "bint", type(None): "void"}
MATH = ("acos", "asin", "atan2", "copysign", "cos", "isnan", "sin", "sqrt", "tan")

HEAD = """\
# cython: language_level=3, boundscheck=False, wraparound=False, cdivision=True, infer_types=False
# cython: initializedcheck=False, freethreading_compatible=True
from libc.math cimport INFINITY, NAN, {math}

cdef struct Table:
    double* at
    Py_ssize_t rows

cdef struct Row:
    double* at
    Py_ssize_t rows

cdef struct Indices:
    long long* at
    Py_ssize_t rows

# an index beyond its table, or a slice, leads back to the wrapper, which raises
cdef extern from * nogil:
    '''
    #include <setjmp.h>
    static _Thread_local jmp_buf door;

    static inline Py_ssize_t checked(Py_ssize_t index, Py_ssize_t count) {{
        if ((size_t)index >= (size_t)count)
            longjmp(door, 1);
        return index;
    }}

    static inline Py_ssize_t checked_slice(Py_ssize_t first, Py_ssize_t last, Py_ssize_t count) {{
        checked(last, count + 1);
        return checked(first, last + 1);
    }}
    '''
    ctypedef int jmp_buf
    jmp_buf door
    int setjmp(jmp_buf) noexcept
    Py_ssize_t checked(Py_ssize_t index, Py_ssize_t count) noexcept
    Py_ssize_t checked_slice(Py_ssize_t first, Py_ssize_t last, Py_ssize_t count) noexcept

SOURCE = "{mark}"

"""


class Change(Protocol):
    """What a mutation run changes: every function has a wrapper then."""

    def head(self) -> str:
        """What comes before the functions, asked for last."""

    def function(
        self, tree: ast.FunctionDef, types: Types, function: Callable[..., Any]
    ) -> ast.FunctionDef:
        """A function with its changes."""


def typed_source(change: Change | None = None) -> str:
    """Text of the typed module."""
    functions = kernel_functions()
    compiled = [_compiled(f, functions, change) for f in functions.values()]
    wrappers = [_wrapper(f) for f in functions.values() if change or hasattr(f, "_kaidan_entry")]
    head = HEAD.format(math=", ".join(MATH), mark=source_mark())
    if change:
        head += change.head()
    return head + "\n\n".join(compiled + wrappers) + "\n"


def kernel_functions() -> dict[str, Any]:
    """Functions of the kernel by name, in the order in which they are defined."""
    return _functions([importlib.import_module(f"{KERNEL_PACKAGE}.{n}") for n in KERNEL_MODULES])


def _functions(modules: list[ModuleType]) -> dict[str, Any]:
    """Functions that some modules define; one of each name, as all become one module."""
    found: dict[str, Any] = {}
    for module in modules:
        for name, value in vars(module).items():
            if inspect.isfunction(value) and value.__module__ == module.__name__:
                if name in found:
                    raise ValueError(f"{name}: in {found[name].__module__} and {module.__name__}")
                found[name] = value
    return found


def _hints(function: Callable[..., Any]) -> dict[str, Any]:
    return get_type_hints(function, include_extras=True)


def _columns(hint: Any) -> int | None:
    """Number of columns of a table; 1 for a row; None for what is neither."""
    if hasattr(hint, "__metadata__"):
        return int(hint.__metadata__[0])
    return 1 if hint in (FloatRow, IntArray) else None


def _type(hint: Any) -> str:
    if hint == FloatRow:
        return "Row"
    if hint == IntArray:
        return "Indices"
    if hasattr(hint, "__metadata__"):
        return "Table"
    if get_origin(hint) is tuple:
        return f"({', '.join(_type(part) for part in get_args(hint))})"
    return SCALARS[hint]


def _compiled(
    function: Callable[..., Any], functions: dict[str, Any], change: Change | None = None
) -> str:
    hints = _hints(function)
    answer = _type(hints.pop("return"))
    tree = ast.parse(inspect.getsource(function)).body[0]
    assert isinstance(tree, ast.FunctionDef)
    widths = {name: _columns(hint) for name, hint in hints.items() if _columns(hint)}
    tree = _Unused().visit(tree)
    names = (n for n in ast.walk(tree) if isinstance(n, ast.Name))
    stored = {n.id for n in names if isinstance(n.ctx, ast.Store)}
    module = importlib.import_module(function.__module__)
    types = Types(module, functions, {name: _type(hint) for name, hint in hints.items()})
    declared = types.declarations(tree)
    if change:
        tree = change.function(tree, types, function)
    typing = _Typing(module, functions, widths, types.known, stored | set(hints))
    body = tree.body[1:] if ast.get_docstring(tree) else tree.body
    lines = [ast.unparse(ast.fix_missing_locations(typing.visit(each))) for each in body]
    lines = [*declared, *lines]
    text = "\n".join(f"    {line}" for each in lines for line in each.splitlines())
    given = ", ".join(f"{_type(hint)} {name}" for name, hint in hints.items())
    return f"cdef {answer} c_{function.__name__}({given}) noexcept nogil:\n{text}"


def _wrapper(function: Callable[..., Any]) -> str:
    hints = _hints(function)
    answer = _type(hints.pop("return"))
    given, checks, passed = [], [], []
    for name, hint in hints.items():
        kind = _type(hint)
        if kind == "Table":
            given.append(f"double[:, ::1] {name}")
            checks.append(
                f"    if {name}.shape[1] != {_columns(hint)}:\n"
                f'        raise ValueError("{name}: a table of {_columns(hint)} columns")'
            )
            passed.append(f"Table(&{name}[0, 0], {name}.shape[0])")
        elif kind in ("Row", "Indices"):
            given.append(f"{'double' if kind == 'Row' else 'long long'}[::1] {name}")
            passed.append(f"{kind}(&{name}[0], {name}.shape[0])")
        else:
            given.append(f"{kind} {name}")
            passed.append(name)
    name = function.__name__
    call = f"c_{name}({', '.join(passed)})"
    lines = [f"def {name}({', '.join(given)}):", *checks, "    cdef bint within"]
    if answer != "void":
        lines += [f"    cdef {answer} answer"]
        call = f"answer = {call}"
    lines += ["    with nogil:", "        within = setjmp(door) == 0", "        if within:"]
    lines += [f"            {call}", "    if not within:"]
    lines += [f'        raise IndexError("{name}: a row that its table does not have")']
    if answer != "void":
        lines += ["    return answer"]
    return "\n".join(lines)


class _Unused(ast.NodeTransformer):
    """Gives numbers of a tuple that are not used their own names: one name has one type."""

    def visit_Tuple(self, node: ast.Tuple) -> ast.AST:
        for k, each in enumerate(node.elts):
            if isinstance(each, ast.Name) and each.id == "_":
                each.id = f"unused_{k}_of_{len(node.elts)}"
        return node


class Types:
    """Types of the local variables of one function."""

    def __init__(
        self, module: ModuleType, functions: dict[str, Any], given: dict[str, str]
    ) -> None:
        self.module, self.functions, self.known = module, functions, dict(given)
        self.given = set(given)

    def declarations(self, tree: ast.FunctionDef) -> list[str]:
        """Lines that declare them."""
        for _ in range(2):  # a name may be read, in a loop, above where it is first assigned
            for node in ast.walk(tree):
                self._learn(node)
        kinds = sorted({kind for name, kind in self.known.items() if name not in self.given})
        lines = []
        for kind in kinds:
            names = sorted(n for n, k in self.known.items() if k == kind and n not in self.given)
            lines.append(f"cdef {kind} {', '.join(names)}")
        return lines

    def _learn(self, node: ast.AST) -> None:
        if isinstance(node, ast.For):
            self._note(node.target, "long long")
        elif isinstance(node, ast.Assign):
            for target in node.targets:
                self._note(target, self._of(node.value))
        elif (isinstance(node, ast.AnnAssign) and node.value is not None) or isinstance(
            node, ast.AugAssign
        ):
            self._note(node.target, self._of(node.value))

    def _note(self, target: ast.AST, kind: Any) -> None:
        if isinstance(target, ast.Tuple):
            for each, part in zip(target.elts, _parts(kind, len(target.elts)), strict=True):
                self._note(each, part)
        elif isinstance(target, ast.Name) and kind is not None and target.id not in self.given:
            if isinstance(kind, list):
                kind = f"({', '.join(kind)})"
            self.known[target.id] = _joined([self.known.get(target.id), kind])

    def _of(self, node: ast.AST) -> Any:
        """Type of an expression, a list of types for a tuple; None if not known yet."""
        match node:
            case ast.Constant(value=value):
                return SCALARS[type(value)]
            case ast.Name(id=name):
                if name in self.known or name not in vars(self.module):
                    return self.known.get(name)
                return SCALARS[type(vars(self.module)[name])]
            case ast.Attribute(value=ast.Name(id=owner), attr=name):
                value = getattr(vars(self.module)[owner], name)
                return "double" if isinstance(value, float) else "long long"
            case ast.Tuple(elts=parts):
                return [self._of(each) for each in parts]
            case ast.Compare() | ast.BoolOp() | ast.UnaryOp(op=ast.Not()):
                return "bint"
            case ast.UnaryOp(operand=operand):
                return self._of(operand)
            case ast.IfExp(body=one, orelse=other):
                return _joined([self._of(one), self._of(other)])
            case ast.BinOp(op=ast.Div()):
                return "double"
            case ast.BinOp(left=left, right=right):
                return _joined([self._of(left), self._of(right)])
            case ast.Subscript(value=ast.Attribute()):
                return "long long"
            case ast.Subscript(value=ast.Name(id=name), slice=index):
                kind = self.known[name]
                if isinstance(index, ast.Slice):
                    return kind
                return "long long" if kind == "Indices" else "double"
            case ast.Subscript(value=value, slice=ast.Constant(value=k)):
                return _parts(self._of(value), k + 1)[k]
            case ast.Call(func=ast.Name(id="min" | "max" | "abs"), args=args):
                return _joined([self._of(each) for each in args])
            case ast.Call(func=ast.Name(id="int" | "float" | "bool" as name)):
                return {"int": "long long", "float": "double", "bool": "bint"}[name]
            case ast.Call(func=ast.Name(id=name)):
                hint = _hints(self.functions[name])["return"]
                parts = get_args(hint) if get_origin(hint) is tuple else None
                return [_type(part) for part in parts] if parts else _type(hint)
            case ast.Call(func=ast.Attribute(attr=name)):
                return "bint" if name == "isnan" else "double"
        raise NotImplementedError(ast.unparse(node))


def _parts(kind: Any, count: int) -> list[Any]:
    """Types of the numbers of a tuple."""
    if kind is None:
        return [None] * count
    return kind[1:-1].split(", ") if isinstance(kind, str) else list(kind)


def _joined(kinds: list[Any]) -> Any:
    """Type that holds all of some types; those that are not known yet do not count."""
    known = {kind for kind in kinds if kind is not None}
    if not known:
        return None
    if known == {"bint", "long long"} or known == {"double", "long long"}:
        return "double" if "double" in known else "long long"
    assert len(known) == 1, known
    return known.pop()


class _Typing(ast.NodeTransformer):
    """Rewrites one function's body."""

    def __init__(
        self, module: ModuleType, functions: dict[str, Any], widths: dict[str, int | None],
        kinds: dict[str, str], local: set[str],
    ) -> None:  # fmt: skip
        self.module, self.functions, self.widths, self.local = module, functions, widths, local
        self.kinds = kinds

    def visit_Assign(self, node: ast.Assign) -> ast.AST:
        value, target = node.value, node.targets[0]
        if isinstance(value, ast.Subscript) and isinstance(value.slice, ast.Slice):
            assert isinstance(target, ast.Name)
            assert isinstance(value.value, ast.Name)
            self.widths[target.id] = self.widths[value.value.id]
        return self.generic_visit(node)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        assert node.value is not None
        return self.visit(ast.Assign([node.target], node.value))

    def visit_Name(self, node: ast.Name) -> ast.AST:
        if node.id in self.local or not isinstance(node.ctx, ast.Load):
            return node
        value = vars(self.module).get(node.id)
        return _constant(value) if isinstance(value, int | float) else node

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        assert isinstance(node.value, ast.Name)
        value = getattr(vars(self.module)[node.value.id], node.attr)
        if isinstance(value, int | float):
            return _constant(value)
        assert node.attr in MATH, node.attr
        return ast.Name(node.attr, ast.Load())

    def visit_Call(self, node: ast.Call) -> ast.AST:
        if isinstance(node.func, ast.Name) and node.func.id in self.functions:
            node.func = ast.Name(f"c_{node.func.id}", ast.Load())
            node.args = [self.visit(each) for each in node.args]
            return node
        if isinstance(node.func, ast.Name) and node.func.id in ("int", "float", "bool"):
            kind = {"int": "long long", "float": "double", "bool": "bint"}[node.func.id]
            return ast.Name(f"(<{kind}> ({ast.unparse(self.visit(node.args[0]))}))", ast.Load())
        return self.generic_visit(node)

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        if isinstance(node.value, ast.Attribute):  # table.shape[0]
            return ast.Attribute(node.value.value, "rows", ast.Load())
        if not (isinstance(node.value, ast.Name) and node.value.id in self.widths):
            return self.generic_visit(node)  # one number of a tuple
        width = self.widths[node.value.id]
        if isinstance(node.slice, ast.Slice):
            assert node.slice.lower is not None
            assert node.slice.upper is not None
            first, last = (ast.unparse(self.visit(e)) for e in (node.slice.lower, node.slice.upper))
            rows = f"{node.value.id}.rows"
            at = f"{node.value.id}.at + checked_slice({first}, {last}, {rows}) * {width}"
            kind = self.kinds[node.value.id]
            return ast.Name(f"{kind}({at}, ({last}) - ({first}))", ast.Load())
        index = node.slice
        if isinstance(index, ast.Tuple):
            row, column = (self.visit(each) for each in index.elts)
            index = ast.BinOp(ast.BinOp(row, ast.Mult(), ast.Constant(width)), ast.Add(), column)
        else:
            index = self.visit(index)
        rows = ast.Attribute(node.value, "rows", ast.Load())
        count = ast.BinOp(rows, ast.Mult(), ast.Constant(width))
        index = ast.Call(ast.Name("checked", ast.Load()), [index, count], [])
        at = ast.Attribute(node.value, "at", ast.Load())
        return ast.Subscript(at, index, node.ctx)


def _constant(value: float) -> ast.AST:
    if isinstance(value, float) and not math.isfinite(value):
        return ast.Name("NAN" if math.isnan(value) else "INFINITY", ast.Load())
    return ast.Constant(float(value) if isinstance(value, float) else int(value))
