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
    HIGH_CENTRING,
    IMPACT,
    MOMENTUM,
    ROTATION,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    TIP_DOWNHILL,
    TIP_UPHILL,
    UNWEIGHED,
    Phase,
    Undecided,
    Verdict,
)

FLIGHT = Stairs(rise=0.1, going=0.15)
GO, CAUTION, NO_GO = Verdict.GO, Verdict.CAUTION, Verdict.NO_GO
KNOWN = Question.of("kenaf", FLIGHT, friction=1.0)
UNKNOWN = Question.of("kenaf", FLIGHT)
ARRESTED = Question.of("kenaf", FLIGHT, friction=1.0, accept="arrested")


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


# One sample


@pytest.mark.parametrize(
    ("worst", "best", "failing", "verdict"),
    [
        (0.1, 0.2, NO_GO, GO),
        (-0.1, 0.2, NO_GO, CAUTION),
        (-0.1, -0.01, NO_GO, NO_GO),
        (-0.1, -0.01, CAUTION, CAUTION),
        (-0.1, 0.2, CAUTION, CAUTION),
        (0.0, 0.2, NO_GO, CAUTION),  # zero is no margin
        (0.0, 0.0, NO_GO, NO_GO),
    ],
)
def test_of_one_failure_mode(worst, best, failing, verdict):
    found = judged(finding(TIP_DOWNHILL, worst, best, failing=failing))
    assert found.verdict is verdict
    assert found.governs == "tip_downhill"
    assert (found.margin, found.margin_best) == (worst, best)
    assert [one.mode for one in found.doubts] == ([] if verdict is GO else [TIP_DOWNHILL])


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


def test_of_a_caution_the_smallest_margin_of_slope_governs():
    found = judged(
        finding(ENERGY, -0.5, failing=CAUTION),
        finding(TIP_DOWNHILL, -0.1, 0.1, phase=Phase.TRAVERSE, step=2),
        finding(SLIDES_DOWN, -0.2, 0.1, phase=Phase.ENTER, step=1),
    )
    assert found.verdict is CAUTION
    assert (found.governs, found.phase, found.step) == ("slides_down", Phase.ENTER, 1)
    assert [one.mode for one in found.doubts] == [SLIDES_DOWN, TIP_DOWNHILL, ENERGY]


def test_of_a_no_go_only_what_fails_in_the_best_case_governs():
    found = judged(finding(TIP_DOWNHILL, -0.3, 0.1), finding(SLIDES_DOWN, -0.1, -0.05))
    assert (found.verdict, found.governs) == (NO_GO, "slides_down")
    assert (found.margin, found.margin_best) == (-0.3, -0.05)
    assert [one.mode for one in found.doubts] == [TIP_DOWNHILL, SLIDES_DOWN]
    found = judged(finding(TIP_DOWNHILL, -0.3, failing=CAUTION), finding(SLIDES_DOWN, -0.1, -0.05))
    assert (found.verdict, found.governs) == (NO_GO, "slides_down")


def test_of_a_no_go_the_smallest_margin_in_the_best_case_governs():
    found = judged(finding(TIP_DOWNHILL, -0.2, -0.2), finding(SLIDES_DOWN, -0.3, -0.05))
    assert (found.verdict, found.governs) == (NO_GO, "tip_downhill")


def test_where_only_all_together_fail_in_the_best_case_the_smallest_margin_governs():
    """Of 1,000 samples 8 fail by either, others each: one of them fails alone in the worst case."""
    downhill, uphill = samples(8), np.roll(samples(8, value=0.1), 500)
    found = judged(
        finding(TIP_DOWNHILL, -0.5 * np.ones(1000), downhill), finding(TIP_UPHILL, uphill)
    )
    assert (found.verdict, found.governs) == (NO_GO, "tip_uphill")


def test_ties_go_to_the_first_of_the_vocabulary():
    each = [finding(mode, -0.1) for mode in (SLIDES_UP, SLIDES_DOWN, TIP_UPHILL, TIP_DOWNHILL)]
    assert judged(*each).governs == "tip_downhill"
    assert judged(*each[:3]).governs == "tip_uphill"
    assert judged(*each[:2]).governs == "slides_down"


@pytest.mark.parametrize("mode", [ROTATION, MOMENTUM, IMPACT, ENERGY, HIGH_CENTRING])
def test_what_is_no_failure_by_itself_is_a_caution(mode):
    margin = -math.inf if mode.unit == "" else -0.1
    found = judged(finding(TIP_DOWNHILL, 0.3), finding(mode, margin, failing=CAUTION))
    assert (found.verdict, found.governs) == (CAUTION, mode.key)
    assert found.margin == 0.3  # metres and radians are never compared
    assert judged(finding(TIP_DOWNHILL, 0.3), finding(mode, 0.1, failing=CAUTION)).verdict is GO


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
    assert (found.verdict, found.governs) == (CAUTION, Undecided.FRICTION_UNKNOWN)
    assert (found.phase, found.step) == (Phase.ENTER, 1)  # where friction is required
    assert found.margin == 0.3
    assert found.doubts == ()


