"""Rows of figures in their order, against Python's own sorting."""

import numpy as np
import pytest

from kaidan.contact.kernel.heaps import heap_of, taken


@pytest.mark.parametrize("seed", range(12))
def test_a_heap_gives_the_smallest_first(seed):
    """Of those alike the first; those that are taken stay behind the others, the first last."""
    rng = np.random.default_rng(seed)
    size = int(rng.integers(1, 40))
    figures = rng.integers(0, 9, size).astype(float)
    order = np.r_[np.arange(size), -7]
    heap_of(order, figures, size)
    expected = sorted(range(size), key=lambda k: (figures[k], k))
    for count in range(size):
        assert taken(order, figures, size - count) == expected[count]
        assert order[size - count - 1 :].tolist() == [*expected[count::-1], -7]


def test_nothing_to_take():
    order, figures = np.array([4]), np.array([0.5])
    heap_of(order, figures, 0)
    assert order.tolist() == [4]
