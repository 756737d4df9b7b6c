"""The inner loop of a yielding track as numba compiles it."""

import numpy as np
import pytest

pytest.importorskip("numba", reason="skipped: numba not installed")

import numba

from kaidan.physics import planar, rubber

PART = np.array([0.0, 0.0, 0.1, 1.0, 0.0, 0.1, 0.0, -0.1, 1.0, 0.0, 1.0, 1.0])
"""Two discs of 0.1 m, a metre apart on one level: 0.05 m above their lower tangent."""
POINT = (0.5, -0.05, 0.2)


def compiled():
    return planar.compiled(rubber.depth_below, planar.SIGNATURES["depth_below"])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where numba keeps what it compiles; nothing else writes there."""
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    return tmp_path


def test_without_a_folder_that_may_be_written_to_it_is_compiled_in_memory(monkeypatch):
    njit = numba.njit

    def nowhere(*args, cache=False, **options):
        if cache:  # what numba says where no locator has a folder
            raise RuntimeError("cannot cache function 'advance': no locator available for file")
        return njit(*args, **options)

    monkeypatch.setattr(numba, "njit", nowhere)
    inside = compiled()(PART, *POINT)
    assert inside == pytest.approx((0.05, 0.0, -1.0))
    assert inside == rubber.depth_below(PART, *POINT)


@pytest.mark.parametrize("suffix", [".nbi", ".nbc"])
def test_a_damaged_file_on_disk_is_left_alone(folder, suffix):
    compiled()
    (kept,) = folder.rglob(f"*{suffix}")
    kept.write_bytes(kept.read_bytes()[:40])
    assert compiled()(PART, *POINT) == pytest.approx((0.05, 0.0, -1.0))


def test_a_full_disk_keeps_nothing(folder, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("numba.core.caching.os.replace", full)
    assert compiled()(PART, *POINT) == pytest.approx((0.05, 0.0, -1.0))
    assert not list(folder.rglob("*.nb?"))


def test_numba_is_named_where_it_is_missing(monkeypatch):
    monkeypatch.setattr(planar.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(ImportError, match="pip install 'kaidan"):
        planar.kernel.__wrapped__()
