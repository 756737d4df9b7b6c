import numpy as np
import pytest
from scipy.optimize import brentq, linprog

from formulas.cones import cone_margin
from formulas.grousers import (
    face_friction,
    phases_friction,
    roll_off_length,
    roll_off_sine,
    standing_friction,
    tip_tilt,
)
from formulas.grousers_at_edges import edge_tilt, reach_over_edge, tip_overlap
from kaidan.mechanics.grousers import slip_height, standing_run
from kaidan.mechanics.grousers_in_turn import height_behind, reach_beside
from kaidan.mechanics.rubber import height_lost, rubber_modulus

SLOPES = np.radians([25.0, 32.5, 45.0, 60.0])


@pytest.mark.parametrize("theta", SLOPES)
@pytest.mark.parametrize("curvature", [0.0, 10.0])
def test_tip_tilt_by_coordinates(theta, curvature):
    # oracle: distance of a point of the round from the belt's line or circle
    r, beta = 0.02, np.linspace(0.01, theta - 0.01, 7)
    round_ = r * np.stack([-np.sin(beta), np.cos(beta)])
    normal = np.array([-np.sin(theta), np.cos(theta)])
    if curvature == 0.0:
        h = r - normal @ round_
    else:
        centre = (r + 1 / curvature) * normal
        h = np.hypot(*(round_ - centre[:, None])) - 1 / curvature
    assert tip_tilt(theta=theta, h=h, r=r, curvature=curvature) == pytest.approx(beta, abs=1e-9)


def above(x, z, r):
    """Distance of a point from a step: the tread z = 0, the face x = 0 and the round between."""
    if x >= r:
        return z
    return -x if z <= -r else np.hypot(x - r, z + r) - r


def apart(theta, h, r, R, off):
    """How far apart two tips are that touch the step, of a belt so far off its nosing [m]."""
    n, t = np.array([-np.sin(theta), np.cos(theta)]), np.array([np.cos(theta), np.sin(theta)])
    centre = np.array([r, -r])

    def gap(along, side):
        if R is None:
            return above(*(centre + (r + off - h) * n + side * along * t), r)
        turn = side * along / R
        radial = -np.cos(turn) * n + np.sin(turn) * t
        return above(*(centre + (R + r + off) * n + (R + h) * radial), r)

    most = 0.5 if R is None else 1.5 * R
    return sum(brentq(gap, 0.0, most, args=(side,)) for side in (1, -1))


@pytest.mark.parametrize("theta", np.radians([20.0, 37.8, 55.0, 71.0, 86.6]))
@pytest.mark.parametrize(("h", "s", "w"), [(0.010, 0.035, 0.0105), (0.018, 0.030, 0.004)])
@pytest.mark.parametrize("r", [0.0, 0.002, 0.0217])
def test_a_grouser_lands_where_the_one_before_it_still_lies_by_coordinates(theta, h, s, w, r):
    # oracle: of a belt so far off that one tip lands, both touch a tread, a face or a round
    height = float(height_behind(theta=theta, h=h, s=s, r=r, w=w))
    at_once = apart(theta, h, r, None, 0.0)
    if at_once <= s - w:
        assert height == h
    else:
        assert apart(theta, h, r, None, h - height) == pytest.approx(s - w, abs=1e-7)


@pytest.mark.parametrize("theta", np.radians([20.0, 37.8, 71.0, 86.6]))
@pytest.mark.parametrize("R", [0.03, 0.09, 1000.0])
def test_round_an_end_a_grouser_stands_no_higher_than_by_coordinates(theta, R):
    # oracle: the axle farther off the nosing by what the one before keeps it off
    h, s, r, w = 0.012, 0.030, 0.02, 0.004
    height = float(height_behind(theta=theta, h=h, s=s, r=r, w=w, curvature=1 / R))
    off = 0.0
    if apart(theta, h, r, R, 0.0) > s - w:
        off = brentq(lambda off: apart(theta, h, r, R, off) - (s - w), 0.0, h - 1e-9)
    assert height <= h - off + 1e-7
    if R == 1000.0:
        straight = height_behind(theta=theta, h=h, s=s, r=r, w=w)
        assert height == pytest.approx(float(straight), abs=1e-5)


def test_a_tip_lies_beside_its_nosing_by_hand():
    # hand: 3-4-5; the plane beyond the round; a circle of 50 about an axle 60 over one of 10
    assert reach_beside(b=0.002, r=0.010, lean=1.2) == pytest.approx(0.006)
    assert reach_beside(b=0.003, r=0.0, lean=np.arctan(0.75)) == pytest.approx(0.004)
    at_end = reach_beside(b=0.0, r=0.010, lean=1.0, curvature=20.0)
    assert at_end == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("theta", SLOPES)
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("lean", [0.3, 1.0])
def test_standing_friction_by_bisection(theta, share, lean):
    # oracle
    beta = theta * (1 - lean)

    def missing(phi):
        stands = np.tan(theta - beta + phi)
        return share * stands + (1 - share) * np.tan(phi) - np.tan(theta)

    top = min(theta, np.pi / 2 - theta + beta - 1e-9)
    phi = 0.0 if missing(0.0) >= 0 else brentq(missing, 0.0, top)
    found = standing_friction(theta=theta, beta=beta, share=share)
    assert found == pytest.approx(np.tan(phi), abs=1e-9)


def test_standing_friction_in_its_limits():
    # limit
    assert standing_friction(theta=0.6, beta=0.6, share=0.7) == pytest.approx(np.tan(0.6))
    assert standing_friction(theta=0.6, beta=0.0, share=1.0) == 0.0
    assert phases_friction(theta=0.6, q=0.0) == pytest.approx(np.tan(0.6))
    assert phases_friction(theta=0.6, q=1e-9) == pytest.approx(np.tan(0.6), abs=1e-8)


