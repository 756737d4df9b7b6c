"""Quantities with units: what is read, and what is refused with which words."""

import math

import numpy as np
import pytest

from kaidan.errors import InputError
from kaidan.units import parse, parse_range, range_of


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("180mm", "length", 0.18),
        ("18cm", "length", 0.18),
        ("0.18m", "length", 0.18),
        ("7in", "length", 0.1778),
        ("2ft", "length", 0.6096),
        ("45deg", "angle", math.pi / 4),
        ("45°", "angle", math.pi / 4),
        ("0.5rad", "angle", 0.5),
        ("500g", "mass", 0.5),
        ("5kg", "mass", 5.0),
        ("10lb", "mass", 4.5359237),
        ("0.3m/s2", "acceleration", 0.3),
        ("0.3m/s^2", "acceleration", 0.3),
        ("0.1g0", "acceleration", 0.980665),
        ("100mm/s", "speed", 0.1),
        ("10cm/s", "speed", 0.1),
        ("0.1m/s", "speed", 0.1),
        ("3.6km/h", "speed", 1.0),
        ("1ft/s", "speed", 0.3048),
        ("2s", "time", 2.0),
        ("500ms", "time", 0.5),
        # ways to write the same
        ("180 mm", "length", 0.18),
        ("  180mm ", "length", 0.18),
        ("+180mm", "length", 0.18),
        ("180.mm", "length", 0.18),
        (".18m", "length", 0.18),
        ("1.8e2mm", "length", 0.18),
        ("1.8E+2 mm", "length", 0.18),
        ("-3mm", "length", -0.003),
        ("0mm", "length", 0.0),
    ],
)
def test_every_unit_by_hand(text, kind, value):
    # one product of two floats: rounding in the last digit
    assert parse(text, kind, option="--x") == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "kind", "fix"),
    [
        ("180", "length", "180mm or 180cm or 180m"),
        ("50", "angle", "50deg or 50° or 50rad"),
        ("5", "mass", "5g or 5kg or 5lb"),
        ("-0.3", "acceleration", "-0.3m/s2 or -0.3m/s^2 or -0.3g0"),
        ("1e-1", "speed", "1e-1mm/s or 1e-1cm/s or 1e-1m/s"),
    ],
)
def test_a_bare_number_is_refused_with_the_fix(text, kind, fix):
    with pytest.raises(InputError) as caught:
        parse(text, kind, option="--rise")
    assert str(caught.value) == f"--rise {text!r} has no unit; write {fix}"


@pytest.mark.parametrize(
    ("text", "kind", "known"),
    [
        ("180kg", "length", "'kg' is no unit of length; known: mm, cm, m, in, ft"),
        ("50mm", "angle", "'mm' is no unit of angle; known: deg, °, rad"),
        ("5m", "mass", "'m' is no unit of mass; known: g, kg, lb"),
        ("3m/s", "acceleration", "'m/s' is no unit of acceleration; known: m/s2, m/s^2, g0"),
        ("1min", "time", "'min' is no unit of time; known: s, ms"),
        ("3m/s2", "speed", "'m/s2' is no unit of speed; known: mm/s, cm/s, m/s, km/h, ft/s"),
        (
            "180MM",
            "length",
            "'MM' is no unit of length; known: mm, cm, m, in, ft; did you mean mm?",
        ),
    ],
)
def test_another_unit_is_refused_with_the_known_ones(text, kind, known):
    with pytest.raises(InputError) as caught:
        parse(text, kind, option="--x")
    assert str(caught.value) == f"--x {text!r}: {known}"


@pytest.mark.parametrize(
    "text",
    ["", " ", "mm", "--5mm", "five mm", "nan", "inf", "nanmm", "infm", "0x10mm", "180 m m",
     "１８０mm", "−5mm", "1.8.2m", "\x00", "5mm\n5mm", "180mm;rm", "1_000mm"],
)  # fmt: skip
def test_nonsense_is_refused_in_one_line(text):
    with pytest.raises(InputError) as caught:
        parse(text, "length", option="--rise")
    assert str(caught.value).startswith(f"--rise {text!r}")
    assert "\n" not in str(caught.value)


