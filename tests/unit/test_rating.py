"""Postures rated in one call: the same figures as those of a traverse of each alone."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import Placement
from kaidan.models.traction import gripping
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Posture, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Phase, rating, traverse
from kaidan.traversal.driving import span
from kaidan.traversal.rating import Part, _tips, rate
from kaidan.traversal.rotations import slopes_of_flights
from kaidan.traversal.samples import lasting, trailing_end_leaves

ABSOLEM = Robot.named("absolem")
STAIRS = Profile.of_stairs(Stairs(rise=0.178, going=0.279, steps=5))
ANGLES = [(None, None), ("flat", "flat"), (0.6, -0.2), (-0.8, 0.3), (1.2, -1.0)]


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("acceleration", [0.0, 0.3])
def test_a_rating_is_that_of_the_traverse(descending, acceleration):
    # oracle: the traverse with its poses, figure by figure
    x = 0.279 * 4 - 0.05
    places = [(None, None), (Placement(x, 0.0, 0.0 if descending else 0.5), None), (None, x)]
    if descending:
        places = [(None, None)]
    outlines = [Outline.of(ABSOLEM, Posture(front=f, rear=r)) for f, r in ANGLES]
    parts = [Part(outline, *place) for outline in outlines for place in places]
    manner = {"descending": descending, "acceleration": acceleration, "step": 0.02}
    downhill, uphill = 0.05, 0.03  # tilts of gravity
    rated = rate(STAIRS, parts, tilts=(downhill, uphill), **manner)
    trailing_and_leading = (uphill, downhill) if descending else (downhill, uphill)
    arrived = 0
    for each, part in zip(rated, parts, strict=True):
        found = traverse(STAIRS, part.outline, start=part.start, until=part.until, **manner)
        assert (each is not None) == found.arrived
        if each is None:
            continue
        arrived += 1
        landing = found.phase_of_pose == Phase.LAND.value
        held = ~(trailing_end_leaves(found.path) & landing)
        margins = found.path.margins
        assert each.required_friction == np.nan_to_num(
            margins.required_friction[held], nan=math.inf
        ).max(initial=0.0)
        assert each.belly_touches == margins.belly_touches.any()
        chains = found.chains
        assert each.rotation == pytest.approx(max((c.angle for c in chains), default=0.0))
        assert each.rocking == pytest.approx(max((c.rocking for c in chains), default=0.0))
        assert each.impact_speed == pytest.approx(
            max((c.impact_speed for c in chains), default=0.0)
        )
        assert each.spare == pytest.approx(
            min((c.spare(trailing_and_leading) for c in chains), default=math.inf)
        )
        for margin, side in ((each.downhill, True), (each.uphill, False)):
            losses = found.criterion.losses if found.whole else ()
            of_side = [each.margin for each in losses if each.downhill is side]
            assert margin == min(of_side, default=math.inf)
    assert arrived >= 3


KENAF = Outline.of(Robot.named("kenaf"))
LONGER = Track(flat_length=0.6, front_radius=0.06, rear_radius=0.06)
UNEVEN = Profile.of_stairs(
    Stairs(rises=(0.07, 0.09, 0.07, 0.07, 0.07, 0.05, 0.07, 0.07), goings=(0.13,) * 7)
)


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("part", ["start", "until", "both", "none"])
def test_of_a_part_the_criterion_judges_what_is_there(descending, part):
    """The same losses as of a traverse of that part; elsewhere the flight is worse."""
    facing, outline = "nose-first", KENAF
    if descending:
        facing, outline = "tail-first", KENAF.turned_round()
    driven = UNEVEN.reflected() if descending else UNEVEN
    x = -0.5 if descending else 0.4
    given = {"start": (Placement(x, 0.3, 0.3), None), "until": (None, x - 0.2),
             "both": (Placement(x, 0.3, 0.3), x + 0.1), "none": (None, None)}[part]  # fmt: skip
    found = traverse(
        UNEVEN, KENAF, descending=descending, facing=facing, start=given[0], until=given[1],
        with_margins=False, step=0.05,
    ).criterion  # fmt: skip
    expected = tuple(
        min((each.margin for each in found.losses if each.downhill is side), default=math.inf)
        for side in (True, False)
    )
    ends = span(driven, outline, *given)
    assert _tips(driven, Part(outline, *given), ends, 0.0) == expected
    whole = _tips(driven, Part(outline, None, None), span(driven, outline, None, None), 0.0)
    assert (expected != whole) is (part != "none")


@pytest.mark.parametrize("descending", [False, True])
def test_rocking_is_that_of_the_traverse(descending):
    """On flights where most turns are from one side of the mean slope to the other."""
    rng = np.random.default_rng(0)
    longer = Outline.of(Robot.named("kenaf").model_copy(update={"track": LONGER}))
    beside = 0
    for _ in range(6):
        rises, goings = (each + rng.uniform(-8e-3, 8e-3, 10) for each in (0.096, 0.115))
        flight = Profile.of_stairs(Stairs(rises=tuple(rises), goings=tuple(goings[1:])))
        parts = [Part(KENAF), Part(longer)]
        for part, each in zip(parts, rate(flight, parts, descending=descending), strict=True):
            found = traverse(flight, part.outline, descending=descending)
            assert (each is not None) == found.arrived
            if each is not None:
                of_chains = [chain.rocking for chain in found.chains]
                assert each.rocking == pytest.approx(max(of_chains, default=0.0))
                beside += max(chain.avoidable for chain in found.chains) > each.rocking + 1e-3
    assert beside


def test_each_robot_is_rated_with_the_landings_that_are_as_long_as_it(monkeypatch):
    """So what is rated beside it changes nothing."""
    asked, kernel = [], contact.rate_many

    def rate_many(*given, **how):
        asked.append((given[3], how["zones"]))
        return kernel(*given, **how)

    monkeypatch.setattr(contact, "rate_many", rate_many)
    longer = Outline.of(Robot.named("kenaf").model_copy(update={"track": LONGER}))
    short, long = KENAF.stance.flat_length, longer.stance.flat_length
    nosings = [(0.0, 0.1), (0.5 * (short + long), 0.2)]
    terrain = Profile.of_points([(-9, 0), (0, 0), nosings[0], (nosings[1][0], 0.1), nosings[1],
                                 (9, 0.2)])  # fmt: skip
    parts = [Part(KENAF), Part(longer), Part(KENAF)]
    found = rate(terrain, parts)
    assert [lengths for lengths, _ in asked] == [[short, short], [long]]
    assert [len(zones) for _, zones in asked] == [3, 2]
    assert found == [rate(terrain, [each])[0] for each in parts]


def test_what_is_asked_of_the_kernel(monkeypatch):
    """The longest way is refused if any."""
    asked, refused = {}, []

    def rate_many(ground, parts, kinds, lengths, flights, jobs, **how):
        asked.update(jobs=jobs, lengths=lengths, flights=flights, **how)
        nothing = np.zeros(len(jobs))
        names = ("required_friction", "belly_touches", "largest_rotation", "rocking",
                 "impact_speed", "spare", "held", "held_at_best")  # fmt: skip
        return SimpleNamespace(status=np.array([0, 1, 0]), **dict.fromkeys(names, nothing))

    monkeypatch.setattr(contact, "rate_many", rate_many)
    monkeypatch.setattr(rating, "landing_zones", lambda driven, descending, room: ((1.0,) * 4,))
    monkeypatch.setattr(rating, "refuse_too_long", lambda *given: refused.append(given))
    longer = Outline.of(Robot.named("kenaf").model_copy(update={"track": LONGER}))
    start = Placement(0.4, 0.3, 0.3)
    parts = [Part(KENAF, start, None), Part(longer, None, None), Part(KENAF, None, 0.5)]
    found = rate(UNEVEN, parts, step=0.05)
    assert [each is None for each in found] == [False, True, False]
    assert asked["zones"] == ((1.0,) * 4,)
    assert asked["lengths"] == [each.outline.stance.flat_length for each in parts]
    assert asked["flights"] == [slopes_of_flights(UNEVEN, each) for each in asked["lengths"]]
    ((_, outline, ends, step),) = refused
    assert (outline, ends, step) == (longer, span(UNEVEN, longer, None, None), 0.05)
    assert [(each.terrain, each.robot) for each in asked["jobs"]] == [(0, 0), (0, 1), (0, 2)]
    assert [each.inclination for each in asked["jobs"]] == [0.3, 0.0, 0.0]


ROBOTS = {name: Robot.named(name) for name in ("kenaf", "marv")}
ON_GROUSERS = {"belt": "grousers", "grouser_height": 0.012, "grouser_spacing": 0.05}


def close_to_one_another(going):
    points = [(-2.0, 0.0)]
    for k in range(16):
        points += [(k * going, 0.4 * k * going), (k * going, 0.4 * (k + 1) * going)]
    return Profile.of_points([*points, (16 * going + 2.0, points[-1][1])])


def held_by(found, case):
    grip, rows = found.grip, lasting(found.path) & ~found.comes_off
    own = grip.by_friction(case.phi, case.grousers.height if case.grousers.rigid else 0.0)
    return float(grip.with_grousers(case.phi, case.grousers, own)[rows].min())


@pytest.mark.parametrize("friction", [(0.7, 0.9), (0.5, 0.5)])
@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("figures", [{"belt": "grousers"}, ON_GROUSERS])
@pytest.mark.parametrize("going", [0.279, 0.09])
def test_how_grousers_hold_is_that_of_the_traverse(going, figures, direction, friction):
    # oracle: the grip of the traverse with its poses; there is room for eight supports
    many = going < 0.1
    stairs = close_to_one_another(going) if many else STAIRS
    robot = ROBOTS["kenaf" if many else "marv"]
    robot = robot.model_copy(update={"track": robot.track.model_copy(update=figures)})
    postures = [Posture()] if many else [Posture(front=f, rear=r) for f, r in ANGLES]
    asked = [
        Question.of(robot, stairs, friction=friction, direction=direction, flippers=each)
        for each in postures
    ]
    belts = gripping(asked[0])
    down = direction == "down"
    outlines = [each.outline for each in asked]
    manner = {"descending": down, "step": 0.04}
    rated = rate(stairs, [Part(each) for each in outlines], belts=belts, **manner)
    smooth = rate(stairs, [Part(each) for each in outlines], **manner)
    most = 0
    for question, each, plain in zip(asked, rated, smooth, strict=True):
        found = traverse(stairs, question.outline, **manner)
        assert (each is not None) == found.arrived
        if each is None:
            continue
        assert each._replace(held=math.inf, held_at_best=math.inf) == plain
        for best, margin in ((False, each.held), (True, each.held_at_best)):
            known = min(held_by(found, case) for case in belts if case.best == best)
            assert margin == pytest.approx(known, abs=1e-5)
        most = max(most, found.grip._points.shape[1])
    assert (most > 4) is many


def test_of_more_supports_than_there_is_room_for_nothing_is_known():
    kenaf = ROBOTS["kenaf"]
    robot = kenaf.model_copy(update={"track": kenaf.track.model_copy(update=ON_GROUSERS)})
    close = close_to_one_another(0.04)
    question = Question.of(robot, close, friction=0.9, flippers="stowed")
    (found,) = rate(close, [Part(question.outline)], belts=gripping(question), step=0.04)
    assert found.held == found.held_at_best == math.inf


def test_grousers_of_which_is_not_known_how_they_hold():
    """Without a surface, where there are none, or none that bear."""
    marv = ROBOTS["marv"]
    robot = marv.model_copy(update={"track": marv.track.model_copy(update=ON_GROUSERS)})
    known = Question.of(robot, STAIRS, friction=(0.6, 0.9), flippers="flat")
    cases = gripping(known)
    assert [each.best for each in cases] == [False] * 2 + [True]
    assert [each.phi for each in cases] == [(math.atan(each),) * 3 for each in (0.6, 0.6, 0.9)]
    assert gripping(Question.of(robot, STAIRS, flippers="flat")) is None
    assert gripping(known.changed(robot=marv)) is None
    weak = robot.track.model_copy(update={"grouser_strength": 1e-3})
    assert gripping(known.changed(robot=robot.model_copy(update={"track": weak}))) is None
