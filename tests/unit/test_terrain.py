"""Several flights and profiles of any shape as what the robot is to climb."""

import math

import numpy as np
import pytest

from kaidan.errors import InputError, KaidanError
from kaidan.models.clearance import findings_of
from kaidan.models.quasi_static import traverse_of
from kaidan.models.sentences import terrain
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.terrain.room import Room
from kaidan.terrain.stairs import Stairs
from kaidan.terrain.stairs_uncertainty import StairsUncertainty
from kaidan.text.assessment import stairs_line
from kaidan.traversal import Phase
from kaidan.verbs.monitor.live import LiveMonitor
from kaidan.verbs.monitor.online import Monitor
from one_posture import assess

LOW = Stairs(name="low", rise=0.10, going=0.25, steps=9, upper_landing=2.0)
HIGH = Stairs(name="high", rise=0.12, going=0.25, steps=8)
ASKED = {"friction": 1.5, "flippers": "flat"}


def driven(terrain, direction="up"):
    return traverse_of(Question.in_one_posture("absolem", terrain, **ASKED, direction=direction))


def spans(found):
    """Names of the phases in the order in which the robot goes through them."""
    phase = found.phase_of_pose.tolist()
    return [name for k, name in enumerate(phase) if k == 0 or phase[k - 1] != name]


def test_a_profile_of_a_flight_is_answered_as_the_flight():
    flight = assess("absolem", LOW, **ASKED)
    profile = assess("absolem", Profile.of_stairs(LOW), **ASKED)
    assert (profile.verdict, profile.governs, profile.phase) == (
        flight.verdict, flight.governs, flight.phase,
    )  # fmt: skip
    assert profile.margin_deg == pytest.approx(flight.margin_deg, abs=1e-9)
    assert profile.angle_deg == pytest.approx(flight.angle_deg, abs=1e-9)
    assert profile.findings.keys() == flight.findings.keys()
    for key, one in profile.findings.items():
        other = flight.findings[key]
        assert one.holds is other.holds, key
        if key != "support":  # a length of a uniform flight alone; elsewhere it only holds
            assert one.margin == pytest.approx(other.margin, abs=1e-9), key


@pytest.mark.parametrize("given", [[LOW, HIGH], (LOW, HIGH), Profile.of_flights([LOW, HIGH])])
def test_several_flights_are_one_path(given):
    found = driven(given)
    assert found.arrived
    # height climbed, by hand: 9 x 0.10 + 8 x 0.12
    assert np.ptp(found.path.poses.z[[0, -1]]) == pytest.approx(1.86, abs=1e-9)
    assert spans(found) == ["enter", "traverse", "land", "enter", "traverse", "land"]


def test_flights_go_down_through_the_same_phases():
    found = driven([LOW, HIGH], direction="down")
    assert found.arrived
    assert spans(found) == ["enter", "traverse", "land", "enter", "traverse", "land"]
    enters = next(each for each in found.phases if each.phase is Phase.ENTER)
    assert math.degrees(enters.largest_rotation) == pytest.approx(
        math.degrees(math.atan2(0.12, 0.25)), abs=0.1
    )


def test_a_landing_shorter_than_the_flat_is_a_long_step():
    short = LOW.model_copy(update={"upper_landing": 0.8})  # m; the flat is 1.149 m long
    assert "land" not in spans(driven([short, HIGH]))[:-1]


def test_worst_of_both_flights_counts():
    both = driven([LOW, HIGH]).phases
    each = [driven(flight).phases for flight in (LOW, HIGH)]
    for phase, *alone in zip(both, *each, strict=True):
        assert phase.required_friction == pytest.approx(
            max(one.required_friction for one in alone), abs=1e-6
        )


def test_flights_in_one_text():
    one = assess("absolem", "ibc+ada", **ASKED)
    assert one.question.terrain_name == "ibc + ada"
    assert one == assess("absolem", ["ibc", "ada"], **ASKED)
    with pytest.raises(KaidanError, match="no staircase is called 'nowhere'"):
        assess("absolem", "ibc+nowhere")


