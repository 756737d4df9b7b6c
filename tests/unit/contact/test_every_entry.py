"""Every entry of the kernel: what it is not meant for raises, in machine code as in plain Python.

Never is memory read that is not its own: rows, numbers and slices beyond a table are an IndexError
that names the line of the kernel's source.
"""

import copy

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import switch
from kernel_calls import changed, leaves, recorded

pytestmark = pytest.mark.skipif(bool(contact.without_native()), reason="built pure")

ENTRIES = sorted(vars(switch._plain()))
#: Numbers that are no row of anything, or of something else.
NO_ROWS = (-1, -(2**40), 3, 10**6, 2**40)
#: What differs by nothing but how much memory there is, or by what arithmetic knows no answer to.
NO_ANSWER = (MemoryError, OverflowError, ZeroDivisionError, ValueError)


@pytest.fixture(scope="module")
def calls():
    with pytest.MonkeyPatch.context() as patch:
        found = recorded(patch)
    assert sorted(found) == ENTRIES
    return found


@pytest.fixture(scope="module")
def kernels():
    return switch._native()[0], switch._plain()


def answer(kernel, name, given):
    """What it answers, and what it has written; or the error."""
    given = copy.deepcopy(given)
    try:
        told = getattr(kernel, name)(*given)
    except Exception as error:
        return error
    answers = [str(each) for _, each in leaves((told,))]
    return f"{answers} {[each.tolist() for _, each in arrays(given)]}"


def same(kernels, name, given):
    """Both kernels raise alike, or answer the same to the last digit; what the native one says."""
    native, plain = (answer(kernel, name, given) for kernel in kernels)
    if isinstance(native, NO_ANSWER) or isinstance(plain, NO_ANSWER):
        return native
    if isinstance(native, str):
        assert native == plain
        return native
    assert type(native) is type(plain)
    if isinstance(native, IndexError):
        file, line, text = str(native).split(":")
        assert file.startswith("kaidan/contact/kernel/")
        assert file.endswith(".py")
        assert int(line) > 0
        assert " of a table of " in text
    return native


def arrays(given):
    return [(path, each) for path, each in leaves(given) if isinstance(each, np.ndarray)]


@pytest.mark.parametrize("name", ENTRIES)
def test_both_kernels_answer_alike(name, calls, kernels):
    for given in calls[name]:
        assert isinstance(same(kernels, name, given), str)


@pytest.mark.parametrize("name", ENTRIES)
def test_no_array_of_another_type_or_shape(name, calls, kernels):
    given = calls[name][0]
    for path, each in arrays(given):
        other = np.zeros(len(each) + 1, dtype=np.float32)
        spread = np.zeros(2 * len(each) + 4, dtype=each.dtype)[::2]
        locked = each.copy()
        locked.flags.writeable = False
        for wrong in (other, spread, locked, each[None], each.tolist(), None, 5):
            for kernel in kernels:
                with pytest.raises(TypeError):
                    getattr(kernel, name)(*changed(given, path, wrong))


@pytest.mark.parametrize("name", ENTRIES)
def test_no_call_with_other_arguments(name, calls, kernels):
    given = calls[name][0]
    for wrong in ((), given[:-1], (*given, 1.0)):
        assert isinstance(same(kernels, name, wrong), TypeError)
    for k, each in enumerate(given):
        if isinstance(each, tuple):
            short = (*given[:k], each[:-1], *given[k + 1 :])
            long = (*given[:k], (*each, 0.0, 0.0), *given[k + 1 :])
            for wrong in (short, long, changed(given, (k,), 1.0)):
                native = answer(kernels[0], name, wrong)
                assert isinstance(native, TypeError), wrong


@pytest.mark.parametrize("name", ENTRIES)
def test_tables_that_are_too_short_are_not_read_beyond(name, calls, kernels):
    """Of each one row less, half of it, none: either is answered, or an IndexError is raised.

    `row_before` looks at no row but those that there are, and of a disc it is known that no flat
    lies on it.
    """
    raised = 0
    for given in calls[name][:2]:
        for path, each in arrays(given):
            for rows in {len(each) - 1, len(each) // 2, 0} - {-1, len(each)}:
                found = same(kernels, name, changed(given, path, each[:rows].copy()))
                raised += isinstance(found, IndexError)
    assert raised or name in ("row_before", "on_flat") or not arrays(calls[name][0])


@pytest.mark.parametrize("name", ENTRIES)
def test_numbers_that_are_no_rows(name, calls, kernels):
    for given in calls[name][:2]:
        for path, each in leaves(given):
            if isinstance(each, int | np.integer) and not isinstance(each, bool | np.bool_):
                for wrong in NO_ROWS:
                    same(kernels, name, changed(given, path, wrong))


@pytest.mark.parametrize("name", ENTRIES)
def test_rows_within_tables_that_lead_nowhere(name, calls, kernels):
    """Features, points, parts, rows before: each number of a table that names something else."""
    rng = np.random.default_rng(len(name))
    given = calls[name][0]
    for path, each in arrays(given):
        for wrong in wrong_within(each, rng):
            same(kernels, name, changed(given, path, wrong))


def wrong_within(table, rng):
    """The table with one whole number in it, wherever it may be, changed to what is no row."""
    if not len(table):
        return
    for field in whole_numbers(table.dtype):
        for value in (-1, 3, 2**40):
            wrong = table.copy()
            place = wrong
            for key in field:
                place = place[key]
            place[rng.integers(len(table))] = value
            yield wrong


def whole_numbers(dtype, path=()):
    if dtype.kind == "i":
        yield path
    for name in dtype.names or ():
        yield from whole_numbers(dtype[name], (*path, name))
