"""Where a tip of a grouser stands and which supports it helps, by the formulas and by geometry."""

import math
from dataclasses import replace

import numpy as np
import pytest

from formulas import grousers, grousers_at_edges
from kaidan.contact.kernel.cones import cone_margin
from kaidan.contact.kernel.grip import (
    MANY,
    RESERVE,
    belt_margins,
    carry,
    friction_at,
    is_in_doubt,
    lag,
    margin_of_several,
    margin_standing,
    pushed_normal,
    standing_margins,
    tilt_run_back,
    tip_at,
    with_reserve,
)
from kaidan.contact.layout import (
    FACE,
    NOSING,
    NOWHERE,
    TREAD,
    Cone,
    Friction,
    Grousers,
    Load,
    Support,
    Tip,
)
from kaidan.mechanics import grousers_in_turn
from kaidan.mechanics.grousers import standing_run

ROUNDING = 1e-12
G = 9.8
SLOPE = 0.5


def support(where, **other):
    one = Support(
        is_one=True, x=where.real, z=where.imag, normal=-SLOPE, place=NOSING, point=3, tread=0.0,
        curvature=0.0, lift=math.nan, beyond=0.0, flat=0.0, beside=math.inf,
    )  # fmt: skip
    return replace(one, **other)


def none(**other):
    """A slot without support, whatever is written there."""
    return Support(**dict.fromkeys(Support.__slots__, 0) | {"is_one": False} | other)


def loads(x=0.0, z=G, coulomb=SLOPE, count=1):
    return [Load(x, z, coulomb) for _ in range(count)]


def mirrored(one):
    return replace(one, x=-one.x, normal=-one.normal, tread=-one.tread)


def carries(rows, i, j, load):
    return carry(rows[i], rows[j], (i, j) == (0, 1), load)


@pytest.mark.parametrize("x", [0.0, 3.0, -4.0])
def test_two_supports_carry_on_either_side_of_the_line_of_the_load(x):
    """The line runs through the centroid along the load; a third of three on its line counts."""
    along, across = complex(x, G), complex(G, -x)
    places = [(-0.5, 0.02), (1.0, -0.03), (2.0, 0.01), (-1.5, -0.01)]
    rows = [*(support(0.003 * c * across + u * along) for c, u in places), none()]
    (load,) = loads(x)
    pairs = {(i, j): carries(rows, i, j, load) for j in range(5) for i in range(j)}
    apart = {(0, 1), (0, 2), (1, 3), (2, 3)}
    assert {pair for pair, does in pairs.items() if does} == apart
    ahead = [support(0.01 * k * across) for k in (1.0, 2.0, 3.0)]
    assert carries(ahead, 0, 1, load)  # the outer two, wherever they are
    assert not carries(ahead, 1, 2, load)


def test_a_support_in_the_line_of_the_load_carries_with_any_other():
    rows = [support(c) for c in (0.1 + 0j, 0.2 + 0j, -0.3j)]
    assert carries(rows, 0, 2, *loads())
    assert carries(rows, 1, 2, *loads())


def test_each_place_has_its_friction():
    rows = [support(0j, place=p, curvature=12.0) for p in (NOSING, TREAD, FACE)]
    friction = Friction(0.7, 0.6, 0.5)
    found = [friction_at(row, friction, height) for row in rows for height in (0.0, 0.01)]
    assert found[:5] == [0.7, 0.7, 0.6, 0.6, 0.5]
    left = grousers.face_friction(mu=math.tan(0.5), h=0.01, curvature=12.0)
    assert found[5] == pytest.approx(math.atan(left), abs=ROUNDING)


# --- where a tip stands -------------------------------------------------------------------------

H, S, W, RN = 0.012, 0.045, 0.004, 0.01
RIGID, SOFT = Grousers(H, S, W, RN, True), Grousers(H, S, W, RN, False)


def both_ways(row, *how):
    """A tip going up, and that it is the mirror image going down."""
    up = tip_at(row, row.normal, Grousers(*how), 1.0)
    down = tip_at(mirrored(row), -row.normal, Grousers(*how), -1.0)
    assert down == pytest.approx(up._replace(tilt=-up.tilt), abs=ROUNDING)
    return up


