"""One robot and ten million get the same answer: assess, the plain sweep and the compiled one.

assess judges by margins of `kaidan.mechanics.margins` over cases, samples and steps; the sweeps by
`kaidan.mechanics.verdict.judged` over arrays, the compiled one through its own tan and atan2.
"""

import math

import numpy as np
import pytest
import xarray as xr

from amounts import fast_and_slow
from kaidan import Robot, Stairs, assess, sweep, verdicts
from kaidan.mechanics.verdict import Judged
from kaidan.models.closed_form import MODES
from kaidan.modes import FORMULAS, Undecided, Verdict
from kaidan.robot import Drive, Track
from kaidan.sweeps import compiled
from kaidan.sweeps.pairs import CODES

ROUNDING = 1e-12
"""Twenty operations with quotients up to 1e3 in double precision [rad, m, m/s^2]."""

needs_numba = pytest.mark.skipif(not compiled.available(), reason="needs numba")


def random_pairs(count, seed):
    """Pairs of every kind: facing both ways, n from 1 to 12, friction unknown one time in five."""
    draw = np.random.default_rng(seed)
    L = draw.uniform(0.3, 2.0, count)
    theta_d, theta_M = draw.uniform(0, 0.06, (2, count))
    return {
        "flat_length": L,
        "com_from_uphill": L * draw.uniform(-0.1, 1.1, count),
        "com_height": L * draw.uniform(0.03, 0.6, count),
        "angle": draw.uniform(0, 1.55, count),
        "nosing_spacing": L / draw.uniform(1.5, 13, count),
        "friction": np.where(draw.random(count) < 0.2, np.nan, draw.uniform(0, 2.5, count)),
        "acceleration": draw.choice([0.0, 1.0], count) * draw.uniform(-9.8, 9.8, count),
        "theta_d": theta_d,
        "theta_M": theta_M,
        "theta_d_spare": theta_d * draw.choice([0.0, 1.0], count),
        "theta_M_spare": theta_M * draw.choice([0.0, 0.5, 1.0], count),
    }


def edge_pairs():
    """Pairs on the edges: p = L/2, slopes on a limit, friction of zero and of the slope, a = 0."""
    pairs = []
    for angle in (0.0, math.pi / 4, math.atan(0.5), 1.5533):
        for friction in (0.0, math.tan(angle), 1.0, math.nan):
            for p, C_L in ((0.25, 0.25), (0.25, 0.2), (0.15, 0.25), (0.1, 0.3), (0.25001, 0.2)):
                for a in (0.0, 9.8, -9.8):
                    pairs.append((0.5, C_L, 0.1, angle, p, min(friction, 5.0), a, 0, 0, 0, 0))
    names = random_pairs(1, 0)
    return dict(zip(names, np.array(pairs, dtype=float).T, strict=True))


def assert_alike(one, other, tilted):
    for name, left, right in zip(Judged._fields, one, other, strict=True):
        np.testing.assert_array_equal(np.isnan(left), np.isnan(right), err_msg=name)
        if name in CODES:
            # on a limit to rounding either side is right
            sharp = ~(np.abs(one.margin) < ROUNDING)
            if name == "governs":
                sharp &= ~(nearest_two(one) < ROUNDING)
            np.testing.assert_array_equal(left[sharp], right[sharp], err_msg=name)
        else:
            # relative to 1 for angles; bounds reach g x / C_N = 500 m/s^2; near the vertical the
            # tangent makes more of the rounding of the tilt
            scale = np.maximum(1.0, np.abs(left))
            if name == "centroid":
                scale = np.maximum(scale, 1.0 / np.cos(tilted) ** 2)
            assert np.nanmax(np.abs(left - right) / scale) <= ROUNDING, name


def nearest_two(answer):
    """Distance of the two smallest margins, where a tie may fall either way."""
    modes = np.array([getattr(answer, mode.key) for mode in FORMULAS])
    ordered = np.sort(np.where(np.isnan(modes), np.inf, modes), axis=0)
    with np.errstate(invalid="ignore"):
        return ordered[1] - ordered[0]


@needs_numba
@pytest.mark.parametrize(
    "pairs", [random_pairs(100_000, 2016), edge_pairs()], ids=["random", "edges"]
)
def test_both_engines_agree(pairs):
    plain, fast = verdicts(pairs, engine="numpy"), verdicts(pairs, engine="compiled")
    assert_alike(plain, fast, pairs["angle"] + pairs["theta_d"] + pairs["theta_M"])
    kinds = set(plain.verdict.tolist())
    assert kinds == set(WORDS)
    governing = set(plain.governs[plain.verdict != Verdict.OUTSIDE_MODEL.rank].tolist())
    assert governing == set(range(len(FORMULAS)))
    # a positive margin of a known friction is what GO means, in both
    for answer in (plain, fast):
        with np.errstate(invalid="ignore"):
            go = (answer.margin > 0) & ~np.isnan(pairs["friction"])
        np.testing.assert_array_equal(answer.verdict == Verdict.GO.rank, go)
        outside = 2 * pairs["nosing_spacing"] > pairs["flat_length"] * (1 + 1e-15)
        np.testing.assert_array_equal(answer.verdict == Verdict.OUTSIDE_MODEL.rank, outside)
        for name in set(Judged._fields) - {"verdict", "governs", "required_friction"}:
            assert np.isnan(getattr(answer, name)[outside]).all(), name


