"""The support polygon's findings at a yaw, of margins made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.mechanics.oblique import body_inclination, oblique_friction
from kaidan.models import support_polygon as module
from kaidan.models.centroid import shift_of_centroid
from kaidan.models.support_polygon import (
    SCAN,
    along_heading,
    energy_of,
    judge,
    margins_of,
    tips,
)
from kaidan.modes import (
    DRIVE,
    FAILS,
    SLIDES_DOWN,
    SLIDES_UP,
    TIP_DOWNHILL,
    TIP_SIDEWAYS,
    TIP_UPHILL,
    Phase,
)
from kaidan.question import LARGEST_YAW
from kaidan.robot import Drive

G = 9.80665
YAW = 0.2
FLIGHT = Stairs(rise=0.17, going=0.29, steps=6)
KENAF = Robot.named("kenaf")
ROBOT = KENAF.model_copy(
    update={
        "mass": 20.0, "drive": Drive(max_traction=150.0),
        "track": KENAF.track.model_copy(update={"gauge": 0.4}),
    }
)  # fmt: skip


def asked(**given):
    usual = {"friction": (0.6, 0.9), "theta_d": (0.01, 0.02), "theta_M": (0.03, 0.05), "yaw": YAW}
    return Question.in_one_posture(ROBOT, FLIGHT, **(usual | given))


@pytest.fixture
def found(monkeypatch):
    """Findings beside tipping, friction in doubt by 0.1 and -0.9, the slope by 0 and 30 mrad."""
    samples = np.array([0.1, -0.9]), np.array([0.0, 0.03])
    monkeypatch.setattr(module, "_supply_samples", lambda question, at: samples)
    monkeypatch.setattr(module, "tips", lambda question, flight, *, instead: ())
    monkeypatch.setattr(module, "energy_of", lambda question, flight, psi: 0.1 * psi)
    monkeypatch.setattr(module, "figures_of", lambda question, flight, energy: energy)

    def of(**given):
        judged = judge(asked(**given))
        return judged, {one.mode: one for one in judged.each}

    return of


def test_friction_and_drive_at_a_yaw(found):
    judged, modes = found()
    theta = math.atan2(0.17, 0.29)
    needed = float(oblique_friction(theta_s=theta, psi=YAW, a=0.0))
    assert judged.required_friction == pytest.approx(needed)
    slides, angle = modes[SLIDES_DOWN], math.atan(needed)
    assert slides.worst == pytest.approx([math.atan(0.7) - angle, -angle - 0.03])
    assert slides.best == pytest.approx([math.atan(1.0) - angle, -angle - 0.03])
    body = float(body_inclination(theta_s=theta, psi=YAW))
    spare = math.asin(150.0 / (20.0 * G)) - body
    assert modes[DRIVE].worst == pytest.approx([spare, spare - 0.03])
    assert tuple(judged.figures) == (pytest.approx(0.1 * YAW),)


def test_braking_more_than_the_slope_does_it_slides_up(found):
    least = G * math.sin(math.atan2(0.17, 0.29))
    for a, mode in ((-0.999 * least, SLIDES_DOWN), (-1.001 * least, SLIDES_UP)):
        assert mode in found(acceleration=a)[1]


def test_tips_are_margins_less_the_allowances(monkeypatch):
    """The grousers' angle counts downhill alone."""
    margins = np.array([[[0.3, 0.2]], [[0.4, 0.5]], [[0.6, 0.7]]])
    monkeypatch.setattr(module, "margins_of", lambda question, flight, psi: margins)
    each = tips(asked(), FLIGHT, instead=FAILS)
    assert [one.mode for one in each] == [TIP_DOWNHILL, TIP_UPHILL, TIP_SIDEWAYS]
    for one, row, (worst, best) in zip(
        each, margins[:, 0], ((0.07, 0.04), (0.02, 0.01), (0.02, 0.01)), strict=True
    ):
        assert one.worst == pytest.approx(row - worst)
        assert one.best == pytest.approx(row - best)
        assert (one.instead, one.phase) == (FAILS, Phase.TRAVERSE)


def test_of_several_kinds_of_steps_the_worst_counts():
    """Margins and rises of the whole are the least of those of each kind alone."""
    steps = ((0.15, 0.3), (0.2, 0.25))
    flights = [Stairs(rise=rise, going=going, steps=6) for rise, going in steps]
    uneven = Stairs(rises=(0.1, 0.15, 0.2, 0.15), goings=(0.3, 0.25, 0.3))

    def of(found, flight):
        question = Question.in_one_posture(ROBOT, flight, friction=1.0)
        return found(question, flight, np.array([YAW]))

    for found in (margins_of, energy_of):
        alone = np.minimum(*(of(found, each) for each in flights))
        np.testing.assert_allclose(of(found, uneven), alone)


