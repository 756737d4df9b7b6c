"""Friction, drive, obstacles and what is no answer, by hand; no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Profile, Question, Robot, Stairs
from kaidan.contact import Status
from kaidan.mechanics.oblique import equivalent_slope_across
from kaidan.models import contact_model, planned
from kaidan.models import quasi_static as module
from kaidan.models.contact_model import judge
from kaidan.models.drive_limits import steepest_for_drive, traction_limit
from kaidan.models.findings import Findings
from kaidan.models.quasi_static import (
    LONG_FLIGHT,
    Basis,
    _answered,
    _Extremes,
    _figures,
    _obstacles,
    _supply,
    drive_margin,
    driven_over,
    drives_alike,
    findings_of,
    profile_of,
    repeats,
)
from kaidan.models.spread import Spread
from kaidan.models.support_polygon import along_heading
from kaidan.modes import (
    DRIVE,
    FAILS,
    FALL_DOWNHILL,
    FALL_UPHILL,
    HIGH_CENTRING,
    LANDING_ROOM,
    OPEN,
    ROUGHLY,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    Phase,
)
from kaidan.robot import Track

G = 9.80665
KENAF = Robot.named("kenaf")


def drive(**given):
    usual = {"max_traction": None, "max_power": None, "efficiency": 0.5, "rolling_resistance": 0.0}
    return SimpleNamespace(**(usual | given))


def asked(*, speed=0.0, mass=10.0, direction="up", a=0.0, angle=0.5, belly=None, **of_drive):
    robot = SimpleNamespace(drive=drive(**of_drive), track=SimpleNamespace(belly_clearance=belly))
    return SimpleNamespace(
        robot=robot, speed=speed, direction=direction, acceleration=a, friction=(0.5, 0.8),
        stance=SimpleNamespace(mass=mass), profile=SimpleNamespace(angle=angle),
        leaves=(0.7, 0.9), landings=(), rolling_resistance=robot.drive.rolling_resistance,
    )  # fmt: skip


# drive


def test_the_traction_of_a_drive():
    """Power counts on the way up, and at a speed: 100 W and half of it lost, at 0.25 m/s."""
    assert traction_limit(asked()) is None
    assert traction_limit(asked(max_traction=150.0)) == 150.0
    both = {"max_traction": 250.0, "max_power": 100.0}
    assert traction_limit(asked(**both)) == 250.0
    assert traction_limit(asked(**both, speed=0.25)) == 200.0
    assert traction_limit(asked(**both), 0.25) == 200.0
    assert traction_limit(asked(**both, speed=0.1)) == 250.0
    assert traction_limit(asked(**both, speed=0.25, direction="down")) == 250.0
    assert traction_limit(asked(max_power=100.0, speed=0.25)) == 200.0
    assert traction_limit(asked(max_power=100.0)) is None


def test_the_slope_that_takes_all_traction():
    """F = m (a + g sin theta): 10 kg, half the weight and more for the acceleration."""
    question = asked(max_traction=5.0 * G + 20.0)
    found = steepest_for_drive(question, np.array([2.0, 2.0 + 5.0 * G / 10, 9.0, -90.0]))
    assert found == pytest.approx(
        [math.pi / 6, 0.0, -math.asin((90 - 20 - 5 * G) / (10 * G)), math.pi / 2]
    )
    assert steepest_for_drive(question, 30.0) == -math.pi / 2  # no descent gives that much
    for unknown in (asked(), asked(max_traction=50.0, mass=None)):
        assert math.isnan(steepest_for_drive(unknown, 0.0))


@pytest.mark.parametrize(
    ("required", "margin"),
    [
        (0.5, math.pi / 2 - math.pi / 6),
        (1.2, math.pi / 2 - (math.pi / 2 + 0.2)),
        (math.nan, math.nan),
    ],
)
def test_the_margin_of_the_drive(required, margin):
    """The weight as traction: upright; beyond that a radian for each weight more."""
    weight = asked(max_traction=10.0 * G)
    assert drive_margin(weight, required) == pytest.approx(margin, nan_ok=True)


def test_the_margin_of_a_drive_by_its_sheet():
    half = asked(max_traction=5.0 * G, rolling_resistance=0.1)
    assert drive_margin(half, 0.2) == pytest.approx(math.asin(0.4) - math.asin(0.2))
    assert drive_margin(asked(max_traction=1e4), 0.2) == math.pi / 2  # at most
    worn = asked(max_traction=5.0 * G, rolling_resistance=9.0)
    assert drive_margin(worn, 0.2) == pytest.approx(-math.pi / 2 - math.asin(0.2))
    assert math.isnan(drive_margin(asked(), 0.2))
    assert math.isnan(drive_margin(asked(max_traction=50.0, mass=None), 0.2))


# friction

OVER = Spread(
    *[np.zeros(2)] * 6, angle=np.array([0.0, 0.03]), inclination=np.array([0.0, 0.05]),
    landing_inclination=np.array([0.0, 0.07]), friction=np.array([0.1, -0.9]),
)  # fmt: skip


def supply(question, phase=Phase.LAND, held=None, friction=0.4):
    extremes = _Extremes(0.4, 0.5, phase, 3)
    slides, stalls = _supply(question, SimpleNamespace(), OVER, extremes, friction, held)
    assert stalls.mode is DRIVE
    return slides, stalls


def test_friction_against_what_is_required_sample_by_sample():
    """Stated 0.5 to 0.8, in doubt by 0.1 and -0.9 (none is left at the worst), steeper by 30 mrad;
    where the flight decides by 50 mrad, and over the landing by 70.
    """
    for phase, steeper in ((Phase.ENTER, 0.03), (Phase.TRAVERSE, 0.05), (Phase.LAND, 0.07)):
        slides, _ = supply(asked(), phase)
        assert (slides.mode, slides.phase, slides.step) == (SLIDES_DOWN, phase, 3)
        needed = math.atan(0.4)
        assert slides.worst == pytest.approx([math.atan(0.6) - needed, -needed - steeper])
        assert slides.best == pytest.approx([math.atan(0.9) - needed, -needed - steeper])
    _, stalls = supply(asked(max_traction=10.0 * G))
    assert stalls.worst == pytest.approx([math.pi / 3, math.pi / 3 - 0.05])
    assert stalls.best is stalls.worst


def test_grousers_change_what_is_required_and_where():
    held = tuple(SimpleNamespace(required=each, phase=Phase.ENTER, step=1) for each in (0.3, 0.2))

    class Held(tuple):
        worst = held[0]

    slides, _ = supply(asked(), Phase.TRAVERSE, Held(held))
    assert (slides.phase, slides.step) == (Phase.ENTER, 1)
    assert slides.worst[0] == pytest.approx(math.atan(0.6) - math.atan(0.3))
    assert slides.best[0] == pytest.approx(math.atan(0.9) - math.atan(0.2))
    assert slides.worst[1] == pytest.approx(-math.atan(0.3) - 0.03)


@pytest.mark.parametrize(
    ("a", "angle", "mode"),
    [(-4.7, 0.5, SLIDES_DOWN), (-4.71, 0.5, SLIDES_UP), (0.0, math.nan, SLIDES_DOWN),
     (-0.1, math.nan, SLIDES_UP), (0.0, -0.5, SLIDES_DOWN), (-0.1, -0.5, SLIDES_UP)],
)  # fmt: skip
def test_braking_more_than_the_slope_does_it_slides_up(a, angle, mode):
    """g sin(0.5) is 4.7016 m/s^2."""
    assert supply(asked(a=a, angle=angle))[0].mode is mode


def test_extremes_over_phases():
    def phase(name, friction, traction, step):
        return SimpleNamespace(
            phase=name, required_friction=friction, traction_over_weight=traction,
            required_friction_step=step,
        )  # fmt: skip

    each = (phase(Phase.ENTER, 0.4, 0.9, 1), phase(Phase.LAND, 0.6, 0.3, 7))
    assert _Extremes.of(None, None, each) == (0.6, 0.9, Phase.LAND, 7)
    nothing = _Extremes.of(None, None, ())
    assert nothing[2:] == (None, None)
    assert math.isnan(nothing.friction)
    assert math.isnan(nothing.traction)


# obstacles


def obstacles(
    *,
    belly=None,
    touches=(),
    phase=None,
    status=Status.OK,
    descending=False,
    part=(None, None),
    landings=(),
):
    start, until = part
    found = SimpleNamespace(
        status=status, end=(Phase.TRAVERSE, 4), descending=descending, start=start, until=until,
        outline=SimpleNamespace(reach=(0.4, 0.6)), profile=SimpleNamespace(landings=(2.0, 3.0)),
    )  # fmt: skip
    phases = tuple(SimpleNamespace(phase=each, belly_touches=each in touches) for each in Phase)
    question = asked(belly=belly)
    question.landings = landings
    return {one.mode: one for one in _obstacles(question, found, phase, phases)}


def test_room_on_the_landings_is_the_least_of_both():
    """1 m of robot: 2.0 - 0.7 and 3.0 - 0.9 m deep; driven down the doors change places."""
    assert list(obstacles()) == [LANDING_ROOM]
    room = obstacles()[LANDING_ROOM]
    assert (room.worst.tolist(), room.if_fails) == ([pytest.approx(0.3)], OPEN)
    assert obstacles(descending=True)[LANDING_ROOM].worst == pytest.approx(0.1)
    # a part of a plan that sets out from the flight, or ends there, stands on the other landing
    assert obstacles(part=("there", None))[LANDING_ROOM].worst == pytest.approx(1.1)
    assert obstacles(part=(None, 0.7))[LANDING_ROOM].worst == pytest.approx(0.3)
    assert obstacles(part=("there", 0.7))[LANDING_ROOM].worst == math.inf
    assert obstacles(phase=Phase.ENTER) == {}
    assert list(obstacles(phase=Phase.LAND)) == [LANDING_ROOM]


def landing(end, turn, *lengths):
    return SimpleNamespace(end=end, turn=turn, lengths=lengths)


@pytest.mark.parametrize(
    ("landings", "room"),
    [
        ([landing("between", "none", 1.25, 1.2)], 0.2),  # the shorter of its lengths, no door
        ([landing("between", "half", 1.9, 1.2)], 0.2),
        ([landing("between", "unknown", 1.2)], 0.3),
        ([landing("bottom", "half", 1.2)], 0.3),
        ([landing("between", "half", 1.9), landing("between", "half", 1.1)], 0.1),
    ],
)
def test_landings_between_flights_need_room_too(landings, room):
    """1 m of robot, 0.3 m to spare on the first and the last landing."""
    assert obstacles(landings=landings)[LANDING_ROOM].worst == pytest.approx(room)


def test_where_it_is_stuck():
    stuck = obstacles(status=Status.STUCK)[STUCK]
    assert (stuck.worst.tolist(), stuck.phase, stuck.step) == ([-math.pi / 2], Phase.TRAVERSE, 4)
    assert stuck.if_fails is FAILS
    assert STUCK in obstacles(status=Status.STUCK, phase=Phase.TRAVERSE)
    assert STUCK not in obstacles(status=Status.STUCK, phase=Phase.LAND)
    assert STUCK not in obstacles(status=Status.FELL_BACKWARD)


def test_where_its_belly_touches():
    free = obstacles(belly=0.05)[HIGH_CENTRING]
    assert (free.worst.tolist(), free.phase) == ([math.inf], None)
    found = obstacles(belly=0.05, touches=(Phase.TRAVERSE, Phase.LAND))[HIGH_CENTRING]
    assert (found.worst.tolist(), found.phase) == ([-math.inf], Phase.TRAVERSE)
    assert found.if_fails is ROUGHLY
    assert HIGH_CENTRING not in obstacles(touches=(Phase.LAND,))


# what is driven


@pytest.mark.parametrize("status", Status)
@pytest.mark.parametrize("a", [0.0, 0.1, -0.1])
def test_what_is_no_answer(status, a):
    """The solver's failures; and a robot that rocks where effective gravity turns."""
    failed = status in (Status.NOT_CONVERGED, Status.TOO_LONG, Status.NO_START)
    rocks = status is Status.STUCK and a != 0
    assert _answered(asked(a=a), SimpleNamespace(status=status)) is not (failed or rocks)


