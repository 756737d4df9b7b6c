"""Which kernel answers, and what happens where the native one is not there."""

import json
import logging
import subprocess
import sys
from types import SimpleNamespace

import pytest

from kaidan import contact
from kaidan.contact import switch
from kaidan.errors import InputError

FLAT, ROBOT = [[0, 0], [4, 0]], [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]

needs_native = pytest.mark.skipif(bool(contact.without_native()), reason="built pure")


@pytest.fixture(autouse=True)
def untouched(monkeypatch):
    """No choice but the default's, nothing loaded yet."""
    monkeypatch.delenv(switch.VARIABLE, raising=False)
    monkeypatch.setattr(switch, "_chosen", None)
    caches = (switch._native, switch._stated, switch._warn_once)
    for each in caches:
        each.cache_clear()
    yield
    for each in caches:
        each.cache_clear()


def loads(monkeypatch, module):
    """Let the native module be this one, or the error that loading it raises."""

    def load(name):
        if isinstance(module, Exception):
            raise module
        return module

    monkeypatch.setattr(switch, "importlib", SimpleNamespace(import_module=load))


@needs_native
def test_native_unless_another_is_chosen():
    assert contact.kernel_in_use() == "native"
    with contact.using_kernel("plain"):
        assert contact.kernel_in_use() == "plain"
    assert contact.kernel_in_use() == "native"


@needs_native
def test_the_environment_chooses_and_the_function_wins(monkeypatch):
    monkeypatch.setenv("KAIDAN_KERNEL", "plain")
    assert contact.kernel_in_use() == "plain"
    contact.use_kernel("native")
    assert contact.kernel_in_use() == "native"
    contact.use_kernel(None)
    assert contact.kernel_in_use() == "plain"


def test_unknown_choices(monkeypatch):
    with pytest.raises(InputError) as error:
        contact.use_kernel("fast")
    assert str(error.value) == "kernel = 'fast' is not known; known: auto, plain, native"
    monkeypatch.setenv("KAIDAN_KERNEL", "numba")
    with pytest.raises(InputError) as error:
        contact.settle(FLAT, ROBOT, 2.0)
    assert str(error.value) == "KAIDAN_KERNEL = 'numba' is not known; known: auto, plain, native"


def test_nothing_else_is_imported():
    """An answer of the contact model loads neither numba nor what builds the native kernel."""
    code = (
        "import sys, json, kaidan\n"
        "kaidan.assess('kenaf', 'ibc', friction=1.0)\n"
        "print(json.dumps([name for name in ('numba', 'Cython', 'setuptools')"
        " if name in sys.modules]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120
    )
    assert json.loads(done.stdout) == []


def test_without_the_native_kernel_the_plain_one_answers_and_says_so_once(monkeypatch, caplog):
    switch._plain()
    loads(monkeypatch, ImportError("no such file"))
    with caplog.at_level(logging.WARNING, "kaidan.contact"):
        assert contact.settle(FLAT, ROBOT, 2.0).found
        assert contact.settle(FLAT, ROBOT, 2.0).found
    (record,) = caplog.records
    assert record.getMessage() == (
        "the native kernel is not installed (no such file); "
        "the plain kernel answers the same, about a hundred times slower"
    )
    with contact.using_kernel("native"), pytest.raises(InputError) as error:
        contact.settle(FLAT, ROBOT, 2.0)
    assert str(error.value) == (
        "KAIDAN_KERNEL = native: the native kernel is not installed (no such file)"
    )


def test_machine_code_of_another_source_is_not_used(monkeypatch):
    loads(monkeypatch, SimpleNamespace(SOURCE="of last week"))
    assert contact.kernel_in_use() == "plain"
    assert contact.without_native() == (
        "the native kernel was built from another source: install kaidan again"
    )
