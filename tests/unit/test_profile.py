"""Terrain: numbers by hand from drawings in the comments, unless a line says otherwise."""

import math
import time
from itertools import pairwise

import numpy as np
import pytest

from kaidan.errors import InputError
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

ROUNDING = 1e-12  # m: sums of a few numbers of about a metre


def test_a_uniform_flight():
    """By hand: three risers of 0.2, goings 0.3, landings 2 and 1.5."""
    flight = Stairs(rise=0.2, going=0.3, steps=3, lower_landing=2.0, upper_landing=1.5)
    profile = Profile.of_stairs(flight)
    by_hand = [
        (-2, 0),
        (0, 0),
        (0, 0.2),
        (0.3, 0.2),
        (0.3, 0.4),
        (0.6, 0.4),
        (0.6, 0.6),
        (2.1, 0.6),
    ]
    np.testing.assert_allclose(profile.points, by_hand, atol=ROUNDING)
    np.testing.assert_allclose(profile.nosings, [(0, 0.2), (0.3, 0.4), (0.6, 0.6)], atol=ROUNDING)
    assert profile.nosing_spacing == pytest.approx(np.hypot(0.2, 0.3), abs=ROUNDING)
    assert profile.angle == pytest.approx(np.arctan2(0.2, 0.3), abs=ROUNDING)
    assert profile.irregularity == pytest.approx(0.0, abs=ROUNDING)
    assert profile.landings == pytest.approx((2.0, 1.5), abs=ROUNDING)
    assert not profile.overhangs
    assert not profile.open_risers


def test_a_face_that_a_scan_folds_has_one_nosing():
    """By hand: two risers of 0.1 m, the first goes up and down within itself by 20 and 60 mm."""
    folded = [(0, 0.04), (0, 0.02), (0, 0.09), (0, 0.03)]
    before, behind = [(-2, 0), (0, 0)], [(0, 0.1), (0.3, 0.1), (0.3, 0.15), (0.3, 0.2), (2, 0.2)]
    profile = Profile.of_points([*before, *folded, *behind])
    smooth = Profile.of_points([*before, *behind])
    assert profile.nosings.tolist() == smooth.nosings.tolist() == [[0.0, 0.1], [0.3, 0.2]]
    assert profile.points.tolist() == smooth.points.tolist()
    assert [0.3, 0.15] in profile.points.tolist()  # of a face that only rises every point stays
    assert profile.roughness == smooth.roughness


def test_an_irregular_flight():
    """By hand: nosings at (0, .1), (.3, .3), (.6, .5), (.9, .74): the last stands off the line."""
    profile = Profile.of_stairs(Stairs(rises=(0.1, 0.2, 0.2, 0.24), goings=(0.3, 0.3, 0.3)))
    np.testing.assert_allclose(profile.nosings[:, 1], [0.1, 0.3, 0.5, 0.74], atol=ROUNDING)
    np.testing.assert_allclose(
        profile.spacings, [np.hypot(0.2, 0.3)] * 2 + [np.hypot(0.24, 0.3)], atol=ROUNDING
    )
    assert profile.irregularity > 0.005


def test_two_flights_with_a_landing_between():
    """By hand: the upper landing of the lower flight, 1.2 m, lies between them."""
    flight = Stairs(rise=0.2, going=0.3, steps=2, upper_landing=1.2)
    profile = Profile.of_flights([flight, flight])
    np.testing.assert_allclose(
        profile.nosings, [(0, 0.2), (0.3, 0.4), (1.5, 0.6), (1.8, 0.8)], atol=ROUNDING
    )
    assert profile.points[-1].tolist() == pytest.approx([3.0, 0.8], abs=ROUNDING)
    with pytest.raises(InputError, match="no flight"):
        Profile.of_flights([])


def test_points_of_stairs_are_the_stairs():
    flight = Profile.of_stairs(Stairs(rise=0.18, going=0.28, steps=4))
    again = Profile.of_points(flight.points)
    np.testing.assert_array_equal(again.points, flight.points)
    np.testing.assert_array_equal(again.nosings, flight.nosings)