def long(flat_length):
    track = Track(flat_length=flat_length, front_radius=0.06, rear_radius=0.06)
    return Robot(name="long", com_from_front=1.0, com_height=0.2, track=track)


def test_which_flights_repeat_themselves():
    """Over 60 risers, if the robot spans less than 30 of them: 30 hypot(50, 50) mm are 2.12 m."""

    def of(robot=KENAF, **flight):
        return repeats(Question.in_one_posture(robot, Stairs(**flight)))

    assert of(rise=0.1, going=0.3, steps=61)
    assert not of(rise=0.1, going=0.3, steps=60)
    assert not of(rises=(0.1,) * 30 + (0.12,) * 31, goings=(0.3,) * 60)
    assert of(long(2.0), rise=0.05, going=0.05, steps=80)  # 2.12 m with its ends
    assert not of(long(2.002), rise=0.05, going=0.05, steps=80)


def test_which_questions_have_one_traverse():
    flight = Stairs(rise=0.1, going=0.3)

    def of(robot=KENAF, stairs=flight, friction=0.5, **manner):
        return Question.in_one_posture(robot, stairs, friction=friction, **manner)

    assert drives_alike(of(), of(friction=0.9))
    belts = KENAF.track.model_copy(update={"belt": "smooth"})
    assert drives_alike(of(), of(KENAF.model_copy(update={"track": belts})))
    for other in (
        of(stairs=Stairs(rise=0.1, going=0.31)), of(direction="down"), of(acceleration=0.1),
        of(facing="tail-first"), of(KENAF.with_centroid(0.2, 0.08)),
    ):  # fmt: skip
        assert not drives_alike(of(), other)


