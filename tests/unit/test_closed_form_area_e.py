"""Area E: where only an acceleration that follows the position holds the robot."""

from math import cos, radians, sin

import numpy as np
import pytest

from closed_form_cases import BARE, C_L, C_N, GRIP, G, L, assess, flight, kenaf
from kaidan import Question, Robot
from kaidan.models.acceleration import plan_acceleration
from kaidan.models.closed_form import judge


def controlled(**limits):
    drive = {"max_speed": 0.5, "max_acceleration": 3.0, "max_deceleration": 3.0} | limits
    sheet = Robot.named("kenaf").model_dump()
    return Robot.model_validate(sheet | {"drive": {"acceleration_control": True} | drive})


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("angle", [47, 52, 57])
def test_area_e_is_unsure_with_a_plan_that_holds(angle, direction):
    question = {"friction": GRIP, "direction": direction, **BARE}
    question |= {"facing": "nose-first" if direction == "up" else "tail-first"}
    stairs = flight(angle, 0.200)
    assert assess("kenaf", stairs, **question).verdict == "no-go"
    answer = assess(controlled(), stairs, **question)
    assert (answer.verdict, answer.closed_form.area) == ("unsure", "E")
    assert answer.margin_deg <= 0
    beyond = 1e-9 - answer.margin_deg
    assert answer.reason == (
        "It holds only while the acceleration follows the position (area E); at a constant one it "
        f"tips over its downhill end, {beyond:.1f} deg beyond the limit."
    )
    assert answer.falls_over is None
    # the plan, followed step by step with limits written out again
    asked = Question.of(controlled(), stairs, **question)
    basis = judge(asked).basis
    plan = plan_acceleration(asked, basis.at, basis.step, v_min=0.025)
    theta, p, spans = radians(angle), 0.200, 10
    position, energy = 0.0, plan.v[0] ** 2 / 2
    cells = len(plan.a) // spans
    width = np.tile(np.diff(_edges(p, direction)), spans)
    assert len(width) == len(plan.a) == cells * spans
    for a, w, v in zip(plan.a, width, plan.v[1:], strict=True):
        for inside in (1e-6, 0.5, 1 - 1e-6):
            travelled = (position + inside * w) % p
            d = travelled if direction == "up" else p - travelled
            under = [d + k * p for k in range(4) if d + k * p < L - 1e-12]
            upward = a if direction == "up" else -a
            upper = G * ((under[-1] - C_L) / C_N * cos(theta) - sin(theta))
            lower = G * ((under[0] - C_L) / C_N * cos(theta) - sin(theta))
            assert lower - 1e-6 <= upward <= min(upper, G * (3 * cos(theta) - sin(theta))) + 1e-6
        assert -3.0 - 1e-12 <= a <= 3.0 + 1e-12
        position, energy = position + w, energy + a * w
        assert energy == pytest.approx(v**2 / 2, abs=1e-12)
        assert 0.025 - 1e-9 <= v <= 0.5 + 1e-9
    assert position == pytest.approx(spans * p, abs=1e-12)


def _edges(p, direction):
    """Edges of the cells: 200 over a spacing, one of them where the lowest contact leaves."""
    d_C = L - 2 * p
    before = round(200 * d_C / p)
    edges = np.concatenate(
        [np.linspace(0, d_C, before + 1)[:before], np.linspace(d_C, p, 201 - before)]
    )
    return edges if direction == "up" else p - edges[::-1]


def test_area_e_at_the_other_end():
    # at 220 mm and 18 deg the nose drops between two nosings unless it speeds up there
    assert kenaf(18, 0.220, **BARE).verdict == "no-go"
    answer = assess(controlled(), flight(18, 0.220), friction=GRIP, **BARE)
    assert (answer.verdict, answer.governs) == ("unsure", "tip_uphill")
    assert answer.closed_form.area == "E"
    assert "at a constant one it tips over its uphill end, 0.7 deg beyond" in answer.reason


