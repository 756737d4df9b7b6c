"""Sweeps: labelled tables, pairs by the million, streams, and what they refuse."""

import builtins
import math
import sys

import numpy as np
import pytest
import xarray as xr

import kaidan
from kaidan import InputError, Payload, Posture, Robot, Stairs, Surface, stream, sweep, verdicts
from kaidan.errors import MissingExtraError
from kaidan.mechanics.verdict import Judged
from kaidan.modes import Verdict
from kaidan.sweeps import compiled, compiled_pairs, elementary, pairs
from kaidan.sweeps.pairs import CODES, INPUTS

RIG = Robot.named("kenaf").model_copy(update={"theta_d": None, "theta_M": None})
KENAF = {"flat_length": 0.470, "com_from_uphill": 0.196, "com_height": 0.071}
PAIR = KENAF | {"angle": math.radians(40), "nosing_spacing": 0.150, "friction": 2.0}
SHAPE = {"angle": math.radians(40), "nosing_spacing": 0.150, "friction": 2.0}
ENGINES = [
    "numpy",
    pytest.param(
        "compiled", marks=pytest.mark.skipif(not compiled.available(), reason="needs numba")
    ),
]

with_each_engine = pytest.mark.parametrize("engine", ENGINES)


# Labelled sweeps


def test_a_sequence_is_a_dimension():
    # hand: atan((470 - p - 196) / 71)
    spacings, angles = [0.150, 0.180, 0.220], np.radians([20, 40])
    table = sweep(RIG, angle=angles, nosing_spacing=spacings, friction=2.0)
    assert table.verdict.dims == ("angle", "nosing_spacing")
    np.testing.assert_array_equal(table.angle, angles)
    np.testing.assert_array_equal(table.nosing_spacing, spacings)
    expected = np.degrees(np.arctan((0.274 - np.array(spacings)) / 0.071))
    for row in table.margin_angle_deg.values:
        np.testing.assert_allclose(row, expected, rtol=1e-12)
    # 220 mm holds from 18.7 to 37.3 deg without allowances: 20 deg only if theta_d is kind
    assert table.verdict.values.tolist() == [[0, 0, 2], [0, 0, 3]]
    assert table.sel(nosing_spacing=0.15, angle=angles[1]).margin_deg == pytest.approx(
        60.2053827958 - 45.2, abs=1e-9
    )


def test_names_units_and_meanings():
    table = sweep("kenaf", angle=[0.5, 0.6], nosing_spacing=0.150)
    units = {name: table[name].attrs.get("units") for name in table.data_vars}
    assert units == {
        "verdict": None,
        "governs": None,
        **dict.fromkeys(
            [
                *("margin_deg", "margin_angle_deg", "tip_downhill_deg", "tip_uphill_deg"),
                *("slides_down_deg", "slides_up_deg", "drive_deg"),
            ],
            "deg",
        ),
        "a_max": "m/s^2",
        "a_min": "m/s^2",
        "margin_centroid_mm": "mm",
        "required_friction": "1",
    }
    assert table.angle.attrs["units"] == "rad"
    assert all(table[name].attrs["long_name"] for name, unit in units.items() if unit is not None)
    assert table.verdict.attrs == {
        "flag_values": [0, 1, 2, 3, 4],
        "flag_meanings": "go rough unsure no-go outside-model",
    }
    assert table.governs.attrs == {
        "flag_values": [0, 1, 2, 3, 4],
        "flag_meanings": "tip-downhill tip-uphill slides-down slides-up drive",
    }
    assert table.attrs == {
        "robot": "kenaf",
        "direction": "up",
        "facing": "nose-first",
        "model": "closed-form",
    }
    assert table.verdict.dtype == table.governs.dtype == np.int8


def test_data_arrays_keep_their_dimensions():
    survey = {"stair": ["front", "back", "cellar"]}
    rise = xr.DataArray([0.10, 0.11, 0.12], dims="stair", coords=survey)
    going = xr.DataArray([0.12, 0.12, 0.16], dims="stair", coords=survey)
    table = sweep("kenaf", rise=rise, going=going, friction=[1.0, 2.0])
    assert set(table.dims) == {"stair", "friction"}
    assert table.stair.values.tolist() == survey["stair"]
    expected = np.degrees(np.arctan((0.274 - np.hypot(rise, going)) / 0.071))
    np.testing.assert_allclose(
        table.margin_angle_deg.sel(friction=1.0).values, expected.values, rtol=1e-12
    )