@pytest.mark.parametrize(
    ("tip", "verdict"),
    [(finding(TIP_DOWNHILL, -0.1, 0.1), CAUTION), (finding(TIP_DOWNHILL, -0.1), NO_GO)],
)
def test_with_unknown_friction_another_doubt_governs(tip, verdict):
    found = judged(tip, finding(SLIDES_DOWN, math.nan), question=UNKNOWN)
    assert (found.verdict, found.governs) == (verdict, "tip_downhill")


def test_a_doubt_that_has_no_slope_governs_over_unknown_friction():
    found = judged(
        finding(TIP_DOWNHILL, 0.3),
        finding(SLIDES_DOWN, math.nan),
        finding(ENERGY, -0.1, failing=CAUTION),
        question=UNKNOWN,
    )
    assert (found.verdict, found.governs) == (CAUTION, "energy")


@pytest.mark.parametrize("each", [(), (finding(TIP_DOWNHILL, math.nan),), (finding(ENERGY, 0.1),)])
def test_no_known_margin_is_never_a_go(each):
    found = judged(*each)
    assert (found.verdict, found.governs) == (CAUTION, Undecided.MARGIN_UNKNOWN)
    assert math.isnan(found.margin)
    assert found.phase is found.step is None


@pytest.mark.parametrize("mode", [TIP_DOWNHILL, TIP_UPHILL])
def test_an_unknown_margin_against_tipping_is_never_a_go(mode):
    found = judged(finding(SLIDES_DOWN, 0.3), finding(mode, np.full(1000, math.nan)))
    assert (found.verdict, found.governs) == (CAUTION, Undecided.MARGIN_UNKNOWN)
    assert found.margin == 0.3


def test_a_margin_against_tipping_that_some_samples_lack_is_known():
    worst = np.where(np.arange(1000) < 5, np.nan, 0.2)
    found = judged(finding(TIP_DOWNHILL, worst))
    assert (found.verdict, found.governs, found.margin) == (GO, "tip_downhill", 0.2)


def test_a_margin_that_more_samples_lack_than_the_risk_accepts_is_not_known():
    worst = np.where(np.arange(1000) < 11, np.nan, 0.2)
    found = judged(finding(TIP_DOWNHILL, worst))
    assert (found.verdict, found.governs) == (CAUTION, Undecided.MARGIN_UNKNOWN)
    assert found.margin == -math.inf


def test_a_margin_unknown_in_a_model_that_can_refute_is_a_no_go():
    fails = finding(TIP_DOWNHILL, -math.pi / 2, -math.pi / 2)
    found = judged(fails, finding(SLIDES_DOWN, math.nan))
    assert (found.verdict, found.governs) == (NO_GO, "tip_downhill")


def test_outside_the_model_nothing_else_counts():
    found = judged(finding(TIP_DOWNHILL, -0.1), outside="the terrain is no flight of stairs")
    assert (found.verdict, found.governs) == (Verdict.OUTSIDE_MODEL, Undecided.OUTSIDE_MODEL)
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
    found = judged(finding(TIP_DOWNHILL, samples(failing)), question=question)
    assert found.verdict is verdict
    assert (found.margin > 0) == (verdict is GO)


def test_worst_and_best_case_have_their_own_shares():
    found = judged(finding(TIP_DOWNHILL, samples(11), samples(10)))
    assert found.verdict is CAUTION
    assert found.margin < 0 < found.margin_best


def test_modes_that_fail_in_different_samples_add_up():
    # 6 of 1000 by either, 12 in all: more than 1 %, although none alone is
    other = np.flip(samples(6))
    found = judged(finding(TIP_DOWNHILL, samples(6)), finding(SLIDES_DOWN, other * 2))
    assert found.verdict is NO_GO
    assert found.governs == "tip_downhill"  # 0.2 and 0.4 at the risk
    assert [one.mode for one in found.doubts] == [TIP_DOWNHILL, SLIDES_DOWN]
    assert np.mean(found.samples <= 0) == 0.012


def test_what_fails_only_together_keeps_it_from_a_go():
    tip, slip = (
        finding(TIP_DOWNHILL, samples(6), 0.3),
        finding(SLIDES_DOWN, np.flip(samples(6)), 0.3),
    )
    found = judged(tip, slip, finding(DRIVE, 0.1))
    assert found.verdict is CAUTION
    assert [one.mode for one in found.doubts] == [TIP_DOWNHILL, SLIDES_DOWN]
    assert found.governs == "tip_downhill"
    assert judged(tip, slip, question=UNKNOWN).governs == "tip_downhill"


