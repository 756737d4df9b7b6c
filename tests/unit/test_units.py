"""Quantities with units: what is read, and what is refused with which words."""

import math

import pytest

from kaidan.errors import InputError
from kaidan.units import parse


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
        ("180MM", "length", "'MM' is no unit of length; known: mm, cm, m, in, ft"),
        ("1,8m", "length", "',8m' is no unit of length; known: mm, cm, m, in, ft"),
        ("1.8.2m", "length", "'.2m' is no unit of length; known: mm, cm, m, in, ft"),
        ('7"', "length", "'\"' is no unit of length; known: mm, cm, m, in, ft"),
    ],
)
def test_another_unit_is_refused_with_the_known_ones(text, kind, known):
    with pytest.raises(InputError) as caught:
        parse(text, kind, option="--x")
    assert str(caught.value) == f"--x {text!r}: {known}"


@pytest.mark.parametrize(
    "text",
    ["", " ", "mm", "--5mm", "five mm", "nan", "inf", "nanmm", "infm", "0x10mm", "180 m m",
     "１８０mm", "−5mm", "1/2in", "\x00", "5mm\n5mm", "180mm;rm", "1_000mm"],
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
