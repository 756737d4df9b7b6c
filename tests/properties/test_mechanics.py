"""Properties that every formula must have, whatever the numbers."""

import importlib
import inspect
import itertools

import hypothesis.strategies as st
import numpy as np
import pytest
import xarray as xr
from hypothesis import assume, given, settings

from kaidan.mechanics import (
    drive,
    loads,
    margin,
    measures,
    oblique,
    plane,
    slipping,
    tipping,
    transitions,
    triangle,
)
from kaidan.mechanics.margins import acceleration_bounds, margins

ROUNDING = {"rel": 1e-9, "abs": 1e-9}
"""Formulas of a dozen operations with quotients up to 1e3 (C_N down to 1/50 of L)."""


def always(*strategies):
    """Two hundred examples, the same in every run."""
    return lambda test: settings(max_examples=200, deadline=None)(given(*strategies)(test))


lengths = st.floats(0.3, 2.0)
fractions = st.floats(0.02, 0.98)
slopes = st.floats(-1.3, 1.3)
accelerations = st.floats(-5.0, 5.0)
frictions = st.floats(0.05, 3.0)
scales = st.floats(0.05, 20.0)


@st.composite
def robots(draw):
    """Flat length, centroid and a spacing that leaves two contacts."""
    L = draw(lengths)
    return {
        "L": L,
        "p": L / draw(st.floats(2.0, 12.0)),
        "C_L": L * draw(fractions),
        "C_N": L * draw(st.floats(0.02, 0.8)),
    }


def longer(robot, k):
    return {key: k * value for key, value in robot.items()}


def swapped(robot):
    return robot | {"C_L": robot["L"] - robot["C_L"]}


def without(robot, *keys):
    return {key: value for key, value in robot.items() if key not in keys}


# Scaling: angles and accelerations know no length


@always(robots(), slopes, accelerations, frictions, scales)
def test_limits_do_not_change_with_the_scale(robot, theta_s, a, mu_s, k):
    small = margins(**robot, theta_s=theta_s, a=a, mu_s=mu_s)
    large = margins(**longer(robot, k), theta_s=theta_s, a=a, mu_s=mu_s)
    assert np.asarray(large[:7]) == pytest.approx(np.asarray(small[:7]), **ROUNDING)
    small = acceleration_bounds(**robot, theta_s=theta_s, mu_s=mu_s)
    large = acceleration_bounds(**longer(robot, k), theta_s=theta_s, mu_s=mu_s)
    assert tuple(large) == pytest.approx(tuple(small), **ROUNDING)


@always(robots(), slopes, accelerations, scales)
def test_lengths_grow_with_the_scale(robot, theta_s, a, k):
    for formula, keys in (
        (margin.centroid_margin_downhill, ()),
        (margin.centroid_margin_uphill, ("L",)),
        (loads.zero_moment_point, ("L", "p")),
    ):
        pose = {"theta_s": theta_s, "a": a}
        small = formula(**without(robot, *keys), **pose)
        large = formula(**without(longer(robot, k), *keys), **pose)
        assert large == pytest.approx(k * small, **ROUNDING)


@always(robots(), st.floats(0.0, 0.5), scales)
def test_single_step_grows_with_the_scale(robot, roundness, k):
    shape = {"l_c": robot["L"] - robot["C_L"], "C_N": robot["C_N"], "R": roundness * robot["C_N"]}
    small = transitions.largest_step_height(**shape)
    assert transitions.largest_step_height(**longer(shape, k)) == pytest.approx(
        k * small, **ROUNDING
    )
    assert transitions.best_inclination(**longer(shape, k)) == pytest.approx(
        transitions.best_inclination(**shape), **ROUNDING
    )


