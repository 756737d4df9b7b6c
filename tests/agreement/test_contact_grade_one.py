"""Grade one, no rotation, against the closed forms of docs/theory/margin.md and the kernel.

The closed forms are written out here from the paper's equations, not imported.
"""

import numpy as np
import pytest

from contact_cases import flight, stadium
from kaidan.contact import traverse
from kaidan.traversal.criterion import Tread
from kaidan.traversal.static_criterion import static_criterion

G = 9.80665
TOLERANCE = 1e-6  # rad; the brief's. The two differ by rounding of coordinates only: about 1e-13


def limit(x, C_N, a):
    return np.arccos(C_N * a / (G * np.hypot(x, C_N))) - np.arctan2(C_N, x)


def draw(rng):
    L = rng.uniform(0.3, 2.0)
    p = L / rng.uniform(2.05, 8.0)
    C_L = L * rng.uniform(0.1, 0.9)
    C_N = L * rng.uniform(0.05, 0.5)
    R = rng.choice([0.0, rng.uniform(0.001, 0.2)])
    angle = rng.uniform(0.05, 1.2)
    a = rng.choice([0.0, rng.uniform(-2, 2)])
    return L, p, C_L, C_N, R, angle, a


def nosings(angle, p, n):
    """Corners of the steps, from bottom to top."""
    points = flight(angle, p, n, 5.0, 5.0)
    return points[2::2]


@pytest.mark.parametrize("nose_up", [True, False])
def test_margins_are_the_closed_forms(nose_up):
    """2,000 random robots and stairs in all, both facings."""
    rng = np.random.default_rng(11 + nose_up)
    for _ in range(1000):
        L, p, C_L, C_N, R, angle, a = draw(rng)
        n = int(np.ceil(L / p)) + 6
        C_L = C_L if nose_up else L - C_L  # tail first: behind the tail, which is uphill
        grade = static_criterion(
            nosings(angle, p, n), Tread(L, C_L, C_N, R, R, 0.3 * L), acceleration=a
        )
        assert not grade.alone
        down, up = grade.smallest(downhill=True), grade.smallest(downhill=False)
        metres = L - p - C_L - C_N * (np.tan(angle) + a / (G * np.cos(angle)))
        front = C_L - p + C_N * (np.tan(angle) + a / (G * np.cos(angle)))
        sup = limit(L - p - C_L, C_N, a)
        inf = limit(p - C_L, C_N, a)
        if np.isfinite(sup):
            assert down.margin == pytest.approx(sup - angle, abs=TOLERANCE)
        else:  # no slope is the limit: a right angle to the side that holds
            assert down.margin == pytest.approx(np.copysign(np.pi / 2, metres))
        if np.isfinite(inf):
            assert up.margin == pytest.approx(angle - inf, abs=TOLERANCE)
        else:
            assert up.margin == pytest.approx(np.copysign(np.pi / 2, front))
        assert down.centroid == pytest.approx(metres, abs=1e-9)  # m, rounding of 5 m
        assert up.centroid == pytest.approx(front, abs=1e-9)
        assert grade.holds == (metres > 0 and front > 0)


def test_where_grade_one_holds_the_kernel_sees_no_rotation():
    """The traverse itself: on the inner flight the inclination stays the flight's."""
    rng = np.random.default_rng(8)
    held = broken = 0
    while held < 100 or broken < 100:
        L, p, C_L, C_N, R, _, a = draw(rng)
        R = max(R, 0.01)
        # dynamic effects of a on entering and landing are not asked for here
        sup, inf = limit(L - p - C_L, C_N, a), limit(p - C_L, C_N, a)
        if not (np.isfinite(sup) and np.isfinite(inf) and sup > max(inf, 0.05) + 0.1):
            continue
        n = int(np.ceil(L / p)) + 8
        for angle, holds in ((min(sup - 0.01, 1.2), True), (sup + 0.01, False)):
            if angle > 1.25 or angle < inf + 0.01 or angle < 0.03:
                continue
            terrain = flight(angle, p, n, 5.0, 5.0)
            # start on the flight: rear tip on the second nosing, well inside
            u = np.array([np.cos(angle), np.sin(angle)])
            first = np.array([p * np.cos(angle), 2 * p * np.sin(angle)])
            start = first + u * (L - C_L + 0.2 * p) + C_N * np.array([-u[1], u[0]])
            run = traverse(
                terrain,
                stadium(L, C_L, C_N, R),
                start[0],
                start[0] + 3.2 * p * u[0],
                inclination=angle,
                acceleration=a,
                with_margins=False,
            )
            inner = run.x < start[0] + 3.1 * p * u[0]
            extra = np.abs(run.inclination[inner] - angle).max()
            if holds:
                held += 1
                # rad: an end's arc is left within sqrt(2 R 2e-12) of the tip, the body turns less
                assert extra < 1e-5, (L, p, C_L, C_N, R, angle, a)
            else:
                broken += 1
                # beyond the limit it must turn, by however little
                assert extra > 1e-6, (L, p, C_L, C_N, R, angle, a)