@pytest.mark.parametrize("rigid", [True, False])
@pytest.mark.parametrize("curvature", [0.0, 0.6, 8.0])
@pytest.mark.parametrize("lean", [0.35, 0.6, 1.1])
@pytest.mark.parametrize(
    ("s", "w", "r"), [(S, W, RN), (0.024, 0.001, RN), (S, W, 0.002), (0.06, W, 0.05)]
)
def test_a_tip_stands_behind_its_nosing(lean, curvature, rigid, s, w, r):
    row = support(0.2j, normal=0.1 - lean, tread=0.1, curvature=curvature)
    stands, tilt, run, off, ahead = both_ways(row, H, s, w, r, rigid)
    h = H
    if rigid:  # the one before it is not yet clear
        behind = grousers_in_turn.height_behind(theta=lean, h=H, s=s, r=r, w=w, curvature=curvature)
        h = float(behind)
    beta = float(grousers.tip_tilt(theta=lean, h=h, r=r, curvature=curvature))
    length = float(standing_run(theta=lean, h=h, r=r))
    if rigid and curvature > 0.0:
        length = float(grousers_at_edges.end_run(theta=lean, h=h, r=r, curvature=curvature))
    assert stands
    assert tilt == pytest.approx(0.1 - beta, abs=ROUNDING)
    assert run == pytest.approx(length, abs=ROUNDING)
    rolls = float(grousers.roll_off_length(theta=lean, h=h, r=r))
    assert off == pytest.approx(rolls, abs=ROUNDING)
    assert ahead == pytest.approx(length + r * math.sin(lean - beta), abs=ROUNDING)


