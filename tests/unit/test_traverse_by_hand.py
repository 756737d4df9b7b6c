"""What a traverse says of phases, criterion and falls, by hand: no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import Placement, Status
from kaidan.mechanics.rearing import rear_length_margin
from kaidan.outline import Outline
from kaidan.robot import Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Fall, FirstRock, Phase, Traverse, passage, traverse
from kaidan.traversal.criterion import Criterion, Loss, Tread
from kaidan.traversal.tilting import LARGEST, WITHIN, largest_survived

OUTLINE = Outline.of(Robot.named("kenaf"))
STEPS = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=4))  # nosings 0.3162 m apart
NOSINGS = STEPS.nosings[:, 0]
PHASES = np.array(["enter", "enter", "traverse"])
LOSS = Loss(True, 2, 0.5, 0.1, 0.2, 0.05, 0.01, 0.01, 0.004, 0.001, 2, False, 1.0)


class Rows(SimpleNamespace):
    def __len__(self):
        return len(self.front_point)


def path_to(*places, status=Status.OK):
    """A path whose front contact stands at some places along the profile."""
    points = np.array([(x, 0.0) for x in places]).reshape(-1, 2)
    return SimpleNamespace(status=status, poses=Rows(front_point=points))


def extremes(phase, downhill=math.inf, uphill=math.inf, step=7):
    return SimpleNamespace(phase=phase, tilt_downhill=(downhill, step), tilt_uphill=(uphill, step))


def made(**given):
    figures = {
        "status": Status.OK, "descending": False, "profile": STEPS, "outline": OUTLINE,
        "acceleration": 0.5, "path": path_to(0.0, 1.0), "tread": Tread(0.5, 0.2, 0.1, 0, 0.06, 0.2),
        "criterion": Criterion((LOSS,)), "whole": True,
        "phase_of_pose": np.array(["enter", "land"]), "start": None, "until": None,
        "step": 0.02, "sought": None,
    }  # fmt: skip
    phases = given.pop("phases", ())
    found = Traverse(**(figures | given))
    vars(found)["phases"] = phases
    return found


def test_the_end_is_the_last_pose():
    given = {"path": path_to(-1.0, 0.0, NOSINGS[1] + 0.01), "phase_of_pose": PHASES}
    assert made(**given).end == (Phase.TRAVERSE, 2)
    assert made(**given, descending=True).end == (Phase.TRAVERSE, 3)


def test_only_landing_the_trailing_end_comes_off(monkeypatch):
    leaves = np.array([True, True, False])
    monkeypatch.setattr(passage, "trailing_end_leaves", lambda path: leaves)
    found = made(phase_of_pose=np.array(["traverse", "land", "land"])).comes_off
    assert found.tolist() == [False, True, False]


def test_the_part_that_it_is_over():
    start = Placement(1.0, 2.0, 0.0)
    assert made().part == (-math.inf, math.inf)
    assert made(start=start, until=3.0).part == (1.0, 3.0)
    assert made(start=start).part == (1.0, math.inf)
    # driven down the profile is reflected
    down = made(profile=STEPS.reflected(), descending=True, start=start, until=3.0)
    assert down.part == (-3.0, -1.0)


def test_the_rear_length_is_judged_at_each_riser():
    """docs/theory/transitions.md: the tip b behind the centroid, risers of 50, 200 and 100 mm."""
    rises = Profile.of_points(
        [(-1, 0), (0, 0), (0, 0.05), (0.3, 0.05), (0.3, 0.25), (0.6, 0.25), (0.6, 0.35), (2, 0.35)]
    )
    margin, rise = made(profile=rises).rear_length
    assert rise == pytest.approx(0.2)
    assert margin == pytest.approx(rear_length_margin(b=0.5 - 0.2, h=0.2, R=0.06, C_N=0.1))
    assert made(profile=rises, descending=True).rear_length is None
    assert made(profile=Profile.of_points([(0, 0), (2, 0)])).rear_length is None


def test_the_first_rock_is_the_least_of_criterion_and_poses():
    on, lands = extremes(Phase.TRAVERSE, 0.3, 0.1, step=2), extremes(Phase.LAND, 0.25, step=4)
    of_criterion = FirstRock(0.2, Phase.TRAVERSE, 3)  # steps are counted from 1
    found = made(phases=(on, lands))
    assert found.first_rock(downhill=True) == of_criterion
    assert found.downhill_margin == 0.2
    assert found.first_rock(downhill=False) == (0.1, Phase.TRAVERSE, 2)
    assert found.first_rock(downhill=True, phases=(on, lands)) == of_criterion
    assert found.first_rock(downhill=True, phases=(lands,)) == (0.25, Phase.LAND, 4)
    assert found.first_rock(downhill=False, phases=(lands,)) is None
    assert math.isnan(made(criterion=Criterion(())).downhill_margin)
    # of those that are alike the first, whichever is a hair less
    hair = extremes(Phase.LAND, 0.2 - 5e-7, step=4)
    assert made(phases=(hair,)).first_rock(downhill=True) == of_criterion
    more = extremes(Phase.LAND, 0.2 - 2e-6, step=4)
    assert made(phases=(more,)).first_rock(downhill=True).phase is Phase.LAND


def test_where_poses_judge_steps_or_they_differ_it_rocks_no_later_than_it_falls(
    monkeypatch,
):
    fall = Fall(0.15, Phase.TRAVERSE, 3)
    monkeypatch.setattr(Traverse, "_falls_beyond", lambda self, tilt: fall.tilt > tilt)
    on = extremes(Phase.TRAVERSE, 0.3, 0.4, step=2)

    def first(downhill=True, phases=(on,), **given):
        found = made(phases=phases, criterion=Criterion(()), **given)
        found.__dict__["falls_downhill"] = fall
        return found.first_rock(downhill=downhill)

    assert first(whole=False) == tuple(fall)
    assert first(whole=False, downhill=False) == (0.4, Phase.TRAVERSE, 2)
    assert first(whole=False, status=Status.FELL_BACKWARD).margin == 0.3
    assert first().margin == 0.3  # all on one flight, steps alike
    sooner = extremes(Phase.TRAVERSE, 0.15 - 2e-6, step=2)
    assert first(whole=False, phases=(sooner,)).step == 2
    step_longer = Tread(0.3, 0.1, 0.1, 0, 0.06, 0.2)  # nosings 0.316 m apart
    assert first(tread=step_longer) == tuple(fall)
    two = Profile.of_points(
        [(-1, 0), (0, 0), (0, 0.1), (0.2, 0.1), (0.2, 0.2), (0.6, 0.2), (0.6, 0.3), (0.8, 0.3),
         (0.8, 0.4), (2, 0.4)]
    )  # fmt: skip
    assert first(profile=two) == tuple(fall)  # steps differ
    kerb = [(-1, 0), (0, 0), (0, 0.1), (2, 0.1)]
    second = [(1, 0.1), (1, 0.2), (2, 0.2)]
    for points, count in (([(0, 0), (2, 0)], 0), (kerb, 1), (kerb[:3] + second, 2)):
        few = Profile.of_points(points)
        assert len(few.nosings) == count
        assert first(profile=few, whole=False).margin == (0.15 if count > 1 else 0.3)
    assert first(whole=False, phases=(extremes(Phase.LAND),)) is None  # nothing was looked at


@pytest.mark.parametrize(
    ("downhill", "uphill", "holds"),
    [(0.1, 0.2, True), (0.0, 0.2, False), (0.1, -0.1, False), (0.1, math.inf, True)],
)
def test_what_holds_on_the_flight(downhill, uphill, holds):
    phases = (extremes(Phase.ENTER, -1.0, -1.0), extremes(Phase.TRAVERSE, downhill, uphill))
    one = Profile.of_points([(-1, 0), (0, 0), (0, 0.1), (2, 0.1)])
    assert made(whole=False, phases=phases, profile=one).holds is holds
    assert made(whole=False, phases=phases[:1], profile=one).holds is None
    assert made(phases=phases).holds is True  # of the criterion
    assert made(criterion=Criterion((LOSS._replace(margin=0.0),))).holds is False


def test_how_far_the_centroid_may_move():
    both = Criterion((LOSS, LOSS._replace(centroid=-0.03)))
    assert made(criterion=both).centroid_margin == -0.03
    assert math.isnan(made(criterion=Criterion(())).centroid_margin)
    assert math.isnan(made(criterion=both, whole=False).centroid_margin)


@pytest.mark.parametrize("limit", [0.01, 0.1, 0.3, math.radians(29.9), -0.02, -0.3])
def test_the_largest_tilt_that_is_survived(limit):
    asked = []

    def survives(tilt):
        asked.append(tilt)
        return tilt <= limit

    assert limit - WITHIN <= largest_survived(survives) <= limit
    assert len(asked) < 20  # 4 deg, twice that and so on, then halves
    assert max(abs(tilt) for tilt in asked) <= LARGEST


def test_beyond_what_is_looked_for_a_fall_is_first_tried_where_it_rocks():
    """It rocks at 0.9: survived just below that, it takes one more try; felled there, halves."""
    asked = []

    def largest(limit, **how):
        asked.clear()

        def survives(tilt):
            asked.append(tilt)
            return tilt <= limit

        return largest_survived(survives, most=0.9, **how)

    assert largest(0.9 - 0.5 * WITHIN) == 0.9 - WITHIN
    assert asked[-3:] == [pytest.approx(8 * math.radians(4.0)), 0.9, 0.9 - WITHIN]
    for limit in (0.9 - 1.5 * WITHIN, 0.6):
        assert limit - WITHIN <= largest(limit) <= limit
    assert largest(0.9) == math.inf
    # what is sought is known already
    assert largest(0.6, sought=(0.9,)) < 0.9
    assert asked[-1] == 0.9


@pytest.mark.parametrize("limit", [0.01, 0.1, 0.3, 0.6, -0.02, -0.3, -0.6])
@pytest.mark.parametrize("sought", [(0.05,), (0.1, 0.2), (-0.1,), (0.0, 0.5), ()])
def test_what_is_sought_is_said_as_if_the_tilt_were_found(limit, sought):
    asked = []

    def survives(tilt):
        asked.append(tilt)
        return tilt <= limit

    found = largest_survived(survives, sought=sought)
    whole = largest_survived(lambda tilt: tilt <= limit)
    count = len(asked)
    assert [found > each for each in sought] == [whole > each for each in sought]
    assert found <= whole
    largest_survived(survives)
    assert count <= len(asked) - count


@pytest.mark.parametrize("limit", [0.01, 0.1, 0.3, 0.6, -0.02])
@pytest.mark.parametrize("enough", [0.05, 0.2, 0.45])
def test_up_to_what_is_enough_the_tilt_is_the_same(limit, enough):
    whole = largest_survived(lambda tilt: tilt <= limit)
    found = largest_survived(lambda tilt: tilt <= limit, enough=enough)
    assert min(found, enough) == min(whole, enough)
    assert found <= whole


def test_no_more_is_asked_than_says_what_is_sought_or_that_it_is_enough():
    """Tilts are doubled: survived up to 0.5, felled at 0.6."""
    first, second = [], []

    def survives(asked):
        return lambda tilt: asked.append(tilt) or tilt <= 0.5

    largest_survived(survives(first))
    doubled = first[1]
    assert largest_survived(survives(second), enough=2 * doubled) == 2 * doubled
    assert second == [0.0, doubled, 2 * doubled]
    # what fells it at a tilt that is sought says that it does not exceed it
    felled = next(tilt for tilt in first if tilt > 0.5)
    assert largest_survived(survives([]), sought=(felled,)) == 4 * doubled


def test_a_traverse_that_is_asked_of_a_tilt_says_on_which_side_it_falls(monkeypatch):
    """It falls back beyond 0.1 rad and forward beyond 0.3; what was tried is remembered."""
    tried = []

    def arrives(*, tilt, **way):
        tried.append(tilt)
        return -0.3 <= tilt <= 0.1

    monkeypatch.setattr(contact, "arrives", arrives)
    for descending, limit in ((False, 0.1), (True, 0.3)):
        found = made(descending=descending)
        assert found._falls_beyond(limit - 0.01)
        assert not found._falls_beyond(limit + 0.01)
        assert found._falls_beyond(limit - 0.05)
    assert len(tried) == len({*tried})
    # of what is sought the largest says all
    assert made(sought=(0.05, 0.02))._falls_beyond(0.2)
    assert made(sought=(0.2,))._falls_beyond(0.05)
    assert not made(sought=(0.2, 0.05))._falls_beyond(0.15)
    asked = made(sought=(0.05,), path=path_to(-1.0, NOSINGS[1] + 0.01))
    assert 0.05 < asked.falls_downhill.tilt <= 0.1
    assert asked.falls_downhill[1:] == asked.end
    # beyond what is enough it does not count where it falls
    assert made(enough=0.05)._falls_beyond(0.2)
    assert not made(enough=0.15)._falls_beyond(0.2)


def test_what_is_known_of_a_traverse_stays_known_where_something_else_is_sought(monkeypatch):
    monkeypatch.setattr(contact, "arrives", lambda *, tilt, **way: tilt <= 0.1)
    found = made()
    assert found._falls_beyond(0.05)
    vars(found).update(grip="grip", falls_downhill=Fall(0.1, Phase.LAND, 2))
    other = found.seeking((0.02,), enough=0.3)
    assert (other.sought, other.enough, other.grip) == ((0.02,), 0.3, "grip")
    assert other._survives is found._survives
    assert "falls_downhill" not in vars(other)


def test_tilts_of_which_nothing_is_known():
    assert largest_survived(lambda tilt: True) == math.inf
    assert largest_survived(lambda tilt: False) == -math.pi / 2


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("downhill", [False, True])
@pytest.mark.parametrize("beyond", [True, False])
def test_a_fall_is_looked_for_under_gravity_tilted_towards_it(
    descending, downhill, beyond, monkeypatch
):
    """It survives up to 0.1 rad; a little beyond that, or only where it fell, it is seen to fall.

    Gravity leans back for what lies behind: downhill going up, uphill going down.
    """
    back, driven = 1 if downhill is not descending else -1, []

    def arrives(*, tilt, acceleration, step, **way):
        assert tilt * back > 0
        assert (acceleration, step, way["x_end"]) == (0.5, 0.02, 3.0)
        return abs(tilt) <= 0.1

    def fallen(*, tilt, with_margins, **way):
        assert not with_margins
        driven.append(tilt * back)
        falls = beyond or len(driven) == 2
        status = Status.FELL_BACKWARD if falls else Status.OK
        return path_to(-1.0, NOSINGS[0] + 0.01, NOSINGS[2] + 0.01, status=status)

    monkeypatch.setattr(contact, "arrives", arrives)
    monkeypatch.setattr(contact, "traverse", fallen)
    monkeypatch.setattr(passage, "phases_of", lambda *args: PHASES)
    found = made(descending=descending, until=3.0)
    fall = found.falls_downhill if downhill else found.falls_uphill
    assert 0.1 - WITHIN <= fall.tilt <= 0.1
    assert fall[1:] == (Phase.TRAVERSE, 2 if descending else 3)
    assert driven[0] == pytest.approx(fall.tilt + math.radians(0.01))
    assert len(driven) == (1 if beyond else 2)
    assert 0.1 < driven[-1] <= fall.tilt + math.radians(0.01)


def test_a_fall_without_any_tilt_is_that_of_the_path(monkeypatch):
    monkeypatch.setattr(contact, "arrives", lambda *, tilt, **way: tilt <= -0.1)
    monkeypatch.setattr(passage, "phases_of", lambda *args: PHASES)
    path = path_to(-1.0, NOSINGS[0] + 0.01, NOSINGS[1] + 0.01)
    fall = made(status=Status.FELL_BACKWARD, path=path).falls_downhill
    assert -0.1 - WITHIN <= fall.tilt <= -0.1
    assert fall[1:] == (Phase.TRAVERSE, 2)
    assert made(status=Status.FELL_BACKWARD, path=path_to()).falls_downhill[1:] == (Phase.ENTER, 0)
    # beyond what is looked for nothing falls: the level path ends well
    monkeypatch.setattr(contact, "arrives", lambda **way: True)
    monkeypatch.setattr(contact, "traverse", None)
    assert made(path=path).falls_downhill == (math.inf, Phase.TRAVERSE, 2)


def test_of_a_part_the_criterion_judges_what_is_there():
    """Losses by the place of the centroid, whichever way the profile is driven."""
    kenaf = {"outline": OUTLINE, "step": 0.05, "with_margins": False}
    profile = Profile.of_stairs(Stairs.inclined(angle=0.5, nosing_spacing=0.15, steps=8))
    places = sorted(each.place for each in traverse(profile, **kenaf).criterion.losses)
    low, high = places[3] + 1e-3, places[-4] - 1e-3
    inside = [place for place in places if low <= place <= high]

    def there(**part):
        found = traverse(profile, **kenaf, **part).criterion
        return sorted(each.place for each in found.losses)

    assert there(until=high) == [place for place in places if place <= high]
    start = Placement(low, 0.9, 0.5)
    assert there(start=start) == [place for place in places if place >= low]
    assert there(start=start, until=high) == inside
    down = {"descending": True, "facing": "tail-first"}
    back = {"start": Placement(-high, 0.9, -0.5), "until": -low}
    assert there(**down, **back) == pytest.approx(inside)


def test_the_robot_and_its_acceleration_as_driven():
    kenaf = {"outline": OUTLINE, "step": 0.05, "with_margins": False, "acceleration": 0.5}
    up, down = (traverse(STEPS, **kenaf, descending=each) for each in (False, True))
    assert (up.acceleration, down.acceleration) == (0.5, -0.5)
    np.testing.assert_array_equal(up.outline.parts, OUTLINE.parts)
    tail = traverse(STEPS, **kenaf, facing="tail-first")
    np.testing.assert_array_equal(tail.outline.parts, OUTLINE.turned_round().parts)


# rocks and falls beyond what any robot keeps


def test_tilts_are_tried_as_far_as_it_rocks():
    assert passage._most(0.1) == LARGEST
    assert passage._most(1.0) == 1.0
    assert passage._most(3.0) == math.pi / 2


@pytest.mark.parametrize(
    ("tilt", "rocks", "most"),
    [(math.inf, (0.9, 1.2), 0.9), (math.inf, (1.2, 0.3), None), (0.4, (0.9, 1.2), None)],
)
def test_what_no_tilt_fells_is_tried_as_far_as_it_rocks(tilt, rocks, most, monkeypatch):
    found = made(
        criterion=Criterion(()),
        phases=[extremes(phase, each) for phase, each in zip((Phase.ENTER, Phase.LAND), rocks,
                                                             strict=True)],
    )  # fmt: skip
    known = Fall(tilt, Phase.LAND, 2)
    vars(found)["falls_downhill"] = known
    monkeypatch.setattr(Traverse, "_fall", lambda self, **how: how)
    expected = known if most is None else {"downhill": True, "most": most}
    assert found._limiting_fall == expected


def test_a_fall_just_there_is_none_beyond_and_enough_is_not_driven(monkeypatch):
    monkeypatch.setattr(Traverse, "_survived", lambda self, back, sought, most: 0.1)
    monkeypatch.setattr(contact, "traverse", lambda **how: pytest.fail("driven"))
    assert not made()._falls_beyond(0.1)
    found = made(enough=0.1, path=path_to(-1.0, NOSINGS[1] + 0.01))
    assert found._fall(downhill=True) == (0.1, *found.end)


def test_a_fall_counts_in_the_phases_that_are_looked_at(monkeypatch):
    """It is looked for a little beyond the first rock."""
    sought = []
    monkeypatch.setattr(
        Traverse, "_falls_beyond", lambda self, tilt: (sought.append(tilt), False)[1]
    )
    on, lands = extremes(Phase.TRAVERSE, 0.3, step=2), extremes(Phase.LAND, 0.35, step=4)
    found = made(whole=False, phases=(on, lands), criterion=Criterion(()))
    vars(found)["falls_downhill"] = Fall(0.15, Phase.LAND, 3)
    assert found.first_rock(downhill=True) == (0.15, Phase.LAND, 3)
    assert found.first_rock(downhill=True, phases=(lands, on)) == (0.15, Phase.LAND, 3)
    assert found.first_rock(downhill=True, phases=(on,)) == (0.3, Phase.TRAVERSE, 2)
    assert all(0.3 < each < 0.3 + 1e-5 for each in sought)


def test_where_it_may_fall_before_it_rocks():
    """Steps alike, all on one flight: only down over the edge, or over a first riser higher."""

    def steps(first, lifted=0.0):
        points = [(-1, 0), (0, 0), (0, first)]
        for k in range(1, 4):
            points += [(0.3 * k, first + 0.1 * (k - 1)), (0.3 * k, first + 0.1 * k)]
        return Profile.of_points(np.add([*points, (3, first + 0.3)], (0.0, lifted)))

    for lifted in (0.0, 1.0, -1.0):
        assert not made(profile=steps(0.1, lifted))._may_fall_first
        assert not made(profile=steps(0.05, lifted))._may_fall_first
        assert made(profile=steps(0.15, lifted))._may_fall_first
        assert made(profile=steps(0.1, lifted), descending=True)._may_fall_first
    assert made(whole=False)._may_fall_first
