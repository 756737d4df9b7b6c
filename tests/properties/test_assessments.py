"""Properties of `kaidan.assess`, whatever the robot and the stairs."""

import itertools
import json
import math
from functools import partial

import hypothesis.strategies as st
import jsonschema
import pytest
from hypothesis import assume, given, reject, settings

import one_posture
from amounts import examples
from kaidan import Assessment, Payload, Robot, Stairs, Surface
from kaidan.modes import Verdict
from kaidan.robot import Track, Uncertainty
from kaidan.terrain.stairs_uncertainty import StairsUncertainty

assess = partial(one_posture.assess, model="closed-form")

ROUNDING = {"rel": 1e-9, "abs": 1e-9}
"""A dozen operations with quotients up to 1e3, in degrees and millimetres."""
SCHEMA = jsonschema.Draft202012Validator(Assessment.json_schema())
WAYS = st.fixed_dictionaries(
    {
        "direction": st.sampled_from(["up", "down"]),
        "facing": st.sampled_from(["nose-first", "tail-first"]),
    }
)


def always(whole, *strategies):
    """The same examples in every run."""
    return lambda test: settings(max_examples=examples(whole), deadline=None)(
        given(*strategies)(test)
    )


@st.composite
def shapes(draw):
    """Figures of a robot and a flight that it fits on, lengths in metres."""
    L = draw(st.floats(0.4, 1.4))
    return {
        "L": L,
        "C_L": L * draw(st.floats(0.05, 0.95)),
        "C_N": L * draw(st.floats(0.04, 0.5)),
        "p": L / draw(st.floats(2.02, 6.0)),
        "angle": draw(st.floats(0.35, 1.2)),
    }


accelerations = st.just(0.0) | st.floats(-4, 4)
frictions = st.none() | st.floats(0.2, 4)
allowances = st.fixed_dictionaries(
    {}, optional={"theta_d": st.floats(0, 0.06), "theta_M": st.floats(0, 0.06)}
)


def robot_of(shape, mass=20.0, **more):
    return Robot(
        name="any",
        mass=mass,
        com_from_front=shape["C_L"],
        com_height=shape["C_N"],
        track=Track(flat_length=shape["L"]),
        **more,
    )


def stairs_of(shape, **more):
    rise, going = (shape["p"] * side(shape["angle"]) for side in (math.sin, math.cos))
    if not (0.02 <= rise <= 0.6 and 0.02 <= going <= 2.5):
        reject()
    return Stairs(rise=rise, going=going, **more)


def ask(shape, **question):
    return assess(robot_of(shape), stairs_of(shape), **question)


def worse(one, other):
    return Verdict(one.verdict).rank > Verdict(other.verdict).rank


# What an answer always is


