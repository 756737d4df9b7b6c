"""The one verdict policy, on findings made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Assessment, Question, Stairs
from kaidan.assessment.answer import FindingShown, _probability
from kaidan.assessment.verdict import conclude
from kaidan.models.findings import Finding, Findings
from kaidan.modes import (
    DRIVE,
    ENERGY,
    EXIT_CODES,
    FAILS,
    FAILURE_MODES,
    FALL_DOWNHILL,
    FALL_UPHILL,
    HIGH_CENTRING,
    IMPACT,
    MOMENTUM,
    OPEN,
    POSTURE_CHANGE,
    ROTATION,
    ROUGHLY,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    TIP_DOWNHILL,
    TIP_SIDEWAYS,
    TIP_UPHILL,
    UNWEIGHED,
    Phase,
    Undecided,
    Verdict,
)

FLIGHT = Stairs(rise=0.1, going=0.15)
GO, ROUGH, UNSURE, NO_GO, OUTSIDE = Verdict
KNOWN = Question.of("kenaf", FLIGHT, friction=1.0)
UNKNOWN = Question.of("kenaf", FLIGHT)


def finding(mode, worst, best=None, **others):
    """Finding of one margin, or of one for each sample."""
    worst = np.atleast_1d(np.asarray(worst, dtype=float))
    best = worst if best is None else np.broadcast_to(np.asarray(best, dtype=float), worst.shape)
    return Finding(mode=mode, worst=worst, best=best, model="by hand", **others)


def judged(*each, question=KNOWN, **others):
    return conclude(question, Findings(model="by hand", each=each, **others))


def samples(failing, of=1000, value=0.2):
    """Margins of which so many fail."""
    return np.where(np.arange(of) < failing, -value, value)


HOLDS = finding(SLIDES_DOWN, 0.3)
STANDS = finding(FALL_DOWNHILL, 0.4), finding(FALL_UPHILL, 0.4)
"""A robot that rocks either way, and how far it is from falling."""


# The table


TABLE = {
    (NO_GO, UNSURE, UNSURE): """tip_sideways fall_downhill fall_uphill slides_down slides_up stuck
        flipper_torque turning twist narrow low""",
    (NO_GO, UNSURE, GO): "drive",
    (ROUGH, ROUGH, UNSURE): "tip_downhill tip_uphill rotation impact high_centring",
    (
        UNSURE,
        UNSURE,
        UNSURE,
    ): """gap_jam momentum energy posture_change posture_tolerance grouser_speed
        landing_room foot_unseen gap across floor_finish unweighed""",
}
"""Verdicts in the best case, in the worst only, and unknown. What does not arrive is a NO-GO; what
arrives is ROUGH, how far from a fall being known; what no model follows to its end is UNSURE."""
EACH = {key: row for row, keys in TABLE.items() for key in keys.split()}


@pytest.mark.parametrize("key", FAILURE_MODES)
def test_what_each_failure_mode_alone_comes_to(key):
    best, worst, unknown = EACH[key]
    mode = FAILURE_MODES[key]
    others = [one for one in (*STANDS, finding(TIP_SIDEWAYS, 0.3), HOLDS) if one.mode is not mode]
    for margins, verdict in (
        ((0.1, 0.2), GO),
        ((-0.1, -0.05), best),
        ((0.0, 0.0), best),  # zero is no margin
        ((-0.1, 0.2), worst),
        ((0.0, 0.2), worst),
        ((math.nan, math.nan), unknown),
    ):
        found = judged(finding(mode, *margins), *others)
        assert found.verdict is verdict, margins
        if not math.isnan(margins[0]):
            assert [one.mode for one in found.doubts] == ([] if verdict is GO else [mode])
        if verdict is not GO:
            decides = Undecided.MARGIN_UNKNOWN if math.isnan(margins[0]) else key
            assert found.governs == decides
    assert len(EACH) == len(FAILURE_MODES)


def test_a_finding_may_know_more_than_its_mode():
    """A model that follows no fall says that a tip is one, or that nothing tells."""
    for row, verdict in ((FAILS, NO_GO), (OPEN, UNSURE), (ROUGHLY, ROUGH)):
        assert judged(finding(TIP_DOWNHILL, -0.1, instead=row), HOLDS, *STANDS).verdict is verdict


@pytest.mark.parametrize(
    ("rocks", "fall", "other"),
    [
        (TIP_DOWNHILL, FALL_DOWNHILL, FALL_UPHILL),
        (TIP_UPHILL, FALL_UPHILL, FALL_DOWNHILL),
        (ROTATION, FALL_DOWNHILL, FALL_UPHILL),
    ],
)
def test_what_rocks_is_rough_only_where_the_fall_over_the_same_end_is_known(rocks, fall, other):
    rocking = finding(rocks, -0.1)
    assert judged(rocking, HOLDS, finding(fall, 0.1)).verdict is ROUGH
    assert judged(rocking, HOLDS).verdict is UNSURE
    assert judged(rocking, HOLDS, finding(other, 0.1)).verdict is UNSURE
    assert judged(rocking, HOLDS, finding(fall, math.nan)).verdict is UNSURE
    assert judged(rocking, HOLDS, finding(fall, -0.1, 0.1)).verdict is UNSURE
    assert judged(rocking, HOLDS, finding(fall, 0.0)).verdict is NO_GO


@pytest.mark.parametrize("mode", [MOMENTUM, ENERGY, POSTURE_CHANGE])
def test_what_momentum_or_speed_may_topple_is_never_rough(mode):
    for margins in ((-0.1, 0.1), (-0.1, -0.1)):
        found = judged(finding(TIP_DOWNHILL, -0.1), HOLDS, *STANDS, finding(mode, *margins))
        assert (found.verdict, found.governs) == (UNSURE, mode.key)
        assert [one.mode for one in found.doubts] == [mode, TIP_DOWNHILL]


def test_of_several_the_worst_verdict_counts():
    each = (
        finding(IMPACT, -0.1),
        finding(ENERGY, -0.1),
        finding(SLIDES_UP, -0.1),
    )
    assert judged(HOLDS).verdict is GO
    for count, verdict in ((1, ROUGH), (2, UNSURE), (3, NO_GO)):
        found = judged(HOLDS, *each[:count])
        assert (found.verdict, found.governs) == (verdict, each[count - 1].mode.key)


# One sample


@pytest.mark.parametrize(("worst", "best"), [(0.1, 0.2), (-0.1, 0.2), (-0.1, -0.01), (0.0, 0.0)])
def test_margins_of_one_failure_mode(worst, best):
    found = judged(finding(SLIDES_DOWN, worst, best))
    assert found.governs == "slides_down"
    assert (found.margin, found.margin_best) == (worst, best)


def test_of_a_go_the_nearest_governs():
    found = judged(
        finding(TIP_DOWNHILL, 0.3),
        finding(SLIDES_DOWN, 0.2, phase=Phase.LAND, step=4),
        finding(DRIVE, math.nan),
        finding(STUCK, math.inf),
    )
    assert found.verdict is GO
    assert (found.governs, found.phase, found.step) == ("slides_down", Phase.LAND, 4)
    assert (found.margin, found.doubts) == (0.2, ())


def test_of_what_comes_to_the_same_verdict_the_smallest_margin_of_slope_governs():
    found = judged(
        finding(ENERGY, -0.5),
        finding(SLIDES_UP, -0.1, 0.1, phase=Phase.TRAVERSE, step=2),
        finding(SLIDES_DOWN, -0.2, 0.1, phase=Phase.ENTER, step=1),
    )
    assert found.verdict is UNSURE
    assert (found.governs, found.phase, found.step) == ("slides_down", Phase.ENTER, 1)
    assert [one.mode for one in found.doubts] == [SLIDES_DOWN, SLIDES_UP, ENERGY]
    rough = judged(
        finding(IMPACT, -0.5),
        finding(TIP_UPHILL, -0.1),
        finding(TIP_DOWNHILL, -0.2),
        HOLDS,
        *STANDS,
    )
    assert (rough.verdict, rough.governs) == (ROUGH, "tip_downhill")
    assert [one.mode for one in rough.doubts] == [TIP_DOWNHILL, TIP_UPHILL, IMPACT]


def test_of_a_no_go_only_what_fails_in_the_best_case_governs():
    found = judged(finding(SLIDES_UP, -0.3, 0.1), finding(SLIDES_DOWN, -0.1, -0.05))
    assert (found.verdict, found.governs) == (NO_GO, "slides_down")
    assert (found.margin, found.margin_best) == (-0.3, -0.05)
    assert [one.mode for one in found.doubts] == [SLIDES_DOWN, SLIDES_UP]
    found = judged(finding(TIP_DOWNHILL, -0.3), *STANDS, finding(SLIDES_DOWN, -0.1, -0.05))
    assert (found.verdict, found.governs) == (NO_GO, "slides_down")


def test_of_a_no_go_the_smallest_margin_in_the_best_case_governs():
    found = judged(finding(SLIDES_UP, -0.2, -0.2), finding(SLIDES_DOWN, -0.3, -0.05))
    assert (found.verdict, found.governs) == (NO_GO, "slides_up")


def test_where_only_all_together_fail_in_the_best_case_the_smallest_margin_governs():
    """Of 1,000 samples 8 fail by either, others each: one of them fails alone in the worst case."""
    down, up = samples(8), np.roll(samples(8, value=0.1), 500)
    found = judged(finding(SLIDES_DOWN, -0.5 * np.ones(1000), down), finding(SLIDES_UP, up))
    assert (found.verdict, found.governs) == (NO_GO, "slides_up")


def test_ties_go_to_the_first_of_the_vocabulary():
    modes = (SLIDES_UP, SLIDES_DOWN, FALL_UPHILL, FALL_DOWNHILL)
    each = [finding(mode, -0.1) for mode in modes]
    assert judged(*each).governs == "fall_downhill"
    assert judged(*each[:3]).governs == "fall_uphill"
    assert judged(*each[:2]).governs == "slides_down"


@pytest.mark.parametrize("mode", [ROTATION, MOMENTUM, IMPACT, ENERGY, HIGH_CENTRING])
def test_what_is_no_slope_leaves_the_margin_of_slope(mode):
    margin = -math.inf if mode.unit == "" else -0.1
    found = judged(finding(SLIDES_DOWN, 0.2), *STANDS, finding(mode, margin))
    assert found.governs == mode.key
    assert found.margin == 0.2  # metres and radians are never compared


def test_getting_stuck_is_a_no_go_with_a_margin_of_minus_a_right_angle():
    found = judged(finding(TIP_DOWNHILL, 0.3), finding(STUCK, -math.pi / 2, phase=Phase.ENTER))
    assert (found.verdict, found.governs, found.phase) == (NO_GO, "stuck", Phase.ENTER)
    assert found.margin == found.margin_best == -math.pi / 2


def test_no_slope_that_fails_is_a_right_angle():
    found = judged(finding(TIP_DOWNHILL, math.inf))
    assert found.margin == found.margin_best == math.pi / 2


# What is not known


def test_unknown_friction_is_never_a_go():
    supply = finding(SLIDES_DOWN, math.nan, phase=Phase.ENTER, step=1)
    found = judged(finding(TIP_DOWNHILL, 0.3), supply, question=UNKNOWN)
    assert (found.verdict, found.governs) == (UNSURE, Undecided.FRICTION_UNKNOWN)
    assert (found.phase, found.step) == (Phase.ENTER, 1)  # where friction is required
    assert found.margin == 0.3
    assert found.doubts == ()


@pytest.mark.parametrize(("fall", "verdict"), [((-0.1, 0.1), UNSURE), ((-0.1, -0.1), NO_GO)])
def test_with_unknown_friction_another_doubt_governs(fall, verdict):
    falls = finding(FALL_DOWNHILL, *fall)
    found = judged(falls, finding(SLIDES_DOWN, math.nan), question=UNKNOWN)
    assert (found.verdict, found.governs) == (verdict, "fall_downhill")


def test_a_doubt_that_has_no_slope_governs_over_unknown_friction():
    each = finding(TIP_DOWNHILL, 0.3), finding(SLIDES_DOWN, math.nan), finding(ENERGY, -0.1)
    found = judged(*each, question=UNKNOWN)
    assert (found.verdict, found.governs) == (UNSURE, "energy")


def test_unknown_friction_governs_over_what_is_rough():
    """It rocks for certain; whether it arrives is for friction to say."""
    each = finding(TIP_DOWNHILL, -0.1), *STANDS
    found = judged(*each, finding(SLIDES_DOWN, math.nan), question=UNKNOWN)
    assert (found.verdict, found.governs) == (UNSURE, Undecided.FRICTION_UNKNOWN)
    assert [one.mode for one in found.doubts] == [TIP_DOWNHILL]
    found = judged(*each, question=UNKNOWN)  # of a model that knows nothing of friction
    assert (found.verdict, found.governs) == (UNSURE, Undecided.FRICTION_UNKNOWN)


@pytest.mark.parametrize("each", [(), (finding(TIP_DOWNHILL, math.nan),), (finding(ENERGY, 0.1),)])
def test_no_known_margin_is_never_a_go(each):
    found = judged(*each)
    assert (found.verdict, found.governs) == (UNSURE, Undecided.MARGIN_UNKNOWN)
    assert math.isnan(found.margin)
    assert found.phase is found.step is None


@pytest.mark.parametrize("mode", [TIP_DOWNHILL, TIP_UPHILL])
def test_an_unknown_margin_against_tipping_is_never_a_go(mode):
    found = judged(finding(SLIDES_DOWN, 0.3), finding(mode, np.full(1000, math.nan)))
    assert (found.verdict, found.governs) == (UNSURE, Undecided.MARGIN_UNKNOWN)
    assert found.margin == 0.3


def test_a_margin_against_tipping_that_some_samples_lack_is_known():
    worst = np.where(np.arange(1000) < 5, np.nan, 0.2)
    found = judged(finding(TIP_DOWNHILL, worst))
    assert (found.verdict, found.governs, found.margin) == (GO, "tip_downhill", 0.2)


def test_a_margin_that_more_samples_lack_than_the_risk_accepts_is_not_known():
    worst = np.where(np.arange(1000) < 11, np.nan, 0.2)
    found = judged(finding(TIP_DOWNHILL, worst))
    assert (found.verdict, found.governs) == (UNSURE, Undecided.MARGIN_UNKNOWN)
    assert found.margin == -math.inf


def test_a_margin_unknown_beside_a_fall_is_a_no_go():
    found = judged(finding(FALL_DOWNHILL, -math.pi / 2), finding(SLIDES_DOWN, math.nan))
    assert (found.verdict, found.governs) == (NO_GO, "fall_downhill")


def test_outside_the_model_nothing_else_counts():
    found = judged(finding(TIP_DOWNHILL, -0.1), outside="the terrain is no flight of stairs")
    assert (found.verdict, found.governs) == (OUTSIDE, Undecided.OUTSIDE_MODEL)
    assert math.isnan(found.margin)
    assert math.isnan(found.margin_best)
    assert found.phase is found.step is None
    assert found.doubts == ()


# Samples and the accepted risk


@pytest.mark.parametrize(
    ("failing", "risk", "verdict"),
    [(10, 0.01, GO), (11, 0.01, NO_GO), (11, 0.02, GO), (500, 0.5, GO), (501, 0.5, NO_GO)],
)
def test_as_many_samples_may_fail_as_the_risk_accepts(failing, risk, verdict):
    question = KNOWN.changed(risk=risk)
    found = judged(finding(SLIDES_DOWN, samples(failing)), question=question)
    assert found.verdict is verdict
    assert (found.margin > 0) == (verdict is GO)


def test_worst_and_best_case_have_their_own_shares():
    found = judged(finding(SLIDES_DOWN, samples(11), samples(10)))
    assert found.verdict is UNSURE
    assert found.margin < 0 < found.margin_best


def test_modes_that_fail_in_different_samples_add_up():
    # 6 of 1000 by either, 12 in all: more than 1 %, although none alone is
    other = np.flip(samples(6))
    found = judged(finding(SLIDES_DOWN, samples(6)), finding(SLIDES_UP, other * 2))
    assert found.verdict is NO_GO
    assert found.governs == "slides_down"  # 0.2 and 0.4 at the risk
    assert [one.mode for one in found.doubts] == [SLIDES_DOWN, SLIDES_UP]
    assert np.mean(found.samples <= 0) == 0.012


def test_what_fails_only_together_keeps_it_from_a_go():
    one, other = (
        finding(SLIDES_DOWN, samples(6), 0.3),
        finding(SLIDES_UP, np.flip(samples(6)), 0.3),
    )
    found = judged(one, other, finding(DRIVE, 0.1))
    assert found.verdict is UNSURE
    assert [one.mode for one in found.doubts] == [SLIDES_DOWN, SLIDES_UP]
    assert found.governs == "slides_down"
    assert judged(one, other, question=UNKNOWN).governs == "slides_down"


@pytest.mark.parametrize(
    ("rocks", "slides", "verdict"),
    [
        (12, 0, ROUGH),
        (12, 10, ROUGH),
        (12, 11, NO_GO),
        (6, 6, ROUGH),  # of the 11th worst it is known that it rocks
        (4, 6, GO),
        (10, 0, GO),
    ],
)
def test_each_sample_has_a_verdict_and_the_risk_picks_one(rocks, slides, verdict):
    """Those that rock are the first, those that slide the last ones of 1,000, at a risk of 1 %."""
    found = judged(
        finding(TIP_DOWNHILL, samples(rocks)),
        *STANDS,
        finding(SLIDES_DOWN, np.flip(samples(slides))),
    )
    assert found.verdict is verdict


def test_what_decides_together_with_others_governs_over_what_is_rough_alone():
    """20 of 1,000 rock for certain; 6 slide and 6 others lack energy: 12 of a worse verdict."""
    found = judged(
        finding(TIP_DOWNHILL, np.roll(samples(20), 500)),
        *STANDS,
        finding(SLIDES_DOWN, samples(6), 0.3),
        finding(ENERGY, np.flip(samples(6))),
    )
    assert (found.verdict, found.governs) == (UNSURE, "slides_down")
    assert [one.mode for one in found.doubts] == [TIP_DOWNHILL, SLIDES_DOWN, ENERGY]


def test_of_what_fails_together_the_margins_of_slope_come_first():
    slides, energy = (
        finding(SLIDES_DOWN, samples(6), 0.3),
        finding(ENERGY, np.flip(samples(6))),
    )
    for each in ((slides, energy), (energy, slides)):
        found = judged(*each)
        assert [one.mode for one in found.doubts] == [SLIDES_DOWN, ENERGY]
        assert (found.governs, found.margin) == ("slides_down", 0.2)


def test_what_fails_within_the_risk_is_no_doubt():
    assert judged(finding(SLIDES_DOWN, samples(10))).doubts == ()
    found = judged(finding(SLIDES_DOWN, samples(11)), finding(SLIDES_UP, samples(1)))
    assert [one.mode for one in found.doubts] == [SLIDES_DOWN]  # fails alone: not the other too


def test_modes_that_fail_in_the_same_samples_do_not():
    found = judged(finding(SLIDES_UP, samples(6)), finding(SLIDES_DOWN, samples(6)))
    assert found.verdict is GO


def test_one_certain_finding_counts_for_every_sample():
    found = judged(finding(TIP_DOWNHILL, samples(0)), finding(SLIDES_DOWN, -0.1))
    assert (found.verdict, found.governs) == (NO_GO, "slides_down")
    assert (found.samples <= 0).all()


@pytest.mark.parametrize(("lack", "verdict"), [(10, GO), (11, UNSURE)])
def test_a_sample_without_a_margin_is_not_known_to_hold(lack, verdict):
    worst = np.where(np.arange(1000) < lack, np.nan, 0.2)
    found = judged(finding(TIP_DOWNHILL, 0.3), finding(SLIDES_DOWN, worst))
    assert found.verdict is verdict


def test_what_is_unknown_in_different_samples_adds_up():
    # 6 of 1000 by either, 12 in all: more than 1 %, although neither fails anywhere
    worst = np.where(np.arange(1000) < 6, np.nan, 0.2)
    found = judged(finding(SLIDES_UP, worst), finding(SLIDES_DOWN, np.flip(worst)))
    assert (found.verdict, found.governs) == (UNSURE, Undecided.MARGIN_UNKNOWN)
    assert found.doubts == ()


# The vocabulary of verdicts


def test_verdicts_have_a_rank_an_exit_code_and_a_label():
    assert [(each.rank, each.exit_code, each.label) for each in Verdict] == [
        (0, 0, "GO"),
        (1, 4, "ROUGH"),
        (2, 5, "UNSURE"),
        (3, 1, "NO-GO"),
        (4, 3, "OUTSIDE THE MODEL"),
    ]


def test_the_exit_codes_are_told_as_they_are():
    told = dict(reversed(each.split(" ", 1)) for each in EXIT_CODES.split(", "))
    assert told.pop("bad input") == "2"
    assert {word.upper(): int(code) for word, code in told.items()} == {
        each.label: each.exit_code for each in Verdict
    }


def test_what_no_slope_would_mend_has_no_margin_of_slope_left():
    stuck = finding(STUCK, -math.inf)
    found = judged(finding(TIP_DOWNHILL, 0.3), stuck)
    assert (found.verdict, found.governs) == (NO_GO, "stuck")
    low = FAILURE_MODES["low"]  # a ceiling: in metres
    found = judged(finding(TIP_DOWNHILL, 0.3), finding(low, -0.2))
    assert (found.verdict, found.governs) == (NO_GO, "low")
    assert (found.margin, found.margin_best) == (-math.pi / 2, -math.pi / 2)
    for margin in (0.0, -0.1):
        found = judged(finding(TIP_DOWNHILL, margin), finding(low, -0.2))
        assert (found.margin, found.margin_best) == (margin, margin)


def test_a_centroid_that_nobody_measured_comes_before_what_follows_from_it():
    found = judged(finding(TIP_DOWNHILL, -0.5), finding(UNWEIGHED, -0.1))
    assert found.governs == "unweighed"
    assert [one.mode for one in found.doubts] == [UNWEIGHED, TIP_DOWNHILL]


def test_shares_and_margins_of_an_answer():
    """Of two samples one fails; margins in degrees alone are angles."""
    assert _probability(SimpleNamespace(samples=np.array([0.1, -0.1]))) == 0.5
    assert _probability(SimpleNamespace(samples=np.array([-0.1]))) is None
    shown = {
        one.mode.key: FindingShown.of(one, 0.0)
        for one in (finding(TIP_DOWNHILL, 0.1), finding(ENERGY, 0.02))
    }
    assert shown["energy"].holds is shown["energy"].holds_best is True
    answer = SimpleNamespace(findings=shown)
    margins = {"tip_downhill": pytest.approx(math.degrees(0.1))}
    assert Assessment.margins_deg.fget(answer) == margins
