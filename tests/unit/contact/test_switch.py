"""Which kernel answers, and what happens where the compiler cannot do its work."""

import json
import logging
import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from kaidan import contact
from kaidan.contact import compiler_cache, compiling, switch
from kaidan.errors import InputError, MissingExtraError

FLAT, ROBOT = [[0, 0], [4, 0]], [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]
needs_numba = pytest.mark.skipif(not contact.numba_is_installed(), reason="needs numba")


@pytest.fixture(autouse=True)
def untouched(monkeypatch):
    """No choice but the default's."""
    monkeypatch.delenv(switch.VARIABLE, raising=False)
    monkeypatch.setattr(switch, "_chosen", None)
    monkeypatch.setattr(switch, "_broken", False)


def test_plain_unless_the_work_is_long():
    assert contact.kernel_in_use() == "plain"
    with contact.expected_work(switch.PATIENCE + 1):
        long = "compiled" if contact.numba_is_installed() else "plain"
        assert contact.kernel_in_use() == long
        with contact.expected_work(0.0):  # a small part of long work is long work
            assert contact.kernel_in_use() == long
    assert contact.kernel_in_use() == "plain"


def test_a_choice_holds_whatever_the_work():
    with contact.using_kernel("plain"):
        assert contact.kernel_in_use(1e6) == "plain"
    with contact.using_kernel("compiled"):
        assert contact.kernel_in_use() == "compiled"
    assert contact.kernel_in_use() == "plain"


def test_the_environment_chooses_and_the_function_wins(monkeypatch):
    monkeypatch.setenv("KAIDAN_KERNEL", "compiled")
    assert contact.kernel_in_use() == "compiled"
    contact.use_kernel("plain")
    assert contact.kernel_in_use() == "plain"
    contact.use_kernel(None)
    assert contact.kernel_in_use() == "compiled"


def test_unknown_choices(monkeypatch):
    with pytest.raises(InputError) as error:
        contact.use_kernel("fast")
    assert str(error.value) == "kernel = 'fast' is not known; known: auto, plain, compiled"
    monkeypatch.setenv("KAIDAN_KERNEL", "numba")
    with pytest.raises(InputError) as error:
        contact.settle(FLAT, ROBOT, 2.0)
    assert str(error.value) == "KAIDAN_KERNEL = 'numba' is not known; known: auto, plain, compiled"


@needs_numba
def test_what_else_is_imported_changes_nothing():
    """A sweep loads numba; the next question is answered by the same kernel as before."""
    code = (
        "import sys, json, kaidan\n"
        "from kaidan import contact\n"
        "kaidan.sweep('kenaf', 'ibc', friction=[0.5, 1.0], engine='compiled')\n"
        "loaded = 'numba' in sys.modules\n"
        "kaidan.assess('kenaf', 'ibc', friction=1.0)\n"
        "print(json.dumps([loaded, contact.kernel_in_use(),\n"
        "                  [name for name in sys.modules if '_compiled_' in name]]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120
    )
    assert json.loads(done.stdout) == [True, "plain", []]


def test_without_numba(monkeypatch):
    monkeypatch.setattr(switch, "numba_is_installed", lambda: False)
    with contact.expected_work(1e6):
        assert contact.settle(FLAT, ROBOT, 2.0).found
    monkeypatch.setattr(compiling, "_compiled", {})
    with contact.using_kernel("compiled"), pytest.raises(MissingExtraError) as error:
        contact.settle(FLAT, ROBOT, 2.0)
    assert str(error.value) == (
        "the compiled contact kernel needs an optional package: pip install 'kaidan[fast]'"
    )


def test_a_broken_compiler_leaves_the_plain_kernel(monkeypatch, caplog):
    def fails():
        raise RuntimeError("no such instruction")

    monkeypatch.setattr(compiling, "_compiled", {})
    monkeypatch.setattr(compiling, "_compiled_modules", fails)
    monkeypatch.setattr(switch, "numba_is_installed", lambda: True)
    with contact.expected_work(1e6), caplog.at_level(logging.WARNING, "kaidan.contact"):
        assert contact.settle(FLAT, ROBOT, 2.0).found
        assert contact.settle(FLAT, ROBOT, 2.0).found
    (record,) = caplog.records
    assert record.getMessage() == (
        "the plain contact kernel answers, numba does not work here: no such instruction"
    )
    with contact.using_kernel("compiled"), pytest.raises(RuntimeError):
        contact.settle(FLAT, ROBOT, 2.0)


@needs_numba
def test_without_a_writable_cache(monkeypatch, caplog):
    """Where numba finds no folder to write to the kernel is compiled for the process alone."""
    from numba.core import caching

    def refuses(self):
        raise PermissionError(13, "Permission denied")

    tried = []
    monkeypatch.setattr(caching._CacheLocator, "ensure_cache_path", refuses)
    monkeypatch.setattr(compiling, "_compiled", {})
    monkeypatch.setattr(
        compiling, "_compile_all", lambda njit, cache: tried.append(cache) or {"settling": None}
    )
    with caplog.at_level(logging.WARNING, "kaidan.contact"):
        compiling.compiled("settling")
    assert tried == [False]
    (record,) = caplog.records
    assert record.getMessage() == (
        "compiling the contact kernel for this process alone: set NUMBA_CACHE_DIR"
    )


@needs_numba
def test_a_cache_that_fails_on_the_way(monkeypatch, caplog, tmp_path):
    """A full disk, for example."""

    def compile_all(njit, cache):
        if cache:
            raise OSError(28, "No space left on device")
        return {"settling": SimpleNamespace()}

    monkeypatch.setattr(compiling, "_compiled", {})
    monkeypatch.setattr(compiling, "_compile_all", compile_all)
    monkeypatch.setattr(compiling, "cache_folder", lambda njit, function: tmp_path)
    with caplog.at_level(logging.WARNING, "kaidan.contact"):
        assert compiling.compiled("settling") is not None
    assert "No space left on device" in caplog.records[0].getMessage()


def test_a_process_that_hangs_is_not_waited_for(monkeypatch, tmp_path):
    fcntl = pytest.importorskip("fcntl")
    monkeypatch.setattr(compiler_cache, "LONGEST_WAIT", 0.3)
    with (tmp_path / "kaidan-contact.lock").open("a") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        with compiler_cache.filling(tmp_path):
            pass


@needs_numba
@pytest.mark.slow
def test_several_processes_fill_one_cache(tmp_path):
    """Four at once on an empty cache: all answer, the same, and one of them compiles."""
    code = f"from kaidan.contact import settle\nprint(repr(settle({FLAT}, {ROBOT}, 2.0, 0.3)))"
    env = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path), "KAIDAN_KERNEL": "compiled"}
    started = [
        subprocess.Popen(
            [sys.executable, "-c", code], env=env, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )
        for _ in range(4)
    ]  # fmt: skip
    ended = [each.communicate(timeout=400) for each in started]
    assert [each.returncode for each in started] == [0, 0, 0, 0], ended
    assert len({out for out, _ in ended}) == 1
    assert sum("compiling the contact kernel" in errors for _, errors in ended) == 1