FLIGHT = Stairs(rise=0.1, going=0.3)
GAUGED = KENAF.model_copy(update={"track": KENAF.track.model_copy(update={"gauge": 0.4})})


def question_of(robot=GAUGED, terrain=FLIGHT, **manner):
    return Question.in_one_posture(robot, terrain, friction=0.5, **manner)


def test_a_question_is_driven_along_its_heading_unless_it_was(monkeypatch):
    driven = []
    drive = lambda question: driven.append(question) or "driven"  # noqa: E731
    monkeypatch.setattr(contact_model, "traverse_of", drive)
    monkeypatch.setattr(contact_model, "findings_of", lambda question, basis: (question, basis))
    straight, turned = question_of(), question_of(yaw=0.2)
    assert judge(straight) == (straight, Basis(straight, "driven"))
    _, basis = judge(turned)
    assert basis.question == turned.changed(terrain=along_heading(FLIGHT, 0.2), yaw=0.0)
    ramp = question_of(terrain=Profile.of_points([(-2, 0), (0, 0), (1, 0.3), (3, 0.3)]))
    assert judge(ramp)[1].question is ramp
    # what was driven is taken over where the change plays no part
    driven.clear()
    known = Findings(model="", basis=Basis(straight, "known"))
    slippery = Question.in_one_posture(GAUGED, FLIGHT, friction=0.1)
    assert judge(slippery, known=known) == (slippery, Basis(slippery, "known"))
    assert driven == []
    assert judge(question_of(direction="down"), known=known)[1].traverse == "driven"


