"""Mutation run: break the code in one place at a time, and see whether a test notices.

mutmut leaves decorated functions out, which is every function of the contact kernel, and starts
a process a mutant. Here the tests are collected once; each mutant is a fork in which the code of
one function is exchanged, and only the tests that pass over its line are run, the fastest first.

Example (see docs/mutation.md)::

    python benchmarks/mutation.py --of src/kaidan/contact/kernel/gaps.py --out gaps.jsonl \\
        -- tests/unit/contact -m "not slow"
"""

import argparse
import ast
import copy
import gc
import importlib
import json
import os
import resource
import signal
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import _lru_cache_wrapper
from pathlib import Path
from types import CodeType, FrameType, FunctionType

import pytest

LEAST_LIMIT = 2.0
"""CPU time that a test may take at least before a mutant counts as one that hangs [s]."""
SLOWER = 8.0
"""A mutant hangs if a test takes this many times its usual CPU time."""
MEMORY = 4 << 30
"""Address space of a mutant [B]."""
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
            for parent in ast.walk(statement):
                yield from _of_statement(path, tree, name, parent)
            if not isinstance(statement, ast.Expr):  # as children the loop above has them
                yield from _replaced(path, tree, name, function, "body", statement)


def _of_statement(
    path: Path, tree: ast.Module, name: str, parent: ast.AST
) -> Iterator[tuple[Mutant, CodeType]]:
    if isinstance(parent, ast.AnnAssign):
        fields: tuple[str, ...] = ("value",)  # no type is changed
    else:
        fields = parent._fields
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


def load(path: Path) -> None:
    """Import a module of ``src`` that no test has imported yet."""
    parts = path.with_suffix("").parts
    first = len(parts) - parts[::-1].index("src")
    importlib.import_module(".".join(parts[first:]).removesuffix(".__init__"))


def live(path: Path) -> dict[str, list[FunctionType]]:
    """Functions of a file that this process holds."""
    gc.unfreeze()  # what the tests have set aside
    held: dict[str, list[FunctionType]] = {}
    for each in gc.get_objects():
        if isinstance(each, FunctionType) and each.__code__.co_filename == str(path):
            held.setdefault(each.__code__.co_qualname, []).append(each)
    return held


def caches() -> list[_lru_cache_wrapper]:
    """Functions that remember their answers, but for those that are frozen."""
    return [each for each in gc.get_objects() if isinstance(each, _lru_cache_wrapper)]


class Lines:
    """Lines of some files over which one test passes."""

    def __init__(self, paths: list[Path]) -> None:
        self.paths = {str(path) for path in paths}
        self.seen: set[tuple[str, int]] = set()
        self.done: Counter[CodeType] = Counter()

    def call(self, frame: FrameType, event: str, argument: object) -> object:
        if frame.f_code.co_filename not in self.paths or self.done[frame.f_code] > 100_000:
            return None
        return self.line

    def line(self, frame: FrameType, event: str, argument: object) -> object:
        if event == "line":
            at = (frame.f_code.co_filename, frame.f_lineno)
            if at in self.seen:
                self.done[frame.f_code] += 1
            else:
                self.seen.add(at)
                self.done[frame.f_code] = 0
        return self.line


