"""The kernel's source with types, that Cython compiles: what is folded, and what is refused."""

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "native"))

from typed_source import _compiled, _functions, typed_source

ODD = '''
import math
from kaidan.contact.columns import BODY_COLUMNS, R1
from kaidan.contact.tables import BodyTable, FloatRow

HALF = 0.5

def radius(body: BodyTable, part: int) -> float:
    """Radius."""
    best = math.inf
    for k in range(body.shape[0]):
        best = min(best, HALF * body[part, R1])
    return best

def shadowed(HALF: float) -> float:
    return HALF

def two_types(x: float) -> float:
    y = True
    y = (x, x)
    return x

def a_list(x: float) -> float:
    y = [x]
    return x

def a_power(x: float) -> float:
    return math.exp(x)

def a_method(row: FloatRow) -> float:
    return row.sum()

def an_unknown(x: float) -> float:
    y = elsewhere(x)
    return y

def a_text(x: str) -> float:
    return 0.0
'''


@pytest.fixture(scope="module")
def odd(tmp_path_factory):
    folder = tmp_path_factory.mktemp("odd")
    (folder / "odd_kernel.py").write_text(ODD)
    sys.path.insert(0, str(folder))
    yield importlib.import_module("odd_kernel")
    sys.path.remove(str(folder))


def test_constants_and_columns_are_folded(odd):
    assert _compiled(odd.radius, {}).splitlines() == [
        "cdef double c_radius(Table body, long long part) noexcept nogil:",
        "    cdef double best",
        "    cdef long long k",
        "    best = INFINITY",
        "    for k in range(body.rows):",
        "        best = min(best, 0.5 * body.at[checked(part * 14 + 2, body.rows * 14)])",
        "    return best",
    ]


def test_an_argument_hides_a_constant_of_its_name(odd):
    assert _compiled(odd.shadowed, {}).splitlines()[-1] == "    return HALF"


@pytest.mark.parametrize(
    "name", ["two_types", "a_list", "a_power", "a_method", "an_unknown", "a_text"]
)
def test_what_is_not_known_is_refused(odd, name):
    with pytest.raises((NotImplementedError, AssertionError, KeyError)):
        _compiled(getattr(odd, name), {})


def test_two_functions_of_one_name_are_refused(odd):
    def radius():
        """Another one."""

    radius.__module__ = "another"
    another = ModuleType("another")
    another.radius = radius
    assert list(_functions([odd]))[:2] == ["radius", "shadowed"]
    with pytest.raises(ValueError, match=r"^radius: in odd_kernel and another$"):
        _functions([odd, another])


def test_no_column_of_the_kernel_is_left_to_a_look_up():
    text = typed_source()
    assert "math." not in text
    assert "POSE_" not in text
    assert text.count("\ncdef ") > 60
