"""Texts of the page: both languages, every word of an answer."""

import re
from pathlib import Path

import kaidan
from kaidan.modes import FAILURE_MODES, Phase, Undecided, Verdict
from kaidan.text.page import page_texts
from kaidan.verbs.monitor import Cause

TEXTS = page_texts()
SCRIPTS = Path(kaidan.__file__).parent / "web" / "static" / "js"
# Topics whose names the page makes of an answer's words.
OPEN = {"verdict", "mode", "phase", "figure", "ground", "binds", "stairs"}
OPEN |= {"side", "chart", "app", "answer", "guide", "saved", "live"}
OPEN |= {"robot", "measure", "work", "landing", "kind", "outcome"}


def test_every_text_is_there_in_japanese():
    found = [
        f"{topic}.{name}"
        for topic, texts in TEXTS.items()
        for name, text in texts.items()
        if not text.get("ja")
    ]
    assert found == []


def test_both_languages_fill_in_the_same_fields():
    def fields(text):
        return set(re.findall(r"\{(\w+)\}", text))

    for topic, texts in TEXTS.items():
        for name, text in texts.items():
            if "en" in text:
                assert fields(text["en"]) == fields(text["ja"]), f"{topic}.{name}"


def test_every_word_of_an_answer_is_known():
    assert {verdict.value for verdict in Verdict} == TEXTS["verdict"].keys()
    assert FAILURE_MODES.keys() | {each.value for each in Undecided} == TEXTS["mode"].keys()
    assert {phase.value for phase in Phase} == TEXTS["phase"].keys()


def test_what_the_answer_says_in_english_stands_here_in_japanese_alone():
    assert [mode for mode in FAILURE_MODES if "en" in TEXTS["mode"][mode]] == []


def test_every_text_that_a_script_names_is_there():
    for script in SCRIPTS.glob("*.js"):
        for topic, name in re.findall(r"""\bt\(["'`](\w+)\.([\w-]+)["'`]""", script.read_text()):
            assert name in TEXTS[topic], f"{script.name}: {topic}.{name}"


def test_the_live_page_has_its_texts_and_none_is_left_over():
    own = "".join((SCRIPTS.parent / f"live.{kind}").read_text() for kind in ("html", "js"))
    said = set(re.findall(r"""data-text="(\w+)\"|\bt\("(\w+)\"""", own))
    made = {"idle", "calm", *(phase.value for phase in Phase)}
    moods = {"unknown", *(cause.replace(" ", "_").replace("-", "_") for cause in Cause)}
    made |= {mood + more for mood in moods for more in ("", "_do")}
    assert {first or second for first, second in said} | made | {"go_on"} == TEXTS["live"].keys()


def test_no_text_is_left_over():
    scripts = "\n".join(path.read_text() for path in SCRIPTS.glob("*.js"))
    unused = [
        f"{topic}.{name}"
        for topic, texts in TEXTS.items()
        if topic not in OPEN
        for name in texts
        if f"{topic}.{name}" not in scripts
    ]
    assert unused == []