def test_an_overhang_becomes_its_upper_envelope():
    """By hand: a nosing 20 mm over the tread below hides the recess under it."""
    profile = Profile.of_points([(-1, 0), (0, 0), (0, 0.15), (-0.02, 0.15), (-0.02, 0.2), (1, 0.2)])
    assert profile.overhangs
    np.testing.assert_allclose(
        profile.points, [(-1, 0), (-0.02, 0), (-0.02, 0.2), (0, 0.2), (1, 0.2)], atol=ROUNDING
    )
    np.testing.assert_allclose(profile.nosings, [(-0.02, 0.2)], atol=ROUNDING)


def test_a_scan_that_goes_back_again_and_again_becomes_its_upper_envelope():
    """Of every place the highest point of the line, by brute force; x never runs backwards.

    The second return leads behind the first: the two windows are one.
    """
    there, back = (0.3, 0.6, 0.8, 1.0), (0.0, 0.25, 0.5, 0.1)
    nested = [(x, 0.05 * k) for k, pair in enumerate(zip(back, there, strict=True)) for x in pair]
    assert Profile.of_points(nested).overhangs
    lines = [np.array(nested)]
    for seed in range(300):
        rng = np.random.default_rng(seed)
        steps = rng.normal(0.01, rng.choice([0.004, 0.01, 0.02]), int(rng.integers(5, 60)))
        rises = rng.normal(0.003, 0.005, len(steps))
        lines.append(np.cumsum(np.stack([steps, rises], 1), axis=0))
    seen = 0
    for line in lines:
        try:
            profile = Profile.of_points(line)
        except InputError:  # it crosses itself, or leads nowhere
            continue
        x, z = profile.points.T
        assert (np.diff(x) >= 0).all()
        places = np.linspace(x[0], x[-1], 211)[1:-1]
        places = places[np.abs(places[:, None] - x).min(axis=1) > 1e-9]  # faces have two heights
        heights = np.full(len(places), -np.inf)
        for (x0, z0), (x1, z1) in pairwise(line):
            over = (places - x0) * (places - x1) <= 0
            heights[over] = np.maximum(
                heights[over], z0 + (z1 - z0) * (places[over] - x0) / (x1 - x0)
            )
        np.testing.assert_allclose(np.interp(places, x, z), heights, atol=1e-9)
        seen += profile.overhangs
    assert seen > 50


def test_reflected_twice_is_the_same():
    profile = Profile.of_stairs(Stairs(rise=0.2, going=0.3, steps=3))
    np.testing.assert_array_equal(profile.reflected().reflected().points, profile.points)
    assert profile.reflected().landings == profile.landings[::-1]


def test_steps_count_from_the_bottom():
    profile = Profile.of_stairs(Stairs(rise=0.2, going=0.3, steps=3))
    assert [profile.step_of(x) for x in (-0.1, 0.0, 0.29, 0.3, 5.0)] == [0, 1, 1, 2, 3]


def test_nothing_can_be_written_into_it():
    profile = Profile.of_stairs(Stairs(rise=0.2, going=0.3, steps=3))
    with pytest.raises(ValueError, match="read-only"):
        profile.points[0, 0] = 1.0


@pytest.mark.parametrize(
    ("points", "text"),
    [
        ([(0, 0), (1, 0), (1, 1), (0.5, -0.5), (2, 2)], "crosses itself"),
        ([(0, 0), (np.nan, 1)], r"point 2 is \[nan, 1.0\], not two finite numbers"),
        ([(0, 0), (np.inf, 1)], "point 2"),
        ("abc", "must be numbers"),
        ([(0, 0, 0)], r"shape \(1, 3\), not \(n, 2\)"),
        ([], "shape"),
        ([(0, 0), (0, 0)], "two different points"),
        ([(0, 0), (-1, 0)], "lead ahead in x"),
        ([(0, 0), (300_000, 0)], "in millimetres"),
    ],
)
def test_what_is_refused(points, text):
    with pytest.raises(InputError, match=text):
        Profile.of_points(points)


def test_zero_length_steps_are_dropped():
    profile = Profile.of_points([(0, 0), (0, 0), (1, 0), (1, 0), (1, 0.2), (1, 0.2), (2, 0.2)])
    assert len(profile.points) == 4


def windows(n):
    """Points that run back and forth, 950 of them each way, all the way up."""
    k = np.arange(n)
    x = np.where(k % 1900 < 950, k % 1900, 1900 - k % 1900) * 1e-3 + k // 1900 * 2
    return np.column_stack([x, k * 1e-6])


