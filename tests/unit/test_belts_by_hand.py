"""Belts as their sheets state them, and as nobody does: cases of grousers and their figures."""

from types import SimpleNamespace

import pytest

from kaidan import Profile, Stairs
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.grousers import standing_run
from kaidan.mechanics.rubber import height_lost, rubber_modulus
from kaidan.models import belts
from kaidan.models import traction as module
from kaidan.models.belts import HEIGHT, SPACING, TIP_WIDTH, YIELD, grousers_of, nosing_radii
from kaidan.models.traction import (
    FASTEST,
    Supplies,
    Supply,
    figures_of,
    too_fast_on_grousers,
)
from kaidan.modes import GROUSER_SPEED, OPEN, Phase
from kaidan.robot import Track
from kaidan.terrain.stairs import NOSING_RADII

RADII = 0.002, 0.007
FLIGHT = Stairs(
    rise=0.17, going=0.29, nosing_radius_low=RADII[0], nosing_radius_high=RADII[1], steps=6
)
KNOWN = {
    "belt": "grousers", "grouser_height": 0.012, "grouser_spacing": 0.04,
    "grouser_tip_width": 0.006, "width": 0.1,
}  # fmt: skip


def asked(*, terrain=FLIGHT, mass=20.0, speed=None, surface=None, **track):
    belts = Track(flat_length=0.5, front_radius=0.08, rear_radius=0.08, **track)
    return SimpleNamespace(
        terrain=terrain, stance=SimpleNamespace(mass=mass), robot=SimpleNamespace(track=belts),
        speed=speed, surface=surface,
    )  # fmt: skip


def cases(question, *, best=False):
    return grousers_of(question, question.robot.track, best=best)


def test_grousers_whose_figures_are_known_lose_height_or_not():
    """In the worst case hard ones and soft ones, on the roundest nosing; in the best case one."""
    question = asked(**KNOWN)
    hard, soft = cases(question)
    least, most = YIELD
    assert hard == pytest.approx((0.012 * (1 - least), 0.04, 0.006, RADII[1], True))
    assert soft == pytest.approx((0.012 * (1 - most), 0.04, 0.006, RADII[1], False))
    assert cases(question, best=True) == (
        pytest.approx((0.012 * (1 - least), 0.04, 0.006, RADII[0], False)),
    )


def test_grousers_of_which_nothing_is_known_are_each_case_of_a_range():
    """Low, with tips that take most room, as near and as far apart as any; or high and narrow."""
    question = asked(belt="grousers")
    hard = [
        (HEIGHT[0] * (1 - YIELD[0]), spacing, TIP_WIDTH[1] * spacing, RADII[1], True)
        for spacing in SPACING
    ]
    soft = (HEIGHT[0] * (1 - YIELD[1]), SPACING[1], TIP_WIDTH[1] * SPACING[1], RADII[1], False)
    assert [tuple(each) for each in cases(question)] == [pytest.approx(e) for e in (*hard, soft)]
    best = (HEIGHT[1] * (1 - YIELD[0]), SPACING[0], TIP_WIDTH[0] * SPACING[0], RADII[0], False)
    assert [tuple(each) for each in cases(question, best=True)] == [pytest.approx(best)]


def test_of_a_known_hardness_half_of_the_weight_presses_and_pulls():
    """The other half is the other track's; of what lacks a figure nobody knows."""
    known = {**KNOWN, "grouser_hardness": 70.0}
    half = 0.5 * 20.0 * STANDARD_GRAVITY
    lost = float(height_lost(N=half, T=half, h=0.012, w=0.006, b=0.1, E=rubber_modulus(S=70.0)))
    assert 1e-5 < lost < 0.006  # a figure that can be told from none and from half
    hard, soft = cases(asked(**known))
    assert (hard.height, soft.height) == pytest.approx((0.012, 0.012 - lost))
    for lacking in ("grouser_tip_width", "width", "grouser_hardness"):
        hard, soft = cases(asked(**{**known, lacking: None}))
        assert (hard.height, soft.height) == pytest.approx((0.012, 0.006))
    question = asked(**known)
    question.stance.mass = None
    assert cases(question)[1].height == pytest.approx(0.006)
    assert belts._lost(asked(**known), asked(**known).robot.track, 0.0) == YIELD