@always(robots(), st.floats(0.0, 0.99), slopes, accelerations, frictions, st.floats(0.1, 10.0))
def test_accelerations_scale_with_gravity(robot, fraction, theta_s, a, mu_s, k):
    # on another planet, with every acceleration in proportion, slopes and lengths are the same
    d = fraction * robot["p"]
    s = plane.lowest_contact(d=d, L=robot["L"], p=robot["p"])
    centroid = without(robot, "L", "p")
    for formula, arguments in (
        (tipping.a_r0, {"s": s, "theta_s": theta_s, **centroid}),
        (tipping.a_rn, {"d": d, "theta_s": theta_s, **centroid}),
        (acceleration_bounds, {"theta_s": theta_s, "mu_s": mu_s, **robot}),
    ):
        here, there = formula(**arguments, g=1.0), formula(**arguments, g=k)
        assert np.asarray(there) == pytest.approx(k * np.asarray(here), **ROUNDING)
    for formula, arguments in (
        (slipping.required_friction, {"theta_s": theta_s}),
        (margin.theta_s_sup, robot),
        (margin.theta_s_inf, without(robot, "L")),
        (margins, {"theta_s": theta_s, "mu_s": mu_s, **robot}),
        (margin.centroid_margin_downhill, {"theta_s": theta_s, **robot}),
        (margin.centroid_margin_uphill, {"theta_s": theta_s, **without(robot, "L")}),
    ):
        here, there = (
            formula(**arguments, a=a / 10.0, g=1.0),
            formula(**arguments, a=k * a / 10.0, g=k),
        )
        assert np.asarray(there) == pytest.approx(np.asarray(here), **ROUNDING)


# Mirror: look at the stairs from behind: a -> -a, slope -> -slope, ends swapped


@always(robots(), fractions, slopes)
def test_tip_limits_mirror(robot, fraction, theta_s):
    s = fraction * robot["L"]
    pose, back = without(robot, "L", "p"), without(swapped(robot), "L", "p")
    assert tipping.a_r0(s=s, theta_s=theta_s, **pose) == pytest.approx(
        -tipping.a_rn(d=robot["L"] - s, theta_s=-theta_s, **back), **ROUNDING
    )
    # in angles: the triangle stands on its other foot
    assert triangle.theta_alpha(d=s, k=0, p=robot["p"], **pose) == pytest.approx(
        triangle.theta_beta(d=robot["L"] - s, **back), **ROUNDING
    )
    assert triangle.alpha(d=s, k=0, p=robot["p"], **pose) == pytest.approx(
        triangle.beta(d=robot["L"] - s, **back), **ROUNDING
    )


@always(robots(), slopes, accelerations, frictions)
def test_margins_mirror(robot, theta_s, a, mu_s):
    up = margins(**robot, theta_s=theta_s, a=a, mu_s=mu_s)
    down = margins(**swapped(robot), theta_s=-theta_s, a=-a, mu_s=mu_s)
    assert up.tip_downhill == pytest.approx(down.tip_uphill, **ROUNDING)
    assert up.slides_down == pytest.approx(down.slides_up, **ROUNDING)
    assert up.worst == pytest.approx(down.worst, **ROUNDING)


@always(robots(), slopes, frictions)
def test_bounds_mirror(robot, theta_s, mu_s):
    up = acceleration_bounds(**robot, theta_s=theta_s, mu_s=mu_s)
    down = acceleration_bounds(**swapped(robot), theta_s=-theta_s, mu_s=mu_s)
    assert up.a_max == pytest.approx(-down.a_min, **ROUNDING)
    assert up.tip_downhill == pytest.approx(-down.tip_uphill, **ROUNDING)


@always(robots(), fractions, fractions, slopes, accelerations)
def test_measures_mirror(robot, low, high, theta_s, a):
    L = robot["L"]
    x_n, x_0 = sorted((low * L, high * L))
    pose, back = without(robot, "L", "p"), without(swapped(robot), "L", "p")
    assert measures.static_margin_downhill(x_0=x_0, theta_s=theta_s, **pose) == pytest.approx(
        measures.static_margin_uphill(x_n=L - x_0, theta_s=-theta_s, **back), **ROUNDING
    )
    assert measures.force_angle_measure(
        x_0=x_0, x_n=x_n, theta_s=theta_s, a=a, M=20.0, **pose
    ) == pytest.approx(
        measures.force_angle_measure(
            x_0=L - x_n, x_n=L - x_0, theta_s=-theta_s, a=-a, M=20.0, **back
        ),
        **ROUNDING,
    )
    assert measures.energy_margin_backward(
        alpha=1.0, theta_alpha=low, theta_s=theta_s
    ) == pytest.approx(
        measures.energy_margin_forward(beta=1.0, theta_beta=low, theta_s=-theta_s), **ROUNDING
    )