@pytest.mark.parametrize(
    "points",
    [
        np.column_stack([np.linspace(0, 1000, 10**6), np.zeros(10**6)]),
        np.column_stack(
            [np.linspace(0, 1000, 10**6) - 1.9 * (np.arange(10**6) % 2), np.zeros(10**6)]
        ),
        windows(10**6),
    ],
    ids=["level", "zigzag", "many loops"],
)
def test_a_million_points_are_an_answer_or_an_error_in_bounded_time(points):
    start = time.process_time()
    try:
        assert len(Profile.of_points(points).points) > 0
    except InputError as error:
        assert "thin it" in str(error)  # noqa: PT017 - either is right
    assert time.process_time() - start < 15.0  # s: takes 2 here; ten times slower machines pass


def test_a_noisy_scan_has_the_nosings_of_its_flight():
    """1 cm apart with 3 mm of noise: a bump on a landing or a dent in a riser is no nosing."""
    rng = np.random.default_rng(3)
    corners = [(-1.0, 0.0), (0.0, 0.0), (0.0, 0.18), (0.28, 0.18), (0.28, 0.36), (0.56, 0.36)]
    corners += [(0.56, 0.54), (1.6, 0.54)]
    line = []
    for begin, end in pairwise(np.array(corners)):
        line += list(np.linspace(begin, end, round(math.dist(begin, end) / 0.01), endpoint=False))
    points = np.array([*line, corners[-1]])
    points[:, 1] += rng.normal(0.0, 0.003, len(points))
    profile = Profile.of_points(points)
    at = [(0.0, 0.18), (0.28, 0.36), (0.56, 0.54)]
    np.testing.assert_allclose(profile.nosings, at, atol=0.015)  # the roughness it is blind to
    assert 0.006 < profile.roughness <= 0.015  # from a bump to a dent
    assert Profile.of_points(corners).roughness == 0.0


def more_points(points, count, rng):
    """The same line with points added on it."""
    at = rng.integers(0, len(points) - 1, count)
    share = rng.random(count)
    added = points[at] + share[:, None] * (points[at + 1] - points[at])
    places = np.concatenate([np.arange(len(points)), at + share])
    return np.concatenate([points, added])[np.argsort(places, kind="stable")]


@pytest.mark.parametrize("seed", range(20))
def test_points_of_a_low_flight_have_its_nosings_wherever_they_lie(seed):
    """Also with points on the lines, up and down, and with all points off by a micrometre."""
    rng = np.random.default_rng(seed)
    rise, going = rng.uniform(0.02, 0.06), rng.uniform(0.02, 0.4)
    flight = Profile.of_stairs(Stairs(rise=rise, going=going, steps=int(rng.integers(2, 12))))
    for like in (flight, flight.reflected()):
        for added in (0, 1, 200):
            line = more_points(like.points, added, rng)
            profile = Profile.of_points(line)
            np.testing.assert_allclose(profile.edges, like.edges, atol=ROUNDING)
            assert profile.roughness < ROUNDING
            moved = Profile.of_points(line + rng.uniform(-1e-6, 1e-6, line.shape))
            # of the points above and before a corner any may be the farthest, all within 2 um
            np.testing.assert_allclose(moved.edges, like.edges, atol=4e-6)


