import numpy as np
import pytest

from kaidan.mechanics.plane import (
    contact_count,
    lowest_contact,
    two_contacts_remain,
)

UNIT = 2.0**-51  # spacing of the doubles between 2 and 4


def test_a_quotient_just_below_a_whole_number_counts_as_it():
    # hand: four units of rounding of 3, 3 * 4 * 2**-52, are six doubles
    assert contact_count(L=3.0, p=1.0) == 3.0
    assert contact_count(L=3.0 - 6 * UNIT, p=1.0) == 3.0
    assert contact_count(L=3.0 - 7 * UNIT, p=1.0) == 2.0
    assert 0.3 / 0.1 < 3.0  # the case that made it necessary
    assert contact_count(L=0.3, p=0.1) == 3.0


def test_contacts_where_the_spacing_divides_the_length():
    # hand: 0.5 = 2 * 0.25: the lowest contact leaves as the next nosing is met
    assert lowest_contact(d=0.0, L=0.5, p=0.25) == 0.25
    assert lowest_contact(d=0.125, L=0.5, p=0.25) == 0.375


@pytest.mark.parametrize("p", [0.06, 0.11, 0.15, 0.2])
def test_lowest_contact_by_counting(p):
    # oracle: the last of the nosings that are still short of the rear tip
    L = 0.47
    for d in np.linspace(0.0, p, 37, endpoint=False) + 1e-6:
        behind = d + p * np.arange(20)
        assert lowest_contact(d=d, L=L, p=p) == pytest.approx(behind[behind < L][-1], abs=1e-12)


def test_two_contacts_remain_up_to_rounding():
    # limit: p = L/2, and the four units of rounding beyond it that contact_count allows
    assert two_contacts_remain(L=2.0, p=1.0)
    assert two_contacts_remain(L=2.0, p=1.0 + 4 * 2.0**-52)
    assert not two_contacts_remain(L=2.0, p=1.0 + 5 * 2.0**-52)
