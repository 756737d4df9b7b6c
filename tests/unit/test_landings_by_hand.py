"""Room on landings where the way turns, laid out by hand; no manoeuvre is searched for."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.mechanics.clearance import OFF_LINE, corner_margin
from kaidan.mechanics.turning import Footprint
from kaidan.models import clearance, landings
from kaidan.models.clearance import KEPT
from kaidan.models.findings import (
    ROUNDING,
    Finding,
    Findings,
    hardest,
    sliding_where,
    without_rounding,
)
from kaidan.models.landings import LANE, PASSAGE, Turned, beside, room_of, turned
from kaidan.modes import SLIDES_DOWN, SLIDES_UP, TIP_DOWNHILL, TURNING, Phase
from kaidan.terrain.landings import Landing

PI = math.pi
SMALL = Footprint(0.4, 0.3, 0.5)


def landing(turn, level="", *, depth=2.0, width=3.0, arrives=1.2, leaves=1.0, end="between"):
    return Landing("here", end, turn, depth, width, arrives, leaves, level)


def walls(room):
    return {tuple(round(each, 9) for each in row) for row in room.walls.tolist()}


SIDES = {(0, 0, 2, 0), (2, 0, 2, 3), (-LANE, 0, 0, 0), (-LANE, 1.2, 0, 1.2)}


def test_room_of_a_half_turn():
    """2 m deep, 3 m wide: it arrives 1.2 m wide at y = 0 and goes on 1 m wide at y = 3."""
    room = room_of(landing("half"))
    assert room.start == (0.0, 0.6, 0.0)
    assert tuple(room.goal) == (0.0, 2.5, PI, 1.0, False)
    assert room.landing.tolist() == [[0, 0], [2, 0], [2, 3], [0, 3]]
    assert room.kept.tolist() == [[KEPT, 0], [2, 0], [2, 3], [KEPT, 3]]
    assert walls(room) == SIDES | {(0, 3, 2, 3), (0, 1.2, 0, 3)}
    assert (room.level, room.corner) == (False, None)
    off = room_of(landing("half", "leaves"))
    assert off.goal.level
    assert walls(off) == SIDES | {(0, 3, 2, 3), (0, 1.2, 0, 2), (0, 2, -LANE, 2), (0, 3, -LANE, 3)}
    assert off.corner is None  # a corner is that of a quarter
    # ways wider than what is between them
    close = room_of(landing("half", "leaves", arrives=2.2))
    assert (0, 2.2, 0, 2.2) in walls(close)
    onto = room_of(landing("half", "arrives"))
    assert onto.level
    assert onto.kept.tolist() == [
        [-PASSAGE, 0], [2, 0], [2, 3], [0, 3], [0, 1.2], [-PASSAGE, 1.2]
    ]  # fmt: skip


def test_room_of_a_quarter_turn():
    room = room_of(landing("quarter"))
    assert tuple(room.goal) == (1.5, 3.0, PI / 2, 1.0, False)
    assert walls(room) == SIDES | {(0, 1.2, 0, 3), (0, 3, 2, 3)}
    assert room.corner is None  # from stairs onto stairs it does not slide round
    off = room_of(landing("quarter", "leaves"))
    assert walls(off) == SIDES | {(0, 1.2, 0, 3), (0, 3, 1, 3), (1, 3, 1, 3 + LANE),
                                  (2, 3, 2, 3 + LANE)}  # fmt: skip
    assert off.corner == (1.2, 1.0, 2.0)
    assert room_of(landing("quarter", "arrives")).corner == (1.2, 1.0, 3.0)
    # ways are no wider than the landing, which is no less than none
    wide = room_of(landing("quarter", depth=-1.0, arrives=9.0, leaves=9.0))
    assert (wide.start[1], wide.goal.width, wide.goal.x) == (1.5, 0.0, 0.0)
    assert room_of(landing("half", arrives=9.0, leaves=9.0)).goal.width == 3.0


def test_a_footprint_grows_all_round():
    assert landings._grown(SMALL, 0.1) == pytest.approx((0.5, 0.4, 0.7))


def test_where_the_robot_begins_to_turn():
    """Off the stairs its centre is kept beyond the edge; on the level its front is at the edge."""
    room = room_of(landing("quarter"))._replace(start=(0.5, 0.6, 0.3))
    c, s = math.cos(0.3), math.sin(0.3)
    into = KEPT + 0.01
    found = landings._asked(SMALL, room)
    assert found["start"] == pytest.approx((0.5 + into * c, 0.6 + into * s, 0.3))
    assert into > KEPT
    level = landings._asked(SMALL, room._replace(level=True))
    assert level["start"] == pytest.approx((0.5 - 0.4 * c, 0.6 - 0.4 * s, 0.3))


@pytest.mark.parametrize("level", [True, False])
def test_round_a_corner_it_stays_on_the_landing(level):
    """As deep as it is long askew; behind stairs as its farther end about its centre."""
    needed = math.hypot(0.7, 0.5) if level else math.hypot(0.4, 0.25) + KEPT
    assert float(corner_margin(w=0.5, length=0.7, a=1.2, b=1.0)) > 0
    for deep, rounds in ((needed + 1e-9, True), (needed, True), (needed - 1e-9, False)):
        assert landings._rounds(SMALL, level, 1.2, 1.0, deep) is rounds
        assert landings._rounds(Footprint(0.3, 0.4, 0.5), level, 1.2, 1.0, deep) is rounds
    assert float(corner_margin(w=0.5, length=0.7, a=0.55, b=0.6)) < 0
    assert not landings._rounds(SMALL, level, 0.55, 0.6, 9.0)


@pytest.fixture
def tried(monkeypatch):
    """A turn where only some footprints find a way, by their width."""

    def of(at_once=(), back=(), corners=4, width=(0.5, 0.4)):
        asked = []

        def search(ways, name):
            def found(footprint, room):
                asked.append((name, round(footprint.width, 3)))
                return (name, "path") if round(footprint.width, 3) in ways else ("none", None)

            return found

        monkeypatch.setattr(landings, "_at_once", search(at_once, "spin"))
        monkeypatch.setattr(landings, "_back_and_forth", search(back, "manoeuvre"))
        room = room_of(landing("quarter"))
        room = room._replace(kept=room.kept[:corners])
        each = [(f"{w}", Footprint(0.4, 0.3, w)) for w in width]
        return turned(each, room), asked

    return of


def test_the_first_posture_and_way_that_turn(tried):
    """With room to be off the line, else without; at once before it goes back and forth."""
    off = 2 * OFF_LINE
    found, asked = tried(at_once=(0.4 + off,), back=(0.5 + off,))
    assert (found.way, found.tight, found.posture) == ("spin", False, "0.4")
    assert asked == [("spin", 0.5 + off), ("spin", 0.4 + off)]
    found, _ = tried(at_once=(0.5, 0.4))
    assert (found.way, found.tight, found.posture) == ("spin", True, "0.5")
    found, asked = tried()
    assert (found.way, found.tight, found.posture, found.path) == ("none", False, "0.4", None)
    assert len(asked) == 8
    assert found.room > 0
    found, asked = tried(corners=2, at_once=(0.5, 0.4))
    assert (found.way, found.tight, found.room, asked) == ("none", False, 0.0, [])
    assert tried(corners=3, at_once=(0.5,))[0].way == "spin"
    unknown = turned([("flat", Footprint(0.4, 0.3, math.nan))], room_of(landing("quarter")))
    assert unknown == Turned("unknown", False, "flat", unknown.footprint, None, None)


def test_what_is_shown_of_a_turn():
    path = SimpleNamespace(moves=5, reversals=2)
    found = Turned("manoeuvre", True, "stowed", SMALL, path, 1.5)
    said = landings.shown(found, "flat", PI / 2, Robot.named("absolem"))
    assert (said["moves"], said["reversals"], said["turn_deg"]) == (5, 2, pytest.approx(90.0))
    assert (said["flippers"], said["changed"], said["room_m"]) == ("stowed", True, 1.5)
    said = landings.shown(found._replace(path=None), "stowed", None, Robot.named("kenaf"))
    assert (said["moves"], said["reversals"], said["turn_deg"]) == (0, 0, None)
    assert (said["flippers"], said["changed"]) == ("", False)


@pytest.mark.parametrize(
    ("ways", "worst", "best"),
    [
        (("spin", "spin"), math.inf, math.inf),
        (("spin", "unknown"), -math.inf, math.inf),
        (("none", "spin"), -math.inf, -math.inf),
        (("none", "none"), -math.inf, -math.inf),
    ],
)
def test_every_landing_has_to_be_turned_on(ways, worst, best, monkeypatch):
    turns = [SimpleNamespace(holds=way == "spin", way=way) for way in ways]
    monkeypatch.setattr(landings, "turns_of", lambda question: turns)
    found = beside(None, Findings(model="by hand"))
    (one,) = (each for each in found.each if each.mode is TURNING)
    assert (one.worst.tolist(), one.best.tolist()) == ([worst], [best])


def test_who_stands_flat_may_stow_and_who_has_no_flippers_has_one_posture(monkeypatch):
    seen = []
    monkeypatch.setattr(landings, "_footprint", lambda question, name: SMALL)
    monkeypatch.setattr(
        landings, "_turned_on",
        lambda tried, where: seen.append([name for name, _ in tried])
        or Turned("spin", False, "stowed", SMALL, None, 1.0),
    )  # fmt: skip
    stairs = Stairs(rise=0.17, going=0.29, lower_turn="half", lower_landing=2.0,
                    lower_landing_width=3.0, width=1.2)  # fmt: skip
    absolem = Question.in_one_posture("absolem", stairs, friction=1.0, flippers="flat")
    for question, names in (
        (absolem, ["flat", "stowed"]), (absolem.changed(posture={}), ["stowed"]),
        (Question.in_one_posture("kenaf", stairs, friction=1.0), None),
    ):  # fmt: skip
        seen.clear()
        assert len(landings.turns_of(question)) == 1
        assert len(seen[0]) == 1 if names is None else seen == [names]


@pytest.mark.parametrize("direction", ["up", "down"])
def test_the_posture_at_each_landing(direction):
    postures = {Phase.ENTER: "first", Phase.TRAVERSE: "middle", Phase.LAND: "last"}
    question = SimpleNamespace(direction=direction, postures=postures)
    ends = [landings._posture_at(question, landing("half", end=end))
            for end in ("lower", "between", "upper")]  # fmt: skip
    assert ends == (
        ["first", "middle", "last"] if direction == "up" else ["last", "middle", "first"]
    )


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_room_for_a_robot_that_stows_its_flippers_there(direction, facing, monkeypatch):
    """Reaches behind and ahead of the centroid: out 0.5 and 0.9, stowed 0.3 and 0.35 m."""
    reaches = {"out": (0.5, 0.9), "stowed": (0.3, 0.35)}

    class Out(SimpleNamespace):
        state = None

    monkeypatch.setattr(clearance, "Posture", lambda state: "stowed")
    monkeypatch.setattr(
        clearance, "Outline",
        SimpleNamespace(
            of=lambda robot, posture, payload: SimpleNamespace(
                reach=reaches["stowed" if posture == "stowed" else "out"]
            )
        ),
    )  # fmt: skip
    depths, leaves = (1.6, 1.5), (0.1, 0.2)
    question = SimpleNamespace(
        robot=None, payload=(), facing=facing, direction=direction, leaves=leaves,
        postures={Phase.ENTER: Out(), Phase.LAND: Out()},
        profile=SimpleNamespace(landings=depths),
    )  # fmt: skip
    nose = facing == "nose-first"
    (behind, ahead), s_ahead = ((0.5, 0.9), 0.35) if nose else ((0.9, 0.5), 0.3)
    out = max(0.65, behind + s_ahead), max(0.65, ahead + KEPT)
    ends = [depth - leaf for depth, leaf in zip(depths, leaves, strict=True)]
    ends = ends if direction == "up" else ends[::-1]
    by_hand = min(end - min(1.4, need) for end, need in zip(ends, out, strict=True))
    assert clearance.room_when_stowed(question) == pytest.approx(by_hand)


# findings


def test_rounding_is_no_margin():
    found = without_rounding(np.array([-2e-9, -0.5 * ROUNDING, 0.5 * ROUNDING, 2e-9, math.nan]))
    assert found[:4].tolist() == [-2e-9, 0.0, 0.0, 2e-9]
    assert math.isnan(found[4])


def test_the_hardest_is_the_first_of_those_alike():
    assert hardest([0.5, 0.7, 0.7002, 0.3]) == 1  # to a thousandth
    assert hardest([0.5, 0.7, 0.72]) == 2
    assert hardest([math.nan, 0.2]) == 1
    assert hardest([0.4, math.inf, math.inf]) == 1


def test_sliding_is_told_where_most_friction_is_required():
    def one(mode, phase, step):
        return Finding.certain(mode, 0.1, phase=phase, step=step, model="by hand")

    most = (one(TIP_DOWNHILL, Phase.ENTER, 1), one(SLIDES_UP, Phase.LAND, 7))
    slides, tips = one(SLIDES_DOWN, Phase.TRAVERSE, 3), one(TIP_DOWNHILL, Phase.TRAVERSE, 3)
    moved = sliding_where(most, slides)
    assert (moved.mode, moved.phase, moved.step) == (SLIDES_DOWN, Phase.LAND, 7)
    assert sliding_where(most, tips) is tips
    assert sliding_where(most[:1], slides) is slides
    assert sliding_where((), slides) is slides
