"""Robots on stairs whose outcome is public: sources in `kaidan/catalog/outcomes.toml`.

The outcomes are the sources' (Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, and others); the
counts are a record of kaidan and stand, run anew, in `docs/lab/outcomes.md`.
"""

import pytest

from kaidan import catalog
from kaidan.lab.outcomes.known_outcomes import KnownOutcomes, known_outcomes
from kaidan.lab.reproduction.reproduction import MEASURED
from kaidan.modes import Verdict


@pytest.fixture(scope="module")
def found():
    return known_outcomes()


def test_no_go_where_a_robot_failed_or_rocked(found):
    assert [pair for pair in found.pairs if pair.comparison == "wrong GO"] == []


def test_no_no_go_where_a_real_robot_climbed(found):
    tests = [pair for pair in found.pairs if pair.evidence == "test"]
    assert [pair for pair in tests if pair.comparison == "wrong NO-GO"] == []


def test_rocking_of_fig_14_is_caution(found):
    (rocked,) = (pair for pair in found.pairs if pair.outcome == "rocks")
    # paper, Fig. 14: 200 mm, 44.0 deg
    assert (1e3 * rocked.nosing_spacing_m, rocked.angle_deg) == pytest.approx(MEASURED.rotated_at)
    assert rocked.verdict is Verdict.CAUTION


def test_falls_that_the_text_prints_are_pairs(found):
    printed = {
        round(pair.angle_deg, 6)
        for pair in found.pairs
        if (pair.source, pair.status, pair.outcome) == ("endo-nagatani", "printed", "falls")
    }
    assert printed == set(MEASURED.fell_deg)


def test_every_pair_is_counted_once(found):
    assert sum(tally.pairs for tally in found.tallies) == len(found.pairs)
    for tally in found.tallies:
        counts = (tally.agree, tally.wrong_go, tally.wrong_no_go, tally.caution, tally.no_answer)
        assert sum(counts) == tally.pairs


def test_answer_reads_back_equal_and_says_the_counts(found):
    assert KnownOutcomes.from_json(found.to_json()) == found
    tally = found.tallies[0]
    assert f"{tally.pairs} in all: {tally.agree} agree" in str(found)


def test_no_question_is_put_twice():
    keys = ("robot", "angles", "stairs", "points", "manner")
    asked = [str([entry.get(key) for key in keys]) for entry in pairs()]
    assert len(set(asked)) == len(asked)


def test_every_pair_has_a_source_and_every_source_a_pair():
    assert {entry["source"] for entry in pairs()} == set(catalog.outcomes()["sources"])


def test_reports_say_what_is_missing():
    for entry in catalog.outcomes()["reported"]:
        assert set(entry) == {"robot", "stairs", "outcome", "status", "missing", "source"}
        assert entry["status"] in ("printed", "claimed")


def pairs():
    return catalog.outcomes()["pair"]
