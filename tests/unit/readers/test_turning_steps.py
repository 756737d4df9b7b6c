"""Curved flights and winders in clouds: points that were placed by hand."""

import numpy as np
import pytest

from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter
from kaidan.readers.kinds import Known, Points, Provenance

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


def test_a_spiral_is_no_straight_flight():
    assert the_refusal(turning(np.random.default_rng(0), 22.5, 0.1)).why == "none"


def test_winders_are_refused_with_their_angle():
    refusal = the_refusal(winding(np.random.default_rng(0)))
    assert refusal.why == "winders"
    assert refusal.numbers["turn_deg"] == pytest.approx(30.0, abs=1.0)