@st.composite
def supports(draw):
    """Contacts a centimetre or more apart, and a point between the outermost."""
    gaps = draw(st.lists(st.floats(0.01, 0.5), min_size=1, max_size=8))
    x = np.concatenate([[0.0], np.cumsum(gaps)])
    return x, draw(fractions) * x[-1]


@always(supports())
def test_loads_mirror_and_balance(support):
    x, x_z = support
    share = loads.load_shares(x=x, x_z=x_z)
    assert np.all(share >= 0.0)
    assert np.sum(share) == pytest.approx(1.0, **ROUNDING)
    assert np.sum(share * x) == pytest.approx(x_z, **ROUNDING)
    mirrored = loads.load_shares(x=1.0 - x, x_z=1.0 - x_z)
    # a contact that just touches may be let go on one side only: its share is within rounding
    assert mirrored == pytest.approx(share, **ROUNDING)


@always(slopes, accelerations, frictions)
def test_slipping_mirrors(theta_s, a, mu_s):
    assert slipping.slip_acceleration_up(mu_s=mu_s, theta_s=theta_s) == pytest.approx(
        -slipping.slip_acceleration_down(mu_s=mu_s, theta_s=-theta_s), **ROUNDING
    )
    assert slipping.required_friction(theta_s=theta_s, a=a) == pytest.approx(
        slipping.required_friction(theta_s=-theta_s, a=-a), **ROUNDING
    )


@always(slopes, st.floats(-1.5, 1.5), accelerations)
def test_yaw_to_either_side_is_alike(theta_s, psi, a):
    pose = {"theta_s": theta_s, "a": a}
    assert oblique.equivalent_slope_along(**pose, psi=psi) == oblique.equivalent_slope_along(
        **pose, psi=-psi
    )
    assert oblique.oblique_friction(**pose, psi=psi) == oblique.oblique_friction(**pose, psi=-psi)
    for odd in (oblique.equivalent_slope_across,):
        assert odd(theta_s=theta_s, psi=psi) == -odd(theta_s=theta_s, psi=-psi)
    assert oblique.body_inclination(theta_s=theta_s, psi=psi) == oblique.body_inclination(
        theta_s=theta_s, psi=-psi
    )


# Monotonicity


@always(robots(), slopes, accelerations, frictions, st.floats(1e-3, 0.2))
def test_what_makes_tipping_downhill_worse(robot, theta_s, a, mu_s, more):
    pose = {"theta_s": theta_s, "a": a, "mu_s": mu_s}
    before = margins(**robot, **pose).tip_downhill
    nearer = robot | {"p": robot["p"] * (1.0 - more)}
    further_back = robot | {"C_L": robot["C_L"] + more}
    assert margins(**nearer, **pose).tip_downhill > before
    assert margins(**further_back, **pose).tip_downhill < before
    assert margins(**robot, **pose | {"a": a + more}).tip_downhill < before
    assert margins(**robot, **pose | {"theta_s": theta_s + more}).tip_downhill < before
    assert margins(**robot, **pose, theta_d=more).tip_downhill < before
    assert margins(**robot, **pose, theta_M=more).tip_downhill < before


@always(robots(), slopes, accelerations, frictions, st.floats(1e-3, 0.2))
def test_what_makes_tipping_uphill_worse(robot, theta_s, a, mu_s, more):
    pose = {"theta_s": theta_s, "a": a, "mu_s": mu_s}
    before = margins(**robot, **pose).tip_uphill
    nearer = robot | {"p": robot["p"] * (1.0 - more)}
    further_back = robot | {"C_L": robot["C_L"] + more}
    assert margins(**nearer, **pose).tip_uphill > before
    assert margins(**further_back, **pose).tip_uphill > before
    assert margins(**robot, **pose | {"a": a + more}).tip_uphill > before
    assert margins(**robot, **pose | {"theta_s": theta_s + more}).tip_uphill > before
    assert margins(**robot, **pose, theta_d=more).tip_uphill < before
    assert margins(**robot, **pose, theta_M=more).tip_uphill == before


