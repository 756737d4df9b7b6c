"""What friction and grousers hold, by hand on margins made for it; no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.models import traction as module
from kaidan.models.belts import strength_margin
from kaidan.models.traction import (
    Supply,
    standing,
    supplies,
    supply,
    together,
)
from kaidan.models.traction_figures import TractionFigures
from kaidan.modes import Phase
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal.rating import Case

G = 9.80665
STEPS = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=3))
PLACES = np.r_[STEPS.nosings[:, 0] + 0.01, [2.0] * 3]
PHASES = np.array(["enter", "traverse", "traverse", "traverse", "land", "land"])
ALONE = np.array([0.1, -0.1, 0.0, -0.2, -0.3, -0.4])
HELD = {
    0.04: np.array([0.1, 0.05, 0.2, 0.0, 0.4, 0.3]),
    0.06: np.array([0.1, 0.02, 0.3, 0.0, 0.1, 0.3]),
}
"""Of grousers of a spacing."""
SLIP = np.array([9.0, 1e-3, 2e-3, 9.0, 9.0, 9.0])
"""Kinetic-energy height of a slip [m]."""
FRICTIONS = {False: (0.5, 0.7, 0.6), True: (0.8, 1.0, 0.9)}


def surface(*, differs=False):
    return SimpleNamespace(of_parts=lambda *, best: FRICTIONS[best], differs=differs)


def track(*, grousers=True, strength=None):
    return SimpleNamespace(has_grousers=grousers, grouser_strength=strength)


def asked(of=None, *, stated=True, yaw=0.0, **belt):
    return SimpleNamespace(
        surface=(of or surface()) if stated else None, yaw=yaw, direction="up",
        stance=SimpleNamespace(mass=2.0), robot=SimpleNamespace(track=track(**belt)),
    )  # fmt: skip


class Holding:
    """What a path's contacts hold, of any friction the same; it writes down what it is asked."""

    def __init__(self, alone=ALONE, passed=0.0):
        self.alone, self.asked = alone, []
        self.passed = passed  # what it holds less, going down, where a slip passes over nothing

    def by_friction(self, phi, height=0.0):
        self.asked.append(tuple(math.tan(each) for each in phi))
        return self.alone + (0.01 if height else 0.0)

    def with_grousers(self, phi, each, alone, *, passing=True):
        smooth = alone - (0.01 if each.rigid else 0.0)  # as high as they are rigid
        assert smooth.tolist() == pytest.approx(self.alone.tolist(), nan_ok=True)
        return HELD[each.spacing] - (0.0 if passing else self.passed)

    at_once = with_grousers

    def slip_heights(self, slip, mu_k):
        self.asked.append((slip, mu_k))
        return SLIP * slip / 0.06


def driven(grip=None, tractions=(0.5, 1.5)):
    return SimpleNamespace(
        grip=grip or Holding(), path=SimpleNamespace(
            poses=SimpleNamespace(front_point=np.c_[PLACES, 0 * PLACES])
        ),
        phases=[SimpleNamespace(traction_over_weight=each) for each in tractions],
        comes_off=np.array([False] * 5 + [True]), phase_of_pose=PHASES, profile=STEPS,
        descending=False,
    )  # fmt: skip


@pytest.fixture(autouse=True)
def grousers(monkeypatch):
    """Two cases of grousers; the fifth pose is in the midst of an exchange of contacts."""
    cases = tuple(SimpleNamespace(spacing=each, height=0.02, rigid=each < 0.05) for each in HELD)
    monkeypatch.setattr(module, "grousers_of", lambda question, track, *, best: cases)
    monkeypatch.setattr(module, "lasting", lambda path: np.arange(6) != 4)


def test_grousers_hold_in_the_worst_of_cases_after_a_slip():
    """Least 0 at the fourth pose. It slips where friction does not hold, but grousers do."""
    grip = Holding()
    found = supply(asked(surface(differs=True)), driven(grip), track())
    each = pytest.approx((0.5, 0.7, 0.6))  # of rigid ones, and of soft ones as of a smooth belt
    assert grip.asked == [each, each, (0.06, pytest.approx(0.8 * 0.5))]
    assert found == Supply(0.0, pytest.approx(0.5), Phase.TRAVERSE, 3, 0.06, {Phase.TRAVERSE: 2e-3})
    smooth = supply(asked(), driven(), track(grousers=False))
    assert smooth[:4] == (-0.2, pytest.approx(math.tan(math.atan(0.5) + 0.2)), Phase.TRAVERSE, 3)
    assert smooth[4:] == (0.0, {})
    best = supply(asked(surface(differs=True)), driven(grip), track(), best=True)
    assert grip.asked[3] == pytest.approx((0.8, 1.0, 0.9))
    assert best.required == pytest.approx(0.8)