def test_a_plan_is_driven_unless_it_was(monkeypatch):
    monkeypatch.setattr(planned, "drive", lambda question: "driven")
    monkeypatch.setattr(planned, "findings", lambda question, of: (question, of))
    change = {"before": "land", "posture": {"front": 0.5}}
    plan = Question.of(Robot.named("absolem"), FLIGHT, friction=0.5).changed(
        best_of=(), posture={"front": 0.1}, changes=(change,)
    )
    known = Findings(model="", basis=Basis(plan, "known"))
    assert judge(plan) == (plan, "driven")
    assert judge(plan, known=known) == (plan, "known")
    other = plan.changed(direction="down")
    assert judge(other, known=known) == (other, "driven")


@pytest.mark.parametrize("direction", ["up", "down"])
def test_the_manner_in_which_it_is_driven(direction, monkeypatch):
    asked_for = []
    monkeypatch.setattr(module, "traverse", lambda *given, **how: asked_for.append((given, how)))
    question = question_of(direction=direction, facing="tail-first", acceleration=0.2)
    driven_over("profile", question, step=0.05)
    ((given, how),) = asked_for
    assert given == ("profile", question.outline)
    assert how == {
        "descending": direction == "down", "facing": "tail-first", "acceleration": 0.2,
        "step": 0.05,
    }  # fmt: skip


