"""Sentences in Japanese: every one that answers say, with the same numbers."""

import re
import warnings
from string import Formatter

import pytest
from matplotlib.font_manager import findfont
from matplotlib.text import Text

import kaidan
from kaidan import catalog
from kaidan.assessment.sentences import advice
from kaidan.documents import japanese_pictures, pdf_pages, report_bytes, report_file
from kaidan.errors import InputError
from kaidan.models.sentences import unweighed
from kaidan.modes import FAILURE_MODES
from kaidan.readers.sentences.refusals import REFUSALS, sentence
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.text import document as of
from kaidan.text.japanese import in_japanese, japanese, patterns
from kaidan.text.monitor import summary
from kaidan.text.report import document
from kaidan.verbs.monitor import Cause

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?")
QUESTIONS = [
    ("absolem", "ibc", {"flippers": "flat", "surface": "concrete-dry"}),
    ("absolem", "osha-ship", {"flippers": "stowed", "friction": 1.5, "direction": "down"}),
    ("absolem", "ada", {"flippers": "flat", "yaw": "3deg", "friction": "0.5..1.2"}),
    ("kenaf", "ibc", {"model": "closed-form", "friction": 0.4}),
    ("talon", "ada", {"friction": 0.8}),
]


@pytest.fixture(scope="module")
def found():
    return kaidan.report("absolem", "ibc", flippers="flat", friction="0.6..1")


def numbers(text):
    """Numbers of a text; those of names, such as p > L/2, aside."""
    return sorted(NUMBER.findall(text.replace("L/2", "")))


def missing(sentences):
    """Sentences that have no Japanese, or not the same numbers in it."""
    said = {each: japanese(each) for each in sentences}
    return {en: ja for en, ja in said.items() if ja is None or numbers(ja) != numbers(en)}


def test_both_sides_have_the_same_fields_and_every_field_its_table():
    for table, all_of_it in patterns().items():
        for each in all_of_it:
            used = {int(number) for number in re.findall(r"\{(\d)\}", each.japanese)}
            assert used == set(range(1, len(each.tables) + 1)), (table, each.english)
            assert set(each.tables) <= {"", *patterns()}


@pytest.mark.parametrize(("robot", "stairs", "manner"), QUESTIONS)
def test_answers_are_said_in_japanese(robot, stairs, manner):
    answer = kaidan.assess(robot, stairs, **manner)
    sheets = (answer.question.robot, *answer.question.flights)
    own = {" ".join(sheet.notes.split()) for sheet in sheets}  # the words of the sheets
    said = [answer.reason, *(each for each in answer.notes if each not in own)]
    said += [each.change for each in answer.what_would_help]
    assert missing(said) == {}


@pytest.mark.parametrize("mode", FAILURE_MODES.values(), ids=FAILURE_MODES)
def test_a_verdict_by_any_mode_is_said(mode):
    assert (
        missing([f"It may fail by {mode.label} (land, step 3).", f"It fails by {mode.label}."])
        == {}
    )


def test_events_and_the_page_for_the_field_are_said(found):
    assert missing(each.text for each in found.missions[0].traverse.event_log) == {}
    whole = document(found)
    sheet = next(part for part in whole.parts if isinstance(part, of.Sheet))
    said = [each.text for each in sheet.blocks if isinstance(each, of.Paragraph | of.Heading)]
    for each in sheet.blocks:
        if isinstance(each, of.Facts):
            said += [text for row in each.rows for text in row]
        if isinstance(each, of.Points):
            said += each.items
    said = [text for text in said if re.search(r"[a-z]", text)]
    assert missing([*said, whole.title, whole.foot]).keys() <= {whole.foot}  # its version is a name


NAMED = ("figure", "source", "symbol", "value", "model", "as an option")
"""Columns of the appendix with names and words of sheets."""


def test_the_manner_of_going_is_said_in_japanese_but_for_options():
    manner = {"speed": "0.2m/s", "payload": "5kg@100mm,200mm", "yaw": "3deg", "flippers": "flat"}
    report = kaidan.report("absolem", "ibc", friction=0.7, **manner)
    tables = [each for each in in_japanese(document(report)).parts if isinstance(each, of.Table)]
    (inputs,) = (each for each in tables if each.heads[0] == "対象")
    rows = [row for row in inputs.rows if row[0] == "走り方"]
    left = {word for row in rows for cell in row for word in re.findall("[a-z]{3,}", cell)}
    assert left == {"flat", "contact", "theta"}
    assert len(rows) == 12


