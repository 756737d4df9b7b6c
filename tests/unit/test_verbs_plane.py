"""`kaidan plane`: limits, areas, states, and the plan through area E."""

import json
import math

import jsonschema
import numpy as np
import pytest
from typer.testing import CliRunner

from amounts import fast_and_slow
from kaidan.assessment import assess
from kaidan.cli import app
from kaidan.figures.d_a_figure import d_a_figure
from kaidan.mechanics.plane import Area
from kaidan.models.closed_form import judge
from kaidan.models.closed_form_figures import Pose
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.acceleration_plan import least_speed_limit
from kaidan.verbs.d_a_plane import Plane, d_a_plane
from kaidan.verbs.plane_areas import limits_of

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
    question = Question.of(robot, flight(angle, p), **(BARE | options))
    return d_a_plane(question, accelerate=accelerate)


def limits(angle, p, friction=math.nan, **options):
    """Limits on a flight, to be asked about single points."""
    question = Question.of("kenaf", flight(angle, p), **(BARE | options))
    return limits_of(Pose.of(judge(question).basis), friction)


def array(column):
    return np.array(column, dtype=float)


def run(*arguments):
    return CliRunner().invoke(app, ["plane", *arguments])


def test_limits_by_hand():
    # hand, Kenaf at (200 mm, 44 deg), mu 2: contacts at d + 400 mm, after d = 70 mm at d + 200 mm
    found = plane(44, 0.2, friction=2.0)
    cos, sin = math.cos(math.radians(44)), math.sin(math.radians(44))
    d, lower, upper = (array(found.curves.__dict__[name]) for name in ("d_m", "a_rn", "a_r0"))
    assert found.states[2].from_m == pytest.approx(0.07, abs=1e-12)
    after = int(np.flatnonzero(np.diff(d) == 0)[0]) + 1
    assert d[after] == d[after - 1]  # state C, before and after

    def r0(s):
        return G * ((s - 0.196) / 0.071 * cos - sin)

    assert upper[0] == pytest.approx(r0(0.4), abs=1e-9)  # rounding, here and below
    assert upper[after - 1] == pytest.approx(r0(0.47), abs=1e-9)
    assert upper[after] == pytest.approx(r0(0.27), abs=1e-9)
    assert upper[-1] == pytest.approx(r0(0.4), abs=1e-9)
    assert found.min_a_r0 == upper[after] == pytest.approx(upper.min(), abs=1e-12)
    assert lower[0] == pytest.approx(-G * (0.196 / 0.071 * cos + sin), abs=1e-9)
    assert found.max_a_rn == pytest.approx(-G * (-0.004 / 0.071 * cos + sin), abs=1e-9)
    assert lower[-1] == pytest.approx(found.max_a_rn, abs=1e-9)
    assert found.a_S == pytest.approx(G * (2 * cos - sin), abs=1e-9)
    assert found.a_slides_up == pytest.approx(-G * (2 * cos + sin), abs=1e-9)
    assert [each.state for each in found.states] == ["A", "B", "C", "D"]
    assert [each.contacts for each in found.states] == [3, 3, 2, 2]


def test_allowances_shift_the_dotted_limits_by_their_angle():
    # derived: a robot tilted by theta_d + theta_M (nose up) or theta_d (nose down)
    given = {"theta_d": math.radians(2), "theta_M": (math.radians(1), math.radians(3))}
    found = plane(40, 0.2, **given)
    found, bare = found.curves, plane(40, 0.2).curves
    steeper, gentler = plane(45, 0.2).curves, plane(38, 0.2).curves
    assert found.a_r0_safe == pytest.approx(steeper.a_r0, abs=1e-9)
    assert found.a_rn_safe == pytest.approx(gentler.a_rn, abs=1e-9)
    assert found.a_r0 == pytest.approx(bare.a_r0, abs=1e-12)


