"""Design: the largest worst margin, or the cheapest GO; oracles: brute force, by hand."""

import itertools
import json
import math

import numpy as np
import pytest

pytest.importorskip("scipy")

from amounts import fast_and_slow
from kaidan import InputError, Robot, Stairs, assess, design
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup
from kaidan.modes import Verdict
from kaidan.sweeps.parameters import question_of
from kaidan.verbs.design.answer import Design
from kaidan.verbs.design.postures import planned
from kaidan.verbs.design.problem import Free, Problem, free_of
from kaidan.verbs.design.search import best_of, loss_of, optimised

STEEP = Stairs(name="steep", rise=0.15, going=0.19)
LOW = Stairs(name="low", rise=0.1, going=0.3)
CENTROID = {"com_from_front": (0.1, 0.5), "com_height": (0.05, 0.4)}
CLOSED = {"model": "closed-form", "friction": 1.5, "flippers": "flat"}


def brute(problem, goal, count):
    """Smallest loss of a grid, of designs judged one by one."""
    lines = [np.linspace(each.low, each.high, count) for each in problem.free]
    apart = Problem(problem.values, problem.stairs, problem.free)
    return min(loss_of(apart.at(point), goal) for point in itertools.product(*lines))


@pytest.mark.parametrize("goal", fast_and_slow("go", "margin"))
@pytest.mark.parametrize(
    "free",
    [
        {"com_from_front": (0.1, 0.5), "com_height": (0.05, 0.3)},
        {"flat_length": (0.45, 0.9), "com_height": (0.1, 0.35)},
        {"payload.from_front": (-0.2, 0.7), "payload.height": (0.05, 0.6)},
    ],
    ids=lambda free: ",".join(free),
)
def test_no_point_of_a_brute_force_grid_is_better(goal, free):
    values = {"robot": Robot.named("absolem"), "payload": "8kg@400mm,500mm", **CLOSED}
    problem = Problem(values, [STEEP, LOW], free_of(values | {"stairs": STEEP}, free, {}))
    best = optimised(problem, goal, tries=250, seed=0)
    assert loss_of(best, goal) <= brute(problem, goal, 13) + 1e-9


def test_no_point_of_a_grid_is_better_by_the_contact_model():
    values = {"robot": Robot.named("absolem"), "flippers": "22deg,flat", "friction": 1.0}
    free = {"com_from_front": (0.1, 0.5), "com_height": (0.05, 0.3)}
    ibc = Stairs.named("ibc")
    problem = Problem(values, [ibc], free_of(values | {"stairs": ibc}, free, {}))
    best = optimised(problem, "margin", tries=150, seed=0)
    assert loss_of(best, "margin") <= brute(problem, "margin", 9) + 1e-9
    assert best.goes


def test_the_best_centroid_halves_what_the_slope_limits_leave():
    """By hand: the margin downhill grows as the centroid moves uphill and the other one shrinks, so
    the best place makes both equal; allowances subtracted as in Eq. (24)."""
    robot = Robot.named("kenaf")
    L, C_N, p = robot.track.flat_length, robot.com_height, 0.15
    stairs = Stairs.inclined(angle=math.radians(40), nosing_spacing=p)
    found = design(
        robot, stairs, free={"com_from_front": (0.05, 0.42)}, friction=5.0, model="closed-form",
        theta_d=0.03, theta_M=0.04, grid=0,
    )  # fmt: skip
    places = np.linspace(0.05, 0.42, 100_001)
    down = theta_s_sup(L=L, p=p, C_L=places, C_N=C_N, a=0.0) - stairs.angle - 0.07
    up = stairs.angle - 0.03 - theta_s_inf(p=p, C_L=places, C_N=C_N, a=0.0)
    least = np.minimum(down, up)
    # the lattice of the search is 0.1 mm, at most some hundredths of a degree of margin
    assert found.margin_deg == pytest.approx(math.degrees(least.max()), abs=0.05)
    assert found.free[0].best == pytest.approx(places[np.argmax(least)], abs=2e-3)


def test_the_cheapest_go_is_the_edge_of_the_feasible_region():
    """By hand: of one figure of which less is better the cheapest GO is where GO begins."""
    found = design("absolem", STEEP, free={"com_height": (0.05, 0.4)}, goal="go", grid=0,
                   override={"com_height": 0.35}, **CLOSED)  # fmt: skip
    (free,) = found.free
    assert (found.verdict_now, found.verdict, free.now) == ("unsure", "go", 0.35)
    at = {"robot": "absolem", "stairs": STEEP, **CLOSED}
    for height, verdict in ((free.best, "go"), (free.best + 2e-3, "unsure")):
        assert assess(question_of(at | {"com_height": height})).verdict == verdict
    assert found.cost == pytest.approx((0.35 - free.best) / 0.35)