@pytest.mark.parametrize(
    ("line", "nosings", "roughness"),
    [
        # by hand: a lip on a floor
        ([(-1, 0), (0, 0), (0, 0.014), (1, 0.014)], [], 0.014),
        ([(-1, 0), (0, 0), (0, 0.015), (1, 0.015)], [], 0.015),
        ([(-1, 0), (0, 0), (0, 0.016), (1, 0.016)], [(0, 0.016)], 0.0),
        # a sill, its far edge no nosing
        ([(-1, 0), (0, 0), (0, 0.02), (0.01, 0.02), (0.01, 0), (1, 0)], [(0, 0.02)], 0.0),
        # a lip of 5 mm on a tread, one before a riser
        (
            [
                (-1, 0),
                (0, 0),
                (0, 0.2),
                (0.1, 0.2),
                (0.1, 0.205),
                (0.3, 0.205),
                (0.3, 0.4),
                (1, 0.4),
            ],
            [(0, 0.2), (0.3, 0.4)],
            0.005,
        ),
        # a tread of 14 mm parts no riser
        (
            [(-1, 0), (0, 0), (0, 0.1), (0.014, 0.1), (0.014, 0.2), (1, 0.2)],
            [(0.014, 0.2)],
            0.014,
        ),
        # 60 deg: 0.035 (1 - cot 60) = 14.8 mm, 0.036 (1 - cot 60) = 15.2 mm
        ([(-1, 0), (0, 0), (0.035 / 3**0.5, 0.035), (1, 0.035)], [], 0.0148),
        ([(-1, 0), (0, 0), (0.036 / 3**0.5, 0.036), (1, 0.036)], [(0.0208, 0.036)], 0.0),
        # a chamfer at 45 deg: its lower end, whatever lies on it
        ([(-1, 0), (0, 0), (0, 0.1), (0.01, 0.11), (0.02, 0.12), (1, 0.12)], [(0, 0.1)], 0.0),
        ([(0, 0), (0.5, 0.5), (1, 1)], [], 0.0),
        # a dent of 10 mm in a ramp is rough, the ramp is not
        ([(-1, 0), (0, 0.2), (0, 0.19), (0, 0.2), (1, 0.4)], [], 0.01),
    ],
    ids=[
        *("lip", "limit", "riser", "sill", "tread", "narrow", "leans", "steeper"),
        *("chamfer", "ramp", "dent"),
    ],
)
def test_what_stands_out_by_more_than_15_mm_is_a_nosing(line, nosings, roughness):
    profile = Profile.of_points(line)
    np.testing.assert_allclose(profile.nosings, np.reshape(nosings, (-1, 2)), atol=5e-5)
    assert profile.roughness == pytest.approx(roughness, abs=5e-5)


def test_what_falls_is_driven_down_or_given_the_other_way_round():
    """By hand: three risers of 0.2 down, goings 0.3."""
    falling = [(-1, 0.6), (0, 0.6), (0, 0.4), (0.3, 0.4), (0.3, 0.2), (0.6, 0.2), (0.6, 0), (2, 0)]
    profile = Profile.of_points(falling)
    assert profile.rise == pytest.approx(-0.6, abs=ROUNDING)
    assert not profile.is_level
    upward = profile.upward(descending=True)
    assert upward.rise == pytest.approx(0.6, abs=ROUNDING)
    np.testing.assert_allclose(upward.nosings, [(-0.6, 0.2), (-0.3, 0.4), (0, 0.6)], atol=ROUNDING)
    with pytest.raises(InputError) as refused:
        profile.upward(descending=False)
    assert str(refused.value) == (
        "profile: it falls by 0.60 m from left to right: drive it down, or give the points the "
        "other way round"
    )
    rising = Profile.of_stairs(Stairs(rise=0.2, going=0.3, steps=3))
    assert rising.upward(descending=False) is rising
    assert rising.upward(descending=True) is rising


@pytest.mark.parametrize(("height", "level"), [(0.0, True), (0.014, True), (0.016, False)])
def test_a_floor_is_level_within_the_roughness(height, level):
    """15 mm make no step."""
    assert Profile.of_points([(0, 0), (1, 0), (1, height), (2, height)]).is_level is level


def test_edges_rise_or_fall():
    """By hand: a gap 0.7 m wide, its far side a nosing, its near side none."""
    gap = Profile.of_points([(-2, 0), (0, 0), (0, -0.3), (0.7, -0.3), (0.7, 0), (2.7, 0)])
    np.testing.assert_allclose(gap.nosings, [(0.7, 0)], atol=ROUNDING)
    np.testing.assert_allclose(gap.edges, [(0, 0), (0.7, 0)], atol=ROUNDING)
    np.testing.assert_allclose(gap.reflected().edges, [(-0.7, 0), (0, 0)], atol=ROUNDING)
    flight = Profile.of_stairs(Stairs(rise=0.2, going=0.3, steps=3))
    np.testing.assert_array_equal(flight.edges, flight.nosings)
    np.testing.assert_array_equal(flight.reflected().edges, flight.reflected().nosings)


def test_a_question_about_a_profile_is_the_same_after_json():
    from kaidan.question import Question

    question = Question.of("kenaf", Profile.of_points([(-1, 0), (0, 0), (0, 0.2), (1, 0.2)]))
    assert Question.model_validate_json(question.model_dump_json()) == question
