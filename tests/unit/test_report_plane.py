"""`kaidan plane`: limits, areas, states, and the plan through area E."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

from kaidan.assessment import assess, case_of
from kaidan.cli import app
from kaidan.mechanics.plane import Area
from kaidan.report.area_e_plan import least_speed_limit
from kaidan.report.d_a_figure import d_a_figure
from kaidan.report.d_a_plane import d_a_plane
from kaidan.robot import Robot
from kaidan.stairs import Stairs

G = 9.80665
BARE = {"theta_d": 0.0, "theta_M": 0.0}


def flight(angle, p):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=p)


def controlled(**drive):
    """Kenaf with an acceleration control of ours."""
    limits = {"max_speed": 0.6, "max_acceleration": 3.0, "max_deceleration": 3.0}
    sheet = Robot.named("kenaf").model_dump()
    return Robot.model_validate(sheet | {"drive": {"acceleration_control": True} | limits | drive})


def plane(angle, p, robot="kenaf", accelerate=False, **options):
    case = case_of(robot, flight(angle, p), **(BARE | options))
    return d_a_plane(case, accelerate=accelerate)


def run(*arguments):
    return CliRunner().invoke(app, ["plane", *arguments])


def test_limits_by_hand():
    # hand, Kenaf at (200 mm, 44 deg), mu 2: contacts at d + 400 mm, after d = 70 mm at d + 200 mm
    found = plane(44, 0.2, friction=2.0)
    cos, sin = math.cos(math.radians(44)), math.sin(math.radians(44))
    assert found.d_C == pytest.approx(0.07, abs=1e-12)
    after = int(np.flatnonzero(np.diff(found.d) == 0)[0]) + 1
    assert found.d[after] == found.d[after - 1]  # state C, before and after

    def r0(s):
        return G * ((s - 0.196) / 0.071 * cos - sin)

    assert found.a_r0[0] == pytest.approx(r0(0.4), abs=1e-9)  # rounding, here and below
    assert found.a_r0[after - 1] == pytest.approx(r0(0.47), abs=1e-9)
    assert found.a_r0[after] == pytest.approx(r0(0.27), abs=1e-9)
    assert found.a_r0[-1] == pytest.approx(r0(0.4), abs=1e-9)
    assert found.min_a_r0 == found.a_r0[after] == pytest.approx(found.a_r0.min(), abs=1e-12)
    assert found.a_rn[0] == pytest.approx(-G * (0.196 / 0.071 * cos + sin), abs=1e-9)
    assert found.max_a_rn == pytest.approx(-G * (-0.004 / 0.071 * cos + sin), abs=1e-9)
    assert found.a_rn[-1] == pytest.approx(found.max_a_rn, abs=1e-9)
    assert found.a_S == pytest.approx(G * (2 * cos - sin), abs=1e-9)
    assert found.a_slip_down == pytest.approx(-G * (2 * cos + sin), abs=1e-9)
    assert [s[0] for s in found.states()] == ["A", "B", "C", "D"]
    assert [s[3] for s in found.states()] == [3, 3, 2, 2]


def test_allowances_shift_the_dotted_limits_by_their_angle():
    # derived: a robot tilted by theta_d + theta_M (nose up) or theta_d (nose down)
    given = {"theta_d": math.radians(2), "theta_M": (math.radians(1), math.radians(3))}
    found = plane(40, 0.2, **given)
    steeper, gentler = plane(45, 0.2), plane(38, 0.2)
    assert found.a_r0_safe == pytest.approx(steeper.a_r0, abs=1e-9)
    assert found.a_rn_safe == pytest.approx(gentler.a_rn, abs=1e-9)
    assert found.a_r0 == pytest.approx(plane(40, 0.2).a_r0, abs=1e-12)


def test_limits_agree_with_assess():
    stairs, asked = flight(44, 0.2), {"friction": 1.2, "direction": "down"}
    found = d_a_plane(case_of("kenaf", stairs, **asked))
    answer = assess("kenaf", stairs, model="closed-form", **asked)
    assert found.a_S == pytest.approx(answer.a_slip_up, abs=1e-12)
    assert found.a_slip_down == pytest.approx(answer.a_slip_down, abs=1e-12)
    assert found.min_a_r0 == pytest.approx(answer.a_tip_downhill, abs=1e-12)
    assert found.max_a_rn == pytest.approx(answer.a_tip_uphill, abs=1e-12)


@pytest.mark.parametrize(
    ("angle", "p", "options"),
    [
        (44, 0.2, {"friction": 2.0}),
        (44, 0.2, {"friction": 0.3}),
        (20, 0.15, {}),
        (55, 0.2, {"friction": 1.0}),
        (6, 0.22, {"friction": 0.5, "direction": "down"}),
        (30, 0.235, {"friction": 1.0}),
        (30, 0.47 / 3, {"friction": 1.0}),  # states A and C coincide
        (15, 0.22, {"friction": 0.1}),  # area C reaches above a_S, where A comes first
    ],
)
def test_drawn_areas_are_those_of_the_definition(angle, p, options):
    found = plane(angle, p, **options)
    if found.outside:  # 2 p > L by rounding
        pytest.skip(found.outside)
    rng = np.random.default_rng(7)
    reach = np.where(np.arange(2000) % 2, 40, 3)
    for d, a in zip(rng.uniform(0, p, 2000), reach * rng.uniform(-1, 1, 2000), strict=True):
        if abs(d - found.d_C) < 1e-3:
            continue
        expected = found.area_at(d, a)
        drawn = [
            region.area
            for region in found.regions()
            if np.interp(d, region.d, np.clip(region.low, -99, 99)) < a
            and a < np.interp(d, region.d, np.clip(region.high, -99, 99))
        ]
        assert drawn == [expected]


def test_one_acceleration_goes_through_areas_in_turn():
    # hand: a_r0(d) = 0 at d = C_L + C_N tan(48 deg) - 200 mm = 74.85 mm
    stays = plane(48, 0.2, friction=2.0).stays(0.0)
    assert [stay.area for stay in stays] == [Area.E, Area.B, Area.E]
    crossing = 0.196 + 0.071 * math.tan(math.radians(48)) - 0.2
    assert [stay.end for stay in stays] == pytest.approx([0.07, crossing, 0.2], abs=1e-9)
    assert [stay.area for stay in plane(40, 0.2, friction=2.0).stays(0.0)] == [Area.D]
    assert [stay.area for stay in plane(40, 0.2, friction=0.5).stays(0.0)] == [Area.A]
    assert [stay.area for stay in plane(10, 0.2, friction=2.0).stays(-9.0)][-1] is Area.C


def test_state_c_counts_as_detached():
    found = plane(44, 0.2, friction=2.0)
    assert found.area_at(found.d_C, found.min_a_r0 + 1e-6) is Area.B
    assert found.area_at(found.d_C - 1e-9, found.min_a_r0 + 1e-6) is Area.E


def test_unknown_friction_bounds_nothing():
    found = plane(40, 0.2)
    assert math.isnan(found.a_S)
    shown = {region.area for region in found.regions() if np.any(region.high > region.low)}
    assert shown == {Area.B, Area.C, Area.D, Area.E}
    assert found.as_dict()["friction"] is None


def test_a_plan_keeps_to_its_band_and_to_mechanics():
    found = plane(48, 0.2, controlled(), accelerate=True, friction=2.0)
    plan = found.plan
    assert plan.found
    assert plan.reserve > 0
    assert not plan.needless
    assert np.all(plan.a >= plan.lower + plan.reserve - 1e-9)
    assert np.all(plan.a <= plan.upper - plan.reserve + 1e-9)
    # kinetic energy: v^2/2 grows by a w in each cell
    grown = np.diff(plan.v**2) / 2
    assert grown == pytest.approx(plan.a * np.diff(plan.path), abs=1e-9)
    assert plan.v.max() <= 0.6 + 1e-12
    assert plan.v.min() >= 0.05 * 0.6 - 1e-12  # it keeps moving
    assert plan.path[-1] == pytest.approx(plan.spans * 0.2, abs=1e-9)
    # inside the plane: no point of it in area A, B or C
    cells = len(plan.a) // plan.spans
    for index in range(len(plan.a)):
        middle = (plan.path[index] + plan.path[index + 1]) / 2 % 0.2
        assert found.area_at(middle, plan.a[index]) in (Area.D, Area.E)
    assert cells * plan.spans == len(plan.a)


@pytest.mark.parametrize(
    ("robot", "angle", "options", "text"),
    [
        ("kenaf", 40, {}, "No plan is needed: a constant speed keeps to all limits"),
        ("kenaf", 48, {}, "No plan: no acceleration control is stated for kenaf"),
        (controlled(max_speed=None), 48, {}, "No plan: no largest speed is stated for kenaf"),
        (controlled(max_speed=0.02), 48, {}, "the drive's largest speed is 0.02 m/s"),
        (controlled(), 69, {}, "is beyond 67.8 deg, where the mean of a_r0"),
        (controlled(), 48, {"friction": 0.9}, "It would do with more friction."),
        (controlled(max_deceleration=0.2), 48, {}, "at some place no acceleration is allowed"),
        (controlled(max_deceleration=0.2), 48, {}, "It would do with a drive that changes"),
        (controlled(), 48, {"speed": 0.0}, "No plan from a speed of 0 m/s at the start."),
    ],
)
def test_why_there_is_no_plan(robot, angle, options, text):
    plan = plane(angle, 0.2, robot, accelerate=True, **({"friction": 2.0} | options)).plan
    assert not plan.found
    assert text in plan.reason


def test_the_limit_of_area_e_by_hand():
    # hand: atan((470 - 100 - 196) / 71) = 67.80 deg
    plan = plane(48, 0.2, accelerate=True).plan
    assert math.degrees(plan.steepest) == pytest.approx(math.degrees(math.atan(174 / 71)), abs=1e-9)


def test_a_plan_that_cannot_repeat_says_so():
    # a_S < 0: it can only slow down, from step to step
    plan = plane(48, 0.2, controlled(max_speed=6.0), accelerate=True, friction=0.9).plan
    assert plan.found
    assert not plan.repeats
    assert np.all(plan.a < 0)
    assert (
        f"It must lose speed over the whole flight and enter it at {plan.v[0]:.2f}" in plan.reason
    )
    assert plane(48, 0.2, controlled(), accelerate=True, friction=2.0).plan.repeats


@pytest.mark.parametrize("angle", [44, 48, 52, 56, 60, 64])
def test_there_is_a_plan_where_assess_says_area_e(angle):
    robot = controlled()
    answer = assess(robot, flight(angle, 0.2), model="closed-form", friction=3.0, **BARE)
    plan = plane(angle, 0.2, robot, accelerate=True, friction=3.0).plan
    assert (plan.found and not plan.needless) == (answer.verdict == "caution")


def test_the_speed_that_is_needed_by_hand():
    # hand: brake at 2 over 0.1 m, then free, then brake at 1 over 0.4 m, accelerating at most 3
    lower, upper = np.array([-9.0, -9.0, -9.0]), np.array([-2.0, 3.0, -1.0])
    width = np.array([0.1, 0.1, 0.4])
    # E must be 0.4 before the last cell; 0.1 of it can be left to the middle one (0.3)
    assert least_speed_limit(lower=lower, upper=upper, width=width) == pytest.approx(
        math.sqrt(0.8), abs=1e-12
    )
    assert math.isnan(least_speed_limit(lower=upper, upper=lower, width=width))
    climbing = np.array([1.0])
    # it cannot help but accelerate at 1 over 0.5 m from rest
    assert least_speed_limit(
        lower=climbing, upper=2 * climbing, width=np.array([0.5])
    ) == pytest.approx(1.0, abs=1e-12)


def test_the_needed_speed_is_the_threshold():
    needed = plane(48, 0.2, accelerate=True, friction=2.0).plan.needed_speed
    assert math.isfinite(needed)
    slow, fast = (
        plane(
            48,
            0.2,
            controlled(max_speed=share * needed, max_acceleration=None, max_deceleration=None),
            accelerate=True,
            friction=2.0,
        ).plan.found
        for share in (0.99, 1.01)
    )
    assert (slow, fast) == (False, True)


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("options", [{}, {"friction": 0.6}, {"friction": 2.0, "theta_d": None}])
@pytest.mark.parametrize("robot", ["kenaf", "controlled"])
def test_any_plane_can_be_drawn(direction, facing, options, robot):
    robot = controlled() if robot == "controlled" else robot
    for angle, p in ((12, 0.1), (25, 0.47 / 3), (8, 0.2), (60, 0.2), (40, 0.23)):
        asked = {"direction": direction, "facing": facing} | options
        found = plane(angle, p, robot, True, **asked)
        assert not found.outside
        assert d_a_figure(found).axes


def test_names_stay_inside_the_picture_and_apart():
    for found in (
        plane(44, 0.2, friction=2.0),
        plane(48, 0.2, controlled(), True, friction=2.0),
        d_a_plane(case_of("absolem", "ibc", surface="concrete-dry", flippers="flat")),
    ):
        figure = d_a_figure(found)
        figure.draw_without_rendering()
        boxes = [
            text.get_window_extent()
            for axes in figure.axes
            for text in axes.texts
            if text.get_text()
        ]
        for index, box in enumerate(boxes):
            assert box.x0 >= 0
            assert box.x1 <= figure.bbox.width
            assert not any(box.overlaps(other) for other in boxes[:index])


def test_descending_plans_are_drawn_where_they_happen():
    from kaidan.report.d_a_figure import _passes

    found = plane(25, 0.18, controlled(), True, friction=0.9, direction="down")
    for d, a, _ in _passes(found):
        assert d[0] == pytest.approx(0.0, abs=1e-9)
        assert d[-1] == pytest.approx(180.0, abs=1e-9)
        for index in range(len(d) - 1):
            middle = (d[index] + d[index + 1]) / 2e3
            assert found.area_at(middle, a[index]) in (Area.D, Area.E)


def test_json(tmp_path):
    figure = tmp_path / "p.svg"
    result = run("kenaf", "--angle", "44deg", "--nosing-spacing", "200mm", "--friction", "2",
                 "--json", "--figure", str(figure))  # fmt: skip
    assert result.exit_code == 0
    assert figure.read_bytes().startswith(b"<?xml")
    found = json.loads(result.stdout)
    assert found["contacts_n"] == 2
    assert found["areas"] == [{"area": "D", "from_m": 0.0, "to_m": pytest.approx(0.2, abs=1e-12)}]
    assert found["plan"] is None
    assert found["a_max"] == found["min_a_r0"] == pytest.approx(0.540, abs=5e-4)  # hand
    assert found["paper"]["a_min"] == found["max_a_rn"]
    assert len(found["curves"]["d_m"]) == len(found["curves"]["a_r0"])


def test_exit_codes(tmp_path):
    steep = ("--angle", "48deg", "--nosing-spacing", "200mm", "--friction", "2")
    assert run("kenaf", *steep).exit_code == 0
    assert run("kenaf", *steep, "--accelerate").exit_code == 1
    sheet = tmp_path / "fast.toml"
    sheet.write_text(controlled().to_toml())
    assert run(str(sheet), *steep, "--accelerate").exit_code == 0
    calm = run("kenaf", "--angle", "30deg", "--nosing-spacing", "150mm", "--accelerate")
    assert calm.exit_code == 0
    figure = tmp_path / "p.png"
    outside = run("kenaf", "ibc", "--figure", str(figure))
    assert outside.exit_code == 3
    assert "OUTSIDE THE MODEL" in outside.stdout
    assert not figure.exists()
    found = json.loads(run("kenaf", "ibc", "--accelerate", "--json").stdout)
    assert "p > L/2" in found["outside"]
    assert found["a_max"] is None
    assert found["plan"]["found"] is False


def test_the_page_for_people():
    page = run("kenaf", "--angle", "48deg", "--nosing-spacing", "200mm", "--friction", "2").stdout
    assert "stable (D): -6.92 to -0.45 m/s2 throughout" in page
    assert (
        "a = 0 m/s2 (asked): E for d = 0 to 70 mm, B for d = 70 to 75 mm, E for d = 75 to 200 mm"
        in page
    )