def test_no_area_e_without_control_speed_or_strength():
    question = {"friction": GRIP, **BARE}
    stairs = flight(52, 0.200)
    for robot_without in (
        controlled(acceleration_control=False),
        controlled(max_speed=None),
        controlled(max_speed=0.05),
        controlled(max_deceleration=0.05),
    ):
        answer = assess(robot_without, stairs, **question)
        assert (answer.verdict, answer.closed_form.area) == ("no-go", "B")
    # docs/theory/plane.md: beyond atan((L - p/2 - C_L) / C_N) = 67.8 deg no flight can be taken
    for angle in (68, 75, 80):
        assert assess(controlled(max_speed=9.0), flight(angle, 0.2), **question).verdict == "no-go"


def test_no_area_e_by_a_running_start():
    # hand: at 62 deg it must slow down by up to 0.62 m/s^2 over the first 9.5 mm of every 150 mm,
    # 2.9 mm^2/s^2 in energy, and may gain 0.001 m/s^2 x 140 mm = 0.14: a run of 0.3 m/s would
    # last for ten spacings, but not for ever
    slow_to_gain = controlled(max_speed=3.0, max_acceleration=0.001)
    answer = assess(slow_to_gain, flight(62, 0.150), friction=GRIP, **BARE)
    assert answer.closed_form.a_max == pytest.approx(-0.62, abs=0.005)
    assert answer.verdict == "no-go"
    assert assess(controlled(), flight(62, 0.150), friction=GRIP, **BARE).verdict == "unsure"


def test_no_area_e_by_running_faster_and_faster():
    # likewise at 220 mm and 10 deg, where it must speed up at the end of every spacing
    slow_to_lose = controlled(max_speed=3.0, max_deceleration=0.001)
    answer = assess(slow_to_lose, flight(10, 0.220), friction=GRIP, **BARE)
    assert answer.closed_form.a_min == pytest.approx(1.56, abs=0.005)
    assert answer.verdict == "no-go"
    assert assess(controlled(), flight(10, 0.220), friction=GRIP, **BARE).verdict == "unsure"


def test_no_area_e_at_a_creep():
    # a plan keeps to 5 % of the largest speed: at rest nothing follows a position
    asked = {"friction": GRIP, **BARE}
    for speed, verdict in ((0.02, "no-go"), (0.05, "unsure"), (0.3, "unsure")):
        assert assess(controlled(), flight(48, 0.200), speed=speed, **asked).verdict == verdict


def test_no_area_e_for_uncertain_inputs():
    # a plan holds for one set of figures
    sheet = controlled().model_dump() | {"uncertainty": {"com_from_front": 1e-4}}
    doubt = Robot.model_validate(sheet)
    question = {"friction": GRIP, **BARE}
    assert assess(doubt, flight(52, 0.200), **question).verdict == "no-go"


def test_no_area_e_where_it_slips():
    # a running start could coast up a short flight: the paper's area A all the same, so NO-GO
    answer = assess(controlled(max_speed=5.0), flight(30, 0.15), friction=0.57, **BARE)
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")
    assert answer.closed_form.area == "A"


def test_area_e_takes_a_drive_that_can_follow_the_plan():
    # hand: 20 kg at 52 deg take 154.6 N to hold; what is left of 155.5 N gives 0.05 m/s^2, over
    # 183 mm 0.0086 m^2/s^2 a spacing; the braking from 1.43 m/s^2 to none over 17 mm costs 0.0121
    def pulling(force):
        sheet = controlled(max_traction=force).model_dump() | {"mass": 20.0}
        robot = Robot.model_validate(sheet)
        return assess(robot, flight(52, 0.2), friction=GRIP, **BARE).verdict

    assert 20 * G * sin(radians(52)) == pytest.approx(154.6, abs=0.05)
    assert [pulling(force) for force in (400.0, 157.0, 155.5)] == ["unsure", "unsure", "no-go"]


def test_no_area_e_past_the_drives_traction():
    tracks = {"mass": 20.0, "drive": {"max_traction": 100.0, "max_speed": 2.0}}
    tracks["drive"]["acceleration_control"] = True
    weak = Robot.model_validate(Robot.named("kenaf").model_dump() | tracks)
    answer = assess(weak, flight(52, 0.2), friction=GRIP, **BARE)
    assert answer.verdict == "no-go"
