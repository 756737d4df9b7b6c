"""Curved flights and winders in clouds: points that were placed by hand."""

import numpy as np
import pytest

from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter
from kaidan.readers.kinds import Known, Points, Provenance
from kaidan.readers.stairfit.staircase_line import StairLine
from kaidan.readers.stairfit.turning_steps import nosing_angles

RISE, WIDE, SCATTER = 0.18, 0.9, 0.004


def cloud(parts, rng):
    floor = np.column_stack([rng.uniform(-2, 2, (4000, 2)), np.zeros(4000)])
    xyz = np.vstack([*parts, floor])
    known = Provenance("made", "", "pcd", unit=Known("m", "file"), up=Known("+z", "file"))
    return Points(xyz + rng.normal(0, SCATTER, xyz.shape), known, None, np.zeros(3))


def turning(rng, step_deg, inner, steps=14):
    """Flight about the origin: each step turns by the same angle."""
    parts, turn = [], np.radians(step_deg)
    for k in range(steps):
        a, r = rng.uniform(k * turn, (k + 1) * turn, 1500), rng.uniform(inner, inner + 1.2, 1500)
        parts.append(np.column_stack([r * np.cos(a), r * np.sin(a), np.full(1500, (k + 1) * RISE)]))
        r, up = rng.uniform(inner, inner + 1.2, 700), rng.uniform(k * RISE, (k + 1) * RISE, 700)
        parts.append(np.column_stack([r * np.cos(k * turn), r * np.sin(k * turn), up]))
    return cloud(parts, rng)


def winding(rng, going=0.25, straight=5):
    """Five straight steps, and two of 30 degrees about the left corner."""
    parts, corner = [], np.array([straight * going, WIDE])
    for k in range(straight + 2):
        x, y = k * going + going * rng.random(1500), WIDE * rng.random(1500)
        face = np.column_stack([np.full(700, k * going), WIDE * rng.random(700)])
        if k >= straight:
            angle = np.radians(30.0 * (k - straight) + 30.0 * rng.random(1500))
            r = WIDE * np.sqrt(rng.random(1500))
            x, y = corner[0] + r * np.sin(angle), corner[1] - r * np.cos(angle)
            edge = np.radians(30.0 * (k - straight))
            face = corner + WIDE * rng.random((700, 1)) * [np.sin(edge), -np.cos(edge)]
        parts.append(np.column_stack([x, y, np.full(1500, (k + 1) * RISE)]))
        parts.append(np.column_stack([face, RISE * (k + rng.random(700))]))
    return cloud(parts, rng)


def the_refusal(points):
    found = interpreter.found(points, Hints())
    assert found.staircases == ()
    return found.refusals[0]


@pytest.mark.parametrize("step_deg", [2.0, 4.0])
def test_a_curved_flight_is_refused_with_its_turn(step_deg):
    refusal = the_refusal(turning(np.random.default_rng(0), step_deg, 0.285 * 57.3 / step_deg))
    assert refusal.why == "curved"
    assert refusal.numbers["turn_deg"] == pytest.approx(13 * step_deg, rel=0.1)


def test_a_spiral_is_a_curved_flight():
    assert the_refusal(turning(np.random.default_rng(0), 22.5, 0.1)).why == "curved"


def test_winders_are_refused_with_their_angle():
    refusal = the_refusal(winding(np.random.default_rng(0)))
    assert refusal.why == "winders"
    assert refusal.numbers["turn_deg"] == pytest.approx(30.0, abs=1.0)


def before_a_low_riser(rng):
    """Faces of risers of 110, 150, 150, 150 mm, the floor before them, and a box on it."""
    s, t, z = [], [], []
    for k, (low, high) in enumerate(((0.0, 0.11), (0.11, 0.26), (0.26, 0.41), (0.41, 0.56))):
        s.append(0.3 * k + rng.normal(0, SCATTER, 800))
        t.append(rng.uniform(0.0, WIDE, 800))
        z.append(rng.uniform(low, high, 800))
    s.append(-rng.uniform(0.0, 1.0, 800))
    t.append(rng.uniform(0.0, WIDE, 800))
    z.append(rng.normal(0, SCATTER, 800))
    s.append(np.full(200, -0.4))
    t.append(rng.uniform(0.1, 0.3, 200))
    z.append(rng.uniform(0.04, 0.2, 200))
    return np.concatenate(s), np.concatenate(t), np.concatenate(z)


def test_neither_the_floor_nor_what_stands_before_it_is_the_first_riser():
    """The floor lies 40 mm higher than the regular one; a box covers three strips of ten."""
    line = StairLine(s0=0.0, z0=0.11, going=0.3, rise=0.15, first=0, last=3)
    points = before_a_low_riser(np.random.default_rng(0))
    angles = nosing_angles(line, *points, (0.0, WIDE), floor=0.0)
    assert np.degrees(angles[1:]) == pytest.approx(np.zeros(3), abs=1.0)
    assert np.isnan(angles[0]) or abs(np.degrees(angles[0])) < 5.0


def obstructed(rng, steps, hidden, turn_deg=20.0, rise=0.15, going=0.28):
    """Straight steps; before one riser stands something that is turned and hides its face."""
    parts = []
    for k in range(steps):
        x, y = going * (k + rng.random(1500)), WIDE * rng.random(1500)
        parts.append(np.column_stack([x, y, np.full(1500, (k + 1) * rise)]))
        y, up = WIDE * rng.random(700), rise * (k + rng.random(700))
        ahead = np.full(700, k * going)
        if k == hidden:
            ahead += np.tan(np.radians(turn_deg)) * (y - WIDE / 2) - 0.02
        parts.append(np.column_stack([ahead, y, up]))
    return cloud(parts, rng)


@pytest.mark.parametrize(("steps", "hidden"), [(3, 2), (3, 1), (4, 3), (7, 3)])
def test_what_stands_before_one_riser_is_no_curve(steps, hidden):
    """A leg, a bag: the refusal says how many steps it saw, and by what angle faces differ."""
    refusal = the_refusal(obstructed(np.random.default_rng(0), steps, hidden))
    assert refusal.why == "unclear"
    assert refusal.numbers["steps"] == steps
    assert refusal.numbers["turn_deg"] == pytest.approx(20.0, abs=2.0)
    assert str(refusal) == (
        f"It shows {steps} steps whose risers point up to {refusal.numbers['turn_deg']:.0f} deg "
        "apart: something stands before them, or the flight turns. Scan again with nothing in the "
        "way."
    )


@pytest.mark.parametrize("steps", [3, 4])
def test_few_steps_that_turn_evenly_are_a_curved_flight(steps):
    """By hand: 5 degrees from step to step, its goings 285 mm along the inner side."""
    refusal = the_refusal(turning(np.random.default_rng(0), 5.0, 3.27, steps=steps))
    assert refusal.why == "curved"
    assert refusal.numbers["turn_deg"] == pytest.approx(5.0 * (steps - 1), rel=0.1)
