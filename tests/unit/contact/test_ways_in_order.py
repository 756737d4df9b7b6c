"""Ways between poses in their order, against Python's own sorting."""

import numpy as np
import pytest

from kaidan.contact.door import zeros
from kaidan.contact.kernel import way_order
from kaidan.contact.kernel.way_order import rounded
from kaidan.contact.layout import Way
from kernel_memory import called

is_before, order_of, put_in_order = (
    called(each) for each in (way_order.is_before, way_order.order_of, way_order.put_in_order)
)


def ways_of(*rows):
    table = zeros(Way, len(rows))
    table["group"], table["promise"], table["begin"], table["end"] = np.array(rows).T
    return table


LATER = [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)]


@pytest.mark.parametrize("column", range(4))
def test_group_comes_before_promise_and_promise_before_the_ends(column):
    """What follows a column that differs counts for nothing, either way round."""
    least = [0.0] * 4
    more = list(LATER[column])
    for rest in (-5.0, 5.0):
        more[column + 1 :] = [rest] * (3 - column)
        ways = ways_of(least, more)
        assert order_of(ways[0], ways[1]) == -1
        assert order_of(ways[1], ways[0]) == 1
        assert is_before(ways, 0, 1, False)
        assert not is_before(ways, 1, 0, False)
    assert order_of(ways[1], ways[1]) == 0


def test_ways_alike_to_the_ninth_digit_come_as_they_stand():
    ways = ways_of((0, 2.0, 1.0, 3.0), (0, 2.0 + 1e-10, 1.0 - 1e-10, 3.0 + 1e-10))
    assert order_of(ways[0], ways[1]) == order_of(ways[1], ways[0]) == 0
    assert is_before(ways, 0, 1, False)
    assert not is_before(ways, 1, 0, False)
    assert not is_before(ways, 0, 0, False)
    # by what they promise the larger comes first, to the last digit
    assert is_before(ways, 1, 0, True)
    assert not is_before(ways, 0, 1, True)


def test_figures_count_in_billionths():
    assert rounded(1.0) == 1e9
    assert rounded(0.25e-9) == 0.0
    assert rounded(-0.75e-9) == -1.0
    assert rounded(3e7) == 3e16  # whole as it is
    assert rounded(float("inf")) == float("inf")


@pytest.mark.parametrize("count", [0, 1, 2, 3, 4, 5, 8, 15, 40])
@pytest.mark.parametrize("by_promise", [False, True])
def test_any_number_of_ways_in_order(count, by_promise):
    rng = np.random.default_rng(count)
    ways = ways_of(*rng.integers(0, 3, (count, 4))) if count else zeros(Way, 0)
    order = np.full(count + 2, -7)
    order[:count] = rng.permutation(count)
    put_in_order(ways, order, count, by_promise)

    def key(k):
        promise = ways["promise"][k]
        rest = [ways[column][k] for column in ("group", "promise", "begin")]
        return (-promise if by_promise else 0.0, *rest, ways["end"][k], k)

    assert order[:count].tolist() == sorted(range(count), key=key)
    assert order[count:].tolist() == [-7, -7]