@pytest.mark.parametrize("turns", [False, True])
def test_appendices_are_said(found, turns):
    if turns:
        sizes = {"upper_landing": 1.2, "upper_landing_width": 2.2, "width": 1.0}
        stairs = kaidan.Stairs(rise=0.15, going=0.3, steps=6, upper_turn="half", **sizes)
        found = kaidan.report("ozbot-atr", stairs, friction="0.5..1.2", speed="0.1m/s")
    said, stays = [], []
    for each in document(found).parts:
        match each:
            case of.Paragraph() | of.Heading():
                said.append(each.text)
            case of.Picture():
                said.append(each.says)
            case of.Points():
                said += each.items
            case of.Facts():
                said += [name for name, _ in each.rows if name != "kaidan"]
            case of.Table():
                said += each.heads
                columns = zip(each.heads, zip(*each.rows, strict=True), strict=True)
                said += [text for head, column in columns if head not in NAMED for text in column]
            case of.Lines():
                stays.append(each)
    words = re.compile(r"[a-z]{3}")
    assert missing(text for text in said if words.search(text)) == {}
    turned = in_japanese(document(found))
    heads = [each.text for each in turned.parts if isinstance(each, of.Heading)]
    assert any(each.startswith("付録:") for each in heads)
    assert not any(re.search(r"[a-z]{4}", each.partition(":")[0]) for each in heads)
    assert [each for each in turned.parts if isinstance(each, of.Lines)] == stays != []


