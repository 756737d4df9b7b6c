"""Findings and figures of a plan's parts and changes as one, by hand; nothing is driven."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, Robot
from kaidan.models import planned as module
from kaidan.models.contact_figures import ContactFigures, Grades, PhaseFigures, TiltFigures
from kaidan.models.findings import Finding, Findings
from kaidan.models.planned import Part, Planned, _of_move, _smallest, _together, findings
from kaidan.models.quasi_static import profile_of
from kaidan.models.traction import Standing
from kaidan.modes import (
    ENERGY,
    FAILS,
    FLIPPER_TORQUE,
    OPEN,
    POSTURE_CHANGE,
    ROUGHLY,
    SLIDES_DOWN,
    TIP_DOWNHILL,
    Phase,
    Verdict,
)
from kaidan.robot import Posture
from kaidan.surface import Surface
from kaidan.traversal.moves import Move
from kaidan.traversal.rotations import ROCKING

UNSURE, NO_GO = Verdict.UNSURE, Verdict.NO_GO
QUESTION = Question.of(Robot.named("absolem"), "ibc", friction=0.9).changed(
    best_of=(), posture=Posture(front=0.1), changes=({"before": "land", "posture": {"front": 0.5}},)
)


def finding(mode, worst, best=None, **more):
    worst = np.atleast_1d(np.asarray(worst, dtype=float))
    best = worst if best is None else np.atleast_1d(np.asarray(best, dtype=float))
    return Finding(mode=mode, worst=worst, best=best, model="", **more)


def change(**given):
    usual = {"stands": True, "rocks": 0.0, "before": Phase.LAND, "energy": 0.05,
             "spare_torque": math.nan, "tilt": lambda side: math.inf,
             "path": SimpleNamespace(poses=[1])}  # fmt: skip
    return SimpleNamespace(**(usual | given))


def test_a_plan_arrives_if_its_last_part_does_and_it_stands_at_every_change():
    def arrives(last, *stands):
        part = Part(None, SimpleNamespace(arrived=last))
        return Planned(None, (part,), tuple(change(stands=each) for each in stands)).arrived

    assert arrives(True, True, True)
    assert not arrives(True, True, False)
    assert not arrives(False, True)
    assert arrives(True)


class Driven:
    """A traverse that records whence it began, and where it was to end."""

    def __init__(self, name, start, until, arrived):
        self.start, self.until, self.arrived = start, until, arrived
        poses = SimpleNamespace(placement=lambda row: f"{name}[{row}]")
        self.path = SimpleNamespace(poses=poses, ground=SimpleNamespace(points="ground"))


@pytest.mark.parametrize(
    ("stuck", "falls", "parts", "changes"),
    [(None, None, 3, 2), (0, None, 1, 0), (1, None, 2, 1), (None, 0, 1, 1), (None, 1, 2, 2)],
)
def test_a_plan_is_driven_until_it_is_stuck_or_falls(stuck, falls, parts, changes, monkeypatch):
    """Three postures, in two changes: each part begins where the change ended."""
    asked = QUESTION.changed(
        changes=(
            {"before": "traverse", "posture": {"front": 0.3}},
            {"before": "land", "posture": {"front": 0.5}},
        )
    )
    driven, changed = [], []

    def over(profile, alone, *, start, until):
        driven.append(Driven(f"part {len(driven)}", start, until, len(driven) != stuck))
        return driven[-1]

    def move(robot, old, new, *, before, start, **given):
        changed.append((old.front, new.front, before, start))
        return change(stands=len(changed) - 1 != falls, end=f"change {len(changed)}")

    monkeypatch.setattr(module, "move", move)
    monkeypatch.setattr(module, "stop", lambda question, profile, phase: phase)
    found = module.drive(asked, over=over)
    starts, ends = [None, "change 1", "change 2"], [Phase.TRAVERSE, Phase.LAND, None]
    assert [(one.start, one.until) for one in driven] == [*zip(starts, ends, strict=True)][:parts]
    assert changed == [
        (0.1, 0.3, Phase.TRAVERSE, "part 0[-1]"), (0.3, 0.5, Phase.LAND, "part 1[-1]")
    ][:changes]  # fmt: skip
    assert [part.question.posture.front for part in found.parts] == [0.1, 0.3, 0.5][:parts]
    assert len(found.moves) == changes
    assert found.arrived is (stuck is None and falls is None)


def test_the_robot_changes_short_of_the_nosing_that_is_next():
    """Going up the first or the last, going down as driven, from the other end."""
    profile = profile_of(QUESTION)
    up, down = QUESTION, QUESTION.changed(direction="down")
    x = profile.nosings[:, 0]
    for asked, first, last in ((up, x[0], x[-1]), (down, -x[-1], -x[0])):
        for phase, at in ((Phase.TRAVERSE, first), (Phase.LAND, last)):
            assert module.stop(asked, profile, phase) == pytest.approx(at - module.STAND_OFF)


def test_a_tilt_on_the_way_of_a_change_counts_less_the_allowances():
    """Over its downhill end, but for the edge of the landing that it goes down over next."""
    d, M = QUESTION.allowance_d, QUESTION.allowance_M
    tilts = {1.0: 0.3, -1.0: 0.2}
    for asked, before, least in (
        (QUESTION, Phase.TRAVERSE, 0.3 - d.high - M.high),
        (QUESTION.changed(direction="down"), Phase.LAND, 0.2 - d.high),
        (QUESTION.changed(direction="down"), Phase.TRAVERSE, None),
    ):
        found = _of_move(asked, change(before=before, tilt=tilts.get), None)
        (tips,) = [each for each in found if each.mode is TIP_DOWNHILL] or [None]
        assert (tips is None) == (least is None)
        if tips is not None:
            assert (tips.phase, tips.instead) == (before, None)
            assert tips.worst == pytest.approx([least])
            assert tips.best > tips.worst


@pytest.mark.parametrize(("tilt", "row"), [(0.0, OPEN), (1.0, ROUGHLY)])
def test_of_a_rock_on_the_way_nothing_tells_how_far_from_a_fall(tilt, row):
    (tips,) = [
        each
        for each in _of_move(QUESTION, change(tilt=lambda side: tilt), None)
        if each.mode is TIP_DOWNHILL
    ]
    assert tips.if_fails is row


def test_a_tilt_on_the_way_less_the_least_of_the_allowances_is_the_best_case():
    d, M = ({"low": low, "high": high} for low, high in ((0.01, 0.02), (0.03, 0.05)))
    asked = QUESTION.changed(theta_d=d, theta_M=M)
    (tips,) = [
        each
        for each in _of_move(asked, change(tilt=lambda side: 0.3), None)
        if each.mode is TIP_DOWNHILL
    ]
    assert tips.worst == pytest.approx([0.3 - 0.02 - 0.05])
    assert tips.best == pytest.approx([0.3 - 0.01 - 0.03])


def test_the_tilt_on_the_way_is_told_where_it_is_less_than_before_and_after():
    """By hand: the centroid 0.3 m above contacts that lie 0.1 to 0.3 m off."""

    def tilt(side, *levers, postures=None):
        off = np.array(levers)
        points = np.column_stack([-side * off, np.zeros(len(off))])
        path = SimpleNamespace(
            x=np.zeros(len(off)), z=np.full(len(off), 0.3),
            poses=SimpleNamespace(**{"rear_point" if side > 0 else "front_point": points}),
        )  # fmt: skip
        stands = SimpleNamespace(path=path, postures=[None] * (postures or len(off)))
        return Move.tilt(stands, side)

    for side in (1.0, -1.0):
        assert tilt(side, 0.3, 0.1, 0.2) == pytest.approx(math.atan2(0.1, 0.3))
        assert tilt(side, 0.1, 0.2, 0.3) == math.inf
        assert tilt(side, 0.3, 0.2, 0.1) == math.inf
        assert tilt(side, 0.3, 0.1, postures=3) == math.inf


def test_of_a_mode_the_smallest_margin_of_all_parts_counts():
    """Sample by sample, at the place of the smallest; the earliest of those alike."""
    nan = math.nan
    some = [
        finding(TIP_DOWNHILL, [nan, nan], instead=FAILS, step=9),
        finding(TIP_DOWNHILL, [0.2, 0.1], [0.3, 0.4], step=1),
        finding(TIP_DOWNHILL, [0.0500001, 0.3], [0.5, 0.2], step=2),
        finding(TIP_DOWNHILL, [0.05, nan], [0.6, nan], step=3),
    ]
    found = _smallest(some)
    assert (found.step, found.if_fails) == (2, ROUGHLY)
    assert found.worst.tolist() == [0.05, 0.1]
    assert found.best.tolist() == [0.3, 0.2]
    severe = [*some, finding(TIP_DOWNHILL, [0.9, 0.9], instead=OPEN)]
    assert _smallest(severe).if_fails is OPEN
    severe += [finding(TIP_DOWNHILL, [0.9, 0.9], instead=FAILS)]
    assert _smallest(severe).if_fails is FAILS
    assert _smallest(some[:1]) is some[0]
    unknown = _smallest([some[0], some[0]])
    assert (unknown.step, unknown.if_fails) == (9, FAILS)
    assert np.isnan(unknown.worst).all()
    one, other = finding(TIP_DOWNHILL, [0.2], step=1), finding(TIP_DOWNHILL, [0.1], step=2)
    assert _smallest([one, other]).step == 2


HELD = Standing(worst=0.1, best=0.3, required=0.5)


def of_move(standing=HELD, **given):
    question = SimpleNamespace(direction="up", kinetic_height=0.01)
    return {one.mode: one for one in _of_move(question, change(**given), standing)}


def test_findings_of_a_change():
    found = of_move()
    assert list(found) == [POSTURE_CHANGE, SLIDES_DOWN, ENERGY]
    assert {one.phase for one in found.values()} == {Phase.LAND}
    assert (found[POSTURE_CHANGE].worst, found[POSTURE_CHANGE].if_fails) == (math.inf, OPEN)
    slides = found[SLIDES_DOWN]
    assert (slides.worst.tolist(), slides.best.tolist()) == ([0.1], [0.3])
    assert (found[ENERGY].worst.tolist(), found[ENERGY].if_fails) == ([pytest.approx(0.04)], OPEN)
    assert of_move(spare_torque=-3.0)[FLIPPER_TORQUE].worst == -3.0
    assert list(of_move(None)) == [POSTURE_CHANGE]


@pytest.mark.parametrize(
    ("stands", "rocks", "margin", "if_fails"),
    [
        (True, ROCKING, math.inf, OPEN),
        (True, math.nextafter(ROCKING, 1), -math.inf, OPEN),
        (False, 0.0, -math.inf, FAILS),
        (False, 1.0, -math.inf, FAILS),
    ],
)
def test_where_it_does_not_stand_or_rocks(stands, rocks, margin, if_fails):
    found = of_move(stands=stands, rocks=rocks)[POSTURE_CHANGE]
    assert (found.worst.tolist(), found.best.tolist()) == ([margin], [margin])
    assert found.if_fails is if_fails


def test_findings_of_parts_and_changes(monkeypatch):
    """Sliding is told where most friction is required; each part is judged in its posture."""
    parts = {
        "first": Findings(
            model="", required_friction=0.5, notes=("one", "two"),
            each=(finding(TIP_DOWNHILL, 0.2, step=1), finding(SLIDES_DOWN, 0.3, step=2)),
        ),
        "second": Findings(
            model="", required_friction=0.7, notes=("two", "three"),
            each=(finding(TIP_DOWNHILL, 0.1, step=3), finding(SLIDES_DOWN, 0.4, step=4)),
        ),
    }  # fmt: skip
    asked = []

    def judged(question, basis, *, most):
        assert math.isinf(most)
        asked.append(question)
        return parts[basis.traverse]

    monkeypatch.setattr(module, "findings_of", judged)
    held = {}
    monkeypatch.setattr(module.traction, "standing", lambda question, each: held[each.before])
    monkeypatch.setattr(module, "_of_move", lambda question, each, standing: (
        finding(ENERGY, 0.01 if standing is held.get(each.before) else math.nan),
    ))  # fmt: skip
    alone = [QUESTION.changed(posture=Posture(front=each), changes=()) for each in (0.1, 0.5)]
    driven = tuple(Part(*each) for each in zip(alone, parts, strict=True))

    def of(question, needed=0.4, **given):
        held[Phase.LAND] = Standing(worst=0.1, best=0.3, required=needed)
        if given:
            held.clear()
        return findings(question, Planned(QUESTION, driven, (change(**given),)))

    found = of(QUESTION)
    modes = {one.mode: one for one in found.each}
    assert list(modes) == [TIP_DOWNHILL, SLIDES_DOWN, ENERGY]
    assert (modes[TIP_DOWNHILL].worst.tolist(), modes[TIP_DOWNHILL].step) == ([0.1], 3)
    assert (modes[SLIDES_DOWN].worst.tolist(), modes[SLIDES_DOWN].step) == ([0.3], 4)
    assert found.required_friction == 0.7
    assert found.notes[:] == ("one", "two", "three")
    assert asked == alone
    assert of(QUESTION, 0.9).required_friction == 0.9
    nowhere = of(QUESTION, path=SimpleNamespace(poses=[]))  # it stands in no pose of the change
    assert nowhere.required_friction == 0.7
    assert nowhere.of(ENERGY).worst == 0.01
    # a changed question, that has the same traverse
    asked.clear()
    other = QUESTION.changed(surface=Surface.of_friction(0.5))
    of(other)
    assert [(one.posture, one.friction, one.changes) for one in asked] == [
        (each.posture, (0.5, 0.5), ()) for each in alone
    ]
    parts["second"] = Findings(model="", outside="too long")
    assert (of(QUESTION).outside, of(QUESTION).each) == ("too long", ())


def phase(name, friction, energy, **given):
    usual = {
        "phase": name, "required_friction": friction, "required_friction_step": 1,
        "slides_below": None, "energy_margin_mm": energy, "energy_margin_step": 2,
        "static_margin_mm": 10.0, "traction_over_weight": 0.5, "largest_rotation_deg": 1.0,
        "belly_touches": False,
    }  # fmt: skip
    return PhaseFigures(**(usual | given))


def figures(phases, *, grades=(True, True, True, 3.0, 4.0), tilt=(5.0, 6.0, 3.0), **given):
    names = tuple(Grades.model_fields)
    rock, fall, reserve = tilt
    usual = {
        "grades": Grades(**dict(zip(names, grades, strict=True))),
        "tilt": TiltFigures(to_rock_deg=rock, to_fall_deg=fall, reserve_deg=reserve),
        "phases": tuple(phases), "rotations": (), "energy_threshold_mm": 1.0,
        "speed_stated": True, "rear_length_mm": None, "margin_centroid_mm": None,
        "traction_N": None, "power_W": None,
    }  # fmt: skip
    return ContactFigures(**(usual | given))


def test_figures_of_parts_as_one():
    one = figures(
        [phase("enter", 0.5, 7.0), phase("land", 0.4, None, slides_below=0.2)],
        grades=(True, True, False, 3.0, 4.0), tilt=(5.0, None, 3.0), margin_centroid_mm=8.0,
        traction_N=100.0, power_W=0.5,
    )  # fmt: skip
    two = figures(
        [phase("land", 0.6, 3.0, slides_below=0.3, energy_margin_step=5, static_margin_mm=2.0,
               traction_over_weight=0.9, largest_rotation_deg=7.0, belly_touches=True)],
        grades=(False, True, True, 2.0, 9.0), tilt=(4.0, 2.0, 3.0), margin_centroid_mm=-1.0,
        traction_N=50.0,
    )  # fmt: skip
    (found,) = _together([one, two])
    assert [*dict(found.grades).values()] == [False, True, False, 3.0, 9.0]
    assert (found.tilt.to_rock_deg, found.tilt.to_fall_deg) == (4.0, 2.0)
    assert (found.margin_centroid_mm, found.traction_N, found.power_W) == (-1.0, 100.0, 0.5)
    enter, land = found.phases
    assert (enter.phase, enter.required_friction) == ("enter", 0.5)
    assert (land.required_friction, land.slides_below) == (0.6, 0.3)
    assert (land.energy_margin_mm, land.energy_margin_step) == (3.0, 5)
    assert (land.static_margin_mm, land.traction_over_weight) == (2.0, 0.9)
    assert (land.largest_rotation_deg, land.belly_touches) == (7.0, True)
    nothing = figures([], grades=(None, True, True, 0.0, 0.0), tilt=(None, None, 3.0))
    (found,) = _together([nothing, nothing])
    assert found.grades.no_rotation is None
    assert (found.tilt.to_rock_deg, found.tilt.to_fall_deg) == (None, None)
    assert (found.margin_centroid_mm, found.traction_N, found.power_W) == (None, None, None)
    other = figures([], grades=(True, False, True, 0.0, 0.0), rear_length_mm=5.0,
                    tilt=(6.0, 8.0, 4.0))  # fmt: skip
    for pair in ([two, other], [other, two]):
        (found,) = _together(pair)
        first = pair[0]
        assert found.rear_length_mm == first.rear_length_mm
        assert found.tilt.reserve_deg == first.tilt.reserve_deg
        assert (found.grades.arrested, found.grades.arrested_with_momentum) == (False, True)
        assert (found.tilt.to_rock_deg, found.tilt.to_fall_deg) == (4.0, 2.0)
    (found,) = _together([one, nothing])
    assert found.grades.no_rotation is True
    assert found.grades.arrested is True
    assert found.tilt.to_rock_deg == 5.0
