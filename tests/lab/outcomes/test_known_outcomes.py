"""Robots on stairs whose outcome is public: sources in `kaidan/catalog/outcomes.toml`.

The outcomes are the sources' (Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, and others); the
counts are a record of kaidan and stand, run anew, in `docs/lab/outcomes.md`.
"""

import pytest
from typer.testing import CliRunner

from kaidan import catalog
from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.lab.outcomes.form import FORM, OutcomesForm
from kaidan.lab.outcomes.known_outcomes import KnownOutcomes, known_outcomes, share
from kaidan.lab.reproduction.reproduction import MEASURED
from kaidan.modes import Verdict


@pytest.fixture(scope="module")
def found():
    return known_outcomes()


def test_no_go_where_a_robot_failed_or_rocked(found):
    wrong = ("wrong GO", "wrong ROUGH")
    assert [pair for pair in found.pairs if pair.comparison in wrong] == []


def test_no_no_go_where_a_real_robot_climbed_asked_as_the_source_has_it(found):
    tests = [p for p in found.pairs if p.evidence == "test" and p.knowledge == "source"]
    assert [pair for pair in tests if pair.comparison == "wrong NO-GO"] == []


def test_rocking_of_fig_14_is_rough(found):
    rocks = [pair for pair in found.pairs if pair.outcome == "rocks"]
    (rocked,) = (pair for pair in rocks if pair.knowledge == "source")
    # paper, Fig. 14: 200 mm, 44.0 deg
    assert (1e3 * rocked.nosing_spacing_m, rocked.angle_deg) == pytest.approx(MEASURED.rotated_at)
    assert rocked.verdict is Verdict.ROUGH


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
        wrong = tally.wrong_go + tally.wrong_rough + tally.wrong_no_go
        assert tally.agree + wrong + tally.undecided + tally.no_answer == tally.pairs


def test_answer_reads_back_equal_and_says_the_counts(found):
    assert KnownOutcomes.from_json(found.to_json()) == found
    tally = found.tallies[0]
    assert (tally.pairs, tally.fill_in, tally.knowledge) == (16, False, "source")
    row = next(line for line in str(found).splitlines() if line.startswith("real robot"))
    assert "what the source has" in row
    assert f"   {tally.agree} (" in row


def test_pairs_at_every_5_deg_are_counted_apart(found):
    fill_ins = sum(len(entry.get("angles", ())) for entry in pairs())
    for knowledge in ("source", "operator", "grip tried"):
        counted = [t for t in found.tallies if t.knowledge == knowledge and t.evidence == "test"]
        assert [t.pairs for t in counted if t.fill_in] == [fill_ins]
        assert [t.pairs for t in counted if not t.fill_in] == [16]


def test_an_operator_knows_less_than_the_source(found):
    def pair(knowledge):
        return next(p for p in found.pairs if p.angle_deg < 45.5 and p.knowledge == knowledge)

    assert pair("source").friction == (2.0, 2.0)
    assert pair("operator").friction is None
    assert pair("operator").verdict is not Verdict.GO  # nobody stated the grip


def test_interval_of_a_share():
    # Wilson: of 0 of n the upper end is z^2 / (n + z^2); of half of all it is symmetric
    assert share(0, 16) == pytest.approx((0.0, 1.96**2 / (16 + 1.96**2)), abs=1e-4)
    low, high = share(5, 10)
    assert low + high == pytest.approx(1.0)
    assert share(16, 16)[1] == pytest.approx(1.0)
    # Brown, Cai & DasGupta 2001 give the formula; by hand for 9 of 16: 0.332, 0.769
    assert share(9, 16) == pytest.approx((0.332, 0.769), abs=5e-4)


def test_a_laboratory_sends_its_own_pair(tmp_path, monkeypatch):
    file = tmp_path / "own.toml"
    with pytest.raises(InputError, match="rise is still to be filled in"):
        OutcomesForm.of_file(write(file, FORM))
    filled = FORM
    for name, value in FILLED.items():
        filled = filled.replace(f'{name} = "FILL IN"', f'{name} = "{value}"')
    form = OutcomesForm.of_file(write(file, filled.replace("FILL IN", "us")))
    monkeypatch.setattr(catalog, "outcomes", lambda: {"pair": [], "reported": []})
    own = known_outcomes(form).pairs
    assert [pair.knowledge for pair in own] == ["source", "operator", "grip tried"]
    assert own[0].friction == (0.6, 0.8)
    assert own[0].note.startswith("0 of 5 failed")
    for right, wrong in (
        ("failed = 0", "failed = 9"),
        ('outcome = "climbs"', 'outcome = "falls"'),
        ('rise = "178mm"', ""),
    ):
        with pytest.raises(InputError, match="outcome"):
            OutcomesForm.of_file(write(file, filled.replace(right, wrong)))


FILLED = {"robot": "absolem", "rise": "178mm", "going": "279mm", "friction": "0.6..0.8"}


def test_the_form_is_printed():
    assert CliRunner().invoke(app, ["lab", "outcomes", "--form"]).stdout == FORM


def write(path, text):
    path.write_text(text)
    return path


def test_no_question_is_put_twice():
    keys = ("robot", "angles", "stairs", "points", "manner")
    knowledge = [str([entry.get(key) for key in keys]) for entry in pairs()]
    assert len(set(knowledge)) == len(knowledge)


def test_every_pair_has_a_source_and_every_source_a_pair():
    assert {entry["source"] for entry in pairs()} == set(catalog.outcomes()["sources"])


def test_reports_say_what_is_missing():
    for entry in catalog.outcomes()["reported"]:
        assert set(entry) == {"robot", "stairs", "outcome", "status", "missing", "source"}
        assert entry["status"] in ("printed", "claimed")


def pairs():
    return catalog.outcomes()["pair"]
