import numpy as np
import pytest
import xarray as xr

from kaidan.mechanics.loads import (
    load_shares,
    zero_moment_point,
)

ROUNDING = 1e-12  # sums of a handful of numbers of order one


def random_poses(count=400):
    rng = np.random.default_rng(20160913)
    for _ in range(count):
        m = rng.integers(2, 9)
        x = np.sort(rng.uniform(0.0, 1.0, m))
        yield rng.permutation(x), rng.uniform(x[0], x[-1]), rng


def test_zero_moment_point():
    # hand: tan 45 = 1, and 5 / (10 cos 45) = 1 / sqrt(2)
    x_z = zero_moment_point(C_L=0.2, C_N=0.1, theta_s=np.pi / 4, a=5.0, g=10.0)
    assert x_z == pytest.approx(0.3 + 0.1 / np.sqrt(2.0), abs=ROUNDING)


def test_zero_moment_point_is_where_the_moment_vanishes():
    # oracle: moment of weight and inertia about the point, in world coordinates
    theta, a, g, C_L, C_N = 0.6, -1.7, 9.8, 0.2, 0.07
    x_z = zero_moment_point(C_L=C_L, C_N=C_N, theta_s=theta, a=a, g=g)
    up_the_stairs = np.array([np.cos(theta), np.sin(theta)])
    normal = np.array([-np.sin(theta), np.cos(theta)])
    arm = (x_z - C_L) * up_the_stairs + C_N * normal  # from the point to the centroid
    force = np.array([0.0, -g]) - a * up_the_stairs
    assert arm[0] * force[1] - arm[1] * force[0] == pytest.approx(0.0, abs=1e-14)


def test_standard_gravity_is_the_default():
    # hand: one g of acceleration on the level shifts the point by C_N
    assert zero_moment_point(C_L=0.0, C_N=0.1, theta_s=0.0, a=9.80665) == pytest.approx(
        0.1, abs=ROUNDING
    )


def test_two_contacts_are_a_lever():
    # hand: statically determinate, the nearer end takes more
    np.testing.assert_allclose(
        load_shares(x=np.array([0.1, 0.5]), x_z=0.4), [0.25, 0.75], rtol=0, atol=ROUNDING
    )


def test_three_contacts_share_as_equal_springs():
    # hand: mean 0.3, squares 0.08, lever 0.05: 1/3 -+ 0.05 * 0.2 / 0.08
    np.testing.assert_allclose(
        load_shares(x=np.array([0.1, 0.3, 0.5]), x_z=0.35),
        [1 / 3 - 0.125, 1 / 3, 1 / 3 + 0.125],
        rtol=0,
        atol=ROUNDING,
    )


def test_contact_that_would_pull_is_let_go():
    # hand: with x_z = 0.45 the first would carry 1/3 - 0.15 * 0.2 / 0.08 < 0; a lever remains
    np.testing.assert_allclose(
        load_shares(x=np.array([0.1, 0.3, 0.5]), x_z=0.45), [0.0, 0.25, 0.75], rtol=0, atol=ROUNDING
    )


def test_contacts_are_let_go_repeatedly():
    # hand: x_z between the last two of five: nothing but that pair can press
    x = np.array([0.0, 0.1, 0.2, 0.3, 0.4])
    np.testing.assert_allclose(
        load_shares(x=x, x_z=0.39), [0, 0, 0, 0.1, 0.9], rtol=0, atol=ROUNDING
    )


def test_shares_solve_the_contact_problem():
    # oracle: the conditions that define the unique solution, checked one by one
    for x, x_z, _ in random_poses():
        share = load_shares(x=x, x_z=x_z)
        assert np.all(share >= 0.0)
        assert np.sum(share) == pytest.approx(1.0, abs=ROUNDING)
        assert np.sum(share * x) == pytest.approx(x_z, abs=ROUNDING)
        pressed = share > 0.0
        assert pressed.sum() >= 2
        line = np.polyfit(x[pressed], share[pressed], 1)
        # polyfit on random spacings: condition numbers up to 1e5
        np.testing.assert_allclose(np.polyval(line, x)[pressed], share[pressed], rtol=0, atol=1e-9)
        assert np.all(np.polyval(line, x)[~pressed] <= 1e-9)  # free contacts are not pressed into


def test_resultant_over_an_end_contact_loads_it_alone():
    # limit
    x = np.array([0.0, 0.2, 0.4])
    np.testing.assert_allclose(load_shares(x=x, x_z=0.4), [0, 0, 1], rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(load_shares(x=x, x_z=0.0), [1, 0, 0], rtol=0, atol=ROUNDING)


def test_no_share_is_negative_by_rounding():
    # limit: thirds leave a rest of the order of 1e-17
    x = np.array([0.0, 0.1, 0.2, 0.3]) / 3.0
    for x_z in x:
        assert np.all(load_shares(x=x, x_z=x_z) >= 0.0)


@pytest.mark.parametrize("x_z", [-0.01, 0.41])
def test_nothing_holds_beyond_the_ends(x_z):
    assert np.isnan(load_shares(x=np.array([0.0, 0.2, 0.4]), x_z=x_z)).all()


def test_single_contact_holds_only_straight_under_the_resultant():
    # hand
    np.testing.assert_array_equal(load_shares(x=np.array([0.3]), x_z=0.3), [1.0])
    assert np.isnan(load_shares(x=np.array([0.3]), x_z=0.31)).all()


def test_absent_contacts_are_nan_and_carry_nothing():
    # hand
    x = np.array([[np.nan, 0.1, 0.5], [0.1, 0.3, 0.5]])
    np.testing.assert_allclose(
        load_shares(x=x, x_z=np.array([0.4, 0.3])),
        [[0.0, 0.25, 0.75], [1 / 3, 1 / 3, 1 / 3]],
        rtol=0,
        atol=ROUNDING,
    )
    assert np.isnan(load_shares(x=np.array([np.nan, np.nan]), x_z=0.1)).all()


def test_every_pose_has_its_own_ends():
    # hand: each point lies between the contacts of the other pose, beyond its own
    x = np.array([[0.0, 0.1, np.nan], [0.2, 0.3, 0.4]])
    shares = load_shares(x=x, x_z=np.array([0.15, 0.15]))
    assert np.isnan(shares).all()
    assert np.isnan(load_shares(x=x, x_z=np.array([0.25, 0.05]))).all()


def test_unknown_resultant_gives_unknown_shares():
    assert np.isnan(load_shares(x=np.array([0.1, 0.5]), x_z=np.nan)).all()


def test_shares_broadcast_over_poses():
    x = np.array([0.0, 0.2, 0.4])
    x_z = np.array([[0.1, 0.2], [0.3, 0.35]])
    shares = load_shares(x=x, x_z=x_z)
    assert shares.shape == (2, 2, 3)
    np.testing.assert_array_equal(shares[1, 0], load_shares(x=x, x_z=0.3))


def test_labelled_positions_through_apply_ufunc():
    # the way the module's docstring promises
    x = xr.DataArray([0.1, 0.3, 0.5], dims="contact")
    x_z = xr.DataArray([0.3, 0.45], dims="slope", coords={"slope": [0.4, 0.7]})
    shares = xr.apply_ufunc(
        lambda x, x_z: load_shares(x=x, x_z=x_z),
        x,
        x_z,
        input_core_dims=[["contact"], []],
        output_core_dims=[["contact"]],
    )
    assert shares.dims == ("slope", "contact")
    assert float(shares.sel(slope=0.7)[2]) == pytest.approx(0.75, abs=ROUNDING)