@pytest.mark.parametrize("flights", [[LOW, HIGH], [HIGH, LOW]], ids=["above", "below"])
def test_slope_and_spacing_of_several_flights_are_those_of_the_steepest(flights):
    """Not the mean over the landing, which is as gentle as the landing is long."""
    answer = assess("absolem", flights, **ASKED)
    steepest = max(flights, key=lambda each: each.rise / each.going)
    slope = math.atan2(steepest.rise, steepest.going)
    assert answer.angle_deg == pytest.approx(math.degrees(slope), abs=1e-9)
    assert answer.nosing_spacing_m == pytest.approx(math.hypot(steepest.rise, steepest.going))
    assert stairs_line(answer).startswith(f"{math.degrees(slope):.1f} deg, ")


def test_several_flights_are_watched_and_need_headroom_as_the_steepest():
    """Not by the mean over the landing."""
    one, both = (Question.of("absolem", each, **ASKED) for each in (HIGH, [LOW, HIGH]))
    assert LiveMonitor(both).slope == pytest.approx(math.atan2(0.12, 0.25), abs=1e-12)
    assert Monitor.of(both).inside_model
    low, same = (findings_of(each, Room(((1.0, math.inf),)), "contact") for each in (both, one))
    assert low == same


def test_slope_of_several_flights_is_in_doubt_as_that_of_one():
    """It was exact where a flight is entered: the friction there had no doubt of it."""
    doubted = [
        each.model_copy(update={"uncertainty": StairsUncertainty(angle=0.03)})
        for each in (LOW, HIGH)
    ]
    alone, both, exact = (
        assess("absolem", each, friction=0.9, flippers="flat").findings["slides_down"].margin
        for each in (doubted[1], doubted, [LOW, HIGH])
    )
    assert both == pytest.approx(alone, abs=1e-6)
    assert both < exact - 0.03


def test_the_closed_form_knows_one_flight_alone():
    answer = assess("absolem", [LOW, HIGH], **ASKED, model="closed-form")
    assert "the terrain is no single flight of stairs" in str(answer)
    assert answer.limits == ()


def test_a_single_flight_in_a_list_is_that_flight():
    assert assess("absolem", [LOW], **ASKED) == assess("absolem", LOW, **ASKED)


BUMP = [(-2, 0), (0, 0), (0.05, 0.10), (0.30, 0.10), (0.35, 0), (2, 0)]


def test_a_terrain_without_steps_is_judged_by_what_it_has():
    answer = assess("absolem", Profile.of_points(BUMP), **ASKED)
    assert answer.verdict == "go"
    assert answer.angle_deg is answer.nosing_spacing_m is answer.closed_form is None
    phases = answer.contact.phases
    assert answer.required_friction == max(each.required_friction for each in phases)
    assert {each.phase for each in phases} == {"enter", "land"}
    flat = assess("absolem", Profile.of_points(BUMP), **ASKED, model="closed-form")
    assert flat.verdict == "outside-model"
    assert flat.reason == "The closed form has no answer: the terrain is no flight of stairs."


def test_a_kerb_too_high_is_a_no_go():
    kerb = Profile.of_points([(-2, 0), (0, 0), (0, 0.55), (3, 0.55)])
    answer = assess("absolem", kerb, **ASKED)
    assert answer.verdict == "no-go"
    assert answer.to_json()


def test_a_yaw_on_a_profile_is_refused():
    with pytest.raises(InputError, match="a profile lies along the heading already"):
        assess("absolem", Profile.of_points(BUMP), yaw=0.1, **ASKED)


@pytest.mark.parametrize("bad", [None, 3, [], [None], np.zeros((3, 2)), object()])
def test_what_is_no_terrain_is_refused(bad):
    with pytest.raises(KaidanError):
        assess("absolem", bad)


def test_rocking_under_an_acceleration_is_no_verdict_on_the_robot():
    """Effective gravity leans with the path, which turns at once where a contact is exchanged."""
    stairs = Stairs(rise=0.136, going=0.265, steps=8)
    asked = {"friction": 1.0, "direction": "down"}
    rocks = assess("ozbot-atr", stairs, acceleration=0.5, **asked)
    assert (rocks.verdict, rocks.margin_deg) == ("outside-model", None)
    assert "rocking on the spot" in rocks.reason
    assert assess("ozbot-atr", stairs, **asked).verdict != "outside-model"


