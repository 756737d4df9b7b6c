"""The kernel's source as plain C: what is folded, what is checked, and what is refused."""

import importlib
import importlib.machinery
import importlib.util
import math
import re
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "native"))

from compiling import NoCompilerError, compile_library, compiler
from emitter import Module

HEAD = """
import math
from dataclasses import dataclass
from typing import NamedTuple
from kaidan.contact.memory import Row, Table, empty, put

HALF = 0.5

class Place(NamedTuple):
    x: float
    z: float

@dataclass(slots=True)
class Disc:
    r: float
    number: int
"""
COUNTER = iter(range(1000))


@pytest.fixture
def module(tmp_path, monkeypatch):
    """A module of some functions."""
    monkeypatch.syspath_prepend(tmp_path)

    def of(text, name=None):
        name = name or f"emitted_{next(COUNTER)}"
        (tmp_path / f"{name}.py").write_text(HEAD + text)
        importlib.invalidate_caches()
        return importlib.import_module(name)

    return of


def emitted(module, *names):
    """Text of the functions, without where their lines come from."""
    made = Module([module])
    text = made.text("mark", [vars(module)[name] for name in names])
    bodies = text[text.index("static ") :].splitlines()
    return made, [line for line in bodies if not line.startswith("#line")]


def body_of(module, name):
    _, lines = emitted(module)
    begin = next(k for k, line in enumerate(lines) if f"_{name}(" in line and line.endswith("{"))
    depth = 1
    for end in range(begin + 1, len(lines)):
        depth += lines[end].count("{") - lines[end].count("}")
        if depth == 0:
            return lines[begin + 1 : end]
    raise AssertionError(lines)


def test_constants_are_folded_and_rows_are_checked(module):
    found = module("""
def radius(body: Table[Disc], part: int) -> float:
    \"\"\"Radius.\"\"\"
    best = math.inf
    for k in range(len(body)):
        best = min(best, HALF * body[part].r)
    return best
""")
    assert body_of(found, "radius") == [
        "double best;",
        "int64_t k;",
        "best = (INFINITY);",
        "for (int64_t each_ = 0, last_ = body.count; each_ < last_; each_ += 1) {",
        "k = each_;",
        "best = min_double(best, ((0.5) * (&ROW(body, part))->r));",
        "}",
        "return best;",
    ]


def test_an_argument_hides_a_constant_of_its_name(module):
    found = module("""
def shadowed(HALF: float) -> float:
    return HALF
""")
    assert body_of(found, "shadowed") == ["return HALF;"]


def test_lines_are_those_of_the_python_source(module):
    found = module("""
def half(x: float) -> float:
    return HALF * x
""")
    number = (HEAD + "\n\n").count("\n") + 1
    made = Module([found]).text("mark", [])
    assert re.search(rf'#line {number} "[^"]*{found.__name__}.py"\nreturn', made)


@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("y = True; y = (x, x); return x", "both"),
        ("y = [x]; return x", "no expression"),
        ("return math.exp(x)", "no expression"),
        ("return x.real", "a field of"),
        ("return elsewhere(x)", "no function of the kernel"),
        ("return x ** 2.0", "no operation"),
        ("return x % 2.0", "no operation"),
        ("return x // 2.0", "no operation"),
        ("return 1.5 if x else x", "where a number is expected"),
        ("k = 0; k += x; return k", "a whole number is expected"),
        ("row = empty(int, 1); row[0] = x; return x", "a whole number is expected"),
        ("row = empty(int, 1); return row[x]", "a whole number is expected"),
        ("one = empty(Disc, 1); two = empty(Disc, 1); one[0] = two[0]; return x", "by put"),
        ("return 0.0 < x < 1.0", "no expression"),
        ("with x: return x", "no statement"),
        ("for k in (1, 2): return x\n    return x", "no statement"),
        ("return undefined", "nothing is assigned"),
    ],
)
def test_what_is_not_known_is_refused(body, why, module):
    """With the file and the line."""
    found = module(f"\ndef asked(x: float) -> float:\n    {body.replace('; ', chr(10) + '    ')}\n")
    with pytest.raises(SyntaxError, match=rf"(?s){found.__name__}\.py:\d+: .*{why}"):
        Module([found]).text("mark", [])


def test_a_named_tuple_that_is_given_stays(module):
    found = module("""
def moved(place: Place) -> Place:
    place = Place(0.0, place.z)
    return place
""")
    with pytest.raises(SyntaxError, match="a named tuple given stays"):
        Module([found]).text("mark", [])


@pytest.mark.parametrize("annotation", ["str", "list[float]", "dict"])
def test_other_types_are_refused(annotation, module):
    found = module(f"\ndef asked(x: {annotation}) -> float:\n    return 0.0\n")
    with pytest.raises((SyntaxError, TypeError)):
        Module([found]).text("mark", [])


def test_two_functions_of_one_name_are_two_and_two_types_are_refused(module):
    one = module("\ndef half(x: float) -> float:\n    return HALF * x\n")
    other = module("\ndef half(x: float) -> float:\n    return x / 2.0\n")
    text = Module([one, other]).text("mark", [])
    for each in (one, other):
        assert f"static double {each.__name__}_half(double x);" in text
    wide = module("""
class Place(NamedTuple):
    x: float
    y: float

def of(place: Place) -> float:
    return place.x
""")
    narrow = module("\ndef of(place: Place) -> float:\n    return place.z\n")
    with pytest.raises(match="two types of the name Place"):
        Module([wide, narrow]).text("mark", [])