def test_limits_agree_with_assess():
    stairs, asked = flight(44, 0.2), {"friction": 1.2, "direction": "down"}
    found = d_a_plane(Question.of("kenaf", stairs, **asked))
    answer = assess("kenaf", stairs, model="closed-form", facing="nose-first", **asked).closed_form
    assert found.a_S == pytest.approx(answer.a_slides_down, abs=1e-12)
    assert found.a_slides_up == pytest.approx(answer.a_slides_up, abs=1e-12)
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
    at = limits(angle, p, **options)
    drawn = [
        (region.area, region.d_m, *(np.clip(np.nan_to_num(array(curve), nan=end), -99, 99)
                                    for curve, end in ((region.low, -99), (region.high, 99))))
        for region in found.regions
    ]  # fmt: skip
    rng = np.random.default_rng(7)
    reach = np.where(np.arange(2000) % 2, 40, 3)
    for d, a in zip(rng.uniform(0, p, 2000), reach * rng.uniform(-1, 1, 2000), strict=True):
        if abs(d - at.d_C) < 1e-3:
            continue
        inside = [
            area
            for area, places, low, high in drawn
            if np.interp(d, places, low) < a < np.interp(d, places, high)
        ]
        assert inside == [at.area_at(d, a).name]


def test_one_acceleration_goes_through_areas_in_turn():
    # hand: a_r0(d) = 0 at d = C_L + C_N tan(48 deg) - 200 mm = 74.85 mm
    stays = plane(48, 0.2, friction=2.0).areas
    assert [stay.area for stay in stays] == ["E", "B", "E"]
    crossing = 0.196 + 0.071 * math.tan(math.radians(48)) - 0.2
    assert [stay.to_m for stay in stays] == pytest.approx([0.07, crossing, 0.2], abs=1e-9)
    assert [stay.area for stay in plane(40, 0.2, friction=2.0).areas] == ["D"]
    assert [stay.area for stay in plane(40, 0.2, friction=0.5).areas] == ["A"]
    assert plane(10, 0.2, friction=2.0, acceleration=-9.0).areas[-1].area == "C"


def test_state_c_counts_as_detached():
    found = limits(44, 0.2, 2.0)
    assert found.area_at(found.d_C, found.min_a_r0 + 1e-6) is Area.B
    assert found.area_at(found.d_C - 1e-9, found.min_a_r0 + 1e-6) is Area.E


def test_unknown_friction_bounds_nothing():
    found = plane(40, 0.2)
    assert found.a_S is found.a_slides_up is found.friction is None
    shown = {region.area for region in found.regions if _has_room(region)}
    assert shown == {region.area for region in found.regions} == {"B", "C", "D", "E"}


def _has_room(region):
    ends = [np.nan_to_num(array(curve), nan=end)
            for curve, end in ((region.low, -np.inf), (region.high, np.inf))]  # fmt: skip
    return bool(np.any(ends[1] > ends[0]))


def test_an_answer_read_back_is_equal_and_fits_its_schema():
    for found in (
        plane(48, 0.2, controlled(), accelerate=True, friction=2.0),
        plane(44, 0.2),
        d_a_plane(Question.of("kenaf", "ibc"), accelerate=True),
    ):
        assert Plane.from_json(found.to_json()) == found
        jsonschema.validate(found.to_dict(), Plane.json_schema())


