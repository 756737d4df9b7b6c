"""Reports: what is on paper is what `assess` and `traverse` answer, number by number."""

import json
import math
import re

import pytest
from typer.testing import CliRunner

import kaidan
from kaidan import InputError, Question
from kaidan.cli import app, run
from kaidan.documents import html_page, report_bytes, report_file
from kaidan.documents.pdf_pages import pages
from kaidan.errors import MissingExtraError
from kaidan.text.document import Facts
from kaidan.text.report import document
from kaidan.verbs.report import back
from kaidan.verbs.report.answer import Report
from kaidan.verbs.report.code import HEAD, code_of, question_of
from question_cases import random_questions
from report_pages import Page

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")


@pytest.fixture(scope="module")
def found():
    return kaidan.report("absolem", "ibc", flippers="flat", friction="0.6..1", speed="0.2m/s")


@pytest.fixture(scope="module")
def page(found):
    return Page(report_bytes(found, "html").decode())


def close(text, value, digits):
    """Whether a text begins with a number that is a value rounded to some digits."""
    return abs(float(NUMBER.match(text).group()) - value) <= 0.5 * 10**-digits * (1 + 1e-9) + 1e-12


def assert_same_numbers(question):
    """Each number of a report is that of the JSON of the commands."""
    mission = kaidan.report(question).missions[0]
    said = json.loads(kaidan.assess(question).to_json())
    assert json.loads(mission.assessment.to_json()) == said
    if mission.traverse is not None:
        assert mission.traverse.to_json() == kaidan.traverse(question).to_json()
    page = Page(page_of(mission))
    rows = page.table("Margins")[1:]
    assert len(rows) == len(said["findings"])
    for row, (key, one) in zip(rows, said["findings"].items(), strict=True):
        assert row[0] == f"{key}: {one['label']}"
        for text, value in zip(row[1:3], (one["margin"], one["margin_best"]), strict=True):
            assert (text == "-") if value is None else close(text, value, 2)
        holds = {None: "not known", True: "yes", False: "no"}[one["holds"]]
        assert row[3] == ("at best" if holds == "no" and one["holds_best"] else holds)
        assert row[6] == one["model"]
        if one["probability"] is not None:
            assert close(row[4].removeprefix("p = "), one["probability"], 3)
        if one["step"] is not None:
            assert row[5] == f"{one['phase']}, step {one['step']}"
    facts = dict(page.tables[0][1])
    assert facts["Go"] == f"{said['question']['direction']}, {facing(said)}"
    if said["margin_deg"] is not None:
        assert close(facts["Margin"], said["margin_deg"], 1)
    if said["angle_deg"] is not None:
        slope, spacing = NUMBER.findall(facts["Stairs"])[:2]
        assert close(slope, said["angle_deg"], 1)
        assert close(spacing, 1e3 * said["nosing_spacing_m"], 0)
    if said["required_friction"] is not None and said["traction"] is None:
        assert close(facts["Friction"], said["required_friction"], 2)


def facing(said):
    return said["question"]["facing"].replace("-", " ")


def page_of(*missions):
    """HTML without pictures, which take the time: what is tested here is written."""
    return html_page.page(document(Report(kaidan="0", kernel="native", missions=missions)), {})


@pytest.mark.parametrize("question", list(random_questions(8, seed=12)), ids=range(8))
def test_every_number_is_that_of_the_commands(question):
    assert_same_numbers(question)


@pytest.mark.slow
def test_every_number_of_200_questions_is_that_of_the_commands():
    for question in random_questions(200, seed=2804):
        assert_same_numbers(question)


def test_numbers_of_the_card_are_read_off_the_traverse(found):
    mission = found.missions[0]
    card, poses = mission.card, mission.traverse.poses
    drops = [p.inclination_deg for r in mission.traverse.rotations for p in r.placements]
    assert card.steepest_deg == max([*poses.inclination_deg, *drops])
    assert card.lowest_deg == min([*poses.inclination_deg, *drops])
    # 2.6 deg is the paper's largest deformation, the default of theta_d
    assert card.stop_above_deg == pytest.approx(card.steepest_deg + 2.6)
    assert card.time_s == pytest.approx(poses.path_m[-1] / 0.2)
    assert card.path_m == poses.path_m[-1]