WHOLE = """
def divided(a: int, b: int) -> tuple[int, int]:
    return a // b, a % b

def divided_in_place(a: int, b: int) -> tuple[int, int]:
    q = a
    r = a
    q //= b
    r %= b
    return q, r

def cut(x: float) -> int:
    return int(x)

def chosen(a: float, b: float) -> tuple[float, float, float]:
    return min(a, b), max(a, b), abs(a)

def moved(place: Place, by: float) -> Place:
    k = 0
    k = by
    there = Place(place.x + k, place.z)
    return there

def summed(numbers: Row[float], first: int, last: int) -> float:
    total = 0.0
    part = numbers[first:last]
    for k in range(len(part)):
        total += part[k]
    return total

def grown(discs: Table[Disc], row: int) -> int:
    spare = empty(Disc, 2)
    put(spare[1], discs[row])
    spare[1].number += 1
    put(discs[row], spare[1])
    return discs[row].number

def backward(n: int) -> int:
    found = 0
    for k in range(n, -1, -2):
        found = 10 * found + k
    return found
"""


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """A kernel of these functions, as machine code and as Python."""
    folder = tmp_path_factory.mktemp("emitted")
    try:
        compiler()
    except NoCompilerError as error:
        pytest.skip(str(error))
    (folder / "tiny.py").write_text(HEAD + WHOLE)
    spec = importlib.util.spec_from_file_location("tiny", folder / "tiny.py")
    plain = importlib.util.module_from_spec(spec)
    sys.modules["tiny"] = plain
    spec.loader.exec_module(plain)
    functions = [each for name, each in vars(plain).items() if each.__class__ is type(compiler)
                 and each.__module__ == "tiny"]  # fmt: skip
    module = Module([plain])
    (folder / "tiny.c").write_text(module.text("mark", functions))
    library = folder / "_native.abi3.so"
    compile_library(folder / "tiny.c", library)
    loader = importlib.machinery.ExtensionFileLoader("_native", str(library))
    native = importlib.util.module_from_spec(importlib.util.spec_from_loader("_native", loader))
    from kaidan.contact.door import dtype_of

    native.use_dtypes(tuple(map(dtype_of, module.kinds)))
    yield native, plain
    del sys.modules["tiny"]


def same(compiled, name, *given):
    native, plain = (getattr(each, name)(*given) for each in compiled)
    assert repr(native) == repr(tuple(plain) if isinstance(plain, tuple) else plain)


def test_division_of_negative_numbers_is_pythons(compiled):
    for a in range(-7, 8):
        for b in (-3, -2, -1, 1, 2, 3):
            same(compiled, "divided", a, b)
            same(compiled, "divided_in_place", a, b)
    for name in ("divided", "divided_in_place"):
        with pytest.raises(ZeroDivisionError, match=r"tiny\.py:\d+: division by zero"):
            getattr(compiled[0], name)(1, 0)


def test_whole_parts_least_and_largest_are_pythons(compiled):
    for x in (2.7, -2.7, 0.0, -0.3, 1e15, -4.0):
        same(compiled, "cut", x)
    for x in (math.inf, math.nan, 1e300):
        with pytest.raises(ValueError, match="no whole number"):
            compiled[0].cut(x)
    for a in (1.0, -2.0, 0.0, -0.0, math.nan, math.inf):
        for b in (1.0, 3.0, -0.0, 0.0, math.nan):
            same(compiled, "chosen", a, b)


def test_loops_and_named_tuples_are_pythons(compiled):
    for n in (-3, 0, 1, 6, 7):
        same(compiled, "backward", n)
    same(compiled, "moved", compiled[1].Place(1.0, 2.0), 0.5)


def test_rows_and_slices_beyond_are_told_with_their_line(compiled):
    import numpy as np

    native, _ = compiled
    numbers = np.arange(5.0)
    assert native.summed(numbers, 1, 4) == 6.0
    for first, last in ((0, 6), (-1, 3), (4, 3), (2, -1), (0, 2**62)):
        with pytest.raises(IndexError, match=r"tiny\.py:\d+: row -?\d+ of a table of \d+"):
            native.summed(numbers, first, last)


def test_records_are_copied_whole(compiled):
    import numpy as np

    from kaidan.contact.door import dtype_of

    native, plain = compiled
    discs = np.array([(0.5, 7), (0.25, 8)], dtype=dtype_of(plain.Disc))
    assert native.grown(discs, 1) == 9
    assert discs.tolist() == [(0.5, 7), (0.25, 9)]
    with pytest.raises(IndexError, match="row 2 of a table of 2"):
        native.grown(discs, 2)


def test_no_entry_of_the_kernel_has_more_than_twelve_parameters():
    from kaidan.contact import switch

    entries = vars(switch._plain())
    counts = {name: each.__wrapped__.__code__.co_argcount for name, each in entries.items()}
    assert max(counts.values()) <= 12
