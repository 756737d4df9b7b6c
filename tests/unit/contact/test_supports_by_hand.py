"""What a pose stands on, and what friction and grousers make of it, by hand and by the formulas."""

import math

import numpy as np
import pytest

from contact_cases import flight, stadium
from formulas import grousers, grousers_at_edges
from kaidan.contact import Grousers, Supports, traverse, using_kernel
from kaidan.contact.door import zeros
from kaidan.contact.kernel import grousers as kernel
from kaidan.contact.kernel.grip import belt_margins, standing_margins
from kaidan.contact.kernel.supports import find_alike
from kaidan.contact.layout import FACE, NOSING, NOWHERE, Friction, Load, Support
from kaidan.mechanics import grousers_in_turn
from kaidan.mechanics.grousers import standing_run
from kernel_memory import numbers, table

G = 9.8
HALVED = 1e-5
"""To which the kernel halves a margin [rad]."""
SLOPE, HEIGHT = math.radians(30.0), 0.1
SOFT = Grousers(height=0.01, spacing=0.04, tip_width=0.0, nosing_radius=0.0, rigid=False)
"""Tips without a radius to climb stand on the tread at once."""
SAME_FORMULA = 1e-12


def drawn(low, high, seed):
    return np.random.default_rng(seed).uniform(low, high, 2000)


def same(function, formula, **inputs):
    found = [function(*each) for each in zip(*(v.tolist() for v in inputs.values()), strict=True)]
    np.testing.assert_allclose(found, formula(**inputs), rtol=SAME_FORMULA, atol=SAME_FORMULA)


def test_tips_are_those_of_the_formulas():
    theta, share = drawn(0.01, 1.5, 0), drawn(0.0, 0.99, 1)
    h, s, r, w = (drawn(0.001, most, k) for k, most in enumerate((0.02, 0.08, 0.02, 0.02), 2))
    curvature = np.where(share < 0.5, 0.0, drawn(2.0, 30.0, 6))
    same(kernel.tip_tilt, grousers.tip_tilt, theta=theta, h=h, r=r, curvature=curvature)
    turns = {"r": r, "lean": theta, "curvature": curvature}
    same(kernel.reach_beside, grousers_in_turn.reach_beside, b=h, **turns)
    behind = {"theta": theta, "h": h, "s": s, "r": r, "w": w, "curvature": curvature}
    same(kernel.height_behind, grousers_in_turn.height_behind, **behind)
    same(kernel.roll_off_length, grousers.roll_off_length, theta=theta, h=h, r=r)
    same(kernel.standing_run, standing_run, theta=theta, h=h, r=r)
    same(kernel.roll_off_sine, grousers.roll_off_sine, run=h - 0.01, off=s, r=r)
    same(
        kernel.standing_friction, grousers.standing_friction, theta=theta, beta=theta * w / 0.02,
        share=share,
    )  # fmt: skip
    same(kernel.phases_friction, grousers.phases_friction, theta=theta, q=share)
    same(kernel.face_friction, grousers.face_friction, mu=theta, h=h, curvature=curvature)


def test_a_tip_at_every_phase_needs_no_friction():
    assert kernel.phases_friction(0.6, 1.0) == 0.0


def test_tips_over_an_edge_are_those_of_the_formulas():
    R, h, s = drawn(0.03, 0.2, 0), drawn(0.001, 0.02, 1), drawn(0.01, 0.08, 2)
    lift = R * drawn(-0.9, 0.9, 3)
    same(kernel.reach_over_edge, grousers_at_edges.reach_over_edge, R=R, h=h, s=s)
    same(kernel.tip_overlap, grousers_at_edges.tip_overlap, R=R, h=h, s=s, lift=lift)
    lean, other = R, 1.5 - R
    pushed = {"lean": lean, "other": other, "beyond": 0.0 * s, "h": h, "r": 0.5 * s}
    for share in (1.0, 0.02):  # ends of metres too
        curved = pushed | {"curvature": share / R}
        same(kernel.pushed_lean, grousers_at_edges.pushed_lean, **curved)
    edges = {"theta": lean, "h": h, "r": 0.5 * s, "curvature": 1.0 / R}
    same(kernel.end_run, grousers_at_edges.end_run, **edges)
    same(kernel.face_push, grousers_at_edges.face_push, h=h, s=s, curvature=1.0 / R)
    assert kernel.face_push(0.01, 0.04, 0.0) == 0.0
    same(kernel.edge_tilt, grousers_at_edges.edge_tilt, overlap=0.02 - h, r=0.5 * s)