def test_the_page_is_whole_in_itself(page):
    assert "script" not in page.tags
    assert all(each.startswith("data:image/svg+xml;base64,") for each in page.fetched)
    assert len(page.pictures) == 4  # sketch, margins, traverse, code
    assert all(each["alt"] for each in page.pictures)


def test_the_page_for_the_field_says_what_to_do(page):
    stop = [text for heading, text in page.points if heading == "Stop"]
    assert (
        stop[-1] == "A step differs from those in the sketch, or is wet, loose, broken or covered."
    )
    assert any("there is less friction than 0.91" in each for each in stop)
    assert page.table("Flippers")[1] == ["enter", "before the start", "-10 deg", "-10 deg", "flat"]


def test_before_a_rough_drive_the_page_for_the_field_says_what_to_secure_first():
    rough = kaidan.report("absolem", "ibc", friction=1.0, flippers="24deg,-7.5deg")
    (facts,) = (each for each in document(rough).parts[0].blocks if isinstance(each, Facts))
    said = "Secure payload, arm and antennas: it rocks. Keep people off the flight below."
    assert facts.rows[0] == ("First", said)


def test_a_robot_that_cannot_go_is_not_to_be_driven():
    page = Page(page_of(kaidan.report("kenaf", "ibc", friction=0.8).missions[0]))
    assert ("Stop", "Do not drive it like this.") in page.points


def test_what_is_certain_to_fail_is_not_said_to_be_in_doubt():
    """No way to turn, and friction that is enough at the upper end of its range alone."""
    turn = {"upper_turn": "half", "upper_landing": 1.2, "upper_landing_width": 2.2, "width": 1.0}
    stairs = kaidan.Stairs(rise=0.15, going=0.3, steps=10, **turn)
    found = kaidan.report("ozbot-atr", stairs, friction="0.5..1.2")
    points = [text for heading, text in Page(page_of(found.missions[0])).points]
    certain = points.index("Certain: too little room to turn on a landing.")
    (possible,) = (k for k, said in enumerate(points) if said.startswith("Possible: sliding down"))
    assert certain < possible
    assert not any("In doubt" in said for said in points)


def test_the_page_for_the_field_says_how_to_turn_on_a_landing():
    turn = {"upper_turn": "half", "upper_landing": 1.2, "upper_landing_width": 2.2, "width": 1.0}
    stairs = kaidan.Stairs(rise=0.15, going=0.3, steps=10, **turn)
    (mission,) = kaidan.report("absolem", stairs, friction=1.2, flippers="flat").missions
    assert (
        "On the upper landing change the flippers to stowed and turn by 180 deg: it sweeps 0.90 m "
        "of 1.20 m."
    ) in page_of(mission)


def test_a_robot_that_nobody_weighed_has_a_report_without_a_traverse():
    """There is a range of centroids, hence no one traverse."""
    (mission,) = kaidan.report("talon", "ada", friction=0.8).missions
    assert mission.traverse is None
    page = page_of(mission)
    assert mission.assessment.reason in page
    assert "The traverse" not in page


def test_the_same_report_is_the_same_file_also_once_read_back():
    found = kaidan.report("kenaf", "ibc", friction=0.8)
    again = Report.from_json(found.to_json())
    assert again == found
    for form in ("html", "pdf"):
        assert report_bytes(again, form) == report_bytes(found, form)


def test_each_mission_has_one_page_for_the_field():
    found = kaidan.report(["csiro-dtr", "kenaf"], ["ibc", "ada"], friction=0.8, flippers="stowed")
    said = Page(page_of(*found.missions))
    assert [row[1] for row in said.table("Missions of this document")[1:]] == [
        f"{robot} on {stairs}, up nose first"
        for robot in ("csiro-dtr", "kenaf")
        for stairs in ("ibc", "ada")
    ]
    assert found.exit_code == 1
    pdf = pages(document(found), {})
    # an overview, then a page for the field and at least one more for each
    assert len(re.findall(rb"/Type /Page\b(?!s)", pdf)) >= 1 + 4 * 2


def test_what_a_user_writes_is_no_markup():
    robot = kaidan.Robot.named("kenaf").model_copy(update={"name": "<script>alert(1)</script>&"})
    mission = kaidan.report(robot, "ibc", friction=0.8).missions[0]
    assert "script" not in Page(page_of(mission)).tags
    whole = Report(kaidan="0", kernel="native", missions=(mission,))
    assert pages(document(whole), {}).startswith(b"%PDF-")