@always(200, shapes(), WAYS, accelerations, frictions, allowances, st.floats(0, 0.01), st.data())
def test_an_answer_is_consistent(shape, ways, a, friction, measured, sigma, data):
    uncertainty = Uncertainty(com_from_front=sigma, com_height=sigma / 2)
    uncertainty = uncertainty if data.draw(st.booleans()) else Uncertainty()
    answer = assess(
        robot_of(shape, uncertainty=uncertainty),
        stairs_of(shape),
        friction=friction,
        acceleration=a,
        risk=data.draw(st.sampled_from([0.01, 0.1, 0.5])),
        **ways,
        **measured,
    )
    SCHEMA.validate(json.loads(answer.to_json()))
    if answer.verdict == "outside-model":
        assert answer.margin_deg is None
        return
    # margin and verdict never disagree in sign; without friction no GO
    if answer.verdict == "go":
        assert answer.margin_deg > 0
        assert friction is not None
    elif answer.verdict == "no-go":
        assert answer.margin_deg <= 0
    elif answer.margin_deg > 0:
        assert answer.governs == "friction_unknown"
    known = [margin for margin in answer.margins_deg.values() if margin is not None]
    assert answer.margin_deg <= min(known) + 1e-9
    assert answer.margin_best_deg >= answer.margin_deg
    # the chosen risk decides
    chance = answer.failure_probability
    if chance is None:
        assert answer.margin_deg == min(known)
        assert answer.margin_interval_deg is None
    else:
        assert (answer.margin_deg > 0) == (chance <= answer.question.risk)
        low, high = answer.margin_interval_deg
        assert low <= high
        each = [one.probability for one in answer.findings.values()]
        assert max(alone for alone in each if alone is not None) <= chance <= 1
    # bands: allowances and risk only take away
    band = answer.closed_form
    if band.a_max_safe is not None:
        assert band.a_min_safe < band.a_max_safe
        if chance is None:
            assert band.a_max_safe <= band.a_max + 1e-9
            assert band.a_min_safe >= band.a_min - 1e-9
    # certain, no drive: GO is the safe band
    if chance is None and friction is not None:
        inside = band.a_max_safe is not None and band.a_min_safe < a < band.a_max_safe
        if abs(answer.margin_deg) > 1e-9:
            assert inside == (answer.margin_deg > 0)
            assert (band.area == "D") == (answer.margin_deg > 0)
    # max. start acceleration and braking are the ends of that band
    if band.a_max_safe is not None:
        up = ways["direction"] == "up"
        start = band.a_max_safe if up else -band.a_min_safe
        stop = -band.a_min_safe if up else band.a_max_safe
        assert band.max_start == (start if start > 0 else None)
        assert band.max_braking == (stop if stop > 0 else None)
    for change in answer.what_would_help:
        rank = Verdict(change.verdict).rank - Verdict(answer.verdict).rank
        assert rank < 0 or (rank == 0 and change.margin_deg > answer.margin_deg)


@always(60, shapes(), WAYS, accelerations, st.floats(0.3, 4))
def test_an_advised_reversal_holds_what_it_promises(shape, ways, a, friction):
    answer = ask(shape, friction=friction, acceleration=a, **ways)
    other = "tail-first" if ways["facing"] == "nose-first" else "nose-first"
    for change in answer.what_would_help:
        if change.change.startswith("Go "):
            turned = ask(shape, friction=friction, acceleration=a, **(ways | {"facing": other}))
            assert (turned.verdict, turned.margin_deg) == (change.verdict, change.margin_deg)


# Scaling: angles and accelerations know no length


@always(80, shapes(), WAYS, accelerations, frictions, st.floats(0.5, 2))
def test_scaling_all_lengths_leaves_angles_and_accelerations(shape, ways, a, friction, k):
    small = ask(shape, friction=friction, acceleration=a, **ways)
    larger = {name: k * value if name != "angle" else value for name, value in shape.items()}
    assume(larger["C_N"] >= 0.005)
    large = ask(larger, friction=friction, acceleration=a, **ways)
    if small.margin_deg is not None and abs(small.margin_deg) > 1e-9:
        assert (large.verdict, large.governs) == (small.verdict, small.governs)
        assert large.falls_over == small.falls_over
    for name in ("margin_deg", "required_friction"):
        assert_same(getattr(small, name), getattr(large, name), name)
    few, many = small.closed_form, large.closed_form
    assert (few is None) == (many is None)
    if few is None:
        return
    assert many.contacts_n == few.contacts_n
    for name in ("margin_angle_deg", "a_max", "a_min_safe"):
        assert_same(getattr(few, name), getattr(many, name), name)
    if few.margin_centroid_mm is not None:
        assert many.margin_centroid_mm == pytest.approx(k * few.margin_centroid_mm, **ROUNDING)


def assert_same(one, other, name):
    assert other == (None if one is None else pytest.approx(one, **ROUNDING)), name


# Mirror: nose first down is tail first up of the robot turned round