def on_slope(*along, **other):
    """Supports of one pose on nosings of a slope, the centroid above its zero, treads level.

    Two rows of room are left.
    """
    slots = len(along) + 2
    found = zeros(Support, slots)
    found["point"], found["tread"], found["lift"] = NOWHERE, math.nan, math.nan
    found["beside"] = math.inf
    own = found[: len(along)]
    u = np.array(along)
    own["is_one"], own["point"], own["tread"] = True, range(len(along)), 0.0
    own["x"] = u * math.cos(SLOPE) + HEIGHT * math.sin(SLOPE)
    own["z"] = u * math.sin(SLOPE) - HEIGHT * math.cos(SLOPE)
    own["normal"], own["place"] = -SLOPE, NOSING
    for name, value in other.items():
        own[name] = value
    return found, slots


def loads(count=1):
    return [Load(0.0, G, SLOPE) for _ in range(count)]


def standing(supports, slots, phi, one, count=1, like=(0,)):
    found = np.empty(len(supports))
    of, friction = table(Support, supports), Friction(phi, phi, phi)
    standing_margins(of, slots, loads(count), like, friction, one, 1.0, found)
    return found.reshape(-1, slots)


def held(supports, slots, friction, height):
    found = [math.nan]
    of = table(Support, supports)
    belt_margins(of, slots, loads(), [0], Friction(*friction), height, found)
    return found[0]


def lever(here, there):
    """Share of the load of a contact on the slope: the gravity line meets it at -h tan(theta)."""
    return (there + HEIGHT * math.tan(SLOPE)) / (there - here)


def test_two_nosings_hold_by_the_share_of_the_one_on_which_a_grouser_stands():
    lower, upper, phi = -0.2, 0.3, 0.5
    found = standing(*on_slope(lower, upper), phi, SOFT)
    for slot, share in enumerate((lever(lower, upper), lever(upper, lower))):
        needed = grousers.standing_friction(theta=SLOPE, beta=0.0, share=share)
        assert found[0, slot] == pytest.approx(phi - math.atan(needed), abs=HALVED)


def test_no_grouser_stands_where_there_is_no_tread_or_no_grouser():
    supports, slots = on_slope(-0.2, 0.3)
    assert (standing(supports, slots, 0.5, SOFT._replace(height=0.0))[0, :2] == -math.inf).all()
    supports["point"][1] = NOWHERE
    found = standing(supports, slots, 0.5, SOFT)
    assert found[0, 0] > -math.inf
    assert found[0, 1] == -math.inf


def test_of_three_nosings_all_share_the_load():
    """The third bears no more than it has to: a third of the load on soft grousers."""
    phi = 0.5
    found = standing(*on_slope(-0.2, 0.3, 0.05), phi, SOFT)[0, :3]
    needed = grousers.standing_friction(theta=SLOPE, beta=0.0, share=1 / 3)
    of_all = phi - math.atan(needed)
    pairs = {
        k: standing(*on_slope(*each), phi, SOFT)[0, :2]
        for k, each in {(0, 1): (-0.2, 0.3), (0, 2): (-0.2, 0.05)}.items()
    }
    # the outer two; the lower one and the third, between which the gravity line passes
    lower = min(pairs[0, 1][0], pairs[0, 2][0], of_all)
    upper = min(pairs[0, 1][1], max(pairs[0, 2]), of_all)
    third = min(max(pairs[0, 1]), pairs[0, 2][1], of_all)
    assert found == pytest.approx([lower, upper, third], abs=HALVED)