@always(robots(), slopes, accelerations, frictions, st.floats(1e-3, 1.0))
def test_friction_only_helps(robot, theta_s, a, mu_s, more):
    pose = {"theta_s": theta_s, "a": a}
    rough = margins(**robot, **pose, mu_s=mu_s + more)
    smooth = margins(**robot, **pose, mu_s=mu_s)
    assert rough.slides_down > smooth.slides_down
    assert rough.slides_up > smooth.slides_up
    assert rough.worst >= smooth.worst


@always(st.floats(0.0, 1.2), st.floats(0.0, 0.3), st.floats(1e-3, 0.2))
def test_the_drive_must_give_more(theta_s, c_rr, more):
    pose = {"M": 20.0, "a": 0.0, "c_rr": c_rr}
    F = drive.drive_force(**pose, theta_s=theta_s)
    assert drive.drive_force(**pose | {"c_rr": c_rr + more}, theta_s=theta_s) > F
    assert drive.drive_force(**pose | {"a": more}, theta_s=theta_s) > F
    slope = drive.drive_slope(F=F, **pose)
    assume(theta_s < np.pi / 2 - np.arctan(c_rr) - 0.01)  # below the slope that asks for most
    assert slope == pytest.approx(theta_s, abs=1e-9)
    acceleration = drive.drive_acceleration(F=F, M=20.0, theta_s=theta_s, c_rr=c_rr)
    assert acceleration == pytest.approx(0.0, abs=1e-12)


# Limits


@always(robots())
def test_a_low_centroid_makes_tipping_a_matter_of_length(robot):
    x = robot["L"] - robot["p"] - robot["C_L"]
    assume(abs(x) > 0.01)
    low = robot | {"C_N": 1e-9}
    assert margin.theta_s_sup(**low) == pytest.approx(np.copysign(np.pi / 2, x), abs=1e-6)


@always(robots(), slopes)
def test_margin_is_the_smallest_slope_with_a_negative_bound(robot, theta_s):
    # the two ways of saying it agree: theta_s < theta_s_sup exactly where min a_r0 > 0
    sup = margin.theta_s_sup(**robot)
    assume(abs(theta_s - sup) > 1e-9)
    assert (tipping.min_a_r0(**robot, theta_s=theta_s) > 0.0) == (theta_s < sup)


@always(robots(), slopes, accelerations)
def test_centroid_margin_is_the_margin_in_metres(robot, theta_s, a):
    # moved by its margin, the robot stands on the verge
    room = margin.centroid_margin_downhill(**robot, theta_s=theta_s, a=a)
    moved = robot | {"C_L": robot["C_L"] + room}
    assert tipping.min_a_r0(**moved, theta_s=theta_s) == pytest.approx(a, abs=1e-9)
    room = margin.centroid_margin_uphill(**without(robot, "L"), theta_s=theta_s, a=a)
    moved = without(robot, "L") | {"C_L": robot["C_L"] - room}
    assert tipping.max_a_rn(**moved, theta_s=theta_s) == pytest.approx(a, abs=1e-9)


@always(robots(), st.floats(0.0, 0.99))
def test_lowest_contact_stays_within_one_spacing_of_the_rear_tip(robot, fraction):
    d = fraction * robot["p"]
    s = plane.lowest_contact(d=d, L=robot["L"], p=robot["p"])
    slack = 1e-12 * robot["L"]
    assert robot["L"] - robot["p"] - slack <= s < robot["L"] + slack
    steps = (s - d) / robot["p"]
    assert steps == pytest.approx(np.round(steps), abs=1e-9)


# Labels: every formula on arrays and on labelled arrays, each argument along its own dimension

