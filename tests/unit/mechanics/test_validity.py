import numpy as np
import pytest
import xarray as xr

from kaidan.mechanics.validity import validity


def test_one_where_it_holds_and_nan_elsewhere():
    # hand
    np.testing.assert_array_equal(validity(holds=np.array([True, False])), [1.0, np.nan])
    assert validity(holds=True) == 1.0
    assert np.isnan(validity(holds=np.bool_(False)))


def test_infinity_becomes_nan_too():
    # hand: a factor of zero would not do that everywhere, a power does
    assert np.isnan(np.inf * validity(holds=False))
    assert np.inf * validity(holds=True) == np.inf


def test_keeps_labels():
    holds = xr.DataArray([True, False], dims="p", coords={"p": [0.1, 0.2]})
    result = validity(holds=holds)
    assert isinstance(result, xr.DataArray)
    assert float(result.sel(p=0.1)) == pytest.approx(1.0, abs=0.0)