def test_a_track_without_any_contact_at_times_tips():
    """Nosings of 336 mm lie p / cos(psi) apart along it: 470 mm at a yaw of 0.774 rad."""
    p = math.hypot(0.17, 0.29)
    limit = math.acos(p / ROBOT.track.flat_length)
    for yaw, alone in ((limit + 1e-6, True), (limit - 1e-6, False), (-limit - 1e-6, True)):
        found = margins_of(asked(), FLIGHT, np.array([yaw]))
        assert bool((found == -math.pi / 2).all()) is alone


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("a", [0.0, 0.4])
def test_the_centroid_is_moved_by_what_a_margin_lacks(facing, a):
    """Less the allowances: the load stands C_N (tan + a / (g cos)) behind the centroid's foot."""
    L, C_N, p, d, M = 0.470, 0.071, 0.150, 0.02, 0.05
    C_L = 0.196 if facing == "nose-first" else L - 0.196

    def of(slope, downhill, spacing=p, **manner):
        flight = Stairs.inclined(angle=slope, nosing_spacing=spacing)
        question = Question.in_one_posture(
            ROBOT, flight, theta_d=(0.0, d), theta_M=(0.0, M), facing=facing, acceleration=a,
            **manner,
        )  # fmt: skip
        return shift_of_centroid(question, downhill=downhill)

    def load(slope):
        return C_N * (math.tan(slope) + a / (G * math.cos(slope)))

    for slope in (0.9, 1.05, 1.15):
        lacks = load(slope + d + M) - (L - p - C_L)
        room = L - 2 * p - load(slope + d + M) + load(slope - d)
        found = of(slope, True)
        assert found == (pytest.approx(lacks, abs=1e-6) if lacks > 0 and room >= 0 else None)
    assert of(1.43, True) is None  # the track is too short for any shift
    assert of(1.05, True, yaw=0.1) is None
    for slope in (0.11, 0.4):
        lacks = 0.22 - C_L - load(slope - d)
        found = of(slope, False, spacing=0.22)
        assert found == (pytest.approx(lacks, abs=1e-6) if lacks > 0 else None)


def test_a_flight_along_a_heading():
    """tan(theta) = tan(theta_s) cos(psi), nosings p / cos(psi) apart; each riser by as much."""
    psi = 0.4
    ends = FLIGHT.model_copy(update={"first_rise": 0.1, "last_rise": 0.2})
    found = along_heading(ends, psi)
    assert math.tan(found.angle) == pytest.approx(0.17 / 0.29 * math.cos(psi))
    assert found.nosing_spacing == pytest.approx(math.hypot(0.17, 0.29) / math.cos(psi))
    share = found.rise / 0.17
    assert (found.first_rise, found.last_rise) == pytest.approx((0.1 * share, 0.2 * share))
    assert along_heading(FLIGHT, psi).first_rise is None
    uneven = Stairs(rises=(0.1, 0.15, 0.2), goings=(0.3, 0.25))
    found = along_heading(uneven, psi)
    for step, turned in zip(
        ((0.15, 0.3), (0.2, 0.25)), zip(found.step_rises[1:], found.step_goings, strict=True),
        strict=True,
    ):  # fmt: skip
        assert math.hypot(*turned) == pytest.approx(math.hypot(*step) / math.cos(psi))
        assert turned[0] / turned[1] == pytest.approx(step[0] / step[1] * math.cos(psi))
    assert found.step_rises[0] / 0.1 == pytest.approx(found.step_rises[1] / 0.15)


@pytest.mark.usefixtures("found")
def test_of_several_kinds_of_steps_the_steepest_needs_most_friction_and_drive():
    uneven = Stairs(rises=(0.1, 0.1, 0.108, 0.1), goings=(0.16, 0.16, 0.16))
    judged = judge(Question.in_one_posture(ROBOT, uneven, friction=1.0, yaw=YAW))
    theta = math.atan2(0.108, 0.16)
    needed = float(oblique_friction(theta_s=theta, psi=YAW, a=0.0))
    assert judged.required_friction == pytest.approx(needed)
    (drive,) = (one for one in judged.each if one.mode is DRIVE)
    spare = math.asin(150.0 / (20.0 * G)) - float(body_inclination(theta_s=theta, psi=YAW))
    assert drive.worst[0] == pytest.approx(spare)


def test_braking_as_much_as_the_slope_does_it_still_slides_down(found):
    assert SLIDES_DOWN in found(acceleration=-G * math.sin(FLIGHT.angle))[1]


