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


def test_grousers_are_carried_round_underside_and_ends():
    """By hand: start at -pi r before the rear tangent; a belt that runs takes them backward."""
    bars = np.zeros((3, 8))
    # below the middle, at the rear end's rearmost point, at the front's foremost
    quarter = 0.1 * np.pi / 2
    bars[:, 0] = 0.1 * np.pi + np.array([0.5, -quarter, 1.0 + quarter])
    rubber.carry_round(bars, PART, 0.0, 0.2, 10.0, 5.0, 1.0, 0.0)
    assert bars[:, 1:3] == pytest.approx(np.array([[0.5, -0.1], [-0.1, 0.0], [1.1, 0.0]]))
    # speed 0.2 m/s: backward below, up at the rear, down at the front; in space 5 m farther
    assert bars[:, 4:6] == pytest.approx(np.array([[-0.2, 0.0], [0.0, 0.2], [0.0, -0.2]]), abs=1e-9)
    assert bars[:, 7] == pytest.approx(bars[:, 1] + 5.0)
    rubber.carry_round(bars, PART, 0.1, 0.2, 10.0, 5.0, 1.0, 0.0)
    assert bars[0, 1:3] == pytest.approx([0.4, -0.1])


def test_a_tip_bears_a_nosing_until_it_has_passed_it():
    bars = np.zeros((1, 8))
    bars[0, 1:4] = 0.0, 0.0, 0.007
    nosing = np.array([[0.0, -0.005], [0.1, -0.005]])
    depth, n_x, n_z = rubber.tip_met(nosing, 0, 2.0, bars, 0, 0.0, 0.0, 1.0, 0.0)
    assert (depth, n_x, n_z) == pytest.approx((0.002, 0.0, 1.0))  # 7 mm high, 5 mm away
    assert rubber.tip_met(nosing, 1, 2.0, bars, 0, 0.0, 0.0, 1.0, 0.0)[0] == 0.0