def test_a_hole_before_the_stairs_and_a_cliff_behind_them_are_driven():
    """The first and the last nosing are not where the path begins and ends."""
    steps = [(0, 0), (0, 0.15), (0.3, 0.15), (0.3, 0.3)]
    asked = {"friction": 3.0, "theta_d": 0.0, "theta_M": 0.0}
    hole = [(-9, 0), (-5, 0), (-5, -2), (-4, -2), (-1.5, 0), *steps, (3, 0.3)]
    cliff = [(-12, -5), (-9, -5), (-3, 0), *steps, (2, 0.3), (2, -5), (9, -5)]
    for points in (hole, cliff):
        answer = assess("absolem-flat", Profile.of_points(points), **asked)
        assert (answer.verdict, answer.falls_over) == ("no-go", "nose")


def test_a_riser_that_leans_is_entered_from_its_foot():
    leaning = Profile.of_points([(-3, 0), (0, 0), (0.5, 5.7), (4, 5.7)])
    answer = assess("kenaf", leaning, friction=3.0)
    assert (answer.verdict, answer.phase) == ("no-go", "enter")


@pytest.mark.parametrize("direction", ["up", "down"])
def test_a_ramp_is_a_go(direction):
    slope = math.radians(20)
    foot, top = (0.0, 0.0), (2 * math.cos(slope), 2 * math.sin(slope))
    ramp = Profile.of_points([(-3, 0), foot, top, (top[0] + 3, top[1])])
    asked = {"friction": 1.0, "direction": direction}
    answer = assess("kenaf", ramp, **asked)
    # by hand: on a plane tan(slope) wherever the load is, so 45 - 20 degrees to spare
    assert (answer.verdict, answer.governs) == ("go", "slides_down")
    assert answer.margin_deg == pytest.approx(25.0, abs=1e-6)
    assert "Assumed: both tracks meet the same profile: a ramp." in answer.notes


def test_a_drop_that_only_the_impact_softens_is_no_go_ahead():
    """Kenaf, nose first down one edge, turned about it until the nose meets the ground.

    By hand for 200 mm: it turns by 59.2 deg (0.2 = 0.196 sin + R (1 - cos), R = 65 mm), the
    centroid falls by 71 (1 - cos 59.2) = 34.6 mm, and 24.7 mm are left to climb. For 150 mm: 42.7
    deg, 18.8 mm, 58.9 mm. A sudden stop at 0.1 m/s adds 0.5 mm 71^2 / (71^2 + 126^2) = 0.12 mm.
    """
    by_height = {
        height: assess(
            "kenaf",
            Profile.of_points([(-3, 0), (0, 0), (0, height), (3, height)]),
            direction="down",
            friction=3.0,
            theta_d=0.0,
        )
        for height in (0.15, 0.20)
    }
    assert by_height[0.15].verdict == "go"
    high = by_height[0.20]
    assert (high.verdict, high.governs) == ("unsure", "momentum")
    assert (high.phase, high.step) == ("enter", 1)
    assert high.contact.grades.arrested_with_momentum
    assert high.reason == (
        "Only the impact that ends its rotation takes enough momentum to hold it (enter, step 1)."
    )
    for answer, angle, drop, left in (
        (by_height[0.15], 42.7, 18.8, 58.9),
        (high, 59.2, 34.6, 24.7),
    ):
        (one,) = answer.contact.rotations
        assert (one.phase, one.obliged, one.arrested) == ("enter", True, True)
        assert one.angle_deg == pytest.approx(angle, abs=0.05)  # one printed place
        assert one.drop_mm == pytest.approx(drop, abs=0.05)
        # what is left to climb without an impact, less what the drop and a stop give
        spare = answer.findings["momentum"].margin
        assert spare == pytest.approx(left - drop - 0.12, abs=0.1)