@pytest.mark.parametrize(
    ("passed", "slip", "height"), [(0.01, 0.06, 2e-3), (0.04, 0.12, 2e-3), (0.25, 0.12, 4e-3)]
)
def test_going_down_a_slip_that_passes_over_what_nothing_holds_is_longer(passed, slip, height):
    """It slips at the second pose, where grousers hold 0.02 and the slip gives 1 mm, and at the
    third with 0.2 and 2 mm; where what is passed over is worth more than that, it slips farther."""
    down = driven(Holding(passed=passed))
    down.descending = True
    found = supply(asked(), down, track())
    assert found.slip == pytest.approx(slip)
    # sliding, of the least friction
    asked_of_slips = [each for each in down.grip.asked if len(each) == 2]
    assert asked_of_slips[-1] == (pytest.approx(slip), pytest.approx(0.8 * 0.5))
    assert found.heights == {Phase.TRAVERSE: pytest.approx(height)}


@pytest.mark.parametrize(("stated", "margin"), [(True, math.atan(0.5) - 0.4), (False, -0.4)])
def test_friction_is_what_rigid_grousers_need_not_what_they_lack_at_another(stated, margin):
    """By hand: with an angle of friction phi they hold phi / 2 - 0.2 at the third pose."""

    class AtAFace(Holding):
        def with_grousers(self, phi, each, alone, *, passing=True):
            return np.where(np.arange(6) == 2, 0.5 * phi[0] - 0.2, phi[0])

    found = supply(asked(stated=stated), driven(AtAFace()), track())
    assert found.margin == pytest.approx(margin, abs=1e-5)
    assert found.required == pytest.approx(math.tan(0.4), abs=1e-5)
    assert found.step == 3


def test_of_a_phase_alone():
    enter = supply(asked(surface(differs=True)), driven(), track(), phase=Phase.ENTER)
    assert enter == (0.1, pytest.approx(math.tan(math.atan(0.5) - 0.1)), Phase.ENTER, 1, 0.0, {})
    none = supply(asked(), driven(), track(), phase=Phase.LAND)  # passing, and coming off
    assert none[2:] == (None, None, 0.0, {})
    assert math.isnan(none.margin)
    assert math.isnan(none.required)


@pytest.mark.parametrize("stated", [True, False])
@pytest.mark.parametrize("holds", [True, False])
@pytest.mark.parametrize("bear", [True, False])
def test_belts_by_cases_where_grousers_hold_and_bear(stated, holds, bear, monkeypatch):
    """At the worst friction and at the best one, each case of grousers with its angles."""
    monkeypatch.setattr(module, "holds_otherwise", lambda question: holds)
    monkeypatch.setattr(module, "bears", lambda question, track: bear)
    found = module.gripping(asked(stated=stated))
    if not (stated and holds and bear):
        assert found is None
        return
    cases = module.grousers_of(None, None, best=False)
    angles = {best: tuple(map(math.atan, each)) for best, each in FRICTIONS.items()}
    assert found == tuple(Case(one, angles[best], best) for best in (False, True) for one in cases)


def test_a_grouser_stands_at_no_more_than_all_phases():
    one = SimpleNamespace(height=0.02, spacing=0.04, nosing_radius=0.0, tip_width=0.0, rigid=False)
    # by hand: a height above the tread over the tangent of the slope
    for slope, share in ((math.atan(0.8), 0.625), (math.atan(0.4), 1.0)):
        assert module._share(slope, one) == pytest.approx(share)


def test_friction_that_nobody_stated_is_none():
    grip = Holding()
    found = supply(asked(stated=False), driven(grip), track())
    assert grip.asked == [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.06, 0.0)]
    assert (found.margin, found.required) == (0.0, 0.0)


