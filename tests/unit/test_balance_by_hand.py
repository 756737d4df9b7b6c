"""Findings of tipping, falls, rotations and energy, by hand: no kernel runs."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.contact import Status
from kaidan.models import balance as module
from kaidan.models.balance import _energy, _falls, _hits, _least, _rocking, _tips, balance
from kaidan.models.findings import Finding
from kaidan.models.spread import Spread
from kaidan.modes import (
    ENERGY,
    FALL_DOWNHILL,
    FALL_UPHILL,
    IMPACT,
    MOMENTUM,
    ROTATION,
    TIP_DOWNHILL,
    TIP_UPHILL,
    Phase,
)
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Fall, FirstRock
from kaidan.traversal.rotations import ROCKING, TAKEN_UP

NONE = np.zeros(3)
OVER = Spread(*[NONE] * 10)
ON, LANDS = SimpleNamespace(phase=Phase.TRAVERSE), SimpleNamespace(phase=Phase.LAND)
ASKED = SimpleNamespace(
    yaw=0.0, terrain=None, energy_threshold=lambda slip=0.0: 0.01 + 0.5 * slip,
    momentum_threshold=lambda: 0.015,
    robot=SimpleNamespace(tolerated_impact=0.5),
    allowance_d=SimpleNamespace(low=0.01, high=0.02),
    allowance_M=SimpleNamespace(low=0.03, high=0.05),
)  # fmt: skip


def given(mode, worst, best=None, **more):
    best = worst if best is None else best
    return Finding(mode=mode, worst=np.array(worst), best=np.array(best), model="", **more)


def chain(phase=Phase.ENTER, step=1, *, spare=0.03, after=0.04, **figures):
    """Its rises to spare are of so much and less by the tilts of gravity, in metres."""
    usual = {
        "angle": 0.1, "rocking": 0.0, "impact_speed": 0.2, "arrested": True,
        "spare": lambda tilts: spare - tilts[0] - 0.1 * tilts[1],
        "spare_after_impact": lambda tilts: after - tilts[0] - 0.1 * tilts[1],
    }  # fmt: skip
    return SimpleNamespace(phase=phase, step=step, **(usual | figures))


def found(**figures):
    usual = {
        "status": Status.OK, "arrived": True, "descending": False, "whole": True, "chains": [],
        "phases": (ON, LANDS), "criterion": SimpleNamespace(rocking=0.0),
        "falls_downhill": Fall(0.1, Phase.TRAVERSE, 3), "falls_uphill": Fall(0.2, Phase.LAND, 4),
        "end": (Phase.LAND, 6), "first_rock": lambda **_: None, "enough": math.inf,
    }  # fmt: skip
    return SimpleNamespace(**(usual | figures))


def test_tips_are_the_first_rock_of_whichever_phase_less_the_allowances():
    """Of each sample: traversing 0.2 + (0, 0.1, -0.1), landing 0.21 + (0, -0.05, 0.2) downhill."""
    over = OVER._replace(
        tip_downhill=np.array([0.0, 0.1, -0.1]), landing=np.array([0.0, -0.05, 0.2]),
        tip_uphill=np.array([0.0, 0.0, -0.01]),
    )  # fmt: skip
    rocks = {
        True: {Phase.TRAVERSE: 0.2, Phase.LAND: 0.21}, False: {Phase.TRAVERSE: 0.3},
    }  # fmt: skip

    def first_rock(*, downhill, phases):
        some = [each.phase for each in (ON, LANDS) if phases is None or each in phases]
        each = [FirstRock(rocks[downhill][one], one, 2) for one in some if one in rocks[downhill]]
        return min(each, default=None)

    phases = (SimpleNamespace(phase=Phase.ENTER), ON, LANDS)  # entering it never rocks
    down, up = _tips(ASKED, ASKED, found(first_rock=first_rock, phases=phases), over, None)
    assert (down.mode, down.phase, down.step) == (TIP_DOWNHILL, Phase.TRAVERSE, 2)
    assert (down.instead, up.instead, up.mode) == (None, None, TIP_UPHILL)
    assert down.worst == pytest.approx(np.array([0.2, 0.16, 0.1]) - 0.07)
    assert down.best == pytest.approx(np.array([0.2, 0.16, 0.1]) - 0.04)
    assert up.worst == pytest.approx(np.array([0.3, 0.3, 0.29]) - 0.02)
    assert up.best == pytest.approx(np.array([0.3, 0.3, 0.29]) - 0.01)
    (lands,) = _tips(ASKED, ASKED, found(first_rock=first_rock), over, Phase.LAND)
    assert (lands.mode, lands.phase) == (TIP_DOWNHILL, Phase.LAND)
    assert lands.worst == pytest.approx(np.array([0.21, 0.16, 0.41]) - 0.07)
    rocks[True] = {}
    (only,) = _tips(ASKED, ASKED, found(first_rock=first_rock), over, None)
    assert only.mode is TIP_UPHILL


@pytest.fixture
def falls(monkeypatch):
    """Falls as mode, margins, place; and samples of each whose tilt to the fall counts."""
    drawn = {True: np.array([-0.2, 0.3, -9.0]), False: np.array([0.4, -0.5, 0.6])}

    def of(tips=(), rotation=(1.0,) * 3, phase=None, **figures):
        counted = []

        def drawn_falls(question, run, samples, counts, *, downhill):
            assert samples is (OVER.tip_downhill if downhill else OVER.tip_uphill)
            counted.append(counts.tolist())
            return drawn[downhill]

        monkeypatch.setattr(module, "drawn_falls", drawn_falls)
        each = _falls(ASKED, found(**figures), OVER, list(tips), given(ROTATION, rotation), phase)
        told = [(e.mode, e.worst.tolist(), e.best.tolist(), e.phase, e.step) for e in each]
        return told, counted

    return of


ROCKS = given(TIP_DOWNHILL, [-0.1, 0.1, -0.1], [0.2, 0.2, -0.05])
STANDS = given(TIP_UPHILL, [0.1, 0.1, 0.1])
TO_DOWNHILL, TO_UPHILL = (Phase.TRAVERSE, 3), (Phase.LAND, 4)
RIGHT = math.pi / 2


def test_of_samples_that_rock_the_larger_of_both_margins_counts(falls):
    told, counted = falls((ROCKS, STANDS))
    assert counted == [[True, False, True]]
    worst, best = [-0.1, 0.3, -0.1], [0.2, 0.3, -0.05]
    assert told == [(FALL_DOWNHILL, worst, best, *TO_DOWNHILL)]
    both = (given(TIP_DOWNHILL, [0.1] * 3), given(TIP_UPHILL, [0.1, -0.1, 0.1]))
    told, counted = falls(both)
    assert counted == [[False, True, False]]
    assert told == [(FALL_UPHILL, [0.4, -0.1, 0.6], [0.4, -0.1, 0.6], *TO_UPHILL)]
    assert falls((STANDS, given(TIP_DOWNHILL, [0.1] * 3))) == ([], [])


def test_what_rotates_counts_by_its_fall_alone(falls):
    """A rotation is one over the downhill end; none takes off more than a right angle."""
    told, counted = falls(rotation=(-1.0, 1.0, -1.0))
    assert counted == [[True, False, True]]
    margins = [-0.2, math.inf, -RIGHT]
    assert told == [(FALL_DOWNHILL, margins, margins, *TO_DOWNHILL)]
    told, counted = falls((ROCKS,), rotation=(-1.0, 1.0, 1.0))
    assert counted == [[True, False, True]]
    assert told[0][1] == [-0.2, 0.3, -0.1]


@pytest.mark.parametrize("descending", [False, True])
@pytest.mark.parametrize("status", [Status.FELL_BACKWARD, Status.FELL_FORWARD])
def test_one_that_falls_falls_over_one_end(status, descending, falls):
    downhill = (status is Status.FELL_BACKWARD) is not descending
    told, counted = falls((ROCKS,), status=status, arrived=False, descending=descending)
    mode, place = (FALL_DOWNHILL, TO_DOWNHILL) if downhill else (FALL_UPHILL, TO_UPHILL)
    margins = [-0.2, 0.3, -RIGHT] if downhill else [0.4, -0.5, 0.6]
    assert told == [(mode, margins, margins, *place)]
    assert counted == [[True, True, True] if downhill else [True]]


def test_which_falls_are_of_a_phase(falls):
    both = (ROCKS, given(TIP_UPHILL, [-0.1] * 3))
    for phase, modes in ((None, [FALL_DOWNHILL, FALL_UPHILL]), (Phase.LAND, [FALL_UPHILL]),
                         (Phase.TRAVERSE, [FALL_DOWNHILL]), (Phase.ENTER, [])):  # fmt: skip
        assert [each[0] for each in falls(both, phase=phase)[0]] == modes
    assert falls(both, status=Status.STUCK, arrived=False)[0] == []


def test_how_hard_rotations_end_and_what_momentum_is_left():
    """Of those alike the first; what the rubber takes up has no momentum."""
    chains = [
        chain(step=4, impact_speed=0.6, spare=0.04, after=0.05),
        chain(step=1, impact_speed=0.3, spare=0.0300005, after=0.06),
        chain(step=2, impact_speed=0.7, spare=0.0300000, after=0.05),
        chain(step=3, impact_speed=0.7, angle=TAKEN_UP, spare=-1.0, after=-1.0),
    ]
    hit, momentum = _hits(ASKED, found(), chains)
    assert (hit.mode, hit.worst, hit.step) == (IMPACT, pytest.approx(-0.2), 2)
    assert (momentum.mode, momentum.instead, momentum.phase) == (MOMENTUM, None, Phase.ENTER)
    # downhill theta_d and theta_M, uphill theta_d; stop and sag take 0.015
    assert momentum.worst.tolist() == pytest.approx([0.0300005 - 0.07 - 0.002 - 0.015])
    assert momentum.best.tolist() == pytest.approx([0.05 - 0.04 - 0.001])
    assert momentum.step == 1
    momentum = _hits(ASKED, found(descending=True), chains)[1]  # its leading end is downhill
    assert momentum.worst.tolist() == pytest.approx([0.0300005 - 0.02 - 0.007 - 0.015])
    assert momentum.best.tolist() == pytest.approx([0.05 - 0.01 - 0.004])
    assert [each.mode for each in _hits(ASKED, found(), chains[3:])] == [IMPACT]


@pytest.mark.parametrize(
    ("status", "margin"),
    [(Status.OK, math.inf), (Status.STUCK, math.inf), (Status.FELL_BACKWARD, math.nan),
     (Status.FELL_FORWARD, math.nan)],
)  # fmt: skip
def test_without_any_rotation(status, margin):
    (hit,) = _hits(ASKED, found(status=status), [])
    assert hit.worst.tolist() == pytest.approx([margin], nan_ok=True)
    assert (hit.instead, hit.phase, hit.step) == (None, None, None)


def test_rocking_is_what_was_seen_or_is_foretold():
    seen = [chain(rocking=0.01, step=2), chain(rocking=0.03, step=4, phase=Phase.TRAVERSE)]
    over = OVER._replace(rocking=np.array([0.0, -0.02, 0.04]))

    def rocks(of, foretold=0.0, phase=None, **figures):
        run = found(chains=of, criterion=SimpleNamespace(rocking=foretold), **figures)
        each = _rocking(run, over, phase)
        return each.phase, each.step, (ROCKING - each.worst).tolist(), each.best.tolist()

    path = (Phase.TRAVERSE, 4, [pytest.approx(0.03)], [pytest.approx(ROCKING - 0.03)])
    # foretold 0.02, 0 and 0.06 of the samples; the path alone tells of 0.03 at least
    both = [pytest.approx(0.03), pytest.approx(0.03), pytest.approx(0.06)]
    assert rocks(seen, 0.02) == (
        Phase.TRAVERSE, None, both, [pytest.approx(ROCKING - each) for each in (0.03, 0.03, 0.06)],
    )  # fmt: skip
    assert rocks(seen, 0.02, Phase.TRAVERSE)[1] is None
    enters = (Phase.ENTER, 2, [pytest.approx(0.01)], [pytest.approx(ROCKING - 0.01)])
    assert rocks(seen, 0.02, Phase.ENTER) == enters
    assert rocks(seen, 0.02, whole=False) == path
    assert rocks(seen, -0.02) == path  # 0.02 at most
    over = OVER
    assert rocks(seen, 0.03) == path  # alike
    assert rocks(seen, 0.031)[1] is None
    still = _rocking(found(), OVER, None)
    assert (still.worst.tolist(), still.phase) == ([math.inf], None)


def of_phase(phase, down, up=math.inf, step=1, uphill_step=2):
    return SimpleNamespace(
        phase=phase, steadiness=(down, step), uphill_steadiness=(up, uphill_step)
    )


def test_the_least_energy_of_the_phases_by_hand():
    """Less the threshold of 10 mm, which a slip back onto grousers raises by half its height here,
    downhill.
    """
    phases = (
        of_phase(Phase.ENTER, 0.09, 0.001, step=1),
        of_phase(Phase.TRAVERSE, 0.08, 0.07, step=3, uphill_step=5),
        of_phase(Phase.LAND, 0.07 - 1e-7, 0.002, step=8),
    )
    over = OVER._replace(rise=np.array([0.0, 0.0, -0.01]), landing_rise=np.array([0, -0.02, 0]))

    def energy(*, held=None, of=phases, **more):
        figures = {key: more.pop(key) for key in ("status", "descending") if key in more}
        each = _energy(ASKED, found(**figures), over, of, held, **more)
        assert (each.mode, each.instead) == (ENERGY, None)
        margins = [(0.01 + side).tolist() for side in (each.worst, each.best)]
        return each.phase, each.step, *margins

    least = [pytest.approx(each, abs=2e-7) for each in (0.07, 0.05, 0.06)]
    assert energy() == (Phase.TRAVERSE, 5, least, least)  # uphill, of the two alike the first
    held = SimpleNamespace(
        worst=SimpleNamespace(heights={Phase.TRAVERSE: 0.10, Phase.ENTER: 0.06}),
        best=SimpleNamespace(heights={Phase.TRAVERSE: 0.08, Phase.ENTER: 0.02}),
    )
    worst = [pytest.approx(each) for each in (0.03, 0.03, 0.02)]
    best = [pytest.approx(each) for each in (0.04, 0.04, 0.03)]
    assert energy(held=held) == (Phase.TRAVERSE, 3, worst, best)
    # beside the flight: entering, going down landing
    enter = [pytest.approx(0.09)]
    assert energy(flight=False) == (Phase.ENTER, 1, enter, enter)
    worst, best = [pytest.approx(0.06)], [pytest.approx(0.08)]
    assert energy(held=held, flight=False) == (Phase.ENTER, 1, worst, best)
    assert energy(flight=False, descending=True)[:2] == (Phase.LAND, 8)
    # one that falls has none, where it falls
    for status in (Status.FELL_BACKWARD, Status.FELL_FORWARD):
        assert energy(status=status) == (Phase.LAND, 6, [0.0], [0.0])
        assert energy(status=status, of=phases[:2])[:2] == (Phase.TRAVERSE, 5)
    assert energy(status=Status.STUCK)[:2] == (Phase.TRAVERSE, 5)
    assert energy(of=()) == (None, None, [math.inf], [math.inf])


def test_which_findings_there_are(monkeypatch):
    chains = [
        chain(phase=Phase.ENTER, step=1), chain(phase=Phase.LAND, step=8, impact_speed=0.9),
        chain(arrested=False, impact_speed=7.0),
    ]  # fmt: skip
    phases = (of_phase(Phase.TRAVERSE, 0.08, 0.07), of_phase(Phase.LAND, 0.06, step=8))

    def first_rock(*, downhill, phases):
        rock = FirstRock(0.3 if downhill else 0.4, Phase.TRAVERSE, 2)
        return rock if phases is None or rock.phase in [each.phase for each in phases] else None

    run = found(chains=chains, phases=phases, first_rock=first_rock)

    def of(phase=None, question=ASKED):
        return {each.mode: each for each in balance(question, ASKED, run, OVER, phase, None)}

    every = of()
    assert list(every) == [TIP_DOWNHILL, TIP_UPHILL, ROTATION, IMPACT, MOMENTUM, ENERGY]
    assert every[IMPACT].step == 8
    assert every[ENERGY].step == 8
    assert list(of(Phase.LAND)) == [ROTATION, IMPACT, MOMENTUM, ENERGY]
    assert of(Phase.ENTER)[IMPACT].step == 1
    assert of(Phase.TRAVERSE)[ENERGY].step == 2
    # at a yaw the support polygon judges the flight, and energy beside it
    rise = [0.2]
    polygon = SimpleNamespace(
        tips=lambda question, flight: (given(TIP_UPHILL, [0.5]),),
        energy_of=lambda question, flight, psi: np.array(rise) * psi,
        energy_finding=lambda question, rise: given(ENERGY, [rise], phase=Phase.TRAVERSE),
    )
    monkeypatch.setattr(module, "support_polygon", polygon)
    turned = SimpleNamespace(**(vars(ASKED) | {"yaw": 0.5, "terrain": Stairs(rise=0.1, going=0.3)}))
    every = of(question=turned)
    assert list(every) == [TIP_UPHILL, ROTATION, IMPACT, MOMENTUM, ENERGY]
    assert (every[TIP_UPHILL].worst.tolist(), every[ENERGY].worst.tolist()) == ([0.5], [0.1])
    run.phases = (of_phase(Phase.ENTER, 0.05), *phases)
    assert of(question=turned)[ENERGY].worst == pytest.approx(0.04)  # entering is less
    assert TIP_UPHILL not in of(Phase.LAND, turned)
    assert of(Phase.LAND, turned)[ENERGY].worst == pytest.approx(0.05)
    assert TIP_UPHILL in of(Phase.TRAVERSE, turned)
    flat = SimpleNamespace(**(vars(turned) | {"terrain": None}))
    assert TIP_DOWNHILL in of(question=flat)


def test_what_tips_in_every_sample_has_no_energy(monkeypatch):
    run = found(
        chains=[], phases=(of_phase(Phase.TRAVERSE, 0.08, 0.07),),
        first_rock=lambda *, downhill, phases: FirstRock(0.04, Phase.TRAVERSE, 2),
    )  # fmt: skip
    monkeypatch.setattr(module, "drawn_falls", lambda *given, downhill: np.full(3, 0.1))

    def modes(*samples):
        over = OVER._replace(tip_downhill=np.array(samples))
        return [each.mode for each in balance(ASKED, ASKED, run, over, None, None)]

    # the best case takes off 0.04 downhill
    assert ENERGY not in modes(0.0, -0.01, -0.02)
    assert ENERGY in modes(0.01, -0.01, -0.02)
    assert FALL_DOWNHILL in modes(0.0, -0.01, -0.02)


@pytest.mark.parametrize(
    ("tilt", "sample", "sought"),
    [(0.04, 0.0, [((0.3,), 0.11)]), (0.2, 0.0, []), (0.2, -0.15, [((0.3,), 0.11)])],
)
def test_of_what_tips_a_fall_beyond_the_reserve_need_not_be_found(
    tilt, sample, sought, monkeypatch
):
    """Where it is enough to know it to 0.5 rad, and the margin against tipping is spent."""
    asked_for = []

    def seeking(tilts, *, enough):
        asked_for.append((tilts, pytest.approx(enough)))
        assert enough > 0.11  # what is just that is found
        return run

    run = found(
        phases=(), first_rock=lambda *, downhill, phases: FirstRock(tilt, Phase.TRAVERSE, 2),
        enough=0.5, sought=(0.3,), seeking=seeking,
    )  # fmt: skip
    monkeypatch.setattr(module, "drawn_falls", lambda *given, downhill: np.full(3, 0.1))
    asked = SimpleNamespace(**(vars(ASKED) | {"reserve": 0.11}))
    over = OVER._replace(tip_downhill=np.array([0.0, sample, 0.0]))  # one that tips is enough
    balance(asked, asked, run, over, None, None)
    assert asked_for == sought


@pytest.mark.parametrize("phase", [None, Phase.LAND])
def test_a_fall_of_a_phase_is_found_by_what_rocks_anywhere(phase, monkeypatch):
    rocks = []
    monkeypatch.setattr(module, "_tips", lambda *given: ())
    monkeypatch.setattr(module, "_rocking", lambda found, over, phase: phase)
    monkeypatch.setattr(module, "_falls", lambda *given: rocks.append(given[4:]) or [])
    monkeypatch.setattr(module, "_hits", lambda *given: [])
    monkeypatch.setattr(module, "_energy", lambda *given: "energy")
    each = balance(ASKED, ASKED, found(), OVER, phase, None)
    assert rocks == [(None, phase)]  # of which rocking, and of which phase the fall
    assert each == [phase, "energy"]


def test_the_smaller_of_two_findings_by_their_smallest_sample():
    one, other = given(ENERGY, [0.1, 0.5]), given(ENERGY, [0.2, 0.3])
    assert _least(one, other) is _least(other, one) is one