@pytest.mark.parametrize("theta", SLOPES)
@pytest.mark.parametrize("h", [0.002, 0.008, 0.03])
def test_roll_off_ends_where_the_belt_touches_or_on_the_face(theta, h):
    # oracle: the edge of a tip that runs along the round, step by step
    r = 0.02
    beta = np.linspace(theta, np.pi / 2, 100_001)
    depth, along = r * (1 - np.cos(beta - theta)), r * np.sin(beta - theta)
    reached = along[depth <= h].max()
    assert roll_off_length(theta=theta, h=h, r=r) == pytest.approx(reached, abs=1e-6)


def test_a_run_is_what_the_spacing_leaves():
    # hand: reach 0.012 on a sharp nosing, and 0.010 / 2 where that is all that the spacing leaves
    h = height_behind(theta=np.pi / 4, h=0.012, s=np.array([0.040, 0.014]), r=0.0, w=0.004)
    assert standing_run(theta=np.pi / 4, h=h, r=0.0) == pytest.approx([0.012, 0.005])
    assert roll_off_sine(run=0.004, off=0.010, r=0.010) == pytest.approx(0.3)
    assert roll_off_sine(run=0.012, off=0.010, r=0.010) == 0.0


@pytest.mark.parametrize(("R", "h", "s"), [(0.09, 0.012, 0.04), (0.03, 0.02, 0.08)])
def test_a_tip_passes_an_edge_up_to_the_reach(R, h, s):
    # oracle: the farthest point of belt and tips below the edge
    for lift in np.linspace(0.0, 0.99 * (R + h), 60):
        angle = np.arcsin(lift / (R + h))
        lower = (R + h) * np.cos(angle - s / R)
        passes = (R + h) * np.cos(angle) - max(R, lower)
        assert tip_overlap(R=R, h=h, s=s, lift=lift) == pytest.approx(passes, abs=1e-12)
        assert (passes > 0) == (lift < reach_over_edge(R=R, h=h, s=s))


def test_an_overlap_of_the_radius_reaches_the_tread():
    # limit
    assert edge_tilt(overlap=0.01, r=0.01) == 0.0
    assert edge_tilt(overlap=0.0, r=0.01) == pytest.approx(np.pi / 2)


def test_slip_height_on_a_flight():
    # hand
    theta = np.radians(37.8)
    height = slip_height(psi=theta, s=0.02, mu_k=0.3, mu_required=np.tan(theta))
    assert height == pytest.approx(0.02 * (np.sin(theta) - 0.3 * np.cos(theta)))
    assert slip_height(psi=theta, s=0.02, mu_k=0.9, mu_required=np.tan(theta)) == 0.0


def test_hard_rubber_loses_no_height_and_soft_no_more_than_all():
    # limit
    load = {"N": 100.0, "T": 100.0, "h": 0.012, "w": 0.008, "b": 0.1}
    assert height_lost(**load, E=1e12) == pytest.approx(0.0, abs=1e-8)
    assert height_lost(**load, E=1e3) == 0.012
    assert rubber_modulus(S=40.0) < rubber_modulus(S=80.0)


def held(case, angle):
    """Whether a linear programme finds forces within cones narrower by an angle."""
    columns = []
    for x, z, alpha, phi in case["contacts"]:
        for side in (1, -1):
            edge = alpha + side * (phi - angle)
            f_x, f_z = np.sin(edge), np.cos(edge)
            columns.append((f_x, f_z, x * f_z - z * f_x))
    found = linprog(
        np.zeros(len(columns)), A_eq=np.array(columns).T, b_eq=[*case["W"], 0.0], method="highs"
    )
    return found.status == 0


def test_cones_by_a_linear_programme():
    # oracle
    rng = np.random.default_rng(7)
    decided = 0
    for _ in range(60):
        contacts = [
            (
                rng.uniform(-0.6, -0.1),
                rng.uniform(-0.4, 0.0),
                *rng.uniform([-1.2, 0.1], [0.8, 1.0]),
            ),
            (rng.uniform(0.1, 0.6), rng.uniform(-0.3, 0.1), *rng.uniform([-1.2, 0.1], [0.8, 1.0])),
        ]
        case = {"contacts": contacts, "W": (rng.uniform(-0.2, 0.2), 1.0)}
        (x_1, z_1, a_1, p_1), (x_2, z_2, a_2, p_2) = contacts
        found = float(
            cone_margin(
                x_1=x_1, z_1=z_1, alpha_1=a_1, phi_1=p_1, x_2=x_2, z_2=z_2, alpha_2=a_2, phi_2=p_2,
                W_x=case["W"][0], W_z=case["W"][1],
            )
        )  # fmt: skip
        if not np.isfinite(found):
            continue
        decided += 1
        widest = max(p_1, p_2) - np.pi / 2
        if found - 1e-4 > widest:
            assert held(case, found - 1e-4)
        if found + 1e-4 < min(p_1, p_2):
            assert not held(case, found + 1e-4)
    assert decided > 20


def test_at_a_face_grousers_round_a_small_end_hold_less():
    """Twice as far out as the belt, a quarter; nothing of it on the flat, or without any."""
    assert face_friction(mu=0.8, h=0.03, curvature=1 / 0.03) == pytest.approx(0.2)
    assert face_friction(mu=0.8, h=0.0, curvature=1 / 0.03) == 0.8
    assert face_friction(mu=0.8, h=0.03, curvature=0.0) == 0.8