def test_what_is_a_go_already_stays_as_it_is():
    found = design("absolem", LOW, free={"com_height": (0.05, 0.4), "com_from_front": (0.1, 0.5)},
                   goal="go", grid=5, **CLOSED)  # fmt: skip
    assert (found.verdict, found.cost) == ("go", 0.0)
    assert [each.best for each in found.free] == [each.now for each in found.free]


def test_a_weight_makes_another_change_the_cheaper_one():
    free = {"com_height": (0.05, 0.4), "flat_length": (0.4, 1.2)}
    own = {"override": {"com_height": 0.39}, "goal": "go", "grid": 0, **CLOSED}
    low = design("absolem", STEEP, free=free, weights={"flat_length": 50.0}, **own)
    long = design("absolem", STEEP, free=free, weights={"com_height": 50.0}, **own)
    assert low.verdict == long.verdict == "go"
    changes = [
        [abs(each.best - each.now) / (each.high - each.low) for each in found.free]
        for found in (low, long)
    ]
    assert changes[0][0] > changes[1][0]
    assert changes[0][1] < changes[1][1]


def test_the_map_says_what_assess_says_and_none_of_it_is_better():
    found = design("absolem", [STEEP, LOW], grid=7, tries=60,
                   free=CENTROID, **CLOSED)  # fmt: skip
    drawn = found.map
    assert (drawn.x, drawn.y, found.grid) == ("com_from_front", "com_height", 49)
    values = {"robot": "absolem", **CLOSED}
    for j, i in ((0, 0), (3, 2), (6, 6), (1, 5)):
        at = {"com_from_front": drawn.x_values[i], "com_height": drawn.y_values[j]}
        each = [assess(question_of({**values, **at, "stairs": on})) for on in (STEEP, LOW)]
        assert drawn.verdicts[j][i] == max(Verdict(one.verdict).rank for one in each)
        margins = [one.margin_deg for one in each]
        assert drawn.margins_deg[j][i] == pytest.approx(min(margins), abs=1e-9)
    best = max(
        margin
        for row, ranks in zip(drawn.margins_deg, drawn.verdicts, strict=True)
        for margin, rank in zip(row, ranks, strict=True)
        if rank == 0
    )
    assert found.verdict == "go"
    assert found.margin_deg >= best
    assert drawn.share_go == np.mean(np.array(drawn.verdicts) == 0)


def test_the_front_gains_with_every_change():
    found = design("absolem", STEEP, grid=0, front=4, tries=200,
                   free=CENTROID, **CLOSED)  # fmt: skip
    costs = [each.cost for each in found.front]
    margins = [each.margin_deg for each in found.front]
    assert len(costs) > 2
    assert costs == sorted(costs)
    assert margins == sorted(margins)
    assert costs[0] == 0.0
    assert found.front[-1].margin_deg == found.margin_deg


def test_without_flippers_designs_are_judged_in_the_plan_that_assess_finds():
    """Stowed Absolem falls on these stairs; in its plan it is a GO, and off the angles too."""
    asked = {"robot": "absolem", "stairs": "ibc", "friction": 1.0}
    now = assess(question_of(asked))
    found = design(**asked, free={"com_height": (0.1, 0.3)}, grid=0, tries=2)
    (on,) = found.on_stairs
    assert (found.verdict_now, found.margin_now_deg) == (now.verdict, now.margin_deg)
    assert (on.facing, on.flippers) == (now.plan.facing, now.question.flippers)
    assert found.margin_deg >= now.margin_deg
    assert f"{on.facing.replace('-', ' ')}; {on.flippers}" in str(found)


def test_a_better_plan_of_the_design_is_taken_over():
    """By the closed form at hand: the longer flat underside of a top-heavy robot is the better."""
    free = free_of({"robot": Robot.named("absolem"), "stairs": LOW}, {"com_height": (0.1, 0.3)}, {})
    values = {"robot": Robot.named("absolem"), "model": "closed-form", "friction": 1.5}
    stowed = Problem(values, [LOW, STEEP], free, plans=[{"flippers": "stowed"}] * 2)
    found = planned(stowed, [0.3])
    assert [len(found.plans), found.tried] == [2, {}]
    for plan, stairs in zip(found.plans, (LOW, STEEP), strict=True):
        best = assess(question_of({**values, "com_height": 0.3, "stairs": stairs}))
        assert plan["flippers"][0] == best.question.posture
    assert found.at([0.3]).merit >= stowed.at([0.3]).merit


def test_a_design_without_meaning_has_no_plan():
    """8 m behind the front of a robot of half a metre: stowed, by the same names as any plan."""
    free = free_of({"robot": Robot.named("absolem"), "stairs": LOW}, {"com_from_front": (0, 9)}, {})
    problem = Problem({"robot": Robot.named("absolem"), **CLOSED}, [LOW], free)
    (of_none,), (plan,) = (planned(problem, [at]).plans for at in (8.0, 0.25))
    assert of_none["flippers"] == "stowed"
    assert of_none.keys() == plan.keys()


