"""The hull of discs: closed, and no disc reaches beyond it in any direction."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kaidan.readers.robots.hull import hull_of_discs, outer_discs

ROUND = st.integers(-10, 10).map(lambda tenths: tenths / 10)  # many ties and equal corners
DISCS = st.lists(
    st.tuples(ROUND, ROUND, st.sampled_from([0.0, 0.0, 0.1, 0.25, 0.6])), min_size=1, max_size=20
)
TOLERANCE = 1e-7
"""A thousand times the distance within which two discs count as equally far."""


@given(DISCS)
def test_each_edge_touches_two_discs_and_no_disc_reaches_beyond(discs):
    discs = np.array(discs)
    edges = hull_of_discs(discs)
    for edge in edges:
        normal = np.array([np.sin(edge.normal), -np.cos(edge.normal)])
        far = (discs[:, :2] @ normal + discs[:, 2]).max()
        assert edge.begin @ normal == pytest.approx(far, abs=TOLERANCE)
        assert edge.end @ normal == pytest.approx(far, abs=TOLERANCE)
    for one, two in pairwise([*edges, *edges[:1]]):
        assert one.second == two.first


@given(DISCS)
def test_between_two_edges_their_common_disc_supports_the_hull(discs):
    discs = np.array(discs)
    for one, two in pairwise(hull_of_discs(discs)):
        for share in (0.1, 0.5, 0.9):
            at = one.normal + share * (two.normal - one.normal)
            normal = np.array([np.sin(at), -np.cos(at)])
            far = discs[:, :2] @ normal + discs[:, 2]
            assert far[one.second] == pytest.approx(far.max(), abs=TOLERANCE)


@given(DISCS)
def test_without_inner_discs_the_hull_is_the_same(discs):
    discs = np.array(discs)
    whole, outer = hull_of_discs(discs), hull_of_discs(outer_discs(discs))
    expected = [(*edge.begin, *edge.end) for edge in whole]
    found = [(*edge.begin, *edge.end) for edge in outer]
    assert np.array(found) == pytest.approx(np.array(expected), abs=TOLERANCE)