@always(80, shapes(), accelerations, frictions, st.sampled_from(["nose-first", "tail-first"]))
def test_down_is_up_of_the_turned_robot(shape, a, friction, facing):
    """But for theta_M, which only climbing locks: measured here, so that both take it off."""
    measured = {"theta_d": 0.02, "theta_M": 0.03}
    other = "tail-first" if facing == "nose-first" else "nose-first"
    end = {"nose": "tail", "tail": "nose", None: None}
    question = {"friction": friction, "acceleration": a, **measured}
    down = ask(shape, direction="down", facing=facing, **question)
    turned = shape | {"C_L": shape["L"] - shape["C_L"]}
    same_pose = ask(shape, direction="up", facing=other, **question)
    mirrored = ask(turned, direction="up", facing=facing, **question)
    for up, ends in ((same_pose, lambda x: x), (mirrored, end.get)):
        if down.margin_deg is not None and abs(down.margin_deg) < 1e-9:
            continue
        assert (up.verdict, up.governs) == (down.verdict, down.governs)
        assert up.falls_over == ends(down.falls_over)
        assert_same(down.margin_deg, up.margin_deg, "margin_deg")
        for name in ("margin_angle_deg", "lower_angle_deg", "a_max", "a_min_safe"):
            one, found = (getattr(each.closed_form, name, None) for each in (down, up))
            if name == "lower_angle_deg" and (one is None) != (found is None):
                assert (one or found) < 1e-9  # at level to rounding
                continue
            assert_same(one, found, name)


def test_theta_m_is_what_mirror_images_differ_by():
    shape = {"L": 0.47, "C_L": 0.196, "C_N": 0.071, "p": 0.15, "angle": 0.7}
    up = ask(shape, friction=2.0)
    down = ask(shape, friction=2.0, direction="down", facing="tail-first")
    assert down.margin_deg - up.margin_deg == pytest.approx(2.6, abs=1e-9)


# Monotony


@always(80, shapes(), WAYS, accelerations, st.floats(0.1, 3), st.floats(0, 2))
def test_more_friction_is_never_worse(shape, ways, a, friction, more):
    less_grip = ask(shape, friction=friction, acceleration=a, **ways)
    more_grip = ask(shape, friction=friction + more, acceleration=a, **ways)
    assert not worse(more_grip, less_grip)
    if less_grip.margin_deg is not None:
        assert more_grip.margin_deg >= less_grip.margin_deg


@always(80, shapes(), WAYS, accelerations, st.floats(0, 0.3))
def test_a_higher_centroid_never_improves_tipping_downhill(shape, ways, a, more):
    """While the equivalent slope is uphill: the limit is a slope, and it sinks with the height."""
    low = ask(shape, friction=5.0, acceleration=a, **ways)
    high = ask(shape | {"C_N": shape["C_N"] + more}, friction=5.0, acceleration=a, **ways)
    figures = low.closed_form
    if figures is None or figures.paper.min_a_r0 < 0:
        return
    assume(figures.margin_angle_deg > 0)
    assume(math.tan(math.radians(figures.margin_angle_deg)) * 9.80665 > -a)
    x_uphill = figures.a_tip_downhill  # positive: the centroid is above its support
    if x_uphill > 0 and a >= 0:
        assert high.margins_deg["tip_downhill"] <= low.margins_deg["tip_downhill"] + 1e-9


@always(60, shapes(), WAYS, st.floats(0.2, 4), st.floats(0.01, 0.3))
def test_steeper_is_worse_where_theory_says_so(shape, ways, friction, more):
    """Downhill tipping and sliding get worse with the slope, uphill tipping gets better."""
    steeper = shape | {"angle": shape["angle"] + more}
    gentle, steep = (ask(each, friction=friction, **ways) for each in (shape, steeper))
    for mode, sign in (
        ("tip_downhill", 1),
        ("slides_down", 1),
        ("tip_uphill", -1),
        ("slides_up", -1),
    ):
        before, after = gentle.margins_deg.get(mode), steep.margins_deg.get(mode)
        if before is not None and after is not None:
            assert sign * (before - after) == pytest.approx(math.degrees(more), **ROUNDING)
    if gentle.governs in ("tip_downhill", "slides_down"):
        assert not worse(gentle, steep)


@always(60, shapes(), WAYS, accelerations, frictions, st.floats(0, 0.05), st.floats(0, 0.05))
def test_larger_allowances_are_never_better(shape, ways, a, friction, theta, more):
    question = {"friction": friction, "acceleration": a, **ways}
    small = ask(shape, **question, theta_d=theta, theta_M=theta)
    for grown in (
        {"theta_d": theta + more, "theta_M": theta},
        {"theta_d": theta, "theta_M": theta + more},
    ):
        large = ask(shape, **question, **grown)
        assert not worse(small, large)
        if small.margin_deg is not None:
            assert large.margin_deg <= small.margin_deg + 1e-9