class Run:
    """Pytest plugin that runs mutants in place of the tests."""

    def __init__(self, chosen: argparse.Namespace) -> None:
        self.paths = [path.resolve() for path in chosen.of]
        self.out, self.only, self.longest = chosen.out, chosen.only, chosen.longest
        self.sample = chosen.sample
        self.again = None
        if chosen.again is not None:
            self.again = {each.key for each in answers(chosen.again) if each.lives}
        self.failed = False

    def pytest_configure(self) -> None:
        from hypothesis import settings  # not before pytest, which rewrites it

        settings.register_profile("mutation", derandomize=True, database=None, deadline=None)
        settings.load_profile("mutation")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.failed |= report.failed

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        items = session.items
        usual = self._baseline(items)
        done = {each.key for each in answers(self.out)}
        counts: Counter[str] = Counter()
        last: dict[str, int] = {}
        for path in self.paths:
            load(path)
            held = live(path)
            gc.freeze()  # nothing held here is garbage
            for mutant, code in self._sampled(list(mutants(path))):
                if mutant.key in done or self.only not in mutant.function:
                    continue
                if self.again is not None and mutant.key not in self.again:
                    continue
                at = [str(path), mutant.line]
                chosen = [k for k, (_, lines) in usual.items() if at in lines]
                chosen.sort(key=lambda k: (k != last.get(mutant.function), usual[k][0]))
                mutant.outcome = UNTESTED
                if chosen:
                    mutant.outcome, killer = self._try(
                        held[mutant.function], code, items, chosen, usual
                    )
                    if killer is not None:
                        mutant.by, last[mutant.function] = items[killer].nodeid, killer
                counts[mutant.outcome] += 1
                with self.out.open("a") as file:
                    file.write(json.dumps(asdict(mutant)) + "\n")
                if mutant.lives:
                    print(f"{mutant.outcome}: {mutant.file}:{mutant.line} {mutant.function}: "
                          f"{mutant.before}  ->  {mutant.after}", flush=True)  # fmt: skip
        print(dict(counts))
        return True

    def _sampled(self, every: list[tuple[Mutant, CodeType]]) -> list[tuple[Mutant, CodeType]]:
        """As many mutants as asked for, spread evenly over the file; all if none are asked for."""
        count = min(self.sample or len(every), len(every))
        print(f"{count} of {len(every)} mutants", flush=True)
        return [every[k * len(every) // count] for k in range(count)]

    def _baseline(self, items: list[pytest.Item]) -> dict[int, tuple[float, list[list[object]]]]:
        """Time and lines of each test, worked out in a fork so that no cache here is filled."""
        read, write = os.pipe()
        if os.fork() == 0:
            os.close(read)
            self._quiet()
            usual: dict[int, tuple[float, list[object]]] = {}
            gc.unfreeze()  # what the tests have set aside
            held = caches()
            gc.freeze()
            for k, item in enumerate(items):
                start = time.process_time()
                failed = self._ask(item, None)
                took = time.process_time() - start
                if failed or took > self.longest:
                    continue
                for each in (*held, *caches()):
                    each.cache_clear()  # so that its lines are passed again
                lines = Lines(self.paths)
                sys.settrace(lines.call)
                self._ask(item, None)
                sys.settrace(None)
                if lines.seen:
                    usual[k] = (took, sorted(lines.seen))
            with os.fdopen(write, "w") as pipe:
                json.dump(usual, pipe)
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as pipe:
            usual = {int(k): tuple(each) for k, each in json.load(pipe).items()}
        os.wait()
        total = sum(each[0] for each in usual.values())
        print(
            f"{len(items)} tests, {len(usual)} that pass over the code, {total:.1f} s", flush=True
        )
        return usual

    def _ask(self, item: pytest.Item, nextitem: pytest.Item | None) -> bool:
        """Whether a test fails."""
        self.failed = False
        item.config.hook.pytest_runtest_protocol(item=item, nextitem=nextitem)
        return self.failed

    def _quiet(self) -> None:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)

    def _try(self, held, code, items, chosen, usual):
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(read)
            os.setsid()
            self._quiet()
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            for each in held:
                each.__code__ = code.replace(co_freevars=each.__code__.co_freevars)
            at = chosen[0]

            def hangs(*_: object) -> None:
                os.write(write, f"{HANGS} {at}".encode())
                os._exit(0)

            signal.signal(signal.SIGVTALRM, hangs)
            for at in chosen:
                limit = max(LEAST_LIMIT, SLOWER * usual[at][0])
                signal.setitimer(signal.ITIMER_VIRTUAL, limit)
                if self._ask(items[at], None):
                    os.write(write, f"{KILLED} {at}".encode())
                    os._exit(0)
            os.write(write, SURVIVES.encode())
            os._exit(0)
        os.close(write)
        with os.fdopen(read) as pipe:
            answer = pipe.read().split()
        os.waitpid(child, 0)
        if not answer:
            return KILLED, chosen[0]  # the process itself did not survive
        return answer[0], int(answer[1]) if len(answer) > 1 else None


def main() -> None:
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--of", nargs="+", type=Path, required=True, help="files to change")
    arguments.add_argument(
        "--out", type=Path, required=True, help="answers, JSON a line; continued"
    )
    arguments.add_argument("--only", default="", help="functions whose name holds this")
    arguments.add_argument("--again", type=Path, help="only what survives in this file of answers")
    arguments.add_argument("--sample", type=int, help="only so many mutants of a file [all]")
    arguments.add_argument(
        "--longest", type=float, default=60.0, help="leave out tests that take longer [s]"
    )
    arguments.add_argument(
        "--native", action="store_true", help="on the native kernel: for code outside it"
    )
    chosen = arguments.parse_args(sys.argv[1:split])
    os.environ["KAIDAN_KERNEL"] = "native" if chosen.native else "plain"
    tests = sys.argv[split + 1 :]
    pytest.main(
        ["-q", "-s", "-p", "no:cacheprovider", "-p", "no:xdist", *tests], plugins=[Run(chosen)]
    )


if __name__ == "__main__":
    main()
