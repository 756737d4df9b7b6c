"""The inner loop of a yielding track as numba compiles it."""

import numpy as np
import pytest

pytest.importorskip("numba", reason="skipped: numba not installed")

import numba

from kaidan.physics import planar, rubber


def test_without_a_folder_that_may_be_written_to_it_is_compiled_in_memory(monkeypatch):
    njit = numba.njit

    def nowhere(*args, cache=False, **options):
        if cache:  # what numba says where no locator has a folder
            raise RuntimeError("cannot cache function 'advance': no locator available for file")
        return njit(*args, **options)

    monkeypatch.setattr(numba, "njit", nowhere)
    module = planar.kernel.__wrapped__()
    # two discs of 0.1 m, a metre apart on one level: 0.05 m above their lower tangent
    part = np.array([0.0, 0.0, 0.1, 1.0, 0.0, 0.1, 0.0, -0.1, 1.0, 0.0, 1.0, 1.0])
    inside = module.depth_below(part, 0.5, -0.05, 0.2)
    assert inside == pytest.approx((0.05, 0.0, -1.0))
    assert inside == rubber.depth_below(part, 0.5, -0.05, 0.2)


def test_numba_is_named_where_it_is_missing(monkeypatch):
    monkeypatch.setattr(planar.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(ImportError, match="pip install 'kaidan"):
        planar.kernel.__wrapped__()