@always(40, shapes(), WAYS, st.floats(0.5, 4), st.floats(0.0005, 0.01))
def test_less_risk_is_never_kinder(shape, ways, friction, sigma):
    robot = robot_of(shape, uncertainty=Uncertainty(com_from_front=sigma, com_height=sigma))
    stairs = stairs_of(shape, uncertainty=StairsUncertainty(angle=sigma, nosing_spacing=sigma / 3))
    found = [
        assess(robot, stairs, friction=friction, risk=risk, **ways) for risk in (0.5, 0.1, 0.01)
    ]
    for kind, strict in itertools.pairwise(found):
        assert not worse(kind, strict)
        if strict.margin_deg is not None:
            assert kind.margin_deg >= strict.margin_deg


@always(40, shapes(), WAYS, accelerations, st.floats(0.5, 4))
def test_a_range_of_friction_lies_between_its_ends(shape, ways, a, friction):
    question = {"acceleration": a, **ways}
    low, high = (ask(shape, friction=f, **question) for f in (friction, friction + 0.3))
    ground = Surface(friction_low=friction, friction_high=friction + 0.3)
    between = ask(shape, surface=ground, **question)
    assert between.margin_deg == low.margin_deg
    assert not worse(high, between)
    assert not worse(between, low)


# Payload


@always(60, shapes(), WAYS, st.floats(0.5, 4), st.floats(0, 30))
def test_a_payload_at_the_centroid_changes_nothing_but_the_mass(shape, ways, friction, mass):
    load = Payload(mass=mass, from_front=shape["C_L"], height=shape["C_N"])
    bare, loaded = (ask(shape, friction=friction, payload=p, **ways) for p in ((), load))
    assert loaded.mass_kg == pytest.approx(20 + mass, **ROUNDING)
    if bare.margin_deg is not None:
        assert loaded.margin_deg == pytest.approx(bare.margin_deg, **ROUNDING)


@always(40, shapes(), WAYS, st.lists(st.floats(0.1, 5), min_size=2, max_size=5))
def test_payloads_add_up_in_any_order(shape, ways, masses):
    loads = [
        Payload(mass=mass, from_front=0.1 * i, height=0.05 * i) for i, mass in enumerate(masses)
    ]
    one = ask(shape, payload=loads, **ways)
    other = ask(shape, payload=loads[::-1], **ways)
    assert one.com_from_front_m == pytest.approx(other.com_from_front_m, rel=1e-12)
    assert one.com_height_m == pytest.approx(other.com_height_m, rel=1e-12)


# A measured flight


@always(40, shapes(), WAYS, st.floats(0.5, 4), st.data())
def test_a_measured_flight_is_as_bad_as_its_worst_step(shape, ways, friction, data):
    rise, going = (shape["p"] * side(shape["angle"]) for side in (math.sin, math.cos))
    assume(0.03 <= rise <= 0.5)
    assume(0.03 <= going <= 2.0)
    steps = data.draw(st.integers(9, 14))
    small = st.floats(-0.004, 0.004)
    rises = [rise + data.draw(small) for _ in range(steps)]
    goings = [going + data.draw(small) for _ in range(steps - 1)]
    robot = robot_of(shape)
    whole = assess(robot, Stairs(rises=rises, goings=goings), friction=friction, **ways)
    each = [
        assess(robot, Stairs(rise=r, going=g), friction=friction, **ways)
        for r, g in list(zip(rises[1:], goings, strict=True))[:-1]
    ]
    if any(answer.verdict == "outside-model" for answer in each):
        assert whole.verdict == "outside-model"
        return
    assert whole.margin_deg == pytest.approx(min(answer.margin_deg for answer in each), **ROUNDING)
    assert whole.required_friction == max(answer.required_friction for answer in each)
    for name, tightest in (("a_tip_downhill", min), ("a_tip_uphill", max), ("a_slides_down", min)):
        expected = tightest(getattr(answer.closed_form, name) for answer in each)
        assert getattr(whole.closed_form, name) == pytest.approx(expected, **ROUNDING)