@pytest.mark.parametrize(("margin", "finite"), [
    (-1.1, True), (-1.2, False), (-3.0, False), (math.atan(0.5) - math.pi / 2, False),
])  # fmt: skip
def test_beyond_a_right_angle_no_friction_is_enough(margin, finite):
    """atan(0.5) is 0.464 rad, and 1.107 short of a right angle."""
    found = supply(asked(), driven(Holding(np.full(6, margin))), track(grousers=False))
    assert math.isfinite(found.required) is finite


def test_grousers_that_do_not_bear_half_of_the_traction():
    """Half of 2 kg is 9.81 N, times the largest traction over weight; that of none known is 1."""
    weak = track(strength=12.0)
    assert strength_margin(asked(), weak, driven(tractions=(0.5, 1.5))) == pytest.approx(
        12.0 - 1.5 * G
    )
    assert supply(asked(), driven(), weak).margin == -0.2
    assert supply(asked(), driven(tractions=(0.5, 1.2)), weak).margin == 0.0
    assert supply(asked(), driven(tractions=()), weak).margin == 0.0
    # as strong as that force is not strong enough
    assert supply(asked(), driven(tractions=(1.0,)), track(strength=G)).margin == -0.2


@pytest.mark.parametrize(
    ("first", "gains", "enough", "looks"),
    [
        (0.5, (0.0,), 0.5, 1),  # soft ones: cones that all grow alike
        (0.5, (-0.1, -0.02, 0.0), 0.62, 3),
        (1.3, (-0.1, -0.02, 0.0), 1.42, 3),
        (1.5, (-0.1,), 1.6, 1),  # beyond a right angle none is
        (1.6, (), 1.6, 0),
        (0.0, (), 0.0, 0),
        (-0.1, (), -0.1, 0),
        (0.5, (0.3, -0.1, 1e-9, -0.2), 0.3, 3),
    ],
)
def test_what_rigid_grousers_lack_is_added_until_nothing_is(first, gains, enough, looks):
    """Each look says what there is to spare, and where that is least."""
    left, asked_for = list(gains), []

    def spare(phi):
        asked_for.append(phi)
        return left.pop(0), len(asked_for)

    angle, at = module._enough(spare, first, 7)
    assert angle == pytest.approx(enough, abs=1e-6)
    assert at == (looks or 7)
    assert asked_for[:1] == ([first] if looks else [])
    assert len(asked_for) == looks


def test_of_cases_the_worst_counts_with_grousers_and_without():
    """Rigid ones of 40 mm hold 0.01 more at a face than soft ones of 60 mm."""
    cases = module.grousers_of(None, None, best=False)
    for order in (cases, cases[::-1]):
        held, alone = module._held(Holding(), (0.5, 0.7, 0.6), order)
        assert held.tolist() == np.minimum(*HELD.values()).tolist()
        assert alone.tolist() == ALONE.tolist()


def test_where_one_friction_of_smooth_belts_is_all_there_is_nothing_to_say():
    smooth, found = asked(grousers=False), driven()
    assert supplies(smooth, smooth, found, None) is None
    differs = asked(surface(differs=True), grousers=False)
    assert supplies(differs, differs, found, None).worst.margin == -0.2
    both = supplies(asked(), asked(), found, None)
    assert both.worst.required == pytest.approx(0.5)
    assert both.best.required == pytest.approx(0.8)
    assert supplies(asked(yaw=0.1), asked(), found, None) is None
    assert supplies(asked(), asked(), found, Phase.LAND) is None