def test_a_better_place_of_the_map_is_taken_over():
    """With one try the search alone comes upon less than the map does."""
    own = {"free": CENTROID, "tries": 1, **CLOSED}
    alone = design("absolem", STEEP, grid=0, **own)
    found = design("absolem", STEEP, grid=15, **own)
    margins = np.array(found.map.margins_deg, dtype=float)
    goes = np.array(found.map.verdicts) == 0
    assert found.margin_deg >= np.nanmax(margins[goes]) - 1e-9
    assert found.margin_deg > alone.margin_deg + 1.0


def test_designs_without_meaning_are_no_designs():
    found = design("absolem", LOW, free={"com_from_front": (-0.5, 3.0)}, grid=0, **CLOSED)
    assert found.verdict == "go"
    with pytest.raises(InputError, match="centroid outside the robot"):
        design("absolem", LOW, free={"com_from_front": (3.0, 4.0)}, grid=0, tries=20, **CLOSED)


@pytest.mark.parametrize(
    ("free", "others", "said"),
    [
        ({}, {}, "nothing is free"),
        ({"luck": (0, 1)}, {}, "unknown parameter 'luck'"),
        ({"flippers": (0, 1)}, {}, "flippers is no continuous figure"),
        ({"com_height": (0.1, 0.1)}, {}, "com_height = 0.1 m has no width"),
        ({"com_height": "10..20"}, {}, "has no unit"),
        ({"com_height": (0.1, 0.2)}, {"goal": "luck"}, "goal = 'luck' is not known"),
        ({"com_height": (0.1, 0.2)}, {"weights": {"mass": 1}}, "cost of 'mass': it is not free"),
        ({"com_height": (0.1, 0.2)}, {"weights": {"com_height": -1}}, "is not a number from 0 on"),
        ({"com_height": (0.1, 0.2)}, {"grid": 1}, "grid = 1 is not within 2 to 1001"),
        ({"payload.height": (0.1, 0.2)}, {"grid": 0}, "payload.height needs one payload"),
    ],
)
def test_nonsense_is_refused(free, others, said):
    with pytest.raises(InputError, match=said):
        design("absolem", LOW, free=free, tries=20, **{**CLOSED, **others})


def test_round_numbers():
    free = Free("com_height", 0.05, 0.3, "m", 0.1234567)
    assert free.step == pytest.approx(1e-4)
    assert free.rounded(0.20004) == 0.2
    assert free.rounded(0.12344) == 0.1234567  # as it stands
    assert free.rounded(0.9) == 0.3
    assert free.cost(0.1234567 + 0.025) == pytest.approx(0.1)


def test_losses_order_designs():
    values = {"robot": Robot.named("absolem"), **CLOSED}
    problem = Problem(values, [STEEP], free_of(values | {"stairs": STEEP},
                      {"com_height": (0.05, 0.4)}, {}))  # fmt: skip
    good, near, bad = (problem.at([height]) for height in (0.05, 0.2, 0.4))
    assert good.merit > near.merit > bad.merit
    assert best_of(problem, "margin") is good
    assert loss_of(good, "margin", budget=0.0) > loss_of(bad, "margin", budget=1.0)
    assert loss_of(near if near.goes else good, "go") < 0 < loss_of(bad, "go")


def test_the_command_and_its_figure(tmp_path):
    from typer.testing import CliRunner

    from kaidan.cli import app_for

    picture = tmp_path / "battery.png"
    words = ["design", "absolem", "iso-14122-3", "--model", "closed-form", "--flippers", "flat",
             "--friction", "1.2", "--payload", "5kg@200mm,300mm", "--grid", "5", "--front", "2",
             "--free", "payload.from_front=-300mm..800mm", "--free", "payload.height=50mm..600mm",
             "--cost", "payload.height=2", "--tries", "60", "--json",
             "--figure", str(picture)]  # fmt: skip
    done = CliRunner().invoke(app_for(["design"]), words)
    assert done.exit_code == 0, done.output
    answer = Design.from_json(done.stdout)
    assert json.loads(answer.to_json()) == json.loads(done.stdout)
    assert picture.read_bytes()[:4] == b"\x89PNG"
    assert "5.2 deg" in str(answer)


def test_a_figure_of_nothing_is_refused():
    from kaidan.figures.design_figure import design_figure

    found = design("absolem", LOW, free={"com_height": (0.1, 0.2)}, tries=20, **CLOSED)
    assert found.map is None
    with pytest.raises(InputError, match="nothing to draw"):
        design_figure(found)