def test_no_number_at_all_gets_an_example():
    with pytest.raises(InputError) as caught:
        parse("steep", "angle", option="--angle")
    assert str(caught.value).startswith("--angle 'steep' is no angle;")
    assert str(caught.value).endswith("; write for example 50deg")


def test_a_number_past_all_bounds_is_refused():
    with pytest.raises(InputError) as caught:
        parse("1e400mm", "length", option="--rise")
    assert str(caught.value) == "--rise '1e400mm' is too large"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ('11"', 11 * 0.0254),
        ("11″", 11 * 0.0254),
        ("2'", 2 * 0.3048),
        ("7 1/2in", 7.5 * 0.0254),
        ("7-1/2in", 7.5 * 0.0254),
        ('7 1/2"', 7.5 * 0.0254),
        ("-7 1/2in", -7.5 * 0.0254),
        ("3/4in", 0.75 * 0.0254),
    ],
)
def test_inches_as_stairs_are_measured(text, value):
    assert parse(text, "length", option="--rise") == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "kind", "error"),
    [
        ("0,8", "number", "--x '0,8' has a decimal comma; write 0.8"),
        ("1,8m", "length", "--x '1,8m' has a decimal comma; write 1.8m"),
        ("180mm", "number", "--x '180mm' is not a plain number such as 0.8"),
        (
            "5 inch",
            "length",
            "--x '5 inch': 'inch' is no unit of length; known: mm, cm, m, in, ft; did you mean in?",
        ),
        ("7 1/0in", "length", "--x '7 1/0in' is no length; write for example 180mm"),
        ("9" * 10_000, "length", f"--x '{'9' * 56}... is no length; write for example 180mm"),
        (" " * 10_000, "length", "--x ' ' is no length; write for example 180mm"),
    ],
)
def test_what_to_write_instead(text, kind, error):
    with pytest.raises(InputError) as caught:
        parse(text, kind, option="--x")
    assert str(caught.value) == error


@pytest.mark.parametrize(
    ("text", "kind", "ends"),
    [
        ("0.8", "number", (0.8, 0.8)),
        ("0.6..1.0", "number", (0.6, 1.0)),
        ("0.6-1.0", "number", (0.6, 1.0)),
        ("0.6 – 1.0", "number", (0.6, 1.0)),
        ("0.6 to 1.0", "number", (0.6, 1.0)),
        ("1e-1", "number", (0.1, 0.1)),
        ("-0.5--0.2", "number", (-0.5, -0.2)),
        ("1..2rad", "angle", (1.0, 2.0)),
        ("100mm-0.2m", "length", (0.1, 0.2)),
        ("7-1/2in", "length", (0.1905, 0.1905)),
        ("7-8in", "length", (0.1778, 0.2032)),
        ("7 1/2-8in", "length", (0.1905, 0.2032)),
    ],
)
def test_ranges(text, kind, ends):
    # one product of two floats: rounding in the last digit
    assert parse_range(text, kind, option="--x") == pytest.approx(ends, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("0.6..", "--x '0.6..': a range has two ends, LOW..HIGH"),
        ("1.0..0.6", "--x '1.0..0.6': the low end of a range comes first"),
        ("0,6..1,0", "--x '0,6' has a decimal comma; write 0.6"),
        ("0.6-1.0-2", "--x '0.6-1.0-2' is not a plain number such as 0.8"),
    ],
)
def test_ranges_that_are_none(text, error):
    with pytest.raises(InputError) as caught:
        parse_range(text, "number", option="--x")
    assert str(caught.value) == error


@pytest.mark.parametrize("value", [0.8, (0.8, 0.8), [0.8, 0.8], np.float64(0.8), "0.8"])
def test_a_range_from_python(value):
    assert range_of(value, "number", option="friction") == (0.8, 0.8)


@pytest.mark.parametrize(
    ("value", "error"),
    [
        (None, "friction = None is not a number"),
        (True, "friction = True is not a number"),
        ((1, 2, 3), "friction = (1, 2, 3) is not a number or a pair (low, high)"),
        (math.nan, "friction = nan is not a finite number"),
        (10**400, "friction = inf is not a finite number"),
        ((1.0, 0.5), "friction = (1.0, 0.5): the low end of a range comes first"),
    ],
)
def test_no_range_from_python(value, error):
    with pytest.raises(InputError) as caught:
        range_of(value, "number", option="friction")
    assert str(caught.value) == error