def test_a_profile_that_falls_is_driven_down_only():
    """Measured from the upper to the lower end: the same edge, seen from the other side."""
    edge = [(-3, 0.15), (0, 0.15), (0, 0), (3, 0)]
    down = {"direction": "down", "friction": 3.0}
    fallen = assess("kenaf", Profile.of_points(edge), **down)
    seen = assess("kenaf", Profile.of_points([(-x, z) for x, z in edge[::-1]]), **down)
    assert fallen.verdict == "go"
    assert fallen.findings == seen.findings
    with pytest.raises(InputError, match=r"profile: it falls by 0\.15 m from left to right"):
        assess("kenaf", Profile.of_points(edge), friction=3.0)


FLOOR = Profile.of_points([(-3, 0), (3, 0)])


@pytest.mark.parametrize("robot", ["kenaf", "absolem", "talon"])
def test_a_floor_has_no_stairs_to_be_judged(robot):
    """It was a GO with 0.00 of friction required; `kaidan read` ends with 3 likewise."""
    answer = assess(robot, FLOOR, friction=1.0)
    assert (answer.verdict, answer.exit_code) == ("outside-model", 3)
    assert answer.required_friction is None
    assert answer.reason == (
        "The contact model has no answer: the terrain is level, so there are no stairs."
    )
    assert answer.what_would_help == ()


@pytest.mark.parametrize("model", ["closed-form", "support-polygon", "physics"])
def test_no_other_model_judges_a_floor(model):
    assert assess("kenaf", FLOOR, friction=1.0, model=model).verdict == "outside-model"


def test_a_scanned_floor_is_level():
    """3 mm of noise, a point every centimetre; a ramp that climbs 1 in 20 is none."""
    x = np.arange(-3.0, 3.0, 0.01)
    noise = np.random.default_rng(1).normal(0.0, 0.003, len(x))
    for z, level in ((noise, True), (noise + 0.05 * np.maximum(x, 0.0), False)):
        answer = assess("kenaf", Profile.of_points(np.column_stack([x, z])), friction=1.0)
        assert (answer.verdict == "outside-model") is level


def blocks(*heights, width=0.2):
    """Blocks side by side on a floor [m]."""
    line = [(-3.0, 0.0), (0.0, 0.0)]
    for k, height in enumerate(heights):
        line += [(k * width, height), ((k + 1) * width, height)]
    return [*line, (len(heights) * width, 0.0), (len(heights) * width + 3.0, 0.0)]


UNBUILT = {
    "rubble": blocks(0.05, 0.01, 0.06, 0.02, 0.05),
    "pallet": blocks(0.144, 0.122, 0.144, 0.122, 0.144, width=0.1),
    "ditch": [(-3, 0), (0, 0), (0, -0.05), (0.2, -0.05), (0.2, 0), (3, 0)],
}
BUILT = {
    "threshold": blocks(0.06),
    "step": [(-3, 0), (0, 0), (0, 0.06), (3, 0.06)],
    "ramp with a step": [(-3, 0), (0, 0), (2, 0.4), (2, 0.44), (5, 0.44)],
}


@pytest.mark.parametrize("line", [*UNBUILT.values()], ids=UNBUILT)
@pytest.mark.parametrize("mirrored", [False, True])
def test_what_is_not_built_across_is_no_go_before_somebody_says_so(line, mirrored):
    """Left and right track may meet other blocks; nothing else keeps it from a GO."""
    line = [(-x, z) for x, z in reversed(line)] if mirrored else line
    answer = assess("absolem", Profile.of_points(line), **ASKED)
    assert (answer.verdict, answer.governs) == ("unsure", "across")
    assert answer.reason == (
        "The profile is no flight of steps, single step, ramp or threshold. One track may meet "
        "other ground than the other."
    )
    (change,) = answer.what_would_help
    assert (change.change, change.verdict) == (terrain.STATE, "go")
    stated = assess("absolem", Profile.of_points(line), **ASKED, uniform_across=True)
    assert (stated.verdict, stated.margin_deg) == ("go", answer.margin_deg)
    assert "Assumed: both tracks meet the same profile, as stated." in stated.notes
    assert "both tracks meet the same profile, as stated" in str(stated)


@pytest.mark.parametrize("line", [*BUILT.values()], ids=BUILT)
def test_what_is_built_across_is_a_go_that_says_what_is_assumed(line):
    answer = assess("absolem", Profile.of_points(line), **ASKED)
    assert answer.verdict == "go"
    assert "both tracks meet the same profile: a " in str(answer)