WORDS = {verdict.rank: verdict.value for verdict in Verdict if verdict is not Verdict.ROUGH}
"""What the closed form may answer: it knows no next contact, so that none is ROUGH."""


def random_robot(draw):
    """A robot, one time in three with a drive that may be too weak."""
    L = float(draw.uniform(0.3, 1.5))
    return Robot(
        name="any",
        mass=20.0,
        com_from_front=L * float(draw.uniform(0.1, 0.9)),
        com_height=L * float(draw.uniform(0.05, 0.4)),
        track=Track(flat_length=L),
        drive=Drive(
            max_traction=float(draw.uniform(50, 400)) if draw.random() < 0.3 else None,
            rolling_resistance=float(draw.uniform(0, 0.3)),
        ),
    )


def random_question(draw):
    """What holds for all flights of one robot: direction, allowances measured or not."""
    question = {
        "direction": str(draw.choice(["up", "down"])),
        "facing": str(draw.choice(["nose-first", "tail-first"])),
    }
    if draw.random() < 0.5:
        question["theta_d"] = float(draw.uniform(0, 0.05))
    if draw.random() < 0.3:
        question["theta_M"] = float(draw.uniform(0, 0.05))
    return question


def random_flights(draw, L, count):
    """Rise, going, friction and acceleration, each flight its own."""
    angle, p = draw.uniform(0.35, 1.2, count), L / draw.uniform(1.7, 8, count)
    rise, going = np.clip(p * np.sin(angle), 0.02, 0.6), np.clip(p * np.cos(angle), 0.02, 2.5)
    friction = draw.uniform(0.2, 2.5, count)
    acceleration = draw.choice([0.0, 1.0], count) * draw.uniform(-9, 4, count)
    return {"rise": rise, "going": going, "friction": friction, "acceleration": acceleration}


def assert_same(found, asked):
    """One flight of a table against the answer of assess."""
    assert WORDS[int(found["verdict"])] == asked.verdict
    if asked.verdict == "outside-model":
        assert math.isnan(found["margin_deg"])
        return
    if asked.governs != Undecided.FRICTION_UNKNOWN:
        assert MODES[int(found["governs"])].key == asked.governs
    one = asked.closed_form
    for name, value in {
        "margin_deg": asked.margin_deg,
        "margin_angle_deg": one.margin_angle_deg,
        **{f"{mode}_deg": value for mode, value in asked.margins_deg.items()},
        "margin_centroid_mm": one.margin_centroid_mm,
        "required_friction": asked.required_friction,
    }.items():
        if value is None:
            assert math.isnan(found[name]), name
        else:
            # degrees and millimetres: 1e3 times the rounding of radians and metres
            assert found[name] == pytest.approx(value, rel=1e-9, abs=1e3 * ROUNDING), name
    if one.a_max is None:
        assert not found["a_min"] < found["a_max"]
    else:
        assert found["a_max"] == pytest.approx(one.a_max, rel=1e-9, abs=1e3 * ROUNDING)
        assert found["a_min"] == pytest.approx(one.a_min, rel=1e-9, abs=1e3 * ROUNDING)


@pytest.mark.parametrize("sweeps", fast_and_slow(25, 110))
def test_assess_and_sweep_agree_on_certain_cases(sweeps):
    draw = np.random.default_rng(3)
    seen, governing, count = dict.fromkeys(WORDS.values(), 0), set(), 20
    for _ in range(sweeps):
        robot, question = random_robot(draw), random_question(draw)
        flights = random_flights(draw, robot.track.flat_length, count)
        if draw.random() < 0.2:
            del flights["friction"]
        arrays = {name: xr.DataArray(values, dims="case") for name, values in flights.items()}
        table = sweep(robot, **arrays, **question)
        columns = {name: table[name].values for name in table.data_vars}
        for i in range(count):
            friction = flights["friction"][i] if "friction" in flights else None
            stairs = Stairs(rise=flights["rise"][i], going=flights["going"][i])
            a = flights["acceleration"][i]
            question |= {"friction": friction, "acceleration": a}
            asked = assess(robot, stairs, model="closed-form", **question)
            assert_same({name: values[i] for name, values in columns.items()}, asked)
            seen[asked.verdict] += 1
            if asked.verdict != "outside-model":
                governing.add(asked.governs)
    assert sum(seen.values()) == count * sweeps
    assert min(seen.values()) > sweeps, seen
    assert governing == {*(mode.key for mode in MODES), Undecided.FRICTION_UNKNOWN}