def test_what_is_not_swept_comes_from_the_sheets():
    table = sweep("absolem", "ibc", flippers="flat", surface="concrete-dry")
    one = {"flippers": "flat", "friction": 0.6}  # its smallest
    answer = kaidan.assess("absolem", "ibc", model="closed-form", **one)
    assert table.verdict.dims == ()
    assert float(table.margin_deg) == pytest.approx(answer.margin_deg, abs=1e-9)
    assert table.attrs["robot"] == "absolem"
    # a sheet with another angle, and a parameter in place of one of its two
    table = sweep("kenaf", Stairs(rise=0.1, going=0.12), rise=[0.08, 0.1], friction=2.0)
    expected = np.degrees(np.arctan((0.274 - np.hypot([0.08, 0.1], 0.12)) / 0.071))
    np.testing.assert_allclose(table.margin_angle_deg, expected, rtol=1e-12)
    table = sweep("kenaf", Stairs(rise=0.1, going=0.12), angle=0.5)
    assert float(table.margin_angle_deg) == pytest.approx(
        math.degrees(math.atan((0.274 - math.hypot(0.1, 0.12)) / 0.071)), abs=1e-9
    )


def test_own_figures_of_the_robot():
    # hand: atan((0.6 - 0.15 - [0.2, 0.3]) / 0.1), nose up; the other end first: C_L = L - 0.2 ...
    asked = {"flat_length": 0.6, "com_from_front": [0.2, 0.3], "com_height": 0.1}
    table = sweep("kenaf", **SHAPE, **asked)
    np.testing.assert_allclose(
        table.margin_angle_deg, np.degrees(np.arctan([2.5, 1.5])), rtol=1e-12
    )
    table = sweep("kenaf", **SHAPE, **asked, facing="tail-first")
    np.testing.assert_allclose(
        table.margin_angle_deg, np.degrees(np.arctan([0.5, 1.5])), rtol=1e-12
    )
    load = Payload(mass=5, from_front=0.1, height=0.2)
    loaded = Robot.named("kenaf").model_copy(update={"mass": 15.0})
    table = sweep(loaded, **SHAPE, payload=load)
    # hand: (15 x 0.196 + 5 x 0.1) / 20 = 0.172, (15 x 0.071 + 5 x 0.2) / 20 = 0.10325
    assert float(table.margin_angle_deg) == pytest.approx(
        math.degrees(math.atan((0.32 - 0.172) / 0.10325)), abs=1e-9
    )


def test_allowances_unless_swept():
    # hand: unmeasured 2.6 deg each, given back at best: UNSURE between; measured, GO or NO-GO
    angles = np.radians([54, 58, 61])
    rest = {"nosing_spacing": 0.150, "friction": 3.0}
    assert sweep(RIG, angle=angles, **rest).verdict.values.tolist() == [0, 2, 3]
    measured = {"theta_d": math.radians(1), "theta_M": math.radians(2)}
    assert sweep(RIG, angle=angles, **rest, **measured).verdict.values.tolist() == [0, 3, 3]
    # going down only theta_d
    down = sweep(RIG, angle=angles, **rest, direction="down", facing="tail-first")
    assert float(down.margin_deg[0]) == pytest.approx(60.2053827958 - 54 - 2.6, abs=1e-9)


def test_a_sweep_without_stairs_reaches_as_far_as_its_parameters():
    # hand: no flight of stairs is level or rises by 89 deg, but the formulas speak of both: on the
    # level 60.205 - 5.2 deg are left, at 89 deg it falls
    table = sweep("kenaf", angle=[0.0, 1.55], nosing_spacing=0.150, friction=2.0)
    assert table.verdict.values.tolist() == [Verdict.GO.rank, Verdict.NO_GO.rank]
    assert float(table.margin_angle_deg[0] - 5.2) == pytest.approx(55.0053827958, abs=1e-9)
    assert sweep("kenaf", angle=[], nosing_spacing=0.150).verdict.shape == (0,)