def test_nosings_of_all_flights_count_and_those_of_points_are_any():
    other = FLIGHT.model_copy(update={"nosing_radius_low": 0.001, "nosing_radius_high": 0.005})
    assert nosing_radii(asked()) == RADII
    for flights in ((FLIGHT, other), (other, FLIGHT)):
        assert nosing_radii(asked(terrain=flights)) == (0.001, 0.007)
    points = Profile.of_points([(-2, 0), (0, 0), (0, 0.2), (2, 0.2)])
    assert nosing_radii(asked(terrain=points)) == NOSING_RADII


@pytest.mark.parametrize(
    ("speed", "grousers", "spare"),
    [
        (FASTEST, True, 0.0), (FASTEST + 0.1, True, -0.1), (FASTEST - 1e-9, True, None),
        (None, True, None), (FASTEST + 0.1, False, None),
    ],
)  # fmt: skip
def test_grousers_as_fast_as_they_spun(speed, grousers, spare):
    found = too_fast_on_grousers(asked(speed=speed, belt="grousers" if grousers else "smooth"))
    assert len(found) == (spare is not None)
    for one in found:
        assert (one.mode, one.if_fails) == (GROUSER_SPEED, OPEN)
        assert one.worst == pytest.approx([spare])


# figures


def held(**given):
    usual = {"margin": 0.1, "required": 0.4, "phase": Phase.LAND, "step": 3, "slip": 0.0,
             "heights": {}}  # fmt: skip
    return Supplies(worst=Supply(**(usual | given)), best=None)


@pytest.fixture
def usual(monkeypatch):
    """Friction that the usual grousers require, of the belts that were asked."""
    tracks = []

    def supply(question, found, track, *, phase):
        tracks.append((track, phase))
        return SimpleNamespace(required=0.3)

    monkeypatch.setattr(module, "supply", supply)
    return tracks


@pytest.mark.parametrize("belt", ["smooth", None, "grousers"])
@pytest.mark.parametrize("stated", [False, True])
def test_usual_grousers_are_told_where_nothing_is_stated_and_none_are_there(belt, stated, usual):
    question = asked(belt=belt, surface="concrete" if stated else None)
    found = figures_of(question, SimpleNamespace(phases=()), 0.5, None, Phase.LAND)
    told = belt != "grousers" and not stated
    assert found.usual_required_friction == (0.3 if told else None)
    belts = Track(flat_length=1.0, grouser_height=0.010, grouser_spacing=0.040)
    assert usual == [(belts, Phase.LAND)] * told
    assert found.belt == (belt or "not stated")
    assert (found.required_friction, found.phase, found.step) == (0.5, None, None)
    assert (found.slip_mm, found.slip_heights_mm) == (None, {})


def test_figures_of_grousers_after_a_slip():
    question = asked(**KNOWN)
    slips = held(slip=0.04, heights={Phase.TRAVERSE: 2e-3})
    found = figures_of(question, SimpleNamespace(phases=()), 0.5, slips, None)
    assert (found.required_friction, found.smooth_required_friction) == (0.4, 0.5)
    assert (found.phase, found.step, found.slip_mm) == ("land", 3, pytest.approx(40.0))
    assert found.slip_heights_mm == {"traverse": pytest.approx(2.0)}
    still = figures_of(question, SimpleNamespace(phases=()), 0.5, held(phase=None, step=None), None)
    assert (still.phase, still.slip_mm) == (None, None)
    assert found.strength_margin_N is None


def test_share_of_the_phases_in_which_a_grouser_stands():
    question = asked(**KNOWN)
    found = figures_of(question, SimpleNamespace(phases=()), 0.5, held(), None)
    worst, best = (
        float(standing_run(theta=FLIGHT.angle, h=0.012, r=r)) / 0.04 for r in (RADII[1], RADII[0])
    )
    assert 0.0 < worst < best < 1.0
    assert found.standing_phases == pytest.approx((worst, best))
    # so round that a tip misses it: none
    round_ones = FLIGHT.model_copy(update={"nosing_radius_high": 0.025})
    question = asked(**{**KNOWN, "grouser_height": 0.002}, terrain=round_ones)
    found = figures_of(question, SimpleNamespace(phases=()), 0.5, held(), None)
    assert found.standing_phases[0] == 0.0
    # of points and of other belts nobody knows
    points = Profile.of_points([(-2, 0), (0, 0), (0, 0.2), (2, 0.2)])
    for other in (asked(**KNOWN, terrain=points), asked(belt="smooth", surface="concrete")):
        found = figures_of(other, SimpleNamespace(phases=()), 0.5, held(), None)
        assert found.standing_phases is None