@pytest.mark.parametrize("direction", ["up", "down"])
def test_while_it_stands(direction, monkeypatch):
    """It stands on those that hold at once, the worst of cases and poses; NaN is not known."""

    class Grip(Holding):
        def by_friction(self, phi, height=0.0):
            self.alone = np.where(ALONE == -0.4, np.nan, ALONE + phi[0])
            return super().by_friction(phi, height)

    def made(path, *, descending, acceleration):
        assert (path, descending, acceleration) == ("its path", direction == "down", 0.0)
        return Grip()

    def of(move, *given, **belt):
        question = asked(*given, **belt)
        question.direction = direction
        question.friction = tuple(each[0] for each in FRICTIONS.values())
        if question.surface is None:
            question.friction = math.nan, math.nan
        return standing(question, move)

    monkeypatch.setattr(module, "Grip", made)
    move = SimpleNamespace(path="its path", required_friction=0.6)
    unknown = of(move, stated=False, grousers=False)
    assert unknown == pytest.approx((math.nan, math.nan, 0.6), nan_ok=True)
    smooth = [math.atan(each) - math.atan(0.6) for each in (0.5, 0.8)]
    assert of(move, grousers=False) == pytest.approx((*smooth, 0.6))
    alone = tuple(math.atan(each) - 0.3 for each in (0.5, 0.8))
    of_parts = of(move, surface(differs=True), grousers=False)
    assert of_parts == pytest.approx((*alone, math.tan(0.3)))
    assert of(move) == (0.0, 0.0, pytest.approx(0.5))
    assert of(move, strength=12.0) == (0.0, 0.0, pytest.approx(0.5))
    weak = of(move, strength=9.0)  # half the weight is 9.81 N
    assert weak == pytest.approx((*alone, math.tan(0.3)))


@pytest.mark.parametrize(("lacks", "face", "required"), [(0.3, 1.0, 0.3), (0.3, 0.5, 0.6),
                                                         (-0.1, 1.0, 0.0)])  # fmt: skip
def test_friction_that_is_needed_to_stand_is_told_whatever_is_stated(
    lacks, face, required, monkeypatch
):
    """By hand: at a riser's face the cone of rigid grousers grows by half of what friction does."""

    def spare(question, grip, phi, *, best=False):
        nosings, _, _ = phi
        return face * nosings - lacks + (0.01 if best else 0.0)

    monkeypatch.setattr(module, "_standing", spare)
    monkeypatch.setattr(module, "Grip", lambda path, **how: None)
    move = SimpleNamespace(path="its path")
    found = standing(asked(stated=False), move)
    assert found.required == pytest.approx(math.tan(required), abs=1e-5)
    assert math.isnan(found.worst)
    assert math.isnan(found.best)
    # stated, the same everywhere, it is as much; of parts that differ it is what is missing there
    low, high = (math.atan(each[0]) for each in FRICTIONS.values())
    question = asked()
    found = standing(question, move)
    assert found.required == pytest.approx(math.tan(required), abs=1e-5)
    assert found.worst == pytest.approx(low - required, abs=1e-5)
    assert found.best == pytest.approx(face * high - lacks + 0.01)
    found = standing(asked(surface(differs=True)), move)
    missing = max(low - (face * low - lacks), 0.0)
    assert found.required == pytest.approx(math.tan(missing))
    assert found.worst == pytest.approx(low - missing)


def figures(**given):
    usual = {
        "belt": "smooth", "required_friction": 0.5, "smooth_required_friction": 0.6,
        "usual_required_friction": None, "phase": "enter", "step": 1, "slip_mm": None,
        "slip_heights_mm": {}, "standing_phases": None, "strength_margin_N": None,
    }  # fmt: skip
    return TractionFigures(**(usual | given))


def test_parts_of_a_plan_as_one():
    """The most friction of any; of what is not known as much as can be."""
    one = figures(
        slip_mm=40.0, slip_heights_mm={"enter": 1.0, "land": 5.0}, step=2,
        usual_required_friction=0.25,
    )  # fmt: skip
    two = figures(
        required_friction=0.7, smooth_required_friction=0.4, usual_required_friction=0.3, step=3,
        slip_mm=60.0, slip_heights_mm={"enter": 2.0, "land": -1.0, "traverse": 0.5},
    )  # fmt: skip
    three = figures(required_friction=0.1, usual_required_friction=0.2)
    for parts in ((one, two, three), (three, two, one)):
        found = together(parts)
        assert (found.required_friction, found.step) == (0.7, 3)
        assert found.smooth_required_friction == 0.6
        assert found.usual_required_friction == 0.3
        assert found.slip_mm == 60.0
        assert found.slip_heights_mm == {"enter": 2.0, "land": 5.0, "traverse": 0.5}
    nothing = figures(required_friction=math.inf, smooth_required_friction=math.inf, step=9)
    assert together((one, nothing, two)).step == 9
    assert (
        together((one, nothing, two)).smooth_required_friction == nothing.smooth_required_friction
    )
    assert together((three, three)).slip_mm is None
    # with grousers no friction is enough in one part
    assert together((one, figures(), three)).usual_required_friction is None
