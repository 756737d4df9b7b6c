"""The contact kernel as plain C, written from its plain Python source.

Its rules are in ``docs/subset.md``. Local variables are declared from what is assigned to them;
what the rules do not know is refused, with its file and line.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args, get_origin, get_type_hints

NUMBERS = {float: "double", int: "int64_t", bool: "bool"}
LETTERS = {float: "d", int: "i", bool: "b"}
MATH = {"sqrt": float, "copysign": float, "isnan": bool}
SIGNS = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.RShift: ">>", ast.BitAnd: "&",
    ast.BitXor: "^", ast.Eq: "==", ast.NotEq: "!=", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">",
    ast.GtE: ">=", ast.And: "&&", ast.Or: "||",
}  # fmt: skip
WHOLE = {ast.FloorDiv: "FLOOR_DIV", ast.Mod: "FLOOR_MOD"}
NOTHING = type(None)
Typed = tuple[str, Any]  # an expression in C, and its type in Python


def is_place(of: Any) -> bool:
    """Whether a type is a record, which is written to."""
    return dataclasses.is_dataclass(of)


def is_value(of: Any) -> bool:
    """Whether a type is a named tuple, which never changes."""
    return isinstance(of, type) and hasattr(of, "_fields")


def element(of: Any) -> Any:
    """What a table or a row holds; None of what is neither."""
    is_table = getattr(get_origin(of), "__name__", "") in ("Table", "Row")
    return get_args(of)[0] if is_table else None


def fields(of: Any) -> dict[str, Any]:
    """Types of the fields of a record, a named tuple or a tuple."""
    if get_origin(of) is tuple:
        return {f"_{k}": each for k, each in enumerate(get_args(of))}
    return get_type_hints(of)


class Module:
    """The C module: its types, its functions, its text."""

    def __init__(self, modules: list[Any]) -> None:
        self.types: dict[str, str] = {}
        self.kinds: list[Any] = [float, int, bool]
        self.names = {
            value: f"{module.__name__.rpartition('.')[2]}_{name}"
            for module in modules
            for name, value in vars(module).items()
            if inspect.isfunction(value) and value.__module__ == module.__name__
        }
        self.hints = {each: get_type_hints(each) for each in self.names}

    def type_of(self, of: Any, inside: bool = False) -> str:
        """A type in C, declared where it is first used; a record is a pointer unless inside."""
        if of in NUMBERS or of is NOTHING:
            return NUMBERS.get(of, "void")
        if element(of):
            held = self.type_of(element(of), True)
            name, body = f"Table_{held}", f"{held} *at; int64_t count;"
        elif is_place(of) or is_value(of) or get_origin(of) is tuple:
            held_in = {key: self.type_of(part, True) for key, part in fields(of).items()}
            name = "_".join(("Tuple", *held_in.values())) if get_origin(of) else of.__name__
            body = " ".join(f"{part} {key};" for key, part in held_in.items())
            if is_place(of) and of not in self.kinds and "Table" not in body:
                self.kinds.append(of)
        else:
            raise SyntaxError(f"no type of the subset: {of}")
        if self.types.setdefault(name, body) != body:
            raise SyntaxError(f"two types of the name {name}")
        return f"{name} *" if is_place(of) and not inside else name

    def layout(self, of: Any) -> str:
        """A type in the words of ``runtime.h``; what is no row may begin with noughts."""
        if of is NOTHING or of in LETTERS:
            return LETTERS.get(of, "")
        if element(of):
            self.type_of(of)
            return "T" + chr(ord("A") + self.kinds.index(element(of)))
        places = dataclasses.fields(of) if is_place(of) and of not in self.kinds else ()
        begun = {each.name for each in places if each.default == 0}
        inner = ("z" if key in begun else self.layout(part) for key, part in fields(of).items())
        return f"({''.join(inner)})"

    def text(self, source: str, entries: Any) -> str:
        """Text of it all; Python may call the entries. ``source``: mark of the Python source."""
        functions = {each: Function(self, each) for each in self.names}
        bodies = [each.text() for each in functions.values()]
        called = {self.names[each]: functions[each] for each in entries}
        runs = [self.run(name, each) for name, each in called.items()]
        rows = [
            f'    {{"{each.python.__name__}", "{"".join(map(self.layout, each.given.values()))}", '
            f'"{self.layout(each.answer)}", run_{name}}},'
            for name, each in called.items()
        ]
        most = " ".join(f"Call_{name} of_{name};" for name in called)
        kinds = [(e.__name__, self.type_of(e, True), self.layout(e)) for e in self.kinds]
        runtime = (Path(__file__).parent / "runtime.h").read_text(encoding="utf-8")
        checks, cut, door = runtime.partition("/* A call is")
        return "\n".join([
            "/* written by native/emitter.py from the Python source: change that */", checks,
            *(f"typedef struct {{ {body} }} {name};" for name, body in self.types.items()),
            *(f"{each.head()};" for each in functions.values()), *bodies, '#line 1 "calls"', *runs,
            f"typedef union {{ {most} }} AnyCall;", f'#define SOURCE "{source}"',
            "#define KINDS " + ", ".join(f'{{"{a}", sizeof({b}), "{c}"}}' for a, b, c in kinds),
            "#define ENTRIES \\", " \\\n".join(rows), '#line 1 "runtime.h"', cut + door,
        ])  # fmt: skip

    def run(self, name: str, of: Function) -> str:
        """What an entry is given and what it answers, as one struct, and the call itself."""
        body = [f"{self.type_of(part, True)} {key};" for key, part in of.given.items()]
        passed = [
            f"{'&' if is_place(part) or is_value(part) else ''}call->{key}"
            for key, part in of.given.items()
        ]
        text = f"{name}({', '.join(passed)})"
        if of.answer is not NOTHING:
            body.append(f"{self.type_of(of.answer)} answer;")
            text = f"call->answer = {text}"
        return (
            f"typedef struct {{ {' '.join(body)} }} Call_{name};\n"
            f"EXPORT({name}) void run_{name}(void *at) {{ Call_{name} *call = at; {text}; }}"
        )


class Function:
    """One function of it: its types, its text."""

    def __init__(self, module: Module, python: Any) -> None:
        self.module, self.python, self.name = module, python, module.names[python]
        self.given = dict(module.hints[python])
        self.answer = self.given.pop("return")
        self.types, self.scope = dict(self.given), python.__globals__
        self.file = Path(python.__code__.co_filename).as_posix().rpartition("/src/")[2]
        self.tree: Any = ast.parse(inspect.getsource(python)).body[0]
        ast.increment_lineno(self.tree, python.__code__.co_firstlineno - 1)

    def refused(self, node: Any, why: str) -> SyntaxError:
        return SyntaxError(f"{self.file}:{node.lineno}: {why}: {ast.unparse(node)}")

    def head(self) -> str:
        given = [
            f"{'const ' * is_value(of)}{self.module.type_of(of)} {'*' * is_value(of)}{key}"
            for key, of in self.given.items()
        ]
        return f"static {self.module.type_of(self.answer)} {self.name}({', '.join(given)})"

    def text(self) -> str:
        for _ in range(3):  # a name may be read, in a loop, above where it is first assigned
            for node in ast.walk(self.tree):
                self.learn(node)
        own = {key: of for key, of in self.types.items() if key not in self.given}
        lines = [f"{self.module.type_of(of)} {key};" for key, of in own.items()]
        lines += ["KEEP_UNTIL_LEFT;"] if "empty(" in ast.unparse(self.tree) else []
        body = self.tree.body[1:] if ast.get_docstring(self.tree) else self.tree.body
        lines += [line for each in body for line in self.statement(each)]
        return "\n".join([f"{self.head()} {{", *lines, "}"])

    def learn(self, node: Any) -> None:
        """Note the types of variables to which a statement assigns."""
        try:
            if isinstance(node, ast.For):
                self.note(node.target, int)
            elif isinstance(node, ast.Assign):
                self.note(node.targets[0], self.of(node.value))
            elif isinstance(node, ast.AnnAssign):
                self.note(node.target, eval(ast.unparse(node.annotation), self.scope))
        except SyntaxError:
            pass  # told when its text is written, unless it is assigned below

    def note(self, target: Any, of: Any) -> None:
        if isinstance(target, ast.Tuple):
            for each, part in zip(target.elts, fields(of).values(), strict=True):
                self.note(each, part)
        elif isinstance(target, ast.Name) and target.id not in self.given and target.id != "_":
            self.types[target.id] = self.joined(target, self.types.get(target.id, of), of)

    def joined(self, node: Any, one: Any, other: Any) -> Any:
        """Type that holds both: one with a fraction holds a whole number too."""
        if one != other and {one, other} != {int, float}:
            raise self.refused(node, f"both {one} and {other}")
        return one if one == other else float

    def statement(self, node: Any) -> Iterator[str]:
        yield f'#line {node.lineno} "{self.file}"'
        match node:
            case ast.Expr(value=ast.Call()):
                yield f"{self.expression(node.value)[0]};"
            case ast.Assign(targets=[target]) | ast.AnnAssign(target=target):
                yield from self.assign(target, node.value)
            case ast.AugAssign(target=target, op=op, value=value):
                changed = ast.copy_location(ast.BinOp(target, op, value), node)
                yield from self.assign(target, changed)
            case ast.If(test=test, body=body, orelse=orelse):
                yield from self.block(f"if ({self.number(test, bool)[0]})", body)
                yield from self.block("else", orelse) if orelse else ()
            case ast.While(test=test, body=body, orelse=[]):
                yield from self.block(f"while ({self.number(test, bool)[0]})", body)
            case ast.For(
                target=ast.Name(id=key), orelse=[],
                iter=ast.Call(func=ast.Name(id="range"), args=args),
            ):  # fmt: skip
                yield from self.block(
                    self.counted(args), node.body, *([] if key == "_" else [f"{key} = each_;"])
                )
            case ast.Return(value=value):
                yield f"return {'' if value is None else self.as_type(value, self.answer)};"
            case ast.Break() | ast.Continue():
                yield f"{ast.unparse(node)};"
            case _:
                raise self.refused(node, "no statement of the subset")

    def block(self, head: str, body: list[Any], *first: str) -> Iterator[str]:
        yield from (f"{head} {{", *first)
        yield from (line for each in body for line in self.statement(each))
        yield "}"

    def place(self, target: Any) -> str:
        """Where a number is written to."""
        text, of = self.expression(target)
        if (is_place(of) and not isinstance(target, ast.Name)) or text.startswith("(*"):
            raise self.refused(target, "a record is copied by put(), a named tuple given stays")
        return text

    def assign(self, target: Any, value: Any) -> Iterator[str]:
        of = self.of(value)
        if not isinstance(target, ast.Tuple):
            yield f"{self.place(target)} = {self.as_type(value, self.of(target))};"
            return
        yield f"{{ {self.module.type_of(of)} all_ = {self.as_type(value, of)};"
        for each, key in zip(target.elts, fields(of), strict=True):
            if not isinstance(each, ast.Name) or each.id != "_":
                yield f"{self.place(each)} = all_.{key};"
        yield "}"

    def counted(self, args: list[Any]) -> str:
        """Head of a loop over a range, of which the count is taken once."""
        first, last = ("0", *(self.as_type(each, int) for each in args[:2]))[-2:]
        step = ast.literal_eval(args[2]) if len(args) > 2 else 1
        ends = f"each_ {'<' if step > 0 else '>'} last_; each_ += {step}"
        return f"for (int64_t each_ = {first}, last_ = {last}; {ends})"

    def of(self, node: Any) -> Any:
        return self.expression(node)[1]

    def number(self, node: Any, *allowed: Any) -> Typed:
        text, of = self.expression(node)
        if of not in (allowed or (float, int)):
            raise self.refused(node, f"{of} where a number is expected")
        return text, of

    def as_type(self, node: Any, of: Any) -> str:
        """An expression where a type is expected."""
        if isinstance(node, ast.Tuple) and (is_value(of) or get_origin(of) is tuple):
            return self.struct(node.elts, of)
        text, own = self.expression(node)
        if self.joined(node, own, of) != of:
            raise self.refused(node, "a whole number is expected")
        return text

    def struct(self, parts: list[Any], of: Any) -> str:
        pairs = zip(parts, fields(of).values(), strict=True)
        inner = ", ".join(self.as_type(each, part) for each, part in pairs)
        return f"({self.module.type_of(of, True)}){{{inner}}}"

    def argument(self, node: Any, of: Any) -> str:
        """A named tuple is handed on by reference, as it never changes."""
        text = self.as_type(node, of)
        if not is_value(of):
            return text
        return f"&{text}" if isinstance(node, ast.Name) else f"({of.__name__}[1]){{{text}}}"

    def constant(self, node: Any, value: Any) -> Typed:
        of = next((each for each in (bool, int, float) if isinstance(value, each)), None)
        if of is None:
            raise self.refused(node, "no number")
        if of is float and not math.isfinite(value):
            return "NAN" if math.isnan(value) else f"({'-' * (value < 0)}INFINITY)", float
        return f"({of(value)!r})".lower(), of

    def expression(self, node: Any) -> Typed:
        """Text of an expression, and its type."""
        match node:
            case ast.Constant(value=value):
                return self.constant(node, value)
            case ast.Name(id=key) | ast.Attribute(value=ast.Name(id=key)) if key not in self.types:
                if key not in self.scope:
                    raise self.refused(node, "nothing is assigned to it")
                return self.constant(node, eval(ast.unparse(node), self.scope))
            case ast.Name(id=key):
                of = self.types[key]
                return (f"(*{key})" if is_value(of) and key in self.given else key), of
            case ast.Attribute(value=value, attr=name):
                text, of = self.expression(value)
                if not is_place(of) and not is_value(of):
                    raise self.refused(node, f"a field of {of}")
                part = fields(of)[name]
                text = f"{text}{'->' if is_place(of) else '.'}{name}"
                return (f"(&{text})" if is_place(part) else text), part
            case ast.Subscript(value=value, slice=index):
                return self.subscript(node, *self.expression(value), index)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"(!{self.number(operand, bool)[0]})", bool
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                text, of = self.number(operand)
                return f"(-{text})", of
            case ast.BinOp(left=left, op=op, right=right):
                return self.operation(node, self.number(left), op, self.number(right))
            case ast.BoolOp(op=op, values=values):
                texts = [self.number(each, bool)[0] for each in values]
                return f"({f' {SIGNS[type(op)]} '.join(texts)})", bool
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                one, other = (self.number(each, float, int, bool)[0] for each in (left, right))
                return f"({one} {SIGNS[type(op)]} {other})", bool
            case ast.IfExp(test=test, body=body, orelse=orelse):
                (one, of), (other, its) = self.expression(body), self.expression(orelse)
                return f"({self.number(test, bool)[0]} ? {one} : {other})", self.joined(
                    node, of, its
                )
            case ast.Tuple(elts=elts):
                of = tuple[tuple(map(self.of, elts))]  # type: ignore[misc]
                return self.as_type(node, of), of
            case ast.Call(func=ast.Attribute(value=ast.Name(id="math"), attr=name), args=args):
                if name in MATH:
                    given = ", ".join(self.number(each)[0] for each in args)
                    return f"{name}({given})", MATH[name]
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
                return self.call(node, name, args)
        raise self.refused(node, "no expression of the subset")

    def subscript(self, node: Any, text: str, of: Any, index: Any) -> Typed:
        held = element(of)
        if held is None:
            raise self.refused(node, f"a row of {of}")
        if isinstance(index, ast.Slice):
            first = self.as_type(index.lower, int) if index.lower else "0"
            last = self.as_type(index.upper, int) if index.upper else f"{text}.count"
            return f"SLICE({self.module.type_of(of)}, {text}, {first}, {last})", of
        place = f"ROW({text}, {self.as_type(index, int)})"
        return (f"(&{place})" if is_place(held) else place), held

    def operation(self, node: Any, one: Typed, op: Any, other: Typed) -> Typed:
        (left, of), (right, its) = one, other
        whole = of is its is int
        if isinstance(op, ast.Div):
            return f"({'(double)' * whole}{left} / {right})", float
        if type(op) in WHOLE and whole:
            return f"{WHOLE[type(op)]}({left}, {right})", int
        if isinstance(op, ast.Add | ast.Sub | ast.Mult) or (type(op) in SIGNS and whole):
            return f"({left} {SIGNS[type(op)]} {right})", self.joined(node, of, its)
        raise self.refused(node, "no operation of the subset")

    def call(self, node: Any, name: str, args: list[Any]) -> Typed:
        named = self.scope.get(name)
        if name in ("min", "max", "abs"):
            texts, kinds = zip(*map(self.number, args), strict=True)
            of = int if set(kinds) == {int} else float
            text = f"abs_{NUMBERS[of]}({texts[0]})" if name == "abs" else texts[0]
            for each in texts[1:]:
                text = f"{name}_{NUMBERS[of]}({text}, {each})"
            return text, of
        if name == "len":
            return f"{self.expression(args[0])[0]}.count", int
        if name == "int":
            text, of = self.number(args[0])
            return (text if of is int else f"WHOLE({text})"), int
        if name == "put":
            return f"*{self.expression(args[0])[0]} = *{self.expression(args[1])[0]}", NOTHING
        if name == "empty":
            kind = eval(ast.unparse(args[0]), self.scope)
            table = named.__globals__["Row" if kind in NUMBERS else "Table"][kind]
            inside = self.module.type_of(kind, True)
            count = self.as_type(args[1], int)
            return f"EMPTY({self.module.type_of(table)}, {inside}, {count})", table
        if is_value(named) or is_place(named):
            missing = list(inspect.signature(named).parameters.values())[len(args) :]
            more = [ast.Constant(each.default) for each in missing]
            text = self.struct([*args, *more], named)
            return f"(&{text})" if is_place(named) else text, named
        if named not in self.module.names:
            raise self.refused(node, "no function of the kernel")
        hints = dict(self.module.hints[named])
        answer = hints.pop("return")
        pairs = zip(args, hints.values(), strict=True)
        given = [self.argument(each, of) for each, of in pairs]
        return f"{self.module.names[named]}({', '.join(given)})", answer