@pytest.mark.parametrize("question", list(random_questions(5, seed=7)), ids=range(5))
def test_a_code_puts_the_same_question_again(question):
    assert question_of(code_of(question)) == question
    assert code_of(question_of(code_of(question))) == code_of(question)


def test_a_code_brings_the_sources_of_the_catalogue_along():
    asked = Question.of("absolem", "ibc+ada", surface="concrete-dry")
    code = code_of(asked)
    assert question_of(code.lower().replace("-", "-\n ", 1)) == asked
    assert len(code) < 4296  # letters and digits that the largest QR code holds (ISO/IEC 18004)


@pytest.mark.parametrize(
    ("code", "text"),
    [
        ("", "code '' does not begin with KAIDAN1-"),
        (HEAD, "code 'KAIDAN1-' is damaged or not whole"),
        (HEAD + "A1!", "code 'KAIDAN1-A1!' is damaged or not whole"),
        (HEAD + "ÄÖ", "code 'KAIDAN1-ÄÖ' is damaged or not whole"),
    ],
)
def test_a_code_that_is_none(code, text):
    with pytest.raises(InputError, match=re.escape(text)):
        question_of(code)


def test_a_code_that_is_cut_short_or_swells_is_refused():
    import zlib
    from base64 import b32encode

    code = code_of(Question.of("kenaf", "ibc"))
    with pytest.raises(InputError, match="damaged or not whole"):
        question_of(code[:-40])
    bomb = b32encode(zlib.compress(b" " * 10**8)).decode().rstrip("=")
    with pytest.raises(InputError, match="damaged or not whole"):
        question_of(HEAD + bomb)


def test_the_way_back_keeps_the_same_end_uphill():
    asked = Question.of("absolem", "ibc", friction=0.8, flippers="flat/land:-60deg,-20deg")
    returned = back(asked)
    assert (returned.direction, returned.facing) == ("down", "tail-first")
    assert returned.nose_up == asked.nose_up
    assert returned.flippers == "-60deg,-20deg/traverse:flat"
    assert back(returned) == asked


def test_the_command_writes_both_files(tmp_path):
    files = [tmp_path / "m.pdf", tmp_path / "m.html"]
    words = ["report", "kenaf", "--angle", "50deg", "--nosing-spacing", "150mm", "--friction", "2"]
    done = CliRunner().invoke(app, [*words, *(f"-o{each}" for each in files)])
    assert done.exit_code == 0
    assert done.output.startswith("GO  kenaf on 50 deg at 150 mm, up nose first")
    assert files[0].read_bytes().startswith(b"%PDF-")
    code = next(
        text for text in re.findall(r"KAIDAN1-[A-Z0-9]+", files[1].read_text(encoding="utf-8"))
    )
    again = CliRunner().invoke(app, ["report", "--again", code, "--json"])
    said = json.loads(again.stdout)["missions"][0]["assessment"]
    plain = CliRunner().invoke(app, ["assess", *words[1:], "--json"])
    assert said == json.loads(plain.stdout)
    assert math.isclose(said["angle_deg"], 50.0)


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ([], "report: no robot; write kaidan report ROBOT STAIRS -o FILE"),
        (
            ["kenaf", "ibc", "-o", "x.doc"],
            "report 'x.doc': unknown suffix '.doc'; known: .html, .pdf",
        ),
        (["kenaf"], "no stairs: give a catalogue name"),
        (["--again", "x"], "code 'x' does not begin with KAIDAN1-"),
    ],
)
def test_refusals_are_one_line(words, text, capsys):
    assert run(["report", *words]) == 2
    assert text in capsys.readouterr().err


def test_too_many_missions():
    with pytest.raises(InputError, match="11 robots on 10 stairs are 110 missions; give 1 to 100"):
        kaidan.report(["kenaf"] * 11, ["ibc"] * 10)


def test_without_the_extra_the_line_that_installs_it_is_said(found, monkeypatch):
    import sys

    for name in ("segno", "reportlab", "reportlab.platypus"):
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setattr(report_file, "_figures", lambda found: ())  # they take the time
    for form in ("html", "pdf"):
        with pytest.raises(MissingExtraError, match=r"pip install 'kaidan\[report\]'"):
            report_bytes(found, form)