def test_a_long_uniform_flight_is_driven_as_far_as_it_says_all():
    long_flight = Stairs(rise=0.1, going=0.3, steps=90)
    assert len(profile_of(question_of(terrain=long_flight)).nosings) == LONG_FLIGHT
    ramp = Profile.of_points([(-2, 0), (0, 0), (1, 0.3), (3, 0.3)])
    assert profile_of(question_of(terrain=ramp)) is ramp
    assert len(profile_of(question_of(terrain=Stairs(rise=0.1, going=0.3, steps=5))).nosings) == 5


@pytest.fixture
def put_together(monkeypatch):
    """Findings of a traverse of two phases, and of which phases its parts are asked."""
    phases = tuple(
        SimpleNamespace(
            phase=each, required_friction=mu, traction_over_weight=0.1, required_friction_step=1
        )
        for each, mu in ((Phase.ENTER, 0.3), (Phase.LAND, 0.4))
    )
    asked_for = {}

    def of(question, *, phase=None, held=None, status=Status.OK):
        found = SimpleNamespace(status=status, phases=phases)
        monkeypatch.setattr(module, "spread", lambda *given: "spread")
        monkeypatch.setattr(module.traction, "supplies", lambda *given: held)
        for name in ("_supply", "_obstacles", "balance"):

            def part(*given, name=name):
                asked_for[name] = given
                return [SimpleNamespace(mode=name)]

            monkeypatch.setattr(module, name, part)
        return findings_of(question, Basis(question, found), phase=phase), asked_for

    return of


def test_findings_put_together(put_together):
    found, parts = put_together(question_of())
    assert [one.mode for one in found.each] == ["_supply", "_obstacles", "balance"]
    assert found.required_friction == 0.4
    assert [one.phase for one in parts["_obstacles"][3]] == [Phase.ENTER, Phase.LAND]
    found, parts = put_together(question_of(), phase=Phase.ENTER)
    assert found.required_friction == 0.3
    assert [one.phase for one in parts["_obstacles"][3]] == [Phase.ENTER]
    assert found.notes == ()
    # at a yaw on stairs the slope across adds to it
    turned = question_of(yaw=0.2)
    across = float(equivalent_slope_across(theta_s=FLIGHT.angle, psi=0.2))
    assert put_together(turned)[0].required_friction == pytest.approx(math.hypot(0.4, across))
    held = SimpleNamespace(worst=SimpleNamespace(required=0.2))
    assert put_together(question_of(), held=held)[0].required_friction == 0.2
    failed, _ = put_together(question_of(), status=Status.TOO_LONG)
    assert (failed.outside, failed.each) == (Status.TOO_LONG.message, ())


def test_notes_are_of_the_way_and_of_what_grips(put_together, monkeypatch):
    monkeypatch.setattr(module, "_notes", lambda *given: ("of the way",))
    monkeypatch.setattr(module.traction, "figures_of", lambda *given: "what grips")
    monkeypatch.setattr(module.grips, "notes", lambda question, grip: (grip,))
    found, _ = put_together(question_of())
    assert tuple(found.notes) == ("of the way", "what grips")