@pytest.mark.parametrize("lost", [0, 2, 40])
def test_the_summary_of_a_climb_is_said(tmp_path, lost):
    tilts = [0.5 + 0.02 * k * (lost < 30) for k in range(30)]  # without an alarm many are missed
    rows = [(0.01 * k, f"{tilt},0,0") for k, tilt in enumerate(tilts)]
    rows += [(0.01 * (k // 2) + 0.003 * (1 + k % 2), ",,") for k in range(lost)]
    rows = [f"{t:.3f},{values}" for t, values in sorted(rows)]
    file = tmp_path / "climb.csv"
    file.write_text("\n".join(["t,inclination,inclination_rate,acceleration", *rows]))
    found = kaidan.monitor("absolem", "ibc", str(file), flippers="flat")
    lines = summary(found).splitlines()
    assert len(lines) == {0: 2, 2: 3, 40: 3}[lost]  # it tips over, or most are lost
    assert missing(lines) == {}
    slow = found.model_copy(update={"raised": dict.fromkeys(Cause, 1), "rate_hz": 2.0})
    assert missing(summary(slow).splitlines()) == {}


@pytest.mark.parametrize("why", REFUSALS)
def test_every_refusal_of_a_file_is_said(why):
    fields = [name for _, name, _, _ in Formatter().parse(REFUSALS[why]) if name]
    words = {"ways": "mm, +z up or m, +y up", "names": "track_left, track_right"}
    assert missing([sentence(why, {name: words.get(name, 12.0) for name in fields})]) == {}


@pytest.mark.parametrize("form", ["html", "pdf"])
def test_a_report_in_japanese(found, form, monkeypatch):
    pytest.importorskip("reportlab", reason="skipped: ReportLab not installed")
    monkeypatch.setattr(report_file, "_figures", lambda found: ())  # the same in any language
    monkeypatch.setattr(pdf_pages, "typeface_files", list)
    pdf_pages._japanese.cache_clear()
    made = report_bytes(found, form, "ja")
    has = {"html": b'<html lang="ja">', "pdf": b"HeiseiKakuGo-W5"}[form]
    assert has in made
    assert has not in report_bytes(found, form)
    if form == "html":
        assert "摩擦が決め手です(進入、1 段目)。必要 0.91、想定 0.60〜1.00。" in made.decode()


def test_a_pdf_has_the_typeface_of_the_system_inside(found, monkeypatch):
    pytest.importorskip("reportlab", reason="skipped: ReportLab not installed")
    monkeypatch.setattr(report_file, "_figures", lambda found: ())
    stand_in = findfont("DejaVu Serif")  # a TrueType font that every system with matplotlib has
    monkeypatch.setattr(pdf_pages, "typeface_files", lambda: [__file__, stand_in])
    pdf_pages._japanese.cache_clear()
    made = report_bytes(found, "pdf", "ja")
    pdf_pages._japanese.cache_clear()
    assert b"DejaVuSerif" in made
    assert b"HeiseiKakuGo" not in made


def test_titles_of_the_catalogue_are_said_but_for_names():
    titles = [Stairs.named(name).title for name in catalog.names("stairs")]
    titles += [Surface.named(name).title for name in catalog.names("surfaces")]
    assert [each for each in titles if japanese(each, "title") is None] == []
    assert japanese("Kenaf, no arm", "title") == "Kenaf、アームなし"


@pytest.fixture
def words(monkeypatch):
    """Words of the figures of a report, drawn in Japanese as on a system that has a typeface."""

    def of_report(report):
        monkeypatch.setattr(japanese_pictures, "typeface", lambda: "DejaVu Sans")
        said = []
        for _, figure in report_file._figures(report):
            japanese_pictures.put_in_japanese(figure)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of this typeface, which has no kana
                figure.canvas.draw()
            said += [each.get_text() for each in figure.findobj(Text) if each.get_visible()]
        return said

    return of_report


@pytest.mark.parametrize(
    ("robot", "stairs", "manner"),
    [
        ("absolem", "ibc", {"flippers": "flat", "friction": "0.6..1"}),
        ("ozbot-atr", "ibc", {"friction": 0.6, "direction": "down", "flippers": "stowed"}),
        ("kenaf", "ibc", {}),
        ("talon", "ibc", {"friction": 0.9}),
    ],
)
def test_pictures_have_no_english_word_but_names(words, robot, stairs, manner):
    found = kaidan.report(robot, stairs, **manner)
    for name in (robot, stairs):
        assert japanese(name, "picture") is None
    units_and_symbols = re.compile(
        r"\$[^$]*\$|\b(mm|m|deg|UNSURE|ROUGH|NO-GO|GO|C_L|C_N|N m|s)\b|" + f"{robot}|{stairs}"
    )
    left = [each for each in words(found) if re.search("[a-z]{2}", units_and_symbols.sub("", each))]
    assert left == []


def test_without_a_typeface_pictures_stay_as_they_are(found, monkeypatch):
    monkeypatch.setattr(japanese_pictures, "typeface", lambda: None)
    (_, figure), *_ = report_file._figures(found)
    before = [each.get_text() for each in figure.findobj(Text)]
    japanese_pictures.put_in_japanese(figure)
    assert [each.get_text() for each in figure.findobj(Text)] == before


def test_another_language_is_refused(found):
    with pytest.raises(InputError, match="language 'fr' is not known; known: en, ja"):
        report_bytes(found, "html", "fr")


def test_what_has_no_japanese_stays_as_it_is():
    assert japanese("It sings.") is None


@pytest.mark.parametrize(
    ("sentence", "contains"),
    [
        (advice.STRAIGHT, "真っ直ぐ"),
        (advice.STEADY, "一定"),
        (advice.FLAT, "一直線"),
        (advice.turned_round("up", "tail-first"), "後端"),
        (advice.turned_round("down", "nose-first"), "前端"),
        (advice.raised("front", 0.785398), "45°"),
        (advice.raised("rear", 0.785398), "45°"),
        (advice.friction(0.92, known=True), "0.92"),
        (advice.friction(0.92, known=False), "0.92"),
        (advice.grousers(), "グローサ"),
        (advice.slower(0.05), "0.05 m/s"),
        (advice.measured(["theta_d", "theta_M"]), "theta_d と theta_M"),
        (advice.centroid(0.012, "front", of_payload=None), "12 mm"),
        (advice.centroid(0.012, "front", of_payload=0.03), "荷物を 30 mm"),
        (unweighed.weigh(0.2, 0.1), "200 mm"),
    ],
)
def test_every_advice_has_a_sentence_in_japanese(sentence, contains):
    assert contains in japanese(sentence)
