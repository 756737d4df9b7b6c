import numpy as np
import pytest
from scipy.optimize import linprog

from kaidan.mechanics.acceleration import acceleration_plan, tip_band
from kaidan.mechanics.plane import lowest_contact
from kaidan.mechanics.tipping import a_r0, a_rn

KENAF = {"L": 0.470, "C_L": 0.196, "C_N": 0.071}


@pytest.mark.parametrize("p", [0.15, 0.2, 0.22, 0.0939])
@pytest.mark.parametrize("cells", [7, 50])
def test_tip_band_holds_everywhere_in_its_cells(p, cells):
    # oracle: a scan within every cell; 1e-9 of a cell aside of its edges, where contacts change
    pose = {"theta_s": 0.7, "C_L": KENAF["C_L"], "C_N": KENAF["C_N"], "g": 9.8}
    band = tip_band(**KENAF, p=p, theta_s=0.7, cells=cells, g=9.8)
    assert band.edges.shape == (cells + 1,)
    assert (band.edges[0], band.edges[-1]) == (0.0, p)
    for left, right, lower, upper in zip(
        band.edges[:-1], band.edges[1:], band.lower, band.upper, strict=True
    ):
        d = left + (right - left) * np.array([1e-9, 0.3, 0.7, 1.0 - 1e-9])
        safe = a_r0(s=lowest_contact(d=d, L=KENAF["L"], p=p), **pose)
        # 1e-9 of a cell of up to 30 mm is worth 5e-9 m/s^2
        assert np.min(safe) == pytest.approx(upper, abs=1e-8)
        assert np.max(a_rn(d=d, **pose)) == pytest.approx(lower, abs=1e-8)


def test_tip_band_cuts_at_the_loss_of_the_contact():
    # hand: 470 - 2 * 200 = 70 mm of 200: 35 % of the cells lie before
    band = tip_band(**KENAF, p=0.2, theta_s=0.5, cells=20)
    np.testing.assert_allclose(band.edges[:8], np.arange(8) * 0.01, rtol=0, atol=1e-15)
    np.testing.assert_allclose(band.edges[7:], np.linspace(0.07, 0.2, 14), rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("p", "before"),
    [
        (0.2349, 1),  # hand: lost after 0.2 mm: one cell all the same
        (0.1567, 9),  # hand: lost 0.1 mm before the next is met: one cell left after
        (0.235, 0),  # hand: lost as the next is met: none before
    ],
)
def test_tip_band_keeps_a_cell_on_either_side(p, before):
    band = tip_band(**KENAF, p=p, theta_s=0.5, cells=10)
    d_C = 0.47 % p if before else 0.0
    assert band.edges.shape == (11,)
    assert band.edges[before] == pytest.approx(d_C, abs=1e-12)
    assert np.all(np.diff(band.edges) > 0.0)


def test_tip_band_defaults():
    # hand: 200 cells, standard gravity: a_rn(p) = -(C_L - p)/C_N g on the level
    band = tip_band(**KENAF, p=0.2, theta_s=0.0)
    assert band.lower.shape == (200,)
    assert band.lower[-1] == pytest.approx(0.004 / 0.071 * 9.80665, abs=1e-12)


def best_reserve(lower, upper, width, v_max, v_min, v_start):
    """Largest reserve by linear programming over the energies at the edges; None without a plan."""
    n = len(width)
    rise = np.zeros((n, n + 2))
    rise[np.arange(n), np.arange(n)] = -1.0
    rise[np.arange(n), np.arange(n) + 1] = 1.0
    above, below = rise.copy(), -rise
    above[:, -1] = below[:, -1] = width
    energy = [(v_min**2 / 2, v_max**2 / 2)] * (n + 1)
    if v_start is not None:
        energy[0] = (v_start**2 / 2,) * 2
        if not v_min <= v_start <= v_max:
            return None
    result = linprog(
        [0.0] * (n + 1) + [-1.0],
        A_ub=np.vstack([above, below]),
        b_ub=np.concatenate([upper * width, -lower * width]),
        bounds=[*energy, (0.0, None)],
    )
    return -result.fun if result.success else None


def random_paths(count=150):
    rng = np.random.default_rng(7)
    for _ in range(count):
        n = rng.integers(1, 12)
        lower = rng.uniform(-4.0, 1.0, n)
        path = {
            "lower": lower,
            "upper": lower + rng.uniform(-0.1, 4.0, n),
            "width": rng.uniform(0.01, 0.1, n),
            "v_max": rng.uniform(0.2, 0.8),
            "v_min": rng.uniform(0.0, 0.15),
            "v_start": rng.choice([None, rng.uniform(0.0, 0.8)]),
        }
        yield path