@pytest.mark.parametrize(("more", "many"), [((0.05,), 1.0), ((0.05, 0.1), 0.75)])
def test_of_rigid_grousers_the_mean_over_the_phases_bounds(more, many):
    one, phi = Grousers(0.008, 0.04, 0.004, 0.0, rigid=True), 0.5
    run = standing_run(theta=SLOPE, h=0.008, r=0.0)
    needed = grousers.phases_friction(theta=SLOPE, q=many * run / 0.04)
    found = standing(*on_slope(-0.2, 0.3, *more), phi, one)
    assert found[0, : 2 + len(more)].max() == pytest.approx(phi - math.atan(needed), abs=HALVED)


def test_poses_that_stand_alike_have_the_margins_of_the_first():
    supports, slots = on_slope(-0.2, 0.3)
    three = np.concatenate([supports] * 3)
    three["x"][slots] += 1e-3
    three["point"][2 * slots] = 7  # which nosing it is plays no part
    like = np.empty(3, dtype=np.int64)
    find_alike(table(Support, three), slots, loads(3), numbers(like, int))
    assert like.tolist() == [0, 1, 0]
    found = standing(three, slots, 0.5, SOFT, 3, like)
    assert found[2].tolist() == found[0].tolist() != found[1].tolist()


def test_belts_hold_by_friction_less_slope_and_rigid_grousers_by_less_at_a_face():
    stands = on_slope(-0.2, 0.3)
    assert held(*stands, (0.7, 0.2, 0.2), 0.0) == pytest.approx(0.7 - SLOPE, abs=HALVED)
    stands = on_slope(-0.2, 0.3, place=FACE, curvature=10.0)
    for height in (0.0, 0.01):
        left = math.atan(math.tan(0.7) / (1.0 + 10.0 * height) ** 2)
        assert held(*stands, (0.1, 0.1, 0.7), height) == pytest.approx(left - SLOPE, abs=HALVED)
        # one friction everywhere: no more than smooth belts hold
        assert held(*stands, (0.7, 0.7, 0.7), height) == pytest.approx(left - SLOPE, abs=HALVED)


ROBOT = stadium(0.470, 0.196, 0.071, 0.06)
SPACING = 0.15


def supports_of(path):
    count = len(path.poses)
    return Supports(
        path, force=(np.zeros(count), np.full(count, G)), coulomb=np.full(count, SLOPE),
        treads=np.zeros(len(path.ground)), climbs=True, steep=math.radians(60.0), touch=1e-7,
    )  # fmt: skip


@pytest.fixture(scope="module")
def path():
    return traverse(flight(SLOPE, SPACING, 8), ROBOT, -0.6, 1.4)


def test_the_flat_stands_on_every_nosing_under_it(path):
    """Of 0.47 m at 0.15 m: three or four, a spacing apart."""
    supports = supports_of(path)
    within = (path.x > 0.3) & (path.x < 0.6)  # neither end of the flat over a landing
    points = supports.points[within & (np.abs(path.inclination - SLOPE) < 1e-9)]
    assert len(points) > 50
    stands = [sorted(row[row >= 0].tolist()) for row in points]
    assert {len(each) for each in stands} == {3, 4}
    for each in stands:
        x = path.ground.x[each]
        np.testing.assert_allclose(np.diff(x), SPACING * math.cos(SLOPE), atol=1e-9)


def test_more_supports_than_there_is_room_for_at_first():
    path = traverse(flight(SLOPE, 0.05, 16), ROBOT, -0.6, 1.0)
    on = (supports_of(path).points >= 0).sum(axis=1)
    assert on.max() == 10  # 0.47 / 0.05, and one more


def test_the_native_kernel_finds_the_same_as_the_plain_one(path):
    phi, one = (0.5, 0.6, 0.4), Grousers(0.01, 0.04, 0.004, 0.005, rigid=True)
    found = []
    for choice in ("plain", "auto"):
        with using_kernel(choice):
            supports = supports_of(path)
            found.append(
                (
                    supports.points,
                    supports.belt_margins(phi, 0.01),
                    supports.standing_margins(phi, one),
                    supports.standing_margins(phi, one._replace(rigid=False)),
                )
            )
    for plain, native in zip(*found, strict=True):
        np.testing.assert_array_equal(plain, native)