def test_a_plan_keeps_to_its_band_and_to_mechanics():
    found = plane(48, 0.2, controlled(), accelerate=True, friction=2.0)
    plan = found.plan
    assert plan.found
    assert plan.reserve > 0
    assert not plan.needless
    a, v, path = array(plan.a_along_path), array(plan.speed), array(plan.path_m)
    assert np.all(a >= array(plan.a_along_path_low) + plan.reserve - 1e-9)
    assert np.all(a <= array(plan.a_along_path_high) - plan.reserve + 1e-9)
    # kinetic energy: v^2/2 grows by a w in each cell
    assert np.diff(v**2) / 2 == pytest.approx(a * np.diff(path), abs=1e-9)
    assert v.max() <= 0.6 + 1e-12
    assert v.min() >= 0.05 * 0.6 - 1e-12  # it keeps moving
    assert path[-1] == pytest.approx(plan.nosing_spacings * 0.2, abs=1e-9)
    # inside the plane: no point of it in area A, B or C
    at = limits(48, 0.2, 2.0)
    for index in range(len(a)):
        middle = (path[index] + path[index + 1]) / 2 % 0.2
        assert at.area_at(middle, a[index]) in (Area.D, Area.E)
    assert len(a) % plan.nosing_spacings == 0


@pytest.mark.parametrize(
    ("robot", "angle", "options", "text"),
    [
        ("kenaf", 40, {}, "No plan is needed: a constant speed keeps to all limits"),
        ("kenaf", 48, {}, "No plan: the sheet of kenaf states no acceleration control"),
        (controlled(max_speed=None), 48, {}, "No plan: the sheet of kenaf states no largest speed"),
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
    assert plan.semi_stable_angle_deg == pytest.approx(math.degrees(math.atan(174 / 71)), abs=1e-9)


def test_a_plan_that_cannot_repeat_says_so():
    # a_S < 0: it can only slow down, from step to step
    plan = plane(48, 0.2, controlled(max_speed=6.0), accelerate=True, friction=0.9).plan
    assert plan.found
    assert not plan.repeats
    assert max(plan.a_along_path) < 0
    assert (
        f"It must lose speed over the whole flight and enter it at {plan.speed[0]:.2f}"
        in plan.reason
    )
    assert plane(48, 0.2, controlled(), accelerate=True, friction=2.0).plan.repeats


@pytest.mark.parametrize("angle", [44, 48, 52, 56, 60, 64])
def test_there_is_a_plan_where_assess_says_area_e(angle):
    robot = controlled()
    answer = assess(robot, flight(angle, 0.2), model="closed-form", friction=3.0, **BARE)
    plan = plane(angle, 0.2, robot, accelerate=True, friction=3.0).plan
    assert (plan.found and not plan.needless) == (answer.verdict == "unsure")


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
    assert needed is not None
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
@pytest.mark.parametrize("robot", fast_and_slow("controlled", "kenaf"))
@pytest.mark.parametrize("first", fast_and_slow(1, 5))
def test_any_plane_can_be_drawn(direction, facing, options, robot, first):
    robot = controlled() if robot == "controlled" else robot
    for angle, p in ((25, 0.47 / 3), (60, 0.2), (12, 0.1), (8, 0.2), (40, 0.23))[:first]:
        asked = {"direction": direction, "facing": facing} | options
        found = plane(angle, p, robot, True, **asked)
        assert not found.outside
        assert d_a_figure(found).axes


def test_names_stay_inside_the_picture_and_apart():
    for found in (
        plane(44, 0.2, friction=2.0),
        plane(48, 0.2, controlled(), True, friction=2.0),
        d_a_plane(Question.of("absolem", "ibc", surface="concrete-dry", flippers="flat")),
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
    from kaidan.figures.d_a_figure import _passes

    found = plane(25, 0.18, controlled(), True, friction=0.9, direction="down")
    at = limits(25, 0.18, 0.9, direction="down")
    for d, a, _ in _passes(found):
        assert d[0] == pytest.approx(0.0, abs=1e-9)
        assert d[-1] == pytest.approx(180.0, abs=1e-9)
        for index in range(len(d) - 1):
            middle = (d[index] + d[index + 1]) / 2e3
            assert at.area_at(middle, a[index]) in (Area.D, Area.E)


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
        "a = 0 m/s2 (requested): E for d = 0 to 70 mm, B for d = 70 to 75 mm, "
        "E for d = 75 to 200 mm" in page
    )