def test_plans_have_the_largest_reserve_and_keep_their_limits():
    # oracle: the linear programme; bisection stops at 2**-40 of a reserve of a few m/s^2
    found = {"plan": 0, "none": 0, "start": 0}
    for path in random_paths():
        plan, best = acceleration_plan(**path), best_reserve(**path)
        width, v = path["width"], plan.v
        assert plan.a.shape == width.shape
        assert v.shape == (width.size + 1,)
        if best is None:
            found["none"] += 1
            assert np.isnan(plan.a).all()
            assert np.isnan(v).all()
            assert np.isnan(plan.reserve)
            continue
        found["plan"] += 1
        assert plan.reserve == pytest.approx(best, abs=1e-9)
        assert np.all(plan.a >= path["lower"] + plan.reserve - 1e-9)
        assert np.all(plan.a <= path["upper"] - plan.reserve + 1e-9)
        assert np.all((v >= path["v_min"] - 1e-6) & (v <= path["v_max"] + 1e-6))
        np.testing.assert_allclose(np.diff(v**2) / 2, plan.a * width, rtol=0, atol=1e-9)
        if path["v_start"] is not None:
            found["start"] += 1
            assert v[0] == pytest.approx(path["v_start"], abs=1e-12)
    assert min(found.values()) > 20


def test_gentlest_acceleration():
    # hand: -1..3 and 3..-1 keep a reserve of 2 only with a = +1 then -1; over 0.1 m that is
    # 0.1 J/kg up and down again, inside v_max = 1 m/s: E from 0 to 0.4, its middle 0.2
    one = np.ones(1)
    plan = acceleration_plan(
        lower=np.array([-1.0, -3.0]), upper=np.array([3.0, 1.0]), width=0.1 * np.ones(2), v_max=1.0
    )
    np.testing.assert_allclose(plan.a, [1.0, -1.0], rtol=0, atol=1e-12)
    assert plan.reserve == pytest.approx(2.0, abs=1e-12)
    assert plan.v[0] == pytest.approx(np.sqrt(2 * 0.2), abs=1e-12)
    # hand: one tight cell (reserve 0.5) leaves the wide ones free to do nothing
    plan = acceleration_plan(
        lower=np.array([-5.0, -0.5, -5.0]), upper=np.array([5.0, 0.5, 5.0]),
        width=0.1 * np.ones(3), v_max=1.0, v_start=0.5,
    )  # fmt: skip
    np.testing.assert_allclose(plan.a, 0.0, rtol=0, atol=1e-12)
    np.testing.assert_allclose(plan.v, 0.5, rtol=0, atol=1e-12)
    # hand: a start outside the speed limits has no plan
    for v_start in (0.05, 0.6):
        plan = acceleration_plan(
            lower=-one, upper=one, width=0.1 * one, v_max=0.5, v_min=0.1, v_start=v_start
        )
        assert np.isnan(plan.reserve)


def test_limits_themselves_are_allowed():
    # hand: zero width of band and of speed
    plan = acceleration_plan(
        lower=np.zeros(2), upper=np.zeros(2), width=np.ones(2), v_max=0.5, v_min=0.5, v_start=0.5
    )
    assert plan.reserve == 0.0
    np.testing.assert_array_equal(plan.v, 0.5)


def test_a_path_without_cells_keeps_its_speed():
    # limit
    empty = np.zeros(0)
    plan = acceleration_plan(lower=empty, upper=empty, width=empty, v_max=0.5, v_start=0.3)
    assert plan.a.shape == (0,)
    assert plan.v == pytest.approx([0.3], abs=1e-15)
    assert plan.reserve == 0.0


@pytest.mark.parametrize(
    ("short", "hopeless"),
    [
        ("lower", {}),
        ("upper", {}),
        ("width", {}),
        # an error even where the answer would be "no plan": an empty band, a start too fast
        ("lower", {"upper": -2.0 * np.ones(2)}),
        ("upper", {"upper": -2.0 * np.ones(2)}),
        ("width", {"v_start": 5.0}),
    ],
)
def test_a_path_needs_every_cell_described(short, hopeless):
    path = {"lower": -np.ones(2), "upper": np.ones(2), "width": np.ones(2), "v_max": 1.0}
    path |= hopeless
    path[short] = path[short][:1]
    with pytest.raises(ValueError, match="zip"):
        acceleration_plan(**path)
