"""All mutants of kernel modules in one native kernel, chosen by a number while it runs.

Each expression that a mutant changes becomes a choice::

    a < b      ->     (a <= b if is_chosen(17) else a < b)

`is_chosen` notes which choices a test passes. What the typed language refuses (a quotient as an
index) is left out; an index beyond its table is an error, as of a plain kernel.
"""

import ast
import copy
import hashlib
import importlib.util
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from types import FunctionType, ModuleType

from mutants import Mutant, changes

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "native"))

HEAD = """\
cdef int CHOSEN = -1
cdef char SEEN[{count}]

cdef inline bint is_chosen(int mutant) noexcept nogil:
    SEEN[mutant] = 1
    return mutant == CHOSEN

def choose(int mutant):
    global CHOSEN
    CHOSEN = mutant

def forget():
    for k in range({count}):
        SEEN[k] = 0

def seen():
    return [k for k in range({count}) if SEEN[k]]

"""
# a == 1 and a == 2 within a conditional expression would become a switch as for a == 1 or a == 2
NO_SWITCH = "# cython: optimize.use_switch=False\n"
NATIVE = "kaidan.contact._native"


class Choices(ast.NodeTransformer):
    """Puts each mutant of the functions of some files beside what it changes."""

    def __init__(self, paths: list[Path]) -> None:
        self.paths = paths
        self.mutants: list[tuple[Path, Mutant]] = []

    def head(self) -> str:
        return HEAD.format(count=max(len(self.mutants), 1))

    def function(self, tree: ast.FunctionDef, types: object, function: FunctionType) -> ast.AST:
        """The function with its choices."""
        path = Path(function.__code__.co_filename)
        if path in self.paths:
            self.path, self.name, self.types = path, function.__name__, types
            self.above = function.__code__.co_firstlineno - 1
            tree.body = [self.visit(each) for each in tree.body]
        return tree

    def visit(self, node: ast.AST) -> ast.AST:
        others = list(changes(node))
        was = copy.deepcopy(node) if others else node
        node = super().visit(node)
        for other in others:
            node = self._choice(was, other, was, other, node)
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        assert node.value is not None
        node.value = self.visit(node.value)
        return node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """A call of another function, as no choice is called; the step of a range stays."""
        was = copy.deepcopy(node)
        in_range = isinstance(node.func, ast.Name) and node.func.id == "range"
        chosen = node.args[:2] if in_range else node.args
        node.args = [*(self.visit(each) for each in chosen), *node.args[len(chosen) :]]
        new: ast.AST = node
        for other in changes(was.func):
            new = self._choice(was.func, other, was, ast.Call(other, was.args, []), new)
        return new

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        """Another number of a tuple, as no choice is the place in a tuple."""
        if not isinstance(node.slice, ast.Constant) or not isinstance(node.ctx, ast.Load):
            return self.generic_visit(node)
        if isinstance(node.value, ast.Attribute):  # table.shape[0]
            return node
        was = copy.deepcopy(node)
        node.value = self.visit(node.value)
        new: ast.AST = node
        kind = self.types._of(was.value)  # type: ignore[attr-defined]
        if isinstance(kind, str) and kind.startswith("("):
            kind = kind[1:-1].split(", ")
        for other in changes(was.slice):
            if isinstance(kind, list) and not _alike(kind, was.slice.value, other):
                continue
            changed = ast.Subscript(was.value, other, was.ctx)
            new = self._choice(was.slice, other, was, changed, new)
        return new

    def _choice(
        self, before: ast.AST, after: ast.AST, was: ast.AST, other: ast.AST, new: ast.AST
    ) -> ast.AST:
        """The new node and beside it the other one, if it is of the same type."""
        if isinstance(other, ast.expr) and not self._same_type(was, other):
            return new
        chosen = ast.Call(ast.Name("is_chosen", ast.Load()), [ast.Constant(len(self.mutants))], [])
        line = self.above + before.lineno  # type: ignore[attr-defined]
        self.mutants.append((
            self.path,
            Mutant(self.path.name, self.name, line, ast.unparse(before), ast.unparse(after)),
        ))  # fmt: skip
        if isinstance(other, ast.stmt):
            assert isinstance(new, ast.stmt)
            return ast.If(chosen, [other], [new])
        return ast.IfExp(chosen, other, new)  # type: ignore[arg-type]

    def _same_type(self, was: ast.AST, other: ast.AST) -> bool:
        try:
            return bool(self.types._of(was) == self.types._of(other))  # type: ignore[attr-defined]
        except (AssertionError, IndexError, KeyError, NotImplementedError):
            return False


def _alike(kinds: list[str], place: int, other: ast.AST) -> bool:
    """Whether a tuple of these types has another place of the same type."""
    assert isinstance(other, ast.Constant)
    return other.value < len(kinds) and kinds[other.value] == kinds[place]


class CompiledMutants:
    """Mutants of kernel modules in one native kernel, which all of this process calls from then on.

    The kernel is built into a folder, or found there if it was built from the same text.
    """

    def __init__(self, paths: list[Path], folder: Path) -> None:
        from hatch_build import compiled
        from typed_source import kernel_functions, typed_source

        choices = Choices(paths)
        text = NO_SWITCH + typed_source(choices)
        library = folder / f"mutants-{hashlib.sha256(text.encode()).hexdigest()[:16]}.so"
        if not library.exists():
            with tempfile.TemporaryDirectory() as work:
                shutil.copy(compiled(ROOT, Path(work), text), library)
        self.native = _loaded(library)
        self.of = choices.mutants
        for name, function in kernel_functions().items():
            _led(function, name, self.native)

    def of_file(self, path: Path) -> Iterator[tuple[Mutant, object, Callable[[], None]]]:
        """Each mutant of a file, its number, and what makes this process run it."""
        for number, (of, mutant) in enumerate(self.of):
            if of == path:
                yield mutant, number, partial(self.native.choose, number)

    def reached(self, ask: Callable[[], object]) -> list[object]:
        """Numbers of the mutants that are passed over."""
        self.native.forget()
        ask()
        return list(self.native.seen())


def _loaded(library: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(NATIVE, library)
    assert spec is not None
    assert spec.loader is not None
    sys.modules[NATIVE] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sys.modules[NATIVE])
    return sys.modules[NATIVE]


def _led(function: FunctionType, name: str, native: ModuleType) -> None:
    """Lead all who hold a plain function, tests for example, to its machine code."""

    def call(*given, **named):  # type: ignore[no-untyped-def]
        return _machine_code.NAME(*given, **named)  # type: ignore[name-defined]  # noqa: F821

    function.__globals__["_machine_code"] = native
    names = tuple(name if each == "NAME" else each for each in call.__code__.co_names)
    function.__code__ = call.__code__.replace(co_names=names, co_name=name)