def test_unknown_friction_gives_no_go():
    table = sweep("kenaf", angle=math.radians(40), nosing_spacing=0.150)
    assert int(table.verdict) == Verdict.UNSURE.rank
    assert np.isnan(table.slides_down_deg)
    assert int(sweep("kenaf", **SHAPE).verdict) == Verdict.GO.rank


def test_no_go_where_assess_says_no():
    """What assess judges beside the formulas: the drive, postures, gaps, short flights."""
    asked = {"angle": 0.5, "nosing_spacing": 0.2, "friction": 2.0}
    # hand: 60 N hold 30 kg up to asin(60 / 294.2) = 11.8 deg
    weak = Robot.named("kenaf").model_copy(
        update={"mass": 30.0, "drive": kaidan.robot.Drive(max_traction=60.0)}
    )
    table = sweep(weak, **asked)
    assert (int(table.verdict), int(table.governs)) == (Verdict.NO_GO.rank, 4)
    assert float(table.drive_deg) == pytest.approx(
        math.degrees(math.asin(60 / 30 / 9.80665) - 0.5), abs=1e-9
    )
    assert float(table.margin_deg) == float(table.drive_deg)
    lowered = sweep("absolem", **asked, flippers=Posture(front=-0.5))
    gapped = sweep(
        Robot.named("kenaf").model_copy(
            update={"track": kaidan.robot.Track(flat_length=0.47, gap=0.1)}
        ),
        **asked,
    )
    short = sweep("kenaf", Stairs(rise=0.1, going=0.1, steps=3), friction=2.0)
    for table in (lowered, gapped, short):
        assert int(table.verdict) == Verdict.OUTSIDE_MODEL.rank
        for name in set(table.data_vars) - {"verdict", "governs"}:
            assert np.isnan(table[name]), name
    # past the vertical no place of the centroid holds
    steep = sweep("kenaf", angle=1.5, nosing_spacing=0.150, friction=2.0)
    assert int(steep.verdict) == Verdict.NO_GO.rank
    assert np.isnan(steep.margin_centroid_mm)