def test_of_what_fails_together_the_margins_of_slope_come_first():
    tip, energy = (
        finding(TIP_DOWNHILL, samples(6), failing=CAUTION),
        finding(ENERGY, np.flip(samples(6)), failing=CAUTION),
    )
    for each in ((tip, energy), (energy, tip)):
        found = judged(*each)
        assert [one.mode for one in found.doubts] == [TIP_DOWNHILL, ENERGY]
        assert (found.governs, found.margin) == ("tip_downhill", 0.2)


def test_what_fails_within_the_risk_is_no_doubt():
    assert judged(finding(TIP_DOWNHILL, samples(10))).doubts == ()
    found = judged(finding(TIP_DOWNHILL, samples(11)), finding(SLIDES_DOWN, samples(1)))
    assert [one.mode for one in found.doubts] == [TIP_DOWNHILL]  # fails alone: not the other too


def test_modes_that_fail_in_the_same_samples_do_not():
    found = judged(finding(TIP_DOWNHILL, samples(6)), finding(SLIDES_DOWN, samples(6)))
    assert found.verdict is GO


def test_one_certain_finding_counts_for_every_sample():
    found = judged(finding(TIP_DOWNHILL, samples(0)), finding(SLIDES_DOWN, -0.1))
    assert (found.verdict, found.governs) == (NO_GO, "slides_down")
    assert (found.samples <= 0).all()


def test_a_sample_without_a_margin_does_not_fail():
    worst = np.where(np.arange(1000) < 20, np.nan, 0.2)
    found = judged(finding(TIP_DOWNHILL, 0.3), finding(SLIDES_DOWN, worst))
    assert found.verdict is GO


# What the operator accepts


def waived(momentum=(0.1, 0.2), failing=CAUTION):
    return (
        finding(TIP_DOWNHILL, -0.2, failing=failing),
        finding(SLIDES_DOWN, 0.3),
        finding(ROTATION, -0.1, failing=CAUTION),
        finding(MOMENTUM, *momentum, failing=CAUTION),
    )


def test_an_arrested_rotation_is_a_caution_unless_accepted():
    assert judged(*waived()).verdict is CAUTION
    found = judged(*waived(), question=ARRESTED)
    assert (found.verdict, found.governs) == (GO, "slides_down")
    assert found.margin == 0.3
    assert found.doubts == ()


def test_who_accepts_it_takes_the_momentum_that_a_plastic_impact_leaves():
    assert judged(*waived((-0.1, 0.2)), question=ARRESTED).verdict is GO
    found = judged(*waived((-0.1, -0.05)), question=ARRESTED)
    assert (found.verdict, found.governs) == (CAUTION, "momentum")


def test_a_fall_is_a_no_go_whatever_is_accepted():
    for question in (KNOWN, ARRESTED):
        found = judged(*waived(failing=NO_GO), question=question)
        assert (found.verdict, found.governs) == (NO_GO, "tip_downhill")


@pytest.mark.parametrize("mode", [IMPACT, ENERGY, HIGH_CENTRING])
def test_other_doubts_are_not_waived(mode):
    found = judged(*waived(), finding(mode, -0.1, failing=CAUTION), question=ARRESTED)
    assert (found.verdict, found.governs) == (CAUTION, mode.key)


def test_friction_is_not_waived():
    question = UNKNOWN.changed(accept="arrested")
    found = judged(*waived()[2:], finding(SLIDES_DOWN, math.nan), question=question)
    assert (found.verdict, found.governs) == (CAUTION, Undecided.FRICTION_UNKNOWN)


# The vocabulary of verdicts


def test_verdicts_have_a_rank_an_exit_code_and_a_label():
    assert [(each.rank, each.exit_code, each.label) for each in Verdict] == [
        (0, 0, "GO"),
        (1, 0, "CAUTION"),
        (2, 1, "NO-GO"),
        (3, 3, "OUTSIDE THE MODEL"),
    ]


def test_what_no_slope_would_mend_has_no_margin_of_slope_left():
    found = judged(finding(TIP_DOWNHILL, 0.3), finding(IMPACT, -0.2))
    assert (found.verdict, found.governs) == (NO_GO, "impact")
    assert (found.margin, found.margin_best) == (-math.pi / 2, -math.pi / 2)
    for margin in (0.0, -0.1):
        found = judged(finding(TIP_DOWNHILL, margin), finding(IMPACT, -0.2))
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