@pytest.mark.parametrize("change", [
    {"is_one": False}, {"point": NOWHERE}, {"tread": -0.4}, {"tread": -0.5}, {"tread": math.nan},
])  # fmt: skip
def test_no_tip_stands(change):
    """But one that runs over a nosing under a belt that does not lean rolls off it."""
    row = support(0.2j, normal=-0.4, **{"tread": 0.2} | change)
    off = 0.0
    if change.get("tread", math.nan) <= -0.4:
        off = float(grousers.roll_off_length(theta=1e-6, h=H, r=RN))
    found = tip_at(row, -0.4, SOFT, 1.0)
    assert found == (False, 0.0, 0.0, pytest.approx(off), 0.0)
    whole = support(0.2j, normal=-0.4, tread=0.2)
    assert both_ways(whole, H, S, W, RN, False)[0]
    assert not both_ways(whole, 0.0, S, W, RN, False)[0]
    upright = support(0.2j, normal=-1.6, tread=0.2)  # leans by more than a quarter of a turn
    assert not tip_at(upright, -1.6, SOFT, 1.0).stands
    at_face = support(0.2j, normal=0.3, tread=0.1, curvature=10.0, lift=0.0)
    found = tip_at(at_face, 0.3, RIGID, 1.0)
    assert found == (False, 0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("lift", [-0.06, -0.02, 0.0, 0.03])
@pytest.mark.parametrize("radius", [0.05, 0.12])
@pytest.mark.parametrize("normal", [-1.4, -0.4])
def test_a_tip_stands_over_the_edge_of_a_face(normal, radius, lift):
    """The robot stands on its grousers: its axle is higher by one than the rigid outline's."""
    row = support(0.2j, normal=normal, tread=0.1, curvature=1.0 / radius, lift=lift + H)
    found = both_ways(row, H, S, W, RN, True)
    if lift > grousers_at_edges.reach_over_edge(R=radius, h=H, s=S):
        assert found == (False, 0.0, 0.0, 0.0, 0.0)
        return
    overlap = grousers_at_edges.tip_overlap(R=radius, h=H, s=S, lift=lift)
    over = float(grousers_at_edges.edge_tilt(overlap=overlap, r=RN))
    assert found == pytest.approx((True, 0.1 - over, 0.0, 0.0, 0.0), abs=ROUNDING)


# --- what two supports hold with a tip ----------------------------------------------------------

NOSINGS, TREADS, FACES = 0.7, 0.6, 0.4
ONE, OTHER = 0.25 - 0.05j, -0.2 - 0.3j
BELTS = Friction(NOSINGS, TREADS, FACES)
TIP = Tip(True, -0.15, 0.006, 0.08, 0.011)
NO_TIP = Tip(False, 0.0, 0.0, 0.0, 0.0)


def held(one, other, tip, *, rigid, place=NOSING, point=3, side=1.0, gamma=0.0):
    rows = [support(one), support(other, place=place, point=point, curvature=9.0)]
    if side < 0:
        rows, tip = list(map(mirrored, rows)), tip._replace(tilt=-tip.tilt)
    rolls = NO_TIP._replace(off=tip.run + 2 * RN * gamma)
    return standing(rows, tip, rolls, rigid, side)


def standing(rows, tip, rolls, rigid, side=1.0):
    """Margin of two supports where the belts rest on them, a grouser standing at the first."""
    how = BELTS, RIGID if rigid else SOFT, side
    return margin_standing(*rows, *(one.normal for one in rows), *loads(), tip, rolls, *how)


def cones(one, tilt, phi_one, other, axis, phi):
    of_one, of_other = (
        Cone(one.real, one.imag, tilt, phi_one),
        Cone(other.real, other.imag, axis, phi),
    )
    return cone_margin(of_one, of_other, 0.0, G)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(("one", "other"), [(ONE, OTHER), (OTHER, ONE)])
@pytest.mark.parametrize("place", [NOSING, TREAD, FACE])
def test_a_soft_tip_tilts_the_cone_of_its_support(one, other, place, side):
    phi = {NOSING: NOSINGS, TREAD: TREADS, FACE: FACES}[place]
    expected = cones(one, TIP[1], TREADS, other, -SLOPE, phi)
    found = held(one, other, TIP, rigid=False, place=place, side=side)
    assert found == pytest.approx(expected, abs=1e-9)
    assert held(one, other, TIP._replace(stands=False), rigid=False, side=side) == -math.inf


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(("one", "other"), [(ONE, OTHER), (OTHER, ONE)])
@pytest.mark.parametrize(("place", "point"), [(NOSING, 3), (NOSING, NOWHERE), (FACE, 3)])
@pytest.mark.parametrize("gamma", [0.0, 0.03, 0.3, 1.2])
def test_a_rigid_tip_stands_ahead_and_the_other_support_rolls(
    one, other, place, point, gamma, side
):
    """The worse of two times, as the other nosing's tip rolls off or the own one has climbed.

    Whichever part of the way is the other's: the best of three.
    """
    belt = np.exp(1j * SLOPE)  # uphill, along the belt
    stands = one + (TIP[4] * belt if one == ONE else 0.0)
    phi = FACES if place == FACE else NOSINGS
    found = held(one, other, TIP, rigid=True, place=place, point=point, side=side, gamma=gamma)
    if place != NOSING or point == NOWHERE:  # nothing there to roll off
        expected = cones(stands, TIP[1], TREADS, other, -SLOPE, phi)
        assert found == pytest.approx(expected, abs=1e-9)
        return
    axis = -SLOPE - H / abs(one - other)  # the belt rests on a tip there, and is turned by it
    either = []
    for share in (0.0, 1.0, 2.0):  # what the other has rolled off; the own one climbs the rest
        upright = math.pi / 2 + axis  # no farther than onto the face
        rolled = axis - min(math.asin(min(share * gamma, 1.0)), upright)
        left = math.sin(TIP[1] + SLOPE) - (2.0 - share) * gamma
        later = -SLOPE + math.asin(max(left, 0.0))
        first = cones(stands, TIP[1], TREADS, other, rolled, phi)
        either.append(min(first, cones(stands, later, TREADS, other, axis, phi)))
    assert found == pytest.approx(max(either), abs=1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(
    ("one", "other", "own", "its", "tread", "tilt", "gamma"),
    [
        (0.11 - 0.27j, -0.37 - 0.39j, -0.98, -1.28, 0.06, -0.39, 0.54),
        (-0.25 + 0.04j, 0.25 - 0.07j, -1.15, -1.30, 0.15, -0.46, 0.25),
        (0.02 - 0.14j, -0.33 + 0.09j, -0.69, -0.01, 0.16, 0.1, 0.59),
    ],
)
def test_a_tip_rolls_no_farther_than_onto_the_face(one, other, own, its, tread, tilt, gamma, side):
    """The face is square to the tread; each of these is held the better for it, or the worse."""
    rows = [support(one, normal=own), support(other, normal=its, tread=tread)]
    tip, rolls = Tip(True, side * tilt, 0.006, 0.08, 0.011), 0.006 + 2 * RN * gamma
    if side < 0.0:
        rows = list(map(mirrored, rows))
    # the belt passes the own support no more slowly: the tip does not run back
    back = run_back(rows, tip, side)
    found = standing(rows, tip, NO_TIP._replace(off=rolls), True, side)
    if math.isnan(back):
        assert found == -math.inf
        return
    stands = one + (tip[4] * np.exp(-1j * own) if one.real > other.real else 0.0)
    axis, face = its - H / abs(one - other), tread - math.pi / 2
    either = []
    for share in (0.0, 1.0, 2.0):
        rolled = max(axis - math.asin(min(share * gamma, 1.0)), min(face, axis))
        left = max(math.sin(side * back - own) - (2.0 - share) * gamma, 0.0)
        first = cones(stands, side * back, TREADS, other, rolled, NOSINGS)
        then = cones(stands, own + math.asin(left), TREADS, other, axis, NOSINGS)
        either.append(min(first, then))
    assert found == pytest.approx(max(either), abs=1e-9)


# --- how far grousers push an end back ----------------------------------------------------------

RADIUS = 0.08


def centre_of(lean, beyond, h, r, other):
    """Of an end before and after, from its sharp nosing, as both supports stand off."""
    before = complex(beyond, 0.0) + RADIUS * np.exp(1j * (math.pi / 2 + lean))
    leans = lean, other
    off = [h - r * (math.sin(each) + math.cos(each) - 1.0) for each in leans]
    normals = [[-math.sin(each), math.cos(each)] for each in leans]
    return before, before + complex(*np.linalg.solve(normals, off))


@pytest.mark.parametrize(("place", "lean", "beyond"), [
    (NOSING, 0.3, 0.0), (NOSING, 0.6, 0.0), (TREAD, 0.0, 0.004), (TREAD, 0.0, 0.05),
])  # fmt: skip
@pytest.mark.parametrize("other", [math.pi / 2, 1.1, 0.4])
@pytest.mark.parametrize("r", [0.0, 0.02])
def test_grousers_at_another_support_push_an_end_back(place, lean, beyond, other, r):
    """The normal at a nosing's round is the line from its middle to that of the end."""
    tread = 0.05
    row = support(
        ONE,
        place=place,
        normal=tread - lean,
        tread=tread,
        curvature=1.0 / RADIUS,
        beyond=beyond,
        flat=math.nan,
    )
    face = support(OTHER, normal=tread - other, place=FACE)
    found = pushed_normal(row, face, H, r, 1.0)
    before, after = centre_of(lean, beyond, H, r, other)
    line = after - complex(r, -r)
    expected = max(lean, math.atan2(-line.real, line.imag)) if other > lean else lean
    assert found == pytest.approx(tread - expected, abs=1e-9)
    assert abs(after - before) < 2 * H
    assert pushed_normal(row, face, 0.0, r, 1.0) == tread - lean
    assert pushed_normal(row, face, H, r, -1.0) == tread - lean
    row.flat = tread - lean - 0.01  # no farther back than onto the flat
    most = min(expected, lean + 0.01)
    assert pushed_normal(row, face, H, r, 1.0) == pytest.approx(tread - most, abs=1e-9)


@pytest.mark.parametrize("change", [
    {"curvature": 0.0}, {"place": FACE}, {"tread": math.nan}, {"normal": -1.5}
])  # fmt: skip
def test_what_is_not_pushed(change):
    row = support(ONE, **{"curvature": 1.0 / RADIUS, "flat": math.nan} | change)
    face = support(OTHER, normal=-1.5, place=FACE)
    assert pushed_normal(row, face, H, 0.02, 1.0) == row.normal


def test_no_tip_stands_on_a_tread_but_where_its_end_is_pushed_onto_the_round():
    row = support(ONE, place=TREAD, normal=0.0, tread=0.0, curvature=1.0 / RADIUS)
    assert tip_at(row, 0.0, RIGID, 1.0) == NO_TIP
    assert tip_at(row, -0.3, RIGID, 1.0).stands


def test_the_normals_of_ends_that_are_pushed_back_count():
    """The rear end on the tread just behind its nosing, the front end on a face."""
    rear, front = -0.4 - 0.3j, 0.3 + 0.1j
    rows = [
        support(rear, place=TREAD, normal=0.0, tread=0.0, curvature=1.0 / RADIUS, flat=math.nan,
                beyond=0.004),
        support(front, place=FACE, normal=-math.pi / 2, tread=math.nan, curvature=12.0,
                flat=math.nan),
    ]  # fmt: skip
    pushed = pushed_normal(*rows, H, RN, 1.0)
    assert pushed < -0.1
    found, alike = np.empty(2), Friction(0.7, 0.7, 0.7)
    standing_margins(rows, 2, loads(), [0], alike, RIGID, 1.0, found)
    tip = tip_at(rows[0], pushed, RIGID, 1.0)
    normals = pushed, -math.pi / 2
    held = margin_standing(*rows, *normals, *loads(), tip, NO_TIP, alike, RIGID, 1.0)
    assert found[0] == pytest.approx(with_reserve(held, 0.7), abs=1e-9)
    # of the third of three poses too, between others: one stands on one support, one on none
    three = [none(), none(), support(0.2 + 0.1j, normal=0.3), none(), *rows, none(), none()]
    several = np.empty(8)
    standing_margins(three, 2, loads(count=4), range(4), alike, RIGID, 1.0, several)
    assert several.tolist() == [*[-math.inf] * 4, *found, *[-math.inf] * 2]
    # soft grousers push nothing: the tip would stand on a level tread
    standing_margins(rows, 2, loads(), [0], alike, SOFT, 1.0, found)
    assert found[0] == -math.inf


# --- how far a tip runs back --------------------------------------------------------------------


@pytest.mark.parametrize("own", [-0.3, -1.2, 0.4])
@pytest.mark.parametrize("other", [-1.5, -0.6, 0.0])
def test_belts_pass_two_supports_as_a_small_step_along_the_path_moves_them(own, other):
    """A step that leaves both on their tangents, by three equations: no meeting point is needed."""
    rows = support(ONE, normal=own), support(OTHER, normal=other)
    equations, tangents = [], []
    for place, normal in ((ONE, own), (OTHER, other)):
        n, t = np.exp(1j * (math.pi / 2 - normal)), np.exp(-1j * normal)
        equations.append([n.real, n.imag, (n.conjugate() * 1j * place).real])
        tangents.append([t.real, t.imag, (t.conjugate() * 1j * place).real])
    step = np.linalg.solve([*equations, tangents[1]], [0.0, 0.0, 1.0])  # the other moves by 1
    expected = 1.0 - float(np.dot(tangents[0], step))
    assert lag(*rows, own, other) == pytest.approx(expected, abs=1e-9)
    of_formula = grousers.belt_lag(
        d_x=(ONE - OTHER).real, d_z=(ONE - OTHER).imag, own=own, other=other
    )
    assert of_formula == pytest.approx(expected, abs=1e-9)


def test_a_support_that_the_other_rotates_about_helps_nothing():
    rows = support(0.3j, normal=0.0), support(0j, normal=-0.5)
    assert lag(*rows, 0.0, -0.5) == math.inf


def run_back(rows, tip, side):
    """Tilt under a tip of the first of two that the belt takes back by its lag."""
    own, its = (one.normal for one in rows)
    return tilt_run_back(S * lag(*rows, own, its), own, tip, RN, side)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("other", [-SLOPE, -0.75, -1.0, -1.5])
def test_a_tip_runs_back_over_the_tread_and_the_round(other, side):
    """By what a spacing of the belt takes it back, along the belt from where it came to stand."""
    rows = [support(ONE), support(OTHER, normal=other)]
    if side < 0:
        rows = list(map(mirrored, rows))
    run, tilt = 0.001, -0.15
    found = run_back(rows, Tip(True, side * tilt, run, 0.0, 0.0), side)
    if side < 0:
        assert found == -tilt
        return
    left = RN * math.sin(tilt + SLOPE) - max(S * lag(*rows, -SLOPE, other) - run, 0.0)
    if left <= 0.0:
        assert math.isnan(found)
    else:
        assert RN * math.sin(found + SLOPE) == pytest.approx(left, abs=ROUNDING)
    held = standing(rows, Tip(True, tilt, run, 0.0, 0.0), NO_TIP, False)
    expected = -math.inf if left <= 0.0 else cones(ONE, found, TREADS, OTHER, other, NOSINGS)
    assert held == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("lean", [-0.2, 0.2, 0.45, 0.8])
@pytest.mark.parametrize("several", [3, 5])
def test_on_several_supports_a_soft_tip_bears_its_part(several, lean, side):
    """Its tilt counts between that of the belt and that of the tread."""
    row = support(0j, normal=-side * SLOPE)
    tip = Tip(True, side * (lean - SLOPE), 0.0, 0.0, 0.0)
    of, how = (row, several, SLOPE), (NOSINGS, SOFT, side)
    beta = SLOPE - min(max(lean, 0.0), SLOPE)
    needed = grousers.standing_friction(theta=SLOPE, beta=beta, share=1.0 / several)
    found = margin_of_several(*of, tip, *how)
    assert found == pytest.approx(NOSINGS - math.atan(needed), abs=ROUNDING)
    assert margin_of_several(*of, tip._replace(stands=False), *how) == -math.inf


@pytest.mark.parametrize(("several", "part"), [(3, 1.0), (4, MANY)])
@pytest.mark.parametrize("run", [-0.01, 0.006, 0.02])
def test_on_several_supports_rigid_tips_hold_in_the_mean(several, part, run):
    tip = Tip(True, -0.1, run, 0.0, 0.0)
    found = margin_of_several(support(0j), several, SLOPE, tip, NOSINGS, RIGID, 1.0)
    needed = grousers.phases_friction(theta=SLOPE, q=part * max(run, 0.0) / S)
    assert found == pytest.approx(NOSINGS - math.atan(needed), abs=ROUNDING)


def test_of_poses_on_one_friction_each_has_its_margin():
    """Of five poses the second repeats the first one, and the fourth has an end at a face."""
    rows = [support(ONE), support(OTHER)] * 5
    rows[7] = support(OTHER, place=FACE, curvature=10.0)
    rows[9] = none(place=FACE)
    load = [Load(0.0, G, coulomb) for coulomb in (0.5, 9.0, 0.3, 0.2, 0.1)]
    found = np.empty(5)
    belt_margins(rows, 2, load, [0, 0, 2, 3, 4], Friction(0.7, 0.7, 0.7), 0.01, found)
    left = math.atan(grousers.face_friction(mu=math.tan(0.7), h=0.01, curvature=10.0))
    at_face = min(0.5, cones(ONE, -SLOPE, 0.7, OTHER, -SLOPE, left))
    assert found == pytest.approx([0.2, 0.2, 0.4, at_face, 0.6], abs=1e-9)


def test_no_margin_where_no_support_has_a_pair():
    found = np.zeros(2)
    rows, alike = [support(ONE, tread=0.1), none()], Friction(0.7, 0.7, 0.7)
    standing_margins(rows, 2, loads(), [0], alike, SOFT, 1.0, found)
    assert found.tolist() == [-math.inf, -math.inf]


def test_of_three_supports_the_better_pair_holds_the_belts():
    """The third lies on the side of the first one, on a tread that leans less."""
    third = 0.3 + 0.1j
    one = [support(ONE), support(OTHER), support(third, normal=-0.2, place=TREAD)]
    rows, load, found = one * 2, loads(count=2), np.empty(2)
    load[1].coulomb = 0.4  # unlike the first
    belt_margins(rows, 3, load, [0, 1], Friction(0.6, 0.7, 0.5), 0.0, found)
    outer = cones(ONE, -SLOPE, 0.6, OTHER, -SLOPE, 0.6)
    better = cones(OTHER, -SLOPE, 0.6, third, -0.2, 0.7)
    assert better > outer
    assert found == pytest.approx([better, better], abs=1e-9)
    # two of the three frictions alike
    for frictions in ((0.6, 0.5, 0.5), (0.6, 0.6, 0.5)):
        belt_margins(rows, 3, load, [0, 1], Friction(*frictions), 0.0, found)
        pairs = (ONE, -SLOPE, 0.6), (third, -0.2, frictions[1])
        each = [cones(OTHER, -SLOPE, 0.6, *pair) for pair in pairs]
        assert found == pytest.approx([max(each)] * 2, abs=1e-9)


@pytest.mark.parametrize("rigid", [True, False])
def test_of_all_pairs_that_carry_the_least_counts(rigid):
    """With a support among them, or else with the better of the two; poses one after the other."""
    rng = np.random.default_rng(4)
    slots, phi = 5, 0.9
    how, alike = RIGID if rigid else SOFT, Friction(phi, phi, phi)
    rows = [none() for _ in range(3 * slots)]
    for pose, first in enumerate(range(0, 3 * slots, slots)):
        # the third one on the side of the first, so that these two do not carry
        for slot, along in enumerate((0.3, -0.2, 0.2, -0.1)):
            u = along + rng.uniform(-0.05, 0.05)
            place = u * np.exp(1j * SLOPE) - 0.1j * np.exp(1j * SLOPE)
            rows[first + slot] = support(place, tread=0.05 * slot - 0.02 * pose)
            rows[first + slot].normal += rng.uniform(-0.1, 0.1)
    load = loads(coulomb=-9.0, count=3)  # all share: no bound
    found = np.empty(len(rows))
    standing_margins(rows, slots, load, range(3), alike, how, 1.0, found)
    for first in range(0, 3 * slots, slots):
        own = rows[first : first + 4]
        normals = [one.normal for one in own]
        tips = [tip_at(one, one.normal, how, 1.0) for one in own]
        pairs = [(i, j) for j in range(4) for i in range(j) if carries(own, i, j, load[0])]
        assert (0, 2) not in pairs
        assert (1, 2) in pairs
        with_tip = {
            (one, other): margin_standing(
                own[one], own[other], normals[one], normals[other], load[0], tips[one],
                tips[other], alike, how, 1.0,
            )
            for pair in pairs for one, other in (pair, pair[::-1])
        }  # fmt: skip
        for slot in range(4):
            expected = min(
                with_tip[slot, i + j - slot] if slot in (i, j)
                else max(with_tip[i, j], with_tip[j, i])
                for i, j in pairs
            )  # fmt: skip
            all_of_them = margin_of_several(own[slot], 4, -9.0, tips[slot], phi, how, 1.0)
            assert found[first + slot] == min(expected, all_of_them)
        assert found[first + 4] == -math.inf


@pytest.mark.parametrize("rigid", [True, False])
def test_ends_are_pushed_pair_by_pair(rigid):
    """Two supports behind and a face ahead; soft grousers push nothing."""
    how, alike = RIGID if rigid else SOFT, Friction(0.9, 0.9, 0.9)
    ends = {"flat": math.nan, "beyond": 0.004}
    rows = [
        support(-0.2 - 0.2j, normal=-0.6, tread=0.0, curvature=1.0 / RADIUS, **ends),
        support(0.3 + 0.1j, place=FACE, normal=-1.3, tread=math.nan, curvature=3.0, **ends),
        support(-0.4 - 0.3j, normal=-0.2, tread=0.0, curvature=1.0 / RADIUS, **ends),
    ]
    for h in (H, 1.0):
        assert pushed_normal(rows[2], rows[1], h, RN, 1.0) < -0.25
    load, pushing, found = loads(coulomb=-9.0), H if rigid else 0.0, np.empty(3)
    standing_margins(rows, 3, load, [0], alike, how, 1.0, found)
    with_tip = {}
    for i, j in ((0, 1), (1, 2)):
        assert carries(rows, i, j, *load)
        normals = {
            one: pushed_normal(rows[one], rows[other], pushing, RN, 1.0)
            for one, other in ((i, j), (j, i))
        }  # fmt: skip
        tips = {one: tip_at(rows[one], normals[one], how, 1.0) for one in (i, j)}
        for one, other in ((i, j), (j, i)):
            with_tip[one, other] = margin_standing(
                rows[one], rows[other], normals[one], normals[other], *load, tips[one],
                tips[other], alike, how, 1.0,
            )  # fmt: skip
    better = {pair: max(with_tip[pair], with_tip[pair[::-1]]) for pair in ((0, 1), (1, 2))}
    expected = [
        min(with_tip[0, 1], better[1, 2]), min(with_tip[1, 0], with_tip[1, 2]),
        min(with_tip[2, 1], better[0, 1]),
    ]  # fmt: skip
    assert not carries(rows, 0, 2, *load)
    for slot in range(3):
        tip = tip_at(rows[slot], rows[slot].normal, how, 1.0)
        of_all = margin_of_several(rows[slot], 3, -9.0, tip, 0.9, how, 1.0)
        held = min(expected[slot], of_all)
        assert found[slot] == (with_reserve(held, 0.9) if rigid else held)
    assert math.isfinite(found[2])


# --- ends, belts beside each other, and what is left in doubt -----------------------------------


@pytest.mark.parametrize("rigid", [True, False])
@pytest.mark.parametrize("place", [FACE, NOSING])
def test_a_tip_of_an_end_runs_farther_back_and_is_pushed_by_others_at_a_face(place, rigid):
    """Round an end it is faster than the belt by h/R; at a face each comes round and pushes by h.

    Both normals lie in one direction, so that no belt lags; nothing rolls off.
    """
    radius, small = 0.09, 0.02
    rows = [
        support(ONE, curvature=1.0 / radius),
        support(OTHER, place=place, point=NOWHERE, curvature=1.0 / small),
    ]
    tilt, run = -0.15, 0.004
    back = S * H / radius - run if rigid else -run
    if rigid and place == FACE:
        assert 0.5 * S / small > math.acos(small / (small + H))  # tips so far apart push by all
        back += H
    left = RN * math.sin(tilt + SLOPE) - max(back, 0.0)
    own = math.asin(left / RN) - SLOPE if left > 0.0 else math.nan
    held = standing(rows, Tip(True, tilt, run, 0.0, 0.0), NO_TIP, rigid)
    phi = FACES if place == FACE else NOSINGS
    expected = -math.inf if left <= 0.0 else cones(ONE, own, TREADS, OTHER, -SLOPE, phi)
    assert held == pytest.approx(expected, abs=1e-9)
    assert (left <= 0.0) == (rigid and place == FACE)  # there it runs off


def test_one_that_lags_rolls_off_its_nosing_while_the_other_stands():
    """All along its lag, though the own tip stands on the tread for longer than it rolls."""
    rear, front, own, its = -0.15 - 0.31j, 0.45 + 0.11j, -1.27, -0.8
    rows = [support(rear, normal=own), support(front, normal=its, tread=0.0)]
    behind = S * lag(*rows[::-1], its, own)
    assert 0.0 < behind < RN
    held = standing(rows, Tip(True, 0.0, 0.2, 0.0, 0.0), NO_TIP._replace(off=0.02), True)
    axis = its - H / abs(rear - front)
    turned = max(axis - math.asin(behind / RN), -math.pi / 2)
    stands = cones(rear, 0.0, TREADS, front, axis, NOSINGS)
    rolled = cones(rear, 0.0, TREADS, front, turned, NOSINGS)
    assert rolled < stands
    assert held == pytest.approx(rolled, abs=1e-9)


@pytest.mark.parametrize("rigid", [True, False])
@pytest.mark.parametrize("gap", [0.5 * H, 1.5 * H])
@pytest.mark.parametrize("point", [NOWHERE, 5])
def test_where_an_end_and_a_flat_pass_one_nosing_no_tip_holds_alone(point, gap, rigid):
    """If tips reach over the gap between them, and no tip can hold at the other support."""
    rows = [support(ONE, beside=gap), support(OTHER, point=point, tread=0.0)]
    held = standing(rows, Tip(True, -0.1, 0.2, 0.0, 0.0), NO_TIP, rigid)
    assert math.isfinite(held) != (rigid and gap < H and point == NOWHERE)


def test_an_end_at_a_face_is_in_doubt_while_another_stands_behind_a_nosing():
    rear = support(ONE, place=TREAD, curvature=10.0)
    face = support(OTHER, place=FACE, curvature=12.0)
    assert is_in_doubt([rear, face])
    assert is_in_doubt([face, none(), rear])
    for change in ({"place": FACE}, {"curvature": 0.0}, {"point": NOWHERE}):
        assert not is_in_doubt([replace(rear, **change), face])
    for change in ({"place": NOSING}, {"curvature": 0.0}, {"is_one": False}):
        assert not is_in_doubt([rear, replace(face, **change)])


def test_a_reserve_is_a_friction_so_much_larger():
    """Of 0.5 required and 0.8 there are 0.65 and 0.8; what needs none keeps its margin."""
    assert RESERVE == 1.3
    phi = math.atan(0.8)
    found = with_reserve(phi - math.atan(0.5), phi)
    assert found == pytest.approx(phi - math.atan(0.65), abs=ROUNDING)
    assert with_reserve(phi, phi) == phi
    assert with_reserve(-math.inf, phi) == -math.inf
