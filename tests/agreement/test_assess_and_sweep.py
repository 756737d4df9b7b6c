"""One robot and ten million get the same answer: assess, the plain sweep and the compiled one.

assess judges by margins of `kaidan.mechanics.margins`, readings, samples and steps; the sweeps by
`kaidan.mechanics.verdict.judged` over arrays, the compiled one through its own tan and atan2.
"""

import math

import numpy as np
import pytest

from kaidan import Robot, Stairs, Surface, assess, sweep, verdicts
from kaidan.mechanics.margins import Mode
from kaidan.mechanics.verdict import Judged, Verdict
from kaidan.robot import Drive, Track
from kaidan.sweeps import compiled

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
        if name in ("verdict", "governs"):
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
    modes = np.array([answer.tip_downhill, answer.tip_uphill, answer.slip_up, answer.slip_down])
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
    assert kinds == set(map(int, Verdict))
    governing = set(plain.governs[plain.verdict != Verdict.OUTSIDE_MODEL].tolist())
    assert governing == set(map(int, Mode))
    # a positive margin of a known friction is what GO means, in both
    for answer in (plain, fast):
        with np.errstate(invalid="ignore"):
            go = (answer.margin > 0) & ~np.isnan(pairs["friction"])
        np.testing.assert_array_equal(answer.verdict == Verdict.GO, go)
        outside = 2 * pairs["nosing_spacing"] > pairs["flat_length"] * (1 + 1e-15)
        np.testing.assert_array_equal(answer.verdict == Verdict.OUTSIDE_MODEL, outside)
        for name in set(Judged._fields) - {"verdict", "governs", "required_friction"}:
            assert np.isnan(getattr(answer, name)[outside]).all(), name


WORDS = {Verdict.GO: "go", Verdict.CAUTION: "caution", Verdict.NO_GO: "no-go"}
WORDS |= {Verdict.OUTSIDE_MODEL: "outside-model"}


def random_cases(count, seed):
    """Certain questions to assess, and the same to sweep."""
    draw = np.random.default_rng(seed)
    for _ in range(count):
        L = float(draw.uniform(0.3, 1.5))
        p = float(np.clip(L / draw.uniform(1.7, 8), 0.06, 0.7))
        angle = float(draw.uniform(0.35, 1.2))
        if not (0.02 <= p * math.sin(angle) <= 0.6 and 0.02 <= p * math.cos(angle) <= 2.5):
            continue
        driven = draw.random() < 0.3
        robot = Robot(
            name="any",
            mass=20.0,
            com_from_front=L * float(draw.uniform(0.1, 0.9)),
            com_height=L * float(draw.uniform(0.05, 0.4)),
            track=Track(flat_length=L),
            drive=Drive(
                max_traction=float(draw.uniform(50, 400)) if driven else None,
                rolling_resistance=float(draw.uniform(0, 0.3)),
            ),
        )
        friction = None if draw.random() < 0.2 else float(draw.uniform(0.2, 2.5))
        ways = {
            "direction": str(draw.choice(["up", "down"])),
            "facing": str(draw.choice(["nose-first", "tail-first"])),
        }
        acceleration = float(draw.choice([0.0, draw.uniform(-9, 4)]))
        measured = {}
        if draw.random() < 0.5:
            measured = {"theta_d": float(draw.uniform(0, 0.05))}
        if draw.random() < 0.3:
            measured |= {"theta_M": float(draw.uniform(0, 0.05))}
        yield robot, angle, p, friction, acceleration, ways, measured


def test_assess_and_sweep_agree_on_certain_cases():
    seen = dict.fromkeys(WORDS.values(), 0)
    governing = set()
    for robot, angle, p, friction, a, ways, measured in random_cases(2_300, seed=3):
        stairs = Stairs.inclined(angle=angle, nosing_spacing=p)
        asked = assess(robot, stairs, friction=friction, acceleration=a, **ways, **measured)
        surface = None if friction is None else Surface.of_friction(friction)
        # the sheet's rise and going are rounded: sweep with the angle and spacing they give
        table = sweep(robot, stairs, surface=surface, acceleration=a, **ways, **measured)
        assert WORDS[Verdict(int(table.verdict))] == asked.verdict
        seen[asked.verdict] += 1
        if asked.verdict == "outside-model":
            assert np.isnan(table.margin_deg)
            continue
        modes = [mode.name.lower() for mode in Mode] + ["drive"]
        governs = modes[int(table.governs)]
        governing.add(governs)
        if asked.governs != "friction_unknown":
            assert governs == asked.governs
        for name, value in {
            "margin_deg": asked.margin_deg,
            "margin_angle_deg": asked.margin_angle_deg,
            **{f"{mode}_deg": value for mode, value in asked.margins_deg.items()},
            "margin_centroid_mm": asked.margin_centroid_mm,
            "required_friction": asked.required_friction,
        }.items():
            found = float(table[name])
            if value is None:
                assert math.isnan(found), name
            else:
                # degrees and millimetres: 1e3 times the rounding of radians and metres
                assert found == pytest.approx(value, rel=1e-9, abs=1e3 * ROUNDING), name
        if asked.a_max is not None:
            assert float(table.a_max) == pytest.approx(asked.a_max, rel=1e-9, abs=ROUNDING * 1e3)
            assert float(table.a_min) == pytest.approx(asked.a_min, rel=1e-9, abs=ROUNDING * 1e3)
        else:
            assert not table.a_min < table.a_max
    assert sum(seen.values()) >= 2_000
    assert min(seen.values()) > 100, seen
    assert governing == {"tip_downhill", "tip_uphill", "slip_up", "slip_down", "drive"}