EXAMPLES = {
    "M": 12.0, "a": 0.7, "theta_s": 0.6, "mu_s": 0.9, "traction": 60.0, "normal": 90.0,
    "d": 0.03, "k": 2.0, "n": 3.0, "p": 0.15, "L": 0.47, "C_L": 0.196, "C_N": 0.071, "s": 0.35,
    "alpha": 0.3, "beta": 0.3, "theta_alpha": 0.6, "theta_beta": 0.8, "min_a_r0": 3.0,
    "max_a_rn": -4.0, "a_S": 2.0, "a_slides_up": -9.0, "a_r0": 8.0, "a_rn": -7.0, "grip": 0.8,
    "theta_s_sup": 1.0, "theta_d": 0.05, "theta_M": 0.02, "spare_d": 0.03,
    "spare_M": 0.01, "x": 0.2, "slope": 0.1, "kappa": 0.1,
    "share": 0.4, "x_0": 0.4, "x_n": 0.05,
    "x_z": 0.3, "backward": 0.01, "forward": 0.02, "v": 0.3, "theta": 0.5, "l_c": 0.27, "R": 0.06,
    "F": 80.0, "c_rr": 0.05, "r": 0.05, "eta": 0.7, "T": 2.0, "gamma": 0.4, "psi": 0.3,
    "gauge": 0.3, "g": 9.8, "holds": 1.0, "lever": 0.07, "gyration": 0.13,
}  # fmt: skip

NEEDS_NUMPY = {
    # sums over the contacts along the last axis; labelled arrays through xarray.apply_ufunc
    "load_shares",
}  # fmt: skip


LABELS_LOST = {"oblique.edge_limit"}

MODULES = (
    "slipping", "triangle", "tipping", "plane", "margin", "margins", "loads", "measures",
    "transitions", "drive", "oblique", "validity", "verdict",
)  # fmt: skip


def public_formulas():
    for short in MODULES:
        module = importlib.import_module(f"kaidan.mechanics.{short}")
        for name, function in inspect.getmembers(module, inspect.isfunction):
            own = function.__module__ == module.__name__
            public = not name.startswith("_") and "__mutmut_" not in name  # see docs/mutation.md
            if own and public and name not in NEEDS_NUMPY:
                yield pytest.param(function, id=f"{short}.{name}")


FORMULAS = list(public_formulas())


def two_of_each(function):
    names = list(inspect.signature(function).parameters)
    values = {name: np.array([1.0, 1.02]) * EXAMPLES[name] for name in names}
    if "p" in values:
        values["p"] = np.array([0.15, 0.24])  # p <= L / 2 and not, so that NaN shows its axis
    return values


def crossed(values):
    """Every array along an axis of its own."""
    return {
        name: value.reshape([-1 if i == j else 1 for j in range(len(values))])
        for i, (name, value) in enumerate(values.items())
    }


def fields(result):
    return result if isinstance(result, tuple) else (result,)


@pytest.mark.parametrize("function", FORMULAS)
def test_arguments_are_keywords(function):
    kinds = {p.kind for p in inspect.signature(function).parameters.values()}
    assert kinds == {inspect.Parameter.KEYWORD_ONLY}


@pytest.mark.parametrize("function", FORMULAS)
def test_arrays_give_what_floats_give(function):
    values = two_of_each(function)
    shape = (2,) * len(values)
    results = fields(function(**crossed(values)))
    for at in itertools.islice(np.ndindex(shape), 0, None, 3):
        picked = {name: float(values[name][i]) for name, i in zip(values, at, strict=True)}
        for array, single in zip(results, fields(function(**picked)), strict=True):
            # numpy's vector loops may differ from its scalar ones in the last digit
            assert np.broadcast_to(array, shape)[at] == pytest.approx(
                single, rel=1e-14, nan_ok=True
            )


@pytest.mark.parametrize("function", FORMULAS)
def test_labels_stay(function, request):
    if request.node.callspec.id in LABELS_LOST:
        request.applymarker(pytest.mark.xfail(reason="not yet for labelled arrays"))
    values = two_of_each(function)
    labelled = {
        name: xr.DataArray(value, dims=name, coords={name: value}) for name, value in values.items()
    }
    for result, plain in zip(
        fields(function(**labelled)), fields(function(**crossed(values))), strict=True
    ):
        assert isinstance(result, xr.DataArray)
        whole = xr.broadcast(result, *labelled.values())[0].transpose(*labelled)
        np.testing.assert_array_equal(whole.values, np.broadcast_to(plain, whole.shape))