REFUSED = {
    "unknown": ({"slope": 0.5}, "unknown parameter 'slope'; known: flat_length, com_from_front, "),
    "both shapes": (
        {"rise": 0.1, "angle": 0.5},
        "sweep either rise and going or angle and nosing_spacing, not both",
    ),
    "no stairs": (
        {"angle": 0.5},
        "no stairs: give them, or rise and going, or angle and nosing_spacing",
    ),
    "surface and friction": (
        {**SHAPE, "surface": "concrete-dry"},
        "give either a surface or a friction, not both",
    ),
    "text": ({**SHAPE, "friction": "0.8"}, "friction is not a number or an array of numbers, but"),
    "true": ({**SHAPE, "friction": True}, "friction is not a number or an array of numbers, but"),
    "none": ({**SHAPE, "friction": None}, "friction is not a number or an array of numbers, but"),
    "nan": ({**SHAPE, "angle": math.nan}, "angle holds NaN"),
    "infinite": (
        {**SHAPE, "angle": [0.5, math.inf]},
        "angle = inf rad is not within 0 to 1.5533 rad",
    ),
    "negative": (
        {**SHAPE, "friction": [0.5, -0.1]},
        "friction = -0.1 1 is not within 0 to 5 1",
    ),
    "degrees": ({**SHAPE, "angle": 40.0}, "angle = 40 rad is not within 0 to 1.5533 rad"),
    "millimetres": (
        {**SHAPE, "nosing_spacing": 150},
        "nosing_spacing = 150 m is not within 0.02 to 2.5 m",
    ),
    "acceleration": (
        {**SHAPE, "acceleration": [-10.0, 0]},
        "acceleration = -10 m/s^2 is not within -9.8 to 9.8 m/s^2",
    ),
    "two dimensions": (
        {**SHAPE, "angle": np.full((2, 2), 0.5)},
        "angle has 2 dimensions; name them in a DataArray",
    ),
    "centroid": (
        {**SHAPE, "com_from_front": [0.2, 0.9]},
        "com_from_front = 0.9 m puts the centroid outside the robot: allowed -0.065 m to "
        "flat_length +0.065 m",
    ),
    "engine": (
        {**SHAPE, "engine": "steam"},
        "engine = 'steam' is not known; known: auto, numpy, compiled",
    ),
    "facing": (
        {**SHAPE, "facing": "up"},
        "facing = 'up' is not known; known: nose-first, tail-first",
    ),
    "labels": (
        {
            "rise": xr.DataArray([0.1, 0.11], dims="x", coords={"x": [1, 2]}),
            "going": xr.DataArray([0.1, 0.11], dims="x", coords={"x": [2, 3]}),
        },
        "parameters share a dimension but not its labels: ",
    ),
    "sizes": (
        {
            "rise": xr.DataArray([0.1, 0.11], dims="x"),
            "going": xr.DataArray([0.1, 0.11, 0.12], dims="x"),
        },
        "parameters share a dimension but not its labels: ",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_sweep_refuses(name):
    parameters, text = REFUSED[name]
    with pytest.raises(InputError) as refused:
        sweep("kenaf", **parameters)
    assert str(refused.value).startswith(text)


def test_sweep_refuses_stairs_that_are_not_uniform():
    flight = Stairs(rises=(0.1, 0.1, 0.105, 0.1), goings=(0.12,) * 3, name="old")
    with pytest.raises(InputError, match=r"stairs 'old' are not uniform; sweep them step by step"):
        sweep("kenaf", flight)


# Pairs


@with_each_engine
def test_pairs_by_hand(engine):
    # hand: 60.205, minus 40 and twice 2 deg; friction atan 2 = 63.4 deg
    found = verdicts(PAIR | {"theta_d": math.radians(2), "theta_M": math.radians(2)}, engine=engine)
    assert isinstance(found, Judged)
    assert int(found.verdict) == Verdict.GO.rank
    sup = math.atan(124 / 71)
    theta = math.radians(40)
    assert float(found.theta_s_sup) == pytest.approx(sup, rel=1e-14)
    assert float(found.margin) == pytest.approx(sup - math.radians(44), rel=1e-13)
    assert float(found.tip_uphill) == pytest.approx(
        theta + math.atan(46 / 71) - math.radians(2), rel=1e-13
    )
    assert float(found.slides_down) == pytest.approx(math.atan(2) - theta, rel=1e-13)
    assert float(found.slides_up) == pytest.approx(math.atan(2) + theta, rel=1e-13)
    g, cos, sin = 9.80665, math.cos(theta), math.sin(theta)
    assert float(found.a_max) == pytest.approx(g * (124 / 71 * cos - sin), rel=1e-13)
    assert float(found.a_min) == pytest.approx(-g * (46 / 71 * cos + sin), rel=1e-13)
    assert float(found.centroid) == pytest.approx(
        0.124 - 0.071 * math.tan(math.radians(44)), rel=1e-12
    )
    assert float(found.required_friction) == pytest.approx(math.tan(theta), rel=1e-13)


@with_each_engine
def test_shapes_broadcast(engine):
    angles = np.radians(np.linspace(20, 60, 7))
    spacings = np.array([0.15, 0.18, 0.2, 0.22])[:, None]
    found = verdicts(PAIR | {"angle": angles, "nosing_spacing": spacings}, engine=engine)
    assert {array.shape for array in found} == {(4, 7)}
    assert {name for name, array in found._asdict().items() if array.dtype == np.int8} == set(CODES)
    for i in range(4):
        for j in range(7):
            one = verdicts(
                PAIR | {"angle": angles[j], "nosing_spacing": spacings[i, 0]}, engine=engine
            )
            for whole, single in zip(found, one, strict=True):
                np.testing.assert_array_equal(whole[i, j], single)
    assert verdicts(PAIR | {"angle": []}, engine=engine).verdict.shape == (0,)
    assert verdicts(PAIR | {"angle": np.empty((3, 0))}, engine=engine).margin.shape == (3, 0)
    assert verdicts(PAIR | {"angle": [0.5]}, engine=engine).margin.shape == (1,)


@with_each_engine
def test_odd_memory_gives_the_same(engine):
    """Strides, orders, byte orders and lesser types; more pairs than one piece of work."""
    count = 150_000
    draw = np.random.default_rng(1)
    angles = draw.uniform(0.3, 1.1, count).astype(np.float32).astype(np.float64)
    expected = verdicts(PAIR | {"angle": angles}, engine=engine)
    doubled = np.repeat(angles, 2)[::2]
    for odd in (
        angles.astype(np.float32),
        angles.astype(">f8"),
        doubled,
        angles[::-1].copy()[::-1],
        xr.DataArray(angles),
    ):
        for one, other in zip(
            verdicts(PAIR | {"angle": odd}, engine=engine), expected, strict=True
        ):
            np.testing.assert_array_equal(one, other)
    table = np.asfortranarray(angles.reshape(300, 500))
    found = verdicts(PAIR | {"angle": table}, engine=engine)
    np.testing.assert_array_equal(found.margin, expected.margin.reshape(300, 500))
    assert not angles.flags.owndata or angles.flags.writeable  # inputs stay as they were
    np.testing.assert_array_equal(
        expected.margin, verdicts(PAIR | {"angle": angles}, engine=engine).margin
    )


@with_each_engine
def test_writing_into_an_earlier_answer(engine):
    angles = np.linspace(0.3, 1.0, 10)
    first = verdicts(PAIR | {"angle": angles}, engine=engine)
    kept = [array.copy() for array in first]
    again = verdicts(PAIR | {"angle": angles + 0.1}, out=first, engine=engine)
    assert all(one is other for one, other in zip(again, first, strict=True))
    assert not np.array_equal(first.margin, kept[2])
    verdicts(PAIR | {"angle": angles}, out=first, engine=engine)
    for one, other in zip(first, kept, strict=True):
        np.testing.assert_array_equal(one, other)


def test_an_answer_that_does_not_fit_is_refused():
    angles = np.linspace(0.3, 1.0, 10)
    question = PAIR | {"angle": angles}
    good = verdicts(question)
    frozen = good.margin.copy()
    frozen.flags.writeable = False
    for out, text in (
        ([1, 2], "out is not an earlier answer of verdicts"),
        (good._replace(margin=None), "out is not an earlier answer of verdicts"),
        (good._replace(margin=np.empty(9)), "out.margin has shape (9,), not (10,), or"),
        (good._replace(margin=np.empty(20)[::2]), "out.margin has shape (10,), not (10,), or is"),
        (good._replace(margin=frozen), "out.margin has shape (10,), not (10,), or is not"),
        (good._replace(margin=np.empty(10, np.float32)), "out.margin is of float32, not float64"),
        (good._replace(verdict=np.empty(10)), "out.verdict is of float64, not int8"),
        (good._replace(margin=angles), "out.margin shares its memory with the input angle"),
    ):
        with pytest.raises(InputError) as refused:
            verdicts(question, out=out)
        assert str(refused.value).startswith(text)


BAD_PAIRS = {
    "missing": ({}, "missing input: flat_length, com_from_uphill, com_height, angle, nosing_spac"),
    "unknown": (PAIR | {"mass": 1.0}, "unknown input 'mass'; known: flat_length, com_from_uphill"),
    "nan": (PAIR | {"angle": [0.5, math.nan]}, "angle holds NaN"),
    "infinite": (PAIR | {"angle": [math.inf, -math.inf]}, "angle = -inf rad is not within 0 to"),
    "infinite friction": (PAIR | {"friction": math.inf}, "friction = inf 1 is not within 0 to 5"),
    "masked": (
        PAIR | {"angle": np.ma.array([0.5, 0.6], mask=[False, True])},
        "angle holds masked values",
    ),
    "text": (PAIR | {"angle": ["0.5"]}, "angle is not a number or an array of numbers, but of <U3"),
    "bytes": (PAIR | {"angle": b"0.5"}, "angle is not a number or an array of numbers, but of |S3"),
    "truth": (
        PAIR | {"angle": [True]},
        "angle is not a number or an array of numbers, but of bool",
    ),
    "complex": (
        PAIR | {"angle": np.array([0.5 + 1j])},
        "angle is not a number or an array of numbers, but of complex128",
    ),
    "dates": (
        PAIR | {"angle": np.array(["2020"], "datetime64[D]")},
        "angle is not a number or an array of numbers, but of datetime64[D]",
    ),
    "huge": (PAIR | {"angle": 10**400}, "angle is not a number or an array of numbers, but of obj"),
    "none": (PAIR | {"angle": None}, "angle is not a number or an array of numbers, but of object"),
    "ragged": (PAIR | {"angle": [[1, 2], [3]]}, "angle is not a number or an array of numbers: "),
    "shapes": (
        PAIR | {"angle": [0.5, 0.6], "friction": [1, 2, 3]},
        "shapes do not broadcast: angle (2,), friction (3,)",
    ),
    "centroid": (
        PAIR | {"com_from_uphill": -0.7},
        "com_from_uphill = -0.7 m is not within -0.6 to 5.6 m",
    ),
}


@pytest.mark.parametrize("name", BAD_PAIRS)
def test_verdicts_refuses(name):
    inputs, text = BAD_PAIRS[name]
    with pytest.raises(InputError) as refused:
        verdicts(inputs)
    assert str(refused.value).startswith(text)


def test_every_input_is_checked_unless_told_otherwise():
    for name in INPUTS:
        for value in (-99.0, 99.0):
            with pytest.raises(InputError, match=f"^{name} = {value:g} "):
                verdicts(PAIR | {name: value})
    assert int(verdicts(PAIR | {"friction": 99.0}, checked=False).verdict) == Verdict.GO.rank
    # limit: a spacing beyond the half track is outside whatever else is asked
    assert int(verdicts(PAIR | {"nosing_spacing": 0.3}).verdict) == Verdict.OUTSIDE_MODEL.rank


# Streams


@with_each_engine
def test_a_stream_gives_what_verdicts_gives(engine):
    draw = np.random.default_rng(3)
    angles = draw.uniform(0.3, 1.1, 1000)
    pieces = [angles[:300], angles[300:600], angles[600:601], angles[601:601], angles[601:]]
    chunks = ({**PAIR, "angle": piece} for piece in pieces)
    found = [[array.copy() for array in answer] for answer in stream(chunks, engine=engine)]
    whole = verdicts(PAIR | {"angle": angles}, engine=engine)
    assert [len(answer[0]) for answer in found] == [300, 300, 1, 0, 399]
    for index, expected in enumerate(whole):
        np.testing.assert_array_equal(np.concatenate([a[index] for a in found]), expected)


def test_a_stream_reuses_its_memory_and_waits_to_be_asked():
    asked = []

    def chunks():
        for angle in (0.4, 0.5, 0.6):
            asked.append(angle)
            yield PAIR | {"angle": np.full(5, angle)}

    answers = stream(chunks())
    assert asked == []
    first = next(answers)
    margins = first.margin.copy()
    assert asked == [0.4]
    second = next(answers)
    assert second.margin is first.margin
    np.testing.assert_allclose(margins - second.margin, 0.1, rtol=1e-12)
    answers.close()


def test_a_stream_refuses_the_chunk_that_is_wrong():
    answers = stream([PAIR, PAIR | {"angle": math.nan}])
    next(answers)
    with pytest.raises(InputError, match="angle holds NaN"):
        next(answers)


@pytest.mark.skipif(not compiled.available(), reason="needs numba")
def test_loops_are_compiled_where_it_pays(monkeypatch):
    """Not for a few pairs, which take microseconds; for many, and for a stream."""
    made = []
    monkeypatch.setattr(compiled_pairs, "kernel", lambda: made.append(1) or pairs._numpy_kernel)
    verdicts(PAIR)
    assert not made
    next(stream([PAIR]))
    assert len(made) == 1
    monkeypatch.setattr(pairs, "_WORTH_COMPILING", 5)
    verdicts(PAIR | {"angle": np.full(4, 0.6)})
    assert len(made) == 1
    verdicts(PAIR | {"angle": np.full(5, 0.6)})
    assert len(made) == 2


# Without numba


@pytest.fixture
def without_numba(monkeypatch):
    """As if numba were not installed."""
    real = builtins.__import__

    def no_numba(name, *rest, **more):
        if name.partition(".")[0] == "numba":
            raise ModuleNotFoundError("No module named 'numba'", name="numba")
        return real(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", no_numba)
    monkeypatch.setitem(sys.modules, "numba", None)
    compiled.compiled.cache_clear()
    compiled_pairs.kernel.cache_clear()
    yield
    compiled.compiled.cache_clear()
    compiled_pairs.kernel.cache_clear()


@pytest.mark.usefixtures("without_numba")
def test_without_numba_the_plain_engine_answers():
    assert not compiled.available()
    found = verdicts(PAIR)
    for one, other in zip(found, verdicts(PAIR, engine="numpy"), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.usefixtures("without_numba")
def test_without_numba_the_compiled_engine_says_how_to_install_it():
    with pytest.raises(ImportError) as missing:
        verdicts(PAIR, engine="compiled")
    assert isinstance(missing.value, MissingExtraError)
    assert str(missing.value) == (
        "the compiled sweep needs an optional package: pip install 'kaidan[fast]'"
    )


# tan and atan2 of the compiled loops


@pytest.mark.skipif(not compiled.available(), reason="needs numba")
@pytest.mark.parametrize("reach", [1e-300, 1e-8, 0.7, 1.5533, 3.9, 100.0, 1e5])
def test_tangent(reach):
    # oracle: numpy's, exact to an ulp; 4 ulp in reach of every robot, and further out what the
    # rounding of x itself makes of the tangent: (1 + t^2) ulp(x)
    draw = np.random.default_rng(5)
    x = np.concatenate([draw.uniform(-reach, reach, 20_000), [reach, -reach, 0.0]])
    tangent = compiled.compiled(elementary.tan)
    found, expected = np.array([tangent(value) for value in x]), np.tan(x)
    of_x = 0.0 if reach < 2 else np.spacing(np.abs(x)) * (1 + expected**2)
    assert np.all(np.abs(found - expected) <= 4 * np.spacing(np.abs(expected)) + of_x)


@pytest.mark.skipif(not compiled.available(), reason="needs numba")
def test_angle_of_a_vector():
    # oracle: numpy's
    draw = np.random.default_rng(6)
    angles = draw.uniform(-np.pi, np.pi, 20_000)
    lengths = 10.0 ** draw.uniform(-100, 100, 20_000)
    y, x = lengths * np.sin(angles), lengths * np.cos(angles)
    y = np.concatenate([y, [0.0, 0.0, 1.0, -1.0, 1e-200, 1.0, -1.0, 3.0, 0.66, -0.0]])
    x = np.concatenate([x, [1.0, -1.0, 0.0, 0.0, 1.0, 1.0, -1.0, 1e-200, 1.0, -1.0]])
    arctan2 = compiled.compiled(elementary.arctan2)
    found = np.array([arctan2(b, a) for b, a in zip(y, x, strict=True)])
    expected = np.arctan2(y, x)
    assert np.all(np.abs(found - expected) <= 4 * np.spacing(np.abs(expected)))


@pytest.mark.skipif(not compiled.available(), reason="needs numba")
def test_smaller_and_larger_as_numpy_has_them():
    some = [0.0, -0.0, 1.0, -2.5, math.inf, -math.inf, math.nan]
    for name in ("minimum", "fmin", "fmax"):
        ours, theirs = compiled.compiled(getattr(elementary, name)), getattr(np, name)
        for x in some:
            for y in some:
                np.testing.assert_array_equal(ours(x, y), theirs(x, y))


def test_the_surface_of_a_sweep_counts_with_its_smallest_friction():
    ground = Surface(friction_low=0.5, friction_high=2.0)
    table = sweep("kenaf", angle=0.6, nosing_spacing=0.150, surface=ground)
    assert int(table.verdict) == Verdict.NO_GO.rank  # tan 0.6 = 0.68
    assert float(table.slides_down_deg) == pytest.approx(
        math.degrees(math.atan(0.5) - 0.6), abs=1e-9
    )
