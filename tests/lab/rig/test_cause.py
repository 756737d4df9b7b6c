"""Grousers or rubber: rigs of both kinds, drawn from their mechanics, are told apart."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("scipy", reason="skipped: scipy not installed")

from kaidan.lab.rig.calibration import calibrate_rig
from kaidan.lab.rig.cause import contrast_of, step_of
from kaidan.lab.rig.protocol import protocol_of
from kaidan.lab.rig.sheet import Film, RigSheet, Trials
from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.yielding import theta_d_two_contacts
from kaidan.robot import Robot

KENAF = {"L": 0.470, "C_L": 0.196, "C_N": 0.071}
READ = math.radians(0.3)
"""Scatter of a tilt, as in the round trip of the whole kit."""
SET = 0.0015
"""How exactly a belt is set by hand [m]."""


def leans(p, s, h, start, rng):
    """Largest lean [rad] over five nosings under half-round bars, the first one set by hand."""
    places = (start + rng.normal(0.0, SET) + p * np.arange(6)) % s
    off = np.minimum(places, s - places)
    heights = np.sqrt(np.maximum(h * h - off * off, 0.0))
    return max(0.0, math.asin(np.diff(heights).max() / p))


def rig(kind, rng):
    """A sheet with ten trials in step and ten half off, as the protocol has them."""
    s, h, w_n = rng.uniform(0.025, 0.045), rng.uniform(0.005, 0.010), rng.uniform(0.003, 0.015)
    n, rows = round(0.150 / s), []
    for p in (n * s, (n + 0.5) * s):
        slope = float(theta_s_sup(p=p, **KENAF)) - math.radians(3.0)
        extra = []
        for start in [0.0] * 5 + [s / 2] * 5:
            if kind == "grousers":
                lean = leans(p, s, h, start, rng)
            else:
                lean = float(theta_d_two_contacts(p=p, theta_s=slope, w_n=w_n, **KENAF))
            extra.append(lean + rng.normal(0.0, READ))
        rows.append({"nosing_spacing": p, "angle": slope, "results": "h" * 10, "extra": extra,
                     "belt_set": True})  # fmt: skip
    read = {"grouser_height": h + rng.normal(0.0, 2e-4), "grouser_spacing": s + rng.normal(0, 1e-4)}
    return RigSheet(robot="kenaf", mass=20.0, trials=tuple(rows), **read)


def test_both_kinds_are_told_apart_in_nine_of_ten():
    right = {}
    for kind in ("grousers", "rubber"):
        found = [contrast_of(rig(kind, np.random.default_rng(seed))).cause for seed in range(25)]
        right[kind] = found.count(kind)
        other = {"grousers": "rubber", "rubber": "grousers"}[kind]
        assert other not in found  # what is not told apart is said to be open
    assert sum(right.values()) >= 45, right


def test_contrast_by_hand():
    # 0.02 rad at 150 and 0.06 at 165 mm: 165 sin(0.06) - 150 sin(0.02) = 6.894 mm
    def trials(p, extra):
        return Trials(nosing_spacing=p, angle=0.9, results="hhh", extra=extra, belt_set=True)

    sheet = RigSheet(
        robot="kenaf", mass=20.0, grouser_height=0.007, grouser_spacing=0.030,
        trials=(trials(0.150, (0.02,) * 3), trials(0.165, (0.0601, 0.06, 0.0599))),
    )  # fmt: skip
    found = contrast_of(sheet)
    assert found.rise.value == pytest.approx(6.894e-3, abs=2e-6)
    # 3 mm in step are less than half of 7, 6 mm are more; 9 mm at both are no phase

    def cause(step, off):
        each = [tuple(lean + 1e-4 * k for k in (-1, 0, 1)) for lean in (step, off)]
        rows = (trials(0.150, each[0]), trials(0.165, each[1]))
        return contrast_of(sheet.model_copy(update={"trials": rows})).cause

    assert [cause(0.02, 0.06), cause(0.04, 0.08)] == ["grousers", "both"]
    assert [cause(0.06, 0.0545), cause(0.02, 0.0394)] == ["rubber", "undecided"]
    assert contrast_of(sheet.model_copy(update={"grouser_height": None})) is None
    assert contrast_of(sheet.model_copy(update={"trials": sheet.trials[:1]})) is None


def test_which_spacings_are_in_step():
    def at(p, **more):
        return step_of(
            SimpleNamespace(nosing_spacing=p, direction="up", belt_set=True, **more), 0.03
        )

    assert (at(0.150), at(0.1485), at(0.165), at(0.157)) == ("in step", "in step", "half off", None)


def test_the_protocol_has_both_spacings_where_the_grousers_are_known():
    track = Robot.named("kenaf").track.model_copy(
        update={"belt": "grousers", "grouser_height": 0.007, "grouser_spacing": 0.030}
    )
    made = protocol_of("kenaf", Robot.named("kenaf").model_copy(update={"track": track}))
    assert "150.0 mm at 57 deg and 165.0 mm at 54 deg" in made.page  # 60.2 and 56.7 less 3
    assert made.sheet.count("belt_set = true") == 2
    assert "once the grouser spacing is measured" in protocol_of("kenaf", Robot.named("kenaf")).page


def test_closed_forms_beside_what_was_measured():
    rows = (
        Trials(nosing_spacing=0.150, angle=0.96, results="hhhhh", extra=(0.045, 0.0454, 0.0458)),
        Trials(nosing_spacing=0.150, angle=1.0, results="fffff"),
        Trials(nosing_spacing=0.150, angle=1.0, direction="down", results="hhhhh"),
        Trials(nosing_spacing=0.150, angle=1.04, direction="down", results="fffff"),
    )
    film = (Film(nosing_spacing=0.150, beyond=0.006, below=0.001),)
    sheet = RigSheet(robot="kenaf", mass=20.0, trials=rows, film=film, rear_radius=0.02)
    found = calibrate_rig(sheet)
    (at,) = found.spacings
    # theta_d = 2.6 deg gives 55.3 (docs/theory/grouser_phase.md), Eq. (24) 60.2 - 2.6 - theta_M
    assert at.phase_deg == pytest.approx(55.3, abs=0.05)
    assert at.equation_24_deg == pytest.approx(57.6 - found.theta_M_deg.value, abs=0.05)
    # by hand: lean (6.8 + 1) / 150 = 2.98 deg; atan(130.2 / 77.8) = 59.14
    assert at.film_deg == pytest.approx(56.16, abs=0.05)
    assert found.cause is None
    assert found.figures()["track.rear_radius"] == 0.02
    assert "by grouser phase" in str(found)