@pytest.mark.parametrize("uncertain", [False, True])
@pytest.mark.parametrize(
    ("slides", "most", "reserve", "left"),
    [
        ([0.3, 0.5], 1.0, 0.0, 0.3),
        ([0.5, 0.3], 0.2, 0.0, 0.2),
        ([math.nan, 0.3], 1.0, 0.0, 0.3),
        ([-0.1], 1.0, 0.0, 0.0),  # below nothing nothing is left
        ([0.3], 1.0, 0.2, 0.3),
    ],
)
def test_falls_are_sought_as_far_as_they_may_be_the_smallest(
    slides, most, reserve, left, uncertain
):
    """Beyond the allowances of 0.02 and 0.05, or the reserve if that is more."""
    question = SimpleNamespace(
        uncertain=uncertain, reserve=reserve, allowance_d=SimpleNamespace(high=0.02),
        allowance_M=SimpleNamespace(high=0.05),
    )  # fmt: skip
    found = SimpleNamespace(sought="sought", seeking=lambda sought, *, enough: (sought, enough))
    each = [SimpleNamespace(worst=np.array([margin, -1.0])) for margin in slides]
    seen = module._seen_no_farther(question, found, each, most)
    if uncertain:
        assert seen is found
    else:
        sought, enough = seen
        assert sought == "sought"
        # rad: what is just as small is found too
        assert max(0.07, reserve) + left < enough < max(0.07, reserve) + left + 1e-5


@pytest.mark.parametrize("answered", [False, True])
@pytest.mark.parametrize("otherwise", [False, True])
@pytest.mark.parametrize("phase", [None, Phase.LAND])
def test_sliding_is_known_first_where_grousers_hold_it(answered, otherwise, phase, monkeypatch):
    """By hand: friction 0.5, 0.3 required."""
    held = SimpleNamespace(phase=phase, required=0.3)
    found = SimpleNamespace(status=Status.OK if answered else Status.TOO_LONG)
    over = SimpleNamespace(friction=np.array([0.0, 0.1]), steeper=lambda phase: 0.0)
    monkeypatch.setattr(module.belts, "holds_otherwise", lambda question: otherwise)
    monkeypatch.setattr(module.traction, "supply", lambda driven, traverse, track: held)
    monkeypatch.setattr(module, "spread", lambda *given: over)
    question = question_of()
    margin = module.sliding_margin(question, Basis(question, found))
    if answered and otherwise and phase is not None:
        by_hand = [math.atan(each) - math.atan(0.3) for each in (0.5, 0.6)]
        assert margin == pytest.approx(by_hand)
    else:
        assert margin.tolist() == [math.inf]


def test_figures_of_falls_that_were_looked_for(monkeypatch):
    monkeypatch.setattr(
        module, "figures_of", lambda question, driven, found, phases, *, falls: (phases, falls)
    )
    monkeypatch.setattr(
        module, "support_polygon",
        SimpleNamespace(
            energy_of=lambda question, flight, at: 2 * at,
            figures_of=lambda question, flight, energy: energy,
        ),
    )  # fmt: skip
    phases = tuple(SimpleNamespace(phase=each) for each in (Phase.ENTER, Phase.LAND))
    found = SimpleNamespace(falls_downhill="down", falls_uphill="up", phases=phases)

    def of(question, modes, phase=None):
        return list(_figures(question, question, found, phase, modes))

    turned = question_of(yaw=0.2)
    assert of(turned, [FALL_UPHILL]) == [(phases, ("up",)), pytest.approx(0.4)]
    assert of(turned, [FALL_UPHILL, FALL_DOWNHILL], Phase.LAND) == [(phases[1:], ("down", "up"))]
    assert of(question_of(KENAF), []) == [(phases, ())]
    ramp = question_of(terrain=Profile.of_points([(-2, 0), (0, 0), (1, 0.3), (3, 0.3)]))
    assert len(of(ramp, [])) == 1