def test_an_edge_that_every_slope_or_none_tips_it_over():
    """Driven as hard as it falls: off one end at any slope, off the other at none."""
    narrow = ROBOT.model_copy(update={"track": ROBOT.track.model_copy(update={"gauge": 0.2})})
    flight = Stairs.inclined(angle=0.2, nosing_spacing=0.15)
    for a in (9.0, -9.0):
        question = Question.in_one_posture(narrow, flight, acceleration=a)
        down, up, _ = margins_of(question, flight, np.array([0.9]))[:, 0, 0]
        assert (down, up) == (math.copysign(math.pi / 2, -a), math.copysign(math.pi / 2, a))


def test_a_track_as_long_as_the_nosings_are_apart_always_has_one():
    flight = Stairs.inclined(angle=0.5, nosing_spacing=ROBOT.track.flat_length)
    spacing = math.hypot(*flight.regular_steps[0])
    for L, alone in ((spacing, False), (spacing * (1 - 1e-12), True)):
        track = ROBOT.track.model_copy(update={"flat_length": L})
        robot = ROBOT.model_copy(update={"track": track})
        question = Question.in_one_posture(robot, flight)
        found = margins_of(question, flight, np.array([0.0]))
        assert bool((found == -math.pi / 2).all()) is alone


# the yaw up to which it holds


@pytest.mark.parametrize("uncertain", [False, True])
@pytest.mark.parametrize("at", [1e-4, 0.3, 0.30001, 1.0, LARGEST_YAW - 1e-9])
def test_the_yaw_up_to_which_it_holds_is_found(at, uncertain, monkeypatch):
    """Within a quarter of a degree over 2^18; looked for no farther than any yaw is judged."""
    asked = []

    def holding(question, flight):
        return lambda psi: (asked.extend(psi.tolist()), psi < at)[1]

    monkeypatch.setattr(module, "_holding", holding)
    question = SimpleNamespace(robot=ROBOT, uncertain=uncertain)
    found = module.yaw_limit(question, FLIGHT)
    # of rounding: the last halves are a million times as long
    assert at - SCAN / 2**18 - 1e-12 <= found < at
    # no place is looked at twice
    inside = [each for each in asked if each > SCAN]
    assert len({round(each, 12) for each in inside}) == len(inside) or uncertain


@pytest.mark.parametrize("uncertain", [False, True])
def test_who_holds_at_every_yaw_or_at_none_has_no_limit(uncertain, monkeypatch):
    asked = []
    question = SimpleNamespace(robot=ROBOT, uncertain=uncertain)

    def holding(question, flight):
        return lambda psi: (asked.extend(psi.tolist()), psi > -1.0)[1]

    monkeypatch.setattr(module, "_holding", holding)
    assert module.yaw_limit(question, FLIGHT) is None
    assert asked == pytest.approx(np.linspace(0.0, LARGEST_YAW, len(asked)))
    monkeypatch.setattr(module, "_holding", lambda *given: lambda psi: psi < 0.0)
    assert module.yaw_limit(question, FLIGHT) is None
    bare = KENAF.model_copy(update={"track": KENAF.track.model_copy(update={"gauge": None})})
    assert module.yaw_limit(SimpleNamespace(robot=bare), FLIGHT) is None


@pytest.mark.parametrize(
    ("margins", "energy", "holds"),
    [
        ((0.08, 0.03, 0.03), 0.02, True),
        ((0.07, 0.03, 0.03), 0.02, False),  # the allowances of 0.02 and 0.05
        ((0.08, 0.02, 0.03), 0.02, False),
        ((0.08, 0.03, 0.02), 0.02, False),
        ((0.08, 0.03, 0.03), 0.01, False),  # the threshold itself
    ],
)
@pytest.mark.parametrize("uncertain", [False, True])
def test_it_holds_where_all_margins_and_the_energy_are_left(
    margins, energy, holds, uncertain, monkeypatch
):
    """Margins of the samples, energy of the sheets' figures, each of its own edges."""

    class Stated(Question):
        def energy_threshold(self, slip=0.0):
            return 0.01

    def of(at, gauge, edges, a):
        assert edges == (at, 0.4)
        assert a == 0.0
        return at

    at = "sheets"
    drawn = "samples" if uncertain else at
    monkeypatch.setattr(module, "nominal", lambda question, flight: at)
    monkeypatch.setattr(module, "draws", lambda question, at: iter([drawn]))
    monkeypatch.setattr(module, "_edges", lambda at, gauge, psi: (at, gauge))
    rows = [np.full((1, 3), each) for each in margins]
    monkeypatch.setattr(module, "_margins", lambda *given: rows if of(*given) == drawn else None)
    monkeypatch.setattr(
        module, "_energy", lambda *given: np.array([energy]) if of(*given) == at else None
    )
    d, M = ({"low": 0.0, "high": high} for high in (0.02, 0.05))
    question = Stated.model_validate(
        {"robot": ROBOT, "terrain": FLIGHT, "theta_d": d, "theta_M": M, "posture": {}}
    )
    assert module._holding(question, FLIGHT)(np.array([0.1])).tolist() == [holds]
